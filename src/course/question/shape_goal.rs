//! Goals that the curve in the document must meet, and how far it is from them.

use glam::DVec2;
use serde::Deserialize;

use crate::core::bspline::Side;
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{short_number, short_point};
use crate::course::question::joint_goal::{Contact, EndGoal, check_ends, check_joint};
use crate::course::question::knot_goal::{check_multiplicity, check_smooth, times};
use crate::course::question::shape_measure::{check_circle, check_crossings};
use crate::course::question::{Verdict, polygon_size};
use crate::document::{Document, ObjectId};

/// Samples of each polynomial piece for distances.
const SAMPLES_PER_PIECE: usize = 64;
/// Steps of the golden section after sampling; each shortens the interval by 0.618.
const REFINEMENTS: usize = 40;
/// Smallest angle between the one-sided tangents of a corner, in radians.
const CORNER_ANGLE: f64 = 0.05;

/// What the curve must satisfy.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "goal", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Goal {
    /// Pass through a point.
    PassThrough {
        /// The point.
        point: [f64; 2],
        /// The largest distance that counts, as a share of the polygon's size.
        tolerance: f64,
    },
    /// Have a corner at a knot: the multiplicity is the degree and the tangents differ.
    Corner {
        /// The knot.
        at: f64,
    },
    /// Follow another curve of the document.
    Follow {
        /// Number of the other object.
        reference: u64,
        /// The largest distance between the curves that counts, as a share of the other polygon's size.
        tolerance: f64,
    },
    /// Start where another curve ends, and go on smoothly.
    Joint {
        /// Number of the curve before.
        before: u64,
        /// What counts: derivatives, or the shape alone.
        contact: Contact,
        /// Up to which order: 1 for tangents, 2 for curvature or second derivatives.
        order: usize,
        /// The largest share of the size by which lengths, and angle in radians by which directions, may differ.
        tolerance: f64,
    },
    /// Have given points, directions and curvatures at both ends.
    Ends {
        /// At the start.
        start: EndGoal,
        /// At the end.
        end: EndGoal,
        /// The largest share by which lengths and curvatures, and angle in radians by which directions, may differ.
        tolerance: f64,
    },
    /// Have a knot exactly so many times.
    Multiplicity {
        /// The knot.
        at: f64,
        /// How often.
        times: usize,
    },
    /// Have so many continuous derivatives at all inner knots, whatever the control points are.
    Smooth {
        /// How many.
        order: usize,
    },
    /// Cross a line so often, polygon and curve.
    Crossings {
        /// Number of the object whose first and last control point the line joins.
        line: u64,
        /// Crossings of the control polygon.
        polygon: usize,
        /// Crossings of the curve.
        curve: usize,
    },
    /// Be an arc of a circle.
    CircleArc {
        /// The largest distance from the circle, as a share of its radius.
        tolerance: f64,
    },
}

/// Judges `curve` of `document`.
pub(super) fn check(document: &Document, curve: &Nurbs<DVec2>, goal: &Goal, feedback: &str) -> Verdict {
    match *goal {
        Goal::PassThrough { point, tolerance } => {
            let size = polygon_size(curve).max(f64::MIN_POSITIVE);
            let target = DVec2::from_array(point);
            let measured = distance(curve, target) / size;
            if measured <= tolerance {
                return Verdict::right(measured, feedback);
            }
            let message = format!(
                "The curve passes {} by {} % of the polygon's size; {} % are allowed.",
                short_point(&point),
                short_number(100.0 * measured),
                short_number(100.0 * tolerance)
            );
            Verdict::wrong(Some(measured), message)
        }
        Goal::Corner { at } => check_corner(curve, at, feedback),
        Goal::Joint { before, contact, order, tolerance } => {
            check_joint(document, curve, before, (contact, order), tolerance, feedback)
        }
        Goal::Ends { ref start, ref end, tolerance } => check_ends(curve, [start, end], tolerance, feedback),
        Goal::Multiplicity { at, times } => check_multiplicity(curve, at, times, feedback),
        Goal::Smooth { order } => check_smooth(curve, order, feedback),
        Goal::Crossings { line, polygon, curve: of_curve } => {
            check_crossings(document, curve, line, [polygon, of_curve], feedback)
        }
        Goal::CircleArc { tolerance } => check_circle(curve, tolerance, feedback),
        Goal::Follow { reference, tolerance } => {
            let Some(other) = document.curve(ObjectId(reference)) else {
                return Verdict::wrong(None, "The curve to follow is gone. Go back to the example.");
            };
            let size = polygon_size(other).max(f64::MIN_POSITIVE);
            let (gap, place) = largest_gap(curve, other);
            let measured = gap / size;
            if measured <= tolerance {
                return Verdict::right(measured, feedback);
            }
            let message = format!(
                "The curves are farthest apart near {}: {} % of the size, {} % are allowed.",
                short_point(&place.to_array()),
                short_number(100.0 * measured),
                short_number(100.0 * tolerance)
            );
            Verdict::wrong(Some(measured), message)
        }
    }
}

/// Judges a corner; measured is the angle between the one-sided tangents in radians.
fn check_corner(curve: &Nurbs<DVec2>, at: f64, feedback: &str) -> Verdict {
    let (n, mu) = (curve.degree(), curve.space().multiplicity(at));
    let (left_end, right_end) = curve.space().parameter_interval();
    let at_an_end = at <= left_end || at >= right_end;
    if at_an_end && !curve.space().is_periodic() {
        return Verdict::wrong(None, "An end of an open curve is no corner.");
    }
    let tangent = |side| curve.derivatives(at, 1, side).map(|values| values[1]);
    let (Ok(before), Ok(after)) = (tangent(Side::Left), tangent(Side::Right)) else {
        return Verdict::wrong(None, "The curve does not reach this parameter.");
    };
    if mu < n {
        let message = format!(
            "The knot {} is there {}; the tangent can jump only where it is there {}, as the degree says.",
            short_number(at),
            times(mu),
            times(n)
        );
        return Verdict::wrong(Some(0.0), message);
    }
    let angle = before.angle_to(after).abs();
    if !angle.is_finite() {
        return Verdict::wrong(None, "A tangent vanishes there; move a neighbouring control point away.");
    }
    if angle < CORNER_ANGLE {
        return Verdict::wrong(
            Some(angle),
            "The knot is right, but both tangents point the same way. Move a neighbouring control point.",
        );
    }
    Verdict::right(angle, feedback)
}

/// Distance of `target` from `curve`: the best sample of every piece, refined by the golden section.
fn distance(curve: &Nurbs<DVec2>, target: DVec2) -> f64 {
    let away = |t: f64| curve.evaluate(t).map_or(f64::INFINITY, |point| point.distance(target));
    let mut best = f64::INFINITY;
    for piece in curve.space().breaks().windows(2) {
        let step = (piece[1] - piece[0]) / SAMPLES_PER_PIECE as f64;
        let at = |i: usize| if i == SAMPLES_PER_PIECE { piece[1] } else { piece[0] + i as f64 * step };
        let nearest =
            (0..=SAMPLES_PER_PIECE).min_by(|&i, &j| away(at(i)).total_cmp(&away(at(j)))).unwrap_or(0);
        let bracket = (at(nearest.saturating_sub(1)), at((nearest + 1).min(SAMPLES_PER_PIECE)));
        best = best.min(away(at(nearest))).min(golden_section(&away, bracket));
    }
    best
}

fn golden_section(function: &dyn Fn(f64) -> f64, (mut low, mut high): (f64, f64)) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let mut best = f64::INFINITY;
    for _ in 0..REFINEMENTS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (at_left, at_right) = (function(left), function(right));
        best = best.min(at_left).min(at_right);
        if at_left < at_right {
            high = right;
        } else {
            low = left;
        }
    }
    best
}

/// The largest distance of a sample of either curve from the other curve, and where it is.
fn largest_gap(first: &Nurbs<DVec2>, second: &Nurbs<DVec2>) -> (f64, DVec2) {
    let mut worst = (0.0, DVec2::ZERO);
    let (first_samples, second_samples) = (samples(first), samples(second));
    for (points, line) in [(&first_samples, &second_samples), (&second_samples, &first_samples)] {
        for &point in points {
            let gap = line
                .windows(2)
                .map(|pair| distance_to_segment(point, pair[0], pair[1]))
                .fold(f64::INFINITY, f64::min);
            if gap > worst.0 {
                worst = (gap, point);
            }
        }
    }
    worst
}

fn samples(curve: &Nurbs<DVec2>) -> Vec<DVec2> {
    let breaks = curve.space().breaks();
    let mut points = Vec::with_capacity(breaks.len() * SAMPLES_PER_PIECE);
    for piece in breaks.windows(2) {
        let step = (piece[1] - piece[0]) / SAMPLES_PER_PIECE as f64;
        points.extend((0..SAMPLES_PER_PIECE).filter_map(|i| curve.evaluate(piece[0] + i as f64 * step).ok()));
    }
    points.extend(breaks.last().and_then(|&end| curve.evaluate(end).ok()));
    points
}

fn distance_to_segment(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let leg = to - from;
    let length_squared = leg.length_squared();
    let along =
        if length_squared > 0.0 { ((point - from).dot(leg) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(from + leg * along)
}
