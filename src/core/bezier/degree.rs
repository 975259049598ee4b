//! Degree elevation: `c′ₖ = (k/(n+1)) cₖ₋₁ + (1 − k/(n+1)) cₖ`, `k = 0 … n+1`; the curve stays. Course: section 2.3.

use crate::core::bezier::curve::BezierCurve;
use crate::core::point::Point;

impl<P: Point> BezierCurve<P> {
    /// The same curve with `times` control points more.
    #[must_use]
    pub fn elevated(&self, times: usize) -> Self {
        let mut points = self.points().to_vec();
        for _ in 0..times {
            let count = points.len();
            let last = points[count - 1];
            for k in (1..count).rev() {
                points[k] = points[k].mix(points[k - 1], k as f64 / count as f64);
            }
            points.push(last);
        }
        // Convex combinations of finite points are finite.
        Self { points }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn elevation_keeps_the_curve(
            points in prop::collection::vec(-10.0..10.0_f64, 1..10),
            times in 0..6_usize,
            t in 0.0..=1.0_f64,
        ) {
            let curve = BezierCurve::new(points).unwrap();
            let raised = curve.elevated(times);
            prop_assert_eq!(raised.degree(), curve.degree() + times, "degree");
            let difference = raised.evaluate(t).unwrap() - curve.evaluate(t).unwrap();
            prop_assert!(difference.abs() < 1e-12, "{difference} at {t}");
        }
    }

    #[test]
    fn two_elevations_of_a_quadratic_give_the_points_of_the_course() {
        let raised = BezierCurve::new(vec![0.0, 2.0, 0.0]).unwrap().elevated(2);
        for (got, expected) in raised.points().iter().zip([0.0, 1.0, 4.0 / 3.0, 1.0, 0.0]) {
            assert!((got - expected).abs() < 1e-15, "{:?}", raised.points());
        }
    }
}
