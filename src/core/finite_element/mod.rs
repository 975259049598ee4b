//! Chapter 9: finite elements with B-splines.
//!
//! | file | what |
//! |---|---|
//! | `form` | 9.1 the elliptic problem by its coefficients |
//! | `ritz_galerkin` | 9.1 systems and energies; splines in one variable and on rectangles |
//! | `error_norm` | 9.1 errors and rates of convergence |
//! | `r_function`, `weight_function` | 9.2 weights of Boolean domains |
//! | `grid`, `weighted_bspline` | 9.2 cells, uniform B-splines, the functions `w b` |
//! | `web_spline` | 9.2 inner and outer B-splines, extension |
//! | `cell_quadrature` | 9.4 inner, cut and outer cells, and their nodes |
//! | `offset_matrix`, `assembly`, `solver` | 9.4 storage, element by element, solution |
//! | `poisson` | 9.1, 9.2 a boundary value problem in one call |
//! | `geometry/` | 9.3 plane NURBS patches: point, Jacobian, inverse, range of the determinant |
//! | `sample_geometries` | the plane patches of the course, and a few more |
//! | `isogeometric/` | 9.3 one patch: space, assembly by sum factorisation, solution, errors, rates |
//! | `multipatch/` | 9.3 several patches that share sides |
//! | `fast_diagonalisation` | tensor-product systems through two small eigenproblems |
//! | `flow/` | 9.5 potential flow through a channel, stream lines |

mod assembly;
mod cell_quadrature;
mod error;
mod error_norm;
mod fast_diagonalisation;
mod flow;
mod form;
mod geometry;
mod grid;
mod isogeometric;
mod multipatch;
mod offset_matrix;
mod poisson;
mod r_function;
mod ritz_galerkin;
pub mod sample_geometries;
mod solver;
mod web_spline;
mod weight_function;
mod weighted_bspline;

pub use assembly::{BlockSink, ElementSamples, ElementSource, assemble, map_elements};
pub use cell_quadrature::{QuadraturePoint, QuadratureTable, Slice, SlicedCell, slice_cell};
pub use error::FiniteElementError;
pub use error_norm::{ErrorNorms, ErrorSums, convergence_rates};
pub use fast_diagonalisation::{DirectionMatrices, FastDiagonalisation};
pub use flow::{PotentialFlow, StreamEnd, StreamLine, StreamPoint};
pub use form::{Coefficient, EllipticForm, FormAtPoint, Jet};
pub use geometry::{DeterminantRange, Orientation, PatchJet, PatchSide, PlanePatch};
pub use grid::{CellBasis, Grid, MAX_CELLS, MAX_ELEMENT_DEGREE};
pub use isogeometric::{
    IsogeometricSolution, IsogeometricSpace, IsogeometricSystem, SideFlux, SolutionJet, StudyRow,
    TensorBandMatrix, isogeometric_convergence_study, solve_patch,
};
pub use multipatch::{FixedSides, Interface, MultiPatch, MultiPatchSolution};
pub use offset_matrix::OffsetMatrix;
pub use poisson::{
    Basis, ConvergenceStudy, Discretisation, Problem, WeightedSolution, WeightedSystem, condition_number,
    solve_problem, weighted_convergence_study,
};
pub use r_function::{r_complement, r_difference, r_intersection, r_union};
pub use ritz_galerkin::{GalerkinSystem, LineForm, line_system, rectangle_system};
pub use solver::{Method, SystemMatrix, SystemSolution, solve_system, solve_up_to_a_constant};
pub use web_spline::{Joined, NodeArray, NodeClass, extension_coefficients};
pub use weight_function::{Weight, domain_weight};
pub use weighted_bspline::WeightedSpace;
