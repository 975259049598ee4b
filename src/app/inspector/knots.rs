//! The knots as a list that can be typed, pasted and copied in both conventions.

use eframe::egui::{RichText, ScrollArea, TextStyle, Ui};

use crate::app::inspector::Subject;
use crate::app::lab::Lab;
use crate::app::number_text::{full, parse_list, short};
use crate::app::text_field::TextField;
use crate::document::Edit;

/// Longer lists are not shown as text.
const MOST_TYPED: usize = 600;

/// Shows the list.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let space = subject.curve.space();
    let knots = space.knots();
    if knots.len() > MOST_TYPED {
        ui.label(format!(
            "{} knots from {} to {}: too many to type, use the knot line.",
            knots.len(),
            short(knots[0]),
            short(knots[knots.len() - 1])
        ));
    } else {
        list(lab, ui, subject);
    }
    let kind = match space.period() {
        Some(period) => format!("One period of length {}. Enter applies, Escape gives up.", short(period)),
        None => "Enter applies, Escape gives up. Ends may be n-fold or (n + 1)-fold.".to_owned(),
    };
    ui.label(RichText::new(kind).weak().small());
    let text = if lab.knots.keep_curve {
        "The curve is kept as nearly as it can be; any number of knots will do."
    } else {
        "The control points are kept."
    };
    ui.label(RichText::new(text).weak().small());
    ui.horizontal(|ui| {
        ui.label("Copy");
        let n = subject.curve.degree();
        let own = if space.is_periodic() { "period".to_owned() } else { format!("{n}-fold ends") };
        let hint = "Copy the knots as they are shown";
        if ui.small_button(own).on_hover_text(hint).clicked() {
            copy(lab, ui, knots);
        }
        if !space.is_periodic() {
            let other = space.multiple_end_knots();
            let button = ui.add_enabled(
                other.is_some(),
                eframe::egui::Button::new(format!("{}-fold ends", n + 1)).small(),
            );
            let button = button
                .on_hover_text("Copy the knots as other programs write them; the control points are the same")
                .on_disabled_hover_text("Only for curves with n-fold ends: other programs know no others");
            if let Some(other) = other.filter(|_| button.clicked()) {
                copy(lab, ui, &other);
            }
        }
    });
}

fn list(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let text = joined(subject.curve.space().knots());
    let keep_curve = lab.knots.keep_curve;
    let edit = |text: &str| {
        parse_list(text).map(|knots| {
            let edit = Edit::SetKnots { object, knots };
            if keep_curve { Edit::KeepCurve { edit: Box::new(edit) } } else { edit }
        })
    };
    // The document itself says what is wrong with a list, on a copy.
    let check = |text: &str| {
        let mut trial = lab.history.document().clone();
        trial.apply(&edit(text)?).map(|_| ()).map_err(|error| error.to_string())
    };
    let most = 7.0 * ui.text_style_height(&TextStyle::Body);
    let field = TextField::new("Knot list", &text).rows(2).hint("0 0 0 1 2 3 3 3");
    let area =
        ScrollArea::vertical().id_salt(("knot list", object)).max_height(most).auto_shrink([false, true]);
    let taken = area.show(ui, |ui| field.show(ui, ("knots", object), check)).inner;
    if let Some(Ok(edit)) = taken.as_deref().map(edit) {
        lab.edit(edit);
    }
}

fn joined(knots: &[f64]) -> String {
    knots.iter().map(|&knot| full(knot)).collect::<Vec<_>>().join("  ")
}

fn copy(lab: &mut Lab, ui: &Ui, knots: &[f64]) {
    ui.ctx().copy_text(joined(knots));
    lab.done(format!("{} knots copied", knots.len()));
}
