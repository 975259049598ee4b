//! Beyond the course: intersections (B.6).

use glam::DVec2;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::rational_bezier::RationalBezier;
use spline_lab::core::spline_curve::{CurveIntersection, Meeting, Nurbs};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.6-a", |example| {
        let curve = bezier(example, "C");
        let lines = example.numbers("y");
        let found: Vec<_> =
            lines.iter().map(|&y| curve.intersect_line(DVec2::Y, y, 1e-12).unwrap()).collect();
        let all = |hits: &Vec<_>, of: fn(&_) -> _| hits.iter().map(of).collect::<Vec<_>>();
        example.expect("t", found.iter().map(|hits| all(hits, |hit| hit.parameter)).collect::<Vec<_>>());
        let kinds = found.iter().map(|hits| hits.iter().map(|hit| name(hit.meeting)).collect());
        example.expect("kinds", kinds.collect::<Vec<Vec<&str>>>());
    }),
    ("B.6-b", |example| {
        let found = bezier(example, "C1").intersections(&bezier(example, "C2"), 1e-10).unwrap();
        expect_points(example, &found);
        example.expect("kinds", found.iter().map(|hit| name(hit.meeting)).collect::<Vec<_>>());
    }),
    ("B.6-c", |example| {
        let curve = RationalBezier::new(example.points("C"), vec![1.0; 4]).unwrap();
        let part = |ends: &Vec<f64>| {
            let part = curve.restricted(ends[0], ends[1]).unwrap();
            let unit = RationalBezier::new(part.points().to_vec(), part.weights().to_vec()).unwrap();
            Nurbs::from_rational_bezier_curves(&[unit]).unwrap()
        };
        let [one, other] = [0, 1].map(|k| part(&example.rows("intervals")[k]));
        let found = one.intersections(&other, 1e-10).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        let Meeting::Overlap { first, second } = found[0].meeting else { panic!("{found:?}") };
        example.expect("kind", name(found[0].meeting));
        example.expect("t", first.as_slice());
        example.expect("u", second.as_slice());
    }),
    ("B.6-d", |example| {
        let arc = |key: &str| {
            let piece = RationalBezier::new(example.points(key), example.numbers("w")).unwrap();
            Nurbs::from_rational_bezier_curves(&[piece]).unwrap()
        };
        expect_points(example, &arc("C1").intersections(&arc("C2"), 1e-12).unwrap());
    }),
    ("B.6-e", |example| {
        let found = bezier(example, "C1").intersections(&bezier(example, "C2"), 1e-12).unwrap();
        let mut points: Vec<DVec2> = found.iter().map(|hit| hit.point).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        example.expect("x", points.iter().map(|point| point.x).collect::<Vec<_>>());
        example.expect("y", points.iter().map(|point| point.y).collect::<Vec<_>>());
        example.expect("count", points.len());
    }),
    ("B.6-f", |example| {
        expect_points(example, &bezier(example, "C").self_intersections(1e-12).unwrap());
    }),
    ("B.6-g", |example| {
        let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
        let curve = Nurbs::polynomial(space, example.points("c")).unwrap();
        let found = curve.intersect_line(DVec2::Y, example.number("y"), 1e-12).unwrap();
        example.expect("t", found.iter().map(|hit| hit.parameter).collect::<Vec<_>>());
        example.expect("x", found.iter().map(|hit| hit.point.x).collect::<Vec<_>>());
    }),
];

fn bezier(example: &Example, key: &str) -> Nurbs<DVec2> {
    let points = example.points(key);
    let weights = vec![1.0; points.len()];
    Nurbs::from_rational_bezier_curves(&[RationalBezier::new(points, weights).unwrap()]).unwrap()
}

fn expect_points(example: &Example, found: &[CurveIntersection]) {
    example.expect("points", found.iter().map(|hit| hit.point).collect::<Vec<_>>());
    example.expect("t", found.iter().map(|hit| hit.parameters[0]).collect::<Vec<_>>());
    example.expect("u", found.iter().map(|hit| hit.parameters[1]).collect::<Vec<_>>());
}

fn name(meeting: Meeting) -> &'static str {
    match meeting {
        Meeting::Crossing => "crossing",
        Meeting::Tangent => "tangent",
        Meeting::EndPoint => "end",
        Meeting::Overlap { .. } => "overlap",
    }
}
