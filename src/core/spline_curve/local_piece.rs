//! Bezier pieces of a curve about points near them, and the polynomials that give the direction of their tangents.
//!
//! Moved so that the middle between its ends is the origin, a piece keeps the digits that products of coordinates far from 0 would cost. With the piece
//! `r = o + P/w` the tangent has the direction of `w P′ − w′ P = n Σ (w⁰ P¹ − w¹ P⁰)`, of degree `2n − 2`, where the upper indices 0 and 1 mean the first and the
//! last `n` coefficients: `r′ = (w P′ − w′ P)/w²`. Derivatives are by the parameter of the piece in `[0, 1]`.

use crate::core::bspline::{MAX_DEGREE, SplineError};
use crate::core::point::Point;
use crate::core::polynomial::product_by;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::collapse;

/// Pieces up to this degree are evaluated on a small stack.
const SMALL_DEGREE: usize = 3;

/// A Bezier piece about `origin`.
#[derive(Clone, Debug)]
pub(super) struct LocalPiece<P> {
    pub(super) interval: (f64, f64),
    pub(super) origin: P,
    /// `wⱼ (cⱼ − origin)`.
    pub(super) numerators: Vec<P>,
    /// `wⱼ`, divided by a power of two near the largest; empty if all are equal, and the numerators are then without them.
    pub(super) weights: Vec<f64>,
    /// The largest distance of a control point from `origin`.
    pub(super) extent: f64,
    /// An estimate from above of the rounding errors of the control points.
    pub(super) error: f64,
}

impl<P: Projective> Nurbs<P> {
    /// The pieces from left to right.
    ///
    /// # Errors
    ///
    /// `NonFinite` where differences overflow.
    pub(super) fn local_pieces(&self) -> Result<Vec<LocalPiece<P>>, SplineError> {
        let pieces: Vec<LocalPiece<P>> = if self.is_polynomial() {
            let pieces = self.without_weights().bezier_pieces();
            pieces.iter().map(|(interval, points)| LocalPiece::new(interval, points, Vec::new())).collect()
        } else {
            let pieces = self.homogeneous().bezier_pieces();
            let local = pieces.iter().map(|(interval, points)| {
                let (points, weights): (Vec<P>, Vec<f64>) = points.iter().map(|&h| P::project(h)).unzip();
                LocalPiece::new(interval, &points, weights)
            });
            local.collect()
        };
        for (index, piece) in pieces.iter().enumerate() {
            if !piece.numerators.iter().all(|p| p.is_finite()) || !piece.extent.is_finite() {
                let value = piece.extent;
                return Err(SplineError::NonFinite { what: "extent of piece", index, value });
            }
        }
        Ok(pieces)
    }
}

impl<P: Point> LocalPiece<P> {
    /// From control points and weights, none if all are equal.
    pub(super) fn new(interval: (f64, f64), points: &[P], mut weights: Vec<f64>) -> Self {
        let n = points.len() - 1;
        let origin = points[0].mix(points[n], 0.5);
        let largest = weights.iter().copied().fold(0.0, f64::max);
        if largest > 0.0 {
            let scale = 2.0_f64.powi(-(largest.log2() as i32).clamp(-1000, 1000));
            weights.iter_mut().for_each(|w| *w *= scale);
        }
        let away = |c: &P| *c - origin;
        let extent = points.iter().map(|c| away(c).norm()).fold(0.0, f64::max);
        let weight = |j: usize| weights.get(j).copied().unwrap_or(1.0);
        let numerators = points.iter().enumerate().map(|(j, c)| away(c) * weight(j)).collect();
        let error = 4.0 * (n + 1) as f64 * f64::EPSILON * (origin.norm() + extent);
        Self { interval, origin, numerators, weights, extent, error }
    }

    /// The point at `at` in `[0, 1]`, seen from the origin of the piece.
    pub(super) fn offset_at(&self, at: f64) -> P {
        // The ends are asked for most often.
        if at == 0.0 || at == 1.0 {
            let end = if at == 0.0 { 0 } else { self.degree() };
            return self.numerators[end] * self.weights.get(end).map_or(1.0, |w| w.recip());
        }
        if self.degree() <= SMALL_DEGREE {
            self.offset_in::<{ SMALL_DEGREE + 1 }>(at)
        } else {
            self.offset_in::<{ MAX_DEGREE + 1 }>(at)
        }
    }

    /// The same with place for `N` points.
    fn offset_in<const N: usize>(&self, at: f64) -> P {
        let n = self.degree();
        let mut points = [P::ZERO; N];
        points[..=n].copy_from_slice(&self.numerators);
        let point = collapse(&mut points[..=n], at);
        if self.weights.is_empty() {
            return point;
        }
        let mut weights = [0.0; N];
        weights[..=n].copy_from_slice(&self.weights);
        point * collapse(&mut weights[..=n], at).recip()
    }

    /// The point at `at`, seen from the origin of the piece, and the derivative by `at`.
    pub(super) fn offset_and_velocity(&self, at: f64) -> (P, P) {
        if self.degree() <= SMALL_DEGREE {
            self.velocity_in::<{ SMALL_DEGREE + 1 }>(at)
        } else {
            self.velocity_in::<{ MAX_DEGREE + 1 }>(at)
        }
    }

    fn velocity_in<const N: usize>(&self, at: f64) -> (P, P) {
        let n = self.degree();
        let mut points = [P::ZERO; N];
        let [p, q] = last_two(&self.numerators, &mut points, at);
        let (point, velocity) = (p.mix(q, at), (q - p) * n as f64);
        if self.weights.is_empty() {
            return (point, velocity);
        }
        let mut weights = [0.0; N];
        let [v, w] = last_two(&self.weights, &mut weights, at);
        let (weight, growth) = (v.mix(w, at), (w - v) * n as f64);
        let offset = point * weight.recip();
        (offset, (velocity - offset * growth) * weight.recip())
    }

    pub(super) fn degree(&self) -> usize {
        self.numerators.len() - 1
    }

    /// The largest weight, in the units of [`Self::weights`].
    pub(super) fn largest_weight(&self) -> f64 {
        self.weights.iter().copied().reduce(f64::max).unwrap_or(1.0)
    }

    /// The coefficients of `w P′ − w′ P`; of `P′` if there are no weights.
    pub(super) fn direction(&self) -> Vec<P> {
        let n = self.degree();
        let factor = n as f64;
        if self.weights.is_empty() {
            return self.numerators.windows(2).map(|pair| (pair[1] - pair[0]) * factor).collect();
        }
        let (w, p) = (&self.weights, &self.numerators);
        let forward = product_by(&w[..n], &p[1..], |w, p: P| p * (w * factor));
        let backward = product_by(&w[1..], &p[..n], |w, p: P| p * (w * factor));
        forward.iter().zip(&backward).map(|(&a, &b)| a - b).collect()
    }

    /// An estimate from above of the errors of [`Self::direction`].
    pub(super) fn direction_error(&self) -> f64 {
        4.0 * self.degree() as f64 * self.largest_weight().powi(2) * self.error
    }
}

/// The last two points of de Casteljau's scheme before the apex; the same point twice if there is only one.
fn last_two<P: Point>(points: &[P], scratch: &mut [P], at: f64) -> [P; 2] {
    let n = points.len() - 1;
    let scratch = &mut scratch[..=n];
    scratch.copy_from_slice(points);
    for count in (2..=n).rev() {
        for j in 0..count {
            scratch[j] = scratch[j].mix(scratch[j + 1], at);
        }
    }
    [scratch[0], scratch[n.min(1)]]
}

/// The largest length of a list of points.
pub(super) fn largest<P: Point>(points: &[P]) -> f64 {
    points.iter().map(|p| p.norm()).fold(0.0, f64::max)
}

/// `Σ aᵢ bᵢ`.
pub(super) fn dot<P: Point>(a: P, b: P) -> f64 {
    (0..P::DIMENSION).map(|i| a.coordinate(i) * b.coordinate(i)).sum()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::Side;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn pieces_and_directions_are_those_of_the_curve(curve in any_curve(1..=8), t in 0.0..=1.0_f64) {
            for piece in curve.local_pieces().unwrap() {
                let (a, b) = piece.interval;
                let weight = if piece.weights.is_empty() { 1.0 } else { collapse(&mut piece.weights.clone(), t) };
                let point = collapse(&mut piece.numerators.clone(), t) / weight + piece.origin;
                let side = if t > 0.5 { Side::Left } else { Side::Right };
                let exact = curve.derivatives(a.mix(b, t), 1, side).unwrap();
                prop_assert!(point.distance(exact[0]) < 1e-11 * (1.0 + piece.extent), "{point}: {exact:?}");
                let (offset, growth) = piece.offset_and_velocity(t);
                prop_assert!(offset.distance(point - piece.origin) < 1e-11 * (1.0 + piece.extent), "{offset}");
                prop_assert!((growth / (b - a)).distance(exact[1]) < 1e-9 * (1.0 + exact[1].length()), "{growth}: {exact:?}");
                let velocity = collapse(&mut piece.direction(), t) / (weight * weight) / (b - a);
                prop_assert!(velocity.distance(exact[1]) < 1e-9 * (1.0 + exact[1].length()), "{velocity}: {exact:?}");
            }
        }
    }
}
