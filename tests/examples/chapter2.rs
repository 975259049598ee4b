//! Chapter 2: Bezier curves.

use glam::DVec2;
use spline_lab::core::bezier::{BezierCurve, BezierError};

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("2.1-a", |example| {
        let curve = plane_curve(example);
        example.expect("p", curve.evaluate(example.number("t")).unwrap());
        example.expect("monomial", curve.monomial());
    }),
    ("2.1-b", |example| {
        let curve = BezierCurve::graph(&example.numbers("bernstein"), (0.0, 1.0)).unwrap();
        example.expect("C", curve.points());
        example.expect("p(1/2)", curve.evaluate(0.5).unwrap());
    }),
    ("2.1-c", value),
    ("2.1-d", value),
    ("2.1-e", |example| {
        let interval = example.numbers("interval");
        let curve = BezierCurve::on_interval(example.points("C"), (interval[0], interval[1])).unwrap();
        example.expect("p", curve.evaluate(example.number("x")).unwrap());
    }),
    ("2.1-f", value),
    ("2.1-g", rows_are_refused),
    ("2.1-h", rows_are_refused),
    ("2.3-a", |example| {
        let scheme = plane_curve(example).de_casteljau_scheme(example.number("t")).unwrap();
        for (m, level) in scheme.levels().iter().enumerate().skip(1) {
            example.expect(&format!("m{m}"), level.as_slice());
        }
    }),
    ("2.3-b", scalar_scheme),
    ("2.3-c", scalar_scheme),
    ("2.3-d", |example| {
        let curve = BezierCurve::new(example.numbers("c")).unwrap();
        example.expect("p", values(&curve, &example.numbers("t")));
    }),
    ("2.3-e", |example| {
        let (curve, arguments) = (plane_curve(example), example.numbers("args"));
        example.expect("b", curve.blossom(&arguments).unwrap());
        let swapped: Vec<f64> = arguments.iter().rev().copied().collect();
        example.expect("b", curve.blossom(&swapped).unwrap());
        example.expect("diag", curve.blossom(&[arguments[0]; 2]).unwrap());
        example.expect("diag", curve.evaluate(arguments[0]).unwrap());
    }),
    ("2.3-f", |example| {
        let once = plane_curve(example).elevate_degree();
        example.expect("n3", once.points());
        example.expect("n4", once.elevate_degree().points());
    }),
    ("2.3-g", |example| {
        let points = (0..=example.count("n")).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let curve = BezierCurve::new(points).unwrap();
        example.expect("p", values(&curve, &example.numbers("t")));
    }),
    ("2.3-h", |example| {
        let curve = BezierCurve::new(example.numbers("c")).unwrap();
        let result = curve.de_casteljau_scheme(example.number("t"));
        example.expect_error(result.as_ref().map_err(BezierError::name));
    }),
];

fn plane_curve(example: &Example) -> BezierCurve<DVec2> {
    BezierCurve::new(example.points("C")).unwrap()
}

fn value(example: &Example) {
    example.expect("p", plane_curve(example).evaluate(example.number("t")).unwrap());
}

fn values(curve: &BezierCurve<f64>, parameters: &[f64]) -> Got {
    parameters.iter().map(|&t| curve.evaluate(t).unwrap()).collect::<Vec<_>>().into()
}

fn rows_are_refused(example: &Example) {
    let result = BezierCurve::from_rows(&example.rows("C"));
    example.expect_error(result.as_ref().map_err(BezierError::name));
}

fn scalar_scheme(example: &Example) {
    let curve = BezierCurve::new(example.numbers("c")).unwrap();
    let scheme = curve.de_casteljau_scheme(example.number("t")).unwrap();
    for (m, level) in scheme.levels().iter().enumerate().skip(1) {
        example.expect(&format!("m{m}"), level.as_slice());
    }
}
