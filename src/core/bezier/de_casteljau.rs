//! De Casteljau's algorithm: `p⁰ₖ = cₖ`, `pᵐ⁺¹ₖ = (1 − t) pᵐₖ + t pᵐₖ₊₁`, `p(t) = pⁿ₀`.
//!
//! With another parameter in every step it gives the blossom, which is symmetric and affine in each of them.
//! P. de Casteljau, 1959. Course: section 2.3.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::triangular_scheme::TriangularScheme;

impl<P: Point> BezierCurve<P> {
    /// The triangular scheme at `t`; entry `k` of level `m` is `pᵐₖ`.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `t` is not finite.
    pub fn de_casteljau_scheme(&self, t: f64) -> Result<TriangularScheme<P>, BezierError> {
        self.scheme_of(&vec![t; self.degree()])
    }

    /// The scheme with parameter `parameters[m]` in step `m`; its result is the blossom.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `n` parameters; `NonFinite` with the index of the parameter.
    pub fn scheme_of(&self, parameters: &[f64]) -> Result<TriangularScheme<P>, BezierError> {
        if parameters.len() != self.degree() {
            let (expected, found) = (self.degree(), parameters.len());
            return Err(BezierError::SizeMismatch { what: "list of parameters", index: 0, expected, found });
        }
        if let Some(index) = parameters.iter().position(|parameter| !parameter.is_finite()) {
            return Err(BezierError::NonFinite { what: "parameter", index, value: parameters[index] });
        }
        Ok(TriangularScheme::run(self.points().to_vec(), self.degree(), |step, _| parameters[step]))
    }

    /// The blossom `b[t₁, …, tₙ]`; with equal arguments `p(t)`.
    ///
    /// # Errors
    ///
    /// Those of [`Self::scheme_of`].
    pub fn blossom(&self, arguments: &[f64]) -> Result<P, BezierError> {
        let scheme = self.scheme_of(arguments)?;
        Ok(scheme.result().unwrap_or(self.points()[0]))
    }

    /// `p(t)` by nested multiplication of the Bernstein form: `n` steps instead of `n(n+1)/2`, a little less accurate.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `t` is not finite.
    pub fn evaluate_nested(&self, t: f64) -> Result<P, BezierError> {
        if !t.is_finite() {
            return Err(BezierError::NonFinite { what: "parameter", index: 0, value: t });
        }
        // From the nearer end the quotient of t and 1 − t stays at most 1 in modulus on [0, 1].
        let n = self.degree();
        let forward = t <= 0.5;
        let (near, far) = if forward { (t, 1.0 - t) } else { (1.0 - t, t) };
        let point = |k: usize| self.points()[if forward { k } else { n - k }];
        let quotient = near / far;
        let mut binomial = 1.0;
        let mut power = 1.0;
        let mut sum = point(0);
        for k in 1..=n {
            binomial *= (n + 1 - k) as f64 / k as f64;
            power *= quotient;
            sum = sum + point(k) * (binomial * power);
        }
        Ok(sum * far.powi(n as i32))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_blossom_is_symmetric_and_affine(
            points in prop::collection::vec(-10.0..10.0_f64, 4),
            a in -1.0..2.0_f64,
            b in -1.0..2.0_f64,
            c in -1.0..2.0_f64,
            share in 0.0..1.0_f64,
        ) {
            let curve = BezierCurve::new(points).unwrap();
            let value = |arguments: [f64; 3]| curve.blossom(&arguments).unwrap();
            prop_assert!((value([a, b, c]) - value([c, a, b])).abs() < 1e-11, "order of arguments");
            let mixed = value([a * (1.0 - share) + b * share, c, c]);
            let mean = value([a, c, c]) * (1.0 - share) + value([b, c, c]) * share;
            prop_assert!((mixed - mean).abs() < 1e-11, "affine: {mixed} and {mean}");
            prop_assert!((value([a, a, a]) - curve.evaluate(a).unwrap()).abs() < 1e-11, "diagonal");
        }

        #[test]
        fn nested_evaluation_agrees(points in prop::collection::vec(-10.0..10.0_f64, 1..20), t in 0.0..=1.0_f64) {
            let curve = BezierCurve::new(points).unwrap();
            let (slow, nested) = (curve.evaluate(t).unwrap(), curve.evaluate_nested(t).unwrap());
            prop_assert!((slow - nested).abs() < 1e-11, "{slow} and {nested} at {t}");
        }
    }

    #[test]
    fn corner_values_of_the_blossom_are_the_control_points() {
        let points = vec![3.0, -1.0, 4.0, 1.5];
        let curve = BezierCurve::new(points.clone()).unwrap();
        for (k, &point) in points.iter().enumerate() {
            let arguments: Vec<f64> = (0..3).map(|i| f64::from(u8::from(i >= 3 - k))).collect();
            assert_eq!(curve.blossom(&arguments).unwrap(), point, "b[0,…,1,…] with {k} ones");
        }
    }
}
