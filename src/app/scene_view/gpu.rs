//! A scene drawn by the GPU into a texture of its own, which egui shows. Buffers are filled once per version of the scene, the
//! texture is drawn anew only when something about the view has changed. Where a processor plays GPU, large scenes are drawn
//! quickly while they move.

use eframe::egui::{Context, Id, Rect, TextureId, pos2, vec2};
use eframe::egui_wgpu::RenderState;
use glam::{DMat4, DVec3};

use crate::app::scene_view::buffers::Buffers;
use crate::app::scene_view::geometry::Kind;
use crate::app::scene_view::pace::{self, Pace, Quality, REST};
use crate::app::scene_view::pipelines::{DEPTH, FORMAT, Pipelines};
use crate::app::scene_view::target::Target;
use crate::figure::picture::Color;
use crate::figure::scene::{EyeView, Light, Scene, SceneItem};

/// Floats of `Page` in the shader.
const PAGE_FLOATS: usize = 36;
/// Strokes and marks lie nearer by this part of the scene's diagonal: curves run within the surface, whose triangles are chords.
const NEARER: f64 = 0.002;
/// Longer runs of strokes are left out of quick pictures.
const MOST_QUICK_STROKES: u32 = 5_000;

/// What is to be drawn.
pub(super) struct Order<'a> {
    pub(super) scene: &'a Scene,
    pub(super) version: u64,
    pub(super) bounds: Option<(DVec3, DVec3)>,
    pub(super) view: &'a EyeView,
    pub(super) light: &'a Light,
    pub(super) ground: Color,
    pub(super) pixels_per_point: f64,
}

/// Keeps the GPU of the window for its views.
pub(crate) fn offer(ctx: &Context, state: Option<&RenderState>) {
    if let Some(state) = state {
        ctx.data_mut(|data| data.insert_temp(key(), state.clone()));
    }
}

fn key() -> Id {
    Id::unique("GPU of scenes")
}

/// The GPU part of a view, once it is known whether there is one.
#[derive(Default)]
pub(super) struct Slot {
    gpu: Option<Option<Gpu>>,
    /// The version of a scene that the GPU cannot take.
    refused: Option<u64>,
    pace: Pace,
}

impl Slot {
    /// The texture with the scene drawn, and the rectangle, on whole pixels, where it belongs; `None` if it must be drawn
    /// otherwise.
    pub(super) fn paint(
        &mut self,
        order: &Order<'_>,
        rect: Rect,
        ctx: &Context,
    ) -> Option<(TextureId, Rect)> {
        let gpu = self.gpu.get_or_insert_with(|| {
            let state: RenderState = ctx.data(|data| data.get_temp(key()))?;
            Gpu::new(state).ok()
        });
        let gpu = gpu.as_mut().filter(|_| self.refused != Some(order.version))?;
        let scale = order.pixels_per_point as f32;
        let corner = pos2((rect.left() * scale).round(), (rect.top() * scale).round());
        let most = gpu.state.device.limits().max_texture_dimension_2d;
        let size = [rect.width(), rect.height()].map(|side| ((side * scale).round() as u32).clamp(1, most));
        let quality = match gpu.work(order) {
            Some(work) => self.pace.quality(order, work, ctx.input(|input| input.time)),
            None => Quality::Fine,
        };
        if quality == Quality::Quick {
            ctx.request_repaint_after_secs(1.1 * REST as f32);
        }
        let Some(texture) = gpu.draw(order, size, quality) else {
            self.refused = Some(order.version);
            return None;
        };
        let extent = vec2(size[0] as f32, size[1] as f32);
        Some((texture, Rect::from_min_size(corner / scale, extent / scale)))
    }
}

pub(super) struct Gpu {
    pub(super) state: RenderState,
    page: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    fine: Way,
    /// Where a processor plays GPU, once it was needed.
    quick: Option<Way>,
    buffers: Option<Buffers>,
    drawn: Option<Drawn>,
    /// How often buffers were filled and pictures drawn.
    pub(super) counts: Counts,
}

/// A way to draw, with its picture.
struct Way {
    samples: u32,
    pipelines: Pipelines,
    target: Option<Target>,
}

impl Way {
    fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        Self { samples, pipelines: Pipelines::new(device, layout, samples), target: None }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) fillings: usize,
    pub(super) drawings: usize,
}

/// Everything on which the picture depends.
#[derive(Clone, Copy, PartialEq)]
struct Drawn {
    version: u64,
    view: EyeView,
    light: Light,
    ground: Color,
    size: [u32; 2],
    quality: Quality,
}

impl Gpu {
    /// An error if this GPU cannot do it.
    pub(super) fn new(state: RenderState) -> Result<Self, wgpu::Error> {
        let has_four =
            |format| state.adapter.get_texture_format_features(format).flags.sample_count_supported(4);
        let samples = if has_four(FORMAT) && has_four(DEPTH) { 4 } else { 1 };
        let made = checked(&state.device, || {
            let page = state.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("page"),
                size: (4 * PAGE_FLOATS) as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let layout = state.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("page"),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                }],
            });
            let group = state.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("page"),
                layout: &layout,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: page.as_entire_binding() }],
            });
            let fine = Way::new(&state.device, &layout, samples);
            (page, layout, group, fine)
        });
        let (page, layout, group, fine) = made?;
        let (quick, buffers, drawn) = (None, None, None);
        let counts = Counts::default();
        Ok(Self { state, page, layout, group, fine, quick, buffers, drawn, counts })
    }

    /// How much there is to draw if a processor plays GPU.
    fn work(&self, order: &Order<'_>) -> Option<usize> {
        let is_software = self.state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        is_software.then(|| work_of(order.scene))
    }

    /// The texture of `size` pixels with the scene; `None` if the scene is too large for this GPU.
    pub(super) fn draw(&mut self, order: &Order<'_>, size: [u32; 2], quality: Quality) -> Option<TextureId> {
        let now = Drawn {
            version: order.version,
            view: *order.view,
            light: *order.light,
            ground: order.ground,
            size,
            quality,
        };
        let way = match quality {
            Quality::Fine => &mut self.fine,
            Quality::Quick => self.quick.get_or_insert_with(|| Way::new(&self.state.device, &self.layout, 1)),
        };
        if self.drawn == Some(now)
            && let Some(target) = &way.target
        {
            return Some(target.id);
        }
        if self.buffers.as_ref().is_none_or(|buffers| !buffers.serve(order)) {
            self.buffers = None;
            self.buffers = Some(Buffers::new(order, quality, &self.state.device)?);
            self.counts.fillings += 1;
        }
        if way.target.as_ref().is_none_or(|target| target.size != size) {
            way.target = None;
            way.target = Some(Target::new(&self.state, size, way.samples)?);
        }
        let buffers = self.buffers.as_mut()?;
        buffers.prepare(order, quality, &self.state.device);
        let (way, buffers) = (&*way, &*buffers);
        let target = way.target.as_ref()?;
        let page: Vec<u8> =
            page_floats(order, buffers.origin, size).iter().flat_map(|value| value.to_ne_bytes()).collect();
        self.state.queue.write_buffer(&self.page, 0, &page);
        let passes = Passes { group: &self.group, pipelines: &way.pipelines, buffers, target, quality };
        let mut encoder =
            self.state.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        passes.record(&mut encoder, order.ground);
        self.state.queue.submit([encoder.finish()]);
        self.counts.drawings += 1;
        self.drawn = Some(now);
        Some(target.id)
    }

    /// Red, green, blue and opacity of the pixels that are shown.
    #[cfg(test)]
    pub(super) fn pixels(&self) -> Option<Vec<[u8; 4]>> {
        let target = match self.drawn?.quality {
            Quality::Fine => self.fine.target.as_ref()?,
            Quality::Quick => self.quick.as_ref()?.target.as_ref()?,
        };
        let [width, height] = target.size;
        let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.state.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder =
            self.state.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            target.shown.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            target.shown.size(),
        );
        self.state.queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        self.state.device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
        let bytes = buffer.slice(..).get_mapped_range().ok()?;
        let rows = bytes.chunks(row as usize).map(|row| &row[..4 * width as usize]);
        Some(rows.flat_map(|row| row.chunks(4)).map(|pixel| [0, 1, 2, 3].map(|k| pixel[k])).collect())
    }
}

/// What is drawn into the picture.
#[derive(Clone, Copy)]
struct Passes<'a> {
    group: &'a wgpu::BindGroup,
    pipelines: &'a Pipelines,
    buffers: &'a Buffers,
    target: &'a Target,
    quality: Quality,
}

impl Passes<'_> {
    fn record(&self, encoder: &mut wgpu::CommandEncoder, ground: Color) {
        let Passes { group, pipelines, buffers, target, quality } = *self;
        let opacity = f64::from(ground.a) / 255.0;
        let [r, g, b] = [ground.r, ground.g, ground.b].map(|part| f64::from(part) / 255.0 * opacity);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.color,
                resolve_target: target.resolve.as_ref(),
                depth_slice: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: opacity }),
                    store: match target.resolve {
                        Some(_) => wgpu::StoreOp::Discard,
                        None => wgpu::StoreOp::Store,
                    },
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, group, &[]);
        if let Some((facets, triangles)) = buffers.surfaces(quality) {
            pass.set_vertex_buffer(0, facets.slice(..));
            pass.set_index_buffer(triangles.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.set_pipeline(&pipelines.opaque);
            pass.draw_indexed(0..triangles.opaque, 0, 0..1);
            if triangles.opaque < triangles.count {
                for pipeline in &pipelines.translucent {
                    pass.set_pipeline(pipeline);
                    pass.draw_indexed(triangles.opaque..triangles.count, 0, 0..1);
                }
            }
        }
        if let Some(quads) = &buffers.quads {
            pass.set_index_buffer(quads.slice(..), wgpu::IndexFormat::Uint32);
            for run in &buffers.runs {
                let is_long = run.kind == Kind::Stroke && run.quads.len() as u32 > MOST_QUICK_STROKES;
                if quality == Quality::Quick && is_long {
                    continue;
                }
                let (vertices, pipelines) = match run.kind {
                    Kind::Stroke => (&buffers.strokes, &pipelines.strokes),
                    Kind::Mark => (&buffers.marks, &pipelines.marks),
                };
                let Some(vertices) = vertices else { continue };
                pass.set_pipeline(&pipelines[usize::from(run.on_top)]);
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.draw_indexed(6 * run.quads.start..6 * run.quads.end, 0, 0..1);
            }
        }
    }
}

/// Triangles and segments of the scene.
fn work_of(scene: &Scene) -> usize {
    let mut counts = (0, 0);
    for item in scene.layers.iter().flat_map(|layer| &layer.items) {
        match item {
            SceneItem::Triangles(surface) => counts.0 += surface.triangles().len(),
            SceneItem::Line(line) => counts.1 += line.points().len(),
            SceneItem::Points(_) | SceneItem::Label(_) => {}
        }
    }
    pace::work(counts.0, counts.1)
}

/// What `make` makes, or what the GPU objects to.
pub(super) fn checked<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validity = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let objections = [pollster::block_on(validity.pop()), pollster::block_on(memory.pop())];
    objections.into_iter().flatten().next().map_or(Ok(made), Err)
}

/// `Page` of the shader.
fn page_floats(order: &Order<'_>, origin: DVec3, size: [u32; 2]) -> [f32; PAGE_FLOATS] {
    let (view, eye) = (order.view, order.view.eye);
    let target = eye.state().target;
    let (low, high) = order.bounds.unwrap_or((target, target));
    let diagonal = low.distance(high);
    let (near, far) = eye.depth_range(low, high);
    let [width, height] = size.map(f64::from);
    let lens = eye.clip_from_view(view.size.x / view.size.y, near, far);
    let pixels_per_point = height / view.size.y;
    let pixels_per_unit = view.points_per_unit(eye.state().distance) * pixels_per_point;
    let matrix = (eye.view_from_world() * DMat4::from_translation(origin)).as_mat4().to_cols_array();
    let light = order.light;
    let lamp = Light::fill_direction();
    let rest = [
        [lens.x_axis.x, lens.y_axis.y, near, far],
        [width, height, pixels_per_point, f64::from(u8::from(eye.state().orthographic))],
        [NEARER * diagonal, pixels_per_unit, 0.0, 0.0],
        [light.ambient, light.head, light.fill, light.shine],
        [lamp.x, lamp.y, lamp.z, 0.0],
    ];
    let mut floats = [0.0; PAGE_FLOATS];
    floats[..16].copy_from_slice(&matrix);
    for (place, value) in floats[16..].iter_mut().zip(rest.as_flattened()) {
        *place = *value as f32;
    }
    floats
}
