//! Conics through points and with tangents.
//!
//! Five points: in the pencil `l₁₂ l₃₄ + μ l₁₃ l₂₄ = 0` of the conics through four points, `lᵢⱼ` the line through two of them, take the one through the fifth.
//! Five tangents: the same for their line coordinates gives the dual conic; the conic itself is its adjugate matrix. Beyond the course (B.12).

use glam::{DMat3, DVec2, DVec3};

use crate::core::rational_bezier::RationalBezier;
use crate::core::rational_bezier::conic::Conic;
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};

/// Sines and distances, in units of the data, up to which they count as 0.
const VANISHING: f64 = 1e-12;

impl Conic {
    /// The conic through five points. Three collinear ones give a pair of lines, which [`Conic::kind`] tells.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for four collinear points or two equal ones, which many conics contain.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::rational_bezier::{Conic, ConicKind};
    ///
    /// let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 4.0], [-1.0, 1.0], [3.0, 9.0]].map(DVec2::from);
    /// assert_eq!(Conic::through_points(points)?.kind(), ConicKind::Parabola);
    /// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
    /// ```
    pub fn through_points(points: [DVec2; 5]) -> Result<Self, RationalBezierError> {
        for place in points {
            check_finite("coordinate", &place.to_array())?;
        }
        // Mean 0 and size 1 keep the products comparable.
        let mean = points.iter().fold(DVec2::ZERO, |sum, &place| sum + place * 0.2);
        let size = points.iter().map(|place| place.distance(mean)).fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return Err(RationalBezierError::Degenerate {
                what: "the conic through equal points",
                value: size,
            });
        }
        let matrix = conic_through(points.map(|place| ((place - mean) / size).extend(1.0)))?;
        let local_from_given = DMat3::from_scale(DVec2::splat(size.recip())) * DMat3::from_translation(-mean);
        Self::from_symmetric(local_from_given.transpose() * matrix * local_from_given)
    }

    /// The conic that touches five lines `a x + b y + c = 0`, given as `[a, b, c]`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for a line without a direction, and where four of the lines pass through one point or two are equal.
    pub fn with_tangents(lines: [[f64; 3]; 5]) -> Result<Self, RationalBezierError> {
        for (index, line) in lines.iter().enumerate() {
            check_finite("coefficient", line)?;
            if line[0] == 0.0 && line[1] == 0.0 {
                return Err(RationalBezierError::Degenerate { what: "line", value: index as f64 });
            }
        }
        // In units of the largest distance from the origin.
        let distance = |line: &[f64; 3]| line[2].abs() / line[0].hypot(line[1]);
        let size = lines.iter().map(distance).fold(0.0, f64::max);
        let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let dual = conic_through(lines.map(|[a, b, c]| DVec3::new(a, b, c / size)))?;
        // The adjugate of a symmetric matrix from the cross products of its columns.
        let adjugate = DMat3::from_cols(
            dual.y_axis.cross(dual.z_axis),
            dual.z_axis.cross(dual.x_axis),
            dual.x_axis.cross(dual.y_axis),
        );
        let largest = |m: &DMat3| m.to_cols_array().iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        if dual.determinant().abs() <= VANISHING * largest(&dual).powi(3) {
            let value = dual.determinant();
            return Err(RationalBezierError::Degenerate { what: "the conic of these tangents", value });
        }
        let units = DMat3::from_diagonal(DVec3::new(size.recip(), size.recip(), 1.0));
        Self::from_symmetric(units * adjugate * units)
    }

    fn from_symmetric(a: DMat3) -> Result<Self, RationalBezierError> {
        let mean = |p: f64, q: f64| 0.5 * (p + q);
        Self::new([
            a.x_axis.x,
            mean(a.x_axis.y, a.y_axis.x),
            mean(a.x_axis.z, a.z_axis.x),
            a.y_axis.y,
            mean(a.y_axis.z, a.z_axis.y),
            a.z_axis.z,
        ])
    }
}

/// The symmetric matrix, with entries of about size 1, of the conic through five points in homogeneous coordinates.
fn conic_through(points: [DVec3; 5]) -> Result<DMat3, RationalBezierError> {
    let [a, b, c, d, e] = points.map(|z| z / z.length());
    let line = |p: DVec3, q: DVec3| {
        let line = p.cross(q);
        let sine = line.length();
        if sine <= VANISHING {
            return Err(RationalBezierError::Degenerate {
                what: "the conic through equal points",
                value: sine,
            });
        }
        Ok(line / sine)
    };
    let (ab, cd, ac, bd) = (line(a, b)?, line(c, d)?, line(a, c)?, line(b, d)?);
    line(a, e)?;
    let (one, other) = (ac.dot(e) * bd.dot(e), ab.dot(e) * cd.dot(e));
    let product = |p: DVec3, q: DVec3| {
        let outer = |p: DVec3, q: DVec3| DMat3::from_cols(p * q.x, p * q.y, p * q.z);
        (outer(p, q) + outer(q, p)) * 0.5
    };
    let scale = one.hypot(other);
    let matrix = product(ab, cd) * (one / scale) - product(ac, bd) * (other / scale);
    let size = matrix.to_cols_array().iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    if scale <= VANISHING || size.is_nan() || size <= VANISHING {
        return Err(RationalBezierError::Degenerate {
            what: "a single conic through the points",
            value: scale,
        });
    }
    Ok(matrix * size.recip())
}

impl RationalBezier<DVec2> {
    /// The conic arc with the given control points and the weights `(1, w, 1)`.
    ///
    /// # Errors
    ///
    /// Those of [`RationalBezier::new`].
    pub fn conic_arc(points: [DVec2; 3], middle_weight: f64) -> Result<Self, RationalBezierError> {
        Self::new(points.to_vec(), vec![1.0, middle_weight, 1.0])
    }

    /// The conic arc whose point at `t = 1/2` divides the median, from the middle of the chord to the middle control point, in the ratio `ρ : 1 − ρ`:
    /// `w₁ = ρ/(1 − ρ)`. Ellipse for `ρ < 1/2`, parabola for `ρ = 1/2`, hyperbola for `ρ > 1/2`.
    ///
    /// # Errors
    ///
    /// `OutsideInterval` unless `0 < ρ < 1`; those of [`RationalBezier::new`].
    pub fn conic_with_shoulder(points: [DVec2; 3], rho: f64) -> Result<Self, RationalBezierError> {
        if !(0.0 < rho && rho < 1.0) {
            let (left, right) = (0.0, 1.0);
            return Err(RationalBezierError::OutsideInterval { what: "shoulder", value: rho, left, right });
        }
        Self::conic_arc(points, rho / (1.0 - rho))
    }

    /// The conic arc with the given control points through `place = Σ λᵢ cᵢ`: `w₁ = λ₁/(2 √(λ₀ λ₂))`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for collinear control points; `NoSolution` unless the point is inside the triangle.
    pub fn conic_through(points: [DVec2; 3], place: DVec2) -> Result<Self, RationalBezierError> {
        for point in points.iter().chain([&place]) {
            check_finite("coordinate", &point.to_array())?;
        }
        let [p, q, way] = [points[0], points[2], place].map(|point| point - points[1]);
        let area = p.perp_dot(q);
        if area.is_nan() || area.abs() <= VANISHING * p.length() * q.length() {
            return Err(RationalBezierError::Degenerate { what: "the triangle", value: area });
        }
        let (first, last) = (way.perp_dot(q) / area, p.perp_dot(way) / area);
        let middle = 1.0 - first - last;
        if !(first > 0.0 && middle > 0.0 && last > 0.0) {
            return Err(RationalBezierError::NoSolution { reason: "the point is not inside the triangle" });
        }
        Self::conic_arc(points, middle / (2.0 * first.sqrt() * last.sqrt()))
    }

    /// The conic arc from `start` to `end` with the directions `leaving` and `arriving` there (of any length), through `place`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for parallel directions; `NoSolution` if the directions do not lead around a triangle or the point is not inside it.
    pub fn conic_from_tangents(
        start: DVec2,
        leaving: DVec2,
        end: DVec2,
        arriving: DVec2,
        place: DVec2,
    ) -> Result<Self, RationalBezierError> {
        for point in [start, leaving, end, arriving] {
            check_finite("coordinate", &point.to_array())?;
        }
        let sine = leaving.perp_dot(arriving) / leaving.length() / arriving.length();
        if sine.is_nan() || sine.abs() <= VANISHING {
            return Err(RationalBezierError::Degenerate {
                what: "the intersection of the tangents",
                value: sine,
            });
        }
        let chord = end - start;
        let ahead = chord.perp_dot(arriving) / leaving.perp_dot(arriving);
        let behind = leaving.perp_dot(chord) / leaving.perp_dot(arriving);
        if !(ahead > 0.0 && behind > 0.0) {
            return Err(RationalBezierError::NoSolution {
                reason: "the directions do not lead around a triangle",
            });
        }
        Self::conic_through([start, start + leaving * ahead, end], place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::conic::ConicKind;
    use proptest::prelude::*;

    fn points() -> impl Strategy<Value = [DVec2; 5]> {
        prop::array::uniform5((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from))
    }

    proptest! {
        #[test]
        fn five_points_are_on_their_conic_in_every_order(points in points(), far in -100.0..100.0_f64) {
            let mut points = points.map(|p| p + DVec2::new(far, 2.0 * far));
            let Ok(conic) = Conic::through_points(points) else { return Ok(()) };
            for point in points {
                prop_assert!(conic.residual(point) < 1e-9, "{point}: {}", conic.residual(point));
            }
            points.reverse();
            points.swap(1, 4);
            let other = Conic::through_points(points).unwrap().coefficients();
            let given = conic.coefficients();
            // Proportional coefficients, up to the condition of the data.
            let cross = |i: usize, j: usize| (given[i] * other[j] - given[j] * other[i]).abs();
            let size = given.iter().map(|a| a * a).sum::<f64>().sqrt() * other.iter().map(|a| a * a).sum::<f64>().sqrt();
            for i in 0..6 {
                for j in 0..i {
                    prop_assert!(cross(i, j) < 1e-6 * size, "{given:?} and {other:?}");
                }
            }
        }

        #[test]
        fn five_tangents_of_an_ellipse_give_it_back(
            lengths in (0.5..3.0_f64, 0.5..3.0_f64), turn in 0.0..3.0_f64, center in (-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from),
        ) {
            let spin = DVec2::from_angle(turn);
            let tangent = |k: u32| {
                let at = DVec2::from_angle(0.3 + 1.2 * f64::from(k));
                let normal = spin.rotate(DVec2::new(at.x / lengths.0, at.y / lengths.1));
                let point = spin.rotate(DVec2::new(at.x * lengths.0, at.y * lengths.1)) + center;
                ([normal.x, normal.y, -normal.dot(point)], point)
            };
            let both = [0, 1, 2, 3, 4].map(tangent);
            let conic = Conic::with_tangents(both.map(|(line, _)| line)).unwrap();
            prop_assert_eq!(conic.kind(), ConicKind::Ellipse, "kind");
            for (line, point) in both {
                prop_assert!(conic.residual(point) < 1e-8, "touches at {point}: {}", conic.residual(point));
                let polar = (conic.matrix() * point.extend(1.0)).truncate();
                prop_assert!(polar.perp_dot(DVec2::new(line[0], line[1])).abs() < 1e-6 * polar.length(), "tangent");
            }
        }

        #[test]
        fn arcs_pass_their_point_with_their_tangents(points in points(), share in (0.1..0.8_f64, 0.1..0.8_f64)) {
            let [a, b, c, ..] = points;
            prop_assume!((a - b).perp_dot(c - b).abs() > 0.5 && share.0 + share.1 < 0.95);
            let place = a * share.0 + c * share.1 + b * (1.0 - share.0 - share.1);
            let arc = RationalBezier::conic_from_tangents(a, (b - a) * 0.7, c, (c - b) * 3.0, place).unwrap();
            prop_assert!((arc.points()[1] - b).length() < 1e-10, "middle {}", arc.points()[1]);
            prop_assert!(arc.conic().unwrap().residual(place) < 1e-10, "through the point");
            let w = arc.weights()[1];
            let shoulder = RationalBezier::conic_with_shoulder([a, b, c], w / (1.0 + w)).unwrap();
            prop_assert!((shoulder.weights()[1] - w).abs() < 1e-10 * w, "shoulder form");
            let median = (a + c) * 0.5;
            let at = median + (b - median) * (w / (1.0 + w));
            prop_assert!((shoulder.evaluate(0.5).unwrap() - at).length() < 1e-12, "on the median");
        }
    }

    #[test]
    fn impossible_constructions_are_refused() {
        let at = DVec2::new;
        let (a, b, c) = (at(0.0, 0.0), at(4.0, 0.0), at(4.0, 4.0));
        let outside = RationalBezier::conic_through([a, b, c], at(0.0, 4.0));
        assert_eq!(outside.unwrap_err().name(), "NoSolution", "outside");
        let parallel = RationalBezier::conic_from_tangents(a, at(1.0, 0.0), c, at(2.0, 0.0), at(2.0, 1.0));
        assert_eq!(parallel.unwrap_err().name(), "Degenerate", "parallel tangents");
        let back = RationalBezier::conic_from_tangents(a, at(-1.0, 0.0), c, at(0.0, 1.0), at(3.0, 1.0));
        assert_eq!(back.unwrap_err().name(), "NoSolution", "the wrong way");
        let shoulder = RationalBezier::conic_with_shoulder([a, b, c], 1.0);
        assert_eq!(shoulder.unwrap_err().name(), "OutsideInterval", "at the middle point");
        let name = |points| Conic::through_points(points).unwrap_err().name();
        assert_eq!(name([a; 5]), "Degenerate", "one point");
        assert_eq!(name([a, b, c, at(0.0, 4.0), a]), "Degenerate", "a point twice");
        assert_eq!(name([a, b, c, at(0.0, 4.0), DVec2::NAN]), "NonFinite", "NaN");
        let lines =
            Conic::through_points([a, at(1.0, 0.0), at(2.0, 0.0), at(0.0, 1.0), at(1.0, 2.0)]).unwrap();
        assert!(
            matches!(lines.kind(), ConicKind::Degenerate(_)),
            "three collinear points: {:?}",
            lines.kind()
        );
        let pencil = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 0.0, 1.0]];
        assert_eq!(Conic::with_tangents(pencil).unwrap_err().name(), "Degenerate", "four through a point");
        assert_eq!(Conic::with_tangents([[0.0, 0.0, 1.0]; 5]).unwrap_err().name(), "Degenerate", "no lines");
    }
}
