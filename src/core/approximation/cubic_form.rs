//! B-spline coefficients of a cubic spline whose values `yᵢ` and second derivatives `Mᵢ` at its knots are known.
//!
//! The coefficient of the B-spline whose inner knots are `x − a, x, x + b` is the blossom of either piece there, `p + p′(b − a)/3 − p″ ab/6`, and with the
//! slopes of both pieces
//!
//! ```text
//! c = (yᵢ₋₁ + yᵢ + yᵢ₊₁)/3 − (a² Mᵢ₋₁ + (2a² + 3ab + 2b²) Mᵢ + b² Mᵢ₊₁)/18.
//! ```
//!
//! Course: sections 5.5 and 5.6.

use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::{Spline, SplineSpace};
use crate::core::point::Point;

/// Writes the coefficients that belong to the inner ones of the `sites`, two fewer.
pub(super) fn write_inner_coefficients<P: Point>(
    sites: &[f64],
    values: &[P],
    moments: &[P],
    result: &mut [P],
) {
    let neighbours = sites.windows(3).zip(values.windows(3)).zip(moments.windows(3));
    for (coefficient, ((x, y), moment)) in result.iter_mut().zip(neighbours) {
        let (a, b) = (x[1] - x[0], x[2] - x[1]);
        let (aa, bb) = (a * a, b * b);
        let bend = moment[0] * aa + moment[1] * (2.0 * (aa + bb) + 3.0 * (a * b)) + moment[2] * bb;
        *coefficient = (y[0] + y[1] + y[2]) * (1.0 / 3.0) - bend * (1.0 / 18.0);
    }
}

/// The open spline with simple knots at the `sites`, two or more, and exterior knots spaced by `outer`; `skip` of 1 makes no knots of the second and the last but one
/// of at least four sites.
pub(super) fn spline_from_moments<P: Point>(
    sites: &[f64],
    values: &[P],
    moments: &[P],
    outer: (f64, f64),
    skip: usize,
) -> Result<Spline<P>, ApproximationError> {
    let last = sites.len() - 1;
    let (second, before_last) = (1 + skip, last - 1 - skip);
    // Coefficient 2 belongs to the second knot in D.
    let count = sites.len() + 2 - 2 * skip;
    let mut coefficients = vec![P::ZERO; count];
    let within = skip..sites.len() - skip;
    write_inner_coefficients(
        &sites[within.clone()],
        &values[within.clone()],
        &moments[within],
        &mut coefficients[2..count - 2],
    );
    if skip > 0 && second <= before_last {
        // Next to the sites left out, the neighbouring knots are farther away.
        let following = if second < before_last { (second + 1, before_last - 1) } else { (last, 0) };
        for (index, near) in [(2, [0, second, following.0]), (count - 3, [following.1, before_last, last])] {
            let (x, y, moment) = (near.map(|i| sites[i]), near.map(|i| values[i]), near.map(|i| moments[i]));
            write_inner_coefficients(&x, &y, &moment, &mut coefficients[index..=index]);
        }
    }
    // At an end the slope comes from the only interval, and seen from outside everything is mirrored.
    let end = |at: usize, next: usize, outer: f64| {
        let width = (sites[next] - sites[at]).abs();
        let slope =
            (values[next] - values[at]) * width.recip() - (moments[at] * 2.0 + moments[next]) * (width / 6.0);
        let second = values[at] + slope * ((width - outer) / 3.0) - moments[at] * (outer * width / 6.0);
        let first = values[at] - slope * outer + moments[at] * (outer * outer / 3.0);
        (first, second)
    };
    let (first_next, last_next) = if second <= before_last { (second, before_last) } else { (last, 0) };
    (coefficients[0], coefficients[1]) = end(0, first_next, outer.0);
    (coefficients[count - 1], coefficients[count - 2]) = end(last, last_next, outer.1);
    let mut knots = Vec::with_capacity(count + 4);
    knots.extend((1..=3).rev().map(|i| sites[0] - f64::from(i) * outer.0));
    knots.push(sites[0]);
    knots.extend_from_slice(&sites[second..last - skip]);
    knots.push(sites[last]);
    knots.extend((1..=3).map(|i| sites[last] + f64::from(i) * outer.1));
    Ok(Spline::new(SplineSpace::new(3, knots)?, coefficients)?)
}
