//! Chapter 1: polynomials.

use spline_lab::core::polynomial::{
    antiderivative, bernstein, bernstein_approximation, bernstein_derivative, bernstein_from_monomial,
    bernstein_gram, bernstein_matrix, bernstein_maximum, bernstein_product, bernstein_to_monomial,
    bernstein_values, conversion_matrix, elevate, integral, monomial_growth, sign_changes,
};
use spline_lab::core::root_finding::bernstein_zeros;
use spline_lab::core::triangular_scheme::collapse;

use crate::example::{Example, Got};

const UNIT: (f64, f64) = (0.0, 1.0);

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("1.4-a", |example| example.expect("matrix", conversion_matrix(example.count("n")))),
    ("1.4-b", |example| {
        example.expect("bernstein", bernstein_from_monomial(&example.numbers("monomial"), UNIT).unwrap());
    }),
    ("1.4-c", |example| {
        example.expect("b", bernstein_values(example.count("n"), example.number("x")));
    }),
    ("1.4-d", |example| {
        let mut unit = vec![0.0; example.count("n") + 1];
        unit[example.count("k")] = 1.0;
        example.expect("monomial", bernstein_to_monomial(&unit, UNIT).unwrap());
    }),
    ("1.4-e", |example| {
        let value = |k: f64| bernstein(example.count("n"), k as isize, example.number("x"));
        example.expect("b", example.numbers("k").into_iter().map(value).collect::<Vec<_>>());
    }),
    ("1.4-f", |example| {
        let ends = example.numbers("interval");
        let interval = (ends[0], ends[1]);
        let c = bernstein_from_monomial(&example.numbers("monomial"), interval).unwrap();
        let back = bernstein_to_monomial(&c, interval).unwrap();
        for (a, b) in back.iter().zip(example.numbers("monomial")) {
            assert!((a - b).abs() < 1e-12, "1.4-f: back to {a}, not {b}");
        }
        example.expect("bernstein", c);
    }),
    ("1.4-g", |example| {
        example.expect("b", bernstein(example.count("n"), example.count("k") as isize, example.number("x")));
    }),
    ("1.4-h", |example| {
        let n = example.count("n");
        let mut monomial = vec![0.0; n + 1];
        monomial[example.count("j")] = 1.0;
        let c = bernstein_from_monomial(&monomial, UNIT).unwrap();
        for k in [10, 15, 20] {
            example.expect(&format!("c_{k}"), c[k]);
        }
        let alternating: Vec<f64> = (0..=n).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let grown: f64 = bernstein_to_monomial(&alternating, UNIT).unwrap().iter().map(|a| a.abs()).sum();
        assert_eq!(grown, monomial_growth(n), "1.4-h: growth 3^20");
    }),
    ("1.5-a", |example| {
        let maximum = bernstein_maximum(example.count("n"), example.count("k")).unwrap();
        example.expect("argmax", maximum.at);
        example.expect("max", maximum.value);
    }),
    ("1.5-b", |example| {
        let values = bernstein_values(example.count("n"), example.number("x"));
        example.expect("sum", values.iter().sum::<f64>());
        example.expect("b", values);
    }),
    ("1.5-c", |example| {
        let (n, k) = (example.count("n"), example.count("k") as isize);
        example.expect("db", bernstein_derivative(n, k, example.number("x")));
    }),
    ("1.5-d", |example| {
        let c = example.numbers("c");
        for k in 0..=example.count("n") {
            let mut unit = vec![0.0; c.len()];
            unit[k] = 1.0;
            example.expect("integral_b", integral(&unit).unwrap());
        }
        example.expect("antiderivative", antiderivative(&c, 0.0).unwrap());
        example.expect("integral_p", integral(&c).unwrap());
    }),
    ("1.5-e", |example| {
        let matrix = bernstein_matrix(example.count("n"), &example.numbers("x"));
        let c = example.numbers("c");
        let product = |row: &Vec<f64>| row.iter().zip(&c).map(|(a, c)| a * c).sum::<f64>();
        example.expect("Ac", matrix.iter().map(product).collect::<Vec<_>>());
        example.expect("A", matrix);
    }),
    ("1.5-f", |example| {
        assert_eq!(example.input("f"), "x^2", "1.5-f: the function");
        let mut c = bernstein_approximation(|x| x * x, example.count("n"), UNIT).unwrap();
        example.expect("c", c.as_slice());
        example.expect("p", collapse(&mut c, example.number("x")));
    }),
    ("1.5-g", |example| example.expect("elevated", elevate(&example.numbers("c"), 1).unwrap())),
    ("1.5-h", |example| {
        let product = bernstein_product(&example.numbers("a"), &example.numbers("b")).unwrap();
        example.expect("product", product);
    }),
    ("1.5-i", |example| {
        let rows = example.rows("c");
        example.expect("sign_changes", rows.iter().map(|c| sign_changes(c)).collect::<Vec<_>>());
        let zeros = |c: &Vec<f64>| -> Got {
            let zeros = bernstein_zeros(c, 0.0);
            let each = zeros.isolated().iter().flat_map(|zero| vec![zero.at; zero.multiplicity]);
            each.collect::<Vec<_>>().into()
        };
        example.expect("zeros", rows.iter().map(zeros).collect::<Vec<_>>());
    }),
    ("1.5-j", |example| example.expect("gram", bernstein_gram(example.count("n")))),
];
