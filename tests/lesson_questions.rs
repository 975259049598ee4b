//! Every question of a lesson that is answered by changing the curve can be answered so, and not otherwise.

use glam::DVec2;
use spline_lab::course::stepper::stepper;
use spline_lab::course::{Answer, Lesson, Task, Verdict, lessons};
use spline_lab::document::{Document, Edit, ObjectId};

fn lesson(section: &str) -> &'static Lesson {
    lessons().iter().find(|lesson| lesson.section == section).expect("the lesson exists")
}

/// The verdict after `edits` of the lesson's scene.
fn after(section: &str, edits: &[Edit]) -> Verdict {
    let lesson = lesson(section);
    lesson.question.check(&edited(lesson, edits), &Answer::Curve)
}

fn edited(lesson: &Lesson, edits: &[Edit]) -> Document {
    let mut document = lesson.document.clone();
    for edit in edits {
        document.apply(edit).unwrap_or_else(|error| panic!("{}: {error}", lesson.section));
    }
    document
}

fn put(object: u64, point: usize, x: f64, y: f64) -> Edit {
    Edit::SetPoint { object: ObjectId(object), point, position: DVec2::new(x, y) }
}

fn weight(point: usize, weight: f64) -> Edit {
    Edit::SetWeight { object: ObjectId(1), point, weight }
}

fn insert(at: f64) -> Edit {
    Edit::InsertKnot { object: ObjectId(1), at }
}

/// The worked solutions that the feedback of the lessons tells.
fn solutions() -> Vec<(&'static str, Vec<Edit>)> {
    let speed = 7.0_f64.sqrt() - 1.0;
    let side = 0.5_f64.sqrt();
    let c_1 = DVec2::new(side, -side) + DVec2::splat(side) * (speed / 3.0);
    vec![
        ("2.1", vec![put(1, 1, 1.0, 8.0 / 3.0), put(1, 2, 3.0, 8.0 / 3.0)]),
        ("2.2", vec![put(1, 2, 3.0, 1.0), put(1, 3, 4.0, 2.0)]),
        ("2.4", vec![put(2, 1, 6.0, -4.0)]),
        ("2.5", vec![put(2, 2, 4.5, -2.0)]),
        ("2.6", vec![insert(0.25), insert(0.25), insert(0.25)]),
        ("2.7", vec![put(1, 1, c_1.x, c_1.y), put(1, 2, c_1.x, -c_1.y)]),
        ("3.2", vec![weight(1, 5.0)]),
        ("3.4", vec![weight(1, side)]),
        ("4.2", vec![Edit::MoveKnot { object: ObjectId(1), knot: 5, to: 4.0 }]),
        (
            "4.4",
            vec![
                insert(0.0),
                put(1, 0, -1.5, 1.5),
                put(1, 1, -0.5, 0.5),
                put(1, 2, 0.0, 0.0),
                put(1, 3, 0.5, 0.5),
                put(1, 4, 1.5, 1.5),
            ],
        ),
    ]
}

#[test]
fn the_worked_solutions_are_right_and_half_of_each_is_not() {
    for (section, edits) in solutions() {
        let verdict = after(section, &edits);
        assert!(verdict.correct, "{section}: {verdict:?}");
        assert_eq!(verdict.message, lesson(section).question.feedback, "{section}: the praise");
        let half = after(section, &edits[..edits.len() - 1]);
        assert!(!half.correct && half.message.len() > 20, "{section} without the last step: {half:?}");
    }
}

#[test]
fn every_goal_of_a_curve_has_a_worked_solution_here() {
    let solved: Vec<&str> = solutions().iter().map(|(section, _)| *section).chain(["6.1"]).collect();
    for lesson in lessons() {
        if matches!(lesson.question.task, Task::Shape { .. }) {
            assert!(solved.contains(&lesson.section.as_str()), "{} has no worked solution", lesson.section);
        }
    }
}

#[test]
fn the_closed_curve_gets_its_corner_at_the_point_that_it_passes_through() {
    let two = [insert(2.0), insert(2.0)];
    let smooth = after("6.1", &two);
    assert!(
        !smooth.correct && smooth.message.contains("same way"),
        "three copies keep the shape: {smooth:?}"
    );
    let document = edited(lesson("6.1"), &two);
    let curve = document.curve(ObjectId(1)).expect("the curve");
    let place = curve.evaluate(2.0).expect("a parameter");
    let corner = curve.points().iter().position(|point| point.distance(place) < 1e-12);
    let corner = corner.expect("a control point lies on the curve");
    let bent = [two[0].clone(), two[1].clone(), put(1, corner, 1.0, 1.0)];
    let verdict = after("6.1", &bent);
    assert!(verdict.correct, "{verdict:?}");
}

#[test]
fn a_point_is_placed_with_the_end_of_the_short_line() {
    let lesson = lesson("2.3");
    let place = |x: f64, y: f64| lesson.question.check(&lesson.document, &Answer::Point(DVec2::new(x, y)));
    assert!(place(2.0625, 1.875).correct, "example 2.3-a from the other end");
    let one_quarter = place(0.5625, 0.875);
    assert!(!one_quarter.correct && one_quarter.message.contains("$p_{0}^{1}$"), "{one_quarter:?}");
}

#[test]
fn the_numbers_are_those_of_the_worked_examples() {
    for (section, expected) in [
        ("3.1", 9.0 / 19.0),
        ("3.3", 19.0 / 8.0),
        ("4.1", 3.0 / 5.0),
        ("4.3", 94.0 / 3.0),
        ("4.6", 5.0 / 6.0),
        ("6.2", 3.0 / 20.0),
        ("6.3", 2.0),
        ("6.4", 4.0),
    ] {
        let lesson = lesson(section);
        let found = lesson.question.right_number(&lesson.document).expect("a number");
        assert!((found - expected).abs() < 1e-12, "{section}: {found} instead of {expected}");
    }
}

#[test]
fn hints_name_what_is_wrong() {
    let hint = |section: &str, text: &str| {
        let lesson = lesson(section);
        let verdict = lesson.question.check(&lesson.document, &Answer::Text(text.to_owned()));
        assert!(!verdict.correct, "{section}: {text}");
        verdict.message
    };
    for (section, text, fact) in [
        ("3.1", "3/8", "all weights were equal"),
        ("3.1", "9", "between 0 and 1"),
        ("3.3", "2", "weights alone"),
        ("4.3", "289/9", "square of the average"),
        ("4.3", "10", "products of 2"),
        ("4.6", "1", "$"),
        ("6.2", "1", "1/4"),
        ("6.3", "3", "divides"),
        ("6.4", "0", "Insert"),
    ] {
        let message = hint(section, text);
        assert!(message.contains(fact), "{section}, {text}: {message}");
    }
    for (section, edits, fact) in [
        ("2.1", vec![put(1, 0, 0.0, 1.0)], "first control point must stay"),
        ("2.2", vec![put(1, 3, 4.0, 3.0)], "polygon crosses the line once"),
        ("2.4", vec![put(2, 0, 5.0, 0.0)], "first control point must stay"),
        ("2.4", vec![put(2, 1, 5.0, -2.0)], "(3, -6) before the joint and (1.5, -3) after"),
        ("2.5", vec![put(2, 1, 5.0, -1.0)], "tangents differ by"),
        ("2.6", vec![insert(0.25)], "is there once; 3 times is asked for"),
        ("2.6", vec![put(1, 1, 1.0, 3.0)], "keep its shape"),
        ("2.6", vec![Edit::ElevateDegree { object: ObjectId(1) }], "degree must stay 3"),
        ("2.7", vec![put(1, 1, 1.0, 0.0)], "left its direction"),
        ("2.7", vec![], "curvature is 2.5, not 1"),
        ("3.2", vec![put(1, 1, 1.0, 2.0)], "$c_{1}$ has moved"),
        ("3.2", vec![Edit::ElevateDegree { object: ObjectId(1) }], "number has changed"),
        ("3.4", vec![weight(1, 0.5)], "inside the circle"),
        ("3.4", vec![], "outside the circle"),
        ("4.2", vec![], "is there twice, so that only 1 of the derivatives is continuous"),
        ("6.1", vec![], "is there once"),
    ] {
        let message = after(section, &edits).message;
        assert!(message.contains(fact), "{section}, {edits:?}: {message}");
    }
}

#[test]
fn a_goal_without_its_other_curve_says_so() {
    for (section, other) in [("2.2", 2), ("2.4", 1), ("4.4", 2)] {
        let verdict = after(section, &[Edit::RemoveObjects { objects: vec![ObjectId(other)] }]);
        assert!(!verdict.correct && verdict.message.contains("gone"), "{section}: {verdict:?}");
    }
}

/// The record of a worked example of the specification.
fn example(id: &str) -> serde_json::Value {
    let all: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("data/examples.json")).expect("the examples can be read");
    all.into_iter().find(|example| example["id"] == id).unwrap_or_else(|| panic!("no example {id}"))
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|number| number.as_f64().expect("a number")).collect()
}

fn close(found: &[f64], expected: &[f64]) -> bool {
    found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
}

#[test]
fn every_scene_is_a_worked_example() {
    for (section, id) in [
        ("2.1", "2.1-a"),
        ("2.2", "2.2-d"),
        ("2.3", "2.3-a"),
        ("2.4", "2.4-d"),
        ("2.5", "2.5-a"),
        ("2.6", "2.6-b"),
        ("3.1", "3.1-a"),
        ("3.2", "3.2-a"),
        ("3.3", "3.3-a"),
        ("4.5", "4.5-a"),
        ("4.6", "4.6-c"),
        ("6.1", "6.1-a"),
        ("6.2", "6.2-a"),
        ("6.3", "6.3-a"),
        ("6.4", "6.4-a"),
    ] {
        let (lesson, input) = (lesson(section), &example(id)["input"]);
        let curve = lesson.document.curve(ObjectId(1)).expect("the curve");
        let flat: Vec<f64> = curve.points().iter().flat_map(|point| point.to_array()).collect();
        let mut compared = 0;
        for (field, value) in input.as_object().expect("a record") {
            let (found, expected) = match field.as_str() {
                "C" | "control" => {
                    (flat.clone(), value.as_array().expect("points").iter().flat_map(numbers).collect())
                }
                "c" => (curve.points().iter().map(|point| point.y).collect(), numbers(value)),
                "w" => (curve.weights().to_vec(), numbers(value)),
                "knots" | "tau" => (curve.space().knots().to_vec(), numbers(value)),
                "T" => {
                    (curve.space().period().into_iter().collect(), vec![value.as_f64().expect("a number")])
                }
                "n" => (vec![curve.degree() as f64], vec![value.as_f64().expect("a number")]),
                _ => continue,
            };
            assert!(close(&found, &expected), "{section}, {id}, {field}: {found:?} instead of {expected:?}");
            compared += 1;
        }
        assert!(compared > 0, "{section}: nothing of {id} was compared");
    }
}

#[test]
fn graphs_in_the_scenes_are_the_worked_examples_stretched() {
    for (section, id, factor) in [("4.3", "4.3-b", 8.0), ("4.4", "4.4-j", 1.0)] {
        let (lesson, example) = (lesson(section), example(id));
        let curve = lesson.document.curve(ObjectId(1)).expect("the curve");
        let heights: Vec<f64> = curve.points().iter().map(|point| factor * point.y).collect();
        assert!(close(&heights, &numbers(&example["expect"]["c"])), "{section}: {heights:?}");
        assert!(close(curve.space().knots(), &numbers(&example["input"]["knots"])), "{section}: knots");
    }
    for (section, id, factor) in [("4.1", "4.1-a", 4.0), ("4.2", "4.2-a", 2.0)] {
        let (lesson, knots) = (lesson(section), numbers(&example(id)["input"]["knots"]));
        let curve = lesson.document.curve(ObjectId(1)).expect("the curve");
        let heights: Vec<f64> = curve.points().iter().map(|point| point.y).collect();
        let k = heights.iter().position(|&height| height > 0.0).expect("a hump");
        let alone =
            heights.iter().enumerate().all(|(j, &height)| height == if j == k { factor } else { 0.0 });
        assert!(alone, "{section}: {heights:?}");
        assert!(close(&curve.space().knots()[k..k + curve.degree() + 2], &knots), "{section}: knots of b");
    }
    // Graphs stand over the knot averages, so that x = t.
    for section in ["4.1", "4.2", "4.3", "4.4"] {
        let curve = lesson(section).document.curve(ObjectId(1)).expect("the curve");
        let places: Vec<f64> = curve.points().iter().map(|point| point.x).collect();
        assert!(close(&places, &curve.space().greville_abscissae()), "{section}: {places:?}");
    }
}

#[test]
fn the_quarter_circle_has_the_ends_of_the_worked_example() {
    let input = example("2.7-b")["input"].clone();
    let curve = lesson("2.7").document.curve(ObjectId(1)).expect("the curve");
    let points = curve.points();
    for (end, point, direction) in
        [(0, points[0], points[1] - points[0]), (1, points[3], points[3] - points[2])]
    {
        assert!(close(&point.to_array(), &numbers(&input["f"][end])), "end {end}: {point}");
        let direction = direction.normalize();
        assert!(close(&direction.to_array(), &numbers(&input["d"][end])), "end {end}: {direction}");
    }
    let conic = lesson("3.4").document.curve(ObjectId(1)).expect("the curve");
    let circle: Vec<Vec<f64>> =
        example("3.4-a")["input"]["C"][0].as_array().expect("points").iter().map(numbers).collect();
    for (point, expected) in conic.points().iter().zip(circle) {
        assert!(close(&point.to_array(), &expected), "{point} instead of {expected:?}");
    }
}

#[test]
fn the_algorithm_of_every_lesson_can_be_told() {
    for lesson in lessons() {
        let selected = lesson.view.selected_object.and_then(|id| Some((id, lesson.document.curve(id)?)));
        let Some((id, curve)) = selected else { continue };
        let (left, right) = curve.space().parameter_interval();
        let t = lesson.view.parameters.get(&id).copied().unwrap_or(0.5 * (left + right));
        let (kind, choices) = (lesson.view.stepper, &lesson.view.stepper_choices);
        let told = stepper(kind, curve, t, choices);
        assert!(told.is_ok_and(|told| told.frames().len() > 1), "{}: {kind:?} at {t}", lesson.section);
    }
}
