//! Hyperplanes, and how often a polygon crosses one.
//!
//! The variation `V(c, H)` is the number of strict changes of side of consecutive points. Knot insertion cuts corners and cannot
//! raise it, so that a curve crosses no hyperplane more often than its control polygon. Course: section 6.3.

use crate::core::bspline::SplineError;
use crate::core::point::Point;

/// The points `x` with `normal·x = offset`: a point of the line, a line of the plane, a plane in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperplane<P> {
    normal: P,
    offset: f64,
}

impl<P: Point> Hyperplane<P> {
    /// The hyperplane with the given normal, of any length.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for the normal 0.
    pub fn new(normal: P, offset: f64) -> Result<Self, SplineError> {
        let numbers = (0..P::DIMENSION).map(|i| normal.coordinate(i)).chain([offset]);
        for (index, value) in numbers.enumerate() {
            if !value.is_finite() {
                return Err(SplineError::NonFinite {
                    what: "number of a hyperplane, the one with index",
                    index,
                    value,
                });
            }
        }
        if normal == P::ZERO {
            return Err(SplineError::Degenerate { what: "a hyperplane without a normal", parameter: offset });
        }
        Ok(Self { normal, offset })
    }

    /// The normal, as given.
    pub fn normal(&self) -> P {
        self.normal
    }

    /// The offset, as given.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// `normal·x − offset`: positive on the side to which the normal points.
    pub fn side(&self, point: P) -> f64 {
        self.dot(point) - self.offset
    }

    /// `normal·x`.
    pub(super) fn dot(&self, point: P) -> f64 {
        (0..P::DIMENSION).map(|i| self.normal.coordinate(i) * point.coordinate(i)).sum()
    }
}

/// The variation: strict changes of side of consecutive points, points on the hyperplane skipped.
///
/// ```
/// # use glam::DVec2;
/// # use spline_lab::core::spline_curve::{Hyperplane, variation};
/// let axis = Hyperplane::new(DVec2::Y, 0.0)?;
/// assert_eq!(variation(&[DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_Y], &axis), 2);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
pub fn variation<P: Point>(points: &[P], hyperplane: &Hyperplane<P>) -> usize {
    sign_changes(points.iter().map(|&point| hyperplane.side(point)))
}

/// Changes of sign of consecutive numbers that are not 0.
pub(super) fn sign_changes(numbers: impl Iterator<Item = f64>) -> usize {
    let mut last = 0.0_f64;
    let mut changes = 0;
    for number in numbers.filter(|&number| number != 0.0) {
        changes += usize::from(last * number.signum() < 0.0);
        last = number.signum();
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_spline;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn insertion_never_raises_the_variation(
            spline in any_spline(1..=9), shares in prop::collection::vec(0.0..1.0_f64, 1..8), angle in 0.0..6.3_f64, offset in -8.0..8.0_f64,
        ) {
            let spline = spline.unroll().unwrap();
            let line = Hyperplane::new(DVec2::from_angle(angle), offset).unwrap();
            let (left, right) = spline.space().parameter_interval();
            let mut before = variation(spline.coefficients(), &line);
            let mut refined = spline;
            for share in shares {
                let Ok(next) = refined.insert_knot(left.mix(right, share)) else { continue };
                let after = variation(next.coefficients(), &line);
                prop_assert!(after <= before, "{before} became {after}");
                (before, refined) = (after, next);
            }
            let samples: Vec<DVec2> = (0..=200).map(|i| refined.evaluate(left.mix(right, f64::from(i) / 200.0)).unwrap()).collect();
            prop_assert!(variation(&samples, &line) <= before, "the curve crosses more often than its polygon");
        }
    }

    #[test]
    fn hyperplanes_need_a_normal() {
        assert_eq!(Hyperplane::new(DVec2::ZERO, 1.0).unwrap_err().name(), "Degenerate", "normal 0");
        assert_eq!(Hyperplane::new(DVec2::X, f64::NAN).unwrap_err().name(), "NonFinite", "offset NaN");
        assert_eq!(Hyperplane::new(2.0, 6.0).unwrap().side(4.0), 2.0, "a point of the line");
    }
}
