//! What a control point must be able to do, and nothing more.
//!
//! Numbers are points of the line, [`DVec2`] and [`DVec3`] points of the plane and of space, and
//! [`DVec3`], [`DVec4`] also serve as homogeneous points `(w·x, w·y, w)` and `(w·x, w·y, w·z, w)`.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

use glam::{DVec2, DVec3, DVec4};

/// A value that can be averaged: the coefficients of every spline and Bezier curve of the library.
pub trait Point:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
    + 'static
{
    /// Number of coordinates.
    const DIMENSION: usize;
    /// The origin.
    const ZERO: Self;

    /// Coordinate number `index`, counted from 0; `NaN` if there is no such coordinate.
    fn coordinate(self, index: usize) -> f64;

    /// Whether all coordinates are finite numbers.
    fn is_finite(self) -> bool {
        // Infinity times 0 is not a number.
        self * 0.0 == Self::ZERO
    }

    /// Euclidean length.
    fn norm(self) -> f64;

    /// `(1 − t)·self + t·other`; equals `self` at `t = 0` and `other` at `t = 1` bit for bit (of finite points).
    #[must_use]
    fn mix(self, other: Self, t: f64) -> Self {
        self * (1.0 - t) + other * t
    }
}

impl Point for f64 {
    const DIMENSION: usize = 1;
    const ZERO: Self = 0.0;

    fn coordinate(self, index: usize) -> f64 {
        if index == 0 { self } else { Self::NAN }
    }

    fn norm(self) -> f64 {
        self.abs()
    }
}

impl Point for DVec2 {
    const DIMENSION: usize = 2;
    const ZERO: Self = Self::ZERO;

    fn coordinate(self, index: usize) -> f64 {
        self.to_array().get(index).copied().unwrap_or(f64::NAN)
    }

    fn norm(self) -> f64 {
        self.x.hypot(self.y)
    }
}

impl Point for DVec3 {
    const DIMENSION: usize = 3;
    const ZERO: Self = Self::ZERO;

    fn coordinate(self, index: usize) -> f64 {
        self.to_array().get(index).copied().unwrap_or(f64::NAN)
    }

    fn norm(self) -> f64 {
        self.length()
    }
}

impl Point for DVec4 {
    const DIMENSION: usize = 4;
    const ZERO: Self = Self::ZERO;

    fn coordinate(self, index: usize) -> f64 {
        self.to_array().get(index).copied().unwrap_or(f64::NAN)
    }

    fn norm(self) -> f64 {
        self.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixing_is_exact_at_both_ends() {
        let (a, b) = (DVec2::new(0.1, 1e300), DVec2::new(-0.7, 3.0));
        assert_eq!(a.mix(b, 0.0), a, "t = 0");
        assert_eq!(a.mix(b, 1.0), b, "t = 1");
    }

    #[test]
    fn a_point_with_one_bad_coordinate_is_not_finite() {
        assert!(!DVec3::new(0.0, f64::NAN, 1.0).is_finite(), "NaN in the middle");
        assert!(!Point::is_finite(f64::INFINITY), "an infinite number");
        assert!(Point::is_finite(DVec4::ONE), "ones");
    }

    #[test]
    fn coordinates_beyond_the_last_are_not_numbers() {
        assert!(DVec2::ONE.coordinate(2).is_nan(), "the plane has two coordinates");
        assert_eq!(DVec3::new(1.0, 2.0, 3.0).coordinate(2), 3.0, "z");
    }
}
