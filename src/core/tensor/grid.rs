//! Values on a grid of parameters, direction by direction with banded tables.
//!
//! With `q_ν` parameters and `m_ν` coefficients the work is `Σ` instead of `∏` of the factors `n_ν + 1`. Course: section 7.4.

use crate::core::bspline::{Side, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::tensor_product::TensorSpline;

/// Active B-splines and their derivatives at many parameters of one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTable {
    width: usize,
    orders: usize,
    first: Vec<usize>,
    rows: Vec<f64>,
}

impl AxisTable {
    /// Orders `0 … count` at `parameters`, in any order; at knots the limits from the right, at the right end from the left.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn new(space: &SplineSpace, parameters: &[f64], count: usize) -> Result<Self, SplineError> {
        let (width, orders) = (space.degree() + 1, count + 1);
        let mut rows = vec![0.0; parameters.len() * width * orders];
        let first = parameters
            .iter()
            .zip(rows.chunks_exact_mut(width * orders))
            .map(|(&x, rows)| {
                // Only a periodic direction has something to the right of its end.
                let (_, right) = space.parameter_interval();
                let side = if x >= right { Side::Left } else { Side::Right };
                space.write_basis_derivatives(x, count, side, rows)
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { width, orders, first, rows })
    }

    /// Number of parameters.
    pub fn len(&self) -> usize {
        self.first.len()
    }

    /// Whether there are no parameters.
    pub fn is_empty(&self) -> bool {
        self.first.is_empty()
    }

    /// Index of the first active B-spline at parameter `i`, among those of the evaluation knots.
    pub fn first(&self, i: usize) -> usize {
        self.first[i]
    }

    /// The `n + 1` derivatives of the given order at parameter `i`.
    pub fn row(&self, i: usize, order: usize) -> &[f64] {
        let start = (i * self.orders + order) * self.width;
        &self.rows[start..start + self.width]
    }
}

impl<P: Point, const D: usize> TensorSpline<P, D> {
    /// Writes the derivative of orders `orders[ν]` at all points of the grid, row-major with the first direction slowest.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless `values` has one place for each grid point; `NonFinite`, `OutsideInterval` with the axis.
    pub fn evaluate_grid(
        &self,
        parameters: [&[f64]; D],
        orders: [usize; D],
        values: &mut [P],
    ) -> Result<(), TensorError> {
        let expected = parameters.iter().map(|list| list.len()).product();
        if values.len() != expected {
            let found = values.len();
            return Err(TensorError::SizeMismatch { what: "places for grid values", expected, found });
        }
        let mut shape = self.space().shape();
        let mut done = self.coefficients().to_vec();
        for axis in 0..D {
            let space = &self.space().axes()[axis];
            let table =
                AxisTable::new(space, parameters[axis], orders[axis]).map_err(TensorError::on_axis(axis))?;
            let stride: usize = shape[axis + 1..].iter().product();
            let blocks: usize = shape[..axis].iter().product();
            let mut next = vec![P::ZERO; blocks * table.len() * stride];
            for (line, target) in next.chunks_exact_mut(stride.max(1)).enumerate() {
                let (block, i) = (line / table.len(), line % table.len());
                for (j, &weight) in table.row(i, orders[axis]).iter().enumerate() {
                    let start = (block * shape[axis] + space.coefficient_index(table.first(i) + j)) * stride;
                    for (value, &coefficient) in target.iter_mut().zip(&done[start..start + stride]) {
                        *value = *value + coefficient * weight;
                    }
                }
            }
            shape[axis] = table.len();
            done = next;
        }
        values.copy_from_slice(&done);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::tensor::tensor_product::tests::mixed;
    use glam::DVec3;

    #[test]
    fn the_grid_holds_the_values_at_its_points() {
        let spline = mixed();
        let (xs, ys, zs) = ([0.0, 1.0, 3.9, 4.0], [0.2, 3.0, -1.0], [0.0, 1.0]);
        for orders in [[0, 0, 0], [1, 2, 0], [0, 1, 1]] {
            let mut values = [DVec3::NAN; 24];
            spline.evaluate_grid([&xs, &ys, &zs], orders, &mut values).unwrap();
            let mut next = values.iter();
            for x in xs {
                for y in ys {
                    for z in zs {
                        let all = spline.derivatives([x, y, z], 2, [Side::Right; 3]).unwrap();
                        let (expected, found) = (all.get(orders).unwrap(), *next.next().unwrap());
                        let error = (expected - found).length();
                        assert!(error < 1e-11, "{orders:?} at {x}, {y}, {z}: off by {error}");
                    }
                }
            }
        }
        let none: [f64; 0] = [];
        assert_eq!(spline.evaluate_grid([&none, &ys, &zs], [0; 3], &mut []), Ok(()), "an empty grid");
        let short = spline.evaluate_grid([&xs, &ys, &zs], [0; 3], &mut [DVec3::ZERO; 5]);
        assert_eq!(short.unwrap_err().name(), "SizeMismatch", "too few places");
    }
}
