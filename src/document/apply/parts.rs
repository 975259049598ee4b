//! Parts of curves as curves, and two curves as one.

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::{Nurbs, deviation};
use crate::document::apply::objects;
use crate::document::contents::Document;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

/// Distance of two ends relative to the size of the curves that counts as rounding.
const SAME_POINT: f64 = 1e-10;

pub(super) fn split(document: &mut Document, object: ObjectId, at: f64) -> Result<Outcome, EditError> {
    let curve = document.curve_of(object)?.clone();
    if let Some(period) = curve.space().period() {
        return document.change_curve(object, |curve| {
            let start = curve.space().reduce(at)?;
            let cut = curve.trimmed(start, start + period)?;
            let shape = ShapeChange::Kept { deviation: part_deviation(curve, &cut)? };
            Ok((cut, shape))
        });
    }
    let (before, after) = curve.split(at)?;
    let distance = part_deviation(&curve, &before)?.max(part_deviation(&curve, &after)?);
    let made = objects::duplicate(document, object)?;
    document.change_curve(object, |_| Ok((before, ShapeChange::None)))?;
    for &id in &made.created {
        document.change_curve(id, |_| Ok((after.clone(), ShapeChange::None)))?;
    }
    Ok(Outcome { shape: ShapeChange::Kept { deviation: distance }, ..made })
}

pub(super) fn trim(
    document: &mut Document,
    object: ObjectId,
    from: f64,
    to: f64,
) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        let part = curve.trimmed(from, to)?;
        let shape = ShapeChange::Kept { deviation: part_deviation(curve, &part)? };
        Ok((part, shape))
    })
}

pub(super) fn join(document: &mut Document, object: ObjectId, other: ObjectId) -> Result<Outcome, EditError> {
    if object == other {
        return Err(EditError::JoinedWithItself { object });
    }
    let (stays, goes) = (document.curve_of(object)?.clone(), document.curve_of(other)?.clone());
    for (id, curve) in [(object, &stays), (other, &goes)] {
        if curve.space().is_periodic() {
            return Err(EditError::NoEnds { object: id });
        }
    }
    let (mine, theirs) = nearest_ends(&stays, &goes)?;
    // The second curve of the two begins where the first ends.
    let goes = if mine == theirs { goes.reversed()? } else { goes };
    let (first, second) = if mine == 1 { (stays, goes) } else { (goes, stays) };
    let (first, second) = (first.opened()?, second.opened()?);
    let (last, joint) = (first.points().len() - 1, first.space().parameter_interval().1);
    let (a, b) = (first.points()[last], second.points()[0]);
    let all = first.points().iter().chain(second.points());
    let size = all.fold(0.0, |size: f64, point| size.max(point.length()));
    let gap = a.distance(b);
    let whole = if gap > SAME_POINT * size {
        let middle = a.midpoint(b);
        first.with_point(last, middle)?.joined(&second.with_point(0, middle)?)?
    } else {
        first.joined(&second)?
    };
    let (before, after) = whole.split(joint)?;
    let (start, _) = second.space().parameter_interval();
    let distance =
        deviation(&first, &before)?.upper.max(deviation(&second, &moved(&after, start - joint)?)?.upper);
    let shape = if gap > SAME_POINT * size {
        ShapeChange::Changed { deviation: Some(distance), at: Some(joint) }
    } else {
        ShapeChange::Kept { deviation: distance }
    };
    document.change_curve(object, |_| Ok((whole, shape)))?;
    objects::remove(document, &[other])?;
    Ok(Outcome { shape, created: Vec::new() })
}

/// Which ends of both curves are nearest to each other, 0 the beginning and 1 the end.
fn nearest_ends(a: &Nurbs<DVec2>, b: &Nurbs<DVec2>) -> Result<(usize, usize), EditError> {
    let ends = |curve: &Nurbs<DVec2>| {
        let (left, right) = curve.space().parameter_interval();
        Ok::<_, EditError>([curve.evaluate(left)?, curve.evaluate(right)?])
    };
    let (mine, theirs) = (ends(a)?, ends(b)?);
    // Of equal distances the one that keeps both directions.
    let pairs = [(1, 0), (0, 1), (1, 1), (0, 0)];
    let apart = |&(i, k): &(usize, usize)| mine[i].distance(theirs[k]);
    Ok(pairs.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or((1, 0)))
}

/// A certified bound of the distance between a part and the same part of the whole, whose knots outside the part are kept: the part is
/// compared with Bezier curves of the whole. Of a closed curve both periods are compared that the part can touch.
fn part_deviation(whole: &Nurbs<DVec2>, part: &Nurbs<DVec2>) -> Result<f64, EditError> {
    let opened = whole.opened()?;
    let (left, right) = opened.space().parameter_interval();
    let (from, to) = part.space().parameter_interval();
    let mut largest: f64 = 0.0;
    for (low, high, shift) in [(from, to.min(right), 0.0), (right.max(from), to, left - right)] {
        // What rounding leaves of an interval is no part.
        if high - low <= 1e-9 * (right - left) {
            continue;
        }
        let piece = moved(&part.trimmed(low, high)?, shift)?;
        let (a, b) = piece.space().parameter_interval();
        largest = largest.max(deviation(&piece, &opened.trimmed(a.max(left), b.min(right))?)?.upper);
    }
    Ok(largest)
}

/// The same curve over shifted parameters.
fn moved(curve: &Nurbs<DVec2>, by: f64) -> Result<Nurbs<DVec2>, EditError> {
    let knots = curve.space().knots().iter().map(|knot| knot + by).collect();
    let space = SplineSpace::new(curve.degree(), knots)?;
    Ok(Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?)
}
