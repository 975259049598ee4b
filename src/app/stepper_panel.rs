//! De Boor's algorithm with its numbers: the triangular table, frame by frame.

use std::collections::BTreeSet;

use eframe::egui::{
    Align2, CornerRadius, FontId, Rect, RichText, Role, ScrollArea, Sense, Slider, Stroke, StrokeKind, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};

use crate::app::formula_view;
use crate::app::icon::{self, Icon};
use crate::app::lab::{Hovered, Lab};
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::number_text::{compact, with_digits};
use crate::app::painter::color32;
use crate::course::Stepper;
use crate::course::stepper::Entry;
use crate::document::ObjectId;

/// Seconds that a frame stays while playing at speed 1.
const FRAME_SECONDS: f64 = 1.6;

/// Height of the gap between two levels, where the weights stand.
const GAP: f32 = 26.0;

/// Shows the panel.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let Some((object, stepper)) = lab.selection.object.zip(lab.scheme()) else {
        ui.add_space(8.0);
        ui.label(RichText::new("Select a curve to step through de Boor's algorithm on it.").weak());
        return;
    };
    let last = stepper.frames().len().saturating_sub(1);
    lab.stepper.frame = lab.stepper.frame.min(last);
    ScrollArea::vertical().id_salt("stepper").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        controls(lab, ui, object, last);
        play(lab, ui, last);
        let Some(frame) = stepper.frames().get(lab.stepper.frame) else { return };
        ui.add_space(2.0);
        // A fixed height keeps the table from jumping between captions of one and of three lines.
        let top = ui.cursor().top();
        formula_view::rich_paragraph(ui, &frame.caption);
        formula_view::formula(ui, &frame.formula, 15.0 * lab.theme.text_scale as f32);
        let used = ui.cursor().top() - top;
        ui.add_space((92.0 - used).max(0.0));
        ui.separator();
        table(lab, ui, object, &stepper);
        if let Some(note) = stepper.note() {
            ui.add_space(4.0);
            formula_view::rich_text(ui, note, color32(lab.theme.accent));
        }
        ui.add_space(4.0);
        ui.label(
            RichText::new("The numbers beside the lines are the weights γ and 1 − γ of the parents.")
                .weak()
                .small(),
        );
    });
}

fn controls(lab: &mut Lab, ui: &mut Ui, object: ObjectId, last: usize) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        if icon::button(ui, Icon::ToStart, "To the start", lab.stepper.frame > 0).clicked() {
            lab.stepper.frame = 0;
            lab.stepper.elapsed = 0.0;
        }
        if icon::button(ui, Icon::Back, "One step back", lab.stepper.frame > 0).clicked() {
            lab.stepper.frame = lab.stepper.frame.saturating_sub(1);
            lab.stepper.playing = false;
        }
        let (sign, word) = if lab.stepper.playing { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
        if icon::button(ui, sign, word, last > 0).clicked() {
            lab.stepper.playing = !lab.stepper.playing;
            lab.stepper.elapsed = 0.0;
            if lab.stepper.playing && lab.stepper.frame >= last {
                lab.stepper.frame = 0;
            }
        }
        if icon::button(ui, Icon::Forward, "One step on", lab.stepper.frame < last).clicked() {
            lab.stepper.frame = (lab.stepper.frame + 1).min(last);
            lab.stepper.playing = false;
        }
        ui.add_space(6.0);
        ui.label(RichText::new(format!("{} of {}", lab.stepper.frame + 1, last + 1)).weak());
        let (speed_id, mut speed) = speed(ui);
        ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
            ui.spacing_mut().slider_width = 48.0;
            let slider = Slider::new(&mut speed, 0.25..=4.0).logarithmic(true).show_value(false);
            ui.add(slider).accessible_name("Speed").on_hover_text("Speed");
            ui.label(RichText::new("speed").weak().small());
        });
        ui.data_mut(|data| data.insert_temp(speed_id, speed));
    });
    ui.horizontal(|ui| {
        let mut frame = lab.stepper.frame;
        ui.spacing_mut().slider_width = (ui.available_width() - 96.0).max(60.0);
        let slider = ui.add(Slider::new(&mut frame, 0..=last).show_value(false)).accessible_name("Frame");
        if slider.on_hover_text("Frame of the story").changed() {
            lab.stepper.frame = frame;
            lab.stepper.playing = false;
        }
        ui.label(RichText::new("t").italics());
        let Some(t) = lab.parameter(object) else { return };
        let length = lab.curve().map_or(1.0, |curve| {
            let (left, right) = curve.space().parameter_interval();
            right - left
        });
        let field = NumberField::new("Parameter of the scheme", t)
            .width(ui.available_width().clamp(40.0, 70.0))
            .drag(Drag::PerPixel(length / 500.0))
            .show(ui, "scheme parameter");
        if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = field.event {
            lab.set_parameter(object, to);
        }
    });
}

fn speed(ui: &Ui) -> (eframe::egui::Id, f64) {
    let id = ui.make_persistent_id("stepper speed");
    (id, ui.data(|data| data.get_temp::<f64>(id)).unwrap_or(1.0))
}

/// Lets the frames follow each other.
fn play(lab: &mut Lab, ui: &Ui, last: usize) {
    if !lab.stepper.playing {
        return;
    }
    if lab.stepper.frame >= last {
        lab.stepper.playing = false;
        return;
    }
    let (_, speed) = speed(ui);
    // A long pause of the window is not a long step of the story.
    lab.stepper.elapsed += f64::from(ui.input(|input| input.stable_dt)).min(0.5) * speed;
    if lab.stepper.elapsed >= FRAME_SECONDS {
        lab.stepper.frame += 1;
        lab.stepper.elapsed = 0.0;
    }
    ui.ctx().request_repaint();
}

/// Sizes of the cells of a table.
#[derive(Clone, Copy, Debug)]
struct Grid {
    cell: Vec2,
    pitch: f32,
    lines: usize,
}

impl Grid {
    fn new(lab: &Lab, stepper: &Stepper, room: f32) -> Self {
        let count = stepper.levels()[0].len();
        let lines = texts(&stepper.levels()[0][0]).len();
        let scale = lab.theme.text_scale as f32;
        let pitch = ((room - 4.0) / count as f32).clamp(58.0 * scale, 96.0 * scale);
        Self { cell: vec2(pitch - 10.0, (21.0 + 13.0 * lines as f32) * scale), pitch, lines }
    }

    fn rect(&self, origin: eframe::egui::Pos2, level: usize, position: usize) -> Rect {
        let x = (position as f32 + 0.5 * level as f32) * self.pitch + 5.0;
        let y = level as f32 * (self.cell.y + GAP);
        Rect::from_min_size(origin + vec2(x, y), self.cell)
    }
}

/// Coordinates, and the weight if there is one, each on its line.
fn texts(entry: &Entry) -> Vec<String> {
    let mut texts: Vec<String> = entry.coordinates.iter().map(|&value| compact(value)).collect();
    texts.extend(entry.weight.map(|weight| format!("w {}", compact(weight))));
    texts
}

fn table(lab: &mut Lab, ui: &mut Ui, object: ObjectId, stepper: &Stepper) {
    let Some(frame) = stepper.frames().get(lab.stepper.frame) else { return };
    let revealed: BTreeSet<(usize, usize)> = stepper.revealed(lab.stepper.frame).into_iter().collect();
    let highlighted: BTreeSet<(usize, usize)> = frame.highlights.iter().copied().collect();
    let grid = Grid::new(lab, stepper, ui.available_width());
    let levels = stepper.levels();
    let size = vec2(
        grid.pitch * levels[0].len() as f32 + 2.0,
        levels.len() as f32 * (grid.cell.y + GAP) - GAP + 2.0,
    );
    ScrollArea::horizontal().id_salt("scheme").auto_shrink([false, true]).show(ui, |ui| {
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let origin = rect.min + vec2(((ui.available_width() - size.x) * 0.5).max(0.0), 1.0);
        for entry in stepper.table().filter(|entry| entry.level > 0) {
            arrows(lab, ui, &grid, origin, entry, &revealed, &highlighted);
        }
        for entry in stepper.table() {
            let look = Look {
                shown: revealed.contains(&entry.tie()),
                highlighted: highlighted.contains(&entry.tie()),
                lit: is_lit(lab, object, entry),
            };
            cell(
                lab,
                ui,
                object,
                stepper,
                grid.rect(origin, entry.level, entry.position),
                entry,
                look,
                grid.lines,
            );
        }
    });
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
        Hovered::Point(over, point) => over == object && entry.level == 0 && entry.index == point,
        _ => false,
    }
}

/// The two lines from the parents, with their weights.
fn arrows(
    lab: &Lab,
    ui: &Ui,
    grid: &Grid,
    origin: eframe::egui::Pos2,
    entry: &Entry,
    revealed: &BTreeSet<(usize, usize)>,
    highlighted: &BTreeSet<(usize, usize)>,
) {
    let Some(share) = entry.share else { return };
    let child = grid.rect(origin, entry.level, entry.position);
    let shown = revealed.contains(&entry.tie());
    let told = highlighted.contains(&entry.tie()) && shown;
    let opacity = if shown { 1.0 } else { 0.25 };
    let tint = if told { lab.theme.accent } else { lab.theme.muted_text };
    let ink = color32(tint).gamma_multiply(opacity);
    let font = FontId::proportional(10.0 * lab.theme.text_scale as f32);
    for (side, weight) in [(0, 1.0 - share), (1, share)] {
        let parent = grid.rect(origin, entry.level - 1, entry.position + side);
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let from = pos2(parent.center().x - sign * 0.15 * grid.cell.x, parent.bottom() + 1.0);
        let to = pos2(child.center().x + sign * 0.22 * grid.cell.x, child.top() - 1.0);
        ui.painter()
            .line_segment([from, to], Stroke::new(if told { 1.6 } else { 1.0 }, ink.gamma_multiply(0.8)));
        // The number stands on its line, the line behind it wiped out: beside it there is no room.
        let text = if grid.pitch < 64.0 { with_digits(weight, 2) } else { compact(weight) };
        let galley = ui.painter().layout_no_wrap(text, font.clone(), ink);
        let place = Align2::CENTER_CENTER.anchor_size(from.lerp(to, 0.5), galley.size());
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
    let value = texts(entry).join(", ");
    response
        .widget_info(|| WidgetInfo::labeled(Role::Cell, true, format!("{} = ({value})", entry.plain_label)));
    if response.hovered() {
        lab.hovering = Hovered::Entry(object, level, position);
    }
    if response.clicked() {
        if level == 0 {
            lab.selection.points = BTreeSet::from([entry.index]);
            lab.selection.knot = None;
        }
        let telling = stepper.frames().iter().position(|frame| frame.reveals.contains(&(level, position)));
        if let Some(frame) = telling.filter(|_| level > 0) {
            lab.stepper.frame = frame;
            lab.stepper.playing = false;
        }
    }
    if !ui.is_rect_visible(rect) {
        return;
    }
    let theme = &lab.theme;
    let opacity = if look.shown || look.lit { 1.0 } else { 0.3 };
    let own = if level == 0 { color32(theme.basis_color(entry.index)) } else { ui.visuals().text_color() };
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
    for (line, text) in texts(entry).iter().enumerate() {
        let y = rect.bottom() - 3.0 - step * (lines - line) as f32;
        painter.text(pos2(middle, y), Align2::CENTER_TOP, text, FontId::proportional(11.0 * scale), ink);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use egui_kittest::kittest::Queryable as _;

    const SIZE: (f32, f32) = (290.0, 640.0);

    #[test]
    fn one_step_on_shows_the_next_frame_and_back_the_one_before() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        window.get_by_label("One step on").click();
        window.run();
        window.get_by_label("One step on").click();
        window.run();
        assert_eq!(window.state().stepper.frame, 2, "two steps on");
        window.get_by_label("One step back").click();
        window.run();
        assert_eq!(window.state().stepper.frame, 1, "one back");
    }

    #[test]
    fn playing_goes_on_by_itself_and_ends() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        window.get_by_label("Play").click();
        window.step();
        for _ in 0..2000 {
            if !window.state().stepper.playing && window.state().stepper.frame > 0 {
                break;
            }
            window.step();
        }
        let last = window.state().scheme().unwrap().frames().len() - 1;
        assert_eq!(window.state().stepper.frame, last, "the last frame");
        assert!(!window.state().stepper.playing, "it stops there");
    }

    #[test]
    fn an_entry_under_the_pointer_lights_up_everywhere() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let object = window.state().selection.object.unwrap();
        let entry = window.state().scheme().unwrap().levels()[1][2].clone();
        let cell = window.get_by_label_contains(&format!("{} = ", entry.plain_label)).rect().center();
        window.hover_at(cell);
        window.run();
        assert_eq!(window.state().hovered, Hovered::Entry(object, 1, 2), "entry 2 of level 1");
    }
}
