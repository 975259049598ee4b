//! Smoothness of one B-spline at its knots, its zeros at the ends of the support, and its integral.
//!
//! At a knot of multiplicity `μ ≤ n` among its own knots a B-spline of degree `n` is exactly `n − μ` times continuously
//! differentiable; it jumps where `μ = n + 1`. At the left end of the support it starts like
//!
//! ```text
//! β (x − ξₖ)ⁿ⁺¹⁻ᵘ,   β = C(n, μ − 1) / ∏ (ξₖ₊ᵢ − ξₖ)   over 1 ≤ i ≤ n with ξₖ₊ᵢ > ξₖ,   u = μ,
//! ```
//!
//! and mirrored at the right end. Course: section 4.2.

use crate::core::bspline::basis::check_knots;
use crate::core::bspline::error::{Side, SplineError};

/// A distinct knot of a B-spline and how smooth the B-spline is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnotSmoothness {
    /// The knot.
    pub knot: f64,
    /// How often it stands among the knots of the B-spline.
    pub multiplicity: usize,
    /// Number of continuous derivatives, `n − μ`; −1 for a jump.
    pub order: isize,
}

/// `coefficient·|x − end|^order`, how a B-spline leaves 0 at an end of its support.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadingTerm {
    /// Order of the zero.
    pub order: usize,
    /// The positive factor.
    pub coefficient: f64,
}

/// Smoothness at every distinct knot, from left to right.
///
/// # Errors
///
/// As [`super::basis_function`]; `Degenerate` if all knots are equal, so that the B-spline is 0.
pub fn basis_smoothness(degree: usize, knots: &[f64]) -> Result<Vec<KnotSmoothness>, SplineError> {
    check_nonempty(degree, knots)?;
    let smoothness = |run: &[f64]| KnotSmoothness {
        knot: run[0],
        multiplicity: run.len(),
        order: degree as isize - run.len() as isize,
    };
    Ok(knots.chunk_by(|a, b| a >= b).map(smoothness).collect())
}

/// The leading term at the left or the right end of the support.
///
/// # Errors
///
/// As [`basis_smoothness`].
pub fn basis_leading_term(degree: usize, knots: &[f64], side: Side) -> Result<LeadingTerm, SplineError> {
    check_nonempty(degree, knots)?;
    let widths: Vec<f64> = match side {
        Side::Left => knots[1..=degree].iter().map(|knot| knot - knots[0]).collect(),
        Side::Right => knots[1..=degree].iter().map(|knot| knots[degree + 1] - knot).collect(),
    };
    let copies = widths.iter().filter(|&&width| width <= 0.0).count();
    let binomial = (0..copies).fold(1.0, |value, i| value * (degree - i) as f64 / (i + 1) as f64);
    let product: f64 = widths.iter().filter(|&&width| width > 0.0).product();
    Ok(LeadingTerm { order: degree - copies, coefficient: binomial / product })
}

/// `∫ bⁿ = (ξₙ₊₁ − ξ₀)/(n + 1)` over the whole support.
///
/// # Errors
///
/// As [`super::basis_function`].
pub fn basis_integral(degree: usize, knots: &[f64]) -> Result<f64, SplineError> {
    check_knots(degree, knots)?;
    Ok((knots[degree + 1] - knots[0]) / (degree + 1) as f64)
}

fn check_nonempty(degree: usize, knots: &[f64]) -> Result<(), SplineError> {
    check_knots(degree, knots)?;
    if knots[0] < knots[degree + 1] {
        return Ok(());
    }
    Err(SplineError::Degenerate { what: "a B-spline with equal knots", parameter: knots[0] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{basis_derivative, basis_function};
    use crate::core::quadrature::gauss_legendre;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn ends_and_integral_are_those_of_the_values(gaps in prop::collection::vec(0_u8..3, 2..9)) {
            let mut knots = vec![0.0];
            for gap in &gaps {
                knots.push(knots[knots.len() - 1] + f64::from(*gap));
            }
            let (degree, end) = (gaps.len() - 1, knots[gaps.len()]);
            if end <= 0.0 {
                prop_assert_eq!(basis_smoothness(degree, &knots).unwrap_err().name(), "Degenerate", "zero");
                return Ok(());
            }
            let rule = gauss_legendre(degree + 1).unwrap();
            let area: f64 = knots
                .windows(2)
                .map(|pair| rule.integrate(pair[0], pair[1], |x| basis_function(degree, &knots, x).unwrap()))
                .sum();
            prop_assert!((area - basis_integral(degree, &knots).unwrap()).abs() < 1e-12, "integral {area}");
            for (side, x, inside) in [(Side::Left, 0.0, Side::Right), (Side::Right, end, Side::Left)] {
                let term = basis_leading_term(degree, &knots, side).unwrap();
                let factorial: f64 = (1..=term.order).map(|i| i as f64).product();
                for order in 0..=term.order {
                    let value = basis_derivative(degree, &knots, x, order, inside).unwrap();
                    let expected = if order < term.order { 0.0 } else { term.coefficient * factorial };
                    let error = value.abs() - expected;
                    prop_assert!(error.abs() < 1e-9 * expected.max(1.0), "order {order} at {x}: {value}, {expected}");
                }
            }
        }
    }
}
