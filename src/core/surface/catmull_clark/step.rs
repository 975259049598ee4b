//! Steps of Catmull-Clark subdivision on whole meshes. Course: section 8.3.

use glam::DVec3;

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
        self.check_size(levels)?;
        let mut steps: Vec<SubdivisionStep> = Vec::with_capacity(levels);
        for _ in 0..levels {
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
