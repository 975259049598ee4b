//! The tools of the Curves workspace in the row under the menu.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Button, PopupCloseBehavior, Ui};

use crate::app::command::Command;
use crate::app::command_state::{is_on, key_text};
use crate::app::lab::{DrawMode, Lab, Tool};
use crate::app::number_field::{Drag, NumberEvent, NumberField, positive};
use crate::app::toolbar::button;

pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    button("Select", Command::SelectTool, lab, ui);
    button("Draw", Command::DrawTool, lab, ui);
    // A click into the field of the tolerance must not shut the menu.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let shapes = Button::selectable(lab.tool == Tool::Draw && lab.draw_mode != DrawMode::Points, "Shapes");
    MenuButton::from_button(shapes).config(config).ui(ui, |ui| {
        ui.set_min_width(230.0);
        for mode in DrawMode::ALL {
            let command = mode.command();
            let on = is_on(command, lab) == Some(true);
            let mut button = Button::selectable(on, command.text().0);
            if let Some(key) = key_text(command, ui.ctx()) {
                button = button.shortcut_text(key);
            }
            if ui.add(button).on_hover_text(command.text().1).clicked() {
                lab.commands.push(command);
                ui.close();
            }
        }
        ui.separator();
        ui.horizontal(|ui| {
            ui.label("Strokes within");
            let field = NumberField::new("Tolerance of strokes in pixels", lab.stroke_tolerance).width(44.0);
            let field = field.check(positive).drag(Drag::Factor).show(ui, "stroke tolerance");
            if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = field.event {
                lab.stroke_tolerance = to;
            }
            ui.label("px");
        });
    });
    for (word, command) in
        [("Edit points", Command::ToggleEditPoints), ("Weights", Command::ToggleWeightPoints)]
    {
        button(word, command, lab, ui);
    }
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
