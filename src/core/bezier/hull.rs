//! What the control polygon tells: boxes, convex hull, tangents at the ends.
//!
//! For `t` in `[0, 1]` the Bernstein polynomials are nonnegative with sum 1, so the curve lies in the convex hull of its control points.
//! Course: section 2.2.

use glam::DVec2;

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::root_finding::bernstein_zeros;

/// Unit tangents at both ends of a curve, in the direction of increasing parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndTangents<P> {
    /// At the first point.
    pub start: P,
    /// At the last point.
    pub end: P,
}

impl<P: Point> BezierCurve<P> {
    /// `(low, high)` of each coordinate of the control points; the curve lies in this box.
    pub fn polygon_box(&self) -> Vec<(f64, f64)> {
        let range = |axis| {
            let values = self.points().iter().map(|point| point.coordinate(axis));
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        (0..P::DIMENSION).map(range).collect()
    }

    /// `(low, high)` of each coordinate of the curve over its interval, from the ends and the zeros of the derivative.
    pub fn tight_box(&self) -> Vec<(f64, f64)> {
        let axis_range = |axis| {
            let c: Vec<f64> = self.points().iter().map(|point| point.coordinate(axis)).collect();
            let ends = (c[0].min(c[c.len() - 1]), c[0].max(c[c.len() - 1]));
            let differences: Vec<f64> = c.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let zeros = bernstein_zeros(&differences, 0.0);
            zeros.isolated().iter().fold(ends, |(low, high), zero| {
                let value = crate::core::triangular_scheme::collapse(&mut c.clone(), zero.at);
                (low.min(value), high.max(value))
            })
        };
        (0..P::DIMENSION).map(axis_range).collect()
    }

    /// The unit tangents at the ends; repeated control points there are skipped: the directions `cⱼ − c₀` for the first `cⱼ ≠ c₀` and
    /// `cₙ − cⱼ` for the last `cⱼ ≠ cₙ`.
    ///
    /// # Errors
    ///
    /// `Degenerate` if all control points coincide.
    pub fn end_tangents(&self) -> Result<EndTangents<P>, BezierError> {
        let points = self.points();
        let (first, last) = (points[0], points[points.len() - 1]);
        let unit = |other: Option<&P>, at: P, sign: f64, parameter| {
            let chord = other.map(|&point| (point - at) * sign);
            let length = chord.map_or(0.0, Point::norm);
            match chord {
                Some(chord) if length > 0.0 && length.is_finite() => Ok(chord * length.recip()),
                _ => Err(BezierError::Degenerate { what: "the tangent", parameter }),
            }
        };
        Ok(EndTangents {
            start: unit(points.iter().find(|&&point| point != first), first, 1.0, self.interval().0)?,
            end: unit(points.iter().rev().find(|&&point| point != last), last, -1.0, self.interval().1)?,
        })
    }
}

impl BezierCurve<DVec2> {
    /// Whether `place` lies in the convex hull of the control points, border included.
    pub fn hull_contains(&self, place: DVec2) -> bool {
        let hull = convex_hull(self.points());
        match hull.as_slice() {
            [] => false,
            [only] => *only == place,
            [a, b] => {
                let (edge, way) = (*b - *a, place - *a);
                edge.perp_dot(way) == 0.0 && edge.dot(way) >= 0.0 && edge.dot(way) <= edge.dot(edge)
            }
            corners => {
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).all(|(&a, &b)| (b - a).perp_dot(place - a) >= 0.0)
            }
        }
    }
}

/// The corners of the convex hull, counterclockwise from the lowest of the leftmost points, none of them on the segment of its
/// neighbours; one corner if all points coincide, two if they are collinear. Points with a coordinate that is not finite are left out.
///
/// A. M. Andrew, *Another efficient algorithm for convex hulls in two dimensions*, 1979.
pub fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted: Vec<DVec2> = points.iter().copied().filter(|point| point.is_finite()).collect();
    sorted.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let mut hull: Vec<DVec2> = Vec::with_capacity(sorted.len() + 1);
    let mut chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let start = hull.len();
        for point in points {
            while let [.., a, b] = hull[start..]
                && (b - a).perp_dot(point - a) <= 0.0
            {
                hull.pop();
            }
            hull.push(point);
        }
        hull.pop();
    };
    chain(&mut sorted.iter().copied());
    chain(&mut sorted.iter().rev().copied());
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon() -> impl Strategy<Value = Vec<DVec2>> {
        prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 1..9)
    }

    proptest! {
        #[test]
        fn the_curve_stays_in_hull_and_boxes_and_touches_the_tight_one(points in polygon()) {
            let curve = BezierCurve::new(points).unwrap();
            let (polygon, tight) = (curve.polygon_box(), curve.tight_box());
            let hull = convex_hull(curve.points());
            let mut seen = [(f64::INFINITY, f64::NEG_INFINITY); 2];
            for i in 0..=400 {
                let point = curve.evaluate(f64::from(i) / 400.0).unwrap();
                for (&a, &b) in hull.iter().zip(hull.iter().cycle().skip(1)) {
                    let outside = (b - a).perp_dot(point - a);
                    prop_assert!(hull.len() < 3 || outside >= -1e-12, "outside the hull by {outside}");
                }
                for axis in 0..2 {
                    let x = point.coordinate(axis);
                    seen[axis] = (seen[axis].0.min(x), seen[axis].1.max(x));
                    prop_assert!(tight[axis].0 - 1e-13 <= x && x <= tight[axis].1 + 1e-13, "{x} outside {tight:?}");
                }
            }
            for axis in 0..2 {
                prop_assert!(polygon[axis].0 - 1e-14 <= tight[axis].0 && tight[axis].1 <= polygon[axis].1 + 1e-14, "nested");
                prop_assert!((seen[axis].0 - tight[axis].0).abs() < 2e-3, "touched below");
                prop_assert!((seen[axis].1 - tight[axis].1).abs() < 2e-3, "touched above");
            }
        }

        #[test]
        fn affine_maps_of_the_polygon_map_the_curve(points in polygon(), m in prop::collection::vec(-2.0..2.0_f64, 6), t in 0.0..=1.0_f64) {
            let map = |p: DVec2| DVec2::new(m[0] * p.x + m[1] * p.y + m[4], m[2] * p.x + m[3] * p.y + m[5]);
            let curve = BezierCurve::new(points).unwrap();
            let image = curve.transformed(map).unwrap();
            let gap = (image.evaluate(t).unwrap() - map(curve.evaluate(t).unwrap())).length();
            prop_assert!(gap < 1e-13, "{gap}");
        }
    }

    #[test]
    fn hulls_of_few_points() {
        let at = DVec2::new;
        let square = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        let mut all = square.to_vec();
        all.extend([at(0.5, 0.5), at(0.5, 0.0), at(1.0, 1.0)]);
        assert_eq!(convex_hull(&all), square, "a square with points inside and on an edge");
        let line = [at(0.0, 0.0), at(1.0, 1.0), at(3.0, 3.0)];
        assert_eq!(convex_hull(&line), [line[0], line[2]], "collinear points");
        let segment = BezierCurve::new(line.to_vec()).unwrap();
        assert!(segment.hull_contains(at(2.0, 2.0)) && !segment.hull_contains(at(4.0, 4.0)), "segment");
        assert!(!segment.hull_contains(at(2.0, 2.5)), "beside the segment");
        assert!(BezierCurve::new(all).unwrap().hull_contains(at(0.25, 1.0)), "on the border");
        assert_eq!(convex_hull(&[at(f64::NAN, 0.0)]), [], "no point");
    }

    #[test]
    fn end_tangents_skip_repeated_points() {
        let at = DVec2::new;
        let points = vec![at(0.0, 0.0), at(0.0, 0.0), at(0.0, 2.0), at(3.0, 2.0), at(3.0, 2.0)];
        let tangents = BezierCurve::new(points).unwrap().end_tangents().unwrap();
        assert_eq!(tangents, EndTangents { start: at(0.0, 1.0), end: at(1.0, 0.0) }, "up, then right");
        let point = BezierCurve::new(vec![at(1.0, 1.0); 3]).unwrap();
        assert_eq!(point.end_tangents().unwrap_err().name(), "Degenerate", "one point");
    }
}
