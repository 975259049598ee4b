//! What can be wrong with the coefficients of a polynomial.

use thiserror::Error;

use crate::core::point::Point;

/// Errors of polynomials. [`PolynomialError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PolynomialError {
    /// No coefficients.
    #[error("no {what} given")]
    Empty {
        /// What is missing.
        what: &'static str,
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
    /// A tolerance is not positive.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
    },
}

impl PolynomialError {
    /// The name of the error in the conventions of the course, for example `Empty`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "Empty",
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
        }
    }
}

/// `Empty` or `NonFinite` unless there are coefficients and all are finite.
pub(super) fn check_coefficients<P: Point>(coefficients: &[P]) -> Result<(), PolynomialError> {
    if coefficients.is_empty() {
        return Err(PolynomialError::Empty { what: "coefficients" });
    }
    check_finite("coefficient", coefficients)
}

/// `NonFinite` with the first entry that is not finite.
pub(super) fn check_finite<P: Point>(what: &'static str, values: &[P]) -> Result<(), PolynomialError> {
    for (index, value) in values.iter().enumerate() {
        if let Some(value) = (0..P::DIMENSION).map(|i| value.coordinate(i)).find(|x| !x.is_finite()) {
            return Err(PolynomialError::NonFinite { what, index, value });
        }
    }
    Ok(())
}

/// `NonFinite` or `EmptyInterval` unless `a < b` are finite.
pub(super) fn check_interval((left, right): (f64, f64)) -> Result<(), PolynomialError> {
    check_finite("end", &[left, right])?;
    if left >= right {
        return Err(PolynomialError::EmptyInterval { left, right });
    }
    Ok(())
}
