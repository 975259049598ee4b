//! The keys of the commands.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

use crate::app::command::Command;

const NONE: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

impl Command {
    /// The key, if there is one.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::New => (COMMAND, Key::N),
            Self::Open => (COMMAND, Key::O),
            Self::Save => (COMMAND, Key::S),
            Self::SaveAs => (COMMAND_SHIFT, Key::S),
            Self::ExportFigure => (COMMAND, Key::E),
            Self::ExportFrames => (COMMAND_SHIFT, Key::E),
            Self::Quit => (COMMAND, Key::Q),
            Self::Undo => (COMMAND, Key::Z),
            Self::Redo => (COMMAND_SHIFT, Key::Z),
            Self::Delete => (NONE, Key::Delete),
            Self::Duplicate => (COMMAND, Key::D),
            Self::SelectAll => (COMMAND, Key::A),
            Self::Escape => (NONE, Key::Escape),
            Self::SelectTool => (NONE, Key::V),
            Self::DrawTool => (NONE, Key::D),
            Self::DrawThrough => (COMMAND, Key::Num2),
            Self::DrawStroke => (COMMAND, Key::Num3),
            Self::DrawCircle => (COMMAND, Key::Num4),
            Self::DrawArc => (COMMAND, Key::Num5),
            Self::DrawEllipse => (COMMAND, Key::Num6),
            Self::DrawConic => (COMMAND, Key::Num7),
            Self::DrawConicFive => (COMMAND, Key::Num8),
            Self::ToggleEditPoints => (NONE, Key::X),
            Self::ToggleWeightPoints => (NONE, Key::W),
            Self::AlignX => (Modifiers::ALT, Key::X),
            Self::AlignY => (Modifiers::ALT, Key::Y),
            Self::AlignGrid => (Modifiers::ALT, Key::G),
            Self::Distribute => (Modifiers::ALT, Key::D),
            Self::SelectDataTool => (NONE, Key::V),
            Self::AddPointTool => (NONE, Key::A),
            Self::CycleErrorPlot => (NONE, Key::L),
            Self::InsertKnot => (NONE, Key::K),
            Self::RemoveKnot => (Modifiers::SHIFT, Key::K),
            Self::NextKnot => (NONE, Key::Period),
            Self::PreviousKnot => (NONE, Key::Comma),
            Self::ToggleKeepCurve => (Modifiers::SHIFT, Key::C),
            Self::ToggleBuilder => (Modifiers::SHIFT, Key::B),
            Self::RemoveKnotsWithin => (Modifiers::SHIFT, Key::Delete),
            Self::RefineUniformly => (NONE, Key::R),
            Self::ElevateDegree => (NONE, Key::E),
            Self::ReduceDegree => (Modifiers::SHIFT, Key::E),
            Self::ToggleClosed => (NONE, Key::C),
            Self::Reverse => (NONE, Key::Q),
            Self::SplitCurve => (NONE, Key::S),
            Self::JoinCurves => (NONE, Key::J),
            Self::TrimBefore => (Modifiers::ALT, Key::B),
            Self::TrimAfter => (Modifiers::ALT, Key::A),
            Self::Trim => (NONE, Key::T),
            Self::BezierForm => (NONE, Key::Z),
            Self::InterpolateEnds => (NONE, Key::I),
            Self::TransformCurve => (NONE, Key::M),
            Self::OffsetCurve => (NONE, Key::Y),
            Self::LevelUp => (NONE, Key::CloseBracket),
            Self::LevelDown => (NONE, Key::OpenBracket),
            Self::ToggleNet => (NONE, Key::P),
            Self::ToggleLines => (NONE, Key::W),
            Self::ToggleNormals => (NONE, Key::N),
            Self::ToggleSmooth => (NONE, Key::S),
            Self::ToggleLimits => (NONE, Key::L),
            Self::ToggleValences => (NONE, Key::B),
            Self::CycleColoring => (NONE, Key::U),
            Self::ToggleParallel => (NONE, Key::O),
            Self::ToggleField => (NONE, Key::U),
            Self::ToggleIsolines => (NONE, Key::I),
            Self::ToggleNodes => (NONE, Key::N),
            Self::ToggleCells => (NONE, Key::C),
            Self::ToggleQuadrature => (NONE, Key::Q),
            Self::RefineElements => (NONE, Key::R),
            Self::CoarsenElements => (Modifiers::SHIFT, Key::R),
            Self::RaiseElementDegree => (NONE, Key::E),
            Self::LowerElementDegree => (Modifiers::SHIFT, Key::E),
            Self::Fit => (NONE, Key::F),
            Self::ZoomIn => (COMMAND, Key::Plus),
            Self::ZoomOut => (COMMAND, Key::Minus),
            Self::ToggleGrid => (NONE, Key::G),
            Self::TogglePolygon => (NONE, Key::P),
            Self::ToggleComb => (NONE, Key::U),
            Self::ToggleConstruction => (NONE, Key::B),
            Self::CycleLabels => (NONE, Key::L),
            Self::ToggleHull => (NONE, Key::H),
            Self::ToggleCircle => (NONE, Key::O),
            Self::ToggleFrame => (Modifiers::SHIFT, Key::T),
            Self::ToggleHodograph => (Modifiers::SHIFT, Key::H),
            Self::ToggleBezierPoints => (Modifiers::SHIFT, Key::Z),
            Self::ToggleBlossomLabels => (Modifiers::SHIFT, Key::L),
            Self::ToggleDistanceTube => (Modifiers::SHIFT, Key::D),
            Self::ToggleInflections => (Modifiers::SHIFT, Key::I),
            Self::ToggleVertices => (Modifiers::SHIFT, Key::V),
            Self::ToggleSymmetry => (Modifiers::SHIFT, Key::S),
            Self::ToggleProbeLine => (Modifiers::SHIFT, Key::P),
            Self::ToggleLeftPanel => (NONE, Key::F2),
            Self::ToggleRightPanel => (NONE, Key::F3),
            Self::ToggleKnotLine => (NONE, Key::F4),
            Self::ShowConic => (Modifiers::ALT, Key::C),
            Self::ShowHomogeneous => (Modifiers::ALT, Key::H),
            Self::ShowHermite => (Modifiers::ALT, Key::E),
            Self::ToggleCharts => (NONE, Key::F9),
            Self::LookLight => (NONE, Key::F6),
            Self::LookDark => (NONE, Key::F7),
            Self::LookPresentation => (NONE, Key::F8),
            Self::StepperPlay => (NONE, Key::Enter),
            Self::StepForward => (NONE, Key::CloseBracket),
            Self::StepBack => (NONE, Key::OpenBracket),
            Self::NextAlgorithm => (COMMAND, Key::CloseBracket),
            Self::PreviousAlgorithm => (COMMAND, Key::OpenBracket),
            Self::NextLesson => (NONE, Key::PageDown),
            Self::PreviousLesson => (NONE, Key::PageUp),
            Self::BackToExample => (NONE, Key::Home),
            Self::Palette => (COMMAND, Key::P),
            Self::ShortcutSheet => (NONE, Key::F1),
            Self::ImportMesh
            | Self::ExportMesh
            | Self::ExportChart
            | Self::RefineU
            | Self::RefineV
            | Self::ElevateU
            | Self::ElevateV
            | Self::ReverseU
            | Self::ReverseV
            | Self::ImportData
            | Self::ExportData
            | Self::NewApproximation
            | Self::SampleFunction
            | Self::FirstScene
            | Self::UniformKnots
            | Self::EndInterpolatingKnots
            | Self::ChordLengthKnots
            | Self::CentripetalKnots
            | Self::AveragedKnots
            | Self::ResetWeights => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_a_key() {
        for (i, a) in Command::ALL.iter().enumerate() {
            for b in &Command::ALL[i + 1..] {
                let apart = a.room().is_some() && b.room().is_some() && a.room() != b.room();
                assert!(
                    apart || a.shortcut().is_none() || a.shortcut() != b.shortcut(),
                    "{a:?} and {b:?} are both on {:?}",
                    a.shortcut()
                );
            }
        }
    }
}
