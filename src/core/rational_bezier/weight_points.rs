//! Weight points: `dₖ = (wₖ₋₁ cₖ₋₁ + wₖ cₖ)/(wₖ₋₁ + wₖ)` on the edges of the control polygon.
//!
//! Where `dₖ` divides its edge tells the ratio of both weights, so control points and weight points determine the curve. Course: section 3.1;
//! G. Farin, *Algorithms for rational Bezier curves*, 1983.

use crate::core::rational_bezier::error::{RationalBezierError, check_finite};
use crate::core::rational_bezier::{Projective, RationalBezier};

/// Distance from its edge, relative to the length of the edge, up to which a weight point lies on it.
const ON_EDGE: f64 = 1e-9;

impl<P: Projective> RationalBezier<P> {
    /// The weight points `d₁ … dₙ`, one for each edge of the control polygon.
    pub fn weight_points(&self) -> Vec<P> {
        let shares = self.weight_shares();
        self.points().windows(2).zip(shares).map(|(edge, share)| edge[0].mix(edge[1], share)).collect()
    }

    /// Where the weight points divide their edges: `wₖ/(wₖ₋₁ + wₖ)` for `k = 1 … n`.
    pub fn weight_shares(&self) -> Vec<f64> {
        // By the ratio of both weights, whose sum may overflow.
        self.weights().windows(2).map(|pair| (1.0 + pair[0] / pair[1]).recip()).collect()
    }

    /// The curve over `[0, 1]` with the given control points, the first weight 1, and the given shares `wₖ/(wₖ₋₁ + wₖ)`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there is a share for each edge; `NonFinite`; `WeightNotPositive` with the index `k` of the first share outside `(0, 1)`, or of
    /// a weight that under- or overflows; those of [`RationalBezier::new`].
    pub fn from_weight_shares(points: Vec<P>, shares: &[f64]) -> Result<Self, RationalBezierError> {
        let (expected, found) = (points.len().saturating_sub(1), shares.len());
        if expected != found {
            return Err(RationalBezierError::SizeMismatch { what: "weight shares", expected, found });
        }
        check_finite("weight share", shares)?;
        let mut weights = vec![1.0; points.len()];
        for (k, &share) in shares.iter().enumerate() {
            if share <= 0.0 || share >= 1.0 {
                return Err(RationalBezierError::WeightNotPositive { index: k + 1, value: share });
            }
            weights[k + 1] = weights[k] * (share / (1.0 - share));
        }
        Self::new(points, weights)
    }

    /// The curve over `[0, 1]` with the given control points and weight points, and the first weight 1.
    ///
    /// # Errors
    ///
    /// Those of [`Self::from_weight_shares`]; `Degenerate` for an edge of length 0, `NoSolution` for a weight point off its edge.
    pub fn from_weight_points(points: Vec<P>, weight_points: &[P]) -> Result<Self, RationalBezierError> {
        let mut shares = Vec::with_capacity(weight_points.len());
        for (edge, &at) in points.windows(2).zip(weight_points) {
            let (way, along) = (at - edge[0], edge[1] - edge[0]);
            let dot = |a: P, b: P| (0..P::DIMENSION).map(|i| a.coordinate(i) * b.coordinate(i)).sum::<f64>();
            let length = along.norm();
            if length <= 0.0 {
                let value = shares.len() as f64;
                return Err(RationalBezierError::Degenerate { what: "the weight point of an edge", value });
            }
            let direction = along * length.recip();
            let share = dot(way, direction) / length;
            if (way - along * share).norm() > ON_EDGE * length {
                return Err(RationalBezierError::NoSolution { reason: "a weight point is not on its edge" });
            }
            shares.push(share);
        }
        shares.resize(weight_points.len(), 0.0);
        Self::from_weight_shares(points, &shares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::curve::tests::curves;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn weight_points_determine_the_weights(curve in curves()) {
            let points = curve.points().to_vec();
            prop_assume!(points.windows(2).all(|pair| (pair[1] - pair[0]).length() > 0.1));
            let by_points = RationalBezier::from_weight_points(points.clone(), &curve.weight_points()).unwrap();
            let by_shares = RationalBezier::from_weight_shares(points, &curve.weight_shares()).unwrap();
            for again in [by_points, by_shares] {
                for (a, b) in again.weights().iter().zip(curve.weights()) {
                    prop_assert!((a * curve.weights()[0] / b - 1.0).abs() < 1e-10, "{a} and {b}");
                }
            }
        }
    }

    #[test]
    fn impossible_weight_points_are_refused() {
        let points = vec![DVec2::ZERO, DVec2::X];
        let name = |d: &[DVec2]| RationalBezier::from_weight_points(points.clone(), d).unwrap_err().name();
        assert_eq!(name(&[]), "SizeMismatch", "none");
        assert_eq!(name(&[DVec2::X]), "WeightNotPositive", "at a corner");
        assert_eq!(name(&[DVec2::new(0.5, 0.1)]), "NoSolution", "beside the edge");
        assert_eq!(name(&[DVec2::NAN]), "NonFinite", "no point");
        let twice = RationalBezier::from_weight_points(vec![DVec2::X; 2], &[DVec2::X]);
        assert_eq!(twice.unwrap_err().name(), "Degenerate", "no edge");
    }
}
