//! What can be wrong with polygon meshes.

use thiserror::Error;

use crate::core::progress::Stopped;

/// Errors of polygon meshes and their subdivision; faces, edges and vertices are named by their numbers, counted from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeshError {
    /// No vertices or no faces.
    #[error("the mesh has no {what}")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A coordinate or a sharpness is not a finite number.
    #[error("{what} {index} has the value {value}, not a finite number")]
    NonFinite {
        /// What has the value.
        what: &'static str,
        /// Its number.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {count}")]
    IndexOutOfRange {
        /// The face.
        face: usize,
        /// The index that it names.
        vertex: u64,
        /// Number of vertices.
        count: usize,
    },
    /// A face has fewer than three vertices, or visits one twice.
    #[error("face {face} has {distinct} distinct vertices among {corners} corners")]
    DegenerateFace {
        /// The face.
        face: usize,
        /// Number of its corners.
        corners: usize,
        /// How many of them differ.
        distinct: usize,
    },
    /// Two faces have the same corners in the same cyclic order.
    #[error("face {face} repeats face {first}")]
    DuplicateFace {
        /// The later face.
        face: usize,
        /// The earlier one.
        first: usize,
    },
    /// More than two faces share an edge.
    #[error("the edge {}-{} belongs to {} faces: {:?}", .edge[0], .edge[1], .faces.len(), .faces)]
    NonManifoldEdge {
        /// The ends of the edge.
        edge: [u32; 2],
        /// Its faces.
        faces: Vec<usize>,
    },
    /// Two faces run along an edge in the same direction.
    #[error("the faces {} and {} both run from {} to {}; one of them must be turned", .faces[0], .faces[1], .edge[0], .edge[1])]
    InconsistentOrientation {
        /// The ends of the edge, in the direction of both faces.
        edge: [u32; 2],
        /// The faces.
        faces: [usize; 2],
    },
    /// The faces at a vertex do not form one fan.
    #[error("the faces at vertex {vertex} hang together only there")]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A vertex has no face.
    #[error("vertex {vertex} belongs to no face")]
    IsolatedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// Two vertices are not joined by an edge, or a number is out of range.
    #[error("there is no {what} {index}")]
    NoSuchElement {
        /// What was asked for.
        what: &'static str,
        /// Its number, or an end of the edge.
        index: usize,
    },
    /// A sharpness is negative.
    #[error("the sharpness {value} lies outside [0, ∞)")]
    OutsideInterval {
        /// The sharpness.
        value: f64,
    },
    /// A closed mesh is needed.
    #[error("the mesh has a boundary, for example the edge {}-{}", .edge[0], .edge[1])]
    OpenBoundary {
        /// An edge of the boundary.
        edge: [u32; 2],
    },
    /// Nothing is left after a step that discards the boundary.
    #[error("no vertex has all its faces, so that nothing is left")]
    EmptyResult,
    /// A limit of the library is exceeded.
    #[error("{what} {value} is above the limit {limit}")]
    StepLimit {
        /// What is limited.
        what: &'static str,
        /// The value asked for.
        value: usize,
        /// The largest possible value.
        limit: usize,
    },
    /// The faces that a deleted vertex leaves do not make one polygon.
    #[error("the faces around vertex {vertex} do not make one polygon")]
    NoPolygon {
        /// The vertex.
        vertex: usize,
    },
    /// A watcher has stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A geometric quantity is undefined.
    #[error("{what} at vertex {vertex} is undefined")]
    Degenerate {
        /// The quantity.
        what: &'static str,
        /// The vertex.
        vertex: usize,
    },
}

impl MeshError {
    /// The name of the error in the conventions of the course, for example `NonManifoldEdge`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "Empty",
            Self::NonFinite { .. } => "NonFinite",
            Self::IndexOutOfRange { .. } | Self::NoSuchElement { .. } => "IndexOutOfRange",
            Self::DegenerateFace { .. } | Self::NoPolygon { .. } => "DegenerateFace",
            Self::DuplicateFace { .. } => "DuplicateFace",
            Self::NonManifoldEdge { .. } => "NonManifoldEdge",
            Self::InconsistentOrientation { .. } => "InconsistentOrientation",
            Self::NonManifoldVertex { .. } => "NonManifoldVertex",
            Self::IsolatedVertex { .. } => "IsolatedVertex",
            Self::OutsideInterval { .. } => "OutsideInterval",
            Self::OpenBoundary { .. } => "OpenBoundary",
            Self::EmptyResult => "EmptyResult",
            Self::StepLimit { .. } => "StepLimit",
            Self::Stopped(_) => "Stopped",
            Self::Degenerate { .. } => "Degenerate",
        }
    }
}
