//! Spline Lab: the mathematics of B-splines, and what a laboratory for them needs.

pub mod core;
pub mod course;
pub mod document;
pub mod exchange;
pub mod figure;
