//! The dial of a closed curve: one period as a circle, run through clockwise, with the same hands as on the line.
//!
//! The parameter 0 stands at the top, whatever the seam is, so that nothing turns when the seam moves. Stacks grow outwards; the B-splines
//! stand on the circle and point inwards.

use std::f64::consts::TAU;

use eframe::egui::{
    Align2, CursorIcon, FontId, Id, PointerButton, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, Vec2,
    WidgetInfo, vec2,
};

use crate::app::knot_line::hand::{Hand, Stack, Track, continuity, stacks};
use crate::app::knot_line::{Scene, basis, knots, plot};
use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::{compact, round_to_step, short};
use crate::app::painter::color32;

/// Room above and below the circle for stacks and labels, in points; beside it labels need more.
const MARGIN: f32 = 22.0;
const MARGIN_BESIDE: f32 = 46.0;

/// Height of a function of value 1 as a share of the radius.
const HEIGHT: f32 = 0.42;

/// More functions than this would be a grey ring; they are left to the line.
const MOST_FUNCTIONS: usize = 60;

/// From this radius on every knot tells how smooth the curve is there.
const ROOMY: f32 = 70.0;

/// Where the hand of t is held, as a share of the radius.
const KNOB: f32 = 0.56;

/// A function is under the pointer within this distance in points.
const REACH: f32 = 5.0;

/// Knots closer than this, in points, are ticks without a handle.
const CLOSEST_HANDLES: f32 = 7.0;

/// The circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    center: Pos2,
    radius: f32,
    period: f64,
}

impl Ring {
    /// Length in parameter of one pixel.
    pub(super) fn per_pixel(&self) -> f64 {
        self.period / (TAU * f64::from(self.radius).max(1.0))
    }

    /// The direction of a parameter, from the middle.
    fn direction(&self, parameter: f64) -> Vec2 {
        let angle = TAU * (parameter / self.period).rem_euclid(1.0);
        vec2(angle.sin() as f32, -angle.cos() as f32)
    }

    fn place(&self, parameter: f64, distance: f32) -> Pos2 {
        self.center + self.direction(parameter) * distance
    }

    /// The parameter in `[0, T)` in the direction of `at`.
    fn parameter(&self, at: Pos2) -> f64 {
        let d = at - self.center;
        let angle = f64::from(d.x).atan2(-f64::from(d.y));
        self.period * (angle / TAU).rem_euclid(1.0)
    }

    /// The way from `press` to `pointer`: of those that differ by periods the one next to `way`.
    pub(super) fn way(&self, press: Pos2, pointer: Pos2, way: f64) -> f64 {
        let turn = self.parameter(pointer) - self.parameter(press);
        turn + self.period * ((way - turn) / self.period).round()
    }
}

/// Width of the dial in a knot line of `size`; 0 where there is no room or the curve is open.
pub(super) fn width(size: Vec2, periodic: bool) -> f32 {
    let side = (size.y + 2.0 * (MARGIN_BESIDE - MARGIN)).min(0.4 * size.x);
    if periodic && size.y >= 90.0 && size.x >= 380.0 { side } else { 0.0 }
}

/// Shows the dial in `rect`.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, id: Id, scene: &Scene, rect: Rect) {
    let Some(period) = scene.curve.space().period() else { return };
    let id = id.with("dial");
    let radius = (0.5 * rect.height() - MARGIN).min(0.5 * rect.width() - MARGIN_BESIDE);
    let ring = Ring { center: rect.center(), radius, period };
    let response = ui.interact(rect, id, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Dial of knots"));
    functions(lab, ui, scene, &ring);
    ground(lab, ui, scene, &ring);
    hand_of_t(lab, ui, id, scene, &ring);

    let mut hand = Hand::take_up(ui, id);
    let (left, right) = scene.curve.space().parameter_interval();
    let mut last = f64::NEG_INFINITY;
    let mut last_label = f64::NEG_INFINITY;
    let mut last_tick = f64::NEG_INFINITY;
    for stack in stacks(scene.curve.space(), left, right) {
        if knots::is_ghost(scene.curve.space(), stack.first) {
            continue;
        }
        let apart = (stack.value - last) / ring.per_pixel();
        if apart < f64::from(CLOSEST_HANDLES) && !hand.holds(&stack) {
            if (stack.value - last_tick) / ring.per_pixel() < 1.5 {
                continue;
            }
            last_tick = stack.value;
            let ends =
                [ring.place(stack.value, ring.radius - 3.0), ring.place(stack.value, ring.radius + 3.0)];
            ui.painter().line_segment(ends, Stroke::new(1.0, color32(lab.theme.axis)));
            continue;
        }
        last = stack.value;
        let copies = stack.multiplicity as f32;
        let near = ring.place(stack.value, ring.radius);
        let far = ring.place(stack.value, ring.radius + pitch(&stack) * (copies - 1.0));
        let handle = ui.interact(
            Rect::from_two_pos(near, far).expand(5.5),
            id.with(("knot", stack.first)),
            Sense::click_and_drag(),
        );
        handle.widget_info(|| {
            WidgetInfo::labeled(Role::Slider, true, format!("{} on the dial", knots::spoken(&stack)))
        });
        let handle = handle.on_hover_cursor(CursorIcon::Grab);
        let labelled = (stack.value - last_label) / ring.per_pixel() > 24.0
            && (left + period - stack.value > 24.0 * ring.per_pixel() || stack.value <= left);
        if labelled {
            last_label = stack.value;
        }
        paint(lab, ui, scene, &stack, &ring, labelled || handle.hovered());
        hand.touch(lab, scene, &stack, &handle, Track::Dial(ring));
    }
    let held = hand.put_down(lab, ui, |value| ring.place(value, ring.radius));
    if !held {
        ground_hands(lab, ui, scene, &ring, &response);
    }
}

fn pitch(stack: &Stack) -> f32 {
    (16.0 / stack.multiplicity as f32).min(7.0)
}

/// The circle, the seam and the period.
fn ground(lab: &Lab, ui: &Ui, scene: &Scene, ring: &Ring) {
    let theme = &lab.theme;
    let painter = ui.painter();
    let scale = theme.stroke_scale as f32;
    painter.circle_stroke(ring.center, ring.radius, Stroke::new(1.4 * scale, color32(theme.axis)));
    let (left, _) = scene.curve.space().parameter_interval();
    let along = ring.direction(left).rot90() * 2.0;
    for side in [-1.0, 1.0] {
        let ends = [0.80, 1.0].map(|share| ring.place(left, ring.radius * share) + along * side);
        painter.line_segment(ends, Stroke::new(1.2 * scale, color32(theme.text)));
    }
    // Which way round.
    let tip = ring.place(left + 0.055 * ring.period, 0.72 * ring.radius);
    let tail: Vec<Pos2> = (0..=6)
        .map(|i| ring.place(left + 0.055 * ring.period * f64::from(i) / 6.0, 0.72 * ring.radius))
        .collect();
    let pen = Stroke::new(1.0, color32(theme.muted_text));
    if ring.radius > 40.0 {
        let forward = ring.direction(left + 0.055 * ring.period).rot90() * -1.0;
        let outward = ring.direction(left + 0.055 * ring.period);
        painter.add(Shape::line(tail, pen));
        for side in [-1.0, 1.0] {
            painter.line_segment([tip, tip + forward * -4.0 + outward * (3.0 * side)], pen);
        }
    }
    let font = FontId::proportional(10.0 * theme.text_scale as f32);
    let text = format!("T = {}\nseam {}", compact(ring.period), compact(left));
    let galley = painter.layout(text, font, color32(theme.muted_text), 2.0 * ring.radius);
    if galley.size().x < ring.radius {
        let place = Align2::CENTER_CENTER.anchor_size(ring.center, galley.size());
        painter.galley(place.min, galley, color32(theme.muted_text));
    }
}

/// The B-splines, standing on the circle and pointing inwards.
fn functions(lab: &Lab, ui: &Ui, scene: &Scene, ring: &Ring) {
    let painter = ui.painter();
    let any_lit = scene.any_lit(lab);
    let step = 2.5 * ring.per_pixel();
    let (left, _) = scene.curve.space().parameter_interval();
    let count = scene.curve.points().len();
    if count > MOST_FUNCTIONS {
        return;
    }
    let mut lines: Vec<Vec<Pos2>> = vec![Vec::new(); count];
    let samples = (ring.period / step).ceil().clamp(32.0, 720.0) as usize;
    let mut pieces: Vec<(usize, Vec<Pos2>)> = Vec::new();
    for i in 0..=samples {
        let t = left + ring.period * (i as f64 / samples as f64);
        let active = basis::active(scene.curve, t);
        let mut seen = vec![false; count];
        for (&k, &value) in active.coefficients.iter().zip(&active.values) {
            if !seen[k] {
                seen[k] = true;
                lines[k].push(ring.place(t, ring.radius * (1.0 - HEIGHT * value as f32)));
            }
        }
        for k in 0..count {
            if !seen[k] && !lines[k].is_empty() {
                pieces.push((k, std::mem::take(&mut lines[k])));
            }
        }
    }
    pieces.extend(lines.into_iter().enumerate().filter(|(_, line)| !line.is_empty()));
    for (k, line) in pieces {
        let lit = scene.is_lit(lab, k) || lab.selection.points.contains(&k);
        let opacity = match (any_lit && !lit, scene.active.coefficients.contains(&k)) {
            (true, _) => 0.25,
            (false, true) => 1.0,
            (false, false) => 0.5,
        };
        let width = if lit { 2.4 } else { 1.2 } * lab.theme.stroke_scale as f32;
        painter.add(Shape::line(line, Stroke::new(width, Scene::color(lab, k).gamma_multiply(opacity))));
    }
}

/// The hand that shows t, with its handle.
fn hand_of_t(lab: &mut Lab, ui: &Ui, id: Id, scene: &Scene, ring: &Ring) {
    let accent = color32(lab.theme.accent);
    let knob = ring.place(scene.t, KNOB * ring.radius);
    let response = ui.interact(
        Rect::from_center_size(knob, vec2(14.0, 14.0)),
        id.with("cursor of t"),
        Sense::click_and_drag(),
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Cursor of t on the dial"));
    if response.dragged_by(PointerButton::Primary)
        && !scene.busy
        && let Some(pointer) = response.interact_pointer_pos()
    {
        set_parameter(lab, scene, ring.parameter(pointer));
    }
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    let painter = ui.painter();
    let width = 1.4 * lab.theme.stroke_scale as f32;
    painter.line_segment([knob, ring.place(scene.t, ring.radius)], Stroke::new(width, accent));
    painter.circle_filled(knob, if response.hovered() || response.dragged() { 5.0 } else { 3.8 }, accent);
    if let Hovered::Curve(object, t) = lab.hovered
        && object == scene.object
    {
        let ends = [ring.place(t, (1.0 - HEIGHT) * ring.radius), ring.place(t, ring.radius + 4.0)];
        painter.line_segment(ends, Stroke::new(1.0, accent.gamma_multiply(0.6)));
    }
}

/// The control point whose function runs through `at`.
fn function_at(scene: &Scene, ring: &Ring, at: Pos2) -> Option<usize> {
    if scene.curve.points().len() > MOST_FUNCTIONS {
        return None;
    }
    let active = basis::active(scene.curve, inside(scene, ring.parameter(at)));
    let from_center = at.distance(ring.center);
    let distance = |value: f64| (ring.radius * (1.0 - HEIGHT * value as f32) - from_center).abs();
    let values = active.coefficients.iter().zip(&active.values);
    values
        .filter(|&(_, &value)| value > 0.05 && distance(value) <= REACH)
        .min_by(|a, b| distance(*a.1).total_cmp(&distance(*b.1)))
        .map(|(&k, _)| k)
}

/// What can be done with the mouse beside the knots: a function, t, a new knot, the menu.
fn ground_hands(lab: &mut Lab, ui: &Ui, scene: &Scene, ring: &Ring, response: &eframe::egui::Response) {
    let reaches = |at: &Pos2| at.distance(ring.center) > 0.2 * ring.radius;
    let over = response.hover_pos().filter(|_| response.hovered()).filter(reaches);
    let near = over.and_then(|pointer| function_at(scene, ring, pointer));
    if let Some(pointer) = over {
        lab.hovering = near
            .map_or(Hovered::Curve(scene.object, inside(scene, ring.parameter(pointer))), |k| {
                Hovered::Point(scene.object, k)
            });
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(reaches) {
        let parameter = inside(scene, ring.parameter(pointer));
        if response.double_clicked() {
            plot::insert(lab, scene, round_to_step(parameter, ring.per_pixel()));
        } else if let Some(k) = near.filter(|_| response.clicked()) {
            plot::choose(lab, ui, k);
        } else if response.clicked() || response.dragged_by(PointerButton::Primary) {
            set_parameter(lab, scene, parameter);
        }
        plot::note_menu_place(ui, response, round_to_step(parameter, ring.per_pixel()));
    }
    plot::menu(lab, scene, response);
}

fn inside(scene: &Scene, parameter: f64) -> f64 {
    scene.curve.space().reduce(parameter).unwrap_or(parameter)
}

fn set_parameter(lab: &mut Lab, scene: &Scene, parameter: f64) {
    lab.set_parameter(scene.object, inside(scene, parameter));
}

fn paint(lab: &Lab, ui: &Ui, scene: &Scene, stack: &Stack, ring: &Ring, labelled: bool) {
    let theme = &lab.theme;
    let (selected, lit) = knots::is_marked(lab, scene, stack);
    let marked = selected || lit;
    let ink = color32(if marked { theme.selection } else { theme.text });
    let painter = ui.painter();
    for copy in (0..stack.multiplicity).rev() {
        let at = ring.place(stack.value, ring.radius + pitch(stack) * copy as f32);
        let rim = Stroke::new(1.0, color32(theme.panel));
        painter.add(knots::marker(at, if marked { 5.0 } else { 4.0 }, ink, rim));
    }
    if !labelled {
        return;
    }
    let mut text = short(stack.value);
    if stack.multiplicity > 1 || marked || ring.radius > ROOMY {
        text = format!("{text} \u{b7} {}", continuity(scene.curve.degree(), stack.multiplicity));
    }
    let font = FontId::proportional(9.5 * theme.text_scale as f32);
    let ink = if marked { ink } else { color32(theme.muted_text) };
    let galley = painter.layout_no_wrap(text, font, ink);
    let out = ring.direction(stack.value);
    let half = galley.size() * 0.5;
    // So far out that the box of the text just clears the stack.
    let clear =
        7.0 + pitch(stack) * (stack.multiplicity - 1) as f32 + (out.x.abs() * half.x + out.y.abs() * half.y);
    let at = ring.center + out * (ring.radius + clear);
    painter.galley(at - half, galley, ink);
}
