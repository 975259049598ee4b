//! Derivatives and curvature of rational curves.
//!
//! From `p = r q` by Leibniz' rule `r⁽ᵐ⁾ = (p⁽ᵐ⁾ − Σ C(m,l) q⁽ˡ⁾ r⁽ᵐ⁻ˡ⁾)/q`, the sum over `l = 1 … m`. Course: section 3.3.

use glam::{DVec2, DVec3};

use crate::core::bezier::{Frame, OsculatingCircle, SpaceFrame};
use crate::core::point::Point as _;
use crate::core::rational_bezier::error::RationalBezierError;
use crate::core::rational_bezier::{Projective, RationalBezier};

/// Writes the derivatives of `p/q` for those of the homogeneous curve `(p, q)`, as many as `values` has places.
pub(in crate::core) fn project_derivatives<P: Projective>(lifted: &[P::Homogeneous], values: &mut [P]) {
    let weight = |l: usize| lifted[l].coordinate(P::DIMENSION);
    for m in 0..values.len() {
        let mut numerator = P::numerator(lifted[m]);
        let mut binomial = 1.0;
        for l in 1..=m {
            binomial *= (m + 1 - l) as f64 / l as f64;
            numerator = numerator - values[m - l] * (binomial * weight(l));
        }
        values[m] = numerator * weight(0).recip();
    }
}

impl<P: Projective> RationalBezier<P> {
    /// `r(x), r′(x), …, r⁽ᶜᵒᵘⁿᵗ⁾(x)`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` where the denominator vanishes or a derivative overflows.
    pub fn derivatives(&self, x: f64, count: usize) -> Result<Vec<P>, RationalBezierError> {
        if self.has_equal_weights() {
            return Ok(self.without_weights().derivatives(x, count)?);
        }
        let lifted = self.homogeneous().0.derivatives(x, count)?;
        let mut values = vec![P::ZERO; count + 1];
        project_derivatives(&lifted, &mut values);
        if values.iter().any(|value| !value.is_finite()) {
            return Err(RationalBezierError::Degenerate { what: "a derivative", value: x });
        }
        Ok(values)
    }

    /// The derivatives at both ends: `n (w₁/w₀)(c₁ − c₀)/(b − a)` and `n (wₙ₋₁/wₙ)(cₙ − cₙ₋₁)/(b − a)`; 0 for degree 0.
    pub fn end_derivatives(&self) -> [P; 2] {
        let (n, points, weights) = (self.degree(), self.points(), self.weights());
        if n == 0 {
            return [P::ZERO; 2];
        }
        let (a, b) = self.interval();
        let factor = n as f64 / (b - a);
        [
            (points[1] - points[0]) * (factor * (weights[1] / weights[0])),
            (points[n] - points[n - 1]) * (factor * (weights[n - 1] / weights[n])),
        ]
    }
}

impl RationalBezier<DVec2> {
    /// Point, unit tangent and normal, signed curvature and speed.
    ///
    /// # Errors
    ///
    /// As [`RationalBezier::derivatives`]; `Degenerate` where the speed is 0.
    pub fn frame(&self, x: f64) -> Result<Frame, RationalBezierError> {
        let d = self.derivatives(x, 2)?;
        Frame::from_derivatives([d[0], d[1], d[2]])
            .ok_or(RationalBezierError::Degenerate { what: "the tangent", value: x })
    }

    /// The signed curvature, positive in left turns.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn curvature(&self, x: f64) -> Result<f64, RationalBezierError> {
        Ok(self.frame(x)?.curvature)
    }

    /// Derivative of the signed curvature by the parameter.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn curvature_derivative(&self, x: f64) -> Result<f64, RationalBezierError> {
        let d = self.derivatives(x, 3)?;
        Frame::from_derivatives([d[0], d[1], d[2]])
            .map(|frame| frame.curvature_derivative(d[2], d[3]))
            .ok_or(RationalBezierError::Degenerate { what: "the tangent", value: x })
    }

    /// The osculating circle; `None` where the curvature is 0.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn osculating_circle(&self, x: f64) -> Result<Option<OsculatingCircle>, RationalBezierError> {
        Ok(self.frame(x)?.osculating_circle())
    }
}

impl RationalBezier<DVec3> {
    /// Point, Frenet frame, curvature, torsion and speed.
    ///
    /// # Errors
    ///
    /// As [`RationalBezier::derivatives`]; `Degenerate` where the speed or the curvature is 0.
    pub fn frame(&self, x: f64) -> Result<SpaceFrame, RationalBezierError> {
        let d = self.derivatives(x, 3)?;
        SpaceFrame::from_derivatives([d[0], d[1], d[2], d[3]])
            .ok_or(RationalBezierError::Degenerate { what: "the normal", value: x })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bezier::BezierCurve;
    use crate::core::rational_bezier::curve::tests::curves;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn derivatives_are_limits_of_difference_quotients(curve in curves(), x in -0.9..1.9_f64) {
            let exact = curve.derivatives(x, 3).unwrap();
            let h = 1e-4;
            let (before, after) = (curve.derivatives(x - h, 2).unwrap(), curve.derivatives(x + h, 2).unwrap());
            for m in 0..=2 {
                let quotient = (after[m] - before[m]) / (2.0 * h);
                let size = exact.iter().map(|d| d.length()).fold(1.0, f64::max);
                prop_assert!((quotient - exact[m + 1]).length() < 1e-2 * size * size, "order {}: {quotient} for {}", m + 1, exact[m + 1]);
            }
        }

        #[test]
        fn the_formulas_at_the_ends_are_the_general_ones(curve in curves()) {
            let (a, b) = curve.interval();
            let ends = curve.end_derivatives();
            for (end, x) in ends.iter().zip([a, b]) {
                let general = curve.derivatives(x, 1).unwrap()[1];
                prop_assert!((general - *end).length() < 1e-10 * (1.0 + end.length()), "{general} and {end}");
            }
            let (c, w, n) = (curve.points(), curve.weights(), curve.degree());
            prop_assume!(n >= 2 && (c[1] - c[0]).length() > 0.3);
            let area = 0.5 * (c[1] - c[0]).perp_dot(c[2] - c[0]);
            let factor = 2.0 * (n - 1) as f64 / n as f64 * w[0] * w[2] / (w[1] * w[1]);
            let formula = factor * area / (c[1] - c[0]).length().powi(3);
            let general = curve.curvature(a).unwrap();
            prop_assert!((formula - general).abs() < 1e-9 * (1.0 + formula.abs()), "{formula} and {general}");
        }

        #[test]
        fn the_curvature_of_a_rational_curve_has_its_derivative(curve in curves(), x in -0.9..1.9_f64) {
            prop_assume!(curve.degree() >= 2);
            let frame = curve.frame(x).unwrap();
            prop_assume!(frame.speed > 0.3 && frame.curvature.abs() < 3.0);
            let h = 1e-5;
            let quotient = (curve.curvature(x + h).unwrap() - curve.curvature(x - h).unwrap()) / (2.0 * h);
            let exact = curve.curvature_derivative(x).unwrap();
            prop_assert!((quotient - exact).abs() < 1e-2 * (1.0 + exact.abs()), "{quotient} for {exact}");
        }
    }

    #[test]
    fn equal_weights_give_the_polynomial_derivatives() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::new(0.0, 2.0, 5.0)];
        let polynomial = BezierCurve::new(points.clone()).unwrap();
        let curve = RationalBezier::new(points, vec![3.0; 4]).unwrap();
        assert_eq!(curve.derivatives(0.3, 4).unwrap(), polynomial.derivatives(0.3, 4).unwrap(), "all orders");
        assert_eq!(curve.frame(0.3).unwrap(), polynomial.frame(0.3).unwrap(), "frame");
        let lost = RationalBezier::new(vec![1.0, 2.0], vec![1e-300, 1e300]).unwrap();
        assert_eq!(lost.derivatives(0.0, 1).unwrap_err().name(), "Degenerate", "a weight that underflows");
    }
}
