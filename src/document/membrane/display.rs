//! How the solution of a boundary value problem is shown.

use serde::{Deserialize, Serialize};

use crate::document::edit_error::EditError;

/// What is drawn of a problem and its solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MembraneDisplay {
    /// Index into the palette of object colours.
    pub color: usize,
    /// The quantity that is shown.
    pub shown: Shown,
    /// The colours of the field.
    pub colors: FieldColors,
    /// Whether the field is coloured.
    pub fill: bool,
    /// Number of isolines, 0 to [`Self::MAX_LINES`].
    pub isolines: usize,
    /// The nodes of the B-splines: inner ones filled, outer ones hollow; on a patch hollow where `u = 0` is prescribed.
    pub nodes: bool,
    /// The cells of the grid, cut ones marked.
    pub cells: bool,
    /// The nodes of the quadrature.
    pub quadrature: bool,
    /// The control net of a patch, the boundaries of the primitives of a domain.
    pub net: bool,
    /// Number of stream lines of a flow, 0 to [`Self::MAX_LINES`].
    pub stream_lines: usize,
}

/// The quantity that is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shown {
    /// The solution `u`; of a flow the potential.
    #[default]
    Value,
    /// The length of its gradient; of a flow the speed.
    Slope,
}

/// A way through the colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FieldColors {
    /// From dark violet through green to yellow.
    #[default]
    Viridis,
    /// From dark blue through grey to yellow.
    Cividis,
    /// From blue through near white to red, with 0 in the middle.
    Diverging,
}

impl MembraneDisplay {
    /// The most isolines or stream lines.
    pub const MAX_LINES: usize = 60;

    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// `BadDisplay` with the name of the field, its value and the range.
    pub fn check(&self) -> Result<(), EditError> {
        for (field, value) in [("isolines", self.isolines), ("stream_lines", self.stream_lines)] {
            if value > Self::MAX_LINES {
                let (value, high) = (value as f64, Self::MAX_LINES as f64);
                return Err(EditError::BadDisplay { field, value, low: 0.0, high });
            }
        }
        Ok(())
    }
}

impl Default for MembraneDisplay {
    fn default() -> Self {
        Self {
            color: 0,
            shown: Shown::Value,
            colors: FieldColors::Viridis,
            fill: true,
            isolines: 10,
            nodes: false,
            cells: false,
            quadrature: false,
            net: true,
            stream_lines: 0,
        }
    }
}
