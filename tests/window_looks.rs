//! What is shown and measured of a curve, in the window without a screen: by mouse and by keys.
#![cfg(feature = "app")]
#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::lab::Lab;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, View, from_json, to_json};
use spline_lab::figure::composition::compose;
use spline_lab::figure::picture::Viewport;
use spline_lab::figure::theme::Theme;

type Window = Harness<'static, Option<LabApp>>;

fn curve(shift: f64) -> Nurbs<DVec2> {
    let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0];
    let points = [(0.0, 0.0), (1.0, 2.0), (2.5, 2.5), (4.0, -1.0), (5.0, 0.0), (6.0, 2.0), (7.5, 1.0)];
    let points = points.iter().map(|&(x, y)| DVec2::new(x + shift, y)).collect();
    Nurbs::polynomial(SplineSpace::new(3, knots).unwrap(), points).unwrap()
}

/// The Curves room, the last of the curves selected.
fn window(curves: Vec<Nurbs<DVec2>>) -> Window {
    let mut harness =
        Harness::builder().with_size(vec2(1500.0, 1400.0)).with_step_dt(1.0 / 60.0).build_ui_state(
            |ui, app: &mut Option<LabApp>| {
                let ctx = ui.ctx().clone();
                app.get_or_insert_with(|| LabApp::for_tests(&ctx)).frame(ui);
            },
            None,
        );
    harness.step();
    let mut document = Document::new();
    for (index, curve) in curves.into_iter().enumerate() {
        let display = CurveDisplay::default();
        document.apply(&Edit::AddCurve { name: format!("C{index}"), curve, display }).unwrap();
    }
    let lab = harness.state_mut().as_mut().unwrap().lab_mut();
    *lab = Lab { at_once: true, ..Lab::new(document, View::default()) };
    harness.run_steps(2);
    harness.key_press(Key::F);
    harness.run_steps(4);
    harness
}

fn lab(window: &Window) -> &Lab {
    window.state().as_ref().unwrap().lab()
}

fn display(window: &Window) -> CurveDisplay {
    let object = lab(window).selection.object.unwrap();
    lab(window).history.document().object(object).unwrap().curve_display().unwrap().clone()
}

/// The names of the layers that are drawn and exported.
fn layers(window: &Window) -> Vec<String> {
    let lab = lab(window);
    let viewport = Viewport { center: DVec2::new(4.0, 1.0), scale: 60.0, size: DVec2::new(700.0, 500.0) };
    let picture = compose(lab.history.document(), &lab.view, &Theme::light(), &viewport);
    picture.layers.iter().filter(|layer| !layer.items.is_empty()).map(|layer| layer.name.clone()).collect()
}

fn says(window: &Window, text: &str) -> bool {
    window.query_all_by_label_contains(text).count() > 0
}

#[test]
fn every_look_is_switched_by_its_key_and_by_its_box_saved_and_undone() {
    let mut window = window(vec![curve(0.0)]);
    for (key, text, layer) in [
        (Key::T, "Frame at t", "C0: frame"),
        (Key::H, "Hodograph", "C0: hodograph"),
        (Key::Z, "Bezier points", "C0: Bezier points"),
        (Key::L, "Blossom labels", "C0: blossom labels"),
        (Key::D, "Distance tube", "C0: distance tube"),
        (Key::I, "Inflections", "C0: inflections"),
        (Key::V, "Curvature extrema", "C0: curvature extrema"),
        (Key::S, "Symmetry", "C0: symmetry"),
        (Key::P, "Probe line", "C0: probe line"),
    ] {
        let shown = |window: &Window| layers(window).iter().any(|name| name == layer);
        assert!(!shown(&window), "{text} at first");
        window.key_press_modifiers(Modifiers::SHIFT, key);
        window.run_steps(3);
        assert!(shown(&window), "{text} by its key");
        let lab = lab(&window);
        let saved = from_json(&to_json(lab.history.document(), &lab.view)).unwrap();
        assert_eq!(&saved.document, lab.history.document(), "{text} in the file");
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.run_steps(3);
        assert!(!shown(&window), "{text} undone");
        let boxes = window.query_all_by_role_and_label(eframe::egui::accesskit::Role::CheckBox, text);
        boxes.into_iter().next().unwrap().click();
        window.run_steps(3);
        assert!(shown(&window), "{text} by its box");
    }
}

#[test]
fn the_probe_line_is_turned_by_an_end() {
    let mut window = window(vec![curve(0.0)]);
    window.key_press_modifiers(Modifiers::SHIFT, Key::P);
    window.run_steps(3);
    let end = window.get_by_label("End of the probe line").rect().center();
    for at in [end, end + vec2(-60.0, 40.0)] {
        window.hover_at(at);
        window.step();
        if at == end {
            window.drag_at(at);
            window.step();
        }
    }
    window.drop_at(end + vec2(-60.0, 40.0));
    window.run_steps(3);
    let probe = display(&window).probe.unwrap();
    assert!(probe[1].y < probe[0].y, "turned: {probe:?}");
    assert!(says(&window, "Probe line"), "the counts stand among the measurements");
    assert_eq!(lab(&window).history.steps().0, 2, "shown, and one drag");
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(3);
    assert_eq!(display(&window).probe, None, "undone");
}

#[test]
fn whole_curve_and_joint_are_measured() {
    let window = window(vec![curve(0.0), curve(7.6)]);
    for text in ["Length", "Box from", "Vertices", "G\u{2070} distance", "C\u{b2} difference"] {
        assert!(says(&window, text), "{text}");
    }
    assert!(
        says(&window, "end with the start of C1") || says(&window, "start with the end of C0"),
        "the joint"
    );
}

#[test]
fn the_looks_button_opens_all_looks_with_their_keys_and_stays_open() {
    let mut window = window(vec![curve(0.0)]);
    window.get_by_label("Looks").click();
    window.run_steps(3);
    let entries = [
        "Control polygon",
        "Bezier points",
        "Blossom labels",
        "Distance tube",
        "Curvature comb",
        "Construction at t",
        "Convex hull at t",
        "Frame at t",
        "Circle of curvature",
        "Hodograph",
        "Inflections",
        "Curvature extrema",
        "Symmetry",
        "Probe line",
    ];
    // The boxes of the inspector stand to the right of the popup.
    let click = |window: &mut Window, text: &str| {
        let boxes = window.query_all_by_role_and_label(eframe::egui::accesskit::Role::CheckBox, text);
        let boxes: Vec<_> = boxes.into_iter().collect();
        assert!(boxes.len() >= 2, "{text} in the inspector and in the popup");
        boxes.iter().min_by(|a, b| a.rect().left().total_cmp(&b.rect().left())).unwrap().click();
        window.run_steps(3);
    };
    let before = display(&window);
    for text in entries {
        click(&mut window, text);
    }
    let after = display(&window);
    for (name, before, after) in [
        ("polygon", before.polygon, after.polygon),
        ("hodograph", before.hodograph, after.hodograph),
        ("tube", before.distance_tube, after.distance_tube),
        ("frame", before.frame, after.frame),
        ("extrema", before.vertices, after.vertices),
        ("probe", before.probe_line, after.probe_line),
        ("hull", before.hull, after.hull),
    ] {
        assert_ne!(before, after, "{name} was switched");
    }
    assert_eq!(lab(&window).history.steps().0, entries.len(), "one step each");
}

#[test]
fn the_toolbar_is_one_row_in_a_window_of_1024() {
    let mut window = window(vec![curve(0.0)]);
    for (width, look) in [(1024.0, Key::F6), (1024.0, Key::F8), (1500.0, Key::F6)] {
        window.set_size(vec2(width, 700.0));
        window.key_press(look);
        window.run_steps(4);
        let row = |label: &str| window.get_by_label(label).rect();
        let (first, last) = (row("Undo"), row("Looks"));
        assert!((first.center().y - last.center().y).abs() < 2.0, "{width} wide: {first} and {last}");
        let fit = window.get_all_by_label("Fit").next().unwrap().rect();
        assert!((first.center().y - fit.center().y).abs() < 2.0 && fit.right() <= width, "Fit at {fit}");
    }
}

/// Moves the pointer to `at` and lets it rest.
fn rest(window: &mut Window, at: eframe::egui::Pos2) {
    window.hover_at(at);
    window.run_steps(40);
}

#[test]
fn a_mark_tells_what_it_is_when_the_pointer_rests_on_it() {
    let mut window = window(vec![curve(0.0)]);
    for key in [Key::I, Key::P, Key::Z] {
        window.key_press_modifiers(Modifiers::SHIFT, key);
        window.run_steps(2);
    }
    let point = window.get_by_label("Control point 3 of C0").rect().center();
    assert!(!says(&window, "blossom ["), "no note at first");
    rest(&mut window, point);
    assert!(says(&window, "Control point 3 of C0") && says(&window, "blossom ["), "the point with its knots");
    rest(&mut window, point + vec2(200.0, 150.0));
    assert!(!says(&window, "blossom ["), "gone beside it");
    let end = window.get_by_label("Control point 0 of C0").rect().center();
    rest(&mut window, end);
    for words in ["Knot of C0", "multiplicity 3, C\u{2070}", "Bezier point 0 of piece 0 of C0"] {
        assert!(says(&window, words), "{words}");
    }
}

#[test]
fn labels_without_room_are_counted_in_the_status_line() {
    let mut window = window(vec![curve(0.0)]);
    for (modifiers, key) in [(Modifiers::NONE, Key::L), (Modifiers::SHIFT, Key::L)] {
        window.key_press_modifiers(modifiers, key);
        window.run_steps(2);
    }
    assert!(!says(&window, "without room"), "there is room for all");
    for _ in 0..14 {
        window.key_press_modifiers(Modifiers::COMMAND, Key::Minus);
        window.run_steps(2);
    }
    assert!(says(&window, "labels without room"), "seven points on a few pixels");
}
