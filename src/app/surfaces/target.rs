//! What lies under the pointer.

use std::sync::Arc;

use eframe::egui::Rect;
use glam::{DVec2, DVec3};

use crate::app::lab::Lab;
use crate::app::surfaces::canvas::Canvas;
use crate::core::surface::catmull_clark::SubdivisionStep;
use crate::document::{Content, Object, ObjectId};
use crate::figure::scene::{EyeView, nearest_point};
use crate::figure::surfaces::control_points;

/// Distances in pt within which things are hit.
const POINT_REACH: f64 = 9.0;
const EDGE_REACH: f64 = 5.0;
/// Length in pt of the arrows at selected points.
const ARROW: f64 = 56.0;
/// Arrows that are shorter on the page cannot be grabbed.
const LEAST_ARROW: f64 = 16.0;
/// With more edges than this a control mesh is looked through only for its vertices.
const MOST_EDGES: usize = 20_000;

/// A thing under the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Target {
    /// Nothing.
    #[default]
    Nothing,
    /// The arrow along an axis at the selected points.
    Arrow(usize),
    /// A control point or a vertex of a control mesh.
    Point(ObjectId, usize),
    /// An edge of a control mesh.
    Edge(ObjectId, [u32; 2]),
    /// A surface; of a mesh with the face of the control mesh.
    Surface(ObjectId, Option<usize>),
}

/// An arrow at the selected points, on the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrow {
    pub(super) axis: usize,
    pub(super) from: DVec2,
    pub(super) to: DVec2,
}

/// The middle of the selected points.
pub(super) fn center(lab: &Lab) -> Option<DVec3> {
    let object = super::commands::selected(lab)?;
    let points = control_points(object);
    let chosen: Vec<DVec3> =
        lab.selection.points.iter().filter_map(|&point| points.get(point).copied()).collect();
    (!chosen.is_empty()).then(|| chosen.iter().copied().sum::<DVec3>() / chosen.len() as f64)
}

/// The arrows that can be grabbed.
pub(super) fn arrows(lab: &Lab, view: &EyeView) -> Vec<Arrow> {
    let Some(at) = center(lab) else { return Vec::new() };
    let Some(seen) = view.project(at) else { return Vec::new() };
    let length = ARROW / view.points_per_unit(seen.depth);
    let arrow = |axis: usize| {
        let to = view.project(at + DVec3::AXES[axis] * length)?.page;
        let way = to - seen.page;
        (way.length() >= LEAST_ARROW).then(|| Arrow { axis, from: seen.page + way * 0.2, to })
    };
    (0..3).filter_map(arrow).collect()
}

/// Whether the control points of `object` are drawn.
pub(super) fn shows_points(object: &Object) -> bool {
    object.visible
        && match &object.content {
            Content::Surface(surface) => surface.display().net,
            Content::Mesh(mesh) => mesh.display().cage,
            _ => false,
        }
}

/// What lies under a place of the page; `deep` asks surfaces too.
pub(super) fn target_at(canvas: &Canvas, lab: &Lab, view: &EyeView, page: DVec2, deep: bool) -> Target {
    let on_arrow = |arrow: &Arrow| distance(page, arrow.from, arrow.to) <= EDGE_REACH + 1.0;
    if let Some(arrow) = arrows(lab, view).iter().find(|arrow| on_arrow(arrow)) {
        return Target::Arrow(arrow.axis);
    }
    let objects = lab.history.document().objects();
    let selected = super::commands::selected(lab).filter(|object| shows_points(object));
    let others = objects
        .iter()
        .rev()
        .filter(|object| shows_points(object) && selected.is_none_or(|selected| selected.id != object.id));
    for object in selected.into_iter().chain(others.clone()) {
        if let Some(hit) = nearest_point(view, control_points(object), page, POINT_REACH) {
            return Target::Point(object.id, hit.index);
        }
    }
    for object in selected.into_iter().chain(others) {
        if let Some(ends) = edge_at(object, view, page) {
            return Target::Edge(object.id, ends);
        }
    }
    if deep && let Some(hit) = canvas.scene().pick_triangle(view, page) {
        return canvas.object_of_layer(hit.layer).map_or(Target::Nothing, |object| {
            Target::Surface(object, cage_face(canvas, lab, object, hit.hit.triangle))
        });
    }
    Target::Nothing
}

/// The edge of a control mesh at a place of the page, the nearest to the eye if there are several.
fn edge_at(object: &Object, view: &EyeView, page: DVec2) -> Option<[u32; 2]> {
    let cage = object.mesh()?.cage();
    let topology = cage.topology();
    if topology.edge_count() > MOST_EDGES {
        return None;
    }
    let seen: Vec<_> = cage.positions().iter().map(|&point| view.project(point)).collect();
    let hits = (0..topology.edge_count()).filter_map(|edge| {
        let ends = topology.edge(edge);
        let [a, b] = ends.map(|end| seen[end as usize]);
        let (a, b) = (a?, b?);
        (distance(page, a.page, b.page) <= EDGE_REACH).then_some((a.depth + b.depth, ends))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, ends)| ends)
}

/// The face of the control mesh in which a triangle of the drawn mesh lies.
fn cage_face(canvas: &Canvas, lab: &Lab, object: ObjectId, triangle: usize) -> Option<usize> {
    let (made_of, shape) = canvas.store.shape(object)?;
    let cage = made_of.mesh()?.cage();
    let is_current = lab.history.document().object(object).is_some_and(|now| Arc::ptr_eq(now, made_of));
    let refined = shape.steps.last().map_or(cage, |step| &step.mesh);
    let mut before = 0;
    let face = refined.topology().faces().position(|face| {
        before += face.len() - 2;
        triangle < before
    })?;
    let parent = |face, step: &SubdivisionStep| step.parents.get(face).map(|&parent| parent as usize);
    shape.steps.iter().rev().try_fold(face, parent).filter(|_| is_current)
}

/// Distance of a point from a segment.
fn distance(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let way = b - a;
    let square = way.length_squared();
    let share = if square > 0.0 { ((point - a).dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + way * share)
}

/// The view of the canvas that fills `rect`.
pub(super) fn view_of(lab: &Lab, rect: Rect) -> EyeView {
    crate::app::scene_view::view_through(super::eye_of(lab), rect)
}
