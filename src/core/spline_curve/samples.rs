//! Random curves for tests.

use std::ops::RangeInclusive;

use glam::DVec2;
use proptest::prelude::*;

pub(super) use crate::core::bspline::any_spline;
use crate::core::spline_curve::Nurbs;

/// As [`any_spline`] with weights between 1/4 and 4, half of the time all equal.
pub(super) fn any_curve(degrees: RangeInclusive<usize>) -> impl Strategy<Value = Nurbs<DVec2>> {
    (any_spline(degrees), any::<bool>(), prop::collection::vec(0.25..4.0_f64, 7)).prop_map(
        |(spline, equal, weights)| {
            let (space, points) = spline.into_parts();
            let weight = |k: usize| if equal { weights[0] } else { weights[k % 7] };
            let weights = (0..points.len()).map(weight).collect();
            Nurbs::new(space, points, weights).expect("positive weights")
        },
    )
}

/// Largest distance at 50 equal parameters of the interval of the first.
pub(super) fn distance(a: &Nurbs<DVec2>, b: &Nurbs<DVec2>) -> f64 {
    let (left, right) = a.space().parameter_interval();
    (0..=50)
        .map(|i| left + (right - left) * f64::from(i) / 50.0)
        .map(|t| a.evaluate(t).expect("in D").distance(b.evaluate(t).expect("in D")))
        .fold(0.0, f64::max)
}
