//! Split, restricted and degree-elevated rational curves: the polynomial algorithms on the homogeneous curve.
//!
//! Course: section 3.3.

use crate::core::bezier::BezierCurve;
use crate::core::rational_bezier::error::RationalBezierError;
use crate::core::rational_bezier::{Projective, RationalBezier};

impl<P: Projective> RationalBezier<P> {
    /// The parts over `[a, x]` and `[x, b]`; they share point and weight bit for bit, and their weights are positive.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` unless `a < x < b`; `WeightNotPositive` where a weight underflows.
    pub fn split(&self, x: f64) -> Result<(Self, Self), RationalBezierError> {
        if self.has_equal_weights() {
            let (left, right) = self.without_weights().split(x)?;
            return Ok((self.equally_weighted(&left)?, self.equally_weighted(&right)?));
        }
        let (left, right) = self.homogeneous().0.split(x)?;
        Ok((self.lowered(&left)?, self.lowered(&right)?))
    }

    /// The curve over `[from, to]`, a part of this one or its extrapolation.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval`; `WeightNotPositive` where an extrapolation meets a pole.
    pub fn restricted(&self, from: f64, to: f64) -> Result<Self, RationalBezierError> {
        if self.has_equal_weights() {
            return self.equally_weighted(&self.without_weights().restricted(from, to)?);
        }
        self.lowered(&self.homogeneous().0.restricted(from, to)?)
    }

    /// The same curve with `times` control points more.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive` where a weight underflows.
    pub fn elevate_degree_by(&self, times: usize) -> Result<Self, RationalBezierError> {
        if self.has_equal_weights() {
            return self.equally_weighted(&self.without_weights().elevate_degree_by(times));
        }
        self.lowered(&self.homogeneous().0.elevate_degree_by(times))
    }

    fn equally_weighted(&self, curve: &BezierCurve<P>) -> Result<Self, RationalBezierError> {
        let weights = vec![self.weights()[0]; curve.points().len()];
        Self::on_interval(curve.points().to_vec(), weights, curve.interval())
    }

    /// The rational curve of a homogeneous one made from ours; end points that it kept stay as they were given.
    fn lowered(&self, curve: &BezierCurve<P::Homogeneous>) -> Result<Self, RationalBezierError> {
        let (homogeneous, exponent) = self.homogeneous();
        let old = homogeneous.points();
        let lowered = Self::from_homogeneous(curve, -exponent)?;
        let (mut points, mut weights) = (lowered.points().to_vec(), lowered.weights().to_vec());
        for (place, lifted) in curve.points().iter().enumerate() {
            if let Some(k) = [0, old.len() - 1].into_iter().find(|&k| old[k] == *lifted) {
                (points[place], weights[place]) = (self.points()[k], self.weights()[k]);
            }
        }
        Self::on_interval(points, weights, curve.interval())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::point::Point as _;
    use crate::core::rational_bezier::curve::tests::curves;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn parts_and_elevations_are_the_curve(curve in curves(), s in 0.05..0.95_f64, t in 0.0..=1.0_f64, times in 0_usize..4) {
            let x = (-1.0).mix(2.0, s);
            let (left, right) = curve.split(x).unwrap();
            let n = curve.degree();
            prop_assert_eq!(left.points()[n], right.points()[0], "shared point");
            prop_assert_eq!(left.weights()[n], right.weights()[0], "shared weight");
            prop_assert_eq!(left.points()[0], curve.points()[0], "first point");
            let part = curve.restricted((-1.0).mix(x, 0.3), x).unwrap();
            let raised = curve.elevate_degree_by(times).unwrap();
            prop_assert_eq!(raised.degree(), n + times, "degree");
            for other in [&left, &right, &part, &raised] {
                let at = other.interval().0.mix(other.interval().1, t);
                let gap = (other.evaluate(at).unwrap() - curve.evaluate(at).unwrap()).length();
                prop_assert!(gap < 1e-11, "off by {gap}");
                prop_assert!(other.weights().iter().all(|&w| w > 0.0), "positive weights");
            }
        }
    }

    #[test]
    fn extrapolation_stops_at_a_pole() {
        let curve = RationalBezier::new(vec![0.0, 1.0, 5.0], vec![4.0, 4.0, 3.0]).unwrap();
        assert!(curve.restricted(0.0, 1.9).is_ok(), "before the pole at 2");
        assert_eq!(curve.restricted(0.0, 2.0).unwrap_err().name(), "WeightNotPositive", "at the pole");
        assert_eq!(curve.split(1.0).unwrap_err().name(), "OutsideInterval", "at the end");
        let heavy = RationalBezier::new(vec![0.0, 1.0], vec![3e300, 1e300]).unwrap();
        assert_eq!(heavy.split(0.5).unwrap().0.weights(), [3e300, 2e300], "weights keep their scale");
    }
}
