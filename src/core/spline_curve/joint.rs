//! How smoothly two open plane curves join, in numbers.
//!
//! Both are run through as one: into the joint along the first, out of it along the second, whichever ends meet. Course: sections 2.7 and 6.1.

use glam::DVec2;

use crate::core::bspline::{Side, SplineError};
use crate::core::spline_curve::Nurbs;

/// The joint of the nearest ends of two curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Whether the joint is at the end of the first curve, not at its start.
    pub at_end: bool,
    /// Whether the joint is at the end of the second curve.
    pub at_other_end: bool,
    /// G⁰: the distance of the ends.
    pub gap: f64,
    /// G¹: the angle from tangent to tangent in radians, from −π to π; `None` where a speed is 0.
    pub angle: Option<f64>,
    /// G²: the signed curvature of the second minus that of the first.
    pub curvature: Option<f64>,
    /// C¹: length of the difference of the first derivatives.
    pub first: f64,
    /// C²: length of the difference of the second derivatives.
    pub second: f64,
}

impl Nurbs<DVec2> {
    /// The joint of the nearest ends of this curve and `other`; `None` if one of them is closed.
    ///
    /// # Errors
    ///
    /// None is known to occur.
    pub fn joint(&self, other: &Self) -> Result<Option<Joint>, SplineError> {
        if self.space().is_periodic() || other.space().is_periodic() {
            return Ok(None);
        }
        let end = |curve: &Self, at_end: bool| {
            let (left, right) = curve.space().parameter_interval();
            let (t, side) = if at_end { (right, Side::Left) } else { (left, Side::Right) };
            curve.derivatives(t, 2, side)
        };
        let mut best: Option<Joint> = None;
        for (at_end, at_other_end) in [(true, false), (false, true), (true, true), (false, false)] {
            let (a, b) = (end(self, at_end)?, end(other, at_other_end)?);
            let gap = a[0].distance(b[0]);
            if best.is_some_and(|best| best.gap <= gap) {
                continue;
            }
            // Backwards, odd derivatives change their sign.
            let (a1, b1) = (if at_end { a[1] } else { -a[1] }, if at_other_end { -b[1] } else { b[1] });
            let bend = |first: DVec2, second: DVec2| first.perp_dot(second) / first.length().powi(3);
            let number = |value: f64| value.is_finite().then_some(value);
            let moving = a1.length() > 0.0 && b1.length() > 0.0;
            best = Some(Joint {
                at_end,
                at_other_end,
                gap,
                angle: moving.then(|| a1.perp_dot(b1).atan2(a1.dot(b1))),
                curvature: number(bend(b1, b[2]) - bend(a1, a[2])),
                first: a1.distance(b1),
                second: a[2].distance(b[2]),
            });
        }
        Ok(best)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};

    fn parabola(points: [[f64; 2]; 3]) -> Nurbs<DVec2> {
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        Nurbs::polynomial(space, points.map(DVec2::from).to_vec()).unwrap()
    }

    #[test]
    fn halves_of_one_parabola_join_smoothly_whichever_way_they_run() {
        let first = parabola([[-1.0, 1.0], [-0.5, 0.0], [0.0, 0.0]]);
        let second = parabola([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]);
        for (a, b) in [
            (first.clone(), second.clone()),
            (first.reversed().unwrap(), second.clone()),
            (first.clone(), second.reversed().unwrap()),
            (second, first),
        ] {
            let joint = a.joint(&b).unwrap().unwrap();
            assert!(joint.gap < 1e-15 && joint.angle.unwrap().abs() < 1e-14, "{joint:?}");
            assert!(joint.curvature.unwrap().abs() < 1e-13, "{joint:?}");
            assert!(joint.first < 1e-14 && joint.second < 1e-13, "{joint:?}");
        }
    }

    #[test]
    fn a_corner_and_another_speed_are_measured() {
        let first = parabola([[-2.0, 0.0], [-1.0, 0.0], [0.0, 0.0]]);
        let second = parabola([[0.0, 0.5], [0.0, 1.5], [0.0, 2.5]]);
        let joint = first.joint(&second).unwrap().unwrap();
        assert_eq!((joint.gap, joint.at_end, joint.at_other_end), (0.5, true, false), "{joint:?}");
        assert!((joint.angle.unwrap() - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{joint:?}");
        assert!((joint.first - 8.0_f64.sqrt()).abs() < 1e-14, "{joint:?}");
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        assert_eq!(circle.joint(&first).unwrap(), None, "a closed curve has no ends");
    }
}
