//! The curves as they were before the last operation, thin and grey, where they are not the same now.

use std::sync::Arc;

use eframe::egui::{Painter, Rect, Shape, Stroke};
use glam::DVec2;

use crate::app::lab::Lab;
use crate::app::painter::{color32, screen_from_world};
use crate::core::spline_curve::Nurbs;
use crate::document::{Document, Object, ShapeChange};
use crate::figure::picture::Viewport;

/// Points on each knot interval.
const SAMPLES: usize = 24;
/// A curve with more points than this has no ghost: frames count while one drags.
const MOST_POINTS: usize = 500;
/// Pixels within which old and new are the same.
const SAME: f64 = 0.75;

/// The visible objects of `document` that are not the same in `other`.
fn differing<'a>(document: &'a Document, other: &'a Document) -> impl Iterator<Item = &'a Arc<Object>> {
    document.objects().iter().filter(|object| {
        object.visible && other.object(object.id).is_none_or(|found| !Arc::ptr_eq(object, found))
    })
}

pub(super) fn paint(lab: &Lab, viewport: &Viewport, rect: Rect, painter: &Painter) {
    let (Some(before), now) = (&lab.before, lab.history.document()) else { return };
    let new: Vec<&Nurbs<DVec2>> = differing(now, before).filter_map(|object| now.curve(object.id)).collect();
    let color = color32(lab.theme.muted_text);
    let stroke = Stroke::new(1.2 * lab.theme.stroke_scale as f32, color.gamma_multiply(0.8));
    let screen = |place| screen_from_world(viewport, rect, place);
    for object in differing(before, now) {
        let Some(curve) = before.curve(object.id).filter(|curve| curve.points().len() <= MOST_POINTS) else {
            continue;
        };
        if now.curve(object.id) == Some(curve) {
            continue;
        }
        let mut line = Vec::new();
        for pair in curve.space().breaks().windows(2) {
            for i in 0..=SAMPLES {
                let t = pair[0] + (pair[1] - pair[0]) * (i as f64 / SAMPLES as f64);
                let Ok(place) = curve.evaluate(t.min(pair[1])) else { continue };
                if new.iter().any(|new| passes(new, curve, t, place, SAME / viewport.scale)) {
                    painter.add(Shape::line(std::mem::take(&mut line), stroke));
                } else {
                    line.push(screen(place));
                }
            }
        }
        painter.add(Shape::line(line, stroke));
        // Where the shape is kept, the control points tell what was done.
        if matches!(lab.shape, ShapeChange::Kept { .. })
            && object.curve_display().is_some_and(|display| display.polygon)
        {
            let polygon: Vec<_> = curve.points().iter().map(|&point| screen(point)).collect();
            let thin = Stroke::new(lab.theme.stroke_scale as f32, color.gamma_multiply(0.6));
            painter.extend(Shape::dashed_line(&polygon, thin, 4.0, 4.0));
        }
    }
}

/// Whether `new` is at `place` at the parameter `t` of `old`, in the same or in the other direction.
fn passes(new: &Nurbs<DVec2>, old: &Nurbs<DVec2>, t: f64, place: DVec2, within: f64) -> bool {
    let (left, right) = old.space().parameter_interval();
    let period = old.space().period().unwrap_or(0.0);
    [t, left + right - t, t + period].into_iter().any(|t| {
        let (low, high) = new.space().parameter_interval();
        (low..=high).contains(&t) && new.evaluate(t).is_ok_and(|found| found.distance(place) <= within)
    })
}
