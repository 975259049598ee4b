//! Polylines within a tolerance of a rational curve.
//!
//! With positive weights a part lies in the convex hull of its control points. If these are within the tolerance of the chord, so is the part; and since the
//! part runs from one end of the chord to the other, the chord is as near to the part: the distance of both point sets (Hausdorff) is at most the
//! tolerance. Course: section 3.3.

use crate::core::bezier::{BezierCurve, TessellationPoint};
use crate::core::point::Point as _;
use crate::core::rational_bezier::error::RationalBezierError;
use crate::core::rational_bezier::{Projective, RationalBezier};
use crate::core::triangular_scheme::collapse_both;

/// Most halvings of one part.
const MAX_DEPTH: usize = 40;

impl<P: Projective> RationalBezier<P> {
    /// Points of the curve, both ends among them, whose polyline is within `tolerance` of the curve as a point set, and the other way round.
    ///
    /// Halves parts at the middle of their parameters until the control points are near the chord. Of a polynomial curve
    /// [`BezierCurve::tessellate`] also bounds the distance at equal parameters.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if 40 halvings of one part are not enough; `Degenerate` where weights underflow.
    pub fn tessellate(&self, tolerance: f64) -> Result<Vec<TessellationPoint<P>>, RationalBezierError> {
        use crate::core::bezier::BezierError;
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(BezierError::InvalidTolerance { value: tolerance }.into());
        }
        let ((a, b), n) = (self.interval(), self.degree());
        let mut found = vec![TessellationPoint { parameter: a, point: self.points()[0] }];
        let mut waiting = vec![(0.0, 1.0, 0, self.homogeneous().0.points().to_vec())];
        while let Some((low, high, depth, mut lifted)) = waiting.pop() {
            let points: Vec<P> = lifted.iter().map(|&point| P::project(point).0).collect();
            if points.iter().any(|point| !point.is_finite()) {
                return Err(RationalBezierError::Degenerate {
                    what: "a control point",
                    value: a.mix(b, low),
                });
            }
            if points.iter().all(|&point| distance_from_segment(point, points[0], points[n]) <= tolerance) {
                let end = if high == 1.0 { self.points()[n] } else { points[n] };
                found.push(TessellationPoint { parameter: a.mix(b, high), point: end });
                continue;
            }
            if depth == MAX_DEPTH {
                let (value, limit) = (MAX_DEPTH + 1, MAX_DEPTH);
                return Err(BezierError::StepLimit { what: "halvings of a part", value, limit }.into());
            }
            let middle = 0.5 * (low + high);
            let mut first = lifted.clone();
            collapse_both(&mut lifted, 0.5, &mut first);
            waiting.push((middle, high, depth + 1, lifted));
            waiting.push((low, middle, depth + 1, first));
        }
        Ok(found)
    }
}

/// Distance of `point` from the segment with the ends `a` and `b`.
fn distance_from_segment<P: Projective>(point: P, a: P, b: P) -> f64 {
    let dot = |p: P, q: P| (0..P::DIMENSION).map(|i| p.coordinate(i) * q.coordinate(i)).sum::<f64>();
    let (way, chord) = (point - a, b - a);
    let length = chord.norm();
    if length <= 0.0 {
        return way.norm();
    }
    let direction = chord * length.recip();
    (way - direction * dot(way, direction).clamp(0.0, length)).norm()
}

impl<P: Projective> From<&BezierCurve<P>> for RationalBezier<P> {
    fn from(curve: &BezierCurve<P>) -> Self {
        Self::polynomial(curve)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::circle;
    use crate::core::rational_bezier::curve::tests::curves;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn curve_and_polyline_are_within_the_tolerance_of_each_other(curve in curves(), digits in 0_i32..4) {
            let tolerance = 10.0_f64.powi(-digits);
            let line = curve.tessellate(tolerance).unwrap();
            prop_assert_eq!(line[0].point, curve.points()[0], "begins");
            prop_assert_eq!(line[line.len() - 1].point, curve.points()[curve.degree()], "ends");
            for pair in line.windows(2) {
                let part = curve.restricted(pair[0].parameter, pair[1].parameter).unwrap();
                for i in 0..=8 {
                    let share = f64::from(i) / 8.0;
                    let point = curve.evaluate(pair[0].parameter.mix(pair[1].parameter, share)).unwrap();
                    let gap = distance_from_segment(point, pair[0].point, pair[1].point);
                    prop_assert!(gap <= tolerance * (1.0 + 1e-9) + 1e-13, "curve: {gap} above {tolerance}");
                    let foot = part.closest_point(pair[0].point.mix(pair[1].point, share)).unwrap();
                    prop_assert!(foot.distance <= tolerance * (1.0 + 1e-9) + 1e-13, "chord: {} above {tolerance}", foot.distance);
                }
            }
        }
    }

    #[test]
    fn circles_need_as_many_points_as_their_sagitta_says() {
        let arc = &circle(DVec2::ZERO, 1.0, 2, 4).unwrap()[0];
        let line = arc.tessellate(1e-6).unwrap();
        // A chord of the angle φ is 1 − cos φ/2 away at most; control points are twice as far.
        let least = std::f64::consts::FRAC_PI_2 / (2.0 * (1.0 - 1e-6_f64).acos());
        assert!(line.len() as f64 > least && (line.len() as f64) < 4.0 * least, "{} points", line.len());
        assert_eq!(arc.tessellate(0.0).unwrap_err().name(), "InvalidTolerance", "zero");
        assert_eq!(arc.tessellate(1e-30).unwrap_err().name(), "StepLimit", "below rounding");
    }
}
