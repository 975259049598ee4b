//! Parts of curves: between two parameters, and both sides of one.
//!
//! Both ends are inserted until they are `n`-fold; the control points in between are those of the part, which interpolates its ends.
//! Course: sections 6.1 and 6.3.

use crate::core::bspline::{EndKnots, SplineError, SplineSpace};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Projective> Nurbs<P> {
    /// The part over `[a, b]`, an open curve with end-interpolating knots.
    ///
    /// Of a closed curve `a` is any parameter and `b` at most a period further, so that the part may run across `ξ₀`; its parameters then
    /// start at `a` reduced into the period.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `EmptyInterval` unless `a < b`; `OutsideInterval`; those of [`SplineSpace::new`] if `f64` has no room for the knots.
    pub fn trimmed(&self, a: f64, b: f64) -> Result<Self, SplineError> {
        for (index, value) in [a, b].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(SplineError::NonFinite { what: "end", index, value });
            }
        }
        if a >= b {
            return Err(SplineError::EmptyInterval { left: a, right: b });
        }
        let (start, length) = (self.space().reduce(a)?, b - a);
        match self.space().period() {
            None => self.part(start, self.space().reduce(b)?),
            Some(period) if length <= period => {
                let (left, right) = self.space().parameter_interval();
                // The end of the period is the start of the next one.
                let start = if start >= right { left } else { start };
                let end = if start.to_bits() == a.to_bits() { b } else { start + length };
                self.stretch(start, end)?.part(start, end)
            }
            Some(period) => Err(SplineError::OutsideInterval { value: b, left: a, right: a + period }),
        }
    }

    /// The parts of an open curve before and after `t`, each with end-interpolating knots; a closed curve is opened at `ξ₀` first.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` unless `t` lies inside D.
    pub fn split(&self, t: f64) -> Result<(Self, Self), SplineError> {
        let (left, right) = self.space().parameter_interval();
        if !t.is_finite() {
            return Err(SplineError::NonFinite { what: "parameter", index: 0, value: t });
        }
        if t <= left || t >= right {
            return Err(SplineError::OutsideInterval { value: t, left, right });
        }
        Ok((self.trimmed(left, t)?, self.trimmed(t, right)?))
    }

    /// The open curve over the knots around `[a, b]`, with `a` in the period of this closed one and `b` at most one period later.
    fn stretch(&self, a: f64, b: f64) -> Result<Self, SplineError> {
        let (n, space) = (self.degree() as isize, self.space());
        let knot = |k: isize| space.knot(k).unwrap_or(f64::NAN);
        let first = space.knots().partition_point(|&knot| knot <= a) as isize - 1;
        let mut last = first + 1;
        while knot(last) < b {
            last += 1;
        }
        let indices = first - n..last;
        let knots = (first - n..=last + n).map(knot).collect();
        let index = |k: isize| k.rem_euclid(space.dimension() as isize) as usize;
        let points = indices.clone().map(|k| self.points()[index(k)]).collect();
        let weights = indices.map(|k| self.weights()[index(k)]).collect();
        Self::new(SplineSpace::new(self.degree(), knots)?, points, weights)
    }

    /// The part of an open curve over `[a, b]` in D.
    fn part(&self, a: f64, b: f64) -> Result<Self, SplineError> {
        let n = self.degree();
        let missing = |end: f64| std::iter::repeat_n(end, n.saturating_sub(self.space().multiplicity(end)));
        let cut = self.insert_knots(&missing(a).chain(missing(b)).collect::<Vec<_>>())?;
        let knots = cut.space().knots();
        // With an n-fold knot whose first copy has index k, control point k − 1 lies on the curve.
        let (from, to) = (knots.partition_point(|&knot| knot < a), knots.partition_point(|&knot| knot < b));
        // The last copy of a … the first copy of b.
        let space = SplineSpace::from_breaks(n, &knots[from + n - 1..=to], EndKnots::Interpolating)?;
        Self::new(space, cut.points()[from - 1..to].to_vec(), cut.weights()[from - 1..to].to_vec())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_part_is_the_curve_over_its_interval(
            curve in any_curve(1..=25), ends in (0.0..1.0_f64, 0.0..1.0_f64), turns in -3_i32..3, at_knots in any::<bool>(),
        ) {
            let (left, right) = curve.space().parameter_interval();
            let place = |share: f64| if at_knots { left.mix(right, share).floor() } else { left.mix(right, share) };
            let (mut a, mut b) = (place(ends.0).max(left), place(ends.1).max(left));
            if let Some(period) = curve.space().period() {
                // Also across the seam, and from another turn.
                b += if b <= a { period } else { 0.0 };
                (a, b) = (a + period * f64::from(turns), b + period * f64::from(turns));
            } else if b < a {
                (a, b) = (b, a);
            }
            if b - a < 1e-3 {
                return Ok(());
            }
            let part = curve.trimmed(a, b).unwrap();
            let (from, to) = part.space().parameter_interval();
            prop_assert!((to - from - (b - a)).abs() < 1e-12 && (curve.space().is_periodic() || from == a), "{from}, {to}");
            prop_assert_eq!(part.space().multiplicity(from), curve.degree(), "interpolating");
            for i in 0..=20 {
                let share = f64::from(i) / 20.0;
                let (p, c) = (part.evaluate(from.mix(to, share)).unwrap(), curve.evaluate(a.mix(b, share)).unwrap());
                prop_assert!(p.distance(c) < 1e-10, "at {share}: {p}, {c}");
            }
        }

        #[test]
        fn two_parts_are_the_whole(curve in any_curve(1..=9), share in 0.05..0.95_f64) {
            let (left, right) = curve.space().parameter_interval();
            let t = left.mix(right, share);
            let (before, after) = curve.split(t).unwrap();
            prop_assert_eq!(before.space().parameter_interval(), (left, t), "first part");
            prop_assert_eq!(after.space().parameter_interval(), (t, right), "second part");
            for i in 0..=30 {
                let at = left.mix(right, f64::from(i) / 30.0);
                let part = if at <= t { &before } else { &after };
                let error = part.evaluate(at).unwrap().distance(curve.evaluate(at).unwrap());
                prop_assert!(error < 1e-12, "split at {t}, {at}: off by {error}");
            }
        }
    }

    #[test]
    fn intervals_that_make_no_part_are_refused() {
        let space = SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap();
        let curve = Nurbs::polynomial(space, vec![1.0, 2.0, 4.0, 3.0, 0.0]).unwrap();
        let name = |a, b| curve.trimmed(a, b).unwrap_err().name();
        assert_eq!(name(0.5, 0.5), "EmptyInterval", "no length");
        assert_eq!(name(0.5, 1.5), "OutsideInterval", "behind the end");
        assert_eq!(name(f64::NAN, 0.5), "NonFinite", "NaN");
        assert_eq!(curve.split(0.0).unwrap_err().name(), "OutsideInterval", "nothing before the start");
        let closed = Nurbs::closed(vec![1.0, 2.0, 4.0], vec![1.0; 3], 2).unwrap();
        assert_eq!(closed.trimmed(0.5, 3.6).unwrap_err().name(), "OutsideInterval", "more than a turn");
        assert!(closed.trimmed(0.5, 3.5).is_ok(), "a whole turn");
    }
}
