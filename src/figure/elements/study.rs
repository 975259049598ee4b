//! Errors against a known solution for h, h/2, h/4, h/8, with the measured rates.
//!
//! The load is `f = −a Δu + c u`, with the derivatives of the formula; on sides of a patch that are not fixed the flux
//! `a ∂u/∂n` is prescribed.

use glam::DVec2;

use crate::core::domain::Jet;
use crate::core::finite_element::{
    Discretisation, ErrorNorms, IsogeometricSpace, PatchSide, PlanePatch, Problem, SideFlux, Weight,
    convergence_rates, solve_patch, solve_problem,
};
use crate::core::formula::Formula;
use crate::core::progress::{Part, Watcher};
use crate::document::{Membrane, Region};
use crate::figure::elements::solve::{SolveError, check_patch_size, discretisation, form_of, value};

/// Number of refinements of a study.
const ROWS: usize = 4;
/// How large a known solution may be where it must be 0, relative to its values.
const ZERO: f64 = 1e-6;

/// A study of errors.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorStudy {
    /// One line for each grid width.
    pub rows: Vec<StudyLine>,
    /// Rates of the L2 error between neighbouring lines.
    pub l2_rates: Vec<f64>,
    /// Rates of the error in the H1 seminorm.
    pub h1_rates: Vec<f64>,
    /// Why there are no more lines, if something stood against them.
    pub note: Option<String>,
}

/// One grid width of a study; errors relative to the solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyLine {
    /// The grid width.
    pub width: f64,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Relative error in L2.
    pub l2: f64,
    /// Relative error in the H1 seminorm.
    pub h1: f64,
}

/// Value and gradient of a known solution.
fn jet(exact: &Formula, x: DVec2) -> Jet {
    let gradient = exact.gradient(&[x.x, x.y]);
    Jet { value: value(exact, x), gradient: DVec2::new(gradient[0], gradient[1]) }
}

/// Solves the problem of the known solution with four grid widths; those that are too fine for the window are left out.
///
/// # Errors
///
/// `NoExact`, `NotZero`; those of [`crate::figure::elements::solve`] if not even one width can be done.
pub fn error_study(membrane: &Membrane, watcher: &dyn Watcher) -> Result<ErrorStudy, SolveError> {
    let setting = membrane.setting();
    let exact = setting.exact.as_ref().ok_or(SolveError::NoExact)?;
    let load = |x: DVec2| {
        let second = |variable| exact.derivatives(&[x.x, x.y], variable, 2)[2];
        setting.reaction * value(exact, x) - setting.diffusion * (second(0) + second(1))
    };
    let form = form_of(membrane, &load);
    let (mut rows, mut note) = (Vec::new(), None);
    for step in 0..ROWS {
        // Each line costs about four times the one before.
        let share = |step: usize| (4f64.powi(step as i32) - 1.0) / (4f64.powi(ROWS as i32) - 1.0);
        let part = Part { whole: watcher, from: share(step), to: share(step + 1) };
        let factor = 1 << step;
        let row = match &setting.region {
            Region::Parts { width, .. } => {
                let width = width / f64::from(factor);
                discretisation(membrane, width).and_then(|discretisation| {
                    let domain = membrane.domain().ok_or(SolveError::NoParts)?;
                    let problem = Problem { domain: &domain, weight: Weight::OfDomain(domain.clone()), form };
                    weighted_row(&problem, &discretisation, exact, &part)
                })
            }
            Region::Patch { patch, divisions, .. } => {
                let divisions = divisions * factor as usize;
                check_patch_size(membrane, divisions).and_then(|()| {
                    check_zero(exact, &membrane.fixed_sides(), patch)?;
                    let space = IsogeometricSpace::refined(
                        patch,
                        setting.degree,
                        [divisions; 2],
                        &membrane.fixed_sides(),
                    )?;
                    let free: Vec<PatchSide> =
                        PatchSide::ALL.into_iter().filter(|side| !space.is_fixed(*side)).collect();
                    let fluxes: Vec<_> = free
                        .iter()
                        .map(|&side| move |x: DVec2| setting.diffusion * slope_across(patch, side, exact, x))
                        .collect();
                    let fluxes: Vec<SideFlux<'_>> =
                        free.iter().zip(&fluxes).map(|(&side, flux)| SideFlux { side, flux }).collect();
                    let solution = solve_patch(space, &form, &fluxes, &part)?;
                    let norms = solution.error_norms(|x| jet(exact, x))?;
                    Ok(line(1.0 / divisions as f64, solution.space().dimension(), &norms))
                })
            }
            Region::Channel { .. } => return Err(SolveError::NoExact),
        };
        match row {
            Ok(row) => rows.push(row),
            Err(error @ SolveError::TooLarge { .. }) if !rows.is_empty() => {
                note = Some(error.to_string());
                break;
            }
            Err(error) => return Err(error),
        }
    }
    let widths: Vec<f64> = rows.iter().map(|row| row.width).collect();
    let rates =
        |of: fn(&StudyLine) -> f64| convergence_rates(&widths, &rows.iter().map(of).collect::<Vec<_>>());
    let (l2_rates, h1_rates) = (rates(|row| row.l2), rates(|row| row.h1));
    Ok(ErrorStudy { l2_rates, h1_rates, rows, note })
}

fn line(width: f64, unknowns: usize, norms: &ErrorNorms) -> StudyLine {
    StudyLine { width, unknowns, l2: norms.relative_l2(), h1: norms.relative_h1_seminorm() }
}

fn weighted_row(
    problem: &Problem<'_>,
    discretisation: &Discretisation,
    exact: &Formula,
    watcher: &dyn Watcher,
) -> Result<StudyLine, SolveError> {
    let solution = solve_problem(problem, discretisation, None, watcher)?;
    let mut largest: f64 = 0.0;
    solution.space.table().for_each_point(|p| largest = largest.max(value(exact, p.point).abs()));
    for &point in solution.space.table().boundary() {
        let value = value(exact, point);
        if value.abs() > ZERO * largest {
            return Err(SolveError::NotZero { point, value });
        }
    }
    let norms = solution.errors(&|x| jet(exact, x))?;
    Ok(line(discretisation.width, solution.unknowns(), &norms))
}

/// `NotZero` unless the known solution vanishes on the fixed sides.
fn check_zero(exact: &Formula, fixed: &[PatchSide], patch: &PlanePatch) -> Result<(), SolveError> {
    let [low, high] = patch.parameter_rectangle();
    let at = |s: f64, t: f64| patch.evaluate(low + (high - low) * DVec2::new(s, t));
    let steps = || (0..=8).map(|i| f64::from(i) / 8.0);
    let mut largest: f64 = 0.0;
    for (s, t) in steps().flat_map(|s| steps().map(move |t| (s, t))) {
        largest = largest.max(value(exact, at(s, t)?).abs());
    }
    for side in fixed {
        let along = 1 - side.axis();
        for s in steps() {
            let t = patch.side_parameter(*side, low[along] + (high - low)[along] * s);
            let point = patch.evaluate(t)?;
            let value = value(exact, point);
            if value.abs() > ZERO * largest {
                return Err(SolveError::NotZero { point, value });
            }
        }
    }
    Ok(())
}

/// The slope of a known solution across a side, outward; not a number where the side cannot be found.
fn slope_across(patch: &PlanePatch, side: PatchSide, exact: &Formula, x: DVec2) -> f64 {
    let Some(Ok(geometry)) = patch.invert(x).map(|t| patch.jet(t)) else { return f64::NAN };
    let normal = geometry.tangents[1 - side.axis()].perp().normalize_or_zero();
    let outward = if side.at_end() { 1.0 } else { -1.0 } * normal.dot(geometry.tangents[side.axis()]);
    jet(exact, x).gradient.dot(normal) * outward.signum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::progress::Unwatched;
    use crate::document::{MembranePreset, read_formula};

    #[test]
    fn measured_rates_are_those_of_the_theory() {
        for preset in [MembranePreset::Disc, MembranePreset::QuarterAnnulus] {
            let study = error_study(&preset.membrane(), &Unwatched).unwrap();
            assert_eq!(study.rows.len(), 4, "{}: {:?}", preset.title(), study.note);
            let (l2, h1) = (study.l2_rates[2], study.h1_rates[2]);
            assert!((l2 - 3.0).abs() < 0.25 && (h1 - 2.0).abs() < 0.2, "{}: {l2}, {h1}", preset.title());
        }
    }

    #[test]
    fn sides_that_are_not_fixed_get_the_flux_of_the_solution() {
        // u = x vanishes on the fixed side of the course's patch and lies in the space: no error.
        let membrane = MembranePreset::BookPatch.membrane();
        let membrane = membrane
            .with(|setting| {
                setting.exact = Some(read_formula("x", "solution").unwrap());
                if let Region::Patch { divisions, .. } = &mut setting.region {
                    *divisions = 2;
                }
            })
            .unwrap();
        let study = error_study(&membrane, &Unwatched).unwrap();
        assert!(study.rows.iter().all(|row| row.l2 < 1e-9), "{:?}", study.rows);
    }

    #[test]
    fn a_solution_that_does_not_vanish_on_the_boundary_is_refused() {
        for preset in [MembranePreset::Disc, MembranePreset::BookPatch] {
            let membrane = preset.membrane();
            let wrong =
                membrane.with(|s| s.exact = Some(read_formula("1 + x^2", "solution").unwrap())).unwrap();
            let error = error_study(&wrong, &Unwatched).unwrap_err();
            assert!(matches!(error, SolveError::NotZero { .. }), "{}: {error}", preset.title());
        }
        let none = error_study(&MembranePreset::Mushroom.membrane(), &Unwatched).unwrap_err();
        assert_eq!(none, SolveError::NoExact, "no solution is known");
    }
}
