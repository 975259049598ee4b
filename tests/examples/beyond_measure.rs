//! Beyond the course: closest points (B.5), inflections, vertices, boxes, torsion (B.7).

use glam::{DVec2, DVec3};
use spline_lab::core::bspline::{EndKnots, Side, SplineError, SplineSpace};
use spline_lab::core::point::Point as _;
use spline_lab::core::polynomial::bernstein_product;
use spline_lab::core::rational_bezier::Projective;
use spline_lab::core::spline_curve::{ClosestPoint, Nurbs, VertexKind};

use crate::example::Example;

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("B.5-a", |example| {
        let found = closest(example, None).unwrap();
        example.expect("t", found.iter().map(|hit| hit.parameter).collect::<Vec<_>>());
        example.expect("points", found.iter().map(|hit| hit.point).collect::<Vec<_>>());
        example.expect("dist", found[0].distance);
    }),
    ("B.5-b", |example| {
        let found = closest(example, None).unwrap();
        example.expect("t", found.iter().map(|hit| hit.parameter).collect::<Vec<_>>());
        example.expect("dist", found[0].distance);
    }),
    ("B.5-c", |example| {
        let found = closest(example, Some(example.numbers("w"))).unwrap();
        example.expect("t", found.iter().map(|hit| hit.parameter).collect::<Vec<_>>());
        example.expect("points", found.iter().map(|hit| hit.point).collect::<Vec<_>>());
        example.expect("dist", found[0].distance);
    }),
    ("B.5-d", |example| {
        let found = closest(example, None).unwrap();
        example.expect("t", found.iter().map(|hit| hit.parameter).collect::<Vec<_>>());
        example.expect("dist", found[0].distance);
    }),
    ("B.5-e", |example| {
        let q = DVec2::from_slice(&example.numbers("q"));
        let away: Vec<DVec2> = example.points("C").iter().map(|point| *point - q).collect();
        let square = |axis: usize| {
            let x: Vec<f64> = away.iter().map(|point| point.coordinate(axis)).collect();
            bernstein_product(&x, &x).unwrap()
        };
        let squared: Vec<f64> = square(0).iter().zip(square(1)).map(|(x, y)| x + y).collect();
        example.expect("lower", squared.iter().copied().fold(f64::INFINITY, f64::min));
        example.expect("coeffs", squared);
        let nearest = curve(example.points("C"), None).closest_point(q).unwrap();
        example.expect("min", nearest.distance * nearest.distance);
    }),
    ("B.5-f", |example| {
        let found = closest(example, Some(example.numbers("w")));
        example.expect_error(found.as_ref().map_err(SplineError::name));
    }),
    ("B.7-a", |example| {
        let curve = curve(example.points("C"), None);
        let tight = curve.tight_box().unwrap();
        example.expect("box", vec![tight.low, tight.high]);
        let mut extreme = tight.parameters[1];
        extreme.sort_by(f64::total_cmp);
        example.expect("t_extreme_y", extreme.as_slice());
        example.expect("inflections", curve.inflections().unwrap().parameters);
    }),
    ("B.7-b", |example| {
        let curve = curve(example.points("C"), None);
        example.expect("numerator", curve.curvature_changes().unwrap()[0].coefficients.as_slice());
        let found = curve.vertices().unwrap().vertices;
        let inner: Vec<_> = found.iter().filter(|vertex| vertex.kind != VertexKind::End).collect();
        example.expect("t", inner.iter().map(|vertex| vertex.parameter).collect::<Vec<_>>());
        example.expect("kappa", inner.iter().map(|vertex| vertex.curvatures[0]).collect::<Vec<_>>());
    }),
    ("B.7-c", |example| {
        let frame = curve(space_points(example), None).frame(example.number("t"), Side::Left).unwrap();
        example.expect("kappa", frame.curvature);
        example.expect("tau", frame.torsion);
        for (key, direction) in [("T", frame.tangent), ("N", frame.normal), ("B", frame.binormal)] {
            example.expect(key, direction.to_array().as_slice());
        }
    }),
    ("B.7-d", |example| {
        let found = curve(example.points("C"), Some(example.numbers("w"))).vertices().unwrap().vertices;
        example.expect("vertices", found.iter().map(|vertex| vertex.parameter).collect::<Vec<_>>());
        example.expect("kappa", found.iter().map(|vertex| vertex.curvatures[0]).collect::<Vec<_>>());
    }),
    ("B.7-e", |example| {
        let tight = curve(example.points("C"), Some(example.numbers("w"))).tight_box().unwrap();
        example.expect("box", vec![tight.low, tight.high]);
    }),
    ("B.7-f", |example| {
        let frame = curve(space_points(example), None).frame(example.number("t"), Side::Right);
        example.expect_error(frame.as_ref().map_err(SplineError::name));
    }),
];

/// The Bezier curve over `[0, 1]`.
fn curve<P: Projective>(points: Vec<P>, weights: Option<Vec<f64>>) -> Nurbs<P> {
    let space = SplineSpace::from_breaks(points.len() - 1, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
    let weights = weights.unwrap_or_else(|| vec![1.0; points.len()]);
    Nurbs::new(space, points, weights).unwrap()
}

fn closest(example: &Example, weights: Option<Vec<f64>>) -> Result<Vec<ClosestPoint<DVec2>>, SplineError> {
    let place = DVec2::from_slice(&example.numbers("q"));
    curve(example.points("C"), weights).closest_points(place, 1e-9)
}

fn space_points(example: &Example) -> Vec<DVec3> {
    example.rows("C").iter().map(|row| DVec3::from_slice(row)).collect()
}
