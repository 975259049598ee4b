//! W1 and W2: points, and points with two derivatives, of a cubic curve of the plane with 1000 control points and nonuniform knots.
//!
//! Reads `PEERS_HOME/data/c_knots.f64`, `c_ctrl.f64`, `u_sorted.f64`, `u_random.f64` (raw f64); without them, data of the same
//! shape. One JSON line per measurement.

mod report;

use std::hint::black_box;

use glam::DVec2;
use report::{load, measure};
use spline_lab::core::bspline::{EndKnots, PowerForm, Spline, SplineSpace};

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

fn curve() -> Spline<DVec2> {
    let points: Vec<DVec2> = match load("c_ctrl") {
        Some(numbers) => numbers.chunks_exact(2).map(DVec2::from_slice).collect(),
        None => (0..1000)
            .map(|k| 0.012 * f64::from(k))
            .map(|s| DVec2::new(s.cos(), s.sin()) * (0.3 + 0.01 * s))
            .collect(),
    };
    let space = match load("c_knots") {
        // These end-knots are 4-fold less one, as everywhere else.
        Some(knots) => {
            let (left, right) = (knots[0] - 1.0, knots[knots.len() - 1] + 1.0);
            let inner = &knots[1..knots.len() - 1];
            SplineSpace::new(3, [&[left], inner, &[right]].concat())
        }
        None => {
            let breaks: Vec<f64> = (0..998).map(|i| f64::from(i) / 997.0).collect();
            SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating)
        }
    };
    Spline::new(space.expect("knots increase"), points).expect("1000 points")
}
