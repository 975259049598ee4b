//! Everything that is saved and undone: objects with stable numbers, how each is shown, edits with
//! names for the Undo menu, the file format, saving and recovery.
//!
//! The way of a change: an [`Edit`] goes to [`History::apply`], which keeps the document of before and lets
//! [`Document::apply`] work on a cheap copy; the [`Outcome`] says what happened to the shape.
//! [`save`] and [`load`] keep files, [`Autosave`] what has not been saved yet.

mod apply;
mod approximation;
mod contents;
mod display;
mod edit;
mod edit_error;
mod eye;
mod file_error;
mod history;
mod json;
mod membrane;
mod mesh;
mod object;
mod outcome;
mod recovery;
mod samples;
mod stepper_kind;
mod storage;
mod surface;
mod view;

pub use approximation::{
    Approximation, CubicEnds, DataError, ErrorPlot, KnotChoice, MAX_DATA, MAX_DEGREE, MAX_METHODS, Method,
    Preset, Scheme, TypedFunction,
};
pub use contents::Document;
pub use display::{CurveDisplay, PointLabels};
pub use edit::{CurveMap, Edit, MAX_EDIT_DEGREE};
pub use edit_error::EditError;
pub use eye::{EyeError, EyeState};
pub use file_error::FileError;
pub use history::{DEFAULT_BUDGET, History};
pub use json::{EXTENSION, FORMAT_VERSION, from_json, to_json};
pub use membrane::{
    FieldColors, HandleId, Membrane, MembraneDisplay, MembraneError, MembranePreset, Operation, Part, Region,
    Setting, Shape, Shown, VARIABLES, read_formula,
};
pub use mesh::{MeshDisplay, MeshObject};
pub use object::{Content, Object, ObjectId};
pub use outcome::{Outcome, ShapeChange};
pub use recovery::{Autosave, Damaged, Recovered};
pub use samples::first_scene;
pub use stepper_kind::{StepperChoices, StepperKind, StepperLine};
pub use storage::{MAX_FILE_BYTES, load, save};
pub use surface::{SurfaceColoring, SurfaceDisplay, SurfaceObject};
pub use view::{Camera, PlotWindow, Saved, View};
