//! Knot insertion: some legs of the control polygon are divided, and their corner points give way.
//!
//! `c̃ₖ = γ cₖ + (1 − γ) cₖ₋₁` with `γ = (t − ξₖ)/(ξₖ₊ₙ − ξₖ)` for the `n − μ` legs around the new knot. Course: section 6.3.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{formula_number, short_number};
use crate::course::stepper::narration::{
    Name, Shares, counted, multiplicity_word, overlap, range_of, sentence,
};
use crate::course::stepper::teller::{Net, Teller};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};
use crate::figure::composition::StepInk;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let (n, space) = (curve.degree(), curve.space());
    let t = space.reduce(t).map_err(|error| sentence(&error))?;
    let present = space.multiplicity(t);
    if present >= n {
        return Err(format!(
            "t = {} is already {} knot, as often as degree {n} allows: move t to insert a knot elsewhere.",
            short_number(t),
            multiplicity_word(present)
        ));
    }
    overlap(space, n - present)?;
    let scheme = net.spline.insertion_scheme(t, 1).map_err(|error| sentence(&error))?;
    let refined = net.spline.insert_knot(t).map_err(|error| sentence(&error))?;
    let (span, knots) = (scheme.span, space.evaluation_knots());
    let mut teller = Teller::default();
    teller.row(net.active(span, n + 1 - present));
    teller.scheme(&scheme.triangle, net.rational, |_, position| {
        Name::new('c', space.coefficient_index(span - n + 1 + position), Some(1))
    });
    let ties: Vec<Tie> = teller.levels[0].iter().map(Entry::tie).collect();
    let again = match present {
        0 => String::new(),
        _ => format!(" It is {} knot already.", multiplicity_word(present)),
    };
    let caption = format!(
        "The new knot is t = {}.{again} Only the legs of {} are divided, {}.",
        short_number(t),
        range_of(&teller.levels[0]),
        counted(n - present, "new point")
    );
    let formula = format!(
        "c_k^1 = \\gamma_k c_k + (1-\\gamma_k) c_{{k-1}}, \\quad \\gamma_k = \\frac{{{} - \\xi_k}}{{\\xi_{{k+{n}}} - \\xi_k}}",
        formula_number(t)
    );
    teller.tell(caption, formula, ties.clone(), ties);
    for position in 0..n - present {
        let k = span - n + 1 + position;
        teller.tell_mixture((1, position), &Shares::Fraction { at: t, low: knots[k], high: knots[k + n] });
    }
    let new: Vec<Tie> = teller.levels[1].iter().map(Entry::tie).collect();
    let count = counted(refined.coefficients().len(), "control point");
    let caption = if refined.coefficients().len() == curve.points().len() {
        format!(
            "At an end of the curve the outermost point and knot are dropped: {count} as before, and the curve is the same."
        )
    } else {
        let replaced = counted(n - present - 1, "point");
        format!(
            "The new points take the place of the {replaced} between them: {count} over one knot more, and the curve is the same."
        )
    };
    let names: Vec<&str> = teller.levels[1].iter().map(|entry| entry.label.as_str()).collect();
    teller.tell(caption, names.join(",\\; "), Vec::new(), new);
    let polygon = net.polygon(&refined);
    teller.draw(|drawing| drawing.line(polygon, StepInk::Result, 2.4));
    let place = curve.evaluate(t).map_err(|error| sentence(&error))?;
    for frame in &mut teller.frames {
        frame.drawing = std::mem::take(&mut frame.drawing).dot(place, StepInk::Second, 7.0, None);
    }
    Ok(teller.end(StepperKind::KnotInsertion, t, (1, 0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{all_curves, bezier};

    #[test]
    fn the_new_points_are_those_of_insert_knot() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            let mut knots = curve.space().breaks();
            knots.extend([0.0, 0.31, 0.77].map(|share| left + share * (right - left)));
            for t in knots {
                let (stepper, refined) = match (story(&curve, t), curve.insert_knot(t)) {
                    (Ok(stepper), Ok(refined)) => (stepper, refined),
                    (told, inserted) => {
                        let overlaps = curve.space().is_periodic() && curve.degree() > curve.points().len();
                        assert!(told.is_err() && (inserted.is_err() || overlaps), "t = {t}: both or none");
                        continue;
                    }
                };
                let line = &stepper.frames().last().unwrap().drawing.lines[0].points;
                for (found, expected) in line.iter().zip(refined.points()) {
                    assert!(found.distance(*expected) < 1e-10, "t = {t}: {found}, {expected}");
                }
                // At an end of an open curve the outermost new point is dropped with its knot.
                let at_end = !curve.space().is_periodic() && (t <= left || t >= right);
                for entry in stepper.levels()[1].iter().filter(|_| !at_end) {
                    let found = entry.at.unwrap();
                    let near = refined.points().iter().any(|point| point.distance(found) < 1e-10);
                    assert!(near, "t = {t}: {} = {found} is no new control point", entry.label);
                }
            }
        }
    }

    #[test]
    fn a_full_knot_is_refused_with_its_multiplicity() {
        let refused = story(&bezier(), 0.0).unwrap_err();
        assert!(refused.contains("a triple knot"), "{refused}");
    }
}
