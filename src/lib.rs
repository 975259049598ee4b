//! Spline Lab: a laboratory of splines, and the mathematics behind it.
//!
//! Six layers, each of which uses only those before it; `tests/layering.rs` checks that on the source text:
//!
//! | layer | what it is |
//! |---|---|
//! | [`core`] | the mathematics, one folder per chapter of the course |
//! | [`document`] | what is saved and undone: objects, edits with names, history, files, recovery |
//! | [`figure`] | what is drawn, not by whom: pictures, charts, scenes, fields, formulas, looks |
//! | [`course`] | lessons, the stepper's frames, questions checked by mathematics |
//! | [`exchange`] | files of others and paper: OBJ, CSV, SVG, PDF, PNG, TikZ |
//! | `app` | the window (feature `app`, on by default) |
//!
//! [`command_line`] reads the arguments of the program and stands above all layers.
//!
//! The course follows K. Höllig, J. Hörner, *Approximation and Modeling with B-Splines*, SIAM 2013; section numbers are
//! those of that book.

pub mod core;

pub mod document;

pub mod figure;

pub mod course;

pub mod exchange;

#[cfg(feature = "app")]
pub mod app;

pub mod command_line;
