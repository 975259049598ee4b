//! Area and enclosed volume.
//!
//! `V = ⅓ ∫ r·(r_u × r_v)` by the divergence theorem. A polynomial surface has an integrand of degree `3n − 1` in each direction, for
//! which `⌈3n/2⌉` Gauss points on each knot interval are exact. Course: section 8.2.

use crate::core::bspline::Side;
use crate::core::progress::{Unwatched, Watcher};
use crate::core::quadrature::{GaussRule, gauss_legendre};
use crate::core::surface::curvature::SurfaceJet;
use crate::core::surface::error::SurfaceError;
use crate::core::surface::nurbs_surface::NurbsSurface;

/// Halvings of a cell in the adaptive rules; 2⁻²⁰ of a cell has no influence on the digits shown.
const MAX_DEPTH: usize = 20;

/// Cells that an adaptive rule may use, so that a tolerance below rounding ends with an error.
const MAX_CELLS: usize = 200_000;

/// Relative accuracy of the volume inside a rational surface.
const RATIONAL_VOLUME: f64 = 1e-13;

/// Gaps up to this part of the size count as closed.
const CLOSED: f64 = 1e-12;

type Cell = [(f64, f64); 2];

impl NurbsSurface {
    /// The enclosed volume, positive if `r_u × r_v` points outwards; exact up to rounding for equal weights, else to about 1e-12.
    ///
    /// # Errors
    ///
    /// `OpenBoundary` with the axis unless every direction is periodic, has equal sides, or has sides that shrink to points; `StepLimit`.
    pub fn enclosed_volume(&self) -> Result<f64, SurfaceError> {
        self.enclosed_volume_watched(&Unwatched)
    }

    /// As [`Self::enclosed_volume`] with a watcher, who hears how much of the surface is done.
    ///
    /// # Errors
    ///
    /// As [`Self::enclosed_volume`]; `Stopped`.
    pub fn enclosed_volume_watched(&self, watcher: &dyn Watcher) -> Result<f64, SurfaceError> {
        self.check_closed()?;
        // Distances from a point of the surface, so that far away surfaces do not lose digits.
        let origin = self.points()[0];
        let density = |jet: &SurfaceJet| (jet.point - origin).dot(jet.du.cross(jet.dv)) / 3.0;
        let cells = self.cells();
        if self.is_polynomial() {
            let rules = self.space().degrees().map(|n| rule((3 * n).div_ceil(2)));
            let mut sum = 0.0;
            let count = cells.len() as f64;
            for (done, cell) in cells.into_iter().enumerate() {
                watcher.check(done as f64 / count)?;
                sum += self.integrate_cell(cell, &rules, &density)?;
            }
            return Ok(sum);
        }
        // No rule is exact; one of high degree needs few halvings.
        let rules = self.space().degrees().map(|n| rule(n + 8));
        let tolerance = RATIONAL_VOLUME * self.size().powi(3);
        self.integrate_adaptively(cells, &rules, tolerance, &density, watcher)
    }

    /// The area, with an estimated error below `tolerance`.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if rounding or a singularity keeps the tolerance from being reached.
    pub fn area(&self, tolerance: f64) -> Result<f64, SurfaceError> {
        self.area_watched(tolerance, &Unwatched)
    }

    /// As [`Self::area`] with a watcher, who hears how much of the surface is done.
    ///
    /// # Errors
    ///
    /// As [`Self::area`]; `Stopped`.
    pub fn area_watched(&self, tolerance: f64, watcher: &dyn Watcher) -> Result<f64, SurfaceError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SurfaceError::InvalidTolerance { value: tolerance });
        }
        let rules = self.space().degrees().map(|n| rule(n + 3));
        let density = |jet: &SurfaceJet| jet.du.cross(jet.dv).length();
        self.integrate_adaptively(self.cells(), &rules, tolerance, &density, watcher)
    }

    fn cells(&self) -> Vec<Cell> {
        let [u, v] = self.space().axes().each_ref().map(|axis| axis.breaks());
        let pairs = |breaks: &[f64]| breaks.windows(2).map(|pair| (pair[0], pair[1])).collect::<Vec<_>>();
        let columns = pairs(&v);
        pairs(&u).into_iter().flat_map(|row| columns.iter().map(move |&column| [row, column])).collect()
    }

    fn integrate_cell(
        &self,
        cell: Cell,
        rules: &[GaussRule; 2],
        density: &impl Fn(&SurfaceJet) -> f64,
    ) -> Result<f64, SurfaceError> {
        let mut sum = 0.0;
        for (u, u_weight) in rules[0].on(cell[0].0, cell[0].1) {
            for (v, v_weight) in rules[1].on(cell[1].0, cell[1].1) {
                sum += u_weight * v_weight * density(&self.jet([u, v], [Side::Right; 2])?);
            }
        }
        Ok(sum)
    }

    /// Halves cells in both directions until the four parts agree with the whole.
    fn integrate_adaptively(
        &self,
        cells: Vec<Cell>,
        rules: &[GaussRule; 2],
        tolerance: f64,
        density: &impl Fn(&SurfaceJet) -> f64,
        watcher: &dyn Watcher,
    ) -> Result<f64, SurfaceError> {
        let count = cells.len() as f64;
        let share = tolerance / count;
        let mut done = 0.0;
        let (mut total, mut used) = (0.0, 0);
        let mut open: Vec<(Cell, f64, f64, usize)> = Vec::new();
        for cell in cells {
            open.push((cell, self.integrate_cell(cell, rules, density)?, share, 0));
        }
        while let Some((cell, coarse, share, depth)) = open.pop() {
            watcher.check(done)?;
            used += 1;
            let middle = cell.map(|(a, b)| 0.5 * a + 0.5 * b);
            let mut parts = Vec::with_capacity(4);
            for u in [(cell[0].0, middle[0]), (middle[0], cell[0].1)] {
                for v in [(cell[1].0, middle[1]), (middle[1], cell[1].1)] {
                    parts.push(([u, v], self.integrate_cell([u, v], rules, density)?));
                }
            }
            let fine: f64 = parts.iter().map(|part| part.1).sum();
            let limit = if depth >= MAX_DEPTH { Some(("depth of halving", MAX_DEPTH)) } else { None };
            let limit = limit.or((used > MAX_CELLS).then_some(("number of cells", MAX_CELLS)));
            if (fine - coarse).abs() <= share {
                total += fine;
                done += 0.25_f64.powi(depth as i32) / count;
            } else if let Some((what, limit)) = limit {
                return Err(SurfaceError::StepLimit { what, value: limit + 1, limit });
            } else {
                open.extend(parts.into_iter().map(|(part, value)| (part, value, 0.25 * share, depth + 1)));
            }
        }
        Ok(total)
    }

    fn check_closed(&self) -> Result<(), SurfaceError> {
        let gap = CLOSED * self.size();
        for axis in 0..2 {
            let space = &self.space().axes()[axis];
            if space.is_periodic() {
                continue;
            }
            let ((left, right), other) = (space.parameter_interval(), &self.space().axes()[1 - axis]);
            // As many places on each interval as a difference of rational curves of this degree has zeros.
            let (breaks, count) = (other.breaks(), 2 * other.degree() + 1);
            let place = |pair: &[f64], i: usize| pair[0] + (pair[1] - pair[0]) * (i as f64 / count as f64);
            let places = breaks.windows(2).flat_map(|pair| (0..=count).map(move |i| place(pair, i)));
            let side = |end: f64, t: f64| self.evaluate(if axis == 0 { [end, t] } else { [t, end] });
            let start = other.parameter_interval().0;
            let (first_left, first_right) = (side(left, start)?, side(right, start)?);
            let (mut shrunk, mut equal) = (true, true);
            for t in places {
                let (on_left, on_right) = (side(left, t)?, side(right, t)?);
                shrunk &= on_left.distance(first_left) <= gap && on_right.distance(first_right) <= gap;
                equal &= on_left.distance(on_right) <= gap;
            }
            if !shrunk && !equal {
                return Err(SurfaceError::OpenBoundary { axis });
            }
        }
        Ok(())
    }
}

/// The Gauss rule; the degrees of splines need at most 38 points, far below its limit.
fn rule(count: usize) -> GaussRule {
    gauss_legendre(count).expect("degrees are at least 1 and at most 25")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::samples;
    use glam::{DQuat, DVec3};
    use std::f64::consts::PI;

    #[test]
    fn the_volume_survives_insertion_and_motion_and_changes_sign_with_a_parameter() {
        let torus: NurbsSurface = samples::torus().into();
        let rotation = DQuat::from_rotation_x(1.0) * DQuat::from_rotation_z(0.3);
        let moved = torus.transformed(|p| rotation * p + DVec3::new(5.0, -3.0, 1e3)).unwrap();
        for (what, surface, sign) in [
            ("as it is", torus.clone(), -1.0),
            ("with a knot more", torus.insert_knots(0, &[0.3]).unwrap(), -1.0),
            ("moved", moved, -1.0),
            ("reversed", torus.reversed(1).unwrap(), 1.0),
            ("opened", torus.opened(0).unwrap(), -1.0),
        ] {
            let error = surface.enclosed_volume().unwrap() - sign * 200.0 / 9.0;
            assert!(error.abs() < 1e-9, "{what}: off by {error}");
        }
        let stairs: NurbsSurface = samples::helical_staircase().into();
        assert_eq!(stairs.enclosed_volume().unwrap_err().name(), "OpenBoundary", "a staircase is open");
        let tip: NurbsSurface = samples::partially_closed().into();
        assert_eq!(tip.enclosed_volume(), Err(SurfaceError::OpenBoundary { axis: 0 }), "open at u = 3");
    }

    #[test]
    fn the_area_of_a_sphere_octant_is_half_pi() {
        let octant = samples::sphere_octant();
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let error = octant.area(tolerance).unwrap() - 0.5 * PI;
            assert!(error.abs() < tolerance, "tolerance {tolerance}: off by {error}");
        }
        assert_eq!(octant.area(0.0).unwrap_err().name(), "InvalidTolerance", "zero");
        assert_eq!(octant.area(1e-300).unwrap_err().name(), "StepLimit", "below rounding");
    }
}
