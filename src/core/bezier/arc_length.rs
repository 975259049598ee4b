//! Arc length between the chord and the control polygon.
//!
//! A part is at least as long as its chord and at most as long as its polygon; halving the parts with the widest gap brings both together. The value in between is
//! `(2 chord + (n − 1) polygon)/(n + 1)`, whose error is of order 4 (J. Gravesen, *Adaptive subdivision and the length and energy of Bezier curves*, 1997).
//! Course: section 2.6.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::{BezierError, check_tolerance};
use crate::core::point::Point;
use crate::core::triangular_scheme::collapse_both;

/// Most parts.
const MAX_PARTS: usize = 100_000;

/// The length of a curve, enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnclosedLength {
    /// The estimate.
    pub value: f64,
    /// Sum of the chords: the curve is not shorter, up to rounding.
    pub lower: f64,
    /// Sum of the polygons: the curve is not longer, up to rounding.
    pub upper: f64,
}

impl<P: Point> BezierCurve<P> {
    /// The arc length over the interval, with bounds that are at most `tolerance` apart.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if 100 000 parts are not enough; `NonFinite` where the length overflows.
    pub fn arc_length(&self, tolerance: f64) -> Result<EnclosedLength, BezierError> {
        check_tolerance(tolerance)?;
        let mut parts = BinaryHeap::from([Part::new(self.points().to_vec())]);
        let mut gap = parts.iter().map(Part::gap).sum::<f64>();
        if !gap.is_finite() {
            return Err(BezierError::NonFinite { what: "length of polygon", index: 0, value: gap });
        }
        while gap > tolerance {
            let Some(widest) = parts.pop() else { break };
            if parts.len() + 2 > MAX_PARTS {
                let (value, limit) = (parts.len() + 2, MAX_PARTS);
                return Err(BezierError::StepLimit { what: "parts", value, limit });
            }
            gap -= widest.gap();
            for half in widest.halves() {
                gap += half.gap();
                parts.push(half);
            }
            // The running difference drifts by rounding; it is summed anew when it says that the work is done.
            if gap <= tolerance {
                gap = parts.iter().map(Part::gap).sum();
            }
        }
        let n = self.degree() as f64;
        let mut length = EnclosedLength { value: 0.0, lower: 0.0, upper: 0.0 };
        for part in parts.into_sorted_vec() {
            length.lower += part.chord;
            length.upper += part.polygon;
            length.value += (2.0 * part.chord + (n - 1.0) * part.polygon) / (n + 1.0);
        }
        if self.degree() == 0 {
            length.value = 0.0;
        }
        Ok(length)
    }
}

/// A part of the curve; the one with the widest gap is the greatest.
struct Part<P> {
    points: Vec<P>,
    chord: f64,
    polygon: f64,
}

impl<P: Point> Part<P> {
    fn new(points: Vec<P>) -> Self {
        let chord = (points[points.len() - 1] - points[0]).norm();
        let polygon = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>().max(chord);
        Self { points, chord, polygon }
    }

    fn gap(&self) -> f64 {
        self.polygon - self.chord
    }

    fn halves(mut self) -> [Self; 2] {
        let mut first = self.points.clone();
        collapse_both(&mut self.points, 0.5, &mut first);
        [Self::new(first), Self::new(self.points)]
    }
}

impl<P: Point> Ord for Part<P> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.gap().total_cmp(&other.gap())
    }
}

impl<P: Point> PartialOrd for Part<P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P: Point> PartialEq for Part<P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<P: Point> Eq for Part<P> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::quadrature::gauss_legendre;
    use glam::DVec2;
    use proptest::prelude::*;

    #[test]
    fn the_parabola_has_its_length_at_every_tolerance() {
        // (t, t²) on [0, 1].
        let curve = BezierCurve::new(vec![DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::ONE]).unwrap();
        let exact = 0.5 * 5.0_f64.sqrt() + 0.25 * (2.0 + 5.0_f64.sqrt()).ln();
        for digits in 0..7 {
            let tolerance = 0.1_f64.powi(digits);
            let length = curve.arc_length(tolerance).unwrap();
            assert!(length.lower <= exact && exact <= length.upper, "{length:?} without {exact}");
            assert!(length.upper - length.lower <= tolerance, "{length:?}");
            assert!((length.value - exact).abs() < 0.1 * tolerance, "{length:?} for {exact}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn chord_length_and_polygon_are_in_this_order(points in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 1..7)) {
            let curve = BezierCurve::new(points).unwrap();
            let length = curve.arc_length(1e-3).unwrap();
            let rule = gauss_legendre(10).unwrap();
            let speed = |x: f64| curve.derivatives(x, 1).unwrap()[1].length();
            let exact: f64 = (0..60).map(|i| rule.integrate(f64::from(i) / 60.0, f64::from(i + 1) / 60.0, speed)).sum();
            prop_assert!(length.lower <= exact + 1e-6 && exact <= length.upper + 1e-6, "{length:?} without {exact}");
            prop_assert!((length.value - exact).abs() < 5e-4, "{length:?} for {exact}");
        }
    }

    #[test]
    fn impossible_tolerances_are_refused() {
        let curve = BezierCurve::new(vec![0.0, 3.0, 1.0]).unwrap();
        assert_eq!(curve.arc_length(0.0).unwrap_err().name(), "InvalidTolerance", "zero");
        let line = BezierCurve::new(vec![0.0, 3.0]).unwrap();
        assert_eq!(line.arc_length(1e-300).unwrap().value, 3.0, "a segment");
        let bend = BezierCurve::new(vec![DVec2::ZERO, DVec2::ONE, DVec2::X]).unwrap();
        assert_eq!(bend.arc_length(1e-30).unwrap_err().name(), "StepLimit", "below rounding");
        let point = BezierCurve::new(vec![7.0]).unwrap();
        assert_eq!(point.arc_length(1.0).unwrap().value, 0.0, "a point");
        assert_eq!(
            BezierCurve::new(vec![-1e308, 1e308]).unwrap().arc_length(1.0).unwrap_err().name(),
            "NonFinite",
            "overflow"
        );
    }
}
