//! Where a plane curve meets itself.
//!
//! Bezier pieces are halved until all their tangents lie within 40 degrees of the chord; such a part does not meet itself, and neither do two neighbours
//! with one cone for both, except in their common end. All other pairs are handled as two curves. Course: beyond, section B.6.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::rational_bezier::RationalBezier;
use crate::core::spline_curve::curve_intersection::{Merge, check_tolerance};
use crate::core::spline_curve::intersection_tree::{HALVINGS, meet};
use crate::core::spline_curve::plane_piece::gentle_parts;
use crate::core::spline_curve::{CurveIntersection, IntersectionTree, Meeting, Nurbs};

/// Half opening of the cone of a part, in radians.
const OPENING: f64 = 0.7;
/// Reach of a cusp in units of `ε^(2/3)·size^(1/3)`.
const CUSP: f64 = 8.0;
/// Points at which a part of the curve is looked at.
const SAMPLES: u32 = 16;
/// Meetings of neighbours closer to their common end than this part of them are that end.
const COMMON_END: f64 = 1e-3;

impl Nurbs<DVec2> {
    /// All points that the curve passes twice, with `parameters[0] < parameters[1]`, sorted; a closed curve over one period.
    ///
    /// Joints of pieces and the seam of a closed curve do not count, and neither do cusps.
    ///
    /// # Errors
    ///
    /// As [`Nurbs::intersections`].
    pub fn self_intersections(&self, tolerance: f64) -> Result<Vec<CurveIntersection>, SplineError> {
        check_tolerance(tolerance)?;
        let parts = gentle_parts(self, OPENING, tolerance)?;
        let closed = self.space().is_periodic();
        let last = parts.len() - 1;
        let tree = IntersectionTree::of_pieces(self, parts)?;
        let mut found = Vec::new();
        for (i, j) in tree.pairs(&tree, tolerance) {
            let (p, q) = (&tree.pieces[i], &tree.pieces[j]);
            let is_neighbour = i + 1 == j || (closed && i == 0 && j == last);
            if i >= j || (is_neighbour && share_a_cone(&p.curve, &q.curve)) {
                continue;
            }
            let mut hits = Vec::new();
            meet(p, q, tolerance, HALVINGS, &mut hits)?;
            let at_joint = |[t, u]: [f64; 2]| {
                let ((a, b), (c, d)) = (p.curve.interval(), q.curve.interval());
                let near = |x: f64, end: f64, length: f64| (x - end).abs() <= COMMON_END * length;
                (i + 1 == j && near(t, b, b - a) && near(u, c, d - c))
                    || (closed && i == 0 && j == last && near(t, a, b - a) && near(u, d, d - c))
            };
            hits.retain(|hit| {
                !((is_neighbour && at_joint(hit.parameters)) || self.stays_near(hit, tolerance))
            });
            found.append(&mut hits);
        }
        Ok(Merge { curves: [self, self], tolerance }.merged(found))
    }
}

impl Nurbs<DVec2> {
    /// Whether the curve hardly leaves the point between both parameters: at a cusp, whose branches are `ε` apart at the distance `ε^(2/3)`.
    fn stays_near(&self, hit: &CurveIntersection, tolerance: f64) -> bool {
        let mut ends = hit.parameters;
        if let Meeting::Overlap { first, second } = hit.meeting {
            let all = || first.into_iter().chain(second);
            ends = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
        }
        let (a, b) = self.space().parameter_interval();
        let size = self.points().iter().map(|point| point.distance(self.points()[0])).fold(0.0, f64::max);
        let reach = CUSP * (tolerance * tolerance * size).cbrt();
        let is_near = |from: f64, to: f64| {
            let between = (0..=SAMPLES).map(|i| from.mix(to, f64::from(i) / f64::from(SAMPLES)));
            let turned = |t: f64| if t > b { t - (b - a) } else { t };
            between
                .map(turned)
                .all(|t| self.evaluate(t).is_ok_and(|point| point.distance(hit.point) <= reach))
        };
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        is_near(low, high) || (self.space().is_periodic() && is_near(high, low + (b - a)))
    }
}

/// Whether the tangents of both lie within less than 90 degrees of one direction.
fn share_a_cone(one: &RationalBezier<DVec2>, other: &RationalBezier<DVec2>) -> bool {
    let (Some((a, p)), Some((b, q))) = (one.tangent_cone(), other.tangent_cone()) else { return false };
    let turn = (a - b).rem_euclid(TAU);
    0.5 * (turn.min(TAU - turn) + p + q) < 0.49 * PI
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};

    fn curve(degree: usize, points: &[[f64; 2]]) -> Nurbs<DVec2> {
        let breaks: Vec<f64> = (0..=points.len() - degree).map(|i| i as f64).collect();
        let space = SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating).unwrap();
        Nurbs::polynomial(space, points.iter().copied().map(DVec2::from).collect()).unwrap()
    }

    #[test]
    fn simple_curves_do_not_meet_themselves() {
        for radius in [1e-3, 1.0, 1e6] {
            let circle = Nurbs::circle(DVec2::ONE, radius).unwrap();
            assert!(circle.self_intersections(1e-9 * radius).unwrap().is_empty(), "radius {radius}");
        }
        let arch = curve(3, &[[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0], [5.0, -2.0], [6.0, 0.0]]);
        assert!(arch.self_intersections(1e-9).unwrap().is_empty(), "a wave");
        let cusp = curve(3, &[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]);
        assert!(cusp.self_intersections(1e-9).unwrap().is_empty(), "a cusp");
    }

    #[test]
    fn a_star_of_five_corners_meets_itself_five_times() {
        // A closed polygon that visits every second corner of a regular pentagon.
        let corner = |k: usize| DVec2::from_angle(TAU * (2 * k) as f64 / 5.0 + 0.1);
        let star = Nurbs::closed((0..5).map(corner).collect(), vec![1.0; 5], 1).unwrap();
        let found = star.self_intersections(1e-10).unwrap();
        assert_eq!(found.len(), 5, "{found:?}");
        let inner = found[0].point.length();
        assert!(found.iter().all(|hit| (hit.point.length() - inner).abs() < 1e-12), "{found:?}");
        let smooth = Nurbs::closed((0..5).map(corner).collect(), vec![1.0; 5], 3).unwrap();
        let found = smooth.self_intersections(1e-10).unwrap();
        assert_eq!(found.len(), 5, "{found:?}");
        for hit in &found {
            let [t, u] = hit.parameters;
            let gap = smooth.evaluate(t).unwrap().distance(smooth.evaluate(u).unwrap());
            assert!(gap < 1e-10 && t < u && hit.meeting == Meeting::Crossing, "{hit:?}: {gap}");
        }
    }

    #[test]
    fn loops_are_found_and_a_curve_run_through_twice_is_one_common_part() {
        let loops = curve(
            3,
            &[[0.0, 0.0], [4.0, 3.0], [-3.0, 3.0], [1.0, 0.0], [5.0, -3.0], [-2.0, -3.0], [2.0, 0.0]],
        );
        let found = loops.self_intersections(1e-10).unwrap();
        assert!(found.len() >= 2 && found.iter().all(|hit| hit.meeting == Meeting::Crossing), "{found:?}");
        let points = [[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [2.0, 1.0], [0.0, 0.0]];
        let there_and_back = curve(1, &points).self_intersections(1e-9).unwrap();
        let covered: f64 = there_and_back
            .iter()
            .filter_map(|hit| match hit.meeting {
                Meeting::Overlap { first, .. } => Some(first[1] - first[0]),
                _ => None,
            })
            .sum();
        assert!((covered - 2.0).abs() < 1e-6, "{there_and_back:?}");
    }
}
