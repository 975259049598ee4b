//! Differentiation: difference points, mixed by de Boor's algorithm of one degree less.
//!
//! `p′ = Σ dₖ bⁿ⁻¹ₖ` with `dₖ = n (cₖ − cₖ₋₁)/(ξₖ₊ₙ − ξₖ)`. A rational curve `r = p/q` has `r′ = (p′ − q′ r)/q`. In the plane the
//! vectors start at the point of the curve, all at one scale. Course: sections 4.2 and 4.5.

use glam::{DVec2, DVec3};

use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::number_text::{formula_number, formula_point, short_number, short_point};
use crate::course::stepper::entry::Parent;
use crate::course::stepper::narration::{
    Name, Shares, difference, homogeneous_label, place_in_interval, range_of, sentence,
};
use crate::course::stepper::teller::{Net, Teller, extent};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};
use crate::figure::composition::StepInk;

/// The longest difference is drawn so long, as a part of the extent of the curve.
const REACH: f64 = 0.3;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let given = net.spline.de_boor_scheme(t).map_err(|error| sentence(&error))?;
    let (n, space, span, t) = (curve.degree(), curve.space(), given.span, given.parameter);
    let knots = space.evaluation_knots();
    let active = &given.triangle.levels()[0];
    let rate = |k: usize| n as f64 / (knots[k + n] - knots[k]);
    let differences =
        (0..n).map(|j| (active[j + 1] - active[j]) * rate(span - n + 1 + j)).collect::<Vec<DVec3>>();
    let scheme = TriangularScheme::run(differences, n - 1, |i, j| {
        let k = span - n + i + 2 + j;
        (t - knots[k]) / (knots[k + n - 1 - i] - knots[k])
    });
    let top = given.triangle.result().ok_or("The curve has no points.")?;
    let point = net.place(top);
    // Linear in the difference, so that mixtures stay mixtures; of a polynomial curve q is 1 and q′ is 0.
    let vector = |value: DVec3| {
        if net.rational { (value.truncate() - point * value.z) / top.z } else { value.truncate() }
    };
    let longest = scheme.levels()[0].iter().map(|&value| vector(value).length()).fold(0.0, f64::max);
    let scale = if longest > 0.0 { REACH * extent(&net.polygon(&net.spline)) / longest } else { 1.0 };

    let mut teller = Teller::default();
    teller.row(net.active(span, n + 1));
    for (level, row) in scheme.levels().iter().enumerate() {
        let entry = |(position, &value): (usize, &DVec3)| {
            let index = space.coefficient_index(span - n + 1 + level + position);
            let name = Name::new('d', index, (level > 0).then_some(level));
            let numbers =
                if net.rational { value.to_array().to_vec() } else { value.truncate().to_array().to_vec() };
            let mut entry = Entry::numbers(name, &numbers);
            if let Some(line) = entry.lines.get_mut(2) {
                line.insert_str(0, "w ");
            }
            entry.at = Some(point + vector(value) * scale).filter(|at| at.is_finite());
            match level {
                0 => {
                    let rate = rate(span - n + 1 + position);
                    entry.parents = vec![
                        Parent { tie: (0, position), factor: -rate },
                        Parent { tie: (0, position + 1), factor: rate },
                    ];
                    entry
                }
                _ => entry.mixed(level, position, scheme.weights()[level - 1][position]),
            }
        };
        let entries = row.iter().enumerate().map(entry).collect();
        teller.row(entries);
    }
    tell(&mut teller, &net, (span, t), knots, point);
    let derivative = vector(scheme.result().unwrap_or(DVec3::ZERO));
    close(&mut teller, &net, (point, derivative), scale);
    Ok(teller.end(StepperKind::Differentiation, t, (n, 0)))
}

fn tell(teller: &mut Teller, net: &Net, (span, t): (usize, f64), knots: &[f64], point: DVec2) {
    let n = teller.levels.len() - 1;
    let (place, formula) = place_in_interval(t, knots[span], knots[span + 1]);
    let ties: Vec<Tie> = teller.levels[0].iter().map(Entry::tie).collect();
    let names = range_of(&teller.levels[0]);
    let lifted = if net.rational { ", in homogeneous coordinates" } else { "" };
    teller.tell(
        format!(
            "{place} The derivative there is made of the differences of the control points {names}{lifted}."
        ),
        formula,
        ties.clone(),
        ties,
    );
    for position in 0..n {
        let entry = &teller.levels[1][position];
        let (left, right) = (&teller.levels[0][position], &teller.levels[0][position + 1]);
        let k = span - n + 1 + position;
        let caption = format!(
            "The leg from {} to {}, times the degree, divided by the {} knot intervals from {} to {}, is {}.",
            left.plain_label,
            right.plain_label,
            n,
            short_number(knots[k]),
            short_number(knots[k + n]),
            entry.plain_label
        );
        let formula = format!(
            "{} = {n} \\frac{{{} - {}}}{{{}}} = {}",
            entry.label,
            homogeneous_label(right),
            homogeneous_label(left),
            difference(knots[k + n], knots[k]),
            formula_point(&entry.coordinates)
        );
        let (at, ties) = (entry.at, vec![left.tie(), right.tie(), entry.tie()]);
        teller.tell(caption, formula, vec![(1, position)], ties);
        if let Some(at) = at {
            teller.draw(|drawing| drawing.arrow(point, at, StepInk::First, 1.8));
        }
    }
    for level in 2..=n {
        for position in 0..=n - level {
            let low = span - n + level + position;
            let shares = Shares::Fraction { at: t, low: knots[low], high: knots[low + n + 1 - level] };
            teller.tell_mixture((level, position), &shares);
        }
    }
}

fn close(teller: &mut Teller, net: &Net, (point, derivative): (DVec2, DVec2), scale: f64) {
    let n = teller.levels.len() - 1;
    let top = &teller.levels[n][0];
    let value = formula_point(&derivative.to_array());
    let formula = match top.coordinates[..] {
        [x, y, w] => format!(
            "r' = \\frac{{p' - q' r}}{{q}}, \\quad p' = {}, \\quad q' = {}, \\quad r' = {value}",
            formula_point(&[x, y]),
            formula_number(w)
        ),
        _ => format!("p' = {} = {value}", top.label),
    };
    let quotient = if net.rational { " by the rule of the quotient" } else { "" };
    let caption = format!(
        "The derivative is {}{quotient}, its length, the speed, {}. The vectors are drawn {} times as long as they are.",
        short_point(&derivative.to_array()),
        short_number(derivative.length()),
        short_number(scale)
    );
    teller.tell(caption, formula, Vec::new(), vec![(n, 0)]);
    teller.draw(|drawing| drawing.arrow(point, point + derivative * scale, StepInk::Result, 2.4));
    teller.tangent = Some(derivative);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Side;
    use crate::course::stepper::samples::{all_curves, polynomial_curves};

    #[test]
    fn the_last_vector_is_the_derivative() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            for share in [0.0, 0.29, 0.64] {
                let t = left + share * (right - left);
                let expected = curve.derivatives(t, 1, Side::Right).unwrap()[1];
                let found = story(&curve, t).unwrap().tangent().unwrap();
                assert!(
                    found.distance(expected) < 1e-9 * expected.length().max(1.0),
                    "t = {t}: {found}, {expected}"
                );
            }
        }
    }

    #[test]
    fn the_differences_are_the_coefficients_of_the_derivative() {
        for curve in polynomial_curves() {
            let (left, right) = curve.space().parameter_interval();
            let t = left + 0.29 * (right - left);
            let Ok(derivative) = curve.without_weights().derivative() else { continue };
            let stepper = story(&curve, t).unwrap();
            for entry in &stepper.levels()[1] {
                let found = DVec2::new(entry.coordinates[0], entry.coordinates[1]);
                let near =
                    derivative.coefficients().iter().any(|c| c.distance(found) < 1e-9 * c.length().max(1.0));
                assert!(near, "{} = {found} is no coefficient of the derivative", entry.label);
            }
        }
    }

    #[test]
    fn arrows_point_along_the_tangent() {
        for curve in all_curves() {
            let stepper = story(&curve, curve.space().parameter_interval().0 + 0.7).unwrap();
            let arrow = &stepper.frames().last().unwrap().drawing.lines[0].points;
            let along = (arrow[1] - arrow[0]).normalize();
            let across = along.perp_dot(stepper.tangent().unwrap().normalize());
            assert!(across.abs() < 1e-9 && along.dot(stepper.tangent().unwrap()) > 0.0, "{across}");
        }
    }
}
