//! What can be wrong with the data of an approximation.

use thiserror::Error;

use crate::core::bspline::SplineError;
use crate::core::linear_system::BandError;

/// Errors of chapter 5. [`ApproximationError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ApproximationError {
    /// Two lengths disagree.
    #[error("{found} {what} given, {expected} needed")]
    SizeMismatch {
        /// What was counted.
        what: &'static str,
        /// How many are needed.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A number is infinite or not a number.
    #[error("{what} {index} is {value}, not a finite number")]
    NonFinite {
        /// What kind of number.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A number lies outside its interval.
    #[error("{what} {index} is {value}, outside [{left}, {right}]")]
    OutsideInterval {
        /// What kind of number.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The number.
        value: f64,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// The left end of an interval is not left of the right end.
    #[error("the interval [{left}, {right}] is empty")]
    EmptyInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// A site does not lie right of the one before.
    #[error("site {index} is {value}, not above the site {previous} before it")]
    SitesNotSorted {
        /// Index of the site.
        index: usize,
        /// The site.
        value: f64,
        /// The site before.
        previous: f64,
    },
    /// A site lies outside the interior of the support of its B-spline, so that interpolation is not always possible.
    #[error(
        "site {index} is {value}, but must lie between {left} and {right}, in the support of B-spline {index}"
    )]
    SchoenbergWhitney {
        /// Index of the site and of its B-spline, the first that fails.
        index: usize,
        /// The site.
        value: f64,
        /// Left end of the support.
        left: f64,
        /// Right end of the support.
        right: f64,
    },
    /// A derivative is prescribed at a knot where the splines have none.
    #[error(
        "the site {value} (first index {index}) stands {sites} times on a knot of multiplicity {knots}; together at most {most}"
    )]
    KnotMultiplicityTooHigh {
        /// Index of the first copy of the site.
        index: usize,
        /// The site.
        value: f64,
        /// Copies of the site.
        sites: usize,
        /// Copies of the knot.
        knots: usize,
        /// Degree plus one.
        most: usize,
    },
    /// Algorithm for equally spaced knots.
    #[error(
        "knot interval {index} has length {length}, the first one {expected}; equally spaced knots are needed"
    )]
    KnotsNotUniform {
        /// Index of the knot interval.
        index: usize,
        /// Its length.
        length: f64,
        /// Length of the first one.
        expected: f64,
    },
    /// Fewer data than needed.
    #[error("{found} {what} given, at least {least} needed")]
    TooFewData {
        /// What was counted.
        what: &'static str,
        /// The smallest possible number.
        least: usize,
        /// How many were given.
        found: usize,
    },
    /// The data leave a B-spline undetermined.
    #[error(
        "the data do not determine coefficient {index}: no site is left in the interior of ({left}, {right})"
    )]
    RankDeficient {
        /// Index of the B-spline.
        index: usize,
        /// Left end of its support.
        left: f64,
        /// Right end of its support.
        right: f64,
    },
    /// A weight is not positive.
    #[error("weight {index} is {value}; weights must be positive")]
    WeightNotPositive {
        /// Index of the weight.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// The smoothing parameter is outside its interval.
    #[error("the smoothing parameter {name} is {value}, outside [0, {most}]")]
    SigmaOutOfRange {
        /// σ or λ.
        name: &'static str,
        /// The value.
        value: f64,
        /// Its largest value.
        most: f64,
    },
    /// A tolerance is negative or not a number.
    #[error("the residual allowed is {value}; it must not be negative")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
    /// The system has no unique solution.
    #[error("interpolation at these sites has no unique solution: {source}")]
    Singular {
        /// The pivot that vanishes.
        #[from]
        source: BandError,
    },
    /// The data contradict each other.
    #[error("no solution: {reason}")]
    NoSolution {
        /// What contradicts what.
        reason: String,
    },
    /// The space or the coefficients of the result are invalid.
    #[error(transparent)]
    Spline(#[from] SplineError),
}

impl ApproximationError {
    /// The name of the error in the conventions of the course, for example `SchoenbergWhitney`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::OutsideInterval { .. } => "OutsideInterval",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::SitesNotSorted { .. } => "SitesNotSorted",
            Self::SchoenbergWhitney { .. } => "SchoenbergWhitney",
            Self::KnotMultiplicityTooHigh { .. } => "KnotMultiplicityTooHigh",
            Self::KnotsNotUniform { .. } => "KnotsNotUniform",
            Self::TooFewData { .. } => "TooFewData",
            Self::RankDeficient { .. } => "RankDeficient",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::SigmaOutOfRange { .. } => "SigmaOutOfRange",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::Singular { .. } => "Singular",
            Self::NoSolution { .. } => "NoSolution",
            Self::Spline(error) => error.name(),
        }
    }
}
