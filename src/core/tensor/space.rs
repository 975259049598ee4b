//! Tensor-product spline spaces: one [`SplineSpace`] for each direction.
//!
//! `b_k(x) = ∏ b_{k_ν}(x_ν)`; the support is the box of the supports. Course: section 7.3.

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::tensor::error::TensorError;

/// Splines of `D` variables, open or periodic in each direction; valid because each direction is.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorSplineSpace<const D: usize> {
    axes: [SplineSpace; D],
}

impl<const D: usize> TensorSplineSpace<D> {
    /// The space with the given directions, 1 to 3 of them.
    ///
    /// # Errors
    ///
    /// `Empty` for no directions, `StepLimit` for more than three.
    pub fn new(axes: [SplineSpace; D]) -> Result<Self, TensorError> {
        match D {
            0 => Err(TensorError::Axis { axis: 0, source: SplineError::Empty { what: "axes" } }),
            1..=3 => Ok(Self { axes }),
            _ => {
                let source = SplineError::StepLimit { what: "number of axes", value: D, limit: 3 };
                Err(TensorError::Axis { axis: 3, source })
            }
        }
    }

    /// The spaces of the directions.
    pub fn axes(&self) -> &[SplineSpace; D] {
        &self.axes
    }

    /// The space of direction `axis`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such direction.
    pub fn axis(&self, axis: usize) -> Result<&SplineSpace, TensorError> {
        self.axes.get(axis).ok_or(TensorError::NoSuchAxis { axis, count: D })
    }

    /// The degrees `n_ν`.
    pub fn degrees(&self) -> [usize; D] {
        self.axes.each_ref().map(SplineSpace::degree)
    }

    /// Numbers of coefficients `m_ν`.
    pub fn shape(&self) -> [usize; D] {
        self.axes.each_ref().map(SplineSpace::dimension)
    }

    /// Number of all coefficients, `∏ m_ν`.
    pub fn dimension(&self) -> usize {
        self.shape().iter().product()
    }

    /// The parameter intervals `(left, right)` of the directions.
    pub fn parameter_box(&self) -> [(f64, f64); D] {
        self.axes.each_ref().map(SplineSpace::parameter_interval)
    }

    /// Place of coefficient `k` in the row-major array, the first index slowest.
    pub fn flat_index(&self, k: [usize; D]) -> usize {
        k.iter().zip(self.shape()).fold(0, |index, (&k, count)| index * count + k)
    }

    /// The indices of the coefficient at a place of the row-major array.
    pub fn multi_index(&self, mut place: usize) -> [usize; D] {
        let (shape, mut k) = (self.shape(), [0; D]);
        for axis in (0..D).rev() {
            k[axis] = place % shape[axis];
            place /= shape[axis];
        }
        k
    }

    /// Indices `l` of the grid cell `∏ [ξ_{l_ν}, ξ_{l_ν + 1})` that contains `x`, into the evaluation knots.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn cell(&self, x: [f64; D]) -> Result<[usize; D], TensorError> {
        let mut cell = [0; D];
        for axis in 0..D {
            cell[axis] = self.axes[axis].span(x[axis]).map_err(TensorError::on_axis(axis))?;
        }
        Ok(cell)
    }

    /// The support box of B-spline `k`.
    pub fn support(&self, k: [usize; D]) -> [(f64, f64); D] {
        std::array::from_fn(|axis| self.axes[axis].support(k[axis]))
    }

    /// The node of B-spline `k`: its Greville abscissa in each direction.
    pub fn node(&self, k: [usize; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            let space = &self.axes[axis];
            let knot = |i: usize| space.knot((k[axis] + i) as isize).unwrap_or(f64::NAN);
            (1..=space.degree()).map(|i| knot(i) - knot(1)).sum::<f64>() / space.degree() as f64 + knot(1)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_index_runs_fastest() {
        let line = |m: usize| SplineSpace::uniform(2, 0.0, 1.0, m - 2).unwrap();
        let space = TensorSplineSpace::new([line(3), line(4), line(5)]).unwrap();
        assert_eq!(space.flat_index([1, 2, 3]), 33, "1·20 + 2·5 + 3");
        for place in 0..space.dimension() {
            assert_eq!(space.flat_index(space.multi_index(place)), place, "place {place}");
        }
        let nodes = space.axes()[2].greville_abscissae();
        assert_eq!(space.node([0, 0, 4])[2], nodes[4], "nodes are the abscissae of the directions");
    }

    #[test]
    fn errors_name_their_axis() {
        let line = SplineSpace::uniform(1, 0.0, 1.0, 2).unwrap();
        let space = TensorSplineSpace::new([line.clone(), line.clone()]).unwrap();
        let error = space.cell([0.5, 1.5]).unwrap_err();
        assert!(matches!(error, TensorError::Axis { axis: 1, .. }), "{error}");
        assert_eq!(error.name(), "OutsideInterval", "{error}");
        let four = TensorSplineSpace::new([line.clone(), line.clone(), line.clone(), line]);
        assert_eq!(four.unwrap_err().name(), "StepLimit", "four variables");
    }
}
