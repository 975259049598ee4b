//! Which B-splines matter for a domain: those with a support cell that is not outside.
//!
//! A relevant B-spline is *inner* if at least one cell of its support lies in the domain, else *outer*. Course: sections 7.3 and 9.2.

use crate::core::bspline::SplineError;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::space::TensorSplineSpace;

/// Where a grid cell lies with respect to a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CellPosition {
    /// No common inner point.
    Outside,
    /// The boundary passes through the cell.
    Cut,
    /// The cell lies in the domain.
    Inside,
}

/// What a B-spline is for a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Relevance {
    /// It vanishes on the domain.
    Irrelevant,
    /// Its support meets the domain, but contains no cell of it.
    Outer,
    /// Its support contains a cell of the domain.
    Inner,
}

/// The classified cells and B-splines of a space over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct RelevanceMask {
    /// One entry for each coefficient, row-major.
    pub splines: Vec<Relevance>,
    /// One entry for each nonempty cell, row-major.
    pub cells: Vec<CellPosition>,
}

impl RelevanceMask {
    /// Number of B-splines of one kind.
    pub fn count(&self, kind: Relevance) -> usize {
        self.splines.iter().filter(|&&entry| entry == kind).count()
    }

    /// Number of cells of one kind.
    pub fn cell_count(&self, position: CellPosition) -> usize {
        self.cells.iter().filter(|&&entry| entry == position).count()
    }
}

impl<const D: usize> TensorSplineSpace<D> {
    /// Classifies cells with `classify` and B-splines by their cells; `bounds` is the bounding box of the domain.
    ///
    /// # Errors
    ///
    /// `OutsideInterval` with the axis if the bounding box is not in the parameter box (periodic directions excepted);
    /// `EmptyDomain` if no B-spline is relevant.
    pub fn relevance(
        &self,
        bounds: [(f64, f64); D],
        mut classify: impl FnMut([(f64, f64); D]) -> CellPosition,
    ) -> Result<RelevanceMask, TensorError> {
        for (axis, (low, high)) in bounds.into_iter().enumerate() {
            let (left, right) = self.parameter_box()[axis];
            if self.axes()[axis].is_periodic() {
                continue;
            }
            if let Some(value) = [low, high].into_iter().find(|value| !(left..=right).contains(value)) {
                let source = SplineError::OutsideInterval { value, left, right };
                return Err(TensorError::Axis { axis, source });
            }
        }
        // The nonempty knot intervals of each direction.
        let spans: [Vec<usize>; D] = std::array::from_fn(|axis| {
            let (space, knots) = (&self.axes()[axis], self.axes()[axis].evaluation_knots());
            (space.degree()..space.evaluation_dimension()).filter(|&l| knots[l] < knots[l + 1]).collect()
        });
        let mut splines = vec![Relevance::Irrelevant; self.dimension()];
        let mut cells = Vec::new();
        let width: usize = self.degrees().iter().map(|n| n + 1).product();
        for mut place in 0..spans.iter().map(Vec::len).product() {
            let mut l = [0; D];
            for axis in (0..D).rev() {
                l[axis] = spans[axis][place % spans[axis].len()];
                place /= spans[axis].len();
            }
            let side = |axis: usize| {
                let knots = self.axes()[axis].evaluation_knots();
                (knots[l[axis]], knots[l[axis] + 1])
            };
            let position = classify(std::array::from_fn(side));
            cells.push(position);
            let kind = match position {
                CellPosition::Outside => continue,
                CellPosition::Cut => Relevance::Outer,
                CellPosition::Inside => Relevance::Inner,
            };
            for mut j in 0..width {
                let mut k = [0; D];
                for axis in (0..D).rev() {
                    let space = &self.axes()[axis];
                    k[axis] = space.coefficient_index(l[axis] - j % (space.degree() + 1));
                    j /= space.degree() + 1;
                }
                let entry = &mut splines[self.flat_index(k)];
                *entry = kind.max(*entry);
            }
        }
        if splines.iter().all(|&kind| kind == Relevance::Irrelevant) {
            return Err(TensorError::EmptyDomain);
        }
        Ok(RelevanceMask { splines, cells })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    #[test]
    fn a_box_of_cells_has_cells_plus_degree_b_splines_in_each_direction() {
        let line = |n: usize| SplineSpace::uniform(n, 0.0, 8.0, 8).unwrap();
        for (n1, n2) in [(1, 1), (2, 3)] {
            let space = TensorSplineSpace::new([line(n1), line(n2)]).unwrap();
            let inside = |cell: [(f64, f64); 2]| cell[0].0 >= 2.0 && cell[0].1 <= 5.0 && cell[1].1 <= 4.0;
            let classify = |cell| if inside(cell) { CellPosition::Inside } else { CellPosition::Outside };
            let mask = space.relevance([(2.0, 5.0), (0.0, 4.0)], classify).unwrap();
            assert_eq!(mask.count(Relevance::Inner), (3 + n1) * (4 + n2), "degrees {n1}, {n2}");
            assert_eq!(mask.cell_count(CellPosition::Inside), 12, "3 by 4 cells");
        }
        let space = TensorSplineSpace::new([line(1), line(1)]).unwrap();
        let error = space.relevance([(0.0, 1.0), (0.0, 8.5)], |_| CellPosition::Cut).unwrap_err();
        assert!(matches!(error, TensorError::Axis { axis: 1, .. }), "{error}");
        let error = space.relevance([(0.0, 1.0); 2], |_| CellPosition::Outside).unwrap_err();
        assert_eq!(error, TensorError::EmptyDomain, "nothing inside");
    }
}
