//! The parts of the picture of one curve.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, PointLabels};
use crate::figure::comb::curvature_comb_over;
use crate::figure::composition::crowd::Crowd;
use crate::figure::curve::{curve_path, curve_span_paths};
use crate::figure::picture::{
    Anchor, Color, Item, Label, Marker, MarkerShape, Path, Segment, Stroke, Viewport,
};
use crate::figure::theme::Theme;

/// Largest distance, in pt, between a drawn curve and the exact one.
const TOLERANCE: f64 = 0.02;

/// The colour of an object.
pub(super) fn color(display: &CurveDisplay, theme: &Theme) -> Color {
    theme.palette[display.color % theme.palette.len()]
}

pub(super) fn curve(
    curve: &Nurbs<DVec2>,
    display: &CurveDisplay,
    theme: &Theme,
    viewport: &Viewport,
) -> Vec<Item> {
    let tolerance = TOLERANCE / viewport.scale;
    let width = display.width * theme.stroke_scale;
    let item = |segments: Vec<Segment>, color: Color| {
        Item::Path(Path { segments, stroke: Some(Stroke::solid(color, width)), fill: None })
    };
    let main = color(display, theme);
    if display.pieces {
        let second = theme.palette[(display.color + 1) % theme.palette.len()];
        let spans = curve_span_paths(curve, tolerance).into_iter().enumerate();
        return spans.map(|(i, span)| item(span.segments, if i % 2 == 0 { main } else { second })).collect();
    }
    vec![item(curve_path(curve, tolerance), main)]
}

pub(super) fn polygon(curve: &Nurbs<DVec2>, theme: &Theme) -> Vec<Item> {
    let stroke = theme.stroke(theme.polygon, 1.0);
    let path = if curve.space().is_periodic() {
        Path::polygon(curve.points(), Some(stroke), None)
    } else {
        Path::polyline(curve.points(), stroke)
    };
    vec![Item::Path(path)]
}

pub(super) fn points(
    curve: &Nurbs<DVec2>,
    display: &CurveDisplay,
    theme: &Theme,
    crowd: &Crowd,
) -> Vec<Item> {
    let main = color(display, theme);
    if crowd.dots() {
        let dot = |&at: &DVec2| {
            let size = 4.2 * theme.stroke_scale.sqrt();
            Item::Marker(Marker { at, shape: MarkerShape::Disc, size, fill: Some(main), stroke: None })
        };
        return curve.points().iter().filter(|at| crowd.sees(**at)).map(dot).collect();
    }
    let size = 9.0 * theme.stroke_scale.sqrt();
    let marker = |(&at, &weight): (&DVec2, &f64)| {
        // A heavier point is a larger disc; the logarithm keeps very large weights on the sheet.
        let grown = size * (1.0 + 0.18 * weight.ln().clamp(-2.5, 4.0));
        Item::Marker(Marker {
            at,
            shape: MarkerShape::Disc,
            size: grown.max(4.0_f64.min(size)),
            fill: Some(theme.background),
            stroke: Some(Stroke::solid(main, 1.8 * theme.stroke_scale)),
        })
    };
    curve.points().iter().zip(curve.weights()).filter(|(at, _)| crowd.sees(**at)).map(marker).collect()
}

pub(super) fn knots(curve: &Nurbs<DVec2>, display: &CurveDisplay, theme: &Theme, crowd: &Crowd) -> Vec<Item> {
    if crowd.dots() {
        return Vec::new();
    }
    let distinct = curve.space().distinct_knots();
    let main = color(display, theme);
    let mark = |knot: &crate::core::bspline::DistinctKnot| {
        if !crowd.sees_near(curve, knot.value) {
            return None;
        }
        let at = curve.evaluate(knot.value).ok()?;
        Some(Item::Marker(Marker {
            at,
            shape: MarkerShape::Diamond,
            size: (7.0 + 1.1 * (knot.multiplicity.min(8) as f64 - 1.0)) * theme.stroke_scale.sqrt(),
            fill: Some(main),
            stroke: Some(Stroke::solid(theme.background, 1.0)),
        }))
    };
    distinct.iter().filter_map(mark).collect()
}

pub(super) fn labels(
    curve: &Nurbs<DVec2>,
    display: &CurveDisplay,
    theme: &Theme,
    crowd: &Crowd,
) -> Vec<Item> {
    if display.labels == PointLabels::None || !crowd.labels() {
        return Vec::new();
    }
    let text = |k: usize| match display.labels {
        PointLabels::None => None,
        PointLabels::Index => Some((format!("c_{{{k}}}"), true)),
        PointLabels::Weight => Some((short_number(curve.weights()[k]), false)),
        PointLabels::Coordinates => {
            let point = curve.points()[k];
            Some((format!("({}, {})", short_number(point.x), short_number(point.y)), false))
        }
    };
    let label = |(k, &at): (usize, &DVec2)| {
        if !crowd.sees(at) {
            return None;
        }
        let (text, math) = text(k)?;
        let size = if math { 14.0 } else { 11.0 } * theme.text_scale;
        let (offset, color) = (DVec2::new(8.0, 7.0), theme.text);
        Some(Item::Label(Label { at, offset, text, size, color, anchor: Anchor::Start, math }))
    };
    curve.points().iter().enumerate().filter_map(label).collect()
}

/// At most four significant digits, without trailing zeros.
pub fn short_number(value: f64) -> String {
    if value.abs() >= 1e6 || (value != 0.0 && value.abs() < 1e-4) {
        return format!("{value:.3e}");
    }
    let digits = (3 - value.abs().max(1.0).log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

pub(super) fn comb(curve: &Nurbs<DVec2>, display: &CurveDisplay, theme: &Theme, crowd: &Crowd) -> Vec<Item> {
    let (mut teeth, mut envelope) = (Vec::new(), Vec::new());
    let (intervals, count) = crowd.comb_intervals(curve, display.comb_teeth);
    let mut end: Option<(f64, DVec2)> = None;
    for span in curvature_comb_over(curve, display.comb_scale, count, &intervals) {
        for (i, &(foot, tip)) in span.teeth.iter().enumerate() {
            teeth.extend([Segment::Move(foot), Segment::Line(tip)]);
            // Where the curvature does not jump the envelope goes on.
            let goes_on = i > 0 || end == Some((span.interval.0, tip));
            envelope.push(if goes_on { Segment::Line(tip) } else { Segment::Move(tip) });
        }
        end = span.teeth.last().map(|&(_, tip)| (span.interval.1, tip));
    }
    let path = |segments, color, width| {
        let stroke = Some(Stroke::solid(color, width * theme.stroke_scale));
        Item::Path(Path { segments, stroke, fill: None })
    };
    if teeth.is_empty() {
        return Vec::new();
    }
    vec![path(teeth, theme.comb.with_opacity(0.45), 0.8), path(envelope, theme.comb, 1.2)]
}

pub(super) fn hull(curve: &Nurbs<DVec2>, parameter: f64, display: &CurveDisplay, theme: &Theme) -> Vec<Item> {
    let Ok(scheme) = curve.de_boor_scheme(parameter) else { return Vec::new() };
    let active: Vec<DVec2> = scheme.coefficients.iter().map(|&k| curve.points()[k]).collect();
    let hull = convex_hull(&active);
    let main = color(display, theme);
    let stroke = Stroke::dashed(main.with_opacity(0.6), 1.0 * theme.stroke_scale, 4.0, 3.0);
    vec![Item::Path(Path::polygon(&hull, Some(stroke), Some(main.with_opacity(0.10))))]
}

/// The corners of the convex hull, counterclockwise, by Andrew's monotone chain (1979).
fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let mut hull: Vec<DVec2> = Vec::with_capacity(2 * sorted.len());
    for pass in 0..2 {
        let floor = hull.len() + 1;
        let step = |hull: &mut Vec<DVec2>, point: DVec2| {
            while hull.len() > floor {
                let (a, b) = (hull[hull.len() - 2], hull[hull.len() - 1]);
                if (b - a).perp_dot(point - a) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        };
        if pass == 0 {
            sorted.iter().for_each(|&point| step(&mut hull, point));
        } else {
            sorted.iter().rev().for_each(|&point| step(&mut hull, point));
        }
        hull.pop();
    }
    hull
}

pub(super) fn circle(curve: &Nurbs<DVec2>, parameter: f64, theme: &Theme) -> Vec<Item> {
    let Ok(values) = curve.derivatives(parameter, 2, Side::Right) else { return Vec::new() };
    let (point, first, second) = (values[0], values[1], values[2]);
    let speed = first.length();
    let bend = first.perp_dot(second);
    // Where the curve stands still or runs straight there is no circle.
    if speed <= 0.0 || bend.abs() <= 1e-12 * speed * second.length() {
        return Vec::new();
    }
    let radius = speed.powi(3) / bend;
    let center = point + first.perp() * (radius / speed);
    let stroke = Stroke::solid(theme.accent.with_opacity(0.8), 1.2 * theme.stroke_scale);
    let segments = circle_segments(center, radius.abs());
    vec![
        Item::Path(Path { segments, stroke: Some(stroke), fill: None }),
        Item::Path(Path::polyline(
            &[point, center],
            Stroke::dashed(theme.accent.with_opacity(0.8), theme.stroke_scale, 3.0, 3.0),
        )),
        Item::Marker(Marker {
            at: center,
            shape: MarkerShape::Cross,
            size: 6.0,
            fill: None,
            stroke: Some(Stroke::solid(theme.accent, 1.2 * theme.stroke_scale)),
        }),
    ]
}

/// Four cubics; the radius is off by at most 2.8e-4 of itself.
fn circle_segments(center: DVec2, radius: f64) -> Vec<Segment> {
    // 4/3·tan(π/8): the cubic agrees with the quarter circle at its ends and its middle.
    let handle = radius * 4.0 / 3.0 * (std::f64::consts::PI / 8.0).tan();
    let mut segments = vec![Segment::Move(center + DVec2::X * radius)];
    let mut axis = DVec2::X;
    for _ in 0..4 {
        let next = axis.perp();
        segments.push(Segment::Cubic(
            center + axis * radius + next * handle,
            center + next * radius + axis * handle,
            center + next * radius,
        ));
        axis = next;
    }
    segments.push(Segment::Close);
    segments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_of_a_square_with_inner_and_edge_points_has_four_corners() {
        let square = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)];
        let hull = convex_hull(&square.map(|(x, y)| DVec2::new(x, y)));
        assert_eq!(hull.len(), 4, "{hull:?}");
        let area: f64 = (0..4).map(|i| 0.5 * hull[i].perp_dot(hull[(i + 1) % 4])).sum();
        assert!((area - 4.0).abs() < 1e-15, "area {area}, positive because counterclockwise");
    }

    #[test]
    fn short_numbers_have_no_idle_digits() {
        for (value, text) in
            [(1.0, "1"), (0.5, "0.5"), (-2.25, "−2.25"), (123.456, "123.5"), (-0.0, "0"), (10000.0, "10000")]
        {
            assert_eq!(short_number(value), text, "{value}");
        }
    }

    #[test]
    fn circle_segments_stay_within_the_stated_distance() {
        let segments = circle_segments(DVec2::ZERO, 1.0);
        let mut start = DVec2::X;
        for segment in &segments[1..5] {
            let Segment::Cubic(a, b, end) = *segment else { panic!("a cubic") };
            for step in 0..=50 {
                let t = f64::from(step) / 50.0;
                let s = 1.0 - t;
                let point =
                    start * s.powi(3) + a * (3.0 * s * s * t) + b * (3.0 * s * t * t) + end * t.powi(3);
                assert!((point.length() - 1.0).abs() < 2.8e-4, "radius {}", point.length());
            }
            start = end;
        }
    }
}
