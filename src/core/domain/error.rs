//! What can be wrong with a domain.

use thiserror::Error;

/// Errors of plane domains. [`DomainError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DomainError {
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
    /// A side of a box, a radius or a half axis is not positive.
    #[error("{what} in direction {axis} runs from {left} to {right}")]
    EmptyInterval {
        /// Side, radius or half axis.
        what: &'static str,
        /// Direction, 0 or 1.
        axis: usize,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// Fewer than three vertices.
    #[error("{found} vertices given, a polygon needs at least 3")]
    TooFewData {
        /// How many were given.
        found: usize,
    },
    /// A direction without length.
    #[error("the {what} has length 0")]
    Degenerate {
        /// What direction.
        what: &'static str,
    },
    /// Two sides of a polygon meet elsewhere than in a common end, or lie on each other.
    #[error("sides {first} and {second} of the polygon meet")]
    NoSolution {
        /// Index of a side, which starts at the vertex of the same index.
        first: usize,
        /// Index of the other side.
        second: usize,
    },
}

impl DomainError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::TooFewData { .. } => "TooFewData",
            Self::Degenerate { .. } => "Degenerate",
            Self::NoSolution { .. } => "NoSolution",
        }
    }
}
