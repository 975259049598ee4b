//! Partial derivatives as tensor splines, and as sums of B-splines where continuity is lost.
//!
//! The coefficients of `∂_ν p` are `n_ν (c_k − c_{k − e_ν})/(ξ_{k+n} − ξ_k)`. Course: section 7.4.

use crate::core::bspline::{BSplineSum, Side, Spline};
use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::tensor_product::TensorSpline;

/// `Σ c_k b_k` with degrees of 0 or more; it may jump at knots. The tensor counterpart of [`BSplineSum`].
#[derive(Clone, Debug, PartialEq)]
pub struct TensorSum<P, const D: usize> {
    degrees: [usize; D],
    knots: [Vec<f64>; D],
    coefficients: Vec<P>,
}

impl<P: Point, const D: usize> TensorSum<P, D> {
    /// The degrees, 0 or more.
    pub fn degrees(&self) -> [usize; D] {
        self.degrees
    }

    /// The knots of a direction; empty for one that does not exist.
    pub fn knots(&self, axis: usize) -> &[f64] {
        self.knots.get(axis).map_or(&[], Vec::as_slice)
    }

    /// Numbers of coefficients in the directions.
    pub fn shape(&self) -> [usize; D] {
        std::array::from_fn(|axis| self.knots[axis].len() - self.degrees[axis] - 1)
    }

    /// The coefficients, row-major.
    pub fn coefficients(&self) -> &[P] {
        &self.coefficients
    }

    /// The value at `x`, the limit from `sides` at knots; takes time in proportion to the number of coefficients.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn evaluate(&self, x: [f64; D], sides: [Side; D]) -> Result<P, TensorError> {
        let (mut block, shape) = (self.coefficients.clone(), self.shape());
        for axis in (0..D).rev() {
            let value = |line: &[P]| {
                BSplineSum::from_parts(self.degrees[axis], self.knots[axis].clone(), line.to_vec())
                    .evaluate(x[axis], sides[axis])
                    .map_err(TensorError::on_axis(axis))
            };
            block = block.chunks(shape[axis]).map(value).collect::<Result<_, _>>()?;
        }
        Ok(block[0])
    }

    /// Differentiates once more in direction `axis`; the coefficient of a B-spline with empty support is 0.
    fn differentiated(mut self, axis: usize) -> Self {
        let (n, shape, knots) = (self.degrees[axis], self.shape(), &self.knots[axis]);
        let stride: usize = shape[axis + 1..].iter().product();
        let difference = |place: usize| {
            let (within, k) = (place % stride, place / stride % (shape[axis] - 1) + 1);
            let block = place / stride / (shape[axis] - 1);
            let at = |k: usize| self.coefficients[(block * shape[axis] + k) * stride + within];
            let width = knots[k + n] - knots[k];
            if width > 0.0 { (at(k) - at(k - 1)) * (n as f64 / width) } else { P::ZERO }
        };
        let count = self.coefficients.len() / shape[axis] * (shape[axis] - 1);
        let coefficients = (0..count).map(difference).collect();
        self.knots[axis] = knots[1..knots.len() - 1].to_vec();
        self.degrees[axis] = n - 1;
        Self { coefficients, ..self }
    }
}

impl<P: Point, const D: usize> TensorSpline<P, D> {
    /// `∂p/∂x_axis` as a spline, periodic directions stay periodic; see [`Spline::derivative`].
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `NotInSpace` with the axis where the derivative jumps.
    pub fn partial(&self, axis: usize) -> Result<Self, TensorError> {
        self.map_lines(axis, Spline::derivative)
    }

    /// The gradient, one spline for each direction.
    ///
    /// # Errors
    ///
    /// As [`Self::partial`].
    pub fn gradient(&self) -> Result<Vec<Self>, TensorError> {
        (0..D).map(|axis| self.partial(axis)).collect()
    }

    /// The derivative of orders `orders[ν]` as a sum of B-splines over D, or over one period; `None` above a degree.
    ///
    /// # Errors
    ///
    /// Those of [`Self::unroll`]; none is known to occur.
    pub fn partial_sum(&self, orders: [usize; D]) -> Result<Option<TensorSum<P, D>>, TensorError> {
        let open = self.unroll()?;
        let degrees = open.space().degrees();
        if orders.iter().zip(degrees).any(|(&order, degree)| order > degree) {
            return Ok(None);
        }
        let knots = open.space().axes().each_ref().map(|axis| axis.knots().to_vec());
        let mut sum = TensorSum { degrees, knots, coefficients: open.into_parts().1 };
        for axis in 0..D {
            for _ in 0..orders[axis] {
                sum = sum.differentiated(axis);
            }
        }
        Ok(Some(sum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::tensor::tensor_product::tests::mixed;

    #[test]
    fn derivative_splines_and_sums_agree_with_the_derivatives() {
        let spline = mixed();
        let sides = [Side::Right, Side::Left, Side::Right];
        for orders in [[1, 0, 0], [0, 1, 0], [1, 1, 1], [2, 2, 0], [3, 0, 1]] {
            let sum = spline.partial_sum(orders).unwrap().unwrap();
            for x in [[0.5, 0.3, 0.2], [2.5, 1.0, 0.9], [4.0, 3.99, 0.0], [3.0, 0.5, 1.0 / 3.0]] {
                let expected = spline.derivatives(x, 3, sides).unwrap().get(orders).unwrap();
                let error = (sum.evaluate(x, sides).unwrap() - expected).length();
                assert!(error < 1e-10 * (1.0 + expected.length()), "{orders:?} at {x:?}: off by {error}");
            }
        }
        assert_eq!(spline.partial_sum([0, 0, 2]), Ok(None), "above the degree");
        let smooth = spline.partial(0).unwrap().partial(1).unwrap();
        let swapped = spline.partial(1).unwrap().partial(0).unwrap();
        let x = [1.3, 2.0, 0.5];
        let expected = spline.derivatives(x, 1, [Side::Right; 3]).unwrap().get([1, 1, 0]).unwrap();
        for other in [smooth, swapped] {
            let error = (other.evaluate(x).unwrap() - expected).length();
            assert!(error < 1e-11, "∂₀∂₁: off by {error}");
        }
        assert_eq!(spline.partial(2).unwrap_err().name(), "NotInSpace", "degree 1 jumps");
    }
}
