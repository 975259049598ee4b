//! Monomial form and Bernstein form.
//!
//! `xʲ = Σₖ C(k,j)/C(n,j) bⁿₖ` and `aⱼ = C(n,j) Δʲc₀`, both by tables of additions and differences. With an interval `[a, b]` the
//! Bernstein coefficients belong to `y = (x − a)/(b − a)`, the monomial ones to powers of `x`. Course: section 1.4.

use crate::core::point::Point;
use crate::core::polynomial::error::{PolynomialError, check_coefficients, check_finite, check_interval};

/// Bernstein coefficients over `[a, b]` of `Σ aⱼ xʲ`, constant coefficient first.
///
/// # Errors
///
/// `Empty`, `NonFinite` (also where the result overflows), `EmptyInterval`.
///
/// ```
/// use spline_lab::core::polynomial::bernstein_from_monomial;
///
/// let c = bernstein_from_monomial(&[2.0, -3.0, 0.0, -1.0], (0.0, 1.0)).unwrap();
/// assert_eq!(c, [2.0, 1.0, 0.0, -2.0]);
/// ```
pub fn bernstein_from_monomial<P: Point>(
    monomial: &[P],
    interval: (f64, f64),
) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(monomial)?;
    check_interval(interval)?;
    let n = monomial.len() - 1;
    let mut c = monomial.to_vec();
    shift(&mut c, interval.0);
    let (mut power, mut binomial) = (1.0, 1.0);
    for (j, entry) in c.iter_mut().enumerate() {
        *entry = *entry * (power / binomial);
        power *= interval.1 - interval.0;
        binomial = binomial * (n - j) as f64 / (j + 1) as f64;
    }
    // From the differences Δʲc₀ back to the points.
    for j in (1..=n).rev() {
        for k in j..=n {
            c[k] = c[k] + c[k - 1];
        }
    }
    check_finite("coefficient", &c)?;
    Ok(c)
}

/// Coefficients of `1, x, x², …` of the polynomial with the Bernstein coefficients `c` over `[a, b]`.
///
/// For high degrees this loses digits, however carefully it is computed: see [`monomial_growth`].
///
/// # Errors
///
/// As [`bernstein_from_monomial`].
pub fn bernstein_to_monomial<P: Point>(c: &[P], interval: (f64, f64)) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(c)?;
    check_interval(interval)?;
    let n = c.len() - 1;
    let mut a = c.to_vec();
    for j in 1..=n {
        for k in (j..=n).rev() {
            a[k] = a[k] - a[k - 1];
        }
    }
    let width = interval.1 - interval.0;
    let (mut power, mut binomial) = (1.0, 1.0);
    for (j, entry) in a.iter_mut().enumerate() {
        *entry = *entry * (binomial / power);
        power *= width;
        binomial = binomial * (n - j) as f64 / (j + 1) as f64;
    }
    shift(&mut a, -interval.0);
    check_finite("coefficient", &a)?;
    Ok(a)
}

/// The matrix whose row `j` holds the Bernstein coefficients `C(k,j)/C(n,j)` of `xʲ`; monomial coefficients multiply from the left.
pub fn conversion_matrix(n: usize) -> Vec<Vec<f64>> {
    let row = |j: usize| {
        let mut row = vec![0.0; n + 1];
        row[n] = 1.0;
        // C(k,j)/C(n,j) = (1 − j/(k+1)) C(k+1,j)/C(n,j)
        for k in (j..n).rev() {
            row[k] = row[k + 1] * ((k + 1 - j) as f64 / (k + 1) as f64);
        }
        row
    };
    (0..=n).map(row).collect()
}

/// How much an error can grow from Bernstein to monomial coefficients on `[0, 1]`: `Σ |aⱼ| ≤ 3ⁿ max |cₖ|`, with equality for
/// alternating coefficients. The other way it does not grow.
pub fn monomial_growth(n: usize) -> f64 {
    3.0_f64.powi(i32::try_from(n).unwrap_or(i32::MAX))
}

/// Coefficients with respect to powers of `x − start`, by repeated nested multiplication.
fn shift<P: Point>(a: &mut [P], start: f64) {
    if start == 0.0 {
        return;
    }
    for first in 0..a.len().saturating_sub(1) {
        for k in (first..a.len() - 1).rev() {
            a[k] = a[k] + a[k + 1] * start;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::triangular_scheme::collapse;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_and_back_to_the_condition(c in prop::collection::vec(-8_i32..=8, 1..16)) {
            let c: Vec<f64> = c.into_iter().map(f64::from).collect();
            let monomial = bernstein_to_monomial(&c, (0.0, 1.0)).unwrap();
            let sum: f64 = monomial.iter().map(|a| a.abs()).sum();
            prop_assert!(sum <= 8.0 * monomial_growth(c.len() - 1), "growth {sum}");
            let back = bernstein_from_monomial(&monomial, (0.0, 1.0)).unwrap();
            for (a, b) in back.iter().zip(&c) {
                prop_assert!((a - b).abs() <= 8.0 * monomial_growth(c.len() - 1) * f64::EPSILON, "{a} for {b}");
            }
        }

        #[test]
        fn both_forms_have_the_same_values_on_any_interval(
            a in prop::collection::vec(-2.0..2.0_f64, 1..9), left in -2.0..2.0_f64, width in 0.1..3.0_f64, y in 0.0..=1.0_f64,
        ) {
            let interval = (left, left + width);
            let mut c = bernstein_from_monomial(&a, interval).unwrap();
            let back = bernstein_to_monomial(&c, interval).unwrap();
            let x = left + y * width;
            let (value, again) = (horner(&a, x), horner(&back, x));
            prop_assert!((value - again).abs() < 1e-8 * (1.0 + x.abs().powi(8)), "{value} {again}");
            let computed = collapse(&mut c, y);
            prop_assert!((computed - value).abs() < 1e-11 * (1.0 + 5.0_f64.powi(8)), "{computed} {value}");
        }
    }

    fn horner(a: &[f64], x: f64) -> f64 {
        a.iter().rev().fold(0.0, |value, c| value * x + c)
    }

    #[test]
    fn small_conversions_are_exact() {
        // Dyadic and small: every operation is exact.
        let c = bernstein_from_monomial(&[0.5, 2.0, -1.0], (0.0, 1.0)).unwrap();
        assert_eq!(c, [0.5, 1.5, 1.5], "degree 2");
        assert_eq!(bernstein_to_monomial(&c, (0.0, 1.0)).unwrap(), [0.5, 2.0, -1.0], "back");
        let alternating: Vec<f64> = (0..=20).map(|k| f64::from(1 - 2 * (k % 2))).collect();
        let monomial = bernstein_to_monomial(&alternating, (0.0, 1.0)).unwrap();
        assert_eq!(
            monomial.iter().map(|a| a.abs()).sum::<f64>(),
            monomial_growth(20),
            "the bound is attained"
        );
    }

    #[test]
    fn impossible_conversions_are_refused() {
        let name = |c: &[f64], interval| bernstein_from_monomial(c, interval).unwrap_err().name();
        assert_eq!(name(&[], (0.0, 1.0)), "Empty", "no coefficients");
        assert_eq!(name(&[f64::INFINITY], (0.0, 1.0)), "NonFinite", "infinite");
        assert_eq!(name(&[1.0], (1.0, 0.0)), "EmptyInterval", "reversed");
        assert_eq!(name(&[1e308, 1e308, 1e308], (0.0, 1e10)), "NonFinite", "overflow");
        let back = bernstein_to_monomial(&[1e308, -1e308, 1e308], (0.0, 1.0));
        assert_eq!(back.unwrap_err().name(), "NonFinite", "overflow");
    }
}
