//! What is selected and under the pointer, and the names of everything that can be dragged.

use eframe::egui::{self, Align2, Painter, Rect, Stroke, vec2};
use glam::DVec2;

use crate::app::approximation::canvas::{SelectedKnot, screen_from_page};
use crate::app::approximation::hit::Target;
use crate::app::lab::{Hovered, Lab};
use crate::app::painter::{color32, paint_note};
use crate::document::Approximation;
use crate::figure::approximation::{Layout, error_text};

/// Above so many data or knots none is announced.
const ANNOUNCED: usize = 200;
/// More rings than so many cannot be told apart.
const MOST_RINGS: usize = 3000;

/// Paints rings and notes.
pub(super) fn paint(
    approximation: &Approximation,
    layout: &Layout,
    lab: &Lab,
    knot: Option<SelectedKnot>,
    target: Target,
    rect: Rect,
    painter: &Painter,
) {
    let ink = color32(lab.theme.selection);
    let (sites, values) = (approximation.sites(), approximation.values());
    let place = |index: usize| {
        let at = layout.main.place(*sites.get(index)?, *values.get(index)?);
        layout.main.contains(at).then(|| screen_from_page(at, rect))
    };
    for at in lab.selection.points.iter().take(MOST_RINGS).filter_map(|&index| place(index)) {
        painter.circle_stroke(at, 7.0, Stroke::new(2.0, ink));
    }
    let note = |at: egui::Pos2, text: &str| {
        let size = 12.0 * lab.theme.text_scale as f32;
        let corner = at + vec2(12.0, -10.0);
        paint_note(painter, corner, Align2::LEFT_BOTTOM, text, size, lab.theme.text, lab.theme.background);
    };
    if let Hovered::Point(object, index) = lab.hovered
        && Some(object) == lab.selection.object
        && let Some(at) = place(index)
    {
        painter.circle_stroke(at, 9.0, Stroke::new(2.5, ink));
        note(at, &format!("{index}: ({}, {})", error_text(sites[index]), error_text(values[index])));
    }
    let on_row = |method: usize, index: usize| {
        let row = layout.rows.iter().find(|row| row.method == method)?;
        let &knot = row.knots.get(index)?;
        let x = layout.main.place(knot, layout.main.y[0]).x;
        let seen = layout.main.low.x - 1.0 <= x && x <= layout.main.high.x + 1.0;
        seen.then(|| (screen_from_page(DVec2::new(x, row.y), rect), knot))
    };
    if let Some((at, _)) = knot.and_then(|(_, method, index)| on_row(method, index)) {
        painter.circle_stroke(at, 8.0, Stroke::new(2.0, ink));
    }
    if let Target::Knot(method, index) = target
        && let Some((at, knot)) = on_row(method, index)
    {
        painter.circle_stroke(at, 8.0, Stroke::new(1.5, ink));
        note(at, &error_text(knot));
    }
}

/// What can be dragged: accessible name and place on the page.
pub(super) fn named(approximation: &Approximation, name: &str, layout: &Layout) -> Vec<(String, DVec2)> {
    let mut named = Vec::new();
    if approximation.len() <= ANNOUNCED {
        let data = approximation.sites().iter().zip(approximation.values()).enumerate();
        named.extend(data.map(|(i, (&x, &y))| (format!("Datum {i} of {name}"), layout.main.place(x, y))));
    }
    for row in &layout.rows {
        let has_knots = approximation.methods().get(row.method).is_some_and(|m| m.scheme.space().is_some());
        if !has_knots || row.knots.len() > ANNOUNCED {
            continue;
        }
        named.extend(row.knots.iter().enumerate().map(|(index, &knot)| {
            let at = DVec2::new(layout.main.place(knot, layout.main.y[0]).x, row.y);
            (format!("Knot {index} of method {} of {name}", row.method + 1), at)
        }));
    }
    named.retain(|(_, at)| at.is_finite());
    named
}

/// Tells assistive programs (and tests) what can be dragged.
pub(super) fn announce(
    approximation: &Approximation,
    name: &str,
    layout: &Layout,
    rect: Rect,
    ui: &egui::Ui,
) {
    for (name, at) in named(approximation, name, layout) {
        let area = Rect::from_center_size(screen_from_page(at, rect), vec2(16.0, 16.0));
        if rect.contains_rect(area) {
            let id = ui.make_persistent_id(("handle", &name));
            let response = ui.interact(area, id, egui::Sense::hover());
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        }
    }
}
