//! Handles that change weights: a ring outside a point, dragged along its ray, and the weight points on the edges.
//!
//! The weight point of an edge divides it in the ratio of its weights, `(wᵢ cᵢ + wᵢ₊₁ cᵢ₊₁)/(wᵢ + wᵢ₊₁)`; together they fix the shape. G. Farin, 1982; course:
//! section 3.1.

use glam::DVec2;

use crate::app::lab::Lab;
use crate::core::spline_curve::Nurbs;
use crate::document::Object;
use crate::figure::picture::Viewport;

/// Pixels from the point to its ring.
const RING_DISTANCE: f64 = 34.0;

/// Pixels that double the weight.
const DOUBLING: f64 = 50.0;

/// Above this many edges the weight points are not shown.
const MOST_EDGES: usize = 2000;

/// The one selected point, and the unit direction of the ray to its ring: away from the neighbours.
pub(super) fn ray(lab: &Lab, object: &Object) -> Option<(usize, DVec2)> {
    let index = *lab.selection.points.first()?;
    if lab.selection.points.len() != 1 || lab.selection.object != Some(object.id) {
        return None;
    }
    let curve = object.curve()?;
    let (points, count) = (curve.points(), curve.points().len());
    let point = *points.get(index)?;
    let closed = curve.space().is_periodic();
    let mut away = DVec2::ZERO;
    let before = if closed { Some((index + count - 1) % count) } else { index.checked_sub(1) };
    let after = if closed { Some((index + 1) % count) } else { Some(index + 1).filter(|&k| k < count) };
    for neighbour in [before, after].into_iter().flatten() {
        away += (point - points[neighbour]).normalize_or_zero();
    }
    // Straight on there is no outside: to the left then.
    let direction = if away.length() > 1e-3 {
        away.normalize()
    } else {
        let next = after.or(before).map_or(DVec2::X, |k| points[k] - point);
        next.perp().normalize_or(DVec2::Y)
    };
    Some((index, direction))
}

/// The ring of the one selected point, with the way in pixels that it has been dragged.
pub(super) fn ring_place(
    lab: &Lab,
    object: &Object,
    viewport: &Viewport,
    dragged: f64,
) -> Option<(usize, DVec2)> {
    let (index, direction) = ray(lab, object)?;
    let point = object.curve()?.points()[index];
    Some((index, point + direction * ((RING_DISTANCE + dragged.max(8.0 - RING_DISTANCE)) / viewport.scale)))
}

/// The weight after the ring has been dragged so many pixels outwards.
pub(super) fn weight_for_ring(start: f64, dragged: f64) -> f64 {
    (start * (dragged / DOUBLING).exp2()).clamp(1e-6, 1e6)
}

/// The end of edge `index`, which begins at point `index`.
pub(super) fn edge_end(curve: &Nurbs<DVec2>, index: usize) -> usize {
    (index + 1) % curve.points().len()
}

/// The weight points of the selected curve, one on each edge, if they are shown.
pub(super) fn weight_points(lab: &Lab, object: &Object) -> Vec<DVec2> {
    let Some(curve) = object.curve().filter(|_| lab.weight_points && lab.selection.object == Some(object.id))
    else {
        return Vec::new();
    };
    let count = curve.points().len();
    if count > MOST_EDGES {
        return Vec::new();
    }
    let edges = if curve.space().is_periodic() { count } else { count - 1 };
    (0..edges)
        .map(|k| {
            let end = edge_end(curve, k);
            let (from, to) = (curve.weights()[k], curve.weights()[end]);
            curve.points()[k].lerp(curve.points()[end], 1.0 / (1.0 + from / to))
        })
        .collect()
}

/// The weights that bring the weight point of edge `index` as near as possible to `wanted`.
///
/// On an open curve all weights behind the edge get the same factor, so that the other weight points stay; on a closed one, where their ratios multiply to 1, only the
/// weight at the end of the edge changes.
pub(super) fn weights_for_weight_point(curve: &Nurbs<DVec2>, index: usize, wanted: DVec2) -> Vec<f64> {
    let end = edge_end(curve, index);
    let (from, to) = (curve.points()[index], curve.points()[end]);
    let edge = to - from;
    let share = (wanted - from).dot(edge) / edge.length_squared();
    let mut weights = curve.weights().to_vec();
    if !share.is_finite() {
        return weights;
    }
    let share = share.clamp(0.01, 0.99);
    let weight = weights[index] * share / (1.0 - share);
    let factor = weight / weights[end];
    if curve.space().is_periodic() {
        weights[end] = weight;
    } else {
        weights[end..].iter_mut().for_each(|weight| *weight *= factor);
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use crate::core::spline_curve::Nurbs;

    #[test]
    fn a_dragged_weight_point_goes_where_it_is_dragged_and_the_others_stay() {
        let mut lab = test_bench::lab();
        lab.weight_points = true;
        let object = lab.selection.object.unwrap_or(lab.history.document().objects()[0].id);
        lab.selection.object = Some(object);
        let found = lab.history.document().object(object).unwrap();
        let before = weight_points(&lab, found);
        let curve = lab.curve().unwrap();
        let wanted = curve.points()[2].lerp(curve.points()[3], 0.8);
        let weights = weights_for_weight_point(curve, 2, wanted);
        assert!((weights[3] / weights[2] - 4.0).abs() < 1e-12, "4 : 1, not {weights:?}");
        let new = Nurbs::new(curve.space().clone(), curve.points().to_vec(), weights).unwrap();
        lab.edit(crate::document::Edit::ReplaceCurve { object, curve: new, label: "w".to_owned() });
        let after = weight_points(&lab, lab.history.document().object(object).unwrap());
        assert!(after[2].distance(wanted) < 1e-12, "{} is not {wanted}", after[2]);
        for k in [0, 1, 3, 4, 5] {
            assert!(after[k].distance(before[k]) < 1e-12, "edge {k} moved");
        }
    }

    #[test]
    fn the_ring_doubles_and_halves() {
        assert_eq!(weight_for_ring(1.5, DOUBLING), 3.0, "outwards");
        assert_eq!(weight_for_ring(1.5, -DOUBLING), 0.75, "inwards");
    }
}
