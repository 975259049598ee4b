//! The splines of the object that is shown, computed once for every change: at once for small ones, else on a thread of their own.

use std::sync::Arc;

use eframe::egui::Context;

use crate::app::worker::Worker;
use crate::core::progress::Watcher;
use crate::document::{Approximation, Object};
use crate::figure::approximation::{Analysis, analyse};

/// More data or knots than this are not computed between two frames.
const SMALL: usize = 3000;

/// An object with its analysis.
type Done = (Arc<Object>, Arc<Analysis>);

/// An object to analyse, and what was known before.
type Request = (Arc<Object>, Option<Done>);

/// What has been computed, and what is being computed.
#[derive(Debug)]
pub(super) struct Desk {
    done: Option<Done>,
    asked: Option<Arc<Object>>,
    worker: Worker<Request, Analysis>,
}

impl Default for Desk {
    fn default() -> Self {
        let work = |(object, before): &Request, _: &dyn Watcher| analysis_of(object, before.as_ref());
        Self { done: None, asked: None, worker: Worker::new(work) }
    }
}

impl Desk {
    /// Whether a newer result is to come.
    pub(super) fn is_busy(&self) -> bool {
        self.asked.is_some()
    }

    /// The analysis of `object`; while a large one is being computed that of before, if it fits.
    pub(super) fn analysis(&mut self, object: &Arc<Object>, ctx: &Context) -> Arc<Analysis> {
        let Some(approximation) = object.approximation() else { return Arc::default() };
        // An answer that comes after a small one made it needless is let go.
        if let Some(((of, _), analysis)) = self.worker.take()
            && let Some(asked) = &self.asked
        {
            if Arc::ptr_eq(&of, asked) {
                self.asked = None;
            }
            self.done = Some((of, Arc::new(analysis)));
        }
        if let Some((of, analysis)) = &self.done
            && Arc::ptr_eq(of, object)
        {
            return Arc::clone(analysis);
        }
        if size(approximation) <= SMALL {
            let analysis = Arc::new(analysis_of(object, self.done.as_ref()));
            self.worker.cancel();
            self.asked = None;
            self.done = Some((Arc::clone(object), Arc::clone(&analysis)));
            return analysis;
        }
        if self.asked.as_ref().is_none_or(|asked| !Arc::ptr_eq(asked, object)) {
            self.asked = Some(Arc::clone(object));
            self.worker.ask((Arc::clone(object), self.done.clone()), false, ctx);
        }
        // Curves of the data of a moment ago are better than none, as long as the methods are the same ones.
        let fits = self.done.as_ref().filter(|(of, _)| {
            let same = |old: &Approximation| old.methods().len() == approximation.methods().len();
            of.id == object.id && of.approximation().is_some_and(same)
        });
        fits.map_or_else(Arc::default, |(_, analysis)| Arc::clone(analysis))
    }
}

fn analysis_of(object: &Object, before: Option<&Done>) -> Analysis {
    let before = before.and_then(|(of, analysis)| Some((of.approximation()?, &**analysis)));
    object.approximation().map_or_else(Analysis::default, |data| analyse(data, before))
}

fn size(approximation: &Approximation) -> usize {
    let knots = approximation.methods().iter().map(|method| method.knots().len()).max().unwrap_or(0);
    approximation.len().max(knots)
}
