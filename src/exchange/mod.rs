//! Figures for paper and other programs.

pub mod by_ending;
mod mesh;
mod page;
pub mod pdf;
pub mod png;
pub mod svg;
