//! The points of a curve closest to a given point.
//!
//! The boxes of the Bezier pieces stand in a [`BoundingTree`]: a piece whose box is further away than a point that is known is not looked at. In the others
//! the sign changes of the [foot polynomial](super::foot_polynomial) decide: without one only the ends count; one, from falling to growing distance, is a minimum that
//! Newton's method in a bracket finds; the zeros of all others are found together. A tree that is prepared once answers without allocation, but for pieces with
//! several sign changes. Course: beyond, section B.5.

use std::collections::BTreeMap;

use crate::core::bounding_tree::{BoundingBox, BoundingTree, BoundingTreeError};
use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::root_finding::{Zeros, bernstein_zeros, single_zero};
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::chord::Chord;
use crate::core::spline_curve::curve_intersection::check_tolerance;
use crate::core::spline_curve::foot_polynomial::FootPolynomial;
use crate::core::spline_curve::local_piece::{LocalPiece, dot};
use crate::core::spline_curve::piecewise_sign::PieceSigns;
use crate::core::triangular_scheme::collapse_both;

/// The coefficients of a foot polynomial: its degree is `3n − 2` at most.
const MAX_COEFFICIENTS: usize = 3 * MAX_DEGREE - 1;

/// How often a piece is halved to separate sign changes.
const HALVINGS: usize = 4;
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

/// A curve prepared for many questions about distances.
///
/// Memory is linear in the number of control points times the degree, the time of a question for a curve that does not fill the plane logarithmic in the
/// number of pieces.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::spline_curve::{ClosestPointTree, Nurbs};
///
/// let circle = ClosestPointTree::new(&Nurbs::circle(DVec2::ZERO, 1.0)?)?;
/// let nearest = circle.closest_point(DVec2::new(3.0, 4.0))?;
/// assert!((nearest.point - DVec2::new(0.6, 0.8)).length() < 1e-15);
/// assert!(circle.is_within(DVec2::new(3.0, 4.0), 4.1)?);
/// assert_eq!(circle.closest_points(DVec2::ZERO, 1e-9).unwrap_err().name(), "Degenerate");
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ClosestPointTree<P> {
    pub(super) pieces: Vec<(LocalPiece<P>, FootPolynomial<P>)>,
    chords: Vec<Chord<P>>,
    tree: BoundingTree<3>,
    pub(super) is_closed: bool,
}

/// The best place found: squared distance, piece, parameter in it.
#[derive(Clone, Copy)]
struct Best {
    squared: f64,
    piece: usize,
    at: f64,
}

impl<P: Projective> ClosestPointTree<P> {
    /// Prepares `curve`, in time `O(m log m)` for `m` control points.
    ///
    /// # Errors
    ///
    /// `NonFinite` where products of coordinates overflow.
    pub fn new(curve: &Nurbs<P>) -> Result<Self, SplineError> {
        let mut pieces = Vec::new();
        let (mut boxes, mut chords) = (Vec::new(), Vec::new());
        for (index, piece) in curve.local_pieces()?.into_iter().enumerate() {
            let overflow = SplineError::NonFinite { what: "size of piece", index, value: piece.extent };
            let foot = FootPolynomial::new(&piece);
            if !foot.is_finite() {
                return Err(overflow);
            }
            let weight = |j: usize| piece.weights.get(j).copied().unwrap_or(1.0);
            let points = piece
                .numerators
                .iter()
                .enumerate()
                .map(|(j, &p)| coordinates(p * weight(j).recip() + piece.origin));
            boxes.push(BoundingBox::of_points(points).map_err(|_| overflow)?);
            chords.push(Chord::of(&piece));
            pieces.push((piece, foot));
        }
        let tree = BoundingTree::new(&boxes).map_err(|error| match error {
            BoundingTreeError::StepLimit { value, limit } => {
                SplineError::StepLimit { what: "pieces", value, limit }
            }
            _ => SplineError::Empty { what: "pieces" },
        })?;
        Ok(Self { pieces, chords, tree, is_closed: curve.space().is_periodic() })
    }

    /// The point of the curve closest to `place`, of several one of them; the distance is exact up to rounding, also where the parameter is not, because the
    /// distance hardly changes.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `place` is not finite or the squared distance overflows.
    pub fn closest_point(&self, place: P) -> Result<ClosestPoint<P>, SplineError> {
        let best = self.search(place, f64::INFINITY, |_| false)?;
        let value = f64::INFINITY;
        let best = best.ok_or(SplineError::NonFinite { what: "squared distance", index: 0, value })?;
        Ok(self.place_at(best.piece, best.at, place))
    }

    /// Whether a point of the curve is nearer to `place` than `distance`; stops at the first one.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `place` is not finite or `distance` is not a number.
    pub fn is_within(&self, place: P, distance: f64) -> Result<bool, SplineError> {
        if distance.is_nan() {
            return Err(SplineError::NonFinite { what: "distance", index: 0, value: distance });
        }
        let limit = distance.max(0.0) * distance.max(0.0);
        Ok(self.search(place, limit, |squared| squared < limit)?.is_some())
    }

    /// All places at which the distance from `place` is locally smallest and within `tolerance` of the smallest, by parameter. The ends of an open curve count, the seam
    /// of a closed one is none.
    ///
    /// # Errors
    ///
    /// `NonFinite` as [`Self::closest_point`]; `InvalidTolerance`; `Degenerate` if the distance is the smallest along a whole piece, as it is for the centre of a circle.
    pub fn closest_points(&self, place: P, tolerance: f64) -> Result<Vec<ClosestPoint<P>>, SplineError> {
        check_tolerance(tolerance)?;
        let limit = self.closest_point(place)?.distance + tolerance;
        let mut near = Vec::new();
        let squared = limit * limit * (1.0 + 4.0 * f64::EPSILON);
        self.tree.nearest(coordinates(place), squared, |piece, limit| {
            near.push(piece);
            limit
        });
        let mut signs: BTreeMap<usize, PieceSigns> = BTreeMap::new();
        let mut found = Vec::new();
        let take = |found: &mut Vec<ClosestPoint<P>>, piece: usize, at: f64| {
            let candidate = self.place_at(piece, at, place);
            if candidate.distance <= limit {
                found.push(candidate);
            }
        };
        let count = self.pieces.len();
        for piece in near {
            // The pieces before, here and behind; none beyond the ends of an open curve.
            let before =
                if self.is_closed { Some((piece + count - 1) % count) } else { piece.checked_sub(1) };
            let behind = if self.is_closed {
                Some((piece + 1) % count)
            } else {
                Some(piece + 1).filter(|&i| i < count)
            };
            let [before, here, behind] = [before, Some(piece), behind].map(|index| {
                index.map(|index| signs.entry(index).or_insert_with(|| self.signs(index, place)).clone())
            });
            let Some(here) = here else { continue };
            if here.is_zero() && self.place_at(piece, 0.5, place).distance <= limit {
                let parameter = self.pieces[piece].0.interval.0;
                return Err(SplineError::Degenerate {
                    what: "the closest point of a piece that begins",
                    parameter,
                });
            }
            for (at, ..) in here.zeros.iter().filter(|zero| zero.1 < 0 && zero.2 > 0) {
                take(&mut found, piece, *at);
            }
            // Not growing before, not falling behind.
            if here.ends[0] > 0 && before.is_none_or(|other| other.ends[1] < 0) {
                take(&mut found, piece, 0.0);
            }
            // The minimum at a joint is that of the piece behind it.
            if here.ends[1] < 0 && behind.is_none() {
                take(&mut found, piece, 1.0);
            } else if here.ends[1] < 0 && behind.is_some_and(|other| other.ends[0] > 0) {
                take(&mut found, (piece + 1) % count, 0.0);
            }
        }
        found.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
        found.dedup_by(|a, b| a.parameter == b.parameter);
        Ok(found)
    }

    /// The signs of the foot polynomial of a piece.
    pub(super) fn signs(&self, piece: usize, place: P) -> PieceSigns {
        let (local, foot) = &self.pieces[piece];
        let q = place - local.origin;
        let mut values = vec![0.0; foot.len()];
        foot.write(q, &mut values);
        PieceSigns::new(&values, foot.noise(q))
    }

    /// The place of a piece at `at` in `[0, 1]`.
    pub(super) fn place_at(&self, piece: usize, at: f64, place: P) -> ClosestPoint<P> {
        let local = &self.pieces[piece].0;
        let (a, b) = local.interval;
        let offset = local.offset_at(at);
        let distance = (offset - (place - local.origin)).norm();
        ClosestPoint { parameter: a.mix(b, at), point: local.origin + offset, distance }
    }

    /// The best place nearer than the square root of `limit`; ends early if `is_enough`.
    fn search(
        &self,
        place: P,
        limit: f64,
        is_enough: impl Fn(f64) -> bool,
    ) -> Result<Option<Best>, SplineError> {
        if !place.is_finite() {
            let value = (0..P::DIMENSION).map(|i| place.coordinate(i)).find(|value| !value.is_finite());
            return Err(SplineError::NonFinite { what: "place", index: 0, value: value.unwrap_or(f64::NAN) });
        }
        let mut best = Best { squared: limit, piece: usize::MAX, at: 0.0 };
        self.tree.nearest(coordinates(place), limit, |piece, _| {
            self.improve(&mut best, piece, place);
            // No key is below 0: nothing else is visited.
            if best.piece != usize::MAX && is_enough(best.squared) { 0.0 } else { best.squared }
        });
        Ok((best.piece != usize::MAX).then_some(best))
    }

    /// Looks for a nearer place in one piece.
    fn improve(&self, best: &mut Best, piece: usize, place: P) {
        let (local, foot) = &self.pieces[piece];
        let q = place - local.origin;
        if self.chords[piece].is_beyond(q, best.squared) {
            return;
        }
        let mut consider = |at: f64| {
            let away = local.offset_at(at) - q;
            let squared = dot(away, away);
            if squared < best.squared {
                *best = Best { squared, piece, at };
            }
        };
        let signs = SignChanges::of(foot.values(q));
        if signs.count == 0 {
            return consider(if signs.falls { 1.0 } else { 0.0 });
        }
        let mut buffer = [0.0; MAX_COEFFICIENTS];
        let values = &mut buffer[..foot.len()];
        foot.write(q, values);
        minima(values, foot.noise(q), [0.0, 1.0], HALVINGS, &mut consider);
    }
}

/// The sign changes of a list of numbers; 0 counts as positive.
struct SignChanges {
    count: usize,
    /// The index behind the last one.
    last: usize,
    /// Whether the first number is negative.
    falls: bool,
}

impl SignChanges {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut signs = Self { count: 0, last: 0, falls: false };
        let mut is_negative = false;
        for (k, value) in values.enumerate() {
            if k == 0 {
                is_negative = value < 0.0;
                signs.falls = is_negative;
            } else if (value < 0.0) != is_negative {
                is_negative = !is_negative;
                signs.count += 1;
                signs.last = k;
            }
        }
        signs
    }
}

/// Considers all places between `low` and `high` at which the distance can be smallest; `values`, overwritten, are the coefficients of its growth there. Several sign
/// changes are separated by halving, those that `halvings` of it leave together by the zeros of the polynomial.
fn minima(
    values: &mut [f64],
    noise: f64,
    [low, high]: [f64; 2],
    halvings: usize,
    consider: &mut impl FnMut(f64),
) {
    let signs = SignChanges::of(values.iter().copied());
    match (signs.count, signs.falls) {
        // The distance grows, falls, or grows up to a largest value.
        (0, false) => consider(low),
        (0, true) => consider(high),
        (1, false) => [low, high].into_iter().for_each(consider),
        (1, true) => consider(low.mix(high, single_zero(values, signs.last))),
        _ if halvings == 0 => {
            [low, high].into_iter().for_each(&mut *consider);
            if let Zeros::Isolated(zeros) = bernstein_zeros(values, noise) {
                zeros.iter().for_each(|zero| consider(low.mix(high, zero.at)));
            }
        }
        _ => {
            let mut buffer = [0.0; MAX_COEFFICIENTS];
            let left = &mut buffer[..values.len()];
            collapse_both(values, 0.5, left);
            let middle = 0.5 * (low + high);
            minima(left, noise, [low, middle], halvings - 1, consider);
            minima(values, noise, [middle, high], halvings - 1, consider);
        }
    }
}

impl<P: Projective> Nurbs<P> {
    /// The point of the curve closest to `place`. For many questions prepare a [`ClosestPointTree`].
    ///
    /// # Errors
    ///
    /// As [`ClosestPointTree::closest_point`].
    pub fn closest_point(&self, place: P) -> Result<ClosestPoint<P>, SplineError> {
        ClosestPointTree::new(self)?.closest_point(place)
    }

    /// All closest points of the curve, see [`ClosestPointTree::closest_points`].
    ///
    /// # Errors
    ///
    /// As [`ClosestPointTree::closest_points`].
    pub fn closest_points(&self, place: P, tolerance: f64) -> Result<Vec<ClosestPoint<P>>, SplineError> {
        ClosestPointTree::new(self)?.closest_points(place, tolerance)
    }
}

/// The coordinates, with zeros up to the third.
fn coordinates<P: Point>(point: P) -> [f64; 3] {
    [0, 1, 2].map(|i| if i < P::DIMENSION { point.coordinate(i) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::spline_curve::FootKind;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn the_minimum_is_that_of_samples_of_both_parts_and_of_the_raised_curve(
            curve in any_curve(1..=7), places in prop::array::uniform2(prop::array::uniform2(-12.0..12.0_f64).prop_map(DVec2::from)), share in 0.1..0.9_f64,
        ) {
            let tree = ClosestPointTree::new(&curve).unwrap();
            let (a, b) = curve.space().parameter_interval();
            let [one, other] = places.map(|place| tree.closest_point(place).unwrap().distance);
            prop_assert!((one - other).abs() <= places[0].distance(places[1]) + 1e-12, "distances are 1-Lipschitz");
            let place = places[0];
            let nearest = tree.closest_point(place).unwrap();
            for i in 0..=300 {
                let sampled = curve.evaluate(a.mix(b, f64::from(i) / 300.0)).unwrap().distance(place);
                prop_assert!(sampled >= one - 1e-12, "{sampled} beats {nearest:?}");
            }
            let on_curve = curve.evaluate(nearest.parameter).unwrap();
            prop_assert!(on_curve.distance(nearest.point) < 1e-10, "{on_curve} at {nearest:?}");
            prop_assert!(tree.is_within(place, one + 1e-9).unwrap() && !tree.is_within(place, one - 1e-9).unwrap(), "{one}");
            let rotate = |point: DVec2| DVec2::from_angle(0.8).rotate(point) + DVec2::new(3.0, -4.0);
            let image = Nurbs::new(curve.space().clone(), curve.points().iter().map(|&p| rotate(p)).collect(), curve.weights().to_vec()).unwrap();
            prop_assert!((image.closest_point(rotate(place)).unwrap().distance - one).abs() < 1e-11, "rigid motion");
            prop_assert!((curve.elevate_degree().unwrap().closest_point(place).unwrap().distance - one).abs() < 1e-9, "elevation");
            if let (false, Ok((left, right))) = (curve.space().is_periodic(), curve.split(a.mix(b, share))) {
                let parts = [left, right].map(|part| part.closest_point(place).unwrap().distance);
                prop_assert!((parts[0].min(parts[1]) - one).abs() < 1e-10, "{parts:?} and {one}");
            }
        }

        #[test]
        fn all_closest_points_are_local_minima_with_the_closest_among_them(
            curve in any_curve(2..=5), place in prop::array::uniform2(-9.0..9.0_f64).prop_map(DVec2::from), tolerance in 1e-9..3.0_f64,
        ) {
            let tree = ClosestPointTree::new(&curve).unwrap();
            let Ok(found) = tree.closest_points(place, tolerance) else { return Ok(()) };
            let nearest = tree.closest_point(place).unwrap();
            let least = found.iter().map(|hit| hit.distance).fold(f64::INFINITY, f64::min);
            prop_assert!((least - nearest.distance).abs() < 1e-9, "{found:?} without {nearest:?}");
            prop_assert!(found.windows(2).all(|pair| pair[0].parameter < pair[1].parameter), "{found:?}");
            let feet = tree.foot_points(place).unwrap();
            let minima = feet.iter().filter(|foot| foot.kind == FootKind::Minimum && foot.foot.distance <= nearest.distance + tolerance);
            let (a, b) = curve.space().parameter_interval();
            let inner = found.iter().filter(|hit| curve.space().is_periodic() || (a < hit.parameter && hit.parameter < b));
            prop_assert_eq!(inner.count(), minima.count(), "{:?} {:?}", found, feet);
        }
    }

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

    #[test]
    fn space_curves_functions_and_high_degrees() {
        let helix =
            |k: i32| DVec3::new((0.7 * f64::from(k)).cos(), (0.7 * f64::from(k)).sin(), 0.3 * f64::from(k));
        let space = SplineSpace::new(25, (0..60).map(f64::from).collect()).unwrap();
        let weights = (0..34).map(|k| 1.0 + 0.5 * f64::from(k % 2)).collect();
        let curve = Nurbs::new(space, (0..34).map(helix).collect(), weights).unwrap();
        let nearest = curve.closest_point(DVec3::new(0.2, 0.1, 5.0)).unwrap();
        for i in 0..=2000 {
            let point = curve.evaluate(25.0.mix(34.0, f64::from(i) / 2000.0)).unwrap();
            let sampled = point.distance(DVec3::new(0.2, 0.1, 5.0));
            assert!(sampled >= nearest.distance - 1e-12, "{sampled} beats {nearest:?}");
        }
        let square = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let square = Nurbs::polynomial(square, vec![1.0, -1.0, 1.0]).unwrap();
        let zeros = square.closest_points(0.25, 1e-9).unwrap();
        assert_eq!(
            zeros.iter().map(|zero| zero.parameter).collect::<Vec<_>>(),
            [0.25, 0.75],
            "(1 - 2t)^2 = 1/4"
        );
    }

    #[test]
    fn impossible_questions_are_refused() {
        let tree = ClosestPointTree::new(&circle()).unwrap();
        assert_eq!(tree.closest_point(DVec2::new(0.0, f64::NAN)).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(
            tree.closest_point(DVec2::splat(1e300)).unwrap_err().name(),
            "NonFinite",
            "the square overflows"
        );
        assert_eq!(tree.is_within(DVec2::ZERO, f64::NAN).unwrap_err().name(), "NonFinite", "no distance");
        assert_eq!(tree.is_within(DVec2::ZERO, -1.0), Ok(false), "nothing is nearer than 0");
        assert_eq!(tree.closest_points(DVec2::X, 0.0).unwrap_err().name(), "InvalidTolerance", "0");
        assert_eq!(tree.closest_points(DVec2::ZERO, 1e-9).unwrap_err().name(), "Degenerate", "the centre");
    }
}
