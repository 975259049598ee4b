//! Where a plane curve meets a line `a·x = c`.
//!
//! Of a Bezier piece with homogeneous control points `(wⱼ Pⱼ, wⱼ)` the numbers `wⱼ (a·Pⱼ − c)` are the Bernstein coefficients of a polynomial with the same
//! zeros; an even multiplicity is a contact. Zeros at knots are found in both pieces and count once. Course: beyond, section B.6.

use glam::DVec2;

use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::point::Point as _;
use crate::core::root_finding::{Zeros, bernstein_zeros, single_sign_change, single_zero};
use crate::core::spline_curve::curve_intersection::check_tolerance;
use crate::core::spline_curve::local_piece::LocalPiece;
use crate::core::spline_curve::{IntersectionTree, Meeting, Nurbs};

/// Parameters closer than this part of D are one.
const SAME: f64 = 1e-9;
/// Rounding errors of heights over a line, in units of the size of a piece.
const NOISE: f64 = 64.0 * f64::EPSILON;

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
        let line = Line::new(normal, offset, tolerance)?;
        let pieces = self.local_pieces()?;
        Ok(line.settled(self, line.meetings(same(self), pieces.iter())))
    }
}

impl IntersectionTree {
    /// All common points with the line `normal·x = offset`, see [`Nurbs::intersect_line`].
    ///
    /// # Errors
    ///
    /// As there.
    pub fn intersect_line(
        &self,
        normal: DVec2,
        offset: f64,
        tolerance: f64,
    ) -> Result<Vec<LineIntersection>, SplineError> {
        let line = Line::new(normal, offset, tolerance)?;
        let mut near = Vec::with_capacity(16);
        self.tree.near_plane(line.normal.to_array(), line.offset, tolerance, |piece| near.push(piece));
        near.sort_unstable();
        let pieces = near.iter().map(|&piece| &self.pieces[piece].local);
        Ok(line.settled(&self.curve, line.meetings(same(&self.curve), pieces)))
    }
}

/// The distance of parameters below which they are one.
fn same(curve: &Nurbs<DVec2>) -> f64 {
    let (a, b) = curve.space().parameter_interval();
    SAME * (b - a)
}

/// The line `normal·x = offset` with a unit normal.
struct Line {
    normal: DVec2,
    offset: f64,
    tolerance: f64,
}

/// A meeting, and whether it is so near to an end of its piece that a neighbour may know it too.
type Found = (LineIntersection, bool);

impl Line {
    fn new(normal: DVec2, offset: f64, tolerance: f64) -> Result<Self, SplineError> {
        check_tolerance(tolerance)?;
        let length = normal.length();
        if !(length.is_finite() && length > 0.0) {
            let what = "a line whose normal has the length";
            return Err(SplineError::Degenerate { what, parameter: length });
        }
        if !offset.is_finite() {
            return Err(SplineError::NonFinite { what: "offset", index: 0, value: offset });
        }
        Ok(Self { normal: normal / length, offset: offset / length, tolerance })
    }

    /// What the line has in common with each piece, left to right; parameters closer than `same` are one.
    fn meetings<'a>(&self, same: f64, pieces: impl Iterator<Item = &'a LocalPiece<DVec2>>) -> Vec<Found> {
        let tolerance = self.tolerance;
        let mut found: Vec<Found> = Vec::with_capacity(16);
        let mut buffer = [0.0; MAX_DEGREE + 1];
        for piece in pieces {
            let values = &mut buffer[..=piece.degree()];
            // In units of the largest weight, so that values near 0 are lengths no larger than the distance.
            let (scale, height) =
                (piece.largest_weight().recip(), self.normal.dot(piece.origin) - self.offset);
            for (j, value) in values.iter_mut().enumerate() {
                let weight = piece.weights.get(j).copied().unwrap_or(1.0);
                *value = (self.normal.dot(piece.numerators[j]) + height * weight) * scale;
            }
            if values.iter().all(|&value| value > tolerance) || values.iter().all(|&value| value < -tolerance)
            {
                continue;
            }
            let (a, b) = piece.interval;
            let meet = |at: f64, meeting: Meeting| {
                let point = piece.origin + piece.offset_at(at);
                let is_at_joint = at.min(1.0 - at) * (b - a) <= 2.0 * same;
                (LineIntersection { parameter: a.mix(b, at), point, meeting }, is_at_joint)
            };
            if let Some(k) = single_sign_change(values, tolerance.max(NOISE * piece.extent)) {
                found.push(meet(single_zero(values, k), Meeting::Crossing));
                continue;
            }
            match bernstein_zeros(values, tolerance) {
                Zeros::Everywhere => match found.last_mut().map(|last| &mut last.0.meeting) {
                    Some(Meeting::Overlap { first, second }) if first[1] >= a => {
                        (first[1], second[1]) = (b, b);
                    }
                    _ => found.push(meet(0.0, Meeting::Overlap { first: [a, b], second: [a, b] })),
                },
                Zeros::Isolated(zeros) => found.extend(zeros.iter().map(|zero| {
                    let is_odd = zero.multiplicity % 2 == 1;
                    meet(zero.at, if is_odd { Meeting::Crossing } else { Meeting::Tangent })
                })),
            }
        }
        found
    }

    /// Each meeting once; what it is at a knot is decided by both sides.
    fn settled(&self, curve: &Nurbs<DVec2>, mut found: Vec<Found>) -> Vec<LineIntersection> {
        let (start, end) = curve.space().parameter_interval();
        let (same, closed) = (same(curve), curve.space().is_periodic());
        let part = |hit: &LineIntersection| match hit.meeting {
            Meeting::Overlap { first, .. } => Some(first),
            _ => None,
        };
        let parts: Vec<[f64; 2]> = found.iter().filter_map(|(hit, _)| part(hit)).collect();
        let is_part = |hit: &LineIntersection| part(hit).is_some();
        found.retain(|(hit, _)| {
            let in_part =
                |part: &[f64; 2]| part[0] - same <= hit.parameter && hit.parameter <= part[1] + same;
            is_part(hit) || !parts.iter().any(in_part)
        });
        found.dedup_by(|(next, _), (kept, _)| {
            !is_part(next) && !is_part(kept) && next.parameter - kept.parameter <= same
        });
        if closed && found.len() > 1 {
            let (first, last) = (found[0].0, found[found.len() - 1].0);
            let seam = first.parameter - start <= same && end - last.parameter <= same;
            if seam && !is_part(&first) && !is_part(&last) {
                found.pop();
            }
        }
        let mut breaks = Vec::new();
        let side = |t: f64| curve.evaluate(t).map_or(0.0, |point| self.normal.dot(point) - self.offset);
        for (hit, _) in found.iter_mut().filter(|(hit, is_at_joint)| *is_at_joint && !is_part(hit)) {
            let t = hit.parameter;
            if !closed && (t - start <= same || end - t <= same) {
                hit.meeting = Meeting::EndPoint;
                continue;
            }
            if breaks.is_empty() {
                breaks = curve.space().breaks();
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
                    .find(|s| s.abs() > self.tolerance)
            };
            hit.meeting = match (reach(-1.0), reach(1.0)) {
                (Some(left), Some(right)) if left * right > 0.0 => Meeting::Tangent,
                _ => Meeting::Crossing,
            };
        }
        found.into_iter().map(|(hit, _)| hit).collect()
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
