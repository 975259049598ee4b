//! The Curves workspace: a canvas on which spline curves are drawn, dragged and looked at.

mod align;
mod canvas;
mod commands;
mod context_menu;
mod draw_preview;
mod draw_shapes;
mod draw_tool;
mod gesture;
mod ghost;
mod handles;
mod hermite_hands;
mod hit;
mod looks_menu;
mod mark_tips;
mod operation_form;
mod operations;
mod probe_hands;
mod step_hands;
mod tools;
mod weight_handles;

use eframe::egui;

use crate::app::chart_panel;
use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::workspace::{Room, Workspace};
use crate::figure::composition::short_number;

pub(crate) use canvas::Canvas;
pub(crate) use operations::nearest_other;

/// The workspace of plane curves.
#[derive(Debug, Default)]
pub(crate) struct Curves {
    canvas: Canvas,
    form: operation_form::OperationForm,
}

impl Workspace for Curves {
    fn room(&self) -> Room {
        Room::Curves
    }

    fn tools(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        tools::show(lab, ui);
    }

    fn panels(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        let open = |name: &str| lab.view.panels.get(name).copied().unwrap_or(true);
        if open(crate::app::KNOT_LINE) {
            let charts = chart_panel::is_open(lab);
            // A chart needs room for its axes.
            let least = if charts { 180.0 * lab.theme.text_scale as f32 } else { 110.0 };
            egui::Panel::bottom("knot line")
                .resizable(true)
                .default_size(190.0)
                .size_range(least..=420.0)
                .show(ui, |ui| {
                    if charts {
                        chart_panel::show(lab, ui);
                    } else {
                        crate::app::knot_line::show(lab, ui);
                    }
                });
        }
    }

    fn inspector(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        crate::app::inspector::show(lab, ui);
    }

    fn canvas(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        self.canvas.show(lab, ui);
        self.form.show(lab, ui);
    }

    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        if command == Command::ToggleCharts {
            let open = !chart_panel::is_open(lab);
            lab.view.panels.insert(crate::app::CHARTS.to_owned(), open);
            lab.view.panels.insert(crate::app::KNOT_LINE.to_owned(), true);
            return true;
        }
        if command == Command::Escape && self.form.close() {
            return true;
        }
        self.form.open(command, lab)
            || operations::execute(command, lab)
            || crate::app::knot_line::execute(command, lab)
            || crate::app::side_rooms::execute(command, lab)
            || self.canvas.execute(command, lab)
    }

    fn status(&self, lab: &Lab) -> String {
        let scale = format!("{} px per unit", short_number(lab.view.camera.scale));
        if let Some(words) = Canvas::left_out(lab) {
            return format!("{words}   {scale}");
        }
        match self.canvas.labels_without_room() {
            0 => scale,
            1 => format!("1 label without room: zoom in or point at its mark   {scale}"),
            count => format!("{count} labels without room: zoom in or point at their marks   {scale}"),
        }
    }

    fn handles(&self, lab: &Lab) -> Vec<(String, egui::Pos2)> {
        self.canvas
            .named(lab)
            .into_iter()
            .filter_map(|(name, at)| Some((name, self.canvas.screen_from_world(at, lab)?)))
            .collect()
    }

    fn screen_from_world(&self, world: glam::DVec2, lab: &Lab) -> Option<egui::Pos2> {
        self.canvas.screen_from_world(world, lab)
    }
}
