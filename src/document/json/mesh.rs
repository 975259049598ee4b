//! The record of a polygon mesh:
//!
//! ```text
//! {"vertices": [[x, y, z], …], "faces": [[0, 1, 2, 3], …], "sharp": [[a, b, sharpness], …] (from 10 on infinite),
//!  "fixed": [vertex, …], "boundary": "standard" | "fixed-corners" | "discard", "level": 2, "display": {…}}
//! ```

use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::core::surface::catmull_clark::BoundaryRule;
use crate::core::surface::{INFINITE_SHARPNESS, MeshError, PolygonMesh};
use crate::document::apply::MAX_POINTS;
use crate::document::edit_error::EditError;
use crate::document::file_error::FileError;
use crate::document::json::entry;
use crate::document::json::surface::{check_count, points_node};
use crate::document::json::writer::Node;
use crate::document::mesh::{MeshDisplay, MeshObject};
use crate::document::object::Content;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshRecord {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<u32>>,
    #[serde(default)]
    sharp: Vec<(u32, u32, f64)>,
    #[serde(default)]
    fixed: Vec<u32>,
    #[serde(default)]
    boundary: BoundaryName,
    level: usize,
    #[serde(default)]
    display: MeshDisplay,
}

/// The rules by name.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum BoundaryName {
    #[default]
    Standard,
    FixedCorners,
    Discard,
}

pub(super) fn node(object: &MeshObject) -> Node {
    let cage = object.cage();
    let faces = cage.topology().faces().map(|face| Node::from(json!(face))).collect();
    let mut entries =
        vec![("vertices".to_owned(), points_node(cage.positions())), ("faces".to_owned(), Node::List(faces))];
    if !cage.creases().is_empty() {
        let sharp = cage.creases().iter().map(|crease| {
            let [a, b] = cage.topology().edge(crease.edge as usize);
            Node::from(json!([a, b, crease.sharpness.min(INFINITE_SHARPNESS)]))
        });
        entries.push(("sharp".to_owned(), Node::List(sharp.collect())));
    }
    if !cage.fixed_vertices().is_empty() {
        entries.push(entry("fixed", json!(cage.fixed_vertices())));
    }
    let boundary = match object.rule() {
        BoundaryRule::Discard => BoundaryName::Discard,
        BoundaryRule::Standard { fix_corners: true } => BoundaryName::FixedCorners,
        BoundaryRule::Standard { fix_corners: false } => BoundaryName::Standard,
    };
    entries.push(entry("boundary", json!(boundary)));
    entries.push(entry("level", json!(object.level())));
    entries.push(entry("display", json!(object.display())));
    Node::Record(entries)
}

impl MeshRecord {
    pub(super) fn content(self, place: &str) -> Result<Content, FileError> {
        check_count(self.vertices.len(), MAX_POINTS, "vertices", place)?;
        check_count(self.faces.len(), MeshObject::MAX_FACES, "faces", place)?;
        let at = |field: String, error: &dyn std::fmt::Display| {
            FileError::value(format!("{place}{field}"), error.to_string())
        };
        let positions = self.vertices.into_iter().map(DVec3::from_array).collect();
        let mut cage =
            PolygonMesh::new(positions, &self.faces).map_err(|error| at(field_of(&error), &error))?;
        for (index, &(a, b, sharpness)) in self.sharp.iter().enumerate() {
            cage = cage
                .with_sharpness([a, b], sharpness)
                .map_err(|error| at(format!(".sharp[{index}]"), &error))?;
        }
        for (index, &vertex) in self.fixed.iter().enumerate() {
            cage = cage.with_fixed_vertex(vertex).map_err(|error| at(format!(".fixed[{index}]"), &error))?;
        }
        let rule = match self.boundary {
            BoundaryName::Standard => BoundaryRule::Standard { fix_corners: false },
            BoundaryName::FixedCorners => BoundaryRule::Standard { fix_corners: true },
            BoundaryName::Discard => BoundaryRule::Discard,
        };
        let field = |error: &EditError| match error {
            EditError::BadDisplay { field: "level", .. } | EditError::TooMany { what: "faces", .. } => {
                ".level"
            }
            EditError::BadDisplay { .. } => ".display",
            EditError::Mesh(MeshError::EmptyResult) => ".boundary",
            _ => "",
        };
        let object = MeshObject::new(cage, rule, self.level, self.display);
        Ok(Content::Mesh(object.map_err(|error| at(field(&error).to_owned(), &error))?))
    }
}

/// The entry of the record that `error` is about.
fn field_of(error: &MeshError) -> String {
    match error {
        MeshError::Empty { what } => format!(".{what}"),
        MeshError::NonFinite { index, .. } => format!(".vertices[{index}]"),
        MeshError::IndexOutOfRange { face, .. }
        | MeshError::DegenerateFace { face, .. }
        | MeshError::DuplicateFace { face, .. } => format!(".faces[{face}]"),
        MeshError::NonManifoldEdge { faces, .. } => {
            faces.last().map_or_else(String::new, |face| format!(".faces[{face}]"))
        }
        MeshError::InconsistentOrientation { faces, .. } => format!(".faces[{}]", faces[1]),
        MeshError::NonManifoldVertex { vertex } | MeshError::IsolatedVertex { vertex } => {
            format!(".vertices[{vertex}]")
        }
        _ => String::new(),
    }
}
