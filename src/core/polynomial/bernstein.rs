//! The Bernstein polynomials `bⁿₖ(x) = C(n,k) (1 − x)ⁿ⁻ᵏ xᵏ`.
//!
//! On `[0, 1]` they are nonnegative with sum 1, `bⁿₖ(1 − x) = bⁿₙ₋ₖ(x)`, and `bⁿₖ` has its only maximum at `k/n`. All at once
//! come from the recursion `bⁿₖ = x bⁿ⁻¹ₖ₋₁ + (1 − x) bⁿ⁻¹ₖ`. Course: sections 1.4 and 1.5.

use crate::core::point::Point as _;
use crate::core::polynomial::error::{PolynomialError, check_finite, check_interval};

/// `bⁿₖ(x)`, for any degree; 0 for `k < 0` and `k > n`, not a number if `x` is none or infinite.
///
/// The factors of the product are taken in an order that keeps the partial products near 1, so that neither the binomial
/// overflows nor the powers underflow before their product does. Linear in the smaller of `k` and `n − k`.
///
/// ```
/// use spline_lab::core::polynomial::bernstein;
///
/// assert_eq!(bernstein(3, 1, 0.25), 27.0 / 64.0);
/// assert!((bernstein(1000, 500, 0.5) - 0.025_225_018_178_360_8).abs() < 1e-15);
/// ```
pub fn bernstein(n: usize, k: isize, x: f64) -> f64 {
    let Ok(k) = usize::try_from(k) else { return 0.0 };
    if k > n || !x.is_finite() {
        return if k > n { 0.0 } else { f64::NAN };
    }
    // C(n,k) is the product of (n − j)/(k − j) over the smaller half of the factors.
    let (few, small, large) = if 2 * k <= n { (k, x, 1.0 - x) } else { (n - k, 1.0 - x, x) };
    let mut left = n - few;
    let mut value: f64 = 1.0;
    for j in 0..few {
        value *= (n - j) as f64 / (few - j) as f64 * small;
        while value.abs() > 1.0 && left > 0 && large.abs() < 1.0 {
            value *= large;
            left -= 1;
        }
    }
    value * large.powf(left as f64)
}

/// Derivative of `bⁿₖ` at `x`: `n (bⁿ⁻¹ₖ₋₁(x) − bⁿ⁻¹ₖ(x))`.
pub fn bernstein_derivative(n: usize, k: isize, x: f64) -> f64 {
    if n == 0 {
        return 0.0;
    }
    n as f64 * (bernstein(n - 1, k - 1, x) - bernstein(n - 1, k, x))
}

/// Where a Bernstein polynomial is largest on `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BernsteinMaximum {
    /// `k/n`; 0 for `n = 0`, where every point is one.
    pub at: f64,
    /// `bⁿₖ(k/n)`.
    pub value: f64,
}

/// The maximum of `bⁿₖ` on `[0, 1]`; `None` unless `k ≤ n`.
pub fn bernstein_maximum(n: usize, k: usize) -> Option<BernsteinMaximum> {
    let at = if n == 0 { 0.0 } else { k as f64 / n as f64 };
    (k <= n).then(|| BernsteinMaximum { at, value: bernstein(n, isize::try_from(k).unwrap_or(-1), at) })
}

/// Writes `bⁿ₀(x) … bⁿₙ(x)` into `values`; the degree `n` is one less than their number.
///
/// Quadratic in the degree, without an allocation, stable on `[0, 1]`.
pub fn write_bernstein_values(x: f64, values: &mut [f64]) {
    let Some(first) = values.first_mut() else { return };
    *first = 1.0;
    for n in 1..values.len() {
        values[n] = x * values[n - 1];
        for k in (1..n).rev() {
            values[k] = x * values[k - 1] + (1.0 - x) * values[k];
        }
        values[0] *= 1.0 - x;
    }
}

/// All `n + 1` Bernstein polynomials at `x`, as [`write_bernstein_values`].
pub fn bernstein_values(n: usize, x: f64) -> Vec<f64> {
    let mut values = vec![0.0; n + 1];
    write_bernstein_values(x, &mut values);
    values
}

/// The matrix with the rows `bⁿ₀(xᵢ) … bⁿₙ(xᵢ)`: it turns Bernstein coefficients into values at the points.
pub fn bernstein_matrix(n: usize, points: &[f64]) -> Vec<Vec<f64>> {
    points.iter().map(|&x| bernstein_values(n, x)).collect()
}

/// Bernstein coefficients `f(a + k (b − a)/n)` of the Bernstein approximation of `f` on `[a, b]`; for `n = 0` the value at `a`.
///
/// It has the values of `f` at both ends, keeps signs, monotonicity and convexity, and is `f` if that is linear; the error
/// decreases like `1/n`. S. N. Bernstein, 1912.
///
/// # Errors
///
/// `NonFinite` (an end, or a value of `f` with its index), `EmptyInterval`.
pub fn bernstein_approximation(
    mut f: impl FnMut(f64) -> f64,
    n: usize,
    interval: (f64, f64),
) -> Result<Vec<f64>, PolynomialError> {
    check_interval(interval)?;
    let share = |k: usize| if n == 0 { 0.0 } else { k as f64 / n as f64 };
    let values: Vec<f64> = (0..=n).map(|k| f(interval.0.mix(interval.1, share(k)))).collect();
    check_finite("value", &values)?;
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::polynomial::sign_changes;
    use crate::core::triangular_scheme::collapse;
    use proptest::prelude::*;

    fn signed(k: usize) -> isize {
        isize::try_from(k).unwrap()
    }

    #[test]
    fn high_degrees_neither_overflow_nor_underflow() {
        let n = 3000;
        for x in [0.001, 0.3, 0.5, 0.97] {
            let sum: f64 = (0..=n).map(|k| bernstein(n, signed(k), x)).sum();
            assert!((sum - 1.0).abs() < 1e-10, "sum {sum} at {x}");
            let mean: f64 = (0..=n).map(|k| k as f64 * bernstein(n, signed(k), x)).sum();
            assert!((mean - n as f64 * x).abs() < 1e-7, "mean {mean} at {x}");
        }
        assert_eq!(bernstein(100_000, 50_000, 0.01), 0.0, "underflow to 0 is right");
    }

    #[test]
    fn zeros_at_the_ends_have_their_orders() {
        for n in 0..8 {
            for k in 0..=n {
                assert_eq!(bernstein(n, signed(k), 0.0), f64::from(u8::from(k == 0)), "{n}, {k} at 0");
                assert_eq!(bernstein(n, signed(k), 1.0), f64::from(u8::from(k == n)), "{n}, {k} at 1");
                let ratio = bernstein(n, signed(k), 1e-4) / bernstein(n, signed(k), 1e-5);
                assert!((ratio.log10() - k as f64).abs() < 1e-3, "order {k} at 0, degree {n}");
            }
        }
        assert_eq!(bernstein_maximum(3, 4), None, "no such polynomial");
        assert!(bernstein(3, 1, f64::NAN).is_nan(), "no number");
    }

    proptest! {
        #[test]
        fn values_are_a_partition_of_unity_with_the_recursion_and_symmetry(n in 1_usize..40, x in 0.0..=1.0_f64) {
            let values = bernstein_values(n, x);
            prop_assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14, "sum");
            let lower = bernstein_values(n - 1, x);
            let mirrored = bernstein_values(n, 1.0 - x);
            for k in 0..=n {
                let value = bernstein(n, signed(k), x);
                prop_assert!(value >= 0.0 && (value - values[k]).abs() < 1e-13 * value + 1e-300, "{value} {}", values[k]);
                let left = if k == 0 { 0.0 } else { lower[k - 1] };
                let right = lower.get(k).copied().unwrap_or(0.0);
                prop_assert!((x * left + (1.0 - x) * right - values[k]).abs() < 1e-15, "recursion");
                prop_assert!((mirrored[n - k] - values[k]).abs() < 1e-14, "symmetry");
                let best = bernstein_maximum(n, k).unwrap();
                prop_assert!(value <= best.value * (1.0 + 1e-13), "{value} above the maximum {}", best.value);
            }
        }

        #[test]
        fn the_derivative_is_the_limit_of_difference_quotients(n in 0_usize..12, x in 0.1..0.9_f64) {
            for k in -1..=signed(n) + 1 {
                let h = 1e-5;
                let quotient = (bernstein(n, k, x + h) - bernstein(n, k, x - h)) / (2.0 * h);
                prop_assert!((bernstein_derivative(n, k, x) - quotient).abs() < 1e-6, "degree {n}, {k}");
            }
        }

        #[test]
        fn the_approximation_is_linear_and_keeps_signs(
            n in 1_usize..15, a in prop::collection::vec(-1.0..1.0_f64, 6), line in (-1.0..1.0_f64, -1.0..1.0_f64), x in 0.0..=1.0_f64,
        ) {
            let f = |x: f64| (0..6).map(|j| a[j] * (x * j as f64 * 2.0).sin()).sum::<f64>();
            let straight = |x: f64| line.0 + line.1 * x;
            let approximation = |f: &dyn Fn(f64) -> f64| bernstein_approximation(f, n, (0.0, 1.0)).unwrap();
            let value = |mut c: Vec<f64>| collapse(&mut c, x);
            prop_assert!((value(approximation(&straight)) - straight(x)).abs() < 1e-14, "linear functions");
            let sum = value(approximation(&|x| f(x) + 3.0 * straight(x)));
            prop_assert!((sum - value(approximation(&f)) - 3.0 * straight(x)).abs() < 1e-13, "linear");
            let above = value(approximation(&|x| f(x).abs()));
            prop_assert!(above >= value(approximation(&f)) - 1e-14, "monotone in f");
            let of_f: Vec<f64> = (0..=400).map(|i| f(f64::from(i) / 400.0)).collect();
            let c = approximation(&f);
            let of_p: Vec<f64> = (0..=100).map(|i| collapse(&mut c.clone(), f64::from(i) / 100.0)).collect();
            prop_assert!(sign_changes(&of_p) <= sign_changes(&of_f).max(sign_changes(&c)), "variation");
        }
    }

    #[test]
    fn impossible_approximations_are_refused() {
        let name = |f: fn(f64) -> f64, interval| bernstein_approximation(f, 4, interval).unwrap_err().name();
        assert_eq!(name(|x| x, (1.0, 1.0)), "EmptyInterval", "one point");
        assert_eq!(name(|x| 1.0 / x, (0.0, 1.0)), "NonFinite", "a pole");
    }
}
