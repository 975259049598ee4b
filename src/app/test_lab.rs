//! A lab for the tests of panels.

use crate::app::lab::Lab;
use crate::document::samples;

/// The lab with the first scene.
pub(crate) fn lab() -> Lab {
    let (document, view) = samples::first_scene();
    Lab::new(document, view)
}
