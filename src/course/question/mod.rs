//! Questions that the mathematics of the core checks: never by comparing pictures, always for the curve as it is now.
//!
//! A [`Question`] has a prompt and a [`Task`] of one of three kinds: a number to type, a point to place, a curve to bend.
//! [`Question::check`] computes the right answer from the document and gives a [`Verdict`]; a wrong answer gets a hint
//! drawn from the fact that it violates.

mod number;
mod place_point;
mod shape_goal;

use glam::DVec2;
use serde::Deserialize;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::parse_number;
use crate::course::stepper::{Entry, Stepper, de_boor_stepper};
use crate::document::{Document, ObjectId};

pub use number::{Axis, Quantity};
pub use shape_goal::Goal;

/// A question of a lesson.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// What is asked; may contain formulas between dollar signs.
    pub prompt: String,
    /// Number of the object in the lesson's document that the question is about.
    pub object: u64,
    /// What is to be done.
    pub task: Task,
    /// Said when the answer is right; may contain formulas between dollar signs.
    pub feedback: String,
}

/// What is to be done.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Task {
    /// Type a number.
    Number {
        /// The number that the core computes.
        quantity: Quantity,
        /// The largest difference that counts as right, in the unit of the number.
        tolerance: f64,
    },
    /// Place the point `pⁱₖ` of de Boor's scheme.
    PlacePoint {
        /// The parameter.
        parameter: f64,
        /// The level `i`.
        level: usize,
        /// The index `k`.
        index: usize,
        /// The largest distance that counts as right, as a share of the polygon's size.
        tolerance: f64,
    },
    /// Bend the curve until it meets a goal.
    Shape {
        /// The goal.
        goal: Goal,
    },
}

/// What the learner answers.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// A typed number: decimal point or comma, or a fraction.
    Text(String),
    /// A point placed in the plane.
    Point(DVec2),
    /// The curve in the document is the answer.
    Curve,
}

/// The judgement of an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Whether the answer is right.
    pub correct: bool,
    /// What was measured: the difference from the right number, the distance from the right point as a share of the
    /// polygon's size, or the quantity of the goal. `None` if nothing could be measured.
    pub measured: Option<f64>,
    /// What to say: praise with the fact behind it, or a hint. May contain formulas between dollar signs.
    pub message: String,
}

impl Verdict {
    fn right(measured: f64, message: impl Into<String>) -> Self {
        Self { correct: true, measured: Some(measured), message: message.into() }
    }

    fn wrong(measured: Option<f64>, message: impl Into<String>) -> Self {
        Self { correct: false, measured, message: message.into() }
    }
}

impl Question {
    /// Judges `answer` for the curve in `document` as it is now.
    ///
    /// An answer of the wrong kind, or a document without the curve, gets a verdict that says so.
    pub fn check(&self, document: &Document, answer: &Answer) -> Verdict {
        let Some(curve) = document.curve(ObjectId(self.object)) else {
            return Verdict::wrong(None, "The curve of this question is gone. Open the lesson again.");
        };
        match (&self.task, answer) {
            (Task::Number { quantity, tolerance }, Answer::Text(text)) => match parse_number(text) {
                Ok(value) => number::check(curve, quantity, *tolerance, value, &self.feedback),
                Err(error) => Verdict::wrong(None, sentence(&error.to_string())),
            },
            (Task::PlacePoint { parameter, level, index, tolerance }, Answer::Point(point)) => {
                let wanted = place_point::Wanted { parameter: *parameter, level: *level, index: *index };
                place_point::check(curve, wanted, *tolerance, *point, &self.feedback)
            }
            (Task::Shape { goal }, _) => shape_goal::check(document, curve, goal, &self.feedback),
            (Task::Number { .. }, _) => Verdict::wrong(None, "Type a number."),
            (Task::PlacePoint { .. }, _) => Verdict::wrong(None, "Place the point in the picture."),
        }
    }

    /// The right number of a [`Task::Number`] for the curve in `document`; `None` for other kinds or if it is undefined.
    pub fn right_number(&self, document: &Document) -> Option<f64> {
        let curve = document.curve(ObjectId(self.object))?;
        match &self.task {
            Task::Number { quantity, .. } => quantity.compute(curve).ok(),
            _ => None,
        }
    }
}

/// De Boor's scheme at `parameter` and in it the entry `p_index^level`.
fn find_entry(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    level: usize,
    index: usize,
) -> Result<(Stepper, Entry), String> {
    let stepper = de_boor_stepper(curve, parameter).map_err(|error| sentence(&error.to_string()))?;
    let entry = stepper.table().find(|entry| entry.level == level && entry.index == index).cloned();
    match entry {
        Some(entry) => Ok((stepper, entry)),
        None => Err(format!(
            "The curve has changed: at this parameter there is no point $p_{{{index}}}^{{{level}}}$ any more. Open the \
             lesson again."
        )),
    }
}

/// The two parents of an entry above level 0.
fn parents<'a>(stepper: &'a Stepper, entry: &Entry) -> Option<(&'a Entry, &'a Entry)> {
    let below = entry.level.checked_sub(1)?;
    Some((stepper.entry(below, entry.position)?, stepper.entry(below, entry.position + 1)?))
}

/// Diagonal of the bounding box of the control points.
fn polygon_size(curve: &Nurbs<DVec2>) -> f64 {
    let first = curve.points().first().copied().unwrap_or(DVec2::ZERO);
    let (low, high) =
        curve.points().iter().fold((first, first), |(low, high), &point| (low.min(point), high.max(point)));
    (high - low).length()
}

/// `text` with a capital letter and a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
