//! What the left button does between press and release.

use std::collections::BTreeSet;

use eframe::egui::{Modifiers, Pos2, Rect};
use glam::DVec2;

use crate::app::curves::handles::weight_for_bead;
use crate::app::curves::hit::Target;
use crate::app::lab::Lab;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::document::Edit;
use crate::figure::picture::Viewport;
use crate::figure::ticks::grid_step;

/// A press that moves less than this many pixels is a click and changes nothing.
const DEAD_ZONE: f32 = 4.0;

/// Pixels within which Ctrl snaps to the grid.
const SNAP_REACH: f64 = 8.0;

/// Distance of the finest lines of the grid; 1 where the zoom is beyond every grid.
pub(super) fn fine_step(viewport: &Viewport) -> f64 {
    grid_step(viewport).map_or(1.0, |step| step.finer().size())
}

/// A press of the left button and what it has become.
#[derive(Debug)]
pub(super) struct Gesture {
    target: Target,
    from: Pos2,
    from_world: DVec2,
    /// Where the grabbed control point was at the press.
    grabbed: DVec2,
    /// The selection at the press, which a marquee with Shift adds to.
    before: BTreeSet<usize>,
    moved: bool,
}

impl Gesture {
    /// The button went down on `target`.
    pub(super) fn press(
        target: Target,
        pointer: Pos2,
        lab: &mut Lab,
        viewport: &Viewport,
        rect: Rect,
        keys: Modifiers,
    ) -> Self {
        let before = lab.selection.points.clone();
        let mut grabbed = DVec2::ZERO;
        if let Target::Point(object, point) = target {
            if lab.selection.object != Some(object) {
                lab.selection.object = Some(object);
                lab.selection.points.clear();
            }
            lab.selection.knot = None;
            if keys.shift {
                lab.selection.points.insert(point);
            } else if !lab.selection.points.contains(&point) {
                lab.selection.points = BTreeSet::from([point]);
            }
            grabbed = lab.curve().map_or(DVec2::ZERO, |curve| curve.points()[point]);
        } else if let Some(object) = target.object()
            && lab.selection.object != Some(object)
        {
            lab.selection.object = Some(object);
            lab.selection.points.clear();
            lab.selection.knot = None;
        }
        let from_world = world_from_screen(viewport, rect, pointer);
        Self { target, from: pointer, from_world, grabbed, before, moved: false }
    }

    /// The box of the marquee on the screen, if this is one.
    pub(super) fn marquee(&self, pointer: Pos2) -> Option<Rect> {
        (self.moved && self.target == Target::Nothing).then(|| Rect::from_two_pos(self.from, pointer))
    }

    /// The pointer moved with the button down.
    pub(super) fn drag(
        &mut self,
        pointer: Pos2,
        lab: &mut Lab,
        viewport: &Viewport,
        rect: Rect,
        keys: Modifiers,
    ) {
        if !self.moved && pointer.distance(self.from) < DEAD_ZONE {
            return;
        }
        self.moved = true;
        let world = world_from_screen(viewport, rect, pointer);
        match self.target {
            Target::Point(object, _) => {
                let points: Vec<usize> = lab.selection.points.iter().copied().collect();
                let delta = self.delta(world, viewport, keys);
                lab.begin(if points.len() == 1 {
                    "Move point".to_owned()
                } else {
                    format!("Move {} points", points.len())
                });
                lab.update(Edit::MovePoints { object, points, delta });
            }
            Target::Bead(object, point) => {
                if let Some(weight) = lab.curve().and_then(|curve| weight_for_bead(curve, point, world)) {
                    lab.begin("Change weight");
                    lab.update(Edit::SetWeight { object, point, weight });
                }
            }
            Target::Parameter(object) | Target::Curve(object, _) | Target::Knot(object, _) => {
                let nearest =
                    lab.history.document().curve(object).and_then(|curve| curve.closest_point(world).ok());
                if let Some(nearest) = nearest {
                    lab.set_parameter(object, nearest.parameter);
                }
            }
            Target::Nothing => {
                let marquee = Rect::from_two_pos(self.from, pointer);
                let inside = |place: DVec2| marquee.contains(screen_from_world(viewport, rect, place));
                let found: BTreeSet<usize> = lab.curve().map_or_else(BTreeSet::new, |curve| {
                    curve.points().iter().enumerate().filter(|&(_, &at)| inside(at)).map(|(k, _)| k).collect()
                });
                lab.selection.points =
                    if keys.shift { self.before.union(&found).copied().collect() } else { found };
            }
        }
    }

    fn delta(&self, world: DVec2, viewport: &Viewport, keys: Modifiers) -> DVec2 {
        let mut delta = world - self.from_world;
        if keys.shift {
            // Along the axis that the pointer has followed farther.
            if delta.x.abs() >= delta.y.abs() { delta.y = 0.0 } else { delta.x = 0.0 }
        }
        if keys.command || keys.ctrl {
            let step = fine_step(viewport);
            let reach = SNAP_REACH / viewport.scale;
            for axis in 0..2 {
                let wanted = self.grabbed[axis] + delta[axis];
                let line = (wanted / step).round() * step;
                if (line - wanted).abs() <= reach && !(keys.shift && delta[axis] == 0.0) {
                    delta[axis] = line - self.grabbed[axis];
                }
            }
        }
        delta
    }

    /// The button came up.
    pub(super) fn release(self, lab: &mut Lab, keys: Modifiers) {
        if self.moved {
            lab.commit();
            return;
        }
        match self.target {
            Target::Point(_, point) => {
                if keys.shift {
                    if self.before.contains(&point) {
                        lab.selection.points.remove(&point);
                    }
                } else {
                    lab.selection.points = BTreeSet::from([point]);
                }
            }
            Target::Curve(object, parameter) => {
                lab.set_parameter(object, parameter);
                lab.selection.points.clear();
                lab.selection.knot = None;
            }
            Target::Knot(object, value) => {
                lab.set_parameter(object, value);
                lab.selection.points.clear();
                lab.selection.knot = Some(value);
            }
            Target::Nothing if !keys.shift => {
                lab.selection.points.clear();
                lab.selection.knot = None;
            }
            Target::Nothing | Target::Bead(..) | Target::Parameter(_) => {}
        }
    }
}
