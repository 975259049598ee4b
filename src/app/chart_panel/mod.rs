//! Charts of the selected curve beside the knot line: curvature, speed, x or y over t or the arc length, with a cursor at t.

mod cache;

use eframe::egui::{
    Align2, Button, Color32, CursorIcon, PointerButton, Pos2, Rect, Response, RichText, Role, Sense, Shape,
    Stroke, Ui, WidgetInfo, pos2, vec2,
};
use glam::DVec2;

use crate::app::CHARTS;
use crate::app::command::Command;
use crate::app::knot_line::header::parameter;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::short;
use crate::app::painter::{color32, paint_note, paint_picture, screen_from_world};
use crate::app::toolbar::button;
use crate::core::bspline::Side;
use crate::document::ObjectId;
use crate::figure::chart::{Chart, ChartArea};
use crate::figure::curve_chart::{CurveSamples, MANY_FUNCTIONS, Quantity};
use crate::figure::picture::Viewport;

pub use cache::ChartCache;

/// Size of an exported chart in pt.
const PAGE: DVec2 = DVec2::new(480.0, 300.0);

/// The most B-splines that an exported chart names.
const LEGEND: usize = 10;

/// In a narrower panel the choices stand closer.
const ROOMY: f32 = 760.0;

/// What the charts show.
#[derive(Debug, Default)]
pub struct Charts {
    /// What is drawn upwards.
    pub quantity: Quantity,
    /// Whether the arc length runs to the right, in place of t.
    pub over_length: bool,
    /// The samples of the last curve.
    pub(crate) cache: ChartCache,
}

/// Whether the panel shows charts in place of the knot line.
pub(crate) fn is_open(lab: &Lab) -> bool {
    lab.view.panels.get(CHARTS).copied().unwrap_or(false)
}

/// The two tabs of the panel.
pub(crate) fn tabs(lab: &mut Lab, ui: &mut Ui) {
    let open = is_open(lab);
    for (charts, name, hint) in [
        (false, "Knots", "Knots and B-splines of the selected curve"),
        (true, "Charts", "Curvature, speed and coordinates of the selected curve"),
    ] {
        if ui.selectable_label(open == charts, name).on_hover_text(hint).clicked() {
            lab.view.panels.insert(CHARTS.to_owned(), charts);
        }
    }
    ui.separator();
}

/// The chart of the selected curve.
#[derive(Debug)]
struct Scene {
    object: ObjectId,
    chart: Chart,
    area: ChartArea,
    view: Viewport,
    rect: Rect,
    over_length: bool,
}

impl Scene {
    fn x(&self, samples: &CurveSamples, t: f64) -> Option<f64> {
        if self.over_length { samples.sample(t, Side::Right)?.length } else { Some(t) }
    }

    /// The parameter at screen `x`, kept on the axis.
    fn parameter(&self, samples: &CurveSamples, x: f32) -> Option<f64> {
        let value = self.area.x_at(f64::from(x - self.rect.left())).clamp(self.area.x.0, self.area.x.1);
        if self.over_length { samples.length().ok()?.inverse(value).ok() } else { Some(value) }
    }

    /// The plot on the screen.
    fn plot(&self) -> Rect {
        let corner = |page| screen_from_world(&self.view, self.rect, page);
        Rect::from_two_pos(corner(self.area.low), corner(self.area.high))
    }
}

/// Shows the charts.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let object = lab.selection.object.and_then(|id| {
        let found = lab.history.document().object(id)?;
        let color = found.curve_display()?.color;
        Some((id, lab.charts.cache.samples(found)?, found.name.clone(), color))
    });
    let Some((object, samples, name, color)) = object else {
        ui.horizontal(|ui| tabs(lab, ui));
        ui.centered_and_justified(|ui| ui.label(RichText::new("Select a curve to see its charts").weak()));
        return;
    };
    header(lab, ui, object, &samples);
    let rect = ui.available_rect_before_wrap();
    if rect.width() < 120.0 || rect.height() < 56.0 {
        return;
    }
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let chart = samples.chart(lab.charts.quantity, lab.charts.over_length, &name, color, &lab.theme);
    let over_length = lab.charts.over_length && samples.length().is_ok();
    let area = chart.area(&lab.theme, size);
    let scene = Scene { object, chart, area, view: Chart::view(size), rect, over_length };
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Chart"));
    paint_picture(&scene.chart.to_picture(&lab.theme, size), &scene.view, rect, ui.painter());
    knots(lab, ui, &samples, &scene);
    hands(lab, &response, &samples, &scene);
    cursor(lab, ui, &samples, &scene);
}

fn header(lab: &mut Lab, ui: &mut Ui, object: ObjectId, samples: &CurveSamples) {
    ui.horizontal_wrapped(|ui| {
        if ui.available_width() < ROOMY * lab.theme.text_scale as f32 {
            ui.spacing_mut().button_padding.x = 4.0;
            ui.spacing_mut().item_spacing.x = 3.0;
        }
        tabs(lab, ui);
        let selected = lab.selected();
        let curve = selected.as_ref().and_then(|found| found.curve());
        if let Some((curve, t)) = curve.zip(lab.parameter(object)) {
            parameter(lab, ui, object, curve, t);
        }
        ui.separator();
        ui.spacing_mut().item_spacing.x = 3.0;
        for quantity in Quantity::ALL {
            let can = quantity != Quantity::Basis || samples.has_basis();
            let choice = Button::selectable(lab.charts.quantity == quantity, quantity.name());
            let choice = ui.add_enabled(can, choice);
            if choice
                .on_disabled_hover_text(format!("Drawn for up to {MANY_FUNCTIONS} control points"))
                .clicked()
            {
                lab.charts.quantity = quantity;
            }
        }
        ui.separator();
        let told = samples.length();
        let told =
            told.map(|length| format!("Over the length along the curve, {} in all", short(length.total())));
        let (can, over_length) = (told.is_ok(), lab.charts.over_length && told.is_ok());
        let hint = told.unwrap_or_else(|reason| format!("The arc length is {reason}"));
        for (length, word, name, hint) in [
            (false, "over t", "Over the parameter", "Over the parameter t"),
            (true, "over s", "Over the arc length", hint.as_str()),
        ] {
            let (enabled, on) = (can || !length, over_length == length);
            let choice = ui.add_enabled(enabled, Button::selectable(on, word));
            choice.widget_info(|| WidgetInfo::selected(Role::Button, enabled, on, name));
            if choice.on_hover_text(hint).on_disabled_hover_text(hint).clicked() {
                lab.charts.over_length = length;
            }
        }
        button("Export…", Command::ExportChart, lab, ui);
    });
}

/// Lines at the knots, which the chart itself does not know.
fn knots(lab: &Lab, ui: &Ui, samples: &CurveSamples, scene: &Scene) {
    let Some(curve) = lab.curve() else { return };
    let breaks = curve.space().breaks();
    let plot = scene.plot();
    if breaks.len() as f32 > plot.width() / 3.0 {
        return;
    }
    let pen = Stroke::new(1.0, color32(lab.theme.axis).gamma_multiply(0.45));
    for x in breaks.iter().filter_map(|&t| scene.x(samples, t)) {
        let x = screen_from_world(&scene.view, scene.rect, scene.area.page(x, 0.0)).x;
        ui.painter().extend(Shape::dashed_line(
            &[pos2(x, plot.top()), pos2(x, plot.bottom())],
            pen,
            2.0,
            3.0,
        ));
    }
}

/// A click or a drag sets t; what is under the pointer lights up on the canvas.
fn hands(lab: &mut Lab, response: &Response, samples: &CurveSamples, scene: &Scene) {
    let plot = scene.plot();
    if let Some(pointer) = response.hover_pos().filter(|&at| plot.contains(at) && response.hovered())
        && let Some(t) = scene.parameter(samples, pointer.x)
    {
        lab.hovering = Hovered::Curve(scene.object, t);
    }
    if let Some(pointer) = response.interact_pointer_pos()
        && (response.clicked() || response.dragged_by(PointerButton::Primary))
        && let Some(t) = scene.parameter(samples, pointer.x)
    {
        lab.set_parameter(scene.object, t);
    }
}

/// The line at t with its handle and its value, and a dashed one at the place under the pointer.
fn cursor(lab: &mut Lab, ui: &mut Ui, samples: &CurveSamples, scene: &Scene) {
    let plot = scene.plot();
    let place = |t: f64| {
        let x = scene.x(samples, t)?;
        let value = lab.charts.quantity.of(&samples.sample(t, Side::Right)?);
        let at = screen_from_world(&scene.view, scene.rect, scene.area.page(x, value));
        Some((at.x, (value.is_finite() && plot.y_range().contains(at.y)).then_some(at)))
    };
    let accent = color32(lab.theme.accent);
    let dot = |ui: &Ui, at, color: Color32| {
        let rim = Stroke::new(1.2, color32(lab.theme.background));
        ui.painter().circle(at, 4.0 * lab.theme.stroke_scale as f32, color, rim);
    };
    if let Hovered::Curve(object, t) = lab.hovered
        && object == scene.object
        && let Some((x, at)) = place(t)
    {
        let pen = Stroke::new(1.0, accent.gamma_multiply(0.6));
        let ends = [pos2(x, plot.top()), pos2(x, plot.bottom())];
        ui.painter().extend(Shape::dashed_line(&ends, pen, 3.0, 3.0));
        if let Some(at) = at {
            dot(ui, at, accent.gamma_multiply(0.6));
        }
    }
    let Some((x, at)) = lab.parameter(scene.object).and_then(place) else { return };
    ui.painter().vline(x, plot.y_range(), Stroke::new(1.4, accent));
    if let Some(at) = at {
        dot(ui, at, accent);
        note(lab, ui, samples, scene, at);
    }
    let handle = Rect::from_center_size(pos2(x, plot.top() + 6.0), vec2(16.0, 16.0));
    let response = ui.interact(handle, ui.make_persistent_id("cursor of the chart"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Cursor of the chart"));
    let half = if response.hovered() || response.dragged() { 6.5 } else { 5.0 };
    let top = plot.top();
    let flag = vec![pos2(x - half, top), pos2(x + half, top), pos2(x, top + 1.6 * half)];
    ui.painter().add(Shape::convex_polygon(flag, accent, Stroke::NONE));
    if response.dragged_by(PointerButton::Primary)
        && let Some(pointer) = response.interact_pointer_pos()
        && let Some(t) = scene.parameter(samples, pointer.x)
    {
        lab.set_parameter(scene.object, t);
    }
    response.on_hover_cursor(CursorIcon::ResizeHorizontal);
}

/// The value at t, on the side of the dot where there is more room.
fn note(lab: &Lab, ui: &Ui, samples: &CurveSamples, scene: &Scene, at: Pos2) {
    let plot = scene.plot();
    let sample = lab.parameter(scene.object).and_then(|t| samples.sample(t, Side::Right));
    let Some(sample) = sample else { return };
    let quantity = lab.charts.quantity;
    if quantity == Quantity::Basis {
        return;
    }
    let text = format!("{} = {}", quantity.sign(), short(quantity.of(&sample)));
    let (align, shift) =
        if at.x < plot.center().x { (Align2::LEFT_CENTER, 16.0) } else { (Align2::RIGHT_CENTER, -16.0) };
    // Away from the dot, where the line is not.
    let y = if at.y > plot.center().y { plot.top() + 12.0 } else { plot.bottom() - 12.0 };
    let size = 12.0 * lab.theme.text_scale as f32;
    paint_note(
        ui.painter(),
        pos2(at.x + shift, y),
        align,
        &text,
        size,
        lab.theme.accent,
        lab.theme.background,
    );
}

/// The chart that is shown, for a page of its own, and its table.
pub(crate) fn page(lab: &Lab) -> Option<(Chart, DVec2, String)> {
    let object = lab.history.document().object(lab.selection.object?)?;
    let samples = lab.charts.cache.samples(object)?;
    let color = object.curve_display()?.color;
    let quantity = lab.charts.quantity;
    let mut chart = samples.chart(quantity, lab.charts.over_length, &object.name, color, &lab.theme);
    // On paper nothing but the legend tells which is which.
    if quantity == Quantity::Basis && chart.series.len() <= LEGEND {
        for (k, series) in chart.series.iter_mut().enumerate() {
            series.name = format!("$b_{{{k}}}$");
        }
    }
    Some((chart, PAGE, samples.csv(quantity)))
}
