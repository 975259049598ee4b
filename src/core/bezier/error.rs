//! What can be wrong with the control points of a Bezier curve.

use thiserror::Error;

use crate::core::polynomial::PolynomialError;

/// Errors of Bezier curves. [`BezierError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BezierError {
    /// No control points.
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
    /// The left end of the interval is not smaller than the right end.
    #[error("the interval [{left}, {right}] is empty")]
    EmptyInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// A parameter lies outside its admissible interval.
    #[error("{what} {value} lies outside [{left}, {right}]")]
    OutsideInterval {
        /// What kind of parameter.
        what: &'static str,
        /// The parameter.
        value: f64,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// A geometric quantity is undefined.
    #[error("{what} is undefined at {parameter}")]
    Degenerate {
        /// What is undefined.
        what: &'static str,
        /// Parameter, or value that makes it so.
        parameter: f64,
    },
    /// A tolerance is not positive.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
    /// A direction is no unit vector.
    #[error("direction {index} has the length {length}, not 1")]
    DirectionNotUnit {
        /// Which direction.
        index: usize,
        /// Its length.
        length: f64,
    },
    /// The data contradict each other.
    #[error("no solution: {reason}")]
    NoSolution {
        /// Why.
        reason: &'static str,
    },
    /// More steps, levels or pieces would be needed than are allowed.
    #[error("{what} would need {value}, the limit is {limit}")]
    StepLimit {
        /// What was counted.
        what: &'static str,
        /// How many would be needed, or were needed so far.
        value: usize,
        /// The limit.
        limit: usize,
    },
    /// An error of the coefficients of a polynomial.
    #[error(transparent)]
    Polynomial(#[from] PolynomialError),
}

impl BezierError {
    /// The name of the error in the conventions of the course, for example `Empty`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "Empty",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::OutsideInterval { .. } => "OutsideInterval",
            Self::Degenerate { .. } => "Degenerate",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::DirectionNotUnit { .. } => "DirectionNotUnit",
            Self::NoSolution { .. } => "NoSolution",
            Self::StepLimit { .. } => "StepLimit",
            Self::Polynomial(error) => error.name(),
        }
    }
}

/// `InvalidTolerance` unless the tolerance is positive.
pub(super) fn check_tolerance(tolerance: f64) -> Result<(), BezierError> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(BezierError::InvalidTolerance { value: tolerance });
    }
    Ok(())
}
