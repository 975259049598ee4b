//! Sparse matrices in compressed rows, and direct solution.
//!
//! Row `i` owns the entries `starts[i]..starts[i + 1]` of the lists of columns (strictly increasing in a row) and values. Symmetric positive
//! definite systems are solved by a sparse Cholesky factorisation, others by sparse elimination with partial pivoting (both of faer).

use std::fmt::{self, Debug, Formatter};

use faer::MatRef;
use faer::linalg::solvers::Solve as _;
use faer::sparse::linalg::solvers::{Llt, Lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

use crate::core::linear_system::conjugate_gradients::LinearOperator;
use crate::core::linear_system::dense::DenseMatrix;
use crate::core::linear_system::error::{LinearSystemError, check_finite, check_size};

/// A sparse matrix; entries outside the pattern are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    column_count: usize,
    starts: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl SparseMatrix {
    /// The matrix with the sums of all given `(row, column, value)` at the same place; zeros given stay in the pattern.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange`, `NonFinite`.
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        triplets: &[(usize, usize, f64)],
    ) -> Result<Self, LinearSystemError> {
        let mut pattern = vec![Vec::new(); rows];
        for &(row, column, _) in triplets {
            check_index("row", row, rows)?;
            check_index("column", column, columns)?;
            pattern[row].push(column);
        }
        for row in &mut pattern {
            row.sort_unstable();
            row.dedup();
        }
        let mut matrix = Self::from_row_patterns(columns, &pattern)?;
        for (index, &(row, column, value)) in triplets.iter().enumerate() {
            if !value.is_finite() {
                return Err(LinearSystemError::NonFinite { what: "value of triplet", index, value });
            }
            matrix.add(row, column, value);
        }
        Ok(matrix)
    }

    /// The zero matrix whose pattern has the strictly increasing columns `patterns[i]` in row `i`.
    ///
    /// # Errors
    ///
    /// `IndexOutOfRange` for a column that does not exist or does not increase.
    pub fn from_row_patterns(columns: usize, patterns: &[Vec<usize>]) -> Result<Self, LinearSystemError> {
        let mut starts = vec![0];
        for pattern in patterns {
            for (place, &column) in pattern.iter().enumerate() {
                check_index("column", column, columns)?;
                if place > 0 && pattern[place - 1] >= column {
                    let limit = columns;
                    return Err(LinearSystemError::IndexOutOfRange {
                        what: "unsorted column",
                        index: column,
                        limit,
                    });
                }
            }
            starts.push(starts[starts.len() - 1] + pattern.len());
        }
        let columns_of_all = patterns.concat();
        let values = vec![0.0; columns_of_all.len()];
        Ok(Self { column_count: columns, starts, columns: columns_of_all, values })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.column_count
    }

    /// Number of entries in the pattern.
    pub fn entry_count(&self) -> usize {
        self.values.len()
    }

    /// Columns and values of row `i`, both empty if there is no such row.
    pub fn row(&self, i: usize) -> (&[usize], &[f64]) {
        match (self.starts.get(i), self.starts.get(i + 1)) {
            (Some(&from), Some(&to)) => (&self.columns[from..to], &self.values[from..to]),
            _ => (&[], &[]),
        }
    }

    /// Values of row `i` for writing.
    pub fn row_values_mut(&mut self, i: usize) -> &mut [f64] {
        match (self.starts.get(i), self.starts.get(i + 1)) {
            (Some(&from), Some(&to)) => &mut self.values[from..to],
            _ => &mut [],
        }
    }

    /// The entry at `(i, j)`, 0 outside the pattern.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let (columns, values) = self.row(i);
        columns.binary_search(&j).map_or(0.0, |place| values[place])
    }

    /// Adds `value` at `(i, j)`; `false` if the pattern has no such place.
    pub fn add(&mut self, i: usize, j: usize, value: f64) -> bool {
        let place = self.row(i).0.binary_search(&j);
        if let Ok(place) = place {
            self.values[self.starts[i] + place] += value;
        }
        place.is_ok()
    }

    /// Sets all values to 0 and keeps the pattern.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// The diagonal entries.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.rows()).map(|i| self.entry(i, i)).collect()
    }

    /// Writes the product `A x` into `product`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn multiply(&self, x: &[f64], product: &mut [f64]) -> Result<(), LinearSystemError> {
        check_size("entries of the vector", self.column_count, x.len())?;
        check_size("places for the product", self.rows(), product.len())?;
        for (i, sum) in product.iter_mut().enumerate() {
            let (columns, values) = self.row(i);
            *sum = columns.iter().zip(values).map(|(&j, a)| a * x[j]).sum();
        }
        Ok(())
    }

    /// The transposed matrix.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let mut counts = vec![0; self.column_count + 1];
        for &column in &self.columns {
            counts[column + 1] += 1;
        }
        for j in 0..self.column_count {
            counts[j + 1] += counts[j];
        }
        let mut next = counts.clone();
        let (mut columns, mut values) = (vec![0; self.values.len()], vec![0.0; self.values.len()]);
        for i in 0..self.rows() {
            let (row_columns, row_values) = self.row(i);
            for (&j, &value) in row_columns.iter().zip(row_values) {
                (columns[next[j]], values[next[j]]) = (i, value);
                next[j] += 1;
            }
        }
        Self { column_count: self.rows(), starts: counts, columns, values }
    }

    /// The product of two sparse matrices.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn times(&self, other: &Self) -> Result<Self, LinearSystemError> {
        check_size("rows of the second factor", self.column_count, other.rows())?;
        let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        // Sums of one row, and the row in which each was last touched.
        let (mut sums, mut touched) = (vec![0.0; other.column_count], vec![usize::MAX; other.column_count]);
        for i in 0..self.rows() {
            let from = columns.len();
            let (row_columns, row_values) = self.row(i);
            for (&k, a) in row_columns.iter().zip(row_values) {
                let (other_columns, other_values) = other.row(k);
                for (&j, b) in other_columns.iter().zip(other_values) {
                    if touched[j] != i {
                        (touched[j], sums[j]) = (i, 0.0);
                        columns.push(j);
                    }
                    sums[j] += a * b;
                }
            }
            columns[from..].sort_unstable();
            values.extend(columns[from..].iter().map(|&j| sums[j]));
            starts.push(columns.len());
        }
        Ok(Self { column_count: other.column_count, starts, columns, values })
    }

    /// Whether `|aᵢⱼ − aⱼᵢ| ≤ tolerance·max |a|` for all entries.
    pub fn is_symmetric(&self, tolerance: f64) -> bool {
        let limit = tolerance * self.values.iter().fold(0.0, |max: f64, a| max.max(a.abs()));
        self.rows() == self.column_count
            && (0..self.rows()).all(|i| {
                let (columns, values) = self.row(i);
                columns.iter().zip(values).all(|(&j, a)| (a - self.entry(j, i)).abs() <= limit)
            })
    }

    /// The same matrix with all its zeros.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn to_dense(&self) -> Result<DenseMatrix, LinearSystemError> {
        let mut entries = vec![0.0; self.rows() * self.column_count];
        for i in 0..self.rows() {
            let (columns, values) = self.row(i);
            for (&j, &value) in columns.iter().zip(values) {
                entries[i * self.column_count + j] = value;
            }
        }
        DenseMatrix::new(self.rows(), self.column_count, entries)
    }

    /// Cholesky factor of a symmetric positive definite matrix; only one triangle is read.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a matrix that is not square, `NonFinite`, `NotPositiveDefinite`, `StepLimit` (memory).
    pub fn cholesky(&self) -> Result<SparseFactor, LinearSystemError> {
        let size = self.check_solvable()?;
        // Rows of a symmetric matrix are its columns.
        match self.view().sp_cholesky(faer::Side::Lower) {
            Ok(factor) => Ok(SparseFactor { size, kind: Kind::Cholesky(factor) }),
            Err(faer::sparse::linalg::LltError::Numeric(
                faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index },
            )) => Err(LinearSystemError::NotPositiveDefinite {
                what: "pivot",
                index,
                value: self.entry(index, index),
            }),
            Err(_) => Err(LinearSystemError::StepLimit { size }),
        }
    }

    /// A factorisation for [`SparseFactor::solve`]: Cholesky if the matrix is symmetric and positive definite, otherwise by elimination.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`, `NonFinite`, `Singular`, `StepLimit` (memory).
    pub fn factorise(&self) -> Result<SparseFactor, LinearSystemError> {
        let size = self.check_solvable()?;
        // Assembly in a different order of the cells leaves rounding errors of this size.
        if self.is_symmetric(1e-13)
            && let Ok(factor) = self.cholesky()
        {
            return Ok(factor);
        }
        match self.view().sp_lu() {
            Ok(factor) => Ok(SparseFactor { size, kind: Kind::Lu(factor) }),
            Err(faer::sparse::linalg::LuError::SymbolicSingular { .. }) => {
                Err(LinearSystemError::Singular { size })
            }
            Err(_) => Err(LinearSystemError::StepLimit { size }),
        }
    }

    fn check_solvable(&self) -> Result<usize, LinearSystemError> {
        check_size("columns", self.rows(), self.column_count)?;
        check_finite("value", &self.values)?;
        Ok(self.rows())
    }

    /// The transposed matrix for faer, whose columns are our rows.
    fn view(&self) -> SparseColMatRef<'_, usize, f64> {
        let (size, columns) = (self.column_count, self.rows());
        let pattern = SymbolicSparseColMatRef::new_checked(size, columns, &self.starts, None, &self.columns);
        SparseColMatRef::new(pattern, &self.values)
    }
}

impl LinearOperator for SparseMatrix {
    fn size(&self) -> usize {
        self.rows()
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        self.multiply(x, product).expect("a square matrix and slices of its size");
    }
}

/// A factorised sparse matrix.
#[derive(Clone)]
pub struct SparseFactor {
    size: usize,
    kind: Kind,
}

#[derive(Clone)]
enum Kind {
    Cholesky(Llt<usize, f64>),
    /// Of the transposed matrix.
    Lu(Lu<usize, f64>),
}

impl SparseFactor {
    /// Whether the matrix was symmetric and positive definite.
    pub fn is_cholesky(&self) -> bool {
        matches!(self.kind, Kind::Cholesky(_))
    }

    /// The solution for one right side.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`, `NonFinite`, `Singular` when elimination met a vanishing pivot.
    pub fn solve(&self, right_side: &[f64]) -> Result<Vec<f64>, LinearSystemError> {
        check_size("entries of the right side", self.size, right_side.len())?;
        check_finite("entry of the right side", right_side)?;
        let column = MatRef::from_column_major_slice(right_side, self.size, 1);
        let solution = match &self.kind {
            Kind::Cholesky(factor) => factor.solve(column),
            Kind::Lu(factor) => factor.solve_transpose(column),
        };
        let solution: Vec<f64> = (0..self.size).map(|i| solution[(i, 0)]).collect();
        if solution.iter().any(|x| !x.is_finite()) {
            return Err(LinearSystemError::Singular { size: self.size });
        }
        Ok(solution)
    }
}

impl Debug for SparseFactor {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("SparseFactor")
            .field("size", &self.size)
            .field("is_cholesky", &self.is_cholesky())
            .finish()
    }
}

fn check_index(what: &'static str, index: usize, limit: usize) -> Result<(), LinearSystemError> {
    if index < limit { Ok(()) } else { Err(LinearSystemError::IndexOutOfRange { what, index, limit }) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    fn sample() -> SparseMatrix {
        let triplets = [(0, 2, 1.5), (1, 0, -2.0), (2, 1, 3.0), (0, 0, 1.0), (0, 2, 0.5), (2, 2, 4.0)];
        SparseMatrix::from_triplets(3, 3, &triplets).unwrap()
    }

    #[test]
    fn triplets_at_the_same_place_are_added_and_the_product_is_the_dense_one() {
        let matrix = sample();
        assert_eq!(matrix.entry(0, 2), 2.0, "two triplets");
        assert_eq!(matrix.entry_count(), 5, "five places");
        let mut product = [0.0; 3];
        matrix.multiply(&[1.0, 2.0, 3.0], &mut product).unwrap();
        assert_eq!(product.to_vec(), matrix.to_dense().unwrap().multiply(&[1.0, 2.0, 3.0]).unwrap(), "Ax");
    }

    #[test]
    fn transposing_and_multiplying_agree_with_the_definition() {
        let matrix = sample();
        let square = matrix.times(&matrix.transpose()).unwrap();
        for i in 0..3 {
            for j in 0..3 {
                let sum: f64 = (0..3).map(|k| matrix.entry(i, k) * matrix.entry(j, k)).sum();
                assert_eq!(square.entry(i, j), sum, "entry {i}, {j} of A·Aᵗ");
                assert_eq!(matrix.transpose().entry(i, j), matrix.entry(j, i), "entry {i}, {j} of Aᵗ");
            }
        }
        assert!(square.is_symmetric(0.0) && !matrix.is_symmetric(0.1), "A·Aᵗ is symmetric, A is not");
    }

    #[test]
    fn both_factorisations_solve_and_singular_matrices_are_named() {
        let (general, x) = (sample(), [1.0, -2.0, 0.5]);
        let definite = general.times(&general.transpose()).unwrap();
        for (matrix, cholesky) in [(&general, false), (&definite, true)] {
            let factor = matrix.factorise().unwrap();
            assert_eq!(factor.is_cholesky(), cholesky, "the kind of factor");
            let mut b = [0.0; 3];
            matrix.multiply(&x, &mut b).unwrap();
            for (got, wanted) in factor.solve(&b).unwrap().iter().zip(x) {
                assert!((got - wanted).abs() < 1e-13, "{got} is not {wanted}");
            }
        }
        assert_eq!(general.cholesky().unwrap_err().name(), "NotPositiveDefinite", "not symmetric");
        let empty_row = SparseMatrix::from_triplets(2, 2, &[(0, 0, 1.0)]).unwrap();
        let named = empty_row.factorise().and_then(|factor| factor.solve(&[1.0, 1.0])).unwrap_err().name();
        assert_eq!(named, "Singular", "an empty row");
        let ones = [(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0)];
        let ones = SparseMatrix::from_triplets(2, 2, &ones).unwrap();
        let named = ones.factorise().and_then(|factor| factor.solve(&[1.0, 2.0])).unwrap_err().name();
        assert_eq!(named, "Singular", "rank 1");
    }

    #[test]
    fn places_that_do_not_exist_are_refused() {
        let name = |result: Result<SparseMatrix, LinearSystemError>| result.unwrap_err().name();
        assert_eq!(name(SparseMatrix::from_triplets(2, 2, &[(2, 0, 1.0)])), "IndexOutOfRange", "row");
        assert_eq!(name(SparseMatrix::from_triplets(2, 2, &[(0, 0, f64::NAN)])), "NonFinite", "value");
        assert_eq!(name(SparseMatrix::from_row_patterns(2, &[vec![1, 0]])), "IndexOutOfRange", "order");
        assert!(!sample().add(1, 1, 1.0), "outside the pattern");
    }
}
