//! The faces of a mesh as triangles whose normals respect creases, and its edges as long lines.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::core::surface::PolygonMesh;

/// Corners and triangles of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Corners {
    /// For each corner the vertex it stands at. The first corners are the vertices; more follow where creases divide one.
    pub(super) vertices: Vec<u32>,
    /// Normals of the corners, of any length.
    pub(super) normals: Vec<DVec3>,
    /// Triangles of corners.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The corners of `mesh` with its vertices at `positions`. A vertex where sharp edges meet has a corner for each part between them.
pub(super) fn smooth_corners(mesh: &PolygonMesh, positions: &[DVec3]) -> Corners {
    let topology = mesh.topology();
    let mut corners = Corners { vertices: (0..positions.len() as u32).collect(), ..Corners::default() };
    let mut divided: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let mut ends: Vec<u32> =
        mesh.creases().iter().flat_map(|crease| topology.edge(crease.edge as usize)).collect();
    ends.sort_unstable();
    ends.dedup();
    for vertex in ends {
        let ring = topology.ring(vertex as usize);
        let sharp = |k: usize| mesh.sharpness(ring.edges[k] as usize) > 0.0;
        let count = ring.faces.len();
        // Edge k runs before face k. An open ring begins at the boundary, a closed one is begun at a crease.
        let start = if ring.closed { (0..count).find(|&k| sharp(k)).unwrap_or(0) } else { 0 };
        let mut corner = vertex;
        for step in 1..count {
            let k = (start + step) % count;
            if sharp(k) {
                corner = corners.vertices.len() as u32;
                corners.vertices.push(vertex);
            }
            if corner != vertex {
                divided.insert((ring.faces[k], vertex), corner);
            }
        }
    }
    corners.normals = vec![DVec3::ZERO; corners.vertices.len()];
    let mut loop_of_corners = Vec::new();
    for (number, face) in topology.faces().enumerate() {
        loop_of_corners.clear();
        loop_of_corners.extend(face.iter().map(|&vertex| {
            if divided.is_empty() {
                return vertex;
            }
            divided.get(&(number as u32, vertex)).copied().unwrap_or(vertex)
        }));
        let normal = area_vector(face, positions);
        for &corner in &loop_of_corners {
            corners.normals[corner as usize] += normal;
        }
        fan(&loop_of_corners, positions_of(face, positions), &mut corners.triangles);
    }
    corners
}

/// The corners of `mesh` with one for each corner of each face, so that faces are flat.
pub(super) fn flat_corners(mesh: &PolygonMesh, positions: &[DVec3]) -> Corners {
    let mut corners = Corners::default();
    for face in mesh.topology().faces() {
        let first = corners.vertices.len() as u32;
        corners.vertices.extend_from_slice(face);
        let normal = area_vector(face, positions);
        corners.normals.extend(std::iter::repeat_n(normal, face.len()));
        let numbers: Vec<u32> = (first..first + face.len() as u32).collect();
        fan(&numbers, positions_of(face, positions), &mut corners.triangles);
    }
    corners
}

fn positions_of<'a>(face: &'a [u32], positions: &'a [DVec3]) -> impl Fn(usize) -> DVec3 + 'a {
    |k| positions[face[k] as usize]
}

/// Triangles of a polygon; a quadrilateral is cut along its shorter diagonal.
fn fan(corners: &[u32], position: impl Fn(usize) -> DVec3, triangles: &mut Vec<[u32; 3]>) {
    let count = corners.len();
    let start = usize::from(
        count == 4 && position(1).distance_squared(position(3)) < position(0).distance_squared(position(2)),
    );
    let corner = |k: usize| corners[(start + k) % count];
    triangles.extend((1..count - 1).map(|k| [corner(0), corner(k), corner(k + 1)]));
}

/// Normal of a polygon with the length of its area; zero where it overflows.
pub(super) fn area_vector(face: &[u32], positions: &[DVec3]) -> DVec3 {
    let origin = positions[face[0] as usize];
    let arm = |k: usize| positions[face[k] as usize] - origin;
    let sum = (1..face.len() - 1).map(|k| arm(k).cross(arm(k + 1))).sum::<DVec3>() * 0.5;
    if sum.is_finite() { sum } else { DVec3::ZERO }
}

/// The edges of `mesh` as few lines of vertices: they run straight through inner vertices with four faces.
pub(super) fn edge_lines(mesh: &PolygonMesh) -> Vec<Vec<u32>> {
    let topology = mesh.topology();
    let mut seen = vec![false; topology.edge_count()];
    let mut lines = Vec::new();
    for edge in 0..topology.edge_count() {
        if seen[edge] {
            continue;
        }
        seen[edge] = true;
        let [a, b] = topology.edge(edge);
        let mut line = vec![a, b];
        extend(mesh, edge, &mut line, &mut seen);
        if line.len() == 2 || line[0] != line[line.len() - 1] {
            line.reverse();
            extend(mesh, edge, &mut line, &mut seen);
        }
        lines.push(line);
    }
    lines
}

/// Goes on from the last vertex of `line`, which `edge` leads to.
fn extend(mesh: &PolygonMesh, edge: usize, line: &mut Vec<u32>, seen: &mut [bool]) {
    let topology = mesh.topology();
    let mut edge = edge;
    loop {
        let vertex = line[line.len() - 1] as usize;
        if topology.valence(vertex) != 4 || topology.is_boundary_vertex(vertex) {
            return;
        }
        let ring = topology.ring(vertex);
        let Some(place) = ring.edges.iter().position(|&other| other as usize == edge) else { return };
        let opposite = (place + 2) % 4;
        edge = ring.edges[opposite] as usize;
        if seen[edge] {
            return;
        }
        seen[edge] = true;
        line.push(ring.neighbours[opposite]);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::mesh_shapes;

    #[test]
    fn lines_cover_every_edge_once() {
        for (name, mesh) in mesh_shapes::named_shapes() {
            let mesh = mesh.subdivide(crate::core::surface::catmull_clark::BoundaryRule::Standard {
                fix_corners: false,
            });
            let mesh = mesh.unwrap().mesh;
            let mut edges: Vec<usize> = edge_lines(&mesh)
                .iter()
                .flat_map(|line| line.windows(2))
                .map(|pair| mesh.topology().edge_between(pair[0], pair[1]).unwrap())
                .collect();
            edges.sort_unstable();
            assert_eq!(edges, (0..mesh.topology().edge_count()).collect::<Vec<_>>(), "{name}");
        }
    }

    #[test]
    fn a_crease_all_around_divides_the_normals_of_its_sides() {
        let mut cube = mesh_shapes::cube();
        for ends in [[4, 5], [5, 6], [6, 7], [7, 4]] {
            cube = cube.with_sharpness(ends, f64::INFINITY).unwrap();
        }
        let corners = smooth_corners(&cube, cube.positions());
        assert_eq!(corners.vertices.len(), 12, "four vertices have two corners");
        let top = corners.triangles.iter().filter(|triangle| {
            triangle
                .iter()
                .all(|&corner| cube.positions()[corners.vertices[corner as usize] as usize].z > 0.0)
        });
        for corner in top.flatten() {
            let normal = corners.normals[*corner as usize].normalize();
            assert!((normal - DVec3::Z).length() < 1e-15, "{normal} on the top");
        }
        assert_eq!(
            smooth_corners(&mesh_shapes::cube(), cube.positions()).vertices.len(),
            8,
            "without creases"
        );
    }

    #[test]
    fn flat_faces_have_the_normals_of_a_cube() {
        let cube = mesh_shapes::cube();
        let corners = flat_corners(&cube, cube.positions());
        assert_eq!((corners.vertices.len(), corners.triangles.len()), (24, 12), "corners, triangles");
        for (corner, &vertex) in corners.vertices.iter().enumerate() {
            let normal = corners.normals[corner].normalize();
            assert!((cube.positions()[vertex as usize].dot(normal) - 1.0).abs() < 1e-15, "{normal}");
        }
    }
}
