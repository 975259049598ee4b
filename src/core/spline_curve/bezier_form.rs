//! The Bezier form of spline curves: one Bezier curve for each nonempty knot interval, and back.
//!
//! With every break `n`-fold, `n + 1` consecutive coefficients are the Bezier points of a piece, and neighbours share
//! one of them bit by bit. One sweep from left to right: a window holds the points `P[aⁿ⁻ʲ, τₗ₊₁, …, τₗ₊ⱼ]` of the polynomial at hand, where
//! `a = τₗ` starts the piece; inserting its other end `b` until it is `n`-fold turns them into the Bezier points `P[aⁿ⁻ʲ, bʲ]`, and leaves
//! the window of the next piece behind. Course: section 6.4.

use crate::core::bspline::{MAX_DEGREE, Spline};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// All polynomial pieces of a spline in Bezier form, without a list for each.
///
/// ```
/// # use spline_lab::core::bspline::{Spline, SplineSpace};
/// let space = SplineSpace::new(2, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// let pieces = Spline::new(space, vec![0.0, 2.0, 4.0, 2.0])?.bezier_pieces();
/// assert_eq!(pieces.breaks(), [2.0, 3.0, 4.0]);
/// assert_eq!(pieces.points(), [1.0, 2.0, 3.0, 4.0, 3.0]);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPieces<P> {
    degree: usize,
    breaks: Vec<f64>,
    points: Vec<P>,
}

impl<P: Point> BezierPieces<P> {
    /// The degree `n`.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The ends of the pieces, one more than pieces.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// All control points: piece `i` has the points `n i … n i + n`.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// Interval and control points of every piece, from left to right.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = ((f64, f64), &[P])> {
        let pieces = self.points.windows(self.degree + 1).step_by(self.degree);
        pieces.enumerate().map(|(i, points)| ((self.breaks[i], self.breaks[i + 1]), points))
    }
}

/// The polynomial piece over one knot interval `[a, b]`: `Σ points[j]·bⁿⱼ((x − a)/(b − a))` with Bernstein polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierSegment<P> {
    /// `(a, b)`, `a < b`.
    pub interval: (f64, f64),
    /// The `n + 1` control points.
    pub points: Vec<P>,
}

/// The rational piece over one knot interval, with Cartesian control points and their weights.
#[derive(Clone, Debug, PartialEq)]
pub struct RationalSegment<P> {
    /// `(a, b)`, `a < b`.
    pub interval: (f64, f64),
    /// The `n + 1` control points.
    pub points: Vec<P>,
    /// Their weights.
    pub weights: Vec<f64>,
}

impl<P: Point> Spline<P> {
    /// The pieces from left to right, over D or over one period from `ξ₀`, in one list; linear in the number of coefficients.
    pub fn bezier_pieces(&self) -> BezierPieces<P> {
        self.bezier_pieces_with_breaks(&[])
    }

    /// As [`Self::bezier_pieces`], with a list for each piece.
    pub fn bezier_form(&self) -> Vec<BezierSegment<P>> {
        self.bezier_form_with_breaks(&[])
    }

    /// As [`Self::bezier_form`] with the pieces also cut at the sorted parameters `cuts`; those outside the inner of D are ignored.
    pub(super) fn bezier_form_with_breaks(&self, cuts: &[f64]) -> Vec<BezierSegment<P>> {
        let pieces = self.bezier_pieces_with_breaks(cuts);
        pieces.iter().map(|(interval, points)| BezierSegment { interval, points: points.to_vec() }).collect()
    }

    fn bezier_pieces_with_breaks(&self, cuts: &[f64]) -> BezierPieces<P> {
        let (n, space) = (self.degree(), self.space());
        let unrolled: Vec<P>;
        let coefficients = if space.is_periodic() {
            unrolled = (0..space.evaluation_dimension()).map(|k| self.evaluation_coefficient(k)).collect();
            &unrolled
        } else {
            self.coefficients()
        };
        // With the degree a constant, the inner loops are unrolled.
        match n {
            1 => sweep(1, space.evaluation_knots(), coefficients, cuts),
            2 => sweep(2, space.evaluation_knots(), coefficients, cuts),
            3 => sweep(3, space.evaluation_knots(), coefficients, cuts),
            4 => sweep(4, space.evaluation_knots(), coefficients, cuts),
            5 => sweep(5, space.evaluation_knots(), coefficients, cuts),
            _ => sweep(n, space.evaluation_knots(), coefficients, cuts),
        }
    }
}

#[inline(always)]
fn sweep<P: Point>(n: usize, knots: &[f64], coefficients: &[P], cuts: &[f64]) -> BezierPieces<P> {
    let m = coefficients.len();
    let right = knots[m];
    let pieces = m - n + cuts.len();
    let (mut breaks, mut points) = (Vec::with_capacity(pieces + 1), Vec::with_capacity(pieces * n + 1));
    // l is the last knot at or below a.
    let (mut l, mut a) = (n, knots[n]);
    let mut cuts = cuts.iter().copied().peekable();
    let (mut window, mut next_window) = ([P::ZERO; MAX_DEGREE + 1], [P::ZERO; MAX_DEGREE + 1]);
    window[..=n].copy_from_slice(&coefficients[..=n]);
    let copies = knots[1..=n].iter().filter(|&&knot| knot >= a).count();
    for step in 1..=n - copies {
        for j in 0..=n - copies - step {
            let (low, high) = (knots[j + step], knots[n + j + 1]);
            window[j] = window[j].mix(window[j + 1], (a - low) / (high - low));
        }
    }
    breaks.push(a);
    points.push(window[0]);
    let mut gamma = [0.0; MAX_DEGREE];
    while a < right {
        let knot = knots[l + 1];
        while cuts.next_if(|&cut| cut <= a).is_some() {}
        let (b, copies) = match cuts.next_if(|&cut| cut < knot) {
            Some(cut) => (cut, 0),
            None => (knot, 1 + knots[l + 2..=l + n].iter().take_while(|&&other| other <= knot).count()),
        };
        let missing = n - copies;
        for i in copies..n {
            gamma[i] = (b - a) / (knots[l + 1 + i] - a);
        }
        next_window[missing] = window[n];
        for step in 1..=missing {
            for j in (copies + step..=n).rev() {
                window[j] = window[j - 1].mix(window[j], gamma[j - step]);
            }
            next_window[missing - step] = window[n];
        }
        breaks.push(b);
        points.extend_from_slice(&window[1..=n]);
        l += copies;
        a = b;
        if a < right {
            window[..=missing].copy_from_slice(&next_window[..=missing]);
            window[missing + 1..=n].copy_from_slice(&coefficients[l + missing + 1 - n..=l]);
        }
    }
    BezierPieces { degree: n, breaks, points }
}

impl<P: Projective> Nurbs<P> {
    /// The pieces from left to right; equal weights stay the weight they are.
    pub fn bezier_form(&self) -> Vec<RationalSegment<P>> {
        if self.is_polynomial() {
            let weight = self.weights().first().copied().unwrap_or(1.0);
            let rational = |segment: BezierSegment<P>| RationalSegment {
                interval: segment.interval,
                weights: vec![weight; segment.points.len()],
                points: segment.points,
            };
            return self.without_weights().bezier_form().into_iter().map(rational).collect();
        }
        self.homogeneous()
            .bezier_form()
            .into_iter()
            .map(|segment| {
                let (points, weights) = segment.points.into_iter().map(P::project).unzip();
                RationalSegment { interval: segment.interval, points, weights }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{Side, SplineSpace};
    use crate::core::spline_curve::samples::any_spline;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pieces_are_the_spline_and_join_as_smoothly_as_their_knots(spline in any_spline(1..=25), t in 0.0..1.0_f64) {
            let pieces = spline.bezier_form();
            let (n, space) = (spline.degree(), spline.space());
            prop_assert_eq!(pieces.len(), space.breaks().len() - 1, "one for each interval");
            for piece in &pieces {
                let mut points = piece.points.clone();
                while points.len() > 1 {
                    points = points.windows(2).map(|pair| pair[0].mix(pair[1], t)).collect();
                }
                let (a, b) = piece.interval;
                let error = points[0].distance(spline.evaluate(a.mix(b, t)).unwrap());
                prop_assert!(error < 1e-12, "[{a}, {b}]: off by {error}");
            }
            for pair in pieces.windows(2) {
                prop_assert_eq!(pair[0].points[n], pair[1].points[0], "a shared point");
                let at = pair[0].interval.1;
                let smooth = n - space.multiplicity(at);
                let [before, behind] = [0, 1].map(|i| Spline::from_bezier(&pair[i..=i]).unwrap());
                let (before, behind) = (
                    before.derivatives(at, smooth.min(3), Side::Left).unwrap(),
                    behind.derivatives(at, smooth.min(3), Side::Right).unwrap(),
                );
                for (order, (a, b)) in before.iter().zip(&behind).enumerate() {
                    prop_assert!(a.distance(*b) < 1e-8 * a.length().max(1e3), "order {order} at {at}: {a}, {b}");
                }
            }
        }
    }

    /// Bernstein sum by de Casteljau.
    fn value(points: &[f64], t: f64) -> f64 {
        let mut points = points.to_vec();
        while points.len() > 1 {
            points = points.windows(2).map(|pair| pair[0].mix(pair[1], t)).collect();
        }
        points[0]
    }

    fn agrees(spline: &Spline<f64>) {
        let pieces = spline.bezier_form();
        assert_eq!(pieces.len(), spline.space().breaks().len() - 1, "one piece for each interval");
        for piece in pieces {
            let (a, b) = piece.interval;
            for i in 0..=10 {
                let t = f64::from(i) / 10.0;
                let expected = spline.evaluate(a.mix(b, t)).unwrap();
                let error = (value(&piece.points, t) - expected).abs();
                assert!(error < 1e-12, "piece [{a}, {b}] at {t}: off by {error}");
            }
        }
    }

    #[test]
    fn pieces_are_the_spline() {
        let knots = vec![0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 8.0, 8.0, 9.0];
        let space = SplineSpace::new(3, knots).unwrap();
        agrees(&Spline::new(space, vec![-3.0, 1.0, -5.0, 4.0, 4.0, -7.0, 9.0]).unwrap());
        let uniform = SplineSpace::new(2, (0..9).map(f64::from).collect()).unwrap();
        agrees(&Spline::new(uniform, vec![1.0, -2.0, 0.5, 4.0, 3.0, 3.0]).unwrap());
        for (degree, knots) in
            [(3, vec![0.0, 1.0, 3.0]), (4, vec![0.5]), (2, vec![0.0, 0.0, 1.5]), (1, vec![0.0, 1.0])]
        {
            let coefficients = (0..knots.len()).map(|k| (k * k) as f64 + 1.0).collect();
            let space = SplineSpace::periodic(degree, 4.0, knots).unwrap();
            agrees(&Spline::new(space, coefficients).unwrap());
        }
    }

    #[test]
    fn a_hundred_thousand_pieces_do_not_take_quadratic_time() {
        let space = SplineSpace::new(3, (0..100_004).map(f64::from).collect()).unwrap();
        let spline = Spline::new(space, (0..100_000).map(|k| f64::from(k % 7)).collect()).unwrap();
        let pieces = spline.bezier_form();
        assert_eq!(pieces.len(), 99_997, "one for each interval");
        let error = (pieces[50_000].points[0] - spline.evaluate(50_003.0).unwrap()).abs();
        assert!(error < 1e-12, "a joint is on the spline, off by {error}");
    }

    #[test]
    fn pieces_of_a_rational_circle_stay_on_it() {
        let s = 0.5_f64.sqrt();
        let knots = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0];
        let points = [[1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
        let points = points.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y))).to_vec();
        let weights = vec![s, 1.0, s, 1.0, s, 1.0, s, 1.0];
        let circle = Nurbs::new(SplineSpace::periodic(2, 4.0, knots).unwrap(), points, weights).unwrap();
        let pieces = circle.bezier_form();
        assert_eq!(pieces.len(), 4, "four quarter circles");
        assert_eq!(pieces[0].points[0], DVec2::new(1.0, 0.0), "the first starts at (1, 0)");
        assert_eq!(pieces[0].weights, [1.0, s, 1.0], "weights of a quarter circle");
    }
}
