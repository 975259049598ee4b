//! The elliptic problem `−div(A grad u) + c u = f` in weak form.
//!
//! ```text
//! a(u, v) = ∫ (grad v)ᵗ A grad u + c u v,   λ(v) = ∫ f v,
//! ```
//!
//! with `A(x)` symmetric and positive definite and `c(x) ≥ 0`. Essential conditions `u = 0` belong to the space of functions, natural
//! ones `(A grad u)·normal = 0` need nothing. Course: sections 9.1 and 9.3.

use std::fmt::{self, Debug, Formatter};

use glam::{DMat2, DVec2};

pub use crate::core::domain::Jet;
use crate::core::finite_element::error::FiniteElementError;

/// A coefficient: one value everywhere, or a function of the point.
#[derive(Clone, Copy)]
pub enum Coefficient<'a, T> {
    /// The same value everywhere.
    Constant(T),
    /// A function of the point.
    Function(&'a (dyn Fn(DVec2) -> T + Sync)),
}

impl<T: Copy> Coefficient<'_, T> {
    /// The value at `x`.
    pub fn at(&self, x: DVec2) -> T {
        match self {
            Self::Constant(value) => *value,
            Self::Function(function) => function(x),
        }
    }

    /// Whether it is given as one value.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }
}

impl<T: Debug> Debug for Coefficient<'_, T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "Constant({value:?})"),
            Self::Function(_) => write!(f, "Function"),
        }
    }
}

/// The bilinear form by its coefficients, and the load.
#[derive(Clone, Copy, Debug)]
pub struct EllipticForm<'a> {
    /// `A`, symmetric and positive definite.
    pub diffusion: Coefficient<'a, DMat2>,
    /// `c ≥ 0`.
    pub reaction: Coefficient<'a, f64>,
    /// `f`.
    pub load: Coefficient<'a, f64>,
}

/// The checked coefficients at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormAtPoint {
    /// `A`.
    pub diffusion: DMat2,
    /// `c`.
    pub reaction: f64,
    /// `f`.
    pub load: f64,
}

impl FormAtPoint {
    /// The integrand of `a(u, v)`.
    pub fn bilinear(&self, u: &Jet, v: &Jet) -> f64 {
        v.gradient.dot(self.diffusion * u.gradient) + self.reaction * u.value * v.value
    }
}

impl<'a> EllipticForm<'a> {
    /// Poisson's problem `−Δu = f`.
    pub fn poisson(load: Coefficient<'a, f64>) -> Self {
        let diffusion = Coefficient::Constant(DMat2::IDENTITY);
        Self { diffusion, reaction: Coefficient::Constant(0.0), load }
    }

    /// Whether `A` and `c` are given as constants.
    pub fn has_constant_coefficients(&self) -> bool {
        self.diffusion.is_constant() && self.reaction.is_constant()
    }

    /// Whether constants lie in the kernel of the form: `c = 0` everywhere, as far as it is known without looking.
    pub fn kills_constants(&self) -> bool {
        matches!(self.reaction, Coefficient::Constant(0.0))
    }

    /// The coefficients at `x`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `NotElliptic` if `A` is not symmetric (to `1e-12` of its size) and positive definite, or `c < 0`.
    pub fn at(&self, x: DVec2) -> Result<FormAtPoint, FiniteElementError> {
        let sample = FormAtPoint {
            diffusion: self.diffusion.at(x),
            reaction: self.reaction.at(x),
            load: self.load.at(x),
        };
        let a = sample.diffusion;
        let finite = |what, value: f64| match value.is_finite() {
            true => Ok(()),
            false => Err(FiniteElementError::NonFinite { what, point: x, value }),
        };
        finite("the load f", sample.load)?;
        finite("the coefficient c", sample.reaction)?;
        for entry in a.to_cols_array() {
            finite("an entry of the coefficient A", entry)?;
        }
        let not_elliptic = |what, value| Err(FiniteElementError::NotElliptic { what, point: x, value });
        let (half_trace, asymmetry) = (0.5 * (a.x_axis.x + a.y_axis.y), a.x_axis.y - a.y_axis.x);
        if asymmetry.abs() > 1e-12 * (half_trace.abs() + a.x_axis.y.abs()) {
            return not_elliptic("A (not symmetric)", asymmetry);
        }
        let smallest = half_trace - (0.5 * (a.x_axis.x - a.y_axis.y)).hypot(a.x_axis.y);
        if smallest <= 0.0 {
            return not_elliptic("A", smallest);
        }
        if sample.reaction < 0.0 {
            return not_elliptic("c", sample.reaction);
        }
        Ok(sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(form: &EllipticForm<'_>, x: DVec2) -> &'static str {
        form.at(x).map_or_else(|error| error.name(), |_| "ok")
    }

    #[test]
    fn coefficients_are_elliptic_exactly_where_the_smallest_eigenvalue_is_positive() {
        // Eigenvalues 1 ± x.
        let matrix = |x: DVec2| DMat2::from_cols_array(&[1.0, x.x, x.x, 1.0]);
        let form = EllipticForm {
            diffusion: Coefficient::Function(&matrix),
            ..EllipticForm::poisson(Coefficient::Constant(1.0))
        };
        assert_eq!(name(&form, DVec2::new(0.99, 0.0)), "ok", "eigenvalue 0.01");
        assert_eq!(name(&form, DVec2::new(1.0, 0.0)), "NotElliptic", "eigenvalue 0");
        assert_eq!(name(&form, DVec2::new(f64::NAN, 0.0)), "NonFinite", "NaN");
        let skew = DMat2::from_cols_array(&[1.0, 0.1, -0.1, 1.0]);
        let form = EllipticForm { diffusion: Coefficient::Constant(skew), ..form };
        assert_eq!(name(&form, DVec2::ZERO), "NotElliptic", "not symmetric");
        let form = EllipticForm { reaction: Coefficient::Constant(-1.0), ..EllipticForm::poisson(form.load) };
        assert_eq!(name(&form, DVec2::ZERO), "NotElliptic", "negative reaction");
    }
}
