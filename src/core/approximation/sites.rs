//! Sites of interpolation and knots that suit each other.
//!
//! I. J. Schoenberg, A. Whitney, *On Pólya frequency functions III*, 1953. Course: section 5.5.

use crate::core::approximation::data::{check_finite, check_increasing, check_length};
use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::{EndKnots, SplineSpace};

/// Distances of knots that differ by less than this, relatively, count as equal.
const UNIFORM: f64 = 1e-12;

/// Whether interpolation in `space` at `sites` has exactly one solution for all data.
///
/// Open spaces: as many sites as B-splines in D, not decreasing. A site that stands `μ` times prescribes `p, p′, …, p^(μ−1)`; together with the
/// copies of an equal inner knot it may stand `n + 1` times. By the theorem of Schoenberg and Whitney the condition is `ξₖ < tₖ < ξₖ₊ₙ₊₁`, for inner
/// knots. Periodic spaces: strictly increasing sites within one period; then the matrix decides.
///
/// # Errors
///
/// In this order: `SizeMismatch`, `NonFinite`, `SitesNotSorted`, `OutsideInterval`, `KnotMultiplicityTooHigh`, and `SchoenbergWhitney` with the first index
/// that violates the condition.
pub fn check_sites(space: &SplineSpace, sites: &[f64]) -> Result<(), ApproximationError> {
    check_length("sites", space.dimension(), sites.len())?;
    if let Some(period) = space.period() {
        check_increasing(sites)?;
        let (previous, value) = (sites[sites.len() - 1], sites[0] + period);
        return if value > previous {
            Ok(())
        } else {
            Err(ApproximationError::SitesNotSorted { index: sites.len(), value, previous })
        };
    }
    check_order(space, sites)?;
    let (n, m, knots) = (space.degree(), space.dimension(), space.knots());
    let (left, right) = space.parameter_interval();
    let mut index = 0;
    while index < sites.len() {
        let value = sites[index];
        let copies = sites[index..].iter().take_while(|&&site| site <= value).count();
        let inner = left < value && value < right;
        let knots = if inner && copies > 1 { space.multiplicity(value) } else { 0 };
        if copies + knots > n + 1 {
            return Err(ApproximationError::KnotMultiplicityTooHigh {
                index,
                value,
                sites: copies,
                knots,
                most: n + 1,
            });
        }
        index += copies;
    }
    let violates =
        |k: usize| (k > n && sites[k] <= knots[k]) || (k + n + 1 < m && sites[k] >= knots[k + n + 1]);
    match (0..m).find(|&k| violates(k)) {
        Some(index) => {
            let (left, right) = space.support(index);
            Err(ApproximationError::SchoenbergWhitney { index, value: sites[index], left, right })
        }
        None => Ok(()),
    }
}

/// Sites of an open space: finite, not decreasing, in D.
pub(super) fn check_order(space: &SplineSpace, sites: &[f64]) -> Result<(), ApproximationError> {
    check_finite("site", sites)?;
    if let Some(i) = sites.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(ApproximationError::SitesNotSorted {
            index: i + 1,
            value: sites[i + 1],
            previous: sites[i],
        });
    }
    let (left, right) = space.parameter_interval();
    match sites.iter().position(|site| !(left..=right).contains(site)) {
        Some(index) => {
            Err(ApproximationError::OutsideInterval { what: "site", index, value: sites[index], left, right })
        }
        None => Ok(()),
    }
}

/// The space of `degree` with end-interpolating knots and inner knots `(tⱼ + … + tⱼ₊ₙ₋₁)/n`, `j = 1 … m−n−1`: interpolation at the strictly increasing
/// `sites` is always possible in it.
///
/// # Errors
///
/// `NonFinite`, `SitesNotSorted`, `TooFewData` for fewer than `degree + 1` sites; those of [`SplineSpace::new`].
pub fn averaged_knots(degree: usize, sites: &[f64]) -> Result<SplineSpace, ApproximationError> {
    let (first, last) = check_knot_sites(degree, sites)?;
    let average = |run: &[f64]| run[0] + run.iter().map(|site| site - run[0]).sum::<f64>() / degree as f64;
    let mut breaks = vec![first];
    breaks.extend(sites[1..sites.len() - 1].windows(degree.max(1)).map(average));
    breaks.push(last);
    Ok(SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating)?)
}

/// The space of `degree` with end-interpolating knots whose inner knots are the sites (for even degrees the midpoints between them) without the first and
/// the last `⌈n/2⌉`, so that its dimension is the number of sites: *not-a-knot* for any degree.
///
/// # Errors
///
/// As [`averaged_knots`].
pub fn not_a_knot_space(degree: usize, sites: &[f64]) -> Result<SplineSpace, ApproximationError> {
    let (first, last) = check_knot_sites(degree, sites)?;
    let mut breaks = Vec::with_capacity(sites.len());
    breaks.push(first);
    if degree % 2 == 1 {
        let skip = degree.div_ceil(2);
        breaks.extend_from_slice(&sites[skip..sites.len() - skip]);
    } else {
        let inner = &sites[degree / 2..sites.len() - degree / 2];
        breaks.extend(inner.windows(2).map(|pair| pair[0] + 0.5 * (pair[1] - pair[0])));
    }
    breaks.push(last);
    Ok(SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating)?)
}

fn check_knot_sites(degree: usize, sites: &[f64]) -> Result<(f64, f64), ApproximationError> {
    check_increasing(sites)?;
    let least = degree.saturating_add(1).max(2);
    if sites.len() < least {
        return Err(ApproximationError::TooFewData { what: "sites", least, found: sites.len() });
    }
    Ok((sites[0], sites[sites.len() - 1]))
}

/// The sites for equally spaced knots: the midpoints of the supports that lie in D, and instead of the `⌊n/2⌋` outside on each side the first and last interval
/// midpoints (odd degree) or knots, the ends among them (even degree).
///
/// # Errors
///
/// `KnotsNotUniform`; `TooFewData` if D has not enough knot intervals for both ends, or the space is periodic.
pub fn midpoint_sites(space: &SplineSpace) -> Result<Vec<f64>, ApproximationError> {
    let (n, m, knots) = (space.degree(), space.dimension(), space.knots());
    let (half, intervals) = (n / 2, m.saturating_sub(n));
    let least = if n.is_multiple_of(2) { n.max(2) - 1 } else { 2 * half };
    if space.is_periodic() || intervals < least.max(1) {
        return Err(ApproximationError::TooFewData {
            what: "knot intervals",
            least: least.max(1),
            found: intervals,
        });
    }
    let expected = knots[1] - knots[0];
    if let Some(index) = knots
        .windows(2)
        .position(|pair| (pair[1] - pair[0] - expected).abs() > UNIFORM * (knots[n + m] - knots[0]))
    {
        let length = knots[index + 1] - knots[index];
        return Err(ApproximationError::KnotsNotUniform { index, length, expected });
    }
    // Knots and midpoints alternate: even counts are knots of D, odd ones midpoints.
    let at = |count: usize| {
        if count.is_multiple_of(2) { knots[n + count / 2] } else { midpoint(knots, n + count / 2) }
    };
    let regular = (n + 1) % 2;
    let (last, extra) = (2 * intervals, 2 * half);
    let is_extra = |count: usize| count < extra || last - count < extra;
    Ok((0..=last).filter(|&count| count % 2 == regular || is_extra(count)).map(at).collect())
}

fn midpoint(knots: &[f64], k: usize) -> f64 {
    knots[k] + 0.5 * (knots[k + 1] - knots[k])
}
