//! Subdivision: the control points of parts of a curve.
//!
//! The first diagonal of de Casteljau's scheme at `x` holds the control points of the part before `x`, the last one those of the part after it.
//! The part over `[u, v]` has the control points `b[uⁿ⁻ᵏ, vᵏ]` of the blossom. Course: section 2.6.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::polynomial::bernstein_values;
use crate::core::triangular_scheme::collapse_both;

/// Most levels of [`BezierCurve::subdivided`]: a million pieces.
const MAX_LEVELS: usize = 20;

impl<P: Point> BezierCurve<P> {
    /// The parts over `[a, x]` and `[x, b]`; they share the point `p(x)` bit for bit.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `OutsideInterval` unless `a < x < b`.
    pub fn split(&self, x: f64) -> Result<(Self, Self), BezierError> {
        let (left, right) = self.interval();
        let (first, second) = self.split_points(x)?;
        if x <= left || x >= right {
            return Err(BezierError::OutsideInterval { what: "split parameter", value: x, left, right });
        }
        Ok((Self::on_interval(first, (left, x))?, Self::on_interval(second, (x, right))?))
    }

    /// The control points of the polynomial from `a` to `x` and from `x` to `b` for any `x`: outside the interval the first or second
    /// part extrapolates, at an end one part is a point.
    ///
    /// # Errors
    ///
    /// `NonFinite`, also where a control point overflows.
    pub fn split_points(&self, x: f64) -> Result<(Vec<P>, Vec<P>), BezierError> {
        let t = self.local_parameter(x)?;
        let mut second = self.points().to_vec();
        let mut first = second.clone();
        collapse_both(&mut second, t, &mut first);
        Ok((Self::new(first)?.points, Self::new(second)?.points))
    }

    /// The curve over `[from, to]`, a part of this one or its extrapolation.
    ///
    /// # Errors
    ///
    /// `NonFinite`, also where a control point overflows; `EmptyInterval` unless `from < to` (reverse the curve for the other direction).
    pub fn restricted(&self, from: f64, to: f64) -> Result<Self, BezierError> {
        let n = self.degree();
        let mut arguments = vec![from; n];
        let mut points = Vec::with_capacity(n + 1);
        for k in 0..=n {
            if k > 0 {
                arguments[n - k] = to;
            }
            points.push(self.blossom(&arguments)?);
        }
        Self::on_interval(points, (from, to))
    }

    /// The `2^levels` parts over equal intervals, from left to right; second differences of the control points shrink by 4 per level.
    ///
    /// # Errors
    ///
    /// `StepLimit` for more than 20 levels; `OutsideInterval` if the interval has no room for them.
    pub fn subdivided(&self, levels: usize) -> Result<Vec<Self>, BezierError> {
        if levels > MAX_LEVELS {
            return Err(BezierError::StepLimit {
                what: "subdivision levels",
                value: levels,
                limit: MAX_LEVELS,
            });
        }
        let mut parts = vec![self.clone()];
        for _ in 0..levels {
            let mut finer = Vec::with_capacity(2 * parts.len());
            for part in &parts {
                let (a, b) = part.interval();
                let (left, right) = part.split(a.mix(b, 0.5))?;
                finer.extend([left, right]);
            }
            parts = finer;
        }
        Ok(parts)
    }
}

/// The matrix that turns the control points of degree `n` over `[0, 1]` into those of the part over `[0, s]`: row `m` has the entries `bᵐₖ(s)`.
///
/// For `s = 1/2` these are `C(m,k)/2ᵐ`, whatever the degree. That of the part over `[s, 1]` is the one of `1 − s` with both indices reversed.
pub fn subdivision_matrix(n: usize, s: f64) -> Vec<Vec<f64>> {
    let row = |m| {
        let mut row = bernstein_values(m, s);
        row.resize(n + 1, 0.0);
        row
    };
    (0..=n).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn curves() -> impl Strategy<Value = BezierCurve<f64>> {
        (prop::collection::vec(-4.0..4.0_f64, 1..10), -2.0..2.0_f64, 0.2..3.0_f64)
            .prop_map(|(points, a, width)| BezierCurve::on_interval(points, (a, a + width)).unwrap())
    }

    fn variation(points: &[f64]) -> f64 {
        points.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
    }

    proptest! {
        #[test]
        fn parts_are_the_curve(curve in curves(), s in 0.01..0.99_f64, t in 0.0..=1.0_f64) {
            let (a, b) = curve.interval();
            let x = a.mix(b, s);
            let (left, right) = curve.split(x).unwrap();
            let n = curve.degree();
            prop_assert_eq!(left.points()[n], right.points()[0], "shared bits");
            for part in [&left, &right, &curve.restricted(a.mix(b, -0.5 * s), x).unwrap()] {
                let at = part.interval().0.mix(part.interval().1, t);
                let gap = part.evaluate(at).unwrap() - curve.evaluate(at).unwrap();
                prop_assert!(gap.abs() < 1e-11, "off by {gap}");
            }
            let (low, high) = curve.polygon_box()[0];
            prop_assert!(left.points().iter().chain(right.points()).all(|&c| low - 1e-14 <= c && c <= high + 1e-14), "hulls nest");
            prop_assert!(variation(left.points()) + variation(right.points()) <= variation(curve.points()) + 1e-12, "variation");
        }

        #[test]
        fn restrictions_compose(curve in curves(), s in prop::collection::vec(0.05..0.95_f64, 2)) {
            let (a, b) = curve.interval();
            let x = a.mix(b, s[0]);
            let (left, _) = curve.split(x).unwrap();
            let y = a.mix(x, s[1]);
            let (direct, twice) = (curve.restricted(y, x).unwrap(), left.restricted(y, x).unwrap());
            for (p, q) in direct.points().iter().zip(twice.points()) {
                prop_assert!((p - q).abs() < 1e-10, "{p} and {q}");
            }
        }

        #[test]
        fn the_matrix_makes_the_left_part(points in prop::collection::vec(-4.0..4.0_f64, 1..10), s in 0.0..=1.0_f64) {
            let curve = BezierCurve::new(points.clone()).unwrap();
            let (left, right) = curve.split_points(s).unwrap();
            let rows = subdivision_matrix(curve.degree(), s);
            let mirrored = subdivision_matrix(curve.degree(), 1.0 - s);
            for (m, row) in rows.iter().enumerate() {
                prop_assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-14, "row sum");
                let entry: f64 = row.iter().zip(&points).map(|(a, c)| a * c).sum();
                prop_assert!((entry - left[m]).abs() < 1e-13, "left, row {m}");
                let entry: f64 = mirrored[m].iter().zip(points.iter().rev()).map(|(a, c)| a * c).sum();
                prop_assert!((entry - right[curve.degree() - m]).abs() < 1e-13, "right, row {m}");
            }
        }
    }

    #[test]
    fn impossible_parts_are_refused() {
        let curve = BezierCurve::new(vec![1.0, 5.0, -2.0]).unwrap();
        assert_eq!(curve.split(0.0).unwrap_err().name(), "OutsideInterval", "at the end");
        assert_eq!(curve.split(f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(curve.restricted(0.5, 0.5).unwrap_err().name(), "EmptyInterval", "one parameter");
        assert_eq!(curve.restricted(0.0, f64::INFINITY).unwrap_err().name(), "NonFinite", "infinite");
        assert_eq!(curve.subdivided(21).unwrap_err().name(), "StepLimit", "two million pieces");
        assert_eq!(curve.subdivided(3).unwrap().len(), 8, "pieces");
    }
}
