//! The shapes of the visible objects, kept as long as these stay the same. Large ones are computed beside the window's thread, one after the
//! other; the newest request wins, and the shape of before is shown meanwhile.

use std::collections::BTreeMap;
use std::sync::Arc;

use eframe::egui::Context;

use crate::app::lab::Lab;
use crate::app::worker::Worker;
use crate::core::progress::{Stopped, Watcher};
use crate::document::{Content, Object, ObjectId, SurfaceColoring};
use crate::figure::scene::Scene;
use crate::figure::surfaces::{Shape, scene, shape, shape_watched};
use crate::figure::theme::Theme;

/// Up to so many triangles are computed at once, within a frame.
const AT_ONCE: usize = 12_000;

type Request = (Arc<Object>, Theme);

/// An object, the look, and what was made of them.
type Made = (Arc<Object>, &'static str, Arc<Shape>);

/// The shapes and the scene of them all.
#[derive(Debug)]
pub(super) struct ShapeStore {
    shapes: BTreeMap<ObjectId, Made>,
    worker: Worker<Request, Result<Option<Shape>, Stopped>>,
    asked: Option<Arc<Object>>,
    /// What nobody wanted to wait for.
    given_up: Option<Arc<Object>>,
    scene: Scene,
    version: u64,
    /// The objects in the scene, in drawing order.
    shown: Vec<ObjectId>,
    look: &'static str,
}

impl Default for ShapeStore {
    fn default() -> Self {
        let work = |(object, theme): &Request, watcher: &dyn Watcher| shape_watched(object, theme, watcher);
        Self {
            shapes: BTreeMap::new(),
            worker: Worker::new(work),
            asked: None,
            given_up: None,
            scene: Scene::default(),
            version: 0,
            shown: Vec::new(),
            look: "",
        }
    }
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

    /// Whether there is nothing to show.
    pub(super) fn is_empty(&self) -> bool {
        self.shown.is_empty()
    }

    /// The part done and the seconds since the start, while a shape is computed.
    pub(super) fn progress(&self) -> Option<(f32, f32)> {
        self.worker.progress().map(|(part, time)| (part, time.as_secs_f32()))
    }

    /// Gives up the running request; it is not made again until the object changes or [`Self::again`] is called.
    pub(super) fn cancel(&mut self) {
        self.worker.cancel();
        self.given_up = self.asked.take().or(self.given_up.take());
    }

    /// The object that is not drawn as it is because its shape was given up.
    pub(super) fn given_up(&self) -> Option<&Arc<Object>> {
        self.given_up.as_ref()
    }

    /// Makes the request that was given up again.
    pub(super) fn again(&mut self) {
        self.given_up = None;
    }

    /// Brings the shapes up to date with the document.
    pub(super) fn update(&mut self, lab: &Lab, ctx: &Context) {
        let mut changed = self.take_result();
        let visible: Vec<Arc<Object>> =
            lab.history.document().objects().iter().filter(|object| is_here(object)).cloned().collect();
        let ids: Vec<ObjectId> = visible.iter().map(|object| object.id).collect();
        self.shapes.retain(|id, _| ids.contains(id));
        let mut waiting: Vec<Arc<Object>> = Vec::new();
        for object in visible {
            let is_made = |(made, look, _): &Made| Arc::ptr_eq(made, &object) && *look == lab.theme.name;
            if self.shapes.get(&object.id).is_some_and(is_made) {
                continue;
            }
            if work(&object) <= AT_ONCE {
                let Some(made) = shape(&object, &lab.theme) else { continue };
                self.shapes.insert(object.id, (object, lab.theme.name, Arc::new(made)));
                changed = true;
            } else {
                waiting.push(object);
            }
        }
        let is_waiting = |object: &Arc<Object>| waiting.iter().any(|other| Arc::ptr_eq(other, object));
        self.given_up = self.given_up.take().filter(is_waiting);
        let is_still_wanted = self.asked.as_ref().is_some_and(is_waiting);
        if !is_still_wanted {
            let wanted = waiting
                .into_iter()
                .find(|object| self.given_up.as_ref().is_none_or(|given_up| !Arc::ptr_eq(given_up, object)));
            match &wanted {
                Some(object) => {
                    self.worker.ask((object.clone(), lab.theme.clone()), lab.at_once, ctx);
                    changed |= lab.at_once && self.take_result();
                }
                None if self.asked.is_some() => self.worker.cancel(),
                None => {}
            }
            self.asked = wanted;
        }
        if changed || self.shown != ids || self.look != lab.theme.name {
            self.shown = ids;
            self.look = lab.theme.name;
            self.version += 1;
            // The panels, shown before the canvas, tell of the shapes too.
            ctx.request_repaint();
            self.scene = scene(self.shown().map(|(_, shape)| shape), &lab.theme);
        }
    }

    fn take_result(&mut self) -> bool {
        let Some(((object, theme), Ok(Some(shape)))) = self.worker.take() else { return false };
        if self.asked.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, &object)) {
            self.asked = None;
        }
        self.shapes.insert(object.id, (object, theme.name, Arc::new(shape)));
        true
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::mesh_shapes;
    use crate::document::{Document, Edit, MeshDisplay, MeshObject, View};

    /// A lab with a sheet that is refined beside the window's thread.
    fn lab(level: usize) -> Lab {
        let sheet = mesh_shapes::open_sheet(40, 40).unwrap();
        let mesh = MeshObject::from_cage(sheet, MeshDisplay::default()).unwrap().with_level(level).unwrap();
        let mut document = Document::new();
        document.apply(&Edit::AddObject { name: "Sheet".into(), content: Content::Mesh(mesh) }).unwrap();
        Lab::new(document, View::default())
    }

    fn faces(store: &ShapeStore) -> Option<usize> {
        store.shown().next().map(|(_, shape)| shape.steps.last().unwrap().mesh.counts()[2] as usize)
    }

    #[test]
    fn the_last_picture_stays_when_a_large_one_is_given_up_and_comes_when_asked_again() {
        let (ctx, mut store, mut lab) = (Context::default(), ShapeStore::default(), lab(1));
        lab.at_once = true;
        store.update(&lab, &ctx);
        assert_eq!(faces(&store), Some(6400), "made at once for tests");
        lab.at_once = false;
        let object = lab.history.document().objects()[0].clone();
        let finer = object.mesh().unwrap().with_level(2).unwrap();
        lab.edit(Edit::SetContent {
            object: object.id,
            content: Content::Mesh(finer),
            label: "Finer".into(),
        });
        store.update(&lab, &ctx);
        store.cancel();
        assert!(store.given_up().is_some(), "given up");
        store.update(&lab, &ctx);
        assert_eq!(faces(&store), Some(6400), "the picture of before");
        store.again();
        lab.at_once = true;
        store.update(&lab, &ctx);
        assert_eq!((faces(&store), store.given_up().is_some()), (Some(25_600), false), "the new one");
    }
}
