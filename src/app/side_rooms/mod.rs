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
use crate::figure::picture::{Layer, Picture, Viewport};

pub use hermite::{End, Hermite};
pub use space::Space;

/// Name of the layer with the complete conic.
const CONIC: &str = "complete conic";

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

/// What the room adds to the picture of the canvas.
pub(crate) fn overlay(lab: &Lab, viewport: &Viewport) -> Vec<Layer> {
    let mut picture = Picture::new(None);
    if lab.rooms.shows(SideRoom::Conic) {
        conic_drawing::draw(lab, viewport, &mut picture);
    } else if let Some(hermite) = lab.rooms.hermite.filter(|_| lab.rooms.shows(SideRoom::Hermite)) {
        hermite.draw(&lab.theme, viewport, &mut picture);
    }
    picture.layers
}

/// Puts the layers of [`overlay`] over `picture`, the complete conic behind its curves, which hide the part that they run along.
pub(crate) fn lay_over(overlay: Vec<Layer>, picture: &mut Picture) {
    let ground = |layer: &&Layer| matches!(layer.name.as_str(), "grid" | "scale");
    for layer in overlay {
        let at = if layer.name == CONIC {
            picture.layers.iter().take_while(ground).count()
        } else {
            picture.layers.len()
        };
        picture.layers.insert(at, layer);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use crate::core::bspline::SplineSpace;
    use crate::figure::composition::compose;
    use crate::figure::picture::{Item, Segment};

    #[test]
    fn the_complete_conic_lies_behind_the_curve_and_on_its_equation() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let points = vec![DVec2::X, DVec2::ONE, DVec2::Y];
        let mut lab =
            test_bench::lab_with(Nurbs::new(space, points, vec![1.0, 0.5_f64.sqrt(), 1.0]).unwrap());
        lab.tidy_selection();
        execute(Command::ShowConic, &mut lab);
        lab.rooms.open = true;
        let viewport = Viewport { center: DVec2::ZERO, scale: 100.0, size: DVec2::new(400.0, 300.0) };
        let mut picture = compose(lab.history.document(), &lab.view, &lab.theme, &viewport);
        lay_over(overlay(&lab, &viewport), &mut picture);
        let place = |name: &str| picture.layers.iter().position(|layer| layer.name.contains(name)).unwrap();
        assert!(place(CONIC) < place("Wave"), "behind the curve");
        assert!(place("axes and foci") > place("Wave"), "before it");
        let mut places = Vec::new();
        for item in &picture.layers[place(CONIC)].items {
            let Item::Path(path) = item else { panic!("a path") };
            places.extend(path.segments.iter().filter_map(|segment| match segment {
                Segment::Move(at) | Segment::Line(at) => Some(*at),
                _ => None,
            }));
        }
        assert!(places.iter().any(|at| at.x < -0.99), "the whole circle is there");
        assert!(places.iter().all(|at| (at.length() - 1.0).abs() < 1e-12), "on the unit circle");
    }
}
