//! The weights with which vertices of a coarser mesh make a vertex of the refined one.

use glam::DVec3;

use crate::app::surfaces::Picked;
use crate::app::surfaces::shape_store::ShapeStore;
use crate::core::surface::catmull_clark::{Origin, stencil_through};

/// A vertex of the refined mesh and what it is made of.
#[derive(Clone, Debug)]
pub(super) struct StencilView {
    /// Number of the vertex.
    pub(super) vertex: usize,
    /// Where it is drawn.
    pub(super) at: DVec3,
    /// Its level.
    pub(super) level: usize,
    /// What it was before the last step.
    pub(super) origin: Option<Origin>,
    /// Vertex of the coarser mesh, its place and its weight.
    pub(super) parents: Vec<(u32, DVec3, f64)>,
}

/// The stencil of the picked vertex: on the mesh of the step before, or on the control mesh.
pub(super) fn of(picked: Picked, store: &ShapeStore, one_step: bool) -> Option<StencilView> {
    let Picked::Refined(object, vertex) = picked else { return None };
    let (made_of, shape) = store.shape(object)?;
    let mesh = made_of.mesh()?;
    let at = *shape.vertices.get(vertex)?;
    let level = shape.steps.len();
    let origin = shape.steps.last().and_then(|step| step.origins.get(vertex)).copied();
    let (coarse, weights) = match (one_step, origin) {
        (true, Some(origin)) => {
            let coarse = shape.steps.iter().rev().nth(1).map_or(mesh.cage(), |step| &step.mesh);
            (coarse, coarse.stencil(origin, mesh.fixes_corners()).ok()?.weights)
        }
        _ => {
            let stencil = stencil_through(mesh.cage(), &shape.steps, mesh.rule(), vertex).ok()?;
            (mesh.cage(), stencil.weights)
        }
    };
    let place = |vertex: u32| coarse.positions().get(vertex as usize).copied();
    let parents = weights.into_iter().filter_map(|(vertex, weight)| Some((vertex, place(vertex)?, weight)));
    Some(StencilView { vertex, at, level, origin, parents: parents.collect() })
}

/// A weight as a fraction with a small denominator if it is one, else with four digits.
pub(super) fn weight_text(weight: f64) -> String {
    for denominator in
        [1_u32, 2, 3, 4, 6, 8, 9, 12, 16, 18, 24, 32, 36, 40, 48, 64, 72, 80, 96, 100, 128, 144, 192, 256]
    {
        let numerator = weight * f64::from(denominator);
        if (numerator - numerator.round()).abs() < 1e-9 {
            let numerator = numerator.round();
            return if denominator == 1 {
                format!("{numerator}")
            } else {
                format!("{numerator}/{denominator}")
            };
        }
    }
    format!("{weight:.4}")
}

#[cfg(test)]
mod tests {
    use super::weight_text;

    #[test]
    fn weights_of_regular_and_three_valent_vertices_are_fractions() {
        for (weight, text) in [(9.0 / 16.0, "9/16"), (5.0 / 12.0, "5/12"), (1.0, "1"), (0.123_456, "0.1235")]
        {
            assert_eq!(weight_text(weight), text, "{weight}");
        }
    }
}
