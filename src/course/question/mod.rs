//! Questions that the mathematics of the core checks: never by comparing pictures, always for the curve as it is now.
//!
//! A [`Question`] has a prompt and a [`Task`]: a number to type, a point to place, a curve to bend.
//! [`Question::check`] computes the right answer from the document and gives a [`Verdict`]; a wrong answer gets a hint
//! drawn from the fact that it violates.

mod elements;
mod fit;
mod joint_goal;
mod kept;
mod knot_goal;
mod mesh;
mod number;
mod place_point;
mod shape_goal;
mod shape_measure;
mod surface;

use std::sync::Arc;

use glam::DVec2;
use serde::Deserialize;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{parse_number, short_number};
use crate::course::stepper::{Entry, Stepper, de_boor_stepper};
use crate::document::{Document, ObjectId};

pub use elements::ElementsQuantity;
pub use fit::FitTask;
pub use joint_goal::{Contact, EndGoal};
pub use kept::Kept;
pub use mesh::MeshQuantity;
pub use number::{Axis, Quantity};
pub use shape_goal::Goal;
pub use surface::{SpaceAxis, SurfaceQuantity};

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
    /// What of the curve must stay as it is in the lesson's scene.
    #[serde(default)]
    pub keep: Vec<Kept>,
    /// The curve in the lesson's scene.
    #[serde(skip)]
    pub original: Option<Arc<Nurbs<DVec2>>>,
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
    /// Type a number of finite elements.
    Elements {
        /// The number that the core computes.
        quantity: ElementsQuantity,
        /// The largest difference that counts as right.
        tolerance: f64,
    },
    /// Type a number of a spline surface.
    Surface {
        /// The number that the core computes.
        quantity: SurfaceQuantity,
        /// The largest difference that counts as right.
        tolerance: f64,
    },
    /// Type a number of a subdivided mesh.
    Mesh {
        /// The number that the core computes.
        quantity: MeshQuantity,
        /// The largest difference that counts as right.
        tolerance: f64,
    },
    /// Place the point `pⁱₖ` of de Boor's scheme, of de Casteljau's for a Bezier curve over `[0, 1]`.
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
    /// Something about a method of an approximation.
    Fit {
        /// The method, numbered from 0.
        method: usize,
        /// What.
        asked: FitTask,
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
        match &self.task {
            Task::Fit { method, asked } => match document.approximation(ObjectId(self.object)) {
                Some(data) => fit::check(data, *method, asked, answer, &self.feedback),
                None => Verdict::wrong(None, "The data of this question are gone. Go back to the example."),
            },
            Task::Elements { quantity, tolerance } => {
                let object = document.object(ObjectId(self.object));
                let Some((membrane, _)) = object.and_then(|object| object.membrane()) else {
                    return Verdict::wrong(
                        None,
                        "The problem of this question is gone. Go back to the example.",
                    );
                };
                typed(answer, |value| elements::check(membrane, quantity, *tolerance, value, &self.feedback))
            }
            Task::Surface { quantity, tolerance } => {
                let object = document.object(ObjectId(self.object));
                let Some(surface) = object.and_then(|object| object.surface()) else {
                    return Verdict::wrong(
                        None,
                        "The surface of this question is gone. Go back to the example.",
                    );
                };
                typed(answer, |value| surface::check(surface, quantity, *tolerance, value, &self.feedback))
            }
            Task::Mesh { quantity, tolerance } => {
                let object = document.object(ObjectId(self.object));
                let Some(mesh) = object.and_then(|object| object.mesh()) else {
                    return Verdict::wrong(
                        None,
                        "The mesh of this question is gone. Go back to the example.",
                    );
                };
                typed(answer, |value| mesh::check(mesh, quantity, *tolerance, value, &self.feedback))
            }
            Task::Number { .. } | Task::PlacePoint { .. } | Task::Shape { .. } => {
                match document.curve(ObjectId(self.object)) {
                    Some(curve) => self.check_curve(document, curve, answer),
                    None => {
                        Verdict::wrong(None, "The curve of this question is gone. Go back to the example.")
                    }
                }
            }
        }
    }

    fn check_curve(&self, document: &Document, curve: &Nurbs<DVec2>, answer: &Answer) -> Verdict {
        match (&self.task, answer) {
            (Task::Number { quantity, tolerance }, _) => {
                typed(answer, |value| number::check(curve, quantity, *tolerance, value, &self.feedback))
            }
            (Task::PlacePoint { parameter, level, index, tolerance }, Answer::Point(point)) => {
                let wanted = place_point::Wanted { parameter: *parameter, level: *level, index: *index };
                place_point::check(curve, wanted, *tolerance, *point, &self.feedback)
            }
            (Task::Shape { goal }, _) => {
                let original = self.original.as_deref();
                let changed = original
                    .and_then(|original| self.keep.iter().find_map(|kept| kept.violation(original, curve)));
                match changed {
                    Some(message) => Verdict::wrong(None, message),
                    None => shape_goal::check(document, curve, goal, &self.feedback),
                }
            }
            _ => Verdict::wrong(None, "Place the point in the picture."),
        }
    }

    /// The right number for the document; `None` for questions without one, or if it is undefined.
    pub fn right_number(&self, document: &Document) -> Option<f64> {
        let object = document.object(ObjectId(self.object))?;
        match &self.task {
            Task::Number { quantity, .. } => quantity.compute(object.curve()?).ok(),
            Task::Elements { quantity, .. } => quantity.compute(object.membrane()?.0).ok(),
            Task::Surface { quantity, .. } => quantity.compute(object.surface()?).ok(),
            Task::Mesh { quantity, .. } => quantity.compute(object.mesh()?).ok(),
            Task::Fit { method, asked } => {
                let data = object.approximation()?;
                let scheme = &data.methods().get(*method)?.scheme;
                fit::right_number(data, scheme, asked).ok().map(|(right, _)| right)
            }
            Task::PlacePoint { .. } | Task::Shape { .. } => None,
        }
    }
}

/// The verdict on `value`: right within `tolerance`, else the hint for the right number.
fn judge(
    value: f64,
    right: Result<f64, String>,
    tolerance: f64,
    feedback: &str,
    hint: impl FnOnce(f64) -> String,
) -> Verdict {
    let right = match right {
        Ok(right) => right,
        Err(reason) => return Verdict::wrong(None, reason),
    };
    let difference = (value - right).abs();
    if difference <= tolerance {
        return Verdict::right(difference, feedback);
    }
    Verdict::wrong(Some(difference), format!("Not {}. {}", short_number(value), hint(right)))
}

/// The verdict of `judge` on the number that was typed.
fn typed(answer: &Answer, judge: impl FnOnce(f64) -> Verdict) -> Verdict {
    let Answer::Text(text) = answer else { return Verdict::wrong(None, "Type a number.") };
    match parse_number(text) {
        Ok(value) => judge(value),
        Err(error) => Verdict::wrong(None, sentence(&error.to_string())),
    }
}

/// De Boor's scheme at `parameter`.
fn scheme(curve: &Nurbs<DVec2>, parameter: f64) -> Result<Stepper, String> {
    de_boor_stepper(curve, parameter).map_err(|error| sentence(&error.to_string()))
}

/// Whether the curve is a Bezier curve over `[0, 1]` without weights, so that its scheme is de Casteljau's.
fn is_bezier(curve: &Nurbs<DVec2>) -> bool {
    let (n, space) = (curve.degree(), curve.space());
    curve.is_polynomial()
        && !space.is_periodic()
        && space.dimension() == n + 1
        && space.multiplicity(0.0) == n
        && space.multiplicity(1.0) == n
}

/// The name of an entry: de Casteljau counts entries from their left parent, de Boor from their right one.
fn name(curve: &Nurbs<DVec2>, entry: &Entry) -> String {
    match entry.index.checked_sub(entry.level) {
        Some(index) if entry.level > 0 && is_bezier(curve) => format!("p_{{{index}}}^{{{}}}", entry.level),
        _ => entry.label.clone(),
    }
}

/// The scheme at `parameter` and in it the entry `p_index^level`, as [`name`] counts.
fn find_entry(
    curve: &Nurbs<DVec2>,
    parameter: f64,
    level: usize,
    index: usize,
) -> Result<(Stepper, Entry), String> {
    let stepper = scheme(curve, parameter)?;
    let own_index = if is_bezier(curve) { index + level } else { index };
    let entry = stepper.table().find(|entry| entry.level == level && entry.index == own_index).cloned();
    match entry {
        Some(entry) => Ok((stepper, entry)),
        None => Err(format!(
            "The curve has changed: at this parameter there is no point $p_{{{index}}}^{{{level}}}$ any more. Go back \
             to the example."
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;
    use crate::document::Edit;

    const KNOTS: [f64; 11] = [0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 8.0, 8.0, 9.0];
    const HEIGHTS: [f64; 7] = [-3.0, 1.0, -5.0, 4.0, 4.0, -7.0, 9.0];

    fn graph(knots: &[f64], heights: &[f64]) -> Nurbs<DVec2> {
        let space = SplineSpace::new(3, knots.to_vec()).unwrap();
        let points =
            space.greville_abscissae().into_iter().zip(heights.iter().copied()).map(DVec2::from).collect();
        Nurbs::polynomial(space, points).unwrap()
    }

    /// A document with the graph of the spline of example 4.5-a, and the number of its object.
    fn document() -> (Document, u64) {
        document_of(graph(&KNOTS, &HEIGHTS))
    }

    fn document_of(curve: Nurbs<DVec2>) -> (Document, u64) {
        let mut document = Document::new();
        let edit = Edit::AddCurve { name: "Graph".into(), curve, display: Default::default() };
        let created = document.apply(&edit).unwrap().created;
        (document, created[0].0)
    }

    fn question(object: u64, task: Task) -> Question {
        let (keep, original) = (Vec::new(), None);
        Question { prompt: String::new(), object, task, feedback: "Right.".into(), keep, original }
    }

    fn number(object: u64, quantity: Quantity) -> Question {
        question(object, Task::Number { quantity, tolerance: 0.005 })
    }

    fn ask(question: &Question, document: &Document, text: &str) -> Verdict {
        question.check(document, &Answer::Text(text.into()))
    }

    fn entry(object: u64, level: usize, index: usize) -> Question {
        number(object, Quantity::Entry { parameter: 5.0, level, index, axis: Axis::Y })
    }

    #[test]
    fn right_numbers_are_those_of_the_worked_example() {
        let (document, object) = document();
        let rows = [vec![1.0, -5.0, 4.0, 4.0], vec![-4.0, 1.0, 4.0], vec![0.0, 2.0], vec![1.0]];
        for (level, row) in rows.iter().enumerate() {
            for (j, expected) in row.iter().enumerate() {
                let found = entry(object, level, 1 + level + j).right_number(&document).unwrap();
                assert!(
                    (found - expected).abs() < 1e-14,
                    "level {level}, entry {j}: {found} instead of {expected}"
                );
            }
        }
        for (quantity, expected) in [
            (Quantity::Share { parameter: 5.0, level: 1, index: 2 }, 5.0 / 6.0),
            (Quantity::Point { parameter: 4.0, axis: Axis::Y }, -1.5),
            (Quantity::Derivative { parameter: 5.0, axis: Axis::Y }, 3.0),
            (Quantity::Steps { parameter: 4.0 }, 2.0),
            (Quantity::Steps { parameter: 5.0 }, 3.0),
        ] {
            let found = number(object, quantity).right_number(&document).unwrap();
            assert!((found - expected).abs() < 1e-13, "{quantity:?}: {found} instead of {expected}");
        }
    }

    #[test]
    fn fractions_and_decimal_commas_are_accepted() {
        let (document, object) = document();
        let share = number(object, Quantity::Share { parameter: 5.0, level: 1, index: 2 });
        for text in ["5/6", "0.8333", "0,833", " 10 / 12 "] {
            let verdict = ask(&share, &document, text);
            assert!(verdict.correct && verdict.message == "Right.", "{text:?}: {verdict:?}");
        }
        assert!(!ask(&share, &document, "0.84").correct, "beyond the tolerance");
        let verdict = ask(&share, &document, "five sixths");
        assert!(!verdict.correct && verdict.message.contains("five sixths"), "{verdict:?}");
    }

    #[test]
    fn hints_name_the_violated_fact() {
        let (document, object) = document();
        let question = entry(object, 2, 4);
        for (text, fact) in
            [("3", "exchanged"), ("7", "lies between them"), ("1", "That is $p_3^1$"), ("2.5", "0.3333")]
        {
            let verdict = ask(&question, &document, text);
            assert!(!verdict.correct && verdict.message.contains(fact), "{text}: {verdict:?}");
        }
        let share = number(object, Quantity::Share { parameter: 5.0, level: 1, index: 2 });
        for (text, fact) in [("1/6", "$1-\\gamma$"), ("1.2", "between 0 and 1"), ("0.5", "left knot")] {
            let verdict = ask(&share, &document, text);
            assert!(!verdict.correct && verdict.message.contains(fact), "{text}: {verdict:?}");
        }
        let steps = number(object, Quantity::Steps { parameter: 4.0 });
        assert!(ask(&steps, &document, "3").message.contains("degree is 3"), "steps");
        let point = number(object, Quantity::Point { parameter: 5.0, axis: Axis::Y });
        assert!(ask(&point, &document, "4.5").message.contains("between -5 and 4"), "hull");
        let slope = number(object, Quantity::Derivative { parameter: 5.0, axis: Axis::Y });
        assert!(ask(&slope, &document, "-3").message.contains("sign"), "sign of the slope");
    }

    #[test]
    fn the_answer_follows_the_curve_as_it_is_now() {
        let (mut document, object) = document();
        let mut heights = HEIGHTS;
        heights[4] = 7.0;
        let edit = Edit::ReplaceCurve {
            object: ObjectId(object),
            curve: graph(&KNOTS, &heights),
            label: "Lift".into(),
        };
        document.apply(&edit).unwrap();
        // p_4^1 = 3/4*4 + 1/4*7, p_4^2 = 2/3*1 + 1/3*p_4^1
        let expected = 2.0 / 3.0 + 4.75 / 3.0;
        assert!(ask(&entry(object, 2, 4), &document, &expected.to_string()).correct, "{expected}");
        assert!(!ask(&entry(object, 2, 4), &document, "2").correct, "the old number");
    }

    #[test]
    fn a_placed_point_is_judged_by_its_distance() {
        let (document, object) = document();
        let (_, right) = find_entry(document.curve(ObjectId(object)).unwrap(), 5.0, 2, 4).unwrap();
        let right = right.point().unwrap();
        let task = Task::PlacePoint { parameter: 5.0, level: 2, index: 4, tolerance: 0.02 };
        let question = question(object, task);
        let verdict = question.check(&document, &Answer::Point(right + DVec2::new(0.1, 0.0)));
        let size = polygon_size(document.curve(ObjectId(object)).unwrap());
        assert!(verdict.correct, "{verdict:?}");
        assert!((verdict.measured.unwrap() - 0.1 / size).abs() < 1e-12, "{verdict:?}");
        let beside = question.check(&document, &Answer::Point(right + DVec2::new(3.0, -3.0)));
        assert!(!beside.correct && beside.message.contains("beside"), "{beside:?}");
    }

    #[test]
    fn a_corner_needs_a_knot_as_often_as_the_degree() {
        let goal = |object| question(object, Task::Shape { goal: Goal::Corner { at: 4.0 } });
        let (simple, object) = document();
        let verdict = goal(object).check(&simple, &Answer::Curve);
        assert!(!verdict.correct && verdict.message.contains("once"), "{verdict:?}");
        let triple = [0.0, 0.0, 0.0, 1.0, 4.0, 4.0, 4.0, 7.0, 8.0, 9.0, 10.0];
        let (cornered, object) = document_of(graph(&triple, &HEIGHTS));
        assert!(goal(object).check(&cornered, &Answer::Curve).correct, "the polygon bends at c_3");
        // Heights on one line leave the graph straight in spite of the triple knot.
        let line = SplineSpace::new(3, triple.to_vec()).unwrap().greville_abscissae();
        let (straight, object) = document_of(graph(&triple, &line));
        assert!(!goal(object).check(&straight, &Answer::Curve).correct, "a straight line has no corner");
    }

    #[test]
    fn passing_through_a_point_is_measured_to_the_curve() {
        let (document, object) = document();
        let curve = document.curve(ObjectId(object)).unwrap();
        let on_it = curve.evaluate(2.345).unwrap();
        let through = |point: DVec2| {
            let goal = Goal::PassThrough { point: point.to_array(), tolerance: 1e-9 };
            question(object, Task::Shape { goal }).check(&document, &Answer::Curve)
        };
        let verdict = through(on_it);
        assert!(verdict.correct, "{verdict:?}");
        let end = curve.evaluate(8.0).unwrap();
        let verdict = through(end + DVec2::new(0.0, 2.0));
        let expected = 2.0 / polygon_size(curve);
        assert!(!verdict.correct && verdict.measured.unwrap() <= expected + 1e-12, "{verdict:?}");
    }

    #[test]
    fn a_curve_follows_itself_and_not_another() {
        let (mut document, first) = document();
        let mut heights = HEIGHTS;
        heights[2] += 1.0;
        let edit = Edit::AddCurve {
            name: "Other".into(),
            curve: graph(&KNOTS, &heights),
            display: Default::default(),
        };
        let second = document.apply(&edit).unwrap().created[0].0;
        let follow = |reference, tolerance| {
            let goal = Goal::Follow { reference, tolerance };
            question(first, Task::Shape { goal }).check(&document, &Answer::Curve)
        };
        assert!(follow(first, 1e-12).correct, "itself");
        let other = follow(second, 0.01);
        assert!(
            !other.correct && other.measured.unwrap() < 1.0 / polygon_size(&graph(&KNOTS, &heights)),
            "{other:?}"
        );
        assert!(!follow(99, 0.01).correct, "a curve that is not there");
    }

    #[test]
    fn nothing_to_judge_is_said_and_does_not_panic() {
        let (document, object) = document();
        let question = entry(object, 2, 4);
        assert!(question.check(&document, &Answer::Curve).message.contains("number"), "wrong kind of answer");
        assert!(ask(&entry(99, 2, 4), &document, "2").message.contains("gone"), "no such object");
        assert!(ask(&entry(object, 9, 4), &document, "2").message.contains("changed"), "no such entry");
        let outside = number(object, Quantity::Point { parameter: 99.0, axis: Axis::X });
        assert!(ask(&outside, &document, "2").message.contains("99"), "outside the interval");
    }
}
