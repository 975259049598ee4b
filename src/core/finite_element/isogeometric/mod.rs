//! Isogeometric elements: the geometry map carries splines over the parameters to functions on a part of the plane.
//!
//! | file | what |
//! |---|---|
//! | `space` | the space of one patch, with the sides where functions vanish |
//! | `direction`, `line` | tables of B-splines; integrands along lines of quadrature points |
//! | `assembly`, `band_matrix` | sum factorisation, and the matrix that it fills |
//! | `system` | matrix, right side and preconditioner; [`solve_patch`] |
//! | `solution` | values, gradients, integrals |
//! | `study` | errors against a known solution, rates of convergence |
//!
//! Course: section 9.3.

mod assembly;
mod band_matrix;
mod direction;
mod line;
mod solution;
mod space;
mod study;
mod system;

pub use band_matrix::TensorBandMatrix;
pub use solution::{IsogeometricSolution, SolutionJet};
pub use space::IsogeometricSpace;
pub(in crate::core::finite_element) use study::finite;
pub use study::{StudyRow, isogeometric_convergence_study};
pub use system::{IsogeometricSystem, SideFlux, solve_patch};
