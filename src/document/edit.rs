//! Every change of a document, as a value: for the Undo menu, for tests, for scripts.

use glam::{DMat2, DVec2};

use crate::core::spline_curve::{KnotRule, Nurbs};
use crate::document::display::CurveDisplay;
use crate::document::object::{Content, ObjectId};

/// The highest degree that edits reach. The library goes further; degrees above 12 teach nothing.
pub const MAX_EDIT_DEGREE: usize = 12;

/// A change of a document.
///
/// Indices count from 0. Control points of a closed curve and its knots are those of one period.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// A new curve above all others.
    AddCurve {
        /// Name.
        name: String,
        /// The curve.
        curve: Nurbs<DVec2>,
        /// How it is shown.
        display: CurveDisplay,
    },
    /// A new object of any kind above all others.
    AddObject {
        /// Name.
        name: String,
        /// What it is.
        content: Content,
    },
    /// Puts other content of the same kind into an object.
    SetContent {
        /// The object.
        object: ObjectId,
        /// What it is from now on.
        content: Content,
        /// Name of the step.
        label: String,
    },
    /// Removes objects.
    RemoveObjects {
        /// Which ones; the same number twice is the same as once.
        objects: Vec<ObjectId>,
    },
    /// Puts a copy directly above the original.
    DuplicateObject {
        /// The original.
        object: ObjectId,
    },
    /// Gives an object another name.
    RenameObject {
        /// The object.
        object: ObjectId,
        /// The new name.
        name: String,
    },
    /// Moves an object in the drawing order.
    ReorderObject {
        /// The object.
        object: ObjectId,
        /// Its index afterwards, 0 is lowest.
        to: usize,
    },
    /// Shows or hides an object.
    SetVisible {
        /// The object.
        object: ObjectId,
        /// Whether it is drawn.
        visible: bool,
    },
    /// Changes how an object is shown.
    SetDisplay {
        /// The object.
        object: ObjectId,
        /// All choices.
        display: CurveDisplay,
    },
    /// Moves control points by the same vector.
    MovePoints {
        /// The curve.
        object: ObjectId,
        /// Indices of the points.
        points: Vec<usize>,
        /// The vector.
        delta: DVec2,
    },
    /// Puts one control point somewhere.
    SetPoint {
        /// The curve.
        object: ObjectId,
        /// Index of the point.
        point: usize,
        /// Where to.
        position: DVec2,
    },
    /// Replaces all control points.
    SetPoints {
        /// The curve.
        object: ObjectId,
        /// As many positions as the curve has points.
        positions: Vec<DVec2>,
    },
    /// Moves the point of the curve at a parameter; the active control points change as little as possible.
    MoveCurveAt {
        /// The curve.
        object: ObjectId,
        /// The parameter.
        at: f64,
        /// The vector.
        delta: DVec2,
    },
    /// Moves one edit point; the others stay, so that all control points change.
    MoveEditPoint {
        /// The curve.
        object: ObjectId,
        /// Index of the edit point.
        point: usize,
        /// The vector.
        delta: DVec2,
    },
    /// Changes one weight.
    SetWeight {
        /// The curve.
        object: ObjectId,
        /// Index of the point.
        point: usize,
        /// The positive weight.
        weight: f64,
    },
    /// Replaces all weights.
    SetWeights {
        /// The curve.
        object: ObjectId,
        /// As many positive weights as the curve has points.
        weights: Vec<f64>,
    },
    /// Inserts a knot; the shape is kept.
    InsertKnot {
        /// The curve.
        object: ObjectId,
        /// The knot.
        at: f64,
    },
    /// Removes one copy of a knot; the shape changes unless it was smooth enough.
    RemoveKnot {
        /// The curve.
        object: ObjectId,
        /// The knot.
        at: f64,
    },
    /// Inserts the midpoint of every knot interval; the shape is kept.
    RefineUniformly {
        /// The curve.
        object: ObjectId,
    },
    /// Moves one copy of a knot between its neighbours; the control points stay.
    MoveKnot {
        /// The curve.
        object: ObjectId,
        /// Index in `space().knots()`.
        knot: usize,
        /// Where to.
        to: f64,
    },
    /// Moves all copies of a knot; an outer knot moves along with a knot that bounds the parameter interval.
    MoveDistinctKnot {
        /// The curve.
        object: ObjectId,
        /// The knot, exactly as it stands in the sequence.
        at: f64,
        /// Where to.
        to: f64,
    },
    /// Replaces all knots, in the n-fold or in the (n+1)-fold convention; the control points stay.
    SetKnots {
        /// The curve.
        object: ObjectId,
        /// The knots.
        knots: Vec<f64>,
    },
    /// Takes the knots of a rule; the control points, the degree and the parameter interval stay.
    GenerateKnots {
        /// The curve.
        object: ObjectId,
        /// The rule.
        rule: KnotRule,
    },
    /// Removes knots while the certified deviation is at most a tolerance.
    RemoveKnotsWithin {
        /// The curve.
        object: ObjectId,
        /// The largest deviation, positive or 0.
        tolerance: f64,
    },
    /// Changes knots as another edit does and recomputes the control points: those of the nearest curve in the mean-square sense.
    /// `n`-fold ends and the parameter interval of an open curve stay.
    KeepCurve {
        /// [`Self::MoveKnot`], [`Self::MoveDistinctKnot`], [`Self::SetKnots`] with any number of knots, or [`Self::GenerateKnots`].
        edit: Box<Self>,
    },
    /// Raises the degree by one; the shape is kept.
    ElevateDegree {
        /// The curve.
        object: ObjectId,
    },
    /// Lowers the degree by one; the shape changes.
    ReduceDegree {
        /// The curve.
        object: ObjectId,
    },
    /// Takes another degree with the same control points and new uniform knots over the same interval.
    SetDegree {
        /// The curve.
        object: ObjectId,
        /// From 1 to [`MAX_EDIT_DEGREE`].
        degree: usize,
    },
    /// Closes a curve (same control points, uniform periodic knots) or cuts a closed one at its first knot (shape kept).
    SetClosed {
        /// The curve.
        object: ObjectId,
        /// Whether the curve shall be closed.
        closed: bool,
    },
    /// Adds a control point and a knot; the shape changes.
    InsertPoint {
        /// The curve.
        object: ObjectId,
        /// The new point gets this index.
        before: usize,
        /// Where it stands.
        position: DVec2,
    },
    /// Adds a control point at the end, and a knot; the shape changes.
    AppendPoint {
        /// The curve.
        object: ObjectId,
        /// Where it stands.
        position: DVec2,
    },
    /// Removes control points and as many knots; the degree is lowered when too few points remain. If fewer than 2 remain,
    /// the object is removed.
    DeletePoints {
        /// The curve.
        object: ObjectId,
        /// Indices of the points; the same index twice is the same as once.
        points: Vec<usize>,
    },
    /// Runs through the curve the other way.
    Reverse {
        /// The curve.
        object: ObjectId,
    },
    /// `c ↦ about + matrix·(c − about)` for some control points.
    TransformPoints {
        /// The curve.
        object: ObjectId,
        /// Indices of the points.
        points: Vec<usize>,
        /// The linear part.
        matrix: DMat2,
        /// The fixed point.
        about: DVec2,
    },
    /// Cuts a curve into two objects, the second of them new; a closed curve is opened there. The shape is kept.
    SplitCurve {
        /// The curve.
        object: ObjectId,
        /// The parameter, inside the interval.
        at: f64,
    },
    /// One curve from two open ones, joined where their ends are nearest; an open gap is closed in its middle. The result takes the
    /// place, the look and the direction of the first one.
    JoinCurves {
        /// The curve that stays.
        object: ObjectId,
        /// The curve that goes.
        other: ObjectId,
    },
    /// Keeps the part between two parameters; of a closed curve, `to` may lie behind the end of the period.
    TrimCurve {
        /// The curve.
        object: ObjectId,
        /// Where the part begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Makes all knots `n`-fold: the control points are those of the Bezier curves; the shape is kept.
    ToBezierForm {
        /// The curve.
        object: ObjectId,
    },
    /// Makes both end knots of an open curve `n`-fold: it then begins and ends at control points; the shape is kept.
    InterpolateEnds {
        /// The curve.
        object: ObjectId,
    },
    /// Maps a whole curve.
    TransformCurve {
        /// The curve.
        object: ObjectId,
        /// How.
        map: CurveMap,
    },
    /// A new curve at a distance, directly above the original.
    OffsetCurve {
        /// The original.
        object: ObjectId,
        /// Positive to the left of the direction of the curve.
        distance: f64,
        /// The largest distance from the true offset curve.
        tolerance: f64,
    },
    /// Puts another curve in place of one.
    ReplaceCurve {
        /// The curve.
        object: ObjectId,
        /// The new one.
        curve: Nurbs<DVec2>,
        /// Name of the step.
        label: String,
    },
    /// Several edits as one step: all or none.
    Batch {
        /// Name of the step.
        label: String,
        /// The edits, in their order.
        edits: Vec<Self>,
    },
}

impl Edit {
    /// The name for the Undo menu: `Move 3 points`, `Insert knot 0.5`.
    pub fn name(&self) -> String {
        match self {
            Self::AddCurve { name, .. } | Self::AddObject { name, .. } => format!("Add {name}"),
            Self::RemoveObjects { objects } => counted("Delete", objects.len(), "object"),
            Self::DuplicateObject { .. } => "Duplicate".to_owned(),
            Self::RenameObject { name, .. } => format!("Rename to {name}"),
            Self::ReorderObject { .. } => "Change drawing order".to_owned(),
            Self::SetVisible { visible: true, .. } => "Show".to_owned(),
            Self::SetVisible { visible: false, .. } => "Hide".to_owned(),
            Self::SetDisplay { .. } => "Change display".to_owned(),
            Self::MovePoints { points, .. } => counted("Move", points.len(), "point"),
            Self::SetPoint { point, .. } => format!("Move point {point}"),
            Self::SetPoints { .. } => "Move all points".to_owned(),
            Self::MoveCurveAt { .. } => "Drag curve".to_owned(),
            Self::MoveEditPoint { point, .. } => format!("Move edit point {point}"),
            Self::SetWeight { point, weight, .. } => format!("Set weight {point} to {}", short(*weight)),
            Self::SetWeights { .. } => "Set all weights".to_owned(),
            Self::InsertKnot { at, .. } => format!("Insert knot {}", short(*at)),
            Self::RemoveKnot { at, .. } => format!("Remove knot {}", short(*at)),
            Self::RefineUniformly { .. } => "Refine uniformly".to_owned(),
            Self::MoveKnot { to, .. } => format!("Move knot to {}", short(*to)),
            Self::MoveDistinctKnot { at, to, .. } => format!("Move knot {} to {}", short(*at), short(*to)),
            Self::SetKnots { .. } => "Set knots".to_owned(),
            Self::GenerateKnots { rule, .. } => rule_name(*rule).to_owned(),
            Self::RemoveKnotsWithin { tolerance, .. } => format!("Remove knots within {}", short(*tolerance)),
            Self::KeepCurve { edit, .. } => format!("{}, curve kept", edit.name()),
            Self::ElevateDegree { .. } => "Raise degree".to_owned(),
            Self::ReduceDegree { .. } => "Lower degree".to_owned(),
            Self::SetDegree { degree, .. } => format!("Set degree {degree}"),
            Self::SetClosed { closed: true, .. } => "Close curve".to_owned(),
            Self::SetClosed { closed: false, .. } => "Open curve".to_owned(),
            Self::InsertPoint { before, .. } => format!("Insert point {before}"),
            Self::AppendPoint { .. } => "Add point".to_owned(),
            Self::DeletePoints { points, .. } => counted("Delete", points.len(), "point"),
            Self::SplitCurve { at, .. } => format!("Split at {}", short(*at)),
            Self::JoinCurves { .. } => "Join curves".to_owned(),
            Self::TrimCurve { from, to, .. } => format!("Trim to {} … {}", short(*from), short(*to)),
            Self::ToBezierForm { .. } => "To Bezier form".to_owned(),
            Self::InterpolateEnds { .. } => "Interpolate ends".to_owned(),
            Self::TransformCurve { map, .. } => map.name(),
            Self::OffsetCurve { distance, .. } => format!("Offset by {}", short(*distance)),
            Self::Reverse { .. } => "Reverse".to_owned(),
            Self::TransformPoints { points, .. } => counted("Transform", points.len(), "point"),
            Self::SetContent { label, .. } | Self::ReplaceCurve { label, .. } | Self::Batch { label, .. } => {
                label.clone()
            }
        }
    }
}

/// An affine map of the plane. Angles count counterclockwise from the x-axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveMap {
    /// A translation.
    Move {
        /// The vector.
        by: DVec2,
    },
    /// A rotation.
    Rotate {
        /// The angle.
        degrees: f64,
        /// The centre.
        about: DVec2,
    },
    /// Another size, or sizes along both axes.
    Scale {
        /// Factors for x and y, not 0.
        factors: DVec2,
        /// The point that stays.
        about: DVec2,
    },
    /// A reflection in a line.
    Mirror {
        /// The angle of the line.
        degrees: f64,
        /// A point of the line.
        through: DVec2,
    },
}

impl CurveMap {
    fn name(self) -> String {
        match self {
            Self::Move { by } => format!("Move by ({}, {})", short(by.x), short(by.y)),
            Self::Rotate { degrees, .. } => format!("Rotate by {}°", short(degrees)),
            Self::Scale { factors, .. } if factors.x.to_bits() == factors.y.to_bits() => {
                format!("Scale by {}", short(factors.x))
            }
            Self::Scale { factors, .. } => format!("Scale by ({}, {})", short(factors.x), short(factors.y)),
            Self::Mirror { degrees, .. } => format!("Mirror in a line at {}°", short(degrees)),
        }
    }
}

/// `Chord length knots` and so on.
fn rule_name(rule: KnotRule) -> &'static str {
    match rule {
        KnotRule::Uniform => "Uniform knots",
        KnotRule::EndInterpolating => "End-interpolating knots",
        KnotRule::ChordLength => "Chord length knots",
        KnotRule::Centripetal => "Centripetal knots",
        KnotRule::Averaged => "Averaged knots",
    }
}

fn counted(verb: &str, count: usize, noun: &str) -> String {
    if count == 1 { format!("{verb} {noun}") } else { format!("{verb} {count} {noun}s") }
}

/// A number with at most four digits after the point, or two significant ones if it is tiny or huge.
pub(in crate::document) fn short(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.1e}");
    }
    let rounded = (value * 1e4).round() / 1e4;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
