//! The menu of the thing under the pointer.

use eframe::egui::containers::menu::{MenuConfig, SubMenuButton};
use eframe::egui::{Button, PopupCloseBehavior, Ui};
use glam::DVec2;

use crate::app::command::Command;
use crate::app::curves::commands::insert_point;
use crate::app::curves::hit::{Target, nearest_edge};
use crate::app::curves::looks_menu;
use crate::app::curves::operations;
use crate::app::curves::weight_handles::{edge_end, weights_for_weight_point};
use crate::app::lab::{DrawMode, Lab};
use crate::app::toolbar::menu_item;
use crate::document::Edit;
use crate::figure::composition::short_number;

/// Shows the entries that fit `target`.
pub(super) fn show(target: Target, place: DVec2, lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(190.0);
    match target {
        Target::Point(object, point) => {
            let Some(weight) = lab.history.document().curve(object).map(|curve| curve.weights()[point])
            else {
                return;
            };
            ui.weak(format!("Control point {point}, weight {}", short_number(weight)));
            for (text, factor) in [("Weight × 2", 2.0), ("Weight ÷ 2", 0.5)] {
                if ui.button(text).clicked() {
                    lab.edit(Edit::SetWeight { object, point, weight: weight * factor });
                }
            }
            if ui.add_enabled(weight.to_bits() != 1.0_f64.to_bits(), Button::new("Weight 1")).clicked() {
                lab.edit(Edit::SetWeight { object, point, weight: 1.0 });
            }
            if lab.selection.points.len() > 1 && lab.selection.points.contains(&point) {
                ui.separator();
                for command in [Command::AlignX, Command::AlignY, Command::Distribute] {
                    entry(command, lab, ui);
                }
            }
            entry(Command::AlignGrid, lab, ui);
            ui.separator();
            if ui.button("Delete point").clicked() {
                lab.edit(Edit::DeletePoints { object, points: vec![point] });
            }
        }
        Target::Curve(object, parameter) => {
            ui.weak(format!("t = {}", short_number(parameter)));
            if ui.button("Insert knot here (shape kept)").clicked() {
                lab.edit(Edit::InsertKnot { object, at: parameter });
            }
            if ui.button("Split here").clicked() {
                operations::split(object, parameter, lab);
            }
            if ui.button("Keep the part before").clicked() {
                operations::trim_at(object, parameter, true, lab);
            }
            if ui.button("Keep the part after").clicked() {
                operations::trim_at(object, parameter, false, lab);
            }
            if ui.button("Look at this t").clicked() {
                lab.set_parameter(object, parameter);
            }
            ui.separator();
            object_entries(lab, ui);
        }
        Target::Knot(object, value) => {
            let multiplicity =
                lab.history.document().curve(object).map_or(0, |curve| curve.space().multiplicity(value));
            ui.weak(format!("Knot {}, multiplicity {multiplicity}", short_number(value)));
            if ui.button("One more copy (shape kept)").clicked() {
                lab.edit(Edit::InsertKnot { object, at: value });
            }
            if ui.button("Split here").clicked() {
                operations::split(object, value, lab);
            }
            if ui.button("Remove one copy").clicked() {
                lab.edit(Edit::RemoveKnot { object, at: value });
            }
            ui.separator();
            object_entries(lab, ui);
        }
        Target::Parameter(object) => {
            if let Some(parameter) = lab.parameter(object) {
                ui.weak(format!("t = {}", short_number(parameter)));
            }
            entry(Command::InsertKnot, lab, ui);
            entry(Command::SplitCurve, lab, ui);
            entry(Command::TrimBefore, lab, ui);
            entry(Command::TrimAfter, lab, ui);
            ui.separator();
            looks(lab, ui);
        }
        Target::Ring(object, point) | Target::Bead(object, point) => {
            if ui.button("Weight 1").clicked() {
                lab.edit(Edit::SetWeight { object, point, weight: 1.0 });
            }
        }
        Target::WeightPoint(object, edge) => {
            if ui.button("Equal weights").clicked()
                && let Some(curve) = lab.history.document().curve(object)
            {
                let middle = curve.points()[edge].midpoint(curve.points()[edge_end(curve, edge)]);
                let weights = weights_for_weight_point(curve, edge, middle);
                lab.edit(Edit::SetWeights { object, weights });
            }
            entry(Command::ToggleWeightPoints, lab, ui);
            entry(Command::ResetWeights, lab, ui);
        }
        Target::EditPoint(..) => entry(Command::ToggleEditPoints, lab, ui),
        Target::Nothing | Target::Edge(..) => {
            let object = lab.selection.object.and_then(|id| lab.history.document().object(id));
            if let Some((id, (before, _))) =
                object.and_then(|object| Some((object.id, nearest_edge(object, place)?)))
                && ui.button("Insert point here").clicked()
            {
                insert_point(id, before, place, lab);
            }
            ui.menu_button("Draw", |ui| {
                for mode in DrawMode::ALL {
                    entry(mode.command(), lab, ui);
                }
            });
            for command in [Command::ToggleEditPoints, Command::ToggleWeightPoints] {
                entry(command, lab, ui);
            }
            ui.separator();
            for command in [Command::Fit, Command::ToggleGrid, Command::SelectAll, Command::ExportFigure] {
                entry(command, lab, ui);
            }
        }
    }
}

/// The looks of the selected curve, in a menu that stays open while boxes are ticked.
fn looks(lab: &mut Lab, ui: &mut Ui) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    SubMenuButton::new("Looks").config(config).ui(ui, |ui| looks_menu::show(lab, ui));
}

fn object_entries(lab: &mut Lab, ui: &mut Ui) {
    looks(lab, ui);
    for command in [Command::ElevateDegree, Command::ReduceDegree, Command::ToggleClosed, Command::Duplicate]
    {
        entry(command, lab, ui);
    }
    ui.menu_button("Operations", |ui| {
        for command in operations::MENU {
            entry(command, lab, ui);
        }
    });
    if ui.button("Delete curve").clicked()
        && let Some(object) = lab.selection.object
    {
        lab.edit(Edit::RemoveObjects { objects: vec![object] });
    }
}

fn entry(command: Command, lab: &mut Lab, ui: &mut Ui) {
    if menu_item(command, lab, ui) {
        ui.close();
    }
}
