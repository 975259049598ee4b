//! Knots that become `n`-fold: all of them, or those at both ends.

use crate::document::apply::check_point_count;
use crate::document::apply::knots::kept;
use crate::document::contents::Document;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn all_knots(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        let (degree, closed) = (curve.degree(), curve.space().is_periodic());
        let mut breaks = curve.space().breaks();
        check_point_count((breaks.len() - 1).saturating_mul(degree).saturating_add(1))?;
        let whole = if closed { curve.clone() } else { curve.opened()? };
        if closed {
            // The end of the period is its beginning.
            breaks.pop();
        }
        let missing =
            |&knot: &f64| std::iter::repeat_n(knot, degree.saturating_sub(whole.space().multiplicity(knot)));
        let new: Vec<f64> = breaks.iter().flat_map(missing).collect();
        let result = whole.insert_knots(&new)?;
        if result == *curve {
            Ok((result, ShapeChange::Kept { deviation: 0.0 }))
        } else {
            kept(curve, result)
        }
    })
}

pub(super) fn ends(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        if curve.space().is_periodic() {
            return Err(EditError::NoEnds { object });
        }
        kept(curve, curve.opened()?)
    })
}
