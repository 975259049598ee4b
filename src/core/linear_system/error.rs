//! What can be wrong with a linear system.

use thiserror::Error;

use crate::core::progress::Stopped;

/// Errors of linear systems. [`LinearSystemError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LinearSystemError {
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
    /// An index of an entry does not exist.
    #[error("{what} {index} does not exist; there are {limit}")]
    IndexOutOfRange {
        /// Row or column.
        what: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        limit: usize,
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
    /// The matrix is not positive definite: `p·Ap ≤ 0`, or a pivot or diagonal entry is not positive.
    #[error("the matrix is not positive definite: {what} {index} gives {value}")]
    NotPositiveDefinite {
        /// Step, pivot or diagonal entry.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The number that should be positive.
        value: f64,
    },
    /// The matrix has no inverse.
    #[error("the matrix of size {size} is singular")]
    Singular {
        /// Number of rows.
        size: usize,
    },
    /// The iteration ended above its tolerance.
    #[error("after {steps} steps the relative residual is {residual}, above {tolerance}")]
    NotConverged {
        /// Number of steps.
        steps: usize,
        /// Norm of the residual over norm of the right side.
        residual: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// A tolerance is not positive.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
    /// The system is too large for the memory or the index type.
    #[error("a system of size {size} is too large")]
    StepLimit {
        /// Number of rows.
        size: usize,
    },
    /// The watcher stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl LinearSystemError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::IndexOutOfRange { .. } => "IndexOutOfRange",
            Self::NonFinite { .. } => "NonFinite",
            Self::NotPositiveDefinite { .. } => "NotPositiveDefinite",
            Self::Singular { .. } => "Singular",
            Self::NotConverged { .. } => "NotConverged",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::StepLimit { .. } => "StepLimit",
            Self::Stopped(_) => "Stopped",
        }
    }
}

/// `SizeMismatch` unless `found == expected`.
pub(super) fn check_size(what: &'static str, expected: usize, found: usize) -> Result<(), LinearSystemError> {
    if found == expected { Ok(()) } else { Err(LinearSystemError::SizeMismatch { what, expected, found }) }
}

/// `NonFinite` for the first number that is not finite.
pub(super) fn check_finite(what: &'static str, numbers: &[f64]) -> Result<(), LinearSystemError> {
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(index) => Err(LinearSystemError::NonFinite { what, index, value: numbers[index] }),
        None => Ok(()),
    }
}
