//! The polynomials whose signs are those of the curvature and of its derivative, piece by piece.
//!
//! With `r = P/w` and `D = w P′ − w′ P` the curvature is `κ = Δ w³/|D|³`, where `Δ`, the determinant of the rows `(P, w)`, `(P′, w′)`, `(P″, w″)`, is only of degree
//! `3n − 6`: `Δ = n²(n − 1) det(H⁰, H¹, H²)`, the upper index meaning the `n − 1` homogeneous coefficients from that one on. Without weights it is
//! `(n − 1) det(D⁰, D¹)`, of degree `2n − 4`. Then `κ′ = w² g/|D|⁵` with
//!
//! ```text
//! g = (Δ′ w + 3 Δ w′) |D|² − (3/2) Δ w (|D|²)′,
//! ```
//!
//! of degree `8n − 11`, without weights `g = Δ′ |D|² − (3/2) Δ (|D|²)′` of degree `4n − 7`. Derivatives are by the parameter of the piece in `[0, 1]`. Course: beyond, section B.7.

use glam::{DVec2, DVec3};

use crate::core::bspline::SplineError;
use crate::core::polynomial::product_by;
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::local_piece::{LocalPiece, largest};

/// Bernstein coefficients and an estimate from above of their errors.
#[derive(Clone, Debug)]
pub(super) struct Noisy {
    pub(super) coefficients: Vec<f64>,
    pub(super) noise: f64,
}

impl Noisy {
    fn largest(&self) -> f64 {
        largest(&self.coefficients)
    }

    /// The product, `relative` being the rounding error of the operations.
    fn times(&self, other: &Self, relative: f64) -> Self {
        let (a, b) = (self.largest(), other.largest());
        let coefficients = product_by(&self.coefficients, &other.coefficients, |x: f64, y: f64| x * y);
        Self { coefficients, noise: self.noise * b + a * other.noise + relative * a * b }
    }

    /// `self + factor·other` of the same degree.
    fn plus(&self, other: &Self, factor: f64) -> Self {
        let pairs = self.coefficients.iter().zip(&other.coefficients);
        let noise = self.noise + factor.abs() * other.noise;
        Self { coefficients: pairs.map(|(a, b)| a + factor * b).collect(), noise }
    }

    /// The derivative; `None` of a constant.
    fn derivative(&self) -> Option<Self> {
        let n = (self.coefficients.len() - 1) as f64;
        let coefficients: Vec<f64> =
            self.coefficients.windows(2).map(|pair| n * (pair[1] - pair[0])).collect();
        (n > 0.0).then_some(Self { coefficients, noise: 2.0 * n * self.noise })
    }
}

/// `Δ` of a piece; `None` for degree 1.
pub(super) fn turning(piece: &LocalPiece<DVec2>) -> Option<Noisy> {
    let n = piece.degree();
    if n < 2 {
        return None;
    }
    let (count, factor) = ((n - 1) as f64, n as f64);
    if piece.weights.is_empty() {
        let direction = piece.direction();
        let [d0, d1] = [0, 1].map(|i| &direction[i..i + n - 1]);
        let coefficients = product_by(d0, d1, |a: DVec2, b: DVec2| count * a.perp_dot(b));
        let speed = largest(&direction);
        let noise = 4.0 * count * speed * (piece.direction_error() + 4.0 * factor * f64::EPSILON * speed);
        return Some(Noisy { coefficients, noise });
    }
    let rows: Vec<DVec3> = piece.numerators.iter().zip(&piece.weights).map(|(p, &w)| p.extend(w)).collect();
    let [h0, h1, h2] = [0, 1, 2].map(|i| &rows[i..i + n - 1]);
    let normals: Vec<DVec3> = product_by(h1, h2, |a: DVec3, b: DVec3| a.cross(b));
    let times = factor * factor * count;
    let coefficients = product_by(h0, &normals, |a: DVec3, b: DVec3| times * a.dot(b));
    let noise = 24.0 * times * piece.extent * piece.error * piece.largest_weight().powi(3);
    Some(Noisy { coefficients, noise })
}

/// `g` of a piece; `None` for degree 1.
pub(super) fn turning_change(piece: &LocalPiece<DVec2>) -> Option<Noisy> {
    let turning = turning(piece)?;
    let direction = piece.direction();
    let speed = largest(&direction);
    let relative = 16.0 * (piece.degree() + 1) as f64 * f64::EPSILON;
    let squared = Noisy {
        coefficients: product_by(&direction, &direction, DVec2::dot),
        noise: 2.0 * speed * piece.direction_error() + relative * speed * speed,
    };
    // The degree of the squared speed is at least 2.
    let growth = squared.derivative()?;
    let weights = (!piece.weights.is_empty())
        .then(|| Noisy { coefficients: piece.weights.clone(), noise: relative * piece.largest_weight() });
    let (weighted, change) = match &weights {
        None => (turning.clone(), turning.derivative()),
        Some(weights) => {
            let through_weights = turning.times(&weights.derivative()?, relative);
            let sum = match turning.derivative() {
                Some(own) => own.times(weights, relative).plus(&through_weights, 3.0),
                None => Noisy {
                    coefficients: through_weights.coefficients.iter().map(|c| 3.0 * c).collect(),
                    noise: 3.0 * through_weights.noise,
                },
            };
            (turning.times(weights, relative), Some(sum))
        }
    };
    let second = weighted.times(&growth, relative);
    Some(match change {
        Some(change) => change.times(&squared, relative).plus(&second, -1.5),
        None => Noisy {
            coefficients: second.coefficients.iter().map(|c| -1.5 * c).collect(),
            noise: 1.5 * second.noise,
        },
    })
}

/// The numerator of the derivative of the curvature on one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvatureChange {
    /// The interval of the piece.
    pub interval: (f64, f64),
    /// The Bernstein coefficients of the numerator `g`; only 0 for degree 1.
    pub coefficients: Vec<f64>,
}

impl Nurbs<DVec2> {
    /// For every piece the numerator `g` of the derivative of the curvature, which has the sign of `κ′`: of polynomial pieces
    /// `g = det(p′, p‴)|p′|² − 3 det(p′, p″)(p′·p″)`, where `κ′ = g/|p′|⁵`, with derivatives by the parameter of the piece in `[0, 1]`; of rational pieces the same for the
    /// homogeneous curve, of degree `8n − 11` and up to a positive factor.
    ///
    /// # Errors
    ///
    /// `NonFinite` where products of coordinates overflow.
    pub fn curvature_changes(&self) -> Result<Vec<CurvatureChange>, SplineError> {
        let pieces = self.local_pieces()?;
        let numerator = |(index, piece): (usize, &LocalPiece<DVec2>)| {
            let coefficients =
                checked(index, turning_change(piece))?.map_or_else(|| vec![0.0], |g| g.coefficients);
            Ok(CurvatureChange { interval: piece.interval, coefficients })
        };
        pieces.iter().enumerate().map(numerator).collect()
    }
}

/// `polynomial`, if its numbers are finite; `index` is that of the piece.
pub(super) fn checked(index: usize, polynomial: Option<Noisy>) -> Result<Option<Noisy>, SplineError> {
    let numbers = polynomial.iter().flat_map(|p| p.coefficients.iter().chain([&p.noise]));
    let bad = numbers.copied().find(|value| !value.is_finite());
    match bad {
        Some(value) => Err(SplineError::NonFinite { what: "product of coordinates on piece", index, value }),
        None => Ok(polynomial),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::Side;
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;
    use crate::core::triangular_scheme::collapse;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn the_polynomials_are_numerators_of_the_curvature_and_its_derivative(curve in any_curve(2..=6), t in 0.02..0.98_f64) {
            for piece in curve.local_pieces().unwrap() {
                let (a, b) = piece.interval;
                let x = a.mix(b, t);
                let value = |c: &[f64]| collapse(&mut c.to_vec(), t);
                let weight = if piece.weights.is_empty() { 1.0 } else { value(&piece.weights) };
                let direction = collapse(&mut piece.direction(), t).length();
                prop_assume!(direction > 0.3);
                let (delta, g) = (turning(&piece).unwrap(), turning_change(&piece).unwrap());
                let (n, rational) = (piece.degree(), !piece.weights.is_empty());
                prop_assert_eq!(delta.coefficients.len() - 1, if rational { 3 * n - 6 } else { 2 * n - 4 }, "degree");
                prop_assert_eq!(g.coefficients.len() - 1, if rational { 8 * n - 11 } else { 4 * n - 7 }, "degree");
                let curvature = value(&delta.coefficients) * (weight / direction).powi(3);
                let exact = curve.curvature(x, Side::Right).unwrap();
                prop_assert!((curvature - exact).abs() < 1e-7 * (1.0 + exact.abs()), "{curvature} for {exact}");
                let change = value(&g.coefficients) * weight * weight / direction.powi(5) / (b - a);
                let exact = curve.curvature_derivative(x, Side::Right).unwrap();
                prop_assert!((change - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{change} for {exact}");
            }
        }
    }
}
