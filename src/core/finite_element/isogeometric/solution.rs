//! What a solution on one patch can be asked.

use glam::DVec2;
use rayon::prelude::*;

use crate::core::bspline::SplineError;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::form::{Coefficient, EllipticForm, Jet};
use crate::core::finite_element::geometry::{PatchJet, active};
use crate::core::finite_element::isogeometric::direction::Direction;
use crate::core::finite_element::isogeometric::line::{Integrand, Line};
use crate::core::finite_element::isogeometric::space::IsogeometricSpace;

/// A function of an isogeometric space.
#[derive(Clone, Debug)]
pub struct IsogeometricSolution {
    space: IsogeometricSpace,
    directions: [Direction; 2],
    coefficients: Vec<f64>,
    energy: f64,
    residuals: Vec<f64>,
}

/// Point, value and gradient at a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolutionJet {
    /// `φ(t)` and the Jacobian matrix.
    pub geometry: PatchJet,
    /// `u(φ(t))`.
    pub value: f64,
    /// The gradient in the plane.
    pub gradient: DVec2,
    /// The gradient in the parameters.
    pub parameter_gradient: DVec2,
}

/// A point of the quadrature.
#[derive(Clone, Copy, Debug)]
pub(super) struct QuadraturePoint {
    pub(super) t: DVec2,
    pub(super) place: DVec2,
    /// Weight times modulus of the determinant.
    pub(super) weight: f64,
}

impl IsogeometricSolution {
    pub(in crate::core::finite_element) fn new(
        space: IsogeometricSpace,
        directions: [Direction; 2],
        coefficients: Vec<f64>,
        energy: f64,
        residuals: Vec<f64>,
    ) -> Self {
        Self { space, directions, coefficients, energy, residuals }
    }

    /// The function with these coefficients, for instance an interpolant; its energy is not known and reported as NaN.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `m₁ m₂` coefficients, `NonFinite`.
    pub fn from_coefficients(
        space: IsogeometricSpace,
        coefficients: Vec<f64>,
    ) -> Result<Self, FiniteElementError> {
        if coefficients.len() != space.coefficient_count() {
            let (expected, found) = (space.coefficient_count(), coefficients.len());
            return Err(FiniteElementError::SizeMismatch { what: "coefficients", expected, found });
        }
        if let Some(index) = coefficients.iter().position(|c| !c.is_finite()) {
            let value = coefficients[index];
            let source = SplineError::NonFinite { what: "coefficient", index, value };
            return Err(source.into());
        }
        let directions = space.directions()?;
        Ok(Self::new(space, directions, coefficients, f64::NAN, Vec::new()))
    }

    /// The space.
    pub fn space(&self) -> &IsogeometricSpace {
        &self.space
    }

    /// All coefficients, those of fixed functions 0; the second index runs fastest.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// `a(u, u)`.
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// Norms of the residuals of conjugate gradients, first that of the start.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// Point, value and gradient at the parameter `t`; at a knot the limits from the right.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn jet(&self, t: DVec2) -> Result<SolutionJet, FiniteElementError> {
        let spaces = self.space.spaces();
        let geometry = self.space.patch().jet(t)?;
        let basis = [active(&spaces[0], 0, t.x)?, active(&spaces[1], 1, t.y)?];
        let (mut value, mut slopes) = (0.0, DVec2::ZERO);
        for i in 0..=spaces[0].degree() {
            let start = (basis[0].first + i) * self.space.sizes()[1] + basis[1].first;
            let (mut row, mut row_slope) = (0.0, 0.0);
            for j in 0..=spaces[1].degree() {
                row += self.coefficients[start + j] * basis[1].value(j);
                row_slope += self.coefficients[start + j] * basis[1].slope(j);
            }
            value += row * basis[0].value(i);
            slopes += DVec2::new(row * basis[0].slope(i), row_slope * basis[0].value(i));
        }
        Ok(SolutionJet { geometry, value, gradient: geometry.gradient(slopes), parameter_gradient: slopes })
    }

    /// Value and gradient at a point of the plane; `None` outside the patch.
    pub fn jet_at(&self, place: DVec2) -> Option<SolutionJet> {
        self.jet(self.space.patch().invert(place)?).ok()
    }

    /// Writes points, values and gradients on a grid of `counts[0] × counts[1]` equally spaced parameters, ends included,
    /// the second parameter fastest.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are as many places; `StepLimit` for a direction with fewer than two parameters.
    pub fn write_grid(&self, counts: [usize; 2], jets: &mut [SolutionJet]) -> Result<(), FiniteElementError> {
        if let Some(&value) = counts.iter().find(|count| **count < 2) {
            return Err(FiniteElementError::StepLimit {
                what: "number of grid lines",
                value,
                limit: usize::MAX,
            });
        }
        if jets.len() != counts[0].saturating_mul(counts[1]) {
            let (expected, found) = (counts[0].saturating_mul(counts[1]), jets.len());
            return Err(FiniteElementError::SizeMismatch { what: "places of the grid", expected, found });
        }
        let [low, high] = self.space.patch().parameter_rectangle();
        let part = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        jets.par_chunks_mut(counts[1]).enumerate().try_for_each(|(i, row)| {
            for (j, jet) in row.iter_mut().enumerate() {
                let t = low + (high - low) * DVec2::new(part(i, counts[0]), part(j, counts[1]));
                *jet = self.jet(t.min(high))?;
            }
            Ok(())
        })
    }

    /// `∫ u` over the patch.
    ///
    /// # Errors
    ///
    /// Only those of a patch that is not regular, which no space has.
    pub fn integral(&self) -> Result<f64, FiniteElementError> {
        let sums = self.fold_points(|| 0.0, |sum, at, jet| *sum += at.weight * jet.value)?;
        Ok(sums.into_iter().sum())
    }

    /// Folds all quadrature points of each cell row of the first direction; the results in the order of the rows.
    pub(super) fn fold_points<S: Send>(
        &self,
        start: impl Fn() -> S + Sync,
        step: impl Fn(&mut S, &QuadraturePoint, &Jet) + Sync,
    ) -> Result<Vec<S>, FiniteElementError> {
        let [first, second] = &self.directions;
        let form = EllipticForm::poisson(Coefficient::Constant(0.0));
        let integrand = Integrand { patch: self.space.patch(), directions: &self.directions, form: &form };
        let m2 = self.space.sizes()[1];
        let row = |e1: usize| -> Result<S, FiniteElementError> {
            let mut state = start();
            let mut line = Line::new(integrand);
            let mut across = vec![[0.0; 2]; m2];
            for q1 in 0..first.rule.count() {
                line.fill(integrand, q1, e1, self.space.sign())?;
                across.fill([0.0; 2]);
                let table = &first.solution;
                for i in 0..=table.degree {
                    let at = table.at(q1, i, e1);
                    let coefficients = &self.coefficients[(table.first[e1] + i) * m2..][..m2];
                    for (sum, c) in across.iter_mut().zip(coefficients) {
                        sum[0] += table.values[at] * c;
                        sum[1] += table.slopes[at] * c;
                    }
                }
                let table = &second.solution;
                for e in 0..second.cells {
                    for q in 0..second.rule.count() {
                        let (mut value, mut slopes) = (0.0, DVec2::ZERO);
                        for j in 0..=table.degree {
                            let (at, [c, d]) = (table.at(q, j, e), across[table.first[e] + j]);
                            value += table.values[at] * c;
                            slopes += DVec2::new(table.values[at] * d, table.slopes[at] * c);
                        }
                        let jet = Jet { value, gradient: line.gradient(q, e, slopes) };
                        let t = DVec2::new(first.point(q1, e1).0, second.point(q, e).0);
                        let weight = line.area[q * second.stride + e];
                        step(&mut state, &QuadraturePoint { t, place: line.place(q, e), weight }, &jet);
                    }
                }
            }
            Ok(state)
        };
        (0..first.cells).into_par_iter().map(row).collect()
    }

    /// Moves the mean value to 0.
    pub(super) fn subtract_mean(&mut self) -> Result<(), FiniteElementError> {
        let sums =
            self.fold_points(|| DVec2::ZERO, |sum, at, jet| *sum += at.weight * DVec2::new(jet.value, 1.0))?;
        let total: DVec2 = sums.into_iter().sum();
        // B-splines sum to 1, so that all coefficients move by the mean.
        self.coefficients.iter_mut().for_each(|c| *c -= total.x / total.y);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::sample_geometries as sample;

    #[test]
    fn a_linear_function_has_its_values_and_gradient_everywhere() {
        let patch = sample::book_patch();
        // u = 2 + x − 3 y has the coefficients of the control points.
        let linear = |x: DVec2| 2.0 + x.x - 3.0 * x.y;
        let coefficients = patch.points().iter().map(|point| linear(*point)).collect();
        let space = IsogeometricSpace::new(patch.clone(), patch.spaces().clone(), &[]).unwrap();
        let solution = IsogeometricSolution::from_coefficients(space, coefficients).unwrap();
        let mut grid = vec![solution.jet(DVec2::ZERO).unwrap(); 35];
        solution.write_grid([5, 7], &mut grid).unwrap();
        for jet in &grid {
            let error = jet.value - linear(jet.geometry.point);
            assert!(error.abs() < 1e-13, "{jet:?}");
            assert!((jet.gradient - DVec2::new(1.0, -3.0)).length() < 1e-12, "{jet:?}");
        }
        assert_eq!(grid[34].geometry.point, DVec2::new(4.0, 2.0), "the last corner");
        let place = DVec2::new(1.0, 1.0);
        assert!((solution.jet_at(place).unwrap().value).abs() < 1e-11, "2 + 1 − 3");
        assert!(solution.jet_at(DVec2::new(-1.0, 0.0)).is_none(), "outside");
        let sizes = |counts: [usize; 2], places: usize| {
            let mut grid = vec![grid[0]; places];
            solution.write_grid(counts, &mut grid).unwrap_err().name()
        };
        assert_eq!(sizes([2, 2], 5), "SizeMismatch", "five places");
        assert_eq!(sizes([1, 2], 2), "StepLimit", "one line");
    }
}
