//! Edits of the knot sequence.

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::{Nurbs, deviation};
use crate::document::apply::check_point_count;
use crate::document::apply::parametrization::with_knots;
use crate::document::contents::Document;
use crate::document::edit::Edit;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

/// Curves with more points are not measured when their shape changes: the measurement would halt a drag.
const MOST_MEASURED_POINTS: usize = 2000;

pub(super) fn insert(document: &mut Document, object: ObjectId, at: f64) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| kept(curve, curve.insert_knot(at)?))
}

pub(super) fn remove(document: &mut Document, object: ObjectId, at: f64) -> Result<Outcome, EditError> {
    check_finite(at)?;
    document.change_curve(object, |curve| {
        if curve.space().multiplicity(curve.space().reduce(at)?) == 0 {
            return Err(EditError::NotAKnot { object, at });
        }
        let removal = curve.remove_knot(at)?;
        let shape = changed(curve, &removal.curve);
        Ok((removal.curve, shape))
    })
}

pub(super) fn refine_uniformly(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        check_point_count(curve.points().len() + curve.space().breaks().len() - 1)?;
        kept(curve, curve.refine_uniformly()?)
    })
}

/// Removes knots while the certified deviation is at most `tolerance`.
pub(super) fn remove_within(
    document: &mut Document,
    object: ObjectId,
    tolerance: f64,
) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        let reduction = curve.remove_knots(tolerance)?;
        let (deviation, at) = (Some(reduction.deviation.upper), Some(reduction.deviation.at));
        let shape =
            if reduction.removed == 0 { ShapeChange::None } else { ShapeChange::Changed { deviation, at } };
        Ok((if reduction.removed == 0 { curve.clone() } else { reduction.curve }, shape))
    })
}

/// The knots change as `edit` says; the control points stay.
pub(super) fn keeping_points(
    document: &mut Document,
    object: ObjectId,
    edit: &Edit,
) -> Result<Outcome, EditError> {
    document.change_curve(object, |old| {
        let turned = turned_for(old, edit)?;
        let (curve, edit) = turned.as_ref().map_or((old, edit), |(curve, edit)| (curve, edit));
        let space = changed_space(curve, object, edit)?;
        let new = Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?;
        let shape = changed(old, &new);
        Ok((new, shape))
    })
}

/// The knots change as `edit` says; the control points become those of the nearest curve.
pub(super) fn keeping_curve(document: &mut Document, edit: &Edit) -> Result<Outcome, EditError> {
    let (Edit::MoveKnot { object, .. }
    | Edit::MoveDistinctKnot { object, .. }
    | Edit::SetKnots { object, .. }
    | Edit::GenerateKnots { object, .. }) = *edit
    else {
        return Err(EditError::NoKnotEdit { name: edit.name() });
    };
    document.change_curve(object, |old| {
        let turned = turned_for(old, edit)?;
        let (curve, edit) = turned.as_ref().map_or((old, edit), |(curve, edit)| (curve, edit));
        let space = changed_space(curve, object, edit)?;
        if space == *curve.space() {
            return Ok((curve.clone(), ShapeChange::None));
        }
        check_point_count(space.dimension())?;
        if !space.is_periodic() {
            let ((left, right), (low, high)) =
                (curve.space().parameter_interval(), space.parameter_interval());
            if (left, right) != (low, high) {
                return Err(EditError::IntervalChanged { left, right, low, high });
            }
        }
        let new = curve.nearest_in(&space)?;
        let shape = changed(old, &new);
        Ok((new, shape))
    })
}

/// A knot at the seam of a closed curve that moves onto its neighbour on the other side: the period first starts with the knots before
/// the seam, so that both knots stand in one period. Control points and weights keep their knots, not their indices.
fn turned_for(curve: &Nurbs<DVec2>, edit: &Edit) -> Result<Option<(Nurbs<DVec2>, Edit)>, EditError> {
    let (Edit::MoveKnot { object, knot, to }, space) = (edit, curve.space()) else { return Ok(None) };
    let (Some(period), count) = (space.period(), space.dimension()) else { return Ok(None) };
    let (start, last) = (space.knots()[0], space.knots()[count - 1]);
    let copies = space.multiplicity(last);
    let leftwards = *knot == 0 && *to <= last - period;
    let rightwards = *knot + 1 == count && *to >= start + period;
    if copies >= count || !(leftwards || rightwards) {
        return Ok(None);
    }
    let first = -(copies as isize);
    let (turned, _) = curve.without_weights().with_start(first)?.into_parts();
    let index = |k: usize| (k + count - copies) % count;
    let points = (0..count).map(|k| curve.points()[index(k)]).collect();
    let weights = (0..count).map(|k| curve.weights()[index(k)]).collect();
    let (knot, to) = if leftwards { (copies, *to) } else { (copies - 1, *to - period) };
    // Rounding of the period must not keep equal knots apart.
    let target = turned.knots()[if leftwards { knot - 1 } else { knot + 1 }];
    let to = if (to - target).abs() <= 1e-12 * period { target } else { to };
    Ok(Some((Nurbs::new(turned, points, weights)?, Edit::MoveKnot { object: *object, knot, to })))
}

/// The space that the curve has after `edit`, one that changes knots and nothing else.
fn changed_space(curve: &Nurbs<DVec2>, object: ObjectId, edit: &Edit) -> Result<SplineSpace, EditError> {
    match edit {
        Edit::MoveKnot { knot, to, .. } => move_copy(curve.space(), object, *knot, *to),
        Edit::MoveDistinctKnot { at, to, .. } => move_distinct(curve.space(), object, *at, *to),
        Edit::SetKnots { knots, .. } if curve.space().is_periodic() => {
            with_knots(curve.space(), knots.clone())
        }
        // In the n-fold or in the (n+1)-fold convention.
        Edit::SetKnots { knots, .. } => {
            Ok(SplineSpace::from_either_convention(curve.degree(), knots.clone())?)
        }
        Edit::GenerateKnots { rule, .. } => Ok(curve.space_by_rule(*rule)?),
        other => Err(EditError::NoKnotEdit { name: other.name() }),
    }
}

/// One copy of a knot moves between its neighbours.
fn move_copy(space: &SplineSpace, object: ObjectId, index: usize, to: f64) -> Result<SplineSpace, EditError> {
    check_finite(to)?;
    let knots = space.knots();
    let count = knots.len();
    if index >= count {
        return Err(EditError::NoSuchKnot { object, index, count });
    }
    let low = space.knot(index as isize - 1).unwrap_or(f64::NEG_INFINITY);
    let high = space.knot(index as isize + 1).unwrap_or(f64::INFINITY);
    if !(low..=high).contains(&to) {
        return Err(EditError::KnotBlocked { knot: index, wanted: to, low, high });
    }
    let mut moved = knots.to_vec();
    moved[index] = to;
    with_knots(space, moved)
}

/// All copies of a knot move strictly between the neighbouring distinct knots.
///
/// At an n-fold end the one knot outside moves along, so that it keeps its distance from the end.
fn move_distinct(space: &SplineSpace, object: ObjectId, at: f64, to: f64) -> Result<SplineSpace, EditError> {
    check_finite(to)?;
    let (n, knots) = (space.degree(), space.knots());
    let first = knots.partition_point(|&knot| knot < at);
    let after = knots.partition_point(|&knot| knot <= at);
    if first == after || after > knots.len() {
        return Err(EditError::NotAKnot { object, at });
    }
    let takes_left = !space.is_periodic() && after == n + 1 && first <= 1;
    let takes_right = !space.is_periodic() && first == space.dimension() && after + 1 >= knots.len();
    let (from, until) = (if takes_left { 0 } else { first }, if takes_right { knots.len() } else { after });
    let low = space.knot(from as isize - 1).unwrap_or(f64::NEG_INFINITY);
    let high = space.knot(until as isize).unwrap_or(f64::INFINITY);
    // Periodic knots: all M of them may stand in one place and then move freely.
    let free = space.is_periodic() && from == 0 && until == knots.len();
    if !free && (to <= low || to >= high) {
        return Err(EditError::KnotBlocked { knot: first, wanted: to, low, high });
    }
    let mut moved = knots.to_vec();
    for (index, knot) in moved.iter_mut().enumerate().take(until).skip(from) {
        *knot = if (first..after).contains(&index) { to } else { to + (*knot - at) };
    }
    with_knots(space, moved)
}

/// `new` with the measured proof that it is `old`.
pub(super) fn kept(old: &Nurbs<DVec2>, new: Nurbs<DVec2>) -> Result<(Nurbs<DVec2>, ShapeChange), EditError> {
    let deviation = deviation(old, &new)?.upper;
    Ok((new, ShapeChange::Kept { deviation }))
}

/// What to say about a change that need not keep the shape.
pub(super) fn changed(old: &Nurbs<DVec2>, new: &Nurbs<DVec2>) -> ShapeChange {
    if old == new {
        return ShapeChange::None;
    }
    if old.points().len().max(new.points().len()) > MOST_MEASURED_POINTS {
        return ShapeChange::Changed { deviation: None, at: None };
    }
    let measured = deviation(old, new).ok();
    ShapeChange::Changed { deviation: measured.map(|found| found.upper), at: measured.map(|found| found.at) }
}

fn check_finite(value: f64) -> Result<(), EditError> {
    if value.is_finite() { Ok(()) } else { Err(EditError::NonFinite { what: "the knot", value }) }
}
