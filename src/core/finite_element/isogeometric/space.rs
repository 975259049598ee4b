//! The isogeometric space of one patch: `Bₖ = bₖ ∘ φ⁻¹` without the functions that do not vanish on fixed sides.
//!
//! Course: section 9.3.

use std::ops::Range;

use glam::DVec2;

use crate::core::bspline::{EndKnots, SplineError, SplineSpace};
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::geometry::{Orientation, PatchSide, PlanePatch, check_open};
use crate::core::finite_element::isogeometric::direction::Direction;
use crate::core::quadrature::gauss_legendre;

/// The most numbers that a matrix may have (1 GB).
const MAX_ENTRIES: usize = 1 << 27;

/// A patch with a tensor-product spline space over its parameters, and the sides where functions vanish.
///
/// Coefficients have the second index fastest, `k = k₁ m₂ + k₂`.
#[derive(Clone, Debug, PartialEq)]
pub struct IsogeometricSpace {
    patch: PlanePatch,
    orientation: Orientation,
    spaces: [SplineSpace; 2],
    fixed: [bool; 4],
    gauss_points: [usize; 2],
}

impl IsogeometricSpace {
    /// The splines of `spaces` over the parameter rectangle of `patch` that vanish on the sides `dirichlet`.
    ///
    /// Integrals use `n + 1` Gauss points in each direction of each cell, up to four more where cells are few and the
    /// Jacobian varies much over one; see [`Self::with_gauss_points`].
    ///
    /// # Errors
    ///
    /// `KnotsNotRegular` for a periodic direction, `OutsideInterval` if the parameter intervals differ from those of
    /// the patch, `SingularJacobian`, `FoldedParametrisation`, `DirichletSideUnknown` for a side where the knots are not
    /// n-fold, `StepLimit`.
    pub fn new(
        patch: PlanePatch,
        spaces: [SplineSpace; 2],
        dirichlet: &[PatchSide],
    ) -> Result<Self, FiniteElementError> {
        check_open(&spaces)?;
        for (axis, space) in spaces.iter().enumerate() {
            let (left, right) = patch.spaces()[axis].parameter_interval();
            let (low, high) = space.parameter_interval();
            for (value, end) in [(low, left), (high, right)] {
                if (value - end).abs() > 1e-12 * (right - left) {
                    let source = SplineError::OutsideInterval { value, left, right };
                    return Err(FiniteElementError::Direction { axis, source });
                }
            }
        }
        let [n1, n2] = [spaces[0].degree(), spaces[1].degree()];
        let entries = (n1 + 1)
            .saturating_mul(2 * n2 + 1)
            .saturating_mul(spaces[0].dimension())
            .saturating_mul(spaces[1].dimension());
        if entries > MAX_ENTRIES {
            let (what, value, limit) = ("number of matrix entries", entries, MAX_ENTRIES);
            return Err(FiniteElementError::StepLimit { what, value, limit });
        }
        let orientation = patch.check_regular()?;
        let mut fixed = [false; 4];
        for &side in dirichlet {
            let space = &spaces[side.axis()];
            let (left, right) = space.parameter_interval();
            if space.multiplicity(if side.at_end() { right } else { left }) < space.degree() {
                return Err(FiniteElementError::DirichletSideUnknown { patch: 0, side });
            }
            fixed[side as usize] = true;
        }
        let gauss_points = std::array::from_fn(|axis| {
            let cells = spaces[axis].breaks().len() - 1;
            spaces[axis].degree() + 1 + [4, 2, 0][usize::from(cells > 8) + usize::from(cells > 24)]
        });
        Ok(Self { patch, orientation, spaces, fixed, gauss_points })
    }

    /// Splines of one degree whose knots divide every knot interval of the patch into `divisions` equal parts.
    ///
    /// Ends are interpolating; at the inner knots of the patch the splines are as smooth as the patch is.
    ///
    /// # Errors
    ///
    /// `DegreeZero`, `StepLimit`, `Empty` for no divisions; those of [`Self::new`].
    pub fn refined(
        patch: &PlanePatch,
        degree: usize,
        divisions: [usize; 2],
        dirichlet: &[PatchSide],
    ) -> Result<Self, FiniteElementError> {
        let space = |axis: usize| {
            refined_space(&patch.spaces()[axis], degree, divisions[axis])
                .map_err(|source| FiniteElementError::Direction { axis, source })
        };
        Self::new(patch.clone(), [space(0)?, space(1)?], dirichlet)
    }

    /// The same space with another number of Gauss points in each direction of each cell.
    ///
    /// # Errors
    ///
    /// `Empty`, `StepLimit`.
    pub fn with_gauss_points(mut self, points: [usize; 2]) -> Result<Self, FiniteElementError> {
        for count in points {
            gauss_legendre(count)?;
        }
        self.gauss_points = points;
        Ok(self)
    }

    /// The patch.
    pub fn patch(&self) -> &PlanePatch {
        &self.patch
    }

    /// The spline spaces of the two directions.
    pub fn spaces(&self) -> &[SplineSpace; 2] {
        &self.spaces
    }

    /// Whether the patch keeps or turns orientation; the integrals use the modulus of the determinant.
    pub fn orientation(&self) -> Orientation {
        self.orientation
    }

    /// `m₁` and `m₂`, all coefficients counted.
    pub fn sizes(&self) -> [usize; 2] {
        [self.spaces[0].dimension(), self.spaces[1].dimension()]
    }

    /// `m₁ m₂`.
    pub fn coefficient_count(&self) -> usize {
        self.sizes()[0] * self.sizes()[1]
    }

    /// Whether functions vanish on `side`.
    pub fn is_fixed(&self, side: PatchSide) -> bool {
        self.fixed[side as usize]
    }

    /// Indices of the free coefficients in each direction.
    pub fn free(&self) -> [Range<usize>; 2] {
        let range = |low: PatchSide, high: PatchSide, size: usize| {
            let end = size - usize::from(self.is_fixed(high));
            usize::from(self.is_fixed(low)).min(end)..end
        };
        let [m1, m2] = self.sizes();
        [range(PatchSide::Left, PatchSide::Right, m1), range(PatchSide::Bottom, PatchSide::Top, m2)]
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.free().map(|range| range.len()).iter().product()
    }

    /// The node `φ(ξₖⁿ)` of coefficient `(k₁, k₂)`, where it is displayed; `None` if the knot average lies outside the
    /// rectangle or there is no such coefficient.
    pub fn node(&self, k: [usize; 2]) -> Option<DVec2> {
        let average = |axis: usize| {
            let (space, k) = (&self.spaces[axis], k[axis]);
            let knots = space.knots().get(k + 1..=k + space.degree())?;
            (k < space.dimension()).then(|| knots.iter().sum::<f64>() / knots.len() as f64)
        };
        self.patch.evaluate(DVec2::new(average(0)?, average(1)?)).ok()
    }

    /// The sign of the determinant.
    pub(super) fn sign(&self) -> f64 {
        match self.orientation {
            Orientation::Positive => 1.0,
            Orientation::Negative => -1.0,
        }
    }

    pub(super) fn directions(&self) -> Result<[Direction; 2], FiniteElementError> {
        let direction = |axis: usize| {
            Direction::new(axis, &self.spaces[axis], &self.patch.spaces()[axis], self.gauss_points[axis])
        };
        Ok([direction(0)?, direction(1)?])
    }
}

/// See [`IsogeometricSpace::refined`].
fn refined_space(
    geometry: &SplineSpace,
    degree: usize,
    divisions: usize,
) -> Result<SplineSpace, SplineError> {
    if divisions == 0 {
        return Err(SplineError::Empty { what: "divisions" });
    }
    let old = geometry.breaks();
    // Enough for every degree; stops absurd numbers before memory is asked for.
    let limit = MAX_ENTRIES / 4;
    if divisions.saturating_mul(old.len()) > limit {
        return Err(SplineError::StepLimit { what: "number of divisions", value: divisions, limit });
    }
    let mut breaks = vec![old[0]];
    for (index, pair) in old.windows(2).enumerate() {
        let width = (pair[1] - pair[0]) / divisions as f64;
        breaks.extend((1..divisions).map(|i| pair[0] + width * i as f64));
        // The patch is C^(n − multiplicity) at its inner knots, and so should the splines be.
        let smoothness = geometry.degree() - geometry.multiplicity(pair[1]).min(geometry.degree());
        let inner = index + 2 < old.len();
        let copies = if inner { degree.saturating_sub(smoothness).max(1) } else { 1 };
        breaks.extend(std::iter::repeat_n(pair[1], copies));
    }
    SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating)
}
