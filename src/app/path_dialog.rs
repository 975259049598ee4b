//! The lab's own file dialog: a field for the path above the list of the folder. It needs nothing of the desktop.

use std::cmp::Ordering;
use std::fs;
use std::path::{Path, PathBuf};

use eframe::egui::text::CCursorRange;
use eframe::egui::{self, Align, Button, Id, Key, Layout, Modifiers, RichText, ScrollArea, TextEdit, Ui};

use crate::app::dialog;
use crate::app::file_dialog::{Answer, Purpose, Request, with_extension};

/// Entries that are listed at most; more are counted.
const LIST_LIMIT: usize = 2000;

/// One line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Entry {
    name: String,
    path: PathBuf,
    is_folder: bool,
}

/// The contents of a folder, as far as they matter.
#[derive(Debug, Default)]
struct Listing {
    entries: Vec<Entry>,
    left_out: usize,
    error: Option<String>,
}

/// The dialog.
#[derive(Debug)]
pub(crate) struct PathDialog {
    request: Request,
    folder: PathBuf,
    typed: String,
    listing: Listing,
    complaint: Option<String>,
    replace: Option<PathBuf>,
    fresh: bool,
}

/// What a person has done in one frame.
enum Action {
    Accept,
    Cancel,
    Enter(PathBuf),
    Pick(Entry),
    PickAndAccept(Entry),
}

impl PathDialog {
    /// Shows the folder of `request`, or the nearest folder above that exists.
    pub(crate) fn new(request: Request) -> Self {
        let absolute = std::path::absolute(&request.folder).unwrap_or_else(|_| request.folder.clone());
        let folder = absolute.ancestors().find(|folder| folder.is_dir()).unwrap_or(Path::new("/")).to_owned();
        let listing = list(&folder, &request);
        let typed = request.file_name.clone();
        Self { request, folder, typed, listing, complaint: None, replace: None, fresh: true }
    }

    /// Shows the dialog; the answer as soon as there is one.
    pub(crate) fn show(&mut self, ui: &mut Ui) -> Option<Answer> {
        let mut action = None;
        // Taken before the field sees them, so that they mean the same wherever the focus is.
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            action = Some(Action::Cancel);
        }
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter)) {
            action = Some(Action::Accept);
        }
        dialog::show("path dialog", 520.0, ui, |ui| {
            ui.heading(self.request.title);
            ui.add_space(4.0);
            self.folder_line(ui, &mut action);
            self.list(ui, &mut action);
            ui.add_space(6.0);
            self.path_field(ui);
            if let Some(complaint) = &self.complaint {
                ui.label(RichText::new(complaint).color(ui.visuals().error_fg_color));
            }
            ui.add_space(10.0);
            self.buttons(ui, &mut action);
        });
        self.fresh = false;
        match action? {
            Action::Cancel => Some(Answer::Cancelled),
            Action::Accept => self.accept(),
            Action::Enter(folder) => {
                self.enter(folder);
                None
            }
            Action::Pick(entry) => {
                self.pick(&entry);
                None
            }
            Action::PickAndAccept(entry) => {
                self.pick(&entry);
                self.accept()
            }
        }
    }

    fn folder_line(&self, ui: &mut Ui, action: &mut Option<Action>) {
        ui.horizontal(|ui| {
            let above = self.folder.parent();
            let up =
                ui.add_enabled(above.is_some(), Button::new("Up")).on_hover_text("Show the folder above");
            if up.clicked()
                && let Some(above) = above
            {
                *action = Some(Action::Enter(above.to_owned()));
            }
            ui.add(egui::Label::new(RichText::new(self.folder.display().to_string()).weak()).truncate());
        });
    }

    fn list(&self, ui: &mut Ui, action: &mut Option<Action>) {
        let height = 240.0_f32.min(ui.ctx().content_rect().height() - 260.0).max(60.0);
        egui::Frame::group(ui.style()).inner_margin(4).show(ui, |ui| {
            let area =
                ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false);
            area.show(ui, |ui| {
                ui.set_min_height(height);
                ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                    ui.spacing_mut().item_spacing.y = 1.0;
                    for entry in &self.listing.entries {
                        let text =
                            if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
                        let chosen = !entry.is_folder && self.typed == entry.name;
                        let line = ui.add(Button::selectable(chosen, text).truncate());
                        if line.clicked() {
                            *action = Some(if entry.is_folder {
                                Action::Enter(entry.path.clone())
                            } else {
                                Action::Pick(entry.clone())
                            });
                        }
                        if line.double_clicked() && !entry.is_folder {
                            *action = Some(Action::PickAndAccept(entry.clone()));
                        }
                    }
                    if let Some(error) = &self.listing.error {
                        ui.label(RichText::new(error).color(ui.visuals().error_fg_color));
                    } else if self.listing.entries.is_empty() {
                        ui.label(RichText::new(format!("No {} here", self.request.kind)).weak());
                    }
                    if self.listing.left_out > 0 {
                        ui.label(
                            RichText::new(format!("and {} more; type the path", self.listing.left_out))
                                .weak(),
                        );
                    }
                });
            });
        });
    }

    fn path_field(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let label = ui.label("Path");
            let id = Id::unique("path dialog field");
            let hint = match self.request.purpose {
                Purpose::Open => "Name or path of the file",
                Purpose::Save => "Name or path to write to",
            };
            let field =
                TextEdit::singleline(&mut self.typed).id(id).hint_text(hint).desired_width(f32::INFINITY);
            let response = ui.add(field).labelled_by(label.id);
            if response.changed() {
                self.complaint = None;
                self.replace = None;
            }
            if self.fresh {
                response.request_focus();
                // The name is selected: typing replaces it.
                let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
                state.cursor.set_char_range(Some(CCursorRange::select_all_str(&self.typed)));
                TextEdit::store_state(ui.ctx(), id, state);
            }
        });
    }

    fn buttons(&self, ui: &mut Ui, action: &mut Option<Action>) {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let word = match (self.request.purpose, &self.replace) {
                (Purpose::Open, _) => "Open",
                (Purpose::Save, None) => "Save",
                (Purpose::Save, Some(_)) => "Replace",
            };
            let button = dialog::main_button(word, ui);
            if ui.add_enabled(!self.typed.trim().is_empty(), button).clicked() {
                *action = Some(Action::Accept);
            }
            if ui.button("Cancel").clicked() {
                *action = Some(Action::Cancel);
            }
        });
    }

    fn enter(&mut self, folder: PathBuf) {
        self.listing = list(&folder, &self.request);
        self.folder = folder;
        self.complaint = None;
        self.replace = None;
        if self.request.purpose == Purpose::Open {
            self.typed.clear();
        }
    }

    fn pick(&mut self, entry: &Entry) {
        self.typed.clone_from(&entry.name);
        self.complaint = None;
        self.replace = None;
    }

    /// What was typed, as a path from the folder that is shown; `~` is the home folder.
    fn path(&self) -> PathBuf {
        let typed = self.typed.trim();
        let home = std::env::var_os("HOME").map(PathBuf::from);
        match (typed.strip_prefix("~/").or((typed == "~").then_some("")), home) {
            (Some(rest), Some(home)) => home.join(rest),
            _ => self.folder.join(typed),
        }
    }

    fn accept(&mut self) -> Option<Answer> {
        if self.typed.trim().is_empty() {
            self.complaint = Some("Type the name of a file, or choose one from the list.".to_owned());
            return None;
        }
        let path = self.path();
        if path.is_dir() {
            self.enter(path);
            self.typed.clear();
            return None;
        }
        match self.request.purpose {
            Purpose::Open if !path.exists() => {
                self.complaint = Some(format!("There is no file {}.", path.display()));
                None
            }
            Purpose::Open => Some(Answer::Path(path)),
            Purpose::Save => self.accept_to_save(with_extension(path, &self.request)),
        }
    }

    fn accept_to_save(&mut self, path: PathBuf) -> Option<Answer> {
        if !path.parent().is_some_and(Path::is_dir) {
            let folder = path.parent().unwrap_or(Path::new("")).display();
            self.complaint = Some(format!("There is no folder {folder}."));
            return None;
        }
        if path.exists() && self.replace.as_ref() != Some(&path) {
            self.complaint = Some(format!("{} exists already. Replace it?", path.display()));
            self.replace = Some(path);
            return None;
        }
        Some(Answer::Path(path))
    }
}

/// Folders first, then files with a wanted ending; hidden ones are left out.
fn list(folder: &Path, request: &Request) -> Listing {
    let read = match fs::read_dir(folder) {
        Ok(read) => read,
        Err(error) => {
            return Listing {
                error: Some(format!("This folder cannot be read: {error}.")),
                ..Listing::default()
            };
        }
    };
    let mut entries: Vec<Entry> = read
        .filter_map(Result::ok)
        .filter_map(|entry| {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_folder = path.is_dir();
            let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            let wanted = ending.is_some_and(|ending| request.extensions.contains(&ending.as_str()));
            (!name.starts_with('.') && (is_folder || wanted)).then_some(Entry { name, path, is_folder })
        })
        .collect();
    entries.sort_by(by_kind_and_name);
    let left_out = entries.len().saturating_sub(LIST_LIMIT);
    entries.truncate(LIST_LIMIT);
    Listing { entries, left_out, error: None }
}

fn by_kind_and_name(a: &Entry, b: &Entry) -> Ordering {
    b.is_folder.cmp(&a.is_folder).then_with(|| a.name.to_lowercase().cmp(&b.name.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    struct Asking {
        dialog: PathDialog,
        answer: Option<Answer>,
    }

    fn asking(purpose: Purpose, folder: &Path, file_name: &str) -> Harness<'static, Asking> {
        let request = Request {
            purpose,
            title: "Choose",
            kind: "documents",
            extensions: &["spline", "svg"],
            folder: folder.to_owned(),
            file_name: file_name.to_owned(),
        };
        let state = Asking { dialog: PathDialog::new(request), answer: None };
        let show = |ui: &mut Ui, asking: &mut Asking| {
            if asking.answer.is_none() {
                asking.answer = asking.dialog.show(ui);
            }
        };
        let mut harness = Harness::builder().with_size([700.0, 520.0]).build_ui_state(show, state);
        harness.run();
        harness
    }

    fn type_path(harness: &mut Harness<'static, Asking>, text: &str) {
        harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "Path").type_text(text);
        harness.run();
    }

    #[test]
    fn a_typed_path_and_enter_answer_the_question() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("wave.spline"), "{}").unwrap();
        let mut harness = asking(Purpose::Open, folder.path(), "");
        type_path(&mut harness, "wave.spline");
        harness.key_press(Key::Enter);
        harness.run();
        let wanted = Answer::Path(folder.path().join("wave.spline"));
        assert_eq!(harness.state().answer, Some(wanted), "{:?}", harness.state().dialog.complaint);
    }

    #[test]
    fn escape_cancels() {
        let folder = tempfile::tempdir().unwrap();
        let mut harness = asking(Purpose::Open, folder.path(), "");
        harness.key_press(Key::Escape);
        harness.run();
        assert_eq!(harness.state().answer, Some(Answer::Cancelled), "after Escape");
    }

    #[test]
    fn a_file_that_does_not_exist_is_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let mut harness = asking(Purpose::Open, folder.path(), "");
        type_path(&mut harness, "nothing.spline");
        harness.key_press(Key::Enter);
        harness.run();
        assert_eq!(harness.state().answer, None, "a missing file was accepted");
        let complaint = harness.state().dialog.complaint.clone().unwrap_or_default();
        assert!(complaint.contains("nothing.spline"), "{complaint:?} does not name the file");
    }

    #[test]
    fn the_list_shows_folders_and_matching_files_only() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.spline", "A.SVG", "notes.txt", ".hidden.spline"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        fs::create_dir(folder.path().join("zoo")).unwrap();
        let harness = asking(Purpose::Open, folder.path(), "");
        let names: Vec<&str> =
            harness.state().dialog.listing.entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["zoo", "A.SVG", "b.spline"], "listed");
    }

    #[test]
    fn an_existing_file_is_replaced_only_when_asked_twice() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("wave.spline"), "precious").unwrap();
        let mut harness = asking(Purpose::Save, folder.path(), "untitled.spline");
        // The offered name is selected, so that typing replaces it.
        type_path(&mut harness, "wave");
        harness.key_press(Key::Enter);
        harness.run();
        assert_eq!(harness.state().answer, None, "typed {:?}", harness.state().dialog.typed);
        harness.get_by_label("Replace").click();
        harness.run();
        let wanted = Answer::Path(folder.path().join("wave.spline"));
        assert_eq!(harness.state().answer, Some(wanted), "typed {:?}", harness.state().dialog.typed);
    }

    #[test]
    fn a_name_without_ending_gets_the_usual_one() {
        let folder = tempfile::tempdir().unwrap();
        let mut harness = asking(Purpose::Save, folder.path(), "");
        type_path(&mut harness, "new");
        harness.get_by_label("Save").click();
        harness.run();
        assert_eq!(harness.state().answer, Some(Answer::Path(folder.path().join("new.spline"))), "saved as");
    }
}
