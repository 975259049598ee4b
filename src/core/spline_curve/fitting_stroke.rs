//! A spline curve along a drawn stroke, with as few control points as a tolerance allows.
//!
//! The stroke is cut at its corners. On each part least squares fits and corrections of the parameters alternate, and knots come in where the error is large, at its
//! weighted median, until every point is near enough; knots that the tolerance can spare are taken out again. Beyond the course (B.16, B.2).

use glam::DVec2;

use crate::core::approximation::{averaged_knots, check_determined, interpolate};
use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::spline_curve::fitting::{
    FitEnds, FittingError, correct_parameters, fit_least_squares, parameters,
};
use crate::core::spline_curve::{ClosestPointTree, Nurbs};

/// How a stroke is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitOptions {
    /// The degree, at least 1.
    pub degree: usize,
    /// Largest distance of the points from the curve.
    pub tolerance: f64,
    /// Turns sharper than this angle (radians), seen at the distance of four tolerances, are corners: `n`-fold knots.
    pub corner_angle: f64,
    /// Whether the stroke is closed; its last point need not repeat the first.
    pub closed: bool,
    /// The largest number of control points.
    pub most_points: usize,
}

/// A fitted stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeFit {
    /// The curve over `[0, 1]`.
    pub curve: Nurbs<DVec2>,
    /// Largest distance of a point from the curve.
    pub max_error: f64,
    /// Root of the mean square of these distances.
    pub root_mean_square: f64,
    /// Largest distance found of a point of the curve from the polygon of the stroke.
    pub back_error: f64,
    /// How many knots sets were tried.
    pub iterations: usize,
    /// Where the corners are, as indices of the points that are left when equal neighbours are merged.
    pub corners: Vec<usize>,
}

/// Neighbours closer than this, relative to the size of the stroke, are one point.
const SAME: f64 = 1e-9;

/// Corrections of the parameters for one set of knots.
const CORRECTIONS: usize = 4;

/// Fits a stroke; see [`FitOptions`].
///
/// # Errors
///
/// `Empty`, `NonFinite`, `InvalidTolerance` unless the tolerance is positive, `DegreeZero`, `TooFewData` for fewer than two different points (three, if closed), `StepLimit` with the best
/// curve if `most_points` do not suffice.
pub fn fit_stroke(points: &[DVec2], options: &FitOptions) -> Result<StrokeFit, FittingError> {
    if !(options.tolerance > 0.0 && options.tolerance.is_finite()) {
        return Err(FittingError::InvalidTolerance { value: options.tolerance });
    }
    parameters(points, 1.0)?;
    let mut merged = merged(points);
    let size = size(&merged);
    if options.closed && merged.len() > 1 && merged[0].distance(merged[merged.len() - 1]) <= SAME * size {
        merged.pop();
    }
    let least = if options.closed { 3 } else { 2 };
    if merged.len() < least {
        return Err(FittingError::TooFewData { least, found: merged.len() });
    }
    let corners = corners(&merged, options);
    let (curve, reached, iterations) = if options.closed && corners.is_empty() {
        closed_curve(&merged, options)?
    } else {
        with_corners(&merged, &corners, options)?
    };
    let fit = measured(curve, &merged, options.closed, iterations, corners)?;
    if reached { Ok(fit) } else { Err(FittingError::StepLimit { best: Box::new(fit) }) }
}

fn size(points: &[DVec2]) -> f64 {
    points.iter().map(|point| point.distance(points[0])).fold(0.0, f64::max)
}

fn merged(points: &[DVec2]) -> Vec<DVec2> {
    let least = SAME * size(points);
    let mut merged = points[..1].to_vec();
    for &point in &points[1..] {
        if point.distance(merged[merged.len() - 1]) > least {
            merged.push(point);
        }
    }
    merged
}

/// The sharpest points of every turn that is sharp at the distance of four tolerances.
fn corners(points: &[DVec2], options: &FitOptions) -> Vec<usize> {
    let (count, reach) = (points.len(), 4.0 * options.tolerance);
    let arm = |k: usize, step: usize| {
        (1..count.min(200)).find_map(|i| {
            let index = k + i * step;
            if !options.closed && (step == 1 && index >= count || step > 1 && i > k) {
                return None;
            }
            let way = points[index % count] - points[k];
            (way.length() >= reach).then_some(way)
        })
    };
    let turn = |k: usize| match (arm(k, count - 1), arm(k, 1)) {
        (Some(back), Some(ahead)) => (-back).angle_to(ahead).abs(),
        _ => 0.0,
    };
    let turns: Vec<f64> = (0..count).map(turn).collect();
    let mut sharp: Vec<usize> = (0..count).filter(|&k| turns[k] > options.corner_angle).collect();
    sharp.sort_by(|&a, &b| turns[b].total_cmp(&turns[a]));
    let mut chosen: Vec<usize> = Vec::new();
    for k in sharp {
        if chosen.iter().all(|&other| points[other].distance(points[k]) > 1.5 * reach) {
            chosen.push(k);
        }
    }
    chosen.sort_unstable();
    chosen
}

/// Parts from corner to corner, each with fixed ends; `n`-fold knots where they meet.
fn with_corners(
    points: &[DVec2],
    corners: &[usize],
    options: &FitOptions,
) -> Result<(Nurbs<DVec2>, bool, usize), FittingError> {
    let (n, count) = (options.degree, points.len());
    let ring: Vec<DVec2>;
    let (points, mut cuts) = if options.closed {
        // Around the circle from the first corner back to it.
        let start = corners[0];
        ring = (0..=count).map(|i| points[(start + i) % count]).collect();
        (&ring[..], corners.iter().map(|corner| corner - start).chain([count]).collect::<Vec<_>>())
    } else {
        (points, [0].into_iter().chain(corners.iter().copied()).chain([count - 1]).collect())
    };
    cuts.dedup();
    let t = parameters(points, 1.0)?;
    let share = (options.most_points / (cuts.len() - 1)).max(n + 1);
    let (mut breaks, mut coefficients) = (Vec::new(), vec![points[0]]);
    let (mut reached, mut iterations) = (true, 0);
    for cut in cuts.windows(2) {
        let (from, to) = (cut[0], cut[1]);
        let part = Part::fit(&points[from..=to], &t[from..=to], None, share, options)?;
        reached &= part.reached;
        iterations += part.iterations;
        let spline = part.spline;
        let inner = &spline.space().knots()[n..=spline.space().dimension()];
        // The end of the part before stands once; the corner needs n copies.
        if !breaks.is_empty() {
            breaks.extend(std::iter::repeat_n(inner[0], n - 1));
        }
        breaks.extend_from_slice(&inner[usize::from(!breaks.is_empty())..]);
        coefficients.extend_from_slice(&spline.coefficients()[1..]);
    }
    let space = clamped(n, &breaks)?;
    if !options.closed {
        return Ok((Nurbs::polynomial(space, coefficients)?, reached, iterations));
    }
    // One period with an n-fold knot at its start: the coefficients without the first, which the last repeats.
    let mut knots = vec![breaks[0]; n];
    knots.extend_from_slice(&breaks[1..breaks.len() - 1]);
    let period = breaks[breaks.len() - 1] - breaks[0];
    let space = SplineSpace::periodic(n, period, knots)?;
    coefficients.remove(0);
    Ok((Nurbs::polynomial(space, coefficients)?, reached, iterations))
}

fn clamped(degree: usize, breaks: &[f64]) -> Result<SplineSpace, SplineError> {
    SplineSpace::from_breaks(degree, breaks, crate::core::bspline::EndKnots::Interpolating)
}

fn closed_curve(points: &[DVec2], options: &FitOptions) -> Result<(Nurbs<DVec2>, bool, usize), FittingError> {
    let mut ring = points.to_vec();
    ring.push(points[0]);
    let mut t = parameters(&ring, 1.0)?;
    t.pop();
    let part = Part::fit(points, &t, Some(1.0), options.most_points, options)?;
    let (space, coefficients) = part.spline.into_parts();
    Ok((Nurbs::polynomial(space, coefficients)?, part.reached, part.iterations))
}

/// A fitted part without corners.
struct Part {
    spline: Spline<DVec2>,
    reached: bool,
    iterations: usize,
}

impl Part {
    fn fit(
        points: &[DVec2],
        t: &[f64],
        period: Option<f64>,
        most: usize,
        options: &FitOptions,
    ) -> Result<Self, FittingError> {
        let n = options.degree;
        // A few points determine less than the full degree.
        let degree = if period.is_some() { n } else { n.min(points.len() - 1).max(1) };
        let (left, right) = period.map_or((t[0], t[t.len() - 1]), |period| (t[0], t[0] + period));
        let pieces = if period.is_some() { (n + 1).max(4) } else { 1 };
        if period.is_some() && points.len() < pieces {
            return Err(FittingError::TooFewData { least: pieces, found: points.len() });
        }
        let mut breaks: Vec<f64> =
            (0..=pieces).map(|i| left + (right - left) * i as f64 / pieces as f64).collect();
        let drawn = t;
        let mut t = t.to_vec();
        let ends = if period.is_some() { FitEnds::Free } else { FitEnds::Fixed };
        let mut best: Option<(Spline<DVec2>, f64)> = None;
        let mut iterations = 0;
        loop {
            iterations += 1;
            let space = match period {
                Some(period) => SplineSpace::periodic(degree, period, breaks[..breaks.len() - 1].to_vec())?,
                None => clamped(degree, &breaks)?,
            };
            let fitted = fit_least_squares(points, &t, space.clone(), ends);
            let (mut spline, mut residuals) = match (fitted, &best) {
                (Ok(fitted), _) => fitted,
                // Knots that the data do not determine, since corrected parameters crowd.
                (Err(_), Some(_)) => {
                    best = through_points(points, drawn, degree, period, most).or(best);
                    break;
                }
                (Err(error), None) => return Err(error),
            };
            for _ in 0..CORRECTIONS {
                let corrected = correct_parameters(&spline, points, &t)?;
                let Ok((next, left_over)) = fit_least_squares(points, &corrected, space.clone(), ends) else {
                    break;
                };
                if square_sum(&left_over) > 0.99 * square_sum(&residuals) {
                    break;
                }
                (spline, residuals, t) = (next, left_over, corrected);
            }
            let error = residuals.iter().map(|residual| residual.length()).fold(0.0, f64::max);
            if best.as_ref().is_none_or(|(_, least)| error < *least) {
                best = Some((spline, error));
            }
            if error <= options.tolerance || breaks.len() + degree > most {
                break;
            }
            if !insert_knots(&mut breaks, &t, &residuals, degree, period, options.tolerance) {
                best = through_points(points, drawn, degree, period, most).or(best);
                break;
            }
        }
        let Some((mut spline, error)) = best else {
            return Err(FittingError::TooFewData { least: 2, found: points.len() });
        };
        let reached = error <= options.tolerance;
        // The distance of both curves adds to the errors of the points.
        if reached && let Ok(reduced) = spline.remove_knots(options.tolerance - error) {
            spline = reduced.spline;
        }
        Ok(Self { spline: spline.elevate_degree_by(n - degree)?, reached, iterations })
    }
}

/// With as many coefficients as points there is no error left; `None` for closed strokes and more than `most` points.
fn through_points(
    points: &[DVec2],
    t: &[f64],
    degree: usize,
    period: Option<f64>,
    most: usize,
) -> Option<(Spline<DVec2>, f64)> {
    if period.is_some() || points.len() > most {
        return None;
    }
    let spline = interpolate(averaged_knots(degree, t).ok()?, t, points).ok()?;
    Some((spline, 0.0))
}

fn square_sum(residuals: &[DVec2]) -> f64 {
    residuals.iter().map(|residual| residual.length_squared()).sum()
}

/// A knot at the weighted median of the error in the interval with the largest sum of squares, and in those with at least half of it; only where enough
/// data stay on both sides. `false` if there is no such place.
fn insert_knots(
    breaks: &mut Vec<f64>,
    t: &[f64],
    residuals: &[DVec2],
    degree: usize,
    period: Option<f64>,
    tolerance: f64,
) -> bool {
    for need in [degree + 1, 1] {
        let mut places: Vec<(f64, f64)> = Vec::new();
        for ends in breaks.windows(2) {
            let first = t.partition_point(|&t| t < ends[0]);
            let after = t.partition_point(|&t| t < ends[1]);
            let inside = &residuals[first..after];
            if inside.len() < 2 * need || inside.iter().all(|residual| residual.length() <= tolerance) {
                continue;
            }
            let sum = square_sum(inside);
            let mut running = 0.0;
            let median = inside.iter().position(|residual| {
                running += residual.length_squared();
                2.0 * running >= sum
            });
            let split = first + median.unwrap_or(0).clamp(need - 1, inside.len() - need - 1);
            let knot = t[split].midpoint(t[split + 1]);
            if ends[0] < knot && knot < ends[1] {
                places.push((sum, knot));
            }
        }
        let largest = places.iter().map(|place| place.0).fold(0.0, f64::max);
        let mut new = breaks.clone();
        new.extend(places.into_iter().filter(|place| place.0 >= 0.5 * largest).map(|place| place.1));
        new.sort_by(f64::total_cmp);
        let determined =
            period.is_some() || clamped(degree, &new).is_ok_and(|space| check_determined(&space, t).is_ok());
        if new.len() > breaks.len() && determined {
            *breaks = new;
            return true;
        }
    }
    false
}

fn measured(
    curve: Nurbs<DVec2>,
    points: &[DVec2],
    closed: bool,
    iterations: usize,
    corners: Vec<usize>,
) -> Result<StrokeFit, FittingError> {
    let tree = ClosestPointTree::new(&curve)?;
    let (mut max_error, mut sum) = (0.0_f64, 0.0);
    for &point in points {
        let distance = tree.closest_point(point)?.distance;
        max_error = max_error.max(distance);
        sum += distance * distance;
    }
    let (left, right) = curve.space().parameter_interval();
    let steps = 4 * curve.points().len() + 32;
    let mut back_error = 0.0_f64;
    for step in 0..=steps {
        let at = curve.evaluate(left + (right - left) * step as f64 / steps as f64)?;
        let legs = points.windows(2).map(|leg| (leg[0], leg[1]));
        let seam = closed.then(|| (points[points.len() - 1], points[0]));
        let nearest =
            legs.chain(seam).map(|(a, b)| distance_from_leg(at, a, b)).fold(f64::INFINITY, f64::min);
        back_error = back_error.max(nearest);
    }
    let root_mean_square = (sum / points.len() as f64).sqrt();
    Ok(StrokeFit { curve, max_error, root_mean_square, back_error, iterations, corners })
}

fn distance_from_leg(place: DVec2, a: DVec2, b: DVec2) -> f64 {
    let leg = b - a;
    let share = ((place - a).dot(leg) / leg.length_squared()).clamp(0.0, 1.0);
    place.distance(a + leg * share)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::Side;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn options(tolerance: f64, closed: bool) -> FitOptions {
        FitOptions { degree: 3, tolerance, corner_angle: 1.2, closed, most_points: 200 }
    }

    fn wave(count: usize, bend: f64) -> Vec<DVec2> {
        (0..count)
            .map(|k| k as f64 / (count - 1) as f64)
            .map(|x| DVec2::new(8.0 * x, bend * (9.0 * x).sin() + (2.0 * x).cos()))
            .collect()
    }

    fn circle(count: usize) -> Vec<DVec2> {
        (0..count).map(|k| DVec2::from_angle(TAU * k as f64 / count as f64) * 3.0).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]

        #[test]
        fn every_point_is_within_the_tolerance(bend in 0.2..2.0_f64, digits in 1_i32..3, degree in 1_usize..5) {
            let tolerance = 0.5 * 0.1_f64.powi(digits);
            let points = wave(160, bend);
            let fit = fit_stroke(&points, &FitOptions { degree, ..options(tolerance, false) }).unwrap();
            prop_assert!(fit.max_error <= tolerance, "{} is above {tolerance}", fit.max_error);
            prop_assert!(fit.root_mean_square <= fit.max_error && fit.back_error < 3.0 * tolerance,
                "{} and {}", fit.root_mean_square, fit.back_error);
            prop_assert!(fit.curve.points().len() < 80, "{} points", fit.curve.points().len());
            prop_assert_eq!(fit.curve.evaluate(0.0).unwrap(), points[0], "start");
        }

        #[test]
        fn a_turned_and_scaled_stroke_gives_the_turned_and_scaled_curve(angle in 0.0..TAU, power in -3_i32..4) {
            let (turn, scale) = (DVec2::from_angle(angle), 2.0_f64.powi(power));
            let map = |point: DVec2| turn.rotate(point) * scale + DVec2::new(3.0, -2.0);
            let points = wave(60, 0.7);
            let plain = fit_stroke(&points, &options(0.03, false)).unwrap().curve;
            let mapped: Vec<DVec2> = points.iter().map(|&point| map(point)).collect();
            let other = fit_stroke(&mapped, &options(0.03 * scale, false)).unwrap().curve;
            prop_assert_eq!(plain.points().len(), other.points().len(), "as many control points");
            for (&a, &b) in plain.points().iter().zip(other.points()) {
                prop_assert!(map(a).distance(b) < 1e-6 * scale, "{a} and {b}");
            }
        }
    }

    #[test]
    fn a_closed_stroke_has_no_corner_at_its_seam() {
        let fit = fit_stroke(&circle(120), &options(0.01, true)).unwrap();
        assert!(fit.curve.space().is_periodic() && fit.corners.is_empty(), "{:?}", fit.corners);
        assert!(fit.max_error <= 0.01 && fit.back_error < 0.03, "{} and {}", fit.max_error, fit.back_error);
        assert!(fit.curve.points().len() <= 12, "{} points", fit.curve.points().len());
        let slopes = [Side::Left, Side::Right].map(|side| fit.curve.derivatives(0.0, 1, side).unwrap()[1]);
        assert!(slopes[0].distance(slopes[1]) < 1e-9, "{slopes:?}");
    }

    #[test]
    fn corners_become_corners() {
        let leg = |a: [f64; 2], b: [f64; 2]| {
            let (a, b) = (DVec2::from(a), DVec2::from(b));
            (0..25).map(move |k| a + (b - a) * (f64::from(k) / 25.0))
        };
        let square: Vec<DVec2> = leg([0.0, 0.0], [5.0, 0.0])
            .chain(leg([5.0, 0.0], [5.0, 5.0]))
            .chain(leg([5.0, 5.0], [0.0, 5.0]))
            .chain(leg([0.0, 5.0], [0.0, 0.0]))
            .collect();
        let closed = fit_stroke(&square, &options(0.05, true)).unwrap();
        assert_eq!(closed.corners, [0, 25, 50, 75], "the corners of a square");
        assert!(closed.curve.space().is_periodic(), "closed");
        assert_eq!(closed.curve.points().len(), 12, "four straight cubics");
        assert!(closed.max_error < 1e-9 && closed.back_error < 1e-9, "on the square");
        let open = fit_stroke(&square[..60], &options(0.05, false)).unwrap();
        assert_eq!((open.corners.len(), open.curve.points().len()), (2, 10), "three straight cubics");
    }

    #[test]
    fn a_few_points_are_met_and_bad_input_is_named() {
        for count in 2..8 {
            let points = wave(count, 1.0);
            let fit = fit_stroke(&points, &options(1e-3, false)).unwrap();
            assert!(fit.max_error <= 1e-3 && fit.curve.degree() == 3, "{count}: {}", fit.max_error);
        }
        let name = |points: &[DVec2], options: FitOptions| fit_stroke(points, &options).unwrap_err().name();
        assert_eq!(name(&[], options(0.1, false)), "Empty", "nothing");
        assert_eq!(name(&[DVec2::ONE; 3], options(0.1, false)), "TooFewData", "one place");
        assert_eq!(name(&wave(9, 1.0), options(0.0, false)), "InvalidTolerance", "zero");
        assert_eq!(name(&wave(9, 1.0), options(f64::NAN, false)), "InvalidTolerance", "NaN");
        assert_eq!(name(&[DVec2::NAN, DVec2::ONE], options(0.1, false)), "NonFinite", "NaN");
        let few = FitOptions { most_points: 6, ..options(1e-5, false) };
        assert_eq!(name(&wave(200, 2.0), few), "StepLimit", "six points");
    }
}
