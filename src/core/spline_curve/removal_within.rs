//! As few knots as a tolerance allows.
//!
//! Every removal moves the curve over the supports of the affected coefficients by at most its `δ`. A bound is kept for every knot
//! interval; the cheapest knots go first, as long as no bound exceeds the tolerance. In one pass over the knots those are removed
//! that do not see each other, and passes follow until none removes anything: the time is linear in the number of knots, up to
//! sorting and the few passes. A closed spline is worked on as an open stretch whose seam moves from pass to pass.
//!
//! T. Lyche, K. Mørken, *Knot removal for parametric B-spline curves and surfaces*, 1987. Course: beyond, section B.2.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::progress::{Unwatched, Watcher};
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::knot_removal::{Step, removal_step};
use crate::core::spline_curve::{Deviation, Nurbs, deviation};

/// A spline with fewer knots.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotReduction<P> {
    /// The spline that is left.
    pub spline: Spline<P>,
    /// How many knots are gone.
    pub removed: usize,
    /// For every nonempty knot interval of the new spline: both splines differ there by at most this much, up to rounding.
    pub bounds: Vec<f64>,
}

/// A curve with fewer knots.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsKnotReduction<P: Projective> {
    /// The curve that is left.
    pub curve: Nurbs<P>,
    /// How many knots are gone.
    pub removed: usize,
    /// Its certified deviation from the curve before.
    pub deviation: Deviation,
}

impl<P: Point> Spline<P> {
    /// Removes inner knots, of a closed spline any, while the spline moves by at most `tolerance` at every parameter.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance` for a negative one; with 0 only knots go whose `δ` is exactly 0.
    pub fn remove_knots(&self, tolerance: f64) -> Result<KnotReduction<P>, SplineError> {
        self.remove_knots_watched(tolerance, &Unwatched)
    }

    /// As [`Self::remove_knots`]; after every pass `watcher` hears a part done that grows, since nobody knows how many passes follow.
    ///
    /// # Errors
    ///
    /// As there; `Stopped`.
    pub fn remove_knots_watched(
        &self,
        tolerance: f64,
        watcher: &impl Watcher,
    ) -> Result<KnotReduction<P>, SplineError> {
        self.remove_knots_where(tolerance, |_| true, watcher)
    }

    /// Only such removals as leave coefficients that are `allowed`.
    fn remove_knots_where(
        &self,
        tolerance: f64,
        allowed: impl Fn(&P) -> bool,
        watcher: &impl Watcher,
    ) -> Result<KnotReduction<P>, SplineError> {
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        let before = self.space().dimension();
        let intervals = self.space().breaks().len() - 1;
        let (spline, bounds) = if self.space().is_periodic() {
            self.remove_closed(tolerance, &allowed, watcher)?
        } else {
            let mut open = Stretch::new(self, vec![0.0; intervals]);
            let mut passes = 0;
            while open.pass(tolerance, 0..self.coefficients().len(), &allowed) > 0 {
                passes += 1;
                watcher.check(part_done(passes))?;
            }
            (Self::new(SplineSpace::new(self.degree(), open.knots)?, open.coefficients)?, open.bounds)
        };
        Ok(KnotReduction { removed: before - spline.space().dimension(), spline, bounds })
    }

    fn remove_closed(
        &self,
        tolerance: f64,
        allowed: &impl Fn(&P) -> bool,
        watcher: &impl Watcher,
    ) -> Result<(Self, Vec<f64>), SplineError> {
        let n = self.degree();
        let mut spline = self.clone();
        let mut bounds = vec![0.0; spline.space().breaks().len() - 1];
        let (left, _) = self.space().parameter_interval();
        let (mut idle, mut passes) = (0, 0);
        // A period without room for an open stretch keeps its knots, except one by one below.
        while idle < 2 && spline.space().dimension() > 4 * n + 4 {
            passes += 1;
            watcher.check(part_done(passes))?;
            let mut open = Stretch::new(&spline.unroll()?, bounds);
            // The first and the last n coefficients stand there twice.
            let inner = n + 1..open.coefficients.len() - n - 1;
            let removed = open.pass(tolerance, inner, allowed);
            let unrolled = Self::new(SplineSpace::new(n, open.knots)?, open.coefficients)?;
            let Some(closed) = unrolled.closed_if_periodic(0.0) else {
                return Err(SplineError::NoSolution {
                    reason: "the ends of the period came apart".to_owned(),
                });
            };
            (spline, bounds) = rotated(&self.with_own_knots(&closed)?, open.bounds)?;
            idle = if removed > 0 { 0 } else { idle + 1 };
        }
        while spline.space().dimension() <= 4 * n + 4 {
            let breaks = spline.space().breaks();
            let mut best: Option<(f64, f64, Self)> = None;
            for &at in &breaks[..breaks.len() - 1] {
                let Ok(removal) = spline.remove_knot(at) else { continue };
                if removal.spline.coefficients().iter().all(allowed)
                    && best.as_ref().is_none_or(|(deviation, ..)| removal.deviation < *deviation)
                {
                    best = Some((removal.deviation, at, removal.spline));
                }
            }
            // So short a period is affected everywhere.
            let worst = bounds.iter().copied().fold(0.0, f64::max);
            let Some((deviation, _, next)) = best.filter(|(deviation, ..)| worst + deviation <= tolerance)
            else {
                break;
            };
            bounds = vec![worst + deviation; next.space().breaks().len() - 1];
            spline = next;
        }
        let (spline, bounds) = back_to_start(&spline, bounds, left)?;
        Ok((self.with_own_knots(&spline)?, bounds))
    }

    /// `reduced`, all of whose knots are knots of this closed spline up to the rounding of whole periods, with exactly these and with its period.
    fn with_own_knots(&self, reduced: &Self) -> Result<Self, SplineError> {
        let Some(period) = self.space().period() else { return Ok(reduced.clone()) };
        let count = self.space().dimension() as isize;
        let (left, _) = self.space().parameter_interval();
        // One period and a knot on either side.
        let own: Vec<f64> = (-1..=count).filter_map(|k| self.space().knot(k)).collect();
        let nearest = |knot: f64| {
            let turns = ((knot - left) / period).floor();
            let local = knot - turns * period;
            let above = own.partition_point(|&own| own < local).clamp(1, own.len() - 1);
            let index = if local - own[above - 1] < own[above] - local { above - 1 } else { above };
            self.space().knot(index as isize - 1 + turns as isize * count)
        };
        let knots = (0..reduced.space().dimension() as isize).filter_map(|k| reduced.space().knot(k));
        let space = SplineSpace::periodic(self.degree(), period, knots.filter_map(nearest).collect())?;
        Self::new(space, reduced.coefficients().to_vec())
    }
}

/// `1 − 2/(2 + passes)`, below 1.
fn part_done(passes: u32) -> f64 {
    1.0 - 2.0 / (2.0 + f64::from(passes))
}

/// The same spline with the period starting about half a period later, and its bounds.
fn rotated<P: Point>(spline: &Spline<P>, mut bounds: Vec<f64>) -> Result<(Spline<P>, Vec<f64>), SplineError> {
    let distinct = spline.space().distinct_knots();
    let half = distinct.len() / 2;
    bounds.rotate_left(half);
    Ok((spline.with_start(distinct[half].first as isize)?, bounds))
}

/// The period that starts with the first knot at or behind `left`.
fn back_to_start<P: Point>(
    spline: &Spline<P>,
    mut bounds: Vec<f64>,
    left: f64,
) -> Result<(Spline<P>, Vec<f64>), SplineError> {
    let (space, Some(period)) = (spline.space(), spline.space().period()) else {
        return Ok((spline.clone(), bounds));
    };
    let turns = ((space.knots()[0] - left) / period).floor();
    let count = space.dimension() as isize;
    // Whole turns only shift the numbering; knots before `left` then go to the end of the period.
    let start = -(turns as isize) * count;
    let before = (0..count).take_while(|&k| space.knot(start + k).is_some_and(|knot| knot < left)).count();
    let skipped = space.distinct_knots().iter().take_while(|knot| knot.first < before).count();
    let turned = spline.with_start(start + before as isize)?;
    let shift = skipped % bounds.len().max(1);
    bounds.rotate_left(shift);
    Ok((turned, bounds))
}

/// Open knots, their coefficients, and the bound of every nonempty interval of D.
struct Stretch<P> {
    n: usize,
    knots: Vec<f64>,
    coefficients: Vec<P>,
    bounds: Vec<f64>,
}

/// An inner knot, the last copy of its value, that may go.
struct Candidate<P> {
    last: usize,
    multiplicity: usize,
    /// Number of its break, the left end of D being 0.
    place: usize,
    step: Step<P>,
}

impl<P: Point> Stretch<P> {
    fn new(spline: &Spline<P>, bounds: Vec<f64>) -> Self {
        let (knots, coefficients) = (spline.space().knots().to_vec(), spline.coefficients().to_vec());
        Self { n: spline.degree(), knots, coefficients, bounds }
    }

    /// Removes knots that do not see each other, change only coefficients in `range` and leave `allowed` ones; returns how many.
    fn pass(
        &mut self,
        tolerance: f64,
        range: std::ops::Range<usize>,
        allowed: &impl Fn(&P) -> bool,
    ) -> usize {
        let (n, m) = (self.n, self.coefficients.len());
        // breaks[i] is the index of the last copy of break i; the last break is the first copy of the right end.
        let breaks: Vec<usize> = (n..=m).filter(|&k| k == m || self.knots[k] < self.knots[k + 1]).collect();
        let mut candidates: Vec<Candidate<P>> = Vec::new();
        for place in 1..breaks.len() - 1 {
            let last = breaks[place];
            let multiplicity = last - breaks[place - 1];
            let step = removal_step(n, &self.knots, &self.coefficients, last);
            let affected = step.first..step.first + step.null_vector.len();
            let is_within = range.start <= affected.start && affected.end <= range.end;
            if step.deviation <= tolerance && is_within && step.inner.iter().all(allowed) {
                candidates.push(Candidate { last, multiplicity, place, step });
            }
        }
        candidates.sort_by(|a, b| a.step.deviation.total_cmp(&b.step.deviation));
        let mut taken = vec![false; self.knots.len()];
        let mut chosen: Vec<Candidate<P>> = Vec::new();
        for candidate in candidates {
            let last = candidate.last;
            let reach = last.saturating_sub(2 * n + 2)..(last + 2 * n + 3).min(taken.len());
            if taken[reach].contains(&true) {
                continue;
            }
            // The supports of the affected coefficients, as intervals between breaks.
            let low = self.knots[candidate.step.first];
            let high = self.knots
                [(candidate.step.first + candidate.step.null_vector.len() + n).min(self.knots.len() - 1)];
            let first = breaks.partition_point(|&k| self.knots[k] <= low).max(1) - 1;
            let after = breaks.partition_point(|&k| self.knots[k] < high).min(self.bounds.len());
            let touched = &mut self.bounds[first..after];
            if touched.iter().any(|bound| bound + candidate.step.deviation > tolerance) {
                continue;
            }
            touched.iter_mut().for_each(|bound| *bound += candidate.step.deviation);
            taken[last] = true;
            chosen.push(candidate);
        }
        chosen.sort_by_key(|candidate| candidate.last);
        self.apply(&chosen);
        chosen.len()
    }

    fn apply(&mut self, chosen: &[Candidate<P>]) {
        let mut knots = Vec::with_capacity(self.knots.len());
        let mut coefficients = Vec::with_capacity(self.coefficients.len());
        let mut bounds = Vec::with_capacity(self.bounds.len());
        let (mut knot, mut coefficient, mut interval) = (0, 0, 0);
        for candidate in chosen {
            let step = &candidate.step;
            knots.extend_from_slice(&self.knots[knot..candidate.last]);
            knot = candidate.last + 1;
            coefficients.extend_from_slice(&self.coefficients[coefficient..step.first]);
            coefficients.extend_from_slice(&step.inner);
            coefficient = step.first + step.null_vector.len();
            if candidate.multiplicity == 1 {
                // The intervals on both sides become one.
                bounds.extend_from_slice(&self.bounds[interval..candidate.place]);
                interval = candidate.place;
                if let Some(last) = bounds.pop() {
                    self.bounds[interval] = self.bounds[interval].max(last);
                }
            }
        }
        knots.extend_from_slice(&self.knots[knot..]);
        coefficients.extend_from_slice(&self.coefficients[coefficient..]);
        bounds.extend_from_slice(&self.bounds[interval..]);
        (self.knots, self.coefficients, self.bounds) = (knots, coefficients, bounds);
    }
}

impl<P: Projective> Nurbs<P> {
    /// Removes knots while the certified deviation from this curve is at most `tolerance`.
    ///
    /// A rational curve is worked on in homogeneous coordinates with the tolerance `ε = tol·min w/(1 + max|r| + tol)`, which keeps
    /// `|P − Q|/v + |r||v − w|/v` below `tol`. A knot stays whose removal would leave a weight that is not positive.
    ///
    /// # Errors
    ///
    /// As [`Spline::remove_knots`].
    pub fn remove_knots(&self, tolerance: f64) -> Result<NurbsKnotReduction<P>, SplineError> {
        self.remove_knots_watched(tolerance, &Unwatched)
    }

    /// As [`Spline::remove_knots_watched`].
    ///
    /// # Errors
    ///
    /// As there.
    pub fn remove_knots_watched(
        &self,
        tolerance: f64,
        watcher: &impl Watcher,
    ) -> Result<NurbsKnotReduction<P>, SplineError> {
        let least = self.weights().iter().copied().fold(f64::INFINITY, f64::min);
        let largest = self.points().iter().fold(0.0, |largest: f64, point| largest.max(point.norm()));
        let homogeneous = tolerance * least / (1.0 + largest + tolerance);
        let curve = self.mapped(
            |spline| Ok(spline.remove_knots_watched(tolerance, watcher)?.spline),
            |spline| {
                let is_weighted = |point: &P::Homogeneous| P::project(*point).1 > 0.0;
                Ok(spline.remove_knots_where(homogeneous, is_weighted, watcher)?.spline)
            },
        )?;
        let deviation = deviation(self, &curve)?;
        Ok(NurbsKnotReduction { removed: self.points().len() - curve.points().len(), curve, deviation })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::{any_curve, any_spline, distance};
    use glam::DVec2;
    use proptest::prelude::*;

    #[test]
    fn a_watcher_stops_the_removal() {
        let start =
            Spline::new(SplineSpace::new(1, vec![0.0, 1.0, 2.0, 3.0]).unwrap(), vec![0.0, 1.0]).unwrap();
        let refined = start.insert_knots(&[1.2, 1.4, 1.5, 1.6, 1.8]).unwrap();
        let stopped = refined.remove_knots_watched(1e-9, &|_: f64| false);
        assert_eq!(stopped.unwrap_err().name(), "Stopped", "after the first pass");
        let reduced = refined.remove_knots_watched(1e-9, &|part: f64| part < 1.0).unwrap();
        assert_eq!(reduced.removed, 5, "to the end");
    }

    fn curve(spline: &Spline<DVec2>) -> Nurbs<DVec2> {
        Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn bounds_hold_interval_by_interval(spline in any_spline(1..=6), tolerance in 0.0..6.0_f64) {
            let reduction = spline.remove_knots(tolerance).unwrap();
            let breaks = reduction.spline.space().breaks();
            prop_assert_eq!(breaks.len() - 1, reduction.bounds.len(), "one bound for each interval");
            for (ends, &bound) in breaks.windows(2).zip(&reduction.bounds) {
                prop_assert!(bound <= tolerance, "{bound} > {tolerance}");
                for i in 0..=12 {
                    let t = ends[0].mix(ends[1], f64::from(i) / 12.0);
                    let off = reduction.spline.evaluate(t).unwrap().distance(spline.evaluate(t).unwrap());
                    prop_assert!(off <= bound + 1e-9, "{t}: {off} > {bound}");
                }
            }
        }

        #[test]
        fn inserted_knots_go_again(curve in any_curve(1..=5), places in prop::collection::btree_set(0..40_u8, 1..30)) {
            // Apart from each other and from the integers: a knot next to another one comes off with its rounding magnified.
            let (left, right) = curve.space().parameter_interval();
            let new: Vec<f64> =
                places.iter().map(|&place| left.mix(right, (f64::from(place) + 0.37) / 40.0)).collect();
            let refined = curve.insert_knots(&new).unwrap();
            let reduction = refined.remove_knots(1e-9).unwrap();
            prop_assert!(reduction.removed >= new.len(), "{} of {}", reduction.removed, new.len());
            prop_assert!(reduction.deviation.upper < 1e-8, "{:?}", reduction.deviation);
            prop_assert!(distance(&curve, &reduction.curve) < 1e-8, "off");
            prop_assert_eq!(reduction.curve.space().period(), curve.space().period(), "the period");
            let own = refined.space().knots();
            let (left, right) = curve.space().parameter_interval();
            let inside = reduction.curve.space().knots().iter().filter(|&&knot| left <= knot && knot < right);
            prop_assert!(inside.into_iter().all(|knot| own.contains(knot)), "knots to the last digit");
        }

        #[test]
        fn a_rational_curve_stays_within_the_tolerance(curve in any_curve(1..=4), tolerance in 0.01..4.0_f64) {
            let reduction = curve.remove_knots(tolerance).unwrap();
            prop_assert!(reduction.deviation.lower <= tolerance, "{:?}", reduction.deviation);
        }
    }

    #[test]
    fn a_closed_polygon_is_left_of_a_refined_one() {
        let space = SplineSpace::periodic(1, 2.0, vec![0.0, 1.0]).unwrap();
        let points =
            vec![DVec2::new(-4.7460382006814275, 0.0), DVec2::new(-6.4632088597429265, -3.369807868920291)];
        let curve = Nurbs::new(space, points, vec![1.1546220298224845, 3.07478389129614]).unwrap();
        let new: Vec<f64> = [1, 2, 5, 12, 13, 15, 17, 18, 21, 23, 29, 31, 34, 36]
            .map(|place| 2.0 * (f64::from(place) + 0.37) / 40.0)
            .to_vec();
        let reduction = curve.insert_knots(&new).unwrap().remove_knots(1e-9).unwrap();
        assert_eq!(reduction.removed, new.len(), "{:?}", reduction.curve.space());
    }

    #[test]
    fn an_elevated_polynomial_becomes_one_piece() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 3.0, 3.0, 4.0]).unwrap();
        let parabola = Spline::new(space, vec![DVec2::ZERO, DVec2::Y, DVec2::X]).unwrap();
        let elevated = parabola.insert_knots(&[1.0, 1.5, 2.0]).unwrap().elevate_degree_by(3).unwrap();
        let reduction = elevated.remove_knots(1e-10).unwrap();
        assert_eq!(reduction.spline.space().breaks(), [0.0, 3.0], "one interval");
        assert_eq!(reduction.removed, 12, "three knots, four-fold");
        assert!(distance(&curve(&parabola), &curve(&reduction.spline)) < 1e-10, "the same curve");
        assert_eq!(parabola.remove_knots(-1.0).unwrap_err().name(), "InvalidTolerance", "negative");
    }

    #[test]
    fn long_curves_do_not_take_quadratic_time() {
        for closed in [false, true] {
            let count = 60_000;
            let points = (0..count)
                .map(|k| DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(count)))
                .collect();
            let knots: Vec<f64> = (0..count + if closed { 0 } else { 4 }).map(f64::from).collect();
            let space = if closed {
                SplineSpace::periodic(3, f64::from(count), knots)
            } else {
                SplineSpace::new(3, knots)
            };
            let spline = Spline::new(space.unwrap(), points).unwrap();
            let reduction = spline.remove_knots(1e-6).unwrap();
            // Arcs with an error of 1e-6 need about a hundred knots.
            let left = reduction.spline.coefficients().len();
            assert!(left < 2000, "closed: {closed}: {left} are left");
        }
    }
}
