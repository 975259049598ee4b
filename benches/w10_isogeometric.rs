//! Poisson's problem with zero boundary values on a quarter annulus and on the unit square, one thread.
//!
//! Assembly of stiffness and load with `n + 1` Gauss points, and solution (eigenproblems of the preconditioner and
//! conjugate gradients), are timed apart. One JSON line for each measurement; `cpu_…` is the processor time of the
//! process (0 where the system does not tell).

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a measurement prints, and stops at the first surprise"
)]

use std::f64::consts::PI;
use std::time::Instant;

use glam::DVec2;
use spline_lab::core::finite_element::{
    Coefficient, EllipticForm, IsogeometricSpace, IsogeometricSystem, Jet, PatchSide, sample_geometries,
};
use spline_lab::core::progress::Unwatched;

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().unwrap();
    let annulus = sample_geometries::quarter_annulus(1.0, 2.0).unwrap();
    let square = sample_geometries::unit_square();
    for (domain, patch) in [("annulus", &annulus), ("square", &square)] {
        let round = domain == "annulus";
        let load = move |x: DVec2| {
            if round {
                -x.x * x.y * (32.0 * x.length_squared() - 60.0)
            } else {
                2.0 * PI * PI * (PI * x.x).sin() * (PI * x.y).sin()
            }
        };
        let exact = move |x: DVec2| {
            let r = x.length_squared();
            let value =
                if round { x.x * x.y * (r - 1.0) * (r - 4.0) } else { (PI * x.x).sin() * (PI * x.y).sin() };
            Jet { value, gradient: DVec2::ZERO }
        };
        let form = EllipticForm::poisson(Coefficient::Function(&load));
        for (cells, degree) in [(64, 1), (64, 2), (64, 3), (64, 4), (64, 5), (256, 3)] {
            let space = || {
                IsogeometricSpace::refined(patch, degree, [cells; 2], &PatchSide::ALL)
                    .and_then(|space| space.with_gauss_points([degree + 1; 2]))
                    .unwrap()
            };
            let unknowns = space().dimension();
            let info = format!("\"p\": {degree}, \"grid\": {cells}");
            let how = "stiffness and load, sum factorisation, n + 1 Gauss points";
            let system = measure(&format!("W10-{domain}-assemble"), unknowns, how, &info, space, |space| {
                IsogeometricSystem::assemble(space, &form, &[], &Unwatched).unwrap()
            });
            let solution = {
                let solution = system.clone().solve(&Unwatched).unwrap();
                let error = solution.error_norms(exact).unwrap().l2;
                let steps = solution.residuals().len() - 1;
                let info = format!("{info}, \"L2err\": {error:e}, \"steps\": {steps}");
                let how = "fast diagonalisation, then conjugate gradients to 1e-12";
                let workload = format!("W10-{domain}-solve");
                measure(
                    &workload,
                    unknowns,
                    how,
                    &info,
                    || system.clone(),
                    |system| system.solve(&Unwatched).unwrap(),
                )
            };
            assert_eq!(solution.space().dimension(), unknowns, "nothing was optimised away");
        }
    }
}

/// Times `run` on what `set_up` gives, after one warm-up; prints the line and returns the last result.
fn measure<S, R>(
    workload: &str,
    n: usize,
    how: &str,
    info: &str,
    set_up: impl Fn() -> S,
    run: impl Fn(S) -> R,
) -> R {
    let mut result = run(set_up());
    let (mut wall, mut processor) = (Vec::new(), Vec::new());
    let begin = Instant::now();
    while wall.len() < 5 || (wall.len() < 25 && begin.elapsed().as_secs_f64() < 1.0) {
        let input = set_up();
        let (cpu, start) = (processor_seconds(), Instant::now());
        result = run(input);
        wall.push(start.elapsed().as_secs_f64());
        processor.push(processor_seconds() - cpu);
    }
    wall.sort_by(f64::total_cmp);
    processor.sort_by(f64::total_cmp);
    let (median, cpu) = (wall[wall.len() / 2], processor[processor.len() / 2]);
    println!(
        "{{\"workload\": \"{workload}\", \"peer\": \"Spline Lab\", \"n\": {n}, \"median_s\": {median:.3e}, \"min_s\": {:.3e}, \
         \"cpu_median_s\": {cpu:.3e}, \"cpu_min_s\": {:.3e}, \"reps\": {}, \"threads\": 1, \"how\": \"{how}\", \
         \"items_per_s\": {:.3e}, {info}}}",
        wall[0],
        processor[0],
        wall.len(),
        n as f64 / median,
    );
    result
}

/// Processor time of all threads.
fn processor_seconds() -> f64 {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else { return 0.0 };
    let of_task = |task: std::io::Result<std::fs::DirEntry>| -> Option<f64> {
        let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse().ok()
    };
    tasks.filter_map(of_task).sum::<f64>() * 1e-9
}
