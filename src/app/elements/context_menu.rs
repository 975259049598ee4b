//! The menu of the thing under the pointer.

use eframe::egui::Ui;
use glam::DVec2;

use crate::app::command::Command;
use crate::app::elements::hit::Target;
use crate::app::elements::{Subject, add};
use crate::app::lab::Lab;
use crate::document::Operation;

/// Shows the entries for `target`; new parts are put around `at`.
pub(super) fn show(target: Target, at: DVec2, subject: Option<&Subject>, lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(170.0);
    let Some(subject) = subject else {
        add::preset_buttons(170.0, lab, ui);
        return;
    };
    let on_patch = subject.membrane.patch().is_some();
    match target.handle() {
        Some(id) if on_patch => {
            if ui.button("Weight 1").clicked() {
                subject.apply(lab, "Change weight", subject.membrane.with_weight(id.index, 1.0));
                ui.close();
            }
        }
        Some(id) => {
            let part = id.part;
            if part > 0 {
                for operation in Operation::ALL {
                    let chosen = subject.membrane.parts().get(part).map(|found| found.operation);
                    if ui.radio(chosen == Some(operation), super::capital(operation.word())).clicked() {
                        let changed = subject.membrane.with_parts(|parts| {
                            if let Some(found) = parts.get_mut(part) {
                                found.operation = operation;
                            }
                        });
                        subject.apply(lab, "Change operation", changed);
                        ui.close();
                    }
                }
                ui.separator();
            }
            if ui.button("Delete").clicked() {
                lab.commands.push(Command::Delete);
                ui.close();
            }
        }
        None => {
            if !on_patch {
                ui.menu_button("Add", |ui| add::menu(at, subject, lab, ui));
                ui.separator();
            }
            for (word, command) in [("Fit", Command::Fit), ("Finer", Command::RefineElements)] {
                if ui.button(word).clicked() {
                    lab.commands.push(command);
                    ui.close();
                }
            }
        }
    }
}
