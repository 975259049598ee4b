//! The list of lessons, and the open lesson: text, formula, things to try, a question.

use eframe::egui::{
    Align, Button, Color32, Frame, Key, Label, Layout, Modifiers, Rect, RichText, ScrollArea, Stroke,
    TextEdit, Ui, vec2,
};

use crate::app::command::Command;
use crate::app::lab::{Lab, LessonState};
use crate::app::painter::color32;
use crate::app::{files, formula_view};
use crate::course::{Answer, FitTask, Task, chapter_title, lessons};

/// Shows the lessons in the order of the course; a click opens one.
pub(crate) fn show_list(lab: &mut Lab, ui: &mut Ui) {
    ui.heading("Lessons");
    let open = lab.lesson.as_ref().map(|state| state.index);
    let seen_id = ui.make_persistent_id("lesson in the list");
    let seen: Option<usize> = ui.data(|data| data.get_temp(seen_id)).flatten();
    ui.data_mut(|data| data.insert_temp(seen_id, open));
    let mut chosen = None;
    ScrollArea::vertical().id_salt("lessons").auto_shrink([false, false]).show(ui, |ui| {
        let mut chapter = 0;
        for (index, lesson) in lessons().iter().enumerate() {
            if lesson.chapter() != chapter {
                chapter = lesson.chapter();
                ui.add_space(if index == 0 { 0.0 } else { 5.0 });
                ui.label(RichText::new(format!("{chapter}  {}", chapter_title(chapter))).weak().small());
            }
            let button = Button::selectable(open == Some(index), lesson.heading()).wrap();
            let response = ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| ui.add(button)).inner;
            if open == Some(index) && seen != open {
                // Turned to with a key, it may be out of sight.
                response.scroll_to_me(Some(Align::Center));
            }
            let answered = lab.shelf.answered.contains(&index);
            if answered {
                tick(ui, response.rect, color32(lab.theme.basis_color(2)));
            }
            let also = if answered { "; its question is answered" } else { "" };
            if response
                .on_hover_text(format!("Open the lesson of section {}{also}", lesson.section))
                .clicked()
            {
                chosen = Some(index);
            }
        }
    });
    if let Some(index) = chosen {
        files::open_lesson(lab, index);
    }
}

/// A tick at the right end of a row.
fn tick(ui: &Ui, row: Rect, color: Color32) {
    let at = row.right_center() - vec2(13.0, 0.0);
    let stroke = Stroke::new(2.0, color);
    for (from, to) in [((0.0, 0.0), (3.0, 3.5)), ((3.0, 3.5), (8.0, -4.0))] {
        ui.painter().line_segment([at + vec2(from.0, from.1), at + vec2(to.0, to.1)], stroke);
    }
}

/// Shows the open lesson.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    // Taken out for the frame, so that the lesson and the document can be used side by side.
    let Some(mut state) = lab.lesson.take() else {
        ui.add_space(8.0);
        ui.label(RichText::new("Choose a lesson on the left, or with PageDown.").weak());
        return;
    };
    let mut leave = false;
    ScrollArea::vertical().id_salt(("lesson", state.index)).auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        text(lab, ui, &state);
        ui.add_space(6.0);
        question(lab, ui, &mut state);
        ui.add_space(8.0);
        ui.separator();
        ui.horizontal_wrapped(|ui| {
            let (words, hint) = Command::BackToExample.text();
            if ui.button(words).on_hover_text(hint).clicked() {
                lab.commands.push(Command::BackToExample);
            }
            leave = ui
                .button("Back to my document")
                .on_hover_text("Close the lesson; work on it is kept")
                .clicked();
        });
    });
    lab.lesson = Some(state);
    if leave {
        files::back_to_document(lab);
    }
}

fn text(lab: &mut Lab, ui: &mut Ui, state: &LessonState) {
    let lesson = &state.lesson;
    ui.horizontal(|ui| {
        let count = lessons().len();
        ui.label(RichText::new(format!("Section {}", lesson.section)).weak());
        let place = ui.label(RichText::new(format!("{} of {count}", state.index + 1)).weak().small());
        let chapter = lesson.chapter();
        place.on_hover_text(format!(
            "Lesson {} of {count}; chapter {chapter}, {}",
            state.index + 1,
            chapter_title(chapter)
        ));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            for (command, text, enabled) in [
                (Command::NextLesson, "Next", state.index + 1 < count),
                (Command::PreviousLesson, "Previous", state.index > 0),
            ] {
                if ui
                    .add_enabled(enabled, Button::new(text).small())
                    .on_hover_text(command.text().1)
                    .clicked()
                {
                    lab.commands.push(command);
                }
            }
        });
    });
    ui.add(Label::new(RichText::new(&lesson.title).heading()).wrap());
    ui.add_space(2.0);
    for (index, paragraph) in lesson.paragraphs.iter().enumerate() {
        formula_view::rich_paragraph(ui, paragraph);
        ui.add_space(2.0);
        if index == 0 && !lesson.display_formula.is_empty() {
            let size = 16.0 * lab.theme.text_scale as f32;
            ui.vertical_centered(|ui| formula_view::formula(ui, &lesson.display_formula, size));
            ui.add_space(2.0);
        }
    }
    if lesson.things_to_try.is_empty() {
        return;
    }
    ui.add_space(4.0);
    ui.label(RichText::new("Things to try").strong());
    for (index, thing) in lesson.things_to_try.iter().enumerate() {
        ui.horizontal_top(|ui| {
            let width = 14.0 * lab.theme.text_scale as f32;
            ui.allocate_ui(vec2(width, 0.0), |ui| {
                ui.set_min_width(width);
                ui.label(RichText::new(format!("{}.", index + 1)).color(color32(lab.theme.accent)));
            });
            ui.vertical(|ui| formula_view::rich_paragraph(ui, thing));
        });
    }
}

fn question(lab: &mut Lab, ui: &mut Ui, state: &mut LessonState) {
    let frame = Frame::group(ui.style()).inner_margin(8.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.label(RichText::new("Question").strong());
        let question = &state.lesson.question;
        formula_view::rich_paragraph(ui, &question.prompt);
        let mut asked = None;
        match question.task {
            Task::Number { .. }
            | Task::Elements { .. }
            | Task::Surface { .. }
            | Task::Mesh { .. }
            | Task::Fit { asked: FitTask::Value { .. } | FitTask::ViolatingSite, .. } => {
                ui.horizontal(|ui| {
                    let width = (ui.available_width() - 72.0).clamp(60.0, 160.0);
                    let edit =
                        TextEdit::singleline(&mut state.answer).desired_width(width).hint_text("a number");
                    let field = ui.add(edit).accessible_name("Answer");
                    // Taken away, as Enter would also play the construction.
                    let entered = field.lost_focus()
                        && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter));
                    if field.changed() {
                        state.verdict = None;
                    }
                    if ui.button("Check").clicked() || entered {
                        asked = Some(Answer::Text(state.answer.clone()));
                    }
                });
            }
            Task::PlacePoint { .. } => {
                let place = lab
                    .selection
                    .points
                    .first()
                    .copied()
                    .zip(lab.curve())
                    .map(|(k, curve)| curve.points()[k]);
                let hint = "Select the control point that you put there";
                let button = ui.add_enabled(place.is_some(), Button::new("Check the selected point"));
                if button.on_disabled_hover_text(hint).clicked() {
                    asked = place.map(Answer::Point);
                }
            }
            Task::Shape { .. } | Task::Fit { asked: FitTask::ErrorBelow { .. }, .. } => {
                if ui.button("Check the curve").clicked() {
                    asked = Some(Answer::Curve);
                }
            }
        }
        if let Some(answer) = asked {
            let verdict = question.check(lab.history.document(), &answer);
            if verdict.correct {
                lab.shelf.answered.insert(state.index);
            }
            state.verdict = Some(verdict);
        }
        if let Some(verdict) = &state.verdict {
            let color = if verdict.correct { lab.theme.basis_color(2) } else { lab.theme.error };
            let word = if verdict.correct { "Right." } else { "Not yet." };
            ui.label(RichText::new(word).strong().color(color32(color)));
            formula_view::rich_paragraph(ui, &verdict.message);
        }
    });
}
