//! The `n + 1` values at t as bars.

use eframe::egui::{Align2, FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::app::knot_line::Scene;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::compact;
use crate::app::painter::color32;

/// What stands under the bars, the longest that has room.
const CAPTIONS: [&str; 3] = ["values at t, sum 1", "at t, sum 1", "sum 1"];

/// Type size of the caption, of the indices and of the values, before the theme's factor.
const SIZES: [f32; 3] = [9.5, 10.0, 9.0];

/// Width of a bar with its value in type of factor 1.
const PITCH: f32 = 22.0;

/// Width of the column of bars in a knot line `total` wide, with type of factor `scale`; 0 where there is no room. It is wide enough for the caption,
/// however few the bars are.
pub(super) fn width(total: f32, bars: usize, scale: f32) -> f32 {
    if total < 420.0 {
        0.0
    } else {
        (bars as f32 * PITCH * scale).clamp(96.0 * scale, 0.3 * total.max(320.0 * scale)) + 12.0
    }
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
    let scale = lab.theme.text_scale as f32;
    let [caption, index, number] = SIZES.map(|size| FontId::proportional(size * scale));
    // Where indices would touch, some are left out.
    let largest = scene.active.coefficients.iter().max().map_or(1, |k| k.to_string().len());
    let every = ((0.62 * index.size * largest as f32 + 3.0) / pitch).ceil().max(1.0) as usize;
    let has_values = pitch >= 2.2 * number.size;
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
        if j.is_multiple_of(every) {
            painter.text(pos2(x, bottom + 1.5), Align2::CENTER_TOP, k.to_string(), index.clone(), color);
        }
        if has_values {
            let text = if value > 0.0 && value < 0.005 { "~0".to_owned() } else { format!("{value:.2}") };
            let at = pos2(x, bottom + 1.5 + 1.15 * index.size);
            painter.text(at, Align2::CENTER_TOP, text, number.clone(), muted);
        }
        response.on_hover_text(format!("b_{k}(t) = {}", compact(value)));
    }
    let galleys = CAPTIONS.map(|words| painter.layout_no_wrap(words.to_owned(), caption.clone(), muted));
    if let Some(galley) = galleys.into_iter().find(|galley| galley.size().x + 4.0 <= rect.width()) {
        painter.galley(rect.right_bottom() - vec2(2.0, 0.0) - galley.size(), galley, muted);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_caption_has_room_whatever_the_degree_and_the_look() {
        for scale in [1.0, 1.4] {
            for bars in 1..=26 {
                for total in [420.0, 560.0, 1100.0] {
                    let width = width(total, bars, scale);
                    assert!(width >= 96.0 * scale + 12.0, "{bars} bars in {total}: {width}");
                    assert!(width <= 0.36 * total, "{bars} bars leave too little of {total}: {width}");
                }
            }
        }
    }
}
