//! A frame of the window without a screen: what it costs to drag a control point of a curve with 1000, 10 000 and 100 000 of them, with this and that shown.
//!
//! One JSON line per measurement: milliseconds of one thread's time per frame, median and 95 %, in all and split into the window's frame function (layout, edit,
//! composition and painting into shapes) and egui's tessellation. `alone` gives the share of single parts, measured apart: composing the picture and applying the edit.
//! What the graphics driver does comes on top. `cargo bench --bench frame_time [NAME ...]` runs those whose name contains one of the words.

#![allow(clippy::print_stdout, reason = "the lines are what a benchmark is for")]

use std::hint::black_box;
use std::time::Instant;

use eframe::egui::{self, Event, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use glam::DVec2;
use spline_lab::app::LabApp;
use spline_lab::app::command::Command;
use spline_lab::app::lab::{Lab, SidePage};
use spline_lab::core::bspline::{EndKnots, SplineSpace};
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, PointLabels, View};
use spline_lab::figure::composition::compose;
use spline_lab::figure::picture::Viewport;

/// Frames that are measured.
const FRAMES: usize = 60;
/// Where knot line and charts stand, as an entry of [`View::panels`].
const KNOT_LINE: &str = "knot_line";
/// The panel with the inspector.
const INSPECTOR: &str = "right";

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let wanted = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    if wanted("start") {
        start();
    }
    for scene in scenes() {
        if wanted(&scene.name) {
            measure(scene);
        }
    }
}

/// What the hand does.
#[derive(Clone, Copy)]
enum Hand {
    /// Drags the control point in the middle.
    DragPoint,
    /// Drags the marker of the parameter.
    DragParameter,
    /// Moves over the curve.
    Hover,
    /// Turns the wheel, in and out.
    Zoom,
}

struct Scene {
    name: String,
    document: Document,
    hand: Hand,
    /// How many points the canvas should show; all if `None`.
    shown: Option<usize>,
    prepare: fn(&mut Lab),
}

fn scenes() -> Vec<Scene> {
    let mut scenes = Vec::new();
    let mut add = |name: String, document: Document, hand, shown, prepare| {
        scenes.push(Scene { name, document, hand, shown, prepare });
    };
    let everything: fn(&mut CurveDisplay) = |display| {
        (display.comb, display.hull, display.construction) = (true, true, true);
        display.labels = PointLabels::Index;
    };
    let all = |_: &mut Lab| {};
    for count in [1_000, 10_000, 100_000] {
        let open = |look: fn(&mut CurveDisplay)| document([open_curve(count, 0.0)], look);
        add(format!("drag-{count}-plain"), open(plain), Hand::DragPoint, None, only_canvas);
        add(format!("drag-{count}-knots"), open(plain), Hand::DragPoint, None, only_knot_line);
        add(format!("drag-{count}-inspector"), open(plain), Hand::DragPoint, None, only_inspector);
        add(format!("drag-{count}-window"), open(plain), Hand::DragPoint, None, all);
        add(format!("drag-{count}-near"), open(plain), Hand::DragPoint, Some(40), all);
        add(format!("drag-{count}-comb-labels-hull"), open(everything), Hand::DragPoint, None, all);
        add(format!("drag-{count}-near-comb-labels-hull"), open(everything), Hand::DragPoint, Some(40), all);
        add(format!("t-{count}-construction"), open(everything), Hand::DragParameter, None, all);
        add(format!("t-{count}-stepper"), open(plain), Hand::DragParameter, None, |lab| {
            lab.side = SidePage::Stepper;
        });
        add(format!("hover-{count}"), open(plain), Hand::Hover, None, all);
        add(format!("zoom-{count}"), open(plain), Hand::Zoom, None, all);
        add(format!("drag-{count}-measures"), open(measures), Hand::DragPoint, None, all);
        add(format!("hover-{count}-measures"), open(measures), Hand::Hover, None, all);
        let closed = document([closed_curve(count)], plain);
        add(format!("drag-{count}-closed-rational"), closed, Hand::DragPoint, None, all);
    }
    let herd = || document((0..1000).map(|k| open_curve(10, f64::from(k))), plain);
    add("drag-1000-curves".to_owned(), herd(), Hand::DragPoint, None, all);
    add("hover-1000-curves".to_owned(), herd(), Hand::Hover, None, all);
    let dozen = || document((0..12).map(|k| open_curve(12, f64::from(k))), measures);
    add("drag-12-curves-measures".to_owned(), dozen(), Hand::DragPoint, None, all);
    add("hover-12-curves-measures".to_owned(), dozen(), Hand::Hover, None, all);
    scenes
}

fn plain(_: &mut CurveDisplay) {}

fn measures(display: &mut CurveDisplay) {
    (display.inflections, display.vertices, display.symmetry) = (true, true, true);
    (display.distance_tube, display.probe_line, display.bezier_points) = (true, true, true);
}

fn only_canvas(lab: &mut Lab) {
    lab.view.panels.insert(KNOT_LINE.to_owned(), false);
    lab.view.panels.insert(INSPECTOR.to_owned(), false);
}

fn only_knot_line(lab: &mut Lab) {
    lab.view.panels.insert(INSPECTOR.to_owned(), false);
}

fn only_inspector(lab: &mut Lab) {
    lab.view.panels.insert(KNOT_LINE.to_owned(), false);
}

/// A cubic spiral with waves.
fn open_curve(count: u32, shift: f64) -> Nurbs<DVec2> {
    let breaks: Vec<f64> = (0..count - 2).map(f64::from).collect();
    let space = SplineSpace::from_breaks(3, &breaks, EndKnots::Interpolating).expect("breaks increase");
    let place = |k: u32| {
        let s = 60.0 * f64::from(k) / f64::from(count);
        DVec2::from_angle(s) * (3.0 + 0.5 * s + 0.2 * (7.0 * s).sin())
            + DVec2::new(40.0 * (shift / 31.0).fract(), 1.5 * shift)
    };
    Nurbs::polynomial(space, (0..count).map(place).collect()).expect("as many as B-splines")
}

/// A closed rational cubic.
fn closed_curve(count: u32) -> Nurbs<DVec2> {
    let space = SplineSpace::periodic(3, f64::from(count), (0..count).map(f64::from).collect());
    let place = |k: u32| {
        let s = std::f64::consts::TAU * f64::from(k) / f64::from(count);
        DVec2::from_angle(s) * (10.0 + 2.0 * (40.0 * s).sin())
    };
    let weights = (0..count).map(|k| 1.0 + 0.25 * f64::from(k % 3)).collect();
    Nurbs::new(space.expect("knots increase"), (0..count).map(place).collect(), weights).expect("weights > 0")
}

fn document(curves: impl IntoIterator<Item = Nurbs<DVec2>>, look: fn(&mut CurveDisplay)) -> Document {
    let mut document = Document::new();
    for (k, curve) in curves.into_iter().enumerate() {
        let mut display = CurveDisplay::default();
        look(&mut display);
        document.apply(&Edit::AddCurve { name: format!("Curve {k}"), curve, display }).expect("a curve");
    }
    document
}

/// The window without a screen.
struct Window {
    ctx: egui::Context,
    app: LabApp,
    time: f64,
}

/// Seconds of one frame.
#[derive(Clone, Copy, Default)]
struct Times {
    frame: f64,
    tessellation: f64,
    shapes: usize,
    vertices: usize,
}

impl Window {
    fn new() -> Self {
        let ctx = egui::Context::default();
        let app = LabApp::for_tests(&ctx);
        Self { ctx, app, time: 0.0 }
    }

    fn input(&mut self, events: Vec<Event>) -> egui::RawInput {
        self.time += 1.0 / 60.0;
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1500.0, 900.0)));
        egui::RawInput { time: Some(self.time), screen_rect, events, focused: true, ..Default::default() }
    }

    fn frame(&mut self, events: Vec<Event>) -> Times {
        let input = self.input(events);
        let start = cpu_seconds();
        let output = self.ctx.run_ui(input, |ui| self.app.frame(ui));
        let framed = cpu_seconds();
        let shapes = output.shapes.len();
        let primitives = self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let tessellation = cpu_seconds() - framed;
        let count = |primitive: &egui::ClippedPrimitive| match &primitive.primitive {
            egui::epaint::Primitive::Mesh(mesh) => mesh.vertices.len(),
            egui::epaint::Primitive::Callback(_) => 0,
        };
        let vertices = primitives.iter().map(count).sum();
        Times { frame: framed - start, tessellation, shapes, vertices }
    }

    /// The canvas on the screen, which assistive programs are told.
    fn canvas(&mut self) -> Rect {
        self.ctx.enable_accesskit();
        let input = self.input(Vec::new());
        let output = self.ctx.run_ui(input, |ui| self.app.frame(ui));
        self.ctx.disable_accesskit();
        let nodes = output.platform_output.accesskit_update.map_or_else(Vec::new, |update| update.nodes);
        let canvas = nodes.into_iter().find(|(_, node)| node.label() == Some("Canvas"));
        let bounds = canvas.and_then(|(_, node)| node.bounds()).expect("the Curves room has a canvas");
        Rect::from_min_max(pos2(bounds.x0 as f32, bounds.y0 as f32), pos2(bounds.x1 as f32, bounds.y1 as f32))
    }

    fn viewport(&self) -> Viewport {
        let lab = self.app.lab();
        let camera = &lab.view.camera;
        Viewport { center: camera.center, scale: camera.scale, size: lab.canvas_size }
    }
}

fn measure(scene: Scene) {
    let mut window = Window::new();
    window.frame(Vec::new());
    let count =
        scene.document.objects().first().and_then(|object| object.curve()).map_or(0, |c| c.points().len());
    let view = View::default();
    *window.app.lab_mut() = Lab::new(scene.document, view);
    (scene.prepare)(window.app.lab_mut());
    window.frame(Vec::new());
    window.app.lab_mut().commands.push(Command::Fit);
    for _ in 0..4 {
        window.frame(Vec::new());
    }
    let object = window.app.lab().selection.object.expect("a curve is selected");
    let point = count / 2;
    let curve = window.app.lab().curve().expect("a curve").clone();
    let place = curve.points()[point];
    if let Some(shown) = scene.shown {
        let far = curve.points()[(point + shown / 2).min(count - 1)].distance(place);
        let camera = &mut window.app.lab_mut().view.camera;
        camera.center = place;
        camera.scale = 300.0 / far;
    }
    let canvas = window.canvas();
    let on_screen = |window: &Window, world: DVec2| {
        let page = window.viewport().page_from_world(world);
        canvas.min + vec2(page.x as f32, page.y as f32)
    };
    let mut at = on_screen(&window, place);
    if matches!(scene.hand, Hand::DragParameter) {
        let parameter = window.app.lab().parameter(object).expect("a curve");
        at = on_screen(&window, curve.evaluate(parameter).expect("in D"));
        // A control point would be taken first.
        for object in window.app.lab().history.document().objects().to_vec() {
            if let Some(display) = object.curve_display() {
                let display = CurveDisplay { points: false, polygon: false, ..display.clone() };
                window.app.lab_mut().edit(Edit::SetDisplay { object: object.id, display });
            }
        }
    }
    window.frame(vec![Event::PointerMoved(at)]);
    window.frame(vec![Event::PointerMoved(at)]);
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let before = curve.points()[point];
    if matches!(scene.hand, Hand::DragPoint | Hand::DragParameter) {
        window.frame(vec![button(true)]);
    }
    let mut times = Vec::new();
    for k in 0..FRAMES + 5 {
        let way = DVec2::from_angle(0.3 * k as f64) * 30.0;
        let to = at + vec2(way.x as f32, way.y as f32);
        let events = match scene.hand {
            Hand::Zoom => vec![Event::MouseWheel {
                source: egui::MouseWheelSource::Wheel,
                unit: egui::MouseWheelUnit::Point,
                delta: vec2(0.0, if k < FRAMES / 2 { 20.0 } else { -20.0 }),
                phase: egui::TouchPhase::Move,
                modifiers: Modifiers::NONE,
            }],
            _ => vec![Event::PointerMoved(to)],
        };
        let time = window.frame(events);
        if k >= 5 {
            times.push(time);
        }
    }
    let lab = window.app.lab();
    let moved = lab.curve().is_some_and(|curve| curve.points()[point].distance(before) > 0.0);
    let held = lab.history.is_interacting();
    match scene.hand {
        Hand::DragPoint => assert!(moved && held, "{}: the point is dragged", scene.name),
        Hand::DragParameter => assert!(lab.view.parameters.contains_key(&object), "{}: t moves", scene.name),
        Hand::Hover | Hand::Zoom => assert!(!moved, "{}: nothing is dragged", scene.name),
    }
    if matches!(scene.hand, Hand::DragPoint | Hand::DragParameter) {
        window.frame(vec![button(false)]);
    }
    let composed = alone(|| {
        let lab = window.app.lab();
        black_box(compose(lab.history.document(), &lab.view, &lab.theme, &window.viewport()));
    });
    let lab = window.app.lab_mut();
    lab.begin("Move point");
    let edited =
        alone(|| lab.update(Edit::MovePoints { object, points: vec![point], delta: DVec2::X * 0.1 }));
    lab.history.cancel();
    let (left, right) = curve.space().parameter_interval();
    let evaluated = alone(|| {
        let parameter = |k: usize| left + (right - left) * k as f64 / 10_000.0;
        (0..10_000).for_each(|k| drop(black_box(curve.evaluate(parameter(k)))));
    });
    let total = quantiles(times.iter().map(|time| time.frame + time.tessellation));
    let frame = quantiles(times.iter().map(|time| time.frame));
    let tessellation = quantiles(times.iter().map(|time| time.tessellation));
    println!(
        "{{\"workload\": \"frame-{}\", \"n\": {count}, \"median_ms\": {:.2}, \"p95_ms\": {:.2}, \"frame_ms\": {:.2}, \"tessellation_ms\": {:.2}, \
         \"alone\": {{\"compose_ms\": {composed:.2}, \"edit_ms\": {edited:.3}, \"evaluate_10000_ms\": {evaluated:.2}}}, \"shapes\": {}, \"vertices\": {}}}",
        scene.name,
        total.0,
        total.1,
        frame.0,
        tessellation.0,
        times.iter().map(|time| time.shapes).max().unwrap_or(0),
        times.iter().map(|time| time.vertices).max().unwrap_or(0),
    );
}

/// From nothing to the shapes of the second frame, which is the first with fonts; the first run is the one that a start of the program has.
fn start() {
    for run in ["first", "again"] {
        let begun = Instant::now();
        let mut window = Window::new();
        let made = begun.elapsed().as_secs_f64();
        window.frame(Vec::new());
        let first = begun.elapsed().as_secs_f64();
        window.frame(Vec::new());
        let second = begun.elapsed().as_secs_f64();
        println!(
            "{{\"workload\": \"start-{run}\", \"made_ms\": {:.1}, \"first_frame_ms\": {:.1}, \"second_frame_ms\": {:.1}}}",
            1e3 * made,
            1e3 * first,
            1e3 * second
        );
    }
}

/// Median of eleven runs, in milliseconds.
fn alone(mut work: impl FnMut()) -> f64 {
    let run = |_| {
        let start = cpu_seconds();
        work();
        cpu_seconds() - start
    };
    quantiles((0..11).map(run)).0
}

/// Median and 95 %, in milliseconds.
fn quantiles(seconds: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = seconds.map(|second| 1e3 * second).collect();
    sorted.sort_by(f64::total_cmp);
    (sorted[sorted.len() / 2], sorted[sorted.len() * 19 / 20])
}

/// Seconds that this thread has had a processor, so that what else runs on the machine does not count; where the system does not tell, seconds on the wall.
fn cpu_seconds() -> f64 {
    // Giving way brings the account up to date.
    std::thread::yield_now();
    let account = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = account.and_then(|line| line.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(wall_seconds, |nanoseconds| 1e-9 * nanoseconds)
}

fn wall_seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}
