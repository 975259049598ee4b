//! A text that can be typed: it is taken with Enter or Tab if it is acceptable, else it stays, red, with the reason.

use eframe::egui::{self, Id, Key, TextEdit, Ui};

/// What is being typed, or could not be taken.
#[derive(Clone, Debug)]
struct Draft {
    text: String,
    started_from: String,
}

/// A text field under construction.
#[derive(Debug)]
pub(crate) struct TextField<'a> {
    label: &'a str,
    value: &'a str,
    rows: usize,
    hint: &'a str,
}

impl<'a> TextField<'a> {
    /// A field that is called `label` and shows `value`.
    pub(crate) fn new(label: &'a str, value: &'a str) -> Self {
        Self { label, value, rows: 1, hint: "" }
    }

    /// Height in lines; with more than one, Shift+Enter breaks a line.
    pub(crate) fn rows(mut self, rows: usize) -> Self {
        self.rows = rows;
        self
    }

    /// Shown while the field is empty.
    pub(crate) fn hint(mut self, hint: &'a str) -> Self {
        self.hint = hint;
        self
    }

    /// Shows the field with what `check` objects to beneath it. Returns the text once it is taken and differs.
    pub(crate) fn show(
        self,
        ui: &mut Ui,
        salt: impl egui::AsIdSalt,
        check: impl Fn(&str) -> Result<(), String>,
    ) -> Option<String> {
        let id = ui.make_persistent_id(salt);
        let mut draft: Option<Draft> = ui.data(|data| data.get_temp(id));
        if draft.as_ref().is_some_and(|draft| draft.started_from != self.value) {
            draft = None;
        }
        let mut text = draft.as_ref().map_or_else(|| self.value.to_owned(), |draft| draft.text.clone());
        let object_to = |text: &str| if text == self.value { None } else { check(text).err() };
        let mut reason = object_to(&text);
        let enter = self.rows > 1 && take_enter(ui, id);
        let edit =
            if self.rows > 1 { TextEdit::multiline(&mut text) } else { TextEdit::singleline(&mut text) };
        let mut edit =
            edit.id(id).desired_width(f32::INFINITY).desired_rows(self.rows).hint_text(self.hint.to_owned());
        if reason.is_some() {
            edit = edit.text_color(ui.visuals().error_fg_color);
        }
        let response = ui.add(edit).accessible_name(self.label);
        if response.changed() {
            reason = object_to(&text);
        }
        if let Some(reason) = &reason {
            ui.colored_label(ui.visuals().error_fg_color, reason);
        }
        let mut taken = None;
        if (response.lost_focus() || enter) && !ui.input(|input| input.key_pressed(Key::Escape)) {
            if text != self.value && reason.is_none() {
                taken = Some(text.clone());
            }
            if enter && reason.is_none() {
                response.surrender_focus();
            }
        } else if response.lost_focus() {
            self.value.clone_into(&mut text);
        }
        ui.data_mut(|data| {
            if text == self.value || taken.is_some() {
                data.remove::<Draft>(id);
            } else {
                data.insert_temp(id, Draft { text, started_from: self.value.to_owned() });
            }
        });
        taken
    }
}

/// Enter without Shift in a field of several lines: it takes the text instead of breaking the line.
fn take_enter(ui: &Ui, id: Id) -> bool {
    ui.memory(|memory| memory.has_focus(id))
        && ui
            .input_mut(|input| !input.modifiers.shift && input.consume_key(egui::Modifiers::NONE, Key::Enter))
}
