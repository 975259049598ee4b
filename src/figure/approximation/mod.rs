//! What the Approximation room shows: data, function and methods over two axes with scales of their own, the knots on lines under them, and
//! the error below.
//!
//! | file | what |
//! |---|---|
//! | `analysis` | the splines of all methods, and how far they are from function and data |
//! | `layout` | where everything stands on the page |
//! | `plots` | function, curves, data and errors |
//! | `knot_rows` | the knots of each method |
//! | `frame` | axes, ticks, legend |
//!
//! The picture's world is the page as in [`crate::figure::chart`]: 1 unit is 1 pt, the origin is the lower left corner.

mod analysis;
mod frame;
mod knot_rows;
mod layout;
mod plots;

use glam::DVec2;

use crate::document::{Approximation, Document, Object, View};
use crate::figure::chart::Chart;
use crate::figure::composition::GRID;
use crate::figure::picture::{Picture, Viewport};
use crate::figure::theme::Theme;

pub use analysis::{Analysis, Extreme, Fit, analyse, fit, knots_of};
pub use frame::error_text;
pub use layout::{KnotRow, Layout, PlotArea, fitted_window};

/// Name of the room in [`View::workspace`].
pub const ROOM: &str = "approximation";

/// The approximation that the room shows: the selected one, else the last that is visible.
pub fn shown<'a>(document: &'a Document, view: &View) -> Option<&'a Object> {
    let objects = document.objects().iter().map(|object| &**object);
    let mut found = objects.filter(|object| object.approximation().is_some());
    let selected = view.selected_object;
    found.clone().find(|object| Some(object.id) == selected).or_else(|| found.rfind(|object| object.visible))
}

/// The picture of `approximation`.
pub fn compose(
    approximation: &Approximation,
    analysis: &Analysis,
    layout: &Layout,
    theme: &Theme,
    grid: bool,
) -> Picture {
    let mut picture = Picture::new(Some(theme.background));
    if grid {
        picture.push_layer("grid", frame::grid(layout, theme));
    }
    plots::push(&mut picture, approximation, analysis, layout, theme);
    knot_rows::push(&mut picture, approximation, analysis, layout, theme);
    frame::push(&mut picture, approximation, analysis, layout, theme);
    picture
}

/// Whether `view` is in this room, or there is nothing else to show.
pub fn is_shown(document: &Document, view: &View) -> bool {
    view.workspace == ROOM || document.objects().iter().all(|object| object.approximation().is_some())
}

/// The page of `size` pt that shows what the room shows, if `view` is in this room or there is nothing else to show.
pub fn page(document: &Document, view: &View, theme: &Theme, size: DVec2) -> Option<(Picture, Viewport)> {
    if !is_shown(document, view) {
        return None;
    }
    let object = shown(document, view)?;
    let approximation = object.approximation()?;
    let analysis = analyse(approximation, None);
    let window = view.plots.get(&object.id).copied();
    let window = window.unwrap_or_else(|| fitted_window(approximation, &analysis));
    let layout = Layout::new(approximation, &analysis, window, theme, size);
    let grid = view.panels.get(GRID).copied().unwrap_or(true);
    Some((compose(approximation, &analysis, &layout, theme, grid), Chart::view(size)))
}

#[cfg(test)]
mod tests;
