//! The conic of the piece at t: equation, type, numbers, and the middle weight in hand.

use eframe::egui::{Button, Grid, RichText, ScrollArea, Slider, Ui};
use glam::DVec2;

use crate::app::command::Command;
use crate::app::formula_view;
use crate::app::inspector::copyable;
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::number_text::short;
use crate::app::side_rooms::conic::{self, Piece, equation, facts, kind_text};
use crate::app::side_rooms::subject;
use crate::app::toolbar;
use crate::core::rational_bezier::Conic;
use crate::core::spline_curve::Nurbs;
use crate::document::{Edit, ObjectId};

/// Weights that the slider reaches.
const SLIDER: std::ops::RangeInclusive<f64> = 0.05..=20.0;

/// Shows the panel.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    let Some((object, curve)) = subject(lab, ui, "of degree 2 to see its conic") else { return };
    let Some(t) = lab.parameter(object) else { return };
    let piece = match conic::piece(&curve, t) {
        Ok(piece) => piece,
        Err(reason) => {
            ui.add_space(6.0);
            ui.label(reason);
            ui.add_space(4.0);
            toolbar::button("Draw a conic", Command::DrawConic, lab, ui);
            return;
        }
    };
    ScrollArea::vertical().id_salt("conic").auto_shrink([false, false]).show(ui, |ui| {
        let (left, right) = piece.interval;
        ui.label(RichText::new(format!("Piece over [{}, {}]", short(left), short(right))).weak());
        weight(lab, ui, object, &curve, &piece);
        ui.separator();
        match piece.extended.implicit() {
            Ok(conic) => numbers(lab, ui, &conic.normalised()),
            Err(_) => {
                ui.label("The three control points lie on a line: so does the arc, and the conic is this line, counted twice.");
            }
        }
        ui.separator();
        ui.checkbox(&mut lab.rooms.whole_conic, "Complete conic, axes and foci");
        ui.checkbox(&mut lab.rooms.complement, "Complementary arc (weight \u{2212}w)")
            .on_hover_text("With the middle weight negated the parameter interval runs through the rest of the conic");
        ui.add_space(8.0);
    });
}

fn check_weight(value: f64) -> Result<(), String> {
    if (1e-6..=1e6).contains(&value.abs()) {
        Ok(())
    } else {
        Err(format!("{value} is not between 0.000001 and 1000000, nor its negative"))
    }
}

/// The middle weight in standard form.
fn weight(lab: &mut Lab, ui: &mut Ui, object: ObjectId, curve: &Nurbs<DVec2>, piece: &Piece) {
    let now = piece.standard_weight();
    if piece.indices.is_none() {
        ui.label(conic::weight_text(now));
        ui.label(RichText::new("Its control points are not points of the curve: double the knots at its ends to give it a weight of its own.").weak());
        if ui.button("Separate the piece").on_hover_text("Inserts knots; the shape stays").clicked() {
            lab.edit(piece.separation(object, curve));
        }
        return;
    }
    let edit = |weight: f64| piece.edit(object, curve, weight);
    ui.horizontal(|ui| {
        ui.label("Middle weight")
            .on_hover_text("With the outer weights made 1; a negative one shows the complementary arc");
        let shown = if lab.rooms.complement { -now } else { now };
        let field = NumberField::new("Middle weight in standard form", shown)
            .width(76.0)
            .drag(Drag::Factor)
            .check(check_weight)
            .show(ui, "standard weight");
        match field.event {
            Some(NumberEvent::Typed { to, .. }) => {
                lab.rooms.complement = to < 0.0;
                if let Some(edit) = edit(to.abs()).filter(|_| to.abs() != now) {
                    lab.edit(edit);
                }
            }
            Some(NumberEvent::Dragged { to, .. }) => change(lab, edit(to.abs())),
            Some(NumberEvent::DragEnded) => lab.commit(),
            None => {}
        }
    });
    let mut slid = now;
    ui.spacing_mut().slider_width = ui.available_width() - 8.0;
    let slider = ui.add(Slider::new(&mut slid, SLIDER).logarithmic(true).show_value(false));
    let slider = slider.accessible_name("Slider of the middle weight");
    if slider.changed() && slid != now {
        // Near 1 the slider holds the parabola.
        let slid = if (slid - 1.0).abs() < 0.02 { 1.0 } else { slid };
        change(lab, edit(slid));
    }
    if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
        lab.commit();
    }
    ui.label(RichText::new(conic::weight_text(now)).weak());
    ui.horizontal(|ui| {
        if ui.add_enabled(now != 1.0, Button::new("To a parabola")).clicked()
            && let Some(edit) = edit(1.0)
        {
            lab.edit(edit);
        }
        match piece.circle() {
            Ok(weight) => {
                let hint =
                    format!("The middle weight {}, the cosine of the angle at the ends", short(weight));
                if ui.add_enabled(weight > 0.0, Button::new("To a circle")).on_hover_text(hint).clicked()
                    && let Some(edit) = edit(weight)
                {
                    lab.edit(edit);
                }
            }
            Err(position) => {
                ui.add_enabled(false, Button::new("To a circle"))
                    .on_disabled_hover_text("The arc of a circle needs a triangle with two equal sides");
                if let Some([_, point, _]) = piece.indices
                    && ui
                        .button("Equal sides")
                        .on_hover_text("Moves the middle point above the middle of the chord")
                        .clicked()
                {
                    lab.edit(Edit::SetPoint { object, point, position });
                }
            }
        }
    });
}

fn change(lab: &mut Lab, edit: Option<Edit>) {
    if let Some(edit) = edit {
        lab.begin("Change middle weight");
        lab.update(edit);
    }
}

fn numbers(lab: &mut Lab, ui: &mut Ui, conic: &Conic) {
    ui.label(RichText::new(kind_text(conic)).strong());
    let size = 14.0 * lab.theme.text_scale as f32;
    formula_view::formula(ui, &equation(conic), size);
    ui.add_space(4.0);
    ui.label(RichText::new("a\u{2081}\u{2081}x\u{b2} + 2a\u{2081}\u{2082}xy + a\u{2082}\u{2082}y\u{b2} + 2a\u{2081}\u{2083}x + 2a\u{2082}\u{2083}y + a\u{2083}\u{2083} = 0").weak().small());
    let coefficients = conic.coefficients();
    let names = [
        "a\u{2081}\u{2081}",
        "a\u{2081}\u{2082}",
        "a\u{2081}\u{2083}",
        "a\u{2082}\u{2082}",
        "a\u{2082}\u{2083}",
        "a\u{2083}\u{2083}",
    ];
    Grid::new("coefficients").num_columns(6).spacing([6.0, 3.0]).show(ui, |ui| {
        for (k, (name, value)) in names.into_iter().zip(coefficients).enumerate() {
            ui.label(name);
            copyable(lab, ui, name, &[value]);
            if k % 3 == 2 {
                ui.end_row();
            }
        }
    });
    if ui.small_button("Copy all six").clicked() {
        let text: Vec<String> = coefficients.iter().map(f64::to_string).collect();
        ui.ctx().copy_text(text.join(", "));
        lab.done("Coefficients copied");
    }
    ui.add_space(4.0);
    Grid::new("conic facts").num_columns(2).spacing([10.0, 3.0]).show(ui, |ui| {
        for fact in facts(conic) {
            ui.label(fact.name).on_hover_text(fact.hint);
            copyable(lab, ui, fact.name, &fact.numbers);
            ui.end_row();
        }
    });
}
