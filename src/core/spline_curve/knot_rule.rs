//! Knots that follow from the control points.
//!
//! For `m` control points of degree `n` over the interval `[a, b]` that the curve has:
//!
//! | rule | open: inner knots | closed: one period |
//! |---|---|---|
//! | uniform | equal intervals, `n` simple knots outside on each side | equal intervals |
//! | end-interpolating | equal intervals, `n`-fold ends | equal intervals, `n`-fold seam |
//! | chord length, centripetal | lengths proportional to the mean of `\|cⱼ₊₁ − cⱼ\|ᵉ` over the legs of the active polygon, `e = 1` or `1/2` | the same |
//! | averaged | `ξⱼ = (tⱼ₋ₙ + … + tⱼ₋₁)/n` with sites `t` at the chord lengths of the polygon | the same |
//!
//! Rules that look at the control points give open curves `n`-fold ends. The averaged knots bring the Greville abscissa of `cₖ` near its
//! site `tₖ`, and interpolation at the sites is always possible with them.
//!
//! E. T. Y. Lee, *Choosing nodes in parametric curve interpolation*, 1989; C. de Boor, *A practical guide to splines*, 1978.

use crate::core::bspline::{EndKnots, SplineError, SplineSpace};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// How knots follow from the control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KnotRule {
    /// Equal distances, simple knots.
    Uniform,
    /// Equal distances, `n`-fold ends or an `n`-fold seam.
    EndInterpolating,
    /// Distances like those of the control points.
    ChordLength,
    /// Distances like the square roots of those of the control points.
    Centripetal,
    /// Averages of the chord lengths, so that Greville abscissae lie near them.
    Averaged,
}

impl KnotRule {
    /// All rules.
    pub const ALL: [Self; 5] =
        [Self::Uniform, Self::EndInterpolating, Self::ChordLength, Self::Centripetal, Self::Averaged];
}

impl<P: Projective> Nurbs<P> {
    /// The space of the same degree, dimension and parameter interval, or period, with the knots of `rule`.
    ///
    /// # Errors
    ///
    /// `NoSolution` if all control points coincide and the rule needs their distances; those of [`SplineSpace::new`] where many neighbours
    /// coincide, and of [`SplineSpace::periodic`] for an `n`-fold seam with `n` points or fewer.
    pub fn space_by_rule(&self, rule: KnotRule) -> Result<SplineSpace, SplineError> {
        let space = self.space();
        let (n, m) = (space.degree(), space.dimension());
        let (left, right) = space.parameter_interval();
        let lengths: Vec<f64> = match (rule, space.is_periodic()) {
            (KnotRule::Uniform, false) => return SplineSpace::uniform(n, left, right, m - n),
            (KnotRule::EndInterpolating, false) => vec![1.0; m - n],
            (KnotRule::EndInterpolating, true) => {
                // The seam carries n of the m knots.
                let mut lengths = vec![0.0; n - 1];
                lengths.resize(m, 1.0);
                lengths
            }
            (KnotRule::Uniform, true) => vec![1.0; m],
            (KnotRule::ChordLength, _) => self.active_legs(1.0),
            (KnotRule::Centripetal, _) => self.active_legs(0.5),
            (KnotRule::Averaged, false) => return self.averaged_open(),
            (KnotRule::Averaged, true) => return self.averaged_closed(),
        };
        let breaks = spread(&lengths, left, right)?;
        match space.period() {
            None => SplineSpace::from_breaks(n, &breaks, EndKnots::Interpolating),
            Some(period) => SplineSpace::periodic(n, period, breaks[..m].to_vec()),
        }
    }

    /// `|cₖ₊₁ − cₖ|` for any integer `k` of a closed curve.
    fn leg(&self, k: isize) -> f64 {
        let (points, count) = (self.points(), self.points().len() as isize);
        let at = |k: isize| points[k.rem_euclid(count) as usize];
        (at(k + 1) - at(k)).norm()
    }

    /// The mean of the legs, to the power `exponent`, of the polygon that is active in each knot interval.
    fn active_legs(&self, exponent: f64) -> Vec<f64> {
        let (n, m) = (self.degree() as isize, self.points().len() as isize);
        let spans = if self.space().is_periodic() { 0..m } else { n..m };
        spans
            .map(|span| (span - n..span).map(|k| self.leg(k).powf(exponent)).sum::<f64>() / n as f64)
            .collect()
    }

    fn averaged_open(&self) -> Result<SplineSpace, SplineError> {
        let (n, m) = (self.degree(), self.points().len());
        let (left, right) = self.space().parameter_interval();
        let legs: Vec<f64> = (0..m - 1).map(|k| self.leg(k as isize)).collect();
        let sites = spread(&legs, left, right)?;
        let mut breaks = vec![left];
        breaks.extend((n + 1..m).map(|j| mean(&sites[j - n..j])));
        breaks.push(right);
        SplineSpace::from_breaks(n, &breaks, EndKnots::Interpolating)
    }

    fn averaged_closed(&self) -> Result<SplineSpace, SplineError> {
        let (n, m) = (self.degree() as isize, self.points().len());
        let (left, right) = self.space().parameter_interval();
        let period = right - left;
        let legs: Vec<f64> = (0..m).map(|k| self.leg(k as isize)).collect();
        let sites = spread(&legs, left, right)?;
        let site = |k: isize| {
            let count = m as isize;
            sites[k.rem_euclid(count) as usize] + period * k.div_euclid(count) as f64
        };
        let average = |j: isize| mean(&(j - n..j).map(site).collect::<Vec<_>>());
        // Sites and knots may be shifted together; the period keeps its start.
        let first = average(0);
        let knots = (0..m as isize).map(|j| left + (average(j) - first)).collect();
        SplineSpace::periodic(self.degree(), self.space().period().unwrap_or(period), knots)
    }
}

/// `left`, then the partial sums of the lengths scaled to end with `right`.
fn spread(lengths: &[f64], left: f64, right: f64) -> Result<Vec<f64>, SplineError> {
    let total: f64 = lengths.iter().sum();
    // Infinite and undefined totals too.
    if !(total > 0.0 && total.is_finite()) {
        let reason = "the control points have no distances to take knots from".to_owned();
        return Err(SplineError::NoSolution { reason });
    }
    let mut sum = 0.0;
    let mut breaks = vec![left];
    for length in &lengths[..lengths.len() - 1] {
        sum += length;
        breaks.push(left + (right - left) * (sum / total));
    }
    breaks.push(right);
    Ok(breaks)
}

/// The mean, exact where all entries are equal.
fn mean(run: &[f64]) -> f64 {
    run[0] + run.iter().map(|site| site - run[0]).sum::<f64>() / run.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_curve;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn every_rule_keeps_degree_interval_and_dimension(curve in any_curve(1..=6)) {
            let interval = curve.space().parameter_interval();
            for rule in KnotRule::ALL {
                // Coinciding control points may leave no room for a rule.
                let Ok(space) = curve.space_by_rule(rule) else { continue };
                prop_assert_eq!(space.degree(), curve.degree(), "degree");
                prop_assert_eq!(space.dimension(), curve.points().len(), "{:?}", rule);
                prop_assert_eq!(space.parameter_interval(), interval, "{:?}", rule);
                prop_assert_eq!(space.period(), curve.space().period(), "{:?}", rule);
            }
        }
    }

    fn line(degree: usize, xs: &[f64], period: Option<f64>) -> Nurbs<DVec2> {
        let space = match period {
            None => SplineSpace::uniform(degree, 0.0, 12.0, xs.len() - degree).unwrap(),
            Some(period) => {
                let knots = (0..xs.len()).map(|k| period * k as f64 / xs.len() as f64).collect();
                SplineSpace::periodic(degree, period, knots).unwrap()
            }
        };
        Nurbs::polynomial(space, xs.iter().map(|&x| DVec2::new(x, 0.0)).collect()).unwrap()
    }

    #[test]
    fn equally_distant_points_give_equally_distant_knots() {
        let curve = line(2, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], None);
        let expected = [-3.0, 0.0, 0.0, 3.0, 6.0, 9.0, 12.0, 12.0, 15.0];
        for rule in [KnotRule::EndInterpolating, KnotRule::ChordLength, KnotRule::Centripetal] {
            assert_eq!(curve.space_by_rule(rule).unwrap().knots(), expected, "{rule:?}");
        }
        let uniform = curve.space_by_rule(KnotRule::Uniform).unwrap();
        assert_eq!(uniform.knots(), [-6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0], "uniform");
    }

    #[test]
    fn the_polygon_spreads_the_knots() {
        let curve = line(1, &[0.0, 1.0, 5.0, 6.0], None);
        let knots = |rule| curve.space_by_rule(rule).unwrap().knots().to_vec();
        assert_eq!(knots(KnotRule::ChordLength), [-2.0, 0.0, 2.0, 10.0, 12.0, 14.0], "chords 1, 4, 1");
        assert_eq!(knots(KnotRule::Centripetal), [-3.0, 0.0, 3.0, 9.0, 12.0, 15.0], "roots 1, 2, 1");
    }

    #[test]
    fn averages_of_degree_one_put_greville_abscissae_on_the_chord_lengths() {
        let curve = line(1, &[0.0, 1.0, 5.0, 6.0], None);
        let greville = curve.space_by_rule(KnotRule::Averaged).unwrap().greville_abscissae();
        assert_eq!(greville, [0.0, 2.0, 10.0, 12.0], "the sites");
        let closed = line(1, &[0.0, 1.0, 5.0, 6.0], Some(12.0));
        let greville = closed.space_by_rule(KnotRule::Averaged).unwrap().greville_abscissae();
        let steps: Vec<f64> = greville.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert_eq!(steps, [1.0, 4.0, 1.0], "the way back is 6 long");
    }

    #[test]
    fn averages_of_any_degree_keep_greville_abscissae_in_order_and_near() {
        let xs = [0.0, 0.2, 3.0, 3.5, 7.0, 7.1, 9.0, 12.0];
        for degree in 2..=4 {
            let space = line(degree, &xs, None).space_by_rule(KnotRule::Averaged).unwrap();
            let abscissae = space.greville_abscissae();
            assert!(abscissae.windows(2).all(|pair| pair[0] < pair[1]), "{abscissae:?}");
            let worst = abscissae.iter().zip(xs).map(|(a, x)| (a - x).abs()).fold(0.0, f64::max);
            assert!(worst < 2.0, "degree {degree}: {abscissae:?}");
        }
    }

    #[test]
    fn a_seam_can_interpolate_a_control_point() {
        let curve = line(3, &[0.0, 1.0, 5.0, 6.0, 2.0], Some(6.0));
        let space = curve.space_by_rule(KnotRule::EndInterpolating).unwrap();
        assert_eq!(space.knots(), [0.0, 0.0, 0.0, 2.0, 4.0], "a threefold seam");
        let new = Nurbs::polynomial(space, curve.points().to_vec()).unwrap();
        let seam = new.evaluate(0.0).unwrap();
        assert!(curve.points().contains(&seam), "{seam}");
    }

    #[test]
    fn points_without_distances_are_refused() {
        let curve = line(2, &[1.0; 6], None);
        for rule in [KnotRule::ChordLength, KnotRule::Centripetal, KnotRule::Averaged] {
            assert_eq!(curve.space_by_rule(rule).unwrap_err().name(), "NoSolution", "{rule:?}");
        }
        let curve = line(2, &[0.0, 0.0, 0.0, 0.0, 1.0, 2.0], None);
        assert!(curve.space_by_rule(KnotRule::ChordLength).is_err(), "no room in the first interval");
    }
}
