//! The knots: stacked by multiplicity, dragged, snapped together, torn apart.
//!
//! A drag moves one copy, the top one of a stack; with Shift the whole stack. Neighbours within [`SNAP`] points snap
//! together unless Alt is held. Escape during a drag takes it back.

use eframe::egui::{
    Align2, CursorIcon, FontId, Id, Key, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

use crate::app::knot_line::Scene;
use crate::app::knot_line::axis::Axis;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{NumberEvent, NumberField};
use crate::app::number_text::{round_to_step, short};
use crate::app::painter::color32;
use crate::core::bspline::SplineSpace;
use crate::document::{Edit, ObjectId};

/// Distance in points within which knots snap together.
const SNAP: f32 = 6.0;

/// Knots that stand closer than this, in points, are ticks without a handle.
const CLOSEST_HANDLES: f32 = 6.0;

/// Equal knots on the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stack {
    value: f64,
    /// Index of the first copy in the sequence; continued beyond both ends if periodic.
    first: isize,
    multiplicity: usize,
}

/// A drag of knots; all of it refers to the knots at its beginning.
#[derive(Clone, Copy, Debug)]
struct KnotDrag {
    object: ObjectId,
    /// The widget that the pointer holds.
    handle: Id,
    stack: Stack,
    /// Values of the distinct knots before and after, infinite if there is none.
    before: f64,
    after: f64,
    /// Where the pointer went down.
    press: Pos2,
    axis: Axis,
    /// Where the moved knot stands now.
    now: f64,
}

fn drag_id(id: Id) -> Id {
    id.with("knot drag")
}

/// The axis at the beginning of a running drag.
pub(super) fn frozen_axis(ui: &Ui, id: Id) -> Option<Axis> {
    ui.data(|data| data.get_temp::<KnotDrag>(drag_id(id))).map(|drag| drag.axis)
}

/// Shows the knots on the strip beneath the plot.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, id: Id, scene: &Scene) {
    let mut drag: Option<KnotDrag> = ui.data(|data| data.get_temp(drag_id(id)));
    if drag.is_some() && !ui.input(|input| input.pointer.any_down() || input.pointer.any_released()) {
        // The button went up where nobody saw it.
        lab.commit();
        drag = None;
    }
    let mut last_x = f32::NEG_INFINITY;
    let mut last_tick = f32::NEG_INFINITY;
    let mut label_end = f32::NEG_INFINITY;
    let mut drag_is_shown = false;
    let stacks = visible_stacks(scene);
    for stack in &stacks {
        let x = scene.axis.x(stack.value);
        if x < scene.strip.left() - 1.0 || x > scene.strip.right() + 1.0 {
            continue;
        }
        let held = drag.is_some_and(|drag| (stack.value - drag.now).abs() <= 0.0) && !drag_is_shown;
        if x - last_x < CLOSEST_HANDLES && !held {
            if x - last_tick >= 1.5 {
                last_tick = x;
                ui.painter().vline(x, scene.plot.bottom()..=scene.plot.bottom() + 6.0, tick(lab));
            }
            continue;
        }
        last_x = x;
        let ghost = is_ghost(scene.curve.space(), stack.first);
        let handle_id = match drag {
            Some(drag) if held => drag.handle,
            _ => {
                let own = id.with(("knot", stack.first));
                if drag.is_some_and(|drag| drag.handle == own) { own.with("released") } else { own }
            }
        };
        drag_is_shown |= held;
        let response = (!ghost).then(|| handle(ui, scene, stack, x, handle_id));
        paint(lab, ui, scene, stack, x, ghost, response.as_ref(), &mut label_end);
        if let Some(response) = response {
            react(lab, ui, scene, stack, &response, &mut drag);
            drag_is_shown |= drag.is_some_and(|drag| drag.handle == response.id);
        }
    }
    if let Some(KnotDrag { handle, now, .. }) = drag
        && !drag_is_shown
    {
        // Out of sight, but the pointer still holds it.
        let at =
            pos2(scene.axis.x(now).clamp(scene.strip.left(), scene.strip.right()), scene.strip.center().y);
        let response =
            ui.interact(Rect::from_center_size(at, vec2(2.0, 2.0)), handle, Sense::click_and_drag());
        follow(lab, ui, &response, &mut drag);
    }
    ui.data_mut(|data| match drag {
        Some(drag) => {
            data.insert_temp(drag_id(id), drag);
        }
        None => data.remove::<KnotDrag>(drag_id(id)),
    });
}

/// The distinct knots on the axis; of a periodic space also the neighbouring periods.
fn visible_stacks(scene: &Scene) -> Vec<Stack> {
    let space = scene.curve.space();
    let (low, high) = scene.axis.visible();
    let mut stacks: Vec<Stack> = Vec::new();
    let mut add = |index: isize, value: f64| match stacks.last_mut() {
        Some(stack) if stack.value >= value => stack.multiplicity += 1,
        _ => stacks.push(Stack { value, first: index, multiplicity: 1 }),
    };
    let count = space.knots().len() as isize;
    let range = if space.is_periodic() { -count..2 * count } else { 0..count };
    for index in range {
        if let Some(value) = space.knot(index)
            && value >= low
            && value <= high
        {
            add(index, value);
        }
    }
    stacks
}

fn is_ghost(space: &SplineSpace, index: isize) -> bool {
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

/// `C²` and so on.
fn continuity(degree: usize, multiplicity: usize) -> String {
    let order = degree.saturating_sub(multiplicity);
    let digits = order.to_string();
    let raised = digits.chars().filter_map(|digit| {
        let index = digit.to_digit(10)? as usize;
        [
            '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}',
            '\u{2078}', '\u{2079}',
        ]
        .get(index)
        .copied()
    });
    std::iter::once('C').chain(raised).collect()
}

fn is_inside(space: &SplineSpace, value: f64) -> bool {
    let (left, right) = space.parameter_interval();
    space.is_periodic() || (left < value && value < right)
}

fn handle(ui: &Ui, scene: &Scene, stack: &Stack, x: f32, id: Id) -> Response {
    let bottom = marker_place(scene, stack, x, stack.multiplicity - 1).y + 6.0;
    let rect = Rect::from_min_max(pos2(x - 6.0, scene.plot.bottom() - 3.0), pos2(x + 6.0, bottom));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let times =
        if stack.multiplicity > 1 { format!(", {} copies", stack.multiplicity) } else { String::new() };
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Slider, true, format!("Knot {}{times}", short(stack.value)))
    });
    response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal)
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
    let same = |value: f64| (value - stack.value).abs() <= 0.0;
    let selected = lab.selection.knot.is_some_and(same) && !ghost;
    let lit = matches!(lab.hovered, Hovered::Knot(object, value) if object == scene.object && same(value));
    let (left, right) = space.parameter_interval();
    let outside = stack.value < left || stack.value > right;
    let ink = if selected || lit { color32(theme.selection) } else { color32(theme.text) };
    let ink = if ghost || outside { ink.gamma_multiply(0.5) } else { ink };
    let painter = ui.painter_at(scene.plot.union(scene.strip).expand2(vec2(8.0, 0.0)));
    if !outside && !ghost {
        let pen = Stroke::new(1.0, if selected || lit { ink } else { color32(theme.grid_major) });
        painter.vline(x, scene.plot.y_range(), pen);
    }
    for copy in (0..stack.multiplicity).rev() {
        let center = marker_place(scene, stack, x, copy);
        let half = if lit || selected { 5.0 } else { 4.0 };
        let corners = [(0.0, -half), (half, 0.0), (0.0, half), (-half, 0.0)];
        let corners = corners.iter().map(|&(dx, dy)| center + vec2(dx, dy)).collect();
        let ground = color32(theme.panel);
        let fill = if ghost || outside { ground } else { ink };
        let rim = if ghost || outside { Stroke::new(1.2, ink) } else { Stroke::new(1.0, ground) };
        painter.add(Shape::convex_polygon(corners, fill, rim));
    }
    let mut text = short(stack.value);
    let inside = is_inside(space, stack.value);
    let font = FontId::proportional(10.0 * theme.text_scale as f32);
    let roomy = response.is_some_and(Response::hovered) || x - *label_end > 34.0;
    if inside && !ghost && roomy {
        text = format!("{text} \u{b7} {}", continuity(space.degree(), stack.multiplicity));
    }
    let muted = if selected || lit { ink } else { color32(theme.muted_text) };
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

/// What the mouse does to one stack.
fn react(
    lab: &mut Lab,
    ui: &Ui,
    scene: &Scene,
    stack: &Stack,
    response: &Response,
    drag: &mut Option<KnotDrag>,
) {
    if response.hovered() {
        lab.hovering = Hovered::Knot(scene.object, stack.value);
    }
    if response.clicked() {
        lab.selection.knot = Some(stack.value);
        lab.selection.points.clear();
    }
    if response.drag_started_by(PointerButton::Primary)
        && let Some(press) = ui.input(|input| input.pointer.press_origin())
    {
        let space = scene.curve.space();
        let neighbour = |index: isize, none: f64| space.knot(index).unwrap_or(none);
        *drag = Some(KnotDrag {
            object: scene.object,
            handle: response.id,
            stack: *stack,
            before: neighbour(stack.first - 1, f64::NEG_INFINITY),
            after: neighbour(stack.first + stack.multiplicity as isize, f64::INFINITY),
            press,
            axis: scene.axis,
            now: stack.value,
        });
        lab.selection.knot = Some(stack.value);
        lab.selection.points.clear();
        lab.begin("Move knot");
    }
    if drag.is_some_and(|drag| drag.handle == response.id) {
        follow(lab, ui, response, drag);
    }
    let inside = is_inside(scene.curve.space(), stack.value);
    if drag.is_none() && response.hovered() {
        let what = if inside {
            let order = continuity(scene.curve.degree(), stack.multiplicity);
            format!(
                "Knot {}, multiplicity {}: the curve is {order} here",
                short(stack.value),
                stack.multiplicity
            )
        } else {
            format!("Knot {}, multiplicity {}", short(stack.value), stack.multiplicity)
        };
        let hands = "Drag: move one copy; Shift: the whole stack; Alt: without snapping";
        response.clone().on_hover_text(format!("{what}\n{hands}"));
    }
    menu(lab, scene, stack, response, inside);
}

/// One frame of a drag.
fn follow(lab: &mut Lab, ui: &Ui, response: &Response, slot: &mut Option<KnotDrag>) {
    let Some(drag) = slot else { return };
    if ui.input(|input| input.key_pressed(Key::Escape)) {
        lab.history.cancel();
        *slot = None;
        return;
    }
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let (shift, alt) = ui.input(|input| (input.modifiers.shift, input.modifiers.alt));
        let to = drag_target(drag, pointer, shift, !alt);
        let start = drag.stack.value;
        // At the start a drag amounts to nothing; the document needs an edit that says so.
        let edit = if shift && drag.stack.multiplicity > 1 {
            Edit::MoveDistinctKnot { object: drag.object, at: start, to }
        } else {
            let last = drag.stack.first + drag.stack.multiplicity as isize - 1;
            let index = if to > start { last } else { drag.stack.first };
            Edit::MoveKnot { object: drag.object, knot: index.max(0) as usize, to }
        };
        lab.update(edit);
        let stands = |value: f64| lab.curve().is_some_and(|curve| curve.space().multiplicity(value) > 0);
        if stands(to) {
            drag.now = to;
            lab.selection.knot = Some(to);
        }
    }
    if response.drag_stopped() {
        lab.commit();
        *slot = None;
    }
}

/// Where the dragged knot goes: with the pointer, between its neighbours, onto them when close.
fn drag_target(drag: &KnotDrag, pointer: Pos2, whole: bool, snap: bool) -> f64 {
    let start = drag.stack.value;
    let step = drag.axis.per_pixel();
    let wanted = start + f64::from(pointer.x - drag.press.x) * step;
    let mut to = round_to_step(wanted, step);
    if snap {
        let torn = drag.stack.multiplicity > 1 && !whole;
        let targets = [drag.before, drag.after, if torn { start } else { f64::NAN }];
        let near = targets.into_iter().filter(|target| (target - wanted).abs() <= f64::from(SNAP) * step);
        if let Some(target) = near.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs())) {
            to = target;
        }
    }
    to.max(drag.before).min(drag.after)
}

fn menu(lab: &mut Lab, scene: &Scene, stack: &Stack, response: &Response, inside: bool) {
    let object = scene.object;
    let degree = scene.curve.degree();
    response.context_menu(|ui| {
        ui.set_min_width(170.0);
        ui.label(format!("Knot {}", short(stack.value)));
        let more = inside && stack.multiplicity < degree;
        if ui.add_enabled(more, eframe::egui::Button::new("One copy more")).clicked() {
            lab.edit(Edit::InsertKnot { object, at: stack.value });
            ui.close();
        }
        let remove = if stack.multiplicity > 1 { "Remove one copy" } else { "Remove" };
        if ui.add_enabled(inside, eframe::egui::Button::new(remove)).clicked() {
            lab.edit(Edit::RemoveKnot { object, at: stack.value });
            ui.close();
        }
        ui.horizontal(|ui| {
            ui.label("Move to");
            let field =
                NumberField::new("New value of the knot", stack.value).width(90.0).show(ui, "value of knot");
            if let Some(NumberEvent::Typed { to, .. }) = field.event {
                lab.edit(Edit::MoveDistinctKnot { object, at: stack.value, to });
                lab.selection.knot = Some(to);
                ui.close();
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn continuity_is_degree_minus_multiplicity() {
        assert_eq!(continuity(3, 1), "C\u{b2}", "a simple knot of a cubic");
        assert_eq!(continuity(12, 1), "C\u{b9}\u{b9}", "a simple knot of degree 12");
        assert_eq!(continuity(3, 3), "C\u{2070}", "a triple knot of a cubic");
    }
}
