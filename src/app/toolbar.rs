//! The row of tools under the menu: the rooms' tabs, undo and redo, and what the room brings along.

use eframe::egui::{self, Button, RichText, Ui};

use crate::app::command::Command;
use crate::app::command_state::{is_on, is_possible, key_text};
use crate::app::lab::Lab;
use crate::app::workspace::{Room, Workspace};

/// In narrower windows the tools stand closer.
const ROOMY: f32 = 1150.0;

/// Shows the tabs and the tools; what they do is pushed to `lab.commands`.
pub(crate) fn show(lab: &mut Lab, workspace: &mut dyn Workspace, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        let is_narrow = ui.available_width() < ROOMY * lab.theme.text_scale as f32;
        ui.spacing_mut().item_spacing.x = if is_narrow { 1.0 } else { 4.0 };
        if is_narrow {
            ui.spacing_mut().button_padding.x = 4.0;
        }
        // One room needs no doors.
        if Room::ALL.len() > 1 {
            for room in Room::ALL {
                if ui.selectable_label(lab.room() == room, room.title()).clicked() {
                    lab.enter(room);
                }
            }
            ui.separator();
        }
        let (undo, redo) = (lab.undo_name().map(str::to_owned), lab.redo_name().map(str::to_owned));
        step("⟲", "Undo", Command::Undo, undo, lab, ui);
        step("⟳", "Redo", Command::Redo, redo, lab, ui);
        ui.separator();
        workspace.tools(lab, ui);
        ui.separator();
        button("Fit", Command::Fit, lab, ui);
    });
}

/// A button with one word for `command`: pressed while what the command switches is on.
pub(crate) fn button(word: &str, command: Command, lab: &mut Lab, ui: &mut Ui) {
    let key = key_text(command, ui.ctx()).map(|key| format!("  ({key})"));
    let hint = format!("{}{}", command.text().1, key.unwrap_or_default());
    let button = match is_on(command, lab) {
        Some(on) => Button::selectable(on, word),
        None => Button::new(word).frame_when_inactive(false),
    };
    if ui.add_enabled(is_possible(command, lab), button).on_hover_text(hint).clicked() {
        lab.commands.push(command);
    }
}

/// An entry for `command` with its key, ticked while what the command switches is on; whether it was clicked.
pub(crate) fn menu_item(command: Command, lab: &mut Lab, ui: &mut Ui) -> bool {
    let ((text, hint), on, possible) = (command.text(), is_on(command, lab), is_possible(command, lab));
    let mut button = Button::selectable(on == Some(true), text);
    if let Some(key) = key_text(command, ui.ctx()) {
        button = button.shortcut_text(key);
    }
    let response = ui.add_enabled(possible, button).on_hover_text(hint);
    response.widget_info(|| match on {
        Some(on) => egui::WidgetInfo::selected(egui::Role::CheckBox, possible, on, text),
        None => egui::WidgetInfo::labeled(egui::Role::Button, possible, text),
    });
    if response.clicked() {
        lab.commands.push(command);
    }
    response.clicked()
}

fn step(sign: &str, word: &str, command: Command, name: Option<String>, lab: &mut Lab, ui: &mut Ui) {
    let hint = match &name {
        Some(name) => format!("{word}: {name}"),
        None => format!("Nothing to {}", word.to_lowercase()),
    };
    let button = Button::new(RichText::new(sign)).frame_when_inactive(false);
    let response = ui.add_enabled(name.is_some(), button).on_hover_text(&hint).on_disabled_hover_text(&hint);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, name.is_some(), word));
    if response.clicked() {
        lab.commands.push(command);
    }
}
