//! Two curves as one, and a curve whose ends meet as a closed one.
//!
//! The second curve keeps its speed: its knots move so that it starts where the first one ends, and the joint becomes an `n`-fold knot.
//! The curve of lower degree is elevated; the weights of the second are multiplied by one factor, which does not change it, so that both
//! agree at the joint. Course: section 6.1.

use crate::core::bspline::{EndKnots, SplineError, SplineSpace};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// Distance of two ends, relative to the largest coordinate, that still counts as rounding.
const SAME_POINT: f64 = 1e-10;

impl<P: Projective> Nurbs<P> {
    /// This curve, then `next`, with a corner at the joint unless their tangents agree; closed ones are opened at `ξ₀`.
    ///
    /// # Errors
    ///
    /// `BoundaryMismatch` with the distance unless `next` starts where this curve ends, to 1e-10 of the size of both; those of
    /// [`Nurbs::opened`] and [`Nurbs::elevate_degree`].
    pub fn joined(&self, next: &Self) -> Result<Self, SplineError> {
        let (mut first, mut second) = (self.opened()?, next.opened()?);
        while first.degree() < second.degree() {
            first = first.elevate_degree()?;
        }
        while second.degree() < first.degree() {
            second = second.elevate_degree()?;
        }
        let n = first.degree();
        let end = first.points().len() - 1;
        let distance = (second.points()[0] - first.points()[end]).norm();
        let all = first.points().iter().chain(second.points());
        let size = all.fold(0.0, |size: f64, point| size.max(point.norm()));
        if distance > SAME_POINT * size {
            return Err(SplineError::BoundaryMismatch { index: 1, distance });
        }
        let (left, right) = first.space().parameter_interval();
        let (start, stop) = second.space().parameter_interval();
        let inner = |curve: &Self, low: f64, high: f64| -> Vec<f64> {
            let knots = curve.space().knots().iter().copied();
            knots.filter(|&knot| low < knot && knot < high).collect()
        };
        let mut breaks = vec![left];
        breaks.extend(inner(&first, left, right));
        breaks.extend(std::iter::repeat_n(right, n));
        breaks.extend(inner(&second, start, stop).into_iter().map(|knot| right + (knot - start)));
        breaks.push(right + (stop - start));
        let factor = first.weights()[end] / second.weights()[0];
        let points = first.points().iter().chain(&second.points()[1..]).copied().collect();
        let scaled = second.weights()[1..].iter().map(|weight| weight * factor);
        let weights = first.weights().iter().copied().chain(scaled).collect();
        Self::new(SplineSpace::from_breaks(n, &breaks, EndKnots::Interpolating)?, points, weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_whole_is_both_parts(first in any_curve(1..=6), second in any_curve(1..=6), share in 0.0..1.0_f64) {
            let (left, right) = first.space().parameter_interval();
            let (start, stop) = second.space().parameter_interval();
            let shift = first.evaluate(right).unwrap() - second.evaluate(start).unwrap();
            let second = second.transformed(|point| point + shift).unwrap();
            let whole = first.joined(&second).unwrap();
            prop_assert_eq!(whole.degree(), first.degree().max(second.degree()), "the higher degree");
            let t = left.mix(right, share);
            let error = whole.evaluate(t).unwrap().distance(first.evaluate(t).unwrap());
            prop_assert!(error < 1e-9, "first part, {t}: off by {error}");
            let later = start.mix(stop, share);
            let error = whole.evaluate(right + (later - start)).unwrap().distance(second.evaluate(later).unwrap());
            prop_assert!(error < 1e-9, "second part, {later}: off by {error}");
        }

        #[test]
        fn splitting_undoes_joining(curve in any_curve(1..=7), share in 0.1..0.9_f64) {
            let (left, right) = curve.space().parameter_interval();
            let (before, after) = curve.split(left.mix(right, share)).unwrap();
            let whole = before.joined(&after).unwrap();
            for i in 0..=30 {
                let t = left.mix(right, f64::from(i) / 30.0);
                let error = whole.evaluate(t.min(whole.space().parameter_interval().1)).unwrap().distance(curve.evaluate(t).unwrap());
                prop_assert!(error < 1e-11, "{t}: off by {error}");
            }
        }
    }

    #[test]
    fn ends_that_are_apart_are_refused() {
        let space = SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 2.0]).unwrap();
        let line = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X]).unwrap();
        let error = line.joined(&line).unwrap_err();
        assert_eq!(error, SplineError::BoundaryMismatch { index: 1, distance: 1.0 }, "from (1, 0) to (0, 0)");
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let twice = circle.joined(&circle).unwrap();
        assert_eq!(twice.space().parameter_interval(), (0.0, 8.0), "two turns");
    }
}
