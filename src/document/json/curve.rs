//! The record of a plane curve:
//!
//! ```text
//! {"degree": 3, "knots": […], "period": T (closed curves only), "points": [[x, y], …], "weights": […] (unless all are 1),
//!  "display": {…}}
//! ```

use glam::DVec2;
use serde::Deserialize;
use serde_json::json;

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::spline_curve::Nurbs;
use crate::document::apply::MAX_POINTS;
use crate::document::display::CurveDisplay;
use crate::document::file_error::FileError;
use crate::document::json::entry;
use crate::document::json::writer::Node;
use crate::document::object::Content;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CurveRecord {
    degree: usize,
    knots: Vec<f64>,
    #[serde(default)]
    period: Option<f64>,
    points: Vec<[f64; 2]>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    #[serde(default)]
    display: CurveDisplay,
}

pub(super) fn node(curve: &Nurbs<DVec2>, display: &CurveDisplay) -> Node {
    let space = curve.space();
    let points = curve.points().iter().map(|point| Node::from(json!([point.x, point.y]))).collect();
    let mut entries = vec![entry("degree", json!(curve.degree())), entry("knots", json!(space.knots()))];
    entries.extend(space.period().map(|period| entry("period", json!(period))));
    entries.push(("points".to_owned(), Node::List(points)));
    if curve.weights().iter().any(|weight| weight.to_bits() != 1.0_f64.to_bits()) {
        entries.push(entry("weights", json!(curve.weights())));
    }
    entries.push(entry("display", json!(display)));
    Node::Record(entries)
}

impl CurveRecord {
    pub(super) fn content(self, place: &str) -> Result<Content, FileError> {
        let count = self.points.len();
        if count > MAX_POINTS {
            let message = format!("{count} points are above the limit {MAX_POINTS}");
            return Err(FileError::value(format!("{place}.points"), message));
        }
        self.display.check().map_err(|error| FileError::value(format!("{place}.display"), error))?;
        let curve = curve_of(self.degree, self.knots, self.period, &self.points, self.weights)
            .map_err(|error| FileError::value(format!("{place}{}", field_of(&error)), error))?;
        Ok(Content::Curve { curve, display: self.display })
    }
}

fn curve_of(
    degree: usize,
    knots: Vec<f64>,
    period: Option<f64>,
    points: &[[f64; 2]],
    weights: Option<Vec<f64>>,
) -> Result<Nurbs<DVec2>, SplineError> {
    let space = match period {
        Some(period) => SplineSpace::periodic(degree, period, knots)?,
        None => SplineSpace::new(degree, knots)?,
    };
    let points = points.iter().copied().map(DVec2::from_array).collect();
    match weights {
        Some(weights) => Nurbs::new(space, points, weights),
        None => Nurbs::polynomial(space, points),
    }
}

/// The entry of the curve's record that `error` is about.
pub(super) fn field_of(error: &SplineError) -> String {
    match error {
        SplineError::DegreeZero | SplineError::StepLimit { .. } => ".degree".to_owned(),
        SplineError::KnotsDecreasing { index, .. } | SplineError::KnotMultiplicityTooHigh { index, .. } => {
            format!(".knots[{index}]")
        }
        SplineError::KnotsNotRegular { .. } => ".knots".to_owned(),
        SplineError::PeriodTooShort { .. } => ".period".to_owned(),
        SplineError::WeightNotPositive { index, .. } => format!(".weights[{index}]"),
        SplineError::NonFinite { what: "coefficient", index, .. } => format!(".points[{index}]"),
        SplineError::NonFinite { what: "unrolled knot", .. } => ".period".to_owned(),
        SplineError::SizeMismatch { what: "coefficients", .. } => ".points".to_owned(),
        SplineError::SizeMismatch { what, .. } | SplineError::Empty { what } => format!(".{what}"),
        _ => String::new(),
    }
}
