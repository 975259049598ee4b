//! What the room shows while it holds nothing.

use eframe::egui::{Align, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use crate::app::approximation::changes::new_approximation;
use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::document::Preset;

/// Width of the buttons.
const WIDTH: f32 = 300.0;
/// Height of everything.
const HEIGHT: f32 = 330.0;

/// Shows what one can start with.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, rect: Rect) {
    let size = vec2(WIDTH.min(rect.width() - 16.0), HEIGHT.min(rect.height() - 8.0));
    let area = Rect::from_center_size(rect.center(), size);
    let layout = Layout::top_down_justified(Align::Center);
    ui.scope_builder(UiBuilder::new().max_rect(area).layout(layout), |ui| {
        ui.spacing_mut().item_spacing.y = 7.0;
        ui.label(RichText::new("Start with…").heading());
        ui.label(RichText::new("data of your own").weak());
        if ui.button("Click points").on_hover_text("An empty plot, and the tool that adds data").clicked() {
            new_approximation(lab, None);
            lab.commands.push(Command::AddPointTool);
        }
        if ui.button("Import a table…").on_hover_text(Command::ImportData.text().1).clicked() {
            lab.commands.push(Command::ImportData);
        }
        ui.label(RichText::new("or drop a CSV file here, or paste a table").weak().small());
        ui.add_space(4.0);
        ui.label(RichText::new("an example").weak());
        for preset in Preset::ALL {
            if ui.button(preset.title()).on_hover_text(preset.hint()).clicked() {
                new_approximation(lab, Some(preset));
            }
        }
    });
}
