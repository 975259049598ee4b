//! Where a curve meets a hyperplane: bisection of its Bezier pieces, guided by the variation of their polygons.
//!
//! Of a piece, the distances of the control points from `H`, times the weights, are the Bernstein coefficients of a polynomial. Without
//! a change of sign it has no zero inside; with one change exactly one, which Newton's method finds inside a shrinking bracket; with
//! more the piece is halved until its box is no larger than the tolerance, and is then reported as undecided: the curve may touch `H`.
//! Ends of pieces on `H` are reported in their own right. Course: section 6.3.

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::hull::coordinate_ranges;
use crate::core::spline_curve::hyperplane::{Hyperplane, sign_changes};

/// Halvings of one piece after which it counts as undecided however large it is.
const MAX_DEPTH: usize = 52;

/// What is known about a meeting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum IntersectionKind {
    /// The curve passes from one side to the other, exactly once in the interval.
    Crossing,
    /// A point on the hyperplane where two pieces join or the curve ends: a crossing, a contact or an end.
    EndPoint,
    /// At least two changes of side of the control points remain: two crossings, a contact, or nothing.
    Undecided,
    /// The whole interval lies on the hyperplane.
    Contained,
}

/// A place where a curve meets a hyperplane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HyperplaneIntersection<P> {
    /// The parameter; the middle of the interval of what is undecided or contained.
    pub parameter: f64,
    /// The point of the curve.
    pub point: P,
    /// What is known.
    pub kind: IntersectionKind,
    /// The interval the statement is about; both ends are the parameter of an end point.
    pub interval: (f64, f64),
}

/// A piece with its homogeneous control points and their weighted distances from the hyperplane.
struct Piece<H> {
    interval: (f64, f64),
    points: Vec<H>,
    distances: Vec<f64>,
    depth: usize,
}

impl<P: Projective> Nurbs<P> {
    /// All places where the curve meets `hyperplane`, by parameter; a closed curve over one period.
    ///
    /// Pieces with an undecided number of crossings are halved until all sides of their box are at most `tolerance`.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`.
    pub fn intersect_hyperplane(
        &self,
        hyperplane: &Hyperplane<P>,
        tolerance: f64,
    ) -> Result<Vec<HyperplaneIntersection<P>>, SplineError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        let mut found: Vec<(f64, IntersectionKind, (f64, f64))> = Vec::new();
        // The last piece first, so that the stack is worked off from left to right.
        let mut stack: Vec<Piece<P::Homogeneous>> = self.pieces(hyperplane);
        let mut last_end = f64::NEG_INFINITY;
        while let Some(piece) = stack.pop() {
            let (a, b) = piece.interval;
            let n = piece.distances.len() - 1;
            if piece.distances.iter().all(|&distance| distance == 0.0) {
                found.push((a.mix(b, 0.5), IntersectionKind::Contained, piece.interval));
                last_end = b;
                continue;
            }
            if piece.distances[0] == 0.0 && a > last_end {
                found.push((a, IntersectionKind::EndPoint, (a, a)));
                last_end = a;
            }
            match sign_changes(piece.distances.iter().copied()) {
                0 => {}
                1 => {
                    let share = single_zero(&piece.distances);
                    let at = a.mix(b, share);
                    // Rounding can move a zero beside an end onto it, where it is reported already.
                    if at > last_end && (share < 1.0 || piece.distances[n] != 0.0) {
                        found.push((at, IntersectionKind::Crossing, piece.interval));
                    }
                }
                _ => {
                    let middle = a.mix(b, 0.5);
                    let small = piece.extent::<P>() <= tolerance || piece.depth >= MAX_DEPTH;
                    if small || middle <= a || middle >= b {
                        found.push((middle, IntersectionKind::Undecided, piece.interval));
                    } else {
                        let (first, second) = piece.halves(middle);
                        stack.push(second);
                        stack.push(first);
                        continue;
                    }
                }
            }
            if piece.distances[n] == 0.0 && b > last_end {
                found.push((b, IntersectionKind::EndPoint, (b, b)));
                last_end = b;
            }
        }
        let mut meetings: Vec<HyperplaneIntersection<P>> = Vec::with_capacity(found.len());
        for (parameter, kind, interval) in found {
            let joins = |last: &HyperplaneIntersection<P>| {
                last.kind == kind && last.interval.1 >= interval.0 && kind != IntersectionKind::Crossing
            };
            match meetings.last_mut().filter(|last| joins(last)) {
                // Neighbours of one contact, or of one stretch on the hyperplane.
                Some(last) => {
                    last.interval.1 = interval.1;
                    last.parameter = last.interval.0.mix(last.interval.1, 0.5);
                    last.point = self.evaluate(last.parameter)?;
                }
                None => {
                    let point = self.evaluate(parameter)?;
                    meetings.push(HyperplaneIntersection { parameter, point, kind, interval });
                }
            }
        }
        Ok(meetings)
    }

    /// The Bezier pieces, the last one first. Distances below rounding are 0.
    fn pieces(&self, hyperplane: &Hyperplane<P>) -> Vec<Piece<P::Homogeneous>> {
        let largest = self.points().iter().fold(0.0, |largest: f64, &point| {
            let products =
                (0..P::DIMENSION).map(|i| (hyperplane.normal().coordinate(i) * point.coordinate(i)).abs());
            largest.max(products.sum())
        });
        let rounding =
            4.0 * (self.degree() + 2) as f64 * f64::EPSILON * (largest + hyperplane.offset().abs());
        let form = self.homogeneous().bezier_pieces();
        let mut pieces: Vec<_> = form
            .iter()
            .map(|(interval, points)| {
                let distance = |&point: &P::Homogeneous| {
                    let weight = point.coordinate(P::DIMENSION);
                    let distance = hyperplane.dot(P::numerator(point)) - hyperplane.offset() * weight;
                    if distance.abs() <= rounding * weight { 0.0 } else { distance }
                };
                let distances = points.iter().map(distance).collect();
                Piece { interval, points: points.to_vec(), distances, depth: 0 }
            })
            .collect();
        pieces.reverse();
        pieces
    }
}

impl<H: crate::core::point::Point> Piece<H> {
    /// Longest side of the box of the projected control points.
    fn extent<P: Projective<Homogeneous = H>>(&self) -> f64 {
        let points: Vec<P> = self.points.iter().map(|&point| P::project(point).0).collect();
        coordinate_ranges(&points).into_iter().fold(0.0, |extent, (low, high)| extent.max(high - low))
    }

    fn halves(self, middle: f64) -> (Self, Self) {
        let (a, b) = self.interval;
        let depth = self.depth + 1;
        let (left, right) = halve(self.points);
        let (before, behind) = halve(self.distances);
        (
            Self { interval: (a, middle), points: left, distances: before, depth },
            Self { interval: (middle, b), points: right, distances: behind, depth },
        )
    }
}

/// De Casteljau at 1/2: the coefficients of both halves.
fn halve<Q: crate::core::point::Point>(mut right: Vec<Q>) -> (Vec<Q>, Vec<Q>) {
    let mut left = vec![right[0]];
    for count in (1..right.len()).rev() {
        for j in 0..count {
            right[j] = right[j].mix(right[j + 1], 0.5);
        }
        left.push(right[0]);
    }
    (left, right)
}

/// The zero in (0, 1) of a polynomial with one change of sign of its Bernstein coefficients.
fn single_zero(coefficients: &[f64]) -> f64 {
    let rising = coefficients.iter().find(|&&c| c != 0.0).is_some_and(|&c| c < 0.0);
    let (mut low, mut high) = (0.0, 1.0);
    let mut t = 0.5;
    let mut scratch = coefficients.to_vec();
    for _ in 0..200 {
        // De Casteljau, with the slope from the last but one level.
        scratch.copy_from_slice(coefficients);
        let mut slope = 0.0;
        for count in (1..scratch.len()).rev() {
            slope = scratch[1] - scratch[0];
            for j in 0..count {
                scratch[j] = scratch[j].mix(scratch[j + 1], t);
            }
        }
        let value = scratch[0];
        if value == 0.0 {
            return t;
        }
        if (value < 0.0) == rising {
            low = t;
        } else {
            high = t;
        }
        let newton = t - value / (slope * (coefficients.len() - 1) as f64);
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= f64::EPSILON * t || next <= low && high - low <= f64::EPSILON {
            return next;
        }
        t = next;
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_curve;
    use crate::core::spline_curve::variation;
    use glam::DVec2;
    use proptest::prelude::*;

    fn crossings(meetings: &[HyperplaneIntersection<DVec2>]) -> Vec<f64> {
        meetings.iter().filter(|m| m.kind == IntersectionKind::Crossing).map(|m| m.parameter).collect()
    }

    proptest! {
        #[test]
        fn every_change_of_side_is_found_and_none_is_invented(curve in any_curve(1..=8), angle in 0.0..6.3_f64, offset in -6.0..6.0_f64) {
            let line = Hyperplane::new(DVec2::from_angle(angle), offset).unwrap();
            let meetings = curve.intersect_hyperplane(&line, 1e-6).unwrap();
            for meeting in &meetings {
                let distance = line.side(meeting.point).abs();
                let limit = if meeting.kind == IntersectionKind::Undecided { 1e-5 } else { 1e-11 };
                prop_assert!(distance < limit, "{meeting:?} is {distance} away");
            }
            prop_assert!(meetings.windows(2).all(|pair| pair[0].parameter < pair[1].parameter), "sorted: {meetings:?}");
            let polygon = curve.opened().unwrap();
            prop_assert!(crossings(&meetings).len() <= variation(polygon.points(), &line), "more than the polygon");
            let (left, right) = curve.space().parameter_interval();
            let samples: Vec<(f64, f64)> = (0..=300)
                .map(|i| left.mix(right, f64::from(i) / 300.0))
                .map(|t| (t, line.side(curve.evaluate(t).unwrap())))
                .collect();
            for pair in samples.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0) {
                let near = |m: &HyperplaneIntersection<DVec2>| {
                    m.parameter >= pair[0].0 - 1e-5 && m.parameter <= pair[1].0 + 1e-5
                };
                prop_assert!(meetings.iter().any(near), "between {:?}: {meetings:?}", pair);
            }
        }

        #[test]
        fn motions_and_reversal_keep_the_meetings(curve in any_curve(2..=6), angle in 0.0..6.3_f64, offset in -6.0..6.0_f64) {
            let normal = DVec2::from_angle(angle);
            let line = Hyperplane::new(normal, offset).unwrap();
            let found = crossings(&curve.intersect_hyperplane(&line, 1e-6).unwrap());
            let (turn, shift) = (DVec2::from_angle(0.7), DVec2::new(3.0, -2.0));
            let moved = curve.transformed(|point| turn.rotate(point) + shift).unwrap();
            let turned = turn.rotate(normal);
            let moved_line = Hyperplane::new(turned, offset + turned.dot(shift)).unwrap();
            let other = crossings(&moved.intersect_hyperplane(&moved_line, 1e-6).unwrap());
            let (left, right) = curve.space().parameter_interval();
            let reversed = curve.reversed().unwrap().intersect_hyperplane(&line, 1e-6).unwrap();
            let mirrored: Vec<f64> = crossings(&reversed).iter().rev().map(|t| left + right - t).collect();
            for list in [other, mirrored] {
                // Crossings close to a contact may count as undecided in one of both.
                let missing = |t: &&f64| list.iter().all(|s| (s - **t).abs() > 1e-6);
                prop_assert!(found.len().abs_diff(list.len()) <= 2, "{found:?} and {list:?}");
                prop_assert!(found.len() != list.len() || found.iter().find(missing).is_none(), "{found:?} and {list:?}");
            }
        }
    }

    #[test]
    fn ends_contacts_and_stretches_are_told_apart() {
        let curve = |degree, knots: &[f64], points: &[(f64, f64)]| {
            let space = crate::core::bspline::SplineSpace::new(degree, knots.to_vec()).unwrap();
            Nurbs::polynomial(space, points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()).unwrap()
        };
        let axis = Hyperplane::new(DVec2::Y, 0.0).unwrap();
        let kinds = |curve: &Nurbs<DVec2>| -> Vec<IntersectionKind> {
            curve.intersect_hyperplane(&axis, 1e-3).unwrap().iter().map(|m| m.kind).collect()
        };
        let polygon = curve(
            1,
            &[-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
            &[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 0.0), (4.0, -1.0)],
        );
        assert_eq!(
            kinds(&polygon),
            [IntersectionKind::EndPoint, IntersectionKind::EndPoint, IntersectionKind::Contained],
            "start, corner, edge"
        );
        let arc = [-1.0, 0.0, 0.0, 1.0, 1.0, 2.0];
        assert_eq!(
            kinds(&curve(2, &arc, &[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])),
            [IntersectionKind::EndPoint; 2],
            "both ends"
        );
        assert_eq!(
            kinds(&curve(2, &arc, &[(0.0, 0.0), (1.0, -1.0), (2.0, 2.0)])),
            [IntersectionKind::EndPoint, IntersectionKind::Crossing],
            "end and crossing"
        );
        assert_eq!(
            kinds(&curve(2, &arc, &[(0.0, 4.0), (3.0, -2.0), (6.0, 1.0)])),
            [IntersectionKind::Undecided],
            "a contact at 2/3"
        );
        assert_eq!(
            curve(2, &arc, &[(0.0, 0.0); 3]).intersect_hyperplane(&axis, 0.0).unwrap_err().name(),
            "InvalidTolerance",
            "tolerance 0"
        );
    }
}
