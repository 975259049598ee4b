//! The orbit camera of scenes: where it stands, where a point of space appears, what lies under a point of the page.
//!
//! Right-handed coordinates, z up. The axes of the view are x to the right, y up and z *towards* the eye. Pages count in pt
//! from the upper left corner, y down. The *depth* of a point is its distance from the plane through the eye that is
//! parallel to the page; points in front of the eye have positive depth.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::{DMat4, DVec2, DVec3, DVec4};

use crate::document::EyeState;
use crate::figure::error::FigureError;

/// In perspective, points nearer to the eye than this part of its distance from the target are not seen.
const NEAR: f64 = 1e-3;
/// A line whose direction differs less than this (sine of the angle) from that of the ray has no nearest point.
const PARALLEL: f64 = 1e-4;

/// A camera with valid numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eye(EyeState);

/// Usual directions to look from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From −y: x to the right, z up.
    Front,
    /// From +z: x to the right, y up.
    Top,
    /// From +x: y to the right, z up.
    Right,
    /// From (1, −1, 1): the axes are equally foreshortened.
    Isometric,
}

impl StandardView {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 4] = [Self::Front, Self::Top, Self::Right, Self::Isometric];

    /// Yaw and pitch.
    pub fn angles(self) -> (f64, f64) {
        match self {
            Self::Front => (-FRAC_PI_2, 0.0),
            Self::Top => (-FRAC_PI_2, FRAC_PI_2),
            Self::Right => (0.0, 0.0),
            Self::Isometric => (-FRAC_PI_4, FRAC_1_SQRT_2.atan()),
        }
    }
}

/// Directions of the view in the world: an orthonormal, right-handed triple.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewAxes {
    /// To the right on the page.
    pub right: DVec3,
    /// Up on the page.
    pub up: DVec3,
    /// From the target to the eye.
    pub towards: DVec3,
}

impl Eye {
    /// The eye with these numbers.
    ///
    /// # Errors
    ///
    /// `OutsideInterval`.
    pub fn new(state: EyeState) -> Result<Self, FigureError> {
        state.check()?;
        Ok(Self(state))
    }

    /// The numbers, to be saved.
    pub const fn state(&self) -> &EyeState {
        &self.0
    }

    /// Where the eye stands.
    pub fn position(&self) -> DVec3 {
        self.0.target + self.axes().towards * self.0.distance
    }

    /// The directions of the view.
    pub fn axes(&self) -> ViewAxes {
        let ((sy, cy), (sp, cp)) = (self.0.yaw.sin_cos(), self.0.pitch.sin_cos());
        ViewAxes {
            right: DVec3::new(-sy, cy, 0.0),
            up: DVec3::new(-sp * cy, -sp * sy, cp),
            towards: DVec3::new(cp * cy, cp * sy, sp),
        }
    }

    /// The eye turned about its target. Pitch stops at ±π/2, straight above and below; yaw goes round.
    #[must_use]
    pub fn orbited(&self, yaw: f64, pitch: f64) -> Self {
        let state = self.0;
        let (yaw, pitch) = (state.yaw + yaw, state.pitch + pitch);
        if !(yaw.is_finite() && pitch.is_finite()) {
            return *self;
        }
        let yaw = (yaw + PI).rem_euclid(TAU) - PI;
        Self(EyeState { yaw, pitch: pitch.clamp(-FRAC_PI_2, FRAC_PI_2), ..state })
    }

    /// The same target and distance seen from another side.
    #[must_use]
    pub fn turned_to(&self, view: StandardView) -> Self {
        let (yaw, pitch) = view.angles();
        Self(EyeState { yaw, pitch, ..self.0 })
    }

    /// The same view in the other projection; things at the depth of the target keep their size.
    #[must_use]
    pub const fn with_orthographic(&self, orthographic: bool) -> Self {
        Self(EyeState { orthographic, ..self.0 })
    }

    /// The eye that looks from the same side at the middle of the box between `low` and `high`, as near as it can with the
    /// whole box on a page of `size` pt inside a `margin` in pt. Distances stop at the limits of [`EyeState`]; a box without
    /// extent is looked at from the present distance, one that is not finite changes nothing.
    #[must_use]
    pub fn fitted(&self, low: DVec3, high: DVec3, size: DVec2, margin: f64) -> Self {
        self.fitted_to(corners(low, high), size, margin)
    }

    /// As [`Self::fitted`] with points in place of the corners of a box: looks at the middle of the smallest box around them.
    #[must_use]
    pub fn fitted_to(
        &self,
        points: impl IntoIterator<Item = DVec3, IntoIter: Clone>,
        size: DVec2,
        margin: f64,
    ) -> Self {
        let points = points.into_iter();
        if !points.clone().all(|point| point.is_finite()) {
            return *self;
        }
        let wide = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.clone().fold(wide, |(low, high), point| (low.min(point), high.max(point)));
        let middle = low + (high - low) * 0.5;
        let room = (size - DVec2::splat(2.0 * margin)).max(size * 0.1);
        let slope = room / size.y * self.half_height_slope();
        let axes = self.axes();
        // A point at (x, y, z) from the middle is inside if |x| <= (distance − z)·slope, without z in parallel projection.
        let needed = points.map(|point| {
            let point = point - middle;
            let z = if self.0.orthographic { 0.0 } else { point.dot(axes.towards) };
            let across = DVec2::new(point.dot(axes.right), point.dot(axes.up)).abs() / slope;
            // A point straight before the eye must not be too near to be seen.
            (across.max_element() + z).max(z * (1.0 + 10.0 * NEAR))
        });
        let needed = needed.fold(0.0, f64::max);
        let distance = if needed > 0.0 { needed } else { self.0.distance };
        let distance = distance.clamp(EyeState::MIN_DISTANCE, EyeState::MAX_DISTANCE);
        Self::new(EyeState { target: middle, distance, ..self.0 }).unwrap_or(*self)
    }

    /// From the world to the axes of the view, the eye in the origin.
    pub fn view_from_world(&self) -> DMat4 {
        let ViewAxes { right, up, towards } = self.axes();
        let at = self.position();
        DMat4::from_cols(
            DVec4::new(right.x, up.x, towards.x, 0.0),
            DVec4::new(right.y, up.y, towards.y, 0.0),
            DVec4::new(right.z, up.z, towards.z, 0.0),
            DVec4::new(-right.dot(at), -up.dot(at), -towards.dot(at), 1.0),
        )
    }

    /// From the axes of the view to clip space: x and y from −1 to 1, y up, z from 0 at depth `near` to 1 at depth `far`.
    pub fn clip_from_view(&self, aspect: f64, near: f64, far: f64) -> DMat4 {
        let height = self.half_height_slope();
        let scale = DVec2::new(1.0 / (height * aspect), 1.0 / height);
        if self.0.orthographic {
            let scale = scale / self.0.distance;
            let thin = 1.0 / (far - near);
            return DMat4::from_cols(
                DVec4::new(scale.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, scale.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -thin, 0.0),
                DVec4::new(0.0, 0.0, -near * thin, 1.0),
            );
        }
        let thin = far / (far - near);
        DMat4::from_cols(
            DVec4::new(scale.x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, scale.y, 0.0, 0.0),
            DVec4::new(0.0, 0.0, -thin, -1.0),
            DVec4::new(0.0, 0.0, -near * thin, 0.0),
        )
    }

    /// Depths between which the box lies, with a little room; in perspective both are positive.
    pub fn depth_range(&self, low: DVec3, high: DVec3) -> (f64, f64) {
        let depths = corners(low, high).map(|corner| self.depth(corner));
        let near = depths.iter().copied().fold(f64::INFINITY, f64::min);
        let far = depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let room = 0.01 * (far - near) + 1e-6 * self.0.distance;
        let (near, far) = (near - room, far + room);
        if self.0.orthographic { (near, far) } else { (near.max(self.near()), far.max(2.0 * self.near())) }
    }

    /// Depth of a point.
    pub fn depth(&self, world: DVec3) -> f64 {
        self.0.distance - (world - self.0.target).dot(self.axes().towards)
    }

    /// Least depth that is seen; none in parallel projection.
    pub(crate) fn near(&self) -> f64 {
        if self.0.orthographic { f64::NEG_INFINITY } else { NEAR * self.0.distance }
    }

    fn half_height_slope(&self) -> f64 {
        (0.5 * self.0.field_of_view).tan()
    }
}

/// The eight corners of a box.
fn corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|bits| {
        let side = |bit: usize, low: f64, high: f64| if bits >> bit & 1 == 0 { low } else { high };
        DVec3::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z))
    })
}

/// A half-line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

/// Where a point of space appears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Place on the page in pt.
    pub page: DVec2,
    /// Depth in world units.
    pub depth: f64,
}

/// An eye that looks through a page of a certain size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeView {
    /// The eye.
    pub eye: Eye,
    /// Width and height of the page in pt, both positive.
    pub size: DVec2,
}

impl EyeView {
    /// Length in pt on the page of one world unit at this depth, across the direction of view.
    pub fn points_per_unit(&self, depth: f64) -> f64 {
        let state = self.eye.state();
        let depth = if state.orthographic { state.distance } else { depth };
        0.5 * self.size.y / (self.eye.half_height_slope() * depth)
    }

    /// Where a point appears; `None` if it is beside or behind the eye.
    pub fn project(&self, world: DVec3) -> Option<Projected> {
        let axes = self.eye.axes();
        let from_target = world - self.eye.0.target;
        let depth = self.eye.0.distance - from_target.dot(axes.towards);
        // Written so that a depth that is not a number gives nothing.
        (depth > self.eye.near()).then(|| {
            let across = DVec2::new(from_target.dot(axes.right), -from_target.dot(axes.up));
            Projected { page: self.size * 0.5 + across * self.points_per_unit(depth), depth }
        })
    }

    /// The point of space at a place of the page and a depth: the inverse of [`Self::project`].
    pub fn world_from_page(&self, page: DVec2, depth: f64) -> DVec3 {
        let axes = self.eye.axes();
        let across = (page - self.size * 0.5) / self.points_per_unit(depth);
        let state = self.eye.0;
        state.target + axes.right * across.x - axes.up * across.y + axes.towards * (state.distance - depth)
    }

    /// All that lies under a place of the page, from the eye (in parallel projection: from the depth 0) onwards.
    pub fn ray(&self, page: DVec2) -> Ray {
        let direction = if self.eye.0.orthographic {
            -self.eye.axes().towards
        } else {
            (self.world_from_page(page, self.eye.0.distance) - self.eye.position()).normalize_or_zero()
        };
        let origin =
            if self.eye.0.orthographic { self.world_from_page(page, 0.0) } else { self.eye.position() };
        Ray { origin, direction }
    }

    /// How a thing at `at` moves in the plane parallel to the page when its picture moves by `motion` (pt, y down).
    pub fn drag(&self, at: DVec3, motion: DVec2) -> DVec3 {
        let axes = self.eye.axes();
        let motion = motion / self.points_per_unit(self.eye.depth(at));
        axes.right * motion.x - axes.up * motion.y
    }

    /// The number `s` of the point `origin + s·axis` nearest to what lies under the page point; `None` if one looks along
    /// the axis.
    pub fn along_axis(&self, origin: DVec3, axis: DVec3, page: DVec2) -> Option<f64> {
        let ray = self.ray(page);
        let length = axis.length();
        let unit = axis / length;
        let cosine = unit.dot(ray.direction);
        let square_of_sine = unit.cross(ray.direction).length_squared();
        // The shortest connection is perpendicular to both lines.
        let between = ray.origin - origin;
        let s = between.dot(unit - ray.direction * cosine) / (square_of_sine * length);
        (square_of_sine > PARALLEL * PARALLEL && s.is_finite()).then_some(s)
    }

    /// Where the plane through `origin` with this normal lies under the page point; `None` if it is seen edge on or lies
    /// behind the eye.
    pub fn on_plane(&self, origin: DVec3, normal: DVec3, page: DVec2) -> Option<DVec3> {
        let ray = self.ray(page);
        let steepness = ray.direction.dot(normal);
        let distance = (origin - ray.origin).dot(normal) / steepness;
        let is_seen = steepness.abs() > PARALLEL * normal.length() && distance.is_finite();
        (is_seen && (distance > 0.0 || self.eye.0.orthographic))
            .then(|| ray.origin + ray.direction * distance)
    }

    /// The eye after its picture was moved by `motion` (pt, y down): what was at the target's depth follows exactly.
    #[must_use]
    pub fn panned(&self, motion: DVec2) -> Eye {
        let state = self.eye.0;
        let target = state.target - self.drag(state.target, motion);
        Eye::new(EyeState { target, ..state }).unwrap_or(self.eye)
    }

    /// The eye `factor` times nearer; what is under the page point at the target's depth stays there. Stops at the limits of
    /// [`EyeState`].
    #[must_use]
    pub fn zoomed(&self, page: DVec2, factor: f64) -> Eye {
        let state = self.eye.0;
        let fixed = self.world_from_page(page, state.distance);
        let distance = (state.distance / factor).clamp(EyeState::MIN_DISTANCE, EyeState::MAX_DISTANCE);
        let target = fixed + (state.target - fixed) * (distance / state.distance);
        Eye::new(EyeState { target, distance, ..state }).unwrap_or(self.eye)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn views() -> Vec<EyeView> {
        let mut views = Vec::new();
        for (yaw, pitch) in [(0.3, 0.4), (-2.0, -1.2), (-FRAC_PI_2, FRAC_PI_2)] {
            for orthographic in [false, true] {
                let target = DVec3::new(1.0, -2.0, 0.5);
                let state = EyeState { target, yaw, pitch, orthographic, ..EyeState::default() };
                views.push(EyeView { eye: Eye::new(state).unwrap(), size: DVec2::new(400.0, 300.0) });
            }
        }
        views
    }

    #[test]
    fn points_come_back_from_the_page_and_lie_on_their_rays() {
        for view in views() {
            for point in [DVec3::new(1.5, -1.0, 0.0), DVec3::new(0.0, -3.0, 2.0)] {
                let Projected { page, depth } = view.project(point).unwrap();
                let error = view.world_from_page(page, depth).distance(point);
                assert!(error < 1e-12, "{view:?}: off by {error:e}");
                let ray = view.ray(page);
                let error = (point - ray.origin).cross(ray.direction).length();
                assert!(error < 1e-12, "{view:?}: {error:e} beside the ray");
                assert!((point - ray.origin).dot(ray.direction) > 0.0, "in front of the eye");
            }
        }
    }

    #[test]
    fn the_matrices_say_the_same_as_the_projection() {
        let point = DVec3::new(1.5, -1.0, 0.0);
        for view in views() {
            let (near, far) = view.eye.depth_range(DVec3::splat(-3.0), DVec3::splat(3.0));
            let aspect = view.size.x / view.size.y;
            let clip =
                view.eye.clip_from_view(aspect, near, far) * view.eye.view_from_world() * point.extend(1.0);
            let clip = clip.truncate() / clip.w;
            let page = view.size * 0.5 + DVec2::new(clip.x, -clip.y) * view.size * 0.5;
            let error = page.distance(view.project(point).unwrap().page);
            assert!(error < 1e-10 && (0.0..1.0).contains(&clip.z), "{error:e} pt, {clip}");
        }
    }

    #[test]
    fn standard_views_have_their_axes() {
        let axes = |view| Eye::default().turned_to(view).axes();
        for (view, right, up) in [
            (StandardView::Front, DVec3::X, DVec3::Z),
            (StandardView::Top, DVec3::X, DVec3::Y),
            (StandardView::Right, DVec3::Y, DVec3::Z),
        ] {
            let axes = axes(view);
            assert!(axes.right.distance(right) + axes.up.distance(up) < 1e-15, "{view:?}: {axes:?}");
        }
        let axes = axes(StandardView::Isometric);
        let seen = DVec3::AXES.map(|axis| DVec2::new(axis.dot(axes.right), axis.dot(axes.up)).length());
        let expected = (2.0f64 / 3.0).sqrt();
        assert!(seen.iter().all(|length| (length - expected).abs() < 1e-15), "{seen:?}");
    }

    #[test]
    fn a_fitted_box_is_inside_and_touches_the_margin() {
        let (low, high) = (DVec3::new(-1.0, 2.0, -3.0), DVec3::new(4.0, 3.0, 5.0));
        for view in views() {
            let eye = view.eye.fitted(low, high, view.size, 20.0);
            let fitted = EyeView { eye, ..view };
            let room = corners(low, high).map(|corner| {
                let page = fitted.project(corner).unwrap().page;
                page.min(view.size - page).min_element()
            });
            let least = room.into_iter().fold(f64::INFINITY, f64::min);
            assert!((least - 20.0).abs() < 1e-9, "{:?}: margin {least}", eye.state());
        }
        let point = Eye::default().fitted(DVec3::ONE, DVec3::ONE, DVec2::splat(100.0), 10.0);
        assert_eq!(point.state().distance, Eye::default().state().distance, "a box without extent");
        let hole = Eye::default().fitted(DVec3::NAN, DVec3::ONE, DVec2::splat(100.0), 10.0);
        assert_eq!(hole, Eye::default(), "a box that is none");
    }

    #[test]
    fn orbits_keep_the_distance_and_stop_at_the_poles() {
        let mut eye = Eye::default();
        for step in 0..200 {
            eye = eye.orbited(0.7, if step < 100 { 0.1 } else { -0.13 });
            let distance = eye.position().distance(eye.state().target);
            assert!((distance - 8.0).abs() < 1e-12, "step {step}: {distance}");
            assert!(eye.state().check().is_ok(), "{:?}", eye.state());
        }
        assert_eq!(eye.state().pitch, -FRAC_PI_2, "straight from below");
        assert_eq!(eye.orbited(f64::NAN, f64::INFINITY), eye, "no such turn");
    }

    #[test]
    fn what_is_under_the_cursor_stays_there_in_zoom_and_follows_in_pan() {
        let cursor = DVec2::new(310.0, 40.0);
        for view in views() {
            let point = view.world_from_page(cursor, view.eye.state().distance);
            for factor in [0.5, 1.0, 3.0] {
                let zoomed = EyeView { eye: view.zoomed(cursor, factor), ..view };
                let page = zoomed.project(point).unwrap().page;
                assert!(page.distance(cursor) < 1e-9, "factor {factor}: {page}");
            }
            let motion = DVec2::new(-30.0, 50.0);
            let panned = EyeView { eye: view.panned(motion), ..view };
            let page = panned.project(point).unwrap().page;
            assert!(page.distance(cursor + motion) < 1e-9, "{page}");
            for bad in [0.0, f64::NAN, f64::INFINITY] {
                assert!(view.zoomed(cursor, bad).state().check().is_ok(), "factor {bad}");
            }
        }
    }

    #[test]
    fn drags_follow_the_pointer_in_the_plane_and_along_an_axis() {
        let (at, motion) = (DVec3::new(0.5, -2.5, 0.8), DVec2::new(12.0, -7.0));
        for view in views() {
            let start = view.project(at).unwrap().page;
            let moved = at + view.drag(at, motion);
            let seen = view.project(moved).unwrap();
            assert!(seen.page.distance(start + motion) < 1e-9, "{}", seen.page);
            let axis = DVec3::new(1.0, 2.0, 0.5);
            for s in [-0.3, 0.0, 0.4] {
                let page = view.project(at + axis * s).unwrap().page;
                let found = view.along_axis(at, axis, page).unwrap();
                assert!((found - s).abs() < 1e-9, "{found} for {s}");
                let on_plane = view.on_plane(at, DVec3::new(0.1, 0.2, 1.0), page).unwrap();
                assert!((on_plane - at).dot(DVec3::new(0.1, 0.2, 1.0)).abs() < 1e-9, "{on_plane}");
                assert!(view.project(on_plane).unwrap().page.distance(page) < 1e-9, "{on_plane}");
            }
            let towards = view.ray(start).direction;
            assert_eq!(view.along_axis(at, towards, start), None, "seen from its end");
            assert_eq!(view.along_axis(at, DVec3::ZERO, start), None, "no direction");
        }
    }

    #[test]
    fn what_is_behind_the_eye_has_no_place() {
        let view = EyeView { eye: Eye::default(), size: DVec2::splat(100.0) };
        let behind = view.eye.position() + view.eye.axes().towards;
        assert_eq!(view.project(behind), None, "behind");
        assert_eq!(view.project(DVec3::NAN), None, "nowhere");
        let parallel = EyeView { eye: view.eye.with_orthographic(true), ..view };
        assert!(parallel.project(behind).is_some(), "parallel rays come from everywhere");
    }
}
