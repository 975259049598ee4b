//! W3: cubic not-a-knot and natural interpolation through N points, quintic interpolation; also smoothing and least squares of the same size.
//!
//! Reads `PEERS_HOME/data/i_x_N.f64` and `i_y_N.f64` (raw f64); without them, data of the same shape. One JSON line per measurement.

mod report;

use std::hint::black_box;

use report::load;
use spline_lab::core::approximation::{
    EndConditions, Smoothing, cubic_interpolation, interpolate, least_squares, not_a_knot_space,
    smoothing_spline,
};
use spline_lab::core::bspline::{EndKnots, SplineSpace};

fn main() {
    for count in [1_000, 100_000, 1_000_000] {
        let (x, y) = data(count);
        let cubic = |ends| cubic_interpolation(&x, &y, ends).expect("the sites increase");
        measure("W3-cubic", count, "not-a-knot", || cubic(EndConditions::NotAKnot));
        measure("W3-cubic-natural", count, "natural ends", || cubic(EndConditions::Natural));
        if count == 100_000 {
            measure("W3-quintic", count, "degree 5, not-a-knot, banded LU without pivoting", || {
                let space = not_a_knot_space(5, &x).expect("the sites increase");
                interpolate(space, &x, &y).expect("the sites suit the knots")
            });
            measure("W4-smoothing", count, "lambda 1e-9, with degrees of freedom", || {
                smoothing_spline(&x, &y, None, Smoothing::Lambda(1e-9)).expect("the sites increase")
            });
        }
        if count == 1_000_000 {
            let breaks: Vec<f64> = (0..198).map(|i| f64::from(i) / 197.0).collect();
            let space =
                SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating).expect("increasing breaks");
            measure("W5-least-squares", count, "200 coefficients", || {
                least_squares(space.clone(), &x, &y, None).expect("data everywhere")
            });
        }
    }
}

fn data(count: usize) -> (Vec<f64>, Vec<f64>) {
    let read = |name: &str| load(&format!("{name}_{count}"));
    if let (Some(x), Some(y)) = (read("i_x"), read("i_y")) {
        return (x, y);
    }
    let mut state = 12345_u64;
    let mut at = 0.0;
    let mut x: Vec<f64> = (0..count)
        .map(|i| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            at += if i > 0 { 0.2 + 1.6 * (state >> 11) as f64 / (1_u64 << 53) as f64 } else { 0.0 };
            at
        })
        .collect();
    x.iter_mut().for_each(|x| *x /= at);
    let y = x.iter().map(|x| (40.0 * x).sin() + 0.3 * (171.0 * x * x).cos()).collect();
    (x, y)
}

fn measure<T>(workload: &str, count: usize, how: &str, mut run: impl FnMut() -> T) {
    report::measure(workload, count, how, || {
        black_box(run());
    });
}
