//! The Approximation room without a screen: what hands do to data and knots, and that undo takes it back.
#![cfg(feature = "app")]

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use spline_lab::app::LabApp;
use spline_lab::app::command::Command;
use spline_lab::app::workspace::Room;
use spline_lab::document::{Approximation, Content, Edit, KnotChoice, Preset};

const FRAME: f32 = 1.0 / 60.0;

type Window = Harness<'static, Option<LabApp>>;

/// The room with nothing in it.
fn room() -> Window {
    let mut harness = Harness::builder().with_size(vec2(1280.0, 800.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    harness.step();
    harness.state_mut().as_mut().expect("built").lab_mut().enter(Room::Approximation);
    harness.run_steps(3);
    harness
}

fn with(preset: Preset) -> Window {
    let mut window = room();
    let lab = window.state_mut().as_mut().expect("built").lab_mut();
    let content = Content::Approximation(preset.build());
    let made = lab.edit(Edit::AddObject { name: "Test".to_owned(), content }).expect("valid");
    lab.select(made.created[0]);
    // Panels find their width.
    window.run_steps(12);
    window
}

fn data(window: &Window) -> Approximation {
    let lab = window.state().as_ref().expect("built").lab();
    lab.approximation().expect("an approximation is selected").clone()
}

fn command(window: &mut Window, command: Command) {
    window.state_mut().as_mut().expect("built").lab_mut().commands.push(command);
    window.run_steps(3);
}

fn undo(window: &mut Window) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(3);
}

fn place(window: &Window, label: &str) -> Pos2 {
    window.get_by_label(label).rect().center()
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

#[test]
fn the_empty_room_offers_examples() {
    let mut window = room();
    window.get_by_label("Noisy sine").click();
    window.run_steps(3);
    assert_eq!(data(&window), Preset::NoisySine.build(), "the example is there");
    undo(&mut window);
    let lab = window.state().as_ref().expect("built").lab();
    assert!(lab.approximation().is_none(), "and gone again");
}

#[test]
fn a_dragged_datum_moves_alone_and_undo_brings_it_back_exactly() {
    let mut window = with(Preset::Runge);
    let before = data(&window);
    let from = place(&window, "Datum 5 of Test");
    drag(&mut window, from, vec2(5.0, 60.0));
    let after = data(&window);
    let moved: Vec<usize> = (0..before.len()).filter(|&i| before.values()[i] != after.values()[i]).collect();
    assert_eq!(moved, [5], "only datum 5");
    assert!(after.values()[5] < before.values()[5] && after.sites()[5] > before.sites()[5], "right and down");
    undo(&mut window);
    assert_eq!(data(&window), before, "undone");
}

#[test]
fn a_datum_stops_at_its_neighbour() {
    let mut window = with(Preset::Runge);
    let from = place(&window, "Datum 5 of Test");
    drag(&mut window, from, vec2(400.0, 0.0));
    let after = data(&window);
    assert!(after.sites()[5] < after.sites()[6] && after.sites()[5] > 0.19, "just before 0.2");
}

#[test]
fn a_click_that_does_not_move_changes_nothing() {
    let mut window = with(Preset::Runge);
    let before = data(&window);
    let from = place(&window, "Datum 3 of Test");
    drag(&mut window, from, vec2(2.0, 1.0));
    assert_eq!(data(&window), before, "two pixels are no drag");
}

#[test]
fn knots_are_dragged_inserted_and_deleted_on_their_line() {
    let mut window = with(Preset::NoisySine);
    let before = data(&window);
    let from = place(&window, "Knot 1 of method 2 of Test");
    drag(&mut window, from, vec2(40.0, 0.0));
    let knots = data(&window).methods()[1].knots().to_vec();
    assert!(knots[0] == 0.25 && knots[1] > 0.5 && knots[1] < 0.75 && knots[2] == 0.75, "{knots:?}");
    window.key_press(Key::Delete);
    window.run_steps(3);
    assert_eq!(data(&window).methods()[1].knots(), [0.25, 0.75], "the selected knot is gone");
    let middle =
        place(&window, "Knot 0 of method 2 of Test").lerp(place(&window, "Knot 1 of method 2 of Test"), 0.5);
    window.hover_at(middle);
    window.step();
    for _ in 0..2 {
        window.hover_at(middle);
        window.drag_at(middle);
        window.drop_at(middle);
        window.step();
    }
    window.run_steps(3);
    let knots = data(&window).methods()[1].knots().to_vec();
    assert!(knots.len() == 3 && (0.45..0.6).contains(&knots[1]), "a double click inserts: {knots:?}");
    for _ in 0..3 {
        undo(&mut window);
    }
    assert_eq!(data(&window), before, "three steps undone");
}

#[test]
fn an_averaged_knot_becomes_ones_own_when_it_is_dragged() {
    let mut window = with(Preset::Runge);
    let from = place(&window, "Knot 2 of method 3 of Test");
    drag(&mut window, from, vec2(12.0, 0.0));
    let all = data(&window);
    let (_, knots) = all.methods()[2].scheme.space().expect("it has knots");
    assert!(matches!(knots, KnotChoice::Inner(knots) if knots.len() == 5), "{knots:?}");
}

#[test]
fn the_tool_adds_data_where_one_clicks() {
    let mut window = with(Preset::Runge);
    window.key_press(Key::A);
    window.run_steps(3);
    let at = place(&window, "Datum 5 of Test").lerp(place(&window, "Datum 6 of Test"), 0.5);
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
    assert_eq!(data(&window).len(), 12, "one more");
    window.key_press(Key::Escape);
    window.run_steps(3);
    window.key_press(Key::ArrowUp);
    window.run_steps(3);
    window.key_press(Key::Delete);
    window.run_steps(3);
    assert_eq!(data(&window).len(), 11, "the new one was selected and is deleted");
}

#[test]
fn a_pasted_table_becomes_the_data_and_a_bad_one_changes_nothing() {
    let mut window = with(Preset::Runge);
    window.event(Event::Paste("x;y\n0;1,5\n1;2\n2;0\n".to_owned()));
    window.run_steps(3);
    assert_eq!(data(&window).values(), [1.5, 2.0, 0.0], "the table");
    let before = data(&window);
    window.event(Event::Paste("0 1\n0 2\n".to_owned()));
    window.run_steps(3);
    assert_eq!(data(&window), before, "equal sites are refused");
}

#[test]
fn the_room_survives_every_command_with_and_without_an_object() {
    for mut window in [room(), with(Preset::SquareRoot), with(Preset::ThirdDerivative)] {
        for each in Command::ALL {
            let leaves = matches!(each, Command::Quit | Command::Open | Command::New | Command::FirstScene);
            if !leaves && each.room().is_none_or(|only| only == Room::Approximation) {
                command(&mut window, each);
            }
        }
    }
}
