//! Connectivity of polygon meshes as flat index arrays; it knows no positions.
//!
//! A *corner* is one vertex of one face; corners are numbered face by face, and corner `c` is also the half-edge from its vertex to the next
//! one of the face. Edges are numbered by first appearance in that order. Faces run counterclockwise seen from outside.
//! Everything is built in time proportional to the number of corners.

use crate::core::surface::mesh_error::MeshError;

/// The missing second corner of a boundary edge.
pub(super) const NONE: u32 = u32::MAX;

/// Most faces of a mesh.
pub const MAX_FACES: usize = 5_000_000;

/// Most corners of a mesh; indices are 32 bits wide.
const MAX_CORNERS: usize = 8 * MAX_FACES;

/// Vertices, edges and faces of an orientable manifold mesh, with or without boundary; valid by construction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshTopology {
    /// Number of faces at each vertex.
    pub(super) valences: Vec<u32>,
    /// A corner of each vertex; at the boundary the one from which the others are reached counterclockwise.
    pub(super) vertex_corners: Vec<u32>,
    /// First corner of each face and the number of corners; empty if all faces are quadrilaterals.
    pub(super) face_starts: Vec<u32>,
    pub(super) corner_vertices: Vec<u32>,
    pub(super) corner_edges: Vec<u32>,
    /// Both half-edges of an edge, the second [`NONE`] at the boundary.
    pub(super) edge_corners: Vec<[u32; 2]>,
    /// The edges with one face, increasing.
    pub(super) boundary_edges: Vec<u32>,
}

/// The surroundings of a vertex in counterclockwise order.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexRing {
    /// The neighbours; one more than faces at the boundary.
    pub neighbours: Vec<u32>,
    /// The edges to them.
    pub edges: Vec<u32>,
    /// The faces; face `k` lies between edges `k` and `k + 1`.
    pub faces: Vec<u32>,
    /// Whether the faces surround the vertex.
    pub closed: bool,
}

impl MeshTopology {
    /// The connectivity of `faces`, loops of vertex numbers below `vertex_count`.
    ///
    /// # Errors
    ///
    /// The first fault that [`mesh_faults`] finds.
    pub fn new(vertex_count: usize, faces: &[Vec<u32>]) -> Result<Self, MeshError> {
        let mut faults = Vec::new();
        let topology = build(vertex_count, faces, &mut faults);
        match (topology, faults.into_iter().next()) {
            (Some(topology), None) => Ok(topology),
            (_, Some(fault)) => Err(fault),
            (None, None) => Err(MeshError::Empty { what: "faces" }),
        }
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.valences.len()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.edge_corners.len()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        if self.is_quads() { self.corner_vertices.len() / 4 } else { self.face_starts.len() - 1 }
    }

    /// Number of corners of all faces together.
    pub fn corner_count(&self) -> usize {
        self.corner_vertices.len()
    }

    /// Whether all faces are quadrilaterals.
    pub fn is_quads(&self) -> bool {
        self.face_starts.is_empty()
    }

    /// The vertices of a face, counterclockwise.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.corner_vertices[self.face_range(face)]
    }

    /// The edges of a face; edge `i` joins its vertices `i` and `i + 1`.
    pub fn face_edges(&self, face: usize) -> &[u32] {
        &self.corner_edges[self.face_range(face)]
    }

    /// All faces.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.face_count()).map(|face| self.face(face))
    }

    /// The ends of an edge, in the direction of the face that names it first.
    pub fn edge(&self, edge: usize) -> [u32; 2] {
        let corner = self.edge_corners[edge][0] as usize;
        [self.corner_vertices[corner], self.corner_vertices[self.next(corner)]]
    }

    /// The one or two faces of an edge.
    pub fn edge_faces(&self, edge: usize) -> impl Iterator<Item = usize> {
        self.edge_corners[edge].into_iter().filter(|&c| c != NONE).map(|c| self.corner_face(c as usize))
    }

    /// The edge between two vertices.
    pub fn edge_between(&self, a: u32, b: u32) -> Option<usize> {
        if a as usize >= self.vertex_count() {
            return None;
        }
        let ring = self.ring(a as usize);
        ring.neighbours.iter().position(|&neighbour| neighbour == b).map(|k| ring.edges[k] as usize)
    }

    /// Number of faces at a vertex.
    pub fn valence(&self, vertex: usize) -> usize {
        self.valences[vertex] as usize
    }

    /// Whether a vertex lies on the boundary.
    pub fn is_boundary_vertex(&self, vertex: usize) -> bool {
        // The fan of a boundary vertex starts with a boundary edge.
        let edge = self.corner_edges[self.vertex_corners[vertex] as usize];
        self.edge_corners[edge as usize][1] == NONE
    }

    /// The edges with one face, increasing.
    pub fn boundary_edges(&self) -> &[u32] {
        &self.boundary_edges
    }

    /// Whether there is no boundary.
    pub fn is_closed(&self) -> bool {
        self.boundary_edges.is_empty()
    }

    /// `V − E + F`.
    pub fn euler(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// Number of connected parts.
    pub fn component_count(&self) -> usize {
        let mut parent: Vec<u32> = (0..self.vertex_count() as u32).collect();
        fn root(parent: &mut [u32], mut vertex: u32) -> u32 {
            while parent[vertex as usize] != vertex {
                parent[vertex as usize] = parent[parent[vertex as usize] as usize];
                vertex = parent[vertex as usize];
            }
            vertex
        }
        let mut count = self.vertex_count();
        for edge in 0..self.edge_count() {
            let ends = self.edge(edge).map(|end| root(&mut parent, end));
            if ends[0] != ends[1] {
                parent[ends[0] as usize] = ends[1];
                count -= 1;
            }
        }
        count
    }

    /// Number of handles, summed over the parts: `V − E + F = 2 parts − 2 genus − boundary loops`.
    pub fn genus(&self) -> i64 {
        let loops = self.boundary_loops().len() as i64;
        (2 * self.component_count() as i64 - self.euler() - loops) / 2
    }

    /// The boundary as closed loops of vertices; the faces lie on the left.
    pub fn boundary_loops(&self) -> Vec<Vec<u32>> {
        let mut done = vec![false; self.edge_count()];
        let mut loops = Vec::new();
        for &start in &self.boundary_edges {
            let mut edge = start as usize;
            let mut vertices = Vec::new();
            while !std::mem::replace(&mut done[edge], true) {
                let [from, to] = self.edge(edge);
                vertices.push(from);
                // The fan of a boundary vertex starts with the boundary edge that leaves it.
                edge = self.corner_edges[self.vertex_corners[to as usize] as usize] as usize;
            }
            if !vertices.is_empty() {
                loops.push(vertices);
            }
        }
        loops
    }

    /// The surroundings of a vertex.
    pub fn ring(&self, vertex: usize) -> VertexRing {
        self.ring_from(self.vertex_corners[vertex] as usize)
    }

    /// As [`Self::ring`] for the vertex of corner `start`, beginning with its face; of a boundary vertex only what follows.
    pub(super) fn ring_from(&self, start: usize) -> VertexRing {
        let mut ring =
            VertexRing { neighbours: Vec::new(), edges: Vec::new(), faces: Vec::new(), closed: false };
        let mut corner = start;
        loop {
            ring.neighbours.push(self.corner_vertices[self.next(corner)]);
            ring.edges.push(self.corner_edges[corner]);
            ring.faces.push(self.corner_face(corner) as u32);
            let before = self.previous(corner);
            match self.twin(before) {
                Some(twin) if twin == start => {
                    ring.closed = true;
                    return ring;
                }
                Some(twin) => corner = twin,
                None => {
                    ring.neighbours.push(self.corner_vertices[before]);
                    ring.edges.push(self.corner_edges[before]);
                    return ring;
                }
            }
        }
    }

    pub(super) fn face_range(&self, face: usize) -> std::ops::Range<usize> {
        if self.is_quads() {
            4 * face..4 * face + 4
        } else {
            self.face_starts[face] as usize..self.face_starts[face + 1] as usize
        }
    }

    pub(super) fn corner_face(&self, corner: usize) -> usize {
        if self.is_quads() {
            corner / 4
        } else {
            self.face_starts.partition_point(|&start| start as usize <= corner) - 1
        }
    }

    /// The next corner of the face.
    pub(super) fn next(&self, corner: usize) -> usize {
        if self.is_quads() {
            return (corner & !3) | ((corner + 1) & 3);
        }
        let range = self.face_range(self.corner_face(corner));
        if corner + 1 == range.end { range.start } else { corner + 1 }
    }

    /// The corner before in the face.
    pub(super) fn previous(&self, corner: usize) -> usize {
        if self.is_quads() {
            return (corner & !3) | ((corner + 3) & 3);
        }
        let range = self.face_range(self.corner_face(corner));
        if corner == range.start { range.end - 1 } else { corner - 1 }
    }

    /// The other half-edge of the same edge.
    fn twin(&self, corner: usize) -> Option<usize> {
        let [a, b] = self.edge_corners[self.corner_edges[corner] as usize];
        let other = if a as usize == corner { b } else { a };
        (other != NONE).then_some(other as usize)
    }
}

/// Everything that keeps `faces` from being an orientable manifold mesh, in the order of the checks: faces, edges, vertices.
pub fn mesh_faults(vertex_count: usize, faces: &[Vec<u32>]) -> Vec<MeshError> {
    let mut faults = Vec::new();
    build(vertex_count, faces, &mut faults);
    faults
}

/// Builds what can be built; `None` if the faces themselves are wrong.
fn build(vertex_count: usize, faces: &[Vec<u32>], faults: &mut Vec<MeshError>) -> Option<MeshTopology> {
    let corner_count: usize = faces.iter().map(Vec::len).sum();
    for (what, value, limit) in [
        ("number of vertices", vertex_count, MAX_CORNERS),
        ("number of faces", faces.len(), MAX_FACES),
        ("number of face corners", corner_count, MAX_CORNERS),
    ] {
        if value > limit {
            faults.push(MeshError::StepLimit { what, value, limit });
        }
    }
    for (what, count) in [("vertices", vertex_count), ("faces", faces.len())] {
        if count == 0 {
            faults.push(MeshError::Empty { what });
        }
    }
    if !faults.is_empty() {
        return None;
    }
    check_faces(vertex_count, faces, faults);
    if !faults.is_empty() {
        return None;
    }
    let quads = faces.iter().all(|face| face.len() == 4);
    let mut topology = MeshTopology { valences: vec![0; vertex_count], ..MeshTopology::default() };
    if !quads {
        let mut start = 0;
        topology.face_starts.push(0);
        topology.face_starts.extend(faces.iter().map(|face| {
            start += face.len() as u32;
            start
        }));
    }
    topology.corner_vertices = faces.concat();
    for &vertex in &topology.corner_vertices {
        topology.valences[vertex as usize] += 1;
    }
    let mates = pair_half_edges(&topology, faces, faults);
    topology.corner_edges = vec![NONE; corner_count];
    for (corner, &mate) in mates.iter().enumerate() {
        if mate == NONE || corner < mate as usize {
            let edge = topology.edge_corners.len() as u32;
            topology.edge_corners.push([corner as u32, mate]);
            topology.corner_edges[corner] = edge;
            if mate == NONE {
                topology.boundary_edges.push(edge);
            } else {
                topology.corner_edges[mate as usize] = edge;
            }
        }
    }
    topology.vertex_corners = vec![NONE; vertex_count];
    for corner in 0..corner_count {
        let start = &mut topology.vertex_corners[topology.corner_vertices[corner] as usize];
        if *start == NONE || mates[corner] == NONE {
            *start = corner as u32;
        }
    }
    let edges_fit = faults.is_empty();
    for vertex in 0..vertex_count {
        if topology.valences[vertex] == 0 {
            faults.push(MeshError::IsolatedVertex { vertex });
        } else if edges_fit && topology.ring(vertex).faces.len() != topology.valence(vertex) {
            faults.push(MeshError::NonManifoldVertex { vertex });
        }
    }
    Some(topology)
}

fn check_faces(vertex_count: usize, faces: &[Vec<u32>], faults: &mut Vec<MeshError>) {
    let mut seen_by = vec![NONE; vertex_count];
    for (face, corners) in faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= vertex_count) {
            faults.push(MeshError::IndexOutOfRange { face, vertex: u64::from(vertex), count: vertex_count });
            continue;
        }
        let mut distinct = 0;
        for &vertex in corners {
            distinct += usize::from(seen_by[vertex as usize] != face as u32);
            seen_by[vertex as usize] = face as u32;
        }
        if distinct < 3 || distinct < corners.len() {
            faults.push(MeshError::DegenerateFace { face, corners: corners.len(), distinct });
        }
    }
}

/// For each half-edge the opposite one, or [`NONE`]; half-edges are sorted by their ends in two counting sorts.
fn pair_half_edges(topology: &MeshTopology, faces: &[Vec<u32>], faults: &mut Vec<MeshError>) -> Vec<u32> {
    let corners = topology.corner_vertices.len();
    let mut heads = Vec::with_capacity(corners);
    for face in faces {
        heads.extend((1..=face.len()).map(|i| face[i % face.len()]));
    }
    let tails = &topology.corner_vertices;
    let low = |corner: u32| tails[corner as usize].min(heads[corner as usize]);
    let high = |corner: u32| tails[corner as usize].max(heads[corner as usize]);
    let order = counting_sort(topology.vertex_count(), (0..corners as u32).collect(), high);
    let order = counting_sort(topology.vertex_count(), order, low);
    let mut mates = vec![NONE; corners];
    let mut conflicts = Vec::new();
    for group in order.chunk_by(|&a, &b| low(a) == low(b) && high(a) == high(b)) {
        match *group {
            [_] => {}
            [a, b] if tails[a as usize] == heads[b as usize] => {
                (mates[a as usize], mates[b as usize]) = (b, a);
            }
            _ => conflicts.push(group),
        }
    }
    // A face that stands twice has only edges with conflicts; name the face then, not its edges.
    let mut first_with: std::collections::HashMap<Vec<u32>, usize> = std::collections::HashMap::new();
    let mut duplicates = std::collections::BTreeMap::new();
    let mut suspects: Vec<usize> = conflicts
        .iter()
        .flat_map(|group| group.iter())
        .map(|&corner| topology.corner_face(corner as usize))
        .collect();
    suspects.sort_unstable();
    suspects.dedup();
    for face in suspects {
        let mut turned = faces[face].clone();
        let least = (0..turned.len()).min_by_key(|&i| turned[i]).unwrap_or(0);
        turned.rotate_left(least);
        let first = *first_with.entry(turned).or_insert(face);
        if first != face {
            duplicates.insert(face, first);
        }
    }
    faults.extend(duplicates.iter().map(|(&face, &first)| MeshError::DuplicateFace { face, first }));
    conflicts.sort_unstable_by_key(|group| group[0]);
    for group in conflicts {
        let edge = [tails[group[0] as usize], heads[group[0] as usize]];
        let faces: Vec<usize> = group
            .iter()
            .map(|&corner| topology.corner_face(corner as usize))
            .filter(|face| !duplicates.contains_key(face))
            .collect();
        match faces[..] {
            [] | [_] => {}
            [a, b] if group.len() == 2 => {
                faults.push(MeshError::InconsistentOrientation { edge, faces: [a, b] });
            }
            [_, _] => {}
            _ => faults.push(MeshError::NonManifoldEdge { edge, faces }),
        }
    }
    mates
}

fn counting_sort(keys: usize, items: Vec<u32>, key: impl Fn(u32) -> u32) -> Vec<u32> {
    let mut starts = vec![0_u32; keys + 1];
    for &item in &items {
        starts[key(item) as usize + 1] += 1;
    }
    for i in 0..keys {
        starts[i + 1] += starts[i];
    }
    let mut sorted = vec![0; items.len()];
    for item in items {
        let place = &mut starts[key(item) as usize];
        sorted[*place as usize] = item;
        *place += 1;
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(vertex_count: usize, faces: &[&[u32]]) -> Vec<&'static str> {
        let faces: Vec<Vec<u32>> = faces.iter().map(|face| face.to_vec()).collect();
        mesh_faults(vertex_count, &faces).iter().map(MeshError::name).collect()
    }

    #[test]
    fn every_fault_is_found_and_named() {
        assert_eq!(names(4, &[&[0, 1, 2], &[0, 2, 3]]), [""; 0], "two triangles");
        assert_eq!(names(0, &[]), ["Empty", "Empty"], "nothing");
        assert_eq!(names(3, &[&[0, 1, 3]]), ["IndexOutOfRange"], "vertex 3 of 3");
        assert_eq!(names(3, &[&[0, 1], &[0, 1, 1]]), ["DegenerateFace", "DegenerateFace"], "two corners");
        assert_eq!(names(4, &[&[0, 1, 2, 1]]), ["DegenerateFace"], "a vertex twice");
        assert_eq!(names(3, &[&[0, 1, 2], &[1, 2, 0]]), ["DuplicateFace"], "turned copy");
        assert_eq!(names(4, &[&[0, 1, 2], &[0, 1, 3]]), ["InconsistentOrientation"], "both from 0 to 1");
        assert_eq!(names(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]), ["NonManifoldEdge"], "three at 0-1");
        assert_eq!(names(5, &[&[0, 1, 2], &[0, 3, 4]]), ["NonManifoldVertex"], "bow tie");
        assert_eq!(names(4, &[&[0, 1, 2]]), ["IsolatedVertex"], "vertex 3");
        let fault = MeshTopology::new(5, &[vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]]).unwrap_err();
        assert_eq!(
            fault,
            MeshError::NonManifoldEdge { edge: [0, 1], faces: vec![0, 1, 2] },
            "the edge and its faces"
        );
    }

    #[test]
    fn a_vertex_with_a_hundred_thousand_faces_takes_no_quadratic_time() {
        let count = 100_000_u32;
        let faces: Vec<Vec<u32>> = (0..count).map(|k| vec![0, k + 1, (k + 1) % count + 1]).collect();
        let cone = MeshTopology::new(count as usize + 1, &faces).unwrap();
        assert_eq!(cone.valence(0), 100_000, "the tip");
        assert_eq!((cone.euler(), cone.genus()), (1, 0), "a disc");
        assert_eq!(cone.boundary_loops().len(), 1, "one boundary");
    }

    #[test]
    fn rings_run_counterclockwise_and_boundaries_have_their_faces_on_the_left() {
        // 0 1 2 over 3 4 5 over 6 7 8, y downwards, faces counterclockwise seen from below.
        let quad = |a: u32| vec![a, a + 1, a + 4, a + 3];
        let sheet = MeshTopology::new(9, &[quad(0), quad(1), quad(3), quad(4)]).unwrap();
        let ring = sheet.ring(4);
        assert!(ring.closed, "the middle");
        assert_eq!(ring.neighbours.len(), 4, "four neighbours");
        for k in 0..4 {
            let face = sheet.face(ring.faces[k] as usize);
            let at = face.iter().position(|&vertex| vertex == 4).unwrap();
            assert_eq!(face[(at + 1) % 4], ring.neighbours[k], "face {k} starts at neighbour {k}");
            assert_eq!(face[(at + 3) % 4], ring.neighbours[(k + 1) % 4], "and ends at the next");
            assert_eq!(sheet.edge_between(4, ring.neighbours[k]), Some(ring.edges[k] as usize), "edge {k}");
        }
        let ring = sheet.ring(1);
        assert!(!ring.closed, "a boundary vertex");
        assert_eq!((ring.neighbours, ring.faces), (vec![2, 4, 0], vec![1, 0]), "from boundary to boundary");
        assert_eq!(sheet.boundary_loops(), [vec![0, 1, 2, 5, 8, 7, 6, 3]], "one loop");
        assert_eq!((sheet.edge_count(), sheet.euler()), (12, 1), "a disc");
    }
}
