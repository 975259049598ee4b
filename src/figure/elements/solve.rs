//! Solving the boundary value problem of a document: what the canvas and the exporters need of the solution.

use glam::{DMat2, DVec2};
use thiserror::Error;

use crate::core::domain::{CellClass, Jet};
use crate::core::finite_element::{
    Coefficient, Discretisation, EllipticForm, FiniteElementError, IsogeometricSolution, IsogeometricSpace,
    PotentialFlow, Problem, Weight, WeightedSolution, WeightedSystem, solve_patch,
};
use crate::core::formula::Formula;
use crate::core::progress::{Part, Watcher};
use crate::document::{Membrane, Region};
use crate::figure::elements::sampling::{Samples, of_patch, of_weighted};

/// The most B-splines of a problem of the window.
pub const MAX_FUNCTIONS: usize = 90_000;

/// Tolerance of stream lines: small, so that their points are close enough for a polyline to look smooth.
const STREAM_TOLERANCE: f64 = 1e-9;

/// Why a problem has no solution to show.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SolveError {
    /// The domain has no parts.
    #[error("The domain has no parts yet")]
    NoParts,
    /// The domain is not bounded.
    #[error("The domain is unbounded; intersect it with a disc, an ellipse, a rectangle or a polygon")]
    Unbounded,
    /// Nothing is left of the domain.
    #[error("The domain is empty")]
    Empty,
    /// There would be too many functions.
    #[error("{value} B-splines are above the limit {MAX_FUNCTIONS}; take a larger grid width")]
    TooLarge {
        /// Their number.
        value: f64,
    },
    /// The known solution does not vanish where it must.
    #[error("The known solution is {value} at ({}, {}), where it must be 0", point.x, point.y)]
    NotZero {
        /// Where.
        point: DVec2,
        /// Its value there.
        value: f64,
    },
    /// No solution is known.
    #[error("Type a known solution first")]
    NoExact,
    /// The numbers went wrong.
    #[error("{}", sentence(.0))]
    Element(#[from] FiniteElementError),
}

impl SolveError {
    /// Whether the work was stopped by its watcher.
    pub fn is_stopped(&self) -> bool {
        matches!(self, Self::Element(FiniteElementError::Stopped(_)))
    }
}

fn sentence(error: &FiniteElementError) -> String {
    let text = error.to_string();
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    first + letters.as_str()
}

/// A solution of one of the kinds.
#[derive(Clone, Debug)]
pub enum Solution {
    /// With weighted B-splines.
    Weighted(WeightedSolution),
    /// With isogeometric elements.
    Patch(IsogeometricSolution),
    /// A potential flow.
    Flow(PotentialFlow),
}

/// A solved problem.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The solution.
    pub solution: Solution,
    /// It as triangles.
    pub samples: Samples,
    /// It in numbers.
    pub facts: Facts,
}

/// A solution in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Numbers of inner and cut cells; of a patch its cells and 0.
    pub cells: [usize; 2],
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub greatest: f64,
    /// Where it is taken, as far as the samples know.
    pub greatest_at: DVec2,
    /// Greatest length of the gradient.
    pub steepest: f64,
    /// `∫ u`.
    pub integral: f64,
    /// `a(u, u)`.
    pub energy: f64,
    /// Steps of conjugate gradients.
    pub steps: usize,
    /// Norm of the last residual relative to the first.
    pub residual: f64,
}

impl Solved {
    /// Value and gradient at a point; `None` outside. Of a flow the potential.
    pub fn evaluate(&self, x: DVec2) -> Option<Jet> {
        let of_patch = |solution: &IsogeometricSolution| {
            solution.jet_at(x).map(|jet| Jet { value: jet.value, gradient: jet.gradient })
        };
        match &self.solution {
            Solution::Weighted(solution) => solution.evaluate(x),
            Solution::Patch(solution) => of_patch(solution),
            Solution::Flow(flow) => of_patch(flow.potential()),
        }
    }

    /// The isogeometric solution, of a flow its potential.
    pub fn on_patch(&self) -> Option<&IsogeometricSolution> {
        match &self.solution {
            Solution::Weighted(_) => None,
            Solution::Patch(solution) => Some(solution),
            Solution::Flow(flow) => Some(flow.potential()),
        }
    }

    /// `count` stream lines of a flow, from equally spaced points of the left side; none of another problem.
    pub fn stream_lines(&self, count: usize) -> Vec<Vec<DVec2>> {
        let Solution::Flow(flow) = &self.solution else { return Vec::new() };
        let patch = flow.potential().space().patch();
        let [low, high] = patch.parameter_rectangle();
        let line = |k: usize| {
            let t = DVec2::new(low.x, low.y + (high.y - low.y) * (k as f64 + 0.5) / count as f64);
            let line = flow.stream_line(patch.evaluate(t).ok()?, STREAM_TOLERANCE).ok()?;
            Some(line.points.iter().map(|point| point.point).collect())
        };
        (0..count).filter_map(line).collect()
    }
}

/// The value of a formula in x and y.
pub(super) fn value(formula: &Formula, x: DVec2) -> f64 {
    formula.value(&[x.x, x.y])
}

/// The form of the problem with this load.
pub(super) fn form_of<'a>(membrane: &Membrane, load: &'a (dyn Fn(DVec2) -> f64 + Sync)) -> EllipticForm<'a> {
    let setting = membrane.setting();
    EllipticForm {
        diffusion: Coefficient::Constant(DMat2::from_diagonal(DVec2::splat(setting.diffusion))),
        reaction: Coefficient::Constant(setting.reaction),
        ..EllipticForm::poisson(Coefficient::Function(load))
    }
}

/// The discretisation of a domain of primitives with grid width `width`.
pub(super) fn discretisation(membrane: &Membrane, width: f64) -> Result<Discretisation, SolveError> {
    let bounds = membrane.domain_bounds();
    if membrane.parts().is_empty() {
        return Err(SolveError::NoParts);
    }
    // An empty box has infinite sides too.
    let extent = bounds.size().min_element();
    if extent.is_nan() || extent <= 0.0 {
        return Err(SolveError::Empty);
    }
    if !bounds.is_finite() {
        return Err(SolveError::Unbounded);
    }
    let degree = membrane.setting().degree;
    let value = ((bounds.size() / width).ceil() + degree as f64).element_product();
    if value.is_nan() || value > MAX_FUNCTIONS as f64 {
        return Err(SolveError::TooLarge { value });
    }
    Ok(Discretisation { bounds: Some(bounds), ..Discretisation::new(degree, width) })
}

/// Whether a patch is divided so finely that there are too many functions.
pub(super) fn check_patch_size(membrane: &Membrane, divisions: usize) -> Result<(), SolveError> {
    let degree = membrane.setting().degree;
    let size = |axis: usize| {
        membrane.patch().map_or(0, |patch| patch.spaces()[axis].breaks().len() * degree * divisions) as f64
    };
    let value = size(0) * size(1);
    if value <= 4.0 * (MAX_FUNCTIONS * degree * degree) as f64 {
        Ok(())
    } else {
        Err(SolveError::TooLarge { value })
    }
}

/// Solves the problem.
///
/// # Errors
///
/// [`SolveError`], among them `Element` with `Stopped` when `watcher` wants to stop.
pub fn solve(membrane: &Membrane, watcher: &dyn Watcher) -> Result<Solved, SolveError> {
    let setting = membrane.setting();
    let load = |x: DVec2| value(&setting.load, x);
    let form = form_of(membrane, &load);
    let (solution, samples, energy) = match &setting.region {
        Region::Parts { width, .. } => {
            let domain = membrane.domain().ok_or(SolveError::NoParts)?;
            let discretisation = discretisation(membrane, *width)?;
            let problem = Problem { domain: &domain, weight: Weight::OfDomain(domain.clone()), form };
            let part = |from, to| Part { whole: watcher, from, to };
            let system = match WeightedSystem::assemble(&problem, &discretisation, &part(0.0, 0.5)) {
                Err(FiniteElementError::EmptyDomain) => return Err(SolveError::Empty),
                other => other?,
            };
            let right_side = system.system.load.clone();
            let solved = system.solve(discretisation.basis, discretisation.method, None, &part(0.5, 0.9))?;
            // With u = 0 on the boundary a(u, u) = λ(u).
            let energy = right_side.iter().zip(&solved.coefficients).map(|(f, u)| f * u).sum();
            let samples = of_weighted(&solved);
            (Solution::Weighted(solved), samples, energy)
        }
        Region::Patch { patch, divisions, .. } => {
            check_patch_size(membrane, *divisions)?;
            let space =
                IsogeometricSpace::refined(patch, setting.degree, [*divisions; 2], &membrane.fixed_sides())?;
            let solved = solve_patch(space, &form, &[], watcher)?;
            let (samples, energy) = (of_patch(&solved)?, solved.energy());
            (Solution::Patch(solved), samples, energy)
        }
        Region::Channel { patch, inflow, divisions } => {
            check_patch_size(membrane, *divisions)?;
            let flow = PotentialFlow::solve(patch, setting.degree, [*divisions; 2], *inflow, None, watcher)?;
            let (samples, energy) = (of_patch(flow.potential())?, flow.potential().energy());
            (Solution::Flow(flow), samples, energy)
        }
    };
    watcher.check(1.0).map_err(FiniteElementError::from)?;
    let facts = facts(&solution, &samples, energy)?;
    Ok(Solved { solution, samples, facts })
}

fn facts(solution: &Solution, samples: &Samples, energy: f64) -> Result<Facts, SolveError> {
    let (unknowns, cells, integral, residuals) = match solution {
        Solution::Weighted(solution) => {
            let classes = solution.space.table().classes();
            let count = |class: CellClass| classes.iter().filter(|found| **found == class).count();
            let cells = [count(CellClass::Inner), count(CellClass::Cut)];
            (solution.unknowns(), cells, solution.integral()?, &solution.residuals[..])
        }
        Solution::Patch(_) | Solution::Flow(_) => {
            let solution = match solution {
                Solution::Patch(solution) => solution,
                Solution::Flow(flow) => flow.potential(),
                Solution::Weighted(_) => return Err(SolveError::Empty),
            };
            let cells = solution.space().spaces().each_ref().map(|space| space.breaks().len() - 1);
            let cells = [cells[0] * cells[1], 0];
            (solution.space().dimension(), cells, solution.integral()?, solution.residuals())
        }
    };
    let mut facts = Facts {
        unknowns,
        cells,
        least: f64::INFINITY,
        greatest: f64::NEG_INFINITY,
        greatest_at: DVec2::NAN,
        steepest: samples.slopes.iter().copied().fold(0.0, f64::max),
        integral,
        energy,
        steps: residuals.len().saturating_sub(1),
        residual: match (residuals.first(), residuals.last()) {
            (Some(first), Some(last)) if *first > 0.0 => last / first,
            _ => 0.0,
        },
    };
    for (&value, &at) in samples.values.iter().zip(&samples.points) {
        facts.least = facts.least.min(value);
        if value > facts.greatest {
            (facts.greatest, facts.greatest_at) = (value, at);
        }
    }
    Ok(facts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::progress::Unwatched;
    use crate::document::MembranePreset;

    fn area(samples: &Samples) -> f64 {
        let at = |vertex: u32| samples.points[vertex as usize];
        let triangle = |t: &[u32; 3]| 0.5 * (at(t[1]) - at(t[0])).perp_dot(at(t[2]) - at(t[0]));
        samples.triangles.iter().map(triangle).sum()
    }

    #[test]
    fn every_preset_is_solved_and_sampled_on_its_whole_region() {
        use std::f64::consts::PI;
        let areas = [3.0 * PI, PI, PI * (1.5 * 1.5 - 0.6 * 0.6), 3.0, 14.0 / 3.0, 0.75 * PI, 239.1];
        for (preset, expected) in MembranePreset::ALL.into_iter().zip(areas) {
            let solved = solve(&preset.membrane(), &Unwatched).unwrap();
            let found = area(&solved.samples);
            assert!((found / expected - 1.0).abs() < 4e-3, "{}: area {found}", preset.title());
            assert!(!solved.samples.outline.is_empty(), "{}: an outline", preset.title());
            let at = solved.facts.greatest_at;
            let greatest = solved.evaluate(at).map(|jet| jet.value);
            assert!(
                greatest.is_some_and(|value| (value - solved.facts.greatest).abs() < 1e-6),
                "{}: {greatest:?} at {at}",
                preset.title()
            );
        }
    }

    #[test]
    fn the_disc_under_constant_load_has_its_closed_form() {
        // u = 1 − r², ∫ u = π/2, a(u, u) = 2π.
        let solved = solve(&MembranePreset::Disc.membrane(), &Unwatched).unwrap();
        let facts = solved.facts;
        assert!((facts.greatest - 1.0).abs() < 1e-8, "greatest {}", facts.greatest);
        assert!((facts.integral - std::f64::consts::FRAC_PI_2).abs() < 1e-7, "integral {}", facts.integral);
        assert!((facts.energy - std::f64::consts::TAU).abs() < 1e-6, "energy {}", facts.energy);
        assert!((facts.steepest - 2.0).abs() < 1e-3, "steepest {}", facts.steepest);
        assert_eq!(facts.unknowns, 96, "relevant B-splines of example 9.2-d");
    }

    #[test]
    fn stream_lines_of_the_channel_leave_as_high_as_they_enter() {
        let solved = solve(&MembranePreset::Channel.membrane(), &Unwatched).unwrap();
        let lines = solved.stream_lines(4);
        assert_eq!(lines.len(), 4, "all four");
        for line in lines {
            let (start, end) = (line[0], line[line.len() - 1]);
            assert!((end.x - 33.0).abs() < 1e-9, "it leaves at the right: {end}");
            // As exact as the coarse grid of the preset lets the flow be.
            assert!((start.y - 10.0 - end.y).abs() < 0.05, "from {start} to {end}");
        }
    }

    #[test]
    fn what_cannot_be_solved_says_why() {
        let mushroom = MembranePreset::Mushroom.membrane();
        let why = |membrane: Membrane| solve(&membrane, &Unwatched).unwrap_err();
        assert_eq!(why(mushroom.with_parts(Vec::clear).unwrap()), SolveError::NoParts, "nothing");
        let half = mushroom.with_parts(|parts| *parts = vec![parts[1].clone()]).unwrap();
        assert_eq!(why(half), SolveError::Unbounded, "a half plane");
        let fine = mushroom
            .with(|setting| {
                if let Region::Parts { width, .. } = &mut setting.region {
                    *width = 1e-6;
                }
            })
            .unwrap();
        assert!(matches!(why(fine), SolveError::TooLarge { .. }), "a million cells a side");
        let stopped = solve(&mushroom, &|_: f64| false).unwrap_err();
        assert!(stopped.is_stopped(), "{stopped}");
    }
}
