//! The polynomial whose zeros are the foot points of a given point on a Bezier piece.
//!
//! The distance of `q` from `r = P/w` is stationary where `(P − q w)·(w P′ − w′ P) = 0`: the second factor, the direction of the tangent, does not depend on `q`, so that the
//! Bernstein coefficients are `aₖ − bₖ·q` with numbers `aₖ` and points `bₖ` of the piece alone. The degree is `3n − 2`, of polynomial pieces `2n − 1`. A positive value
//! means that the distance grows. Course: beyond, section B.5.

use crate::core::point::Point;
use crate::core::polynomial::product_by;
use crate::core::spline_curve::local_piece::{LocalPiece, dot, largest};

/// `aₖ` and `bₖ` of a piece, about the origin of the piece.
#[derive(Clone, Debug)]
pub(super) struct FootPolynomial<P> {
    coefficients: Vec<(f64, P)>,
    extent: f64,
    /// Noise of the coefficients for `q` in the origin, and its growth with the distance of `q`.
    noise: f64,
}

impl<P: Point> FootPolynomial<P> {
    pub(super) fn new(piece: &LocalPiece<P>) -> Self {
        let n = piece.degree();
        let direction = piece.direction();
        let along = product_by(&piece.numerators, &direction, dot);
        let ones = vec![1.0; n + 1];
        let weights = if piece.weights.is_empty() { &ones } else { &piece.weights };
        let across = product_by(weights, &direction, |w, p: P| p * w);
        let (weight, speed) = (piece.largest_weight(), largest(&direction));
        let relative = 16.0 * (n + 1) as f64 * f64::EPSILON;
        let noise = weight * (relative * speed + piece.direction_error());
        // The error of the points themselves counts like a distance.
        let extent = piece.extent + weight * speed * piece.error / noise.max(f64::MIN_POSITIVE);
        Self { coefficients: along.into_iter().zip(across).collect(), extent, noise }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.noise.is_finite() && self.coefficients.iter().all(|(a, b)| a.is_finite() && b.is_finite())
    }

    /// The number of coefficients.
    pub(super) fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// The coefficients for `q`, seen from the origin of the piece.
    pub(super) fn values(&self, q: P) -> impl Iterator<Item = f64> + '_ {
        self.coefficients.iter().map(move |&(a, b)| a - dot(b, q))
    }

    /// Writes the coefficients for `q`.
    pub(super) fn write(&self, q: P, values: &mut [f64]) {
        values.iter_mut().zip(self.values(q)).for_each(|(value, at_q)| *value = at_q);
    }

    /// An estimate from above of the errors of the coefficients for `q`.
    pub(super) fn noise(&self, q: P) -> f64 {
        self.noise * (self.extent + q.norm())
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::core::spline_curve::samples::any_curve;
    use crate::core::triangular_scheme::collapse;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn the_sign_is_that_of_the_growth_of_the_distance(
            curve in any_curve(1..=6), place in prop::array::uniform2(-9.0..9.0_f64).prop_map(DVec2::from), t in 0.01..0.99_f64,
        ) {
            for piece in curve.local_pieces().unwrap() {
                let foot = FootPolynomial::new(&piece);
                let n = piece.degree();
                prop_assert_eq!(foot.len() - 1, if piece.weights.is_empty() { 2 * n - 1 } else { 3 * n - 2 }, "degree");
                let mut values = vec![0.0; foot.len()];
                foot.write(place - piece.origin, &mut values);
                let value = collapse(&mut values, t);
                let (a, b) = piece.interval;
                let distance = |t: f64| curve.evaluate(a + (b - a) * t).unwrap().distance_squared(place);
                let quotient = (distance(t + 1e-5) - distance(t - 1e-5)) / 4e-5;
                let weight = if piece.weights.is_empty() { 1.0 } else { collapse(&mut piece.weights.clone(), t) };
                let exact = value / weight.powi(3);
                prop_assert!((quotient - exact).abs() < 1e-4 * (1.0 + exact.abs() + distance(t)), "{quotient} for {exact}");
            }
        }
    }
}
