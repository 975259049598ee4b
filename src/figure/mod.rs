//! What is drawn, not by whom.

pub mod approximation;
pub mod chart;
mod chart_axis;
pub mod clip;
pub mod color_bar;
pub mod color_map;
pub mod comb;
pub mod composition;
pub mod curve;
pub mod curve_chart;
pub mod elements;
pub mod error;
pub mod field;
pub mod font_metrics;
pub mod formula;
pub mod isoline;
pub mod label_placement;
pub mod mesh;
pub mod page;
pub mod picture;
pub mod raster;
pub mod scene;
pub mod surfaces;
pub mod theme;
pub mod ticks;
