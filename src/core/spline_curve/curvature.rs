//! Frames and curvature of plane curves.
//!
//! `κ = det(r′, r″)/|r′|³`, positive where the curve turns left (y points up); it does not depend on the
//! parametrisation, its sign does on the direction. Course: sections 2.5 and 6.1.

use glam::DVec2;

pub use crate::core::bezier::{Frame, OsculatingCircle};
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
