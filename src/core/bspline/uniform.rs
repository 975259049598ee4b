//! The standard uniform B-spline `bⁿ` with knots `0, 1, …, n + 1`.
//!
//! Taylor coefficients of segment `k` in powers of `y = x − k`:
//! `n aⁿₖₗ = k aⁿ⁻¹ₖₗ + aⁿ⁻¹ₖ,ₗ₋₁ + (n + 1 − k) aⁿ⁻¹ₖ₋₁,ₗ − aⁿ⁻¹ₖ₋₁,ₗ₋₁`. Course: section 4.4.

/// `table[k][l]`: coefficient of `(x − k)ˡ` of `bⁿ` on `[k, k + 1)`, for `k, l = 0 … n`; the degree may be 0.
pub fn uniform_taylor(degree: usize) -> Vec<Vec<f64>> {
    let mut table = vec![vec![1.0]];
    for n in 1..=degree {
        let at = |k: Option<usize>, l: Option<usize>| {
            let entry = k.and_then(|k| table.get(k)).zip(l).and_then(|(row, l)| row.get(l));
            entry.copied().unwrap_or(0.0)
        };
        let entry = |k: usize, l: usize| {
            let (left, lower) = (k.checked_sub(1), l.checked_sub(1));
            let rising = k as f64 * at(Some(k), Some(l)) + at(Some(k), lower);
            let falling = (n + 1 - k) as f64 * at(left, Some(l)) - at(left, lower);
            (rising + falling) / n as f64
        };
        table = (0..=n).map(|k| (0..=n).map(|l| entry(k, l)).collect()).collect();
    }
    table
}

/// `bⁿ(x)` by Horner's scheme on the table; 0 outside `[0, n + 1)`, continuous from the right.
pub fn uniform_evaluate(degree: usize, x: f64) -> f64 {
    if !(0.0..(degree + 1) as f64).contains(&x) {
        return 0.0;
    }
    let k = x.floor();
    uniform_taylor(degree)[k as usize].iter().rev().fold(0.0, |sum, a| sum * (x - k) + a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::basis_function;

    #[test]
    fn the_table_is_the_recurrence() {
        for degree in 0..=8 {
            let knots: Vec<f64> = (0..degree + 2).map(|k| k as f64).collect();
            for i in 0..=40 {
                let x = 0.25 * f64::from(i) - 0.5;
                let error = uniform_evaluate(degree, x) - basis_function(degree, &knots, x).unwrap();
                assert!(error.abs() < 1e-14, "degree {degree}, x = {x}: {error}");
            }
        }
    }
}
