//! Many points of a curve at once. Course: section 6.1.

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Projective> Nurbs<P> {
    /// `out[i] = r(ts[i])`, without allocating; quickest for sorted parameters.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless both slices are of the same length, `NonFinite` with the index of the parameter, `OutsideInterval`. What
    /// stands in `out` then is unspecified.
    pub fn evaluate_into(&self, ts: &[f64], out: &mut [P]) -> Result<(), SplineError> {
        if self.is_polynomial() {
            return self.without_weights().evaluate_into(ts, out);
        }
        if ts.len() != out.len() {
            return Err(SplineError::SizeMismatch { what: "values", expected: ts.len(), found: out.len() });
        }
        let mut slots = out.iter_mut();
        self.homogeneous().for_each_value(ts, |value| {
            if let Some(slot) = slots.next() {
                *slot = P::project(value).0;
            }
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use glam::DVec2;

    use super::*;

    #[test]
    fn points_of_a_circle_lie_on_it() {
        let circle = Nurbs::circle(DVec2::new(1.0, 2.0), 3.0).unwrap();
        let (a, b) = circle.space().parameter_interval();
        let ts: Vec<f64> = (0..=100).map(|i| a + (b - a) * f64::from(i) / 100.0).collect();
        let mut points = vec![DVec2::ZERO; ts.len()];
        circle.evaluate_into(&ts, &mut points).unwrap();
        for (t, point) in ts.iter().zip(&points) {
            assert!((point.distance(DVec2::new(1.0, 2.0)) - 3.0).abs() < 1e-14, "t = {t}: {point}");
            assert!(point.distance(circle.evaluate(*t).unwrap()) < 1e-14, "t = {t}: {point}");
        }
    }
}
