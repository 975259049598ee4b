//! What hands do to knots, on the line and on the dial alike: stacked, dragged, snapped together, torn apart, inserted, removed.
//!
//! A drag moves one copy, the top one of a stack; with Shift the whole stack. Neighbours within [`SNAP`] points snap together
//! unless Alt is held. Escape during a drag takes it back. A move that cannot be is pushed back, with its reason at the pointer.

use eframe::egui::{CursorIcon, Id, Key, Popup, PopupCloseBehavior, Pos2, Response, Ui};

use crate::app::hands::{DEAD_ZONE, pressed_at};
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

/// A press on knots, and the drag that becomes of it; all of it refers to the knots at its beginning.
#[derive(Clone, Debug)]
struct KnotDrag {
    object: ObjectId,
    stack: Stack,
    /// Values of the distinct knots before and after, infinite if there is none.
    before: f64,
    after: f64,
    /// Where the pointer went down.
    press: Pos2,
    track: Track,
    /// Whether the pointer has gone far enough to mean a drag.
    started: bool,
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
///
/// It looks at the pointer itself: in a slow frame the pointer has left the handle before a widget hears of the press.
#[derive(Debug)]
pub(super) struct Hand {
    id: Id,
    drag: Option<KnotDrag>,
    /// Where the button went down in this frame.
    press: Option<Pos2>,
}

impl Hand {
    pub(super) fn take_up(ui: &Ui, id: Id) -> Self {
        let press = pressed_at(ui).filter(|&at| {
            !ui.ctx().any_popup_open() && ui.ctx().layer_id_at(at).is_none_or(|layer| layer == ui.layer_id())
        });
        Self { id, drag: ui.data(|data| data.get_temp(drag_id(id))), press }
    }

    /// Whether the knot that is dragged now stands in `stack`.
    pub(super) fn holds(&self, stack: &Stack) -> bool {
        self.drag.as_ref().is_some_and(|drag| (stack.value - drag.now).abs() <= 0.0)
    }

    /// What the mouse does to one stack.
    pub(super) fn touch(
        &mut self,
        lab: &mut Lab,
        scene: &Scene,
        stack: &Stack,
        response: &Response,
        track: Track,
    ) {
        if response.hovered() || self.holds(stack) {
            lab.hovering = Hovered::Knot(scene.object, stack.value);
        }
        if response.clicked() {
            select(lab, stack.value);
        }
        if self.drag.is_none()
            && let Some(press) = self.press.filter(|&at| response.rect.contains(at))
        {
            let space = scene.curve.space();
            let neighbour = |index: isize, none: f64| space.knot(index).unwrap_or(none);
            self.drag = Some(KnotDrag {
                object: scene.object,
                stack: *stack,
                before: neighbour(stack.first - 1, f64::NEG_INFINITY),
                after: neighbour(stack.first + stack.multiplicity as isize, f64::INFINITY),
                press,
                track,
                started: false,
                way: 0.0,
                now: stack.value,
                effect: None,
                refusal: None,
            });
        }
        if self.drag.is_none() {
            menu(lab, scene, stack, response);
            if response.hovered() && !response.context_menu_opened() {
                response.clone().on_hover_text(note::hint(scene, stack));
            }
        }
    }

    /// Ends the frame; `place` tells where a value stands on the screen. Returns whether a knot was held.
    pub(super) fn put_down(mut self, lab: &mut Lab, ui: &Ui, place: impl Fn(f64) -> Pos2) -> bool {
        let held = self.drag.is_some();
        if let Some(drag) = &mut self.drag
            && !drag.follow(lab, ui)
        {
            self.drag = None;
        }
        if let Some(drag) = self.drag.as_ref().filter(|drag| drag.started) {
            if drag.refusal.is_some() {
                note::leash(lab, ui, place(drag.now));
            }
            note::show(lab, ui, drag.object, drag.now, drag.effect.clone(), drag.refusal.clone());
            ui.set_cursor_icon(match drag.track {
                Track::Line(_) => CursorIcon::ResizeHorizontal,
                Track::Dial(_) => CursorIcon::Grabbing,
            });
        }
        ui.data_mut(|data| match self.drag {
            Some(drag) => {
                data.insert_temp(drag_id(self.id), drag);
            }
            None => data.remove::<KnotDrag>(drag_id(self.id)),
        });
        held
    }
}

fn select(lab: &mut Lab, knot: f64) {
    lab.selection.knot = Some(knot);
    lab.selection.points.clear();
}

impl KnotDrag {
    /// One frame; `false` if it is over.
    fn follow(&mut self, lab: &mut Lab, ui: &Ui) -> bool {
        let (down, escape) = ui.input(|input| (input.pointer.primary_down(), input.key_pressed(Key::Escape)));
        if escape {
            lab.history.cancel();
            return false;
        }
        if let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) {
            if !self.started && pointer.distance(self.press) >= DEAD_ZONE {
                self.started = true;
                select(lab, self.stack.value);
                lab.begin(if lab.knots.keep_curve { "Move knot, curve kept" } else { "Move knot" });
            }
            if self.started {
                self.pull(lab, ui, pointer);
            }
        }
        if !down {
            if self.started {
                lab.commit();
            } else {
                select(lab, self.stack.value);
            }
        }
        down
    }

    /// The knot goes where the pointer is, if it can.
    fn pull(&mut self, lab: &mut Lab, ui: &Ui, pointer: Pos2) {
        let (shift, alt) = ui.input(|input| (input.modifiers.shift, input.modifiers.alt));
        let whole = shift && self.stack.multiplicity > 1;
        self.way = self.track.way(self.press, pointer, self.way);
        let Target { to, refusal } = self.target(whole, !alt);
        let (object, start) = (self.object, self.stack.value);
        // At the start a drag amounts to nothing; the document needs an edit that says so.
        let edit = if whole {
            Edit::MoveDistinctKnot { object, at: start, to }
        } else {
            let last = self.stack.first + self.stack.multiplicity as isize - 1;
            let index = if to > start { last } else { self.stack.first };
            Edit::MoveKnot { object, knot: index.max(0) as usize, to }
        };
        self.refusal = refusal;
        match lab.history.update(actions::kept(lab, edit)) {
            Ok(outcome) => {
                lab.shape_note = outcome.shape.sentence();
                self.effect = note::effect(&outcome.shape, lab.knots.keep_curve);
                // A knot that went onto the seam from the left stands at the start of the period.
                let space = lab.history.document().curve(object).map(|curve| curve.space());
                self.now = space.filter(|space| !space.knots().contains(&to)).map_or(to, |space| {
                    let (left, _) = space.parameter_interval();
                    space.reduce(to).ok().filter(|at| space.knots().contains(at)).unwrap_or(left)
                });
                lab.selection.knot = Some(self.now);
            }
            // It stays at the last place where it could be.
            Err(error) => self.refusal = Some(note::reason(&error)),
        }
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
