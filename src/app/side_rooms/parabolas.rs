//! The plane of the two speeds: two parabolas, and a dot for every cubic.

use eframe::egui::{self, Align2, Pos2, Sense, Shape, Stroke, StrokeKind, Ui, vec2};

use crate::app::painter::{color32, paint_note};
use crate::app::side_rooms::hermite::{Equations, color};
use crate::core::bezier::GeometricHermite;
use crate::figure::theme::Theme;

/// Places of a parabola that are joined by lines.
const STEPS: u32 = 160;

/// Shows the parabolas; gives back the solution that was clicked.
pub(super) fn show(
    ui: &mut Ui,
    theme: &Theme,
    equations: &Equations,
    solutions: &[GeometricHermite],
    chosen: usize,
) -> Option<usize> {
    let side = ui.available_width().min(190.0 * theme.text_scale as f32);
    let (rect, response) = ui.allocate_exact_size(vec2(side, side * 0.8), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Parabolas of the speeds"));
    let painter = ui.painter_at(rect);
    let edge = Stroke::new(1.0, color32(theme.grid_major));
    painter.rect(rect, 3.0, color32(theme.background), edge, StrokeKind::Inside);
    let places: Vec<[f64; 2]> =
        solutions.iter().map(|s| s.speeds.map(|speed| speed / equations.chord)).collect();
    let most = places.iter().flatten().fold(2.0_f64, |most, &speed| most.max(speed));
    let (low, high) = (-0.25 * most, 1.25 * most);
    let page = |[a, b]: [f64; 2]| {
        let share = |value: f64| ((value - low) / (high - low)) as f32;
        Pos2::new(rect.left() + share(a) * rect.width(), rect.bottom() - share(b) * rect.height())
    };
    let axis = Stroke::new(1.0, color32(theme.axis));
    painter.line_segment([page([low, 0.0]), page([high, 0.0])], axis);
    painter.line_segment([page([0.0, low]), page([0.0, high])], axis);
    // The two curves are drawn as graphs of the unknown that stands alone; with parallel directions they are lines.
    for (k, ink) in [theme.comb, theme.warning].into_iter().enumerate() {
        let stroke = Stroke::new(1.6, color32(ink));
        let (curvature, right, turn) = (equations.curvatures[k], equations.right[k], 2.0 * equations.turn);
        let place = |own: f64, other: f64| if k == 0 { page([own, other]) } else { page([other, own]) };
        if turn.abs() < 1e-12 {
            let own = (right / curvature).sqrt();
            if own.is_finite() {
                painter.line_segment([place(own, low), place(own, high)], stroke);
            }
            continue;
        }
        let line = (0..=STEPS).map(|step| low + (high - low) * f64::from(step) / f64::from(STEPS));
        let line: Vec<Pos2> = line
            .map(|own| place(own, (right - curvature * own * own) / turn))
            .filter(|at| at.is_finite() && at.distance(rect.center()) < 1e5)
            .collect();
        painter.add(Shape::line(line, stroke));
    }
    let size = 12.0 * theme.text_scale as f32;
    let (ink, ground) = (theme.muted_text, theme.background);
    let at = page([high, 0.0]) + vec2(-8.0, 12.0);
    paint_note(&painter, at, Align2::RIGHT_CENTER, "\u{3b1}\u{2080}", size, ink, ground);
    let at = page([0.0, high]) + vec2(-8.0, 12.0);
    paint_note(&painter, at, Align2::RIGHT_CENTER, "\u{3b1}\u{2081}", size, ink, ground);
    for (k, &at) in places.iter().enumerate() {
        let ring = if k == chosen { Stroke::new(2.0, color32(theme.text)) } else { Stroke::NONE };
        painter.circle(page(at), 5.0, color32(color(theme, k)), ring);
    }
    let pointer = response.interact_pointer_pos().filter(|_| response.clicked())?;
    let near = places.iter().enumerate().map(|(k, &at)| (k, page(at).distance(pointer)));
    near.filter(|&(_, far)| far < 12.0).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
}
