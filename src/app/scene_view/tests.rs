use std::f64::consts::{PI, TAU};

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Sense, Shape, pos2, vec2};
use eframe::egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::{DVec2, DVec3};

use super::geometry::{Geometry, Kind};
use super::gpu::{Counts, Gpu, Order};
use super::pace::Quality;
use super::*;
use crate::document::EyeState;
use crate::figure::picture::{Color, MarkerShape, Stroke};
use crate::figure::scene::{Line, Paper, Points, SceneLabel, StandardView, Triangles};

/// A torus around the z-axis of 2·rows·columns triangles, radii 1 and 0.4.
fn torus(rows: u32, columns: u32) -> Triangles {
    let place = |row: u32, column: u32| {
        let (v, u) = (TAU * f64::from(row) / f64::from(rows), TAU * f64::from(column) / f64::from(columns));
        let normal = DVec3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
        (DVec3::new(u.cos(), u.sin(), 0.0) + normal * 0.4, normal)
    };
    let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let (positions, normals) = cells().map(|(row, column)| place(row, column)).unzip();
    let vertex = |row: u32, column: u32| row % rows * columns + column % columns;
    let triangles = cells()
        .flat_map(|(row, column)| {
            let [a, b] = [vertex(row, column), vertex(row, column + 1)];
            let [c, d] = [vertex(row + 1, column + 1), vertex(row + 1, column)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Triangles::new(positions, triangles, Color::hex(0x8F_B8_DE)).unwrap().with_normals(normals).unwrap()
}

fn scene(items: Vec<SceneItem>) -> Scene {
    let mut scene = Scene::new(None);
    scene.push_layer("all", items);
    scene
}

fn line(points: &[[f64; 3]], width: f64) -> Line {
    let points = points.iter().copied().map(DVec3::from_array).collect();
    Line::new(points, Stroke::solid(Color::hex(0), width)).unwrap()
}

/// A torus with a line, marks and a text.
fn still_life() -> Scene {
    let ring = (0..=48).map(|k| TAU * f64::from(k) / 48.0).map(|u| [1.4 * u.cos(), 1.4 * u.sin(), 0.0]);
    let ring = line(&ring.collect::<Vec<_>>(), 1.5);
    let corners = vec![DVec3::new(1.4, 0.0, 0.0), DVec3::new(0.0, -1.4, 0.0)];
    let marks = Points::new(corners, MarkerShape::Disc, 8.0, Color::hex(0xC2_41_0C)).unwrap();
    let label = SceneLabel::new(DVec3::Z, "top", 12.0, Color::hex(0)).unwrap();
    scene(vec![
        SceneItem::Triangles(torus(16, 32)),
        SceneItem::Line(ring),
        SceneItem::Points(marks),
        SceneItem::Label(label),
    ])
}

// ---- The window without a GPU

struct Desk {
    view: SceneView,
    scene: Scene,
    version: u64,
    eye: Eye,
    rect: Rect,
    moves: usize,
}

impl Desk {
    fn page(&self) -> EyeView {
        view_through(self.eye, self.rect)
    }
}

fn window() -> Harness<'static, Desk> {
    let view = SceneView::default();
    let (eye, rect) = (Eye::default(), Rect::NOTHING);
    let desk = Desk { view, scene: still_life(), version: 1, eye, rect, moves: 0 };
    let builder = Harness::builder().with_size(vec2(400.0, 300.0)).with_step_dt(1.0 / 60.0);
    let mut harness = builder.build_ui_state(
        |ui, desk: &mut Desk| {
            let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
            desk.rect = rect;
            desk.moves += usize::from(desk.view.move_eye(&mut desk.eye, &response, ui));
            let (page, theme) = (view_through(desk.eye, rect), Theme::light());
            desk.view.paint(&desk.scene, desk.version, &page, &theme, rect, ui);
            axis_gizmo(&mut desk.eye, rect, &theme, ui);
        },
        desk,
    );
    harness.step();
    harness
}

fn drag(harness: &mut Harness<'_, Desk>, button: PointerButton, keys: Modifiers, to: [Pos2; 2]) {
    let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers: keys };
    harness.event_modifiers(Event::PointerMoved(to[0]), keys);
    harness.step();
    harness.event_modifiers(press(to[0], true), keys);
    harness.step();
    for part in 1..=4 {
        harness.event_modifiers(Event::PointerMoved(to[0].lerp(to[1], part as f32 / 4.0)), keys);
        harness.step();
    }
    harness.event_modifiers(press(to[1], false), keys);
    harness.step();
}

const FROM: Pos2 = pos2(200.0, 150.0);
const TO: Pos2 = pos2(248.0, 126.0);

#[test]
fn without_a_gpu_the_processor_paints() {
    let mut harness = window();
    let ctx = harness.ctx.clone();
    harness.state_mut().view.stand_in.finish(&ctx);
    harness.step();
    let textured = |shape: &Shape| match shape {
        Shape::Rect(rect) => rect.brush.is_some(),
        Shape::Mesh(mesh) => mesh.texture_id != egui::TextureId::default(),
        _ => false,
    };
    let shapes = &harness.output().shapes;
    assert!(shapes.iter().any(|clipped| textured(&clipped.shape)), "the surface as an image");
    let circles = shapes.iter().filter(|clipped| matches!(clipped.shape, Shape::Circle(_))).count();
    assert!(circles >= 7, "two marks, of which one may be hidden, and six ends of the axes: {circles}");
    let drawn = harness.state().view.stand_in.drawn;
    (0..20).for_each(|_| harness.step());
    assert_eq!(harness.state().view.stand_in.drawn, drawn, "nothing is drawn while nothing changes");
    harness.state_mut().version += 1;
    harness.step();
    harness.state_mut().view.stand_in.finish(&ctx);
    assert!(harness.state().view.stand_in.drawn > drawn, "a new version is");
}

#[test]
fn many_lines_go_into_the_image_and_marks_stay_sharp() {
    let mut crowd = still_life();
    let net = (0..3200).map(|_| SceneItem::Line(line(&[[-2.0, 0.0, 1.0], [2.0, 0.0, 1.0]], 3.0)));
    crowd.push_layer("net", net.collect());
    for (scene, paths_expected) in [(still_life(), true), (crowd, false)] {
        let (image, picture) = stand_in::draw_for_tests(&scene, DVec2::new(200.0, 150.0));
        let image = image.unwrap();
        assert!(image.pixels.iter().any(|pixel| pixel.a() == 255), "the surface");
        let items = || picture.layers.iter().flat_map(|layer| &layer.items);
        assert_eq!(items().any(|item| matches!(item, Item::Path(_))), paths_expected, "lines");
        assert!(items().any(|item| matches!(item, Item::Marker(_))), "marks");
        assert!(items().any(|item| matches!(item, Item::Label(_))), "texts");
    }
}

#[test]
fn a_middle_drag_orbits_at_the_same_distance() {
    let mut harness = window();
    let before = harness.state().eye;
    drag(&mut harness, PointerButton::Middle, Modifiers::NONE, [FROM, TO]);
    let after = harness.state().eye;
    assert_eq!(after.state().target, before.state().target, "the target stays");
    assert_eq!(after.state().distance, before.state().distance, "so does the distance");
    let turned = after.state().yaw - before.state().yaw;
    assert!((turned + 48.0 * PI / 480.0).abs() < 1e-6, "to the right by 48 pt: yaw changes by {turned}");
    assert!(after.state().pitch < before.state().pitch, "up: one looks from farther below");
    assert_eq!(harness.state().moves, 4, "it moved while the pointer did");
    // Space and the left button do the same.
    let mut other = window();
    other.key_down(Key::Space);
    other.step();
    drag(&mut other, PointerButton::Primary, Modifiers::NONE, [FROM, TO]);
    assert_eq!(other.state().eye, after, "with Space");
}

#[test]
fn right_and_shifted_drags_pan_within_the_plane_of_the_view() {
    for (button, keys) in
        [(PointerButton::Middle, Modifiers::SHIFT), (PointerButton::Secondary, Modifiers::NONE)]
    {
        let mut harness = window();
        let before = harness.state().page();
        drag(&mut harness, button, keys, [FROM, TO]);
        let after = harness.state().page();
        let shift = after.eye.state().target - before.eye.state().target;
        assert!(shift.length() > 0.0, "{button:?} moves the target");
        assert!(shift.dot(before.eye.axes().towards).abs() < 1e-12, "{button:?} in the plane of the view");
        assert_eq!(after.eye.axes(), before.eye.axes(), "{button:?} does not turn");
        if button == PointerButton::Middle {
            let seen = after.project(before.eye.state().target).unwrap().page;
            let expected = before.size * 0.5 + DVec2::new(48.0, -24.0);
            assert!(seen.distance(expected) < 1e-3, "the old target follows the pointer: {seen}");
        }
    }
}

#[test]
fn the_wheel_keeps_what_lies_under_the_pointer() {
    let mut harness = window();
    let at = pos2(320.0, 90.0);
    harness.event(Event::PointerMoved(at));
    harness.step();
    let before = harness.state().page();
    let page = page_from_screen(harness.state().rect, at);
    let held = before.world_from_page(page, before.eye.state().distance);
    harness.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    (0..40).for_each(|_| harness.step());
    let after = harness.state().page();
    assert!(after.eye.state().distance < before.eye.state().distance, "nearer");
    let seen = after.project(held).unwrap().page;
    assert!(seen.distance(page) < 1e-6, "{seen} instead of {page}");
}

#[test]
fn a_double_click_with_the_middle_button_shows_everything() {
    let mut harness = window();
    let far = EyeState { distance: 300.0, target: DVec3::splat(40.0), ..EyeState::default() };
    harness.state_mut().eye = Eye::new(far).unwrap();
    let press = |pressed| Event::PointerButton {
        pos: FROM,
        button: PointerButton::Middle,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.event(Event::PointerMoved(FROM));
    harness.step();
    for _ in 0..2 {
        harness.event(press(true));
        harness.step();
        harness.event(press(false));
        harness.step();
    }
    let page = harness.state().page();
    for &place in torus(8, 8).positions() {
        let seen = page.project(place).unwrap().page;
        assert!(seen.cmpgt(DVec2::ZERO).all() && seen.cmplt(page.size).all(), "{place} is at {seen}");
    }
}

#[test]
fn a_click_on_an_axis_looks_from_there_and_a_second_one_from_behind() {
    let mut harness = window();
    for (name, expected) in
        [("Look from x", DVec3::X), ("Look from x", -DVec3::X), ("Look from −y", -DVec3::Y)]
    {
        harness.get_by_label(name).click();
        (0..3).for_each(|_| harness.step());
        let towards = harness.state().eye.axes().towards;
        assert!(towards.distance(expected) < 1e-9, "{name}: {towards}");
    }
    let down = gizmo::looking_from(&Eye::default(), DVec3::Z);
    assert!(down.axes().towards.distance(DVec3::Z) < 1e-9, "from above");
    assert_eq!(down.state().yaw, EyeState::default().yaw, "without a turn");
}

// ---- Grips

fn square(z: f64) -> SceneItem {
    let corners = [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
    let corners = corners.map(DVec3::from_array).to_vec();
    let mut square = Triangles::new(corners, vec![[0, 1, 2], [0, 2, 3]], Color::hex(0xFF_00_00)).unwrap();
    square.is_lit = false;
    SceneItem::Triangles(square)
}

/// A page of 200 pt from above: 50 pt per unit at height 0.
fn from_above(orthographic: bool) -> EyeView {
    let field_of_view = 2.0 * 0.2f64.atan();
    let state = EyeState { distance: 10.0, field_of_view, orthographic, ..EyeState::default() };
    EyeView { eye: Eye::new(state).unwrap().turned_to(StandardView::Top), size: DVec2::splat(200.0) }
}

#[test]
fn things_follow_the_pointer_on_their_track() {
    let view = EyeView { eye: Eye::default(), size: DVec2::new(400.0, 300.0) };
    let at = DVec3::new(0.3, -0.2, 0.5);
    let page = view.project(at).unwrap().page;
    let grip = Grip { at, page };
    let to = page + DVec2::new(30.0, -20.0);
    let moved = grip.moved(&view, to, Track::Page);
    assert!(view.project(at + moved).unwrap().page.distance(to) < 1e-9, "it stays under the pointer");
    for axis in DVec3::AXES {
        let moved = grip.moved(&view, to, Track::Axis(axis));
        assert!(moved.cross(axis).length() < 1e-12 && moved.length() > 0.0, "along {axis}: {moved}");
    }
    let end_on = from_above(true);
    assert_eq!(grip.moved(&end_on, to, Track::Axis(DVec3::Z)), DVec3::ZERO, "one looks along it");
    assert_eq!(likeliest_axis(&end_on, at, DVec2::new(1.0, -5.0)), DVec3::Y, "up on the page");
    assert_eq!(likeliest_axis(&view, at, DVec2::new(1.0, -5.0)), DVec3::Z, "up in space");
}

// ---- Geometry

fn floats(bytes: &[u8], at: usize, count: usize) -> Vec<f32> {
    let quads = bytes[4 * at..4 * (at + count)].chunks(4);
    quads.map(|four| f32::from_ne_bytes([four[0], four[1], four[2], four[3]])).collect()
}

#[test]
fn every_corner_of_a_segment_knows_its_neighbours() {
    let open = line(&[[1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0]], 2.0);
    let closed = line(&[[1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [1.0, 0.0, 0.0]], 2.0);
    let of = |line: Line| Geometry::new(&scene(vec![SceneItem::Line(line)]), DVec3::X);
    let geometry = of(open);
    assert_eq!(geometry.strokes.len(), 2 * 4 * 60, "two segments of four corners");
    let corner = |geometry: &Geometry, k: usize| floats(&geometry.strokes, 15 * k, 9);
    let [a, b, c] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 4.0, 0.0]];
    assert_eq!(
        corner(&geometry, 0),
        [a, b, a].concat(),
        "nothing before the first end, counted from the origin"
    );
    assert_eq!(corner(&geometry, 2), [b, a, c].concat(), "the next point beyond the second end");
    assert_eq!(corner(&geometry, 4), [b, c, a].concat(), "the point before");
    assert_eq!(corner(&geometry, 6), [c, b, c].concat(), "nothing after the last");
    assert_eq!(floats(&geometry.strokes, 15 * 6 + 11, 1), [7.0], "length from the start");
    let geometry = of(closed);
    assert_eq!(corner(&geometry, 0), [a, b, c].concat(), "a closed line has a point before the first");
    assert_eq!(corner(&geometry, 10), [a, c, b].concat(), "and one after the last");
}

#[test]
fn lines_and_marks_keep_their_order_in_few_runs() {
    let marks = || {
        let points = Points::new(vec![DVec3::ZERO; 3], MarkerShape::Cross, 5.0, Color::hex(0)).unwrap();
        SceneItem::Points(points)
    };
    let edge = || line(&[[0.0; 3], [1.0; 3]], 1.0);
    let items = vec![
        SceneItem::Line(edge()),
        SceneItem::Line(edge()),
        marks(),
        SceneItem::Line(edge().on_top()),
        SceneItem::Line(line(&[[0.0; 3]], 1.0)),
        SceneItem::Line(line(&[[0.0; 3], [1.0; 3]], f64::NAN)),
    ];
    let geometry = Geometry::new(&scene(items), DVec3::ZERO);
    let runs: Vec<_> = geometry.runs.iter().map(|run| (run.kind, run.on_top, run.quads.clone())).collect();
    assert_eq!(
        runs,
        [(Kind::Stroke, false, 0..2), (Kind::Mark, false, 0..3), (Kind::Stroke, true, 2..3)],
        "neighbours of a kind go together"
    );
}

#[test]
fn surfaces_are_indexed_unless_they_are_flat() {
    let smooth = torus(10, 20);
    let geometry = Geometry::new(&scene(vec![SceneItem::Triangles(smooth.clone())]), DVec3::ZERO);
    assert_eq!((geometry.facets.len(), geometry.indices.len()), (200 * 32, 1200), "vertices are shared");
    assert_eq!(geometry.opaque, 1200, "all hide");
    let (positions, triangles) = (smooth.positions().to_vec(), smooth.triangles().to_vec());
    let flat = Triangles::new(positions.clone(), triangles.clone(), Color::hex(0).with_opacity(0.5)).unwrap();
    let geometry = Geometry::new(&scene(vec![SceneItem::Triangles(flat)]), DVec3::ZERO);
    assert_eq!(
        (geometry.facets.len(), geometry.opaque),
        (1200 * 32, 0),
        "each has its own three; none hides"
    );
    // Corners that run the wrong way are turned round.
    let reversed = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let normals = smooth.normals().to_vec();
    let reversed = Triangles::new(positions, reversed, Color::hex(0)).unwrap().with_normals(normals).unwrap();
    let turned = Geometry::new(&scene(vec![SceneItem::Triangles(reversed)]), DVec3::ZERO);
    assert_eq!(turned.indices[..3], [0, 1, 21], "as in the torus");
}

// ---- The GPU, where there is one

/// The GPU of this machine; `None`, with a message, if there is none.
fn gpu() -> Option<Gpu> {
    let config = WgpuConfiguration::default();
    let instance = pollster::block_on(config.wgpu_setup.new_instance());
    let state = RenderState::create(&config, &instance, None, RendererOptions::default());
    match pollster::block_on(state) {
        Ok(state) => Some(Gpu::new(state).unwrap_or_else(|error| panic!("{error}"))),
        Err(error) => {
            eprintln!("skipped: no graphics adapter ({error})");
            None
        }
    }
}

const WHITE: Color = Color::hex(0xFF_FF_FF);

/// The pixels at 1 pixel per pt over white.
fn drawn(gpu: &mut Gpu, scene: &Scene, version: u64, view: &EyeView) -> Vec<[u8; 4]> {
    drawn_as(gpu, scene, version, view, Quality::Fine)
}

fn drawn_as(gpu: &mut Gpu, scene: &Scene, version: u64, view: &EyeView, quality: Quality) -> Vec<[u8; 4]> {
    let light = Theme::light().light;
    let bounds = scene.bounding_box();
    let order = Order { scene, version, bounds, view, light: &light, ground: WHITE, pixels_per_point: 1.0 };
    gpu.draw(&order, [view.size.x as u32, view.size.y as u32], quality).unwrap();
    gpu.pixels().unwrap()
}

#[test]
fn quick_pictures_look_like_fine_ones() {
    let Some(mut gpu) = gpu() else { return };
    let view = EyeView { eye: Eye::default(), size: DVec2::new(320.0, 240.0) };
    let scene = scene(vec![SceneItem::Triangles(torus(200, 400))]);
    let fine = drawn(&mut gpu, &scene, 1, &view);
    let quick = drawn_as(&mut gpu, &scene, 1, &view, Quality::Quick);
    assert_eq!(gpu.counts, Counts { fillings: 1, drawings: 2 }, "the vertices are the same");
    let differ = |(a, b): &(&[u8; 4], &[u8; 4])| (0..3).any(|k| a[k].abs_diff(b[k]) > 24);
    let share = fine.iter().zip(&quick).filter(differ).count() as f64 / fine.len() as f64;
    assert!(share < 0.05 && fine != quick, "{share} of the pixels differ");
}

#[test]
fn gpu_and_processor_show_the_same() {
    let Some(mut gpu) = gpu() else { return };
    let mut surface = torus(40, 80);
    surface.back_color = Some(Color::hex(0xE0_BC_8A));
    let scene = scene(vec![SceneItem::Triangles(surface)]);
    let view = EyeView { eye: Eye::default(), size: DVec2::new(320.0, 240.0) };
    let inside = EyeState { target: DVec3::X, distance: 0.3, ..EyeState::default() };
    let eyes = [view.eye, view.eye.with_orthographic(true), Eye::new(inside).unwrap()];
    for (number, eye) in eyes.into_iter().enumerate() {
        let view = EyeView { eye, ..view };
        let found = drawn(&mut gpu, &scene, 1, &view);
        let image = Paper { view, light: Theme::light().light, pixels_per_point: 1.0 }.image(&scene).unwrap();
        let over_white = |pixel: &[u8], part: usize| {
            let opacity = f64::from(pixel[3]) / 255.0;
            f64::from(pixel[part]) * opacity + 255.0 * (1.0 - opacity)
        };
        let pairs = found.iter().zip(image.pixels().chunks(4));
        let errors: Vec<f64> = pairs
            .map(|(a, b)| (0..3).map(|k| (f64::from(a[k]) - over_white(b, k)).abs()).fold(0.0, f64::max))
            .collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let wrong = errors.iter().filter(|&&error| error > 40.0).count() as f64 / errors.len() as f64;
        assert!(mean < 2.0 && wrong < 0.01, "eye {number}: mean {mean:.2}, wrong {wrong:.4}");
        assert!(image.pixels().chunks(4).any(|pixel| pixel[3] == 255), "eye {number} sees something");
    }
    assert_eq!((gpu.counts.fillings, gpu.counts.drawings), (1, 3), "buffers are filled once");
    drawn(&mut gpu, &scene, 1, &EyeView { eye: eyes[2], ..view });
    assert_eq!((gpu.counts.fillings, gpu.counts.drawings), (1, 3), "nothing new, nothing drawn");
    drawn(&mut gpu, &scene, 2, &view);
    assert_eq!((gpu.counts.fillings, gpu.counts.drawings), (2, 4), "a new version is read");
}

/// Ink in pixels: 1 for a black pixel on white.
fn ink<'a>(pixels: impl Iterator<Item = &'a [u8; 4]>) -> f64 {
    pixels.map(|pixel| 1.0 - f64::from(pixel[1]) / 255.0).sum()
}

#[test]
fn strokes_have_their_width_and_hide_behind_surfaces() {
    let Some(mut gpu) = gpu() else { return };
    let column = |pixels: &[[u8; 4]], x: usize| ink(pixels.iter().skip(x).step_by(200));
    for orthographic in [true, false] {
        let view = from_above(orthographic);
        let mut version = 0;
        let mut show = |items: Vec<SceneItem>| {
            version += 1;
            drawn(&mut gpu, &scene(items), version, &view)
        };
        for width in [0.5, 1.0, 2.5, 6.0] {
            let pixels = show(vec![SceneItem::Line(line(&[[-3.0, 0.1, 0.0], [3.0, 0.1, 0.0]], width))]);
            let found = column(&pixels, 77);
            assert!((found - width).abs() < 0.03, "{width} pt: {found}");
        }
        let below = line(&[[-1.9, 0.0, -1.0], [1.9, 0.0, -1.0]], 4.0);
        let square = || {
            // White, so that it has no ink.
            let SceneItem::Triangles(square) = square(0.0) else { panic!("a surface") };
            let colors = vec![WHITE; 4];
            SceneItem::Triangles(square.with_colors(colors).unwrap())
        };
        let pixels = show(vec![square(), SceneItem::Line(below.clone())]);
        assert!((column(&pixels, 30) - 4.0).abs() < 0.05, "beside the square");
        assert!(column(&pixels, 100) < 0.01, "behind it");
        let pixels = show(vec![square(), SceneItem::Line(below.on_top())]);
        assert!((column(&pixels, 100) - 4.0).abs() < 0.05, "on top");
        let within = line(&[[-0.8, 0.0, 0.0], [0.8, 0.0, 0.0]], 4.0);
        let pixels = show(vec![square(), SceneItem::Line(within)]);
        assert!((column(&pixels, 100) - 4.0).abs() < 0.05, "within it");
        // A bend of translucent ink is nowhere darker than its arms.
        let mut bend = line(&[[-1.0, -1.0, 0.0], [0.5, -1.0, 0.0], [0.5, 0.7, 0.0]], 12.0);
        bend.stroke.color = Color::hex(0).with_opacity(0.5);
        let pixels = show(vec![SceneItem::Line(bend)]);
        let darkest = pixels.iter().map(|pixel| pixel[1]).min().unwrap();
        assert!((126..=129).contains(&darkest), "{darkest}");
        // From the far end to the outside of the bend: two arms, a round joint, round ends.
        let exact = 0.5 * (12.0 * (75.0 + 85.0) - 36.0 + PI * 36.0 * 0.25 + PI * 36.0);
        let found = ink(pixels.iter());
        assert!((found / exact - 1.0).abs() < 0.01, "{found} of {exact}");
        let mut dashed = line(&[[-1.8, 0.0, 0.0], [1.8, 0.0, 0.0]], 4.0);
        dashed.stroke.dashes = vec![6.0, 3.0];
        let found = ink(show(vec![SceneItem::Line(dashed)]).iter()) / (4.0 * 180.0);
        assert!((found - 2.0 / 3.0).abs() < 0.03, "two thirds of a dashed line are drawn: {found}");
        // What passes the eye is cut.
        let pixels = show(vec![SceneItem::Line(line(&[[0.5, 0.0, -3.0], [0.5, 0.0, 40.0]], 4.0))]);
        let is_seen = ink(pixels.iter()) > 100.0;
        assert_eq!(is_seen, !orthographic, "a line past the eye");
    }
}

#[test]
fn marks_cover_their_area() {
    let Some(mut gpu) = gpu() else { return };
    let size: f64 = 40.0;
    let half = 0.5 * size;
    for (version, (shape, exact)) in [
        (MarkerShape::Disc, PI * half * half),
        (MarkerShape::Square, size * size),
        (MarkerShape::Diamond, size * size),
        (MarkerShape::Triangle, 0.75 * 3.0f64.sqrt() * half * half),
    ]
    .into_iter()
    .enumerate()
    {
        let marks = Points::new(vec![DVec3::ZERO], shape, size, Color::hex(0)).unwrap();
        let scene = scene(vec![SceneItem::Points(marks)]);
        let found = ink(drawn(&mut gpu, &scene, version as u64, &from_above(false)).iter());
        assert!((found / exact - 1.0).abs() < 0.02, "{shape:?}: {found} of {exact}");
    }
}
