//! Meshes without some of their vertices or faces. Course: section 8.3.

use std::collections::BTreeMap;

use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::mesh_topology::NONE;
use crate::core::surface::polygon_mesh::{Crease, PolygonMesh};

/// Faces that grow together, as a forest: every face names one that it belongs to.
struct Regions(Vec<u32>);

impl Regions {
    fn of(&mut self, face: u32) -> u32 {
        let mut root = face;
        while self.0[root as usize] != root {
            // Half of the way is cut off for the next who asks.
            self.0[root as usize] = self.0[self.0[root as usize] as usize];
            root = self.0[root as usize];
        }
        root
    }
}

impl PolygonMesh {
    /// The same mesh without some vertices. The faces around an inner one become a single polygon, those at a boundary vertex go.
    ///
    /// What stays keeps its order, and edges and vertices that stay are as sharp and as fixed as before; vertices that are left without a
    /// face go too.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such vertex; `DegenerateFace` with a vertex whose faces do not make one polygon; `Empty` if no face is
    /// left; else what [`Self::new`] finds wrong with the rest.
    pub fn without_vertices(&self, vertices: &[usize]) -> Result<Self, MeshError> {
        let topology = self.topology();
        let mut regions = Regions((0..topology.face_count() as u32).collect());
        let mut gone = vec![false; topology.face_count()];
        // For each region of more than one face a vertex that is deleted inside it.
        let mut inside = BTreeMap::new();
        for &vertex in vertices {
            self.check_vertex(vertex)?;
            let ring = topology.ring(vertex);
            if ring.closed {
                let first = regions.of(ring.faces[0]);
                for &face in &ring.faces {
                    let root = regions.of(face);
                    regions.0[root as usize] = first;
                }
            } else {
                ring.faces.iter().for_each(|&face| gone[face as usize] = true);
            }
        }
        for &vertex in vertices.iter().filter(|&&vertex| !topology.is_boundary_vertex(vertex)) {
            inside.insert(regions.of(topology.ring(vertex).faces[0]), vertex);
        }
        let region: Vec<u32> = (0..gone.len() as u32).map(|face| regions.of(face)).collect();
        for face in 0..gone.len() {
            if gone[face] {
                gone[region[face] as usize] = true;
            }
        }
        let mut rims: BTreeMap<u32, BTreeMap<u32, u32>> = BTreeMap::new();
        for (face, &root) in region.iter().enumerate().filter(|(_, root)| inside.contains_key(root)) {
            let rim = rims.entry(root).or_default();
            let corners = topology.face(face);
            for (place, &edge) in topology.face_edges(face).iter().enumerate() {
                let within =
                    topology.edge_faces(edge as usize).filter(|&other| region[other] == root).count();
                if within == 1 && rim.insert(corners[place], corners[(place + 1) % corners.len()]).is_some() {
                    return Err(MeshError::NoPolygon { vertex: inside[&root] });
                }
            }
        }
        let mut faces = Vec::new();
        for (face, &root) in region.iter().enumerate() {
            match inside.get(&root) {
                _ if gone[root as usize] => {}
                None => faces.push(topology.face(face).to_vec()),
                Some(&vertex) => {
                    // The polygon stands where the first of its faces stood.
                    if let Some(rim) = rims.remove(&root) {
                        faces.push(polygon(&rim).ok_or(MeshError::NoPolygon { vertex })?);
                    }
                }
            }
        }
        self.with_faces(&faces)
    }

    /// The same mesh without some faces; vertices that are left without a face go too.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` if there is no such face, `Empty` if none is left, `NonManifoldVertex` where the rest hangs together only at a vertex.
    pub fn without_faces(&self, faces: &[usize]) -> Result<Self, MeshError> {
        let count = self.topology.face_count();
        if let Some(&index) = faces.iter().find(|&&face| face >= count) {
            return Err(MeshError::NoSuchElement { what: "face", index });
        }
        let mut gone = vec![false; count];
        faces.iter().for_each(|&face| gone[face] = true);
        let kept = self.topology.faces().zip(&gone).filter(|(_, gone)| !**gone);
        self.with_faces(&kept.map(|(face, _)| face.to_vec()).collect::<Vec<_>>())
    }

    /// The mesh of `faces`, loops of vertices of this one, with what of creases and fixed vertices is left.
    fn with_faces(&self, faces: &[Vec<u32>]) -> Result<Self, MeshError> {
        let mut number = vec![NONE; self.positions.len()];
        faces.iter().flatten().for_each(|&vertex| number[vertex as usize] = 0);
        let mut positions = Vec::new();
        for (number, &position) in number.iter_mut().zip(&self.positions).filter(|(number, _)| **number == 0)
        {
            *number = positions.len() as u32;
            positions.push(position);
        }
        let renumbered = |vertex: u32| Some(number[vertex as usize]).filter(|&number| number != NONE);
        let faces: Vec<Vec<u32>> =
            faces.iter().map(|face| face.iter().filter_map(|&vertex| renumbered(vertex)).collect()).collect();
        if faces.is_empty() {
            return Err(MeshError::Empty { what: "faces" });
        }
        let mut mesh = Self::new(positions, &faces)?;
        mesh.creases = self
            .creases
            .iter()
            .filter_map(|crease| {
                let [a, b] = self.topology.edge(crease.edge as usize).map(renumbered);
                let edge = mesh.topology.edge_between(a?, b?)?;
                let is_inner = mesh.topology.edge_faces(edge).count() == 2;
                is_inner.then_some(Crease { edge: edge as u32, sharpness: crease.sharpness })
            })
            .collect();
        mesh.creases.sort_unstable_by_key(|crease| crease.edge);
        mesh.fixed = self.fixed.iter().filter_map(|&vertex| renumbered(vertex)).collect();
        Ok(mesh)
    }
}

/// The loop that a rim is, beginning at its least vertex; `None` if it is none or several.
fn polygon(rim: &BTreeMap<u32, u32>) -> Option<Vec<u32>> {
    let (&start, _) = rim.first_key_value()?;
    let mut corners = vec![start];
    let mut at = *rim.get(&start)?;
    while at != start {
        corners.push(at);
        at = *rim.get(&at)?;
    }
    (corners.len() == rim.len()).then_some(corners)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::surface::catmull_clark::BoundaryRule;
    use crate::core::surface::{mesh_faults, mesh_shapes};

    #[test]
    fn an_inner_vertex_leaves_one_polygon_and_its_euler_number() {
        let cube = mesh_shapes::cube().without_vertices(&[6]).unwrap();
        assert_eq!(cube.counts(), [7, 9, 4, 2], "three squares became a hexagon");
        let sizes: Vec<usize> = cube.topology().faces().map(<[u32]>::len).collect();
        assert_eq!(sizes, [4, 6, 4, 4], "where the first of them stood");
        for (name, mesh) in mesh_shapes::named_shapes() {
            for vertex in (0..mesh.positions().len()).filter(|&v| !mesh.topology().is_boundary_vertex(v)) {
                let Ok(less) = mesh.without_vertices(&[vertex]) else { continue };
                let valence = mesh.topology().valence(vertex) as i64;
                let [v, e, f, euler] = mesh.counts();
                assert_eq!(less.counts(), [v - 1, e - valence, f - valence + 1, euler], "{name}, {vertex}");
                assert_eq!(less.topology().is_closed(), mesh.topology().is_closed(), "{name}, {vertex}");
            }
        }
    }

    #[test]
    fn a_boundary_vertex_takes_its_faces_along() {
        let sheet = mesh_shapes::open_sheet(3, 3).unwrap();
        let corner = sheet.without_vertices(&[0]).unwrap();
        assert_eq!(corner.counts(), [15, 22, 8, 1], "one square fewer");
        let side = sheet.without_vertices(&[1]).unwrap();
        assert_eq!(side.counts(), [14, 20, 7, 1], "two squares; the corner has no face any more");
        // An inner and a boundary vertex that share faces: all of them go.
        assert_eq!(sheet.without_vertices(&[0, 5]).unwrap().counts(), [12, 16, 5, 1], "four squares fewer");
    }

    #[test]
    fn neighbours_that_go_together_leave_one_polygon() {
        let sheet = mesh_shapes::open_sheet(3, 3).unwrap();
        let less = sheet.without_vertices(&[5, 6]).unwrap();
        assert_eq!(less.counts(), [14, 17, 4, 1], "six squares became one polygon");
        assert_eq!(less, sheet.without_vertices(&[6, 5, 5]).unwrap(), "whatever their order");
    }

    #[test]
    fn what_would_be_no_mesh_is_refused_with_the_reason() {
        let refused = |result: Result<PolygonMesh, MeshError>| result.unwrap_err().name();
        let cube = mesh_shapes::cube();
        assert_eq!(refused(cube.without_vertices(&[0, 1, 6])), "DegenerateFace", "every face would be one");
        assert_eq!(refused(cube.without_vertices(&[8])), "IndexOutOfRange", "eight vertices");
        assert_eq!(refused(cube.without_faces(&[6])), "IndexOutOfRange", "six faces");
        assert_eq!(refused(cube.without_faces(&[0, 1, 2, 3, 4, 5])), "Empty", "nothing is left");
        let fan = mesh_shapes::fan(5).unwrap();
        assert_eq!(refused(fan.without_faces(&[0, 2])), "NonManifoldVertex", "two parts meet at the apex");
        // A ring of faces around the torus has two rims.
        let torus = mesh_shapes::torus_grid(4, 3).unwrap();
        assert_eq!(refused(torus.without_vertices(&[0, 1, 2])), "DegenerateFace", "an annulus is no polygon");
    }

    #[test]
    fn creases_and_fixed_vertices_stay_where_they_were() {
        let cube = mesh_shapes::creased_cube().with_fixed_vertex(7).unwrap();
        let less = cube.without_vertices(&[1]).unwrap();
        let at = |mesh: &PolygonMesh, vertex: usize| {
            less.positions().iter().position(|p| *p == mesh.positions()[vertex]).unwrap() as u32
        };
        let sharpness = |a: usize, b: usize| {
            less.sharpness(less.topology().edge_between(at(&cube, a), at(&cube, b)).unwrap())
        };
        assert_eq!((sharpness(6, 7), sharpness(2, 3)), (f64::INFINITY, 1.5), "top and bottom");
        assert_eq!(less.creases().len(), 6, "two edges of the bottom are gone");
        assert_eq!(less.fixed_vertices(), [at(&cube, 7)], "the fixed vertex");
        let open = cube.without_faces(&[1]).unwrap();
        assert_eq!(open.creases().len(), 4, "edges of the top are boundary now");
    }

    proptest! {
        /// Whatever is deleted: the rest is a mesh that can be refined, with finite limits, or a reason is given.
        #[test]
        fn any_deletion_leaves_a_mesh_or_a_reason(
            shape in 0usize..9, vertices in prop::collection::vec(0usize..48, 0..8),
            faces in prop::collection::vec(0usize..48, 0..8),
        ) {
            let (name, mesh) = mesh_shapes::named_shapes().into_iter().nth(shape).unwrap();
            for less in [mesh.without_vertices(&vertices), mesh.without_faces(&faces)] {
                let Ok(less) = less else { continue };
                let loops: Vec<Vec<u32>> = less.topology().faces().map(<[u32]>::to_vec).collect();
                prop_assert_eq!(mesh_faults(less.positions().len(), &loops), vec![], "{}", name);
                let rule = BoundaryRule::Standard { fix_corners: false };
                let refined = less.subdivide_levels(2, rule).unwrap().pop().unwrap().mesh;
                prop_assert_eq!(refined.counts()[3], less.counts()[3], "{}: V − E + F", name);
                let limits = refined.limit_positions(false).into_iter().chain(less.limit_positions(false));
                prop_assert!(limits.into_iter().all(|point| point.is_finite()), "{}", name);
            }
        }
    }
}
