//! Chapter 9: finite elements with B-splines.
//!
//! | file | what |
//! |---|---|
//! | `form` | 9.1 the elliptic problem by its coefficients |
//! | `solver` | 9.4 solving Galerkin systems |
//! | `error_norm` | 9.1 errors and rates of convergence |

mod error;
mod error_norm;
mod form;
mod solver;

pub use error::FiniteElementError;
pub use error_norm::{ErrorNorms, ErrorSums, convergence_rates};
pub use form::{Coefficient, EllipticForm, FormAtPoint, Jet};
pub use solver::{Method, SystemMatrix, SystemSolution, solve_system, solve_up_to_a_constant};
