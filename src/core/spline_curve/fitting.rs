//! Parameters, knots and least squares for sequences of points.
//!
//! Parameters from chord lengths: J. H. Ahlberg, E. N. Nilson, J. L. Walsh, 1967; centripetal: E. T. Y. Lee, 1989. Their correction: J. Hoschek, *Intrinsic
//! parametrization for approximation*, 1988. Beyond the course (B.16).

use glam::DVec2;
use thiserror::Error;

use crate::core::approximation::{ApproximationError, check_determined, least_squares};
use crate::core::bspline::{EndKnots, MAX_DEGREE, Side, Spline, SplineError, SplineSpace};
use crate::core::linear_system::BandLeastSquares;
use crate::core::point::Point;
use crate::core::spline_curve::fitting_stroke::StrokeFit;

/// Why points cannot be fitted.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FittingError {
    /// There are no points.
    #[error("no points are given")]
    Empty,
    /// Fewer than two different points.
    #[error("{found} different points are given, at least {least} are needed")]
    TooFewData {
        /// The smallest possible number.
        least: usize,
        /// How many differ.
        found: usize,
    },
    /// The tolerance is negative or not a number.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
    /// The tolerance was not reached with as many coefficients as allowed.
    #[error("the tolerance is not reached with {} control points: the error is {}", .best.curve.points().len(), .best.max_error)]
    StepLimit {
        /// The best curve found.
        best: Box<StrokeFit>,
    },
    /// The data do not suit the space.
    #[error(transparent)]
    Approximation(#[from] ApproximationError),
    /// The knots or coefficients are invalid.
    #[error(transparent)]
    Spline(#[from] SplineError),
}

impl FittingError {
    /// The name of the error in the conventions of the course, for example `TooFewData`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::TooFewData { .. } => "TooFewData",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::StepLimit { .. } => "StepLimit",
            Self::Approximation(error) => error.name(),
            Self::Spline(error) => error.name(),
        }
    }
}

/// Parameters from 0 to 1 with `tₖ₊₁ − tₖ ∝ |pₖ₊₁ − pₖ|^α`: `α = 1` chord length, `1/2` centripetal, `0` uniform.
///
/// # Errors
///
/// `Empty`, `NonFinite`, `TooFewData` if all points are equal.
pub fn parameters<P: Point>(points: &[P], alpha: f64) -> Result<Vec<f64>, FittingError> {
    if points.is_empty() {
        return Err(FittingError::Empty);
    }
    if let Some(index) = points.iter().position(|point| !point.is_finite()) {
        let value = points[index].norm();
        return Err(SplineError::NonFinite { what: "point", index, value }.into());
    }
    let mut sums = vec![0.0];
    for pair in points.windows(2) {
        let length = (pair[1] - pair[0]).norm();
        sums.push(sums[sums.len() - 1] + if length > 0.0 { length.powf(alpha) } else { 0.0 });
    }
    let total = sums[sums.len() - 1];
    if !(total > 0.0 && total.is_finite()) {
        return Err(FittingError::TooFewData { least: 2, found: 1 });
    }
    Ok(sums.into_iter().map(|sum| sum / total).collect())
}

/// The space of `degree` with `count` coefficients and end-interpolating knots that spreads the increasing parameters evenly: with `d = (M + 1)/(m − n)` for `M + 1`
/// parameters the inner knot `j` is `(1 − f) tᵢ₋₁ + f tᵢ`, `i = ⌊j d⌋`, `f = j d − i`. Every knot interval contains parameters.
///
/// # Errors
///
/// `TooFewData` for fewer parameters than coefficients or coefficients than `degree + 1`; those of [`SplineSpace::new`].
pub fn spread_knots(t: &[f64], degree: usize, count: usize) -> Result<SplineSpace, FittingError> {
    let least = count.max(degree + 1).max(2);
    if count <= degree || t.len() < least {
        return Err(FittingError::TooFewData { least, found: t.len().min(count) });
    }
    let step = t.len() as f64 / (count - degree) as f64;
    let mut breaks = vec![t[0]];
    for j in 1..count - degree {
        let at = j as f64 * step;
        let i = (at.floor() as usize).clamp(1, t.len() - 1);
        breaks.push(t[i - 1].mix(t[i], at - i as f64));
    }
    breaks.push(t[t.len() - 1]);
    Ok(SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating)?)
}

/// Whether the ends of a fitted spline are the first and the last point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitEnds {
    /// As near as the other points.
    Free,
    /// Exactly; the knots must be end-interpolating.
    Fixed,
}

/// The spline of `space` for which `Σ |pₖ − p(tₖ)|²` is smallest, and the residuals `pₖ − p(tₖ)`. The parameters must not decrease.
///
/// # Errors
///
/// Those of [`least_squares`]; `NoSolution` for fixed ends if the knots at the ends are not `n`-fold.
pub fn fit_least_squares<P: Point>(
    points: &[P],
    t: &[f64],
    space: SplineSpace,
    ends: FitEnds,
) -> Result<(Spline<P>, Vec<P>), FittingError> {
    let spline = match ends {
        FitEnds::Free => least_squares(space, t, points, None)?.spline,
        FitEnds::Fixed => with_fixed_ends(points, t, space)?,
    };
    let residual = |(&point, &t): (&P, &f64)| Ok(point - spline.evaluate(t)?);
    let residuals = points.iter().zip(t).map(residual).collect::<Result<_, SplineError>>()?;
    Ok((spline, residuals))
}

fn with_fixed_ends<P: Point>(points: &[P], t: &[f64], space: SplineSpace) -> Result<Spline<P>, FittingError> {
    let (n, m) = (space.degree(), space.dimension());
    let (left, right) = space.parameter_interval();
    if space.is_periodic() || space.multiplicity(left) < n || space.multiplicity(right) < n {
        let reason = "only end-interpolating knots can fix the ends".to_owned();
        return Err(ApproximationError::NoSolution { reason }.into());
    }
    let (&[first, .., last], true) = (points, points.len() == t.len()) else {
        return Err(FittingError::TooFewData { least: 2, found: points.len().min(t.len()) });
    };
    check_determined(&space, t)?;
    let inner = m - 2;
    let width = (n + 1).min(inner);
    let mut system = BandLeastSquares::new(inner, width);
    let mut basis = [0.0; MAX_DEGREE + 1];
    let mut row = [0.0; MAX_DEGREE + 1];
    for (&point, &at) in points.iter().zip(t) {
        let start = space.write_active_basis(at, &mut basis[..=n])?;
        let mut value = point;
        let from = start.saturating_sub(1).min(inner - width);
        row[..width].fill(0.0);
        for (k, &entry) in basis[..=n].iter().enumerate() {
            match start + k {
                0 => value = value - first * entry,
                last_one if last_one == m - 1 => value = value - last * entry,
                // A B-spline outside the row vanishes at this end of the row's range.
                middle => {
                    if let Some(place) = row[..width].get_mut((middle - 1).wrapping_sub(from)) {
                        *place = entry;
                    }
                }
            }
        }
        if width > 0 {
            system.add(from, &mut row[..width], value).map_err(ApproximationError::from)?;
        }
    }
    let mut coefficients = vec![first];
    if width > 0 {
        coefficients.extend(system.solve().map_err(ApproximationError::from)?);
    }
    coefficients.push(last);
    Ok(Spline::new(space, coefficients)?)
}

/// One step from `t` towards the foot of `place` on the curve by Gauss and Newton, `t − (p − q)·p′/|p′|²`, and by Newton, with `(p − q)·p″` added to the denominator: nearer
/// in the end, but it may overshoot or find a maximum.
///
/// # Errors
///
/// Those of [`Spline::evaluate`].
pub fn foot_steps(curve: &Spline<DVec2>, place: DVec2, t: f64) -> Result<[f64; 2], SplineError> {
    let at = curve.derivatives(t, 2, Side::Right)?;
    let gap = at[0] - place;
    let (way, square) = (gap.dot(at[1]), at[1].length_squared());
    let step = |denominator: f64| if denominator == 0.0 { t } else { t - way / denominator };
    Ok([step(square), step(square + gap.dot(at[2]))])
}

/// The parameters after one step of [`foot_steps`] by Gauss and Newton, kept in order and inside D; the first and the last one stay.
///
/// # Errors
///
/// Those of [`Spline::evaluate`].
pub fn correct_parameters(
    curve: &Spline<DVec2>,
    points: &[DVec2],
    t: &[f64],
) -> Result<Vec<f64>, SplineError> {
    let mut corrected = t.to_vec();
    for k in 1..points.len().min(t.len()).saturating_sub(1) {
        let [step, _] = foot_steps(curve, points[k], t[k])?;
        // Half way to the neighbours at most, so that the order stays.
        let (low, high) = (t[k - 1].midpoint(t[k]), t[k].midpoint(t[k + 1]));
        corrected[k] = if step.is_finite() { step.clamp(low, high) } else { t[k] };
    }
    Ok(corrected)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn data_on_a_spline_of_the_space_give_it_back(
            degree in 1_usize..5,
            spread in 0_usize..5,
            heights in prop::collection::vec(-3.0..3.0_f64, 30),
        ) {
            let t: Vec<f64> = (0..30).map(|k| f64::from(k) / 29.0).collect();
            let space = spread_knots(&t, degree, degree + 1 + spread).unwrap();
            let coefficients = heights[..space.dimension()].to_vec();
            let spline = Spline::new(space.clone(), coefficients.clone()).unwrap();
            let values: Vec<f64> = t.iter().map(|&t| spline.evaluate(t).unwrap()).collect();
            for ends in [FitEnds::Free, FitEnds::Fixed] {
                let (fit, residuals) = fit_least_squares(&values, &t, space.clone(), ends).unwrap();
                for (a, b) in fit.coefficients().iter().zip(&coefficients) {
                    prop_assert!((a - b).abs() < 1e-10, "{ends:?}: {a}, {b}");
                }
                prop_assert!(residuals.iter().all(|r| r.abs() < 1e-11), "{ends:?}: {residuals:?}");
            }
        }

        #[test]
        fn a_residual_is_orthogonal_to_the_splines_with_zero_ends(
            heights in prop::collection::vec(-3.0..3.0_f64, 20),
            count in 4_usize..10,
        ) {
            let t: Vec<f64> = (0..20).map(|k| f64::from(k) / 19.0).collect();
            let space = spread_knots(&t, 3, count).unwrap();
            let (fit, residuals) = fit_least_squares(&heights, &t, space.clone(), FitEnds::Fixed).unwrap();
            prop_assert_eq!(fit.evaluate(0.0).unwrap(), heights[0], "start");
            for k in 1..count - 1 {
                let mut one = vec![0.0; count];
                one[k] = 1.0;
                let b = Spline::new(space.clone(), one).unwrap();
                let product: f64 = t.iter().zip(&residuals).map(|(&t, r)| b.evaluate(t).unwrap() * r).sum();
                prop_assert!(product.abs() < 1e-10, "B-spline {k}: {product}");
            }
        }
    }

    #[test]
    fn corrected_parameters_stay_in_order() {
        let space = SplineSpace::from_breaks(3, &[0.0, 0.5, 1.0], EndKnots::Interpolating).unwrap();
        let points = [[0.0, 0.0], [1.0, 2.0], [2.0, -2.0], [3.0, 2.0], [4.0, 0.0]].map(DVec2::from);
        let curve = Spline::new(space, points.to_vec()).unwrap();
        let t: Vec<f64> = (0..40).map(|k| f64::from(k) / 39.0).collect();
        let places: Vec<DVec2> = (0..40).map(|k| DVec2::new(f64::from(k * 17 % 40) * 0.1, 0.3)).collect();
        let corrected = correct_parameters(&curve, &places, &t).unwrap();
        assert!(corrected.windows(2).all(|pair| pair[0] <= pair[1]), "{corrected:?}");
        assert_eq!((corrected[0], corrected[39]), (0.0, 1.0), "the ends stay");
    }

    #[test]
    fn bad_data_are_named() {
        assert_eq!(parameters::<DVec2>(&[], 1.0).unwrap_err().name(), "Empty", "nothing");
        assert_eq!(parameters(&[DVec2::NAN, DVec2::X], 1.0).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(parameters(&[DVec2::X; 4], 0.5).unwrap_err().name(), "TooFewData", "one place");
        assert_eq!(spread_knots(&[0.0, 1.0], 3, 4).unwrap_err().name(), "TooFewData", "two parameters");
        let open = SplineSpace::uniform(2, 0.0, 1.0, 2).unwrap();
        let t = [0.0, 0.3, 0.6, 1.0];
        let fit = fit_least_squares(&[0.0; 4], &t, open, FitEnds::Fixed);
        assert_eq!(fit.unwrap_err().name(), "NoSolution", "simple end knots");
    }
}
