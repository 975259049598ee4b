//! Everything about the selected curve as numbers and choices.

mod appearance;
mod knots;
mod measurements;
mod points;
mod shape;

use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};
use glam::DVec2;

use crate::app::lab::Lab;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, ObjectId};

/// The selected curve, as it was at the beginning of the frame.
#[derive(Clone, Debug)]
struct Subject {
    object: ObjectId,
    name: String,
    display: CurveDisplay,
    curve: Nurbs<DVec2>,
}

/// Shows the inspector.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let subject = lab.selection.object.and_then(|id| {
        let document = lab.history.document();
        let (object, curve) = (document.object(id)?, document.curve(id)?);
        Some(Subject {
            object: id,
            name: object.name.clone(),
            display: object.display.clone(),
            curve: curve.clone(),
        })
    });
    let Some(subject) = subject else {
        ui.add_space(8.0);
        ui.label(RichText::new("Select a curve to see and type its numbers.").weak());
        return;
    };
    ScrollArea::vertical().id_salt("inspector").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        shape::show(lab, ui, &subject);
        points::show_selected(lab, ui, &subject);
        section(ui, "Control points", true, |ui| points::show_table(lab, ui, &subject));
        section(ui, "Knots", true, |ui| knots::show(lab, ui, &subject));
        section(ui, "Shown", true, |ui| appearance::show(lab, ui, &subject));
        section(ui, "At the parameter t", true, |ui| measurements::show(lab, ui, &subject));
        ui.add_space(8.0);
    });
}

fn section(ui: &mut Ui, title: &str, open: bool, add: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(open).show_unindented(ui, add);
}
