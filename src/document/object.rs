//! What a document holds: numbered, named objects.

use std::fmt;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::core::spline_curve::Nurbs;
use crate::document::display::CurveDisplay;

/// The number of an object: stable as long as the document lives, never given twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ObjectId(pub u64);

impl fmt::Display for ObjectId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// One object of a document: what it is, its name and how it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its number.
    pub id: ObjectId,
    /// Its name, one line.
    pub name: String,
    /// Whether it is drawn.
    pub visible: bool,
    /// How it is drawn.
    pub display: CurveDisplay,
    /// What it is.
    pub content: Content,
}

/// The mathematical object.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A plane curve, open or closed, polynomial or rational.
    Curve(Nurbs<DVec2>),
}

impl Object {
    /// The curve, if the object is one.
    pub fn curve(&self) -> Option<&Nurbs<DVec2>> {
        let Content::Curve(curve) = &self.content;
        Some(curve)
    }

    /// Estimated memory in bytes.
    pub(in crate::document) fn byte_size(&self) -> usize {
        let Content::Curve(curve) = &self.content;
        let space = curve.space();
        let numbers = 2 * (space.knots().len() + space.evaluation_knots().len()) + 6 * curve.points().len();
        size_of::<Self>() + self.name.len() + numbers * size_of::<f64>()
    }
}
