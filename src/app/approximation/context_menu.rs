//! The menu of the thing under the pointer.

use eframe::egui::{Button, Ui};

use crate::app::approximation::changes::{change, change_method, with_knots};
use crate::app::approximation::hit::Target;
use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::figure::approximation::error_text;

/// Shows the entries that fit `target`.
pub(super) fn show(target: Target, lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(190.0);
    match target {
        Target::Datum(index) => datum(index, lab, ui),
        Target::Knot(method, index) => {
            let Some(knots) = given_knots(lab, method) else {
                ui.weak("These knots follow from the data; drag one to make them your own");
                return;
            };
            let Some(&knot) = knots.get(index) else { return };
            ui.weak(format!("Knot {}", error_text(knot)));
            if ui.button("One more copy").clicked() {
                let mut more = knots.clone();
                more.insert(index, knot);
                change(lab, "Insert knot", |approximation| with_knots(approximation, method, more));
            }
            if ui.button("Delete knot").clicked() {
                let mut fewer = knots;
                fewer.remove(index);
                change(lab, "Delete knot", |approximation| with_knots(approximation, method, fewer));
            }
        }
        Target::Row(method, _) | Target::FixedRow(method) => {
            let title = lab.approximation().and_then(|data| data.methods().get(method));
            let Some(title) = title.map(|method| method.scheme.title()) else { return };
            ui.weak(title);
            if let Target::Row(_, at) = target
                && ui.button("Insert knot here").clicked()
            {
                let mut knots = given_knots(lab, method).unwrap_or_default();
                knots.insert(knots.partition_point(|&knot| knot <= at), at);
                change(lab, "Insert knot", |approximation| with_knots(approximation, method, knots));
            }
            if ui.button("Hide this method").clicked() {
                change_method(lab, method, "Hide method", |method| method.visible = false);
            }
        }
        Target::Nothing => {
            for command in [
                Command::AddPointTool,
                Command::Fit,
                Command::ToggleGrid,
                Command::CycleErrorPlot,
                Command::SelectAll,
                Command::ImportData,
                Command::ExportFigure,
            ] {
                entry(command, lab, ui);
            }
        }
    }
}

/// The knots that are given with a method; `None` if they follow from the data.
fn given_knots(lab: &Lab, method: usize) -> Option<Vec<f64>> {
    use crate::document::KnotChoice;
    match lab.approximation()?.methods().get(method)?.scheme.space()?.1 {
        KnotChoice::Averaged => None,
        KnotChoice::Inner(knots) | KnotChoice::All(knots) => Some(knots.clone()),
    }
}

fn datum(index: usize, lab: &mut Lab, ui: &mut Ui) {
    let Some(approximation) = lab.approximation() else { return };
    let (Some(&x), Some(&y)) = (approximation.sites().get(index), approximation.values().get(index)) else {
        return;
    };
    let weight = approximation.weight(index);
    ui.weak(format!("Datum {index} at ({}, {})", error_text(x), error_text(y)));
    for (text, new) in [("Weight × 2", 2.0 * weight), ("Weight ÷ 2", 0.5 * weight), ("Weight 1", 1.0)] {
        let possible = new.to_bits() != weight.to_bits();
        if ui.add_enabled(possible, Button::new(text)).clicked() {
            change(lab, "Change weight", |approximation| approximation.with_weight(&[index], new));
        }
    }
    ui.separator();
    if ui.button("Delete datum").clicked() {
        lab.selection.points.clear();
        change(lab, "Delete datum", |approximation| approximation.without_points(&[index]));
    }
}

fn entry(command: Command, lab: &mut Lab, ui: &mut Ui) {
    let (text, hint) = command.text();
    let shortcut = command.shortcut().map(|shortcut| ui.ctx().format_shortcut(&shortcut)).unwrap_or_default();
    if ui.add(Button::new(text).shortcut_text(shortcut)).on_hover_text(hint).clicked() {
        lab.commands.push(command);
    }
}
