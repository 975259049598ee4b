//! Edits of the degree.

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::spline_curve::Nurbs;
use crate::document::apply::check_point_count;
use crate::document::apply::knots::{changed, kept};
use crate::document::apply::parametrization::{uniform_open, uniform_periodic};
use crate::document::contents::Document;
use crate::document::edit::MAX_EDIT_DEGREE;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::outcome::{Outcome, ShapeChange};

pub(super) fn elevate(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        check_degree(curve.degree() + 1)?;
        check_point_count(curve.points().len() + curve.space().breaks().len())?;
        kept(curve, curve.elevate_degree()?)
    })
}

pub(super) fn reduce(document: &mut Document, object: ObjectId) -> Result<Outcome, EditError> {
    document.change_curve(object, |curve| {
        check_degree(curve.degree() - 1)?;
        let reduction = curve.reduce_degree()?;
        let (deviation, at) = (Some(reduction.deviation.upper), Some(reduction.deviation.at));
        Ok((reduction.curve, ShapeChange::Changed { deviation, at }))
    })
}

/// Same control points, uniform knots over the same interval. An open curve that does not interpolate its end points
/// keeps simple end knots.
pub(super) fn set(document: &mut Document, object: ObjectId, degree: usize) -> Result<Outcome, EditError> {
    check_degree(degree)?;
    document.change_curve(object, |curve| {
        if degree == curve.degree() {
            return Ok((curve.clone(), ShapeChange::None));
        }
        let (old, count) = (curve.space(), curve.points().len());
        let (left, right) = old.parameter_interval();
        if let Some(period) = old.period() {
            let space = uniform_periodic(degree, count, left, period)?;
            let new = Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?;
            let shape = changed(curve, &new);
            return Ok((new, shape));
        }
        if count < degree + 1 {
            let (what, expected) = ("control points", degree + 1);
            return Err(SplineError::SizeMismatch { what, expected, found: count }.into());
        }
        let clamped = old.multiplicity(left) == old.degree() && old.multiplicity(right) == old.degree();
        let space = if clamped {
            uniform_open(degree, count, left, right)?
        } else {
            simple_uniform(degree, count, left, right)?
        };
        let new = Nurbs::new(space, curve.points().to_vec(), curve.weights().to_vec())?;
        let shape = changed(curve, &new);
        Ok((new, shape))
    })
}

fn check_degree(degree: usize) -> Result<(), EditError> {
    if !(1..=MAX_EDIT_DEGREE).contains(&degree) {
        return Err(EditError::DegreeOutsideWindow { degree });
    }
    Ok(())
}

/// Equally distant knots, simple at both ends, over `[left, right]`.
fn simple_uniform(degree: usize, count: usize, left: f64, right: f64) -> Result<SplineSpace, EditError> {
    let intervals = (count - degree) as f64;
    let step = (right - left) / intervals;
    let knots = (0..=count + degree)
        .map(|k| if k == count { right } else { left + step * (k as f64 - degree as f64) });
    Ok(SplineSpace::new(degree, knots.collect())?)
}
