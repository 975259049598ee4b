//! What the left button does between press and release.

use std::collections::BTreeSet;

use eframe::egui::{Modifiers, Rect};
use glam::DVec2;

use crate::app::approximation::changes::{set, with_knots};
use crate::app::approximation::hit::Target;
use crate::app::lab::Lab;
use crate::document::{Approximation, ObjectId};
use crate::figure::approximation::{Layout, PlotArea};
use crate::figure::ticks::Step;

/// A press that moves less than this many points is a click and changes nothing.
const DEAD_ZONE: f64 = 4.0;
/// Points within which Ctrl snaps to the grid.
const SNAP_REACH: f64 = 8.0;
/// Least distance in points of the lines that Ctrl snaps to.
const SNAP_LINES: f64 = 14.0;

/// The distances of the lines that Ctrl snaps to, along both sides.
pub(super) fn fine_steps(area: &PlotArea) -> [f64; 2] {
    let per_point = area.per_point();
    [per_point.x, per_point.y]
        .map(|per_point| Step::at_least(SNAP_LINES * per_point).map_or(per_point, Step::size))
}

/// `number` on the grid if a line is near.
pub(super) fn snapped(number: f64, step: f64, per_point: f64) -> f64 {
    let line = (number / step).round() * step;
    if (line - number).abs() <= SNAP_REACH * per_point { line } else { number }
}

/// A press of the left button and what it has become.
#[derive(Debug)]
pub(super) struct Gesture {
    pub(super) target: Target,
    object: ObjectId,
    /// As it was at the press.
    start: Approximation,
    /// Knots of the grabbed line at the press.
    knots: Vec<f64>,
    from: DVec2,
    before: BTreeSet<usize>,
    pub(super) moved: bool,
}

impl Gesture {
    /// The button went down on `target`, at a place of the page.
    pub(super) fn press(
        target: Target,
        object: ObjectId,
        page: DVec2,
        layout: &Layout,
        lab: &mut Lab,
        keys: Modifiers,
    ) -> Option<Self> {
        let start = lab.approximation()?.clone();
        let before = lab.selection.points.clone();
        let mut knots = Vec::new();
        match target {
            Target::Datum(index) => {
                if keys.shift {
                    lab.selection.points.insert(index);
                } else if !lab.selection.points.contains(&index) {
                    lab.selection.points = BTreeSet::from([index]);
                }
            }
            Target::Knot(method, _) => {
                lab.selection.points.clear();
                let row = layout.rows.iter().find(|row| row.method == method);
                knots = row.map_or_else(Vec::new, |row| row.knots.clone());
            }
            Target::Nothing | Target::Row(..) | Target::FixedRow(_) => {}
        }
        Some(Self { target, object, start, knots, from: page, before, moved: false })
    }

    /// The box of the marquee on the page, if this is one.
    pub(super) fn marquee(&self, page: DVec2) -> Option<(DVec2, DVec2)> {
        (self.moved && self.target == Target::Nothing).then(|| (self.from.min(page), self.from.max(page)))
    }

    /// The pointer moved with the button down.
    pub(super) fn drag(&mut self, page: DVec2, layout: &Layout, lab: &mut Lab, keys: Modifiers) {
        if !self.moved && page.distance(self.from) < DEAD_ZONE {
            return;
        }
        self.moved = true;
        match self.target {
            Target::Datum(grabbed) => self.drag_data(grabbed, page, layout, lab, keys),
            Target::Knot(method, index) => self.drag_knot(method, index, page, layout, lab, keys),
            Target::Nothing => {
                let (low, high) = (self.from.min(page), self.from.max(page));
                let (left, right) = (layout.main.numbers(low).0, layout.main.numbers(high).0);
                let sites = self.start.sites();
                let first = sites.partition_point(|&site| site < left);
                let last = sites.partition_point(|&site| site <= right);
                let inside = |&index: &usize| {
                    let y = layout.main.place(sites[index], self.start.values()[index]).y;
                    low.y <= y && y <= high.y
                };
                let found: BTreeSet<usize> = (first..last.max(first)).filter(inside).collect();
                lab.selection.points =
                    if keys.shift { self.before.union(&found).copied().collect() } else { found };
            }
            Target::Row(..) | Target::FixedRow(_) => {}
        }
    }

    fn drag_data(&self, grabbed: usize, page: DVec2, layout: &Layout, lab: &mut Lab, keys: Modifiers) {
        let main = &layout.main;
        let per_point = main.per_point();
        let mut way = page - self.from;
        if keys.shift {
            // Along the axis that the pointer has followed farther.
            if way.x.abs() >= way.y.abs() { way.y = 0.0 } else { way.x = 0.0 }
        }
        let (mut dx, mut dy) = (way.x * per_point.x, way.y * per_point.y);
        if keys.command || keys.ctrl {
            let [x_step, y_step] = fine_steps(main);
            let (x, y) = (self.start.sites()[grabbed], self.start.values()[grabbed]);
            if way.x != 0.0 {
                dx = snapped(x + dx, x_step, per_point.x) - x;
            }
            if way.y != 0.0 {
                dy = snapped(y + dy, y_step, per_point.y) - y;
            }
        }
        let points: Vec<usize> =
            lab.selection.points.iter().copied().filter(|&point| point < self.start.len()).collect();
        let free = self.start.free_step(&points, dx);
        lab.begin(if points.len() == 1 {
            "Move datum".to_owned()
        } else {
            format!("Move {} data", points.len())
        });
        match self.start.moved(&points, (free, dy)) {
            Ok(moved) => {
                lab.update(set(self.object, moved, "Move data"));
                lab.shape_note = (free.to_bits() != dx.to_bits())
                    .then(|| "A datum does not pass its neighbour: x must increase".to_owned());
            }
            Err(error) => lab.shape_note = Some(error.to_string()),
        }
    }

    fn drag_knot(
        &self,
        method: usize,
        index: usize,
        page: DVec2,
        layout: &Layout,
        lab: &mut Lab,
        keys: Modifiers,
    ) {
        let Some(&from) = self.knots.get(index) else { return };
        let per_point = layout.main.per_point().x;
        let mut to = from + (page.x - self.from.x) * per_point;
        if keys.command || keys.ctrl {
            to = snapped(to, fine_steps(&layout.main)[0], per_point);
        }
        let (moved, blocked) = moved_knot(&self.knots, index, to, layout, method);
        lab.begin("Move knot");
        match with_knots(&self.start, method, moved) {
            Ok(changed) => {
                lab.update(set(self.object, changed, "Move knot"));
                lab.shape_note = blocked.then(|| "Knots must not pass each other or the ends".to_owned());
            }
            Err(error) => lab.shape_note = Some(error.to_string()),
        }
    }

    /// The button came up.
    pub(super) fn release(self, lab: &mut Lab, keys: Modifiers) {
        if self.moved {
            lab.commit();
            return;
        }
        match self.target {
            Target::Datum(index) => {
                if keys.shift {
                    if self.before.contains(&index) {
                        lab.selection.points.remove(&index);
                    }
                } else {
                    lab.selection.points = BTreeSet::from([index]);
                }
            }
            Target::Nothing | Target::Row(..) | Target::FixedRow(_) if !keys.shift => {
                lab.selection.points.clear();
            }
            _ => {}
        }
    }
}

/// The knots with number `index` at `to`, as far as neighbours and ends allow, and whether they did not.
pub(super) fn moved_knot(
    knots: &[f64],
    index: usize,
    to: f64,
    layout: &Layout,
    method: usize,
) -> (Vec<f64>, bool) {
    let mut low = index.checked_sub(1).map_or(f64::NEG_INFINITY, |before| knots[before]);
    let mut high = knots.get(index + 1).copied().unwrap_or(f64::INFINITY);
    let row = layout.rows.iter().find(|row| row.method == method);
    if let Some((left, right)) = row.and_then(|row| row.ends) {
        let inside = 1e-6 * (right - left);
        (low, high) = (low.max(left + inside), high.min(right - inside));
    }
    let mut moved = knots.to_vec();
    // A neighbour may stand outside after the data have changed.
    let place = if low <= high { to.clamp(low, high) } else { to };
    moved[index] = place;
    (moved, place.to_bits() != to.to_bits())
}

/// The rectangle of the screen for a box of the page.
pub(super) fn screen_box(low: DVec2, high: DVec2, rect: Rect) -> Rect {
    let corner = |page: DVec2| rect.left_bottom() + eframe::egui::vec2(page.x as f32, -(page.y as f32));
    Rect::from_two_pos(corner(low), corner(high))
}
