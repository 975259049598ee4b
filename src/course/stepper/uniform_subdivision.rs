//! Uniform subdivision: every control point is doubled, then `n` times neighbours are averaged.
//!
//! The result is the control polygon over half the knot distance. Course: section 6.3.

use glam::{DVec2, DVec3};

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::stepper::entry::Parent;
use crate::course::stepper::narration::{Name, Shares, counted, mixture, sentence};
use crate::course::stepper::teller::{Net, Teller};
use crate::course::stepper::{Entry, Frame, Look, Stepper, StepperKind, Tie};
use crate::figure::composition::{StepDrawing, StepInk};

/// More control points than this have no place in a table.
const MOST_POINTS: usize = 100;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let t = curve.space().reduce(t).map_err(|error| sentence(&error))?;
    let (n, count, closed) = (curve.degree(), curve.points().len(), curve.space().is_periodic());
    if count > MOST_POINTS {
        return Err(format!("The curve has {count} control points; the table has room for {MOST_POINTS}."));
    }
    // Knots of a closed curve are named as they stand in its period.
    let named = |knot: f64| short_number(curve.space().reduce(knot).unwrap_or(knot)).replace('-', "\u{2212}");
    let refined = net.spline.subdivide_uniform().map_err(|error| match error {
        SplineError::KnotsNotUniform { value, expected, .. } => format!(
            "The knots are not equally spaced: there is one at {} instead of {}. Uniform subdivision needs equal distances{}.",
            named(value),
            named(expected),
            if closed { "" } else { ", of the outer knots too" }
        ),
        other => sentence(&other),
    })?;
    let look = Look { joined: true, closed, depth: 2 };
    let mut teller = Teller { look, ..Teller::default() };
    teller.row((0..count).map(|k| net.control_point(k)).collect());
    let mut values: Vec<DVec3> = net.spline.coefficients().iter().flat_map(|&c| [c, c]).collect();
    let double = |k: usize| Entry {
        parents: vec![Parent { tie: (0, k / 2), factor: 1.0 }],
        ..Entry::homogeneous(Name::new('c', k, Some(0)), values[k], net.rational)
    };
    teller.row((0..2 * count).map(double).collect());
    for round in 1..=n {
        // Entry k is the mean of k − 1 and k; an open polygon loses its first point.
        let previous = std::mem::take(&mut values);
        let length = previous.len();
        let pairs = if closed { length } else { length - 1 };
        let pair = |i: usize| if closed { ((i + length - 1) % length, i) } else { (i, i + 1) };
        values = (0..pairs).map(|i| previous[pair(i).0].mix(previous[pair(i).1], 0.5)).collect();
        let first = if closed { 0 } else { round };
        let entry = |(i, &value): (usize, &DVec3)| {
            let parent = |position| Parent { tie: (round, position), factor: 0.5 };
            Entry {
                parents: vec![parent(pair(i).0), parent(pair(i).1)],
                share: Some(0.5),
                ..Entry::homogeneous(Name::new('c', first + i, Some(round)), value, net.rational)
            }
        };
        let entries = values.iter().enumerate().map(entry).collect();
        teller.row(entries);
    }
    tell(&mut teller, n);
    let polygon = net.polygon(&refined);
    let points = counted(refined.coefficients().len(), "control point");
    let caption = format!(
        "After {} this is the control polygon over half the knot distance: {points} of the same curve.",
        counted(n, "round")
    );
    teller.tell(caption, formula_of_mask(n), Vec::new(), Vec::new());
    teller.draw(|drawing| drawing.line(polygon, StepInk::Result, 2.4));
    Ok(teller.end(StepperKind::UniformSubdivision, t, (n + 1, 0)))
}

fn tell(teller: &mut Teller, n: usize) {
    let ties = |row: &[Entry]| -> Vec<Tie> { row.iter().map(Entry::tie).collect() };
    let frame = |caption: String, formula: String, ties: Vec<Tie>| Frame {
        caption,
        formula,
        reveals: ties.clone(),
        highlights: ties,
        drawing: StepDrawing::default(),
    };
    let caption = format!("{}, over equally spaced knots.", counted(teller.levels[0].len(), "control point"));
    teller.frames.push(frame(caption, format!("n = {n}"), ties(&teller.levels[0])));
    let caption = "Every control point is taken twice.".to_owned();
    let formula = "c_{2k}^0 = c_{2k+1}^0 = c_k".to_owned();
    teller.frames.push(frame(caption, formula, ties(&teller.levels[1])));
    for round in 1..=n {
        let row = &teller.levels[round + 1];
        let middle = &row[row.len() / 2];
        let parent = |i: usize| {
            let (level, position) = middle.parents[i].tie;
            &teller.levels[level][position]
        };
        let (_, formula) = mixture(middle, parent(0), parent(1), &Shares::Number(0.5));
        let caption = format!("Round {round} of {n}: every point and the one before it give their midpoint.");
        teller.frames.push(frame(caption, formula, ties(row)));
    }
}

/// The mask `2⁻ⁿ C(n + 1, j)` that the rounds amount to.
fn formula_of_mask(n: usize) -> String {
    format!("c_k^{{{n}}} = \\sum_i s_{{k-2i}} c_i, \\quad s_j = 2^{{-{n}}} \\binom{{{}}}{{j}}", n + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{bezier, uniform, uniform_closed};

    #[test]
    fn the_last_row_is_the_subdivided_polygon() {
        let mut curves = Vec::new();
        for degree in 1..=12 {
            curves.push(uniform(degree, degree + 4, false));
            curves.push(uniform(degree, degree + 1, true));
            curves.push(uniform_closed(degree, 4));
        }
        for curve in curves {
            let refined = curve.subdivide_uniform().unwrap();
            let stepper = story(&curve, curve.space().parameter_interval().0).unwrap();
            let row = stepper.levels().last().unwrap();
            assert_eq!(row.len(), refined.points().len(), "as many points");
            for (entry, expected) in row.iter().zip(refined.points()) {
                let found = entry.at.unwrap();
                assert!(found.distance(*expected) < 1e-11, "degree {}: {found}, {expected}", curve.degree());
            }
            assert_eq!(
                stepper.frames().len(),
                3 + curve.degree(),
                "points, doubling, a frame for each round, the result"
            );
        }
    }

    #[test]
    fn unequal_knots_are_refused_with_the_first_of_them() {
        let refused = story(&bezier(), 0.5).unwrap_err();
        assert!(
            refused.contains("one at 0 instead of") && refused.contains("not equally spaced"),
            "{refused}"
        );
    }
}
