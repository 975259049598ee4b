//! What can be wrong with tensor-product splines.

use thiserror::Error;

use crate::core::bspline::SplineError;

/// Errors of splines of several variables; those of one direction carry their axis, counted from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TensorError {
    /// Two counts disagree.
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
        /// Its index in the row-major array.
        index: usize,
        /// The number.
        value: f64,
    },
    /// There is no such direction.
    #[error("there is no axis {axis}, only {count}")]
    NoSuchAxis {
        /// The axis asked for.
        axis: usize,
        /// The number of axes.
        count: usize,
    },
    /// An error in one direction.
    #[error("axis {axis}: {source}")]
    Axis {
        /// The direction.
        axis: usize,
        /// What is wrong there.
        source: SplineError,
    },
    /// A weight is not positive.
    #[error("weight {index} is {value}; weights must be positive")]
    WeightNotPositive {
        /// Its index in the row-major array.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// An algorithm for equally spaced knots got others.
    #[error("axis {axis}: the knots at the cell are not equally spaced")]
    KnotsNotUniform {
        /// The direction.
        axis: usize,
    },
    /// A limit of the library is exceeded.
    #[error("{what} {value} is above the limit {limit}")]
    StepLimit {
        /// What is limited.
        what: &'static str,
        /// The value asked for.
        value: usize,
        /// The largest possible value.
        limit: usize,
    },
    /// A geometric quantity is undefined.
    #[error("{what} is undefined")]
    Degenerate {
        /// The quantity.
        what: &'static str,
    },
    /// No B-spline is relevant for the domain.
    #[error("no B-spline is relevant: the domain meets no grid cell")]
    EmptyDomain,
}

impl TensorError {
    /// The name of the error in the conventions of the course, for example `OutsideInterval`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SizeMismatch { .. } | Self::NoSuchAxis { .. } => "SizeMismatch",
            Self::NonFinite { .. } => "NonFinite",
            Self::Axis { source, .. } => source.name(),
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::KnotsNotUniform { .. } => "KnotsNotUniform",
            Self::StepLimit { .. } => "StepLimit",
            Self::Degenerate { .. } => "Degenerate",
            Self::EmptyDomain => "EmptyDomain",
        }
    }

    /// Wraps an error of direction `axis`.
    pub(crate) fn on_axis(axis: usize) -> impl Fn(SplineError) -> Self {
        move |source| Self::Axis { axis, source }
    }
}
