//! A boundary value problem: where, which equation, how it is discretised, and how its solution is shown.
//!
//! `−a Δu + c u = f` on a plane domain made of primitives (weighted B-splines, `u = 0` on the whole boundary) or on one patch
//! (isogeometric elements, `u = 0` on the fixed sides); or the potential flow through a channel.
//! Course: sections 9.1, 9.2, 9.3 and 9.5.

mod display;
mod error;
mod part;
mod presets;

use glam::DVec2;

use crate::core::domain::{Bounds, Domain};
use crate::core::finite_element::{PatchSide, PlanePatch};
use crate::core::formula::Formula;

pub use display::{FieldColors, MembraneDisplay, Shown};
pub use error::MembraneError;
pub use part::{Operation, Part, Shape};
pub use presets::MembranePreset;

/// Names of the coordinates in formulas.
pub const VARIABLES: [&str; 2] = ["x", "y"];

/// Limits of what a document may hold; what they allow can be solved in seconds.
pub(in crate::document) const MAX_PARTS: usize = 40;
const MAX_VERTICES: usize = 400;
pub(in crate::document) const MAX_PATCH_POINTS: usize = 900;
const MAX_PATCH_DEGREE: usize = 8;
const MAX_FORMULA: usize = 2000;
const MAX_DIVISIONS: f64 = 128.0;

/// A boundary value problem; valid by construction.
#[derive(Clone, Debug, PartialEq)]
pub struct Membrane {
    setting: Setting,
}

/// The numbers of a [`Membrane`].
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Where, and how fine.
    pub region: Region,
    /// Degree of the splines, 1 to 5.
    pub degree: usize,
    /// The load `f`, in x and y.
    pub load: Formula,
    /// A known solution for the study of errors, in x and y; the load of the study follows from it.
    pub exact: Option<Formula>,
    /// The coefficient `a > 0`.
    pub diffusion: f64,
    /// The coefficient `c ≥ 0`.
    pub reaction: f64,
}

/// Where a problem is posed.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// A domain made of primitives, joined in order, on a grid.
    Parts {
        /// The primitives.
        parts: Vec<Part>,
        /// The grid width `h`.
        width: f64,
    },
    /// One patch.
    Patch {
        /// The geometry.
        patch: PlanePatch,
        /// Whether `u = 0` on each side, in the order of [`PatchSide::ALL`].
        fixed: [bool; 4],
        /// Parts of every knot interval of the patch, `1/h`.
        divisions: usize,
    },
    /// A channel through which a fluid flows from the left side to the right one.
    Channel {
        /// The geometry.
        patch: PlanePatch,
        /// Normal speed at the left side; the right one balances it.
        inflow: f64,
        /// Parts of every knot interval of the patch, `1/h`.
        divisions: usize,
    },
}

/// Something that is dragged: a handle of a part, or a control point of the patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HandleId {
    /// Index of the part; 0 for a patch.
    pub part: usize,
    /// Index of the part's handle, or of the control point.
    pub index: usize,
}

impl Membrane {
    /// The problem with these numbers.
    ///
    /// # Errors
    ///
    /// [`MembraneError`] with the number that is impossible.
    pub fn new(setting: Setting) -> Result<Self, MembraneError> {
        let range = |what, value: f64, low: f64, high: f64| {
            if value >= low && value <= high {
                Ok(())
            } else {
                Err(MembraneError::OutOfRange { what, value, low, high })
            }
        };
        range("degree", setting.degree as f64, 1.0, 5.0)?;
        range("coefficient a", setting.diffusion, 1e-9, 1e9)?;
        range("coefficient c", setting.reaction, 0.0, 1e9)?;
        for formula in [Some(&setting.load), setting.exact.as_ref()].into_iter().flatten() {
            at_most("characters of a formula", formula.text().len(), MAX_FORMULA)?;
        }
        match &setting.region {
            Region::Parts { parts, width } => {
                range("grid width", *width, 1e-9, 1e9)?;
                at_most("parts", parts.len(), MAX_PARTS)?;
                let vertices = |part: &Part| match &part.shape {
                    Shape::Polygon { vertices } => vertices.len(),
                    _ => 0,
                };
                at_most("vertices", parts.iter().map(vertices).sum(), MAX_VERTICES)?;
                part::joined(parts).map_err(|(part, source)| MembraneError::Part { part, source })?;
            }
            Region::Patch { patch, divisions, .. } => {
                check_patch(patch)?;
                range("number of divisions", *divisions as f64, 1.0, MAX_DIVISIONS)?;
            }
            Region::Channel { patch, inflow, divisions } => {
                check_patch(patch)?;
                range("number of divisions", *divisions as f64, 1.0, MAX_DIVISIONS)?;
                range("speed of the inflow", *inflow, -1e9, 1e9)?;
            }
        }
        Ok(Self { setting })
    }

    /// Its numbers.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// The problem after `change`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with(&self, change: impl FnOnce(&mut Setting)) -> Result<Self, MembraneError> {
        let mut setting = self.setting.clone();
        change(&mut setting);
        Self::new(setting)
    }

    /// The domain made of the parts; `None` without parts or on a patch.
    pub fn domain(&self) -> Option<Domain> {
        match &self.setting.region {
            Region::Parts { parts, .. } => part::joined(parts).ok().flatten(),
            _ => None,
        }
    }

    /// A box around the domain made of the parts, with infinite sides where it is unbounded; empty without parts.
    pub fn domain_bounds(&self) -> Bounds {
        part::bounds(self.parts())
    }

    /// The parts, in order; none on a patch.
    pub fn parts(&self) -> &[Part] {
        match &self.setting.region {
            Region::Parts { parts, .. } => parts,
            _ => &[],
        }
    }

    /// The patch; `None` for a domain made of parts.
    pub fn patch(&self) -> Option<&PlanePatch> {
        match &self.setting.region {
            Region::Parts { .. } => None,
            Region::Patch { patch, .. } | Region::Channel { patch, .. } => Some(patch),
        }
    }

    /// The problem after `change` of its parts; on a patch nothing changes.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_parts(&self, change: impl FnOnce(&mut Vec<Part>)) -> Result<Self, MembraneError> {
        self.with(|setting| {
            if let Region::Parts { parts, .. } = &mut setting.region {
                change(parts);
            }
        })
    }

    /// The problem on another patch; nothing changes for a domain made of parts.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_patch(&self, new: PlanePatch) -> Result<Self, MembraneError> {
        self.with(|setting| match &mut setting.region {
            Region::Parts { .. } => {}
            Region::Patch { patch, .. } | Region::Channel { patch, .. } => *patch = new,
        })
    }

    /// The problem with another weight of control point `index` of its patch.
    ///
    /// # Errors
    ///
    /// `Missing`; those of [`PlanePatch::new`].
    pub fn with_weight(&self, index: usize, weight: f64) -> Result<Self, MembraneError> {
        let missing = MembraneError::Missing { what: "control point", index };
        let patch = self.patch().ok_or(missing.clone())?;
        let mut weights = patch.weights().to_vec();
        *weights.get_mut(index).ok_or(missing)? = weight;
        self.with_patch(PlanePatch::new(patch.spaces().clone(), patch.points().to_vec(), weights)?)
    }

    /// The sides with `u = 0`; all four for a domain made of parts, where it is the whole boundary.
    pub fn fixed_sides(&self) -> Vec<PatchSide> {
        match &self.setting.region {
            Region::Parts { .. } => PatchSide::ALL.to_vec(),
            Region::Patch { fixed, .. } => PatchSide::ALL
                .into_iter()
                .zip(fixed)
                .filter(|(_, fixed)| **fixed)
                .map(|(side, _)| side)
                .collect(),
            Region::Channel { .. } => Vec::new(),
        }
    }

    /// Everything that can be dragged, with its name and place.
    pub fn handles(&self) -> Vec<(HandleId, String, DVec2)> {
        if let Some(patch) = self.patch() {
            let points = patch.points().iter().enumerate();
            return points
                .map(|(index, at)| (HandleId { part: 0, index }, format!("Control point {index}"), *at))
                .collect();
        }
        let parts = self.parts().iter().enumerate();
        parts
            .flat_map(|(part, found)| {
                let named = move |(index, (name, at)): (usize, (String, DVec2))| {
                    let name = format!("{name} of {} {}", found.shape.word(), part + 1);
                    (HandleId { part, index }, name, at)
                };
                found.shape.handles().into_iter().enumerate().map(named)
            })
            .collect()
    }

    /// Where a handle is.
    pub fn handle(&self, id: HandleId) -> Option<DVec2> {
        match self.patch() {
            Some(patch) => patch.points().get(id.index).copied().filter(|_| id.part == 0),
            None => self.parts().get(id.part)?.shape.handles().get(id.index).map(|(_, at)| *at),
        }
    }

    /// The problem after handles have been dragged by `delta`; a part of which the first handle is among them moves as a
    /// whole.
    ///
    /// # Errors
    ///
    /// `Missing` for a handle that does not exist; as [`Self::new`].
    pub fn with_moved_handles(&self, handles: &[HandleId], delta: DVec2) -> Result<Self, MembraneError> {
        if let Some(patch) = self.patch() {
            let mut points = patch.points().to_vec();
            for &HandleId { index, .. } in handles {
                *points.get_mut(index).ok_or(MembraneError::Missing { what: "control point", index })? +=
                    delta;
            }
            let patch = PlanePatch::new(patch.spaces().clone(), points, patch.weights().to_vec())?;
            return self.with_patch(patch);
        }
        let mut parts = self.parts().to_vec();
        for &HandleId { part, index } in handles {
            let whole = HandleId { part, index: 0 };
            if index > 0 && handles.contains(&whole) {
                continue;
            }
            let missing = MembraneError::Missing { what: "part", index: part };
            let found = parts.get_mut(part).ok_or(missing)?;
            let missing = MembraneError::Missing { what: "handle", index };
            let at = found.shape.handles().get(index).ok_or(missing)?.1;
            found.shape = found.shape.with_handle(index, at + delta);
        }
        self.with_parts(|old| *old = parts)
    }

    /// A box around what is drawn: the domain, or the points of the patch.
    pub fn bounding_box(&self) -> Option<(DVec2, DVec2)> {
        let hull = |points: &mut dyn Iterator<Item = DVec2>| {
            points.fold(None, |found: Option<(DVec2, DVec2)>, point| {
                Some(found.map_or((point, point), |(low, high)| (low.min(point), high.max(point))))
            })
        };
        if let Some(patch) = self.patch() {
            return hull(&mut patch.points().iter().copied());
        }
        let bounds = self.domain_bounds();
        if bounds.is_finite() && bounds.size().min_element() > 0.0 {
            return Some((bounds.lower, bounds.upper));
        }
        hull(&mut self.handles().into_iter().map(|(_, _, at)| at))
    }

    /// What it is in half a line.
    pub fn summary(&self) -> String {
        let degree = self.setting.degree;
        match &self.setting.region {
            Region::Parts { parts, width } => {
                let count = parts.len();
                let noun = if count == 1 { "part" } else { "parts" };
                format!("domain of {count} {noun}, weighted B-splines of degree {degree}, h = {width}")
            }
            Region::Patch { divisions, .. } => {
                format!("patch, isogeometric elements of degree {degree}, h = 1/{divisions}")
            }
            Region::Channel { divisions, .. } => {
                format!("flow through a channel, isogeometric elements of degree {degree}, h = 1/{divisions}")
            }
        }
    }

    /// Estimated memory in bytes.
    pub(in crate::document) fn byte_size(&self) -> usize {
        let points = self.patch().map_or(0, |patch| 8 * patch.points().len());
        let vertices: usize = self.parts().iter().map(|part| 16 + part.shape.handles().len()).sum();
        size_of::<Self>() + 16 * (points + vertices) + 40 * self.setting.load.text().len()
    }
}

/// Reads a formula in x and y; `what` names it in the error.
///
/// # Errors
///
/// `Formula` with the character where reading stopped.
pub fn read_formula(text: &str, what: &'static str) -> Result<Formula, MembraneError> {
    at_most("characters of a formula", text.len(), MAX_FORMULA)?;
    Formula::parse(text, &VARIABLES).map_err(|source| MembraneError::Formula { what, source })
}

fn at_most(what: &'static str, value: usize, limit: usize) -> Result<(), MembraneError> {
    if value > limit { Err(MembraneError::TooMany { what, value, limit }) } else { Ok(()) }
}

fn check_patch(patch: &PlanePatch) -> Result<(), MembraneError> {
    at_most("control points", patch.points().len(), MAX_PATCH_POINTS)?;
    for space in patch.spaces() {
        let (value, high) = (space.degree() as f64, MAX_PATCH_DEGREE as f64);
        if value > high {
            return Err(MembraneError::OutOfRange { what: "degree of the patch", value, low: 1.0, high });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dragging_a_whole_part_and_its_radius_moves_it_once() {
        let membrane = MembranePreset::Ring.membrane();
        let handles = [HandleId { part: 0, index: 0 }, HandleId { part: 0, index: 1 }];
        let delta = DVec2::new(0.5, -0.25);
        let moved = membrane.with_moved_handles(&handles, delta).unwrap();
        assert_eq!(moved.handle(handles[0]).unwrap(), membrane.handle(handles[0]).unwrap() + delta, "centre");
        assert_eq!(moved.handle(handles[1]).unwrap(), membrane.handle(handles[1]).unwrap() + delta, "radius");
        let missing = membrane.with_moved_handles(&[HandleId { part: 9, index: 0 }], delta).unwrap_err();
        assert_eq!(missing.name(), "Missing", "part 9");
    }

    #[test]
    fn impossible_numbers_are_refused_with_their_names() {
        let membrane = MembranePreset::Mushroom.membrane();
        let refused = |change: fn(&mut Setting)| membrane.with(change).unwrap_err().to_string();
        assert!(refused(|s| s.degree = 0).contains("degree is 0"), "degree 0");
        assert!(refused(|s| s.degree = 6).contains("degree is 6"), "degree 6");
        assert!(refused(|s| s.diffusion = f64::NAN).contains("coefficient a is NaN"), "NaN");
        assert!(refused(|s| s.reaction = -1.0).contains("coefficient c is -1"), "negative");
        let bad =
            |radius| Part { operation: Operation::Union, shape: Shape::Disc { center: DVec2::ZERO, radius } };
        let error = membrane.with_parts(|parts| parts.push(bad(-1.0))).unwrap_err();
        assert!(error.to_string().starts_with("part 4:"), "{error}");
        let many = membrane.with_parts(|parts| parts.extend((0..50).map(|_| bad(1.0)))).unwrap_err();
        assert_eq!(many.name(), "TooMany", "{many}");
        let error = read_formula("1 + sin", "load").unwrap_err();
        assert!(error.to_string().starts_with("load: at character"), "{error}");
    }

    #[test]
    fn every_preset_is_drawn_somewhere_and_has_handles() {
        for preset in MembranePreset::ALL {
            let membrane = preset.membrane();
            let (low, high) = membrane.bounding_box().expect("a box");
            assert!((high - low).min_element() > 0.5, "{}", preset.title());
            for (id, name, at) in membrane.handles() {
                assert_eq!(membrane.handle(id), Some(at), "{name} of {}", preset.title());
            }
        }
    }
}
