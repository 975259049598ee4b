//! Geometric Hermite interpolation: cubics with given end points, tangent directions and curvatures.
//!
//! With `c₁ = f₀ + α₀ d₀/3` and `c₂ = f₁ − α₁ d₁/3` the end speeds `α₀, α₁ > 0` solve two quadratic equations, in units of the chord `|f₁ − f₀|` and with
//! `e` its direction:
//!
//! ```text
//! κ₀ α₀² = R₀ − 2 D α₁,  κ₁ α₁² = R₁ − 2 D α₀,   D = det(d₀, d₁), R₀ = 6 det(d₀, e), R₁ = 6 det(e, d₁)
//! ```
//!
//! Two parabolas: at most three common points with positive coordinates, perhaps none. Where the curvature does not vanish the error of
//! short pieces is of order 6. Course: section 2.7; C. de Boor, K. Höllig, M. Sabin, *High accuracy geometric Hermite interpolation*, 1987.

use glam::DVec2;

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point as _;
use crate::core::polynomial::bernstein_from_monomial;
use crate::core::root_finding::bernstein_zeros;

/// Largest deviation of the length of a direction from 1.
const UNIT: f64 = 1e-12;
/// Determinants and curvatures, in units of the chord, up to which data are straight.
const STRAIGHT: f64 = 1e-12;
/// Largest residual of a solution, relative to the terms of the equations.
const RESIDUAL: f64 = 1e-11;
/// Solutions closer than this, relative to their size, are one.
const SAME: f64 = 1e-7;

/// What is prescribed at one end of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndData {
    /// The point.
    pub point: DVec2,
    /// The unit tangent in the direction of the curve.
    pub direction: DVec2,
    /// The signed curvature, positive in left turns.
    pub curvature: f64,
}

/// A cubic with the prescribed ends.
#[derive(Clone, Debug, PartialEq)]
pub struct GeometricHermite {
    /// The speeds `(α₀, α₁)` at the ends over `[0, 1]`.
    pub speeds: [f64; 2],
    /// The cubic over `[0, 1]`.
    pub curve: BezierCurve<DVec2>,
}

/// All cubics with the data `start` and `end` and positive speeds, those with the most equal speeds first.
///
/// *Straight data* (both directions along the chord, both curvatures 0 up to 1e-12) have infinitely many solutions that all draw the segment; the answer is
/// the one of constant speed.
///
/// # Errors
///
/// `NonFinite`; `DirectionNotUnit`; `Degenerate` for coinciding points, and for data on a line with a direction against the chord; `NoSolution`.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::bezier::{EndData, geometric_hermite};
///
/// let start = EndData { point: DVec2::ZERO, direction: DVec2::X, curvature: 13.0 / 24.0 };
/// let end = EndData { point: DVec2::ONE, direction: DVec2::Y, curvature: 13.0 / 24.0 };
/// assert_eq!(geometric_hermite(start, end)?.len(), 3);
/// # Ok::<(), spline_lab::core::bezier::BezierError>(())
/// ```
pub fn geometric_hermite(start: EndData, end: EndData) -> Result<Vec<GeometricHermite>, BezierError> {
    let ends = [start, end];
    for (index, data) in ends.iter().enumerate() {
        let numbers = [data.point.x, data.point.y, data.direction.x, data.direction.y, data.curvature];
        if let Some(value) = numbers.into_iter().find(|value| !value.is_finite()) {
            return Err(BezierError::NonFinite { what: "end", index, value });
        }
    }
    for (index, data) in ends.iter().enumerate() {
        let length = data.direction.norm();
        if (length - 1.0).abs() > UNIT {
            return Err(BezierError::DirectionNotUnit { index, length });
        }
    }
    let chord = (end.point - start.point).norm();
    if chord <= 0.0 || !chord.is_finite() {
        return Err(BezierError::Degenerate { what: "the chord", parameter: chord });
    }
    let along = (end.point - start.point) / chord;
    let equations = Equations {
        curvatures: ends.map(|data| data.curvature * chord),
        turn: start.direction.perp_dot(end.direction),
        right: [6.0 * start.direction.perp_dot(along), 6.0 * along.perp_dot(end.direction)],
    };
    let bent = ends.iter().any(|data| {
        data.direction.perp_dot(along).abs() > STRAIGHT || data.curvature.abs() * chord > STRAIGHT
    });
    let solutions = if bent {
        equations.solve()
    } else if ends.iter().all(|data| data.direction.dot(along) > 0.0) {
        vec![[1.0, 1.0]]
    } else {
        return Err(BezierError::Degenerate { what: "a segment against its chord", parameter: chord });
    };
    let mut found = Vec::with_capacity(solutions.len());
    for [a, b] in solutions {
        let speeds = [a * chord, b * chord];
        let second = start.point + start.direction * (speeds[0] / 3.0);
        let third = end.point - end.direction * (speeds[1] / 3.0);
        let curve = BezierCurve::new(vec![start.point, second, third, end.point])?;
        found.push(GeometricHermite { speeds, curve });
    }
    if found.is_empty() {
        return Err(BezierError::NoSolution { reason: "no positive end speeds give these curvatures" });
    }
    found.sort_by(|p, q| {
        let difference = |s: &GeometricHermite| (s.speeds[0] - s.speeds[1]).abs();
        difference(p).total_cmp(&difference(q)).then(p.speeds[0].total_cmp(&q.speeds[0]))
    });
    Ok(found)
}

/// The two equations in units of the chord.
struct Equations {
    curvatures: [f64; 2],
    turn: f64,
    right: [f64; 2],
}

impl Equations {
    /// All solutions with positive speeds.
    fn solve(&self) -> Vec<[f64; 2]> {
        let ([k, l], [r, s], d) = (self.curvatures, self.right, 2.0 * self.turn);
        let mut found: Vec<[f64; 2]> = Vec::new();
        let mut consider = |a: f64, b: f64| {
            let Some(solution) = self.polished([a, b]) else { return };
            let size = solution[0].max(solution[1]);
            let is_same = |other: &[f64; 2]| (0..2).all(|j| (other[j] - solution[j]).abs() <= SAME * size);
            if !found.iter().any(is_same) {
                found.push(solution);
            }
        };
        // One curvature 0: its equation is linear, and the other follows.
        if l == 0.0 {
            let a = s / d;
            consider(a, (r - k * a * a) / d);
        }
        if k == 0.0 {
            let b = r / d;
            consider((s - l * b * b) / d, b);
        }
        // Elimination of α₁: l (r − k α₀²)² = d² (s − d α₀), on [0, 1] and, in 1/α₀, on [1, ∞).
        let mut quartic = [l * r * r - d * d * s, d * d * d, -2.0 * k * l * r, 0.0, l * k * k];
        for inverted in [false, true] {
            let coefficients = bernstein_from_monomial(&quartic, (0.0, 1.0)).unwrap_or_default();
            for zero in bernstein_zeros(&coefficients, 0.0).isolated() {
                let a = if inverted { zero.at.recip() } else { zero.at };
                consider(a, (r - k * a * a) / d);
                consider(a, ((s - d * a) / l).sqrt());
            }
            quartic.reverse();
        }
        // Both speeds at once if the directions are parallel. Last: where two solutions merge, the quartic knows them best.
        consider((r / k).sqrt(), (s / l).sqrt());
        found
    }

    /// Left minus right sides.
    fn residual(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let d = 2.0 * self.turn;
        let [k, l] = self.curvatures;
        [k * a * a + d * b - self.right[0], l * b * b + d * a - self.right[1]]
    }

    /// Size of the terms of the equations.
    fn scale(&self, [a, b]: [f64; 2]) -> f64 {
        let terms = (self.curvatures[0] * a * a).abs().max((self.curvatures[1] * b * b).abs());
        terms.max(self.turn.abs() * a.max(b)).max(self.right[0].abs()).max(self.right[1].abs())
    }

    /// Newton's method as long as the residual is more than rounding and shrinks (beyond that it only wanders, far where two solutions merge);
    /// `None` unless the speeds are positive and the residual is small.
    fn polished(&self, mut speeds: [f64; 2]) -> Option<[f64; 2]> {
        let size = |residual: [f64; 2]| residual[0].hypot(residual[1]);
        let mut left = size(self.residual(speeds));
        for _ in 0..50 {
            let ([k, l], d, [f, g]) = (self.curvatures, 2.0 * self.turn, self.residual(speeds));
            let [a, b] = speeds;
            let determinant = 4.0 * k * l * a * b - d * d;
            let next =
                [a - (2.0 * l * b * f - d * g) / determinant, b - (2.0 * k * a * g - d * f) / determinant];
            let smaller = size(self.residual(next));
            if left <= 4.0 * f64::EPSILON * self.scale(speeds) || smaller.is_nan() || smaller >= left {
                break;
            }
            (speeds, left) = (next, smaller);
        }
        let positive = speeds.iter().all(|&speed| speed > STRAIGHT);
        (positive && left <= RESIDUAL * self.scale(speeds)).then_some(speeds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bezier::curvature::Frame;
    use proptest::prelude::*;

    fn end(point: [f64; 2], angle: f64, curvature: f64) -> EndData {
        EndData { point: DVec2::from(point), direction: DVec2::from_angle(angle), curvature }
    }

    fn of(frame: Frame) -> EndData {
        EndData { point: frame.point, direction: frame.tangent, curvature: frame.curvature }
    }

    proptest! {
        #[test]
        fn the_cubic_behind_the_data_is_among_at_most_three_solutions(
            points in prop::collection::vec((-2.0..2.0_f64, -2.0..2.0_f64).prop_map(DVec2::from), 4),
        ) {
            let cubic = BezierCurve::new(points).unwrap();
            let (first, last) = (cubic.frame(0.0).unwrap(), cubic.frame(1.0).unwrap());
            prop_assume!(first.speed > 0.3 && last.speed > 0.3 && (first.point - last.point).length() > 0.3);
            let determinant = 4.0 * first.curvature * last.curvature * first.speed * last.speed
                - 4.0 * first.tangent.perp_dot(last.tangent).powi(2);
            prop_assume!(determinant.abs() > 1e-2);
            let solutions = geometric_hermite(of(first), of(last)).unwrap();
            prop_assert!(solutions.len() <= 3, "{} solutions", solutions.len());
            let gap = |s: &GeometricHermite| (s.speeds[0] - first.speed).abs() + (s.speeds[1] - last.speed).abs();
            let best = solutions.iter().map(gap).fold(f64::INFINITY, f64::min);
            prop_assert!(best < 1e-7, "missed by {best}: {:?}", solutions);
            for solution in &solutions {
                for (x, wanted) in [(0.0, &first), (1.0, &last)] {
                    let got = solution.curve.frame(x).unwrap();
                    prop_assert!((got.point - wanted.point).length() < 1e-13, "point");
                    prop_assert!((got.tangent - wanted.tangent).length() < 1e-9, "direction");
                    prop_assert!((got.curvature - wanted.curvature).abs() < 1e-6 * (1.0 + wanted.curvature.abs()), "curvature");
                }
            }
        }

        #[test]
        fn similar_data_have_similar_solutions(
            angles in (-1.4..1.4_f64, -1.4..1.4_f64), curvatures in (-3.0..3.0_f64, -3.0..3.0_f64),
            turn in 0.0..6.3_f64, size in 0.2..5.0_f64,
        ) {
            let (start, stop) = (end([0.0, 0.0], angles.0, curvatures.0), end([1.0, 0.0], angles.1, curvatures.1));
            let speeds = |start, stop| match geometric_hermite(start, stop) {
                Ok(solutions) => solutions.into_iter().map(|s| s.speeds).collect::<Vec<_>>(),
                Err(_) => Vec::new(),
            };
            let plain = speeds(start, stop);
            let same = |other: Vec<[f64; 2]>, map: &dyn Fn([f64; 2]) -> [f64; 2]| {
                other.len() == plain.len()
                    && other.iter().all(|q| plain.iter().any(|&p| {
                        let p = map(p);
                        (p[0] - q[0]).abs() + (p[1] - q[1]).abs() < 1e-4 * (p[0] + p[1])
                    }))
            };
            let spin = DVec2::from_angle(turn);
            let moved = |data: EndData| EndData {
                point: spin.rotate(data.point) * size + DVec2::new(2.0, -1.0),
                direction: spin.rotate(data.direction),
                curvature: data.curvature / size,
            };
            prop_assert!(same(speeds(moved(start), moved(stop)), &|[a, b]| [a * size, b * size]), "similarity");
            let mirrored = |data: EndData| EndData {
                point: data.point * DVec2::new(1.0, -1.0),
                direction: data.direction * DVec2::new(1.0, -1.0),
                curvature: -data.curvature,
            };
            prop_assert!(same(speeds(mirrored(start), mirrored(stop)), &|p| p), "reflection");
            let back = |data: EndData| EndData { direction: -data.direction, curvature: -data.curvature, ..data };
            prop_assert!(same(speeds(back(stop), back(start)), &|[a, b]| [b, a]), "direction");
        }
    }

    #[test]
    fn impossible_data_are_refused() {
        let name = |a, b| geometric_hermite(a, b).unwrap_err().name();
        let start = end([0.0, 0.0], 0.0, 0.0);
        assert_eq!(name(start, end([0.0, 0.0], 1.0, 1.0)), "Degenerate", "one point");
        assert_eq!(name(start, end([-1.0, 0.0], 0.0, 0.0)), "Degenerate", "against the chord");
        assert_eq!(name(start, end([1.0, 0.0], 0.0, f64::NAN)), "NonFinite", "NaN");
        assert_eq!(name(start, end([1.0, 0.0], 0.0, 1.0)), "NoSolution", "a line cannot bend");
        let long = EndData { direction: DVec2::ONE, ..start };
        assert_eq!(name(long, end([1.0, 0.0], 0.0, 1.0)), "DirectionNotUnit", "length √2");
        let far = end([1e308, -1e308], 0.0, 1.0);
        assert_eq!(name(end([-1e308, 1e308], 0.0, 1.0), far), "Degenerate", "the chord overflows");
    }
}
