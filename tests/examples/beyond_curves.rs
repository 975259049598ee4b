//! Beyond the course, curves: degree (B.1), knot removal (B.2), deviation (B.3).

use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, Spline, SplineError, SplineSpace};
use spline_lab::core::quadrature::gauss_legendre;
use spline_lab::core::spline_curve::{
    DeviationLimits, Nurbs, ReductionEnds, deviation, deviation_within, reduce_uniformly,
};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.1-a", |example| {
        let raised = open(example, example.points("c")).elevate_degree().unwrap();
        example.expect("n", raised.degree());
        example.expect("knots", raised.space().knots());
        example.expect("c", raised.coefficients());
    }),
    ("B.1-b", |example| {
        let space = SplineSpace::periodic(example.count("n"), example.number("T"), example.numbers("knots"));
        let raised = Spline::new(space.unwrap(), example.points("c")).unwrap().elevate_degree().unwrap();
        example.expect("n", raised.degree());
        example.expect("knots", raised.space().knots());
        example.expect("c", raised.coefficients());
    }),
    ("B.1-c", |example| {
        for (ends, points, error) in
            [(ReductionEnds::Free, "free_c", "free_error"), (ReductionEnds::Fixed, "fixed_c", "fixed_error")]
        {
            let reduction = reduce_uniformly(&example.numbers("c"), ends).unwrap();
            example.expect(points, reduction.points);
            example.expect(error, reduction.error);
        }
    }),
    ("B.1-d", |example| {
        let spline = open(example, example.numbers("c"));
        let reduced = spline.reduce_degree().unwrap();
        assert_eq!(reduced.space().knots(), example.numbers("knots_reduced"), "the same breaks");
        example.expect("c", reduced.coefficients());
        let rule = gauss_legendre(4).unwrap();
        let square = |x: f64| (spline.evaluate(x).unwrap() - reduced.evaluate(x).unwrap()).powi(2);
        let breaks = spline.space().breaks();
        example
            .expect("L2_squared", breaks.windows(2).map(|e| rule.integrate(e[0], e[1], square)).sum::<f64>());
        let found = deviation_within(&curve(&spline), &curve(&reduced), without_halving()).unwrap();
        example.expect("bound", found.upper);
        example.expect("sampled", found.lower);
    }),
    ("B.1-e", |example| {
        let spline = open(example, example.points("c"));
        let reduced = Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap();
        let reduced = reduced.reduce_degree().unwrap();
        example.expect("n", reduced.curve.degree());
        example.expect("knots", reduced.curve.space().knots());
        example.expect("c", reduced.curve.points());
        example.expect("bound", reduced.deviation.upper);
    }),
    ("B.1-f", |example| {
        let raised = bezier(&example.points("C"), &example.numbers("w")).elevate_degree().unwrap();
        example.expect("w", raised.weights());
        example.expect("C", raised.points());
    }),
    ("B.1-g", |example| {
        let result = open(example, example.numbers("c")).reduce_degree();
        example.expect_error(result.as_ref().map_err(SplineError::name));
    }),
    ("B.2-a", |example| {
        let removal = open(example, example.points("c")).remove_knot(example.number("s")).unwrap();
        example.expect("delta", removal.deviation);
        example.expect("knots", removal.spline.space().knots());
        example.expect("c", removal.spline.coefficients());
        example.expect("y", removal.null_vector);
    }),
    ("B.2-b", |example| {
        let removal = open(example, example.points("c")).remove_knot(example.number("s")).unwrap();
        example.expect("delta", removal.deviation);
        example.expect("c", removal.spline.coefficients());
    }),
    ("B.2-c", |example| {
        let removal = open(example, example.numbers("c")).remove_knot(example.number("s")).unwrap();
        example.expect("delta", removal.deviation);
        example.expect("y", removal.null_vector);
        example.expect("c", removal.spline.coefficients());
    }),
    ("B.2-d", |example| {
        let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
        let coefficients = vec![0.0; space.dimension()];
        let result = Spline::new(space, coefficients).unwrap().remove_knot(example.number("s"));
        example.expect_error(result.as_ref().map_err(SplineError::name));
    }),
    ("B.3-a", |example| {
        let (p, r) = (bezier(&example.points("P"), &[1.0; 4]), bezier(&example.points("R"), &[1.0; 4]));
        let upper = |level: f64| {
            let limits = DeviationLimits { relative_gap: 0.0, halvings_per_piece: level as usize };
            deviation_within(&p, &r, limits).unwrap().upper
        };
        example.expect("upper", example.numbers("levels").into_iter().map(upper).collect::<Vec<_>>());
        let found = deviation(&p, &r).unwrap();
        example.expect("max", found.lower);
        example.expect("at", found.at);
    }),
    ("B.3-b", |example| {
        let weights = example.rows("w");
        let [first, second] = [0, 1].map(|i| bezier(&example.points("C"), &weights[i]));
        let found = deviation_within(&first, &second, without_halving()).unwrap();
        example.expect("upper", found.upper);
        example.expect("lower", found.lower);
    }),
    ("B.3-c", |example| {
        let spline = open(example, example.points("c"));
        let curve = Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap();
        let found = deviation(&curve, &curve.insert_knot(example.number("s")).unwrap()).unwrap();
        example.expect("upper", found.upper);
        example.expect("lower", found.lower);
    }),
    ("B.3-d", |example| {
        let [p, q] = ["D1", "D2"].map(|key| {
            let space = SplineSpace::from_breaks(1, &example.numbers(key), EndKnots::Interpolating).unwrap();
            Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X]).unwrap()
        });
        example.expect_error(deviation(&p, &q).as_ref().map_err(SplineError::name));
    }),
];

fn without_halving() -> DeviationLimits {
    DeviationLimits { halvings_per_piece: 0, ..DeviationLimits::default() }
}

fn open<P: spline_lab::core::point::Point>(example: &Example, coefficients: Vec<P>) -> Spline<P> {
    let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
    Spline::new(space, coefficients).unwrap()
}

fn curve(spline: &Spline<f64>) -> Nurbs<f64> {
    Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap()
}

fn bezier(points: &[DVec2], weights: &[f64]) -> Nurbs<DVec2> {
    let space = SplineSpace::from_breaks(points.len() - 1, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
    Nurbs::new(space, points.to_vec(), weights.to_vec()).unwrap()
}
