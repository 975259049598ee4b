//! Edits of control points and weights.

use std::collections::BTreeSet;

use glam::{DMat2, DVec2};

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;
use crate::document::apply::knots::changed;
use crate::document::apply::parametrization::{appended_knots, uniform_open, with_knots};
use crate::document::contents::Document;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn move_points(
    document: &mut Document,
    object: ObjectId,
    points: &[usize],
    delta: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the displacement", delta)?;
    map_points(document, object, points, |point| point + delta)
}

pub(super) fn set_point(
    document: &mut Document,
    object: ObjectId,
    point: usize,
    position: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the position", position)?;
    map_points(document, object, &[point], |_| position)
}

pub(super) fn set_points(
    document: &mut Document,
    object: ObjectId,
    positions: &[DVec2],
) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        let new = Nurbs::new(curve.space().clone(), positions.to_vec(), curve.weights().to_vec())?;
        Ok((new, ShapeChange::None))
    })
}

pub(super) fn transform(
    document: &mut Document,
    object: ObjectId,
    points: &[usize],
    matrix: DMat2,
    about: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the matrix", matrix.x_axis)?;
    check_finite("the matrix", matrix.y_axis)?;
    check_finite("the fixed point", about)?;
    map_points(document, object, points, |point| about + matrix * (point - about))
}

pub(super) fn move_curve_at(
    document: &mut Document,
    object: ObjectId,
    at: f64,
    delta: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the displacement", delta)?;
    document.change_curve(object, |curve| Ok((curve.moved_at(at, delta)?, ShapeChange::None)))
}

pub(super) fn move_edit_point(
    document: &mut Document,
    object: ObjectId,
    point: usize,
    delta: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the displacement", delta)?;
    document.change_curve(object, |curve| {
        check_indices(object, curve, &[point])?;
        Ok((curve.with_edit_point_moved(point, delta)?, ShapeChange::None))
    })
}

pub(super) fn set_weight(
    document: &mut Document,
    object: ObjectId,
    point: usize,
    weight: f64,
) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        check_indices(object, curve, &[point])?;
        let mut weights = curve.weights().to_vec();
        weights[point] = weight;
        let new = Nurbs::new(curve.space().clone(), curve.points().to_vec(), weights)?;
        Ok((new, ShapeChange::None))
    })
}

/// The new point gets weight 1 between equal weights, else the geometric mean of its neighbours'.
pub(super) fn insert_point(
    document: &mut Document,
    object: ObjectId,
    before: usize,
    position: DVec2,
) -> Result<Outcome, EditError> {
    check_finite("the position", position)?;
    document.change_curve(object, |curve| {
        let count = curve.points().len();
        if before > count {
            return Err(EditError::NoSuchPoint { object, index: before, count });
        }
        let space = space_with_one_more(curve.space(), before)?;
        let weights = curve.weights();
        let neighbours = if curve.space().is_periodic() {
            (weights[(before + count - 1) % count], weights[before % count])
        } else {
            (weights[before.saturating_sub(1)], weights[before.min(count - 1)])
        };
        // The product of square roots neither over- nor underflows; equal weights are repeated exactly.
        let weight = if neighbours.0.to_bits() == neighbours.1.to_bits() {
            neighbours.0
        } else {
            neighbours.0.sqrt() * neighbours.1.sqrt()
        };
        let (mut points, mut weights) = (curve.points().to_vec(), weights.to_vec());
        points.insert(before, position);
        weights.insert(before, weight);
        let new = Nurbs::new(space, points, weights)?;
        let shape = changed(curve, &new);
        Ok((new, shape))
    })
}

pub(super) fn delete_points(
    document: &mut Document,
    object: ObjectId,
    points: &[usize],
) -> Result<Outcome, EditError> {
    let curve = document.curve_of(object)?;
    check_indices(object, curve, points)?;
    let deleted: BTreeSet<usize> = points.iter().copied().collect();
    if deleted.is_empty() {
        return Ok(Outcome { shape: ShapeChange::None, created: Vec::new() });
    }
    if curve.points().len() - deleted.len() < 2 {
        document.objects.retain(|other| other.id != object);
        return Ok(Outcome { shape: ShapeChange::None, created: Vec::new() });
    }
    document.change_curve(object, |curve| {
        let space = space_without(curve.space(), &deleted)?;
        let kept = |index: &usize| !deleted.contains(index);
        let indices: Vec<usize> = (0..curve.points().len()).filter(kept).collect();
        let points = indices.iter().map(|&k| curve.points()[k]).collect();
        let weights = indices.iter().map(|&k| curve.weights()[k]).collect();
        let new = Nurbs::new(space, points, weights)?;
        let shape = changed(curve, &new);
        Ok((new, shape))
    })
}

fn map_points(
    document: &mut Document,
    object: ObjectId,
    indices: &[usize],
    map: impl Fn(DVec2) -> DVec2,
) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        check_indices(object, curve, indices)?;
        let mut points = curve.points().to_vec();
        for &index in indices.iter().collect::<BTreeSet<_>>() {
            points[index] = map(points[index]);
        }
        let new = Nurbs::new(curve.space().clone(), points, curve.weights().to_vec())?;
        Ok((new, ShapeChange::None))
    })
}

fn check_indices(object: ObjectId, curve: &Nurbs<DVec2>, indices: &[usize]) -> Result<(), EditError> {
    let count = curve.points().len();
    match indices.iter().find(|&&index| index >= count) {
        Some(&index) => Err(EditError::NoSuchPoint { object, index, count }),
        None => Ok(()),
    }
}

pub(super) fn check_finite(what: &'static str, vector: DVec2) -> Result<(), EditError> {
    match vector.to_array().into_iter().find(|value| !value.is_finite()) {
        Some(value) => Err(EditError::NonFinite { what, value }),
        None => Ok(()),
    }
}

/// The space for one more point before point `before`.
///
/// At the ends of an open curve the parameter interval grows by the length of its outermost knot interval, so that the
/// pieces far from that end stay. Elsewhere the knot interval in the middle of both neighbours is halved.
fn space_with_one_more(space: &SplineSpace, before: usize) -> Result<SplineSpace, EditError> {
    let count = space.dimension();
    if !space.is_periodic() && before == count {
        return Ok(SplineSpace::new(space.degree(), appended_knots(space))?);
    }
    if !space.is_periodic() && before == 0 {
        let backwards = SplineSpace::new(space.degree(), mirrored(space.knots()))?;
        return Ok(SplineSpace::new(space.degree(), mirrored(&appended_knots(&backwards)))?);
    }
    let greville = space.greville_abscissae();
    let middle = match (before.checked_sub(1), greville.get(before)) {
        (Some(previous), Some(next)) => greville[previous].midpoint(*next),
        (Some(previous), None) => greville[previous],
        (None, _) => greville[0],
    };
    let breaks = space.breaks();
    // Near the seam of a closed curve the middle can lie behind the period; the outermost interval is then as near.
    let interval = breaks.partition_point(|&knot| knot <= middle).clamp(1, breaks.len() - 1);
    let knot = breaks[interval - 1].midpoint(breaks[interval]);
    let mut knots = space.knots().to_vec();
    knots.insert(knots.partition_point(|&other| other <= knot), knot);
    with_knots(space, knots)
}

fn mirrored(knots: &[f64]) -> Vec<f64> {
    knots.iter().rev().map(|knot| -knot).collect()
}

/// The space without the given points: for each one the interior knot nearest to the middle of its support is taken out.
/// Once an open space has no interior knots left, it becomes that of one polynomial of lower degree.
fn space_without(space: &SplineSpace, deleted: &BTreeSet<usize>) -> Result<SplineSpace, EditError> {
    let remaining = space.dimension() - deleted.len();
    let (left, right) = space.parameter_interval();
    if !space.is_periodic() && remaining <= space.degree() {
        return uniform_open(remaining - 1, remaining, left, right);
    }
    let greville = space.greville_abscissae();
    let mut knots = space.knots().to_vec();
    for &point in deleted {
        let distance = |knot: f64| {
            let direct = (knot - greville[point]).abs();
            // The support of a closed curve's point may reach into the next period.
            space.period().map_or(direct, |period| direct.min((knot + period - greville[point]).abs()))
        };
        // The first knot of a period stays, so that the curve keeps its seam.
        let interior = if space.is_periodic() {
            1..knots.len()
        } else {
            space.degree() + 1..knots.len() - space.degree() - 1
        };
        let nearest = interior.min_by(|&a, &b| distance(knots[a]).total_cmp(&distance(knots[b])));
        if let Some(index) = nearest {
            knots.remove(index);
        }
    }
    with_knots(space, knots)
}
