//! The control points as numbers: the selected ones to drag, all of them in a table.

use std::collections::BTreeSet;

use eframe::egui::{Frame, RichText, Role, ScrollArea, Sense, Ui, WidgetInfo, vec2};
use glam::DVec2;

use crate::app::inspector::Subject;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{self, Drag, NumberField, positive};
use crate::app::painter::color32;
use crate::document::Edit;

/// Most rows of the table that are seen at once.
const ROWS: usize = 8;

/// The selected points, to drag and type.
pub(super) fn show_selected(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let count = subject.curve.points().len();
    let selected: Vec<usize> = lab.selection.points.iter().copied().filter(|&point| point < count).collect();
    let Some(&first) = selected.first() else { return };
    let frame = Frame::group(ui.style()).inner_margin(6.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        if selected.len() == 1 {
            ui.label(RichText::new(format!("Point {first}")).strong());
            one(lab, ui, subject, first);
        } else {
            ui.label(RichText::new(format!("{} points, their centre", selected.len())).strong());
            several(lab, ui, subject, &selected);
        }
    });
}

/// Width of one of three number fields with their letters in front.
fn field_width(ui: &Ui) -> f32 {
    ((ui.available_width() - 3.0 * 16.0 - 2.0 * 8.0) / 3.0).clamp(40.0, 110.0)
}

/// World length of a pixel on the canvas.
fn per_pixel(lab: &Lab) -> f64 {
    let step = 1.0 / lab.view.camera.scale;
    if step.is_finite() && step > 0.0 { step } else { 0.01 }
}

fn letter(ui: &mut Ui, text: &str) {
    ui.spacing_mut().item_spacing.x = 4.0;
    ui.label(RichText::new(text).weak().italics());
}

fn one(lab: &mut Lab, ui: &mut Ui, subject: &Subject, point: usize) {
    let (object, width, step) = (subject.object, field_width(ui), per_pixel(lab));
    let place = subject.curve.points()[point];
    ui.horizontal(|ui| {
        letter(ui, "x");
        let x = NumberField::new("x of the selected point", place.x).width(width).drag(Drag::PerPixel(step));
        let x = x.show(ui, ("selected x", object, point));
        number_field::apply(lab, x.event, "Move point", |_, x| Edit::SetPoint {
            object,
            point,
            position: DVec2::new(x, place.y),
        });
        letter(ui, "y");
        let y = NumberField::new("y of the selected point", place.y).width(width).drag(Drag::PerPixel(step));
        let y = y.show(ui, ("selected y", object, point));
        number_field::apply(lab, y.event, "Move point", |_, y| Edit::SetPoint {
            object,
            point,
            position: DVec2::new(place.x, y),
        });
        letter(ui, "w");
        let weight = subject.curve.weights()[point];
        let w = NumberField::new("Weight of the selected point", weight)
            .width(width)
            .drag(Drag::Factor)
            .check(positive);
        let w = w.show(ui, ("selected weight", object, point));
        number_field::apply(lab, w.event, "Change weight", |_, weight| Edit::SetWeight {
            object,
            point,
            weight,
        });
    });
}

fn several(lab: &mut Lab, ui: &mut Ui, subject: &Subject, selected: &[usize]) {
    let (object, width, step) = (subject.object, field_width(ui), per_pixel(lab));
    let places = subject.curve.points();
    let centre = selected.iter().map(|&point| places[point] / selected.len() as f64).sum::<DVec2>();
    let moved = |delta: DVec2| Edit::MovePoints { object, points: selected.to_vec(), delta };
    let name = format!("Move {} points", selected.len());
    ui.horizontal(|ui| {
        letter(ui, "x");
        let x = NumberField::new("x of the centre of the selected points", centre.x).width(width);
        let x = x.drag(Drag::PerPixel(step)).show(ui, ("centre x", object));
        number_field::apply(lab, x.event, &name, |from, to| moved(DVec2::new(to - from, 0.0)));
        letter(ui, "y");
        let y = NumberField::new("y of the centre of the selected points", centre.y).width(width);
        let y = y.drag(Drag::PerPixel(step)).show(ui, ("centre y", object));
        number_field::apply(lab, y.event, &name, |from, to| moved(DVec2::new(0.0, to - from)));
        letter(ui, "w");
        let weights = subject.curve.weights();
        let first = weights[selected[0]];
        let same = selected.iter().all(|&point| weights[point].to_bits() == first.to_bits());
        let label = if same {
            "Weight of the selected points"
        } else {
            "Weight of the selected points, now different"
        };
        let w = NumberField::new(label, first).width(width).drag(Drag::Factor).check(positive);
        let w = w.show(ui, ("common weight", object));
        if !same {
            w.response.on_hover_text("The weights differ; this is the first of them");
        }
        number_field::apply(lab, w.event, "Change weights", |_, weight| {
            let mut all = weights.to_vec();
            for &point in selected {
                all[point] = weight;
            }
            Edit::SetWeights { object, weights: all }
        });
    });
}

/// All control points.
pub(super) fn show_table(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let count = subject.curve.points().len();
    let scroll_bar = 12.0;
    let head = 44.0;
    let width = ((ui.available_width() - head - scroll_bar - 3.0 * 4.0) / 3.0).max(36.0);
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.allocate_exact_size(vec2(head, 14.0), Sense::hover());
        for title in ["x", "y", "weight"] {
            let (rect, _) = ui.allocate_exact_size(vec2(width, 14.0), Sense::hover());
            let ink = ui.visuals().weak_text_color();
            let font = eframe::egui::FontId::proportional(11.0);
            let at = rect.right_center() - vec2(5.0, 0.0);
            ui.painter().text(at, eframe::egui::Align2::RIGHT_CENTER, title, font, ink);
        }
    });
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        let most = (height + 2.0) * ROWS as f32;
        ScrollArea::vertical().id_salt("points").max_height(most).auto_shrink([false, true]).show_rows(
            ui,
            height,
            count,
            |ui, range| {
                for point in range {
                    row(lab, ui, subject, point, head, width);
                }
            },
        );
    });
}

fn row(lab: &mut Lab, ui: &mut Ui, subject: &Subject, point: usize, head: f32, width: f32) {
    let object = subject.object;
    let place = subject.curve.points()[point];
    let weight = subject.curve.weights()[point];
    let line = ui.horizontal(|ui| {
        index(lab, ui, subject, point, head);
        let label = format!("x of point {point}");
        let x = NumberField::new(&label, place.x).width(width).show(ui, ("x", object, point));
        number_field::apply(lab, x.event, "Move point", |_, x| Edit::SetPoint {
            object,
            point,
            position: DVec2::new(x, place.y),
        });
        let label = format!("y of point {point}");
        let y = NumberField::new(&label, place.y).width(width).show(ui, ("y", object, point));
        number_field::apply(lab, y.event, "Move point", |_, y| Edit::SetPoint {
            object,
            point,
            position: DVec2::new(place.x, y),
        });
        let label = format!("Weight of point {point}");
        let w = NumberField::new(&label, weight).width(width).check(positive).show(ui, ("w", object, point));
        number_field::apply(lab, w.event, "Change weight", |_, weight| Edit::SetWeight {
            object,
            point,
            weight,
        });
    });
    if ui.rect_contains_pointer(line.response.rect) {
        lab.hovering = Hovered::Point(object, point);
    }
}

/// Dot and number of the point; a click selects it, Shift adds.
fn index(lab: &mut Lab, ui: &mut Ui, subject: &Subject, point: usize, head: f32) {
    let (rect, response) = ui.allocate_exact_size(vec2(head, ui.spacing().interact_size.y), Sense::click());
    let selected = lab.selection.points.contains(&point);
    response
        .widget_info(|| WidgetInfo::selected(Role::Button, true, selected, format!("Select point {point}")));
    let lit = lab.hovered == Hovered::Point(subject.object, point);
    if selected || lit {
        let fill = color32(lab.theme.selection.with_opacity(if selected { 0.25 } else { 0.12 }));
        ui.painter().rect_filled(rect, 4.0, fill);
    }
    let color = color32(lab.theme.basis_color(point));
    ui.painter().circle_filled(rect.left_center() + vec2(8.0, 0.0), if lit { 5.5 } else { 4.5 }, color);
    let font = eframe::egui::TextStyle::Body.resolve(ui.style());
    let at = rect.left_center() + vec2(17.0, 0.0);
    let ink = ui.visuals().text_color();
    ui.painter().text(at, eframe::egui::Align2::LEFT_CENTER, point.to_string(), font, ink);
    if response.clicked() {
        if ui.input(|input| input.modifiers.shift) {
            if !lab.selection.points.remove(&point) {
                lab.selection.points.insert(point);
            }
        } else {
            lab.selection.points = BTreeSet::from([point]);
        }
        lab.selection.knot = None;
    }
}
