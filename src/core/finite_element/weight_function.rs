//! Weight functions: positive in the domain, zero with a nonzero slope on the part Γ of its boundary with
//! essential conditions.
//!
//! Course: section 9.2.

use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use glam::DVec2;

use crate::core::domain::{Domain, Jet};
use crate::core::finite_element::r_function::{r_complement, r_intersection, r_union};

/// A weight function with its gradient.
#[derive(Clone)]
pub enum Weight {
    /// `w = 1`: natural conditions everywhere.
    One,
    /// R-functions along the tree of a domain, whose whole boundary is Γ (as far as it meets the problem's domain).
    OfDomain(Domain),
    /// A function.
    Function(Arc<dyn Fn(DVec2) -> Jet + Send + Sync>),
    /// `1 − max(0, 1 − d/width)^exponent` of another weight `d`: equal to 1 where `d ≥ width`, with the same zeros.
    Plateau {
        /// The weight `d`, at best a distance.
        of: Arc<Self>,
        /// Width of the strip, positive.
        width: f64,
        /// The exponent γ ≥ 1; the plateau is joined with γ − 1 continuous derivatives.
        exponent: f64,
    },
}

impl Weight {
    /// A function given by a closure.
    pub fn function(function: impl Fn(DVec2) -> Jet + Send + Sync + 'static) -> Self {
        Self::Function(Arc::new(function))
    }

    /// Whether constants are among the functions `w b`.
    pub fn is_one(&self) -> bool {
        matches!(self, Self::One)
    }

    /// Value and gradient at `x`.
    pub fn at(&self, x: DVec2) -> Jet {
        match self {
            Self::One => Jet { value: 1.0, gradient: DVec2::ZERO },
            Self::OfDomain(domain) => domain_weight(domain, x),
            Self::Function(function) => function(x),
            Self::Plateau { of, width, exponent } => {
                let d = of.at(x);
                let rest = 1.0 - d.value / width;
                if rest <= 0.0 {
                    return Jet { value: 1.0, gradient: DVec2::ZERO };
                }
                let slope = exponent * rest.powf(exponent - 1.0) / width;
                Jet { value: 1.0 - rest.powf(*exponent), gradient: d.gradient * slope }
            }
        }
    }
}

impl Debug for Weight {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::One => write!(f, "One"),
            Self::OfDomain(domain) => write!(f, "OfDomain({domain:?})"),
            Self::Function(_) => write!(f, "Function"),
            Self::Plateau { of, width, exponent } => write!(f, "Plateau({of:?}, {width}, {exponent})"),
        }
    }
}

/// The weight that R-functions make of the levels of a domain's leaves: positive inside, negative outside, 0 on
/// the boundary.
pub fn domain_weight(domain: &Domain, x: DVec2) -> Jet {
    match domain {
        Domain::Primitive(primitive) => primitive.level(x),
        Domain::Complement(inner) => r_complement(domain_weight(inner, x)),
        Domain::Union(both) => r_union(domain_weight(&both[0], x), domain_weight(&both[1], x)),
        Domain::Intersection(both) => r_intersection(domain_weight(&both[0], x), domain_weight(&both[1], x)),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    fn keyhole() -> Domain {
        let plate = Domain::rectangle(DVec2::new(-1.0, -1.0), DVec2::new(2.0, 1.0)).unwrap();
        plate.difference(Domain::disc(DVec2::ZERO, 0.5).unwrap())
    }

    #[test]
    fn the_sign_says_inside_and_the_slope_on_the_boundary_is_that_of_the_leaf() {
        let domain = keyhole();
        for i in -30..30 {
            for j in -30..30 {
                let x = DVec2::new(f64::from(i), f64::from(j)) * 0.0731;
                let weight = domain_weight(&domain, x);
                assert_eq!(weight.value > 0.0, domain.contains(x), "sign at {x}");
            }
        }
        for (x, normal) in [
            (DVec2::new(0.3, 0.4), DVec2::new(0.6, 0.8)),
            (DVec2::new(2.0, 0.3), DVec2::NEG_X),
            (DVec2::new(1.0, -1.0), DVec2::Y),
        ] {
            let weight = domain_weight(&domain, x);
            assert!(weight.value.abs() < 1e-15, "zero at {x}");
            assert!((weight.gradient - normal).length() < 1e-14, "slope at {x}: {}", weight.gradient);
        }
    }

    #[test]
    fn the_plateau_has_the_zeros_and_the_gradient_of_its_formula() {
        let of = Arc::new(Weight::OfDomain(Domain::disc(DVec2::ZERO, 1.0).unwrap()));
        let weight = Weight::Plateau { of, width: 0.3, exponent: 3.0 };
        assert_eq!(weight.at(DVec2::ZERO).value, 1.0, "middle");
        assert!(weight.at(DVec2::X).value.abs() < 1e-15, "boundary");
        let x = DVec2::new(0.6, 0.5);
        for (axis, e) in [DVec2::X, DVec2::Y].into_iter().enumerate() {
            let slope = (weight.at(x + 1e-6 * e).value - weight.at(x - 1e-6 * e).value) / 2e-6;
            assert!((slope - weight.at(x).gradient[axis]).abs() < 1e-8, "axis {axis}");
        }
    }
}
