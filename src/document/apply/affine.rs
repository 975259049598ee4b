//! Affine maps of whole curves.

use glam::{DMat2, DVec2};

use crate::document::apply::curve_points::check_finite;
use crate::document::contents::Document;
use crate::document::edit::CurveMap;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn transform(
    document: &mut Document,
    object: ObjectId,
    map: CurveMap,
) -> Result<Outcome, EditError> {
    let (matrix, about, shift) = match map {
        CurveMap::Move { by } => (DMat2::IDENTITY, DVec2::ZERO, by),
        CurveMap::Rotate { degrees, about } => {
            let direction = direction(degrees)?;
            (DMat2::from_cols(direction, direction.perp()), about, DVec2::ZERO)
        }
        CurveMap::Scale { factors, about } => {
            if let Some(value) = factors.to_array().into_iter().find(|&factor| factor == 0.0) {
                return Err(EditError::FactorZero { value });
            }
            check_finite("the factor", factors)?;
            (DMat2::from_diagonal(factors), about, DVec2::ZERO)
        }
        CurveMap::Mirror { degrees, through } => {
            let twice = direction(2.0 * degrees)?;
            (DMat2::from_cols(twice, -twice.perp()), through, DVec2::ZERO)
        }
    };
    check_finite("the fixed point", about)?;
    check_finite("the displacement", shift)?;
    document.change_curve(object, |curve| {
        let new = curve.transformed(|point| about + matrix * (point - about) + shift)?;
        Ok((new, ShapeChange::None))
    })
}

/// The unit vector at an angle, exact along the axes.
fn direction(degrees: f64) -> Result<DVec2, EditError> {
    if !degrees.is_finite() {
        return Err(EditError::NonFinite { what: "the angle", value: degrees });
    }
    let angle = degrees.rem_euclid(360.0);
    let quarters = (angle / 90.0).floor();
    let rest = angle - 90.0 * quarters;
    let within = if rest == 0.0 { DVec2::X } else { DVec2::from_angle(rest.to_radians()) };
    Ok((0..quarters as usize).fold(within, |turned, _| turned.perp()))
}
