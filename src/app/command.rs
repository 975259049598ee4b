//! Everything that can be commanded: one enum gives menus, tooltips, shortcuts, the palette and the shortcut sheet.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

use crate::app::workspace::Room;

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
    /// All weights 1.
    ResetWeights,
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
    /// Objects and lessons on or off.
    ToggleLeftPanel,
    /// Inspector, stepper and lesson on or off.
    ToggleRightPanel,
    /// Knot line on or off.
    ToggleKnotLine,
    /// Light look.
    LookLight,
    /// Dark look.
    LookDark,
    /// Look for a projector.
    LookPresentation,
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
    /// Finds a command by name.
    Palette,
    /// All shortcuts.
    ShortcutSheet,
}

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

const NONE: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

impl Command {
    /// All commands, in the order of menus, palette and sheet.
    pub const ALL: [Self; 80] = [
        Self::New,
        Self::Open,
        Self::Save,
        Self::SaveAs,
        Self::ExportFigure,
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
        Self::SelectDataTool,
        Self::AddPointTool,
        Self::SampleFunction,
        Self::CycleErrorPlot,
        Self::InsertKnot,
        Self::RemoveKnot,
        Self::RefineUniformly,
        Self::ElevateDegree,
        Self::ReduceDegree,
        Self::ToggleClosed,
        Self::Reverse,
        Self::ResetWeights,
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
        Self::ToggleLeftPanel,
        Self::ToggleRightPanel,
        Self::ToggleKnotLine,
        Self::LookLight,
        Self::LookDark,
        Self::LookPresentation,
        Self::StepperPlay,
        Self::StepForward,
        Self::StepBack,
        Self::NextLesson,
        Self::PreviousLesson,
        Self::Palette,
        Self::ShortcutSheet,
    ];

    /// The words of menu and palette, and what the tooltip adds.
    pub fn text(self) -> (&'static str, &'static str) {
        match self {
            Self::New => ("New", "Start with an empty sheet"),
            Self::Open => ("Open…", "Open a document, or a figure that was made from one"),
            Self::Save => ("Save", "Save the document"),
            Self::SaveAs => ("Save as…", "Save under another name"),
            Self::ExportFigure => ("Export figure…", "Write what the canvas shows as SVG, PDF or PNG"),
            Self::ImportData => {
                ("Import data…", "Read a table of x and y, with weights if wanted, from a CSV file")
            }
            Self::ExportData => ("Export data…", "Write the data as a CSV file"),
            Self::NewApproximation => {
                ("New approximation", "Data, a function, and methods that approximate them")
            }
            Self::FirstScene => ("Show the first scene", "Open the scene that the lab starts with"),
            Self::Quit => ("Quit", "Close the lab"),
            Self::Undo => ("Undo", "Take back the last step"),
            Self::Redo => ("Redo", "Do again what was taken back"),
            Self::Delete => ("Delete", "Delete the selected points, knot or object"),
            Self::Duplicate => ("Duplicate", "Copy the selected object"),
            Self::SelectAll => ("Select all points", "Select every control point of the object"),
            Self::Escape => ("Deselect", "Select nothing; leave the drawing tool"),
            Self::SelectTool => ("Select tool", "Select and drag points, knots and curves"),
            Self::DrawTool => {
                ("Draw a curve", "Click control points; Enter or double click ends, Backspace drops the last")
            }
            Self::SelectDataTool => ("Select data", "Select and drag data and knots"),
            Self::AddPointTool => ("Add points", "Click where data are to be"),
            Self::SampleFunction => {
                ("Sample the function", "Replace the data by as many values of the function, equally spaced")
            }
            Self::CycleErrorPlot => ("Error plot", "Linear, logarithmic, hidden in turn"),
            Self::InsertKnot => ("Insert knot at t", "Insert a knot at the parameter; the shape is kept"),
            Self::RemoveKnot => {
                ("Remove knot", "Remove one copy of the selected knot; the deviation is measured")
            }
            Self::RefineUniformly => {
                ("Refine all intervals", "Insert a knot in the middle of every interval; the shape is kept")
            }
            Self::ElevateDegree => ("Raise degree", "One degree up; the shape is kept"),
            Self::ReduceDegree => ("Lower degree", "One degree down; the deviation is measured"),
            Self::ToggleClosed => ("Close or open", "Close an open curve, open a closed one"),
            Self::Reverse => ("Reverse direction", "Run through the curve the other way"),
            Self::ResetWeights => ("All weights 1", "Make the curve polynomial"),
            Self::ImportMesh => ("Import mesh…", "Add the mesh of an OBJ file to the document"),
            Self::ExportMesh => ("Export mesh…", "Write the selected mesh as OBJ, refined as it is shown"),
            Self::LevelUp => ("Refine", "One step of subdivision more"),
            Self::LevelDown => ("Coarsen", "One step of subdivision fewer"),
            Self::ToggleNet => ("Control net", "Show or hide the control net or mesh"),
            Self::ToggleLines => {
                ("Lines", "Show or hide the knot lines of a surface, the wireframe of a mesh")
            }
            Self::ToggleNormals => ("Normals", "Show or hide normals of a surface"),
            Self::ToggleSmooth => ("Smooth light", "Light as on the smooth surface, or flat faces"),
            Self::ToggleLimits => ("Limit points", "Show a mesh where its vertices tend to"),
            Self::ToggleValences => ("Valences", "Mark inner vertices that have not four faces"),
            Self::CycleColoring => {
                ("Curvature colours", "None, Gaussian, mean, smaller and larger principal curvature in turn")
            }
            Self::RefineU => {
                ("Refine u", "A knot more in the middle of every interval of u; the surface is kept")
            }
            Self::RefineV => {
                ("Refine v", "A knot more in the middle of every interval of v; the surface is kept")
            }
            Self::ElevateU => ("Raise degree in u", "One degree more in u; the surface is kept"),
            Self::ElevateV => ("Raise degree in v", "One degree more in v; the surface is kept"),
            Self::ReverseU => ("Reverse u", "Run through u the other way; normals turn to the other side"),
            Self::ReverseV => ("Reverse v", "Run through v the other way; normals turn to the other side"),
            Self::ToggleParallel => ("Perspective", "Perspective or parallel projection"),
            Self::ToggleField => ("Colours", "Colour the field, or only draw its lines"),
            Self::ToggleIsolines => ("Isolines", "Lines of equal value"),
            Self::ToggleNodes => ("Nodes", "The B-splines: inner ones filled, outer ones hollow"),
            Self::ToggleCells => ("Cells", "The cells of the grid, cut ones marked"),
            Self::ToggleQuadrature => ("Quadrature nodes", "Where integrands are evaluated"),
            Self::RefineElements => ("Finer grid", "Halve the grid width"),
            Self::CoarsenElements => ("Coarser grid", "Double the grid width"),
            Self::RaiseElementDegree => ("Raise the degree of the elements", "One degree up"),
            Self::LowerElementDegree => ("Lower the degree of the elements", "One degree down"),
            Self::Fit => ("Fit", "Show everything"),
            Self::ZoomIn => ("Zoom in", "Larger"),
            Self::ZoomOut => ("Zoom out", "Smaller"),
            Self::ToggleGrid => ("Grid", "Show or hide the grid"),
            Self::TogglePolygon => ("Control polygon", "Show or hide the control polygon"),
            Self::ToggleComb => ("Curvature comb", "Show or hide the curvature comb"),
            Self::ToggleConstruction => ("Construction at t", "Show or hide de Boor's construction"),
            Self::CycleLabels => ("Point labels", "None, index, weight, coordinates in turn"),
            Self::ToggleHull => ("Convex hull at t", "Show or hide the hull of the active control points"),
            Self::ToggleCircle => ("Circle of curvature", "Show or hide the osculating circle at t"),
            Self::ToggleLeftPanel => ("Objects and lessons", "Show or hide the left panel"),
            Self::ToggleRightPanel => ("Inspector and stepper", "Show or hide the right panel"),
            Self::ToggleKnotLine => ("Knot line", "Show or hide the knot line"),
            Self::LookLight => ("Light look", "Dark ink on a light ground"),
            Self::LookDark => ("Dark look", "Light ink on a dark ground"),
            Self::LookPresentation => ("Presentation look", "Large type and thick lines for a projector"),
            Self::StepperPlay => ("Play the construction", "Play de Boor's algorithm step by step, or pause"),
            Self::StepForward => ("Step forward", "The next step of the algorithm"),
            Self::StepBack => ("Step back", "The step before"),
            Self::NextLesson => ("Next lesson", "Open the next lesson of the course"),
            Self::PreviousLesson => ("Previous lesson", "Open the lesson before"),
            Self::Palette => ("Find a command…", "Type a few letters of what you want to do"),
            Self::ShortcutSheet => ("Shortcuts", "All keys and what the mouse does"),
        }
    }

    /// The key, if there is one.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::New => (COMMAND, Key::N),
            Self::Open => (COMMAND, Key::O),
            Self::Save => (COMMAND, Key::S),
            Self::SaveAs => (COMMAND_SHIFT, Key::S),
            Self::ExportFigure => (COMMAND, Key::E),
            Self::Quit => (COMMAND, Key::Q),
            Self::Undo => (COMMAND, Key::Z),
            Self::Redo => (COMMAND_SHIFT, Key::Z),
            Self::Delete => (NONE, Key::Delete),
            Self::Duplicate => (COMMAND, Key::D),
            Self::SelectAll => (COMMAND, Key::A),
            Self::Escape => (NONE, Key::Escape),
            Self::SelectTool => (NONE, Key::V),
            Self::DrawTool => (NONE, Key::D),
            Self::SelectDataTool => (NONE, Key::V),
            Self::AddPointTool => (NONE, Key::A),
            Self::CycleErrorPlot => (NONE, Key::L),
            Self::InsertKnot => (NONE, Key::K),
            Self::RemoveKnot => (Modifiers::SHIFT, Key::K),
            Self::RefineUniformly => (NONE, Key::R),
            Self::ElevateDegree => (NONE, Key::E),
            Self::ReduceDegree => (Modifiers::SHIFT, Key::E),
            Self::ToggleClosed => (NONE, Key::C),
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
            Self::ToggleLeftPanel => (NONE, Key::F2),
            Self::ToggleRightPanel => (NONE, Key::F3),
            Self::ToggleKnotLine => (NONE, Key::F4),
            Self::LookLight => (NONE, Key::F6),
            Self::LookDark => (NONE, Key::F7),
            Self::LookPresentation => (NONE, Key::F8),
            Self::StepperPlay => (NONE, Key::Enter),
            Self::StepForward => (NONE, Key::CloseBracket),
            Self::StepBack => (NONE, Key::OpenBracket),
            Self::NextLesson => (NONE, Key::PageDown),
            Self::PreviousLesson => (NONE, Key::PageUp),
            Self::Palette => (COMMAND, Key::P),
            Self::ShortcutSheet => (NONE, Key::F1),
            Self::ImportMesh
            | Self::ExportMesh
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
            | Self::Reverse
            | Self::ResetWeights => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

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
            | Self::ToggleKnotLine
            | Self::StepperPlay
            | Self::StepForward
            | Self::StepBack => Some(Room::Curves),
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
            | Self::RefineUniformly
            | Self::ElevateDegree
            | Self::ReduceDegree
            | Self::ToggleClosed
            | Self::Reverse
            | Self::ResetWeights => Menu::Curve,
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
            | Self::NextLesson
            | Self::PreviousLesson => Menu::Lesson,
            Self::Palette | Self::ShortcutSheet => Menu::Help,
            _ => Menu::View,
        }
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

    #[test]
    fn every_command_is_listed_once() {
        for (i, a) in Command::ALL.iter().enumerate() {
            assert_eq!(Command::ALL.iter().position(|b| b == a), Some(i), "{a:?} is listed twice");
        }
    }
}
