//! What is painted over the scene: the stencil of a vertex, and the arrows along the axes.

use eframe::egui::{self, Align2, Pos2, Rect, Stroke, vec2};
use glam::DVec3;

use crate::app::lab::Lab;
use crate::app::painter::{color32, paint_note};
use crate::app::scene_view::{AXIS_INKS, screen_from_page};
use crate::app::surfaces::stencil::{StencilView, weight_text};
use crate::app::surfaces::target::{Target, arrows};
use crate::figure::scene::EyeView;

/// Most weights that are written at their vertices.
const MOST_WEIGHTS: usize = 40;

pub(super) fn paint_stencil(
    stencil: &StencilView,
    lab: &Lab,
    place: &dyn Fn(DVec3) -> Option<Pos2>,
    painter: &egui::Painter,
) {
    let Some(at) = place(stencil.at) else { return };
    let (ink, theme) = (color32(lab.theme.accent), &lab.theme);
    let parents: Vec<(Pos2, f64)> =
        stencil.parents.iter().filter_map(|&(_, parent, weight)| Some((place(parent)?, weight))).collect();
    let largest = parents.iter().map(|parent| parent.1.abs()).fold(f64::MIN_POSITIVE, f64::max);
    for &(parent, weight) in &parents {
        let share = (weight.abs() / largest) as f32;
        painter.line_segment(
            [at, parent],
            Stroke::new(1.0 + 1.5 * share, ink.gamma_multiply(0.3 + 0.5 * share)),
        );
        painter.circle(parent, 4.0 + 6.0 * share.sqrt(), ink.gamma_multiply(0.45), Stroke::new(1.5, ink));
    }
    painter.circle(at, 5.0, color32(theme.background), Stroke::new(3.0, ink));
    if parents.len() <= MOST_WEIGHTS {
        for (parent, weight) in parents {
            let size = 12.0 * theme.text_scale as f32;
            let at = parent + vec2(12.0, -8.0);
            paint_note(
                painter,
                at,
                Align2::LEFT_BOTTOM,
                &weight_text(weight),
                size,
                theme.text,
                theme.background,
            );
        }
    }
}

pub(super) fn paint_arrows(lab: &Lab, view: &EyeView, rect: Rect, hovered: Target, painter: &egui::Painter) {
    for arrow in arrows(lab, view) {
        let ink = color32(lab.theme.basis_color(AXIS_INKS[arrow.axis]));
        let (from, to) = (screen_from_page(rect, arrow.from), screen_from_page(rect, arrow.to));
        let width = if hovered == Target::Arrow(arrow.axis) { 4.0 } else { 2.5 };
        let way = (to - from).normalized();
        painter.line_segment([from, to - way * 6.0], Stroke::new(width, ink));
        let side = way.rot90() * 5.0;
        let tip = vec![to + way * 4.0, to - way * 8.0 + side, to - way * 8.0 - side];
        painter.add(egui::Shape::convex_polygon(tip, ink, Stroke::NONE));
        let font = egui::FontId::proportional(11.0);
        painter.text(to + way * 13.0, Align2::CENTER_CENTER, ["x", "y", "z"][arrow.axis], font, ink);
    }
}
