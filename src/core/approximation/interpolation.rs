//! Interpolation with splines of any degree, open and periodic, of values and derivatives.
//!
//! Course: section 5.5.

use crate::core::approximation::collocation::Collocation;
use crate::core::approximation::data::{check_finite, check_length};
use crate::core::approximation::error::ApproximationError;
use crate::core::approximation::sites::check_sites;
use crate::core::bspline::{Spline, SplineSpace};
use crate::core::point::Point;

/// The spline of `space` with `p(tᵢ) = values[i]` at the `sites`.
///
/// In an open space the `j`-th further copy of a site takes the derivative of order `j`. In a periodic space the sites lie in one period, anywhere on the line.
///
/// # Errors
///
/// Those of [`check_sites`](super::check_sites) in its order; `SizeMismatch` and `NonFinite` for the values; `Singular` in a periodic space (for equally spaced knots of even degree and an even
/// number of sites at the knots, for example).
pub fn interpolate<P: Point>(
    space: SplineSpace, sites: &[f64], values: &[P],
) -> Result<Spline<P>, ApproximationError> {
    check_sites(&space, sites)?;
    check_length("values", sites.len(), values.len())?;
    check_finite("value", values)?;
    let mut coefficients = values.to_vec();
    Collocation::new(&space, sites)?.solve(&mut coefficients)?;
    Ok(Spline::new(space, coefficients)?)
}

/// The bound `(1 + ‖A⁻¹‖) dist(f, S)` of the error of interpolation, from the norm that [`inverse_norm`](super::inverse_norm) gives and any bound of the distance of `f` from the
/// spline space, such as the error of a quasi-interpolant.
pub fn interpolation_error_bound(inverse_norm: f64, distance: f64) -> f64 {
    (1.0 + inverse_norm) * distance
}
