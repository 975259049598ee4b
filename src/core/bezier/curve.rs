//! Bezier curves `p(t) = Σ cₖ bₖⁿ(t)` over `0 ≤ t ≤ 1`, with `bₖⁿ(t) = C(n,k) (1 − t)ⁿ⁻ᵏ tᵏ`.
//!
//! Parameters outside `[0, 1]` extend the polynomial. Course: section 2.1.

use glam::{DVec2, DVec3};

use crate::core::bezier::error::BezierError;
use crate::core::point::Point;

/// A Bezier curve of any degree: `n + 1` control points.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::bezier::BezierCurve;
///
/// let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)];
/// let cubic = BezierCurve::new(points.map(|(x, y)| DVec2::new(x, y)).to_vec())?;
/// assert_eq!(cubic.evaluate(0.5)?, DVec2::new(2.0, 1.5));
/// # Ok::<(), spline_lab::core::bezier::BezierError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BezierCurve<P> {
    pub(super) points: Vec<P>,
}

impl<P: Point> BezierCurve<P> {
    /// The curve with these control points.
    ///
    /// # Errors
    ///
    /// `Empty`; `NonFinite` with the index of the control point.
    pub fn new(points: Vec<P>) -> Result<Self, BezierError> {
        if points.is_empty() {
            return Err(BezierError::Empty);
        }
        match points.iter().position(|point| !point.is_finite()) {
            Some(index) => Err(not_finite("control point", index, points[index])),
            None => Ok(Self { points }),
        }
    }

    /// The degree `n`.
    pub fn degree(&self) -> usize {
        self.points.len() - 1
    }

    /// The control points.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// `p(t)` by de Casteljau's algorithm; `c₀` and `cₙ` bit for bit at 0 and 1.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `t` is not finite.
    pub fn evaluate(&self, t: f64) -> Result<P, BezierError> {
        if !t.is_finite() {
            return Err(BezierError::NonFinite { what: "parameter", index: 0, value: t });
        }
        let mut row = self.points.clone();
        for step in 0..self.degree() {
            for k in 0..self.degree() - step {
                row[k] = row[k].mix(row[k + 1], t);
            }
        }
        Ok(row[0])
    }

    /// The point at `x` of the same curve run through over `[left, right]`: `t = (x − left)/(right − left)`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `EmptyInterval` unless `left < right`.
    pub fn evaluate_on(&self, left: f64, right: f64, x: f64) -> Result<P, BezierError> {
        for (index, value) in [left, right].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(BezierError::NonFinite { what: "interval end", index, value });
            }
        }
        if left >= right {
            return Err(BezierError::EmptyInterval { left, right });
        }
        self.evaluate((x - left) / (right - left))
    }

    /// The same curve, run through from its end.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { points: self.points.iter().rev().copied().collect() }
    }

    /// The coefficients of `1, t, …, tⁿ`: `aⱼ = C(n,j) Δʲc₀`.
    pub fn to_monomial(&self) -> Vec<P> {
        let n = self.degree();
        let mut differences = self.points.clone();
        let mut coefficients = Vec::with_capacity(n + 1);
        let mut binomial = 1.0;
        for j in 0..=n {
            coefficients.push(differences[0] * binomial);
            for k in 0..n - j {
                differences[k] = differences[k + 1] - differences[k];
            }
            binomial *= (n - j) as f64 / (j + 1) as f64;
        }
        coefficients
    }

    /// The curve `Σ aⱼ tʲ`: `cₖ = Σⱼ C(k,j)/C(n,j) aⱼ`, by a table of sums.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`].
    pub fn from_monomial(coefficients: &[P]) -> Result<Self, BezierError> {
        let n = coefficients.len().saturating_sub(1);
        let mut differences = coefficients.to_vec();
        let mut binomial = 1.0;
        for (j, difference) in differences.iter_mut().enumerate() {
            *difference = *difference * f64::recip(binomial);
            binomial *= (n - j) as f64 / (j + 1) as f64;
        }
        // Entry j holds Δʲc₀; summing up along the diagonals leaves the control points.
        for level in 1..=n {
            for j in (level..=n).rev() {
                differences[j] = differences[j - 1] + differences[j];
            }
        }
        Self::new(differences)
    }
}

impl BezierCurve<DVec2> {
    /// The graph of the polynomial with these Bernstein coefficients over `[0, 1]`: control points `(k/n, cₖ)`.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`].
    pub fn graph(coefficients: &[f64]) -> Result<Self, BezierError> {
        let n = coefficients.len().saturating_sub(1).max(1) as f64;
        Self::new(coefficients.iter().enumerate().map(|(k, &c)| DVec2::new(k as f64 / n, c)).collect())
    }

    /// The curve whose control points are the rows of a table of two columns.
    ///
    /// # Errors
    ///
    /// `Empty`; `SizeMismatch` with the index of the first row that is no point of the plane; `NonFinite`.
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, BezierError> {
        let point = |(index, row): (usize, &Vec<f64>)| match row[..] {
            [x, y] => Ok(DVec2::new(x, y)),
            _ => Err(BezierError::SizeMismatch { what: "control point", index, expected: 2, found: row.len() }),
        };
        Self::new(rows.iter().enumerate().map(point).collect::<Result<_, _>>()?)
    }
}

impl BezierCurve<DVec3> {
    /// As [`BezierCurve::from_rows`] of the plane, with three columns.
    ///
    /// # Errors
    ///
    /// `Empty`; `SizeMismatch` with the index of the first row that is no point of space; `NonFinite`.
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, BezierError> {
        let point = |(index, row): (usize, &Vec<f64>)| match row[..] {
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            _ => Err(BezierError::SizeMismatch { what: "control point", index, expected: 3, found: row.len() }),
        };
        Self::new(rows.iter().enumerate().map(point).collect::<Result<_, _>>()?)
    }
}

fn not_finite<P: Point>(what: &'static str, index: usize, point: P) -> BezierError {
    let bad = (0..P::DIMENSION).map(|i| point.coordinate(i)).find(|value| !value.is_finite());
    BezierError::NonFinite { what, index, value: bad.unwrap_or(f64::NAN) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The definition: the sum of the Bernstein polynomials.
    fn by_definition(points: &[f64], t: f64) -> f64 {
        let n = points.len() - 1;
        let mut binomial = 1.0;
        let mut sum = 0.0;
        for (k, &c) in points.iter().enumerate() {
            sum += c * binomial * (1.0 - t).powi((n - k) as i32) * t.powi(k as i32);
            binomial *= (n - k) as f64 / (k + 1) as f64;
        }
        sum
    }

    proptest! {
        #[test]
        fn de_casteljau_is_the_bernstein_sum(points in prop::collection::vec(-10.0..10.0_f64, 1..14), t in 0.0..=1.0_f64) {
            let got = BezierCurve::new(points.clone()).unwrap().evaluate(t).unwrap();
            prop_assert!((got - by_definition(&points, t)).abs() < 1e-12, "{got} at {t}");
        }

        #[test]
        fn monomial_form_and_back_is_the_identity(points in prop::collection::vec(-10.0..10.0_f64, 1..10)) {
            let curve = BezierCurve::new(points.clone()).unwrap();
            let back = BezierCurve::from_monomial(&curve.to_monomial()).unwrap();
            for (got, expected) in back.points().iter().zip(&points) {
                prop_assert!((got - expected).abs() < 1e-9, "{got} is not {expected}");
            }
        }

        #[test]
        fn the_reversed_curve_at_one_minus_t_is_the_curve(points in prop::collection::vec(-10.0..10.0_f64, 1..14), t in 0.0..=1.0_f64) {
            let curve = BezierCurve::new(points).unwrap();
            let difference = curve.evaluate(t).unwrap() - curve.reversed().evaluate(1.0 - t).unwrap();
            prop_assert!(difference.abs() < 1e-12, "{difference} at {t}");
        }
    }

    #[test]
    fn the_ends_are_the_end_points_bit_for_bit() {
        let curve = BezierCurve::new(vec![0.1, 0.7, 0.3]).unwrap();
        assert_eq!(curve.evaluate(0.0).unwrap().to_bits(), 0.1_f64.to_bits(), "t = 0");
        assert_eq!(curve.evaluate(1.0).unwrap().to_bits(), 0.3_f64.to_bits(), "t = 1");
    }

    #[test]
    fn rows_of_the_wrong_length_are_named() {
        let rows = [vec![0.0, 0.0], vec![1.0, 2.0, 3.0]];
        let error = BezierCurve::<DVec2>::from_rows(&rows).unwrap_err();
        assert_eq!(error.to_string(), "control point 1 has 3 entries, 2 needed", "the second row");
    }
}
