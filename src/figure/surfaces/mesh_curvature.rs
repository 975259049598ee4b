//! Curvatures of a polygon mesh at its vertices, from angles and edges.
//!
//! `K = (2π − Σ angles)/A` and `2H ν = −Δx` with the cotangent Laplacian, `A` a third of the triangles around (U. Pinkall, K. Polthier,
//! 1993; M. Meyer, M. Desbrun, P. Schröder, A. Barr, 2003). Quadrilaterals count as the mean of both divisions. Boundary vertices and
//! vertices of creases have no curvature: not a number.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::core::surface::PolygonMesh;

/// Gaussian curvature and both principal curvatures, the smaller first.
pub(super) fn curvatures(mesh: &PolygonMesh, positions: &[DVec3]) -> Vec<(f64, [f64; 2])> {
    let mut sums = Sums {
        angles: vec![0.0; positions.len()],
        areas: vec![0.0; positions.len()],
        laplacian: vec![DVec3::ZERO; positions.len()],
        normals: vec![DVec3::ZERO; positions.len()],
    };
    for face in mesh.topology().faces() {
        let count = face.len();
        let halves = if count == 4 { [0, 1].as_slice() } else { &[0] };
        for &start in halves {
            let corner = |k: usize| face[(start + k) % count];
            for k in 1..count - 1 {
                sums.add([corner(0), corner(k), corner(k + 1)], positions, 1.0 / halves.len() as f64);
            }
        }
    }
    let topology = mesh.topology();
    let mut out = vec![false; positions.len()];
    let creases = mesh.creases().iter().map(|crease| crease.edge);
    for edge in topology.boundary_edges().iter().copied().chain(creases) {
        for end in topology.edge(edge as usize) {
            out[end as usize] = true;
        }
    }
    (0..positions.len())
        .map(|vertex| {
            if out[vertex] {
                return (f64::NAN, [f64::NAN; 2]);
            }
            let area = sums.areas[vertex];
            let gaussian = (TAU - sums.angles[vertex]) / area;
            // A curvature is positive where the surface bends towards its normal.
            let mean = 0.5 * sums.laplacian[vertex].dot(sums.normals[vertex].normalize_or_zero()) / area;
            let radius = (mean * mean - gaussian).max(0.0).sqrt();
            (gaussian, [mean - radius, mean + radius])
        })
        .collect()
}

struct Sums {
    angles: Vec<f64>,
    areas: Vec<f64>,
    laplacian: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl Sums {
    fn add(&mut self, corners: [u32; 3], positions: &[DVec3], share: f64) {
        let [a, b, c] = corners.map(|corner| positions[corner as usize]);
        let cross = (b - a).cross(c - a);
        let doubled = cross.length();
        if doubled.is_nan() || doubled <= 0.0 {
            return;
        }
        for k in 0..3 {
            let [here, next, last] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k] as usize);
            let (to_next, to_last) = (positions[next] - positions[here], positions[last] - positions[here]);
            let dot = to_next.dot(to_last);
            self.angles[here] += share * doubled.atan2(dot);
            self.areas[here] += share * doubled / 6.0;
            self.normals[here] += cross * share;
            // Half the cotangent of the angle here weighs the edge opposite.
            let along = (positions[last] - positions[next]) * (0.5 * share * dot / doubled);
            self.laplacian[next] += along;
            self.laplacian[last] -= along;
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::catmull_clark::BoundaryRule;
    use crate::core::surface::mesh_shapes;

    #[test]
    fn total_gaussian_curvature_is_two_pi_times_the_euler_number() {
        let standard = BoundaryRule::Standard { fix_corners: false };
        for (mesh, expected) in [(mesh_shapes::cube(), 2.0), (mesh_shapes::torus_grid(8, 6).unwrap(), 0.0)] {
            let refined = &mesh.subdivide_levels(2, standard).unwrap()[1].mesh;
            let mut sums = vec![0.0; refined.positions().len()];
            for face in refined.topology().faces() {
                for &vertex in face {
                    let ring = super::super::mesh_faces::area_vector(face, refined.positions());
                    sums[vertex as usize] += ring.length();
                }
            }
            // The areas of the sums above are not those of the formula; its own give the angle defects back exactly.
            let defects: f64 = total(refined);
            assert!((defects - TAU * expected).abs() < 1e-9, "{defects}, expected {expected} · 2π");
        }
    }

    fn total(mesh: &PolygonMesh) -> f64 {
        let mut areas = vec![0.0; mesh.positions().len()];
        for face in mesh.topology().faces() {
            for start in 0..2 {
                for k in [1, 2] {
                    let [a, b, c] = [start, start + k, start + k + 1].map(|i| face[i % 4] as usize);
                    let p = mesh.positions();
                    let area = (p[b] - p[a]).cross(p[c] - p[a]).length() / 12.0;
                    [a, b, c].into_iter().for_each(|i| areas[i] += area);
                }
            }
        }
        curvatures(mesh, mesh.positions()).iter().zip(areas).map(|((k, _), area)| k * area).sum()
    }

    #[test]
    fn a_fine_sphere_has_curvature_one_over_the_radius() {
        // A cube grid blown up to a sphere of radius 2; faces run counterclockwise seen from outside, so both curvatures are −1/2.
        let standard = BoundaryRule::Standard { fix_corners: false };
        let grid = &mesh_shapes::cube().subdivide_levels(4, standard).unwrap()[3].mesh;
        let sphere = grid.clone().transformed(|point| point.normalize() * 2.0).unwrap();
        for (gaussian, [low, high]) in curvatures(&sphere, sphere.positions()) {
            assert!((gaussian - 0.25).abs() < 0.05, "K = {gaussian}");
            assert!((low + 0.5).abs() < 0.15 && (high + 0.5).abs() < 0.15, "{low} and {high}");
        }
    }
}
