//! Weighted B-splines on a domain with a curved boundary that is being dragged: an ellipse with a moving round
//! hole, 40 × 40 cells of degree 2.
//!
//! One JSON line for each measurement: the whole solution after a move (cells, quadrature, matrix, solution),
//! its parts, and a new load in the old domain. `cpu_…` is not measured and repeats the wall time.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a measurement prints, and stops at the first surprise"
)]

use std::time::Instant;

use glam::DVec2;
use spline_lab::core::domain::{Bounds, Domain};
use spline_lab::core::finite_element::{
    Coefficient, Discretisation, EllipticForm, Problem, Weight, WeightedSpace, WeightedSystem, solve_problem,
};
use spline_lab::core::progress::Unwatched;
use spline_lab::document::{MembraneDisplay, MembranePreset, Region};
use spline_lab::figure::elements::{field, solve};
use spline_lab::figure::theme::Theme;

fn main() {
    let load = |x: DVec2| (3.0 * x.x).sin() + x.y;
    let form = EllipticForm::poisson(Coefficient::Function(&load));
    for (degree, cells) in [(1, 40), (2, 40), (3, 40), (2, 80), (3, 80), (5, 40)] {
        let width = 2.0 / cells as f64;
        let settings = Discretisation {
            bounds: Some(Bounds::new(DVec2::splat(-1.0), DVec2::ONE)),
            ..Discretisation::new(degree, width)
        };
        let mut step = 0;
        let mut moved = || {
            step += 1;
            domain(0.002 * f64::from(step))
        };
        let first = domain(0.0);
        let solution = solve_problem(&problem(&first, form), &settings, None, &Unwatched).unwrap();
        let unknowns = solution.unknowns();
        let line = |what: &str, how: &str, times: Vec<f64>| {
            let (min, median) = (times[0], times[times.len() / 2]);
            println!(
                "{{\"workload\": \"W10-weighted-{what} p={degree} {cells}x{cells}\", \"peer\": \"spline-lab\", \"n\": {unknowns}, \
                 \"median_s\": {median}, \"min_s\": {min}, \"cpu_median_s\": {median}, \"cpu_min_s\": {min}, \"reps\": {}, \
                 \"threads\": {}, \"how\": \"{how}\", \"items_per_s\": {}}}",
                times.len(),
                rayon::current_num_threads(),
                unknowns as f64 / median,
            );
        };
        let warm = &solution.coefficients;
        let whole = times(|| {
            let domain = moved();
            solve_problem(&problem(&domain, form), &settings, Some(warm), &Unwatched).unwrap();
        });
        line("resolve", "moved domain: cells, quadrature, assembly, conjugate gradients to 1e-10", whole);
        let grid = settings.grid(&first).unwrap();
        let space = || {
            let weight = Weight::OfDomain(first.clone());
            WeightedSpace::new(first.clone(), weight, grid, degree, settings.gauss_points, &Unwatched)
                .unwrap()
        };
        line("quadrature", "classes of cells, nodes of cut cells", times(|| drop(space())));
        let kept = space();
        let assemble = || WeightedSystem::in_space(kept.clone(), &form, &Unwatched).unwrap();
        line("assemble", "matrix and load, n + 3 Gauss points", times(|| drop(assemble())));
        let system = assemble();
        let solve = |start| {
            let system = system.clone();
            times(move || {
                drop(system.clone().solve(settings.basis, settings.method, start, &Unwatched).unwrap());
            })
        };
        line("solve", "conjugate gradients with the diagonal, 1e-10, from zero", solve(None));
    }
    as_in_the_window();
}

/// What one move of the hand costs in the window: the solution, its samples, colours and isolines, for a disc of 40 × 40 cells of
/// degree 2 with a hole that moves.
fn as_in_the_window() {
    let problem = MembranePreset::Ring.membrane();
    let display = MembraneDisplay::default();
    let theme = Theme::light();
    let mut step = 0;
    let (mut unknowns, mut lines) = (0, 0);
    let found = times(|| {
        step += 1;
        let moved = problem
            .with(|setting| {
                if let Region::Parts { parts, width } = &mut setting.region {
                    let (low, high) = problem.bounding_box().unwrap();
                    *width = (high - low).max_element() / 40.0;
                    let last = parts.last_mut().unwrap();
                    last.shape = last.shape.with_handle(0, DVec2::new(0.3 - 0.002 * f64::from(step), 0.1));
                }
            })
            .unwrap();
        let solved = solve(&moved, &Unwatched).unwrap();
        lines = field(&solved, &display, &theme).len();
        unknowns = solved.facts.unknowns;
    });
    let median = found[found.len() / 2];
    println!(
        "{{\"workload\": \"window-resolve p=2 40x40\", \"peer\": \"spline-lab\", \"n\": {unknowns}, \"median_s\": {median}, \
         \"min_s\": {}, \"cpu_median_s\": {median}, \"cpu_min_s\": {}, \"reps\": {}, \"threads\": {}, \
         \"how\": \"solution after a move, samples, colours, isolines: {lines} layers\", \"items_per_s\": {}}}",
        found[0],
        found[0],
        found.len(),
        rayon::current_num_threads(),
        unknowns as f64 / median,
    );
}

fn problem<'a>(domain: &'a Domain, form: EllipticForm<'a>) -> Problem<'a> {
    Problem { domain, weight: Weight::OfDomain(domain.clone()), form }
}

/// An ellipse without a disc, whose centre depends on `shift`.
fn domain(shift: f64) -> Domain {
    let ellipse = Domain::ellipse(DVec2::ZERO, DVec2::new(0.98, 0.8), 0.2).unwrap();
    ellipse.difference(Domain::disc(DVec2::new(0.3 - shift, 0.1), 0.25).unwrap())
}

/// Increasing times of some runs after one to warm up, in seconds.
fn times(mut run: impl FnMut()) -> Vec<f64> {
    run();
    let mut times: Vec<f64> = (0..9)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times
}
