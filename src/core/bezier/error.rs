//! What can be wrong with the control points of a Bezier curve.

use thiserror::Error;

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
}

impl BezierError {
    /// The name of the error in the conventions of the course, for example `Empty`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "Empty",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
        }
    }
}
