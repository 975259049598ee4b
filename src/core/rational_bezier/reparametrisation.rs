//! Other weights for the same curve.
//!
//! The parameter change `t = s/(ρ s + 1 − ρ)`, `ρ < 1`, of `[0, 1]` turns the weights into `λ (1 − ρ)ⁿ⁻ᵏ wₖ` and moves no control point. The
//! standard form has first and last weight 1. Course: section 3.2.

use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::rational_bezier::{Projective, RationalBezier};

/// A curve in standard form, and the parameter change that leads to it.
#[derive(Clone, Debug, PartialEq)]
pub struct StandardForm<P: Projective> {
    /// The same curve with first and last weight 1.
    pub curve: RationalBezier<P>,
    /// `ρ` of the parameter change, see [`parameter_before`].
    pub rho: f64,
    /// The common factor `λ`.
    pub lambda: f64,
}

/// The old parameter `t = s/(ρ s + 1 − ρ)` in `[0, 1]` of the point with the new parameter `s`.
pub fn parameter_before(rho: f64, s: f64) -> f64 {
    if s == 1.0 { 1.0 } else { s / (rho * s + 1.0 - rho) }
}

impl<P: Projective> RationalBezier<P> {
    /// The same curve with the weights `λ (1 − ρ)ⁿ⁻ᵏ wₖ`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` for `ρ ≥ 1`; `WeightNotPositive` for `λ ≤ 0` or where a weight underflows.
    pub fn reparametrised(&self, rho: f64, lambda: f64) -> Result<Self, RationalBezierError> {
        check_finite("parameter change", &[rho, lambda])?;
        if rho >= 1.0 {
            let (left, right) = (f64::NEG_INFINITY, 1.0);
            return Err(RationalBezierError::OutsideInterval { what: "rho", value: rho, left, right });
        }
        let mut factor = lambda;
        let mut weights = self.weights().to_vec();
        for weight in weights.iter_mut().rev() {
            *weight *= factor;
            factor *= 1.0 - rho;
        }
        Self::on_interval(self.points().to_vec(), weights, self.interval())
    }

    /// The curve in standard form: weights `wₖ w₀^(k/n − 1) wₙ^(−k/n)`, by logarithms. For `n = 2` the middle weight `w₁/√(w₀ w₂)` remains.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive`, `NonFinite` where a weight under- or overflows.
    pub fn standardised(&self) -> Result<StandardForm<P>, RationalBezierError> {
        let (n, weights) = (self.degree(), self.weights());
        let (first, last) = (weights[0].ln(), weights[n].ln());
        let weight = |k: usize| {
            if k == 0 || k == n {
                return 1.0;
            }
            let share = k as f64 / n as f64;
            (weights[k].ln() - (1.0 - share) * first - share * last).exp()
        };
        let standard = (0..=n).map(weight).collect();
        let curve = Self::on_interval(self.points().to_vec(), standard, self.interval())?;
        let rho = if n == 0 { 0.0 } else { -((last - first) / n as f64).exp_m1() };
        Ok(StandardForm { curve, rho, lambda: weights[n].recip() })
    }

    /// Whether a parameter change makes the curve polynomial: the standard weights differ from 1 by at most `tolerance`.
    pub fn is_polynomial(&self, tolerance: f64) -> bool {
        self.standardised()
            .is_ok_and(|standard| standard.curve.weights().iter().all(|w| (w - 1.0).abs() <= tolerance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::point::Point as _;
    use crate::core::rational_bezier::curve::tests::curves;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn other_parameters_pass_the_same_points(curve in curves(), rho in -3.0..0.9_f64, lambda in 0.1..9.0_f64, s in 0.0..=1.0_f64) {
            let at = |curve: &RationalBezier<DVec2>, t: f64| curve.evaluate((-1.0).mix(2.0, t)).unwrap();
            let other = curve.reparametrised(rho, lambda).unwrap();
            let gap = (at(&other, s) - at(&curve, parameter_before(rho, s))).length();
            prop_assert!(gap < 1e-11, "moved by {gap}");
            let standard = curve.standardised().unwrap();
            let gap = (at(&standard.curve, s) - at(&curve, parameter_before(standard.rho, s))).length();
            prop_assert!(gap < 1e-11, "standard form moved by {gap}");
            let again = other.standardised().unwrap().curve;
            let direct = curve.reparametrised(standard.rho, standard.lambda).unwrap();
            let twice = standard.curve.standardised().unwrap().curve;
            for k in 0..curve.weights().len() {
                let w = standard.curve.weights()[k];
                prop_assert!((again.weights()[k] / w - 1.0).abs() < 1e-12, "invariant");
                prop_assert!((twice.weights()[k] / w - 1.0).abs() < 1e-13, "idempotent");
                prop_assert!((direct.weights()[k] / w - 1.0).abs() < 1e-12, "the change that is told");
            }
            prop_assert_eq!(standard.curve.weights()[0], 1.0, "first weight");
            prop_assert_eq!(standard.curve.weights()[curve.degree()], 1.0, "last weight");
        }
    }

    #[test]
    fn disguised_polynomials_are_recognised() {
        let points = vec![0.0, 1.0, 5.0, 2.0];
        let curve = RationalBezier::new(points.clone(), vec![1e-250, 1e-100, 1e50, 1e200]).unwrap();
        assert!(curve.is_polynomial(1e-10), "geometric weights over 450 powers of ten");
        let other = RationalBezier::new(points, vec![1.0, 2.0, 4.0, 8.1]).unwrap();
        assert!(!other.is_polynomial(1e-3) && other.is_polynomial(0.1), "nearly");
        assert_eq!(
            other.reparametrised(0.0, -1.0).unwrap_err().name(),
            "WeightNotPositive",
            "negative factor"
        );
        assert_eq!(other.reparametrised(f64::NAN, 1.0).unwrap_err().name(), "NonFinite", "NaN");
        let point = RationalBezier::new(vec![3.0], vec![7.0]).unwrap().standardised().unwrap();
        assert_eq!(point.curve.weights(), [1.0], "degree 0");
    }
}
