//! How the document was looked at: saved beside the data, never undone.

use std::collections::BTreeMap;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::document::contents::Document;
use crate::document::eye::EyeState;
use crate::document::object::ObjectId;
use crate::document::stepper_kind::{StepperChoices, StepperKind};

/// Camera, parameters, panels and selection. Unknown entries of a file are ignored, missing ones take defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct View {
    /// Where the canvas looks.
    pub camera: Camera,
    /// Where the canvases of rooms with a plane of their own look, by [`Self::workspace`].
    pub cameras: BTreeMap<String, Camera>,
    /// Where space is looked at from.
    pub eye: EyeState,
    /// The ranges that the plots of each approximation show; those without an entry show everything.
    pub plots: BTreeMap<ObjectId, PlotWindow>,
    /// The parameter t of each curve.
    pub parameters: BTreeMap<ObjectId, f64>,
    /// The algorithm that is told step by step.
    pub stepper: StepperKind,
    /// What that algorithm needs beside the curve and its parameter.
    pub stepper_choices: StepperChoices,
    /// Name of the open workspace; empty for the first.
    pub workspace: String,
    /// Name of the look; empty for the program's choice.
    pub theme: String,
    /// Which panels are open, by name.
    pub panels: BTreeMap<String, bool>,
    /// The selected object.
    pub selected_object: Option<ObjectId>,
    /// The selected control points of that object.
    pub selected_points: Vec<usize>,
}

impl View {
    /// The plane camera of the open workspace.
    pub fn room_camera(&self) -> Camera {
        self.cameras.get(&self.workspace).copied().unwrap_or(self.camera)
    }
}

/// A plane camera without rotation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Camera {
    /// World point in the middle of the canvas.
    pub center: DVec2,
    /// Screen points per world unit.
    pub scale: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { center: DVec2::ZERO, scale: 80.0 }
    }
}

/// The ranges of two axes with scales of their own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlotWindow {
    /// Left and right end.
    pub x: [f64; 2],
    /// Lower and upper end.
    pub y: [f64; 2],
}

impl PlotWindow {
    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// A sentence with the range that has no length.
    pub fn check(&self) -> Result<(), String> {
        for (name, [low, high]) in [("x", self.x), ("y", self.y)] {
            if !(low < high && (high - low).is_finite()) {
                return Err(format!("the range of {name} from {low} to {high} has no length"));
            }
        }
        Ok(())
    }
}

impl Default for PlotWindow {
    fn default() -> Self {
        Self { x: [0.0, 1.0], y: [0.0, 1.0] }
    }
}

/// What a file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Saved {
    /// The data.
    pub document: Document,
    /// How it was looked at.
    pub view: View,
}
