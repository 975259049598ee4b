//! Checks that the methods of this chapter share.

use crate::core::approximation::error::ApproximationError;
use crate::core::point::Point;

/// `found` entries must be as many as the sites.
pub(super) fn check_length(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), ApproximationError> {
    if expected == found { Ok(()) } else { Err(ApproximationError::SizeMismatch { what, expected, found }) }
}

/// All coordinates finite; the index is that of the point.
pub(super) fn check_finite<P: Point>(what: &'static str, points: &[P]) -> Result<(), ApproximationError> {
    // Without an early exit the loop runs in vector registers; a sum would overflow.
    let fine = points.iter().fold(true, |fine, point| fine & point.is_finite());
    match (!fine).then(|| points.iter().position(|point| !point.is_finite())).flatten() {
        Some(index) => {
            let coordinates = (0..P::DIMENSION).map(|i| points[index].coordinate(i));
            let value = coordinates.into_iter().find(|value| !value.is_finite()).unwrap_or(f64::NAN);
            Err(ApproximationError::NonFinite { what, index, value })
        }
        None => Ok(()),
    }
}

/// Finite and strictly increasing.
pub(super) fn check_increasing(sites: &[f64]) -> Result<(), ApproximationError> {
    let fine = sites.windows(2).fold(true, |fine, pair| fine & (pair[0] < pair[1]));
    let ends = sites.first().zip(sites.last()).is_none_or(|(a, b)| a.is_finite() && b.is_finite());
    if fine && ends {
        return Ok(());
    }
    check_finite("site", sites)?;
    let index = sites.windows(2).position(|pair| pair[0] >= pair[1]).unwrap_or(0) + 1;
    Err(ApproximationError::SitesNotSorted { index, value: sites[index], previous: sites[index - 1] })
}

/// As many positive finite weights as sites, if there are any.
pub(super) fn check_weights(count: usize, weights: Option<&[f64]>) -> Result<(), ApproximationError> {
    let Some(weights) = weights else { return Ok(()) };
    check_length("weights", count, weights.len())?;
    match weights.iter().position(|weight| !(*weight > 0.0 && weight.is_finite())) {
        Some(index) if weights[index] == f64::INFINITY => {
            Err(ApproximationError::NonFinite { what: "weight", index, value: weights[index] })
        }
        Some(index) => Err(ApproximationError::WeightNotPositive { index, value: weights[index] }),
        None => Ok(()),
    }
}
