//! What keys and menus do to the selected curve.

use std::collections::BTreeSet;

use eframe::egui::Ui;
use glam::DVec2;

use crate::app::command::Command;
use crate::app::hands;
use crate::app::lab::Lab;
use crate::document::{CurveDisplay, Edit, ObjectId, PointLabels};
use crate::figure::picture::Viewport;

/// Arrow keys move the selected points.
pub(super) fn nudge(lab: &mut Lab, viewport: &Viewport, ui: &Ui) {
    if lab.selection.points.is_empty() {
        return;
    }
    let Some(object) = lab.selection.object else { return };
    for delta in hands::nudges(viewport, ui) {
        let points = lab.selection.points.iter().copied().collect();
        lab.edit(Edit::MovePoints { object, points, delta });
    }
}

pub(super) fn delete(lab: &mut Lab) {
    let Some(object) = lab.selection.object else { return };
    if let Some(at) = lab.selection.knot.take() {
        lab.edit(Edit::RemoveKnot { object, at });
    } else if lab.selection.points.is_empty() {
        lab.edit(Edit::RemoveObjects { objects: vec![object] });
    } else {
        let points = std::mem::take(&mut lab.selection.points).into_iter().collect();
        lab.edit(Edit::DeletePoints { object, points });
    }
}

/// A further control point, which is then selected.
pub(super) fn insert_point(object: ObjectId, before: usize, position: DVec2, lab: &mut Lab) {
    if lab.edit(Edit::InsertPoint { object, before, position }).is_some() {
        lab.selection.points = BTreeSet::from([before]);
        lab.selection.knot = None;
    }
}

/// Commands that edit the selected curve or its display.
pub(super) fn edit_selected(command: Command, lab: &mut Lab) -> bool {
    let Some(object) = lab.selection.object else { return false };
    let Some(found) = lab.history.document().object(object) else { return false };
    let Some(mut display) = found.curve_display().cloned() else { return false };
    let mut change = |change: fn(&mut CurveDisplay)| {
        change(&mut display);
        Edit::SetDisplay { object, display: display.clone() }
    };
    let curve = lab.history.document().curve(object);
    let edit = match command {
        Command::TogglePolygon => change(|display| display.polygon = !display.polygon),
        Command::ToggleComb => change(|display| display.comb = !display.comb),
        Command::ToggleConstruction => change(|display| display.construction = !display.construction),
        Command::ToggleHull => change(|display| display.hull = !display.hull),
        Command::ToggleCircle => change(|display| display.osculating_circle = !display.osculating_circle),
        Command::ToggleFrame => change(|display| display.frame = !display.frame),
        Command::ToggleHodograph => change(|display| display.hodograph = !display.hodograph),
        Command::ToggleBezierPoints => change(|display| display.bezier_points = !display.bezier_points),
        Command::ToggleBlossomLabels => change(|display| display.blossom_labels = !display.blossom_labels),
        Command::ToggleDistanceTube => change(|display| display.distance_tube = !display.distance_tube),
        Command::ToggleInflections => change(|display| display.inflections = !display.inflections),
        Command::ToggleVertices => change(|display| display.vertices = !display.vertices),
        Command::ToggleSymmetry => change(|display| display.symmetry = !display.symmetry),
        Command::ToggleProbeLine => change(|display| display.probe_line = !display.probe_line),
        Command::CycleLabels => change(|display| {
            display.labels = match display.labels {
                PointLabels::None => PointLabels::Index,
                PointLabels::Index => PointLabels::Weight,
                PointLabels::Weight => PointLabels::Coordinates,
                PointLabels::Coordinates => PointLabels::None,
            }
        }),
        Command::Duplicate => Edit::DuplicateObject { object },
        Command::InsertKnot => match lab.parameter(object) {
            Some(at) => Edit::InsertKnot { object, at },
            None => return true,
        },
        Command::RemoveKnot => match lab.selection.knot {
            Some(at) => Edit::RemoveKnot { object, at },
            None => {
                lab.problem(
                    "Select a knot first: click its diamond on the curve or its handle on the knot line.",
                );
                return true;
            }
        },
        Command::ElevateDegree => Edit::ElevateDegree { object },
        Command::ReduceDegree => Edit::ReduceDegree { object },
        Command::ToggleClosed => {
            let closed = curve.is_some_and(|curve| curve.space().is_periodic());
            Edit::SetClosed { object, closed: !closed }
        }
        Command::Reverse => Edit::Reverse { object },
        Command::ResetWeights => {
            let count = curve.map_or(0, |curve| curve.points().len());
            Edit::SetWeights { object, weights: vec![1.0; count] }
        }
        _ => return false,
    };
    if let Some(outcome) = lab.edit(edit)
        && let Some(&created) = outcome.created.first()
    {
        lab.selection.object = Some(created);
    }
    true
}
