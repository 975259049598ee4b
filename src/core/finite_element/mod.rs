//! Chapter 9: finite elements with B-splines.
//!
//! | file | what |
//! |---|---|
//! | `form` | 9.1 the elliptic problem by its coefficients |
//! | `solver` | 9.4 solving Galerkin systems |
//! | `error_norm` | 9.1 errors and rates of convergence |
//! | `geometry/` | 9.3 plane NURBS patches: point, Jacobian, inverse, range of the determinant |
//! | `sample_geometries` | the plane patches of the course, and a few more |
//! | `isogeometric/` | 9.3 one patch: space, assembly by sum factorisation, solution, errors, rates |
//! | `multipatch/` | 9.3 several patches that share sides |
//! | `fast_diagonalisation` | tensor-product systems through two small eigenproblems |
//! | `flow/` | 9.5 potential flow through a channel, stream lines |

mod error;
mod error_norm;
mod fast_diagonalisation;
mod flow;
mod form;
mod geometry;
mod isogeometric;
mod multipatch;
pub mod sample_geometries;
mod solver;

pub use error::FiniteElementError;
pub use error_norm::{ErrorNorms, ErrorSums, convergence_rates};
pub use fast_diagonalisation::{DirectionMatrices, FastDiagonalisation};
pub use flow::{PotentialFlow, StreamEnd, StreamLine, StreamPoint};
pub use form::{Coefficient, EllipticForm, FormAtPoint, Jet};
pub use geometry::{DeterminantRange, Orientation, PatchJet, PatchSide, PlanePatch};
pub use isogeometric::{
    IsogeometricSolution, IsogeometricSpace, IsogeometricSystem, SideFlux, SolutionJet, StudyRow,
    TensorBandMatrix, convergence_study, solve_patch,
};
pub use multipatch::{FixedSides, Interface, MultiPatch, MultiPatchSolution};
pub use solver::{Method, SystemMatrix, SystemSolution, solve_system, solve_up_to_a_constant};
