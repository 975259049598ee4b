//! The rooms beside the canvas without a screen: by mouse and keyboard, looking at the document.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Event, Key, Modifiers, OutputCommand, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::Lab;
use spline_lab::core::bspline::{Side, SplineSpace};
use spline_lab::core::rational_bezier::{Conic, ConicKind, ExtendedConic};
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{Camera, CurveDisplay, Document, Edit, View};

type Window = Harness<'static, Option<LabApp>>;

/// The room with one curve.
fn window(curve: Nurbs<DVec2>) -> Window {
    let mut window =
        Harness::builder().with_size(vec2(1280.0, 900.0)).with_step_dt(1.0 / 60.0).build_ui_state(
            |ui, app: &mut Option<LabApp>| {
                let ctx = ui.ctx().clone();
                app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
            },
            None,
        );
    window.run_steps(2);
    let mut document = Document::new();
    let add = Edit::AddCurve { name: "T".to_owned(), curve, display: CurveDisplay::default() };
    let object = document.apply(&add).unwrap().created[0];
    let lab = window.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    lab.selection.object = Some(object);
    window.run_steps(3);
    let lab = window.state_mut().as_mut().unwrap().lab_mut();
    lab.view.camera = Camera { center: DVec2::new(2.0, 1.5), scale: 60.0 };
    window.run_steps(2);
    window
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn curve(window: &Window) -> Nurbs<DVec2> {
    lab(window).curve().expect("a curve is selected").clone()
}

fn steps(window: &Window) -> usize {
    lab(window).history.steps().0
}

fn arc() -> Nurbs<DVec2> {
    let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
    let points = [[0.0, 0.0], [2.0, 3.0], [4.0, 0.0]];
    Nurbs::polynomial(space, points.map(DVec2::from).to_vec()).unwrap()
}

fn kind(window: &Window) -> ConicKind {
    let pieces = curve(window).rational_bezier_curves().unwrap();
    ExtendedConic::try_from(&pieces[0]).unwrap().implicit().unwrap().kind()
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn type_into(window: &mut Window, label: &str, text: &str) {
    click(window, label);
    window.get_by_label(label).type_text(text);
    window.run_steps(2);
    press(window, Modifiers::NONE, Key::Enter);
}

fn drag(window: &mut Window, label: &str, by: Vec2) {
    let from: Pos2 = window.get_by_label(label).rect().center();
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.hover_at(from);
    window.step();
    window.event(button(from, true));
    window.step();
    for part in 1..=5 {
        window.hover_at(from + by * (part as f32 / 5.0));
        window.step();
    }
    window.event(button(from + by, false));
    window.run_steps(3);
}

#[test]
fn the_weight_of_the_conic_is_typed_and_slid_each_as_one_step() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::C);
    assert!(window.query_by_label("To a parabola").is_some(), "the room is open");
    assert_eq!(kind(&window), ConicKind::Parabola, "w = 1");
    type_into(&mut window, "Middle weight in standard form", "0.5");
    assert_eq!(curve(&window).weights()[1], 0.5, "the typed weight");
    assert_eq!((kind(&window), steps(&window)), (ConicKind::Ellipse, 1), "an ellipse in one step");
    type_into(&mut window, "Middle weight in standard form", "-2");
    assert_eq!(curve(&window).weights()[1], 2.0, "its size");
    assert_eq!(kind(&window), ConicKind::Hyperbola, "a hyperbola");
    assert!(lab(&window).rooms.complement, "a negative weight shows the complementary arc");
    let before = steps(&window);
    drag(&mut window, "Slider of the middle weight", vec2(-80.0, 0.0));
    assert_ne!(curve(&window).weights()[1], 2.0, "slid");
    assert_eq!(steps(&window), before + 1, "a whole drag is one step");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window).weights()[1], 2.0, "undone at once");
}

#[test]
fn an_arc_over_equal_sides_is_made_a_circle() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::C);
    click(&mut window, "To a circle");
    let curvatures: Vec<f64> = [0.0, 0.3, 0.9]
        .map(|t| curve(&window).derivatives(t, 2, Side::Right).unwrap())
        .map(|d| d[1].perp_dot(d[2]) / d[1].length().powi(3))
        .to_vec();
    for curvature in &curvatures {
        assert!((curvature - curvatures[0]).abs() < 1e-12, "one curvature: {curvatures:?}");
    }
    assert!(window.query_by_label("To a circle").is_some(), "still there");
}

#[test]
fn a_triangle_with_unequal_sides_is_made_isosceles_first() {
    let lopsided = arc().with_point(1, DVec2::new(1.0, 3.0)).unwrap();
    let mut window = window(lopsided);
    press(&mut window, Modifiers::ALT, Key::C);
    click(&mut window, "Equal sides");
    assert_eq!(curve(&window).points()[1], DVec2::new(2.0, 3.0), "above the middle of the chord");
}

#[test]
fn a_piece_between_simple_knots_is_separated() {
    let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 4.0]).unwrap();
    let points = [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0], [5.0, 1.0]];
    let before = Nurbs::polynomial(space, points.map(DVec2::from).to_vec()).unwrap();
    let mut window = window(before.clone());
    press(&mut window, Modifiers::ALT, Key::C);
    click(&mut window, "Separate the piece");
    let after = curve(&window);
    assert_eq!(after.points().len(), 7, "two knots more");
    assert_eq!(steps(&window), 1, "one step");
    for t in [0.4, 1.5, 2.9] {
        let gap = before.evaluate(t).unwrap().distance(after.evaluate(t).unwrap());
        assert!(gap < 1e-14, "the shape stays: {gap}");
    }
    type_into(&mut window, "Middle weight in standard form", "3");
    assert_eq!(curve(&window).weights()[3], 3.0, "the middle weight of the piece at t");
}

#[test]
fn the_equation_is_copied_and_a_cubic_has_none() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::C);
    click(&mut window, "To a circle");
    window.get_by_label("Copy all six").click();
    let mut copied = None;
    for _ in 0..4 {
        window.step();
        copied = window
            .output()
            .platform_output
            .commands
            .iter()
            .find_map(|command| match command {
                OutputCommand::CopyText(text) => Some(text.clone()),
                _ => None,
            })
            .or(copied);
    }
    let numbers: Vec<f64> = copied.unwrap().split(", ").map(|number| number.parse().unwrap()).collect();
    let conic = Conic::new(numbers.try_into().unwrap()).unwrap();
    for t in [0.0, 0.4, 1.0] {
        let residual = conic.value(curve(&window).evaluate(t).unwrap()).abs();
        assert!(residual < 1e-12, "the curve satisfies the equation copied: {residual}");
    }
    press(&mut window, Modifiers::NONE, Key::E);
    assert_eq!(curve(&window).degree(), 3, "elevated");
    assert!(window.query_by_label_contains("this one has degree 3").is_some(), "the reason");
}

#[test]
fn a_point_is_dragged_along_its_ray_in_space() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::H);
    let before = curve(&window);
    drag(&mut window, "Homogeneous point 1", vec2(0.0, -40.0));
    let after = curve(&window);
    assert!(after.weights()[1] > 1.05, "farther from the origin: {}", after.weights()[1]);
    assert_eq!(after.points(), before.points(), "the plane curve keeps its control points");
    assert_eq!((after.weights()[0], after.weights()[2]), (1.0, 1.0), "the others stay");
    assert_eq!(steps(&window), 1, "one step");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), before, "undone at once");
}

#[test]
fn weights_are_typed_and_slid_in_space_and_the_eye_turns() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::H);
    type_into(&mut window, "Weight 2 in space", "2.5");
    assert_eq!(curve(&window).weights()[2], 2.5, "typed");
    drag(&mut window, "Slider of weight 0", vec2(30.0, 0.0));
    assert!(curve(&window).weights()[0] > 1.0, "slid");
    assert_eq!(steps(&window), 2, "two steps");
    let eye = |window: &Window| lab(window).rooms.space.unwrap().eye;
    let before = eye(&window);
    let corner = window.get_by_label("Homogeneous space").rect().left_top() + vec2(8.0, 8.0);
    window.hover_at(corner);
    window.step();
    window.drag_at(corner);
    window.step();
    window.hover_at(corner + vec2(50.0, 30.0));
    window.step();
    window.drop_at(corner + vec2(50.0, 30.0));
    window.run_steps(2);
    assert_ne!(eye(&window), before, "the eye has turned");
    assert_eq!(steps(&window), 2, "looking is no step");
}

#[test]
fn the_three_cubics_of_the_example_are_listed_and_the_chosen_one_is_added() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::E);
    assert!(window.query_by_label("Three cubics have these ends").is_some(), "three");
    click(&mut window, "Cubic 2");
    let ends = lab(&window).rooms.hermite.unwrap().ends;
    click(&mut window, "Add to the document");
    let added = curve(&window);
    assert_eq!(added.degree(), 3, "a cubic");
    assert_eq!(lab(&window).history.document().objects().len(), 2, "beside the arc");
    assert_eq!(steps(&window), 1, "one step");
    for (t, side, angle) in [(0.0, Side::Right, 0.0_f64), (1.0, Side::Left, 90.0)] {
        let frame = added.frame(t, side).unwrap();
        assert!(frame.tangent.distance(DVec2::from_angle(angle.to_radians())) < 1e-9, "direction at {t}");
        assert!((frame.curvature - ends[0].curvature).abs() < 1e-9, "curvature {} at {t}", frame.curvature);
    }
}

#[test]
fn ends_are_typed_and_dragged_on_the_canvas() {
    let mut window = window(arc());
    press(&mut window, Modifiers::ALT, Key::E);
    type_into(&mut window, "Curvature of the start", "0");
    type_into(&mut window, "Direction of the start", "180");
    type_into(&mut window, "Direction of the end", "0");
    assert!(window.query_by_label("No cubic has these ends").is_some(), "none");
    click(&mut window, "Example");
    let example = lab(&window).rooms.hermite.unwrap().ends;
    drag(&mut window, "Point handle of the end", vec2(60.0, 0.0));
    let ends = lab(&window).rooms.hermite.unwrap().ends;
    assert!(
        ends[1].point.distance(example[1].point + DVec2::X) < 1e-6,
        "a unit to the right: {}",
        ends[1].point
    );
    drag(&mut window, "Direction handle of the start", vec2(0.0, -78.0));
    assert!(
        (lab(&window).rooms.hermite.unwrap().ends[0].angle - 45.0).abs() < 1.0,
        "turned up by 45 degrees"
    );
    let before = lab(&window).rooms.hermite.unwrap().ends[1].curvature;
    drag(&mut window, "Curvature handle of the end", vec2(-30.0, 0.0));
    assert!(lab(&window).rooms.hermite.unwrap().ends[1].curvature > before + 0.1, "bent more to the left");
    assert_eq!(steps(&window), 0, "the document is as it was");
}

#[test]
fn the_ends_of_a_curve_give_the_curve_back() {
    let cubic = arc().elevate_degree().unwrap();
    let mut window = window(cubic.clone());
    press(&mut window, Modifiers::ALT, Key::E);
    click(&mut window, "Ends of the curve");
    click(&mut window, "Cubic 1");
    click(&mut window, "Add to the document");
    let back = curve(&window);
    for (a, b) in cubic.points().iter().zip(back.points()) {
        assert!(a.distance(*b) < 1e-9, "{a} is not {b}");
    }
}
