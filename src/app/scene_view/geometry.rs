//! A scene as bytes for the GPU: vertices in f32 after the place in the middle of things has been subtracted in f64.
//!
//! A surface is a list of vertices with place, normal, front and back colour; without normals every triangle has its own
//! three. A segment of a line is a strip of four corners, each with its own end, the other end, and the neighbour beyond its own
//! end, so that the shader can widen it on the page and cut it at bends. A mark is a square of four corners.

use std::ops::Range;

use glam::{DVec3, Vec3};

use crate::figure::picture::{Color, MarkerShape};
use crate::figure::scene::{Line, Points, Scene, SceneItem, Triangles};

/// Bytes of a vertex of a surface.
pub(super) const FACET_BYTES: u64 = 32;
/// Bytes of a corner of a stroke.
pub(super) const STROKE_BYTES: u64 = 60;
/// Bytes of a corner of a mark.
pub(super) const MARK_BYTES: u64 = 40;

/// What is drawn over the surfaces, in order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) kind: Kind,
    /// Whether surfaces do not hide it.
    pub(super) on_top: bool,
    /// Which squares of its kind.
    pub(super) quads: Range<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Stroke,
    Mark,
}

/// A scene as the GPU takes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Geometry {
    pub(super) facets: Vec<u8>,
    /// Corners of opaque triangles, then those of translucent ones.
    pub(super) indices: Vec<u32>,
    pub(super) opaque: u32,
    pub(super) strokes: Vec<u8>,
    pub(super) marks: Vec<u8>,
    pub(super) runs: Vec<Run>,
}

impl Geometry {
    /// The scene as seen from `origin`.
    pub(super) fn new(scene: &Scene, origin: DVec3) -> Self {
        let mut geometry = Self::default();
        let mut translucent = Vec::new();
        for item in scene.layers.iter().flat_map(|layer| &layer.items) {
            match item {
                SceneItem::Triangles(surface) => geometry.add_surface(surface, origin, &mut translucent),
                SceneItem::Line(line) => geometry.add_line(line, origin),
                SceneItem::Points(points) => geometry.add_marks(points, origin),
                SceneItem::Label(_) => {}
            }
        }
        geometry.opaque = geometry.indices.len() as u32;
        geometry.indices.append(&mut translucent);
        geometry
    }

    /// Number of squares of the kind that has most of them.
    pub(super) fn most_quads(&self) -> u32 {
        self.runs.iter().map(|run| run.quads.end).max().unwrap_or(0)
    }

    /// Where the vertices of surfaces are.
    pub(super) fn facet_places(&self) -> Vec<Vec3> {
        let vertices = self.facets.as_chunks::<{ FACET_BYTES as usize }>().0;
        let part = |vertex: &[u8], k: usize| f32::from_ne_bytes(vertex.as_chunks().0[k]);
        vertices.iter().map(|vertex| Vec3::from_array([0, 1, 2].map(|k| part(vertex, k)))).collect()
    }

    fn add_surface(&mut self, surface: &Triangles, origin: DVec3, translucent: &mut Vec<u32>) {
        let count = |bytes: &[u8]| (bytes.len() as u64 / FACET_BYTES) as u32;
        let first = count(&self.facets);
        let color = |vertex: usize| surface.colors().get(vertex).copied().unwrap_or(surface.color);
        let back = |front: Color| surface.back_color.unwrap_or(front);
        // Without light a vertex has no normal.
        let smooth = !surface.is_lit || surface.normals().len() == surface.positions().len();
        if smooth {
            for (vertex, &position) in surface.positions().iter().enumerate() {
                let normal = if surface.is_lit { surface.normals()[vertex] } else { DVec3::ZERO };
                self.add_facet_vertex(position - origin, normal, color(vertex), back(color(vertex)));
            }
        }
        for (index, corners) in surface.triangles().iter().enumerate() {
            let places = surface.corners(index);
            let needs_own = !smooth
                || (surface.is_lit
                    && corners.iter().any(|&corner| surface.normals()[corner as usize] == DVec3::ZERO));
            let mut listed = if needs_own {
                let own = count(&self.facets);
                let normals = surface.corner_normals(index);
                for k in 0..3 {
                    let front = color(corners[k] as usize);
                    self.add_facet_vertex(places[k] - origin, normals[k], front, back(front));
                }
                [own, own + 1, own + 2]
            } else {
                corners.map(|corner| first + corner)
            };
            // The side that the normals show is the front, however the corners run.
            if surface.is_lit && smooth {
                let normals = surface.corner_normals(index);
                if (normals[0] + normals[1] + normals[2]).dot(surface.face_normal(index)) < 0.0 {
                    listed.swap(1, 2);
                }
            }
            let is_opaque = corners.iter().all(|&corner| {
                let front = color(corner as usize);
                front.a == 255 && back(front).a == 255
            });
            if is_opaque { self.indices.extend(listed) } else { translucent.extend(listed) }
        }
    }

    fn add_facet_vertex(&mut self, place: DVec3, normal: DVec3, front: Color, back: Color) {
        push(&mut self.facets, &single(place).to_array());
        push(&mut self.facets, &normal.as_vec3().to_array());
        self.facets.extend([front, back].map(bytes).as_flattened());
    }

    fn add_line(&mut self, line: &Line, origin: DVec3) {
        let stroke = &line.stroke;
        let is_seen = stroke.width.is_finite() && stroke.width > 0.0 && stroke.color.a > 0;
        let points = line.points();
        if !is_seen || points.len() < 2 {
            return;
        }
        let first = (self.strokes.len() as u64 / (4 * STROKE_BYTES)) as u32;
        let places: Vec<Vec3> = points.iter().map(|&point| single(point - origin)).collect();
        let last = places.len() - 1;
        let is_closed = last > 1 && points[0] == points[last];
        let (dash, gap) = match stroke.dashes[..] {
            [] => (0.0, 0.0),
            [dash] => (dash, dash),
            [dash, gap, ..] => (dash, gap),
        };
        let mut so_far = 0.0;
        for k in 0..last {
            let (a, b) = (places[k], places[k + 1]);
            let before = match k {
                0 if is_closed => places[last - 1],
                0 => a,
                _ => places[k - 1],
            };
            let after = match places.get(k + 2) {
                Some(&place) => place,
                None if is_closed => places[1],
                None => b,
            };
            let next = so_far + points[k].distance(points[k + 1]);
            for (own, other, beyond, length, corner) in [
                (a, b, before, so_far, 1.0),
                (a, b, before, so_far, -1.0),
                (b, a, after, next, -2.0),
                (b, a, after, next, 2.0),
            ] {
                let out = &mut self.strokes;
                push(out, &own.to_array());
                push(out, &other.to_array());
                push(out, &beyond.to_array());
                out.extend(bytes(stroke.color));
                push(out, &[stroke.width as f32, length as f32, dash as f32, gap as f32, corner]);
            }
            so_far = next;
        }
        self.add_run(Kind::Stroke, line.on_top, first..first + last as u32);
    }

    fn add_marks(&mut self, points: &Points, origin: DVec3) {
        if !(points.size.is_finite() && points.size > 0.0) || points.points().is_empty() {
            return;
        }
        let first = (self.marks.len() as u64 / (4 * MARK_BYTES)) as u32;
        let shape = match points.shape {
            MarkerShape::Disc => 0.0,
            MarkerShape::Square => 1.0,
            MarkerShape::Diamond => 2.0,
            MarkerShape::Triangle => 3.0,
            MarkerShape::Cross => 4.0,
        };
        let (ink, width) = points
            .outline
            .as_ref()
            .map_or((points.fill.with_opacity(0.0), 0.0), |stroke| (stroke.color, stroke.width));
        for &point in points.points() {
            for corner in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
                let out = &mut self.marks;
                push(out, &single(point - origin).to_array());
                out.extend([points.fill, ink].map(bytes).as_flattened());
                push(out, &[points.size as f32, width as f32, shape]);
                push(out, &corner);
            }
        }
        self.add_run(Kind::Mark, points.on_top, first..first + points.points().len() as u32);
    }

    /// Goes on with the last run if it is of the same kind.
    fn add_run(&mut self, kind: Kind, on_top: bool, quads: Range<u32>) {
        match self.runs.last_mut() {
            Some(run) if run.kind == kind && run.on_top == on_top => run.quads.end = quads.end,
            _ => self.runs.push(Run { kind, on_top, quads }),
        }
    }
}

/// Corners 0 1 2 and 1 3 2 of so many squares.
pub(super) fn quad_indices(quads: u32) -> Vec<u32> {
    (0..quads).flat_map(|quad| [0, 1, 2, 1, 3, 2].map(|corner| 4 * quad + corner)).collect()
}

/// Far places stay finite.
fn single(place: DVec3) -> Vec3 {
    place.clamp(DVec3::splat(-1e30), DVec3::splat(1e30)).as_vec3()
}

fn bytes(color: Color) -> [u8; 4] {
    [color.r, color.g, color.b, color.a]
}

fn push<const N: usize>(out: &mut Vec<u8>, values: &[f32; N]) {
    out.extend(values.map(f32::to_ne_bytes).as_flattened());
}
