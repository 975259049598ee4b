//! What the left button does between press and release.

use std::collections::BTreeSet;

use eframe::egui::{Modifiers, Pos2, Rect};
use glam::DVec2;

use crate::app::curves::handles::weight_for_bead;
use crate::app::curves::hit::{Target, Trees};
use crate::app::curves::weight_handles::{edge_end, ray, weight_for_ring, weights_for_weight_point};
use crate::app::hands::{DEAD_ZONE, constrained};
use crate::app::lab::Lab;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::document::Edit;
use crate::figure::composition::short_number;
use crate::figure::picture::Viewport;

/// A press of the left button and what it has become.
#[derive(Debug)]
pub(super) struct Gesture {
    target: Target,
    from: Pos2,
    from_world: DVec2,
    /// Where the grabbed point was at the press.
    grabbed: DVec2,
    /// Direction of the ray and weight at the press of a ring.
    ring: (DVec2, f64),
    /// How many pixels the ring has been dragged.
    along: f64,
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
        let curve = target.object().and_then(|object| lab.history.document().curve(object));
        let mut ring = (DVec2::Y, 1.0);
        match (target, curve) {
            (Target::Curve(_, at) | Target::Knot(_, at), Some(curve)) => {
                grabbed = curve.evaluate(at).unwrap_or_default();
            }
            (Target::EditPoint(_, point), Some(curve)) => {
                let at = curve.space().edit_parameters().get(point).copied();
                grabbed = at.and_then(|at| curve.evaluate(at).ok()).unwrap_or_default();
            }
            (Target::Ring(object, point), Some(curve)) => {
                let found = lab.history.document().object(object);
                ring.0 = found.and_then(|found| ray(lab, found)).map_or(DVec2::Y, |(_, direction)| direction);
                ring.1 = curve.weights().get(point).copied().unwrap_or(1.0);
            }
            _ => {}
        }
        // An edge is empty ground for a drag.
        let target = if matches!(target, Target::Edge(..)) { Target::Nothing } else { target };
        let from_world = world_from_screen(viewport, rect, pointer);
        Self { target, from: pointer, from_world, grabbed, ring, along: 0.0, before, moved: false }
    }

    /// What is dragged.
    pub(super) fn target(&self) -> Target {
        self.target
    }

    /// How many pixels the ring has been dragged outwards.
    pub(super) fn along(&self) -> f64 {
        self.along
    }

    /// The numbers that change, to be shown beside the pointer.
    pub(super) fn note(&self, lab: &Lab) -> Option<String> {
        if !self.moved {
            return None;
        }
        let curve = lab.history.document().curve(self.target.object()?)?;
        let place = |at: DVec2| format!("{}; {}", short_number(at.x), short_number(at.y));
        match self.target {
            Target::Point(_, point) => Some(place(*curve.points().get(point)?)),
            Target::Bead(_, point) | Target::Ring(_, point) => {
                Some(format!("w = {}", short_number(*curve.weights().get(point)?)))
            }
            Target::WeightPoint(_, edge) => {
                let end = edge_end(curve, edge);
                let ratio = curve.weights().get(end)? / curve.weights().get(edge)?;
                Some(format!("w{end} : w{edge} = {}", short_number(ratio)))
            }
            Target::Curve(_, at) | Target::Knot(_, at) => {
                Some(format!("{}   t = {}", place(curve.evaluate(at).ok()?), short_number(at)))
            }
            Target::EditPoint(_, point) => {
                let at = *curve.space().edit_parameters().get(point)?;
                Some(place(curve.evaluate(at).ok()?))
            }
            _ => None,
        }
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
        trees: &mut Trees,
        (viewport, rect): (&Viewport, Rect),
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
                let delta = constrained(world - self.from_world, self.grabbed, viewport, keys);
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
            Target::Ring(object, point) => {
                let way = (world - self.from_world) * viewport.scale;
                self.along = way.dot(self.ring.0);
                lab.begin("Change weight");
                lab.update(Edit::SetWeight {
                    object,
                    point,
                    weight: weight_for_ring(self.ring.1, self.along),
                });
            }
            Target::WeightPoint(object, edge) => {
                if let Some(curve) = lab.history.document().curve(object)
                    && edge < curve.points().len()
                {
                    let weights = weights_for_weight_point(curve, edge, world);
                    lab.begin("Move weight point");
                    lab.update(Edit::SetWeights { object, weights });
                }
            }
            Target::Curve(object, at) | Target::Knot(object, at) => {
                let delta = constrained(world - self.from_world, self.grabbed, viewport, keys);
                lab.begin("Drag curve");
                lab.update(Edit::MoveCurveAt { object, at, delta });
            }
            Target::EditPoint(object, point) => {
                let delta = constrained(world - self.from_world, self.grabbed, viewport, keys);
                lab.begin("Move edit point");
                lab.update(Edit::MoveEditPoint { object, point, delta });
            }
            Target::Parameter(object) => {
                let found = lab.history.document().object(object);
                let nearest = found.and_then(|found| trees.closest_point(found, world));
                if let Some(nearest) = nearest {
                    lab.set_parameter(object, nearest.parameter);
                }
            }
            Target::Nothing | Target::Edge(..) => {
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
            Target::Nothing
            | Target::Edge(..)
            | Target::Bead(..)
            | Target::Ring(..)
            | Target::WeightPoint(..)
            | Target::EditPoint(..)
            | Target::Parameter(_) => {}
        }
    }
}
