//! Drags and the wheel move the eye.

use std::f64::consts::PI;

use eframe::egui::{CursorIcon, Event, Key, PointerButton, Pos2, Response, Ui};
use glam::DVec2;

use crate::app::scene_view::{page_from_screen, view_through};
use crate::figure::scene::Eye;

/// A drag across this many pt turns the scene by half a turn.
const HALF_TURN: f64 = 480.0;
/// Turning the wheel by this many pt makes things *e* times as large, as on the canvas of curves.
const WHEEL: f64 = 240.0;
/// A press with the right button that moves no farther than this many pt is a click.
const CLICK: f32 = 6.0;

/// A press that moves the eye.
#[derive(Clone, Copy, Debug)]
struct Hold {
    button: PointerButton,
    from: Pos2,
    /// Where the pointer was last.
    at: Pos2,
    moves: bool,
}

/// What the hands are doing.
#[derive(Debug, Default)]
pub(super) struct Hands {
    hold: Option<Hold>,
    /// Whether a press that moves the eye was there at any time in this frame.
    is_moving: bool,
}

impl Hands {
    pub(super) fn is_moving(&self) -> bool {
        self.is_moving
    }

    pub(super) fn move_eye(&mut self, eye: &mut Eye, response: &Response, ui: &Ui) {
        // Event by event: in a slow frame a whole drag may lie between two pictures.
        self.is_moving = self.hold.is_some_and(|hold| hold.moves);
        for event in ui.input(|input| input.events.clone()) {
            match event {
                Event::PointerButton { pos, button, pressed: true, .. }
                    if self.hold.is_none() && moves_eye(button, ui) && is_on(response, pos, ui) =>
                {
                    // A click with the right button that hardly moves is for the menu.
                    let moves = button != PointerButton::Secondary;
                    self.hold = Some(Hold { button, from: pos, at: pos, moves });
                    self.is_moving |= moves;
                }
                Event::PointerMoved(pos) => self.follow(pos, eye, response, ui),
                Event::PointerButton { pos, button, pressed: false, .. }
                    if self.hold.is_some_and(|hold| hold.button == button) =>
                {
                    self.follow(pos, eye, response, ui);
                    self.hold = None;
                }
                _ => {}
            }
        }
        // A release outside the window is not always told.
        if self.hold.is_some_and(|hold| !ui.input(|input| input.pointer.button_down(hold.button))) {
            self.hold = None;
        }
        if self.is_moving {
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
        let rect = response.rect;
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

    /// The pointer is at `to` now.
    fn follow(&mut self, to: Pos2, eye: &mut Eye, response: &Response, ui: &Ui) {
        let Some(hold) = &mut self.hold else { return };
        hold.moves |= hold.from.distance(to) > CLICK;
        if !hold.moves {
            return;
        }
        self.is_moving = true;
        let moved = to - std::mem::replace(&mut hold.at, to);
        let moved = DVec2::new(f64::from(moved.x), f64::from(moved.y));
        let pans = hold.button == PointerButton::Secondary || ui.input(|input| input.modifiers.shift);
        *eye = if pans {
            view_through(*eye, response.rect).panned(moved)
        } else {
            // The near side of the scene follows the pointer.
            let angle = moved * (PI / HALF_TURN);
            eye.orbited(-angle.x, angle.y)
        };
    }
}

/// Whether a press of `button` is meant for the eye.
fn moves_eye(button: PointerButton, ui: &Ui) -> bool {
    match button {
        PointerButton::Middle | PointerButton::Secondary => true,
        PointerButton::Primary => !ui.text_edit_focused() && ui.input(|input| input.key_down(Key::Space)),
        _ => false,
    }
}

/// Whether a place of the screen belongs to the widget and nothing lies over it.
fn is_on(response: &Response, at: Pos2, ui: &Ui) -> bool {
    response.interact_rect.contains(at)
        && ui.ctx().layer_id_at(at).is_none_or(|layer| layer == response.layer_id)
}
