//! Where a plane curve meets a line `a·x = c`.
//!
//! Of a Bezier piece with homogeneous control points `(wⱼ Pⱼ, wⱼ)` the numbers `wⱼ (a·Pⱼ − c)` are the Bernstein coefficients of a polynomial with the same
//! zeros; an even multiplicity is a contact. Zeros at knots are found in both pieces and count once. Course: beyond, section B.6.

use glam::DVec2;

use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::point::Point as _;
use crate::core::root_finding::{Zeros, bernstein_zeros, single_sign_change, single_zeros};
use crate::core::spline_curve::curve_intersection::check_tolerance;
use crate::core::spline_curve::local_piece::LocalPiece;
use crate::core::spline_curve::{IntersectionTree, Meeting, Nurbs};

/// Parameters closer than this part of D are one.
const SAME: f64 = 1e-9;
/// Rounding errors of heights over a line, in units of the size of a piece.
const NOISE: f64 = 64.0 * f64::EPSILON;
/// Single crossings that are computed side by side.
const LANES: usize = 4;

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

/// What a line and pieces of a curve have in common.
#[derive(Default)]
struct Found {
    hits: Vec<LineIntersection>,
    /// Whether one of them is so near to an end of its piece that a neighbour may know it too.
    any_at_joint: bool,
}

/// Pieces that cross the line once: the Bernstein coefficients of their heights, where their only sign change is, and the places of their hits in the list.
struct Crossings<'a> {
    heights: [[f64; LANES]; MAX_DEGREE + 1],
    changes: [usize; LANES],
    places: [(usize, &'a LocalPiece<DVec2>); LANES],
    count: usize,
}

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
    fn meetings<'a>(&self, same: f64, pieces: impl Iterator<Item = &'a LocalPiece<DVec2>>) -> Found {
        let tolerance = self.tolerance;
        let mut found = Found { hits: Vec::with_capacity(12), any_at_joint: false };
        let mut waiting: Option<Crossings<'a>> = None;
        let mut buffer = [0.0; MAX_DEGREE + 1];
        for piece in pieces {
            let values = &mut buffer[..=piece.degree()];
            self.heights(piece, values);
            if let Some(k) = single_sign_change(values, tolerance.max(NOISE * piece.extent)) {
                let crossings = waiting.get_or_insert_with(|| Crossings::none(piece));
                crossings.add(values, k, (found.hits.len(), piece));
                // Its place; the numbers follow.
                let (parameter, point) = (piece.interval.0, piece.origin);
                found.hits.push(LineIntersection { parameter, point, meeting: Meeting::Crossing });
                if crossings.count == LANES {
                    crossings.settle(same, &mut found);
                }
                continue;
            }
            if values.iter().all(|&value| value > tolerance) || values.iter().all(|&value| value < -tolerance)
            {
                continue;
            }
            let (a, b) = piece.interval;
            match bernstein_zeros(values, tolerance) {
                Zeros::Everywhere => match found.hits.last_mut().map(|last| &mut last.meeting) {
                    Some(Meeting::Overlap { first, second }) if first[1] >= a => {
                        (first[1], second[1]) = (b, b);
                    }
                    _ => {
                        let part = Meeting::Overlap { first: [a, b], second: [a, b] };
                        let hit = found.hit(piece, 0.0, part, same);
                        found.hits.push(hit);
                    }
                },
                Zeros::Isolated(zeros) => {
                    for zero in zeros {
                        let is_odd = zero.multiplicity % 2 == 1;
                        let meeting = if is_odd { Meeting::Crossing } else { Meeting::Tangent };
                        let hit = found.hit(piece, zero.at, meeting, same);
                        found.hits.push(hit);
                    }
                }
            }
        }
        if let Some(crossings) = &mut waiting {
            crossings.settle(same, &mut found);
        }
        found
    }

    /// The heights of a piece over the line times its weight function, in units of the largest weight, so that values near 0 are lengths no larger than the distance.
    fn heights(&self, piece: &LocalPiece<DVec2>, values: &mut [f64]) {
        let height = self.normal.dot(piece.origin) - self.offset;
        for (value, &numerator) in values.iter_mut().zip(&piece.numerators) {
            *value = self.normal.dot(numerator);
        }
        if piece.weights.is_empty() {
            values.iter_mut().for_each(|value| *value += height);
        } else {
            let scale = piece.largest_weight().recip();
            for (value, &weight) in values.iter_mut().zip(&piece.weights) {
                *value = (*value + height * weight) * scale;
            }
        }
    }

    /// Each meeting once; what it is at a knot is decided by both sides.
    fn settled(&self, curve: &Nurbs<DVec2>, found: Found) -> Vec<LineIntersection> {
        let (start, end) = curve.space().parameter_interval();
        let (same, closed) = (same(curve), curve.space().is_periodic());
        let Found { mut hits, any_at_joint } = found;
        let part = |hit: &LineIntersection| match hit.meeting {
            Meeting::Overlap { first, .. } => Some(first),
            _ => None,
        };
        let is_part = |hit: &LineIntersection| part(hit).is_some();
        let parts: Vec<[f64; 2]> = hits.iter().filter_map(part).collect();
        if !parts.is_empty() {
            hits.retain(|hit| {
                let in_part =
                    |part: &[f64; 2]| part[0] - same <= hit.parameter && hit.parameter <= part[1] + same;
                is_part(hit) || !parts.iter().any(in_part)
            });
        }
        hits.dedup_by(|next, kept| {
            !is_part(next) && !is_part(kept) && next.parameter - kept.parameter <= same
        });
        if !any_at_joint {
            return hits;
        }
        if closed && hits.len() > 1 {
            let (first, last) = (hits[0], hits[hits.len() - 1]);
            let seam = first.parameter - start <= same && end - last.parameter <= same;
            if seam && !is_part(&first) && !is_part(&last) {
                hits.pop();
            }
        }
        let breaks = curve.space().breaks();
        let side = |t: f64| curve.evaluate(t).map_or(0.0, |point| self.normal.dot(point) - self.offset);
        for hit in hits.iter_mut().filter(|hit| !is_part(hit)) {
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
                    .find(|s| s.abs() > self.tolerance)
            };
            hit.meeting = match (reach(-1.0), reach(1.0)) {
                (Some(left), Some(right)) if left * right > 0.0 => Meeting::Tangent,
                _ => Meeting::Crossing,
            };
        }
        hits
    }
}

impl Found {
    /// What is at `at` in `[0, 1]` of a piece.
    fn hit(&mut self, piece: &LocalPiece<DVec2>, at: f64, meeting: Meeting, same: f64) -> LineIntersection {
        let (a, b) = piece.interval;
        self.any_at_joint |= at.min(1.0 - at) * (b - a) <= 2.0 * same;
        LineIntersection { parameter: a.mix(b, at), point: piece.origin + piece.offset_at(at), meeting }
    }
}

impl<'a> Crossings<'a> {
    /// With `any` piece where there is none.
    fn none(any: &'a LocalPiece<DVec2>) -> Self {
        Self {
            heights: [[0.0; LANES]; MAX_DEGREE + 1],
            changes: [1; LANES],
            places: [(0, any); LANES],
            count: 0,
        }
    }

    fn add(&mut self, values: &[f64], change: usize, place: (usize, &'a LocalPiece<DVec2>)) {
        for (row, &value) in self.heights.iter_mut().zip(values) {
            row[self.count] = value;
        }
        self.changes[self.count] = change;
        self.places[self.count] = place;
        self.count += 1;
    }

    /// Gives the hits their numbers.
    fn settle(&mut self, same: f64, found: &mut Found) {
        if self.count == 0 {
            return;
        }
        let heights = &mut self.heights[..=self.places[0].1.degree()];
        // Lanes without a piece repeat the first one.
        for lane in self.count..LANES {
            heights.iter_mut().for_each(|row| row[lane] = row[0]);
            self.changes[lane] = self.changes[0];
        }
        let zeros = single_zeros(heights, self.changes);
        for (&(place, piece), &at) in self.places.iter().zip(&zeros).take(self.count) {
            found.hits[place] = found.hit(piece, at, Meeting::Crossing, same);
        }
        self.count = 0;
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
    fn a_wave_is_crossed_as_often_with_a_tree_as_without() {
        let points = (0..40).map(|k| DVec2::new(f64::from(k), if k % 2 == 0 { 1.0 } else { -1.0 })).collect();
        let space = SplineSpace::new(3, (0..44).map(f64::from).collect()).unwrap();
        let wave = Nurbs::polynomial(space, points).unwrap();
        let tree = IntersectionTree::new(&wave).unwrap();
        for share in -9..=9 {
            // Its extreme values are ±1/3.
            let offset = f64::from(share) / 30.0;
            let [one, other] =
                [wave.intersect_line(DVec2::Y, offset, 1e-12), tree.intersect_line(DVec2::Y, offset, 1e-12)]
                    .map(Result::unwrap);
            assert!((36..=37).contains(&one.len()), "offset {offset}: {one:?}");
            assert_eq!(one.len(), other.len(), "offset {offset}");
            for (hit, same) in one.iter().zip(&other) {
                assert!((hit.parameter - same.parameter).abs() < 1e-12, "{hit:?}, {same:?}");
                assert!((hit.point.y - offset).abs() < 1e-14, "{hit:?}");
                assert_eq!(same.meeting, Meeting::Crossing, "{same:?}");
            }
        }
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
