//! Truncated power series `u₀ + u₁ t + … + uₖ tᵏ` through the functions of a formula.
//!
//! Each function satisfies a differential equation that gives the coefficients one after the other, for example
//! `v = exp u`: `v′ = u′ v`, hence `k vₖ = Σⱼ j uⱼ vₖ₋ⱼ`. Where a function has a kink, the branch for small `t > 0` is taken.
//!
//! A. Griewank, A. Walther, *Evaluating Derivatives*, 2008, chapter 13.

use std::cmp::Ordering;

use crate::core::formula::program::{Binary, Unary, power};

/// Replaces `u` by `function(u)`; `spare` holds two more series.
pub(super) fn unary(function: Unary, u: &mut [f64], spare: &mut [f64]) {
    let (first, second) = spare.split_at_mut(u.len());
    let value = function.of(u[0]);
    match function {
        Unary::Negate => u.iter_mut().for_each(|c| *c = -*c),
        Unary::Sin => sine_cosine(u, first, second, -1.0, |a| (a.sin(), a.cos())),
        Unary::Cos => {
            sine_cosine(u, first, second, -1.0, |a| (a.sin(), a.cos()));
            u.copy_from_slice(second);
        }
        Unary::Sinh => sine_cosine(u, first, second, 1.0, |a| (a.sinh(), a.cosh())),
        Unary::Cosh => {
            sine_cosine(u, first, second, 1.0, |a| (a.sinh(), a.cosh()));
            u.copy_from_slice(second);
        }
        Unary::Tan => riccati(u, first, second, 1.0),
        Unary::Tanh => riccati(u, first, second, -1.0),
        Unary::Asin | Unary::Acos => {
            // v′ = u′ (1 − u²)^(−1/2), with the sign of the function.
            product(u, u, first, 0);
            first.iter_mut().for_each(|c| *c = -*c);
            first[0] += 1.0;
            real_power(first, second, -0.5);
            let sign = if function == Unary::Asin { 1.0 } else { -1.0 };
            integrate_product(u, first, second, sign);
        }
        Unary::Atan => {
            product(u, u, first, 0);
            first[0] += 1.0;
            real_power(first, second, -1.0);
            integrate_product(u, first, second, 1.0);
        }
        Unary::Exp => {
            first.copy_from_slice(u);
            exponential(u, first);
        }
        Unary::Log => logarithm(u, first),
        Unary::Log10 => {
            logarithm(u, first);
            u.iter_mut().for_each(|c| *c /= std::f64::consts::LN_10);
        }
        Unary::Sqrt => real_power(u, first, 0.5),
        Unary::Cbrt => {
            let negative = to_the_right(u) == Ordering::Less;
            if negative {
                u.iter_mut().for_each(|c| *c = -*c);
            }
            real_power(u, first, 1.0 / 3.0);
            if negative {
                u.iter_mut().for_each(|c| *c = -*c);
            }
        }
        Unary::Abs => {
            if to_the_right(u) == Ordering::Less {
                u.iter_mut().for_each(|c| *c = -*c);
            }
        }
        Unary::Sign | Unary::Floor | Unary::Ceil | Unary::Step => u[1..].fill(0.0),
    }
    u[0] = value;
}

/// Replaces `u` by `function(u, v)`; `v` may be overwritten, `spare` holds two more series.
pub(super) fn binary(function: Binary, u: &mut [f64], v: &mut [f64], spare: &mut [f64]) {
    let (first, second) = spare.split_at_mut(u.len());
    let value = function.of(u[0], v[0]);
    match function {
        Binary::Add => u.iter_mut().zip(v.iter()).for_each(|(a, b)| *a += b),
        Binary::Subtract => u.iter_mut().zip(v.iter()).for_each(|(a, b)| *a -= b),
        Binary::Multiply => {
            product(u, v, first, 0);
            u.copy_from_slice(first);
        }
        Binary::Divide => quotient(u, v),
        Binary::Power if v[1..].iter().all(|&c| c == 0.0) => real_power(u, first, v[0]),
        Binary::Power => {
            logarithm(u, first);
            product(u, v, first, 0);
            exponential(u, first);
        }
        Binary::Min | Binary::Max => {
            first.iter_mut().zip(u.iter().zip(v.iter())).for_each(|(d, (a, b))| *d = a - b);
            let other = if function == Binary::Min { Ordering::Greater } else { Ordering::Less };
            if to_the_right(first) == other {
                u.copy_from_slice(v);
            }
        }
        Binary::Atan2 => {
            // w′ = (v u′ − u v′)/(u² + v²), one order shorter than u and v.
            for k in 1..u.len() {
                first[k - 1] = (0..=k).map(|j| (2.0 * j as f64 - k as f64) * u[j] * v[k - j]).sum();
            }
            let last = u.len() - 1;
            first[last] = 0.0;
            sum_of_squares(u, v, second);
            quotient(first, second);
            for k in (1..u.len()).rev() {
                u[k] = first[k - 1] / k as f64;
            }
        }
        Binary::Hypot => {
            sum_of_squares(u, v, first);
            u.copy_from_slice(first);
            real_power(u, second, 0.5);
        }
    }
    u[0] = value;
}

/// The sign of the series for small `t > 0`.
fn to_the_right(u: &[f64]) -> Ordering {
    let leading = u.iter().copied().find(|&c| c != 0.0).unwrap_or(0.0);
    leading.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// Coefficients from `start` on of `u v`.
fn product(u: &[f64], v: &[f64], result: &mut [f64], start: usize) {
    for k in start..result.len() {
        result[k] = (0..=k).map(|j| u[j] * v[k - j]).sum();
    }
}

fn sum_of_squares(u: &[f64], v: &[f64], result: &mut [f64]) {
    for k in 0..result.len() {
        result[k] = (0..=k).map(|j| u[j] * u[k - j] + v[j] * v[k - j]).sum();
    }
}

/// `u / v` in `u`.
fn quotient(u: &mut [f64], v: &[f64]) {
    for k in 0..u.len() {
        let known: f64 = (0..k).map(|j| u[j] * v[k - j]).sum();
        u[k] = (u[k] - known) / v[0];
    }
}

/// `result = exp u`.
fn exponential(result: &mut [f64], u: &[f64]) {
    result[0] = u[0].exp();
    for k in 1..u.len() {
        let sum: f64 = (1..=k).map(|j| j as f64 * u[j] * result[k - j]).sum();
        result[k] = sum / k as f64;
    }
}

/// `log u` in `u`: `u v′ = u′`.
fn logarithm(u: &mut [f64], spare: &mut [f64]) {
    spare.copy_from_slice(u);
    u[0] = u[0].ln();
    for k in 1..spare.len() {
        let known: f64 = (1..k).map(|j| j as f64 * u[j] * spare[k - j]).sum();
        u[k] = (spare[k] - known / k as f64) / spare[0];
    }
}

/// `uʳ` in `u`. A zero of multiplicity `q` at `t = 0` becomes one of multiplicity `q r`, if that is an integer.
fn real_power(u: &mut [f64], spare: &mut [f64], exponent: f64) {
    let length = u.len();
    if exponent == 0.0 {
        u[1..].fill(0.0);
        u[0] = 1.0;
        return;
    }
    let Some(zeros) = u.iter().position(|&c| c != 0.0) else {
        u[0] = power(0.0, exponent);
        return;
    };
    let shift = zeros as f64 * exponent;
    if shift >= length as f64 {
        return u.fill(0.0);
    }
    let whole = shift >= 0.0 && shift.fract() == 0.0;
    let start = if whole { shift as usize } else { shift.ceil().max(0.0) as usize };
    spare.copy_from_slice(u);
    u[..start].fill(0.0);
    if !whole {
        return u[start..].fill(f64::NAN);
    }
    let base = &spare[zeros..];
    u[start] = power(base[0], exponent);
    for k in 1..length - start {
        // u v′ = r u′ v
        let sum: f64 = (1..=k.min(base.len() - 1))
            .map(|j| (exponent * j as f64 - (k - j) as f64) * base[j] * u[start + k - j])
            .sum();
        // Coefficients beyond the known ones of the base are not known.
        u[start + k] = if k < base.len() { sum / (k as f64 * base[0]) } else { f64::NAN };
    }
}

/// Sine and cosine (`sign` −1) or their hyperbolic twins (`sign` 1): the sine in `u`, the cosine in `cosine`.
fn sine_cosine(u: &mut [f64], spare: &mut [f64], cosine: &mut [f64], sign: f64, both: fn(f64) -> (f64, f64)) {
    spare.copy_from_slice(u);
    (u[0], cosine[0]) = both(spare[0]);
    for k in 1..spare.len() {
        let (mut sine, mut other) = (0.0, 0.0);
        for j in 1..=k {
            sine += j as f64 * spare[j] * cosine[k - j];
            other += j as f64 * spare[j] * u[k - j];
        }
        u[k] = sine / k as f64;
        cosine[k] = sign * other / k as f64;
    }
}

/// `v′ = u′ (1 + sign v²)`: the tangent, or with −1 the hyperbolic one, in `u`.
fn riccati(u: &mut [f64], spare: &mut [f64], slope: &mut [f64], sign: f64) {
    spare.copy_from_slice(u);
    u[0] = if sign > 0.0 { spare[0].tan() } else { spare[0].tanh() };
    slope[0] = 1.0 + sign * u[0] * u[0];
    for k in 1..spare.len() {
        let sum: f64 = (1..=k).map(|j| j as f64 * spare[j] * slope[k - j]).sum();
        u[k] = sum / k as f64;
        slope[k] = sign * (0..=k).map(|j| u[j] * u[k - j]).sum::<f64>();
    }
}

/// `∫ sign u′ slope` in `u`; the constant is left to the caller.
fn integrate_product(u: &mut [f64], slope: &[f64], spare: &mut [f64], sign: f64) {
    for k in 1..u.len() {
        let sum: f64 = (1..=k).map(|j| j as f64 * u[j] * slope[k - j]).sum();
        spare[k] = sign * sum / k as f64;
    }
    u[1..].copy_from_slice(&spare[1..]);
}
