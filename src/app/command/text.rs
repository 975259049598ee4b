//! The words of the commands.

use crate::app::command::Command;

impl Command {
    /// The words of menu and palette, and what the tooltip adds.
    pub fn text(self) -> (&'static str, &'static str) {
        match self {
            Self::New => ("New", "Start with an empty sheet"),
            Self::Open => ("Open…", "Open a document, or a figure that was made from one"),
            Self::Save => ("Save", "Save the document"),
            Self::SaveAs => ("Save as…", "Save under another name"),
            Self::ExportFigure => ("Export figure…", "Write what the canvas shows as SVG, PDF or PNG"),
            Self::ExportFrames => (
                "Export frames…",
                "Write every step of the algorithm: numbered SVG or PNG, one PDF, or a TikZ slide with overlays",
            ),
            Self::ExportChart => (
                "Export chart…",
                "Write the chart of the selected curve as SVG, PDF or PNG, or its numbers as CSV",
            ),
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
            Self::DrawThrough => (
                "Draw through points",
                "Click points that a cubic spline runs through; Enter ends, a click on the first point closes",
            ),
            Self::DrawStroke => {
                ("Draw by free hand", "Press and draw; a spline is fitted within the tolerance")
            }
            Self::DrawCircle => {
                ("Draw a circle", "Click the centre and a point of the rim, or drag from one to the other")
            }
            Self::DrawArc => ("Draw a circular arc", "Click its start, a point on the way, and its end"),
            Self::DrawEllipse => (
                "Draw an ellipse",
                "Click the centre, the end of one half axis, and how far the other reaches",
            ),
            Self::DrawConic => (
                "Draw a conic with a weight",
                "Click three control points, then drag or type the weight of the middle one",
            ),
            Self::DrawConicFive => ("Draw a conic through five points", "Click five points"),
            Self::ToggleEditPoints => {
                ("Edit points on the curve", "Handles on the curve; dragging one keeps the others in place")
            }
            Self::ToggleWeightPoints => {
                ("Weight points", "Handles on the edges for the ratio of neighbouring weights")
            }
            Self::AlignX => ("Align to one x", "Put the selected points above each other, at their mean"),
            Self::AlignY => ("Align to one y", "Put the selected points beside each other, at their mean"),
            Self::AlignGrid => {
                ("Align to the grid", "Put the selected points on the nearest crossings of the grid")
            }
            Self::Distribute => {
                ("Distribute evenly", "Put the selected points in equal steps between the first and the last")
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
            Self::RemoveKnotsWithin => (
                "Remove superfluous knots",
                "Remove as many knots as the tolerance of the knot line allows; the deviation is certified",
            ),
            Self::NextKnot => ("Next knot", "Select the next knot; arrow keys move it"),
            Self::PreviousKnot => ("Previous knot", "Select the knot before; arrow keys move it"),
            Self::ToggleKeepCurve => (
                "Keep the curve",
                "While knots move: keep the curve, with certified deviation, or the control points",
            ),
            Self::UniformKnots => ("Uniform knots", "Equal distances, simple knots"),
            Self::EndInterpolatingKnots => {
                ("End-interpolating knots", "Equal distances, n-fold ends; for a closed curve an n-fold seam")
            }
            Self::ChordLengthKnots => {
                ("Chord length knots", "Distances like those of the active control points")
            }
            Self::CentripetalKnots => {
                ("Centripetal knots", "Distances like the square roots of those of the control points")
            }
            Self::AveragedKnots => (
                "Averaged knots",
                "Averages of the chord lengths, so that each control point has its Greville abscissa near its own",
            ),
            Self::ToggleBuilder => (
                "Basis builder",
                "One B-spline as two of lower degree times linear factors, in the knot line",
            ),
            Self::RefineUniformly => {
                ("Refine all intervals", "Insert a knot in the middle of every interval; the shape is kept")
            }
            Self::ElevateDegree => ("Raise degree", "One degree up; the shape is kept"),
            Self::ReduceDegree => ("Lower degree", "One degree down; the deviation is measured"),
            Self::ToggleClosed => ("Close or open", "Close an open curve, open a closed one"),
            Self::Reverse => ("Reverse direction", "Run through the curve the other way"),
            Self::SplitCurve => {
                ("Split", "Two curves at the selected knot or at t; a closed curve is opened there")
            }
            Self::JoinCurves => {
                ("Join", "One curve with the open curve whose end is nearest; a gap is closed in its middle")
            }
            Self::TrimBefore => (
                "Keep the part before t",
                "Cut the curve at t and drop what lies behind; the rest keeps its shape",
            ),
            Self::TrimAfter => (
                "Keep the part after t",
                "Cut the curve at t and drop what lies before; the rest keeps its shape",
            ),
            Self::Trim => ("Trim…", "Keep the part between two parameters"),
            Self::BezierForm => (
                "To Bezier form",
                "Make all knots n-fold: the control points of the Bezier curves; the shape is kept",
            ),
            Self::InterpolateEnds => ("Interpolate ends", "Make both end knots n-fold; the shape is kept"),
            Self::TransformCurve => {
                ("Transform…", "Move, rotate, scale or mirror the whole curve by numbers")
            }
            Self::OffsetCurve => ("Offset…", "A curve at a distance from this one, within a tolerance"),
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
            Self::ToggleFrame => ("Frame at t", "The unit tangent T and the unit normal N at t"),
            Self::ToggleHodograph => {
                ("Hodograph", "Show or hide the curve of the derivative, with its vector at t")
            }
            Self::ToggleBezierPoints => ("Bezier points", "Show or hide the Bezier points of all pieces"),
            Self::ToggleBlossomLabels => (
                "Blossom labels",
                "Write the knots of each control point beside it, as arguments of the blossom",
            ),
            Self::ToggleDistanceTube => (
                "Distance tube",
                "Show or hide the tube around the polygon that holds the curve, with the bound and what is measured",
            ),
            Self::ToggleInflections => ("Inflections", "Mark where the curvature changes its sign"),
            Self::ToggleVertices => {
                ("Curvature extrema", "Mark where the curvature is locally largest or smallest")
            }
            Self::ToggleSymmetry => {
                ("Symmetry", "Show the nearest axis or centre of symmetry, and how far the curve is from it")
            }
            Self::ToggleProbeLine => {
                ("Probe line", "A line that counts its crossings with the curve and with its polygon")
            }
            Self::ToggleLeftPanel => ("Objects and lessons", "Show or hide the left panel"),
            Self::ToggleRightPanel => ("Inspector and stepper", "Show or hide the right panel"),
            Self::ToggleKnotLine => ("Knot line", "Show or hide the knot line"),
            Self::ShowConic => {
                ("Conic of the curve", "Equation, type, axes and foci of a quadratic piece; its weight")
            }
            Self::ShowHomogeneous => {
                ("Homogeneous coordinates", "The curve in space, its cone, and the plane w = 1")
            }
            Self::ShowHermite => (
                "Geometric Hermite interpolation",
                "All cubics with given end points, directions and curvatures",
            ),
            Self::ToggleCharts => ("Charts", "Curvature, speed, x and y in place of the knot line"),
            Self::LookLight => ("Light look", "Dark ink on a light ground"),
            Self::LookDark => ("Dark look", "Light ink on a dark ground"),
            Self::LookPresentation => ("Presentation look", "Large type and thick lines for a projector"),
            Self::StepperPlay => {
                ("Play the construction", "Play the chosen algorithm step by step, or pause")
            }
            Self::StepForward => ("Step forward", "The next step of the algorithm"),
            Self::StepBack => ("Step back", "The step before"),
            Self::NextAlgorithm => ("Next algorithm", "Step through the next algorithm of the course"),
            Self::PreviousAlgorithm => ("Previous algorithm", "Step through the algorithm before"),
            Self::NextLesson => ("Next lesson", "Open the next lesson of the course"),
            Self::PreviousLesson => ("Previous lesson", "Open the lesson before"),
            Self::BackToExample => (
                "Back to the example",
                "Show the lesson's scene as it was at first; Ctrl+Z brings back your work",
            ),
            Self::Palette => ("Find a command…", "Type a few letters of what you want to do"),
            Self::ShortcutSheet => ("Shortcuts", "All keys and what the mouse does"),
        }
    }
}
