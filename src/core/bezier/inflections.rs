//! Inflections of plane curves: where `det(p′, p″)`, and with it the curvature, changes its sign.
//!
//! The determinant is a polynomial of degree `2n − 4` at most; its Bernstein coefficients come from those of both hodographs.
//! Course: section 2.5.

use glam::DVec2;

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point as _;
use crate::core::polynomial::bernstein_product;
use crate::core::root_finding::{Zeros, bernstein_zeros};

/// The inflections of a plane curve.
#[derive(Clone, Debug, PartialEq)]
pub enum Inflections {
    /// The parameters inside the interval at which the curvature changes its sign, increasing.
    At(Vec<f64>),
    /// The curve is part of a straight line.
    Straight,
}

impl BezierCurve<DVec2> {
    /// Where the curve turns from one side to the other. A cusp at which the turning keeps its direction is none.
    ///
    /// # Errors
    ///
    /// `NonFinite` where a derivative or a product of two overflows.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::bezier::{BezierCurve, Inflections};
    ///
    /// let points = [[0.0, 0.0], [1.0, 1.0], [2.0, -1.0], [3.0, 0.0]].map(DVec2::from).to_vec();
    /// assert_eq!(BezierCurve::new(points)?.inflections()?, Inflections::At(vec![0.5]));
    /// # Ok::<(), spline_lab::core::bezier::BezierError>(())
    /// ```
    pub fn inflections(&self) -> Result<Inflections, BezierError> {
        if self.degree() < 2 {
            return Ok(Inflections::Straight);
        }
        let (first, second) = (self.hodograph(1)?, self.hodograph(2)?);
        let axis =
            |curve: &Self, axis| curve.points().iter().map(|c| c.coordinate(axis)).collect::<Vec<f64>>();
        let forward = bernstein_product(&axis(&first, 0), &axis(&second, 1))?;
        let backward = bernstein_product(&axis(&first, 1), &axis(&second, 0))?;
        let turning: Vec<f64> = forward.iter().zip(&backward).map(|(a, b)| a - b).collect();
        // The differences carry the rounding of the control points, the size of the whole polygon.
        let n = self.degree() as f64;
        let largest = |curve: &Self| curve.points().iter().map(|c| c.norm()).fold(0.0, f64::max);
        let size = largest(self) / self.width();
        let noise = 8.0
            * n
            * n
            * f64::EPSILON
            * (size * largest(&second) + n * size / self.width() * largest(&first));
        let (a, b) = self.interval();
        Ok(match bernstein_zeros(&turning, noise) {
            Zeros::Everywhere => Inflections::Straight,
            zeros @ Zeros::Isolated(_) => {
                Inflections::At(zeros.sign_changes().map(|t| a.mix(b, t)).collect())
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_curvature_changes_sign_there_and_nowhere_else(
            points in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 3..8),
        ) {
            let curve = BezierCurve::on_interval(points, (1.0, 4.0)).unwrap();
            let Inflections::At(inflections) = curve.inflections().unwrap() else { return Ok(()) };
            let sign = |x: f64| {
                let d = curve.derivatives(x, 2).unwrap();
                d[1].perp_dot(d[2])
            };
            let mut bounds = vec![1.0];
            bounds.extend(&inflections);
            bounds.push(4.0);
            let middles: Vec<f64> = bounds.windows(2).map(|pair| sign(0.5 * (pair[0] + pair[1]))).collect();
            for pair in middles.windows(2) {
                prop_assert!(pair[0] * pair[1] < 0.0, "alternating {middles:?} at {inflections:?}");
            }
            for pair in bounds.windows(2) {
                let samples = (1..20).map(|i| sign(pair[0].mix(pair[1], f64::from(i) / 20.0)));
                let signs: Vec<bool> = samples.map(|value| value < 0.0).collect();
                prop_assert!(pair[1] - pair[0] < 1e-3 || signs.iter().all(|&s| s == signs[0]), "one sign between");
            }
            let raised = curve.elevate_degree().inflections().unwrap();
            let Inflections::At(again) = raised else { return Err(TestCaseError::fail("straight after elevation")) };
            prop_assert_eq!(again.len(), inflections.len(), "elevation");
        }
    }

    #[test]
    fn lines_are_straight_and_convex_curves_have_none() {
        let line = BezierCurve::new(vec![DVec2::ZERO, DVec2::ONE, 4.0 * DVec2::ONE, DVec2::ONE]).unwrap();
        assert_eq!(line.inflections(), Ok(Inflections::Straight), "a line there and back");
        let far = BezierCurve::new([[1e6, 0.1], [1e6, 0.2], [1e6, 0.4]].map(DVec2::from).to_vec()).unwrap();
        assert_eq!(far.inflections(), Ok(Inflections::Straight), "a line far out");
        let arc = BezierCurve::new(vec![DVec2::X, DVec2::ONE, DVec2::Y]).unwrap();
        assert_eq!(arc.inflections(), Ok(Inflections::At(Vec::new())), "a parabola");
    }
}
