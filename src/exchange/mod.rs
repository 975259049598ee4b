//! Figures for paper, and meshes of other programs.

pub mod by_ending;
pub mod obj;
mod mesh;
mod page;
pub mod pdf;
pub mod png;
pub mod svg;
