//! Gauss-Legendre quadrature on `[0, 1]`.
//!
//! ```text
//! ∫₀¹ f ≈ Σ wᵢ f(xᵢ),   exact for polynomials of degree 2q − 1 with q points.
//! ```
//!
//! The nodes are the roots `z` of the Legendre polynomial `P_q`, moved by `x = (1 + z)/2`; on `[0, 1]` the weights are
//! `1/((1 − z²) P'_q(z)²)`. Newton's method starts from `cos(π (i + 3/4)/(q + 1/2))`.
//!
//! M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions*, 1964, 25.4.29 and 22.16.6.

use std::f64::consts::PI;

use thiserror::Error;

/// The largest number of points of a rule: exact to degree 127, far beyond every integrand here.
pub const MAX_GAUSS_POINTS: usize = 64;

/// Errors of quadrature rules. [`QuadratureError::name`] gives the name used in the course's conventions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum QuadratureError {
    /// A rule without points.
    #[error("a Gauss rule needs at least one point")]
    Empty,
    /// More than [`MAX_GAUSS_POINTS`] points.
    #[error("a Gauss rule with {value} points is above the limit {limit}")]
    StepLimit {
        /// The number asked for.
        value: usize,
        /// The largest possible number.
        limit: usize,
    },
}

impl QuadratureError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::StepLimit { .. } => "StepLimit",
        }
    }
}

/// Nodes and weights on `[0, 1]`; nodes increase, lie inside, and are symmetric about 1/2; weights are positive and sum to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussRule {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl GaussRule {
    /// The nodes, increasing.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The weights, one for each node.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// Pairs of node and weight for the interval from `left` to `right`.
    pub fn on(&self, left: f64, right: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let width = right - left;
        self.nodes.iter().zip(&self.weights).map(move |(x, w)| (left + width * x, width * w))
    }

    /// The rule's value of the integral of `f` from `left` to `right`.
    pub fn integrate(&self, left: f64, right: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        self.on(left, right).map(|(x, w)| w * f(x)).sum()
    }
}

/// The Gauss-Legendre rule with `count` points on `[0, 1]`.
///
/// # Errors
///
/// `Empty` for 0 points, `StepLimit` above [`MAX_GAUSS_POINTS`].
pub fn gauss_legendre(count: usize) -> Result<GaussRule, QuadratureError> {
    if count == 0 {
        return Err(QuadratureError::Empty);
    }
    if count > MAX_GAUSS_POINTS {
        return Err(QuadratureError::StepLimit { value: count, limit: MAX_GAUSS_POINTS });
    }
    let (mut nodes, mut weights) = (vec![0.5; count], vec![0.0; count]);
    for i in 0..count.div_ceil(2) {
        let middle = 2 * i + 1 == count;
        let mut z = if middle { 0.0 } else { (PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos() };
        // The start is good to 1e-3 or better, so that four doublings of the digits reach rounding.
        for _ in 0..if middle { 0 } else { 5 } {
            let (value, slope) = legendre(count, z);
            z -= value / slope;
        }
        let slope = legendre(count, z).1;
        let weight = 1.0 / ((1.0 - z * z) * slope * slope);
        (nodes[i], nodes[count - 1 - i]) = (0.5 * (1.0 - z), 0.5 * (1.0 + z));
        (weights[i], weights[count - 1 - i]) = (weight, weight);
    }
    Ok(GaussRule { nodes, weights })
}

/// Value and derivative of the Legendre polynomial of `degree ≥ 1` at `|z| < 1`.
fn legendre(degree: usize, z: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, z);
    for n in 2..=degree {
        let n = n as f64;
        (before, value) = (value, ((2.0 * n - 1.0) * z * value - (n - 1.0) * before) / n);
    }
    (value, degree as f64 * (before - z * value) / (1.0 - z * z))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn powers_up_to_twice_the_points_less_one_are_exact_and_the_next_is_not() {
        for count in 1..=MAX_GAUSS_POINTS {
            let rule = gauss_legendre(count).unwrap();
            for degree in 0..2 * count {
                let error = rule.integrate(0.0, 1.0, |x| x.powi(degree as i32)) * (degree as f64 + 1.0) - 1.0;
                assert!(error.abs() < 3e-14, "{count} points, degree {degree}: {error}");
            }
            // (q!)⁴/((2q + 1) ((2q)!)²) is above rounding for few points only.
            if count <= 8 {
                let degree = 2 * count;
                let error = rule.integrate(0.0, 1.0, |x| x.powi(degree as i32)) * (degree as f64 + 1.0) - 1.0;
                assert!(error < -1e-10, "{count} points, degree {degree}: {error}");
            }
        }
    }

    #[test]
    fn nodes_increase_inside_and_weights_are_positive() {
        for count in 1..=MAX_GAUSS_POINTS {
            let rule = gauss_legendre(count).unwrap();
            assert!(rule.nodes().windows(2).all(|pair| pair[0] < pair[1]), "{count} points: order");
            assert!(rule.nodes()[0] > 0.0 && rule.nodes()[count - 1] < 1.0, "{count} points: inside");
            assert!(rule.weights().iter().all(|w| *w > 0.0), "{count} points: weights");
        }
    }

    #[test]
    fn impossible_counts_are_refused() {
        assert_eq!(gauss_legendre(0), Err(QuadratureError::Empty), "no point");
        let limit = MAX_GAUSS_POINTS;
        assert_eq!(gauss_legendre(65), Err(QuadratureError::StepLimit { value: 65, limit }), "too many");
    }
}
