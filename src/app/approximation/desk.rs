//! The splines of the object that is shown, computed once for every change: at once for small ones, else on a thread of their own.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::time::Duration;

use eframe::egui::Context;

use crate::document::{Approximation, Object};
use crate::figure::approximation::{Analysis, analyse};

/// More data or knots than this are not computed between two frames.
const SMALL: usize = 3000;
/// How often a thread is asked for its result.
const POLL: Duration = Duration::from_millis(15);

/// What has been computed, and what is being computed.
#[derive(Debug, Default)]
pub(super) struct Desk {
    done: Option<(Arc<Object>, Arc<Analysis>)>,
    running: Option<(Arc<Object>, Receiver<Analysis>)>,
}

impl Desk {
    /// Whether a newer result is to come.
    pub(super) fn is_busy(&self) -> bool {
        self.running.is_some()
    }

    /// The analysis of `object`; while a large one is being computed that of before, if it fits.
    pub(super) fn analysis(&mut self, object: &Arc<Object>, ctx: &Context) -> Arc<Analysis> {
        let Some(approximation) = object.approximation() else { return Arc::default() };
        self.take_result(ctx);
        if let Some((of, analysis)) = &self.done
            && Arc::ptr_eq(of, object)
        {
            return Arc::clone(analysis);
        }
        let before = self.done.clone();
        let before = before.as_ref().and_then(|(of, analysis)| Some((of.approximation()?, &**analysis)));
        if size(approximation) <= SMALL {
            let analysis = Arc::new(analyse(approximation, before));
            self.running = None;
            self.done = Some((Arc::clone(object), Arc::clone(&analysis)));
            return analysis;
        }
        if self.running.is_none() {
            self.start(object);
        }
        ctx.request_repaint_after(POLL);
        // Curves of the data of a moment ago are better than none, as long as the methods are the same ones.
        let fits = self.done.as_ref().filter(|(of, _)| {
            let same = |old: &Approximation| old.methods().len() == approximation.methods().len();
            of.id == object.id && of.approximation().is_some_and(same)
        });
        fits.map_or_else(Arc::default, |(_, analysis)| Arc::clone(analysis))
    }

    fn start(&mut self, object: &Arc<Object>) {
        let (send, receive) = mpsc::channel();
        let (object, before) = (Arc::clone(object), self.done.clone());
        let work = Arc::clone(&object);
        let compute = move || {
            let Some(approximation) = work.approximation() else { return };
            let before = before.as_ref().and_then(|(of, analysis)| Some((of.approximation()?, &**analysis)));
            // Nobody listens any more when the window has been closed meanwhile.
            let _ = send.send(analyse(approximation, before));
        };
        if std::thread::Builder::new().name("approximation".to_owned()).spawn(compute).is_ok() {
            self.running = Some((object, receive));
        }
    }

    fn take_result(&mut self, ctx: &Context) {
        let Some((object, answer)) = &self.running else { return };
        match answer.try_recv() {
            Ok(analysis) => self.done = Some((Arc::clone(object), Arc::new(analysis))),
            Err(TryRecvError::Empty) => {
                ctx.request_repaint_after(POLL);
                return;
            }
            Err(TryRecvError::Disconnected) => {}
        }
        self.running = None;
    }
}

fn size(approximation: &Approximation) -> usize {
    let knots = approximation.methods().iter().map(|method| method.knots().len()).max().unwrap_or(0);
    approximation.len().max(knots)
}
