//! The Bezier form of spline curves: one Bezier curve for each nonempty knot interval.
//!
//! With every break `n`-fold, `n + 1` consecutive coefficients are the Bezier points of a piece, and neighbours share
//! one of them bit by bit. Course: section 6.4.

use crate::core::bspline::Spline;
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::knot_insertion::insert_open;

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
    /// The pieces from left to right, over D or over one period from `ξ₀`; linear in the number of coefficients.
    pub fn bezier_form(&self) -> Vec<BezierSegment<P>> {
        self.bezier_form_with_breaks(&[])
    }

    /// As [`Self::bezier_form`] with the pieces also cut at the sorted parameters `cuts`; those outside the inner of D are ignored.
    pub(super) fn bezier_form_with_breaks(&self, cuts: &[f64]) -> Vec<BezierSegment<P>> {
        let (n, space) = (self.degree(), self.space());
        let (left, right) = space.parameter_interval();
        let mut breaks = space.breaks();
        breaks.extend(cuts.iter().filter(|&&cut| left < cut && cut < right));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let coefficients: Vec<P> =
            (0..space.evaluation_dimension()).map(|k| self.evaluation_coefficient(k)).collect();
        let missing: Vec<f64> = breaks
            .iter()
            .flat_map(|&at| std::iter::repeat_n(at, n.saturating_sub(space.multiplicity(at))))
            .collect();
        let (_, points) = insert_open(n, space.evaluation_knots(), &coefficients, &missing);
        breaks
            .windows(2)
            .zip(points.windows(n + 1).step_by(n))
            .map(|(ends, points)| BezierSegment { interval: (ends[0], ends[1]), points: points.to_vec() })
            .collect()
    }
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
    use crate::core::bspline::SplineSpace;
    use glam::DVec2;

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
