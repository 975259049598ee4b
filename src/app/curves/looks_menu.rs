//! Everything that can be shown of a curve, as a menu that stays open while boxes are ticked.

use eframe::egui::{RichText, Ui};

use crate::app::command::Command;
use crate::app::command_state::is_on;
use crate::app::lab::Lab;
use crate::app::toolbar::menu_item;

/// The commands that switch what is shown, in groups with their titles.
const GROUPS: [(&str, &[Command]); 3] = [
    (
        "Shape",
        &[
            Command::TogglePolygon,
            Command::ToggleBezierPoints,
            Command::ToggleBlossomLabels,
            Command::ToggleDistanceTube,
            Command::ToggleComb,
        ],
    ),
    (
        "At t",
        &[
            Command::ToggleConstruction,
            Command::ToggleHull,
            Command::ToggleFrame,
            Command::ToggleCircle,
            Command::ToggleHodograph,
        ],
    ),
    (
        "Measured",
        &[
            Command::ToggleInflections,
            Command::ToggleVertices,
            Command::ToggleSymmetry,
            Command::ToggleProbeLine,
        ],
    ),
];

/// Whether anything is shown that has no button of its own.
pub(super) fn is_any_on(lab: &Lab) -> bool {
    let own = [Command::TogglePolygon, Command::ToggleComb, Command::ToggleConstruction];
    let mut commands = GROUPS.iter().flat_map(|(_, commands)| *commands);
    commands.any(|&command| !own.contains(&command) && is_on(command, lab) == Some(true))
}

/// Shows the menu.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(220.0);
    for (title, commands) in GROUPS {
        ui.label(RichText::new(title).small().weak());
        for &command in commands {
            menu_item(command, lab, ui);
        }
    }
    ui.separator();
    menu_item(Command::CycleLabels, lab, ui);
}
