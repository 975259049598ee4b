//! The smoothing spline as a system for its B-spline coefficients, `Q c = q` with
//!
//! ```text
//! Q = (1 − σ) Aᵗ W A + σ Dᵗ G D,   q = (1 − σ) Aᵗ W f,   aᵢₖ = bₖ(xᵢ),  dᵢₖ = bₖ″(xᵢ),
//! ```
//!
//! and the tridiagonal Gramian `G` of the hat functions (entries `(hⱼ₋₁ + hⱼ)/3` and `hⱼ/6`). To look at and to test with; near σ = 0 and 1 it loses digits that
//! [`smoothing_spline`](super::smoothing_spline) keeps. Course: section 5.6.

use crate::core::approximation::data::{check_finite, check_increasing, check_length, check_weights};
use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::{EndKnots, SplineSpace};
use crate::core::linear_system::BandMatrix;
use crate::core::point::Point;

/// `Q` and `q`, for cubic splines with simple knots at the sites and simple exterior knots; σ = 0 gives `Aᵗ W A`, σ = 1 gives `Dᵗ G D`.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite`, `SitesNotSorted`, `WeightNotPositive`, `SigmaOutOfRange`; those of [`SplineSpace::from_breaks`].
pub fn smoothing_system<P: Point>(
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
    sigma: f64,
) -> Result<(BandMatrix, Vec<P>), ApproximationError> {
    check_length("values", sites.len(), values.len())?;
    check_increasing(sites)?;
    check_finite("value", values)?;
    check_weights(sites.len(), weights)?;
    if !(0.0..=1.0).contains(&sigma) {
        return Err(ApproximationError::SigmaOutOfRange { name: "σ", value: sigma, most: 1.0 });
    }
    let space = SplineSpace::from_breaks(3, sites, EndKnots::Simple)?;
    let (m, last) = (space.dimension(), sites.len() - 1);
    // Row i of Q holds seven entries from column `first(i)` on; in small systems all.
    let width = m.min(7);
    let first = |i: usize| i.saturating_sub(3).min(m - width);
    let mut entries = vec![0.0; m * width];
    let mut right = vec![P::ZERO; m];
    // Values and second derivatives of the four B-splines from `start(i)` on at a site.
    let start = |i: usize| i.min(last - 1);
    let basis = |i: usize, derivative: usize| {
        let mut values = [0.0; 4];
        space.write_basis_in_span(start(i) + 3, sites[i], derivative, &mut values);
        values
    };
    let mut add = |i: usize, left: [f64; 4], j: usize, right: [f64; 4], factor: f64| {
        for p in 0..4 {
            for q in 0..4 {
                let (row, column) = (start(i) + p, start(j) + q);
                let product = left[p] * right[q];
                if product != 0.0 {
                    entries[row * width + column - first(row)] += factor * product;
                }
            }
        }
    };
    for i in 0..=last {
        let (value, bend) = (basis(i, 0), basis(i, 2));
        let weight = (1.0 - sigma) * weights.map_or(1.0, |weights| weights[i]);
        add(i, value, i, value, weight);
        for p in 0..4 {
            right[start(i) + p] = right[start(i) + p] + values[i] * (weight * value[p]);
        }
        if i < last {
            let (h, next) = (sigma * (sites[i + 1] - sites[i]), basis(i + 1, 2));
            add(i, bend, i, bend, h / 3.0);
            add(i, bend, i + 1, next, h / 6.0);
            add(i + 1, next, i, bend, h / 6.0);
            add(i + 1, next, i + 1, next, h / 3.0);
        }
    }
    let mut matrix = BandMatrix::with_capacity(m, m, width);
    for i in 0..m {
        matrix.push_row(first(i), &entries[i * width..(i + 1) * width])?;
    }
    Ok((matrix, right))
}
