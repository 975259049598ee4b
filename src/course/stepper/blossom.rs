//! The blossom: de Boor's triangle with another argument in every step.
//!
//! `pⁱ⁺¹ₖ = γ pⁱₖ + (1 − γ) pⁱₖ₋₁` with `γ = (uᵢ₊₁ − ξₖ)/(ξₖ₊ₙ₋ᵢ − ξₖ)`; the entry `pⁱₖ` is `P[u₁, …, uᵢ, ξₖ₊₁, …, ξₖ₊ₙ₋ᵢ]`. Course: section
//! 6.4.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::number_text::{formula_number, formula_point, short_number, short_point};
use crate::course::stepper::narration::{Name, Shares, range_of, sentence};
use crate::course::stepper::teller::{Net, Teller};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64, chosen: &[f64]) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let (n, space) = (curve.degree(), curve.space());
    let t = space.reduce(t).map_err(|error| sentence(&error))?;
    let span = space.span(t).map_err(|error| sentence(&error))?;
    let knots = space.evaluation_knots();
    let usable = chosen.len() == n && chosen.iter().all(|argument| argument.is_finite());
    let arguments = if usable { chosen.to_vec() } else { usual(n, t, knots[span], knots[span + 1]) };
    let points = (span - n..=span).map(|k| net.spline.evaluation_coefficient(k)).collect();
    let scheme = TriangularScheme::run(points, n, |i, j| {
        let k = span - n + i + 1 + j;
        (arguments[i] - knots[k]) / (knots[k + n - i] - knots[k])
    });
    let mut teller = Teller::default();
    teller.row(net.active(span, n + 1));
    teller.scheme(&scheme, net.rational, |level, position| {
        Name::of_level(space.coefficient_index(span - n + level + position), level)
    });
    let label = |level: usize, position: usize| {
        let k = span - n + level + position;
        let known = arguments[..level].iter().chain(&knots[k + 1..=k + n - level]);
        known.map(|&value| short_number(value)).collect::<Vec<_>>().join(", ")
    };
    let ties: Vec<Tie> = teller.levels[0].iter().map(Entry::tie).collect();
    let list = arguments.iter().map(|&value| short_number(value)).collect::<Vec<_>>().join(", ");
    let caption = format!(
        "The piece over [{}, {}] has a blossom P, symmetric and affine in each of its {n} arguments; here they are {list}. \
         The control points {} have knots as arguments.",
        short_number(knots[span]),
        short_number(knots[span + 1]),
        range_of(&teller.levels[0])
    );
    teller.tell(caption, format!("c_k = P[{}]", subscripts(n)), ties.clone(), ties);
    for level in 1..=n {
        for position in 0..=n - level {
            let low = span - n + level + position;
            let at = arguments[level - 1];
            teller.tell_mixture(
                (level, position),
                &Shares::Fraction { at, low: knots[low], high: knots[low + n + 1 - level] },
            );
            if let Some(frame) = teller.frames.last_mut() {
                let (argument, label) = (short_number(at), label(level, position));
                frame
                    .caption
                    .push_str(&format!(" The argument {argument} has replaced a knot: it is P[{label}]."));
            }
        }
    }
    let top = &teller.levels[n][0];
    let same = arguments.iter().all(|&argument| argument == t);
    let what =
        if same { "the point of the curve at t" } else { "the same in whatever order the arguments come" };
    let caption = format!("P[{list}] = {}, {what}.", short_point(&top.coordinates));
    let written = arguments.iter().map(|&value| formula_number(value)).collect::<Vec<_>>().join(", ");
    let formula = format!("P[{written}] = {}", formula_point(&top.coordinates));
    teller.tell(caption, formula, Vec::new(), vec![(n, 0)]);
    if !chosen.is_empty() && !usable {
        teller.note =
            Some(format!("Degree {n} needs {n} arguments; {} are given, so others are shown.", chosen.len()));
    }
    Ok(teller.end(StepperKind::Blossom, t, (n, 0)))
}

/// The left end of the interval, then the parameter, at last the right end.
fn usual(n: usize, t: f64, left: f64, right: f64) -> Vec<f64> {
    let mut arguments = vec![t; n];
    if n > 1 {
        arguments[0] = left;
    }
    if n > 2 {
        arguments[n - 1] = right;
    }
    arguments
}

/// `\xi_{k+1}, …, \xi_{k+n}`.
fn subscripts(n: usize) -> String {
    match n {
        1 => "\\xi_{k+1}".to_owned(),
        2 => "\\xi_{k+1}, \\xi_{k+2}".to_owned(),
        _ => format!("\\xi_{{k+1}}, \\ldots, \\xi_{{k+{n}}}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{all_curves, polynomial_curves};

    #[test]
    fn the_last_point_is_the_blossom_whatever_the_order_of_the_arguments() {
        for curve in polynomial_curves() {
            let (left, right) = curve.space().parameter_interval();
            let (n, t) = (curve.degree(), left + 0.41 * (right - left));
            let span = curve.space().span(t).unwrap();
            let mut arguments: Vec<f64> = (0..n).map(|i| t + 0.05 * i as f64).collect();
            let expected = curve.without_weights().blossom(span, &arguments).unwrap();
            for _ in 0..2 {
                let found = story(&curve, t, &arguments).unwrap().apex().at.unwrap();
                assert!(found.distance(expected) < 1e-9, "degree {n}: {found}, {expected}");
                arguments.reverse();
            }
        }
    }

    #[test]
    fn equal_arguments_give_the_curve_and_knots_give_control_points() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            let (n, t) = (curve.degree(), left + 0.41 * (right - left));
            let found = story(&curve, t, &vec![t; n]).unwrap().apex().at.unwrap();
            assert!(found.distance(curve.evaluate(t).unwrap()) < 1e-10, "degree {n}: {found}");
            let (knots, span) = (curve.space().evaluation_knots(), curve.space().span(t).unwrap());
            let last = story(&curve, t, &knots[span + 1..=span + n]).unwrap().apex().at.unwrap();
            let expected = curve.points()[curve.space().coefficient_index(span)];
            assert!(last.distance(expected) < 1e-9, "degree {n}: {last}, {expected}");
        }
    }

    #[test]
    fn a_wrong_number_of_arguments_is_noted() {
        let stepper = story(&polynomial_curves()[0], 0.5, &[0.0]).unwrap();
        assert!(stepper.note().unwrap().contains("needs 3 arguments"), "{:?}", stepper.note());
    }
}
