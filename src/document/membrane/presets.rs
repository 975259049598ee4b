//! Problems to start with.

use glam::DVec2;

use crate::core::finite_element::sample_geometries;
use crate::document::membrane::{
    Membrane, MembraneDisplay, Operation, Part, Region, Setting, Shape, Shown, read_formula,
};

/// A problem to start with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MembranePreset {
    /// The course's mushroom: half a disc on an ellipse.
    Mushroom,
    /// A disc with a hole.
    Ring,
    /// A disc, with a known solution.
    Disc,
    /// An L-shaped polygon.
    LShape,
    /// The course's patch of degree (1, 2).
    BookPatch,
    /// A quarter of an annulus as a rational patch, with a known solution.
    QuarterAnnulus,
    /// The course's channel, with stream lines.
    Channel,
}

impl MembranePreset {
    /// All of them, in the order of the buttons.
    pub const ALL: [Self; 7] = [
        Self::Mushroom,
        Self::Disc,
        Self::Ring,
        Self::LShape,
        Self::BookPatch,
        Self::QuarterAnnulus,
        Self::Channel,
    ];

    /// The name, also of the object.
    pub fn title(self) -> &'static str {
        match self {
            Self::Mushroom => "Mushroom",
            Self::Ring => "Disc with a hole",
            Self::Disc => "Disc",
            Self::LShape => "L-shape",
            Self::BookPatch => "Patch of degree (1, 2)",
            Self::QuarterAnnulus => "Quarter annulus",
            Self::Channel => "Channel",
        }
    }

    /// What it shows, in a line.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Mushroom => "Half a disc and an ellipse joined by R-functions (section 9.2)",
            Self::Ring => "A membrane held at both circles",
            Self::Disc => "A known solution: errors fall like h\u{207f}\u{207a}\u{00b9}",
            Self::LShape => "A polygon with a reentrant corner",
            Self::BookPatch => "Isogeometric elements on one patch, held at one side (section 9.3)",
            Self::QuarterAnnulus => "A rational patch with a known solution",
            Self::Channel => "Potential flow with stream lines (section 9.5)",
        }
    }

    /// How it is shown in the beginning.
    pub fn display(self) -> MembraneDisplay {
        let plain = MembraneDisplay::default();
        match self {
            Self::Mushroom => MembraneDisplay { nodes: true, cells: true, ..plain },
            Self::Channel => MembraneDisplay { shown: Shown::Slope, isolines: 0, stream_lines: 12, ..plain },
            _ => plain,
        }
    }

    /// The problem.
    pub fn membrane(self) -> Membrane {
        let at = DVec2::new;
        let disc = |x: f64, y: f64, radius: f64| Shape::Disc { center: at(x, y), radius };
        let part = |operation, shape| Part { operation, shape };
        let on_parts = |parts: Vec<Part>, width: f64| Region::Parts { parts, width };
        let on_patch = |patch, fixed| Region::Patch { patch, fixed, divisions: 8 };
        let (region, load, exact) = match self {
            Self::Mushroom => {
                let cap = part(Operation::Union, disc(0.0, 0.0, 2.0));
                let half = Shape::HalfPlane { point: DVec2::ZERO, normal: at(0.0, 0.8) };
                let stem = Shape::Ellipse { center: DVec2::ZERO, half_axes: at(1.0, 2.0), angle: 0.0 };
                let parts = vec![cap, part(Operation::Intersection, half), part(Operation::Union, stem)];
                (on_parts(parts, 0.25), "1", None)
            }
            Self::Ring => {
                let parts = vec![
                    part(Operation::Union, disc(0.0, 0.0, 1.5)),
                    part(Operation::Difference, disc(0.4, 0.2, 0.6)),
                ];
                (on_parts(parts, 0.125), "1", None)
            }
            Self::Disc => {
                let parts = vec![part(Operation::Union, disc(0.0, 0.0, 1.0))];
                (on_parts(parts, 0.25), "4", Some("(1 - x^2 - y^2) exp(x - y/2)"))
            }
            Self::LShape => {
                let vertices = vec![
                    at(-1.0, -1.0),
                    at(0.0, -1.0),
                    at(0.0, 0.0),
                    at(1.0, 0.0),
                    at(1.0, 1.0),
                    at(-1.0, 1.0),
                ];
                (on_parts(vec![part(Operation::Union, Shape::Polygon { vertices })], 0.125), "1", None)
            }
            Self::BookPatch => {
                // Held where x = 0.
                (on_patch(sample_geometries::book_patch(), [false, false, true, false]), "1", None)
            }
            Self::QuarterAnnulus => {
                let patch = sample_geometries::quarter_annulus(1.0, 2.0).expect("radii in order");
                let exact = "(x^2 + y^2 - 1) (x^2 + y^2 - 4) x y";
                (on_patch(patch, [true; 4]), "8 x", Some(exact))
            }
            Self::Channel => {
                let region =
                    Region::Channel { patch: sample_geometries::channel(), inflow: 1.0, divisions: 8 };
                (region, "0", None)
            }
        };
        let formula = |text: &str| read_formula(text, "formula").expect("the formulas here can be read");
        let degree = if self == Self::Channel { 3 } else { 2 };
        let setting = Setting {
            region,
            degree,
            load: formula(load),
            exact: exact.map(formula),
            diffusion: 1.0,
            reaction: 0.0,
        };
        Membrane::new(setting).expect("the numbers here make a problem")
    }
}
