//! The curves that the drawing tool makes of clicked points.

use glam::{DMat2, DVec2};

use crate::app::command::Command;
use crate::app::lab::DrawMode;
use crate::core::approximation::{EndConditions, cubic_interpolation};
use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::rational_bezier::{Conic, ConicKind, RationalBezier, quadratic_arc};
use crate::core::spline_curve::Nurbs;

/// The degree of a drawn curve as soon as it has enough points.
const DEGREE: usize = 3;

impl DrawMode {
    /// All modes, in the order of the menu.
    pub(crate) const ALL: [Self; 8] = [
        Self::Points,
        Self::Through,
        Self::Stroke,
        Self::Circle,
        Self::Arc,
        Self::Ellipse,
        Self::Conic,
        Self::ConicFive,
    ];

    /// The command that takes up the tool in this mode.
    pub(crate) fn command(self) -> Command {
        match self {
            Self::Points => Command::DrawTool,
            Self::Through => Command::DrawThrough,
            Self::Stroke => Command::DrawStroke,
            Self::Circle => Command::DrawCircle,
            Self::Arc => Command::DrawArc,
            Self::Ellipse => Command::DrawEllipse,
            Self::Conic => Command::DrawConic,
            Self::ConicFive => Command::DrawConicFive,
        }
    }

    /// How many clicks finish the curve; `None` if any number may.
    pub(super) fn clicks(self) -> Option<usize> {
        match self {
            Self::Points | Self::Through | Self::Stroke => None,
            Self::Circle => Some(2),
            Self::Arc | Self::Ellipse => Some(3),
            Self::Conic => Some(4),
            Self::ConicFive => Some(5),
        }
    }

    /// What the new object is called, before its number.
    pub(super) fn noun(self) -> &'static str {
        match self {
            Self::Points | Self::Through => "Curve",
            Self::Stroke => "Stroke",
            Self::Circle => "Circle",
            Self::Arc => "Arc",
            Self::Ellipse => "Ellipse",
            Self::Conic | Self::ConicFive => "Conic",
        }
    }

    /// What to do next, with so many points clicked.
    pub(super) fn hint(self, clicked: usize) -> &'static str {
        match (self, clicked) {
            (Self::Points, 0) => "Click control points, or type x; y and Enter.",
            (Self::Points, _) => {
                "Enter, double click or right click ends. A click on the first point closes. Backspace drops the last."
            }
            (Self::Through, 0) => "Click points for the curve to run through, or type x; y and Enter.",
            (Self::Through, _) => {
                "The curve runs through the points. Enter, double click or right click ends, a click on the first closes."
            }
            (Self::Stroke, _) => "Press and draw. End where you began to close the curve.",
            (Self::Circle, 0) => "Click the centre, or drag from it to the rim.",
            (Self::Circle, _) => "Click a point of the rim, or type the radius and Enter.",
            (Self::Arc, 0) => "Click where the arc starts.",
            (Self::Arc, 1) => "Click a point on its way.",
            (Self::Arc, _) => "Click where it ends.",
            (Self::Ellipse, 0) => "Click the centre, or drag from it along a half axis.",
            (Self::Ellipse, 1) => "Click the end of a half axis, or type its length and Enter.",
            (Self::Ellipse, _) => "Click how far the other half axis reaches, or type its length.",
            (Self::Conic, 0) => "Click where the arc starts.",
            (Self::Conic, 1) => "Click the middle control point, where the tangents meet.",
            (Self::Conic, 2) => "Click where the arc ends, or drag from there to set the weight.",
            (Self::Conic, _) => "Move along the middle line and click, or type the weight and Enter.",
            (Self::ConicFive, _) => "Click five points of the conic.",
        }
    }
}

/// The curves that the clicked points make, or why there are none. Not for strokes.
pub(super) fn construct(mode: DrawMode, points: &[DVec2], closed: bool) -> Result<Vec<Nurbs<DVec2>>, String> {
    let one = |curve: Result<Nurbs<DVec2>, String>| curve.map(|curve| vec![curve]);
    match (mode, points) {
        (DrawMode::Points | DrawMode::Stroke, _) => {
            one(drawn_curve(points, closed).map_err(|error| error.to_string()))
        }
        (DrawMode::Through, _) => one(through_points(points, closed)),
        (DrawMode::Circle, &[center, rim, ..]) => {
            one(Nurbs::circle(center, center.distance(rim)).map_err(|error| error.to_string()))
        }
        (DrawMode::Arc, &[start, way, end, ..]) => one(arc(start, way, end)),
        (DrawMode::Ellipse, &[center, first, second, ..]) => {
            let (u, v) = half_axes(center, first, second);
            one(ellipse(center, u, v))
        }
        (DrawMode::Conic, &[start, middle, end, place, ..]) => {
            let weight = conic_weight([start, middle, end], place);
            one(conic_arc([start, middle, end], weight))
        }
        (DrawMode::ConicFive, &[a, b, c, d, e, ..]) => conic_through([a, b, c, d, e]),
        _ => Err("More points are needed.".to_owned()),
    }
}

/// The curve with these control points: cubic, or of the highest degree they allow; ends interpolated, or closed.
pub(super) fn drawn_curve(points: &[DVec2], closed: bool) -> Result<Nurbs<DVec2>, SplineError> {
    let count = points.len();
    let degree = DEGREE.min(count.saturating_sub(1)).max(1);
    let space = if closed {
        SplineSpace::periodic(degree, count as f64, (0..count).map(|k| k as f64).collect())?
    } else {
        let intervals = count.saturating_sub(degree).max(1);
        let inner = (1..intervals).map(|k| k as f64);
        let end = intervals as f64;
        let mut knots = vec![-1.0];
        knots.extend(std::iter::repeat_n(0.0, degree));
        knots.extend(inner);
        knots.extend(std::iter::repeat_n(end, degree));
        knots.push(end + 1.0);
        SplineSpace::new(degree, knots)?
    };
    Nurbs::polynomial(space, points.to_vec())
}

/// The cubic spline through the points at their chord lengths; natural ends, or closed.
fn through_points(points: &[DVec2], closed: bool) -> Result<Nurbs<DVec2>, String> {
    let mut places: Vec<DVec2> = Vec::with_capacity(points.len());
    for &point in points {
        if places.last() != Some(&point) {
            places.push(point);
        }
    }
    if closed && places.len() > 1 && places.first() == places.last() {
        places.pop();
    }
    if places.len() < if closed { 3 } else { 2 } {
        return Err("More points are needed.".to_owned());
    }
    let mut sites = vec![0.0];
    for pair in places.windows(2) {
        sites.push(sites[sites.len() - 1] + pair[0].distance(pair[1]));
    }
    let last = places.len() - 1;
    let ends = if closed {
        EndConditions::PeriodicOver { period: sites[last] + places[last].distance(places[0]) }
    } else {
        EndConditions::Natural
    };
    let spline = cubic_interpolation(&sites, &places, ends).map_err(|error| error.to_string())?;
    let (space, coefficients) = spline.into_parts();
    let curve = Nurbs::polynomial(space, coefficients).map_err(|error| error.to_string())?;
    // With n-fold ends the first and the last control point are points of the curve.
    if closed {
        return Ok(curve);
    }
    let open = curve.opened().and_then(|open| {
        let end = open.points().len() - 1;
        open.with_point(0, places[0])?.with_point(end, places[last])
    });
    open.map_err(|error| error.to_string())
}

/// The centre and radius of the circle through three points.
pub(super) fn circle_through(a: DVec2, b: DVec2, c: DVec2) -> Option<(DVec2, f64)> {
    let (p, q) = (b - a, c - a);
    let area = 2.0 * p.perp_dot(q);
    let scale = p.length() * q.length();
    if area.is_nan() || area.abs() <= 1e-9 * scale {
        return None;
    }
    let way = (q.length_squared() * p.perp() - p.length_squared() * q.perp()) / area;
    Some((a + way, way.length()))
}

fn arc(start: DVec2, way: DVec2, end: DVec2) -> Result<Nurbs<DVec2>, String> {
    let Some((center, radius)) = circle_through(start, way, end) else {
        return Err("The three points lie on one line: no circle runs through them.".to_owned());
    };
    let from = (start - center).to_angle();
    let turn = (end - center).to_angle() - from;
    // Counterclockwise if the way is a left turn.
    let left = (way - start).perp_dot(end - start) > 0.0;
    let opening = if left {
        turn.rem_euclid(std::f64::consts::TAU)
    } else {
        turn.rem_euclid(std::f64::consts::TAU) - std::f64::consts::TAU
    };
    let pieces = quadratic_arc(center, radius, [from, from + opening]).map_err(|error| error.to_string())?;
    joined(&pieces)
}

fn joined(pieces: &[RationalBezier<DVec2>]) -> Result<Nurbs<DVec2>, String> {
    Nurbs::from_rational_bezier_curves(pieces).map_err(|error| error.to_string())
}

/// The half axis to `first`, and one at right angles that reaches as far as `second`.
pub(super) fn half_axes(center: DVec2, first: DVec2, second: DVec2) -> (DVec2, DVec2) {
    let u = first - center;
    let across = u.perp().normalize_or_zero();
    (u, across * (second - center).dot(across).abs())
}

fn ellipse(center: DVec2, u: DVec2, v: DVec2) -> Result<Nurbs<DVec2>, String> {
    if u.length() <= 0.0 || v.length() <= 1e-12 * u.length() {
        return Err("A half axis has no length.".to_owned());
    }
    let map = DMat2::from_cols(u, v);
    let unit = Nurbs::circle(DVec2::ZERO, 1.0);
    unit.and_then(|unit| unit.transformed(|point| center + map * point)).map_err(|error| error.to_string())
}

/// The middle weight for which the arc comes nearest to `place` on the line from the middle of the chord to the middle control point.
pub(super) fn conic_weight(points: [DVec2; 3], place: DVec2) -> f64 {
    let foot = points[0].midpoint(points[2]);
    let median = points[1] - foot;
    let share = (place - foot).dot(median) / median.length_squared();
    let share = if share.is_finite() { share.clamp(0.01, 0.99) } else { 0.5 };
    share / (1.0 - share)
}

/// The place on the median that stands for a weight: the shoulder point.
pub(super) fn shoulder(points: [DVec2; 3], weight: f64) -> DVec2 {
    points[0].midpoint(points[2]).lerp(points[1], weight / (1.0 + weight))
}

fn conic_arc(points: [DVec2; 3], weight: f64) -> Result<Nurbs<DVec2>, String> {
    let arc = RationalBezier::conic_arc(points, weight).map_err(|error| error.to_string())?;
    joined(&[arc])
}

/// The ellipse, or the branches of parabola and hyperbola on which the points lie, a little longer than needed.
fn conic_through(points: [DVec2; 5]) -> Result<Vec<Nurbs<DVec2>>, String> {
    let conic = Conic::through_points(points).map_err(|error| error.to_string())?;
    match conic.kind() {
        ConicKind::Ellipse => {
            let axes = conic.axes().map_err(|error| error.to_string())?;
            let [u, v] = [0, 1].map(|j| axes.directions[j] * axes.lengths[j]);
            Ok(vec![ellipse(axes.center, u, v)?])
        }
        ConicKind::Degenerate(_) => {
            Err("The conic through these points is a pair of lines: move one of them.".to_owned())
        }
        ConicKind::Parabola | ConicKind::Hyperbola => {
            let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
            let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
            let room = DVec2::splat(0.05 * (high - low).max_element());
            let arcs = conic.arcs_in_box(low - room, high + room).map_err(|error| error.to_string())?;
            let tolerance = 1e-6 * (high - low).max_element();
            let carries = |arc: &&RationalBezier<DVec2>| {
                let curve = joined(std::slice::from_ref(*arc)).ok();
                curve.is_some_and(|curve| {
                    let near = |&point: &DVec2| {
                        curve.closest_point(point).is_ok_and(|foot| foot.distance <= tolerance)
                    };
                    points.iter().any(near)
                })
            };
            arcs.iter().filter(carries).map(|arc| joined(std::slice::from_ref(arc))).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(curve: &Nurbs<DVec2>) -> Vec<DVec2> {
        let (left, right) = curve.space().parameter_interval();
        (0..=60).map(|k| curve.evaluate(left + (right - left) * f64::from(k) / 60.0).unwrap()).collect()
    }

    fn distance(curve: &Nurbs<DVec2>, place: DVec2) -> f64 {
        curve.closest_point(place).unwrap().distance
    }

    #[test]
    fn a_drawn_curve_starts_and_ends_at_its_first_and_last_point() {
        for count in 2..9 {
            let points: Vec<DVec2> =
                (0..count).map(|k| DVec2::new(f64::from(k), f64::from(k * k % 5))).collect();
            for mode in [DrawMode::Points, DrawMode::Through] {
                let curve = construct(mode, &points, false).unwrap().remove(0);
                let (left, right) = curve.space().parameter_interval();
                assert_eq!(curve.evaluate(left).unwrap(), points[0], "{count} points: start");
                let end = curve.evaluate(right).unwrap();
                assert!(end.distance(points[points.len() - 1]) < 1e-13, "{count} points: end");
                if mode == DrawMode::Through {
                    let off = points.iter().map(|&point| distance(&curve, point)).fold(0.0, f64::max);
                    assert!(off < 1e-12, "{count} points: off by {off}");
                }
            }
        }
    }

    #[test]
    fn three_points_make_a_closed_curve() {
        let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
        for mode in [DrawMode::Points, DrawMode::Through] {
            let curve = construct(mode, &points, true).unwrap().remove(0);
            assert!(curve.space().is_periodic(), "closed");
            let (left, right) = curve.space().parameter_interval();
            assert!(
                curve.evaluate(left).unwrap().distance(curve.evaluate(right).unwrap()) < 1e-14,
                "one period"
            );
        }
    }

    #[test]
    fn an_arc_runs_through_its_three_points_on_a_circle() {
        for [a, b, c] in [
            [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]],
            [[0.0, 0.0], [1.0, -0.2], [2.0, 0.0]],
            [[1.0, 0.1], [-3.0, 0.0], [1.0, -0.1]],
            [[3.0, 2.0], [3.5, 2.5], [2.0, -4.0]],
        ] {
            let [a, b, c] = [a, b, c].map(DVec2::from);
            let arc = construct(DrawMode::Arc, &[a, b, c], false).unwrap().remove(0);
            let (center, radius) = circle_through(a, b, c).unwrap();
            for place in samples(&arc) {
                assert!((place.distance(center) - radius).abs() < 1e-10 * radius, "{place} off the circle");
            }
            let places = samples(&arc);
            assert!(places[0].distance(a) < 1e-9 && places[60].distance(c) < 1e-9, "ends of {a} {b} {c}");
            assert!(distance(&arc, b) < 1e-9, "{b} is not on the way");
        }
        let line = [DVec2::ZERO, DVec2::X, DVec2::X * 2.0];
        assert!(construct(DrawMode::Arc, &line, false).is_err(), "on a line");
    }

    #[test]
    fn an_ellipse_has_its_half_axes() {
        let points = [DVec2::new(1.0, 1.0), DVec2::new(4.0, 5.0), DVec2::new(1.0, 3.5)];
        let ellipse = construct(DrawMode::Ellipse, &points, false).unwrap().remove(0);
        let (u, v) = half_axes(points[0], points[1], points[2]);
        assert!(u.dot(v).abs() < 1e-12 && (u.length() - 5.0).abs() < 1e-12, "{u} and {v}");
        for place in samples(&ellipse) {
            let way = place - points[0];
            let sum = (way.dot(u) / u.length_squared()).powi(2) + (way.dot(v) / v.length_squared()).powi(2);
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        }
    }

    #[test]
    fn a_conic_takes_its_weight_from_the_shoulder() {
        let points = [DVec2::ZERO, DVec2::new(1.0, 2.0), DVec2::new(3.0, 0.0)];
        for weight in [0.2, 1.0, 3.0] {
            let place = shoulder(points, weight);
            assert!((conic_weight(points, place) - weight).abs() < 1e-12, "{weight}");
            let all = [points[0], points[1], points[2], place];
            let arc = construct(DrawMode::Conic, &all, false).unwrap().remove(0);
            assert!(arc.evaluate(0.5).unwrap().distance(place) < 1e-12, "{weight}: not through the shoulder");
        }
    }

    #[test]
    fn five_points_lie_on_their_conic() {
        let hyperbola = |x: f64| DVec2::new(x, 1.0 / x);
        let parabola = |x: f64| DVec2::new(x, x * x);
        let ellipse = |x: f64| DVec2::new(3.0 * x.cos(), x.sin());
        let sets: [([DVec2; 5], usize); 4] = [
            ([0.0, 1.0, 2.0, 3.0, 5.0].map(ellipse), 1),
            ([-1.0, 0.0, 0.5, 1.0, 2.0].map(parabola), 1),
            ([0.5, 1.0, 1.5, 2.0, 3.0].map(hyperbola), 1),
            ([-0.5, -1.0, 1.5, 2.0, 3.0].map(hyperbola), 2),
        ];
        for (points, count) in sets {
            let curves = construct(DrawMode::ConicFive, &points, false).unwrap();
            assert_eq!(curves.len(), count, "branches through {points:?}");
            for point in points {
                let off = curves.iter().map(|curve| distance(curve, point)).fold(f64::INFINITY, f64::min);
                assert!(off < 1e-8, "{point} is off by {off}");
            }
        }
        let lines = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 2.0]].map(DVec2::from);
        assert!(construct(DrawMode::ConicFive, &lines, false).is_err(), "a pair of lines");
    }
}
