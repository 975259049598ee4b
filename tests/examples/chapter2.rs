//! Bezier curves: sections 2.1 and 2.3.

use glam::DVec2;
use spline_lab::core::bezier::{BezierCurve, BezierError};

use crate::example::{Example, Got};

/// Example and what computes it.
pub const CHECKS: &[(&str, fn(&Example))] = &[
    ("2.1-a", |example| {
        let curve = plane(example, "C");
        example.expect("p", curve.evaluate(example.number("t")).expect("finite"));
        example.expect("monomial", curve.to_monomial());
    }),
    ("2.1-b", |example| {
        let graph = BezierCurve::graph(&example.numbers("bernstein")).expect("finite");
        example.expect("C", graph.points());
        example.expect("p(1/2)", graph.evaluate(0.5).expect("finite"));
    }),
    ("2.1-c", value_at_t),
    ("2.1-d", value_at_t),
    ("2.1-e", |example| {
        let ends = example.numbers("interval");
        let point = plane(example, "C").evaluate_on(ends[0], ends[1], example.number("x"));
        example.expect("p", point.expect("inside"));
    }),
    ("2.1-f", value_at_t),
    ("2.1-g", |example| error_of_rows(example)),
    ("2.1-h", |example| error_of_rows(example)),
    ("2.3-a", |example| expect_levels(example, &plane(example, "C"))),
    ("2.3-b", |example| expect_levels(example, &scalar(example))),
    ("2.3-c", |example| expect_levels(example, &scalar(example))),
    ("2.3-d", |example| {
        let curve = scalar(example);
        let values: Vec<f64> = example.numbers("t").iter().map(|&t| curve.evaluate(t).expect("finite")).collect();
        example.expect("p", values);
    }),
    ("2.3-e", |example| {
        let curve = plane(example, "C");
        let arguments = example.numbers("args");
        let swapped: Vec<f64> = arguments.iter().rev().copied().collect();
        let value = curve.blossom(&arguments).expect("two arguments");
        assert_eq!(value, curve.blossom(&swapped).expect("two arguments"), "the blossom is symmetric");
        example.expect("b", value);
        example.expect("diag", curve.blossom(&[arguments[0]; 2]).expect("two arguments"));
    }),
    ("2.3-f", |example| {
        let curve = plane(example, "C");
        example.expect("n3", curve.elevated(1).points());
        example.expect("n4", curve.elevated(2).points());
    }),
    ("2.3-g", |example| {
        let n = example.count("n");
        assert_eq!(example.input("c"), "(-1)^k", "the coefficients alternate");
        let curve = BezierCurve::new((0..=n).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect()).expect("finite");
        let values: Vec<f64> = example.numbers("t").iter().map(|&t| curve.evaluate(t).expect("finite")).collect();
        example.expect("p", values);
    }),
    ("2.3-h", |example| {
        let result = scalar(example).de_casteljau_scheme(example.number("t"));
        example.expect_error(result.map_err(|error| error.name()));
    }),
];

fn plane(example: &Example, key: &str) -> BezierCurve<DVec2> {
    BezierCurve::<DVec2>::from_rows(&example.rows(key)).expect("points of the plane")
}

fn scalar(example: &Example) -> BezierCurve<f64> {
    BezierCurve::new(example.numbers("c")).expect("finite")
}

fn value_at_t(example: &Example) {
    example.expect("p", plane(example, "C").evaluate(example.number("t")).expect("finite"));
}

fn error_of_rows(example: &Example) {
    let result: Result<BezierCurve<DVec2>, BezierError> = BezierCurve::<DVec2>::from_rows(&example.rows("C"));
    example.expect_error(result.map_err(|error| error.name()));
}

fn expect_levels<P: spline_lab::core::point::Point + Into<Got>>(example: &Example, curve: &BezierCurve<P>) {
    let scheme = curve.de_casteljau_scheme(example.number("t")).expect("finite");
    for (level, row) in scheme.levels().iter().enumerate().skip(1) {
        example.expect(&format!("m{level}"), row.as_slice());
    }
}
