//! Circles, arcs and ellipses as rational curves of any degree from 2.
//!
//! With a complex polynomial `α` that turns by half of the arc, `r = α²/|α|²` runs on the unit circle. Linear `α` gives the quadratic arc with `w₁ = cos φ/2` for
//! the opening `φ < 180°`, positive weights at degree 3 for `φ < 240°`; quadratic `α` with the Bernstein coefficients `e^(iu), m e^(i(u+v)/2), e^(iv)`, `h = v − u` and
//! `m = max(cos h/2, sin h/2)`, degree 4 for `φ < 360°` and, elevated once, the whole circle. Beyond the course (B.12).

use std::f64::consts::{FRAC_PI_3, PI, TAU};

use glam::DVec2;

use crate::core::bezier::BezierCurve;
use crate::core::point::Point as _;
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::rational_bezier::{Projective as _, RationalBezier};

/// Angles that exceed the full circle by less are the full circle.
const ROUNDING: f64 = 1e-12;

/// The arc of the circle from the angle `from` to the angle `to` (radians, clockwise if `to < from`) as one curve over `[0, 1]` with positive weights.
///
/// Openings are below 180° for degree 2, below 240° for degree 3, below 360° for degree 4, at most 360° from degree 5.
///
/// # Errors
///
/// `NonFinite`; `Degenerate` unless the radius is positive; `NotInSpace` for degree 0 and 1; `OutsideInterval` with the opening.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::rational_bezier::circle_arc_piece;
///
/// let whole = circle_arc_piece(DVec2::ZERO, 1.0, [0.0, std::f64::consts::TAU], 5)?;
/// assert!((whole.evaluate(0.25)? - DVec2::new(0.28, 0.96)).length() < 1e-15);
/// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
/// ```
pub fn circle_arc_piece(
    center: DVec2,
    radius: f64,
    [from, to]: [f64; 2],
    degree: usize,
) -> Result<RationalBezier<DVec2>, RationalBezierError> {
    check_finite("angle", &[from, to])?;
    check_finite("circle", &[center.x, center.y, radius])?;
    if radius <= 0.0 {
        return Err(RationalBezierError::Degenerate { what: "a circle", value: radius });
    }
    let limit = match degree {
        0 | 1 => return Err(RationalBezierError::NotInSpace { degree, reason: "it would be straight" }),
        2 => PI,
        3 => 4.0 * FRAC_PI_3,
        _ => TAU,
    };
    let opening = (to - from).abs();
    let is_whole = (opening - TAU).abs() <= ROUNDING;
    let fits = opening < limit - ROUNDING || (degree > 4 && is_whole);
    if !(opening > 0.0 && fits) {
        let (left, right) = (0.0, limit);
        return Err(RationalBezierError::OutsideInterval { what: "opening", value: opening, left, right });
    }
    let half = 0.5 * (to - from);
    let direction = |share: f64| DVec2::from_angle(from + share * (to - from));
    let end = if is_whole { direction(0.0) } else { direction(1.0) };
    // Bernstein coefficients of (α², |α|²): products of exponentials, the angle of α² is twice that of α.
    let homogeneous = if degree < 4 {
        vec![direction(0.0).extend(1.0), direction(0.5).extend(half.cos()), end.extend(1.0)]
    } else {
        let m = (0.5 * half).cos().abs().max((0.5 * half).sin().abs());
        let inner = |share: f64| (direction(share) * m).extend(m * (0.5 * half).cos());
        let middle = direction(0.5) * ((2.0 * m * m + 1.0) / 3.0);
        let weight = (2.0 * m * m + half.cos()) / 3.0;
        let start = direction(0.0).extend(1.0);
        vec![start, inner(0.25), middle.extend(weight), inner(0.75), end.extend(1.0)]
    };
    let native = homogeneous.len() - 1;
    let raised = BezierCurve::new(homogeneous)?.elevate_degree_by(degree - native);
    let one = |&lifted| {
        let (point, weight) = DVec2::project(lifted);
        (center + point * radius, weight)
    };
    let (points, weights) = raised.points().iter().map(one).unzip();
    RationalBezier::new(points, weights)
}

/// The arc as `pieces` curves with equal openings over `[0, 1], [1, 2], …`; neighbours share their end point bit for bit, with weight 1.
///
/// # Errors
///
/// Those of [`circle_arc_piece`]; `SizeMismatch` for no pieces.
pub fn circle_arc(
    center: DVec2,
    radius: f64,
    [from, to]: [f64; 2],
    degree: usize,
    pieces: usize,
) -> Result<Vec<RationalBezier<DVec2>>, RationalBezierError> {
    if pieces == 0 {
        return Err(RationalBezierError::SizeMismatch { what: "pieces", expected: 1, found: 0 });
    }
    check_finite("angle", &[from, to])?;
    let opening = (to - from).abs();
    if opening > TAU + ROUNDING {
        let (left, right) = (0.0, TAU);
        return Err(RationalBezierError::OutsideInterval { what: "opening", value: opening, left, right });
    }
    let angle = |k: usize| from.mix(to, k as f64 / pieces as f64);
    let mut arcs: Vec<RationalBezier<DVec2>> = Vec::with_capacity(pieces);
    for k in 0..pieces {
        let piece = circle_arc_piece(center, radius, [angle(k), angle(k + 1)], degree)?;
        let mut points = piece.points().to_vec();
        if let Some(before) = arcs.last() {
            points[0] = before.points()[degree];
        }
        if k + 1 == pieces && (opening - TAU).abs() <= ROUNDING {
            points[degree] = arcs.first().map_or(points[0], |first| first.points()[0]);
        }
        let interval = (k as f64, (k + 1) as f64);
        arcs.push(RationalBezier::on_interval(points, piece.weights().to_vec(), interval)?);
    }
    Ok(arcs)
}

/// The arc as the fewest quadratic curves with openings of at most 120°, middle weights at least 1/2; see [`circle_arc`].
///
/// # Errors
///
/// As [`circle_arc`].
pub fn quadratic_arc(
    center: DVec2,
    radius: f64,
    angles: [f64; 2],
) -> Result<Vec<RationalBezier<DVec2>>, RationalBezierError> {
    let opening = (angles[1] - angles[0]).abs() / (2.0 * FRAC_PI_3);
    circle_arc(center, radius, angles, 2, ((opening - ROUNDING).ceil() as usize).clamp(1, 3))
}

/// The whole circle, counterclockwise from its rightmost point, as [`circle_arc`].
///
/// # Errors
///
/// As [`circle_arc`].
pub fn circle(
    center: DVec2,
    radius: f64,
    degree: usize,
    pieces: usize,
) -> Result<Vec<RationalBezier<DVec2>>, RationalBezierError> {
    circle_arc(center, radius, [0.0, TAU], degree, pieces)
}

/// The whole ellipse with the given semi-axes, the first turned left by `angle` from the direction of x: an affine image of the unit circle, with its weights.
///
/// # Errors
///
/// As [`circle`]; `Degenerate` unless both semi-axes are positive.
pub fn ellipse(
    center: DVec2,
    semi_axes: [f64; 2],
    angle: f64,
    degree: usize,
    pieces: usize,
) -> Result<Vec<RationalBezier<DVec2>>, RationalBezierError> {
    check_finite("ellipse", &[center.x, center.y, semi_axes[0], semi_axes[1], angle])?;
    if let Some(&value) = semi_axes.iter().find(|&&length| length <= 0.0) {
        return Err(RationalBezierError::Degenerate { what: "an ellipse", value });
    }
    let spin = DVec2::from_angle(angle);
    let place = |p: DVec2| center + spin.rotate(DVec2::new(p.x * semi_axes[0], p.y * semi_axes[1]));
    circle(DVec2::ZERO, 1.0, degree, pieces)?.iter().map(|arc| arc.transformed(place)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::quadrature::gauss_legendre;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn arcs_stay_on_their_circle(
            degree in 2_usize..9, share in 0.05..0.999_f64, from in -4.0..4.0_f64, clockwise in prop::bool::ANY, t in 0.0..=1.0_f64,
        ) {
            let most = [PI, 4.0 * FRAC_PI_3, TAU][(degree - 2).min(2)];
            let sign = if clockwise { -1.0 } else { 1.0 };
            let to = from + sign * share * most;
            let arc = circle_arc_piece(DVec2::new(1.0, -2.0), 3.0, [from, to], degree).unwrap();
            prop_assert_eq!(arc.degree(), degree, "degree");
            prop_assert!(arc.weights().iter().all(|&w| w > 0.0), "weights {:?}", arc.weights());
            // The points of nearly opposite tangents lie far out and cost digits.
            let size = arc.points().iter().map(|c| c.length()).fold(3.0, f64::max);
            let radius = arc.evaluate(t).unwrap().distance(DVec2::new(1.0, -2.0));
            prop_assert!((radius - 3.0).abs() < 1e-14 * size, "radius {radius}");
            let start = DVec2::new(1.0, -2.0) + 3.0 * DVec2::from_angle(from);
            let end = DVec2::new(1.0, -2.0) + 3.0 * DVec2::from_angle(to);
            prop_assert!((arc.evaluate(0.0).unwrap() - start).length() < 1e-14, "start");
            prop_assert!((arc.evaluate(1.0).unwrap() - end).length() < 1e-14, "end");
            let curvature = arc.curvature(t).unwrap();
            prop_assert!((curvature - sign / 3.0).abs() < 1e-9 * size, "curvature {curvature}");
        }
    }

    #[test]
    fn whole_circles_close_with_the_right_length() {
        let rule = gauss_legendre(40).unwrap();
        for (degree, pieces) in [(2, 3), (2, 4), (3, 2), (4, 2), (5, 1), (6, 1), (5, 3), (9, 2)] {
            let arcs = circle(DVec2::ZERO, 2.0, degree, pieces).unwrap();
            assert_eq!(arcs.len(), pieces, "degree {degree}");
            let mut length = 0.0;
            for (k, arc) in arcs.iter().enumerate() {
                let next = &arcs[(k + 1) % pieces];
                assert_eq!(arc.points()[degree], next.points()[0], "shared point, degree {degree}");
                assert_eq!(arc.weights()[degree], next.weights()[0], "shared weight, degree {degree}");
                let (a, b) = arc.interval();
                length += rule.integrate(a, b, |x| arc.derivatives(x, 1).unwrap()[1].length());
            }
            assert!((length - 2.0 * TAU).abs() < 1e-9, "degree {degree}, {pieces} pieces: length {length}");
        }
    }

    #[test]
    fn quadratic_arcs_have_as_few_pieces_as_120_degrees_allow() {
        for (degrees, count) in [(1.0_f64, 1), (120.0, 1), (121.0, 2), (240.0, 2), (-300.0, 3), (360.0, 3)] {
            let arcs = quadratic_arc(DVec2::ONE, 2.0, [0.5, 0.5 + degrees.to_radians()]).unwrap();
            assert_eq!(arcs.len(), count, "{degrees} degrees");
            assert!(arcs.iter().all(|arc| arc.weights()[1] > 0.5 - 1e-12), "weights of {degrees} degrees");
        }
        let twice = quadratic_arc(DVec2::ZERO, 1.0, [0.0, 7.0]);
        assert_eq!(twice.unwrap_err().name(), "OutsideInterval", "more than the circle");
    }

    #[test]
    fn ellipses_are_images_of_circles() {
        let arcs = ellipse(DVec2::ONE, [3.0, 0.5], 0.7, 2, 4).unwrap();
        for arc in &arcs {
            for i in 0..=10 {
                let (a, b) = arc.interval();
                let p = DVec2::from_angle(-0.7)
                    .rotate(arc.evaluate(a.mix(b, f64::from(i) / 10.0)).unwrap() - DVec2::ONE);
                assert!((p.x * p.x / 9.0 + p.y * p.y * 4.0 - 1.0).abs() < 1e-13, "{p}");
            }
        }
        assert_eq!(ellipse(DVec2::ZERO, [1.0, 0.0], 0.0, 2, 4).unwrap_err().name(), "Degenerate", "flat");
    }

    #[test]
    fn impossible_arcs_are_refused() {
        let name = |opening: f64, degree| {
            circle_arc_piece(DVec2::ZERO, 1.0, [0.0, opening], degree).unwrap_err().name()
        };
        assert_eq!(name(PI, 2), "OutsideInterval", "half a circle of degree 2");
        assert_eq!(name(TAU, 4), "OutsideInterval", "a circle of degree 4");
        assert_eq!(name(7.0, 6), "OutsideInterval", "more than a circle");
        assert_eq!(name(0.0, 2), "OutsideInterval", "a point");
        assert_eq!(name(1.0, 1), "NotInSpace", "degree 1");
        assert_eq!(name(f64::NAN, 2), "NonFinite", "NaN");
        assert_eq!(circle(DVec2::ZERO, 0.0, 2, 4).unwrap_err().name(), "Degenerate", "no radius");
        assert_eq!(circle(DVec2::ZERO, 1.0, 2, 0).unwrap_err().name(), "SizeMismatch", "no pieces");
        assert_eq!(circle(DVec2::ZERO, 1.0, 2, 2).unwrap_err().name(), "OutsideInterval", "two halves");
    }
}
