//! Hands on curves without a screen: drawing, points and weights, by mouse and keyboard, looking at the document.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{
    Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, Rect, TouchPhase, Vec2, pos2, vec2,
};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::{Lab, Tool};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{Camera, CurveDisplay, Document, Edit, View};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

/// Pixels per unit.
const SCALE: f64 = 50.0;

type Window = Harness<'static, Option<LabApp>>;

/// The room with one curve called T, or with nothing.
fn window(curve: Option<Nurbs<DVec2>>) -> Window {
    let mut window = Harness::builder().with_size(vec2(1280.0, 900.0)).with_step_dt(FRAME).build_ui_state(
        |ui, app: &mut Option<LabApp>| {
            let ctx = ui.ctx().clone();
            app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
        },
        None,
    );
    window.step();
    window.step();
    let mut document = Document::new();
    if let Some(curve) = curve {
        let display = CurveDisplay::default();
        document.apply(&Edit::AddCurve { name: "T".to_owned(), curve, display }).unwrap();
    }
    let selected = document.objects().first().map(|object| object.id);
    let lab = window.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    lab.selection.object = selected;
    window.run_steps(3);
    let lab = window.state_mut().as_mut().unwrap().lab_mut();
    lab.view.camera = Camera { center: DVec2::ZERO, scale: SCALE };
    window.run_steps(2);
    window
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn document(window: &Window) -> Document {
    lab(window).history.document().clone()
}

fn curve(window: &Window) -> Nurbs<DVec2> {
    lab(window).curve().expect("a curve is selected").clone()
}

/// The cubic with seven points that a wave makes.
fn wave() -> Nurbs<DVec2> {
    let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0];
    let points = [[-5.0, -1.0], [-4.0, 3.0], [-2.0, 3.0], [-0.5, -2.0], [1.5, -2.0], [2.5, 3.0], [4.0, 1.0]];
    Nurbs::polynomial(SplineSpace::new(3, knots).unwrap(), points.map(DVec2::from).to_vec()).unwrap()
}

fn weighted() -> Nurbs<DVec2> {
    let plain = wave();
    let weights = vec![1.0, 2.0, 0.5, 1.0, 3.0, 1.0, 1.0];
    Nurbs::new(plain.space().clone(), plain.points().to_vec(), weights).unwrap()
}

fn canvas(window: &Window) -> Rect {
    window.get_by_label("Canvas").rect()
}

/// Where a point of the plane is on the screen.
fn at(window: &Window, x: f64, y: f64) -> Pos2 {
    let center = canvas(window).center();
    pos2(center.x + (x * SCALE) as f32, center.y - (y * SCALE) as f32)
}

fn place(window: &Window, at: Pos2) -> DVec2 {
    let way = at - canvas(window).center();
    DVec2::new(f64::from(way.x), -f64::from(way.y)) / SCALE
}

fn move_to(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.step();
}

fn button(window: &mut Window, at: Pos2, button: PointerButton, pressed: bool) {
    window.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
    window.step();
}

fn click(window: &mut Window, at: Pos2) {
    move_to(window, at);
    button(window, at, PointerButton::Primary, true);
    button(window, at, PointerButton::Primary, false);
    window.step();
}

fn click_right(window: &mut Window, at: Pos2) {
    move_to(window, at);
    button(window, at, PointerButton::Secondary, true);
    button(window, at, PointerButton::Secondary, false);
    window.run_steps(2);
}

fn click_world(window: &mut Window, places: &[[f64; 2]]) {
    for &[x, y] in places {
        let at = at(window, x, y);
        click(window, at);
        // So long that no two of them are a double click.
        window.run_steps(40);
    }
}

fn drag_along(window: &mut Window, way: &[Pos2]) {
    move_to(window, way[0]);
    button(window, way[0], PointerButton::Primary, true);
    for &at in way {
        move_to(window, at);
    }
    button(window, way[way.len() - 1], PointerButton::Primary, false);
    window.run_steps(2);
}

fn drag(window: &mut Window, from: Pos2, by: Vec2) {
    let way: Vec<Pos2> = (1..=4).map(|part| from + by * (part as f32 / 4.0)).collect();
    drag_along(window, &[&[from], &way[..]].concat());
}

fn key(window: &mut Window, key: Key) {
    keys(window, Modifiers::NONE, key);
}

fn keys(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

fn type_text(window: &mut Window, text: &str) {
    for letter in text.chars() {
        window.event(Event::Text(letter.to_string()));
        window.step();
    }
    key(window, Key::Enter);
}

fn undo(window: &mut Window) {
    keys(window, Modifiers::COMMAND, Key::Z);
}

fn redo(window: &mut Window) {
    keys(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
}

fn handle(window: &Window, name: &str) -> Pos2 {
    window.get_by_label(name).rect().center()
}

/// How many points of the drawing have handles.
fn drawn(window: &Window) -> usize {
    (0..20).filter(|k| window.query_by_label(&format!("Drawn point {k}")).is_some()).count()
}

/// The numbers of the points that differ.
fn moved(before: &Nurbs<DVec2>, after: &Nurbs<DVec2>) -> Vec<usize> {
    assert_eq!(before.points().len(), after.points().len(), "as many points as before");
    (0..before.points().len()).filter(|&k| before.points()[k] != after.points()[k]).collect()
}

fn distance(curve: &Nurbs<DVec2>, place: DVec2) -> f64 {
    curve.closest_point(place).unwrap().distance
}

fn samples(curve: &Nurbs<DVec2>) -> Vec<DVec2> {
    let (left, right) = curve.space().parameter_interval();
    (0..=40).map(|k| curve.evaluate(left + (right - left) * f64::from(k) / 40.0).unwrap()).collect()
}

#[test]
fn each_point_of_a_drawing_is_undone_and_redone_and_a_right_click_ends() {
    let mut window = window(None);
    key(&mut window, Key::D);
    click_world(&mut window, &[[-4.0, -1.0], [-2.0, 2.0], [0.0, -1.0], [2.0, 2.0], [4.0, 0.0]]);
    assert_eq!(drawn(&window), 5, "five clicks");
    undo(&mut window);
    undo(&mut window);
    assert_eq!(drawn(&window), 3, "two undone");
    redo(&mut window);
    assert_eq!(drawn(&window), 4, "one redone");
    key(&mut window, Key::Backspace);
    assert_eq!(drawn(&window), 3, "Backspace drops one");
    assert!(document(&window).is_empty(), "nothing is finished yet");
    let end = at(&window, 3.0, 3.0);
    click_right(&mut window, end);
    let made = curve(&window);
    assert_eq!(made.points().len(), 3, "a right click ends");
    for (point, wanted) in made.points().iter().zip([[-4.0, -1.0], [-2.0, 2.0], [0.0, -1.0]]) {
        assert!(point.distance(DVec2::from(wanted)) < 0.03, "{point} is not {wanted:?}");
    }
    assert_eq!(lab(&window).tool, Tool::Select, "the tool is put down");
    undo(&mut window);
    assert!(document(&window).is_empty(), "the whole curve is one step");
    redo(&mut window);
    assert_eq!(curve(&window), made, "and comes back");
}

#[test]
fn a_double_click_ends_and_a_click_on_the_first_point_closes() {
    let mut window = window(None);
    key(&mut window, Key::D);
    click_world(&mut window, &[[-3.0, 0.0], [0.0, 3.0]]);
    let end = at(&window, 3.0, 0.0);
    click(&mut window, end);
    click(&mut window, end);
    assert_eq!(curve(&window).points().len(), 3, "the double click is one point and the end");
    keys(&mut window, Modifiers::COMMAND, Key::Num2);
    click_world(&mut window, &[[-3.0, -3.0], [0.0, -1.0], [3.0, -3.0], [-3.0, -3.0]]);
    let closed = curve(&window);
    assert!(closed.space().is_periodic(), "closed");
    for place in [[-3.0, -3.0], [0.0, -1.0], [3.0, -3.0]] {
        assert!(distance(&closed, place.into()) < 0.03, "not through {place:?}");
    }
}

#[test]
fn an_open_spline_runs_through_its_points_at_their_chord_lengths() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num2);
    let places = [[-4.0, 0.0], [-2.0, 2.0], [1.0, -2.0], [4.0, 1.0]];
    click_world(&mut window, &places);
    key(&mut window, Key::Enter);
    let made = curve(&window);
    assert_eq!((made.degree(), made.points().len()), (3, 6), "two control points more than data");
    let mut length = 0.0;
    for (k, &place) in places.iter().enumerate() {
        if k > 0 {
            length += DVec2::from(places[k - 1]).distance(place.into());
        }
        let on_curve = made.evaluate(length.min(made.space().parameter_interval().1)).unwrap();
        assert!(on_curve.distance(place.into()) < 0.1, "point {k}: {on_curve}");
        assert!(distance(&made, place.into()) < 0.03, "point {k} is not on the curve");
    }
}

#[test]
fn circles_are_clicked_dragged_and_typed() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    click_world(&mut window, &[[-2.0, 0.0], [1.0, 0.0]]);
    let clicked = curve(&window);
    for place in samples(&clicked) {
        assert!((place.distance(DVec2::new(-2.0, 0.0)) - 3.0).abs() < 0.05, "{place}");
    }
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    let (center, rim) = (at(&window, 1.0, 1.0), at(&window, 1.0, 3.0));
    drag(&mut window, center, rim - center);
    let dragged = curve(&window);
    assert!(dragged.space().is_periodic() && dragged != clicked, "another circle");
    assert!(
        samples(&dragged).iter().all(|place| (place.distance(DVec2::ONE) - 2.0).abs() < 0.05),
        "radius 2"
    );
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    type_text(&mut window, "0.5;-1");
    type_text(&mut window, "2,5");
    let typed = curve(&window);
    for place in samples(&typed) {
        assert!((place.distance(DVec2::new(0.5, -1.0)) - 2.5).abs() < 1e-12, "exactly 2.5: {place}");
    }
    assert_eq!(document(&window).objects().len(), 3, "three circles");
}

#[test]
fn arcs_ellipses_and_conics_are_clicked() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num5);
    let places = [[-3.0, 0.0], [0.0, 3.0], [3.0, 0.0]];
    click_world(&mut window, &places);
    let arc = curve(&window);
    assert!(samples(&arc).iter().all(|place| (place.length() - 3.0).abs() < 0.05), "half a circle");
    assert!(samples(&arc).iter().all(|place| place.y > -0.05), "above");

    keys(&mut window, Modifiers::COMMAND, Key::Num6);
    click_world(&mut window, &[[0.0, 0.0], [4.0, 0.0], [1.0, 2.0]]);
    let ellipse = curve(&window);
    for place in samples(&ellipse) {
        let sum = (place.x / 4.0).powi(2) + (place.y / 2.0).powi(2);
        assert!((sum - 1.0).abs() < 0.06, "{place}");
    }

    keys(&mut window, Modifiers::COMMAND, Key::Num8);
    click_world(&mut window, &[[-2.0, 4.0], [-1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [3.0, 0.5]]);
    let conics = document(&window);
    for place in [[-2.0, 4.0], [-1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [3.0, 0.5]] {
        let curves = conics.objects().iter().skip(2).filter_map(|object| object.curve());
        let nearest = curves.map(|curve| distance(curve, place.into())).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.03, "{place:?} is {nearest} away");
    }
}

#[test]
fn the_weight_of_a_conic_is_dragged_or_typed() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num7);
    click_world(&mut window, &[[-2.0, 0.0], [0.0, 3.0]]);
    let (end, shoulder) = (at(&window, 2.0, 0.0), at(&window, 0.0, 2.0));
    drag(&mut window, end, shoulder - end);
    let dragged = curve(&window);
    assert!((dragged.weights()[1] - 2.0).abs() < 0.1, "two thirds of the way: {:?}", dragged.weights());
    keys(&mut window, Modifiers::COMMAND, Key::Num7);
    click_world(&mut window, &[[-2.0, -3.0], [0.0, -1.0], [2.0, -3.0]]);
    type_text(&mut window, "0.75");
    assert_eq!(curve(&window).weights(), [1.0, 0.75, 1.0], "typed");
}

#[test]
fn shift_and_ctrl_constrain_and_typed_steps_count_from_the_point_before() {
    let mut window = window(None);
    key(&mut window, Key::D);
    type_text(&mut window, "-3; 1");
    window.event(Event::ModifiersChanged(Modifiers::SHIFT));
    window.step();
    let along = at(&window, 1.0, 1.6);
    click(&mut window, along);
    window.event(Event::ModifiersChanged(Modifiers::CTRL | Modifiers::COMMAND));
    window.step();
    let near = at(&window, 2.06, -1.95);
    click(&mut window, near);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.step();
    type_text(&mut window, "@1;-0.5");
    key(&mut window, Key::Enter);
    let made = curve(&window);
    assert_eq!(made.points()[0], DVec2::new(-3.0, 1.0), "typed");
    assert_eq!(made.points()[1].y, 1.0, "along the axis of x");
    assert_eq!(made.points()[2], DVec2::new(2.0, -2.0), "on the grid");
    assert_eq!(made.points()[3], DVec2::new(3.0, -2.5), "a step from there");
}

#[test]
fn a_stroke_by_free_hand_becomes_a_spline_near_it() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    let way: Vec<Pos2> = (0..=60)
        .map(|k| f64::from(k) / 60.0)
        .map(|s| at(&window, -5.0 + 9.0 * s, 2.0 * (7.0 * s).sin()))
        .collect();
    drag_along(&mut window, &way);
    let stroke = curve(&window);
    for &pixel in &way {
        let off = distance(&stroke, place(&window, pixel)) * SCALE;
        assert!(off <= 2.6, "{off} px");
    }
    assert!(!stroke.space().is_periodic() && stroke.points().len() < 25, "{} points", stroke.points().len());
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    let around: Vec<Pos2> = (0..=60)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 60.0)
        .map(|s| at(&window, 2.5 * s.cos(), 1.5 * s.sin()))
        .collect();
    drag_along(&mut window, &around);
    let closed = curve(&window);
    assert!(closed.space().is_periodic(), "a stroke back to its start is closed");
    let off =
        around.iter().map(|&pixel| distance(&closed, place(&window, pixel)) * SCALE).fold(0.0, f64::max);
    assert!(off <= 2.6, "{off} px");
    undo(&mut window);
    assert_eq!(document(&window).objects().len(), 1, "one step each");
}

#[test]
fn another_tolerance_fits_the_last_stroke_again() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    let way: Vec<Pos2> = (0..=80)
        .map(|k| f64::from(k) / 80.0)
        .map(|s| at(&window, -5.0 + 9.0 * s, 2.0 * (9.0 * s).sin() + 0.3 * (31.0 * s).cos()))
        .collect();
    drag_along(&mut window, &way);
    let fine = curve(&window);
    window.get_by_label("Shapes").click();
    window.run_steps(4);
    let field = "Tolerance of strokes in pixels";
    window.get_by_label(field).click();
    window.run_steps(3);
    window.get_by_label(field).type_text("12");
    window.run_steps(2);
    key(&mut window, Key::Enter);
    window.run_steps(3);
    let rough = curve(&window);
    assert!(
        rough.points().len() < fine.points().len(),
        "{} and {}",
        rough.points().len(),
        fine.points().len()
    );
    let note = lab(&window).shape_note.clone().unwrap_or_default();
    assert!(note.contains("81 points drawn"), "the status line tells: {note}");
    undo(&mut window);
    assert_eq!(curve(&window), fine, "one step back");
}

#[test]
fn shapes_are_chosen_by_mouse_and_a_drawing_is_undone_by_the_button() {
    let mut window = window(None);
    window.get_by_label("Shapes").click();
    window.run_steps(4);
    window.get_by_label_contains("Draw a circular arc").click();
    window.run_steps(4);
    click_world(&mut window, &[[-3.0, 0.0], [0.0, 1.0]]);
    assert_eq!(drawn(&window), 2, "two points");
    window.get_by_label("Undo").click();
    window.run_steps(3);
    assert_eq!(drawn(&window), 1, "one undone");
    window.get_by_label("Redo").click();
    window.run_steps(3);
    click_world(&mut window, &[[3.0, 0.0]]);
    assert!(distance(&curve(&window), DVec2::new(0.0, 1.0)) < 0.03, "an arc through the middle point");
    keys(&mut window, Modifiers::COMMAND, Key::Num5);
    click_world(&mut window, &[[-3.0, -1.0], [0.0, -1.0], [3.0, -1.0]]);
    assert_eq!(document(&window).objects().len(), 1, "no circle through a line");
    assert_eq!(drawn(&window), 2, "another last point may be chosen");
    key(&mut window, Key::Escape);
    assert_eq!((drawn(&window), lab(&window).tool), (0, Tool::Draw), "Escape gives up the drawing");
    key(&mut window, Key::Escape);
    assert_eq!(lab(&window).tool, Tool::Select, "and then the tool");
}

#[test]
fn a_right_click_that_ends_a_drawing_opens_no_menu() {
    let mut window = window(None);
    key(&mut window, Key::D);
    click_world(&mut window, &[[-3.0, 0.0], [0.0, 2.0]]);
    let end = at(&window, 2.0, 0.0);
    click_right(&mut window, end);
    assert_eq!(curve(&window).points().len(), 2, "ended");
    assert!(window.query_by_label_contains("Insert point here").is_none(), "no menu");
}

#[test]
fn a_closed_curve_is_grabbed_across_its_seam() {
    let points = (0..7).map(|k| DVec2::from_angle(f64::from(k) * 0.9) * 3.0).collect();
    let before = Nurbs::closed(points, vec![1.0; 7], 3).unwrap();
    let mut window = window(Some(before.clone()));
    let grip = before.evaluate(0.1).unwrap();
    let from = at(&window, grip.x, grip.y);
    drag(&mut window, from, vec2(35.0, -25.0));
    let after = curve(&window);
    assert!(distance(&after, grip + DVec2::new(35.0, 25.0) / SCALE) < 0.03, "it follows");
    assert_eq!(moved(&before, &after).len(), 4, "four active points");
    key(&mut window, Key::X);
    let from = handle(&window, "Edit point 5 of T");
    drag(&mut window, from, vec2(10.0, 30.0));
    let (old, new) = (after.edit_points().unwrap(), curve(&window).edit_points().unwrap());
    for k in (0..7).filter(|&k| k != 5) {
        assert!(new[k].distance(old[k]) < 1e-9, "edit point {k} stays");
    }
}

#[test]
fn a_grabbed_curve_follows_the_pointer_and_a_click_only_sets_t() {
    for before in [wave(), weighted()] {
        let mut window = window(Some(before.clone()));
        let t = 1.4;
        let grip = before.evaluate(t).unwrap();
        let from = at(&window, grip.x, grip.y);
        click(&mut window, from);
        assert_eq!(curve(&window), before, "a click changes nothing");
        let object = lab(&window).selection.object.unwrap();
        assert!((lab(&window).parameter(object).unwrap() - t).abs() < 0.05, "but sets t");
        // Elsewhere, for the marker of t lies at the place of the click.
        let t = 2.6;
        let grip = before.evaluate(t).unwrap();
        let from = at(&window, grip.x, grip.y);
        drag(&mut window, from, vec2(30.0, -40.0));
        let after = curve(&window);
        let wanted = grip + DVec2::new(30.0, 40.0) / SCALE;
        assert!(distance(&after, wanted) < 0.03, "the curve runs through where it was dragged");
        assert_eq!(moved(&before, &after), [2, 3, 4, 5], "only the active points");
        assert_eq!(after.weights(), before.weights(), "the weights stay");
        undo(&mut window);
        assert_eq!(curve(&window), before, "one step back, exactly");
    }
}

#[test]
fn a_dragged_edit_point_moves_alone_on_the_curve() {
    for before in [wave(), weighted()] {
        let mut window = window(Some(before.clone()));
        key(&mut window, Key::X);
        let from = handle(&window, "Edit point 3 of T");
        drag(&mut window, from, vec2(-20.0, -50.0));
        let after = curve(&window);
        let (old, new) = (before.edit_points().unwrap(), after.edit_points().unwrap());
        for (k, (a, b)) in new.iter().zip(&old).enumerate() {
            let wanted = if k == 3 { *b + DVec2::new(-20.0, 50.0) / SCALE } else { *b };
            assert!(a.distance(wanted) < 1e-6, "edit point {k}: {a} is not {wanted}");
        }
        undo(&mut window);
        assert_eq!(curve(&window), before, "one step back, exactly");
        key(&mut window, Key::X);
        assert!(window.query_by_label("Edit point 3 of T").is_none(), "X hides them");
    }
}

#[test]
fn a_frame_selects_points_that_are_dragged_together() {
    let mut window = window(Some(wave()));
    let (from, to) = (at(&window, -4.6, 4.0), at(&window, -1.4, 2.6));
    drag(&mut window, from, to - from);
    let chosen: Vec<usize> = lab(&window).selection.points.iter().copied().collect();
    assert_eq!(chosen, [1, 2], "what is inside the frame");
    let grip = handle(&window, "Control point 1 of T");
    drag(&mut window, grip, vec2(0.0, 50.0));
    let after = curve(&window);
    assert_eq!(moved(&wave(), &after), [1, 2], "both move");
    assert!((after.points()[2].y - 2.0).abs() < 1e-9, "by the same way: {}", after.points()[2]);
    undo(&mut window);
    assert_eq!(curve(&window), wave(), "one step back");
}

#[test]
fn selected_points_come_into_line() {
    let mut window = window(Some(wave()));
    for k in [1, 2, 4] {
        let from = handle(&window, &format!("Control point {k} of T"));
        if k > 1 {
            window.event(Event::ModifiersChanged(Modifiers::SHIFT));
            window.step();
        }
        click(&mut window, from);
        window.event(Event::ModifiersChanged(Modifiers::NONE));
        window.step();
    }
    let chosen: Vec<usize> = lab(&window).selection.points.iter().copied().collect();
    assert_eq!(chosen, [1, 2, 4], "Shift adds to the selection");
    let before = curve(&window);
    keys(&mut window, Modifiers::ALT, Key::Y);
    let ys: Vec<f64> = [1, 2, 4].map(|k| curve(&window).points()[k].y).to_vec();
    assert!(ys.iter().all(|y| (y - 4.0 / 3.0).abs() < 1e-12), "{ys:?}");
    assert_eq!(moved(&before, &curve(&window)), [1, 2, 4], "only the selected ones");
    keys(&mut window, Modifiers::ALT, Key::D);
    let even = curve(&window);
    assert!((even.points()[2].x - -1.25).abs() < 1e-12, "half way: {}", even.points()[2]);
    keys(&mut window, Modifiers::ALT, Key::G);
    keys(&mut window, Modifiers::ALT, Key::X);
    let xs: Vec<f64> = [1, 2, 4].map(|k| curve(&window).points()[k].x).to_vec();
    assert!(xs.iter().all(|x| (x - xs[0]).abs() < 1e-12), "{xs:?}");
    for _ in 0..4 {
        undo(&mut window);
    }
    assert_eq!(curve(&window), before, "four steps back");
    let on = handle(&window, "Control point 2 of T");
    click_right(&mut window, on);
    window.get_by_label_contains("Align to one x").click();
    window.run_steps(3);
    let xs: Vec<f64> = [1, 2, 4].map(|k| curve(&window).points()[k].x).to_vec();
    assert!(xs.iter().all(|x| (x - -1.5).abs() < 1e-12), "from the menu: {xs:?}");
}

#[test]
fn points_are_inserted_on_edges_and_anywhere_and_deleted() {
    let mut window = window(Some(wave()));
    let middle = at(&window, -3.0, 3.0);
    click(&mut window, middle);
    click(&mut window, middle);
    let longer = curve(&window);
    assert_eq!(longer.points().len(), 8, "a double click on an edge inserts");
    assert!(longer.points()[2].distance(DVec2::new(-3.0, 3.0)) < 0.03, "there: {}", longer.points()[2]);
    assert_eq!(lab(&window).selection.points.iter().copied().collect::<Vec<_>>(), [2], "and selects it");
    key(&mut window, Key::Delete);
    assert_eq!(curve(&window).points().len(), 7, "Delete takes it away");
    undo(&mut window);
    undo(&mut window);
    assert_eq!(curve(&window), wave(), "both steps back");
    let behind = at(&window, 5.0, -1.0);
    click_right(&mut window, behind);
    window.get_by_label_contains("Insert point here").click();
    window.run_steps(3);
    let longer = curve(&window);
    assert!(
        longer.points()[7].distance(DVec2::new(5.0, -1.0)) < 0.03,
        "behind the end: {:?}",
        longer.points()
    );
}

#[test]
fn the_ring_of_a_point_changes_its_weight() {
    let mut window = window(Some(wave()));
    let point = handle(&window, "Control point 3 of T");
    click(&mut window, point);
    let ring = handle(&window, "Weight ring of control point 3 of T");
    let out = (ring - point).normalized();
    drag(&mut window, ring, out * 50.0);
    let after = curve(&window);
    assert!((after.weights()[3] - 2.0).abs() < 0.02, "50 px double it: {:?}", after.weights());
    assert_eq!(moved(&wave(), &after), Vec::<usize>::new(), "no point moves");
    drag(&mut window, ring, out * -50.0);
    assert!((curve(&window).weights()[3] - 1.0).abs() < 0.02, "and back: {:?}", curve(&window).weights());
    undo(&mut window);
    undo(&mut window);
    assert_eq!(curve(&window), wave(), "two steps back, exactly");
}

#[test]
fn a_weight_point_is_dragged_along_its_edge() {
    let mut window = window(Some(weighted()));
    key(&mut window, Key::W);
    let before = curve(&window);
    let from = handle(&window, "Weight point 2 to 3 of T");
    let wanted = before.points()[2].lerp(before.points()[3], 0.25);
    let to = at(&window, wanted.x, wanted.y);
    drag(&mut window, from, to - from);
    let after = curve(&window);
    let ratio = |curve: &Nurbs<DVec2>, k: usize| curve.weights()[k + 1] / curve.weights()[k];
    assert!((ratio(&after, 2) - 1.0 / 3.0).abs() < 0.02, "a quarter of the edge: {:?}", after.weights());
    for k in [0, 1, 3, 4, 5] {
        assert!((ratio(&after, k) / ratio(&before, k) - 1.0).abs() < 1e-12, "weight point {k} stays");
    }
    undo(&mut window);
    assert_eq!(curve(&window), before, "one step back");
}

#[test]
fn alt_and_the_wheel_change_a_weight_and_it_can_be_typed() {
    let mut window = window(Some(wave()));
    let point = handle(&window, "Control point 2 of T");
    click(&mut window, point);
    window.event(Event::ModifiersChanged(Modifiers::ALT));
    window.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 60.0),
        phase: TouchPhase::Move,
        modifiers: Modifiers::ALT,
        source: eframe::egui::MouseWheelSource::Wheel,
    });
    window.run_steps(40);
    window.event(Event::ModifiersChanged(Modifiers::NONE));
    window.run_steps(10);
    assert!(curve(&window).weights()[2] > 1.05, "{:?}", curve(&window).weights());
    undo(&mut window);
    assert_eq!(curve(&window), wave(), "one step");
    let field = "Weight of the selected point";
    window.get_by_label(field).click();
    window.run_steps(3);
    window.get_by_label(field).type_text("2,5");
    window.run_steps(2);
    key(&mut window, Key::Enter);
    assert_eq!(curve(&window).weights()[2], 2.5, "typed with a decimal comma");
    let field = "x of the selected point";
    window.get_by_label(field).click();
    window.run_steps(3);
    window.get_by_label(field).type_text("-2.25");
    window.run_steps(2);
    key(&mut window, Key::Enter);
    assert_eq!(curve(&window).points()[2], DVec2::new(-2.25, 3.0), "the coordinate is typed");
}

#[test]
fn ten_thousand_points_are_edited() {
    let count = 10_000;
    let place = |k: usize| {
        let s = k as f64 / count as f64;
        DVec2::from_angle(30.0 * s) * (1.0 + 3.5 * s)
    };
    let knots = (0..count + 4).map(|k| k as f64).collect();
    let space = SplineSpace::new(3, knots).unwrap();
    let before = Nurbs::polynomial(space, (0..count).map(place).collect()).unwrap();
    let mut window = window(Some(before.clone()));
    let grip = place(9000);
    let from = at(&window, grip.x, grip.y);
    drag(&mut window, from, vec2(25.0, 20.0));
    let dragged = moved(&before, &curve(&window));
    assert_eq!(dragged.len(), 1, "one point: {dragged:?}");
    key(&mut window, Key::X);
    let from = at(&window, place(5000).x, place(5000).y);
    drag(&mut window, from, vec2(25.0, 20.0));
    assert_eq!(lab(&window).history.steps().0, 2, "an edit point");
}
