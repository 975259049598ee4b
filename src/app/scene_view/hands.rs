//! Drags and the wheel move the eye.

use std::f64::consts::PI;

use eframe::egui::{CursorIcon, Key, PointerButton, Response, Ui};
use glam::DVec2;

use crate::app::scene_view::{page_from_screen, view_through};
use crate::figure::scene::Eye;

/// A drag across this many pt turns the scene by half a turn.
const HALF_TURN: f64 = 480.0;
/// Turning the wheel by this many pt makes things *e* times as large, as on the canvas of curves.
const WHEEL: f64 = 240.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    Orbit,
    Pan,
}

/// What the hands are doing.
#[derive(Debug, Default)]
pub(super) struct Hands {
    motion: Option<Motion>,
}

impl Hands {
    pub(super) fn is_moving(&self) -> bool {
        self.motion.is_some()
    }

    pub(super) fn move_eye(&mut self, eye: &mut Eye, response: &Response, ui: &Ui) {
        self.motion = held(ui).filter(|_| response.is_pointer_button_down_on());
        let rect = response.rect;
        if let Some(motion) = self.motion {
            let moved = ui.input(|input| input.pointer.delta());
            let moved = DVec2::new(f64::from(moved.x), f64::from(moved.y));
            *eye = match motion {
                // The near side of the scene follows the pointer.
                Motion::Orbit => {
                    let angle = moved * (PI / HALF_TURN);
                    eye.orbited(-angle.x, angle.y)
                }
                Motion::Pan => view_through(*eye, rect).panned(moved),
            };
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
        let (alt, scroll, pinch, pointer) = ui.input(|input| {
            let scroll = input.smooth_scroll_delta();
            (input.modifiers.alt, scroll, input.zoom_delta(), input.pointer.hover_pos())
        });
        // Shift makes some systems turn the wheel sideways.
        let factor = f64::from(pinch) * (f64::from(scroll.x + scroll.y) / WHEEL).exp();
        if let Some(pointer) = pointer.filter(|_| response.contains_pointer() && !alt)
            && (factor - 1.0).abs() > 1e-9
        {
            *eye = view_through(*eye, rect).zoomed(page_from_screen(rect, pointer), factor);
        }
    }
}

/// The motion that the buttons and keys held down ask for.
fn held(ui: &Ui) -> Option<Motion> {
    let space = !ui.text_edit_focused() && ui.input(|input| input.key_down(Key::Space));
    ui.input(|input| {
        let pointer = &input.pointer;
        let turns = pointer.middle_down() || (space && pointer.primary_down());
        // A click with the right button that hardly moves is for the menu.
        let pans = pointer.button_down(PointerButton::Secondary) && pointer.is_decidedly_dragging();
        match (turns, input.modifiers.shift) {
            (true, false) => Some(Motion::Orbit),
            (true, true) => Some(Motion::Pan),
            (false, _) => pans.then_some(Motion::Pan),
        }
    })
}
