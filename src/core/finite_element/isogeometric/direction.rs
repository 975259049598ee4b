//! What one direction contributes to sum factorisation: quadrature cells, and B-splines tabulated on them.
//!
//! Quadrature cells are the knot intervals of the solution's space, divided further at the knots of the geometry, so
//! that integrands are smooth on every cell.

use crate::core::bspline::SplineSpace;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::geometry::active;
use crate::core::quadrature::{GaussRule, gauss_legendre};

/// Cells are handled in blocks of this many, which a processor keeps in a few registers.
pub(super) const LANES: usize = 16;

/// Values and slopes of the active B-splines at all quadrature points of a direction.
///
/// Entry `(q, j, e)` belongs to point `q` of cell `e` and active B-spline `j`; `e` runs fastest and is padded by zeros.
#[derive(Clone, Debug)]
pub(super) struct BasisTable {
    pub(super) degree: usize,
    /// Distance of `(q, j, e)` and `(q, j + 1, e)`.
    pub(super) stride: usize,
    pub(super) values: Vec<f64>,
    pub(super) slopes: Vec<f64>,
    /// Index of the first active B-spline of each cell.
    pub(super) first: Vec<usize>,
    /// `(cell, length)`: neighbours whose first indices are consecutive; for the geometry, equal.
    pub(super) runs: Vec<(usize, usize)>,
}

impl BasisTable {
    pub(super) fn at(&self, q: usize, j: usize, e: usize) -> usize {
        (q * (self.degree + 1) + j) * self.stride + e
    }
}

/// Quadrature cells of one direction with the tables of the solution's and the geometry's B-splines.
#[derive(Clone, Debug)]
pub(in crate::core::finite_element) struct Direction {
    pub(super) cells: usize,
    /// Points of the rule in each cell.
    pub(super) rule: GaussRule,
    /// Ends of the cells, one more than cells.
    pub(super) breaks: Vec<f64>,
    pub(super) stride: usize,
    pub(super) solution: BasisTable,
    pub(super) geometry: BasisTable,
}

impl Direction {
    /// The tables with `points` Gauss points in every cell.
    pub(super) fn new(
        axis: usize,
        space: &SplineSpace,
        geometry: &SplineSpace,
        points: usize,
    ) -> Result<Self, FiniteElementError> {
        let rule = gauss_legendre(points)?;
        let mut breaks = [space.breaks(), geometry.breaks()].concat();
        breaks.sort_by(f64::total_cmp);
        // Breaks that differ by rounding only are one.
        let width = breaks[breaks.len() - 1] - breaks[0];
        breaks.dedup_by(|next, kept| *next - *kept <= 1e-13 * width);
        let cells = breaks.len() - 1;
        let stride = cells.next_multiple_of(LANES) + LANES;
        let table = |space: &SplineSpace, step: usize| -> Result<BasisTable, FiniteElementError> {
            let n = space.degree();
            let (mut values, mut slopes) =
                (vec![0.0; points * (n + 1) * stride], vec![0.0; points * (n + 1) * stride]);
            let mut first = vec![0; cells];
            for e in 0..cells {
                for (q, (t, _)) in rule.on(breaks[e], breaks[e + 1]).enumerate() {
                    let basis = active(space, axis, t)?;
                    first[e] = basis.first;
                    for j in 0..=n {
                        values[(q * (n + 1) + j) * stride + e] = basis.value(j);
                        slopes[(q * (n + 1) + j) * stride + e] = basis.slope(j);
                    }
                }
            }
            let mut runs: Vec<(usize, usize)> = Vec::new();
            for e in 0..cells {
                match runs.last_mut() {
                    Some((start, length)) if first[e] == first[*start] + *length * step => *length += 1,
                    _ => runs.push((e, 1)),
                }
            }
            Ok(BasisTable { degree: n, stride, values, slopes, first, runs })
        };
        let (solution, geometry) = (table(space, 1)?, table(geometry, 0)?);
        Ok(Self { cells, rule, breaks, stride, solution, geometry })
    }

    /// Parameter and quadrature weight of point `q` of cell `e`.
    pub(super) fn point(&self, q: usize, e: usize) -> (f64, f64) {
        let width = self.breaks[e + 1] - self.breaks[e];
        (self.breaks[e] + width * self.rule.nodes()[q], width * self.rule.weights()[q])
    }
}
