//! Lessons in the window without a screen: opened in their order, answered right and wrong, and put back.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Key, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::{Lab, LessonState};
use spline_lab::course::{Task, lessons};
use spline_lab::document::{Edit, ObjectId};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

fn window(size: Vec2) -> Window {
    let mut window = Harness::builder().with_size(size).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    window.run_steps(2);
    window
}

/// The window with the lesson of a section.
fn at(section: &str) -> Window {
    let mut window = window(vec2(1280.0, 1000.0));
    let heading = lessons().iter().find(|lesson| lesson.section == section).unwrap().heading();
    window.get_by_label(&heading).scroll_to_me();
    window.run_steps(3);
    window.get_by_label(&heading).click();
    window.run_steps(4);
    assert_eq!(open(&window).lesson.section, section, "opened by a click in the list");
    window
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn open(window: &Window) -> &LessonState {
    lab(window).lesson.as_ref().expect("a lesson is open")
}

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(4);
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(3);
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn edit(window: &mut Window, edit: Edit) {
    window.state_mut().as_mut().unwrap().lab_mut().edit(edit).expect("possible");
    window.run_steps(2);
}

/// Types an answer, in place of the one before, and ends with Enter.
fn answer(window: &mut Window, text: &str) -> bool {
    let field = window.get_by_label("Answer");
    field.scroll_to_me();
    field.focus();
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(2);
    window.get_by_label("Answer").type_text(text);
    window.run_steps(2);
    press(window, Key::Enter);
    open(window).verdict.as_ref().expect("judged").correct
}

#[test]
fn page_down_opens_every_lesson_in_the_order_of_the_course() {
    let mut window = window(vec2(1024.0, 700.0));
    for (index, lesson) in lessons().iter().enumerate() {
        press(&mut window, Key::PageDown);
        assert_eq!(open(&window).index, index, "{}", lesson.section);
        assert_eq!(lab(&window).history.document(), &lesson.document, "{}: the scene", lesson.section);
        for words in [format!("Section {}", lesson.section), format!("{} of {}", index + 1, lessons().len())]
        {
            assert!(window.query_by_label(&words).is_some(), "{words} is not shown");
        }
        window.run_steps(20);
        let listed = window.get_by_label(&lesson.heading()).rect();
        assert!(listed.min.y > 100.0 && listed.max.y < 690.0, "{} is out of sight: {listed}", lesson.section);
    }
    press(&mut window, Key::PageDown);
    assert_eq!(open(&window).index, lessons().len() - 1, "the last one stays");
    press(&mut window, Key::PageUp);
    assert_eq!(open(&window).index, lessons().len() - 2, "and back");
}

#[test]
fn numbers_are_typed_right_and_wrong() {
    for (section, wrong, right) in [("3.1", "3/8", "9/19"), ("4.1", "0,5", "0,6"), ("6.3", "3", "2")] {
        let mut window = at(section);
        assert!(!answer(&mut window, wrong), "{section}: {wrong}");
        assert!(window.query_by_label("Not yet.").is_some(), "{section}: the verdict is shown");
        assert!(lab(&window).shelf.answered.is_empty(), "{section}: nothing is answered yet");
        assert!(answer(&mut window, right), "{section}: {right}");
        assert!(window.query_by_label("Right.").is_some(), "{section}: the praise is shown");
        let index = open(&window).index;
        assert!(lab(&window).shelf.answered.contains(&index), "{section}: the list shows a tick");
        assert_eq!(lab(&window).history.steps().0, 0, "{section}: typing an answer changes nothing");
    }
}

#[test]
fn knots_inserted_with_the_key_answer_the_question_about_subdivision() {
    let mut window = at("2.6");
    for copies in 1..=3 {
        click(&mut window, "Check the curve");
        assert!(!open(&window).verdict.as_ref().unwrap().correct, "before copy {copies}");
        press(&mut window, Key::K);
    }
    click(&mut window, "Check the curve");
    assert!(open(&window).verdict.as_ref().unwrap().correct, "{:?}", open(&window).verdict);
}

#[test]
fn a_weight_answers_the_question_about_conics() {
    let mut window = at("3.4");
    click(&mut window, "Check the curve");
    let hint = open(&window).verdict.clone().unwrap();
    assert!(!hint.correct && hint.message.contains("outside"), "{hint:?}");
    edit(&mut window, Edit::SetWeight { object: ObjectId(1), point: 1, weight: 0.708 });
    click(&mut window, "Check the curve");
    assert!(open(&window).verdict.as_ref().unwrap().correct, "{:?}", open(&window).verdict);
}

#[test]
fn the_selected_end_of_the_pointer_is_the_answer() {
    let mut window = at("2.3");
    let check = "Check the selected point";
    edit(&mut window, Edit::SetPoint { object: ObjectId(2), point: 1, position: (2.06, 1.88).into() });
    let lab = window.state_mut().as_mut().unwrap().lab_mut();
    lab.select(ObjectId(2));
    lab.selection.points = [0].into();
    window.run_steps(3);
    click(&mut window, check);
    assert!(!open(&window).verdict.as_ref().unwrap().correct, "the other end");
    window.state_mut().as_mut().unwrap().lab_mut().selection.points = [1].into();
    window.run_steps(3);
    click(&mut window, check);
    assert!(open(&window).verdict.as_ref().unwrap().correct, "{:?}", open(&window).verdict);
}

/// Drags the control point of an object to a place in the plane.
fn drag_point(window: &mut Window, object: u64, point: usize, to: DVec2) {
    let found = lab(window).history.document().object(ObjectId(object)).unwrap();
    let label = format!("Control point {point} of {}", found.name);
    let by = to - found.curve().unwrap().points()[point];
    let scale = lab(window).view.camera.scale;
    let from = window.get_by_label(&label).rect().center();
    let by = vec2((by.x * scale) as f32, (-by.y * scale) as f32);
    drag_by(window, from, by);
}

fn drag_by(window: &mut Window, from: Pos2, by: Vec2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for part in 1..=4 {
        window.hover_at(from + by * (part as f32 / 4.0));
        window.step();
    }
    window.drop_at(from + by);
    window.run_steps(2);
}

#[test]
fn dragging_the_points_answers_the_questions_about_joints() {
    for (section, point, to) in [("2.4", 1, DVec2::new(6.0, -4.0)), ("2.5", 2, DVec2::new(4.5, -2.0))] {
        let mut window = at(section);
        click(&mut window, "Check the curve");
        assert!(!open(&window).verdict.as_ref().unwrap().correct, "{section}");
        drag_point(&mut window, 2, point, to);
        click(&mut window, "Check the curve");
        assert!(open(&window).verdict.as_ref().unwrap().correct, "{section}: {:?}", open(&window).verdict);
        assert_eq!(lab(&window).history.steps().0, 1, "{section}: one drag, one step");
    }
}

#[test]
fn keys_that_the_lessons_name_keep_the_shape_and_do_what_is_said() {
    let count = |window: &Window| lab(window).curve().unwrap().points().len();
    for (section, keys, more_points) in [
        ("2.1", &[Key::E][..], 1),
        ("2.6", &[Key::R, Key::R], 3),
        ("4.2", &[Key::E], 3),
        ("4.3", &[Key::R], 4),
        ("6.1", &[Key::R, Key::R], 12),
        ("6.1", &[Key::C], 3),
        ("6.2", &[Key::R], 3),
        ("6.3", &[Key::K], 1),
    ] {
        let mut window = at(section);
        let (before, points) = (lab(&window).curve().unwrap().clone(), count(&window));
        keys.iter().for_each(|&key| press(&mut window, key));
        assert_eq!(count(&window), points + more_points, "{section}: {keys:?}");
        let after = lab(&window).curve().unwrap();
        let (left, right) = before.space().parameter_interval();
        for i in 0..=50 {
            let t = left + (right - left) * f64::from(i) / 50.0;
            let away = before.evaluate(t).unwrap().distance(after.evaluate(t).unwrap());
            assert!(away < 1e-9, "{section}: {keys:?} moves the curve by {away} at {t}");
        }
    }
}

#[test]
fn the_rooms_that_lessons_name_show_the_example() {
    for (section, key, words) in [
        ("2.7", Key::E, "Three cubics have these ends"),
        ("3.3", Key::H, "In space"),
        ("3.4", Key::C, "Parabola"),
    ] {
        let mut window = at(section);
        window.key_press_modifiers(Modifiers::ALT, key);
        window.run();
        assert!(window.query_by_label(words).is_some(), "{section}: {words}");
    }
}

#[test]
fn a_typed_knot_makes_the_curve_pass_through_a_control_point() {
    for (section, t, copies, place) in
        [("6.3", "5", 1, DVec2::new(1.0, 6.0)), ("6.4", "2", 2, DVec2::new(3.25, 11.0))]
    {
        let mut window = at(section);
        type_into(&mut window, "Parameter t", t);
        for _ in 0..copies {
            press(&mut window, Key::K);
        }
        let points = lab(&window).curve().unwrap().points();
        assert!(points.iter().any(|point| point.distance(place) < 1e-12), "{section}: {points:?}");
    }
}

#[test]
fn a_knot_moves_while_the_parabola_stays() {
    for keep in [false, true] {
        let mut window = at("4.3");
        if keep {
            window.key_press_modifiers(Modifiers::SHIFT, Key::C);
            window.run_steps(3);
        }
        let before = lab(&window).curve().unwrap().clone();
        let from = window.get_by_label("Knot 6").rect().center();
        drag_by(&mut window, from, vec2(-25.0, 0.0));
        let after = lab(&window).curve().unwrap();
        assert_ne!(after.space().knots(), before.space().knots(), "the knot has moved");
        let away = |t: f64| after.evaluate(t).unwrap().distance(before.evaluate(t).unwrap());
        let stays = [1.5, 4.5, 5.5, 6.5].into_iter().all(|t| away(t) < 1e-9);
        assert_eq!(stays, keep, "keep the curve: {keep}");
    }
}

#[test]
fn weight_points_next_to_a_point_draw_the_curve_towards_it() {
    let mut window = at("3.1");
    let distance = |window: &Window| {
        let curve = lab(window).curve().unwrap();
        curve.evaluate(0.6).unwrap().distance(curve.points()[2])
    };
    let before = distance(&window);
    press(&mut window, Key::W);
    for (edge, by) in [("1 to 2", vec2(-43.0, -22.0)), ("2 to 3", vec2(-43.0, 11.0))] {
        let from = window.get_by_label(&format!("Weight point {edge} of Rational cubic")).rect().center();
        drag_by(&mut window, from, by);
    }
    let after = distance(&window);
    assert!(after < 0.8 * before, "from {before} to {after}");
}

/// Clicks a number field, types, and ends with Enter.
fn type_into(window: &mut Window, label: &str, text: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(2);
    window.get_by_label(label).type_text(text);
    window.run_steps(2);
    press(window, Key::Enter);
}

#[test]
fn back_to_the_example_is_one_step_and_loses_nothing() {
    for by_key in [false, true] {
        let mut window = at("2.1");
        let example = open(&window).lesson.document.clone();
        press(&mut window, Key::E);
        press(&mut window, Key::R);
        click(&mut window, "Check the curve");
        let worked = lab(&window).history.document().clone();
        assert_ne!(worked, example, "something was done");
        let steps = lab(&window).history.steps().0;
        if by_key {
            press(&mut window, Key::Home);
        } else {
            click(&mut window, "Back to the example");
        }
        assert_eq!(lab(&window).history.document(), &example, "the example is there");
        assert_eq!(lab(&window).history.steps().0, steps + 1, "one step");
        assert!(open(&window).verdict.is_none(), "the verdict is about another curve");
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.run_steps(3);
        assert_eq!(lab(&window).history.document(), &worked, "undo brings the work back");
        window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        window.run_steps(3);
        assert_eq!(lab(&window).history.document(), &example, "redo");
        press(&mut window, Key::Home);
        assert_eq!(lab(&window).history.steps().0, steps + 1, "nothing to restore, no step");
    }
}

#[test]
fn every_lesson_about_curves_can_be_judged_in_the_window() {
    let mut window = window(vec2(1280.0, 1000.0));
    for lesson in lessons() {
        press(&mut window, Key::PageDown);
        let button = match lesson.question.task {
            Task::Shape { .. } => "Check the curve",
            Task::Number { .. } => "Check",
            _ => continue,
        };
        click(&mut window, button);
        let verdict = open(&window).verdict.as_ref().expect("judged");
        assert!(!verdict.correct, "{}: {verdict:?}", lesson.section);
        assert!(window.query_by_label("Not yet.").is_some(), "{}: the verdict is shown", lesson.section);
    }
}
