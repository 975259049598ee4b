//! The nearest spline of a given space in the mean-square sense.
//!
//! Least squares at `max(n, n′) + 1` Gauss points of every common knot interval, which integrates the squared distance exactly, solved by
//! orthogonal transformations of the rows, since the normal equations would square the condition. End points that are coefficients of the new
//! space are kept. The unknowns of a closed spline are taken in the order `0, M − 1, 1, M − 2, …`, which turns its cyclic matrix into one with
//! a band. A spline of the space comes back. Course: sections 5.6 and 6.1, and beyond, section B.1.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::linear_system::{BandError, BandLeastSquares};
use crate::core::point::Point;
use crate::core::quadrature::gauss_legendre;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// Relative difference up to which two parameter intervals count as equal.
const SAME_INTERVAL: f64 = 1e-12;

impl<P: Projective> Nurbs<P> {
    /// The curve of `space` nearest to this one in the mean-square sense, over the same parameter interval; a rational curve is projected in
    /// homogeneous coordinates. Where the new space has an `n`-fold end, the end point is kept.
    ///
    /// # Errors
    ///
    /// `OutsideInterval` with the first end of the interval of `space` that is not that of an open curve, up to 1e-12 of its length;
    /// `NoSolution` if only one of both is closed or the periods differ; `WeightNotPositive` if no positive weights come out.
    pub fn nearest_in(&self, space: &SplineSpace) -> Result<Self, SplineError> {
        check_interval(self.space(), space)?;
        let (n, m) = (space.degree(), space.dimension());
        let (open, knots) = (!space.is_periodic(), space.knots());
        // A periodic space has no ends; its one period may be shorter than these indices.
        let fixed = [open && knots[1] >= knots[n], open && knots[m] >= knots[m + n - 1]];
        self.mapped(
            |spline| nearest_spline(spline, space.clone(), fixed),
            |spline| nearest_spline(spline, space.clone(), fixed),
        )
    }
}

fn check_interval(old: &SplineSpace, new: &SplineSpace) -> Result<(), SplineError> {
    let (left, right) = old.parameter_interval();
    let tolerance = SAME_INTERVAL * (right - left);
    match (old.period(), new.period()) {
        (None, None) => {
            let ends = new.parameter_interval();
            for (value, mine) in [(ends.0, left), (ends.1, right)] {
                if (value - mine).abs() > tolerance {
                    return Err(SplineError::OutsideInterval { value, left, right });
                }
            }
            Ok(())
        }
        (Some(mine), Some(theirs)) if (mine - theirs).abs() <= tolerance => Ok(()),
        (Some(mine), Some(theirs)) => {
            Err(SplineError::NoSolution { reason: format!("the period is {mine}, not {theirs}") })
        }
        (Some(_), None) => {
            Err(SplineError::NoSolution { reason: "the curve is closed, the knots are open".to_owned() })
        }
        (None, Some(_)) => {
            Err(SplineError::NoSolution { reason: "the curve is open, the knots are periodic".to_owned() })
        }
    }
}

/// The mean-square nearest spline of `space`, which has the interval or the period of `spline`; the first and the last coefficient are the end
/// points where `fixed` says so.
pub(super) fn nearest_spline<P: Point>(
    spline: &Spline<P>,
    space: SplineSpace,
    fixed: [bool; 2],
) -> Result<Spline<P>, SplineError> {
    let unknowns = Unknowns::new(&space, fixed);
    let (left, right) = spline.space().parameter_interval();
    let (start, stop) = (spline.evaluate(left)?, spline.evaluate(right)?);
    let fixed = |k: usize| if k == 0 { start } else { stop };
    let width = unknowns.width();
    let mut system = BandLeastSquares::new(unknowns.count(), width);
    let nodes = spline.degree().max(space.degree()) + 1;
    let rule =
        gauss_legendre(nodes).map_err(|error| SplineError::NoSolution { reason: error.to_string() })?;
    let mut intervals = intervals(spline.space(), &space, &unknowns)?;
    intervals.sort_by_key(|interval| interval.first);
    let (mut values, mut row) = (vec![0.0; space.degree() + 1], vec![0.0; width]);
    for interval in intervals {
        let (a, b) = interval.ends;
        for (&node, &weight) in rule.nodes().iter().zip(rule.weights()) {
            let (x, root) = (a.mix(b, node), (weight * (b - a)).sqrt());
            let first = space.write_active_basis(x, &mut values)?;
            let mut value =
                spline.evaluate(if spline.space().is_periodic() { x } else { x.clamp(left, right) })?;
            row.fill(0.0);
            for (j, &basis) in values.iter().enumerate() {
                let k = space.coefficient_index(first + j);
                match unknowns.place(k) {
                    Some(place) => row[place - interval.first] += basis * root,
                    None => value = value - fixed(k) * basis,
                }
            }
            system.add(interval.first, &mut row, value * root).map_err(no_solution)?;
        }
    }
    let solution = system.solve().map_err(no_solution)?;
    let coefficient = |k: usize| unknowns.place(k).map_or_else(|| fixed(k), |place| solution[place]);
    let coefficients = (0..space.dimension()).map(coefficient).collect();
    Spline::new(space, coefficients)
}

/// Which coefficients are unknown, and where they stand in the system.
enum Unknowns {
    /// All but the first and the last `fixed`.
    Open { count: usize, fixed: [usize; 2], degree: usize },
    /// All, folded.
    Closed { count: usize, degree: usize },
}

impl Unknowns {
    fn new(space: &SplineSpace, fixed: [bool; 2]) -> Self {
        let (count, degree) = (space.dimension(), space.degree());
        if space.is_periodic() {
            return Self::Closed { count, degree };
        }
        Self::Open { count, fixed: fixed.map(usize::from), degree }
    }

    fn count(&self) -> usize {
        match self {
            Self::Open { count, fixed, .. } => count - fixed[0] - fixed[1],
            Self::Closed { count, .. } => *count,
        }
    }

    /// Consecutive unknowns that an equation can hold.
    fn width(&self) -> usize {
        match self {
            Self::Open { degree, .. } => (degree + 1).min(self.count()),
            Self::Closed { count, degree } => (2 * degree + 2).min(*count),
        }
    }

    /// The place of coefficient `k`; `None` if it is fixed.
    fn place(&self, k: usize) -> Option<usize> {
        match self {
            Self::Open { count, fixed, .. } => (k >= fixed[0] && k + fixed[1] < *count).then(|| k - fixed[0]),
            Self::Closed { count, .. } => {
                Some(if k < count.div_ceil(2) { 2 * k } else { 2 * (count - 1 - k) + 1 })
            }
        }
    }
}

/// An interval between knots of both spaces and the first unknown of its equations.
struct Interval {
    ends: (f64, f64),
    first: usize,
}

fn intervals(
    old: &SplineSpace,
    space: &SplineSpace,
    unknowns: &Unknowns,
) -> Result<Vec<Interval>, SplineError> {
    let mut breaks = space.breaks();
    let (left, right) = space.parameter_interval();
    for at in old.breaks() {
        let at = if space.is_periodic() { space.reduce(at)? } else { at };
        if left < at && at < right {
            breaks.push(at);
        }
    }
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let most = unknowns.count() - unknowns.width();
    let interval = |ends: &[f64]| {
        let span = space.span(ends[0])?;
        let active =
            (span - space.degree()..=span).filter_map(|k| unknowns.place(space.coefficient_index(k)));
        Ok(Interval { ends: (ends[0], ends[1]), first: active.min().unwrap_or(0).min(most) })
    };
    breaks.windows(2).map(interval).collect()
}

fn no_solution(error: BandError) -> SplineError {
    SplineError::NoSolution { reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::deviation;
    use crate::core::spline_curve::samples::any_curve;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn a_larger_space_gives_the_curve_back(curve in any_curve(1..=5), shares in prop::collection::vec(0.01..0.99_f64, 0..6)) {
            let (left, right) = curve.space().parameter_interval();
            let new: Vec<f64> = shares.iter().map(|&share| left.mix(right, share)).collect();
            let refined = curve.insert_knots(&new).unwrap();
            let again = curve.nearest_in(refined.space()).unwrap();
            let found = deviation(&refined, &again).unwrap();
            prop_assert!(found.upper < 1e-7, "{found:?}");
        }

        #[test]
        fn the_error_is_orthogonal_to_the_space(curve in any_curve(1..=4), push in 0.05..0.45_f64) {
            // One knot in the middle of D moves; the polynomial curve is projected.
            let space = curve.space();
            let (n, knots) = (space.degree(), space.knots());
            if space.is_periodic() {
                return Ok(());
            }
            let (left, _) = space.parameter_interval();
            let Some(k) = (n + 1..space.dimension()).find(|&k| knots[k] > left && knots[k] < knots[k + 1]) else {
                return Ok(());
            };
            let mut moved = knots.to_vec();
            moved[k] = knots[k].mix(knots[k + 1], push);
            let Ok(moved) = SplineSpace::new(n, moved) else { return Ok(()) };
            let old = Nurbs::polynomial(space.clone(), curve.points().to_vec()).unwrap();
            let new = old.nearest_in(&moved).unwrap();
            let square = |other: &Nurbs<DVec2>| {
                let mut breaks = [old.space().breaks(), moved.breaks()].concat();
                breaks.sort_by(f64::total_cmp);
                let rule = gauss_legendre(n + 1).unwrap();
                breaks.windows(2).map(|ends| rule.integrate(ends[0], ends[1], |t| {
                    old.evaluate(t).unwrap().distance_squared(other.evaluate(t).unwrap())
                })).sum::<f64>()
            };
            let best = square(&new);
            // Away from the best one, the squared distance grows; the kept ends do not count.
            for k in 1..new.points().len() - 1 {
                for step in [DVec2::X, DVec2::NEG_Y] {
                    let other = new.with_point(k, new.points()[k] + step * 1e-3).unwrap();
                    prop_assert!(square(&other) > best - 1e-12, "point {k}: {} and {best}", square(&other));
                }
            }
        }
    }

    #[test]
    fn the_ends_of_an_end_interpolating_curve_stay() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 4.0]).unwrap();
        let points: Vec<DVec2> = (0..5).map(|k| DVec2::new(f64::from(k), f64::from(k * k % 5))).collect();
        let curve = Nurbs::polynomial(space, points.clone()).unwrap();
        let moved = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.4, 1.5, 3.0, 3.0, 4.0]).unwrap();
        let new = curve.nearest_in(&moved).unwrap();
        assert_eq!((new.points()[0], new.points()[4]), (points[0], points[4]), "both ends");
        assert!(deviation(&curve, &new).unwrap().upper < 1.0, "near");
    }

    #[test]
    fn a_closed_curve_may_start_elsewhere() {
        let space = SplineSpace::periodic(3, 5.0, vec![0.0, 1.0, 2.0, 3.0, 4.0]).unwrap();
        let curve =
            Nurbs::polynomial(space, (0..5).map(|k| DVec2::from_angle(f64::from(k))).collect()).unwrap();
        let turned = SplineSpace::periodic(3, 5.0, vec![-1.0, 0.0, 1.0, 2.0, 3.0]).unwrap();
        let found = deviation(&curve, &curve.nearest_in(&turned).unwrap()).unwrap();
        assert!(found.upper < 1e-12, "{found:?}");
    }

    #[test]
    fn what_is_over_another_interval_is_refused() {
        let space = SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 2.0]).unwrap();
        let line = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X]).unwrap();
        let longer = SplineSpace::new(1, vec![-1.0, 0.0, 1.5, 2.0]).unwrap();
        assert_eq!(line.nearest_in(&longer).unwrap_err().name(), "OutsideInterval", "[0, 1.5]");
        let closed = SplineSpace::periodic(1, 1.0, vec![0.0, 0.5]).unwrap();
        assert_eq!(line.nearest_in(&closed).unwrap_err().name(), "NoSolution", "closed");
    }
}
