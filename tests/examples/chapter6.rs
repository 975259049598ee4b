//! Chapter 6: spline curves.

use glam::DVec2;
use spline_lab::core::bspline::{Side, Spline, SplineSpace};
use spline_lab::core::spline_curve::Nurbs;

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("6.1-a", closed_curve),
    ("6.1-b", closed_curve),
    ("6.1-c", |example| {
        let circle = Nurbs::new(closed_space(example), example.points("control"), example.numbers("weights"));
        let circle = circle.unwrap();
        example.expect("points", points(&circle, &example.numbers("t")));
        for i in 0..=40 {
            example.expect("radius", circle.evaluate(f64::from(i) / 10.0).unwrap().length());
        }
        let velocity = |t: f64| circle.derivatives(t, 1, Side::Right).unwrap()[1];
        example.expect("derivative_at_0", velocity(0.0));
        example.expect("speed_at_half", velocity(0.5).length());
        let unrolled = circle.without_weights().unroll().unwrap();
        example.expect("unwrapped_knots", unrolled.space().knots());
        example.expect("unwrapped_control", unrolled.coefficients());
    }),
    ("6.1-d", |example| {
        let curve = Nurbs::polynomial(closed_space(example), example.points("control")).unwrap();
        example.expect("points", points(&curve, &example.numbers("t")));
        let squared = |t: f64| curve.evaluate(t).unwrap().length_squared();
        example.expect("radius_squared", example.numbers("t").into_iter().map(squared).collect::<Vec<_>>());
    }),
    ("6.1-e", |example| {
        let height = |w: f64| open_curve(example, vec![1.0, w, 1.0]).evaluate(0.5).unwrap().y;
        example.expect("y_at_half", example.numbers("w").into_iter().map(height).collect::<Vec<_>>());
    }),
    ("6.1-f", |example| {
        let curve = open_curve(example, example.numbers("weights"));
        let derivatives = curve.derivatives(example.number("t"), 2, Side::Right).unwrap();
        for (key, value) in ["r", "dr", "ddr"].into_iter().zip(derivatives) {
            example.expect(key, value);
        }
    }),
];

fn closed_space(example: &Example) -> SplineSpace {
    SplineSpace::periodic(example.count("n"), example.number("T"), example.numbers("tau")).unwrap()
}

fn open_curve(example: &Example, weights: Vec<f64>) -> Nurbs<DVec2> {
    let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
    Nurbs::new(space, example.points("control"), weights).unwrap()
}

fn points(curve: &Nurbs<DVec2>, parameters: &[f64]) -> Got {
    parameters.iter().map(|&t| curve.evaluate(t).unwrap()).collect::<Vec<_>>().into()
}

fn closed_curve(example: &Example) {
    let curve = Spline::new(closed_space(example), example.points("control")).unwrap();
    let unrolled = curve.unroll().unwrap();
    example.expect("knots", unrolled.space().knots());
    example.expect("control", unrolled.coefficients());
    for spline in [&curve, &unrolled] {
        let values = example.numbers("t").into_iter().map(|t| spline.evaluate(t).unwrap());
        example.expect("points", values.collect::<Vec<_>>());
    }
}
