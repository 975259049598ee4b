//! Meshes to start from. Their faces run counterclockwise seen from outside.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::mesh_topology::MAX_FACES;
use crate::core::surface::polygon_mesh::PolygonMesh;

/// The starting shapes without sizes to choose, with the names that the window shows.
pub fn named_shapes() -> [(&'static str, PolygonMesh); 9] {
    let built = |shape: Result<PolygonMesh, MeshError>| shape.expect("the sizes fit");
    [
        ("Cube", cube()),
        ("Creased cube", creased_cube()),
        ("Tetrahedron", tetrahedron()),
        ("Octahedron", octahedron()),
        ("Six-sided prism", built(prism(6))),
        ("Torus grid", built(torus_grid(8, 6))),
        ("L-block", l_block()),
        ("Open sheet", built(open_sheet(4, 3))),
        ("Five-valent fan", built(fan(5))),
    ]
}

/// The cube `[−1, 1]³`.
pub fn cube() -> PolygonMesh {
    let corners =
        [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
    let faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    mesh(&corners, &faces.map(Vec::from))
}

/// The cube with the edges of its top infinitely sharp and those of its bottom of sharpness 1.5.
pub fn creased_cube() -> PolygonMesh {
    let edges = [([4, 5], 10.0), ([5, 6], 10.0), ([6, 7], 10.0), ([7, 4], 10.0)];
    let bottom = [([0, 1], 1.5), ([1, 2], 1.5), ([2, 3], 1.5), ([3, 0], 1.5)];
    edges.into_iter().chain(bottom).fold(cube(), |mesh, (ends, sharpness)| {
        mesh.with_sharpness(ends, sharpness).expect("edges of the cube")
    })
}

/// The regular tetrahedron with the vertices (1, 1, 1), (1, −1, −1), (−1, 1, −1), (−1, −1, 1).
pub fn tetrahedron() -> PolygonMesh {
    let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    mesh(&[[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], &faces.map(Vec::from))
}

/// The octahedron with vertices at distance 1 on the axes.
pub fn octahedron() -> PolygonMesh {
    let corners = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let faces = (0..4).flat_map(|k| [vec![k, (k + 1) % 4, 4], vec![(k + 1) % 4, k, 5]]);
    mesh(&corners, &faces.collect::<Vec<_>>())
}

/// The prism of height 2 over a regular polygon of radius 1 with `sides` sides; its bottom and top are polygons.
///
/// # Errors
///
/// `DegenerateFace` below three sides, `StepLimit` above ten thousand.
pub fn prism(sides: u32) -> Result<PolygonMesh, MeshError> {
    check_size("number of sides", sides as usize, 10_000)?;
    let positions = [-1.0, 1.0].into_iter().flat_map(|z| circle(sides, 1.0, z)).collect();
    let mut faces = vec![(0..sides).rev().collect::<Vec<u32>>(), (sides..2 * sides).collect()];
    faces.extend((0..sides).map(|k| vec![k, (k + 1) % sides, sides + (k + 1) % sides, sides + k]));
    PolygonMesh::new(positions, &faces)
}

/// The torus of radii 1 and 2/5 with `around` times `across` quadrilaterals.
///
/// # Errors
///
/// `DegenerateFace`, `NonManifoldEdge` or `InconsistentOrientation` below three in a direction; `StepLimit` above the limit of faces.
pub fn torus_grid(around: u32, across: u32) -> Result<PolygonMesh, MeshError> {
    check_size("number of faces", (around as usize).saturating_mul(across as usize), MAX_FACES)?;
    let positions = (0..around).flat_map(|i| {
        circle(across, 0.4, 0.0).map(move |tube| {
            let angle = TAU * f64::from(i) / f64::from(around);
            DVec3::new((1.0 + tube.x) * angle.cos(), (1.0 + tube.x) * angle.sin(), tube.y)
        })
    });
    let vertex = |i: u32, j: u32| i % around * across + j % across;
    let face = |i: u32, j: u32| vec![vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
    let faces: Vec<_> = (0..around).flat_map(|i| (0..across).map(move |j| face(i, j))).collect();
    PolygonMesh::new(positions.collect(), &faces)
}

/// Three cubes of side 2 in the form of an L.
pub fn l_block() -> PolygonMesh {
    // Two layers of eight vertices, counterclockwise squares of the L.
    let plan = [[0, 0], [2, 0], [4, 0], [4, 2], [2, 2], [2, 4], [0, 4], [0, 2]];
    let corners: Vec<[i32; 3]> = [0, 2].into_iter().flat_map(|z| plan.map(|[x, y]| [x, y, z])).collect();
    let squares = [[0, 1, 4, 7], [1, 2, 3, 4], [7, 4, 5, 6]];
    let mut faces: Vec<Vec<u32>> = squares.iter().map(|square| square.map(|v| v + 8).to_vec()).collect();
    faces.extend(squares.iter().map(|square| square.iter().rev().copied().collect::<Vec<_>>()));
    faces.extend((0..8).map(|k| vec![k, (k + 1) % 8, (k + 1) % 8 + 8, k + 8]));
    mesh(&corners, &faces)
}

/// The plane sheet `[0, columns] × [0, rows]` of unit squares; the faces look up.
///
/// # Errors
///
/// `Empty` without squares, `StepLimit` above the limit of faces.
pub fn open_sheet(columns: u32, rows: u32) -> Result<PolygonMesh, MeshError> {
    check_size("number of faces", (columns as usize).saturating_mul(rows as usize), MAX_FACES)?;
    if columns == 0 || rows == 0 {
        return Err(MeshError::Empty { what: "faces" });
    }
    let positions =
        (0..=columns).flat_map(|i| (0..=rows).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0)));
    let vertex = |i: u32, j: u32| i * (rows + 1) + j;
    let face = |i: u32, j: u32| vec![vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
    let faces: Vec<_> = (0..columns).flat_map(|i| (0..rows).map(move |j| face(i, j))).collect();
    PolygonMesh::new(positions.collect(), &faces)
}

/// Squares around the apex (0, 0, 1): `e_k` on the unit circle and `f_k` at radius 3/2 between them, both at height 0.
///
/// Vertex 0 is the apex, `1 … valence` are the `e_k`, the rest the `f_k`.
///
/// # Errors
///
/// `DegenerateFace` for one square, `Empty` for none, `StepLimit` above ten thousand.
pub fn fan(valence: u32) -> Result<PolygonMesh, MeshError> {
    check_size("valence", valence as usize, 10_000)?;
    let outer = circle(2 * valence, 1.5, 0.0).skip(1).step_by(2);
    let positions = [DVec3::Z].into_iter().chain(circle(valence, 1.0, 0.0)).chain(outer).collect();
    let face = |k: u32| vec![0, k + 1, valence + k + 1, (k + 1) % valence + 1];
    PolygonMesh::new(positions, &(0..valence).map(face).collect::<Vec<_>>())
}

fn circle(count: u32, radius: f64, z: f64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |k| {
        let angle = TAU * f64::from(k) / f64::from(count);
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    })
}

fn check_size(what: &'static str, value: usize, limit: usize) -> Result<(), MeshError> {
    if value > limit { Err(MeshError::StepLimit { what, value, limit }) } else { Ok(()) }
}

fn mesh(corners: &[[i32; 3]], faces: &[Vec<u32>]) -> PolygonMesh {
    let positions = corners.iter().map(|corner| DVec3::from_array(corner.map(f64::from))).collect();
    PolygonMesh::new(positions, faces).expect("the shape is a manifold mesh")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_have_the_topology_of_their_names() {
        for (name, mesh) in named_shapes() {
            let topology = mesh.topology();
            let open = matches!(name, "Open sheet" | "Five-valent fan");
            assert_eq!(topology.is_closed(), !open, "{name}");
            assert_eq!(topology.genus(), i64::from(name == "Torus grid"), "{name}");
            assert_eq!(topology.component_count(), 1, "{name}");
            assert!(open || mesh.volume().unwrap() > 0.0, "{name}: faces look outwards");
        }
        for small in [prism(2), torus_grid(2, 8), torus_grid(0, 0), open_sheet(0, 3), fan(1)] {
            assert!(small.is_err(), "{small:?} is no mesh");
        }
        assert_eq!(torus_grid(u32::MAX, u32::MAX).unwrap_err().name(), "StepLimit", "too large");
    }
}
