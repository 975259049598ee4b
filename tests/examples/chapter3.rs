//! Chapter 3: rational Bezier curves.

use glam::{DMat3, DVec2, DVec3};
use spline_lab::core::bezier::BezierCurve;
use spline_lab::core::rational_bezier::{
    Conic, ExtendedConic, ExtendedParameter, RationalBezier, RationalBezierError, parameter_before,
};

use crate::example::{Example, Got, lists, numbers};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("3.1-a", |example| example.expect("d", curve(example).weight_points())),
    ("3.1-b", |example| {
        let again = RationalBezier::from_weight_points(example.points("C"), &example.points("d")).unwrap();
        example.expect("w", again.weights());
    }),
    ("3.1-c", |example| {
        point(example);
        let polynomial = BezierCurve::new(example.points("C")).unwrap();
        example.expect("r", polynomial.evaluate(example.number("t")).unwrap());
    }),
    ("3.1-d", |example| {
        point(example);
        let t = example.number("t");
        example.expect("r", DVec2::new(1.0 - t * t, 2.0 * t) / (1.0 + t * t));
    }),
    ("3.1-e", |example| {
        let (rows, a) = (example.rows("A"), example.numbers("a"));
        let map = |p: DVec2| {
            DVec2::new(rows[0][0] * p.x + rows[0][1] * p.y + a[0], rows[1][0] * p.x + rows[1][1] * p.y + a[1])
        };
        let t = example.number("t");
        example.expect("r_image", curve(example).transformed(map).unwrap().evaluate(t).unwrap());
        let matrix = DMat3::from_cols(
            DVec3::new(rows[0][0], rows[1][0], 0.0),
            DVec3::new(rows[0][1], rows[1][1], 0.0),
            DVec3::new(a[0], a[1], 1.0),
        );
        let projected = curve(example).projected(|h| matrix * h).unwrap();
        assert_eq!(projected.weights(), curve(example).weights(), "3.1-e: affine maps keep the weights");
        example.expect("r_image", projected.evaluate(t).unwrap());
    }),
    ("3.1-f", |example| {
        let weights = example.numbers("w");
        let curve = RationalBezier::new(vec![0.0; weights.len()], weights).unwrap();
        example.expect("beta", curve.basis(example.number("t")).unwrap());
    }),
    ("3.1-g", refused),
    ("3.1-h", refused),
    ("3.1-i", refused),
    ("3.2-a", |example| {
        let (points, t) = (example.points("C"), example.number("t"));
        let with = |w: f64| RationalBezier::new(points.clone(), vec![1.0, w, 1.0, 1.0]).unwrap();
        let at = |w: f64| with(w).evaluate(t).unwrap();
        example.expect("r", example.numbers("w1").into_iter().map(at).collect::<Vec<_>>());
        example.expect("limit_0", at(1e-20));
        example.expect("limit_inf", at(1e20));
    }),
    ("3.2-b", point),
    ("3.2-c", |example| {
        let curve = curve(example);
        for (end, t, by_formula) in [("0", 0.0, 0), ("1", 1.0, 1)] {
            let key = format!("dr({end})");
            example.expect(&key, curve.end_derivatives()[by_formula]);
            example.expect(&key, curve.derivatives(t, 1).unwrap()[1]);
        }
    }),
    ("3.2-d", |example| {
        let motion = curve(example).weight_derivative(example.number("t"), example.count("k")).unwrap();
        example.expect("dr_dw", motion);
    }),
    ("3.2-e", |example| {
        let standard = |weights: Vec<f64>| {
            let curve = RationalBezier::new(vec![0.0; weights.len()], weights).unwrap();
            assert_eq!(
                curve.is_polynomial(1e-12),
                curve.degree() == 3 || curve.weights()[0] == 3.0,
                "3.2-e: disguised"
            );
            Got::from(curve.standardised().unwrap().curve.weights())
        };
        example.expect("w_std", example.rows("w").into_iter().map(standard).collect::<Vec<_>>());
    }),
    ("3.2-f", |example| {
        let weights = example.numbers("w");
        let quarter = RationalBezier::new(vec![DVec2::X, DVec2::ONE, DVec2::Y], weights).unwrap();
        let (standard, s) = (quarter.standardised().unwrap(), example.number("s"));
        example.expect("rho", standard.rho);
        example.expect("t", parameter_before(standard.rho, s));
        example.expect("r", standard.curve.evaluate(s).unwrap());
        example.expect("r", quarter.evaluate(parameter_before(standard.rho, s)).unwrap());
    }),
    ("3.2-g", |example| {
        let (rho, s) = (example.number("rho"), example.number("s"));
        let other = curve(example).reparametrised(rho, example.number("lambda")).unwrap();
        example.expect("w_new", other.weights());
        example.expect("t", parameter_before(rho, s));
        example.expect("r", other.evaluate(s).unwrap());
        example.expect("r", curve(example).evaluate(parameter_before(rho, s)).unwrap());
    }),
    ("3.2-h", |example| {
        let weights = example.numbers("w");
        let curve = RationalBezier::new(vec![0.0; weights.len()], weights).unwrap();
        let result = curve.reparametrised(example.number("rho"), example.number("lambda"));
        example.expect_error(result.as_ref().map_err(RationalBezierError::name));
    }),
    ("3.3-a", |example| {
        let scheme = curve(example).de_casteljau_scheme(example.number("t")).unwrap();
        for (m, level) in scheme.levels().iter().enumerate().skip(1) {
            let rows: Vec<Vec<f64>> = level.iter().map(|h| h.to_array().to_vec()).collect();
            example.expect(&format!("m{m}"), rows);
        }
        let apex = scheme.result().unwrap();
        example.expect("r", apex.truncate() / apex.z);
        point(example);
    }),
    ("3.3-b", |example| {
        let values = curve(example).derivatives(0.0, 2).unwrap();
        example.expect("dr(0)", values[1]);
        example.expect("d2r(0)", values[2]);
        example.expect("kappa(0)", curve(example).curvature(0.0).unwrap());
    }),
    ("3.3-c", |example| {
        let values = curve(example).derivatives(example.number("t"), 3).unwrap();
        for (order, key) in [(1, "dr"), (2, "d2r"), (3, "d3r")] {
            example.expect(key, values[order]);
        }
    }),
    ("3.3-d", |example| {
        let (left, right) = curve(example).split(example.number("s")).unwrap();
        for (name, half) in [("left", left), ("right", right)] {
            example.expect(&format!("w_{name}"), half.weights());
            example.expect(&format!("C_{name}"), half.points());
        }
    }),
    ("3.3-e", |example| {
        let raised = curve(example).elevate_degree_by(1).unwrap();
        example.expect("w", raised.weights());
        example.expect("C", raised.points());
    }),
    ("3.3-f", |example| {
        let points: Vec<f64> = example.rows("C").into_iter().map(|row| row[0]).collect();
        let (weights, t) = (example.numbers("w"), example.number("t"));
        let given = RationalBezier::new(points.clone(), weights.clone()).unwrap();
        assert_eq!(given.weights(), weights, "3.3-f: stored as given");
        example.expect("r", vec![given.evaluate(t).unwrap()]);
        // One weight differs in the last bits, so that the curve takes the homogeneous way.
        let nearly =
            RationalBezier::new(points, vec![weights[0], weights[1] * (1.0 + 1e-15), weights[2]]).unwrap();
        example.expect("r", vec![nearly.evaluate(t).unwrap()]);
    }),
    ("3.3-g", |example| {
        let curvature = |t: f64| curve(example).curvature(t).unwrap();
        example.expect("kappa", example.numbers("t").into_iter().map(curvature).collect::<Vec<_>>());
    }),
    ("3.4-a", |example| {
        let all = several(example);
        example.expect("d", all.iter().map(ExtendedConic::discriminant).collect::<Vec<_>>());
        example.expect("type", all.iter().map(|conic| conic.kind(1e-12).label()).collect::<Vec<_>>());
        example.expect(
            "type",
            all.iter().map(|conic| conic.implicit().unwrap().kind().label()).collect::<Vec<_>>(),
        );
        let implicit = |conic: &ExtendedConic| conic.implicit().unwrap().normalised().coefficients().to_vec();
        example.expect("implicit", all.iter().map(implicit).collect::<Vec<_>>());
    }),
    ("3.4-b", |example| {
        let curve = curve(example);
        let conic = curve.conic().unwrap();
        example.expect("d", ExtendedConic::try_from(&curve).unwrap().discriminant());
        example.expect("implicit", conic.normalised().coefficients().to_vec());
        example.expect("center", conic.center().unwrap());
        example.expect("r(1/2)", curve.evaluate(0.5).unwrap());
    }),
    ("3.4-c", |example| {
        let conic = Conic::new(example.numbers("implicit").try_into().unwrap()).unwrap();
        example.expect("axes", conic.axes().unwrap().lengths.to_vec());
    }),
    ("3.4-d", |example| {
        let arc = arc(example).unwrap();
        example.expect("c1", arc.points()[1]);
        example.expect("w1", arc.weights()[1]);
        example.expect("r(1/2)", arc.evaluate(0.5).unwrap());
    }),
    ("3.4-e", |example| {
        let at_infinity = |conic: ExtendedConic| conic.evaluate(ExtendedParameter::Infinity).unwrap();
        example.expect("r_inf", several(example).into_iter().map(at_infinity).collect::<Vec<_>>());
    }),
    ("3.4-f", |example| {
        let (points, weights) = (example.points("C"), example.numbers("w"));
        let points = [points[0], points[1], points[2]];
        let weights = [weights[0], weights[1], weights[2]];
        let t = ExtendedParameter::Finite(example.number("t"));
        example.expect("r", ExtendedConic::new(points, weights).unwrap().evaluate(t).unwrap());
        let quarter = ExtendedConic::standard(points, -weights[1]).unwrap();
        example.expect("r", quarter.complement().evaluate(t).unwrap());
    }),
    ("3.4-g", |example| {
        let (curve, t) = (curve(example), example.numbers("t"));
        example.expect("norm(1/4)", curve.evaluate(t[0]).unwrap().length());
        example.expect("r(1/2)", curve.evaluate(t[1]).unwrap());
    }),
    ("3.4-h", |example| {
        let poles = |weights: Vec<f64>| -> Got {
            let weights = [weights[0], weights[1], weights[2]];
            let conic = ExtendedConic::new([DVec2::X, DVec2::ZERO, DVec2::Y], weights).unwrap();
            let finite = conic.poles().into_iter().map(|pole| match pole {
                ExtendedParameter::Finite(t) => t,
                ExtendedParameter::Infinity => f64::INFINITY,
            });
            finite.collect::<Vec<_>>().into()
        };
        example.expect("poles", example.rows("w").into_iter().map(poles).collect::<Vec<_>>());
    }),
    ("3.4-i", |example| {
        let result = curve(example).conic();
        example.expect_error(result.as_ref().map_err(RationalBezierError::name));
        let result = ExtendedConic::try_from(&curve(example));
        example.expect_error(result.as_ref().map_err(RationalBezierError::name));
    }),
    ("3.4-j", no_arc),
    ("3.4-k", no_arc),
];

fn built(example: &Example) -> Result<RationalBezier<DVec2>, RationalBezierError> {
    RationalBezier::new(example.points("C"), example.numbers("w"))
}

fn curve(example: &Example) -> RationalBezier<DVec2> {
    built(example).unwrap()
}

fn point(example: &Example) {
    example.expect("r", curve(example).evaluate(example.number("t")).unwrap());
}

fn refused(example: &Example) {
    example.expect_error(built(example).as_ref().map_err(RationalBezierError::name));
}

/// The conics of an example with several control polygons and weights.
fn several(example: &Example) -> Vec<ExtendedConic> {
    let polygons = example.input("C").as_array().unwrap().iter().map(lists);
    let weights = example.input("w").as_array().unwrap().iter().map(numbers);
    let conic = |(rows, w): (Vec<Vec<f64>>, Vec<f64>)| {
        let points = [0, 1, 2].map(|k| DVec2::new(rows[k][0], rows[k][1]));
        ExtendedConic::new(points, [w[0], w[1], w[2]]).unwrap()
    };
    polygons.zip(weights).map(conic).collect()
}

fn arc(example: &Example) -> Result<RationalBezier<DVec2>, RationalBezierError> {
    let rows = example.rows("A");
    let conic = Conic::from_matrix([0, 1, 2].map(|i| [rows[i][0], rows[i][1], rows[i][2]])).unwrap();
    let place = |key: &str| DVec2::from_slice(&example.numbers(key));
    conic.arc(place("c0"), place("c2"))
}

fn no_arc(example: &Example) {
    example.expect_error(arc(example).as_ref().map_err(RationalBezierError::name));
}
