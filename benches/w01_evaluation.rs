//! W1 and W2: points, and points with two derivatives, of a cubic curve of the plane with 1000 control points and nonuniform knots.
//!
//! Reads `PEERS_HOME/data/c_knots.f64`, `c_ctrl.f64`, `u_sorted.f64`, `u_random.f64` (raw f64); without them, data of the same
//! shape. One JSON line per measurement.

mod report;

use std::hint::black_box;

use glam::DVec2;
use report::{curve, load, measure};
use spline_lab::core::bspline::PowerForm;

fn main() {
    let curve = curve();
    let sorted =
        load("u_sorted").unwrap_or_else(|| (0..1_000_000).map(|i| f64::from(i) / 999_999.0).collect());
    let random = load("u_random").unwrap_or_else(|| {
        (0..sorted.len()).map(|i| sorted[i.wrapping_mul(2_654_435_761) % sorted.len()]).collect()
    });
    let form = PowerForm::new(&curve);
    let mut points = vec![DVec2::ZERO; sorted.len()];
    let fine = "all parameters lie in D";
    measure("W1-sorted", sorted.len(), "PowerForm::evaluate_into, the form made before", || {
        form.evaluate_into(&sorted, &mut points).expect(fine);
    });
    measure("W1-sorted", sorted.len(), "Spline::evaluate_into, nothing prepared", || {
        curve.evaluate_into(&sorted, &mut points).expect(fine);
    });
    measure("W1-sorted", sorted.len(), "Spline::evaluate, one by one", || {
        for (point, &u) in points.iter_mut().zip(&sorted) {
            *point = curve.evaluate(u).expect(fine);
        }
    });
    measure("W1-random", random.len(), "PowerForm::evaluate_into, the form made before", || {
        form.evaluate_into(&random, &mut points).expect(fine);
    });
    measure("W1-random", random.len(), "Spline::evaluate_into, nothing prepared", || {
        curve.evaluate_into(&random, &mut points).expect(fine);
    });
    measure("W1-prepare", 997, "PowerForm::new", || {
        black_box(PowerForm::new(&curve));
    });
    let some: Vec<f64> = sorted.iter().copied().step_by(10).collect();
    let mut jets = vec![[DVec2::ZERO; 3]; some.len()];
    measure("W2-d2", some.len(), "PowerForm::derivatives_into, the form made before", || {
        form.derivatives_into(&some, &mut jets).expect(fine);
    });
}
