//! Smoothing splines: the natural cubic spline `p` with knots `xᵢ` that minimizes
//! `(1 − σ) Σ wᵢ |fᵢ − p(xᵢ)|² + σ ∫ |p″|²`.
//!
//! With the tridiagonal `R` (entries `(hⱼ₋₁ + hⱼ)/3` and `hⱼ/6`) and the second divided differences `V` (columns `1/hⱼ₋₁, −1/hⱼ₋₁ − 1/hⱼ, 1/hⱼ`)
//!
//! ```text
//! ((1 − σ) R + σ Vᵗ W⁻¹ V) u = Vᵗ f,   p(xᵢ) = fᵢ − σ (W⁻¹ V u)ᵢ,   p″(xᵢ) = (1 − σ) uᵢ,
//! ```
//!
//! which is positive definite for all `0 ≤ σ ≤ 1`: from the natural interpolant to the line of least squares.
//!
//! C. H. Reinsch, *Smoothing by spline functions*, 1967. Course: section 5.6.

use crate::core::approximation::cubic_form::spline_from_moments;
use crate::core::approximation::data::{check_finite, check_increasing, check_length, check_weights};
use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::Spline;
use crate::core::linear_system::BandCholesky;
use crate::core::point::Point;

/// How much to smooth, in either convention: `λ = σ/(1 − σ)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Smoothing {
    /// σ from 0 (interpolation) to 1 (line).
    Sigma(f64),
    /// λ from 0 up; `λ → s³ λ` keeps the fitted values when the sites are stretched by `s`.
    Lambda(f64),
}

impl Smoothing {
    /// `(σ, 1 − σ)`.
    fn shares(self) -> Result<(f64, f64), ApproximationError> {
        match self {
            Self::Sigma(value) if (0.0..=1.0).contains(&value) => Ok((value, 1.0 - value)),
            Self::Sigma(value) => Err(ApproximationError::SigmaOutOfRange { name: "σ", value, most: 1.0 }),
            Self::Lambda(value) if (0.0..=f64::MAX).contains(&value) => {
                Ok((value / (1.0 + value), (1.0 + value).recip()))
            }
            Self::Lambda(value) => {
                Err(ApproximationError::SigmaOutOfRange { name: "λ", value, most: f64::MAX })
            }
        }
    }
}

/// A smoothing spline and its measures.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothingSpline<P> {
    /// The spline, with simple exterior knots.
    pub spline: Spline<P>,
    /// `p(xᵢ)`.
    pub fitted: Vec<P>,
    /// Reinsch's unknowns `uᵢ` at the inner sites; `p″(xᵢ) = (1 − σ) uᵢ`. They keep their digits as σ → 1.
    pub unknowns: Vec<P>,
    /// `Σ wᵢ |fᵢ − p(xᵢ)|²`.
    pub residual: f64,
    /// `∫ |p″|²`.
    pub roughness: f64,
    /// Trace of the matrix that maps the data to the fitted values: from the number of data (σ = 0) down to 2 (σ = 1).
    pub degrees_of_freedom: f64,
}

/// The smoothing spline of the data; all weights 1 if none are given.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite`, `SitesNotSorted` unless the sites increase strictly (see [`merge_equal_sites`]), `WeightNotPositive`, `TooFewData` for fewer than
/// two sites, `SigmaOutOfRange`.
pub fn smoothing_spline<P: Point>(
    sites: &[f64], values: &[P], weights: Option<&[f64]>, smoothing: Smoothing,
) -> Result<SmoothingSpline<P>, ApproximationError> {
    let (sigma, rest) = smoothing.shares()?;
    let system = Reinsch::new(sites, values, weights)?;
    system.finish(system.fit(sigma, rest)?)
}

/// Data with one value at each site: of those at equal neighbouring sites the weighted mean, their weights added.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite`, `SitesNotSorted` if a site is smaller than the one before, `WeightNotPositive`.
pub fn merge_equal_sites<P: Point>(
    sites: &[f64], values: &[P], weights: Option<&[f64]>,
) -> Result<(Vec<f64>, Vec<P>, Vec<f64>), ApproximationError> {
    check_length("values", sites.len(), values.len())?;
    check_finite("site", sites)?;
    check_finite("value", values)?;
    check_weights(sites.len(), weights)?;
    let mut merged: (Vec<f64>, Vec<P>, Vec<f64>) = (Vec::new(), Vec::new(), Vec::new());
    for (index, &value) in sites.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[index]);
        match merged.0.last().copied() {
            Some(previous) if value < previous => {
                return Err(ApproximationError::SitesNotSorted { index, value, previous });
            }
            Some(previous) if value <= previous => {
                let last = merged.0.len() - 1;
                merged.2[last] += weight;
                merged.1[last] = merged.1[last].mix(values[index], weight / merged.2[last]);
            }
            _ => {
                merged.0.push(value);
                merged.1.push(values[index]);
                merged.2.push(weight);
            }
        }
    }
    Ok(merged)
}

/// The data and the two band matrices, for many values of σ.
pub(super) struct Reinsch<'a, P> {
    sites: &'a [f64],
    values: &'a [P],
    weights: Option<&'a [f64]>,
    /// Rows `(j, j−2), (j, j−1), (j, j)` of `Vᵗ W⁻¹ V`.
    penalty: Vec<[f64; 3]>,
    /// `Vᵗ f`.
    right: Vec<P>,
}

/// What one value of σ gives.
pub(super) struct Fit<P> {
    rest: f64,
    fitted: Vec<P>,
    unknowns: Vec<P>,
    pub(super) residual: f64,
    pub(super) degrees_of_freedom: f64,
}

impl<'a, P: Point> Reinsch<'a, P> {
    pub(super) fn new(
        sites: &'a [f64], values: &'a [P], weights: Option<&'a [f64]>,
    ) -> Result<Self, ApproximationError> {
        check_length("values", sites.len(), values.len())?;
        check_increasing(sites)?;
        check_finite("value", values)?;
        check_weights(sites.len(), weights)?;
        let found = sites.len();
        if found < 2 {
            return Err(ApproximationError::TooFewData { what: "sites", least: 2, found });
        }
        let inner = found - 2;
        let inverse_weight = |i: usize| weights.map_or(1.0, |weights| weights[i].recip());
        let (mut penalty, mut right) = (Vec::with_capacity(inner), Vec::with_capacity(inner));
        // Column j of V has the entries 1/hⱼ, −1/hⱼ − 1/hⱼ₊₁, 1/hⱼ₊₁ in the rows j, j + 1, j + 2.
        let (mut before, mut middle_before) = (0.0, 0.0);
        let mut a = (sites[1] - sites[0]).recip();
        let mut slope = (values[1] - values[0]) * a;
        let (mut w0, mut w1) = (inverse_weight(0), inverse_weight(1));
        for j in 0..inner {
            let b = (sites[j + 2] - sites[j + 1]).recip();
            let w2 = inverse_weight(j + 2);
            let middle = -a - b;
            penalty.push([
                before * a * w0,
                middle_before * a * w0 + a * middle * w1,
                a * a * w0 + middle * middle * w1 + b * b * w2,
            ]);
            let next_slope = (values[j + 2] - values[j + 1]) * b;
            right.push(next_slope - slope);
            (before, middle_before, a, slope, w0, w1) = (a, middle, b, next_slope, w1, w2);
        }
        Ok(Self { sites, values, weights, penalty, right })
    }

    pub(super) fn sites(&self) -> &[f64] {
        self.sites
    }

    /// The solution for `σ = sigma`, `1 − σ = rest`.
    pub(super) fn fit(&self, sigma: f64, rest: f64) -> Result<Fit<P>, ApproximationError> {
        let (sites, inner) = (self.sites, self.right.len());
        let mut rows = Vec::with_capacity(3 * inner);
        for (penalty, x) in self.penalty.iter().zip(sites.windows(3)) {
            let bend = [0.0, (x[1] - x[0]) / 6.0, (x[2] - x[0]) / 3.0];
            rows.extend([0, 1, 2].map(|p| sigma * penalty[p] + rest * bend[p]));
        }
        let factors = BandCholesky::factor(2, rows)?;
        let mut unknowns = self.right.clone();
        factors.solve(&mut unknowns)?;
        let u = |j: usize| j.checked_sub(1).and_then(|j| unknowns.get(j)).copied().unwrap_or(P::ZERO);
        let mut fitted = Vec::with_capacity(self.values.len());
        let (mut residual, mut before) = (0.0, P::ZERO);
        // (V u)ᵢ is the jump of the slopes (uᵢ₊₁ − uᵢ)/hᵢ, with u = 0 at the ends.
        for (i, &value) in self.values.iter().enumerate() {
            let after = match sites.get(i + 1) {
                Some(next) => (u(i + 1) - u(i)) * (next - sites[i]).recip(),
                None => P::ZERO,
            };
            let weight = self.weights.map_or(1.0, |weights| weights[i]);
            let gap = (after - before) * (sigma / weight);
            residual += weight * square(gap);
            fitted.push(value - gap);
            before = after;
        }
        let inverse = factors.inverse_band();
        let trace: f64 = self
            .penalty
            .iter()
            .zip(inverse.chunks_exact(3))
            .map(|(p, inverse)| p[2] * inverse[2] + 2.0 * (p[1] * inverse[1] + p[0] * inverse[0]))
            .sum();
        let degrees_of_freedom = self.values.len() as f64 - sigma * trace;
        Ok(Fit { rest, fitted, unknowns, residual, degrees_of_freedom })
    }

    /// The spline of a solution.
    pub(super) fn finish(&self, fit: Fit<P>) -> Result<SmoothingSpline<P>, ApproximationError> {
        let (sites, last) = (self.sites, self.sites.len() - 1);
        let mut moments = Vec::with_capacity(sites.len());
        moments.push(P::ZERO);
        moments.extend(fit.unknowns.iter().map(|&u| u * fit.rest));
        moments.push(P::ZERO);
        let outer = (sites[1] - sites[0], sites[last] - sites[last - 1]);
        let spline = spline_from_moments(sites, &fit.fitted, &moments, outer)?;
        // The square of a linear function: h/3 (a² + a b + b²) = h/6 (a² + b² + (a + b)²).
        let roughness = sites
            .windows(2)
            .zip(moments.windows(2))
            .map(|(x, m)| (x[1] - x[0]) / 6.0 * (square(m[0]) + square(m[1]) + square(m[0] + m[1])))
            .sum();
        let Fit { fitted, unknowns, residual, degrees_of_freedom, .. } = fit;
        Ok(SmoothingSpline { spline, fitted, unknowns, residual, roughness, degrees_of_freedom })
    }
}

fn square<P: Point>(point: P) -> f64 {
    (0..P::DIMENSION).map(|i| point.coordinate(i) * point.coordinate(i)).sum()
}
