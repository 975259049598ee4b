//! A scene in the memory of the GPU.

use glam::DVec3;
use wgpu::util::DeviceExt as _;

use crate::app::scene_view::coarse::coarse;
use crate::app::scene_view::geometry::{Geometry, Run, quad_indices};
use crate::app::scene_view::gpu::{Order, checked};
use crate::app::scene_view::pace::Quality;

/// Places in f32 are exact enough if their last digit is less than this many pixels.
const MOST_ERROR: f64 = 0.1;

pub(super) struct Buffers {
    pub(super) version: u64,
    pub(super) origin: DVec3,
    /// Vertices of surfaces and the triangles between them.
    facets: Option<(wgpu::Buffer, Surfaces)>,
    /// Fewer triangles between the same vertices, once they are asked for; none if there are none at all.
    coarse: Option<Option<Surfaces>>,
    pub(super) strokes: Option<wgpu::Buffer>,
    pub(super) marks: Option<wgpu::Buffer>,
    pub(super) quads: Option<wgpu::Buffer>,
    pub(super) runs: Vec<Run>,
}

/// Corners of triangles, first of the opaque ones.
pub(super) struct Surfaces {
    pub(super) indices: wgpu::Buffer,
    pub(super) opaque: u32,
    pub(super) count: u32,
}

impl Buffers {
    /// Whether the buffers still show the scene of `order`, exactly enough for its view.
    pub(super) fn serve(&self, order: &Order<'_>) -> bool {
        self.version == order.version && is_exact(self.origin, order)
    }

    /// Buffers for pictures of this quality; `None` if this GPU has no room for them.
    pub(super) fn new(order: &Order<'_>, quality: Quality, device: &wgpu::Device) -> Option<Self> {
        let middle = order.bounds.map_or(DVec3::ZERO, |(low, high)| low + (high - low) * 0.5);
        let origin = if is_exact(middle, order) { middle } else { order.view.eye.state().target };
        let geometry = Geometry::new(order.scene, origin);
        let quads = bytes(&quad_indices(geometry.most_quads()));
        let most = device.limits().max_buffer_size;
        let all = [&geometry.facets, &geometry.strokes, &geometry.marks, &quads];
        if all.iter().any(|contents| contents.len() as u64 > most) {
            return None;
        }
        checked(device, || {
            let fill = |label, contents: &[u8], usage| fill(device, label, contents, usage);
            let (vertex, index) = (wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX);
            let surfaces = Surfaces::new(&geometry.indices, geometry.opaque, device);
            Self {
                version: order.version,
                origin,
                facets: fill("facets", &geometry.facets, vertex).zip(surfaces),
                coarse: (quality == Quality::Quick).then(|| Surfaces::coarse(&geometry, device)),
                strokes: fill("strokes", &geometry.strokes, vertex),
                marks: fill("marks", &geometry.marks, vertex),
                quads: fill("quads", &quads, index),
                runs: geometry.runs,
            }
        })
        .ok()
    }

    /// Makes what pictures of this quality need.
    pub(super) fn prepare(&mut self, order: &Order<'_>, quality: Quality, device: &wgpu::Device) {
        if quality == Quality::Quick && self.coarse.is_none() {
            let geometry = Geometry::new(order.scene, self.origin);
            self.coarse = Some(Surfaces::coarse(&geometry, device));
        }
    }

    /// Vertices and triangles.
    pub(super) fn surfaces(&self, quality: Quality) -> Option<(&wgpu::Buffer, &Surfaces)> {
        let (vertices, all) = self.facets.as_ref()?;
        match quality {
            Quality::Fine => Some((vertices, all)),
            Quality::Quick => Some((vertices, self.coarse.as_ref()?.as_ref()?)),
        }
    }
}

impl Surfaces {
    fn new(corners: &[u32], opaque: u32, device: &wgpu::Device) -> Option<Self> {
        let indices = fill(device, "indices", &bytes(corners), wgpu::BufferUsages::INDEX)?;
        Some(Self { indices, opaque, count: corners.len() as u32 })
    }

    fn coarse(geometry: &Geometry, device: &wgpu::Device) -> Option<Self> {
        let places = geometry.facet_places();
        let (opaque, translucent) = geometry.indices.split_at(geometry.opaque as usize);
        let mut corners = coarse(&places, opaque);
        let opaque = corners.len() as u32;
        corners.extend(coarse(&places, translucent));
        Self::new(&corners, opaque, device)
    }
}

/// A buffer with `contents`; none for nothing.
fn fill(
    device: &wgpu::Device,
    label: &str,
    contents: &[u8],
    usage: wgpu::BufferUsages,
) -> Option<wgpu::Buffer> {
    (!contents.is_empty()).then(|| {
        let label = Some(label);
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label, contents, usage })
    })
}

fn bytes(indices: &[u32]) -> Vec<u8> {
    indices.iter().flat_map(|index| index.to_ne_bytes()).collect()
}

/// Whether places near the target, counted from `origin`, keep their pixels in f32.
fn is_exact(origin: DVec3, order: &Order<'_>) -> bool {
    let state = order.view.eye.state();
    let pixels = order.view.points_per_unit(state.distance) * order.pixels_per_point;
    let target = state.target;
    // Anew for every step would be too often: where the target itself is the origin nothing is gained.
    target == origin || (target - origin).abs().max_element() * f64::from(f32::EPSILON) * pixels <= MOST_ERROR
}
