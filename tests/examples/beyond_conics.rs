//! Beyond the course, B.12: circles, arcs and conics as rational curves.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use spline_lab::core::rational_bezier::{
    Conic, ExtendedConic, RationalBezier, RationalBezierError, circle, circle_arc_piece,
};

use crate::example::{Example, lists};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.12-a", |example| {
        let given = RationalBezier::new(example.points("C"), example.numbers("w")).unwrap();
        let made = circle_arc_piece(DVec2::ZERO, 1.0, [0.0, TAU], 5).unwrap();
        let also = circle(DVec2::ZERO, 1.0, 5, 1).unwrap().swap_remove(0);
        for curve in [given.clone(), made.clone(), also] {
            let at = |t: f64| curve.evaluate(t).unwrap();
            example.expect("r", example.numbers("t").into_iter().map(at).collect::<Vec<_>>());
        }
        for k in 0..=5 {
            assert!((given.points()[k] - made.points()[k]).length() < 1e-14, "B.12-a: point {k}");
            assert!((given.weights()[k] - 5.0 * made.weights()[k]).abs() < 1e-14, "B.12-a: weight {k}");
        }
    }),
    ("B.12-b", |example| {
        let place = |key: &str| DVec2::from_slice(&example.numbers(key)).to_angle();
        assert_eq!((place("from"), place("to")), (0.0, PI), "B.12-b: the upper half");
        for n in example.numbers("n") {
            let half = circle_arc_piece(DVec2::ZERO, 1.0, [place("from"), place("to")], n as usize).unwrap();
            example.expect(&format!("C{n}"), half.points());
            example.expect(&format!("w{n}"), half.weights());
        }
        assert!(circle_arc_piece(DVec2::ZERO, 1.0, [0.0, PI], 2).is_err(), "B.12-b: not of degree 2");
    }),
    ("B.12-c", |example| {
        let sets = example.input("points").as_array().unwrap().iter().map(lists);
        let through = |rows: Vec<Vec<f64>>| {
            Conic::through_points([0, 1, 2, 3, 4].map(|k| DVec2::new(rows[k][0], rows[k][1]))).unwrap()
        };
        let conics: Vec<Conic> = sets.map(through).collect();
        let coefficients = |conic: &Conic| conic.normalised().coefficients().to_vec();
        example.expect("implicit", conics.iter().map(coefficients).collect::<Vec<_>>());
        example.expect("type", conics.iter().map(|conic| conic.kind().label()).collect::<Vec<_>>());
    }),
    ("B.12-d", |example| {
        let result = Conic::through_points(example.points("points").try_into().unwrap());
        example.expect_error(result.as_ref().map_err(RationalBezierError::name));
    }),
    ("B.12-e", |example| {
        let c = example.points("C");
        let through = |place| RationalBezier::conic_through([c[0], c[1], c[2]], place).unwrap();
        let arcs: Vec<_> = example.points("q").into_iter().map(through).collect();
        example.expect("w1", arcs.iter().map(|arc| arc.weights()[1]).collect::<Vec<_>>());
        let kind = |arc| ExtendedConic::try_from(arc).unwrap().kind(1e-12).label();
        example.expect("type", arcs.iter().map(kind).collect::<Vec<_>>());
        for (place, arc) in example.points("q").into_iter().zip(&arcs) {
            let (leaving, arriving) = (c[1] - c[0], c[2] - c[1]);
            let again = RationalBezier::conic_from_tangents(c[0], leaving, c[2], arriving, place).unwrap();
            assert_eq!(&again, arc, "B.12-e: by the tangents");
        }
    }),
    ("B.12-f", |example| {
        let lines = example.rows("lines");
        let conic =
            Conic::with_tangents([0, 1, 2, 3, 4].map(|k| [lines[k][0], lines[k][1], lines[k][2]])).unwrap();
        example.expect("implicit", conic.normalised().coefficients().to_vec());
    }),
];
