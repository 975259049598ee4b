//! The charts of the Curves room without a screen: their tabs, what they show, and their cursor, by mouse and by keys.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Key, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::{Hovered, Lab};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::{ArcLength, Nurbs};
use spline_lab::document::{CurveDisplay, Document, Edit, View, from_json, to_json};
use spline_lab::figure::curve_chart::Quantity;

type Window = Harness<'static, Option<LabApp>>;

fn wave() -> Nurbs<DVec2> {
    let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0];
    let points = [(0.0, 0.0), (1.0, 2.0), (2.5, 2.5), (4.0, -1.0), (5.0, 0.0), (6.0, 2.0), (7.5, 1.0)];
    let points = points.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
    Nurbs::polynomial(SplineSpace::new(3, knots).unwrap(), points).unwrap()
}

/// The Curves room with one selected curve and its charts open by a click on their tab.
fn window(curve: Nurbs<DVec2>) -> Window {
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
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: "C".to_owned(), curve, display }).unwrap();
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    harness.run_steps(4);
    click(&mut harness, "Charts");
    harness
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn t(window: &Window) -> f64 {
    lab(window).parameter(lab(window).selection.object.unwrap()).unwrap()
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn drag(window: &mut Window, from: Pos2, by: Vec2) {
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

fn cursor(window: &Window) -> Pos2 {
    window.get_by_label("Cursor of the chart").rect().center()
}

#[test]
fn the_cursor_is_dragged_over_t_and_over_the_arc_length() {
    let mut window = window(wave());
    let (at, before) = (cursor(&window), t(&window));
    drag(&mut window, at, vec2(120.0, 0.0));
    let step = t(&window) - before;
    assert!(step > 0.2, "t went from {before} by {step}");
    assert!((cursor(&window).x - at.x - 120.0).abs() < 2.0, "the handle is under the hand");
    assert_eq!(lab(&window).history.steps().0, 0, "the parameter is no part of the document");

    click(&mut window, "Over the arc length");
    let length = ArcLength::new(&wave(), 1e-9).unwrap();
    let (at, before) = (cursor(&window), length.at(t(&window)).unwrap());
    drag(&mut window, at, vec2(-100.0, 0.0));
    let first = length.at(t(&window)).unwrap() - before;
    let at = cursor(&window);
    drag(&mut window, at, vec2(-100.0, 0.0));
    let both = length.at(t(&window)).unwrap() - before;
    assert!(first < 0.0 && (both - 2.0 * first).abs() < 0.03 * first.abs(), "equal lengths: {first}, {both}");
}

#[test]
fn what_is_under_the_pointer_in_the_chart_lights_up_on_the_canvas_and_the_other_way() {
    let mut window = window(wave());
    let object = lab(&window).selection.object.unwrap();
    let at = cursor(&window) + vec2(150.0, 40.0);
    window.hover_at(at);
    window.run_steps(3);
    let Hovered::Curve(hovered, over) = lab(&window).hovered else { panic!("{:?}", lab(&window).hovered) };
    assert_eq!(hovered, object, "the curve of the chart");
    assert!(over > t(&window), "a place behind t");

    let place = lab(&window).curve().unwrap().evaluate(0.7).unwrap();
    let (camera, canvas) = (lab(&window).view.camera, window.get_by_label("Canvas").rect());
    let shift = (place - camera.center) * camera.scale;
    let on_canvas = canvas.center() + vec2(shift.x as f32, -shift.y as f32);
    window.hover_at(on_canvas);
    window.run_steps(3);
    let Hovered::Curve(_, back) = lab(&window).hovered else { panic!("{:?}", lab(&window).hovered) };
    assert!((back - 0.7).abs() < 0.05, "{back} on the canvas, which the chart shows too");
}

#[test]
fn a_click_in_the_chart_sets_t_and_another_quantity_keeps_it() {
    let mut window = window(wave());
    let at = cursor(&window) + vec2(-200.0, 50.0);
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
    let clicked = t(&window);
    assert!((cursor(&window).x - at.x).abs() < 2.0, "the cursor comes to the click");
    let choices =
        [("Speed", Quantity::Speed), ("B-splines", Quantity::Basis), ("Curvature", Quantity::Curvature)];
    for (name, quantity) in choices {
        let chart = window.get_by_label("Chart").rect();
        // The inspector has lines of the same name.
        let choice =
            window.query_all_by_label(name).find(|node| (node.rect().center().y - chart.top()).abs() < 40.0);
        choice.unwrap().click();
        window.run_steps(3);
        assert_eq!((lab(&window).charts.quantity, t(&window)), (quantity, clicked), "{name}");
    }
}

#[test]
fn the_key_changes_between_knots_and_charts_and_the_document_remembers() {
    let mut window = window(wave());
    assert!(window.query_by_label("Chart").is_some(), "the charts are open");
    let view = from_json(&to_json(lab(&window).history.document(), &lab(&window).view)).unwrap().view;
    assert_eq!(view.panels.get("charts"), Some(&true), "saved with the view");
    window.key_press_modifiers(Modifiers::NONE, Key::F9);
    window.run_steps(3);
    assert!(window.query_by_label("Chart").is_none(), "closed");
    assert!(window.query_by_label("Basis functions").is_some(), "the knot line is back");
    // From a shut panel the key leads straight to the charts.
    window.key_press_modifiers(Modifiers::NONE, Key::F4);
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::NONE, Key::F9);
    window.run_steps(3);
    assert!(window.query_by_label("Chart").is_some(), "open again");
}

#[test]
fn a_curve_of_ten_thousand_points_is_charted_without_its_length() {
    let count = 10_000;
    let space = SplineSpace::new(3, (0..count + 4).map(f64::from).collect()).unwrap();
    let points = (0..count).map(|k| DVec2::new(f64::from(k), f64::from(k % 5))).collect();
    let mut window = window(Nurbs::polynomial(space, points).unwrap());
    assert!(
        window.get_by_label("Over the arc length").accesskit_node().is_disabled(),
        "the length is not measured"
    );
    assert!(window.get_by_label("B-splines").accesskit_node().is_disabled(), "they would be a grey band");
    let (at, before) = (cursor(&window), t(&window));
    drag(&mut window, at, vec2(60.0, 0.0));
    assert!(t(&window) > before + 100.0, "the cursor works");
}
