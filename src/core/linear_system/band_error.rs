//! What can be wrong with a system with a band matrix.

use thiserror::Error;

/// Errors of band matrices and their factorizations.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BandError {
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
    /// A row starts left of the row above, or leaves the matrix.
    #[error("row {row} starts in column {first}, allowed are {least} to {most}")]
    RowOutsideBand {
        /// Index of the row.
        row: usize,
        /// Column of its first entry.
        first: usize,
        /// The smallest possible column.
        least: usize,
        /// The largest possible column.
        most: usize,
    },
    /// A pivot vanishes, or is as small as rounding.
    #[error("the matrix is singular: pivot {index} is {pivot}")]
    Singular {
        /// Index of the pivot.
        index: usize,
        /// The pivot.
        pivot: f64,
    },
    /// A pivot of a symmetric matrix is not positive.
    #[error("the matrix is not positive definite: pivot {index} is {pivot}")]
    NotPositiveDefinite {
        /// Index of the pivot.
        index: usize,
        /// The pivot.
        pivot: f64,
    },
}

impl BandError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::RowOutsideBand { .. } => "OutsideInterval",
            Self::Singular { .. } => "Singular",
            Self::NotPositiveDefinite { .. } => "NotPositiveDefinite",
        }
    }
}
