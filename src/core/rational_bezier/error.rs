//! What can be wrong with a rational Bezier curve or a conic.

use thiserror::Error;

use crate::core::bezier::BezierError;

/// Errors of rational Bezier curves and conics. [`RationalBezierError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RationalBezierError {
    /// An error of the control points, of the interval or of a parameter.
    #[error(transparent)]
    Bezier(#[from] BezierError),
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
    /// A weight is not positive.
    #[error("weight {index} is {value}; weights must be positive")]
    WeightNotPositive {
        /// Its index.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// A number lies outside its admissible interval.
    #[error("{what} {value} lies outside ({left}, {right})")]
    OutsideInterval {
        /// What kind of number.
        what: &'static str,
        /// The number.
        value: f64,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// A geometric quantity is undefined.
    #[error("{what} is undefined at {value}")]
    Degenerate {
        /// What is undefined.
        what: &'static str,
        /// Parameter, or value that makes it so.
        value: f64,
    },
    /// A point is not on the conic.
    #[error("point {index} is not on the conic: its equation gives {residual} of its terms")]
    NotOnCurve {
        /// Index of the point.
        index: usize,
        /// The value of the equation, relative to the sum of the moduli of its terms.
        residual: f64,
    },
    /// The data contradict each other.
    #[error("no solution: {reason}")]
    NoSolution {
        /// Why.
        reason: &'static str,
    },
    /// No curve of this degree is the one wanted.
    #[error("there is none of degree {degree}: {reason}")]
    NotInSpace {
        /// The degree.
        degree: usize,
        /// Why.
        reason: &'static str,
    },
}

impl RationalBezierError {
    /// The name of the error in the conventions of the course, for example `WeightNotPositive`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Bezier(error) => error.name(),
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::OutsideInterval { .. } => "OutsideInterval",
            Self::Degenerate { .. } => "Degenerate",
            Self::NotOnCurve { .. } => "NotOnCurve",
            Self::NoSolution { .. } => "NoSolution",
            Self::NotInSpace { .. } => "NotInSpace",
        }
    }
}

/// `NonFinite` with the first number that is not finite.
pub(super) fn check_finite(what: &'static str, numbers: &[f64]) -> Result<(), RationalBezierError> {
    match numbers.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(RationalBezierError::NonFinite { what, index, value: numbers[index] }),
        None => Ok(()),
    }
}
