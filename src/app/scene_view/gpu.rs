//! A scene drawn by the GPU into a texture of its own, which egui shows. Buffers are filled once per version of the scene, the
//! texture is drawn anew only when something about the view has changed.

use eframe::egui::{Context, Id, Rect, TextureId, pos2, vec2};
use eframe::egui_wgpu::RenderState;
use glam::{DMat4, DVec3};
use wgpu::util::DeviceExt as _;

use crate::app::scene_view::geometry::{
    FACET_BYTES, Geometry, Kind, MARK_BYTES, Run, STROKE_BYTES, quad_indices,
};
use crate::figure::picture::Color;
use crate::figure::scene::{EyeView, Light, Scene};

/// What egui takes: it reads textures as sRGB values.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Floats of `Page` in the shader.
const PAGE_FLOATS: usize = 36;
/// Strokes and marks lie nearer by this part of the scene's diagonal: curves run within the surface, whose triangles are chords.
const NEARER: f64 = 0.002;
/// Places in f32 are exact enough if their last digit is less than this many pixels.
const MOST_ERROR: f64 = 0.1;

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
        let Some(texture) = gpu.draw(order, size) else {
            self.refused = Some(order.version);
            return None;
        };
        let extent = vec2(size[0] as f32, size[1] as f32);
        Some((texture, Rect::from_min_size(corner / scale, extent / scale)))
    }
}

pub(super) struct Gpu {
    pub(super) state: RenderState,
    samples: u32,
    pipelines: Pipelines,
    page: wgpu::Buffer,
    group: wgpu::BindGroup,
    buffers: Option<Buffers>,
    target: Option<Target>,
    drawn: Option<Drawn>,
    /// How often buffers were filled and pictures drawn.
    pub(super) counts: Counts,
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
}

struct Pipelines {
    opaque: wgpu::RenderPipeline,
    /// Translucent surfaces: their sides that look away, then those that look here.
    translucent: [wgpu::RenderPipeline; 2],
    /// Hidden by surfaces, and on top.
    strokes: [wgpu::RenderPipeline; 2],
    marks: [wgpu::RenderPipeline; 2],
}

struct Buffers {
    version: u64,
    origin: DVec3,
    facets: Option<(wgpu::Buffer, wgpu::Buffer)>,
    opaque: u32,
    indices: u32,
    strokes: Option<wgpu::Buffer>,
    marks: Option<wgpu::Buffer>,
    quads: Option<wgpu::Buffer>,
    runs: Vec<Run>,
}

struct Target {
    state: RenderState,
    size: [u32; 2],
    color: wgpu::TextureView,
    depth: wgpu::TextureView,
    /// Where samples become pixels; `color` itself with one sample.
    resolve: Option<wgpu::TextureView>,
    #[cfg(test)]
    shown: wgpu::Texture,
    id: TextureId,
}

impl Drop for Target {
    fn drop(&mut self) {
        self.state.renderer.write().free_texture(&self.id);
    }
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
            (page, group, Pipelines::new(&state.device, &layout, samples))
        });
        let (page, group, pipelines) = made?;
        let (buffers, target, drawn) = (None, None, None);
        let counts = Counts::default();
        Ok(Self { state, samples, pipelines, page, group, buffers, target, drawn, counts })
    }

    /// The texture of `size` pixels with the scene; `None` if the scene is too large for this GPU.
    pub(super) fn draw(&mut self, order: &Order<'_>, size: [u32; 2]) -> Option<TextureId> {
        let now = Drawn {
            version: order.version,
            view: *order.view,
            light: *order.light,
            ground: order.ground,
            size,
        };
        if self.drawn == Some(now)
            && let Some(target) = &self.target
        {
            return Some(target.id);
        }
        if self.buffers.as_ref().is_none_or(|buffers| !buffers.serve(order)) {
            self.buffers = None;
            self.buffers = Some(Buffers::new(order, &self.state.device)?);
            self.counts.fillings += 1;
        }
        if self.target.as_ref().is_none_or(|target| target.size != size) {
            self.target = None;
            self.target = Some(Target::new(&self.state, size, self.samples)?);
        }
        let (buffers, target) = (self.buffers.as_ref()?, self.target.as_ref()?);
        let page: Vec<u8> =
            page_floats(order, buffers.origin, size).iter().flat_map(|value| value.to_ne_bytes()).collect();
        self.state.queue.write_buffer(&self.page, 0, &page);
        self.render(buffers, target, order.ground);
        self.counts.drawings += 1;
        self.drawn = Some(now);
        Some(target.id)
    }

    fn render(&self, buffers: &Buffers, target: &Target, ground: Color) {
        let mut encoder =
            self.state.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
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
        pass.set_bind_group(0, &self.group, &[]);
        if let Some((facets, indices)) = &buffers.facets {
            pass.set_vertex_buffer(0, facets.slice(..));
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.set_pipeline(&self.pipelines.opaque);
            pass.draw_indexed(0..buffers.opaque, 0, 0..1);
            if buffers.opaque < buffers.indices {
                for pipeline in &self.pipelines.translucent {
                    pass.set_pipeline(pipeline);
                    pass.draw_indexed(buffers.opaque..buffers.indices, 0, 0..1);
                }
            }
        }
        if let Some(quads) = &buffers.quads {
            pass.set_index_buffer(quads.slice(..), wgpu::IndexFormat::Uint32);
            for run in &buffers.runs {
                let (vertices, pipelines) = match run.kind {
                    Kind::Stroke => (&buffers.strokes, &self.pipelines.strokes),
                    Kind::Mark => (&buffers.marks, &self.pipelines.marks),
                };
                let Some(vertices) = vertices else { continue };
                pass.set_pipeline(&pipelines[usize::from(run.on_top)]);
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.draw_indexed(6 * run.quads.start..6 * run.quads.end, 0, 0..1);
            }
        }
        drop(pass);
        self.state.queue.submit([encoder.finish()]);
    }

    /// Red, green, blue and opacity of the pixels that are shown.
    #[cfg(test)]
    pub(super) fn pixels(&self) -> Option<Vec<[u8; 4]>> {
        let target = self.target.as_ref()?;
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

/// What `make` makes, or what the GPU objects to.
fn checked<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
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

impl Pipelines {
    fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("scene"),
            source: wgpu::ShaderSource::Wgsl(include_str!("shader.wgsl").into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scene"),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
        let facet = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4];
        let stroke = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Unorm8x4, 4 => Float32x4, 5 => Float32
        ];
        let mark = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Unorm8x4, 2 => Unorm8x4, 3 => Float32x3, 4 => Float32x2
        ];
        let make = |entries: [&str; 2],
                    stride: u64,
                    attributes: &[wgpu::VertexAttribute],
                    cull_mode: Option<wgpu::Face>,
                    hides: bool,
                    compare: wgpu::CompareFunction| {
            // Surfaces are pushed back, so that lines within them are seen.
            let bias = if entries[0] == "facet" {
                wgpu::DepthBiasState { constant: 2, slope_scale: 1.0, clamp: 0.0 }
            } else {
                wgpu::DepthBiasState::default()
            };
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(entries[0]),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(entries[0]),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[Some(wgpu::VertexBufferLayout {
                        array_stride: stride,
                        step_mode: wgpu::VertexStepMode::Vertex,
                        attributes,
                    })],
                },
                primitive: wgpu::PrimitiveState { cull_mode, ..wgpu::PrimitiveState::default() },
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH,
                    depth_write_enabled: Some(hides),
                    depth_compare: Some(compare),
                    stencil: wgpu::StencilState::default(),
                    bias,
                }),
                multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entries[1]),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: FORMAT,
                        blend: (!hides).then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        use wgpu::CompareFunction::{Always, LessEqual};
        let surface = |cull, hides| make(["facet", "lit"], FACET_BYTES, &facet, cull, hides, LessEqual);
        let over = |entries, stride, attributes: &[wgpu::VertexAttribute]| {
            [LessEqual, Always].map(|compare| make(entries, stride, attributes, None, false, compare))
        };
        Self {
            opaque: surface(None, true),
            translucent: [wgpu::Face::Front, wgpu::Face::Back].map(|face| surface(Some(face), false)),
            strokes: over(["stroke", "inked"], STROKE_BYTES, &stroke),
            marks: over(["mark", "stamped"], MARK_BYTES, &mark),
        }
    }
}

impl Buffers {
    /// Whether the buffers still show the scene of `order`, exactly enough for its view.
    fn serve(&self, order: &Order<'_>) -> bool {
        self.version == order.version && is_exact(self.origin, order)
    }

    fn new(order: &Order<'_>, device: &wgpu::Device) -> Option<Self> {
        let middle = order.bounds.map_or(DVec3::ZERO, |(low, high)| low + (high - low) * 0.5);
        let origin = if is_exact(middle, order) { middle } else { order.view.eye.state().target };
        let geometry = Geometry::new(order.scene, origin);
        let indices = quad_indices(geometry.most_quads());
        let bytes =
            |indices: &[u32]| -> Vec<u8> { indices.iter().flat_map(|index| index.to_ne_bytes()).collect() };
        let (indices_of_facets, quads) = (bytes(&geometry.indices), bytes(&indices));
        let most = device.limits().max_buffer_size;
        let all = [&geometry.facets, &indices_of_facets, &geometry.strokes, &geometry.marks, &quads];
        if all.iter().any(|contents| contents.len() as u64 > most) {
            return None;
        }
        let fill = |label, contents: &[u8], usage| {
            (!contents.is_empty()).then(|| {
                device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(label),
                    contents,
                    usage,
                })
            })
        };
        let (vertex, index) = (wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX);
        checked(device, || Self {
            version: order.version,
            origin,
            facets: fill("facets", &geometry.facets, vertex).zip(fill("indices", &indices_of_facets, index)),
            opaque: geometry.opaque,
            indices: geometry.indices.len() as u32,
            strokes: fill("strokes", &geometry.strokes, vertex),
            marks: fill("marks", &geometry.marks, vertex),
            quads: fill("quads", &quads, index),
            runs: geometry.runs,
        })
        .ok()
    }
}

/// Whether places near the target, counted from `origin`, keep their pixels in f32.
fn is_exact(origin: DVec3, order: &Order<'_>) -> bool {
    let state = order.view.eye.state();
    let pixels = order.view.points_per_unit(state.distance) * order.pixels_per_point;
    let target = state.target;
    // Anew for every step would be too often: where the target itself is the origin nothing is gained.
    target == origin || (target - origin).abs().max_element() * f64::from(f32::EPSILON) * pixels <= MOST_ERROR
}

impl Target {
    fn new(state: &RenderState, size: [u32; 2], samples: u32) -> Option<Self> {
        checked(&state.device, || {
            let texture = |label, format, sample_count, usage| {
                state.device.create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage,
                    view_formats: &[],
                })
            };
            let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
            let mut shown_usage = attachment | wgpu::TextureUsages::TEXTURE_BINDING;
            if cfg!(test) {
                shown_usage |= wgpu::TextureUsages::COPY_SRC;
            }
            let shown = texture("scene", FORMAT, 1, shown_usage);
            let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
            let id = state.renderer.write().register_native_texture(
                &state.device,
                &view(&shown),
                wgpu::FilterMode::Linear,
            );
            let depth = view(&texture("depth", DEPTH, samples, attachment));
            let (color, resolve) = if samples > 1 {
                (view(&texture("samples", FORMAT, samples, attachment)), Some(view(&shown)))
            } else {
                (view(&shown), None)
            };
            Self {
                state: state.clone(),
                size,
                color,
                depth,
                resolve,
                #[cfg(test)]
                shown,
                id,
            }
        })
        .ok()
    }
}
