//! Which vertices of the coarser mesh make a vertex of the finer one, and with which weights.
//!
//! The same rules as the positions: at boundaries and creases, positions are computed with these stencils.

use glam::DVec3;

use crate::core::surface::catmull_clark::masks::{edge_weights, vertex_mask};
use crate::core::surface::catmull_clark::ring::Ring;
use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::polygon_mesh::PolygonMesh;

/// What a vertex of the finer mesh comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    /// It is the image of a vertex.
    Vertex(u32),
    /// It is the point of an edge.
    Edge(u32),
    /// It is the point of a face.
    Face(u32),
}

/// A weighted sum of vertices of the coarser mesh, by increasing vertex; the weights sum to 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stencil {
    /// Pairs of vertex and weight.
    pub weights: Vec<(u32, f64)>,
}

impl Stencil {
    pub(super) fn add(&mut self, vertex: u32, weight: f64) {
        if weight != 0.0 {
            self.weights.push((vertex, weight));
        }
    }

    /// Sorts by vertex and joins what belongs to the same one.
    pub(super) fn joined(mut self) -> Self {
        self.weights.sort_by_key(|entry| entry.0);
        self.weights.dedup_by(|later, earlier| {
            let same = later.0 == earlier.0;
            earlier.1 += if same { later.1 } else { 0.0 };
            same
        });
        self
    }

    /// The weighted sum of `positions`.
    pub fn apply(&self, positions: &[DVec3]) -> DVec3 {
        self.weights.iter().map(|&(vertex, weight)| positions[vertex as usize] * weight).sum()
    }
}

impl PolygonMesh {
    /// Whether subdivision leaves a vertex where it is: one marked as fixed, or with `fix_corners` a boundary vertex with one face.
    pub(super) fn is_fixed(&self, vertex: usize, fix_corners: bool) -> bool {
        self.fixed.binary_search(&(vertex as u32)).is_ok()
            || fix_corners && self.topology.valence(vertex) == 1 && self.topology.is_boundary_vertex(vertex)
    }

    /// The weights of the vertex, edge point or face point `origin` after one step.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex, edge or face.
    pub fn stencil(&self, origin: Origin, fix_corners: bool) -> Result<Stencil, MeshError> {
        let topology = &self.topology;
        let (what, index, count) = match origin {
            Origin::Vertex(v) => ("vertex", v, topology.vertex_count()),
            Origin::Edge(e) => ("edge", e, topology.edge_count()),
            Origin::Face(f) => ("face", f, topology.face_count()),
        };
        let index = index as usize;
        if index >= count {
            return Err(MeshError::NoSuchElement { what, index });
        }
        let mut stencil = Stencil::default();
        match origin {
            Origin::Face(_) => self.add_centroid(&mut stencil, index, 1.0),
            Origin::Edge(_) => {
                let (end, face) = edge_weights(self.sharpness(index));
                topology.edge(index).into_iter().for_each(|vertex| stencil.add(vertex, end));
                topology.edge_faces(index).for_each(|number| self.add_centroid(&mut stencil, number, face));
            }
            Origin::Vertex(vertex) => {
                let ring = topology.ring(index);
                let sharpness: Vec<f64> =
                    ring.edges.iter().map(|&edge| self.sharpness(edge as usize)).collect();
                let mask = vertex_mask(&sharpness, ring.faces.len(), self.is_fixed(index, fix_corners));
                stencil.add(vertex, mask.vertex);
                ring.neighbours.iter().zip(mask.edges).for_each(|(&e, weight)| stencil.add(e, weight));
                let faces = ring.faces.iter().zip(mask.faces);
                faces.for_each(|(&face, weight)| self.add_centroid(&mut stencil, face as usize, weight));
            }
        }
        Ok(stencil.joined())
    }

    fn add_centroid(&self, stencil: &mut Stencil, face: usize, weight: f64) {
        let corners = self.topology.face(face);
        corners.iter().for_each(|&vertex| stencil.add(vertex, weight / corners.len() as f64));
    }

    /// The ring of a vertex: neighbours, centroids and sharpness, counterclockwise.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex.
    pub fn vertex_ring(&self, vertex: usize, fix_corners: bool) -> Result<Ring<DVec3>, MeshError> {
        self.check_vertex(vertex)?;
        let ring = self.topology.ring(vertex);
        Ok(Ring {
            vertex: self.positions[vertex],
            edges: ring.neighbours.iter().map(|&e| self.positions[e as usize]).collect(),
            centroids: ring.faces.iter().map(|&face| self.centroid(face as usize)).collect(),
            sharpness: ring.edges.iter().map(|&edge| self.sharpness(edge as usize)).collect(),
            fixed: self.is_fixed(vertex, fix_corners),
        })
    }
}
