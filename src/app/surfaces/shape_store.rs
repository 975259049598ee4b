//! The shapes of the visible objects, kept as long as these stay the same. Large ones are computed by a thread of their own; the newest
//! request wins, and the shape of before is shown meanwhile.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use eframe::egui::Context;

use crate::app::lab::Lab;
use crate::document::{Content, Object, ObjectId, SurfaceColoring};
use crate::figure::scene::Scene;
use crate::figure::surfaces::{Shape, scene, shape};
use crate::figure::theme::Theme;

/// Up to so many triangles are computed at once, within a frame.
const AT_ONCE: usize = 12_000;

type Made = (Arc<Object>, &'static str, Arc<Shape>);

#[derive(Debug)]
struct Worker {
    requests: Sender<(Arc<Object>, Theme)>,
    results: Receiver<Made>,
}

/// The shapes and the scene of them all.
#[derive(Debug, Default)]
pub(super) struct ShapeStore {
    shapes: BTreeMap<ObjectId, Made>,
    asked: BTreeMap<ObjectId, (Arc<Object>, &'static str)>,
    worker: Option<Worker>,
    scene: Scene,
    version: u64,
    /// The objects in the scene, in drawing order.
    shown: Vec<ObjectId>,
    look: &'static str,
}

impl ShapeStore {
    /// The scene of the last frame.
    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Changes whenever the scene does.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    /// The shape of an object as it is drawn, with the object that it was made of.
    pub(super) fn shape(&self, object: ObjectId) -> Option<(&Arc<Object>, &Arc<Shape>)> {
        self.shapes.get(&object).map(|(object, _, shape)| (object, shape))
    }

    /// The shapes in the scene with their objects.
    pub(super) fn shown(&self) -> impl DoubleEndedIterator<Item = (&Object, &Shape)> + Clone {
        self.shown.iter().filter_map(|id| self.shapes.get(id)).map(|(object, _, shape)| (&**object, &**shape))
    }

    /// Whether shapes are being computed.
    pub(super) fn is_busy(&self) -> bool {
        !self.asked.is_empty()
    }

    /// Brings the shapes up to date with the document.
    pub(super) fn update(&mut self, lab: &Lab, ctx: &Context) {
        let mut changed = self.take_results();
        let visible: Vec<Arc<Object>> =
            lab.history.document().objects().iter().filter(|object| is_here(object)).cloned().collect();
        let ids: Vec<ObjectId> = visible.iter().map(|object| object.id).collect();
        self.asked.retain(|id, _| ids.contains(id));
        self.shapes.retain(|id, _| ids.contains(id));
        for object in visible {
            let is_made = |(made, look, _): &Made| Arc::ptr_eq(made, &object) && *look == lab.theme.name;
            if self.shapes.get(&object.id).is_some_and(is_made) {
                self.asked.remove(&object.id);
            } else if work(&object) <= AT_ONCE {
                self.asked.remove(&object.id);
                let Some(made) = shape(&object, &lab.theme) else { continue };
                self.shapes.insert(object.id, (object, lab.theme.name, Arc::new(made)));
                changed = true;
            } else {
                self.ask(object, &lab.theme, ctx);
            }
        }
        if changed || self.shown != ids || self.look != lab.theme.name {
            self.shown = ids;
            self.look = lab.theme.name;
            self.version += 1;
            self.scene = scene(self.shown().map(|(_, shape)| shape), &lab.theme);
        }
    }

    fn ask(&mut self, object: Arc<Object>, theme: &Theme, ctx: &Context) {
        let is_asked =
            |(asked, look): &(Arc<Object>, &str)| Arc::ptr_eq(asked, &object) && *look == theme.name;
        if self.asked.get(&object.id).is_some_and(is_asked) {
            return;
        }
        let worker = self.worker.get_or_insert_with(|| Worker::start(ctx.clone()));
        if worker.requests.send((object.clone(), theme.clone())).is_err() {
            // The thread ended unexpectedly; the next frame starts another.
            self.worker = None;
            return;
        }
        self.asked.insert(object.id, (object, theme.name));
    }

    fn take_results(&mut self) -> bool {
        let Some(worker) = &self.worker else { return false };
        let mut changed = false;
        while let Ok(made) = worker.results.try_recv() {
            let id = made.0.id;
            if self.asked.get(&id).is_some_and(|(asked, _)| Arc::ptr_eq(asked, &made.0)) {
                self.asked.remove(&id);
            }
            self.shapes.insert(id, made);
            changed = true;
        }
        changed
    }
}

impl Worker {
    fn start(ctx: Context) -> Self {
        let (requests, orders) = channel::<(Arc<Object>, Theme)>();
        let (sender, results) = channel();
        std::thread::spawn(move || {
            let mut waiting: BTreeMap<ObjectId, (Arc<Object>, Theme)> = BTreeMap::new();
            loop {
                if waiting.is_empty() {
                    let Ok((object, theme)) = orders.recv() else { return };
                    waiting.insert(object.id, (object, theme));
                }
                // The newest request for an object takes the place of older ones.
                waiting.extend(orders.try_iter().map(|(object, theme)| (object.id, (object, theme))));
                let Some((_, (object, theme))) = waiting.pop_first() else { continue };
                let Some(made) = shape(&object, &theme) else { continue };
                if sender.send((object, theme.name, Arc::new(made))).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        });
        Self { requests, results }
    }
}

/// Whether the object is shown in this room.
fn is_here(object: &Object) -> bool {
    object.visible && matches!(object.content, Content::Surface(_) | Content::Mesh(_))
}

/// About how many triangles have to be computed.
fn work(object: &Object) -> usize {
    match &object.content {
        Content::Surface(surface) => {
            let display = surface.display();
            let pieces = surface.surface().space().axes().each_ref().map(|axis| axis.breaks().len() - 1);
            let triangles = 2 * display.density * display.density * pieces[0] * pieces[1];
            // Curvatures take longer than points.
            if display.coloring == SurfaceColoring::Plain { triangles / 4 } else { triangles }
        }
        Content::Mesh(mesh) => 2 * mesh.refined_face_count(),
        _ => 0,
    }
}
