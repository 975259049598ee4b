//! The canvas: camera, picture, handles, and the hands on them.

use eframe::egui::{self, CursorIcon, Pos2, Rect, Sense, Stroke, StrokeKind, Ui};
use glam::DVec2;

use crate::app::command::Command;
use crate::app::curves::align;
use crate::app::curves::commands;
use crate::app::curves::context_menu;
use crate::app::curves::draw_tool::Drawing;
use crate::app::curves::gesture::Gesture;
use crate::app::curves::ghost;
use crate::app::curves::handles;
use crate::app::curves::hermite_hands::HermiteHands;
use crate::app::curves::hit::{Target, Trees, target_at};
use crate::app::curves::mark_tips;
use crate::app::curves::probe_hands::ProbeHands;
use crate::app::curves::step_hands::{self, StepHands};
use crate::app::hands;
use crate::app::lab::{DrawMode, Hovered, Lab, Tool};
use crate::app::painter::{
    color32, paint_hint, paint_note_at_pointer, paint_picture, screen_from_world, world_from_screen,
};
use crate::app::side_rooms;
use crate::document::{Edit, ObjectId};
use crate::figure::composition::{
    Arrangement, Composition, GRID, LabelMemory, Measurements, StepDrawing, compose_arranged, left_out,
    short_number,
};
use crate::figure::picture::Viewport;

/// Room that the handle of a control point takes on all sides, in pt.
const HANDLE: f64 = 14.0;
/// Room around the objects when they are fitted, in pt.
const FIT_MARGIN: f64 = 60.0;

/// The canvas of plane curves.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    rect: Option<Rect>,
    fitted: bool,
    /// Which of the documents opened so far the camera was checked for.
    opened: u64,
    gesture: Option<Gesture>,
    drawing: Drawing,
    step_hands: StepHands,
    hermite_hands: HermiteHands,
    probe_hands: ProbeHands,
    menu_target: Target,
    /// Where the menu was asked for.
    menu_place: DVec2,
    trees: Trees,
    measurements: Measurements,
    panning: bool,
    wheel: Option<WheelWeight>,
    /// Where the labels of the last frame stand.
    labels: Arrangement,
}

/// A weight that is being changed with the wheel; the turns that follow each other closely are one step.
#[derive(Debug)]
struct WheelWeight {
    object: ObjectId,
    point: usize,
    weight: f64,
    last: f64,
}

impl Canvas {
    /// Shows the canvas in all the room that is left and lets hands work on it.
    pub(crate) fn show(&mut self, lab: &mut Lab, ui: &mut Ui) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Canvas"));
        self.rect = Some(rect);
        lab.canvas_size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        if self.opened != lab.shelf.opened {
            self.opened = lab.shelf.opened;
            self.gesture = None;
            self.fitted &= shows_everything(lab);
        }
        if !self.fitted || !lab.view.camera.scale.is_finite() || lab.view.camera.scale <= 0.0 {
            self.fit(lab);
        }
        let busy = self.gesture.is_some();
        hands::move_camera(&mut lab.view.camera, &mut self.panning, busy, &response, rect, ui);
        let viewport = viewport(lab);
        let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer());
        let was_drawing = lab.tool == Tool::Draw;
        // What is dragged stays the target, and nothing has to be searched.
        let target = match (&self.gesture, pointer) {
            _ if was_drawing => Target::Nothing,
            (Some(gesture), _) => gesture.target(),
            (None, Some(pointer)) => target_at(lab, &mut self.trees, &viewport, rect, pointer),
            (None, None) => Target::Nothing,
        };
        if !was_drawing {
            let held = ui.input(|input| input.pointer.primary_down());
            self.drawing.rest(lab, held);
        }
        if !self.step_hands.drag(lab, &response, &viewport, rect, ui)
            && !self.hermite_hands.drag(lab, &response, &viewport, rect, ui)
            && !self.probe_hands.drag(lab, &response, &viewport, rect, ui)
        {
            self.use_hands(lab, &response, &viewport, rect, target, ui);
        }
        self.turn_wheel_on_weight(lab, target, ui);
        commands::nudge(lab, &viewport, ui);
        hover(lab, target);
        step_hands::hover(lab, target, pointer, &viewport, rect);
        self.paint(lab, &viewport, rect, pointer, ui);
        handles::announce(self.named(lab), &viewport, rect, ui);
        ProbeHands::announce(lab, &viewport, rect, ui);
        if let Some(pointer) = pointer
            && lab.tool == Tool::Select
            && self.gesture.is_none()
            && !ui.ctx().any_popup_open()
        {
            mark_tips::show(lab, &viewport, rect, pointer, ui);
        }
        self.point_cursor(lab, target, pointer, ui);
        if response.secondary_clicked() {
            self.menu_target = target;
            if let Some(pointer) = pointer {
                self.menu_place = world_from_screen(&viewport, rect, pointer);
            }
            if let Some(object) = target.object() {
                lab.selection.object = Some(object);
            }
        }
        // The right click that ends a drawing asks for no menu.
        if !was_drawing && lab.tool == Tool::Select {
            let (target, place) = (self.menu_target, self.menu_place);
            response.context_menu(|ui| context_menu::show(target, place, lab, ui));
        }
    }

    /// Everything that can be grabbed, by its accessible name.
    pub(super) fn named(&self, lab: &Lab) -> Vec<(String, DVec2)> {
        let mut named = handles::named(lab, &viewport(lab));
        named.extend(self.drawing.named());
        named
    }

    /// Where a world point is on the screen.
    pub(crate) fn screen_from_world(&self, world: DVec2, lab: &Lab) -> Option<Pos2> {
        self.rect.map(|rect| screen_from_world(&viewport(lab), rect, world))
    }

    /// What is not drawn of the selected curve because too much of it is in view.
    pub(super) fn left_out(lab: &Lab) -> Option<String> {
        left_out(lab.history.document(), lab.selected()?.as_ref(), &viewport(lab))
    }

    /// Brings all objects into the canvas.
    fn fit(&mut self, lab: &mut Lab) {
        let (low, high) =
            lab.history.document().bounding_box().unwrap_or((DVec2::splat(-4.0), DVec2::splat(4.0)));
        let margin = FIT_MARGIN.min(0.12 * lab.canvas_size.min_element());
        hands::fit(&mut lab.view.camera, low, high, lab.canvas_size, margin);
        self.fitted = true;
    }

    /// The commands that belong to the canvas.
    pub(crate) fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        match command {
            Command::Fit => self.fit(lab),
            Command::ZoomIn => hands::zoom(&mut lab.view.camera, 1.25),
            Command::ZoomOut => hands::zoom(&mut lab.view.camera, 0.8),
            Command::ToggleGrid => {
                let shown = lab.view.panels.get(GRID).copied().unwrap_or(true);
                lab.view.panels.insert(GRID.to_owned(), !shown);
            }
            Command::SelectTool => lab.tool = Tool::Select,
            Command::Undo if lab.tool == Tool::Draw && self.drawing.undo() => {}
            Command::Redo if lab.tool == Tool::Draw && self.drawing.redo() => {}
            Command::ToggleEditPoints => lab.edit_points = !lab.edit_points,
            Command::ToggleWeightPoints => lab.weight_points = !lab.weight_points,
            Command::AlignX | Command::AlignY | Command::AlignGrid | Command::Distribute => {
                align::execute(command, lab);
            }
            Command::Escape => {
                lab.before = None;
                if self.gesture.take().is_some() {
                    lab.history.cancel();
                } else if lab.tool == Tool::Draw {
                    lab.tool = Tool::Select;
                } else {
                    lab.selection.points.clear();
                    lab.selection.knot = None;
                }
            }
            Command::SelectAll => {
                let count = lab.curve().map_or(0, |curve| curve.points().len());
                lab.selection.points = (0..count).collect();
            }
            Command::Delete => commands::delete(lab),
            _ => {
                if let Some(mode) = DrawMode::ALL.into_iter().find(|mode| mode.command() == command) {
                    lab.tool = Tool::Draw;
                    lab.draw_mode = mode;
                    self.drawing.clear();
                    return true;
                }
                return commands::edit_selected(command, lab);
            }
        }
        true
    }

    fn use_hands(
        &mut self,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        target: Target,
        ui: &Ui,
    ) {
        let keys = ui.input(|input| input.modifiers);
        if lab.tool == Tool::Draw {
            self.gesture = None;
            self.drawing.hands(lab, response, viewport, rect, self.panning, ui);
            return;
        }
        let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
        let (down, released) =
            ui.input(|input| (input.pointer.primary_down(), input.pointer.primary_released()));
        let pressed_at = hands::pressed_at(ui);
        // The first click of the two has brought the parameter to the place, so that its marker lies there now.
        let place = match target {
            Target::Curve(object, at) | Target::Knot(object, at) => Some((object, at)),
            Target::Parameter(object) => lab.parameter(object).map(|at| (object, at)),
            _ => None,
        };
        if response.double_clicked()
            && let Some((object, at)) = place
        {
            self.gesture = None;
            lab.edit(Edit::InsertKnot { object, at });
            return;
        }
        if response.double_clicked() && target == Target::Nothing {
            self.gesture = None;
            let under = target_at(lab, &mut self.trees, viewport, rect, pointer);
            if let Target::Edge(object, before) = under {
                let position = world_from_screen(viewport, rect, pointer);
                commands::insert_point(object, before, position, lab);
            }
            return;
        }
        if let Some(at) = pressed_at
            && rect.contains(at)
            && (response.contains_pointer() || response.is_pointer_button_down_on())
            && !self.panning
            && !ui.ctx().any_popup_open()
        {
            let target = target_at(lab, &mut self.trees, viewport, rect, at);
            self.gesture = Some(Gesture::press(target, at, lab, viewport, rect, keys));
        }
        if let Some(mut gesture) = self.gesture.take() {
            if down {
                gesture.drag(pointer, lab, &mut self.trees, (viewport, rect), keys);
                self.gesture = Some(gesture);
            } else {
                if released {
                    gesture.drag(pointer, lab, &mut self.trees, (viewport, rect), keys);
                }
                gesture.release(lab, keys);
            }
        }
    }

    /// Alt and the wheel over a control point change its weight.
    fn turn_wheel_on_weight(&mut self, lab: &mut Lab, target: Target, ui: &Ui) {
        let (alt, scroll, now) =
            ui.input(|input| (input.modifiers.alt, input.smooth_scroll_delta(), input.time));
        let turned = f64::from(scroll.y + scroll.x);
        if alt
            && turned != 0.0
            && self.gesture.is_none()
            && let Target::Point(object, point) = target
            && let Some(curve) = lab.history.document().curve(object)
        {
            let running = self.wheel.take().filter(|wheel| wheel.object == object && wheel.point == point);
            let start = running.map_or(curve.weights()[point], |wheel| wheel.weight);
            let weight = (start * (turned / 200.0).exp()).clamp(1e-6, 1e6);
            lab.begin("Change weight");
            lab.update(Edit::SetWeight { object, point, weight });
            self.wheel = Some(WheelWeight { object, point, weight, last: now });
        }
        if let Some(wheel) = &self.wheel {
            if now - wheel.last > 0.5 {
                lab.commit();
                self.wheel = None;
            } else {
                ui.request_repaint_after_secs(0.2);
            }
        }
    }

    /// How many labels had no room.
    pub(super) fn labels_without_room(&self) -> usize {
        self.labels.left_out.len()
    }

    fn paint(&mut self, lab: &Lab, viewport: &Viewport, rect: Rect, pointer: Option<Pos2>, ui: &Ui) {
        let painter = ui.painter_at(rect);
        // While something is dragged, anywhere, labels stay on their side.
        let held = ui.input(|input| input.pointer.any_down());
        let former = if held { std::mem::take(&mut self.labels.memory) } else { LabelMemory::default() };
        let choices =
            Composition { step: step(lab), handle: lab.selection.object, former, ..Composition::default() };
        let document = lab.history.document();
        let (mut picture, labels) =
            compose_arranged(document, &lab.view, &lab.theme, viewport, &choices, &self.measurements);
        self.labels = labels;
        side_rooms::lay_over(side_rooms::overlay(lab, viewport), &mut picture);
        paint_picture(&picture, viewport, rect, &painter);
        ghost::paint(lab, viewport, rect, &painter);
        self.step_hands.paint(lab, viewport, rect, &painter, ui);
        self.hermite_hands.paint(lab, viewport, rect, &painter, ui);
        let along = self.gesture.as_ref().map_or(0.0, Gesture::along);
        handles::paint(lab, viewport, rect, &painter, along, &self.labels);
        if lab.tool == Tool::Draw {
            let keys = ui.input(|input| input.modifiers);
            self.drawing.paint(pointer, lab, viewport, rect, &painter, keys);
        }
        if let Some(note) = self.note(lab)
            && let Some(pointer) = ui.input(|input| input.pointer.latest_pos())
        {
            paint_note_at_pointer(&painter, pointer, rect, &note, &lab.theme);
        }
        if let Some(gesture) = &self.gesture
            && let Some(marquee) = pointer.and_then(|pointer| gesture.marquee(pointer))
        {
            let ink = color32(lab.theme.selection);
            painter.rect(marquee, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), StrokeKind::Inside);
        }
        let hint = if lab.tool == Tool::Draw { Some(self.drawing.hint(lab)) } else { hint(lab) };
        if let Some(hint) = hint {
            paint_hint(&painter, rect, hint, lab.theme.muted_text, &lab.theme);
        }
    }

    /// The numbers that change under the hand.
    fn note(&self, lab: &Lab) -> Option<String> {
        if let Some(wheel) = &self.wheel {
            return Some(format!("w = {}", short_number(wheel.weight)));
        }
        self.gesture.as_ref()?.note(lab)
    }

    fn point_cursor(&self, lab: &Lab, target: Target, pointer: Option<Pos2>, ui: &Ui) {
        if pointer.is_none() {
            return;
        }
        let icon = match target {
            _ if self.panning => CursorIcon::Grabbing,
            _ if lab.tool == Tool::Draw => CursorIcon::Crosshair,
            _ if self.gesture.is_some() => CursorIcon::Grabbing,
            Target::Point(..)
            | Target::Bead(..)
            | Target::Ring(..)
            | Target::WeightPoint(..)
            | Target::EditPoint(..)
            | Target::Curve(..)
            | Target::Knot(..)
            | Target::Parameter(_) => CursorIcon::Grab,
            Target::Edge(..) | Target::Nothing => CursorIcon::Default,
        };
        ui.set_cursor_icon(icon);
    }
}

/// Whether the camera shows all control points.
fn shows_everything(lab: &Lab) -> bool {
    lab.history.document().bounding_box().is_none_or(|(low, high)| {
        [low, high].into_iter().all(|corner| {
            let page = viewport(lab).page_from_world(corner);
            page.cmpge(DVec2::splat(HANDLE)).all() && page.cmple(lab.canvas_size - HANDLE).all()
        })
    })
}

/// The camera as a viewport of the canvas.
fn viewport(lab: &Lab) -> Viewport {
    hands::viewport_of(&lab.view.camera, lab.canvas_size)
}

fn hint(lab: &Lab) -> Option<&'static str> {
    if lab.history.document().is_empty() {
        return Some("Press D and click control points to draw a curve.");
    }
    let untouched = lab.history.steps() == (0, 0) && lab.path.is_none() && lab.lesson.is_none();
    untouched.then_some(
        "Drag a round handle, or the curve itself.  Double-click a curve to insert a knot.  Slide the square to move t.",
    )
}

/// What the stepper shows.
fn step(lab: &Lab) -> Option<(ObjectId, StepDrawing)> {
    if !lab.stepper.open {
        return None;
    }
    let (object, stepper) = (lab.selection.object?, lab.scheme()?);
    Some((object, stepper.drawing(lab.stepper.frame)))
}

fn hover(lab: &mut Lab, target: Target) {
    let hovering = match target {
        Target::Nothing | Target::Edge(..) => return,
        Target::Point(object, point)
        | Target::Bead(object, point)
        | Target::Ring(object, point)
        | Target::WeightPoint(object, point) => Hovered::Point(object, point),
        Target::EditPoint(object, point) => {
            let curve = lab.history.document().curve(object);
            match curve.and_then(|curve| curve.space().edit_parameters().get(point).copied()) {
                Some(parameter) => Hovered::Curve(object, parameter),
                None => return,
            }
        }
        Target::Knot(object, value) => Hovered::Knot(object, value),
        Target::Curve(object, parameter) => Hovered::Curve(object, parameter),
        Target::Parameter(object) => match lab.parameter(object) {
            Some(parameter) => Hovered::Curve(object, parameter),
            None => return,
        },
    };
    lab.hovering = hovering;
}
