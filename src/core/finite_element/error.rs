//! What can be wrong with a finite element problem.

use glam::DVec2;
use thiserror::Error;

use crate::core::bspline::SplineError;
use crate::core::finite_element::geometry::PatchSide;
use crate::core::linear_system::LinearSystemError;
use crate::core::progress::Stopped;
use crate::core::quadrature::QuadratureError;

/// Errors of finite elements. [`FiniteElementError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FiniteElementError {
    /// A function's value is infinite or not a number.
    #[error("{what} is {value} at ({}, {}), not a finite number", point.x, point.y)]
    NonFinite {
        /// Which function or number.
        what: &'static str,
        /// Where.
        point: DVec2,
        /// The value.
        value: f64,
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
    /// A side of the grid's box is empty.
    #[error("the box runs from {left} to {right} in direction {axis}")]
    EmptyInterval {
        /// Direction, 0 or 1.
        axis: usize,
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// A limit of the library is exceeded.
    #[error("{what} {value} is outside the limits 1..={limit}")]
    StepLimit {
        /// What is limited.
        what: &'static str,
        /// The value asked for.
        value: usize,
        /// The largest possible value.
        limit: usize,
    },
    /// No B-spline has a part of its support in the domain.
    #[error("the domain contains no part of the grid's cells")]
    EmptyDomain,
    /// The grid is too coarse for web-splines.
    #[error(
        "no (n + 1) x (n + 1) array of inner B-splines for the outer one ({}, {}); use a finer grid or plain weighted B-splines",
        index[0], index[1]
    )]
    NoInnerArray {
        /// The outer B-spline.
        index: [usize; 2],
    },
    /// The weight function is not positive inside the domain.
    #[error("the weight function is {value} at ({}, {}) in the domain", point.x, point.y)]
    WeightNotPositive {
        /// Where.
        point: DVec2,
        /// Its value.
        value: f64,
    },
    /// The gradient of the weight function vanishes on the boundary.
    #[error("the gradient of the weight function vanishes at the boundary point ({}, {})", point.x, point.y)]
    DegenerateWeight {
        /// Where.
        point: DVec2,
    },
    /// The coefficients are not elliptic: A is not symmetric and positive definite, or c is negative.
    #[error("the coefficient {what} at ({}, {}) is not elliptic ({value})", point.x, point.y)]
    NotElliptic {
        /// Which coefficient.
        what: &'static str,
        /// Where.
        point: DVec2,
        /// Its smallest eigenvalue, its asymmetry, or its value.
        value: f64,
    },
    /// The right side of a problem without essential conditions does not balance.
    #[error("the right side sums to {sum}, it must sum to 0 (sum of moduli {scale})")]
    IncompatibleData {
        /// Sum of its entries.
        sum: f64,
        /// Sum of their moduli.
        scale: f64,
    },
    /// Without essential conditions and reaction the solution is unique up to a constant only.
    #[error("the system has a constant in its kernel; fix the mean value")]
    SingularSystem,
    /// Isogeometric elements take no load against gradients.
    #[error("isogeometric elements take no load F·grad v; F must be the constant 0")]
    GradientLoad,
    /// An elastic body that is not held.
    #[error("the body is not fixed; {dimension} rigid motions remain")]
    UnconstrainedBody {
        /// Dimension of the kernel.
        dimension: usize,
    },
    /// The Jacobian determinant of a patch vanishes.
    #[error("the Jacobian of patch {patch} vanishes at ({}, {})", parameter.x, parameter.y)]
    SingularJacobian {
        /// The patch.
        patch: usize,
        /// Where.
        parameter: DVec2,
    },
    /// The Jacobian determinant of a patch is negative.
    #[error("the Jacobian of patch {patch} is negative ({value})")]
    NegativeOrientation {
        /// The patch.
        patch: usize,
        /// The largest determinant found.
        value: f64,
    },
    /// The Jacobian determinant of a patch changes its sign.
    #[error(
        "patch {patch} is folded: its Jacobian is {least} at ({}, {}) and {greatest} at ({}, {})",
        least_at.x, least_at.y, greatest_at.x, greatest_at.y
    )]
    FoldedParametrisation {
        /// The patch.
        patch: usize,
        /// The smallest determinant found.
        least: f64,
        /// Its parameter.
        least_at: DVec2,
        /// The largest determinant found.
        greatest: f64,
        /// Its parameter.
        greatest_at: DVec2,
    },
    /// A patch with a periodic direction; every direction needs two sides.
    #[error("direction {axis} is periodic; patches are open")]
    PeriodicDirection {
        /// The direction, 0 or 1.
        axis: usize,
    },
    /// Knots, degree or parameter of one direction are wrong.
    #[error("direction {axis}: {source}")]
    Direction {
        /// The direction, 0 or 1.
        axis: usize,
        /// What is wrong.
        source: SplineError,
    },
    /// Common sides of patches differ.
    #[error("the {} of patch {} and the {} of patch {} have common ends but differ by {distance}", first.1, first.0, second.1, second.0)]
    InterfaceMismatch {
        /// A patch and its side.
        first: (usize, PatchSide),
        /// The neighbour and its side.
        second: (usize, PatchSide),
        /// Largest distance of corresponding points.
        distance: f64,
    },
    /// Degrees or knots on common sides of patches differ.
    #[error("degrees or knots of the {} of patch {} and the {} of patch {} differ, or are not n-fold across it", first.1, first.0, second.1, second.0)]
    KnotMismatch {
        /// A patch and its side.
        first: (usize, PatchSide),
        /// The neighbour and its side.
        second: (usize, PatchSide),
    },
    /// Essential conditions on a side that does not exist.
    #[error(
        "the {side} of patch {patch} cannot be fixed: no such patch, an interface, or knots that are not n-fold there"
    )]
    DirichletSideUnknown {
        /// The patch.
        patch: usize,
        /// The side.
        side: PatchSide,
    },
    /// From the linear system.
    #[error(transparent)]
    LinearSystem(#[from] LinearSystemError),
    /// From a Gauss rule.
    #[error(transparent)]
    Quadrature(#[from] QuadratureError),
    /// From a spline space.
    #[error(transparent)]
    Spline(#[from] SplineError),
    /// The watcher stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl FiniteElementError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "NonFinite",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::StepLimit { .. } => "StepLimit",
            Self::EmptyDomain => "EmptyDomain",
            Self::NoInnerArray { .. } => "NoInnerArray",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::DegenerateWeight { .. } => "DegenerateWeight",
            Self::NotElliptic { .. } => "NotElliptic",
            Self::IncompatibleData { .. } => "IncompatibleData",
            Self::SingularSystem => "SingularSystem",
            Self::GradientLoad => "GradientLoad",
            Self::UnconstrainedBody { .. } => "UnconstrainedBody",
            Self::SingularJacobian { .. } => "SingularJacobian",
            Self::NegativeOrientation { .. } => "NegativeOrientation",
            Self::FoldedParametrisation { .. } => "FoldedParametrisation",
            Self::PeriodicDirection { .. } => "KnotsNotRegular",
            Self::Direction { source, .. } => source.name(),
            Self::InterfaceMismatch { .. } => "InterfaceMismatch",
            Self::KnotMismatch { .. } => "KnotMismatch",
            Self::DirichletSideUnknown { .. } => "DirichletSideUnknown",
            Self::LinearSystem(error) => error.name(),
            Self::Quadrature(error) => error.name(),
            Self::Spline(error) => error.name(),
            Self::Stopped(_) => "Stopped",
        }
    }

    /// The same error of patch `number`, if it names a patch.
    pub(super) fn of_patch(mut self, number: usize) -> Self {
        if let Self::SingularJacobian { patch, .. }
        | Self::FoldedParametrisation { patch, .. }
        | Self::DirichletSideUnknown { patch, .. } = &mut self
        {
            *patch = number;
        }
        self
    }
}
