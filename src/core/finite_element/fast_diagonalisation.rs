//! Tensor-product systems through two small eigenproblems.
//!
//! For matrices of one variable, `K` symmetric and `M` symmetric positive definite, `K V = M V Λ` and `Vᵗ M V = I`. Then
//!
//! ```text
//! A = K₁ ⊗ M₂ + M₁ ⊗ K₂ + c M₁ ⊗ M₂,   A⁻¹ = (V₁ ⊗ V₂) (Λ₁ ⊕ Λ₂ + c)⁻¹ (V₁ ⊗ V₂)ᵗ.
//! ```
//!
//! It solves problems with separable coefficients directly, and is a preconditioner for all others whose quality
//! depends neither on the mesh nor on the degree. If `A` has a constant in its kernel, its denominator is left out.
//!
//! R. Lynch, J. Rice, D. Thomas, *Direct solution of partial difference equations by tensor product methods*, 1964;
//! G. Sangalli, M. Tani, *Isogeometric preconditioners based on fast solvers for the Sylvester equation*, 2016.

use std::ops::Range;

use crate::core::linear_system::{DenseMatrix, LinearSystemError, Preconditioner};

/// A denominator this much smaller than the largest one is zero.
const ZERO_DENOMINATOR: f64 = 1e-13;

/// Stiffness and mass matrix of one direction, both symmetric.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionMatrices {
    /// `K`.
    pub stiffness: DenseMatrix,
    /// `M`, positive definite.
    pub mass: DenseMatrix,
}

/// Eigenvalues and eigenvectors of both directions.
#[derive(Clone, Debug, PartialEq)]
pub struct FastDiagonalisation {
    sizes: [usize; 2],
    free: [Range<usize>; 2],
    eigenvalues: [Vec<f64>; 2],
    /// Rows are eigenvectors, in the free coefficients.
    vectors: [DenseMatrix; 2],
    /// `1/(λᵢ + λⱼ + c)`, or 0.
    inverses: Vec<f64>,
}

impl FastDiagonalisation {
    /// Diagonalises the system of the coefficients `free[0] × free[1]` among `m₁ × m₂`; the others are 0.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for matrices that are not square or too small for `free`, `NotPositiveDefinite` for `M` or for a
    /// negative denominator, `NotConverged`.
    pub fn new(
        matrices: [&DirectionMatrices; 2],
        free: [Range<usize>; 2],
        shift: f64,
    ) -> Result<Self, LinearSystemError> {
        let sizes = matrices.map(|matrices| matrices.mass.rows());
        let (first, first_vectors) = eigenvectors(matrices[0], &free[0])?;
        let (second, second_vectors) = eigenvectors(matrices[1], &free[1])?;
        let denominator = |i: usize, j: usize| first[i] + second[j] + shift;
        let largest = (0..first.len()).flat_map(|i| (0..second.len()).map(move |j| (i, j)));
        let largest = largest.fold(0.0, |most: f64, (i, j)| most.max(denominator(i, j).abs()));
        let mut inverses = Vec::with_capacity(first.len() * second.len());
        for i in 0..first.len() {
            for j in 0..second.len() {
                let value = denominator(i, j);
                if value < -ZERO_DENOMINATOR * largest {
                    let index = i * second.len() + j;
                    return Err(LinearSystemError::NotPositiveDefinite { what: "denominator", index, value });
                }
                inverses.push(if value <= ZERO_DENOMINATOR * largest { 0.0 } else { value.recip() });
            }
        }
        let vectors = [first_vectors, second_vectors];
        Ok(Self { sizes, free, eigenvalues: [first, second], vectors, inverses })
    }

    /// The eigenvalues of `K v = λ M v` in each direction, increasing.
    pub fn eigenvalues(&self) -> &[Vec<f64>; 2] {
        &self.eigenvalues
    }

    /// The eigenvectors of direction `axis` as rows, in the free coefficients; `vᵗ M v = 1`.
    pub fn eigenvectors(&self, axis: usize) -> Option<&DenseMatrix> {
        self.vectors.get(axis)
    }

    /// The solution for a right side with `m₁ m₂` entries, the second index fastest; entries that are not free are ignored, and 0 in the result.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn solve(&self, right_side: &[f64]) -> Result<Vec<f64>, LinearSystemError> {
        let mut solution = vec![0.0; self.sizes[0] * self.sizes[1]];
        if right_side.len() != solution.len() {
            let (expected, found) = (solution.len(), right_side.len());
            return Err(LinearSystemError::SizeMismatch {
                what: "entries of the right side",
                expected,
                found,
            });
        }
        self.write_solution(right_side, &mut solution)?;
        Ok(solution)
    }

    fn write_solution(&self, right_side: &[f64], solution: &mut [f64]) -> Result<(), LinearSystemError> {
        let [m1, m2] = [self.free[0].len(), self.free[1].len()];
        let stride = self.sizes[1];
        let rows = self.free[0].clone().map(|k1| k1 * stride + self.free[1].start);
        let mut left: Vec<f64> = Vec::with_capacity(m1 * m2);
        for start in rows.clone() {
            left.extend_from_slice(&right_side[start..start + m2]);
        }
        let mut right = vec![0.0; m1 * m2];
        self.vectors[0].write_product(false, &left, m2, &mut right)?;
        self.vectors[1].write_left_product(true, &right, m1, &mut left)?;
        for (entry, inverse) in left.iter_mut().zip(&self.inverses) {
            *entry *= inverse;
        }
        self.vectors[0].write_product(true, &left, m2, &mut right)?;
        self.vectors[1].write_left_product(false, &right, m1, &mut left)?;
        solution.fill(0.0);
        for (start, row) in rows.zip(left.chunks_exact(m2.max(1))) {
            solution[start..start + m2].copy_from_slice(row);
        }
        Ok(())
    }
}

impl Preconditioner for FastDiagonalisation {
    fn precondition(&self, residual: &[f64], corrected: &mut [f64]) {
        // Both slices have the size of the operator; if not, the iteration sees a direction that is not a number.
        if residual.len() != self.sizes[0] * self.sizes[1]
            || self.write_solution(residual, corrected).is_err()
        {
            corrected.fill(f64::NAN);
        }
    }
}

/// Eigenvalues and rows of eigenvectors of `K v = λ M v` in the free coefficients.
fn eigenvectors(
    matrices: &DirectionMatrices,
    free: &Range<usize>,
) -> Result<(Vec<f64>, DenseMatrix), LinearSystemError> {
    let DirectionMatrices { stiffness, mass } = matrices;
    for (what, found) in [
        ("columns of the mass matrix", mass.columns()),
        ("rows of the stiffness matrix", stiffness.rows()),
        ("columns of the stiffness matrix", stiffness.columns()),
    ] {
        if found != mass.rows() {
            return Err(LinearSystemError::SizeMismatch { what, expected: mass.rows(), found });
        }
    }
    if free.end > mass.rows() {
        let (expected, found) = (free.end, mass.rows());
        return Err(LinearSystemError::SizeMismatch { what: "rows", expected, found });
    }
    let size = free.len();
    let restricted = |matrix: &DenseMatrix| -> Vec<f64> {
        free.clone().flat_map(|i| &matrix.row(i)[free.clone()]).copied().collect()
    };
    let factor = BandedCholesky::new(restricted(mass), size)?;
    // C = L⁻¹ K L⁻ᵗ has the eigenvalues wanted and the eigenvectors Lᵗ v.
    let mut reduced = restricted(stiffness);
    factor.solve_rows(&mut reduced);
    let transposed = (0..size * size).map(|at| reduced[(at % size) * size + at / size]);
    reduced = transposed.collect();
    factor.solve_rows(&mut reduced);
    let (values, vectors) = DenseMatrix::new(size, size, reduced)?.symmetric_eigenvectors()?;
    let mut rows = Vec::with_capacity(size * size);
    for i in 0..size {
        rows.extend_from_slice(vectors.row(i));
        factor.solve_transposed(&mut rows[i * size..]);
    }
    Ok((values, DenseMatrix::new(size, size, rows)?))
}

/// `M = L Lᵗ` with the bandwidth of `M`.
struct BandedCholesky {
    size: usize,
    bandwidth: usize,
    lower: Vec<f64>,
}

impl BandedCholesky {
    fn new(mut lower: Vec<f64>, size: usize) -> Result<Self, LinearSystemError> {
        let far = |i: usize| (0..i).find(|&j| lower[i * size + j] != 0.0).map_or(0, |j| i - j);
        let bandwidth = (0..size).map(far).max().unwrap_or(0);
        for i in 0..size {
            for j in i.saturating_sub(bandwidth)..=i {
                let from = i.saturating_sub(bandwidth);
                let sum: f64 = (from..j).map(|k| lower[i * size + k] * lower[j * size + k]).sum();
                let value = lower[i * size + j] - sum;
                lower[i * size + j] = if i > j {
                    value / lower[j * size + j]
                } else if value > 0.0 {
                    value.sqrt()
                } else {
                    return Err(LinearSystemError::NotPositiveDefinite { what: "pivot", index: i, value });
                };
            }
        }
        Ok(Self { size, bandwidth, lower })
    }

    /// Replaces the square matrix by `L⁻¹` times it.
    fn solve_rows(&self, matrix: &mut [f64]) {
        let size = self.size;
        for i in 0..size {
            let (done, rest) = matrix.split_at_mut(i * size);
            let row = &mut rest[..size];
            for j in i.saturating_sub(self.bandwidth)..i {
                let factor = self.lower[i * size + j];
                for (entry, above) in row.iter_mut().zip(&done[j * size..]) {
                    *entry -= factor * above;
                }
            }
            let pivot = self.lower[i * size + i];
            row.iter_mut().for_each(|entry| *entry /= pivot);
        }
    }

    /// Replaces the vector by `L⁻ᵗ` times it.
    fn solve_transposed(&self, vector: &mut [f64]) {
        for i in (0..self.size).rev() {
            let until = (i + self.bandwidth + 1).min(self.size);
            let sum: f64 = (i + 1..until).map(|j| self.lower[j * self.size + i] * vector[j]).sum();
            vector[i] = (vector[i] - sum) / self.lower[i * self.size + i];
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use proptest::prelude::*;

    /// Diagonally dominant, so positive definite, with bandwidth 2.
    fn matrices(size: usize, seed: usize) -> DirectionMatrices {
        let entry = |i: usize, j: usize, diagonal: f64| match i.abs_diff(j) {
            0 => diagonal + ((i + seed) % 3) as f64,
            1 | 2 => (((i + j) * (seed + 2)) % 5) as f64 * 0.2 - 0.4,
            _ => 0.0,
        };
        let matrix = |diagonal| DenseMatrix::from_function(size, size, |i, j| entry(i, j, diagonal)).unwrap();
        DirectionMatrices { stiffness: matrix(5.0), mass: matrix(2.0) }
    }

    proptest! {
        #[test]
        fn the_solution_satisfies_the_tensor_product_system(
            m1 in 1_usize..6, m2 in 1_usize..7, seed in 0_usize..9, shift in 0.0..3.0_f64, fixed in 0_usize..2,
        ) {
            let (first, second) = (matrices(m1 + fixed, seed), matrices(m2, seed + 1));
            let solver = FastDiagonalisation::new([&first, &second], [fixed..m1 + fixed, 0..m2], shift).unwrap();
            let right: Vec<f64> = (0..(m1 + fixed) * m2).map(|i| (i % 7) as f64 - 2.5).collect();
            let solution = solver.solve(&right).unwrap();
            prop_assert!(solution[..fixed * m2].iter().all(|u| *u == 0.0), "coefficients that are not free");
            for i in fixed..m1 + fixed {
                for j in 0..m2 {
                    let mut sum = 0.0;
                    for k in fixed..m1 + fixed {
                        for l in 0..m2 {
                            let (k1, m_1) = (first.stiffness.row(i)[k], first.mass.row(i)[k]);
                            let (k2, m_2) = (second.stiffness.row(j)[l], second.mass.row(j)[l]);
                            sum += (k1 * m_2 + m_1 * k2 + shift * m_1 * m_2) * solution[k * m2 + l];
                        }
                    }
                    let error = sum - right[i * m2 + j];
                    prop_assert!(error.abs() < 1e-12, "row ({i}, {j}): {error}");
                }
            }
        }
    }

    #[test]
    fn impossible_systems_are_refused() {
        let good = matrices(3, 1);
        let zero = DenseMatrix::new(3, 3, vec![0.0; 9]).unwrap();
        let bad = DirectionMatrices { mass: zero, ..good.clone() };
        let name = |first: &DirectionMatrices, free: [Range<usize>; 2], shift: f64| {
            FastDiagonalisation::new([first, &good], free, shift).unwrap_err().name()
        };
        assert_eq!(name(&bad, [0..3, 0..3], 0.0), "NotPositiveDefinite", "no mass");
        assert_eq!(name(&good, [0..4, 0..3], 0.0), "SizeMismatch", "a fourth coefficient");
        assert_eq!(name(&good, [0..3, 0..3], -100.0), "NotPositiveDefinite", "a negative shift");
    }
}
