//! What is wrong with data, functions and methods.

use thiserror::Error;

use crate::core::formula::FormulaError;
use crate::document::approximation::{MAX_DATA, MAX_DEGREE};

/// Why something is no approximation.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DataError {
    /// Two lists differ in length.
    #[error("{found} {what} for {expected} sites")]
    SizeMismatch {
        /// What was counted.
        what: &'static str,
        /// Number of sites.
        expected: usize,
        /// Number of the others.
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
    /// A site does not lie right of the one before.
    #[error("x of datum {index} is {value}, not above {previous} before it")]
    NotIncreasing {
        /// Index of the datum.
        index: usize,
        /// Its site.
        value: f64,
        /// The site before.
        previous: f64,
    },
    /// A weight is not positive.
    #[error("the weight of datum {index} is {value}; weights must be positive")]
    WeightNotPositive {
        /// Index of the datum.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// There is too much of something.
    #[error("{what}: {value} is above the limit {limit}")]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// The number.
        value: usize,
        /// The largest possible number.
        limit: usize,
    },
    /// There is too little of something.
    #[error("{what}: {value} is below {least}")]
    TooFew {
        /// What is counted.
        what: &'static str,
        /// The number.
        value: usize,
        /// The least possible number.
        least: usize,
    },
    /// The formula cannot be read.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// An interval without length.
    #[error("the interval from {left} to {right} is empty or too long")]
    EmptyInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// There is no function to be sampled.
    #[error("there is no function; type one first")]
    NoFunction,
    /// No datum has this index.
    #[error("there is no datum {index}; the {count} data are numbered from 0")]
    NoSuchPoint {
        /// The index.
        index: usize,
        /// Number of data.
        count: usize,
    },
    /// No method has this index.
    #[error("there is no method {index}; the {count} methods are numbered from 0")]
    NoSuchMethod {
        /// The index.
        index: usize,
        /// Number of methods.
        count: usize,
    },
    /// A degree lies outside the range of the window.
    #[error("the degree is {degree}; it must be from 1 to {MAX_DEGREE}")]
    DegreeOutsideWindow {
        /// The degree.
        degree: usize,
    },
    /// A knot is smaller than the one before.
    #[error("knot {index} is {value}, smaller than the knot {previous} before it")]
    KnotsDecreasing {
        /// Index of the knot in the list.
        index: usize,
        /// The knot.
        value: f64,
        /// The knot before.
        previous: f64,
    },
    /// The smoothing parameter is outside its interval.
    #[error("\u{3c3} is {value}, outside [0, 1]")]
    SigmaOutOfRange {
        /// The value.
        value: f64,
    },
}

impl DataError {
    /// The name of the error, for example `NotIncreasing`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::NotIncreasing { .. } => "NotIncreasing",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::TooMany { .. } => "TooMany",
            Self::TooFew { .. } => "TooFew",
            Self::Formula(error) => error.name(),
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::NoFunction => "NoFunction",
            Self::NoSuchPoint { .. } => "NoSuchPoint",
            Self::NoSuchMethod { .. } => "NoSuchMethod",
            Self::DegreeOutsideWindow { .. } => "DegreeOutsideWindow",
            Self::KnotsDecreasing { .. } => "KnotsDecreasing",
            Self::SigmaOutOfRange { .. } => "SigmaOutOfRange",
        }
    }
}

/// Whether these are data.
pub(super) fn check_data(sites: &[f64], values: &[f64], weights: Option<&[f64]>) -> Result<(), DataError> {
    let expected = sites.len();
    if expected > MAX_DATA {
        return Err(DataError::TooMany { what: "data", value: expected, limit: MAX_DATA });
    }
    for (what, numbers) in [("x", Some(sites)), ("y", Some(values)), ("weight", weights)] {
        let Some(numbers) = numbers else { continue };
        if numbers.len() != expected {
            let what = if what == "y" { "values" } else { "weights" };
            return Err(DataError::SizeMismatch { what, expected, found: numbers.len() });
        }
        if let Some(index) = numbers.iter().position(|number| !number.is_finite()) {
            return Err(DataError::NonFinite { what, index, value: numbers[index] });
        }
    }
    if let Some(index) = sites.windows(2).position(|pair| pair[0] >= pair[1]) {
        let (previous, value) = (sites[index], sites[index + 1]);
        return Err(DataError::NotIncreasing { index: index + 1, value, previous });
    }
    let not_positive = weights.and_then(|weights| weights.iter().position(|&weight| weight <= 0.0));
    match (not_positive, weights) {
        (Some(index), Some(weights)) => Err(DataError::WeightNotPositive { index, value: weights[index] }),
        _ => Ok(()),
    }
}
