//! What commands, menus and keys do to the knots of the selected curve.

use eframe::egui::Ui;

use crate::app::hands::arrow_keys;
use crate::app::knot_line::hand::Stack;
use crate::app::knot_line::note::reason;
use crate::app::lab::Lab;
use crate::app::number_text::{round_to_step, short};
use crate::core::spline_curve::KnotRule;
use crate::document::{Edit, ShapeChange};

/// `edit` with what shall stay: the control points, or the curve.
pub(super) fn kept(lab: &Lab, edit: Edit) -> Edit {
    if lab.knots.keep_curve { Edit::KeepCurve { edit: Box::new(edit) } } else { edit }
}

/// The knots of `rule` for the selected curve.
pub(crate) fn generate(lab: &mut Lab, rule: KnotRule) {
    if let Some(object) = lab.selection.object {
        lab.edit(kept(lab, Edit::GenerateKnots { object, rule }));
    }
}

/// Removes knots within the chosen tolerance and says how many went.
pub(crate) fn remove_within(lab: &mut Lab) {
    let (Some(object), Some(before)) = (lab.selection.object, lab.curve().map(|curve| curve.points().len()))
    else {
        return;
    };
    let tolerance = lab.knots.tolerance;
    let Some(outcome) = lab.edit(Edit::RemoveKnotsWithin { object, tolerance }) else { return };
    let gone = before - lab.curve().map_or(before, |curve| curve.points().len());
    let text = match (gone, outcome.shape) {
        (0, _) => format!("No knot can go within {}", short(tolerance)),
        (1, ShapeChange::Changed { deviation: Some(deviation), .. }) => {
            format!("1 knot removed, certified deviation at most {deviation:.1e}")
        }
        (_, ShapeChange::Changed { deviation: Some(deviation), .. }) => {
            format!("{gone} knots removed, certified deviation at most {deviation:.1e}")
        }
        _ => format!("{gone} knots removed"),
    };
    lab.shape_note = Some(text.clone());
    lab.done(text);
}

/// Selects the next distinct knot to the right or to the left of the selected one, else of t.
pub(crate) fn select_neighbour(lab: &mut Lab, forward: bool) {
    let Some((object, curve)) = lab.selection.object.zip(lab.curve()) else { return };
    let from = lab.selection.knot.or_else(|| lab.parameter(object)).unwrap_or(0.0);
    let mut knots = curve.space().knots().to_vec();
    knots.dedup();
    let next = if forward {
        knots.iter().find(|&&knot| knot > from).or(knots.first())
    } else {
        knots.iter().rfind(|&&knot| knot < from).or(knots.last())
    };
    lab.selection.knot = next.copied();
    lab.selection.points.clear();
}

/// Spreads the copies of a stack over the middle of the room that they have, in equal distances.
pub(super) fn pull_apart(lab: &mut Lab, stack: &Stack) {
    let Some((object, curve)) = lab.selection.object.zip(lab.curve()) else { return };
    let space = curve.space();
    let (left, right) = space.parameter_interval();
    let count = stack.multiplicity as isize;
    let before = space.knot(stack.first - 1).unwrap_or(left);
    let after = space.knot(stack.first + count).unwrap_or(right);
    let room = (stack.value - before).min(after - stack.value);
    let mut knots = space.knots().to_vec();
    for copy in 0..count {
        let Some(knot) = knots.get_mut((stack.first + copy).max(0) as usize) else { return };
        *knot = stack.value + room * ((copy as f64 + 0.5) / count as f64 - 0.5);
    }
    lab.edit(kept(lab, Edit::SetKnots { object, knots }));
}

/// Left and right arrow move one copy of the selected knot by a hundredth of D, rounded; up adds a copy, down removes one.
pub(super) fn arrows(lab: &mut Lab, ui: &Ui) {
    let Some(knot) = lab.selection.knot.filter(|_| lab.selection.points.is_empty()) else { return };
    let Some((object, curve)) = lab.selection.object.zip(lab.curve()) else { return };
    if lab.history.is_interacting() {
        return;
    }
    let space = curve.space();
    let (left, right) = space.parameter_interval();
    let hundredth = 0.01 * (right - left);
    let unit = 10.0_f64.powf(hundredth.log10().floor());
    let knots = space.knots();
    let first = knots.partition_point(|&other| other < knot);
    let last = knots.partition_point(|&other| other <= knot).saturating_sub(1);
    let (low, high) = (space.knot(first as isize - 1), space.knot(last as isize + 1));
    for (direction, factor) in arrow_keys(ui) {
        let (edit, to) = if direction.y > 0.0 {
            (Edit::InsertKnot { object, at: knot }, knot)
        } else if direction.y < 0.0 {
            (Edit::RemoveKnot { object, at: knot }, knot)
        } else {
            let step = unit * factor;
            let wanted = round_to_step(knot + direction.x * step, step);
            let to = wanted.max(low.unwrap_or(f64::NEG_INFINITY)).min(high.unwrap_or(f64::INFINITY));
            let index = if direction.x > 0.0 { last } else { first };
            (kept(lab, Edit::MoveKnot { object, knot: index, to }), to)
        };
        match lab.history.apply(edit) {
            Ok(outcome) => {
                lab.shape_note = outcome.shape.sentence();
                lab.selection.knot = Some(to);
                lab.tidy_selection();
            }
            Err(error) => {
                let reason = reason(&error);
                lab.shape_note = Some(reason.clone());
                lab.problem(reason);
            }
        }
    }
}
