//! Values and derivatives of the B-splines that are active at a parameter.
//!
//! The derivative of a B-spline of degree `ℓ` is `ℓ (bₖ/(ξₖ₊ₗ − ξₖ) − bₖ₊₁/(ξₖ₊ₗ₊₁ − ξₖ₊₁))` with B-splines of degree
//! `ℓ − 1`: the recurrence up to degree `n − r`, then `r` such steps, gives the derivatives of order `r`.
//! Course: sections 4.1 and 4.2.

use crate::core::bspline::basis::raise;
use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;

impl SplineSpace {
    /// Writes the derivatives of order `0 … r` of the `n + 1` active B-splines at `x`, one order after the other, into
    /// `derivatives`, which has `(r + 1)(n + 1)` places, and returns the index of the first B-spline.
    ///
    /// Orders above `n` are zero; at a knot the limits from the right (at the right end of D from the left).
    /// Indices count the evaluation knots. Does not allocate.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if the number of places is not a positive multiple of `n + 1`, `NonFinite`, `OutsideInterval`.
    pub fn write_active_derivatives(&self, x: f64, derivatives: &mut [f64]) -> Result<usize, SplineError> {
        let n = self.degree();
        if derivatives.is_empty() || !derivatives.len().is_multiple_of(n + 1) {
            let (expected, found) = ((derivatives.len() / (n + 1)).max(1) * (n + 1), derivatives.len());
            return Err(SplineError::SizeMismatch { what: "places for derivatives", expected, found });
        }
        let x = self.reduce(x)?;
        let span = self.span(x)?;
        for (order, values) in derivatives.chunks_exact_mut(n + 1).enumerate() {
            if order > n {
                values.fill(0.0);
                continue;
            }
            values[0] = 1.0;
            for level in 1..=n - order {
                raise(self.evaluation_knots(), span, level, x, values);
            }
            for level in n - order + 1..=n {
                differentiate(self.evaluation_knots(), span, level, values);
            }
        }
        Ok(span - n)
    }
}

/// From the `level` values of degree `level − 1` in `values` to the `level + 1` derivatives of degree `level`.
fn differentiate(knots: &[f64], span: usize, level: usize, values: &mut [f64]) {
    let mut from_left = 0.0;
    for j in 0..level {
        let width = knots[span + 1 + j] - knots[span + 1 + j - level];
        let share = level as f64 * values[j] / width;
        values[j] = from_left - share;
        from_left = share;
    }
    values[level] = from_left;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{Side, Spline};

    #[test]
    fn all_orders_are_the_derivatives_of_single_splines() {
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 2.0, 2.0, 3.5, 4.0]).unwrap();
        let mut derivatives = [0.0; 20];
        for x in [0.0, 0.3, 0.5, 1.7, 2.0] {
            let first = space.write_active_derivatives(x, &mut derivatives).unwrap();
            for j in 0..4 {
                let unit = (0..space.dimension()).map(|k| f64::from(u8::from(k == first + j))).collect();
                let spline = Spline::new(space.clone(), unit).unwrap();
                let expected = spline.derivatives(x, 4, Side::Right).unwrap();
                for order in 0..=4 {
                    let (got, wanted) = (derivatives[4 * order + j], expected[order]);
                    assert!((got - wanted).abs() < 1e-10, "order {order} at {x}: {got}, expected {wanted}");
                }
            }
        }
    }

    #[test]
    fn wrong_numbers_of_places_are_refused() {
        let space = SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap();
        for count in [0, 4] {
            let error = space.write_active_derivatives(0.5, &mut vec![0.0; count]).unwrap_err();
            assert_eq!(error.name(), "SizeMismatch", "{count} places");
        }
    }
}
