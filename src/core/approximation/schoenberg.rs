//! Schoenberg's scheme `Qf = Σ f(ξₖⁿ) bₖ` with the knot averages `ξₖⁿ = (ξₖ₊₁ + … + ξₖ₊ₙ)/n`.
//!
//! It reproduces lines, keeps the signs of `f`, `f′` and `f″`, and has second order.
//!
//! I. J. Schoenberg, *On spline functions*, 1967. Course: section 5.1.

use crate::core::approximation::data::check_finite;
use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::{Spline, SplineSpace};
use crate::core::point::Point;

/// `Qf` for `f`, which is taken at the knot averages; those of simple exterior knots lie partly outside D.
///
/// # Errors
///
/// `NonFinite` with the index of the average where `f` has no finite value.
pub fn schoenberg<P: Point>(
    space: SplineSpace,
    f: impl Fn(f64) -> P,
) -> Result<Spline<P>, ApproximationError> {
    let coefficients: Vec<P> = space.greville_abscissae().into_iter().map(f).collect();
    check_finite("value of the function at knot average", &coefficients)?;
    Ok(Spline::new(space, coefficients)?)
}

/// `[ξₗ₋ₙⁿ, ξₗⁿ]` for `x ∈ [ξₗ, ξₗ₊₁]`: where `Qf(x)` looks at `f`.
///
/// # Errors
///
/// `NonFinite`, `OutsideInterval`.
pub fn schoenberg_interval(space: &SplineSpace, x: f64) -> Result<(f64, f64), ApproximationError> {
    let (n, reduced) = (space.degree(), space.reduce(x)?);
    let span = space.span(reduced)?;
    let average = |k: usize| {
        let knots = &space.evaluation_knots()[k + 1..=k + n];
        knots[0] + knots.iter().map(|knot| knot - knots[0]).sum::<f64>() / n as f64
    };
    Ok((average(span - n) + (x - reduced), average(span) + (x - reduced)))
}

/// `½ h(x)² max|f″|` with the distance `h(x)` from `x` to the farther end of [`schoenberg_interval`]; `second_derivative` bounds `|f″|` there.
///
/// # Errors
///
/// `NonFinite`, `OutsideInterval`.
pub fn schoenberg_error_bound(
    space: &SplineSpace,
    x: f64,
    second_derivative: f64,
) -> Result<f64, ApproximationError> {
    let (left, right) = schoenberg_interval(space, x)?;
    let h = (right - x).max(x - left);
    Ok(0.5 * second_derivative * h * h)
}

/// Breaks `left + (j/N)^exponent (right − left)`, `j = 0 … N = intervals`, which crowd at the left end for an exponent above 1.
///
/// # Errors
///
/// `NonFinite`, `EmptyInterval`, `TooFewData` for no interval, `OutsideInterval` unless the exponent is positive and finite.
pub fn graded_breaks(
    left: f64,
    right: f64,
    intervals: usize,
    exponent: f64,
) -> Result<Vec<f64>, ApproximationError> {
    check_finite("end of the interval", &[left, right])?;
    if left >= right {
        return Err(ApproximationError::EmptyInterval { left, right });
    }
    if intervals == 0 {
        return Err(ApproximationError::TooFewData { what: "intervals", least: 1, found: 0 });
    }
    if !(exponent > 0.0 && exponent.is_finite()) {
        return Err(ApproximationError::OutsideInterval {
            what: "exponent",
            index: 0,
            value: exponent,
            left: 0.0,
            right: f64::INFINITY,
        });
    }
    let share = |j: usize| (j as f64 / intervals as f64).powf(exponent);
    Ok((0..=intervals).map(|j| left.mix(right, share(j))).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::EndKnots;
    use proptest::prelude::*;

    prop_compose! {
        fn any_space()(degree in 1_usize..8, closed in any::<bool>())(
            degree in Just(degree),
            closed in Just(closed),
            gaps in prop::collection::vec(0_u8..4, 2 * degree + 1..2 * degree + 10),
        ) -> Option<SplineSpace> {
            let mut knots = vec![-2.0];
            knots.extend(gaps.iter().scan(-2.0, |at, gap| {
                *at += f64::from(*gap);
                Some(*at)
            }));
            let period = knots[knots.len() - 1] + 3.0;
            if closed { SplineSpace::periodic(degree, period, knots) } else { SplineSpace::new(degree, knots) }.ok()
        }
    }

    proptest! {
        #[test]
        fn lines_are_kept_and_convex_functions_lie_below(space in any_space(), share in 0.0..=1.0_f64) {
            let Some(space) = space.filter(|space| !space.is_periodic()) else { return Ok(()) };
            let (left, right) = space.parameter_interval();
            let x = left.mix(right, share);
            let line = schoenberg(space.clone(), |x| 3.0 - 2.0 * x).unwrap();
            prop_assert!((line.evaluate(x).unwrap() - (3.0 - 2.0 * x)).abs() < 1e-11, "line at {}", x);
            let square = schoenberg(space.clone(), |x| x * x).unwrap().evaluate(x).unwrap();
            let bound = schoenberg_error_bound(&space, x, 2.0).unwrap();
            prop_assert!(square >= x * x - 1e-10, "x² is convex");
            prop_assert!(square - x * x <= bound + 1e-10, "error {} and bound {}", square - x * x, bound);
        }

        #[test]
        fn values_lie_between_those_of_the_function(space in any_space(), share in -2.0..=2.0_f64) {
            let Some(space) = space else { return Ok(()) };
            let (left, right) = space.parameter_interval();
            let x = if space.is_periodic() { share * (right - left) } else { left.mix(right, share.abs() / 2.0) };
            let value = schoenberg(space.clone(), |x| (3.0 * x).sin()).unwrap().evaluate(x).unwrap();
            prop_assert!(value.abs() <= 1.0, "|{}| > 1", value);
            let (low, high) = schoenberg_interval(&space, x).unwrap();
            let knots = space.evaluation_knots();
            prop_assert!(low <= high && high - low <= knots[knots.len() - 1] - knots[0], "{} {}", low, high);
        }
    }

    #[test]
    fn halving_the_intervals_quarters_the_error() {
        let error = |intervals: usize| {
            let space = SplineSpace::from_breaks(
                3,
                &graded_breaks(0.0, 1.0, intervals, 1.0).unwrap(),
                EndKnots::Interpolating,
            );
            let spline = schoenberg(space.unwrap(), f64::exp).unwrap();
            (0..=300)
                .map(|i| f64::from(i) / 300.0)
                .map(|x| (spline.evaluate(x).unwrap() - x.exp()).abs())
                .fold(0.0, f64::max)
        };
        let ratio = error(40) / error(80);
        assert!((ratio - 4.0).abs() < 0.1, "the ratio is {ratio}");
    }

    #[test]
    fn bad_input_is_named() {
        let space = SplineSpace::uniform(2, 0.0, 1.0, 4).unwrap();
        let error = schoenberg(space, f64::sqrt).unwrap_err();
        assert!(matches!(error, ApproximationError::NonFinite { index: 0, .. }), "average −1/8: {error}");
        let name = |left, right, intervals, exponent| {
            graded_breaks(left, right, intervals, exponent).unwrap_err().name()
        };
        assert_eq!(name(0.0, 1.0, 4, 0.0), "OutsideInterval", "exponent");
        assert_eq!(name(1.0, 1.0, 4, 1.0), "EmptyInterval", "interval");
        assert_eq!(name(0.0, f64::NAN, 4, 1.0), "NonFinite", "end");
        assert_eq!(name(0.0, 1.0, 0, 1.0), "TooFewData", "intervals");
    }
}
