//! Random splines for tests: open and closed, every admissible multiplicity, intervals of different lengths.

use std::ops::RangeInclusive;

use glam::DVec2;
use proptest::prelude::*;

use crate::core::bspline::{Spline, SplineSpace};

/// Plane splines of the given degrees with coordinates in −8 … 8. Gaps of knots that give no valid space are replaced by ones.
pub(in crate::core) fn any_spline(degrees: RangeInclusive<usize>) -> impl Strategy<Value = Spline<DVec2>> {
    (any::<bool>(), degrees).prop_flat_map(|(closed, degree)| {
        let count = if closed { 0..14 } else { 2 * degree + 1..2 * degree + 12 };
        let gap = prop_oneof![3 => Just(0_u8), 4 => Just(1), 3 => Just(3)];
        let points = prop::collection::vec((-8.0..8.0_f64, -8.0..8.0_f64), 9);
        (prop::collection::vec(gap, count), points).prop_map(move |(gaps, points)| {
            let space = space(degree, &gaps, closed)
                .or_else(|| space(degree, &vec![1; gaps.len()], closed))
                .expect("simple knots are regular");
            let points =
                points.iter().cycle().take(space.dimension()).map(|&(x, y)| DVec2::new(x, y)).collect();
            Spline::new(space, points).expect("finite points")
        })
    })
}

fn space(degree: usize, gaps: &[u8], closed: bool) -> Option<SplineSpace> {
    let mut knots = vec![0.0];
    for gap in gaps {
        // A run of n + 1 equal knots is broken by a gap of 1.
        let full = knots.len() >= degree && knots[knots.len() - degree] >= knots[knots.len() - 1];
        knots.push(knots[knots.len() - 1] + f64::from(if full { (*gap).max(1) } else { *gap }));
    }
    if closed {
        SplineSpace::periodic(degree, knots[knots.len() - 1] + 1.0, knots)
    } else {
        SplineSpace::new(degree, knots)
    }
    .ok()
}
