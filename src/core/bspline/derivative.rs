//! Derivatives of splines as splines, and as sums of B-splines where continuity is lost.
//!
//! `p′ = Σ dₖ bⁿ⁻¹ₖ` with `dₖ = n (cₖ − cₖ₋₁)/(ξₖ₊ₙ − ξₖ)`, over the knots without the first and the last.
//! Course: sections 4.2 and 4.5.

use crate::core::bspline::error::{Side, SplineError};
use crate::core::bspline::space::{MAX_DEGREE, SplineSpace, check_nondecreasing};
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

/// `Σ cₖ bⁿₖ` over any nondecreasing knots, of degree 0 or more; it may jump.
///
/// The value over a knot interval is that of the polynomial piece, with an explicit side at the knots.
#[derive(Clone, Debug, PartialEq)]
pub struct BSplineSum<P> {
    degree: usize,
    knots: Vec<f64>,
    coefficients: Vec<P>,
}

impl<P: Point> BSplineSum<P> {
    /// The sum with the given coefficients over `knots`, `degree + 1` more than coefficients and in nondecreasing order.
    ///
    /// # Errors
    ///
    /// `Empty`, `StepLimit` for the degree, `SizeMismatch`, `NonFinite`, `KnotsDecreasing`; `KnotsNotRegular` if `[ξₙ, ξₘ]` is empty.
    pub fn new(degree: usize, knots: Vec<f64>, coefficients: Vec<P>) -> Result<Self, SplineError> {
        let m = coefficients.len();
        if m == 0 {
            return Err(SplineError::Empty { what: "coefficients" });
        }
        if degree > MAX_DEGREE {
            return Err(SplineError::StepLimit { what: "degree", value: degree, limit: MAX_DEGREE });
        }
        if knots.len() != m + degree + 1 {
            let (expected, found) = (m + degree + 1, knots.len());
            return Err(SplineError::SizeMismatch { what: "knots", expected, found });
        }
        check_nondecreasing(&knots)?;
        if let Some(index) = coefficients.iter().position(|point| !point.is_finite()) {
            return Err(SplineError::NonFinite { what: "coefficient", index, value: f64::NAN });
        }
        if m <= degree || knots[degree] >= knots[m] {
            let value = knots[degree.min(m)];
            return Err(SplineError::KnotsNotRegular { side: None, value, dimension: m, degree });
        }
        Ok(Self { degree, knots, coefficients })
    }

    /// The derivative, of degree `n − 1`; zero of degree 0 if this is a sum of degree 0. A B-spline with empty support gets
    /// the coefficient 0.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let (n, m, knots) = (self.degree, self.coefficients.len(), &self.knots);
        if n == 0 {
            return Self { degree: 0, knots: knots.clone(), coefficients: vec![P::ZERO; m] };
        }
        let difference = |k: usize| {
            let width = knots[k + n] - knots[k];
            let step = self.coefficients[k] - self.coefficients[k - 1];
            if width > 0.0 { step * (n as f64 / width) } else { P::ZERO }
        };
        let coefficients = (1..m).map(difference).collect();
        Self { degree: n - 1, knots: knots[1..knots.len() - 1].to_vec(), coefficients }
    }

    /// The sum with the given parts: `degree + 1` more nondecreasing knots than coefficients, the caller's duty.
    pub(crate) fn from_parts(degree: usize, knots: Vec<f64>, coefficients: Vec<P>) -> Self {
        Self { degree, knots, coefficients }
    }

    /// The degree, 0 or more.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The knots, `degree + 1` more than coefficients.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The coefficients.
    pub fn coefficients(&self) -> &[P] {
        &self.coefficients
    }

    /// The value at `x` in `[ξₙ, ξₘ]`, the limit from `side` at a knot; at an end of the interval the only limit.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn evaluate(&self, x: f64, side: Side) -> Result<P, SplineError> {
        if !x.is_finite() {
            return Err(SplineError::NonFinite { what: "parameter", index: 0, value: x });
        }
        let (n, m) = (self.degree, self.coefficients.len());
        let (left, right) = (self.knots[n], self.knots[m]);
        if !(left..=right).contains(&x) {
            return Err(SplineError::OutsideInterval { value: x, left, right });
        }
        let inner = &self.knots[n..=m];
        let after = match side {
            Side::Right if x < right => inner.partition_point(|&knot| knot <= x),
            Side::Left if x > left => inner.partition_point(|&knot| knot < x),
            Side::Left => inner.partition_point(|&knot| knot <= left),
            Side::Right => inner.partition_point(|&knot| knot < right),
        };
        let span = n + after - 1;
        let mut local = self.coefficients[span - n..=span].to_vec();
        for i in 0..n {
            for j in (i + 1..=n).rev() {
                let k = span + j - n;
                let gamma = (x - self.knots[k]) / (self.knots[k + n - i] - self.knots[k]);
                local[j] = local[j - 1].mix(local[j], gamma);
            }
        }
        Ok(local[n])
    }
}

impl<P: Point> Spline<P> {
    /// The derivative as a sum of B-splines of degree `n − 1` over D, or over one period; it always exists.
    ///
    /// The coefficient of a B-spline with empty support is 0.
    pub fn derivative_sum(&self) -> BSplineSum<P> {
        let space = self.space();
        let coefficients =
            (0..space.evaluation_dimension()).map(|k| self.evaluation_coefficient(k)).collect();
        BSplineSum { degree: self.degree(), knots: space.evaluation_knots().to_vec(), coefficients }
            .derivative()
    }

    /// The derivative as a spline of degree `n − 1`, periodic if this one is.
    ///
    /// An end of D that is `n`-fold stays end-interpolating: its outermost knot moves one length of the adjacent interval outside.
    ///
    /// # Errors
    ///
    /// `NotInSpace` for degree 1 and where an inner knot is `n`-fold; use [`Self::derivative_sum`] then.
    pub fn derivative(&self) -> Result<Self, SplineError> {
        let (n, space) = (self.degree(), self.space());
        if n == 1 {
            let reason = "the derivative of a spline of degree 1 is piecewise constant".to_owned();
            return Err(SplineError::NotInSpace { reason });
        }
        let (left, right) = space.parameter_interval();
        let jump = space.distinct_knots().into_iter().find(|knot| {
            let inner = space.is_periodic() || (left < knot.value && knot.value < right);
            inner && knot.multiplicity >= n
        });
        if let Some(knot) = jump {
            let reason = format!("the derivative jumps at the {n}-fold knot {}", knot.value);
            return Err(SplineError::NotInSpace { reason });
        }
        if let Some(period) = space.period() {
            let count = space.dimension();
            let difference = |k: usize| {
                let (low, high) = space.support_of_degree(k, n - 1);
                let step = self.coefficients()[k] - self.coefficients()[(k + count - 1) % count];
                step * (n as f64 / (high - low))
            };
            let coefficients = (0..count).map(difference).collect();
            let space = SplineSpace::periodic(n - 1, period, space.knots().to_vec())?;
            return Self::new(space, coefficients);
        }
        let BSplineSum { mut knots, coefficients, .. } = self.derivative_sum();
        let (m, last) = (coefficients.len(), knots.len() - 1);
        if knots[0] >= left {
            knots[0] = left - (knots[n] - left);
        }
        if knots[last] <= right {
            knots[last] = right + (right - knots[m - 1]);
        }
        Self::new(SplineSpace::new(n - 1, knots)?, coefficients)
    }
}

impl SplineSpace {
    /// `(ξₖ, ξₖ₊ᵢ₊₁)` for `i = degree`.
    fn support_of_degree(&self, k: usize, degree: usize) -> (f64, f64) {
        let at = |k: usize| self.knot(k as isize).unwrap_or(f64::NAN);
        (at(k), at(k + degree + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivative_agrees_with_derivatives_of_the_pieces() {
        let open = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 4.0, 5.0, 5.5, 7.0]).unwrap();
        let closed = SplineSpace::periodic(3, 4.0, vec![0.0, 0.0, 1.0, 3.0]).unwrap();
        for space in [open, closed] {
            let coefficients = (0..space.dimension()).map(|k| (k * k % 5) as f64 - 1.0).collect();
            let spline = Spline::new(space, coefficients).unwrap();
            let (derivative, sum) = (spline.derivative().unwrap(), spline.derivative_sum());
            let (left, right) = spline.space().parameter_interval();
            for i in 0..=40 {
                let x = left.mix(right, f64::from(i) / 40.0);
                let expected = spline.derivatives(x, 1, Side::Right).unwrap()[1];
                let found = derivative.evaluate(x).unwrap();
                assert!((found - expected).abs() < 1e-12, "x = {x}: {found} and {expected}");
                let found = sum.evaluate(x, Side::Left).unwrap();
                assert!((found - expected).abs() < 1e-12, "sum, x = {x}: {found} and {expected}");
            }
        }
    }

    #[test]
    fn a_corner_gives_a_sum_with_two_limits_but_no_spline() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let spline = Spline::new(space, vec![0.0, 1.0, 2.0, 2.0, 0.0]).unwrap();
        assert_eq!(spline.derivative().unwrap_err().name(), "NotInSpace", "double knot of degree 2");
        let sum = spline.derivative_sum();
        assert_eq!(sum.evaluate(1.0, Side::Left), Ok(2.0), "from the left");
        assert_eq!(sum.evaluate(1.0, Side::Right), Ok(0.0), "from the right");
    }
}
