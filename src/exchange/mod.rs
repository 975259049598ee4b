//! Figures for paper and other programs.

pub mod by_ending;
mod page;
pub mod pdf;
pub mod png;
pub mod svg;
