//! B-splines by the recurrence relation.
//!
//! ```text
//! b⁰ₖ(x) = 1 for ξₖ ≤ x < ξₖ₊₁, and 0 elsewhere,
//! bⁿₖ(x) = γⁿₖ(x) bⁿ⁻¹ₖ(x) + (1 − γⁿₖ₊₁(x)) bⁿ⁻¹ₖ₊₁(x),   γⁿₖ(x) = (x − ξₖ)/(ξₖ₊ₙ − ξₖ),
//! ```
//!
//! where a term whose B-spline has an empty support is dropped. A single B-spline is continuous from the right; the active
//! B-splines of a space include the right end of D.
//!
//! C. de Boor, *On calculating with B-splines*, 1972. Course: sections 4.1 and 4.2.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::{MAX_DEGREE, SplineSpace, check_nondecreasing};

/// The B-spline of `degree ≥ 0` with the knots `knots[0] ≤ … ≤ knots[degree + 1]` at `x`, continuous from the right.
///
/// ```
/// # use spline_lab::core::bspline::basis_function;
/// assert_eq!(basis_function(2, &[1.0, 2.0, 5.0, 7.0], 2.0), Ok(0.25));
/// ```
///
/// # Errors
///
/// `SizeMismatch` unless there are `degree + 2` knots, `NonFinite`, `KnotsDecreasing`.
pub fn basis_function(degree: usize, knots: &[f64], x: f64) -> Result<f64, SplineError> {
    check_knots(degree, knots)?;
    if !x.is_finite() {
        return Err(SplineError::NonFinite { what: "parameter", index: 0, value: x });
    }
    let mut values: Vec<f64> = knots.windows(2).map(|pair| f64::from(pair[0] <= x && x < pair[1])).collect();
    for n in 1..=degree {
        for k in 0..=degree - n {
            values[k] = ramp(knots, n, k, x) * values[k] + falling_ramp(knots, n, k + 1, x) * values[k + 1];
        }
    }
    Ok(values[0])
}

/// The polynomial of the B-spline on each of its `degree + 1` knot intervals, as coefficients of `1, x, x², …`; zeros for an empty one.
///
/// # Errors
///
/// As [`basis_function`].
pub fn basis_segments(degree: usize, knots: &[f64]) -> Result<Vec<Vec<f64>>, SplineError> {
    check_knots(degree, knots)?;
    let segment = |interval: usize| {
        let nonempty = knots[interval] < knots[interval + 1];
        let mut rows: Vec<Vec<f64>> =
            (0..=degree).map(|k| vec![f64::from(k == interval && nonempty)]).collect();
        for n in 1..=degree {
            for k in 0..=degree - n {
                let mut raised = vec![0.0; n + 1];
                // The two ramps are (x − ξₖ)/width and (ξₖ₊ₙ₊₁ − x)/width.
                let (left, right) = (knots[k + n] - knots[k], knots[k + n + 1] - knots[k + 1]);
                for j in 0..n {
                    if left > 0.0 {
                        raised[j] -= rows[k][j] * knots[k] / left;
                        raised[j + 1] += rows[k][j] / left;
                    }
                    if right > 0.0 {
                        raised[j] += rows[k + 1][j] * knots[k + n + 1] / right;
                        raised[j + 1] -= rows[k + 1][j] / right;
                    }
                }
                rows[k] = raised;
            }
        }
        rows.swap_remove(0)
    };
    Ok((0..=degree).map(segment).collect())
}

/// The B-splines that can be nonzero at one parameter, level by level of the recurrence.
#[derive(Clone, Debug, PartialEq)]
pub struct BasisTriangle {
    /// Index `l` of the knot interval into the evaluation knots.
    pub span: usize,
    /// `levels[i]` holds `bⁱₖ(x)` for `k = l − i … l`.
    pub levels: Vec<Vec<f64>>,
}

impl SplineSpace {
    /// Writes the `n + 1` B-splines that can be nonzero at `x` into `values` and returns the index of the first.
    ///
    /// Indices count the evaluation knots; [`SplineSpace::coefficient_index`] gives the coefficient. Does not allocate.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if `values` has not `n + 1` entries, `NonFinite`, `OutsideInterval`.
    pub fn write_active_basis(&self, x: f64, values: &mut [f64]) -> Result<usize, SplineError> {
        let n = self.degree();
        if values.len() != n + 1 {
            let (expected, found) = (n + 1, values.len());
            return Err(SplineError::SizeMismatch { what: "places for values", expected, found });
        }
        let x = self.reduce(x)?;
        let span = self.span(x)?;
        self.write_basis_in_span(span, x, 0, values);
        Ok(span - n)
    }

    /// Writes the derivatives of order `derivative` of the B-splines `span − n … span` at `x`, those of the pieces over the knot interval `span`, into `n + 1` places; zeros above
    /// the degree. `span` is an index as [`SplineSpace::span`] returns it.
    #[inline(always)]
    pub(in crate::core) fn write_basis_in_span(
        &self,
        span: usize,
        x: f64,
        derivative: usize,
        values: &mut [f64],
    ) {
        let (n, knots) = (self.degree(), self.evaluation_knots());
        if derivative > n {
            return values.fill(0.0);
        }
        values[0] = 1.0;
        for level in 1..=n - derivative {
            raise(knots, span, level, x, values);
        }
        for level in n - derivative + 1..=n {
            differentiate(knots, span, level, values);
        }
    }

    /// All levels of the recurrence at `x`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn basis_triangle(&self, x: f64) -> Result<BasisTriangle, SplineError> {
        let x = self.reduce(x)?;
        let span = self.span(x)?;
        let mut values = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        let mut levels = vec![vec![1.0]];
        for level in 1..=self.degree() {
            raise(self.evaluation_knots(), span, level, x, &mut values);
            levels.push(values[..=level].to_vec());
        }
        Ok(BasisTriangle { span, levels })
    }
}

/// From the `level` values of degree `level − 1` in `values` to the `level + 1` values of degree `level`.
#[inline(always)]
pub(super) fn raise(knots: &[f64], span: usize, level: usize, x: f64, values: &mut [f64]) {
    // No division by zero: every denominator spans the nonempty interval [ξₗ, ξₗ₊₁).
    let mut from_left = 0.0;
    for j in 0..level {
        let (left, right) = (knots[span + 1 + j - level], knots[span + 1 + j]);
        let share = values[j] / (right - left);
        values[j] = from_left + (right - x) * share;
        from_left = (x - left) * share;
    }
    values[level] = from_left;
}

/// From the `level` values of degree `level − 1` to the `level + 1` derivatives of degree `level`.
fn differentiate(knots: &[f64], span: usize, level: usize, values: &mut [f64]) {
    let mut from_left = 0.0;
    for j in 0..level {
        let width = knots[span + 1 + j] - knots[span + 1 + j - level];
        let share = values[j] * (level as f64 / width);
        values[j] = from_left - share;
        from_left = share;
    }
    values[level] = from_left;
}

fn ramp(knots: &[f64], n: usize, k: usize, x: f64) -> f64 {
    let width = knots[k + n] - knots[k];
    if width > 0.0 { (x - knots[k]) / width } else { 0.0 }
}

fn falling_ramp(knots: &[f64], n: usize, k: usize, x: f64) -> f64 {
    let width = knots[k + n] - knots[k];
    if width > 0.0 { (knots[k + n] - x) / width } else { 0.0 }
}

pub(super) fn check_knots(degree: usize, knots: &[f64]) -> Result<(), SplineError> {
    if knots.len() != degree + 2 {
        let (expected, found) = (degree + 2, knots.len());
        return Err(SplineError::SizeMismatch { what: "knots", expected, found });
    }
    check_nondecreasing(knots)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn active_values_are_the_single_b_splines_and_sum_to_one(
            degree in 1_usize..=12, steps in prop::collection::vec(0_u8..3, 40), at in 0.0..1.0_f64,
        ) {
            let mut knots = vec![0.0];
            for (i, step) in steps.into_iter().enumerate() {
                // A forced step keeps multiplicities at most the degree and the end intervals nonempty.
                let forced = degree == 1 || i % degree == 0 || i == degree || i + degree == 39;
                knots.push(knots[i] + f64::from(step).max(f64::from(u8::from(forced))));
            }
            let Ok(space) = SplineSpace::new(degree, knots.clone()) else { return Ok(()) };
            let (left, right) = space.parameter_interval();
            let x = left + (right - left) * at;
            let mut values = vec![0.0; degree + 1];
            let first = space.write_active_basis(x, &mut values).unwrap();
            let sum: f64 = values.iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-13, "the sum is {sum}");
            for (j, value) in values.iter().enumerate() {
                let single = basis_function(degree, &knots[first + j..first + j + degree + 2], x).unwrap();
                prop_assert!((single - value).abs() < 1e-13, "b{} is {single} and {value}", first + j);
                prop_assert!(*value >= 0.0, "negative: {value}");
            }
        }
    }

    #[test]
    fn segments_agree_with_the_values() {
        let knots = [1.0, 2.0, 2.0, 5.0, 7.0];
        for (interval, coefficients) in basis_segments(3, &knots).unwrap().into_iter().enumerate() {
            let x = 0.5 * (knots[interval] + knots[interval + 1]);
            if knots[interval] < knots[interval + 1] {
                let value = coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
                let expected = basis_function(3, &knots, x).unwrap();
                assert!((value - expected).abs() < 1e-13, "interval {interval}: {value} and {expected}");
            } else {
                assert_eq!(coefficients, [0.0; 4], "empty interval {interval}");
            }
        }
    }

    #[test]
    fn tiny_intervals_are_not_merged() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1e-12, 2e-12, 1.0, 1.0, 2.0]).unwrap();
        let mut values = [0.0; 3];
        assert_eq!(space.write_active_basis(1e-12, &mut values), Ok(1), "the interval that starts at 1e-12");
        assert!(values.iter().all(|value| (0.0..=1.0).contains(value)), "{values:?}");
    }
}
