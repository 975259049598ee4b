//! Questions about spline surfaces whose answer is a number that the core computes.

use glam::DVec3;
use serde::Deserialize;

use crate::course::question::{Verdict, judge, sentence};
use crate::document::SurfaceObject;

/// A coordinate of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpaceAxis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

impl SpaceAxis {
    /// The coordinate of `point`.
    pub(super) fn of(self, point: DVec3) -> f64 {
        point[self as usize]
    }
}

/// A number of a spline surface.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum SurfaceQuantity {
    /// A coordinate of the point at a parameter.
    Point {
        /// The parameter.
        parameter: [f64; 2],
        /// The coordinate.
        axis: SpaceAxis,
    },
    /// The distance of the point at a parameter from the z axis.
    AxisDistance {
        /// The parameter.
        parameter: [f64; 2],
    },
}

impl SurfaceQuantity {
    /// The number for `object`.
    ///
    /// # Errors
    ///
    /// A sentence that says why the number does not exist.
    pub fn compute(&self, object: &SurfaceObject) -> Result<f64, String> {
        let (Self::Point { parameter, .. } | Self::AxisDistance { parameter }) = *self;
        let point = object.surface().evaluate(parameter).map_err(|error| sentence(&error.to_string()))?;
        Ok(self.of(point))
    }

    /// The number of a point of space.
    fn of(&self, point: DVec3) -> f64 {
        match self {
            Self::Point { axis, .. } => axis.of(point),
            Self::AxisDistance { .. } => point.truncate().length(),
        }
    }
}

/// Judges the number `value`.
pub(super) fn check(
    object: &SurfaceObject,
    quantity: &SurfaceQuantity,
    tolerance: f64,
    value: f64,
    feedback: &str,
) -> Verdict {
    judge(value, quantity.compute(object), tolerance, feedback, |_| {
        let (SurfaceQuantity::Point { parameter, .. } | SurfaceQuantity::AxisDistance { parameter }) =
            *quantity;
        let of_points: Vec<f64> = object.surface().points().iter().map(|&point| quantity.of(point)).collect();
        let farthest = of_points.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let close = |other: f64| (value - other).abs() <= tolerance;
        let shifted = |shift: [f64; 2]| {
            let at = [parameter[0] + shift[0], parameter[1] + shift[1]];
            object.surface().evaluate(at).is_ok_and(|point| close(quantity.of(point)))
        };
        let hint = if value > farthest + tolerance {
            "No control point is so far out, and the surface lies in their convex hull."
        } else if of_points.iter().any(|&other| close(other)) {
            "That is a control point. The surface runs between them: here it is a mean of several."
        } else if [[0.0, 0.5], [0.0, -0.5], [0.5, 0.0], [-0.5, 0.0]].into_iter().any(shifted) {
            "That is half a knot interval away."
        } else {
            "At a knot a quadratic spline is the mean of two neighbouring control points; do that in both directions."
        };
        hint.to_owned()
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::samples;
    use crate::document::SurfaceDisplay;

    fn torus() -> SurfaceObject {
        SurfaceObject::new(samples::torus().into(), SurfaceDisplay::default()).unwrap()
    }

    #[test]
    fn right_numbers_are_those_of_the_worked_examples() {
        let staircase = SurfaceObject::new(samples::helical_staircase().into(), SurfaceDisplay::default());
        let staircase = staircase.unwrap();
        let point = |parameter, axis| SurfaceQuantity::Point { parameter, axis };
        for (object, quantity, expected) in [
            (&torus(), point([1.5, 1.5], SpaceAxis::X), 0.9375),
            (&torus(), SurfaceQuantity::AxisDistance { parameter: [3.0, 0.0] }, 1.5 * 2.0_f64.sqrt()),
            (&torus(), SurfaceQuantity::AxisDistance { parameter: [3.0, 2.5] }, 2.25),
            (&staircase, point([1.5, 7.0], SpaceAxis::Z), 5.0),
            (&staircase, SurfaceQuantity::AxisDistance { parameter: [1.0, 4.0] }, 2.0 / 3.0),
        ] {
            let found = quantity.compute(object).unwrap();
            assert!((found - expected).abs() < 1e-12, "{quantity:?}: {found} instead of {expected}");
        }
        assert!(point([0.0, 0.0], SpaceAxis::X).compute(&staircase).is_err(), "outside its interval");
    }

    #[test]
    fn hints_name_the_violated_fact() {
        let quantity = SurfaceQuantity::AxisDistance { parameter: [3.0, 2.0] };
        let ask = |value: f64| check(&torus(), &quantity, 0.01, value, "Right.");
        assert!(ask(2.1213).correct, "right");
        for (value, fact) in
            [(3.5, "convex hull"), (3.0, "control point"), (2.25, "half a knot"), (2.0, "mean")]
        {
            let verdict = ask(value);
            assert!(!verdict.correct && verdict.message.contains(fact), "{value}: {verdict:?}");
        }
    }
}
