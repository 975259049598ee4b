//! What the mark under the resting pointer is, with its numbers.

use eframe::egui::{PopupAnchor, Pos2, Rect, RichText, Tooltip, Ui};

use crate::app::lab::Lab;
use crate::app::painter::world_from_screen;
use crate::figure::composition::marks_near;
use crate::figure::picture::Viewport;

/// Seconds that the pointer must rest.
const DELAY: f32 = 0.35;
/// Distance in pt up to which a mark is under the pointer.
const REACH: f64 = 8.0;

/// Shows the notes of the marks at `pointer`.
pub(super) fn show(lab: &Lab, viewport: &Viewport, rect: Rect, pointer: Pos2, ui: &Ui) {
    let rested = ui.input(|input| input.pointer.time_since_last_movement());
    if rested < DELAY {
        ui.request_repaint_after_secs(DELAY - rested);
        return;
    }
    let place = world_from_screen(viewport, rect, pointer);
    let notes = marks_near(lab.history.document(), place, REACH / viewport.scale);
    if notes.is_empty() {
        return;
    }
    let id = ui.make_persistent_id("marks under the pointer");
    let tooltip = Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), id, PopupAnchor::Pointer);
    tooltip.gap(16.0).show(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        for note in notes {
            ui.label(RichText::new(note.title).strong());
            ui.label(note.facts.join(", "));
        }
    });
}
