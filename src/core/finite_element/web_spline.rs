//! Weighted extended B-splines (web-splines): the outer B-splines are joined to inner ones.
//!
//! Every outer index `j` takes the nearest array `I(j) = l + {0 … n}ᵈ` of inner indices (distance of its centre
//! `l + n/2` from `j`, of equal ones the lexicographically smallest `l`), and
//!
//! ```text
//! eᵢⱼ = Π over ν Π over μ = 0 … n, lᵥ + μ ≠ iᵥ of (jᵥ − lᵥ − μ)/(iᵥ − lᵥ − μ),   i ∈ I(j),
//! B̃ᵢ = (w / w(xᵢ)) (bᵢ + Σ over j with i ∈ I(j) of eᵢⱼ bⱼ),
//! ```
//!
//! which extrapolates coefficients that are polynomials of degree n. `xᵢ` is the centre of an inner cell of the
//! support: the nearest one to the centre of the support, of equal ones the lexicographically smallest. With `E
//! = (eᵢⱼ)`, its identity part included, and `D = diag(1/w(xᵢ))` the Galerkin matrix of the web-splines is
//! `(DE) G (DE)ᵗ`.
//!
//! K. Höllig, U. Reif, J. Wipper, *Weighted extended B-spline approximation of Dirichlet problems*, 2001.
//! Course: section 9.2.

use crate::core::domain::CellClass;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::linear_system::SparseMatrix;

/// How a B-spline lies to a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeClass {
    /// No part of the support is in the domain.
    Irrelevant,
    /// Relevant, without an inner cell in its support.
    Outer,
    /// At least one cell of the support is an inner one.
    Inner,
}

/// The array of B-splines of one degree over a grid of cells in `D` directions, with their classes; row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeArray<const D: usize> {
    cells: [usize; D],
    degree: usize,
    classes: Vec<NodeClass>,
    inner_cells: Vec<bool>,
}

/// An outer index and the array of inner indices that it is joined to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Joined<const D: usize> {
    /// `j`.
    pub outer: [usize; D],
    /// `l`, the smallest index of `I(j)`.
    pub array: [usize; D],
}

impl<const D: usize> NodeArray<D> {
    /// The array of B-splines of `degree` for a grid with the given numbers of cells, classified by their cells.
    pub fn new(cells: [usize; D], degree: usize, class_of: impl Fn([usize; D]) -> CellClass) -> Self {
        let shape = cells.map(|count| count + degree);
        let mut classes = vec![NodeClass::Irrelevant; shape.iter().product()];
        let mut inner_cells = Vec::new();
        for cell in indices(cells) {
            let class = class_of(cell);
            inner_cells.push(class == CellClass::Inner);
            for offset in indices([degree + 1; D]) {
                let node = &mut classes[flat(add(cell, offset), shape)];
                match class {
                    CellClass::Inner => *node = NodeClass::Inner,
                    CellClass::Cut if *node == NodeClass::Irrelevant => *node = NodeClass::Outer,
                    _ => {}
                }
            }
        }
        Self { cells, degree, classes, inner_cells }
    }

    /// Numbers of B-splines.
    pub fn shape(&self) -> [usize; D] {
        self.cells.map(|count| count + self.degree)
    }

    /// The classes, row-major.
    pub fn classes(&self) -> &[NodeClass] {
        &self.classes
    }

    /// Number of B-splines of a class.
    pub fn count(&self, class: NodeClass) -> usize {
        self.classes.iter().filter(|other| **other == class).count()
    }

    /// Number of inner and outer B-splines.
    pub fn relevant_count(&self) -> usize {
        self.classes.len() - self.count(NodeClass::Irrelevant)
    }

    /// The indices of a class, increasing.
    pub fn of_class(&self, class: NodeClass) -> Vec<[usize; D]> {
        indices(self.shape())
            .zip(&self.classes)
            .filter(|(_, other)| **other == class)
            .map(|(k, _)| k)
            .collect()
    }

    /// Row-major place of `k`.
    pub fn place(&self, k: [usize; D]) -> usize {
        flat(k, self.shape())
    }

    /// All outer indices with their arrays.
    ///
    /// # Errors
    ///
    /// `NoInnerArray` if there are outer indices but no array of inner ones.
    pub fn join(&self) -> Result<Vec<Joined<D>>, FiniteElementError> {
        let shape = self.shape();
        let all_inner = |l: &[usize; D]| {
            indices([self.degree + 1; D])
                .all(|offset| self.classes[flat(add(*l, offset), shape)] == NodeClass::Inner)
        };
        let arrays: Vec<bool> = indices(self.cells).map(|l| all_inner(&l)).collect();
        // Without any array there is nothing to search for.
        let farthest = if arrays.contains(&true) { self.shape().into_iter().max().unwrap_or(0) } else { 0 };
        let join = |outer: [usize; D]| {
            // Four times the squared distance, an integer; of equal ones the smallest array.
            let distance = |l: &[usize; D]| -> usize {
                (0..D).map(|axis| (2 * l[axis] + self.degree).abs_diff(2 * outer[axis]).pow(2)).sum()
            };
            // Rings of arrays around the nearest place: those of the next ring are at least `(2 radius − 1)²` away.
            let middle = outer.map(|j| j as isize - (self.degree / 2) as isize);
            let mut best: Option<(usize, [usize; D])> = None;
            for radius in 0..=farthest + self.degree {
                if best.is_some_and(|(distance, _)| (2 * radius).saturating_sub(1).pow(2) > distance) {
                    break;
                }
                for offset in indices([2 * radius + 1; D]) {
                    let on_ring = offset.iter().any(|o| *o == 0 || *o == 2 * radius);
                    let l: [usize; D] = std::array::from_fn(|axis| {
                        let place = middle[axis] + offset[axis] as isize - radius as isize;
                        usize::try_from(place).unwrap_or(usize::MAX)
                    });
                    if on_ring && (0..D).all(|axis| l[axis] < self.cells[axis]) && arrays[flat(l, self.cells)]
                    {
                        let candidate = (distance(&l), l);
                        best = Some(best.map_or(candidate, |best| best.min(candidate)));
                    }
                }
            }
            let index = [outer[0], outer.get(1).copied().unwrap_or(0)];
            best.map(|(_, array)| Joined { outer, array }).ok_or(FiniteElementError::NoInnerArray { index })
        };
        self.of_class(NodeClass::Outer).into_iter().map(join).collect()
    }

    /// The coefficients `eᵢⱼ` of a joined index, for the `i` of its array in row-major succession, with the
    /// places of the `i`.
    pub fn extension(&self, joined: &Joined<D>) -> Vec<(usize, f64)> {
        let factors: [Vec<f64>; D] = std::array::from_fn(|axis| {
            let offset = joined.outer[axis] as isize - joined.array[axis] as isize;
            extension_coefficients(self.degree, offset)
        });
        let entry = |offset: [usize; D]| {
            let product = (0..D).map(|axis| factors[axis][offset[axis]]).product();
            (self.place(add(joined.array, offset)), product)
        };
        indices([self.degree + 1; D]).map(entry).collect()
    }

    /// The cell whose centre is `xᵢ`; `None` unless `i` is an inner index.
    pub fn center_cell(&self, i: [usize; D]) -> Option<[usize; D]> {
        let in_support = |cell: &[usize; D]| (0..D).all(|axis| cell[axis] < self.cells[axis]);
        let cell = |offset: [usize; D]| -> Option<[usize; D]> {
            let cell = add(i, offset).map(|end| end.checked_sub(self.degree));
            cell.iter().all(Option::is_some).then(|| cell.map(|index| index.unwrap_or(0)))
        };
        // Four times the squared distance of the centres of cell and support.
        let distance = |cell: &[usize; D]| -> usize {
            (0..D).map(|axis| (2 * cell[axis] + self.degree).abs_diff(2 * i[axis]).pow(2)).sum()
        };
        indices([self.degree + 1; D])
            .filter_map(cell)
            .filter(in_support)
            .filter(|cell| self.inner_cells[flat(*cell, self.cells)])
            .min_by_key(distance)
    }

    /// `DE`: one row for each inner index, one column for each B-spline of the array. `weight_at` gives `w` at
    /// the centre of a cell.
    ///
    /// # Errors
    ///
    /// `NoInnerArray`, `NonFinite` if a weight is 0.
    pub fn web_matrix(
        &self,
        weight_at: impl Fn([usize; D]) -> f64,
    ) -> Result<SparseMatrix, FiniteElementError> {
        let inner = self.of_class(NodeClass::Inner);
        let mut row_of = vec![usize::MAX; self.classes.len()];
        let mut scales = Vec::with_capacity(inner.len());
        let mut triplets = Vec::new();
        for (row, &i) in inner.iter().enumerate() {
            let scale = self.center_cell(i).map_or(f64::NAN, |cell| weight_at(cell).recip());
            row_of[self.place(i)] = row;
            scales.push(scale);
            triplets.push((row, self.place(i), scale));
        }
        for joined in self.join()? {
            for (place, e) in self.extension(&joined) {
                if e != 0.0 {
                    let row = row_of[place];
                    triplets.push((row, self.place(joined.outer), e * scales[row]));
                }
            }
        }
        Ok(SparseMatrix::from_triplets(inner.len(), self.classes.len(), &triplets)?)
    }
}

/// The coefficients in one direction for `j = l + offset` and `i = l, …, l + n`: the Lagrange polynomials of
/// the nodes `0 … n` at `offset`.
pub fn extension_coefficients(degree: usize, offset: isize) -> Vec<f64> {
    let factor = |i: usize, mu: usize| (offset as f64 - mu as f64) / (i as f64 - mu as f64);
    (0..=degree).map(|i| (0..=degree).filter(|mu| *mu != i).map(|mu| factor(i, mu)).product()).collect()
}

/// All multi-indices below `shape`, the last direction running fastest.
fn indices<const D: usize>(shape: [usize; D]) -> impl Iterator<Item = [usize; D]> {
    (0..shape.iter().product()).map(move |mut place: usize| {
        let mut index = [0; D];
        for axis in (0..D).rev() {
            index[axis] = place % shape[axis];
            place /= shape[axis];
        }
        index
    })
}

fn flat<const D: usize>(index: [usize; D], shape: [usize; D]) -> usize {
    (0..D).fold(0, |place, axis| place * shape[axis] + index[axis])
}

fn add<const D: usize>(a: [usize; D], b: [usize; D]) -> [usize; D] {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    /// Cells of a disc-like pattern: inner within 3, cut within 4.5 of the middle.
    fn pattern(degree: usize) -> NodeArray<2> {
        NodeArray::new([12, 11], degree, |cell| {
            let (x, y) = (cell[0] as f64 - 5.5, cell[1] as f64 - 5.0);
            match x.hypot(y) {
                r if r < 3.5 => CellClass::Inner,
                r if r < 5.0 => CellClass::Cut,
                _ => CellClass::Outer,
            }
        })
    }

    #[test]
    fn columns_sum_to_one_and_extrapolate_polynomial_coefficients() {
        for degree in 1..=4 {
            let nodes = pattern(degree);
            let n = degree as i32;
            let polynomial = |k: [usize; 2]| {
                let (x, y) = (k[0] as f64 / 5.0 - 1.0, k[1] as f64 / 4.0 - 1.0);
                x.powi(n) * y.powi(n) - 2.0 * x * y.powi(n - 1) + 3.0
            };
            let joined = nodes.join().unwrap();
            assert_eq!(joined.len(), nodes.count(NodeClass::Outer), "all outer indices");
            for one in joined {
                let entries = nodes.extension(&one);
                let sum: f64 = entries.iter().map(|(_, e)| e).sum();
                assert!((sum - 1.0).abs() < 1e-9, "degree {degree}: sum {sum}");
                let columns = nodes.shape()[1];
                let value: f64 =
                    entries.iter().map(|(place, e)| e * polynomial([place / columns, place % columns])).sum();
                assert!((value - polynomial(one.outer)).abs() < 1e-7, "degree {degree}, {one:?}: {value}");
            }
        }
    }

    #[test]
    fn the_nearest_array_is_that_of_a_search_through_all() {
        for degree in 1..=3 {
            let nodes = pattern(degree);
            let inner = |l: &[usize; 2]| {
                indices([degree + 1; 2]).all(|o| nodes.classes()[nodes.place(add(*l, o))] == NodeClass::Inner)
            };
            let arrays: Vec<[usize; 2]> = indices([12, 11]).filter(inner).collect();
            for joined in nodes.join().unwrap() {
                let distance = |l: &[usize; 2]| -> i64 {
                    (0..2)
                        .map(|a| (2 * l[a] as i64 + degree as i64 - 2 * joined.outer[a] as i64).pow(2))
                        .sum()
                };
                let nearest = arrays.iter().min_by_key(|l| (distance(l), **l)).unwrap();
                assert_eq!(&joined.array, nearest, "degree {degree}, outer {:?}", joined.outer);
            }
        }
    }

    #[test]
    fn centres_belong_to_inner_cells_of_the_support() {
        let nodes = pattern(2);
        for i in nodes.of_class(NodeClass::Inner) {
            let cell = nodes.center_cell(i).unwrap();
            assert!(
                (0..2).all(|a| cell[a] <= i[a] && cell[a] + 2 >= i[a]),
                "{cell:?} in the support of {i:?}"
            );
        }
        assert_eq!(nodes.center_cell([0, 0]), None, "an irrelevant index");
    }

    #[test]
    fn a_grid_without_inner_cells_is_too_coarse() {
        let nodes = NodeArray::new([3, 3], 2, |_| CellClass::Cut);
        assert_eq!(nodes.join().unwrap_err().name(), "NoInnerArray", "all cells are cut");
        let one_inner =
            NodeArray::new([3, 3], 2, |cell| if cell == [1, 1] { CellClass::Inner } else { CellClass::Cut });
        assert!(one_inner.join().is_ok(), "one inner cell carries (n + 1)² inner B-splines");
    }
}
