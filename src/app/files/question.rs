//! The questions that stop everything else: unsaved changes, documents after a crash, and messages that must be read.

use std::path::PathBuf;
use std::time::SystemTime;

use eframe::egui::{self, Align, Align2, Button, Id, Key, Layout, Modifiers, RichText, ScrollArea, Ui};

use crate::app::dialog;
use crate::app::files::{Then, name_of};
use crate::app::lab::Lab;
use crate::document::Recovered;

/// Width of a question in logical pixels.
const WIDTH: f32 = 420.0;

/// What is asked.
#[derive(Debug)]
pub(super) enum Question {
    /// Nothing is asked: the file is opened in this frame.
    Open(PathBuf),
    /// Whether to save before something that would lose changes.
    Unsaved(Then),
    /// What to do with documents that a crash left behind.
    Recovery,
}

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reply {
    /// Do it.
    Yes,
    /// Go on without it.
    No,
    /// Everything stays as it is.
    Cancel,
    /// Open the document with this index.
    BringBack(usize),
    /// Give up the document with this index.
    Discard(usize),
}

impl Question {
    /// Asks; the answer as soon as there is one.
    pub(super) fn show(&self, lab: &Lab, recovered: &[Recovered], ui: &mut Ui) -> Option<Reply> {
        match self {
            Self::Open(_) => Some(Reply::Yes),
            Self::Unsaved(_) => ask_to_save(lab, ui),
            Self::Recovery => offer(recovered, ui),
        }
    }
}

fn ask_to_save(lab: &Lab, ui: &mut Ui) -> Option<Reply> {
    let mut reply = None;
    if take(Key::Escape, ui) {
        reply = Some(Reply::Cancel);
    } else if take(Key::Enter, ui) {
        reply = Some(Reply::Yes);
    }
    dialog::show("unsaved changes", WIDTH, ui, |ui| {
        ui.heading("Save the changes?");
        ui.add_space(4.0);
        let name = match (&lab.path, &lab.lesson) {
            (Some(path), _) => name_of(path),
            (None, Some(state)) => format!("the document of lesson {}", state.lesson.section),
            (None, None) => "this document".to_owned(),
        };
        ui.label(format!("The last changes to {name} are in no file yet."));
        ui.add_space(10.0);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let word = if lab.path.is_some() { "Save" } else { "Save as…" };
            if ui.add(dialog::main_button(word, ui)).clicked() {
                reply = Some(Reply::Yes);
            }
            for (word, answer) in [("Don't save", Reply::No), ("Cancel", Reply::Cancel)] {
                if ui.button(word).clicked() {
                    reply = Some(answer);
                }
            }
        });
    });
    reply
}

fn offer(recovered: &[Recovered], ui: &mut Ui) -> Option<Reply> {
    let mut reply = take(Key::Escape, ui).then_some(Reply::Cancel);
    dialog::show("recovery", WIDTH, ui, |ui| {
        ui.heading("The lab was not closed properly");
        ui.add_space(4.0);
        ui.label(match recovered.len() {
            1 => "One document can be brought back.".to_owned(),
            count => format!("{count} documents can be brought back."),
        });
        ui.add_space(6.0);
        ScrollArea::vertical().max_height(220.0).show(ui, |ui| {
            for (index, document) in recovered.iter().enumerate() {
                ui.horizontal(|ui| {
                    let name = document.original.as_deref().map_or_else(|| "Untitled".to_owned(), name_of);
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        for (word, answer) in
                            [("Discard", Reply::Discard(index)), ("Open", Reply::BringBack(index))]
                        {
                            let response = ui.add(Button::new(word));
                            let label = format!("{word} {name}, {}", index + 1);
                            response
                                .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
                            if response.clicked() {
                                reply = Some(answer);
                            }
                        }
                        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                            let text = ui.add(egui::Label::new(&name).truncate());
                            if let Some(path) = &document.original {
                                text.on_hover_text(path.display().to_string());
                            }
                            let objects = document.saved.document.len();
                            let objects = if objects == 1 {
                                "1 object".to_owned()
                            } else {
                                format!("{objects} objects")
                            };
                            ui.label(RichText::new(format!("{objects}, {}", age(document.written))).weak());
                        });
                    });
                });
            }
        });
        ui.add_space(8.0);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Later").on_hover_text("Ask again at the next start").clicked() {
                reply = Some(Reply::Cancel);
            }
            if recovered.len() > 1 && ui.button("Discard all").clicked() {
                reply = Some(Reply::No);
            }
        });
    });
    reply
}

/// How long ago, in words.
fn age(written: SystemTime) -> String {
    let minutes = written.elapsed().map_or(0, |elapsed| elapsed.as_secs() / 60);
    match minutes {
        0 => "just now".to_owned(),
        1..60 => format!("{minutes} min ago"),
        60..2880 => format!("{} h ago", minutes / 60),
        _ => format!("{} days ago", minutes / 1440),
    }
}

/// A message that must be read.
#[derive(Debug)]
pub(super) struct Problem {
    title: &'static str,
    text: String,
}

impl Problem {
    /// A message under `title`.
    pub(super) fn new(title: &'static str, text: String) -> Self {
        Self { title, text }
    }

    /// Shows it; whether it has been read.
    pub(super) fn show(&self, ui: &mut Ui) -> bool {
        let mut read = take(Key::Escape, ui) || take(Key::Enter, ui);
        dialog::show("problem", WIDTH, ui, |ui| {
            ui.heading(self.title);
            ui.add_space(4.0);
            ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
                ui.add(egui::Label::new(&self.text).wrap().selectable(true));
            });
            ui.add_space(10.0);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                read |= ui.add(dialog::main_button("OK", ui)).clicked();
            });
        });
        read
    }
}

/// While a file is held over the window: what letting go of it will do.
pub(super) fn show_drop_hint(ui: &Ui) {
    let painter = ui.ctx().layer_painter(egui::LayerId::new(egui::Order::Tooltip, Id::unique("drop hint")));
    let rect = ui.ctx().content_rect();
    let visuals = &ui.global_style().visuals;
    painter.rect_filled(rect, 0, visuals.panel_fill.gamma_multiply(0.85));
    let font = egui::TextStyle::Heading.resolve(&ui.global_style());
    painter.text(rect.center(), Align2::CENTER_CENTER, "Let go to open the file", font, visuals.text_color());
}

fn take(key: Key, ui: &Ui) -> bool {
    ui.input_mut(|input| input.consume_key(Modifiers::NONE, key))
}
