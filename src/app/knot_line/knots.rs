//! The knots on the strip beneath the plot.

use eframe::egui::{
    Align2, CursorIcon, FontId, Id, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2,
    vec2,
};

use crate::app::knot_line::Scene;
use crate::app::knot_line::hand::{Hand, Stack, Track, continuity, is_inside, stacks};
use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::short;
use crate::app::painter::color32;
use crate::core::bspline::SplineSpace;

/// Knots that stand closer than this, in points, are ticks without a handle.
const CLOSEST_HANDLES: f32 = 6.0;

/// Shows the knots on the strip beneath the plot. Returns whether one is held.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, id: Id, scene: &Scene) -> bool {
    let mut hand = Hand::take_up(ui, id);
    let mut last_x = f32::NEG_INFINITY;
    let mut last_tick = f32::NEG_INFINITY;
    let mut label_end = f32::NEG_INFINITY;
    let (low, high) = scene.axis.visible();
    for stack in &stacks(scene.curve.space(), low, high) {
        let x = scene.axis.x(stack.value);
        if x < scene.strip.left() - 1.0 || x > scene.strip.right() + 1.0 {
            continue;
        }
        if x - last_x < CLOSEST_HANDLES && !hand.holds(stack) {
            if x - last_tick >= 1.5 {
                last_tick = x;
                ui.painter().vline(x, scene.plot.bottom()..=scene.plot.bottom() + 6.0, tick(lab));
            }
            continue;
        }
        last_x = x;
        let ghost = is_ghost(scene.curve.space(), stack.first);
        let response = (!ghost).then(|| handle(ui, scene, stack, x, id.with(("knot", stack.first))));
        paint(lab, ui, scene, stack, x, ghost, response.as_ref(), &mut label_end);
        if let Some(response) = response {
            hand.touch(lab, scene, stack, &response, Track::Line(scene.axis));
        }
    }
    let (strip, row) = (scene.strip, scene.plot.bottom() + 5.0);
    hand.put_down(lab, ui, |value| pos2(scene.axis.x(value).clamp(strip.left(), strip.right()), row))
}

/// Whether the stack belongs to a neighbouring period.
pub(super) fn is_ghost(space: &SplineSpace, index: isize) -> bool {
    space.is_periodic() && !(0..space.knots().len() as isize).contains(&index)
}

fn tick(lab: &Lab) -> Stroke {
    Stroke::new(1.0, color32(lab.theme.axis))
}

/// Distance between the markers of a stack.
fn pitch(stack: &Stack) -> f32 {
    (27.0 / stack.multiplicity as f32).min(8.0)
}

fn marker_place(scene: &Scene, stack: &Stack, x: f32, copy: usize) -> Pos2 {
    pos2(x, scene.plot.bottom() + 5.0 + pitch(stack) * copy as f32)
}

fn handle(ui: &Ui, scene: &Scene, stack: &Stack, x: f32, id: Id) -> Response {
    let bottom = marker_place(scene, stack, x, stack.multiplicity - 1).y + 6.0;
    let rect = Rect::from_min_max(pos2(x - 6.0, scene.plot.bottom() - 3.0), pos2(x + 6.0, bottom));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, spoken(stack)));
    response.on_hover_cursor(CursorIcon::ResizeHorizontal)
}

/// `Knot 2, 3 copies`.
pub(super) fn spoken(stack: &Stack) -> String {
    let times =
        if stack.multiplicity > 1 { format!(", {} copies", stack.multiplicity) } else { String::new() };
    format!("Knot {}{times}", short(stack.value))
}

/// A diamond.
pub(super) fn marker(center: Pos2, half: f32, fill: eframe::egui::Color32, rim: Stroke) -> Shape {
    let corners = [(0.0, -half), (half, 0.0), (0.0, half), (-half, 0.0)];
    Shape::convex_polygon(corners.iter().map(|&(dx, dy)| center + vec2(dx, dy)).collect(), fill, rim)
}

/// Whether the knot is selected, and whether something lights it up.
pub(super) fn is_marked(lab: &Lab, scene: &Scene, stack: &Stack) -> (bool, bool) {
    let same = |value: f64| (value - stack.value).abs() <= 0.0;
    let lit = matches!(lab.hovered, Hovered::Knot(object, value) if object == scene.object && same(value));
    (lab.selection.knot.is_some_and(same), lit)
}

#[expect(clippy::too_many_arguments, reason = "one marker with everything that decides how it looks")]
fn paint(
    lab: &Lab,
    ui: &Ui,
    scene: &Scene,
    stack: &Stack,
    x: f32,
    ghost: bool,
    response: Option<&Response>,
    label_end: &mut f32,
) {
    let theme = &lab.theme;
    let space = scene.curve.space();
    let (selected, lit) = is_marked(lab, scene, stack);
    let marked = (selected && !ghost) || lit;
    let (left, right) = space.parameter_interval();
    let outside = stack.value < left || stack.value > right;
    let ink = if marked { color32(theme.selection) } else { color32(theme.text) };
    let ink = if ghost || outside { ink.gamma_multiply(0.5) } else { ink };
    let painter = ui.painter_at(scene.plot.union(scene.strip).expand2(vec2(8.0, 0.0)));
    if !outside && !ghost {
        let pen = Stroke::new(1.0, if marked { ink } else { color32(theme.grid_major) });
        painter.vline(x, scene.plot.y_range(), pen);
    }
    let ground = color32(theme.panel);
    for copy in (0..stack.multiplicity).rev() {
        let half = if marked { 5.0 } else { 4.0 };
        let (fill, rim) =
            if ghost || outside { (ground, Stroke::new(1.2, ink)) } else { (ink, Stroke::new(1.0, ground)) };
        painter.add(marker(marker_place(scene, stack, x, copy), half, fill, rim));
    }
    let mut text = short(stack.value);
    let inside = is_inside(space, stack.value);
    let font = FontId::proportional(10.0 * theme.text_scale as f32);
    let roomy = response.is_some_and(Response::hovered) || x - *label_end > 34.0;
    if stack.multiplicity > 1 && roomy && !ghost {
        text = format!("{text} ({}\u{d7})", stack.multiplicity);
    }
    if inside && !ghost && roomy {
        text = format!("{text} \u{b7} {}", continuity(space.degree(), stack.multiplicity));
    }
    let muted = if marked { ink } else { color32(theme.muted_text) };
    let galley = painter.layout_no_wrap(text, font, if ghost { muted.gamma_multiply(0.5) } else { muted });
    let half = 0.5 * galley.size().x;
    let center = x.clamp(
        scene.strip.left() + half - 2.0,
        (scene.strip.right() - half + 2.0).max(scene.strip.left() + half),
    );
    if center - half > *label_end + 4.0 {
        let at = Align2::CENTER_BOTTOM.anchor_size(pos2(center, scene.strip.bottom()), galley.size()).min;
        painter.galley(at, galley, muted);
        *label_end = center + half;
    }
}
