//! Dragging a curve by one of its points.
//!
//! `r(t) = Σ Rᵢ(t) cᵢ` with the rational B-splines `Rᵢ = wᵢ bᵢ / Σ wⱼ bⱼ` is one linear equation for the control points; its solution of least change
//! is `δcᵢ = Rᵢ(t) d / Σ Rⱼ(t)²`. Only the `n + 1` active points move. R. H. Bartels, J. C. Beatty, *A technique for the direct manipulation of
//! spline curves*, 1989.

use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Projective> Nurbs<P> {
    /// The curve whose point at `t` has moved by `displacement`: the change `Σ |δcᵢ|²` of the control points is as small as possible, weights and
    /// knots stay.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn moved_at(&self, t: f64, displacement: P) -> Result<Self, SplineError> {
        let (space, n) = (self.space(), self.degree());
        let mut basis = [0.0; MAX_DEGREE + 1];
        let first = space.write_active_basis(t, &mut basis[..=n])?;
        // In a short period one control point can be active twice.
        let mut active: Vec<(usize, f64)> = Vec::with_capacity(n + 1);
        for (k, value) in basis[..=n].iter().enumerate() {
            let index = space.coefficient_index(first + k);
            match active.iter_mut().find(|(other, _)| *other == index) {
                Some((_, sum)) => *sum += value,
                None => active.push((index, *value)),
            }
        }
        let largest = active.iter().map(|&(index, _)| self.weights()[index]).fold(0.0, f64::max);
        for (index, value) in &mut active {
            *value *= self.weights()[*index] / largest;
        }
        let sum: f64 = active.iter().map(|(_, value)| value).sum();
        let square: f64 = active.iter().map(|(_, value)| (value / sum) * (value / sum)).sum();
        let mut points = self.points().to_vec();
        for (index, value) in active {
            points[index] = points[index] + displacement * (value / sum / square);
        }
        Self::new(space.clone(), points, self.weights().to_vec())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::spline_curve::samples::any_curve;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_grabbed_point_follows_and_only_active_points_move(
            curve in any_curve(1..=6),
            share in 0.0..1.0_f64,
            x in -3.0..3.0_f64,
            y in -3.0..3.0_f64,
        ) {
            let (left, right) = curve.space().parameter_interval();
            let (t, d) = (left + share * (right - left), DVec2::new(x, y));
            let moved = curve.moved_at(t, d).unwrap();
            let gap = (moved.evaluate(t).unwrap() - curve.evaluate(t).unwrap() - d).length();
            prop_assert!(gap < 1e-9 * (1.0 + d.length()), "off by {gap}");
            prop_assume!(d.length() > 1e-3);
            let changes: Vec<DVec2> = moved.points().iter().zip(curve.points()).map(|(a, b)| *a - *b).collect();
            let count = changes.iter().filter(|change| change.length() > 0.0).count();
            prop_assert!(count <= curve.degree() + 1, "{count} points moved");
            // Least norm: the change is a multiple of the gradient, so that every other solution is longer.
            let square: f64 = changes.iter().map(|change| change.length_squared()).sum();
            for index in 0..changes.len() {
                let pushed = moved.with_point(index, moved.points()[index] + DVec2::X).unwrap();
                let share = pushed.evaluate(t).unwrap().x - moved.evaluate(t).unwrap().x;
                prop_assert!((changes[index] - d * (share * square / d.length_squared())).length() < 1e-6 * (1.0 + square),
                    "point {index}");
            }
        }
    }

    #[test]
    fn a_place_outside_is_refused() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        assert_eq!(circle.moved_at(f64::NAN, DVec2::X).unwrap_err().name(), "NonFinite", "no parameter");
        assert_eq!(circle.moved_at(1.0, DVec2::X * f64::NAN).unwrap_err().name(), "NonFinite", "nowhere");
    }
}
