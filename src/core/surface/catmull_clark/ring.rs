//! The surroundings of one vertex under subdivision: the new ones depend on nothing but the old ones.
//!
//! The ring lists neighbours `e_k` and face centroids `F_k` counterclockwise, `F_k` between `e_k` and `e_{k+1}`; an open ring starts and
//! ends at the boundary. Faces may have any number of vertices. Course: section 8.3.

use glam::DVec3;

use crate::core::point::Point;
use crate::core::surface::catmull_clark::masks::{
    VertexKind, child_sharpness, crease_tangent, edge_weights, limit_weights, tangent_weights, vertex_kind,
    vertex_mask,
};

/// Steps after which the ring of a dart is taken for its limit; it shrinks by at least 0.7 per step for valences up to 12.
const DART_STEPS: usize = 120;

/// Part of its first width at which the ring of a dart shows the tangent plane.
const DART_WIDTH: f64 = 1e-5;

/// A vertex with its neighbours and the centroids of its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring<P> {
    /// The vertex.
    pub vertex: P,
    /// The neighbours; one more than faces if the ring is open.
    pub edges: Vec<P>,
    /// The centroids of the faces.
    pub centroids: Vec<P>,
    /// The sharpness of the edges; boundary edges are infinitely sharp.
    pub sharpness: Vec<f64>,
    /// Whether the vertex never moves.
    pub fixed: bool,
}

/// The limit of a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct RingLimit {
    /// The point of the limit surface.
    pub position: DVec3,
    /// One entry for each part between creases; one if there is no crease.
    pub sectors: Vec<RingSector>,
}

/// The faces between two creases, or all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct RingSector {
    /// Index of the first face in the ring; the others follow counterclockwise.
    pub first: usize,
    /// Number of faces.
    pub count: usize,
    /// Two tangents; their cross product points outwards.
    pub tangents: [DVec3; 2],
    /// Whether the masks need not span a tangent plane: five or more faces beside a crease, two or more at a corner, a dart.
    pub irregular: bool,
}

impl<P: Point> Ring<P> {
    /// Whether the faces surround the vertex.
    pub fn is_closed(&self) -> bool {
        self.edges.len() == self.centroids.len()
    }

    /// The ring after one step; its faces are quadrilaterals.
    pub fn step(&self) -> Self {
        let (m, count) = (self.centroids.len(), self.edges.len());
        let mask = vertex_mask(&self.sharpness, m, self.fixed);
        let weighted = |points: &[P], weights: &[f64]| {
            points.iter().zip(weights).fold(P::ZERO, |sum, (&point, &weight)| sum + point * weight)
        };
        let vertex = self.vertex * mask.vertex
            + weighted(&self.edges, &mask.edges)
            + weighted(&self.centroids, &mask.faces);
        let edges: Vec<P> = (0..count)
            .map(|k| {
                let (end, face) = edge_weights(self.sharpness[k]);
                let ends = (self.vertex + self.edges[k]) * end;
                // A boundary edge is sharp: what would stand for the missing face has the weight 0.
                ends + (self.centroids[k % m] + self.centroids[(k + m - 1) % m]) * face
            })
            .collect();
        let centroids =
            (0..m).map(|k| (vertex + edges[k] + self.centroids[k] + edges[(k + 1) % count]) * 0.25).collect();
        let sharpness = self.sharpness.iter().map(|&s| child_sharpness(s)).collect();
        Self { vertex, edges, centroids, sharpness, fixed: self.fixed }
    }

    /// Whether an edge is neither smooth nor infinitely sharp.
    fn is_semi_sharp(&self) -> bool {
        self.sharpness.iter().any(|&s| s > 0.0 && s.is_finite())
    }

    /// The vertex opposite to this one in face `k`, a quadrilateral.
    fn opposite(&self, k: usize) -> P {
        let next = (k + 1) % self.edges.len();
        self.centroids[k] * 4.0 - self.vertex - self.edges[k] - self.edges[next]
    }

    /// Numbers of the infinitely sharp edges.
    fn sharp_edges(&self) -> Vec<usize> {
        (0..self.edges.len()).filter(|&k| self.sharpness[k] > 0.0).collect()
    }

    /// The ring after all steps in which some edge is semi-sharp, and at least one.
    ///
    /// One step makes all faces quadrilaterals, which the limit masks need; it does not change the limit.
    fn settled(&self) -> Self {
        let mut ring = self.step();
        while ring.is_semi_sharp() {
            ring = ring.step();
        }
        ring
    }

    /// The point of the limit surface.
    pub fn limit_position(&self) -> P {
        let mut ring = self.settled();
        match vertex_kind(ring.sharpness.iter().copied(), ring.fixed) {
            VertexKind::Corner => ring.vertex,
            VertexKind::Crease([a, b]) => (ring.edges[a] + ring.vertex * 4.0 + ring.edges[b]) * (1.0 / 6.0),
            VertexKind::Smooth if ring.sharp_edges().is_empty() => {
                let m = ring.centroids.len();
                let (v, e, f) = limit_weights(m);
                (0..m).fold(ring.vertex * v, |sum, k| sum + ring.edges[k] * e + ring.opposite(k) * f)
            }
            VertexKind::Smooth => {
                for _ in 0..DART_STEPS {
                    ring = ring.step();
                }
                ring.vertex
            }
        }
    }
}

impl Ring<DVec3> {
    /// Position and tangents of the limit surface.
    pub fn limit(&self) -> RingLimit {
        let mut ring = self.settled();
        let position = self.limit_position();
        let (m, sharp) = (ring.centroids.len(), ring.sharp_edges());
        let kind = vertex_kind(ring.sharpness.iter().copied(), ring.fixed);
        if kind == VertexKind::Smooth || sharp.is_empty() {
            let dart = !sharp.is_empty();
            let width = |ring: &Self| ring.edges.iter().map(|e| e.distance(ring.vertex)).fold(0.0, f64::max);
            let start = width(&ring);
            // The plane of a dart shows in a small ring; the vertex of a fixed ring without sharp edges is a corner of all its faces.
            for _ in 0..DART_STEPS {
                if !dart || width(&ring) < DART_WIDTH * start {
                    break;
                }
                ring = ring.step();
            }
            let mut tangents = [DVec3::ZERO; 2];
            for k in 0..m {
                let weights = tangent_weights(m, k);
                for (t, tangent) in tangents.iter_mut().enumerate() {
                    *tangent += ring.edges[k] * weights[0][t] + ring.opposite(k) * weights[1][t];
                }
            }
            let irregular = dart || ring.fixed;
            return RingLimit {
                position,
                sectors: vec![RingSector { first: 0, count: m, tangents, irregular }],
            };
        }
        let mut sectors = Vec::new();
        for (i, &first) in sharp.iter().enumerate() {
            let count = match sharp.get(i + 1) {
                Some(next) => next - first,
                None if ring.is_closed() => m - first + sharp[0],
                None => break,
            };
            let crease = matches!(kind, VertexKind::Crease(_));
            let tangents =
                if crease { ring.crease_tangents(first, count) } else { ring.corner_tangents(first, count) };
            let irregular = count >= if crease { 5 } else { 2 };
            sectors.push(RingSector { first, count, tangents, irregular });
        }
        RingLimit { position, sectors }
    }

    fn crease_tangents(&self, first: usize, count: usize) -> [DVec3; 2] {
        let edge = |i: usize| self.edges[(first + i) % self.edges.len()];
        let (a, b) = (edge(0), edge(count));
        if count == 1 {
            return [a - b, a + b - self.vertex * 2.0];
        }
        let weights = crease_tangent(count);
        let sine = |i: usize| (std::f64::consts::PI * i as f64 / count as f64).sin();
        let mut across = self.vertex * weights.vertex + (a + b) * weights.along;
        for i in 0..count {
            let face = (first + i) % self.centroids.len();
            across += edge(i) * sine(i) + self.opposite(face) * (weights.opposite * (sine(i) + sine(i + 1)));
        }
        [a - b, across]
    }

    /// Tangents at a corner; with several faces two that span the mean plane of their angles.
    fn corner_tangents(&self, first: usize, count: usize) -> [DVec3; 2] {
        let arm = |i: usize| self.edges[(first + i) % self.edges.len()] - self.vertex;
        if count == 1 {
            return [arm(0), arm(1)];
        }
        let normal = (0..count).map(|i| arm(i).cross(arm(i + 1))).sum::<DVec3>().normalize_or_zero();
        let one = arm(0) - normal * arm(0).dot(normal);
        [one, normal.cross(one)]
    }
}

/// The matrix of one step on `(v, e_0 … e_{m−1}, f_0 … f_{m−1})` around a smooth vertex among quadrilaterals, by rows; `m ≥ 1`.
pub fn local_matrix(m: usize) -> Vec<Vec<f64>> {
    let m = m.max(1);
    let size = 2 * m + 1;
    let mut matrix = vec![vec![0.0; size]; size];
    for column in 0..size {
        let unit = |index: usize| f64::from(u8::from(index == column));
        let edges: Vec<f64> = (0..m).map(|k| unit(1 + k)).collect();
        let centroids =
            (0..m).map(|k| (unit(0) + edges[k] + edges[(k + 1) % m] + unit(1 + m + k)) * 0.25).collect();
        let ring = Ring { vertex: unit(0), edges, centroids, sharpness: vec![0.0; m], fixed: false };
        let next = ring.step();
        // The old centroids are the new opposite vertices.
        let entries = [next.vertex].into_iter().chain(next.edges).chain(ring.centroids);
        for (row, entry) in entries.enumerate() {
            matrix[row][column] = entry;
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::catmull_clark::masks::subdominant_eigenvalue;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn limit_and_tangent_masks_are_left_eigenvectors_of_the_local_matrix() {
        for m in 3..=12 {
            let matrix = local_matrix(m);
            let apply = |row: &[f64]| -> Vec<f64> {
                (0..row.len()).map(|j| row.iter().zip(&matrix).map(|(a, line)| a * line[j]).sum()).collect()
            };
            let (v, e, f) = limit_weights(m);
            let position = [vec![v], vec![e; m], vec![f; m]].concat();
            let (lambda, _) = subdominant_eigenvalue(TAU / m as f64);
            let tangent = |t: usize| -> Vec<f64> {
                let weights = |class: usize| (0..m).map(move |k| tangent_weights(m, k)[class][t]);
                [0.0].into_iter().chain(weights(0)).chain(weights(1)).collect()
            };
            for (row, eigenvalue) in [(position, 1.0), (tangent(0), lambda), (tangent(1), lambda)] {
                for (image, entry) in apply(&row).iter().zip(&row) {
                    assert!(
                        (image - eigenvalue * entry).abs() < 1e-13,
                        "valence {m}, eigenvalue {eigenvalue}"
                    );
                }
            }
        }
    }

    fn open_ring(k: usize) -> Ring<DVec3> {
        let point = |radius: f64, i: f64| {
            let angle = PI * i / k as f64;
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.3 * (i * 1.7).sin())
        };
        let edges: Vec<DVec3> = (0..=k).map(|i| point(1.0, i as f64)).collect();
        let centroids = (0..k).map(|i| point(0.8, i as f64 + 0.5)).collect();
        let mut sharpness = vec![0.0; k + 1];
        (sharpness[0], sharpness[k]) = (f64::INFINITY, f64::INFINITY);
        Ring { vertex: DVec3::new(0.1, -0.2, 0.4), edges, centroids, sharpness, fixed: false }
    }

    #[test]
    fn the_tangent_across_a_boundary_shrinks_with_its_eigenvalue() {
        for k in 2..=6 {
            let ring = open_ring(k).step();
            let next = ring.step();
            let (before, after) = (ring.crease_tangents(0, k)[1], next.crease_tangents(0, k)[1]);
            let lambda = crease_tangent(k).eigenvalue;
            assert!((before * lambda - after).length() < 1e-13, "{k} faces: {before} to {after}");
        }
    }

    #[test]
    fn limits_do_not_change_under_a_step() {
        let mut rings: Vec<Ring<DVec3>> = (1..=6).map(open_ring).collect();
        let closed = |sharpness: Vec<f64>| {
            let mut ring = open_ring(5);
            ring.edges.pop();
            Ring { sharpness, ..ring }
        };
        rings.extend([
            closed(vec![0.0; 5]),
            closed(vec![2.5, 0.0, 0.3, 0.0, 1.0]),
            closed(vec![f64::INFINITY, 0.0, 0.0, 0.0, 0.0]),
            closed(vec![f64::INFINITY, 0.0, f64::INFINITY, 0.0, 0.7]),
            closed(vec![f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0, 0.0]),
        ]);
        for ring in rings {
            let (limit, next) = (ring.limit(), ring.step().limit());
            assert!(limit.position.distance(next.position) < 1e-13, "{ring:?}");
            let mut fine = ring.clone();
            for _ in 0..60 {
                fine = fine.step();
            }
            assert!(limit.position.distance(fine.vertex) < 1e-6, "60 steps of {ring:?}");
            for (a, b) in limit.sectors.iter().zip(&next.sectors).filter(|(a, _)| !a.irregular) {
                let [a, b] = [a, b].map(|s| s.tangents[0].cross(s.tangents[1]).normalize());
                assert!(a.distance(b) < 1e-12, "normals {a} and {b}");
            }
        }
    }
}
