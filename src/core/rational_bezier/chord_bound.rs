//! How far a rational Bezier curve is from its chord.
//!
//! With `r = p/w` over `[0, 1]` and the chord `L(t) = (1 − t) r(0) + t r(1)`, `r − L = (p − w L)/w`. The numerator has degree `n + 1`, vanishes at both ends, and has
//! the Bernstein coefficients
//!
//! ```text
//! dⱼ = [(n + 1 − j) wⱼ (cⱼ − r(0)) + j wⱼ₋₁ (cⱼ₋₁ − r(1))] / (n + 1),   so that   |r − L| ≤ max |dⱼ| / min w
//! ```
//!
//! at equal parameters. Halving divides the bound by about 4. Course: beyond, section B.8.

use crate::core::rational_bezier::{Projective, RationalBezier};

impl<P: Projective> RationalBezier<P> {
    /// The `n + 2` Bernstein coefficients of `w (r − L)`, which is 0 at both ends, for the chord `L`.
    pub fn chord_coefficients(&self) -> Vec<P> {
        let (points, weights, n) = (self.points(), self.weights(), self.degree());
        let (start, end) = (points[0], points[n]);
        let whole = (n + 1) as f64;
        (0..=n + 1)
            .map(|j| {
                let before =
                    j.checked_sub(1).map_or(P::ZERO, |i| (points[i] - end) * (weights[i] * j as f64 / whole));
                let here = if j <= n {
                    (points[j] - start) * (weights[j] * (whole - j as f64) / whole)
                } else {
                    P::ZERO
                };
                before + here
            })
            .collect()
    }

    /// A bound of the distance from the chord at equal parameters: no point `r(t)` is further from `(1 − t) r(0) + t r(1)`.
    pub fn chord_bound(&self) -> f64 {
        let largest = self.chord_coefficients().iter().map(|d| d.norm()).fold(0.0, f64::max);
        largest / self.weights().iter().copied().fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::point::Point as _;
    use crate::core::rational_bezier::curve::tests::curves;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_point_is_further_and_a_common_factor_of_the_weights_does_not_matter(curve in curves(), t in 0.0..=1.0_f64) {
            let (a, b) = curve.interval();
            let chord = curve.points()[0].mix(curve.points()[curve.degree()], t);
            let distance = (curve.evaluate(a.mix(b, t)).unwrap() - chord).length();
            prop_assert!(distance <= curve.chord_bound() * (1.0 + 1e-12) + 1e-12, "{distance} > {}", curve.chord_bound());
            let weights = curve.weights().iter().map(|w| 4.0 * w).collect();
            let same = RationalBezier::new(curve.points().to_vec(), weights).unwrap().chord_bound();
            prop_assert!((same - curve.chord_bound()).abs() <= 1e-12 * same, "{same}");
        }
    }

    #[test]
    fn halving_a_parabola_divides_the_bound_by_four() {
        let parabola = RationalBezier::new(vec![0.0, 0.0, 1.0], vec![1.0; 3]).unwrap();
        let (left, right) = parabola.split(0.5).unwrap();
        for half in [left, right] {
            assert!(
                (half.chord_bound() - 0.25 * parabola.chord_bound()).abs() < 1e-15,
                "{}",
                half.chord_bound()
            );
        }
        let line = RationalBezier::new(vec![2.0, 5.0], vec![3.0, 3.0]).unwrap();
        assert!(line.chord_bound() < 1e-15, "a segment is its chord");
    }
}
