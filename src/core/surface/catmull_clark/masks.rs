//! The weights of Catmull-Clark subdivision; they know no mesh.
//!
//! `v` is the vertex, `e_k` its neighbours, `F_k` the centroids of its faces, `f_k` the vertices opposite to it in quadrilaterals;
//! `m` is the number of faces. The uniform rules for creases; boundary edges are infinitely sharp.
//!
//! E. Catmull, J. Clark, *Recursively generated B-spline surfaces on arbitrary topological meshes*, 1978. Course: section 8.3.

use std::f64::consts::{PI, TAU};

/// Weights of the new vertex on `v`, `e_k` and `F_k`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexMask {
    /// Of `v`.
    pub vertex: f64,
    /// Of the `e_k`.
    pub edges: Vec<f64>,
    /// Of the centroids `F_k`.
    pub faces: Vec<f64>,
}

/// The rule at a vertex, by the number of its edges with positive sharpness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VertexKind {
    /// No sharp edge, or one (a dart).
    Smooth,
    /// Two sharp edges, the numbers of which are kept.
    Crease([usize; 2]),
    /// Three or more, or a fixed vertex.
    Corner,
}

/// `(α, β, 1 − α − β)` for quadrilaterals: the new vertex is `(1 − α − β) v + α mean(e) + β mean(f)`, `α = 3/(2m)`, `β = 1/(4m)`.
pub fn quad_vertex_weights(m: usize) -> (f64, f64, f64) {
    let m = m as f64;
    (1.5 / m, 0.25 / m, 1.0 - 1.75 / m)
}

/// Weights of an edge point on each end and on each centroid beside it: `(1/4, 1/4)` if smooth, `(1/2, 0)` if sharp.
pub fn edge_weights(sharpness: f64) -> (f64, f64) {
    let s = sharpness.min(1.0);
    (0.25 + 0.25 * s, 0.25 - 0.25 * s)
}

/// Sharpness of both halves of an edge after a step.
pub fn child_sharpness(sharpness: f64) -> f64 {
    (sharpness - 1.0).max(0.0)
}

/// The kind of a vertex with edges of the given sharpness.
pub fn vertex_kind(sharpness: impl IntoIterator<Item = f64>, fixed: bool) -> VertexKind {
    let (mut count, mut ends) = (0, [0; 2]);
    for (k, s) in sharpness.into_iter().enumerate() {
        if s > 0.0 {
            ends[count.min(1)] = k;
            count += 1;
        }
    }
    match count {
        _ if fixed => VertexKind::Corner,
        0 | 1 => VertexKind::Smooth,
        2 => VertexKind::Crease(ends),
        _ => VertexKind::Corner,
    }
}

/// The mask of a vertex with `faces` faces and edges of the given sharpness.
///
/// Where the rules for the sharpness before and after the step differ, they are blended by the mean sharpness of the edges that become smooth.
pub fn vertex_mask(sharpness: &[f64], faces: usize, fixed: bool) -> VertexMask {
    let before = vertex_kind(sharpness.iter().copied(), fixed);
    let after = vertex_kind(sharpness.iter().map(|&s| child_sharpness(s)), fixed);
    let mut mask = VertexMask { vertex: 0.0, edges: vec![0.0; sharpness.len()], faces: vec![0.0; faces] };
    if before == after {
        mask.add(before, 1.0);
        return mask;
    }
    let ending = sharpness.iter().filter(|&&s| s > 0.0 && s <= 1.0);
    let (sum, count) = ending.fold((0.0, 0.0), |(sum, count), s| (sum + s, count + 1.0));
    let weight = if count > 0.0 { sum / count } else { 0.0 };
    mask.add(before, weight);
    mask.add(after, 1.0 - weight);
    mask
}

impl VertexMask {
    fn add(&mut self, kind: VertexKind, share: f64) {
        match kind {
            VertexKind::Corner => self.vertex += share,
            VertexKind::Crease(ends) => {
                self.vertex += 0.75 * share;
                ends.into_iter().for_each(|k| self.edges[k] += 0.125 * share);
            }
            VertexKind::Smooth => {
                // (F + 2R + (m − 3) v)/m with the mean F of the centroids and R of the edge midpoints.
                let m = self.faces.len() as f64;
                self.vertex += (m - 2.0) / m * share;
                self.edges.iter_mut().chain(&mut self.faces).for_each(|weight| *weight += share / (m * m));
            }
        }
    }
}

/// Weights of the limit of a smooth vertex among quadrilaterals on `v`, each `e_k`, each `f_k`: `(m², 4, 1)/(m(m + 5))`.
pub fn limit_weights(m: usize) -> (f64, f64, f64) {
    let m = m as f64;
    let scale = 1.0 / (m * (m + 5.0));
    (m * m * scale, 4.0 * scale, scale)
}

/// The subdominant eigenvalue `λ = (5 + c + √((c + 9)(c + 1)))/16` with `c = cos(angle)`, and `A = 16λ − 4`.
///
/// For a smooth vertex of valence m the angle is `2π/m`, for a crease with k faces on one side `π/k`.
pub fn subdominant_eigenvalue(angle: f64) -> (f64, f64) {
    let c = angle.cos();
    let a = 1.0 + c + ((c + 9.0) * (c + 1.0)).sqrt();
    ((a + 4.0) / 16.0, a)
}

/// Weights of the tangents `t₁`, `t₂` of a smooth vertex on `e_k` and `f_k`, for one `k`: `[[A cos, A sin], [cos + cos⁺, sin + sin⁺]]`.
pub fn tangent_weights(m: usize, k: usize) -> [[f64; 2]; 2] {
    let step = TAU / m as f64;
    let (_, a) = subdominant_eigenvalue(step);
    let (here, next) = ((step * k as f64).sin_cos(), (step * (k + 1) as f64).sin_cos());
    [[a * here.1, a * here.0], [here.1 + next.1, here.0 + next.0]]
}

/// Weights of the tangent across a crease or boundary, on the side with `k ≥ 2` faces.
///
/// Inner neighbour `i` has the weight `sin(iπ/k)`, opposite vertex `i` the weight `opposite · (sin(iπ/k) + sin((i + 1)π/k))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreaseTangent {
    /// The eigenvalue of this direction.
    pub eigenvalue: f64,
    /// Weight of the vertex.
    pub vertex: f64,
    /// Weight of both neighbours along the crease.
    pub along: f64,
    /// Factor of the opposite vertices.
    pub opposite: f64,
}

/// The weights for `k ≥ 2` faces, the left eigenvector of the plain rules for the first sine mode.
pub fn crease_tangent(k: usize) -> CreaseTangent {
    let angle = PI / k as f64;
    let (eigenvalue, a) = subdominant_eigenvalue(angle);
    let opposite = 1.0 / a;
    // (λ − ½) y₀ = y_v/8 + sin(π/k)(1/16 + β/4) and 2y₀ + y_v + cot(π/2k)(1 + 2β) = 0.
    let closing = (1.0 + 2.0 * opposite) / (0.5 * angle).tan();
    let along = (angle.sin() * (0.0625 + 0.25 * opposite) - 0.125 * closing) / (eigenvalue - 0.25);
    CreaseTangent { eigenvalue, vertex: -2.0 * along - closing, along, opposite }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn position_masks_sum_to_one_and_tangent_masks_to_zero() {
        let cases: [&[f64]; 6] = [
            &[0.0; 5],
            &[2.0, 0.0, 0.3, 0.0],
            &[0.5; 3],
            &[f64::INFINITY, 0.0, 0.0, 1.0],
            &[0.7, 0.0, 0.0],
            &[1.5; 2],
        ];
        for sharpness in cases {
            let mask = vertex_mask(sharpness, sharpness.len(), false);
            let sum = mask.vertex + mask.edges.iter().chain(&mask.faces).sum::<f64>();
            assert!((sum - 1.0).abs() < 1e-15, "{sharpness:?}: {sum}");
        }
        for m in 3..12 {
            let (v, e, f) = limit_weights(m);
            assert!((v + (e + f) * m as f64 - 1.0).abs() < 1e-15, "limit of valence {m}");
            for t in 0..2 {
                let sum: f64 = (0..m).map(|k| tangent_weights(m, k)).map(|w| w[0][t] + w[1][t]).sum();
                assert!(sum.abs() < 1e-13, "tangent {t} of valence {m}: {sum}");
            }
        }
        for k in 2..12 {
            let tangent = crease_tangent(k);
            let sine = |i: usize| (PI * i as f64 / k as f64).sin();
            let faces: f64 = (0..k).map(|i| tangent.opposite * (sine(i) + sine(i + 1))).sum();
            let sum = tangent.vertex + 2.0 * tangent.along + (1..k).map(sine).sum::<f64>() + faces;
            assert!(sum.abs() < 1e-13, "{k} faces: {sum}");
        }
    }

    #[test]
    fn sharpness_blends_between_smooth_and_sharp() {
        assert_eq!(edge_weights(0.0), (0.25, 0.25), "smooth");
        assert_eq!(edge_weights(3.0), (0.5, 0.0), "sharp");
        assert_eq!(edge_weights(0.5), (0.375, 0.125), "halfway");
        assert_eq!(child_sharpness(f64::INFINITY), f64::INFINITY, "infinity stays");
        assert_eq!(vertex_kind([1.0, 0.0, 0.2], false), VertexKind::Crease([0, 2]), "two sharp edges");
        assert_eq!(vertex_kind([0.0, 0.0], true), VertexKind::Corner, "fixed");
    }
}
