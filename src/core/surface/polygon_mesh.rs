//! Polygon meshes: positions, connectivity, creases and fixed vertices. Course: section 8.3.

use glam::DVec3;

use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::mesh_topology::MeshTopology;

/// From this sharpness on an edge counts as infinitely sharp.
pub const INFINITE_SHARPNESS: f64 = 10.0;

/// An edge with a positive sharpness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// Number of the edge.
    pub edge: u32,
    /// Its sharpness; infinite from [`INFINITE_SHARPNESS`] on.
    pub sharpness: f64,
}

/// An orientable manifold mesh in space; faces run counterclockwise seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    pub(super) positions: Vec<DVec3>,
    pub(super) topology: MeshTopology,
    /// Inner edges with positive sharpness, by increasing number.
    pub(super) creases: Vec<Crease>,
    /// Vertices that subdivision does not move, increasing.
    pub(super) fixed: Vec<u32>,
}

impl PolygonMesh {
    /// The mesh with the given vertices and faces, loops of vertex numbers.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the vertex; the first of [`mesh_faults`](crate::core::surface::mesh_faults).
    pub fn new(positions: Vec<DVec3>, faces: &[Vec<u32>]) -> Result<Self, MeshError> {
        check_positions(&positions)?;
        let topology = MeshTopology::new(positions.len(), faces)?;
        Ok(Self { positions, topology, creases: Vec::new(), fixed: Vec::new() })
    }

    /// The same mesh with the edge between two vertices as sharp as `sharpness`; 0 makes it smooth again.
    ///
    /// Boundary edges are infinitely sharp whatever is given.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such edge, `NonFinite` for NaN, `OutsideInterval` for a negative sharpness.
    pub fn with_sharpness(mut self, ends: [u32; 2], sharpness: f64) -> Result<Self, MeshError> {
        let edge = self
            .topology
            .edge_between(ends[0], ends[1])
            .ok_or(MeshError::NoSuchElement { what: "edge at vertex", index: ends[0] as usize })?;
        if sharpness.is_nan() {
            return Err(MeshError::NonFinite {
                what: "the sharpness of edge",
                index: edge,
                value: sharpness,
            });
        }
        if sharpness < 0.0 {
            return Err(MeshError::OutsideInterval { value: sharpness });
        }
        let place = self.creases.partition_point(|crease| (crease.edge as usize) < edge);
        if self.creases.get(place).is_some_and(|crease| crease.edge as usize == edge) {
            self.creases.remove(place);
        }
        if sharpness > 0.0 && self.topology.edge_faces(edge).count() == 2 {
            let sharpness = if sharpness >= INFINITE_SHARPNESS { f64::INFINITY } else { sharpness };
            self.creases.insert(place, Crease { edge: edge as u32, sharpness });
        }
        Ok(self)
    }

    /// The same mesh with a vertex that subdivision does not move.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex.
    pub fn with_fixed_vertex(mut self, vertex: u32) -> Result<Self, MeshError> {
        self.check_vertex(vertex as usize)?;
        if let Err(place) = self.fixed.binary_search(&vertex) {
            self.fixed.insert(place, vertex);
        }
        Ok(self)
    }

    /// The same mesh with one vertex moved.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex, `NonFinite`.
    pub fn with_position(mut self, vertex: usize, position: DVec3) -> Result<Self, MeshError> {
        self.check_vertex(vertex)?;
        self.positions[vertex] = position;
        check_positions(&self.positions[vertex..=vertex])?;
        Ok(self)
    }

    /// The same mesh with every vertex mapped.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the first vertex that is mapped to no point.
    pub fn transformed(mut self, map: impl Fn(DVec3) -> DVec3) -> Result<Self, MeshError> {
        self.positions.iter_mut().for_each(|position| *position = map(*position));
        check_positions(&self.positions)?;
        Ok(self)
    }

    /// The vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The connectivity.
    pub fn topology(&self) -> &MeshTopology {
        &self.topology
    }

    /// The inner edges with positive sharpness, by increasing number.
    pub fn creases(&self) -> &[Crease] {
        &self.creases
    }

    /// The vertices that subdivision does not move.
    pub fn fixed_vertices(&self) -> &[u32] {
        &self.fixed
    }

    /// Sharpness of an edge; infinite at the boundary.
    pub fn sharpness(&self, edge: usize) -> f64 {
        if self.topology.edge_faces(edge).count() == 1 {
            return f64::INFINITY;
        }
        let place = self.creases.binary_search_by_key(&(edge as u32), |crease| crease.edge);
        place.map_or(0.0, |place| self.creases[place].sharpness)
    }

    /// `[V, E, F, V − E + F]`.
    pub fn counts(&self) -> [i64; 4] {
        let topology = &self.topology;
        let [v, e, f] =
            [topology.vertex_count(), topology.edge_count(), topology.face_count()].map(|n| n as i64);
        [v, e, f, v - e + f]
    }

    /// Mean of the vertices of a face.
    pub fn centroid(&self, face: usize) -> DVec3 {
        let corners = self.topology.face(face);
        corners.iter().map(|&v| self.positions[v as usize]).sum::<DVec3>() / corners.len() as f64
    }

    /// The enclosed volume of a closed mesh, positive if the faces run counterclockwise seen from outside.
    ///
    /// Faces that are not plane count as fans of triangles around their centroid.
    ///
    /// # Errors
    ///
    /// `OpenBoundary` with one of its edges.
    pub fn volume(&self) -> Result<f64, MeshError> {
        if let Some(&edge) = self.topology.boundary_edges().first() {
            return Err(MeshError::OpenBoundary { edge: self.topology.edge(edge as usize) });
        }
        let origin = self.positions[0];
        let mut sum = 0.0;
        for (number, face) in self.topology.faces().enumerate() {
            let centre = self.centroid(number) - origin;
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                sum += centre
                    .dot((self.positions[a as usize] - origin).cross(self.positions[b as usize] - origin));
            }
        }
        Ok(sum / 6.0)
    }

    pub(super) fn check_vertex(&self, vertex: usize) -> Result<(), MeshError> {
        if vertex < self.positions.len() {
            Ok(())
        } else {
            Err(MeshError::NoSuchElement { what: "vertex", index: vertex })
        }
    }
}

fn check_positions(positions: &[DVec3]) -> Result<(), MeshError> {
    for (index, position) in positions.iter().enumerate() {
        if let Some(value) = position.to_array().into_iter().find(|value| !value.is_finite()) {
            return Err(MeshError::NonFinite { what: "vertex", index, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::mesh_shapes;

    #[test]
    fn volumes_of_simple_bodies() {
        for (mesh, expected) in [
            (mesh_shapes::cube(), 8.0),
            (mesh_shapes::tetrahedron(), 8.0 / 3.0),
            (mesh_shapes::octahedron(), 4.0 / 3.0),
            (mesh_shapes::l_block(), 24.0),
        ] {
            let error = mesh.volume().unwrap() - expected;
            assert!(error.abs() < 1e-12, "{expected} is off by {error}");
        }
        assert_eq!(
            mesh_shapes::open_sheet(2, 2).unwrap().volume().unwrap_err().name(),
            "OpenBoundary",
            "a sheet"
        );
    }

    #[test]
    fn bad_values_are_named() {
        let cube = mesh_shapes::cube();
        let error = cube.clone().with_sharpness([0, 6], 1.0).unwrap_err();
        assert_eq!(error.name(), "IndexOutOfRange", "a diagonal is no edge");
        assert_eq!(
            cube.clone().with_sharpness([0, 1], -1.0).unwrap_err().name(),
            "OutsideInterval",
            "negative"
        );
        assert_eq!(cube.clone().with_sharpness([0, 1], f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(
            cube.clone().with_fixed_vertex(8).unwrap_err().name(),
            "IndexOutOfRange",
            "eight vertices"
        );
        let error = cube.with_position(2, DVec3::NAN).unwrap_err();
        assert_eq!(error.name(), "NonFinite", "{error}");
        let sharp = mesh_shapes::cube().with_sharpness([1, 0], 2.0).unwrap();
        let edge = sharp.topology().edge_between(0, 1).unwrap();
        assert_eq!(sharp.sharpness(edge), 2.0, "either direction");
        assert!(sharp.with_sharpness([0, 1], 0.0).unwrap().creases().is_empty(), "0 makes it smooth");
    }
}
