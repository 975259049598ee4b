//! Carrying out edits. Every edit works on a copy of the document, so that a failing one leaves nothing behind.

mod affine;
mod bezier_form;
mod curve_points;
mod degree;
mod knots;
mod objects;
mod offset;
mod parametrization;
mod parts;

pub(in crate::document) use objects::check_name;

use std::sync::Arc;

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::document::contents::Document;
use crate::document::edit::Edit;
use crate::document::edit_error::EditError;
use crate::document::object::{Content, Object, ObjectId};
use crate::document::outcome::{Outcome, ShapeChange};

/// The largest number of control points of one curve that edits and files may make.
pub(in crate::document) const MAX_POINTS: usize = 100_000;
/// The largest number of objects of a document.
pub(in crate::document) const MAX_OBJECTS: usize = 10_000;

/// The largest number of an object: all programs that read JSON know whole numbers up to 2⁵³.
pub(in crate::document) const MAX_ID: u64 = (1 << 53) - 1;

/// How deep batches may be nested: deeper ones come from faulty programs, and recursion has to end before the stack.
const MAX_BATCH_DEPTH: usize = 64;

impl Document {
    /// Carries out `edit`.
    ///
    /// # Errors
    ///
    /// An [`EditError`]; the document is then unchanged.
    pub fn apply(&mut self, edit: &Edit) -> Result<Outcome, EditError> {
        let mut changed = self.clone();
        let outcome = changed.carry_out(edit, 0)?;
        *self = changed;
        Ok(outcome)
    }

    fn carry_out(&mut self, edit: &Edit, depth: usize) -> Result<Outcome, EditError> {
        match edit {
            Edit::AddCurve { name, curve, display } => {
                let content = Content::Curve { curve: curve.clone(), display: display.clone() };
                objects::add(self, name, content)
            }
            Edit::AddObject { name, content } => objects::add(self, name, content.clone()),
            Edit::SetContent { object, content, .. } => {
                check_content(content)?;
                self.change(*object, |found| {
                    if found.content.kind() != content.kind() {
                        return Err(EditError::OtherKind {
                            object: *object,
                            kind: found.content.kind(),
                            wanted: content.kind(),
                        });
                    }
                    found.content = content.clone();
                    Ok(ShapeChange::None)
                })
            }
            Edit::RemoveObjects { objects } => objects::remove(self, objects),
            Edit::DuplicateObject { object } => objects::duplicate(self, *object),
            Edit::RenameObject { object, name } => objects::rename(self, *object, name),
            Edit::ReorderObject { object, to } => objects::reorder(self, *object, *to),
            Edit::SetVisible { object, visible } => self.change(*object, |found| {
                found.visible = *visible;
                Ok(ShapeChange::None)
            }),
            Edit::SetDisplay { object, display } => {
                display.check()?;
                self.change(*object, |found| match &mut found.content {
                    Content::Curve { display: shown, .. } => {
                        *shown = display.clone();
                        Ok(ShapeChange::None)
                    }
                    _ => Err(not_a_curve(found)),
                })
            }
            Edit::MovePoints { object, points, delta } => {
                curve_points::move_points(self, *object, points, *delta)
            }
            Edit::SetPoint { object, point, position } => {
                curve_points::set_point(self, *object, *point, *position)
            }
            Edit::SetPoints { object, positions } => curve_points::set_points(self, *object, positions),
            Edit::MoveCurveAt { object, at, delta } => {
                curve_points::move_curve_at(self, *object, *at, *delta)
            }
            Edit::MoveEditPoint { object, point, delta } => {
                curve_points::move_edit_point(self, *object, *point, *delta)
            }
            Edit::SetWeight { object, point, weight } => {
                curve_points::set_weight(self, *object, *point, *weight)
            }
            Edit::SetWeights { object, weights } => self.change_curve(*object, |curve| {
                let new = Nurbs::new(curve.space().clone(), curve.points().to_vec(), weights.clone())?;
                Ok((new, ShapeChange::None))
            }),
            Edit::TransformPoints { object, points, matrix, about } => {
                curve_points::transform(self, *object, points, *matrix, *about)
            }
            Edit::InsertPoint { object, before, position } => {
                curve_points::insert_point(self, *object, *before, *position)
            }
            Edit::AppendPoint { object, position } => {
                let count = self.curve_of(*object)?.points().len();
                curve_points::insert_point(self, *object, count, *position)
            }
            Edit::DeletePoints { object, points } => curve_points::delete_points(self, *object, points),
            Edit::InsertKnot { object, at } => knots::insert(self, *object, *at),
            Edit::RemoveKnot { object, at } => knots::remove(self, *object, *at),
            Edit::RefineUniformly { object } => knots::refine_uniformly(self, *object),
            Edit::RemoveKnotsWithin { object, tolerance } => knots::remove_within(self, *object, *tolerance),
            Edit::MoveKnot { object, .. }
            | Edit::MoveDistinctKnot { object, .. }
            | Edit::SetKnots { object, .. }
            | Edit::GenerateKnots { object, .. } => knots::keeping_points(self, *object, edit),
            Edit::KeepCurve { edit } => knots::keeping_curve(self, edit),
            Edit::ElevateDegree { object } => degree::elevate(self, *object),
            Edit::ReduceDegree { object } => degree::reduce(self, *object),
            Edit::SetDegree { object, degree } => degree::set(self, *object, *degree),
            Edit::SetClosed { object, closed: true } => parametrization::close(self, *object),
            Edit::SetClosed { object, closed: false } => parametrization::open(self, *object),
            Edit::SplitCurve { object, at } => parts::split(self, *object, *at),
            Edit::JoinCurves { object, other } => parts::join(self, *object, *other),
            Edit::TrimCurve { object, from, to } => parts::trim(self, *object, *from, *to),
            Edit::ToBezierForm { object } => bezier_form::all_knots(self, *object),
            Edit::InterpolateEnds { object } => bezier_form::ends(self, *object),
            Edit::TransformCurve { object, map } => affine::transform(self, *object, *map),
            Edit::OffsetCurve { object, distance, tolerance } => {
                offset::add(self, *object, *distance, *tolerance)
            }
            Edit::Reverse { object } => {
                self.change_curve(*object, |curve| Ok((curve.reversed()?, ShapeChange::None)))
            }
            Edit::ReplaceCurve { object, curve, .. } => {
                check_point_count(curve.points().len())?;
                self.change_curve(*object, |old| {
                    let change = knots::changed(old, curve);
                    Ok((curve.clone(), change))
                })
            }
            Edit::Batch { edits, .. } => self.carry_out_all(edits, depth),
        }
    }

    fn carry_out_all(&mut self, edits: &[Edit], depth: usize) -> Result<Outcome, EditError> {
        if depth >= MAX_BATCH_DEPTH {
            return Err(EditError::TooMany {
                what: "nested batches",
                value: depth + 1,
                limit: MAX_BATCH_DEPTH,
            });
        }
        let mut all = Outcome { shape: ShapeChange::None, created: Vec::new() };
        for (index, edit) in edits.iter().enumerate() {
            let done = self
                .carry_out(edit, depth + 1)
                .map_err(|error| EditError::InBatch { index, source: Box::new(error) })?;
            all.shape = all.shape.and(done.shape);
            all.created.extend(done.created);
        }
        // An object that a later edit of the batch removed again was not created.
        all.created.retain(|id| self.position(*id).is_some());
        Ok(all)
    }

    fn curve_of(&self, id: ObjectId) -> Result<&Nurbs<DVec2>, EditError> {
        self.curve(id).ok_or(EditError::NoSuchObject { object: id })
    }

    /// Changes one object through `change`; the others stay shared.
    fn change(
        &mut self,
        id: ObjectId,
        change: impl FnOnce(&mut Object) -> Result<ShapeChange, EditError>,
    ) -> Result<Outcome, EditError> {
        let position = self.position(id).ok_or(EditError::NoSuchObject { object: id })?;
        let mut object = Object::clone(&self.objects[position]);
        let shape = change(&mut object)?;
        self.objects[position] = Arc::new(object);
        Ok(Outcome { shape, created: Vec::new() })
    }

    /// Puts the curve that `change` makes in place of the old one.
    fn change_curve(
        &mut self,
        id: ObjectId,
        change: impl FnOnce(&Nurbs<DVec2>) -> Result<(Nurbs<DVec2>, ShapeChange), EditError>,
    ) -> Result<Outcome, EditError> {
        self.change(id, |object| {
            let Content::Curve { curve, .. } = &mut object.content else { return Err(not_a_curve(object)) };
            let (new, shape) = change(curve)?;
            check_point_count(new.points().len())?;
            *curve = new;
            Ok(shape)
        })
    }
}

impl ShapeChange {
    /// Both changes one after the other: deviations add up, a change outweighs keeping, and keeping silence.
    fn and(self, then: Self) -> Self {
        match (self, then) {
            (Self::None, other) | (other, Self::None) => other,
            (Self::Kept { deviation: a }, Self::Kept { deviation: b }) => Self::Kept { deviation: a + b },
            // The places of both largest distances say nothing about that of the sum.
            (a, b) => {
                Self::Changed { deviation: a.deviation().zip(b.deviation()).map(|(a, b)| a + b), at: None }
            }
        }
    }

    fn deviation(self) -> Option<f64> {
        match self {
            Self::None => Some(0.0),
            Self::Kept { deviation } | Self::Approximated { deviation } => Some(deviation),
            Self::Changed { deviation, .. } => deviation,
        }
    }
}

/// Whether the numbers of `content` can be drawn and are not too many.
fn check_content(content: &Content) -> Result<(), EditError> {
    match content {
        Content::Curve { curve, display } => {
            display.check()?;
            check_point_count(curve.points().len())
        }
        // Valid by construction.
        Content::Approximation(_) | Content::Surface(_) | Content::Mesh(_) => Ok(()),
        Content::Membrane { display, .. } => display.check(),
    }
}

fn not_a_curve(object: &Object) -> EditError {
    EditError::OtherKind { object: object.id, kind: object.content.kind(), wanted: "curve" }
}

/// Whether an object may have so many control points.
pub(in crate::document) fn check_point_count(count: usize) -> Result<(), EditError> {
    if count > MAX_POINTS {
        return Err(EditError::TooMany { what: "control points", value: count, limit: MAX_POINTS });
    }
    Ok(())
}
