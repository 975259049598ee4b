//! The document: a list of shared objects.

use std::sync::Arc;

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::document::approximation::Approximation;
use crate::document::object::{Object, ObjectId};

/// What is saved and undone: objects in drawing order, the first one lowest.
///
/// Cloning costs one pointer for each object; the objects themselves are shared.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Document {
    pub(in crate::document) objects: Vec<Arc<Object>>,
    /// Number of objects ever made: the next one gets `made + 1`.
    pub(in crate::document) made: u64,
}

impl Document {
    /// The empty document.
    pub fn new() -> Self {
        Self::default()
    }

    /// The objects in drawing order, the first one lowest.
    pub fn objects(&self) -> &[Arc<Object>] {
        &self.objects
    }

    /// The object with the number `id`.
    pub fn object(&self, id: ObjectId) -> Option<&Arc<Object>> {
        self.position(id).map(|position| &self.objects[position])
    }

    /// The curve with the number `id`.
    pub fn curve(&self, id: ObjectId) -> Option<&Nurbs<DVec2>> {
        self.object(id).and_then(|object| object.curve())
    }

    /// The approximation with the number `id`.
    pub fn approximation(&self, id: ObjectId) -> Option<&Approximation> {
        self.object(id).and_then(|object| object.approximation())
    }

    /// Number of objects.
    pub fn len(&self) -> usize {
        self.objects.len()
    }

    /// Whether there are no objects.
    pub fn is_empty(&self) -> bool {
        self.objects.is_empty()
    }

    /// The number that the next new object gets.
    pub fn next_id(&self) -> ObjectId {
        ObjectId(self.made + 1)
    }

    /// Smallest and largest coordinates of the control points of the visible curves and of the regions of visible boundary
    /// value problems; weights are positive, so the curves lie inside. `None` if none is visible.
    pub fn bounding_box(&self) -> Option<(DVec2, DVec2)> {
        let visible = self.objects.iter().filter(|object| object.visible);
        let points = visible.flat_map(|object| {
            let curve = object.curve().map(|curve| curve.points().to_vec());
            let region = object.membrane().and_then(|(membrane, _)| membrane.bounding_box());
            curve.or(region.map(|(low, high)| vec![low, high])).unwrap_or_default()
        });
        points.fold(None, |bounds, point| {
            Some(
                bounds
                    .map_or((point, point), |(low, high): (DVec2, DVec2)| (low.min(point), high.max(point))),
            )
        })
    }

    /// Index of the object in [`Self::objects`].
    pub(in crate::document) fn position(&self, id: ObjectId) -> Option<usize> {
        self.objects.iter().position(|object| object.id == id)
    }
}
