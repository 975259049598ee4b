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

mod assembly;
mod cell_quadrature;
mod error;
mod error_norm;
mod form;
mod grid;
mod offset_matrix;
mod poisson;
mod r_function;
mod ritz_galerkin;
mod solver;
mod web_spline;
mod weight_function;
mod weighted_bspline;

pub use assembly::{BlockSink, ElementSamples, ElementSource, assemble, map_elements};
pub use cell_quadrature::{QuadraturePoint, QuadratureTable, Slice, SlicedCell, slice_cell};
pub use error::FiniteElementError;
pub use error_norm::{ErrorNorms, ErrorSums, convergence_rates};
pub use form::{Coefficient, EllipticForm, FormAtPoint, Jet};
pub use grid::{CellBasis, Grid, MAX_CELLS, MAX_ELEMENT_DEGREE};
pub use offset_matrix::OffsetMatrix;
pub use poisson::{
    Basis, ConvergenceStudy, Discretisation, Problem, WeightedSolution, WeightedSystem, condition_number,
    convergence_study, solve_problem,
};
pub use r_function::{r_complement, r_difference, r_intersection, r_union};
pub use ritz_galerkin::{GalerkinSystem, LineForm, line_system, rectangle_system};
pub use solver::{Method, SystemMatrix, SystemSolution, solve_system, solve_up_to_a_constant};
pub use web_spline::{Joined, NodeArray, NodeClass, extension_coefficients};
pub use weight_function::{Weight, domain_weight};
pub use weighted_bspline::WeightedSpace;
