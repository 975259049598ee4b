//! The Surfaces workspace: spline surfaces and subdivided meshes in space.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | [`Surfaces`], the workspace |
//! | `canvas.rs` | the view, its handles, the hands on it |
//! | `overlay.rs`, `marks.rs` | what is painted over the scene |
//! | `context_menu.rs` | the menu of the thing under the pointer |
//! | `gesture.rs` | the left button between press and release |
//! | `target.rs` | what lies under the pointer |
//! | `commands.rs` | commands that change the selected object |
//! | `shape_store.rs` | shapes of the objects, large ones computed beside the window's thread |
//! | `measures.rs` | area and volume, computed beside the window's thread |
//! | `start.rs` | shapes to start with |
//! | `stencil.rs` | the weights of a vertex of a refined mesh |
//! | `inspector/` | numbers and choices |

mod canvas;
pub(super) mod commands;
mod context_menu;
mod gesture;
mod inspector;
mod marks;
mod measures;
mod overlay;
mod shape_store;
mod start;
mod stencil;
mod target;

use eframe::egui::{self, Ui};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::scene_view::eye_tools;
use crate::app::toolbar::button;
use crate::app::workspace::{Room, Workspace};
use crate::document::ObjectId;
use crate::figure::composition::short_number;
use crate::figure::scene::Eye;

use canvas::Canvas;
use measures::Measures;

/// What is selected of a mesh beside its vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Picked {
    /// Nothing.
    #[default]
    Nothing,
    /// An edge of the control mesh, by its ends.
    Edge(ObjectId, [u32; 2]),
    /// A vertex of the refined mesh.
    Refined(ObjectId, usize),
}

/// The workspace of surfaces.
#[derive(Debug, Default)]
pub(crate) struct Surfaces {
    canvas: Canvas,
    measures: Measures,
}

impl Workspace for Surfaces {
    fn room(&self) -> Room {
        Room::Surfaces
    }

    fn tools(&mut self, lab: &mut Lab, ui: &mut Ui) {
        start::menu(lab, ui);
        ui.separator();
        let is_mesh = commands::selected(lab).is_some_and(|object| object.mesh().is_some());
        if is_mesh {
            button("Coarsen", Command::LevelDown, lab, ui);
            button("Refine", Command::LevelUp, lab, ui);
            ui.separator();
        }
        button("Net", Command::ToggleNet, lab, ui);
        button("Lines", Command::ToggleLines, lab, ui);
        if is_mesh {
            button("Smooth", Command::ToggleSmooth, lab, ui);
            button("Limits", Command::ToggleLimits, lab, ui);
        } else {
            button("Normals", Command::ToggleNormals, lab, ui);
        }
        ui.separator();
        let mut eye = eye_of(lab);
        if eye_tools(&mut eye, ui) {
            lab.view.eye = *eye.state();
        }
    }

    fn inspector(&mut self, lab: &mut Lab, ui: &mut Ui) {
        inspector::show(lab, &mut self.canvas, &mut self.measures, ui);
    }

    fn canvas(&mut self, lab: &mut Lab, ui: &mut Ui) {
        self.canvas.show(lab, ui);
    }

    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        self.canvas.execute(command, lab) || commands::execute(command, lab)
    }

    fn status(&self, lab: &Lab) -> String {
        let faces = self.canvas.triangle_count();
        if faces == 0 {
            return String::new();
        }
        let distance = short_number(lab.view.eye.distance);
        format!("{faces} triangles, seen from {distance}")
    }

    fn handles(&self, lab: &Lab) -> Vec<(String, egui::Pos2)> {
        self.canvas.handles(lab)
    }
}

/// The eye of the view; the usual one if its numbers are impossible.
pub(super) fn eye_of(lab: &Lab) -> Eye {
    Eye::new(lab.view.eye).unwrap_or_default()
}
