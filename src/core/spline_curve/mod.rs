//! Chapter 6: spline curves.

mod nurbs;

pub use nurbs::Nurbs;
