//! Frames, curvature and torsion.
//!
//! In the plane `κ = det(r′, r″)/|r′|³`, positive where the curve turns left (y points up); in space `κ = |r′ × r″|/|r′|³ ≥ 0` and the torsion
//! `τ = det(r′, r″, r‴)/|r′ × r″|²`. All are independent of the parametrisation, the plane's sign depends on the direction. The frames
//! are made from derivatives, so that every kind of curve can use them. Course: section 2.5; J. F. Frenet 1852.

use glam::{DVec2, DVec3};

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;

/// Speeds up to this many times the degree and the rounding error of a derivative count as 0.
const STILL: f64 = 4.0 * f64::EPSILON;

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

/// Point, Frenet frame, curvature and torsion of a space curve at one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceFrame {
    /// `r(t)`.
    pub point: DVec3,
    /// Unit tangent `r′/|r′|`.
    pub tangent: DVec3,
    /// Unit normal `binormal × tangent`, towards the centre of the osculating circle.
    pub normal: DVec3,
    /// Unit binormal, the direction of `r′ × r″`.
    pub binormal: DVec3,
    /// Curvature, positive, 1/length.
    pub curvature: f64,
    /// Torsion, positive for right-handed screws, 1/length.
    pub torsion: f64,
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

/// A tooth of a curvature comb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureTooth {
    /// The parameter.
    pub parameter: f64,
    /// Root of the tooth, on the curve.
    pub root: DVec2,
    /// Tip of the tooth: `root − scale·κ·normal`, on the outer side of the curve for a positive scale.
    pub tip: DVec2,
}

impl Frame {
    /// The frame of a curve with the derivatives `r, r′, r″`; `None` where the speed is 0 or not finite.
    pub fn from_derivatives([point, first, second]: [DVec2; 3]) -> Option<Self> {
        let speed = first.norm();
        if speed <= 0.0 || !speed.is_finite() {
            return None;
        }
        let tangent = first / speed;
        // Dividing step by step: |r′|³ under- and overflows long before the curvature does.
        let curvature = tangent.perp_dot(second) / speed / speed;
        Some(Self { point, tangent, normal: tangent.perp(), curvature, speed })
    }

    /// Derivative of the signed curvature by the parameter, `(det(r′, r‴) − 3 κ |r′| r′·r″)/|r′|³`; by the arc length it is
    /// this divided by the speed.
    pub fn curvature_derivative(&self, second: DVec2, third: DVec2) -> f64 {
        let turned = self.tangent.perp_dot(third) / self.speed / self.speed;
        turned - 3.0 * self.curvature * (self.tangent.dot(second) / self.speed)
    }

    /// The osculating circle; `None` where the curvature is 0, or so small that the radius overflows.
    pub fn osculating_circle(&self) -> Option<OsculatingCircle> {
        let radius = self.curvature.recip();
        let center = self.point + self.normal * radius;
        Point::is_finite(center).then_some(OsculatingCircle { center, radius: radius.abs() })
    }

    /// The tooth of a curvature comb here, with the length `scale·|κ|`.
    pub fn tooth(&self, parameter: f64, scale: f64) -> CurvatureTooth {
        let tip = self.point - self.normal * (scale * self.curvature);
        CurvatureTooth { parameter, root: self.point, tip }
    }
}

impl SpaceFrame {
    /// The frame of a curve with the derivatives `r, r′, r″, r‴`; `None` where the speed or `r′ × r″` is 0 or not finite.
    pub fn from_derivatives([point, first, second, third]: [DVec3; 4]) -> Option<Self> {
        let speed = first.norm();
        let tangent = first / speed;
        let turning = tangent.cross(second) / speed / speed;
        let curvature = turning.norm();
        if !(speed > 0.0 && curvature > 0.0 && speed.is_finite() && curvature.is_finite()) {
            return None;
        }
        let binormal = turning / curvature;
        let torsion = binormal.dot(third) / speed / speed / speed / curvature;
        Some(Self { point, tangent, normal: binormal.cross(tangent), binormal, curvature, torsion, speed })
    }
}

impl<P: Point> BezierCurve<P> {
    /// `p, p′, …` to the order `N − 1`; `Degenerate` where `p′` is 0 up to rounding.
    fn moving<const N: usize>(&self, x: f64) -> Result<[P; N], BezierError> {
        let mut values = [P::ZERO; N];
        self.write_derivatives(x, &mut self.points().to_vec(), &mut values)?;
        let n = self.degree() as f64;
        if values[1].norm() <= STILL * n * n * self.extent() / self.width() {
            return Err(BezierError::Degenerate { what: "the tangent", parameter: x });
        }
        Ok(values)
    }
}

impl BezierCurve<DVec2> {
    /// Point, unit tangent and normal, signed curvature and speed.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` where the speed is 0 up to rounding.
    pub fn frame(&self, x: f64) -> Result<Frame, BezierError> {
        Frame::from_derivatives(self.moving(x)?)
            .ok_or(BezierError::Degenerate { what: "the tangent", parameter: x })
    }

    /// The signed curvature, positive in left turns.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn curvature(&self, x: f64) -> Result<f64, BezierError> {
        Ok(self.frame(x)?.curvature)
    }

    /// Derivative of the signed curvature by the parameter, see [`Frame::curvature_derivative`].
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn curvature_derivative(&self, x: f64) -> Result<f64, BezierError> {
        let [point, first, second, third] = self.moving(x)?;
        let frame = Frame::from_derivatives([point, first, second]);
        frame
            .map(|frame| frame.curvature_derivative(second, third))
            .ok_or(BezierError::Degenerate { what: "the tangent", parameter: x })
    }

    /// Signed curvatures at both ends from three control points each: `2 (n−1)/n · area[c₀, c₁, c₂]/|c₁ − c₀|³`.
    ///
    /// # Errors
    ///
    /// `Degenerate` where the end tangent vanishes.
    pub fn end_curvatures(&self) -> Result<[f64; 2], BezierError> {
        let (a, b) = self.interval();
        Ok([self.curvature(a)?, self.curvature(b)?])
    }

    /// The osculating circle; `None` where the curvature is 0 (the tangent takes its place).
    ///
    /// # Errors
    ///
    /// As [`Self::frame`].
    pub fn osculating_circle(&self, x: f64) -> Result<Option<OsculatingCircle>, BezierError> {
        Ok(self.frame(x)?.osculating_circle())
    }

    /// A curvature comb with `count + 1` teeth at equally spaced parameters; those where the tangent vanishes are left out.
    ///
    /// # Errors
    ///
    /// `NonFinite` where a derivative overflows or the scale is not finite.
    pub fn curvature_comb(&self, count: usize, scale: f64) -> Result<Vec<CurvatureTooth>, BezierError> {
        if !scale.is_finite() {
            return Err(BezierError::NonFinite { what: "scale", index: 0, value: scale });
        }
        let (a, b) = self.interval();
        let mut comb = Vec::with_capacity(count + 1);
        for i in 0..=count {
            let x = a.mix(b, i as f64 / count.max(1) as f64);
            match self.frame(x) {
                Ok(frame) => comb.push(frame.tooth(x, scale)),
                Err(BezierError::Degenerate { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(comb)
    }
}

impl BezierCurve<DVec3> {
    /// Point, Frenet frame, curvature, torsion and speed.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` where the speed is 0 up to rounding or the curvature is 0.
    pub fn frame(&self, x: f64) -> Result<SpaceFrame, BezierError> {
        SpaceFrame::from_derivatives(self.moving(x)?)
            .ok_or(BezierError::Degenerate { what: "the normal", parameter: x })
    }

    /// The curvature, not negative.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` where the speed is 0 up to rounding.
    pub fn curvature(&self, x: f64) -> Result<f64, BezierError> {
        let [_, first, second] = self.moving(x)?;
        let speed = first.norm();
        Ok(((first / speed).cross(second) / speed / speed).norm())
    }

    /// The torsion, positive for right-handed screws.
    ///
    /// # Errors
    ///
    /// As [`Self::frame`](BezierCurve::<DVec3>::frame).
    pub fn torsion(&self, x: f64) -> Result<f64, BezierError> {
        Ok(self.frame(x)?.torsion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon() -> impl Strategy<Value = Vec<DVec2>> {
        prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 3..8)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn curvature_belongs_to_the_shape(points in polygon(), t in 0.05..0.95_f64, angle in 0.0..6.3_f64, size in 0.2..5.0_f64) {
            let curve = BezierCurve::new(points).unwrap();
            let frame = curve.frame(t).unwrap();
            prop_assume!(frame.speed > 0.3);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * (1.0 + a.abs());
            let moved = curve.transformed(|p| DVec2::from_angle(angle).rotate(p) * size + DVec2::new(5.0, -2.0)).unwrap();
            prop_assert!(near(moved.curvature(t).unwrap() * size, frame.curvature), "similar curves");
            let mirrored = curve.transformed(|p| DVec2::new(-p.x, p.y)).unwrap();
            prop_assert!(near(mirrored.curvature(t).unwrap(), -frame.curvature), "reflection");
            prop_assert!(near(curve.reversed().curvature(1.0 - t).unwrap(), -frame.curvature), "direction");
            prop_assert!(near(curve.elevate_degree().curvature(t).unwrap(), frame.curvature), "degree elevation");
            prop_assert!(near(curve.restricted(0.01, 0.96).unwrap().curvature(t).unwrap(), frame.curvature), "part");
            let h = 1e-5;
            let quotient = (curve.curvature(t + h).unwrap() - curve.curvature(t - h).unwrap()) / (2.0 * h);
            let exact = curve.curvature_derivative(t).unwrap();
            prop_assert!((quotient - exact).abs() < 1e-3 * (1.0 + exact.abs() + frame.curvature.abs().powi(3)), "{quotient} for {exact}");
        }

        #[test]
        fn the_formula_at_the_ends_takes_three_points(points in polygon()) {
            let curve = BezierCurve::new(points).unwrap();
            let c = curve.points();
            let n = curve.degree() as f64;
            prop_assume!((c[1] - c[0]).length() > 0.3);
            let area = 0.5 * (c[1] - c[0]).perp_dot(c[2] - c[0]);
            let formula = 2.0 * (n - 1.0) / n * area / (c[1] - c[0]).length().powi(3);
            let exact = curve.frame(0.0).unwrap().curvature;
            prop_assert!((formula - exact).abs() < 1e-11 * (1.0 + exact.abs()), "{formula} and {exact}");
        }

        #[test]
        fn the_osculating_circle_has_contact_of_order_two(points in polygon(), t in 0.1..0.9_f64) {
            let curve = BezierCurve::new(points).unwrap();
            let frame = curve.frame(t).unwrap();
            prop_assume!(frame.speed > 1.0 && frame.curvature.abs() > 0.05);
            let circle = frame.osculating_circle().unwrap();
            let gap = |h: f64| ((curve.evaluate(t + h).unwrap() - circle.center).length() - circle.radius).abs();
            let third = curve.derivatives(t, 3).unwrap()[3].length();
            let bound = |h: f64| 100.0 * (1.0 + third + frame.curvature.powi(2) * frame.speed.powi(3)) * h.powi(3);
            prop_assert!(gap(1e-3) < bound(1e-3), "{} above {}", gap(1e-3), bound(1e-3));
        }

        #[test]
        fn frenet_frames_are_right_handed_and_mirrors_flip_the_torsion(
            points in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec3::from), 4..8), t in 0.0..=1.0_f64,
        ) {
            let curve = BezierCurve::new(points).unwrap();
            let frame = curve.frame(t).unwrap();
            prop_assume!(frame.speed > 0.3 && frame.curvature > 1e-2);
            prop_assert!((frame.tangent.cross(frame.normal) - frame.binormal).length() < 1e-12, "right-handed");
            prop_assert!((frame.normal.length() - 1.0).abs() < 1e-12, "unit normal");
            let mirrored = curve.transformed(|p| p * DVec3::new(1.0, 1.0, -1.0)).unwrap();
            let torsion = mirrored.torsion(t).unwrap();
            prop_assert!((torsion + frame.torsion).abs() < 1e-9 * (1.0 + torsion.abs()), "{torsion} and {}", frame.torsion);
            let back = curve.reversed().torsion(1.0 - t).unwrap();
            prop_assert!((back - frame.torsion).abs() < 1e-8 * (1.0 + torsion.abs()), "direction");
        }
    }

    #[test]
    fn what_has_no_frame_is_refused() {
        let line = BezierCurve::new(vec![DVec3::ZERO, DVec3::ONE, 2.0 * DVec3::ONE]).unwrap();
        assert_eq!(line.frame(0.5).unwrap_err().name(), "Degenerate", "no normal");
        assert_eq!(line.curvature(0.5), Ok(0.0), "but a curvature");
        let point = BezierCurve::new(vec![DVec2::ONE; 4]).unwrap();
        assert_eq!(point.frame(0.5).unwrap_err().name(), "Degenerate", "a point");
        let straight = BezierCurve::new(vec![DVec2::ZERO, DVec2::X]).unwrap();
        assert_eq!(straight.osculating_circle(0.5), Ok(None), "a line");
        assert_eq!(straight.curvature_comb(4, 1.0).unwrap().len(), 5, "teeth of length 0");
        assert_eq!(straight.curvature_comb(4, f64::NAN).unwrap_err().name(), "NonFinite", "no scale");
    }
}
