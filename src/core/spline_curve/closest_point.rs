//! The point of a curve closest to a given point.
//!
//! Branch and bound on the Bezier pieces: a piece with positive weights lies in the box of its projected control points, so the
//! distance to that box bounds the distance to the piece from below. The nearest box is halved until it is flat and small, and
//! Newton's method on `(r(t) − q)·r′(t) = 0`, kept inside the piece, finishes. Course: beyond, section B.5.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::core::bspline::SplineError;
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// Pieces are not halved below this share of the parameter interval; Newton's method does the rest.
const SMALLEST_PIECE: f64 = 1e-6;

/// Halvings after which the best point found so far is taken: reached only by curves that follow a circle around the point.
const MAX_HALVINGS: usize = 20_000;

/// The place of a curve that is closest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint<P> {
    /// Its parameter.
    pub parameter: f64,
    /// The point of the curve.
    pub point: P,
    /// Its distance from the given point.
    pub distance: f64,
}

/// A piece that waits, the one with the smallest lower bound first.
struct Waiting<H> {
    bound: f64,
    interval: (f64, f64),
    points: Vec<H>,
}

impl<H> PartialEq for Waiting<H> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<H> Eq for Waiting<H> {}

impl<H> PartialOrd for Waiting<H> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<H> Ord for Waiting<H> {
    fn cmp(&self, other: &Self) -> Ordering {
        // A binary heap gives the largest first.
        other.bound.total_cmp(&self.bound)
    }
}

impl<P: Projective> Nurbs<P> {
    /// The point of the curve closest to `place`; of several the one that is found first.
    ///
    /// The distance is exact up to rounding for a curve whose distance from `place` varies.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `place` is not finite.
    pub fn closest_point(&self, place: P) -> Result<ClosestPoint<P>, SplineError> {
        if !place.is_finite() {
            let value = (0..P::DIMENSION).map(|i| place.coordinate(i)).find(|value| !value.is_finite());
            return Err(SplineError::NonFinite { what: "place", index: 0, value: value.unwrap_or(f64::NAN) });
        }
        let (left, right) = self.space().parameter_interval();
        let at = |parameter: f64| -> Result<ClosestPoint<P>, SplineError> {
            let point = self.evaluate(parameter)?;
            Ok(ClosestPoint { parameter, point, distance: (point - place).norm() })
        };
        let mut best = at(left)?;
        let mut waiting: BinaryHeap<Waiting<P::Homogeneous>> = BinaryHeap::new();
        for segment in self.homogeneous().bezier_form() {
            best = nearer(best, at(segment.interval.1)?);
            let bound = box_distance::<P>(&segment.points, place);
            waiting.push(Waiting { bound, interval: segment.interval, points: segment.points });
        }
        let mut halvings = 0;
        while let Some(piece) = waiting.pop() {
            if piece.bound >= best.distance || halvings >= MAX_HALVINGS {
                break;
            }
            halvings += 1;
            let (a, b) = piece.interval;
            let middle = a + 0.5 * (b - a);
            best = nearer(best, at(middle)?);
            if b - a <= SMALLEST_PIECE * (right - left) || middle <= a || middle >= b {
                best = nearer(best, at(self.newton(place, middle, a, b)?)?);
                continue;
            }
            // A first step of Newton's method from a piece that is already small finds good bounds early.
            if b - a <= 0.02 * (right - left) {
                best = nearer(best, at(self.newton(place, middle, a, b)?)?);
            }
            let (first, second) = halve(piece.points);
            for (interval, points) in [((a, middle), first), ((middle, b), second)] {
                let bound = box_distance::<P>(&points, place);
                if bound < best.distance {
                    waiting.push(Waiting { bound, interval, points });
                }
            }
        }
        let polished = self.newton(place, best.parameter, left, right)?;
        Ok(nearer(best, at(polished)?))
    }

    /// A few Newton steps on `(r − q)·r′ = 0` from `start`, kept in `[low, high]`.
    fn newton(&self, place: P, start: f64, low: f64, high: f64) -> Result<f64, SplineError> {
        let mut parameter = start;
        for _ in 0..8 {
            let values = self.derivatives(parameter, 2, crate::core::bspline::Side::Right)?;
            let away = values[0] - place;
            let slope = dot(values[1], values[1]) + dot(away, values[2]);
            let step = dot(away, values[1]) / slope;
            if !step.is_finite() || slope <= 0.0 {
                break;
            }
            let next = (parameter - step).clamp(low, high);
            if (next - parameter).abs() <= 1e-16 * (high - low) {
                break;
            }
            parameter = next;
        }
        Ok(parameter)
    }
}

fn dot<P: Point>(a: P, b: P) -> f64 {
    (0..P::DIMENSION).map(|i| a.coordinate(i) * b.coordinate(i)).sum()
}

fn nearer<P>(a: ClosestPoint<P>, b: ClosestPoint<P>) -> ClosestPoint<P> {
    if b.distance < a.distance { b } else { a }
}

/// Distance of `place` from the box of the projected control points.
fn box_distance<P: Projective>(points: &[P::Homogeneous], place: P) -> f64 {
    let mut squared = 0.0;
    for axis in 0..P::DIMENSION {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &point in points {
            let value = point.coordinate(axis) / point.coordinate(P::DIMENSION);
            low = low.min(value);
            high = high.max(value);
        }
        let outside = (low - place.coordinate(axis)).max(place.coordinate(axis) - high).max(0.0);
        squared += outside * outside;
    }
    squared.sqrt()
}

/// De Casteljau at 1/2: the control points of both halves.
fn halve<H: Point>(mut points: Vec<H>) -> (Vec<H>, Vec<H>) {
    let n = points.len() - 1;
    let mut first = Vec::with_capacity(n + 1);
    first.push(points[0]);
    for step in 0..n {
        for j in 0..n - step {
            points[j] = (points[j] + points[j + 1]) * 0.5;
        }
        first.push(points[0]);
    }
    (first, points)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::core::bspline::SplineSpace;

    fn circle() -> Nurbs<DVec2> {
        let knots = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0];
        let space = SplineSpace::periodic(2, 4.0, knots).unwrap();
        let points = [
            (1.0, 1.0),
            (0.0, 1.0),
            (-1.0, 1.0),
            (-1.0, 0.0),
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, -1.0),
            (1.0, 0.0),
        ];
        let weights = (0..8).map(|k| if k % 2 == 0 { 0.5_f64.sqrt() } else { 1.0 }).collect();
        Nurbs::new(space, points.map(|(x, y)| DVec2::new(x, y)).to_vec(), weights).unwrap()
    }

    #[test]
    fn closest_point_of_a_circle_lies_on_the_ray_from_the_centre() {
        let circle = circle();
        for step in 0..37 {
            let (sin, cos) = (0.17 * f64::from(step)).sin_cos();
            for radius in [0.3, 0.99, 1.0, 2.5, 1000.0] {
                let nearest = circle.closest_point(DVec2::new(cos, sin) * radius).unwrap();
                let error = nearest.point.distance(DVec2::new(cos, sin));
                assert!(error < 1e-7 * radius.max(1.0).sqrt(), "step {step}, radius {radius}: {error}");
                assert!(
                    (nearest.distance - (radius - 1.0).abs()).abs() < 1e-12 * radius.max(1.0),
                    "distance"
                );
            }
        }
    }

    #[test]
    fn every_point_is_at_the_same_distance_from_the_centre() {
        let nearest = circle().closest_point(DVec2::ZERO).unwrap();
        assert!((nearest.distance - 1.0).abs() < 1e-12, "{nearest:?}");
    }

    #[test]
    fn no_sample_is_closer_than_the_closest_point() {
        let space = SplineSpace::new(4, (0..14).map(f64::from).collect()).unwrap();
        let points = [
            (0.0, 0.0),
            (4.0, 9.0),
            (-3.0, 5.0),
            (6.0, -2.0),
            (2.0, 2.0),
            (9.0, 9.0),
            (1.0, 0.0),
            (0.0, 7.0),
            (5.0, 5.0),
        ];
        let curve = Nurbs::polynomial(space, points.map(|(x, y)| DVec2::new(x, y)).to_vec()).unwrap();
        for place in [(0.0, 0.0), (3.0, 3.0), (20.0, -7.0), (2.2, 4.1)].map(|(x, y)| DVec2::new(x, y)) {
            let nearest = curve.closest_point(place).unwrap();
            for step in 0..=4000 {
                let t = 4.0 + 5.0 * f64::from(step) / 4000.0;
                let sampled = curve.evaluate(t).unwrap().distance(place);
                assert!(sampled >= nearest.distance - 1e-12, "{place}: {sampled} at {t} beats {nearest:?}");
            }
        }
    }
}
