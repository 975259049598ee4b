//! W9: Catmull-Clark of the cube by 8 levels and of a torus of 32 × 32 quadrilaterals by 5.

#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

mod report;

use spline_lab::core::surface::catmull_clark::{BoundaryRule, RefinedMesh};
use spline_lab::core::surface::{PolygonMesh, mesh_shapes};

const RULE: BoundaryRule = BoundaryRule::Standard { fix_corners: false };

fn main() {
    let cases = [("cube8", mesh_shapes::cube(), 8), ("torus5", mesh_shapes::torus_grid(32, 32).unwrap(), 5)];
    for (tag, mesh, levels) in cases {
        let faces = mesh.topology().face_count() << (2 * levels);
        let positions = mesh.positions().to_vec();
        let loops: Vec<Vec<u32>> = mesh.topology().faces().map(<[u32]>::to_vec).collect();
        let mut refined = RefinedMesh::default();
        let how =
            "connectivity of the cage, all levels, last level faces and f64 positions; buffers used again";
        report::measure(&format!("W9-{tag}-total"), faces, how, || {
            let mesh = PolygonMesh::new(positions.clone(), &loops).unwrap();
            mesh.refine_into(levels, RULE, &mut refined).unwrap();
        });
        report::measure(&format!("W9-{tag}-total"), faces, "the same, all memory allocated anew", || {
            let mut refined = RefinedMesh::default();
            mesh.refine_into(levels, RULE, &mut refined).unwrap();
            std::hint::black_box(&refined);
        });
        let mut full = Vec::new();
        report::measure(
            &format!("W9-{tag}-topology"),
            faces,
            "full adjacency on every level; buffers used again",
            || {
                mesh.refine_topology_into(levels, &mut full).unwrap();
            },
        );
        let mean = refined.positions.iter().map(|p| p.length_squared()).sum::<f64>()
            / refined.positions.len() as f64;
        let (faces, vertices) = (refined.quads.len(), refined.positions.len());
        report::check(
            &format!("W9-{tag}"),
            &format!("\"faces\": {faces}, \"verts\": {vertices}, \"mean_r2\": {mean}"),
        );
    }
}
