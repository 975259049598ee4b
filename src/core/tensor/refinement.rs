//! The same spline over more knots, of higher degree, and as Bezier patches; always line by line in one direction.
//!
//! Course: sections 7.4 and 8.2.

use crate::core::bspline::Spline;
use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::tensor_product::TensorSpline;

/// The polynomial piece over one grid cell: `Σ points[k] ∏ b_{k_ν}` with Bernstein polynomials of the cell's parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierCell<P, const D: usize> {
    /// The cell, `(a_ν, b_ν)` in each direction.
    pub cell: [(f64, f64); D],
    /// The degrees `n_ν`.
    pub degrees: [usize; D],
    /// The `∏ (n_ν + 1)` control points, row-major.
    pub points: Vec<P>,
}

impl<P: Point, const D: usize> TensorSpline<P, D> {
    /// The same spline with more knots in one direction, see [`Spline::insert_knots`].
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `NonFinite`, `OutsideInterval`, `KnotMultiplicityTooHigh` with the axis.
    pub fn insert_knots(&self, axis: usize, new: &[f64]) -> Result<Self, TensorError> {
        self.map_lines(axis, |line| line.insert_knots(new))
    }

    /// The same spline with every cell halved in every direction.
    ///
    /// # Errors
    ///
    /// As [`Spline::refine_uniformly`].
    pub fn refine_uniformly(&self) -> Result<Self, TensorError> {
        (0..D).try_fold(self.clone(), |spline, axis| spline.map_lines(axis, Spline::refine_uniformly))
    }

    /// The same spline with the degree of one direction raised by one.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; those of [`Spline::elevate_degree`] with the axis.
    pub fn elevate_degree(&self, axis: usize) -> Result<Self, TensorError> {
        self.map_lines(axis, Spline::elevate_degree)
    }

    /// The open spline over one period of each periodic direction.
    ///
    /// # Errors
    ///
    /// As [`Spline::unroll`].
    pub fn unroll(&self) -> Result<Self, TensorError> {
        (0..D).try_fold(self.clone(), |spline, axis| spline.map_lines(axis, Spline::unroll))
    }

    /// One Bezier piece for each nonempty cell, row-major; periodic directions over one period.
    ///
    /// # Errors
    ///
    /// Those of knot insertion; none is known to occur.
    pub fn bezier_form(&self) -> Result<Vec<BezierCell<P, D>>, TensorError> {
        let mut spline = self.unroll()?;
        for axis in 0..D {
            let space = &spline.space().axes()[axis];
            let breaks = space.breaks();
            let missing: Vec<f64> = breaks
                .iter()
                .flat_map(|&at| {
                    std::iter::repeat_n(at, space.degree().saturating_sub(space.multiplicity(at)))
                })
                .collect();
            spline = spline.insert_knots(axis, &missing)?;
        }
        let (space, degrees) = (spline.space(), spline.space().degrees());
        let breaks = space.axes().each_ref().map(crate::core::bspline::SplineSpace::breaks);
        let cells: usize = breaks.iter().map(|list| list.len() - 1).product();
        let width: usize = degrees.iter().map(|n| n + 1).product();
        // Where every break is n-fold, piece i starts at coefficient n·i plus those before the first break.
        let before: [usize; D] = std::array::from_fn(|axis| {
            let line = &space.axes()[axis];
            line.span(breaks[axis][0]).map_or(0, |span| span - line.degree())
        });
        let piece = |mut place: usize| {
            let mut cell = [0; D];
            for axis in (0..D).rev() {
                cell[axis] = place % (breaks[axis].len() - 1);
                place /= breaks[axis].len() - 1;
            }
            let point = |mut j: usize| {
                let mut k = [0; D];
                for axis in (0..D).rev() {
                    k[axis] = before[axis] + cell[axis] * degrees[axis] + j % (degrees[axis] + 1);
                    j /= degrees[axis] + 1;
                }
                spline.coefficients()[space.flat_index(k)]
            };
            BezierCell {
                cell: std::array::from_fn(|axis| (breaks[axis][cell[axis]], breaks[axis][cell[axis] + 1])),
                degrees,
                points: (0..width).map(point).collect(),
            }
        };
        Ok((0..cells).map(piece).collect())
    }
}

#[cfg(test)]
mod tests {
    use crate::core::bezier::BezierCurve;
    use crate::core::tensor::tensor_product::tests::mixed;
    use glam::DVec3;

    #[test]
    fn insertion_and_elevation_keep_the_spline() {
        let spline = mixed();
        let changed = [
            spline.insert_knots(0, &[1.5, 2.5, 0.3]).unwrap(),
            spline.insert_knots(1, &[0.7, 3.0]).unwrap(),
            spline.refine_uniformly().unwrap(),
            spline.elevate_degree(2).unwrap().elevate_degree(1).unwrap(),
            spline.unroll().unwrap(),
        ];
        for (case, other) in changed.iter().enumerate() {
            for i in 0..50 {
                let x = [f64::from(i % 5), f64::from(i % 7) * 0.57, f64::from(i) / 50.0];
                let error = (spline.evaluate(x).unwrap() - other.evaluate(x).unwrap()).length();
                assert!(error < 1e-11, "case {case} at {x:?}: off by {error}");
            }
        }
        assert_eq!(spline.insert_knots(3, &[0.5]).unwrap_err().name(), "SizeMismatch", "no fourth direction");
        assert_eq!(
            spline.insert_knots(2, &[0.5, 0.5]).unwrap_err().name(),
            "KnotMultiplicityTooHigh",
            "degree 1"
        );
    }

    #[test]
    fn pieces_are_the_spline() {
        let spline = mixed();
        let pieces = spline.bezier_form().unwrap();
        let counts = spline.space().axes().each_ref().map(|axis| axis.breaks().len() - 1);
        assert_eq!(pieces.len(), counts.iter().product::<usize>(), "one for each cell");
        for piece in &pieces {
            let t = [0.3, 0.8, 0.5];
            let mut block = piece.points.clone();
            for axis in (0..3).rev() {
                let n = piece.degrees[axis];
                let value =
                    |line: &[DVec3]| BezierCurve::new(line.to_vec()).unwrap().evaluate(t[axis]).unwrap();
                block = block.chunks(n + 1).map(value).collect();
            }
            let x = std::array::from_fn(|axis| {
                piece.cell[axis].0 + t[axis] * (piece.cell[axis].1 - piece.cell[axis].0)
            });
            let error = (block[0] - spline.evaluate(x).unwrap()).length();
            assert!(error < 1e-11, "cell {:?}: off by {error}", piece.cell);
        }
    }
}
