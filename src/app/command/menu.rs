//! The menus, and in which room a command means something.

use crate::app::command::Command;
use crate::app::workspace::Room;

/// The menus, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Menu {
    /// Files.
    File,
    /// Undo and selection.
    Edit,
    /// The selected curve.
    Curve,
    /// The selected surface or mesh.
    Surface,
    /// The selected approximation.
    Approximation,
    /// The selected boundary value problem.
    Problem,
    /// What is shown.
    View,
    /// Lessons and the stepper.
    Lesson,
    /// Help.
    Help,
}

impl Menu {
    /// All menus.
    pub const ALL: [Self; 9] = [
        Self::File,
        Self::Edit,
        Self::Curve,
        Self::Approximation,
        Self::Surface,
        Self::Problem,
        Self::View,
        Self::Lesson,
        Self::Help,
    ];

    /// The only room where the menu is shown; `None` if it is everywhere.
    pub fn room(self) -> Option<Room> {
        match self {
            Self::Curve => Some(Room::Curves),
            Self::Surface => Some(Room::Surfaces),
            Self::Approximation => Some(Room::Approximation),
            Self::Problem => Some(Room::Elements),
            _ => None,
        }
    }

    /// The title.
    pub fn title(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Curve => "Curve",
            Self::Surface => "Surface",
            Self::Approximation => "Approximation",
            Self::Problem => "Problem",
            Self::View => "View",
            Self::Lesson => "Lesson",
            Self::Help => "Help",
        }
    }
}

impl Command {
    /// The only room where the command means something; `None` if it does everywhere.
    pub fn room(self) -> Option<Room> {
        match self {
            Self::ToggleGrid
            | Self::TogglePolygon
            | Self::ToggleComb
            | Self::ToggleConstruction
            | Self::CycleLabels
            | Self::ToggleHull
            | Self::ToggleCircle
            | Self::ToggleFrame
            | Self::ToggleHodograph
            | Self::ToggleBezierPoints
            | Self::ToggleBlossomLabels
            | Self::ToggleDistanceTube
            | Self::ToggleInflections
            | Self::ToggleVertices
            | Self::ToggleSymmetry
            | Self::ToggleProbeLine
            | Self::ToggleKnotLine
            | Self::ToggleCharts
            | Self::ToggleBuilder
            | Self::ShowConic
            | Self::ShowHomogeneous
            | Self::ShowHermite
            | Self::ExportFrames
            | Self::ExportChart
            | Self::StepperPlay
            | Self::StepForward
            | Self::StepBack
            | Self::NextAlgorithm
            | Self::PreviousAlgorithm => Some(Room::Curves),
            Self::ExportMesh => Some(Room::Surfaces),
            _ => self.menu().room(),
        }
    }

    /// The menu that lists the command.
    pub fn menu(self) -> Menu {
        match self {
            Self::New
            | Self::Open
            | Self::Save
            | Self::SaveAs
            | Self::ExportFigure
            | Self::ExportFrames
            | Self::ExportChart
            | Self::ImportMesh
            | Self::ExportMesh
            | Self::ImportData
            | Self::ExportData
            | Self::NewApproximation
            | Self::FirstScene
            | Self::Quit => Menu::File,
            Self::Undo | Self::Redo | Self::Delete | Self::Duplicate | Self::SelectAll | Self::Escape => {
                Menu::Edit
            }
            Self::SelectTool
            | Self::DrawTool
            | Self::InsertKnot
            | Self::RemoveKnot
            | Self::RemoveKnotsWithin
            | Self::NextKnot
            | Self::PreviousKnot
            | Self::ToggleKeepCurve
            | Self::UniformKnots
            | Self::EndInterpolatingKnots
            | Self::ChordLengthKnots
            | Self::CentripetalKnots
            | Self::AveragedKnots
            | Self::RefineUniformly
            | Self::ElevateDegree
            | Self::ReduceDegree
            | Self::ToggleClosed
            | Self::Reverse
            | Self::SplitCurve
            | Self::JoinCurves
            | Self::TrimBefore
            | Self::TrimAfter
            | Self::Trim
            | Self::BezierForm
            | Self::InterpolateEnds
            | Self::TransformCurve
            | Self::OffsetCurve
            | Self::ResetWeights
            | Self::DrawThrough
            | Self::DrawStroke
            | Self::DrawCircle
            | Self::DrawArc
            | Self::DrawEllipse
            | Self::DrawConic
            | Self::DrawConicFive
            | Self::ToggleEditPoints
            | Self::ToggleWeightPoints
            | Self::AlignX
            | Self::AlignY
            | Self::AlignGrid
            | Self::Distribute => Menu::Curve,
            Self::LevelUp
            | Self::LevelDown
            | Self::ToggleNet
            | Self::ToggleLines
            | Self::ToggleNormals
            | Self::ToggleSmooth
            | Self::ToggleLimits
            | Self::ToggleValences
            | Self::CycleColoring
            | Self::RefineU
            | Self::RefineV
            | Self::ElevateU
            | Self::ElevateV
            | Self::ReverseU
            | Self::ReverseV
            | Self::ToggleParallel => Menu::Surface,
            Self::SelectDataTool | Self::AddPointTool | Self::SampleFunction | Self::CycleErrorPlot => {
                Menu::Approximation
            }
            Self::ToggleField
            | Self::ToggleIsolines
            | Self::ToggleNodes
            | Self::ToggleCells
            | Self::ToggleQuadrature
            | Self::RefineElements
            | Self::CoarsenElements
            | Self::RaiseElementDegree
            | Self::LowerElementDegree => Menu::Problem,
            Self::StepperPlay
            | Self::StepForward
            | Self::StepBack
            | Self::NextAlgorithm
            | Self::PreviousAlgorithm
            | Self::NextLesson
            | Self::PreviousLesson
            | Self::BackToExample => Menu::Lesson,
            Self::Palette | Self::ShortcutSheet => Menu::Help,
            _ => Menu::View,
        }
    }
}
