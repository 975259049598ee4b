//! The triangles of a scene as they appear on a page: cut at the eye, projected, lit.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::core::point::Point as _;
use crate::figure::picture::Color;
use crate::figure::raster::Corner;
use crate::figure::scene::{EyeView, Light, Scene, Triangles};

/// A triangle on the page; places of its corners in pt, nearness as [`nearness`] counts it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub(super) corners: [Corner; 3],
    /// Depth of the middle.
    pub(super) depth: f64,
}

impl Facet {
    pub(super) fn is_opaque(&self) -> bool {
        self.corners.iter().all(|corner| corner.color.a == 255)
    }
}

/// All facets on the page: the opaque ones as they come in the scene, then the translucent ones, farthest first.
pub(super) fn facets(scene: &Scene, view: &EyeView, light: &Light) -> Vec<Facet> {
    let mut facets = Vec::new();
    for surface in scene.triangles() {
        facets.par_extend(
            (0..surface.triangles().len())
                .into_par_iter()
                .flat_map_iter(|index| surface_facets(surface, index, view, light)),
        );
    }
    let (mut opaque, mut translucent): (Vec<_>, Vec<_>) = facets.into_iter().partition(Facet::is_opaque);
    sort_from_far(&mut translucent);
    opaque.append(&mut translucent);
    opaque
}

/// The painter's order; equal depths keep theirs.
pub(super) fn sort_from_far(facets: &mut [Facet]) {
    facets.sort_by(|a, b| b.depth.total_cmp(&a.depth));
}

/// What grows linearly on the page towards the eye: the reciprocal of the depth in perspective, its negative otherwise.
pub(super) fn nearness(view: &EyeView, depth: f64) -> f64 {
    if view.eye.state().orthographic { -depth } else { 1.0 / depth }
}

/// The depth of a nearness; infinite for what is infinitely far.
pub(super) fn depth_of(view: &EyeView, nearness: f64) -> f64 {
    if view.eye.state().orthographic {
        -nearness
    } else if nearness > 0.0 {
        1.0 / nearness
    } else {
        f64::INFINITY
    }
}

fn surface_facets(surface: &Triangles, index: usize, view: &EyeView, light: &Light) -> Vec<Facet> {
    let positions = surface.corners(index);
    let normals = surface.corner_normals(index);
    let axes = view.eye.axes();
    let along_axes = |v: DVec3| DVec3::new(v.dot(axes.right), v.dot(axes.up), v.dot(axes.towards));
    let to_eye = positions.map(|position| {
        if view.eye.state().orthographic {
            DVec3::Z
        } else {
            along_axes(view.eye.position() - position).normalize_or(DVec3::Z)
        }
    });
    let normals = normals.map(along_axes);
    let is_front = (0..3).map(|i| normals[i].dot(to_eye[i])).sum::<f64>() >= 0.0;
    let side = if is_front { 1.0 } else { -1.0 };
    let colors = surface.corner_colors(index, is_front);
    let lit = |i: usize| {
        if surface.is_lit { light.shade(colors[i], normals[i] * side, to_eye[i]) } else { colors[i] }
    };
    let corners = [0, 1, 2].map(|i| (positions[i], lit(i)));
    let seen: Vec<Corner> = in_front(&corners, view)
        .into_iter()
        .filter_map(|(position, color)| {
            let seen = view.project(position)?;
            let weight = if view.eye.state().orthographic { 1.0 } else { 1.0 / seen.depth };
            Some(Corner { at: seen.page, nearness: nearness(view, seen.depth), weight, color })
        })
        .collect();
    let (low, high) = seen.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), corner| {
        (low.min(corner.at), high.max(corner.at))
    });
    if seen.len() < 3 || high.cmplt(DVec2::ZERO).any() || low.cmpgt(view.size).any() {
        return Vec::new();
    }
    (2..seen.len())
        .map(|i| {
            let corners = [seen[0], seen[i - 1], seen[i]];
            let depth = corners.iter().map(|corner| depth_of(view, corner.nearness) / 3.0).sum();
            Facet { corners, depth }
        })
        .collect()
}

/// The part of a triangle in front of the nearest depth that is seen (I. Sutherland, G. Hodgman, 1974).
fn in_front(corners: &[(DVec3, Color); 3], view: &EyeView) -> Vec<(DVec3, Color)> {
    // A little beyond, so that rounding leaves nothing too near.
    let near = view.eye.near() * (1.0 + 1e-9);
    let room = corners.map(|(position, _)| view.eye.depth(position) - near);
    if room.iter().all(|&room| room > 0.0) {
        return corners.to_vec();
    }
    let mut part = Vec::with_capacity(4);
    for i in 0..3 {
        let j = (i + 1) % 3;
        if room[i] > 0.0 {
            part.push(corners[i]);
        }
        if (room[i] > 0.0) != (room[j] > 0.0) {
            let t = room[i] / (room[i] - room[j]);
            part.push((corners[i].0.mix(corners[j].0, t), mix_colors(corners[i].1, corners[j].1, t)));
        }
    }
    part
}

/// `(1 − t)·a + t·b` in sRGB values.
pub(crate) fn mix_colors(a: Color, b: Color, t: f64) -> Color {
    let mix = |a: u8, b: u8| f64::from(a).mix(f64::from(b), t).round() as u8;
    Color { r: mix(a.r, b.r), g: mix(a.g, b.g), b: mix(a.b, b.b), a: mix(a.a, b.a) }
}
