//! Chapter 4: B-splines.

use spline_lab::core::bspline::{
    EndKnots, PolynomialPiece, Side, Spline, SplineError, SplineSpace, basis_derivative,
    basis_derivative_coefficients, basis_function, basis_integral, basis_leading_term, basis_segments,
    basis_smoothness, uniform_evaluate, uniform_taylor,
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
    ("4.2-a", |example| {
        let (n, knots) = (example.count("n"), example.numbers("knots"));
        for order in 1..=2 {
            let coefficients = basis_derivative_coefficients(n, &knots, order).unwrap();
            example.expect(&format!("d{order}"), coefficients);
        }
        for (key, side) in [("d2(3-)", Side::Left), ("d2(3+)", Side::Right)] {
            example.expect(key, basis_derivative(n, &knots, 3.0, 2, side).unwrap());
        }
        let third = |x: f64| basis_derivative(n, &knots, x, 3, Side::Right).unwrap();
        example.expect("d3", [2.0, 4.0, 7.0].map(third).to_vec());
    }),
    ("4.2-b", |example| {
        let (n, knots) = (example.count("n"), example.numbers("knots"));
        for order in 1..=2 {
            let coefficients = basis_derivative_coefficients(n, &knots, order).unwrap();
            example.expect(&format!("d{order}"), coefficients);
        }
        for side in [Side::Left, Side::Right] {
            let second = |x: f64| basis_derivative(n, &knots, x, 2, side).unwrap();
            example.expect("d2_at", [3.0, 4.0, 6.0].map(second).to_vec());
        }
    }),
    ("4.2-c", |example| {
        let (n, knots) = (example.count("n"), example.numbers("knots"));
        let term = basis_leading_term(n, &knots, Side::Left).unwrap();
        example.expect("order", term.order);
        example.expect("beta", term.coefficient);
        let segments = basis_segments(n, &knots).unwrap();
        example.expect("segment", segments[1].clone());
    }),
    ("4.2-d", |example| {
        let cases = example.rows("knots").into_iter().zip(example.numbers("n"));
        let integrals = cases.map(|(knots, n)| basis_integral(n as usize, &knots).unwrap());
        example.expect("integral", integrals.collect::<Vec<_>>());
    }),
    ("4.2-e", |example| {
        let orders = |(knots, n): (Vec<f64>, f64)| {
            let smoothness = basis_smoothness(n as usize, &knots).unwrap();
            smoothness.iter().map(|knot| knot.order as f64).collect::<Vec<_>>()
        };
        let cases = example.rows("knots").into_iter().zip(example.numbers("n"));
        example.expect("continuity", cases.map(orders).collect::<Vec<_>>());
    }),
    ("4.2-f", |example| {
        let (n, knots) = (example.count("n"), example.numbers("knots"));
        let slope = basis_derivative(n, &knots, example.number("x"), 1, Side::Right);
        example.expect("db", slope.unwrap());
    }),
    ("4.3-a", |example| {
        example.expect("greville_abscissae", space(example).unwrap().greville_abscissae());
    }),
    ("4.3-b", |example| {
        let space = space(example).unwrap();
        example.expect("c", space.monomial_coefficients(example.count("m")).unwrap());
        let (n, variances) = (space.degree() as f64, space.knot_variances());
        let averages = space.greville_abscissae().into_iter();
        example.expect("c", averages.zip(variances).map(|(a, v)| a * a - v / n).collect::<Vec<_>>());
    }),
    ("4.3-c", |example| {
        let space = space(example).unwrap();
        let coefficients = space.monomial_coefficients(example.count("m")).unwrap();
        example.expect("c", coefficients.clone());
        example.expect("value_at_5", Spline::new(space, coefficients).unwrap().evaluate(5.0).unwrap());
    }),
    ("4.3-d", |example| {
        let (space, x, y) = (space(example).unwrap(), example.number("x"), example.number("y"));
        let psi: Vec<f64> = (0..space.dimension()).map(|k| space.marsden_coefficient(k, y)).collect();
        let span = space.span(x).unwrap();
        example.expect("psi", &psi[span - space.degree()..=span]);
        example.expect("sum", Spline::new(space, psi).unwrap().evaluate(x).unwrap());
    }),
    ("4.3-e", |example| {
        let (n, k) = (example.count("n"), example.numbers("k"));
        let space = SplineSpace::new(n, (0..12).map(f64::from).collect()).unwrap();
        let square = space.monomial_coefficients(2).unwrap();
        example.expect("c", k.into_iter().map(|k| square[k as usize]).collect::<Vec<_>>());
    }),
    ("4.3-f", |example| {
        let piece = PolynomialPiece { origin: 0.0, coefficients: example.numbers("monomial") };
        let coefficients = |knots: Vec<f64>| {
            let space = SplineSpace::new(example.count("n"), knots).unwrap();
            Spline::from_polynomial(space, &piece).unwrap().into_parts().1
        };
        example.expect("c", example.rows("knots").into_iter().map(coefficients).collect::<Vec<_>>());
    }),
    ("4.3-g", |example| {
        let result = space(example).unwrap().monomial_coefficients(example.count("m"));
        example.expect_error(result.as_ref().map_err(SplineError::name));
    }),
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
    ("4.6-a", |example| {
        let spline = oscillating(example.count("n"));
        example.expect("p", values(&spline, &example.numbers("x")));
        example.expect("dp(1/2)", spline.derivatives(0.5, 1, Side::Right).unwrap()[1]);
        example.expect("d2p(0)", spline.derivatives(0.0, 2, Side::Right).unwrap()[2]);
    }),
    ("4.6-b", |example| {
        let x = example.numbers("x");
        let of_degree = |n: f64| values(&oscillating(n as usize), &x);
        example.expect("p", Got::List(example.numbers("n").into_iter().map(of_degree).collect()));
    }),
    ("4.6-c", |example| {
        let spline = periodic(example, example.numbers("c")).unwrap();
        let open = spline.unroll().unwrap();
        example.expect("unrolled_knots", open.space().knots());
        example.expect("unrolled_c", open.coefficients());
        example.expect("p", values(&spline, &example.numbers("x")));
    }),
    ("4.6-d", |example| {
        let spline = periodic(example, example.numbers("c")).unwrap();
        example.expect("d", spline.derivative().unwrap().coefficients());
    }),
    ("4.6-e", |example| {
        let spline = periodic(example, example.numbers("c")).unwrap();
        example.expect("p", spline.evaluate(example.number("x")).unwrap());
        example.expect("unrolled_knots", spline.unroll().unwrap().space().knots());
    }),
    ("4.6-f", |example| {
        example.expect("mean", periodic(example, example.numbers("c")).unwrap().mean().unwrap());
    }),
    ("4.6-g", period_is_refused),
    ("4.6-h", period_is_refused),
];

/// `cₖ = (−1)ᵏ` over the integers.
fn oscillating(degree: usize) -> Spline<f64> {
    let space = SplineSpace::periodic(degree, 2.0, vec![0.0, 1.0]).unwrap();
    Spline::new(space, vec![1.0, -1.0]).unwrap()
}

fn periodic(example: &Example, coefficients: Vec<f64>) -> Result<Spline<f64>, SplineError> {
    let knots = example.numbers("knots");
    Spline::new(SplineSpace::periodic(example.count("n"), example.number("T"), knots)?, coefficients)
}

fn period_is_refused(example: &Example) {
    let result = periodic(example, example.numbers("c"));
    example.expect_error(result.as_ref().map_err(SplineError::name));
}

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
