//! Polynomials as splines: Marsden's identity, blossoms, and the functionals that give the coefficients back.
//!
//! ```text
//! (x − y)ⁿ = Σ ψₖ(y) bₖ(x),   ψₖ(y) = (ξₖ₊₁ − y) … (ξₖ₊ₙ − y),
//! ```
//!
//! so that `xʲ` has the coefficients `eⱼ(ξₖ₊₁, …, ξₖ₊ₙ)/C(n, j)` with the elementary symmetric functions, and any polynomial of
//! degree at most `n` the values of its blossom at `ξₖ₊₁, …, ξₖ₊ₙ`. Written with derivatives at one point `τ` of the support this
//! is the dual functional of C. de Boor and G. Fix (1973): `cₖ = Σⱼ p⁽ʲ⁾(τ) (n − j)!/n! eⱼ(ξₖ₊₁ − τ, …, ξₖ₊ₙ − τ)`.
//!
//! M. Marsden, *An identity for spline functions*, 1970. Course: section 4.3.

use crate::core::bspline::error::{Side, SplineError};
use crate::core::bspline::piecewise::PolynomialPiece;
use crate::core::bspline::space::SplineSpace;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

impl SplineSpace {
    /// `ψₖ(y)`, the coefficient of `bₖ` in `(x − y)ⁿ`; `NaN` if there is no B-spline `k`.
    pub fn marsden_coefficient(&self, k: usize, y: f64) -> f64 {
        self.inner_knots(k).iter().map(|knot| knot - y).product()
    }

    /// The coefficients of `ψₖ` as a polynomial in `y`, constant first.
    pub fn marsden_polynomial(&self, k: usize) -> Vec<f64> {
        let mut polynomial = vec![1.0];
        for knot in self.inner_knots(k) {
            polynomial.push(0.0);
            for j in (0..polynomial.len()).rev() {
                polynomial[j] = polynomial[j] * knot - if j > 0 { polynomial[j - 1] } else { 0.0 };
            }
        }
        polynomial
    }

    /// The coefficients of `x^power`, one for each B-spline.
    ///
    /// # Errors
    ///
    /// `DegreeTooHigh` for a power above the degree; `NotInSpace` for a positive power in a periodic space.
    pub fn monomial_coefficients(&self, power: usize) -> Result<Vec<f64>, SplineError> {
        let mut coefficients = vec![0.0; power + 1];
        coefficients[power] = 1.0;
        let monomial = PolynomialPiece { origin: 0.0, coefficients };
        Ok(Spline::from_polynomial(self.clone(), &monomial)?.into_parts().1)
    }

    /// `σₖ² = Σᵢ (ξₖ₊ᵢ − ξₖⁿ)²/(n − 1)`, how far the inner knots are from their average; zeros for degree 1.
    ///
    /// The coefficients of `x²` are `(ξₖⁿ)² − σₖ²/n`.
    pub fn knot_variances(&self) -> Vec<f64> {
        let n = self.degree();
        let averages = self.greville_abscissae().into_iter().enumerate();
        averages.map(|(k, average)| variance(n, &self.inner_knots(k), average)).collect()
    }

    /// The coefficient of `bₖ` in the spline that has the derivatives `p, p′, …, p⁽ⁿ⁾` at `at`, a point inside the support.
    ///
    /// At a knot take all derivatives from the same side. For a polynomial of degree at most `n` any point will do.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `n + 1` derivatives or if there is no B-spline `k`; `NonFinite` for `at`.
    pub fn coefficient_from_derivatives<P: Point>(
        &self,
        k: usize,
        at: f64,
        derivatives: &[P],
    ) -> Result<P, SplineError> {
        let n = self.degree();
        if derivatives.len() != n + 1 {
            let (expected, found) = (n + 1, derivatives.len());
            return Err(SplineError::SizeMismatch { what: "derivatives", expected, found });
        }
        if k >= self.dimension() {
            return Err(SplineError::SizeMismatch {
                what: "B-splines",
                expected: k + 1,
                found: self.dimension(),
            });
        }
        if !at.is_finite() {
            return Err(SplineError::NonFinite { what: "parameter", index: 0, value: at });
        }
        let (low, high) = self.support(k);
        // A B-spline of a periodic space may stand a period further.
        let turns = self.period().map_or(0.0, |period| ((0.5 * (low + high) - at) / period).round() * period);
        let distances: Vec<f64> = self.inner_knots(k).iter().map(|knot| knot - at - turns).collect();
        let means = monomial_blossoms(&distances);
        // eⱼ (n − j)!/n! is the mean of order j over j!.
        let mut factorial = 1.0;
        let mut sum = P::ZERO;
        for (j, &derivative) in derivatives.iter().enumerate() {
            factorial *= j.max(1) as f64;
            sum = sum + derivative * (means[j] / factorial);
        }
        Ok(sum)
    }

    /// `ξₖ₊₁ … ξₖ₊ₙ`.
    fn inner_knots(&self, k: usize) -> Vec<f64> {
        (1..=self.degree()).map(|i| self.knot((k + i) as isize).unwrap_or(f64::NAN)).collect()
    }
}

impl<P: Point> Spline<P> {
    /// The polynomial as a spline of `space`.
    ///
    /// # Errors
    ///
    /// `DegreeTooHigh`; `NotInSpace` for a polynomial that is not constant in a periodic space; `NonFinite`.
    pub fn from_polynomial(space: SplineSpace, polynomial: &PolynomialPiece<P>) -> Result<Self, SplineError> {
        let (n, count) = (space.degree(), polynomial.coefficients.len());
        if count > n + 1 {
            return Err(SplineError::DegreeTooHigh { degree: count - 1, limit: n });
        }
        if space.is_periodic() && polynomial.coefficients.iter().skip(1).any(|&c| c != P::ZERO) {
            return Err(SplineError::NotInSpace {
                reason: "only constants are periodic polynomials".to_owned(),
            });
        }
        let coefficients =
            (0..space.dimension()).map(|k| polynomial.blossom(&space.inner_knots(k))).collect();
        Self::new(space, coefficients)
    }

    /// The polynomial over every nonempty knot interval of D, or of one period, in powers of `x − left end`.
    pub fn to_piecewise(&self) -> Vec<PolynomialPiece<P>> {
        let breaks = self.space().breaks();
        let piece = |&origin: &f64| {
            let mut factorial = 1.0;
            let mut taylor = self.derivatives(origin, self.degree(), Side::Right).unwrap_or_default();
            for (j, coefficient) in taylor.iter_mut().enumerate().skip(1) {
                factorial *= j as f64;
                *coefficient = *coefficient * f64::recip(factorial);
            }
            PolynomialPiece { origin, coefficients: taylor }
        };
        breaks[..breaks.len() - 1].iter().map(piece).collect()
    }
}

impl<P: Point> PolynomialPiece<P> {
    /// The blossom at `n` arguments, of the polynomial taken as one of degree `n`: symmetric, affine in each argument, and the
    /// value of the polynomial where all are equal. Coefficients beyond the number of arguments are not seen.
    pub fn blossom(&self, arguments: &[f64]) -> P {
        let distances: Vec<f64> = arguments.iter().map(|argument| argument - self.origin).collect();
        let means = monomial_blossoms(&distances);
        self.coefficients.iter().zip(means).fold(P::ZERO, |sum, (&c, mean)| sum + c * mean)
    }

    /// The value at `x`.
    pub fn evaluate(&self, x: f64) -> P {
        self.coefficients.iter().rev().fold(P::ZERO, |sum, &c| sum * (x - self.origin) + c)
    }
}

/// `Σ (knot − average)²/(n − 1)` of the `n` inner knots, 0 for one.
pub(in crate::core) fn variance(n: usize, inner: &[f64], average: f64) -> f64 {
    if n < 2 {
        return 0.0;
    }
    inner.iter().map(|knot| (knot - average) * (knot - average)).sum::<f64>() / (n - 1) as f64
}

/// The blossoms of `1, x, …, xⁿ` at `n` arguments.
pub(in crate::core) fn monomial_blossoms(arguments: &[f64]) -> Vec<f64> {
    // means[r] = e_r/C(i, r) of the first i arguments: a convex update, free of large binomials.
    let mut means = vec![0.0; arguments.len() + 1];
    means[0] = 1.0;
    for (i, &argument) in arguments.iter().enumerate() {
        for r in (1..=i + 1).rev() {
            let share = r as f64 / (i + 1) as f64;
            means[r] = (1.0 - share) * means[r] + share * argument * means[r - 1];
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn space(degree: usize, gaps: &[u8]) -> Option<SplineSpace> {
        let mut knots = vec![-3.0];
        for gap in gaps {
            knots.push(knots[knots.len() - 1] + 0.5 * f64::from(*gap));
        }
        SplineSpace::new(degree, knots).ok()
    }

    prop_compose! {
        fn any_space()(degree in 1_usize..=8)(
            degree in Just(degree), gaps in prop::collection::vec(0_u8..3, 2 * degree + 1..2 * degree + 9),
        ) -> Option<SplineSpace> {
            space(degree, &gaps)
        }
    }

    proptest! {
        #[test]
        fn marsdens_identity_holds(space in any_space(), at in 0.0..=1.0_f64, y in -4.0..8.0_f64) {
            let Some(space) = space else { return Ok(()) };
            let (left, right) = space.parameter_interval();
            let x = left.mix(right, at);
            let coefficients: Vec<f64> = (0..space.dimension()).map(|k| space.marsden_coefficient(k, y)).collect();
            for (k, &coefficient) in coefficients.iter().enumerate() {
                let polynomial = space.marsden_polynomial(k);
                let value = polynomial.iter().rev().fold(0.0, |sum, c| sum * y + c);
                let scale: f64 = polynomial.iter().rev().fold(0.0, |sum, c| sum * y.abs() + c.abs());
                prop_assert!((value - coefficient).abs() <= 1e-13 * scale, "ψ{k}: {value}, {coefficient}");
            }
            let scale = coefficients.iter().fold(1.0_f64, |scale, c| scale.max(c.abs()));
            let n = space.degree() as i32;
            let found = Spline::new(space, coefficients).unwrap().evaluate(x).unwrap();
            prop_assert!((found - (x - y).powi(n)).abs() <= 1e-13 * scale, "x = {x}, y = {y}: {found}");
        }

        #[test]
        fn polynomials_are_reproduced_and_split_into_themselves(
            space in any_space(), a in prop::collection::vec(-4.0..4.0_f64, 9), at in 0.0..=1.0_f64,
        ) {
            let Some(space) = space else { return Ok(()) };
            let piece = PolynomialPiece { origin: 0.5, coefficients: a[..=space.degree()].to_vec() };
            let spline = Spline::from_polynomial(space, &piece).unwrap();
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            let scale = spline.coefficients().iter().fold(1.0_f64, |scale, c| scale.max(c.abs()));
            let found = spline.evaluate(x).unwrap();
            prop_assert!((found - piece.evaluate(x)).abs() <= 1e-12 * scale, "{found}, {}", piece.evaluate(x));
            let pieces = spline.to_piecewise();
            let back = Spline::from_piecewise(spline.space().clone(), &pieces).unwrap();
            for (a, b) in back.coefficients().iter().zip(spline.coefficients()) {
                prop_assert!((a - b).abs() <= 1e-9 * scale, "{a}, {b}");
            }
        }

        #[test]
        fn dual_functionals_give_the_coefficients_back(space in any_space(), at in 0.0..1.0_f64, closed in any::<bool>()) {
            let Some(mut space) = space else { return Ok(()) };
            if closed {
                let knots = space.breaks();
                let period = knots[knots.len() - 1] - knots[0];
                space = SplineSpace::periodic(space.degree(), period, knots[..knots.len() - 1].to_vec()).unwrap();
            }
            let coefficients: Vec<f64> = (0..space.dimension()).map(|k| f64::from((k * k) as u32 % 7) - 3.0).collect();
            let spline = Spline::new(space, coefficients).unwrap();
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            let span = spline.space().span(x).unwrap();
            let derivatives = spline.derivatives(x, spline.degree(), Side::Right).unwrap();
            let factor: f64 = derivatives.iter().enumerate().map(|(j, d)| d.abs() / (1..=j).product::<usize>() as f64).sum();
            for k in span - spline.degree()..=span {
                if closed && k + spline.degree() != span {
                    continue;
                }
                let k = spline.space().coefficient_index(k);
                let found = spline.space().coefficient_from_derivatives(k, x, &derivatives).unwrap();
                if closed && spline.space().dimension() <= 2 * spline.degree() {
                    continue;
                }
                let width = (spline.degree() as f64).powi(spline.degree() as i32);
                let error = (found - spline.coefficients()[k]).abs();
                prop_assert!(error <= 1e-14 * factor * width.max(10.0), "coefficient {k}: off by {error}");
            }
        }

        #[test]
        fn both_formulas_for_the_square_agree_and_averages_increase(space in any_space()) {
            let Some(space) = space else { return Ok(()) };
            let (n, averages) = (space.degree(), space.greville_abscissae());
            for (k, average) in averages.iter().enumerate() {
                prop_assert!((space.knots()[k + 1]..=space.knots()[k + n]).contains(average), "average {k}");
            }
            prop_assert!(averages.windows(2).all(|pair| pair[0] < pair[1]), "{averages:?}");
            prop_assert_eq!(space.monomial_coefficients(0).unwrap(), vec![1.0; averages.len()], "1");
            for (c, average) in space.monomial_coefficients(1).unwrap().iter().zip(&averages) {
                prop_assert!((c - average).abs() < 1e-13, "x: {c}, {average}");
            }
            if n >= 2 {
                let variances = space.knot_variances();
                for (k, c) in space.monomial_coefficients(2).unwrap().into_iter().enumerate() {
                    let other = averages[k] * averages[k] - variances[k] / n as f64;
                    prop_assert!((c - other).abs() < 1e-12 * c.abs().max(10.0), "x²: {c}, {other}");
                }
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let space = SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap();
        let error = space.monomial_coefficients(3).unwrap_err();
        assert_eq!(error, SplineError::DegreeTooHigh { degree: 3, limit: 2 }, "x³");
        assert_eq!(
            space.coefficient_from_derivatives(0, 0.0, &[1.0]).unwrap_err().name(),
            "SizeMismatch",
            "one"
        );
        let closed = SplineSpace::periodic(2, 1.0, vec![0.0, 0.5]).unwrap();
        assert_eq!(closed.monomial_coefficients(1).unwrap_err().name(), "NotInSpace", "x is not periodic");
        assert_eq!(closed.monomial_coefficients(0), Ok(vec![1.0; 2]), "1 is");
    }
}
