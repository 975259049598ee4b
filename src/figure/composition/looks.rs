//! What is measured on a curve, drawn: frame, hodograph, Bezier points, blossoms, the distance tube, inflections, extrema of the curvature, symmetry.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::point::Point as _;
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::{Nurbs, SymmetryKind, VertexKind, convex_hull};
use crate::document::CurveDisplay;
use crate::figure::composition::curve_layers::{color, short_number};
use crate::figure::composition::measured::Measured;
use crate::figure::font_metrics::{FontFace, text_width};
use crate::figure::label_placement::PageBox;
use crate::figure::picture::{Anchor, Color, Item, Label, Marker, MarkerShape, Path, Stroke, Viewport};
use crate::figure::theme::Theme;

/// Curves with more control points are not measured while they are drawn, so that they stay quick to edit.
pub const MANY_FOR_LOOKS: usize = 600;
/// More marks than this have no labels.
const MANY_LABELS: usize = 16;
/// Samples of the hodograph between two knots.
const SAMPLES: usize = 24;

pub(super) fn text(at: DVec2, offset: DVec2, text: impl Into<String>, color: Color, theme: &Theme) -> Item {
    let (text, size) = (text.into(), 11.0 * theme.text_scale);
    Item::Label(Label { at, offset, text, size, color, anchor: Anchor::Start, math: false })
}

fn math(at: DVec2, offset: DVec2, text: &str, color: Color, theme: &Theme) -> Item {
    let (text, size) = (text.to_owned(), 13.0 * theme.text_scale);
    Item::Label(Label { at, offset, text, size, color, anchor: Anchor::Start, math: true })
}

fn mark(at: DVec2, shape: MarkerShape, size: f64, fill: Option<Color>, stroke: Stroke) -> Item {
    Item::Marker(Marker { at, shape, size, fill, stroke: Some(stroke) })
}

/// The sentence in place of what would take too long; `None` if it does not.
pub(super) fn too_many(curve: &Nurbs<DVec2>, what: &str, theme: &Theme) -> Option<Vec<Item>> {
    let count = curve.points().len();
    (count > MANY_FOR_LOOKS).then(|| {
        let sentence = format!("{what}: not for {count} control points (at most {MANY_FOR_LOOKS})");
        vec![text(curve.points()[0], DVec2::new(10.0, 24.0), sentence, theme.warning, theme)]
    })
}

/// A line from `from` to `to` with a head of `head` world units.
fn arrow(from: DVec2, to: DVec2, head: f64, stroke: &Stroke) -> Vec<Item> {
    let Some(along) = (to - from).try_normalize() else { return Vec::new() };
    let (back, side) = (to - along * head, along.perp() * (0.4 * head));
    let tip = Path::polygon(&[to, back + side, back - side], None, Some(stroke.color));
    vec![Item::Path(Path::polyline(&[from, to], stroke.clone())), Item::Path(tip)]
}

pub(super) fn frame(curve: &Nurbs<DVec2>, parameter: f64, theme: &Theme, viewport: &Viewport) -> Vec<Item> {
    let Ok(frame) = curve.frame(parameter, Side::Right) else { return Vec::new() };
    let pt = viewport.scale.recip();
    let mut items = Vec::new();
    for (vector, name, tint) in [(frame.tangent, "T", theme.accent), (frame.normal, "N", theme.selection)] {
        let tip = frame.point + vector * (52.0 * pt * theme.stroke_scale.sqrt());
        items.extend(arrow(frame.point, tip, 9.0 * pt, &Stroke::solid(tint, 2.0 * theme.stroke_scale)));
        let offset = vector * 9.0 - DVec2::new(4.0, 4.0);
        items.push(math(tip, offset, name, tint, theme));
    }
    items
}

pub(super) fn bezier_points(curve: &Nurbs<DVec2>, display: &CurveDisplay, theme: &Theme) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Bezier points", theme) {
        return sentence;
    }
    let tint = theme.palette[(display.color + 2) % theme.palette.len()];
    let pieces = curve.homogeneous().bezier_pieces();
    let points: Vec<DVec2> = pieces.points().iter().map(|&lifted| DVec2::project(lifted).0).collect();
    let line = Stroke::dashed(tint.with_opacity(0.8), theme.stroke_scale, 4.0, 3.0);
    let mut items = vec![Item::Path(Path::polyline(&points, line))];
    let rim = Stroke::solid(theme.background, theme.stroke_scale);
    let size = 6.5 * theme.stroke_scale.sqrt();
    items.extend(points.iter().map(|&at| mark(at, MarkerShape::Square, size, Some(tint), rim.clone())));
    items
}

pub(super) fn blossom_labels(curve: &Nurbs<DVec2>, theme: &Theme) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Blossom labels", theme) {
        return sentence;
    }
    let (n, space) = (curve.degree(), curve.space());
    let label = |(k, &at): (usize, &DVec2)| {
        let knots = (k + 1..=k + n).filter_map(|j| space.knot(j as isize)).map(short_number);
        let name = format!("[{}]", knots.collect::<Vec<_>>().join(", "));
        text(at, DVec2::new(8.0, -16.0), name, theme.text, theme)
    };
    curve.points().iter().enumerate().map(label).collect()
}

pub(super) fn distance_tube(
    curve: &Nurbs<DVec2>,
    measured: &Measured,
    display: &CurveDisplay,
    theme: &Theme,
) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Distance tube", theme) {
        return sentence;
    }
    if !curve.is_polynomial() {
        let sentence = "Distance tube: only for equal weights";
        return vec![text(curve.points()[0], DVec2::new(10.0, 24.0), sentence, theme.warning, theme)];
    }
    let spline = curve.without_weights();
    let Some(distances) = measured.distances() else { return Vec::new() };
    let tint = color(display, theme);
    let averages = polygon_corners(curve);
    let mut items = Vec::new();
    for part in distances {
        let (a, b) = part.interval;
        let inner = averages.iter().copied().filter(|&t| a < t && t < b);
        let corners: Vec<DVec2> = [a]
            .into_iter()
            .chain(inner)
            .chain([b])
            .filter_map(|t| spline.control_polygon_at(t).ok())
            .collect();
        // In the maximum norm a ball is a square.
        for edge in corners.windows(2) {
            let squares: Vec<DVec2> = edge
                .iter()
                .flat_map(|&at| {
                    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                        .map(|(x, y)| at + DVec2::new(x, y) * part.bound)
                })
                .collect();
            let hull = convex_hull(&squares);
            items.push(Item::Path(Path::polygon(&hull, None, Some(tint.with_opacity(0.07)))));
        }
    }
    let worst = distances.iter().max_by(|a, b| a.measured.total_cmp(&b.measured));
    if let Some(worst) = worst
        && let (Ok(on), Ok(polygon)) = (curve.evaluate(worst.at), spline.control_polygon_at(worst.at))
    {
        let stroke = Stroke::solid(theme.accent, 1.6 * theme.stroke_scale);
        items.push(Item::Path(Path::polyline(&[on, polygon], stroke)));
        let words = format!(
            "bound {}, measured {}, ratio {:.2}",
            short_number(worst.bound),
            short_number(worst.measured),
            worst.ratio()
        );
        items.push(text(on.mix(polygon, 0.5), DVec2::new(10.0, -4.0), words, theme.text, theme));
    }
    items
}

/// The parameters at which the control polygon has its corners, also of a closed curve, increasing.
fn polygon_corners(curve: &Nurbs<DVec2>) -> Vec<f64> {
    let (n, space) = (curve.degree(), curve.space());
    let knots = space.evaluation_knots();
    (0..space.evaluation_dimension())
        .map(|k| {
            knots[k + 1..=k + n].iter().map(|knot| knot - knots[k + 1]).sum::<f64>() / n as f64 + knots[k + 1]
        })
        .collect()
}

pub(super) fn inflections(curve: &Nurbs<DVec2>, measured: &Measured, theme: &Theme) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Inflections", theme) {
        return sentence;
    }
    let Some(found) = measured.inflections() else { return Vec::new() };
    let labelled = found.parameters.len() <= MANY_LABELS;
    let mut items = Vec::new();
    for &parameter in &found.parameters {
        let Ok(at) = curve.evaluate(parameter) else { continue };
        let stroke = Stroke::solid(theme.error, 2.2 * theme.stroke_scale);
        items.push(mark(at, MarkerShape::Cross, 11.0 * theme.stroke_scale.sqrt(), None, stroke));
        if labelled {
            let words = format!("inflection, t = {}", short_number(parameter));
            items.push(text(at, DVec2::new(10.0, 5.0), words, theme.text, theme));
        }
    }
    items
}

pub(super) fn vertices(curve: &Nurbs<DVec2>, measured: &Measured, theme: &Theme) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Curvature extrema", theme) {
        return sentence;
    }
    let Some(found) = measured.vertices() else { return Vec::new() };
    let inner: Vec<_> = found.vertices.iter().filter(|vertex| vertex.kind != VertexKind::End).collect();
    let labelled = inner.len() <= MANY_LABELS;
    let mut items = Vec::new();
    for vertex in inner {
        let Ok(at) = curve.evaluate(vertex.parameter) else { continue };
        let [left, right] = vertex.curvatures;
        let fill = match vertex.kind {
            VertexKind::Maximum => theme.comb,
            VertexKind::Minimum => theme.background,
            VertexKind::Knot | VertexKind::End => theme.warning,
        };
        let rim = Stroke::solid(theme.comb, 1.6 * theme.stroke_scale);
        items.push(mark(at, MarkerShape::Triangle, 10.0 * theme.stroke_scale.sqrt(), Some(fill), rim));
        if labelled {
            let kind = match vertex.kind {
                VertexKind::Maximum => "max",
                VertexKind::Minimum => "min",
                VertexKind::Knot | VertexKind::End => "knot",
            };
            let words = if (left - right).abs() <= 1e-6 * left.abs().max(right.abs()) {
                format!("{kind} \u{3ba} = {}", short_number(left))
            } else {
                format!("{kind} \u{3ba} = {} | {}", short_number(left), short_number(right))
            };
            items.push(text(at, DVec2::new(9.0, -15.0), words, theme.comb, theme));
        }
    }
    items
}

pub(super) fn symmetry(
    curve: &Nurbs<DVec2>,
    measured: &Measured,
    display: &CurveDisplay,
    theme: &Theme,
) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Symmetry", theme) {
        return sentence;
    }
    let Some(best) = measured.symmetry() else { return Vec::new() };
    let tint = theme.palette[(display.color + 3) % theme.palette.len()];
    let (low, high) = bounds(curve);
    let size = (high - low).length();
    let distance = if best.deviation <= 1e-4 * size {
        "symmetric".to_owned()
    } else {
        format!("off by {}", short_number(best.deviation))
    };
    match best.kind {
        SymmetryKind::Axis { through, direction } => {
            let reach = direction * (0.62 * size);
            let stroke =
                Stroke { dashes: vec![10.0, 3.0, 2.0, 3.0], ..Stroke::solid(tint, 1.4 * theme.stroke_scale) };
            let ends = [through - reach, through + reach];
            let top = if ends[0].y > ends[1].y { ends[0] } else { ends[1] };
            vec![
                Item::Path(Path::polyline(&ends, stroke)),
                text(top, DVec2::new(8.0, -4.0), format!("nearest axis: {distance}"), tint, theme),
            ]
        }
        SymmetryKind::Center(center) => {
            let stroke = Stroke::solid(tint, 2.0 * theme.stroke_scale);
            vec![
                mark(center, MarkerShape::Cross, 13.0, None, stroke),
                text(center, DVec2::new(10.0, -14.0), format!("nearest centre: {distance}"), tint, theme),
            ]
        }
    }
}

/// The box of the control points.
pub(super) fn bounds(curve: &Nurbs<DVec2>) -> (DVec2, DVec2) {
    let points = curve.points();
    points.iter().fold((points[0], points[0]), |(low, high), &p| (low.min(p), high.max(p)))
}

/// The derivative as a curve in `area` of the page (pt, y up), with its vector at the parameter, there and on the curve.
pub(super) fn hodograph(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    display: &CurveDisplay,
    theme: &Theme,
    viewport: &Viewport,
    area: PageBox,
) -> Vec<Item> {
    if let Some(sentence) = too_many(curve, "Hodograph", theme) {
        return sentence;
    }
    let slope = |t: f64, side: Side| curve.derivatives(t, 1, side).ok().map(|values| values[1]);
    let mut pieces: Vec<Vec<DVec2>> = Vec::new();
    for ends in curve.space().breaks().windows(2) {
        let samples = (0..=SAMPLES).filter_map(|i| {
            let side = if i == SAMPLES { Side::Left } else { Side::Right };
            slope(ends[0].mix(ends[1], i as f64 / SAMPLES as f64), side)
        });
        pieces.push(samples.collect());
    }
    let Some(now) = slope(parameter, Side::Right) else { return Vec::new() };
    // The origin belongs to the picture.
    let (low, high) = pieces
        .iter()
        .flatten()
        .fold((DVec2::ZERO, DVec2::ZERO), |(low, high), &point| (low.min(point), high.max(point)));
    let pt = viewport.scale.recip();
    let world = |page: DVec2| viewport.center + (page - viewport.size * 0.5) * pt;
    let size = 11.0 * theme.text_scale;
    // The caption has a strip of its own.
    let strip = 1.7 * size;
    let room = (area.high - area.low - DVec2::new(0.0, strip)).min_element() - 16.0;
    let extent = (high - low).max_element();
    if !(extent > 0.0 && extent.is_finite() && room > 24.0) {
        return Vec::new();
    }
    let scale = room * pt / extent;
    let (bottom, corner) = (world(area.low), world(area.high));
    let floor = bottom.y + strip * pt;
    let middle = DVec2::new(0.5 * (bottom.x + corner.x), 0.5 * (floor + corner.y));
    let place = |vector: DVec2| middle + (vector - (low + high) * 0.5) * scale;
    let frame = [bottom, DVec2::new(corner.x, bottom.y), corner, DVec2::new(bottom.x, corner.y)];
    let rim = Stroke::solid(theme.grid_major, theme.stroke_scale);
    let mut items =
        vec![Item::Path(Path::polygon(&frame, Some(rim), Some(theme.background.with_opacity(0.9))))];
    let axis = Stroke::solid(theme.axis, 0.8 * theme.stroke_scale);
    let origin = place(DVec2::ZERO);
    let tint = color(display, theme);
    items.push(Item::Path(Path::polyline(
        &[DVec2::new(bottom.x, origin.y), DVec2::new(corner.x, origin.y)],
        axis.clone(),
    )));
    items.push(Item::Path(Path::polyline(
        &[DVec2::new(origin.x, floor), DVec2::new(origin.x, corner.y)],
        axis,
    )));
    for piece in &pieces {
        let points: Vec<DVec2> = piece.iter().map(|&vector| place(vector)).collect();
        items.push(Item::Path(Path::polyline(&points, Stroke::solid(tint, 1.8 * theme.stroke_scale))));
    }
    let stroke = Stroke::solid(theme.accent, 2.0 * theme.stroke_scale);
    items.extend(arrow(origin, place(now), 8.0 * pt, &stroke));
    if let Ok(at) = curve.evaluate(parameter) {
        items.extend(arrow(at, at + now * scale, 8.0 * pt, &stroke));
    }
    let number = short_number(scale.recip());
    let room = area.high.x - area.low.x - 10.0;
    let mut words =
        [format!("derivative / {number}"), format!("r\u{2032} / {number}"), format!("/ {number}")]
            .into_iter();
    let words = words.find(|words| text_width(FontFace::Regular, words, size) <= room);
    items.extend(words.map(|words| text(bottom, DVec2::new(5.0, 0.5 * size), words, theme.text, theme)));
    items
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::document::{Document, Edit};

    fn wave() -> Nurbs<DVec2> {
        let points = [[0.0, 0.0], [1.0, 3.0], [2.0, -3.0], [3.0, 0.0]].map(DVec2::from).to_vec();
        Nurbs::polynomial(SplineSpace::from_breaks(3, &[0.0, 1.0], EndKnots::Interpolating).unwrap(), points)
            .unwrap()
    }

    fn measured(curve: &Nurbs<DVec2>) -> Measured {
        let mut document = Document::new();
        let (curve, display) = (curve.clone(), CurveDisplay::default());
        document.apply(&Edit::AddCurve { name: "curve".to_owned(), curve, display }).unwrap();
        Measured::new(&document.objects()[0])
    }

    fn words(items: &[Item]) -> Vec<&str> {
        items
            .iter()
            .filter_map(|item| if let Item::Label(label) = item { Some(label.text.as_str()) } else { None })
            .collect()
    }

    #[test]
    fn marks_and_numbers_of_a_wave() {
        let (curve, theme, display) = (wave(), Theme::light(), CurveDisplay::default());
        let measured = measured(&curve);
        assert_eq!(words(&inflections(&curve, &measured, &theme)), ["inflection, t = 0.5"], "its inflection");
        assert_eq!(
            words(&symmetry(&curve, &measured, &display, &theme)),
            ["nearest centre: symmetric"],
            "its centre"
        );
        assert_eq!(
            words(&blossom_labels(&curve, &theme)),
            ["[0, 0, 0]", "[0, 0, 1]", "[0, 1, 1]", "[1, 1, 1]"],
            "the knots"
        );
        let tube = distance_tube(&curve, &measured, &display, &theme);
        assert!(words(&tube)[0].starts_with("bound 3, measured 2.333"), "{:?}", words(&tube));
        assert!(
            words(&vertices(&curve, &measured, &theme)).iter().any(|word| word.starts_with("max")),
            "a maximum"
        );
    }

    #[test]
    fn the_tube_holds_the_curve() {
        let (curve, theme) = (wave(), Theme::light());
        let tube = distance_tube(&curve, &measured(&curve), &CurveDisplay::default(), &theme);
        let hulls: Vec<Vec<DVec2>> = tube
            .iter()
            .filter_map(|item| {
                if let Item::Path(path) = item {
                    path.fill.is_some().then(|| crate::figure::curve::flatten(&path.segments, 1.0).remove(0))
                } else {
                    None
                }
            })
            .collect();
        for i in 0..=40 {
            let at = curve.evaluate(f64::from(i) / 40.0).unwrap();
            let inside = |hull: &Vec<DVec2>| {
                hull.windows(2).all(|edge| (edge[1] - edge[0]).perp_dot(at - edge[0]) >= -1e-12)
            };
            assert!(hulls.iter().any(inside), "{at}");
        }
    }

    #[test]
    fn large_curves_get_a_sentence() {
        let space = SplineSpace::new(3, (0..10_004).map(f64::from).collect()).unwrap();
        let curve =
            Nurbs::polynomial(space, (0..10_000).map(|k| DVec2::from_angle(f64::from(k))).collect()).unwrap();
        assert!(
            words(&vertices(&curve, &measured(&curve), &Theme::light()))[0].contains("10000 control points"),
            "the sentence"
        );
    }
}
