//! The mathematics of the course, one folder per chapter.

pub mod bezier;
pub mod bspline;
pub mod point;
pub mod rational_bezier;
pub mod spline_curve;
pub mod triangular_scheme;
