//! The canvas: plots, camera, handles, and the hands on them.

use std::sync::Arc;

use eframe::egui::{self, Align2, CursorIcon, Key, Pos2, Rect, Sense, Stroke, StrokeKind, Ui};
use glam::DVec2;

use crate::app::approximation::changes::{change, set, with_knots};
use crate::app::approximation::desk::Desk;
use crate::app::approximation::gesture::{Gesture, fine_steps, moved_knot, screen_box, snapped};
use crate::app::approximation::hit::{Target, target_at};
use crate::app::approximation::{context_menu, marks, start};
use crate::app::hands;
use crate::app::lab::{Hovered, Lab, Tool};
use crate::app::painter::{color32, paint_note, paint_picture};
use crate::document::{Approximation, Object, ObjectId, PlotWindow};
use crate::exchange::csv::read_csv;
use crate::figure::approximation::{Analysis, Layout, compose, error_text, fitted_window};
use crate::figure::chart::Chart;
use crate::figure::composition::GRID;
use crate::figure::picture::Picture;

/// A knot that is selected: the object, the method, the index in its list.
pub(super) type SelectedKnot = (ObjectId, usize, usize);

/// What is painted, as long as nothing of it changes.
#[derive(Debug)]
pub(super) struct Painted {
    pub(super) object: Arc<Object>,
    analysis: Arc<Analysis>,
    window: PlotWindow,
    size: DVec2,
    theme: &'static str,
    grid: bool,
    pub(super) layout: Layout,
    picture: Picture,
}

/// The canvas of approximations.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    rect: Option<Rect>,
    pub(super) painted: Option<Painted>,
    pub(super) gesture: Option<Gesture>,
    pub(super) knot: Option<SelectedKnot>,
    menu_target: Target,
    pub(super) panning: bool,
    pointer: Option<(f64, f64)>,
}

impl Canvas {
    /// Shows the canvas in all the room that is left and lets hands work on it.
    pub(super) fn show(&mut self, desk: &mut Desk, lab: &mut Lab, ui: &mut Ui) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Canvas"));
        self.rect = Some(rect);
        lab.canvas_size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        self.take_pasted_table(lab, ui);
        let selected = lab.selection.object.and_then(|id| lab.history.document().object(id));
        let Some(object) = selected.filter(|object| object.approximation().is_some()).cloned() else {
            (self.painted, self.gesture, self.pointer) = (None, None, None);
            ui.painter_at(rect).rect_filled(rect, 0.0, color32(lab.theme.background));
            start::show(lab, ui, rect);
            return;
        };
        self.update(&object, desk, lab, ui);
        self.move_camera(object.id, lab, &response, rect, ui);
        let Some(layout) = self.painted.as_ref().map(|painted| painted.layout.clone()) else { return };
        let hover = ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer());
        let page = hover.map(|at| page_from_screen(at, rect));
        self.pointer = page.filter(|&page| layout.main.contains(page)).map(|page| layout.main.numbers(page));
        let target = match (object.approximation(), page) {
            (Some(approximation), Some(page)) => target_at(approximation, &layout, page),
            _ => Target::Nothing,
        };
        self.use_hands(&object, &layout, lab, &response, rect, target, ui);
        self.nudge(&object, &layout, lab, ui);
        if let Target::Datum(index) = target {
            lab.hovering = Hovered::Point(object.id, index);
        }
        // What hands did is seen in the same frame.
        if let Some(object) = lab.history.document().object(object.id).cloned() {
            self.update(&object, desk, lab, ui);
            self.paint(&object, lab, rect, target, page, ui);
        }
        self.point_cursor(lab, target, hover, ui);
        if response.secondary_clicked() {
            self.menu_target = target;
        }
        if lab.tool != Tool::AddPoint {
            let target = self.menu_target;
            response.context_menu(|ui| context_menu::show(target, lab, ui));
        }
    }

    /// Composes the picture anew if anything of it has changed.
    fn update(&mut self, object: &Arc<Object>, desk: &mut Desk, lab: &mut Lab, ui: &Ui) {
        let Some(approximation) = object.approximation() else { return };
        let analysis = desk.analysis(object, ui.ctx());
        let known = lab.view.plots.get(&object.id).copied().filter(|window| window.check().is_ok());
        let window = known.unwrap_or_else(|| {
            let fitted = fitted_window(approximation, &analysis);
            // What is still being computed may need more room.
            if !desk.is_busy() && approximation.interval().is_some() {
                lab.view.plots.insert(object.id, fitted);
            }
            fitted
        });
        let grid = lab.view.panels.get(GRID).copied().unwrap_or(true);
        let (size, theme) = (lab.canvas_size, lab.theme.name);
        let holds = self.painted.as_ref().is_some_and(|painted| {
            Arc::ptr_eq(&painted.object, object)
                && Arc::ptr_eq(&painted.analysis, &analysis)
                && painted.window == window
                && (painted.size, painted.theme, painted.grid) == (size, theme, grid)
        });
        if holds {
            return;
        }
        let layout = Layout::new(approximation, &analysis, window, &lab.theme, size);
        let picture = compose(approximation, &analysis, &layout, &lab.theme, grid);
        let object = Arc::clone(object);
        self.painted = Some(Painted { object, analysis, window, size, theme, grid, layout, picture });
        let still_there = |(id, method, index): SelectedKnot| {
            let painted = self.painted.as_ref();
            let row = painted.and_then(|p| p.layout.rows.iter().find(|row| row.method == method));
            painted.is_some_and(|painted| painted.object.id == id)
                && row.is_some_and(|row| index < row.knots.len())
        };
        self.knot = self.knot.filter(|&knot| still_there(knot));
    }

    /// What the status line says: where the pointer is, or what hands can do.
    pub(super) fn status(&self, busy: bool, lab: &Lab) -> String {
        if busy {
            return "computing…".to_owned();
        }
        let Some((x, y)) = self.pointer else {
            let can_drag = lab.approximation().is_some_and(|data| request(data, lab).is_none());
            return if can_drag { HANDS.to_owned() } else { String::new() };
        };
        format!("x = {}, y = {}", error_text(x), error_text(y))
    }

    /// Everything that can be grabbed.
    pub(super) fn handles(&self, lab: &Lab) -> Vec<(String, Pos2)> {
        let (Some(rect), Some(painted)) = (self.rect, &self.painted) else { return Vec::new() };
        let Some(approximation) = lab.approximation() else { return Vec::new() };
        let named = marks::named(approximation, &painted.object.name, &painted.layout);
        named.into_iter().map(|(name, at)| (name, screen_from_page(at, rect))).collect()
    }

    /// Text from the clipboard that is a table becomes the data.
    fn take_pasted_table(&mut self, lab: &mut Lab, ui: &Ui) {
        if ui.text_edit_focused() {
            return;
        }
        let pasted = ui.input(|input| {
            input.events.iter().find_map(|event| match event {
                egui::Event::Paste(text) => Some(text.clone()),
                _ => None,
            })
        });
        let Some(text) = pasted else { return };
        match read_csv(&text) {
            Ok(table) => crate::app::approximation::take_table(lab, table, "the clipboard"),
            Err(error) => lab.problem(format!("The clipboard holds no table: {error}")),
        }
    }

    #[expect(clippy::too_many_arguments, reason = "what a frame of the canvas knows")]
    fn use_hands(
        &mut self,
        object: &Arc<Object>,
        layout: &Layout,
        lab: &mut Lab,
        response: &egui::Response,
        rect: Rect,
        target: Target,
        ui: &Ui,
    ) {
        let keys = ui.input(|input| input.modifiers);
        let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
        let page = page_from_screen(pointer, rect);
        let (down, released) =
            ui.input(|input| (input.pointer.primary_down(), input.pointer.primary_released()));
        if lab.tool == Tool::AddPoint {
            if response.clicked() && layout.main.contains(page) {
                add_point(page, layout, lab, keys.command || keys.ctrl);
            }
            return;
        }
        // On a knot it makes one more copy.
        let place = match target {
            Target::Row(method, at) => Some((method, at)),
            Target::Knot(method, index) => {
                let row = layout.rows.iter().find(|row| row.method == method);
                row.and_then(|row| row.knots.get(index)).map(|&at| (method, at))
            }
            _ => None,
        };
        if response.double_clicked()
            && let Some((method, at)) = place
        {
            self.gesture = None;
            self.insert_knot(object.id, method, at, layout, lab);
            return;
        }
        if let Some(at) = hands::pressed_at(ui)
            && rect.contains(at)
            && (response.contains_pointer() || response.is_pointer_button_down_on())
            && !self.panning
            && !ui.ctx().any_popup_open()
        {
            let at = page_from_screen(at, rect);
            let target = object.approximation().map_or(Target::Nothing, |data| target_at(data, layout, at));
            self.knot = match target {
                Target::Knot(method, index) => Some((object.id, method, index)),
                _ => None,
            };
            self.gesture = Gesture::press(target, object.id, at, layout, lab, keys);
        }
        if let Some(mut gesture) = self.gesture.take() {
            if down {
                gesture.drag(page, layout, lab, keys);
                self.gesture = Some(gesture);
            } else {
                if released {
                    gesture.drag(page, layout, lab, keys);
                }
                gesture.release(lab, keys);
            }
        }
    }

    fn insert_knot(&mut self, object: ObjectId, method: usize, at: f64, layout: &Layout, lab: &mut Lab) {
        let Some(row) = layout.rows.iter().find(|row| row.method == method) else { return };
        if let Some((left, right)) = row.ends
            && !(left < at && at < right)
        {
            lab.problem("A knot can only be inserted inside the interval");
            return;
        }
        let mut knots = row.knots.clone();
        let index = knots.partition_point(|&knot| knot <= at);
        knots.insert(index, at);
        let label = format!("Insert knot {}", error_text(at));
        if change(lab, label, |approximation| with_knots(approximation, method, knots)) {
            self.knot = Some((object, method, index));
        }
    }

    /// Arrow keys move the selected data or the selected knot by a fifth of the grid, Shift ten times, Ctrl a tenth of that.
    fn nudge(&mut self, object: &Arc<Object>, layout: &Layout, lab: &mut Lab, ui: &Ui) {
        let taken = ui.memory(|memory| memory.focused().is_some() || memory.top_modal_layer().is_some());
        if taken || (lab.selection.points.is_empty() && self.knot.is_none()) {
            return;
        }
        let Some(approximation) = object.approximation() else { return };
        for (key, direction) in [
            (Key::ArrowLeft, -DVec2::X),
            (Key::ArrowRight, DVec2::X),
            (Key::ArrowUp, DVec2::Y),
            (Key::ArrowDown, -DVec2::Y),
        ] {
            let pressed = ui.input_mut(|input| {
                let keys = input.modifiers;
                (!keys.alt && input.consume_key(keys, key)).then_some(keys)
            });
            let Some(keys) = pressed else { continue };
            let factor = match (keys.shift, keys.ctrl || keys.command) {
                (true, false) => 2.0,
                (false, true) => 0.02,
                _ => 0.2,
            };
            let [x_step, y_step] = fine_steps(&layout.main);
            let by = direction * DVec2::new(x_step, y_step) * factor;
            if let Some((_, method, index)) = self.knot {
                let row = layout.rows.iter().find(|row| row.method == method);
                let Some(row) = row.filter(|_| by.x != 0.0) else { continue };
                let Some(&from) = row.knots.get(index) else { continue };
                let (knots, _) = moved_knot(&row.knots, index, from + by.x, layout, method);
                if let Ok(changed) = with_knots(approximation, method, knots) {
                    lab.edit(set(object.id, changed, "Move knot"));
                }
            } else {
                let points: Vec<usize> = lab.selection.points.iter().copied().collect();
                let free = approximation.free_step(&points, by.x);
                change(lab, "Move data", |approximation| approximation.moved(&points, (free, by.y)));
            }
        }
    }

    fn paint(&self, object: &Object, lab: &Lab, rect: Rect, target: Target, page: Option<DVec2>, ui: &Ui) {
        let (Some(painted), Some(approximation)) = (&self.painted, object.approximation()) else { return };
        let painter = ui.painter_at(rect);
        let layout = &painted.layout;
        paint_picture(&painted.picture, &Chart::view(painted.size), rect, &painter);
        marks::paint(approximation, layout, lab, self.knot, target, rect, &painter);
        marks::announce(approximation, &object.name, layout, rect, ui);
        if let Some(page) = page
            && let Some((low, high)) = self.gesture.as_ref().and_then(|gesture| gesture.marquee(page))
        {
            let ink = color32(lab.theme.selection);
            let marquee = screen_box(low, high, rect);
            painter.rect(marquee, 0.0, ink.gamma_multiply(0.12), Stroke::new(1.0, ink), StrokeKind::Inside);
        }
        if let Some(request) = request(approximation, lab) {
            let middle = 0.5 * (layout.main.low.x + layout.main.high.x);
            let at = screen_from_page(DVec2::new(middle, layout.main.low.y + 10.0), rect);
            let size = 13.0 * lab.theme.text_scale as f32;
            let (ink, ground) = (lab.theme.muted_text, lab.theme.background);
            paint_note(&painter, at, Align2::CENTER_BOTTOM, request, size, ink, ground);
        }
    }

    fn point_cursor(&self, lab: &Lab, target: Target, pointer: Option<Pos2>, ui: &Ui) {
        if pointer.is_none() {
            return;
        }
        let grabbing = self.gesture.as_ref().is_some_and(|gesture| gesture.moved);
        ui.set_cursor_icon(match target {
            _ if self.panning => CursorIcon::Grabbing,
            _ if lab.tool == Tool::AddPoint => CursorIcon::Crosshair,
            _ if grabbing => CursorIcon::Grabbing,
            Target::Datum(_) => CursorIcon::Grab,
            Target::Knot(..) => CursorIcon::ResizeHorizontal,
            Target::Row(..) => CursorIcon::PointingHand,
            Target::Nothing | Target::FixedRow(_) => CursorIcon::Default,
        });
    }
}

fn add_point(page: DVec2, layout: &Layout, lab: &mut Lab, snap: bool) {
    let (mut x, mut y) = layout.main.numbers(page);
    if snap {
        let ([x_step, y_step], per_point) = (fine_steps(&layout.main), layout.main.per_point());
        (x, y) = (snapped(x, x_step, per_point.x), snapped(y, y_step, per_point.y));
    }
    let mut added = None;
    let done = change(lab, "Add datum", |approximation| {
        let (changed, index) = approximation.with_point(x, y)?;
        added = Some(index);
        Ok(changed)
    });
    if done {
        lab.selection.points = added.into_iter().collect();
        // The first points must not change what is looked at.
        if let Some(object) = lab.selection.object {
            let window = PlotWindow { x: layout.main.x, y: layout.main.y };
            lab.view.plots.entry(object).or_insert(window);
        }
    }
}

/// What hands can do.
const HANDS: &str = "Drag data and knots.  Double-click a line of knots to insert one.  The wheel zooms.";

/// What is to be done next, if there is little to see.
fn request(approximation: &Approximation, lab: &Lab) -> Option<&'static str> {
    if lab.tool == Tool::AddPoint {
        return Some("Click where data are to be; Ctrl snaps to the grid, Escape ends.");
    }
    if approximation.is_empty() && approximation.function().is_none() {
        return Some("Press A and click data, import or paste a table, or type a function on the right.");
    }
    approximation.methods().is_empty().then_some("Add a method on the right.")
}

/// The place of the page under a place of the screen.
pub(super) fn page_from_screen(at: Pos2, rect: Rect) -> DVec2 {
    DVec2::new(f64::from(at.x - rect.left()), f64::from(rect.bottom() - at.y))
}

/// The place of the screen for a place of the page.
pub(super) fn screen_from_page(page: DVec2, rect: Rect) -> Pos2 {
    let bound = |value: f64| value.clamp(-1e6, 1e6) as f32;
    rect.left_bottom() + egui::vec2(bound(page.x), -bound(page.y))
}
