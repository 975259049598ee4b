//! The range of the Jacobian determinant, and whether a patch is a legal parametrisation.

use glam::DVec2;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::geometry::PlanePatch;
use crate::core::quadrature::gauss_legendre;

/// A determinant this much smaller than the largest one, relative to it, is zero.
const ZERO_DETERMINANT: f64 = 1e-12;

/// The determinant of a polynomial patch has degree `2n − 1` in each direction.
const AREA_POINTS: usize = 12;

/// The search for an extremum ends at steps of this part of the sides of the rectangle; the error is its square.
const SMALLEST_STEP: f64 = 1e-8;

/// Extrema of the Jacobian determinant over a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeterminantRange {
    /// The least determinant.
    pub least: f64,
    /// Where it is.
    pub least_at: DVec2,
    /// The greatest determinant.
    pub greatest: f64,
    /// Where it is.
    pub greatest_at: DVec2,
}

/// What a regular patch does to orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// The determinant is positive everywhere.
    Positive,
    /// The determinant is negative everywhere: legal, but worth a warning (`NegativeOrientation`).
    Negative,
}

impl PlanePatch {
    /// Least and greatest determinant: sampled on `(2n + 2)²` points of every knot cell, then followed to the extremum.
    pub fn determinant_range(&self) -> DeterminantRange {
        let lines = [0, 1].map(|axis| self.sample_parameters(axis, 2 * self.spaces[axis].degree() + 2));
        let mut range = DeterminantRange {
            least: f64::INFINITY,
            least_at: DVec2::ZERO,
            greatest: f64::NEG_INFINITY,
            greatest_at: DVec2::ZERO,
        };
        for &x in &lines[0] {
            for &y in &lines[1] {
                let t = DVec2::new(x, y);
                let determinant = self.determinant(t);
                if determinant < range.least {
                    (range.least, range.least_at) = (determinant, t);
                }
                if determinant > range.greatest {
                    (range.greatest, range.greatest_at) = (determinant, t);
                }
            }
        }
        let steps = DVec2::new(1.0 / lines[0].len() as f64, 1.0 / lines[1].len() as f64);
        (range.least_at, range.least) = self.descend(1.0, range.least_at, range.least, steps);
        let (at, negated) = self.descend(-1.0, range.greatest_at, -range.greatest, steps);
        (range.greatest_at, range.greatest) = (at, -negated);
        range
    }

    /// The area of a regular patch, `∫ |det φ′|`, by Gauss points in every knot cell: exact for polynomial patches up to degree 12.
    pub fn area(&self) -> f64 {
        let rule = gauss_legendre(AREA_POINTS).expect("the number of points is between 1 and the limit");
        let cells = |axis: usize| -> Vec<(f64, f64)> {
            self.spaces[axis].breaks().windows(2).flat_map(|pair| rule.on(pair[0], pair[1])).collect()
        };
        let (first, second) = (cells(0), cells(1));
        let row = |(x, v): &(f64, f64)| -> f64 {
            second.iter().map(|(y, w)| v * w * self.determinant(DVec2::new(*x, *y))).sum()
        };
        first.iter().map(row).sum::<f64>().abs()
    }

    /// Whether the determinant keeps one sign.
    ///
    /// # Errors
    ///
    /// `FoldedParametrisation` if it changes sign, `SingularJacobian` if it vanishes somewhere; the patch number is 0.
    pub fn check_regular(&self) -> Result<Orientation, FiniteElementError> {
        let range = self.determinant_range();
        let zero = ZERO_DETERMINANT * range.least.abs().max(range.greatest.abs());
        if range.least > zero {
            Ok(Orientation::Positive)
        } else if range.greatest < -zero {
            Ok(Orientation::Negative)
        } else if range.least < -zero && range.greatest > zero {
            Err(FiniteElementError::FoldedParametrisation {
                patch: 0,
                least: range.least,
                least_at: range.least_at,
                greatest: range.greatest,
                greatest_at: range.greatest_at,
            })
        } else {
            let at_least = range.least.abs() <= range.greatest.abs();
            let parameter = if at_least { range.least_at } else { range.greatest_at };
            Err(FiniteElementError::SingularJacobian { patch: 0, parameter })
        }
    }

    /// `count ≥ 2` parameters in every knot interval of a direction, both ends included.
    pub(super) fn sample_parameters(&self, axis: usize, count: usize) -> Vec<f64> {
        let breaks = self.spaces[axis].breaks();
        let mut parameters = Vec::with_capacity(count * (breaks.len() - 1));
        for pair in breaks.windows(2) {
            // The last one stays inside its interval, since derivatives at a knot are limits from the right.
            let fraction = |i: usize| (i as f64 / (count - 1) as f64).min(1.0 - 1e-12);
            parameters.extend((0..count).map(|i| pair[0] + (pair[1] - pair[0]) * fraction(i)));
        }
        if let (Some(end), Some(&right)) = (parameters.last_mut(), breaks.last()) {
            *end = right;
        }
        parameters
    }

    fn determinant(&self, t: DVec2) -> f64 {
        self.jet(t).map_or(f64::NAN, |jet| jet.determinant())
    }

    /// Compass search for the least `sign · det` from `t`; steps are parts of the sides of the rectangle.
    fn descend(&self, sign: f64, mut t: DVec2, mut least: f64, mut steps: DVec2) -> (DVec2, f64) {
        let [low, high] = self.parameter_rectangle();
        while steps.max_element() > SMALLEST_STEP {
            let mut moved = false;
            for direction in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y, DVec2::ONE, DVec2::NEG_ONE] {
                let trial = (t + direction * steps * (high - low)).clamp(low, high);
                let value = sign * self.determinant(trial);
                if value < least {
                    (t, least, moved) = (trial, value, true);
                }
            }
            if !moved {
                steps *= 0.5;
            }
        }
        (t, least)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::sample_geometries as sample;

    #[test]
    fn extrema_of_the_annulus_are_those_of_the_formula() {
        // φ = (1 + t₁) e(t₂) with a rational quarter circle e: det = (1 + t₁) |e′|, and |e′| is √2 at both ends,
        // least or greatest there and in the middle, where it is 4(√2 − 1).
        let range = sample::quarter_annulus(1.0, 2.0).unwrap().determinant_range();
        let (end, middle) = (2.0_f64.sqrt(), 4.0 * (2.0_f64.sqrt() - 1.0));
        assert!((range.least - end).abs() < 1e-12, "{range:?}, least {end}");
        assert!((range.greatest - 2.0 * middle).abs() < 1e-12, "{range:?}, greatest {}", 2.0 * middle);
    }

    #[test]
    fn folded_singular_and_turned_patches_are_told_apart() {
        let square = sample::unit_square();
        assert_eq!(square.check_regular(), Ok(Orientation::Positive), "the unit square");
        let folded = square.with_point(3, DVec2::new(0.2, 0.2)).unwrap();
        assert_eq!(folded.check_regular().unwrap_err().name(), "FoldedParametrisation", "a corner pushed in");
        // With the corner on the diagonal the determinant vanishes there and nowhere else.
        let singular = square.with_point(3, DVec2::new(0.5, 0.5)).unwrap();
        match singular.check_regular() {
            Err(FiniteElementError::SingularJacobian { parameter, .. }) => {
                assert_eq!(parameter, DVec2::ONE, "the corner");
            }
            other => panic!("{other:?}"),
        }
        let flat = PlanePatch::polynomial(square.spaces().clone(), vec![DVec2::ONE; 4]).unwrap();
        assert_eq!(flat.check_regular().unwrap_err().name(), "SingularJacobian", "one point");
        let mut turned = square.points().to_vec();
        turned.swap(1, 2);
        let turned = PlanePatch::polynomial(square.spaces().clone(), turned).unwrap();
        assert_eq!(turned.check_regular(), Ok(Orientation::Negative), "a mirrored square");
    }
}
