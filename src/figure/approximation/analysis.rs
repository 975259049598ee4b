//! The splines of all methods, and how far they are from the function and the data.

use std::sync::Arc;

use crate::core::approximation::{
    ApproximationError, EndConditions, Smoothing, averaged_knots, cubic_interpolation, interpolate,
    least_squares, schoenberg, smoothing_spline,
};
use crate::core::bspline::{EndKnots, Spline, SplineSpace};
use crate::document::{Approximation, CubicEnds, KnotChoice, Method, Scheme};

/// About so many places are looked at for the largest error.
const SAMPLES: usize = 6000;
/// Places in each knot interval.
const SAMPLES_PER_INTERVAL: std::ops::RangeInclusive<usize> = 3..=48;
/// Steps of the golden section around the largest sample; each shortens the interval by 0.618.
const REFINEMENTS: usize = 36;

/// A largest size, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The size.
    pub size: f64,
    /// The place.
    pub at: f64,
}

/// What a method gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The spline.
    pub spline: Spline<f64>,
    /// `max |p − f|` over the part of D where the function is looked at.
    pub from_function: Option<Extreme>,
    /// `max |p(xᵢ) − yᵢ|` over the data in D.
    pub from_data: Option<Extreme>,
    /// `(Σ wᵢ (p(xᵢ) − yᵢ)² / Σ wᵢ)^½`.
    pub root_mean_square: Option<f64>,
    /// Smoothing: `∫ |p″|²`.
    pub roughness: Option<f64>,
    /// Smoothing: the trace of the matrix that maps data to fitted values.
    pub degrees_of_freedom: Option<f64>,
}

impl Fit {
    /// `p(x)`; NaN outside D.
    pub fn value(&self, x: f64) -> f64 {
        self.spline.evaluate(x).unwrap_or(f64::NAN)
    }

    /// The largest error: from the function, or from the data if there is none.
    pub fn error(&self) -> Option<Extreme> {
        self.from_function.or(self.from_data)
    }
}

/// What all methods give, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Analysis {
    /// One entry for each method.
    pub fits: Vec<Result<Arc<Fit>, Arc<ApproximationError>>>,
}

/// Computes all methods; what `before` has for the same data and the same settings is taken over.
pub fn analyse(approximation: &Approximation, before: Option<(&Approximation, &Analysis)>) -> Analysis {
    let before = before.filter(|(old, _)| old.has_same_data(approximation));
    let known = |method: &Method| {
        let (old, analysis) = before?;
        let index = old.methods().iter().position(|other| other.scheme == method.scheme)?;
        analysis.fits.get(index).cloned()
    };
    let fits = approximation.methods().iter();
    let fits = fits.map(|method| {
        known(method).unwrap_or_else(|| fit(approximation, &method.scheme).map(Arc::new).map_err(Arc::new))
    });
    Analysis { fits: fits.collect() }
}

/// Computes one method.
///
/// # Errors
///
/// Those of the method in [`crate::core::approximation`]; `OutsideInterval` for a knot that is not inside the interval.
pub fn fit(approximation: &Approximation, scheme: &Scheme) -> Result<Fit, ApproximationError> {
    let (sites, values) = (approximation.sites(), approximation.values());
    let (mut roughness, mut degrees_of_freedom) = (None, None);
    let spline = match scheme {
        Scheme::Cubic { ends } => cubic_interpolation(sites, values, end_conditions(*ends))?,
        Scheme::Interpolation { degree, knots } => {
            interpolate(space(approximation, scheme, *degree, knots)?, sites, values)?
        }
        Scheme::LeastSquares { degree, knots } => {
            let space = space(approximation, scheme, *degree, knots)?;
            least_squares(space, sites, values, approximation.weights())?.spline
        }
        Scheme::Smoothing { sigma } => {
            let result = smoothing_spline(sites, values, approximation.weights(), Smoothing::Sigma(*sigma))?;
            roughness = Some(result.roughness);
            degrees_of_freedom = Some(result.degrees_of_freedom);
            result.spline
        }
        Scheme::Schoenberg { degree, knots } => {
            let space = space(approximation, scheme, *degree, knots)?;
            match approximation.function() {
                Some(function) => schoenberg(space, |x| function.value(x))?,
                None => {
                    check_count(sites.len())?;
                    schoenberg(space, |x| broken_line(sites, values, x))?
                }
            }
        }
    };
    let mut fit = Fit {
        spline,
        from_function: None,
        from_data: None,
        root_mean_square: None,
        roughness,
        degrees_of_freedom,
    };
    measure(approximation, &mut fit);
    Ok(fit)
}

/// The knots that a method has on its line, and whether they can be moved: those that are given, else those of the spline in D.
pub fn knots_of(method: &Method, fit: Option<&Fit>) -> (Vec<f64>, bool) {
    match method.scheme.space() {
        Some((_, KnotChoice::Inner(knots) | KnotChoice::All(knots))) => (knots.clone(), true),
        choice => {
            let knots = fit.map_or_else(Vec::new, |fit| {
                let space = fit.spline.space();
                let (left, right) = space.parameter_interval();
                let inside = |knot: &&f64| left < **knot && **knot < right;
                let all = space.knots().iter();
                if space.is_periodic() { space.breaks() } else { all.filter(inside).copied().collect() }
            });
            (knots, choice.is_some())
        }
    }
}

/// The interval of the end-interpolating knots of `scheme`.
pub(super) fn interval(approximation: &Approximation, scheme: &Scheme) -> Option<(f64, f64)> {
    match (scheme, approximation.function()) {
        (Scheme::Schoenberg { .. }, Some(function)) => Some(function.interval()),
        _ => approximation.data_interval(),
    }
}

fn end_conditions(ends: CubicEnds) -> EndConditions<f64> {
    match ends {
        CubicEnds::NotAKnot => EndConditions::NotAKnot,
        CubicEnds::Natural => EndConditions::Natural,
        CubicEnds::Clamped { start, end } => EndConditions::Clamped { start, end },
        CubicEnds::SecondDerivatives { start, end } => EndConditions::SecondDerivative { start, end },
        CubicEnds::Periodic => EndConditions::Periodic,
    }
}

fn check_count(found: usize) -> Result<(), ApproximationError> {
    if found < 2 { Err(ApproximationError::TooFewData { what: "data", least: 2, found }) } else { Ok(()) }
}

fn space(
    approximation: &Approximation,
    scheme: &Scheme,
    degree: usize,
    knots: &KnotChoice,
) -> Result<SplineSpace, ApproximationError> {
    match knots {
        KnotChoice::Averaged => averaged_knots(degree, approximation.sites()),
        KnotChoice::All(knots) => Ok(SplineSpace::from_either_convention(degree, knots.clone())?),
        KnotChoice::Inner(knots) => {
            let Some((left, right)) = interval(approximation, scheme) else {
                check_count(approximation.len())?;
                return Err(ApproximationError::TooFewData { what: "data", least: 2, found: 0 });
            };
            if let Some(index) = knots.iter().position(|&knot| knot <= left || right <= knot) {
                let value = knots[index];
                return Err(ApproximationError::OutsideInterval { what: "knot", index, value, left, right });
            }
            let breaks: Vec<f64> = [left].into_iter().chain(knots.iter().copied()).chain([right]).collect();
            Ok(SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating)?)
        }
    }
}

/// The broken line through two or more data, its first and its last piece prolonged.
fn broken_line(sites: &[f64], values: &[f64], x: f64) -> f64 {
    let right = sites.partition_point(|&site| site <= x).clamp(1, sites.len() - 1);
    let (a, b) = (sites[right - 1], sites[right]);
    let share = (x - a) / (b - a);
    values[right - 1] * (1.0 - share) + values[right] * share
}

fn measure(approximation: &Approximation, fit: &mut Fit) {
    let space = fit.spline.space();
    let (left, right) = space.parameter_interval();
    if let Some(function) = approximation.function() {
        let (from, to) = function.interval();
        let (from, to) = (from.max(left), to.min(right));
        let error = |x: f64| (fit.value(x) - function.value(x)).abs();
        let mut breaks: Vec<f64> = space.breaks().into_iter().filter(|&x| from < x && x < to).collect();
        breaks.insert(0, from);
        breaks.push(to);
        fit.from_function = if from < to { largest(&breaks, error) } else { None };
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    let mut extreme: Option<Extreme> = None;
    for (index, (&at, &value)) in approximation.sites().iter().zip(approximation.values()).enumerate() {
        let size = (fit.value(at) - value).abs();
        if !size.is_finite() {
            continue;
        }
        let weight = approximation.weight(index);
        sum += weight * size * size;
        weights += weight;
        if extreme.is_none_or(|extreme| size > extreme.size) {
            extreme = Some(Extreme { size, at });
        }
    }
    fit.from_data = extreme;
    fit.root_mean_square = (weights > 0.0).then(|| (sum / weights).sqrt());
}

/// The largest finite value of `error` over intervals with ends `breaks`.
fn largest(breaks: &[f64], error: impl Fn(f64) -> f64) -> Option<Extreme> {
    let intervals = breaks.len().saturating_sub(1).max(1);
    let count = (SAMPLES / intervals).clamp(*SAMPLES_PER_INTERVAL.start(), *SAMPLES_PER_INTERVAL.end());
    let mut best: Option<(Extreme, f64, f64)> = None;
    for pair in breaks.windows(2) {
        let step = (pair[1] - pair[0]) / count as f64;
        for sample in 0..=count {
            let at = if sample == count { pair[1] } else { pair[0] + step * sample as f64 };
            let size = error(at);
            if size.is_finite() && best.is_none_or(|(best, ..)| size > best.size) {
                best = Some((Extreme { size, at }, (at - step).max(pair[0]), (at + step).min(pair[1])));
            }
        }
    }
    let (mut extreme, mut low, mut high) = best?;
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..REFINEMENTS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        let (at_a, at_b) = (error(a), error(b));
        for (at, size) in [(a, at_a), (b, at_b)] {
            if size.is_finite() && size > extreme.size {
                extreme = Extreme { size, at };
            }
        }
        if at_a > at_b { high = b } else { low = a }
    }
    Some(extreme)
}
