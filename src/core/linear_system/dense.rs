//! Small dense matrices: solution by elimination with partial pivoting, eigenvalues of symmetric ones.
//!
//! Row-major: entry `(i, j)` of an `r × c` matrix stands at `i c + j`.

use faer::Side;
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve as _;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use crate::core::linear_system::error::{LinearSystemError, check_finite, check_size};

/// A dense matrix with finite entries.
#[derive(Clone, Debug, PartialEq)]
pub struct DenseMatrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
}

impl DenseMatrix {
    /// A matrix of row-major `entries`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `rows·columns` entries, `NonFinite`.
    pub fn new(rows: usize, columns: usize, entries: Vec<f64>) -> Result<Self, LinearSystemError> {
        check_size("entries", rows.saturating_mul(columns), entries.len())?;
        check_finite("entry", &entries)?;
        Ok(Self { rows, columns, entries })
    }

    /// The matrix with entries `entry(i, j)`.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn from_function(
        rows: usize,
        columns: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Result<Self, LinearSystemError> {
        let entries = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        Self::new(rows, columns, entries.map(|(i, j)| entry(i, j)).collect())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Row `i`, empty if there is no such row.
    pub fn row(&self, i: usize) -> &[f64] {
        self.entries.get(i * self.columns..(i + 1) * self.columns).unwrap_or(&[])
    }

    /// The product `A x`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn multiply(&self, x: &[f64]) -> Result<Vec<f64>, LinearSystemError> {
        check_size("entries of the vector", self.columns, x.len())?;
        Ok((0..self.rows).map(|i| self.row(i).iter().zip(x).map(|(a, x)| a * x).sum()).collect())
    }

    /// The solution of `A x = right_side`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` (also for a matrix that is not square), `NonFinite`, `Singular` when a pivot vanishes up
    /// to rounding.
    pub fn solve(&self, right_side: &[f64]) -> Result<Vec<f64>, LinearSystemError> {
        self.check_square()?;
        check_size("entries of the right side", self.rows, right_side.len())?;
        check_finite("entry of the right side", right_side)?;
        let factor = self.view().partial_piv_lu();
        let largest = self.entries.iter().fold(0.0, |max: f64, a| max.max(a.abs()));
        let tiny = largest * f64::EPSILON * self.rows as f64;
        if (0..self.rows).any(|i| factor.U()[(i, i)].abs() <= tiny) {
            return Err(LinearSystemError::Singular { size: self.rows });
        }
        let solution = factor.solve(MatRef::from_column_major_slice(right_side, self.rows, 1));
        Ok((0..self.rows).map(|i| solution[(i, 0)]).collect())
    }

    /// The eigenvalues of a symmetric matrix, increasing; only the lower triangle is read.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a matrix that is not square, `NotConverged`.
    pub fn symmetric_eigenvalues(&self) -> Result<Vec<f64>, LinearSystemError> {
        self.check_square()?;
        self.view().self_adjoint_eigenvalues(Side::Lower).map_err(|_| not_converged())
    }

    /// Eigenvalues, increasing, and orthonormal eigenvectors (as rows) of a symmetric matrix; only the lower
    /// triangle is read.
    ///
    /// # Errors
    ///
    /// As [`Self::symmetric_eigenvalues`].
    pub fn symmetric_eigenvectors(&self) -> Result<(Vec<f64>, Self), LinearSystemError> {
        self.check_square()?;
        let eigen = self.view().self_adjoint_eigen(Side::Lower).map_err(|_| not_converged())?;
        let values = eigen.S().column_vector().iter().copied().collect();
        let vectors: Mat<f64> = eigen.U().to_owned();
        Ok((values, Self::from_function(self.rows, self.rows, |i, j| vectors[(j, i)])?))
    }

    /// Writes the product `A B` into `product`, or `Aᵗ B` if `transposed`; `right` and `product` are row-major with
    /// `columns` columns.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn write_product(
        &self,
        transposed: bool,
        right: &[f64],
        columns: usize,
        product: &mut [f64],
    ) -> Result<(), LinearSystemError> {
        let left = if transposed { self.view().transpose() } else { self.view() };
        check_size("entries of the right factor", left.ncols() * columns, right.len())?;
        check_size("places for the product", left.nrows() * columns, product.len())?;
        let right = MatRef::from_row_major_slice(right, left.ncols(), columns);
        let target = MatMut::from_row_major_slice_mut(product, left.nrows(), columns);
        matmul(target, Accum::Replace, left, right, 1.0, Par::Seq);
        Ok(())
    }

    /// Writes the product `L A` into `product`, or `L Aᵗ` if `transposed`; `left` and `product` are row-major with
    /// `rows` rows.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn write_left_product(
        &self,
        transposed: bool,
        left: &[f64],
        rows: usize,
        product: &mut [f64],
    ) -> Result<(), LinearSystemError> {
        let right = if transposed { self.view().transpose() } else { self.view() };
        check_size("entries of the left factor", rows * right.nrows(), left.len())?;
        check_size("places for the product", rows * right.ncols(), product.len())?;
        let left = MatRef::from_row_major_slice(left, rows, right.nrows());
        let target = MatMut::from_row_major_slice_mut(product, rows, right.ncols());
        matmul(target, Accum::Replace, left, right, 1.0, Par::Seq);
        Ok(())
    }

    fn check_square(&self) -> Result<(), LinearSystemError> {
        check_size("columns", self.rows, self.columns)
    }

    fn view(&self) -> MatRef<'_, f64> {
        MatRef::from_row_major_slice(&self.entries, self.rows, self.columns)
    }
}

fn not_converged() -> LinearSystemError {
    LinearSystemError::NotConverged { steps: 0, residual: f64::NAN, tolerance: f64::EPSILON }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn the_hilbert_matrix_of_size_six_is_solved_to_its_condition() {
        let hilbert = DenseMatrix::from_function(6, 6, |i, j| 1.0 / (i + j + 1) as f64).unwrap();
        let x: Vec<f64> = (0..6).map(|i| f64::from(i) - 2.5).collect();
        let again = hilbert.solve(&hilbert.multiply(&x).unwrap()).unwrap();
        for (a, b) in x.iter().zip(&again) {
            assert!((a - b).abs() < 1.5e7 * 2.2e-16 * 10.0, "{a} became {b}");
        }
    }

    #[test]
    fn the_second_difference_has_the_eigenvalues_of_the_string() {
        let n = 7;
        let matrix = DenseMatrix::from_function(n, n, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        })
        .unwrap();
        let (values, vectors) = matrix.symmetric_eigenvectors().unwrap();
        for k in 0..n {
            let exact = 2.0 - 2.0 * ((k as f64 + 1.0) * std::f64::consts::PI / (n as f64 + 1.0)).cos();
            assert!((matrix.symmetric_eigenvalues().unwrap()[k] - exact).abs() < 1e-14, "eigenvalue {k}");
            let image = matrix.multiply(vectors.row(k)).unwrap();
            for (a, v) in image.iter().zip(vectors.row(k)) {
                assert!((a - values[k] * v).abs() < 1e-14, "eigenvector {k}");
            }
        }
    }

    #[test]
    fn impossible_systems_are_refused() {
        let ones = DenseMatrix::new(2, 2, vec![1.0; 4]).unwrap();
        assert_eq!(ones.solve(&[1.0, 1.0]), Err(LinearSystemError::Singular { size: 2 }), "rank 1");
        assert_eq!(ones.solve(&[1.0]).unwrap_err().name(), "SizeMismatch", "short right side");
        assert_eq!(DenseMatrix::new(1, 2, vec![1.0, f64::NAN]).unwrap_err().name(), "NonFinite", "NaN");
        let empty = DenseMatrix::new(0, 0, vec![]).unwrap();
        assert_eq!(empty.solve(&[]), Ok(vec![]), "no unknown");
    }

    #[test]
    fn products_from_both_sides_are_sums_of_products() {
        let a = DenseMatrix::new(2, 3, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).unwrap();
        let mut product = [0.0; 4];
        a.write_product(false, &[1.0, 0.0, 0.0, 1.0, 1.0, 1.0], 2, &mut product).unwrap();
        assert_eq!(product, [4.0, 5.0, 10.0, 11.0], "A B");
        a.write_left_product(true, &[1.0, 0.0, 1.0, 0.0, 2.0, 0.0], 2, &mut product).unwrap();
        assert_eq!(product, [4.0, 10.0, 4.0, 10.0], "L times the transpose");
        let mut product = [0.0; 3];
        a.write_product(true, &[1.0, -1.0], 1, &mut product).unwrap();
        assert_eq!(product, [-3.0; 3], "the transpose times B");
        a.write_left_product(false, &[1.0, -1.0], 1, &mut product).unwrap();
        assert_eq!(product, [-3.0; 3], "L A");
        let error = a.write_product(false, &[1.0; 2], 1, &mut product).unwrap_err();
        assert_eq!(error.name(), "SizeMismatch", "two rows for three columns");
    }
}
