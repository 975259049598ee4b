//! Undo and redo through snapshots.
//!
//! A snapshot is a list of shared objects, so that it costs only the objects that the neighbouring snapshot does not have.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::document::contents::Document;
use crate::document::edit::Edit;
use crate::document::edit_error::EditError;
use crate::document::outcome::Outcome;

/// Memory for snapshots if nothing else is said: 256 MiB.
pub const DEFAULT_BUDGET: usize = 256 << 20;

/// The open document with its past and future.
#[derive(Clone, Debug)]
pub struct History {
    document: Document,
    /// Oldest first; each is the document before its step.
    done: VecDeque<Step>,
    /// The step undone last comes last; each is the document after its step.
    undone: Vec<Step>,
    interaction: Option<Interaction>,
    saved: Document,
    revision: u64,
    budget: usize,
}

#[derive(Clone, Debug)]
struct Step {
    name: String,
    document: Document,
    /// Memory of the objects that the snapshot towards the present does not share.
    bytes: usize,
}

#[derive(Clone, Debug)]
struct Interaction {
    name: String,
    start: Document,
}

impl Step {
    fn new(name: String, document: Document, neighbour: &Document) -> Self {
        let bytes = unshared_bytes(&document, neighbour) + name.len() + size_of::<Self>();
        Self { name, document, bytes }
    }
}

impl History {
    /// Opens `document`, unmodified and without a past.
    pub fn new(document: Document) -> Self {
        Self {
            saved: document.clone(),
            document,
            done: VecDeque::new(),
            undone: Vec::new(),
            interaction: None,
            revision: 0,
            budget: DEFAULT_BUDGET,
        }
    }

    /// Limits the memory of the snapshots to `bytes`; the oldest steps are forgotten first, the last one never.
    #[must_use]
    pub fn with_budget(mut self, bytes: usize) -> Self {
        self.budget = bytes;
        self.forget_oldest();
        self
    }

    /// The document as it is now, in the middle of an interaction too.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Carries out `edit` as one undo step; one that changes nothing makes no step. Ends an interaction first.
    ///
    /// # Errors
    ///
    /// An [`EditError`]; the document is then unchanged.
    pub fn apply(&mut self, edit: Edit) -> Result<Outcome, EditError> {
        self.commit();
        let mut changed = self.document.clone();
        let outcome = changed.apply(&edit)?;
        if !same(&changed, &self.document) {
            let before = std::mem::replace(&mut self.document, changed);
            self.record(edit.name(), before);
            self.revision += 1;
        }
        Ok(outcome)
    }

    /// Starts an interaction, a drag for example, that becomes one step called `name`. Ends one that is still running.
    pub fn begin(&mut self, name: impl Into<String>) {
        self.commit();
        self.interaction = Some(Interaction { name: name.into(), start: self.document.clone() });
    }

    /// Replaces what the interaction has done so far by `edit`, applied to the document at its beginning. Without an
    /// interaction this is [`Self::apply`].
    ///
    /// # Errors
    ///
    /// An [`EditError`]; the document then stays as the last successful update left it.
    pub fn update(&mut self, edit: Edit) -> Result<Outcome, EditError> {
        let Some(interaction) = &self.interaction else {
            return self.apply(edit);
        };
        let mut changed = interaction.start.clone();
        let outcome = changed.apply(&edit)?;
        if !same(&changed, &self.document) {
            self.document = changed;
            self.revision += 1;
        }
        Ok(outcome)
    }

    /// Ends the interaction: one step if anything changed.
    pub fn commit(&mut self) {
        let Some(Interaction { name, start }) = self.interaction.take() else {
            return;
        };
        if same(&self.document, &start) {
            self.document = start;
        } else {
            self.record(name, start);
        }
    }

    /// Ends the interaction and goes back to its beginning.
    pub fn cancel(&mut self) {
        let Some(Interaction { start, .. }) = self.interaction.take() else {
            return;
        };
        if !same(&self.document, &start) {
            self.revision += 1;
        }
        self.document = start;
    }

    /// Whether an interaction is running.
    pub fn is_interacting(&self) -> bool {
        self.interaction.is_some()
    }

    /// Takes the last step back and returns its name. A running interaction is ended first and is then that step.
    pub fn undo(&mut self) -> Option<String> {
        self.commit();
        let Step { name, document, .. } = self.done.pop_back()?;
        let after = std::mem::replace(&mut self.document, document);
        self.undone.push(Step::new(name.clone(), after, &self.document));
        self.revision += 1;
        Some(name)
    }

    /// Does the step undone last again and returns its name. A running interaction that changed something leaves nothing to
    /// redo.
    pub fn redo(&mut self) -> Option<String> {
        self.commit();
        let Step { name, document, .. } = self.undone.pop()?;
        let before = std::mem::replace(&mut self.document, document);
        self.done.push_back(Step::new(name.clone(), before, &self.document));
        self.revision += 1;
        Some(name)
    }

    /// Name of the step that [`Self::undo`] would take back.
    pub fn undo_name(&self) -> Option<&str> {
        self.done.back().map(|step| step.name.as_str())
    }

    /// Name of the step that [`Self::redo`] would do again.
    pub fn redo_name(&self) -> Option<&str> {
        self.undone.last().map(|step| step.name.as_str())
    }

    /// Numbers of steps that can be undone and redone.
    pub fn steps(&self) -> (usize, usize) {
        (self.done.len(), self.undone.len())
    }

    /// A number that changes whenever the document changes.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Notes that the document has been saved as it is now.
    pub fn mark_saved(&mut self) {
        self.saved = self.document.clone();
    }

    /// Whether the document differs from the one last saved or opened; undoing back to it counts as no difference.
    pub fn is_modified(&self) -> bool {
        !same(&self.document, &self.saved)
    }

    /// Puts `document` in place of the present one, as one undo step called `name`; an equal document makes no step.
    pub fn restore(&mut self, name: impl Into<String>, document: Document) {
        self.commit();
        if !same(&document, &self.document) {
            let before = std::mem::replace(&mut self.document, document);
            self.record(name.into(), before);
            self.revision += 1;
        }
    }

    /// Opens another document: past, future and interaction are forgotten.
    pub fn replace(&mut self, document: Document) {
        let (revision, budget) = (self.revision + 1, self.budget);
        *self = Self { revision, budget, ..Self::new(document) };
    }

    fn record(&mut self, name: String, before: Document) {
        self.undone.clear();
        self.done.push_back(Step::new(name, before, &self.document));
        self.forget_oldest();
    }

    fn forget_oldest(&mut self) {
        let mut bytes: usize = self.done.iter().map(|step| step.bytes).sum();
        while bytes > self.budget && self.done.len() > 1 {
            bytes -= self.done.pop_front().map_or(0, |step| step.bytes);
        }
    }
}

/// Whether both documents have the same objects; shared ones are not looked into.
fn same(a: &Document, b: &Document) -> bool {
    a.made == b.made
        && a.objects.len() == b.objects.len()
        && a.objects.iter().zip(&b.objects).all(|(a, b)| Arc::ptr_eq(a, b) || a == b)
}

fn unshared_bytes(document: &Document, neighbour: &Document) -> usize {
    let shared: std::collections::HashSet<_> = neighbour.objects.iter().map(Arc::as_ptr).collect();
    let own = document.objects.iter().filter(|object| !shared.contains(&Arc::as_ptr(object)));
    own.map(|object| object.byte_size()).sum::<usize>() + document.objects.len() * size_of::<usize>()
}
