//! Questions about subdivided meshes whose answer is a number that the core computes.

use glam::DVec3;
use serde::Deserialize;

use crate::core::surface::catmull_clark::Origin;
use crate::core::surface::{MeshError, PolygonMesh};
use crate::course::question::{Verdict, sentence};
use crate::course::question::{judge, surface::SpaceAxis};
use crate::document::MeshObject;

/// A coordinate of a vertex that subdivision makes of the control mesh.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum MeshQuantity {
    /// Of the image of a vertex after one step.
    Image {
        /// The vertex.
        vertex: usize,
        /// The coordinate.
        axis: SpaceAxis,
    },
    /// Of the point to which a vertex tends.
    Limit {
        /// The vertex.
        vertex: usize,
        /// The coordinate.
        axis: SpaceAxis,
    },
}

impl MeshQuantity {
    fn vertex(&self) -> usize {
        let (Self::Image { vertex, .. } | Self::Limit { vertex, .. }) = *self;
        vertex
    }

    fn axis(&self) -> SpaceAxis {
        let (Self::Image { axis, .. } | Self::Limit { axis, .. }) = *self;
        axis
    }

    /// The number for `object`.
    ///
    /// # Errors
    ///
    /// A sentence that says why the number does not exist.
    pub fn compute(&self, object: &MeshObject) -> Result<f64, String> {
        let (cage, fixed) = (object.cage(), object.fixes_corners());
        let point = match *self {
            Self::Image { vertex, .. } => image(cage, vertex, fixed),
            Self::Limit { vertex, .. } => cage.limit(vertex, fixed).map(|limit| limit.position),
        };
        point.map(|point| self.axis().of(point)).map_err(|error| sentence(&error.to_string()))
    }
}

fn image(cage: &PolygonMesh, vertex: usize, fixed: bool) -> Result<DVec3, MeshError> {
    let origin = Origin::Vertex(u32::try_from(vertex).unwrap_or(u32::MAX));
    Ok(cage.stencil(origin, fixed)?.apply(cage.positions()))
}

/// Judges the number `value`.
pub(super) fn check(
    object: &MeshObject,
    quantity: &MeshQuantity,
    tolerance: f64,
    value: f64,
    feedback: &str,
) -> Verdict {
    judge(value, quantity.compute(object), tolerance, feedback, |_| {
        let (vertex, axis) = (quantity.vertex(), quantity.axis());
        let close = |other: f64| (value - other).abs() <= tolerance;
        let is_other = |other: MeshQuantity| other.compute(object).is_ok_and(close);
        let cage = object.cage();
        let hint = if close(axis.of(cage.positions()[vertex])) {
            "That is the vertex itself; only corners with three sharp edges stay where they are."
        } else if is_other(MeshQuantity::Limit { vertex, axis }) {
            "That is where it tends to after infinitely many steps."
        } else if is_other(MeshQuantity::Image { vertex, axis }) {
            "That is its image after one step; the next steps move it on."
        } else if with_edge_points(cage, vertex).is_some_and(|point| close(axis.of(point))) {
            "$R$ is the mean of the midpoints of the edges, not of the new edge points."
        } else if faces_mean(cage, vertex).is_some_and(|point| close(axis.of(point))) {
            "That is $F$ alone, the mean of the face points."
        } else {
            "Take the mean $F$ of the centres of the faces around, the mean $R$ of the midpoints of the edges there, \
         and count the faces: $m$."
        };
        hint.to_owned()
    })
}

/// `F`, the mean of the centres of the faces around an inner vertex.
fn faces_mean(cage: &PolygonMesh, vertex: usize) -> Option<DVec3> {
    let ring = cage.topology().ring(vertex);
    let sum: DVec3 = ring.faces.iter().map(|&face| cage.centroid(face as usize)).sum();
    ring.closed.then(|| sum / ring.faces.len() as f64)
}

/// The rule of an inner vertex with the new edge points in place of the midpoints, a common mistake.
fn with_edge_points(cage: &PolygonMesh, vertex: usize) -> Option<DVec3> {
    let ring = cage.topology().ring(vertex);
    let count = ring.edges.len() as f64;
    let edge_point =
        |&edge: &u32| Some(cage.stencil(Origin::Edge(edge), false).ok()?.apply(cage.positions()));
    let points: Option<Vec<DVec3>> = ring.edges.iter().map(edge_point).collect();
    let mean = points?.into_iter().sum::<DVec3>() / count;
    Some((faces_mean(cage, vertex)? + 2.0 * mean + (count - 3.0) * cage.positions()[vertex]) / count)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::mesh_shapes;
    use crate::document::MeshDisplay;

    fn object(cage: PolygonMesh) -> MeshObject {
        MeshObject::from_cage(cage, MeshDisplay::default()).unwrap()
    }

    #[test]
    fn right_numbers_are_those_of_the_worked_examples() {
        let (cube, tetrahedron) = (object(mesh_shapes::cube()), object(mesh_shapes::tetrahedron()));
        let axis = SpaceAxis::X;
        for (object, quantity, expected) in [
            (&cube, MeshQuantity::Image { vertex: 6, axis }, 5.0 / 9.0),
            (&cube, MeshQuantity::Limit { vertex: 6, axis }, 0.5),
            (&tetrahedron, MeshQuantity::Image { vertex: 0, axis }, 7.0 / 27.0),
            (&tetrahedron, MeshQuantity::Limit { vertex: 0, axis }, 2.0 / 9.0),
        ] {
            let found = quantity.compute(object).unwrap();
            assert!((found - expected).abs() < 1e-12, "{quantity:?}: {found} instead of {expected}");
        }
        for vertex in [8, usize::MAX] {
            assert!(MeshQuantity::Image { vertex, axis }.compute(&cube).is_err(), "no vertex {vertex}");
            assert!(MeshQuantity::Limit { vertex, axis }.compute(&cube).is_err(), "no vertex {vertex}");
        }
    }

    #[test]
    fn hints_name_the_violated_fact() {
        let cube = object(mesh_shapes::cube());
        let quantity = MeshQuantity::Image { vertex: 6, axis: SpaceAxis::Z };
        let ask = |value: f64| check(&cube, &quantity, 0.002, value, "Right.");
        assert!(ask(5.0 / 9.0).correct, "right");
        for (value, fact) in [
            (1.0, "vertex itself"),
            (0.5, "infinitely many"),
            (4.0 / 9.0, "not of the new edge points"),
            (1.0 / 3.0, "$F$ alone"),
            (0.7, "count the faces"),
        ] {
            let verdict = ask(value);
            assert!(!verdict.correct && verdict.message.contains(fact), "{value}: {verdict:?}");
        }
    }
}
