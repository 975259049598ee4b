//! A plane curve in homogeneous coordinates: a curve in space, its cone from the origin, and the plane w = 1 that shows it.

use glam::{DVec2, DVec3};

use crate::core::spline_curve::Nurbs;
use crate::document::{EyeState, ObjectId};
use crate::figure::mesh::Mesh;
use crate::figure::picture::{Anchor, Color, Item, Label, Marker, MarkerShape, Path, Picture, Stroke};
use crate::figure::scene::{Eye, EyeView};
use crate::figure::theme::Theme;

/// Room around the picture in pt.
const MARGIN: f64 = 20.0;
/// Weights that hands reach.
pub(super) const WEIGHTS: (f64, f64) = (1e-3, 1e3);

/// How the space of a curve is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Space {
    /// The curve.
    pub object: ObjectId,
    /// The eye.
    pub eye: Eye,
    /// Height of the plane w = 1 in units of the plane, so that the cone is neither flat nor a needle.
    pub height: f64,
    /// What is being dragged.
    pub held: Option<Held>,
}

/// What is dragged in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// The eye.
    Eye,
    /// A control point along its ray: index, and how much its weight exceeds that under the pointer at the press.
    Point(usize, f64),
}

impl Space {
    /// Looks at all of `curve` on a page of `size`.
    pub(super) fn fitting(object: ObjectId, curve: &Nurbs<DVec2>, size: DVec2) -> Self {
        let (low, high) = plane_box(curve);
        let height = 0.55 * (high - low).length();
        let state = EyeState { yaw: -1.1, pitch: 0.35, orthographic: false, ..EyeState::default() };
        let eye = Eye::new(state).unwrap_or_default();
        let space = Self { object, eye, height, held: None };
        let places: Vec<DVec3> = plane_corners(curve)
            .into_iter()
            .map(|at| space.lift(at, 1.0))
            .chain(curve.points().iter().zip(curve.weights()).map(|(&at, &w)| space.lift(at, w)))
            .chain([DVec3::ZERO])
            .collect();
        Self { eye: eye.fitted_to(places.iter().copied(), size, MARGIN), ..space }
    }

    /// The point `(w x, w y, w)` in the picture's space.
    pub(super) fn lift(&self, at: DVec2, weight: f64) -> DVec3 {
        (at * weight).extend(self.height * weight)
    }

    /// The weight at which the point over `at` is nearest to what lies under `page`.
    pub(super) fn weight_under(&self, at: DVec2, page: DVec2, size: DVec2) -> Option<f64> {
        let view = EyeView { eye: self.eye, size };
        view.along_axis(DVec3::ZERO, self.lift(at, 1.0), page)
    }

    /// The picture on a page of `size`; `lit` points are emphasised.
    pub(super) fn picture(
        &self,
        curve: &Nurbs<DVec2>,
        t: f64,
        lit: &[usize],
        size: DVec2,
        theme: &Theme,
    ) -> Picture {
        let draw = Pen { view: EyeView { eye: self.eye, size }, theme };
        let mut picture = Picture::new(None);
        let curved = curve.homogeneous();
        let (left, right) = curve.space().parameter_interval();
        let steps = (32 * curve.space().breaks().len()).clamp(96, 640);
        let samples: Vec<DVec3> = (0..=steps)
            .map(|step| left + (right - left) * step as f64 / steps as f64)
            .filter_map(|t| curved.evaluate(t).ok())
            .map(|h| DVec3::new(h.x, h.y, self.height * h.z))
            .collect();
        let plane: Vec<DVec3> = samples.iter().map(|at| *at * (self.height / at.z)).collect();
        let ink = theme.palette[0];
        let (cone, ray) = (theme.surface.with_opacity(0.16), Stroke::solid(ink.with_opacity(0.35), 0.8));

        let mut items: Vec<Item> = draw.fan(&samples, cone).into_iter().collect();
        for at in samples.iter().step_by((steps / 24).max(1)) {
            items.extend(draw.line(&[DVec3::ZERO, *at * (self.height / at.z).max(1.0)], ray.clone()));
        }
        picture.push_layer("cone", items);

        let corners = plane_corners(curve).map(|at| self.lift(at, 1.0));
        let edge = Stroke::solid(theme.axis, 1.0);
        let mut items: Vec<Item> =
            draw.polygon(&corners, Some(theme.axis.with_opacity(0.14)), Some(edge)).into_iter().collect();
        let polygon = Stroke::solid(theme.polygon, 1.0);
        let flat: Vec<DVec3> = curve.points().iter().map(|&at| self.lift(at, 1.0)).collect();
        items.extend(draw.line(&flat, polygon.clone()));
        items.extend(draw.line(&plane, Stroke::solid(ink, 2.2 * theme.stroke_scale)));
        items.extend(draw.label(corners[2], "w = 1", theme.muted_text));
        picture.push_layer("plane", items);

        let mut items = Vec::new();
        let high: Vec<DVec3> =
            curve.points().iter().zip(curve.weights()).map(|(&at, &weight)| self.lift(at, weight)).collect();
        for (k, (&at, &below)) in high.iter().zip(&flat).enumerate() {
            let is_lit = lit.contains(&k);
            let color = if is_lit { theme.selection } else { theme.axis.with_opacity(0.7) };
            let stroke = Stroke::dashed(color, if is_lit { 1.6 } else { 0.9 }, 4.0, 3.0);
            items.extend(draw.line(&[DVec3::ZERO, if at.z > below.z { at } else { below }], stroke));
            items.extend(draw.mark(below, MarkerShape::Disc, 4.5, theme.polygon));
        }
        items.extend(draw.line(&high, Stroke::dashed(theme.warning.with_opacity(0.8), 1.0, 5.0, 3.0)));
        items.extend(draw.line(&samples, Stroke::solid(theme.warning, 2.2 * theme.stroke_scale)));
        for (k, &at) in high.iter().enumerate() {
            let (size, color) = if lit.contains(&k) { (11.0, theme.selection) } else { (8.0, theme.warning) };
            items.extend(draw.mark(at, MarkerShape::Disc, size, color));
        }
        if let Ok(at) = curved.evaluate(t) {
            let at = DVec3::new(at.x, at.y, self.height * at.z);
            let below = at * (self.height / at.z);
            let far = if at.z > below.z { at } else { below };
            items.extend(draw.line(&[DVec3::ZERO, far], Stroke::solid(theme.accent, 1.4)));
            items.extend(draw.mark(at, MarkerShape::Square, 8.0, theme.accent));
            items.extend(draw.mark(below, MarkerShape::Square, 8.0, theme.accent));
        }
        items.extend(draw.mark(DVec3::ZERO, MarkerShape::Disc, 5.0, theme.text));
        items.extend(draw.label(DVec3::ZERO, "0", theme.muted_text));
        picture.push_layer("space", items);
        picture
    }
}

/// A little more than the box of the control points and the origin below.
fn plane_box(curve: &Nurbs<DVec2>) -> (DVec2, DVec2) {
    let first = curve.points().first().copied().unwrap_or_default();
    let (low, high) =
        curve.points().iter().fold((first, first), |(low, high), &at| (low.min(at), high.max(at)));
    let room = DVec2::splat((0.08 * (high - low).max_element()).max(1e-6));
    (low - room, high + room)
}

fn plane_corners(curve: &Nurbs<DVec2>) -> [DVec2; 4] {
    let (low, high) = plane_box(curve);
    [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

/// Draws what lies in space on a page: 1 unit is 1 pt, the origin is the lower left corner.
struct Pen<'a> {
    view: EyeView,
    theme: &'a Theme,
}

impl Pen<'_> {
    fn page(&self, at: DVec3) -> Option<DVec2> {
        let page = self.view.project(at)?.page;
        Some(DVec2::new(page.x, self.view.size.y - page.y))
    }

    fn all(&self, places: &[DVec3]) -> Option<Vec<DVec2>> {
        places.iter().map(|&at| self.page(at)).collect()
    }

    fn line(&self, places: &[DVec3], stroke: Stroke) -> Option<Item> {
        Some(Item::Path(Path::polyline(&self.all(places)?, stroke)))
    }

    fn polygon(&self, places: &[DVec3], fill: Option<Color>, stroke: Option<Stroke>) -> Option<Item> {
        Some(Item::Path(Path::polygon(&self.all(places)?, stroke, fill)))
    }

    /// The triangles from the origin to the pieces of a polyline.
    fn fan(&self, places: &[DVec3], color: Color) -> Option<Item> {
        let mut points = self.all(places)?;
        let apex = points.len() as u32;
        points.push(self.page(DVec3::ZERO)?);
        let triangles = (1..apex).map(|k| [apex, k - 1, k]).collect();
        let colors = vec![color; points.len()];
        Mesh::new(points, colors, triangles).ok().map(Item::Mesh)
    }

    fn mark(&self, at: DVec3, shape: MarkerShape, size: f64, color: Color) -> Option<Item> {
        let stroke = Some(Stroke::solid(self.theme.panel, 1.0));
        Some(Item::Marker(Marker { at: self.page(at)?, shape, size, fill: Some(color), stroke }))
    }

    fn label(&self, at: DVec3, text: &str, color: Color) -> Option<Item> {
        Some(Item::Label(Label {
            at: self.page(at)?,
            offset: DVec2::new(6.0, -12.0),
            text: text.to_owned(),
            size: 12.0 * self.theme.text_scale,
            color,
            anchor: Anchor::Start,
            math: false,
        }))
    }
}
