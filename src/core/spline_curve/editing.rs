//! Curves made of curves: one point or weight replaced, reversed, mapped, opened, closed; and the circle.
//!
//! Course: section 6.1.

use glam::DVec2;

use crate::core::bspline::{EndKnots, Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Projective> Nurbs<P> {
    /// The closed curve with uniform simple knots `0, 1, …, M − 1`, period `M`, for `M` control points.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::periodic`] and [`Nurbs::new`].
    pub fn closed(points: Vec<P>, weights: Vec<f64>, degree: usize) -> Result<Self, SplineError> {
        let knots = (0..points.len()).map(|k| k as f64).collect();
        let space = SplineSpace::periodic(degree, points.len() as f64, knots)?;
        Self::new(space, points, weights)
    }

    /// The same curve over D, or over one period, as an open curve with end-interpolating knots.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`] if `f64` has no room for the outer knots.
    pub fn opened(&self) -> Result<Self, SplineError> {
        self.mapped(clamped, clamped)
    }

    /// The curve with control point `index` replaced; the weight stays.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such point, `NonFinite`.
    pub fn with_point(&self, index: usize, point: P) -> Result<Self, SplineError> {
        let mut points = self.points().to_vec();
        *slot(&mut points, index)? = point;
        Self::new(self.space().clone(), points, self.weights().to_vec())
    }

    /// The curve with weight `index` replaced; the control point stays.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such weight, `NonFinite`, `WeightNotPositive`.
    pub fn with_weight(&self, index: usize, weight: f64) -> Result<Self, SplineError> {
        let mut weights = self.weights().to_vec();
        *slot(&mut weights, index)? = weight;
        Self::new(self.space().clone(), self.points().to_vec(), weights)
    }

    /// The curve with every control point mapped; an affine map maps the curve.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the index of the first control point that is mapped to no point.
    pub fn transformed(&self, map: impl Fn(P) -> P) -> Result<Self, SplineError> {
        let points = self.points().iter().map(|&point| map(point)).collect();
        Self::new(self.space().clone(), points, self.weights().to_vec())
    }

    /// The curve in the opposite direction over the same interval: `t` becomes `left + right − t`.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`] if rounding makes the mirrored knots coincide.
    pub fn reversed(&self) -> Result<Self, SplineError> {
        let (n, space) = (self.degree(), self.space());
        let (left, right) = space.parameter_interval();
        // Exact at both ends, so that the interval stays what it was.
        let mirrored = |knot: f64| {
            if knot.to_bits() == left.to_bits() {
                right
            } else if knot.to_bits() == right.to_bits() {
                left
            } else {
                left + (right - knot)
            }
        };
        let mut points: Vec<P> = self.points().iter().rev().copied().collect();
        let mut weights: Vec<f64> = self.weights().iter().rev().copied().collect();
        let Some(period) = space.period() else {
            let knots = space.knots().iter().rev().map(|&knot| mirrored(knot)).collect();
            return Self::new(SplineSpace::new(n, knots)?, points, weights);
        };
        // All copies of ξ₀ stay at ξ₀; the other knots of the period mirror inside it.
        let (knots, count) = (space.knots(), space.dimension());
        let start = knots.iter().take_while(|&&knot| knot <= left).count();
        let mut new = knots[..start].to_vec();
        new.extend(knots[start..].iter().rev().map(|&knot| mirrored(knot)));
        // Old B-spline k has the knots k … k + n + 1; mirrored, new knot j is old knot start − 1 − j.
        // New B-spline j therefore is old number start − 1 − (j + n + 1).
        for j in 0..count {
            let old = (start as isize - 2 - j as isize - n as isize).rem_euclid(count as isize) as usize;
            points[j] = self.points()[old];
            weights[j] = self.weights()[old];
        }
        Self::new(SplineSpace::periodic(n, period, new)?, points, weights)
    }
}

impl Nurbs<DVec2> {
    /// The full circle as a closed rational quadratic over `[0, 4)`, counterclockwise from `center + (radius, 0)`.
    ///
    /// Eight control points on a square, weights 1 at the axis points and `1/√2` at the corners.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` unless the radius is positive.
    pub fn circle(center: DVec2, radius: f64) -> Result<Self, SplineError> {
        if radius <= 0.0 {
            return Err(SplineError::Degenerate {
                what: "a circle without a positive radius",
                parameter: radius,
            });
        }
        let knots = (0..8_u8).map(|k| f64::from(k / 2)).collect();
        let square = [[1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
        let points = square.map(|[x, y]| center + radius * DVec2::new(f64::from(x), f64::from(y))).to_vec();
        let corner = std::f64::consts::FRAC_1_SQRT_2;
        let weights = (0..8).map(|k| if k % 2 == 0 { corner } else { 1.0 }).collect();
        Self::new(SplineSpace::periodic(2, 4.0, knots)?, points, weights)
    }
}

/// The open spline with `n`-fold ends and the outer knots where the convention puts them.
pub(super) fn clamped<P: Point>(spline: &Spline<P>) -> Result<Spline<P>, SplineError> {
    let n = spline.degree();
    let open = spline.unroll()?;
    let (left, right) = open.space().parameter_interval();
    let mut missing = vec![left; n.saturating_sub(open.space().multiplicity(left))];
    missing.extend(vec![right; n.saturating_sub(open.space().multiplicity(right))]);
    let (space, coefficients) = open.insert_knots(&missing)?.into_parts();
    let inner = &space.knots()[n..=space.dimension()];
    Spline::new(SplineSpace::from_breaks(n, inner, EndKnots::Interpolating)?, coefficients)
}

fn slot<T>(values: &mut [T], index: usize) -> Result<&mut T, SplineError> {
    let expected = index + 1;
    let found = values.len();
    values.get_mut(index).ok_or(SplineError::SizeMismatch { what: "control points", expected, found })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::deviation;

    fn open_curve() -> Nurbs<DVec2> {
        let knots = vec![1.0, 2.0, 2.0, 2.0, 3.0, 5.0, 5.0, 8.0, 9.0, 10.0, 11.0];
        let points = [[0, 2], [4, 1], [4, 4], [1, 4], [1, 9], [5, 8], [4, 6]];
        let points = points.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y))).to_vec();
        let weights = vec![1.0, 2.0, 0.5, 1.0, 3.0, 1.0, 0.7];
        Nurbs::new(SplineSpace::new(3, knots).unwrap(), points, weights).unwrap()
    }

    fn closed_curves() -> Vec<Nurbs<DVec2>> {
        let curve = |degree, knots: Vec<f64>| {
            let points = (0..knots.len()).map(|k| DVec2::new((k * k % 5) as f64, (k % 3) as f64)).collect();
            let weights = (0..knots.len()).map(|k| 1.0 + (k % 2) as f64).collect();
            Nurbs::new(SplineSpace::periodic(degree, 7.0, knots).unwrap(), points, weights).unwrap()
        };
        vec![
            curve(3, vec![0.0, 1.0, 2.5, 4.0, 6.0]),
            curve(3, vec![0.0, 0.0, 2.0, 2.0, 5.0]),
            curve(4, vec![-1.0, 2.0]),
            curve(2, vec![0.5]),
            Nurbs::circle(DVec2::new(3.0, -1.0), 2.0).unwrap(),
        ]
    }

    #[test]
    fn opening_keeps_the_curve() {
        for curve in closed_curves().into_iter().chain([open_curve()]) {
            let opened = curve.opened().unwrap();
            let (left, right) = opened.space().parameter_interval();
            assert_eq!(opened.space().multiplicity(left), curve.degree(), "left end");
            assert_eq!(opened.space().multiplicity(right), curve.degree(), "right end");
            let found = deviation(&curve, &opened).unwrap();
            assert!(found.upper < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn the_reversed_curve_runs_backwards() {
        for curve in closed_curves().into_iter().chain([open_curve()]) {
            let reversed = curve.reversed().unwrap();
            let (left, right) = curve.space().parameter_interval();
            assert_eq!(reversed.space().parameter_interval(), (left, right), "the interval stays");
            for i in 0..=50 {
                let t = left.mix(right, f64::from(i) / 50.0);
                let (a, b) = (curve.evaluate(t).unwrap(), reversed.evaluate(left + right - t).unwrap());
                assert!((a - b).length() < 1e-12, "degree {}, t = {t}: {a} and {b}", curve.degree());
            }
        }
    }

    #[test]
    fn a_circle_keeps_its_distance() {
        let circle = Nurbs::circle(DVec2::new(3.0, -1.0), 2.0).unwrap();
        for i in 0..=64 {
            let radius = (circle.evaluate(f64::from(i) / 16.0).unwrap() - DVec2::new(3.0, -1.0)).length();
            assert!((radius - 2.0).abs() < 1e-14, "radius {radius}");
        }
        assert_eq!(Nurbs::circle(DVec2::ZERO, 0.0).unwrap_err().name(), "Degenerate", "radius 0");
    }

    #[test]
    fn replacing_names_what_is_wrong() {
        let curve = open_curve();
        assert_eq!(curve.with_point(2, DVec2::X).unwrap().points()[2], DVec2::X, "the new point");
        assert_eq!(curve.with_weight(2, 9.0).unwrap().weights()[2], 9.0, "the new weight");
        assert_eq!(curve.with_point(7, DVec2::X).unwrap_err().name(), "SizeMismatch", "seven points");
        let negative = curve.with_weight(1, -1.0).unwrap_err();
        assert_eq!(negative, SplineError::WeightNotPositive { index: 1, value: -1.0 }, "index and value");
        let moved = curve.transformed(|point| point + DVec2::X).unwrap();
        let error = moved.evaluate(4.0).unwrap() - curve.evaluate(4.0).unwrap() - DVec2::X;
        assert!(error.length() < 1e-14, "translations move the curve, off by {error}");
        let ring = Nurbs::closed(curve.points().to_vec(), curve.weights().to_vec(), 3).unwrap();
        assert_eq!(ring.space().period(), Some(7.0), "seven points, period 7");
    }
}
