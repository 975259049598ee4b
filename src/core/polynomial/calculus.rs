//! Derivative, integral and degree elevation of a polynomial in Bernstein form.
//!
//! `(Σ cₖ bⁿₖ)′ = n Σ (cₖ₊₁ − cₖ) bⁿ⁻¹ₖ`, and every Bernstein polynomial of degree `n` has the integral `1/(n + 1)` over `[0, 1]`.
//! All on `[0, 1]`; over `[a, b]` a derivative is divided by `b − a`, an integral multiplied. Course: section 1.5.

use crate::core::point::Point;
use crate::core::polynomial::error::{PolynomialError, check_coefficients, check_finite};

/// The `n` coefficients of the derivative; for degree 0 the one coefficient 0.
///
/// # Errors
///
/// `Empty`, `NonFinite` (also where a difference overflows).
pub fn derivative<P: Point>(c: &[P]) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(c)?;
    if c.len() == 1 {
        return Ok(vec![P::ZERO]);
    }
    let n = (c.len() - 1) as f64;
    let derivative: Vec<P> = c.windows(2).map(|pair| (pair[1] - pair[0]) * n).collect();
    check_finite("coefficient", &derivative)?;
    Ok(derivative)
}

/// The `n + 2` coefficients of the antiderivative with the value `start` at 0.
///
/// # Errors
///
/// `Empty`, `NonFinite` (also where a sum overflows).
pub fn antiderivative<P: Point>(c: &[P], start: P) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(c)?;
    let share = (c.len() as f64).recip();
    let mut sums = Vec::with_capacity(c.len() + 1);
    let mut sum = P::ZERO;
    sums.push(start);
    for &coefficient in c {
        sum = sum + coefficient * share;
        sums.push(start + sum);
    }
    check_finite("coefficient", &sums)?;
    Ok(sums)
}

/// The integral over `[0, 1]`: the mean of the coefficients.
///
/// # Errors
///
/// `Empty`, `NonFinite`.
pub fn integral<P: Point>(c: &[P]) -> Result<P, PolynomialError> {
    check_coefficients(c)?;
    let share = (c.len() as f64).recip();
    Ok(c.iter().fold(P::ZERO, |sum, &coefficient| sum + coefficient * share))
}

/// The coefficients of the same polynomial with a degree higher by `times`:
/// each time `c′ₖ = k/(n+1) cₖ₋₁ + (1 − k/(n+1)) cₖ`.
///
/// # Errors
///
/// `Empty`, `NonFinite`.
pub fn elevate<P: Point>(c: &[P], times: usize) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(c)?;
    let mut raised = Vec::with_capacity(c.len() + times);
    raised.extend_from_slice(c);
    for _ in 0..times {
        let count = raised.len();
        raised.push(raised[count - 1]);
        for k in (1..count).rev() {
            raised[k] = raised[k].mix(raised[k - 1], k as f64 / count as f64);
        }
    }
    Ok(raised)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::triangular_scheme::collapse;
    use proptest::prelude::*;

    fn value(c: &[f64], x: f64) -> f64 {
        collapse(&mut c.to_vec(), x)
    }

    proptest! {
        #[test]
        fn integration_and_differentiation_are_inverse(c in prop::collection::vec(-4.0..4.0_f64, 1..15), start in -4.0..4.0_f64) {
            let primitive = antiderivative(&c, start).unwrap();
            prop_assert_eq!(primitive[0], start, "value at 0");
            let ends = primitive[c.len()] - start;
            prop_assert!((ends - integral(&c).unwrap()).abs() < 1e-13, "the fundamental theorem");
            for (a, b) in derivative(&primitive).unwrap().iter().zip(&c) {
                prop_assert!((a - b).abs() < 1e-12, "{a} for {b}");
            }
        }

        #[test]
        fn the_derivative_is_the_limit_of_difference_quotients(c in prop::collection::vec(-4.0..4.0_f64, 1..10), x in 0.0..=1.0_f64) {
            let h = 1e-5;
            let quotient = (value(&c, x + h) - value(&c, x - h)) / (2.0 * h);
            prop_assert!((value(&derivative(&c).unwrap(), x) - quotient).abs() < 1e-5, "at {x}");
        }

        #[test]
        fn elevation_keeps_the_function_and_shortens_the_polygon(
            c in prop::collection::vec(-4.0..4.0_f64, 1..10), times in 0_usize..6, x in 0.0..=1.0_f64,
        ) {
            let raised = elevate(&c, times).unwrap();
            prop_assert_eq!(raised.len(), c.len() + times, "degree");
            prop_assert!((value(&raised, x) - value(&c, x)).abs() < 1e-13, "same values");
            let variation = |c: &[f64]| c.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>();
            prop_assert!(variation(&raised) <= variation(&c) + 1e-13, "total variation");
        }
    }

    #[test]
    fn impossible_coefficients_are_refused() {
        assert_eq!(derivative::<f64>(&[]).unwrap_err().name(), "Empty", "none");
        assert_eq!(derivative(&[1e308, -1e308]).unwrap_err().name(), "NonFinite", "overflow");
        assert_eq!(integral(&[f64::NAN]).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(derivative(&[7.0]), Ok(vec![0.0]), "a constant");
    }
}
