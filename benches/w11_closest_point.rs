//! W11: the points of the cubic curve with 1000 control points closest to ten thousand places, the curve prepared; how that grows, and what the preparation takes.
//!
//! Reads `PEERS_HOME/data/c_knots.f64`, `c_ctrl.f64`, `q_pts.f64` (raw f64); without them, data of the same shape. One JSON line per measurement.

mod report;

use std::hint::black_box;

use glam::DVec2;
use report::{check, load, measure};
use spline_lab::core::bspline::{EndKnots, SplineSpace};
use spline_lab::core::point::Point as _;
use spline_lab::core::spline_curve::{ClosestPointTree, Nurbs};

fn main() {
    let (space, points) = report::curve().into_parts();
    let curve = Nurbs::polynomial(space, points).expect("1000 points");
    let places = load("q_pts").map_or_else(
        || scattered(10_000),
        |numbers| numbers.chunks_exact(2).map(DVec2::from_slice).collect::<Vec<_>>(),
    );
    let tree = ClosestPointTree::new(&curve).expect("small numbers");
    let distance = |place: &DVec2| tree.closest_point(*place).expect("finite").distance;
    let mean = places.iter().map(distance).sum::<f64>() / places.len() as f64;
    let (a, b) = curve.space().parameter_interval();
    let samples: Vec<DVec2> =
        (0..=200_000).map(|i| curve.evaluate(a.mix(b, f64::from(i) / 2e5)).expect("in D")).collect();
    let worst = places.iter().step_by(100).map(|place| {
        let sampled = samples.iter().map(|sample| sample.distance(*place)).fold(f64::INFINITY, f64::min);
        distance(place) - sampled
    });
    check(
        "W11-project",
        &format!("\"mean_dist\": {mean:e}, \"excess_over_samples\": {:e}", worst.fold(f64::MIN, f64::max)),
    );
    measure("W11-project", places.len(), "ClosestPointTree::closest_point, tree prepared", || {
        places.iter().for_each(|place| {
            black_box(tree.closest_point(*place).expect("finite"));
        });
    });
    measure("W11-prepare", 1, "ClosestPointTree::new", || {
        black_box(ClosestPointTree::new(&curve).expect("small numbers"));
    });
    for count in [2000, 4000, 8000] {
        let breaks: Vec<f64> = (0..count - 2).map(f64::from).collect();
        let space = SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating).expect("breaks increase");
        let spiral = |k: i32| 12.0 * f64::from(k) / f64::from(count);
        let points = (0..count).map(spiral).map(|s| DVec2::from_angle(s) * (0.3 + 0.01 * s)).collect();
        let tree = ClosestPointTree::new(&Nurbs::polynomial(space, points).expect("as many as B-splines"));
        let tree = tree.expect("small numbers");
        measure(&format!("W11-project-{count}"), places.len(), "as many control points", || {
            places.iter().for_each(|place| {
                black_box(tree.closest_point(*place).expect("finite"));
            });
        });
    }
}

/// Places spread evenly over a square.
fn scattered(count: u32) -> Vec<DVec2> {
    let share = |k: u32, step: f64| (f64::from(k) * step).fract() - 0.5;
    (0..count).map(|k| DVec2::new(share(k, 0.754_877_666), share(k, 0.569_840_291))).collect()
}
