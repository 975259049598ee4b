//! Reading and writing of large files beside the window's thread, with progress and a button that stops it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use eframe::egui::{Align2, Area, Context, Frame, Id, Order, ProgressBar, vec2};

use crate::app::files::Files;
use crate::app::files::question::Problem;
use crate::app::lab::Lab;
use crate::app::progress_strip::SHOWN_AFTER;
use crate::core::progress::Watcher;

/// Title of what went wrong.
const NOT_DONE: &str = "The file was not read or written";
/// Steps of the progress that is told.
const STEPS: f64 = 1000.0;

/// What the window does with the result of a job; nothing if it was stopped.
pub(super) type Finish = Box<dyn FnOnce(&mut Files, &mut Lab) + Send>;

/// A job that runs.
#[derive(Debug)]
pub(super) struct Job {
    title: String,
    since: Instant,
    stop: Arc<AtomicBool>,
    progress: Arc<AtomicU32>,
    finish: Receiver<Finish>,
}

/// Gives up the job: its thread hears of it and ends, what it found is never looked at.
impl Drop for Job {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl Files {
    /// Does `work` beside the window's thread, called `title` as in "Reading cow.obj"; one job at a time. Tests do it at once.
    pub(super) fn start_job(
        &mut self,
        title: String,
        lab: &mut Lab,
        ctx: &Context,
        work: impl FnOnce(&dyn Watcher) -> Finish + Send + 'static,
    ) {
        if lab.at_once {
            work(&|_: f64| true)(self, lab);
            return;
        }
        if let Some(job) = &self.job {
            lab.problem(format!("{} is not finished yet.", job.title));
            return;
        }
        let (stop, progress) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU32::new(0)));
        let (send, finish) = channel();
        let (stopped, told, ctx) = (Arc::clone(&stop), Arc::clone(&progress), ctx.clone());
        let thread = move || {
            let watch = |part: f64| {
                told.fetch_max((part * STEPS) as u32, Ordering::Relaxed);
                !stopped.load(Ordering::Relaxed)
            };
            // Nobody listens any more when the job was given up.
            let _ = send.send(work(&watch));
            ctx.request_repaint();
        };
        match std::thread::Builder::new().name("file".to_owned()).spawn(thread) {
            Ok(_) => self.job = Some(Job { title, since: Instant::now(), stop, progress, finish }),
            Err(error) => self.problems.push(Problem::new(NOT_DONE, error.to_string())),
        }
    }

    /// Takes what the job has found, or shows how far it is.
    pub(super) fn watch_job(&mut self, lab: &mut Lab, ctx: &Context) {
        let Some(job) = &self.job else { return };
        match job.finish.try_recv() {
            Ok(finish) => {
                self.job = None;
                finish(self, lab);
            }
            Err(TryRecvError::Empty) => {
                ctx.request_repaint_after(Duration::from_millis(60));
                if job.since.elapsed().as_secs_f32() > SHOWN_AFTER && job.show(ctx) {
                    self.job = None;
                    lab.done("Stopped; nothing was changed.");
                }
            }
            Err(TryRecvError::Disconnected) => {
                let problem = Problem::new(NOT_DONE, format!("{} ended unexpectedly.", job.title));
                self.problems.push(problem);
                self.job = None;
            }
        }
    }
}

impl Job {
    /// Shows progress; whether somebody wants to stop.
    fn show(&self, ctx: &Context) -> bool {
        let part = (f64::from(self.progress.load(Ordering::Relaxed)) / STEPS) as f32;
        let area = Area::new(Id::unique("file job")).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -48.0));
        let shown = area.order(Order::Foreground).show(ctx, |ui| {
            let frame = Frame::popup(ui.style()).inner_margin(12.0);
            let shown = frame.show(ui, |ui| {
                ui.label(&self.title);
                ui.horizontal(|ui| {
                    ui.add(ProgressBar::new(part).desired_width(240.0).show_percentage());
                    ui.button("Cancel").clicked()
                })
            });
            shown.inner.inner
        });
        shown.inner
    }
}
