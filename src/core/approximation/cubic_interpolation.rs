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
    sites: &[f64], values: &[P], ends: EndConditions<P>,
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
            let row = |jump: P, width: f64| EndRow { factor: 1.0, diagonal: 2.0, right: jump * (6.0 / width) };
            (row(start_slope - start, first), row(end - end_slope, last))
        }
    };
    solve(sites, values, start_row, end_row, &mut moments);
    spline_from_moments(sites, values, &moments, (first, last))
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
    sites: &[f64], values: &[P], mut moments: Vec<P>,
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
        1 => return spline_from_moments(sites, values, &moments, outer),
        2 => {
            moments.fill(bend(1) * (3.0 * (width(0) + width(1))).recip());
            let (ends, values) = ([sites[0], sites[2]], [values[0], values[2]]);
            return spline_from_moments(&ends, &values, &moments[..2], outer);
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
    let reduced = [sites[0]].iter().chain(&sites[2..last - 1]).chain(&sites[last..]).copied().collect::<Vec<_>>();
    let without = |all: &[P]| [&all[..1], &all[2..last - 1], &all[last..]].concat();
    spline_from_moments(&reduced, &without(values), &without(&moments), outer)
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
