//! Small buttons with drawn signs, which no font has to know.

use std::f32::consts::TAU;

use eframe::egui::{
    Color32, Painter, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

/// The sign on a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Icon {
    /// Triangle to the right.
    Play,
    /// Two bars.
    Pause,
    /// Bar and triangle to the right.
    Forward,
    /// Triangle to the left and bar.
    Back,
    /// Two bars and triangle to the left.
    ToStart,
    /// Open eye.
    Shown,
    /// Closed eye.
    Hidden,
    /// Triangle up.
    Up,
    /// Triangle down.
    Down,
    /// Check mark.
    Check,
}

/// A button with a sign, called `label` in tooltips and for screen readers.
pub(crate) fn button(ui: &mut Ui, icon: Icon, label: &str, enabled: bool) -> Response {
    let side = ui.spacing().interact_size.y;
    let (rect, response) =
        ui.allocate_exact_size(Vec2::splat(side), if enabled { Sense::click() } else { Sense::hover() });
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, label));
    let visuals = ui.style().interact(&response);
    if enabled && (response.hovered() || response.has_focus()) {
        ui.painter().rect_filled(rect, visuals.corner_radius, visuals.weak_bg_fill);
    }
    let ink = visuals.text_color().gamma_multiply(if enabled { 1.0 } else { 0.35 });
    paint(ui.painter(), icon, rect.shrink(side * 0.24), ink);
    response.on_hover_text(label)
}

/// Paints the sign into a square.
pub(crate) fn paint(painter: &Painter, icon: Icon, rect: Rect, ink: Color32) {
    let at = |x: f32, y: f32| pos2(rect.left() + x * rect.width(), rect.top() + y * rect.height());
    let fill = |corners: &[(f32, f32)]| {
        let corners = corners.iter().map(|&(x, y)| at(x, y)).collect();
        painter.add(Shape::convex_polygon(corners, ink, Stroke::NONE));
    };
    let bar = |from: f32, to: f32| fill(&[(from, 0.05), (to, 0.05), (to, 0.95), (from, 0.95)]);
    let pen = Stroke::new(1.4, ink);
    match icon {
        Icon::Play => fill(&[(0.1, 0.0), (0.95, 0.5), (0.1, 1.0)]),
        Icon::Pause => {
            bar(0.15, 0.4);
            bar(0.6, 0.85);
        }
        Icon::Forward => {
            bar(0.05, 0.2);
            fill(&[(0.35, 0.05), (1.0, 0.5), (0.35, 0.95)]);
        }
        Icon::Back => {
            bar(0.8, 0.95);
            fill(&[(0.65, 0.05), (0.0, 0.5), (0.65, 0.95)]);
        }
        Icon::ToStart => {
            bar(0.0, 0.14);
            fill(&[(0.95, 0.05), (0.25, 0.5), (0.95, 0.95)]);
        }
        Icon::Up => fill(&[(0.5, 0.2), (0.95, 0.8), (0.05, 0.8)]),
        Icon::Down => fill(&[(0.05, 0.2), (0.95, 0.2), (0.5, 0.8)]),
        Icon::Check => {
            painter
                .add(Shape::line(vec![at(0.05, 0.55), at(0.4, 0.9), at(0.95, 0.1)], Stroke::new(1.8, ink)));
        }
        Icon::Shown | Icon::Hidden => {
            let lid = |sign: f32| -> Vec<_> {
                let shares = (0..=12).map(|i| i as f32 / 12.0);
                shares.map(|share| at(share, 0.5 + sign * 0.36 * (share * TAU * 0.5).sin())).collect()
            };
            painter.add(Shape::line(lid(1.0), pen));
            if icon == Icon::Shown {
                painter.add(Shape::line(lid(-1.0), pen));
                painter.circle_filled(rect.center(), rect.width() * 0.17, ink);
            } else {
                for share in [0.2, 0.5, 0.8] {
                    let x = share;
                    let y = 0.5 + 0.36 * (share * TAU * 0.5).sin();
                    painter.line_segment([at(x, y), at(x, y) + vec2((x - 0.5) * 5.0, 3.5)], pen);
                }
            }
        }
    }
}
