//! Long work off the UI thread: the newest request wins, a running one is stopped through the watcher of the core.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use eframe::egui::Context;

use crate::core::progress::Watcher;

/// Work that has run so long is stopped when something newer is asked for; shorter work is finished first, so that a
/// picture follows the hand even where each frame asks anew.
const PATIENCE: Duration = Duration::from_millis(250);

/// Steps of the progress that is told.
const STEPS: f64 = 1000.0;

/// A thread that answers requests of one kind.
#[derive(Debug)]
pub(crate) struct Worker<Q, A> {
    shared: Arc<Shared<Q, A>>,
    work: fn(&Q, &dyn Watcher) -> A,
    has_thread: bool,
}

#[derive(Debug)]
struct Shared<Q, A> {
    desk: Mutex<Desk<Q, A>>,
    wake: Condvar,
    stop: AtomicBool,
    progress: AtomicU32,
}

#[derive(Debug)]
struct Desk<Q, A> {
    wanted: Option<(Q, Context)>,
    running: Option<Instant>,
    answer: Option<(Q, A)>,
    closed: bool,
}

impl<Q: Clone + Send + 'static, A: Send + 'static> Worker<Q, A> {
    /// A worker that does `work`; its thread starts with the first request.
    pub(crate) fn new(work: fn(&Q, &dyn Watcher) -> A) -> Self {
        let desk = Desk { wanted: None, running: None, answer: None, closed: false };
        let shared = Shared {
            desk: Mutex::new(desk),
            wake: Condvar::new(),
            stop: AtomicBool::new(false),
            progress: AtomicU32::new(0),
        };
        Self { shared: Arc::new(shared), work, has_thread: false }
    }

    /// Asks for the answer to `request` in place of everything asked before; at once on this thread if `now`.
    pub(crate) fn ask(&mut self, request: Q, now: bool, ctx: &Context) {
        if !now && !self.has_thread {
            let (shared, work) = (Arc::clone(&self.shared), self.work);
            let thread = std::thread::Builder::new().name("elements".to_owned());
            self.has_thread = thread.spawn(move || serve(&shared, work)).is_ok();
        }
        if now || !self.has_thread {
            let answer = (self.work)(&request, &|_: f64| true);
            self.shared.desk().answer = Some((request, answer));
            return;
        }
        let mut desk = self.shared.desk();
        desk.wanted = Some((request, ctx.clone()));
        if desk.running.is_some_and(|since| since.elapsed() > PATIENCE) {
            self.shared.stop.store(true, Ordering::Relaxed);
        }
        drop(desk);
        self.shared.wake.notify_all();
    }

    /// The newest answer that has not been taken yet, with its request.
    pub(crate) fn take(&self) -> Option<(Q, A)> {
        self.shared.desk().answer.take()
    }

    /// Gives up what is asked for and what is running.
    pub(crate) fn cancel(&self) {
        let mut desk = self.shared.desk();
        desk.wanted = None;
        if desk.running.is_some() {
            self.shared.stop.store(true, Ordering::Relaxed);
        }
    }

    /// The part done of running work and how long it has run; `None` at rest.
    pub(crate) fn progress(&self) -> Option<(f32, Duration)> {
        let desk = self.shared.desk();
        let part = f64::from(self.shared.progress.load(Ordering::Relaxed)) / STEPS;
        match desk.running {
            Some(since) => Some((part as f32, since.elapsed())),
            None => desk.wanted.as_ref().map(|_| (0.0, Duration::ZERO)),
        }
    }
}

impl<Q, A> Drop for Worker<Q, A> {
    fn drop(&mut self) {
        self.shared.desk().closed = true;
        self.shared.stop.store(true, Ordering::Relaxed);
        self.shared.wake.notify_all();
    }
}

impl<Q, A> Shared<Q, A> {
    fn desk(&self) -> MutexGuard<'_, Desk<Q, A>> {
        // The desk is never left half changed.
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn serve<Q: Send, A: Send>(shared: &Shared<Q, A>, work: fn(&Q, &dyn Watcher) -> A) {
    loop {
        let mut desk = shared.desk();
        let (request, ctx) = loop {
            if desk.closed {
                return;
            }
            if let Some(wanted) = desk.wanted.take() {
                break wanted;
            }
            desk = shared.wake.wait(desk).unwrap_or_else(PoisonError::into_inner);
        };
        desk.running = Some(Instant::now());
        shared.stop.store(false, Ordering::Relaxed);
        shared.progress.store(0, Ordering::Relaxed);
        drop(desk);
        let watch = |part: f64| {
            shared.progress.fetch_max((part * STEPS) as u32, Ordering::Relaxed);
            !shared.stop.load(Ordering::Relaxed)
        };
        let answer = work(&request, &watch);
        let mut desk = shared.desk();
        desk.running = None;
        desk.answer = Some((request, answer));
        drop(desk);
        ctx.request_repaint();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    /// Waits until its watcher stops it, telling first that it runs; or answers at once.
    #[derive(Clone)]
    struct Riddle {
        number: u32,
        started: Option<mpsc::Sender<()>>,
    }

    fn work(riddle: &Riddle, watcher: &dyn Watcher) -> Option<u32> {
        if let Some(started) = &riddle.started {
            let _ = started.send(());
            while watcher.hear(0.5) {
                std::thread::yield_now();
            }
            return None;
        }
        Some(riddle.number)
    }

    fn next(worker: &Worker<Riddle, Option<u32>>) -> Option<u32> {
        loop {
            if let Some((_, answer)) = worker.take() {
                return answer;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn cancel_stops_the_work_and_the_worker_goes_on() {
        let ctx = Context::default();
        let mut worker = Worker::new(work);
        let (send, receive) = mpsc::channel();
        worker.ask(Riddle { number: 1, started: Some(send) }, false, &ctx);
        receive.recv().unwrap();
        assert!(worker.progress().is_some(), "it runs");
        worker.cancel();
        assert_eq!(next(&worker), None, "stopped");
        worker.ask(Riddle { number: 2, started: None }, false, &ctx);
        assert_eq!(next(&worker), Some(2), "the next request is answered");
        assert!(worker.progress().is_none(), "at rest");
    }

    #[test]
    fn at_once_needs_no_thread() {
        let mut worker = Worker::new(work);
        worker.ask(Riddle { number: 3, started: None }, true, &Context::default());
        assert!(!worker.has_thread, "no thread");
        assert_eq!(worker.take().and_then(|(_, answer)| answer), Some(3), "the answer is there");
    }
}
