//! Where two plane curves meet.
//!
//! The pairs of Bezier pieces that come near each other are looked at one by one, see [`IntersectionTree`]. A meeting at a knot is found in several pairs and
//! counts once; common parts that go on behind a knot become one. Course: beyond, section B.6; T. Sederberg, T. Nishita, *Curve intersection using Bézier
//! clipping*, 1990, for the idea of strips.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::{Contact, RationalBezierError};
use crate::core::spline_curve::{IntersectionTree, Nurbs};

/// Parameters closer than this part of the parameter interval belong to one meeting if its points agree.
const SAME: f64 = 1e-4;
/// Parameters closer to an end of D than this part of it are that end.
const END: f64 = 1e-12;

/// How two curves, or a curve and a line, meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meeting {
    /// They cross.
    Crossing,
    /// They touch within the tolerance.
    Tangent,
    /// An open curve ends there.
    EndPoint,
    /// They agree within the tolerance between these parameters of the first and of the second; the latter decrease for opposite directions. A line
    /// is parametrised by the parameter of the curve.
    Overlap {
        /// Ends of the common part on the first curve.
        first: [f64; 2],
        /// The parameters of the same points on the second.
        second: [f64; 2],
    },
}

impl From<Contact> for Meeting {
    fn from(contact: Contact) -> Self {
        match contact {
            Contact::Crossing => Self::Crossing,
            Contact::Tangent => Self::Tangent,
            Contact::Overlap { first, second } => Self::Overlap { first, second },
        }
    }
}

/// A common point, or the start of a common part, of two curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveIntersection {
    /// The parameters on the first and on the second curve.
    pub parameters: [f64; 2],
    /// The point, on the first curve.
    pub point: DVec2,
    /// How they meet.
    pub meeting: Meeting,
}

impl Nurbs<DVec2> {
    /// All common points with `other`, sorted by the parameter of this curve; what is within `tolerance` counts as common. Closed curves are taken over one
    /// period. For many questions prepare [`IntersectionTree`]s.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::spline_curve::Nurbs;
    ///
    /// let (one, other) = (Nurbs::circle(DVec2::ZERO, 1.0)?, Nurbs::circle(DVec2::X, 1.0)?);
    /// let found = one.intersections(&other, 1e-10)?;
    /// assert_eq!(found.len(), 2);
    /// assert!((found[0].point.x - 0.5).abs() < 1e-12);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` where a pair of pieces needs too many halvings; `NonFinite` or `WeightNotPositive` where a Bezier form leaves the range of
    /// numbers.
    pub fn intersections(&self, other: &Self, tolerance: f64) -> Result<Vec<CurveIntersection>, SplineError> {
        let [one, two] = [self, other].map(IntersectionTree::of_whole_pieces);
        one?.intersections(&two?, tolerance)
    }
}

pub(super) fn check_tolerance(tolerance: f64) -> Result<(), SplineError> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(SplineError::InvalidTolerance { value: tolerance });
    }
    Ok(())
}

/// An error of the pieces as one of the curve.
pub(super) fn as_spline_error(error: RationalBezierError) -> SplineError {
    use crate::core::bezier::BezierError;
    match error {
        RationalBezierError::Bezier(BezierError::StepLimit { what, value, limit }) => {
            SplineError::StepLimit { what, value, limit }
        }
        RationalBezierError::WeightNotPositive { index, value } => {
            SplineError::WeightNotPositive { index, value }
        }
        RationalBezierError::NonFinite { what, index, value }
        | RationalBezierError::Bezier(BezierError::NonFinite { what, index, value }) => {
            SplineError::NonFinite { what, index, value }
        }
        other => SplineError::NoSolution { reason: other.to_string() },
    }
}

/// What makes one list of the meetings of all pairs.
pub(super) struct Merge<'a> {
    pub(super) curves: [&'a Nurbs<DVec2>; 2],
    pub(super) tolerance: f64,
}

impl Merge<'_> {
    pub(super) fn merged(&self, found: Vec<CurveIntersection>) -> Vec<CurveIntersection> {
        let (mut overlaps, points): (Vec<_>, Vec<_>) =
            found.into_iter().partition(|hit| matches!(hit.meeting, Meeting::Overlap { .. }));
        overlaps.sort_by(|p, q| p.parameters[0].total_cmp(&q.parameters[0]));
        let mut merged: Vec<CurveIntersection> = Vec::new();
        for overlap in overlaps {
            let goes_on = merged.last_mut().is_some_and(|last| self.join(last, &overlap));
            if !goes_on {
                merged.push(overlap);
            }
        }
        let parts = merged.len();
        for mut hit in points {
            if merged[..parts].iter().any(|part| self.is_in(part, &hit)) {
                continue;
            }
            if (0..2).any(|j| self.is_end(j, hit.parameters[j])) {
                hit.meeting = Meeting::EndPoint;
            }
            match merged[parts..].iter_mut().find(|old| self.is_same(old, &hit)) {
                Some(old) if hit.meeting == Meeting::Crossing && old.meeting == Meeting::Tangent => {
                    *old = hit;
                }
                Some(_) => {}
                None => merged.push(hit),
            }
        }
        merged.sort_by(|p, q| {
            p.parameters[0].total_cmp(&q.parameters[0]).then(p.parameters[1].total_cmp(&q.parameters[1]))
        });
        merged
    }

    fn length(&self, j: usize) -> f64 {
        let (a, b) = self.curves[j].space().parameter_interval();
        b - a
    }

    /// Distance of two parameters of curve `j`, around the seam if it is closed, as a part of the whole.
    fn distance(&self, j: usize, a: f64, b: f64) -> f64 {
        let apart = (a - b).abs() / self.length(j);
        if self.curves[j].space().is_periodic() { apart.min((1.0 - apart).abs()) } else { apart }
    }

    fn is_end(&self, j: usize, t: f64) -> bool {
        let (a, b) = self.curves[j].space().parameter_interval();
        !self.curves[j].space().is_periodic() && (t - a).abs().min((t - b).abs()) <= END * (b - a)
    }

    fn is_same(&self, one: &CurveIntersection, other: &CurveIntersection) -> bool {
        let near = |j: usize| self.distance(j, one.parameters[j], other.parameters[j]) <= SAME;
        let touches = one.meeting == Meeting::Tangent || other.meeting == Meeting::Tangent;
        near(0) && near(1) && (touches || one.point.distance(other.point) <= 4.0 * self.tolerance)
    }

    /// Whether a point belongs to a common part.
    fn is_in(&self, part: &CurveIntersection, hit: &CurveIntersection) -> bool {
        let Meeting::Overlap { first, second } = part.meeting else { return false };
        let within = |j: usize, [a, b]: [f64; 2]| {
            let slack = SAME * self.length(j);
            (a.min(b) - slack..=a.max(b) + slack).contains(&hit.parameters[j])
        };
        within(0, first) && within(1, second)
    }

    /// Lengthens `part` by `next` if that begins where it ends.
    fn join(&self, part: &mut CurveIntersection, next: &CurveIntersection) -> bool {
        let (Meeting::Overlap { first, second }, Meeting::Overlap { first: on, second: to }) =
            (&mut part.meeting, next.meeting)
        else {
            return false;
        };
        let meets = self.distance(0, first[1], on[0]) <= SAME && self.distance(1, second[1], to[0]) <= SAME;
        if meets {
            (first[1], second[1]) = (on[1], to[1]);
        }
        meets
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{Side, SplineSpace};
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;

    fn moved(curve: &Nurbs<DVec2>, by: DVec2) -> Nurbs<DVec2> {
        let points = curve.points().iter().map(|&point| point + by).collect();
        Nurbs::new(curve.space().clone(), points, curve.weights().to_vec()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn planted_crossings_are_found_and_order_does_not_matter(
            one in any_curve(1..=5), other in any_curve(1..=5), shares in prop::array::uniform2(0.05..0.95_f64),
        ) {
            let at = |curve: &Nurbs<DVec2>, share: f64| {
                let (a, b) = curve.space().parameter_interval();
                a.mix(b, share)
            };
            // A piece that is a single point meets another curve at all of its parameters or at any one of them.
            let stands_still = |curve: &Nurbs<DVec2>| {
                let pieces = curve.rational_bezier_curves().unwrap();
                pieces.iter().any(|piece| piece.points().iter().all(|p| p.distance(piece.points()[0]) < 1e-6))
            };
            prop_assume!(!stands_still(&one) && !stands_still(&other));
            let (t, u) = (at(&one, shares[0]), at(&other, shares[1]));
            let (Ok(p), Ok(q)) = (one.frame(t, Side::Right), other.frame(u, Side::Right)) else { return Ok(()) };
            prop_assume!(p.tangent.perp_dot(q.tangent).abs() > 0.1);
            let other = moved(&other, p.point - q.point);
            let Ok(found) = one.intersections(&other, 1e-9) else { return Ok(()) };
            let planted = found.iter().any(|hit| match hit.meeting {
                Meeting::Overlap { first, .. } => first[0] - 1e-6 <= t && t <= first[1] + 1e-6,
                _ => hit.point.distance(p.point) < 1e-6 && (hit.parameters[0] - t).abs() < 1e-5,
            });
            prop_assert!(planted, "t = {t}, u = {u}: {found:?}");
            for hit in &found {
                let gap = one.evaluate(hit.parameters[0]).unwrap().distance(other.evaluate(hit.parameters[1]).unwrap());
                prop_assert!(gap <= 1e-8, "{hit:?}: gap {gap}");
            }
            for (i, hit) in found.iter().enumerate() {
                let twice = found[..i].iter().any(|old| {
                    (0..2).all(|j| (old.parameters[j] - hit.parameters[j]).abs() < 1e-7)
                });
                prop_assert!(!twice, "{hit:?} is there twice");
            }
            let swapped = other.intersections(&one, 1e-9).unwrap();
            prop_assert_eq!(swapped.len(), found.len(), "{:?} and {:?}", found, swapped);
        }
    }

    #[test]
    fn closed_curves_meet_once_at_their_seams() {
        let one = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let (start, _) = one.space().parameter_interval();
        let seam = one.evaluate(start).unwrap();
        // Another circle through the seam, and through the point opposite.
        let other = Nurbs::circle(seam.perp(), 2.0_f64.sqrt()).unwrap();
        let found = one.intersections(&other, 1e-10).unwrap();
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().all(|hit| hit.meeting == Meeting::Crossing), "{found:?}");
    }

    #[test]
    fn circles_that_touch_and_circles_that_agree() {
        let one = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let beside = Nurbs::circle(DVec2::new(1.2, 1.6), 1.0).unwrap();
        let found = one.intersections(&beside, 1e-9).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(
            found[0].meeting == Meeting::Tangent && found[0].point.distance(DVec2::new(0.6, 0.8)) < 1e-6,
            "{found:?}"
        );
        let same = one.intersections(&one, 1e-9).unwrap();
        let covered: f64 = same
            .iter()
            .filter_map(|hit| match hit.meeting {
                Meeting::Overlap { first, .. } => Some(first[1] - first[0]),
                _ => None,
            })
            .sum();
        let (a, b) = one.space().parameter_interval();
        assert!((covered - (b - a)).abs() < 1e-6, "the whole circle: {same:?}");
        let tolerance = one.intersections(&one, 0.0).unwrap_err();
        assert_eq!(tolerance.name(), "InvalidTolerance", "0");
    }

    #[test]
    fn ends_on_the_other_curve_are_told() {
        let line = |a: DVec2, b: DVec2| {
            let space = SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 2.0]).unwrap();
            Nurbs::polynomial(space, vec![a, b]).unwrap()
        };
        let (base, post) = (line(-DVec2::X, DVec2::X), line(DVec2::ZERO, DVec2::Y));
        let found = base.intersections(&post, 1e-9).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].meeting, found[0].parameters), (Meeting::EndPoint, [0.5, 0.0]), "{found:?}");
    }
}
