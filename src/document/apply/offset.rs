//! A new curve at a distance from another.

use std::sync::Arc;

use crate::document::apply::{check_point_count, objects};
use crate::document::contents::Document;
use crate::document::display::PointLabels;
use crate::document::edit_error::EditError;
use crate::document::object::{Content, Object, ObjectId};
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn add(
    document: &mut Document,
    object: ObjectId,
    distance: f64,
    tolerance: f64,
) -> Result<Outcome, EditError> {
    let found = document.object(object).ok_or(EditError::NoSuchObject { object })?;
    let Content::Curve { curve, display } = &found.content else { return Err(super::not_a_curve(found)) };
    let offset = curve.offset(distance, tolerance)?;
    check_point_count(offset.curve.points().len())?;
    let mut display = display.clone();
    // Next to the original, and hardly ever with few points: the curve alone is shown.
    display.color = display.color.wrapping_add(1) % 8;
    (display.polygon, display.points, display.knots, display.comb) = (false, false, false, false);
    (display.construction, display.hull, display.osculating_circle) = (false, false, false);
    display.labels = PointLabels::None;
    let made = objects::duplicate(document, object)?;
    for &id in &made.created {
        let at = document.position(id).ok_or(EditError::NoSuchObject { object: id })?;
        let mut copy = Object::clone(&document.objects[at]);
        copy.content = Content::Curve { curve: offset.curve.clone(), display: display.clone() };
        document.objects[at] = Arc::new(copy);
    }
    Ok(Outcome { shape: ShapeChange::Approximated { deviation: offset.measured }, ..made })
}
