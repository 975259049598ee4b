//! Points, normals and bicubic patches of the limit surface. Course: section 8.3.

use glam::DVec3;

use crate::core::surface::catmull_clark::ring::RingLimit;
use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::polygon_mesh::PolygonMesh;

/// Cross products up to this part of the product of the lengths have no direction.
const PARALLEL: f64 = 1e-12;

impl PolygonMesh {
    /// Position and tangents of the limit of a vertex, with the standard rule at boundaries.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex.
    pub fn limit(&self, vertex: usize, fix_corners: bool) -> Result<RingLimit, MeshError> {
        Ok(self.vertex_ring(vertex, fix_corners)?.limit())
    }

    /// The unit normal of the limit surface at a vertex, on the side of `face` if creases meet there.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex or it is not one of the face's; `Degenerate` if the tangents are parallel.
    pub fn limit_normal(
        &self,
        vertex: usize,
        face: Option<usize>,
        fix_corners: bool,
    ) -> Result<DVec3, MeshError> {
        let limit = self.limit(vertex, fix_corners)?;
        let ring = self.topology.ring(vertex);
        let place = match face {
            None => limit.sectors[0].first,
            Some(face) => {
                let missing =
                    MeshError::NoSuchElement { what: "face at the vertex with number", index: face };
                ring.faces.iter().position(|&other| other as usize == face).ok_or(missing)?
            }
        };
        let m = ring.faces.len();
        let contains = |first: usize, count: usize| (place + m - first) % m < count;
        let sector = limit.sectors.iter().find(|sector| contains(sector.first, sector.count));
        let degenerate = MeshError::Degenerate { what: "the limit normal", vertex };
        let [a, b] = sector.ok_or(degenerate.clone())?.tangents;
        let normal = a.cross(b);
        if normal.length() > PARALLEL * a.length() * b.length() {
            Ok(normal.normalize())
        } else {
            Err(degenerate)
        }
    }

    /// The limits of all vertices.
    pub fn limit_positions(&self, fix_corners: bool) -> Vec<DVec3> {
        (0..self.positions.len())
            .filter_map(|vertex| self.vertex_ring(vertex, fix_corners).ok())
            .map(|ring| ring.limit_position())
            .collect()
    }

    /// The normals of the limit surface at all vertices, zero where there is none; at creases on the side of the vertex's first face.
    pub fn limit_normals(&self, fix_corners: bool) -> Vec<DVec3> {
        let normal = |vertex| self.limit_normal(vertex, None, fix_corners).unwrap_or(DVec3::ZERO);
        (0..self.positions.len()).map(normal).collect()
    }

    /// The control points of the uniform bicubic B-spline patch that is the limit of a face, row by row.
    ///
    /// Corner 0 of the face has the indices (1, 1), corner 1 (2, 1), corner 2 (2, 2). `None` unless all faces around are quadrilaterals,
    /// all four corners are inner vertices with four faces, and no edge at them is sharp.
    pub fn bspline_patch(&self, face: usize) -> Option<[[DVec3; 4]; 4]> {
        let topology = &self.topology;
        if face >= topology.face_count() || topology.face(face).len() != 4 {
            return None;
        }
        let mut net = [[DVec3::ZERO; 4]; 4];
        // Place of a corner, and the steps in the net along its two edges.
        let corners = [
            ([1, 1], [1, 0], [0, 1]),
            ([2, 1], [0, 1], [-1, 0]),
            ([2, 2], [-1, 0], [0, -1]),
            ([1, 2], [0, -1], [1, 0]),
        ];
        for (corner, (place, along, back)) in topology.face_range(face).zip(corners) {
            let vertex = topology.corner_vertices[corner] as usize;
            let ring = topology.ring_from(corner);
            let smooth = ring.edges.iter().all(|&edge| self.sharpness(edge as usize) == 0.0);
            let quads = ring.faces.iter().all(|&face| topology.face(face as usize).len() == 4);
            if !ring.closed || ring.faces.len() != 4 || !smooth || !quads || self.is_fixed(vertex, false) {
                return None;
            }
            let mut put = |shift: [i32; 2], vertex: u32| {
                let [i, j] = [0, 1].map(|axis| (place[axis] + shift[axis]) as usize);
                net[i][j] = self.positions[vertex as usize];
            };
            let opposite = topology.face(ring.faces[2] as usize);
            let at = opposite.iter().position(|&other| other as usize == vertex)?;
            put([0, 0], vertex as u32);
            put(along.map(|step: i32| -step), ring.neighbours[2]);
            put(back.map(|step: i32| -step), ring.neighbours[3]);
            put([-along[0] - back[0], -along[1] - back[1]], opposite[(at + 2) % 4]);
        }
        Some(net)
    }
}
