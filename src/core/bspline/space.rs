//! Spline spaces: a degree and a knot sequence that fit each other.
//!
//! Open spaces have knots `ξ₀ ≤ … ≤ ξₘ₊ₙ`, `m` B-splines of degree `n`, and the parameter interval
//! `D = [ξₙ, ξₘ]`. Periodic spaces have `M` knots in one period `[ξ₀, ξ₀ + T)` and as many B-splines;
//! for every evaluation they are unrolled to open knots over `[ξ₀, ξ₀ + T]`.
//!
//! Knot intervals are half open, `[ξₗ, ξₗ₊₁)`; the last nonempty one of D includes its right end.
//!
//! Course: sections 4.4 and 4.6.

use std::sync::Arc;

use crate::core::bspline::error::{Side, SplineError};

/// The highest degree of a spline. A constant, so that evaluation can work on the stack.
pub const MAX_DEGREE: usize = 25;

/// The splines of one degree over one knot sequence, open or periodic; valid by construction. Copies share the knots.
///
/// ```
/// use spline_lab::core::bspline::{EndKnots, SplineSpace};
///
/// let space = SplineSpace::from_breaks(3, &[0.0, 1.0, 4.0], EndKnots::Interpolating)?;
/// assert_eq!(space.knots(), [-1.0, 0.0, 0.0, 0.0, 1.0, 4.0, 4.0, 4.0, 7.0]);
/// assert_eq!((space.dimension(), space.parameter_interval()), (5, (0.0, 4.0)));
/// let error = SplineSpace::new(2, vec![0.0, 1.0, 3.0, 2.0, 4.0, 5.0]).unwrap_err();
/// assert_eq!(error.to_string(), "knot 3 is 2, smaller than the knot 3 before it");
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SplineSpace {
    degree: usize,
    /// The knots used for evaluation: as given if open, unrolled if periodic.
    knots: Arc<[f64]>,
    period: Option<Period>,
}

#[derive(Clone, Debug, PartialEq)]
struct Period {
    length: f64,
    /// `ξ₀ ≤ … ≤ ξₘ₋₁ < ξ₀ + length`.
    knots: Arc<[f64]>,
    /// Index, at most 0 or above it, of the first unrolled knot: `μ − 1 − n`.
    first: isize,
}

/// A value that stands one or several times in a knot sequence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistinctKnot {
    /// The value.
    pub value: f64,
    /// How often it stands there.
    pub multiplicity: usize,
    /// Index of its first copy in [`SplineSpace::knots`].
    pub first: usize,
}

impl SplineSpace {
    /// The open space of `degree` over all knots `ξ₀ … ξₘ₊ₙ`, which must be n-regular.
    ///
    /// # Errors
    ///
    /// In this order: `DegreeZero`, `StepLimit` (degree above [`MAX_DEGREE`]), `SizeMismatch` (fewer than n + 2 knots),
    /// `NonFinite`, `KnotsDecreasing`, `KnotMultiplicityTooHigh`, `KnotsNotRegular`.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, SplineError> {
        check_degree(degree)?;
        if knots.len() < degree + 2 {
            return Err(SplineError::SizeMismatch {
                what: "knots",
                expected: degree + 2,
                found: knots.len(),
            });
        }
        check_nondecreasing(&knots)?;
        check_multiplicities(degree, &knots)?;
        let dimension = knots.len() - degree - 1;
        if dimension < degree + 1 {
            return Err(SplineError::KnotsNotRegular { side: None, value: f64::NAN, dimension, degree });
        }
        if knots[degree] >= knots[degree + 1] {
            let (side, value) = (Some(Side::Left), knots[degree]);
            return Err(SplineError::KnotsNotRegular { side, value, dimension, degree });
        }
        if knots[dimension - 1] >= knots[dimension] {
            let (side, value) = (Some(Side::Right), knots[dimension]);
            return Err(SplineError::KnotsNotRegular { side, value, dimension, degree });
        }
        Ok(Self { degree, knots: knots.into(), period: None })
    }

    /// The periodic space of `degree` with the given `period` and the `M ≥ 1` knots of one period.
    ///
    /// The B-spline `bₖ` is the one whose support starts at knot `k`.
    ///
    /// # Errors
    ///
    /// In this order: `DegreeZero`, `StepLimit`, `Empty`, `NonFinite` (a knot, or the period with index `M`),
    /// `KnotsDecreasing`, `KnotMultiplicityTooHigh`, `PeriodTooShort`.
    pub fn periodic(degree: usize, period: f64, knots: Vec<f64>) -> Result<Self, SplineError> {
        check_degree(degree)?;
        let (Some(&start), Some(&last)) = (knots.first(), knots.last()) else {
            return Err(SplineError::Empty { what: "knots" });
        };
        if !period.is_finite() {
            return Err(SplineError::NonFinite {
                what: "the period, number",
                index: knots.len(),
                value: period,
            });
        }
        check_nondecreasing(&knots)?;
        check_multiplicities(degree, &knots)?;
        if last >= start + period {
            return Err(SplineError::PeriodTooShort { last, limit: start + period });
        }
        let multiplicity = knots.iter().take_while(|&&knot| knot <= start).count();
        let first = multiplicity as isize - 1 - degree as isize;
        let beyond = (knots.len() + degree) as isize;
        let unrolled: Vec<f64> = (first..=beyond).map(|k| periodic_knot(&knots, period, k)).collect();
        // Rounding of ξ₀ + T can swallow a knot distance only if T is tiny beside the knots themselves.
        if let Some(index) = unrolled.iter().position(|knot| !knot.is_finite()) {
            return Err(SplineError::NonFinite { what: "unrolled knot", index, value: unrolled[index] });
        }
        check_nondecreasing(&unrolled)?;
        check_multiplicities(degree, &unrolled)?;
        let period = Some(Period { length: period, knots: knots.into(), first });
        Ok(Self { degree, knots: unrolled.into(), period })
    }

    /// The degree `n ≥ 1`.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The knots as given: all `m + n + 1` of an open space, the `M` of one period of a periodic one.
    pub fn knots(&self) -> &[f64] {
        self.period.as_ref().map_or(&self.knots, |period| &period.knots)
    }

    /// The knots used for evaluation: the given ones if open, those of one unrolled period if periodic.
    pub fn evaluation_knots(&self) -> &[f64] {
        &self.knots
    }

    /// Length `T` of the period; `None` for an open space.
    pub fn period(&self) -> Option<f64> {
        self.period.as_ref().map(|period| period.length)
    }

    /// Whether the space is periodic.
    pub fn is_periodic(&self) -> bool {
        self.period.is_some()
    }

    /// Number of free coefficients: `m` of an open, `M` of a periodic space.
    pub fn dimension(&self) -> usize {
        self.period.as_ref().map_or_else(|| self.evaluation_dimension(), |period| period.knots.len())
    }

    /// Number of B-splines over the evaluation knots; more than [`Self::dimension`] for a periodic space.
    pub fn evaluation_dimension(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// Index of the coefficient that belongs to B-spline `k` of the evaluation knots.
    pub fn coefficient_index(&self, k: usize) -> usize {
        self.period
            .as_ref()
            .map_or(k, |period| (k as isize + period.first).rem_euclid(period.knots.len() as isize) as usize)
    }

    /// Knot `ξₖ` of the sequence as given, for any integer `k` if periodic; `None` outside an open sequence.
    pub fn knot(&self, k: isize) -> Option<f64> {
        match &self.period {
            Some(period) => Some(periodic_knot(&period.knots, period.length, k)),
            None => usize::try_from(k).ok().and_then(|k| self.knots.get(k)).copied(),
        }
    }

    /// The ends of `D = [ξₙ, ξₘ]`, or of one period `[ξ₀, ξ₀ + T]`.
    pub fn parameter_interval(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.evaluation_dimension()])
    }

    /// The support `(ξₖ, ξₖ₊ₙ₊₁)` of the B-spline of coefficient `k < dimension`.
    pub fn support(&self, k: usize) -> (f64, f64) {
        let at = |k: usize| self.knot(k as isize).unwrap_or(f64::NAN);
        (at(k), at(k + self.degree + 1))
    }

    /// The Greville abscissae `ξₖⁿ = (ξₖ₊₁ + … + ξₖ₊ₙ)/n`, one for each coefficient.
    ///
    /// Course: section 4.3.
    pub fn greville_abscissae(&self) -> Vec<f64> {
        (0..self.dimension()).map(|k| self.greville_abscissa(k)).collect()
    }

    /// The Greville abscissa of coefficient `k < dimension`.
    pub fn greville_abscissa(&self, k: usize) -> f64 {
        // Averaging the distances from the first knot avoids overflow and keeps n-fold knots exact.
        let first = self.knot(k as isize + 1).unwrap_or(f64::NAN);
        let inner = (1..=self.degree).filter_map(|i| self.knot((k + i) as isize));
        first + inner.map(|knot| knot - first).sum::<f64>() / self.degree as f64
    }

    /// The distinct knots of D, ends included, with their multiplicities in the given sequence.
    ///
    /// A periodic space lists `ξ₀` once, not `ξ₀ + T`.
    pub fn distinct_knots(&self) -> Vec<DistinctKnot> {
        let (left, right) = self.parameter_interval();
        let mut distinct: Vec<DistinctKnot> = Vec::new();
        for (index, &value) in self.knots().iter().enumerate() {
            if value < left || value > right {
                continue;
            }
            match distinct.last_mut() {
                Some(last) if last.value.to_bits() == value.to_bits() || last.value >= value => {
                    last.multiplicity += 1;
                }
                _ => distinct.push(DistinctKnot { value, multiplicity: 1, first: index }),
            }
        }
        distinct
    }

    /// The distinct values of the evaluation knots in D, both ends included: the joints of the polynomial pieces.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.knots[self.degree..=self.evaluation_dimension()].to_vec();
        breaks.dedup();
        breaks
    }

    /// Number of copies of `x` among the evaluation knots.
    pub fn multiplicity(&self, x: f64) -> usize {
        self.knots.partition_point(|&knot| knot <= x) - self.knots.partition_point(|&knot| knot < x)
    }

    /// Reduces `x` into one period; an open space returns it unchanged.
    ///
    /// # Errors
    ///
    /// `NonFinite`, or `OutsideInterval` for an open space.
    pub fn reduce(&self, x: f64) -> Result<f64, SplineError> {
        if !x.is_finite() {
            return Err(SplineError::NonFinite { what: "parameter", index: 0, value: x });
        }
        let (left, right) = self.parameter_interval();
        match &self.period {
            Some(_) if (left..=right).contains(&x) => Ok(x),
            Some(period) => {
                let reduced = x - period.length * ((x - left) / period.length).floor();
                // Rounding may land on or beyond either end.
                Ok(if reduced >= right { left } else { reduced.max(left) })
            }
            None if (left..=right).contains(&x) => Ok(x),
            None => Err(SplineError::OutsideInterval { value: x, left, right }),
        }
    }

    /// Index `l` into the evaluation knots with `ξₗ ≤ x < ξₗ₊₁` inside D; the last nonempty interval at the right end.
    ///
    /// # Errors
    ///
    /// As [`Self::reduce`]; `x` of a periodic space is reduced first.
    pub fn span(&self, x: f64) -> Result<usize, SplineError> {
        Ok(self.span_of_reduced(self.reduce(x)?))
    }

    /// As [`Self::span`] for an `x` in D, or in the period from `ξ₀`.
    pub(super) fn span_of_reduced(&self, x: f64) -> usize {
        let last = self.evaluation_dimension();
        let after = self.knots[self.degree..=last].partition_point(|&knot| knot <= x) + self.degree;
        // At the right end every knot of D counts; the last nonempty interval starts at ξₘ₋₁ < ξₘ.
        after.min(last) - 1
    }

    /// As [`Self::span`] with the interval on the given side of `x`; at an end of D of an open space the only one.
    ///
    /// The second value is the parameter in that interval, which differs from `x` in a periodic space only.
    ///
    /// # Errors
    ///
    /// As [`Self::reduce`].
    pub fn span_on_side(&self, x: f64, side: Side) -> Result<(usize, f64), SplineError> {
        let mut x = self.reduce(x)?;
        let (left, right) = self.parameter_interval();
        if self.is_periodic() {
            match side {
                Side::Left if x <= left => x = right,
                Side::Right if x >= right => x = left,
                _ => {}
            }
        }
        let span = match side {
            Side::Right => self.span(x)?,
            Side::Left if x <= left => self.span(x)?,
            Side::Left => {
                let last = self.evaluation_dimension();
                self.knots[self.degree..=last].partition_point(|&knot| knot < x) + self.degree - 1
            }
        };
        Ok((span, x))
    }
}

fn check_degree(degree: usize) -> Result<(), SplineError> {
    match degree {
        0 => Err(SplineError::DegreeZero),
        1..=MAX_DEGREE => Ok(()),
        _ => Err(SplineError::StepLimit { what: "degree", value: degree, limit: MAX_DEGREE }),
    }
}

pub(super) fn check_nondecreasing(knots: &[f64]) -> Result<(), SplineError> {
    // Without an early exit the loop runs in vector registers; what is sorted is finite if its ends are.
    let sorted = knots.windows(2).fold(true, |sorted, pair| sorted & (pair[0] <= pair[1]));
    if sorted && knots.first().zip(knots.last()).is_some_and(|(a, b)| a.is_finite() && b.is_finite()) {
        return Ok(());
    }
    if let Some(index) = knots.iter().position(|knot| !knot.is_finite()) {
        return Err(SplineError::NonFinite { what: "knot", index, value: knots[index] });
    }
    match knots.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(k) => {
            Err(SplineError::KnotsDecreasing { index: k + 1, value: knots[k + 1], previous: knots[k] })
        }
        None => Ok(()),
    }
}

fn check_multiplicities(degree: usize, knots: &[f64]) -> Result<(), SplineError> {
    let later = knots.get(degree..).unwrap_or_default();
    if knots.iter().zip(later).fold(true, |fine, (knot, later)| fine & (knot < later)) {
        return Ok(());
    }
    match knots.windows(degree + 1).position(|run| run[0] >= run[degree]) {
        Some(index) => {
            let value = knots[index];
            let multiplicity = knots[index..].iter().take_while(|&&knot| knot <= value).count();
            Err(SplineError::KnotMultiplicityTooHigh { index, value, multiplicity, degree })
        }
        None => Ok(()),
    }
}

/// `ξₖ` of the periodic continuation, `ξₖ₊ₘ = ξₖ + T`.
fn periodic_knot(knots: &[f64], period: f64, k: isize) -> f64 {
    let count = knots.len() as isize;
    knots[k.rem_euclid(count) as usize] + period * k.div_euclid(count) as f64
}
