//! Drawing a new curve, click by click, by free hand, and with typed numbers.

use eframe::egui::{self, Event, Key, Modifiers, Pos2, Rect, Ui};
use glam::DVec2;

use crate::app::curves::draw_shapes::{construct, shoulder};
use crate::app::hands::{DEAD_ZONE, constrained, pressed_at};
use crate::app::lab::{DrawMode, Lab, Tool};
use crate::app::number_text::parse_list;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::core::spline_curve::{FitOptions, FittingError, Nurbs, fit_stroke};
use crate::course::number_text::parse_number;
use crate::document::{CurveDisplay, Edit, ObjectId};
use crate::figure::composition::short_number;
use crate::figure::picture::Viewport;

/// Pixels within which a click on the first point closes the curve, and a stroke that comes back to its start.
pub(super) const CLOSING_REACH: f32 = 10.0;

/// Two clicks farther from each other are no double click.
const DOUBLE_REACH: f32 = 6.0;

/// Turns of a stroke sharper than this are corners.
const CORNER_ANGLE: f64 = 1.2;

/// The most control points of a fitted stroke.
const MOST_POINTS: usize = 400;

/// The points clicked so far.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    pub(super) mode: DrawMode,
    pub(super) points: Vec<DVec2>,
    /// Points that were undone; the last one comes back first.
    undone: Vec<DVec2>,
    /// Where the button went down.
    pub(super) pressed: Option<Pos2>,
    /// The stroke while the button is down.
    pub(super) stroke: Vec<DVec2>,
    /// The number that is being typed.
    pub(super) typed: String,
    /// The stroke fitted last.
    fitted: Option<FittedStroke>,
}

/// A stroke that became a curve; as long as the curve is as it was made, another tolerance fits it again.
#[derive(Debug)]
struct FittedStroke {
    object: ObjectId,
    stroke: Vec<DVec2>,
    closed: bool,
    /// Pixels per unit when it was drawn.
    scale: f64,
    /// In pixels.
    tolerance: f64,
    curve: Nurbs<DVec2>,
}

impl Drawing {
    /// Forgets what is unfinished.
    pub(super) fn clear(&mut self) {
        *self = Self { mode: self.mode, fitted: self.fitted.take(), ..Self::default() };
    }

    /// While another tool is taken up: nothing is unfinished, and a changed tolerance fits the last stroke again.
    ///
    /// Not while the button is `held`, so that a dragged tolerance is one step.
    pub(super) fn rest(&mut self, lab: &mut Lab, held: bool) {
        self.clear();
        lab.drawn = (0, 0);
        let Some(fitted) = &mut self.fitted else { return };
        if fitted.tolerance.to_bits() == lab.stroke_tolerance.to_bits() || held {
            return;
        }
        if lab.history.document().curve(fitted.object) != Some(&fitted.curve) {
            self.fitted = None;
            return;
        }
        fitted.tolerance = lab.stroke_tolerance;
        match fit(&fitted.stroke, fitted.closed, fitted.tolerance, fitted.scale) {
            Ok((curve, note)) => {
                fitted.curve = curve.clone();
                let (object, label) = (fitted.object, "Fit the stroke again".to_owned());
                lab.edit(Edit::ReplaceCurve { object, curve, label });
                lab.shape_note = Some(note);
            }
            Err(reason) => lab.problem(reason),
        }
    }

    /// An unfinished drawing with these points.
    pub(super) fn of(mode: DrawMode, points: Vec<DVec2>) -> Self {
        Self { mode, points, ..Self::default() }
    }

    /// Takes back the last point; `false` if there is none.
    pub(super) fn undo(&mut self) -> bool {
        let last = self.points.pop();
        self.undone.extend(last);
        last.is_some()
    }

    /// Brings back the point undone last; `false` if there is none.
    pub(super) fn redo(&mut self) -> bool {
        let next = self.undone.pop();
        self.points.extend(next);
        next.is_some()
    }

    /// What mouse and keys do while the drawing tool is taken up.
    pub(super) fn hands(
        &mut self,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        panning: bool,
        ui: &Ui,
    ) {
        if self.mode != lab.draw_mode {
            self.mode = lab.draw_mode;
            self.clear();
        }
        let keys = ui.input(|input| input.modifiers);
        let pointer = ui.input(|input| input.pointer.latest_pos());
        if let Some(at) = pressed_at(ui)
            && rect.contains(at)
            && (response.contains_pointer() || response.is_pointer_button_down_on())
            && !panning
            && !ui.ctx().any_popup_open()
        {
            self.pressed = Some(at);
            self.stroke = vec![world_from_screen(viewport, rect, at)];
        }
        if panning {
            self.pressed = None;
        }
        if let Some(pressed) = self.pressed
            && let Some(pointer) = pointer
        {
            if self.mode == DrawMode::Stroke {
                self.follow(viewport, rect, ui);
            }
            if ui.input(|input| input.pointer.primary_released() || !input.pointer.primary_down()) {
                self.pressed = None;
                self.released(pressed, pointer, lab, response, viewport, rect, keys);
            }
        }
        if response.secondary_clicked() {
            if self.points.is_empty() {
                lab.tool = Tool::Select;
            } else if self.mode.clicks().is_some() {
                self.clear();
            } else {
                self.finish(false, lab);
            }
        }
        self.keys(lab, pointer, viewport, rect, ui);
        lab.drawn = (self.points.len(), self.undone.len());
    }

    /// The button came up.
    #[expect(clippy::too_many_arguments, reason = "all of them say where and how")]
    fn released(
        &mut self,
        pressed: Pos2,
        pointer: Pos2,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        keys: Modifiers,
    ) {
        let on_screen = |world: DVec2| screen_from_world(viewport, rect, world);
        let moved = pressed.distance(pointer) >= DEAD_ZONE;
        if self.mode == DrawMode::Stroke {
            return self.finish_stroke(lab, viewport, rect);
        }
        let again = response.double_clicked() || response.triple_clicked();
        if !moved
            && again
            && self.points.last().is_some_and(|&last| on_screen(last).distance(pressed) <= DOUBLE_REACH)
        {
            if self.mode.clicks().is_none() {
                self.finish(false, lab);
            }
            return;
        }
        if let Some(needed) = self.mode.clicks() {
            if moved && self.points.len() + 2 <= needed {
                self.add(self.place(pressed, viewport, rect, keys), lab);
            }
        } else if self.points.len() >= 3 && on_screen(self.points[0]).distance(pointer) <= CLOSING_REACH {
            return self.finish(true, lab);
        }
        self.add(self.place(pointer, viewport, rect, keys), lab);
    }

    /// A further point; the last one that is needed ends the drawing.
    fn add(&mut self, place: DVec2, lab: &mut Lab) {
        if self.mode.clicks().is_some() && self.points.last() == Some(&place) {
            return;
        }
        self.points.push(place);
        self.undone.clear();
        self.typed.clear();
        if self.mode.clicks().is_some_and(|needed| self.points.len() >= needed) {
            self.finish(false, lab);
            // What cannot be made waits for another last point.
            if lab.tool == Tool::Draw {
                self.points.pop();
            }
        }
    }

    /// The place that a click at `pointer` means: with Shift along an axis from the point before, with Ctrl on the grid.
    pub(super) fn place(&self, pointer: Pos2, viewport: &Viewport, rect: Rect, keys: Modifiers) -> DVec2 {
        let world = world_from_screen(viewport, rect, pointer);
        match self.anchor() {
            Some(anchor) => anchor + constrained(world - anchor, anchor, viewport, keys),
            None => constrained(world, DVec2::ZERO, viewport, Modifiers { shift: false, ..keys }),
        }
    }

    /// Where lengths are measured from.
    fn anchor(&self) -> Option<DVec2> {
        match self.mode {
            DrawMode::Circle | DrawMode::Ellipse => self.points.first().copied(),
            _ => self.points.last().copied(),
        }
    }

    /// Enter ends or takes the number typed, Backspace drops, Escape gives up; digits make a number. These keys are used up while something is drawn.
    fn keys(&mut self, lab: &mut Lab, pointer: Option<Pos2>, viewport: &Viewport, rect: Rect, ui: &Ui) {
        if ui.text_edit_focused() || ui.memory(|memory| memory.top_modal_layer().is_some()) {
            return;
        }
        if self.mode != DrawMode::Stroke {
            self.type_number(ui);
        }
        if self.points.is_empty() && self.typed.is_empty() {
            return;
        }
        let pressed = |key: Key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::Enter) {
            if self.typed.is_empty() {
                self.finish(false, lab);
            } else {
                self.take_typed(lab, pointer, viewport, rect);
            }
        } else if pressed(Key::Backspace) {
            if self.typed.pop().is_none() {
                self.points.pop();
                self.undone.clear();
            }
        } else if pressed(Key::Escape) {
            if self.typed.is_empty() {
                self.clear();
            } else {
                self.typed.clear();
            }
        }
    }

    fn type_number(&mut self, ui: &Ui) {
        let started = !self.typed.is_empty();
        let part = |letter: char| {
            letter.is_ascii_digit() || "-.@".contains(letter) || (started && ",; ".contains(letter))
        };
        let typed = &mut self.typed;
        ui.input_mut(|input| {
            let plain = !input.modifiers.command && !input.modifiers.alt;
            if !plain {
                return;
            }
            input.events.retain(|event| match event {
                Event::Text(text) if text.chars().all(part) => {
                    typed.push_str(text);
                    false
                }
                _ => true,
            });
        });
    }

    /// `x; y` is a place, `@x; y` one counted from the point before; a single number is a length towards the pointer, or the weight.
    fn take_typed(&mut self, lab: &mut Lab, pointer: Option<Pos2>, viewport: &Viewport, rect: Rect) {
        let text = std::mem::take(&mut self.typed);
        let relative = text.starts_with('@');
        let text = text.trim_start_matches('@').trim();
        // A comma between two digits is a decimal sign, as in every field of the window.
        let numbers = if text.contains([';', ' ']) {
            parse_list(text)
        } else {
            parse_number(text).map(|number| vec![number]).map_err(|error| error.to_string())
        };
        let numbers = match numbers {
            Ok(numbers) => numbers,
            Err(reason) => return lab.problem(reason),
        };
        let anchor = self.anchor();
        let place = match (&numbers[..], anchor) {
            (&[x, y], Some(anchor)) if relative => anchor + DVec2::new(x, y),
            (&[x, y], _) => DVec2::new(x, y),
            (&[weight], _) if self.mode == DrawMode::Conic && self.points.len() == 3 => {
                if weight <= 0.0 {
                    return lab.problem("A weight must be positive.");
                }
                // Exactly that weight, not the one of a place on the screen.
                return self.finish_conic(weight, lab);
            }
            (&[length], Some(anchor)) => {
                let towards = pointer.map_or(DVec2::X, |at| world_from_screen(viewport, rect, at) - anchor);
                let direction = match (self.mode, &self.points[..]) {
                    (DrawMode::Ellipse, &[center, first]) => (first - center).perp(),
                    _ => towards,
                };
                anchor + direction.normalize_or(DVec2::X) * length
            }
            _ => return lab.problem("Type x; y for a place, @x; y for a step, or one number for a length."),
        };
        if !place.is_finite() {
            return lab.problem("That place is not finite.");
        }
        self.add(place, lab);
    }

    fn finish_conic(&mut self, weight: f64, lab: &mut Lab) {
        let &[start, middle, end] = &self.points[..] else { return };
        self.points.push(shoulder([start, middle, end], weight));
        let made = construct(self.mode, &self.points, false).and_then(|mut curves| {
            let exact = curves.pop().ok_or_else(String::new)?.with_weight(1, weight);
            exact.map(|curve| vec![curve]).map_err(|error| error.to_string())
        });
        self.make(made, lab);
    }

    /// Makes the curve; with too few points there is none yet, and drawing goes on.
    fn finish(&mut self, closed: bool, lab: &mut Lab) {
        if self.mode.clicks().map_or(self.points.len() < 2, |needed| self.points.len() < needed) {
            return;
        }
        let made = construct(self.mode, &self.points, closed);
        self.make(made, lab);
    }

    fn make(&mut self, made: Result<Vec<Nurbs<DVec2>>, String>, lab: &mut Lab) {
        let curves = match made {
            Ok(curves) => curves,
            Err(reason) => return lab.problem(reason),
        };
        let noun = self.mode.noun();
        let mut number = 0;
        let mut edits: Vec<Edit> = Vec::new();
        for curve in curves {
            let name = next_name(noun, &mut number, lab);
            let display =
                CurveDisplay { color: lab.history.document().len() + edits.len(), ..CurveDisplay::default() };
            edits.push(Edit::AddCurve { name, curve, display });
        }
        let edit = match edits.len() {
            1 => edits.remove(0),
            count => Edit::Batch { label: format!("Add {count} branches"), edits },
        };
        if let Some(outcome) = lab.edit(edit) {
            lab.selection.object = outcome.created.first().copied();
            lab.selection.points.clear();
            lab.selection.knot = None;
            lab.tool = Tool::Select;
            self.clear();
        }
    }

    /// The stroke goes on to where the pointer has been in this frame.
    fn follow(&mut self, viewport: &Viewport, rect: Rect, ui: &Ui) {
        let moves: Vec<Pos2> = ui.input(|input| {
            let moved = |event: &Event| match event {
                Event::PointerMoved(at) | Event::PointerButton { pos: at, .. } => Some(*at),
                _ => None,
            };
            input.events.iter().filter_map(moved).collect()
        });
        for at in moves {
            let world = world_from_screen(viewport, rect, at);
            if self.stroke.last().is_none_or(|last| last.distance(world) * viewport.scale >= 1.0) {
                self.stroke.push(world);
            }
        }
    }

    fn finish_stroke(&mut self, lab: &mut Lab, viewport: &Viewport, rect: Rect) {
        let stroke = std::mem::take(&mut self.stroke);
        let on_screen = |world: DVec2| screen_from_world(viewport, rect, world);
        let (Some(&first), Some(&last)) = (stroke.first(), stroke.last()) else { return };
        let farthest = stroke.iter().map(|&at| on_screen(at).distance(on_screen(first))).fold(0.0, f32::max);
        if farthest < DEAD_ZONE {
            return;
        }
        let closed = farthest > 4.0 * CLOSING_REACH
            && stroke.len() > 8
            && on_screen(last).distance(on_screen(first)) <= CLOSING_REACH;
        let (tolerance, scale) = (lab.stroke_tolerance, viewport.scale);
        match fit(&stroke, closed, tolerance, scale) {
            Ok((curve, note)) => {
                self.make(Ok(vec![curve.clone()]), lab);
                lab.shape_note = Some(note);
                self.fitted = lab.selection.object.map(|object| FittedStroke {
                    object,
                    stroke,
                    closed,
                    scale,
                    tolerance,
                    curve,
                });
            }
            Err(reason) => lab.problem(reason),
        }
    }

    /// The points clicked, by the names of their handles.
    pub(super) fn named(&self) -> Vec<(String, DVec2)> {
        self.points.iter().enumerate().map(|(k, &at)| (format!("Drawn point {k}"), at)).collect()
    }

    /// What to do next.
    pub(super) fn hint(&self, lab: &Lab) -> &'static str {
        lab.draw_mode.hint(if self.mode == lab.draw_mode { self.points.len() } else { 0 })
    }
}

/// The curve along a stroke within `tolerance` pixels of `scale` to a unit, and what it is in a sentence.
fn fit(stroke: &[DVec2], closed: bool, tolerance: f64, scale: f64) -> Result<(Nurbs<DVec2>, String), String> {
    let options = FitOptions {
        degree: 3,
        tolerance: tolerance / scale,
        corner_angle: CORNER_ANGLE,
        closed,
        most_points: MOST_POINTS,
    };
    let fit = match fit_stroke(stroke, &options) {
        Ok(fit) => fit,
        Err(FittingError::StepLimit { best }) => *best,
        Err(error) => return Err(error.to_string()),
    };
    let note = format!(
        "{} points drawn, {} control points; the curve is within {} px of them.",
        stroke.len(),
        fit.curve.points().len(),
        short_number(fit.max_error * scale)
    );
    Ok((fit.curve, note))
}

fn next_name(noun: &str, number: &mut usize, lab: &Lab) -> String {
    let taken = |name: &str| lab.history.document().objects().iter().any(|object| object.name == name);
    loop {
        *number += 1;
        let name = format!("{noun} {number}");
        if !taken(&name) {
            return name;
        }
    }
}
