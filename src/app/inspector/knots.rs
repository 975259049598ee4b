//! The knots as a list that can be typed.

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
    let object = subject.object;
    let space = subject.curve.space();
    let knots = space.knots();
    if knots.len() > MOST_TYPED {
        ui.label(format!(
            "{} knots from {} to {}: too many to type, use the knot line.",
            knots.len(),
            short(knots[0]),
            short(knots[knots.len() - 1])
        ));
        return;
    }
    let text = knots.iter().map(|&knot| full(knot)).collect::<Vec<_>>().join("  ");
    let edit = |text: &str| parse_list(text).map(|knots| Edit::SetKnots { object, knots });
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
    let kind = match space.period() {
        Some(period) => format!("One period of length {}. Enter applies, Escape gives up.", short(period)),
        None => "Enter applies, Escape gives up. Ends may be n-fold or (n + 1)-fold.".to_owned(),
    };
    ui.label(RichText::new(kind).weak().small());
}
