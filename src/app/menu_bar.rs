//! The menus: every command under its title, with its key.

use std::path::PathBuf;

use eframe::egui::{self, Button, MenuBar, RichText, Ui};

use crate::app::command::{Command, Menu};
use crate::app::command_state::{is_on, is_possible, key_text};
use crate::app::files::{self, Files};
use crate::app::lab::Lab;

/// Shows the menus; what they do is pushed to `lab.commands` or asked of `files`.
pub(crate) fn show(lab: &mut Lab, files: &mut Files, ui: &mut Ui) {
    MenuBar::new().ui(ui, |ui| {
        let room = lab.room();
        for menu in Menu::ALL.into_iter().filter(|menu| menu.room().is_none_or(|only| only == room)) {
            ui.menu_button(menu.title(), |ui| {
                ui.set_min_width(210.0);
                let commands = Command::ALL.into_iter().filter(|command| {
                    command.menu() == menu && command.room().is_none_or(|only| only == room)
                });
                let commands: Vec<Command> = commands.collect();
                for command in commands {
                    if starts_group(command) {
                        ui.separator();
                    }
                    entry(command, lab, ui);
                    if command == Command::Open {
                        recent_files(files, ui);
                        recovered(files, ui);
                    }
                }
                if menu == Menu::Lesson {
                    lesson_entries(lab, ui);
                }
            });
        }
    });
}

fn starts_group(command: Command) -> bool {
    matches!(
        command,
        Command::Save
            | Command::ExportFigure
            | Command::FirstScene
            | Command::Quit
            | Command::Delete
            | Command::SelectAll
            | Command::InsertKnot
            | Command::UniformKnots
            | Command::RefineUniformly
            | Command::ToggleEditPoints
            | Command::AlignX
            | Command::ElevateDegree
            | Command::ImportMesh
            | Command::ToggleNet
            | Command::RefineU
            | Command::ToggleParallel
            | Command::ToggleClosed
            | Command::SplitCurve
            | Command::ResetWeights
            | Command::ToggleGrid
            | Command::ToggleLeftPanel
            | Command::LookLight
            | Command::NextLesson
    )
}

fn entry(command: Command, lab: &mut Lab, ui: &mut Ui) {
    let (text, hint) = command.text();
    let text = match (command, lab.undo_name(), lab.redo_name()) {
        (Command::Undo, Some(step), _) => format!("Undo {}", in_a_sentence(step)),
        (Command::Redo, _, Some(step)) => format!("Redo {}", in_a_sentence(step)),
        _ => text.to_owned(),
    };
    let on = is_on(command, lab);
    let mut button = Button::selectable(on == Some(true), text.as_str());
    if let Some(key) = key_text(command, ui.ctx()) {
        button = button.shortcut_text(key);
    }
    let possible = is_possible(command, lab);
    let response = ui.add_enabled(possible, button).on_hover_text(hint);
    response.widget_info(|| match on {
        Some(on) => egui::WidgetInfo::selected(egui::Role::CheckBox, possible, on, &text),
        None => egui::WidgetInfo::labeled(egui::Role::Button, possible, &text),
    });
    if response.clicked() {
        lab.commands.push(command);
        ui.close();
    }
}

/// The name of a step as the rest of a sentence: `Move 3 points` becomes `move 3 points`, but `B-spline` stays.
fn in_a_sentence(step: &str) -> String {
    let mut letters = step.chars();
    match (letters.next(), letters.clone().next()) {
        (Some(first), Some(second)) if second.is_lowercase() => first.to_lowercase().chain(letters).collect(),
        _ => step.to_owned(),
    }
}

fn recent_files(files: &mut Files, ui: &mut Ui) {
    let recent: Vec<PathBuf> = files.recent().collect();
    ui.add_enabled_ui(!recent.is_empty(), |ui| {
        ui.menu_button("Open recent", |ui| {
            for path in &recent {
                let name = path
                    .file_name()
                    .map_or_else(|| path.display().to_string(), |name| name.display().to_string());
                let folder = path.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
                let response = ui.button(&name).on_hover_text(path.display().to_string());
                ui.label(RichText::new(folder).small().weak());
                if response.clicked() {
                    files.ask_to_open(path.clone());
                    ui.close();
                }
            }
            ui.separator();
            if ui.button("Forget recent files").clicked() {
                files.forget_recent();
                ui.close();
            }
        });
    });
}

fn recovered(files: &mut Files, ui: &mut Ui) {
    if files.has_recovered() && ui.button("Bring back documents…").on_hover_text(RECOVERED_HINT).clicked() {
        files.offer_recovered();
        ui.close();
    }
}

fn lesson_entries(lab: &mut Lab, ui: &mut Ui) {
    ui.separator();
    let back = ui.add_enabled(lab.shelf.own.is_some(), Button::new("Back to my document"));
    if back.on_hover_text("Leave the lesson; your document is as you left it").clicked() {
        files::back_to_document(lab);
        ui.close();
    }
}

const RECOVERED_HINT: &str = "Documents of a session that did not end properly";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_named_as_in_a_sentence() {
        for (step, name) in
            [("Move 3 points", "move 3 points"), ("B-spline added", "B-spline added"), ("", "")]
        {
            assert_eq!(in_a_sentence(step), name, "{step:?}");
        }
    }
}
