//! The look that all dialogs share.

use eframe::egui::{Button, Frame, Id, Modal, ModalResponse, RichText, Stroke, Ui};

/// A box over everything else, at most `width` logical pixels wide inside, that takes all clicks.
pub(crate) fn show<T>(
    name: &str,
    width: f32,
    ui: &Ui,
    content: impl FnOnce(&mut Ui) -> T,
) -> ModalResponse<T> {
    let room = ui.ctx().content_rect().width();
    let frame = Frame::popup(&ui.ctx().global_style()).inner_margin(16.0).corner_radius(8.0);
    Modal::new(Id::unique(name)).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width(width.min(room - 60.0));
        content(ui)
    })
}

/// The button that Enter presses too.
pub(crate) fn main_button(word: &str, ui: &Ui) -> Button<'static> {
    let visuals = ui.visuals();
    let text = RichText::new(word).color(visuals.strong_text_color());
    Button::new(text)
        .fill(visuals.selection.bg_fill)
        .stroke(Stroke::new(1.0, visuals.hyperlink_color.gamma_multiply(0.6)))
}
