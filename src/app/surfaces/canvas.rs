//! The canvas: the view of space, handles, and the hands on them.

use eframe::egui::{self, CursorIcon, Pos2, Rect, Sense, Ui, vec2};
use glam::{DVec2, DVec3};

use crate::app::command::Command;
use crate::app::hands;
use crate::app::lab::Lab;
use crate::app::progress_strip::{self, State};
use crate::app::scene_view::{SceneView, axis_gizmo, page_from_screen, screen_from_page, view_through};
use crate::app::surfaces::gesture::{Gesture, fine_step, picked};
use crate::app::surfaces::shape_store::ShapeStore;
use crate::app::surfaces::stencil::{self, StencilView};
use crate::app::surfaces::target::{Target, arrows, center, shows_points, target_at, view_of};
use crate::app::surfaces::{Picked, context_menu, eye_of, overlay, start};
use crate::document::{Object, ObjectId};
use crate::figure::scene::{EyeView, Scene};
use crate::figure::surfaces::{bounding_box, control_points};

/// Room around the objects when they are fitted, in pt.
const FIT_MARGIN: f64 = 60.0;
/// Above this many points the single handles are not announced to assistive programs.
const ANNOUNCED: usize = 200;

/// The canvas of surfaces.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    rect: Option<Rect>,
    /// Which of the documents opened so far the eye was checked for.
    opened: Option<u64>,
    view: SceneView,
    pub(super) store: ShapeStore,
    pub(super) gesture: Option<Gesture>,
    pub(super) hovered: Target,
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
        overlay::paint(self, lab, &view, rect, pointer, ui);
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
            if let Target::Surface(object, _) | Target::Point(object, _) | Target::Edge(object, _) =
                self.menu_target
                && lab.selection.object != Some(object)
            {
                lab.selection.object = Some(object);
                lab.selection.points.clear();
            }
        }
        let target = self.menu_target;
        response.context_menu(|ui| context_menu::show(target, &mut self.picked, lab, ui));
        self.show_progress(lab, rect, ui);
        if self.store.is_empty() {
            start::offer(rect, lab, ui);
        }
    }

    /// How far a large shape is, with a button that stops it.
    fn show_progress(&mut self, lab: &Lab, rect: Rect, ui: &mut Ui) {
        let state = match self.store.progress() {
            Some((part, seconds)) => State::Running(part, seconds),
            None if self.store.given_up().is_some() => State::Stopped,
            None => return,
        };
        if progress_strip::show(state, "Computing", "Compute", rect, &lab.theme, ui) {
            if matches!(state, State::Stopped) { self.store.again() } else { self.store.cancel() }
        }
    }

    /// The scene that is shown.
    pub(super) fn scene(&self) -> &Scene {
        self.store.scene()
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
                } else if self
                    .store
                    .progress()
                    .is_some_and(|(_, seconds)| seconds > progress_strip::SHOWN_AFTER)
                {
                    self.store.cancel();
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
        let document = lab.history.document();
        if let Some(rect) = self.rect.filter(|_| bounding_box(document).is_some()) {
            let size = view_through(eye_of(lab), rect).size;
            let margin = FIT_MARGIN.min(0.12 * size.min_element());
            let visible = document.objects().iter().filter(|object| object.visible);
            let points = visible.flat_map(|object| control_points(object)).copied();
            lab.view.eye = *eye_of(lab).fitted_to(points, size, margin).state();
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
        if let Some(at) = hands::pressed_at(ui)
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
}

/// What points of an object are called.
fn word(object: &Object) -> &'static str {
    if object.mesh().is_some() { "Vertex" } else { "Control point" }
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

/// Arrow keys move the selected points along the axes that run most nearly so, Shift ten times as far, Ctrl a tenth.
fn nudge(lab: &mut Lab, view: &EyeView, ui: &Ui) {
    let Some(at) = center(lab) else { return };
    let axes = view.eye.axes();
    let nearest = |direction: DVec3| {
        let axis = direction.abs().max_position();
        DVec3::AXES[axis] * direction[axis].signum()
    };
    let right = nearest(axes.right);
    // Never the same axis twice.
    let up = nearest(axes.up - right * axes.up.dot(right));
    for (direction, factor) in hands::arrow_keys(ui) {
        let delta =
            (right * direction.x + up * direction.y) * (0.1 * fine_step(view, view.eye.depth(at)) * factor);
        let points = lab.selection.points.clone();
        super::commands::change(lab, "Move points", |content| {
            super::commands::moved(content, &points, delta)
        });
    }
}
