//! W6 and W7: 1000 knots inserted into a cubic curve of the plane with 1000 control points, its Bezier form (997 intervals), and uniform
//! subdivision of a closed cubic curve from 16 to 2²⁰ points.
//!
//! Reads `PEERS_HOME/data/c_knots.f64`, `c_ctrl.f64`, `ins_knots.f64`, `sub_ctrl.f64` (raw f64); without them, data of the same
//! shape. One JSON line per measurement.

mod report;

use std::f64::consts::TAU;
use std::hint::black_box;

use glam::DVec2;
use report::{curve, load, measure};
use spline_lab::core::spline_curve::subdivide_polygon;

fn main() {
    let curve = curve();
    let new = load("ins_knots")
        .unwrap_or_else(|| (0..1000).map(|i| 0.001 + 0.998 * f64::from(i) / 999.0).collect());
    for half in [500, 1000] {
        let new = &new[..half];
        measure("W6-insert", half, "Spline::insert_knots into 1000 points, with the new space", || {
            black_box(curve.insert_knots(new).expect("inner knots"));
        });
    }
    measure("W6-bezier", 997, "Spline::bezier_pieces, points in one buffer", || {
        black_box(curve.bezier_pieces());
    });
    let start: Vec<DVec2> = match load("sub_ctrl") {
        Some(numbers) => numbers.chunks_exact(2).map(DVec2::from_slice).collect(),
        None => (0..16).map(|k| DVec2::from_angle(TAU * f64::from(k) / 16.0)).collect(),
    };
    for levels in [14, 15, 16] {
        measure("W7-subdiv", 16 << levels, "subdivide_polygon, degree 3, closed", || {
            black_box(subdivide_polygon(&start, 3, true, levels).expect("few points"));
        });
    }
}
