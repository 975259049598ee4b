//! Edits of the parameter: open and closed, direction, and the knots that edits choose themselves.

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;
use crate::document::apply::knots::{changed, kept};
use crate::document::contents::Document;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn close(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        if curve.space().is_periodic() {
            return Ok((curve.clone(), ShapeChange::None));
        }
        let (left, right) = curve.space().parameter_interval();
        let space = uniform_periodic(curve.degree(), curve.points().len(), left, right - left)?;
        let new = Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?;
        let shape = changed(curve, &new);
        Ok((new, shape))
    })
}

pub(super) fn open(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        if !curve.space().is_periodic() {
            return Ok((curve.clone(), ShapeChange::None));
        }
        kept(curve, cut(curve)?)
    })
}

/// The closed curve cut at `ξ₀`: with `ξ₀` n-fold, the unrolled knots of one period interpolate both ends.
fn cut(curve: &Nurbs<DVec2>) -> Result<Nurbs<DVec2>, EditError> {
    let n = curve.degree();
    let start = curve.space().knots()[0];
    let copies = vec![start; n - curve.space().multiplicity(start)];
    let curve = curve.insert_knots(&copies)?;
    let space = curve.space();
    let indices = || (0..space.evaluation_dimension()).map(|k| space.coefficient_index(k));
    let points = indices().map(|k| curve.points()[k]).collect();
    let weights = indices().map(|k| curve.weights()[k]).collect();
    Ok(Nurbs::new(SplineSpace::new(n, space.evaluation_knots().to_vec())?, points, weights)?)
}

/// The same curve run through the other way over the same interval: `x ↦ ξₙ + ξₘ − x`, or `x ↦ 2ξ₀ − x` if closed.
pub(super) fn reversed(curve: &Nurbs<DVec2>) -> Result<Nurbs<DVec2>, EditError> {
    let space = curve.space();
    let (n, count) = (space.degree(), space.dimension());
    let Some(period) = space.period() else {
        let (left, right) = space.parameter_interval();
        let knots = space.knots().iter().rev().map(|knot| left + (right - knot)).collect();
        let points = curve.points().iter().rev().copied().collect();
        let weights = curve.weights().iter().rev().copied().collect();
        return Ok(Nurbs::new(SplineSpace::new(n, knots)?, points, weights)?);
    };
    // The new knots are η_j = 2ξ₀ − ξ_{μ−1−j}, and η_j begins the support of the old point μ−1−j−n−1.
    let start = space.knots()[0];
    let copies = space.multiplicity(start) as isize;
    let at = |k: isize| space.knot(k).unwrap_or(f64::NAN);
    let knots = (0..count as isize).map(|j| start + (start - at(copies - 1 - j))).collect();
    let old = |j: usize| (copies - 2 - n as isize - j as isize).rem_euclid(count as isize) as usize;
    let points = (0..count).map(|j| curve.points()[old(j)]).collect();
    let weights = (0..count).map(|j| curve.weights()[old(j)]).collect();
    Ok(Nurbs::new(SplineSpace::periodic(n, period, knots)?, points, weights)?)
}

/// The space of the same kind and degree over other knots.
pub(super) fn with_knots(space: &SplineSpace, knots: Vec<f64>) -> Result<SplineSpace, EditError> {
    Ok(match space.period() {
        Some(period) => SplineSpace::periodic(space.degree(), period, knots)?,
        None => SplineSpace::new(space.degree(), knots)?,
    })
}

/// End-interpolating knots with equal intervals over `[left, right]` for `count` points.
pub(super) fn uniform_open(
    degree: usize,
    count: usize,
    left: f64,
    right: f64,
) -> Result<SplineSpace, EditError> {
    let intervals = count.saturating_sub(degree).max(1);
    let step = (right - left) / intervals as f64;
    let mut knots = vec![left - step];
    knots.extend(std::iter::repeat_n(left, degree));
    knots.extend((1..intervals).map(|i| left + step * i as f64));
    knots.extend(std::iter::repeat_n(right, degree));
    knots.push(right + step);
    Ok(SplineSpace::new(degree, knots)?)
}

/// `count` equally distant knots in one period.
pub(super) fn uniform_periodic(
    degree: usize,
    count: usize,
    start: f64,
    period: f64,
) -> Result<SplineSpace, EditError> {
    let knots = (0..count).map(|k| start + period * (k as f64 / count as f64)).collect();
    Ok(SplineSpace::periodic(degree, period, knots)?)
}

/// One knot more at the right end: D grows by its last interval `h`. The end `b` of multiplicity μ becomes a simple knot,
/// `b + h` takes its μ copies and the knots beyond move by `h`; a simple end keeps the knots beyond, so that no piece changes.
pub(super) fn appended_knots(space: &SplineSpace) -> Vec<f64> {
    let knots = space.knots();
    let last = space.dimension();
    let step = knots[last] - knots[last - 1];
    let mut appended = knots.to_vec();
    if knots[last + 1] > knots[last] && space.degree() > 1 {
        appended.push(knots[knots.len() - 1] + step);
    } else {
        appended.truncate(last + 1);
        appended.extend(knots[last..].iter().map(|knot| knot + step));
    }
    appended
}
