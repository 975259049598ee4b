//! The Approximation workspace: data, a typed function, and methods that approximate them, side by side on the same axes.

mod camera;
mod canvas;
mod changes;
mod commands;
mod context_menu;
mod data_table;
mod desk;
mod function_field;
mod gesture;
mod hit;
mod inspector;
mod marks;
mod methods;
mod start;

use eframe::egui;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::toolbar::button;
use crate::app::workspace::{Room, Workspace};

pub(crate) use changes::{new_approximation, take_table};

/// The workspace of approximations.
#[derive(Debug, Default)]
pub(crate) struct ApproximationRoom {
    canvas: canvas::Canvas,
    desk: desk::Desk,
    samples: inspector::Settings,
}

impl Workspace for ApproximationRoom {
    fn room(&self) -> Room {
        Room::Approximation
    }

    fn tools(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        button("Select", Command::SelectDataTool, lab, ui);
        button("Add points", Command::AddPointTool, lab, ui);
        ui.separator();
        button("Import…", Command::ImportData, lab, ui);
        button("Error plot", Command::CycleErrorPlot, lab, ui);
    }

    fn inspector(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        inspector::show(&mut self.samples, &mut self.desk, lab, ui);
    }

    fn canvas(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        self.canvas.show(&mut self.desk, lab, ui);
    }

    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        match command {
            Command::NewApproximation => new_approximation(lab, None),
            Command::SampleFunction => changes::sample(lab, self.samples.count),
            _ => return self.canvas.execute(command, lab),
        }
        true
    }

    fn status(&self, lab: &Lab) -> String {
        self.canvas.status(self.desk.is_busy(), lab)
    }

    fn handles(&self, lab: &Lab) -> Vec<(String, egui::Pos2)> {
        self.canvas.handles(lab)
    }
}
