//! Chapter 5: approximation with splines.
//!
//! | file | what |
//! |---|---|
//! | `schoenberg` | 5.1 Schoenberg's scheme, its error bound, graded knots |
//! | `sites` | 5.5 where to interpolate, and the knots that suit given sites |
//! | `collocation` | 5.5 the matrix of an interpolation and the norm of its inverse |
//! | `interpolation` | 5.5 interpolation of values and derivatives, open and periodic, of any degree |
//! | `cubic_interpolation` | 5.5 cubic splines with the usual end conditions |
//! | `second_derivatives` | 5.5 their tridiagonal system |
//! | `cubic_form` | 5.5, 5.6 B-spline coefficients from values and second derivatives |
//! | `smoothing` | 5.6 smoothing splines |
//! | `smoothing_choice` | 5.6 the smoothing parameter by cross-validation or for a given residual |
//! | `smoothing_system` | 5.6 the same in B-spline coefficients |
//! | `least_squares` | 5.6 least squares splines |

mod collocation;
mod cubic_form;
mod cubic_interpolation;
mod data;
mod error;
mod interpolation;
mod least_squares;
mod schoenberg;
mod second_derivatives;
mod sites;
mod smoothing;
mod smoothing_choice;
mod smoothing_system;

pub use collocation::{collocation_matrix, inverse_norm, quadratic_inverse_norm_bound};
pub use cubic_interpolation::{EndConditions, cubic_interpolation, natural_spline};
pub use error::ApproximationError;
pub use interpolation::{interpolate, interpolation_error_bound};
pub use least_squares::{LeastSquares, check_determined, least_squares};
pub use schoenberg::{graded_breaks, schoenberg, schoenberg_error_bound, schoenberg_interval};
pub use sites::{averaged_knots, check_sites, midpoint_sites, not_a_knot_space};
pub use smoothing::{Smoothing, SmoothingSpline, merge_equal_sites, smoothing_spline};
pub use smoothing_choice::{CrossValidation, smoothing_by_cross_validation, smoothing_for_residual};
pub use smoothing_system::smoothing_system;
