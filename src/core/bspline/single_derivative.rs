//! Derivatives of one B-spline as sums of B-splines of lower degree over the same knots.
//!
//! `(bⁿₖ)′ = αⁿₖ bⁿ⁻¹ₖ − αⁿₖ₊₁ bⁿ⁻¹ₖ₊₁`, `αⁿₖ = n/(ξₖ₊ₙ − ξₖ)`, without the terms with an empty support. Course: section 4.2.

use crate::core::bspline::basis::{basis_function, check_knots};
use crate::core::bspline::error::{Side, SplineError};

/// The coefficients of the derivative of `order` in the `order + 1` B-splines of degree `degree − order` with these knots.
///
/// The coefficient of a B-spline with empty support is 0; above the degree there are no B-splines, and the list is empty.
///
/// ```
/// # use spline_lab::core::bspline::basis_derivative_coefficients;
/// assert_eq!(basis_derivative_coefficients(3, &[0.0, 1.0, 2.0, 3.0, 4.0], 2), Ok(vec![1.0, -2.0, 1.0]));
/// ```
///
/// # Errors
///
/// As [`basis_function`].
pub fn basis_derivative_coefficients(
    degree: usize,
    knots: &[f64],
    order: usize,
) -> Result<Vec<f64>, SplineError> {
    check_knots(degree, knots)?;
    if order > degree {
        return Ok(Vec::new());
    }
    let mut coefficients = vec![1.0];
    for step in 0..order {
        let n = degree - step;
        let at = |k: Option<usize>| k.and_then(|k| coefficients.get(k)).copied().unwrap_or(0.0);
        let difference = |k: usize| {
            let width = knots[k + n] - knots[k];
            if width > 0.0 { (at(Some(k)) - at(k.checked_sub(1))) * (n as f64 / width) } else { 0.0 }
        };
        coefficients = (0..=step + 1).map(difference).collect();
    }
    Ok(coefficients)
}

/// The derivative of `order` of one B-spline at `x`, the limit from `side` at a knot; order 0 is the value.
///
/// # Errors
///
/// As [`basis_function`].
pub fn basis_derivative(
    degree: usize,
    knots: &[f64],
    x: f64,
    order: usize,
    side: Side,
) -> Result<f64, SplineError> {
    let coefficients = basis_derivative_coefficients(degree, knots, order)?;
    if !x.is_finite() {
        return Err(SplineError::NonFinite { what: "parameter", index: 0, value: x });
    }
    let mut sum = 0.0;
    for (k, coefficient) in coefficients.iter().enumerate() {
        let n = degree - order;
        let local = &knots[k..k + n + 2];
        let value = match side {
            Side::Right => basis_function(n, local, x)?,
            Side::Left => {
                // Mirrored, the limit from the left is the one from the right.
                let mirrored: Vec<f64> = local.iter().rev().map(|knot| -knot).collect();
                basis_function(n, &mirrored, -x)?
            }
        };
        sum += coefficient * value;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{basis_segments, basis_smoothness};
    use proptest::prelude::*;

    /// Knots of one B-spline from gaps; `None` if they are all equal.
    fn knots(gaps: &[u8]) -> Option<Vec<f64>> {
        let mut knots = vec![0.0];
        for gap in gaps {
            knots.push(knots[knots.len() - 1] + f64::from(*gap));
        }
        (knots[knots.len() - 1] > 0.0).then_some(knots)
    }

    fn derivative_of(coefficients: &[f64], order: usize, x: f64) -> f64 {
        let mut polynomial = coefficients.to_vec();
        for _ in 0..order {
            polynomial = polynomial.iter().enumerate().skip(1).map(|(j, c)| c * j as f64).collect();
        }
        polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_segments(gaps in prop::collection::vec(0_u8..3, 2..8), order in 0_usize..7, t in 0.0..1.0_f64) {
            let Some(knots) = knots(&gaps) else { return Ok(()) };
            let degree = knots.len() - 2;
            let segments = basis_segments(degree, &knots).unwrap();
            for (i, pair) in knots.windows(2).enumerate().filter(|(_, pair)| pair[0] < pair[1]) {
                let x = pair[0] + (pair[1] - pair[0]) * t;
                let found = basis_derivative(degree, &knots, x, order, Side::Right).unwrap();
                let expected = derivative_of(&segments[i], order, x);
                prop_assert!((found - expected).abs() < 1e-7 * expected.abs().max(1.0), "{x}: {found}, {expected}");
            }
        }

        #[test]
        fn derivatives_jump_first_at_the_order_that_the_multiplicity_says(gaps in prop::collection::vec(0_u8..3, 2..8)) {
            let Some(knots) = knots(&gaps) else { return Ok(()) };
            let degree = knots.len() - 2;
            for knot in basis_smoothness(degree, &knots).unwrap() {
                for order in 0..=degree {
                    let limit = |side| basis_derivative(degree, &knots, knot.knot, order, side).unwrap();
                    let jump = (limit(Side::Right) - limit(Side::Left)).abs();
                    if order as isize <= knot.order {
                        prop_assert!(jump < 1e-8, "order {order} at {}: jump {jump}", knot.knot);
                    } else if order as isize == knot.order + 1 {
                        prop_assert!(jump > 1e-8, "order {order} at {}: no jump", knot.knot);
                    }
                }
            }
        }

        #[test]
        fn the_derivative_changes_its_sign_once(gaps in prop::collection::vec(0_u8..4, 3..8)) {
            let Some(knots) = knots(&gaps) else { return Ok(()) };
            let (degree, end) = (knots.len() - 2, knots[knots.len() - 1]);
            let signs: Vec<bool> = (1..400)
                .map(|i| basis_derivative(degree, &knots, end * f64::from(i) / 400.0, 1, Side::Right).unwrap())
                .filter(|slope| slope.abs() > 1e-12)
                .map(|slope| slope > 0.0)
                .collect();
            let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            prop_assert!(changes <= 1 && signs.windows(2).all(|pair| pair[0] || !pair[1]), "up, then down: {changes}");
        }
    }

    #[test]
    fn left_limits_see_the_left_piece() {
        let knots = [0.0, 0.0, 0.0, 1.0];
        assert_eq!(basis_derivative(2, &knots, 0.0, 0, Side::Left), Ok(0.0), "before the jump");
        assert_eq!(basis_derivative(2, &knots, 0.0, 0, Side::Right), Ok(1.0), "after the jump");
        assert_eq!(basis_derivative(2, &knots, 0.5, 3, Side::Right), Ok(0.0), "above the degree");
        assert_eq!(
            basis_derivative(2, &knots, f64::NAN, 1, Side::Left).unwrap_err().name(),
            "NonFinite",
            "NaN"
        );
    }
}
