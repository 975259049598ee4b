//! The line at the bottom: what was done to the shape, what is selected, and the zoom.

use eframe::egui::{Align, Layout, RichText, Ui};

use crate::app::lab::Lab;
use crate::app::painter::color32;

/// Shows the line; `workspace` stands at its right end.
pub(crate) fn show(lab: &Lab, workspace: &str, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let muted = color32(lab.theme.muted_text);
        if let Some(object) = lab.selection.object.and_then(|id| lab.history.document().object(id)) {
            let text = format!("{}: {}", object.name, object.content.summary());
            ui.label(RichText::new(text).small().color(muted));
        }
        if let Some(note) = &lab.shape_note {
            ui.separator();
            ui.label(RichText::new(note).small());
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(RichText::new(workspace).small().color(muted));
        });
    });
}
