//! Points of a curve whose polygon is within a tolerance at equal parameters, rational or not.
//!
//! The Bezier pieces are halved until the bound of [`RationalBezier::chord_bound`] is no larger than the tolerance. Course: beyond, section B.8.

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::rational_bezier::{Projective, RationalBezier};
use crate::core::spline_curve::curve_intersection::{as_spline_error, check_tolerance};
use crate::core::spline_curve::{Nurbs, Tessellation};

/// Halvings of one piece.
const MAX_DEPTH: usize = 30;

impl<P: Projective> Nurbs<P> {
    /// Points of the curve over D, or over one period, between which the straight polygon, as a function of the parameter, is within `tolerance`; both ends
    /// and all breaks are among them.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` where 30 halvings of a piece are not enough; `NonFinite` or `WeightNotPositive` where a Bezier form leaves the range of
    /// numbers.
    pub fn chord_polygon(&self, tolerance: f64) -> Result<Tessellation<P>, SplineError> {
        check_tolerance(tolerance)?;
        let mut polygon = Tessellation { parameters: Vec::new(), points: Vec::new(), bound: 0.0 };
        for piece in self.rational_bezier_curves().map_err(as_spline_error)? {
            if polygon.points.is_empty() {
                polygon.parameters.push(piece.interval().0);
                polygon.points.push(piece.points()[0]);
            }
            let mut stack: Vec<(RationalBezier<P>, usize)> = vec![(piece, 0)];
            while let Some((part, depth)) = stack.pop() {
                let ((a, b), bound) = (part.interval(), part.chord_bound());
                if bound <= tolerance {
                    polygon.bound = polygon.bound.max(bound);
                    polygon.parameters.push(b);
                    polygon.points.push(part.points()[part.degree()]);
                    continue;
                }
                if depth == MAX_DEPTH {
                    let (value, limit) = (MAX_DEPTH + 1, MAX_DEPTH);
                    return Err(SplineError::StepLimit { what: "halvings of a piece", value, limit });
                }
                let (left, right) = part.split(a.mix(b, 0.5)).map_err(as_spline_error)?;
                stack.push((right, depth + 1));
                stack.push((left, depth + 1));
            }
        }
        Ok(polygon)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn the_polygon_is_within_the_tolerance_at_equal_parameters(curve in any_curve(1..=6), digits in 1.0..4.0_f64, share in 0.0..=1.0_f64) {
            let tolerance = 0.1_f64.powf(digits);
            let polygon = curve.chord_polygon(tolerance).unwrap();
            prop_assert!(polygon.bound <= tolerance, "{}", polygon.bound);
            prop_assert!(polygon.parameters.windows(2).all(|pair| pair[0] < pair[1]), "increasing");
            for (&t, &point) in polygon.parameters.iter().zip(&polygon.points) {
                prop_assert!(curve.evaluate(t).unwrap().distance(point) < 1e-9, "{t}: {point} is on the curve");
            }
            for i in 0..polygon.points.len() - 1 {
                let at = |values: &[f64]| values[i].mix(values[i + 1], share);
                let chord = polygon.points[i].mix(polygon.points[i + 1], share);
                let distance = curve.evaluate(at(&polygon.parameters)).unwrap().distance(chord);
                prop_assert!(distance <= tolerance + 1e-9, "chord {i}: {distance}");
            }
        }
    }

    #[test]
    fn a_circle_needs_as_many_chords_as_the_root_of_the_tolerance_says() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let count = |tolerance: f64| circle.chord_polygon(tolerance).unwrap().points.len() as f64;
        let ratio = count(1e-8) / count(1e-6);
        assert!((7.0..14.0).contains(&ratio), "10 is expected, not {ratio}");
        assert_eq!(circle.chord_polygon(f64::NAN).unwrap_err().name(), "InvalidTolerance", "NaN");
        assert_eq!(circle.chord_polygon(1e-300).unwrap_err().name(), "StepLimit", "too small");
    }
}
