//! The Surfaces room without a screen: what hands do to surfaces, meshes and the eye, and that undo takes it back exactly.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec3;
use spline_lab::app::LabApp;
use spline_lab::app::command::Command;
use spline_lab::app::lab::Lab;
use spline_lab::app::workspace::Room;
use spline_lab::core::surface::{mesh_shapes, samples};
use spline_lab::document::{
    Content, Document, Edit, MeshDisplay, MeshObject, SurfaceDisplay, SurfaceObject, View,
};
use spline_lab::figure::scene::Eye;
use spline_lab::figure::surfaces::control_points;

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

/// The room with one object called T, or with nothing.
fn window(content: Option<Content>) -> Window {
    let mut harness = Harness::builder().with_size(vec2(1280.0, 900.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    harness.step();
    let mut document = Document::new();
    if let Some(content) = content {
        document.apply(&Edit::AddObject { name: "T".to_owned(), content }).unwrap();
    }
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    lab.enter(Room::Surfaces);
    harness.run_steps(6);
    harness
}

fn torus() -> Option<Content> {
    SurfaceObject::new(samples::torus().into(), SurfaceDisplay::default()).map(Content::Surface).ok()
}

fn cube() -> Option<Content> {
    MeshObject::from_cage(mesh_shapes::cube(), MeshDisplay::default()).map(Content::Mesh).ok()
}

fn sheet() -> Option<Content> {
    let sheet = mesh_shapes::open_sheet(3, 3).unwrap();
    MeshObject::from_cage(sheet, MeshDisplay::default()).map(Content::Mesh).ok()
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn document(window: &Window) -> Document {
    lab(window).history.document().clone()
}

fn points(window: &Window) -> Vec<DVec3> {
    control_points(&lab(window).history.document().objects()[0]).to_vec()
}

fn mesh(window: &Window) -> MeshObject {
    lab(window).history.document().objects()[0].mesh().unwrap().clone()
}

/// The numbers of the points that differ.
fn moved(before: &[DVec3], after: &[DVec3]) -> Vec<usize> {
    assert_eq!(before.len(), after.len(), "as many points as before");
    (0..before.len()).filter(|&k| before[k] != after[k]).collect()
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

fn press(at: Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE }
}

fn drag_with(window: &mut Window, button: PointerButton, from: Pos2, by: Vec2) {
    window.hover_at(from);
    window.step();
    window.event(press(from, button, true));
    window.step();
    for part in 1..=4 {
        window.hover_at(from + by * (part as f32 / 4.0));
        window.step();
    }
    window.event(press(from + by, button, false));
    window.run_steps(3);
}

fn drag(window: &mut Window, label: &str, by: Vec2) {
    let from = place(window, label);
    drag_with(window, PointerButton::Primary, from, by);
}

fn click(window: &mut Window, at: Pos2) {
    drag_with(window, PointerButton::Primary, at, Vec2::ZERO);
}

/// The middle of what is drawn.
fn middle(window: &Window) -> Pos2 {
    place(window, "Canvas")
}

#[test]
fn the_start_card_makes_a_surface_or_a_mesh() {
    for (button, is_mesh) in [("Torus", false), ("L-block", true)] {
        let mut window = window(None);
        window.get_by_label(button).click();
        window.run_steps(4);
        let document = document(&window);
        assert_eq!(document.len(), 1, "{button}");
        assert_eq!(document.objects()[0].mesh().is_some(), is_mesh, "{button}");
        let word = if is_mesh { "Vertex" } else { "Control point" };
        assert!(
            window.query_by_label(&format!("{word} 3 of {button}")).is_some(),
            "{button} has its handles"
        );
        undo(&mut window);
        assert!(lab(&window).history.document().is_empty(), "{button} is gone again");
    }
}

#[test]
fn a_control_point_is_dragged_in_the_plane_of_the_view_and_undo_is_exact() {
    let mut window = window(torus());
    let before = points(&window);
    let from = place(&window, "Control point 8 of T");
    drag(&mut window, "Control point 8 of T", vec2(30.0, -40.0));
    let after = points(&window);
    assert_eq!(moved(&before, &after), [8], "only this one");
    let way = after[8] - before[8];
    let axes = Eye::new(lab(&window).view.eye).unwrap().axes();
    assert!(way.dot(axes.towards).abs() < 1e-12 * way.length(), "parallel to the page: {way}");
    assert!(way.dot(axes.right) > 0.0 && way.dot(axes.up) > 0.0, "right and up: {way}");
    let to = place(&window, "Control point 8 of T");
    assert!((to - from - vec2(30.0, -40.0)).length() < 0.1, "it stands under the pointer: {}", to - from);
    assert_eq!(lab(&window).history.steps().0, 1, "one undo step");
    undo(&mut window);
    assert_eq!(points(&window), before, "undone exactly");
}

#[test]
fn shift_and_letters_keep_a_drag_on_an_axis() {
    for (keys, letter, axis) in [(Modifiers::SHIFT, None, 2), (Modifiers::NONE, Some(Key::X), 0)] {
        let mut window = window(torus());
        let before = points(&window);
        let from = place(&window, "Control point 8 of T");
        window.hover_at(from);
        window.step();
        window.event(press(from, PointerButton::Primary, true));
        window.step();
        window.event(Event::ModifiersChanged(keys));
        if let Some(key) = letter {
            window.key_down(key);
        }
        for part in 1..=4 {
            // Up, and a little aside.
            window.hover_at(from + vec2(2.0, -15.0) * part as f32);
            window.step();
        }
        window.event(press(from + vec2(8.0, -60.0), PointerButton::Primary, false));
        window.run_steps(3);
        let way = points(&window)[8] - before[8];
        assert!(way[axis].abs() > 1e-3, "along {axis}: {way}");
        let others = [(axis + 1) % 3, (axis + 2) % 3].map(|other| way[other]);
        assert_eq!(others, [0.0, 0.0], "along {axis} alone: {way}");
    }
}

#[test]
fn a_vertex_of_a_mesh_is_dragged_and_a_click_that_does_not_move_changes_nothing() {
    let mut window = window(cube());
    let before = points(&window);
    drag(&mut window, "Vertex 5 of T", vec2(2.0, 1.0));
    assert_eq!(points(&window), before, "two pixels are no drag");
    assert_eq!(lab(&window).history.steps().0, 0, "and no step");
    drag(&mut window, "Vertex 5 of T", vec2(30.0, 50.0));
    assert_eq!(moved(&before, &points(&window)), [5], "only this one");
    undo(&mut window);
    assert_eq!(points(&window), before, "undone exactly");
}

#[test]
fn an_arrow_at_the_selected_vertex_moves_it_along_its_axis() {
    let mut window = window(cube());
    let at = place(&window, "Vertex 5 of T");
    click(&mut window, at);
    let before = points(&window);
    drag(&mut window, "Move along z", vec2(0.0, -40.0));
    let way = points(&window)[5] - before[5];
    assert!(way.z > 0.01 && way.x == 0.0 && way.y == 0.0, "up: {way}");
}

#[test]
fn arrow_keys_nudge_along_an_axis_and_shift_ten_times_as_far() {
    let mut window = window(cube());
    let at = place(&window, "Vertex 5 of T");
    click(&mut window, at);
    let before = points(&window)[5];
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    let once = points(&window)[5] - before;
    assert!(once.z > 0.0 && once.x == 0.0 && once.y == 0.0, "up: {once}");
    key(&mut window, Modifiers::SHIFT, Key::ArrowUp);
    let more = points(&window)[5] - before - once;
    assert!((more - 10.0 * once).length() < 1e-12, "{more} instead of ten times {once}");
}

#[test]
fn typed_coordinates_are_taken_with_a_comma_too() {
    let mut window = window(cube());
    let at = place(&window, "Vertex 5 of T");
    click(&mut window, at);
    let before = points(&window);
    window.get_by_label("y of the selected point").click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("y of the selected point").type_text("-2,5");
    window.step();
    window.key_press(Key::Enter);
    window.run_steps(3);
    let expected = DVec3::new(before[5].x, -2.5, before[5].z);
    assert_eq!(points(&window)[5], expected, "as typed");
    undo(&mut window);
    assert_eq!(points(&window), before, "undone exactly");
}

#[test]
fn brackets_step_the_levels_between_their_ends() {
    let mut window = window(cube());
    assert_eq!(mesh(&window).level(), 1, "the first level");
    key(&mut window, Modifiers::NONE, Key::CloseBracket);
    assert_eq!(mesh(&window).level(), 2, "finer");
    for _ in 0..3 {
        key(&mut window, Modifiers::NONE, Key::OpenBracket);
    }
    assert_eq!(mesh(&window).level(), 0, "the control mesh");
    for _ in 0..2 {
        undo(&mut window);
    }
    assert_eq!(mesh(&window).level(), 2, "a step too far is no undo step");
}

#[test]
fn orbiting_and_zooming_change_the_eye_and_not_the_document() {
    let mut window = window(torus());
    let (before, eye) = (document(&window), lab(&window).view.eye);
    let at = middle(&window);
    drag_with(&mut window, PointerButton::Middle, at, vec2(120.0, 48.0));
    let turned = lab(&window).view.eye;
    // Half a turn for 480 pt, the near side following the pointer.
    let unit = std::f64::consts::PI / 480.0;
    assert!((turned.yaw - (eye.yaw - 120.0 * unit)).abs() < 1e-9, "{} to {}", eye.yaw, turned.yaw);
    assert!((turned.pitch - (eye.pitch + 48.0 * unit)).abs() < 1e-9, "{} to {}", eye.pitch, turned.pitch);
    assert_eq!(turned.distance, eye.distance, "no nearer");
    window.hover_at(at);
    window.step();
    window.event(Event::MouseWheel {
        unit: eframe::egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 60.0),
        modifiers: Modifiers::NONE,
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Wheel,
    });
    window.run_steps(20);
    assert!(lab(&window).view.eye.distance < eye.distance, "the wheel brings nearer");
    assert_eq!(document(&window), before, "the document is as it was");
    assert_eq!(lab(&window).history.steps(), (0, 0), "nothing to undo");
}

#[test]
fn a_middle_drag_within_one_slow_frame_orbits_all_the_way() {
    let mut window = window(torus());
    let eye = lab(&window).view.eye;
    let at = middle(&window);
    window.hover_at(at + vec2(-200.0, 0.0));
    window.step();
    for event in [
        Event::PointerMoved(at),
        press(at, PointerButton::Middle, true),
        Event::PointerMoved(at + vec2(60.0, 0.0)),
        press(at + vec2(96.0, 0.0), PointerButton::Middle, false),
        Event::PointerMoved(at + vec2(300.0, 0.0)),
    ] {
        window.event(event);
    }
    window.run_steps(3);
    let turned = eye.yaw - lab(&window).view.eye.yaw;
    let expected = 96.0 * std::f64::consts::PI / 480.0;
    assert!((turned - expected).abs() < 1e-9, "{turned} instead of {expected}");
}

#[test]
fn a_click_selects_shift_adds_and_a_marquee_takes_what_it_holds() {
    let mut window = window(sheet());
    let (a, b) = (place(&window, "Vertex 5 of T"), place(&window, "Vertex 6 of T"));
    click(&mut window, a);
    assert_eq!(Vec::from_iter(lab(&window).selection.points.clone()), [5], "clicked");
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    click(&mut window, b);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.run_steps(2);
    assert_eq!(Vec::from_iter(lab(&window).selection.points.clone()), [5, 6], "added");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(lab(&window).selection.points.is_empty(), "Escape clears");
    let canvas = window.get_by_label("Canvas").rect();
    let from = pos2(canvas.left() + 12.0, canvas.top() + 60.0);
    drag_with(&mut window, PointerButton::Primary, from, canvas.right_bottom() - from - vec2(20.0, 20.0));
    assert_eq!(lab(&window).selection.points.len(), 16, "the whole sheet");
    let before = points(&window);
    drag(&mut window, "Vertex 5 of T", vec2(25.0, 0.0));
    let way = points(&window)[0] - before[0];
    let together = points(&window).iter().zip(&before).all(|(to, from)| (*to - *from - way).length() < 1e-12);
    assert!(together && way.length() > 0.01, "all go the same way");
}

#[test]
fn a_vertex_behind_the_surface_is_not_grabbed_through_it() {
    let mut window = window(cube());
    let hidden = place(&window, "Vertex 3 of T");
    click(&mut window, hidden);
    assert!(lab(&window).selection.points.is_empty(), "the surface is before it");
    let before = points(&window);
    drag(&mut window, "Vertex 3 of T", vec2(30.0, 30.0));
    assert_eq!(points(&window), before, "it did not move");
}

#[test]
fn a_click_on_the_refined_mesh_shows_the_stencil_of_a_vertex() {
    let mut window = window(cube());
    let at = middle(&window);
    click(&mut window, at + vec2(11.0, 7.0));
    assert!(window.query_by_label_contains("of level 1").is_some(), "the vertex is named");
    assert!(window.query_by_label("weight").is_some(), "with its weights");
}

#[test]
fn without_selected_points_delete_removes_the_object_and_undo_brings_it_back() {
    let mut window = window(torus());
    let before = document(&window);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert!(lab(&window).history.document().is_empty(), "gone");
    undo(&mut window);
    assert_eq!(document(&window), before, "back");
}

#[test]
fn deleting_points_of_a_net_is_refused_with_the_reason() {
    let mut window = window(torus());
    let before = document(&window);
    let at = place(&window, "Control point 8 of T");
    click(&mut window, at);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(document(&window), before, "nothing changed");
}

#[test]
fn a_deleted_vertex_leaves_a_polygon_and_undo_brings_it_back() {
    let mut window = window(cube());
    let before = document(&window);
    let at = place(&window, "Vertex 5 of T");
    click(&mut window, at);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(mesh(&window).cage().counts(), [7, 9, 4, 2], "three squares became a hexagon");
    assert!(lab(&window).selection.points.is_empty(), "nothing is selected any more");
    undo(&mut window);
    assert_eq!(document(&window), before, "undone exactly");
}

#[test]
fn what_would_leave_no_mesh_is_not_deleted() {
    let mut window = window(cube());
    let before = document(&window);
    key(&mut window, Modifiers::COMMAND, Key::A);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(document(&window), before, "all vertices at once");
}

#[test]
fn the_menu_of_a_face_deletes_it() {
    let mut window = window(cube());
    let at = middle(&window) + vec2(11.0, 7.0);
    drag_with(&mut window, PointerButton::Secondary, at, Vec2::ZERO);
    window.get_by_label("Delete face").click();
    window.run_steps(3);
    assert_eq!(mesh(&window).cage().counts(), [8, 12, 5, 1], "an open box");
}

#[test]
fn inserting_a_knot_keeps_the_surface() {
    let mut window = window(torus());
    let surface =
        |window: &Window| lab(window).history.document().objects()[0].surface().unwrap().surface().clone();
    let before = surface(&window);
    window.get_by_label("Insert knot in u").click();
    window.run_steps(3);
    let after = surface(&window);
    assert!(after.points().len() > before.points().len(), "more points");
    for at in [[0.2, 0.3], [2.5, 1.0], [3.9, 3.9]] {
        let distance = before.evaluate(at).unwrap().distance(after.evaluate(at).unwrap());
        assert!(distance < 1e-13, "{distance} at {at:?}");
    }
}

#[test]
fn the_lessons_of_the_room_judge_a_typed_answer() {
    for (section, wrong, hint, right) in
        [("8.2", "3", "control point", "2,1213"), ("8.3", "4/9", "midpoints", "5/9")]
    {
        let mut window = window(None);
        let current = |window: &Window| lab(window).lesson.as_ref().map(|state| state.lesson.section.clone());
        while current(&window).as_deref() != Some(section) {
            key(&mut window, Modifiers::NONE, Key::PageDown);
        }
        assert_eq!(lab(&window).room(), Room::Surfaces, "{section} opens here");
        for (answer, is_right) in [(wrong, false), (right, true)] {
            window.get_by_label("Answer").focus();
            window.step();
            window.key_press_modifiers(Modifiers::COMMAND, Key::A);
            window.step();
            window.get_by_label("Answer").type_text(answer);
            window.step();
            window.key_press(Key::Enter);
            window.run_steps(3);
            let verdict = lab(&window).lesson.as_ref().unwrap().verdict.clone().unwrap();
            assert_eq!(verdict.correct, is_right, "{section}, {answer}: {verdict:?}");
            assert!(is_right || verdict.message.contains(hint), "{section}, {answer}: {verdict:?}");
        }
    }
}

#[test]
fn the_room_survives_every_command_with_and_without_an_object() {
    for content in [None, torus(), cube(), sheet()] {
        let mut window = window(content);
        for each in Command::ALL {
            let leaves = matches!(each, Command::Quit | Command::Open | Command::New | Command::FirstScene);
            if !leaves && each.room().is_none_or(|only| only == Room::Surfaces) {
                window.state_mut().as_mut().unwrap().lab_mut().commands.push(each);
                window.run_steps(2);
            }
        }
    }
}
