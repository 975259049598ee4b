//! Properties of splines over random spaces: degrees 1 to 12, open and closed, multiplicities up to the degree.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use proptest::prelude::*;
use spline_lab::core::bspline::{Spline, SplineSpace};

/// A spline over knots with the given gaps; gaps of 0 make multiple knots. Gaps that give no valid space are skipped by the tests.
fn spline(degree: usize, gaps: &[u8], closed: bool, coefficients: &[f64]) -> Option<Spline<f64>> {
    let mut knots = vec![0.0];
    for gap in gaps {
        knots.push(knots[knots.len() - 1] + f64::from(*gap));
    }
    let space = if closed {
        SplineSpace::periodic(degree, knots[knots.len() - 1] + 1.0, knots)
    } else {
        SplineSpace::new(degree, knots)
    }
    .ok()?;
    let coefficients = coefficients.iter().copied().cycle().take(space.dimension()).collect();
    Spline::new(space, coefficients).ok()
}

prop_compose! {
    fn any_spline()(closed in any::<bool>(), degree in 1_usize..=12)(
        degree in Just(degree),
        closed in Just(closed),
        gaps in prop::collection::vec(prop_oneof![Just(0_u8), Just(1), Just(1), Just(3)],
            if closed { 0..14 } else { 2 * degree + 1..2 * degree + 12 }),
        coefficients in prop::collection::vec(-8.0..8.0_f64, 7),
    ) -> Option<Spline<f64>> {
        spline(degree, &gaps, closed, &coefficients)
    }
}

/// Largest difference at 60 parameters, relative to the largest coefficient of `a` (at least 1).
fn difference(a: &Spline<f64>, b: &Spline<f64>) -> f64 {
    let (left, right) = a.space().parameter_interval();
    let size = a.coefficients().iter().fold(1.0_f64, |size, c| size.max(c.abs()));
    (0..=60)
        .map(|i| left + (right - left) * f64::from(i) / 60.0)
        .map(|x| (a.evaluate(x).unwrap() - b.evaluate(x).unwrap()).abs() / size)
        .fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn insertion_keeps_the_spline_and_its_bounds(
        spline in any_spline(), shares in prop::collection::vec(0.0..1.0_f64, 1..5), at_knots in any::<bool>(),
    ) {
        let Some(spline) = spline else { return Ok(()) };
        let (left, right) = spline.space().parameter_interval();
        let place = |share: &f64| {
            let x = left + (right - left) * share;
            if at_knots { x.round().clamp(left, right) } else { x }
        };
        let new: Vec<f64> = shares.iter().map(place).collect();
        let Ok(refined) = spline.insert_knots(&new) else { return Ok(()) };
        let error = difference(&spline, &refined);
        prop_assert!(error < 1e-11, "new {new:?}: off by {error}");
        let range = |c: &[f64]| c.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
        let (before, after) = (range(spline.coefficients()), range(refined.coefficients()));
        prop_assert!(before.0 - 1e-12 <= after.0 && after.1 <= before.1 + 1e-12, "{before:?} and {after:?}");
    }

    #[test]
    fn insert_then_remove_is_the_identity(spline in any_spline(), share in 0.01..0.99_f64) {
        let Some(spline) = spline else { return Ok(()) };
        let (left, right) = spline.space().parameter_interval();
        let at = left + (right - left) * share;
        let Ok(refined) = spline.insert_knot(at) else { return Ok(()) };
        let removal = refined.remove_knot(at).unwrap();
        prop_assert_eq!(removal.spline.space(), spline.space(), "the old knots");
        prop_assert!(removal.deviation < 1e-11, "deviation {}", removal.deviation);
        let error = difference(&spline, &removal.spline);
        prop_assert!(error < 1e-9, "knot {at}: off by {error}");
    }

    #[test]
    fn removal_stays_within_its_deviation(spline in any_spline(), choice in 0_usize..40) {
        let Some(spline) = spline else { return Ok(()) };
        let knots = spline.space().distinct_knots();
        let at = knots[choice % knots.len()].value;
        let Ok(removal) = spline.remove_knot(at) else { return Ok(()) };
        let size = spline.coefficients().iter().fold(1.0_f64, |size, c| size.max(c.abs()));
        let error = difference(&spline, &removal.spline) * size;
        prop_assert!(error <= removal.deviation + 1e-9, "knot {at}: {error} > {}", removal.deviation);
    }

    #[test]
    fn the_bezier_form_is_the_spline(spline in any_spline(), share in 0.0..1.0_f64) {
        let Some(spline) = spline else { return Ok(()) };
        for piece in spline.bezier_form() {
            let (a, b) = piece.interval;
            let mut points = piece.points;
            while points.len() > 1 {
                points = points.windows(2).map(|p| (1.0 - share) * p[0] + share * p[1]).collect();
            }
            let expected = spline.evaluate(a + (b - a) * share).unwrap();
            prop_assert!((points[0] - expected).abs() < 1e-11, "[{a}, {b}]: {} and {expected}", points[0]);
        }
    }

    #[test]
    fn elevation_keeps_the_spline(spline in any_spline()) {
        let Some(spline) = spline else { return Ok(()) };
        let error = difference(&spline, &spline.elevate_degree().unwrap());
        prop_assert!(error < 1e-8, "degree {}: off by {error}", spline.degree());
    }

    #[test]
    fn the_integral_of_the_derivative_is_the_difference(spline in any_spline(), a in 0.0..1.0_f64, b in 0.0..1.0_f64) {
        let Some(spline) = spline else { return Ok(()) };
        let Ok(derivative) = spline.derivative() else { return Ok(()) };
        let (left, right) = spline.space().parameter_interval();
        let (a, b) = (left + (right - left) * a, left + (right - left) * b);
        let found = derivative.integrate(a, b).unwrap();
        let expected = spline.evaluate(b).unwrap() - spline.evaluate(a).unwrap();
        prop_assert!((found - expected).abs() < 1e-10, "from {a} to {b}: {found} and {expected}");
    }
}
