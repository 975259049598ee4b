//! Chapter 4: B-splines.

use spline_lab::core::bspline::{
    EndKnots, PolynomialPiece, Side, Spline, SplineError, SplineSpace, basis_function, basis_segments,
    uniform_evaluate, uniform_taylor,
};

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("4.1-a", |example| {
        let (n, k) = (example.count("n"), example.count("k"));
        let knots = &example.numbers("knots")[k..k + n + 2];
        example.expect("segments", basis_segments(n, knots).unwrap());
    }),
    ("4.1-b", |example| {
        let (knots, x) = (example.numbers("knots"), example.numbers("x"));
        example.expect("b0^1", at_all(1, &knots[..3], &x));
        example.expect("b1^1", at_all(1, &knots[1..], &x));
        example.expect("b0^2", at_all(2, &knots, &x));
    }),
    ("4.1-c", |example| {
        let (n, knots, x) = (example.count("n"), example.numbers("knots"), example.numbers("x"));
        // Three quadratic B-splines need six knots: b₀ has the first four, and so on.
        for k in 0..3 {
            example.expect(&format!("b{k}"), at_all(n, &knots[k..k + n + 2], &x));
        }
    }),
    ("4.1-d", one_b_spline),
    ("4.1-e", |example| {
        let value = basis_function(example.count("n"), &example.numbers("knots"), example.number("x"));
        example.expect("b", value.unwrap());
    }),
    ("4.1-f", one_b_spline),
    ("4.1-g", one_b_spline),
    ("4.1-h", |example| {
        let x = example.number("x");
        let value = |e: f64| basis_function(2, &[0.0, 1.0, 1.0 + e, 2.0], x).unwrap();
        example.expect("b", example.numbers("e").into_iter().map(value).collect::<Vec<_>>());
    }),
    ("4.1-i", |example| {
        let space = space(example).unwrap();
        let mut values = vec![0.0; space.degree() + 1];
        let first = space.write_active_basis(example.number("x"), &mut values).unwrap();
        example.expect("l", first + space.degree());
        example.expect("b", values);
    }),
    ("4.1-j", b_spline_is_refused),
    ("4.1-k", b_spline_is_refused),
    ("4.1-l", b_spline_is_refused),
    ("4.4-a", |example| {
        let name = |(n, knots): (f64, Vec<f64>)| match SplineSpace::new(n as usize, knots) {
            Ok(_) => "ok",
            Err(error) => error.name(),
        };
        let cases = example.numbers("n").into_iter().zip(example.rows("knots"));
        example.expect("result", cases.map(name).collect::<Vec<_>>());
    }),
    ("4.4-b", |example| {
        let space = space(example).unwrap();
        example.expect("D", space.parameter_interval());
        for k in 0..3 {
            let unit = (0..3).map(|j| f64::from(j == k)).collect();
            let spline = Spline::new(space.clone(), unit).unwrap();
            example.expect(&format!("b{k}"), values(&spline, &example.numbers("x")));
        }
    }),
    ("4.4-c", |example| {
        let (n, breaks) = (example.count("n"), example.numbers("breaks"));
        for (key, ends) in [("simple", EndKnots::Simple), ("multiple", EndKnots::Interpolating)] {
            let space = SplineSpace::from_breaks(n, &breaks, ends).unwrap();
            example.expect(key, space.knots());
            example.expect("m", space.dimension());
        }
    }),
    ("4.4-d", |example| {
        let knots = example.numbers("knots_nplus1_fold");
        let space = SplineSpace::from_either_convention(example.count("n"), knots).unwrap();
        example.expect("knots", space.knots());
        example.expect("m", space.dimension());
    }),
    ("4.4-e", |example| {
        for n in example.numbers("n") {
            example.expect(&format!("n{n}"), uniform_taylor(n as usize));
        }
    }),
    ("4.4-f", |example| {
        let n = example.count("n");
        let value = |x: f64| uniform_evaluate(n, x);
        example.expect("b", example.numbers("x").into_iter().map(value).collect::<Vec<_>>());
    }),
    ("4.4-g", |example| {
        let n = example.count("n");
        let factorial: f64 = (1..=n).map(|i| i as f64).product();
        let derivative = |segment: Vec<f64>| segment[n] * factorial;
        example.expect("d", uniform_taylor(n).into_iter().map(derivative).collect::<Vec<_>>());
    }),
    ("4.4-h", |example| {
        let intervals = (1.0 / example.number("h")).round() as usize;
        let space = SplineSpace::uniform(example.count("n"), 0.0, 1.0, intervals).unwrap();
        example.expect("knots", space.knots());
        example.expect("m", space.dimension());
    }),
    ("4.4-i", |example| {
        let space = SplineSpace::new(3, example.numbers("knots")).unwrap();
        let spline = Spline::from_hermite(space, &example.numbers("f"), &example.numbers("d")).unwrap();
        example.expect("c", spline.coefficients());
        example.expect("p(3/2)", spline.evaluate(1.5).unwrap());
    }),
    ("4.4-j", |example| example.expect("c", from_pieces(example).unwrap().coefficients())),
    ("4.4-k", |example| example.expect_error(from_pieces(example).as_ref().map_err(SplineError::name))),
    ("4.5-a", |example| {
        let scheme = spline(example).unwrap().de_boor_scheme(example.number("x")).unwrap();
        example.expect("l", scheme.span);
        example.expect("rows", scheme.triangle.levels());
        example.expect("gamma", scheme.triangle.weights());
        example.expect("p", scheme.triangle.result().unwrap());
    }),
    ("4.5-b", |example| {
        // At the knot ξₗ the last coefficient has no influence; k = l − n + i + j is entry j of level i.
        let scheme = spline(example).unwrap().de_boor_scheme(example.number("x")).unwrap();
        let levels = scheme.triangle.levels();
        let entry = |i: usize, k: usize| levels[i][k + 3 - i - scheme.span];
        example.expect("p_2^1", entry(1, 2));
        example.expect("p_3^1", entry(1, 3));
        example.expect("p_3^2", entry(2, 3));
        example.expect("p", scheme.triangle.result().unwrap());
    }),
    ("4.5-c", |example| {
        let spline = spline(example).unwrap();
        let (n, knots) = (spline.degree(), spline.space().knots());
        example.expect("D", spline.space().parameter_interval());
        let sum = spline.derivative_sum();
        let alpha = (1..spline.coefficients().len()).map(|k| n as f64 / (knots[k + n] - knots[k]));
        example.expect("alpha", alpha.collect::<Vec<_>>());
        example.expect("d", sum.coefficients());
        example.expect("knots_d", sum.knots());
        example.expect("d", spline.derivative().unwrap().coefficients());
    }),
    ("4.5-d", |example| {
        let spline = spline(example).unwrap();
        example.expect("derivs", spline.derivatives(example.number("x"), 3, Side::Right).unwrap());
    }),
    ("4.5-e", |example| {
        example.expect("p", values(&spline(example).unwrap(), &example.numbers("x")));
    }),
    ("4.5-f", |example| {
        let (spline, x) = (spline(example).unwrap(), example.number("x"));
        example.expect("p", spline.evaluate(x).unwrap());
        let sum = spline.derivative_sum();
        for (key, side) in [("dp(1-)", Side::Left), ("dp(1+)", Side::Right)] {
            example.expect(key, spline.derivatives(x, 1, side).unwrap()[1]);
            example.expect(key, sum.evaluate(x, side).unwrap());
        }
    }),
    ("4.5-g", |example| {
        example.expect("d", spline(example).unwrap().derivative_sum().coefficients());
    }),
    ("4.5-h", |example| {
        let spline = spline(example).unwrap();
        let whole = spline.antiderivative().unwrap();
        example.expect("antiderivative", &whole.coefficients()[1..]);
        let (left, right) = spline.space().parameter_interval();
        example.expect("integral", spline.integrate(left, right).unwrap());
    }),
    ("4.5-i", |example| {
        let result = spline(example).unwrap().evaluate(example.number("x"));
        example.expect_error(result.as_ref().map_err(SplineError::name));
    }),
    ("4.5-j", |example| example.expect_error(spline(example).as_ref().map_err(SplineError::name))),
    ("4.5-k", |example| {
        let space = space(example).unwrap();
        let spans = example.numbers("x").into_iter().map(|x| space.span(x).unwrap());
        example.expect("l", spans.collect::<Vec<_>>());
    }),
];

fn space(example: &Example) -> Result<SplineSpace, SplineError> {
    SplineSpace::new(example.count("n"), example.numbers("knots"))
}

fn spline(example: &Example) -> Result<Spline<f64>, SplineError> {
    Spline::new(space(example)?, example.numbers("c"))
}

fn values(spline: &Spline<f64>, parameters: &[f64]) -> Got {
    parameters.iter().map(|&x| spline.evaluate(x).unwrap()).collect::<Vec<_>>().into()
}

fn at_all(degree: usize, knots: &[f64], parameters: &[f64]) -> Vec<f64> {
    parameters.iter().map(|&x| basis_function(degree, knots, x).unwrap()).collect()
}

fn one_b_spline(example: &Example) {
    example.expect("b", at_all(example.count("n"), &example.numbers("knots"), &example.numbers("x")));
}

fn b_spline_is_refused(example: &Example) {
    let result = basis_function(example.count("n"), &example.numbers("knots"), 0.5);
    example.expect_error(result.as_ref().map_err(SplineError::name));
}

/// The pieces of the file are powers of x itself.
fn from_pieces(example: &Example) -> Result<Spline<f64>, SplineError> {
    let piece = |coefficients| PolynomialPiece { origin: 0.0, coefficients };
    let pieces: Vec<_> = example.rows("pieces").into_iter().map(piece).collect();
    Spline::from_piecewise(space(example)?, &pieces)
}
