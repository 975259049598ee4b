//! Figures for paper and other programs.

mod page;
pub mod by_ending;
pub mod pdf;
pub mod png;
pub mod svg;
