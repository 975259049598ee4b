//! The best uniform degree reduction of one Bezier curve.
//!
//! With the `n`-th difference `a` of the control points, the leading coefficient, the best approximation of degree `n − 1` over `[0, 1]` is
//! `p − a E` with the monic polynomial `E` of least maximum: Chebyshev's, `E = 2¹⁻²ⁿ Tₙ(2t − 1)`, if the ends are free; if they are kept,
//! `E = 2¹⁻²ⁿ γ⁻ⁿ Tₙ(γ(2t − 1))` with `γ = cos(π/(2n))`, whose outermost zeros are the ends.
//! Bernstein coefficients of `Tₙ(2t − 1)` are `(−1)ⁿ⁻ʲ C(2n, 2j)/C(n, j)`. Course: beyond, section B.1.

use crate::core::bspline::SplineError;
use crate::core::point::Point;
use crate::core::spline_curve::ReductionEnds;

/// A Bezier curve of one degree less.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformReduction<P> {
    /// Its `n` control points.
    pub points: Vec<P>,
    /// The largest distance of both curves at equal parameters, the smallest possible one.
    pub error: f64,
}

/// The curve of degree `n − 1` that is uniformly nearest to the Bezier curve with the given `n + 1` control points.
///
/// ```
/// # use spline_lab::core::spline_curve::{ReductionEnds, reduce_uniformly};
/// let reduction = reduce_uniformly(&[0.0, 0.0, 0.0, 1.0], ReductionEnds::Free)?;
/// assert!((reduction.error - 1.0 / 32.0).abs() < 1e-16);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
///
/// # Errors
///
/// `Empty`; `DegreeZero` for one or two points; `NonFinite`.
pub fn reduce_uniformly<P: Point>(
    points: &[P],
    ends: ReductionEnds,
) -> Result<UniformReduction<P>, SplineError> {
    if points.is_empty() {
        return Err(SplineError::Empty { what: "control points" });
    }
    let n = points.len() - 1;
    if n <= 1 {
        return Err(SplineError::DegreeZero);
    }
    if let Some(index) = points.iter().position(|point| !point.is_finite()) {
        return Err(SplineError::NonFinite { what: "control point", index, value: f64::NAN });
    }
    let mut difference = points.to_vec();
    while difference.len() > 1 {
        difference = difference.windows(2).map(|pair| pair[1] - pair[0]).collect();
    }
    // C(2n, 2j)/C(n, j) = ∏ (2n − 2i − 1)/(2i + 1) over i < j.
    let mut chebyshev = Vec::with_capacity(n + 1);
    let mut size = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    for j in 0..=n {
        chebyshev.push(size);
        size *= -((2 * n) as f64 - (2 * j) as f64 - 1.0) / (2 * j + 1) as f64;
    }
    let mut amplitude = 2.0 * 0.25_f64.powi(n as i32);
    if ends == ReductionEnds::Fixed {
        let gamma = (std::f64::consts::FRAC_PI_2 / n as f64).cos();
        chebyshev = restricted(chebyshev, 0.5 * (1.0 - gamma), 0.5 * (1.0 + gamma));
        // Exactly 0, so that the ends keep their bits.
        (chebyshev[0], chebyshev[n]) = (0.0, 0.0);
        amplitude /= gamma.powi(n as i32);
    }
    let rest: Vec<P> =
        points.iter().zip(&chebyshev).map(|(&point, &t)| point - difference[0] * (amplitude * t)).collect();
    // Of degree n − 1 now: cⱼ = (j/n) dⱼ₋₁ + (1 − j/n) dⱼ, from both ends to the middle.
    let mut lower = vec![P::ZERO; n];
    for j in 0..n.div_ceil(2) {
        let share = j as f64 / n as f64;
        let before = if j > 0 { lower[j - 1] } else { P::ZERO };
        lower[j] = (rest[j] - before * share) * (1.0 - share).recip();
    }
    for j in (n.div_ceil(2)..n).rev() {
        let share = (j + 1) as f64 / n as f64;
        let behind = if j + 1 < n { lower[j + 1] } else { P::ZERO };
        lower[j] = (rest[j + 1] - behind * (1.0 - share)) * share.recip();
    }
    Ok(UniformReduction { points: lower, error: difference[0].norm() * amplitude })
}

/// Bernstein coefficients over `[a, b]` of a polynomial given over `[0, 1]`: its blossom at `a` and `b`.
fn restricted(coefficients: Vec<f64>, a: f64, b: f64) -> Vec<f64> {
    let n = coefficients.len() - 1;
    let value = |j: usize| {
        let mut row = coefficients.clone();
        for step in 0..n {
            let t = if step < j { b } else { a };
            row = row.windows(2).map(|pair| pair[0].mix(pair[1], t)).collect();
        }
        row[0]
    };
    (0..=n).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bezier::BezierCurve;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_error_alternates(points in prop::collection::vec(-5.0..5.0_f64, 3..10), fixed in any::<bool>()) {
            let ends = if fixed { ReductionEnds::Fixed } else { ReductionEnds::Free };
            let reduction = reduce_uniformly(&points, ends).unwrap();
            let n = points.len() - 1;
            if reduction.error < 1e-3 {
                return Ok(());
            }
            let (p, q) = (BezierCurve::new(points).unwrap(), BezierCurve::new(reduction.points).unwrap());
            let errors: Vec<f64> = (0..=4000)
                .map(|i| f64::from(i) / 4000.0)
                .map(|t| (p.evaluate(t).unwrap() - q.evaluate(t).unwrap()) / reduction.error)
                .collect();
            prop_assert!(errors.iter().all(|e| e.abs() < 1.0 + 1e-9), "beyond the error");
            // Free: n + 1 extrema of alternating sign prove it is the best one; fixed ends leave n − 1.
            let mut extrema = errors.iter().filter(|e| e.abs() > 0.999).map(|e| e.signum()).collect::<Vec<_>>();
            extrema.dedup();
            prop_assert_eq!(extrema.len(), if fixed { n - 1 } else { n + 1 }, "extrema");
            if fixed {
                prop_assert!(errors[0].abs() < 1e-12 && errors[4000].abs() < 1e-12, "ends");
            }
        }
    }

    #[test]
    fn what_has_no_lower_degree_is_refused() {
        let name = |points: &[f64]| reduce_uniformly(points, ReductionEnds::Free).unwrap_err().name();
        assert_eq!(name(&[]), "Empty", "no points");
        assert_eq!(name(&[1.0, 2.0]), "DegreeZero", "a line");
        assert_eq!(name(&[1.0, f64::NAN, 2.0]), "NonFinite", "NaN");
        let line = reduce_uniformly(&[0.0, 1.0, 2.0, 3.0], ReductionEnds::Fixed).unwrap();
        assert!(line.error < 1e-15 && (line.points[1] - 1.5).abs() < 1e-15, "{line:?}");
    }
}
