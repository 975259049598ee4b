//! A plane curve prepared for many questions about intersections.
//!
//! The boxes of its Bezier pieces, halved until they hardly turn, stand in a [`BoundingTree`]. Of each pair of pieces whose boxes come near, first the strips along the chords are compared; pieces whose
//! directions are apart cross [at most once](super::plane_piece); all others are handled as in [`RationalBezier::intersections`](crate::core::rational_bezier::RationalBezier).
//! Course: beyond, section B.6.

use glam::DVec2;

use crate::core::bounding_tree::{BoundingBox, BoundingTree, BoundingTreeError};
use crate::core::bspline::SplineError;
use crate::core::progress::{Unwatched, Watcher};
use crate::core::spline_curve::curve_intersection::{Merge, as_spline_error, check_tolerance};
use crate::core::spline_curve::plane_piece::{PlanePiece, gentle_parts};
use crate::core::spline_curve::{CurveIntersection, Meeting, Nurbs};

/// Pairs between two words to the watcher.
const WATCHED: usize = 64;
/// Half opening of the cone of directions of the parts in a tree, in radians.
const OPENING: f64 = 0.6;
/// How often pieces of a pair are halved; crossings that are not nearly tangential are then alone.
pub(super) const HALVINGS: usize = 6;

/// A curve with its pieces in a tree.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::spline_curve::{IntersectionTree, Nurbs};
///
/// let circle = IntersectionTree::new(&Nurbs::circle(DVec2::ZERO, 1.0)?)?;
/// for k in 1..4 {
///     let other = IntersectionTree::new(&Nurbs::circle(DVec2::new(0.5 * f64::from(k), 0.0), 1.0)?)?;
///     assert_eq!(circle.intersections(&other, 1e-10)?.len(), 2);
/// }
/// assert_eq!(circle.intersect_line(DVec2::Y, 0.5, 1e-12)?.len(), 2);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct IntersectionTree {
    pub(super) curve: Nurbs<DVec2>,
    pub(super) pieces: Vec<PlanePiece>,
    pub(super) tree: BoundingTree<2>,
}

impl IntersectionTree {
    /// Prepares `curve`, in time `O(m log m)` for `m` control points.
    ///
    /// # Errors
    ///
    /// `NonFinite` or `WeightNotPositive` where a Bezier form leaves the range of numbers.
    pub fn new(curve: &Nurbs<DVec2>) -> Result<Self, SplineError> {
        Self::of_pieces(curve, gentle_parts(curve, OPENING, 0.0)?)
    }

    /// The tree over the Bezier pieces as they are, for one question.
    pub(super) fn of_whole_pieces(curve: &Nurbs<DVec2>) -> Result<Self, SplineError> {
        let pieces = curve.rational_bezier_curves().map_err(as_spline_error)?;
        Self::of_pieces(curve, pieces.into_iter().map(PlanePiece::new).collect::<Result<_, _>>()?)
    }

    /// The tree over pieces that make the curve.
    pub(super) fn of_pieces(curve: &Nurbs<DVec2>, pieces: Vec<PlanePiece>) -> Result<Self, SplineError> {
        let boxes: Vec<BoundingBox<2>> = pieces.iter().map(|piece| piece.bounds).collect();
        let tree = BoundingTree::new(&boxes).map_err(|error| match error {
            BoundingTreeError::StepLimit { value, limit } => {
                SplineError::StepLimit { what: "pieces", value, limit }
            }
            _ => SplineError::Empty { what: "pieces" },
        })?;
        Ok(Self { curve: curve.clone(), pieces, tree })
    }

    /// All common points with `other`, see [`Nurbs::intersections`].
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` where a pair of pieces needs too many halvings.
    pub fn intersections(&self, other: &Self, tolerance: f64) -> Result<Vec<CurveIntersection>, SplineError> {
        self.intersections_watched(other, tolerance, &Unwatched)
    }

    /// As [`Self::intersections`]; `watcher` hears the part of the pairs that is done.
    ///
    /// # Errors
    ///
    /// As there; `Stopped`.
    pub fn intersections_watched(
        &self,
        other: &Self,
        tolerance: f64,
        watcher: &impl Watcher,
    ) -> Result<Vec<CurveIntersection>, SplineError> {
        check_tolerance(tolerance)?;
        let mut found = Vec::new();
        let pairs = self.pairs(other, tolerance);
        for (done, &(i, j)) in pairs.iter().enumerate() {
            if done % WATCHED == 0 {
                watcher.check(done as f64 / pairs.len() as f64)?;
            }
            meet(&self.pieces[i], &other.pieces[j], tolerance, HALVINGS, &mut found)?;
        }
        Ok(Merge { curves: [&self.curve, &other.curve], tolerance }.merged(found))
    }

    /// Indices of the pieces of both whose boxes are not further apart than `gap`.
    pub(super) fn pairs(&self, other: &Self, gap: f64) -> Vec<(usize, usize)> {
        let mut pairs = Vec::new();
        self.tree.pairs(&other.tree, gap, |i, j| pairs.push((i, j)));
        pairs
    }
}

/// Adds what two pieces have in common; those with parallel tangents are halved up to `halvings` times before they are handled in general.
pub(super) fn meet(
    p: &PlanePiece,
    q: &PlanePiece,
    tolerance: f64,
    halvings: usize,
    found: &mut Vec<CurveIntersection>,
) -> Result<(), SplineError> {
    if p.is_beside(q, tolerance) || q.is_beside(p, tolerance) {
        return Ok(());
    }
    if p.directions_differ(q) {
        if p.crosses(q, tolerance) == Some(false) {
            return Ok(());
        }
        if let Some((at, point)) = p.crossing(q, tolerance) {
            let parameters = [p.parameter(at[0]), q.parameter(at[1])];
            found.push(CurveIntersection { parameters, point, meeting: Meeting::Crossing });
            return Ok(());
        }
    }
    if halvings > 0 {
        let turns = p.size() >= q.size();
        for half in if turns { p } else { q }.halves()? {
            let (p, q) = if turns { (&half, q) } else { (p, &half) };
            meet(p, q, tolerance, halvings - 1, found)?;
        }
        return Ok(());
    }
    let hits = p.curve.intersections(&q.curve, tolerance).map_err(as_spline_error)?;
    found.extend(hits.into_iter().map(|hit| {
        let meeting = hit.contact.into();
        CurveIntersection { parameters: hit.parameters, point: hit.point, meeting }
    }));
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::spline_curve::samples::any_curve;

    #[test]
    fn a_watcher_hears_of_progress_and_stops_the_work() {
        let circle =
            |x: f64| IntersectionTree::new(&Nurbs::circle(DVec2::new(x, 0.0), 1.0).unwrap()).unwrap();
        let stopped = circle(0.0).intersections_watched(&circle(1.0), 1e-9, &|_: f64| false);
        assert_eq!(stopped.unwrap_err().name(), "Stopped", "at once");
        let found = circle(0.0).intersections_watched(&circle(1.0), 1e-9, &|part: f64| part < 1.0);
        assert_eq!(found.unwrap().len(), 2, "to the end");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn what_is_found_is_what_all_pairs_of_pieces_have_in_common(one in any_curve(1..=4), other in any_curve(1..=4)) {
            let trees = [&one, &other].map(|curve| IntersectionTree::new(curve).unwrap());
            let Ok(found) = trees[0].intersections(&trees[1], 1e-9) else { return Ok(()) };
            let mut slow = Vec::new();
            for p in &trees[0].pieces {
                for q in &trees[1].pieces {
                    slow.extend(p.curve.intersections(&q.curve, 1e-9).unwrap());
                }
            }
            for hit in &slow {
                let known = found.iter().any(|old| match old.meeting {
                    Meeting::Overlap { first, .. } => (first[0] - 1e-3..=first[1] + 1e-3).contains(&hit.parameters[0]),
                    _ => old.point.distance(hit.point) < 1e-3,
                });
                prop_assert!(known, "{hit:?} is not among {found:?}");
            }
            for hit in &found {
                let known = slow.iter().any(|old| old.point.distance(hit.point) < 1e-3);
                prop_assert!(known, "{hit:?} is not among {slow:?}");
            }
        }
    }
}
