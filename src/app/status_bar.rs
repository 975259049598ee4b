//! The line at the bottom: what was done to the shape, what is selected, and the zoom.

use eframe::egui::{Align, Frame, Layout, Margin, RichText, Ui};

use crate::app::lab::Lab;
use crate::app::painter::color32;
use crate::document::ShapeChange;
use crate::figure::composition::short_number;

/// The green of every palette.
const GREEN: usize = 2;

/// Shows the line; `workspace` stands at its right end.
pub(crate) fn show(lab: &Lab, workspace: &str, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let muted = color32(lab.theme.muted_text);
        if let Some(object) = lab.selection.object.and_then(|id| lab.history.document().object(id)) {
            let text = format!("{}: {}", object.name, object.content.summary());
            ui.label(RichText::new(text).small().color(muted));
        }
        if let Some(note) = &lab.shape_note {
            ui.separator();
            // A note by somebody else says nothing about what the last edit did.
            let said = lab.shape.sentence().filter(|sentence| note.starts_with(sentence.as_str()));
            match (said, badge(&lab.shape)) {
                (Some(sentence), Some((text, exact))) => {
                    let theme = &lab.theme;
                    let color = color32(if exact { theme.basis_color(GREEN) } else { theme.warning });
                    let frame = Frame::NONE
                        .fill(color.gamma_multiply(0.16))
                        .corner_radius(4)
                        .inner_margin(Margin::symmetric(6, 0));
                    let shown = frame.show(ui, |ui| {
                        ui.label(RichText::new(text).small().strong().color(color));
                    });
                    shown.response.on_hover_text(sentence.as_str());
                    let rest = note[sentence.len()..].trim();
                    if !rest.is_empty() {
                        ui.label(RichText::new(rest).small());
                    } else if let ShapeChange::Changed { at: Some(at), .. } = lab.shape {
                        let text = format!("most near t = {}", short_number(at));
                        ui.label(RichText::new(text).small().color(muted));
                    }
                }
                _ => {
                    ui.label(RichText::new(note).small());
                }
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(RichText::new(workspace).small().color(muted));
        });
    });
}

/// The words of the badge, and whether the shape is the same.
fn badge(shape: &ShapeChange) -> Option<(String, bool)> {
    Some(match *shape {
        ShapeChange::None => return None,
        ShapeChange::Kept { deviation: 0.0 } | ShapeChange::Approximated { deviation: 0.0 } => {
            ("exact".to_owned(), true)
        }
        ShapeChange::Kept { deviation } => (format!("exact, certified to {deviation:.0e}"), true),
        ShapeChange::Changed { deviation: Some(deviation), .. } => {
            (format!("changed by at most {}", brief(deviation)), false)
        }
        ShapeChange::Changed { deviation: None, .. } => ("changed, not measured".to_owned(), false),
        ShapeChange::Approximated { deviation } => {
            (format!("new curve within {deviation:.1e}, measured"), false)
        }
    })
}

fn brief(value: f64) -> String {
    if value > 0.0 && value < 1e-3 { format!("{value:.1e}") } else { short_number(value) }
}
