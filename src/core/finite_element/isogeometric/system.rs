//! The Galerkin system of one patch, and its solution by conjugate gradients with fast diagonalisation.
//!
//! The coefficients `C₁₁` and `C₂₂` are approximated by products `a₁(t₁) b₂(t₂)` and `b₁(t₁) a₂(t₂)`, fitted to their
//! logarithms; with these the system is a tensor product and is solved directly. Where the approximation is exact, as
//! for a rectangle or an annulus, one or two steps suffice.

use glam::DVec2;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::fast_diagonalisation::{DirectionMatrices, FastDiagonalisation};
use crate::core::finite_element::form::EllipticForm;
use crate::core::finite_element::geometry::{PatchSide, active};
use crate::core::finite_element::isogeometric::assembly::{Samples, assemble};
use crate::core::finite_element::isogeometric::band_matrix::TensorBandMatrix;
use crate::core::finite_element::isogeometric::direction::Direction;
use crate::core::finite_element::isogeometric::line::Integrand;
use crate::core::finite_element::isogeometric::solution::IsogeometricSolution;
use crate::core::finite_element::isogeometric::space::IsogeometricSpace;
use crate::core::linear_system::{
    DenseMatrix, IterationLimits, LinearOperator, LinearSystemError, conjugate_gradients,
};
use crate::core::progress::{Part, Watcher};

/// How far from 0 the sum of a right side may be without fixed sides, relative to the sum of moduli.
const COMPATIBLE: f64 = 1e-8;

/// A prescribed flux `(A grad u)·normal = g` through a side.
#[derive(Clone, Copy)]
pub struct SideFlux<'a> {
    /// The side.
    pub side: PatchSide,
    /// `g`, by the point of the plane; the normal points outward.
    pub flux: &'a (dyn Fn(DVec2) -> f64 + Sync),
}

impl std::fmt::Debug for SideFlux<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SideFlux").field("side", &self.side).finish_non_exhaustive()
    }
}

/// Matrix and right side of a space, coefficients of fixed functions included.
#[derive(Clone, Debug)]
pub struct IsogeometricSystem {
    space: IsogeometricSpace,
    directions: [Direction; 2],
    matrix: TensorBandMatrix,
    right_side: Vec<f64>,
    samples: Samples,
    /// Constants are in the kernel.
    singular: bool,
}

/// Solves `−div(A grad u) + c u = f` on one patch, with `u = 0` on the fixed sides of `space` and natural conditions
/// `(A grad u)·normal = g` elsewhere, where `g` is 0 on sides without a flux.
///
/// Without fixed sides and with `c = 0` the solution is the one with mean value 0.
///
/// ```
/// use spline_lab::core::finite_element::{
///     Coefficient, EllipticForm, IsogeometricSpace, PatchSide, sample_geometries, solve_patch,
/// };
/// use spline_lab::core::progress::Unwatched;
/// let space = IsogeometricSpace::refined(&sample_geometries::unit_square(), 2, [8, 8], &PatchSide::ALL)?;
/// let form = EllipticForm::poisson(Coefficient::Constant(1.0));
/// let solution = solve_patch(space, &form, &[], &Unwatched)?;
/// assert!((solution.jet((0.5, 0.5).into())?.value - 0.0736714).abs() < 2e-5);
/// # Ok::<(), spline_lab::core::finite_element::FiniteElementError>(())
/// ```
///
/// # Errors
///
/// Those of [`IsogeometricSystem::assemble`] and [`IsogeometricSystem::solve`].
pub fn solve_patch(
    space: IsogeometricSpace,
    form: &EllipticForm<'_>,
    fluxes: &[SideFlux<'_>],
    watcher: &dyn Watcher,
) -> Result<IsogeometricSolution, FiniteElementError> {
    let assembling = Part { whole: watcher, from: 0.0, to: 0.6 };
    let system = IsogeometricSystem::assemble(space, form, fluxes, &assembling)?;
    system.solve(&Part { whole: watcher, from: 0.6, to: 1.0 })
}

impl IsogeometricSystem {
    /// Assembles matrix and right side.
    ///
    /// # Errors
    ///
    /// `NonFinite` and `NotElliptic` name a point where the data are bad; `Stopped`.
    pub fn assemble(
        space: IsogeometricSpace,
        form: &EllipticForm<'_>,
        fluxes: &[SideFlux<'_>],
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        let directions = space.directions()?;
        let integrand = Integrand { patch: space.patch(), directions: &directions, form };
        let sums = assemble(integrand, space.sizes(), space.sign(), watcher)?;
        let mut right_side = sums.load;
        for flux in fluxes {
            add_flux(&space, &directions, flux, &mut right_side)?;
        }
        let singular = form.kills_constants() && !PatchSide::ALL.iter().any(|side| space.is_fixed(*side));
        Ok(Self { space, directions, matrix: sums.matrix, right_side, samples: sums.samples, singular })
    }

    /// The space.
    pub fn space(&self) -> &IsogeometricSpace {
        &self.space
    }

    /// `G`, with the rows and columns of fixed functions.
    pub fn matrix(&self) -> &TensorBandMatrix {
        &self.matrix
    }

    /// `F`, with the entries of fixed functions; the second index runs fastest.
    pub fn right_side(&self) -> &[f64] {
        &self.right_side
    }

    /// The same system with another right side.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn with_right_side(mut self, right_side: Vec<f64>) -> Result<Self, FiniteElementError> {
        if right_side.len() != self.right_side.len() {
            let (expected, found) = (self.right_side.len(), right_side.len());
            return Err(FiniteElementError::SizeMismatch {
                what: "entries of the right side",
                expected,
                found,
            });
        }
        self.right_side = right_side;
        Ok(self)
    }

    /// The direct solver of the system with separable coefficients.
    ///
    /// # Errors
    ///
    /// As [`FastDiagonalisation::new`].
    pub fn preconditioner(&self) -> Result<FastDiagonalisation, LinearSystemError> {
        let [columns, rows] = [self.directions[1].cells, self.directions[0].cells];
        let (a1, b2) = separate(&self.samples.first, rows, columns);
        let (b1, a2) = separate(&self.samples.second, rows, columns);
        let mut shift = 0.0;
        for (index, reaction) in self.samples.reaction.iter().enumerate() {
            shift += reaction / (b1[index / columns] * b2[index % columns]);
        }
        shift /= self.samples.reaction.len() as f64;
        let [m1, m2] = self.space.sizes();
        let first = direction_matrices(&self.directions[0], m1, &a1, &b1)?;
        let second = direction_matrices(&self.directions[1], m2, &a2, &b2)?;
        FastDiagonalisation::new([&first, &second], self.space.free(), shift)
    }

    /// The function with these coefficients.
    pub(in crate::core::finite_element) fn into_solution(
        self,
        coefficients: Vec<f64>,
        residuals: Vec<f64>,
    ) -> IsogeometricSolution {
        let mut product = vec![0.0; coefficients.len()];
        self.matrix.apply(&coefficients, &mut product);
        let energy = coefficients.iter().zip(&product).map(|(u, g)| u * g).sum();
        IsogeometricSolution::new(self.space, self.directions, coefficients, energy, residuals)
    }

    /// Solves the system.
    ///
    /// # Errors
    ///
    /// `IncompatibleData` without fixed sides if the right side does not sum to 0; `NotPositiveDefinite`, `NotConverged`,
    /// `NonFinite`, `Stopped`.
    pub fn solve(self, watcher: &dyn Watcher) -> Result<IsogeometricSolution, FiniteElementError> {
        let mut right_side = self.right_side.clone();
        let operator = FreeOperator { matrix: &self.matrix, space: &self.space };
        operator.clear_fixed(&mut right_side);
        if self.singular {
            let (sum, scale): (f64, f64) =
                right_side.iter().fold((0.0, 0.0), |(sum, scale), f| (sum + f, scale + f.abs()));
            if sum.abs() > COMPATIBLE * scale {
                return Err(FiniteElementError::IncompatibleData { sum, scale });
            }
            // What rounding left would otherwise stay in every residual.
            let mean = sum / right_side.len() as f64;
            right_side.iter_mut().for_each(|f| *f -= mean);
        }
        let (mut coefficients, mut residuals) = (vec![0.0; right_side.len()], Vec::new());
        if self.space.dimension() > 0 && right_side.iter().any(|f| *f != 0.0) {
            let preconditioner = self.preconditioner()?;
            watcher.check(0.5)?;
            let limits = IterationLimits { relative_tolerance: 1e-12, max_steps: 2000 };
            let rest = Part { whole: watcher, from: 0.5, to: 1.0 };
            let run = conjugate_gradients(&operator, &right_side, None, &preconditioner, limits, &rest)?;
            (coefficients, residuals) = (run.solution, run.residuals);
        }
        let singular = self.singular;
        let mut solution = self.into_solution(coefficients, residuals);
        if singular {
            solution.subtract_mean()?;
        }
        Ok(solution)
    }
}

/// The matrix on the free coefficients; products with the others are 0.
struct FreeOperator<'a> {
    matrix: &'a TensorBandMatrix,
    space: &'a IsogeometricSpace,
}

impl FreeOperator<'_> {
    fn clear_fixed(&self, vector: &mut [f64]) {
        let [rows, columns] = self.space.free();
        for (k1, row) in vector.chunks_exact_mut(self.space.sizes()[1]).enumerate() {
            if rows.contains(&k1) {
                row[..columns.start].fill(0.0);
                row[columns.end..].fill(0.0);
            } else {
                row.fill(0.0);
            }
        }
    }
}

impl LinearOperator for FreeOperator<'_> {
    fn size(&self) -> usize {
        self.matrix.size()
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        self.matrix.apply(x, product);
        self.clear_fixed(product);
    }
}

/// Positive `r` and `s` with `rᵢ sⱼ ≈ samplesᵢⱼ`: the least-squares fit of the logarithms.
fn separate(samples: &[f64], rows: usize, columns: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut by_row, mut by_column) = (vec![0.0; rows], vec![0.0; columns]);
    for (index, sample) in samples.iter().enumerate() {
        let logarithm = sample.ln();
        by_row[index / columns] += logarithm / columns as f64;
        by_column[index % columns] += logarithm / rows as f64;
    }
    let mean = by_row.iter().sum::<f64>() / rows as f64;
    (by_row.iter().map(|r| r.exp()).collect(), by_column.iter().map(|s| (s - mean).exp()).collect())
}

/// `∫ stiffness b′ᵢ b′ⱼ` and `∫ mass bᵢ bⱼ` with one coefficient for each cell.
fn direction_matrices(
    direction: &Direction,
    size: usize,
    stiffness: &[f64],
    mass: &[f64],
) -> Result<DirectionMatrices, LinearSystemError> {
    let table = &direction.solution;
    let (mut k, mut m) = (vec![0.0; size * size], vec![0.0; size * size]);
    for e in 0..direction.cells {
        for q in 0..direction.rule.count() {
            let weight = direction.point(q, e).1;
            for i in 0..=table.degree {
                for j in 0..=table.degree {
                    let at = (table.first[e] + i) * size + table.first[e] + j;
                    let (i, j) = (table.at(q, i, e), table.at(q, j, e));
                    k[at] += weight * stiffness[e] * table.slopes[i] * table.slopes[j];
                    m[at] += weight * mass[e] * table.values[i] * table.values[j];
                }
            }
        }
    }
    Ok(DirectionMatrices {
        stiffness: DenseMatrix::new(size, size, k)?,
        mass: DenseMatrix::new(size, size, m)?,
    })
}

/// Adds `∫ g bₖ ds` over a side.
fn add_flux(
    space: &IsogeometricSpace,
    directions: &[Direction; 2],
    flux: &SideFlux<'_>,
    right_side: &mut [f64],
) -> Result<(), FiniteElementError> {
    let (across, along) = (flux.side.axis(), 1 - flux.side.axis());
    let direction = &directions[along];
    let ends = space.spaces()[across].parameter_interval();
    let normal = active(&space.spaces()[across], across, if flux.side.at_end() { ends.1 } else { ends.0 })?;
    for e in 0..direction.cells {
        for q in 0..direction.rule.count() {
            let (parameter, weight) = direction.point(q, e);
            let jet = space.patch().jet(space.patch().side_parameter(flux.side, parameter))?;
            let value = (flux.flux)(jet.point);
            if !value.is_finite() {
                let (what, point) = ("the flux", jet.point);
                return Err(FiniteElementError::NonFinite { what, point, value });
            }
            let total = weight * value * jet.tangents[along].length();
            for i in 0..=space.spaces()[across].degree() {
                for j in 0..=direction.solution.degree {
                    let basis = direction.solution.values[direction.solution.at(q, j, e)];
                    let mut k = [0; 2];
                    k[across] = normal.first + i;
                    k[along] = direction.solution.first[e] + j;
                    right_side[k[0] * space.sizes()[1] + k[1]] += total * normal.value(i) * basis;
                }
            }
        }
    }
    Ok(())
}
