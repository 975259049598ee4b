//! Frames and curvature of plane curves, Frenet frames and torsion of space curves.
//!
//! `κ = det(r′, r″)/|r′|³`, positive where the curve turns left (y points up); it does not depend on the
//! parametrisation, its sign does on the direction. In space `κ = |r′ × r″|/|r′|³` and `τ = det(r′, r″, r‴)/|r′ × r″|²`; by the arc length `T′ = κ N`,
//! `N′ = −κ T + τ B`, `B′ = −τ N`. Course: sections 2.5 and 6.1, beyond, section B.7.

use glam::{DVec2, DVec3};

pub use crate::core::bezier::{Frame, OsculatingCircle, SpaceFrame};
use crate::core::bspline::{Side, SplineError};
use crate::core::spline_curve::Nurbs;

impl Nurbs<DVec2> {
    /// Point, unit tangent and normal, curvature and speed; the limits from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed is 0.
    pub fn frame(&self, t: f64, side: Side) -> Result<Frame, SplineError> {
        let derivatives = self.derivatives(t, 2, side)?;
        Frame::from_derivatives([derivatives[0], derivatives[1], derivatives[2]])
            .ok_or(SplineError::Degenerate { what: "the tangent", parameter: t })
    }

    /// Signed curvature, positive in left turns; the limit from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed is 0.
    pub fn curvature(&self, t: f64, side: Side) -> Result<f64, SplineError> {
        Ok(self.frame(t, side)?.curvature)
    }

    /// Derivative of the signed curvature by the parameter, the limit from `side` at a knot: see [`Frame::curvature_derivative`].
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn curvature_derivative(&self, t: f64, side: Side) -> Result<f64, SplineError> {
        let derivatives = self.derivatives(t, 3, side)?;
        Frame::from_derivatives([derivatives[0], derivatives[1], derivatives[2]])
            .map(|frame| frame.curvature_derivative(derivatives[2], derivatives[3]))
            .ok_or(SplineError::Degenerate { what: "the tangent", parameter: t })
    }

    /// The osculating circle at `t`; `None` where the curvature is 0.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn osculating_circle(&self, t: f64, side: Side) -> Result<Option<OsculatingCircle>, SplineError> {
        Ok(self.frame(t, side)?.osculating_circle())
    }
}

impl Nurbs<DVec3> {
    /// Point, Frenet frame, curvature, torsion and speed; the limits from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed or the curvature is 0, although the curve may be smooth there.
    pub fn frame(&self, t: f64, side: Side) -> Result<SpaceFrame, SplineError> {
        let derivatives = self.derivatives(t, 3, side)?;
        SpaceFrame::from_derivatives([derivatives[0], derivatives[1], derivatives[2], derivatives[3]])
            .ok_or(SplineError::Degenerate { what: "the normal", parameter: t })
    }

    /// The curvature, not negative; the limit from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed is 0.
    pub fn curvature(&self, t: f64, side: Side) -> Result<f64, SplineError> {
        let derivatives = self.derivatives(t, 2, side)?;
        let speed = derivatives[1].length();
        let curvature = ((derivatives[1] / speed).cross(derivatives[2]) / speed / speed).length();
        if speed > 0.0 && curvature.is_finite() {
            return Ok(curvature);
        }
        Err(SplineError::Degenerate { what: "the tangent", parameter: t })
    }

    /// The torsion, positive for right-handed screws; the limit from `side` at a knot.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`](Nurbs::<DVec3>::frame).
    pub fn torsion(&self, t: f64, side: Side) -> Result<f64, SplineError> {
        Ok(self.frame(t, side)?.torsion)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn frenet_frames_are_right_handed_and_obey_the_equations_of_frenet(
            curve in any_curve(3..=6), heights in prop::collection::vec(-4.0..4.0_f64, 7), share in 0.0..=1.0_f64,
        ) {
            let lift = |factor: f64| {
                let points = curve.points().iter().enumerate().map(|(k, p)| p.extend(factor * heights[k % 7])).collect();
                Nurbs::new(curve.space().clone(), points, curve.weights().to_vec()).unwrap()
            };
            let (space, mirrored) = (lift(1.0), lift(-1.0));
            let (a, b) = curve.space().parameter_interval();
            let t = a.mix(b, share);
            let (Ok(frame), Ok(image)) = (space.frame(t, Side::Right), mirrored.frame(t, Side::Right)) else { return Ok(()) };
            prop_assume!(frame.speed > 0.3 && frame.curvature > 1e-2);
            prop_assert!((frame.tangent.cross(frame.normal) - frame.binormal).length() < 1e-11, "right-handed");
            prop_assert!((frame.normal.length() - 1.0).abs() < 1e-11 && frame.normal.dot(frame.tangent).abs() < 1e-11, "orthonormal");
            prop_assert!((frame.torsion + image.torsion).abs() < 1e-8 * (1.0 + frame.torsion.abs()), "{frame:?} {image:?}");
            prop_assert!((space.curvature(t, Side::Right).unwrap() - frame.curvature).abs() < 1e-11 * (1.0 + frame.curvature), "curvature");
            let h = 1e-6;
            let apart = |s: f64| curve.space().breaks().iter().all(|knot| (knot - s).abs() > 2.0 * h) && a + h < s && s < b - h;
            if apart(t) {
                let [back, on] = [t - h, t + h].map(|s| space.frame(s, Side::Right).unwrap());
                let derivative = (on.binormal - back.binormal) / (2.0 * h * frame.speed);
                let expected = frame.normal * -frame.torsion;
                let size = 1.0 + frame.torsion.abs() + frame.curvature;
                prop_assume!(size < 20.0);
                prop_assert!((derivative - expected).length() < 1e-4 * size.powi(3), "{derivative} for {expected}");
            }
        }
    }

    #[test]
    fn a_circle_has_the_curvature_of_its_radius_everywhere() {
        let points = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| 4.0 * DVec2::new(x, y));
        let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let arc = Nurbs::new(space, points.to_vec(), weights).unwrap();
        for i in 0..=20 {
            let frame = arc.frame(f64::from(i) / 20.0, Side::Right).unwrap();
            assert!((frame.curvature - 0.25).abs() < 1e-14, "counterclockwise: {frame:?}");
            let circle = frame.osculating_circle().unwrap();
            assert!(circle.center.length() < 1e-13, "centre {}", circle.center);
            assert!((frame.tangent.length() - 1.0).abs() < 1e-15, "unit tangent {}", frame.tangent);
            assert!(frame.normal.dot(frame.point) < 0.0, "the normal points left, here inwards");
        }
    }

    #[test]
    fn no_tangent_where_the_speed_vanishes() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let curve = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::ZERO, DVec2::X]).unwrap();
        assert_eq!(curve.curvature(0.0, Side::Right).unwrap_err().name(), "Degenerate", "double end point");
        assert_eq!(curve.osculating_circle(0.5, Side::Right).unwrap(), None, "a line has none");
    }

    #[test]
    fn the_derivative_of_the_curvature_is_the_limit_of_difference_quotients() {
        let points = [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0], [6.0, 1.0]].map(DVec2::from).to_vec();
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 3.0]).unwrap();
        let curve = Nurbs::new(space, points, vec![1.0, 2.0, 0.5, 1.5, 1.0]).unwrap();
        for t in [0.3, 0.9, 1.4] {
            let at = |t: f64| curve.curvature(t, Side::Right).unwrap();
            let quotient = (at(t + 1e-6) - at(t - 1e-6)) / 2e-6;
            let exact = curve.curvature_derivative(t, Side::Right).unwrap();
            assert!((quotient - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{quotient} for {exact}");
        }
    }

    #[test]
    fn no_normal_on_a_line_in_space_but_a_curvature() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let line = Nurbs::polynomial(space, vec![DVec3::ZERO, DVec3::ONE, 3.0 * DVec3::ONE]).unwrap();
        assert_eq!(line.frame(0.5, Side::Right).unwrap_err().name(), "Degenerate", "no normal");
        assert_eq!(line.torsion(0.5, Side::Right).unwrap_err().name(), "Degenerate", "no torsion");
        assert_eq!(line.curvature(0.5, Side::Right), Ok(0.0), "straight");
    }
}
