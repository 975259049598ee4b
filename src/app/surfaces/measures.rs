//! Area and enclosed volume of the selected surface, computed beside the window's thread.

use std::sync::Arc;

use eframe::egui::Context;

use crate::app::lab::Lab;
use crate::app::worker::Worker;
use crate::core::progress::Watcher;
use crate::core::surface::SurfaceError;
use crate::document::{Object, SurfaceObject};
use crate::figure::composition::short_number;

/// Error of the area as a part of the square of the size.
const AREA: f64 = 1e-4;

/// What is known of the surface that was measured last.
#[derive(Debug)]
pub(super) struct Measures {
    worker: Worker<Arc<Object>, Option<String>>,
    asked: Option<Arc<Object>>,
    known: Option<(Arc<Object>, String)>,
}

impl Default for Measures {
    fn default() -> Self {
        Self { worker: Worker::new(measure), asked: None, known: None }
    }
}

impl Measures {
    /// The sentence for `object`, if it is known already. While somebody drags it waits.
    pub(super) fn of(&mut self, object: &Arc<Object>, lab: &Lab, ctx: &Context) -> Option<&str> {
        let is_known = self.known.as_ref().is_some_and(|(known, _)| is_same(known, object));
        let is_asked = self.asked.as_ref().is_some_and(|asked| is_same(asked, object));
        if !is_known && !is_asked && !lab.history.is_interacting() {
            self.worker.ask(object.clone(), lab.at_once, ctx);
            self.asked = Some(object.clone());
        }
        if let Some((object, Some(text))) = self.worker.take() {
            self.known = Some((object, text));
        }
        let (known, text) = self.known.as_ref()?;
        is_same(known, object).then_some(text)
    }
}

/// Whether both have the same surface; they may be shown differently.
fn is_same(a: &Arc<Object>, b: &Arc<Object>) -> bool {
    Arc::ptr_eq(a, b) || a.surface().map(SurfaceObject::surface) == b.surface().map(SurfaceObject::surface)
}

/// The sentence; `None` if the watcher stopped it.
fn measure(object: &Arc<Object>, watcher: &dyn Watcher) -> Option<String> {
    let surface = object.surface()?.surface();
    let size = surface.size();
    let mut text = match surface.area_watched(AREA * size * size, watcher) {
        Ok(area) => format!("Area {}", short_number(area)),
        Err(SurfaceError::Stopped(_)) => return None,
        Err(error) => format!("Area: {error}"),
    };
    match surface.enclosed_volume_watched(watcher) {
        Ok(volume) => {
            let side = if volume < 0.0 { "inwards" } else { "outwards" };
            text.push_str(&format!("\nEnclosed volume {}\nNormals point {side}", short_number(volume.abs())));
        }
        Err(SurfaceError::Stopped(_)) => return None,
        // An open surface encloses nothing.
        Err(_) => {}
    }
    Some(text)
}
