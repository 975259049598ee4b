//! The little axes in the corner of a view, and the tools that turn the eye.

use eframe::egui::{self, Align2, FontId, Rect, Sense, Stroke, Ui, Vec2, pos2, vec2};
use glam::DVec3;

use crate::app::painter::color32;
use crate::document::EyeState;
use crate::figure::scene::{Eye, StandardView};
use crate::figure::theme::Theme;

/// Places in the palette of the colours of x, y and z: reddish, green and blue as in every program, but told apart by colour-blind
/// eyes.
pub(crate) const AXIS_INKS: [usize; 3] = [1, 2, 0];

/// Length of an arrow in pt.
const LENGTH: f32 = 30.0;
/// Distance of the middle from the corner of the view, in pt.
const INSET: f32 = 52.0;
/// Radius of an end with a letter, in pt.
const END: f32 = 8.5;
/// Radius of an end without.
const SMALL_END: f32 = 5.0;
/// An eye that looks along an axis up to this angle (its sine) is taken to look along it.
const ALONG: f64 = 1e-3;

/// The eye that looks from the side to which `direction` points, a unit vector. From above and below the yaw stays.
pub(crate) fn looking_from(eye: &Eye, direction: DVec3) -> Eye {
    let state = *eye.state();
    let yaw = if direction.truncate().length() > ALONG { direction.y.atan2(direction.x) } else { state.yaw };
    let pitch = direction.z.clamp(-1.0, 1.0).asin();
    Eye::new(EyeState { yaw, pitch, ..state }).unwrap_or(*eye)
}

/// Paints the axes in the lower left corner of `rect`; a click on an end turns the eye so that it looks from there, a second
/// one from the opposite side. Says whether the eye moved. To be called after the widget that fills the view.
pub(crate) fn axis_gizmo(eye: &mut Eye, rect: Rect, theme: &Theme, ui: &mut Ui) -> bool {
    if rect.width() < 4.0 * INSET || rect.height() < 4.0 * INSET {
        return false;
    }
    let middle = pos2(rect.left() + INSET, rect.bottom() - INSET);
    let axes = eye.axes();
    let inks = AXIS_INKS.map(|k| color32(theme.basis_color(k)));
    let names = ["x", "y", "z"];
    let mut ends: Vec<(usize, f64)> = (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]).collect();
    let towards = |&(axis, sign): &(usize, f64)| DVec3::AXES[axis].dot(axes.towards) * sign;
    ends.sort_by(|a, b| towards(a).total_cmp(&towards(b)));
    let ground = color32(theme.background);
    let mut turned = None;
    for (axis, sign) in ends {
        let direction = DVec3::AXES[axis] * sign;
        let shift = vec2(direction.dot(axes.right) as f32, -direction.dot(axes.up) as f32) * LENGTH;
        let (at, radius) = (middle + shift, if sign > 0.0 { END } else { SMALL_END });
        let name = format!("Look from {}{}", if sign > 0.0 { "" } else { "−" }, names[axis]);
        let id = ui.scope_id().with(("axis", axis, sign > 0.0));
        let place = Rect::from_center_size(at, Vec2::splat(2.0 * radius + 2.0));
        let response = ui.interact(place, id, Sense::click()).on_hover_text(&name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if response.clicked() {
            let is_there = axes.towards.dot(direction) > 1.0 - ALONG;
            turned = Some(looking_from(eye, if is_there { -direction } else { direction }));
        }
        let painter = ui.painter_at(rect);
        // What points away is paler.
        let depth = (0.5 + 0.5 * direction.dot(axes.towards)) as f32;
        let ink = ground.lerp_to_gamma(inks[axis], 0.45 + 0.55 * depth);
        if sign > 0.0 {
            painter.line_segment([middle, at], Stroke::new(2.0, ink));
            painter.circle_filled(at, radius, if response.hovered() { inks[axis] } else { ink });
            let letter = FontId::proportional(11.5);
            painter.text(at - vec2(0.0, 0.5), Align2::CENTER_CENTER, names[axis], letter, ground);
        } else {
            let fill = if response.hovered() { inks[axis] } else { ground.lerp_to_gamma(inks[axis], 0.25) };
            painter.circle(at, radius, fill, Stroke::new(1.25, ink));
        }
    }
    turned.is_some_and(|turned| {
        let moved = turned != *eye;
        *eye = turned;
        moved
    })
}

/// A menu that turns the eye to the usual views and changes the projection, for a row of tools; says whether the eye changed.
pub(crate) fn eye_tools(eye: &mut Eye, ui: &mut Ui) -> bool {
    let before = *eye;
    let menu = ui.menu_button("View", |ui| {
        ui.set_min_width(150.0);
        for view in StandardView::ALL {
            let (word, hint) = match view {
                StandardView::Front => ("Front", "Look along y: x to the right, z up"),
                StandardView::Top => ("Top", "Look down: x to the right, y up"),
                StandardView::Right => ("Right", "Look from x: y to the right, z up"),
                StandardView::Isometric => ("Isometric", "Look from the corner: all axes equally long"),
            };
            let is_there = eye.turned_to(view) == *eye;
            if ui.add(egui::Button::selectable(is_there, word)).on_hover_text(hint).clicked() {
                *eye = eye.turned_to(view);
                ui.close();
            }
        }
        ui.separator();
        let mut perspective = !eye.state().orthographic;
        if ui.checkbox(&mut perspective, "Perspective").on_hover_text("Else parallel projection").changed() {
            *eye = eye.with_orthographic(!perspective);
        }
    });
    menu.response.on_hover_text("Turn the eye to the front, the top, the right or the corner");
    *eye != before
}
