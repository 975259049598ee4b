//! The stepper without a screen: every algorithm chosen by mouse and stepped through by keys.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::{Hovered, Lab};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, StepperKind, View, from_json, to_json};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

fn window(curve: Nurbs<DVec2>) -> Window {
    let mut harness = Harness::builder().with_size(vec2(1280.0, 900.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    harness.step();
    let mut document = Document::new();
    let edit = Edit::AddCurve { name: "T".to_owned(), curve, display: CurveDisplay::default() };
    document.apply(&edit).unwrap();
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    harness.run_steps(6);
    click(&mut harness, "Stepper");
    key(&mut harness, Key::F);
    harness
}

fn points() -> Vec<DVec2> {
    [(0.0, 0.0), (1.0, 3.0), (3.0, 4.0), (4.0, 0.0), (5.0, -1.0), (7.0, 2.0), (8.0, 1.0)]
        .map(DVec2::from)
        .to_vec()
}

fn uniform(weights: Vec<f64>) -> Nurbs<DVec2> {
    let space = SplineSpace::new(3, (0..11).map(f64::from).collect()).unwrap();
    Nurbs::new(space, points(), weights).unwrap()
}

fn plain() -> Nurbs<DVec2> {
    uniform(vec![1.0; 7])
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

fn place(window: &Window, label: &str) -> Pos2 {
    window.get_by_label(label).rect().center()
}

/// Chooses an algorithm from the list, by mouse.
fn choose(window: &mut Window, kind: StepperKind) {
    click(window, "Algorithm");
    let label = format!("{}   {}", kind.section(), kind.name());
    // The box itself shows the name that is chosen, the list stands behind it.
    window.get_all_by_label(&label).last().unwrap().click();
    window.run_steps(4);
}

fn key(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
}

fn frames(window: &Window) -> usize {
    lab(window).scheme().unwrap().frames().len()
}

#[test]
fn every_algorithm_is_chosen_by_mouse_and_stepped_through_with_keys() {
    let mut window = window(plain());
    let before = lab(&window).history.document().clone();
    for kind in StepperKind::ALL.into_iter().filter(|&kind| kind != StepperKind::RationalDeCasteljau) {
        choose(&mut window, kind);
        assert_eq!(lab(&window).view.stepper, kind, "{kind:?} is chosen");
        assert_eq!(lab(&window).stepper.frame, 0, "{kind:?} starts at its first frame");
        let count = frames(&window);
        for frame in 1..count {
            key(&mut window, Key::CloseBracket);
            assert_eq!(lab(&window).stepper.frame, frame, "{kind:?}: a step on");
        }
        key(&mut window, Key::CloseBracket);
        assert_eq!(lab(&window).stepper.frame, count - 1, "{kind:?} ends at its last frame");
        key(&mut window, Key::OpenBracket);
        assert_eq!(lab(&window).stepper.frame, count.saturating_sub(2), "{kind:?}: a step back");
    }
    assert_eq!(lab(&window).history.document(), &before, "looking changes nothing");
    assert_eq!(lab(&window).history.steps(), (0, 0), "and is no step of undo");
}

#[test]
fn weights_have_their_own_algorithm_and_the_other_says_so() {
    let mut window = window(uniform(vec![1.0, 2.0, 1.0, 0.5, 1.0, 1.0, 1.0]));
    choose(&mut window, StepperKind::DeCasteljau);
    assert!(lab(&window).scheme().is_none(), "not for weights");
    assert!(
        window.query_by_label_contains("choose the rational algorithm").is_some(),
        "and the panel says why"
    );
    click(&mut window, "Choose Rational de Casteljau");
    assert_eq!(lab(&window).view.stepper, StepperKind::RationalDeCasteljau, "one click away");
    let last = frames(&window) - 1;
    for _ in 0..last {
        key(&mut window, Key::CloseBracket);
    }
    let apex = lab(&window).scheme().unwrap().apex().at.unwrap();
    let curve = lab(&window).curve().unwrap();
    let point =
        curve.evaluate(lab(&window).parameter(lab(&window).selection.object.unwrap()).unwrap()).unwrap();
    assert!(apex.distance(point) < 1e-12, "{apex} is the point {point}");
}

#[test]
fn knots_are_made_uniform_where_uniform_subdivision_asks_for_it() {
    let space = SplineSpace::new(3, vec![0.0, 0.0, 0.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 7.0, 7.0]).unwrap();
    let mut window = window(Nurbs::polynomial(space, points()).unwrap());
    choose(&mut window, StepperKind::UniformSubdivision);
    assert!(lab(&window).scheme().is_none(), "not for these knots");
    click(&mut window, "Make the knots uniform");
    assert!(lab(&window).scheme().is_some(), "now it is told");
    let gaps: Vec<f64> =
        lab(&window).curve().unwrap().space().knots().windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(gaps.iter().all(|gap| (gap - gaps[0]).abs() < 1e-12), "{gaps:?}");
    assert_eq!(lab(&window).curve().unwrap().points(), points(), "the control points stay");
}

#[test]
fn an_entry_under_the_pointer_lights_up_with_the_control_points_it_depends_on() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::Blossom);
    let entry = lab(&window).scheme().unwrap().levels()[1][1].clone();
    let at = place(&window, &format!("{} = ({})", entry.plain_label, entry.lines.join(", ")));
    window.hover_at(at);
    window.run_steps(3);
    let object = lab(&window).selection.object.unwrap();
    assert_eq!(lab(&window).hovered, Hovered::Entry(object, 1, 1), "the entry");
    assert_eq!(lab(&window).entry_partners, entry.partners, "its control points");
    assert_eq!(entry.partners.len(), 2, "a point of level 1 depends on two control points");
}

#[test]
fn a_control_point_of_the_table_is_selected_by_a_click_and_an_entry_goes_to_its_frame() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::Differentiation);
    let stepper = lab(&window).scheme().unwrap();
    let [point, vector] = [&stepper.levels()[0][1], &stepper.levels()[1][2]];
    let label =
        |entry: &spline_lab::course::Entry| format!("{} = ({})", entry.plain_label, entry.lines.join(", "));
    let (first, second) = (label(point), label(vector));
    let index = point.control_point.unwrap();
    click(&mut window, &first);
    assert_eq!(lab(&window).selection.points.iter().copied().collect::<Vec<_>>(), [index], "selected");
    click(&mut window, &second);
    assert_eq!(lab(&window).stepper.frame, 3, "the third difference comes with frame 3");
}

#[test]
fn the_line_of_the_intersection_is_typed_and_saved_with_the_view() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::Intersection);
    let before = lab(&window).scheme().unwrap();
    window.get_by_label("Line y").click();
    window.run_steps(3);
    window.get_by_label("Line y").type_text("2.5");
    window.run_steps(2);
    key(&mut window, Key::Enter);
    let line = lab(&window).view.stepper_choices.line.unwrap();
    assert_eq!((line.through.y, line.angle), (2.5, 0.0), "typed");
    assert_ne!(lab(&window).scheme().unwrap(), before, "another line, another story");
    let text = to_json(lab(&window).history.document(), &lab(&window).view);
    assert!(text.contains("\"intersection\""), "kebab-case in the file");
    let view = from_json(&text).unwrap().view;
    assert_eq!(
        (view.stepper, view.stepper_choices.line),
        (StepperKind::Intersection, Some(line)),
        "read again"
    );
    click(&mut window, "Reset");
    assert_eq!(lab(&window).view.stepper_choices.line, None, "the usual line");
}

#[test]
fn the_arguments_of_the_blossom_are_typed() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::Blossom);
    window.get_by_label("Arguments").click();
    window.run_steps(3);
    window.get_by_label("Arguments").type_text("4 5 6");
    window.run_steps(2);
    key(&mut window, Key::Enter);
    assert_eq!(lab(&window).view.stepper_choices.arguments, [4.0, 5.0, 6.0], "three for degree 3");
    // P[4, 5, 6] is the control point between the knots 3 and 7, of the pieces over 3 to 7.
    let apex = lab(&window).scheme().unwrap().apex().at.unwrap();
    assert!(apex.distance(points()[3]) < 1e-12, "c_3, not {apex}");
}

#[test]
fn playing_starts_and_stops_with_enter() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::KnotInsertion);
    key(&mut window, Key::Enter);
    assert!(lab(&window).stepper.playing, "plays");
    for _ in 0..2000 {
        if lab(&window).stepper.frame == frames(&window) - 1 {
            break;
        }
        window.step();
    }
    window.run_steps(3);
    assert_eq!(lab(&window).stepper.frame, frames(&window) - 1, "to the last frame");
    assert!(!lab(&window).stepper.playing, "and stops there");
    window.key_press_modifiers(Modifiers::NONE, Key::Enter);
    window.run_steps(2);
    assert!(lab(&window).stepper.playing && lab(&window).stepper.frame == 0, "and begins again");
}

fn drag(window: &mut Window, label: &str, by: eframe::egui::Vec2) {
    let from = place(window, label);
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for part in 1..=4 {
        window.hover_at(from + by * (part as f32 / 4.0));
        window.step();
    }
    window.drop_at(from + by);
    window.run_steps(3);
}

#[test]
fn the_line_is_moved_and_turned_on_the_canvas_and_the_curve_stays() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::Intersection);
    let before = lab(&window).curve().unwrap().clone();
    let scale = lab(&window).view.camera.scale;
    let line = spline_lab::course::stepper::default_line(&before);
    drag(&mut window, "Point of the line", vec2(0.0, -60.0));
    let moved = lab(&window).view.stepper_choices.line.unwrap();
    let expected = line.through + DVec2::Y * (60.0 / scale);
    assert!(moved.through.distance(expected) < 1.5 / scale, "{} instead of {expected}", moved.through);
    assert_eq!(moved.angle, 0.0, "the direction stays");
    drag(&mut window, "Direction of the line", vec2(-110.0, -110.0));
    let turned = lab(&window).view.stepper_choices.line.unwrap();
    assert!((turned.angle - 90.0).abs() < 1.0, "upright: {}°", turned.angle);
    assert_eq!(turned.through, moved.through, "the point stays");
    assert_eq!(lab(&window).curve().unwrap(), &before, "no point of the curve has moved");
    assert_eq!(lab(&window).history.steps(), (0, 0), "no step of undo");
}

#[test]
fn a_point_of_the_construction_under_the_pointer_lights_up_its_entry() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::KnotInsertion);
    key(&mut window, Key::CloseBracket);
    let entry = lab(&window).scheme().unwrap().levels()[1][0].clone();
    let first = (DVec2::new(0.0, 0.0), place(&window, "Control point 0 of T"));
    let scale = lab(&window).view.camera.scale;
    let shift = (entry.at.unwrap() - first.0) * scale;
    window.hover_at(first.1 + vec2(shift.x as f32, -shift.y as f32));
    window.run_steps(3);
    let object = lab(&window).selection.object.unwrap();
    assert_eq!(lab(&window).hovered, Hovered::Entry(object, 1, 0), "the new point");
    assert_eq!(lab(&window).entry_partners, entry.partners, "and its two control points");
}

#[test]
fn frames_are_exported_from_the_file_menu() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::KnotInsertion);
    click(&mut window, "File");
    let listed = window.query_all_by_label_contains("Export frames…").count();
    assert_eq!(listed, 2, "in the menu, and under the table");
    key(&mut window, Key::Escape);
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::E);
    window.run_steps(4);
    assert!(window.query_by_label_contains("Export all frames").is_some(), "its shortcut asks for a file");
}

#[test]
fn algorithms_are_turned_with_keys_around_the_list() {
    let mut window = window(plain());
    window.key_press_modifiers(Modifiers::COMMAND, Key::CloseBracket);
    window.run_steps(3);
    assert_eq!(lab(&window).view.stepper, StepperKind::KnotInsertion, "after de Boor");
    for _ in 0..6 {
        window.key_press_modifiers(Modifiers::COMMAND, Key::OpenBracket);
        window.run_steps(3);
    }
    assert_eq!(lab(&window).view.stepper, StepperKind::DeCasteljau, "the first");
    window.key_press_modifiers(Modifiers::COMMAND, Key::OpenBracket);
    window.run_steps(3);
    assert_eq!(lab(&window).view.stepper, StepperKind::Blossom, "and around to the last");
}

#[test]
fn the_knot_that_is_looked_at_is_inserted_and_undone() {
    let mut window = window(plain());
    choose(&mut window, StepperKind::KnotInsertion);
    let before = lab(&window).curve().unwrap().clone();
    let told = lab(&window).scheme().unwrap();
    click(&mut window, "Insert the knot");
    let after = lab(&window).curve().unwrap();
    assert_eq!(after, &before.insert_knot(told.parameter()).unwrap(), "the curve that the last frame shows");
    for entry in &told.levels()[1] {
        assert!(after.points().contains(&entry.at.unwrap()), "{} is a control point now", entry.plain_label);
    }
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(3);
    assert_eq!(lab(&window).curve().unwrap(), &before, "undone");
}
