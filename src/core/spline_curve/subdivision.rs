//! Uniform subdivision: the control polygons over half the knot distance, again and again.
//!
//! Every control point is doubled, then `n` times each is averaged with the one before: `c̃ₖ = Σᵢ sₖ₋₂ᵢ cᵢ` with the mask
//! `sⱼ = 2⁻ⁿ C(n + 1, j)`. The polygons converge to the curve like the square of the knot distance.
//!
//! J. Lane, R. Riesenfeld, *A theoretical development for the computer generation and display of piecewise polynomial surfaces*, 1980;
//! G. Chaikin, 1974, for degree 2. Course: section 6.3.

use crate::core::bspline::{MAX_DEGREE, Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// Relative difference up to which knot distances count as equal.
const SAME_DISTANCE: f64 = 1e-12;
/// Most points of a refined polygon.
const MAX_POINTS: usize = 1 << 26;
/// The last levels of a closed polygon of at least this size are refined block by block, in the first-level cache.
const BLOCK: usize = 256;
/// So many levels: each needs some points more on the left, which are computed twice.
const BLOCK_LEVELS: usize = 6;

/// The mask `sⱼ = 2⁻ⁿ C(n + 1, j)`, `j = 0 … n + 1`, of degree `n`.
///
/// ```
/// # use spline_lab::core::spline_curve::subdivision_mask;
/// assert_eq!(subdivision_mask(3), [0.125, 0.5, 0.75, 0.5, 0.125]);
/// ```
pub fn subdivision_mask(degree: usize) -> Vec<f64> {
    let mut mask = vec![0.0; degree + 2];
    (mask[0], mask[1]) = (1.0, 1.0);
    for count in 2..degree + 2 {
        for j in (1..=count).rev() {
            mask[j] = 0.5 * (mask[j] + mask[j - 1]);
        }
        mask[0] *= 0.5;
    }
    mask
}

/// The control polygon of a uniform curve of `degree` after `levels` refinements.
///
/// A closed polygon of `m` points becomes one of `2m` points, `c̃ₖ` with `k` modulo `2m`. Of an open one only the points with a complete
/// mask remain in every level, `k = n … 2m − 1`.
///
/// # Errors
///
/// `StepLimit` for a degree above [`MAX_DEGREE`] or more than 2²⁶ points; `Empty`; `SizeMismatch` for an open polygon without
/// `degree + 1` points.
pub fn subdivide_polygon<P: Point>(
    points: &[P],
    degree: usize,
    closed: bool,
    levels: usize,
) -> Result<Vec<P>, SplineError> {
    if degree > MAX_DEGREE {
        return Err(SplineError::StepLimit { what: "degree", value: degree, limit: MAX_DEGREE });
    }
    if points.is_empty() {
        return Err(SplineError::Empty { what: "control points" });
    }
    if !closed && points.len() <= degree {
        let (expected, found) = (degree + 1, points.len());
        return Err(SplineError::SizeMismatch { what: "control points", expected, found });
    }
    let largest =
        u32::try_from(levels).ok().and_then(|levels| points.len().checked_mul(1_usize.checked_shl(levels)?));
    if largest.is_none_or(|count| count > MAX_POINTS) {
        let value = largest.unwrap_or(usize::MAX);
        return Err(SplineError::StepLimit { what: "number of points", value, limit: MAX_POINTS });
    }
    // With the number of taps a constant, the inner loop is unrolled.
    Ok(match degree {
        0 | 1 => refine::<P, 2>(points, degree, closed, levels),
        2 => refine::<P, 2>(points, 2, closed, levels),
        3 => refine::<P, 3>(points, 3, closed, levels),
        4 => refine::<P, 3>(points, 4, closed, levels),
        5 | 6 => refine::<P, 4>(points, degree, closed, levels),
        7 | 8 => refine::<P, 5>(points, degree, closed, levels),
        _ => refine::<P, 14>(points, degree, closed, levels),
    })
}

/// The two masks of one level: `out[2l] = Σ even[i] c[l − i]`, `out[2l + 1] = Σ odd[i] c[l − i]`, `TAPS` at least `(n + 1)/2 + 1` each.
struct Masks<const TAPS: usize> {
    even: [f64; TAPS],
    odd: [f64; TAPS],
}

impl<const TAPS: usize> Masks<TAPS> {
    fn of_degree(degree: usize) -> Self {
        let mask = subdivision_mask(degree);
        // Reversed, so that tap i belongs to the i-th of TAPS increasing indices.
        let tap = |j: usize| mask.get(j).copied().unwrap_or(0.0);
        Self {
            even: std::array::from_fn(|i| tap(2 * (TAPS - 1 - i))),
            odd: std::array::from_fn(|i| tap(2 * (TAPS - 1 - i) + 1)),
        }
    }

    /// `2(line.len() − TAPS + 1)` points, those of the indices from `2(TAPS − 1)` on.
    #[inline(always)]
    fn apply<P: Point>(&self, line: &[P], out: &mut Vec<P>) {
        let count = 2 * (line.len() + 1 - TAPS);
        out.resize(count, P::ZERO);
        for (pair, window) in out.chunks_exact_mut(2).zip(line.windows(TAPS)) {
            let (mut even, mut odd) = (window[0] * self.even[0], window[0] * self.odd[0]);
            for i in 1..TAPS {
                even = even + window[i] * self.even[i];
                odd = odd + window[i] * self.odd[i];
            }
            pair[0] = even;
            pair[1] = odd;
        }
    }
}

fn refine<P: Point, const TAPS: usize>(points: &[P], degree: usize, closed: bool, levels: usize) -> Vec<P> {
    let masks = Masks::<TAPS>::of_degree(degree);
    let mut line = points.to_vec();
    let (mut padded, mut refined) = (Vec::new(), Vec::new());
    for level in 0..levels {
        let count = line.len();
        if closed && count >= BLOCK && levels - level <= BLOCK_LEVELS {
            return refine_in_blocks(&masks, &line, levels - level);
        }
        // TAPS − 1 points before the first one: those of the period before, or any, since only complete masks are kept.
        padded.clear();
        let before = |i: usize| if closed { line[(count * TAPS + 1 + i - TAPS) % count] } else { P::ZERO };
        padded.extend((0..TAPS - 1).map(before));
        padded.extend_from_slice(&line);
        masks.apply(&padded, &mut refined);
        if !closed {
            refined.drain(..degree);
        }
        std::mem::swap(&mut line, &mut refined);
    }
    line
}

/// All levels of one block after the other, so that the intermediate polygons stay in the cache.
fn refine_in_blocks<P: Point, const TAPS: usize>(masks: &Masks<TAPS>, line: &[P], levels: usize) -> Vec<P> {
    let (count, halo) = (line.len(), 2 * (TAPS - 1));
    let mut result = Vec::with_capacity(count << levels);
    let (mut local, mut refined) = (Vec::new(), Vec::new());
    // As many coarse points that a refined block has about BLOCK·8 points, and not many fewer than the halo.
    let step = ((8 * BLOCK) >> levels).max(4 * halo).min(count);
    let mut start = 0;
    while start < count {
        let end = (start + step).min(count);
        local.clear();
        local.extend((0..halo).map(|i| line[(start + count * (halo / count + 1) + i - halo) % count]));
        local.extend_from_slice(&line[start..end]);
        for _ in 0..levels {
            masks.apply(&local, &mut refined);
            std::mem::swap(&mut local, &mut refined);
        }
        // Level by level the halo shrinks and is doubled: it ends where it began.
        result.extend_from_slice(&local[halo..]);
        start = end;
    }
    result
}

impl<P: Point> Spline<P> {
    /// The same spline over uniform knots of half the distance: twice the coefficients if periodic, `2m − n` of `m` if open.
    ///
    /// # Errors
    ///
    /// `KnotsNotUniform` unless all knots, the outer ones too, are equally spaced to 1e-12 of their distance; `StepLimit` above 2²⁶
    /// coefficients.
    pub fn subdivide_uniform(&self) -> Result<Self, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let knots = space.evaluation_knots();
        let (first, last) = (knots[0], knots[knots.len() - 1]);
        let width = (last - first) / (knots.len() - 1) as f64;
        let expected = |k: usize| first + width * k as f64;
        let rounding = SAME_DISTANCE * width + 4.0 * f64::EPSILON * first.abs().max(last.abs());
        if let Some(index) = (0..knots.len()).find(|&k| (knots[k] - expected(k)).abs() > rounding) {
            return Err(SplineError::KnotsNotUniform {
                index,
                value: knots[index],
                expected: expected(index),
            });
        }
        let coefficients = subdivide_polygon(self.coefficients(), n, space.is_periodic(), 1)?;
        let given = space.knots();
        let halved = |k: usize| match (k % 2, given.get(k / 2)) {
            (0, Some(&knot)) => knot,
            _ => {
                let (low, high) = (space.knot((k / 2) as isize), space.knot((k / 2 + 1) as isize));
                low.zip(high).map_or(f64::NAN, |(low, high)| low.mix(high, 0.5))
            }
        };
        let refined = match space.period() {
            Some(period) => SplineSpace::periodic(n, period, (0..2 * given.len()).map(halved).collect())?,
            None => SplineSpace::new(n, (n..=2 * space.dimension() + n).map(halved).collect())?,
        };
        Self::new(refined, coefficients)
    }

    /// The point of the curve to which the control point `k` tends: `Σᵢ bⁿ(i) cₖ₊₍ₙ₊₁₎/₂₋ᵢ` with the uniform B-spline at the integers.
    ///
    /// Odd degrees only, where points stay points; the curve is taken as uniform with the neighbours of `k` around. `None` for even
    /// degrees, and near the ends of an open curve.
    pub fn limit_point_uniform(&self, k: usize) -> Option<P> {
        let n = self.degree();
        if n.is_multiple_of(2) || k >= self.coefficients().len() {
            return None;
        }
        let mut sum = P::ZERO;
        for i in 1..=n {
            let neighbour = self.coefficient(k as isize + n.div_ceil(2) as isize - i as isize)?;
            sum = sum + neighbour * crate::core::bspline::uniform_evaluate(n, i as f64);
        }
        Some(sum)
    }
}

impl<P: Projective> Nurbs<P> {
    /// As [`Spline::subdivide_uniform`], in homogeneous coordinates.
    ///
    /// # Errors
    ///
    /// As [`Spline::subdivide_uniform`].
    pub fn subdivide_uniform(&self) -> Result<Self, SplineError> {
        self.mapped(Spline::subdivide_uniform, Spline::subdivide_uniform)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use proptest::prelude::*;

    fn spline(degree: usize, count: usize, closed: bool) -> Spline<f64> {
        let space = if closed {
            SplineSpace::periodic(degree, count as f64, (0..count).map(|k| k as f64).collect()).unwrap()
        } else {
            SplineSpace::new(degree, (0..count + degree + 1).map(|k| k as f64).collect()).unwrap()
        };
        Spline::new(space, (0..count).map(|k| ((k * k * 5 + 1) % 13) as f64 - 6.0).collect()).unwrap()
    }

    /// Doubling and averaging, as in the head of this file.
    fn slowly(points: &[f64], degree: usize, closed: bool) -> Vec<f64> {
        let mut line: Vec<f64> = points.iter().flat_map(|&p| [p, p]).collect();
        for _ in 0..degree {
            let count = line.len();
            line = (0..count).map(|k| 0.5 * (line[k] + line[(k + count - 1) % count])).collect();
        }
        if closed { line } else { line[degree..].to_vec() }
    }

    proptest! {
        #[test]
        fn masks_are_doubling_and_averaging_and_keep_the_curve(degree in 1_usize..=25, extra in 1_usize..20, closed in any::<bool>()) {
            let spline = spline(degree, if closed { extra } else { degree + extra }, closed);
            let refined = spline.subdivide_uniform().unwrap();
            for (a, b) in refined.coefficients().iter().zip(slowly(spline.coefficients(), degree, closed)) {
                prop_assert!((a - b).abs() < 1e-13, "{a} and {b}");
            }
            prop_assert_eq!(refined.space().parameter_interval(), spline.space().parameter_interval(), "D stays");
            let (left, right) = spline.space().parameter_interval();
            for i in 0..=40 {
                let t = left.mix(right, f64::from(i) / 40.0);
                let error = (refined.evaluate(t).unwrap() - spline.evaluate(t).unwrap()).abs();
                prop_assert!(error < 1e-13, "t = {t}: off by {error}");
            }
        }

        #[test]
        fn blocks_do_not_change_a_bit(degree in 1_usize..=12, count in 200_usize..300, levels in 1_usize..7) {
            let points: Vec<f64> = (0..count).map(|k| ((k * k * 7 + 3) % 101) as f64).collect();
            let at_once = subdivide_polygon(&points, degree, true, levels).unwrap();
            prop_assert_eq!(at_once.len(), count << levels, "number of points");
            let mut stepwise = points;
            for _ in 0..levels {
                stepwise = subdivide_polygon(&stepwise, degree, true, 1).unwrap();
            }
            prop_assert_eq!(at_once, stepwise, "degree {}", degree);
        }
    }

    #[test]
    fn points_tend_to_their_limits_with_the_square_of_the_distance() {
        let mut spline = spline(3, 7, true);
        let limit = spline.limit_point_uniform(4).unwrap();
        let mut k = 4;
        let mut errors = Vec::new();
        for _ in 0..6 {
            errors.push((spline.coefficients()[k] - limit).abs());
            // Point k goes on as number 2 k + 2: the middle of its mask.
            k = (2 * k + 2) % (2 * spline.coefficients().len());
            spline = spline.subdivide_uniform().unwrap();
        }
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1] - 4.0).abs() < 1e-9, "{errors:?}");
        }
        assert_eq!(spline.limit_point_uniform(1000), None, "no such point");
    }

    #[test]
    fn sizes_and_knots_that_do_not_fit_are_refused() {
        let name = |result: Result<Vec<f64>, SplineError>| result.unwrap_err().name();
        assert_eq!(name(subdivide_polygon(&[], 3, true, 1)), "Empty", "no points");
        assert_eq!(name(subdivide_polygon(&[1.0; 3], 3, false, 1)), "SizeMismatch", "too few");
        assert_eq!(name(subdivide_polygon(&[1.0; 3], 26, true, 1)), "StepLimit", "degree");
        assert_eq!(name(subdivide_polygon(&[1.0; 3], 3, true, 25)), "StepLimit", "2^25·3 points");
        assert_eq!(name(subdivide_polygon(&[1.0; 3], 3, true, usize::MAX)), "StepLimit", "levels");
        let space = SplineSpace::new(2, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.5]).unwrap();
        let curve = Nurbs::polynomial(space, vec![DVec2::X; 3]).unwrap();
        assert_eq!(curve.subdivide_uniform().unwrap_err().name(), "KnotsNotUniform", "the last is off");
    }
}
