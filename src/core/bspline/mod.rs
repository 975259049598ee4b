//! Chapter 4: B-splines, spline spaces, and the one spline type.

mod error;
mod space;
mod spline;

pub use error::{Side, SplineError};
pub use space::{DistinctKnot, MAX_DEGREE, SplineSpace};
pub use spline::{DeBoorScheme, Spline};
