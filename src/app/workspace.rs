//! What a workspace is: a view of the one document with its canvas, its own panels and commands.

use eframe::egui;

use crate::app::command::Command;
use crate::app::lab::Lab;

/// One of the rooms of the lab.
pub(crate) trait Workspace {
    /// The name on its tab.
    fn name(&self) -> &'static str;

    /// Panels of its own at the edges of the window.
    fn panels(&mut self, _lab: &mut Lab, _ui: &mut egui::Ui) {}

    /// The middle of the window.
    fn canvas(&mut self, lab: &mut Lab, ui: &mut egui::Ui);

    /// Carries out `command`; `false` if it is not one of its own.
    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool;

    /// Where a point of the world is on the screen, in logical pixels; `None` before the first frame.
    fn screen_from_world(&self, world: glam::DVec2, lab: &Lab) -> Option<egui::Pos2>;
}

/// All workspaces, in the order of their tabs.
pub(crate) fn all() -> Vec<Box<dyn Workspace>> {
    vec![Box::new(crate::app::curves::Curves::default())]
}
