//! How far a spline curve is from its control polygon.
//!
//! The polygon as a function of the parameter, `c(t)`, is linear between the knot averages `τₖⁿ`, with `c(τₖⁿ) = cₖ`. On a nonempty
//! knot interval `[τₗ, τₗ₊₁]`
//!
//! ```text
//! ‖p(t) − c(t)‖ ≤ 1/(2n) · max σₖ² (k = l−n … l) · max ‖∇²cₖ‖ (k = l−n+2 … l),
//! ```
//!
//! with the variances `σₖ²` of the inner knots and the coefficients `∇²cₖ` of `p″`; it holds for the maximum norm and for the Euclidean
//! one, and is sharp for the parabola `t²/2`. Over uniform knots it is `(n + 1)/24` times the largest second difference.
//!
//! U. Reif, *Best bounds on the approximation of polynomials and splines by their control structure*, 2000. Course: section 6.2.

use crate::core::bspline::{Spline, SplineError, variance};
use crate::core::point::Point;

/// The bound over one knot interval, and what samples see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolygonDistance {
    /// The knot interval.
    pub interval: (f64, f64),
    /// No point of the curve is further from the polygon at the same parameter, in the maximum norm.
    pub bound: f64,
    /// The largest distance seen.
    pub measured: f64,
    /// Parameter where it was seen.
    pub at: f64,
}

impl PolygonDistance {
    /// `measured/bound`, at most 1 up to rounding; 1 where both are 0.
    pub fn ratio(&self) -> f64 {
        if self.bound > 0.0 { self.measured / self.bound } else { 1.0 }
    }
}

/// `(n + 1)/24`, the bound over uniform knots of distance 1 for second differences 1; 0 for degree 0 and 1.
pub fn uniform_distance_factor(degree: usize) -> f64 {
    if degree < 2 { 0.0 } else { (degree + 1) as f64 / 24.0 }
}

impl<P: Point> Spline<P> {
    /// The control polygon as a function of the parameter: linear between the knot averages.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn control_polygon_at(&self, t: f64) -> Result<P, SplineError> {
        let t = self.space().reduce(t)?;
        // The averages of the active coefficients enclose t.
        let span = self.space().span(t)?;
        let n = self.degree();
        let mut low = span - n;
        while low + 1 < span && self.knot_average(low + 1) <= t {
            low += 1;
        }
        let (a, b) = (self.knot_average(low), self.knot_average(low + 1));
        Ok(self.evaluation_coefficient(low).mix(self.evaluation_coefficient(low + 1), (t - a) / (b - a)))
    }

    /// `∇²cₖ` for `k = 2, 3, …` of the evaluation knots: the coefficients of `p″`; 0 where `τₖ = τₖ₊ₙ₋₁`. Empty for degree 1.
    pub fn second_differences(&self) -> Vec<P> {
        let (n, space) = (self.degree(), self.space());
        let (knots, m) = (space.evaluation_knots(), space.evaluation_dimension());
        if n < 2 {
            return Vec::new();
        }
        // αⁿₖ (cₖ − cₖ₋₁), the coefficients of p′.
        let slope = |k: usize| {
            let step = self.evaluation_coefficient(k) - self.evaluation_coefficient(k - 1);
            step * (n as f64 / (knots[k + n] - knots[k]))
        };
        let mut before = slope(1);
        let difference = |k: usize| {
            let next = slope(k);
            let change = next - before;
            before = next;
            let width = knots[k + n - 1] - knots[k];
            if width > 0.0 { change * ((n - 1) as f64 / width) } else { P::ZERO }
        };
        (2..m).map(difference).collect()
    }

    /// The bounds in the maximum norm, one for each nonempty knot interval of D or of one period, with the distances at 33 parameters
    /// of the interval and at the knot averages in it.
    ///
    /// # Errors
    ///
    /// None is known to occur.
    pub fn polygon_distances(&self) -> Result<Vec<PolygonDistance>, SplineError> {
        let (space, bounds) = (self.space(), self.distance_bounds(maximum_norm));
        let breaks = space.breaks();
        let averages: Vec<f64> = (0..space.evaluation_dimension()).map(|k| self.knot_average(k)).collect();
        let mut distances = Vec::with_capacity(bounds.len());
        for (ends, &bound) in breaks.windows(2).zip(&bounds) {
            let mut found =
                PolygonDistance { interval: (ends[0], ends[1]), bound, measured: 0.0, at: ends[0] };
            let inside =
                averages.partition_point(|&at| at <= ends[0])..averages.partition_point(|&at| at < ends[1]);
            let equal = (0..=32).map(|i| ends[0].mix(ends[1], f64::from(i) / 32.0));
            for t in equal.chain(averages[inside].iter().copied()) {
                let measured = maximum_norm(self.evaluate(t)? - self.control_polygon_at(t)?);
                if measured > found.measured {
                    (found.measured, found.at) = (measured, t);
                }
            }
            distances.push(found);
        }
        Ok(distances)
    }

    /// The largest bound in the maximum norm; 0 for degree 1.
    pub fn distance_bound(&self) -> f64 {
        self.distance_bounds(maximum_norm).into_iter().fold(0.0, f64::max)
    }

    /// The bounds in `norm`, one for each nonempty knot interval.
    pub(super) fn distance_bounds(&self, norm: impl Fn(P) -> f64) -> Vec<f64> {
        let (n, space) = (self.degree(), self.space());
        let (knots, m) = (space.evaluation_knots(), space.evaluation_dimension());
        if n < 2 {
            return vec![0.0; space.breaks().len() - 1];
        }
        let seconds: Vec<f64> = self.second_differences().into_iter().map(norm).collect();
        let variances: Vec<f64> =
            (0..m).map(|k| variance(n, &knots[k + 1..=k + n], self.knot_average(k))).collect();
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        (n..m)
            .filter(|&l| knots[l] < knots[l + 1])
            .map(|l| largest(&variances[l - n..=l]) * largest(&seconds[l - n..=l - 2]) / (2 * n) as f64)
            .collect()
    }

    /// `τₖⁿ` of the evaluation knots.
    pub(super) fn knot_average(&self, k: usize) -> f64 {
        let inner = &self.space().evaluation_knots()[k + 1..=k + self.degree()];
        // Distances from the first keep n-fold knots exact.
        inner[0] + inner.iter().map(|knot| knot - inner[0]).sum::<f64>() / self.degree() as f64
    }
}

/// The largest coordinate.
pub(super) fn maximum_norm<P: Point>(point: P) -> f64 {
    (0..P::DIMENSION).map(|i| point.coordinate(i).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::core::spline_curve::samples::any_spline;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_sample_is_beyond_its_bound(spline in any_spline(1..=12)) {
            for distance in spline.polygon_distances().unwrap() {
                prop_assert!(distance.measured <= distance.bound + 1e-12, "{distance:?}");
                prop_assert!(distance.ratio() <= 1.0 + 1e-9 || distance.bound < 1e-9, "{distance:?}");
            }
        }

        #[test]
        fn bounds_move_and_grow_with_the_curve(spline in any_spline(2..=8), shift in -50.0..50.0_f64, factor in 0.1..9.0_f64) {
            let map = |point: DVec2| point * factor + DVec2::splat(shift);
            let points = spline.coefficients().iter().map(|&point| map(point)).collect();
            let moved = Spline::new(spline.space().clone(), points).unwrap();
            let (a, b) = (spline.distance_bound() * factor, moved.distance_bound());
            prop_assert!((a - b).abs() < 1e-10 * a.max(1.0), "{a} and {b}");
        }

        #[test]
        fn a_parabola_attains_the_bound_over_uniform_knots(n in 2_usize..12) {
            let space = SplineSpace::new(n, (0..3 * n + 4).map(|k| k as f64).collect()).unwrap();
            let half_squares = space.monomial_coefficients(2).unwrap().into_iter().map(|c| 0.5 * c).collect();
            let parabola = Spline::new(space, half_squares).unwrap();
            for distance in parabola.polygon_distances().unwrap() {
                prop_assert!((distance.bound - uniform_distance_factor(n)).abs() < 1e-12, "{distance:?}");
                // At the knot averages the distance is σ²/(2n), the same for all.
                prop_assert!((distance.measured - distance.bound).abs() < 1e-11, "{distance:?}");
            }
        }
    }

    #[test]
    fn refinement_divides_the_bound_by_four() {
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 4.0, 4.0, 4.0, 5.0]).unwrap();
        let mut spline = Spline::new(space, vec![0.0, 2.0, -1.0, 5.0, 3.0, 0.0]).unwrap();
        let mut bounds = Vec::new();
        for _ in 0..7 {
            bounds.push(spline.distance_bound());
            spline = spline.refine_uniformly().unwrap();
        }
        for pair in bounds.windows(2).skip(3) {
            assert!((3.0..5.0).contains(&(pair[0] / pair[1])), "{bounds:?}");
        }
    }

    #[test]
    fn points_on_a_line_at_the_averages_are_the_curve() {
        let space = SplineSpace::new(4, vec![0.0, 1.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 9.5]).unwrap();
        let points =
            space.greville_abscissae().into_iter().map(|s| DVec2::new(2.0 * s - 1.0, 3.0 - s)).collect();
        let line = Spline::new(space, points).unwrap();
        assert!(line.distance_bound() < 1e-13, "bound {}", line.distance_bound());
        let (p, c) = (line.evaluate(4.5).unwrap(), line.control_polygon_at(4.5).unwrap());
        assert!(p.distance(c) < 1e-13 && p.distance(DVec2::new(8.0, -1.5)) < 1e-13, "{p} and {c}");
    }
}
