//! Catmull-Clark subdivision: weights (`masks`) apart from connectivity (`refinement`) apart from whole meshes (`step`).
//!
//! | file | what |
//! |---|---|
//! | `masks` | weights of new vertices, edge points, limits, tangents |
//! | `ring` | one vertex with its surroundings: its steps, limit, tangents, matrix |
//! | `refinement` | indices and smooth positions after a step |
//! | `stencil` | which coarse vertices make a fine one |
//! | `step` | one or several steps with provenance, boundary rules |
//! | `limit` | points, normals and patches of the limit surface |

mod limit;
mod masks;
mod refinement;
mod ring;
mod stencil;
mod step;

pub use masks::{
    CreaseTangent, VertexKind, VertexMask, child_sharpness, crease_tangent, edge_weights, limit_weights,
    quad_vertex_weights, subdominant_eigenvalue, tangent_weights, vertex_kind, vertex_mask,
};
pub use ring::{Ring, RingLimit, RingSector, local_matrix};
pub use stencil::{Origin, Stencil};
pub use step::{BoundaryRule, RefinedMesh, SubdivisionStep, stencil_through};
