//! What is drawn, not by whom.

pub mod picture;
