//! An algorithm with its numbers: choice, caption, formula and table, frame by frame.

mod choices;
mod table;

use eframe::egui::{RichText, ScrollArea, Slider, Ui};

use crate::app::command::Command;
use crate::app::formula_view;
use crate::app::icon::{self, Icon};
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::painter::color32;
use crate::app::toolbar;
use crate::document::ObjectId;

/// Seconds that a frame stays while playing at speed 1.
const FRAME_SECONDS: f64 = 1.6;

/// Shows the panel.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let selected = lab.selected();
    let Some((object, curve)) = selected.as_ref().and_then(|found| Some((found.id, found.curve()?))) else {
        ui.add_space(8.0);
        ui.label(RichText::new("Select a curve to step through an algorithm on it.").weak());
        return;
    };
    choices::algorithm(lab, ui);
    choices::more(lab, ui, curve);
    let stepper = match lab.told_scheme() {
        Some(Ok(stepper)) => stepper,
        told => {
            lab.stepper.playing = false;
            ui.add_space(6.0);
            if let Some(Err(reason)) = told {
                formula_view::rich_paragraph(ui, &reason);
            }
            choices::instead(lab, ui, curve);
            parameter(lab, ui, object);
            return;
        }
    };
    let last = stepper.frames().len().saturating_sub(1);
    lab.stepper.frame = lab.stepper.frame.min(last);
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
    ScrollArea::vertical().id_salt("stepper").auto_shrink([false, false]).show(ui, |ui| {
        table::show(lab, ui, object, &stepper);
        if let Some(note) = stepper.note() {
            ui.add_space(4.0);
            formula_view::rich_text(ui, note, color32(lab.theme.accent));
        }
        if stepper.table().any(|entry| !entry.parents.is_empty()) {
            ui.add_space(4.0);
            let text = "The numbers on the lines are the factors of the entries above.";
            ui.label(RichText::new(text).weak().small());
        }
        ui.add_space(4.0);
        toolbar::button("Export frames…", Command::ExportFrames, lab, ui);
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
        field_of_parameter(lab, ui, object);
    });
}

/// The parameter alone, where there is nothing to step through.
fn parameter(lab: &mut Lab, ui: &mut Ui, object: ObjectId) {
    ui.add_space(6.0);
    ui.horizontal(|ui| field_of_parameter(lab, ui, object));
}

fn field_of_parameter(lab: &mut Lab, ui: &mut Ui, object: ObjectId) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::lab::Hovered;
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
