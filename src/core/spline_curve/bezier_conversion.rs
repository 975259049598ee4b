//! From Bezier curves to splines and back, without a change of any number.
//!
//! A Bezier curve of degree `n` over `[a, b]` is the spline with `n`-fold ends and no inner knot; several curves make one spline with `n`-fold
//! knots at the joints. Course: section 6.4.

use crate::core::bezier::BezierCurve;
use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::{Projective, RationalBezier, RationalBezierError};
use crate::core::spline_curve::{BezierSegment, Nurbs, RationalSegment};

/// Whether the coefficients of an open space are Bezier points: every break `n`-fold.
fn is_bezier_form(space: &SplineSpace) -> bool {
    let pieces = space.breaks().len() - 1;
    !space.is_periodic()
        && space.dimension() == pieces * space.degree() + 1
        && space.breaks().iter().all(|&at| space.multiplicity(at) == space.degree())
}

impl<P: Point> Spline<P> {
    /// The spline of Bezier curves over consecutive intervals; points that are not shared are kept bit by bit.
    ///
    /// # Errors
    ///
    /// As [`Spline::from_bezier`].
    pub fn from_bezier_curves(curves: &[BezierCurve<P>]) -> Result<Self, SplineError> {
        let segment = |curve: &BezierCurve<P>| BezierSegment {
            interval: curve.interval(),
            points: curve.points().to_vec(),
        };
        Self::from_bezier(&curves.iter().map(segment).collect::<Vec<_>>())
    }

    /// The pieces from left to right as Bezier curves over their knot intervals; coefficients that are Bezier points already stay what they are.
    ///
    /// # Errors
    ///
    /// `NonFinite` where a control point overflows.
    pub fn bezier_curves(&self) -> Result<Vec<BezierCurve<P>>, RationalBezierError> {
        let pieces = self.bezier_form().into_iter();
        pieces.map(|piece| Ok(BezierCurve::on_interval(piece.points, piece.interval)?)).collect()
    }
}

impl<P: Projective> Nurbs<P> {
    /// The curve of rational Bezier curves over consecutive intervals; points and weights that are not shared are kept bit by bit.
    ///
    /// # Errors
    ///
    /// As [`Nurbs::from_bezier`].
    pub fn from_rational_bezier_curves(curves: &[RationalBezier<P>]) -> Result<Self, SplineError> {
        let segment = |curve: &RationalBezier<P>| RationalSegment {
            interval: curve.interval(),
            points: curve.points().to_vec(),
            weights: curve.weights().to_vec(),
        };
        Self::from_bezier(&curves.iter().map(segment).collect::<Vec<_>>())
    }

    /// The pieces from left to right as rational Bezier curves over their knot intervals; points and weights that are those of Bezier curves already stay
    /// what they are.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive`, `NonFinite` where a weight or a point under- or overflows.
    pub fn rational_bezier_curves(&self) -> Result<Vec<RationalBezier<P>>, RationalBezierError> {
        if is_bezier_form(self.space()) {
            let n = self.degree();
            let breaks = self.space().breaks();
            let parts = self.points().windows(n + 1).zip(self.weights().windows(n + 1)).step_by(n);
            return breaks
                .windows(2)
                .zip(parts)
                .map(|(ends, (points, weights))| {
                    RationalBezier::on_interval(points.to_vec(), weights.to_vec(), (ends[0], ends[1]))
                })
                .collect();
        }
        let pieces = self.bezier_form().into_iter();
        pieces.map(|piece| RationalBezier::on_interval(piece.points, piece.weights, piece.interval)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::circle;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_and_back_without_a_changed_bit(
            degree in 1_usize..7, count in 1_usize..5, numbers in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64, 0.1..9.0_f64), 40),
        ) {
            let corner = |k: usize| DVec2::new(numbers[k].0, numbers[k].1);
            let piece = |i: usize| {
                let range = i * degree..=(i + 1) * degree;
                let (points, weights) = range.map(|k| (corner(k), numbers[k].2)).unzip();
                let interval = ((i * i) as f64 / 3.0, ((i + 1) * (i + 1)) as f64 / 3.0);
                RationalBezier::on_interval(points, weights, interval).unwrap()
            };
            let curves: Vec<_> = (0..count).map(piece).collect();
            let nurbs = Nurbs::from_rational_bezier_curves(&curves).unwrap();
            prop_assert_eq!(&nurbs.rational_bezier_curves().unwrap(), &curves, "rational");
            let polynomial: Vec<_> = curves.iter().map(|curve| curve.without_weights().clone()).collect();
            let spline = Spline::from_bezier_curves(&polynomial).unwrap();
            prop_assert_eq!(&spline.bezier_curves().unwrap(), &polynomial, "polynomial");
            for curve in &curves {
                let x = curve.interval().0.mix(curve.interval().1, 0.3);
                let gap = (curve.evaluate(x).unwrap() - nurbs.evaluate(x).unwrap()).length();
                prop_assert!(gap < 1e-12, "off by {gap}");
            }
        }
    }

    #[test]
    fn circles_become_one_curve() {
        let arcs = circle(DVec2::ONE, 2.0, 2, 3).unwrap();
        let nurbs = Nurbs::from_rational_bezier_curves(&arcs).unwrap();
        for i in 0..=30 {
            let radius = nurbs.evaluate(f64::from(i) / 10.0).unwrap().distance(DVec2::ONE);
            assert!((radius - 2.0).abs() < 1e-14, "radius {radius}");
        }
    }

    #[test]
    fn pieces_that_do_not_meet_are_refused() {
        let line = |a: f64, b: f64, interval| BezierCurve::on_interval(vec![a, b], interval).unwrap();
        let name = |pieces: &[BezierCurve<f64>]| Spline::from_bezier_curves(pieces).unwrap_err().name();
        assert_eq!(name(&[]), "Empty", "nothing");
        assert_eq!(
            name(&[line(0.0, 1.0, (0.0, 1.0)), line(2.0, 3.0, (1.0, 2.0))]),
            "BoundaryMismatch",
            "a jump"
        );
        assert_eq!(
            name(&[line(0.0, 1.0, (0.0, 1.0)), line(1.0, 3.0, (1.5, 2.0))]),
            "BoundaryMismatch",
            "a gap"
        );
        let parabola = BezierCurve::on_interval(vec![1.0, 2.0, 3.0], (1.0, 2.0)).unwrap();
        assert_eq!(name(&[line(0.0, 1.0, (0.0, 1.0)), parabola]), "SizeMismatch", "degrees 1 and 2");
        assert_eq!(name(&[BezierCurve::new(vec![1.0]).unwrap()]), "DegreeZero", "a point");
    }

    #[test]
    fn splines_with_simple_knots_come_apart() {
        let space = SplineSpace::uniform(3, 0.0, 4.0, 4).unwrap();
        let points = (0..7).map(|k| DVec2::new(f64::from(k), f64::from(k * k % 5))).collect();
        let nurbs = Nurbs::new(space, points, vec![1.0, 2.0, 1.0, 3.0, 1.0, 0.5, 1.0]).unwrap();
        let pieces = nurbs.rational_bezier_curves().unwrap();
        assert_eq!(pieces.len(), 4, "one for each interval");
        for piece in pieces {
            let x = piece.interval().0 + 0.3;
            let gap = (piece.evaluate(x).unwrap() - nurbs.evaluate(x).unwrap()).length();
            assert!(gap < 1e-14, "off by {gap} at {x}");
        }
    }
}
