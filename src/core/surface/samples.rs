//! Surfaces of the course with their own names, for tests, lessons and the window. Course: sections 8.1 and 8.2.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_6, TAU};

use glam::DVec3;

use crate::core::bspline::SplineSpace;
use crate::core::surface::nurbs_surface::NurbsSurface;
use crate::core::surface::spline_surface::SplineSurface;
use crate::core::tensor::{TensorSpline, TensorSplineSpace};

fn surface(u: SplineSpace, v: SplineSpace, point: impl Fn(usize, usize) -> DVec3) -> SplineSurface {
    let space = TensorSplineSpace::new([u, v]).expect("two directions");
    let points = (0..space.dimension()).map(|place| {
        let [row, column] = space.multi_index(place);
        point(row, column)
    });
    TensorSpline::new(space.clone(), points.collect()).expect("finite points, one for each B-spline")
}

fn uniform(degree: usize, knots: std::ops::RangeInclusive<i32>) -> SplineSpace {
    SplineSpace::new(degree, knots.map(f64::from).collect()).expect("increasing knots")
}

/// The helical staircase of degree (1, 3) over `[1, 2] × [3, 11]`: two turns, ruled, of height `v − 2`.
pub fn helical_staircase() -> SplineSurface {
    surface(uniform(1, 0..=3), uniform(3, 0..=14), |row, column| {
        let (radius, angle) = (1.0 + row as f64, FRAC_PI_2 * column as f64);
        DVec3::new(radius * quarter_cosine(column), radius * quarter_cosine(column + 3), angle / FRAC_PI_2)
    })
}

/// `cos(k π/2)` without rounding.
fn quarter_cosine(k: usize) -> f64 {
    [1.0, 0.0, -1.0, 0.0][k % 4]
}

/// The biquadratic torus of period 4 in both directions with 4 × 4 control points; `r_u × r_v` points inwards.
///
/// Its tube is not round: half width `√2/2`, half height 1.
pub fn torus() -> SplineSurface {
    // The B-spline number k has the support [k, k + 3].
    let line = SplineSpace::periodic(2, 4.0, vec![0.0, 1.0, 2.0, 3.0]).expect("four knots in a period of 4");
    let profile = [[1.0, -1.0], [3.0, -1.0], [3.0, 1.0], [1.0, 1.0]];
    surface(line.clone(), line, |row, column| {
        let [radius, height] = profile[row];
        DVec3::new(radius * quarter_cosine(column), radius * quarter_cosine(column + 3), height)
    })
}

/// The surface of degree (2, 3) that is closed in v (period 3) and has a singular tip at `u = 1`; u runs from 1 to 3.
///
/// Column `k` belongs to the B-spline with the support `[k − 3, k + 1]`, which is number `k − 3` of the sequence that starts at 0: the columns
/// of the net are those of the course, in that order.
pub fn partially_closed() -> SplineSurface {
    let knots = vec![0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 4.0];
    let u = SplineSpace::new(2, knots).expect("regular knots");
    let v = SplineSpace::periodic(3, 3.0, vec![0.0, 1.0, 2.0]).expect("three knots in a period of 3");
    surface(u, v, |row, column| {
        let (angle, radius) = (TAU * column as f64 / 3.0, (FRAC_PI_6 * row as f64).sin());
        DVec3::new(row as f64 / 3.0, radius * angle.sin(), radius * angle.cos())
    })
}

/// The octant of the unit sphere over `[0, 1]²`: u is the longitude, v runs from the pole to the equator; `r_u × r_v` points inwards.
pub fn sphere_octant() -> NurbsSurface {
    let line = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).expect("end-interpolating knots");
    let arc = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let w = [1.0, FRAC_1_SQRT_2, 1.0];
    let space = TensorSplineSpace::new([line.clone(), line]).expect("two directions");
    let nine = (0..9).map(|place| (place / 3, place % 3));
    let points =
        nine.clone().map(|(i, j)| DVec3::new(arc[i][0] * arc[j][1], arc[i][1] * arc[j][1], arc[j][0]));
    let weights = nine.map(|(i, j)| w[i] * w[j]);
    NurbsSurface::new(space, points.collect(), weights.collect()).expect("finite points and positive weights")
}

/// The unit sphere over `[0, 4] × [0, 2]`: u is the longitude in quarters, v runs from the south pole to the north; `r_u × r_v` points
/// outwards. At the poles a row of the net is one point.
pub fn sphere() -> NurbsSurface {
    let around = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0]];
    let up = [[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    // Quarters of a circle: double knots, and every other point is a corner of the square around it.
    let quarters = |count: i32| {
        let inner = (0..=count).flat_map(|k| [f64::from(k); 2]);
        let knots = std::iter::once(-1.0).chain(inner).chain([f64::from(count + 1)]).collect();
        SplineSpace::new(2, knots).expect("end-interpolating knots")
    };
    let weight = |k: usize| if k.is_multiple_of(2) { 1.0 } else { FRAC_1_SQRT_2 };
    let space = TensorSplineSpace::new([quarters(4), quarters(2)]).expect("two directions");
    let net = (0..9).flat_map(|i| (0..5).map(move |j| (i, j)));
    let points = net.clone().map(|(i, j)| {
        // The second half of the circle is the first, turned by half a turn.
        let [x, y] = if i < 5 { around[i] } else { around[i - 4].map(|coordinate| -coordinate) };
        DVec3::new(x * up[j][0], y * up[j][0], up[j][1])
    });
    let weights = net.map(|(i, j)| weight(i) * weight(j));
    NurbsSurface::new(space, points.collect(), weights.collect()).expect("finite points and positive weights")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;

    #[test]
    fn the_sphere_is_round_and_its_normals_point_outwards() {
        let sphere = sphere();
        for (u, v) in (0..=16).flat_map(|i| (1..8).map(move |j| (f64::from(i) / 4.0, f64::from(j) / 4.0))) {
            let point = sphere.evaluate([u, v]).unwrap();
            assert!((point.length() - 1.0).abs() < 1e-14, "{point} at ({u}, {v})");
            assert!(sphere.normal([u, v]).unwrap().distance(point) < 1e-12, "the normal at ({u}, {v})");
        }
        let volume = sphere.enclosed_volume().unwrap();
        assert!((volume - 2.0 / 3.0 * TAU).abs() < 1e-12, "{volume}");
    }
}
