//! What is drawn, not by whom.

pub mod curve;
pub mod picture;
pub mod theme;
