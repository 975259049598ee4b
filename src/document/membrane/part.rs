//! The primitives of a plane domain and how each is joined to those before it.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::core::domain::{Bounds, Domain, DomainError};

/// A primitive region of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A disc.
    Disc {
        /// Its centre.
        center: DVec2,
        /// Its radius, positive.
        radius: f64,
    },
    /// An ellipse.
    Ellipse {
        /// Its centre.
        center: DVec2,
        /// Its half axes, positive.
        half_axes: DVec2,
        /// Angle in radians from the x-axis to the first half axis.
        angle: f64,
    },
    /// A rectangle with sides parallel to the axes.
    Rectangle {
        /// The corner with the smallest coordinates.
        lower: DVec2,
        /// The corner with the largest coordinates.
        upper: DVec2,
    },
    /// A half plane.
    HalfPlane {
        /// A point of its boundary.
        point: DVec2,
        /// A vector of any positive length across the boundary, to the inside.
        normal: DVec2,
    },
    /// A polygon without crossings.
    Polygon {
        /// Its vertices in order.
        vertices: Vec<DVec2>,
    },
}

/// How a part is joined to what the parts before it make; of the first part it says nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Operation {
    /// Added.
    #[default]
    Union,
    /// Only what both have remains.
    Intersection,
    /// Taken away.
    Difference,
}

/// A primitive with its operation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// How it is joined.
    pub operation: Operation,
    /// What is joined.
    pub shape: Shape,
}

impl Operation {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::Union, Self::Intersection, Self::Difference];

    /// The word for people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersection => "intersection",
            Self::Difference => "difference",
        }
    }
}

impl Shape {
    /// What it is, in one word or two.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Disc { .. } => "disc",
            Self::Ellipse { .. } => "ellipse",
            Self::Rectangle { .. } => "rectangle",
            Self::HalfPlane { .. } => "half plane",
            Self::Polygon { .. } => "polygon",
        }
    }

    /// The region.
    ///
    /// # Errors
    ///
    /// [`DomainError`] if the numbers make none.
    pub fn domain(&self) -> Result<Domain, DomainError> {
        match self {
            Self::Disc { center, radius } => Domain::disc(*center, *radius),
            Self::Ellipse { center, half_axes, angle } => Domain::ellipse(*center, *half_axes, *angle),
            Self::Rectangle { lower, upper } => Domain::rectangle(*lower, *upper),
            Self::HalfPlane { point, normal } => Domain::half_plane(*point, *normal),
            Self::Polygon { vertices } => Domain::polygon(vertices),
        }
    }

    /// The points by which it is dragged, each with its name: first the one that moves the whole.
    pub fn handles(&self) -> Vec<(String, DVec2)> {
        let named = |name: &str, at: DVec2| (name.to_owned(), at);
        match self {
            Self::Disc { center, radius } => {
                vec![named("Centre", *center), named("Radius", *center + *radius * DVec2::X)]
            }
            Self::Ellipse { center, half_axes, angle } => {
                let axis = DVec2::from_angle(*angle);
                vec![
                    named("Centre", *center),
                    named("First half axis", *center + half_axes.x * axis),
                    named("Second half axis", *center + half_axes.y * axis.perp()),
                ]
            }
            Self::Rectangle { lower, upper } => {
                let mut handles = vec![named("Centre", 0.5 * (*lower + *upper))];
                handles.extend(
                    corners(*lower, *upper)
                        .into_iter()
                        .enumerate()
                        .map(|(i, at)| (format!("Corner {i}"), at)),
                );
                handles
            }
            Self::HalfPlane { point, normal } => {
                vec![named("Point", *point), named("Normal", *point + *normal)]
            }
            Self::Polygon { vertices } => {
                let mut handles = vec![named("Middle", middle(vertices))];
                handles.extend(vertices.iter().enumerate().map(|(i, at)| (format!("Vertex {i}"), *at)));
                handles
            }
        }
    }

    /// The shape after its handle `index` has been dragged to `to`; the same for an index beyond its handles.
    #[must_use]
    pub fn with_handle(&self, index: usize, to: DVec2) -> Self {
        let mut shape = self.clone();
        match (&mut shape, index) {
            (Self::Disc { center, .. } | Self::Ellipse { center, .. }, 0) => *center = to,
            (Self::Disc { center, radius }, 1) => *radius = center.distance(to),
            (Self::Ellipse { center, half_axes, angle }, 1) => {
                half_axes.x = center.distance(to);
                *angle = (to - *center).to_angle();
            }
            (Self::Ellipse { center, half_axes, angle }, 2) => {
                half_axes.y = center.distance(to);
                *angle = (to - *center).to_angle() - FRAC_PI_2;
            }
            (Self::Rectangle { lower, upper }, 0) => {
                let half = 0.5 * (*upper - *lower);
                (*lower, *upper) = (to - half, to + half);
            }
            (Self::Rectangle { lower, upper }, 1..=4) => {
                let opposite = corners(*lower, *upper)[(index + 1) % 4];
                (*lower, *upper) = (to.min(opposite), to.max(opposite));
            }
            (Self::HalfPlane { point, .. }, 0) => *point = to,
            (Self::HalfPlane { point, normal }, 1) => *normal = to - *point,
            (Self::Polygon { vertices }, 0) => {
                let shift = to - middle(vertices);
                vertices.iter_mut().for_each(|vertex| *vertex += shift);
            }
            (Self::Polygon { vertices }, _) => {
                if let Some(vertex) = vertices.get_mut(index - 1) {
                    *vertex = to;
                }
            }
            _ => {}
        }
        shape
    }
}

/// A box around what the parts make, with infinite sides where it is unbounded; empty without parts.
pub(super) fn bounds(parts: &[Part]) -> Bounds {
    let mut whole = Bounds::new(DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (index, part) in parts.iter().enumerate() {
        let own = match &part.shape {
            // Sides are half planes in the core, which knows the box of a slanted one only to be the plane.
            Shape::Polygon { vertices } => Bounds::new(
                vertices.iter().copied().fold(DVec2::INFINITY, DVec2::min),
                vertices.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max),
            ),
            shape => shape.domain().map_or(Bounds::PLANE, |domain| domain.bounds()),
        };
        whole = match part.operation {
            _ if index == 0 => own,
            Operation::Union => whole.hull(&own),
            Operation::Intersection => whole.intersection(&own),
            Operation::Difference => whole,
        };
    }
    whole
}

/// In the order of turn to the left, from the lower left one.
fn corners(lower: DVec2, upper: DVec2) -> [DVec2; 4] {
    [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)]
}

fn middle(vertices: &[DVec2]) -> DVec2 {
    vertices.iter().sum::<DVec2>() / vertices.len().max(1) as f64
}

/// What the parts make, joined in order.
///
/// # Errors
///
/// Index of a part that is no region, and why.
pub(super) fn joined(parts: &[Part]) -> Result<Option<Domain>, (usize, DomainError)> {
    let mut whole: Option<Domain> = None;
    for (index, part) in parts.iter().enumerate() {
        let next = part.shape.domain().map_err(|error| (index, error))?;
        whole = Some(match (whole, part.operation) {
            (None, _) => next,
            (Some(whole), Operation::Union) => whole.union(next),
            (Some(whole), Operation::Intersection) => whole.intersection(next),
            (Some(whole), Operation::Difference) => whole.difference(next),
        });
    }
    Ok(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<Shape> {
        let at = DVec2::new;
        vec![
            Shape::Disc { center: at(1.0, 2.0), radius: 0.5 },
            Shape::Ellipse { center: at(-1.0, 0.5), half_axes: at(2.0, 0.75), angle: 0.3 },
            Shape::Rectangle { lower: at(-1.0, -2.0), upper: at(3.0, 1.0) },
            Shape::HalfPlane { point: at(0.0, 1.0), normal: at(0.6, 0.8) },
            Shape::Polygon { vertices: vec![at(0.0, 0.0), at(2.0, 0.0), at(1.0, 3.0)] },
        ]
    }

    #[test]
    fn every_handle_follows_the_pointer_and_stays_where_it_is_put() {
        for shape in shapes() {
            for (index, (name, at)) in shape.handles().into_iter().enumerate() {
                assert!(
                    shape.with_handle(index, at).handles()[index].1.distance(at) < 1e-12,
                    "{name} at rest"
                );
                let to = at + DVec2::new(0.25, 0.125);
                let now = shape.with_handle(index, to).handles()[index].1;
                let follows = match (&shape, index) {
                    // The radius handle stands to the right of the centre.
                    (Shape::Disc { center, .. }, 1) => {
                        (now.distance(*center) - to.distance(*center)).abs() < 1e-12
                    }
                    _ => now.distance(to) < 1e-12,
                };
                assert!(follows, "{name} of the {}: {now} instead of {to}", shape.word());
            }
            assert_eq!(shape.with_handle(99, DVec2::ZERO), shape, "no such handle");
        }
    }

    #[test]
    fn the_opposite_corner_of_a_rectangle_stays() {
        let rectangle = &shapes()[2];
        let opposite = DVec2::new(3.0, 1.0);
        let moved = rectangle.with_handle(1, DVec2::new(5.0, 4.0));
        assert_eq!(
            moved,
            Shape::Rectangle { lower: opposite, upper: DVec2::new(5.0, 4.0) },
            "dragged across the opposite corner"
        );
    }

    #[test]
    fn operations_are_carried_out_in_order() {
        let disc = |x: f64| Shape::Disc { center: DVec2::new(x, 0.0), radius: 1.0 };
        let part = |operation, shape| Part { operation, shape };
        let inside = |parts: &[Part], x: f64| joined(parts).unwrap().unwrap().contains(DVec2::new(x, 0.0));
        let (a, b) = (disc(0.0), disc(1.0));
        for (operation, expected) in [
            (Operation::Union, [true, true, true]),
            (Operation::Intersection, [false, true, false]),
            (Operation::Difference, [true, false, false]),
        ] {
            let parts = [part(Operation::Difference, a.clone()), part(operation, b.clone())];
            let found = [-0.5, 0.5, 1.5].map(|x| inside(&parts, x));
            assert_eq!(found, expected, "{operation:?}");
        }
        assert!(joined(&[]).unwrap().is_none(), "no parts");
    }
}
