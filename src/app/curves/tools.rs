//! The tools of the Curves workspace in the row under the menu.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Button, PopupCloseBehavior, Role, Ui, WidgetInfo};

use crate::app::command::Command;
use crate::app::curves::looks_menu;
use crate::app::lab::{DrawMode, Lab, Tool};
use crate::app::number_field::{Drag, NumberEvent, NumberField, positive};
use crate::app::toolbar::{button, menu_item};

/// In narrower windows no look has a button of its own.
const ROOM_FOR_LOOKS: f32 = 960.0;

pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    button("Select", Command::SelectTool, lab, ui);
    button("Draw", Command::DrawTool, lab, ui);
    // A click into the field of the tolerance must not shut the menu.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let shapes = Button::selectable(lab.tool == Tool::Draw && lab.draw_mode != DrawMode::Points, "Shapes");
    MenuButton::from_button(shapes).config(config).ui(ui, |ui| {
        ui.set_min_width(230.0);
        for mode in DrawMode::ALL {
            if menu_item(mode.command(), lab, ui) {
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
    // In a narrow window they are found under Looks only.
    let has_room = ui.content_rect().width() >= ROOM_FOR_LOOKS * lab.theme.text_scale as f32;
    for (word, command) in [
        ("Polygon", Command::TogglePolygon),
        ("Comb", Command::ToggleComb),
        ("Construction", Command::ToggleConstruction),
    ]
    .into_iter()
    .filter(|_| has_room)
    {
        button(word, command, lab, ui);
    }
    let looks = Button::selectable(looks_menu::is_any_on(lab), "Looks \u{23f7}");
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, _) = MenuButton::from_button(looks).config(config).ui(ui, |ui| looks_menu::show(lab, ui));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Looks"));
    response.on_hover_text("Everything that can be shown of the selected curve, with the keys");
}
