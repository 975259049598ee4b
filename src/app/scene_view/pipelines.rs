//! The programs of the GPU: surfaces, strokes and marks.

use crate::app::scene_view::geometry::{FACET_BYTES, MARK_BYTES, STROKE_BYTES};

/// What egui takes: it reads textures as sRGB values.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(super) struct Pipelines {
    pub(super) opaque: wgpu::RenderPipeline,
    /// Translucent surfaces: their sides that look away, then those that look here.
    pub(super) translucent: [wgpu::RenderPipeline; 2],
    /// Hidden by surfaces, and on top.
    pub(super) strokes: [wgpu::RenderPipeline; 2],
    pub(super) marks: [wgpu::RenderPipeline; 2],
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
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
