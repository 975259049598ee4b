//! A view of space: what is shown, not by whom it is drawn.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | [`Scene`]: named layers of triangles, lines, points and labels |
//! | `triangles.rs` | [`Triangles`]: indexed, with normals and colours |
//! | `eye.rs` | [`Eye`], [`EyeView`]: the camera, and from the page back into space |
//! | `light.rs` | [`Light`]: what colour a lit surface has |
//! | `picking.rs` | what lies under a point of the page |
//! | `shading.rs` | triangles as they appear on the page: cut, projected, lit |
//! | `paper.rs` | a scene as a [`Picture`](crate::figure::picture::Picture): for SVG, PDF and PNG, without a GPU |
//!
//! Places are points of space in f64, right-handed, z up. Sizes on paper are in pt as in [`crate::figure::picture`].

mod eye;
mod light;
mod paper;
mod picking;
mod shading;
mod triangles;

use glam::{DVec2, DVec3};

use crate::figure::error::{FigureError, check_finite};
use crate::figure::picture::{Anchor, Color, MarkerShape, Stroke};

pub use eye::{Eye, EyeView, Projected, Ray, StandardView, ViewAxes};
pub use light::Light;
pub use paper::Paper;
#[cfg(feature = "app")]
pub(crate) use paper::depth_slack;
pub use picking::{PointHit, SceneHit, TriangleHit, nearest_point};
pub use triangles::Triangles;

/// A polyline in space with valid points.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    points: Vec<DVec3>,
    /// Colour, width in pt, dashes.
    pub stroke: Stroke,
    /// Whether surfaces do not hide it.
    pub on_top: bool,
}

impl Line {
    /// A polyline that surfaces hide; nothing is drawn of fewer than two points.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn new(points: Vec<DVec3>, stroke: Stroke) -> Result<Self, FigureError> {
        check_finite("point", points.iter().map(|point| point.to_array()))?;
        Ok(Self { points, stroke, on_top: false })
    }

    /// The same line over everything.
    #[must_use]
    pub fn on_top(self) -> Self {
        Self { on_top: true, ..self }
    }

    /// The points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
}

/// Marks of one look at points of space.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    points: Vec<DVec3>,
    /// Shape.
    pub shape: MarkerShape,
    /// Diameter, or side length, in pt.
    pub size: f64,
    /// Filling.
    pub fill: Color,
    /// Outline, if any.
    pub outline: Option<Stroke>,
    /// Whether surfaces do not hide them.
    pub on_top: bool,
}

impl Points {
    /// Marks without outline that surfaces hide.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn new(points: Vec<DVec3>, shape: MarkerShape, size: f64, fill: Color) -> Result<Self, FigureError> {
        check_finite("point", points.iter().map(|point| point.to_array()))?;
        Ok(Self { points, shape, size, fill, outline: None, on_top: false })
    }

    /// The same marks over everything.
    #[must_use]
    pub fn on_top(self) -> Self {
        Self { on_top: true, ..self }
    }

    /// The points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
}

/// A text at a point of space; nothing hides it.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLabel {
    at: DVec3,
    /// Shift from there in pt, x to the right, y up.
    pub offset: DVec2,
    /// The text, one line.
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

impl SceneLabel {
    /// Plain text that starts at its place.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn new(at: DVec3, text: impl Into<String>, size: f64, color: Color) -> Result<Self, FigureError> {
        check_finite("point", [at.to_array()])?;
        let (offset, anchor) = (DVec2::ZERO, Anchor::Start);
        Ok(Self { at, offset, text: text.into(), size, color, anchor, math: false })
    }

    /// The place.
    pub const fn at(&self) -> DVec3 {
        self.at
    }
}

/// One thing of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneItem {
    /// Surfaces.
    Triangles(Triangles),
    /// A line.
    Line(Line),
    /// Marks.
    Points(Points),
    /// A text.
    Label(SceneLabel),
}

/// Things that belong together, under a name that exporters keep.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLayer {
    /// Name, for example `surface 1: control net`.
    pub name: String,
    /// The things.
    pub items: Vec<SceneItem>,
}

/// What a view of space shows: a ground and layers. Surfaces hide each other and lines by depth; among lines, marks and texts
/// the first is drawn first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Colour of the ground; `None` for a clear one.
    pub background: Option<Color>,
    /// The layers.
    pub layers: Vec<SceneLayer>,
}

impl Scene {
    /// An empty scene.
    pub fn new(background: Option<Color>) -> Self {
        Self { background, layers: Vec::new() }
    }

    /// Adds a layer if it has items.
    pub fn push_layer(&mut self, name: impl Into<String>, items: Vec<SceneItem>) {
        if !items.is_empty() {
            self.layers.push(SceneLayer { name: name.into(), items });
        }
    }

    /// All surfaces.
    pub fn triangles(&self) -> impl Iterator<Item = &Triangles> {
        self.layers.iter().flat_map(|layer| &layer.items).filter_map(|item| match item {
            SceneItem::Triangles(triangles) => Some(triangles),
            _ => None,
        })
    }

    /// Lower and upper corner of the smallest upright box around everything; `None` if there is nothing.
    pub fn bounding_box(&self) -> Option<(DVec3, DVec3)> {
        let points = self.layers.iter().flat_map(|layer| &layer.items).flat_map(|item| match item {
            SceneItem::Triangles(triangles) => triangles.positions(),
            SceneItem::Line(line) => line.points(),
            SceneItem::Points(points) => points.points(),
            SceneItem::Label(label) => std::slice::from_ref(&label.at),
        });
        points.fold(None, |found, &point| match found {
            None => Some((point, point)),
            Some((low, high)) => Some((point.min(low), point.max(high))),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_without_a_place_are_refused() {
        let stroke = Stroke::solid(Color::hex(0), 1.0);
        let hole = DVec3::new(0.0, f64::NEG_INFINITY, 0.0);
        let expected = FigureError::NonFinite { what: "point", index: 1, value: f64::NEG_INFINITY };
        assert_eq!(Line::new(vec![DVec3::ZERO, hole], stroke), Err(expected.clone()), "line");
        let marks = Points::new(vec![DVec3::ZERO, hole], MarkerShape::Disc, 5.0, Color::hex(0));
        assert_eq!(marks, Err(expected), "marks");
        assert!(SceneLabel::new(hole, "P", 9.0, Color::hex(0)).is_err(), "label");
    }

    #[test]
    fn the_box_holds_everything() {
        let mut scene = Scene::new(None);
        assert_eq!(scene.bounding_box(), None, "nothing");
        let line =
            Line::new(vec![DVec3::X, DVec3::new(0.0, -2.0, 5.0)], Stroke::solid(Color::hex(0), 1.0)).unwrap();
        let label = SceneLabel::new(DVec3::splat(3.0), "P", 9.0, Color::hex(0)).unwrap();
        scene.push_layer("a", vec![SceneItem::Line(line), SceneItem::Label(label)]);
        scene.push_layer("empty", Vec::new());
        assert_eq!(scene.layers.len(), 1, "empty layers are none");
        assert_eq!(
            scene.bounding_box(),
            Some((DVec3::new(0.0, -2.0, 0.0), DVec3::new(3.0, 3.0, 5.0))),
            "box"
        );
    }
}
