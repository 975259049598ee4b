//! Name, colour, degree, open or closed.

use eframe::egui::{Button, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};

use crate::app::command::Command;
use crate::app::inspector::Subject;
use crate::app::lab::Lab;
use crate::app::painter::color32;
use crate::app::text_field::TextField;
use crate::document::{CurveDisplay, Edit};

/// The highest degree that the window offers.
const HIGHEST_DEGREE: usize = 12;

/// Shows the head of the inspector.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let named = |text: &str| if text.trim().is_empty() { Err("a name is needed".to_owned()) } else { Ok(()) };
    if let Some(name) = TextField::new("Name", subject.name).show(ui, ("name", object), named) {
        lab.edit(Edit::RenameObject { object, name: name.trim().to_owned() });
    }
    swatches(lab, ui, subject);
    degree(lab, ui, subject);
    ui.horizontal(|ui| {
        let closed = subject.curve.space().is_periodic();
        for (wanted, text, hint) in [
            (false, "Open", "A curve with two ends; a closed one is cut where it starts, the shape is kept"),
            (true, "Closed", "A closed curve: the same control points in a ring, the shape changes"),
        ] {
            if ui.selectable_label(closed == wanted, text).on_hover_text(hint).clicked() && closed != wanted {
                lab.edit(Edit::SetClosed { object, closed: wanted });
            }
        }
        ui.label(RichText::new(if subject.curve.is_polynomial() { "polynomial" } else { "rational" }).weak());
        if !subject.curve.is_polynomial() && ui.small_button("All weights 1").clicked() {
            lab.commands.push(Command::ResetWeights);
        }
    });
}

fn swatches(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let count = lab.theme.palette.len();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let side = ((ui.available_width() - 3.0 * count as f32) / count as f32).clamp(12.0, 20.0);
        for index in 0..count {
            let (rect, response) = ui.allocate_exact_size(vec2(side, side), Sense::click());
            let chosen = subject.display.color % count == index;
            response.widget_info(|| {
                WidgetInfo::selected(Role::RadioButton, true, chosen, format!("Colour {}", index + 1))
            });
            let rim = if chosen {
                Stroke::new(2.0, ui.visuals().text_color())
            } else if response.hovered() || response.has_focus() {
                Stroke::new(1.5, color32(lab.theme.selection))
            } else {
                Stroke::NONE
            };
            ui.painter().rect(
                rect.shrink(1.0),
                4.0,
                color32(lab.theme.basis_color(index)),
                rim,
                StrokeKind::Outside,
            );
            if response.clicked() && !chosen {
                let display = CurveDisplay { color: index, ..subject.display.clone() };
                lab.edit(Edit::SetDisplay { object: subject.object, display });
            }
        }
    });
}

fn degree(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let degree = subject.curve.degree();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(format!("Degree {degree}"));
        let lower = ui.add_enabled(degree > 1, Button::new("Lower"));
        if lower.on_hover_text("One degree down; the deviation is measured").clicked() {
            lab.edit(Edit::ReduceDegree { object });
        }
        let raise = ui.add_enabled(degree < HIGHEST_DEGREE, Button::new("Raise"));
        if raise.on_hover_text("One degree up; the shape is kept").clicked() {
            lab.edit(Edit::ElevateDegree { object });
        }
        let menu = ui.menu_button("Set\u{2026}", |ui| {
            ui.label(RichText::new("Keep the control points;\nthe shape changes").weak());
            ui.horizontal_wrapped(|ui| {
                ui.set_max_width(150.0);
                for wanted in 1..=HIGHEST_DEGREE {
                    if ui.selectable_label(wanted == degree, wanted.to_string()).clicked() {
                        lab.edit(Edit::SetDegree { object, degree: wanted });
                        ui.close();
                    }
                }
            });
        });
        menu.response.on_hover_text("Set the degree and keep the control points");
    });
}
