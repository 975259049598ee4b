//! What hands do to knots, on the line and on the dial alike: stacked, dragged, snapped together, torn apart, inserted, removed.
//!
//! A drag moves one copy, the top one of a stack; with Shift the whole stack. Neighbours within [`SNAP`] points snap together
//! unless Alt is held. Escape during a drag takes it back. A move that cannot be is pushed back, with its reason at the pointer.

use eframe::egui::{
    Id, Key, PointerButton, Popup, PopupCloseBehavior, Pos2, Rect, Response, Sense, Ui, vec2,
};

use crate::app::knot_line::axis::Axis;
use crate::app::knot_line::dial::Ring;
use crate::app::knot_line::{Scene, actions, note};
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{NumberEvent, NumberField};
use crate::app::number_text::{round_to_step, short};
use crate::core::bspline::SplineSpace;
use crate::document::{Edit, ObjectId};

/// Distance in points within which knots snap together.
const SNAP: f32 = 6.0;

/// Equal knots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stack {
    pub(super) value: f64,
    /// Index of the first copy in the sequence; continued beyond both ends if periodic.
    pub(super) first: isize,
    pub(super) multiplicity: usize,
}

/// The stacks of the knots from `low` to `high`, of a periodic space also in the neighbouring periods.
pub(super) fn stacks(space: &SplineSpace, low: f64, high: f64) -> Vec<Stack> {
    let mut stacks: Vec<Stack> = Vec::new();
    let count = space.knots().len() as isize;
    for index in if space.is_periodic() { -count..2 * count } else { 0..count } {
        let Some(value) = space.knot(index).filter(|value| (low..=high).contains(value)) else { continue };
        match stacks.last_mut() {
            Some(stack) if stack.value >= value => stack.multiplicity += 1,
            _ => stacks.push(Stack { value, first: index, multiplicity: 1 }),
        }
    }
    stacks
}

/// `C²` and so on.
pub(super) fn continuity(degree: usize, multiplicity: usize) -> String {
    format!("C{}", raised(degree.saturating_sub(multiplicity)))
}

/// The digits of `number` as an exponent.
pub(super) fn raised(number: usize) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}', '\u{2078}',
        '\u{2079}',
    ];
    number.to_string().bytes().map(|digit| DIGITS[usize::from(digit - b'0')]).collect()
}

/// Whether the curve passes the knot.
pub(super) fn is_inside(space: &SplineSpace, value: f64) -> bool {
    let (left, right) = space.parameter_interval();
    space.is_periodic() || (left < value && value < right)
}

/// Where knots stand.
#[derive(Clone, Copy, Debug)]
pub(super) enum Track {
    /// On a line.
    Line(Axis),
    /// On a circle.
    Dial(Ring),
}

impl Track {
    /// Length in parameter of one pixel.
    fn per_pixel(&self) -> f64 {
        match self {
            Self::Line(axis) => axis.per_pixel(),
            Self::Dial(ring) => ring.per_pixel(),
        }
    }

    /// The way in parameter of a drag from `press` to `pointer`; a little before it was `way`.
    fn way(&self, press: Pos2, pointer: Pos2, way: f64) -> f64 {
        match self {
            Self::Line(axis) => f64::from(pointer.x - press.x) * axis.per_pixel(),
            Self::Dial(ring) => ring.way(press, pointer, way),
        }
    }
}

/// A drag of knots; all of it refers to the knots at its beginning.
#[derive(Clone, Debug)]
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
    track: Track,
    /// How far the pointer has gone, in parameter.
    way: f64,
    /// Where the moved knot stands now.
    now: f64,
    /// What the move does to the curve.
    effect: Option<String>,
    /// Why the knot does not follow.
    refusal: Option<String>,
}

/// Where a drag wants a knot, and why it does not get there.
struct Target {
    to: f64,
    refusal: Option<String>,
}

impl KnotDrag {
    /// With the pointer, between the neighbours, onto them when close.
    fn target(&self, whole: bool, snap: bool) -> Target {
        let start = self.stack.value;
        let step = self.track.per_pixel();
        let wanted = start + self.way;
        let mut to = round_to_step(wanted, step);
        if snap {
            let torn = self.stack.multiplicity > 1 && !whole;
            let targets = [self.before, self.after, if torn { start } else { f64::NAN }];
            let near = targets.into_iter().filter(|target| (target - wanted).abs() <= f64::from(SNAP) * step);
            if let Some(target) = near.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs())) {
                to = target;
            }
        }
        let passed =
            if to < self.before { Some(self.before) } else { (to > self.after).then_some(self.after) };
        let refusal = passed.map(|knot| format!("Knots keep their order: it cannot pass {}", short(knot)));
        Target { to: to.max(self.before).min(self.after), refusal }
    }
}

fn drag_id(id: Id) -> Id {
    id.with("knot drag")
}

/// The track at the beginning of a running drag.
pub(super) fn frozen(ui: &Ui, id: Id) -> Option<Track> {
    ui.data(|data| data.get_temp::<KnotDrag>(drag_id(id))).map(|drag| drag.track)
}

/// The hand on the knots of one view, for one frame.
#[derive(Debug)]
pub(super) struct Hand {
    id: Id,
    drag: Option<KnotDrag>,
    /// The widget that was held when the frame began, even if the drag ends in this frame.
    held: Option<Id>,
    /// Whether it has been shown.
    shown: bool,
}

impl Hand {
    pub(super) fn take_up(lab: &mut Lab, ui: &Ui, id: Id) -> Self {
        let mut drag: Option<KnotDrag> = ui.data(|data| data.get_temp(drag_id(id)));
        if drag.is_some() && !ui.input(|input| input.pointer.any_down() || input.pointer.any_released()) {
            // The button went up where nobody saw it.
            lab.commit();
            drag = None;
        }
        Self { id, held: drag.as_ref().map(|drag| drag.handle), drag, shown: false }
    }

    /// Whether the knot that is dragged now stands in `stack` and has no handle yet.
    pub(super) fn holds(&self, stack: &Stack) -> bool {
        !self.shown && self.drag.as_ref().is_some_and(|drag| (stack.value - drag.now).abs() <= 0.0)
    }

    /// The widget of `stack`: the pointer keeps the one that it holds, wherever that knot goes.
    pub(super) fn handle_id(&mut self, stack: &Stack) -> Id {
        let own = self.id.with(("knot", stack.first));
        match self.held {
            Some(handle) if self.holds(stack) => {
                self.shown = true;
                handle
            }
            Some(handle) if handle == own => own.with("released"),
            _ => own,
        }
    }

    /// What the mouse does to one stack.
    pub(super) fn touch(
        &mut self,
        lab: &mut Lab,
        ui: &Ui,
        scene: &Scene,
        stack: &Stack,
        response: &Response,
        track: Track,
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
            self.drag = Some(KnotDrag {
                object: scene.object,
                handle: response.id,
                stack: *stack,
                before: neighbour(stack.first - 1, f64::NEG_INFINITY),
                after: neighbour(stack.first + stack.multiplicity as isize, f64::INFINITY),
                press,
                track,
                way: 0.0,
                now: stack.value,
                effect: None,
                refusal: None,
            });
            lab.selection.knot = Some(stack.value);
            lab.selection.points.clear();
            lab.begin(if lab.knots.keep_curve { "Move knot, curve kept" } else { "Move knot" });
        }
        if self.drag.as_ref().is_some_and(|drag| drag.handle == response.id) {
            self.shown = true;
            self.follow(lab, ui, response);
        } else if self.drag.is_none() {
            menu(lab, scene, stack, response);
        }
        if self.drag.is_none() && response.hovered() && !response.context_menu_opened() {
            response.clone().on_hover_text(note::hint(scene, stack));
        }
    }

    /// One frame of a drag.
    fn follow(&mut self, lab: &mut Lab, ui: &Ui, response: &Response) {
        let Some(drag) = &mut self.drag else { return };
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            lab.history.cancel();
            self.drag = None;
            return;
        }
        if response.dragged()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let (shift, alt) = ui.input(|input| (input.modifiers.shift, input.modifiers.alt));
            let whole = shift && drag.stack.multiplicity > 1;
            drag.way = drag.track.way(drag.press, pointer, drag.way);
            let Target { to, refusal } = drag.target(whole, !alt);
            let start = drag.stack.value;
            // At the start a drag amounts to nothing; the document needs an edit that says so.
            let edit = if whole {
                Edit::MoveDistinctKnot { object: drag.object, at: start, to }
            } else {
                let last = drag.stack.first + drag.stack.multiplicity as isize - 1;
                let index = if to > start { last } else { drag.stack.first };
                Edit::MoveKnot { object: drag.object, knot: index.max(0) as usize, to }
            };
            drag.refusal = refusal;
            match lab.history.update(actions::kept(lab, edit)) {
                Ok(outcome) => {
                    lab.shape_note = outcome.shape.sentence();
                    drag.effect = note::effect(&outcome.shape, lab.knots.keep_curve);
                    // A knot that went onto the seam from the left stands at the start of the period.
                    let space = lab.history.document().curve(drag.object).map(|curve| curve.space());
                    drag.now = space.filter(|space| !space.knots().contains(&to)).map_or(to, |space| {
                        let (left, _) = space.parameter_interval();
                        space.reduce(to).map_or(to, |at| if space.knots().contains(&at) { at } else { left })
                    });
                    lab.selection.knot = Some(drag.now);
                }
                // It stays at the last place where it could be.
                Err(error) => drag.refusal = Some(note::reason(&error)),
            }
        }
        if response.drag_stopped() {
            lab.commit();
            self.drag = None;
        }
    }

    /// Ends the frame; `place` tells where a value stands on the screen.
    pub(super) fn put_down(mut self, lab: &mut Lab, ui: &Ui, place: impl Fn(f64) -> Pos2) {
        if let Some((handle, now)) = self.drag.as_ref().map(|drag| (drag.handle, drag.now))
            && !self.shown
        {
            // Out of sight, but the pointer still holds it.
            let rect = Rect::from_center_size(place(now), vec2(2.0, 2.0));
            let response = ui.interact(rect, handle, Sense::click_and_drag());
            self.follow(lab, ui, &response);
        }
        if let Some(drag) = &self.drag {
            if drag.refusal.is_some() {
                note::leash(lab, ui, place(drag.now));
            }
            note::show(lab, ui, drag.object, drag.now, drag.effect.clone(), drag.refusal.clone());
        }
        ui.data_mut(|data| match self.drag {
            Some(drag) => {
                data.insert_temp(drag_id(self.id), drag);
            }
            None => data.remove::<KnotDrag>(drag_id(self.id)),
        });
    }
}

/// A menu with fields: a click into them does not close it.
pub(super) fn context_menu(response: &Response, add: impl FnOnce(&mut Ui)) {
    Popup::context_menu(response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(add);
}

fn menu(lab: &mut Lab, scene: &Scene, stack: &Stack, response: &Response) {
    let object = scene.object;
    let degree = scene.curve.degree();
    let inside = is_inside(scene.curve.space(), stack.value);
    context_menu(response, |ui| {
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
        let apart = ui.add_enabled(
            inside && stack.multiplicity > 1,
            eframe::egui::Button::new("Pull the copies apart"),
        );
        if apart.clicked() {
            actions::pull_apart(lab, stack);
            ui.close();
        }
        ui.horizontal(|ui| {
            ui.label("Move to");
            let field =
                NumberField::new("New value of the knot", stack.value).width(90.0).show(ui, "value of knot");
            if let Some(NumberEvent::Typed { to, .. }) = field.event {
                let edit = actions::kept(lab, Edit::MoveDistinctKnot { object, at: stack.value, to });
                if lab.edit(edit).is_some() {
                    lab.selection.knot = Some(to);
                }
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
