//! The canvas: the view of space, handles, and the hands on them.

use eframe::egui::{
    self, Align2, CursorIcon, Key, Modifiers, PointerButton, Pos2, Rect, Sense, Stroke, StrokeKind, Ui, vec2,
};
use glam::{DVec2, DVec3};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::painter::{color32, paint_note, paint_picture};
use crate::app::scene_view::{SceneView, axis_gizmo, page_from_screen, screen_from_page, view_through};
use crate::app::surfaces::gesture::{Gesture, fine_step, picked};
use crate::app::surfaces::shape_store::ShapeStore;
use crate::app::surfaces::stencil::{self, StencilView, weight_text};
use crate::app::surfaces::target::{Target, arrows, center, shows_points, target_at, view_of};
use crate::app::surfaces::{Picked, commands, eye_of, start};
use crate::document::{Object, ObjectId};
use crate::figure::picture::{Picture, Viewport};
use crate::figure::scene::{EyeView, Scene};
use crate::figure::surfaces::{bounding_box, control_points, legend, legend_items};

/// Room around the objects when they are fitted, in pt.
const FIT_MARGIN: f64 = 60.0;
/// Above this many points the single handles are not announced to assistive programs.
const ANNOUNCED: usize = 200;
/// Most weights that are written at their vertices.
const MOST_WEIGHTS: usize = 40;

/// The canvas of surfaces.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    rect: Option<Rect>,
    /// Which of the documents opened so far the eye was checked for.
    opened: Option<u64>,
    view: SceneView,
    store: ShapeStore,
    gesture: Option<Gesture>,
    hovered: Target,
    menu_target: Target,
    /// What is selected of a mesh beside its vertices.
    pub(super) picked: Picked,
    /// Whether a stencil is that of the last step.
    pub(super) one_step: bool,
}

impl Canvas {
    /// Shows the canvas in all the room that is left and lets hands work on it.
    pub(super) fn show(&mut self, lab: &mut Lab, ui: &mut Ui) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Canvas"));
        self.rect = Some(rect);
        lab.canvas_size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        if self.opened != Some(lab.shelf.opened) {
            self.opened = Some(lab.shelf.opened);
            self.gesture = None;
            self.picked = Picked::Nothing;
            if !shows_everything(lab, rect) {
                self.fit(lab);
            }
        }
        self.tidy(lab);
        self.store.update(lab, ui.ctx());
        let mut eye = eye_of(lab);
        self.view.move_eye(&mut eye, &response, ui);
        lab.view.eye = *eye.state();
        let view = view_through(eye, rect);
        let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer());
        let page = pointer.map(|pointer| page_from_screen(rect, pointer));
        self.hovered = page.map_or(Target::Nothing, |page| target_at(self, lab, &view, page, false));
        self.use_hands(lab, &response, &view, rect, ui);
        nudge(lab, &view, ui);
        self.view.paint(self.store.scene(), self.store.version(), &view, &lab.theme, rect, ui);
        self.paint(lab, &view, rect, pointer, ui);
        self.announce(lab, rect, ui);
        let mut eye = eye_of(lab);
        if axis_gizmo(&mut eye, rect, &lab.theme, ui) {
            lab.view.eye = *eye.state();
        }
        self.point_cursor(pointer, ui);
        if response.secondary_clicked()
            && let Some(page) = page
        {
            self.menu_target = target_at(self, lab, &view, page, true);
        }
        let target = self.menu_target;
        response.context_menu(|ui| self.menu(target, lab, ui));
        if bounding_box(lab.history.document()).is_none() {
            start::offer(rect, lab, ui);
        }
    }

    /// The scene that is shown.
    pub(super) fn scene(&self) -> &Scene {
        self.store.scene()
    }

    /// The shapes.
    pub(super) fn store(&self) -> &ShapeStore {
        &self.store
    }

    /// The stencil of the picked vertex.
    pub(super) fn stencil(&self) -> Option<StencilView> {
        stencil::of(self.picked, &self.store, self.one_step)
    }

    /// Number of triangles in the scene.
    pub(super) fn triangle_count(&self) -> usize {
        self.store.scene().triangles().map(|triangles| triangles.triangles().len()).sum()
    }

    /// The object whose shape has the layer with this number in the scene.
    pub(super) fn object_of_layer(&self, layer: usize) -> Option<ObjectId> {
        let mut first = 0;
        self.store.shown().find_map(|(object, shape)| {
            first += shape.layers.len();
            (layer < first).then_some(object.id)
        })
    }

    /// Names and places of everything that can be grabbed.
    pub(super) fn handles(&self, lab: &Lab) -> Vec<(String, Pos2)> {
        let Some(rect) = self.rect else { return Vec::new() };
        let view = view_of(lab, rect);
        let mut named = Vec::new();
        for object in lab.history.document().objects().iter().filter(|object| shows_points(object)) {
            let points = control_points(object);
            if points.len() <= ANNOUNCED {
                let place = |&at: &DVec3| Some(screen_from_page(rect, view.project(at)?.page));
                named.extend(points.iter().enumerate().filter_map(|(index, at)| {
                    Some((format!("{} {index} of {}", word(object), object.name), place(at)?))
                }));
            }
        }
        named.extend(arrows(lab, &view).into_iter().map(|arrow| {
            (format!("Move along {}", ["x", "y", "z"][arrow.axis]), screen_from_page(rect, arrow.to))
        }));
        named
    }

    /// The commands that belong to the canvas.
    pub(super) fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        let zoom = |lab: &mut Lab, factor: f64| {
            if let Some(rect) = self.rect {
                let view = view_of(lab, rect);
                lab.view.eye = *view.zoomed(view.size * 0.5, factor).state();
            }
        };
        match command {
            Command::Fit => self.fit(lab),
            Command::ZoomIn => zoom(lab, 1.25),
            Command::ZoomOut => zoom(lab, 0.8),
            Command::ToggleParallel => lab.view.eye.orthographic = !lab.view.eye.orthographic,
            Command::Escape => {
                if self.gesture.take().is_some() {
                    lab.history.cancel();
                } else {
                    lab.selection.points.clear();
                    self.picked = Picked::Nothing;
                }
            }
            _ => return false,
        }
        true
    }

    /// Brings all objects into the canvas.
    fn fit(&self, lab: &mut Lab) {
        if let (Some((low, high)), Some(rect)) = (bounding_box(lab.history.document()), self.rect) {
            let size = view_through(eye_of(lab), rect).size;
            let margin = FIT_MARGIN.min(0.12 * size.min_element());
            lab.view.eye = *eye_of(lab).fitted(low, high, size, margin).state();
        }
    }

    /// Drops what is picked and no longer there.
    fn tidy(&mut self, lab: &Lab) {
        let mesh = |id| lab.history.document().object(id).and_then(|object| object.mesh());
        let exists = match self.picked {
            Picked::Nothing => true,
            Picked::Edge(id, [a, b]) => {
                let count = mesh(id).map_or(0, |mesh| mesh.cage().positions().len());
                (a.max(b) as usize) < count
                    && mesh(id).is_some_and(|mesh| mesh.cage().topology().edge_between(a, b).is_some())
            }
            Picked::Refined(id, vertex) => self.store.shape(id).is_some_and(|(object, shape)| {
                vertex < shape.vertices.len()
                    && mesh(id).is_some_and(|mesh| Some(mesh.level()) == object.mesh().map(|m| m.level()))
            }),
        };
        let of_selected = match self.picked {
            Picked::Edge(id, _) | Picked::Refined(id, _) => lab.selection.object == Some(id),
            Picked::Nothing => true,
        };
        if !(exists && of_selected) {
            self.picked = Picked::Nothing;
        }
    }

    fn use_hands(&mut self, lab: &mut Lab, response: &egui::Response, view: &EyeView, rect: Rect, ui: &Ui) {
        let keys = ui.input(|input| input.modifiers);
        let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
        let (down, released) =
            ui.input(|input| (input.pointer.primary_down(), input.pointer.primary_released()));
        let pressed_at = ui.input(|input| {
            input.events.iter().find_map(|event| match *event {
                egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, .. } => {
                    Some(pos)
                }
                _ => None,
            })
        });
        if let Some(at) = pressed_at
            && rect.contains(at)
            && (response.contains_pointer() || response.is_pointer_button_down_on())
            && !self.view.is_moving_eye()
            && !ui.ctx().any_popup_open()
        {
            let target = target_at(self, lab, view, page_from_screen(rect, at), false);
            self.gesture = Some(Gesture::press(target, at, lab, rect, keys));
        }
        if let Some(mut gesture) = self.gesture.take() {
            if down {
                gesture.drag(pointer, lab, view, rect, ui);
                self.gesture = Some(gesture);
            } else {
                if released {
                    gesture.drag(pointer, lab, view, rect, ui);
                }
                if let Some(target) = gesture.release(lab, keys) {
                    self.picked = picked(target);
                    if target == Target::Nothing {
                        self.pick_surface(lab, view, page_from_screen(rect, pointer));
                    }
                }
            }
        }
    }

    /// A click on a surface selects it, and of a mesh the nearest vertex.
    fn pick_surface(&mut self, lab: &mut Lab, view: &EyeView, page: DVec2) {
        let Some(hit) = self.store.scene().pick_triangle(view, page) else { return };
        let Some(id) = self.object_of_layer(hit.layer) else { return };
        if lab.selection.object != Some(id) {
            lab.selection.object = Some(id);
            lab.selection.points.clear();
        }
        let Some((object, shape)) = self.store.shape(id) else { return };
        if object.mesh().is_some_and(|mesh| mesh.level() > 0) {
            let distance = |point: &DVec3| point.distance_squared(hit.hit.point);
            let nearest = shape.vertices.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            self.picked = nearest.map_or(Picked::Nothing, |(vertex, _)| Picked::Refined(id, vertex));
        }
    }

    fn paint(&self, lab: &Lab, view: &EyeView, rect: Rect, pointer: Option<Pos2>, ui: &Ui) {
        let painter = ui.painter_at(rect);
        let theme = &lab.theme;
        let ink = color32(theme.selection);
        let place = |at: DVec3| Some(screen_from_page(rect, view.project(at)?.page));
        if let Some(object) = commands::selected(lab).filter(|object| object.visible) {
            let points = control_points(object);
            for at in lab.selection.points.iter().filter_map(|&point| place(*points.get(point)?)) {
                painter.circle(at, 7.0, ink.gamma_multiply(0.35), Stroke::new(2.0, ink));
            }
        }
        match self.hovered {
            Target::Point(id, point) if self.gesture.is_none() => {
                let object = lab.history.document().object(id);
                let at = object.and_then(|object| control_points(object).get(point)).copied();
                if let Some(at) = at.and_then(place) {
                    painter.circle_stroke(at, 8.5, Stroke::new(2.0, ink));
                }
            }
            Target::Edge(id, ends) => {
                self.paint_edge(lab, id, ends, &place, Stroke::new(3.0, ink.gamma_multiply(0.5)), &painter);
            }
            _ => {}
        }
        if let Picked::Edge(id, ends) = self.picked {
            self.paint_edge(lab, id, ends, &place, Stroke::new(3.5, ink), &painter);
        }
        if let Some(stencil) = self.stencil() {
            paint_stencil(&stencil, lab, &place, &painter);
        }
        paint_arrows(lab, view, rect, self.hovered, &painter);
        if let Some(legend) = legend(self.store.shown(), &selected_view(lab)) {
            let mut picture = Picture::new(None);
            picture.push_layer("colour scale", legend_items(legend, view.size, theme));
            let viewport = Viewport { center: view.size * 0.5, scale: 1.0, size: view.size };
            paint_picture(&picture, &viewport, rect, &painter);
        }
        if let Some(marquee) = self.gesture.as_ref().zip(pointer).and_then(|(g, at)| g.marquee(at)) {
            painter.rect(marquee, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), StrokeKind::Inside);
        }
        if let Some((text, color)) = self.said(lab) {
            let at = rect.center_top() + vec2(0.0, 14.0);
            let size = 13.0 * theme.text_scale as f32;
            paint_note(&painter, at, Align2::CENTER_TOP, &text, size, color, theme.background);
        }
    }

    fn paint_edge(
        &self,
        lab: &Lab,
        id: ObjectId,
        ends: [u32; 2],
        place: &dyn Fn(DVec3) -> Option<Pos2>,
        stroke: Stroke,
        painter: &egui::Painter,
    ) {
        let Some(mesh) = lab.history.document().object(id).and_then(|object| object.mesh()) else { return };
        let end = |end: u32| mesh.cage().positions().get(end as usize).copied().and_then(place);
        if let (Some(a), Some(b)) = (end(ends[0]), end(ends[1])) {
            painter.line_segment([a, b], stroke);
        }
    }

    /// The line at the top: what is wrong, what is going on, or what to do.
    fn said(&self, lab: &Lab) -> Option<(String, crate::figure::picture::Color)> {
        if let Some(problem) = self.store.shown().find_map(|(_, shape)| shape.problem.as_ref()) {
            return Some((problem.clone(), lab.theme.error));
        }
        if self.store.is_busy() {
            return Some(("Refining…".to_owned(), lab.theme.muted_text));
        }
        let untouched = lab.history.steps().0 <= 1 && lab.path.is_none() && lab.lesson.is_none();
        let has_some = bounding_box(lab.history.document()).is_some();
        (untouched && has_some).then(|| {
            let text = "Drag a round handle; hold X, Y or Z for an axis.  Middle drag turns, right drag moves, the wheel zooms.";
            (text.to_owned(), lab.theme.muted_text)
        })
    }

    fn announce(&self, lab: &Lab, rect: Rect, ui: &Ui) {
        for (name, at) in self.handles(lab) {
            let area = Rect::from_center_size(at, vec2(18.0, 18.0));
            if rect.contains_rect(area) {
                let id = ui.make_persistent_id(("handle", &name));
                let response = ui.interact(area, id, Sense::hover());
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
            }
        }
    }

    fn point_cursor(&self, pointer: Option<Pos2>, ui: &Ui) {
        if pointer.is_none() || self.view.is_moving_eye() {
            return;
        }
        ui.set_cursor_icon(match self.hovered {
            _ if self.gesture.is_some() => CursorIcon::Grabbing,
            Target::Point(..) | Target::Arrow(_) => CursorIcon::Grab,
            Target::Edge(..) => CursorIcon::PointingHand,
            _ => CursorIcon::Default,
        });
    }

    fn menu(&mut self, target: Target, lab: &mut Lab, ui: &mut Ui) {
        ui.set_min_width(180.0);
        if let Target::Edge(id, ends) = target {
            ui.weak(format!("Edge {}–{}", ends[0], ends[1]));
            for (text, sharpness) in
                [("Smooth", 0.0), ("Sharpness 1", 1.0), ("Infinitely sharp", f64::INFINITY)]
            {
                if ui.button(text).clicked() {
                    lab.selection.object = Some(id);
                    self.picked = Picked::Edge(id, ends);
                    commands::change(lab, "Change sharpness", |content| {
                        commands::on_mesh(content, |mesh| mesh.with_sharpness(ends, sharpness))
                    });
                }
            }
            ui.separator();
        }
        let entries = if commands::selected(lab).is_some_and(|object| object.mesh().is_some()) {
            [Command::LevelUp, Command::LevelDown, Command::ToggleSmooth, Command::ToggleNet, Command::Fit]
        } else {
            [Command::RefineU, Command::RefineV, Command::ToggleNormals, Command::ToggleNet, Command::Fit]
        };
        for command in entries {
            let enabled = crate::app::command_state::is_possible(command, lab);
            if ui.add_enabled(enabled, egui::Button::new(command.text().0)).clicked() {
                lab.commands.push(command);
            }
        }
    }
}

/// What points of an object are called.
fn word(object: &Object) -> &'static str {
    if object.mesh().is_some() { "Vertex" } else { "Control point" }
}

/// The view with the selection of this moment.
fn selected_view(lab: &Lab) -> crate::document::View {
    crate::document::View { selected_object: lab.selection.object, ..Default::default() }
}

/// Whether all control points are on the canvas and not lost in it.
fn shows_everything(lab: &Lab, rect: Rect) -> bool {
    let Some((low, high)) = bounding_box(lab.history.document()) else { return true };
    let view = view_of(lab, rect);
    let seen = [low, high].map(|corner| view.project(corner));
    let [Some(a), Some(b)] = seen else { return false };
    let inside = |page: DVec2| page.cmpge(DVec2::ZERO).all() && page.cmple(view.size).all();
    inside(a.page) && inside(b.page) && a.page.distance(b.page) > 0.1 * view.size.min_element()
}

fn paint_stencil(
    stencil: &StencilView,
    lab: &Lab,
    place: &dyn Fn(DVec3) -> Option<Pos2>,
    painter: &egui::Painter,
) {
    let Some(at) = place(stencil.at) else { return };
    let (ink, theme) = (color32(lab.theme.accent), &lab.theme);
    let parents: Vec<(Pos2, f64)> =
        stencil.parents.iter().filter_map(|&(_, parent, weight)| Some((place(parent)?, weight))).collect();
    let largest = parents.iter().map(|parent| parent.1.abs()).fold(f64::MIN_POSITIVE, f64::max);
    for &(parent, weight) in &parents {
        let share = (weight.abs() / largest) as f32;
        painter.line_segment(
            [at, parent],
            Stroke::new(1.0 + 1.5 * share, ink.gamma_multiply(0.3 + 0.5 * share)),
        );
        painter.circle(parent, 4.0 + 6.0 * share.sqrt(), ink.gamma_multiply(0.45), Stroke::new(1.5, ink));
    }
    painter.circle(at, 5.0, color32(theme.background), Stroke::new(3.0, ink));
    if parents.len() <= MOST_WEIGHTS {
        for (parent, weight) in parents {
            let size = 12.0 * theme.text_scale as f32;
            let at = parent + vec2(12.0, -8.0);
            paint_note(
                painter,
                at,
                Align2::LEFT_BOTTOM,
                &weight_text(weight),
                size,
                theme.text,
                theme.background,
            );
        }
    }
}

fn paint_arrows(lab: &Lab, view: &EyeView, rect: Rect, hovered: Target, painter: &egui::Painter) {
    for arrow in arrows(lab, view) {
        let ink = color32(lab.theme.basis_color([5, 2, 0][arrow.axis]));
        let (from, to) = (screen_from_page(rect, arrow.from), screen_from_page(rect, arrow.to));
        let width = if hovered == Target::Arrow(arrow.axis) { 4.0 } else { 2.5 };
        let way = (to - from).normalized();
        painter.line_segment([from, to - way * 6.0], Stroke::new(width, ink));
        let side = way.rot90() * 5.0;
        let tip = vec![to + way * 4.0, to - way * 8.0 + side, to - way * 8.0 - side];
        painter.add(egui::Shape::convex_polygon(tip, ink, Stroke::NONE));
        let font = egui::FontId::proportional(11.0);
        painter.text(to + way * 13.0, Align2::CENTER_CENTER, ["x", "y", "z"][arrow.axis], font, ink);
    }
}

/// Arrow keys move the selected points along the axes that run most nearly so, Shift ten times as far, Ctrl a tenth.
fn nudge(lab: &mut Lab, view: &EyeView, ui: &Ui) {
    let keys_are_taken = ui.memory(|memory| memory.focused().is_some() || memory.top_modal_layer().is_some());
    let Some(at) = center(lab).filter(|_| !keys_are_taken) else { return };
    let axes = view.eye.axes();
    let nearest = |direction: DVec3| {
        let axis = direction.abs().max_position();
        DVec3::AXES[axis] * direction[axis].signum()
    };
    let right = nearest(axes.right);
    // Never the same axis twice.
    let up = nearest(axes.up - right * axes.up.dot(right));
    for (key, direction) in
        [(Key::ArrowLeft, -right), (Key::ArrowRight, right), (Key::ArrowUp, up), (Key::ArrowDown, -up)]
    {
        for (keys, factor) in [(Modifiers::NONE, 1.0), (Modifiers::SHIFT, 10.0), (Modifiers::CTRL, 0.1)] {
            let pressed = ui.input_mut(|input| {
                let wanted = input.modifiers.shift == keys.shift && input.modifiers.ctrl == keys.ctrl;
                wanted && input.consume_key(input.modifiers, key)
            });
            if pressed {
                let delta = direction * (0.1 * fine_step(view, view.eye.depth(at)) * factor);
                let points = lab.selection.points.clone();
                commands::change(lab, "Move points", |content| commands::moved(content, &points, delta));
            }
        }
    }
}
