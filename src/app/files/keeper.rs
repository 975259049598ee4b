//! Keeps unsaved work and preferences on disk, on a thread of its own.
//!
//! A document with changes is written 3 s after the last edit, and every 20 s while edits follow each other. The file is
//! gone again when the document has been saved or given up; if it is still there at the next start, there was a crash.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use eframe::egui::Context;

use crate::app::files::view_to_save;
use crate::app::lab::Lab;
use crate::app::preferences::{self, Preferences};
use crate::document::{Autosave, Document, Recovered, View};

/// Seconds of rest after which a document is written.
const REST: f64 = 3.0;

/// Seconds after which it is written though edits go on.
const LONGEST: f64 = 20.0;

/// Seconds of rest after which preferences are written.
const PREFERENCES_REST: f64 = 1.0;

/// What a crash left behind in `folder`, the newest first, and a message about files that cannot be read.
pub(super) fn abandoned(folder: &Path) -> (Vec<Recovered>, Option<String>) {
    let mut recovered = Autosave::abandoned(folder);
    recovered.sort_by_key(|document| std::cmp::Reverse(document.written));
    let damaged: Vec<String> = Autosave::damaged(folder)
        .iter()
        .map(|damaged| format!("{}: {}", damaged.path.display(), damaged.error))
        .collect();
    let message = (!damaged.is_empty()).then(|| damaged.join("\n"));
    (recovered, message)
}

/// A document to be kept, as it is at this moment.
#[derive(Debug)]
struct Copy {
    document: Document,
    view: View,
    original: Option<PathBuf>,
}

/// Which of the two documents is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// The one on the desk.
    Desk,
    /// The person's own, while a lesson is on the desk.
    Aside,
}

#[derive(Debug)]
enum Job {
    Write(Place, Box<Copy>),
    /// Writes, and only then gives up the file that the document was brought back from.
    BringBack(Box<Copy>, PathBuf),
    Clear(Place),
    Discard(PathBuf),
    Preferences(Box<Preferences>),
}

/// The state of one document: which content is on disk.
#[derive(Debug, Default)]
struct Kept {
    /// Content seen last.
    seen: Option<(u64, u64)>,
    /// Content on disk.
    written: Option<(u64, u64)>,
    /// Time of the last edit, in seconds.
    edited: f64,
    /// Time of the first edit that is not on disk.
    waiting_since: Option<f64>,
}

/// The keeper.
#[derive(Debug)]
pub(super) struct Keeper {
    jobs: Option<Sender<Job>>,
    errors: Option<Receiver<String>>,
    thread: Option<JoinHandle<()>>,
    keeps_documents: bool,
    desk: Kept,
    aside: Option<u64>,
    preferences: Preferences,
    preferences_changed: Option<f64>,
}

impl Keeper {
    /// A keeper that writes preferences and documents into these folders, nothing where there is no folder;
    /// `preferences` are those on disk.
    pub(super) fn new(config: Option<PathBuf>, autosave: Option<PathBuf>, preferences: Preferences) -> Self {
        let keeps_documents = autosave.is_some();
        let (jobs, todo) = mpsc::channel();
        let (complain, errors) = mpsc::channel();
        let work = move || Worker { config, autosave, desk: None, aside: None, complain }.work(&todo);
        let thread = std::thread::Builder::new().name("keeper".to_owned()).spawn(work).ok();
        let jobs = thread.is_some().then_some(jobs);
        Self {
            jobs,
            errors: Some(errors),
            thread,
            keeps_documents,
            desk: Kept::default(),
            aside: None,
            preferences,
            preferences_changed: None,
        }
    }

    /// Called every frame: writes what is due. The result is what could not be written.
    pub(super) fn watch(&mut self, lab: &Lab, preferences: &Preferences, ctx: &Context) -> Option<String> {
        let now = ctx.input(|input| input.time);
        let next = [self.watch_desk(lab, now), self.watch_preferences(preferences, now)];
        self.watch_aside(lab);
        if let Some(next) = next.into_iter().flatten().reduce(f64::min) {
            ctx.request_repaint_after(Duration::from_secs_f64((next - now).clamp(0.02, LONGEST)));
        }
        self.errors.as_ref().and_then(|errors| errors.try_recv().ok())
    }

    /// A document was brought back from `slot` onto the desk.
    pub(super) fn brought_back(&mut self, lab: &Lab, slot: PathBuf) {
        let content = content(lab);
        self.desk = Kept { seen: Some(content), written: Some(content), ..Kept::default() };
        self.send(Job::BringBack(Box::new(copy_of(lab)), slot));
    }

    /// Gives up what a crash left behind in `slot`.
    pub(super) fn discard(&mut self, slot: PathBuf) {
        self.send(Job::Discard(slot));
    }

    /// Ends the keeper's work. Documents that were saved or given up leave nothing behind; others stay on disk.
    pub(super) fn close(&mut self, lab: &Lab, preferences: &Preferences, given_up: bool) {
        if given_up || !lab.is_modified() {
            self.send(Job::Clear(Place::Desk));
        } else if self.keeps_documents && self.desk.written != Some(content(lab)) {
            self.send(Job::Write(Place::Desk, Box::new(copy_of(lab))));
        }
        if given_up {
            self.send(Job::Clear(Place::Aside));
        } else {
            self.watch_aside(lab);
        }
        if self.preferences != *preferences || self.preferences_changed.is_some() {
            self.send(Job::Preferences(Box::new(preferences.clone())));
        }
        // The thread ends when nobody can send any more.
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }

    fn watch_desk(&mut self, lab: &Lab, now: f64) -> Option<f64> {
        if !self.keeps_documents {
            return None;
        }
        let content = content(lab);
        if self.desk.seen != Some(content) {
            self.desk.seen = Some(content);
            self.desk.edited = now;
        }
        if !lab.is_modified() {
            if self.desk.written.take().is_some() {
                self.send(Job::Clear(Place::Desk));
            }
            self.desk.waiting_since = None;
            return None;
        }
        if self.desk.written == Some(content) {
            self.desk.waiting_since = None;
            return None;
        }
        let since = *self.desk.waiting_since.get_or_insert(now);
        let due = (self.desk.edited + REST).min(since + LONGEST);
        if now < due {
            return Some(due);
        }
        self.desk.written = Some(content);
        self.desk.waiting_since = None;
        self.send(Job::Write(Place::Desk, Box::new(copy_of(lab))));
        None
    }

    /// The document that is put aside cannot change, so it is written once.
    fn watch_aside(&mut self, lab: &Lab) {
        let own = lab.shelf.own.as_ref().filter(|sheet| sheet.is_modified() && self.keeps_documents);
        match (own, self.aside) {
            (Some(sheet), written) if written != Some(sheet.history.revision()) => {
                self.aside = Some(sheet.history.revision());
                let (document, view) = (sheet.history.document().clone(), sheet.view.clone());
                self.send(Job::Write(
                    Place::Aside,
                    Box::new(Copy { document, view, original: sheet.path.clone() }),
                ));
            }
            (None, Some(_)) => {
                self.aside = None;
                // Back on the desk it is not on disk any more; the next edit or rest writes it.
                if lab.is_modified() {
                    self.desk.written = Some(content(lab));
                    self.send(Job::Write(Place::Desk, Box::new(copy_of(lab))));
                }
                self.send(Job::Clear(Place::Aside));
            }
            _ => {}
        }
    }

    fn watch_preferences(&mut self, preferences: &Preferences, now: f64) -> Option<f64> {
        if self.preferences != *preferences {
            self.preferences = preferences.clone();
            self.preferences_changed = Some(now);
        }
        let due = self.preferences_changed? + PREFERENCES_REST;
        if now < due {
            return Some(due);
        }
        self.preferences_changed = None;
        self.send(Job::Preferences(Box::new(preferences.clone())));
        None
    }

    fn send(&self, job: Job) {
        if let Some(jobs) = &self.jobs {
            // A thread that has ended has said why.
            let _ = jobs.send(job);
        }
    }
}

/// Which document is on the desk, and in which state.
fn content(lab: &Lab) -> (u64, u64) {
    (lab.shelf.opened, lab.history.revision())
}

fn copy_of(lab: &Lab) -> Copy {
    Copy { document: lab.history.document().clone(), view: view_to_save(lab), original: lab.path.clone() }
}

/// What runs on the keeper's thread.
#[derive(Debug)]
struct Worker {
    config: Option<PathBuf>,
    autosave: Option<PathBuf>,
    desk: Option<Autosave>,
    aside: Option<Autosave>,
    complain: Sender<String>,
}

impl Worker {
    fn work(mut self, jobs: &Receiver<Job>) {
        for job in jobs {
            let done = match job {
                Job::Write(place, copy) => self.write(place, &copy),
                Job::BringBack(copy, slot) => self.write(Place::Desk, &copy).and_then(|()| discard(&slot)),
                Job::Clear(place) => self.clear(place),
                Job::Discard(slot) => discard(&slot),
                Job::Preferences(preferences) => self.save_preferences(&preferences),
            };
            if let Err(error) = done {
                // The window may be gone already.
                let _ = self.complain.send(error);
            }
        }
    }

    fn write(&mut self, place: Place, copy: &Copy) -> Result<(), String> {
        let Some(folder) = &self.autosave else { return Ok(()) };
        let said = |error: &dyn std::fmt::Display| format!("Unsaved work could not be kept safe: {error}");
        let slot = match place {
            Place::Desk => &mut self.desk,
            Place::Aside => &mut self.aside,
        };
        let slot = match slot {
            Some(slot) => slot,
            None => slot.insert(Autosave::open(folder).map_err(|error| said(&error))?),
        };
        slot.write(&copy.document, &copy.view, copy.original.as_deref()).map_err(|error| said(&error))
    }

    fn clear(&mut self, place: Place) -> Result<(), String> {
        let slot = match place {
            Place::Desk => &mut self.desk,
            Place::Aside => &mut self.aside,
        };
        match slot {
            Some(slot) => {
                slot.clear().map_err(|error| format!("An autosaved copy could not be removed: {error}"))
            }
            None => Ok(()),
        }
    }

    fn save_preferences(&self, preferences: &Preferences) -> Result<(), String> {
        let Some(folder) = &self.config else { return Ok(()) };
        preferences::save(folder, preferences)
            .map_err(|error| format!("The preferences could not be saved in {}: {error}", folder.display()))
    }
}

fn discard(slot: &Path) -> Result<(), String> {
    Autosave::discard(slot).map_err(|error| format!("An autosaved copy could not be removed: {error}"))
}
