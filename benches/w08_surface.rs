//! W8: a bicubic surface with 50 × 50 control points on 1000 × 1000 parameters, points and unit normals; polynomial and rational.
//!
//! Reads `s_uknots.f64`, `s_vknots.f64`, `s_ctrl.f64`, `s_wts.f64` (little-endian `f64`) from `$PEERS_HOME/data`, else makes data of the same shape.

#![allow(clippy::unwrap_used, reason = "a benchmark stops at the first surprise")]

mod report;

use glam::DVec3;
use report::load;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::surface::NurbsSurface;
use spline_lab::core::tensor::TensorSplineSpace;

fn main() {
    let (u, v) = (knots("s_uknots", 1), knots("s_vknots", 2));
    let space = TensorSplineSpace::new([u, v]).unwrap();
    let at = |i: usize| i as f64 / 49.0;
    let height = |i: usize, j: usize| 0.2 * (7.0 * at(i)).sin() * (5.0 * at(j)).cos();
    let flat = load("s_ctrl").unwrap_or_else(|| {
        (0..2500).flat_map(|k| [at(k / 50), at(k % 50), height(k / 50, k % 50)]).collect()
    });
    let points: Vec<DVec3> = flat.chunks_exact(3).map(DVec3::from_slice).collect();
    let weights =
        load("s_wts").unwrap_or_else(|| (0..2500).map(|k| 0.5 + f64::from(k * 37 % 101) / 101.0).collect());
    let parameters: Vec<f64> = (0..1000).map(|i| f64::from(i) / 999.0).collect();
    let (mut places, mut normals) = (vec![DVec3::ZERO; 1_000_000], vec![DVec3::ZERO; 1_000_000]);
    let polynomial = NurbsSurface::polynomial(space.clone(), points.clone()).unwrap();
    let rational = NurbsSurface::new(space, points, weights).unwrap();
    for (workload, surface) in [("W8-bspline", polynomial), ("W8-nurbs", rational)] {
        report::measure(workload, 1_000_000, "evaluate_grid, buffers preallocated", || {
            surface.evaluate_grid(&parameters, &parameters, &mut places, &mut normals).unwrap();
        });
        let mut error = 0.0_f64;
        for k in (0..1_000_000).step_by(9_973) {
            let at = [parameters[k / 1000], parameters[k % 1000]];
            error = error.max(surface.evaluate(at).unwrap().distance(places[k]));
            error = error.max(surface.normal(at).unwrap().distance(normals[k]));
        }
        report::check(workload, &format!("\"max_difference_to_single_points\": {error:e}"));
    }
}

/// Knots for 50 cubic B-splines, 4-fold at both ends.
fn knots(name: &str, seed: u64) -> SplineSpace {
    let made = || {
        let mut state = seed;
        let mut breaks = vec![0.0];
        for i in 0..47 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            breaks.push(breaks[i] + 0.2 + 1.6 * (state >> 40) as f64 / f64::from(1 << 24));
        }
        let last = breaks[47];
        [vec![0.0; 3], breaks.iter().map(|b| b / last).collect(), vec![1.0; 3]].concat()
    };
    SplineSpace::from_either_convention(3, load(name).unwrap_or_else(made)).unwrap()
}
