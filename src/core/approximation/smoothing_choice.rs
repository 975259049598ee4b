//! The smoothing parameter from the data: by generalized cross-validation, or for a given residual.
//!
//! `GCV(λ) = (1/N) Σ wᵢ |fᵢ − aᵢ|² / (1 − tr H/N)²`, where `H` maps the data to the fitted values `a`.
//!
//! P. Craven, G. Wahba, *Smoothing noisy data with spline functions*, 1979. Course: section 5.6.

use crate::core::approximation::error::ApproximationError;
use crate::core::approximation::smoothing::{Reinsch, SmoothingSpline};
use crate::core::point::Point;

/// Step of the first search in ln λ, and where the golden section ends: the minimum is flat.
const COARSE_STEP: f64 = 0.5;
const FINE_STEP: f64 = 1e-7;
/// ln λ, relative to the natural scale `h³ w`, where smoothing has no effect any more.
const LEAST: f64 = -14.0;
/// Bisections of an interval of ln λ.
const BISECTIONS: usize = 60;

/// The smoothing spline that cross-validation chooses.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossValidation<P> {
    /// The spline.
    pub smoothing: SmoothingSpline<P>,
    /// λ.
    pub lambda: f64,
    /// `σ = λ/(1 + λ)`.
    pub sigma: f64,
    /// `GCV(λ)`, the smallest found.
    pub score: f64,
    /// `(λ, GCV(λ))` over the whole range that was searched.
    pub curve: Vec<(f64, f64)>,
}

/// The smoothing spline with the smallest generalized cross-validation score: a grid in ln λ, then a golden section.
///
/// # Errors
///
/// As [`smoothing_spline`](super::smoothing_spline), `TooFewData` for fewer than four sites.
pub fn smoothing_by_cross_validation<P: Point>(
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
) -> Result<CrossValidation<P>, ApproximationError> {
    let system = Reinsch::new(sites, values, weights)?;
    let count = sites.len();
    if count < 4 {
        return Err(ApproximationError::TooFewData { what: "sites", least: 4, found: count });
    }
    let score = |log: f64| -> Result<f64, ApproximationError> {
        let (sigma, rest) = shares(log);
        let fit = system.fit(sigma, rest)?;
        let free = 1.0 - fit.degrees_of_freedom / count as f64;
        Ok(fit.residual / (count as f64 * free * free))
    };
    let scale = natural_scale(&system, weights);
    let steps = ((4.0 * (count as f64).ln() + 5.0 - LEAST) / COARSE_STEP).ceil() as usize;
    let grid: Vec<f64> = (0..=steps).map(|i| scale + LEAST + COARSE_STEP * i as f64).collect();
    let scores = grid.iter().map(|&log| score(log)).collect::<Result<Vec<_>, _>>()?;
    let best = (0..=steps).min_by(|&i, &j| scores[i].total_cmp(&scores[j])).unwrap_or(0);
    let (mut low, mut high) = (grid[best.saturating_sub(1)], grid[(best + 1).min(steps)]);
    // The golden section keeps two inner points; each step reuses one.
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_left, mut at_right) = (score(left)?, score(right)?);
    while high - low > FINE_STEP {
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - golden * (high - low);
            at_left = score(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + golden * (high - low);
            at_right = score(right)?;
        }
    }
    let (log, score) = if at_left <= at_right { (left, at_left) } else { (right, at_right) };
    let (sigma, rest) = shares(log);
    Ok(CrossValidation {
        smoothing: system.finish(system.fit(sigma, rest)?)?,
        lambda: log.exp(),
        sigma,
        score,
        curve: grid.into_iter().map(f64::exp).zip(scores).collect(),
    })
}

/// The smoothest spline with `Σ wᵢ |fᵢ − p(xᵢ)|² ≤ residual`, and its σ: the line if that is good enough, the interpolant for 0.
///
/// # Errors
///
/// As [`smoothing_spline`](super::smoothing_spline), `InvalidTolerance` for a residual that is negative or not a number.
pub fn smoothing_for_residual<P: Point>(
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
    residual: f64,
) -> Result<(SmoothingSpline<P>, f64), ApproximationError> {
    let system = Reinsch::new(sites, values, weights)?;
    if residual < 0.0 || residual.is_nan() {
        return Err(ApproximationError::InvalidTolerance { value: residual });
    }
    let line = system.fit(1.0, 0.0)?;
    if line.residual <= residual {
        return Ok((system.finish(line)?, 1.0));
    }
    // The residual grows with λ; `low` keeps to it, `high` does not.
    let scale = natural_scale(&system, weights);
    let (mut low, mut high) = (scale - 300.0, scale + 300.0);
    let (sigma, rest) = shares(low);
    let mut fit = system.fit(sigma, rest)?;
    if fit.residual > residual {
        return Ok((system.finish(system.fit(0.0, 1.0)?)?, 0.0));
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let (sigma, rest) = shares(middle);
        let next = system.fit(sigma, rest)?;
        if next.residual <= residual {
            (low, fit) = (middle, next);
        } else {
            high = middle;
        }
    }
    Ok((system.finish(fit)?, shares(low).0))
}

/// `(σ, 1 − σ)` for ln λ, without overflow.
fn shares(log: f64) -> (f64, f64) {
    ((1.0 + (-log).exp()).recip(), (1.0 + log.exp()).recip())
}

/// `ln(h³ w)` with the mean spacing and the mean weight.
fn natural_scale<P: Point>(system: &Reinsch<'_, P>, weights: Option<&[f64]>) -> f64 {
    let sites = system.sites();
    let count = sites.len() as f64;
    let spacing = (sites[sites.len() - 1] - sites[0]) / (count - 1.0);
    let weight = weights.map_or(1.0, |weights| weights.iter().map(|weight| weight / count).sum());
    3.0 * spacing.ln() + weight.ln()
}
