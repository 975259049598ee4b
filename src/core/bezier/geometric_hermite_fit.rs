//! Approximation of smooth plane curves by cubics with their end points, tangents and curvatures.
//!
//! The error is of order 6 in the length of the pieces wherever the curvature does not vanish; near inflections and on straight parts the order is
//! lost, and such pieces are marked. Course: section 2.7.

use glam::DVec2;

use crate::core::bezier::curvature::Frame;
use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::{BezierError, check_tolerance};
use crate::core::bezier::geometric_hermite::{EndData, geometric_hermite};
use crate::core::point::Point as _;

/// Curvature times chord up to which an end counts as straight.
const FLAT: f64 = 1e-6;
/// Points of a piece at which its distance from the curve is measured.
const SAMPLES: usize = 8;
/// Most pieces of an adaptive approximation.
const MAX_PIECES: usize = 10_000;

/// One cubic of an approximation.
#[derive(Clone, Debug, PartialEq)]
pub struct HermitePiece {
    /// The cubic, over the interval of the given curve that it stands for.
    pub curve: BezierCurve<DVec2>,
    /// Its speeds at the ends over `[0, 1]`.
    pub speeds: [f64; 2],
    /// Largest distance from the given curve at eight points of the cubic.
    pub deviation: f64,
    /// Whether the curvature vanishes at an end or changes its sign, so that the order 6 is not to be expected.
    pub is_flat: bool,
}

/// The cubics between the given increasing parameters, each with the directions and curvatures of the curve at its ends and, among several, the most equal
/// speeds. `curve` gives `p, p′, p″`.
///
/// # Errors
///
/// `SizeMismatch` for fewer than two parameters, `EmptyInterval` unless they increase; `Degenerate` where the speed is 0; those of [`geometric_hermite`]:
/// `NoSolution` for pieces that are too long.
pub fn geometric_hermite_curve(
    curve: impl Fn(f64) -> [DVec2; 3],
    parameters: &[f64],
) -> Result<Vec<HermitePiece>, BezierError> {
    if parameters.len() < 2 {
        return Err(BezierError::SizeMismatch { what: "parameters", expected: 2, found: parameters.len() });
    }
    parameters.windows(2).map(|ends| piece(&curve, (ends[0], ends[1]))).collect()
}

/// As [`geometric_hermite_curve`], over `[a, b]` with pieces that are halved until each has a solution and a deviation of at most `tolerance`.
///
/// # Errors
///
/// `InvalidTolerance`, `EmptyInterval`; `Degenerate` where the speed is 0; `StepLimit` if 10 000 pieces are not enough.
pub fn geometric_hermite_adaptive(
    curve: impl Fn(f64) -> [DVec2; 3],
    interval: (f64, f64),
    tolerance: f64,
) -> Result<Vec<HermitePiece>, BezierError> {
    check_tolerance(tolerance)?;
    let mut found = Vec::new();
    let mut waiting = vec![interval];
    while let Some((a, b)) = waiting.pop() {
        match piece(&curve, (a, b)) {
            Ok(piece) if piece.deviation <= tolerance => found.push(piece),
            Ok(_) | Err(BezierError::NoSolution { .. }) => {
                let middle = a.mix(b, 0.5);
                let value = found.len() + waiting.len() + 2;
                if value > MAX_PIECES || middle <= a || middle >= b {
                    return Err(BezierError::StepLimit { what: "pieces", value, limit: MAX_PIECES });
                }
                waiting.extend([(middle, b), (a, middle)]);
            }
            Err(error) => return Err(error),
        }
    }
    Ok(found)
}

fn piece(curve: &impl Fn(f64) -> [DVec2; 3], (a, b): (f64, f64)) -> Result<HermitePiece, BezierError> {
    let frame = |parameter| {
        Frame::from_derivatives(curve(parameter))
            .ok_or(BezierError::Degenerate { what: "the tangent", parameter })
    };
    if a >= b {
        return Err(BezierError::EmptyInterval { left: a, right: b });
    }
    let (first, last) = (frame(a)?, frame(b)?);
    let end =
        |frame: Frame| EndData { point: frame.point, direction: frame.tangent, curvature: frame.curvature };
    let solution = geometric_hermite(end(first), end(last))?.swap_remove(0);
    let cubic = BezierCurve::on_interval(solution.curve.points().to_vec(), (a, b))?;
    let mut deviation: f64 = 0.0;
    for i in 1..=SAMPLES {
        let x = a.mix(b, i as f64 / (SAMPLES + 1) as f64);
        deviation = deviation.max(distance(curve, cubic.evaluate(x)?, x, (a, b)));
    }
    let chord = first.point.distance(last.point);
    let bends = [first, last].map(|frame| frame.curvature * chord);
    let is_flat = bends.iter().any(|bend| bend.abs() <= FLAT) || bends[0] * bends[1] < 0.0;
    Ok(HermitePiece { curve: cubic, speeds: solution.speeds, deviation, is_flat })
}

/// Distance of `place` from the curve, by Newton's method for the foot from the parameter `x`; an upper bound of it if the method fails.
fn distance(curve: &impl Fn(f64) -> [DVec2; 3], place: DVec2, mut x: f64, (a, b): (f64, f64)) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..8 {
        let [point, first, second] = curve(x);
        let way = point - place;
        least = least.min(way.norm());
        let step = way.dot(first) / (first.dot(first) + way.dot(second));
        if !step.is_finite() {
            break;
        }
        x = (x - step).clamp(a, b);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(t: f64) -> [DVec2; 3] {
        let p = DVec2::from_angle(t);
        [p, p.perp(), -p]
    }

    fn ellipse(t: f64) -> [DVec2; 3] {
        circle(t).map(|p| DVec2::new(2.0 * p.x, p.y))
    }

    fn graph(t: f64) -> [DVec2; 3] {
        [DVec2::new(t, t.exp()), DVec2::new(1.0, t.exp()), DVec2::new(0.0, t.exp())]
    }

    fn sine(t: f64) -> [DVec2; 3] {
        [DVec2::new(t, t.sin()), DVec2::new(1.0, t.cos()), DVec2::new(0.0, -t.sin())]
    }

    /// Largest value of `off`, which vanishes on the curve, on the cubics of `count` pieces.
    fn error(curve: fn(f64) -> [DVec2; 3], off: fn(DVec2) -> f64, (a, b): (f64, f64), count: u32) -> f64 {
        let parameters: Vec<f64> =
            (0..=count).map(|i| a + (b - a) * f64::from(i) / f64::from(count)).collect();
        let mut largest: f64 = 0.0;
        for piece in geometric_hermite_curve(curve, &parameters).unwrap() {
            let (a, b) = piece.curve.interval();
            for i in 0..=64 {
                let point = piece.curve.evaluate(a.mix(b, f64::from(i) / 64.0)).unwrap();
                largest = largest.max(off(point).abs());
            }
        }
        largest
    }

    #[test]
    fn the_error_is_of_order_six() {
        let errors = |count| {
            [
                error(circle, |p| p.length() - 1.0, (0.0, 2.0), count),
                error(ellipse, |p| p.x * p.x / 4.0 + p.y * p.y - 1.0, (0.3, 1.9), count),
                error(graph, |p| p.y - p.x.exp(), (0.0, 1.5), count),
            ]
        };
        let (coarse, fine) = (errors(3), errors(6));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            let order = (coarse / fine).log2();
            assert!((5.5..6.8).contains(&order), "order {order}: {coarse} then {fine}");
        }
    }

    #[test]
    fn the_deviation_is_that_of_the_circle() {
        let piece = &geometric_hermite_curve(circle, &[0.0, 1.0]).unwrap()[0];
        let sample = |i: u32| (piece.curve.evaluate(f64::from(i) / 9.0).unwrap().length() - 1.0).abs();
        let expected = (1..9).map(sample).fold(0.0, f64::max);
        assert!((piece.deviation - expected).abs() < 1e-14, "{} for {expected}", piece.deviation);
        assert!(!piece.is_flat, "the circle bends everywhere");
    }

    #[test]
    fn adaptive_pieces_keep_the_tolerance_across_an_inflection() {
        let pieces = geometric_hermite_adaptive(sine, (-1.5, 2.0), 1e-7).unwrap();
        assert_eq!(pieces[0].curve.interval().0, -1.5, "begins");
        assert_eq!(pieces[pieces.len() - 1].curve.interval().1, 2.0, "ends");
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].curve.interval().1, pair[1].curve.interval().0, "adjoining");
            assert_eq!(pair[0].curve.points()[3], pair[1].curve.points()[0], "one point");
        }
        for piece in &pieces {
            for i in 0..=32 {
                let (a, b) = piece.curve.interval();
                let p = piece.curve.evaluate(a.mix(b, f64::from(i) / 32.0)).unwrap();
                assert!((p.y - p.x.sin()).abs() < 2e-7, "{p}");
            }
        }
        assert!(pieces.len() < 40, "{} pieces", pieces.len());
    }

    #[test]
    fn impossible_approximations_are_refused() {
        let name = |parameters: &[f64]| geometric_hermite_curve(circle, parameters).unwrap_err().name();
        assert_eq!(name(&[0.0]), "SizeMismatch", "one parameter");
        assert_eq!(name(&[1.0, 0.0]), "EmptyInterval", "backwards");
        assert_eq!(name(&[0.0, f64::NAN]), "Degenerate", "NaN");
        let still = geometric_hermite_curve(|_| [DVec2::ZERO; 3], &[0.0, 1.0]);
        assert_eq!(still.unwrap_err().name(), "Degenerate", "a curve that stands still");
        let corner = |t: f64| if t < 0.3 { circle(t) } else { circle(t).map(|p| p + DVec2::ONE) };
        assert_eq!(
            geometric_hermite_adaptive(corner, (0.0, 1.0), 1e-6).unwrap_err().name(),
            "StepLimit",
            "a jump"
        );
        assert_eq!(
            geometric_hermite_adaptive(circle, (0.0, 1.0), 0.0).unwrap_err().name(),
            "InvalidTolerance",
            "zero"
        );
    }
}
