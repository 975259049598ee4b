//! Inserting one knot several times, with all intermediate control points.
//!
//! With `l` the last knot at or below `s` and `μ` the multiplicity of `s` before, the points `cₗ₋ₙ … cₗ₋ᵤ` (`u = μ`) are the first
//! level; each insertion divides the legs of the polygon in the ratio `(s − τₖ) : (τₖ₊ₙ₋ᵢ − s)` and replaces the inner points by one point
//! less than legs. After `n − μ` insertions the last point is `p(s)`: the triangle is that of de Boor. Course: sections 6.3 and 6.4.

use crate::core::bspline::{Spline, SplineError};
use crate::core::point::Point;
use crate::core::triangular_scheme::TriangularScheme;

/// The corner cutting of `times` insertions of the knot `s`.
#[derive(Clone, Debug, PartialEq)]
pub struct InsertionScheme<P> {
    /// The knot, reduced into one period.
    pub knot: f64,
    /// Index `l` of the last evaluation knot at or below `s`, before the insertions.
    pub span: usize,
    /// Multiplicity of `s` before.
    pub multiplicity: usize,
    /// Index, among the control points after the first insertion, of the first new point: `l − n + 1`.
    pub first_new: usize,
    /// Level 0 holds `cₗ₋ₙ … cₗ₋ᵤ`, level `i` the new points of insertion number `i`; weights are the γ.
    pub triangle: TriangularScheme<P>,
}

impl<P: Point> Spline<P> {
    /// The scheme of inserting `at` so often that its multiplicity becomes `multiplicity + times`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `KnotMultiplicityTooHigh` if `at` would stand there more than `n` times.
    pub fn insertion_scheme(&self, at: f64, times: usize) -> Result<InsertionScheme<P>, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let knot = space.reduce(at)?;
        let knots = space.evaluation_knots();
        let span = knots.partition_point(|&other| other <= knot) - 1;
        let present = space.multiplicity(knot);
        let multiplicity = present.saturating_add(times);
        if multiplicity > n {
            let index = knots.partition_point(|&other| other < knot);
            return Err(SplineError::KnotMultiplicityTooHigh { index, value: knot, multiplicity, degree: n });
        }
        let points = (span - n..=span - present).map(|k| self.evaluation_coefficient(k)).collect();
        let triangle = TriangularScheme::run(points, times, |i, j| {
            let k = span - n + i + 1 + j;
            (knot - knots[k]) / (knots[k + n - i] - knots[k])
        });
        Ok(InsertionScheme { knot, span, multiplicity: present, first_new: span + 1 - n, triangle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Side;
    use crate::core::spline_curve::samples::any_spline;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_full_scheme_ends_on_the_curve_with_its_tangents(spline in any_spline(1..=9), at in 0.0..1.0_f64, at_knot in any::<bool>()) {
            let (left, right) = spline.space().parameter_interval();
            let s = if at_knot { left.mix(right, at).floor() } else { left.mix(right, at) };
            let (n, present) = (spline.degree(), spline.space().multiplicity(s));
            let scheme = spline.insertion_scheme(s, n - present.min(n)).unwrap();
            let end = scheme.triangle.result().unwrap();
            prop_assert!((end - spline.evaluate(s).unwrap()).length() < 1e-12, "p({s}) is {end}");
            prop_assert_eq!(spline.insertion_scheme(s, n + 1 - present).unwrap_err().name(), "KnotMultiplicityTooHigh");
            if present < n {
                // p′(s) = n/(τ₊ − τ₋)·(difference of the last leg), with the knots nearest to s.
                let (knots, level) = (spline.space().evaluation_knots(), &scheme.triangle.levels()[n - present - 1]);
                let (before, behind) = (knots[scheme.span - present], knots[scheme.span + 1]);
                let slope = (level[1] - level[0]) * (n as f64 / (behind - before));
                let expected = spline.derivatives(s, 1, Side::Right).unwrap()[1];
                prop_assert!((slope - expected).length() < 1e-10 * expected.length().max(1.0), "{slope}, {expected}");
            }
        }

        #[test]
        fn levels_are_the_new_points_of_each_insertion(spline in any_spline(2..=6), at in 0.0..1.0_f64) {
            if spline.space().is_periodic() {
                return Ok(());
            }
            let (left, right) = spline.space().parameter_interval();
            let s = left.mix(right, at);
            let scheme = spline.insertion_scheme(s, 2.min(spline.degree() - spline.space().multiplicity(s))).unwrap();
            let mut refined = spline;
            for (i, level) in scheme.triangle.levels().iter().enumerate().skip(1) {
                refined = refined.insert_knot(s).unwrap();
                for (j, point) in level.iter().enumerate() {
                    let other = refined.coefficients()[scheme.first_new + i - 1 + j];
                    prop_assert!((other - *point).length() < 1e-12, "insertion {i}, point {j}: {point}, {other}");
                }
            }
        }
    }
}
