//! Ritz-Galerkin systems, and those of splines in one variable and of their tensor products.
//!
//! ```text
//! Q(u) = ½ a(u, u) − λ(u),   u_h = Σ uₖ Bₖ minimises Q  ⟺  G U = F,   gₖₖ' = a(Bₖ', Bₖ),   fₖ = λ(Bₖ),
//! ```
//!
//! and then `Q(u_h) = −F·U/2`, `a(u_h, u_h) = F·U`. In one variable `a(u, v) = ∫ A u' v' + c u v`, `λ(v) = ∫ f
//! v`; on a rectangle the system of `−Δu + c u = f` with `f = f₁(x₁) f₂(x₂)` is `G = K₁ ⊗ M₂ + M₁ ⊗ K₂ + c M₁ ⊗
//! M₂`, `F = F₁ ⊗ F₂` with the stiffness matrices `K` and the mass matrices `M`.
//!
//! W. Ritz, 1908; B. Galerkin, 1915. Course: sections 9.1 and 9.4.

use crate::core::bspline::SplineSpace;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::offset_matrix::OffsetMatrix;
use crate::core::finite_element::solver::{Method, SystemMatrix, SystemSolution, solve_system};
use crate::core::linear_system::SparseMatrix;
use crate::core::progress::Watcher;
use crate::core::quadrature::gauss_legendre;

/// A Galerkin matrix with its right side.
#[derive(Clone, Debug, PartialEq)]
pub struct GalerkinSystem<M> {
    /// `G`, symmetric.
    pub matrix: M,
    /// `F`.
    pub load: Vec<f64>,
}

impl<M: SystemMatrix> GalerkinSystem<M> {
    /// `Q = ½ U·GU − F·U` of any coefficients; missing ones count as 0.
    pub fn energy(&self, coefficients: &[f64]) -> f64 {
        let mut u = coefficients.to_vec();
        u.resize(self.matrix.size(), 0.0);
        let mut product = vec![0.0; u.len()];
        self.matrix.apply(&u, &mut product);
        let terms = u.iter().zip(&product).zip(&self.load);
        terms.map(|((u, gu), f)| u * (0.5 * gu - f)).sum()
    }

    /// The coefficients of the minimum.
    ///
    /// # Errors
    ///
    /// As [`solve_system`].
    pub fn solve(
        &self,
        start: Option<&[f64]>,
        method: Method,
        watcher: &dyn Watcher,
    ) -> Result<SystemSolution, FiniteElementError> {
        solve_system(&self.matrix, &self.load, start, method, watcher)
    }

    /// The system of the functions with the indices `kept`, in this succession: the others are discarded as by
    /// essential conditions.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange`.
    pub fn restrict(&self, kept: &[usize]) -> Result<GalerkinSystem<SparseMatrix>, FiniteElementError> {
        let size = self.matrix.size();
        let select: Vec<_> = kept.iter().enumerate().map(|(row, &column)| (row, column, 1.0)).collect();
        let select = SparseMatrix::from_triplets(kept.len(), size, &select)?;
        let matrix = select.times(&self.matrix.to_sparse()?)?.times(&select.transpose())?;
        Ok(GalerkinSystem { matrix, load: kept.iter().map(|&k| self.load[k]).collect() })
    }
}

/// The coefficients of a form in one variable at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineForm {
    /// `A`.
    pub diffusion: f64,
    /// `c`.
    pub reaction: f64,
    /// `f`.
    pub load: f64,
}

/// The system of `−(A u')' + c u = f` with natural conditions for all splines of an open space; `points` Gauss
/// points per knot interval.
///
/// # Errors
///
/// `Empty` or `StepLimit` (number of points), `NonFinite` for a coefficient that is not finite.
pub fn line_system(
    space: &SplineSpace,
    form: impl Fn(f64) -> LineForm,
    points: usize,
) -> Result<GalerkinSystem<OffsetMatrix>, FiniteElementError> {
    let (n, m) = (space.degree(), space.evaluation_dimension());
    let rule = gauss_legendre(points)?;
    let mut matrix = OffsetMatrix::new(&[m], n)?;
    let mut load = vec![0.0; m];
    for pair in space.breaks().windows(2) {
        for (x, weight) in rule.on(pair[0], pair[1]) {
            let at = form(x);
            let sum = at.diffusion + at.reaction + at.load;
            if !sum.is_finite() {
                let point = glam::DVec2::new(x, 0.0);
                return Err(FiniteElementError::NonFinite { what: "a coefficient", point, value: sum });
            }
            let triangle = space.basis_triangle(x)?;
            let (first, values) = (triangle.span - n, &triangle.levels[n]);
            let slopes = slopes(space, triangle.span, &triangle.levels[n - 1]);
            for i in 0..=n {
                load[first + i] += weight * at.load * values[i];
                for j in 0..=n {
                    let entry = at.diffusion * slopes[i] * slopes[j] + at.reaction * values[i] * values[j];
                    matrix.add(first + i, first + j, weight * entry);
                }
            }
        }
    }
    Ok(GalerkinSystem { matrix, load })
}

/// Derivatives of the B-splines of knot interval `span` from those of one degree less:
/// `bₖ' = n bₖⁿ⁻¹/(ξₖ₊ₙ − ξₖ) − n bₖ₊₁ⁿ⁻¹/(ξₖ₊ₙ₊₁ − ξₖ₊₁)`.
fn slopes(space: &SplineSpace, span: usize, lower: &[f64]) -> Vec<f64> {
    let (n, knots) = (space.degree(), space.evaluation_knots());
    let first = span - n;
    let part = |i: usize| n as f64 * lower[i - 1] / (knots[first + i + n] - knots[first + i]);
    let rising = |i: usize| if i > 0 { part(i) } else { 0.0 };
    let falling = |i: usize| if i < n { part(i + 1) } else { 0.0 };
    (0..=n).map(|i| rising(i) - falling(i)).collect()
}

/// The system of `−Δu + c u = f₁(x₁) f₂(x₂)` on the rectangle of two open spaces, with natural conditions.
///
/// # Errors
///
/// As [`line_system`]; `SizeMismatch` if the degrees differ, `StepLimit` (storage).
pub fn rectangle_system(
    spaces: [&SplineSpace; 2],
    reaction: f64,
    load: [&dyn Fn(f64) -> f64; 2],
    points: usize,
) -> Result<GalerkinSystem<OffsetMatrix>, FiniteElementError> {
    let degree = spaces[0].degree();
    if spaces[1].degree() != degree {
        let (expected, found) = (degree, spaces[1].degree());
        return Err(FiniteElementError::SizeMismatch { what: "as degree", expected, found });
    }
    let line = |axis: usize, diffusion: f64, reaction: f64| {
        line_system(spaces[axis], |x| LineForm { diffusion, reaction, load: load[axis](x) }, points)
    };
    let (stiffness, mass) =
        ([line(0, 1.0, 0.0)?, line(1, 1.0, 0.0)?], [line(0, 0.0, 1.0)?, line(1, 0.0, 1.0)?]);
    let shape = [stiffness[0].load.len(), stiffness[1].load.len()];
    let mut matrix = OffsetMatrix::new(&shape, degree)?;
    let reach = degree as isize;
    for k1 in 0..shape[0] {
        for s1 in -reach..=reach {
            let (a, m) = (stiffness[0].matrix.entry(&[k1], &[s1]), mass[0].matrix.entry(&[k1], &[s1]));
            for k2 in 0..shape[1] {
                for s2 in -reach..=reach {
                    let (b, o) =
                        (stiffness[1].matrix.entry(&[k2], &[s2]), mass[1].matrix.entry(&[k2], &[s2]));
                    let value = a * o + m * b + reaction * m * o;
                    if let (Some(l1), Some(l2)) = (k1.checked_add_signed(s1), k2.checked_add_signed(s2))
                        && l1 < shape[0]
                        && l2 < shape[1]
                    {
                        matrix.add(k1 * shape[1] + k2, l1 * shape[1] + l2, value);
                    }
                }
            }
        }
    }
    let load = mass[0].load.iter().flat_map(|f| mass[1].load.iter().map(move |g| f * g)).collect();
    Ok(GalerkinSystem { matrix, load })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::EndKnots;
    use crate::core::progress::Unwatched;

    fn string(intervals: usize, degree: usize) -> (SplineSpace, GalerkinSystem<SparseMatrix>) {
        let breaks: Vec<f64> = (0..=intervals).map(|i| (i as f64 / intervals as f64).powf(1.2)).collect();
        let space = SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating).unwrap();
        let form = |_| LineForm { diffusion: 1.0, reaction: 0.0, load: 1.0 };
        let system = line_system(&space, form, degree + 1).unwrap();
        let kept: Vec<usize> = (1..space.dimension() - 1).collect();
        (space, system.restrict(&kept).unwrap())
    }

    #[test]
    fn linear_elements_are_exact_at_the_knots_of_any_grid() {
        let (space, system) = string(7, 1);
        let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
        for (k, value) in u.iter().enumerate() {
            let x = space.greville_abscissae()[k + 1];
            assert!((value - 0.5 * x * (1.0 - x)).abs() < 1e-15, "at {x}: {value}");
        }
    }

    #[test]
    fn quadratic_elements_contain_the_parabola_and_the_energy_of_the_minimum_is_minus_one_24th() {
        let (_, system) = string(3, 2);
        let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
        assert!((system.energy(&u) + 1.0 / 24.0).abs() < 1e-16, "Q = {}", system.energy(&u));
        let mut other = u;
        other[1] += 0.01;
        assert!(system.energy(&other) > -1.0 / 24.0 + 1e-6, "any other function has more energy");
    }

    #[test]
    fn the_energy_falls_under_nested_refinement() {
        let mut last = 0.0;
        for intervals in [2, 4, 8, 16] {
            let space = SplineSpace::uniform(2, 0.0, 1.0, intervals).unwrap();
            let form = |x: f64| LineForm { diffusion: 1.0, reaction: 1.0, load: x.exp() };
            let system = line_system(&space, form, 6).unwrap();
            let u = system.solve(None, Method::default(), &Unwatched).unwrap().coefficients;
            let energy = system.energy(&u);
            assert!(energy < last, "{intervals} intervals: {energy} after {last}");
            last = energy;
        }
    }
}
