//! The parameter of a point of the plane: nearest samples of the knot cells, then damped Newton steps.

use glam::DVec2;

use crate::core::finite_element::geometry::PlanePatch;

/// A point counts as reached within this part of the size of the control net.
const REACHED: f64 = 1e-12;
/// Samples from which Newton's method is started, nearest first.
const STARTS: usize = 6;
/// Newton converges quadratically; with halved steps at the start this is plenty.
const MAX_STEPS: usize = 60;

impl PlanePatch {
    /// The parameter `t` with `φ(t) = place`; `None` if `place` is not in the patch (or not a point).
    ///
    /// A place within 1e-9 of the size of the net outside the boundary counts as a point of the boundary.
    pub fn invert(&self, place: DVec2) -> Option<DVec2> {
        let (low, high) = self.bounds();
        let size = (high - low).max_element();
        // Points within the tolerance of a side are found by clamped steps that stay at a small distance.
        let near = 1e-9 * size;
        if !place.is_finite() || place.cmplt(low - near).any() || place.cmpgt(high + near).any() {
            return None;
        }
        let lines = [0, 1].map(|axis| self.sample_parameters(axis, self.spaces[axis].degree() + 2));
        let mut starts: Vec<(f64, DVec2)> = Vec::with_capacity(lines[0].len() * lines[1].len());
        for &x in &lines[0] {
            for &y in &lines[1] {
                let t = DVec2::new(x, y);
                starts.push((self.evaluate(t).ok()?.distance_squared(place), t));
            }
        }
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Option<(f64, DVec2)> = None;
        for &(_, start) in starts.iter().take(STARTS) {
            let (distance, t) = self.approach(place, start, REACHED * size);
            if distance <= REACHED * size {
                return Some(t);
            }
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, t));
            }
        }
        best.filter(|(distance, _)| *distance <= near).map(|(_, t)| t)
    }

    /// Corners of the box around the control points, which contains the patch.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.points.iter().fold(start, |(low, high), &point| (low.min(point), high.max(point)))
    }

    /// Newton steps from `t`, halved until the distance falls and kept in the rectangle.
    fn approach(&self, place: DVec2, mut t: DVec2, reached: f64) -> (f64, DVec2) {
        let [low, high] = self.parameter_rectangle();
        let Ok(mut jet) = self.jet(t) else { return (f64::INFINITY, t) };
        let mut distance = jet.point.distance(place);
        for _ in 0..MAX_STEPS {
            let step = jet.parameter_velocity(place - jet.point);
            if distance <= reached || !step.is_finite() {
                break;
            }
            let mut factor = 1.0;
            let better = loop {
                let trial = (t + step * factor).clamp(low, high);
                if let Ok(next) = self.jet(trial) {
                    let closer = next.point.distance(place);
                    if closer < distance {
                        break Some((trial, next, closer));
                    }
                }
                factor *= 0.5;
                if factor < 1e-6 {
                    break None;
                }
            };
            let Some(better) = better else { break };
            (t, jet, distance) = better;
        }
        (distance, t)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::sample_geometries as sample;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_inverse_returns_the_parameter(x in 0.0..=1.0_f64, y in 0.0..=1.0_f64) {
            for patch in [sample::quarter_annulus(1.0, 2.0).unwrap(), sample::book_patch(), sample::channel()] {
                let [low, high] = patch.parameter_rectangle();
                let t = low + (high - low) * DVec2::new(x, y);
                let found = patch.invert(patch.evaluate(t).unwrap());
                prop_assert!(found.is_some_and(|f| f.distance(t) < 1e-10), "{t} comes back as {found:?}");
            }
        }
    }

    #[test]
    fn places_outside_have_no_parameter() {
        let patch = sample::quarter_annulus(1.0, 2.0).unwrap();
        for place in [DVec2::new(0.5, 0.5), DVec2::new(1.9, 1.9), DVec2::new(-0.1, 1.5), DVec2::NAN] {
            assert_eq!(patch.invert(place), None, "{place} is outside");
        }
    }
}
