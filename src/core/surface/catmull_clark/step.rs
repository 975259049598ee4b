//! Steps of Catmull-Clark subdivision on whole meshes. Course: section 8.3.

use glam::DVec3;

use crate::core::progress::{Unwatched, Watcher};
use crate::core::surface::catmull_clark::masks::child_sharpness;
use crate::core::surface::catmull_clark::refinement::{write_quads, write_smooth_positions, write_topology};
use crate::core::surface::catmull_clark::stencil::{Origin, Stencil};
use crate::core::surface::mesh_error::MeshError;
use crate::core::surface::mesh_topology::{MAX_FACES, MeshTopology};
use crate::core::surface::polygon_mesh::{Crease, PolygonMesh};

/// What happens at the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoundaryRule {
    /// Only what has all its surroundings is kept: the quadrilaterals at inner vertices. The surface shrinks by one layer.
    Discard,
    /// The boundary becomes the cubic spline of its polygon.
    Standard {
        /// Whether boundary vertices with a single face stay where they are.
        fix_corners: bool,
    },
}

impl BoundaryRule {
    pub(super) fn fixes_corners(self) -> bool {
        self == Self::Standard { fix_corners: true }
    }
}

/// A refined mesh and where its parts come from.
#[derive(Clone, Debug, PartialEq)]
pub struct SubdivisionStep {
    /// The refined mesh; all faces are quadrilaterals.
    pub mesh: PolygonMesh,
    /// The part of the coarser mesh that each vertex comes from.
    pub origins: Vec<Origin>,
    /// The face of the coarser mesh that each face lies in.
    pub parents: Vec<u32>,
}

/// Positions and quadrilaterals after several steps, for drawing; and buffers that the next call uses again.
#[derive(Clone, Debug, Default)]
pub struct RefinedMesh {
    /// The vertices.
    pub positions: Vec<DVec3>,
    /// The faces, counterclockwise.
    pub quads: Vec<[u32; 4]>,
    levels: [Option<PolygonMesh>; 2],
}

impl PolygonMesh {
    /// One step.
    ///
    /// # Errors
    ///
    /// `StepLimit` above [`MAX_FACES`] faces; with [`BoundaryRule::Discard`] `EmptyResult` without an inner vertex, and
    /// `NonManifoldVertex` where only the diagonal of a face joins two inner vertices.
    pub fn subdivide(&self, rule: BoundaryRule) -> Result<SubdivisionStep, MeshError> {
        self.check_size(1)?;
        let mut mesh = self.empty();
        self.write_step(rule, &mut mesh);
        let (vertices, edges, faces) = (
            self.positions.len() as u32,
            self.topology.edge_count() as u32,
            self.topology.face_count() as u32,
        );
        let origins = (0..vertices).map(Origin::Vertex);
        let origins =
            origins.chain((0..edges).map(Origin::Edge)).chain((0..faces).map(Origin::Face)).collect();
        let parents = (0..self.topology.face_count())
            .flat_map(|face| std::iter::repeat_n(face as u32, self.topology.face(face).len()))
            .collect();
        let step = SubdivisionStep { mesh, origins, parents };
        if rule == BoundaryRule::Discard && !self.topology.is_closed() {
            self.without_boundary(&step)
        } else {
            Ok(step)
        }
    }

    /// `levels` steps, each with its provenance; none for 0 levels.
    ///
    /// # Errors
    ///
    /// As [`Self::subdivide`]; `StepLimit` before anything is computed.
    pub fn subdivide_levels(
        &self,
        levels: usize,
        rule: BoundaryRule,
    ) -> Result<Vec<SubdivisionStep>, MeshError> {
        self.subdivide_levels_watched(levels, rule, &Unwatched)
    }

    /// As [`Self::subdivide_levels`] with a watcher, who is asked before every step.
    ///
    /// # Errors
    ///
    /// As [`Self::subdivide_levels`]; `Stopped`.
    pub fn subdivide_levels_watched(
        &self,
        levels: usize,
        rule: BoundaryRule,
        watcher: &dyn Watcher,
    ) -> Result<Vec<SubdivisionStep>, MeshError> {
        self.check_size(levels)?;
        let mut steps: Vec<SubdivisionStep> = Vec::with_capacity(levels);
        for level in 0..levels {
            // Every step takes four times as long as the one before.
            watcher.check((4_f64.powi(level as i32) - 1.0) / (4_f64.powi(levels as i32) - 1.0))?;
            let step = steps.last().map_or(self, |step| &step.mesh).subdivide(rule)?;
            steps.push(step);
        }
        Ok(steps)
    }

    /// Writes positions and faces after `levels ≥ 1` steps into `result`, without connectivity for the last one.
    ///
    /// Does not allocate if the buffers of `result` are already large enough and the rule keeps the boundary.
    ///
    /// # Errors
    ///
    /// As [`Self::subdivide`]; `StepLimit` also for 0 levels.
    pub fn refine_into(
        &self,
        levels: usize,
        rule: BoundaryRule,
        result: &mut RefinedMesh,
    ) -> Result<(), MeshError> {
        self.check_size(levels)?;
        if levels == 0 {
            return Err(MeshError::StepLimit { what: "number of levels", value: 0, limit: MAX_FACES });
        }
        if rule == BoundaryRule::Discard && !self.topology.is_closed() {
            let steps = self.subdivide_levels(levels, rule)?;
            let last = &steps[levels - 1].mesh;
            result.positions.clone_from(&last.positions);
            result.quads.clear();
            result
                .quads
                .extend(last.topology.corner_vertices.chunks_exact(4).map(|q| [q[0], q[1], q[2], q[3]]));
            return Ok(());
        }
        let [mut even, mut odd] =
            std::mem::take(&mut result.levels).map(|level| level.unwrap_or_else(|| self.empty()));
        for level in 1..levels {
            let parent = if level == 1 { self } else { &odd };
            parent.write_step(rule, &mut even);
            std::mem::swap(&mut even, &mut odd);
        }
        let parent = if levels == 1 { self } else { &odd };
        parent.write_positions(rule, &mut result.positions);
        write_quads(&parent.topology, &mut result.quads);
        result.levels = [Some(even), Some(odd)];
        Ok(())
    }

    /// Writes the whole connectivity of every level from 1 to `levels`; buffers of `result` are used again. It does not depend on positions.
    ///
    /// # Errors
    ///
    /// `StepLimit` above [`MAX_FACES`] faces.
    pub fn refine_topology_into(
        &self,
        levels: usize,
        result: &mut Vec<MeshTopology>,
    ) -> Result<(), MeshError> {
        self.check_size(levels)?;
        result.resize_with(levels, MeshTopology::default);
        for level in 0..levels {
            let (coarse, fine) = result.split_at_mut(level);
            write_topology(coarse.last().unwrap_or(&self.topology), &mut fine[0]);
        }
        Ok(())
    }

    /// Number of faces after `levels` steps, if it is below the limit.
    fn check_size(&self, levels: usize) -> Result<(), MeshError> {
        let corners = self.topology.corner_vertices.len();
        let faces =
            (1..levels).try_fold(corners, |faces, _| faces.checked_mul(4).filter(|&n| n <= MAX_FACES));
        match faces {
            Some(faces) if levels == 0 || faces <= MAX_FACES => Ok(()),
            _ => {
                let value =
                    corners.saturating_mul(4_usize.saturating_pow(levels.saturating_sub(1).min(99) as u32));
                Err(MeshError::StepLimit { what: "number of faces", value, limit: MAX_FACES })
            }
        }
    }

    fn empty(&self) -> Self {
        let topology = MeshTopology::default();
        Self { positions: Vec::new(), topology, creases: Vec::new(), fixed: Vec::new() }
    }

    fn write_step(&self, rule: BoundaryRule, child: &mut Self) {
        self.write_positions(rule, &mut child.positions);
        write_topology(&self.topology, &mut child.topology);
        child.creases.clear();
        child.creases.extend(self.creases.iter().flat_map(|crease| {
            let sharpness = child_sharpness(crease.sharpness);
            let halves = [2 * crease.edge, 2 * crease.edge + 1].map(|edge| Crease { edge, sharpness });
            halves.into_iter().filter(|half| half.sharpness > 0.0)
        }));
        child.fixed.clone_from(&self.fixed);
    }

    fn write_positions(&self, rule: BoundaryRule, positions: &mut Vec<DVec3>) {
        write_smooth_positions(self, positions);
        let stencil = |origin: Origin| self.stencil(origin, rule.fixes_corners()).unwrap_or_default();
        let mut sharp_ends: Vec<u32> = self.fixed.clone();
        let creases = self.creases.iter().map(|crease| crease.edge);
        for edge in self.topology.boundary_edges.iter().copied().chain(creases) {
            positions[self.positions.len() + edge as usize] =
                stencil(Origin::Edge(edge)).apply(&self.positions);
            sharp_ends.extend(self.topology.edge(edge as usize));
        }
        sharp_ends.sort_unstable();
        sharp_ends.dedup();
        for vertex in sharp_ends {
            positions[vertex as usize] = stencil(Origin::Vertex(vertex)).apply(&self.positions);
        }
    }

    /// What is left of a step if only the quadrilaterals at inner vertices are kept.
    fn without_boundary(&self, step: &SubdivisionStep) -> Result<SubdivisionStep, MeshError> {
        let inner = |quad: &&[u32]| !self.topology.is_boundary_vertex(quad[0] as usize);
        let topology = &step.mesh.topology;
        let mut number = vec![None; topology.vertex_count()];
        for quad in topology.faces().filter(inner) {
            quad.iter().for_each(|&vertex| number[vertex as usize] = Some(0));
        }
        let (mut positions, mut origins) = (Vec::new(), Vec::new());
        for (vertex, number) in number.iter_mut().enumerate().filter(|(_, number)| number.is_some()) {
            *number = Some(positions.len() as u32);
            positions.push(step.mesh.positions[vertex]);
            origins.push(step.origins[vertex]);
        }
        if positions.is_empty() {
            return Err(MeshError::EmptyResult);
        }
        let renumbered = |&vertex: &u32| number[vertex as usize];
        let faces: Vec<Vec<u32>> =
            topology.faces().filter(inner).map(|quad| quad.iter().filter_map(renumbered).collect()).collect();
        let kept = topology.faces().zip(&step.parents).filter(|(quad, _)| inner(quad));
        let parents = kept.map(|(_, &parent)| parent).collect();
        let mut mesh = Self::new(positions, &faces)?;
        for crease in &step.mesh.creases {
            if let [Some(a), Some(b)] = topology.edge(crease.edge as usize).map(|end| number[end as usize])
                && mesh.topology.edge_between(a, b).is_some()
            {
                mesh = mesh.with_sharpness([a, b], crease.sharpness)?;
            }
        }
        mesh.fixed = step.mesh.fixed.iter().filter_map(renumbered).collect();
        Ok(SubdivisionStep { mesh, origins, parents })
    }
}

/// The weights on the vertices of the first mesh of vertex `vertex` after all `steps` of `mesh`.
///
/// # Errors
///
/// `IndexOutOfRange` if there is no such vertex, or the steps do not belong to the mesh.
pub fn stencil_through(
    mesh: &PolygonMesh,
    steps: &[SubdivisionStep],
    rule: BoundaryRule,
    vertex: usize,
) -> Result<Stencil, MeshError> {
    let mut stencil = Stencil { weights: vec![(vertex as u32, 1.0)] };
    for level in (0..steps.len()).rev() {
        let parent = if level == 0 { mesh } else { &steps[level - 1].mesh };
        let mut coarser = Stencil::default();
        for &(vertex, weight) in &stencil.weights {
            let missing = MeshError::NoSuchElement { what: "vertex", index: vertex as usize };
            let &origin = steps[level].origins.get(vertex as usize).ok_or(missing)?;
            for (coarse, part) in parent.stencil(origin, rule.fixes_corners())?.weights {
                coarser.add(coarse, weight * part);
            }
        }
        stencil = coarser.joined();
    }
    Ok(stencil)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::mesh_shapes;
    use crate::core::tensor::{Net, subdivide_net};

    const STANDARD: BoundaryRule = BoundaryRule::Standard { fix_corners: false };

    fn all_shapes() -> Vec<(&'static str, PolygonMesh)> {
        let fixed = mesh_shapes::open_sheet(2, 3).unwrap().with_fixed_vertex(5).unwrap();
        let soft =
            mesh_shapes::cube().with_sharpness([0, 1], 0.4).unwrap().with_sharpness([1, 2], 2.7).unwrap();
        let more =
            [("fixed sheet", fixed), ("softly creased cube", soft.with_sharpness([1, 5], 0.9).unwrap())];
        mesh_shapes::named_shapes().into_iter().chain(more).collect()
    }

    #[test]
    fn closed_formulas_give_the_connectivity_built_from_the_faces() {
        for (name, mesh) in all_shapes() {
            let steps = mesh.subdivide_levels(2, STANDARD).unwrap();
            for step in &steps {
                let topology = &step.mesh.topology;
                let faces: Vec<Vec<u32>> = topology.faces().map(<[u32]>::to_vec).collect();
                let built = MeshTopology::new(step.mesh.positions.len(), &faces).unwrap();
                assert!(topology.is_quads(), "{name}");
                assert_eq!(topology.valences, built.valences, "{name}");
                assert_eq!(topology.boundary_loops().len(), built.boundary_loops().len(), "{name}");
                assert_eq!(step.mesh.counts()[3], mesh.counts()[3], "{name}: V − E + F");
                for vertex in 0..step.mesh.positions.len() {
                    let (mut found, mut expected) = (topology.ring(vertex), built.ring(vertex));
                    assert_eq!(found.closed, expected.closed, "{name}, vertex {vertex}");
                    if found.closed {
                        let turn = |ring: &[u32]| {
                            ring.iter().position(|v| *v == *ring.iter().min().unwrap()).unwrap()
                        };
                        let (a, b) = (turn(&found.neighbours), turn(&expected.neighbours));
                        found.neighbours.rotate_left(a);
                        expected.neighbours.rotate_left(b);
                    }
                    assert_eq!(found.neighbours, expected.neighbours, "{name}, vertex {vertex}");
                }
                for edge in 0..topology.edge_count() {
                    let [a, b] = topology.edge(edge);
                    assert_eq!(topology.edge_between(a, b), Some(edge), "{name}, edge {edge}");
                    assert_eq!(
                        topology.face_edges(topology.edge_faces(edge).next().unwrap()).len(),
                        4,
                        "{name}"
                    );
                }
            }
        }
    }

    #[test]
    fn positions_are_the_stencils_which_sum_to_one() {
        for fix_corners in [false, true] {
            for (name, mesh) in all_shapes() {
                let rule = BoundaryRule::Standard { fix_corners };
                let steps = mesh.subdivide_levels(3, rule).unwrap();
                let mut parent = &mesh;
                for step in &steps {
                    for (vertex, &origin) in step.origins.iter().enumerate() {
                        let stencil = parent.stencil(origin, fix_corners).unwrap();
                        let sum: f64 = stencil.weights.iter().map(|entry| entry.1).sum();
                        assert!((sum - 1.0).abs() < 1e-14, "{name}: weights of {origin:?} sum to {sum}");
                        assert!(
                            stencil.weights.iter().all(|entry| entry.1 > 0.0),
                            "{name}: convex at {origin:?}"
                        );
                        let error = stencil.apply(&parent.positions).distance(step.mesh.positions[vertex]);
                        assert!(error < 1e-14, "{name}, {origin:?}: off by {error}");
                    }
                    parent = &step.mesh;
                }
                let last = &steps[2].mesh;
                for vertex in (0..last.positions.len()).step_by(37) {
                    let stencil = stencil_through(&mesh, &steps, rule, vertex).unwrap();
                    let error = stencil.apply(&mesh.positions).distance(last.positions[vertex]);
                    assert!(error < 1e-14, "{name}, three steps to {vertex}: off by {error}");
                }
                let mut fast = RefinedMesh::default();
                for levels in [2, 3] {
                    mesh.refine_into(levels, rule, &mut fast).unwrap();
                    let slow = &steps[levels - 1].mesh;
                    assert_eq!(fast.positions, slow.positions, "{name}: the same arithmetic");
                    assert_eq!(fast.quads.concat(), slow.topology.corner_vertices, "{name}: the same faces");
                }
            }
        }
    }

    #[test]
    fn limits_do_not_change_under_a_step_and_refined_vertices_run_to_them() {
        for (name, mesh) in all_shapes() {
            let steps = mesh.subdivide_levels(4, STANDARD).unwrap();
            let limits = mesh.limit_positions(false);
            let next = steps[0].mesh.limit_positions(false);
            for (vertex, &limit) in limits.iter().enumerate() {
                let error = limit.distance(next[vertex]);
                assert!(error < 1e-13, "{name}, vertex {vertex}: moved by {error}");
                let gap = limit.distance(steps[3].mesh.positions[vertex]);
                assert!(gap < 0.05, "{name}, vertex {vertex}: still {gap} away after four steps");
            }
        }
    }

    #[test]
    fn a_closed_net_is_refined_like_a_tensor_product_spline() {
        let torus = mesh_shapes::torus_grid(6, 5).unwrap();
        let step = torus.subdivide(STANDARD).unwrap();
        let net = Net { shape: [6, 5], points: torus.positions.clone() };
        let refined = subdivide_net(&net, 3, [true, true]).unwrap();
        assert_eq!(refined.shape, [12, 10], "twice as many in each direction");
        for (vertex, &origin) in step.origins.iter().enumerate() {
            if let Origin::Vertex(v) = origin {
                let (i, j) = (v as usize / 5, v as usize % 5);
                let error = step.mesh.positions[vertex].distance(refined.points[2 * i * 10 + 2 * j]);
                assert!(error < 1e-15, "image of ({i}, {j}) is off by {error}");
            }
        }
        let sum = |points: &[DVec3]| points.iter().map(|p| p.length_squared()).sum::<f64>();
        let error = sum(&step.mesh.positions) - sum(&refined.points);
        assert!(error.abs() < 1e-11, "all points together: {error}");
    }

    #[test]
    fn the_limit_of_a_regular_face_is_its_bicubic_patch() {
        let torus = mesh_shapes::torus_grid(6, 5).unwrap();
        let weights = [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0];
        for face in 0..30 {
            let net = torus.bspline_patch(face).unwrap();
            for (corner, [i, j]) in [[0, 0], [1, 0], [1, 1], [0, 1]].into_iter().enumerate() {
                let mut point = DVec3::ZERO;
                for (a, u) in weights.iter().enumerate() {
                    for (b, v) in weights.iter().enumerate() {
                        point += net[i + a][j + b] * (u * v);
                    }
                }
                let vertex = torus.topology.face(face)[corner] as usize;
                let error = point.distance(torus.limit(vertex, false).unwrap().position);
                assert!(error < 1e-14, "face {face}, corner {corner}: off by {error}");
            }
        }
        assert_eq!(mesh_shapes::cube().bspline_patch(0), None, "three faces at a corner");
    }

    #[test]
    fn limit_normals_are_those_of_the_fine_mesh() {
        for (name, mesh) in [("cube", mesh_shapes::cube()), ("tetrahedron", mesh_shapes::tetrahedron())] {
            let steps = mesh.subdivide_levels(6, STANDARD).unwrap();
            let fine = &steps[5].mesh;
            for vertex in 0..mesh.positions.len() {
                let ring = fine.topology.ring(vertex);
                let arm = |k: usize| {
                    fine.positions[ring.neighbours[k % ring.faces.len()] as usize] - fine.positions[vertex]
                };
                let mean = (0..ring.faces.len()).map(|k| arm(k).cross(arm(k + 1))).sum::<DVec3>().normalize();
                let normal = mesh.limit_normal(vertex, None, false).unwrap();
                assert!(normal.distance(mean) < 1e-3, "{name}, vertex {vertex}: {normal} and {mean}");
            }
        }
    }

    #[test]
    fn planar_sheets_and_sharp_polyhedra_stay_what_they_are() {
        let sheet = mesh_shapes::open_sheet(3, 3).unwrap();
        let mut refined = RefinedMesh::default();
        sheet.refine_into(3, STANDARD, &mut refined).unwrap();
        assert!(refined.positions.iter().all(|p| p.z == 0.0), "planar");
        let corners = BoundaryRule::Standard { fix_corners: true };
        sheet.refine_into(3, corners, &mut refined).unwrap();
        for corner in [0, 3, 12, 15] {
            assert_eq!(refined.positions[corner], sheet.positions[corner], "a fixed corner");
        }
        let inner = sheet.subdivide(BoundaryRule::Discard).unwrap();
        assert_eq!(inner.parents.len(), inner.mesh.topology.face_count(), "a parent for each face");
        assert_eq!(inner.mesh.topology.face_count(), 16, "four inner vertices with four quadrilaterals each");
        let strip = mesh_shapes::open_sheet(3, 1).unwrap();
        assert_eq!(
            strip.subdivide(BoundaryRule::Discard).unwrap_err().name(),
            "EmptyResult",
            "no inner vertex"
        );
        assert_eq!(sheet.subdivide_levels(12, STANDARD).unwrap_err().name(), "StepLimit", "too many faces");
        assert_eq!(
            sheet.subdivide_levels(usize::MAX, STANDARD).unwrap_err().name(),
            "StepLimit",
            "far too many"
        );
        assert_eq!(sheet.refine_into(0, STANDARD, &mut refined).unwrap_err().name(), "StepLimit", "no level");
    }
}
