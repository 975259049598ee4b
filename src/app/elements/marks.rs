//! What can be dragged, as marks on the canvas.

use eframe::egui::{self, Painter, Pos2, Rect, Sense, Stroke, StrokeKind, Ui, vec2};
use glam::DVec2;

use crate::app::elements::hit::{Target, target_at};
use crate::app::elements::{Elements, Subject};
use crate::app::lab::Lab;
use crate::app::painter::{color32, screen_from_world};
use crate::document::Shape;
use crate::figure::elements::boundary;
use crate::figure::picture::Viewport;

/// Handles above this number are not announced one by one.
const ANNOUNCED: usize = 200;

/// The boundary of lit and selected parts, and all handles.
pub(super) fn paint(
    room: &Elements,
    subject: &Subject,
    lab: &Lab,
    (viewport, rect): (&Viewport, Rect),
    pointer: Option<Pos2>,
    painter: &Painter,
) {
    let theme = &lab.theme;
    let (selection, ground) = (color32(theme.selection), color32(theme.background));
    let place = |world: DVec2| screen_from_world(viewport, rect, world);
    let hovered = pointer
        .map_or(Target::Nothing, |at| target_at(&subject.membrane, &room.selected, viewport, rect, at))
        .handle();
    for (part, found) in subject.membrane.parts().iter().enumerate() {
        let is_lit = hovered.is_some_and(|id| id.part == part);
        if is_lit || room.selected.iter().any(|id| id.part == part) {
            let mut line: Vec<Pos2> = boundary(&found.shape).into_iter().map(place).collect();
            line.extend(line.first().copied());
            let pen = Stroke::new(2.0, selection.gamma_multiply(if is_lit { 0.9 } else { 0.6 }));
            painter.add(egui::Shape::line(line, pen));
        }
        if let Some((_, from)) = found.shape.handles().first()
            && let Shape::HalfPlane { normal, .. } = &found.shape
        {
            painter.arrow(
                place(*from),
                place(*from + *normal) - place(*from),
                Stroke::new(1.5, color32(theme.text)),
            );
        }
    }
    for (id, _, at) in subject.membrane.handles() {
        let at = place(at);
        let is_selected = room.selected.contains(&id);
        if subject.membrane.patch().is_some() {
            if is_selected {
                painter.circle(at, 8.0, selection.gamma_multiply(0.35), Stroke::new(2.0, selection));
            } else if hovered == Some(id) {
                painter.circle_stroke(at, 9.0, Stroke::new(2.5, selection));
            }
            continue;
        }
        let ink = if is_selected || hovered == Some(id) { selection } else { color32(theme.text) };
        let pen = Stroke::new(if hovered == Some(id) { 2.5 } else { 1.5 }, ink);
        let fill = if is_selected { selection } else { ground };
        if id.index == 0 {
            let square = Rect::from_center_size(at, vec2(9.0, 9.0));
            painter.rect(square, 1.0, fill, pen, StrokeKind::Middle);
        } else {
            painter.circle(at, 5.0, fill, pen);
        }
    }
}

/// Tells assistive programs (and tests) what can be dragged.
pub(super) fn announce(subject: &Subject, (viewport, rect): (&Viewport, Rect), ui: &Ui) {
    for (_, name, at) in subject.membrane.handles().into_iter().take(ANNOUNCED) {
        let area = Rect::from_center_size(screen_from_world(viewport, rect, at), vec2(18.0, 18.0));
        if rect.contains_rect(area) {
            let name = format!("{name} of {}", subject.name);
            let id = ui.make_persistent_id(("handle", &name));
            let response = ui.interact(area, id, Sense::hover());
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        }
    }
}
