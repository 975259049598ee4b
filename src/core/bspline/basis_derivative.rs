//! Derivatives of the active B-splines, the rows of collocation tables.
//!
//! `dbⁿₖ/dx = n bⁿ⁻¹ₖ/(ξₖ₊ₙ − ξₖ) − n bⁿ⁻¹ₖ₊₁/(ξₖ₊ₙ₊₁ − ξₖ₊₁)`, applied to the values of degree `n − d`. Course: section 4.2.

use crate::core::bspline::basis::raise;
use crate::core::bspline::error::{Side, SplineError};
use crate::core::bspline::space::SplineSpace;

impl SplineSpace {
    /// Writes the derivatives of orders `0 … count` of the `n + 1` active B-splines at `x`, the limits from `side` at a knot.
    ///
    /// Row `d` of `rows` (`n + 1` entries each) holds the derivatives of order `d`; above the degree they are zero. Returns the index
    /// of the first active B-spline among those of the evaluation knots; [`SplineSpace::coefficient_index`] gives the coefficient.
    /// Does not allocate.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless `rows` has `(count + 1)(n + 1)` entries, `NonFinite`, `OutsideInterval`.
    pub fn write_basis_derivatives(
        &self,
        x: f64,
        count: usize,
        side: Side,
        rows: &mut [f64],
    ) -> Result<usize, SplineError> {
        let n = self.degree();
        if rows.len() != (count + 1) * (n + 1) {
            let (expected, found) = ((count + 1) * (n + 1), rows.len());
            return Err(SplineError::SizeMismatch { what: "places for derivatives", expected, found });
        }
        let (span, x) = self.span_on_side(x, side)?;
        let knots = self.evaluation_knots();
        for (order, row) in rows.chunks_exact_mut(n + 1).enumerate() {
            if order > n {
                row.fill(0.0);
                continue;
            }
            row[0] = 1.0;
            for level in 1..=n - order {
                raise(knots, span, level, x, row);
            }
            for degree in n - order + 1..=n {
                // Entry j of the lower degree has the knots span + 1 + j − degree … span + 1 + j, which span [ξₗ, ξₗ₊₁).
                let mut from_left = 0.0;
                for j in 0..degree {
                    let slope = row[j] * degree as f64 / (knots[span + 1 + j] - knots[span + 1 + j - degree]);
                    row[j] = from_left - slope;
                    from_left = slope;
                }
                row[degree] = from_left;
            }
        }
        Ok(span - n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Spline;

    #[test]
    fn rows_times_coefficients_are_the_derivatives_of_the_spline() {
        let open = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 4.0, 5.0, 5.5, 7.0]).unwrap();
        let closed = SplineSpace::periodic(3, 4.0, vec![0.0, 0.0, 1.0, 3.0]).unwrap();
        for space in [open, closed] {
            let coefficients = (0..space.dimension()).map(|k| (k * k % 5) as f64 - 1.0).collect();
            let spline = Spline::new(space.clone(), coefficients).unwrap();
            for (x, side) in [(1.0, Side::Left), (1.0, Side::Right), (0.3, Side::Right), (4.0, Side::Right)] {
                let mut rows = [f64::NAN; 20];
                let first = space.write_basis_derivatives(x, 4, side, &mut rows).unwrap();
                let expected = spline.derivatives(x, 4, side).unwrap();
                for (order, row) in rows.chunks(4).enumerate() {
                    let found: f64 = (0..4).map(|j| row[j] * spline.evaluation_coefficient(first + j)).sum();
                    let error = (found - expected[order]).abs();
                    assert!(error < 1e-11, "order {order} at {x} {side:?}: {found}, {expected:?}");
                }
            }
        }
    }
}
