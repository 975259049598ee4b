//! What lies under the pointer.

use std::sync::Arc;

use eframe::egui::Rect;
use glam::{DVec2, DVec3};

use crate::app::lab::Lab;
use crate::app::surfaces::canvas::Canvas;
use crate::core::surface::catmull_clark::SubdivisionStep;
use crate::document::{Content, Object, ObjectId};
use crate::figure::scene::EyeView;
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

/// What lies within reach is asked for so many times whether a surface hides it.
const MOST_ASKED: usize = 6;
/// In scenes with more triangles nothing counts as hidden, so that the pointer stays quick.
const MOST_TRIANGLES: usize = 60_000;
/// Up to this part of its depth a point lies on the surface, not behind it.
const ON_SURFACE: f64 = 1e-3;

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
        if let Some(point) = point_at(canvas, lab, object, view, page) {
            return Target::Point(object.id, point);
        }
    }
    for object in selected.into_iter().chain(others) {
        if let Some(ends) = edge_at(canvas, object, view, page) {
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

/// The control point nearest to a place of the page that no surface hides; selected ones are never hidden.
fn point_at(canvas: &Canvas, lab: &Lab, object: &Object, view: &EyeView, page: DVec2) -> Option<usize> {
    let points = control_points(object);
    let seen = points.iter().enumerate().filter_map(|(index, &point)| {
        let seen = view.project(point)?;
        let distance = seen.page.distance(page);
        (distance <= POINT_REACH).then_some((index, distance, seen.depth))
    });
    let mut near: Vec<_> = seen.collect();
    near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
    let is_marked = |index| lab.selection.object == Some(object.id) && lab.selection.points.contains(&index);
    near.into_iter()
        .take(MOST_ASKED)
        .map(|(index, ..)| index)
        .find(|&index| is_marked(index) || !is_hidden(canvas, view, points[index]))
}

/// Whether a surface lies before a point of space; of very fine scenes nobody knows.
fn is_hidden(canvas: &Canvas, view: &EyeView, point: DVec3) -> bool {
    if canvas.triangle_count() > MOST_TRIANGLES {
        return false;
    }
    let Some(seen) = view.project(point) else { return true };
    let before = canvas.scene().pick_triangle(view, seen.page);
    before.is_some_and(|hit| view.eye.depth(hit.hit.point) < seen.depth * (1.0 - ON_SURFACE))
}

/// The edge of a control mesh at a place of the page, the nearest to the eye if there are several.
fn edge_at(canvas: &Canvas, object: &Object, view: &EyeView, page: DVec2) -> Option<[u32; 2]> {
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
        let share = share(page, a.page, b.page);
        (distance(page, a.page, b.page) <= EDGE_REACH).then_some((a.depth + b.depth, ends, share))
    });
    let mut near: Vec<_> = hits.collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let place = |[a, b]: [u32; 2], share: f64| {
        let [a, b] = [a, b].map(|end| cage.positions()[end as usize]);
        a + (b - a) * share
    };
    let seen = |&(_, ends, share): &(f64, [u32; 2], f64)| !is_hidden(canvas, view, place(ends, share));
    near.into_iter().take(MOST_ASKED).find(seen).map(|(_, ends, _)| ends)
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
    point.distance(a + (b - a) * share(point, a, b))
}

/// How far along a segment the place nearest to a point is, from 0 to 1.
fn share(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let way = b - a;
    let square = way.length_squared();
    if square > 0.0 { ((point - a).dot(way) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// The view of the canvas that fills `rect`.
pub(super) fn view_of(lab: &Lab, rect: Rect) -> EyeView {
    crate::app::scene_view::view_through(super::eye_of(lab), rect)
}
