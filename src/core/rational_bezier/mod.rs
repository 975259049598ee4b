//! Chapter 3: rational Bezier curves.

mod homogeneous;

pub use homogeneous::Projective;
