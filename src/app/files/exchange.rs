//! Files of other programs: meshes and tables in and out, figures out.

use std::path::{Path, PathBuf};

use eframe::egui::Context;

use crate::app::approximation::take_table;
use crate::app::chart_panel;
use crate::app::command::Command;
use crate::app::files::job::Finish;
use crate::app::files::question::Problem;
use crate::app::files::{Files, name_of, view_to_save};
use crate::app::lab::Lab;
use crate::app::side_rooms;
use crate::core::progress::{Part, Watcher};
use crate::document::{Content, Edit, MeshObject, Object};
use crate::exchange::by_ending::{self, FigureFormat};
use crate::exchange::csv::{CsvError, read_csv_file, write_csv};
use crate::exchange::frames::write_frames;
use crate::exchange::obj;
use crate::figure::chart::Chart;
use crate::figure::page::page;
use crate::figure::picture::Viewport;
use crate::figure::surfaces;

/// Pixels of an exported PNG per point: 144 to the inch, sharp on paper and on fine screens.
const PNG_SCALE: f64 = 2.0;

/// Endings of tables, the usual one first.
pub(super) const TABLES: &[&str] = &["csv", "tsv", "txt", "dat"];

/// Endings of charts, the usual one first.
pub(super) const CHARTS: &[&str] = &["svg", "pdf", "png", "tex", "csv"];

impl Files {
    /// Adds the mesh of a file to the document, as one step.
    pub(super) fn import_mesh(&mut self, path: PathBuf, lab: &mut Lab, ctx: &Context) {
        self.start_job(format!("Reading {}", name_of(&path)), lab, ctx, move |watcher| {
            let read = by_ending::read_mesh_watched(&path, watcher);
            Box::new(move |files, lab| match read {
                Ok((name, mesh)) => add_mesh(name, mesh, lab),
                Err(error) => {
                    files.problems.push(Problem::new("This mesh cannot be imported", error.to_string()));
                }
            })
        });
    }

    /// Writes the selected mesh at the level that is shown.
    pub(super) fn export_mesh(&mut self, path: PathBuf, lab: &mut Lab, ctx: &Context) {
        let object = lab.selection.object.and_then(|id| lab.history.document().object(id));
        let Some(object) = object.filter(|object| object.mesh().is_some()).cloned() else {
            lab.problem("Select a mesh first.");
            return;
        };
        self.start_job(format!("Writing {}", name_of(&path)), lab, ctx, move |watcher| {
            let written = write_mesh(&object, &path, watcher);
            said(written, "Mesh written to", "The mesh was not written", path)
        });
    }

    /// Writes a figure of what the room shows.
    pub(super) fn export(&mut self, path: PathBuf, lab: &mut Lab, ctx: &Context) {
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
        let overlay = side_rooms::overlay(lab, &viewport);
        self.start_job(format!("Writing {}", name_of(&path)), lab, ctx, move |watcher| {
            let written = page(&document, &view, &theme, &viewport).map_err(|error| error.to_string());
            let written = written.and_then(|(mut picture, viewport)| {
                side_rooms::lay_over(overlay, &mut picture);
                watcher.check(0.5).map_err(|stopped| stopped.to_string())?;
                let bytes = by_ending::figure(format, &picture, &viewport, &document, &view, PNG_SCALE);
                let bytes = bytes.map_err(|error| error.to_string())?;
                watcher.check(0.9).map_err(|stopped| stopped.to_string())?;
                by_ending::write_file(&path, &bytes).map_err(|error| error.to_string())
            });
            said(written, "Figure written to", "The figure was not written", path)
        });
    }

    /// Writes all frames of the algorithm on the selected curve, as the canvas shows it.
    pub(super) fn export_frames(&mut self, path: PathBuf, lab: &mut Lab, ctx: &Context) {
        let (document, view, theme) = (lab.history.document().clone(), view_to_save(lab), lab.theme.clone());
        let camera = lab.view.room_camera();
        let viewport = Viewport { center: camera.center, scale: camera.scale, size: lab.canvas_size };
        self.start_job(format!("Writing {}", name_of(&path)), lab, ctx, move |watcher| {
            let written = write_frames(&path, &document, &view, &theme, &viewport, PNG_SCALE, watcher);
            Box::new(move |files, lab| match written {
                Ok(written) => match &written[..] {
                    [first, .., last] => {
                        lab.done(format!("Frames written to {} … {}", name_of(first), name_of(last)));
                    }
                    _ => lab.done(format!("Frames written to {}", name_of(&path))),
                },
                Err(error) => {
                    files.problems.push(Problem::new("The frames were not written", error.to_string()));
                }
            })
        });
    }

    /// Writes the chart of the selected curve, or its numbers as a table.
    pub(super) fn export_chart(&mut self, path: PathBuf, lab: &mut Lab, ctx: &Context) {
        let Some((chart, size, table)) = chart_panel::page(lab) else {
            lab.problem("Select a curve first.");
            return;
        };
        let is_table = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        let format = match FigureFormat::of(&path) {
            Ok(format) => Some(format),
            Err(_) if is_table => None,
            Err(error) => {
                // The sentence must name the table too.
                let text = error.to_string().replace(".tex", ".tex, .csv");
                self.problems.push(Problem::new("The chart was not written", text));
                return;
            }
        };
        let (document, view, theme) = (lab.history.document().clone(), view_to_save(lab), lab.theme.clone());
        self.start_job(format!("Writing {}", name_of(&path)), lab, ctx, move |watcher| {
            let bytes = match format {
                None => Ok(table.into_bytes()),
                Some(format) => {
                    let (picture, viewport) = (chart.to_picture(&theme, size), Chart::view(size));
                    by_ending::figure(format, &picture, &viewport, &document, &view, PNG_SCALE)
                }
            };
            let written = bytes.map_err(|error| error.to_string()).and_then(|bytes| {
                watcher.check(0.9).map_err(|stopped| stopped.to_string())?;
                by_ending::write_file(&path, &bytes).map_err(|error| error.to_string())
            });
            said(written, "Chart written to", "The chart was not written", path)
        });
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

/// Adds a mesh to the document and selects it.
fn add_mesh(name: String, mesh: MeshObject, lab: &mut Lab) {
    let is_first = surfaces::bounding_box(lab.history.document()).is_none();
    let made = lab.edit(Edit::AddObject { name, content: Content::Mesh(mesh) });
    if let Some(&id) = made.as_ref().and_then(|made| made.created.first()) {
        lab.select(id);
        if is_first {
            lab.commands.push(Command::Fit);
        }
    }
}

fn write_mesh(object: &Object, path: &Path, watcher: &dyn Watcher) -> Result<(), String> {
    let Some(mesh) = object.mesh() else { return Ok(()) };
    let steps = mesh.steps_watched(&Part { whole: watcher, from: 0.0, to: 0.4 });
    let steps = steps.map_err(|error| error.to_string())?;
    let refined = steps.last().map_or(mesh.cage(), |step| &step.mesh);
    let text = obj::write_watched(refined, &Part { whole: watcher, from: 0.4, to: 0.9 });
    let text = text.map_err(|stopped| stopped.to_string())?;
    by_ending::write_file(path, text.as_bytes()).map_err(|error| error.to_string())
}

/// Tells that a file was written, or why not.
fn said(written: Result<(), String>, done: &'static str, problem: &'static str, path: PathBuf) -> Finish {
    Box::new(move |files, lab| match written {
        Ok(()) => lab.done(format!("{done} {}", name_of(&path))),
        Err(error) => files.problems.push(Problem::new(problem, error)),
    })
}

/// Whether `path` has the ending of a table.
pub(super) fn is_table(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| TABLES.contains(&ending.as_str()))
}
