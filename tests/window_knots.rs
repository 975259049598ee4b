//! The knots of the Curves room without a screen: by mouse and by keys, on the line, the dial and as a list, and that undo takes it back.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Event, Key, Modifiers, OutputCommand, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::command::Command;
use spline_lab::app::lab::{Hovered, Lab};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, View, from_json, to_json};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

const OPEN: [f64; 11] = [-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0];

fn open_curve() -> Nurbs<DVec2> {
    let points = [(0.0, 0.0), (1.0, 2.0), (2.5, 2.5), (4.0, -1.0), (5.0, 0.0), (6.0, 2.0), (7.5, 1.0)];
    let points = points.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
    Nurbs::polynomial(SplineSpace::new(3, OPEN.to_vec()).unwrap(), points).unwrap()
}

/// A rational closed cubic with seven knots in a period of 7.
fn closed_curve() -> Nurbs<DVec2> {
    let space = SplineSpace::periodic(3, 7.0, (0..7).map(f64::from).collect()).unwrap();
    let points =
        (0..7).map(|k| DVec2::from_angle(f64::from(k) * 0.9) * (2.0 + 0.3 * f64::from(k % 3))).collect();
    Nurbs::new(space, points, (0..7).map(|k| 1.0 + 0.25 * f64::from(k % 2)).collect()).unwrap()
}

/// The Curves room with one selected curve.
fn window(curve: Nurbs<DVec2>) -> Window {
    let mut harness = Harness::builder().with_size(vec2(1500.0, 900.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    harness.step();
    let mut document = Document::new();
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: "C".to_owned(), curve, display }).unwrap();
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    harness.run_steps(4);
    harness
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn lab_mut(window: &mut Window) -> &mut Lab {
    window.state_mut().as_mut().unwrap().lab_mut()
}

fn curve(window: &Window) -> Nurbs<DVec2> {
    lab(window).curve().unwrap().clone()
}

fn knots(window: &Window) -> Vec<f64> {
    curve(window).space().knots().to_vec()
}

fn place(window: &Window, label: &str) -> Pos2 {
    window.get_by_label(label).rect().center()
}

fn key(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

fn undo(window: &mut Window) {
    key(window, Modifiers::COMMAND, Key::Z);
}

fn command(window: &mut Window, command: Command) {
    lab_mut(window).commands.push(command);
    window.run_steps(3);
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

/// Presses on `from` and moves by `by` in steps; the button stays down.
fn hold(window: &mut Window, from: Pos2, by: Vec2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for part in 1..=4 {
        window.hover_at(from + by * (part as f32 / 4.0));
        window.step();
    }
}

fn drag(window: &mut Window, from: Pos2, by: Vec2) {
    hold(window, from, by);
    window.drop_at(from + by);
    window.run_steps(3);
}

fn double_click(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.step();
    for pressed in [true, false, true, false] {
        let modifiers = Modifiers::NONE;
        window.event(Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers });
        window.step();
    }
    window.run_steps(3);
}

fn type_into(window: &mut Window, label: &str, text: &str) {
    click(window, label);
    window.get_by_label(label).type_text(text);
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Enter);
}

/// Largest distance at 100 equal parameters of the first.
fn distance(a: &Nurbs<DVec2>, b: &Nurbs<DVec2>) -> f64 {
    let (left, right) = a.space().parameter_interval();
    (0..=100)
        .map(|i| left + (right - left) * f64::from(i) / 100.0)
        .map(|t| a.evaluate(t).unwrap().distance(b.evaluate(t).unwrap()))
        .fold(0.0, f64::max)
}

fn says(window: &Window, text: &str) -> bool {
    window.query_all_by_label_contains(text).count() > 0
}

#[test]
fn a_knot_is_dragged_stacked_and_pulled_apart_with_the_mouse() {
    let mut window = window(open_curve());
    let (two, three) = (place(&window, "Knot 2"), place(&window, "Knot 3"));
    hold(&mut window, two, vec2(three.x - two.x - 4.0, 0.0));
    assert!(says(&window, "2 copies \u{b7} C\u{b9}"), "multiplicity and smoothness beside the pointer");
    assert!(says(&window, "control points kept, curve moves by up to"), "what it does to the curve");
    window.drop_at(three - vec2(4.0, 0.0));
    window.run_steps(3);
    assert_eq!(knots(&window)[5..7], [3.0, 3.0], "stacked");
    assert_eq!(curve(&window).points(), open_curve().points(), "the points are kept");
    let double = place(&window, "Knot 3, 2 copies");
    drag(&mut window, double, vec2(-40.0, 0.0));
    let apart = knots(&window);
    assert!(apart[5] < 2.9 && apart[6] == 3.0, "one copy pulled off: {apart:?}");
    undo(&mut window);
    undo(&mut window);
    assert_eq!(curve(&window), open_curve(), "undone exactly");
}

#[test]
fn the_knot_under_the_press_moves_even_if_the_frame_is_slow() {
    let mut window = window(open_curve());
    let (two, three) = (place(&window, "Knot 2"), place(&window, "Knot 3"));
    let t = lab(&window).parameter(lab(&window).selection.object.unwrap());
    window.hover_at(two);
    window.step();
    // The press and the way to the next knot come in one frame.
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    window.input_mut().events.extend([
        Event::PointerButton { pos: two, button, pressed: true, modifiers },
        Event::PointerMoved(three),
    ]);
    window.step();
    window.hover_at(three - vec2(30.0, 0.0));
    window.step();
    window.drop_at(three - vec2(30.0, 0.0));
    window.run_steps(3);
    let moved = knots(&window);
    assert!(moved[5] > 2.3 && moved[5] < 3.0 && moved[6..] == OPEN[6..], "{moved:?}");
    assert_eq!(lab(&window).parameter(lab(&window).selection.object.unwrap()), t, "t stays");
    assert_eq!(lab(&window).history.steps().0, 1, "one step");
    // A press that stays where it is selects and changes nothing.
    let one = place(&window, "Knot 1");
    drag(&mut window, one, vec2(2.0, 1.0));
    assert_eq!((lab(&window).selection.knot, lab(&window).history.steps().0), (Some(1.0), 1), "a click");
}

#[test]
fn a_move_that_cannot_be_is_pushed_back_with_its_reason() {
    let mut window = window(open_curve());
    let two = place(&window, "Knot 2");
    hold(&mut window, two, vec2(600.0, 0.0));
    assert!(says(&window, "Knots keep their order: it cannot pass 3"), "beside the pointer");
    assert_eq!(knots(&window)[5..7], [3.0, 3.0], "as far as it goes");
    window.key_press(Key::Escape);
    window.step();
    window.drop_at(two);
    window.run_steps(3);
    assert_eq!(curve(&window), open_curve(), "Escape takes the drag back");

    // A full stack takes no fourth copy.
    lab_mut(&mut window).edit(Edit::SetKnots {
        object: spline_lab::document::ObjectId(1),
        knots: vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.5, 1.5, 4.0, 4.0, 4.0, 5.0],
    });
    lab_mut(&mut window).edit(Edit::InsertKnot { object: spline_lab::document::ObjectId(1), at: 1.5 });
    window.run_steps(3);
    let (one, full) = (place(&window, "Knot 1"), place(&window, "Knot 1.5, 3 copies"));
    hold(&mut window, one, vec2(full.x - one.x, 0.0));
    assert!(says(&window, "1.5 is full: with 4 copies a curve of degree 3 would fall apart"), "the reason");
    window.drop_at(full);
    window.run_steps(3);
    assert_eq!(curve(&window).space().multiplicity(1.5), 3, "still three copies");
}

#[test]
fn keys_choose_move_stack_and_remove_a_knot() {
    let mut window = window(open_curve());
    lab_mut(&mut window).selection.knot = Some(1.0);
    key(&mut window, Modifiers::NONE, Key::Period);
    assert_eq!(lab(&window).selection.knot, Some(2.0), "the next one");
    key(&mut window, Modifiers::NONE, Key::ArrowRight);
    assert_eq!(knots(&window)[5], 2.01, "a hundredth");
    key(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(knots(&window)[5], 2.1, "ten steps, on the grid of ten");
    let moved = curve(&window);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    assert_eq!(knots(&window)[5..7], [2.1, 2.1], "a copy more");
    assert!(distance(&moved, &curve(&window)) < 1e-12, "the shape is kept");
    key(&mut window, Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(knots(&window)[5..7], [2.09, 2.1], "pulled apart");
    key(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(knots(&window)[5..7], [2.1, 2.1], "stacked: it does not pass");
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    assert_eq!(curve(&window).space().multiplicity(2.1), 3, "no more than the degree");
    let said = lab(&window).shape_note.clone().unwrap_or_default();
    assert_eq!(said, "2.1 is full: with 4 copies a curve of degree 3 would fall apart", "the reason");
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(curve(&window).space().multiplicity(2.1), 2, "Delete removes a copy");
    lab_mut(&mut window).selection.knot = Some(2.1);
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(curve(&window).space().multiplicity(2.1), 1, "and so does the arrow down");
    key(&mut window, Modifiers::NONE, Key::Comma);
    assert_eq!(lab(&window).selection.knot, Some(1.0), "the one before");
    while lab(&window).history.steps().0 > 0 {
        undo(&mut window);
    }
    assert_eq!(curve(&window), open_curve(), "undone exactly");
}

#[test]
fn a_double_click_inserts_and_the_menu_pulls_apart() {
    let mut window = window(open_curve());
    let at = place(&window, "Knot 1").lerp(place(&window, "Knot 2"), 0.5);
    double_click(&mut window, at);
    let inserted = knots(&window);
    assert!(inserted.len() == 12 && (inserted[5] - 1.5).abs() < 0.02, "{inserted:?}");
    assert!(distance(&open_curve(), &curve(&window)) < 1e-12, "the shape is kept");
    undo(&mut window);
    let two = place(&window, "Knot 2");
    let three = place(&window, "Knot 3");
    drag(&mut window, two, vec2(three.x - two.x, 0.0));
    window.get_by_label("Knot 3, 2 copies").click_secondary();
    window.run_steps(3);
    click(&mut window, "Pull the copies apart");
    let apart = knots(&window);
    assert!(apart[5] < 3.0 && apart[6] > 3.0, "{apart:?}");
    window.get_by_label("Knot 1").click_secondary();
    window.run_steps(3);
    type_into(&mut window, "New value of the knot", "0,75");
    assert_eq!(knots(&window)[4], 0.75, "typed");
}

#[test]
fn with_the_curve_kept_the_points_follow_and_the_deviation_is_shown() {
    let mut window = window(open_curve());
    key(&mut window, Modifiers::SHIFT, Key::C);
    assert!(lab(&window).knots.keep_curve, "by key");
    click(&mut window, "Keep points");
    assert!(!lab(&window).knots.keep_curve, "by mouse");
    click(&mut window, "Keep curve");
    let two = place(&window, "Knot 2");
    hold(&mut window, two, vec2(30.0, 0.0));
    assert!(says(&window, "curve kept within"), "the certified deviation beside the pointer");
    window.drop_at(two + vec2(30.0, 0.0));
    window.run_steps(3);
    let kept = curve(&window);
    assert!(kept.space().knots()[5] > 2.1, "the knot moved");
    assert_ne!(kept.points(), open_curve().points(), "the points followed");
    let moved = Nurbs::polynomial(kept.space().clone(), open_curve().points().to_vec()).unwrap();
    let (near, far) = (distance(&open_curve(), &kept), distance(&open_curve(), &moved));
    assert!(near < 0.5 * far, "{near} with the curve kept, {far} with the points kept");
    assert_eq!(lab(&window).history.undo_name(), Some("Move knot, curve kept"), "the step");
    undo(&mut window);
    assert_eq!(curve(&window), open_curve(), "undone exactly");

    // An end cannot move: the interval would be another.
    let end = place(&window, "Knot 4, 3 copies");
    hold(&mut window, end, Vec2::ZERO);
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    window.hover_at(end + vec2(30.0, 0.0));
    window.run_steps(2);
    assert!(says(&window, "Keeping the curve keeps its interval [0, 4]"), "the reason");
    window.drop_at(end + vec2(30.0, 0.0));
    window.run_steps(3);
    assert_eq!(curve(&window), open_curve(), "nothing happened");
}

#[test]
fn every_rule_makes_knots_by_command_and_by_mouse_for_open_and_closed_curves() {
    for start in [open_curve(), closed_curve()] {
        let mut window = window(start.clone());
        for (rule, name) in [
            (Command::UniformKnots, "Uniform knots"),
            (Command::EndInterpolatingKnots, "End-interpolating knots"),
            (Command::ChordLengthKnots, "Chord length knots"),
            (Command::CentripetalKnots, "Centripetal knots"),
            (Command::AveragedKnots, "Averaged knots"),
        ] {
            command(&mut window, rule);
            let by_command = curve(&window);
            assert_eq!(by_command.points(), start.points(), "{name}: the points are kept");
            if lab(&window).history.steps().0 > 0 {
                assert_eq!(lab(&window).history.undo_name(), Some(name), "the step");
                undo(&mut window);
            }
            assert_eq!(curve(&window), start, "{name}: undone exactly");
            click(&mut window, "Edit knots");
            click(&mut window, name);
            assert_eq!(curve(&window), by_command, "{name}: the same by mouse");
            if lab(&window).history.steps().0 > 0 {
                undo(&mut window);
            }
        }
        lab_mut(&mut window).knots.keep_curve = true;
        command(&mut window, Command::ChordLengthKnots);
        assert!(distance(&start, &curve(&window)) < 1.5, "with the curve kept it stays near");
    }
}

#[test]
fn superfluous_knots_go_within_a_typed_tolerance_and_the_number_is_said() {
    let mut window = window(open_curve());
    command(&mut window, Command::RefineUniformly);
    assert_eq!(curve(&window).points().len(), 11, "four knots more");
    click(&mut window, "Edit knots");
    type_into(&mut window, "Tolerance of removal", "0,000001");
    click(&mut window, "Remove knots within the tolerance");
    assert_eq!(curve(&window).points().len(), 7, "they go again");
    assert!(distance(&open_curve(), &curve(&window)) < 1e-6, "within the tolerance");
    let said = |window: &Window| lab(window).shape_note.clone().unwrap_or_default();
    assert!(said(&window).starts_with("4 knots removed, certified deviation at most"), "{}", said(&window));
    key(&mut window, Modifiers::SHIFT, Key::Delete);
    assert_eq!(curve(&window).points().len(), 7, "nothing more by key");
    assert_eq!(said(&window), "No knot can go within 1e\u{2212}6", "said");
    lab_mut(&mut window).knots.tolerance = 10.0;
    key(&mut window, Modifiers::SHIFT, Key::Delete);
    assert_eq!(curve(&window).points().len(), 4, "one piece is left within 10");
}

#[test]
fn knots_are_pasted_and_copied_in_both_conventions() {
    let mut window = window(open_curve());
    let paste = |window: &mut Window, text: &str| {
        window.get_by_label("Knot list").focus();
        window.run_steps(2);
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.run_steps(2);
        window.event(Event::Paste(text.to_owned()));
        window.run_steps(2);
        key(window, Modifiers::NONE, Key::Enter);
    };
    paste(&mut window, "0 0 0 0 1.5 2 3 4 4 4 4");
    assert_eq!(knots(&window), [-1.5, 0.0, 0.0, 0.0, 1.5, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0], "fourfold ends");
    paste(&mut window, "-1 0 0 0 1 2 3 4 4 4 5");
    assert_eq!(curve(&window), open_curve(), "threefold ends");
    for (label, text) in [
        ("3-fold ends", "-1  0  0  0  1  2  3  4  4  4  5"),
        ("4-fold ends", "0  0  0  0  1  2  3  4  4  4  4"),
    ] {
        window.get_by_label(label).click();
        window.step();
        let mut copied = Vec::new();
        for _ in 0..3 {
            copied.extend(window.output().platform_output.commands.iter().filter_map(
                |command| match command {
                    OutputCommand::CopyText(text) => Some(text.clone()),
                    _ => None,
                },
            ));
            window.step();
        }
        assert_eq!(copied.first().map(String::as_str), Some(text), "{label}");
    }
    lab_mut(&mut window).knots.keep_curve = true;
    window.run_steps(2);
    paste(&mut window, "0 0 0 0 0.5 1 2 3 4 4 4 4");
    assert_eq!(curve(&window).points().len(), 8, "with the curve kept any number of knots will do");
    assert!(distance(&open_curve(), &curve(&window)) < 1e-12, "the new knots hold the curve");
}

#[test]
fn the_dial_has_the_same_hands_as_the_line() {
    let start = closed_curve();
    let mut window = window(start.clone());
    let center = place(&window, "Dial of knots");
    let two = place(&window, "Knot 2 on the dial");
    let three = place(&window, "Knot 3 on the dial");
    // Clockwise: the knots stand in the sequence of the parameter.
    let turn = (two - center).rot90().dot(three - center);
    assert!(turn < 0.0, "3 follows 2 clockwise");
    drag(&mut window, two, (three - two) * 0.4);
    let moved = knots(&window);
    assert!(moved[2] > 2.2 && moved[2] < 2.7 && moved[3] == 3.0, "{moved:?}");
    undo(&mut window);
    drag(&mut window, two, (three - two) * 0.97);
    assert_eq!(knots(&window)[2..4], [3.0, 3.0], "stacked");
    let double = place(&window, "Knot 3, 2 copies on the dial");
    drag(&mut window, double, two - double);
    assert!(knots(&window)[2] < 2.5 && knots(&window)[3] == 3.0, "pulled apart: {:?}", knots(&window));
    undo(&mut window);
    undo(&mut window);
    assert_eq!(curve(&window), start, "undone exactly");

    // A new knot, the parameter, a removal.
    let at = two.lerp(three, 0.5);
    double_click(&mut window, at);
    assert_eq!(knots(&window).len(), 8, "a double click inserts");
    assert!(distance(&start, &curve(&window)) < 1e-10, "the shape is kept");
    let inserted = lab(&window).selection.knot.unwrap();
    assert!((inserted - 2.5).abs() < 0.2, "between 2 and 3: {inserted}");
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(knots(&window).len(), 7, "Delete removes it");
    let cursor = place(&window, "Cursor of t on the dial");
    drag(&mut window, cursor, (two - center) * 0.5 - (cursor - center));
    let t = lab(&window).parameter(lab(&window).selection.object.unwrap()).unwrap();
    assert!((t - 2.0).abs() < 0.15, "t follows the hand: {t}");

    // The seam goes with its knot, past 0 too.
    let seam = place(&window, "Knot 0 on the dial");
    drag(&mut window, seam, vec2(-12.0, 1.0));
    let first = knots(&window)[0];
    assert!(first < -0.05 && first > -0.9, "the period starts at {first}");
}

#[test]
fn a_knot_stacks_on_the_seam_from_both_sides() {
    let mut window = window(closed_curve());
    let (six, seam) = (place(&window, "Knot 6 on the dial"), place(&window, "Knot 0 on the dial"));
    drag(&mut window, six, seam - six);
    assert_eq!(knots(&window)[..2], [0.0, 0.0], "the last knot onto the first: {:?}", knots(&window));
    assert_eq!(lab(&window).selection.knot, Some(0.0), "it is selected there");
    undo(&mut window);
    let (six, seam) = (place(&window, "Knot 6"), place(&window, "Knot 0"));
    let unit = six.x - place(&window, "Knot 5").x;
    drag(&mut window, seam, vec2(3.0 - unit, 0.0));
    assert_eq!(knots(&window)[..2], [-1.0, -1.0], "the first onto the last: {:?}", knots(&window));
    undo(&mut window);
    assert_eq!(curve(&window), closed_curve(), "undone exactly");
}

#[test]
fn a_hovered_knot_lights_up_on_line_and_dial() {
    let mut window = window(closed_curve());
    let object = lab(&window).selection.object.unwrap();
    for label in ["Knot 3 on the dial", "Knot 3"] {
        let at = place(&window, label);
        window.hover_at(at);
        window.run_steps(2);
        assert_eq!(lab(&window).hovered, Hovered::Knot(object, 3.0), "{label}");
    }
    // The function of point 1 has its top at 3, where the circle is nearest to the middle.
    let center = place(&window, "Dial of knots");
    let top = curve(&window)
        .space()
        .span(3.0)
        .map(|span| curve(&window).space().coefficient_index(span - 2))
        .unwrap();
    let inwards = place(&window, "Knot 3 on the dial") - center;
    let value = 0.66;
    window.hover_at(center + inwards * (1.0 - 0.42 * value));
    window.run_steps(2);
    assert_eq!(lab(&window).hovered, Hovered::Point(object, top), "its function on the dial");
}

#[test]
fn the_builder_takes_a_b_spline_apart_by_mouse_and_keys() {
    let mut window = window(open_curve());
    key(&mut window, Modifiers::SHIFT, Key::B);
    let builder = lab(&window).knots.builder.clone().unwrap();
    assert_eq!((builder.degree, builder.slide), (3, 1.0), "the whole B-spline, put together");
    let active = lab(&window).curve().unwrap().space().span(2.0).unwrap();
    assert!((active - 3..=active).contains(&builder.spline), "one that is active at t");
    click(&mut window, "Next B-spline");
    assert_eq!(lab(&window).knots.builder.clone().unwrap().spline, builder.spline + 1, "the next one");
    click(&mut window, "Degree 2 of the builder");
    assert_eq!(lab(&window).knots.builder.clone().unwrap().degree, 2, "a step down by mouse");
    key(&mut window, Modifiers::NONE, Key::ArrowRight);
    assert_eq!(lab(&window).knots.builder.clone().unwrap().part, 1, "the other quadratic by key");
    for degree in [1, 0] {
        key(&mut window, Modifiers::NONE, Key::ArrowDown);
        assert_eq!(lab(&window).knots.builder.clone().unwrap().degree, degree, "a step down by key");
    }
    assert!(window.query_by_label("Slide together").is_none(), "degree 0 has no parts");
    for _ in 0..3 {
        key(&mut window, Modifiers::NONE, Key::ArrowUp);
    }
    let slider = window.get_by_label("Slide together").rect();
    drag(&mut window, slider.right_center() - vec2(6.0, 0.0), vec2(-40.0, 0.0));
    let slide = lab(&window).knots.builder.clone().unwrap().slide;
    assert!(slide > 0.1 && slide < 0.9, "half way apart: {slide}");
    assert_eq!(lab(&window).history.steps().0, 0, "looking changes nothing");
    click(&mut window, "Builder");
    assert!(lab(&window).knots.builder.is_none(), "closed");
}

#[test]
fn a_document_remembers_that_the_builder_was_open() {
    let mut window = window(open_curve());
    command(&mut window, Command::ToggleBuilder);
    let text = to_json(lab(&window).history.document(), &lab(&window).view);
    let saved = from_json(&text).unwrap();
    *lab_mut(&mut window) = Lab::new(saved.document, saved.view);
    window.run_steps(3);
    assert!(lab(&window).knots.builder.is_some(), "opened with the document");
}

#[test]
fn a_rule_is_found_by_name_and_the_dial_keeps_a_rational_curve() {
    let mut window = window(closed_curve());
    key(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("chord length".to_owned()));
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(lab(&window).history.undo_name(), Some("Chord length knots"), "by keys alone");
    undo(&mut window);
    lab_mut(&mut window).knots.keep_curve = true;
    let (two, three) = (place(&window, "Knot 2 on the dial"), place(&window, "Knot 3 on the dial"));
    hold(&mut window, two, (three - two) * 0.3);
    assert!(says(&window, "curve kept within"), "the certified deviation beside the pointer");
    window.drop_at(two + (three - two) * 0.3);
    window.run_steps(3);
    assert!(knots(&window)[2] > 2.1, "{:?}", knots(&window));
    assert!(distance(&closed_curve(), &curve(&window)) < 0.2, "the curve stays near");
    undo(&mut window);
    assert_eq!(curve(&window), closed_curve(), "undone exactly");
}

#[test]
fn a_selected_point_chooses_the_b_spline_of_the_builder() {
    let mut window = window(open_curve());
    command(&mut window, Command::ToggleBuilder);
    lab_mut(&mut window).selection.points = [4].into();
    window.run_steps(2);
    assert_eq!(lab(&window).knots.builder.clone().unwrap().spline, 4, "that of point 4");
}
