//! What can be wrong with meshes, scenes, colour scales and fields.

use thiserror::Error;

use crate::document::EyeError;

/// Errors of what figures are made of. [`FigureError::name`] gives the name used in the course's conventions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FigureError {
    /// A number is infinite or not a number.
    #[error("{what} {index} is {value}, not a finite number")]
    NonFinite {
        /// What kind of number.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The number, or the first bad coordinate.
        value: f64,
    },
    /// A triangle names a vertex that is not there.
    #[error("corner {corner} of triangle {triangle} is vertex {vertex}, but there are only {count}")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: usize,
        /// 0, 1 or 2.
        corner: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
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
    /// The lower end is not below the upper one.
    #[error("{what} from {low} to {high} is empty")]
    EmptyInterval {
        /// What kind of interval.
        what: &'static str,
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
    /// A size is not possible.
    #[error("{what} is {value}; it must be positive and at most {limit}")]
    StepLimit {
        /// What is limited.
        what: &'static str,
        /// The value asked for.
        value: f64,
        /// The largest possible value.
        limit: f64,
    },
    /// An eye that cannot be.
    #[error(transparent)]
    OutsideInterval(#[from] EyeError),
}

impl FigureError {
    /// The name of the error in the course's conventions.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "NonFinite",
            Self::IndexOutOfRange { .. } => "IndexOutOfRange",
            Self::SizeMismatch { .. } => "SizeMismatch",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::StepLimit { .. } => "StepLimit",
            Self::OutsideInterval(_) => "OutsideInterval",
        }
    }
}

/// The first coordinate that is not finite, with the index of its point.
pub(crate) fn check_finite<const N: usize>(
    what: &'static str,
    points: impl IntoIterator<Item = [f64; N]>,
) -> Result<(), FigureError> {
    for (index, point) in points.into_iter().enumerate() {
        if let Some(&value) = point.iter().find(|value| !value.is_finite()) {
            return Err(FigureError::NonFinite { what, index, value });
        }
    }
    Ok(())
}

/// The first corner that names none of `count` vertices.
pub(crate) fn check_triangles(count: usize, triangles: &[[u32; 3]]) -> Result<(), FigureError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(corner) = corners.iter().position(|&vertex| vertex as usize >= count) {
            return Err(FigureError::IndexOutOfRange { triangle, corner, vertex: corners[corner], count });
        }
    }
    Ok(())
}

pub(crate) fn check_count(what: &'static str, expected: usize, found: usize) -> Result<(), FigureError> {
    if expected == found { Ok(()) } else { Err(FigureError::SizeMismatch { what, expected, found }) }
}
