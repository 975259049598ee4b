//! Splines `p(x) = Σ cₖ bₖ(x)` and their evaluation by de Boor's algorithm.
//!
//! For `x ∈ [ξₗ, ξₗ₊₁)`: `p⁰ₖ = cₖ` for `k = l−n … l`, then
//! `pⁱ⁺¹ₖ = γ pⁱₖ + (1 − γ) pⁱₖ₋₁` with `γ = (x − ξₖ)/(ξₖ₊ₙ₋ᵢ − ξₖ)`, and `p(x) = pⁿₗ`.
//!
//! C. de Boor, *On calculating with B-splines*, 1972. Course: section 4.5.

use crate::core::bspline::error::{Side, SplineError};
use crate::core::bspline::space::{MAX_DEGREE, SplineSpace};
use crate::core::point::Point;
use crate::core::triangular_scheme::TriangularScheme;

/// The one spline type: coefficients of any [`Point`] over an open or periodic [`SplineSpace`].
///
/// With numbers it is a spline function, with points of the plane or of space a curve.
///
/// ```
/// use spline_lab::core::bspline::{EndKnots, Side, Spline, SplineSpace};
///
/// // p(x) = x² over [0, 2]: the coefficients are the products ξₖ₊₁ ξₖ₊₂ of the inner knots of each B-spline.
/// let space = SplineSpace::from_breaks(2, &[0.0, 1.0, 2.0], EndKnots::Interpolating)?;
/// let square = Spline::new(space, vec![0.0, 0.0, 2.0, 4.0])?;
/// assert_eq!(square.evaluate(1.5)?, 2.25);
/// assert_eq!(square.derivatives(1.5, 2, Side::Right)?, [2.25, 3.0, 2.0]);
/// assert_eq!(square.insert_knot(0.5)?.evaluate(1.5)?, 2.25);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<P> {
    space: SplineSpace,
    coefficients: Vec<P>,
}

/// De Boor's scheme at one parameter, with the indices that tie it to the spline.
#[derive(Clone, Debug, PartialEq)]
pub struct DeBoorScheme<P> {
    /// Index `l` of the knot interval `[ξₗ, ξₗ₊₁)` into the evaluation knots.
    pub span: usize,
    /// The parameter, reduced into one period.
    pub parameter: f64,
    /// `coefficient[j]` is the index of the coefficient that entry `j` of level 0 holds.
    pub coefficients: Vec<usize>,
    /// The triangle; entry `j` of level `i` is `pⁱₖ` with `k = l − n + i + j`, weights are the γ.
    pub triangle: TriangularScheme<P>,
}

impl<P: Point> Spline<P> {
    /// The spline with the given coefficients, `m` of them (open) or `M` (periodic).
    ///
    /// # Errors
    ///
    /// `Empty`, `SizeMismatch`, `NonFinite` with the index of the coefficient.
    pub fn new(space: SplineSpace, coefficients: Vec<P>) -> Result<Self, SplineError> {
        if coefficients.is_empty() {
            return Err(SplineError::Empty { what: "coefficients" });
        }
        if coefficients.len() != space.dimension() {
            let (expected, found) = (space.dimension(), coefficients.len());
            return Err(SplineError::SizeMismatch { what: "coefficients", expected, found });
        }
        // Without an early exit the loop runs in vector registers.
        let fine = coefficients.iter().fold(true, |fine, point| fine & point.is_finite());
        if let Some(index) =
            (!fine).then(|| coefficients.iter().position(|point| !point.is_finite())).flatten()
        {
            let point = coefficients[index];
            let bad = (0..P::DIMENSION).map(|i| point.coordinate(i)).find(|value| !value.is_finite());
            let value = bad.unwrap_or(f64::NAN);
            return Err(SplineError::NonFinite { what: "coefficient", index, value });
        }
        Ok(Self { space, coefficients })
    }

    /// The space.
    pub fn space(&self) -> &SplineSpace {
        &self.space
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.space.degree()
    }

    /// The coefficients: numbers, or control points.
    pub fn coefficients(&self) -> &[P] {
        &self.coefficients
    }

    /// Space and coefficients.
    pub fn into_parts(self) -> (SplineSpace, Vec<P>) {
        (self.space, self.coefficients)
    }

    /// Coefficient of B-spline `k` of the evaluation knots.
    pub fn evaluation_coefficient(&self, k: usize) -> P {
        self.coefficients[self.space.coefficient_index(k)]
    }

    /// `p(x)` for `x` in D, for any `x` if periodic.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn evaluate(&self, x: f64) -> Result<P, SplineError> {
        let x = self.space.reduce(x)?;
        Ok(self.evaluate_in_span(self.space.span_of_reduced(x), x))
    }

    /// The polynomial piece over the knot interval `span` at any `x`, also outside that interval.
    ///
    /// `span` is an index into the evaluation knots as [`SplineSpace::span`] returns it.
    pub fn evaluate_in_span(&self, span: usize, x: f64) -> P {
        // With the degree a constant the loops are unrolled and nothing is cleared in vain.
        match self.degree() {
            1 => self.evaluate_degree::<2>(span, x),
            2 => self.evaluate_degree::<3>(span, x),
            3 => self.evaluate_degree::<4>(span, x),
            4 => self.evaluate_degree::<5>(span, x),
            5 => self.evaluate_degree::<6>(span, x),
            degree => {
                let mut local = self.local_coefficients(span);
                de_boor(self.space.evaluation_knots(), degree, span, x, &mut local);
                local[degree]
            }
        }
    }

    /// The value for degree `N − 1`.
    fn evaluate_degree<const N: usize>(&self, span: usize, x: f64) -> P {
        let first = span - (N - 1);
        let mut local: [P; N] = if self.space.is_periodic() {
            std::array::from_fn(|j| self.evaluation_coefficient(first + j))
        } else {
            self.coefficients[first..][..N].try_into().expect("as many as asked for")
        };
        de_boor(self.space.evaluation_knots(), N - 1, span, x, &mut local);
        local[N - 1]
    }

    /// `p, p′, …` up to the derivative of order `count`, the limits from `side` at a knot.
    ///
    /// Derivatives above the degree are zero.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn derivatives(&self, x: f64, count: usize, side: Side) -> Result<Vec<P>, SplineError> {
        let mut values = vec![P::ZERO; count + 1];
        self.derivatives_into(x, side, &mut values)?;
        Ok(values)
    }

    /// As many of `p, p′, …` as `values` has room for, as [`Self::derivatives`]; does not allocate.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `values` then stay as they are.
    pub fn derivatives_into(&self, x: f64, side: Side, values: &mut [P]) -> Result<(), SplineError> {
        let (span, x) = self.space.span_on_side(x, side)?;
        self.derivatives_in_span(span, x, values);
        Ok(())
    }

    /// As many of `p, p′, …` of the polynomial piece over the knot interval `span` as `values` has room for, at any `x`.
    pub(super) fn derivatives_in_span(&self, span: usize, x: f64, values: &mut [P]) {
        let (n, knots) = (self.degree(), self.space.evaluation_knots());
        let mut differences = self.local_coefficients(span);
        for (order, value) in values.iter_mut().enumerate() {
            if order > n {
                *value = P::ZERO;
                continue;
            }
            let degree = n - order;
            if order > 0 {
                // Entry j belongs to k = span − n + j; the new coefficients stand in entries order..=n.
                for j in (order..=n).rev() {
                    let k = span + j - n;
                    let width = knots[k + degree + 1] - knots[k];
                    differences[j] = (differences[j] - differences[j - 1]) * ((degree + 1) as f64 / width);
                }
            }
            let mut local = [P::ZERO; MAX_DEGREE + 1];
            local[..=degree].copy_from_slice(&differences[order..=n]);
            de_boor(knots, degree, span, x, &mut local);
            *value = local[degree];
        }
    }

    /// De Boor's scheme at `x` with all intermediate points and factors γ.
    ///
    /// At a knot of multiplicity μ the interval to its right is used (at the right end of D the last one).
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn de_boor_scheme(&self, x: f64) -> Result<DeBoorScheme<P>, SplineError> {
        let parameter = self.space.reduce(x)?;
        let span = self.space.span(parameter)?;
        let (n, knots) = (self.degree(), self.space.evaluation_knots());
        let points = (span - n..=span).map(|k| self.evaluation_coefficient(k)).collect();
        let triangle = TriangularScheme::run(points, n, |i, j| {
            let k = span - n + i + 1 + j;
            (parameter - knots[k]) / (knots[k + n - i] - knots[k])
        });
        let coefficients = (span - n..=span).map(|k| self.space.coefficient_index(k)).collect();
        Ok(DeBoorScheme { span, parameter, coefficients, triangle })
    }

    /// The `n + 1` coefficients that are active over the knot interval `span`, on the stack.
    fn local_coefficients(&self, span: usize) -> [P; MAX_DEGREE + 1] {
        let n = self.degree();
        let mut local = [P::ZERO; MAX_DEGREE + 1];
        for (j, slot) in local[..=n].iter_mut().enumerate() {
            *slot = self.evaluation_coefficient(span - n + j);
        }
        local
    }
}

/// De Boor's algorithm in place: `local[0..=degree]` holds `c` for `k = span − degree … span`, the value ends in `local[degree]`.
#[inline(always)]
fn de_boor<P: Point>(knots: &[f64], degree: usize, span: usize, x: f64, local: &mut [P]) {
    let (knots, local) = (&knots[span + 1 - degree..=span + degree], &mut local[..=degree]);
    for i in 0..degree {
        for j in (i + 1..=degree).rev() {
            // Entry 0 is ξₖ with k = span + 1 − degree.
            let k = j - 1;
            let gamma = (x - knots[k]) / (knots[k + degree - i] - knots[k]);
            local[j] = local[j - 1].mix(local[j], gamma);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn de_boor_reproduces_the_scheme_of_the_course() {
        let knots = vec![0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 8.0, 8.0, 9.0];
        let space = SplineSpace::new(3, knots).unwrap();
        let spline = Spline::new(space, vec![-3.0, 1.0, -5.0, 4.0, 4.0, -7.0, 9.0]).unwrap();
        let scheme = spline.de_boor_scheme(5.0).unwrap();
        assert_eq!(scheme.span, 4, "5 lies in [4, 6)");
        assert!((spline.evaluate(5.0).unwrap() - 1.0).abs() < 1e-15, "value");
        let derivatives = spline.derivatives(5.0, 4, Side::Right).unwrap();
        for (got, expected) in derivatives.iter().zip([1.0, 3.0, 0.0, -3.0, 0.0]) {
            assert!((got - expected).abs() < 1e-13, "{derivatives:?}");
        }
    }
}
