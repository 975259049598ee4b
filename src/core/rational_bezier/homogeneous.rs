//! Homogeneous points: the only place that multiplies by weights and divides by them.
//!
//! A point `c` with weight `w` becomes `(w·c, w)`. Course: section 3.3.

use glam::{DVec2, DVec3, DVec4};

use crate::core::point::Point;

/// A Cartesian point that has a homogeneous form.
pub trait Projective: Point {
    /// `(w·c, w)`: one coordinate more.
    type Homogeneous: Point;

    /// `(weight·self, weight)`.
    fn lift(self, weight: f64) -> Self::Homogeneous;

    /// The Cartesian point and the weight of a homogeneous one: `(p, w) ↦ (p/w, w)`.
    fn project(homogeneous: Self::Homogeneous) -> (Self, f64);

    /// The part `p` of `(p, w)`, not divided.
    fn numerator(homogeneous: Self::Homogeneous) -> Self;
}

impl Projective for f64 {
    type Homogeneous = DVec2;

    fn lift(self, weight: f64) -> DVec2 {
        DVec2::new(self * weight, weight)
    }

    fn project(homogeneous: DVec2) -> (Self, f64) {
        (homogeneous.x / homogeneous.y, homogeneous.y)
    }

    fn numerator(homogeneous: DVec2) -> Self {
        homogeneous.x
    }
}

impl Projective for DVec2 {
    type Homogeneous = DVec3;

    fn lift(self, weight: f64) -> DVec3 {
        (self * weight).extend(weight)
    }

    fn project(homogeneous: DVec3) -> (Self, f64) {
        (homogeneous.truncate() / homogeneous.z, homogeneous.z)
    }

    fn numerator(homogeneous: DVec3) -> Self {
        homogeneous.truncate()
    }
}

impl Projective for DVec3 {
    type Homogeneous = DVec4;

    fn lift(self, weight: f64) -> DVec4 {
        (self * weight).extend(weight)
    }

    fn project(homogeneous: DVec4) -> (Self, f64) {
        (homogeneous.truncate() / homogeneous.w, homogeneous.w)
    }

    fn numerator(homogeneous: DVec4) -> Self {
        homogeneous.truncate()
    }
}
