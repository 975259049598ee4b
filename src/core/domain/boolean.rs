//! Boolean combinations of regions.

use std::sync::Arc;

use glam::DVec2;

use crate::core::domain::bounds::{Bounds, CellClass};
use crate::core::domain::error::DomainError;
use crate::core::domain::primitive::{Jet, Primitive, check_box};

/// A plane domain: a tree of complements, unions and intersections with primitive regions as leaves.
///
/// ```
/// # use glam::DVec2;
/// # use spline_lab::core::domain::Domain;
/// let ring = Domain::disc(DVec2::ZERO, 2.0)?.difference(Domain::disc(DVec2::ZERO, 1.0)?);
/// assert!(ring.contains(DVec2::new(0.0, 1.5)) && !ring.contains(DVec2::ZERO));
/// # Ok::<(), spline_lab::core::domain::DomainError>(())
/// ```
#[derive(Clone, Debug)]
pub enum Domain {
    /// A leaf.
    Primitive(Primitive),
    /// The outside.
    Complement(Arc<Self>),
    /// What belongs to one or both.
    Union(Arc<[Self; 2]>),
    /// What belongs to both.
    Intersection(Arc<[Self; 2]>),
}

impl Domain {
    /// The half plane on the side of `inward_normal` (of any positive length) from the line through `point`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `Degenerate` for a normal of length 0.
    pub fn half_plane(point: DVec2, inward_normal: DVec2) -> Result<Self, DomainError> {
        Primitive::half_plane(point, inward_normal).map(Self::Primitive)
    }

    /// The disc around `center`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval` unless the radius is positive.
    pub fn disc(center: DVec2, radius: f64) -> Result<Self, DomainError> {
        Self::ellipse(center, DVec2::splat(radius), 0.0)
    }

    /// The ellipse whose first half axis makes the angle `angle` (radians) with the x-axis.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval` unless both half axes are positive.
    pub fn ellipse(center: DVec2, half_axes: DVec2, angle: f64) -> Result<Self, DomainError> {
        Primitive::ellipse(center, half_axes, angle).map(Self::Primitive)
    }

    /// The box with the corners `lower` and `upper`, as the intersection of four half planes.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval`.
    pub fn rectangle(lower: DVec2, upper: DVec2) -> Result<Self, DomainError> {
        check_box(&Bounds::new(lower, upper))?;
        let strip = |axis: DVec2| -> Result<Self, DomainError> {
            Ok(Self::half_plane(lower, axis)?.intersection(Self::half_plane(upper, -axis)?))
        };
        Ok(strip(DVec2::X)?.intersection(strip(DVec2::Y)?))
    }

    /// The region where `level` is positive; `bounds` is a box that contains it. A value that is not finite counts as outside.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval` for a box without area.
    pub fn implicit(
        level: Arc<dyn Fn(DVec2) -> Jet + Send + Sync>,
        bounds: Bounds,
    ) -> Result<Self, DomainError> {
        Primitive::implicit(level, bounds).map(Self::Primitive)
    }

    /// The outside of the domain.
    #[must_use]
    pub fn complement(self) -> Self {
        match self {
            Self::Complement(inner) => Arc::unwrap_or_clone(inner),
            _ => Self::Complement(Arc::new(self)),
        }
    }

    /// What belongs to one of the domains or to both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self::Union(Arc::new([self, other]))
    }

    /// What belongs to both domains.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        Self::Intersection(Arc::new([self, other]))
    }

    /// What belongs to this domain and not to `other`.
    #[must_use]
    pub fn difference(self, other: Self) -> Self {
        self.intersection(other.complement())
    }

    /// Whether `x` lies inside; points of the boundary may count either way.
    pub fn contains(&self, x: DVec2) -> bool {
        match self {
            Self::Primitive(primitive) => primitive.level(x).value > 0.0,
            Self::Complement(domain) => !domain.contains(x),
            Self::Union(both) => both[0].contains(x) || both[1].contains(x),
            Self::Intersection(both) => both[0].contains(x) && both[1].contains(x),
        }
    }

    /// A box around the domain, with infinite sides if it is unbounded as far as the tree tells.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Primitive(primitive) => primitive.bounds(),
            Self::Complement(_) => Bounds::PLANE,
            Self::Union(both) => both[0].bounds().hull(&both[1].bounds()),
            Self::Intersection(both) => both[0].bounds().intersection(&both[1].bounds()),
        }
    }

    /// How `cell` lies to the domain.
    ///
    /// Cells are called cut also where boundaries of leaves meet that are not boundaries of the domain, as inside a union.
    pub fn classify(&self, cell: &Bounds) -> CellClass {
        match self {
            Self::Primitive(primitive) => primitive.classify(cell),
            Self::Complement(domain) => match domain.classify(cell) {
                CellClass::Inner => CellClass::Outer,
                CellClass::Cut => CellClass::Cut,
                CellClass::Outer => CellClass::Inner,
            },
            Self::Union(both) => both[0].classify(cell).max(both[1].classify(cell)),
            Self::Intersection(both) => both[0].classify(cell).min(both[1].classify(cell)),
        }
    }

    /// All leaves from left to right.
    pub fn primitives(&self) -> Vec<&Primitive> {
        match self {
            Self::Primitive(primitive) => vec![primitive],
            Self::Complement(domain) => domain.primitives(),
            Self::Union(both) | Self::Intersection(both) => both.iter().flat_map(Self::primitives).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn set_operations_act_on_points(x in -2.0..2.0, y in -2.0..2.0, r in 0.1..2.0, s in 0.1..2.0) {
            let p = DVec2::new(x, y);
            let (a, b) = (Domain::disc(DVec2::ZERO, r).unwrap(), Domain::disc(DVec2::X, s).unwrap());
            let (in_a, in_b) = (a.contains(p), b.contains(p));
            prop_assert_eq!(a.clone().union(b.clone()).contains(p), in_a || in_b);
            prop_assert_eq!(a.clone().intersection(b.clone()).contains(p), in_a && in_b);
            prop_assert_eq!(a.clone().difference(b).contains(p), in_a && !in_b);
            prop_assert_eq!(a.complement().contains(p), !in_a);
        }
    }

    #[test]
    fn the_box_of_a_rectangle_is_itself_and_a_hole_does_not_enlarge_it() {
        let (lower, upper) = (DVec2::new(-1.0, 2.0), DVec2::new(3.0, 2.5));
        let plate = Domain::rectangle(lower, upper).unwrap();
        let pierced = plate.difference(Domain::disc(DVec2::new(1.0, 2.2), 0.1).unwrap());
        assert_eq!(pierced.bounds(), Bounds::new(lower, upper), "box");
        assert_eq!(pierced.primitives().len(), 5, "four sides and a hole");
    }
}
