//! The room of homogeneous coordinates: a picture of space that is turned by dragging, points that are dragged along their
//! rays, and the weights as sliders and numbers.

use std::collections::BTreeSet;

use eframe::egui::{self, Grid, Key, Pos2, Rect, RichText, ScrollArea, Sense, Slider, StrokeKind, Ui, vec2};
use glam::DVec2;

use crate::app::hands;
use crate::app::inspector::copyable;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{self, Drag, NumberField, positive};
use crate::app::number_text::short;
use crate::app::painter::{color32, paint_note, paint_picture};
use crate::app::side_rooms::space::{Held, Space, WEIGHTS};
use crate::app::side_rooms::subject;
use crate::core::spline_curve::Nurbs;
use crate::document::{Edit, ObjectId};
use crate::figure::picture::Viewport;
use crate::figure::scene::EyeView;

/// Distance in pt up to which a point is under the pointer.
const REACH: f32 = 10.0;
/// Turn of the eye by one pixel.
const TURN: f64 = 0.008;
/// Weights that the sliders reach.
const SLIDER: std::ops::RangeInclusive<f64> = 0.05..=20.0;
/// So many weights are listed at most; the others are reached by selecting their points.
const LISTED: usize = 24;

/// Shows the room.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    let Some((object, curve)) = subject(lab, ui, "to see it in homogeneous coordinates") else { return };
    let Some(t) = lab.parameter(object) else { return };
    let width = ui.available_width();
    let height = (ui.available_height() - 250.0).clamp(160.0, width * 1.25);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Homogeneous space"));
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let mut space = lab
        .rooms
        .space
        .filter(|space| space.object == object)
        .unwrap_or_else(|| Space::fitting(object, &curve, size));
    let view = EyeView { eye: space.eye, size };
    let pages: Vec<Option<Pos2>> = curve
        .points()
        .iter()
        .zip(curve.weights())
        .map(|(&at, &weight)| {
            let page = view.project(space.lift(at, weight))?.page;
            Some(rect.min + vec2(page.x as f32, page.y as f32))
        })
        .collect();
    let under = |pointer: Pos2| {
        let near =
            pages.iter().enumerate().filter_map(|(k, page)| Some((k, page.as_ref()?.distance(pointer))));
        near.filter(|&(_, far)| far <= REACH).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    };
    drag(lab, ui, (object, &curve), &mut space, &response, under);
    let hovered = response.hover_pos().and_then(under);
    if let Some(point) = hovered {
        lab.hovering = Hovered::Point(object, point);
        ui.ctx().set_cursor_icon(egui::CursorIcon::Grab);
    }
    let mut lit: Vec<usize> = lab.selection.points.iter().copied().collect();
    match lab.hovered {
        Hovered::Point(id, point) if id == object => lit.push(point),
        _ => {}
    }
    let painter = ui.painter_at(rect);
    painter.rect(
        rect,
        4.0,
        color32(lab.theme.background),
        egui::Stroke::new(1.0, color32(lab.theme.grid_major)),
        StrokeKind::Inside,
    );
    let viewport = Viewport { center: size * 0.5, scale: 1.0, size };
    let picture = space.picture(lab.curve().unwrap_or(&curve), t, &lit, size, &lab.theme);
    paint_picture(&picture, &viewport, rect, &painter);
    if let Some(Held::Point(point, _)) = space.held
        && let Some(&weight) = lab.curve().and_then(|curve| curve.weights().get(point))
        && let Some(at) = pages.get(point).copied().flatten()
    {
        let (ink, ground) = (lab.theme.text, lab.theme.background);
        let text = format!("w = {}", short(weight));
        paint_note(&painter, at + vec2(14.0, 0.0), egui::Align2::LEFT_CENTER, &text, 12.0, ink, ground);
    }
    announce(ui, rect, &pages);
    lab.rooms.space = Some(space);
    ui.horizontal(|ui| {
        if ui.button("Fit").on_hover_text("The view from the beginning").clicked() {
            lab.rooms.space = None;
        }
        ui.label(RichText::new("drag: turn, wheel: nearer, points: along their rays").weak().small());
    });
    let text = "The upper curve is (w x, w y, w). Its rays to the origin carry it to the plane w = 1, which shows the curve.";
    ui.label(RichText::new(text).weak().small());
    numbers(lab, ui, object, t);
}

/// Turns, zooms, and drags points along their rays.
fn drag(
    lab: &mut Lab,
    ui: &Ui,
    (object, curve): (ObjectId, &Nurbs<DVec2>),
    space: &mut Space,
    response: &egui::Response,
    under: impl Fn(Pos2) -> Option<usize>,
) {
    let rect = response.rect;
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let page = |at: Pos2| DVec2::new(f64::from(at.x - rect.left()), f64::from(at.y - rect.top()));
    let (down, pointer, moved, scroll, escape) = ui.input(|input| {
        (
            input.pointer.primary_down(),
            input.pointer.latest_pos(),
            input.pointer.delta(),
            input.smooth_scroll_delta().y,
            input.key_pressed(Key::Escape),
        )
    });
    if let Some(at) = hands::pressed_at(ui).filter(|at| rect.contains(*at) && response.contains_pointer()) {
        space.held = Some(under(at).map_or(Held::Eye, |point| {
            lab.selection.points = BTreeSet::from([point]);
            let pointed = space.weight_under(curve.points()[point], page(at), size);
            Held::Point(point, curve.weights()[point] - pointed.unwrap_or(curve.weights()[point]))
        }));
    }
    match (space.held, pointer) {
        (Some(Held::Eye), _) if down => {
            space.eye = space.eye.orbited(-f64::from(moved.x) * TURN, f64::from(moved.y) * TURN);
        }
        (Some(Held::Point(..)), _) if escape => {
            lab.history.cancel();
            space.held = None;
        }
        (Some(Held::Point(point, offset)), Some(pointer)) if point < curve.points().len() => {
            let weight = space.weight_under(curve.points()[point], page(pointer), size);
            let weight = weight.map(|weight| (weight + offset).clamp(WEIGHTS.0, WEIGHTS.1));
            if let Some(weight) = weight.filter(|_| moved.length() > 0.0) {
                lab.begin("Change weight");
                lab.update(Edit::SetWeight { object, point, weight });
            }
        }
        _ => {}
    }
    if !down
        && let Some(held) = space.held.take()
        && matches!(held, Held::Point(..))
    {
        lab.commit();
    }
    if scroll != 0.0 && response.contains_pointer() {
        let view = EyeView { eye: space.eye, size };
        space.eye = view.zoomed(size * 0.5, (f64::from(scroll) / 240.0).exp());
    }
}

/// Tells assistive programs (and tests) what can be dragged.
fn announce(ui: &Ui, rect: Rect, pages: &[Option<Pos2>]) {
    for (k, page) in pages.iter().enumerate().take(100) {
        let area = page.map(|page| Rect::from_center_size(page, vec2(2.0 * REACH, 2.0 * REACH)));
        if let Some(area) = area.filter(|area| rect.contains_rect(*area)) {
            let response = ui.interact(area, ui.make_persistent_id(("homogeneous", k)), Sense::hover());
            let name = format!("Homogeneous point {k}");
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        }
    }
}

/// The point at t in both ways of writing, and the weights.
fn numbers(lab: &mut Lab, ui: &mut Ui, object: ObjectId, t: f64) {
    let selected = lab.selected();
    let Some(curve) = selected.as_ref().and_then(|found| found.curve()) else { return };
    if let Ok(at) = curve.homogeneous().evaluate(t) {
        Grid::new("both ways").num_columns(2).spacing([8.0, 2.0]).show(ui, |ui| {
            let ways =
                [("In space", vec![at.x, at.y, at.z]), ("In the plane", vec![at.x / at.z, at.y / at.z])];
            for (name, numbers) in ways {
                ui.label(RichText::new(name).weak()).on_hover_text(format!("The point at t = {}", short(t)));
                copyable(lab, ui, name, &numbers);
                ui.end_row();
            }
        });
    }
    let all = 0..curve.points().len();
    let shown: Vec<usize> = if lab.selection.points.is_empty() {
        all.take(LISTED).collect()
    } else {
        all.filter(|k| lab.selection.points.contains(k)).take(LISTED).collect()
    };
    ScrollArea::vertical().id_salt("weights in space").auto_shrink([false, false]).show(ui, |ui| {
        for point in shown {
            ui.horizontal(|ui| weight(lab, ui, object, point, curve.weights()[point]));
        }
        if !lab.selection.points.is_empty() && ui.small_button("All weights").clicked() {
            lab.selection.points.clear();
        }
    });
}

fn weight(lab: &mut Lab, ui: &mut Ui, object: ObjectId, point: usize, now: f64) {
    ui.label(format!("w{}", subscript(point)));
    let label = format!("Weight {point} in space");
    let field = NumberField::new(&label, now).width(64.0).drag(Drag::Factor).check(positive);
    let event = field.show(ui, ("weight in space", point)).event;
    number_field::apply(lab, event, "Change weight", |_, weight| Edit::SetWeight { object, point, weight });
    let mut slid = now;
    ui.spacing_mut().slider_width = (ui.available_width() - 14.0).max(40.0);
    let slider = ui.add(Slider::new(&mut slid, SLIDER).logarithmic(true).show_value(false));
    let slider = slider.accessible_name(format!("Slider of weight {point}"));
    if slider.changed() && slid != now {
        lab.begin("Change weight");
        lab.update(Edit::SetWeight { object, point, weight: slid });
    }
    if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
        lab.commit();
    }
    if slider.hovered() {
        lab.hovering = Hovered::Point(object, point);
    }
}

/// The digits of `number` as subscripts.
fn subscript(number: usize) -> String {
    let lowered = |digit: u32| char::from_u32(0x2080 + digit);
    number.to_string().chars().filter_map(|sign| sign.to_digit(10).and_then(lowered)).collect()
}
