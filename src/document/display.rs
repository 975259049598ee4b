//! How a curve is shown.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::document::edit_error::EditError;

/// What is drawn of a curve, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CurveDisplay {
    /// Index into the palette of object colours; a palette with `N` entries uses `color mod N`.
    pub color: usize,
    /// Line width in pt, from [`CurveDisplay::MIN_WIDTH`] to [`CurveDisplay::MAX_WIDTH`].
    pub width: f64,
    /// The control polygon.
    pub polygon: bool,
    /// The control points.
    pub points: bool,
    /// What is written beside the control points.
    pub labels: PointLabels,
    /// The points of the curve at the knots.
    pub knots: bool,
    /// The curvature comb.
    pub comb: bool,
    /// World length of a tooth per unit of curvature; positive values put left turns' teeth on the right of the curve.
    pub comb_scale: f64,
    /// Number of teeth per knot interval, from 1 to [`CurveDisplay::MAX_TEETH`].
    pub comb_teeth: usize,
    /// De Boor's construction at the parameter t.
    pub construction: bool,
    /// The convex hull of the control points that are active at t.
    pub hull: bool,
    /// The osculating circle at t.
    pub osculating_circle: bool,
    /// The polynomial pieces in alternating colours.
    pub pieces: bool,
    /// Tangent and normal at the parameter.
    pub frame: bool,
    /// The derivative as a curve, in a corner of the sheet.
    pub hodograph: bool,
    /// The Bezier polygons of all pieces.
    pub bezier_points: bool,
    /// The knots beside their control point, as arguments of the blossom.
    pub blossom_labels: bool,
    /// Where the curve must run, by the bound of its distance from the polygon.
    pub distance_tube: bool,
    /// Where the curvature changes its sign.
    pub inflections: bool,
    /// Where the curvature is extreme.
    pub vertices: bool,
    /// The axis or the centre of the nearest symmetry, with the distance from it.
    pub symmetry: bool,
    /// A line whose crossings with curve and polygon are counted.
    pub probe_line: bool,
    /// Two points of the probe line; without them it runs level through the middle of the control points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probe: Option<[DVec2; 2]>,
}

/// What is written beside the control points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointLabels {
    /// Nothing.
    #[default]
    None,
    /// The index k.
    Index,
    /// The weight.
    Weight,
    /// Both coordinates.
    Coordinates,
}

impl CurveDisplay {
    /// The thinnest line in pt: thinner ones cannot be seen.
    pub const MIN_WIDTH: f64 = 0.01;
    /// The widest line in pt: wider ones hide what they show.
    pub const MAX_WIDTH: f64 = 100.0;
    /// The most teeth of a comb per knot interval.
    pub const MAX_TEETH: usize = 1000;

    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// `BadDisplay` with the name of the field, its value and the range.
    pub fn check(&self) -> Result<(), EditError> {
        let teeth = self.comb_teeth as f64;
        for (field, value, range) in [
            ("width", self.width, Self::MIN_WIDTH..=Self::MAX_WIDTH),
            ("comb_scale", self.comb_scale, f64::MIN..=f64::MAX),
            ("comb_teeth", teeth, 1.0..=Self::MAX_TEETH as f64),
        ] {
            if !range.contains(&value) {
                return Err(EditError::BadDisplay { field, value, low: *range.start(), high: *range.end() });
            }
        }
        // Coordinates beyond this have squares that are no numbers.
        let range = -1e150..=1e150;
        for value in self.probe.iter().flatten().flat_map(|point| point.to_array()) {
            if !range.contains(&value) {
                return Err(EditError::BadDisplay { field: "probe", value, low: -1e150, high: 1e150 });
            }
        }
        Ok(())
    }
}

impl Default for CurveDisplay {
    fn default() -> Self {
        Self {
            color: 0,
            width: 2.0,
            polygon: true,
            points: true,
            labels: PointLabels::None,
            knots: true,
            comb: false,
            comb_scale: 0.25,
            comb_teeth: 12,
            construction: false,
            hull: false,
            osculating_circle: false,
            pieces: false,
            frame: false,
            hodograph: false,
            bezier_points: false,
            blossom_labels: false,
            distance_tube: false,
            inflections: false,
            vertices: false,
            symmetry: false,
            probe_line: false,
            probe: None,
        }
    }
}
