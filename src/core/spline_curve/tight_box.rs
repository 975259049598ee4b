//! Tight boxes and extreme points.
//!
//! The point of a curve that is furthest in a direction `a` is an end, a corner, or has a tangent at right angles to `a`: a zero of the
//! polynomial `a·(w P′ − w′ P)` of a Bezier piece. A piece whose control points are all less far than a point that is known is left out. Course: beyond, section B.7.

use crate::core::bspline::SplineError;
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::root_finding::{Zeros, bernstein_zeros};
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::local_piece::{LocalPiece, dot};
use crate::core::triangular_scheme::collapse;

/// The smallest box with sides parallel to the axes around a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct TightBox {
    /// The smallest coordinates.
    pub low: Vec<f64>,
    /// The largest coordinates.
    pub high: Vec<f64>,
    /// For every coordinate a parameter at which it is smallest and one at which it is largest; the first of several.
    pub parameters: Vec<[f64; 2]>,
}

/// The places of a curve furthest in a direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    /// The largest value of `direction·r`.
    pub value: f64,
    /// The parameters at which it is reached up to rounding, increasing; of a part on which it is constant both ends.
    pub parameters: Vec<f64>,
}

impl<P: Projective> Nurbs<P> {
    /// The tight box of the curve.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::spline_curve::Nurbs;
    ///
    /// let tight = Nurbs::circle(DVec2::ONE, 2.0)?.tight_box()?;
    /// assert!((tight.low[0] + 1.0).abs() < 1e-14 && (tight.high[1] - 3.0).abs() < 1e-14);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `NonFinite` where differences or products of coordinates overflow.
    pub fn tight_box(&self) -> Result<TightBox, SplineError> {
        let pieces = self.local_pieces()?;
        let mut tight = TightBox { low: Vec::new(), high: Vec::new(), parameters: Vec::new() };
        for axis in 0..P::DIMENSION {
            let [low, high] = [-1.0, 1.0].map(|sign| furthest(&pieces, |p: P| sign * p.coordinate(axis)));
            let (low, high) = (low?, high?);
            tight.low.push(-low.value);
            tight.high.push(high.value);
            tight.parameters.push([low.parameters[0], high.parameters[0]]);
        }
        Ok(tight)
    }

    /// The places furthest in the direction `direction`, of any length.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` for the direction 0.
    pub fn extreme(&self, direction: P) -> Result<Extreme, SplineError> {
        for index in 0..P::DIMENSION {
            let value = direction.coordinate(index);
            if !value.is_finite() {
                return Err(SplineError::NonFinite { what: "coordinate", index, value });
            }
        }
        if direction == P::ZERO {
            return Err(SplineError::Degenerate { what: "the extreme in no direction", parameter: 0.0 });
        }
        furthest(&self.local_pieces()?, |p| dot(direction, p))
    }
}

/// The places at which the linear function `height` is largest.
fn furthest<P: Projective>(
    pieces: &[LocalPiece<P>],
    height: impl Fn(P) -> f64,
) -> Result<Extreme, SplineError> {
    let mut best = Extreme { value: f64::NEG_INFINITY, parameters: Vec::new() };
    for (index, piece) in pieces.iter().enumerate() {
        let n = piece.degree();
        let weight = |j: usize| piece.weights.get(j).copied().unwrap_or(1.0);
        let base = height(piece.origin);
        let heights: Vec<f64> = piece.numerators.iter().map(|&p| height(p)).collect();
        // Values of one size with a rounding error of this size are one.
        let largest =
            heights.iter().enumerate().map(|(j, h)| h / weight(j)).fold(f64::NEG_INFINITY, f64::max);
        let span = heights.iter().enumerate().map(|(j, h)| (h / weight(j)).abs()).fold(base.abs(), f64::max);
        if !span.is_finite() {
            return Err(SplineError::NonFinite { what: "height of piece", index, value: span });
        }
        let same = 16.0 * (n + 1) as f64 * f64::EPSILON * span;
        if base + largest < best.value - same {
            continue;
        }
        let slope: Vec<f64> = piece.direction().into_iter().map(&height).collect();
        let noise = slope.iter().fold(0.0_f64, |most, s| most.max(s.abs())) * 4.0 * n as f64 * f64::EPSILON
            + 4.0 * n as f64 * piece.largest_weight().powi(2) * same / 16.0;
        let inner = match bernstein_zeros(&slope, noise) {
            Zeros::Everywhere => Vec::new(),
            Zeros::Isolated(zeros) => zeros.iter().map(|zero| zero.at).collect(),
        };
        for at in [0.0].into_iter().chain(inner).chain([1.0]) {
            let mut weights = piece.weights.clone();
            let weight = if weights.is_empty() { 1.0 } else { collapse(&mut weights, at) };
            let value = base + collapse(&mut heights.clone(), at) / weight;
            let parameter = piece.interval.0.mix(piece.interval.1, at);
            if value > best.value + same {
                best.parameters.clear();
            }
            if value >= best.value - same && best.parameters.last() != Some(&parameter) {
                best.parameters.push(parameter);
            }
            best.value = best.value.max(value);
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_box_contains_the_curve_and_touches_it_on_every_side(curve in any_curve(1..=8), angle in 0.0..6.3_f64) {
            let tight = curve.tight_box().unwrap();
            let (a, b) = curve.space().parameter_interval();
            let direction = DVec2::from_angle(angle);
            let extreme = curve.extreme(direction).unwrap();
            for i in 0..=500 {
                let point = curve.evaluate(a.mix(b, f64::from(i) / 500.0)).unwrap();
                for axis in 0..2 {
                    let x = point.coordinate(axis);
                    prop_assert!(tight.low[axis] - 1e-12 <= x && x <= tight.high[axis] + 1e-12, "{point} outside {tight:?}");
                }
                prop_assert!(direction.dot(point) <= extreme.value + 1e-12, "{point} is further than {extreme:?}");
            }
            for axis in 0..2 {
                for (side, wanted) in [tight.low[axis], tight.high[axis]].into_iter().enumerate() {
                    let touched = curve.evaluate(tight.parameters[axis][side]).unwrap().coordinate(axis);
                    prop_assert!((touched - wanted).abs() < 1e-11, "{touched} for {wanted}");
                }
            }
            for &t in &extreme.parameters {
                prop_assert!((direction.dot(curve.evaluate(t).unwrap()) - extreme.value).abs() < 1e-10, "{t}: {extreme:?}");
            }
        }
    }

    #[test]
    fn several_extreme_places_are_all_told() {
        let space = SplineSpace::from_breaks(1, &[0.0, 1.0, 2.0, 3.0, 4.0], EndKnots::Interpolating).unwrap();
        let teeth = [[0.0, 0.0], [1.0, 2.0], [2.0, 0.0], [3.0, 2.0], [4.0, 2.0]].map(DVec2::from).to_vec();
        let teeth = Nurbs::polynomial(space, teeth).unwrap();
        assert_eq!(teeth.extreme(DVec2::Y).unwrap(), Extreme { value: 2.0, parameters: vec![1.0, 3.0, 4.0] });
        assert_eq!(teeth.extreme(DVec2::ZERO).unwrap_err().name(), "Degenerate", "no direction");
        assert_eq!(teeth.extreme(DVec2::new(f64::NAN, 0.0)).unwrap_err().name(), "NonFinite", "NaN");
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let arch =
            Nurbs::polynomial(space, vec![DVec3::ZERO, DVec3::new(1.0, 0.0, 2.0), 2.0 * DVec3::X]).unwrap();
        let tight = arch.tight_box().unwrap();
        assert_eq!((tight.low, tight.high), (vec![0.0; 3], vec![2.0, 0.0, 1.0]), "a parabola in space");
        assert_eq!(tight.parameters[2], [0.0, 0.5], "lowest at the start, highest in the middle");
    }
}
