//! The chord of a Bezier piece and how far the piece keeps to it: a bound of distances that costs a few operations.
//!
//! With control points `cⱼ` of a polynomial piece `r` the difference from the chord, `r(t) − (1 − t) c₀ − t cₙ`, has the control points `cⱼ − (1 − j/n) c₀ − (j/n) cₙ`: no point
//! of the piece is further from the chord than the longest of them. A rational piece stays in the hull of its control points, so that their distances
//! from the chord count. Course: sections 2.2 and 6.2.

use crate::core::point::Point;
use crate::core::spline_curve::local_piece::{LocalPiece, dot};

/// The chord from `−half` to `half`, seen from the origin of its piece, which is its middle.
#[derive(Clone, Debug)]
pub(super) struct Chord<P> {
    half: P,
    /// `1/|half|²`, 0 for a piece that ends where it begins.
    scale: f64,
    /// No point of the piece is further away.
    sagitta: f64,
}

impl<P: Point> Chord<P> {
    pub(super) fn of(piece: &LocalPiece<P>) -> Self {
        let n = piece.degree();
        let weight = |j: usize| piece.weights.get(j).copied().unwrap_or(1.0);
        let point = |j: usize| piece.numerators[j] * weight(j).recip();
        let half = (point(n) - point(0)) * 0.5;
        let squared = dot(half, half);
        let scale = if squared.recip().is_finite() { squared.recip() } else { 0.0 };
        let mut chord = Self { half, scale, sagitta: 0.0 };
        let middle = (point(n) + point(0)) * 0.5;
        let away = |j: usize| match piece.weights.is_empty() {
            true => (point(j) - middle - half * (2.0 * j as f64 / n as f64 - 1.0)).norm(),
            false => chord.distance_squared(point(j)).sqrt(),
        };
        let sagitta = (0..=n).map(away).fold(0.0, f64::max);
        chord.sagitta = sagitta * (1.0 + 1e-12) + middle.norm() + piece.error;
        chord
    }

    /// The squared distance of a place, seen from the origin of the piece.
    fn distance_squared(&self, q: P) -> f64 {
        let along = (dot(q, self.half) * self.scale).clamp(-1.0, 1.0);
        let away = q - self.half * along;
        dot(away, away)
    }

    /// Whether no point of the piece can be nearer to `q` than the square root of `squared`.
    pub(super) fn is_beyond(&self, q: P, squared: f64) -> bool {
        let reach = squared.sqrt() + self.sagitta;
        self.distance_squared(q) > reach * reach
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn no_point_of_a_piece_is_nearer_than_the_bound(
            curve in any_curve(1..=6), place in prop::array::uniform2(-12.0..12.0_f64).prop_map(DVec2::from),
        ) {
            for piece in curve.local_pieces().unwrap() {
                let (chord, (a, b)) = (Chord::of(&piece), piece.interval);
                let samples = (0..=40).map(|i| curve.evaluate(a.mix(b, f64::from(i) / 40.0)).unwrap());
                let nearest = samples.map(|r| r.distance(place)).fold(f64::INFINITY, f64::min);
                let q = place - piece.origin;
                // Of a piece that is a point the bound is attained.
                let within = nearest * (1.0 + 1e-12);
                prop_assert!(!chord.is_beyond(q, within * within), "{chord:?} is said to be beyond {nearest}");
                let far = chord.distance_squared(q).sqrt() - chord.sagitta;
                prop_assume!(far > 1e-6);
                prop_assert!(chord.is_beyond(q, (0.9 * far).powi(2)), "{chord:?} is nearer than {far}");
            }
        }
    }
}
