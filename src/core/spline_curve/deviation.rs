//! Measured deviation: a certified bound of the distance of two curves at equal parameters.
//!
//! Both curves in Bezier form over the merged breaks and, piece by piece, the difference in Bernstein form:
//! `P − Q` of polynomial curves, `(P v − Q w)/(w v)` of rational ones `P/w` and `Q/v`. The largest coefficient (over the
//! smallest weights) bounds the distance from above, samples bound it from below; the pieces with the largest bound are
//! halved until both agree to 5 percent. Course: beyond, section B.3.

use std::collections::BinaryHeap;

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::bezier_form::BezierSegment;

/// The subdivision also stops here, relative to the size of the curves: below is rounding.
const NEGLIGIBLE: f64 = 1e-13;
/// Steps of the bisection for the largest distance around a sample.
const SEARCH_STEPS: usize = 53;
/// Relative difference up to which two parameter intervals count as equal.
const SAME_INTERVAL: f64 = 1e-12;

/// The maximum of `|p(t) − q(t)|` over the common interval, enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The maximum is not larger, rounding included.
    pub upper: f64,
    /// The largest distance seen; the maximum is not smaller, up to rounding.
    pub lower: f64,
    /// Parameter at which `lower` was seen.
    pub at: f64,
}

/// When the enclosure is good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviationLimits {
    /// Subdivision stops when `upper ≤ (1 + relative_gap)·lower`.
    pub relative_gap: f64,
    /// Most halvings, on average for each common knot interval of both curves; 0 compares the Bezier forms as they are.
    pub halvings_per_piece: usize,
}

impl Default for DeviationLimits {
    /// 5 percent, 64 halvings.
    fn default() -> Self {
        Self { relative_gap: 0.05, halvings_per_piece: 64 }
    }
}

/// Encloses the largest distance of `p` and `q` at equal parameters; their degrees and knots may differ.
///
/// This depends on the parametrisation: it bounds the distance of the two point sets, but one set with two different
/// parametrisations does not give 0.
///
/// # Errors
///
/// `OutsideInterval` (the first end of the interval of `q` that is not that of `p`) if the parameter intervals differ by
/// more than 1e-12 of their length. Two closed curves with one period may start at different parameters.
pub fn deviation<P: Projective>(p: &Nurbs<P>, q: &Nurbs<P>) -> Result<Deviation, SplineError> {
    deviation_within(p, q, DeviationLimits::default())
}

/// As [`deviation`], with other limits.
///
/// # Errors
///
/// As [`deviation`].
pub fn deviation_within<P: Projective>(
    p: &Nurbs<P>,
    q: &Nurbs<P>,
    limits: DeviationLimits,
) -> Result<Deviation, SplineError> {
    let (left, right) = p.space().parameter_interval();
    if let (Some(mine), Some(theirs)) = (p.space().period(), q.space().period())
        && (mine - theirs).abs() <= SAME_INTERVAL * mine
        && q.space().parameter_interval().0.to_bits() != left.to_bits()
    {
        // A closed curve over the same period that starts elsewhere.
        return compared(p, &q.trimmed(left, left + theirs)?, limits);
    }
    let other = q.space().parameter_interval();
    for (mine, theirs) in [(left, other.0), (right, other.1)] {
        if (mine - theirs).abs() > SAME_INTERVAL * (right - left) {
            return Err(SplineError::OutsideInterval { value: theirs, left, right });
        }
    }
    compared(p, q, limits)
}

/// As [`deviation_within`], with the interval of `q` mapped to that of `p`.
fn compared<P: Projective>(
    p: &Nurbs<P>,
    q: &Nurbs<P>,
    limits: DeviationLimits,
) -> Result<Deviation, SplineError> {
    let (left, _) = p.space().parameter_interval();
    let centre = p.points()[0];
    let size = p.points().iter().chain(q.points()).map(|&c| (c - centre).norm()).fold(0.0, f64::max);
    let mut heap: BinaryHeap<Piece<P>> = pieces(p, q, centre)?.into();
    let mut found = Deviation { upper: 0.0, lower: 0.0, at: left };
    for piece in &heap {
        piece.sample(&mut found);
    }
    let degree = p.degree() + q.degree();
    let rounding = 8.0 * (degree + 1) as f64 * f64::EPSILON * 0.5 * size;
    let mut halvings = limits.halvings_per_piece.saturating_mul(heap.len());
    while let Some(piece) = heap.peek() {
        found.upper = piece.upper;
        let enough =
            piece.upper <= (1.0 + limits.relative_gap) * found.lower || piece.upper <= NEGLIGIBLE * size;
        if enough || halvings == 0 {
            break;
        }
        halvings -= 1;
        if let Some(piece) = heap.pop() {
            for half in piece.halves() {
                half.sample(&mut found);
                heap.push(half);
            }
        }
    }
    found.upper = found.upper.max(found.lower) + rounding;
    Ok(found)
}

/// `numerator/(first·second)` in Bernstein form over one interval.
struct Piece<P> {
    interval: (f64, f64),
    numerator: Vec<P>,
    first: Vec<f64>,
    second: Vec<f64>,
    upper: f64,
}

impl<P: Point> Piece<P> {
    fn new(interval: (f64, f64), numerator: Vec<P>, first: Vec<f64>, second: Vec<f64>) -> Self {
        let least = |weights: &[f64]| weights.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = numerator.iter().map(|point| point.norm()).fold(0.0, f64::max);
        let upper = largest / (least(&first) * least(&second));
        Self { interval, numerator, first, second, upper }
    }

    /// Distance at the share `t` of the interval.
    fn distance(&self, t: f64) -> f64 {
        let value = de_casteljau(&self.numerator, t).norm();
        value / (de_casteljau(&self.first, t) * de_casteljau(&self.second, t))
    }

    /// Raises `found.lower` to the largest distance at equal steps, and from there to the top by bisection on the sign of its slope.
    fn sample(&self, found: &mut Deviation) {
        let count = 2 * self.numerator.len().min(16);
        let mut best = (found.lower, None);
        for i in 0..=count {
            let t = i as f64 / count as f64;
            let distance = self.distance(t);
            if distance > best.0 {
                best = (distance, Some(t));
            }
        }
        let (top, Some(t)) = best else { return };
        let step = 1.0 / count as f64;
        let (mut low, mut high) = ((t - step).max(0.0), (t + step).min(1.0));
        let mut at = t;
        if self.rises(low) && !self.rises(high) {
            for _ in 0..SEARCH_STEPS {
                at = 0.5 * (low + high);
                if self.rises(at) {
                    low = at;
                } else {
                    high = at;
                }
            }
        }
        let found_there = self.distance(at);
        let (distance, place) = if found_there >= top { (found_there, at) } else { (top, t) };
        found.lower = distance;
        found.at = self.interval.0.mix(self.interval.1, place);
    }

    /// Whether the distance grows at `t`: the sign of `N·N′ − |N|² (f′/f + s′/s)` for `N/(f s)`.
    fn rises(&self, t: f64) -> bool {
        let ((value, slope), (first, first_slope)) =
            (with_slope(&self.numerator, t), with_slope(&self.first, t));
        let (second, second_slope) = with_slope(&self.second, t);
        let dot = |a: P, b: P| (0..P::DIMENSION).map(|i| a.coordinate(i) * b.coordinate(i)).sum::<f64>();
        dot(value, slope) > dot(value, value) * (first_slope / first + second_slope / second)
    }

    fn halves(self) -> [Self; 2] {
        let (a, b) = self.interval;
        let middle = a.mix(b, 0.5);
        let (numerator, first, second) = (halves(self.numerator), halves(self.first), halves(self.second));
        [
            Self::new((a, middle), numerator.0, first.0, second.0),
            Self::new((middle, b), numerator.1, first.1, second.1),
        ]
    }
}

impl<P> PartialEq for Piece<P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<P> Eq for Piece<P> {}

impl<P> PartialOrd for Piece<P> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl<P> Ord for Piece<P> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

fn pieces<P: Projective>(p: &Nurbs<P>, q: &Nurbs<P>, centre: P) -> Result<Vec<Piece<P>>, SplineError> {
    let interval = p.space().parameter_interval();
    if p.is_polynomial() && q.is_polynomial() {
        let q = with_interval(q.without_weights(), interval)?;
        let (p, q) = common_pieces(p.without_weights(), &q);
        let degree = p.iter().chain(&q).map(|piece| piece.points.len() - 1).max().unwrap_or(0);
        let difference = |(p, q): (BezierSegment<P>, BezierSegment<P>)| {
            let raised = elevated(p.points, degree).into_iter().zip(elevated(q.points, degree));
            Piece::new(p.interval, raised.map(|(a, b)| a - b).collect(), vec![1.0], vec![1.0])
        };
        return Ok(p.into_iter().zip(q).map(difference).collect());
    }
    let q = with_interval(q.homogeneous(), interval)?;
    let (p, q) = common_pieces(p.homogeneous(), &q);
    let rational = |(p, q): (BezierSegment<P::Homogeneous>, BezierSegment<P::Homogeneous>)| {
        let split = |points: &[P::Homogeneous]| -> (Vec<P>, Vec<f64>) {
            points
                .iter()
                .map(|&point| {
                    let weight = point.coordinate(P::DIMENSION);
                    (P::numerator(point) - centre * weight, weight)
                })
                .unzip()
        };
        let ((a, first), (b, second)) = (split(&p.points), split(&q.points));
        let numerator = product(&a, &second).into_iter().zip(product(&b, &first)).map(|(x, y)| x - y);
        Piece::new(p.interval, numerator.collect(), first, second)
    };
    Ok(p.into_iter().zip(q).map(rational).collect())
}

/// The same pieces of both: each is cut at the breaks of the other.
fn common_pieces<P: Point>(p: &Spline<P>, q: &Spline<P>) -> (Vec<BezierSegment<P>>, Vec<BezierSegment<P>>) {
    (p.bezier_form_with_breaks(&q.space().breaks()), q.bezier_form_with_breaks(&p.space().breaks()))
}

/// The open spline over D with the knots moved so that D becomes `interval` bit for bit.
fn with_interval<P: Point>(spline: &Spline<P>, interval: (f64, f64)) -> Result<Spline<P>, SplineError> {
    let space = spline.space();
    let (left, right) = space.parameter_interval();
    if (left, right) == interval {
        return Ok(spline.clone());
    }
    let scale = (interval.1 - interval.0) / (right - left);
    let moved = |knot: f64| {
        if knot == left {
            interval.0
        } else if knot == right {
            interval.1
        } else {
            interval.0 + (knot - left) * scale
        }
    };
    let knots = space.evaluation_knots().iter().map(|&knot| moved(knot)).collect();
    let coefficients = (0..space.evaluation_dimension()).map(|k| spline.evaluation_coefficient(k)).collect();
    Spline::new(SplineSpace::new(space.degree(), knots)?, coefficients)
}

/// Bernstein coefficients of the product: `Σᵢ C(m,i) C(n,k−i)/C(m+n,k) aᵢ bₖ₋ᵢ`.
fn product<P: Point>(a: &[P], b: &[f64]) -> Vec<P> {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let coefficient = |k: usize| {
        (k.saturating_sub(n)..=k.min(m)).fold(P::ZERO, |sum, i| {
            sum + a[i] * (b[k - i] * (binomial(m, i) * binomial(n, k - i) / binomial(m + n, k)))
        })
    };
    (0..=m + n).map(coefficient).collect()
}

/// `C(n, k)`, exact below 2^53.
fn binomial(n: usize, k: usize) -> f64 {
    (0..k.min(n - k)).fold(1.0, |value, i| value * (n - i) as f64 / (i + 1) as f64)
}

/// The control points of the same Bezier curve with the given, not smaller degree.
fn elevated<P: Point>(mut points: Vec<P>, degree: usize) -> Vec<P> {
    while points.len() <= degree {
        let n = points.len() as f64;
        let last = points[points.len() - 1];
        let inner: Vec<P> = (1..points.len()).map(|j| points[j].mix(points[j - 1], j as f64 / n)).collect();
        points.truncate(1);
        points.extend(inner);
        points.push(last);
    }
    points
}

fn de_casteljau<P: Point>(points: &[P], t: f64) -> P {
    with_slope(points, t).0
}

/// Value and derivative.
fn with_slope<P: Point>(points: &[P], t: f64) -> (P, P) {
    let mut points = points.to_vec();
    let n = points.len() - 1;
    let mut slope = P::ZERO;
    for count in (1..=n).rev() {
        slope = points[1] - points[0];
        for j in 0..count {
            points[j] = points[j].mix(points[j + 1], t);
        }
    }
    (points[0], slope * n as f64)
}

/// Control points of the left and the right half.
fn halves<P: Point>(mut points: Vec<P>) -> (Vec<P>, Vec<P>) {
    let mut left = vec![points[0]];
    for count in (1..points.len()).rev() {
        for j in 0..count {
            points[j] = points[j].mix(points[j + 1], 0.5);
        }
        left.push(points[0]);
    }
    (left, points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::{any_curve, distance};
    use glam::DVec2;
    use proptest::prelude::*;

    /// Another curve over the space of the given one: control points turned and pushed.
    fn other(curve: &Nurbs<DVec2>, push: f64) -> Nurbs<DVec2> {
        curve.transformed(|p| DVec2::new(p.x - 0.2 * push * p.y, p.y + push)).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn it_is_symmetric_encloses_samples_and_does_not_see_motions(curve in any_curve(1..=5), push in 0.01..2.0_f64) {
            let moved = other(&curve, push);
            let (there, back) = (deviation(&curve, &moved).unwrap(), deviation(&moved, &curve).unwrap());
            prop_assert!(there.lower <= there.upper, "{there:?}");
            let sampled = distance(&curve, &moved);
            prop_assert!(sampled <= there.upper + 1e-13, "{sampled} and {there:?}");
            prop_assert!(back.lower <= there.upper && there.lower <= back.upper, "{there:?} and {back:?}");
            let turn = DVec2::from_angle(0.9);
            let motion = |p: DVec2| turn.rotate(p) + DVec2::new(5.0, -2.0);
            let far = deviation(&curve.transformed(motion).unwrap(), &moved.transformed(motion).unwrap()).unwrap();
            prop_assert!(far.lower <= there.upper + 1e-12 && there.lower <= far.upper + 1e-12, "{there:?} and {far:?}");
        }

        #[test]
        fn the_triangle_inequality_holds(curve in any_curve(1..=4), push in 0.01..2.0_f64, second in -2.0..-0.01_f64) {
            let (q, r) = (other(&curve, push), other(&curve, second));
            let [a, b, c] = [(&curve, &q), (&q, &r), (&curve, &r)].map(|(a, b)| deviation(a, b).unwrap());
            prop_assert!(c.lower <= a.upper + b.upper, "{a:?}, {b:?}, {c:?}");
        }

        #[test]
        fn operations_that_keep_the_shape_deviate_by_rounding(curve in any_curve(1..=7), share in 0.01..0.99_f64) {
            let (left, right) = curve.space().parameter_interval();
            let t = left.mix(right, share);
            let (before, after) = curve.split(t).unwrap();
            for (what, same) in [
                ("inserted", curve.insert_knot(t).unwrap()),
                ("elevated", curve.elevate_degree().unwrap()),
                ("Bezier", Nurbs::from_bezier(&curve.bezier_form()).unwrap()),
                ("split", before.joined(&after).unwrap()),
            ] {
                let found = deviation(&curve, &same).unwrap();
                prop_assert!(found.upper < 1e-9, "{what}: {found:?}");
            }
        }
    }

    fn bezier(points: &[[f64; 2]], weights: &[f64]) -> Nurbs<DVec2> {
        let n = points.len() - 1;
        let mut knots = vec![-1.0];
        knots.extend(vec![0.0; n]);
        knots.extend(vec![1.0; n]);
        knots.push(2.0);
        let points = points.iter().map(|&[x, y]| DVec2::new(x, y)).collect();
        Nurbs::new(SplineSpace::new(n, knots).unwrap(), points, weights.to_vec()).unwrap()
    }

    #[test]
    fn a_moved_point_deviates_by_its_share_of_the_bernstein_polynomial() {
        let p = bezier(&[[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]], &[1.0; 4]);
        let q = bezier(&[[0.0, 0.0], [1.3, 2.4], [3.0, 2.0], [4.0, 0.0]], &[1.0; 4]);
        let found = deviation(&p, &q).unwrap();
        let exact = 2.0 / 9.0;
        assert!(found.lower <= exact + 1e-15 && exact <= found.upper, "{found:?}");
        assert!(found.upper <= 1.06 * found.lower, "{found:?}");
        assert!((found.at - 1.0 / 3.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn two_parametrisations_of_a_circle_differ_by_their_speed() {
        let points = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let p = bezier(&points, &[1.0, 1.0, 2.0]);
        let q = bezier(&points, &[1.0, 0.5_f64.sqrt(), 1.0]);
        let found = deviation(&p, &q).unwrap();
        let exact = 0.1430140438;
        assert!(found.lower <= exact + 1e-10 && exact <= found.upper + 1e-10, "{found:?}");
        assert!(found.upper <= 1.06 * exact, "{found:?}");
        let back = deviation(&q, &p).unwrap();
        assert!((back.upper - found.upper).abs() < 1e-12, "symmetric: {back:?}");
    }

    #[test]
    fn insertion_deviates_by_rounding_only() {
        let p = bezier(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[1.0, 0.5_f64.sqrt(), 1.0]);
        let refined = p.insert_knots(&[0.5, 0.1, 0.7]).unwrap();
        let found = deviation(&p, &refined).unwrap();
        assert!(found.upper < 1e-14, "{found:?}");
        let closed = Nurbs::polynomial(
            SplineSpace::periodic(3, 4.0, vec![0.0, 1.0, 2.5]).unwrap(),
            vec![DVec2::X, DVec2::Y, DVec2::new(-2.0, 0.5)],
        )
        .unwrap();
        let found = deviation(&closed, &closed.insert_knot(0.7).unwrap()).unwrap();
        assert!(found.upper < 1e-13, "closed: {found:?}");
    }

    #[test]
    fn different_intervals_are_refused() {
        let p = bezier(&[[0.0, 0.0], [1.0, 0.0]], &[1.0; 2]);
        let space = SplineSpace::new(1, vec![-1.0, 0.0, 2.0, 3.0]).unwrap();
        let q = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X]).unwrap();
        assert_eq!(deviation(&p, &q).unwrap_err().name(), "OutsideInterval", "[0, 1] and [0, 2]");
    }
}
