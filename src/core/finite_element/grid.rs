//! A grid of equal cells, and the uniform B-splines on it.
//!
//! Cell `l = (l₁, l₂)` is `lower + width·[l, l + 1]`; of degree `n` there are `mᵥ = Nᵥ + n` B-splines in
//! direction ν, and those with `l ≤ k ≤ l + n` do not vanish on cell `l`. Arrays are row-major: `(k₁, k₂)`
//! stands at `k₁ m₂ + k₂`.
//!
//! Course: sections 4.4 and 9.2.

use glam::DVec2;

use crate::core::domain::Bounds;
use crate::core::finite_element::error::FiniteElementError;

/// The largest number of cells in one direction.
pub const MAX_CELLS: usize = 2048;

/// The highest degree of finite elements on a grid.
pub const MAX_ELEMENT_DEGREE: usize = 8;

/// A box divided into equal cells; valid by construction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    bounds: Bounds,
    cells: [usize; 2],
    width: DVec2,
}

impl Grid {
    /// `bounds` divided into `cells[0] × cells[1]` cells.
    ///
    /// # Errors
    ///
    /// `StepLimit` unless `1 ≤ cells ≤` [`MAX_CELLS`], `NonFinite`, `EmptyInterval`.
    pub fn new(bounds: Bounds, cells: [usize; 2]) -> Result<Self, FiniteElementError> {
        for axis in 0..2 {
            if cells[axis] == 0 || cells[axis] > MAX_CELLS {
                let (value, limit) = (cells[axis], MAX_CELLS);
                return Err(FiniteElementError::StepLimit { what: "the number of cells", value, limit });
            }
            let (left, right) = (bounds.lower[axis], bounds.upper[axis]);
            if !(right - left).is_finite() {
                let (point, value) = (bounds.lower, right - left);
                return Err(FiniteElementError::NonFinite { what: "the width of the box", point, value });
            }
            if left >= right {
                return Err(FiniteElementError::EmptyInterval { axis, left, right });
            }
        }
        let width = bounds.size() / DVec2::new(cells[0] as f64, cells[1] as f64);
        Ok(Self { bounds, cells, width })
    }

    /// Square cells of width `h` from the lower corner of `bounds`; the last ones may reach beyond its upper
    /// corner.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_width(bounds: Bounds, h: f64) -> Result<Self, FiniteElementError> {
        // A quotient that is an integer but for rounding must not add a cell; a bad h gives 0 or too many cells.
        let cells = (bounds.size() / h - 1e-9).ceil();
        let count = |cells: f64| if cells >= 1.0 { cells as usize } else { 0 };
        let cells = [count(cells.x), count(cells.y)];
        let size = DVec2::new(cells[0] as f64, cells[1] as f64) * h;
        Self::new(Bounds::new(bounds.lower, bounds.lower + size), cells)
    }

    /// The whole box.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Numbers of cells.
    pub fn cells(&self) -> [usize; 2] {
        self.cells
    }

    /// Number of all cells.
    pub fn cell_count(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// Width of a cell in both directions.
    pub fn width(&self) -> DVec2 {
        self.width
    }

    /// Numbers of B-splines of `degree`.
    pub fn array_shape(&self, degree: usize) -> [usize; 2] {
        self.cells.map(|cells| cells + degree)
    }

    /// The box of cell `l`.
    pub fn cell(&self, l: [usize; 2]) -> Bounds {
        Bounds::new(self.knot(l), self.knot([l[0] + 1, l[1] + 1]))
    }

    /// The cell that contains `x`, with the local coordinates in `[0, 1]`; `None` outside. The last cells are
    /// closed.
    pub fn locate(&self, x: DVec2) -> Option<([usize; 2], DVec2)> {
        let scaled = (x - self.bounds.lower) / self.width;
        let mut cell = [0; 2];
        for axis in 0..2 {
            let number = self.cells[axis] as f64;
            if !(scaled[axis] >= 0.0 && x[axis] <= self.bounds.upper[axis]) {
                return None;
            }
            cell[axis] = scaled[axis].min(number - 1.0) as usize;
        }
        Some((cell, scaled - DVec2::new(cell[0] as f64, cell[1] as f64)))
    }

    fn knot(&self, l: [usize; 2]) -> DVec2 {
        // The last knots are the box's bounds bit for bit, so that sides of the domain on them stay there.
        let at = |axis: usize| {
            if l[axis] == self.cells[axis] {
                self.bounds.upper[axis]
            } else {
                self.bounds.lower[axis] + self.width[axis] * l[axis] as f64
            }
        };
        DVec2::new(at(0), at(1))
    }
}

/// Values and derivatives of the `n + 1` uniform B-splines on a cell of width 1 at one place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CellBasis {
    /// The values, from the B-spline whose support ends first.
    pub values: [f64; MAX_ELEMENT_DEGREE + 1],
    /// The derivatives.
    pub derivatives: [f64; MAX_ELEMENT_DEGREE + 1],
}

impl CellBasis {
    /// The B-splines of `degree ≤` [`MAX_ELEMENT_DEGREE`] at `t` in `[0, 1]`.
    pub fn new(degree: usize, t: f64) -> Self {
        let mut basis = Self::default();
        let values = &mut basis.values;
        values[0] = 1.0;
        for d in 1..=degree {
            if d == degree {
                basis.derivatives[0] = -values[0];
                for i in 1..=d {
                    basis.derivatives[i] = values[i - 1] - if i < d { values[i] } else { 0.0 };
                }
            }
            // d bᵈ(x) = x bᵈ⁻¹(x) + (d + 1 − x) bᵈ⁻¹(x − 1) at x = t + d − i.
            for i in (0..=d).rev() {
                let rising = if i > 0 { (t + (d - i) as f64) * values[i - 1] } else { 0.0 };
                let falling = if i < d { (1.0 - t + i as f64) * values[i] } else { 0.0 };
                values[i] = (rising + falling) / d as f64;
            }
        }
        basis
    }
}

/// `StepLimit` unless `1 ≤ degree ≤` [`MAX_ELEMENT_DEGREE`].
pub(super) fn check_degree(degree: usize) -> Result<(), FiniteElementError> {
    if (1..=MAX_ELEMENT_DEGREE).contains(&degree) {
        Ok(())
    } else {
        let limit = MAX_ELEMENT_DEGREE;
        Err(FiniteElementError::StepLimit { what: "the degree", value: degree, limit })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::uniform_evaluate;

    #[test]
    fn the_b_splines_of_a_cell_are_the_standard_one_moved() {
        for degree in 1..=MAX_ELEMENT_DEGREE {
            for step in 0..=10 {
                let t = 0.0999 * f64::from(step);
                let basis = CellBasis::new(degree, t);
                for i in 0..=degree {
                    let x = t + (degree - i) as f64;
                    let wanted = uniform_evaluate(degree, x);
                    assert!((basis.values[i] - wanted).abs() < 1e-15, "degree {degree}, {i} at {t}");
                    let slope = uniform_evaluate(degree - 1, x) - uniform_evaluate(degree - 1, x - 1.0);
                    assert!((basis.derivatives[i] - slope).abs() < 1e-14, "degree {degree}, {i}' at {t}");
                }
            }
        }
    }

    #[test]
    fn cells_tile_the_box_and_points_are_found_in_them() {
        let bounds = Bounds::new(DVec2::new(-1.0, 0.1), DVec2::new(0.3, 0.7));
        let grid = Grid::new(bounds, [13, 7]).unwrap();
        assert_eq!(grid.cell([12, 6]).upper, bounds.upper, "last corner");
        assert_eq!(grid.cell([4, 2]).upper, grid.cell([5, 3]).lower, "common corner");
        assert_eq!(grid.locate(bounds.upper).unwrap().0, [12, 6], "the last cell is closed");
        let (cell, local) = grid.locate(grid.cell([3, 5]).center()).unwrap();
        assert_eq!(cell, [3, 5], "cell of its centre");
        assert!((local - 0.5).length() < 1e-12, "local coordinates {local}");
        assert!(grid.locate(DVec2::new(f64::NAN, 0.2)).is_none(), "NaN is nowhere");
    }

    #[test]
    fn widths_that_divide_the_box_make_no_further_cell() {
        let bounds = Bounds::new(DVec2::new(-2.0, -2.0), DVec2::new(4.0, 2.0));
        for (h, cells) in [(1.0, [6, 4]), (0.1, [60, 40]), (0.7, [9, 6])] {
            assert_eq!(Grid::with_width(bounds, h).unwrap().cells(), cells, "h = {h}");
        }
        let name = |h: f64| Grid::with_width(bounds, h).unwrap_err().name();
        assert_eq!([name(0.0), name(-1.0)], ["StepLimit"; 2], "impossible widths");
        assert!(Grid::with_width(bounds, f64::NAN).is_err(), "NaN");
    }
}
