//! The data as numbers.

use std::collections::BTreeSet;

use eframe::egui::{Align2, FontId, RichText, Role, ScrollArea, Sense, TextStyle, Ui, WidgetInfo, vec2};

use crate::app::approximation::changes::set;
use crate::app::command::Command;
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{NumberEvent, NumberField, positive};
use crate::app::painter::color32;
use crate::document::{Approximation, DataError, ObjectId};

/// Most rows that are seen at once.
const ROWS: usize = 10;
/// Width of the index.
const HEAD: f32 = 48.0;

/// Shows the table.
pub(super) fn show(approximation: &Approximation, lab: &mut Lab, ui: &mut Ui, object: ObjectId) {
    ui.horizontal(|ui| {
        for (text, command) in [("Import…", Command::ImportData), ("Export…", Command::ExportData)] {
            let possible = command == Command::ImportData || !approximation.is_empty();
            let button = ui.add_enabled(possible, eframe::egui::Button::new(text).small());
            if button.on_hover_text(command.text().1).clicked() {
                lab.commands.push(command);
            }
        }
    });
    if approximation.is_empty() {
        ui.label(RichText::new("No data. Paste a table, or press A and click.").weak());
        return;
    }
    let width = ((ui.available_width() - HEAD - 12.0 - 3.0 * 4.0) / 3.0).max(36.0);
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.allocate_exact_size(vec2(HEAD, 14.0), Sense::hover());
        for title in ["x", "y", "weight"] {
            let (rect, _) = ui.allocate_exact_size(vec2(width, 14.0), Sense::hover());
            let ink = ui.visuals().weak_text_color();
            let at = rect.right_center() - vec2(5.0, 0.0);
            ui.painter().text(at, Align2::RIGHT_CENTER, title, FontId::proportional(11.0), ink);
        }
    });
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        let most = (height + 2.0) * ROWS as f32;
        let area = ScrollArea::vertical().id_salt("data").max_height(most).auto_shrink([false, true]);
        area.show_rows(ui, height, approximation.len(), |ui, range| {
            for index in range {
                row(approximation, lab, ui, object, index, width);
            }
        });
    });
}

fn row(
    approximation: &Approximation,
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
    index: usize,
    width: f32,
) {
    let (x, y) = (approximation.sites()[index], approximation.values()[index]);
    let line = ui.horizontal(|ui| {
        head(lab, ui, object, index);
        let typed = |lab: &mut Lab, event, make: &dyn Fn(f64) -> Result<Approximation, DataError>| {
            if let Some(NumberEvent::Typed { to, .. }) = event {
                match make(to) {
                    Ok(changed) => {
                        lab.edit(set(object, changed, format!("Change datum {index}")));
                    }
                    Err(error) => lab.problem(error.to_string()),
                }
            }
        };
        let label = format!("x of datum {index}");
        let field = NumberField::new(&label, x).width(width).show(ui, ("x", object, index));
        typed(lab, field.event, &|x| approximation.with_point_at(index, x, y));
        let label = format!("y of datum {index}");
        let field = NumberField::new(&label, y).width(width).show(ui, ("y", object, index));
        typed(lab, field.event, &|y| approximation.with_point_at(index, x, y));
        let label = format!("Weight of datum {index}");
        let field = NumberField::new(&label, approximation.weight(index)).width(width).check(positive);
        let field = field.show(ui, ("w", object, index));
        typed(lab, field.event, &|weight| approximation.with_weight(&[index], weight));
    });
    if ui.rect_contains_pointer(line.response.rect) {
        lab.hovering = Hovered::Point(object, index);
    }
}

/// The index; a click selects the datum, Shift adds.
fn head(lab: &mut Lab, ui: &mut Ui, object: ObjectId, index: usize) {
    let (rect, response) = ui.allocate_exact_size(vec2(HEAD, ui.spacing().interact_size.y), Sense::click());
    let selected = lab.selection.points.contains(&index);
    response
        .widget_info(|| WidgetInfo::selected(Role::Button, true, selected, format!("Select datum {index}")));
    let lit = lab.hovered == Hovered::Point(object, index);
    if selected || lit {
        let fill = color32(lab.theme.selection.with_opacity(if selected { 0.25 } else { 0.12 }));
        ui.painter().rect_filled(rect, 4.0, fill);
    }
    let ink = ui.visuals().text_color();
    let at = rect.left_center() + vec2(6.0, 0.0);
    let font = TextStyle::Body.resolve(ui.style());
    ui.painter().text(at, Align2::LEFT_CENTER, index.to_string(), font, ink);
    if response.clicked() {
        if ui.input(|input| input.modifiers.shift) {
            if !lab.selection.points.remove(&index) {
                lab.selection.points.insert(index);
            }
        } else {
            lab.selection.points = BTreeSet::from([index]);
        }
    }
}
