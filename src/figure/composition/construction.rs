//! Constructions on a curve, drawn: de Boor's scheme at one parameter, and whatever an algorithm shows at one of its steps.

use glam::DVec2;

use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::document::CurveDisplay;
use crate::figure::composition::curve_layers::color;
use crate::figure::picture::{Anchor, Color, Item, Label, Marker, MarkerShape, Path, Stroke};
use crate::figure::theme::Theme;

/// What a line or point of a step stands for; the theme gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepInk {
    /// A level of a scheme: from 0, the given points, to 1, the result.
    Level(f64),
    /// What is given or no longer needed.
    Muted,
    /// The first of two parts.
    First,
    /// The second of two parts.
    Second,
    /// The result, or what the step is about.
    Result,
    /// The line that is intersected.
    Line,
}

/// A polyline of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepLine {
    /// Its corners.
    pub points: Vec<DVec2>,
    /// What it stands for.
    pub ink: StepInk,
    /// Its width in pt.
    pub width: f64,
    /// Whether it is dashed.
    pub dashed: bool,
}

/// A point of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepDot {
    /// Where.
    pub at: DVec2,
    /// What it stands for.
    pub ink: StepInk,
    /// Its diameter in pt.
    pub size: f64,
    /// Whether the step is about this point.
    pub ring: bool,
    /// Its name, as a formula.
    pub label: Option<String>,
}

/// What an algorithm shows at one of its steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepDrawing {
    /// Polylines, first drawn first.
    pub lines: Vec<StepLine>,
    /// Points, on top of them.
    pub dots: Vec<StepDot>,
}

impl StepDrawing {
    /// Adds a line.
    #[must_use]
    pub fn line(mut self, points: Vec<DVec2>, ink: StepInk, width: f64) -> Self {
        self.lines.push(StepLine { points, ink, width, dashed: false });
        self
    }

    /// Adds a dashed line.
    #[must_use]
    pub fn dashed(mut self, points: Vec<DVec2>, ink: StepInk, width: f64) -> Self {
        self.lines.push(StepLine { points, ink, width, dashed: true });
        self
    }

    /// Adds the line from `from` to `to` with a head of two strokes at `to`.
    #[must_use]
    pub fn arrow(self, from: DVec2, to: DVec2, ink: StepInk, width: f64) -> Self {
        let back = (from - to) * 0.08;
        let (left, right) = (back + back.perp() * 0.45, back - back.perp() * 0.45);
        self.line(vec![from, to], ink, width).line(vec![to + left, to, to + right], ink, width)
    }

    /// Adds a point without a ring.
    #[must_use]
    pub fn dot(mut self, at: DVec2, ink: StepInk, size: f64, label: Option<String>) -> Self {
        self.dots.push(StepDot { at, ink, size, ring: false, label });
        self
    }

    /// Adds everything of `other`, on top.
    pub fn append(&mut self, other: &Self) {
        self.lines.extend_from_slice(&other.lines);
        self.dots.extend_from_slice(&other.dots);
    }

    /// The lines and points as things to draw.
    pub fn items(&self, display: &CurveDisplay, theme: &Theme) -> Vec<Item> {
        let finite = |points: &[DVec2]| points.iter().all(|point| point.is_finite());
        let line = |line: &StepLine| {
            let (tint, width) = (ink_color(line.ink, display, theme), line.width * theme.stroke_scale);
            let stroke = if line.dashed {
                Stroke::dashed(tint, width, 4.0 * width.max(1.0), 3.0 * width.max(1.0))
            } else {
                Stroke::solid(tint, width)
            };
            Item::Path(Path::polyline(&line.points, stroke))
        };
        let mut items: Vec<Item> = self.lines.iter().filter(|line| finite(&line.points)).map(line).collect();
        for dot in self.dots.iter().filter(|dot| dot.at.is_finite()) {
            let tint = ink_color(dot.ink, display, theme);
            let mark = |size: f64, fill: Option<Color>, stroke: Stroke| {
                let stroke = Some(stroke);
                Item::Marker(Marker { at: dot.at, shape: MarkerShape::Disc, size, fill, stroke })
            };
            if dot.size > 0.0 {
                let size = dot.size * theme.stroke_scale.sqrt();
                items.push(mark(size, Some(tint), Stroke::solid(theme.background, 1.2)));
            }
            if dot.ring {
                let size = (dot.size + 8.0).max(15.0);
                items.push(mark(size, None, Stroke::solid(theme.selection, 2.2 * theme.stroke_scale)));
            }
            if let Some(text) = &dot.label {
                items.push(Item::Label(Label {
                    at: dot.at,
                    // The name of the parameter stands on the upper right of its point.
                    offset: DVec2::new(-10.0, -14.0),
                    text: text.clone(),
                    size: 13.0 * theme.text_scale,
                    color: theme.text,
                    anchor: Anchor::End,
                    math: true,
                }));
            }
        }
        items
    }
}

/// De Boor's construction of the point at `parameter`.
pub fn construction_items(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    display: &CurveDisplay,
    theme: &Theme,
) -> Vec<Item> {
    let Ok(scheme) = curve.de_boor_scheme(parameter) else { return Vec::new() };
    let points = scheme.triangle.map(|lifted| DVec2::project(lifted).0);
    let last = points.levels().len() - 1;
    let mut drawing = StepDrawing::default();
    for (level, row) in points.levels().iter().enumerate() {
        drawing = drawing.level(level, last, row);
    }
    drawing.items(display, theme)
}

impl StepDrawing {
    /// Adds the polygon of one level of a scheme that ends with level `last`, and above level 0 its points.
    #[must_use]
    pub fn level(mut self, level: usize, last: usize, points: &[DVec2]) -> Self {
        let ink = StepInk::Level(if last == 0 { 1.0 } else { level as f64 / last as f64 });
        if points.len() > 1 {
            let (ink, width) = if level == 0 { (StepInk::Muted, 3.0) } else { (ink, 1.5) };
            self = self.line(points.to_vec(), ink, width);
        }
        if level > 0 {
            let size = if level == last { 10.0 } else { 6.0 };
            self.dots.extend(points.iter().map(|&at| StepDot { at, ink, size, ring: false, label: None }));
        }
        self
    }
}

fn ink_color(ink: StepInk, display: &CurveDisplay, theme: &Theme) -> Color {
    let own = color(display, theme);
    let other = |shift: usize| theme.palette[(display.color + shift) % theme.palette.len()];
    match ink {
        StepInk::Level(share) => Color { a: 235, ..own.mixed(theme.accent, share) },
        StepInk::Muted => own.with_opacity(0.45),
        StepInk::First => other(1),
        StepInk::Second => other(2),
        StepInk::Result => theme.accent,
        StepInk::Line => theme.text.with_opacity(0.7),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    fn curve() -> Nurbs<DVec2> {
        let space = SplineSpace::new(2, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X, DVec2::ONE]).unwrap()
    }

    #[test]
    fn de_boors_construction_ends_at_the_point_of_the_curve() {
        let items = construction_items(&curve(), 2.4, &CurveDisplay::default(), &Theme::light());
        let markers: Vec<DVec2> = items
            .iter()
            .filter_map(|item| match item {
                Item::Marker(marker) => Some(marker.at),
                _ => None,
            })
            .collect();
        assert_eq!(markers.len(), 3, "two points of level 1, one of level 2");
        assert!(markers[2].distance(curve().evaluate(2.4).unwrap()) < 1e-14, "{}", markers[2]);
        assert_eq!(items.len() - markers.len(), 2, "the polygons of the levels 0 and 1");
    }

    #[test]
    fn places_that_are_not_numbers_are_left_out_and_rings_and_names_are_drawn() {
        let ring = StepDot {
            at: DVec2::X,
            ink: StepInk::Result,
            size: 0.0,
            ring: true,
            label: Some("p_0^1".to_owned()),
        };
        let mut drawing = StepDrawing::default()
            .line(vec![DVec2::ZERO, DVec2::NAN], StepInk::First, 1.0)
            .dot(DVec2::INFINITY, StepInk::Muted, 5.0, None)
            .arrow(DVec2::ZERO, DVec2::X, StepInk::Second, 1.0);
        drawing.dots.push(ring);
        let items = drawing.items(&CurveDisplay::default(), &Theme::light());
        let kinds = items.iter().map(|item| match item {
            Item::Path(_) => "path",
            Item::Marker(_) => "marker",
            Item::Label(_) => "label",
            _ => "other",
        });
        assert_eq!(kinds.collect::<Vec<_>>(), ["path", "path", "marker", "label"], "shaft, head, ring, name");
    }
}
