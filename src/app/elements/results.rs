//! The solution in numbers, and its errors against a known one.

use eframe::egui::{Grid, ProgressBar, RichText, Ui};

use crate::app::elements::{Elements, Subject};
use crate::app::lab::Lab;
use crate::app::text_field::TextField;
use crate::document::read_formula;
use crate::figure::composition::short_number;

/// The solution in numbers.
pub(super) fn solution(room: &Elements, subject: &Subject, ui: &mut Ui) {
    let Some(solved) = room.live.solved(subject.object) else {
        ui.label(RichText::new("None yet.").weak());
        return;
    };
    let facts = solved.facts;
    let short = short_number;
    let at = facts.greatest_at;
    let cells = match solved.on_patch() {
        Some(_) => format!("{}", facts.cells[0]),
        None => format!("{} inner, {} cut", facts.cells[0], facts.cells[1]),
    };
    Grid::new("facts").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for (name, value) in [
            ("Unknowns", facts.unknowns.to_string()),
            ("Cells", cells),
            ("Greatest u", format!("{} at ({}, {})", short(facts.greatest), short(at.x), short(at.y))),
            ("Least u", short(facts.least)),
            ("Steepest", short(facts.steepest)),
            ("Integral", short(facts.integral)),
            ("Energy a(u, u)", short(facts.energy)),
            ("CG steps", facts.steps.to_string()),
            ("Residual", format!("{:.1e}", facts.residual)),
        ] {
            ui.label(name);
            ui.label(value);
            ui.end_row();
        }
    });
}

/// The known solution and the errors against it.
pub(super) fn errors(room: &mut Elements, subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let setting = subject.membrane.setting();
    let text = setting.exact.as_ref().map_or("", |exact| exact.text());
    let read = |text: &str| match text.trim() {
        "" => Ok(None),
        text => read_formula(text, "u").map(Some),
    };
    ui.label("Known solution u(x, y)");
    let field = TextField::new("Known solution", text).hint("0 where the membrane is held");
    let check = |text: &str| read(text).map(drop).map_err(|error| error.to_string());
    if let Some(exact) = field.show(ui, ("exact", subject.object), check).and_then(|text| read(&text).ok()) {
        subject.apply(lab, "Change known solution", subject.membrane.with(|setting| setting.exact = exact));
    }
    if let Some(part) = room.study.progress() {
        ui.horizontal(|ui| {
            ui.add(ProgressBar::new(part).desired_width(160.0).text("Measuring"));
            if ui.button("Cancel").clicked() {
                room.study.cancel();
            }
        });
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(60));
    } else if ui
        .button("Measure errors")
        .on_hover_text("Solve with h, h/2, h/4, h/8 and the load that belongs to the known solution")
        .clicked()
    {
        room.study.start(subject.object, &subject.membrane, lab.at_once, ui.ctx());
    }
    match room.study.found(subject.object, &subject.membrane) {
        None => {}
        Some(Err(error)) => {
            ui.colored_label(ui.visuals().error_fg_color, error.to_string());
        }
        Some(Ok(study)) => {
            Grid::new("study").num_columns(6).spacing([8.0, 3.0]).striped(true).show(ui, |ui| {
                for title in ["h", "N", "L2", "rate", "H1", "rate"] {
                    ui.label(RichText::new(title).strong());
                }
                ui.end_row();
                for (index, row) in study.rows.iter().enumerate() {
                    let rate = |rates: &[f64]| {
                        let rate = index.checked_sub(1).and_then(|before| rates.get(before));
                        rate.map_or_else(String::new, |rate| format!("{rate:.2}"))
                    };
                    ui.label(short_number(row.width));
                    ui.label(row.unknowns.to_string());
                    ui.label(format!("{:.1e}", row.l2));
                    ui.label(rate(&study.l2_rates));
                    ui.label(format!("{:.1e}", row.h1));
                    ui.label(rate(&study.h1_rates));
                    ui.end_row();
                }
            });
            if let Some(note) = &study.note {
                ui.label(RichText::new(note).weak().small());
            }
        }
    }
}
