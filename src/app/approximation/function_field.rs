//! The function: its formula with mistakes pointed out, its interval, samples of it.

use std::cell::RefCell;

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Button, RichText, Stroke, TextStyle, Ui};

use crate::app::approximation::changes::{change, show_everything};
use crate::app::approximation::inspector::Settings;
use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_field::{NumberEvent, NumberField};
use crate::app::text_field::TextField;
use crate::document::{Approximation, DataError, MAX_DATA, ObjectId, TypedFunction};

/// Characters that are shown on either side of a mistake.
const AROUND: usize = 14;

/// Shows field and buttons.
pub(super) fn show(
    settings: &mut Settings,
    approximation: &Approximation,
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
) {
    let text = approximation.function().map_or("", TypedFunction::text);
    let (left, right) = approximation
        .function()
        .map(TypedFunction::interval)
        .or_else(|| approximation.data_interval())
        .unwrap_or((0.0, 1.0));
    // What the check found, to be pointed out under the text.
    let mistake: RefCell<Option<(String, usize)>> = RefCell::new(None);
    let check = |typed: &str| {
        if typed.trim().is_empty() {
            return Ok(());
        }
        TypedFunction::new(typed, left, right).map(|_| ()).map_err(|error| {
            if let DataError::Formula(error) = &error {
                *mistake.borrow_mut() = error.position().map(|position| (typed.to_owned(), position));
            }
            error.to_string()
        })
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new("f(x) =").italics());
        ui.vertical(|ui| {
            let field = TextField::new("Formula of the function", text).hint("1/(1 + 25x^2)");
            if let Some(typed) = field.show(ui, ("formula", object), check) {
                set_function(lab, &typed, left, right);
            }
            if let Some((typed, position)) = mistake.borrow().as_ref() {
                point_out(ui, typed, *position);
            }
        });
    });
    if text.is_empty() {
        return;
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        ui.label("on");
        let from = NumberField::new("Left end of the interval", left).show(ui, ("left", object));
        ui.label("to");
        let to = NumberField::new("Right end of the interval", right).show(ui, ("right", object));
        if let Some(NumberEvent::Typed { to, .. }) = from.event {
            set_function(lab, text, to, right);
        }
        if let Some(NumberEvent::Typed { to, .. }) = to.event {
            set_function(lab, text, left, to);
        }
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let button = ui.add(Button::new("Sample")).on_hover_text(Command::SampleFunction.text().1);
        if button.clicked() {
            lab.commands.push(Command::SampleFunction);
        }
        ui.label("at");
        let field = NumberField::new("Number of samples", settings.count as f64).width(56.0).check(|count| {
            if (2.0..=MAX_DATA as f64).contains(&count) && count.fract() == 0.0 {
                Ok(())
            } else {
                Err(format!("a whole number from 2 to {MAX_DATA} is needed"))
            }
        });
        if let Some(NumberEvent::Typed { to, .. }) = field.show(ui, "number of samples").event {
            settings.count = to as usize;
        }
        ui.label("points");
    });
}

fn set_function(lab: &mut Lab, text: &str, left: f64, right: f64) {
    let changed = change(lab, "Change function", |approximation| {
        if text.trim().is_empty() {
            return Ok(approximation.with_function(None));
        }
        Ok(approximation.with_function(Some(TypedFunction::new(text, left, right)?)))
    });
    if changed {
        show_everything(lab);
    }
}

/// The text around a mistake, with the character where reading stopped.
fn point_out(ui: &mut Ui, typed: &str, position: usize) {
    let font = TextStyle::Monospace.resolve(ui.style());
    let (weak, bad) = (ui.visuals().weak_text_color(), ui.visuals().error_fg_color);
    let plain = TextFormat { font_id: font.clone(), color: weak, ..TextFormat::default() };
    let marked = TextFormat {
        color: bad,
        underline: Stroke::new(2.0, bad),
        background: bad.gamma_multiply(0.15),
        ..plain.clone()
    };
    let skip = position.saturating_sub(AROUND);
    let before: String = typed.chars().skip(skip).take(position - skip).collect();
    // Where the text is too short there is no character; a space shows the place.
    let at: String = typed.chars().nth(position).unwrap_or('\u{a0}').to_string();
    let after: String = typed.chars().skip(position + 1).take(AROUND).collect();
    let mut job = LayoutJob::default();
    job.append(if skip > 0 { "…" } else { "" }, 0.0, plain.clone());
    job.append(&before, 0.0, plain.clone());
    job.append(&at, 0.0, marked);
    job.append(&after, 0.0, plain);
    ui.label(job);
}
