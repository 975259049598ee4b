//! Commands on the whole selected curve that need no numbers.

use glam::DVec2;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_text::short;
use crate::core::spline_curve::Nurbs;
use crate::document::{Edit, ObjectId};

/// What the context menu of a curve offers.
pub(super) const MENU: [Command; 8] = [
    Command::JoinCurves,
    Command::Trim,
    Command::Reverse,
    Command::RefineUniformly,
    Command::BezierForm,
    Command::InterpolateEnds,
    Command::TransformCurve,
    Command::OffsetCurve,
];

/// Carries out the commands of this file.
pub(super) fn execute(command: Command, lab: &mut Lab) -> bool {
    let Some(object) = lab.selection.object.filter(|_| lab.curve().is_some()) else { return false };
    match command {
        Command::SplitCurve => {
            if let Some(at) = lab.selection.knot.or_else(|| lab.parameter(object)) {
                split(object, at, lab);
            }
        }
        Command::TrimBefore | Command::TrimAfter => {
            if let Some(at) = lab.parameter(object) {
                trim_at(object, at, command == Command::TrimBefore, lab);
            }
        }
        Command::JoinCurves => match nearest_other(lab) {
            Some(other) => {
                lab.edit(Edit::JoinCurves { object, other });
            }
            None => lab.problem("Two open curves are needed: select one, the other may be anywhere."),
        },
        Command::BezierForm => {
            lab.edit(Edit::ToBezierForm { object });
        }
        Command::InterpolateEnds => {
            lab.edit(Edit::InterpolateEnds { object });
        }
        Command::RefineUniformly => refine(object, lab),
        _ => return false,
    }
    true
}

/// Cuts the curve; the part behind is then selected.
pub(super) fn split(object: ObjectId, at: f64, lab: &mut Lab) {
    if let Some(outcome) = lab.edit(Edit::SplitCurve { object, at }) {
        lab.selection.knot = None;
        lab.selection.points.clear();
        lab.selection.object = outcome.created.first().copied().or(Some(object));
    }
}

/// Keeps what lies before or after `at`.
pub(super) fn trim_at(object: ObjectId, at: f64, before: bool, lab: &mut Lab) {
    let Some(curve) = lab.history.document().curve(object) else { return };
    let (left, right) = curve.space().parameter_interval();
    let (from, to) = if before { (left, at) } else { (at, right) };
    lab.edit(Edit::TrimCurve { object, from, to });
}

/// One step of subdivision, and how much nearer the control polygon came.
fn refine(object: ObjectId, lab: &mut Lab) {
    let before = lab.curve().and_then(polygon_distance);
    if lab.edit(Edit::RefineUniformly { object }).is_some()
        && let Some((before, after)) = before.zip(lab.curve().and_then(polygon_distance))
        && let Some(note) = &mut lab.shape_note
    {
        note.push_str(&format!(" Distance of the control polygon: {} → {}", short(before), short(after)));
    }
}

/// How far a polynomial curve is from its control polygon, measured.
fn polygon_distance(curve: &Nurbs<DVec2>) -> Option<f64> {
    if !curve.is_polynomial() || curve.points().len() > 2000 {
        return None;
    }
    let found = curve.without_weights().polygon_distances().ok()?;
    Some(found.iter().map(|piece| piece.measured).fold(0.0, f64::max))
}

/// The other open curve with the end that is nearest to one of the selected open curve.
pub(crate) fn nearest_other(lab: &Lab) -> Option<ObjectId> {
    let document = lab.history.document();
    let ends = |curve: &Nurbs<DVec2>| {
        let (left, right) = curve.space().parameter_interval();
        let open = !curve.space().is_periodic();
        open.then(|| [curve.evaluate(left).ok(), curve.evaluate(right).ok()].into_iter().flatten().collect())
    };
    let mine: Vec<DVec2> = ends(lab.curve()?)?;
    let others =
        document.objects().iter().filter(|other| other.visible && Some(other.id) != lab.selection.object);
    let measured = others.filter_map(|other| {
        let theirs: Vec<DVec2> = ends(document.curve(other.id)?)?;
        let pairs = mine.iter().flat_map(|a| theirs.iter().map(|b| a.distance(*b)));
        Some((other.id, pairs.fold(f64::INFINITY, f64::min)))
    });
    measured.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
}
