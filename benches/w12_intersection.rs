//! W12: a cubic curve with 50 control points and another one, and the same curve and a line; ten times as many control points too.
//!
//! Reads `PEERS_HOME/data/x1_knots.f64`, `x1_ctrl.f64`, `x2_knots.f64`, `x2_ctrl.f64` (raw f64); without them, data of the same shape. One JSON
//! line per measurement.

mod report;

use std::hint::black_box;

use glam::DVec2;
use report::{check, load, measure};
use spline_lab::core::bspline::{EndKnots, SplineSpace};
use spline_lab::core::spline_curve::{IntersectionTree, Nurbs};

fn main() {
    let one = curve("x1", 50, |s| 0.3 * (25.0 * s).sin());
    let other = curve("x2", 50, |s| 0.3 * (37.0 * s + 0.4).cos());
    let found = one.intersections(&other, 1e-10).expect("few pairs");
    check("W12-curve-curve", &format!("\"hits\": {}", found.len()));
    measure("W12-curve-curve", 1, "Nurbs::intersections, nothing prepared", || {
        black_box(one.intersections(&other, 1e-10).expect("few pairs"));
    });
    let trees = [&one, &other].map(|curve| IntersectionTree::new(curve).expect("small numbers"));
    measure("W12-curve-curve", 1, "IntersectionTree::intersections, both trees prepared", || {
        black_box(trees[0].intersections(&trees[1], 1e-10).expect("few pairs"));
    });
    check(
        "W12-curve-line",
        &format!("\"hits\": {}", one.intersect_line(DVec2::Y, 0.05, 1e-12).expect("a line").len()),
    );
    measure("W12-curve-line", 1, "Nurbs::intersect_line, nothing prepared", || {
        black_box(one.intersect_line(DVec2::Y, 0.05, 1e-12).expect("a line"));
    });
    measure("W12-curve-line", 1, "IntersectionTree::intersect_line, tree prepared", || {
        black_box(trees[0].intersect_line(DVec2::Y, 0.05, 1e-12).expect("a line"));
    });
    measure("W12-prepare", 1, "IntersectionTree::new", || {
        black_box(IntersectionTree::new(&one).expect("small numbers"));
    });
    measure("W12-self", 1, "Nurbs::self_intersections, none there", || {
        black_box(one.self_intersections(1e-10).expect("few pairs"));
    });
    let long = [25.0, 37.0].map(|w| curve("", 500, |s| 0.3 * (w * s).sin()));
    let trees = [0, 1].map(|i| IntersectionTree::new(&long[i]).expect("small numbers"));
    measure("W12-curve-curve-500", 1, "IntersectionTree::intersections, as many, prepared", || {
        black_box(trees[0].intersections(&trees[1], 1e-10).expect("few pairs"));
    });
    measure("W12-curve-curve-500", 1, "Nurbs::intersections of curves with 500 control points", || {
        black_box(long[0].intersections(&long[1], 1e-10).expect("few pairs"));
    });
}

fn curve(name: &str, count: u32, height: impl Fn(f64) -> f64) -> Nurbs<DVec2> {
    let points = load(&format!("{name}_ctrl")).map_or_else(
        || {
            (0..count)
                .map(|k| f64::from(k) / f64::from(count - 1))
                .map(|s| DVec2::new(s, height(s)))
                .collect()
        },
        |numbers| numbers.chunks_exact(2).map(DVec2::from_slice).collect::<Vec<_>>(),
    );
    let space = load(&format!("{name}_knots")).map_or_else(
        || {
            let breaks: Vec<f64> = (0..count - 2).map(|i| f64::from(i) / f64::from(count - 3)).collect();
            SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating)
        },
        |knots| SplineSpace::from_either_convention(3, knots),
    );
    Nurbs::polynomial(space.expect("knots increase"), points).expect("as many points as B-splines")
}
