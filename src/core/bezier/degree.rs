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

    /// A curve of degree `n − 1` with the same end points, exact if the leading coefficient is 0.
    ///
    /// The elevation is solved from the left for the left half of the points and from the right for the right half.
    ///
    /// # Errors
    ///
    /// `Empty` for degree 0; `NonFinite` where a control point overflows.
    pub fn reduce_degree(&self) -> Result<BezierReduction<P>, BezierError> {
        let (points, n) = (self.points(), self.degree());
        if n == 0 {
            return Err(BezierError::Empty { what: "control points left" });
        }
        let mut reduced = vec![P::ZERO; n];
        let middle = n.div_ceil(2);
        for k in 0..middle {
            let share = k as f64 / n as f64;
            let previous = if k == 0 { P::ZERO } else { reduced[k - 1] };
            reduced[k] = (points[k] - previous * share) * (1.0 - share).recip();
        }
        for k in (middle..n).rev() {
            let share = (k + 1) as f64 / n as f64;
            let next = if k + 1 == n { P::ZERO } else { reduced[k + 1] };
            reduced[k] = (points[k + 1] - next * (1.0 - share)) * share.recip();
        }
        let curve = Self::on_interval(reduced, self.interval())?;
        let raised = curve.elevate_degree();
        let bound = raised.points().iter().zip(points).map(|(&a, &b)| (a - b).norm()).fold(0.0, f64::max);
        Ok(BezierReduction { curve, bound })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reduction_undoes_elevation() {
        for n in 0..=12_u32 {
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
