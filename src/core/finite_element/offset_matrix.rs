//! Matrices of tensor-product B-splines, stored by offsets.
//!
//! ```text
//! g̃(k, s) = g(k, k + s),   k ∈ {0 … m₁ − 1} × … ,   s ∈ {−n … n}ᵈ,   d = 1, 2, 3,
//! ```
//!
//! row-major in `k`, and for each `k` row-major in `s`: for `d = 2` entry `(k, s)` stands at
//! `((k₁ m₂ + k₂)(2n + 1) + s₁ + n)(2n + 1) + s₂ + n`. Places with `k + s` outside the array hold 0. The matrix
//! is symmetric if `g̃(k, s) = g̃(k + s, −s)`.
//!
//! Course: section 9.4.

use crate::core::finite_element::assembly::BlockSink;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::solver::SystemMatrix;
use crate::core::linear_system::{DenseMatrix, LinearOperator, LinearSystemError, SparseMatrix};

/// A square matrix in offset storage.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetMatrix {
    /// Sizes in three directions, those before the first one 1.
    shape: [usize; 3],
    /// Largest offset in three directions: the degree, or 0 before the first direction.
    reach: [usize; 3],
    values: Vec<f64>,
}

/// The largest number of stored entries: 1 GiB.
const MAX_ENTRIES: usize = 1 << 27;

impl OffsetMatrix {
    /// The zero matrix for an array of `shape` (1 to 3 directions) of B-splines of `degree`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are 1 to 3 directions, `StepLimit` when the storage would exceed 1 GiB.
    pub fn new(shape: &[usize], degree: usize) -> Result<Self, FiniteElementError> {
        if shape.is_empty() || shape.len() > 3 {
            let found = shape.len();
            return Err(FiniteElementError::SizeMismatch { what: "directions", expected: 2, found });
        }
        let first = 3 - shape.len();
        let (mut sizes, mut reach) = ([1; 3], [0; 3]);
        sizes[first..].copy_from_slice(shape);
        reach[first..].fill(degree);
        let widths = reach.map(|reach: usize| reach.saturating_mul(2).saturating_add(1));
        let count = sizes.iter().chain(&widths).fold(1, |product: usize, size| product.saturating_mul(*size));
        if count > MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(FiniteElementError::StepLimit { what: "the number of entries", value: count, limit });
        }
        Ok(Self { shape: sizes, reach, values: vec![0.0; count] })
    }

    /// Number of stored entries `m₁ … m_d (2n + 1)ᵈ`.
    pub fn entry_count(&self) -> usize {
        self.values.len()
    }

    /// All stored entries.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Entries per row, `(2n + 1)ᵈ`.
    pub fn row_length(&self) -> usize {
        self.reach.iter().map(|reach| 2 * reach + 1).product()
    }

    /// Floating point operations of one product: two for each stored entry.
    pub fn product_flops(&self) -> usize {
        2 * self.values.len()
    }

    /// The place of entry `(k, s)`, given with as many coordinates as there are directions; `None` if there is
    /// no such place.
    pub fn entry_index(&self, k: &[usize], s: &[isize]) -> Option<usize> {
        let row = self.row_index(k)?;
        let mut place = row;
        let first = 3 - k.len();
        for axis in first..3 {
            let reach = self.reach[axis] as isize;
            let offset = usize::try_from(*s.get(axis - first)? + reach).ok()?;
            if offset > 2 * self.reach[axis] {
                return None;
            }
            place = place * (2 * self.reach[axis] + 1) + offset;
        }
        Some(place)
    }

    /// The entry at `(k, s)`, 0 if there is no such place.
    pub fn entry(&self, k: &[usize], s: &[isize]) -> f64 {
        self.entry_index(k, s).map_or(0.0, |place| self.values[place])
    }

    /// Adds `value` in row `row` and column `column` of the matrix, both flat indices; `false` if the storage
    /// has no such place.
    pub fn add(&mut self, row: usize, column: usize, value: f64) -> bool {
        let place = self.place(row, column);
        if let Some(place) = place {
            self.values[place] += value;
        }
        place.is_some()
    }

    /// Replaces the rows and columns that are not `kept` by those of the identity.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn set_identity_rows(&mut self, kept: &[bool]) -> Result<(), FiniteElementError> {
        let (expected, found) = (self.size(), kept.len());
        if found != expected {
            return Err(FiniteElementError::SizeMismatch { what: "marks", expected, found });
        }
        let mut values = std::mem::take(&mut self.values);
        self.for_each_place(|row, column, place| {
            if !(kept[row] && kept[column]) {
                values[place] = f64::from(row == column);
            }
        });
        self.values = values;
        Ok(())
    }

    /// Whether `|g̃(k, s) − g̃(k + s, −s)| ≤ tolerance·max |g̃|` everywhere.
    pub fn is_symmetric(&self, tolerance: f64) -> bool {
        let limit = tolerance * self.values.iter().fold(0.0, |max: f64, value| max.max(value.abs()));
        let mut symmetric = true;
        self.for_each_place(|row, column, place| {
            let mirrored = self.place(column, row).map_or(0.0, |place| self.values[place]);
            symmetric &= (self.values[place] - mirrored).abs() <= limit;
        });
        symmetric
    }

    /// The matrix with all its zeros.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn to_dense(&self) -> Result<DenseMatrix, LinearSystemError> {
        let size = self.size();
        let mut entries = vec![0.0; size * size];
        self.for_each_place(|row, column, place| entries[row * size + column] = self.values[place]);
        DenseMatrix::new(size, size, entries)
    }

    /// Flat index of the array place `k`.
    fn row_index(&self, k: &[usize]) -> Option<usize> {
        let sizes = self.shape.get(3_usize.checked_sub(k.len())?..)?;
        k.iter().zip(sizes).try_fold(0, |row, (k, size)| (k < size).then_some(row * size + k))
    }

    fn coordinates(&self, row: usize) -> [usize; 3] {
        let [_, m1, m2] = self.shape;
        [row / (m1 * m2), row / m2 % m1, row % m2]
    }

    fn place(&self, row: usize, column: usize) -> Option<usize> {
        if row >= self.size() || column >= self.size() {
            return None;
        }
        let (k, l) = (self.coordinates(row), self.coordinates(column));
        let mut place = row;
        for axis in 0..3 {
            let offset = (l[axis] + self.reach[axis]).checked_sub(k[axis])?;
            if offset > 2 * self.reach[axis] {
                return None;
            }
            place = place * (2 * self.reach[axis] + 1) + offset;
        }
        Some(place)
    }

    /// Calls `visit(row, column, place)` for all places whose column exists, row by row, columns increasing.
    fn for_each_place(&self, mut visit: impl FnMut(usize, usize, usize)) {
        for row in 0..self.size() {
            self.for_each_run(row, |column, place, length| {
                (0..length).for_each(|i| visit(row, column + i, place + i));
            });
        }
    }

    /// Calls `visit(first column, first place, length)` for the runs of neighbouring columns of a row.
    fn for_each_run(&self, row: usize, mut visit: impl FnMut(usize, usize, usize)) {
        let k = self.coordinates(row);
        let [r0, r1, r2] = self.reach;
        let range = |axis: usize| {
            let (k, reach) = (k[axis], self.reach[axis]);
            k.saturating_sub(reach)..(k + reach + 1).min(self.shape[axis])
        };
        let last = range(2);
        for l0 in range(0) {
            for l1 in range(1) {
                let column = (l0 * self.shape[1] + l1) * self.shape[2] + last.start;
                let place = ((row * (2 * r0 + 1) + l0 + r0 - k[0]) * (2 * r1 + 1) + l1 + r1 - k[1])
                    * (2 * r2 + 1)
                    + last.start
                    + r2
                    - k[2];
                visit(column, place, last.len());
            }
        }
    }
}

impl LinearOperator for OffsetMatrix {
    fn size(&self) -> usize {
        self.shape.iter().product()
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        for (row, sum) in product.iter_mut().enumerate() {
            let mut total = 0.0;
            self.for_each_run(row, |column, place, length| {
                let (values, entries) = (&self.values[place..place + length], &x[column..column + length]);
                total += values.iter().zip(entries).map(|(a, x)| a * x).sum::<f64>();
            });
            *sum = total;
        }
    }
}

impl SystemMatrix for OffsetMatrix {
    fn diagonal(&self) -> Vec<f64> {
        let length = self.row_length();
        (0..self.size()).map(|row| self.values[row * length + length / 2]).collect()
    }

    fn to_sparse(&self) -> Result<SparseMatrix, LinearSystemError> {
        let mut patterns = vec![Vec::new(); self.size()];
        let mut values = vec![Vec::new(); self.size()];
        self.for_each_place(|row, column, place| {
            if self.values[place] != 0.0 || row == column {
                patterns[row].push(column);
                values[row].push(self.values[place]);
            }
        });
        let mut matrix = SparseMatrix::from_row_patterns(self.size(), &patterns)?;
        for (row, values) in values.iter().enumerate() {
            matrix.row_values_mut(row).copy_from_slice(values);
        }
        Ok(matrix)
    }
}

impl BlockSink for OffsetMatrix {
    fn add_block(&mut self, indices: &[usize], block: &[f64]) {
        for (i, &row) in indices.iter().enumerate() {
            for (j, &column) in indices.iter().enumerate() {
                self.add(row, column, block[i * indices.len() + j]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    /// A matrix with all places filled by a rule that is not symmetric.
    fn filled(shape: &[usize], degree: usize) -> OffsetMatrix {
        let mut matrix = OffsetMatrix::new(shape, degree).unwrap();
        for row in 0..matrix.size() {
            for column in 0..matrix.size() {
                matrix.add(row, column, ((row * 7 + column * 13) % 17) as f64 - 8.0);
            }
        }
        matrix
    }

    #[test]
    fn the_product_is_that_of_the_dense_matrix_in_one_two_and_three_directions() {
        for (shape, degree) in [
            (&[7][..], 1),
            (&[9], 4),
            (&[5, 6], 1),
            (&[4, 7], 3),
            (&[2, 3], 4),
            (&[3, 4, 3], 1),
            (&[2, 4, 3], 2),
        ] {
            let matrix = filled(shape, degree);
            let x: Vec<f64> = (0..matrix.size()).map(|i| ((i * i) % 11) as f64 - 5.0).collect();
            let mut product = vec![0.0; matrix.size()];
            matrix.apply(&x, &mut product);
            assert_eq!(product, matrix.to_dense().unwrap().multiply(&x).unwrap(), "shape {shape:?}");
            let mut sparse = vec![0.0; matrix.size()];
            matrix.to_sparse().unwrap().apply(&x, &mut sparse);
            assert_eq!(product, sparse, "shape {shape:?}");
        }
    }

    #[test]
    fn entries_stand_where_the_formula_says() {
        let matrix = filled(&[5, 6], 2);
        let (k, s) = ([1, 3], [2, -1]);
        assert_eq!(matrix.entry_index(&k, &s), Some(((6 + 3) * 5 + 4) * 5 + 1), "place");
        let (row, column) = (6 + 3, 3 * 6 + 2);
        assert_eq!(matrix.entry(&k, &s), matrix.to_dense().unwrap().row(row)[column], "entry");
        assert_eq!(matrix.entry_index(&k, &[3, 0]), None, "offset beyond the degree");
        assert_eq!(matrix.entry(&[0, 0], &[-1, 0]), 0.0, "padding");
    }

    #[test]
    fn dead_rows_and_columns_become_those_of_the_identity() {
        let mut matrix = filled(&[3, 4], 1);
        let kept: Vec<bool> = (0..12).map(|i| i % 5 != 0).collect();
        let before = matrix.to_dense().unwrap();
        matrix.set_identity_rows(&kept).unwrap();
        let after = matrix.to_dense().unwrap();
        for i in 0..12 {
            for j in 0..12 {
                let wanted = if kept[i] && kept[j] { before.row(i)[j] } else { f64::from(i == j) };
                assert_eq!(after.row(i)[j], wanted, "entry {i}, {j}");
            }
        }
        assert!(!matrix.is_symmetric(0.01), "the rule is not symmetric");
    }

    #[test]
    fn impossible_sizes_are_refused() {
        assert_eq!(OffsetMatrix::new(&[], 1).unwrap_err().name(), "SizeMismatch", "no direction");
        assert_eq!(OffsetMatrix::new(&[usize::MAX, 9], 2).unwrap_err().name(), "StepLimit", "huge");
    }
}
