//! What can be wrong with a boundary value problem of a document.

use thiserror::Error;

use crate::core::domain::DomainError;
use crate::core::finite_element::FiniteElementError;
use crate::core::formula::FormulaError;

/// Why a boundary value problem cannot be as it is asked to be.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MembraneError {
    /// The numbers of a part make no region.
    #[error("part {}: {source}", part + 1)]
    Part {
        /// Index of the part.
        part: usize,
        /// What is wrong.
        source: DomainError,
    },
    /// The points, weights and knots make no patch.
    #[error(transparent)]
    Patch(#[from] FiniteElementError),
    /// A formula cannot be read.
    #[error("{what}: {source}")]
    Formula {
        /// Which formula.
        what: &'static str,
        /// What is wrong, and where.
        source: FormulaError,
    },
    /// A number lies outside its range.
    #[error("the {what} is {value}; it must be from {low} to {high}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// The number.
        value: f64,
        /// Smallest possible value.
        low: f64,
        /// Largest possible value.
        high: f64,
    },
    /// There are too many of something.
    #[error("{value} {what} are above the limit {limit}")]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// The number.
        value: usize,
        /// The largest possible number.
        limit: usize,
    },
    /// The region has no such part, point or side.
    #[error("there is no {what} {index}")]
    Missing {
        /// What is missing.
        what: &'static str,
        /// Its index.
        index: usize,
    },
}

impl MembraneError {
    /// The name of the error, of the cause's if there is one.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Part { source, .. } => source.name(),
            Self::Patch(source) => source.name(),
            Self::Formula { source, .. } => source.name(),
            Self::OutOfRange { .. } => "OutOfRange",
            Self::TooMany { .. } => "TooMany",
            Self::Missing { .. } => "Missing",
        }
    }
}
