//! One step on connectivity: closed formulas for every index.
//!
//! New vertices are numbered: images of vertices, then edge points, then face points. The quadrilateral of corner `c` (vertex `v` of face `f`
//! between the edges `e` behind it and `e⁻` before it) is number `c` and has the corners `v, e, f, e⁻`. The halves of edge `e` are `2e`
//! (at its first end) and `2e + 1`; the edge from the edge point of `c` to the face point is `2E + c`. Course: section 8.3.

use glam::DVec3;

use crate::core::surface::mesh_topology::{MeshTopology, NONE};
use crate::core::surface::polygon_mesh::PolygonMesh;

/// Writes the corners of the quadrilaterals after one step.
pub(super) fn write_quads(parent: &MeshTopology, quads: &mut Vec<[u32; 4]>) {
    let (vertices, edges) = (parent.vertex_count() as u32, parent.edge_count() as u32);
    quads.resize(parent.corner_vertices.len(), [0; 4]);
    let mut write = |face: usize, corners: std::ops::Range<usize>| {
        let edge_points = &parent.corner_edges[corners.clone()];
        let ends = &parent.corner_vertices[corners.clone()];
        let mut before = edge_points[edge_points.len() - 1];
        for ((quad, &vertex), &edge) in quads[corners].iter_mut().zip(ends).zip(edge_points) {
            *quad = [vertex, vertices + edge, vertices + edges + face as u32, vertices + before];
            before = edge;
        }
    };
    if parent.is_quads() {
        // The constant length of the ranges lets the compiler unroll.
        for face in 0..parent.corner_vertices.len() / 4 {
            write(face, 4 * face..4 * face + 4);
        }
    } else {
        for face in 0..parent.face_count() {
            write(face, parent.face_range(face));
        }
    }
}

/// Writes the whole connectivity after one step into `child`, whose buffers are used again.
pub(super) fn write_topology(parent: &MeshTopology, child: &mut MeshTopology) {
    let (vertices, edges) = (parent.vertex_count() as u32, parent.edge_count() as u32);
    let corners = parent.corner_vertices.len();
    child.face_starts.clear();
    child.corner_vertices.resize(4 * corners, 0);
    child.corner_edges.resize(4 * corners, 0);
    child.edge_corners.resize(2 * edges as usize + corners, [NONE; 2]);
    child.valences.resize(vertices as usize + edges as usize + parent.face_count(), 4);
    child.vertex_corners.resize(child.valences.len(), 0);
    child.valences[..vertices as usize].copy_from_slice(&parent.valences);
    for (start, &corner) in child.vertex_corners.iter_mut().zip(&parent.vertex_corners) {
        *start = 4 * corner;
    }
    let first_inner = 2 * edges;
    for face in 0..parent.face_count() {
        let range = parent.face_range(face);
        let (start, size) = (range.start as u32, range.len() as u32);
        let face_point = vertices as usize + edges as usize + face;
        child.valences[face_point] = size;
        child.vertex_corners[face_point] = 4 * start + 2;
        let mut before_corner = start + size - 1;
        let mut before = parent.corner_edges[before_corner as usize];
        for corner in range.clone() {
            let (vertex, edge) = (parent.corner_vertices[corner], parent.corner_edges[corner]);
            let forwards = parent.edge_corners[edge as usize][0] == corner as u32;
            let before_forwards = parent.edge_corners[before as usize][0] == before_corner;
            let quad = 4 * corner;
            child.corner_vertices[quad..quad + 4].copy_from_slice(&[
                vertex,
                vertices + edge,
                face_point as u32,
                vertices + before,
            ]);
            child.corner_edges[quad..quad + 4].copy_from_slice(&[
                2 * edge + u32::from(!forwards),
                first_inner + corner as u32,
                first_inner + before_corner,
                2 * before + u32::from(before_forwards),
            ]);
            let next = if corner + 1 == range.end { range.start } else { corner + 1 };
            child.edge_corners[first_inner as usize + corner] = [quad as u32 + 1, 4 * next as u32 + 2];
            (before_corner, before) = (corner as u32, edge);
        }
    }
    for (edge, &[first, second]) in parent.edge_corners.iter().enumerate() {
        let after_first = 4 * parent.next(first as usize) as u32 + 3;
        let edge_point = vertices as usize + edge;
        let halves = &mut child.edge_corners[2 * edge..2 * edge + 2];
        if second == NONE {
            halves.copy_from_slice(&[[4 * first, NONE], [after_first, NONE]]);
            child.valences[edge_point] = 2;
            child.vertex_corners[edge_point] = after_first;
        } else {
            let after_second = 4 * parent.next(second as usize) as u32 + 3;
            halves.copy_from_slice(&[[4 * first, after_second], [4 * second, after_first]]);
            child.valences[edge_point] = 4;
            child.vertex_corners[edge_point] = 4 * first + 1;
        }
    }
    child.boundary_edges.clear();
    child.boundary_edges.extend(parent.boundary_edges.iter().flat_map(|&edge| [2 * edge, 2 * edge + 1]));
}

/// Writes the positions after one step by the smooth rules; those at boundaries and creases are not final.
pub(super) fn write_smooth_positions(parent: &PolygonMesh, positions: &mut Vec<DVec3>) {
    let (topology, old) = (&parent.topology, &parent.positions[..]);
    let (vertices, edges) = (topology.vertex_count(), topology.edge_count());
    positions.resize(vertices + edges + topology.face_count(), DVec3::ZERO);
    let (images, rest) = positions.split_at_mut(vertices);
    let (edge_points, face_points) = rest.split_at_mut(edges);
    images.fill(DVec3::ZERO);
    if topology.is_quads() {
        for (point, quad) in face_points.iter_mut().zip(topology.corner_vertices.chunks_exact(4)) {
            let [a, b, c, d] = [quad[0], quad[1], quad[2], quad[3]].map(|v| old[v as usize]);
            *point = (a + b + c + d) * 0.25;
        }
    } else {
        for (face, point) in face_points.iter_mut().enumerate() {
            *point = parent.centroid(face);
        }
    }
    // Every inner edge adds both of its ends and half of each of its faces to its ends: in the end Σ (v + e) + Σ F.
    for (point, &[first, second]) in edge_points.iter_mut().zip(&topology.edge_corners) {
        if second == NONE {
            continue;
        }
        let (first, second) = (first as usize, second as usize);
        let (a, b) = (topology.corner_vertices[first] as usize, topology.corner_vertices[second] as usize);
        let ends = old[a] + old[b];
        let faces = face_points[topology.corner_face(first)] + face_points[topology.corner_face(second)];
        *point = (ends + faces) * 0.25;
        let share = ends + faces * 0.5;
        images[a] += share;
        images[b] += share;
    }
    for ((image, &point), &valence) in images.iter_mut().zip(old).zip(&topology.valences) {
        let scale = if valence == 4 { 0.25 } else { 1.0 / f64::from(valence) };
        *image = (point * (f64::from(valence) - 3.0) + *image * scale) * scale;
    }
}
