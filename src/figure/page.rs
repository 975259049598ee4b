//! The page of a document: what the room that its view looks at shows, for the window's export and the command line alike.

use crate::document::{Document, View};
use crate::figure::error::FigureError;
use crate::figure::picture::{Picture, Viewport};
use crate::figure::theme::Theme;
use crate::figure::{approximation, composition, elements, surfaces};

/// Whether the page of `view` shows plots or space, whose height does not follow from the box of the plane's objects.
pub fn has_free_height(document: &Document, view: &View) -> bool {
    surfaces::is_shown(view) || approximation::is_shown(document, view)
}

/// The picture and its viewport; `viewport` gives the size, and in the plane the place too.
///
/// # Errors
///
/// Those of a scene that cannot be drawn.
pub fn page(
    document: &Document,
    view: &View,
    theme: &Theme,
    viewport: &Viewport,
) -> Result<(Picture, Viewport), FigureError> {
    if surfaces::is_shown(view) {
        return surfaces::compose(document, view, theme, viewport.size);
    }
    if elements::is_shown(document, view) {
        return Ok((elements::compose(document, view, theme, viewport), *viewport));
    }
    let plots = approximation::page(document, view, theme, viewport.size);
    Ok(plots.unwrap_or_else(|| (composition::compose(document, view, theme, viewport), *viewport)))
}
