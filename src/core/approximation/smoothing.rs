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
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
    smoothing: Smoothing,
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
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
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
        sites: &'a [f64],
        values: &'a [P],
        weights: Option<&'a [f64]>,
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
        let spline = spline_from_moments(sites, &fit.fitted, &moments, outer, 0)?;
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::approximation::cubic_interpolation::natural_spline;
    use crate::core::approximation::smoothing_choice::smoothing_for_residual;
    use crate::core::approximation::smoothing_system::smoothing_system;
    use crate::core::bspline::Side;
    use glam::DVec2;
    use proptest::prelude::*;

    prop_compose! {
        fn data()(rows in prop::collection::vec((0.05..2.0_f64, -4.0..4.0_f64, 0.2..5.0_f64), 2..15))
            -> (Vec<f64>, Vec<f64>, Vec<f64>)
        {
            let x = rows.iter().scan(-1.0, |at, row| { *at += row.0; Some(*at) }).collect();
            (x, rows.iter().map(|row| row.1).collect(), rows.iter().map(|row| row.2).collect())
        }
    }

    proptest! {
        #[test]
        fn both_systems_agree_and_the_residuals_balance((x, f, w) in data(), sigma in 0.01..0.99_f64) {
            let fit = smoothing_spline(&x, &f, Some(&w), Smoothing::Sigma(sigma)).unwrap();
            let (matrix, right) = smoothing_system(&x, &f, Some(&w), sigma).unwrap();
            let left = matrix.multiply(fit.spline.coefficients()).unwrap();
            let size = matrix.iter().fold(1.0_f64, |size, entry| size.max(entry.2.abs()));
            for (a, b) in left.iter().zip(&right) {
                prop_assert!((a - b).abs() < 1e-11 * size, "Q c = q: {} and {}", a, b);
            }
            let (mut force, mut moment, mut residual) = (0.0, 0.0, 0.0);
            for i in 0..x.len() {
                // The value of the spline and the solution of the system: close sites magnify rounding.
                prop_assert!((fit.spline.evaluate(x[i]).unwrap() - fit.fitted[i]).abs() < 1e-10, "fitted {}", i);
                let gap = f[i] - fit.fitted[i];
                force += w[i] * gap;
                moment += w[i] * gap * x[i];
                residual += w[i] * gap * gap;
            }
            prop_assert!(force.abs() < 1e-9 && moment.abs() < 1e-9, "{} {}", force, moment);
            prop_assert!((residual - fit.residual).abs() < 1e-9, "{} {}", residual, fit.residual);
            let last = x.len() - 1;
            let bends = [(x[0], Side::Right), (x[last], Side::Left)]
                .map(|(x, side)| fit.spline.derivatives(x, 2, side).unwrap()[2]);
            prop_assert!(bends.iter().all(|bend| bend.abs() < 1e-8), "natural ends: {:?}", bends);
        }

        #[test]
        fn more_smoothing_leaves_more_and_bends_less((x, f, w) in data()) {
            let fits: Vec<_> = [0.0, 0.1, 0.4, 0.8, 0.99, 1.0]
                .into_iter()
                .map(|sigma| smoothing_spline(&x, &f, Some(&w), Smoothing::Sigma(sigma)).unwrap())
                .collect();
            for pair in fits.windows(2) {
                prop_assert!(pair[0].residual <= pair[1].residual + 1e-12, "residual");
                prop_assert!(pair[0].roughness >= pair[1].roughness - 1e-12, "roughness");
                prop_assert!(pair[0].degrees_of_freedom >= pair[1].degrees_of_freedom - 1e-9, "freedom");
            }
            prop_assert_eq!(fits[0].degrees_of_freedom, x.len() as f64, "interpolation");
            prop_assert!((fits[5].degrees_of_freedom - 2.0).abs() < 1e-8, "a line");
            let natural = natural_spline(&x, &f).unwrap();
            for (a, b) in fits[0].spline.coefficients().iter().zip(natural.coefficients()) {
                prop_assert!((a - b).abs() < 1e-9, "natural spline: {} and {}", a, b);
            }
            let wanted = 0.5 * fits[5].residual;
            let (fit, sigma) = smoothing_for_residual(&x, &f, Some(&w), wanted).unwrap();
            prop_assert!((fit.residual - wanted).abs() <= 1e-9 * (1.0 + wanted), "{} of {}", fit.residual, wanted);
            prop_assert!((0.0..=1.0).contains(&sigma), "{}", sigma);
        }

        #[test]
        fn the_trace_counts_the_influence_of_each_datum((x, f, w) in data(), sigma in 0.0..=1.0_f64) {
            let trace: f64 = (0..x.len()).map(|i| {
                let unit: Vec<f64> = (0..x.len()).map(|j| f64::from(u8::from(i == j))).collect();
                smoothing_spline(&x, &unit, Some(&w), Smoothing::Sigma(sigma)).unwrap().fitted[i]
            }).sum();
            let fit = smoothing_spline(&x, &f, Some(&w), Smoothing::Sigma(sigma)).unwrap();
            prop_assert!((trace - fit.degrees_of_freedom).abs() < 1e-8, "{} {}", trace, fit.degrees_of_freedom);
        }
    }

    #[test]
    fn a_double_weight_is_two_data_at_one_site() {
        let (x, f, w) = merge_equal_sites(
            &[0.0, 1.0, 1.0, 2.0, 4.0],
            &[1.0, 3.0, 0.0, 2.0, 5.0],
            Some(&[1.0, 1.0, 2.0, 1.0, 1.0]),
        )
        .unwrap();
        assert_eq!(
            (x.as_slice(), w.as_slice()),
            (&[0.0, 1.0, 2.0, 4.0][..], &[1.0, 3.0, 1.0, 1.0][..]),
            "merged"
        );
        assert!((f[1] - 1.0).abs() < 1e-15, "the mean of 3, 0 and 0");
        assert_eq!(
            merge_equal_sites(&[1.0, 0.0], &[0.0; 2], None).unwrap_err().name(),
            "SitesNotSorted",
            "falls"
        );
    }

    #[test]
    fn lines_are_returned_unchanged_and_bad_data_are_named() {
        let x = [0.0, 1.0, 1.5, 4.0];
        let line: Vec<DVec2> = x.iter().map(|&x| DVec2::new(2.0 * x - 1.0, 3.0)).collect();
        for smoothing in
            [Smoothing::Sigma(0.0), Smoothing::Sigma(0.5), Smoothing::Sigma(1.0), Smoothing::Lambda(1e9)]
        {
            let fit = smoothing_spline(&x, &line, None, smoothing).unwrap();
            assert!(fit.residual < 1e-28 && fit.roughness < 1e-28, "{smoothing:?}: {fit:?}");
        }
        let name = |x: &[f64], w: Option<&[f64]>, smoothing| {
            smoothing_spline(x, &vec![1.0; x.len()], w, smoothing).unwrap_err().name()
        };
        for bad in [Smoothing::Sigma(1.5), Smoothing::Sigma(f64::NAN), Smoothing::Lambda(-1.0)] {
            assert_eq!(name(&x, None, bad), "SigmaOutOfRange", "{bad:?}");
        }
        let half = Smoothing::Sigma(0.5);
        assert_eq!(name(&[0.0, 1.0, 1.0], None, half), "SitesNotSorted", "equal sites");
        assert_eq!(name(&[0.0], None, half), "TooFewData", "one site");
        assert_eq!(name(&x, Some(&[1.0, 1.0, -1.0, 1.0]), half), "WeightNotPositive", "negative");
        assert_eq!(name(&x, Some(&[1.0, f64::NAN, 1.0, 1.0]), half), "WeightNotPositive", "no number");
        let error = smoothing_for_residual(&x, &line, None, -1.0).unwrap_err();
        assert_eq!(error.name(), "InvalidTolerance", "negative residual");
    }
}
