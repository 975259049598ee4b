//! The Galerkin system of one patch, and its solution by conjugate gradients with fast diagonalisation.
//!
//! The coefficients `C₁₁` and `C₂₂` are approximated by products `a₁(t₁) b₂(t₂)` and `b₁(t₁) a₂(t₂)`, fitted to their
//! logarithms; with these the system is a tensor product and is solved directly. Where the approximation is exact, as
//! for a rectangle or an annulus, one or two steps suffice.

use glam::DVec2;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::fast_diagonalisation::{DirectionMatrices, FastDiagonalisation};
use crate::core::finite_element::form::{Coefficient, EllipticForm};
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
    /// `NonFinite` and `NotElliptic` name a point where the data are bad; `GradientLoad` unless `F` is the constant 0 (give
    /// the right side with [`Self::with_right_side`] instead); `Stopped`.
    pub fn assemble(
        space: IsogeometricSpace,
        form: &EllipticForm<'_>,
        fluxes: &[SideFlux<'_>],
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        if !matches!(form.gradient_load, Coefficient::Constant(load) if load == DVec2::ZERO) {
            return Err(FiniteElementError::GradientLoad);
        }
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::finite_element::geometry::PlanePatch;
    use crate::core::finite_element::sample_geometries as sample;
    use crate::core::progress::Unwatched;
    use glam::DMat2;
    use proptest::prelude::*;

    fn form(load: f64) -> EllipticForm<'static> {
        EllipticForm::poisson(Coefficient::Constant(load))
    }

    /// A biquadratic patch over two by one knot cells, with an inner knot, weights, and points moved by `shifts`.
    fn random_patch(shifts: &[f64]) -> PlanePatch {
        let first = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 0.4, 1.0, 1.0, 2.0]).unwrap();
        let second = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let point = |k: usize| {
            let (i, j) = (k / 3, k % 3);
            DVec2::new(i as f64 + 0.3 * shifts[2 * k], j as f64 + 0.3 * shifts[2 * k + 1])
        };
        let weights = (0..12).map(|k| 1.0 + 0.3 * shifts[k]).collect();
        PlanePatch::new([first, second], (0..12).map(point).collect(), weights).unwrap()
    }

    #[test]
    fn entries_are_the_integrals_of_their_definition() {
        let shifts: Vec<f64> = (0..24).map(|i| ((i * 7) % 11) as f64 / 11.0 - 0.5).collect();
        let patch = random_patch(&shifts);
        // Knots of the solution that the geometry lacks, and the other way round; one of them double.
        let first = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 0.7, 0.7, 1.0, 1.0, 2.0]).unwrap();
        let second = SplineSpace::new(3, vec![-1.0, -0.5, -0.1, 0.0, 0.5, 1.0, 1.2, 1.3, 2.0]).unwrap();
        let space = IsogeometricSpace::new(patch.clone(), [first, second], &[PatchSide::Left]).unwrap();
        let space = space.with_gauss_points([5, 6]).unwrap();
        let diffusion = |x: DVec2| DMat2::from_cols_array(&[2.0 + x.x, 0.5, 0.5, 1.5]);
        let (reaction, load) = (|x: DVec2| 1.0 + x.y * x.y, |x: DVec2| (x.x - x.y).sin());
        let form = EllipticForm {
            diffusion: Coefficient::Function(&diffusion),
            reaction: Coefficient::Function(&reaction),
            load: Coefficient::Function(&load),
            gradient_load: Coefficient::Constant(DVec2::ZERO),
        };
        let system = IsogeometricSystem::assemble(space.clone(), &form, &[], &Unwatched).unwrap();
        let [m1, m2] = space.sizes();
        let mut matrix = vec![vec![0.0; m1 * m2]; m1 * m2];
        let mut right_side = vec![0.0; m1 * m2];
        let directions = space.directions().unwrap();
        let points = |direction: &Direction| -> Vec<(f64, f64)> {
            let cells = 0..direction.cells;
            cells.flat_map(|e| (0..direction.rule.count()).map(move |q| direction.point(q, e))).collect()
        };
        for (x, v) in points(&directions[0]) {
            for (y, w) in points(&directions[1]) {
                let jet = patch.jet(DVec2::new(x, y)).unwrap();
                let basis =
                    [active(&space.spaces()[0], 0, x).unwrap(), active(&space.spaces()[1], 1, y).unwrap()];
                let functions: Vec<(usize, f64, DVec2)> = (0..3)
                    .flat_map(|i| (0..4).map(move |j| (i, j)))
                    .map(|(i, j)| {
                        let gradient = DVec2::new(
                            basis[0].slope(i) * basis[1].value(j),
                            basis[0].value(i) * basis[1].slope(j),
                        );
                        let k = (basis[0].first + i) * m2 + basis[1].first + j;
                        (k, basis[0].value(i) * basis[1].value(j), jet.gradient(gradient))
                    })
                    .collect();
                let total = v * w * jet.determinant().abs();
                let at = form.at(jet.point).unwrap();
                for (k, value, gradient) in &functions {
                    right_side[*k] += total * at.load * value;
                    for (l, other, other_gradient) in &functions {
                        matrix[*k][*l] += total
                            * (gradient.dot(at.diffusion * *other_gradient) + at.reaction * value * other);
                    }
                }
            }
        }
        for k in 0..m1 * m2 {
            let error = system.right_side()[k] - right_side[k];
            assert!(error.abs() < 1e-13, "right side {k} is off by {error}");
            for l in 0..m1 * m2 {
                let got = system.matrix().entry([k / m2, k % m2], [l / m2, l % m2]);
                assert!((got - matrix[k][l]).abs() < 1e-11, "({k}, {l}): {got}, expected {}", matrix[k][l]);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn linear_functions_pass_the_patch_test(shifts in prop::collection::vec(-0.5..0.5_f64, 24)) {
            // u = x₁ has −Δu = 0 and the flux n₁; with weights 1 it lies in the space of the geometry.
            let patch = random_patch(&shifts);
            let patch = PlanePatch::polynomial(patch.spaces().clone(), patch.points().to_vec()).unwrap();
            prop_assume!(patch.check_regular().is_ok());
            let space = IsogeometricSpace::new(patch.clone(), patch.spaces().clone(), &[]).unwrap();
            let system = IsogeometricSystem::assemble(space, &form(0.0), &[], &Unwatched).unwrap();
            let u: Vec<f64> = patch.points().iter().map(|point| point.x).collect();
            let mut load = vec![0.0; u.len()];
            system.matrix().apply(&u, &mut load);
            let energy: f64 = u.iter().zip(&load).map(|(u, f)| u * f).sum();
            prop_assert!((energy - patch.area()).abs() < 1e-11, "a(x, x) is {energy}, the area {}", patch.area());
            let mut constant = vec![0.0; u.len()];
            system.matrix().apply(&vec![1.0; u.len()], &mut constant);
            prop_assert!(constant.iter().all(|g| g.abs() < 1e-12), "constants are in the kernel: {constant:?}");
            let solution = system.with_right_side(load).unwrap().solve(&Unwatched).unwrap();
            let jet = solution.jet(DVec2::new(0.3, 0.6)).unwrap();
            prop_assert!((jet.gradient - DVec2::X).length() < 1e-9, "the gradient is {}", jet.gradient);
            prop_assert!(solution.integral().unwrap().abs() < 1e-9, "the mean value is 0");
        }
    }

    #[test]
    fn a_patch_that_turns_orientation_has_the_same_solution() {
        let patch = sample::book_patch();
        let points = (0..6).map(|k| patch.points()[(k % 2) * 3 + k / 2]).collect();
        let [first, second] = patch.spaces().clone();
        let turned = PlanePatch::polynomial([second, first], points).unwrap();
        let integral = |patch: &PlanePatch, side: PatchSide, divisions: [usize; 2]| {
            let space = IsogeometricSpace::refined(patch, 3, divisions, &[side]).unwrap();
            solve_patch(space, &form(1.0), &[], &Unwatched).unwrap().integral().unwrap()
        };
        let (straight, mirrored) =
            (integral(&patch, PatchSide::Bottom, [3, 5]), integral(&turned, PatchSide::Left, [5, 3]));
        assert!((straight - mirrored).abs() < 1e-10, "{straight} and {mirrored}");
    }

    #[test]
    fn on_the_annulus_the_separable_system_is_nearly_the_system() {
        for (degree, divisions) in [(1, 8), (3, 8), (3, 40), (5, 20)] {
            let patch = sample::quarter_annulus(1.0, 2.0).unwrap();
            let space = IsogeometricSpace::refined(&patch, degree, [divisions; 2], &PatchSide::ALL).unwrap();
            let solution = solve_patch(space, &form(1.0), &[], &Unwatched).unwrap();
            let steps = solution.residuals().len() - 1;
            assert!(steps <= 12, "degree {degree}, {divisions} divisions: {steps} steps");
        }
    }

    #[test]
    fn sides_with_a_flux_take_it() {
        // u = x² − y² on the annulus: the flux through r = 2 is ∂ᵣ r² cos 2θ = 2 r cos 2θ, through r = 1 its negative;
        // on the axes the normal derivative vanishes.
        let patch = sample::quarter_annulus(1.0, 2.0).unwrap();
        let space = IsogeometricSpace::refined(&patch, 4, [12, 12], &[]).unwrap();
        let outward = |x: DVec2| 2.0 * (x.x * x.x - x.y * x.y) / x.length();
        let inward = |x: DVec2| -outward(x);
        let fluxes = [
            SideFlux { side: PatchSide::Right, flux: &outward },
            SideFlux { side: PatchSide::Left, flux: &inward },
        ];
        let solution = solve_patch(space.clone(), &form(0.0), &fluxes, &Unwatched).unwrap();
        let jet = solution.jet_at(DVec2::new(1.0, 1.2)).unwrap();
        let error = jet.gradient - DVec2::new(2.0, -2.4);
        assert!(error.length() < 1e-4, "the gradient is off by {error}");
        let one = [SideFlux { side: PatchSide::Right, flux: &|_| 1.0 }];
        let error = solve_patch(space, &form(0.0), &one, &Unwatched).unwrap_err();
        assert_eq!(error.name(), "IncompatibleData", "more in than out");
    }

    #[test]
    fn bad_data_is_refused() {
        let square = sample::unit_square();
        let refined = |degree: usize, divisions: usize| {
            IsogeometricSpace::refined(&square, degree, [divisions, 2], &PatchSide::ALL)
                .map(|_| ())
                .map_err(|error| error.name())
        };
        assert_eq!(refined(0, 2), Err("DegreeZero"), "degree 0");
        assert_eq!(refined(2, 0), Err("Empty"), "no divisions");
        assert_eq!(refined(2, usize::MAX), Err("StepLimit"), "too many");
        let folded = square.with_point(3, DVec2::new(0.1, 0.1)).unwrap();
        let error = IsogeometricSpace::refined(&folded, 2, [2, 2], &[]).unwrap_err();
        assert_eq!(error.name(), "FoldedParametrisation", "a folded patch");
        let simple = SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap();
        let spaces = [simple.clone(), simple];
        let error = IsogeometricSpace::new(square.clone(), spaces, &[PatchSide::Top]).unwrap_err();
        assert_eq!(error.name(), "DirichletSideUnknown", "simple end knots");
        let long = SplineSpace::uniform(2, 0.0, 2.0, 3).unwrap();
        let error = IsogeometricSpace::new(square.clone(), [long.clone(), long], &[]).unwrap_err();
        assert_eq!(error.name(), "OutsideInterval", "another interval");
        let space = IsogeometricSpace::refined(&square, 2, [3, 3], &PatchSide::ALL).unwrap();
        let hole = |x: DVec2| if x.x > 0.5 { f64::NAN } else { 1.0 };
        let bad = EllipticForm::poisson(Coefficient::Function(&hole));
        let error = solve_patch(space.clone(), &bad, &[], &Unwatched).unwrap_err();
        assert_eq!(error.name(), "NonFinite", "a load with a hole");
        let error = solve_patch(space.clone(), &form(1.0), &[], &|_: f64| false).unwrap_err();
        assert_eq!(error.name(), "Stopped", "nobody wants to wait");
        let smallest = IsogeometricSpace::refined(&square, 1, [1, 1], &PatchSide::ALL).unwrap();
        let solution = solve_patch(smallest, &form(1.0), &[], &Unwatched).unwrap();
        assert_eq!(solution.coefficients(), [0.0; 4], "no unknowns");
    }
}
