//! The basis functions over D, the cursor of the parameter, and what can be done with the mouse on the empty axis.

use eframe::egui::{
    Align2, Color32, CursorIcon, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

use crate::app::command::Command;
use crate::app::knot_line::hand::context_menu;
use crate::app::knot_line::{Scene, basis, builder};
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{NumberEvent, NumberField};
use crate::app::number_text::{round_to_step, short};
use crate::app::painter::{color32, paint_note};
use crate::document::Edit;

/// A function is under the pointer within this distance in points.
const REACH: f32 = 7.0;

/// Shows the functions, or the builder in their place, and the parameter.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, scene: &Scene) {
    ground(lab, ui, scene);
    if lab.knots.builder.is_some() {
        builder::show(lab, ui, scene);
        cursor(lab, ui, scene);
        return;
    }
    let (graphs, too_many) = basis::graphs(scene.curve, &scene.axis, scene.t);
    paint_graphs(lab, ui, scene, &graphs);
    if too_many {
        let text = format!(
            "{} B-splines: only the active ones are drawn, zoom in to see the others",
            scene.curve.points().len()
        );
        let at = scene.plot.center_top() + vec2(0.0, 4.0);
        paint_note(
            ui.painter(),
            at,
            Align2::CENTER_TOP,
            &text,
            11.0,
            lab.theme.muted_text,
            lab.theme.background,
        );
    }
    cursor(lab, ui, scene);
}

/// D shaded, hatching beyond, the axis.
fn ground(lab: &Lab, ui: &Ui, scene: &Scene) {
    let (left, right) = scene.curve.space().parameter_interval();
    let (from, to) = (scene.axis.x(left).max(scene.plot.left()), scene.axis.x(right).min(scene.plot.right()));
    let painter = ui.painter_at(scene.plot.union(scene.strip));
    let inside = Rect::from_min_max(pos2(from, scene.plot.top()), pos2(to, scene.plot.bottom()));
    painter.rect_filled(inside, 0.0, color32(lab.theme.background));
    for (a, b) in [(scene.plot.left(), from), (to, scene.plot.right())] {
        if b > a {
            hatch(
                &ui.painter_at(Rect::from_min_max(pos2(a, scene.plot.top()), pos2(b, scene.plot.bottom()))),
                lab,
            );
        }
    }
    if let Ok(span) = scene.curve.space().span(scene.t) {
        let knots = scene.curve.space().evaluation_knots();
        let (a, b) = (scene.axis.x(knots[span]), scene.axis.x(knots[span + 1]));
        let active =
            Rect::from_min_max(pos2(a, scene.plot.top()), pos2(b, scene.plot.bottom())).intersect(scene.plot);
        painter.rect_filled(active, 0.0, color32(lab.theme.accent.with_opacity(0.06)));
    }
    painter.hline(from..=to, scene.y(1.0), Stroke::new(1.0, color32(lab.theme.grid)));
    painter.hline(scene.plot.x_range(), scene.plot.bottom(), Stroke::new(1.0, color32(lab.theme.axis)));
}

fn hatch(painter: &eframe::egui::Painter, lab: &Lab) {
    let rect = painter.clip_rect();
    let pen = Stroke::new(1.0, color32(lab.theme.grid_major));
    let height = rect.height();
    let mut x = rect.left() - height;
    while x < rect.right() {
        painter.line_segment([pos2(x, rect.bottom()), pos2(x + height, rect.top())], pen);
        x += 7.0;
    }
}

/// The control point whose function runs through the pointer.
fn function_under(scene: &Scene, response: &Response) -> Option<usize> {
    let pointer = response.hover_pos().filter(|&at| scene.plot.contains(at))?;
    let parameter = scene.axis.parameter(pointer.x);
    let parameter = scene.curve.space().reduce(parameter).ok()?;
    let active = basis::active(scene.curve, parameter);
    let distance = |value: f64| (scene.y(value) - pointer.y).abs();
    active
        .coefficients
        .iter()
        .zip(&active.values)
        .filter(|&(_, &value)| value > 0.01 && distance(value) <= REACH)
        .min_by(|a, b| distance(*a.1).total_cmp(&distance(*b.1)))
        .map(|(&k, _)| k)
}

fn paint_graphs(lab: &Lab, ui: &Ui, scene: &Scene, graphs: &[basis::Graph]) {
    let painter = ui.painter_at(scene.plot.expand2(vec2(0.0, 2.0)));
    let any_lit = scene.any_lit(lab);
    let scale = lab.theme.stroke_scale as f32;
    // Lit functions last, so that nothing lies over them.
    for pass in [false, true] {
        for graph in graphs {
            let k = graph.coefficient;
            let lit = scene.is_lit(lab, k) || lab.selection.points.contains(&k);
            if lit != pass {
                continue;
            }
            let active = scene.active.coefficients.contains(&k);
            let opacity = match (any_lit && !scene.is_lit(lab, k), active) {
                (true, _) => 0.25,
                (false, true) => 1.0,
                (false, false) => 0.55,
            };
            let color = Scene::color(lab, k).gamma_multiply(opacity);
            let pen = Stroke::new(
                if lit {
                    2.8
                } else if active {
                    1.8
                } else {
                    1.3
                } * scale,
                color,
            );
            for shift in repetitions(scene) {
                let fade = if shift == 0.0 { 1.0 } else { 0.35 };
                let pen = Stroke::new(pen.width, pen.color.gamma_multiply(fade));
                let line: Vec<Pos2> = graph
                    .points
                    .iter()
                    .map(|&(t, value)| pos2(scene.axis.x(t + shift), scene.y(value)))
                    .collect();
                if scene.is_lit(lab, k) {
                    fill(&painter, scene, &line, color.gamma_multiply(0.13 * fade));
                }
                painter.add(Shape::line(line, pen));
            }
        }
    }
    for (&k, &value) in scene.active.coefficients.iter().zip(&scene.active.values) {
        let at = pos2(scene.axis.x(scene.t), scene.y(value));
        let radius = if scene.is_lit(lab, k) { 5.0 } else { 3.5 };
        let rim = Stroke::new(1.2, color32(lab.theme.background));
        painter.circle(at, radius * scale, Scene::color(lab, k), rim);
    }
}

/// Shifts at which everything is drawn: once, or with the neighbouring periods.
fn repetitions(scene: &Scene) -> Vec<f64> {
    match scene.curve.space().period() {
        None => vec![0.0],
        Some(period) => vec![-period, 0.0, period],
    }
}

fn fill(painter: &eframe::egui::Painter, scene: &Scene, line: &[Pos2], color: Color32) {
    let mut mesh = eframe::egui::Mesh::default();
    for pair in line.windows(2) {
        let first = mesh.vertices.len() as u32;
        for at in
            [pair[0], pair[1], pos2(pair[0].x, scene.plot.bottom()), pos2(pair[1].x, scene.plot.bottom())]
        {
            mesh.colored_vertex(at, color);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first + 1, first + 2, first + 3);
    }
    painter.add(Shape::mesh(mesh));
}

/// The line at t with its handle.
fn cursor(lab: &mut Lab, ui: &mut Ui, scene: &Scene) {
    let x = scene.axis.x(scene.t);
    if !scene.plot.x_range().expand(1.0).contains(x) {
        return;
    }
    let handle = Rect::from_center_size(pos2(x, scene.plot.top() + 6.0), vec2(16.0, 16.0));
    let response = ui.interact(handle, ui.make_persistent_id("cursor of t"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Cursor of t"));
    if response.dragged_by(PointerButton::Primary)
        && !scene.busy
        && let Some(pointer) = response.interact_pointer_pos()
    {
        lab.set_parameter(scene.object, scene.axis.parameter(pointer.x));
    }
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    let accent = color32(lab.theme.accent);
    let painter = ui.painter();
    painter.vline(x, scene.plot.y_range(), Stroke::new(1.4, accent));
    let top = scene.plot.top();
    let half = if response.hovered() || response.dragged() { 6.5 } else { 5.0 };
    let flag = vec![pos2(x - half, top), pos2(x + half, top), pos2(x, top + 1.6 * half)];
    painter.add(Shape::convex_polygon(flag, accent, Stroke::NONE));
    if let Hovered::Curve(object, t) = lab.hovered
        && object == scene.object
    {
        let dashes = Shape::dashed_line(
            &[pos2(scene.axis.x(t), scene.plot.top()), pos2(scene.axis.x(t), scene.plot.bottom())],
            Stroke::new(1.0, accent.gamma_multiply(0.6)),
            3.0,
            3.0,
        );
        painter.extend(dashes);
    }
}

/// What the mouse does beside the knots; `response` is the area of the whole knot line.
pub(super) fn interact(lab: &mut Lab, ui: &Ui, scene: &Scene, response: &Response) {
    if lab.knots.builder.is_some() {
        builder::interact(lab, scene, response);
        note_place(ui, scene, response);
        menu(lab, scene, response);
        return;
    }
    let near = function_under(scene, response);
    let over = response.hover_pos().filter(|at| scene.plot.union(scene.strip).contains(*at));
    let (left, right) = scene.curve.space().parameter_interval();
    if let Some(pointer) = over.filter(|_| response.hovered()) {
        let parameter = scene.axis.parameter(pointer.x);
        lab.hovering = match near {
            Some(k) => Hovered::Point(scene.object, k),
            None if (left..=right).contains(&parameter) => Hovered::Curve(scene.object, parameter),
            None => lab.hovering,
        };
    }
    if let Some(k) = near.filter(|_| response.clicked()) {
        choose(lab, ui, k);
    } else {
        set_t(lab, scene, response);
    }
    note_place(ui, scene, response);
    menu(lab, scene, response);
}

/// Selects control point `k` by its function; with Shift it is added.
pub(super) fn choose(lab: &mut Lab, ui: &Ui, k: usize) {
    if !ui.input(|input| input.modifiers.shift) {
        lab.selection.points.clear();
    }
    lab.selection.points.insert(k);
    lab.selection.knot = None;
}

/// A click or a drag on empty ground sets t, a double click inserts a knot.
pub(super) fn set_t(lab: &mut Lab, scene: &Scene, response: &Response) {
    let range = scene.plot.union(scene.strip).x_range();
    let Some(pointer) = response.interact_pointer_pos().filter(|at| range.contains(at.x)) else { return };
    let parameter = scene.axis.parameter(pointer.x);
    if response.double_clicked() {
        insert(lab, scene, round_to_step(parameter, scene.axis.per_pixel()));
    } else if response.clicked() || response.dragged_by(PointerButton::Primary) {
        lab.set_parameter(scene.object, parameter);
    }
}

fn note_place(ui: &Ui, scene: &Scene, response: &Response) {
    if let Some(pointer) = response.interact_pointer_pos() {
        note_menu_place(ui, response, round_to_step(scene.axis.parameter(pointer.x), scene.axis.per_pixel()));
    }
}

/// Where a menu that opens now would insert a knot.
pub(super) fn note_menu_place(ui: &Ui, response: &Response, at: f64) {
    if response.secondary_clicked() {
        ui.data_mut(|data| data.insert_temp(response.id.with("menu place"), at));
    }
}

pub(super) fn insert(lab: &mut Lab, scene: &Scene, at: f64) {
    let at = scene.curve.space().reduce(at).unwrap_or(at);
    if lab.edit(Edit::InsertKnot { object: scene.object, at }).is_some() {
        lab.selection.knot = Some(at);
    }
}

pub(super) fn menu(lab: &mut Lab, scene: &Scene, response: &Response) {
    let place = response.id.with("menu place");
    context_menu(response, |ui| {
        let at = ui.data(|data| data.get_temp::<f64>(place)).unwrap_or(scene.t);
        let inside = scene.curve.space().reduce(at).is_ok();
        if ui
            .add_enabled(inside, eframe::egui::Button::new(format!("Insert knot at {}", short(at))))
            .clicked()
        {
            insert(lab, scene, at);
            ui.close();
        }
        if ui.button(format!("Insert knot at t = {}", short(scene.t))).clicked() {
            insert(lab, scene, scene.t);
            ui.close();
        }
        ui.horizontal(|ui| {
            ui.label("Insert at");
            let field = NumberField::new("New knot", at).show(ui, "new knot");
            if let Some(NumberEvent::Typed { to: value, .. }) = field.event {
                insert(lab, scene, value);
                ui.close();
            }
        });
        ui.separator();
        if ui.button(Command::RefineUniformly.text().0).clicked() {
            lab.commands.push(Command::RefineUniformly);
            ui.close();
        }
    });
}
