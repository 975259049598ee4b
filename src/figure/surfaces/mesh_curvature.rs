//! Curvatures of a polygon mesh at its vertices, from angles and edges.
//!
//! `K = (2π − Σ angles)/A` and `2H ν = −Δx` with the cotangent Laplacian, `A` the area nearest to the vertex (U. Pinkall, K. Polthier,
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
            self.areas[here] +=
                share * area_near([positions[here], positions[next], positions[last]], doubled);
            self.normals[here] += cross * share;
            // Half the cotangent of the angle here weighs the edge opposite.
            let along = (positions[last] - positions[next]) * (0.5 * share * dot / doubled);
            self.laplacian[next] += along;
            self.laplacian[last] -= along;
        }
    }
}

/// The part of a triangle that is nearest to its first corner; in an obtuse one half or a quarter of it instead. `doubled` is twice its area.
fn area_near([a, b, c]: [DVec3; 3], doubled: f64) -> f64 {
    let dots = [(b - a).dot(c - a), (a - b).dot(c - b), (a - c).dot(b - c)];
    if dots[0] < 0.0 {
        return doubled / 4.0;
    }
    if dots[1] < 0.0 || dots[2] < 0.0 {
        return doubled / 8.0;
    }
    // The cotangents at the ends weigh the sides opposite to them.
    (dots[2] * a.distance_squared(b) + dots[1] * a.distance_squared(c)) / (8.0 * doubled)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::catmull_clark::BoundaryRule;
    use crate::core::surface::mesh_shapes;

    #[test]
    fn the_nearest_areas_of_the_corners_make_up_the_triangle() {
        for c in [DVec3::new(0.3, 0.9, 0.2), DVec3::new(-0.6, 0.4, 0.0), DVec3::new(0.5, 0.1, 0.0)] {
            let corners = [DVec3::ZERO, DVec3::X, c];
            let doubled = DVec3::X.cross(c).length();
            let parts: f64 =
                (0..3).map(|k| area_near([0, 1, 2].map(|i| corners[(k + i) % 3]), doubled)).sum();
            assert!((parts - 0.5 * doubled).abs() < 1e-15, "{parts}, not {}", 0.5 * doubled);
        }
    }

    #[test]
    fn a_fine_sphere_has_curvature_one_over_the_radius() {
        // A cube grid blown up to a sphere of radius 2; faces run counterclockwise seen from outside, so both curvatures are −1/2.
        let standard = BoundaryRule::Standard { fix_corners: false };
        let grid = &mesh_shapes::cube().subdivide_levels(4, standard).unwrap()[3].mesh;
        let sphere = grid.clone().transformed(|point| point.normalize() * 2.0).unwrap();
        // Beside vertices with three faces the numbers stay rough however fine the mesh is.
        let found = curvatures(&sphere, sphere.positions());
        let count = found.len() as f64;
        let mean_of = |part: fn(&(f64, [f64; 2])) -> f64| found.iter().map(part).sum::<f64>() / count;
        let [gaussian, mean] = [mean_of(|k| k.0), mean_of(|k| 0.5 * (k.1[0] + k.1[1]))];
        assert!((gaussian - 0.25).abs() < 0.005, "K = {gaussian}");
        assert!((mean + 0.5).abs() < 0.01, "H = {mean}");
        let far = found.iter().filter(|k| (k.0 - 0.25).abs() > 0.03).count() as f64;
        assert!(far < 0.05 * count, "{far} of {count} are far off");
    }
}
