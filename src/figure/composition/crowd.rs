//! How much of a curve with very many control points is drawn: what is seen, and what would only be a smear.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, Object, PointLabels};
use crate::figure::picture::Viewport;

/// With more control points in view they are dots, and knots are not drawn.
const MANY_POINTS: usize = 2000;
/// With more control points in view they have no labels.
const MANY_LABELS: usize = 400;
/// Curves with fewer control points are drawn whole, also beyond the page.
const FEW_POINTS: usize = 600;
/// The comb has about as many teeth in view.
const MANY_TEETH: usize = 3000;
/// Parts of the page beside it that count as seen: labels and markers have a width.
const MARGIN: f64 = 0.1;

/// The part of a curve that is in view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crowd {
    low: DVec2,
    high: DVec2,
    /// Control points in view.
    points: usize,
}

impl Crowd {
    /// What is seen of `curve` through `viewport`; of a curve with few control points everything.
    pub(super) fn of(curve: &Nurbs<DVec2>, viewport: &Viewport) -> Self {
        let half = viewport.size * ((0.5 + MARGIN) / viewport.scale);
        let mut crowd = Self { low: viewport.center - half, high: viewport.center + half, points: 0 };
        if curve.points().len() <= FEW_POINTS {
            (crowd.low, crowd.high) = (DVec2::NEG_INFINITY, DVec2::INFINITY);
        }
        crowd.points = curve.points().iter().filter(|&&at| crowd.sees(at)).count();
        crowd
    }

    /// Whether the place is in view.
    pub(super) fn sees(&self, at: DVec2) -> bool {
        at.cmpge(self.low).all() && at.cmple(self.high).all()
    }

    /// Whether control points are small dots.
    pub(super) fn dots(&self) -> bool {
        self.points > MANY_POINTS
    }

    /// Whether control points have labels.
    pub(super) fn labels(&self) -> bool {
        self.points <= MANY_LABELS
    }

    /// Whether the curve just behind the parameter `t` may be in view: the box of its active control points is.
    pub(super) fn sees_near(&self, curve: &Nurbs<DVec2>, t: f64) -> bool {
        let Ok(span) = curve.space().span(t) else { return false };
        let n = curve.degree();
        let active = || (span - n..=span).map(|k| curve.without_weights().evaluation_coefficient(k));
        let low = active().fold(DVec2::INFINITY, DVec2::min);
        let high = active().fold(DVec2::NEG_INFINITY, DVec2::max);
        low.cmple(self.high).all() && high.cmpge(self.low).all()
    }

    /// The intervals over which the comb is drawn, and how many teeth each has: all knot intervals in view as long as they are not too many; else each stands for
    /// several knot intervals.
    pub(super) fn comb_intervals(&self, curve: &Nurbs<DVec2>, teeth: usize) -> (Vec<(f64, f64)>, usize) {
        let breaks = curve.space().breaks();
        let all = breaks.windows(2).map(|ends| (ends[0], ends[1]));
        let seen: Vec<(f64, f64)> = all.filter(|&(a, _)| self.sees_near(curve, a)).collect();
        let count = (MANY_TEETH / seen.len().max(1)).clamp(1, teeth.max(1));
        let together = seen.len().div_ceil(MANY_TEETH).max(1);
        if together == 1 {
            return (seen, count);
        }
        let joined = |part: &[(f64, f64)]| (part[0].0, part[part.len() - 1].1);
        // Neighbours only: between two parts in view there may be one that is not.
        let neighbours = seen.chunk_by(|a, b| a.1 >= b.0);
        (neighbours.flat_map(|run| run.chunks(together).map(joined)).collect(), count)
    }

    fn thins_comb(&self, curve: &Nurbs<DVec2>, teeth: usize) -> bool {
        self.points * teeth > MANY_TEETH && self.comb_intervals(curve, teeth).1 < teeth
    }
}

/// What is not drawn, or drawn coarser, because too many control points are in view; a sentence for whoever looks at them, `None` if nothing is left out.
pub fn left_out(object: &Object, viewport: &Viewport) -> Option<String> {
    let (curve, display) = (object.curve()?, object.curve_display()?);
    if curve.points().len() <= MANY_LABELS.min(FEW_POINTS) || !object.visible {
        return None;
    }
    let crowd = Crowd::of(curve, viewport);
    let words = words(&crowd, curve, display);
    (!words.is_empty())
        .then(|| format!("{} points in view: {}. Zoom in to see them all", crowd.points, words.join(", ")))
}

fn words(crowd: &Crowd, curve: &Nurbs<DVec2>, display: &CurveDisplay) -> Vec<&'static str> {
    [
        (display.points && crowd.dots(), "small dots"),
        (display.knots && crowd.dots(), "no knots"),
        (display.labels != PointLabels::None && !crowd.labels(), "no labels"),
        (display.comb && crowd.thins_comb(curve, display.comb_teeth), "fewer teeth of the comb"),
    ]
    .into_iter()
    .filter_map(|(holds, word)| holds.then_some(word))
    .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::SplineSpace;

    /// Points along a straight line, one to a unit.
    fn line(count: u32) -> Nurbs<DVec2> {
        let space = SplineSpace::new(3, (0..count + 4).map(f64::from).collect()).unwrap();
        Nurbs::polynomial(space, (0..count).map(|k| DVec2::X * f64::from(k)).collect()).unwrap()
    }

    fn view(center: f64, width: f64) -> Viewport {
        Viewport { center: DVec2::X * center, scale: 1000.0 / width, size: DVec2::new(1000.0, 500.0) }
    }

    #[test]
    fn what_is_near_is_drawn_and_what_is_crowded_is_not() {
        let curve = line(10_000);
        let far = Crowd::of(&curve, &view(5000.0, 10_000.0));
        assert!(far.dots() && !far.labels() && far.points == 10_000, "{far:?}");
        let near = Crowd::of(&curve, &view(5000.0, 100.0));
        assert!(!near.dots() && near.labels() && near.points == 121, "{near:?}");
        assert!(near.sees_near(&curve, 5003.0) && !near.sees_near(&curve, 6000.0), "knots in view");
    }

    #[test]
    fn the_comb_has_a_bounded_number_of_teeth_and_all_of_them_near_by() {
        let curve = line(10_000);
        let far = Crowd::of(&curve, &view(5000.0, 10_000.0));
        let (intervals, teeth) = far.comb_intervals(&curve, 8);
        assert!(intervals.len() * teeth <= MANY_TEETH + 1, "{} of {teeth}", intervals.len());
        assert!(intervals.windows(2).all(|pair| pair[0].1 == pair[1].0), "without gaps");
        let near = Crowd::of(&curve, &view(5000.0, 100.0));
        let (intervals, teeth) = near.comb_intervals(&curve, 8);
        assert!(teeth == 8 && (121..130).contains(&intervals.len()), "{} of {teeth}", intervals.len());
    }
}
