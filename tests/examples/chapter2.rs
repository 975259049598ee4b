//! Chapter 2: Bezier curves.

use glam::{DVec2, DVec3};
use spline_lab::core::bezier::{
    BezierCurve, BezierError, EndData, GeometricHermite, Inflections, geometric_hermite, geometric_joint,
    polygon_distance_factor, subdivision_matrix,
};

use spline_lab::core::rational_bezier::Contact;

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("2.1-a", |example| {
        let curve = plane_curve(example);
        example.expect("p", curve.evaluate(example.number("t")).unwrap());
        example.expect("monomial", curve.monomial());
    }),
    ("2.1-b", |example| {
        let curve = BezierCurve::graph(&example.numbers("bernstein"), (0.0, 1.0)).unwrap();
        example.expect("C", curve.points());
        example.expect("p(1/2)", curve.evaluate(0.5).unwrap());
    }),
    ("2.1-c", value),
    ("2.1-d", value),
    ("2.1-e", |example| {
        let interval = example.numbers("interval");
        let curve = BezierCurve::on_interval(example.points("C"), (interval[0], interval[1])).unwrap();
        example.expect("p", curve.evaluate(example.number("x")).unwrap());
    }),
    ("2.1-f", value),
    ("2.1-g", rows_are_refused),
    ("2.1-h", rows_are_refused),
    ("2.2-a", |example| {
        let curve = plane_curve(example);
        for (end, t) in [("0", 0.0), ("1", 1.0)] {
            let values = curve.derivatives(t, 1).unwrap();
            example.expect(&format!("p({end})"), values[0]);
            example.expect(&format!("dp({end})"), values[1]);
            let tangents = curve.end_tangents().unwrap();
            let unit = if t == 0.0 { tangents.start } else { tangents.end };
            assert!((unit - values[1].normalize()).length() < 1e-15, "2.2-a: direction at {t}");
        }
    }),
    ("2.2-b", |example| {
        let curve = plane_curve(example);
        example.expect("polygon_box", curve.polygon_box());
        example.expect("tight_box", curve.tight_box());
    }),
    ("2.2-c", |example| {
        let (rows, a) = (example.rows("A"), example.numbers("a"));
        let map = |p: DVec2| {
            DVec2::new(rows[0][0] * p.x + rows[0][1] * p.y + a[0], rows[1][0] * p.x + rows[1][1] * p.y + a[1])
        };
        let image = plane_curve(example).transformed(map).unwrap();
        example.expect("C_image", image.points());
        example.expect("p_image", image.evaluate(example.number("t")).unwrap());
        example.expect("p_image", map(plane_curve(example).evaluate(example.number("t")).unwrap()));
    }),
    ("2.2-d", |example| {
        let curve = plane_curve(example);
        let crossings: Vec<_> =
            example.numbers("y").into_iter().map(|y| curve.crossings(DVec2::Y, y).unwrap()).collect();
        example.expect("polygon", crossings.iter().map(|c| c.polygon).collect::<Vec<_>>());
        let zeros = |i: usize| crossings[i].curve.isolated();
        example.expect("curve", (0..crossings.len()).map(|i| zeros(i).len()).collect::<Vec<_>>());
        example.expect("t", zeros(0).iter().map(|zero| zero.at).collect::<Vec<_>>());
    }),
    ("2.2-e", |example| {
        let curve = BezierCurve::new(example.points("C_reversed")).unwrap();
        let t = example.number("t");
        example.expect("p", curve.evaluate(t).unwrap());
        example.expect("p", curve.reversed().evaluate(1.0 - t).unwrap());
    }),
    ("2.2-f", |example| {
        let (mut factors, mut distances) = (Vec::new(), Vec::new());
        for c in example.rows("c") {
            let curve = BezierCurve::new(c).unwrap();
            let n = curve.degree();
            factors.push(polygon_distance_factor(n));
            let gap = |i: usize| {
                let place = i as f64 / 840.0 * n as f64;
                let k = (place as usize).min(n - 1);
                let share = place - k as f64;
                let corner = (1.0 - share) * curve.points()[k] + share * curve.points()[k + 1];
                (curve.evaluate(i as f64 / 840.0).unwrap() - corner).abs()
            };
            let largest = (0..=840).map(gap).fold(0.0, f64::max);
            assert!((largest - curve.polygon_distance_bound()).abs() < 1e-12, "2.2-f: the bound is attained");
            distances.push(largest);
        }
        example.expect("N", factors);
        example.expect("max_distance", distances);
    }),
    ("2.2-g", |example| {
        let values = plane_curve(example).derivatives(example.number("t"), 1).unwrap();
        example.expect("p", values[0]);
        example.expect("dp", values[1]);
    }),
    ("2.3-a", |example| {
        let scheme = plane_curve(example).de_casteljau_scheme(example.number("t")).unwrap();
        for (m, level) in scheme.levels().iter().enumerate().skip(1) {
            example.expect(&format!("m{m}"), level.as_slice());
        }
    }),
    ("2.3-b", scalar_scheme),
    ("2.3-c", scalar_scheme),
    ("2.3-d", |example| {
        let curve = BezierCurve::new(example.numbers("c")).unwrap();
        example.expect("p", values(&curve, &example.numbers("t")));
    }),
    ("2.3-e", |example| {
        let (curve, arguments) = (plane_curve(example), example.numbers("args"));
        example.expect("b", curve.blossom(&arguments).unwrap());
        let swapped: Vec<f64> = arguments.iter().rev().copied().collect();
        example.expect("b", curve.blossom(&swapped).unwrap());
        example.expect("diag", curve.blossom(&[arguments[0]; 2]).unwrap());
        example.expect("diag", curve.evaluate(arguments[0]).unwrap());
    }),
    ("2.3-f", |example| {
        let once = plane_curve(example).elevate_degree();
        example.expect("n3", once.points());
        example.expect("n4", once.elevate_degree().points());
    }),
    ("2.3-g", |example| {
        let points = (0..=example.count("n")).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let curve = BezierCurve::new(points).unwrap();
        example.expect("p", values(&curve, &example.numbers("t")));
    }),
    ("2.3-h", |example| {
        let curve = BezierCurve::new(example.numbers("c")).unwrap();
        let result = curve.de_casteljau_scheme(example.number("t"));
        example.expect_error(result.as_ref().map_err(BezierError::name));
    }),
    ("2.4-a", |example| {
        let curve = plane_curve(example);
        for order in 1..=3 {
            example.expect(&format!("d{order}"), curve.hodograph(order).unwrap().points());
        }
    }),
    ("2.4-b", |example| {
        let values = plane_curve(example).derivatives(example.number("t"), 2).unwrap();
        example.expect("dp", values[1]);
        example.expect("d2p", values[2]);
    }),
    ("2.4-c", |example| {
        let (curve, m) = (plane_curve(example), example.count("m"));
        example.expect("d3", curve.derivatives(example.number("t"), m).unwrap()[m]);
        example.expect("d3", curve.hodograph(m).unwrap().evaluate(example.number("t")).unwrap());
    }),
    ("2.4-d", |example| {
        let (h, next) = (example.number("h_left"), example.number("h_right"));
        let curve = BezierCurve::on_interval(example.points("C"), (0.0, h)).unwrap();
        for (k, point) in curve.continuation(next, 2).unwrap().into_iter().enumerate() {
            example.expect(&format!("c{k}"), point);
        }
        let mut points = curve.continuation(next, 2).unwrap();
        points.push(DVec2::new(7.0, 7.0));
        let right = BezierCurve::on_interval(points, (h, h + next)).unwrap();
        assert_eq!(curve.continuity(&right, 1e-12), Ok(Some(2)), "2.4-d: the joint");
    }),
    ("2.4-e", |example| {
        let interval = example.numbers("interval");
        let curve = BezierCurve::on_interval(example.points("C"), (interval[0], interval[1])).unwrap();
        let values = curve.derivatives(example.number("x"), 2).unwrap();
        example.expect("dp", values[1]);
        example.expect("d2p", values[2]);
    }),
    ("2.5-a", |example| {
        let curve = plane_curve(example);
        example.expect("kappa", curve.curvature(example.number("t")).unwrap());
        example.expect("kappa", curve.end_curvatures().unwrap()[0]);
    }),
    ("2.5-b", |example| {
        let (curve, t) = (plane_curve(example), example.number("t"));
        let circle = curve.osculating_circle(t).unwrap().unwrap();
        example.expect("kappa", curve.curvature(t).unwrap());
        example.expect("radius", circle.radius);
        example.expect("center", circle.center);
    }),
    ("2.5-c", |example| {
        let k = example.number("k");
        let points = vec![DVec2::X, DVec2::new(1.0, k), DVec2::new(k, 1.0), DVec2::Y];
        let curve = BezierCurve::new(points).unwrap();
        example.expect("kappa(0)", curve.curvature(0.0).unwrap());
        example.expect("max_radius_error", radius_error(&curve));
    }),
    ("2.5-d", |example| {
        let points = example.rows("C").into_iter().map(|row| DVec3::new(row[0], row[1], row[2])).collect();
        let curve = BezierCurve::new(points).unwrap();
        example.expect("kappa(0)", curve.curvature(0.0).unwrap());
        example.expect("kappa(1)", curve.curvature(1.0).unwrap());
        example.expect("torsion(0)", curve.torsion(0.0).unwrap());
    }),
    ("2.5-e", |example| {
        let left = BezierCurve::new(example.points("left")).unwrap();
        let right = BezierCurve::new(example.points("right")).unwrap();
        let joint = geometric_joint(&left, &right, 1e-12).unwrap();
        example.expect("delta", joint.length_ratio);
        example.expect("area_left", joint.areas[0]);
        example.expect("area_right", joint.areas[1]);
        example.expect("kappa_left", joint.curvatures[0]);
        example.expect("kappa_right", joint.curvatures[1]);
        example.expect("geometric", joint.order.label());
        let parametric = left.continuity(&right, 1e-12).unwrap().unwrap();
        example.expect("parametric", format!("C{parametric}").as_str());
    }),
    ("2.5-f", |example| {
        let curve = plane_curve(example);
        example.expect("kappa(1/2)", curve.curvature(0.5).unwrap());
        example.expect("kappa(0)", curve.curvature(0.0).unwrap());
        let Inflections::At(inflections) = curve.inflections().unwrap() else {
            panic!("2.5-f: not straight")
        };
        example.expect("inflections", inflections);
        let comb = curve.curvature_comb(8, 1.0).unwrap();
        let side = |i: usize| (comb[i].tip - comb[i].root).dot(curve.frame(i as f64 / 8.0).unwrap().normal);
        assert!(side(2) > 0.0 && side(6) < 0.0, "2.5-f: the comb changes side");
    }),
    ("2.5-g", no_curvature),
    ("2.5-h", no_curvature),
    ("2.6-a", |example| {
        for n in example.numbers("n") {
            example.expect(&format!("n{n}"), subdivision_matrix(n as usize, example.number("s")));
        }
    }),
    ("2.6-b", |example| {
        let (left, right) = plane_curve(example).split(example.number("s")).unwrap();
        example.expect("left", left.points());
        example.expect("right", right.points());
    }),
    ("2.6-c", |example| {
        let interval = example.numbers("interval");
        let part = plane_curve(example).restricted(interval[0], interval[1]).unwrap();
        example.expect("C_seg", part.points());
    }),
    ("2.6-d", |example| {
        let s = example.number("s");
        example.expect("left", plane_curve(example).split_points(s).unwrap().0);
        example.expect("left", plane_curve(example).restricted(0.0, s).unwrap().points());
    }),
    ("2.6-e", |example| {
        let curve = |key: &str| BezierCurve::new(example.points(key)).unwrap();
        let found = curve("C1").intersections(&curve("C2"), 1e-10).unwrap();
        example.expect("points", found.iter().map(|hit| hit.point).collect::<Vec<_>>());
        for j in 0..2 {
            example.expect("t", found.iter().map(|hit| hit.parameters[j]).collect::<Vec<_>>());
        }
        assert!(found.iter().all(|hit| hit.contact == Contact::Crossing), "2.6-e: {found:?}");
    }),
    ("2.6-f", |example| {
        let (left, right) = plane_curve(example).split_points(example.number("s")).unwrap();
        example.expect("left", left);
        example.expect("right", right);
    }),
    ("2.6-g", |example| {
        let second = |curve: &BezierCurve<DVec2>| {
            let points = curve.points().windows(3).map(|c| (c[0] - 2.0 * c[1] + c[2]).abs().max_element());
            points.fold(0.0, f64::max)
        };
        let level = |levels| {
            let parts = plane_curve(example).subdivided(levels).unwrap();
            parts.iter().map(second).fold(0.0, f64::max)
        };
        example.expect("max_d2", (0..=example.count("levels")).map(level).collect::<Vec<_>>());
    }),
    ("2.7-a", |example| {
        assert_eq!(example.input("data"), "circle", "2.7-a: the data");
        for theta in [0.3, 0.7, 1.1_f64] {
            let alpha =
                -(2.0 * theta).sin() + ((2.0 * theta).sin().powi(2) + 12.0 * theta.sin().powi(2)).sqrt();
            let speeds = arc(theta).speeds;
            assert!(
                (speeds[0] - alpha).abs() < 1e-10 && (speeds[1] - alpha).abs() < 1e-10,
                "2.7-a: {speeds:?} for {alpha}"
            );
        }
        let alpha = speed_series();
        example.expect("alpha_series", vec![alpha[1], alpha[3], alpha[5]]);
        example.expect("error_coeffs", error_coefficients(&alpha));
    }),
    ("2.7-b", |example| {
        let solution = solutions(example).unwrap().swap_remove(0);
        example.expect("alpha", solution.speeds[0]);
        example.expect("alpha", solution.speeds[1]);
        example.expect("c1", solution.curve.points()[1]);
        example.expect("max_radius_error", radius_error(&solution.curve));
    }),
    ("2.7-c", |example| {
        let thetas = example.numbers("theta");
        let errors: Vec<f64> = thetas.iter().map(|&theta| radius_error(&arc(theta).curve)).collect();
        let scaled = errors.iter().zip(&thetas).map(|(error, theta)| error * 128.0 / theta.powi(6));
        example.expect("error_times_128_over_theta^6", scaled.collect::<Vec<_>>());
        example.expect("ratio", errors[0] / errors[1]);
    }),
    ("2.7-d", first_solution),
    ("2.7-e", |example| {
        let mut speeds: Vec<[f64; 2]> = solutions(example).unwrap().iter().map(|s| s.speeds).collect();
        assert!((speeds[0][0] - speeds[0][1]).abs() < 1e-12, "2.7-e: the most equal speeds come first");
        speeds.sort_by(|p, q| p[0].total_cmp(&q[0]));
        example.expect("solutions", speeds.iter().map(|pair| pair.to_vec()).collect::<Vec<_>>());
    }),
    ("2.7-f", first_solution),
    ("2.7-g", first_solution),
    ("2.7-h", no_solution),
    ("2.7-i", no_solution),
    ("2.7-j", first_solution),
    ("2.7-k", no_solution),
];

fn plane_curve(example: &Example) -> BezierCurve<DVec2> {
    BezierCurve::new(example.points("C")).unwrap()
}

fn value(example: &Example) {
    example.expect("p", plane_curve(example).evaluate(example.number("t")).unwrap());
}

fn values(curve: &BezierCurve<f64>, parameters: &[f64]) -> Got {
    parameters.iter().map(|&t| curve.evaluate(t).unwrap()).collect::<Vec<_>>().into()
}

fn rows_are_refused(example: &Example) {
    let result = BezierCurve::from_rows(&example.rows("C"));
    example.expect_error(result.as_ref().map_err(BezierError::name));
}

fn scalar_scheme(example: &Example) {
    let curve = BezierCurve::new(example.numbers("c")).unwrap();
    let scheme = curve.de_casteljau_scheme(example.number("t")).unwrap();
    for (m, level) in scheme.levels().iter().enumerate().skip(1) {
        example.expect(&format!("m{m}"), level.as_slice());
    }
}

fn no_curvature(example: &Example) {
    let result = plane_curve(example).curvature(example.number("t"));
    example.expect_error(result.as_ref().map_err(BezierError::name));
}

/// Largest distance from the unit circle.
fn radius_error(curve: &BezierCurve<DVec2>) -> f64 {
    let gap = |i: u32| (curve.evaluate(f64::from(i) / 20_000.0).unwrap().length() - 1.0).abs();
    (0..=20_000).map(gap).fold(0.0, f64::max)
}

/// The interpolant of the unit circle between the angles `−theta` and `theta`.
fn arc(theta: f64) -> GeometricHermite {
    let end = |angle: f64| {
        let point = DVec2::from_angle(angle);
        EndData { point, direction: point.perp(), curvature: 1.0 }
    };
    geometric_hermite(end(-theta), end(theta)).unwrap().swap_remove(0)
}

fn solutions(example: &Example) -> Result<Vec<GeometricHermite>, BezierError> {
    let (points, directions, curvatures) =
        (example.points("f"), example.points("d"), example.numbers("kappa"));
    let end = |j: usize| EndData { point: points[j], direction: directions[j], curvature: curvatures[j] };
    geometric_hermite(end(0), end(1))
}

fn first_solution(example: &Example) {
    let all = solutions(example).unwrap();
    assert_eq!(all.len(), 1, "{}: one solution", example.id);
    example.expect("alpha", all[0].speeds.to_vec());
    example.expect("C", all[0].curve.points());
}

fn no_solution(example: &Example) {
    let result = solutions(example);
    example.expect_error(result.as_ref().map_err(BezierError::name));
}

/// A power series in the half angle `theta`, to the order 9.
type Series = [f64; 10];

fn times(a: &Series, b: &Series) -> Series {
    std::array::from_fn(|n| (0..=n).map(|i| a[i] * b[n - i]).sum())
}

fn sine(frequency: f64) -> Series {
    let mut term = 1.0;
    std::array::from_fn(|n| {
        if n > 0 {
            term *= frequency / n as f64;
        }
        [0.0, term, 0.0, -term][n % 4]
    })
}

fn cosine() -> Series {
    let mut term = 1.0;
    std::array::from_fn(|n| {
        if n > 0 {
            term /= n as f64;
        }
        [term, 0.0, -term, 0.0][n % 4]
    })
}

/// `α = −sin 2θ + √(sin² 2θ + 12 sin² θ)` as a power series in `θ`; the root is `θ √(16 + …)`.
fn speed_series() -> Series {
    let (once, twice) = (sine(1.0), sine(2.0));
    let (a, b) = (times(&once, &once), times(&twice, &twice));
    let radicand: Vec<f64> = (2..10).map(|n| b[n] + 12.0 * a[n]).collect();
    let mut root = vec![radicand[0].sqrt()];
    for n in 1..radicand.len() {
        let known: f64 = (1..n).map(|i| root[i] * root[n - i]).sum();
        root.push((radicand[n] - known) / (2.0 * root[0]));
    }
    std::array::from_fn(|n| if n == 0 || n > root.len() { 0.0 } else { root[n - 1] - twice[n] })
}

/// Coefficients of `θ⁶ t³ … θ⁶ t⁶` in `1 − |p(t)|²` for the cubic with the speeds `alpha` between the angles `∓θ`.
fn error_coefficients(alpha: &Series) -> Vec<f64> {
    let third: Series = alpha.map(|a| a / 3.0);
    let (cos, sin) = (cosine(), sine(1.0));
    let sum =
        |a: &Series, b: &Series, factor: f64| -> Series { std::array::from_fn(|n| a[n] + factor * b[n]) };
    // Control points (cos, ∓ sin) and those a third of the speed along the tangents (± sin, cos).
    let x = [cos, sum(&cos, &times(&third, &sin), 1.0)];
    let y = [sin.map(|s| -s), sum(&times(&third, &cos), &sin, -1.0)];
    let x = [x[0], x[1], x[1], x[0]];
    let y = [y[0], y[1], y[1].map(|s| -s), y[0].map(|s| -s)];
    // Of θ⁶ in the Bernstein coefficients of 1 − |p|², degree 6.
    let binomial = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let mut c = vec![0.0; 7];
    for i in 0..4 {
        for j in 0..4 {
            let product = times(&x[i], &x[j])[6] + times(&y[i], &y[j])[6];
            c[i + j] -= product * binomial(3, i) * binomial(3, j) / binomial(6, i + j);
        }
    }
    BezierCurve::new(c).unwrap().monomial()[3..].to_vec()
}
