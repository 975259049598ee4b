//! Degree elevation and reduction of Bezier curves.
//!
//! Elevation: `c′ₖ = k/(n+1) cₖ₋₁ + (1 − k/(n+1)) cₖ`. Course: section 2.3.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::polynomial::elevate;

/// A curve of one degree less, with a bound of the difference.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierReduction<P> {
    /// The curve of degree `n − 1`.
    pub curve: BezierCurve<P>,
    /// Largest control point of the difference after raising the degree again: no point moves further, up to rounding.
    pub bound: f64,
}

impl<P: Point> BezierCurve<P> {
    /// The same curve with one control point more.
    #[must_use]
    pub fn elevate_degree(&self) -> Self {
        self.elevate_degree_by(1)
    }

    /// The same curve with `times` control points more; for many the polygons approach the curve like `1/n`.
    #[must_use]
    pub fn elevate_degree_by(&self, times: usize) -> Self {
        let raised = elevate(self.points(), times);
        self.with_points(raised.expect("convex combinations of finite points are finite"))
    }

    /// The curve of degree `n − 1` with the same end points whose elevated control points are nearest to ours in the sense of least
    /// squares; exact if the leading coefficient is 0. Degree 1 becomes the point in the middle.
    ///
    /// # Errors
    ///
    /// `Empty` for degree 0; `NonFinite` where a control point overflows.
    pub fn reduce_degree(&self) -> Result<BezierReduction<P>, BezierError> {
        let (points, n) = (self.points(), self.degree());
        if n == 0 {
            return Err(BezierError::Empty { what: "control points left" });
        }
        let reduced =
            if n == 1 { vec![points[0].mix(points[1], 0.5)] } else { least_squares_reduction(points) };
        let curve = Self::on_interval(reduced, self.interval())?;
        let raised = curve.elevate_degree();
        let bound = raised.points().iter().zip(points).map(|(&a, &b)| (a - b).norm()).fold(0.0, f64::max);
        Ok(BezierReduction { curve, bound })
    }
}

/// The inner points `x₁ … xₙ₋₂` minimise the sum of `|k/n xₖ₋₁ + (1 − k/n) xₖ − cₖ|²`, with `x₀ = c₀` and `xₙ₋₁ = cₙ`: normal equations with three
/// diagonals, whose condition grows like `n` only.
fn least_squares_reduction<P: Point>(points: &[P]) -> Vec<P> {
    let n = points.len() - 1;
    let share = |k: usize| k as f64 / n as f64;
    let mut x = vec![P::ZERO; n];
    (x[0], x[n - 1]) = (points[0], points[n]);
    let beside = |j: usize| share(j + 1) * (1.0 - share(j + 1));
    // Elimination from the left; `pivot[j]` and `x[j]` are what is left of row j.
    let mut pivot = vec![1.0; n];
    for j in 1..n.saturating_sub(1) {
        let mut right = points[j] * (1.0 - share(j)) + points[j + 1] * share(j + 1);
        if j == 1 {
            right = right - x[0] * beside(0);
        }
        if j == n - 2 {
            right = right - x[n - 1] * beside(j);
        }
        let diagonal = (1.0 - share(j)).powi(2) + share(j + 1).powi(2);
        let factor = if j == 1 { 0.0 } else { beside(j - 1) / pivot[j - 1] };
        pivot[j] = diagonal - factor * beside(j - 1);
        x[j] = right - x[j - 1] * factor;
    }
    for j in (1..n.saturating_sub(1)).rev() {
        let next = if j == n - 2 { P::ZERO } else { x[j + 1] * beside(j) };
        x[j] = (x[j] - next) * pivot[j].recip();
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reduction_undoes_elevation() {
        for n in 0..=24_u32 {
            let points = (0..=n).map(|k| f64::from(k * k % 5)).collect();
            let curve = BezierCurve::new(points).unwrap();
            let back = curve.elevate_degree().reduce_degree().unwrap();
            assert!(back.bound < 1e-11, "degree {n}: bound {}", back.bound);
            for (a, b) in back.curve.points().iter().zip(curve.points()) {
                assert!((a - b).abs() < 1e-11, "degree {n}: {a} and {b}");
            }
        }
    }

    #[test]
    fn no_other_inner_points_are_nearer() {
        let curve = BezierCurve::new(vec![0.0, 3.0, -1.0, 2.0, 5.0, 1.0, -2.0]).unwrap();
        let reduced = curve.reduce_degree().unwrap().curve;
        let squares = |points: Vec<f64>| {
            let raised = BezierCurve::new(points).unwrap().elevate_degree();
            raised.points().iter().zip(curve.points()).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
        };
        let best = squares(reduced.points().to_vec());
        for k in 1..5 {
            for step in [-1e-3, 1e-3] {
                let mut other = reduced.points().to_vec();
                other[k] += step;
                assert!(squares(other) > best + 1e-8, "point {k} moved by {step}");
            }
        }
        let line = BezierCurve::new(vec![1.0, 4.0]).unwrap().reduce_degree().unwrap();
        assert_eq!(
            (line.curve.points(), line.bound),
            ([2.5].as_slice(), 1.5),
            "a segment becomes its middle"
        );
    }

    #[test]
    fn the_bound_holds() {
        let curve = BezierCurve::new(vec![0.0, 3.0, -1.0, 2.0, 5.0, 1.0]).unwrap();
        let reduction = curve.reduce_degree().unwrap();
        assert_eq!(reduction.curve.points()[0], 0.0, "the first point stays");
        assert_eq!(reduction.curve.points()[4], 1.0, "the last point stays");
        for i in 0..=50 {
            let t = f64::from(i) / 50.0;
            let gap = (curve.evaluate(t).unwrap() - reduction.curve.evaluate(t).unwrap()).abs();
            assert!(gap <= reduction.bound + 1e-14, "t = {t}: {gap} > {}", reduction.bound);
        }
        assert_eq!(
            BezierCurve::new(vec![1.0]).unwrap().reduce_degree().unwrap_err().name(),
            "Empty",
            "degree 0"
        );
    }
}
