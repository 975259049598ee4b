//! The `n + 1` values at t as bars.

use eframe::egui::{Align2, FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::app::knot_line::Scene;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::compact;
use crate::app::painter::color32;

/// Width of the column of bars in a knot line `total` wide; 0 where there is no room.
pub(super) fn width(total: f32, bars: usize) -> f32 {
    if total < 420.0 { 0.0 } else { (bars as f32 * 20.0).clamp(60.0, 0.22 * total) + 12.0 }
}

/// Shows the bars in `rect`.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, scene: &Scene, rect: Rect) {
    let painter = ui.painter_at(rect);
    let count = scene.active.values.len();
    let (bottom, top) = (scene.plot.bottom(), scene.plot.top() + 6.0);
    let pitch = rect.width() / count.max(1) as f32;
    let muted = color32(lab.theme.muted_text);
    painter.hline(rect.x_range(), bottom, Stroke::new(1.0, color32(lab.theme.axis)));
    painter.hline(rect.x_range(), top, Stroke::new(1.0, color32(lab.theme.grid_major)));
    let small = FontId::proportional(10.0);
    let any_lit = scene.any_lit(lab);
    for (j, (&k, &value)) in scene.active.coefficients.iter().zip(&scene.active.values).enumerate() {
        let cell = Rect::from_min_max(
            pos2(rect.left() + pitch * j as f32, rect.top()),
            pos2(rect.left() + pitch * (j + 1) as f32, rect.bottom()),
        );
        let response = ui.interact(cell, ui.make_persistent_id(("bar", j)), Sense::hover());
        response.widget_info(|| {
            WidgetInfo::labeled(Role::Meter, true, format!("Value of B-spline {k}: {}", compact(value)))
        });
        if response.hovered() {
            lab.hovering = Hovered::Point(scene.object, k);
        }
        let opacity = if !any_lit || scene.is_lit(lab, k) { 1.0 } else { 0.35 };
        let color = Scene::color(lab, k).gamma_multiply(opacity);
        let half = (pitch * 0.35).min(9.0);
        let x = cell.center().x;
        let height = (bottom - top) * value.clamp(0.0, 1.0) as f32;
        painter.rect_filled(
            Rect::from_min_max(pos2(x - half, bottom - height), pos2(x + half, bottom)),
            1.5,
            color,
        );
        let mut font = small.clone();
        let digits = k.to_string();
        font.size = font.size.min(1.6 * (pitch - 2.0) / digits.len() as f32).max(6.0);
        painter.text(pos2(x, bottom + 3.0), Align2::CENTER_TOP, digits, font, color);
        if pitch >= 18.0 {
            let text = if value > 0.0 && value < 0.005 { "~0".to_owned() } else { format!("{value:.2}") };
            painter.text(pos2(x, bottom + 16.0), Align2::CENTER_TOP, text, FontId::proportional(9.0), muted);
        }
    }
    painter.text(
        rect.right_bottom() - vec2(2.0, 2.0),
        Align2::RIGHT_BOTTOM,
        "values at t, sum 1",
        FontId::proportional(9.5),
        muted,
    );
}
