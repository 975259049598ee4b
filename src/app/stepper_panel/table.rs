//! The table of an algorithm: its entries as cells, with lines to what they are made of.

use std::collections::BTreeSet;

use eframe::egui::{
    Align, Align2, CornerRadius, FontId, Pos2, Rect, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use crate::app::lab::{Hovered, Lab};
use crate::app::number_text::{compact, with_digits};
use crate::app::painter::color32;
use crate::course::Stepper;
use crate::course::stepper::{Entry, Tie};
use crate::document::ObjectId;

/// Height of the gap between two rows, where the factors stand.
const GAP: f32 = 26.0;
/// Lines to parents further away, counted in cells, or more than a row above would only cross the table.
const LONGEST_LINE: f32 = 3.0;

/// Sizes of the cells of a table.
#[derive(Clone, Debug)]
struct Grid {
    cell: Vec2,
    pitch: f32,
    lines: usize,
    /// Where each row begins, in cells: rows stand in the middle.
    starts: Vec<f32>,
    columns: usize,
}

impl Grid {
    fn new(lab: &Lab, stepper: &Stepper, room: f32) -> Self {
        let columns = stepper.levels().iter().map(Vec::len).max().unwrap_or(1);
        let starts = stepper.levels().iter().map(|row| 0.5 * (columns - row.len()) as f32).collect();
        let lines = stepper.table().map(|entry| entry.lines.len()).max().unwrap_or(1);
        let scale = lab.theme.text_scale as f32;
        let pitch = ((room - 4.0) / columns as f32).clamp(58.0 * scale, 96.0 * scale);
        Self { cell: vec2(pitch - 10.0, (21.0 + 13.0 * lines as f32) * scale), pitch, lines, starts, columns }
    }

    fn size(&self) -> Vec2 {
        let rows = self.starts.len() as f32;
        vec2(self.pitch * self.columns as f32 + 2.0, rows * (self.cell.y + GAP) - GAP + 2.0)
    }

    fn rect(&self, origin: Pos2, (level, position): Tie) -> Rect {
        let x = (position as f32 + self.starts[level]) * self.pitch + 5.0;
        let y = level as f32 * (self.cell.y + GAP);
        Rect::from_min_size(origin + vec2(x, y), self.cell)
    }
}

/// Shows the table with the present frame.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, object: ObjectId, stepper: &Stepper) {
    let Some(frame) = stepper.frames().get(lab.stepper.frame) else { return };
    let revealed: BTreeSet<Tie> = stepper.revealed(lab.stepper.frame).into_iter().collect();
    let highlighted: BTreeSet<Tie> = frame.highlights.iter().copied().collect();
    let grid = Grid::new(lab, stepper, ui.available_width());
    let turned = has_turned(lab, ui);
    let shown = ScrollArea::horizontal().id_salt("scheme").auto_shrink([false, true]).show(ui, |ui| {
        let (rect, _) = ui.allocate_exact_size(grid.size(), Sense::hover());
        let origin = rect.min + vec2(((ui.available_width() - grid.size().x) * 0.5).max(0.0), 1.0);
        for entry in stepper.table() {
            arrows(lab, ui, &grid, origin, entry, &revealed, &highlighted);
        }
        for entry in stepper.table() {
            let look = Look {
                shown: revealed.contains(&entry.tie()),
                highlighted: highlighted.contains(&entry.tie()),
                lit: is_lit(lab, object, entry),
            };
            cell(lab, ui, object, stepper, grid.rect(origin, entry.tie()), entry, look, grid.lines);
        }
        let told = &frame.highlights;
        let middle = if told.len() > 3 { told.get(told.len() / 2) } else { told.last() };
        let place = middle.map(|&tie| grid.rect(origin, tie).expand(6.0)).filter(|_| turned);
        if let Some(place) = place {
            ui.scroll_to_rect(place, None::<Align>);
        }
        place
    });
    // What a new frame is about comes into sight, sideways above, up and down here.
    if let Some(place) = shown.inner {
        ui.scroll_to_rect(place, None::<Align>);
    }
}

/// Whether another frame is shown than when the table was drawn last.
fn has_turned(lab: &Lab, ui: &Ui) -> bool {
    let (id, now) = (ui.make_persistent_id("frame of the table"), (lab.view.stepper, lab.stepper.frame));
    let before = ui.data(|data| data.get_temp(id));
    ui.data_mut(|data| data.insert_temp(id, now));
    before.is_some_and(|before: (_, usize)| before != now)
}

/// How a cell looks.
#[derive(Clone, Copy, Debug)]
struct Look {
    shown: bool,
    highlighted: bool,
    lit: bool,
}

fn is_lit(lab: &Lab, object: ObjectId, entry: &Entry) -> bool {
    match lab.hovered {
        Hovered::Entry(over, level, position) => over == object && entry.tie() == (level, position),
        Hovered::Point(over, point) => over == object && entry.control_point == Some(point),
        _ => false,
    }
}

/// The lines from the parents, with their factors.
fn arrows(
    lab: &Lab,
    ui: &Ui,
    grid: &Grid,
    origin: Pos2,
    entry: &Entry,
    revealed: &BTreeSet<Tie>,
    highlighted: &BTreeSet<Tie>,
) {
    let child = grid.rect(origin, entry.tie());
    let shown = revealed.contains(&entry.tie());
    let told = highlighted.contains(&entry.tie()) && shown;
    let opacity = if shown { 1.0 } else { 0.25 };
    let tint = if told { lab.theme.accent } else { lab.theme.muted_text };
    let ink = color32(tint).gamma_multiply(opacity);
    let font = FontId::proportional(10.0 * lab.theme.text_scale as f32);
    for parent in &entry.parents {
        let from = grid.rect(origin, parent.tie);
        let shift = (child.center().x - from.center().x) / grid.pitch;
        if shift.abs() > LONGEST_LINE || parent.tie.0 + 1 < entry.level {
            continue;
        }
        let sign = if shift.abs() < 0.1 { 0.0 } else { shift.signum() };
        let start = pos2(from.center().x + sign * 0.15 * grid.cell.x, from.bottom() + 1.0);
        let end = pos2(child.center().x - sign * 0.22 * grid.cell.x, child.top() - 1.0);
        ui.painter()
            .line_segment([start, end], Stroke::new(if told { 1.6 } else { 1.0 }, ink.gamma_multiply(0.8)));
        // The number stands on its line, the line behind it wiped out: beside it there is no room.
        let text = if grid.pitch < 64.0 { with_digits(parent.factor, 2) } else { compact(parent.factor) };
        let galley = ui.painter().layout_no_wrap(text, font.clone(), ink);
        let place = Align2::CENTER_CENTER.anchor_size(start.lerp(end, 0.5), galley.size());
        ui.painter().rect_filled(place.shrink2(vec2(0.0, 1.0)), 2.0, ui.visuals().panel_fill);
        ui.painter().galley(place.min, galley, ink);
    }
}

#[expect(clippy::too_many_arguments, reason = "one cell with everything that decides how it looks")]
fn cell(
    lab: &mut Lab,
    ui: &Ui,
    object: ObjectId,
    stepper: &Stepper,
    rect: Rect,
    entry: &Entry,
    look: Look,
    lines: usize,
) {
    let (level, position) = entry.tie();
    let response = ui.interact(rect, ui.make_persistent_id(("entry", level, position)), Sense::click());
    let value = entry.lines.join(", ");
    response
        .widget_info(|| WidgetInfo::labeled(Role::Cell, true, format!("{} = ({value})", entry.plain_label)));
    if response.hovered() {
        lab.hovering = Hovered::Entry(object, level, position);
        lab.entry_partners.clone_from(&entry.partners);
    }
    if response.clicked() {
        if let Some(point) = entry.control_point {
            lab.selection.points = BTreeSet::from([point]);
            lab.selection.knot = None;
        }
        let telling = stepper.frames().iter().position(|frame| frame.reveals.contains(&(level, position)));
        if let Some(frame) = telling.filter(|_| entry.control_point.is_none()) {
            lab.stepper.frame = frame;
            lab.stepper.playing = false;
        }
    }
    if !ui.is_rect_visible(rect) {
        return;
    }
    let theme = &lab.theme;
    let opacity = if look.shown || look.lit { 1.0 } else { 0.3 };
    let own =
        entry.control_point.map_or_else(|| ui.visuals().text_color(), |k| color32(theme.basis_color(k)));
    let (fill, rim) = if look.lit {
        (color32(theme.selection.with_opacity(0.16)), Stroke::new(1.6, color32(theme.selection)))
    } else if look.highlighted && look.shown {
        (color32(theme.accent.with_opacity(0.13)), Stroke::new(1.4, color32(theme.accent)))
    } else {
        (color32(theme.background), Stroke::new(1.0, color32(theme.grid_major)))
    };
    let rim = Stroke::new(rim.width, rim.color.gamma_multiply(opacity));
    let painter = ui.painter();
    painter.rect(rect, CornerRadius::same(4), fill.gamma_multiply(opacity), rim, StrokeKind::Inside);
    let scale = theme.text_scale as f32;
    let middle = rect.center().x;
    let name = FontId::proportional(11.5 * scale);
    painter.text(
        pos2(middle, rect.top() + 3.0),
        Align2::CENTER_TOP,
        &entry.plain_label,
        name,
        own.gamma_multiply(opacity),
    );
    let faded = if entry.needed { opacity } else { opacity * 0.55 };
    let ink = ui.visuals().text_color().gamma_multiply(faded);
    let step = 13.0 * scale;
    for (line, text) in entry.lines.iter().enumerate() {
        let y = rect.bottom() - 3.0 - step * (lines - line) as f32;
        let text = text.replace('-', "−");
        let mut galley = painter.layout_no_wrap(text.clone(), FontId::proportional(11.0 * scale), ink);
        let room = rect.width() - 4.0;
        if galley.size().x > room {
            galley = painter.layout_no_wrap(
                text,
                FontId::proportional(11.0 * scale * room / galley.size().x),
                ink,
            );
        }
        painter.galley(pos2(middle - 0.5 * galley.size().x, y), galley, ink);
    }
}
