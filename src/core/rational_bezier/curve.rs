//! Rational Bezier curves `r = Σ wₖ cₖ bⁿₖ / Σ wₖ bⁿₖ` with positive weights.
//!
//! Points and weights are kept exactly as given. Algorithms run on the homogeneous curve `(wₖ cₖ, wₖ)`, multiplied by a power of two near
//! `1/max w` that no result depends on, and divide at the end. Course: sections 3.1 and 3.2.

use crate::core::bezier::{BezierCurve, BezierError};
use crate::core::point::Point as _;
use crate::core::polynomial::bernstein_values;
use crate::core::rational_bezier::Projective;
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::triangular_scheme::{TriangularScheme, collapse};

/// A rational curve over an interval, given by its control points and positive weights.
///
/// It lies in the convex hull of its control points, begins in the first and ends in the last one; a common factor of the weights changes
/// nothing, a growing weight pulls the curve to its point.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::rational_bezier::RationalBezier;
///
/// let quarter = RationalBezier::new(vec![DVec2::X, DVec2::ONE, DVec2::Y], vec![1.0, 1.0, 2.0])?;
/// assert_eq!(quarter.evaluate(0.5)?, DVec2::new(0.6, 0.8));
/// assert!((quarter.curvature(0.3)? - 1.0).abs() < 1e-14);
/// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RationalBezier<P: Projective> {
    points: BezierCurve<P>,
    weights: Vec<f64>,
    /// Control points `2^exponent (wₖ cₖ, wₖ)`.
    homogeneous: BezierCurve<P::Homogeneous>,
    exponent: i32,
}

impl<P: Projective> RationalBezier<P> {
    /// The curve over `[0, 1]`.
    ///
    /// # Errors
    ///
    /// `Empty`; `SizeMismatch` unless there is a weight for each point; `NonFinite`, `WeightNotPositive` with the index;
    /// `NonFinite` also where weight times point overflows although the largest weight is scaled to about 1.
    pub fn new(points: Vec<P>, weights: Vec<f64>) -> Result<Self, RationalBezierError> {
        Self::on_interval(points, weights, (0.0, 1.0))
    }

    /// The curve over `[a, b]`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; `NonFinite`, `EmptyInterval` for the interval.
    pub fn on_interval(
        points: Vec<P>,
        weights: Vec<f64>,
        interval: (f64, f64),
    ) -> Result<Self, RationalBezierError> {
        let (expected, found) = (points.len(), weights.len());
        if expected != found && expected > 0 {
            return Err(RationalBezierError::SizeMismatch { what: "weights", expected, found });
        }
        let points = BezierCurve::on_interval(points, interval)?;
        check_finite("weight", &weights)?;
        if let Some(index) = weights.iter().position(|&weight| weight <= 0.0) {
            return Err(RationalBezierError::WeightNotPositive { index, value: weights[index] });
        }
        let largest = weights.iter().copied().fold(0.0, f64::max);
        let exponent = -(largest.log2() as i32).clamp(-1000, 1000);
        let scale = 2.0_f64.powi(exponent);
        let lifted = points.points().iter().zip(&weights).map(|(point, w)| point.lift(w * scale)).collect();
        let homogeneous = BezierCurve::on_interval(lifted, interval)?;
        Ok(Self { points, weights, homogeneous, exponent })
    }

    /// The polynomial curve: all weights 1.
    pub fn polynomial(curve: &BezierCurve<P>) -> Self {
        let weights = vec![1.0; curve.points().len()];
        let lifted = curve.transformed(|point| point.lift(1.0));
        let homogeneous = lifted.expect("a point with the weight 1 is as finite as without");
        Self { points: curve.clone(), weights, homogeneous, exponent: 0 }
    }

    /// The curve whose homogeneous form is `2^exponent` times `homogeneous`.
    pub(super) fn from_homogeneous(
        homogeneous: &BezierCurve<P::Homogeneous>,
        exponent: i32,
    ) -> Result<Self, RationalBezierError> {
        let factor = 2.0_f64.powi(exponent);
        let split = |&point: &P::Homogeneous| {
            let (point, weight) = P::project(point);
            (point, weight * factor)
        };
        let (points, weights): (Vec<P>, Vec<f64>) = homogeneous.points().iter().map(split).unzip();
        // A weight that vanished leaves a point that is none: name the weight.
        if let Some(index) = weights.iter().position(|&weight| weight <= 0.0) {
            return Err(RationalBezierError::WeightNotPositive { index, value: weights[index] });
        }
        Self::on_interval(points, weights, homogeneous.interval())
    }

    /// The control points, as given.
    pub fn points(&self) -> &[P] {
        self.points.points()
    }

    /// The weights, as given.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The interval `(a, b)`, `a < b`.
    pub fn interval(&self) -> (f64, f64) {
        self.points.interval()
    }

    /// The degree, one less than the number of control points.
    pub fn degree(&self) -> usize {
        self.points.degree()
    }

    /// The polynomial curve of the control points without the weights; the curve itself if [`Self::has_equal_weights`].
    pub fn without_weights(&self) -> &BezierCurve<P> {
        &self.points
    }

    /// Whether all weights are the same number, so that the curve is polynomial as it stands.
    pub fn has_equal_weights(&self) -> bool {
        self.weights.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits())
    }

    /// The homogeneous curve with the control points `2ᵉ (wₖ cₖ, wₖ)`, and the exponent `e`, near `−log₂ max w`.
    pub fn homogeneous(&self) -> (&BezierCurve<P::Homogeneous>, i32) {
        (&self.homogeneous, self.exponent)
    }

    /// `r(x)`; at `a` and `b` the end points bit for bit. Other parameters extrapolate.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` where the denominator vanishes, which only happens outside the interval or where weights underflow.
    pub fn evaluate(&self, x: f64) -> Result<P, RationalBezierError> {
        if self.has_equal_weights() {
            return Ok(self.points.evaluate(x)?);
        }
        let t = self.local_parameter(x)?;
        self.projected_value(x, t, || collapse(&mut self.homogeneous.points().to_vec(), t))
    }

    /// Writes the points at the parameters `xs` into `values`; one allocation for all of them.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there is a place for each parameter; those of [`Self::evaluate`].
    pub fn write_values(&self, xs: &[f64], values: &mut [P]) -> Result<(), RationalBezierError> {
        let (expected, found) = (xs.len(), values.len());
        if expected != found {
            return Err(RationalBezierError::SizeMismatch { what: "places for values", expected, found });
        }
        if self.has_equal_weights() {
            return Ok(self.points.write_values(xs, values)?);
        }
        let mut scratch = self.homogeneous.points().to_vec();
        for (&x, value) in xs.iter().zip(values) {
            scratch.copy_from_slice(self.homogeneous.points());
            let t = self.local_parameter(x)?;
            *value = self.projected_value(x, t, || collapse(&mut scratch, t))?;
        }
        Ok(())
    }

    /// The point at `x` with the local parameter `t`, whose homogeneous point is `lifted()`; at the ends the end points as given.
    fn projected_value(
        &self,
        x: f64,
        t: f64,
        lifted: impl FnOnce() -> P::Homogeneous,
    ) -> Result<P, RationalBezierError> {
        if t == 0.0 || t == 1.0 {
            return Ok(self.points()[if t == 0.0 { 0 } else { self.degree() }]);
        }
        let (point, weight) = P::project(lifted());
        if weight == 0.0 || !point.is_finite() {
            return Err(RationalBezierError::Degenerate { what: "the point", value: x });
        }
        Ok(point)
    }

    /// De Casteljau's scheme of the homogeneous points `(wₖ cₖ, wₖ)` at `x`; the projected apex is the point.
    ///
    /// # Errors
    ///
    /// `NonFinite`, also where a weight times a point overflows.
    pub fn de_casteljau_scheme(
        &self,
        x: f64,
    ) -> Result<TriangularScheme<P::Homogeneous>, RationalBezierError> {
        let factor = 2.0_f64.powi(-self.exponent);
        let scheme = self.homogeneous.de_casteljau_scheme(x)?.map(|point| point * factor);
        let first = &scheme.levels()[0];
        if let Some(index) = first.iter().position(|point| !point.is_finite()) {
            let value = first[index].norm();
            return Err(RationalBezierError::NonFinite { what: "homogeneous point", index, value });
        }
        Ok(scheme)
    }

    /// The rational basis `wₖ bⁿₖ(x)/Σ wₗ bⁿₗ(x)`: sum 1, and nonnegative in the interval.
    ///
    /// # Errors
    ///
    /// As [`Self::evaluate`].
    pub fn basis(&self, x: f64) -> Result<Vec<f64>, RationalBezierError> {
        let (values, denominator) = self.weighted_basis(x)?;
        Ok(values.into_iter().map(|value| value / denominator).collect())
    }

    /// How the point at `x` moves with weight `k`: `∂r/∂wₖ = (cₖ − r) bⁿₖ/q`, along the line to the control point.
    ///
    /// # Errors
    ///
    /// As [`Self::evaluate`]; `SizeMismatch` if there is no such weight, `Degenerate` where the quotient overflows.
    pub fn weight_derivative(&self, x: f64, k: usize) -> Result<P, RationalBezierError> {
        let Some((&point, weight)) = self.points().get(k).zip(self.weights.get(k)) else {
            let (expected, found) = (k + 1, self.weights.len());
            return Err(RationalBezierError::SizeMismatch { what: "weights", expected, found });
        };
        let (values, denominator) = self.weighted_basis(x)?;
        let motion = (point - self.evaluate(x)?) * (values[k] / denominator / weight);
        if !motion.is_finite() {
            return Err(RationalBezierError::Degenerate { what: "the weight derivative", value: x });
        }
        Ok(motion)
    }

    /// `wₖ bⁿₖ(x)` and their sum, scaled.
    fn weighted_basis(&self, x: f64) -> Result<(Vec<f64>, f64), RationalBezierError> {
        let t = self.local_parameter(x)?;
        let scale = 2.0_f64.powi(self.exponent);
        let mut values = bernstein_values(self.degree(), t);
        values.iter_mut().zip(&self.weights).for_each(|(value, weight)| *value *= weight * scale);
        let sum: f64 = values.iter().sum();
        if sum == 0.0 || !sum.is_finite() {
            return Err(RationalBezierError::Degenerate { what: "the rational basis", value: x });
        }
        Ok((values, sum))
    }

    pub(super) fn local_parameter(&self, x: f64) -> Result<f64, RationalBezierError> {
        if !x.is_finite() {
            return Err(BezierError::NonFinite { what: "parameter", index: 0, value: x }.into());
        }
        let (a, b) = self.interval();
        Ok((x - a) / (b - a))
    }

    /// The curve with every control point mapped and the weights kept; an affine map maps every point of the curve alike.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the index of the first control point that is mapped to no point.
    pub fn transformed<Q: Projective>(
        &self,
        map: impl Fn(P) -> Q,
    ) -> Result<RationalBezier<Q>, RationalBezierError> {
        let points = self.points().iter().map(|&point| map(point)).collect();
        RationalBezier::on_interval(points, self.weights.clone(), self.interval())
    }

    /// The image of the curve under a projective map, given as a linear map of homogeneous points `(w·c, w)`; it changes the weights.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive` with the first control point that is mapped to infinity or beyond; `NonFinite`.
    pub fn projected(
        &self,
        map: impl Fn(P::Homogeneous) -> P::Homogeneous,
    ) -> Result<Self, RationalBezierError> {
        Self::from_homogeneous(&self.homogeneous.transformed(map)?, -self.exponent)
    }

    /// The same points of the curve in the opposite direction, over the same interval.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            points: self.points.reversed(),
            weights: self.weights.iter().rev().copied().collect(),
            homogeneous: self.homogeneous.reversed(),
            exponent: self.exponent,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use glam::{DMat3, DVec2};
    use proptest::prelude::*;

    /// Curves of degree 0 to 6 in the plane with weights between 1/8 and 8.
    pub(in crate::core::rational_bezier) fn curves() -> impl Strategy<Value = RationalBezier<DVec2>> {
        let corner = (-4.0..4.0_f64, -4.0..4.0_f64, -3.0..3.0_f64);
        prop::collection::vec(corner, 1..8).prop_map(|corners| {
            let (points, weights) = corners.iter().map(|&(x, y, w)| (DVec2::new(x, y), w.exp2())).unzip();
            RationalBezier::on_interval(points, weights, (-1.0, 2.0)).unwrap()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_curve_is_a_convex_combination_that_ignores_a_common_factor(curve in curves(), x in -1.0..=2.0_f64, power in -900_i32..900) {
            let point = curve.evaluate(x).unwrap();
            let basis = curve.basis(x).unwrap();
            prop_assert!((basis.iter().sum::<f64>() - 1.0).abs() < 1e-14, "sum");
            prop_assert!(basis.iter().all(|&value| value >= 0.0), "nonnegative");
            let sum = basis.iter().zip(curve.points()).fold(DVec2::ZERO, |sum, (&b, &c)| sum + c * b);
            prop_assert!((sum - point).length() < 1e-13, "{sum} and {point}");
            let weights = curve.weights().iter().map(|w| w * 2.0_f64.powi(power)).collect();
            let other = RationalBezier::on_interval(curve.points().to_vec(), weights, (-1.0, 2.0)).unwrap();
            prop_assert_eq!(other.evaluate(x).unwrap(), point, "a common factor");
            let scheme = curve.de_casteljau_scheme(x).unwrap().result().unwrap();
            prop_assert!((DVec2::project(scheme).0 - point).length() < 1e-13, "scheme");
            let mut batch = [DVec2::ZERO; 3];
            curve.write_values(&[-1.0, x, 2.0], &mut batch).unwrap();
            prop_assert_eq!(batch, [curve.points()[0], point, curve.points()[curve.degree()]], "at once");
        }

        #[test]
        fn affine_maps_keep_the_weights_projective_maps_change_them(
            curve in curves(), m in prop::collection::vec(-1.0..1.0_f64, 8), x in -1.0..=2.0_f64,
        ) {
            let map = |p: DVec2| DVec2::new(m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]);
            let point = curve.evaluate(x).unwrap();
            let image = curve.transformed(map).unwrap();
            prop_assert!((image.evaluate(x).unwrap() - map(point)).length() < 1e-12, "affine");
            // Positive for |x|, |y| < 4.
            let bottom = (0.1 * m[6], 0.1 * m[7], 1.0);
            let matrix = DMat3::from_cols_array(&[m[0], m[3], bottom.0, m[1], m[4], bottom.1, m[2], m[5], bottom.2]);
            let image = curve.projected(|h| matrix * h).unwrap();
            let exact = map(point) / (bottom.0 * point.x + bottom.1 * point.y + bottom.2);
            prop_assert!((image.evaluate(x).unwrap() - exact).length() < 1e-11, "projective");
        }

        #[test]
        fn a_weight_moves_its_point_along_a_line(curve in curves(), x in -0.9..1.9_f64, share in 0.0..1.0_f64) {
            let k = (share * curve.weights().len() as f64) as usize;
            let motion = curve.weight_derivative(x, k).unwrap();
            let with = |w: f64| {
                let mut weights = curve.weights().to_vec();
                weights[k] = w;
                RationalBezier::on_interval(curve.points().to_vec(), weights, (-1.0, 2.0)).unwrap().evaluate(x).unwrap()
            };
            let h = 1e-5 * curve.weights()[k];
            let quotient = (with(curve.weights()[k] + h) - with(curve.weights()[k] - h)) / (2.0 * h);
            prop_assert!((quotient - motion).length() < 1e-6 * (1.0 + motion.length()), "{quotient} for {motion}");
            let way = curve.points()[k] - curve.evaluate(x).unwrap();
            let off = way.perp_dot(curve.points()[k] - with(1000.0));
            prop_assert!(off.abs() < 1e-11, "off the line by {off}");
            prop_assert!((with(1e14) - curve.points()[k]).length() < 1e-3 || !(-0.85..=1.85).contains(&x), "the limit is the point");
        }

        #[test]
        fn equal_weights_and_opposite_directions(points in prop::collection::vec(-4.0..4.0_f64, 1..8), w in 0.1..9.0_f64, t in 0.0..=1.0_f64) {
            let polynomial = BezierCurve::new(points.clone()).unwrap();
            let curve = RationalBezier::new(points.clone(), vec![w; points.len()]).unwrap();
            prop_assert_eq!(curve.evaluate(t).unwrap(), polynomial.evaluate(t).unwrap(), "polynomial");
            prop_assert_eq!(RationalBezier::polynomial(&polynomial).evaluate(t).unwrap(), polynomial.evaluate(t).unwrap(), "weights 1");
            let back = curve.reversed().evaluate(1.0 - t).unwrap();
            prop_assert!((back - curve.evaluate(t).unwrap()).abs() < 1e-13, "reversed");
        }
    }

    #[test]
    fn impossible_curves_are_named() {
        let name =
            |points: Vec<f64>, weights: Vec<f64>| RationalBezier::new(points, weights).unwrap_err().name();
        assert_eq!(name(vec![], vec![]), "Empty", "nothing");
        assert_eq!(name(vec![1.0, f64::NAN], vec![1.0]), "SizeMismatch", "sizes come first");
        assert_eq!(name(vec![1.0, f64::NAN], vec![1.0, -1.0]), "NonFinite", "NaN");
        assert_eq!(name(vec![1.0], vec![f64::INFINITY]), "NonFinite", "infinite weight");
        assert_eq!(name(vec![1.0, 2.0], vec![1.0, -0.0]), "WeightNotPositive", "minus zero");
        assert_eq!(name(vec![1.7e308, 2.0], vec![1.99, 1.0]), "NonFinite", "overflow");
        let pole = RationalBezier::new(vec![0.0, 1.0, 5.0], vec![4.0, 4.0, 3.0]).unwrap();
        assert_eq!(pole.evaluate(2.0).unwrap_err().name(), "Degenerate", "a pole");
        assert_eq!(pole.evaluate(f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
        let lost = RationalBezier::new(vec![1.0, 2.0], vec![1e-300, 1e300]).unwrap();
        assert_eq!(lost.evaluate(0.0), Ok(1.0), "the end point of a weight that underflows");
    }
}
