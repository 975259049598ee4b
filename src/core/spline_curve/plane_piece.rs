//! A Bezier piece of a plane curve, prepared for intersections, and the one crossing of two pieces whose directions are apart.
//!
//! If no tangent of `p` is parallel to one of `q`, the pieces cross at most once: `(s, u) ↦ p(s) − q(u)` is one to one. The images of the sides of the square `[0, 1]²` are
//! arcs between the corners of the parallelogram of both chords, and the pieces cross if they run around 0. An arc whose hull does not hold 0 may be replaced by
//! its chord; another one, a graph over its chord, by two segments through the point where it passes 0. Newton's method from the crossing of the chords finds
//! the place. Course: section 2.6; beyond, section B.6.

use std::f64::consts::PI;

use glam::DVec2;

use crate::core::bounding_tree::BoundingBox;
use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::point::Point as _;
use crate::core::rational_bezier::RationalBezier;
use crate::core::root_finding::{single_sign_change, single_zero};
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::curve_intersection::as_spline_error;
use crate::core::spline_curve::local_piece::LocalPiece;

/// Steps of Newton's method; it converges quadratically or not at all.
const STEPS: usize = 12;
/// After a step shorter than this the next one would be below rounding.
const CONVERGED: f64 = 1e-10;
/// How far Newton's method may leave `[0, 1]` to be taken back to the end.
const OUTSIDE: f64 = 1e-9;

/// Directions closer than this angle may be parallel up to rounding.
const APART: f64 = 1e-7;
/// Where pieces are divided: not in the middle, where symmetric curves like to touch.
const DIVISION: f64 = 0.46875;
/// Divisions of one piece after which it is taken as it is: at a cusp.
const MAX_DEPTH: usize = 40;

/// A piece with what its control points say.
#[derive(Clone, Debug)]
pub(super) struct PlanePiece {
    pub(super) curve: RationalBezier<DVec2>,
    pub(super) local: LocalPiece<DVec2>,
    pub(super) bounds: BoundingBox<2>,
    /// Middle, between 0 and π, and half opening of the cone of directions, one and its opposite being the same.
    cone: Option<(f64, f64)>,
    /// Half the chord, seen from the origin of the piece.
    half: DVec2,
    /// The unit normal of the chord and the range of the control points along it; no normal if the piece ends where it begins.
    strip: Option<(DVec2, [f64; 2])>,
}

impl PlanePiece {
    pub(super) fn new(curve: RationalBezier<DVec2>) -> Result<Self, SplineError> {
        let points = curve.points();
        let weights = if curve.has_equal_weights() { Vec::new() } else { curve.weights().to_vec() };
        let local = LocalPiece::new(curve.interval(), points, weights);
        let overflow = SplineError::NonFinite { what: "extent of piece", index: 0, value: local.extent };
        let bounds = BoundingBox::of_points(points.iter().map(DVec2::to_array)).map_err(|_| overflow)?;
        let half = 0.5 * (points[points.len() - 1] - points[0]);
        let strip = half.perp().try_normalize().map(|normal| (normal, range(points, normal, local.origin)));
        let cone = curve.tangent_cone().map(|(middle, opening)| (middle.rem_euclid(PI), opening));
        Ok(Self { cone, local, bounds, half, strip, curve })
    }

    /// Both parts of a division near the middle.
    pub(super) fn halves(&self) -> Result<[Self; 2], SplineError> {
        let (left, right) = self.curve.split(self.parameter(DIVISION)).map_err(as_spline_error)?;
        Ok([Self::new(left)?, Self::new(right)?])
    }

    /// The longer side of the box.
    pub(super) fn size(&self) -> f64 {
        (DVec2::from(self.bounds.high()) - DVec2::from(self.bounds.low())).max_element()
    }

    /// Whether `other` is more than `gap` away beside our strip.
    pub(super) fn is_beside(&self, other: &Self, gap: f64) -> bool {
        self.strip.is_some_and(|(normal, [low, high])| {
            let [from, to] = range(other.curve.points(), normal, self.local.origin);
            from - high > gap || low - to > gap
        })
    }

    /// Whether no tangent of `self` is parallel to one of `other`.
    pub(super) fn directions_differ(&self, other: &Self) -> bool {
        let (Some((a, p)), Some((b, q))) = (self.cone, other.cone) else { return false };
        let turn = (a - b).abs();
        turn.min(PI - turn) > p + q + APART
    }

    /// Whether our control points may have the place `x` among their convex combinations, up to `gap`.
    fn may_hold(&self, x: DVec2, gap: f64) -> bool {
        let in_strip = self.strip.is_none_or(|(normal, [low, high])| {
            let height = normal.dot(x - self.local.origin);
            low - gap <= height && height <= high + gap
        });
        in_strip && self.bounds.distance_squared(&x.to_array()) <= gap * gap
    }

    /// Whether pieces whose directions differ cross; `None` if an end of one is within `gap` of the other.
    pub(super) fn crosses(&self, other: &Self, gap: f64) -> Option<bool> {
        let ends = |piece: &Self| [-1.0, 1.0].map(|sign| piece.local.origin + sign * piece.half);
        let ([p0, p1], [q0, q1]) = (ends(self), ends(other));
        let mut path = Path::default();
        // Around the image of the square, with the point where an arc passes 0 if 0 is in its hull.
        path.go(p0 - q0);
        path.go_by(self.way_around(q0, gap)?);
        path.go(p1 - q0);
        path.go_by(other.way_around(p1, gap)?.map(|via| -via));
        path.go(p1 - q1);
        path.go_by(self.way_around(q1, gap)?);
        path.go(p0 - q1);
        path.go_by(other.way_around(p0, gap)?.map(|via| -via));
        path.go(p0 - q0);
        Some(path.turns != 0)
    }

    /// The point, seen from `x`, where the piece is at the height of `x` along its chord, if `x` may be in its hull; the outer `None` if that point is within `gap` of `x`.
    ///
    /// With directions less than 90 degrees from the chord the piece is there once: it is a graph over its chord.
    fn way_around(&self, x: DVec2, gap: f64) -> Option<Option<DVec2>> {
        // Along the normal of the chord a place within the gap is a little further away.
        let reach = 4.0 * gap;
        if !self.may_hold(x, reach) {
            return Some(None);
        }
        let mut buffer = [0.0; MAX_DEGREE + 1];
        let values = &mut buffer[..=self.local.degree()];
        let away = self.local.origin - x;
        for (j, value) in values.iter_mut().enumerate() {
            let weight = self.local.weights.get(j).copied().unwrap_or(1.0);
            *value = self.half.dot(self.local.numerators[j] + away * weight);
        }
        let slack = reach * self.half.length() * self.local.largest_weight();
        if values[0].abs().min(values[values.len() - 1].abs()) <= slack {
            return None;
        }
        // Not between the ends along the chord: the whole piece is on one side of x.
        let Some(k) = single_sign_change(values, 0.0) else { return Some(None) };
        let via = away + self.local.offset_at(single_zero(values, k));
        (via.length() > reach).then_some(Some(via))
    }

    /// The crossing of two pieces whose directions differ, as parameters in `[0, 1]` and a point, if Newton's method finds it within `tolerance`.
    pub(super) fn crossing(&self, other: &Self, tolerance: f64) -> Option<([f64; 2], DVec2)> {
        let apart = other.local.origin - self.local.origin;
        let across = self.half.perp_dot(other.half);
        let start = [apart.perp_dot(other.half), apart.perp_dot(self.half)].map(|side| side / across);
        let [mut s, mut u] = start.map(|sigma| 0.5 + 0.5 * sigma.clamp(-1.0, 1.0));
        for _ in 0..STEPS {
            let (p, velocity) = self.local.offset_and_velocity(s);
            let (q, direction) = other.local.offset_and_velocity(u);
            let gap = p - q - apart;
            let determinant = velocity.perp_dot(direction);
            let step = [gap.perp_dot(direction), gap.perp_dot(velocity)].map(|side| side / determinant);
            if !(step[0].is_finite() && step[1].is_finite()) {
                return None;
            }
            let inside = |x: f64| x.clamp(-OUTSIDE, 1.0 + OUTSIDE);
            let next = [inside(s - step[0]), inside(u - step[1])];
            let moved = (next[0] - s).abs().max((next[1] - u).abs());
            [s, u] = next;
            if moved <= CONVERGED {
                break;
            }
        }
        let [s, u] = [s, u].map(|x| x.clamp(0.0, 1.0));
        let point = self.local.offset_at(s);
        let gap = point - other.local.offset_at(u) - apart;
        (gap.length() <= tolerance).then_some(([s, u], point + self.local.origin))
    }

    /// The parameter of the curve at `at` in `[0, 1]`.
    pub(super) fn parameter(&self, at: f64) -> f64 {
        let (a, b) = self.local.interval;
        a.mix(b, at)
    }
}

/// How often a closed polygon runs around the origin.
#[derive(Default)]
struct Path {
    last: Option<DVec2>,
    turns: i32,
}

impl Path {
    /// On to the next corner.
    fn go(&mut self, b: DVec2) {
        if let Some(a) = self.last.replace(b) {
            let side = a.perp_dot(b);
            // Crossings of the positive x-axis.
            self.turns += i32::from(a.y <= 0.0 && 0.0 < b.y && side > 0.0);
            self.turns -= i32::from(b.y <= 0.0 && 0.0 < a.y && side < 0.0);
        }
    }

    fn go_by(&mut self, via: Option<DVec2>) {
        if let Some(via) = via {
            self.go(via);
        }
    }
}

/// The Bezier pieces of a curve, divided until their tangents lie within `opening` radians of a middle direction; parts no longer than `smallest` are left as they are.
pub(super) fn gentle_parts(
    curve: &Nurbs<DVec2>,
    opening: f64,
    smallest: f64,
) -> Result<Vec<PlanePiece>, SplineError> {
    let mut parts = Vec::new();
    for piece in curve.rational_bezier_curves().map_err(as_spline_error)? {
        let mut stack = vec![(piece, 0)];
        while let Some((piece, depth)) = stack.pop() {
            let (a, b) = piece.interval();
            let middle = a.mix(b, DIVISION);
            let is_gentle = piece.tangent_cone().is_some_and(|cone| cone.1 <= opening);
            let is_small = depth >= MAX_DEPTH || piece.without_weights().extent() <= smallest;
            if is_gentle || is_small || !(a < middle && middle < b) {
                parts.push(PlanePiece::new(piece)?);
                continue;
            }
            let (left, right) = piece.split(middle).map_err(as_spline_error)?;
            stack.push((right, depth + 1));
            stack.push((left, depth + 1));
        }
    }
    Ok(parts)
}

/// The range of `normal·(x − origin)`.
fn range(points: &[DVec2], normal: DVec2, origin: DVec2) -> [f64; 2] {
    let heights = points.iter().map(|point| normal.dot(*point - origin));
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::spline_curve::samples::any_curve;

    fn pieces(curve: &Nurbs<DVec2>, by: DVec2) -> Vec<PlanePiece> {
        let moved = |curve: RationalBezier<DVec2>| curve.transformed(|c| c + by).unwrap();
        curve
            .rational_bezier_curves()
            .unwrap()
            .into_iter()
            .map(|c| PlanePiece::new(moved(c)).unwrap())
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_planted_crossing_is_found_and_never_denied(
            one in any_curve(1..=5), other in any_curve(1..=5), shares in prop::array::uniform2(0.0..=1.0_f64), by in prop::array::uniform2(-5.0..5.0_f64),
        ) {
            for p in pieces(&one, DVec2::ZERO) {
                for q in pieces(&other, DVec2::ZERO) {
                    let planted = p.curve.evaluate(p.parameter(shares[0])).unwrap() - q.curve.evaluate(q.parameter(shares[1])).unwrap();
                    let q = PlanePiece::new(q.curve.transformed(|c| c + planted).unwrap()).unwrap();
                    prop_assert!(!p.is_beside(&q, 1e-12) && !q.is_beside(&p, 1e-12), "{p:?} {q:?}");
                    if p.directions_differ(&q) {
                        prop_assert!(p.crosses(&q, 1e-12) != Some(false), "{p:?} {q:?}");
                        if let Some((at, point)) = p.crossing(&q, 1e-9) {
                            let expected = p.curve.evaluate(p.parameter(shares[0])).unwrap();
                            prop_assert!(point.distance(expected) < 1e-7, "{at:?} for {shares:?}");
                        }
                    }
                }
                for q in pieces(&other, DVec2::from(by)).iter().filter(|q| p.directions_differ(q)) {
                    let slow = p.curve.intersections(&q.curve, 1e-10).unwrap();
                    match p.crosses(q, 1e-12) {
                        Some(true) => prop_assert_eq!(slow.len(), 1, "{:?} {:?}", p, q),
                        Some(false) => prop_assert!(slow.is_empty() && p.crossing(q, 1e-10).is_none(), "{p:?} {q:?} {slow:?}"),
                        None => {}
                    }
                }
            }
        }
    }
}
