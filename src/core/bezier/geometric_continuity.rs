//! Geometric joints of plane curves: common tangent (G¹), common osculating circle (G²), whatever the parametrisations.
//!
//! For curves of equal degree with the tangent lengths in the ratio `δ = |c⁺₁ − c⁺₀|/|c⁻ₙ − c⁻ₙ₋₁|`, a G¹ joint is G² if
//! `δ³ area[c⁻ₙ₋₂, c⁻ₙ₋₁, c⁻ₙ] = area[c⁺₀, c⁺₁, c⁺₂]`: the last of these points may slide parallel to the tangent. Course: section 2.5.

use glam::DVec2;

use crate::core::bezier::curvature::Frame;
use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::{BezierError, check_tolerance};
use crate::core::point::Point as _;

/// How well two curves join, in increasing order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GeometricOrder {
    /// The end of one is not the beginning of the other.
    Apart,
    /// G⁰: a common point.
    Position,
    /// G¹: and a common tangent direction.
    Tangent,
    /// G²: and a common signed curvature.
    Curvature,
}

impl GeometricOrder {
    /// `C-1`, `G0`, `G1` or `G2`.
    pub fn label(self) -> &'static str {
        match self {
            Self::Apart => "C-1",
            Self::Position => "G0",
            Self::Tangent => "G1",
            Self::Curvature => "G2",
        }
    }
}

/// The joint of two plane curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometricJoint {
    /// How well they join.
    pub order: GeometricOrder,
    /// Ratio `δ` of the edges of the control polygons at the joint, right to left.
    pub length_ratio: f64,
    /// Signed areas of the triangles of the last three points of the left and the first three of the right polygon;
    /// 0 for a polygon of two.
    pub areas: [f64; 2],
    /// Signed curvatures of the left and the right curve at the joint.
    pub curvatures: [f64; 2],
}

/// How `right` joins the end of `left`.
///
/// Points may differ by `tolerance` times the larger [`BezierCurve::extent`], unit tangents by `tolerance`, and curvatures by `tolerance` times the
/// larger one, or times the reciprocal of that extent if that is larger.
///
/// # Errors
///
/// `InvalidTolerance`; `Degenerate` where a curve has no tangent at the joint; `NonFinite` where a derivative overflows.
pub fn geometric_joint(
    left: &BezierCurve<DVec2>,
    right: &BezierCurve<DVec2>,
    tolerance: f64,
) -> Result<GeometricJoint, BezierError> {
    check_tolerance(tolerance)?;
    let (before, after): (Frame, Frame) = (left.frame(left.interval().1)?, right.frame(right.interval().0)?);
    let (c, d) = (left.points(), right.points());
    let (m, size) = (left.degree(), left.extent().max(right.extent()));
    let triangle = |corners: &[DVec2]| match *corners {
        [a, b, c] => 0.5 * (b - a).perp_dot(c - a),
        _ => 0.0,
    };
    let curvatures = [before.curvature, after.curvature];
    let largest = curvatures[0].abs().max(curvatures[1].abs()).max(size.recip());
    let order = if (before.point - after.point).norm() > tolerance * size {
        GeometricOrder::Apart
    } else if (before.tangent - after.tangent).norm() > tolerance {
        GeometricOrder::Position
    } else if (curvatures[0] - curvatures[1]).abs() > tolerance * largest {
        GeometricOrder::Tangent
    } else {
        GeometricOrder::Curvature
    };
    Ok(GeometricJoint {
        order,
        length_ratio: (d[1] - d[0]).norm() / (c[m] - c[m - 1]).norm(),
        areas: [triangle(&c[m.saturating_sub(2)..]), triangle(&d[..d.len().min(3)])],
        curvatures,
    })
}

/// The second and third control point of a curve of the same degree that joins `left` G²: the edge is `δ` times as long, and the third point
/// is `slide` edges ahead of the joint along the tangent.
///
/// # Errors
///
/// `SizeMismatch` for a degree below 2; `Degenerate` unless the length ratio is positive and the last edge is not a point; `NonFinite` where a point
/// overflows.
pub fn slide_control_points(
    left: &BezierCurve<DVec2>,
    length_ratio: f64,
    slide: f64,
) -> Result<[DVec2; 2], BezierError> {
    let [.., a, b, c] = left.points() else {
        return Err(BezierError::SizeMismatch {
            what: "control points",
            expected: 3,
            found: left.points().len(),
        });
    };
    let edge = *c - *b;
    let length = edge.norm();
    if length_ratio.is_nan() || length_ratio <= 0.0 || length <= 0.0 {
        let parameter = if length <= 0.0 { left.interval().1 } else { length_ratio };
        return Err(BezierError::Degenerate { what: "the joint", parameter });
    }
    let area = 0.5 * (*b - *a).perp_dot(*c - *a);
    let normal = edge.perp() / length;
    let ahead = edge * length_ratio;
    let third = *c + ahead * slide + normal * (2.0 * length_ratio * length_ratio * area / length);
    let points = BezierCurve::new(vec![*c + ahead, third])?;
    Ok([points.points()[0], points.points()[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn slid_points_always_join_with_common_curvature(
            points in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 3..7),
            more in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 7),
            ratio in 0.3..3.0_f64, slide in -3.0..3.0_f64,
        ) {
            let left = BezierCurve::new(points).unwrap();
            let n = left.degree();
            prop_assume!((left.points()[n] - left.points()[n - 1]).length() > 0.2);
            let [second, third] = slide_control_points(&left, ratio, slide).unwrap();
            let mut right = vec![left.points()[n], second, third];
            right.extend(&more[..n - 2]);
            let right = BezierCurve::on_interval(right, (1.0, 3.0)).unwrap();
            let joint = geometric_joint(&left, &right, 1e-9).unwrap();
            prop_assert_eq!(joint.order, GeometricOrder::Curvature, "{:?}", joint);
            prop_assert!((joint.length_ratio - ratio).abs() < 1e-11, "{joint:?}");
            let scaled = joint.areas[0] * ratio.powi(3);
            prop_assert!((scaled - joint.areas[1]).abs() < 1e-9 * (1.0 + scaled.abs()), "{joint:?}");
        }
    }

    #[test]
    fn weaker_joints_are_told() {
        let at = DVec2::new;
        let left = BezierCurve::new(vec![at(-1.0, 0.0), at(0.0, 0.0)]).unwrap();
        let order = |points: &[DVec2]| {
            geometric_joint(&left, &BezierCurve::new(points.to_vec()).unwrap(), 1e-9).unwrap().order
        };
        assert_eq!(order(&[at(1.0, 0.0), at(2.0, 0.0)]), GeometricOrder::Apart, "a gap");
        assert_eq!(order(&[at(0.0, 0.0), at(-2.0, 0.0)]), GeometricOrder::Position, "back");
        assert_eq!(
            order(&[at(0.0, 0.0), at(1.0, 0.0), at(2.0, 1.0)]),
            GeometricOrder::Tangent,
            "line to arc"
        );
        assert_eq!(order(&[at(0.0, 0.0), at(5.0, 0.0)]), GeometricOrder::Curvature, "line to line");
        let short = slide_control_points(&left, 1.0, 1.0).unwrap_err();
        assert_eq!(short.name(), "SizeMismatch", "degree 1");
    }
}
