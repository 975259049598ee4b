//! Polynomials as tensor splines: products of the univariate Marsden coefficients.
//!
//! The coefficient of `xʳ` at the B-spline `b_k` of degree `n` is the elementary symmetric function of degree `r` of the knots
//! `ξ_{k+1} … ξ_{k+n}`, divided by `C(n, r)`: the blossom of the monomial. Course: sections 4.3 and 7.3.

use crate::core::bspline::{SplineError, monomial_blossoms};
use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::space::TensorSplineSpace;
use crate::core::tensor::tensor_product::TensorSpline;

impl<P: Point, const D: usize> TensorSpline<P, D> {
    /// The polynomial `Σ aᵣ ∏ x_ν^{r_ν}` as a spline; `monomials` holds `aᵣ`, `0 ≤ r_ν ≤ n_ν`, row-major.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `∏ (n_ν + 1)` coefficients; `NotInSpace` with the axis for a periodic direction; `NonFinite`.
    pub fn from_monomials(space: TensorSplineSpace<D>, monomials: &[P]) -> Result<Self, TensorError> {
        let degrees = space.degrees();
        let expected: usize = degrees.iter().map(|n| n + 1).product();
        if monomials.len() != expected {
            let found = monomials.len();
            return Err(TensorError::SizeMismatch { what: "monomial coefficients", expected, found });
        }
        if let Some(axis) = space.axes().iter().position(|axis| axis.is_periodic()) {
            let reason = "polynomials are not periodic".to_owned();
            return Err(TensorError::Axis { axis, source: SplineError::NotInSpace { reason } });
        }
        // One row of n + 1 blossoms for each coefficient of each direction.
        let rows: [Vec<Vec<f64>>; D] = std::array::from_fn(|axis| {
            let (n, line) = (degrees[axis], &space.axes()[axis]);
            (0..line.dimension()).map(|k| monomial_blossoms(&line.knots()[k + 1..=k + n])).collect()
        });
        let coefficient = |place: usize| {
            let k = space.multi_index(place);
            let term = |(mut r, &a): (usize, &P)| {
                let mut weight = 1.0;
                for axis in (0..D).rev() {
                    weight *= rows[axis][k[axis]][r % (degrees[axis] + 1)];
                    r /= degrees[axis] + 1;
                }
                a * weight
            };
            monomials.iter().enumerate().map(term).fold(P::ZERO, |sum, value| sum + value)
        };
        let coefficients = (0..space.dimension()).map(coefficient).collect();
        Self::new(space, coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    #[test]
    fn polynomials_are_reproduced() {
        let first =
            SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 4.0, 5.0, 5.5, 7.0]).unwrap();
        let space = TensorSplineSpace::new([first, SplineSpace::uniform(2, -1.0, 1.0, 4).unwrap()]).unwrap();
        let monomials: Vec<f64> = (0..12).map(|i| f64::from(i * i % 7) - 3.0).collect();
        let spline = TensorSpline::from_monomials(space, &monomials).unwrap();
        for i in 0..40 {
            let (x, y) = (0.1 * f64::from(i), 0.05 * f64::from(i) - 1.0);
            let expected: f64 = monomials
                .iter()
                .enumerate()
                .map(|(r, a)| a * x.powi(r as i32 / 3) * y.powi(r as i32 % 3))
                .sum();
            let error = spline.evaluate([x, y]).unwrap() - expected;
            assert!(error.abs() < 1e-11, "at {x}, {y}: off by {error}");
        }
    }
}
