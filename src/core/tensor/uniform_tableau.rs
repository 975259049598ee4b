//! De Boor's algorithm on a uniform grid of two variables with the divisions postponed.
//!
//! In the cell that starts at `ξ_l`, with `x = ξ_l + t h`: for `i = n … 1` and `j = 0 … i − 1`
//! `a_{l−j} ← (j + t) a_{l−j} + (i − j − t) a_{l−j−1}`; one division by `n₁! n₂!` remains. Course: section 7.4.

use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::tensor_product::TensorSpline;

/// Every number of the scheme at one point.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformTableau<P> {
    /// The cell `[l₁, l₂]`.
    pub cell: [usize; 2],
    /// Blocks after `0 … n₁` steps in the first direction, rows `k₁` and columns `k₂`; the last has one row.
    pub first_direction: Vec<Vec<Vec<P>>>,
    /// The triangle of the second direction, starting with the row that is left.
    pub second_direction: Vec<Vec<P>>,
    /// `n₁! n₂!`.
    pub divisor: f64,
    /// The value of the spline.
    pub value: P,
}

impl<P: Point> TensorSpline<P, 2> {
    /// The division-free scheme at `x`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis; `KnotsNotUniform` unless the `2n_ν` knots around the cell are equally
    /// spaced to 1e-12 of their distance.
    pub fn uniform_tableau(&self, x: [f64; 2]) -> Result<UniformTableau<P>, TensorError> {
        let cell = self.space().cell(x)?;
        let degrees = self.space().degrees();
        let mut t = [0.0; 2];
        for axis in 0..2 {
            let space = &self.space().axes()[axis];
            let (l, n, knots) = (cell[axis], degrees[axis], space.evaluation_knots());
            let h = knots[l + 1] - knots[l];
            let uneven =
                knots[l + 1 - n..=l + n].windows(2).any(|pair| ((pair[1] - pair[0]) - h).abs() > 1e-12 * h);
            if uneven {
                return Err(TensorError::KnotsNotUniform { axis });
            }
            t[axis] = (space.reduce(x[axis]).map_err(TensorError::on_axis(axis))? - knots[l]) / h;
        }
        let index = |axis: usize, k: usize| self.space().axes()[axis].coefficient_index(k);
        let row = |k: usize| -> Vec<P> {
            let columns = cell[1] - degrees[1]..=cell[1];
            let place = |column: usize| self.space().flat_index([index(0, k), index(1, column)]);
            columns.map(|column| self.coefficients()[place(column)]).collect()
        };
        let mut first_direction = vec![(cell[0] - degrees[0]..=cell[0]).map(row).collect::<Vec<_>>()];
        for i in (1..=degrees[0]).rev() {
            let block = &first_direction[first_direction.len() - 1];
            let step = |r: usize| {
                (0..=degrees[1]).map(|c| blend(i, r, t[0], block[r][c], block[r + 1][c])).collect()
            };
            first_direction.push((0..i).map(step).collect());
        }
        let mut second_direction = vec![first_direction[degrees[0]][0].clone()];
        for i in (1..=degrees[1]).rev() {
            let row = &second_direction[second_direction.len() - 1];
            second_direction.push((0..i).map(|c| blend(i, c, t[1], row[c], row[c + 1])).collect());
        }
        let divisor = degrees.iter().map(|&n| (1..=n).map(|i| i as f64).product::<f64>()).product();
        let value = second_direction[degrees[1]][0] * (1.0 / divisor);
        Ok(UniformTableau { cell, first_direction, second_direction, divisor, value })
    }
}

/// Entry `position` (counted from the left, `j = i − 1 − position`) of the level that uses the factors with `i`.
fn blend<P: Point>(i: usize, position: usize, t: f64, left: P, right: P) -> P {
    let j = (i - 1 - position) as f64;
    right * (j + t) + left * (i as f64 - j - t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::tensor::TensorSplineSpace;

    #[test]
    fn the_scheme_ends_with_the_value() {
        let line =
            |n: usize, h: f64| SplineSpace::new(n, (0..12).map(|k| h * f64::from(k)).collect()).unwrap();
        for (n1, n2) in [(1, 1), (2, 3), (4, 2)] {
            let space = TensorSplineSpace::new([line(n1, 1.0), line(n2, 0.5)]).unwrap();
            let coefficients = (0..space.dimension()).map(|k| (k * k % 17) as f64).collect();
            let spline = TensorSpline::new(space, coefficients).unwrap();
            let x = [4.7, 2.6];
            let error = spline.uniform_tableau(x).unwrap().value - spline.evaluate(x).unwrap();
            assert!(error.abs() < 1e-12, "degrees {n1}, {n2}: off by {error}");
        }
        let uneven = SplineSpace::new(1, vec![0.0, 1.0, 2.0, 4.0]).unwrap();
        let spline =
            TensorSpline::new(TensorSplineSpace::new([line(1, 1.0), uneven]).unwrap(), vec![0.0; 20])
                .unwrap();
        assert!(spline.uniform_tableau([1.5, 1.5]).is_ok(), "degree 1 needs no neighbours");
        let uneven = SplineSpace::new(2, vec![0.0, 1.0, 2.0, 4.0, 5.0, 6.0]).unwrap();
        let spline =
            TensorSpline::new(TensorSplineSpace::new([line(1, 1.0), uneven]).unwrap(), vec![0.0; 30])
                .unwrap();
        assert_eq!(
            spline.uniform_tableau([1.5, 2.5]),
            Err(TensorError::KnotsNotUniform { axis: 1 }),
            "uneven"
        );
    }
}
