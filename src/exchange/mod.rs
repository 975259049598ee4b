//! Figures for paper and other programs.

mod page;
pub mod pdf;
pub mod png;
pub mod svg;
