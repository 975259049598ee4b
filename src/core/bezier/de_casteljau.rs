//! De Casteljau's algorithm, blossoms and a faster evaluation.
//!
//! `pⁱ⁺¹ₖ = (1 − t) pⁱₖ + t pⁱₖ₊₁`; the blossom takes another `t` in every step. Course: section 2.3.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::triangular_scheme::TriangularScheme;

impl<P: Point> BezierCurve<P> {
    /// De Casteljau's scheme at `x` with all intermediate points.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn de_casteljau_scheme(&self, x: f64) -> Result<TriangularScheme<P>, BezierError> {
        let t = self.local_parameter(x)?;
        Ok(TriangularScheme::run(self.points().to_vec(), self.degree(), |_, _| t))
    }

    /// The blossom: symmetric, affine in each of its `n` arguments, and `p(x)` if all of them are `x`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `n` arguments, `NonFinite` with the index of the argument.
    pub fn blossom(&self, arguments: &[f64]) -> Result<P, BezierError> {
        let (expected, found) = (self.degree(), arguments.len());
        if expected != found {
            return Err(BezierError::SizeMismatch { what: "arguments", expected, found });
        }
        let mut points = self.points().to_vec();
        for (index, &x) in arguments.iter().enumerate() {
            let t = self.local_parameter(x).map_err(|_| BezierError::NonFinite {
                what: "argument",
                index,
                value: x,
            })?;
            for j in 0..expected - index {
                points[j] = points[j].mix(points[j + 1], t);
            }
        }
        Ok(points[0])
    }

    /// `p(x)` in linear time by Horner's scheme in `t/(1 − t)`, or in `(1 − t)/t` beyond the middle.
    ///
    /// Less accurate than [`BezierCurve::evaluate`] outside the interval and for very high degrees.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn evaluate_fast(&self, x: f64) -> Result<P, BezierError> {
        let t = self.local_parameter(x)?;
        let n = self.degree();
        if t > 0.5 {
            return Ok(horner(self.points().iter().rev(), 1.0 - t, n));
        }
        Ok(horner(self.points().iter(), t, n))
    }
}

/// `Σ C(n,k) (1 − t)ⁿ⁻ᵏ tᵏ cₖ` for `t ≤ 1/2`, from the last coefficient to the first.
fn horner<'a, P: Point>(points: impl DoubleEndedIterator<Item = &'a P>, t: f64, n: usize) -> P {
    let s = 1.0 - t;
    let ratio = t / s;
    let mut sum = P::ZERO;
    // With the binomials as factors between neighbours: c₀ + n/1·q (c₁ + (n−1)/2·q (c₂ + …)).
    for (steps, &point) in points.rev().enumerate() {
        let k = n - steps;
        sum = point + sum * (ratio * (n - k) as f64 / (k + 1) as f64);
    }
    sum * s.powi(i32::try_from(n).unwrap_or(i32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn all_evaluations_agree(points in prop::collection::vec(-10.0..10.0_f64, 1..26), t in 0.0..=1.0_f64) {
            let curve = BezierCurve::new(points).unwrap();
            let value = curve.evaluate(t).unwrap();
            let fast = curve.evaluate_fast(t).unwrap();
            prop_assert!((value - fast).abs() < 1e-12, "{value} and {fast}");
            prop_assert_eq!(curve.de_casteljau_scheme(t).unwrap().result(), Some(value), "scheme");
            let diagonal = curve.blossom(&vec![t; curve.degree()]).unwrap();
            prop_assert_eq!(diagonal, value, "diagonal of the blossom");
        }

        #[test]
        fn the_blossom_is_symmetric(points in prop::collection::vec(-10.0..10.0_f64, 5), t in prop::collection::vec(-1.0..2.0_f64, 4)) {
            let curve = BezierCurve::new(points).unwrap();
            let reversed: Vec<f64> = t.iter().rev().copied().collect();
            let (a, b) = (curve.blossom(&t).unwrap(), curve.blossom(&reversed).unwrap());
            prop_assert!((a - b).abs() < 1e-11, "{a} and {b}");
        }
    }
}
