//! Conics as extended rational quadratic curves: a middle weight of any sign, and parameters from `−∞` to `∞`.
//!
//! `r(t) = (c₀ w₀ (1−t)² + 2 c₁ w₁ t (1−t) + c₂ w₂ t²)/(w₀ (1−t)² + 2 w₁ t (1−t) + w₂ t²)` runs through the whole conic, `r(∞)` included. Zeros of the denominator are
//! points at infinity: none of an ellipse, one of a parabola, two of a hyperbola, told by `d = w₀ w₂ − w₁²`. Course: section 3.4.

use glam::DVec2;

use crate::core::rational_bezier::conic::{Conic, ConicKind, difference};
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::rational_bezier::{Projective as _, RationalBezier};

/// A parameter of the projective line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExtendedParameter {
    /// A real number.
    Finite(f64),
    /// The limit for `t → ±∞`.
    Infinity,
}

/// A whole conic as a rational quadratic curve; no hull property, and poles are allowed.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::rational_bezier::{ExtendedConic, ExtendedParameter};
///
/// let circle = ExtendedConic::new([DVec2::X, DVec2::ONE, DVec2::Y], [1.0, 1.0, 2.0])?;
/// assert_eq!(circle.evaluate(ExtendedParameter::Infinity)?, DVec2::NEG_X);
/// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedConic {
    points: [DVec2; 3],
    weights: [f64; 3],
}

impl ExtendedConic {
    /// The curve with control points that are not collinear and weights of any sign, none of them 0.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for collinear points or a weight 0: then the curve is part of a line.
    pub fn new(points: [DVec2; 3], weights: [f64; 3]) -> Result<Self, RationalBezierError> {
        Conic::from_control_points(points, weights)?;
        Ok(Self { points, weights })
    }

    /// The curve in standard form, with the weights `(1, w, 1)`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn standard(points: [DVec2; 3], middle_weight: f64) -> Result<Self, RationalBezierError> {
        Self::new(points, [1.0, middle_weight, 1.0])
    }

    /// The control points.
    pub fn points(&self) -> [DVec2; 3] {
        self.points
    }

    /// The weights.
    pub fn weights(&self) -> [f64; 3] {
        self.weights
    }

    /// The point at a parameter.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` at a pole, where the point is at infinity.
    pub fn evaluate(&self, parameter: ExtendedParameter) -> Result<DVec2, RationalBezierError> {
        let [first, middle, last] = [0, 1, 2].map(|k| self.points[k].lift(self.weights[k]));
        let (lifted, value) = match parameter {
            ExtendedParameter::Infinity => (first - middle * 2.0 + last, f64::INFINITY),
            // Divided by t², which would overflow.
            ExtendedParameter::Finite(t) if t.abs() > 1e100 => {
                check_finite("parameter", &[t])?;
                let s = t.recip();
                let one = s - 1.0;
                (first * (one * one) + middle * (2.0 * one) + last, t)
            }
            ExtendedParameter::Finite(t) => {
                check_finite("parameter", &[t])?;
                let one = 1.0 - t;
                (first * (one * one) + middle * (2.0 * t * one) + last * (t * t), t)
            }
        };
        let (point, weight) = DVec2::project(lifted);
        if weight == 0.0 || !point.is_finite() {
            return Err(RationalBezierError::Degenerate { what: "a point at infinity", value });
        }
        Ok(point)
    }

    /// The same conic with the middle weight negated: for `t` in `[0, 1]` it runs through what this one leaves out.
    #[must_use]
    pub fn complement(&self) -> Self {
        let [first, middle, last] = self.weights;
        Self { points: self.points, weights: [first, -middle, last] }
    }

    /// `d = w₀ w₂ − w₁²`; exactly 0 if it is below 1e-12 of both terms.
    pub fn discriminant(&self) -> f64 {
        difference(self.weights[0] * self.weights[2], self.weights[1] * self.weights[1])
    }

    /// Ellipse for `d > 0`, parabola for `d = 0` up to `tolerance·(|w₀ w₂| + w₁²)`, hyperbola for `d < 0`.
    pub fn kind(&self, tolerance: f64) -> ConicKind {
        let [first, middle, last] = self.weights;
        let (p, q) = (first * last, middle * middle);
        if (p - q).abs() <= tolerance * (p.abs() + q) {
            ConicKind::Parabola
        } else if p > q {
            ConicKind::Ellipse
        } else {
            ConicKind::Hyperbola
        }
    }

    /// The parameters of the points at infinity, the real zeros of the denominator, increasing and with infinity last; a double one once.
    pub fn poles(&self) -> Vec<ExtendedParameter> {
        let [first, middle, last] = self.weights;
        // q = w₀ + 2 h t + s t².
        let (half, square) = (middle - first, difference(first + last, 2.0 * middle));
        let d = self.discriminant();
        if d > 0.0 {
            return Vec::new();
        }
        // h² − s w₀ = w₁² − w₀ w₂, and the zero without cancellation first.
        let far = -(half + half.signum() * (-d).sqrt());
        let mut zeros = Vec::with_capacity(2);
        if square != 0.0 {
            zeros.push(far / square);
        }
        if far != 0.0 && d < 0.0 {
            zeros.push(first / far);
        }
        zeros.sort_by(f64::total_cmp);
        let mut poles: Vec<_> = zeros.into_iter().map(ExtendedParameter::Finite).collect();
        if square == 0.0 {
            poles.push(ExtendedParameter::Infinity);
        }
        poles
    }

    /// The equation of the conic.
    ///
    /// # Errors
    ///
    /// `NonFinite` where a coefficient overflows.
    pub fn implicit(&self) -> Result<Conic, RationalBezierError> {
        Conic::from_control_points(self.points, self.weights)
    }

    /// The arc for `t` in `[0, 1]` as a rational Bezier curve.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive` with the first weight that is not positive.
    pub fn arc(&self) -> Result<RationalBezier<DVec2>, RationalBezierError> {
        RationalBezier::new(self.points.to_vec(), self.weights.to_vec())
    }
}

impl TryFrom<&RationalBezier<DVec2>> for ExtendedConic {
    type Error = RationalBezierError;

    fn try_from(curve: &RationalBezier<DVec2>) -> Result<Self, RationalBezierError> {
        match (curve.points(), curve.weights()) {
            (&[a, b, c], &[u, v, w]) => Self::new([a, b, c], [u, v, w]),
            (points, _) => {
                let found = points.len();
                Err(RationalBezierError::SizeMismatch {
                    what: "control points of a conic",
                    expected: 3,
                    found,
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ExtendedParameter::{Finite, Infinity};
    use proptest::prelude::*;

    fn conics() -> impl Strategy<Value = ExtendedConic> {
        let point = (-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from);
        let weight = (0.2..3.0_f64, prop::bool::ANY).prop_map(|(w, sign)| if sign { w } else { -w });
        (prop::array::uniform3(point), prop::array::uniform3(weight)).prop_filter_map(
            "a proper triangle",
            |(c, w)| {
                let area = (c[0] - c[1]).perp_dot(c[2] - c[1]);
                (area.abs() > 1.0).then(|| ExtendedConic::new(c, w).unwrap())
            },
        )
    }

    proptest! {
        #[test]
        fn all_points_satisfy_the_equation(conic in conics(), t in -50.0..50.0_f64) {
            let implicit = conic.implicit().unwrap();
            for curve in [conic, conic.complement()] {
                for parameter in [Finite(t), Finite(t / 50.0), Infinity] {
                    let Ok(point) = curve.evaluate(parameter) else { continue };
                    prop_assume!(point.length() < 1e6);
                    prop_assert!(implicit.residual(point) < 1e-9, "{point} at {parameter:?}");
                }
            }
            prop_assert_eq!(implicit.kind(), conic.kind(1e-12), "both kinds");
        }

        #[test]
        fn poles_are_the_zeros_of_the_denominator(conic in conics()) {
            let [u, v, w] = conic.weights();
            let poles = conic.poles();
            let count = match conic.kind(1e-12) { ConicKind::Ellipse => 0, ConicKind::Parabola => 1, _ => 2 };
            prop_assert_eq!(poles.len(), count, "{:?}", poles);
            for pole in poles {
                let Finite(t) = pole else { continue };
                let terms = [u * (1.0 - t) * (1.0 - t), 2.0 * v * t * (1.0 - t), w * t * t];
                let size: f64 = terms.iter().map(|term| term.abs()).sum();
                prop_assert!(terms.iter().sum::<f64>().abs() < 1e-12 * size, "at {t}");
            }
        }

        #[test]
        fn a_projective_map_changes_the_kind_as_it_moves_the_poles(conic in conics(), m in prop::array::uniform9(-1.0..1.0_f64)) {
            let matrix = glam::DMat3::from_cols_array(&m);
            prop_assume!(matrix.determinant().abs() > 0.2);
            let lifted = [0, 1, 2].map(|k| matrix * conic.points()[k].lift(conic.weights()[k]));
            prop_assume!(lifted.iter().all(|h| h.z.abs() > 0.05));
            let images = lifted.map(DVec2::project);
            let Ok(image) = ExtendedConic::new(images.map(|(p, _)| p), images.map(|(_, w)| w)) else { return Ok(()) };
            let expected = match image.poles().len() { 0 => ConicKind::Ellipse, 1 => ConicKind::Parabola, _ => ConicKind::Hyperbola };
            prop_assert_eq!(image.kind(1e-12), expected, "poles {:?}", image.poles());
            let (point, w) = (conic.evaluate(Finite(0.3)), image.evaluate(Finite(0.3)));
            if let (Ok(point), Ok(w)) = (point, w) {
                let exact = DVec2::project(matrix * point.extend(1.0)).0;
                prop_assert!((exact - w).length() < 1e-7 * (1.0 + exact.length_squared()), "{exact} and {w}");
            }
        }
    }

    #[test]
    fn an_arc_and_its_complement_are_the_ellipse() {
        // Of the unit circle, by the angles of the points.
        let circle = ExtendedConic::standard([DVec2::X, DVec2::ONE, DVec2::Y], 0.5_f64.sqrt()).unwrap();
        let angle = |conic: &ExtendedConic, t: f64| conic.evaluate(Finite(t)).unwrap().to_angle();
        for i in 1..40 {
            let t = f64::from(i) / 40.0;
            let inside = angle(&circle, t);
            assert!((0.0..=std::f64::consts::FRAC_PI_2).contains(&inside), "first quadrant at {t}");
            let outside = angle(&circle.complement(), t);
            assert!(!(1e-9..std::f64::consts::FRAC_PI_2 - 1e-9).contains(&outside), "the others at {t}");
        }
        assert_eq!(circle.complement().arc().unwrap_err().name(), "WeightNotPositive", "no Bezier arc");
        assert_eq!(circle.arc().unwrap().weights()[1], 0.5_f64.sqrt(), "the short arc");
        assert_eq!(circle.evaluate(Finite(f64::NAN)).unwrap_err().name(), "NonFinite", "NaN");
        let zero = ExtendedConic::standard(circle.points(), 0.0);
        assert_eq!(zero.unwrap_err().name(), "Degenerate", "a segment");
    }

    #[test]
    fn the_parabola_has_its_pole_at_infinity() {
        let parabola = ExtendedConic::standard([DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::ONE], 1.0).unwrap();
        assert_eq!(parabola.poles(), [Infinity], "once");
        assert_eq!(parabola.kind(1e-12), ConicKind::Parabola, "kind");
        assert_eq!(parabola.evaluate(Infinity).unwrap_err().name(), "Degenerate", "infinitely far");
        assert_eq!(parabola.evaluate(Finite(-3.0)), Ok(DVec2::new(-3.0, 9.0)), "y = x²");
        let circle = ExtendedConic::new([DVec2::X, DVec2::ONE, DVec2::Y], [1.0, 1.0, 2.0]).unwrap();
        assert_eq!(circle.evaluate(Finite(1e200)), circle.evaluate(Infinity), "nearly infinity");
    }
}
