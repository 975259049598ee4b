//! Splines from Bezier curves that join.
//!
//! Consecutive Bezier curves of one degree are a spline with `n`-fold breaks; in a space with fewer copies its coefficients are
//! the blossoms `P[ξₖ₊₁, …, ξₖ₊ₙ]` of a piece, if the pieces join as smoothly as the space demands. Course: section 6.4.

use crate::core::bspline::{EndKnots, Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::{BezierSegment, Nurbs, RationalSegment};

/// Distance of two pieces, relative to the largest control point, that still counts as rounding.
const AGREEMENT: f64 = 1e-10;

impl<P: Point> Spline<P> {
    /// The open spline with `n`-fold breaks of Bezier curves over consecutive intervals.
    ///
    /// # Errors
    ///
    /// `Empty`; `SizeMismatch` for different degrees; `BoundaryMismatch` with the index of the later piece where two intervals or two
    /// end points differ (points by more than 1e-10 of the largest); those of [`SplineSpace::new`] and [`Spline::new`].
    pub fn from_bezier(pieces: &[BezierSegment<P>]) -> Result<Self, SplineError> {
        let Some(first) = pieces.first() else { return Err(SplineError::Empty { what: "pieces" }) };
        let n = first.points.len().saturating_sub(1);
        let scale = size(pieces);
        let mut breaks = vec![first.interval.0];
        let mut points = first.points.clone();
        for (index, piece) in pieces.iter().enumerate() {
            let found = piece.points.len();
            if found != n + 1 {
                return Err(SplineError::SizeMismatch {
                    what: "control points of a piece",
                    expected: n + 1,
                    found,
                });
            }
            if let Some(before) = index.checked_sub(1).map(|before| &pieces[before]) {
                let gap = (piece.interval.0 - before.interval.1).abs();
                let distance = (piece.points[0] - before.points[n]).norm();
                if gap != 0.0 || distance > AGREEMENT * scale {
                    return Err(SplineError::BoundaryMismatch { index, distance: gap.max(distance) });
                }
                points.extend_from_slice(&piece.points[1..]);
                breaks.extend(std::iter::repeat_n(piece.interval.0, n));
            }
        }
        breaks.push(pieces[pieces.len() - 1].interval.1);
        Self::new(SplineSpace::from_breaks(n, &breaks, EndKnots::Interpolating)?, points)
    }

    /// The spline of `space` with the given Bezier curves over its nonempty knot intervals: the inverse of [`Spline::bezier_form`].
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for the number of pieces or a degree; `NotInSpace` if an interval is not that of the space, or if the pieces do not
    /// join as smoothly as the space demands, up to 1e-10 of the largest control point; `NonFinite`.
    pub fn from_bezier_in(space: SplineSpace, pieces: &[BezierSegment<P>]) -> Result<Self, SplineError> {
        let (n, breaks) = (space.degree(), space.breaks());
        if pieces.len() + 1 != breaks.len() {
            let (expected, found) = (breaks.len() - 1, pieces.len());
            return Err(SplineError::SizeMismatch { what: "pieces", expected, found });
        }
        for (piece, ends) in pieces.iter().zip(breaks.windows(2)) {
            if piece.points.len() != n + 1 {
                let found = piece.points.len();
                return Err(SplineError::SizeMismatch {
                    what: "control points of a piece",
                    expected: n + 1,
                    found,
                });
            }
            if piece.interval != (ends[0], ends[1]) {
                let reason = format!("a piece over {:?} in place of {ends:?}", piece.interval);
                return Err(SplineError::NotInSpace { reason });
            }
        }
        let (left, period) = (breaks[0], space.period().unwrap_or(0.0));
        let coefficient = |k: usize| {
            let inner: Vec<f64> = (1..=n).filter_map(|i| space.knot((k + i) as isize)).collect();
            let middle = inner.iter().sum::<f64>() / n as f64;
            let turns = if period > 0.0 { ((middle - left) / period).floor() * period } else { 0.0 };
            let piece =
                &pieces[breaks.partition_point(|&at| at <= middle - turns).clamp(1, pieces.len()) - 1];
            blossom(piece, inner.iter().map(|knot| knot - turns))
        };
        let spline = Self::new(space.clone(), (0..space.dimension()).map(coefficient).collect())?;
        let scale = size(pieces);
        for (index, (piece, (_, found))) in pieces.iter().zip(spline.bezier_pieces().iter()).enumerate() {
            let differs = |(a, b): (&P, &P)| (*a - *b).norm() > AGREEMENT * scale;
            if piece.points.iter().zip(found).any(differs) {
                let reason = format!("piece {index} does not join its neighbours smoothly enough");
                return Err(SplineError::NotInSpace { reason });
            }
        }
        Ok(spline)
    }
}

impl<P: Projective> Nurbs<P> {
    /// The open curve of rational Bezier curves over consecutive intervals, which must agree in their common points and weights.
    ///
    /// # Errors
    ///
    /// Those of [`Spline::from_bezier`], in homogeneous coordinates, and of [`Nurbs::new`].
    pub fn from_bezier(pieces: &[RationalSegment<P>]) -> Result<Self, SplineError> {
        let lifted: Vec<_> = pieces
            .iter()
            .map(|piece| {
                let pairs = piece.points.iter().zip(&piece.weights);
                let points = pairs.map(|(point, &weight)| point.lift(weight)).collect();
                BezierSegment { interval: piece.interval, points }
            })
            .collect();
        let space = Spline::from_bezier(&lifted)?.into_parts().0;
        // Points and weights are taken as given, not out of their products.
        let from = |i: usize| usize::from(i > 0);
        let points =
            pieces.iter().enumerate().flat_map(|(i, piece)| piece.points[from(i)..].to_vec()).collect();
        let weights =
            pieces.iter().enumerate().flat_map(|(i, piece)| piece.weights[from(i)..].to_vec()).collect();
        Self::new(space, points, weights)
    }
}

fn size<P: Point>(pieces: &[BezierSegment<P>]) -> f64 {
    pieces.iter().flat_map(|piece| &piece.points).fold(0.0, |size, point| point.norm().max(size))
}

/// De Casteljau's scheme with another argument in every step.
fn blossom<P: Point>(piece: &BezierSegment<P>, arguments: impl Iterator<Item = f64>) -> P {
    let (a, b) = piece.interval;
    let mut points = piece.points.clone();
    for argument in arguments {
        for j in 0..points.len() - 1 {
            points[j] = points[j].mix(points[j + 1], (argument - a) / (b - a));
        }
        points.pop();
    }
    points[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::{any_curve, any_spline, distance};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_and_back_is_the_identity(spline in any_spline(1..=7)) {
            let back = Spline::from_bezier_in(spline.space().clone(), &spline.bezier_form()).unwrap();
            for (k, (a, b)) in back.coefficients().iter().zip(spline.coefficients()).enumerate() {
                prop_assert!(a.distance(*b) < 1e-7, "coefficient {k}: {a}, {b}");
            }
        }

        #[test]
        fn pieces_of_a_rational_curve_make_it_again(curve in any_curve(1..=25)) {
            let back = Nurbs::from_bezier(&curve.bezier_form()).unwrap();
            prop_assert!(distance(&curve, &back) < 1e-11, "off by {}", distance(&curve, &back));
        }
    }

    #[test]
    fn pieces_that_do_not_fit_are_refused() {
        let piece = |interval, points: &[f64]| BezierSegment { interval, points: points.to_vec() };
        let name = |pieces: &[BezierSegment<f64>]| Spline::from_bezier(pieces).unwrap_err().name();
        assert_eq!(name(&[]), "Empty", "no piece");
        assert_eq!(
            name(&[piece((0.0, 1.0), &[1.0, 2.0]), piece((1.5, 2.0), &[2.0, 1.0])]),
            "BoundaryMismatch",
            "a gap"
        );
        assert_eq!(
            name(&[piece((0.0, 1.0), &[1.0, 2.0]), piece((1.0, 2.0), &[3.0, 1.0])]),
            "BoundaryMismatch",
            "a jump"
        );
        assert_eq!(
            name(&[piece((0.0, 1.0), &[1.0, 2.0]), piece((1.0, 2.0), &[2.0])]),
            "SizeMismatch",
            "degrees"
        );
        assert_eq!(name(&[piece((0.0, 1.0), &[1.0])]), "DegreeZero", "a point");
        assert_eq!(name(&[piece((0.0, 1.0), &[1.0, f64::NAN])]), "NonFinite", "NaN");
        assert_eq!(name(&[piece((f64::NAN, 1.0), &[1.0, 2.0])]), "NonFinite", "NaN knot");
        let space = SplineSpace::uniform(2, 0.0, 2.0, 2).unwrap();
        let corner = [piece((0.0, 1.0), &[0.0, 0.0, 0.0]), piece((1.0, 2.0), &[0.0, 1.0, 2.0])];
        assert_eq!(
            Spline::from_bezier_in(space, &corner).unwrap_err().name(),
            "NotInSpace",
            "a corner at a simple knot"
        );
    }
}
