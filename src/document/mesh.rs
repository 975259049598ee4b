//! A polygon mesh in a document, subdivided by the rules of Catmull and Clark, and how it is shown.

use std::collections::BTreeSet;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::core::progress::Watcher;
use crate::core::surface::catmull_clark::{BoundaryRule, SubdivisionStep};
use crate::core::surface::{MeshError, PolygonMesh};
use crate::document::apply::check_point_count;
use crate::document::edit_error::EditError;
use crate::document::surface::{SurfaceColoring, check_ranges};

/// What is drawn of a mesh, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeshDisplay {
    /// Index into the palette of object colours; a palette with `N` entries uses `color mod N`.
    pub color: usize,
    /// The control mesh with its vertices, around the refined mesh.
    pub cage: bool,
    /// Light as on the smooth surface; else every face is flat.
    pub smooth: bool,
    /// The edges of the refined mesh.
    pub wireframe: bool,
    /// The vertices of the refined mesh stand where they tend to under further steps.
    pub limit: bool,
    /// Marks at inner vertices of the refined mesh that have not four faces, in a colour for each number of faces.
    pub valences: bool,
    /// What the colours of the surface tell.
    pub coloring: SurfaceColoring,
    /// Largest value of the colour scale, which reaches as far below 0; 0 lets the values decide.
    pub color_limit: f64,
}

impl Default for MeshDisplay {
    fn default() -> Self {
        Self {
            color: 0,
            cage: true,
            smooth: true,
            wireframe: true,
            limit: false,
            valences: false,
            coloring: SurfaceColoring::Plain,
            color_limit: 0.0,
        }
    }
}

impl MeshDisplay {
    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// `BadDisplay` with the name of the field, its value and the range.
    pub fn check(&self) -> Result<(), EditError> {
        check_ranges([("color_limit", self.color_limit, 0.0..=f64::MAX)])
    }
}

/// A control mesh, how often it is refined and by which rule at the boundary, and its display.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshObject {
    cage: PolygonMesh,
    rule: BoundaryRule,
    level: usize,
    display: MeshDisplay,
}

impl MeshObject {
    /// Most steps.
    pub const MAX_LEVEL: usize = 6;
    /// Most faces of the control mesh and of the refined one.
    pub const MAX_FACES: usize = 500_000;

    /// The mesh, refined `level` times and shown like this.
    ///
    /// # Errors
    ///
    /// `BadDisplay` for the display or the level; `TooMany` vertices or faces; `EmptyResult` if a rule that discards the
    /// boundary would leave nothing.
    pub fn new(
        cage: PolygonMesh,
        rule: BoundaryRule,
        level: usize,
        display: MeshDisplay,
    ) -> Result<Self, EditError> {
        display.check()?;
        check_ranges([("level", level as f64, 0.0..=Self::MAX_LEVEL as f64)])?;
        check_point_count(cage.positions().len())?;
        let value = face_count(&cage, level);
        if value > Self::MAX_FACES {
            return Err(EditError::TooMany { what: "faces", value, limit: Self::MAX_FACES });
        }
        let topology = cage.topology();
        let has_inner = (0..topology.vertex_count()).any(|vertex| !topology.is_boundary_vertex(vertex));
        if rule == BoundaryRule::Discard && !has_inner {
            return Err(MeshError::EmptyResult.into());
        }
        Ok(Self { cage, rule, level, display })
    }

    /// The mesh as the window shows it first: one level if it may have that many faces, standard rule at the boundary.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn from_cage(cage: PolygonMesh, display: MeshDisplay) -> Result<Self, EditError> {
        let rule = BoundaryRule::Standard { fix_corners: false };
        let level = usize::from(face_count(&cage, 1) <= Self::MAX_FACES);
        Self::new(cage, rule, level, display)
    }

    /// The control mesh.
    pub fn cage(&self) -> &PolygonMesh {
        &self.cage
    }

    /// The rule at the boundary.
    pub fn rule(&self) -> BoundaryRule {
        self.rule
    }

    /// How often the mesh is refined.
    pub fn level(&self) -> usize {
        self.level
    }

    /// How it is shown.
    pub fn display(&self) -> &MeshDisplay {
        &self.display
    }

    /// The highest level with no more faces than [`Self::MAX_FACES`].
    pub fn highest_level(&self) -> usize {
        let fits = |&level: &usize| face_count(&self.cage, level) <= Self::MAX_FACES;
        (0..=Self::MAX_LEVEL).rev().find(fits).unwrap_or(0)
    }

    /// Number of faces after [`Self::level`] steps; fewer are left if the boundary is discarded.
    pub fn refined_face_count(&self) -> usize {
        face_count(&self.cage, self.level)
    }

    /// All steps up to [`Self::level`].
    ///
    /// # Errors
    ///
    /// Those of [`PolygonMesh::subdivide`].
    pub fn steps(&self) -> Result<Vec<SubdivisionStep>, MeshError> {
        self.cage.subdivide_levels(self.level, self.rule)
    }

    /// As [`Self::steps`] with a watcher.
    ///
    /// # Errors
    ///
    /// As [`Self::steps`]; `Stopped`.
    pub fn steps_watched(&self, watcher: &dyn Watcher) -> Result<Vec<SubdivisionStep>, MeshError> {
        self.cage.subdivide_levels_watched(self.level, self.rule, watcher)
    }

    /// Whether boundary vertices with a single face stay where they are.
    pub fn fixes_corners(&self) -> bool {
        self.rule == BoundaryRule::Standard { fix_corners: true }
    }

    /// Another control mesh; everything else stays.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_cage(&self, cage: PolygonMesh) -> Result<Self, EditError> {
        Self::new(cage, self.rule, self.level, self.display.clone())
    }

    /// Another rule at the boundary.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_rule(&self, rule: BoundaryRule) -> Result<Self, EditError> {
        Self::new(self.cage.clone(), rule, self.level, self.display.clone())
    }

    /// Another number of steps.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_level(&self, level: usize) -> Result<Self, EditError> {
        Self::new(self.cage.clone(), self.rule, level, self.display.clone())
    }

    /// The same mesh, shown differently.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_display(&self, display: MeshDisplay) -> Result<Self, EditError> {
        Self::new(self.cage.clone(), self.rule, self.level, display)
    }

    /// Some vertices of the control mesh moved by the same vector; numbers of vertices that are not there are ignored.
    ///
    /// # Errors
    ///
    /// `NonFinite` if a coordinate overflows.
    pub fn moved(&self, vertices: &BTreeSet<usize>, delta: DVec3) -> Result<Self, EditError> {
        let count = self.cage.positions().len();
        let mut cage = self.cage.clone();
        for &vertex in vertices.iter().filter(|&&vertex| vertex < count) {
            let position = cage.positions()[vertex] + delta;
            cage = cage.with_position(vertex, position)?;
        }
        self.with_cage(cage)
    }

    /// The control mesh without some vertices: the faces around an inner one become one polygon, those at a boundary vertex go.
    ///
    /// # Errors
    ///
    /// Those of [`PolygonMesh::without_vertices`]; as [`Self::new`].
    pub fn without_vertices(&self, vertices: &BTreeSet<usize>) -> Result<Self, EditError> {
        self.with_cage(self.cage.without_vertices(&vertices.iter().copied().collect::<Vec<_>>())?)
    }

    /// The control mesh without one of its faces.
    ///
    /// # Errors
    ///
    /// Those of [`PolygonMesh::without_faces`]; as [`Self::new`].
    pub fn without_face(&self, face: usize) -> Result<Self, EditError> {
        self.with_cage(self.cage.without_faces(&[face])?)
    }

    /// An edge of the control mesh made as sharp as `sharpness`; 0 makes it smooth.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such edge; `NonFinite`, `OutsideInterval` for the sharpness.
    pub fn with_sharpness(&self, ends: [u32; 2], sharpness: f64) -> Result<Self, EditError> {
        self.with_cage(self.cage.clone().with_sharpness(ends, sharpness)?)
    }
}

/// Number of faces after `level` steps if the boundary is kept.
fn face_count(mesh: &PolygonMesh, level: usize) -> usize {
    let topology = mesh.topology();
    match level.checked_sub(1) {
        None => topology.face_count(),
        Some(more) => topology.corner_count().saturating_mul(4_usize.saturating_pow(more.min(30) as u32)),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::mesh_shapes;

    fn cube() -> MeshObject {
        MeshObject::from_cage(mesh_shapes::cube(), MeshDisplay::default()).unwrap()
    }

    #[test]
    fn the_number_of_faces_is_foretold() {
        for (_, cage) in mesh_shapes::named_shapes() {
            for level in 0..3 {
                let mesh = MeshObject::from_cage(cage.clone(), MeshDisplay::default()).unwrap();
                let mesh = mesh.with_level(level).unwrap();
                let found =
                    mesh.steps().unwrap().last().map_or(mesh.cage().counts()[2], |s| s.mesh.counts()[2]);
                assert_eq!(found as usize, mesh.refined_face_count(), "level {level}");
            }
        }
    }

    #[test]
    fn levels_that_make_too_many_faces_are_refused() {
        assert_eq!(cube().highest_level(), 6, "a cube");
        assert_eq!(cube().with_level(7).unwrap_err().name(), "BadDisplay", "level 7");
        let sheet = mesh_shapes::open_sheet(200, 200).unwrap();
        let sheet = MeshObject::from_cage(sheet, MeshDisplay::default()).unwrap();
        assert_eq!(sheet.highest_level(), 1, "a large sheet");
        assert_eq!(sheet.with_level(2).unwrap_err().name(), "TooMany", "40,000 faces twice refined");
    }

    #[test]
    fn discarding_the_boundary_needs_an_inner_vertex() {
        let one =
            MeshObject::from_cage(mesh_shapes::open_sheet(1, 1).unwrap(), MeshDisplay::default()).unwrap();
        assert_eq!(
            one.with_rule(BoundaryRule::Discard).unwrap_err().name(),
            "EmptyResult",
            "a single square"
        );
        assert!(cube().with_rule(BoundaryRule::Discard).is_ok(), "a closed mesh has no boundary");
    }

    #[test]
    fn a_sharp_edge_keeps_its_edge_point_in_the_middle() {
        let mesh = cube().with_sharpness([4, 5], f64::INFINITY).unwrap();
        let edge = mesh.cage().topology().edge_between(4, 5).unwrap();
        let refined = &mesh.steps().unwrap()[0].mesh;
        assert_eq!(refined.positions()[8 + edge], DVec3::new(0.0, -1.0, 1.0), "the edge point");
        assert_eq!(mesh.with_sharpness([4, 5], f64::NAN).unwrap_err().name(), "NonFinite", "no number");
        assert_eq!(mesh.with_sharpness([0, 6], 1.0).unwrap_err().name(), "IndexOutOfRange", "no edge");
    }
}
