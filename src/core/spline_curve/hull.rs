//! Where a piece of a curve can be: hulls and boxes of its active control points.
//!
//! For `τₗ ≤ t ≤ τₗ₊₁` the point `p(t)` is a convex combination of `cₗ₋ₙ, …, cₗ`, and so is a rational one with positive weights.
//! Course: section 6.2.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Projective> Nurbs<P> {
    /// The `n + 1` control points that are active over the knot interval around `t`, the one to the right at a knot.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn active_points(&self, t: f64) -> Result<Vec<P>, SplineError> {
        let span = self.space().span(t)?;
        Ok((span - self.degree()..=span).map(|k| self.without_weights().evaluation_coefficient(k)).collect())
    }

    /// The ends of the range of every coordinate of the active control points: a box around the piece at `t`.
    ///
    /// # Errors
    ///
    /// As [`Self::active_points`].
    pub fn active_box(&self, t: f64) -> Result<Vec<(f64, f64)>, SplineError> {
        Ok(coordinate_ranges(&self.active_points(t)?))
    }
}

impl Nurbs<DVec2> {
    /// The convex hull of the active control points at `t`, counterclockwise: it holds the piece of the curve.
    ///
    /// # Errors
    ///
    /// As [`Self::active_points`].
    pub fn active_hull(&self, t: f64) -> Result<Vec<DVec2>, SplineError> {
        Ok(convex_hull(&self.active_points(t)?))
    }
}

/// `(least, largest)` of every coordinate; infinite and reversed for no points.
pub fn coordinate_ranges<P: Projective>(points: &[P]) -> Vec<(f64, f64)> {
    let range = |i: usize| {
        points
            .iter()
            .map(|point| point.coordinate(i))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    (0..P::DIMENSION).map(range).collect()
}

/// The corners of the convex hull, counterclockwise from the lowest of the leftmost; points on its edges are left out.
///
/// A. Andrew, *Another efficient algorithm for convex hulls in two dimensions*, 1979.
///
/// ```
/// # use glam::DVec2;
/// # use spline_lab::core::spline_curve::convex_hull;
/// let square = [DVec2::ZERO, DVec2::ONE, DVec2::X, DVec2::Y, DVec2::splat(0.5)];
/// assert_eq!(convex_hull(&square), [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
/// ```
pub fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(point - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_curve_stays_in_hull_and_box_of_its_active_points(curve in any_curve(1..=12), at in 0.0..1.0_f64) {
            let (left, right) = curve.space().parameter_interval();
            let t = left.mix(right, at);
            let (point, hull) = (curve.evaluate(t).unwrap(), curve.active_hull(t).unwrap());
            for (i, corner) in hull.iter().enumerate() {
                let next = hull[(i + 1) % hull.len()];
                let outside = (next - *corner).perp_dot(point - *corner);
                prop_assert!(hull.len() < 3 || outside > -1e-10, "{point} is {outside} outside of {corner} {next}");
            }
            for (i, (low, high)) in curve.active_box(t).unwrap().into_iter().enumerate() {
                prop_assert!((low - 1e-12..=high + 1e-12).contains(&point.coordinate(i)), "{point}, {low}, {high}");
            }
        }

        #[test]
        fn hulls_are_convex_and_hold_their_points(points in prop::collection::vec((-3_i8..4, -3_i8..4), 0..20)) {
            let points: Vec<DVec2> = points.into_iter().map(|(x, y)| DVec2::new(x.into(), y.into())).collect();
            let hull = convex_hull(&points);
            prop_assert!(hull.iter().all(|corner| points.contains(corner)), "corners are points");
            for (i, &a) in hull.iter().enumerate().filter(|_| hull.len() > 2) {
                let (b, c) = (hull[(i + 1) % hull.len()], hull[(i + 2) % hull.len()]);
                prop_assert!((b - a).perp_dot(c - b) > 0.0, "left turns only: {hull:?}");
                prop_assert!(points.iter().all(|&p| (b - a).perp_dot(p - a) >= 0.0), "holds all: {hull:?}");
            }
        }
    }
}
