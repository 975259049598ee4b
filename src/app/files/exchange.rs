//! Files of other programs: meshes and tables in and out, figures out.

use std::path::{Path, PathBuf};
use std::sync::mpsc;

use eframe::egui::Ui;

use crate::app::approximation::take_table;
use crate::app::command::Command;
use crate::app::files::question::Problem;
use crate::app::files::{Files, name_of, view_to_save};
use crate::app::lab::Lab;
use crate::document::{Content, Edit};
use crate::exchange::by_ending::{self, FigureFormat};
use crate::exchange::csv::{CsvError, read_csv_file, write_csv};
use crate::exchange::obj;
use crate::figure::page::page;
use crate::figure::picture::Viewport;
use crate::figure::surfaces;

/// Pixels of an exported PNG per point: 144 to the inch, sharp on paper and on fine screens.
const PNG_SCALE: f64 = 2.0;

/// Endings of tables, the usual one first.
pub(super) const TABLES: &[&str] = &["csv", "tsv", "txt", "dat"];

impl Files {
    /// Adds the mesh of a file to the document, as one step.
    pub(super) fn import_mesh(&mut self, path: &Path, lab: &mut Lab) {
        match by_ending::read_mesh(path) {
            Ok((name, mesh)) => {
                let is_first = surfaces::bounding_box(lab.history.document()).is_none();
                let made = lab.edit(Edit::AddObject { name, content: Content::Mesh(mesh) });
                if let Some(&id) = made.as_ref().and_then(|made| made.created.first()) {
                    lab.select(id);
                    if is_first {
                        lab.commands.push(Command::Fit);
                    }
                }
            }
            Err(error) => {
                self.problems.push(Problem::new("This mesh cannot be imported", error.to_string()));
            }
        }
    }

    /// Writes the selected mesh at the level that is shown.
    pub(super) fn export_mesh(&mut self, path: &Path, lab: &mut Lab) {
        let object = lab.selection.object.and_then(|id| lab.history.document().object(id));
        let Some(mesh) = object.and_then(|object| object.mesh()) else {
            lab.problem("Select a mesh first.");
            return;
        };
        let written = mesh.steps().map_err(|error| error.to_string()).and_then(|steps| {
            let refined = steps.last().map_or(mesh.cage(), |step| &step.mesh);
            let text = obj::write(refined);
            by_ending::write_file(path, text.as_bytes()).map_err(|error| error.to_string())
        });
        match written {
            Ok(()) => lab.done(format!("Mesh written to {}", name_of(path))),
            Err(error) => self.problems.push(Problem::new("The mesh was not written", error)),
        }
    }

    pub(super) fn export(&mut self, path: PathBuf, lab: &mut Lab) {
        let format = match FigureFormat::of(&path) {
            Ok(format) => format,
            Err(error) => {
                self.problems.push(Problem::new("The figure was not written", error.to_string()));
                return;
            }
        };
        let (document, view, theme) = (lab.history.document().clone(), view_to_save(lab), lab.theme.clone());
        let camera = lab.view.room_camera();
        let viewport = Viewport { center: camera.center, scale: camera.scale, size: lab.canvas_size };
        let (send, receive) = mpsc::channel();
        let write = move || {
            let (picture, viewport) = match page(&document, &view, &theme, &viewport) {
                Ok(page) => page,
                Err(error) => {
                    let _ = send.send(Err(error.to_string()));
                    return;
                }
            };
            let written = by_ending::figure(format, &picture, &viewport, &document, &view, PNG_SCALE)
                .and_then(|bytes| by_ending::write_file(&path, &bytes));
            // Nobody listens any more when the window has been closed meanwhile.
            let _ = send.send(written.map(|()| path).map_err(|error| error.to_string()));
        };
        match std::thread::Builder::new().name("figure".to_owned()).spawn(write) {
            Ok(_) => self.exporting = Some(receive),
            Err(error) => self.problems.push(Problem::new("The figure was not written", error.to_string())),
        }
    }

    pub(super) fn finish_export(&mut self, lab: &mut Lab, ui: &Ui) {
        let Some(exporting) = &self.exporting else { return };
        match exporting.try_recv() {
            Ok(Ok(path)) => lab.done(format!("Figure written to {}", name_of(&path))),
            Ok(Err(error)) => self.problems.push(Problem::new("The figure was not written", error)),
            Err(mpsc::TryRecvError::Empty) => {
                ui.ctx().request_repaint_after(std::time::Duration::from_millis(50));
                return;
            }
            Err(mpsc::TryRecvError::Disconnected) => {
                self.problems
                    .push(Problem::new("The figure was not written", "The writer stopped.".to_owned()));
            }
        }
        self.exporting = None;
    }

    pub(super) fn import_data(&mut self, path: &Path, lab: &mut Lab) {
        match read_csv_file(path) {
            Ok(table) => take_table(lab, table, &name_of(path)),
            Err(error) => {
                let text = match &error {
                    CsvError::Io { .. } | CsvError::TooLarge { .. } => error.to_string(),
                    _ => format!("{}: {error}", path.display()),
                };
                self.problems.push(Problem::new("These data cannot be imported", text));
            }
        }
    }

    pub(super) fn export_data(&mut self, path: &Path, lab: &mut Lab) {
        let Some(data) = lab.approximation() else { return };
        let text = write_csv(data.sites(), data.values(), data.weights());
        match by_ending::write_file(path, text.as_bytes()) {
            Ok(()) => lab.done(format!("Data written to {}", name_of(path))),
            Err(error) => {
                self.problems.push(Problem::new("The data were not written", error.to_string()));
            }
        }
    }
}

/// Whether `path` has the ending of a table.
pub(super) fn is_table(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| TABLES.contains(&ending.as_str()))
}
