//! Frames and curvature of plane curves.
//!
//! `κ = det(r′, r″)/|r′|³`, positive where the curve turns left (y points up); it does not depend on the
//! parametrisation, its sign does on the direction. Course: sections 2.5 and 6.1.

use glam::DVec2;

use crate::core::bspline::{Side, SplineError};
use crate::core::spline_curve::Nurbs;

/// Point, directions and curvature of a plane curve at one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// `r(t)`.
    pub point: DVec2,
    /// Unit tangent `r′/|r′|`.
    pub tangent: DVec2,
    /// Unit normal, the tangent turned left by 90 degrees.
    pub normal: DVec2,
    /// Signed curvature, 1/length.
    pub curvature: f64,
    /// `|r′|`, length per parameter.
    pub speed: f64,
}

/// The circle that touches a curve to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OsculatingCircle {
    /// The centre, on the normal.
    pub center: DVec2,
    /// The radius `1/|κ|`.
    pub radius: f64,
}

impl Frame {
    /// The osculating circle; `None` where the curvature is 0, or so small that the radius overflows.
    pub fn osculating_circle(&self) -> Option<OsculatingCircle> {
        let radius = self.curvature.recip();
        let center = self.point + self.normal * radius;
        center.is_finite().then_some(OsculatingCircle { center, radius: radius.abs() })
    }
}

impl Nurbs<DVec2> {
    /// Point, unit tangent and normal, curvature and speed; the limits from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed is 0.
    pub fn frame(&self, t: f64, side: Side) -> Result<Frame, SplineError> {
        let derivatives = self.derivatives(t, 2, side)?;
        let (point, velocity, second) = (derivatives[0], derivatives[1], derivatives[2]);
        let speed = velocity.x.hypot(velocity.y);
        if speed <= 0.0 || !speed.is_finite() {
            return Err(SplineError::Degenerate { what: "the tangent", parameter: t });
        }
        let tangent = velocity / speed;
        // Dividing step by step: |r′|³ under- and overflows long before the curvature does.
        let curvature = tangent.perp_dot(second) / speed / speed;
        Ok(Frame { point, tangent, normal: tangent.perp(), curvature, speed })
    }

    /// Signed curvature, positive in left turns; the limit from `side` at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `Degenerate` where the speed is 0.
    pub fn curvature(&self, t: f64, side: Side) -> Result<f64, SplineError> {
        Ok(self.frame(t, side)?.curvature)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

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
}
