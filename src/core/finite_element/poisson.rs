//! Boundary value problems `−div(A grad u) + c u = f`, `u = 0` on Γ, from the domain to the errors in one call.
//!
//! Course: sections 9.1, 9.2 and 9.4.

use glam::DVec2;

use crate::core::domain::{Bounds, Domain, Jet};
use crate::core::finite_element::assembly::{assemble, map_elements};
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::error_norm::{ErrorNorms, ErrorSums, convergence_rates};
use crate::core::finite_element::form::EllipticForm;
use crate::core::finite_element::grid::Grid;
use crate::core::finite_element::offset_matrix::OffsetMatrix;
use crate::core::finite_element::ritz_galerkin::GalerkinSystem;
use crate::core::finite_element::solver::{
    Method, SystemMatrix as _, SystemSolution, solve_system, solve_up_to_a_constant,
};
use crate::core::finite_element::web_spline::{NodeArray, NodeClass};
use crate::core::finite_element::weight_function::Weight;
use crate::core::finite_element::weighted_bspline::{WeightedSpace, is_relevant};
use crate::core::linear_system::{DenseMatrix, IterationLimits, LinearSystemError, SparseMatrix};
use crate::core::progress::{Part, Watcher};

/// A boundary value problem.
#[derive(Clone, Debug)]
pub struct Problem<'a> {
    /// Where.
    pub domain: &'a Domain,
    /// Zero on Γ: [`Weight::OfDomain`] for the whole boundary, [`Weight::One`] for natural conditions everywhere.
    pub weight: Weight,
    /// The equation.
    pub form: EllipticForm<'a>,
}

/// Which functions span the space of approximations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Basis {
    /// Weighted B-splines with the diagonal preconditioner.
    #[default]
    Weighted,
    /// Web-splines: condition numbers bounded by a constant over h².
    Web,
}

/// How a problem is discretised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discretisation {
    /// The degree `n`.
    pub degree: usize,
    /// The grid width `h`.
    pub width: f64,
    /// The grid's box; `None` takes the one around the domain.
    pub bounds: Option<Bounds>,
    /// Gauss points in each direction of a cell or a piece of a cut cell.
    pub gauss_points: usize,
    /// The basis.
    pub basis: Basis,
    /// How the system is solved.
    pub method: Method,
}

impl Discretisation {
    /// Weighted B-splines of `degree` with grid width `width`, n + 3 Gauss points, conjugate gradients to a
    /// relative residual of 1e-10.
    pub fn new(degree: usize, width: f64) -> Self {
        let limits = IterationLimits { relative_tolerance: 1e-10, max_steps: 20_000 };
        Self {
            degree,
            width,
            bounds: None,
            gauss_points: degree.saturating_add(3),
            basis: Basis::Weighted,
            method: Method::ConjugateGradients(limits),
        }
    }

    /// The grid for a domain.
    ///
    /// # Errors
    ///
    /// `NonFinite` for an unbounded domain without a box, `EmptyInterval`, `StepLimit`.
    pub fn grid(&self, domain: &Domain) -> Result<Grid, FiniteElementError> {
        let bounds = self.bounds.unwrap_or_else(|| domain.bounds());
        if !bounds.is_finite() {
            let (point, value) = (bounds.lower, bounds.size().element_sum());
            return Err(FiniteElementError::NonFinite { what: "the box of the domain", point, value });
        }
        Grid::with_width(bounds, self.width)
    }
}

/// An assembled problem: the system of the weighted B-splines, with unit rows for irrelevant ones.
#[derive(Clone, Debug)]
pub struct WeightedSystem {
    /// The space.
    pub space: WeightedSpace,
    /// Matrix and right side for the whole array.
    pub system: GalerkinSystem<OffsetMatrix>,
    /// Whether constants lie in the kernel: natural conditions everywhere and no reaction.
    pub is_singular: bool,
}

impl WeightedSystem {
    /// Sets up space, quadrature, matrix and right side.
    ///
    /// # Errors
    ///
    /// Those of grid, quadrature, weight and coefficients, `Stopped`.
    pub fn assemble(
        problem: &Problem<'_>,
        discretisation: &Discretisation,
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        let grid = discretisation.grid(problem.domain)?;
        let (degree, points) = (discretisation.degree, discretisation.gauss_points);
        let (domain, weight) = (problem.domain.clone(), problem.weight.clone());
        let slicing = Part { whole: watcher, from: 0.0, to: 0.3 };
        let space = WeightedSpace::new(domain, weight, grid, degree, points, &slicing)?;
        Self::in_space(space, &problem.form, &Part { whole: watcher, from: 0.3, to: 1.0 })
    }

    /// Matrix and right side in a space that is kept from an earlier problem.
    ///
    /// # Errors
    ///
    /// Those of weight and coefficients, `Stopped`.
    pub fn in_space(
        space: WeightedSpace,
        form: &EllipticForm<'_>,
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        let mut matrix = OffsetMatrix::new(&space.nodes().shape(), space.degree())?;
        let load = assemble(&space, form, &mut matrix, watcher)?;
        matrix.set_identity_rows(&free(space.nodes()))?;
        let is_singular = space.weight().is_one() && form.kills_constants();
        Ok(Self { space, system: GalerkinSystem { matrix, load }, is_singular })
    }

    /// Matrix and right side of the web-splines, and `DE`, whose transpose gives back coefficients of the array.
    ///
    /// # Errors
    ///
    /// `NoInnerArray`, `NonFinite`.
    pub fn web(&self) -> Result<(GalerkinSystem<SparseMatrix>, SparseMatrix), FiniteElementError> {
        let space = &self.space;
        let weight_at = |cell| space.weight().at(space.grid().cell(cell).center()).value;
        let extension = space.nodes().web_matrix(weight_at)?;
        let sparse = self.system.matrix.to_sparse()?;
        let matrix = extension.times(&sparse)?.times(&extension.transpose())?;
        let mut load = vec![0.0; extension.rows()];
        extension.multiply(&self.system.load, &mut load)?;
        Ok((GalerkinSystem { matrix, load }, extension))
    }

    /// Solves the system; `start` holds coefficients of an earlier solution on the same array.
    ///
    /// A pure Neumann problem gets the solution with mean value 0.
    ///
    /// # Errors
    ///
    /// Those of the solver; `NoInnerArray` for web-splines on a coarse grid, `IncompatibleData`,
    /// `SingularSystem` for a pure Neumann problem with web-splines.
    pub fn solve(
        self,
        basis: Basis,
        method: Method,
        start: Option<&[f64]>,
        watcher: &dyn Watcher,
    ) -> Result<WeightedSolution, FiniteElementError> {
        let GalerkinSystem { matrix, load } = &self.system;
        let start = start.filter(|start| start.len() == load.len());
        let solved = match (basis, self.is_singular) {
            (Basis::Web, true) => return Err(FiniteElementError::SingularSystem),
            (Basis::Web, false) => {
                let (system, extension) = self.web()?;
                let solved = solve_system(&system.matrix, &system.load, None, method, watcher)?;
                let mut coefficients = vec![0.0; load.len()];
                extension.transpose().multiply(&solved.coefficients, &mut coefficients)?;
                SystemSolution { coefficients, residuals: solved.residuals }
            }
            (Basis::Weighted, true) => {
                let limits = match method {
                    Method::ConjugateGradients(limits) => limits,
                    Method::Direct => IterationLimits::default(),
                };
                solve_up_to_a_constant(matrix, load, &free(self.space.nodes()), limits, watcher)?
            }
            (Basis::Weighted, false) => solve_system(matrix, load, start, method, watcher)?,
        };
        let mut solution = WeightedSolution {
            space: self.space,
            coefficients: solved.coefficients,
            residuals: solved.residuals,
        };
        if self.is_singular {
            let mean = solution.integral()? / solution.space.table().integrate(|_| 1.0);
            // The B-splines sum to 1.
            let free = free(solution.space.nodes());
            solution
                .coefficients
                .iter_mut()
                .zip(free)
                .for_each(|(c, free)| *c -= if free { mean } else { 0.0 });
        }
        Ok(solution)
    }
}

/// The approximate solution of a problem.
#[derive(Clone, Debug)]
pub struct WeightedSolution {
    /// The space.
    pub space: WeightedSpace,
    /// One coefficient for each B-spline of the array.
    pub coefficients: Vec<f64>,
    /// Norms of the residuals of conjugate gradients; empty for a direct solution.
    pub residuals: Vec<f64>,
}

impl WeightedSolution {
    /// Number of unknowns that were free: relevant B-splines.
    pub fn unknowns(&self) -> usize {
        self.space.nodes().relevant_count()
    }

    /// Value and gradient at `x`; `None` outside the domain.
    pub fn evaluate(&self, x: DVec2) -> Option<Jet> {
        self.space.evaluate(&self.coefficients, x)
    }

    /// Values on a lattice over the grid's box, see [`WeightedSpace::write_values`].
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn write_values(
        &self,
        columns: usize,
        rows: usize,
        values: &mut [f64],
    ) -> Result<(), FiniteElementError> {
        self.space.write_values(&self.coefficients, columns, rows, values)
    }

    /// `∫ u_h` over the domain.
    ///
    /// # Errors
    ///
    /// Those of the weight function.
    pub fn integral(&self) -> Result<f64, FiniteElementError> {
        let sums = map_elements(&self.space, |samples| {
            let values = samples.weights.iter().enumerate();
            Ok(values.map(|(p, weight)| weight * samples.combine(p, &self.coefficients).value).sum::<f64>())
        })?;
        Ok(sums.iter().sum())
    }

    /// Norms of the error against `exact`, by the quadrature of the space.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `exact` is not finite somewhere.
    pub fn errors(&self, exact: &(dyn Fn(DVec2) -> Jet + Sync)) -> Result<ErrorNorms, FiniteElementError> {
        let parts = map_elements(&self.space, |samples| {
            let mut sums = ErrorSums::default();
            for (p, (&point, &weight)) in samples.points.iter().zip(&samples.weights).enumerate() {
                let wanted = exact(point);
                if !(wanted.value.is_finite() && wanted.gradient.is_finite()) {
                    let value = wanted.value + wanted.gradient.x + wanted.gradient.y;
                    return Err(FiniteElementError::NonFinite { what: "the exact solution", point, value });
                }
                sums.add(weight, &samples.combine(p, &self.coefficients), &wanted);
            }
            Ok(sums)
        })?;
        let mut sums = ErrorSums::default();
        parts.iter().for_each(|part| sums.merge(part));
        Ok(sums.norms())
    }
}

/// Discretises and solves a problem; `start` may hold the coefficients of an earlier solution on the same grid.
///
/// ```
/// # use glam::DVec2;
/// # use spline_lab::core::domain::Domain;
/// # use spline_lab::core::finite_element::{Coefficient, Discretisation, EllipticForm, Problem, Weight, solve_problem};
/// # use spline_lab::core::progress::Unwatched;
/// // −Δu = 4 on the unit disc: u = 1 − |x|².
/// let disc = Domain::disc(DVec2::ZERO, 1.0)?;
/// let form = EllipticForm::poisson(Coefficient::Constant(4.0));
/// let problem = Problem { domain: &disc, weight: Weight::OfDomain(disc.clone()), form };
/// let solution = solve_problem(&problem, &Discretisation::new(2, 0.25), None, &Unwatched)?;
/// let middle = solution.evaluate(DVec2::ZERO).expect("inside");
/// assert!((middle.value - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`WeightedSystem::assemble`] and [`WeightedSystem::solve`].
pub fn solve_problem(
    problem: &Problem<'_>,
    discretisation: &Discretisation,
    start: Option<&[f64]>,
    watcher: &dyn Watcher,
) -> Result<WeightedSolution, FiniteElementError> {
    let assembling = Part { whole: watcher, from: 0.0, to: 0.6 };
    let system = WeightedSystem::assemble(problem, discretisation, &assembling)?;
    let solving = Part { whole: watcher, from: 0.6, to: 1.0 };
    system.solve(discretisation.basis, discretisation.method, start, &solving)
}

/// Errors of one degree over a list of grid widths.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergenceStudy {
    /// The degree.
    pub degree: usize,
    /// The grid widths.
    pub widths: Vec<f64>,
    /// Numbers of unknowns.
    pub unknowns: Vec<usize>,
    /// The errors.
    pub errors: Vec<ErrorNorms>,
    /// Observed rates of the L2 error between neighbouring widths.
    pub l2_rates: Vec<f64>,
    /// Observed rates of the error in the H1 seminorm.
    pub h1_rates: Vec<f64>,
}

/// Solves a problem with the known solution `exact` for all `widths`.
///
/// # Errors
///
/// As [`solve_problem`].
pub fn weighted_convergence_study(
    problem: &Problem<'_>,
    exact: &(dyn Fn(DVec2) -> Jet + Sync),
    discretisation: &Discretisation,
    widths: &[f64],
    watcher: &dyn Watcher,
) -> Result<ConvergenceStudy, FiniteElementError> {
    let (mut unknowns, mut errors) = (Vec::new(), Vec::new());
    for (number, &width) in widths.iter().enumerate() {
        let at = |place: usize| place as f64 / widths.len() as f64;
        let part = Part { whole: watcher, from: at(number), to: at(number + 1) };
        let solution = solve_problem(problem, &Discretisation { width, ..*discretisation }, None, &part)?;
        unknowns.push(solution.unknowns());
        errors.push(solution.errors(exact)?);
    }
    let rates =
        |of: fn(&ErrorNorms) -> f64| convergence_rates(widths, &errors.iter().map(of).collect::<Vec<_>>());
    let (l2_rates, h1_rates) = (rates(|e| e.l2), rates(|e| e.h1_seminorm));
    Ok(ConvergenceStudy {
        degree: discretisation.degree,
        widths: widths.to_vec(),
        unknowns,
        errors,
        l2_rates,
        h1_rates,
    })
}

fn free(nodes: &NodeArray<2>) -> Vec<bool> {
    nodes.classes().iter().map(|class: &NodeClass| is_relevant(*class)).collect()
}

/// The largest matrix whose eigenvalues are computed: beyond it they take minutes.
const MAX_DENSE: usize = 3000;

/// The spectral condition number of a matrix, optionally scaled to a unit diagonal, over the rows that are `kept`.
///
/// # Errors
///
/// `StepLimit` above 3000 rows, `NotPositiveDefinite` if an eigenvalue or, for scaling, a diagonal entry is not
/// positive, `NotConverged`.
pub fn condition_number(
    matrix: &SparseMatrix,
    kept: &[bool],
    scaled: bool,
) -> Result<f64, FiniteElementError> {
    let rows: Vec<usize> =
        (0..matrix.rows()).filter(|row| kept.get(*row).copied().unwrap_or(false)).collect();
    if rows.len() > MAX_DENSE {
        return Err(LinearSystemError::StepLimit { size: rows.len() }.into());
    }
    let scale = |k: usize| if scaled { matrix.entry(k, k).sqrt().recip() } else { 1.0 };
    let dense = DenseMatrix::from_function(rows.len(), rows.len(), |i, j| {
        scale(rows[i]) * matrix.entry(rows[i], rows[j]) * scale(rows[j])
    })?;
    let eigenvalues = dense.symmetric_eigenvalues()?;
    match (eigenvalues.first(), eigenvalues.last()) {
        (Some(&min), Some(&max)) if min > 0.0 => Ok(max / min),
        (min, _) => {
            let (what, index, value) = ("eigenvalue", 0, min.copied().unwrap_or(f64::NAN));
            Err(LinearSystemError::NotPositiveDefinite { what, index, value }.into())
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use glam::DMat2;

    use super::*;
    use crate::core::finite_element::form::Coefficient;
    use crate::core::progress::Unwatched;

    fn half_disc() -> Domain {
        let disc = Domain::disc(DVec2::ZERO, 1.0).unwrap();
        disc.intersection(Domain::half_plane(DVec2::ZERO, DVec2::Y).unwrap())
    }

    /// The product of the levels, smooth also at the corners.
    fn half_disc_weight(x: DVec2) -> Jet {
        let d = 1.0 - x.length_squared();
        Jet { value: x.y * d, gradient: DVec2::new(-2.0 * x.x * x.y, d - 2.0 * x.y * x.y) }
    }

    fn exact(x: DVec2) -> Jet {
        let (w, g) = (half_disc_weight(x), (2.0 * x.x).sin() + x.y);
        let slope = DVec2::new(2.0 * (2.0 * x.x).cos(), 1.0);
        Jet { value: w.value * g, gradient: w.gradient * g + slope * w.value }
    }

    fn diffusion(x: DVec2) -> DMat2 {
        DMat2::from_cols_array(&[2.0 + x.x, 0.3, 0.3, 1.5])
    }

    /// The loads that make [`exact`] the solution with [`diffusion`] and c = 1 + y.
    fn manufactured<'a>(
        flux: &'a (dyn Fn(DVec2) -> DVec2 + Sync),
        f: &'a (dyn Fn(DVec2) -> f64 + Sync),
    ) -> EllipticForm<'a> {
        EllipticForm {
            diffusion: Coefficient::Function(&diffusion),
            reaction: Coefficient::Function(&|x| 1.0 + x.y),
            load: Coefficient::Function(f),
            gradient_load: Coefficient::Function(flux),
        }
    }

    #[test]
    fn errors_fall_with_the_rates_n_plus_1_and_n_for_variable_coefficients() {
        let (flux, f) = (|x| diffusion(x) * exact(x).gradient, |x: DVec2| (1.0 + x.y) * exact(x).value);
        let form = manufactured(&flux, &f);
        let domain = half_disc();
        let problem = Problem { domain: &domain, weight: Weight::function(half_disc_weight), form };
        for degree in 1..=3 {
            let settings = Discretisation { method: Method::Direct, ..Discretisation::new(degree, 0.25) };
            let study =
                weighted_convergence_study(&problem, &exact, &settings, &[0.2, 0.1, 0.05], &Unwatched)
                    .unwrap();
            let (n, last) = (degree as f64, study.l2_rates.len() - 1);
            assert!(
                (study.l2_rates[last] - n - 1.0).abs() < 0.2,
                "degree {degree}, L2: {:?}",
                study.l2_rates
            );
            assert!((study.h1_rates[last] - n).abs() < 0.2, "degree {degree}, H1: {:?}", study.h1_rates);
        }
    }

    #[test]
    fn weighted_polynomials_are_their_own_projection_whatever_the_quadrature() {
        let polynomial = |x: DVec2| Jet {
            value: 1.0 + x.x - 2.0 * x.x * x.y,
            gradient: DVec2::new(1.0 - 2.0 * x.y, -2.0 * x.x),
        };
        let u = |x: DVec2| {
            let (w, q) = (half_disc_weight(x), polynomial(x));
            Jet { value: w.value * q.value, gradient: w.gradient * q.value + q.gradient * w.value }
        };
        let (flux, f) = (|x| diffusion(x) * u(x).gradient, |x: DVec2| (1.0 + x.y) * u(x).value);
        let domain = half_disc();
        let form = manufactured(&flux, &f);
        let problem = Problem { domain: &domain, weight: Weight::function(half_disc_weight), form };
        for basis in [Basis::Weighted, Basis::Web] {
            let settings = Discretisation {
                basis,
                gauss_points: 3,
                method: Method::Direct,
                ..Discretisation::new(2, 0.17)
            };
            let solution = solve_problem(&problem, &settings, None, &Unwatched).unwrap();
            let errors = solution.errors(&u).unwrap();
            // The extension keeps polynomials of degree n, and the factors 1/w(xᵢ) only scale the basis.
            assert!(errors.relative_l2() < 1e-11, "{basis:?}: {errors:?}");
        }
    }

    #[test]
    fn the_solution_vanishes_on_the_boundary_and_does_not_depend_on_the_number_of_threads() {
        let domain = half_disc();
        let load = |x: DVec2| x.x.exp();
        let form = EllipticForm::poisson(Coefficient::Function(&load));
        let problem = Problem { domain: &domain, weight: Weight::OfDomain(domain.clone()), form };
        let settings = Discretisation::new(2, 0.1);
        let solve = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solve_problem(&problem, &settings, None, &Unwatched).unwrap())
        };
        let one = solve(1);
        assert_eq!(one.coefficients, solve(3).coefficients, "bit for bit");
        assert!(one.system_is_positive(&form), "matrix");
        for &x in one.space.table().boundary() {
            let inside = x * (1.0 - 1e-12) + 1e-12 * DVec2::new(0.0, 0.5);
            let value = one.evaluate(inside).unwrap().value;
            assert!(value.abs() < 1e-10, "{value} at the boundary point {x}");
        }
    }

    impl WeightedSolution {
        fn system_is_positive(&self, form: &EllipticForm<'_>) -> bool {
            let system = WeightedSystem::in_space(self.space.clone(), form, &Unwatched).unwrap();
            let sparse = system.system.matrix.to_sparse().unwrap();
            system.system.matrix.is_symmetric(0.0) && sparse.cholesky().is_ok()
        }
    }

    #[test]
    fn what_cannot_be_solved_is_named() {
        let domain = half_disc();
        let problem = |weight: Weight, form| Problem { domain: &domain, weight, form };
        let essential = || Weight::OfDomain(domain.clone());
        let poisson = |f: f64| EllipticForm::poisson(Coefficient::Constant(f));
        let name = |problem: &Problem<'_>, settings: &Discretisation| {
            solve_problem(problem, settings, None, &Unwatched).map_or_else(|error| error.name(), |_| "ok")
        };
        let settings = Discretisation::new(2, 0.25);
        assert_eq!(
            name(&problem(Weight::One, poisson(1.0)), &settings),
            "IncompatibleData",
            "load without balance"
        );
        let web = Discretisation { basis: Basis::Web, ..settings };
        assert_eq!(name(&problem(Weight::One, poisson(0.0)), &web), "SingularSystem", "free web-splines");
        assert_eq!(
            name(&problem(essential(), poisson(1.0)), &Discretisation { width: 1.0, ..web }),
            "NoInnerArray",
            "coarse"
        );
        assert_eq!(name(&problem(essential(), poisson(f64::NAN)), &settings), "NonFinite", "load");
        let form = EllipticForm { reaction: Coefficient::Constant(-1.0), ..poisson(1.0) };
        assert_eq!(name(&problem(essential(), form), &settings), "NotElliptic", "reaction");
        assert_eq!(
            name(&problem(essential(), poisson(1.0)), &Discretisation { degree: 0, ..settings }),
            "StepLimit",
            "degree 0"
        );
        let plane = Domain::half_plane(DVec2::ZERO, DVec2::X).unwrap();
        let unbounded = Problem { domain: &plane, weight: Weight::One, form: poisson(0.0) };
        assert_eq!(name(&unbounded, &settings), "NonFinite", "unbounded domain");
        let stopped = solve_problem(&problem(essential(), poisson(1.0)), &settings, None, &|done| done < 0.5);
        assert_eq!(stopped.unwrap_err().name(), "Stopped", "the watcher stops half way");
    }
}
