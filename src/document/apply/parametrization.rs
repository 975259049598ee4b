//! Edits of the parameter: open and closed, and the knots that edits choose themselves.

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
        kept(curve, curve.opened()?)
    })
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
