//! Spline Lab: the mathematics of B-splines, and what a laboratory for them needs.

pub mod core;
pub mod document;
pub mod figure;

pub mod course;

pub mod exchange;

#[cfg(feature = "app")]
pub mod app;
