//! Knot removal: the nearest spline with one knot less.
//!
//! Let `s` have multiplicity `μ`. The `n + 1 − μ` equations of knot insertion that involve `s`,
//! `c̃ₖ = γₖ cₖ + (1 − γₖ) cₖ₋₁` for `k = k₀ … k₁`, have one unknown less than equations. With the left null vector
//! `y` (`y` of `k₀` is 1, `yₖ₊₁ = −yₖ γₖ/(1 − γₖ₊₁)`) the knot can be removed exactly iff the residual
//! `v = Σ yₖ c̃ₖ − (1 − γ) c̃` of the left neighbour `− y γ c̃` of the right neighbour vanishes. Otherwise every affected
//! `c̃ₖ` is moved by `δ = |v|/Σ|yₖ|`, the smallest possible largest move, and the curve moves by at most `δ`.
//!
//! W. Tiller, *Knot-removal algorithms for NURBS curves and surfaces*, 1992. Course: section 6.3 and beyond.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::{Nurbs, deviation};

/// A spline with one knot less.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotRemoval<P> {
    /// The new spline.
    pub spline: Spline<P>,
    /// Upper bound of the distance to the old one at equal parameters, up to rounding; 0 if the knot was superfluous.
    pub deviation: f64,
    /// The null vector `y` of the head of this file; empty for a period too short for it, where least squares take its place.
    pub null_vector: Vec<f64>,
}

/// A NURBS with one knot less.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsKnotRemoval<P: Projective> {
    /// The new curve.
    pub curve: Nurbs<P>,
    /// Upper bound of the distance to the old one at equal parameters.
    pub deviation: f64,
}

impl<P: Point> Spline<P> {
    /// Removes one copy of the inner knot `at`, any knot of the period if periodic (reduced into it first).
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` for an end of D or a parameter outside; `NoSolution` if `at` is not a knot or
    /// the only knot of a period; the errors of [`SplineSpace::new`] if the remaining knots are not regular.
    pub fn remove_knot(&self, at: f64) -> Result<KnotRemoval<P>, SplineError> {
        let space = self.space();
        let (left, right) = space.parameter_interval();
        let mut at = space.reduce(at)?;
        if space.is_periodic() {
            at = if at >= right { left } else { at };
        } else if at <= left || at >= right {
            return Err(SplineError::OutsideInterval { value: at, left, right });
        }
        let knots = space.knots();
        let first = knots.partition_point(|&knot| knot < at);
        let after = knots.partition_point(|&knot| knot <= at);
        if first == after {
            return Err(SplineError::NoSolution { reason: format!("{at} is not a knot") });
        }
        match space.period() {
            None => {
                let mut coefficients = self.coefficients().to_vec();
                let mut knots = knots.to_vec();
                let (deviation, null_vector) =
                    remove_open(self.degree(), &mut knots, &mut coefficients, after - 1);
                let space = SplineSpace::new(self.degree(), knots)?;
                Ok(KnotRemoval { spline: Self::new(space, coefficients)?, deviation, null_vector })
            }
            Some(period) => self.remove_periodic(after - 1, period),
        }
    }

    /// Whether one copy of the knot `at` can go with the spline moving by at most `tolerance`.
    ///
    /// # Errors
    ///
    /// As [`Self::remove_knot`]; `InvalidTolerance` for a negative one.
    pub fn is_removable(&self, at: f64, tolerance: f64) -> Result<bool, SplineError> {
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        Ok(self.remove_knot(at)?.deviation <= tolerance)
    }

    fn remove_periodic(&self, index: usize, period: f64) -> Result<KnotRemoval<P>, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let count = space.dimension();
        if count == 1 {
            let reason = "the only knot of a period cannot be removed".to_owned();
            return Err(SplineError::NoSolution { reason });
        }
        let mut knots = space.knots().to_vec();
        knots.remove(index);
        let smaller = SplineSpace::periodic(n, period, knots)?;
        if count < n + 3 {
            return self.remove_from_short_period(smaller, index);
        }
        // Far enough from itself around the period: the open rule on a stretch of indices around the knot.
        let (low, high) = (index as isize - n as isize - 1, index as isize + n as isize + 2);
        let mut stretch: Vec<f64> = (low..=high).filter_map(|k| space.knot(k)).collect();
        let at = |k: isize| k.rem_euclid(count as isize) as usize;
        let mut local: Vec<P> = (low..=index as isize + 1).map(|k| self.coefficients()[at(k)]).collect();
        let (deviation, null_vector) = remove_open(n, &mut stretch, &mut local, n + 1);
        // In the period that starts with the stretch, coefficients beyond it move down by one index.
        let mut coefficients = self.coefficients().to_vec();
        coefficients.truncate(count - 1);
        for j in 0..count - 1 {
            let k = low + j as isize;
            let new = local.get(j).copied().unwrap_or_else(|| self.coefficients()[at(k + 1)]);
            coefficients[k.rem_euclid(count as isize - 1) as usize] = new;
        }
        Ok(KnotRemoval { spline: Self::new(smaller, coefficients)?, deviation, null_vector })
    }

    /// Least squares in the coefficients, for periods in which the affected coefficients meet themselves.
    fn remove_from_short_period(
        &self,
        smaller: SplineSpace,
        index: usize,
    ) -> Result<KnotRemoval<P>, SplineError> {
        let at = self.space().knots()[index];
        let mut target = self.coefficients().to_vec();
        if index == 0 {
            // Without a simple ξ₀ the period starts at ξ₁, and ξ₀ + T is its last knot.
            target.rotate_left(1);
        }
        let unknowns = smaller.dimension();
        let mut columns = Vec::with_capacity(unknowns);
        for j in 0..unknowns {
            let unit = (0..unknowns).map(|k| f64::from(k == j)).collect();
            columns.push(Spline::new(smaller.clone(), unit)?.insert_knot(at)?.into_parts().1);
        }
        let coefficients = least_squares(columns, &target);
        let spline = Self::new(smaller, coefficients)?;
        let again = spline.insert_knot(at)?;
        let pairs = again.coefficients().iter().zip(&target);
        let deviation: f64 = pairs.map(|(&a, &b)| (a - b).norm()).fold(0.0, f64::max);
        Ok(KnotRemoval { spline, deviation, null_vector: Vec::new() })
    }
}

impl<P: Projective> Nurbs<P> {
    /// As [`Spline::remove_knot`], in homogeneous coordinates; the deviation is that of the curves in space.
    ///
    /// # Errors
    ///
    /// As [`Spline::remove_knot`]; `WeightNotPositive` if no positive weights remain.
    pub fn remove_knot(&self, at: f64) -> Result<NurbsKnotRemoval<P>, SplineError> {
        if self.is_polynomial() {
            let KnotRemoval { spline, deviation, .. } = self.without_weights().remove_knot(at)?;
            let (space, points) = spline.into_parts();
            let weights = vec![self.weights()[0]; points.len()];
            return Ok(NurbsKnotRemoval { curve: Self::new(space, points, weights)?, deviation });
        }
        let remove = |spline: &Spline<P::Homogeneous>| spline.remove_knot(at).map(|removal| removal.spline);
        let curve = self.mapped(|spline| Ok(spline.remove_knot(at)?.spline), remove)?;
        let deviation = deviation(self, &curve)?.upper;
        Ok(NurbsKnotRemoval { curve, deviation })
    }
}

/// What the removal of one knot of an open sequence does to the coefficients.
pub(super) struct Step<P> {
    /// The coefficients `first … first + null_vector.len() − 1` give way to `inner`, one fewer.
    pub(super) first: usize,
    pub(super) inner: Vec<P>,
    /// `y`.
    pub(super) null_vector: Vec<f64>,
    /// `δ`.
    pub(super) deviation: f64,
}

/// The removal of the inner knot with index `last`, the last copy of its value.
pub(super) fn removal_step<P: Point>(n: usize, knots: &[f64], coefficients: &[P], last: usize) -> Step<P> {
    let s = knots[last];
    let multiplicity = knots[..=last].iter().rev().take_while(|&&knot| knot >= s).count();
    // Of the remaining knots, the last one at or below s is number last − 1.
    let remaining = |k: usize| knots[if k < last { k } else { k + 1 }];
    let (k0, k1) = (last - n, last - multiplicity);
    let gamma: Vec<f64> = (k0..=k1).map(|k| (s - remaining(k)) / (remaining(k + n) - remaining(k))).collect();
    let mut y = vec![1.0];
    for j in 1..gamma.len() {
        y.push(-y[j - 1] * gamma[j - 1] / (1.0 - gamma[j]));
    }
    let (before, behind) = (coefficients[k0 - 1], coefficients[k1 + 1]);
    let end = gamma.len() - 1;
    // Differences to the left neighbour keep the residual independent of a translation.
    let mut residual = P::ZERO;
    for (j, &factor) in y.iter().enumerate() {
        residual = residual + (coefficients[k0 + j] - before) * factor;
    }
    residual = residual - (behind - before) * (y[end] * gamma[end]);
    let total: f64 = y.iter().map(|factor| factor.abs()).sum();
    let step = residual * total.recip();
    let moved: Vec<P> =
        y.iter().enumerate().map(|(j, factor)| coefficients[k0 + j] - step * factor.signum()).collect();
    // From the left while γ ≥ 1/2, from the right beyond: no division by a small number. γ decreases.
    let mut inner = vec![P::ZERO; end];
    let from_left = gamma[..end].iter().take_while(|&&gamma| gamma >= 0.5).count();
    for j in 0..from_left {
        let previous = if j == 0 { before } else { inner[j - 1] };
        inner[j] = previous + (moved[j] - previous) * gamma[j].recip();
    }
    for j in (from_left..end).rev() {
        let next = if j + 1 == end { behind } else { inner[j + 1] };
        inner[j] = next + (moved[j + 1] - next) * (1.0 - gamma[j + 1]).recip();
    }
    Step { first: k0, inner, null_vector: y, deviation: step.norm() }
}

/// Removes the knot with index `last`, the last copy of its value; returns the deviation and the null vector.
fn remove_open<P: Point>(
    n: usize,
    knots: &mut Vec<f64>,
    coefficients: &mut Vec<P>,
    last: usize,
) -> (f64, Vec<f64>) {
    let Step { first, inner, null_vector, deviation } = removal_step(n, knots, coefficients, last);
    coefficients.splice(first..first + null_vector.len(), inner);
    knots.remove(last);
    (deviation, null_vector)
}

/// `x` with least `|Σ columns[j]·x[j] − right|`, by modified Gram-Schmidt with the right side as last column.
///
/// The columns are linearly independent: they describe a spline space inside a larger one.
fn least_squares<P: Point>(mut columns: Vec<Vec<f64>>, right: &[P]) -> Vec<P> {
    let count = columns.len();
    let mut triangle = vec![vec![0.0; count]; count];
    let mut rest = right.to_vec();
    let mut projected = vec![P::ZERO; count];
    for j in 0..count {
        let length = columns[j].iter().map(|a| a * a).sum::<f64>().sqrt();
        triangle[j][j] = length;
        let unit: Vec<f64> = columns[j].iter().map(|a| a / length).collect();
        for k in j + 1..count {
            let share: f64 = unit.iter().zip(&columns[k]).map(|(a, b)| a * b).sum();
            triangle[j][k] = share;
            columns[k].iter_mut().zip(&unit).for_each(|(b, a)| *b -= share * a);
        }
        projected[j] = rest.iter().zip(&unit).fold(P::ZERO, |sum, (&b, &a)| sum + b * a);
        rest.iter_mut().zip(&unit).for_each(|(b, &a)| *b = *b - projected[j] * a);
    }
    for j in (0..count).rev() {
        for k in j + 1..count {
            projected[j] = projected[j] - projected[k] * triangle[j][k];
        }
        projected[j] = projected[j] * triangle[j][j].recip();
    }
    projected
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::{any_spline, distance};
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_move_is_the_smallest_possible_largest_one(spline in any_spline(1..=7), choice in 0_usize..30) {
            let spline = spline.unroll().unwrap();
            let (left, right) = spline.space().parameter_interval();
            let inner: Vec<f64> = spline.space().breaks().into_iter().filter(|&s| left < s && s < right).collect();
            if inner.is_empty() {
                return Ok(());
            }
            let s = inner[choice % inner.len()];
            let removal = spline.remove_knot(s).unwrap();
            let again = removal.spline.insert_knot(s).unwrap();
            let moves: Vec<f64> = again.coefficients().iter().zip(spline.coefficients()).map(|(a, b)| a.distance(*b)).collect();
            let largest = moves.iter().copied().fold(0.0, f64::max);
            // All affected coefficients move equally far. By duality no splines without s is nearer: the null vector y annihilates all
            // of them, so that any move m has Σ y m = residual and |m| ≥ |residual|/Σ|y| = δ.
            prop_assert!((largest - removal.deviation).abs() < 1e-9 * removal.deviation.max(1.0), "{largest}, {}", removal.deviation);
            let count = moves.iter().filter(|&&m| (m - removal.deviation).abs() < 1e-8 * removal.deviation.max(1.0)).count();
            prop_assert!(count >= removal.null_vector.len(), "{moves:?}");
        }

        #[test]
        fn removal_scales_with_the_curve_and_moves_with_it(spline in any_spline(2..=6), choice in 0_usize..30, factor in 0.1..8.0_f64) {
            let knots = spline.space().distinct_knots();
            let s = knots[choice % knots.len()].value;
            let Ok(removal) = spline.remove_knot(s) else { return Ok(()) };
            let map = |p: DVec2| p * factor + DVec2::new(-3.0, 7.0);
            let moved = Spline::new(spline.space().clone(), spline.coefficients().iter().map(|&p| map(p)).collect()).unwrap();
            let other = moved.remove_knot(s).unwrap();
            prop_assert!((other.deviation - removal.deviation * factor).abs() < 1e-9 * factor.max(1.0), "{} {}", other.deviation, removal.deviation);
            let curve = |spline: &Spline<DVec2>| Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap();
            let expected = curve(&removal.spline).transformed(map).unwrap();
            let off = distance(&curve(&other.spline), &expected);
            prop_assert!(off < 1e-8 * factor.max(1.0), "off by {off}");
        }
    }

    fn refined_course_curve(fourth: DVec2) -> Spline<DVec2> {
        let knots = vec![1.0, 2.0, 2.0, 2.0, 3.0, 4.0, 5.0, 5.0, 8.0, 9.0, 10.0, 11.0];
        let points = [[0, 2], [4, 1], [4, 3], [2, 4], [1, 5], [1, 9], [5, 8], [4, 6]];
        let mut points = points.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        points[3] = fourth;
        Spline::new(SplineSpace::new(3, knots).unwrap(), points.to_vec()).unwrap()
    }

    #[test]
    fn a_superfluous_knot_leaves_the_curve_alone() {
        let removal = refined_course_curve(DVec2::new(2.0, 4.0)).remove_knot(4.0).unwrap();
        assert!(removal.deviation < 1e-14, "deviation {}", removal.deviation);
        let expected = [[0, 2], [4, 1], [4, 4], [1, 4], [1, 9], [5, 8], [4, 6]];
        for (k, [x, y]) in expected.into_iter().enumerate() {
            let error = (removal.spline.coefficients()[k] - DVec2::new(f64::from(x), f64::from(y))).length();
            assert!(error < 1e-13, "point {k} is off by {error}");
        }
    }

    #[test]
    fn the_deviation_is_the_smallest_possible_and_bounds_the_curves() {
        let spline = refined_course_curve(DVec2::new(2.0, 4.5));
        let removal = spline.remove_knot(4.0).unwrap();
        assert!((removal.deviation - 3.0 / 14.0).abs() < 1e-14, "deviation {}", removal.deviation);
        for i in 0..=60 {
            let t = 2.0 + 0.1 * f64::from(i);
            let distance = (removal.spline.evaluate(t).unwrap() - spline.evaluate(t).unwrap()).length();
            assert!(distance <= removal.deviation + 1e-14, "t = {t}: {distance}");
        }
    }

    #[test]
    fn ends_and_other_parameters_are_refused() {
        let spline = refined_course_curve(DVec2::new(2.0, 4.0));
        assert_eq!(spline.remove_knot(2.0).unwrap_err().name(), "OutsideInterval", "left end");
        assert_eq!(spline.remove_knot(8.0).unwrap_err().name(), "OutsideInterval", "right end");
        assert_eq!(spline.remove_knot(4.5).unwrap_err().name(), "NoSolution", "no knot");
        let space = SplineSpace::periodic(2, 1.0, vec![0.0]).unwrap();
        let point = Spline::new(space, vec![1.0]).unwrap();
        assert_eq!(point.remove_knot(0.0).unwrap_err().name(), "NoSolution", "one knot stays");
    }

    #[test]
    fn insert_then_remove_is_the_identity_on_closed_splines() {
        for (degree, count) in [(2, 3), (3, 4), (3, 1), (3, 9), (5, 12), (4, 6), (2, 5)] {
            let knots: Vec<f64> = (0..count).map(f64::from).collect();
            let coefficients: Vec<f64> = knots.iter().map(|k| (1.7 * k).sin() * 3.0).collect();
            let period = f64::from(count);
            let space = SplineSpace::periodic(degree, period, knots.clone()).unwrap();
            let spline = Spline::new(space, coefficients).unwrap();
            for s in [0.0, 0.25, 0.5 * period, period - 0.5, period - 1.0] {
                let removal = spline.insert_knot(s).unwrap().remove_knot(s).unwrap();
                assert!(removal.deviation < 1e-12, "degree {degree}, {count}: {}", removal.deviation);
                assert_eq!(removal.spline.space(), spline.space(), "the old knots");
                for (a, b) in removal.spline.coefficients().iter().zip(spline.coefficients()) {
                    assert!((a - b).abs() < 1e-11, "degree {degree}, {count} knots, s = {s}: {a} and {b}");
                }
            }
            // Removing a real knot: the bound holds, also for the first knot of the period.
            for s in knots.iter().copied().filter(|_| count > 1) {
                let removal = spline.remove_knot(s).unwrap();
                for i in 0..100 {
                    let t = period * f64::from(i) / 100.0;
                    let distance = (removal.spline.evaluate(t).unwrap() - spline.evaluate(t).unwrap()).abs();
                    let bound = removal.deviation + 1e-12;
                    assert!(
                        distance <= bound,
                        "degree {degree}, {count}, s = {s}, t = {t}: {distance} > {bound}"
                    );
                }
            }
        }
    }
}
