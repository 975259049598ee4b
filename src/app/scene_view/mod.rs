//! A scene in the window: painted on the GPU or, where there is none, by the processor; and the hands that move the eye.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | [`SceneView`]: a scene in a rectangle of the window |
//! | `hands.rs` | drags and the wheel move the eye |
//! | `grip.rs` | how a thing follows the pointer |
//! | `gizmo.rs` | the little axes in the corner, and the tools that turn the eye |
//! | `geometry.rs` | a scene as vertices for the GPU |
//! | `shader.wgsl` | triangles, strokes and marks on the GPU; the light is that of [`crate::figure::scene::Light`] |
//! | `gpu.rs` | draws a scene, if anything about it is new |
//! | `pipelines.rs`, `buffers.rs`, `target.rs` | the programs of the GPU, the scene in its memory, the texture that egui shows |
//! | `pace.rs`, `coarse.rs` | quick pictures of large scenes that move, where a processor plays GPU |
//! | `stand_in.rs` | the same by the processor, beside the window's thread |

mod buffers;
mod coarse;
mod geometry;
mod gizmo;
mod gpu;
mod grip;
mod hands;
mod pace;
mod pipelines;
mod stand_in;
mod target;
#[cfg(test)]
mod tests;

use eframe::egui::{self, Color32, Rect, Ui, pos2};
use glam::{DVec2, DVec3};

use crate::app::painter::{color32, paint_picture};
use crate::figure::picture::{Item, Label, Picture, Viewport};
use crate::figure::scene::{Eye, EyeView, Scene, SceneItem};
use crate::figure::theme::Theme;

pub(crate) use gizmo::{AXIS_INKS, axis_gizmo, eye_tools};
pub(crate) use gpu::offer as offer_gpu;
pub(crate) use grip::{Grip, Track, likeliest_axis, page_from_screen, screen_from_page};

/// Room around things that are fitted, in pt, on a large page.
const FIT_MARGIN: f64 = 40.0;

/// A scene in a rectangle of the window.
#[derive(Default)]
pub(crate) struct SceneView {
    /// Lower and upper corner of the scene with this version.
    bounds: Option<(u64, Option<(DVec3, DVec3)>)>,
    hands: hands::Hands,
    gpu: gpu::Slot,
    stand_in: stand_in::StandIn,
}

impl std::fmt::Debug for SceneView {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SceneView").field("bounds", &self.bounds).finish_non_exhaustive()
    }
}

/// The view of an eye through the rectangle.
pub(crate) fn view_through(eye: Eye, rect: Rect) -> EyeView {
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height())).max(DVec2::ONE);
    EyeView { eye, size }
}

impl SceneView {
    /// Paints `scene` as `view` sees it into `rect`, whose size is that of the view. `version` changes whenever the content of
    /// the scene does: only then is it read again.
    pub(crate) fn paint(
        &mut self,
        scene: &Scene,
        version: u64,
        view: &EyeView,
        theme: &Theme,
        rect: Rect,
        ui: &Ui,
    ) {
        if rect.width() < 1.0 || rect.height() < 1.0 {
            return;
        }
        if self.bounds.is_none_or(|(known, _)| known != version) {
            self.bounds = Some((version, scene.bounding_box()));
        }
        let ground = scene.background.unwrap_or(theme.background);
        let painter = ui.painter_at(rect);
        let order = gpu::Order {
            scene,
            version,
            bounds: self.bounds.and_then(|(_, bounds)| bounds),
            view,
            light: &theme.light,
            ground,
            pixels_per_point: f64::from(ui.pixels_per_point()),
        };
        if let Some((texture, pixels)) = self.gpu.paint(&order, rect, ui.ctx()) {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture, pixels, whole, Color32::WHITE);
            paint_picture(&labels(scene, view), &upright(view.size), rect, &painter);
        } else {
            painter.rect_filled(rect, 0.0, color32(ground));
            self.stand_in.paint(&order, rect, ui);
        }
    }

    /// Moves `eye` as the hands on `response`, the widget that fills the rectangle, ask for; says whether it moved. A drag with
    /// the middle button, or with Space held, orbits; with Shift, or with the right button, it pans. The wheel zooms
    /// at the pointer; a double click with the middle button fits.
    pub(crate) fn move_eye(&mut self, eye: &mut Eye, response: &egui::Response, ui: &Ui) -> bool {
        let before = *eye;
        if response.double_clicked_by(egui::PointerButton::Middle) {
            self.fit(eye, response.rect);
        } else {
            self.hands.move_eye(eye, response, ui);
        }
        *eye != before
    }

    /// Whether hands move the eye just now, so that a drag is not meant for things.
    pub(crate) fn is_moving_eye(&self) -> bool {
        self.hands.is_moving()
    }

    /// Brings the scene that was painted last whole into the rectangle; looks from the same side.
    pub(crate) fn fit(&self, eye: &mut Eye, rect: Rect) {
        if let Some((_, Some((low, high)))) = self.bounds {
            let view = view_through(*eye, rect);
            let margin = FIT_MARGIN.min(0.12 * view.size.min_element());
            *eye = eye.fitted(low, high, view.size, margin);
        }
    }
}

/// The viewport of a picture whose units are pt on a page of this size, the origin in the lower left corner.
fn upright(size: DVec2) -> Viewport {
    Viewport { center: size * 0.5, scale: 1.0, size }
}

/// The texts of the scene; nothing hides them.
fn labels(scene: &Scene, view: &EyeView) -> Picture {
    let mut picture = Picture::new(None);
    for layer in &scene.layers {
        let items = layer.items.iter().filter_map(|item| match item {
            SceneItem::Label(label) => {
                let page = view.project(label.at())?.page;
                Some(Item::Label(Label {
                    at: DVec2::new(page.x, view.size.y - page.y),
                    offset: label.offset,
                    text: label.text.clone(),
                    size: label.size,
                    color: label.color,
                    anchor: label.anchor,
                    math: label.math,
                }))
            }
            _ => None,
        });
        picture.push_layer(layer.name.clone(), items.collect());
    }
    picture
}
