//! Questions about finite elements whose answer is a number that the core computes.

use glam::DVec2;
use serde::Deserialize;

use crate::core::bspline::{EndKnots, SplineSpace};
use crate::core::finite_element::{LineForm, Method, line_system, r_difference, r_intersection, r_union};
use crate::core::progress::Unwatched;
use crate::course::question::{Verdict, judge, sentence};
use crate::document::{Membrane, Operation};

/// A number of finite elements.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ElementsQuantity {
    /// Coefficient `index` of the hat functions for `−u″ = 1`, `u(0) = u(1) = 0` with `h = 1/intervals`; 0 for the end at 0.
    StringCoefficient {
        /// Number of intervals.
        intervals: usize,
        /// Index of the hat function, that of its tip.
        index: usize,
    },
    /// The R-function of an operation.
    RFunction {
        /// The operation.
        operation: Operation,
        /// The first weight.
        first: f64,
        /// The second weight.
        second: f64,
    },
    /// The determinant of the Jacobian matrix of the patch.
    Determinant {
        /// The parameter.
        parameter: DVec2,
    },
}

impl ElementsQuantity {
    /// The number for `membrane`.
    ///
    /// # Errors
    ///
    /// A sentence that says why the number does not exist.
    pub fn compute(&self, membrane: &Membrane) -> Result<f64, String> {
        match *self {
            Self::StringCoefficient { intervals, index } => string(intervals, index),
            Self::RFunction { operation, first, second } => {
                let jet = |value: f64| crate::core::domain::Jet { value, gradient: DVec2::ZERO };
                let join = match operation {
                    Operation::Union => r_union,
                    Operation::Intersection => r_intersection,
                    Operation::Difference => r_difference,
                };
                Ok(join(jet(first), jet(second)).value)
            }
            Self::Determinant { parameter } => {
                let patch = membrane.patch().ok_or("The problem has no patch any more.")?;
                let jet = patch.jet(parameter).map_err(|error| sentence(&error.to_string()))?;
                Ok(jet.determinant())
            }
        }
    }
}

fn string(intervals: usize, index: usize) -> Result<f64, String> {
    let told = |error: &dyn std::fmt::Display| sentence(&error.to_string());
    let breaks: Vec<f64> = (0..=intervals).map(|i| i as f64 / intervals as f64).collect();
    let space = SplineSpace::from_breaks(1, &breaks, EndKnots::Interpolating).map_err(|e| told(&e))?;
    let form = |_| LineForm { diffusion: 1.0, reaction: 0.0, load: 1.0 };
    let kept: Vec<usize> = (1..intervals).collect();
    let system = line_system(&space, form, 2).and_then(|system| system.restrict(&kept));
    let solved = system.and_then(|system| system.solve(None, Method::Direct, &Unwatched));
    let coefficients = solved.map_err(|error| told(&error))?.coefficients;
    if index == 0 || index == intervals {
        return Ok(0.0);
    }
    coefficients.get(index - 1).copied().ok_or_else(|| "There is no such hat function.".to_owned())
}

/// Judges the number `value`.
pub(super) fn check(
    membrane: &Membrane,
    quantity: &ElementsQuantity,
    tolerance: f64,
    value: f64,
    feedback: &str,
) -> Verdict {
    judge(value, quantity.compute(membrane), tolerance, feedback, |right| {
        let close = |other: f64| (value - other).abs() <= tolerance;
        let hint = match *quantity {
            ElementsQuantity::StringCoefficient { .. } if close(2.0 * right) => {
                "Twice too much: the load of a hat function is its area, $h$, and the tip of $x(1-x)/2$ is half of $x(1-x)$."
            }
            ElementsQuantity::StringCoefficient { .. } => {
                "Hat functions meet the exact solution at the knots: look there at $x(1-x)/2$."
            }
            ElementsQuantity::RFunction { first, second, .. } if close(first + second) => {
                "The root is missing: $\\sqrt{w_1^2+w_2^2}$ is added or subtracted."
            }
            ElementsQuantity::RFunction { first, second, .. }
                if close(first + second + first.hypot(second)) =>
            {
                "That is the union; an intersection subtracts the root."
            }
            ElementsQuantity::RFunction { .. } => "Put the two weights into the formula of the operation.",
            ElementsQuantity::Determinant { .. } if close(-right) => {
                "The sign is the other way round: first column times second row comes with plus."
            }
            ElementsQuantity::Determinant { .. } => {
                "The columns are the derivatives along $t_1$ and $t_2$; multiply crosswise and subtract."
            }
        };
        hint.to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::MembranePreset;

    #[test]
    fn right_numbers_are_those_of_the_worked_examples() {
        let membrane = MembranePreset::BookPatch.membrane();
        let middle = DVec2::splat(0.5);
        for (quantity, expected) in [
            (ElementsQuantity::StringCoefficient { intervals: 4, index: 1 }, 0.09375),
            (ElementsQuantity::StringCoefficient { intervals: 4, index: 2 }, 0.125),
            (ElementsQuantity::StringCoefficient { intervals: 4, index: 4 }, 0.0),
            (
                ElementsQuantity::RFunction { operation: Operation::Intersection, first: 3.0, second: 4.0 },
                2.0,
            ),
            (ElementsQuantity::RFunction { operation: Operation::Difference, first: 3.0, second: 4.0 }, -6.0),
            (ElementsQuantity::Determinant { parameter: middle }, 4.125),
        ] {
            let found = quantity.compute(&membrane).unwrap();
            assert!((found - expected).abs() < 1e-12, "{quantity:?}: {found} instead of {expected}");
        }
        let outside = ElementsQuantity::Determinant { parameter: DVec2::splat(7.0) };
        assert!(outside.compute(&membrane).is_err(), "outside the patch");
        assert!(
            ElementsQuantity::Determinant { parameter: middle }
                .compute(&MembranePreset::Disc.membrane())
                .is_err(),
            "no patch"
        );
    }

    #[test]
    fn hints_name_the_violated_fact() {
        let membrane = MembranePreset::BookPatch.membrane();
        let cap = ElementsQuantity::RFunction { operation: Operation::Intersection, first: 3.0, second: 4.0 };
        let ask =
            |quantity: &ElementsQuantity, value: f64| check(&membrane, quantity, 0.005, value, "Right.");
        assert!(ask(&cap, 2.0).correct, "right");
        assert!(ask(&cap, 7.0).message.contains("root is missing"), "{:?}", ask(&cap, 7.0));
        assert!(ask(&cap, 12.0).message.contains("union"), "{:?}", ask(&cap, 12.0));
        let det = ElementsQuantity::Determinant { parameter: DVec2::splat(0.5) };
        assert!(ask(&det, -4.125).message.contains("sign"), "{:?}", ask(&det, -4.125));
    }
}
