//! Everything about the selected approximation as numbers and choices.

use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};

use crate::app::approximation::desk::Desk;
use crate::app::approximation::{data_table, function_field, methods};
use crate::app::lab::Lab;
use crate::app::text_field::TextField;
use crate::document::{Edit, ErrorPlot};

/// Choices that are no part of the document.
#[derive(Debug)]
pub(super) struct Settings {
    /// Number of samples of the function.
    pub(super) count: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { count: 11 }
    }
}

/// Shows the inspector.
pub(super) fn show(settings: &mut Settings, desk: &mut Desk, lab: &mut Lab, ui: &mut Ui) {
    let selected = lab.selection.object.and_then(|id| lab.history.document().object(id)).cloned();
    let Some(object) = selected.filter(|object| object.approximation().is_some()) else {
        ui.add_space(8.0);
        ui.label(RichText::new("Start with data or an example to see and type its numbers.").weak());
        return;
    };
    let Some(approximation) = object.approximation() else { return };
    let analysis = desk.analysis(&object, ui.ctx());
    ScrollArea::vertical().id_salt("approximation").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        let named = |text: &str| {
            if text.trim().is_empty() { Err("a name is needed".to_owned()) } else { Ok(()) }
        };
        if let Some(name) = TextField::new("Name", &object.name).show(ui, ("name", object.id), named) {
            lab.edit(Edit::RenameObject { object: object.id, name: name.trim().to_owned() });
        }
        section(ui, "Function", |ui| function_field::show(settings, approximation, lab, ui, object.id));
        section(ui, "Methods", |ui| methods::show(approximation, &analysis, lab, ui, object.id));
        section(ui, "Error plot", |ui| error_plot(approximation.error_plot(), lab, ui));
        section(ui, "Data", |ui| data_table::show(approximation, lab, ui, object.id));
        ui.add_space(8.0);
    });
}

fn section(ui: &mut Ui, title: &str, add: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, add);
}

fn error_plot(now: ErrorPlot, lab: &mut Lab, ui: &mut Ui) {
    ui.horizontal(|ui| {
        for (wanted, text) in [
            (ErrorPlot::Linear, "Linear"),
            (ErrorPlot::Logarithmic, "Logarithmic"),
            (ErrorPlot::Hidden, "Hidden"),
        ] {
            if ui.selectable_label(now == wanted, text).clicked() && now != wanted {
                super::changes::change(lab, "Change error plot", |approximation| {
                    Ok(approximation.with_error_plot(wanted))
                });
            }
        }
    });
}
