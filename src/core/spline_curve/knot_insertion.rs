//! Knot insertion: the same curve over more knots.
//!
//! Boehm's rule for a new knot `s ∈ [ξₗ, ξₗ₊₁)`:
//!
//! ```text
//! c̃ₖ = cₖ                         if ξₖ₊ₙ ≤ s,
//! c̃ₖ = γ cₖ + (1 − γ) cₖ₋₁        if ξₖ < s < ξₖ₊ₙ,   γ = (s − ξₖ)/(ξₖ₊ₙ − ξₖ),
//! c̃ₖ = cₖ₋₁                       if s ≤ ξₖ.
//! ```
//!
//! A new knot at an end of D makes a B-spline without influence on D; it is dropped with its outermost knot, so that
//! the dimension stays and the ends of D become more interpolating. Coefficients that the rule copies are copied bit by bit.
//!
//! W. Boehm, *Inserting new knots into B-spline curves*, 1980. Course: section 6.3.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// So many old knots are looked at together.
const AHEAD: usize = 4;

impl<P: Point> Spline<P> {
    /// The same spline with one more copy of the knot `at`; a periodic space reduces `at` into its period first.
    ///
    /// At an end of D of an open space the number of coefficients stays, see the head of this file.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`, `KnotMultiplicityTooHigh` if `at` already stands there `n` times.
    pub fn insert_knot(&self, at: f64) -> Result<Self, SplineError> {
        self.insert_knots(&[at])
    }

    /// The same spline with one more copy of every knot of `new`, in any order, repeated values allowed.
    ///
    /// Takes time proportional to the number of coefficients and new knots.
    ///
    /// # Errors
    ///
    /// As [`Self::insert_knot`], for the first of `new` that cannot be inserted.
    pub fn insert_knots(&self, new: &[f64]) -> Result<Self, SplineError> {
        let space = self.space();
        let (left, right) = space.parameter_interval();
        let sorted = sorted_in(space, new)?;
        if sorted.is_empty() {
            return Ok(self.clone());
        }
        match space.period() {
            Some(period) => {
                check_multiplicities(space, &sorted)?;
                self.insert_periodic(&sorted, period)
            }
            None => {
                let (n, m) = (self.degree(), space.dimension());
                // Knots pushed out of the sequence could hide that they are too many.
                if sorted[0] <= left || sorted[sorted.len() - 1] >= right {
                    check_multiplicities(space, &sorted)?;
                }
                let (knots, coefficients) = insert_open(n, space.knots(), self.coefficients(), &sorted);
                debug_assert!(coefficients.len() >= m, "insertion never loses coefficients");
                let refined = SplineSpace::new(n, knots)
                    .or_else(|error| check_multiplicities(space, &sorted).and(Err(error)))?;
                Self::new(refined, coefficients)
            }
        }
    }

    /// The same spline with a new knot in the middle of every nonempty knot interval of D.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`] if intervals are too small to be halved in `f64`.
    pub fn refine_uniformly(&self) -> Result<Self, SplineError> {
        let breaks = self.space().breaks();
        let middles: Vec<f64> = breaks.windows(2).map(|pair| pair[0] + 0.5 * (pair[1] - pair[0])).collect();
        self.insert_knots(&middles)
    }

    fn insert_periodic(&self, sorted: &[f64], period: f64) -> Result<Self, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let count = space.dimension() as isize;
        // One period with enough neighbours: the new coefficients of one period only see knots and coefficients
        // with indices −n−1 … M+2n+2, and the periodic copies of the new knots to the right of ξ₀.
        let first = -(n as isize) - 1;
        let last = count + 2 * n as isize + 2;
        let knots: Vec<f64> = (first..=last).filter_map(|k| space.knot(k)).collect();
        let coefficients: Vec<P> =
            (first..last - n as isize).map(|k| self.coefficients()[k.rem_euclid(count) as usize]).collect();
        let end = space.knot(count + n as isize + 1).unwrap_or(f64::INFINITY);
        let copies: Vec<f64> = (0..)
            .map(|turn| period * f64::from(turn))
            .take_while(|shift| sorted[0] + shift < end)
            .flat_map(|shift| sorted.iter().map(move |s| s + shift))
            .filter(|&s| s < end)
            .collect();
        let (knots, coefficients) = insert_sorted(n, &knots, &coefficients, &copies);
        let start = first.unsigned_abs();
        let range = start..start + space.dimension() + sorted.len();
        let space = SplineSpace::periodic(n, period, knots[range.clone()].to_vec())?;
        Self::new(space, coefficients[range].to_vec())
    }
}

impl<P: Projective> Nurbs<P> {
    /// As [`Spline::insert_knot`]; points and weights that stay are kept bit by bit.
    ///
    /// # Errors
    ///
    /// As [`Spline::insert_knot`].
    pub fn insert_knot(&self, at: f64) -> Result<Self, SplineError> {
        self.insert_knots(&[at])
    }

    /// As [`Spline::insert_knots`].
    ///
    /// # Errors
    ///
    /// As [`Spline::insert_knot`].
    pub fn insert_knots(&self, new: &[f64]) -> Result<Self, SplineError> {
        self.mapped(|spline| spline.insert_knots(new), |spline| spline.insert_knots(new))
    }

    /// As [`Spline::refine_uniformly`].
    ///
    /// # Errors
    ///
    /// As [`Spline::refine_uniformly`].
    pub fn refine_uniformly(&self) -> Result<Self, SplineError> {
        self.mapped(Spline::refine_uniformly, Spline::refine_uniformly)
    }
}

fn check_multiplicities(space: &SplineSpace, sorted: &[f64]) -> Result<(), SplineError> {
    let (knots, degree) = (space.knots(), space.degree());
    let mut copies = 0;
    for (i, &value) in sorted.iter().enumerate() {
        copies = if i > 0 && sorted[i - 1] >= value { copies + 1 } else { 1 };
        let index = knots.partition_point(|&knot| knot < value);
        let present = knots[index..].iter().take_while(|&&knot| knot <= value).count();
        let multiplicity = present + copies;
        if multiplicity > degree {
            return Err(SplineError::KnotMultiplicityTooHigh { index, value, multiplicity, degree });
        }
    }
    Ok(())
}

/// Inserts `sorted` into an open sequence and drops what the copies at the ends of D push out of it.
pub(super) fn insert_open<P: Point>(
    degree: usize,
    knots: &[f64],
    coefficients: &[P],
    sorted: &[f64],
) -> (Vec<f64>, Vec<P>) {
    let (left, right) = (knots[degree], knots[coefficients.len()]);
    let (mut knots, mut coefficients) = insert_sorted(degree, knots, coefficients, sorted);
    let at_left = sorted.iter().take_while(|&&s| s <= left).count();
    let at_right = sorted.iter().rev().take_while(|&&s| s >= right).count();
    knots.truncate(knots.len() - at_right);
    coefficients.truncate(coefficients.len() - at_right);
    if at_left > 0 {
        knots.drain(..at_left);
        coefficients.drain(..at_left);
    }
    (knots, coefficients)
}

/// Boehm's rule for increasing new knots, in one pass from left to right.
///
/// `knots[k]` starts the support of `coefficients[k]`; every new knot lies in `[knots[degree], knots[coefficients.len()]]`.
fn insert_sorted<P: Point>(
    degree: usize,
    knots: &[f64],
    coefficients: &[P],
    new: &[f64],
) -> (Vec<f64>, Vec<P>) {
    // With the degree a constant, the loop over the new coefficients is unrolled.
    match degree {
        1 => insertion_pass(1, knots, coefficients, new),
        2 => insertion_pass(2, knots, coefficients, new),
        3 => insertion_pass(3, knots, coefficients, new),
        4 => insertion_pass(4, knots, coefficients, new),
        5 => insertion_pass(5, knots, coefficients, new),
        _ => insertion_pass(degree, knots, coefficients, new),
    }
}

/// The same in place: old knots and coefficients wait at the end of the new lists, with the same indices in both.
///
/// Behind the right end of D, where there are fewer coefficients than knots, zeros and infinity stand for what is missing; γ is 0 there.
#[inline(always)]
fn insertion_pass<P: Point>(n: usize, knots: &[f64], coefficients: &[P], new: &[f64]) -> (Vec<f64>, Vec<P>) {
    let wait = new.len() + AHEAD;
    let len = wait + knots.len() + n.max(AHEAD);
    let (mut done_knots, mut done) = (Vec::with_capacity(len), Vec::with_capacity(len));
    done_knots.resize(wait, 0.0);
    done_knots.extend_from_slice(knots);
    done_knots.resize(len, f64::INFINITY);
    done.resize(wait, P::ZERO);
    done.extend_from_slice(coefficients);
    done.resize(len, P::ZERO);
    let mut place = 0;
    for (j, &s) in new.iter().enumerate() {
        // Old knots up to s and their coefficients: so many at once, all compared, because the processor cannot guess how many there are.
        let ahead = wait - j;
        loop {
            let old = place + ahead..place + ahead + AHEAD;
            let passed: usize = done_knots[old.clone()].iter().map(|&knot| usize::from(knot <= s)).sum();
            done_knots.copy_within(old.clone(), place);
            done.copy_within(old, place);
            place += passed;
            if passed < AHEAD {
                break;
            }
        }
        // The n knots up to s and the n knots behind it; the coefficients in between change. At copies of s itself γ is 0,
        // which moves a coefficient up unchanged.
        let (before, behind) = (&done_knots[place - n..place], &done_knots[place + ahead..][..n]);
        let local = &mut done[place - n - 1..=place];
        local[n + 1] = local[n];
        for i in (0..n).rev() {
            let gamma = (s - before[i]) / (behind[i] - before[i]);
            local[i + 1] = local[i].mix(local[i + 1], gamma);
        }
        done_knots[place] = s;
        place += 1;
    }
    done_knots.copy_within(place + AHEAD.., place);
    done_knots.truncate(knots.len() + new.len());
    done.copy_within(place + AHEAD.., place);
    done.truncate(coefficients.len() + new.len());
    (done_knots, done)
}

/// The new knots in increasing order, in the period if there is one.
fn sorted_in(space: &SplineSpace, new: &[f64]) -> Result<Vec<f64>, SplineError> {
    let (left, right) = space.parameter_interval();
    // Mostly they are what they should be; without an early exit that is seen in vector registers.
    let mut sorted = if new.iter().fold(true, |inside, &at| inside & (left <= at) & (at < right)) {
        new.to_vec()
    } else {
        let in_period = |at: f64| if space.is_periodic() && at >= right { left } else { at };
        new.iter().map(|&at| space.reduce(at).map(in_period)).collect::<Result<_, _>>()?
    };
    if !sorted.windows(2).fold(true, |sorted, pair| sorted & (pair[0] <= pair[1])) {
        sorted.sort_by(f64::total_cmp);
    }
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::Side;
    use crate::core::spline_curve::samples::{any_curve, any_spline, distance};
    use glam::DVec2;
    use proptest::prelude::*;

    fn course_curve() -> Spline<DVec2> {
        let knots = vec![1.0, 2.0, 2.0, 2.0, 3.0, 5.0, 5.0, 8.0, 9.0, 10.0, 11.0];
        let points = [[0, 2], [4, 1], [4, 4], [1, 4], [1, 9], [5, 8], [4, 6]];
        let points = points.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        Spline::new(SplineSpace::new(3, knots).unwrap(), points.to_vec()).unwrap()
    }

    proptest! {
        #[test]
        fn curves_of_every_kind_stay_and_the_order_does_not_matter(
            curve in any_curve(1..=25), shares in prop::collection::vec(0.0..1.0_f64, 1..6), at_knots in any::<bool>(),
        ) {
            let (left, right) = curve.space().parameter_interval();
            let place = |share: &f64| {
                let t = left.mix(right, *share);
                if at_knots { t.round().clamp(left, right) } else { t }
            };
            let new: Vec<f64> = shares.iter().map(place).collect();
            let reversed: Vec<f64> = new.iter().rev().copied().collect();
            let refined = match curve.insert_knots(&new) {
                Ok(refined) => refined,
                Err(error) => {
                    prop_assert_eq!(error.name(), "KnotMultiplicityTooHigh", "only full knots refuse");
                    return Ok(());
                }
            };
            prop_assert!(distance(&curve, &refined) < 1e-12, "new {new:?}: off by {}", distance(&curve, &refined));
            let other = curve.insert_knots(&reversed).unwrap();
            prop_assert_eq!(&other, &refined, "the order of the list");
            let stepwise = new.iter().fold(curve, |curve, &s| curve.insert_knot(s).unwrap());
            prop_assert_eq!(stepwise.space(), refined.space(), "one after the other");
            for (a, b) in stepwise.points().iter().zip(refined.points()) {
                prop_assert!(a.distance(*b) < 1e-11, "one after the other: {a} and {b}");
            }
        }

        #[test]
        fn many_knots_in_long_splines_keep_the_values(
            degree in 1_usize..7, gaps in prop::collection::vec(0.1..2.0_f64, 20..60), parts in prop::collection::vec(0.0..=1.0_f64, 1..80),
        ) {
            let mut at = 0.0;
            let knots: Vec<f64> = gaps.iter().map(|gap| { at += gap; at }).collect();
            let space = SplineSpace::new(degree, knots.clone()).unwrap();
            let points = (0..space.dimension()).map(|k| DVec2::new((1.7 * k as f64).sin(), (2.9 * k as f64).cos()));
            let spline = Spline::new(space.clone(), points.collect()).unwrap();
            let (left, right) = space.parameter_interval();
            // Squares crowd at the left end, so that some intervals get many knots and others none.
            let new: Vec<f64> = parts.iter().map(|part| left.mix(right, part * part).clamp(left, right)).collect();
            prop_assume!(degree > 1 || new.iter().all(|s| left < *s && *s < right));
            let refined = spline.insert_knots(&new).unwrap();
            let mut all = [knots, new.clone()].concat();
            all.sort_by(f64::total_cmp);
            let inner = |knots: &[f64]| knots.iter().copied().filter(|s| left < *s && *s < right).collect::<Vec<_>>();
            prop_assert_eq!(inner(refined.space().knots()), inner(&all), "the union of the knots");
            for i in 0..=100 {
                let t = left.mix(right, f64::from(i) / 100.0);
                let error = spline.evaluate(t).unwrap().distance(refined.evaluate(t).unwrap());
                prop_assert!(error < 1e-12, "t = {t}: off by {error}");
            }
        }

        #[test]
        fn derivatives_stay(spline in any_spline(2..=8), share in 0.0..1.0_f64, at in 0.01..0.99_f64) {
            let (left, right) = spline.space().parameter_interval();
            let Ok(refined) = spline.insert_knot(left.mix(right, share)) else { return Ok(()) };
            let t = left.mix(right, at);
            let (a, b) = (spline.derivatives(t, 3, Side::Right).unwrap(), refined.derivatives(t, 3, Side::Right).unwrap());
            for (order, (a, b)) in a.iter().zip(&b).enumerate() {
                prop_assert!(a.distance(*b) < 1e-9 * a.length().max(100.0), "order {order}: {a} and {b}");
            }
        }
    }

    #[test]
    fn the_course_example_gives_the_new_net() {
        let refined = course_curve().insert_knot(4.0).unwrap();
        let expected = [[0.0, 2.0], [4.0, 1.0], [4.0, 3.0], [2.0, 4.0], [1.0, 5.0], [1.0, 9.0]];
        for (k, [x, y]) in expected.into_iter().enumerate() {
            let error = (refined.coefficients()[k] - DVec2::new(x, y)).length();
            assert!(error < 1e-14, "point {k} is off by {error}");
        }
    }

    #[test]
    fn a_new_knot_keeps_the_curve_and_ends_keep_the_dimension() {
        let spline = course_curve();
        for s in [3.0, 4.0, 5.0, 7.5, 8.0, 8.0, 2.5] {
            let refined = spline.insert_knot(s).unwrap();
            let expected = if s < 8.0 { 8 } else { 7 };
            assert_eq!(refined.coefficients().len(), expected, "new knot {s}");
            for i in 0..=60 {
                let t = 2.0 + 0.1 * f64::from(i);
                let error = (refined.evaluate(t).unwrap() - spline.evaluate(t).unwrap()).length();
                assert!(error < 1e-13, "knot {s}, t = {t}: off by {error}");
            }
        }
        let clamped = spline.insert_knots(&[8.0, 8.0]).unwrap();
        assert_eq!(clamped.space().multiplicity(8.0), 3, "the right end is three-fold");
        assert_eq!(clamped.insert_knot(8.0).unwrap_err().name(), "KnotMultiplicityTooHigh", "a fourth copy");
        assert_eq!(spline.insert_knot(2.0).unwrap_err().name(), "KnotMultiplicityTooHigh", "left end");
        assert_eq!(spline.insert_knot(8.1).unwrap_err().name(), "OutsideInterval", "outside D");
    }

    #[test]
    fn periodic_insertion_keeps_the_curve_also_with_fewer_knots_than_the_degree() {
        for (degree, period, knots) in [
            (3, 4.0, vec![0.0, 1.0, 2.0, 3.0]),
            (3, 2.0, vec![0.0, 1.0]),
            (5, 1.0, vec![0.25]),
            (2, 6.0, vec![0.0, 0.0, 3.0, 5.0]),
            (4, 3.0, vec![-1.0, -1.0, 0.5]),
        ] {
            let coefficients: Vec<f64> = (0..knots.len()).map(|k| (3 * k * k) as f64 - 2.0).collect();
            let start = knots[0];
            let space = SplineSpace::periodic(degree, period, knots.clone()).unwrap();
            let spline = Spline::new(space, coefficients).unwrap();
            for s in [start, start + 0.3 * period, start + 0.5 * period, start + period, start - 2.2 * period]
            {
                let refined = match spline.insert_knot(s) {
                    Ok(refined) => refined,
                    Err(error) => {
                        assert_eq!(error.name(), "KnotMultiplicityTooHigh", "only full knots refuse");
                        continue;
                    }
                };
                assert_eq!(refined.coefficients().len(), knots.len() + 1, "one coefficient more");
                for i in 0..40 {
                    let t = start + period * f64::from(i) / 40.0;
                    let error = (refined.evaluate(t).unwrap() - spline.evaluate(t).unwrap()).abs();
                    assert!(error < 1e-12, "knots {knots:?}, new {s}, t = {t}: off by {error}");
                }
            }
        }
    }

    #[test]
    fn all_at_once_equals_one_after_the_other() {
        let spline = course_curve();
        let new = [4.0, 2.5, 4.0, 7.0, 8.0, 3.0];
        let at_once = spline.insert_knots(&new).unwrap();
        let mut stepwise = spline;
        for s in new {
            stepwise = stepwise.insert_knot(s).unwrap();
        }
        assert_eq!(at_once.space(), stepwise.space(), "the same knots");
        for (a, b) in at_once.coefficients().iter().zip(stepwise.coefficients()) {
            assert!((*a - *b).length() < 1e-13, "{a} and {b}");
        }
    }

    #[test]
    fn untouched_points_and_weights_of_a_nurbs_keep_their_bits() {
        let (space, points) = course_curve().into_parts();
        let weights = vec![0.1, 0.7, 1.3, 0.3, 2.0, 0.9, 1.1];
        let curve = Nurbs::new(space, points, weights).unwrap();
        let refined = curve.insert_knot(7.0).unwrap();
        assert_eq!(refined.weights()[..4], curve.weights()[..4], "the first weights");
        assert_eq!(refined.points()[..4], curve.points()[..4], "the first points");
        for i in 0..=60 {
            let t = 2.0 + 0.1 * f64::from(i);
            let error = (refined.evaluate(t).unwrap() - curve.evaluate(t).unwrap()).length();
            assert!(error < 1e-13, "t = {t}: off by {error}");
        }
        assert_eq!(curve.refine_uniformly().unwrap().points().len(), 10, "three intervals are halved");
    }
}
