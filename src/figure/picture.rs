//! A plane picture: what is drawn, not by whom.
//!
//! Places are points of the world, y up, in f64. Everything that has a size on paper (line widths, markers, type) is in
//! points (pt, 1/72 inch); on screen one point is one logical pixel. A [`Viewport`] joins the two.

use glam::DVec2;

use crate::figure::mesh::{Mesh, PlacedImage};

/// A colour with 8 bits each of red, green, blue (sRGB) and opacity (not premultiplied).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Color {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity: 0 is clear, 255 opaque.
    pub a: u8,
}

impl Color {
    /// An opaque colour from `0xRRGGBB`.
    pub const fn hex(rgb: u32) -> Self {
        Self { r: (rgb >> 16) as u8, g: (rgb >> 8) as u8, b: rgb as u8, a: 255 }
    }

    /// The same colour with another opacity between 0 and 1.
    #[must_use]
    pub fn with_opacity(self, opacity: f64) -> Self {
        Self { a: (opacity.clamp(0.0, 1.0) * 255.0).round() as u8, ..self }
    }

    /// The colour on the way from this one to `other`, `share` between 0 and 1 of it; as opaque as this one.
    #[must_use]
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let share = share.clamp(0.0, 1.0);
        let mix = |from: u8, to: u8| (f64::from(from) * (1.0 - share) + f64::from(to) * share).round() as u8;
        Self { r: mix(self.r, other.r), g: mix(self.g, other.g), b: mix(self.b, other.b), a: self.a }
    }
}

/// How a line is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Colour.
    pub color: Color,
    /// Width in pt.
    pub width: f64,
    /// Lengths in pt of dashes and gaps in turn; empty for a solid line.
    pub dashes: Vec<f64>,
}

impl Stroke {
    /// A solid line.
    pub fn solid(color: Color, width: f64) -> Self {
        Self { color, width, dashes: Vec::new() }
    }

    /// A dashed line.
    pub fn dashed(color: Color, width: f64, dash: f64, gap: f64) -> Self {
        Self { color, width, dashes: vec![dash, gap] }
    }
}

/// One step of a [`Path`], in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Start a new part.
    Move(DVec2),
    /// A straight line.
    Line(DVec2),
    /// A cubic Bezier curve with two inner control points and an end.
    Cubic(DVec2, DVec2, DVec2),
    /// Back to the start of the part.
    Close,
}

/// A styled path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The steps.
    pub segments: Vec<Segment>,
    /// Outline, if any.
    pub stroke: Option<Stroke>,
    /// Filling (nonzero rule), if any.
    pub fill: Option<Color>,
}

impl Path {
    /// A stroked polyline.
    pub fn polyline(points: &[DVec2], stroke: Stroke) -> Self {
        let mut segments: Vec<Segment> = points.iter().map(|&point| Segment::Line(point)).collect();
        if let Some(first) = segments.first_mut() {
            *first = Segment::Move(points[0]);
        }
        Self { segments, stroke: Some(stroke), fill: None }
    }

    /// A polygon, closed.
    pub fn polygon(points: &[DVec2], stroke: Option<Stroke>, fill: Option<Color>) -> Self {
        let mut path = Self::polyline(points, Stroke::solid(Color::hex(0), 0.0));
        path.segments.push(Segment::Close);
        Self { stroke, fill, ..path }
    }
}

/// Outline of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MarkerShape {
    /// A disc.
    Disc,
    /// A square, sides parallel to the axes.
    Square,
    /// A square on its tip.
    Diamond,
    /// A triangle, tip up.
    Triangle,
    /// Two crossing strokes.
    Cross,
}

/// A mark of fixed size at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Centre.
    pub at: DVec2,
    /// Shape.
    pub shape: MarkerShape,
    /// Diameter, or side length, in pt.
    pub size: f64,
    /// Filling, if any.
    pub fill: Option<Color>,
    /// Outline, if any.
    pub stroke: Option<Stroke>,
}

/// Which point of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Anchor {
    /// Left end of the base line.
    Start,
    /// Middle of the base line.
    Middle,
    /// Right end of the base line.
    End,
}

impl Anchor {
    /// The part of the text's width that lies left of its place: 0, ½ or 1.
    pub const fn part_before(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// A text of fixed size at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Place in the world.
    pub at: DVec2,
    /// Shift from there in pt, x to the right, y up.
    pub offset: DVec2,
    /// The text, one line. `c_3` style subscripts are marked as in [`crate::figure::formula`] when `math` is set.
    pub text: String,
    /// Size of type in pt.
    pub size: f64,
    /// Colour.
    pub color: Color,
    /// Where the place is in the text.
    pub anchor: Anchor,
    /// Whether the text is mathematics, to be typeset by [`crate::figure::formula`].
    pub math: bool,
}

/// One thing that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A path.
    Path(Path),
    /// A marker.
    Marker(Marker),
    /// A text.
    Label(Label),
    /// Coloured triangles.
    Mesh(Mesh),
    /// An image.
    Image(PlacedImage),
}

/// Things that belong together, under a name that exporters keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Name, for example `curve 2: control polygon`.
    pub name: String,
    /// The things, first drawn first.
    pub items: Vec<Item>,
}

/// A picture: a ground and layers, first drawn first.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Colour of the ground; `None` for a clear one.
    pub background: Option<Color>,
    /// The layers.
    pub layers: Vec<Layer>,
}

impl Picture {
    /// An empty picture.
    pub fn new(background: Option<Color>) -> Self {
        Self { background, layers: Vec::new() }
    }

    /// Adds a layer if it has items.
    pub fn push_layer(&mut self, name: impl Into<String>, items: Vec<Item>) {
        if !items.is_empty() {
            self.layers.push(Layer { name: name.into(), items });
        }
    }
}

/// What part of the world is seen, and how large: a page or canvas in pt, its centre, and the scale. All f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// World point in the middle of the page.
    pub center: DVec2,
    /// Points (pt) per world unit, positive.
    pub scale: f64,
    /// Width and height of the page in pt.
    pub size: DVec2,
}

impl Viewport {
    /// From the world (y up) to the page (pt, origin top left, y down).
    pub fn page_from_world(&self, world: DVec2) -> DVec2 {
        let shift = (world - self.center) * self.scale;
        self.size * 0.5 + DVec2::new(shift.x, -shift.y)
    }

    /// From the page (pt, origin top left, y down) to the world (y up).
    pub fn world_from_page(&self, page: DVec2) -> DVec2 {
        let shift = page - self.size * 0.5;
        self.center + DVec2::new(shift.x, -shift.y) / self.scale
    }

    /// The viewport of `size` that shows the box between `low` and `high` with a `margin` in pt on every side.
    ///
    /// A box without extent is shown at a scale of 100 pt per unit.
    pub fn fitting(low: DVec2, high: DVec2, size: DVec2, margin: f64) -> Self {
        let extent = high - low;
        let room = (size - DVec2::splat(2.0 * margin)).max(DVec2::splat(1.0));
        let mut scale = f64::INFINITY;
        if extent.x > 0.0 {
            scale = scale.min(room.x / extent.x);
        }
        if extent.y > 0.0 {
            scale = scale.min(room.y / extent.y);
        }
        let scale = if scale.is_finite() && scale > 0.0 { scale } else { 100.0 };
        Self { center: low + extent * 0.5, scale, size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn page_and_world_are_inverse_and_y_flips() {
        let view = Viewport { center: DVec2::new(1.0, 2.0), scale: 50.0, size: DVec2::new(400.0, 300.0) };
        let up = view.page_from_world(DVec2::new(1.0, 3.0));
        assert_eq!(up, DVec2::new(200.0, 100.0), "one unit up is 50 pt towards the top");
        let back = view.world_from_page(up);
        assert!((back - DVec2::new(1.0, 3.0)).length() < 1e-12, "{back}");
    }

    #[test]
    fn fitting_shows_the_whole_box_and_survives_a_single_point() {
        let size = DVec2::new(400.0, 300.0);
        let view = Viewport::fitting(DVec2::ZERO, DVec2::new(10.0, 1.0), size, 20.0);
        assert!((view.page_from_world(DVec2::ZERO).x - 20.0).abs() < 1e-9, "left margin");
        let point = Viewport::fitting(DVec2::ONE, DVec2::ONE, size, 20.0);
        assert_eq!((point.center, point.scale), (DVec2::ONE, 100.0), "a box without extent");
    }
}
