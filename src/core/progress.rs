//! Long work takes a watcher that hears progress and may stop it.

use thiserror::Error;

/// Hears how far a piece of long work has come, and says whether it should go on.
///
/// Every `Fn(f64) -> bool + Sync` is one: it gets the part done, from 0 to 1, and returns `false` to stop.
pub trait Watcher: Sync {
    /// Called now and then, perhaps from several threads, with the part done in `[0, 1]`; `false` stops the work.
    fn hear(&self, part_done: f64) -> bool;

    /// As [`Self::hear`], as a result for `?`.
    ///
    /// # Errors
    ///
    /// [`Stopped`] if the watcher wants to stop.
    fn check(&self, part_done: f64) -> Result<(), Stopped> {
        if self.hear(part_done) { Ok(()) } else { Err(Stopped) }
    }
}

/// Nobody watches; the work is never stopped.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watcher for Unwatched {
    fn hear(&self, _part_done: f64) -> bool {
        true
    }
}

impl<F: Fn(f64) -> bool + Sync> Watcher for F {
    fn hear(&self, part_done: f64) -> bool {
        self(part_done)
    }
}

/// Maps the progress `[0, 1]` of a part of the work to `[from, to]` of the whole.
#[derive(Clone, Copy)]
pub struct Part<'a> {
    /// Who watches the whole.
    pub whole: &'a dyn Watcher,
    /// Where the part begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl Watcher for Part<'_> {
    fn hear(&self, part_done: f64) -> bool {
        self.whole.hear(self.from + (self.to - self.from) * part_done)
    }
}

impl std::fmt::Debug for Part<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Part({}..{})", self.from, self.to)
    }
}

/// The watcher has stopped the work; nothing was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("stopped on request")]
pub struct Stopped;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_reports_its_place_in_the_whole_and_passes_the_stop_on() {
        let stop_late = |done: f64| done < 0.7;
        let part = Part { whole: &stop_late, from: 0.5, to: 0.9 };
        assert_eq!(part.check(0.25), Ok(()), "0.6 of the whole");
        assert_eq!(part.check(0.75), Err(Stopped), "0.8 of the whole");
        assert!(Unwatched.hear(1.0), "nobody stops");
    }
}
