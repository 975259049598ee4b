//! What lies under the pointer on the canvas.

use eframe::egui::{Pos2, Rect};
use glam::DVec2;

use crate::app::curves::handles::bead_place;
use crate::app::lab::Lab;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::document::{Object, ObjectId};
use crate::figure::picture::Viewport;

/// Pixels within which a control point is taken.
const POINT_REACH: f32 = 10.0;

/// Pixels within which a curve is taken.
const CURVE_REACH: f64 = 7.0;

/// The thing under the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Target {
    /// Empty canvas.
    #[default]
    Nothing,
    /// A control point.
    Point(ObjectId, usize),
    /// The bead that pulls the weight of the one selected point.
    Bead(ObjectId, usize),
    /// The marker of the parameter.
    Parameter(ObjectId),
    /// A knot on the curve.
    Knot(ObjectId, f64),
    /// A place on a curve.
    Curve(ObjectId, f64),
}

impl Target {
    /// The object that the target belongs to.
    pub(super) fn object(self) -> Option<ObjectId> {
        match self {
            Self::Nothing => None,
            Self::Point(id, _)
            | Self::Bead(id, _)
            | Self::Parameter(id)
            | Self::Knot(id, _)
            | Self::Curve(id, _) => Some(id),
        }
    }
}

/// The target at `pointer`: handles of the selected object first, then those of the others, then knots, then curves.
pub(super) fn target_at(lab: &Lab, viewport: &Viewport, rect: Rect, pointer: Pos2) -> Target {
    let visible: Vec<&Object> = lab
        .history
        .document()
        .objects()
        .iter()
        .filter(|object| object.visible)
        .map(|object| &**object)
        .collect();
    let selected = visible.iter().copied().find(|object| lab.selection.object == Some(object.id));
    let near = |world: DVec2, reach: f32| screen_from_world(viewport, rect, world).distance(pointer) <= reach;
    if let Some(object) = selected {
        if let Some((point, place)) = bead_place(lab, object)
            && near(place, POINT_REACH)
        {
            return Target::Bead(object.id, point);
        }
        if let Some(point) = nearest_point(object, viewport, rect, pointer) {
            return Target::Point(object.id, point);
        }
        if let Some(curve) = object.curve()
            && let Some(parameter) = lab.parameter(object.id)
            && curve.evaluate(parameter).is_ok_and(|place| near(place, POINT_REACH))
        {
            return Target::Parameter(object.id);
        }
    }
    for object in visible.iter().rev() {
        if let Some(point) = nearest_point(object, viewport, rect, pointer) {
            return Target::Point(object.id, point);
        }
    }
    let world = world_from_screen(viewport, rect, pointer);
    if let Some(object) = selected
        && let Some(curve) = object.curve()
        && object.curve_display().is_some_and(|display| display.knots)
    {
        let distinct = curve.space().distinct_knots();
        if distinct.len() <= 2000 {
            for knot in distinct {
                if curve.evaluate(knot.value).is_ok_and(|place| near(place, 7.0)) {
                    return Target::Knot(object.id, knot.value);
                }
            }
        }
    }
    let reach = CURVE_REACH / viewport.scale;
    let mut best: Option<(f64, Target)> = None;
    for object in selected.into_iter().chain(visible.iter().rev().copied()) {
        let Some(curve) = object.curve() else { continue };
        if far_from_polygon(curve.points(), world, reach) {
            continue;
        }
        if let Ok(nearest) = curve.closest_point(world)
            && nearest.distance <= reach
            && best.is_none_or(|(distance, _)| nearest.distance < 0.6 * distance)
        {
            best = Some((nearest.distance, Target::Curve(object.id, nearest.parameter)));
        }
    }
    best.map_or(Target::Nothing, |(_, target)| target)
}

fn nearest_point(object: &Object, viewport: &Viewport, rect: Rect, pointer: Pos2) -> Option<usize> {
    let curve = object.curve().filter(|_| object.curve_display().is_some_and(|display| display.points))?;
    let distance = |&place: &DVec2| screen_from_world(viewport, rect, place).distance(pointer);
    let nearest = curve.points().iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
    (nearest.1 <= POINT_REACH).then_some(nearest.0)
}

/// Whether `place` is farther than `reach` from the box of the control points, and so from the curve.
fn far_from_polygon(points: &[DVec2], place: DVec2, reach: f64) -> bool {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    place.cmplt(low - reach).any() || place.cmpgt(high + reach).any()
}
