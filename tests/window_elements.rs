//! The Finite elements room without a screen: problems are started, dragged, typed and solved.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Key, Modifiers, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::Lab;
use spline_lab::app::workspace::Room;
use spline_lab::document::{Content, Document, Edit, HandleId, Membrane, MembranePreset, View};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

/// The room with one problem, or with nothing.
fn window(preset: Option<MembranePreset>) -> Window {
    let mut harness = Harness::builder().with_size(vec2(1280.0, 900.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    harness.step();
    let mut document = Document::new();
    if let Some(preset) = preset {
        let content = Content::Membrane { membrane: preset.membrane(), display: preset.display() };
        document.apply(&Edit::AddObject { name: "P".to_owned(), content }).unwrap();
    }
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    lab.enter(Room::Elements);
    for _ in 0..3 {
        harness.step();
    }
    harness
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn membrane(window: &Window) -> Membrane {
    let document = lab(window).history.document();
    document.objects().iter().find_map(|object| object.membrane()).unwrap().0.clone()
}

fn drag(window: &mut Window, label: &str, by: Vec2) {
    let from = window.get_by_label(label).rect().center();
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for part in 1..=4 {
        window.hover_at(from + by * (part as f32 / 4.0));
        window.step();
    }
    window.drop_at(from + by);
    window.step();
    window.step();
}

fn key(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.step();
    window.step();
}

#[test]
fn dragging_the_centre_moves_the_disc_and_undo_brings_it_back() {
    let mut window = window(Some(MembranePreset::Disc));
    let before = membrane(&window);
    drag(&mut window, "Centre of disc 1 of P", vec2(60.0, -30.0));
    let after = membrane(&window);
    let center = after.handle(HandleId { part: 0, index: 0 }).unwrap();
    assert!(center.x > 0.1 && center.y > 0.05, "right and up: {center}");
    let radius = after.handle(HandleId { part: 0, index: 1 }).unwrap() - center;
    assert!((radius - DVec2::X).length() < 1e-12, "the radius is kept: {radius}");
    assert_eq!(lab(&window).history.steps().0, 1, "one undo step");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(membrane(&window), before, "undone exactly");
}

#[test]
fn a_radius_is_dragged_and_a_click_changes_nothing() {
    let mut window = window(Some(MembranePreset::Disc));
    let before = membrane(&window);
    drag(&mut window, "Radius of disc 1 of P", vec2(2.0, 1.0));
    assert_eq!(membrane(&window), before, "two pixels are no drag");
    drag(&mut window, "Radius of disc 1 of P", vec2(-50.0, 0.0));
    let after = membrane(&window);
    let radius = after.handle(HandleId { part: 0, index: 1 }).unwrap().x;
    assert!(radius < 0.95, "smaller: {radius}");
}

#[test]
fn a_patch_point_is_dragged_nudged_and_refused_where_the_patch_would_fold() {
    let mut window = window(Some(MembranePreset::BookPatch));
    let before = membrane(&window);
    drag(&mut window, "Control point 4 of P", vec2(30.0, 0.0));
    let x = |window: &Window| membrane(window).patch().unwrap().points()[4].x;
    let moved = x(&window);
    assert!(moved > before.patch().unwrap().points()[4].x, "to the right");
    key(&mut window, Modifiers::NONE, Key::ArrowLeft);
    assert!(x(&window) < moved, "nudged to the left");
    // Folded: the document takes it, the canvas says why there is no solution.
    drag(&mut window, "Control point 4 of P", vec2(-600.0, 250.0));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(x(&window) < moved, "and undo brings it back");
}

#[test]
fn keys_refine_and_show_nodes_and_delete_removes_a_part() {
    let mut window = window(Some(MembranePreset::Mushroom));
    key(&mut window, Modifiers::NONE, Key::R);
    assert!(membrane(&window).summary().ends_with("h = 0.125"), "{}", membrane(&window).summary());
    key(&mut window, Modifiers::NONE, Key::N);
    let object = lab(&window).history.document().objects()[0].clone();
    assert!(!object.membrane().unwrap().1.nodes, "the nodes are hidden");
    drag(&mut window, "Second half axis of ellipse 3 of P", vec2(0.0, -20.0));
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(membrane(&window).parts().len(), 2, "the ellipse is gone");
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert!(lab(&window).history.document().is_empty(), "with nothing selected the object goes");
}

#[test]
fn the_empty_room_starts_with_a_button() {
    let mut window = window(None);
    window.get_by_label("Disc with a hole").click();
    window.step();
    window.step();
    assert_eq!(membrane(&window), MembranePreset::Ring.membrane(), "the ring is there");
    assert!(window.query_by_label("Centre of disc 2 of Disc with a hole").is_some(), "with its handles");
}

#[test]
fn a_load_with_a_mistake_is_refused_with_its_place_and_a_right_one_is_taken() {
    let mut window = window(Some(MembranePreset::Disc));
    let before = membrane(&window);
    let retype = |window: &mut Window, text: &str| {
        window.get_by_label("Load").focus();
        window.step();
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.step();
        window.get_by_label("Load").type_text(text);
        window.step();
        window.key_press(Key::Enter);
        window.step();
        window.step();
    };
    retype(&mut window, "x + + )");
    assert_eq!(membrane(&window), before, "nothing changed");
    assert!(window.query_by_label_contains("at character").is_some(), "the place is shown");
    retype(&mut window, "x^2 y");
    assert_eq!(membrane(&window).setting().load.text(), "x^2 y", "taken as typed");
}

#[test]
fn errors_are_measured_with_their_rates() {
    let mut window = window(Some(MembranePreset::Disc));
    window.get_by_label("Measure errors").click();
    for _ in 0..4 {
        window.step();
    }
    // Degree 2: the rates of the theory are 3 and 2.
    let found = ["2.99", "3.00", "3.01", "2.98", "3.02"]
        .iter()
        .any(|rate| window.query_all_by_label(rate).count() > 0);
    assert!(found, "a rate near 3 stands in the table");
}
