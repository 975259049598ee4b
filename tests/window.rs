//! The window without a screen: what hands do, and that undo takes it back exactly.
#![cfg(feature = "app")]

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::document::Document;

/// Seconds from frame to frame, as on a screen: every event has a frame of its own, and two clicks must follow each
/// other closely to be a double click.
const FRAME: f32 = 1.0 / 60.0;

fn harness(size: Vec2) -> Harness<'static, Option<LabApp>> {
    let mut harness = Harness::builder().with_size(size).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    // Fonts arrive with the second frame.
    harness.step();
    harness.step();
    harness
}

fn document(harness: &Harness<'static, Option<LabApp>>) -> Document {
    harness.state().as_ref().expect("built in the first frame").lab().history.document().clone()
}

fn points(harness: &Harness<'static, Option<LabApp>>) -> Vec<DVec2> {
    let lab = harness.state().as_ref().expect("built in the first frame").lab();
    lab.curve().expect("a curve is selected").points().to_vec()
}

fn selected_name(harness: &Harness<'static, Option<LabApp>>) -> String {
    let lab = harness.state().as_ref().expect("built in the first frame").lab();
    let id = lab.selection.object.expect("something is selected");
    lab.history.document().object(id).expect("it exists").name.clone()
}

fn drag(harness: &mut Harness<'static, Option<LabApp>>, from: Pos2, by: Vec2) {
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for part in 1..=4 {
        harness.hover_at(from + by * (part as f32 / 4.0));
        harness.step();
    }
    harness.drop_at(from + by);
    harness.step();
    harness.step();
}

fn handle(harness: &Harness<'static, Option<LabApp>>, point: usize) -> Pos2 {
    let name = selected_name(harness);
    harness.get_by_label(&format!("Control point {point} of {name}")).rect().center()
}

#[test]
fn a_dragged_point_moves_alone_and_undo_brings_it_back_exactly() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = points(&harness);
    let from = handle(&harness, 1);
    drag(&mut harness, from, vec2(40.0, -30.0));
    let after = points(&harness);
    let moved: Vec<usize> = (0..before.len()).filter(|&k| before[k] != after[k]).collect();
    assert_eq!(moved, [1], "only point 1 may move");
    assert!(
        after[1].x > before[1].x && after[1].y > before[1].y,
        "right and up: {} to {}",
        before[1],
        after[1]
    );
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.step();
    harness.step();
    assert_eq!(points(&harness), before, "undone");
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.step();
    harness.step();
    assert_eq!(points(&harness), after, "redone");
}

#[test]
fn a_click_that_does_not_move_changes_nothing() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = document(&harness);
    let from = handle(&harness, 2);
    drag(&mut harness, from, vec2(2.0, 1.0));
    assert_eq!(document(&harness), before, "two pixels are no drag");
}

#[test]
fn shift_keeps_a_drag_on_one_axis() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = points(&harness);
    let from = handle(&harness, 1);
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    harness.hover_at(from + vec2(50.0, 12.0));
    harness.step();
    harness.drop_at(from + vec2(50.0, 12.0));
    harness.step();
    let after = points(&harness);
    assert!(after[1].x > before[1].x, "moved to the right: {}", after[1]);
    assert_eq!(after[1].y, before[1].y, "and not up or down");
}

#[test]
fn arrows_nudge_the_selected_point_and_delete_removes_it() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = points(&harness);
    let at = handle(&harness, 1);
    drag(&mut harness, at, Vec2::ZERO);
    harness.key_press(Key::ArrowUp);
    harness.step();
    harness.step();
    let nudged = points(&harness);
    assert!(nudged[1].y > before[1].y && nudged[1].x == before[1].x, "{} to {}", before[1], nudged[1]);
    harness.key_press(Key::Delete);
    harness.step();
    harness.step();
    assert_eq!(points(&harness).len(), before.len() - 1, "one point fewer");
    for _ in 0..2 {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.step();
        harness.step();
    }
    assert_eq!(points(&harness), before, "both steps undone");
}

#[test]
fn the_insert_knot_key_keeps_the_shape_and_adds_one_point() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = points(&harness);
    harness.key_press(Key::K);
    harness.step();
    harness.step();
    assert_eq!(points(&harness).len(), before.len() + 1, "one point more");
    let note = harness.state().as_ref().expect("built").lab().shape_note.clone();
    assert!(note.as_deref().is_some_and(|note| note.contains("kept")), "the status line says so: {note:?}");
}

#[test]
fn a_double_click_on_the_curve_inserts_a_knot_there() {
    let mut harness = harness(vec2(1280.0, 800.0));
    let before = points(&harness);
    let name = selected_name(&harness);
    let marker = harness.get_by_label(&format!("Parameter of {name}")).rect().center();
    harness.hover_at(marker);
    harness.step();
    for _ in 0..2 {
        harness.hover_at(marker);
        harness.drag_at(marker);
        harness.drop_at(marker);
        harness.step();
    }
    harness.step();
    assert_eq!(points(&harness).len(), before.len() + 1, "one point more");
}

#[test]
fn the_window_survives_every_size() {
    for size in
        [vec2(1024.0, 700.0), vec2(1920.0, 1080.0), vec2(640.0, 420.0), vec2(60.0, 40.0), vec2(1.0, 1.0)]
    {
        let mut harness = harness(size);
        for _ in 0..3 {
            harness.step();
        }
        assert!(!document(&harness).is_empty(), "the first scene at {size}");
    }
}
