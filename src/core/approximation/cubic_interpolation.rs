//! Cubic splines through points, with the usual end conditions.
//!
//! C. de Boor, *A Practical Guide to Splines*, 1978, chapter IV; natural ends: J. C. Holladay, 1957. Course: section 5.5.

use crate::core::approximation::cubic_form::{spline_from_moments, write_inner_coefficients};
use crate::core::approximation::data::{check_finite, check_increasing, check_length};
use crate::core::approximation::error::ApproximationError;
use crate::core::approximation::second_derivatives::{EndRow, MARGIN, solve};
use crate::core::bspline::{Spline, SplineSpace};
use crate::core::point::Point;

/// What a cubic spline does at the ends, where its values at the knots leave two conditions free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndConditions<P> {
    /// The second and the last but one site are no knots. Three points give a parabola, two a line.
    NotAKnot,
    /// `p″ = 0` at both ends: the least bending, but second order only.
    Natural,
    /// `p′` at both ends.
    Clamped {
        /// At the first site.
        start: P,
        /// At the last site.
        end: P,
    },
    /// `p″` at both ends.
    SecondDerivative {
        /// At the first site.
        start: P,
        /// At the last site.
        end: P,
    },
    /// Periodic; the last value repeats the first.
    Periodic,
    /// Periodic, the last value not repeated.
    PeriodicOver {
        /// The period.
        period: f64,
    },
}

/// The cubic spline with `p(sites[i]) = values[i]` and simple knots at the sites, exterior ones spaced by the first and the last interval.
///
/// The result is open, with two coefficients more than knots in D, or periodic.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite`, `SitesNotSorted` unless the sites increase strictly; `TooFewData` for fewer than two sites, or three distinct ones if
/// periodic; `NoSolution` if the ends of periodic data differ; `PeriodTooShort`.
pub fn cubic_interpolation<P: Point>(
    sites: &[f64],
    values: &[P],
    ends: EndConditions<P>,
) -> Result<Spline<P>, ApproximationError> {
    check_length("values", sites.len(), values.len())?;
    check_increasing(sites)?;
    check_finite("value", values)?;
    let count = sites.len();
    let least = match ends {
        EndConditions::Periodic => 4,
        EndConditions::PeriodicOver { .. } => 3,
        _ => 2,
    };
    if count < least {
        return Err(ApproximationError::TooFewData { what: "sites", least, found: count });
    }
    let (first, last) = (sites[1] - sites[0], sites[count - 1] - sites[count - 2]);
    let mut moments = vec![P::ZERO; count];
    // The slope of the first and of the last piece, if the spline were a polygon.
    let start_slope = (values[1] - values[0]) * first.recip();
    let end_slope = (values[count - 1] - values[count - 2]) * last.recip();
    let (start_row, end_row) = match ends {
        EndConditions::NotAKnot => return not_a_knot(sites, values, moments),
        EndConditions::Periodic => {
            let gap = (values[count - 1] - values[0]).norm();
            if gap > 0.0 {
                let reason = format!("the last value of periodic data differs from the first, by {gap:e}");
                return Err(ApproximationError::NoSolution { reason });
            }
            return periodic(&sites[..count - 1], &values[..count - 1], sites[count - 1] - sites[0]);
        }
        EndConditions::PeriodicOver { period } => return periodic(sites, values, period),
        EndConditions::Natural => (EndRow::value(P::ZERO), EndRow::value(P::ZERO)),
        EndConditions::SecondDerivative { start, end } => {
            check_finite("end condition", &[start, end])?;
            (EndRow::value(start), EndRow::value(end))
        }
        EndConditions::Clamped { start, end } => {
            check_finite("end condition", &[start, end])?;
            let row =
                |jump: P, width: f64| EndRow { factor: 1.0, diagonal: 2.0, right: jump * (6.0 / width) };
            (row(start_slope - start, first), row(end - end_slope, last))
        }
    };
    solve(sites, values, start_row, end_row, &mut moments);
    spline_from_moments(sites, values, &moments, (first, last), 0)
}

/// The natural cubic spline: among all twice differentiable functions through the points it has the least `∫|p″|²`.
///
/// # Errors
///
/// As [`cubic_interpolation`].
pub fn natural_spline<P: Point>(sites: &[f64], values: &[P]) -> Result<Spline<P>, ApproximationError> {
    cubic_interpolation(sites, values, EndConditions::Natural)
}

fn not_a_knot<P: Point>(
    sites: &[f64],
    values: &[P],
    mut moments: Vec<P>,
) -> Result<Spline<P>, ApproximationError> {
    let last = sites.len() - 1;
    let width = |i: usize| sites[i + 1] - sites[i];
    let outer = (width(0), width(last - 1));
    // Half of the jump of the slopes at site i, times 6.
    let bend = |i: usize| {
        let slope = |i: usize| (values[i + 1] - values[i]) * width(i).recip();
        (slope(i) - slope(i - 1)) * 6.0
    };
    match last {
        1 => return spline_from_moments(sites, values, &moments, outer, 0),
        2 => {
            moments.fill(bend(1) * (3.0 * (width(0) + width(1))).recip());
            let (ends, values) = ([sites[0], sites[2]], [values[0], values[2]]);
            return spline_from_moments(&ends, &values, &moments[..2], outer, 0);
        }
        _ => {}
    }
    // One cubic over the two end intervals, the outer of length `a` and the inner of length `b`: a M₂ = (a + b) M₁ − b M₀, which eliminates M₀ from row 1.
    let row = |i: usize, a: f64, b: f64| EndRow {
        factor: b - a,
        diagonal: a + 2.0 * b,
        right: bend(i) * (b / (a + b)),
    };
    let (start, end) = (row(1, outer.0, width(1)), row(last - 1, outer.1, width(last - 2)));
    solve(&sites[1..last], &values[1..last], start, end, &mut moments[1..last]);
    let extrapolate = |near: P, far: P, a: f64, b: f64| near + (near - far) * (a / b);
    moments[0] = extrapolate(moments[1], moments[2], outer.0, width(1));
    moments[last] = extrapolate(moments[last - 1], moments[last - 2], outer.1, width(last - 2));
    spline_from_moments(sites, values, &moments, outer, 1)
}

/// The data are continued by enough of their copies for the ends not to matter.
fn periodic<P: Point>(sites: &[f64], values: &[P], period: f64) -> Result<Spline<P>, ApproximationError> {
    let count = sites.len();
    let space = SplineSpace::periodic(3, period, sites.to_vec())?;
    let continued = || (0..count + 2 * MARGIN).map(|i| i as isize - MARGIN as isize);
    let x: Vec<f64> = continued().map(|k| space.knot(k).unwrap_or(f64::NAN)).collect();
    let y: Vec<P> = continued().map(|k| values[k.rem_euclid(count as isize) as usize]).collect();
    let mut moments = vec![P::ZERO; x.len()];
    solve(&x, &y, EndRow::value(P::ZERO), EndRow::value(P::ZERO), &mut moments);
    // Coefficient k belongs to the site k + 2, which stands at k + 2 + MARGIN.
    let mut coefficients = vec![P::ZERO; count];
    let from = MARGIN + 1;
    write_inner_coefficients(&x[from..], &y[from..], &moments[from..], &mut coefficients);
    Ok(Spline::new(space, coefficients)?)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::approximation::interpolation::interpolate;
    use crate::core::bspline::Side;
    use glam::DVec2;
    use proptest::prelude::*;

    fn sites(gaps: &[f64]) -> Vec<f64> {
        let mut sites = vec![-0.7];
        for gap in gaps {
            sites.push(sites[sites.len() - 1] + gap);
        }
        sites
    }

    fn gaps(least: usize) -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(prop_oneof![0.05..2.0_f64, Just(1e-3)], least..14)
    }

    proptest! {
        #[test]
        fn cubics_are_reproduced(gaps in gaps(1)) {
            let x = sites(&gaps);
            let f = |x: f64| DVec2::new(x * x * x - 2.0 * x, 1.0 - x * x);
            let slope = |x: f64| DVec2::new(3.0 * x * x - 2.0, -2.0 * x);
            let bend = |x: f64| DVec2::new(6.0 * x, -2.0);
            let (first, last) = (x[0], x[x.len() - 1]);
            let y: Vec<DVec2> = x.iter().map(|&x| f(x)).collect();
            let size = y.iter().fold(1.0_f64, |size, y| size.max(y.length()));
            let mut ends = vec![
                EndConditions::Clamped { start: slope(first), end: slope(last) },
                EndConditions::SecondDerivative { start: bend(first), end: bend(last) },
            ];
            if x.len() > 3 {
                ends.push(EndConditions::NotAKnot);
            }
            // A long interval beside short ones is extrapolated, which costs the square of the ratio.
            let (short, long) = gaps.iter().fold((f64::MAX, 0.0_f64), |(a, b), gap| (a.min(*gap), b.max(*gap)));
            for ends in ends {
                let ratio = if ends == EndConditions::NotAKnot { long / short } else { 1.0 };
                let curve = cubic_interpolation(&x, &y, ends).unwrap();
                for pair in x.windows(2) {
                    let at = pair[0] + 0.3 * (pair[1] - pair[0]);
                    let gap = (curve.evaluate(at).unwrap() - f(at)).length();
                    prop_assert!(gap < (1e-12 + 1e-15 * ratio * ratio) * size, "{:?} at {}: {}", ends, at, gap);
                }
            }
        }

        #[test]
        fn conditions_at_the_ends_hold(gaps in gaps(4), seed in 0_usize..50) {
            let x = sites(&gaps);
            let y: Vec<f64> = (0..x.len()).map(|i| ((i * i + seed * i) % 11) as f64 - 4.0).collect();
            let (first, last) = (x[0], x[x.len() - 1]);
            // Slopes and bends grow with the smallest interval.
            let scale = x.windows(2).fold(1.0_f64, |scale, pair| scale.max((pair[1] - pair[0]).recip()));
            let derivatives = |spline: &Spline<f64>, x: f64, side: Side| spline.derivatives(x, 3, side).unwrap();
            let cases = [
                (EndConditions::Natural, 2, 0.0, 0.0),
                (EndConditions::Clamped { start: 2.0, end: -1.0 }, 1, 2.0, -1.0),
                (EndConditions::SecondDerivative { start: 2.0, end: -1.0 }, 2, 2.0, -1.0),
            ];
            for (ends, order, start, end) in cases {
                let spline = cubic_interpolation(&x, &y, ends).unwrap();
                let (a, b) = (derivatives(&spline, first, Side::Right)[order], derivatives(&spline, last, Side::Left)[order]);
                let tolerance = 1e-12 * scale.powi(order as i32) * 100.0;
                prop_assert!((a - start).abs() < tolerance && (b - end).abs() < tolerance, "{:?}: {} {}", ends, a, b);
                for (&x, y) in x.iter().zip(&y) {
                    prop_assert!((spline.evaluate(x).unwrap() - y).abs() < 1e-11, "{:?} at {}", ends, x);
                }
            }
            // The same interpolant from the general system with its own knots.
            let spline = cubic_interpolation(&x, &y, EndConditions::NotAKnot).unwrap();
            let other = interpolate(spline.space().clone(), &x, &y).unwrap();
            let size = other.coefficients().iter().fold(1.0_f64, |size, c| size.max(c.abs()));
            for (a, b) in spline.coefficients().iter().zip(other.coefficients()) {
                prop_assert!((a - b).abs() < 1e-9 * size, "{} and {}", a, b);
            }
        }

        #[test]
        fn the_seam_of_a_periodic_spline_is_as_smooth_as_the_rest(gaps in gaps(3), seed in 0_usize..50) {
            let x = sites(&gaps);
            let mut y: Vec<f64> = (0..x.len()).map(|i| ((i * i + seed * i) % 11) as f64 - 4.0).collect();
            let last = x.len() - 1;
            y[last] = y[0];
            let spline = cubic_interpolation(&x, &y, EndConditions::Periodic).unwrap();
            let space = SplineSpace::periodic(3, x[last] - x[0], x[..last].to_vec()).unwrap();
            let other = interpolate(space, &x[..last], &y[..last]).unwrap();
            let size = other.coefficients().iter().fold(1.0_f64, |size, c| size.max(c.abs()));
            for (a, b) in spline.coefficients().iter().zip(other.coefficients()) {
                prop_assert!((a - b).abs() < 1e-10 * size, "{} and {}", a, b);
            }
        }
    }

    #[test]
    fn few_points_give_a_line_and_a_parabola() {
        let line = cubic_interpolation(&[1.0, 3.0], &[2.0, 8.0], EndConditions::NotAKnot).unwrap();
        assert_eq!(line.coefficients().len(), 4, "a cubic spline");
        assert!((line.evaluate(2.5).unwrap() - 6.5).abs() < 1e-14, "on the line");
        let parabola =
            cubic_interpolation(&[0.0, 1.0, 3.0], &[0.0, 1.0, 9.0], EndConditions::NotAKnot).unwrap();
        assert!((parabola.evaluate(2.0).unwrap() - 4.0).abs() < 1e-14, "on x²");
    }

    #[test]
    fn bad_data_are_named() {
        let name = |x: &[f64], y: &[f64], ends| cubic_interpolation(x, y, ends).unwrap_err().name();
        assert_eq!(name(&[0.0], &[1.0], EndConditions::Natural), "TooFewData", "one point");
        assert_eq!(name(&[], &[], EndConditions::NotAKnot), "TooFewData", "no point");
        assert_eq!(name(&[0.0, 1.0], &[1.0], EndConditions::Natural), "SizeMismatch", "one value");
        assert_eq!(
            name(&[0.0, 1.0, 1.0], &[1.0; 3], EndConditions::Natural),
            "SitesNotSorted",
            "twice the same"
        );
        assert_eq!(name(&[0.0, f64::NAN, 1.0], &[1.0; 3], EndConditions::Natural), "NonFinite", "no site");
        assert_eq!(name(&[0.0, 1.0], &[1.0, f64::NAN], EndConditions::Natural), "NonFinite", "no value");
        let ends = EndConditions::Clamped { start: f64::NAN, end: 0.0 };
        assert_eq!(name(&[0.0, 1.0], &[1.0, 2.0], ends), "NonFinite", "no slope");
        assert_eq!(
            name(&[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], EndConditions::Periodic),
            "TooFewData",
            "two points"
        );
        let open = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(name(&[0.0, 1.0, 2.0, 3.0], &open, EndConditions::Periodic), "NoSolution", "ends differ");
        let ends = EndConditions::PeriodicOver { period: 3.0 };
        assert_eq!(name(&[0.0, 1.0, 2.0, 3.0], &open, ends), "PeriodTooShort", "the last site is the first");
    }
}
