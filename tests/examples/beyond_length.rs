//! Beyond the course: arc length (B.4), distance from the chord (B.8).

use glam::DVec2;
use spline_lab::core::bspline::{Side, SplineError};
use spline_lab::core::quadrature::gauss_legendre;
use spline_lab::core::rational_bezier::RationalBezier;
use spline_lab::core::spline_curve::{ArcLength, Nurbs};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.4-a", |example| {
        let curve = bezier(example, None);
        let length = ArcLength::new(&curve, 1e-14).unwrap();
        example.expect("length", length.total());
        let rule = gauss_legendre(5).unwrap();
        let gauss = |a: f64, b: f64| {
            rule.integrate(a, b, |t| curve.derivatives(t, 1, Side::Right).unwrap()[1].length())
        };
        example.expect("gauss5", gauss(0.0, 1.0));
        example.expect("gauss5x2", gauss(0.0, 0.5) + gauss(0.5, 1.0));
        example.expect("t_half", length.inverse(0.5 * length.total()).unwrap());
    }),
    ("B.4-b", |example| {
        let length = ArcLength::new(&bezier(example, Some(example.numbers("w"))), 1e-14).unwrap();
        example.expect("length", length.total());
        example.expect("t", length.inverse(std::f64::consts::FRAC_PI_4).unwrap());
    }),
    ("B.4-c", |example| {
        let length = ArcLength::new(&bezier(example, None), 1e-13).unwrap();
        example.expect("length", length.total());
        let at = |share: &f64| length.inverse(share * length.total()).unwrap();
        example.expect("t", example.numbers("fractions").iter().map(at).collect::<Vec<_>>());
    }),
    ("B.4-d", |example| {
        let curve = bezier(example, None);
        example.expect("length", ArcLength::new(&curve, 1e-13).unwrap().total());
        let points = curve.points();
        example.expect("chord", points[0].distance(points[3]));
        example.expect("polygon", points.windows(2).map(|leg| leg[0].distance(leg[1])).sum::<f64>());
    }),
    ("B.4-e", |example| {
        let found = ArcLength::new(&bezier(example, None), 1e-12).unwrap().inverse(example.number("s"));
        example.expect_error(found.as_ref().map_err(SplineError::name));
    }),
    ("B.8-a", |example| {
        let arc = RationalBezier::new(example.points("C"), example.numbers("w")).unwrap();
        let coefficients = arc.chord_coefficients();
        example.expect("coeffs", coefficients.iter().map(|d| d.length()).collect::<Vec<_>>());
        example.expect("bound", arc.chord_bound());
        example.expect("max", sagitta(&arc));
    }),
    ("B.8-b", |example| {
        let mut part = RationalBezier::new(example.points("C"), example.numbers("w")).unwrap();
        let (mut bounds, mut sagittas) = (Vec::new(), Vec::new());
        let mut chords = 1;
        while part.chord_bound() > example.number("tol") || bounds.len() < 5 {
            bounds.push(part.chord_bound());
            sagittas.push(sagitta(&part));
            let (a, b) = part.interval();
            part = part.split(0.5 * (a + b)).unwrap().0.standardised().unwrap().curve;
            chords *= 2;
        }
        example.expect("bound", bounds);
        example.expect("sagitta", sagittas);
        example.expect("chords", chords as usize);
    }),
];

/// Distance of the middle of a circle's arc from that of its chord.
fn sagitta(arc: &RationalBezier<DVec2>) -> f64 {
    let (a, b) = arc.interval();
    let ends = [arc.points()[0], arc.points()[arc.degree()]];
    arc.evaluate(0.5 * (a + b)).unwrap().distance(0.5 * (ends[0] + ends[1]))
}

fn bezier(example: &Example, weights: Option<Vec<f64>>) -> Nurbs<DVec2> {
    let points = example.points("C");
    let weights = weights.unwrap_or_else(|| vec![1.0; points.len()]);
    Nurbs::from_rational_bezier_curves(&[RationalBezier::new(points, weights).unwrap()]).unwrap()
}
