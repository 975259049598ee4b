//! What the left button does between press and release.

use std::collections::BTreeSet;
use std::sync::Arc;

use eframe::egui::{Key, Modifiers, Pos2, Rect, Ui};
use glam::{DVec2, DVec3};

use crate::app::hands::{self, DEAD_ZONE, SNAP_REACH};
use crate::app::lab::Lab;
use crate::app::scene_view::{Grip, Track, likeliest_axis, page_from_screen, screen_from_page};
use crate::app::surfaces::Picked;
use crate::app::surfaces::commands::{moved, selected};
use crate::app::surfaces::target::{Target, center, shows_points};
use crate::document::{Edit, Object};
use crate::figure::picture::Viewport;
use crate::figure::scene::EyeView;
use crate::figure::surfaces::control_points;

/// Distance of round coordinates that are easily told apart at this depth.
pub(super) fn fine_step(view: &EyeView, depth: f64) -> f64 {
    let viewport =
        Viewport { center: DVec2::ZERO, scale: view.points_per_unit(depth.max(1e-12)), size: view.size };
    hands::fine_step(&viewport)
}

/// A press of the left button and what it has become.
#[derive(Debug)]
pub(super) struct Gesture {
    target: Target,
    from: Pos2,
    grip: Option<Grip>,
    /// The object at the press.
    start: Option<Arc<Object>>,
    /// The selection at the press, which a marquee with Shift adds to.
    before: BTreeSet<usize>,
    moved: bool,
}

impl Gesture {
    /// The button went down on `target`.
    pub(super) fn press(target: Target, pointer: Pos2, lab: &mut Lab, rect: Rect, keys: Modifiers) -> Self {
        let before = lab.selection.points.clone();
        let mut at = None;
        match target {
            Target::Point(object, point) => {
                if lab.selection.object != Some(object) {
                    lab.selection.object = Some(object);
                    lab.selection.points.clear();
                }
                if keys.shift {
                    lab.selection.points.insert(point);
                } else if !lab.selection.points.contains(&point) {
                    lab.selection.points = BTreeSet::from([point]);
                }
                at = selected(lab).and_then(|object| control_points(object).get(point).copied());
            }
            Target::Arrow(_) => at = center(lab),
            _ => {}
        }
        let grip = at.map(|at| Grip { at, page: page_from_screen(rect, pointer) });
        Self { target, from: pointer, grip, start: selected(lab).cloned(), before, moved: false }
    }

    /// The box of the marquee on the screen, if this is one.
    pub(super) fn marquee(&self, pointer: Pos2) -> Option<Rect> {
        (self.moved && self.grip.is_none()).then(|| Rect::from_two_pos(self.from, pointer))
    }

    /// The pointer moved with the button down.
    pub(super) fn drag(&mut self, pointer: Pos2, lab: &mut Lab, view: &EyeView, rect: Rect, ui: &Ui) {
        if !self.moved && pointer.distance(self.from) < DEAD_ZONE {
            return;
        }
        self.moved = true;
        let keys = ui.input(|input| input.modifiers);
        let Some(grip) = self.grip else {
            self.select_inside(Rect::from_two_pos(self.from, pointer), lab, view, rect, keys);
            return;
        };
        let Some(start) = &self.start else { return };
        let page = page_from_screen(rect, pointer);
        let track = self.track(&grip, view, page, keys, ui);
        let mut delta = grip.moved(view, page, track);
        if keys.command || keys.ctrl {
            delta = snapped(&grip, view, delta, track);
        }
        let points = &lab.selection.points;
        let label = match points.len() {
            1 => "Move point".to_owned(),
            count => format!("Move {count} points"),
        };
        match moved(&start.content, points, delta) {
            Ok(content) => {
                lab.begin(label.clone());
                lab.update(Edit::SetContent { object: start.id, content, label });
            }
            Err(error) => lab.shape_note = Some(error.to_string()),
        }
    }

    /// Where the points may go: X, Y and Z hold an axis, Shift the one that the pointer follows.
    fn track(&self, grip: &Grip, view: &EyeView, page: DVec2, keys: Modifiers, ui: &Ui) -> Track {
        if let Target::Arrow(axis) = self.target {
            return Track::Axis(DVec3::AXES[axis]);
        }
        let held = [Key::X, Key::Y, Key::Z].map(|key| ui.input(|input| input.key_down(key)));
        match held.iter().position(|&held| held) {
            Some(axis) => Track::Axis(DVec3::AXES[axis]),
            None if keys.shift => Track::Axis(likeliest_axis(view, grip.at, page - grip.page)),
            None => Track::Page,
        }
    }

    fn select_inside(&self, marquee: Rect, lab: &mut Lab, view: &EyeView, rect: Rect, keys: Modifiers) {
        let inside = |&point: &DVec3| {
            view.project(point).is_some_and(|seen| marquee.contains(screen_from_page(rect, seen.page)))
        };
        let found: BTreeSet<usize> =
            selected(lab).filter(|object| shows_points(object)).map_or_else(BTreeSet::new, |object| {
                let points = control_points(object).iter().enumerate();
                points.filter(|(_, point)| inside(point)).map(|(index, _)| index).collect()
            });
        lab.selection.points = if keys.shift { self.before.union(&found).copied().collect() } else { found };
    }

    /// The button came up; a click tells what was picked.
    pub(super) fn release(self, lab: &mut Lab, keys: Modifiers) -> Option<Target> {
        if self.moved {
            lab.commit();
            return None;
        }
        match self.target {
            Target::Point(_, point) => {
                if !keys.shift {
                    lab.selection.points = BTreeSet::from([point]);
                } else if self.before.contains(&point) {
                    lab.selection.points.remove(&point);
                }
            }
            Target::Edge(object, _) | Target::Surface(object, _) => {
                lab.selection.object = Some(object);
                lab.selection.points.clear();
            }
            Target::Nothing if !keys.shift => lab.selection.points.clear(),
            Target::Nothing | Target::Arrow(_) => {}
        }
        Some(self.target)
    }
}

/// What a click on `target` picks of a mesh; surfaces are asked apart.
pub(super) fn picked(target: Target) -> Picked {
    match target {
        Target::Edge(object, ends) => Picked::Edge(object, ends),
        _ => Picked::Nothing,
    }
}

/// `delta` changed so that the grabbed point stands on round coordinates near by.
fn snapped(grip: &Grip, view: &EyeView, delta: DVec3, track: Track) -> DVec3 {
    let depth = view.eye.depth(grip.at);
    let (step, reach) = (fine_step(view, depth), SNAP_REACH / view.points_per_unit(depth));
    let mut snapped = delta;
    for axis in 0..3 {
        let wanted = grip.at[axis] + delta[axis];
        let line = (wanted / step).round() * step;
        let moves = !matches!(track, Track::Axis(along) if along[axis] == 0.0);
        if moves && (line - wanted).abs() <= reach {
            snapped[axis] = line - grip.at[axis];
        }
    }
    snapped
}
