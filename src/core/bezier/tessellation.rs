//! Distance of a Bezier curve from its control polygon, and polylines within a tolerance.
//!
//! With the polygon parametrised over `k/n`, `|p − c| ≤ N(n) max |Δ²cₖ|` with `N(n) = ⌊n/2⌋⌈n/2⌉/(2n)`, attained for constant second differences
//! (D. Nairn, J. Peters, D. Lutterkort 1999). A chord is within `n (n−1)/8 max |Δ²cₖ|`, which is the bound `|p″|/8` of
//! linear interpolation; halving divides it by 4. Course: sections 2.2 and 2.6.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::{BezierError, check_tolerance};
use crate::core::point::Point;
use crate::core::triangular_scheme::collapse_both;

/// Most halvings of one part; the bound has shrunk by `4⁻²⁴`, below rounding.
const MAX_DEPTH: usize = 24;

/// A point of the curve with its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TessellationPoint<P> {
    /// The parameter.
    pub parameter: f64,
    /// `p(parameter)`.
    pub point: P,
}

/// `N(n) = ⌊n/2⌋⌈n/2⌉/(2n)`: how far a curve of degree `n` is from its polygon, in units of the largest second difference.
pub fn polygon_distance_factor(n: usize) -> f64 {
    if n == 0 { 0.0 } else { ((n / 2) * n.div_ceil(2)) as f64 / (2 * n) as f64 }
}

impl<P: Point> BezierCurve<P> {
    /// Bound of the distance `|p(a + t (b − a)) − c(t)|` from the control polygon `c` with its corners at `t = k/n`.
    pub fn polygon_distance_bound(&self) -> f64 {
        polygon_distance_factor(self.degree()) * largest_second_difference(self.points())
    }

    /// Points of the curve, both ends among them, so that at equal parameters the polyline is nowhere further than `tolerance` from the curve.
    ///
    /// Halves parts until the bound of the chord holds.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if 24 halvings of one part are not enough.
    pub fn tessellate(&self, tolerance: f64) -> Result<Vec<TessellationPoint<P>>, BezierError> {
        check_tolerance(tolerance)?;
        let n = self.degree();
        let factor = (n * n.saturating_sub(1)) as f64 / 8.0;
        let (a, b) = self.interval();
        let mut found = vec![TessellationPoint { parameter: a, point: self.points()[0] }];
        let mut waiting = vec![(0.0, 1.0, 0, self.points().to_vec())];
        while let Some((low, high, depth, mut points)) = waiting.pop() {
            if factor * largest_second_difference(&points) <= tolerance {
                found.push(TessellationPoint { parameter: a.mix(b, high), point: points[n] });
                continue;
            }
            if depth == MAX_DEPTH {
                let (value, limit) = (MAX_DEPTH + 1, MAX_DEPTH);
                return Err(BezierError::StepLimit { what: "halvings of a part", value, limit });
            }
            let middle = 0.5 * (low + high);
            let mut first = points.clone();
            collapse_both(&mut points, 0.5, &mut first);
            waiting.push((middle, high, depth + 1, points));
            waiting.push((low, middle, depth + 1, first));
        }
        Ok(found)
    }
}

fn largest_second_difference<P: Point>(points: &[P]) -> f64 {
    points.windows(3).map(|c| (c[0] - c[1] * 2.0 + c[2]).norm()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use proptest::prelude::*;

    fn polygon() -> impl Strategy<Value = Vec<DVec2>> {
        prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 1..9)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_polygon_is_within_its_bound(points in polygon()) {
            let curve = BezierCurve::new(points).unwrap();
            let (n, bound) = (curve.degree(), curve.polygon_distance_bound());
            for i in 0..=100 {
                let t = f64::from(i) / 100.0;
                let place = t * n as f64;
                let k = (place as usize).min(n.saturating_sub(1));
                let corner = curve.points()[k].mix(curve.points()[(k + 1).min(n)], place - k as f64);
                let gap = (curve.evaluate(t).unwrap() - corner).length();
                prop_assert!(gap <= bound + 1e-13, "{gap} above {bound}");
            }
        }

        #[test]
        fn polylines_keep_their_tolerance(points in polygon(), digits in 0_i32..4) {
            let curve = BezierCurve::on_interval(points, (-1.0, 3.0)).unwrap();
            let tolerance = 10.0_f64.powi(-digits);
            let line = curve.tessellate(tolerance).unwrap();
            prop_assert_eq!(line[0].parameter, -1.0, "begins");
            prop_assert_eq!(line[line.len() - 1].parameter, 3.0, "ends");
            for pair in line.windows(2) {
                for i in 0..=4 {
                    let t = f64::from(i) / 4.0;
                    let exact = curve.evaluate(pair[0].parameter.mix(pair[1].parameter, t)).unwrap();
                    let gap = (exact - pair[0].point.mix(pair[1].point, t)).length();
                    prop_assert!(gap <= tolerance, "{gap} above {tolerance}");
                }
            }
        }
    }

    #[test]
    fn lines_need_two_points() {
        let line = BezierCurve::new(vec![0.0, 2.0]).unwrap();
        assert_eq!(line.tessellate(1e-300).unwrap().len(), 2, "no curvature");
        let parabola = BezierCurve::new(vec![0.0, 1.0, 0.0]).unwrap();
        assert_eq!(parabola.tessellate(1e-300).unwrap_err().name(), "StepLimit", "below rounding");
        assert_eq!(parabola.tessellate(-1.0).unwrap_err().name(), "InvalidTolerance", "negative");
    }
}
