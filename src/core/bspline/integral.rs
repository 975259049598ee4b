//! Antiderivatives and integrals of splines.
//!
//! `∫ bₖ = (ξₖ₊ₙ₊₁ − ξₖ)/(n + 1)`, and `Σ cₖ bₖ` has the antiderivative `Σ eₖ bⁿ⁺¹ₖ` with
//! `eₖ = Σ_{j ≤ k} cⱼ (ξⱼ₊ₙ₊₁ − ξⱼ)/(n + 1)`. Course: sections 4.2 and 4.5.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

impl<P: Point> Spline<P> {
    /// An antiderivative: an open spline of degree `n + 1` over D, over one period for a periodic spline.
    ///
    /// It has one knot more on each side; its first coefficient is 0, the others are the `eₖ` at the head of this file.
    ///
    /// # Errors
    ///
    /// `StepLimit` if the degree is already the highest one.
    pub fn antiderivative(&self) -> Result<Self, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let (old, m) = (space.evaluation_knots(), space.evaluation_dimension());
        let mut knots = Vec::with_capacity(old.len() + 2);
        knots.push(old[0] - (old[n + 1] - old[n]));
        knots.extend_from_slice(old);
        knots.push(old[m + n] + (old[m] - old[m - 1]));
        let mut sum = P::ZERO;
        let mut coefficients = vec![sum];
        for k in 0..m {
            sum = sum + self.evaluation_coefficient(k) * ((old[k + n + 1] - old[k]) / (n + 1) as f64);
            coefficients.push(sum);
        }
        Self::new(SplineSpace::new(n + 1, knots)?, coefficients)
    }

    /// `∫ₐᵇ p`, negative direction if `b < a`; any `a` and `b` if periodic.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`, `StepLimit` as for [`Self::antiderivative`].
    pub fn integrate(&self, a: f64, b: f64) -> Result<P, SplineError> {
        let (space, whole) = (self.space(), self.antiderivative()?);
        let (left, right) = space.parameter_interval();
        let per_period = whole.evaluate(right)? - whole.evaluate(left)?;
        let up_to = |x: f64| -> Result<P, SplineError> {
            let reduced = space.reduce(x)?;
            let turns = space.period().map_or(0.0, |period| ((x - reduced) / period).round());
            Ok(whole.evaluate(reduced)? + per_period * turns)
        };
        Ok(up_to(b)? - up_to(a)?)
    }

    /// The mean value over D, or over one period.
    ///
    /// # Errors
    ///
    /// `StepLimit` as for [`Self::antiderivative`].
    pub fn mean(&self) -> Result<P, SplineError> {
        let (left, right) = self.space().parameter_interval();
        Ok(self.integrate(left, right)? * (right - left).recip())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_antiderivative_has_the_spline_as_derivative() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0]).unwrap();
        let spline = Spline::new(space, vec![1.0, -2.0, 0.5, 4.0, 1.0]).unwrap();
        let derivative = spline.antiderivative().unwrap().derivative().unwrap();
        for i in 0..=30 {
            let x = 0.1 * f64::from(i);
            let (a, b) = (derivative.evaluate(x).unwrap(), spline.evaluate(x).unwrap());
            assert!((a - b).abs() < 1e-13, "x = {x}: {a} and {b}");
        }
    }

    #[test]
    fn a_periodic_integral_counts_whole_turns() {
        let space = SplineSpace::periodic(2, 4.0, vec![0.0, 1.0, 3.0]).unwrap();
        let spline = Spline::new(space, vec![1.0, 2.0, -1.0]).unwrap();
        assert!((spline.mean().unwrap() - 2.0 / 3.0).abs() < 1e-14, "mean");
        let once = spline.integrate(0.5, 3.5).unwrap();
        let long = spline.integrate(0.5, 11.5).unwrap();
        assert!((long - once - 16.0 / 3.0).abs() < 1e-12, "two turns more: {once} and {long}");
    }
}
