//! Laws of B-splines, spline spaces, evaluation and rational curves that the course states (sections 4.1, 4.2, 4.4, 4.5, 6.1, 6.4).

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use glam::DVec2;
use proptest::prelude::*;
use spline_lab::core::bspline::{
    Side, Spline, SplineSpace, basis_function, uniform_evaluate, uniform_taylor,
};
use spline_lab::core::quadrature::gauss_legendre;
use spline_lab::core::spline_curve::Nurbs;

/// Open knots with the given gaps; runs of more than `degree` equal ones are broken.
fn space(degree: usize, gaps: &[u8]) -> Option<SplineSpace> {
    let mut knots = vec![0.0_f64];
    for &gap in gaps {
        let full = knots.len() >= degree && knots[knots.len() - degree] >= knots[knots.len() - 1];
        knots.push(knots[knots.len() - 1] + f64::from(if full { gap.max(1) } else { gap }));
    }
    SplineSpace::new(degree, knots).ok()
}

prop_compose! {
    fn any_space()(degree in 1_usize..=9)(
        degree in Just(degree), gaps in prop::collection::vec(0_u8..4, 2 * degree + 1..2 * degree + 10),
    ) -> Option<SplineSpace> {
        space(degree, &gaps)
    }
}

fn coefficients(space: &SplineSpace, seed: usize) -> Vec<f64> {
    (0..space.dimension()).map(|k| ((k * k * 5 + seed * k + 3) % 13) as f64 - 6.0).collect()
}

fn spline(space: &SplineSpace, seed: usize) -> Spline<f64> {
    Spline::new(space.clone(), coefficients(space, seed)).unwrap()
}

fn inside(space: &SplineSpace, share: f64) -> f64 {
    let (left, right) = space.parameter_interval();
    left + (right - left) * share
}

/// Divided difference of `(· − x)₊ⁿ` over different knots, times the length of the support.
fn by_divided_difference(knots: &[f64], x: f64) -> f64 {
    let degree = knots.len() as i32 - 2;
    let mut column: Vec<f64> = knots.iter().map(|knot| (knot - x).max(0.0).powi(degree)).collect();
    for level in 1..knots.len() {
        for k in 0..knots.len() - level {
            column[k] = (column[k + 1] - column[k]) / (knots[k + level] - knots[k]);
        }
    }
    column[0] * (knots[knots.len() - 1] - knots[0])
}

proptest! {
    #[test]
    fn the_recurrence_is_the_divided_difference(gaps in prop::collection::vec(1_u8..5, 2..8), share in 0.0..1.0_f64) {
        let mut knots = vec![0.0];
        for gap in &gaps {
            knots.push(knots[knots.len() - 1] + f64::from(*gap));
        }
        let x = knots[gaps.len()] * share;
        let (a, b) = (basis_function(gaps.len() - 1, &knots, x).unwrap(), by_divided_difference(&knots, x));
        prop_assert!((a - b).abs() < 1e-9, "{a} and {b}");
    }

    #[test]
    fn b_splines_move_scale_and_mirror_with_their_knots(
        gaps in prop::collection::vec(0_u8..4, 2..9), share in 0.001..0.999_f64, shift in -40_i32..40, exponent in -5_i32..6,
    ) {
        let mut knots = vec![0.0];
        for gap in &gaps {
            knots.push(knots[knots.len() - 1] + f64::from(*gap));
        }
        let (degree, end) = (gaps.len() - 1, knots[gaps.len()]);
        let x = end * share;
        let value = basis_function(degree, &knots, x).unwrap();
        let (move_by, factor) = (f64::from(shift), 2.0_f64.powi(exponent));
        let map = |t: f64| (t + move_by) * factor;
        let moved: Vec<f64> = knots.iter().map(|&knot| map(knot)).collect();
        let mirrored: Vec<f64> = knots.iter().rev().map(|knot| -knot).collect();
        prop_assert!((basis_function(degree, &moved, map(x)).unwrap() - value).abs() < 1e-11, "moved and scaled");
        if !knots.contains(&x) {
            prop_assert!((basis_function(degree, &mirrored, -x).unwrap() - value).abs() < 1e-12, "mirrored");
        }
        prop_assert!(value >= 0.0 && basis_function(degree, &knots, -0.5).unwrap() == 0.0, "support");
    }

    #[test]
    fn b_splines_depend_continuously_on_their_knots(gaps in prop::collection::vec(0_u8..3, 2..8), share in 0.01..0.99_f64) {
        let mut knots = vec![0.0];
        for gap in &gaps {
            knots.push(knots[knots.len() - 1] + f64::from(*gap));
        }
        let (degree, x) = (gaps.len() - 1, knots[gaps.len()] * share);
        // Coalescing knots are pulled apart a little; x stays away from all of them.
        if knots.iter().any(|knot| (knot - x).abs() < 1e-3) {
            return Ok(());
        }
        let apart: Vec<f64> = knots.iter().enumerate().map(|(k, knot)| knot + 1e-9 * k as f64).collect();
        let (a, b) = (basis_function(degree, &knots, x).unwrap(), basis_function(degree, &apart, x).unwrap());
        prop_assert!((a - b).abs() < 1e-4, "{a} and {b}");
    }

    #[test]
    fn derivatives_of_all_b_splines_cancel(space in any_space(), share in 0.0..=1.0_f64) {
        let Some(space) = space else { return Ok(()) };
        let n = space.degree();
        let mut rows = vec![0.0; (n + 1) * (n + 1)];
        space.write_basis_derivatives(inside(&space, share), n, Side::Right, &mut rows).unwrap();
        for (order, row) in rows.chunks(n + 1).enumerate() {
            let expected = f64::from(u8::from(order == 0));
            let size: f64 = row.iter().map(|value| value.abs()).sum();
            prop_assert!((row.iter().sum::<f64>() - expected).abs() < 1e-13 * size.max(1.0), "order {order}: {row:?}");
        }
    }

    #[test]
    fn the_dimension_is_the_rank(space in any_space()) {
        let Some(space) = space else { return Ok(()) };
        let (n, m) = (space.degree(), space.dimension());
        // n + 1 parameters in every interval determine a spline; Gram-Schmidt on the columns of its values.
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); m];
        for ends in space.breaks().windows(2) {
            for i in 0..=n {
                let x = ends[0] + (ends[1] - ends[0]) * (i as f64 + 0.5) / (n + 1) as f64;
                let mut values = vec![0.0; n + 1];
                let first = space.write_active_basis(x, &mut values).unwrap();
                for (k, column) in columns.iter_mut().enumerate() {
                    column.push(k.checked_sub(first).and_then(|j| values.get(j)).copied().unwrap_or(0.0));
                }
            }
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        for k in 0..m {
            let before = dot(&columns[k], &columns[k]).sqrt();
            for _ in 0..2 {
                for j in 0..k {
                    let (done, rest) = columns.split_at_mut(k);
                    let share = dot(&rest[0], &done[j]);
                    rest[0].iter_mut().zip(&done[j]).for_each(|(x, y)| *x -= share * y);
                }
            }
            let length = dot(&columns[k], &columns[k]).sqrt();
            prop_assert!(length > 1e-9 * before && before > 0.0, "column {k} depends on the others: {length}");
            columns[k].iter_mut().for_each(|x| *x /= length);
        }
    }

    #[test]
    fn the_outermost_knots_do_not_matter(space in any_space(), share in 0.0..=1.0_f64, push in 0.1..9.0_f64) {
        let Some(space) = space else { return Ok(()) };
        let mut knots = space.knots().to_vec();
        let last = knots.len() - 1;
        (knots[0], knots[last]) = (knots[0] - push, knots[last] + push);
        let other = Spline::new(SplineSpace::new(space.degree(), knots).unwrap(), coefficients(&space, 1)).unwrap();
        let x = inside(&space, share);
        let (a, b) = (spline(&space, 1).evaluate(x).unwrap(), other.evaluate(x).unwrap());
        prop_assert!((a - b).abs() < 1e-12, "{a} and {b}");
    }

    #[test]
    fn a_value_is_a_local_average_and_the_sum_of_its_b_splines(space in any_space(), share in 0.0..1.0_f64, changed in 0_usize..40) {
        let Some(space) = space else { return Ok(()) };
        let (n, x) = (space.degree(), inside(&space, share));
        let spline = spline(&space, 2);
        let value = spline.evaluate(x).unwrap();
        let span = space.span(x).unwrap();
        let active = &spline.coefficients()[span - n..=span];
        let least = active.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = active.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        prop_assert!((least - 1e-13..=largest + 1e-13).contains(&value), "{value} of {active:?}");
        let basis = |k: usize| basis_function(n, &space.knots()[k..k + n + 2], x).unwrap();
        let sum: f64 = (span - n..=span).map(|k| spline.coefficients()[k] * basis(k)).sum();
        prop_assert!((sum - value).abs() < 1e-12, "{sum} and {value}");
        let apex = spline.de_boor_scheme(x).unwrap().triangle.result().unwrap();
        prop_assert!((apex - value).abs() < 1e-12, "{apex} and {value}");
        let k = changed % space.dimension();
        let mut moved = spline.coefficients().to_vec();
        moved[k] += 5.0;
        let other = Spline::new(space.clone(), moved).unwrap().evaluate(x).unwrap();
        let (low, high) = space.support(k);
        prop_assert!((low..high).contains(&x) || (other - value).abs() < 1e-13, "{k} acts beyond its support");
    }

    #[test]
    fn derivatives_are_limits_of_differences(space in any_space(), share in 0.05..0.95_f64, scale in -3.0..3.0_f64) {
        let Some(space) = space else { return Ok(()) };
        let (x, h) = (inside(&space, share), 1e-4);
        if space.knots().iter().any(|knot| (knot - x).abs() < 2.0 * h) {
            return Ok(());
        }
        let spline = spline(&space, 3);
        let at = |t: f64| spline.evaluate(t).unwrap();
        // Central, of order 4.
        let slope = (8.0 * (at(x + h) - at(x - h)) - (at(x + 2.0 * h) - at(x - 2.0 * h))) / (12.0 * h);
        let exact = spline.derivatives(x, 1, Side::Right).unwrap()[1];
        prop_assert!((slope - exact).abs() < 1e-7 * exact.abs().max(10.0), "{slope} and {exact}");
        // Affine in the coefficients.
        let mapped = spline.coefficients().iter().map(|c| scale * c + 7.0).collect();
        let other = Spline::new(space.clone(), mapped).unwrap().evaluate(x).unwrap();
        prop_assert!((other - (scale * at(x) + 7.0)).abs() < 1e-12 * other.abs().max(10.0), "affine");
        let line = Spline::new(space.clone(), space.greville_abscissae()).unwrap();
        prop_assert!((line.evaluate(x).unwrap() - x).abs() < 1e-12 * x.abs().max(1.0), "linear precision");
    }

    #[test]
    fn tiny_intervals_give_numbers(degree in 1_usize..=12, tiny in prop::collection::vec(any::<bool>(), 30), share in 0.0..=1.0_f64) {
        let mut knots = vec![0.0_f64];
        for &tiny in &tiny {
            knots.push(knots[knots.len() - 1] + if tiny { 1e-12 } else { 1.0 });
        }
        let Ok(space) = SplineSpace::new(degree, knots) else { return Ok(()) };
        let spline = spline(&space, 4);
        for x in space.breaks().into_iter().chain([inside(&space, share)]) {
            let value = spline.evaluate(x).unwrap();
            prop_assert!((-6.0 - 1e-9..=6.0 + 1e-9).contains(&value), "{value} at {x}");
            for side in [Side::Left, Side::Right] {
                prop_assert!(spline.derivatives(x, 1, side).unwrap()[1].is_finite(), "slope at {x} {side:?}");
            }
        }
    }

    #[test]
    fn rational_curves_see_ratios_of_weights_and_commute_with_affine_maps(
        space in any_space(), share in 0.0..1.0_f64, weights in prop::collection::vec(0.2..5.0_f64, 5), factor in 0.1..9.0_f64, k in 0_usize..30,
    ) {
        let Some(space) = space else { return Ok(()) };
        let m = space.dimension();
        let points: Vec<DVec2> = coefficients(&space, 1).into_iter().zip(coefficients(&space, 5)).map(DVec2::from).collect();
        let weights: Vec<f64> = weights.into_iter().cycle().take(m).collect();
        let curve = |points: &[DVec2], weights: &[f64]| Nurbs::new(space.clone(), points.to_vec(), weights.to_vec()).unwrap();
        let (t, original) = (inside(&space, share), curve(&points, &weights));
        let p = original.evaluate(t).unwrap();
        let scaled: Vec<f64> = weights.iter().map(|weight| weight * factor).collect();
        prop_assert!(curve(&points, &scaled).evaluate(t).unwrap().distance(p) < 1e-11, "one factor");
        let map = |p: DVec2| DVec2::new(2.0 * p.x - p.y + 3.0, p.x + 0.5 * p.y - 1.0);
        let mapped = original.transformed(map).unwrap().evaluate(t).unwrap();
        prop_assert!(mapped.distance(map(p)) < 1e-10, "affine");
        let equal = curve(&points, &vec![factor; m]).evaluate(t).unwrap();
        let polynomial = Spline::new(space.clone(), points.clone()).unwrap().evaluate(t).unwrap();
        prop_assert!(equal.distance(polynomial) < 1e-12, "equal weights");
        let h = original.homogeneous().evaluate(t).unwrap();
        prop_assert!((h.truncate() / h.z).distance(p) < 1e-12, "the homogeneous curve, projected");
        // A larger weight moves the point towards its control point, and only over the support.
        let k = k % m;
        let heavier = original.with_weight(k, weights[k] * 3.0).unwrap().evaluate(t).unwrap();
        let (low, high) = space.support(k);
        if low < t && t < high {
            let (before, after) = (points[k] - p, points[k] - heavier);
            prop_assert!(after.length() <= before.length() + 1e-12, "towards the point");
            prop_assert!(before.perp_dot(after).abs() < 1e-9, "along the straight line");
        } else {
            prop_assert!(heavier.distance(p) < 1e-12, "beyond the support");
        }
    }
}

#[test]
fn uniform_tables_sum_to_one_and_are_means_of_the_lower_degree() {
    for n in 1..=9 {
        let table = uniform_taylor(n);
        for l in 0..=n {
            let sum: f64 = table.iter().map(|row| row[l]).sum();
            assert!((sum - f64::from(u8::from(l == 0))).abs() < 1e-13, "degree {n}, power {l}: {sum}");
        }
        let rule = gauss_legendre(n.div_ceil(2) + 1).unwrap();
        for i in 0..=10 * (n + 1) {
            let x = 0.1 * i as f64;
            // The integrand is a polynomial on both sides of the fraction of x.
            let fraction = x.fract();
            let mean = [(0.0, fraction), (fraction, 1.0)]
                .map(|(a, b)| rule.integrate(a, b, |y| uniform_evaluate(n - 1, x - y)));
            let error = mean[0] + mean[1] - uniform_evaluate(n, x);
            assert!(error.abs() < 1e-12, "degree {n}, x = {x}: off by {error}");
        }
    }
}
