//! Chapter 5: approximation.

use spline_lab::core::approximation::{
    ApproximationError, EndConditions, Smoothing, SmoothingSpline, averaged_knots, check_sites,
    collocation_matrix, cubic_interpolation, graded_breaks, interpolate, inverse_norm, least_squares,
    midpoint_sites, natural_spline, quadratic_inverse_norm_bound, schoenberg, schoenberg_error_bound,
    smoothing_by_cross_validation, smoothing_spline, smoothing_system,
};
use spline_lab::core::bspline::{EndKnots, Side, Spline, SplineSpace};
use spline_lab::core::formula::Formula;
use spline_lab::core::linear_system::{BandError, BandLu, BandMatrix, PivotedBandLu};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("5.1-a", |example| {
        let (mut errors, mut constants) = (Vec::new(), Vec::new());
        for m in example.numbers("m") {
            let h = 1.0 / (m - 2.0);
            let (at, error) = error_of_square_root(&graded_breaks(0.0, 1.0, m as usize - 2, 1.0).unwrap());
            errors.push(error);
            constants.push((error / h.sqrt(), at / h));
        }
        example.expect("max_error", errors);
        for (constant, at) in constants {
            example.expect("E", constant);
            example.expect("argmax_over_h", at);
        }
    }),
    ("5.1-b", |example| {
        let counts = example.numbers("m");
        let error = |m: &f64| error_of_square_root(&graded_breaks(0.0, 1.0, *m as usize - 2, 4.0).unwrap()).1;
        let errors: Vec<f64> = counts.iter().map(error).collect();
        example.expect("limit_constant", errors[2] * (counts[2] - 2.0).powi(2));
        example.expect("max_error", errors);
    }),
    ("5.1-c", |example| {
        let spline = schoenberg(space(example), f64::exp).unwrap();
        example.expect("coef", spline.coefficients());
        for (j, key) in ["rel_err_j0", "rel_err_j1"].into_iter().enumerate() {
            let error = |x: f64| spline.derivatives(x, j, Side::Right).unwrap()[j] / x.exp() - 1.0;
            let errors = (0..=5000).map(|i| error(f64::from(i) / 5000.0));
            let range = errors.fold((f64::MAX, f64::MIN), |(low, high), e| (low.min(e), high.max(e)));
            example.expect(key, range);
        }
        for x in [0.0, 0.2, 0.8] {
            example.expect("rel_err_at_knots_j0", spline.evaluate(x).unwrap() / x.exp() - 1.0);
        }
    }),
    ("5.1-d", |example| {
        let f = formula(example);
        let excess = |n: f64| {
            let space = SplineSpace::uniform(n as usize, 0.0, 7.0, 7).unwrap();
            schoenberg(space, |x| f.value(&[x])).unwrap().evaluate(2.3).unwrap() - 2.3 * 2.3
        };
        example.expect("excess", example.numbers("n").into_iter().map(excess).collect::<Vec<_>>());
    }),
    ("5.1-e", |example| {
        let (space, f, x) = (space(example), formula(example), example.number("x"));
        let spline = of_formula(example);
        example.expect("greville", space.greville_abscissae());
        example.expect("coef", spline.coefficients());
        example.expect("value", spline.evaluate(x).unwrap());
        example.expect("error", spline.evaluate(x).unwrap() - f.value(&[x]));
        let bend = f.derivatives(&[x], 0, 2)[2];
        example.expect("bound", schoenberg_error_bound(&space, x, bend).unwrap());
    }),
    ("5.1-f", |example| {
        let spline = of_formula(example);
        example.expect("greville", spline.space().greville_abscissae());
        example.expect("coef", spline.coefficients());
        let derivatives = spline.derivatives(example.number("x"), 3, Side::Right).unwrap();
        example.expect("third_derivative", derivatives[3]);
    }),
    ("5.1-g", |example| {
        let spline = of_formula(example);
        example.expect("greville", spline.space().greville_abscissae());
        example.expect("coef", spline.coefficients());
        example.expect("values", values(&spline, &example.numbers("x")));
    }),
    ("5.5-a", |example| {
        let rows = |side: i64| -> Vec<Vec<f64>> {
            let row = |n: f64| {
                let space = SplineSpace::uniform(n as usize, 0.0, 20.0, 20).unwrap();
                let matrix = collocation_matrix(&space, &midpoint_sites(&space).unwrap()).unwrap();
                (0..3).map(|j| matrix.get(11, (11 + side * j) as usize)).collect()
            };
            example.numbers("n").into_iter().map(row).collect()
        };
        example.expect("entries", rows(1));
        example.expect("entries", rows(-1));
    }),
    ("5.5-b", |example| {
        let (points, rows) = first_rows(example.count("n"), example.count("m"), 5);
        example.expect("points", points);
        let times_48 = |row: Vec<f64>| row.into_iter().map(|entry| 48.0 * entry).collect();
        example.expect("rows_times_48", rows.into_iter().map(times_48).collect::<Vec<Vec<f64>>>());
    }),
    ("5.5-c", |example| {
        let cases = example.numbers("n").into_iter().zip(example.numbers("m"));
        let (points, rows): (Vec<_>, Vec<_>) =
            cases.map(|(n, m)| first_rows(n as usize, m as usize, n as usize + 3)).unzip();
        example.expect("points", points);
        example.expect("rows", rows);
    }),
    ("5.5-d", |example| {
        let spline = cubic(example, EndConditions::NotAKnot);
        example.expect("knots", spline.space().knots());
        example.expect("coef", spline.coefficients());
        // The file repeats where the values are taken.
        let at = [0.5, 3.0, 6.0];
        example.expect("value_at", at.to_vec());
        example.expect("values", values(&spline, &at));
    }),
    ("5.5-e", |example| {
        let space = space(example);
        let points = space.greville_abscissae();
        let bound = quadratic_inverse_norm_bound(&space).unwrap();
        example.expect("A", dense(&collocation_matrix(&space, &points).unwrap()));
        example.expect("inv_norm", inverse_norm(&space, &points).unwrap());
        example.expect("bound", bound);
        example.expect("r", 2.0 / (bound - 2.0));
        example.expect("points", points);
    }),
    ("5.5-f", |example| {
        let (space, bad, good) = (space(example), example.numbers("bad"), example.numbers("good"));
        match check_sites(&space, &bad) {
            Err(ApproximationError::SchoenbergWhitney { index, .. }) => {
                example.expect("violating_index", index);
            }
            other => panic!("5.5-f: {other:?}"),
        }
        check_sites(&space, &good).unwrap();
        let determinant = |sites: &[f64]| match BandLu::factor(collocation_matrix(&space, sites).unwrap()) {
            Ok(factors) => factors.determinant(),
            Err(BandError::Singular { .. }) => 0.0,
            Err(error) => panic!("5.5-f: {error}"),
        };
        example.expect("det_bad", determinant(&bad));
        example.expect("det_good", determinant(&good));
    }),
    ("5.5-g", |example| {
        let (space, points) = (space(example), example.numbers("points"));
        example.expect("A", dense(&collocation_matrix(&space, &points).unwrap()));
        let spline = interpolate(space, &points, &example.numbers("data")).unwrap();
        example.expect("coef", spline.coefficients());
    }),
    ("5.5-h", |example| {
        let ends = EndConditions::Clamped { start: example.number("d0"), end: example.number("dM") };
        for (ends, coef, half) in [
            (ends, "clamped_coef", "clamped_at_half"),
            (EndConditions::Natural, "natural_coef", "natural_at_half"),
        ] {
            let spline = cubic(example, ends);
            example.expect("knots", spline.space().knots());
            example.expect(coef, spline.coefficients());
            example.expect(half, spline.evaluate(0.5).unwrap());
        }
    }),
    ("5.5-i", |example| {
        let mut coefficients = Vec::new();
        for case in example.input("cases").as_array().unwrap() {
            let list = |key: &str| -> Vec<f64> {
                case[key].as_array().unwrap().iter().map(|entry| entry.as_f64().unwrap()).collect()
            };
            let (x, y, period) = (list("x"), list("y"), case["period"].as_f64().unwrap());
            let ends = EndConditions::PeriodicOver { period };
            let spline = cubic_interpolation(&x, &y, ends).unwrap();
            coefficients.push(spline.coefficients().to_vec());
            // The system for the B-spline coefficients themselves has the same solution.
            let space = SplineSpace::periodic(3, period, x.clone()).unwrap();
            let other = interpolate(space, &x, &y).unwrap();
            let gap = |(a, b): (&f64, &f64)| (a - b).abs();
            let largest = other.coefficients().iter().zip(spline.coefficients()).map(gap).fold(0.0, f64::max);
            assert!(largest < 1e-13, "5.5-i: two ways differ by {largest}");
            if coefficients.len() == 2 {
                example.expect("value_case2_at_2", spline.evaluate(2.0).unwrap());
            }
        }
        example.expect("coef", coefficients);
    }),
    ("5.5-j", |example| {
        let at_knots = |count: usize, y: &[f64]| {
            let knots: Vec<f64> = (0..count).map(|i| i as f64).collect();
            let space = SplineSpace::periodic(example.count("n"), count as f64, knots.clone()).unwrap();
            interpolate(space, &knots, y)
        };
        let (even, odd) = (at_knots(4, &[1.0, 0.0, 0.0, 0.0]), at_knots(3, &[1.0, 0.0, 0.0]));
        let singular = |result: &Result<_, ApproximationError>| {
            result.as_ref().is_err_and(|error| error.name() == "Singular")
        };
        example.expect("singular", vec![singular(&even), singular(&odd)]);
        example.expect("coef_M3", odd.unwrap().coefficients());
    }),
    ("5.5-k", |example| {
        let ends = [
            ("not_a_knot", EndConditions::NotAKnot),
            ("clamped", EndConditions::Clamped { start: 1.0, end: std::f64::consts::E }),
            ("natural", EndConditions::Natural),
        ];
        for (key, ends) in ends {
            let error = |count: f64| {
                let x: Vec<f64> = (0..=count as usize).map(|i| i as f64 / count).collect();
                let y: Vec<f64> = x.iter().map(|x| x.exp()).collect();
                largest_error(&cubic_interpolation(&x, &y, ends).unwrap(), f64::exp).1
            };
            example.expect(key, example.numbers("N").into_iter().map(error).collect::<Vec<_>>());
        }
    }),
    ("5.5-l", |example| {
        let points = example.numbers("points");
        let space = averaged_knots(example.count("n"), &points).unwrap();
        example.expect("knots", space.knots());
        let spline = interpolate(space, &points, &example.numbers("y")).unwrap();
        example.expect("coef", spline.coefficients());
        example.expect("value_at_3", spline.evaluate(3.0).unwrap());
    }),
    ("5.6-a", |example| {
        let (x, y) = (example.numbers("x"), example.numbers("y"));
        let spline = natural_spline(&x, &y).unwrap();
        example.expect("knots", spline.space().knots());
        example.expect("coef", spline.coefficients());
        example.expect("d2_at_1", spline.derivatives(1.0, 2, Side::Right).unwrap()[2]);
        example.expect("p_at_half", spline.evaluate(0.5).unwrap());
        let smoothest = smoothing_spline(&x, &y, None, Smoothing::Sigma(0.0)).unwrap();
        example.expect("energy", smoothest.roughness);
        let parabola = cubic_interpolation(&x, &y, EndConditions::NotAKnot).unwrap();
        let bend = parabola.derivatives(0.7, 2, Side::Right).unwrap()[2];
        example.expect("energy_parabola", bend * bend * (x[2] - x[0]));
    }),
    ("5.6-b", |example| {
        let fits: Vec<_> =
            example.numbers("sigma").into_iter().map(|s| smoothed(example, Smoothing::Sigma(s))).collect();
        let each = |part: fn(&SmoothingSpline<f64>) -> f64| fits.iter().map(part).collect::<Vec<_>>();
        example.expect("coef", fits.iter().map(|fit| fit.spline.coefficients().to_vec()).collect::<Vec<_>>());
        example.expect("fitted", fits.iter().map(|fit| fit.fitted.clone()).collect::<Vec<_>>());
        example.expect("residual", each(|fit| fit.residual));
        example.expect("roughness", each(|fit| fit.roughness));
    }),
    ("5.6-c", |example| {
        let line = smoothed(example, Smoothing::Sigma(1.0));
        let taylor = line.spline.derivatives(0.0, 1, Side::Right).unwrap();
        example.expect("line_u", taylor[0]);
        example.expect("line_v", taylor[1]);
        example.expect("fitted_line", line.fitted);
        let natural = smoothed(example, Smoothing::Sigma(0.0)).spline;
        let bend = |x: f64| natural.derivatives(x, 2, Side::Right).unwrap()[2];
        example.expect("natural_d2", example.numbers("x").into_iter().map(bend).collect::<Vec<_>>());
        example.expect("natural_coef", natural.coefficients());
        let direct = natural_spline(&example.numbers("x"), &example.numbers("y")).unwrap();
        example.expect("natural_coef", direct.coefficients());
    }),
    ("5.6-d", |example| {
        let x = example.numbers("x");
        let matrix = |sigma: f64, factor: f64| -> Vec<Vec<f64>> {
            let (matrix, _) = smoothing_system(&x, &vec![0.0; x.len()], None, sigma).unwrap();
            let scaled = |row: Vec<f64>| row.into_iter().map(|entry| factor * entry).collect();
            dense(&matrix).into_iter().map(scaled).collect()
        };
        example.expect("six_DtGD", matrix(1.0, 6.0));
        example.expect("thirtysix_AtA", matrix(0.0, 36.0));
    }),
    ("5.6-e", |example| {
        let count = example.count("N");
        let x: Vec<f64> = (0..count).map(|i| i as f64 / (count - 1) as f64).collect();
        let sine = |x: f64| (std::f64::consts::TAU * x).sin();
        let y: Vec<f64> =
            (0..count).map(|i| sine(x[i]) + 0.1 * ((7919 * i % 101) as f64 - 50.0) / 50.0).collect();
        let choice = smoothing_by_cross_validation(&x, &y, None).unwrap();
        let fitted = &choice.smoothing.fitted;
        example.expect("lam", choice.lambda);
        example.expect("sigma", choice.sigma);
        example.expect("gcv", choice.score);
        example.expect("edf", choice.smoothing.degrees_of_freedom);
        let gaps = x.iter().zip(fitted).map(|(&x, a)| (a - sine(x)).abs());
        example.expect("max_dev_from_sin", gaps.fold(0.0, f64::max));
        let at = [0_usize, 10, 20, 40];
        example.expect("fitted_at", at.to_vec());
        example.expect("fitted", at.map(|i| fitted[i]).to_vec());
    }),
    ("5.6-f", |example| {
        let (space, x) = (space(example), example.numbers("x"));
        example.expect("A", dense(&collocation_matrix(&space, &x).unwrap()));
        let fit = least_squares(space, &x, &example.numbers("y"), None).unwrap();
        example.expect("coef", fit.spline.coefficients());
        example.expect("residual", fit.residual);
    }),
    ("5.6-g", |example| {
        let (space, x) = (space(example), example.numbers("x"));
        let matrix = collocation_matrix(&space, &x).unwrap();
        let mut normal = Vec::new();
        for (i, j, entry) in matrix.iter() {
            (0..matrix.columns()).for_each(|k| normal.push((j, k, entry * matrix.get(i, k))));
        }
        let error = PivotedBandLu::factor(matrix.columns(), &normal).unwrap_err();
        example.expect("det_normal", f64::from(u8::from(error.name() != "Singular")));
        match least_squares(space, &x, &[0.0; 5], None) {
            Err(ApproximationError::RankDeficient { index, .. }) => {
                example.expect("uncovered_bspline", index);
            }
            other => panic!("5.6-g: {other:?}"),
        }
    }),
    ("5.6-h", |example| {
        let rest = example.number("one_minus_sigma");
        let fit = smoothed(example, Smoothing::Lambda((1.0 - rest) / rest));
        example.expect("fitted", fit.fitted);
        example.expect("u", fit.unknowns);
        example.expect("roughness_over_(1-sigma)^2", fit.roughness / (rest * rest));
    }),
    ("5.6-i", |example| {
        example.expect("fitted", smoothed(example, Smoothing::Sigma(example.number("sigma"))).fitted);
    }),
];

fn space(example: &Example) -> SplineSpace {
    SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap()
}

fn formula(example: &Example) -> Formula {
    Formula::parse(example.input("f").as_str().unwrap(), &["x"]).unwrap()
}

fn of_formula(example: &Example) -> Spline<f64> {
    let f = formula(example);
    schoenberg(space(example), |x| f.value(&[x])).unwrap()
}

fn cubic(example: &Example, ends: EndConditions<f64>) -> Spline<f64> {
    cubic_interpolation(&example.numbers("x"), &example.numbers("y"), ends).unwrap()
}

fn smoothed(example: &Example, smoothing: Smoothing) -> SmoothingSpline<f64> {
    let (x, y, w) = (example.numbers("x"), example.numbers("y"), example.numbers("w"));
    smoothing_spline(&x, &y, Some(&w), smoothing).unwrap()
}

fn values(spline: &Spline<f64>, parameters: &[f64]) -> Vec<f64> {
    parameters.iter().map(|&x| spline.evaluate(x).unwrap()).collect()
}

fn dense(matrix: &BandMatrix) -> Vec<Vec<f64>> {
    (0..matrix.rows()).map(|i| (0..matrix.columns()).map(|j| matrix.get(i, j)).collect()).collect()
}

/// Sites for equally spaced knots of width 1, those at the left end, with their rows of the matrix.
fn first_rows(n: usize, m: usize, columns: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let space = SplineSpace::uniform(n, 0.0, (m - n) as f64, m - n).unwrap();
    let sites = midpoint_sites(&space).unwrap();
    let matrix = collocation_matrix(&space, &sites).unwrap();
    let count = 2 * (n / 2) + 1;
    let row = |i: usize| (0..columns).map(|j| matrix.get(i, j)).collect();
    (sites[..count].to_vec(), (0..count).map(row).collect())
}

fn error_of_square_root(breaks: &[f64]) -> (f64, f64) {
    let space = SplineSpace::from_breaks(2, breaks, EndKnots::Interpolating).unwrap();
    largest_error(&schoenberg(space, f64::sqrt).unwrap(), f64::sqrt)
}

/// Where the spline differs most from `f`, and by how much: a few samples in each knot interval, then a golden section around the best.
fn largest_error(spline: &Spline<f64>, f: fn(f64) -> f64) -> (f64, f64) {
    let breaks = spline.space().breaks();
    let mut best = (0.0, 0.0, 0.0);
    for (index, pair) in breaks.windows(2).enumerate() {
        let span = spline.space().span(pair[0]).unwrap();
        assert!(index <= span, "one knot interval after the other");
        for i in 0..=16 {
            let x = pair[0] + (pair[1] - pair[0]) * f64::from(i) / 16.0;
            let error = (spline.evaluate_in_span(span, x) - f(x)).abs();
            if error > best.0 {
                let step = (pair[1] - pair[0]) / 16.0;
                best = (error, (x - step).max(breaks[0]), (x + step).min(breaks[breaks.len() - 1]));
            }
        }
    }
    let error = |x: f64| (spline.evaluate(x).unwrap() - f(x)).abs();
    let (_, mut low, mut high) = best;
    for _ in 0..60 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if error(a) > error(b) { high = b } else { low = a }
    }
    (low, error(low))
}
