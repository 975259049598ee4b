//! What can be wrong with knots, coefficients, weights and parameters.

use thiserror::Error;

/// An end of an interval, or the side from which a parameter is approached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The left end; the limit from below.
    Left,
    /// The right end; the limit from above.
    Right,
}

/// Errors of splines and spline curves. [`SplineError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SplineError {
    /// No coefficients, points or knots.
    #[error("no {what} given")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
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
    /// Spline degree 0.
    #[error("the degree must be at least 1")]
    DegreeZero,
    /// A limit of the library is exceeded.
    #[error("{what} {value} is above the limit {limit}")]
    StepLimit {
        /// What is limited.
        what: &'static str,
        /// The value asked for.
        value: usize,
        /// The largest possible value.
        limit: usize,
    },
    /// A knot is smaller than the one before.
    #[error("knot {index} is {value}, smaller than the knot {previous} before it")]
    KnotsDecreasing {
        /// Index of the smaller knot.
        index: usize,
        /// The knot.
        value: f64,
        /// The knot before.
        previous: f64,
    },
    /// A knot is repeated more often than the degree.
    #[error(
        "knot {value} (first index {index}) has multiplicity {multiplicity}, degree {degree} allows {degree}"
    )]
    KnotMultiplicityTooHigh {
        /// Index of the first copy.
        index: usize,
        /// The knot.
        value: f64,
        /// How often it stands there.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
    /// Fewer than `degree + 1` B-splines, or an end interval of D is empty.
    #[error("{}", not_regular(*.side, *.value, *.dimension, *.degree))]
    KnotsNotRegular {
        /// The end whose interval is empty; `None` when there are too few knots.
        side: Option<Side>,
        /// The knot at that end; `NaN` when there are too few knots.
        value: f64,
        /// Number of B-splines.
        dimension: usize,
        /// The degree.
        degree: usize,
    },
    /// The last knot of the period does not lie before the first knot plus the period.
    #[error("the last knot {last} must be smaller than {limit}, the first knot plus the period")]
    PeriodTooShort {
        /// The last knot of the period.
        last: f64,
        /// First knot plus period.
        limit: f64,
    },
    /// A parameter lies outside its interval.
    #[error("{value} lies outside [{left}, {right}]")]
    OutsideInterval {
        /// The parameter.
        value: f64,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// An interval without length.
    #[error("the interval from {left} to {right} is empty")]
    EmptyInterval {
        /// Its start.
        left: f64,
        /// Its end, not behind the start.
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
    /// A function is not in the spline space.
    #[error("the function is not in the spline space: {reason}")]
    NotInSpace {
        /// Where and by how much it fails.
        reason: String,
    },
    /// The data contradict each other, or what was asked for does not exist.
    #[error("no solution: {reason}")]
    NoSolution {
        /// What is missing.
        reason: String,
    },
    /// A geometric quantity is undefined.
    #[error("{what} is undefined at {parameter}")]
    Degenerate {
        /// The quantity.
        what: &'static str,
        /// The parameter.
        parameter: f64,
    },
    /// A polynomial has a higher degree than the spline.
    #[error("a polynomial of degree {degree} does not fit splines of degree {limit}")]
    DegreeTooHigh {
        /// Degree of the polynomial.
        degree: usize,
        /// Degree of the splines.
        limit: usize,
    },
    /// Knots that must be equally spaced are not.
    #[error("knot {index} is {value}; equal spacing asks for {expected}")]
    KnotsNotUniform {
        /// Index of the first knot that is off.
        index: usize,
        /// The knot.
        value: f64,
        /// Where it should be.
        expected: f64,
    },
    /// The end of one curve is not the start of the next.
    #[error("curve {index} starts {distance} away from the end of the one before")]
    BoundaryMismatch {
        /// Index of the later curve.
        index: usize,
        /// Distance of the two ends, in space or of the parameters.
        distance: f64,
    },
    /// A tolerance is not positive.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
    /// The watcher stopped the work.
    #[error(transparent)]
    Stopped(#[from] crate::core::progress::Stopped),
}

impl SplineError {
    /// The name of the error in the conventions of the course, for example `KnotsDecreasing`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "Empty",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::DegreeZero => "DegreeZero",
            Self::StepLimit { .. } => "StepLimit",
            Self::KnotsDecreasing { .. } => "KnotsDecreasing",
            Self::KnotMultiplicityTooHigh { .. } => "KnotMultiplicityTooHigh",
            Self::KnotsNotRegular { .. } => "KnotsNotRegular",
            Self::PeriodTooShort { .. } => "PeriodTooShort",
            Self::OutsideInterval { .. } => "OutsideInterval",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::NotInSpace { .. } => "NotInSpace",
            Self::NoSolution { .. } => "NoSolution",
            Self::Degenerate { .. } => "Degenerate",
            Self::DegreeTooHigh { .. } => "DegreeTooHigh",
            Self::KnotsNotUniform { .. } => "KnotsNotUniform",
            Self::BoundaryMismatch { .. } => "BoundaryMismatch",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::Stopped(_) => "Stopped",
        }
    }
}

fn not_regular(side: Option<Side>, value: f64, dimension: usize, degree: usize) -> String {
    match side {
        Some(Side::Left) => format!(
            "the first knot interval of D is empty: knots {degree} and {} are both {value}",
            degree + 1
        ),
        Some(Side::Right) => {
            format!(
                "the last knot interval of D is empty: knots {} and {dimension} are both {value}",
                dimension - 1
            )
        }
        None => {
            format!("the knots make {dimension} B-splines, degree {degree} needs at least {}", degree + 1)
        }
    }
}
