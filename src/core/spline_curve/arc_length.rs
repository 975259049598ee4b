//! Arc length of a curve and its inverse.
//!
//! `s(t) = ∫ |r′|` is smooth between the knots as long as `r′ ≠ 0`. Each knot interval is halved until Gauss' rule with ten points over a part and over its
//! two halves agree; the value over the halves is taken, and what it differs by estimates the error from above. The inverse starts in the
//! part that holds the length and is found by Newton's method kept inside a shrinking bracket. Course: beyond, section B.4.

use crate::core::bspline::{Side, SplineError};
use crate::core::point::Point as _;
use crate::core::quadrature::{GaussRule, gauss_legendre};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// Points of Gauss' rule.
const GAUSS_POINTS: usize = 10;
/// Halvings after which a stop beside an end is too short to matter.
const SEEN: usize = 16;
/// How much more Lobatto's rule may differ.
const ROUGH: f64 = 1e4;
/// Halvings of one knot interval.
const MAX_DEPTH: usize = 40;
/// Steps of the inverse; halving alone needs fewer for 53 bits.
const MAX_STEPS: usize = 80;

/// The arc length of a curve as a function of its parameter, ready for many values.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::spline_curve::{ArcLength, Nurbs};
///
/// let circle = Nurbs::circle(DVec2::ZERO, 2.0)?;
/// let length = ArcLength::new(&circle, 1e-12)?;
/// assert!((length.total() - 4.0 * std::f64::consts::PI).abs() < 1e-11);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ArcLength<P: Projective> {
    curve: Nurbs<P>,
    rule: GaussRule,
    tolerance: f64,
    /// Ends of the parts, and the length up to there.
    ends: Vec<f64>,
    lengths: Vec<f64>,
    error: f64,
}

impl<P: Projective> ArcLength<P> {
    /// The length of `curve` over D, or over one period, within about `tolerance`.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` where 40 halvings of a knot interval are not enough; `NonFinite` where the speed overflows.
    pub fn new(curve: &Nurbs<P>, tolerance: f64) -> Result<Self, SplineError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        let rule = gauss_legendre(GAUSS_POINTS).expect("ten points");
        let (left, right) = curve.space().parameter_interval();
        let mut length =
            Self { curve: curve.clone(), rule, tolerance, ends: vec![left], lengths: vec![0.0], error: 0.0 };
        let mut total = 0.0;
        for pair in curve.space().breaks().windows(2) {
            let mut stack = vec![(pair[0], pair[1], length.gauss(pair[0], pair[1]), 0)];
            while let Some((a, b, whole, depth)) = stack.pop() {
                let middle = a.mix(b, 0.5);
                let halves = [length.gauss(a, middle), length.gauss(middle, b)];
                let sum = halves[0] + halves[1];
                if !sum.is_finite() {
                    return Err(SplineError::NonFinite {
                        what: "length of part",
                        index: length.ends.len() - 1,
                        value: sum,
                    });
                }
                let gap = (sum - whole).abs();
                // Rounding of the sum is as good as agreement.
                let allowed = (tolerance * (b - a) / (right - left)).max(8.0 * f64::EPSILON * sum);
                // A cusp between an end and the next Gauss point is seen from the end alone.
                let agree = gap <= allowed
                    && (depth >= SEEN || (sum - length.lobatto(a, b)).abs() <= ROUGH * allowed);
                if agree || !(a < middle && middle < b) {
                    total += sum;
                    length.error += gap;
                    length.ends.push(b);
                    length.lengths.push(total);
                } else if depth == MAX_DEPTH {
                    return Err(SplineError::StepLimit {
                        what: "halvings of a part",
                        value: depth + 1,
                        limit: MAX_DEPTH,
                    });
                } else {
                    stack.push((middle, b, halves[1], depth + 1));
                    stack.push((a, middle, halves[0], depth + 1));
                }
            }
        }
        Ok(length)
    }

    /// The whole length.
    pub fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// What the two rules differ by in all parts together: an estimate from above of the error of [`Self::total`].
    pub fn error(&self) -> f64 {
        self.error
    }

    /// `s(t)` for `t` in D; of a closed curve for `t` in one period from its start, and the period added up for others.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn at(&self, t: f64) -> Result<f64, SplineError> {
        let reduced = self.curve.space().reduce(t)?;
        let turns = self.curve.space().period().map_or(0.0, |period| ((t - reduced) / period).round());
        let part = self.ends.partition_point(|&end| end <= reduced).clamp(1, self.ends.len() - 1) - 1;
        Ok(turns * self.total() + self.lengths[part] + self.between(self.ends[part], reduced))
    }

    /// The parameter with `s(t) = length`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` if `length` is outside `[0, total]` by more than the tolerance.
    pub fn inverse(&self, length: f64) -> Result<f64, SplineError> {
        if !length.is_finite() {
            return Err(SplineError::NonFinite { what: "length", index: 0, value: length });
        }
        let total = self.total();
        if length < -self.tolerance || length > total + self.tolerance {
            return Err(SplineError::OutsideInterval { value: length, left: 0.0, right: total });
        }
        let length = length.clamp(0.0, total);
        let part = self.lengths.partition_point(|&end| end <= length).clamp(1, self.ends.len() - 1) - 1;
        let (start, wanted) = (self.ends[part], length - self.lengths[part]);
        let (mut low, mut high) = (start, self.ends[part + 1]);
        // At an end of a part where the curve rests, the last digit of a length would move the parameter far.
        for end in [part, part + 1] {
            if (length - self.lengths[end]).abs() <= 4.0 * f64::EPSILON * total {
                return Ok(self.ends[end]);
            }
        }
        let share = wanted / (self.lengths[part + 1] - self.lengths[part]);
        let mut t = if share.is_finite() { low.mix(high, share.clamp(0.0, 1.0)) } else { low };
        for _ in 0..MAX_STEPS {
            let gap = self.between(start, t) - wanted;
            let newton = t - gap / self.speed(t);
            if gap == 0.0 || (newton - t).abs() <= f64::EPSILON * t.abs() {
                break;
            }
            if gap > 0.0 {
                high = t;
            } else {
                low = t;
            }
            t = if low < newton && newton < high { newton } else { low.mix(high, 0.5) };
            if !(low < t && t < high) {
                break;
            }
        }
        Ok(t)
    }

    /// `count` parameters, at least 2, at equal distances along the curve, the ends of D among them.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for fewer than 2.
    pub fn equally_spaced(&self, count: usize) -> Result<Vec<f64>, SplineError> {
        if count < 2 {
            return Err(SplineError::SizeMismatch { what: "parameters", expected: 2, found: count });
        }
        let (left, right) = self.curve.space().parameter_interval();
        let step = self.total() / (count - 1) as f64;
        (0..count)
            .map(|k| match k {
                0 => Ok(left),
                _ if k == count - 1 => Ok(right),
                _ => self.inverse(step * k as f64),
            })
            .collect()
    }

    /// `|r′(t)|` for `t` in D.
    fn speed(&self, t: f64) -> f64 {
        self.curve.derivatives(t, 1, Side::Right).map_or(f64::NAN, |values| values[1].norm())
    }

    fn gauss(&self, a: f64, b: f64) -> f64 {
        self.rule.integrate(a, b, |t| self.speed(t))
    }

    /// Lobatto's rule of six points, the ends among them.
    fn lobatto(&self, a: f64, b: f64) -> f64 {
        let (middle, half, root) = (a.mix(b, 0.5), 0.5 * (b - a), 7.0_f64.sqrt());
        let pair = |x: f64| self.speed(middle - half * x) + self.speed(middle + half * x);
        let inner =
            |sign: f64| (14.0 + sign * root) / 30.0 * pair((1.0 / 3.0 - sign * 2.0 * root / 21.0).sqrt());
        half * (pair(1.0) / 15.0 + inner(1.0) + inner(-1.0))
    }

    /// The length from the start `a` of a part to `t` in it.
    fn between(&self, a: f64, t: f64) -> f64 {
        let middle = a.mix(t, 0.5);
        self.gauss(a, middle) + self.gauss(middle, t)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use std::f64::consts::PI;

    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn lengths_add_up_invert_and_lie_between_chord_and_polygon(curve in any_curve(2..=5), share in 0.05..0.95_f64) {
            let Ok(length) = ArcLength::new(&curve, 1e-9) else { return Ok(()) };
            let (a, b) = curve.space().parameter_interval();
            let t = a.mix(b, share);
            let s = length.at(t).unwrap();
            let back = length.inverse(s).unwrap();
            // Where the curve rests the parameter is not determined.
            prop_assert!((length.at(back).unwrap() - s).abs() < 1e-8, "s({t}) = {s}, s({back})");
            let pieces = curve.bezier_form();
            let chord: f64 = pieces.iter().map(|piece| piece.points[0].distance(piece.points[curve.degree()])).sum();
            let polygon: f64 = pieces.iter().flat_map(|piece| piece.points.windows(2)).map(|leg| leg[0].distance(leg[1])).sum();
            prop_assert!(chord - 1e-8 <= length.total() && length.total() <= polygon + 1e-8, "{chord} {} {polygon}", length.total());
            let times = 3.0;
            let points = curve.points().iter().map(|&point| DVec2::from_angle(0.7).rotate(point * times) + DVec2::ONE).collect();
            let image = Nurbs::new(curve.space().clone(), points, curve.weights().to_vec()).unwrap();
            let scaled = ArcLength::new(&image, 1e-9).unwrap().total();
            prop_assert!((scaled - times * length.total()).abs() < 1e-7, "{scaled} and {}", length.total());
            if let Ok(refined) = curve.insert_knot(t) {
                let same = ArcLength::new(&refined, 1e-9).unwrap().total();
                prop_assert!((same - length.total()).abs() < 1e-8, "{same} and {}", length.total());
            }
        }
    }

    #[test]
    fn a_curve_that_all_but_stops_near_a_knot_is_measured() {
        // The speed falls to almost 0 at 3.0026, between the knot 3 and the next Gauss point.
        let space = SplineSpace::periodic(5, 5.0, vec![0.0, 3.0, 4.0, 4.0]).unwrap();
        let points = [
            [6.920262471973405, 4.599106788614756],
            [-7.261272993070345, 6.3605344980703125],
            [2.834958287509701, -4.841544491426817],
            [-5.403299474847492, -7.8481753894165145],
        ];
        let curve = Nurbs::polynomial(space, points.map(DVec2::from).to_vec()).unwrap();
        let pieces = curve.without_weights().bezier_curves().unwrap();
        let bounds = pieces.iter().map(|piece| piece.arc_length(1e-6).unwrap());
        let (low, high) = bounds.fold((0.0, 0.0), |(low, high), part| (low + part.lower, high + part.upper));
        let total = ArcLength::new(&curve, 1e-9).unwrap().total();
        assert!(low <= total && total <= high, "{low} {total} {high}");
    }

    #[test]
    fn points_at_equal_distances_have_equal_arcs_between_them() {
        let circle = Nurbs::circle(DVec2::ONE, 3.0).unwrap();
        let length = ArcLength::new(&circle, 1e-12).unwrap();
        assert!((length.total() - 6.0 * PI).abs() < 1e-11 && length.error() < 1e-11, "{length:?}");
        let points: Vec<DVec2> =
            length.equally_spaced(13).unwrap().iter().map(|&t| circle.evaluate(t).unwrap()).collect();
        let chord = 6.0 * (PI / 12.0).sin();
        for pair in points.windows(2) {
            assert!((pair[0].distance(pair[1]) - chord).abs() < 1e-11, "{pair:?}");
        }
        assert_eq!(length.equally_spaced(1).unwrap_err().name(), "SizeMismatch", "one point");
    }

    #[test]
    fn a_closed_curve_goes_on() {
        let corners = (0..5).map(|k| DVec2::from_angle(f64::from(k))).collect();
        let closed = Nurbs::closed(corners, vec![1.0; 5], 3).unwrap();
        let length = ArcLength::new(&closed, 1e-11).unwrap();
        let (start, period) = (closed.space().parameter_interval().0, 5.0);
        let s = length.at(start + 1.3).unwrap();
        let later = length.at(start + 1.3 + 2.0 * period).unwrap();
        assert!((later - s - 2.0 * length.total()).abs() < 1e-9, "{later} and {s}");
    }

    #[test]
    fn a_cusp_in_space_and_a_curve_of_high_degree() {
        let breaks = [0.0, 1.0];
        // (u², u³, 0) with u = t − 0.3, a cusp where no halving falls.
        let c = 0.3_f64;
        let blossom = |u: [f64; 3]| {
            let v = u.map(|u| u - c);
            DVec3::new((v[0] * v[1] + v[1] * v[2] + v[2] * v[0]) / 3.0, v[0] * v[1] * v[2], 0.0)
        };
        let points = (0..4).map(|k| blossom([0, 1, 2].map(|i| if i < k { 1.0 } else { 0.0 }))).collect();
        let space = SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating).unwrap();
        let cusp = Nurbs::polynomial(space, points).unwrap();
        let part = |u: f64| ((4.0 + 9.0 * u * u).powf(1.5) - 8.0) / 27.0;
        let exact = part(c) + part(1.0 - c);
        let found = ArcLength::new(&cusp, 1e-10).unwrap().total();
        assert!((found - exact).abs() < 1e-9, "{found} instead of {exact}");
        let space = SplineSpace::from_breaks(20, &breaks, EndKnots::Interpolating).unwrap();
        let line = (0..=20).map(|k| DVec3::splat(f64::from(k) / 20.0)).collect();
        let length = ArcLength::new(&Nurbs::polynomial(space, line).unwrap(), 1e-12).unwrap();
        assert!((length.total() - 3.0_f64.sqrt()).abs() < 1e-13, "a segment: {}", length.total());
        assert!((length.inverse(0.25 * length.total()).unwrap() - 0.25).abs() < 1e-12, "its quarter");
    }

    #[test]
    fn impossible_questions_are_refused() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        assert_eq!(ArcLength::new(&circle, -1.0).unwrap_err().name(), "InvalidTolerance", "tolerance");
        let length = ArcLength::new(&circle, 1e-9).unwrap();
        assert_eq!(length.inverse(7.0).unwrap_err().name(), "OutsideInterval", "too long");
        assert_eq!(length.inverse(f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
        assert!(length.inverse(-1e-10).is_ok(), "within the tolerance");
    }
}
