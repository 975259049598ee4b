//! What is drawn, not by whom.

pub mod chart;
pub mod clip;
pub mod comb;
pub mod composition;
pub mod curve;
pub mod font_metrics;
pub mod formula;
pub mod picture;
pub mod theme;
pub mod ticks;
