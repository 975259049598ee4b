//! Edits of the knot sequence.

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::{Nurbs, deviation};
use crate::document::apply::check_point_count;
use crate::document::apply::parametrization::with_knots;
use crate::document::contents::Document;
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

/// One copy of a knot moves; the control points stay.
pub(super) fn move_copy(
    document: &mut Document,
    object: ObjectId,
    index: usize,
    to: f64,
) -> Result<Outcome, EditError> {
    check_finite(to)?;
    document.change_curve(object, |curve| {
        let knots = curve.space().knots();
        let count = knots.len();
        if index >= count {
            return Err(EditError::NoSuchKnot { object, index, count });
        }
        let at = |k: isize| curve.space().knot(k);
        let low = at(index as isize - 1).unwrap_or(f64::NEG_INFINITY);
        let high = at(index as isize + 1).unwrap_or(f64::INFINITY);
        if !(low..=high).contains(&to) {
            return Err(EditError::KnotBlocked { knot: index, wanted: to, low, high });
        }
        let mut moved = knots.to_vec();
        moved[index] = to;
        replace_knots(curve, moved)
    })
}

/// All copies of a knot move strictly between the neighbouring distinct knots.
///
/// At an n-fold end the one knot outside moves along, so that it keeps its distance from the end.
pub(super) fn move_distinct(
    document: &mut Document,
    object: ObjectId,
    at: f64,
    to: f64,
) -> Result<Outcome, EditError> {
    check_finite(to)?;
    document.change_curve(object, |curve| {
        let space = curve.space();
        let (n, knots) = (space.degree(), space.knots());
        let first = knots.partition_point(|&knot| knot < at);
        let after = knots.partition_point(|&knot| knot <= at);
        if first == after || after > knots.len() {
            return Err(EditError::NotAKnot { object, at });
        }
        let takes_left = !space.is_periodic() && after == n + 1 && first <= 1;
        let takes_right = !space.is_periodic() && first == space.dimension() && after + 1 >= knots.len();
        let (from, until) =
            (if takes_left { 0 } else { first }, if takes_right { knots.len() } else { after });
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
        replace_knots(curve, moved)
    })
}

/// All knots are new, in the n-fold or in the (n+1)-fold convention.
pub(super) fn set(document: &mut Document, object: ObjectId, knots: &[f64]) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        if curve.space().is_periodic() {
            return replace_knots(curve, knots.to_vec());
        }
        let space = SplineSpace::from_either_convention(curve.degree(), knots.to_vec())?;
        replace_space(curve, space)
    })
}

fn replace_knots(curve: &Nurbs<DVec2>, knots: Vec<f64>) -> Result<(Nurbs<DVec2>, ShapeChange), EditError> {
    replace_space(curve, with_knots(curve.space(), knots)?)
}

fn replace_space(curve: &Nurbs<DVec2>, space: SplineSpace) -> Result<(Nurbs<DVec2>, ShapeChange), EditError> {
    let new = Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?;
    let shape = changed(curve, &new);
    Ok((new, shape))
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
