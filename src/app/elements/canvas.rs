//! The canvas: camera, the solution, handles, and the hands on them.

use std::collections::BTreeSet;
use std::sync::Arc;

use eframe::egui::{
    self, Align2, CursorIcon, Painter, Pos2, Rect, RichText, Sense, Stroke, StrokeKind, Ui, UiBuilder, vec2,
};
use glam::DVec2;

use crate::app::elements::gesture::Gesture;
use crate::app::elements::hit::{Target, target_at};
use crate::app::elements::{CAMERA, Elements, Subject, add, context_menu, marks};
use crate::app::hands;
use crate::app::lab::Lab;
use crate::app::painter::{
    color32, paint_hint, paint_note, paint_picture, screen_from_world, world_from_screen,
};
use crate::app::progress_strip::{self, State};
use crate::document::{Camera, HandleId, MembraneDisplay, ObjectId, Shape};
use crate::figure::composition::short_number;
use crate::figure::elements::{Solved, field, ground, legend, net};
use crate::figure::picture::{Picture, Viewport};

/// Room around the region when it is fitted, in pt.
const FIT_MARGIN: f64 = 70.0;
/// The canvas of the room.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    rect: Option<Rect>,
    /// The object and the document that the camera was last checked for.
    checked: Option<(u64, ObjectId)>,
    gesture: Option<Gesture>,
    menu: (Target, DVec2),
    panning: bool,
    wheel: Option<f64>,
    painted: Option<Painted>,
    under: Option<String>,
}

/// The picture of a solution, kept while nothing changes.
#[derive(Debug)]
struct Painted {
    solved: Arc<Solved>,
    display: MembraneDisplay,
    theme: &'static str,
    picture: Picture,
}

/// The camera of the room.
pub(super) fn camera(lab: &Lab) -> Camera {
    lab.view.cameras.get(CAMERA).copied().unwrap_or_default()
}

fn viewport(lab: &Lab) -> Viewport {
    hands::viewport_of(&camera(lab), lab.canvas_size)
}

fn camera_mut(lab: &mut Lab) -> &mut Camera {
    lab.view.cameras.entry(CAMERA.to_owned()).or_default()
}

impl Canvas {
    /// Where a world point is on the screen.
    pub(super) fn screen_from_world(&self, world: DVec2, lab: &Lab) -> Option<Pos2> {
        self.rect.map(|rect| screen_from_world(&viewport(lab), rect, world))
    }

    /// Brings the selected problem into the canvas.
    pub(super) fn fit(&self, lab: &mut Lab) {
        let bounds = Subject::of(lab).and_then(|subject| subject.membrane.bounding_box());
        let (low, high) = bounds.unwrap_or((DVec2::splat(-2.0), DVec2::splat(2.0)));
        let margin = FIT_MARGIN.min(0.12 * lab.canvas_size.min_element());
        let size = lab.canvas_size;
        hands::fit(camera_mut(lab), low, high, size, margin);
    }

    /// Changes the scale.
    pub(super) fn zoom(&self, lab: &mut Lab, factor: f64) {
        hands::zoom(camera_mut(lab), factor);
    }

    /// Gives up the running drag; `false` if there is none.
    pub(super) fn give_up(&mut self) -> bool {
        self.gesture.take().is_some()
    }

    /// What the status line says about the place under the pointer.
    pub(super) fn under_pointer(&self) -> Option<&str> {
        self.under.as_deref()
    }

    /// A camera that has never looked at the selected problem is fitted.
    fn check_camera(&mut self, subject: Option<&Subject>, lab: &mut Lab) {
        let Some(subject) = subject else {
            self.checked = None;
            return;
        };
        let now = Some((lab.shelf.opened, subject.object));
        let scale = lab.view.cameras.get(CAMERA).map_or(0.0, |camera| camera.scale);
        if self.checked == now && scale.is_finite() && scale > 0.0 {
            return;
        }
        self.checked = now;
        self.gesture = None;
        let sees = |corner: DVec2| {
            let page = viewport(lab).page_from_world(corner);
            page.cmpge(DVec2::ZERO).all() && page.cmple(lab.canvas_size).all()
        };
        let suits = subject.membrane.bounding_box().is_some_and(|(low, high)| {
            let part = (high - low).max_element() * scale / lab.canvas_size.min_element();
            sees(low) && sees(high) && part > 0.5
        });
        if !suits {
            self.fit(lab);
        }
    }
}

/// Shows the canvas in all the room that is left and lets hands work on it.
pub(super) fn show(room: &mut Elements, subject: Option<&Subject>, lab: &mut Lab, ui: &mut Ui) {
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    if rect.width() < 8.0 || rect.height() < 8.0 {
        return;
    }
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Canvas"));
    room.canvas.rect = Some(rect);
    lab.canvas_size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    room.canvas.check_camera(subject, lab);
    let busy = room.canvas.gesture.is_some();
    let mut panning = room.canvas.panning;
    hands::move_camera(camera_mut(lab), &mut panning, busy, &response, rect, ui);
    room.canvas.panning = panning;
    let viewport = viewport(lab);
    let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer());
    let mut target = Target::Nothing;
    if let Some(subject) = subject {
        if let Some(pointer) = pointer {
            target = target_at(&subject.membrane, &room.selected, &viewport, rect, pointer);
        }
        use_hands(room, subject, lab, &response, (&viewport, rect), target, ui);
        turn_wheel_on_weight(room, subject, lab, target, ui);
        if !room.selected.is_empty() {
            for delta in hands::nudges(&viewport, ui) {
                let handles: Vec<HandleId> = room.selected.iter().copied().collect();
                subject.apply(lab, "Nudge", subject.membrane.with_moved_handles(&handles, delta));
            }
        }
    }
    if response.secondary_clicked()
        && let Some(pointer) = pointer
    {
        room.canvas.menu = (target, world_from_screen(&viewport, rect, pointer));
        if let Some(id) = target.handle() {
            room.selected = BTreeSet::from([id]);
        }
    }
    // What the hands have changed is painted in the same frame.
    let subject = Subject::of(lab);
    let painter = ui.painter_at(rect);
    paint_picture(&ground(&lab.view, &lab.theme, &viewport), &viewport, rect, &painter);
    match &subject {
        Some(subject) => {
            paint(room, subject, lab, (&viewport, rect), pointer, &painter);
            marks::announce(subject, (&viewport, rect), ui);
            show_state(room, rect, lab, ui);
            point_cursor(&room.canvas, target, pointer, ui);
        }
        None => {
            room.canvas.under = None;
            show_empty(rect, lab, ui);
        }
    }
    let (target, at) = room.canvas.menu;
    response.context_menu(|ui| context_menu::show(target, at, subject.as_ref(), lab, ui));
}

fn use_hands(
    room: &mut Elements,
    subject: &Subject,
    lab: &mut Lab,
    response: &egui::Response,
    (viewport, rect): (&Viewport, Rect),
    target: Target,
    ui: &Ui,
) {
    let keys = ui.input(|input| input.modifiers);
    let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
    let (down, released) = ui.input(|input| (input.pointer.primary_down(), input.pointer.primary_released()));
    if response.double_clicked()
        && let Target::Edge(part, side) = target
        && let Some(Shape::Polygon { .. }) = subject.membrane.parts().get(part).map(|part| &part.shape)
    {
        room.canvas.gesture = None;
        let at = world_from_screen(viewport, rect, pointer);
        let changed = subject.membrane.with_parts(|parts| {
            if let Some(Shape::Polygon { vertices }) = parts.get_mut(part).map(|part| &mut part.shape) {
                vertices.insert(side + 1, at);
            }
        });
        subject.apply(lab, "Insert vertex", changed);
        return;
    }
    if let Some(at) = hands::pressed_at(ui)
        && rect.contains(at)
        && (response.contains_pointer() || response.is_pointer_button_down_on())
        && !room.canvas.panning
        && !ui.ctx().any_popup_open()
    {
        let target = target_at(&subject.membrane, &room.selected, viewport, rect, at);
        let world = world_from_screen(viewport, rect, at);
        room.canvas.gesture = Some(Gesture::press(target, at, subject, &mut room.selected, world, keys));
    }
    if let Some(mut gesture) = room.canvas.gesture.take() {
        if down || released {
            gesture.drag(pointer, subject, &mut room.selected, lab, (viewport, rect), keys);
        }
        if down {
            room.canvas.gesture = Some(gesture);
        } else {
            gesture.release(&mut room.selected, lab, keys);
        }
    }
}

/// Alt and the wheel over a control point change its weight; turns that follow each other closely are one step.
fn turn_wheel_on_weight(room: &mut Elements, subject: &Subject, lab: &mut Lab, target: Target, ui: &Ui) {
    let (alt, scroll, now) = ui.input(|input| (input.modifiers.alt, input.smooth_scroll_delta(), input.time));
    let turned = f64::from(scroll.y + scroll.x);
    if alt
        && turned != 0.0
        && room.canvas.gesture.is_none()
        && let (Target::Handle(id), Some(patch)) = (target, subject.membrane.patch())
        && let Some(weight) = patch.weights().get(id.index)
    {
        let weight = (weight * (turned / 200.0).exp()).clamp(1e-6, 1e6);
        subject.update(lab, "Change weight", subject.membrane.with_weight(id.index, weight));
        room.canvas.wheel = Some(now);
    }
    if let Some(last) = room.canvas.wheel {
        if now - last > 0.5 {
            lab.commit();
            room.canvas.wheel = None;
        } else {
            ui.request_repaint_after_secs(0.2);
        }
    }
}

fn paint(
    room: &mut Elements,
    subject: &Subject,
    lab: &Lab,
    (viewport, rect): (&Viewport, Rect),
    pointer: Option<Pos2>,
    painter: &Painter,
) {
    let theme = &lab.theme;
    let overlay = |layer: &str, items| {
        let mut picture = Picture::new(None);
        picture.push_layer(layer, items);
        paint_picture(&picture, viewport, rect, painter);
    };
    let solved = room.live.solved(subject.object).cloned();
    if let Some(solved) = &solved {
        let fresh = room.canvas.painted.as_ref().is_some_and(|painted| {
            Arc::ptr_eq(&painted.solved, solved)
                && painted.display == subject.display
                && painted.theme == theme.name
        });
        if !fresh {
            let picture = Picture { background: None, layers: field(solved, &subject.display, theme) };
            let display = subject.display.clone();
            let solved = Arc::clone(solved);
            room.canvas.painted = Some(Painted { solved, display, theme: theme.name, picture });
        }
        if let Some(painted) = &room.canvas.painted {
            paint_picture(&painted.picture, viewport, rect, painter);
        }
    }
    if subject.display.net || solved.is_none() {
        overlay("net", net(&subject.membrane, theme));
    }
    if let Some(solved) = &solved {
        let picture = Picture { background: None, layers: legend(solved, &subject.display, theme, viewport) };
        paint_picture(&picture, viewport, rect, painter);
    }
    marks::paint(room, subject, lab, (viewport, rect), pointer, painter);
    room.canvas.under = None;
    if let (Some(pointer), Some(solved)) = (pointer, &solved) {
        let x = world_from_screen(viewport, rect, pointer);
        if let Some(jet) = solved.evaluate(x) {
            let short = short_number;
            room.canvas.under = Some(format!(
                "x = {}, y = {}   u = {}   grad u = ({}, {})",
                short(x.x),
                short(x.y),
                short(jet.value),
                short(jet.gradient.x),
                short(jet.gradient.y)
            ));
            if room.canvas.gesture.is_none() {
                let text = format!("u = {}", short(jet.value));
                let size = 12.0 * theme.text_scale as f32;
                let at = pointer + vec2(14.0, -10.0);
                paint_note(painter, at, Align2::LEFT_BOTTOM, &text, size, theme.text, theme.background);
            }
        }
    }
    if let Some(gesture) = &room.canvas.gesture
        && let Some(marquee) = pointer.and_then(|pointer| gesture.marquee(pointer))
    {
        let ink = color32(theme.selection);
        painter.rect(marquee, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), StrokeKind::Inside);
    }
    let untouched = lab.history.steps() == (0, 0) && lab.path.is_none() && lab.lesson.is_none();
    if let Some(text) = hint(subject).filter(|_| untouched || subject.membrane.handles().is_empty()) {
        paint_hint(painter, rect, text, theme.muted_text, theme);
    }
}

fn hint(subject: &Subject) -> Option<&'static str> {
    if subject.membrane.patch().is_some() {
        return Some("Drag the control points.  Alt and the wheel over one change its weight.");
    }
    if subject.membrane.parts().is_empty() {
        return Some("The domain is empty: right-click for a disc, an ellipse, a rectangle or a polygon.");
    }
    Some("Drag handles and boundaries.  Right-click for union, intersection, difference and new parts.")
}

/// Progress with Cancel, or why there is no solution, at the lower edge.
fn show_state(room: &mut Elements, rect: Rect, lab: &Lab, ui: &mut Ui) {
    let state = match room.live.progress() {
        Some((part, seconds)) => Some(State::Running(part, seconds)),
        None => room.live.is_cancelled().then_some(State::Stopped),
    };
    match state {
        Some(state) => {
            if progress_strip::show(state, "Solving", "Solve", rect, &lab.theme, ui) {
                if matches!(state, State::Stopped) { room.live.again() } else { room.live.cancel() }
            }
        }
        None => {
            if let Some(error) = room.live.error() {
                let size = 13.0 * lab.theme.text_scale as f32;
                let at = rect.center_bottom() - vec2(0.0, 44.0);
                let (ink, ground) = (lab.theme.error, lab.theme.background);
                let painter = ui.painter_at(rect);
                paint_note(&painter, at, Align2::CENTER_BOTTOM, &error.to_string(), size, ink, ground);
            }
        }
    }
}

fn show_empty(rect: Rect, lab: &mut Lab, ui: &mut Ui) {
    let width = 250.0;
    let area = Rect::from_center_size(rect.center(), vec2(width, 292.0f32.min(rect.height() - 16.0)));
    ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
        ui.painter().rect_filled(area.expand(14.0), 8.0, color32(lab.theme.panel));
        ui.vertical_centered(|ui| {
            ui.label(RichText::new("A membrane over a domain").heading());
            ui.label(
                RichText::new("It is held at the boundary, and a load bends it. Start with\u{2026}").weak(),
            );
            ui.add_space(6.0);
            add::preset_buttons(width, lab, ui);
        });
    });
}

fn point_cursor(canvas: &Canvas, target: Target, pointer: Option<Pos2>, ui: &Ui) {
    if pointer.is_none() {
        return;
    }
    let icon = match target {
        _ if canvas.panning || canvas.gesture.is_some() => CursorIcon::Grabbing,
        Target::Handle(_) => CursorIcon::Grab,
        Target::Edge(..) => CursorIcon::Move,
        Target::Nothing => CursorIcon::Default,
    };
    ui.set_cursor_icon(icon);
}
