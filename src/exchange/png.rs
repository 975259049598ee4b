//! PNG images: the SVG drawn by resvg with the lab's own fonts.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia;
use resvg::usvg;
use thiserror::Error;

use crate::exchange::page::Medium;
use crate::exchange::svg::write_svg_with;
use crate::figure::font_metrics::FontFace;
use crate::figure::picture::{Picture, Viewport};

/// Longest side of an image in pixels.
pub const LONGEST_SIDE: u32 = 32_000;
/// Most pixels of an image.
pub const MOST_PIXELS: u64 = 100_000_000;

/// Why there is no image.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PngError {
    /// A size is not a positive number.
    #[error("{what} is {value}, not a positive number")]
    BadSize {
        /// Width, height or resolution.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The image would be too large.
    #[error(
        "an image of {width:.0} × {height:.0} pixels is too large: sides may have {LONGEST_SIDE}, the image {MOST_PIXELS} pixels"
    )]
    TooLarge {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The drawing or the file could not be made.
    #[error("the image cannot be made: {reason}")]
    Failed {
        /// What the drawing library says.
        reason: String,
    },
}

/// The picture as a PNG file with `pixels_per_point` pixels for each pt of the view (2 gives 144 dpi).
///
/// # Errors
///
/// `BadSize`, `TooLarge`; `Failed` if memory is short.
pub fn write_png(picture: &Picture, view: &Viewport, pixels_per_point: f64) -> Result<Vec<u8>, PngError> {
    let sizes = [("width", view.size.x), ("height", view.size.y), ("resolution", pixels_per_point)];
    if let Some(&(what, value)) = sizes.iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        return Err(PngError::BadSize { what, value });
    }
    let pixels = (view.size * pixels_per_point).round().max(glam::DVec2::ONE);
    let (width, height) = (pixels.x, pixels.y);
    if width.max(height) > f64::from(LONGEST_SIDE) || width * height > MOST_PIXELS as f64 {
        return Err(PngError::TooLarge { width, height });
    }
    let failed = |reason: String| PngError::Failed { reason };
    let svg = write_svg_with(picture, view, None, Medium::Pixels(pixels_per_point));
    let tree = usvg::Tree::from_str(&svg, &options()).map_err(|error| failed(error.to_string()))?;
    let mut image = tiny_skia::Pixmap::new(width as u32, height as u32)
        .ok_or_else(|| failed("not enough memory".to_owned()))?;
    let (across, down) = (width as f32 / tree.size().width(), height as f32 / tree.size().height());
    resvg::render(&tree, tiny_skia::Transform::from_scale(across, down), &mut image.as_mut());
    image.encode_png().map_err(|error| failed(error.to_string()))
}

fn options() -> usvg::Options<'static> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut database = usvg::fontdb::Database::new();
        for font in FontFace::ALL {
            database.load_font_source(usvg::fontdb::Source::Binary(Arc::new(font.bytes())));
        }
        database.set_sans_serif_family(FontFace::Regular.family());
        database.set_serif_family(FontFace::Math.family());
        Arc::new(database)
    });
    let font_family = FontFace::Regular.family().to_owned();
    usvg::Options { fontdb: Arc::clone(fonts), font_family, ..usvg::Options::default() }
}
