//! The menu of the thing under the pointer.

use eframe::egui::{Button, Ui};

use crate::app::command::Command;
use crate::app::command_state::is_possible;
use crate::app::lab::Lab;
use crate::app::surfaces::target::Target;
use crate::app::surfaces::{Picked, commands};

/// Shows the menu of `target`; `picked` becomes what is picked of a mesh by it.
pub(super) fn show(target: Target, picked: &mut Picked, lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(180.0);
    match target {
        Target::Edge(id, ends) => {
            ui.weak(format!("Edge {}–{}", ends[0], ends[1]));
            for (text, sharpness) in
                [("Smooth", 0.0), ("Sharpness 1", 1.0), ("Infinitely sharp", f64::INFINITY)]
            {
                if ui.button(text).clicked() {
                    lab.selection.object = Some(id);
                    *picked = Picked::Edge(id, ends);
                    commands::change(lab, "Change sharpness", |content| {
                        commands::on_mesh(content, |mesh| mesh.with_sharpness(ends, sharpness))
                    });
                }
            }
            ui.separator();
        }
        Target::Point(id, point) => {
            let is_mesh = lab.history.document().object(id).is_some_and(|object| object.mesh().is_some());
            if is_mesh {
                ui.weak(format!("Vertex {point}"));
                if ui.button("Delete vertex").clicked() {
                    lab.selection.object = Some(id);
                    commands::delete_vertices(lab, [point].into());
                }
                ui.separator();
            }
        }
        Target::Surface(id, Some(face)) => {
            ui.weak(format!("Face {face} of the control mesh"));
            if ui.button("Delete face").clicked() {
                lab.selection.object = Some(id);
                lab.selection.points.clear();
                commands::change(lab, "Delete face", |content| {
                    commands::on_mesh(content, |mesh| mesh.without_face(face))
                });
            }
            ui.separator();
        }
        _ => {}
    }
    let entries = if commands::selected(lab).is_some_and(|object| object.mesh().is_some()) {
        [Command::LevelUp, Command::LevelDown, Command::ToggleSmooth, Command::ToggleNet, Command::Fit]
    } else {
        [Command::RefineU, Command::RefineV, Command::ToggleNormals, Command::ToggleNet, Command::Fit]
    };
    for command in entries {
        if ui.add_enabled(is_possible(command, lab), Button::new(command.text().0)).clicked() {
            lab.commands.push(command);
        }
    }
}
