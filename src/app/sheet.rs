//! A document on the desk or put aside: with its undo, its view and its file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::app::lab::Selection;
use crate::document::{Document, History, View};

/// A document with everything that belongs to it while the lab runs.
#[derive(Debug)]
pub struct Sheet {
    /// The document and its undo.
    pub history: History,
    /// Camera, parameters, panels.
    pub view: View,
    /// Its file, if it has one.
    pub path: Option<PathBuf>,
    /// What is selected.
    pub selection: Selection,
    /// Whether it was brought back after a crash and has not been saved since.
    pub brought_back: bool,
}

impl Sheet {
    /// A document as it comes from a file or a lesson.
    pub fn new(document: Document, view: View, path: Option<PathBuf>) -> Self {
        let first = document.objects().first().map(|object| object.id);
        let shown = view.selected_object.filter(|&id| document.object(id).is_some());
        let selection = Selection { object: shown.or(first), ..Selection::default() };
        Self { history: History::new(document), view, path, selection, brought_back: false }
    }

    /// Whether it holds anything that is in no file.
    pub fn is_modified(&self) -> bool {
        self.brought_back || self.history.is_modified()
    }
}

/// The documents that are put aside, and how often one was opened or saved.
#[derive(Debug, Default)]
pub struct Shelf {
    /// The person's own document while a lesson is open.
    pub own: Option<Sheet>,
    /// Documents of lessons that were worked on, by index of the lesson; kept while the lab runs.
    pub lessons: BTreeMap<usize, Sheet>,
    /// Lessons whose question has been answered while the lab runs, by index.
    pub answered: BTreeSet<usize>,
    /// How many documents have come onto the desk.
    pub opened: u64,
    /// How often a document has been saved.
    pub saved: u64,
}
