//! Spline curves as paths of lines and cubic Bezier curves.
//!
//! A polynomial piece of degree at most 3 becomes one cubic (degree 1: a line) that agrees with it up to rounding, also
//! in the parameter. Other pieces are cut into halves until a cubic with the same ends and end derivatives stays within
//! a tolerance. Course: sections 6.1 and 6.3.

use glam::DVec2;

use crate::core::bspline::Spline;
use crate::core::point::Point;
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::Nurbs;
use crate::figure::picture::Segment;

/// A piece is cut into at most `2^MAX_HALVINGS` cubics, whatever the tolerance.
const MAX_HALVINGS: u32 = 12;
/// The tolerance is taken to be at least this part of a piece's size; below it rounding decides.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// A cubic becomes at most so many lines, whatever the tolerance.
const MAX_LINES: f64 = 4096.0;

/// The path of a curve over one knot interval.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanPath {
    /// The knot interval `[ξₗ, ξₗ₊₁]`, not empty.
    pub interval: (f64, f64),
    /// A [`Segment::Move`] and one or several lines or cubics.
    pub segments: Vec<Segment>,
}

/// The whole curve as one path, in world units; a closed curve ends with [`Segment::Close`].
///
/// Polynomial pieces of degree at most 3 are exact. Others differ from the curve by at most `tolerance` (world units),
/// also when path and curve are compared at equal parameters. A tolerance below 1e-14 of a piece's size, or one that is
/// not a number, counts as that; no piece becomes more than 4096 cubics.
pub fn curve_path(curve: &Nurbs<DVec2>, tolerance: f64) -> Vec<Segment> {
    let mut path: Vec<Segment> = Vec::new();
    if curve.is_polynomial() && curve.degree() <= 3 {
        // All pieces in one sweep over the knots.
        let pieces = curve.without_weights().bezier_pieces();
        path.push(Segment::Move(pieces.points()[0]));
        path.extend(pieces.iter().filter_map(|(_, points)| exact_segment(points)));
    } else {
        for span in curve_span_paths(curve, tolerance) {
            let skipped = usize::from(!path.is_empty());
            path.extend(span.segments.into_iter().skip(skipped));
        }
    }
    if curve.space().is_periodic()
        && let Some(&Segment::Move(start)) = path.first()
        && let Some(last) = path.last_mut()
    {
        // The ends agree up to rounding; a path that closes exactly gets a proper join there.
        match last {
            Segment::Line(end) | Segment::Cubic(_, _, end) => *end = start,
            Segment::Move(_) | Segment::Close => {}
        }
        path.push(Segment::Close);
    }
    path
}

/// One path for each knot interval, from left to right; tolerance as in [`curve_path`].
pub fn curve_span_paths(curve: &Nurbs<DVec2>, tolerance: f64) -> Vec<SpanPath> {
    let space = curve.space();
    let (n, knots) = (space.degree(), space.evaluation_knots());
    (n..space.evaluation_dimension())
        .filter(|&span| knots[span] < knots[span + 1])
        .map(|span| {
            let interval = (knots[span], knots[span + 1]);
            SpanPath { interval, segments: span_path(curve, span, interval, tolerance) }
        })
        .collect()
}

fn span_path(curve: &Nurbs<DVec2>, span: usize, interval: (f64, f64), tolerance: f64) -> Vec<Segment> {
    let n = curve.degree();
    let homogeneous = curve.homogeneous();
    let weight_of = |k: usize| homogeneous.evaluation_coefficient(k).z;
    let is_polynomial = (span - n..span).all(|k| weight_of(k).to_bits() == weight_of(k + 1).to_bits());
    if is_polynomial && n <= 3 {
        let points = bezier_points(curve.without_weights(), span, interval);
        return [Segment::Move(points[0])].into_iter().chain(exact_segment(&points)).collect();
    }
    let whole = RationalPiece::new(curve, span, interval);
    // Piece and chord both lie in the disc around the start that holds the control points.
    if 2.0 * whole.size() <= tolerance {
        return vec![Segment::Move(whole.points[0]), Segment::Line(whole.points[n])];
    }
    let tolerance = tolerance.max(SMALLEST_TOLERANCE * whole.size());
    let mut segments = vec![Segment::Move(whole.points[0])];
    // A stack, the leftmost piece on top: pieces not yet drawn, and how often each was halved.
    let mut pieces = vec![(interval, 0)];
    while let Some(((a, b), halvings)) = pieces.pop() {
        let piece = RationalPiece::new(curve, span, (a, b));
        let cubic = piece.hermite_cubic();
        let middle = a + (b - a) * 0.5;
        let can_halve = halvings < MAX_HALVINGS && a < middle && middle < b;
        if can_halve && piece.distance_bound(cubic) > tolerance {
            pieces.push(((middle, b), halvings + 1));
            pieces.push(((a, middle), halvings + 1));
        } else {
            segments.push(Segment::Cubic(cubic[1], cubic[2], cubic[3]));
        }
    }
    segments
}

/// A polynomial piece of degree at most 3 behind its start.
fn exact_segment(points: &[DVec2]) -> Option<Segment> {
    match *points {
        [_, b] => Some(Segment::Line(b)),
        [a, b, c] => Some(Segment::Cubic(a + (b - a) * (2.0 / 3.0), c + (b - c) * (2.0 / 3.0), c)),
        [_, b, c, d] => Some(Segment::Cubic(b, c, d)),
        _ => None,
    }
}

/// The Bezier points over `interval`, inside knot interval number `span`: the blossom at `(a, …, a, b, …, b)`.
fn bezier_points<P: Point>(spline: &Spline<P>, span: usize, (a, b): (f64, f64)) -> Vec<P> {
    let (n, knots) = (spline.degree(), spline.space().evaluation_knots());
    (0..=n)
        .map(|copies_of_b| {
            let mut local: Vec<P> = (0..=n).map(|j| spline.evaluation_coefficient(span + j - n)).collect();
            for level in 1..=n {
                let x = if level <= n - copies_of_b { a } else { b };
                for j in (level..=n).rev() {
                    let k = span + j - n;
                    let gamma = (x - knots[k]) / (knots[k + n + 1 - level] - knots[k]);
                    local[j] = local[j - 1].mix(local[j], gamma);
                }
            }
            local[n]
        })
        .collect()
}

/// A rational Bezier piece with Cartesian control points.
struct RationalPiece {
    points: Vec<DVec2>,
    weights: Vec<f64>,
}

impl RationalPiece {
    fn new(curve: &Nurbs<DVec2>, span: usize, interval: (f64, f64)) -> Self {
        let (points, weights) =
            bezier_points(curve.homogeneous(), span, interval).into_iter().map(DVec2::project).unzip();
        Self { points, weights }
    }

    fn size(&self) -> f64 {
        self.points.iter().map(|&point| (point - self.points[0]).norm()).fold(0.0, f64::max)
    }

    /// The cubic with the same ends and the same derivatives there.
    fn hermite_cubic(&self) -> [DVec2; 4] {
        let (n, points, weights) = (self.points.len() - 1, &self.points, &self.weights);
        let third = n as f64 / 3.0;
        let first = points[0] + (points[1] - points[0]) * (third * weights[1] / weights[0]);
        let second = points[n] + (points[n - 1] - points[n]) * (third * weights[n - 1] / weights[n]);
        [points[0], first, second, points[n]]
    }

    /// A bound of the distance to `cubic` at equal parameters.
    ///
    /// With `r = p/q` the difference is `(p − q·cubic)/q`. Numerator and denominator in Bezier form of degree `n + 3` have the
    /// coefficients `dₖ = Σ C(n,i) C(3,j) wᵢ (cᵢ − cubicⱼ) / C(n+3,k)` and `vₖ`, the same sum of `wᵢ` (`i + j = k`), so that the
    /// norm is at most the largest `|dₖ|/vₖ`.
    fn distance_bound(&self, cubic: [DVec2; 4]) -> f64 {
        let n = self.points.len() - 1;
        let mut differences = vec![DVec2::ZERO; n + 4];
        let mut weights = vec![0.0; n + 4];
        let mut binomial = 1.0;
        for i in 0..=n {
            for (j, other) in [1.0, 3.0, 3.0, 1.0].into_iter().enumerate() {
                let factor = binomial * other * self.weights[i];
                differences[i + j] += (self.points[i] - cubic[j]) * factor;
                weights[i + j] += factor;
            }
            binomial *= (n - i) as f64 / (i + 1) as f64;
        }
        differences
            .iter()
            .zip(&weights)
            .map(|(difference, weight)| difference.norm() / weight)
            .fold(0.0, f64::max)
    }
}

/// The point of the cubic with these Bezier points at `s` in `[0, 1]`, by de Casteljau's algorithm.
pub fn cubic_point(points: [DVec2; 4], s: f64) -> DVec2 {
    let [a, b, c, d] = points;
    let (ab, bc, cd) = (a.mix(b, s), b.mix(c, s), c.mix(d, s));
    ab.mix(bc, s).mix(bc.mix(cd, s), s)
}

/// Polylines within `tolerance` (world units) of a path, one for each part; a closed part repeats its first point.
///
/// A cubic is cut at equal parameters into `N` parts with `N² ≥ max|c″|/(8·tolerance)`, which bounds the distance of each chord
/// from its arc at equal parameters; `|c″|` is at most 6 times the largest second difference of the control points. No cubic
/// becomes more than 4096 lines. Steps before the first [`Segment::Move`] are dropped.
pub fn flatten(segments: &[Segment], tolerance: f64) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    let mut starts_anew = false;
    for &segment in segments {
        if let Segment::Move(start) = segment {
            parts.push(vec![start]);
            starts_anew = false;
            continue;
        }
        if starts_anew && let Some(&start) = parts.last().and_then(|part| part.first()) {
            parts.push(vec![start]);
            starts_anew = false;
        }
        let Some(part) = parts.last_mut() else { continue };
        let Some(&from) = part.last() else { continue };
        match segment {
            Segment::Move(_) => {}
            Segment::Line(end) => part.push(end),
            Segment::Cubic(b, c, d) => {
                let count = line_count([from, b, c, d], tolerance);
                let inner = (1..count).map(|i| cubic_point([from, b, c, d], i as f64 / count as f64));
                part.extend(inner.chain([d]));
            }
            Segment::Close => {
                let start = part[0];
                if from != start {
                    part.push(start);
                }
                starts_anew = true;
            }
        }
    }
    parts
}

fn line_count([a, b, c, d]: [DVec2; 4], tolerance: f64) -> usize {
    let bend = (a - b * 2.0 + c).norm().max((b - c * 2.0 + d).norm());
    if bend <= 0.0 {
        return 1;
    }
    // Not a number, from a bad tolerance or overflow, goes to the limit.
    let count = (0.75 * bend / tolerance.max(0.0)).sqrt().ceil();
    if count.is_nan() { MAX_LINES as usize } else { count.clamp(1.0, MAX_LINES) as usize }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{Side, SplineSpace};

    fn wavy_points(count: usize) -> Vec<DVec2> {
        (0..count).map(|k| DVec2::new(k as f64 * 0.7, (k as f64 * 2.3).sin() * 1.5)).collect()
    }

    fn wavy_curve(degree: usize, weight: impl Fn(usize) -> f64) -> Nurbs<DVec2> {
        let count = degree + 6;
        let knots = (0..=count + degree).map(|k| k as f64 + 0.3 * (k as f64).cos()).collect();
        let space = SplineSpace::new(degree, knots).unwrap();
        Nurbs::new(space, wavy_points(count), (0..count).map(weight).collect()).unwrap()
    }

    /// A quarter of the unit circle.
    fn quarter_circle() -> Nurbs<DVec2> {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let points = vec![DVec2::X, DVec2::ONE, DVec2::Y];
        Nurbs::new(space, points, vec![1.0, 0.5f64.sqrt(), 1.0]).unwrap()
    }

    /// The largest distance at equal parameters between curve and path of a knot interval cut into equal halves.
    fn largest_distance_of_exact_piece(curve: &Nurbs<DVec2>) -> f64 {
        let mut largest = 0.0f64;
        for span in curve_span_paths(curve, 1.0) {
            let (a, b) = span.interval;
            let [Segment::Move(start), segment] = span.segments[..] else { panic!("one piece {span:?}") };
            let cubic = match segment {
                Segment::Line(end) => [start, start.mix(end, 1.0 / 3.0), start.mix(end, 2.0 / 3.0), end],
                Segment::Cubic(p, q, end) => [start, p, q, end],
                other => panic!("{other:?}"),
            };
            for i in 0..=16 {
                let s = f64::from(i) / 16.0;
                let side = if i == 0 { Side::Right } else { Side::Left };
                let exact = curve.derivatives(a + (b - a) * s, 0, side).unwrap()[0];
                largest = largest.max((cubic_point(cubic, s) - exact).norm());
            }
        }
        largest
    }

    #[test]
    fn polynomial_pieces_up_to_degree_three_are_exact() {
        for degree in 1..=3 {
            let largest = largest_distance_of_exact_piece(&wavy_curve(degree, |_| 1.0));
            assert!(largest < 1e-13, "degree {degree}: {largest:e}");
            let equal_weights = largest_distance_of_exact_piece(&wavy_curve(degree, |_| 2.5));
            assert!(equal_weights < 1e-13, "degree {degree}, all weights 2.5: {equal_weights:e}");
        }
    }

    #[test]
    fn closed_curves_close_and_are_exact() {
        let space = SplineSpace::periodic(3, 5.0, vec![0.0, 0.5, 2.0, 3.0, 4.5]).unwrap();
        let curve = Nurbs::polynomial(space, wavy_points(5)).unwrap();
        let largest = largest_distance_of_exact_piece(&curve);
        assert!(largest < 1e-13, "{largest:e}");
        let path = curve_path(&curve, 1e-3);
        assert_eq!(path.len(), 7, "a move, five cubics, a close: {path:?}");
        let (Some(&Segment::Move(start)), Segment::Cubic(_, _, end)) = (path.first(), path[5]) else {
            panic!("{path:?}")
        };
        assert_eq!(start, end, "closed");
        assert_eq!(path[6], Segment::Close, "closed");
    }

    #[test]
    fn circle_arcs_stay_within_the_tolerance() {
        for power in 1..=9 {
            let tolerance = 0.1f64.powi(power);
            let path = curve_path(&quarter_circle(), tolerance);
            let mut from = DVec2::X;
            for segment in &path[1..] {
                let &Segment::Cubic(b, c, d) = segment else { panic!("{segment:?}") };
                for i in 0..=32 {
                    let radius = cubic_point([from, b, c, d], f64::from(i) / 32.0).norm();
                    let error = (radius - 1.0).abs();
                    assert!(error <= tolerance, "radius {radius} with tolerance {tolerance:e}");
                }
                from = d;
            }
            // Hermite cubics have order 4: a factor of 10 costs less than a factor of 2 in pieces.
            assert!(path.len() < 3 << power, "{} pieces for {tolerance:e}", path.len() - 1);
        }
    }

    #[test]
    fn the_bound_is_not_smaller_than_the_distance_nor_much_larger() {
        for (degree, swing) in [(2, 0.5), (3, 0.9), (5, 0.0), (7, 0.0), (7, 0.5), (12, 0.3)] {
            let curve = wavy_curve(degree, |k| 1.0 + swing * (k as f64).sin());
            let knots = curve.space().evaluation_knots().to_vec();
            for span in degree..curve.space().evaluation_dimension() {
                let (a, b) = (knots[span], knots[span] + (knots[span + 1] - knots[span]) * 0.5);
                let piece = RationalPiece::new(&curve, span, (a, b));
                let cubic = piece.hermite_cubic();
                let bound = piece.distance_bound(cubic);
                let found = (0..=64)
                    .map(|i| f64::from(i) / 64.0)
                    .map(|s| (curve.evaluate(a + (b - a) * s).unwrap() - cubic_point(cubic, s)).norm())
                    .fold(0.0, f64::max);
                assert!(found <= bound + 1e-14, "degree {degree}, span {span}: {found:e} > {bound:e}");
                assert!(
                    bound <= 12.0 * found + 1e-14,
                    "degree {degree}, span {span}: {bound:e} for {found:e}"
                );
            }
        }
    }

    #[test]
    fn high_degree_stays_within_the_tolerance() {
        let curve = wavy_curve(7, |_| 1.0);
        for tolerance in [1e-2, 1e-5, 1e-8] {
            let lines = flatten(&curve_path(&curve, tolerance), tolerance).concat();
            for i in 0..=500 {
                let (left, right) = curve.space().parameter_interval();
                let point = curve.evaluate(left + (right - left) * f64::from(i) / 500.0).unwrap();
                let distance = lines
                    .windows(2)
                    .map(|ends| {
                        let along = ends[1] - ends[0];
                        let s = ((point - ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                        (ends[0] + along * s - point).norm()
                    })
                    .fold(f64::INFINITY, f64::min);
                assert!(distance <= 2.0 * tolerance, "{distance:e} with tolerance {tolerance:e}");
            }
        }
    }

    #[test]
    fn impossible_tolerances_end() {
        for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let path = curve_path(&wavy_curve(7, |k| 1.0 + k as f64), tolerance);
            assert!(path.len() > 6, "{} steps for {tolerance}", path.len());
            let lines = flatten(&path[..3], tolerance);
            assert_eq!(lines.len(), 1, "one part for {tolerance}");
        }
    }

    #[test]
    fn chords_stay_within_the_tolerance() {
        let cubic = [DVec2::ZERO, DVec2::new(1.0, 3.0), DVec2::new(2.0, -3.0), DVec2::new(3.0, 0.5)];
        for tolerance in [0.5, 1e-2, 1e-4] {
            let path = [Segment::Move(cubic[0]), Segment::Cubic(cubic[1], cubic[2], cubic[3])];
            let lines = flatten(&path, tolerance).concat();
            let count = (lines.len() - 1) as f64;
            for i in 0..1000 {
                let s = f64::from(i) / 1000.0;
                let (chord, rest) = ((s * count) as usize, (s * count).fract());
                let distance = (lines[chord].mix(lines[chord + 1], rest) - cubic_point(cubic, s)).norm();
                assert!(distance <= tolerance, "{distance} with tolerance {tolerance}");
            }
        }
    }

    #[test]
    fn parts_are_kept_apart_and_closed() {
        let square = [
            Segment::Line(DVec2::NEG_X),
            Segment::Move(DVec2::ZERO),
            Segment::Line(DVec2::X),
            Segment::Line(DVec2::ONE),
            Segment::Close,
            Segment::Line(DVec2::Y),
            Segment::Move(DVec2::NEG_ONE),
        ];
        let parts = flatten(&square, 0.1);
        assert_eq!(parts[0], vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::ZERO], "a closed triangle");
        assert_eq!(parts[1], vec![DVec2::ZERO, DVec2::Y], "a closed part goes on from its start");
        assert_eq!(parts[2], vec![DVec2::NEG_ONE], "a part of one point");
    }
}
