//! Why edits fail.

use thiserror::Error;

use crate::core::approximation::ApproximationError;
use crate::core::bspline::SplineError;
use crate::core::surface::{MeshError, SurfaceError};
use crate::document::edit::{MAX_EDIT_DEGREE, short};
use crate::document::object::ObjectId;

/// Why an edit cannot be done. The document is then unchanged.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EditError {
    /// No object has this number.
    #[error("there is no object {object}")]
    NoSuchObject {
        /// The number.
        object: ObjectId,
    },
    /// An object is of another kind.
    #[error("object {object} is a {kind}, not a {wanted}")]
    OtherKind {
        /// The object.
        object: ObjectId,
        /// What it is.
        kind: &'static str,
        /// What it should be.
        wanted: &'static str,
    },
    /// A closed curve has no ends.
    #[error("object {object} is closed and has no ends")]
    NoEnds {
        /// The curve.
        object: ObjectId,
    },
    /// A curve has itself as the other one.
    #[error("object {object} cannot be joined with itself; use Close curve")]
    JoinedWithItself {
        /// The curve.
        object: ObjectId,
    },
    /// A factor would flatten a curve.
    #[error("a curve cannot be scaled by {value}")]
    FactorZero {
        /// The factor.
        value: f64,
    },
    /// A curve has no point with this index.
    #[error("object {object} has no point {index}; its {count} points are numbered from 0")]
    NoSuchPoint {
        /// The curve.
        object: ObjectId,
        /// The index.
        index: usize,
        /// Number of points.
        count: usize,
    },
    /// A curve has no knot with this index.
    #[error("object {object} has no knot {index}; its {count} knots are numbered from 0")]
    NoSuchKnot {
        /// The curve.
        object: ObjectId,
        /// The index.
        index: usize,
        /// Number of knots.
        count: usize,
    },
    /// A value is not among the knots of a curve.
    #[error("{at} is not a knot of object {object}")]
    NotAKnot {
        /// The curve.
        object: ObjectId,
        /// The value.
        at: f64,
    },
    /// A knot would pass a neighbour.
    #[error("knot {knot} cannot move to {wanted}; it must stay between {low} and {high}")]
    KnotBlocked {
        /// Index of the knot, of the first copy if several move.
        knot: usize,
        /// Where it should go.
        wanted: f64,
        /// The smaller limit.
        low: f64,
        /// The larger limit.
        high: f64,
    },
    /// A curve cannot be kept over another parameter interval.
    #[error(
        "the curve can be kept over its parameter interval [{}, {}] only, not over [{}, {}]",
        short(*.left), short(*.right), short(*.low), short(*.high)
    )]
    IntervalChanged {
        /// Left end of the interval of the curve.
        left: f64,
        /// Its right end.
        right: f64,
        /// Left end of the interval of the new knots.
        low: f64,
        /// Its right end.
        high: f64,
    },
    /// An edit does not change knots alone, so that there is no curve to keep.
    #[error("{name:?} does not change knots alone")]
    NoKnotEdit {
        /// The name of the edit.
        name: String,
    },
    /// The degree lies outside the window's range.
    #[error("degree {degree} lies outside 1 to {MAX_EDIT_DEGREE}")]
    DegreeOutsideWindow {
        /// The degree.
        degree: usize,
    },
    /// A position in the drawing order does not exist.
    #[error("position {to} does not exist; the document has {count} objects")]
    NoSuchPosition {
        /// The position.
        to: usize,
        /// Number of objects.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("{what} is {value}, not a finite number")]
    NonFinite {
        /// What it belongs to.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// There are too many objects or points.
    #[error("{what}: {value} is above the limit {limit}")]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// The number.
        value: usize,
        /// The largest possible number.
        limit: usize,
    },
    /// A number of a display cannot be drawn.
    #[error("{field} is {value}; it must be from {} to {}", short(*.low), short(*.high))]
    BadDisplay {
        /// Its name.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The smallest possible value.
        low: f64,
        /// The largest possible value.
        high: f64,
    },
    /// The name of an object is unsuitable.
    #[error("the name {name:?} {reason}")]
    BadName {
        /// The name.
        name: String,
        /// Why not.
        reason: &'static str,
    },
    /// An edit of a batch failed.
    #[error("step {index} of the batch: {source}")]
    InBatch {
        /// Index of the edit.
        index: usize,
        /// What is wrong with it.
        #[source]
        source: Box<Self>,
    },
    /// Points, weights or knots do not make a curve.
    #[error(transparent)]
    Spline(#[from] SplineError),
    /// Points of the curve do not determine it.
    #[error(transparent)]
    Approximation(#[from] ApproximationError),
    /// Points, weights or knots do not make a surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Vertices and faces do not make a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl EditError {
    /// The name of the error, of the spline error's if that is the cause.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NoSuchObject { .. } => "NoSuchObject",
            Self::OtherKind { .. } => "OtherKind",
            Self::NoEnds { .. } => "NoEnds",
            Self::JoinedWithItself { .. } => "JoinedWithItself",
            Self::FactorZero { .. } => "FactorZero",
            Self::NoSuchPoint { .. } => "NoSuchPoint",
            Self::NoSuchKnot { .. } => "NoSuchKnot",
            Self::NotAKnot { .. } => "NotAKnot",
            Self::KnotBlocked { .. } => "KnotBlocked",
            Self::IntervalChanged { .. } => "IntervalChanged",
            Self::NoKnotEdit { .. } => "NoKnotEdit",
            Self::DegreeOutsideWindow { .. } => "DegreeOutsideWindow",
            Self::NoSuchPosition { .. } => "NoSuchPosition",
            Self::NonFinite { .. } => "NonFinite",
            Self::TooMany { .. } => "TooMany",
            Self::BadDisplay { .. } => "BadDisplay",
            Self::BadName { .. } => "BadName",
            Self::InBatch { source, .. } => source.name(),
            Self::Spline(error) => error.name(),
            Self::Approximation(error) => error.name(),
            Self::Surface(error) => error.name(),
            Self::Mesh(error) => error.name(),
        }
    }
}
