//! What lies under the pointer, and how a thing in space follows it.

use eframe::egui::{Pos2, Rect, vec2};
use glam::{DVec2, DVec3};

use crate::figure::scene::{EyeView, PointHit, Scene, SceneHit, SceneItem, TriangleHit, depth_slack};

/// An axis whose unit is shorter on the page than this part of one across the view is no axis to follow.
const LEAST_SHARE: f64 = 0.1;

/// The place on the page (pt, y down) of a place on the screen.
pub(crate) fn page_from_screen(rect: Rect, screen: Pos2) -> DVec2 {
    let page = screen - rect.min;
    DVec2::new(f64::from(page.x), f64::from(page.y))
}

/// The place on the screen of a place on the page.
pub(crate) fn screen_from_page(rect: Rect, page: DVec2) -> Pos2 {
    // Far outside the window f32 would be too coarse or overflow.
    let bound = |value: f64| value.clamp(-1e6, 1e6) as f32;
    rect.min + vec2(bound(page.x), bound(page.y))
}

/// What lies under a place of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Under {
    /// A mark: layer, item, and its index among the marks of the item.
    Mark(SceneHit<PointHit>),
    /// A surface: layer, item, and where on which triangle.
    Surface(SceneHit<TriangleHit>),
}

/// The mark whose rim is within `within` pt of `page` and that no surface hides, or else the surface there.
pub(crate) fn under(scene: &Scene, view: &EyeView, page: DVec2, within: f64) -> Option<Under> {
    let mark = scene.pick_mark(view, page, within).filter(|hit| {
        let Some(SceneItem::Points(points)) = scene.layers[hit.layer].items.get(hit.item) else {
            return false;
        };
        let place = view.project(points.points()[hit.hit.index]);
        points.on_top
            || place.is_some_and(|place| {
                let before = scene.pick_triangle(view, place.page);
                before.is_none_or(|surface| {
                    view.eye.depth(surface.hit.point) + depth_slack(scene) >= place.depth
                })
            })
    });
    mark.map(Under::Mark).or_else(|| scene.pick_triangle(view, page).map(Under::Surface))
}

/// Where a thing may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Track {
    /// Parallel to the page.
    Page,
    /// Along this direction.
    Axis(DVec3),
    /// In the plane with this normal.
    Plane(DVec3),
}

/// A thing that is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grip {
    /// Where the thing was.
    pub(crate) at: DVec3,
    /// Where on the page it was grabbed.
    pub(crate) page: DVec2,
}

impl Grip {
    /// How far the thing has moved with the pointer now at `page`; not at all where the track is seen end on.
    pub(crate) fn moved(&self, view: &EyeView, page: DVec2, track: Track) -> DVec3 {
        match track {
            Track::Page => view.drag(self.at, page - self.page),
            Track::Axis(axis) => {
                let along = |page| view.along_axis(self.at, axis, page);
                along(page).zip(along(self.page)).map_or(DVec3::ZERO, |(to, from)| axis * (to - from))
            }
            Track::Plane(normal) => {
                let on = |page| view.on_plane(self.at, normal, page);
                on(page).zip(on(self.page)).map_or(DVec3::ZERO, |(to, from)| to - from)
            }
        }
    }
}

/// The axis of coordinates whose picture at `at` runs most nearly as `motion` (pt, y down) does.
pub(crate) fn likeliest_axis(view: &EyeView, at: DVec3, motion: DVec2) -> DVec3 {
    let direction = motion.normalize_or(DVec2::X);
    let axes = view.eye.axes();
    let likeness = |axis: DVec3| {
        let picture = DVec2::new(axis.dot(axes.right), -axis.dot(axes.up));
        let towards = view.ray(view.project(at).map_or(view.size * 0.5, |seen| seen.page)).direction;
        let is_seen = axis.cross(towards).length() > LEAST_SHARE;
        if is_seen { picture.normalize_or_zero().dot(direction).abs() } else { -1.0 }
    };
    let all = [DVec3::X, DVec3::Y, DVec3::Z];
    all.into_iter().max_by(|&a, &b| likeness(a).total_cmp(&likeness(b))).unwrap_or(DVec3::Z)
}
