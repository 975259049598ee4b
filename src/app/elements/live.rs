//! The solution that the room shows, kept up with the problem; and the study of errors.

use std::sync::Arc;

use eframe::egui::Context;

use crate::app::elements::worker::Worker;
use crate::core::progress::Watcher;
use crate::document::{Membrane, ObjectId};
use crate::figure::elements::{ErrorStudy, SolveError, Solved, error_study, solve};

/// A problem and the object that it belongs to.
type Request = (ObjectId, Membrane);

/// The solution of the selected problem.
#[derive(Debug)]
pub(super) struct Live {
    worker: Worker<Request, Result<Solved, SolveError>>,
    asked: Option<Request>,
    solved: Option<(ObjectId, Arc<Solved>)>,
    error: Option<SolveError>,
    is_cancelled: bool,
}

/// The study of errors of the selected problem.
#[derive(Debug)]
pub(super) struct Study {
    worker: Worker<Request, Result<ErrorStudy, SolveError>>,
    found: Option<(Request, Result<ErrorStudy, SolveError>)>,
}

impl Default for Live {
    fn default() -> Self {
        let work = |request: &Request, watcher: &dyn Watcher| solve(&request.1, watcher);
        Self { worker: Worker::new(work), asked: None, solved: None, error: None, is_cancelled: false }
    }
}

impl Live {
    /// Called once a frame: asks for the solution if the problem is a new one, and takes what has been found.
    pub(super) fn follow(&mut self, object: ObjectId, membrane: &Membrane, now: bool, ctx: &Context) {
        let is_new = self.asked.as_ref().is_none_or(|(id, asked)| *id != object || asked != membrane);
        if is_new {
            self.is_cancelled = false;
            self.asked = Some((object, membrane.clone()));
            self.worker.ask((object, membrane.clone()), now, ctx);
        }
        match self.worker.take() {
            Some(((object, _), Ok(solved))) => {
                self.solved = Some((object, Arc::new(solved)));
                self.error = None;
            }
            Some((_, Err(error))) if !error.is_stopped() => self.error = Some(error),
            _ => {}
        }
    }

    /// The last solution of the object, perhaps that of a moment ago.
    pub(super) fn solved(&self, object: ObjectId) -> Option<&Arc<Solved>> {
        self.solved.as_ref().filter(|(id, _)| *id == object).map(|(_, solved)| solved)
    }

    /// Why there is no solution.
    pub(super) fn error(&self) -> Option<&SolveError> {
        self.error.as_ref()
    }

    /// The part done and the seconds since the start, while something runs.
    pub(super) fn progress(&self) -> Option<(f32, f32)> {
        self.worker.progress().map(|(part, time)| (part, time.as_secs_f32()))
    }

    /// Whether the last request was given up.
    pub(super) fn is_cancelled(&self) -> bool {
        self.is_cancelled
    }

    /// Gives up the running request; it is not made again until the problem changes or [`Self::again`] is called.
    pub(super) fn cancel(&mut self) {
        self.worker.cancel();
        self.is_cancelled = true;
    }

    /// Makes the last request again.
    pub(super) fn again(&mut self) {
        self.asked = None;
    }
}

impl Default for Study {
    fn default() -> Self {
        let work = |request: &Request, watcher: &dyn Watcher| error_study(&request.1, watcher);
        Self { worker: Worker::new(work), found: None }
    }
}

impl Study {
    /// Called once a frame: takes what has been found.
    pub(super) fn follow(&mut self) {
        if let Some((request, result)) = self.worker.take() {
            let is_stopped = result.as_ref().is_err_and(SolveError::is_stopped);
            self.found = (!is_stopped).then_some((request, result));
        }
    }

    /// Starts a study.
    pub(super) fn start(&mut self, object: ObjectId, membrane: &Membrane, now: bool, ctx: &Context) {
        self.found = None;
        self.worker.ask((object, membrane.clone()), now, ctx);
    }

    /// The study of exactly this problem.
    pub(super) fn found(
        &self,
        object: ObjectId,
        membrane: &Membrane,
    ) -> Option<&Result<ErrorStudy, SolveError>> {
        let (request, result) = self.found.as_ref()?;
        (request.0 == object && request.1 == *membrane).then_some(result)
    }

    /// The part done, while a study runs.
    pub(super) fn progress(&self) -> Option<f32> {
        self.worker.progress().map(|(part, _)| part)
    }

    /// Gives up the running study.
    pub(super) fn cancel(&self) {
        self.worker.cancel();
    }
}
