//! What lies under the pointer on the canvas.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::egui::{Pos2, Rect};
use glam::DVec2;

use crate::app::curves::handles::bead_place;
use crate::app::curves::weight_handles::{ring_place, weight_points};
use crate::app::lab::Lab;
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::core::spline_curve::{ClosestPoint, ClosestPointTree, Nurbs};
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
    /// The ring that is dragged along its ray for the weight of the one selected point.
    Ring(ObjectId, usize),
    /// The weight point on the edge that begins at a control point.
    WeightPoint(ObjectId, usize),
    /// An edit point on the curve.
    EditPoint(ObjectId, usize),
    /// The marker of the parameter.
    Parameter(ObjectId),
    /// A knot on the curve.
    Knot(ObjectId, f64),
    /// A place on a curve.
    Curve(ObjectId, f64),
    /// An edge of the selected curve's control polygon; a point inserted there gets this index.
    Edge(ObjectId, usize),
}

/// The trees for closest points, made again only when their curve changes.
#[derive(Debug, Default)]
pub(super) struct Trees {
    known: HashMap<ObjectId, (Arc<Object>, Option<ClosestPointTree<DVec2>>)>,
}

impl Trees {
    pub(super) fn closest_point(
        &mut self,
        object: &Arc<Object>,
        place: DVec2,
    ) -> Option<ClosestPoint<DVec2>> {
        let curve = object.curve()?;
        let known = self.known.entry(object.id);
        let fresh = || (Arc::clone(object), ClosestPointTree::new(curve).ok());
        let (made_of, tree) = known.or_insert_with(fresh);
        if !Arc::ptr_eq(made_of, object) {
            (*made_of, *tree) = fresh();
        }
        tree.as_ref()?.closest_point(place).ok()
    }
}

impl Target {
    /// The object that the target belongs to.
    pub(super) fn object(self) -> Option<ObjectId> {
        match self {
            Self::Nothing => None,
            Self::Point(id, _)
            | Self::Bead(id, _)
            | Self::Ring(id, _)
            | Self::WeightPoint(id, _)
            | Self::EditPoint(id, _)
            | Self::Edge(id, _)
            | Self::Parameter(id)
            | Self::Knot(id, _)
            | Self::Curve(id, _) => Some(id),
        }
    }
}

/// The target at `pointer`: handles of the selected object first, then those of the others, then knots, then curves.
pub(super) fn target_at(
    lab: &Lab,
    trees: &mut Trees,
    viewport: &Viewport,
    rect: Rect,
    pointer: Pos2,
) -> Target {
    let visible: Vec<&Arc<Object>> =
        lab.history.document().objects().iter().filter(|object| object.visible).collect();
    trees.known.retain(|id, _| visible.iter().any(|object| object.id == *id));
    let selected = visible.iter().copied().find(|object| lab.selection.object == Some(object.id));
    let near = |world: DVec2, reach: f32| screen_from_world(viewport, rect, world).distance(pointer) <= reach;
    if let Some(object) = selected {
        if let Some((point, place)) = bead_place(lab, object)
            && near(place, POINT_REACH)
        {
            return Target::Bead(object.id, point);
        }
        if lab.edit_points
            && let Some(Ok(places)) = object.curve().map(Nurbs::edit_points)
            && let Some(point) = nearest(&places, viewport, rect, pointer)
        {
            return Target::EditPoint(object.id, point);
        }
        if let Some(point) = nearest_point(object, viewport, rect, pointer) {
            return Target::Point(object.id, point);
        }
        if let Some((point, place)) = ring_place(lab, object, viewport, 0.0)
            && near(place, POINT_REACH)
        {
            return Target::Ring(object.id, point);
        }
        if let Some(edge) = nearest(&weight_points(lab, object), viewport, rect, pointer) {
            return Target::WeightPoint(object.id, edge);
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
        if let Some(nearest) = trees.closest_point(object, world)
            && nearest.distance <= reach
            && best.is_none_or(|(distance, _)| nearest.distance < 0.6 * distance)
        {
            best = Some((nearest.distance, Target::Curve(object.id, nearest.parameter)));
        }
    }
    if let Some((_, target)) = best {
        return target;
    }
    // The edges come last, for they lie under everything.
    if let Some(object) = selected
        && object.curve_display().is_some_and(|display| display.polygon)
        && let Some((before, distance)) = nearest_edge(object, world)
        && distance <= 0.8 * reach
    {
        return Target::Edge(object.id, before);
    }
    Target::Nothing
}

/// The index that a point inserted at `world` gets in the edge nearest to it, and the distance of that edge. Beyond the ends of an open curve the
/// point comes first or last.
pub(super) fn nearest_edge(object: &Object, world: DVec2) -> Option<(usize, f64)> {
    let curve = object.curve()?;
    let (points, count) = (curve.points(), curve.points().len());
    let closed = curve.space().is_periodic();
    let edges = if closed { count } else { count - 1 };
    let shares = (0..edges).map(|k| {
        let (from, to) = (points[k], points[(k + 1) % count]);
        let share = (world - from).dot(to - from) / (to - from).length_squared();
        let share = if share.is_finite() { share } else { 0.0 };
        (k, share, world.distance(from.lerp(to, share.clamp(0.0, 1.0))))
    });
    let (k, share, distance) = shares.min_by(|a, b| a.2.total_cmp(&b.2))?;
    let index = match k {
        0 if !closed && share < 0.0 => 0,
        k if !closed && k + 1 == edges && share > 1.0 => count,
        k => k + 1,
    };
    Some((index, distance))
}

fn nearest_point(object: &Object, viewport: &Viewport, rect: Rect, pointer: Pos2) -> Option<usize> {
    let curve = object.curve().filter(|_| object.curve_display().is_some_and(|display| display.points))?;
    nearest(curve.points(), viewport, rect, pointer)
}

fn nearest(places: &[DVec2], viewport: &Viewport, rect: Rect, pointer: Pos2) -> Option<usize> {
    let distance = |&place: &DVec2| screen_from_world(viewport, rect, place).distance(pointer);
    let nearest = places.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
    (nearest.1 <= POINT_REACH).then_some(nearest.0)
}

/// Whether `place` is farther than `reach` from the box of the control points, and so from the curve.
fn far_from_polygon(points: &[DVec2], place: DVec2, reach: f64) -> bool {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    place.cmplt(low - reach).any() || place.cmpgt(high + reach).any()
}
