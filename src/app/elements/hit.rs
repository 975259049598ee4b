//! What lies under the pointer on the canvas.

use std::collections::BTreeSet;

use eframe::egui::{Pos2, Rect};
use glam::DVec2;

use crate::app::painter::{screen_from_world, world_from_screen};
use crate::document::{HandleId, Membrane, Shape};
use crate::figure::elements::boundary;
use crate::figure::picture::Viewport;

/// Pixels within which a handle is taken.
const HANDLE_REACH: f32 = 10.0;
/// Pixels within which the boundary of a part is taken.
const EDGE_REACH: f64 = 6.0;

/// The thing under the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Target {
    /// Empty canvas.
    #[default]
    Nothing,
    /// A handle.
    Handle(HandleId),
    /// The boundary of a part, with the index of the side next to the pointer.
    Edge(usize, usize),
}

impl Target {
    /// The handle that is dragged: for a boundary the one that moves the whole part.
    pub(super) fn handle(self) -> Option<HandleId> {
        match self {
            Self::Nothing => None,
            Self::Handle(id) => Some(id),
            Self::Edge(part, _) => Some(HandleId { part, index: 0 }),
        }
    }
}

/// The target at `pointer`: the nearest handle, of near ones a selected one, then the boundary of a part.
pub(super) fn target_at(
    membrane: &Membrane,
    selected: &BTreeSet<HandleId>,
    viewport: &Viewport,
    rect: Rect,
    pointer: Pos2,
) -> Target {
    let mut best: Option<(f32, HandleId)> = None;
    for (id, _, at) in membrane.handles() {
        let distance = screen_from_world(viewport, rect, at).distance(pointer);
        // Handles of a part lie over each other when it is small on the screen: the selected one first.
        let rank = distance - if selected.contains(&id) { HANDLE_REACH } else { 0.0 };
        if distance <= HANDLE_REACH && best.is_none_or(|(least, _)| rank <= least) {
            best = Some((rank, id));
        }
    }
    if let Some((_, id)) = best {
        return Target::Handle(id);
    }
    let world = world_from_screen(viewport, rect, pointer);
    let mut best: Option<(f64, Target)> = None;
    for (part, found) in membrane.parts().iter().enumerate() {
        let nearest = match &found.shape {
            Shape::HalfPlane { point, normal } => {
                Some(((world - *point).dot(normal.normalize_or_zero()).abs(), 0))
            }
            shape => nearest_side(&boundary(shape), world),
        };
        if let Some((distance, side)) = nearest
            && distance * viewport.scale <= EDGE_REACH
            && best.is_none_or(|(least, _)| distance < least)
        {
            best = Some((distance, Target::Edge(part, side)));
        }
    }
    best.map_or(Target::Nothing, |(_, target)| target)
}

/// Distance of `place` to a closed polygon, and its nearest side.
fn nearest_side(polygon: &[DVec2], place: DVec2) -> Option<(f64, usize)> {
    let count = polygon.len();
    let distance = |side: usize| {
        let (from, to) = (polygon[side], polygon[(side + 1) % count]);
        let run = to - from;
        let share = ((place - from).dot(run) / run.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        place.distance(from + run * share)
    };
    (0..count).map(|side| (distance(side), side)).min_by(|a, b| a.0.total_cmp(&b.0))
}
