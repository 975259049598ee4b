//! Curves on which the tests of the stories stand.
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;

fn points(count: usize) -> Vec<DVec2> {
    (0..count)
        .map(|k| {
            let angle = 2.4 * k as f64;
            DVec2::new(k as f64 + angle.cos(), 3.0 * angle.sin())
        })
        .collect()
}

fn weights(count: usize) -> Vec<f64> {
    (0..count).map(|k| 0.5 + 0.75 * ((k * k) % 5) as f64).collect()
}

fn open(degree: usize, count: usize) -> SplineSpace {
    // Not equally spaced, with one double knot if the degree allows it.
    let knots = (0..=count + degree).map(|k| {
        let k = if degree > 1 && k == degree + 2 { k - 1 } else { k };
        k as f64 + 0.25 * f64::from(u8::from(k % 3 == 0))
    });
    SplineSpace::new(degree, knots.collect()).unwrap()
}

/// A curve of `degree` with `count` control points that are joined to a loop.
pub(super) fn closed(degree: usize, count: usize, rational: bool) -> Nurbs<DVec2> {
    let knots: Vec<f64> = (0..count).map(|k| k as f64 + if k % 2 == 1 { 0.25 } else { 0.0 }).collect();
    let space = SplineSpace::periodic(degree, count as f64, knots).unwrap();
    let weights = if rational { weights(count) } else { vec![1.0; count] };
    Nurbs::new(space, points(count), weights).unwrap()
}

/// A cubic Bezier curve over [0, 1].
pub(super) fn bezier() -> Nurbs<DVec2> {
    let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)].map(DVec2::from).to_vec();
    Nurbs::polynomial(bezier_space(3), points).unwrap()
}

/// The same with weights.
pub(super) fn weighted() -> Nurbs<DVec2> {
    let curve = bezier();
    Nurbs::new(curve.space().clone(), curve.points().to_vec(), vec![1.0, 2.0, 0.5, 1.0]).unwrap()
}

fn bezier_space(degree: usize) -> SplineSpace {
    let mut knots = vec![-1.0];
    knots.extend(vec![0.0; degree]);
    knots.extend(vec![1.0; degree]);
    knots.push(2.0);
    SplineSpace::new(degree, knots).unwrap()
}

/// A curve over the knots 0, 1, 2, …
pub(super) fn uniform(degree: usize, count: usize, rational: bool) -> Nurbs<DVec2> {
    let space = SplineSpace::new(degree, (0..=count + degree).map(|k| k as f64).collect()).unwrap();
    let weights = if rational { weights(count) } else { vec![1.0; count] };
    Nurbs::new(space, points(count), weights).unwrap()
}

/// A closed curve over the knots 0, 1, 2, …
pub(super) fn uniform_closed(degree: usize, count: usize) -> Nurbs<DVec2> {
    let space = SplineSpace::periodic(degree, count as f64, (0..count).map(|k| k as f64).collect()).unwrap();
    Nurbs::polynomial(space, points(count)).unwrap()
}

/// Open, closed and Bezier curves of degrees up to 12 without weights.
pub(super) fn polynomial_curves() -> Vec<Nurbs<DVec2>> {
    let mut curves = vec![bezier()];
    for degree in [1, 2, 3, 4, 6, 9, 12] {
        curves.push(Nurbs::polynomial(open(degree, degree + 5), points(degree + 5)).unwrap());
        curves.push(closed(degree, 5, false));
        curves.push(Nurbs::polynomial(bezier_space(degree), points(degree + 1)).unwrap());
    }
    curves
}

/// The same with weights.
pub(super) fn rational_curves() -> Vec<Nurbs<DVec2>> {
    let rational = |curve: Nurbs<DVec2>| {
        let count = curve.points().len();
        Nurbs::new(curve.space().clone(), curve.points().to_vec(), weights(count)).unwrap()
    };
    polynomial_curves().into_iter().map(rational).collect()
}

/// With and without weights.
pub(super) fn all_curves() -> Vec<Nurbs<DVec2>> {
    let mut curves = polynomial_curves();
    curves.extend(rational_curves());
    curves
}
