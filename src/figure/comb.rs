//! Curvature combs: teeth normal to a curve, as long as the curvature is large.
//!
//! A tooth points away from the centre of curvature. With `κ = (x′y″ − y′x″)/|r′|³`, positive for left turns, and the unit
//! normal `N` to the left, the tip is `r − scale·κ·N`. At the ends of a knot interval the values are the limits from inside,
//! so that a jump of the curvature at a knot shows. Course: section 6.5.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::point::Point as _;
use crate::core::spline_curve::Nurbs;

/// Where the derivative times the length of the knot interval is below this part of the control polygon's size there is
/// no tooth: the direction of the normal would be rounding.
const SMALLEST_SPEED: f64 = 1e-9;

/// The comb over one knot interval.
#[derive(Clone, Debug, PartialEq)]
pub struct CombSpan {
    /// The knot interval.
    pub interval: (f64, f64),
    /// Parameters of the teeth, increasing.
    pub parameters: Vec<f64>,
    /// Foot on the curve and tip of each tooth.
    pub teeth: Vec<(DVec2, DVec2)>,
    /// Curvature at each tooth, positive for left turns, in 1 / world units.
    pub curvature: Vec<f64>,
}

/// The comb of a curve: for each knot interval `samples_per_span + 1` teeth (at least two) at equal distances of the
/// parameter, both ends included.
///
/// `scale` is the length of a tooth at curvature 1, in world units. Teeth where the speed vanishes are left out, so that there
/// may be fewer.
pub fn curvature_comb(curve: &Nurbs<DVec2>, scale: f64, samples_per_span: usize) -> Vec<CombSpan> {
    let breaks = curve.space().breaks();
    let intervals: Vec<_> = breaks.windows(2).map(|ends| (ends[0], ends[1])).collect();
    curvature_comb_over(curve, scale, samples_per_span, &intervals)
}

/// As [`curvature_comb`] over `intervals`, each of one or several whole knot intervals.
pub fn curvature_comb_over(
    curve: &Nurbs<DVec2>,
    scale: f64,
    samples_per_span: usize,
    intervals: &[(f64, f64)],
) -> Vec<CombSpan> {
    let count = samples_per_span.max(1);
    let first = curve.points()[0];
    let size = curve.points().iter().map(|&point| (point - first).norm()).fold(0.0, f64::max);
    let comb_over = |interval: (f64, f64)| {
        let (a, b) = interval;
        let mut span =
            CombSpan { interval, parameters: Vec::new(), teeth: Vec::new(), curvature: Vec::new() };
        for i in 0..=count {
            let t = a.mix(b, i as f64 / count as f64);
            let side = if i == 0 { Side::Right } else { Side::Left };
            let mut derivatives = [DVec2::ZERO; 3];
            if curve.derivatives_into(t, side, &mut derivatives).is_err() {
                continue;
            }
            let [foot, velocity, acceleration] = derivatives;
            let speed = velocity.norm();
            let curvature = velocity.perp_dot(acceleration) / (speed * speed * speed);
            let is_defined = speed * (b - a) > SMALLEST_SPEED * size && curvature.is_finite();
            if is_defined {
                let normal = velocity.perp() * speed.recip();
                span.parameters.push(t);
                span.teeth.push((foot, foot - normal * (scale * curvature)));
                span.curvature.push(curvature);
            }
        }
        span
    };
    intervals.iter().copied().map(comb_over).collect()
}

/// The largest `|κ|` of a comb, for the legend of its scale; 0 for an empty one.
pub fn largest_curvature(comb: &[CombSpan]) -> f64 {
    comb.iter().flat_map(|span| &span.curvature).fold(0.0, |largest, curvature| curvature.abs().max(largest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    fn quarter_circle(points: [DVec2; 3]) -> Nurbs<DVec2> {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        Nurbs::new(space, points.to_vec(), vec![1.0, 0.5f64.sqrt(), 1.0]).unwrap()
    }

    #[test]
    fn circles_have_constant_teeth_away_from_the_centre() {
        let left = quarter_circle([DVec2::X * 2.0, DVec2::splat(2.0), DVec2::Y * 2.0]);
        let right = quarter_circle([DVec2::Y * 2.0, DVec2::splat(2.0), DVec2::X * 2.0]);
        for (curve, expected) in [(left, 0.5), (right, -0.5)] {
            let comb = curvature_comb(&curve, 3.0, 8);
            assert_eq!((comb.len(), comb[0].teeth.len()), (1, 9), "one knot interval, nine teeth");
            for (curvature, (foot, tip)) in comb[0].curvature.iter().zip(&comb[0].teeth) {
                assert!((curvature - expected).abs() < 1e-12, "{curvature} instead of {expected}");
                assert!((foot.norm() - 2.0).abs() < 1e-12, "foot {foot}");
                assert!((*tip - *foot * 1.75).norm() < 1e-12, "tip {tip} of foot {foot}");
            }
            assert!((largest_curvature(&comb) - 0.5).abs() < 1e-12, "largest");
        }
    }

    #[test]
    fn curvature_jumps_at_a_knot_of_a_quadratic_and_not_of_a_cubic() {
        let points: Vec<DVec2> = (0..7).map(|k| DVec2::new(k as f64, (k as f64 * 1.7).sin())).collect();
        for (degree, jumps) in [(2, true), (3, false)] {
            let knots = (0..points.len() + degree + 1).map(|k| k as f64).collect();
            let space = SplineSpace::new(degree, knots).unwrap();
            let comb = curvature_comb(&Nurbs::polynomial(space, points.clone()).unwrap(), 1.0, 4);
            for pair in comb.windows(2) {
                let (before, after) = (pair[0].curvature[4], pair[1].curvature[0]);
                let jump = (before - after).abs();
                assert_eq!(jump > 1e-6, jumps, "degree {degree}: {before} and {after}");
                assert_eq!(pair[0].parameters[4], pair[1].parameters[0], "the same knot");
            }
        }
    }

    #[test]
    fn no_tooth_where_the_speed_vanishes() {
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0]).unwrap();
        let points = vec![DVec2::ZERO, DVec2::ZERO, DVec2::X, DVec2::ONE];
        let comb = curvature_comb(&Nurbs::polynomial(space.clone(), points).unwrap(), 1.0, 4);
        assert_eq!(comb[0].teeth.len(), 4, "all but the first");
        let point = Nurbs::polynomial(space, vec![DVec2::ONE; 4]).unwrap();
        let comb = curvature_comb(&point, 1.0, 4);
        assert!(comb[0].teeth.is_empty(), "a curve that is a point");
        assert_eq!(largest_curvature(&comb), 0.0, "an empty comb");
    }
}
