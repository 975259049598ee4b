//! Regions with one boundary curve: half planes, ellipses, and implicit regions `f > 0`.
//!
//! | region | level (positive inside) |
//! |---|---|
//! | half plane | `normal·(x − point)`, `normal` a unit vector that points inside |
//! | ellipse with half axes `a ≥ b` | `b/2 (1 − ‖S⁻¹(x − center)‖²)`; of a disc `(r² − ‖x − center‖²)/(2r)` |
//! | implicit | the given function |
//!
//! The slope of a level across the boundary is 1 for half planes and discs, between `b/a` and 1 for ellipses.

use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use glam::{DMat2, DVec2};

use crate::core::domain::bounds::{Bounds, CellClass};
use crate::core::domain::error::DomainError;

/// Value and gradient of a function at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// The value.
    pub value: f64,
    /// The gradient.
    pub gradient: DVec2,
}

/// A region with one boundary curve; valid by construction.
#[derive(Clone)]
pub struct Primitive {
    shape: Shape,
}

#[derive(Clone)]
enum Shape {
    HalfPlane {
        point: DVec2,
        normal: DVec2,
    },
    Ellipse {
        center: DVec2,
        half_axes: DVec2,
        /// Maps the ellipse, moved to the origin, to the unit disc.
        to_disc: DMat2,
    },
    Implicit {
        level: Arc<dyn Fn(DVec2) -> Jet + Send + Sync>,
        bounds: Bounds,
    },
}

/// Samples of an implicit level per cell side and along a line through a cell: features smaller than a part can
/// be missed.
const IMPLICIT_SAMPLES: usize = 8;

/// A cell whose boundary distance is below this part of the coordinates' size is not cut.
const TOUCH: f64 = 1e-13;

impl Primitive {
    /// The half plane on the side of `inward_normal` (of any positive length) from the line through `point`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `Degenerate` for a normal of length 0.
    pub fn half_plane(point: DVec2, inward_normal: DVec2) -> Result<Self, DomainError> {
        check_finite("coordinate", &[point.x, point.y, inward_normal.x, inward_normal.y])?;
        let normal = inward_normal / inward_normal.abs().max_element().max(f64::MIN_POSITIVE);
        let normal =
            normal.try_normalize().ok_or(DomainError::Degenerate { what: "normal of the half plane" })?;
        Ok(Self { shape: Shape::HalfPlane { point, normal } })
    }

    /// The ellipse whose first half axis makes the angle `angle` (radians) with the x-axis.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval` unless both half axes are positive.
    pub fn ellipse(center: DVec2, half_axes: DVec2, angle: f64) -> Result<Self, DomainError> {
        check_finite("number", &[center.x, center.y, half_axes.x, half_axes.y, angle])?;
        for axis in 0..2 {
            if half_axes[axis] <= 0.0 {
                let right = half_axes[axis];
                return Err(DomainError::EmptyInterval { what: "the half axis", axis, left: 0.0, right });
            }
        }
        let to_disc = DMat2::from_diagonal(half_axes.recip()) * DMat2::from_angle(-angle);
        Ok(Self { shape: Shape::Ellipse { center, half_axes, to_disc } })
    }

    /// The region where `level` is positive; `bounds` is a box that contains it.
    ///
    /// A value that is not finite counts as outside.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval` for a box without area.
    pub fn implicit(
        level: Arc<dyn Fn(DVec2) -> Jet + Send + Sync>,
        bounds: Bounds,
    ) -> Result<Self, DomainError> {
        check_box(&bounds)?;
        Ok(Self { shape: Shape::Implicit { level, bounds } })
    }

    /// The level at `x`, positive inside, and its gradient.
    pub fn level(&self, x: DVec2) -> Jet {
        match &self.shape {
            Shape::HalfPlane { point, normal } => Jet { value: normal.dot(x - *point), gradient: *normal },
            Shape::Ellipse { center, half_axes, to_disc } => {
                let image = *to_disc * (x - *center);
                let scale = half_axes.min_element();
                let gradient = -scale * (to_disc.transpose() * image);
                Jet { value: 0.5 * scale * (1.0 - image.length_squared()), gradient }
            }
            Shape::Implicit { level, .. } => {
                let jet = level(x);
                let gradient = if jet.gradient.is_finite() { jet.gradient } else { DVec2::ZERO };
                Jet { value: if jet.value.is_finite() { jet.value } else { -1.0 }, gradient }
            }
        }
    }

    /// Whether the boundary is a straight line.
    pub fn is_straight(&self) -> bool {
        matches!(self.shape, Shape::HalfPlane { .. })
    }

    /// A box around the region.
    pub fn bounds(&self) -> Bounds {
        match &self.shape {
            Shape::HalfPlane { point, normal } => {
                let mut bounds = Bounds::PLANE;
                if normal.y == 0.0 {
                    let side = if normal.x > 0.0 { &mut bounds.lower } else { &mut bounds.upper };
                    side.x = point.x;
                }
                if normal.x == 0.0 {
                    let side = if normal.y > 0.0 { &mut bounds.lower } else { &mut bounds.upper };
                    side.y = point.y;
                }
                bounds
            }
            Shape::Ellipse { center, .. } => {
                let reach = DVec2::new(self.reach(0), self.reach(1));
                Bounds::new(*center - reach, *center + reach)
            }
            Shape::Implicit { bounds, .. } => *bounds,
        }
    }

    /// How `cell` lies to the region; of implicit regions judged by samples.
    pub fn classify(&self, cell: &Bounds) -> CellClass {
        let size = cell.lower.abs().max(cell.upper.abs()).max_element();
        match &self.shape {
            Shape::HalfPlane { point, .. } => {
                let touch = TOUCH * size.max(point.abs().max_element());
                let levels = cell.corners().map(|corner| self.level(corner).value);
                classify_range(levels, touch)
            }
            Shape::Ellipse { center, half_axes, to_disc } => {
                let images = cell.corners().map(|corner| *to_disc * (corner - *center));
                let farthest = images.iter().fold(0.0, |max: f64, image| max.max(image.length()));
                let sides = (0..4).map(|i| distance_to_origin(images[i], images[(i + 1) % 4]));
                let inside = (cell.lower.cmple(*center) & cell.upper.cmpge(*center)).all();
                let nearest = if inside { 0.0 } else { sides.fold(f64::INFINITY, f64::min) };
                let touch = TOUCH * (1.0 + size / half_axes.min_element());
                classify_range([1.0 - farthest, 1.0 - nearest, 1.0 - farthest, 1.0 - nearest], touch)
            }
            Shape::Implicit { bounds, .. } => {
                let overlap = bounds.intersection(cell).size();
                if overlap.min_element() <= 0.0 {
                    return CellClass::Outer;
                }
                let steps = IMPLICIT_SAMPLES;
                let sample = |i: usize, j: usize| {
                    let t = DVec2::new(i as f64, j as f64) / steps as f64;
                    self.level(cell.lower + t * cell.size()).value
                };
                let samples = (0..=steps).flat_map(|i| (0..=steps).map(move |j| (i, j)));
                let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
                for value in samples.map(|(i, j)| sample(i, j)) {
                    (min, max) = (min.min(value), max.max(value));
                }
                classify_range([min, max, min, max], 0.0)
            }
        }
    }

    /// Appends the places in `(from, to)` where the boundary crosses the line on which coordinate `axis` is `at`.
    ///
    /// The places are values of the other coordinate, in no particular succession.
    pub fn push_crossings(&self, axis: usize, at: f64, from: f64, to: f64, places: &mut Vec<f64>) {
        let along = 1 - axis;
        let mut push = |place: f64| {
            if place > from && place < to {
                places.push(place);
            }
        };
        let mut start = DVec2::ZERO;
        start[axis] = at;
        let mut direction = DVec2::ZERO;
        direction[along] = 1.0;
        match &self.shape {
            Shape::HalfPlane { point, normal } => {
                // Also for a tiny component: the quotient is then beyond the ends, or infinite.
                push(point[along] - normal[axis] * (at - point[axis]) / normal[along]);
            }
            Shape::Ellipse { center, to_disc, .. } => {
                // |a + t b|² = 1 with the foot point of the center as origin of t, where a·b is small.
                start[along] = center[along];
                let (a, b) = (*to_disc * (start - *center), *to_disc * direction);
                let (bb, ab) = (b.length_squared(), a.dot(b));
                // bb − (a × b)² is the discriminant without the cancellation of ab² − bb (aa − 1).
                let discriminant = bb - a.perp_dot(b).powi(2);
                if discriminant > 0.0 {
                    let root = discriminant.sqrt();
                    push(center[along] + (-ab - root) / bb);
                    push(center[along] + (-ab + root) / bb);
                }
            }
            Shape::Implicit { .. } => {
                let level = |t: f64| self.level(start + t * direction).value;
                let node = |i: usize| from + (to - from) * i as f64 / IMPLICIT_SAMPLES as f64;
                let mut before = level(from);
                for i in 1..=IMPLICIT_SAMPLES {
                    let now = level(node(i));
                    if (before > 0.0) != (now > 0.0) {
                        push(sign_change(&level, node(i - 1), before, node(i), now));
                    }
                    before = now;
                }
            }
        }
    }

    /// Appends the values of coordinate `axis` at which the boundary runs in the direction of the other coordinate.
    ///
    /// Of implicit regions none.
    pub fn push_turning_places(&self, axis: usize, places: &mut Vec<f64>) {
        match &self.shape {
            Shape::HalfPlane { point, normal } if normal[1 - axis] == 0.0 => places.push(point[axis]),
            Shape::Ellipse { center, .. } => {
                places.extend([center[axis] - self.reach(axis), center[axis] + self.reach(axis)]);
            }
            _ => {}
        }
    }

    /// Half the width of an ellipse in direction `axis`.
    fn reach(&self, axis: usize) -> f64 {
        match &self.shape {
            // The support function |S eᵢ|, where S is the inverse of the map to the disc.
            Shape::Ellipse { to_disc, .. } => to_disc.inverse().row(axis).length(),
            _ => 0.0,
        }
    }
}

impl Debug for Primitive {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.shape {
            Shape::HalfPlane { point, normal } => write!(f, "HalfPlane({point}, {normal})"),
            Shape::Ellipse { center, half_axes, to_disc } => {
                write!(f, "Ellipse({center}, {half_axes}, {to_disc})")
            }
            Shape::Implicit { bounds, .. } => write!(f, "Implicit({bounds:?})"),
        }
    }
}

fn classify_range(levels: [f64; 4], touch: f64) -> CellClass {
    match levels {
        _ if levels.iter().all(|level| *level >= -touch) => CellClass::Inner,
        _ if levels.iter().all(|level| *level <= touch) => CellClass::Outer,
        _ => CellClass::Cut,
    }
}

/// Distance of the segment `ab` from the origin.
fn distance_to_origin(a: DVec2, b: DVec2) -> f64 {
    let side = b - a;
    let t = (-a.dot(side) / side.length_squared()).clamp(0.0, 1.0);
    (a + t * side).length()
}

/// A place between `left` and `right` where `level` changes its sign, to rounding (bisection with secants, the
/// Illinois variant).
fn sign_change(
    level: &impl Fn(f64) -> f64,
    mut left: f64,
    mut at_left: f64,
    mut right: f64,
    mut at_right: f64,
) -> f64 {
    let tiny = f64::EPSILON * (left.abs() + right.abs());
    for step in 0..100 {
        let mut middle = (left * at_right - right * at_left) / (at_right - at_left);
        // Every third step halves, which bounds the number of steps for any level.
        if step % 3 == 2 || !(middle > left && middle < right) {
            middle = 0.5 * (left + right);
        }
        if right - left <= tiny || middle <= left || middle >= right {
            break;
        }
        let at_middle = level(middle);
        if at_middle == 0.0 {
            return middle;
        }
        if (at_middle > 0.0) == (at_left > 0.0) {
            (left, at_left, at_right) = (middle, at_middle, 0.5 * at_right);
        } else {
            (right, at_right, at_left) = (middle, at_middle, 0.5 * at_left);
        }
    }
    0.5 * (left + right)
}

pub(super) fn check_finite(what: &'static str, numbers: &[f64]) -> Result<(), DomainError> {
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(index) => Err(DomainError::NonFinite { what, index, value: numbers[index] }),
        None => Ok(()),
    }
}

pub(super) fn check_box(bounds: &Bounds) -> Result<(), DomainError> {
    let Bounds { lower, upper } = *bounds;
    check_finite("coordinate", &[lower.x, lower.y, upper.x, upper.y])?;
    for axis in 0..2 {
        if lower[axis] >= upper[axis] {
            let (left, right) = (lower[axis], upper[axis]);
            return Err(DomainError::EmptyInterval { what: "the box", axis, left, right });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    fn samples() -> Vec<Primitive> {
        let wavy = |x: DVec2| Jet {
            value: 1.0 - x.x.powi(4) - x.y * x.y,
            gradient: DVec2::new(-4.0 * x.x.powi(3), -2.0 * x.y),
        };
        vec![
            Primitive::half_plane(DVec2::new(0.1, 0.2), DVec2::new(3.0, -4.0)).unwrap(),
            Primitive::ellipse(DVec2::new(0.2, -0.1), DVec2::new(0.9, 0.4), 0.7).unwrap(),
            Primitive::ellipse(DVec2::ZERO, DVec2::ONE, 0.0).unwrap(),
            Primitive::implicit(Arc::new(wavy), Bounds::new(DVec2::splat(-1.0), DVec2::splat(1.0))).unwrap(),
        ]
    }

    #[test]
    fn gradients_are_the_limits_of_difference_quotients() {
        for primitive in samples() {
            for x in [DVec2::new(0.3, 0.4), DVec2::new(-0.6, 0.1)] {
                let jet = primitive.level(x);
                for (axis, e) in [DVec2::X, DVec2::Y].into_iter().enumerate() {
                    let h = 1e-6;
                    let slope =
                        (primitive.level(x + h * e).value - primitive.level(x - h * e).value) / (2.0 * h);
                    assert!((slope - jet.gradient[axis]).abs() < 1e-9, "{primitive:?}, axis {axis}");
                }
            }
        }
    }

    #[test]
    fn crossings_are_zeros_of_the_level_and_turning_places_have_a_parallel_tangent() {
        for primitive in samples() {
            for axis in 0..2 {
                let mut places = Vec::new();
                for i in 0..40 {
                    let at = -0.97 + 0.05 * f64::from(i);
                    places.clear();
                    primitive.push_crossings(axis, at, -2.0, 2.0, &mut places);
                    for &place in &places {
                        let x = if axis == 0 { DVec2::new(at, place) } else { DVec2::new(place, at) };
                        assert!(primitive.level(x).value.abs() < 3e-15, "{primitive:?} at {x}");
                    }
                }
                places.clear();
                primitive.push_turning_places(axis, &mut places);
                for &place in &places {
                    let mut crossings = [Vec::new(), Vec::new()];
                    for (side, list) in crossings.iter_mut().enumerate() {
                        let at = place + (side as f64 - 0.5) * 1e-9;
                        primitive.push_crossings(axis, at, -9.0, 9.0, list);
                    }
                    let counts = [crossings[0].len(), crossings[1].len()];
                    assert!(counts.contains(&0) && counts.contains(&2), "{primitive:?}: {counts:?}");
                }
            }
        }
    }

    #[test]
    fn cells_inside_and_outside_have_only_such_points_and_cut_cells_both() {
        for primitive in samples() {
            for i in -10..10 {
                for j in -10..10 {
                    let lower = DVec2::new(f64::from(i), f64::from(j)) * 0.2 + 0.013;
                    let cell = Bounds::new(lower, lower + 0.2);
                    let points = (0..=40).flat_map(|i| (0..=40).map(move |j| (i, j)));
                    let inside = points
                        .map(|(i, j)| cell.lower + DVec2::new(f64::from(i), f64::from(j)) * 0.005)
                        .filter(|x| primitive.level(*x).value > 0.0)
                        .count();
                    match primitive.classify(&cell) {
                        CellClass::Inner => assert_eq!(inside, 41 * 41, "{primitive:?}, {cell:?}"),
                        CellClass::Outer => assert_eq!(inside, 0, "{primitive:?}, {cell:?}"),
                        CellClass::Cut => {}
                    }
                    if inside > 0 && inside < 41 * 41 {
                        assert_eq!(primitive.classify(&cell), CellClass::Cut, "{primitive:?}, {cell:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_cell_that_touches_the_circle_is_not_cut() {
        let disc = Primitive::ellipse(DVec2::ZERO, DVec2::ONE, 0.0).unwrap();
        let beside = Bounds::new(DVec2::new(1.0, -0.5), DVec2::new(2.0, 0.5));
        assert_eq!(disc.classify(&beside), CellClass::Outer, "touches from outside");
        let within = Bounds::new(DVec2::new(0.2, 0.3), DVec2::new(0.6, 0.8));
        assert_eq!(disc.classify(&within), CellClass::Inner, "its corner (0.6, 0.8) is on the circle");
    }

    #[test]
    fn regions_without_area_are_refused() {
        let name = |result: Result<Primitive, DomainError>| result.unwrap_err().name();
        assert_eq!(name(Primitive::half_plane(DVec2::ZERO, DVec2::ZERO)), "Degenerate", "normal");
        assert_eq!(name(Primitive::ellipse(DVec2::ZERO, DVec2::new(1.0, 0.0), 0.0)), "EmptyInterval", "axis");
        assert_eq!(name(Primitive::ellipse(DVec2::ZERO, DVec2::ONE, f64::NAN)), "NonFinite", "angle");
    }
}
