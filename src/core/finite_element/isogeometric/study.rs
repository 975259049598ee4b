//! Errors against a known solution, and how fast they fall.
//!
//! Expected for degree `n` and a smooth solution: `|e|₁ = O(hⁿ)` and `|e|₀ = O(hⁿ⁺¹)`. Course: section 9.1.

use glam::DVec2;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::error_norm::{ErrorNorms, ErrorSums};
use crate::core::finite_element::form::{EllipticForm, Jet};
use crate::core::finite_element::geometry::{PatchSide, PlanePatch};
use crate::core::finite_element::isogeometric::solution::{IsogeometricSolution, QuadraturePoint};
use crate::core::finite_element::isogeometric::space::IsogeometricSpace;
use crate::core::finite_element::isogeometric::system::solve_patch;
use crate::core::progress::{Part, Watcher};

/// One refinement of a convergence study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyRow {
    /// Parts of every knot interval of the patch.
    pub divisions: usize,
    /// `1/divisions`.
    pub width: f64,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Errors, and norms of the solution.
    pub norms: ErrorNorms,
    /// Steps of conjugate gradients.
    pub steps: usize,
}

impl IsogeometricSolution {
    /// Norms of the difference to the function `exact`, by the quadrature of the space.
    ///
    /// # Errors
    ///
    /// `NonFinite` if a norm is not finite because `exact` is not.
    pub fn error_norms(&self, exact: impl Fn(DVec2) -> Jet + Sync) -> Result<ErrorNorms, FiniteElementError> {
        finite(self.error_sums(exact)?.norms())
    }

    /// The sums of [`Self::error_norms`].
    pub(in crate::core::finite_element) fn error_sums(
        &self,
        exact: impl Fn(DVec2) -> Jet + Sync,
    ) -> Result<ErrorSums, FiniteElementError> {
        self.sums_against(|at| exact(at.place))
    }

    /// Norms of the difference to another solution on the same patch, such as one with a finer mesh; it is taken for exact.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if the parameter rectangles differ.
    pub fn difference_norms(&self, reference: &Self) -> Result<ErrorNorms, FiniteElementError> {
        let rectangle = |solution: &Self| solution.space().patch().parameter_rectangle();
        if rectangle(self) != rectangle(reference) {
            let what = "patches with the same parameter rectangle";
            return Err(FiniteElementError::SizeMismatch { what, expected: 2, found: 1 });
        }
        let sums = self.sums_against(|at| match reference.jet(at.t) {
            Ok(jet) => Jet { value: jet.value, gradient: jet.gradient },
            Err(_) => Jet { value: f64::NAN, gradient: DVec2::NAN },
        })?;
        finite(sums.norms())
    }

    fn sums_against(
        &self,
        exact: impl Fn(&QuadraturePoint) -> Jet + Sync,
    ) -> Result<ErrorSums, FiniteElementError> {
        let rows =
            self.fold_points(ErrorSums::default, |sums, at, jet| sums.add(at.weight, jet, &exact(at)))?;
        let mut total = ErrorSums::default();
        rows.iter().for_each(|row| total.merge(row));
        Ok(total)
    }
}

/// `NonFinite` for norms that are not numbers.
pub(in crate::core::finite_element) fn finite(norms: ErrorNorms) -> Result<ErrorNorms, FiniteElementError> {
    let value = norms.l2 + norms.h1_seminorm;
    if value.is_finite() {
        Ok(norms)
    } else {
        Err(FiniteElementError::NonFinite { what: "the norm of the error", point: DVec2::NAN, value })
    }
}

/// Solves the problem with each of the `divisions` and compares with the solution `exact`, which vanishes on the sides `dirichlet`.
///
/// # Errors
///
/// Those of [`IsogeometricSpace::refined`], [`solve_patch`] and [`IsogeometricSolution::error_norms`].
pub fn convergence_study(
    patch: &PlanePatch,
    degree: usize,
    divisions: &[usize],
    dirichlet: &[PatchSide],
    form: &EllipticForm<'_>,
    exact: impl Fn(DVec2) -> Jet + Sync,
    watcher: &dyn Watcher,
) -> Result<Vec<StudyRow>, FiniteElementError> {
    let count = divisions.len().max(1) as f64;
    let row = |(index, &divisions): (usize, &usize)| {
        let part = Part { whole: watcher, from: index as f64 / count, to: (index + 1) as f64 / count };
        let space = IsogeometricSpace::refined(patch, degree, [divisions; 2], dirichlet)?;
        let solution = solve_patch(space, form, &[], &part)?;
        Ok(StudyRow {
            divisions,
            width: 1.0 / divisions as f64,
            unknowns: solution.space().dimension(),
            norms: solution.error_norms(&exact)?,
            steps: solution.residuals().len().saturating_sub(1),
        })
    };
    divisions.iter().enumerate().map(row).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::error_norm::convergence_rates;
    use crate::core::finite_element::form::Coefficient;
    use crate::core::finite_element::sample_geometries as sample;
    use crate::core::progress::Unwatched;

    #[test]
    fn on_the_annulus_errors_fall_with_the_expected_rates() {
        // u = x y (r² − 1)(r² − 4) vanishes on all sides; −Δu = −x y (32 r² − 60).
        let load = |x: DVec2| -x.x * x.y * (32.0 * x.length_squared() - 60.0);
        let exact = |x: DVec2| {
            let (product, r) = (x.x * x.y, x.length_squared());
            let (factor, slope) = ((r - 1.0) * (r - 4.0), 2.0 * r - 5.0);
            let gradient = DVec2::new(x.y, x.x) * factor + x * (2.0 * product * slope);
            Jet { value: product * factor, gradient }
        };
        let patch = sample::quarter_annulus(1.0, 2.0).unwrap();
        let form = EllipticForm::poisson(Coefficient::Function(&load));
        for degree in 1..=5 {
            let divisions = [8, 16];
            let rows =
                convergence_study(&patch, degree, &divisions, &PatchSide::ALL, &form, exact, &Unwatched);
            let rows = rows.unwrap();
            let widths: Vec<f64> = rows.iter().map(|row| row.width).collect();
            let l2: Vec<f64> = rows.iter().map(|row| row.norms.l2).collect();
            let h1: Vec<f64> = rows.iter().map(|row| row.norms.h1_seminorm).collect();
            let rates = (convergence_rates(&widths, &l2)[0], convergence_rates(&widths, &h1)[0]);
            let n = degree as f64;
            assert!((0.65..1.7).contains(&(rates.0 - n)), "degree {degree}: L2 {l2:?}, rate {}", rates.0);
            assert!((-0.35..0.7).contains(&(rates.1 - n)), "degree {degree}: H1 {h1:?}, rate {}", rates.1);
            assert_eq!(rows[0].unknowns, (8 + degree - 2).pow(2), "degree {degree}: unknowns");
        }
    }

    #[test]
    fn an_exact_solution_that_is_no_number_is_refused() {
        let space = IsogeometricSpace::refined(&sample::unit_square(), 1, [2, 2], &PatchSide::ALL).unwrap();
        let form = EllipticForm::poisson(Coefficient::Constant(1.0));
        let solution = solve_patch(space, &form, &[], &Unwatched).unwrap();
        let error = solution.error_norms(|_| Jet { value: f64::NAN, gradient: DVec2::ZERO }).unwrap_err();
        assert_eq!(error.name(), "NonFinite", "no number");
        let difference = solution.difference_norms(&solution).unwrap();
        assert!(difference.l2 < 1e-16, "a solution agrees with itself: {difference:?}");
    }
}
