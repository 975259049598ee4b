//! Where a plane curve meets itself.
//!
//! Bezier pieces are halved until all their tangents lie within 40 degrees of the chord; such a part does not meet itself, and neither do two neighbours
//! with one cone for both, except in their common end. All other pairs are handled as two curves. Course: beyond, section B.6.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::RationalBezier;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::curve_intersection::{
    BoxedPiece, CurveIntersection, Merge, as_spline_error, boxed_pieces, check_tolerance, overlapping_pairs,
};

/// Half opening of the cone of a part, in radians.
const OPENING: f64 = 0.7;
/// Halvings of one piece after which it is taken as it is: at a cusp.
const MAX_DEPTH: usize = 40;
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
        let mut parts: Vec<BoxedPiece> = Vec::new();
        for piece in boxed_pieces(self)? {
            let mut stack = vec![(piece.curve, 0)];
            while let Some((curve, depth)) = stack.pop() {
                let (a, b) = curve.interval();
                let middle = 0.5 * (a + b);
                let is_small = depth >= MAX_DEPTH || BoxedPiece::new(curve.clone()).size() <= tolerance;
                if is_small
                    || curve.tangent_cone().is_some_and(|(_, opening)| opening <= OPENING)
                    || !(a < middle && middle < b)
                {
                    parts.push(BoxedPiece::new(curve));
                    continue;
                }
                let (left, right) = curve.split(middle).map_err(as_spline_error)?;
                stack.push((right, depth + 1));
                stack.push((left, depth + 1));
            }
        }
        let closed = self.space().is_periodic();
        let last = parts.len() - 1;
        let mut found = Vec::new();
        for (i, j) in overlapping_pairs(&parts, &parts, tolerance) {
            let is_neighbour = i + 1 == j || (closed && i == 0 && j == last);
            if i >= j || (is_neighbour && share_a_cone(&parts[i].curve, &parts[j].curve)) {
                continue;
            }
            let hits = parts[i].curve.intersections(&parts[j].curve, tolerance).map_err(as_spline_error)?;
            let at_joint = |[t, u]: [f64; 2]| {
                let ((a, b), (c, d)) = (parts[i].curve.interval(), parts[j].curve.interval());
                let near = |x: f64, end: f64, length: f64| (x - end).abs() <= COMMON_END * length;
                (i + 1 == j && near(t, b, b - a) && near(u, c, d - c))
                    || (closed && i == 0 && j == last && near(t, a, b - a) && near(u, d, d - c))
            };
            found.extend(hits.into_iter().filter(|hit| !(is_neighbour && at_joint(hit.parameters))).map(
                |hit| {
                    let meeting = hit.contact.into();
                    CurveIntersection { parameters: hit.parameters, point: hit.point, meeting }
                },
            ));
        }
        Ok(Merge { curves: [self, self], tolerance }.merged(found))
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
    use crate::core::spline_curve::Meeting;

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
