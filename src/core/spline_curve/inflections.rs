//! Inflections of plane curves: where the curvature changes its sign.
//!
//! Inside the pieces these are zeros of odd multiplicity of the polynomials of the [curvature](super::curvature_polynomial), at knots the signs of both sides are
//! compared. Course: beyond, section B.7.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::curvature_polynomial::{checked, turning};
use crate::core::spline_curve::piecewise_sign::{PieceSigns, PiecewiseSign};

/// The inflections of a plane spline curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveInflections {
    /// The parameters at which the curvature changes its sign, increasing.
    pub parameters: Vec<f64>,
    /// The parts on which the curve is straight, neighbours in one.
    pub straight: Vec<[f64; 2]>,
}

impl Nurbs<DVec2> {
    /// Where the curve turns from one side to the other, also at a knot with a jump of the curvature. A straight part between two turns is told as such. What the
    /// polygon does at a corner does not count.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::bspline::{EndKnots, SplineSpace};
    /// use spline_lab::core::spline_curve::Nurbs;
    ///
    /// let points = [[0.0, 0.0], [1.0, 3.0], [2.0, -3.0], [3.0, 0.0]].map(DVec2::from).to_vec();
    /// let curve = Nurbs::polynomial(SplineSpace::from_breaks(3, &[0.0, 1.0], EndKnots::Interpolating)?, points)?;
    /// assert_eq!(curve.inflections()?.parameters, [0.5]);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `NonFinite` where products of coordinates overflow.
    pub fn inflections(&self) -> Result<CurveInflections, SplineError> {
        let mut signs = Vec::new();
        for (index, piece) in self.local_pieces()?.iter().enumerate() {
            let piece_signs = match checked(index, turning(piece))? {
                Some(turning) => PieceSigns::new(&turning.coefficients, turning.noise),
                None => PieceSigns::new(&[0.0], 0.0),
            };
            signs.push((piece.interval, piece_signs));
        }
        let sign = PiecewiseSign::new(&signs, self.space().is_periodic());
        let parameters = sign.changes().map(|place| place.parameter).collect();
        Ok(CurveInflections { parameters, straight: sign.zero })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{EndKnots, Side, SplineSpace};
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn every_change_of_the_sign_is_found_and_similar_curves_have_the_same(curve in any_curve(2..=5)) {
            let found = curve.inflections().unwrap();
            let (a, b) = curve.space().parameter_interval();
            let samples: Vec<(f64, f64)> = (0..=400)
                .map(|i| a.mix(b, f64::from(i) / 400.0))
                .filter_map(|t| Some((t, curve.curvature(t, Side::Right).ok()?)))
                // Where the curve all but stands still, rounding decides.
                .filter(|(_, curvature)| (1e-6..1e9).contains(&curvature.abs()))
                .collect();
            for pair in samples.windows(2) {
                // The seam of a closed curve is told at its start.
                let inside = |t: f64| {
                    [t, t + (b - a)].iter().any(|s| pair[0].0 - 1e-9 <= *s && *s <= pair[1].0 + 1e-9)
                };
                let count = found.parameters.iter().filter(|&&t| inside(t)).count();
                let flat = found.straight.iter().any(|part| part[0] <= pair[1].0 && pair[0].0 <= part[1]);
                prop_assert!(flat || pair[0].1 * pair[1].1 > 0.0 || count > 0, "between {pair:?}: {found:?}");
            }
            let rotate = |p: DVec2| DVec2::from_angle(0.8).rotate(p) * 3.0 + DVec2::new(3.0, -4.0);
            let image = Nurbs::new(curve.space().clone(), curve.points().iter().map(|&p| rotate(p)).collect(), curve.weights().to_vec()).unwrap();
            for other in [image.inflections().unwrap(), curve.elevate_degree().unwrap().inflections().unwrap()] {
                prop_assert_eq!(other.parameters.len(), found.parameters.len(), "{:?} {:?}", other, found);
                prop_assert!(other.parameters.iter().zip(&found.parameters).all(|(s, t)| (s - t).abs() < 1e-4 * (b - a)), "{other:?} {found:?}");
            }
            if !curve.space().is_periodic() {
                prop_assert_eq!(curve.reversed().unwrap().inflections().unwrap().parameters.len(), found.parameters.len(), "reversal");
            }
        }
    }

    #[test]
    fn straight_parts_circles_and_joints() {
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0, 2.0, 3.0], EndKnots::Interpolating).unwrap();
        let points = [[0.0, 1.0], [1.0, 0.0], [3.0, 0.0], [5.0, 0.0], [6.0, -1.0]].map(DVec2::from).to_vec();
        let found = Nurbs::polynomial(space, points).unwrap().inflections().unwrap();
        assert_eq!(
            (found.parameters, found.straight),
            (vec![], vec![[1.0, 2.0]]),
            "a straight part between two turns"
        );
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0, 2.0], EndKnots::Interpolating).unwrap();
        let wave = [[0.0, 0.0], [1.0, 1.0], [3.0, -1.0], [4.0, 0.0]].map(DVec2::from).to_vec();
        let found = Nurbs::polynomial(space, wave).unwrap().inflections().unwrap();
        assert_eq!(
            (found.parameters, found.straight),
            (vec![1.0], vec![]),
            "at the knot, where the curvature jumps"
        );
        let circle = Nurbs::circle(DVec2::new(1e3, -1e3), 1.0).unwrap().inflections().unwrap();
        assert!(circle.parameters.is_empty() && circle.straight.is_empty(), "a circle: {circle:?}");
        let square =
            Nurbs::closed(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y], vec![1.0; 4], 1).unwrap();
        let found = square.inflections().unwrap();
        assert_eq!(found.straight.len(), 1, "a polygon is straight throughout: {found:?}");
    }
}
