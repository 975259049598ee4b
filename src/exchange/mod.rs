//! Figures for paper, and meshes of other programs.

pub mod by_ending;
pub mod csv;
pub mod frames;
mod mesh;
pub mod obj;
mod page;
pub mod pdf;
pub mod png;
pub mod svg;
pub mod tikz;
