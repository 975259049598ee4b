//! Rooms beside the canvas, each for one subject: the conic of a curve, homogeneous coordinates, geometric Hermite
//! interpolation. They are pages of the right panel and draw on the canvas as well.

mod conic;
mod conic_drawing;
mod conic_panel;
mod hermite;
mod hermite_panel;
mod parabolas;
mod space;
mod space_panel;

use eframe::egui::{RichText, Ui};
use glam::DVec2;

use crate::app::RIGHT_PANEL;
use crate::app::command::Command;
use crate::app::lab::{Lab, SidePage};
use crate::core::spline_curve::Nurbs;
use crate::document::ObjectId;
use crate::figure::picture::{Picture, Viewport};

pub use hermite::{End, Hermite};
pub use space::Space;

/// Which room is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SideRoom {
    /// The conic of a quadratic piece.
    #[default]
    Conic,
    /// The curve in space over the plane w = 1.
    Homogeneous,
    /// Cubics with given ends.
    Hermite,
}

/// What the rooms remember while the program runs.
#[derive(Clone, Debug)]
pub struct SideRooms {
    /// Whether a room is shown; the canvas then shows what belongs to it.
    pub open: bool,
    /// Which one.
    pub room: SideRoom,
    /// Whether the complete conic is drawn.
    pub whole_conic: bool,
    /// Whether the arc of the negative weight is drawn.
    pub complement: bool,
    /// How space is looked at.
    pub space: Option<Space>,
    /// The ends of the cubics; `None` before they are first shown.
    pub hermite: Option<Hermite>,
}

impl Default for SideRooms {
    fn default() -> Self {
        Self {
            open: false,
            room: SideRoom::Conic,
            whole_conic: true,
            complement: false,
            space: None,
            hermite: None,
        }
    }
}

impl SideRooms {
    /// Whether `room` is on screen.
    pub fn shows(&self, room: SideRoom) -> bool {
        self.open && self.room == room
    }
}

/// Shows the room.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    ui.horizontal(|ui| {
        for (room, text) in [
            (SideRoom::Conic, "Conic"),
            (SideRoom::Homogeneous, "Homogeneous"),
            (SideRoom::Hermite, "Hermite"),
        ] {
            ui.selectable_value(&mut lab.rooms.room, room, text);
        }
    });
    ui.add_space(2.0);
    match lab.rooms.room {
        SideRoom::Conic => conic_panel::show(lab, ui),
        SideRoom::Homogeneous => space_panel::show(lab, ui),
        SideRoom::Hermite => hermite_panel::show(lab, ui),
    }
}

/// The commands that open a room.
pub(crate) fn execute(command: Command, lab: &mut Lab) -> bool {
    lab.rooms.room = match command {
        Command::ShowConic => SideRoom::Conic,
        Command::ShowHomogeneous => SideRoom::Homogeneous,
        Command::ShowHermite => SideRoom::Hermite,
        _ => return false,
    };
    lab.view.panels.insert(RIGHT_PANEL.to_owned(), true);
    lab.side = SidePage::Rooms;
    true
}

/// Draws on the canvas what belongs to the room.
pub(crate) fn draw(lab: &Lab, viewport: &Viewport, picture: &mut Picture) {
    if lab.rooms.shows(SideRoom::Conic) {
        conic_drawing::draw(lab, viewport, picture);
    } else if let Some(hermite) = lab.rooms.hermite.filter(|_| lab.rooms.shows(SideRoom::Hermite)) {
        hermite.draw(&lab.theme, viewport, picture);
    }
}

/// The selected curve, or a sentence in its place.
fn subject(lab: &Lab, ui: &mut Ui, purpose: &str) -> Option<(ObjectId, Nurbs<DVec2>)> {
    let found = lab.selection.object.zip(lab.curve().cloned());
    if found.is_none() {
        ui.add_space(8.0);
        ui.label(RichText::new(format!("Select a curve {purpose}.")).weak());
    }
    found
}
