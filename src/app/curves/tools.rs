//! The tools of the Curves workspace in the row under the menu.

use eframe::egui::Ui;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::toolbar::button;

pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    button("Select", Command::SelectTool, lab, ui);
    button("Draw", Command::DrawTool, lab, ui);
    ui.separator();
    for (word, command) in [
        ("Polygon", Command::TogglePolygon),
        ("Comb", Command::ToggleComb),
        ("Construction", Command::ToggleConstruction),
        ("Hull", Command::ToggleHull),
        ("Circle", Command::ToggleCircle),
    ] {
        button(word, command, lab, ui);
    }
}
