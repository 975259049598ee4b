//! What can be wrong with surfaces.

use thiserror::Error;

use crate::core::bspline::SplineError;
use crate::core::progress::Stopped;
use crate::core::tensor::TensorError;

/// Errors of spline and NURBS surfaces; those of one direction carry their axis.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SurfaceError {
    /// Knots, coefficients, weights or parameters.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// The surface has no tangent plane there.
    #[error("the surface has no normal at ({}, {})", .at[0], .at[1])]
    SingularPoint {
        /// The parameters.
        at: [f64; 2],
    },
    /// A closed surface is needed.
    #[error("the surface is open: its sides of axis {axis} neither close up nor shrink to points")]
    OpenBoundary {
        /// The direction in which it is open.
        axis: usize,
    },
    /// A tolerance is not positive.
    #[error("the tolerance is {value}; it must be positive")]
    InvalidTolerance {
        /// The tolerance.
        value: f64,
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
    /// A watcher has stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl SurfaceError {
    /// The name of the error in the conventions of the course, for example `SingularPoint`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Tensor(error) => error.name(),
            Self::SingularPoint { .. } => "SingularPoint",
            Self::OpenBoundary { .. } => "OpenBoundary",
            Self::InvalidTolerance { .. } => "InvalidTolerance",
            Self::StepLimit { .. } => "StepLimit",
            Self::Stopped(_) => "Stopped",
        }
    }

    /// Wraps an error of direction `axis`.
    pub(super) fn on_axis(axis: usize) -> impl Fn(SplineError) -> Self {
        move |source| Self::Tensor(TensorError::Axis { axis, source })
    }
}
