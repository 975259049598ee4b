//! A spline or NURBS surface in a document, and how it is shown.

use std::collections::BTreeSet;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::core::surface::NurbsSurface;
use crate::document::apply::check_point_count;
use crate::document::edit::MAX_EDIT_DEGREE;
use crate::document::edit_error::EditError;

/// What colours on a surface tell. Curvatures are positive where the surface bends towards its normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceColoring {
    /// Nothing: one colour, in the light.
    #[default]
    Plain,
    /// `K = κ₁ κ₂`.
    Gaussian,
    /// `H = (κ₁ + κ₂)/2`.
    Mean,
    /// `κ₁`, the smaller principal curvature.
    LeastPrincipal,
    /// `κ₂`, the larger principal curvature.
    GreatestPrincipal,
}

impl SurfaceColoring {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 5] =
        [Self::Plain, Self::Gaussian, Self::Mean, Self::LeastPrincipal, Self::GreatestPrincipal];

    /// Name as shown to people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "one colour",
            Self::Gaussian => "Gaussian curvature",
            Self::Mean => "mean curvature",
            Self::LeastPrincipal => "smaller principal curvature",
            Self::GreatestPrincipal => "larger principal curvature",
        }
    }

    /// The quantity of Gaussian curvature `gaussian` and principal curvatures `principal`; `None` for [`Self::Plain`].
    pub fn value(self, gaussian: f64, principal: [f64; 2]) -> Option<f64> {
        match self {
            Self::Plain => None,
            Self::Gaussian => Some(gaussian),
            Self::Mean => Some(0.5 * (principal[0] + principal[1])),
            Self::LeastPrincipal => Some(principal[0]),
            Self::GreatestPrincipal => Some(principal[1]),
        }
    }
}

/// What is drawn of a surface, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SurfaceDisplay {
    /// Index into the palette of object colours; a palette with `N` entries uses `color mod N`.
    pub color: usize,
    /// The control net with its points.
    pub net: bool,
    /// The lines on the surface at the knots.
    pub knot_lines: bool,
    /// Further parameter lines in every knot interval, up to [`Self::MAX_ISOLINES`].
    pub isolines: usize,
    /// Normals on a grid.
    pub normals: bool,
    /// What the colours tell.
    pub coloring: SurfaceColoring,
    /// Largest value of the colour scale, which reaches as far below 0; 0 lets the values decide.
    pub color_limit: f64,
    /// Pieces of the drawn surface in every knot interval and direction, from 1 to [`Self::MAX_DENSITY`].
    pub density: usize,
}

impl Default for SurfaceDisplay {
    fn default() -> Self {
        Self {
            color: 0,
            net: true,
            knot_lines: true,
            isolines: 0,
            normals: false,
            coloring: SurfaceColoring::Plain,
            color_limit: 0.0,
            density: 12,
        }
    }
}

impl SurfaceDisplay {
    /// Most lines between two knots.
    pub const MAX_ISOLINES: usize = 20;
    /// Most pieces between two knots.
    pub const MAX_DENSITY: usize = 100;

    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// `BadDisplay` with the name of the field, its value and the range.
    pub fn check(&self) -> Result<(), EditError> {
        check_ranges([
            ("isolines", self.isolines as f64, 0.0..=Self::MAX_ISOLINES as f64),
            ("color_limit", self.color_limit, 0.0..=f64::MAX),
            ("density", self.density as f64, 1.0..=Self::MAX_DENSITY as f64),
        ])
    }
}

/// The first number of a display that is out of its range.
pub(in crate::document) fn check_ranges<const N: usize>(
    fields: [(&'static str, f64, std::ops::RangeInclusive<f64>); N],
) -> Result<(), EditError> {
    for (field, value, range) in fields {
        if !range.contains(&value) {
            return Err(EditError::BadDisplay { field, value, low: *range.start(), high: *range.end() });
        }
    }
    Ok(())
}

/// A surface with its display. Control points are numbered row by row, as [`NurbsSurface::points`] has them.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceObject {
    surface: NurbsSurface,
    display: SurfaceDisplay,
}

impl SurfaceObject {
    /// Most triangles of the drawn surface.
    pub const MAX_TRIANGLES: usize = 2_000_000;

    /// The surface, shown like this.
    ///
    /// # Errors
    ///
    /// `BadDisplay`; `TooMany` control points or triangles.
    pub fn new(surface: NurbsSurface, display: SurfaceDisplay) -> Result<Self, EditError> {
        display.check()?;
        check_point_count(surface.points().len())?;
        let pieces = surface.space().axes().each_ref().map(|axis| axis.breaks().len() - 1);
        let value = pieces.iter().fold(2 * display.density * display.density, |n, &p| n.saturating_mul(p));
        if value > Self::MAX_TRIANGLES {
            return Err(EditError::TooMany { what: "triangles", value, limit: Self::MAX_TRIANGLES });
        }
        Ok(Self { surface, display })
    }

    /// The surface.
    pub fn surface(&self) -> &NurbsSurface {
        &self.surface
    }

    /// How it is shown.
    pub fn display(&self) -> &SurfaceDisplay {
        &self.display
    }

    /// Another surface, shown in the same way.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_surface(&self, surface: NurbsSurface) -> Result<Self, EditError> {
        Self::new(surface, self.display.clone())
    }

    /// The same surface, shown differently.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_display(&self, display: SurfaceDisplay) -> Result<Self, EditError> {
        Self::new(self.surface.clone(), display)
    }

    /// Some control points moved by the same vector; numbers of points that are not there are ignored.
    ///
    /// # Errors
    ///
    /// `NonFinite` if a coordinate overflows.
    pub fn moved(&self, points: &BTreeSet<usize>, delta: DVec3) -> Result<Self, EditError> {
        let mut all = self.surface.points().to_vec();
        all.iter_mut().enumerate().filter(|(k, _)| points.contains(k)).for_each(|(_, point)| *point += delta);
        self.with_net(all, self.surface.weights().to_vec())
    }

    /// Some weights replaced.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive`, `NonFinite`.
    pub fn with_weights(&self, points: &BTreeSet<usize>, weight: f64) -> Result<Self, EditError> {
        let mut all = self.surface.weights().to_vec();
        all.iter_mut().enumerate().filter(|(k, _)| points.contains(k)).for_each(|(_, old)| *old = weight);
        self.with_net(self.surface.points().to_vec(), all)
    }

    /// The same surface with one more knot in direction `axis` (0: u, 1: v).
    ///
    /// # Errors
    ///
    /// `OutsideInterval`, `KnotMultiplicityTooHigh`, `TooMany`.
    pub fn with_knot(&self, axis: usize, at: f64) -> Result<Self, EditError> {
        self.with_surface(self.surface.insert_knots(axis, &[at])?)
    }

    /// The same surface with a knot more in the middle of every interval of direction `axis`.
    ///
    /// # Errors
    ///
    /// `TooMany`.
    pub fn refined(&self, axis: usize) -> Result<Self, EditError> {
        let breaks =
            self.surface.space().axis(axis).map_err(crate::core::surface::SurfaceError::from)?.breaks();
        check_point_count(2 * self.surface.points().len())?;
        let middles: Vec<f64> = breaks.windows(2).map(|pair| 0.5 * pair[0] + 0.5 * pair[1]).collect();
        self.with_surface(self.surface.insert_knots(axis, &middles)?)
    }

    /// The same surface with the degree of direction `axis` raised by one.
    ///
    /// # Errors
    ///
    /// `DegreeOutsideWindow`, `TooMany`.
    pub fn elevated(&self, axis: usize) -> Result<Self, EditError> {
        let degree = self.surface.space().degrees().get(axis).map_or(0, |degree| degree + 1);
        if degree > MAX_EDIT_DEGREE {
            return Err(EditError::DegreeOutsideWindow { degree });
        }
        self.with_surface(self.surface.elevate_degree(axis)?)
    }

    /// The same surface with direction `axis` run backwards, which turns the normals.
    ///
    /// # Errors
    ///
    /// None is known to occur.
    pub fn reversed(&self, axis: usize) -> Result<Self, EditError> {
        self.with_surface(self.surface.reversed(axis)?)
    }

    fn with_net(&self, points: Vec<DVec3>, weights: Vec<f64>) -> Result<Self, EditError> {
        self.with_surface(NurbsSurface::new(self.surface.space().clone(), points, weights)?)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::samples;

    fn torus() -> SurfaceObject {
        SurfaceObject::new(samples::torus().into(), SurfaceDisplay::default()).unwrap()
    }

    #[test]
    fn inserting_knots_and_raising_degrees_keep_the_surface() {
        let before = torus();
        for after in
            [before.with_knot(0, 0.3).unwrap(), before.refined(1).unwrap(), before.elevated(1).unwrap()]
        {
            assert!(after.surface().points().len() > before.surface().points().len(), "more control points");
            for at in [[0.1, 0.2], [1.7, 3.9], [2.5, 0.0]] {
                let (a, b) = (before.surface().evaluate(at).unwrap(), after.surface().evaluate(at).unwrap());
                assert!(a.distance(b) < 1e-13, "{a} became {b} at {at:?}");
            }
        }
    }

    #[test]
    fn only_the_named_points_move() {
        let (before, moved) = (torus(), torus().moved(&BTreeSet::from([3, 99]), DVec3::X).unwrap());
        for (k, (a, b)) in before.surface().points().iter().zip(moved.surface().points()).enumerate() {
            assert_eq!(*b - *a, if k == 3 { DVec3::X } else { DVec3::ZERO }, "point {k}");
        }
    }

    #[test]
    fn impossible_wishes_are_refused_by_name() {
        let torus = torus();
        let named = |result: Result<SurfaceObject, EditError>| result.unwrap_err().name();
        assert_eq!(named(torus.with_weights(&BTreeSet::from([0]), -1.0)), "WeightNotPositive", "weight");
        assert_eq!(named(torus.moved(&BTreeSet::from([0]), DVec3::NAN)), "NonFinite", "point");
        assert_eq!(named(torus.with_knot(7, 0.5)), "SizeMismatch", "direction");
        let display = SurfaceDisplay { density: 0, ..SurfaceDisplay::default() };
        assert_eq!(named(torus.with_display(display)), "BadDisplay", "density");
        let display = SurfaceDisplay { color_limit: f64::NAN, ..SurfaceDisplay::default() };
        assert_eq!(named(torus.with_display(display)), "BadDisplay", "limit");
    }
}
