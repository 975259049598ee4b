//! How far a plane curve is from being symmetric.
//!
//! Points at equal steps of the arc length, as complex numbers `zᵢ` around their mean. A reflection `z ↦ u z̄` with `|u| = 1` takes the curve to itself backwards:
//! of all `u`, the sum of `|u z̄ᵢ − wᵢ|²` with the backward points `wᵢ` is least for `u = Σ zᵢwᵢ/|Σ zᵢwᵢ|`. A half turn takes an open curve to itself backwards,
//! a closed one to itself half a length on. For closed curves all starts are tried, and the best is refined.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::spline_curve::Nurbs;

/// Steps of the arc length.
const STEPS: usize = 256;

/// What a curve is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SymmetryKind {
    /// Its mirror image: the axis through this point with this unit direction.
    Axis {
        /// The mean of the points.
        through: DVec2,
        /// Along the axis.
        direction: DVec2,
    },
    /// Its image under a half turn around this point.
    Center(DVec2),
}

/// The nearest symmetry of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetry {
    /// Axis or centre.
    pub kind: SymmetryKind,
    /// The largest distance seen between points of the curve and of its image that belong together.
    pub deviation: f64,
}

impl Nurbs<DVec2> {
    /// The best axis and the best centre of symmetry, the one with the smaller deviation first. Deviations are sampled, and of closed curves the axis is found up to about
    /// 1e-5 of the length.
    ///
    /// # Errors
    ///
    /// `Degenerate` for a curve without length.
    pub fn symmetries(&self) -> Result<[Symmetry; 2], SplineError> {
        let track = Track::new(self)?;
        let closed = self.space().is_periodic();
        // An open curve has both ends among its points.
        let steps = if closed { STEPS as f64 } else { (STEPS - 1) as f64 };
        let at = |i: f64| track.at(i / steps, closed);
        let points: Vec<DVec2> = (0..STEPS).map(|i| at(i as f64)).collect();
        let mean = points.iter().fold(DVec2::ZERO, |sum, &p| sum + p) / STEPS as f64;
        // Backwards from place `start`.
        let mirrored = |start: f64| {
            let product = |i: usize| complex_product(points[i] - mean, at(start - i as f64) - mean);
            (0..STEPS).fold(DVec2::ZERO, |sum, i| sum + product(i))
        };
        let start = if closed {
            let score = |start: f64| mirrored(start).length();
            let best = (0..STEPS).map(|m| (score(m as f64), m)).max_by(|a, b| a.0.total_cmp(&b.0));
            golden_maximum(best.map_or(0.0, |(_, m)| m as f64), score)
        } else {
            steps
        };
        let product = mirrored(start);
        let turn = if product.length() > 0.0 { product.normalize() } else { DVec2::X };
        let deviation = |image: &dyn Fn(usize) -> (DVec2, DVec2)| {
            (0..STEPS).map(image).map(|(a, b)| a.distance(b)).fold(0.0, f64::max)
        };
        let conjugate = |z: DVec2| DVec2::new(z.x, -z.y);
        let axis = Symmetry {
            kind: SymmetryKind::Axis { through: mean, direction: DVec2::from_angle(0.5 * turn.to_angle()) },
            deviation: deviation(&|i| {
                (complex_product(turn, conjugate(points[i] - mean)), at(start - i as f64) - mean)
            }),
        };
        let partner = |i: usize| if closed { at(i as f64 + 0.5 * steps) } else { at(steps - i as f64) };
        let center = Symmetry {
            kind: SymmetryKind::Center(mean),
            deviation: deviation(&|i| (mean - points[i], partner(i) - mean)),
        };
        Ok(if center.deviation < axis.deviation { [center, axis] } else { [axis, center] })
    }
}

fn complex_product(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// The largest value of `f` within 1 of `at`, by golden sections.
fn golden_maximum(at: f64, f: impl Fn(f64) -> f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (at - 1.0, at + 1.0);
    for _ in 0..32 {
        let (c, d) = (b - SHARE * (b - a), a + SHARE * (b - a));
        if f(c) > f(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}

/// A fine polygon on the curve, by the share of its length.
struct Track {
    points: Vec<DVec2>,
    lengths: Vec<f64>,
}

impl Track {
    fn new(curve: &Nurbs<DVec2>) -> Result<Self, SplineError> {
        let breaks = curve.space().breaks();
        let count = (8192 / breaks.len()).max(16);
        let mut points = vec![curve.evaluate(breaks[0])?];
        for pair in breaks.windows(2) {
            for i in 1..=count {
                points.push(curve.evaluate(pair[0].mix(pair[1], i as f64 / count as f64))?);
            }
        }
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }
        let total = lengths[lengths.len() - 1];
        if !(total > 0.0 && total.is_finite()) {
            return Err(SplineError::Degenerate { what: "the symmetry", parameter: breaks[0] });
        }
        Ok(Self { points, lengths })
    }

    fn at(&self, share: f64, closed: bool) -> DVec2 {
        let share = if closed { share.rem_euclid(1.0) } else { share.clamp(0.0, 1.0) };
        let length = share * self.lengths[self.lengths.len() - 1];
        let after = self.lengths.partition_point(|&l| l <= length).clamp(1, self.points.len() - 1);
        let (low, high) = (self.lengths[after - 1], self.lengths[after]);
        let part = if high > low { ((length - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        self.points[after - 1].mix(self.points[after], part)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};

    #[test]
    fn a_turned_arch_has_its_axis_and_a_turned_wave_its_centre() {
        let space = SplineSpace::from_breaks(3, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let place = |p: [f64; 2]| DVec2::from_angle(0.4).rotate(DVec2::from(p)) + DVec2::new(3.0, 1.0);
        let arch = [[-2.0, 0.0], [-1.0, 2.0], [1.0, 2.0], [2.0, 0.0]].map(place).to_vec();
        let [best, other] = Nurbs::polynomial(space.clone(), arch).unwrap().symmetries().unwrap();
        let SymmetryKind::Axis { through, direction } = best.kind else { panic!("{best:?}") };
        assert!(best.deviation < 1e-9 && other.deviation > 0.5, "{best:?} {other:?}");
        let up = DVec2::from_angle(0.4 + std::f64::consts::FRAC_PI_2);
        assert!(direction.perp_dot(up).abs() < 1e-9, "the direction {direction}");
        assert!((through - DVec2::new(3.0, 1.0)).perp_dot(up).abs() < 1e-9, "through {through}");
        let wave = [[-2.0, 0.0], [-1.0, 2.0], [1.0, -2.0], [2.0, 0.0]].map(place).to_vec();
        let best = Nurbs::polynomial(space, wave).unwrap().symmetries().unwrap()[0];
        let SymmetryKind::Center(center) = best.kind else { panic!("{best:?}") };
        assert!(center.distance(DVec2::new(3.0, 1.0)) < 1e-9 && best.deviation < 1e-9, "{best:?}");
    }

    #[test]
    fn a_closed_curve_whose_axis_meets_no_knot_is_found_nearly_symmetric() {
        let points: Vec<DVec2> =
            [[3.0, 0.3], [1.0, 1.5], [-2.0, 1.0], [-2.0, -1.0], [1.0, -1.5], [3.0, -0.3]]
                .map(DVec2::from)
                .to_vec();
        let best = Nurbs::closed(points, vec![1.0; 6], 3).unwrap().symmetries().unwrap()[0];
        let SymmetryKind::Axis { direction, .. } = best.kind else { panic!("{best:?}") };
        assert!(direction.y.abs() < 1e-4 && best.deviation < 1e-3, "{best:?}");
        let skew = Nurbs::closed(
            [[3.0, 0.0], [1.0, 2.0], [-2.0, 0.0], [0.0, -1.0]].map(DVec2::from).to_vec(),
            vec![1.0; 4],
            3,
        );
        assert!(skew.unwrap().symmetries().unwrap()[0].deviation > 1e-2, "no symmetry");
    }
}
