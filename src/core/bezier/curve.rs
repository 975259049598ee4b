//! Bezier curves `p(x) = Σ cₖ bⁿₖ(t)`, `t = (x − a)/(b − a)`, with the Bernstein polynomials `bⁿₖ(t) = C(n,k) (1 − t)ⁿ⁻ᵏ tᵏ`.
//!
//! The degree is `n = number of control points − 1` and may be 0. Parameters outside `[a, b]` are legal and extrapolate.
//! Course: section 2.1.

use glam::DVec2;

use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::polynomial::bernstein_from_monomial;
use crate::core::triangular_scheme::collapse;

/// A polynomial curve over an interval, given by its control polygon.
///
/// Affine maps of the control points map the curve, it lies in the convex hull of the control points, begins in the first and
/// ends in the last one with the tangents `n (c₁ − c₀)/(b − a)` and `n (cₙ − cₙ₋₁)/(b − a)`. P. Bézier 1962, P. de Casteljau 1959.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::bezier::BezierCurve;
///
/// let points = [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]].map(DVec2::from).to_vec();
/// let curve = BezierCurve::new(points)?;
/// assert_eq!(curve.evaluate(0.5)?, DVec2::new(2.0, 1.5));
/// assert_eq!(curve.derivatives(0.25, 1)?[1], DVec2::new(4.125, 3.0));
/// let (left, right) = curve.split(0.25)?;
/// assert_eq!(left.points()[3], right.points()[0]);
/// # Ok::<(), spline_lab::core::bezier::BezierError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BezierCurve<P> {
    pub(super) points: Vec<P>,
    interval: (f64, f64),
}

impl<P: Point> BezierCurve<P> {
    /// The curve over `[0, 1]`.
    ///
    /// # Errors
    ///
    /// `Empty`; `NonFinite` with the index of the control point.
    pub fn new(points: Vec<P>) -> Result<Self, BezierError> {
        Self::on_interval(points, (0.0, 1.0))
    }

    /// The curve over `[a, b]`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; `NonFinite` for an end of the interval (index 0 or 1), `EmptyInterval` unless `a < b`.
    pub fn on_interval(points: Vec<P>, interval: (f64, f64)) -> Result<Self, BezierError> {
        if points.is_empty() {
            return Err(BezierError::Empty { what: "control points" });
        }
        if let Some(index) = points.iter().position(|point| !point.is_finite()) {
            let bad = (0..P::DIMENSION).map(|i| points[index].coordinate(i)).find(|value| !value.is_finite());
            let value = bad.unwrap_or(f64::NAN);
            return Err(BezierError::NonFinite { what: "control point", index, value });
        }
        for (index, value) in [interval.0, interval.1].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(BezierError::NonFinite { what: "end", index, value });
            }
        }
        if interval.0 >= interval.1 {
            return Err(BezierError::EmptyInterval { left: interval.0, right: interval.1 });
        }
        Ok(Self { points, interval })
    }

    /// The curve `Σ coefficients[j]·tʲ` over `[0, 1]`, constant coefficient first: `cₖ = Σⱼ C(k,j)/C(n,j) aⱼ`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn from_monomial(coefficients: &[P]) -> Result<Self, BezierError> {
        Self::new(bernstein_from_monomial(coefficients, (0.0, 1.0))?)
    }

    /// The control points, at least one.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// The interval `(a, b)`, `a < b`.
    pub fn interval(&self) -> (f64, f64) {
        self.interval
    }

    /// The degree, one less than the number of control points.
    pub fn degree(&self) -> usize {
        self.points.len() - 1
    }

    /// `p(x)` by de Casteljau's algorithm; at `a` and `b` the end points bit for bit.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn evaluate(&self, x: f64) -> Result<P, BezierError> {
        let t = self.local_parameter(x)?;
        Ok(collapse(&mut self.points.clone(), t))
    }

    /// Writes the points at the parameters `xs` into `values`; one allocation for all of them.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there is a place for each parameter; `NonFinite` with the index of the parameter.
    pub fn write_values(&self, xs: &[f64], values: &mut [P]) -> Result<(), BezierError> {
        let (expected, found) = (xs.len(), values.len());
        if expected != found {
            return Err(BezierError::SizeMismatch { what: "places for values", expected, found });
        }
        let mut scratch = self.points.clone();
        for (index, (&x, value)) in xs.iter().zip(values).enumerate() {
            let t = self.local_parameter(x).map_err(|_| BezierError::NonFinite {
                what: "parameter",
                index,
                value: x,
            })?;
            scratch.copy_from_slice(&self.points);
            *value = collapse(&mut scratch, t);
        }
        Ok(())
    }

    /// The curve with every control point mapped; an affine map maps every point of the curve alike.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the index of the first control point that is mapped to no point.
    pub fn transformed<Q: Point>(&self, map: impl Fn(P) -> Q) -> Result<BezierCurve<Q>, BezierError> {
        BezierCurve::on_interval(self.points.iter().map(|&point| map(point)).collect(), self.interval)
    }

    /// Largest difference of a coordinate of two control points: the size that tolerances refer to.
    pub fn extent(&self) -> f64 {
        self.polygon_box().into_iter().map(|(low, high)| high - low).fold(0.0, f64::max)
    }

    /// Coefficients of `1, t, t², …` with `t = (x − a)/(b − a)`: `C(n,j) Δʲc₀`.
    pub fn monomial(&self) -> Vec<P> {
        let n = self.degree();
        let mut differences = self.points.clone();
        for j in 1..=n {
            for k in (j..=n).rev() {
                differences[k] = differences[k] - differences[k - 1];
            }
        }
        let mut factor = 1.0;
        for (j, difference) in differences.iter_mut().enumerate() {
            *difference = *difference * factor;
            factor *= (n - j) as f64 / (j + 1) as f64;
        }
        differences
    }

    /// The same points of the curve in the opposite direction, over the same interval.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { points: self.points.iter().rev().copied().collect(), interval: self.interval }
    }

    /// `(x − a)/(b − a)`, exactly 0 and 1 at the ends.
    pub(super) fn local_parameter(&self, x: f64) -> Result<f64, BezierError> {
        if !x.is_finite() {
            return Err(BezierError::NonFinite { what: "parameter", index: 0, value: x });
        }
        Ok((x - self.interval.0) / (self.interval.1 - self.interval.0))
    }

    /// The same interval with other control points, not fewer than one.
    pub(super) fn with_points(&self, points: Vec<P>) -> Self {
        Self { points, interval: self.interval }
    }
}

impl BezierCurve<DVec2> {
    /// The graph of a polynomial with Bernstein coefficients `cₖ`: control points `(a + k (b − a)/n, cₖ)`.
    ///
    /// # Errors
    ///
    /// Those of [`BezierCurve::on_interval`]; `SizeMismatch` for a single coefficient, whose graph is no curve of degree 0.
    pub fn graph(coefficients: &[f64], interval: (f64, f64)) -> Result<Self, BezierError> {
        if coefficients.len() == 1 {
            return Err(BezierError::SizeMismatch { what: "Bernstein coefficients", expected: 2, found: 1 });
        }
        let n = coefficients.len().saturating_sub(1) as f64;
        let at = |k: usize| interval.0.mix(interval.1, k as f64 / n);
        let points = coefficients.iter().enumerate().map(|(k, &c)| DVec2::new(at(k), c)).collect();
        Self::on_interval(points, interval)
    }

    /// The curve over `[0, 1]` whose control points are the rows of a table.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for the first row that has not two entries; those of [`BezierCurve::new`].
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, BezierError> {
        let mut points = Vec::with_capacity(rows.len());
        for row in rows {
            let &[x, y] = row.as_slice() else {
                return Err(BezierError::SizeMismatch {
                    what: "coordinates of a point",
                    expected: 2,
                    found: row.len(),
                });
            };
            points.push(DVec2::new(x, y));
        }
        Self::new(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::polynomial::bernstein_values;
    use proptest::prelude::*;

    #[test]
    fn monomial_form_goes_there_and_back() {
        for n in 0..=12_u32 {
            let points: Vec<f64> = (0..=n).map(|k| f64::from(k * k % 7) - 2.0).collect();
            let curve = BezierCurve::new(points.clone()).unwrap();
            let back = BezierCurve::from_monomial(&curve.monomial()).unwrap();
            for (a, b) in back.points().iter().zip(&points) {
                assert!((a - b).abs() < 1e-10, "degree {n}: {a} and {b}");
            }
        }
    }

    #[test]
    fn the_graph_of_a_polynomial_has_it_as_height() {
        let graph = BezierCurve::graph(&[2.0, 1.0, 0.0, -2.0], (1.0, 3.0)).unwrap();
        let height = BezierCurve::on_interval(vec![2.0, 1.0, 0.0, -2.0], (1.0, 3.0)).unwrap();
        for i in 0..=8 {
            let x = 1.0 + 0.25 * f64::from(i);
            let point = graph.evaluate(x).unwrap();
            assert!((point.x - x).abs() < 1e-15, "the parameter is the abscissa: {point}");
            assert_eq!(point.y, height.evaluate(x).unwrap(), "height at {x}");
        }
    }

    proptest! {
        #[test]
        fn the_curve_is_the_bernstein_sum(
            a in prop::collection::vec(-4.0..4.0_f64, 1..30), b in prop::collection::vec(-4.0..4.0_f64, 30), t in 0.0..=1.0_f64,
        ) {
            let value = |points: Vec<f64>| BezierCurve::new(points).unwrap().evaluate(t).unwrap();
            let n = a.len() - 1;
            let sum: f64 = bernstein_values(n, t).iter().zip(&a).map(|(b, c)| b * c).sum();
            let p = value(a.clone());
            let unit = 4.0 * (n + 1) as f64 * f64::EPSILON * 4.0;
            prop_assert!((p - sum).abs() <= unit, "{p} and {sum}");
            let combined = value(a.iter().zip(&b).map(|(a, b)| a + 2.0 * b).collect());
            let q = value(b[..=n].to_vec());
            prop_assert!((combined - p - 2.0 * q).abs() <= 4.0 * unit, "linear in the points");
            let moved = value(a.iter().map(|a| a + 3.0).collect());
            prop_assert!((moved - p - 3.0).abs() <= 4.0 * unit, "translation");
            let line = value((0..=n).map(|k| 1.0 + 5.0 * k as f64 / n.max(1) as f64).collect());
            prop_assert!(n == 0 || (line - 1.0 - 5.0 * t).abs() <= 4.0 * unit, "equal steps run evenly");
        }
    }

    #[test]
    fn many_values_at_once_are_the_values_one_by_one() {
        let curve = BezierCurve::on_interval(vec![1.0, 5.0, -2.0], (1.0, 3.0)).unwrap();
        let mut values = [0.0; 3];
        curve.write_values(&[1.0, 1.7, 3.0], &mut values).unwrap();
        assert_eq!(values, [1.0, 1.7, 3.0].map(|x| curve.evaluate(x).unwrap()), "bit for bit");
        assert_eq!(curve.write_values(&[1.0], &mut values).unwrap_err().name(), "SizeMismatch", "places");
        let nan = curve.write_values(&[1.0, f64::NAN, 2.0], &mut values);
        assert!(matches!(nan, Err(BezierError::NonFinite { index: 1, .. })), "{nan:?}");
    }

    #[test]
    fn the_reversed_curve_mirrors_the_parameter() {
        let curve = BezierCurve::new(vec![1.0, 5.0, -2.0]).unwrap();
        assert_eq!(curve.reversed().evaluate(0.25), curve.evaluate(0.75), "1 − t");
    }

    #[test]
    fn invalid_curves_are_named() {
        let name =
            |points: Vec<f64>, interval| BezierCurve::on_interval(points, interval).unwrap_err().name();
        assert_eq!(name(Vec::new(), (0.0, 1.0)), "Empty", "no points");
        assert_eq!(name(vec![1.0, f64::NAN], (0.0, 1.0)), "NonFinite", "NaN");
        assert_eq!(name(vec![1.0], (1.0, 1.0)), "EmptyInterval", "one parameter");
    }
}
