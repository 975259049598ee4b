//! The curves as they were before the last operation, thin and grey.

use std::sync::Arc;

use eframe::egui::{Painter, Rect, Shape, Stroke};
use glam::DVec2;

use crate::app::lab::Lab;
use crate::app::painter::{color32, screen_from_world};
use crate::core::spline_curve::Nurbs;
use crate::figure::picture::Viewport;

/// Points on each knot interval.
const SAMPLES: usize = 24;
/// A curve with more points than this gets no ghost while frames count.
const MOST_POINTS: usize = 2000;

/// The curves of the document before that are different now, or gone.
pub(super) fn curves(lab: &Lab) -> Vec<&Nurbs<DVec2>> {
    let Some(before) = &lab.before else { return Vec::new() };
    let now = lab.history.document();
    let changed = before.objects().iter().filter(|old| {
        old.visible && now.object(old.id).is_none_or(|new| !Arc::ptr_eq(old, new) && new.visible)
    });
    changed
        .filter_map(|old| {
            let curve = before.curve(old.id)?;
            (now.curve(old.id) != Some(curve) && curve.points().len() <= MOST_POINTS).then_some(curve)
        })
        .collect()
}

pub(super) fn paint(lab: &Lab, viewport: &Viewport, rect: Rect, painter: &Painter) {
    let color = color32(lab.theme.muted_text).gamma_multiply(0.75);
    let stroke = Stroke::new(lab.theme.stroke_scale as f32, color);
    for curve in curves(lab) {
        let mut points = Vec::new();
        for pair in curve.space().breaks().windows(2) {
            for i in 0..=SAMPLES {
                let t = pair[0] + (pair[1] - pair[0]) * (i as f64 / SAMPLES as f64);
                if let Ok(place) = curve.evaluate(t.min(pair[1])) {
                    points.push(screen_from_world(viewport, rect, place));
                }
            }
        }
        painter.add(Shape::line(points, stroke));
    }
}
