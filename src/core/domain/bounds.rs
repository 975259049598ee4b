//! Boxes with sides parallel to the axes.

use glam::DVec2;

/// A box `[lower.x, upper.x] × [lower.y, upper.y]`; sides may be infinite, and a box with `lower > upper` is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub lower: DVec2,
    /// The corner with the largest coordinates.
    pub upper: DVec2,
}

/// How a cell lies to a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CellClass {
    /// No part of the cell is in the domain.
    Outer,
    /// The boundary cuts the cell.
    Cut,
    /// The cell is contained in the closure of the domain.
    Inner,
}

impl Bounds {
    /// The whole plane.
    pub const PLANE: Self = Self { lower: DVec2::NEG_INFINITY, upper: DVec2::INFINITY };

    /// The box of two opposite corners, unsorted.
    pub fn new(lower: DVec2, upper: DVec2) -> Self {
        Self { lower, upper }
    }

    /// `upper − lower`.
    pub fn size(&self) -> DVec2 {
        self.upper - self.lower
    }

    /// The middle.
    pub fn center(&self) -> DVec2 {
        0.5 * (self.lower + self.upper)
    }

    /// The four corners in the order of the signs (−, −), (+, −), (+, +), (−, +).
    pub fn corners(&self) -> [DVec2; 4] {
        let Self { lower, upper } = *self;
        [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)]
    }

    /// The four halves in both directions.
    pub fn quarters(&self) -> [Self; 4] {
        let middle = self.center();
        self.corners().map(|corner| Self { lower: corner.min(middle), upper: corner.max(middle) })
    }

    /// The common part, perhaps empty.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self { lower: self.lower.max(other.lower), upper: self.upper.min(other.upper) }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn hull(&self, other: &Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// Whether both corners are finite.
    pub fn is_finite(&self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }
}
