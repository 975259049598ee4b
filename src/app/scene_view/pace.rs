//! When a picture may be a quick one: on a processor that plays GPU, while a large scene moves.

use crate::app::scene_view::gpu::Order;
use crate::figure::scene::EyeView;

/// Seconds without a change after which the fine picture is drawn.
pub(super) const REST: f64 = 0.3;
/// Scenes with less work are always drawn finely. The unit is a triangle.
const LEAST_WORK: usize = 50_000;
/// What a segment of a line costs.
const STROKE: usize = 4;

/// How finely a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quality {
    /// Every triangle, smooth edges.
    Fine,
    /// Fewer triangles, no meshes of lines, steps at edges.
    Quick,
}

/// Follows what was asked for from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// Version and view of the last frame, and when they were new.
    last: Option<(u64, EyeView, f64)>,
    /// Whether they came soon after others.
    moving: bool,
}

impl Pace {
    /// The quality for the frame at `now`, in seconds.
    pub(super) fn quality(&mut self, order: &Order<'_>, work: usize, now: f64) -> Quality {
        match self.last {
            Some((version, view, since)) if version == order.version && view == *order.view => {
                self.moving &= now - since < REST;
            }
            last => {
                self.moving = last.is_some_and(|(_, _, since)| now - since < REST);
                self.last = Some((order.version, *order.view, now));
            }
        }
        if self.moving && work >= LEAST_WORK { Quality::Quick } else { Quality::Fine }
    }
}

/// The work of a scene with so many triangles and segments of lines.
pub(super) fn work(triangles: usize, segments: usize) -> usize {
    triangles + STROKE * segments
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::figure::picture::Color;
    use crate::figure::scene::{Eye, Scene};
    use crate::figure::theme::Theme;

    #[test]
    fn pictures_are_quick_only_between_changes_that_follow_each_other() {
        let (scene, light) = (Scene::new(None), Theme::light().light);
        let mut pace = Pace::default();
        let mut eye = Eye::default();
        let mut frame = |turn: f64, work: usize, now: f64| {
            eye = eye.orbited(turn, 0.0);
            let view = EyeView { eye, size: DVec2::new(400.0, 300.0) };
            let ground = Color::hex(0);
            let order = Order {
                scene: &scene,
                version: 1,
                bounds: None,
                view: &view,
                light: &light,
                ground,
                pixels_per_point: 1.0,
            };
            pace.quality(&order, work, now)
        };
        let large = 1_000_000;
        assert_eq!(frame(0.0, large, 0.0), Quality::Fine, "the first");
        assert_eq!(frame(0.1, large, 5.0), Quality::Fine, "a single step");
        assert_eq!(frame(0.1, large, 5.1), Quality::Quick, "another soon after");
        assert_eq!(frame(0.0, large, 5.2), Quality::Quick, "still waiting");
        assert_eq!(frame(0.1, large, 5.3), Quality::Quick, "moving on");
        assert_eq!(frame(0.0, large, 5.31 + REST), Quality::Fine, "at rest");
        assert_eq!(frame(0.1, 100, 5.7), Quality::Fine, "a small scene");
    }
}
