//! Beyond the course: fitting a stroke or a sequence of points (B.16).

use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, Spline, SplineSpace};
use spline_lab::core::spline_curve::{
    FitEnds, FitOptions, FittingError, Nurbs, fit_least_squares, fit_stroke, foot_steps, parameters,
    spread_knots,
};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.16-a", |example| {
        let points = example.points("points");
        example.expect("chord", parameters(&points, 1.0).unwrap());
        example.expect("centripetal", parameters(&points, 0.5).unwrap());
    }),
    ("B.16-b", |example| {
        let space =
            SplineSpace::from_breaks(example.count("n"), &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let (fit, residuals) =
            fit_least_squares(&example.numbers("f"), &example.numbers("t"), space, FitEnds::Fixed).unwrap();
        example.expect("c", fit.coefficients());
        example.expect("max", largest(&residuals));
        example.expect("residuals", residuals);
    }),
    ("B.16-c", |example| {
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let curve = Spline::new(space.clone(), example.points("C")).unwrap();
        let place = DVec2::from_slice(&example.numbers("q"));
        let [hoschek, newton] = foot_steps(&curve, place, example.number("t")).unwrap();
        example.expect("gauss_newton", hoschek);
        example.expect("newton", newton);
        let curve = Nurbs::polynomial(space, example.points("C")).unwrap();
        example.expect("foot", curve.closest_point(place).unwrap().parameter);
    }),
    ("B.16-d", |example| {
        let (n, m) = (example.count("n"), example.count("m"));
        let space = spread_knots(&example.numbers("t"), n, m).unwrap();
        example.expect("inner_knots", &space.knots()[n + 1..m]);
        example.expect("knots", space.knots());
    }),
    ("B.16-e", |example| {
        let breaks = example.numbers("breaks");
        let space = SplineSpace::from_breaks(example.count("n"), &breaks, EndKnots::Interpolating).unwrap();
        let last = example.count("samples") - 1;
        let t: Vec<f64> = (0..=last).map(|k| k as f64 / last as f64).collect();
        let values: Vec<f64> = t.iter().map(|t| (std::f64::consts::TAU * t).sin()).collect();
        let (fit, residuals) = fit_least_squares(&values, &t, space, FitEnds::Free).unwrap();
        example.expect("c", fit.coefficients());
        example.expect("max_residual", largest(&residuals));
    }),
    ("B.16-f", |example| {
        let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
        let t = example.numbers("t");
        for ends in [FitEnds::Free, FitEnds::Fixed] {
            let fit = fit_least_squares(&vec![0.0; t.len()], &t, space.clone(), ends);
            example.expect_error(fit.as_ref().map_err(FittingError::name));
        }
    }),
    ("B.16-g", |example| {
        let options =
            FitOptions { degree: 3, tolerance: 0.1, corner_angle: 1.2, closed: false, most_points: 50 };
        let fit = fit_stroke(&example.points("points"), &options);
        example.expect_error(fit.as_ref().map_err(FittingError::name));
    }),
];

fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().fold(0.0, |most, residual| most.max(residual.abs()))
}
