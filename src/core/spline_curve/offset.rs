//! The offset curve `o(t) = p(t) + d·n(t)` of a plane curve, as a spline within a tolerance.
//!
//! `n` is the tangent turned left, so that a positive distance lies to the left, and `o′ = (1 − κd)·p′` with the signed curvature `κ`. Hence
//! values and derivatives of `o` are known everywhere, and cubics take both at the ends of intervals that are halved until they are within the
//! tolerance at equal parameters. Where `κd` reaches 1 the offset curve has a cusp. W. Tiller, E. G. Hanson, *Offsets of two-dimensional
//! profiles*, 1984.

use glam::DVec2;

use crate::core::bspline::{EndKnots, Side, Spline, SplineError, SplineSpace};
use crate::core::spline_curve::{BezierSegment, Frame, Nurbs};

/// The degree of the approximation.
const DEGREE: usize = 3;
/// How many cubics an offset curve may need.
const MOST_PIECES: usize = 8192;
/// Where between its ends a cubic is compared.
const CHECKS: usize = 8;
/// Sine of the angle between tangents that counts as a corner, and the relative jump of derivatives that counts as one.
const CORNER: f64 = 1e-9;

/// An approximation of an offset curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Offset {
    /// A cubic over the parameters of the original, closed if that is; for a straight curve the shifted curve itself.
    pub curve: Nurbs<DVec2>,
    /// The largest distance seen to the true offset point of the same parameter.
    pub measured: f64,
    /// Where it was seen.
    pub at: f64,
}

impl Nurbs<DVec2> {
    /// The curve at `distance` to the left (negative: to the right) within `tolerance`.
    ///
    /// # Errors
    ///
    /// `NonFinite` for `distance`; `InvalidTolerance`; `Degenerate` with the parameter of a corner, of a point without tangent, or where curvature
    /// times distance reaches 1; `StepLimit` if more than 8192 cubics would be needed.
    pub fn offset(&self, distance: f64, tolerance: f64) -> Result<Offset, SplineError> {
        if !distance.is_finite() {
            return Err(SplineError::NonFinite { what: "distance", index: 0, value: distance });
        }
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        let breaks = self.space().breaks();
        if let Some(curve) = self.offset_of_straight(distance)? {
            return Ok(Offset { curve, measured: 0.0, at: breaks[0] });
        }
        self.check_corners(&breaks)?;
        if let Ok(found) = self.vertices() {
            for vertex in &found.vertices {
                for curvature in vertex.curvatures {
                    check_cusp(curvature, distance, vertex.parameter)?;
                }
            }
        }
        let mut pieces = Vec::new();
        for pair in breaks.windows(2) {
            let mut waiting = vec![(pair[0], pair[1])];
            while let Some((a, b)) = waiting.pop() {
                let piece = self.hermite(a, b, distance)?;
                if self.error_of(&piece, distance, CHECKS)?.0 <= 0.8 * tolerance {
                    pieces.push(piece);
                    continue;
                }
                let middle = a.midpoint(b);
                if pieces.len() + waiting.len() >= MOST_PIECES || middle <= a || middle >= b {
                    return Err(SplineError::StepLimit {
                        what: "number of cubics of an offset curve",
                        value: MOST_PIECES + 1,
                        limit: MOST_PIECES,
                    });
                }
                waiting.extend([(middle, b), (a, middle)]);
            }
        }
        let mut worst = (0.0, breaks[0]);
        for piece in &pieces {
            let seen = self.error_of(piece, distance, 4 * CHECKS + 1)?;
            worst = if seen.0 > worst.0 { seen } else { worst };
        }
        let space = self.space_of(&pieces)?;
        let (space, points) = Spline::from_bezier_in(space, &pieces)?.into_parts();
        Ok(Offset { curve: Self::polynomial(space, points)?, measured: worst.0, at: worst.1 })
    }

    /// A curve whose control points go along one line is shifted.
    fn offset_of_straight(&self, distance: f64) -> Result<Option<Self>, SplineError> {
        let points = self.points();
        let way = points[points.len() - 1] - points[0];
        let straight =
            |edge: DVec2| edge.dot(way) >= 0.0 && edge.perp_dot(way).abs() <= 1e-15 * way.length_squared();
        if self.space().is_periodic()
            || way == DVec2::ZERO
            || !points.windows(2).all(|pair| straight(pair[1] - pair[0]))
        {
            return Ok(None);
        }
        let shift = distance * way.normalize().perp();
        self.transformed(|point| point + shift).map(Some)
    }

    fn check_corners(&self, breaks: &[f64]) -> Result<(), SplineError> {
        let last = breaks.len() - 1;
        for (index, &knot) in breaks.iter().enumerate() {
            let before = match (index, self.space().is_periodic()) {
                (0, false) => continue,
                (0, true) => breaks[last],
                _ if index == last => continue,
                _ => knot,
            };
            let (before, after) =
                (self.frame(before, Side::Left)?.tangent, self.frame(knot, Side::Right)?.tangent);
            if before.dot(after) <= 0.0 || before.perp_dot(after).abs() > CORNER {
                return Err(SplineError::Degenerate { what: "the offset of a corner", parameter: knot });
            }
        }
        Ok(())
    }

    /// The cubic with the values and derivatives of the offset curve at both ends.
    fn hermite(&self, a: f64, b: f64, distance: f64) -> Result<BezierSegment<DVec2>, SplineError> {
        let end = |t: f64, side: Side| {
            let frame = self.frame(t, side)?;
            check_cusp(frame.curvature, distance, t)?;
            let derivative = frame.tangent * (frame.speed * (1.0 - frame.curvature * distance));
            Ok::<_, SplineError>((shifted(&frame, distance), derivative * ((b - a) / 3.0)))
        };
        let ((start, out), (stop, into)) = (end(a, Side::Right)?, end(b, Side::Left)?);
        Ok(BezierSegment { interval: (a, b), points: vec![start, start + out, stop - into, stop] })
    }

    /// The largest distance of `piece` to the offset curve among `count` inner parameters, and where.
    fn error_of(
        &self,
        piece: &BezierSegment<DVec2>,
        distance: f64,
        count: usize,
    ) -> Result<(f64, f64), SplineError> {
        let (a, b) = piece.interval;
        let mut worst = (0.0, a);
        for i in 1..=count {
            let u = i as f64 / (count + 1) as f64;
            let t = a + u * (b - a);
            if t <= a || t >= b {
                continue;
            }
            let frame = self.frame(t, Side::Right)?;
            check_cusp(frame.curvature, distance, t)?;
            let p = &piece.points;
            let v = 1.0 - u;
            let place = v * v * (v * p[0] + 3.0 * u * p[1]) + u * u * (3.0 * v * p[2] + u * p[3]);
            let error = place.distance(shifted(&frame, distance));
            if error > worst.0 {
                worst = (error, t);
            }
        }
        Ok(worst)
    }

    /// Double knots between the pieces, triple ones where the derivative jumps because the curvature does.
    fn space_of(&self, pieces: &[BezierSegment<DVec2>]) -> Result<SplineSpace, SplineError> {
        let slope = |from: usize, to: usize, piece: &BezierSegment<DVec2>| {
            (piece.points[to] - piece.points[from]) / (piece.interval.1 - piece.interval.0)
        };
        let copies = |before: &BezierSegment<DVec2>, after: &BezierSegment<DVec2>| {
            let (left, right) = (slope(2, 3, before), slope(0, 1, after));
            if left.distance(right) <= CORNER * left.length() { DEGREE - 1 } else { DEGREE }
        };
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        let period = self.space().period();
        let ends = if period.is_some() { copies(last, first) } else { 1 };
        let mut knots = vec![first.interval.0; ends];
        for pair in pieces.windows(2) {
            knots.extend(std::iter::repeat_n(pair[1].interval.0, copies(&pair[0], &pair[1])));
        }
        match period {
            Some(period) => SplineSpace::periodic(DEGREE, period, knots),
            None => {
                knots.push(last.interval.1);
                SplineSpace::from_breaks(DEGREE, &knots, EndKnots::Interpolating)
            }
        }
    }
}

fn shifted(frame: &Frame, distance: f64) -> DVec2 {
    frame.point + distance * frame.normal
}

fn check_cusp(curvature: f64, distance: f64, parameter: f64) -> Result<(), SplineError> {
    if curvature * distance < 1.0 {
        return Ok(());
    }
    Err(SplineError::Degenerate { what: "the offset where curvature times distance reaches 1", parameter })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

    use super::*;

    fn samples(curve: &Nurbs<DVec2>) -> Vec<(f64, DVec2)> {
        let (left, right) = curve.space().parameter_interval();
        (0..=997)
            .map(|i| left + (right - left) * f64::from(i) / 997.0)
            .map(|t| (t, curve.evaluate(t).unwrap()))
            .collect()
    }

    fn wave(weights: [f64; 7]) -> Nurbs<DVec2> {
        let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.5, 4.0, 4.0, 4.0, 5.0];
        let points =
            [[-5.0, -1.0], [-4.0, 1.0], [-2.0, 3.0], [-0.5, 0.0], [1.5, -2.0], [2.5, 3.0], [4.0, 1.0]];
        Nurbs::new(SplineSpace::new(3, knots).unwrap(), points.map(DVec2::from).to_vec(), weights.to_vec())
            .unwrap()
    }

    #[test]
    fn circles_become_circles() {
        let circle = Nurbs::circle(DVec2::new(1.0, -2.0), 2.0).unwrap();
        for (distance, radius) in [(0.5, 1.5), (-1.0, 3.0), (1.9, 0.1)] {
            let offset = circle.offset(distance, 1e-5).unwrap();
            assert!(offset.curve.space().is_periodic(), "closed");
            for (t, place) in samples(&offset.curve) {
                let error = (place.distance(DVec2::new(1.0, -2.0)) - radius).abs();
                assert!(error <= 1e-5, "{distance}, {t}: {error}");
            }
        }
        for distance in [2.0, 2.5] {
            assert_eq!(
                circle.offset(distance, 1e-5).unwrap_err().name(),
                "Degenerate",
                "{distance}: through the centre"
            );
        }
    }

    #[test]
    fn lines_are_shifted_exactly() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 3.0, 3.0, 4.0]).unwrap();
        let line = Nurbs::polynomial(
            space,
            [[0.0, 1.0], [1.0, 1.0], [5.0, 1.0], [6.0, 1.0]].map(DVec2::from).to_vec(),
        )
        .unwrap();
        let offset = line.offset(0.25, 1e-6).unwrap();
        assert_eq!(offset.measured.to_bits(), 0.0_f64.to_bits(), "exact");
        assert_eq!(
            offset.curve,
            line.transformed(|point| point + DVec2::new(0.0, 0.25)).unwrap(),
            "to the left"
        );
    }

    #[test]
    fn the_distance_is_kept_within_the_tolerance() {
        for curve in [wave([1.0; 7]), wave([1.0, 2.0, 0.7, 1.0, 1.5, 1.0, 1.0])] {
            for distance in [0.2, -0.15] {
                for tolerance in [1e-2, 1e-4, 1e-6] {
                    let offset = curve.offset(distance, tolerance).unwrap();
                    assert!(offset.measured <= tolerance, "measured {} above {tolerance}", offset.measured);
                    for (t, place) in samples(&offset.curve) {
                        let frame = curve
                            .frame(t.clamp(0.0, 4.0), Side::Right)
                            .unwrap_or_else(|_| curve.frame(t, Side::Left).unwrap());
                        let error = place.distance(frame.point + distance * frame.normal);
                        assert!(error <= tolerance, "{distance}, {tolerance}, {t}: {error}");
                        let apart = curve.closest_point(place).unwrap().distance;
                        assert!((apart - distance.abs()).abs() <= tolerance, "{t}: {apart} from the curve");
                    }
                }
            }
        }
    }

    #[test]
    fn corners_cusps_and_bad_numbers_are_refused_with_their_places() {
        let space = SplineSpace::from_breaks(1, &[0.0, 1.0, 2.0], EndKnots::Interpolating).unwrap();
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(DVec2::from).to_vec();
        let error = Nurbs::polynomial(space, points).unwrap().offset(0.1, 1e-3).unwrap_err();
        let wanted = SplineError::Degenerate { what: "the offset of a corner", parameter: 1.0 };
        assert_eq!(error, wanted, "the corner");
        // y = x² has curvature 2 at 0.
        let space = SplineSpace::from_breaks(2, &[-1.0, 1.0], EndKnots::Interpolating).unwrap();
        let parabola =
            Nurbs::polynomial(space, [[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]].map(DVec2::from).to_vec())
                .unwrap();
        assert!(
            parabola.offset(0.49, 1e-4).is_ok() && parabola.offset(-3.0, 1e-4).is_ok(),
            "below 1/κ, and outside"
        );
        match parabola.offset(0.51, 1e-4).unwrap_err() {
            SplineError::Degenerate { parameter, .. } => assert!(parameter.abs() < 0.2, "{parameter}"),
            other => panic!("{other}"),
        }
        assert_eq!(parabola.offset(f64::NAN, 1e-4).unwrap_err().name(), "NonFinite", "no number");
        assert_eq!(parabola.offset(0.1, 0.0).unwrap_err().name(), "InvalidTolerance", "nothing is exact");
    }
}
