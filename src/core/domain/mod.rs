//! Plane domains: half planes, discs, ellipses, implicit regions, and what Boolean operations make of them.
//!
//! | file | what |
//! |---|---|
//! | `bounds` | boxes with sides parallel to the axes |
//! | `primitive` | one region with one boundary curve: half plane, ellipse, implicit region |
//! | `boolean` | the tree of complements, unions and intersections |
//! | `polygon` | polygons as trees of half planes |
//!
//! A domain is an open set; its boundary belongs to neither side. Levels are positive inside, negative outside.
//!
//! Course: sections 9.2 and 9.4.

mod boolean;
mod bounds;
mod error;
mod polygon;
mod primitive;

pub use boolean::Domain;
pub use bounds::{Bounds, CellClass};
pub use error::DomainError;
pub use primitive::{Jet, Primitive};
