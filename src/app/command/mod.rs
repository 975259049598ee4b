//! Everything that can be commanded: one enum gives menus, tooltips, shortcuts, the palette and the shortcut sheet.

mod keys;
mod menu;
mod text;

pub use menu::Menu;

/// A command without arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Command {
    /// A new, empty document.
    New,
    /// Opens a document.
    Open,
    /// Saves the document.
    Save,
    /// Saves the document under another name.
    SaveAs,
    /// Writes a figure of the canvas.
    ExportFigure,
    /// Writes all frames of the algorithm that is stepped through.
    ExportFrames,
    /// Writes the chart of the selected curve.
    ExportChart,
    /// Adds the mesh of an OBJ file.
    ImportMesh,
    /// Writes the selected mesh at the level shown.
    ExportMesh,
    /// Reads data from a table.
    ImportData,
    /// Writes the data as a table.
    ExportData,
    /// A new approximation.
    NewApproximation,
    /// Shows the first scene again.
    FirstScene,
    /// Closes the lab.
    Quit,
    /// Takes back the last step.
    Undo,
    /// Does again what was taken back.
    Redo,
    /// Deletes what is selected.
    Delete,
    /// Copies the selected object.
    Duplicate,
    /// Selects all control points.
    SelectAll,
    /// Selects nothing, ends a tool.
    Escape,
    /// The tool that selects and drags.
    SelectTool,
    /// The tool that draws a new curve.
    DrawTool,
    /// A cubic spline through the points clicked.
    DrawThrough,
    /// A stroke by free hand, fitted by a spline.
    DrawStroke,
    /// A circle from centre and rim.
    DrawCircle,
    /// A circular arc through three points.
    DrawArc,
    /// An ellipse from centre and half axes.
    DrawEllipse,
    /// A conic arc from three points and a weight.
    DrawConic,
    /// The conic through five points.
    DrawConicFive,
    /// The tool that selects and drags data and knots.
    SelectDataTool,
    /// The tool that adds data.
    AddPointTool,
    /// Replaces the data by values of the function.
    SampleFunction,
    /// Error hidden, linear, logarithmic in turn.
    CycleErrorPlot,
    /// Inserts a knot at the parameter.
    InsertKnot,
    /// Removes the selected knot.
    RemoveKnot,
    /// Removes all knots that a tolerance does not need.
    RemoveKnotsWithin,
    /// Selects the next knot.
    NextKnot,
    /// Selects the knot before.
    PreviousKnot,
    /// While knots move: the control points stay, or the curve.
    ToggleKeepCurve,
    /// Equally distant simple knots.
    UniformKnots,
    /// Equally distant knots with n-fold ends.
    EndInterpolatingKnots,
    /// Knots spaced like the control points.
    ChordLengthKnots,
    /// Knots spaced like the square roots of the chords.
    CentripetalKnots,
    /// Averages of the chord lengths.
    AveragedKnots,
    /// One B-spline as two of lower degree, in the knot line.
    ToggleBuilder,
    /// Inserts a knot in the middle of every interval.
    RefineUniformly,
    /// Raises the degree, shape kept.
    ElevateDegree,
    /// Lowers the degree, shape nearly kept.
    ReduceDegree,
    /// Closes an open curve, opens a closed one.
    ToggleClosed,
    /// Reverses the direction.
    Reverse,
    /// Cuts the curve at the selected knot or at t.
    SplitCurve,
    /// Joins the nearest end of another curve.
    JoinCurves,
    /// Keeps the part before t.
    TrimBefore,
    /// Keeps the part after t.
    TrimAfter,
    /// Asks for the interval to keep.
    Trim,
    /// All knots n-fold.
    BezierForm,
    /// End knots n-fold.
    InterpolateEnds,
    /// Asks for a map of the whole curve.
    TransformCurve,
    /// Asks for the distance of a parallel curve.
    OffsetCurve,
    /// All weights 1.
    ResetWeights,
    /// Handles on the curve on or off.
    ToggleEditPoints,
    /// Handles for ratios of weights on or off.
    ToggleWeightPoints,
    /// Selected points to one x.
    AlignX,
    /// Selected points to one y.
    AlignY,
    /// Selected points to the grid.
    AlignGrid,
    /// Selected points in equal steps.
    Distribute,
    /// One subdivision step more.
    LevelUp,
    /// One subdivision step fewer.
    LevelDown,
    /// Control net or mesh on or off.
    ToggleNet,
    /// Knot lines or wireframe on or off.
    ToggleLines,
    /// Normals on or off.
    ToggleNormals,
    /// Smooth or flat faces.
    ToggleSmooth,
    /// Limit points on or off.
    ToggleLimits,
    /// Valence marks on or off.
    ToggleValences,
    /// The next colouring.
    CycleColoring,
    /// More knots in u.
    RefineU,
    /// More knots in v.
    RefineV,
    /// Raises the degree in u.
    ElevateU,
    /// Raises the degree in v.
    ElevateV,
    /// Reverses u.
    ReverseU,
    /// Reverses v.
    ReverseV,
    /// Perspective or parallel projection.
    ToggleParallel,
    /// Colour the field, or only draw its lines.
    ToggleField,
    /// Lines of equal value.
    ToggleIsolines,
    /// The B-splines: inner ones filled, outer ones hollow.
    ToggleNodes,
    /// The cells of the grid, cut ones marked.
    ToggleCells,
    /// Where integrands are evaluated.
    ToggleQuadrature,
    /// Halve the grid width.
    RefineElements,
    /// Double the grid width.
    CoarsenElements,
    /// One degree up.
    RaiseElementDegree,
    /// One degree down.
    LowerElementDegree,
    /// Fits everything into the canvas.
    Fit,
    /// Larger.
    ZoomIn,
    /// Smaller.
    ZoomOut,
    /// Grid on or off.
    ToggleGrid,
    /// Control polygon on or off.
    TogglePolygon,
    /// Curvature comb on or off.
    ToggleComb,
    /// De Boor's construction on or off.
    ToggleConstruction,
    /// Labels: none, index, weight, coordinates in turn.
    CycleLabels,
    /// Convex hull of the active control points on or off.
    ToggleHull,
    /// Circle of curvature on or off.
    ToggleCircle,
    /// Frame at t on or off.
    ToggleFrame,
    /// Hodograph on or off.
    ToggleHodograph,
    /// Bezier points on or off.
    ToggleBezierPoints,
    /// Blossom labels on or off.
    ToggleBlossomLabels,
    /// Distance tube on or off.
    ToggleDistanceTube,
    /// Inflections on or off.
    ToggleInflections,
    /// Curvature extrema on or off.
    ToggleVertices,
    /// Symmetry on or off.
    ToggleSymmetry,
    /// Probe line on or off.
    ToggleProbeLine,
    /// Objects and lessons on or off.
    ToggleLeftPanel,
    /// Inspector, stepper and lesson on or off.
    ToggleRightPanel,
    /// Knot line on or off.
    ToggleKnotLine,
    /// The conic of the selected curve, in the right panel.
    ShowConic,
    /// The selected curve in homogeneous coordinates, in the right panel.
    ShowHomogeneous,
    /// Cubics with given ends, in the right panel.
    ShowHermite,
    /// Charts in place of the knot line.
    ToggleCharts,
    /// Light look.
    LookLight,
    /// Dark look.
    LookDark,
    /// Look for a projector.
    LookPresentation,
    /// The next algorithm of the stepper.
    NextAlgorithm,
    /// The algorithm before.
    PreviousAlgorithm,
    /// Plays the construction step by step, or stops.
    StepperPlay,
    /// One step on.
    StepForward,
    /// One step back.
    StepBack,
    /// Next lesson.
    NextLesson,
    /// Previous lesson.
    PreviousLesson,
    /// The lesson's scene as it was at first.
    BackToExample,
    /// Finds a command by name.
    Palette,
    /// All shortcuts.
    ShortcutSheet,
}

impl Command {
    /// All commands, in the order of menus, palette and sheet.
    pub const ALL: [Self; 130] = [
        Self::New,
        Self::Open,
        Self::Save,
        Self::SaveAs,
        Self::ExportFigure,
        Self::ExportFrames,
        Self::ExportChart,
        Self::ImportMesh,
        Self::ExportMesh,
        Self::ImportData,
        Self::ExportData,
        Self::NewApproximation,
        Self::FirstScene,
        Self::Quit,
        Self::Undo,
        Self::Redo,
        Self::Delete,
        Self::Duplicate,
        Self::SelectAll,
        Self::Escape,
        Self::SelectTool,
        Self::DrawTool,
        Self::DrawThrough,
        Self::DrawStroke,
        Self::DrawCircle,
        Self::DrawArc,
        Self::DrawEllipse,
        Self::DrawConic,
        Self::DrawConicFive,
        Self::SelectDataTool,
        Self::AddPointTool,
        Self::SampleFunction,
        Self::CycleErrorPlot,
        Self::InsertKnot,
        Self::RemoveKnot,
        Self::RemoveKnotsWithin,
        Self::NextKnot,
        Self::PreviousKnot,
        Self::ToggleKeepCurve,
        Self::UniformKnots,
        Self::EndInterpolatingKnots,
        Self::ChordLengthKnots,
        Self::CentripetalKnots,
        Self::AveragedKnots,
        Self::ToggleBuilder,
        Self::RefineUniformly,
        Self::ElevateDegree,
        Self::ReduceDegree,
        Self::ToggleClosed,
        Self::Reverse,
        Self::SplitCurve,
        Self::JoinCurves,
        Self::TrimBefore,
        Self::TrimAfter,
        Self::Trim,
        Self::BezierForm,
        Self::InterpolateEnds,
        Self::TransformCurve,
        Self::OffsetCurve,
        Self::ResetWeights,
        Self::ToggleEditPoints,
        Self::ToggleWeightPoints,
        Self::AlignX,
        Self::AlignY,
        Self::AlignGrid,
        Self::Distribute,
        Self::LevelUp,
        Self::LevelDown,
        Self::ToggleNet,
        Self::ToggleLines,
        Self::ToggleNormals,
        Self::ToggleSmooth,
        Self::ToggleLimits,
        Self::ToggleValences,
        Self::CycleColoring,
        Self::RefineU,
        Self::RefineV,
        Self::ElevateU,
        Self::ElevateV,
        Self::ReverseU,
        Self::ReverseV,
        Self::ToggleParallel,
        Self::ToggleField,
        Self::ToggleIsolines,
        Self::ToggleNodes,
        Self::ToggleCells,
        Self::ToggleQuadrature,
        Self::RefineElements,
        Self::CoarsenElements,
        Self::RaiseElementDegree,
        Self::LowerElementDegree,
        Self::Fit,
        Self::ZoomIn,
        Self::ZoomOut,
        Self::ToggleGrid,
        Self::TogglePolygon,
        Self::ToggleComb,
        Self::ToggleConstruction,
        Self::CycleLabels,
        Self::ToggleHull,
        Self::ToggleCircle,
        Self::ToggleFrame,
        Self::ToggleHodograph,
        Self::ToggleBezierPoints,
        Self::ToggleBlossomLabels,
        Self::ToggleDistanceTube,
        Self::ToggleInflections,
        Self::ToggleVertices,
        Self::ToggleSymmetry,
        Self::ToggleProbeLine,
        Self::ToggleLeftPanel,
        Self::ToggleRightPanel,
        Self::ToggleKnotLine,
        Self::ShowConic,
        Self::ShowHomogeneous,
        Self::ShowHermite,
        Self::ToggleCharts,
        Self::LookLight,
        Self::LookDark,
        Self::LookPresentation,
        Self::StepperPlay,
        Self::StepForward,
        Self::StepBack,
        Self::NextAlgorithm,
        Self::PreviousAlgorithm,
        Self::NextLesson,
        Self::PreviousLesson,
        Self::BackToExample,
        Self::Palette,
        Self::ShortcutSheet,
    ];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_listed_once() {
        for (i, a) in Command::ALL.iter().enumerate() {
            assert_eq!(Command::ALL.iter().position(|b| b == a), Some(i), "{a:?} is listed twice");
        }
    }
}
