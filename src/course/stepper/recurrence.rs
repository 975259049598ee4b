//! The recurrence of B-splines at one parameter, from degree 0 to `n`.
//!
//! `bʲₖ = (t − ξₖ)/(ξₖ₊ⱼ − ξₖ) bʲ⁻¹ₖ + (ξₖ₊ⱼ₊₁ − t)/(ξₖ₊ⱼ₊₁ − ξₖ₊₁) bʲ⁻¹ₖ₊₁`. In the plane the value `bʲₖ` is the size of the point
//! `pⁿ⁻ʲₖ` of de Boor's scheme: `Σₖ bʲₖ pⁿ⁻ʲₖ` is the same point of the curve for every `j`. Course: section 4.1.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{formula_number, formula_operand, formula_point, short_number};
use crate::course::stepper::entry::Parent;
use crate::course::stepper::narration::{Name, difference, place_in_interval, sentence};
use crate::course::stepper::teller::{Net, Teller};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};
use crate::figure::composition::StepInk;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let scheme = net.spline.de_boor_scheme(t).map_err(|error| sentence(&error))?;
    let (n, space, span, t) = (curve.degree(), curve.space(), scheme.span, scheme.parameter);
    let (knots, index) = (space.evaluation_knots(), |k: usize| space.coefficient_index(k));
    let triangle = space.basis_triangle(t).map_err(|error| sentence(&error))?;
    let mut teller = Teller::default();
    for (j, values) in triangle.levels.iter().enumerate() {
        let entry = |(position, &value): (usize, &f64)| {
            let k = span - j + position;
            let mut entry = Entry::numbers(Name::new('b', index(k), Some(j)), &[value]);
            let mut parent = |position: usize, low: usize, above: f64| {
                let factor = above / (knots[low + j] - knots[low]);
                entry.parents.push(Parent { tie: (j - 1, position), factor });
            };
            if position > 0 {
                parent(position - 1, k, t - knots[k]);
            }
            if position < j {
                parent(position, k + 1, knots[k + j + 1] - t);
            }
            entry.partners = (k + j - n..=k).map(index).collect();
            entry.at = Some(net.place(scheme.triangle.levels()[n - j][position])).filter(|at| at.is_finite());
            entry.size = 0.6 + 2.4 * value.max(0.0).sqrt();
            entry
        };
        let entries = values.iter().enumerate().map(entry).collect();
        teller.row(entries);
    }
    let (place, formula) = place_in_interval(t, knots[span], knots[span + 1]);
    let name = teller.levels[0][0].plain_label.clone();
    let caption = format!(
        "{place} Of degree 0 only {name} is not zero there, and it is 1. The size of a disc shows a value."
    );
    teller.tell(caption, formula, vec![(0, 0)], vec![(0, 0)]);
    for j in 1..=n {
        for position in 0..=j {
            step(&mut teller, (j, position), span - j + position, knots, t);
        }
    }
    close(&mut teller, curve, t)?;
    Ok(teller.end(StepperKind::Recurrence, t, (n, 0)))
}

/// One new value, from one or two of the degree below; `k` counts the knots.
fn step(teller: &mut Teller, tie: Tie, k: usize, knots: &[f64], t: f64) {
    let entry = &teller.levels[tie.0][tie.1];
    let j = tie.0;
    let mut terms = Vec::new();
    let mut names = Vec::new();
    for parent in &entry.parents {
        let from = &teller.levels[parent.tie.0][parent.tie.1];
        let is_rising = parent.tie.1 + 1 == tie.1;
        let low = if is_rising { k } else { k + 1 };
        let (start, end) = (knots[low], knots[low + j]);
        let above = if is_rising { difference(t, start) } else { difference(end, t) };
        let value = formula_operand(from.coordinates[0]);
        terms.push(format!("\\frac{{{above}}}{{{}}} \\cdot {value}", difference(end, start)));
        let slope = if is_rising { "rising" } else { "falling" };
        names.push(format!("{} times a {slope} line", from.plain_label));
    }
    let caption = format!(
        "{} of degree {j} is {}{}.",
        entry.plain_label,
        names.join(" plus "),
        if names.len() == 1 { "; the other function of degree one less is zero here" } else { "" }
    );
    let formula =
        format!("{} = {} = {}", entry.label, terms.join(" + "), formula_number(entry.coordinates[0]));
    let mut highlights: Vec<Tie> = entry.parents.iter().map(|parent| parent.tie).collect();
    highlights.push(tie);
    teller.tell(caption, formula, vec![tie], highlights);
}

/// The last frame: the sum is 1, and the values are the shares of the control points.
fn close(teller: &mut Teller, curve: &Nurbs<DVec2>, t: f64) -> Result<(), String> {
    let row = &teller.levels[teller.levels.len() - 1];
    let sum: f64 = row.iter().map(|entry| entry.coordinates[0]).sum();
    let point = curve.evaluate(t).map_err(|error| sentence(&error))?;
    let sum = short_number(sum);
    let shares = if curve.is_polynomial() {
        "the point of the curve"
    } else {
        "the point of the curve in homogeneous coordinates"
    };
    let caption = format!(
        "The values of degree {} add up to {sum}. With them the control points mix to {shares}.",
        row.len() - 1
    );
    let formula = if curve.is_polynomial() {
        format!("p(t) = \\sum c_k b_k(t) = {}", formula_point(&point.to_array()))
    } else {
        format!(
            "r(t) = \\frac{{\\sum w_k c_k b_k(t)}}{{\\sum w_k b_k(t)}} = {}",
            formula_point(&point.to_array())
        )
    };
    let ties = row.iter().map(Entry::tie).collect();
    teller.tell(caption, formula, Vec::new(), ties);
    teller.draw(|drawing| drawing.dot(point, StepInk::Result, 10.0, None));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::basis_function;
    use crate::course::stepper::samples::{all_curves, polynomial_curves};

    #[test]
    fn every_value_is_the_b_spline_of_its_degree_and_every_row_adds_up_to_one() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            for share in [0.0, 0.37, 0.81] {
                let t = left + share * (right - left);
                let stepper = story(&curve, t).unwrap();
                let (knots, span) = (curve.space().evaluation_knots(), curve.space().span(t).unwrap());
                for (j, row) in stepper.levels().iter().enumerate() {
                    for (position, entry) in row.iter().enumerate() {
                        let k = span - j + position;
                        let expected = basis_function(j, &knots[k..=k + j + 1], t).unwrap();
                        assert!((entry.coordinates[0] - expected).abs() < 1e-12, "{} at {t}", entry.label);
                        let parents = entry.parents.iter().map(|parent| {
                            let (level, position) = parent.tie;
                            parent.factor * stepper.levels()[level][position].coordinates[0]
                        });
                        let mixed: f64 = if j == 0 { 1.0 } else { parents.sum() };
                        assert!(
                            (entry.coordinates[0] - mixed).abs() < 1e-12,
                            "{} from its parents",
                            entry.label
                        );
                    }
                    let sum: f64 = row.iter().map(|entry| entry.coordinates[0]).sum();
                    assert!((sum - 1.0).abs() < 1e-12, "degree {j}: {sum}");
                }
            }
        }
    }

    #[test]
    fn with_the_points_of_de_boor_every_row_gives_the_same_point() {
        for curve in polynomial_curves() {
            let (left, right) = curve.space().parameter_interval();
            let t = left + 0.43 * (right - left);
            let expected = curve.evaluate(t).unwrap();
            for row in story(&curve, t).unwrap().levels() {
                let point: DVec2 = row.iter().map(|entry| entry.at.unwrap() * entry.coordinates[0]).sum();
                assert!(point.distance(expected) < 1e-11, "row of {} values: {point}", row.len());
            }
        }
    }
}
