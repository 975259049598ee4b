//! What the left button does between press and release.

use std::collections::BTreeSet;

use eframe::egui::{Modifiers, Pos2, Rect};
use glam::DVec2;

use crate::app::elements::Subject;
use crate::app::elements::hit::Target;
use crate::app::lab::Lab;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::app::plane_hands::{DEAD_ZONE, constrained};
use crate::document::{HandleId, Membrane};
use crate::figure::picture::Viewport;

/// A press of the left button and what it has become.
#[derive(Debug)]
pub(super) struct Gesture {
    target: Target,
    from: Pos2,
    from_world: DVec2,
    /// Where the grabbed handle was at the press.
    grabbed: DVec2,
    /// The problem at the press; drags are counted from it.
    start: Membrane,
    /// The selection at the press.
    before: BTreeSet<HandleId>,
    moved: bool,
}

impl Gesture {
    /// The button went down on `target`.
    pub(super) fn press(
        target: Target,
        pointer: Pos2,
        subject: &Subject,
        selected: &mut BTreeSet<HandleId>,
        world: DVec2,
        keys: Modifiers,
    ) -> Self {
        let before = selected.clone();
        let mut grabbed = DVec2::ZERO;
        if let Some(id) = target.handle() {
            if keys.shift {
                selected.insert(id);
            } else if !selected.contains(&id) {
                *selected = BTreeSet::from([id]);
            }
            grabbed = subject.membrane.handle(id).unwrap_or_default();
        }
        let start = subject.membrane.clone();
        Self { target, from: pointer, from_world: world, grabbed, start, before, moved: false }
    }

    /// The box of the marquee on the screen, if this is one.
    pub(super) fn marquee(&self, pointer: Pos2) -> Option<Rect> {
        (self.moved && self.target == Target::Nothing).then(|| Rect::from_two_pos(self.from, pointer))
    }

    /// The pointer moved with the button down.
    pub(super) fn drag(
        &mut self,
        pointer: Pos2,
        subject: &Subject,
        selected: &mut BTreeSet<HandleId>,
        lab: &mut Lab,
        (viewport, rect): (&Viewport, Rect),
        keys: Modifiers,
    ) {
        if !self.moved && pointer.distance(self.from) < DEAD_ZONE {
            return;
        }
        self.moved = true;
        if self.target == Target::Nothing {
            let marquee = Rect::from_two_pos(self.from, pointer);
            let inside = |at: DVec2| marquee.contains(screen_from_world(viewport, rect, at));
            let handles = self.start.handles().into_iter();
            let found: BTreeSet<HandleId> =
                handles.filter(|(.., at)| inside(*at)).map(|(id, ..)| id).collect();
            *selected = if keys.shift { self.before.union(&found).copied().collect() } else { found };
            return;
        }
        let world = world_from_screen(viewport, rect, pointer);
        let delta = constrained(world - self.from_world, self.grabbed, viewport, keys);
        let handles: Vec<HandleId> = selected.iter().copied().collect();
        let name = if self.start.patch().is_some() { "Move point" } else { "Move part" };
        subject.update(lab, name, self.start.with_moved_handles(&handles, delta));
    }

    /// The button came up.
    pub(super) fn release(self, selected: &mut BTreeSet<HandleId>, lab: &mut Lab, keys: Modifiers) {
        if self.moved {
            lab.commit();
            return;
        }
        match self.target.handle() {
            Some(id) if keys.shift && self.before.contains(&id) => {
                selected.remove(&id);
            }
            Some(_) if keys.shift => {}
            Some(id) => *selected = BTreeSet::from([id]),
            None if !keys.shift => selected.clear(),
            None => {}
        }
    }
}
