//! The point of a curve closest to a given point.
//!
//! With the homogeneous curve `(p, q)` moved so that the given point is the origin, the distance `|p/q|` is stationary at the zeros of
//! `q p·p′ − q′ p·p`, a polynomial whose zeros [`bernstein_zeros`] finds all. Course: section 2.6.

use crate::core::bezier::BezierCurve;
use crate::core::point::Point as _;
use crate::core::polynomial::{derivative, product_by};
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::rational_bezier::{Projective, RationalBezier};
use crate::core::root_finding::bernstein_zeros;

/// A point of a curve and its distance from a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPoint<P> {
    /// The parameter.
    pub parameter: f64,
    /// The point of the curve.
    pub point: P,
    /// Its distance.
    pub distance: f64,
}

impl<P: Projective> RationalBezier<P> {
    /// The point of the curve, over its interval, that is closest to `place`; the first of several.
    ///
    /// # Errors
    ///
    /// `NonFinite`, also where products of coordinates overflow; those of [`RationalBezier::evaluate`].
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::rational_bezier::RationalBezier;
    ///
    /// let quarter = RationalBezier::new(vec![DVec2::X, DVec2::ONE, DVec2::Y], vec![1.0, 1.0, 2.0])?;
    /// let foot = quarter.closest_point(DVec2::new(3.0, 4.0))?;
    /// assert!((foot.point - DVec2::new(0.6, 0.8)).length() < 1e-15 && (foot.distance - 4.0).abs() < 1e-15);
    /// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
    /// ```
    pub fn closest_point(&self, place: P) -> Result<FootPoint<P>, RationalBezierError> {
        let coordinates: Vec<f64> = (0..P::DIMENSION).map(|i| place.coordinate(i)).collect();
        check_finite("coordinate", &coordinates)?;
        let (a, b) = self.interval();
        let at = |t: f64| {
            let parameter = if t == 1.0 { b } else { a.mix(b, t) };
            let point = self.evaluate(parameter)?;
            Ok::<_, RationalBezierError>(FootPoint { parameter, point, distance: (point - place).norm() })
        };
        let mut best = at(0.0)?;
        for t in self.stationary_parameters(place)?.into_iter().chain([1.0]) {
            let foot = at(t)?;
            if foot.distance < best.distance {
                best = foot;
            }
        }
        Ok(best)
    }

    /// The parameters in `[0, 1]` at which the distance from `place` is stationary; none if it is constant.
    fn stationary_parameters(&self, place: P) -> Result<Vec<f64>, RationalBezierError> {
        let scale = 2.0_f64.powi(self.homogeneous().1);
        let q: Vec<f64> = self.weights().iter().map(|w| w * scale).collect();
        let p: Vec<P> = self.points().iter().zip(&q).map(|(&c, &w)| (c - place) * w).collect();
        let dot = |a: P, b: P| (0..P::DIMENSION).map(|i| a.coordinate(i) * b.coordinate(i)).sum::<f64>();
        let slope = derivative(&p).map_err(|error| RationalBezierError::Bezier(error.into()))?;
        let along = product_by(&p, &slope, dot);
        let condition = if self.has_equal_weights() {
            along
        } else {
            let change = derivative(&q).map_err(|error| RationalBezierError::Bezier(error.into()))?;
            let square = product_by(&p, &p, dot);
            let first = product_by(&q, &along, |w, value| value * w);
            let second = product_by(&change, &square, |w, value| value * w);
            first.iter().zip(&second).map(|(a, b)| a - b).collect()
        };
        check_finite("product", &condition)?;
        Ok(bernstein_zeros(&condition, 0.0).isolated().iter().map(|zero| zero.at).collect())
    }
}

impl<P: Projective> BezierCurve<P> {
    /// The point of the curve, over its interval, that is closest to `place`; the first of several.
    ///
    /// # Errors
    ///
    /// As [`RationalBezier::closest_point`].
    pub fn closest_point(&self, place: P) -> Result<FootPoint<P>, RationalBezierError> {
        RationalBezier::polynomial(self).closest_point(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::curve::tests::curves;
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn no_sample_is_closer_and_the_way_is_perpendicular(curve in curves(), place in (-6.0..6.0_f64, -6.0..6.0_f64).prop_map(DVec2::from)) {
            let foot = curve.closest_point(place).unwrap();
            prop_assert!((foot.point.distance(place) - foot.distance).abs() < 1e-14, "distance");
            for i in 0..=300 {
                let other = curve.evaluate((-1.0).mix(2.0, f64::from(i) / 300.0)).unwrap().distance(place);
                prop_assert!(foot.distance <= other + 1e-12, "{} but {other} at sample {i}", foot.distance);
            }
            if foot.parameter > -1.0 && foot.parameter < 2.0 {
                let velocity = curve.derivatives(foot.parameter, 1).unwrap()[1];
                let cosine = velocity.dot(place - foot.point);
                prop_assert!(cosine.abs() < 1e-7 * (1.0 + velocity.length_squared()), "cosine {cosine}");
            }
        }
    }

    #[test]
    fn constant_distances_and_space_curves() {
        let quarter = RationalBezier::new(vec![DVec2::X, DVec2::ONE, DVec2::Y], vec![1.0, 1.0, 2.0]).unwrap();
        let foot = quarter.closest_point(DVec2::ZERO).unwrap();
        assert!((foot.distance - 1.0).abs() < 1e-15, "from the centre all are equal: {foot:?}");
        let line = BezierCurve::new(vec![DVec3::ZERO, DVec3::X]).unwrap();
        let foot = line.closest_point(DVec3::new(0.25, 3.0, 4.0)).unwrap();
        assert_eq!((foot.parameter, foot.distance), (0.25, 5.0), "a line in space");
        let end = line.closest_point(DVec3::new(9.0, 0.0, 0.0)).unwrap();
        assert_eq!((end.parameter, end.distance), (1.0, 8.0), "beyond the end");
        assert_eq!(line.closest_point(DVec3::NAN).unwrap_err().name(), "NonFinite", "no point");
    }
}
