//! Whether a command can be carried out now, and whether what it switches is on. Menu and palette show both.

use eframe::egui::Context;

use crate::app::chart_panel;
use crate::app::command::Command;
use crate::app::lab::{Lab, Tool};
use crate::app::side_rooms::SideRoom;
use crate::app::surfaces::commands as surfaces;
use crate::app::workspace::Room;
use crate::app::{KNOT_LINE, LEFT_PANEL, RIGHT_PANEL};
use crate::document::{CurveDisplay, MembraneDisplay};
use crate::figure::composition::GRID;

/// Largest degree of a curve in the window.
const HIGHEST_DEGREE: usize = 12;

/// The key of `command` for people: `Ctrl+Shift+S`, `]`.
pub(crate) fn key_text(command: Command, ctx: &Context) -> Option<String> {
    let text = ctx.format_shortcut(&command.shortcut()?);
    let (before, key) = match text.rfind('+') {
        Some(plus) => text.split_at(plus + 1),
        None => ("", text.as_str()),
    };
    let sign = match key {
        "OpenBracket" => "[",
        "CloseBracket" => "]",
        "Period" => ".",
        "Comma" => ",",
        "PageUp" => "Page up",
        "PageDown" => "Page down",
        other => other,
    };
    Some(format!("{before}{sign}"))
}

/// Whether `command` has something to work on.
pub(crate) fn is_possible(command: Command, lab: &Lab) -> bool {
    if command.room().is_some_and(|room| room != lab.room()) {
        return false;
    }
    if lab.room() == Room::Surfaces && (command.room().is_some() || command == Command::SelectAll) {
        return surfaces::is_possible(command, lab);
    }
    match command {
        Command::BackToExample => lab.lesson.is_some(),
        Command::ExportFrames | Command::ExportChart | Command::ToggleCharts => lab.curve().is_some(),
        Command::Undo => lab.undo_name().is_some(),
        Command::Redo => lab.redo_name().is_some(),
        Command::ExportFigure => !lab.history.document().is_empty(),
        Command::Delete | Command::Duplicate => lab.selection.object.is_some(),
        Command::RemoveKnot => lab.curve().is_some() && lab.selection.knot.is_some(),
        Command::ElevateDegree => lab.curve().is_some_and(|curve| curve.degree() < HIGHEST_DEGREE),
        Command::ReduceDegree => lab.curve().is_some_and(|curve| curve.degree() > 1),
        Command::JoinCurves => crate::app::curves::nearest_other(lab).is_some(),
        Command::InterpolateEnds => lab.curve().is_some_and(|curve| !curve.space().is_periodic()),
        Command::ResetWeights => lab.curve().is_some_and(|curve| !curve.is_polynomial()),
        Command::SelectAll => {
            lab.curve().is_some() || lab.approximation().is_some() || problem(lab).is_some()
        }
        Command::ExportData => lab.approximation().is_some_and(|data| !data.is_empty()),
        Command::CycleErrorPlot => lab.approximation().is_some(),
        Command::SampleFunction => lab.approximation().is_some_and(|data| data.function().is_some()),
        Command::ToggleField
        | Command::ToggleIsolines
        | Command::ToggleNodes
        | Command::ToggleCells
        | Command::ToggleQuadrature
        | Command::RefineElements
        | Command::CoarsenElements
        | Command::RaiseElementDegree
        | Command::LowerElementDegree => problem(lab).is_some(),
        Command::AlignX | Command::AlignY => lab.curve().is_some() && lab.selection.points.len() > 1,
        Command::AlignGrid => lab.curve().is_some() && !lab.selection.points.is_empty(),
        Command::Distribute => lab.curve().is_some() && lab.selection.points.len() > 2,
        Command::RemoveKnotsWithin
        | Command::NextKnot
        | Command::PreviousKnot
        | Command::UniformKnots
        | Command::EndInterpolatingKnots
        | Command::ChordLengthKnots
        | Command::CentripetalKnots
        | Command::AveragedKnots
        | Command::ToggleBuilder
        | Command::ToggleEditPoints
        | Command::ToggleWeightPoints
        | Command::InsertKnot
        | Command::RefineUniformly
        | Command::ToggleClosed
        | Command::Reverse
        | Command::SplitCurve
        | Command::TrimBefore
        | Command::TrimAfter
        | Command::Trim
        | Command::BezierForm
        | Command::TransformCurve
        | Command::OffsetCurve
        | Command::TogglePolygon
        | Command::ToggleComb
        | Command::ToggleConstruction
        | Command::CycleLabels
        | Command::ToggleHull
        | Command::ToggleCircle
        | Command::ToggleFrame
        | Command::ToggleHodograph
        | Command::ToggleBezierPoints
        | Command::ToggleBlossomLabels
        | Command::ToggleDistanceTube
        | Command::ToggleInflections
        | Command::ToggleVertices
        | Command::ToggleSymmetry
        | Command::ToggleProbeLine
        | Command::StepperPlay
        | Command::StepForward
        | Command::StepBack
        | Command::NextAlgorithm
        | Command::PreviousAlgorithm => lab.curve().is_some(),
        _ => true,
    }
}

/// How the selected boundary value problem is shown.
fn problem(lab: &Lab) -> Option<&MembraneDisplay> {
    let object = lab.history.document().object(lab.selection.object?)?;
    object.membrane().map(|(_, display)| display)
}

/// Whether what `command` switches is on; `None` for a command that switches nothing.
pub(crate) fn is_on(command: Command, lab: &Lab) -> Option<bool> {
    let panel = |name: &str| lab.view.panels.get(name).copied().unwrap_or(true);
    let display = |choice: fn(&CurveDisplay) -> bool| {
        let object = lab.selection.object.and_then(|id| lab.history.document().object(id));
        object.and_then(|object| object.curve_display()).is_some_and(choice)
    };
    let field = |choice: fn(&MembraneDisplay) -> bool| problem(lab).is_some_and(choice);
    Some(match command {
        Command::ToggleField => field(|display| display.fill),
        Command::ToggleIsolines => field(|display| display.isolines > 0),
        Command::ToggleNodes => field(|display| display.nodes),
        Command::ToggleCells => field(|display| display.cells),
        Command::ToggleQuadrature => field(|display| display.quadrature),
        Command::SelectTool => lab.tool == Tool::Select,
        Command::DrawTool
        | Command::DrawThrough
        | Command::DrawStroke
        | Command::DrawCircle
        | Command::DrawArc
        | Command::DrawEllipse
        | Command::DrawConic
        | Command::DrawConicFive => lab.tool == Tool::Draw && lab.draw_mode.command() == command,
        Command::ToggleEditPoints => lab.edit_points,
        Command::ToggleWeightPoints => lab.weight_points,
        Command::SelectDataTool => lab.tool != Tool::AddPoint,
        Command::AddPointTool => lab.tool == Tool::AddPoint,
        Command::ToggleGrid => panel(GRID),
        Command::TogglePolygon => display(|display| display.polygon),
        Command::ToggleComb => display(|display| display.comb),
        Command::ToggleConstruction => display(|display| display.construction),
        Command::ToggleHull => display(|display| display.hull),
        Command::ToggleCircle => display(|display| display.osculating_circle),
        Command::ToggleFrame => display(|display| display.frame),
        Command::ToggleHodograph => display(|display| display.hodograph),
        Command::ToggleBezierPoints => display(|display| display.bezier_points),
        Command::ToggleBlossomLabels => display(|display| display.blossom_labels),
        Command::ToggleDistanceTube => display(|display| display.distance_tube),
        Command::ToggleInflections => display(|display| display.inflections),
        Command::ToggleVertices => display(|display| display.vertices),
        Command::ToggleSymmetry => display(|display| display.symmetry),
        Command::ToggleProbeLine => display(|display| display.probe_line),
        Command::ToggleLeftPanel => panel(LEFT_PANEL),
        Command::ToggleRightPanel => panel(RIGHT_PANEL),
        Command::ToggleKnotLine => panel(KNOT_LINE),
        Command::ToggleCharts => chart_panel::is_open(lab),
        Command::ToggleKeepCurve => lab.knots.keep_curve,
        Command::ToggleBuilder => lab.knots.builder.is_some(),
        Command::ShowConic => lab.rooms.shows(SideRoom::Conic),
        Command::ShowHomogeneous => lab.rooms.shows(SideRoom::Homogeneous),
        Command::ShowHermite => lab.rooms.shows(SideRoom::Hermite),
        Command::LookLight => lab.theme.name == "light",
        Command::LookDark => lab.theme.name == "dark",
        Command::LookPresentation => lab.theme.name == "presentation",
        Command::ToggleClosed => lab.curve().is_some_and(|curve| curve.space().is_periodic()),
        _ => return surfaces::is_on(command, lab),
    })
}
