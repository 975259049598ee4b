//! The probe line: a straight line crosses a curve at most as often as it crosses the control polygon.
//!
//! The crossings of the curve are also enclosed by bisection: a piece is halved as long as its control points lie on both sides of the line, and each crossing gets
//! the boxes of its last pieces, numbered by depth. Course: sections 6.2 and 6.3.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::{Hyperplane, LineIntersection, Nurbs, variation};
use crate::core::triangular_scheme::collapse_both;
use crate::document::CurveDisplay;
use crate::figure::composition::looks::{MANY_FOR_LOOKS, bounds, text, too_many};
use crate::figure::composition::measured::Measured;
use crate::figure::picture::{Item, Marker, MarkerShape, Path, Stroke, Viewport};
use crate::figure::theme::Theme;

/// Halvings that are shown.
const DEPTH: usize = 5;
/// Boxes that are shown.
const MANY_BOXES: usize = 400;

/// What a line has in common with a curve and with its control polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The common points with the curve.
    pub curve: Vec<LineIntersection>,
    /// How often the control polygon changes sides.
    pub polygon: usize,
}

/// The two points that define the line.
pub fn probe_ends(curve: &Nurbs<DVec2>, display: &CurveDisplay) -> [DVec2; 2] {
    display.probe.unwrap_or_else(|| {
        let (low, high) = bounds(curve);
        let (middle, reach) =
            (low.midpoint(high), 0.42 * (high.x - low.x).max(0.2 * (high.y - low.y)).max(1e-3));
        [middle - DVec2::X * reach, middle + DVec2::X * reach]
    })
}

/// Counts and finds the crossings with the line through `ends`.
///
/// # Errors
///
/// `Degenerate` if the ends are equal; `NonFinite`.
pub fn probe(curve: &Nurbs<DVec2>, ends: [DVec2; 2]) -> Result<Probe, SplineError> {
    let normal = (ends[1] - ends[0]).perp();
    let line = Hyperplane::new(normal, normal.dot(ends[0]))?;
    let (low, high) = bounds(curve);
    let found =
        curve.intersect_line(normal, normal.dot(ends[0]), 1e-12 * (high - low).length().max(1e-300))?;
    let mut points = curve.points().to_vec();
    if curve.space().is_periodic() {
        points.push(points[0]);
    }
    Ok(Probe { curve: found, polygon: variation(&points, &line) })
}

pub(super) fn items(
    curve: &Nurbs<DVec2>,
    measured: &Measured,
    display: &CurveDisplay,
    theme: &Theme,
    viewport: &Viewport,
) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Probe line", theme) {
        return sentence;
    }
    let ends = probe_ends(curve, display);
    let (Some(crossings), Some(along)) = (measured.crossings(ends), (ends[1] - ends[0]).try_normalize())
    else {
        return Vec::new();
    };
    let Some(found) = &crossings.probe else { return Vec::new() };
    let tint = theme.selection;
    let reach = along * (viewport.size.length() / viewport.scale);
    let faint = Stroke::dashed(tint.with_opacity(0.5), theme.stroke_scale, 5.0, 4.0);
    let mut items = vec![
        Item::Path(Path::polyline(&[ends[0] - reach, ends[1] + reach], faint)),
        Item::Path(Path::polyline(&ends, Stroke::solid(tint, 1.8 * theme.stroke_scale))),
    ];
    for crossing in &found.curve {
        let rim = Stroke::solid(theme.background, 1.2);
        let (at, shape, size) = (crossing.point, MarkerShape::Disc, 8.0 * theme.stroke_scale.sqrt());
        items.push(Item::Marker(Marker { at, shape, size, fill: Some(tint), stroke: Some(rim) }));
    }
    for at in ends {
        let rim = Stroke::solid(tint, 2.0 * theme.stroke_scale);
        let (shape, size) = (MarkerShape::Square, 10.0 * theme.stroke_scale.sqrt());
        items.push(Item::Marker(Marker { at, shape, size, fill: Some(theme.background), stroke: Some(rim) }));
    }
    let words = format!("curve {} \u{2264} polygon {}", found.curve.len(), found.polygon);
    items.push(text(ends[1], DVec2::new(10.0, 8.0), words, theme.text, theme));
    items
}

/// The box of a piece that may meet the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bracket {
    depth: usize,
    low: DVec2,
    high: DVec2,
}

impl Bracket {
    fn items(&self, theme: &Theme) -> Vec<Item> {
        let Self { depth, low, high } = *self;
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let share = depth as f64 / DEPTH as f64;
        let tint = theme.muted_text.mixed(theme.selection, share).with_opacity(0.55);
        let rim = Stroke::solid(tint, 0.9 * theme.stroke_scale);
        let mut items = vec![Item::Path(Path::polygon(&corners, Some(rim), None))];
        if depth < 3 {
            let offset = DVec2::new(3.0, -12.0);
            items.push(text(DVec2::new(low.x, high.y), offset, (depth + 1).to_string(), tint, theme));
        }
        items
    }
}

/// The boxes of the pieces that may meet the line, smaller from depth to depth.
pub(super) fn bisection(
    curve: &Nurbs<DVec2>,
    measured: &Measured,
    display: &CurveDisplay,
    theme: &Theme,
) -> Vec<Item> {
    let few = curve.points().len() <= MANY_FOR_LOOKS;
    let crossings = measured.crossings(probe_ends(curve, display)).filter(|_| few);
    crossings.iter().flat_map(|found| &found.brackets).flat_map(|bracket| bracket.items(theme)).collect()
}

pub(super) fn brackets(curve: &Nurbs<DVec2>, ends: [DVec2; 2]) -> Vec<Bracket> {
    let normal = (ends[1] - ends[0]).perp();
    let pieces = curve.homogeneous().bezier_pieces();
    let mut level: Vec<Vec<_>> = pieces.iter().map(|(_, points)| points.to_vec()).collect();
    let mut boxes = Vec::new();
    for depth in 0..=DEPTH {
        let heights = |piece: &Vec<glam::DVec3>| {
            let mut heights = piece.iter().map(|p| normal.dot(p.truncate()) - normal.dot(ends[0]) * p.z);
            let first = heights.next().unwrap_or(0.0);
            heights.fold((first, first), |(low, high), height| (low.min(height), high.max(height)))
        };
        level.retain(|piece| {
            let (low, high) = heights(piece);
            low <= 0.0 && high >= 0.0
        });
        if boxes.len() + level.len() > MANY_BOXES {
            break;
        }
        for piece in &level {
            let points: Vec<DVec2> = piece.iter().map(|&lifted| DVec2::project(lifted).0).collect();
            let (low, high) =
                points.iter().fold((points[0], points[0]), |(low, high), &p| (low.min(p), high.max(p)));
            boxes.push(Bracket { depth, low, high });
        }
        level = level.iter().flat_map(|piece| halves(piece)).collect();
    }
    boxes
}

/// Both halves of a Bezier piece, by de Casteljau's algorithm.
fn halves(piece: &[glam::DVec3]) -> [Vec<glam::DVec3>; 2] {
    let mut right = piece.to_vec();
    let mut left = right.clone();
    collapse_both(&mut right, 0.5, &mut left);
    [left, right]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;

    #[test]
    fn a_line_crosses_a_circle_twice_and_its_polygon_as_often() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let found = probe(&circle, [DVec2::new(-2.0, 0.3), DVec2::new(2.0, 0.4)]).unwrap();
        assert_eq!((found.curve.len(), found.polygon), (2, 2), "{found:?}");
        assert_eq!(probe(&circle, [DVec2::Y * 3.0, DVec2::new(1.0, 3.0)]).unwrap().polygon, 0, "beside it");
        assert!(probe(&circle, [DVec2::X; 2]).is_err(), "no line");
        let boxes = brackets(&circle, [DVec2::new(-2.0, 0.3), DVec2::new(2.0, 0.4)]);
        assert!(boxes.len() > 2 * DEPTH, "at least a box for each depth and crossing");
    }
}
