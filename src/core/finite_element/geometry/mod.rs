//! Plane NURBS patches: `φ(t) = Σ wₖ cₖ bₖ(t) / Σ wₖ bₖ(t)` maps a rectangle R of parameters onto a part of the plane.
//!
//! The B-splines are products `bₖ(t) = bₖ₁(t₁) bₖ₂(t₂)`; points and weights are listed with the second index running
//! fastest. The Jacobian matrix has the columns `∂₁φ`, `∂₂φ`. Its determinant is positive where the map keeps
//! orientation; a patch that turns it everywhere is legal, and sizes use the modulus.
//! Course: section 9.3.

mod determinant;
mod inverse;

use std::fmt;

use glam::{DVec2, DVec3};

use crate::core::bspline::{EndKnots, MAX_DEGREE, SplineError, SplineSpace};
use crate::core::finite_element::error::FiniteElementError;
pub use determinant::{DeterminantRange, Orientation};

/// A side of the parameter rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PatchSide {
    /// `t₁` is least.
    Left,
    /// `t₁` is greatest.
    Right,
    /// `t₂` is least.
    Bottom,
    /// `t₂` is greatest.
    Top,
}

impl PatchSide {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Bottom, Self::Top];

    /// The direction, 0 or 1, whose parameter is constant on the side.
    pub fn axis(self) -> usize {
        usize::from(matches!(self, Self::Bottom | Self::Top))
    }

    /// Whether the constant parameter is the greatest one.
    pub fn at_end(self) -> bool {
        matches!(self, Self::Right | Self::Top)
    }
}

impl fmt::Display for PatchSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Left => "left side",
            Self::Right => "right side",
            Self::Bottom => "bottom side",
            Self::Top => "top side",
        })
    }
}

/// A part of the plane, parametrised by a tensor-product NURBS.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanePatch {
    spaces: [SplineSpace; 2],
    points: Vec<DVec2>,
    weights: Vec<f64>,
    /// `(w c, w)`.
    homogeneous: Vec<DVec3>,
}

/// A point of a patch and the columns of the Jacobian matrix there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchJet {
    /// `φ(t)`.
    pub point: DVec2,
    /// `∂₁φ` and `∂₂φ`.
    pub tangents: [DVec2; 2],
}

impl PatchJet {
    /// `det φ′`.
    pub fn determinant(&self) -> f64 {
        self.tangents[0].perp_dot(self.tangents[1])
    }

    /// `φ′⁻ᵗ g`: the gradient in the plane of a function whose gradient in the parameters is `g`.
    ///
    /// Not finite where the determinant vanishes.
    pub fn gradient(&self, g: DVec2) -> DVec2 {
        let [a, b] = self.tangents;
        DVec2::new(b.y * g.x - a.y * g.y, a.x * g.y - b.x * g.x) / self.determinant()
    }

    /// `φ′⁻¹ v`: the velocity of the parameters when the point moves with velocity `v`.
    ///
    /// Not finite where the determinant vanishes.
    pub fn parameter_velocity(&self, v: DVec2) -> DVec2 {
        let [a, b] = self.tangents;
        DVec2::new(v.perp_dot(b), a.perp_dot(v)) / self.determinant()
    }
}

impl PlanePatch {
    /// The patch over two open spaces with `m₁ m₂` points and as many positive weights, the second index fastest.
    ///
    /// # Errors
    ///
    /// `KnotsNotRegular` for a periodic space, `SizeMismatch`, `NonFinite` (also if weight times point overflows),
    /// `WeightNotPositive`.
    pub fn new(
        spaces: [SplineSpace; 2],
        points: Vec<DVec2>,
        weights: Vec<f64>,
    ) -> Result<Self, FiniteElementError> {
        check_open(&spaces)?;
        let expected = spaces[0].dimension() * spaces[1].dimension();
        for (what, found) in [("control points", points.len()), ("weights", weights.len())] {
            if found != expected {
                return Err(FiniteElementError::SizeMismatch { what, expected, found });
            }
        }
        for (index, (&point, &weight)) in points.iter().zip(&weights).enumerate() {
            let what = "coordinate of the control point or weight with number";
            for value in [point.x, point.y, weight, point.x * weight, point.y * weight] {
                if !value.is_finite() {
                    return Err(SplineError::NonFinite { what, index, value }.into());
                }
            }
            if weight <= 0.0 {
                return Err(SplineError::WeightNotPositive { index, value: weight }.into());
            }
        }
        let homogeneous = points.iter().zip(&weights).map(|(p, &w)| (*p * w).extend(w)).collect();
        Ok(Self { spaces, points, weights, homogeneous })
    }

    /// The polynomial patch: all weights 1.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`].
    pub fn polynomial(spaces: [SplineSpace; 2], points: Vec<DVec2>) -> Result<Self, FiniteElementError> {
        let weights = vec![1.0; points.len()];
        Self::new(spaces, points, weights)
    }

    /// The Bezier patch over `[0, size₁] × [0, size₂]` with `(n₁ + 1)(n₂ + 1)` points, the second index fastest.
    ///
    /// # Errors
    ///
    /// `Direction` for a degree of 0 or a size that is not positive; those of [`Self::new`].
    pub fn bezier(
        degrees: [usize; 2],
        size: DVec2,
        points: Vec<DVec2>,
        weights: Vec<f64>,
    ) -> Result<Self, FiniteElementError> {
        let space = |axis: usize| {
            SplineSpace::from_breaks(degrees[axis], &[0.0, size[axis]], EndKnots::Interpolating)
                .map_err(|source| FiniteElementError::Direction { axis, source })
        };
        Self::new([space(0)?, space(1)?], points, weights)
    }

    /// The same patch with control point `index` moved.
    ///
    /// # Errors
    ///
    /// `OutsideInterval` if there is no such point; those of [`Self::new`].
    pub fn with_point(&self, index: usize, point: DVec2) -> Result<Self, FiniteElementError> {
        let mut points = self.points.clone();
        let right = points.len() as f64 - 1.0;
        let missing = SplineError::OutsideInterval { value: index as f64, left: 0.0, right };
        *points.get_mut(index).ok_or(missing)? = point;
        Self::new(self.spaces.clone(), points, self.weights.clone())
    }

    /// The two spaces.
    pub fn spaces(&self) -> &[SplineSpace; 2] {
        &self.spaces
    }

    /// The control points as given, the second index fastest.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// The weights as given.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The coefficients `(w c, w)`.
    pub(super) fn homogeneous(&self) -> &[DVec3] {
        &self.homogeneous
    }

    /// The least and the greatest corner of the parameter rectangle.
    pub fn parameter_rectangle(&self) -> [DVec2; 2] {
        let ends = |axis: usize| self.spaces[axis].parameter_interval();
        [DVec2::new(ends(0).0, ends(1).0), DVec2::new(ends(0).1, ends(1).1)]
    }

    /// `φ(t)`.
    ///
    /// # Errors
    ///
    /// As [`Self::jet`].
    pub fn evaluate(&self, t: DVec2) -> Result<DVec2, FiniteElementError> {
        Ok(self.jet(t)?.point)
    }

    /// `φ(t)` and the Jacobian matrix; at a knot the limits from the right, at the right end from the left.
    ///
    /// # Errors
    ///
    /// `Direction` with `NonFinite` or `OutsideInterval`.
    pub fn jet(&self, t: DVec2) -> Result<PatchJet, FiniteElementError> {
        let basis = [active(&self.spaces[0], 0, t.x)?, active(&self.spaces[1], 1, t.y)?];
        let stride = self.spaces[1].dimension();
        let (mut value, mut along_first, mut along_second) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        for i in 0..=self.spaces[0].degree() {
            let (mut row, mut row_derivative) = (DVec3::ZERO, DVec3::ZERO);
            let start = (basis[0].first + i) * stride + basis[1].first;
            for j in 0..=self.spaces[1].degree() {
                let coefficient = self.homogeneous[start + j];
                row += coefficient * basis[1].value(j);
                row_derivative += coefficient * basis[1].slope(j);
            }
            value += row * basis[0].value(i);
            along_first += row * basis[0].slope(i);
            along_second += row_derivative * basis[0].value(i);
        }
        let point = value.truncate() / value.z;
        let tangent = |derivative: DVec3| (derivative.truncate() - point * derivative.z) / value.z;
        Ok(PatchJet { point, tangents: [tangent(along_first), tangent(along_second)] })
    }

    /// The parameter of the point with parameter `along` (of the other direction) on `side`.
    pub fn side_parameter(&self, side: PatchSide, along: f64) -> DVec2 {
        let [least, greatest] = self.parameter_rectangle();
        let mut t = DVec2::splat(along);
        t[side.axis()] = if side.at_end() { greatest } else { least }[side.axis()];
        t
    }
}

/// The active B-splines of one direction and their slopes at a parameter.
pub(super) struct Active {
    pub(super) first: usize,
    degree: usize,
    numbers: [f64; 2 * (MAX_DEGREE + 1)],
}

impl Active {
    pub(super) fn value(&self, j: usize) -> f64 {
        self.numbers[j]
    }

    pub(super) fn slope(&self, j: usize) -> f64 {
        self.numbers[self.degree + 1 + j]
    }
}

/// The active B-splines of `space`, the one of direction `axis`, at `t`.
pub(super) fn active(space: &SplineSpace, axis: usize, t: f64) -> Result<Active, FiniteElementError> {
    let degree = space.degree();
    let mut numbers = [0.0; 2 * (MAX_DEGREE + 1)];
    let first = space
        .write_active_derivatives(t, &mut numbers[..2 * (degree + 1)])
        .map_err(|source| FiniteElementError::Direction { axis, source })?;
    Ok(Active { first, degree, numbers })
}

/// Periodic directions are refused: every side of a patch is a side.
pub(super) fn check_open(spaces: &[SplineSpace; 2]) -> Result<(), FiniteElementError> {
    match spaces.iter().position(SplineSpace::is_periodic) {
        Some(axis) => Err(FiniteElementError::PeriodicDirection { axis }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::sample_geometries as sample;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_jacobian_is_the_limit_of_difference_quotients(x in 0.01..0.99_f64, y in 0.01..0.99_f64) {
            for patch in [sample::quarter_annulus(1.0, 2.0).unwrap(), sample::book_patch()] {
                let t = DVec2::new(x, y);
                let jet = patch.jet(t).unwrap();
                for (axis, step) in [DVec2::X, DVec2::Y].into_iter().enumerate() {
                    let h = 1e-6;
                    let (ahead, behind) =
                        (patch.evaluate(t + step * h).unwrap(), patch.evaluate(t - step * h).unwrap());
                    let difference = (ahead - behind) / (2.0 * h) - jet.tangents[axis];
                    prop_assert!(difference.length() < 1e-8, "direction {axis} at {t}: {difference}");
                }
                let v = DVec2::new(0.3, -0.7);
                let back = jet.tangents[0] * jet.parameter_velocity(v).x + jet.tangents[1] * jet.parameter_velocity(v).y;
                prop_assert!((back - v).length() < 1e-13, "the Jacobian times its inverse: {back}");
                let g = DVec2::new(2.0, 3.0);
                let work = jet.gradient(g).dot(v) - g.dot(jet.parameter_velocity(v));
                prop_assert!(work.abs() < 1e-12, "gradient along a velocity: {work}");
            }
        }
    }

    #[test]
    fn bad_patches_are_refused() {
        let space = || SplineSpace::uniform(1, 0.0, 1.0, 1).unwrap();
        let corners = vec![DVec2::ZERO, DVec2::Y, DVec2::X, DVec2::ONE];
        let name = |points: Vec<DVec2>, weights: Vec<f64>| {
            PlanePatch::new([space(), space()], points, weights).unwrap_err().name()
        };
        assert_eq!(name(vec![DVec2::ZERO; 3], vec![1.0; 4]), "SizeMismatch", "three points");
        assert_eq!(name(vec![DVec2::NAN; 4], vec![1.0; 4]), "NonFinite", "no numbers");
        assert_eq!(name(corners.clone(), vec![0.0; 4]), "WeightNotPositive", "weight 0");
        let periodic = SplineSpace::periodic(1, 2.0, vec![0.0, 1.0]).unwrap();
        let error = PlanePatch::polynomial([space(), periodic], corners).unwrap_err();
        assert_eq!(error.name(), "KnotsNotRegular", "a periodic direction");
        let patch = sample::unit_square();
        assert_eq!(patch.with_point(4, DVec2::ZERO).unwrap_err().name(), "OutsideInterval", "point 4 of 4");
        assert_eq!(patch.jet(DVec2::new(0.5, 2.0)).unwrap_err().name(), "OutsideInterval", "outside");
        assert_eq!(patch.jet(DVec2::NAN).unwrap_err().name(), "NonFinite", "no parameter");
    }
}
