//! Errors in the L2 norm and the H1 seminorm, and observed rates of convergence.
//!
//! ```text
//! |e|₀ = (∫ e²)^½,   |e|₁ = (∫ |grad e|²)^½,   rate = ln(eᵢ/eᵢ₊₁) / ln(hᵢ/hᵢ₊₁).
//! ```
//!
//! Course: section 9.1 (expected: n + 1 in L2 and n in H1 for smooth solutions).

use crate::core::finite_element::form::Jet;

/// Sums of a quadrature for an error and for the exact solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorSums {
    error: [f64; 2],
    exact: [f64; 2],
}

impl ErrorSums {
    /// Adds one quadrature point with its weight.
    pub fn add(&mut self, weight: f64, approximate: &Jet, exact: &Jet) {
        let (value, gradient) = (approximate.value - exact.value, approximate.gradient - exact.gradient);
        self.error[0] += weight * value * value;
        self.error[1] += weight * gradient.length_squared();
        self.exact[0] += weight * exact.value * exact.value;
        self.exact[1] += weight * exact.gradient.length_squared();
    }

    /// Adds the sums of another part of the domain.
    pub fn merge(&mut self, other: &Self) {
        for i in 0..2 {
            self.error[i] += other.error[i];
            self.exact[i] += other.exact[i];
        }
    }

    /// The norms.
    pub fn norms(&self) -> ErrorNorms {
        ErrorNorms {
            l2: self.error[0].sqrt(),
            h1_seminorm: self.error[1].sqrt(),
            exact_l2: self.exact[0].sqrt(),
            exact_h1_seminorm: self.exact[1].sqrt(),
        }
    }
}

/// Norms of an error and of the exact solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorNorms {
    /// L2 norm of the error.
    pub l2: f64,
    /// L2 norm of the error's gradient.
    pub h1_seminorm: f64,
    /// L2 norm of the exact solution.
    pub exact_l2: f64,
    /// L2 norm of its gradient.
    pub exact_h1_seminorm: f64,
}

impl ErrorNorms {
    /// L2 error relative to the solution; the absolute one if the solution is 0.
    pub fn relative_l2(&self) -> f64 {
        if self.exact_l2 > 0.0 { self.l2 / self.exact_l2 } else { self.l2 }
    }

    /// H1-seminorm error relative to the solution; the absolute one if the solution is constant.
    pub fn relative_h1_seminorm(&self) -> f64 {
        if self.exact_h1_seminorm > 0.0 {
            self.h1_seminorm / self.exact_h1_seminorm
        } else {
            self.h1_seminorm
        }
    }
}

/// Observed rates between neighbours: one fewer than errors; not a number where an error or a width is not positive.
pub fn convergence_rates(widths: &[f64], errors: &[f64]) -> Vec<f64> {
    let pairs = widths.windows(2).zip(errors.windows(2));
    pairs
        .map(
            |(h, e)| {
                if h[0] > 0.0 && e[1] > 0.0 { (e[0] / e[1]).ln() / (h[0] / h[1]).ln() } else { f64::NAN }
            },
        )
        .collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    #[test]
    fn errors_c_h_to_the_power_p_have_the_rate_p() {
        let widths = [0.5, 0.25, 0.1];
        let errors = widths.map(|h: f64| 7.0 * h.powf(2.5));
        for rate in convergence_rates(&widths, &errors) {
            assert!((rate - 2.5).abs() < 1e-13, "rate {rate}");
        }
    }

    #[test]
    fn norms_are_root_mean_squares_and_parts_add_up() {
        let jet = |value, x, y| Jet { value, gradient: DVec2::new(x, y) };
        let (mut one, mut other) = (ErrorSums::default(), ErrorSums::default());
        one.add(0.5, &jet(1.0, 3.0, 4.0), &jet(0.0, 0.0, 0.0));
        other.add(0.5, &jet(2.0, 1.0, 0.0), &jet(1.0, 1.0, 5.0));
        one.merge(&other);
        let norms = one.norms();
        assert_eq!(norms.l2, 1.0, "both values are off by 1");
        assert_eq!(norms.h1_seminorm, 5.0, "both gradients are off by 5");
        assert_eq!(norms.relative_l2(), 1.0 / 0.5f64.sqrt(), "relative to the exact norm");
    }
}
