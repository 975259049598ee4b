//! Goals about the ends of a curve: joints with another curve, prescribed end points, directions and curvatures.

use glam::DVec2;
use serde::Deserialize;

use crate::core::bspline::Side;
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{short_number, short_point};
use crate::course::question::{Verdict, polygon_size};
use crate::document::{Document, ObjectId};

/// What must agree at a joint besides the point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contact {
    /// Derivatives with respect to the parameter.
    Parametric,
    /// Direction of the tangent, then curvature.
    Geometric,
}

/// Point, direction and signed curvature that an end of a curve must have.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EndGoal {
    /// The point.
    pub point: [f64; 2],
    /// The direction in which the curve runs there; any length.
    pub direction: [f64; 2],
    /// The curvature, positive in left turns.
    pub curvature: f64,
}

/// Point, tangent vector and second derivative at an end.
type Jet = [DVec2; 3];

/// The limits from `side` at an end of the parameter interval.
fn jet(curve: &Nurbs<DVec2>, side: Side) -> Option<Jet> {
    let (left, right) = curve.space().parameter_interval();
    let (t, side) = match side {
        Side::Left => (left, Side::Right),
        Side::Right => (right, Side::Left),
    };
    curve.derivatives(t, 2, side).ok()?.try_into().ok()
}

fn curvature(jet: &Jet) -> f64 {
    jet[1].perp_dot(jet[2]) / jet[1].length().powi(3)
}

/// Judges the joint between the end of curve `before` and the start of `curve`; measured is what decides.
pub(super) fn check_joint(
    document: &Document,
    curve: &Nurbs<DVec2>,
    before: u64,
    (contact, order): (Contact, usize),
    tolerance: f64,
    feedback: &str,
) -> Verdict {
    let Some(other) = document.curve(ObjectId(before)) else {
        return Verdict::wrong(None, "The first curve is gone. Go back to the example.");
    };
    let (Some(from), Some(to)) = (jet(other, Side::Right), jet(curve, Side::Left)) else {
        return Verdict::wrong(None, "The curves cannot be measured where they meet.");
    };
    let gap = from[0].distance(to[0]) / polygon_size(curve).max(f64::MIN_POSITIVE);
    if gap > tolerance {
        let (from, to) = (short_point(&from[0].to_array()), short_point(&to[0].to_array()));
        return Verdict::wrong(Some(gap), format!("One curve ends at {from}, the other starts at {to}."));
    }
    if contact == Contact::Geometric {
        return match compare_shape(&from, &to, order, tolerance) {
            Ok(measured) => Verdict::right(measured, feedback),
            Err((measured, message)) => Verdict::wrong(measured, message),
        };
    }
    let mut measured = gap;
    for derivative in 1..=order.min(2) {
        let size = from[derivative].length().max(to[derivative].length()).max(f64::MIN_POSITIVE);
        measured = from[derivative].distance(to[derivative]) / size;
        if measured > tolerance {
            let name = if derivative == 1 { "first" } else { "second" };
            let text = |jet: &Jet| short_point(&jet[derivative].to_array());
            return Verdict::wrong(
                Some(measured),
                format!(
                    "The {name} derivative is {} before the joint and {} after it.",
                    text(&from),
                    text(&to)
                ),
            );
        }
    }
    Verdict::right(measured, feedback)
}

/// Direction and, from `order` 2, curvature of both jets; the last difference, or what differs.
fn compare_shape(from: &Jet, to: &Jet, order: usize, tolerance: f64) -> Result<f64, (Option<f64>, String)> {
    let angle = from[1].angle_to(to[1]).abs();
    if !angle.is_finite() {
        return Err((None, "A tangent vector is zero: two control points coincide.".to_owned()));
    }
    if angle > tolerance {
        let degrees = short_number(angle.to_degrees().round());
        return Err((
            Some(angle),
            format!("The tangents differ by {degrees}°: keep the three points at the joint on one line."),
        ));
    }
    if order < 2 {
        return Ok(angle);
    }
    let (wanted, found) = (curvature(from), curvature(to));
    let measured = (wanted - found).abs() / wanted.abs().max(found.abs()).max(f64::MIN_POSITIVE);
    if measured > tolerance {
        return Err((
            Some(measured),
            format!("The curvature is {} here and {} there.", short_number(wanted), short_number(found)),
        ));
    }
    Ok(measured)
}

/// Judges both ends of `curve`; measured is what decides.
pub(super) fn check_ends(
    curve: &Nurbs<DVec2>,
    [start, end]: [&EndGoal; 2],
    tolerance: f64,
    feedback: &str,
) -> Verdict {
    let mut measured = 0.0_f64;
    for (name, goal, side) in [("start", start, Side::Left), ("end", end, Side::Right)] {
        let Some(found) = jet(curve, side) else {
            return Verdict::wrong(None, "The curve cannot be measured at its ends.");
        };
        let wanted = DVec2::from_array(goal.point);
        let gap = wanted.distance(found[0]) / polygon_size(curve).max(f64::MIN_POSITIVE);
        if gap > tolerance {
            return Verdict::wrong(
                Some(gap),
                format!("The {name} must stay at {}.", short_point(&goal.point)),
            );
        }
        let angle = DVec2::from_array(goal.direction).angle_to(found[1]).abs();
        if angle.is_nan() || angle > tolerance {
            return Verdict::wrong(
                Some(angle),
                format!(
                    "At the {name} the tangent has left its direction: move the point along the tangent."
                ),
            );
        }
        let curvature = curvature(&found);
        let difference = (curvature - goal.curvature).abs() / goal.curvature.abs().max(f64::MIN_POSITIVE);
        if difference.is_nan() || difference > tolerance {
            let (curvature, wanted) = (short_number(curvature), short_number(goal.curvature));
            return Verdict::wrong(
                Some(difference),
                format!("At the {name} the curvature is {curvature}, not {wanted}."),
            );
        }
        measured = measured.max(difference);
    }
    Verdict::right(measured, feedback)
}
