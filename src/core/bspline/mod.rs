//! Chapter 4: B-splines, spline spaces, and the one spline type.
//!
//! | file | what |
//! |---|---|
//! | `basis` | 4.1 the recurrence, single B-splines and the active ones of a space |
//! | `basis_derivative` | 4.2 derivatives of the active B-splines |
//! | `single_derivative` | 4.2 derivatives of one B-spline, in B-splines of lower degree |
//! | `smoothness` | 4.2 smoothness at the knots, zeros at the ends, integral of one B-spline |
//! | `marsden` | 4.3 polynomials as splines, blossoms, dual functionals |
//! | `derivative` | 4.2, 4.5 derivatives as splines and as sums that may jump |
//! | `space` | 4.4, 4.6 degree and knots that fit each other |
//! | `builders`, `multiple_end_knots` | 4.4 spaces from breaks, and from the knots of other programs |
//! | `uniform` | 4.4 Taylor coefficients of the uniform B-spline |
//! | `piecewise` | 4.4 coefficients of piecewise polynomials and Hermite data |
//! | `power_form` | 4.4 the pieces as polynomials, for many evaluations |
//! | `spline` | 4.5 splines and de Boor's algorithm |
//! | `batch` | 4.5 many values at once |
//! | `integral` | 4.5 antiderivative, integral, mean |
//! | `unroll` | 4.6 a period as an open spline |
//! | `periodic` | 4.6 another start of the period, and open splines that are periodic |

mod basis;
mod basis_derivative;
mod batch;
mod builders;
mod derivative;
mod error;
mod integral;
mod marsden;
mod multiple_end_knots;
mod periodic;
mod piecewise;
mod power_form;
#[cfg(test)]
mod samples;
mod single_derivative;
mod smoothness;
mod space;
mod spline;
mod uniform;
mod unroll;

pub use basis::{BasisTriangle, basis_function, basis_segments};
pub use builders::EndKnots;
pub use derivative::BSplineSum;
pub use error::{Side, SplineError};
pub(in crate::core) use marsden::{monomial_blossoms, variance};
pub use piecewise::PolynomialPiece;
pub use power_form::PowerForm;
#[cfg(test)]
pub(in crate::core) use samples::any_spline;
pub use single_derivative::{basis_derivative, basis_derivative_coefficients};
pub use smoothness::{KnotSmoothness, LeadingTerm, basis_integral, basis_leading_term, basis_smoothness};
pub use space::{DistinctKnot, MAX_DEGREE, SplineSpace};
pub use spline::{DeBoorScheme, Spline};
pub use uniform::{uniform_evaluate, uniform_taylor};
