//! Which algorithm is told, and what it needs beside the curve and its parameter.

use eframe::egui::{ComboBox, RichText, Ui};
use glam::DVec2;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::text_field::TextField;
use crate::app::toolbar;
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::parse_number;
use crate::course::stepper::default_line;
use crate::document::{StepperKind, StepperLine};

/// The list of algorithms.
pub(super) fn algorithm(lab: &mut Lab, ui: &mut Ui) {
    ui.add_space(2.0);
    let mut kind = lab.view.stepper;
    let titled = |kind: StepperKind| format!("{}   {}", kind.section(), kind.name());
    let combo = ComboBox::from_id_salt("algorithm")
        .width(ui.available_width() - 8.0)
        .height(400.0)
        .selected_text(titled(kind))
        .show_ui(ui, |ui| {
            for choice in StepperKind::ALL {
                ui.selectable_value(&mut kind, choice, titled(choice));
            }
        });
    combo.response.on_hover_text("The algorithm to step through").accessible_name("Algorithm");
    lab.set_stepper(kind);
}

/// What would help where the chosen algorithm does not suit the curve: another one, or other knots.
pub(super) fn instead(lab: &mut Lab, ui: &mut Ui, curve: &Nurbs<DVec2>) {
    if lab.view.stepper == StepperKind::UniformSubdivision && !has_equal_distances(curve) {
        let button = ui.button("Make the knots uniform");
        if button.on_hover_text("Equal distances, simple knots; the control points stay").clicked() {
            lab.commands.push(Command::UniformKnots);
        }
        return;
    }
    let other = match (lab.view.stepper, curve.is_polynomial()) {
        (StepperKind::DeCasteljau, false) => StepperKind::RationalDeCasteljau,
        (StepperKind::RationalDeCasteljau, true) => StepperKind::DeCasteljau,
        _ => return,
    };
    if ui.button(format!("Choose {}", other.name())).clicked() {
        lab.set_stepper(other);
    }
}

/// Whether all knots have the same distance, up to rounding.
fn has_equal_distances(curve: &Nurbs<DVec2>) -> bool {
    let knots = curve.space().knots();
    let mean = (knots[knots.len() - 1] - knots[0]) / (knots.len() - 1) as f64;
    knots.windows(2).all(|pair| (pair[1] - pair[0] - mean).abs() <= 1e-9 * mean)
}

/// The line of the intersection, the arguments of the blossom, the knot to insert.
pub(super) fn more(lab: &mut Lab, ui: &mut Ui, curve: &Nurbs<DVec2>) {
    match lab.view.stepper {
        StepperKind::Intersection => line(lab, ui, curve),
        StepperKind::Blossom => arguments(lab, ui, curve.degree()),
        StepperKind::KnotInsertion => toolbar::button("Insert the knot", Command::InsertKnot, lab, ui),
        _ => {}
    }
}

fn line(lab: &mut Lab, ui: &mut Ui, curve: &Nurbs<DVec2>) {
    let before = lab.view.stepper_choices.line.unwrap_or_else(|| default_line(curve));
    let mut line = before;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(RichText::new("line").weak());
        let step = 1.0 / lab.view.camera.scale;
        for (name, label, value, drag) in [
            ("x", "Line x", &mut line.through.x, Drag::PerPixel(step)),
            ("y", "Line y", &mut line.through.y, Drag::PerPixel(step)),
            ("°", "Line angle", &mut line.angle, Drag::PerPixel(0.5)),
        ] {
            ui.label(name);
            let field = NumberField::new(label, *value).width(52.0).drag(drag).show(ui, label);
            if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = field.event
                && to.is_finite()
            {
                *value = to;
            }
        }
        if ui.small_button("Reset").on_hover_text("The horizontal line through the middle").clicked() {
            lab.view.stepper_choices.line = None;
        } else if line != before {
            let StepperLine { through, angle } = line;
            lab.view.stepper_choices.line = Some(StepperLine { through, angle: angle.rem_euclid(360.0) });
        }
    });
}

fn arguments(lab: &mut Lab, ui: &mut Ui, degree: usize) {
    let written: Vec<String> = lab.view.stepper_choices.arguments.iter().map(f64::to_string).collect();
    let text = written.join(" ");
    let numbers = |text: &str| -> Result<Vec<f64>, String> {
        let parts = text.split([' ', ';']).filter(|part| !part.is_empty());
        let numbers: Result<Vec<f64>, _> = parts.map(parse_number).collect();
        let numbers = numbers.map_err(|error| error.to_string())?;
        match numbers.len() {
            0 => Ok(numbers),
            count if count == degree => Ok(numbers),
            count => Err(format!("degree {degree} needs {degree} arguments, not {count}")),
        }
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new("arguments").weak());
        ui.vertical(|ui| {
            let field = TextField::new("Arguments", &text).hint("a t … t b");
            if let Some(typed) = field.show(ui, "arguments", |text| numbers(text).map(drop)) {
                lab.view.stepper_choices.arguments = numbers(&typed).unwrap_or_default();
            }
        });
    });
}
