//! Products of polynomials in Bernstein form.
//!
//! `bᵐᵢ bⁿⱼ = C(m,i) C(n,j)/C(m+n,i+j) bᵐ⁺ⁿᵢ₊ⱼ`: every coefficient of a product is a convex combination of products of
//! coefficients, with the weights of the hypergeometric distribution. Course: section 1.5.

use crate::core::point::Point;
use crate::core::polynomial::error::{PolynomialError, check_coefficients, check_finite};

/// The `m + n + 1` coefficients of the product of polynomials with `m + 1` coefficients `a` and `n + 1` coefficients `b`.
///
/// # Errors
///
/// `Empty`, `NonFinite` (also where a product overflows).
///
/// ```
/// use spline_lab::core::polynomial::bernstein_product;
///
/// let square = bernstein_product(&[1.0, -1.0], &[1.0, -1.0]).unwrap(); // (1 − 2t)²
/// assert_eq!(square, [1.0, -1.0, 1.0]);
/// ```
pub fn bernstein_product<P: Point>(a: &[f64], b: &[P]) -> Result<Vec<P>, PolynomialError> {
    check_coefficients(a)?;
    check_coefficients(b)?;
    let product = product_by(a, b, |x, y| y * x);
    check_finite("coefficient", &product)?;
    Ok(product)
}

/// The coefficients of any bilinear product of two polynomials with coefficients `a` and `b`, such as a dot product of curves.
pub(in crate::core) fn product_by<A: Point, B: Point, P: Point>(
    a: &[A],
    b: &[B],
    times: impl Fn(A, B) -> P,
) -> Vec<P> {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let mut weights = Vec::with_capacity(m.min(n) + 1);
    let coefficient = |k| {
        let first = write_weights(m, n, k, &mut weights);
        let terms = weights.iter().zip(first..);
        terms.fold(P::ZERO, |sum, (&weight, i)| sum + times(a[i], b[k - i]) * weight)
    };
    (0..=m + n).map(coefficient).collect()
}

/// The integrals `∫ bⁿᵢ bⁿⱼ = C(n,i) C(n,j)/((2n + 1) C(2n,i+j))` over `[0, 1]`.
pub fn bernstein_gram(n: usize) -> Vec<Vec<f64>> {
    let mut gram = vec![vec![0.0; n + 1]; n + 1];
    let mut weights = Vec::new();
    for k in 0..=2 * n {
        let first = write_weights(n, n, k, &mut weights);
        for (weight, i) in weights.iter().zip(first..) {
            gram[i][k - i] = weight / (2 * n + 1) as f64;
        }
    }
    gram
}

/// Writes `C(m,i) C(n,k−i)/C(m+n,k)` for all `i` with both binomials positive, and returns the first such `i`.
///
/// The ratios of neighbours start from the largest weight, and the sum is 1: no binomial is formed, none overflows.
fn write_weights(m: usize, n: usize, k: usize, weights: &mut Vec<f64>) -> usize {
    let (first, last) = (k.saturating_sub(n), k.min(m));
    let mode = ((k + 1) * (m + 1) / (m + n + 2)).clamp(first, last);
    let step = |i: usize| ((m - i) * (k - i)) as f64 / ((i + 1) * (n + i + 1 - k)) as f64;
    weights.clear();
    weights.resize(last - first + 1, 1.0);
    for i in mode..last {
        weights[i + 1 - first] = weights[i - first] * step(i);
    }
    for i in (first..mode).rev() {
        weights[i - first] = weights[i + 1 - first] / step(i);
    }
    let sum: f64 = weights.iter().sum();
    for weight in weights {
        *weight /= sum;
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::polynomial::bernstein_values;
    use crate::core::triangular_scheme::collapse;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn products_are_pointwise(
            a in prop::collection::vec(-2.0..2.0_f64, 1..12), b in prop::collection::vec(-2.0..2.0_f64, 1..12), x in 0.0..=1.0_f64,
        ) {
            let product = collapse(&mut bernstein_product(&a, &b).unwrap(), x);
            let pointwise = collapse(&mut a.clone(), x) * collapse(&mut b.clone(), x);
            prop_assert!((product - pointwise).abs() < 1e-13, "{product} and {pointwise}");
        }
    }

    #[test]
    fn the_gram_matrix_is_that_of_the_integrals() {
        let rule = crate::core::quadrature::gauss_legendre(12).unwrap();
        for n in 0..=9 {
            let gram = bernstein_gram(n);
            for i in 0..=n {
                for j in 0..=n {
                    let integral = rule.integrate(0.0, 1.0, |x| {
                        let values = bernstein_values(n, x);
                        values[i] * values[j]
                    });
                    assert!((gram[i][j] - integral).abs() < 1e-14, "{n}: {i}, {j}");
                }
            }
        }
    }

    #[test]
    fn high_degrees_do_not_overflow() {
        let product = bernstein_product(&vec![1.0; 801], &vec![2.0; 701]).unwrap();
        assert!(product.iter().all(|c| (c - 2.0).abs() < 1e-12), "the product of constants");
        assert_eq!(bernstein_product::<f64>(&[], &[1.0]).unwrap_err().name(), "Empty", "no factor");
        assert_eq!(bernstein_product(&[1e200], &[1e200]).unwrap_err().name(), "NonFinite", "overflow");
    }
}
