//! The row of tools under the menu.

use eframe::egui::{self, Button, RichText, Ui};

use crate::app::command::Command;
use crate::app::lab::{Lab, Tool};
use crate::document::CurveDisplay;

/// Shows the tabs of the workspaces and the tools; what they do is pushed to `lab.commands`.
pub(crate) fn show(lab: &mut Lab, workspaces: &[&str], current: &mut usize, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        // One room needs no doors.
        if workspaces.len() > 1 {
            for (index, &name) in workspaces.iter().enumerate() {
                ui.selectable_value(current, index, name);
            }
            ui.separator();
        }
        toggle("Select", Command::SelectTool, lab.tool == Tool::Select, lab, ui);
        toggle("Draw", Command::DrawTool, lab.tool == Tool::Draw, lab, ui);
        ui.separator();
        let (undo, redo) =
            (lab.history.undo_name().map(str::to_owned), lab.history.redo_name().map(str::to_owned));
        step("⟲", "Undo", Command::Undo, undo, lab, ui);
        step("⟳", "Redo", Command::Redo, redo, lab, ui);
        ui.separator();
        let display = selected_display(lab);
        let shown = |choice: fn(&CurveDisplay) -> bool| display.as_ref().is_some_and(choice);
        for (text, command, on) in [
            ("Polygon", Command::TogglePolygon, shown(|display| display.polygon)),
            ("Comb", Command::ToggleComb, shown(|display| display.comb)),
            ("Construction", Command::ToggleConstruction, shown(|display| display.construction)),
            ("Hull", Command::ToggleHull, shown(|display| display.hull)),
            ("Circle", Command::ToggleCircle, shown(|display| display.osculating_circle)),
        ] {
            toggle_if(display.is_some(), text, command, on, lab, ui);
        }
        ui.separator();
        push("Fit", Command::Fit, lab, ui);
    });
}

fn selected_display(lab: &Lab) -> Option<CurveDisplay> {
    lab.history.document().object(lab.selection.object?)?.curve_display().cloned()
}

fn hover_text(command: Command, ui: &Ui) -> String {
    let key = command.shortcut().map(|shortcut| format!("  ({})", ui.ctx().format_shortcut(&shortcut)));
    format!("{}{}", command.text().1, key.unwrap_or_default())
}

fn toggle(text: &str, command: Command, on: bool, lab: &mut Lab, ui: &mut Ui) {
    toggle_if(true, text, command, on, lab, ui);
}

fn toggle_if(possible: bool, text: &str, command: Command, on: bool, lab: &mut Lab, ui: &mut Ui) {
    let hint = hover_text(command, ui);
    if ui.add_enabled(possible, Button::selectable(on, text)).on_hover_text(hint).clicked() {
        lab.commands.push(command);
    }
}

fn push(text: &str, command: Command, lab: &mut Lab, ui: &mut Ui) {
    let hint = hover_text(command, ui);
    if ui.add(Button::new(text).frame_when_inactive(false)).on_hover_text(hint).clicked() {
        lab.commands.push(command);
    }
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
