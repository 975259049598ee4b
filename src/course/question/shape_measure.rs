//! Goals about the whole shape: how often a line is crossed, whether an arc is part of a circle.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::spline_curve::{Hyperplane, IntersectionKind, Nurbs, variation};
use crate::course::number_text::short_number;
use crate::course::question::knot_goal::times;
use crate::course::question::{Verdict, polygon_size};
use crate::document::{Document, ObjectId};

/// Samples of the whole arc.
const SAMPLES: usize = 64;

/// Judges how often polygon and curve cross the line through the ends of another curve; measured is the number of
/// crossings of the curve.
pub(super) fn check_crossings(
    document: &Document,
    curve: &Nurbs<DVec2>,
    line: u64,
    [of_polygon, of_curve]: [usize; 2],
    feedback: &str,
) -> Verdict {
    let ends = document.curve(ObjectId(line)).and_then(|line| {
        let (first, last) = (*line.points().first()?, *line.points().last()?);
        Hyperplane::new((last - first).perp(), (last - first).perp().dot(first)).ok()
    });
    let Some(line) = ends else {
        return Verdict::wrong(None, "The line is gone. Go back to the example.");
    };
    let meetings = match curve.intersect_hyperplane(&line, 1e-6 * polygon_size(curve).max(f64::MIN_POSITIVE))
    {
        Ok(meetings) => meetings,
        Err(error) => return Verdict::wrong(None, super::sentence(&error.to_string())),
    };
    if meetings.iter().any(|meeting| meeting.kind != IntersectionKind::Crossing) {
        return Verdict::wrong(None, "The curve touches the line or ends on it; move a point a little.");
    }
    let (polygon, crossings) = (variation(curve.points(), &line), meetings.len());
    if [polygon, crossings] == [of_polygon, of_curve] {
        return Verdict::right(crossings as f64, feedback);
    }
    let message = format!(
        "The polygon crosses the line {}, the curve {}; wanted are {} and {}.",
        times(polygon),
        times(crossings),
        times(of_polygon),
        times(of_curve)
    );
    Verdict::wrong(Some(crossings as f64), message)
}

/// Judges whether `curve` stays on the circle with its tangent at the start that passes through its end; measured is the
/// largest distance as a share of the radius.
pub(super) fn check_circle(curve: &Nurbs<DVec2>, tolerance: f64, feedback: &str) -> Verdict {
    let (left, right) = curve.space().parameter_interval();
    let (Ok(start), Ok(end)) = (curve.derivatives(left, 1, Side::Right), curve.evaluate(right)) else {
        return Verdict::wrong(None, "The curve cannot be measured.");
    };
    let chord = end - start[0];
    let normal = start[1].normalize_or_zero().perp();
    let radius = chord.length_squared() / (2.0 * chord.dot(normal));
    if !radius.is_finite() {
        return Verdict::wrong(None, "The tangent at the start points to the end: there is no circle.");
    }
    let (center, radius) = (start[0] + normal * radius, radius.abs());
    let mut worst = 0.0_f64;
    for i in 0..=SAMPLES {
        let Ok(point) = curve.evaluate(left + (right - left) * i as f64 / SAMPLES as f64) else { continue };
        let away = (point.distance(center) - radius) / radius;
        if away.abs() > worst.abs() {
            worst = away;
        }
    }
    if worst.abs() <= tolerance {
        return Verdict::right(worst.abs(), feedback);
    }
    let (percent, side) = (short_number(100.0 * worst.abs()), if worst > 0.0 { "outside" } else { "inside" });
    Verdict::wrong(
        Some(worst.abs()),
        format!(
            "The curve is up to {percent} % of the radius {side} the circle that touches it at the start."
        ),
    )
}
