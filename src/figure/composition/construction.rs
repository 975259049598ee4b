//! De Boor's construction at one parameter, drawn: the polygons of the triangular scheme inside each other.

use std::collections::BTreeSet;

use glam::DVec2;

use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::document::CurveDisplay;
use crate::figure::composition::curve_layers::color;
use crate::figure::picture::{Color, Item, Marker, MarkerShape, Path, Stroke};
use crate::figure::theme::Theme;

/// The entries of the triangular scheme that are drawn: level and position; level 0 are the control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SchemeReveal {
    /// Entries that have been computed so far.
    pub shown: BTreeSet<(usize, usize)>,
    /// Entries that the present step is about.
    pub highlighted: BTreeSet<(usize, usize)>,
}

/// The construction of the point at `parameter`: all of it, or the revealed entries.
pub fn construction_items(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    reveal: Option<&SchemeReveal>,
    display: &CurveDisplay,
    theme: &Theme,
) -> Vec<Item> {
    let Ok(scheme) = curve.de_boor_scheme(parameter) else { return Vec::new() };
    let points = scheme.triangle.map(|lifted| DVec2::project(lifted).0);
    let shown =
        |level: usize, position: usize| reveal.is_none_or(|reveal| reveal.shown.contains(&(level, position)));
    let lit = |level: usize, position: usize| {
        reveal.is_some_and(|reveal| reveal.highlighted.contains(&(level, position)))
    };
    let last = points.levels().len() - 1;
    let mut items = Vec::new();
    for (level, row) in points.levels().iter().enumerate() {
        let tint = level_color(level, last, display, theme);
        let (tint, width) = if level == 0 { (tint.with_opacity(0.45), 3.0) } else { (tint, 1.5) };
        let width = width * theme.stroke_scale;
        for position in 1..row.len() {
            if shown(level, position - 1) && shown(level, position) {
                items.push(Item::Path(Path::polyline(
                    &row[position - 1..=position],
                    Stroke::solid(tint, width),
                )));
            }
        }
    }
    for (level, row) in points.levels().iter().enumerate().skip(1) {
        let tint = level_color(level, last, display, theme);
        for (position, &at) in row.iter().enumerate() {
            if shown(level, position) {
                let apex = level == last;
                let size = if apex { 10.0 } else { 6.0 } * theme.stroke_scale.sqrt();
                let stroke = Some(Stroke::solid(theme.background, 1.2));
                items.push(Item::Marker(Marker {
                    at,
                    shape: MarkerShape::Disc,
                    size,
                    fill: Some(tint),
                    stroke,
                }));
            }
        }
    }
    for (level, row) in points.levels().iter().enumerate() {
        for (position, &at) in row.iter().enumerate().filter(|&(position, _)| lit(level, position)) {
            debug_assert!(position < row.len(), "positions come from the row");
            let stroke = Some(Stroke::solid(theme.selection, 2.2 * theme.stroke_scale));
            items.push(Item::Marker(Marker { at, shape: MarkerShape::Disc, size: 15.0, fill: None, stroke }));
        }
    }
    items
}

/// From the muted colour of the polygon to the warning colour of the point, level by level.
fn level_color(level: usize, last: usize, display: &CurveDisplay, theme: &Theme) -> Color {
    let (from, to) = (color(display, theme), theme.accent);
    let share = if last == 0 { 1.0 } else { level as f64 / last as f64 };
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
    Color { r: mix(from.r, to.r), g: mix(from.g, to.g), b: mix(from.b, to.b), a: 235 }
}
