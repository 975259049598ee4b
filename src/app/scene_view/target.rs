//! The texture that a scene is drawn into and egui shows.

use eframe::egui::TextureId;
use eframe::egui_wgpu::RenderState;

use crate::app::scene_view::gpu::checked;
use crate::app::scene_view::pipelines::{DEPTH, FORMAT};

pub(super) struct Target {
    state: RenderState,
    pub(super) size: [u32; 2],
    pub(super) color: wgpu::TextureView,
    pub(super) depth: wgpu::TextureView,
    /// Where samples become pixels; `color` itself with one sample.
    pub(super) resolve: Option<wgpu::TextureView>,
    #[cfg(test)]
    pub(super) shown: wgpu::Texture,
    pub(super) id: TextureId,
}

impl Drop for Target {
    fn drop(&mut self) {
        self.state.renderer.write().free_texture(&self.id);
    }
}

impl Target {
    pub(super) fn new(state: &RenderState, size: [u32; 2], samples: u32) -> Option<Self> {
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
