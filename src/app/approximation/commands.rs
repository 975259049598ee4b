//! What keys and menus do in the room.

use crate::app::approximation::canvas::Canvas;
use crate::app::approximation::changes::{change, show_everything, with_knots};
use crate::app::approximation::new_approximation;
use crate::app::command::Command;
use crate::app::lab::{Lab, Tool};
use crate::document::{Approximation, Edit, ErrorPlot};
use crate::figure::composition::GRID;

impl Canvas {
    /// The commands that belong to the canvas.
    pub(super) fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        match command {
            Command::Fit => show_everything(lab),
            Command::ZoomIn => self.zoom(lab, None, 0.8),
            Command::ZoomOut => self.zoom(lab, None, 1.25),
            Command::ToggleGrid => {
                let shown = lab.view.panels.get(GRID).copied().unwrap_or(true);
                lab.view.panels.insert(GRID.to_owned(), !shown);
            }
            Command::SelectDataTool => lab.tool = Tool::Select,
            Command::AddPointTool => {
                lab.tool = if lab.tool == Tool::AddPoint { Tool::Select } else { Tool::AddPoint };
                if lab.tool == Tool::AddPoint && lab.approximation().is_none() {
                    new_approximation(lab, None);
                }
            }
            Command::Escape => {
                if self.gesture.take().is_some() {
                    lab.history.cancel();
                } else if lab.tool == Tool::AddPoint {
                    lab.tool = Tool::Select;
                } else {
                    lab.selection.points.clear();
                    self.knot = None;
                }
            }
            Command::SelectAll => {
                let count = lab.approximation().map_or(0, Approximation::len);
                lab.selection.points = (0..count).collect();
            }
            Command::CycleErrorPlot => {
                change(lab, "Change error plot", |approximation| {
                    Ok(approximation.with_error_plot(match approximation.error_plot() {
                        ErrorPlot::Linear => ErrorPlot::Logarithmic,
                        ErrorPlot::Logarithmic => ErrorPlot::Hidden,
                        ErrorPlot::Hidden => ErrorPlot::Linear,
                    }))
                });
            }
            Command::Duplicate => {
                let Some(object) = lab.selection.object else { return true };
                let outcome = lab.edit(Edit::DuplicateObject { object });
                if let Some(&created) = outcome.as_ref().and_then(|outcome| outcome.created.first()) {
                    lab.select(created);
                }
            }
            Command::Delete => self.delete(lab),
            _ => return false,
        }
        true
    }

    fn delete(&mut self, lab: &mut Lab) {
        let Some(object) = lab.selection.object else { return };
        if let Some((id, method, index)) = self.knot.take()
            && id == object
            && let Some(row) = self
                .painted
                .as_ref()
                .and_then(|painted| painted.layout.rows.iter().find(|row| row.method == method))
        {
            let mut knots = row.knots.clone();
            if index < knots.len() {
                knots.remove(index);
                change(lab, "Delete knot", |approximation| with_knots(approximation, method, knots));
            }
        } else if lab.selection.points.is_empty() {
            lab.edit(Edit::RemoveObjects { objects: vec![object] });
        } else {
            let points: Vec<usize> = std::mem::take(&mut lab.selection.points).into_iter().collect();
            let label = if points.len() == 1 {
                "Delete datum".to_owned()
            } else {
                format!("Delete {} data", points.len())
            };
            change(lab, label, |approximation| approximation.without_points(&points));
        }
    }
}
