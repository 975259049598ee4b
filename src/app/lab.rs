//! The state that every panel and workspace shares: the open document with its undo, the view, the selection, what is
//! hovered, the look, and the messages.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use glam::DVec2;

use crate::app::chart_panel::Charts;
use crate::app::command::Command;
use crate::app::sheet::{Sheet, Shelf};
use crate::app::side_rooms::SideRooms;
use crate::app::story_cache::StoryCache;
use crate::app::workspace::Room;
use crate::core::spline_curve::Nurbs;
use crate::course::{Lesson, Stepper, Verdict};
use crate::document::{
    Approximation, Document, Edit, EditError, History, Object, ObjectId, Outcome, ShapeChange, StepperKind,
    View,
};
use crate::figure::theme::Theme;

/// What is selected: one object, and some of its control points or one of its knots.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// The object that the inspector, the knot line and the stepper show.
    pub object: Option<ObjectId>,
    /// Indices of its selected control points.
    pub points: BTreeSet<usize>,
    /// Value of its selected knot.
    pub knot: Option<f64>,
}

/// The thing under the pointer, in whichever view; all views light it up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hovered {
    /// Nothing.
    #[default]
    Nothing,
    /// A control point, and with it its B-spline.
    Point(ObjectId, usize),
    /// A knot, by value.
    Knot(ObjectId, f64),
    /// A place on a curve, by parameter.
    Curve(ObjectId, f64),
    /// An entry of the triangular scheme: level and position in it.
    Entry(ObjectId, usize, usize),
}

/// What the left mouse button does on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Select, drag, marquee.
    #[default]
    Select,
    /// Click control points of a new curve.
    Draw,
    /// Click data of an approximation.
    AddPoint,
}

/// What the drawing tool makes of the clicks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DrawMode {
    /// Control points.
    #[default]
    Points,
    /// A cubic spline through the points.
    Through,
    /// A stroke by free hand, fitted by a spline.
    Stroke,
    /// A circle from its centre and a point of its rim.
    Circle,
    /// A circular arc through three points.
    Arc,
    /// An ellipse from its centre and two half axes.
    Ellipse,
    /// A conic arc from three control points and the weight of the middle one.
    Conic,
    /// The conic through five points.
    ConicFive,
}

/// Kind of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Something was done.
    Done,
    /// Something could not be done.
    Problem,
}

/// A message that is shown for a while.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Its kind.
    pub tone: Tone,
    /// The sentence.
    pub text: String,
}

/// The stepper panel: which frame is shown and whether it plays.
#[derive(Clone, Debug, Default)]
pub struct StepperState {
    /// Whether the panel is open; the canvas then shows the frame.
    pub open: bool,
    /// Index of the frame.
    pub frame: usize,
    /// Whether frames follow each other by themselves.
    pub playing: bool,
    /// Seconds since the last frame while playing.
    pub elapsed: f64,
}

/// What hands do to knots, and what the knot line shows.
#[derive(Clone, Debug)]
pub struct KnotHands {
    /// Whether the curve stays, nearly, while knots move; else the control points stay.
    pub keep_curve: bool,
    /// Largest deviation when knots are removed that the curve does not need.
    pub tolerance: f64,
    /// The builder of one B-spline, if it is shown in place of the basis.
    pub builder: Option<BasisBuilder>,
}

impl Default for KnotHands {
    fn default() -> Self {
        Self { keep_curve: false, tolerance: 0.01, builder: None }
    }
}

/// One B-spline as two of lower degree.
#[derive(Clone, Debug, PartialEq)]
pub struct BasisBuilder {
    /// Index of the B-spline.
    pub spline: usize,
    /// Degree of what is taken apart.
    pub degree: usize,
    /// Which of that degree, counted from the left.
    pub part: usize,
    /// From 0, both parts on the axis, to 1, one upon the other.
    pub slide: f64,
}

/// The lesson that is open.
#[derive(Clone, Debug)]
pub struct LessonState {
    /// Index in the list of lessons.
    pub index: usize,
    /// The lesson.
    pub lesson: Lesson,
    /// What has been typed as an answer.
    pub answer: String,
    /// The verdict on the last answer.
    pub verdict: Option<Verdict>,
}

/// Which page the right panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SidePage {
    /// Properties of the selected object.
    #[default]
    Inspector,
    /// The triangular scheme.
    Stepper,
    /// The open lesson.
    Lesson,
    /// A room for one subject.
    Rooms,
}

/// The shared state.
#[derive(Debug)]
pub struct Lab {
    /// The document and its undo.
    pub history: History,
    /// Camera, parameters, panels; saved with the document, not undone.
    pub view: View,
    /// Where the document was opened from or saved to.
    pub path: Option<PathBuf>,
    /// Whether the document was brought back after a crash and has not been saved since.
    pub brought_back: bool,
    /// Documents that are put aside.
    pub shelf: Shelf,
    /// The selection.
    pub selection: Selection,
    /// What was under the pointer in the last frame.
    pub hovered: Hovered,
    /// What is found under the pointer in this frame; becomes [`Self::hovered`].
    pub hovering: Hovered,
    /// The control points that go with the entry under the pointer, while [`Self::hovered`] is an entry.
    pub entry_partners: Vec<usize>,
    /// The tool.
    pub tool: Tool,
    /// What the drawing tool draws.
    pub draw_mode: DrawMode,
    /// Points of an unfinished drawing that can be undone and redone.
    pub drawn: (usize, usize),
    /// How near a spline must come to a drawn stroke, in pixels.
    pub stroke_tolerance: f64,
    /// Whether the selected curve has handles on itself, the edit points.
    pub edit_points: bool,
    /// Whether the selected curve has handles for the ratios of neighbouring weights.
    pub weight_points: bool,
    /// Colours and sizes.
    pub theme: Theme,
    /// Page of the right panel.
    pub side: SidePage,
    /// The stepper panel.
    pub stepper: StepperState,
    /// The knot line.
    pub knots: KnotHands,
    /// The rooms beside the canvas.
    pub rooms: SideRooms,
    /// The charts.
    pub charts: Charts,
    /// The open lesson, if any.
    pub lesson: Option<LessonState>,
    /// What the last operation did to the shape, as a sentence for the status line.
    pub shape_note: Option<String>,
    /// What the last operation did to the shape, for the badge.
    pub shape: ShapeChange,
    /// The document before the last operation: curves that differ from it have a ghost.
    pub before: Option<Document>,
    /// Messages not yet shown.
    pub messages: Vec<Message>,
    /// Commands asked for by panels, carried out at the end of the frame.
    pub commands: Vec<Command>,
    /// Size of the canvas in points in the last frame.
    pub canvas_size: DVec2,
    /// The last story of the stepper.
    pub story_cache: StoryCache,
    /// Whether long work is done within the frame instead of beside it: for tests, which then need not wait.
    pub at_once: bool,
}

impl Lab {
    /// The lab with `document` on its desk.
    pub fn new(document: Document, view: View) -> Self {
        let sheet = Sheet::new(document, view, None);
        Self {
            history: sheet.history,
            view: sheet.view,
            path: sheet.path,
            brought_back: sheet.brought_back,
            shelf: Shelf::default(),
            selection: sheet.selection,
            hovered: Hovered::Nothing,
            hovering: Hovered::Nothing,
            entry_partners: Vec::new(),
            tool: Tool::Select,
            draw_mode: DrawMode::Points,
            drawn: (0, 0),
            stroke_tolerance: 2.5,
            edit_points: false,
            weight_points: false,
            theme: Theme::light(),
            side: SidePage::Inspector,
            stepper: StepperState::default(),
            knots: KnotHands::default(),
            rooms: SideRooms::default(),
            charts: Charts::default(),
            lesson: None,
            shape_note: None,
            shape: ShapeChange::None,
            before: None,
            messages: Vec::new(),
            commands: Vec::new(),
            canvas_size: DVec2::new(800.0, 600.0),
            story_cache: StoryCache::default(),
            at_once: false,
        }
    }

    /// Puts `sheet` on the desk and gives back what lay there.
    pub fn put(&mut self, sheet: Sheet) -> Sheet {
        self.commit();
        self.hovered = Hovered::Nothing;
        self.hovering = Hovered::Nothing;
        self.tool = Tool::Select;
        self.stepper = StepperState { open: self.stepper.open, ..StepperState::default() };
        self.rooms.space = None;
        self.shape_note = None;
        self.before = None;
        self.shelf.opened += 1;
        Sheet {
            history: std::mem::replace(&mut self.history, sheet.history),
            view: std::mem::replace(&mut self.view, sheet.view),
            path: std::mem::replace(&mut self.path, sheet.path),
            selection: std::mem::replace(&mut self.selection, sheet.selection),
            brought_back: std::mem::replace(&mut self.brought_back, sheet.brought_back),
        }
    }

    /// Whether the document holds anything that is in no file.
    pub fn is_modified(&self) -> bool {
        self.brought_back || self.history.is_modified()
    }

    /// The room that the lab shows.
    pub fn room(&self) -> Room {
        Room::by_key(&self.view.workspace)
    }

    /// Goes to `room`; if the selected object does not belong there, the last one that does is selected.
    pub fn enter(&mut self, room: Room) {
        room.key().clone_into(&mut self.view.workspace);
        let objects = self.history.document().objects();
        let at_home = |id| objects.iter().any(|object| object.id == id && Room::of(&object.content) == room);
        if !self.selection.object.is_some_and(at_home) {
            let last = objects.iter().rfind(|object| Room::of(&object.content) == room);
            self.selection = Selection { object: last.map(|object| object.id), ..Selection::default() };
        }
    }

    /// Selects `object` and goes to the room where it is worked on.
    pub fn select(&mut self, object: ObjectId) {
        if let Some(found) = self.history.document().object(object) {
            let room = Room::of(&found.content);
            self.selection = Selection { object: Some(object), ..Selection::default() };
            self.enter(room);
        }
    }

    /// The selected object, shared: it stays as it is while the document changes.
    pub fn selected(&self) -> Option<Arc<Object>> {
        self.selection.object.and_then(|id| self.history.document().object(id)).cloned()
    }

    /// The curve of the selected object.
    pub fn curve(&self) -> Option<&Nurbs<DVec2>> {
        self.selection.object.and_then(|id| self.history.document().curve(id))
    }

    /// The approximation of the selected object.
    pub fn approximation(&self) -> Option<&Approximation> {
        self.selection.object.and_then(|id| self.history.document().approximation(id))
    }

    /// The parameter at which `object` is looked at; the middle of its interval if none was chosen yet.
    pub fn parameter(&self, object: ObjectId) -> Option<f64> {
        let (left, right) = self.history.document().curve(object)?.space().parameter_interval();
        let middle = left + 0.5 * (right - left);
        let chosen = self.view.parameters.get(&object).copied().unwrap_or(middle);
        Some(chosen.clamp(left, right))
    }

    /// Chooses the parameter at which `object` is looked at, kept inside its interval. Not an edit: never undone.
    pub fn set_parameter(&mut self, object: ObjectId, parameter: f64) {
        if let Some(curve) = self.history.document().curve(object)
            && parameter.is_finite()
        {
            let (left, right) = curve.space().parameter_interval();
            self.view.parameters.insert(object, parameter.clamp(left, right));
        }
    }

    /// Applies `edit` as one undo step; says what happened to the shape, or why it could not be done.
    pub fn edit(&mut self, edit: Edit) -> Option<Outcome> {
        let before = self.history.document().clone();
        let result = self.history.apply(edit);
        if result.is_ok() {
            self.before = Some(before);
        }
        self.report(result)
    }

    /// Starts an interaction such as a drag; see [`History::begin`].
    pub fn begin(&mut self, name: impl Into<String>) {
        if !self.history.is_interacting() {
            self.before = Some(self.history.document().clone());
            self.history.begin(name);
        }
    }

    /// The running interaction now amounts to `edit`, counted from its beginning.
    pub fn update(&mut self, edit: Edit) {
        match self.history.update(edit) {
            Ok(outcome) => self.note_shape(&outcome.shape),
            // A drag that runs into a limit stays at the last possible place; the status line says why.
            Err(error) => self.shape_note = Some(error.to_string()),
        }
    }

    /// Ends the interaction; it becomes one undo step if anything changed.
    pub fn commit(&mut self) {
        self.history.commit();
    }

    /// The chosen algorithm on the selected curve at its parameter.
    pub fn scheme(&self) -> Option<Rc<Stepper>> {
        self.told_scheme()?.ok()
    }

    /// As [`Self::scheme`], or a sentence that says why there is none; `None` without a curve.
    pub fn told_scheme(&self) -> Option<Result<Rc<Stepper>, String>> {
        let object = self.selection.object?;
        let parameter = self.parameter(object)?;
        let object = self.history.document().object(object)?;
        self.story_cache.told(object, self.view.stepper, parameter, &self.view.stepper_choices)
    }

    /// Chooses the algorithm that is told, from its first frame.
    pub fn set_stepper(&mut self, kind: StepperKind) {
        if self.view.stepper != kind {
            self.view.stepper = kind;
            self.stepper = StepperState { open: self.stepper.open, ..StepperState::default() };
        }
    }

    /// What Undo would take back: a point of the drawing under way, else the last step.
    pub fn undo_name(&self) -> Option<&str> {
        if self.drawn.0 > 0 { Some("Drawn point") } else { self.history.undo_name() }
    }

    /// What Redo would do again.
    pub fn redo_name(&self) -> Option<&str> {
        if self.drawn.1 > 0 { Some("Drawn point") } else { self.history.redo_name() }
    }

    /// Says something that was done.
    pub fn done(&mut self, text: impl Into<String>) {
        self.messages.push(Message { tone: Tone::Done, text: text.into() });
    }

    /// Says why something could not be done.
    pub fn problem(&mut self, text: impl Into<String>) {
        self.messages.push(Message { tone: Tone::Problem, text: text.into() });
    }

    /// Drops from the selection what no longer exists.
    pub fn tidy_selection(&mut self) {
        let document = self.history.document();
        if self.selection.object.is_some_and(|id| document.object(id).is_none()) {
            self.selection = Selection::default();
        }
        if self.selection.object.is_none() {
            let room = self.room();
            let at_home = document.objects().iter().rfind(|object| Room::of(&object.content) == room);
            self.selection.object = at_home.map(|object| object.id);
        }
        let object = self.selection.object.and_then(|id| document.object(id));
        let count = object.map_or(0, |object| object.content.point_count());
        self.selection.points.retain(|&point| point < count);
        if let Some(knot) = self.selection.knot
            && self.curve().is_none_or(|curve| curve.space().multiplicity(knot) == 0)
        {
            self.selection.knot = None;
        }
        if self.stepper.open
            && let Some(stepper) = self.scheme()
        {
            self.stepper.frame = self.stepper.frame.min(stepper.frames().len().saturating_sub(1));
        }
    }

    fn report(&mut self, result: Result<Outcome, EditError>) -> Option<Outcome> {
        match result {
            Ok(outcome) => {
                self.note_shape(&outcome.shape);
                self.tidy_selection();
                Some(outcome)
            }
            Err(error) => {
                self.problem(error.to_string());
                None
            }
        }
    }

    fn note_shape(&mut self, shape: &ShapeChange) {
        self.shape = *shape;
        self.shape_note = shape.sentence();
    }
}
