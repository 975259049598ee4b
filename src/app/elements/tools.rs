//! The tools of the Finite elements workspace in the row under the menu.

use eframe::egui::Ui;

use crate::app::command::Command;
use crate::app::elements::{Subject, add, canvas};
use crate::app::lab::Lab;
use crate::app::toolbar::button;

pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    ui.menu_button("New", |ui| add::preset_buttons(170.0, lab, ui))
        .response
        .on_hover_text("A new problem beside those there are");
    if let Some(subject) = Subject::of(lab)
        && subject.membrane.patch().is_none()
    {
        let at = canvas::camera(lab).center;
        ui.menu_button("Add", |ui| add::menu(at, &subject, lab, ui))
            .response
            .on_hover_text("A part for the domain, in the middle of the view");
    }
    ui.separator();
    for (word, command) in [
        ("Colours", Command::ToggleField),
        ("Isolines", Command::ToggleIsolines),
        ("Nodes", Command::ToggleNodes),
        ("Cells", Command::ToggleCells),
        ("Quadrature", Command::ToggleQuadrature),
    ] {
        button(word, command, lab, ui);
    }
    ui.separator();
    button("Finer", Command::RefineElements, lab, ui);
    button("Coarser", Command::CoarsenElements, lab, ui);
}
