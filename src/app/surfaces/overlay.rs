//! What is painted over the scene.

use eframe::egui::{self, Pos2, Rect, Stroke, StrokeKind, Ui};
use glam::DVec3;

use crate::app::lab::Lab;
use crate::app::painter::{color32, paint_hint, paint_picture};
use crate::app::scene_view::screen_from_page;
use crate::app::surfaces::canvas::Canvas;
use crate::app::surfaces::target::Target;
use crate::app::surfaces::{Picked, commands, marks};
use crate::document::{ObjectId, View};
use crate::figure::picture::{Color, Picture, Viewport};
use crate::figure::scene::EyeView;
use crate::figure::surfaces::{control_points, legend, legend_items};

/// Most selected points that are marked one by one.
const MARKED: usize = 2000;

/// Paints what is over the scene: selection, hovered things, stencil, arrows, the colour scale, a marquee, and what is said.
pub(super) fn paint(canvas: &Canvas, lab: &Lab, view: &EyeView, rect: Rect, pointer: Option<Pos2>, ui: &Ui) {
    let painter = ui.painter_at(rect);
    let theme = &lab.theme;
    let ink = color32(theme.selection);
    let place = |at: DVec3| Some(screen_from_page(rect, view.project(at)?.page));
    if let Some(object) = commands::selected(lab).filter(|object| object.visible) {
        let points = control_points(object);
        for at in lab.selection.points.iter().take(MARKED).filter_map(|&point| place(*points.get(point)?)) {
            painter.circle(at, 7.0, ink.gamma_multiply(0.35), Stroke::new(2.0, ink));
        }
    }
    match canvas.hovered {
        Target::Point(id, point) if canvas.gesture.is_none() => {
            let object = lab.history.document().object(id);
            let at = object.and_then(|object| control_points(object).get(point)).copied();
            if let Some(at) = at.and_then(place) {
                painter.circle_stroke(at, 8.5, Stroke::new(2.0, ink));
            }
        }
        Target::Edge(id, ends) => {
            paint_edge(lab, id, ends, &place, Stroke::new(3.0, ink.gamma_multiply(0.5)), &painter);
        }
        _ => {}
    }
    if let Picked::Edge(id, ends) = canvas.picked {
        paint_edge(lab, id, ends, &place, Stroke::new(3.5, ink), &painter);
    }
    if let Some(stencil) = canvas.stencil() {
        marks::paint_stencil(&stencil, lab, &place, &painter);
    }
    marks::paint_arrows(lab, view, rect, canvas.hovered, &painter);
    if let Some(legend) = legend(canvas.store.shown(), &selected_view(lab)) {
        let mut picture = Picture::new(None);
        picture.push_layer("colour scale", legend_items(legend, view.size, theme));
        let viewport = Viewport { center: view.size * 0.5, scale: 1.0, size: view.size };
        paint_picture(&picture, &viewport, rect, &painter);
    }
    if let Some(marquee) = canvas.gesture.as_ref().zip(pointer).and_then(|(g, at)| g.marquee(at)) {
        painter.rect(marquee, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), StrokeKind::Inside);
    }
    if let Some((text, color)) = said(canvas, lab) {
        paint_hint(&painter, rect, &text, color, theme);
    }
}

fn paint_edge(
    lab: &Lab,
    id: ObjectId,
    ends: [u32; 2],
    place: &dyn Fn(DVec3) -> Option<Pos2>,
    stroke: Stroke,
    painter: &egui::Painter,
) {
    let Some(mesh) = lab.history.document().object(id).and_then(|object| object.mesh()) else { return };
    let end = |end: u32| mesh.cage().positions().get(end as usize).copied().and_then(place);
    if let (Some(a), Some(b)) = (end(ends[0]), end(ends[1])) {
        painter.line_segment([a, b], stroke);
    }
}

/// The line at the top: what is wrong, what is going on, or what to do.
fn said(canvas: &Canvas, lab: &Lab) -> Option<(String, Color)> {
    if let Some(problem) = canvas.store.shown().find_map(|(_, shape)| shape.problem.as_ref()) {
        return Some((problem.clone(), lab.theme.error));
    }
    let untouched = lab.history.steps().0 <= 1 && lab.path.is_none() && lab.lesson.is_none();
    (untouched && !canvas.store.is_empty()).then(|| {
        let text = "Drag a round handle; hold X, Y or Z for an axis.  Middle drag turns, right drag moves, the wheel zooms.";
        (text.to_owned(), lab.theme.muted_text)
    })
}

/// The view with the selection of this moment.
fn selected_view(lab: &Lab) -> View {
    View { selected_object: lab.selection.object, ..View::default() }
}
