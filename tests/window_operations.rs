//! Operations on whole curves without a screen, by mouse and keyboard, looking at the document.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Role, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::Lab;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{Camera, CurveDisplay, Document, Edit, View};

/// Seconds from frame to frame, as on a screen.
const FRAME: f32 = 1.0 / 60.0;

/// Pixels per unit.
const SCALE: f64 = 50.0;

type Window = Harness<'static, Option<LabApp>>;

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

fn canvas(window: &Window) -> Rect {
    window.get_by_label("Canvas").rect()
}

/// Where a point of the plane is on the screen.
fn at(window: &Window, x: f64, y: f64) -> Pos2 {
    let center = canvas(window).center();
    pos2(center.x + (x * SCALE) as f32, center.y - (y * SCALE) as f32)
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

fn key(window: &mut Window, key: Key) {
    keys(window, Modifiers::NONE, key);
}

fn keys(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

fn undo(window: &mut Window) {
    keys(window, Modifiers::COMMAND, Key::Z);
}

/// The room with these curves, the first one selected.
fn window(curves: &[Nurbs<DVec2>]) -> Window {
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
    for (k, curve) in curves.iter().enumerate() {
        let edit =
            Edit::AddCurve { name: format!("T{k}"), curve: curve.clone(), display: CurveDisplay::default() };
        document.apply(&edit).unwrap();
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

/// Writes a number into a field of the small window.
fn fill(window: &mut Window, label: &str, text: &str) {
    let field = window
        .get_by(|node| node.label().as_deref() == Some(label) && node.role() != Role::Label)
        .rect()
        .center();
    click(window, field);
    window.run_steps(2);
    keys(window, Modifiers::COMMAND, Key::A);
    for letter in text.chars() {
        window.event(Event::Text(letter.to_string()));
        window.step();
    }
    key(window, Key::Enter);
}

fn press(window: &mut Window, label: &str) {
    let at = window.get_by_label(label).rect().center();
    click(window, at);
    window.run_steps(2);
}

fn curves(window: &Window) -> Vec<Nurbs<DVec2>> {
    let document = document(window);
    document.objects().iter().map(|object| document.curve(object.id).unwrap().clone()).collect()
}

fn interval(curve: &Nurbs<DVec2>) -> (f64, f64) {
    curve.space().parameter_interval()
}

fn near(curve: &Nurbs<DVec2>, other: &Nurbs<DVec2>) -> f64 {
    let (left, right) = interval(curve);
    (0..=40)
        .map(|k| curve.evaluate(left + (right - left) * f64::from(k) / 40.0).unwrap())
        .map(|place| other.closest_point(place).unwrap().distance)
        .fold(0.0, f64::max)
}

fn place_of(window: &Window, curve: &Nurbs<DVec2>, t: f64) -> Pos2 {
    let place = curve.evaluate(t).unwrap();
    at(window, place.x, place.y)
}

fn note(window: &Window) -> String {
    lab(window).shape_note.clone().unwrap_or_default()
}

#[test]
fn a_curve_is_split_at_t_at_a_knot_and_where_it_is_clicked() {
    let mut window = window(&[wave()]);
    key(&mut window, Key::S);
    let parts = curves(&window);
    assert_eq!((interval(&parts[0]), interval(&parts[1])), ((0.0, 2.0), (2.0, 4.0)), "at t = 2");
    assert!(parts.iter().all(|part| near(part, &wave()) < 1e-9), "both on the old curve");
    assert_eq!(curve(&window), parts[1], "the part behind is selected");
    assert!(window.query_by_label_contains("exact").is_some(), "the badge");
    undo(&mut window);
    assert_eq!(curves(&window), [wave()], "undone as one step");

    key(&mut window, Key::Period);
    let knot = lab(&window).selection.knot.expect("a knot is selected");
    key(&mut window, Key::S);
    assert_eq!(interval(&curves(&window)[0]).1.to_bits(), knot.to_bits(), "at the selected knot");
    undo(&mut window);

    let target = place_of(&window, &wave(), 1.37);
    click_right(&mut window, target);
    press(&mut window, "Split here");
    let parts = curves(&window);
    assert_eq!(parts.len(), 2, "two objects");
    assert!((interval(&parts[0]).1 - 1.37).abs() < 0.02, "where it was clicked");
}

#[test]
fn the_nearest_curve_is_joined() {
    let far = wave().transformed(|point| point + DVec2::new(0.0, 20.0)).unwrap();
    let (before, after) = wave().split(1.5).unwrap();
    let mut window = window(&[before, far.clone(), after.reversed().unwrap()]);
    key(&mut window, Key::J);
    let left = curves(&window);
    assert_eq!((left.len(), &left[1]), (2, &far), "the far one stays");
    assert!(near(&wave(), &left[0]) < 1e-9, "the whole wave again");
    assert_eq!(interval(&left[0]), (0.0, 4.0), "with its parameters");
    undo(&mut window);
    assert_eq!(curves(&window).len(), 3, "undone");
}

#[test]
fn a_curve_is_trimmed_by_key_by_number_and_by_menu() {
    let mut window = window(&[wave()]);
    keys(&mut window, Modifiers::ALT, Key::B);
    assert_eq!(interval(&curve(&window)), (0.0, 2.0), "the part before t");
    undo(&mut window);
    keys(&mut window, Modifiers::ALT, Key::A);
    assert_eq!(interval(&curve(&window)), (2.0, 4.0), "the part after t");
    undo(&mut window);
    key(&mut window, Key::T);
    fill(&mut window, "From t", "0.5");
    fill(&mut window, "To t", "3.25");
    press(&mut window, "Apply");
    assert_eq!(interval(&curve(&window)), (0.5, 3.25), "the interval typed");
    assert!(near(&curve(&window), &wave()) < 1e-9, "the shape of the part is kept");
    assert!(window.query_by_label("Apply").is_none(), "the small window is closed");
    undo(&mut window);
    let target = place_of(&window, &wave(), 2.6);
    click_right(&mut window, target);
    press(&mut window, "Keep the part before");
    assert!((interval(&curve(&window)).1 - 2.6).abs() < 0.02, "up to the place clicked");
}

#[test]
fn bezier_form_ends_reverse_refine_and_degree_keep_the_shape() {
    let space = SplineSpace::new(3, (0..11).map(f64::from).collect()).unwrap();
    let simple =
        Nurbs::new(space, wave().points().to_vec(), vec![1.0, 2.0, 1.0, 0.5, 1.0, 1.0, 3.0]).unwrap();
    let mut window = window(std::slice::from_ref(&simple));
    for (pressed, points) in [(Key::Z, 13), (Key::I, 7), (Key::R, 11), (Key::E, 11), (Key::Q, 7)] {
        key(&mut window, pressed);
        let new = curve(&window);
        assert_ne!(new, simple, "{pressed:?} does something");
        assert!(near(&new, &simple) < 1e-8, "{pressed:?} keeps the shape");
        assert_eq!(
            new.points().len(),
            if pressed == Key::E { new.space().dimension() } else { points },
            "{pressed:?}"
        );
        undo(&mut window);
        assert_eq!(curve(&window), simple, "{pressed:?} is undone");
    }
    assert_eq!(curve(&window).reversed().unwrap().points()[0], simple.points()[6], "reversed");
}

#[test]
fn subdivision_says_how_near_the_polygon_comes() {
    let mut window = window(&[wave()]);
    key(&mut window, Key::R);
    assert!(note(&window).contains("Distance of the control polygon"), "{}", note(&window));
    let numbers: Vec<f64> = note(&window)
        .rsplit(": ")
        .next()
        .unwrap()
        .split(" → ")
        .map(|number| number.trim().parse().unwrap())
        .collect();
    assert!(numbers[1] < numbers[0], "nearer: {numbers:?}");
}

#[test]
fn the_whole_curve_is_moved_turned_scaled_and_mirrored_by_numbers() {
    let mut window = window(&[wave()]);
    key(&mut window, Key::M);
    fill(&mut window, "Move x by", "1.5");
    fill(&mut window, "Move y by", "-2");
    press(&mut window, "Apply");
    let wanted = wave().transformed(|point| point + DVec2::new(1.5, -2.0)).unwrap();
    assert_eq!(curve(&window), wanted, "moved");
    undo(&mut window);
    press(&mut window, "Rotate");
    fill(&mut window, "Degrees", "180");
    fill(&mut window, "Centre x", "0");
    fill(&mut window, "Centre y", "0");
    press(&mut window, "Apply");
    assert_eq!(curve(&window), wave().transformed(|point| -point).unwrap(), "turned");
    undo(&mut window);
    press(&mut window, "Scale");
    fill(&mut window, "Factor in x", "3");
    fill(&mut window, "Factor in y", "0.5");
    press(&mut window, "Apply");
    assert_eq!(curve(&window), wave().transformed(|p| p * DVec2::new(3.0, 0.5)).unwrap(), "scaled");
    undo(&mut window);
    press(&mut window, "Mirror");
    fill(&mut window, "Degrees", "90");
    press(&mut window, "Apply");
    assert_eq!(curve(&window), wave().transformed(|p| DVec2::new(-p.x, p.y)).unwrap(), "mirrored");
    key(&mut window, Key::Escape);
    assert!(window.query_by_label("Apply").is_none(), "Escape closes the small window");
}

#[test]
fn an_offset_stands_at_its_distance_and_one_that_has_a_cusp_is_refused() {
    let circle = Nurbs::circle(DVec2::ZERO, 2.0).unwrap();
    let mut window = window(std::slice::from_ref(&circle));
    key(&mut window, Key::Y);
    fill(&mut window, "Distance", "-1");
    fill(&mut window, "Tolerance", "0.001");
    press(&mut window, "Apply");
    let both = curves(&window);
    assert_eq!((both.len(), &both[0]), (2, &circle), "the original stays");
    let (left, right) = interval(&both[1]);
    for k in 0..=40 {
        let place = both[1].evaluate(left + (right - left) * f64::from(k) / 40.0).unwrap();
        assert!((place.length() - 3.0).abs() <= 1e-3, "{place}");
    }
    assert!(window.query_by_label_contains("measured").is_some(), "the badge tells the deviation");
    key(&mut window, Key::Y);
    fill(&mut window, "Distance", "2.5");
    press(&mut window, "Apply");
    assert_eq!(curves(&window).len(), 2, "no curve with a cusp");
    assert!(window.query_by_label("Apply").is_some(), "the window stays, to mend the number");
}

#[test]
fn the_curve_before_is_a_ghost_until_escape_or_undo() {
    let mut window = window(&[wave()]);
    let ghost = |window: &Window| {
        let lab = lab(window);
        let before = lab.before.as_ref().and_then(|before| before.curve(lab.selection.object?).cloned());
        before.filter(|before| Some(before) != lab.curve())
    };
    assert_eq!(ghost(&window), None, "nothing was done");
    keys(&mut window, Modifiers::SHIFT, Key::E);
    assert_eq!(ghost(&window), Some(wave()), "the curve of higher degree");
    assert!(window.query_by_label_contains("changed by at most").is_some(), "the badge");
    key(&mut window, Key::Escape);
    assert_eq!(ghost(&window), None, "Escape");
    undo(&mut window);
    let point = at(&window, 2.5, 3.0);
    move_to(&mut window, point);
    button(&mut window, point, PointerButton::Primary, true);
    move_to(&mut window, point + vec2(30.0, 10.0));
    move_to(&mut window, point + vec2(60.0, 20.0));
    assert_ne!(curve(&window), wave(), "a point is being dragged");
    assert_eq!(ghost(&window), Some(wave()), "during the drag");
    button(&mut window, point + vec2(60.0, 20.0), PointerButton::Primary, false);
    assert_eq!(ghost(&window), Some(wave()), "and after it");
    undo(&mut window);
    assert_eq!(ghost(&window), None, "undone");
}

#[test]
fn every_operation_is_on_the_shortcut_sheet() {
    let mut window = window(&[wave()]);
    key(&mut window, Key::F1);
    window.run_steps(3);
    for name in ["Split", "Join", "Trim", "To Bezier form", "Interpolate ends", "Transform", "Offset"] {
        assert!(window.query_all_by_label_contains(name).next().is_some(), "{name} is on the sheet");
    }
}
