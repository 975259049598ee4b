//! What hands do in the same way on every plane canvas: pan and zoom, axis and grid while dragging, arrow keys.

use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Rect, Ui};
use glam::DVec2;

use crate::app::painter::world_from_screen;
use crate::document::Camera;
use crate::figure::picture::Viewport;
use crate::figure::ticks::grid_step;

/// A press that moves less than this many pixels is a click and changes nothing.
pub(crate) const DEAD_ZONE: f32 = 4.0;

/// Pixels within which Ctrl snaps to the grid.
const SNAP_REACH: f64 = 8.0;

/// Scales beyond these cannot be told from each other in f64 coordinates of ordinary size.
const SCALES: std::ops::RangeInclusive<f64> = 1e-12..=1e14;

/// The camera as a viewport of a canvas of `size`.
pub(crate) fn viewport_of(camera: &Camera, size: DVec2) -> Viewport {
    Viewport { center: camera.center, scale: camera.scale, size }
}

/// Changes the scale by `factor`.
pub(crate) fn zoom(camera: &mut Camera, factor: f64) {
    camera.scale = (camera.scale * factor).clamp(*SCALES.start(), *SCALES.end());
}

/// Brings the box from `low` to `high` into a canvas of `size`.
pub(crate) fn fit(camera: &mut Camera, low: DVec2, high: DVec2, size: DVec2, margin: f64) {
    let fitting = Viewport::fitting(low, high, size, margin);
    camera.center = fitting.center;
    camera.scale = fitting.scale.clamp(*SCALES.start(), *SCALES.end());
}

/// Middle drag or Space and drag pan, the wheel and two fingers zoom at the pointer. `busy` while something else is dragged.
pub(crate) fn move_camera(
    camera: &mut Camera,
    panning: &mut bool,
    busy: bool,
    response: &egui::Response,
    rect: Rect,
    ui: &Ui,
) {
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let space = ui.input(|input| input.key_down(Key::Space)) && !ui.text_edit_focused();
    let middle = ui.input(|input| input.pointer.button_down(PointerButton::Middle));
    let primary = ui.input(|input| input.pointer.primary_down());
    let pan_keys = middle || (space && primary);
    if pan_keys && (*panning || response.contains_pointer()) && !busy {
        *panning = true;
        let moved = ui.input(|input| input.pointer.delta());
        camera.center -= DVec2::new(f64::from(moved.x), -f64::from(moved.y)) / camera.scale;
    } else {
        *panning = false;
    }
    let alt = ui.input(|input| input.modifiers.alt);
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    let factor = f64::from(pinch) * (f64::from(scroll.y) / 240.0).exp();
    if let Some(pointer) =
        ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer() && !alt)
        && (factor - 1.0).abs() > 1e-9
    {
        let before = world_from_screen(&viewport_of(camera, size), rect, pointer);
        zoom(camera, factor);
        let after = world_from_screen(&viewport_of(camera, size), rect, pointer);
        camera.center += before - after;
    }
}

/// Where the left button went down in this frame: in a slow frame the pointer has moved on since.
pub(crate) fn pressed_at(ui: &Ui) -> Option<Pos2> {
    ui.input(|input| {
        input.events.iter().find_map(|event| match *event {
            egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, .. } => {
                Some(pos)
            }
            _ => None,
        })
    })
}

/// Distance of the finest lines of the grid; 1 where the zoom is beyond every grid.
pub(crate) fn fine_step(viewport: &Viewport) -> f64 {
    grid_step(viewport).map_or(1.0, |step| step.finer().size())
}

/// The way of a drag that began at `grabbed`: with Shift along one axis, with Ctrl to a line of the grid nearby.
pub(crate) fn constrained(mut delta: DVec2, grabbed: DVec2, viewport: &Viewport, keys: Modifiers) -> DVec2 {
    if keys.shift {
        // Along the axis that the pointer has followed farther.
        if delta.x.abs() >= delta.y.abs() { delta.y = 0.0 } else { delta.x = 0.0 }
    }
    if keys.command || keys.ctrl {
        let step = fine_step(viewport);
        let reach = SNAP_REACH / viewport.scale;
        for axis in 0..2 {
            let wanted = grabbed[axis] + delta[axis];
            let line = (wanted / step).round() * step;
            if (line - wanted).abs() <= reach && !(keys.shift && delta[axis] == 0.0) {
                delta[axis] = line - grabbed[axis];
            }
        }
    }
    delta
}

/// The ways that the arrow keys pressed in this frame ask for: a tenth of the grid, with Shift ten times, with Ctrl a tenth
/// of that. None while somebody types.
pub(crate) fn nudges(viewport: &Viewport, ui: &Ui) -> Vec<DVec2> {
    let mut nudges = Vec::new();
    if ui.memory(|memory| memory.focused().is_some() || memory.top_modal_layer().is_some()) {
        return nudges;
    }
    for (key, direction) in [
        (Key::ArrowLeft, -DVec2::X),
        (Key::ArrowRight, DVec2::X),
        (Key::ArrowUp, DVec2::Y),
        (Key::ArrowDown, -DVec2::Y),
    ] {
        for (keys, factor) in [(Modifiers::NONE, 1.0), (Modifiers::SHIFT, 10.0), (Modifiers::CTRL, 0.1)] {
            let pressed = ui.input_mut(|input| {
                let wanted = input.modifiers.shift == keys.shift && input.modifiers.ctrl == keys.ctrl;
                wanted && input.consume_key(input.modifiers, key)
            });
            if pressed {
                nudges.push(direction * 0.1 * fine_step(viewport) * factor);
            }
        }
    }
    nudges
}
