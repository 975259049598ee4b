//! From the equation of a conic to rational quadratic curves and back.
//!
//! In barycentric coordinates `λ` of the control triangle the conic is `4 w₁² λ₀ λ₂ = w₀ w₂ λ₁²`. The other way the middle point is the intersection of
//! the tangents, the pole of the chord, and `w₁² = −(z₀ A z₂)/(2 z₁ A z₁)` in standard form. Course: section 3.4.

use glam::{DVec2, DVec3};

use crate::core::rational_bezier::RationalBezier;
use crate::core::rational_bezier::conic::{Conic, ConicKind, DegenerateConic};
use crate::core::rational_bezier::error::{RationalBezierError, check_finite};

/// Largest residual of a point that counts as one of the conic.
const ON_CONIC: f64 = 1e-10;
/// Sines of angles up to this are those of parallel lines.
const PARALLEL: f64 = 1e-12;

impl Conic {
    /// The conic through the extended rational quadratic curve with these control points and weights of any sign.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for collinear points or a weight 0.
    pub fn from_control_points(points: [DVec2; 3], weights: [f64; 3]) -> Result<Self, RationalBezierError> {
        check_finite("weight", &weights)?;
        if let Some(index) = points.iter().position(|point| !point.is_finite()) {
            let value = points[index].length();
            return Err(RationalBezierError::NonFinite { what: "control point", index, value });
        }
        if let Some(index) = weights.iter().position(|&weight| weight == 0.0) {
            return Err(RationalBezierError::Degenerate { what: "the conic of weight", value: index as f64 });
        }
        // About the middle point and in units of the triangle, so that no digits are lost far out.
        let size = points.iter().map(|point| point.distance(points[1])).fold(0.0, f64::max);
        let [p, q] = [(points[0] - points[1]) / size, (points[2] - points[1]) / size];
        let area = p.perp_dot(q);
        if area.is_nan() || area.abs() <= PARALLEL * p.length() * q.length() {
            return Err(RationalBezierError::Degenerate { what: "the triangle", value: area });
        }
        // λ₀, λ₂ vanish on the edges through the middle point, λ₁ is what is missing to 1.
        let first = DVec3::new(q.y, -q.x, 0.0) / area;
        let last = DVec3::new(-p.y, p.x, 0.0) / area;
        let middle = DVec3::Z - first - last;
        let factor = 2.0 * weights[1] / weights[0] * (weights[1] / weights[2]);
        let entry =
            |i: usize, j: usize| factor * (first[i] * last[j] + first[j] * last[i]) - middle[i] * middle[j];
        // Back: with z = (x − m, s)/s the entry a₃₃ is that of the origin.
        let shift = points[1];
        let [a, b, c] = [entry(0, 0), entry(0, 1), entry(1, 1)];
        let [d, e, f] = [entry(0, 2) * size, entry(1, 2) * size, entry(2, 2) * size * size];
        let quadratic = DVec2::new(a * shift.x + b * shift.y, b * shift.x + c * shift.y);
        let constant = quadratic.dot(shift) - 2.0 * (d * shift.x + e * shift.y) + f;
        Self::new([a, b, d - quadratic.x, c, e - quadratic.y, constant])
    }

    /// The arc from `start` to `end` inside the triangle of the tangents there, in standard form with a positive middle weight.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `NotOnCurve` with index 0 or 2 for a point off the conic; `Degenerate` for parallel tangents, points on different branches,
    /// equal points or a degenerate conic.
    pub fn arc(&self, start: DVec2, end: DVec2) -> Result<RationalBezier<DVec2>, RationalBezierError> {
        for (index, place) in [(0, start), (2, end)] {
            check_finite("coordinate", &place.to_array())?;
            let residual = self.residual(place);
            if residual.is_nan() || residual > ON_CONIC {
                return Err(RationalBezierError::NotOnCurve { index, residual });
            }
        }
        let degenerate = |what, value| Err(RationalBezierError::Degenerate { what, value });
        let matrix = self.matrix();
        let (first, last) = (start.extend(1.0), end.extend(1.0));
        let tangents = [matrix * first, matrix * last];
        let normals = tangents.map(|line| line.truncate());
        let meeting = tangents[0].cross(tangents[1]);
        let sine = normals[0].perp_dot(normals[1]) / (normals[0].length() * normals[1].length());
        if sine.is_nan() || sine.abs() <= PARALLEL {
            return degenerate("the intersection of the tangents", sine);
        }
        let middle = meeting.truncate() / meeting.z;
        let pole = middle.extend(1.0);
        let square = -first.dot(matrix * last) / (2.0 * pole.dot(matrix * pole));
        if square.is_nan() || square <= 0.0 {
            return degenerate("the arc between different branches", square);
        }
        RationalBezier::new(vec![start, middle, end], vec![1.0, square.sqrt(), 1.0])
    }

    /// Arcs that cover the part of the conic in the box from `low` to `high`; they may reach beyond it.
    ///
    /// Four quarters of an ellipse, one arc of a parabola, one for each branch of a hyperbola; none where the conic misses the box.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` unless `low < high`; `Degenerate` for a degenerate conic other than an empty one.
    pub fn arcs_in_box(
        &self,
        low: DVec2,
        high: DVec2,
    ) -> Result<Vec<RationalBezier<DVec2>>, RationalBezierError> {
        check_finite("coordinate", &[low.x, low.y, high.x, high.y])?;
        for (value, right) in [(low.x, high.x), (low.y, high.y)] {
            if value >= right {
                let left = f64::NEG_INFINITY;
                return Err(RationalBezierError::OutsideInterval { what: "corner", value, left, right });
            }
        }
        let corners = [low, high, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y)];
        let range = |origin: DVec2, direction: DVec2| {
            let at = corners.map(|corner| (corner - origin).dot(direction));
            (at.into_iter().fold(f64::INFINITY, f64::min), at.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        match self.kind() {
            ConicKind::Ellipse => {
                let axes = self.axes()?;
                let [u, v] = [0, 1].map(|j| axes.directions[j] * axes.lengths[j]);
                let reach = DVec2::new(u.x.hypot(v.x), u.y.hypot(v.y));
                let (inner, outer) = (axes.center - reach, axes.center + reach);
                if inner.cmpgt(high).any() || outer.cmplt(low).any() {
                    return Ok(Vec::new());
                }
                let quarter = |u: DVec2, v: DVec2| {
                    let points = [u, u + v, v].map(|way| axes.center + way).to_vec();
                    RationalBezier::new(points, vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0])
                };
                [(u, v), (v, -u), (-u, -v), (-v, u)].into_iter().map(|(u, v)| quarter(u, v)).collect()
            }
            ConicKind::Parabola => {
                let frame = self.parabola_frame();
                let across = frame.axis.perp();
                let (from, to) = range(frame.vertex, across);
                if range(frame.vertex, frame.axis).1 < 0.0 {
                    return Ok(Vec::new());
                }
                // r = s²/(4 f); the tangents at s and s' meet at (s + s')/2 and s s'/(4 f).
                let at = |s: f64, product: f64| {
                    frame.vertex + across * s + frame.axis * (product / (4.0 * frame.focal_length))
                };
                let points = vec![at(from, from * from), at(0.5 * (from + to), from * to), at(to, to * to)];
                Ok(vec![RationalBezier::new(points, vec![1.0; 3])?])
            }
            ConicKind::Hyperbola => {
                let axes = self.axes()?;
                let [a, b] = axes.lengths;
                let (nearest, farthest) = range(axes.center, axes.directions[0]);
                let (from, to) = range(axes.center, axes.directions[1]);
                let mut arcs = Vec::new();
                for (side, reached) in [(1.0, farthest >= a), (-1.0, nearest <= -a)] {
                    if !reached {
                        continue;
                    }
                    // The branch (a cosh u, b sinh u); tangents meet at the mean of u, stretched, and w₁ = cosh of half the difference.
                    let (first, last) = ((from / b).asinh(), (to / b).asinh());
                    let (mean, half) = (0.5 * (first + last), 0.5 * (last - first));
                    let at = |u: f64, stretch: f64| {
                        let x = axes.directions[0] * (side * a * u.cosh() / stretch);
                        axes.center + x + axes.directions[1] * (b * u.sinh() / stretch)
                    };
                    let points = vec![at(first, 1.0), at(mean, half.cosh()), at(last, 1.0)];
                    arcs.push(RationalBezier::new(points, vec![1.0, half.cosh(), 1.0])?);
                }
                Ok(arcs)
            }
            ConicKind::Degenerate(DegenerateConic::Empty) => Ok(Vec::new()),
            ConicKind::Degenerate(_) => {
                Err(RationalBezierError::Degenerate { what: "an arc", value: self.discriminant() })
            }
        }
    }
}

impl RationalBezier<DVec2> {
    /// The conic that the curve is an arc of.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless the degree is 2; `Degenerate` for collinear control points.
    pub fn conic(&self) -> Result<Conic, RationalBezierError> {
        match (self.points(), self.weights()) {
            (&[a, b, c], &[u, v, w]) => Conic::from_control_points([a, b, c], [u, v, w]),
            (points, _) => {
                let found = points.len();
                Err(RationalBezierError::SizeMismatch {
                    what: "control points of a conic",
                    expected: 3,
                    found,
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle() -> impl Strategy<Value = [DVec2; 3]> {
        prop::array::uniform3((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from))
            .prop_filter("a proper triangle", |c| (c[0] - c[1]).perp_dot(c[2] - c[1]).abs() > 1.0)
    }

    proptest! {
        #[test]
        fn an_arc_of_its_conic_is_the_curve_again(points in triangle(), exponent in -2.0..2.0_f64, far in -1e4..1e4_f64, t in 0.0..=1.0_f64) {
            let points = points.map(|p| p + DVec2::splat(far));
            let w = exponent.exp();
            let curve = RationalBezier::new(points.to_vec(), vec![1.0, w, 1.0]).unwrap();
            let conic = curve.conic().unwrap();
            prop_assert!(conic.residual(curve.evaluate(t).unwrap()) < 1e-12, "points satisfy the equation");
            let near = RationalBezier::new(points.map(|p| p - DVec2::splat(far)).to_vec(), vec![2.0, 2.0 * w, 2.0]).unwrap();
            let again = near.conic().unwrap().arc(near.points()[0], near.points()[2]).unwrap();
            prop_assert!((again.points()[1] - near.points()[1]).length() < 1e-7, "middle {}", again.points()[1]);
            prop_assert!((again.weights()[1] / w - 1.0).abs() < 1e-7, "weight {} for {w}", again.weights()[1]);
        }

        #[test]
        fn the_equation_solves_the_linear_system_of_the_coefficients(points in triangle(), weights in prop::array::uniform3(0.2..4.0_f64)) {
            // z A zᵗ vanishes as a polynomial of degree 4: five equations for the six entries.
            let curve = RationalBezier::new(points.to_vec(), weights.to_vec()).unwrap();
            let [a, b, d, c, e, f] = curve.conic().unwrap().coefficients();
            let axis = |axis: usize| curve.homogeneous().0.points().iter().map(|h| h[axis]).collect::<Vec<f64>>();
            let (x, y, w) = (axis(0), axis(1), axis(2));
            let times = |p: &[f64], q: &[f64]| crate::core::polynomial::bernstein_product(p, q).unwrap();
            let terms = [(a, times(&x, &x)), (2.0 * b, times(&x, &y)), (2.0 * d, times(&x, &w)), (c, times(&y, &y)), (2.0 * e, times(&y, &w)), (f, times(&w, &w))];
            for k in 0..5 {
                let sum: f64 = terms.iter().map(|(factor, product)| factor * product[k]).sum();
                let size: f64 = terms.iter().map(|(factor, product)| (factor * product[k]).abs()).sum();
                prop_assert!(sum.abs() < 1e-12 * (size + 1.0), "equation {k}: {sum}");
            }
        }

        #[test]
        fn arcs_in_a_box_cover_the_conic_there(points in triangle(), w in -2.0..2.0_f64, t in -3.0..4.0_f64) {
            let weights = [1.0, w, 1.0];
            prop_assume!(w.abs() > 0.1 && (w.abs() - 1.0).abs() > 0.1);
            let conic = Conic::from_control_points(points, weights).unwrap();
            let b = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * w, t * t];
            let place = (points[0] * b[0] + points[1] * b[1] + points[2] * b[2]) / (b[0] + b[1] + b[2]);
            let inside = place.abs().max_element() < 6.0;
            prop_assume!(inside);
            let arcs = conic.arcs_in_box(DVec2::splat(-6.0), DVec2::splat(6.0)).unwrap();
            let near = |arc: &RationalBezier<DVec2>| {
                let line: Vec<DVec2> = (0..=400).map(|i| arc.evaluate(f64::from(i) / 400.0).unwrap()).collect();
                line.windows(2).any(|pair| {
                    let share = ((place - pair[0]).dot(pair[1] - pair[0]) / (pair[1] - pair[0]).length_squared()).clamp(0.0, 1.0);
                    place.distance(pair[0].lerp(pair[1], share)) < 0.05
                })
            };
            prop_assert!(arcs.iter().any(near), "{place} is on none of {} arcs", arcs.len());
            for arc in &arcs {
                prop_assert!(conic.residual(arc.evaluate(0.3).unwrap()) < 1e-9, "on the conic");
            }
        }
    }

    #[test]
    fn boxes_beside_the_conic_and_impossible_arcs() {
        let circle = Conic::new([1.0, 0.0, 0.0, 1.0, 0.0, -1.0]).unwrap();
        let far = circle.arcs_in_box(DVec2::splat(2.0), DVec2::splat(3.0)).unwrap();
        assert!(far.is_empty(), "beside the circle");
        assert_eq!(
            circle.arcs_in_box(DVec2::ONE, DVec2::ONE).unwrap_err().name(),
            "OutsideInterval",
            "no box"
        );
        let parabola = Conic::new([1.0, 0.0, 0.0, 0.0, -0.5, 0.0]).unwrap();
        let arcs = parabola.arcs_in_box(DVec2::new(-1.0, -1.0), DVec2::new(2.0, 1.0)).unwrap();
        assert_eq!(arcs.len(), 1, "one arc of the parabola");
        for end in [arcs[0].points()[0], arcs[0].points()[2]] {
            assert!((end.y - end.x * end.x).abs() < 1e-14, "y = x² at {end}");
        }
        let lines = Conic::new([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
        assert_eq!(lines.arcs_in_box(DVec2::ZERO, DVec2::ONE).unwrap_err().name(), "Degenerate", "two lines");
        let hyperbola = Conic::new([0.0, 1.0, 0.0, 0.0, 0.0, -2.0]).unwrap();
        let across = hyperbola.arc(DVec2::ONE, -DVec2::new(0.5, 2.0));
        assert_eq!(across.unwrap_err().name(), "Degenerate", "different branches");
        let line = [DVec2::ZERO, DVec2::ONE, 3.0 * DVec2::ONE];
        assert_eq!(Conic::from_control_points(line, [1.0; 3]).unwrap_err().name(), "Degenerate", "collinear");
        let cubic = RationalBezier::new(vec![DVec2::ZERO; 4], vec![1.0; 4]).unwrap();
        assert_eq!(cubic.conic().unwrap_err().name(), "SizeMismatch", "degree 3");
    }
}
