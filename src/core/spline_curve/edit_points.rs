//! Edit points: as many points of the curve as it has control points, which determine them.
//!
//! They stand at the averages `(τᵢ₊₁ + … + τᵢ₊ₙ)/n` of the knots, those outside D moved to its ends; by the theorem of Schoenberg and Whitney
//! interpolation there has one solution. T. N. E. Greville, 1967; course: sections 4.3 and 5.5.

use crate::core::approximation::{ApproximationError, interpolate};
use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl SplineSpace {
    /// The parameters of edit points, one for each coefficient, strictly increasing, in D if open.
    ///
    /// With end-interpolating knots, and in a period, these are the Greville abscissae.
    pub fn edit_parameters(&self) -> Vec<f64> {
        if self.is_periodic() {
            return self.greville_abscissae();
        }
        let (n, knots) = (self.degree(), self.knots());
        let (left, right) = self.parameter_interval();
        let average = |run: &[f64]| {
            let sum: f64 = run.iter().map(|knot| knot.clamp(left, right) - left).sum();
            (left + sum / n as f64).min(right)
        };
        knots[1..knots.len() - 1].windows(n).map(average).collect()
    }
}

impl<P: Projective> Nurbs<P> {
    /// The points of the curve at the [`edit_parameters`](SplineSpace::edit_parameters).
    ///
    /// # Errors
    ///
    /// Those of [`Nurbs::evaluate`].
    pub fn edit_points(&self) -> Result<Vec<P>, SplineError> {
        self.space().edit_parameters().into_iter().map(|t| self.evaluate(t)).collect()
    }

    /// The curve whose edit point `index` has moved by `displacement` while all others stay; all control points move, the farther the less. Weights and
    /// knots stay.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such point, `NonFinite`; `Singular` in a periodic space whose edit points do not determine it.
    pub fn with_edit_point_moved(&self, index: usize, displacement: P) -> Result<Self, ApproximationError> {
        let parameters = self.space().edit_parameters();
        let Some(&at) = parameters.get(index) else {
            let (expected, found) = (parameters.len(), index + 1);
            return Err(ApproximationError::SizeMismatch { what: "edit points", expected, found });
        };
        // Σ wᵢ δcᵢ bᵢ(tⱼ) = w(tⱼ) δⱼ.
        let mut values = vec![0.0; parameters.len()];
        values[index] = P::project(self.homogeneous().evaluate(at)?).1;
        let unit = interpolate(self.space().clone(), &parameters, &values)?;
        let moved = self.points().iter().zip(self.weights()).zip(unit.coefficients());
        let points = moved.map(|((&point, weight), share)| point + displacement * (share / weight)).collect();
        Ok(Self::new(self.space().clone(), points, self.weights().to_vec())?)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::approximation::check_sites;
    use crate::core::spline_curve::samples::any_curve;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn one_edit_point_moves_and_the_others_stay(curve in any_curve(1..=5), which in 0.0..1.0_f64) {
            prop_assert!(check_sites(curve.space(), &curve.space().edit_parameters()).is_ok(), "sites");
            let before = curve.edit_points().unwrap();
            let index = (which * before.len() as f64) as usize;
            let d = DVec2::new(0.5, -1.0);
            let Ok(moved) = curve.with_edit_point_moved(index, d) else {
                prop_assert!(curve.space().is_periodic(), "an open space has a solution");
                return Ok(());
            };
            let size = moved.points().iter().map(|point| point.length()).fold(1.0, f64::max);
            for (j, (a, b)) in moved.edit_points().unwrap().iter().zip(&before).enumerate() {
                let wanted = if j == index { *b + d } else { *b };
                prop_assert!(a.distance(wanted) < 1e-9 * size, "edit point {j}: {a}, not {wanted}");
            }
        }
    }

    #[test]
    fn the_ends_of_d_are_edit_points_even_if_the_knots_are_simple() {
        let space = SplineSpace::uniform(3, 0.0, 4.0, 4).unwrap();
        let parameters = space.edit_parameters();
        assert_eq!((parameters[0], parameters[6]), (0.0, 4.0), "{parameters:?}");
        assert!(parameters.windows(2).all(|pair| pair[0] < pair[1]), "{parameters:?}");
    }

    #[test]
    fn a_point_that_is_not_there_is_refused() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        assert_eq!(circle.with_edit_point_moved(8, DVec2::X).unwrap_err().name(), "SizeMismatch", "of 8");
    }
}
