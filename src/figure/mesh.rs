//! Coloured triangles in the plane, and images: the two things of a picture that are not lines.

use glam::DVec2;

use crate::figure::error::{FigureError, check_count, check_finite, check_triangles};
use crate::figure::picture::Color;

/// Triangles with colours at their vertices, first drawn first; between the vertices colours are interpolated linearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    points: Vec<DVec2>,
    colors: Vec<Color>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh with one colour for each of its `points` (world coordinates) and triples of indices into them.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `SizeMismatch`, `IndexOutOfRange`.
    pub fn new(
        points: Vec<DVec2>,
        colors: Vec<Color>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, FigureError> {
        check_finite("point", points.iter().map(|point| point.to_array()))?;
        check_count("colours", points.len(), colors.len())?;
        check_triangles(points.len(), &triangles)?;
        Ok(Self { points, colors, triangles })
    }

    /// The vertices.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Their colours.
    pub fn colors(&self) -> &[Color] {
        &self.colors
    }

    /// The triangles, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Places and colours of the corners of every triangle, in the order of drawing.
    pub fn corners(&self) -> impl Iterator<Item = [(DVec2, Color); 3]> {
        let at = |vertex: u32| (self.points[vertex as usize], self.colors[vertex as usize]);
        self.triangles.iter().map(move |corners| corners.map(at))
    }
}

/// Pixels, row by row from the upper left corner: red, green, blue, opacity (sRGB, not premultiplied).
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl Image {
    /// An image of `width · height` pixels, 4 bytes each.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn new(width: u32, height: u32, pixels: Vec<u8>) -> Result<Self, FigureError> {
        let needed = (width as usize).saturating_mul(height as usize).saturating_mul(4);
        check_count("bytes of pixels", needed, pixels.len())?;
        Ok(Self { width, height, pixels })
    }

    /// Pixels across.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The bytes.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// The colour of the pixel in `column` and `row`, if there is one.
    pub fn color(&self, column: u32, row: u32) -> Option<Color> {
        let start = 4 * (row as usize * self.width as usize + column as usize);
        let bytes = (column < self.width).then(|| self.pixels.get(start..start + 4)).flatten()?;
        Some(Color { r: bytes[0], g: bytes[1], b: bytes[2], a: bytes[3] })
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} × {} pixels)", self.width, self.height)
    }
}

/// An image that fills an upright box of the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedImage {
    /// Lower left corner.
    pub low: DVec2,
    /// Upper right corner.
    pub high: DVec2,
    /// The pixels.
    pub image: std::sync::Arc<Image>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_name_what_is_wrong() {
        let ink = vec![Color::hex(0); 3];
        let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
        assert!(Mesh::new(points.clone(), ink.clone(), vec![[0, 1, 2]]).is_ok(), "a triangle");
        let bad_index = Mesh::new(points.clone(), ink.clone(), vec![[0, 1, 2], [0, 3, 1]]).unwrap_err();
        let expected = FigureError::IndexOutOfRange { triangle: 1, corner: 1, vertex: 3, count: 3 };
        assert_eq!(bad_index, expected, "{bad_index}");
        let hole = Mesh::new(vec![DVec2::ZERO, DVec2::NAN, DVec2::Y], ink.clone(), Vec::new()).unwrap_err();
        assert!(matches!(hole, FigureError::NonFinite { index: 1, .. }), "{hole}");
        let short = Mesh::new(points, ink[..2].to_vec(), Vec::new()).unwrap_err();
        assert_eq!(short.name(), "SizeMismatch", "{short}");
    }

    #[test]
    fn images_have_as_many_bytes_as_pixels_need() {
        let image = Image::new(2, 1, vec![0, 0, 0, 255, 1, 2, 3, 4]).unwrap();
        assert_eq!(image.color(1, 0), Some(Color { r: 1, g: 2, b: 3, a: 4 }), "{image:?}");
        assert_eq!((image.color(2, 0), image.color(0, 1)), (None, None), "outside");
        assert!(Image::new(2, 2, vec![0; 15]).is_err(), "one byte short");
    }
}
