//! Opening, saving, exporting, leaving: what happens to documents as files.
//!
//! A flow that would take a document from the desk is a [`Then`]: it runs at once when nothing would be lost, and after
//! the question whether to save otherwise. Files are read before anything is asked, so that a damaged one changes nothing.

mod exchange;
mod job;
mod keeper;
mod lessons;
mod question;

use std::path::{Path, PathBuf};

use eframe::egui::{Context, Ui, ViewportCommand};

use crate::app::approximation::new_approximation;
use crate::app::command::Command;
use crate::app::directories::Directories;
use crate::app::file_dialog::{self, Answer, FileDialog, Purpose, Request};
use crate::app::lab::Lab;
use crate::app::preferences::{self, Preferences};
use crate::app::sheet::Sheet;
use crate::document::{self, Document, EXTENSION, Recovered, Saved, View};
use crate::exchange::by_ending::{self, FIGURE_ENDINGS};
use crate::exchange::frames::FRAME_ENDINGS;
use crate::figure::theme::Theme;

use job::Job;
use keeper::Keeper;
use question::{Problem, Question, Reply};

pub(crate) use lessons::{back_to_document, back_to_example, open_lesson};

/// What is to be done once nothing can be lost any more.
#[derive(Debug)]
enum Then {
    New,
    Show(Box<Saved>, Option<PathBuf>),
    BringBack(Box<Recovered>),
    Quit,
}

/// What a file is asked for.
#[derive(Debug)]
enum Wanted {
    Open,
    Save(Option<Then>),
    Figure,
    Frames,
    Chart,
    Mesh,
    MeshOut,
    Data,
    DataCopy,
}

/// The files of the lab: dialogs, questions, preferences and the keeper of unsaved work.
#[derive(Debug)]
pub(crate) struct Files {
    preferences: Preferences,
    keeper: Keeper,
    dialog: Option<(FileDialog, Wanted)>,
    question: Option<Question>,
    problems: Vec<Problem>,
    recovered: Vec<Recovered>,
    job: Option<Job>,
    last_folder: Option<PathBuf>,
    desktop: bool,
    title: String,
    leaving: bool,
}

impl Files {
    /// Reads the preferences in `directories`, opens `file`, and looks for work that a crash left behind.
    pub(crate) fn in_directories(file: Option<PathBuf>, lab: &mut Lab, directories: Directories) -> Self {
        let (preferences, message) =
            directories.config.as_deref().map_or_else(Default::default, preferences::load);
        let mut problems: Vec<Problem> =
            message.map(|text| Problem::new("Preferences", text)).into_iter().collect();
        if let Some(theme) = Theme::by_name(&preferences.theme) {
            lab.theme = theme;
        }
        let autosave = directories.state.map(|state| state.join("autosave"));
        let (recovered, damaged) = autosave.as_deref().map_or_else(Default::default, keeper::abandoned);
        problems.extend(damaged.map(|text| Problem::new("Autosaved documents", text)));
        let keeper = Keeper::new(directories.config, autosave, preferences.clone());
        let mut files = Self {
            preferences,
            keeper,
            dialog: None,
            question: (!recovered.is_empty()).then_some(Question::Recovery),
            problems,
            recovered,
            job: None,
            last_folder: None,
            desktop: !cfg!(test) && file_dialog::has_desktop(),
            title: String::new(),
            leaving: false,
        };
        if let Some(path) = file
            && let Some(then) = files.read(&path)
        {
            files.run(then, lab);
        }
        files
    }

    /// Whether a dialog or a question is open and takes the keys.
    pub(crate) fn is_asking(&self) -> bool {
        self.dialog.is_some() || self.question.is_some() || !self.problems.is_empty()
    }

    /// Recent files, the last used first.
    pub(crate) fn recent(&self) -> impl Iterator<Item = PathBuf> {
        self.preferences.recent.iter().map(PathBuf::from)
    }

    /// Empties the list of recent files.
    pub(crate) fn forget_recent(&mut self) {
        self.preferences.recent.clear();
    }

    /// Whether work that a crash left behind is waiting.
    pub(crate) fn has_recovered(&self) -> bool {
        !self.recovered.is_empty()
    }

    /// Shows the list of what a crash left behind.
    pub(crate) fn offer_recovered(&mut self) {
        self.question = Some(Question::Recovery);
    }

    /// Opens `path` in the next frame.
    pub(crate) fn ask_to_open(&mut self, path: PathBuf) {
        self.question = Some(Question::Open(path));
    }

    /// Width or height that a panel had when the lab was last used.
    pub(crate) fn panel_size(&self, panel: &str, standard: f32) -> f32 {
        self.preferences.panel_sizes.get(panel).copied().unwrap_or(standard)
    }

    /// Remembers the width or height of a panel.
    pub(crate) fn note_panel_size(&mut self, panel: &str, size: f32) {
        if self.preferences.panel_sizes.get(panel) != Some(&size) {
            self.preferences.panel_sizes.insert(panel.to_owned(), size);
        }
    }

    /// Carries out `command`; `false` if it has nothing to do with files.
    pub(crate) fn execute(&mut self, command: Command, lab: &mut Lab, ctx: &Context) -> bool {
        match command {
            Command::New => self.proceed(Then::New, lab),
            Command::Open => self.ask_for_file(Wanted::Open, lab),
            Command::Save => match lab.path.clone() {
                Some(path) => {
                    self.save(&path, lab);
                }
                None => self.ask_for_file(Wanted::Save(None), lab),
            },
            Command::SaveAs => self.ask_for_file(Wanted::Save(None), lab),
            Command::ImportMesh => self.ask_for_file(Wanted::Mesh, lab),
            Command::ExportMesh => self.ask_for_file(Wanted::MeshOut, lab),
            Command::ExportFigure => self.ask_for_file(Wanted::Figure, lab),
            Command::ExportFrames => self.ask_for_file(Wanted::Frames, lab),
            Command::ExportChart => self.ask_for_file(Wanted::Chart, lab),
            Command::ImportData => self.ask_for_file(Wanted::Data, lab),
            Command::ExportData => self.ask_for_file(Wanted::DataCopy, lab),
            Command::NewApproximation => new_approximation(lab, None),
            Command::FirstScene => {
                let (document, view) = document::first_scene();
                self.proceed(Then::Show(Box::new(Saved { document, view }), None), lab);
            }
            Command::Quit => self.proceed(Then::Quit, lab),
            _ => return false,
        }
        ctx.request_repaint();
        true
    }

    /// Shows what is being asked, and keeps title, preferences and autosaved documents up to date.
    pub(crate) fn ui(&mut self, lab: &mut Lab, ui: &mut Ui) {
        self.show_dialog(lab, ui);
        self.show_question(lab, ui);
        if self.problems.first().is_some_and(|problem| problem.show(ui)) {
            self.problems.remove(0);
        }
        self.take_dropped_file(lab, ui);
        self.watch_job(lab, ui.ctx());
        self.watch_closing(lab, ui);
        self.name_window(lab, ui);
        lab.theme.name.clone_into(&mut self.preferences.theme);
        if let Some(error) = self.keeper.watch(lab, &self.preferences, ui.ctx()) {
            lab.problem(error);
        }
    }

    /// The lab ends: what is unsaved stays in the autosave folder unless it was given up.
    pub(crate) fn close(&mut self, lab: &mut Lab) {
        self.keeper.close(lab, &self.preferences, self.leaving);
    }

    fn ask_for_file(&mut self, wanted: Wanted, lab: &Lab) {
        let name =
            lab.path.as_deref().and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
        let name = name.unwrap_or_else(|| "untitled".to_owned());
        let of_document = lab.path.as_deref().and_then(Path::parent).map(Path::to_owned);
        let folder =
            of_document.or_else(|| self.last_folder.clone()).or_else(|| std::env::current_dir().ok());
        let folder = folder.unwrap_or_else(|| PathBuf::from("/"));
        let documents: &'static [&'static str] = &[EXTENSION, "svg", by_ending::MESH_ENDING];
        let meshes = &documents[2..];
        let (purpose, title, kind, extensions, file_name) = match &wanted {
            Wanted::Open => (Purpose::Open, "Open a document", "documents", documents, String::new()),
            Wanted::Save(_) => (
                Purpose::Save,
                "Save the document",
                "documents",
                &documents[..1],
                format!("{name}.{EXTENSION}"),
            ),
            Wanted::Mesh => (Purpose::Open, "Import a mesh", "meshes", meshes, String::new()),
            Wanted::MeshOut => (Purpose::Save, "Export the mesh", "meshes", meshes, format!("{name}.obj")),
            Wanted::Figure => {
                (Purpose::Save, "Export a figure", "figures", FIGURE_ENDINGS, format!("{name}.svg"))
            }
            Wanted::Frames => (
                Purpose::Save,
                "Export all frames",
                "figures",
                FRAME_ENDINGS,
                format!("{name}-{}.svg", lab.view.stepper.key()),
            ),
            Wanted::Chart => {
                let file_name = format!("{name}-{}.svg", lab.charts.quantity.name().to_lowercase());
                (Purpose::Save, "Export the chart", "figures and tables", exchange::CHARTS, file_name)
            }
            Wanted::Data => (Purpose::Open, "Import data", "tables", exchange::TABLES, String::new()),
            Wanted::DataCopy => {
                (Purpose::Save, "Export the data", "tables", exchange::TABLES, format!("{name}.csv"))
            }
        };
        let request = Request { purpose, title, kind, extensions, folder, file_name };
        self.dialog = Some((FileDialog::ask(request, self.desktop), wanted));
    }

    fn show_dialog(&mut self, lab: &mut Lab, ui: &mut Ui) {
        let Some((dialog, _)) = &mut self.dialog else { return };
        let Some(answer) = dialog.show(ui) else { return };
        let Some((_, wanted)) = self.dialog.take() else { return };
        let Answer::Path(path) = answer else { return };
        self.last_folder = path.parent().map(Path::to_owned);
        match wanted {
            Wanted::Open | Wanted::Mesh => self.open(&path, lab, ui.ctx()),
            Wanted::MeshOut => self.export_mesh(path, lab, ui.ctx()),
            Wanted::Figure => self.export(path, lab, ui.ctx()),
            Wanted::Frames => self.export_frames(path, lab, ui.ctx()),
            Wanted::Chart => self.export_chart(path, lab, ui.ctx()),
            Wanted::Data => self.import_data(&path, lab),
            Wanted::DataCopy => self.export_data(&path, lab),
            Wanted::Save(then) => {
                if self.save(&path, lab)
                    && let Some(then) = then
                {
                    self.proceed(then, lab);
                }
            }
        }
        ui.ctx().request_repaint();
    }

    fn show_question(&mut self, lab: &mut Lab, ui: &mut Ui) {
        if self.dialog.is_some() || !self.problems.is_empty() {
            return;
        }
        let Some(question) = &self.question else { return };
        let Some(reply) = question.show(lab, &self.recovered, ui) else { return };
        let question = self.question.take();
        match (reply, question) {
            (Reply::Yes, Some(Question::Open(path))) => self.open(&path, lab, ui.ctx()),
            (Reply::Yes, Some(Question::Unsaved(then))) => match lab.path.clone() {
                Some(path) => {
                    if self.save(&path, lab) {
                        self.proceed(then, lab);
                    }
                }
                None => self.ask_for_file(Wanted::Save(Some(then)), lab),
            },
            (Reply::No, Some(Question::Unsaved(then))) => {
                lab.history.mark_saved();
                lab.brought_back = false;
                self.proceed(then, lab);
            }
            (Reply::BringBack(index), _) if index < self.recovered.len() => {
                let recovered = self.recovered.remove(index);
                self.proceed(Then::BringBack(Box::new(recovered)), lab);
            }
            (Reply::Discard(index), question) if index < self.recovered.len() => {
                self.keeper.discard(self.recovered.remove(index).slot);
                self.question = question.filter(|_| !self.recovered.is_empty());
            }
            (Reply::No, Some(Question::Recovery)) => {
                for recovered in self.recovered.drain(..) {
                    self.keeper.discard(recovered.slot);
                }
            }
            // What was to be brought back keeps waiting when the question before it is cancelled.
            (Reply::Cancel, Some(Question::Unsaved(Then::BringBack(recovered)))) => {
                self.recovered.push(*recovered);
            }
            _ => {}
        }
        ui.ctx().request_repaint();
    }

    /// Runs `then` if nothing is lost by it; else asks.
    fn proceed(&mut self, then: Then, lab: &mut Lab) {
        lab.commit();
        let quits = matches!(then, Then::Quit);
        if !quits {
            lessons::leave(lab);
        }
        while !lab.is_modified() {
            if quits && lessons::next_with_changes(lab) {
                continue;
            }
            self.run(then, lab);
            return;
        }
        self.question = Some(Question::Unsaved(then));
    }

    fn run(&mut self, then: Then, lab: &mut Lab) {
        match then {
            Then::New => {
                let view = View { panels: lab.view.panels.clone(), ..View::default() };
                lab.put(Sheet::new(Document::new(), view, None));
            }
            Then::Show(saved, path) => {
                if let Some(path) = &path {
                    self.preferences.add_recent(path);
                }
                // A figure is opened for its document; saving asks where, so that the figure is not written over.
                let path = path.filter(|path| by_ending::is_document(path));
                lab.put(Sheet::new(saved.document, saved.view, path));
            }
            Then::BringBack(recovered) => {
                let Recovered { saved, original, slot, .. } = *recovered;
                let mut sheet = Sheet::new(saved.document, saved.view, original);
                sheet.brought_back = true;
                lab.put(sheet);
                self.keeper.brought_back(lab, slot);
                self.question = (!self.recovered.is_empty()).then_some(Question::Recovery);
            }
            Then::Quit => self.leaving = true,
        }
    }

    fn read(&mut self, path: &Path) -> Option<Then> {
        match by_ending::read_document(path) {
            Ok(saved) => Some(Then::Show(Box::new(saved), Some(path.to_owned()))),
            Err(error) => {
                self.preferences.forget_recent(path);
                self.problems.push(Problem::new("This file cannot be opened", error.to_string()));
                None
            }
        }
    }

    fn open(&mut self, path: &Path, lab: &mut Lab, ctx: &Context) {
        if by_ending::is_mesh(path) {
            self.import_mesh(path.to_owned(), lab, ctx);
            return;
        }
        if let Some(then) = self.read(path) {
            self.proceed(then, lab);
        }
    }

    fn save(&mut self, path: &Path, lab: &mut Lab) -> bool {
        lab.commit();
        let view = view_to_save(lab);
        if let Err(error) = document::save(path, lab.history.document(), &view) {
            self.problems.push(Problem::new("The document was not saved", error.to_string()));
            return false;
        }
        lab.path = Some(path.to_owned());
        lab.history.mark_saved();
        lab.brought_back = false;
        lab.shelf.saved += 1;
        self.preferences.add_recent(path);
        lab.done(format!("Saved as {}", name_of(path)));
        true
    }

    fn take_dropped_file(&mut self, lab: &mut Lab, ui: &Ui) {
        if !ui.input(|input| input.raw.hovered_files.is_empty()) {
            question::show_drop_hint(ui);
        }
        let dropped = ui.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped
            && !self.is_asking()
        {
            if exchange::is_table(&path) {
                self.import_data(&path, lab);
            } else {
                self.open(&path, lab, ui.ctx());
            }
        }
    }

    fn watch_closing(&mut self, lab: &mut Lab, ui: &Ui) {
        let asked = ui.input(|input| input.viewport().close_requested());
        if asked && !self.leaving {
            if self.question.is_none() {
                self.dialog = None;
                self.proceed(Then::Quit, lab);
            }
            if !self.leaving {
                ui.ctx().send_viewport_cmd(ViewportCommand::CancelClose);
            }
        } else if self.leaving && !asked {
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
        }
    }

    fn name_window(&mut self, lab: &Lab, ui: &Ui) {
        let name = match (&lab.path, &lab.lesson) {
            (Some(path), _) => name_of(path),
            (None, Some(state)) => state.lesson.heading(),
            (None, None) => "Untitled".to_owned(),
        };
        let star = if lab.is_modified() { "*" } else { "" };
        let title = format!("{star}{name} – Spline Lab");
        if title != self.title {
            ui.ctx().send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

/// The view as it is saved: with the look and the selection of this moment.
fn view_to_save(lab: &Lab) -> View {
    View {
        theme: lab.theme.name.to_owned(),
        selected_object: lab.selection.object,
        selected_points: lab.selection.points.iter().copied().collect(),
        ..lab.view.clone()
    }
}

/// Name of a file for people.
fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests;
