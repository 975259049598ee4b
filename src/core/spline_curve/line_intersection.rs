//! Where a plane curve meets a line `a·x = c`.
//!
//! Of a Bezier piece with homogeneous control points `(wⱼ Pⱼ, wⱼ)` the numbers `wⱼ (a·Pⱼ − c)` are the Bernstein coefficients of a polynomial with the same
//! zeros; an even multiplicity is a contact. Zeros at knots are found in both pieces and count once. Course: beyond, section B.6.

use glam::{DVec2, DVec3};

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::root_finding::{Zeros, bernstein_zeros};
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::curve_intersection::{Meeting, check_tolerance};

/// Parameters closer than this part of D are one.
const SAME: f64 = 1e-9;

/// A place where a curve meets a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineIntersection {
    /// The parameter; where a common part begins.
    pub parameter: f64,
    /// The point of the curve.
    pub point: DVec2,
    /// How they meet.
    pub meeting: Meeting,
}

impl Nurbs<DVec2> {
    /// All common points with the line `normal·x = offset`, by parameter; a closed curve over one period.
    ///
    /// Points of the curve within `tolerance` of the line, a length, may count as contacts where they are nearest to it.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::spline_curve::{Meeting, Nurbs};
    ///
    /// let circle = Nurbs::circle(DVec2::ZERO, 1.0)?;
    /// assert_eq!(circle.intersect_line(DVec2::Y, 0.5, 1e-12)?.len(), 2);
    /// assert_eq!(circle.intersect_line(DVec2::Y, 1.0, 1e-12)?[0].meeting, Meeting::Tangent);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `Degenerate` for a normal without a direction; `NonFinite` for the offset.
    pub fn intersect_line(
        &self,
        normal: DVec2,
        offset: f64,
        tolerance: f64,
    ) -> Result<Vec<LineIntersection>, SplineError> {
        check_tolerance(tolerance)?;
        let length = normal.length();
        if !(length.is_finite() && length > 0.0) {
            return Err(SplineError::Degenerate {
                what: "a line whose normal has the length",
                parameter: length,
            });
        }
        if !offset.is_finite() {
            return Err(SplineError::NonFinite { what: "offset", index: 0, value: offset });
        }
        let (normal, offset) = (normal / length, offset / length);
        let mut found: Vec<LineIntersection> = Vec::new();
        let pieces = self.homogeneous().bezier_pieces();
        let mut values = Vec::with_capacity(self.degree() + 1);
        for ((a, b), points) in pieces.iter() {
            // In units of the largest weight, so that values near 0 are lengths no larger than the distance.
            let largest = points.iter().fold(0.0, |largest: f64, point| largest.max(point.z));
            let value = |point: &DVec3| (normal.dot(point.truncate()) - offset * point.z) / largest;
            values.clear();
            values.extend(points.iter().map(value));
            if values.iter().all(|&value| value > tolerance) || values.iter().all(|&value| value < -tolerance)
            {
                continue;
            }
            match bernstein_zeros(&values, tolerance) {
                Zeros::Everywhere => {
                    let ends = [a, b];
                    let meeting = Meeting::Overlap { first: ends, second: ends };
                    let start = LineIntersection { parameter: a, point: self.evaluate(a)?, meeting };
                    match found.last_mut().map(|last| &mut last.meeting) {
                        Some(Meeting::Overlap { first, second }) if first[1] >= a => {
                            (first[1], second[1]) = (b, b);
                        }
                        _ => found.push(start),
                    }
                }
                Zeros::Isolated(zeros) => {
                    for zero in zeros {
                        let parameter = a.mix(b, zero.at);
                        let meeting =
                            if zero.multiplicity % 2 == 1 { Meeting::Crossing } else { Meeting::Tangent };
                        found.push(LineIntersection { parameter, point: self.evaluate(parameter)?, meeting });
                    }
                }
            }
        }
        Ok(self.settled(found, normal, offset, tolerance))
    }

    /// Each meeting once; what it is at a knot is decided by both sides.
    fn settled(
        &self,
        mut found: Vec<LineIntersection>,
        normal: DVec2,
        offset: f64,
        tolerance: f64,
    ) -> Vec<LineIntersection> {
        let (start, end) = self.space().parameter_interval();
        let (same, closed) = (SAME * (end - start), self.space().is_periodic());
        let is_part = |hit: &LineIntersection| matches!(hit.meeting, Meeting::Overlap { .. });
        let parts: Vec<[f64; 2]> = found
            .iter()
            .filter_map(|hit| match hit.meeting {
                Meeting::Overlap { first, .. } => Some(first),
                _ => None,
            })
            .collect();
        found.retain(|hit| {
            is_part(hit)
                || !parts
                    .iter()
                    .any(|part| part[0] - same <= hit.parameter && hit.parameter <= part[1] + same)
        });
        found.dedup_by(|next, kept| {
            !is_part(next) && !is_part(kept) && next.parameter - kept.parameter <= same
        });
        if closed && found.len() > 1 {
            let (first, last) = (found[0], found[found.len() - 1]);
            let seam = first.parameter - start <= same && end - last.parameter <= same;
            if seam && !is_part(&first) && !is_part(&last) {
                found.pop();
            }
        }
        let breaks = self.space().breaks();
        let side = |t: f64| self.evaluate(t).map_or(0.0, |point| normal.dot(point) - offset);
        for hit in found.iter_mut().filter(|hit| !is_part(hit)) {
            let t = hit.parameter;
            if !closed && (t - start <= same || end - t <= same) {
                hit.meeting = Meeting::EndPoint;
                continue;
            }
            if !breaks.iter().any(|knot| (t - knot).abs() <= same) {
                continue;
            }
            // Far enough from the knot that the side is certain, and no further than the next knots.
            let reach = |direction: f64| {
                let ahead = breaks.iter().map(|knot| (knot - t) * direction).filter(|gap| *gap > same);
                let most = ahead.fold(end - start, f64::min) * 0.5;
                (1..40)
                    .map(|k| side(t + direction * most * 0.5_f64.powi(40 - k)))
                    .find(|s| s.abs() > tolerance)
            };
            hit.meeting = match (reach(-1.0), reach(1.0)) {
                (Some(left), Some(right)) if left * right > 0.0 => Meeting::Tangent,
                _ => Meeting::Crossing,
            };
        }
        found
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #[test]
        fn every_change_of_side_is_met(curve in any_curve(1..=6), angle in 0.0..6.3_f64, share in 0.1..0.9_f64) {
            let normal = DVec2::from_angle(angle);
            let heights: Vec<f64> = curve.points().iter().map(|point| normal.dot(*point)).collect();
            let low = heights.iter().copied().fold(f64::MAX, f64::min);
            let high = heights.iter().copied().fold(f64::MIN, f64::max);
            prop_assume!(high - low > 1e-3);
            let offset = low.mix(high, share);
            let found = curve.intersect_line(normal, offset, 1e-10).unwrap();
            for hit in &found {
                prop_assert!((normal.dot(hit.point) - offset).abs() < 1e-8, "{hit:?}");
            }
            prop_assert!(found.windows(2).all(|pair| pair[0].parameter < pair[1].parameter), "{found:?}");
            let (a, b) = curve.space().parameter_interval();
            let sides: Vec<(f64, f64)> = (0..=400)
                .map(|i| a.mix(b, f64::from(i) / 400.0))
                .map(|t| (t, normal.dot(curve.evaluate(t).unwrap()) - offset))
                .collect();
            for pair in sides.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0) {
                let met = found.iter().any(|hit| {
                    let last = match hit.meeting { Meeting::Overlap { first, .. } => first[1], _ => hit.parameter };
                    hit.parameter <= pair[1].0 + 1e-9 && pair[0].0 - 1e-9 <= last
                });
                prop_assert!(met, "between {} and {}: {found:?}", pair[0].0, pair[1].0);
            }
        }
    }

    fn polygon(points: &[[f64; 2]]) -> Nurbs<DVec2> {
        let knots = (-1..=points.len() as i32).map(f64::from).collect();
        let space = SplineSpace::new(1, knots).unwrap();
        Nurbs::polynomial(space, points.iter().copied().map(DVec2::from).collect()).unwrap()
    }

    #[test]
    fn corners_are_judged_by_both_sides() {
        let zigzag = polygon(&[[0.0, 1.0], [1.0, 0.0], [2.0, 1.0], [3.0, -1.0], [4.0, 0.0]]);
        let found = zigzag.intersect_line(DVec2::Y, 0.0, 1e-12).unwrap();
        let kinds: Vec<_> = found.iter().map(|hit| (hit.parameter, hit.meeting)).collect();
        assert_eq!(
            kinds,
            [(1.0, Meeting::Tangent), (2.5, Meeting::Crossing), (4.0, Meeting::EndPoint)],
            "{found:?}"
        );
        let through =
            polygon(&[[0.0, 1.0], [1.0, 0.0], [2.0, -3.0]]).intersect_line(DVec2::Y, 0.0, 1e-12).unwrap();
        assert_eq!(
            through.iter().map(|hit| hit.meeting).collect::<Vec<_>>(),
            [Meeting::Crossing],
            "at a knot, once"
        );
    }

    #[test]
    fn parts_on_the_line_become_one() {
        let step = polygon(&[[0.0, 1.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 1.0]]);
        let found = step.intersect_line(DVec2::Y, 0.0, 1e-12).unwrap();
        let ends = [1.0, 3.0];
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].meeting, Meeting::Overlap { first: ends, second: ends }, "{found:?}");
    }

    #[test]
    fn impossible_lines_are_refused() {
        let curve = polygon(&[[0.0, 1.0], [1.0, 0.0], [2.0, 0.0]]);
        let name =
            |normal, offset, tolerance| curve.intersect_line(normal, offset, tolerance).unwrap_err().name();
        assert_eq!(name(DVec2::ZERO, 0.0, 1e-9), "Degenerate", "no direction");
        assert_eq!(name(DVec2::X, f64::NAN, 1e-9), "NonFinite", "offset");
        assert_eq!(name(DVec2::X, 0.0, f64::NAN), "InvalidTolerance", "tolerance");
    }
}
