//! The window.
//!
//! [`lab::Lab`] is the state that everybody shares; a `Workspace` fills the middle; panels stand around it;
//! [`command::Command`] is everything that can be commanded, `files` opens, saves and keeps safe.

pub mod command;
pub mod directories;
pub mod lab;
pub mod sheet;

mod approximation;
pub mod chart_panel;
mod command_state;
mod curves;
mod dialog;
mod elements;
mod file_dialog;
mod files;
mod formula_view;
mod hands;
mod icon;
mod inspector;
mod knot_line;
mod lesson_panel;
mod look;
mod menu_bar;
mod number_field;
mod number_text;
mod object_list;
mod painter;
mod palette;
mod path_dialog;
mod preferences;
mod progress_strip;
mod scene_view;
mod shortcut_sheet;
pub mod side_rooms;
mod smoke_log;
mod status_bar;
mod stepper_panel;
pub mod story_cache;
mod surfaces;
#[cfg(test)]
mod test_bench;
mod text_field;
mod toolbar;
mod window;
mod worker;
pub mod workspace;

pub use window::{LabApp, run};

/// Entry of [`crate::document::View::panels`] for the panel with objects and lessons.
pub(crate) const LEFT_PANEL: &str = "left";
/// Entry for the panel with inspector, stepper and lesson.
pub(crate) const RIGHT_PANEL: &str = "right";
/// Entry for the knot line.
pub(crate) const KNOT_LINE: &str = "knot_line";
/// Entry for the charts in place of the knot line.
pub(crate) const CHARTS: &str = "charts";
/// Entry for the basis builder, which is shut unless it is there.
pub(crate) const BASIS_BUILDER: &str = "basis_builder";
