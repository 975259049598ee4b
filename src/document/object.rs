//! What a document holds: numbered, named objects.

use std::fmt;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::core::spline_curve::Nurbs;
use crate::document::approximation::Approximation;
use crate::document::display::CurveDisplay;
use crate::document::membrane::{Membrane, MembraneDisplay};
use crate::document::mesh::MeshObject;
use crate::document::surface::SurfaceObject;

/// The number of an object: stable as long as the document lives, never given twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ObjectId(pub u64);

impl fmt::Display for ObjectId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// One object of a document: what it is, its name and whether it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its number.
    pub id: ObjectId,
    /// Its name, one line.
    pub name: String,
    /// Whether it is drawn.
    pub visible: bool,
    /// What it is, and how that is drawn.
    pub content: Content,
}

/// The mathematical object and the choices how it is drawn, together what undo brings back.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A plane curve, open or closed, polynomial or rational.
    Curve {
        /// The curve.
        curve: Nurbs<DVec2>,
        /// How it is drawn.
        display: CurveDisplay,
    },
    /// A spline or NURBS surface.
    Surface(SurfaceObject),
    /// A polygon mesh that is subdivided.
    Mesh(MeshObject),
    /// Data, a function, and methods that approximate them.
    Approximation(Approximation),
    /// A boundary value problem.
    Membrane {
        /// The problem.
        membrane: Membrane,
        /// How it and its solution are drawn.
        display: MembraneDisplay,
    },
}

impl Content {
    /// What it is, in one word as in the file format.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Curve { .. } => "curve",
            Self::Surface(_) => "surface",
            Self::Mesh(_) => "mesh",
            Self::Approximation(_) => "approximation",
            Self::Membrane { .. } => "membrane",
        }
    }

    /// What it is in half a line: `open rational curve of degree 3, 7 control points`.
    pub fn summary(&self) -> String {
        match self {
            Self::Curve { curve, .. } => format!(
                "{} {}curve of degree {}, {} control points",
                if curve.space().is_periodic() { "closed" } else { "open" },
                if curve.is_polynomial() { "" } else { "rational " },
                curve.degree(),
                curve.points().len()
            ),
            Self::Surface(object) => {
                let surface = object.surface();
                let ([m, n], [rows, columns]) = (surface.space().degrees(), surface.shape());
                let rational = if surface.is_polynomial() { "" } else { "rational " };
                format!("{rational}surface of degree ({m}, {n}), {rows} × {columns} control points")
            }
            Self::Mesh(object) => {
                let [v, e, f, _] = object.cage().counts();
                format!("mesh with {v} vertices, {e} edges, {f} faces, level {}", object.level())
            }
            Self::Approximation(approximation) => approximation.summary(),
            Self::Membrane { membrane, .. } => membrane.summary(),
        }
    }

    /// Index into the palette of object colours.
    pub fn color(&self) -> usize {
        match self {
            Self::Curve { display, .. } => display.color,
            Self::Surface(object) => object.display().color,
            Self::Mesh(object) => object.display().color,
            Self::Approximation(approximation) => {
                approximation.methods().first().map_or(0, |method| method.color)
            }
            Self::Membrane { display, .. } => display.color,
        }
    }

    /// Number of its control points or vertices.
    pub fn point_count(&self) -> usize {
        match self {
            Self::Curve { curve, .. } => curve.points().len(),
            Self::Surface(object) => object.surface().points().len(),
            Self::Mesh(object) => object.cage().positions().len(),
            Self::Approximation(approximation) => approximation.len(),
            Self::Membrane { .. } => 0,
        }
    }

    /// Estimated memory in bytes.
    fn byte_size(&self) -> usize {
        match self {
            Self::Curve { curve, .. } => {
                let space = curve.space();
                let numbers =
                    2 * (space.knots().len() + space.evaluation_knots().len()) + 6 * curve.points().len();
                numbers * size_of::<f64>()
            }
            // Point, weight and their product.
            Self::Surface(object) => 8 * object.surface().points().len() * size_of::<f64>(),
            Self::Mesh(object) => {
                let [v, e, f, _] = object.cage().counts().map(|count| usize::try_from(count).unwrap_or(0));
                24 * (v + e) + 32 * f
            }
            Self::Approximation(approximation) => approximation.byte_size(),
            Self::Membrane { membrane, .. } => membrane.byte_size(),
        }
    }
}

impl Object {
    /// The curve, if the object is one.
    pub fn curve(&self) -> Option<&Nurbs<DVec2>> {
        match &self.content {
            Content::Curve { curve, .. } => Some(curve),
            _ => None,
        }
    }

    /// The surface, if the object is one.
    pub fn surface(&self) -> Option<&SurfaceObject> {
        match &self.content {
            Content::Surface(surface) => Some(surface),
            _ => None,
        }
    }

    /// The mesh, if the object is one.
    pub fn mesh(&self) -> Option<&MeshObject> {
        match &self.content {
            Content::Mesh(mesh) => Some(mesh),
            _ => None,
        }
    }

    /// How the curve is drawn, if the object is one.
    pub fn curve_display(&self) -> Option<&CurveDisplay> {
        match &self.content {
            Content::Curve { display, .. } => Some(display),
            _ => None,
        }
    }

    /// The approximation, if the object is one.
    pub fn approximation(&self) -> Option<&Approximation> {
        match &self.content {
            Content::Approximation(approximation) => Some(approximation),
            _ => None,
        }
    }

    /// The boundary value problem and how it is drawn, if the object is one.
    pub fn membrane(&self) -> Option<(&Membrane, &MembraneDisplay)> {
        match &self.content {
            Content::Membrane { membrane, display } => Some((membrane, display)),
            _ => None,
        }
    }

    /// Estimated memory in bytes.
    pub(in crate::document) fn byte_size(&self) -> usize {
        size_of::<Self>() + self.name.len() + self.content.byte_size()
    }
}
