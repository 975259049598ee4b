//! Another start of the period, and open splines that are periodic without knowing it.
//!
//! A `T`-periodic spline has `ξₖ₊ₘ = ξₖ + T` and `cₖ₊ₘ = cₖ` for all integers `k` (`M` knots in a period): any first copy of a knot may
//! start the period. Course: sections 4.6 and 6.1.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

/// Relative difference up to which knot distances count as repeated.
const SAME_KNOTS: f64 = 1e-12;

impl<P: Point> Spline<P> {
    /// The coefficient `cₖ` for any integer `k` if periodic; `None` outside an open sequence.
    pub fn coefficient(&self, k: isize) -> Option<P> {
        let k = if self.space().is_periodic() { k.rem_euclid(self.space().dimension() as isize) } else { k };
        usize::try_from(k).ok().and_then(|k| self.coefficients().get(k)).copied()
    }

    /// The same periodic spline with the period that starts at knot `j`, any integer.
    ///
    /// # Errors
    ///
    /// `NoSolution` for an open spline; `PeriodTooShort` unless knot `j` is the first copy of its value.
    pub fn with_start(&self, j: isize) -> Result<Self, SplineError> {
        let Some(period) = self.space().period() else {
            return Err(SplineError::NoSolution { reason: "an open spline has no period".to_owned() });
        };
        let indices = j..j + self.space().dimension() as isize;
        let knots = indices.clone().filter_map(|k| self.space().knot(k)).collect();
        let space = SplineSpace::periodic(self.degree(), period, knots)?;
        Self::new(space, indices.filter_map(|k| self.coefficient(k)).collect())
    }

    /// The periodic spline over D as its period that this open one writes out; `None` if it repeats neither knots nor coefficients.
    ///
    /// Knots may differ by 1e-12 of the period, coefficients by `tolerance`; the two outermost knots have no influence on D and are
    /// not compared. An end-interpolating spline whose end points coincide becomes periodic with an `n`-fold knot there.
    pub fn closed_if_periodic(&self, tolerance: f64) -> Option<Self> {
        let (n, space) = (self.degree(), self.space());
        if space.is_periodic() {
            return Some(self.clone());
        }
        let (knots, m) = (space.knots(), space.dimension());
        let (left, right) = space.parameter_interval();
        let period = right - left;
        let first = knots.partition_point(|&knot| knot < left).max(1);
        let count = m - first;
        let repeats = |k: usize| (knots[k + count] - knots[k] - period).abs() <= SAME_KNOTS * period;
        let same = |k: usize| (self.coefficients()[k + count] - self.coefficients()[k]).norm() <= tolerance;
        let closes = (1..m + n - count).all(repeats) && (0..m - count).all(same);
        let inside = first..m;
        let space =
            closes.then(|| SplineSpace::periodic(n, period, knots[inside.clone()].to_vec()).ok())??;
        Self::new(space, self.coefficients()[inside].to_vec()).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Side;
    use glam::DVec2;
    use proptest::prelude::*;

    prop_compose! {
        fn any_periodic()(degree in 1_usize..=9, gaps in prop::collection::vec(0_u8..3, 0..12)) -> Option<Spline<f64>> {
            let mut knots = vec![1.0];
            for gap in &gaps {
                knots.push(knots[knots.len() - 1] + 0.5 * f64::from(*gap));
            }
            let period = knots[knots.len() - 1] + 0.5;
            let coefficients = (0..knots.len()).map(|k| ((k * k + 3) % 7) as f64 - 3.0).collect();
            let space = SplineSpace::periodic(degree, period, knots).ok()?;
            Spline::new(space, coefficients).ok()
        }
    }

    proptest! {
        #[test]
        fn a_period_later_everything_is_the_same(spline in any_periodic(), at in 0.0..1.0_f64, turns in -1_000_000_i32..1_000_000) {
            let Some(spline) = spline else { return Ok(()) };
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            // Slopes are at most 2 n·6/0.5, and a jump is no issue: splines are continuous.
            let slope = 24.0 * spline.degree() as f64;
            let later = x + (right - left) * f64::from(turns);
            let error = (spline.evaluate(later).unwrap() - spline.evaluate(x).unwrap()).abs();
            prop_assert!(error <= 1e-12 + 4.0 * slope * f64::EPSILON * later.abs(), "{turns} periods later: {error}");
        }

        #[test]
        fn the_period_may_start_at_any_knot(spline in any_periodic(), j in -30_isize..30, at in 0.0..1.0_f64) {
            let Some(spline) = spline else { return Ok(()) };
            let Ok(shifted) = spline.with_start(j) else {
                prop_assert_eq!(spline.space().knot(j - 1), spline.space().knot(j), "only later copies are refused");
                return Ok(());
            };
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            let error = (spline.evaluate(x).unwrap() - shifted.evaluate(x).unwrap()).abs();
            prop_assert!(error < 1e-10, "started at {j}: {error}");
            let back = shifted.with_start(-j).unwrap();
            prop_assert_eq!(back.coefficients(), spline.coefficients(), "and back");
        }

        #[test]
        fn derivatives_match_at_the_seam_and_have_mean_zero(spline in any_periodic()) {
            let Some(spline) = spline else { return Ok(()) };
            let (left, right) = spline.space().parameter_interval();
            let multiplicity = spline.space().multiplicity(left);
            let open = spline.unroll().unwrap();
            let start = open.derivatives(left, spline.degree(), Side::Right).unwrap();
            let end = open.derivatives(right, spline.degree(), Side::Left).unwrap();
            for order in 0..=spline.degree() - multiplicity {
                let scale = start[order].abs().max(1.0);
                prop_assert!((start[order] - end[order]).abs() < 1e-9 * scale, "order {order}: {start:?}, {end:?}");
            }
            if let Ok(derivative) = spline.derivative() {
                prop_assert!(derivative.mean().unwrap().abs() < 1e-10, "mean {}", derivative.mean().unwrap());
            }
        }

        #[test]
        fn an_unrolled_spline_is_recognised(spline in any_periodic(), at in 0.0..1.0_f64) {
            let Some(spline) = spline else { return Ok(()) };
            let closed = spline.unroll().unwrap().closed_if_periodic(0.0).unwrap();
            prop_assert_eq!(closed.coefficients(), spline.coefficients(), "the coefficients of the period");
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            let error = (spline.evaluate(x).unwrap() - closed.evaluate(x).unwrap()).abs();
            prop_assert!(error < 1e-12, "off by {error}");
        }
    }

    #[test]
    fn the_oscillating_spline_has_its_functional_equation() {
        for degree in 1..=12 {
            let space = SplineSpace::periodic(degree, 2.0, vec![0.0, 1.0]).unwrap();
            let spline = Spline::new(space, vec![1.0, -1.0]).unwrap();
            for i in 0..=20 {
                let x = 0.1 * f64::from(i);
                let (here, later) = (spline.evaluate(x).unwrap(), spline.evaluate(x + 1.0).unwrap());
                assert!((here + later).abs() < 1e-14, "degree {degree}, x = {x}: {here} and {later}");
            }
            if degree > 1 {
                let lower = SplineSpace::periodic(degree - 1, 2.0, vec![0.0, 1.0]).unwrap();
                let expected = Spline::new(lower, vec![2.0, -2.0]).unwrap();
                assert_eq!(spline.derivative().unwrap(), expected, "twice the lower one, degree {degree}");
            }
        }
        let space = SplineSpace::periodic(3, 2.0, vec![0.0, 0.5, 0.5]).unwrap();
        let constant = Spline::new(space, vec![4.0; 3]).unwrap();
        assert!((constant.evaluate(17.3).unwrap() - 4.0).abs() < 1e-14, "constants stay constant");
    }

    #[test]
    fn a_closed_polygon_is_periodic_and_an_open_one_is_not() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let points = vec![DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::X];
        let closed = Spline::new(space.clone(), points).unwrap().closed_if_periodic(1e-12).unwrap();
        assert_eq!(closed.space().knots(), [0.0, 0.0, 1.0], "a double knot at the joint");
        assert_eq!(closed.evaluate(2.0).unwrap(), DVec2::X, "through the joint");
        let open = Spline::new(space, vec![DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y]).unwrap();
        assert_eq!(open.closed_if_periodic(1e-12), None, "the ends are apart");
        assert_eq!(open.with_start(1).unwrap_err().name(), "NoSolution", "an open spline");
    }
}
