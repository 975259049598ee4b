//! The record of a spline or NURBS surface:
//!
//! ```text
//! {"u": {"degree": 2, "knots": […], "period": T (closed directions only)}, "v": {…},
//!  "points": [[x, y, z], …] (row by row), "weights": […] (unless all are 1), "display": {…}}
//! ```

use glam::DVec3;
use serde::Deserialize;
use serde_json::json;

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::surface::{NurbsSurface, SurfaceError};
use crate::core::tensor::{TensorError, TensorSplineSpace};
use crate::document::apply::MAX_POINTS;
use crate::document::file_error::FileError;
use crate::document::json::entry;
use crate::document::json::writer::Node;
use crate::document::object::Content;
use crate::document::surface::{SurfaceDisplay, SurfaceObject};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SurfaceRecord {
    u: DirectionRecord,
    v: DirectionRecord,
    points: Vec<[f64; 3]>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    #[serde(default)]
    display: SurfaceDisplay,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DirectionRecord {
    degree: usize,
    knots: Vec<f64>,
    #[serde(default)]
    period: Option<f64>,
}

pub(super) fn node(object: &SurfaceObject) -> Node {
    let surface = object.surface();
    let [u, v] = surface.space().axes().each_ref().map(direction_node);
    let mut entries =
        vec![("u".to_owned(), u), ("v".to_owned(), v), ("points".to_owned(), points_node(surface.points()))];
    if surface.weights().iter().any(|weight| weight.to_bits() != 1.0_f64.to_bits()) {
        entries.push(entry("weights", json!(surface.weights())));
    }
    entries.push(entry("display", json!(object.display())));
    Node::Record(entries)
}

fn direction_node(space: &SplineSpace) -> Node {
    let mut entries = vec![entry("degree", json!(space.degree())), entry("knots", json!(space.knots()))];
    entries.extend(space.period().map(|period| entry("period", json!(period))));
    Node::Record(entries)
}

/// Points of space, one a line.
pub(super) fn points_node(points: &[DVec3]) -> Node {
    Node::List(points.iter().map(|point| Node::from(json!(point.to_array()))).collect())
}

impl SurfaceRecord {
    pub(super) fn content(self, place: &str) -> Result<Content, FileError> {
        check_count(self.points.len(), MAX_POINTS, "points", place)?;
        self.display.check().map_err(|error| FileError::value(format!("{place}.display"), error))?;
        let surface = self
            .u
            .space()
            .map_err(|error| (0, error))
            .and_then(|u| self.v.space().map(|v| [u, v]).map_err(|error| (1, error)))
            .map_err(|(axis, error)| FileError::value(direction_place(place, axis, &error), error))
            .and_then(|axes| {
                surface_of(axes, &self.points, self.weights)
                    .map_err(|error| FileError::value(format!("{place}{}", field_of(&error)), error))
            })?;
        let object = SurfaceObject::new(surface, self.display);
        Ok(Content::Surface(object.map_err(|error| FileError::value(place, error))?))
    }
}

impl DirectionRecord {
    fn space(&self) -> Result<SplineSpace, SplineError> {
        match self.period {
            Some(period) => SplineSpace::periodic(self.degree, period, self.knots.clone()),
            None => SplineSpace::new(self.degree, self.knots.clone()),
        }
    }
}

fn surface_of(
    axes: [SplineSpace; 2],
    points: &[[f64; 3]],
    weights: Option<Vec<f64>>,
) -> Result<NurbsSurface, SurfaceError> {
    let space = TensorSplineSpace::new(axes)?;
    let points = points.iter().copied().map(DVec3::from_array).collect();
    match weights {
        Some(weights) => NurbsSurface::new(space, points, weights),
        None => NurbsSurface::polynomial(space, points),
    }
}

fn direction_place(place: &str, axis: usize, error: &SplineError) -> String {
    format!("{place}.{}{}", ["u", "v"][axis], crate::document::json::curve::field_of(error))
}

/// The entry of the record that `error` is about.
fn field_of(error: &SurfaceError) -> String {
    match error {
        SurfaceError::Tensor(TensorError::SizeMismatch { what, .. }) if what.contains("weight") => {
            ".weights".to_owned()
        }
        SurfaceError::Tensor(TensorError::SizeMismatch { .. }) => ".points".to_owned(),
        SurfaceError::Tensor(TensorError::WeightNotPositive { index, .. }) => format!(".weights[{index}]"),
        SurfaceError::Tensor(TensorError::NonFinite { what: "weight", index, .. }) => {
            format!(".weights[{index}]")
        }
        SurfaceError::Tensor(TensorError::NonFinite { index, .. }) => format!(".points[{index}]"),
        _ => String::new(),
    }
}

/// Whether a list of the record is short enough.
pub(super) fn check_count(count: usize, limit: usize, what: &str, place: &str) -> Result<(), FileError> {
    if count > limit {
        let message = format!("{count} {what} are above the limit {limit}");
        return Err(FileError::value(format!("{place}.{what}"), message));
    }
    Ok(())
}
