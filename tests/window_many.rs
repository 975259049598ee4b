//! A curve with ten thousand control points in the Curves room: dragged at one point, refined, seen from afar and near by.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Shape, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::command::Command;
use spline_lab::app::lab::Lab;
use spline_lab::core::bspline::{EndKnots, SplineSpace};
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, PointLabels, View};

const COUNT: usize = 10_000;
/// The point that is dragged.
const POINT: usize = 4321;

type Window = Harness<'static, Option<LabApp>>;

/// A cubic spiral.
fn spiral(count: usize) -> Nurbs<DVec2> {
    let breaks: Vec<f64> = (0..count - 2).map(|k| k as f64).collect();
    let space = SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating).unwrap();
    let place = |k: usize| {
        let s = 60.0 * k as f64 / count as f64;
        DVec2::from_angle(s) * (3.0 + 0.5 * s)
    };
    Nurbs::polynomial(space, (0..count).map(place).collect()).unwrap()
}

fn window(curve: Nurbs<DVec2>, display: CurveDisplay) -> Window {
    let mut harness =
        Harness::builder().with_size(vec2(1500.0, 900.0)).with_step_dt(1.0 / 60.0).build_ui_state(
            |ui, app: &mut Option<LabApp>| {
                let ctx = ui.ctx().clone();
                app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
            },
            None,
        );
    harness.step();
    let mut document = Document::new();
    document.apply(&Edit::AddCurve { name: "Long".to_owned(), curve, display }).unwrap();
    *lab_mut(&mut harness) = Lab { at_once: true, ..Lab::new(document, View::default()) };
    harness.run_steps(2);
    lab_mut(&mut harness).commands.push(Command::Fit);
    harness.run_steps(2);
    harness
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn lab_mut(window: &mut Window) -> &mut Lab {
    window.state_mut().as_mut().unwrap().lab_mut()
}

fn curve(window: &Window) -> &Nurbs<DVec2> {
    lab(window).curve().unwrap()
}

/// Looks at `place` so that `pixels` are a unit.
fn look_at(window: &mut Window, place: DVec2, pixels: f64) {
    let camera = &mut lab_mut(window).view.camera;
    (camera.center, camera.scale) = (place, pixels);
    window.run_steps(2);
}

fn on_screen(window: &Window, world: DVec2) -> Pos2 {
    let canvas = window.get_by_label("Canvas").rect();
    let camera = &lab(window).view.camera;
    let way = (world - camera.center) * camera.scale;
    canvas.center() + vec2(way.x as f32, -way.y as f32)
}

/// Presses at `from` and drags by `way` without letting go.
fn hold(window: &mut Window, from: Pos2, way: Vec2) {
    window.hover_at(from);
    window.run_steps(2);
    window.drag_at(from);
    window.step();
    for part in 1..=3 {
        window.hover_at(from + way * (part as f32 / 3.0));
        window.step();
    }
    window.step();
}

/// The rings of selected points.
fn rings(window: &Window) -> Vec<Pos2> {
    let ring = |shape: &Shape| match shape {
        Shape::Circle(circle) if circle.radius == 7.5 => Some(circle.center),
        _ => None,
    };
    window.output().shapes.iter().filter_map(|clipped| ring(&clipped.shape)).collect()
}

fn shapes(window: &Window) -> usize {
    window.output().shapes.len()
}

#[test]
fn one_point_of_ten_thousand_is_dragged_and_undone() {
    let mut window = window(spiral(COUNT), CurveDisplay::default());
    let before = curve(&window).points().to_vec();
    let from = on_screen(&window, before[POINT]);
    hold(&mut window, from, vec2(60.0, -30.0));
    let expected = before[POINT] + DVec2::new(60.0, 30.0) / lab(&window).view.camera.scale;
    let now = curve(&window).points()[POINT];
    assert!(now.distance(expected) < 1e-3, "{now} instead of {expected}");
    let rings = rings(&window);
    assert!(rings.len() == 1 && rings[0].distance(from + vec2(60.0, -30.0)) < 0.5, "the ring: {rings:?}");
    window.drop_at(from + vec2(60.0, -30.0));
    window.run_steps(2);
    let moved = curve(&window).points().iter().zip(&before).filter(|(a, b)| a != b).count();
    assert_eq!((moved, lab(&window).history.steps()), (1, (1, 0)), "one point, one step");
    lab_mut(&mut window).commands.push(Command::Undo);
    window.run_steps(2);
    assert_eq!(curve(&window).points(), before, "undone");
}

#[test]
fn a_double_click_near_by_inserts_a_knot() {
    let mut window = window(spiral(COUNT), CurveDisplay::default());
    // Right between two knots, and the points about 60 pixels apart.
    let t = POINT as f64 + 0.5;
    let place = curve(&window).evaluate(t).unwrap();
    let apart = curve(&window).points()[POINT].distance(curve(&window).points()[POINT + 1]);
    look_at(&mut window, place, 60.0 / apart);
    let at = on_screen(&window, place);
    window.hover_at(at);
    window.run_steps(2);
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
        window.step();
    }
    window.run_steps(2);
    assert_eq!(curve(&window).points().len(), COUNT + 1, "a further point");
    let knots = curve(&window).space().knots();
    assert!(knots.iter().any(|knot| (knot - t).abs() < 0.05), "a knot near {t}");
    assert!(curve(&window).evaluate(t).unwrap().distance(place) < 1e-9, "the shape is kept");
    assert!(shapes(&window) < 3000, "{} shapes", shapes(&window));
}

#[test]
fn what_is_drawn_is_bounded_and_the_status_line_says_what_is_left_out() {
    let display = CurveDisplay { comb: true, labels: PointLabels::Index, ..CurveDisplay::default() };
    let mut window = window(spiral(COUNT), display.clone());
    let left_out = |window: &Window| window.query_by_label_contains("points in view").is_some();
    assert!(left_out(&window), "told from afar");
    let far = shapes(&window);
    assert!(far < COUNT + 5000, "{far} shapes");
    let place = curve(&window).points()[POINT];
    look_at(&mut window, place, 2000.0);
    assert!(!left_out(&window), "everything is drawn near by");
    assert!(shapes(&window) < 4000, "{} shapes near by", shapes(&window));
    lab_mut(&mut window).commands.push(Command::Fit);
    window.run_steps(2);
    assert!(left_out(&window) && shapes(&window) < far + 100, "as before: {} and {far}", shapes(&window));
    let huge = self::window(spiral(10 * COUNT), display);
    // Dots that would cover each other are left out: ten times the points are far from ten times the shapes.
    assert!(shapes(&huge) < 3 * far, "{} shapes, {far} of a tenth of the points", shapes(&huge));
}
