//! What can be wrong with control points and parameters.

use thiserror::Error;

/// Errors of Bezier curves. [`BezierError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BezierError {
    /// No control points.
    #[error("no control points given")]
    Empty,
    /// Two lengths or dimensions disagree.
    #[error("{what} {index} has {found} entries, {expected} needed")]
    SizeMismatch {
        /// What was counted.
        what: &'static str,
        /// Its index.
        index: usize,
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
    /// An interval without length, or with its ends exchanged.
    #[error("the interval [{left}, {right}] is empty")]
    EmptyInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
}

impl BezierError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
        }
    }
}
