//! What a workspace is: a view of the one document with its canvas, its own panels, tools and commands.

use eframe::egui::{Pos2, Ui};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::document::Content;

/// The rooms of the lab, in the order of their tabs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Room {
    /// Plane curves.
    #[default]
    Curves,
    /// Data, functions, and methods that approximate them.
    Approximation,
    /// Surfaces and subdivided meshes in space.
    Surfaces,
    /// Membranes and flows with finite elements.
    Elements,
}

impl Room {
    /// All rooms.
    pub const ALL: [Self; 4] = [Self::Curves, Self::Approximation, Self::Surfaces, Self::Elements];

    /// The name on the tab.
    pub fn title(self) -> &'static str {
        match self {
            Self::Curves => "Curves",
            Self::Surfaces => "Surfaces",
            Self::Approximation => "Approximation",
            Self::Elements => "Finite elements",
        }
    }

    /// The name in files; empty for the first room.
    pub fn key(self) -> &'static str {
        match self {
            Self::Curves => "",
            Self::Surfaces => crate::figure::surfaces::WORKSPACE,
            Self::Approximation => crate::figure::approximation::ROOM,
            Self::Elements => crate::figure::elements::WORKSPACE,
        }
    }

    /// The room with that name in files; the first one for an unknown name.
    pub fn by_key(key: &str) -> Self {
        Self::ALL.into_iter().find(|room| room.key() == key).unwrap_or_default()
    }

    /// The room where `content` is worked on.
    pub fn of(content: &Content) -> Self {
        match content {
            Content::Curve { .. } => Self::Curves,
            Content::Surface(_) | Content::Mesh(_) => Self::Surfaces,
            Content::Approximation(_) => Self::Approximation,
            Content::Membrane { .. } => Self::Elements,
        }
    }
}

/// What fills the window in one of the rooms.
pub(crate) trait Workspace {
    /// The room.
    fn room(&self) -> Room;

    /// Its part of the row of tools.
    fn tools(&mut self, lab: &mut Lab, ui: &mut Ui);

    /// Panels of its own at the edges of the window.
    fn panels(&mut self, _lab: &mut Lab, _ui: &mut Ui) {}

    /// Everything about the selected object as numbers and choices.
    fn inspector(&mut self, lab: &mut Lab, ui: &mut Ui);

    /// The middle of the window.
    fn canvas(&mut self, lab: &mut Lab, ui: &mut Ui);

    /// Carries out `command`; `false` if it is not one of its own.
    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool;

    /// What the right end of the status line says, such as the zoom.
    fn status(&self, lab: &Lab) -> String;

    /// Everything that can be grabbed on the canvas, by its accessible name, with its place in logical pixels; empty before
    /// the first frame.
    fn handles(&self, lab: &Lab) -> Vec<(String, Pos2)>;

    /// Where a point of the plane is on the screen, in logical pixels; `None` before the first frame, or in a room without a
    /// plane.
    fn screen_from_world(&self, _world: glam::DVec2, _lab: &Lab) -> Option<Pos2> {
        None
    }
}

/// The workspaces of all rooms, in the order of [`Room::ALL`].
pub(crate) fn all() -> Vec<Box<dyn Workspace>> {
    vec![
        Box::new(crate::app::curves::Curves::default()),
        Box::new(crate::app::approximation::ApproximationRoom::default()),
        Box::new(crate::app::surfaces::Surfaces::default()),
        Box::new(crate::app::elements::Elements::default()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_room_has_its_workspace_and_its_own_name_in_files() {
        let rooms: Vec<Room> = all().iter().map(|workspace| workspace.room()).collect();
        assert_eq!(rooms, Room::ALL, "one workspace per room, in order");
        for room in Room::ALL {
            assert_eq!(Room::by_key(room.key()), room, "{}", room.title());
        }
    }
}
