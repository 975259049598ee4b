//! Questions whose answer is a number that the core computes.

use glam::DVec2;
use serde::Deserialize;

use crate::core::bspline::{Side, Spline};
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::question::{Verdict, find_entry, judge, name, parents, scheme, sentence};
use crate::course::stepper::{Entry, Stepper, de_boor_stepper};

/// A coordinate of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// The first coordinate.
    X,
    /// The second coordinate, upwards; for the graph of a spline its value.
    Y,
}

impl Axis {
    fn of(self, coordinates: &[f64]) -> f64 {
        coordinates.get(self as usize).copied().unwrap_or(f64::NAN)
    }

    fn other(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::X,
        }
    }

    fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
        }
    }
}

/// A number of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Quantity {
    /// A coordinate of the entry `pⁱₖ` of de Boor's scheme.
    Entry {
        /// The parameter.
        parameter: f64,
        /// The level `i`; 0 for a control point.
        level: usize,
        /// The index `k`.
        index: usize,
        /// Which coordinate.
        axis: Axis,
    },
    /// The factor `γ` with which `pⁱ⁻¹ₖ` enters `pⁱₖ`.
    Share {
        /// The parameter.
        parameter: f64,
        /// The level `i ≥ 1`.
        level: usize,
        /// The index `k`.
        index: usize,
    },
    /// A coordinate of the point of the curve.
    Point {
        /// The parameter.
        parameter: f64,
        /// Which coordinate.
        axis: Axis,
    },
    /// A coordinate of the first derivative, from the right at a knot.
    Derivative {
        /// The parameter.
        parameter: f64,
        /// Which coordinate.
        axis: Axis,
    },
    /// The number of steps that reach the point: `n − μ` at a knot of multiplicity `μ`.
    Steps {
        /// The parameter.
        parameter: f64,
    },
    /// The share of a control point in the point of the curve: `wₖ bₖ / Σ wⱼ bⱼ`, which is `bₖ` without weights.
    Influence {
        /// The parameter.
        parameter: f64,
        /// The index `k`.
        index: usize,
    },
    /// The denominator `Σ wₖ bₖ`.
    Denominator {
        /// The parameter.
        parameter: f64,
    },
    /// The coefficient with which `bₖ` enters the monomial `x^power`.
    MonomialCoefficient {
        /// The power.
        power: usize,
        /// The index `k`.
        index: usize,
    },
    /// The bound for the distance of a piece from the control polygon, in the maximum norm.
    DistanceBound {
        /// The piece, from 0.
        piece: usize,
    },
    /// A coordinate of a control point after a knot has been inserted.
    InsertedPoint {
        /// The new knot.
        at: f64,
        /// The index of the point afterwards.
        index: usize,
        /// Which coordinate.
        axis: Axis,
    },
    /// A coordinate of a control point of the Bezier form of a piece.
    BezierPoint {
        /// The piece, from 0.
        piece: usize,
        /// The index of the point, from 0 to the degree.
        index: usize,
        /// Which coordinate.
        axis: Axis,
    },
}

impl Quantity {
    /// The number for `curve`.
    ///
    /// # Errors
    ///
    /// A sentence that says why the number does not exist.
    pub fn compute(&self, curve: &Nurbs<DVec2>) -> Result<f64, String> {
        let told = |error: crate::core::bspline::SplineError| sentence(&error.to_string());
        match *self {
            Self::Entry { parameter, level, index, axis } => {
                find_entry(curve, parameter, level, index).map(|(_, entry)| axis.of(&entry.coordinates))
            }
            Self::Share { parameter, level, index } => {
                find_entry(curve, parameter, level, index).and_then(|(_, entry)| {
                    entry.share.ok_or_else(|| "A control point has no factor.".to_owned())
                })
            }
            Self::Point { parameter, axis } => {
                curve.evaluate(parameter).map(|point| axis.of(&point.to_array())).map_err(told)
            }
            Self::Derivative { parameter, axis } => curve
                .derivatives(parameter, 1, Side::Right)
                .map(|values| axis.of(&values[1].to_array()))
                .map_err(told),
            Self::Influence { parameter, index } => influence(curve, parameter, index, curve.weights()),
            Self::Denominator { parameter } => {
                curve.homogeneous().evaluate(parameter).map(|lifted| lifted.z).map_err(told)
            }
            Self::MonomialCoefficient { power, index } => {
                let coefficients = curve.space().monomial_coefficients(power).map_err(told)?;
                coefficients.get(index).copied().ok_or_else(|| gone("B-spline"))
            }
            Self::DistanceBound { piece } => {
                let bounds = curve.without_weights().polygon_distances().map_err(told)?;
                bounds.get(piece).map(|distance| distance.bound).ok_or_else(|| gone("piece"))
            }
            Self::InsertedPoint { at, index, axis } => {
                let refined = curve.insert_knot(at).map_err(told)?;
                let point = refined.points().get(index).ok_or_else(|| gone("control point"))?;
                Ok(axis.of(&point.to_array()))
            }
            Self::BezierPoint { piece, index, axis } => {
                let pieces = curve.bezier_form();
                let piece = pieces.get(piece).ok_or_else(|| gone("piece"))?;
                let point = piece.points.get(index).ok_or_else(|| gone("control point"))?;
                Ok(axis.of(&point.to_array()))
            }
            Self::Steps { parameter } => {
                de_boor_stepper(curve, parameter).map(|stepper| stepper.steps_needed() as f64).map_err(told)
            }
        }
    }
}

/// The share of control point `index` if the weights were `weights`.
fn influence(curve: &Nurbs<DVec2>, parameter: f64, index: usize, weights: &[f64]) -> Result<f64, String> {
    let told = |error: crate::core::bspline::SplineError| sentence(&error.to_string());
    let value = |weights: Vec<f64>| {
        Spline::new(curve.space().clone(), weights)
            .and_then(|spline| spline.evaluate(parameter))
            .map_err(told)
    };
    let mut alone = vec![0.0; weights.len()];
    match (alone.get_mut(index), weights.get(index)) {
        (Some(entry), Some(&weight)) => *entry = weight,
        _ => return Err(gone("control point")),
    }
    Ok(value(alone)? / value(weights.to_vec())?)
}

fn gone(what: &str) -> String {
    format!("The curve has changed: the {what} of this question is gone. Go back to the example.")
}

/// Judges the number `value`.
pub(super) fn check(
    curve: &Nurbs<DVec2>,
    quantity: &Quantity,
    tolerance: f64,
    value: f64,
    feedback: &str,
) -> Verdict {
    judge(value, quantity.compute(curve), tolerance, feedback, |right| {
        let close = |other: f64| (value - other).abs() <= tolerance;
        hint(curve, quantity, value, right, &close)
    })
}

fn hint(
    curve: &Nurbs<DVec2>,
    quantity: &Quantity,
    value: f64,
    right: f64,
    close: &dyn Fn(f64) -> bool,
) -> String {
    match *quantity {
        Quantity::Entry { parameter, level, index, axis } => {
            match find_entry(curve, parameter, level, index) {
                Ok((stepper, entry)) => entry_hint(curve, &stepper, &entry, axis, value, close),
                Err(reason) => reason,
            }
        }
        Quantity::Share { .. } if close(1.0 - right) => {
            "That is $1-\\gamma$, the share of the other point.".to_owned()
        }
        Quantity::Share { .. } if !(0.0..=1.0).contains(&value) => {
            "Each step is a mean, so $\\gamma$ lies between 0 and 1.".to_owned()
        }
        Quantity::Share { .. } => {
            "Divide the way from the left knot to the parameter by the way between both knots.".to_owned()
        }
        Quantity::Point { parameter, axis } => point_hint(curve, parameter, axis, value, close),
        Quantity::Derivative { .. } if close(-right) => {
            "The sign is the other way round: right point minus left point.".to_owned()
        }
        Quantity::Derivative { .. } => {
            let n = curve.degree();
            format!(
                "Take the last two points of the scheme: right minus left, times the degree {n}, divided by the length \
                 of the knot interval."
            )
        }
        Quantity::Influence { parameter, index } => {
            let plain = influence(curve, parameter, index, &vec![1.0; curve.points().len()]);
            if !(0.0..=1.0).contains(&value) {
                "It is a share of a mean, so it lies between 0 and 1.".to_owned()
            } else if plain.is_ok_and(close) {
                "That would be its share if all weights were equal.".to_owned()
            } else {
                "The shares of all control points sum to 1. Write them all down first.".to_owned()
            }
        }
        Quantity::Denominator { .. } => {
            "Run the scheme on the weights alone, as if they were control points on a line.".to_owned()
        }
        Quantity::MonomialCoefficient { power: 2, index }
            if curve.space().greville_abscissae().get(index).is_some_and(|average| close(average * average)) =>
        {
            "That is the square of the average. Multiply the knots in pairs and take the mean of the products."
                .to_owned()
        }
        Quantity::MonomialCoefficient { power, .. } => format!(
            "Take the {} knots inside the support, form all products of {power} of them, and take the mean.",
            curve.degree()
        ),
        Quantity::DistanceBound { .. } => {
            let n = curve.degree();
            format!("The bound is a product of three numbers; the first is $1/(2n) = 1/{}$.", 2 * n)
        }
        Quantity::InsertedPoint { .. } => {
            "The new point divides an edge of the old polygon as the new knot divides the knots of that edge."
                .to_owned()
        }
        Quantity::BezierPoint { .. } => {
            "Insert both ends of the interval until each is there as often as the degree says; the Bézier points are \
             then control points."
                .to_owned()
        }
        Quantity::Steps { parameter } => {
            let (n, mu) = (curve.degree(), curve.space().multiplicity(parameter));
            format!(
                "The degree is {n} and the knot {} stands there {mu} times: each copy saves a step.",
                short_number(parameter)
            )
        }
    }
}

/// What an intermediate point violates if it is `value`.
fn entry_hint(
    curve: &Nurbs<DVec2>,
    stepper: &Stepper,
    entry: &Entry,
    axis: Axis,
    value: f64,
    close: &dyn Fn(f64) -> bool,
) -> String {
    let Some((left, right)) = parents(stepper, entry) else {
        return "It is a control point; read its coordinate.".to_owned();
    };
    let (from, to) = (axis.of(&left.coordinates), axis.of(&right.coordinates));
    let share = match (right.weight, entry.weight) {
        (Some(right), Some(all)) => entry.share.unwrap_or(0.0) * right / all,
        _ => entry.share.unwrap_or(0.0),
    };
    let [own, left_name, right_name] = [entry, left, right].map(|entry| name(curve, entry));
    let (from_text, to_text) = (short_number(from), short_number(to));
    if close(share * from + (1.0 - share) * to) {
        return format!(
            "The shares are exchanged: ${right_name}$ has the share $\\gamma$ = {}, ${left_name}$ the rest.",
            short_number(share)
        );
    }
    if value < from.min(to) || value > from.max(to) {
        return format!(
            "${own}$ is a mean of ${left_name}$ = {from_text} and ${right_name}$ = {to_text}, so it lies between them."
        );
    }
    if close(axis.other().of(&entry.coordinates)) {
        return format!("That is its {} coordinate.", axis.other().letter());
    }
    let others = [left, right].into_iter().chain(stepper.table().filter(|other| other.tie() != entry.tie()));
    if let Some(other) = others.into_iter().find(|other| close(axis.of(&other.coordinates))) {
        return format!(
            "That is ${}$; ${own}$ is made of ${left_name}$ and ${right_name}$.",
            name(curve, other)
        );
    }
    format!(
        "It lies between ${left_name}$ = {from_text} and ${right_name}$ = {to_text}, but the share of ${right_name}$ is \
         {}.",
        short_number(share)
    )
}

/// What a point of the curve violates if its coordinate is `value`.
fn point_hint(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    axis: Axis,
    value: f64,
    close: &dyn Fn(f64) -> bool,
) -> String {
    let Ok(stepper) = scheme(curve, parameter) else {
        return "The curve has no point at this parameter.".to_owned();
    };
    let active = stepper.levels()[0].iter().filter(|entry| entry.needed);
    let (low, high) = active.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), entry| {
        let coordinate = axis.of(&entry.coordinates);
        (low.min(coordinate), high.max(coordinate))
    });
    if value < low || value > high {
        return format!(
            "The point is a mean of the active control points, so the number lies between {} and {}.",
            short_number(low),
            short_number(high)
        );
    }
    if let Some(other) = stepper.table().find(|entry| close(axis.of(&entry.coordinates))) {
        return format!(
            "That is ${}$; the point is ${}$, the end of the scheme.",
            name(curve, other),
            name(curve, stepper.apex())
        );
    }
    "Follow the scheme down to its last entry.".to_owned()
}
