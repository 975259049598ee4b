//! The record of a boundary value problem:
//!
//! ```text
//! {"degree": 2, "load": "1", "exact": "…" (if there is one), "diffusion": 1, "reaction": 0,
//!  "domain": {"width": h, "parts": [{"operation": "union", "shape": {"disc": {"center": [x, y], "radius": r}}}, …]},
//!  "display": {…}}
//! ```
//!
//! In place of `domain` stands `patch` (`{"degrees": […], "knots": [[…], […]], "points": […], "weights": […] (unless all are 1),
//! "divisions": N, "fixed": ["left", …]}`) or `channel` (the same with `"inflow"` for `"fixed"`).

use glam::DVec2;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::core::bspline::SplineSpace;
use crate::core::finite_element::{FiniteElementError, PatchSide, PlanePatch};
use crate::document::file_error::FileError;
use crate::document::json::entry;
use crate::document::json::writer::Node;
use crate::document::membrane::{
    MAX_PARTS, MAX_PATCH_POINTS, Membrane, MembraneDisplay, MembraneError, Part, Region, Setting,
    read_formula,
};
use crate::document::object::Content;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MembraneRecord {
    degree: usize,
    load: String,
    #[serde(default)]
    exact: Option<String>,
    diffusion: f64,
    reaction: f64,
    #[serde(default)]
    domain: Option<DomainRecord>,
    #[serde(default)]
    patch: Option<PatchRecord>,
    #[serde(default)]
    channel: Option<PatchRecord>,
    #[serde(default)]
    display: MembraneDisplay,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DomainRecord {
    width: f64,
    parts: Vec<Part>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PatchRecord {
    degrees: [usize; 2],
    knots: [Vec<f64>; 2],
    points: Vec<DVec2>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    divisions: usize,
    #[serde(default)]
    fixed: Option<Vec<SideName>>,
    #[serde(default)]
    inflow: Option<f64>,
}

#[derive(Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SideName {
    Left,
    Right,
    Bottom,
    Top,
}

/// In the order of [`PatchSide::ALL`].
const SIDES: [SideName; 4] = [SideName::Left, SideName::Right, SideName::Bottom, SideName::Top];

pub(super) fn node(membrane: &Membrane, display: &MembraneDisplay) -> Node {
    let setting = membrane.setting();
    let mut entries = vec![entry("degree", json!(setting.degree)), entry("load", json!(setting.load.text()))];
    entries.extend(setting.exact.as_ref().map(|exact| entry("exact", json!(exact.text()))));
    entries.push(entry("diffusion", json!(setting.diffusion)));
    entries.push(entry("reaction", json!(setting.reaction)));
    entries.push(match &setting.region {
        Region::Parts { parts, width } => {
            let parts = parts.iter().map(|part| Node::from(json!(part))).collect();
            let record = vec![entry("width", json!(width)), ("parts".to_owned(), Node::List(parts))];
            ("domain".to_owned(), Node::Record(record))
        }
        Region::Patch { patch, fixed, divisions } => {
            let fixed: Vec<SideName> =
                SIDES.into_iter().zip(fixed).filter(|(_, fixed)| **fixed).map(|(side, _)| side).collect();
            ("patch".to_owned(), patch_node(patch, *divisions, entry("fixed", json!(fixed))))
        }
        Region::Channel { patch, inflow, divisions } => {
            ("channel".to_owned(), patch_node(patch, *divisions, entry("inflow", json!(inflow))))
        }
    });
    entries.push(entry("display", json!(display)));
    Node::Record(entries)
}

fn patch_node(patch: &PlanePatch, divisions: usize, last: (String, Node)) -> Node {
    let spaces = patch.spaces();
    let knots = spaces.iter().map(|space| Node::from(json!(space.knots()))).collect();
    let points = patch.points().iter().map(|point| Node::from(json!([point.x, point.y]))).collect();
    let mut entries = vec![
        entry("degrees", json!([spaces[0].degree(), spaces[1].degree()])),
        ("knots".to_owned(), Node::List(knots)),
        ("points".to_owned(), Node::List(points)),
    ];
    if patch.weights().iter().any(|weight| weight.to_bits() != 1.0_f64.to_bits()) {
        entries.push(entry("weights", json!(patch.weights())));
    }
    entries.push(entry("divisions", json!(divisions)));
    entries.push(last);
    Node::Record(entries)
}

impl MembraneRecord {
    pub(super) fn content(self, place: &str) -> Result<Content, FileError> {
        let wrong = |field: &str, error: &dyn std::fmt::Display| {
            FileError::value(format!("{place}{field}"), error.to_string())
        };
        self.display.check().map_err(|error| wrong(".display", &error))?;
        let load = read_formula(&self.load, "load").map_err(|error| wrong(".load", &error))?;
        let exact = self.exact.map(|text| read_formula(&text, "solution")).transpose();
        let exact = exact.map_err(|error| wrong(".exact", &error))?;
        let region = match (self.domain, self.patch, self.channel) {
            (Some(DomainRecord { width, parts }), None, None) => {
                if parts.len() > MAX_PARTS {
                    let message = format!("{} parts are above the limit {MAX_PARTS}", parts.len());
                    return Err(wrong(".domain.parts", &message));
                }
                Region::Parts { parts, width }
            }
            (None, Some(record), None) => {
                let place = format!("{place}.patch");
                let (divisions, sides) = (record.divisions, record.fixed.clone().unwrap_or_default());
                if record.inflow.is_some() {
                    return Err(FileError::value(format!("{place}.inflow"), "only a channel has an inflow"));
                }
                Region::Patch {
                    patch: record.patch(&place)?,
                    fixed: SIDES.map(|side| sides.contains(&side)),
                    divisions,
                }
            }
            (None, None, Some(record)) => {
                let place = format!("{place}.channel");
                let (divisions, inflow) = (record.divisions, record.inflow);
                let Some(inflow) = inflow.filter(|_| record.fixed.is_none()) else {
                    return Err(FileError::value(place, "a channel needs an inflow and has no fixed sides"));
                };
                Region::Channel { patch: record.patch(&place)?, inflow, divisions }
            }
            _ => return Err(wrong("", &"exactly one of domain, patch and channel is needed")),
        };
        let (degree, diffusion, reaction) = (self.degree, self.diffusion, self.reaction);
        let setting = Setting { region, degree, load, exact, diffusion, reaction };
        let membrane = Membrane::new(setting).map_err(|error| wrong(field_of(&error), &error))?;
        Ok(Content::Membrane { membrane, display: self.display })
    }
}

impl PatchRecord {
    fn patch(self, place: &str) -> Result<PlanePatch, FileError> {
        let count = self.points.len();
        if count > MAX_PATCH_POINTS {
            let message = format!("{count} points are above the limit {MAX_PATCH_POINTS}");
            return Err(FileError::value(format!("{place}.points"), message));
        }
        let [first, second] = self.knots;
        let space = |axis: usize, knots: Vec<f64>| {
            SplineSpace::new(self.degrees[axis], knots)
                .map_err(|error| FileError::value(format!("{place}.knots[{axis}]"), error))
        };
        let spaces = [space(0, first)?, space(1, second)?];
        let weights = self.weights.unwrap_or_else(|| vec![1.0; count]);
        PlanePatch::new(spaces, self.points, weights).map_err(|error| {
            let field = match &error {
                FiniteElementError::SizeMismatch { what: "control points", .. } => ".points",
                FiniteElementError::SizeMismatch { .. } => ".weights",
                _ => "",
            };
            FileError::value(format!("{place}{field}"), error)
        })
    }
}

/// The entry of the record that `error` is about.
fn field_of(error: &MembraneError) -> &'static str {
    match error {
        MembraneError::Part { .. } => ".domain.parts",
        MembraneError::OutOfRange { what: "degree", .. } => ".degree",
        MembraneError::OutOfRange { what: "coefficient a", .. } => ".diffusion",
        MembraneError::OutOfRange { what: "coefficient c", .. } => ".reaction",
        MembraneError::OutOfRange { what: "grid width", .. } => ".domain.width",
        _ => "",
    }
}

/// Sides of the record must stand in the order of the core's.
const _: () = assert!(PatchSide::ALL.len() == SIDES.len(), "every side has a name");
