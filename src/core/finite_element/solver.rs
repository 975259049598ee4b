//! Solving Galerkin systems `G U = F`.
//!
//! Conjugate gradients with the diagonal preconditioner, or a direct factorisation. Without essential conditions constants lie in the kernel of `G`:
//! then `F` must sum to 0, and the solution is the one whose coefficients have mean 0; the caller adds the constant that fixes the mean value.
//!
//! Course: sections 9.1, 9.2 (pure Neumann problem) and 9.4.

use crate::core::finite_element::error::FiniteElementError;
use crate::core::linear_system::{
    DiagonalPreconditioner, IterationLimits, LinearOperator, LinearSystemError, SparseMatrix,
    conjugate_gradients,
};
use crate::core::progress::Watcher;

/// How a system is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Conjugate gradients with the diagonal preconditioner.
    ConjugateGradients(IterationLimits),
    /// Sparse Cholesky factorisation (elimination if the matrix is not positive definite).
    Direct,
}

impl Default for Method {
    fn default() -> Self {
        Self::ConjugateGradients(IterationLimits::default())
    }
}

/// A Galerkin matrix in whatever storage.
pub trait SystemMatrix: LinearOperator {
    /// The diagonal entries.
    fn diagonal(&self) -> Vec<f64>;

    /// The matrix in compressed rows.
    ///
    /// # Errors
    ///
    /// Only what the storage can meet, such as a size beyond the memory.
    fn to_sparse(&self) -> Result<SparseMatrix, LinearSystemError>;
}

impl SystemMatrix for SparseMatrix {
    fn diagonal(&self) -> Vec<f64> {
        self.diagonal()
    }

    fn to_sparse(&self) -> Result<SparseMatrix, LinearSystemError> {
        Ok(self.clone())
    }
}

/// The coefficients, and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemSolution {
    /// `U`.
    pub coefficients: Vec<f64>,
    /// Norms of the residuals, first the one of the start; empty for a direct solution.
    pub residuals: Vec<f64>,
}

/// Solves a system with a positive definite matrix; `start` warms conjugate gradients up.
///
/// # Errors
///
/// As [`conjugate_gradients`] and [`SparseMatrix::factorise`].
pub fn solve_system(
    matrix: &impl SystemMatrix,
    right_side: &[f64],
    start: Option<&[f64]>,
    method: Method,
    watcher: &dyn Watcher,
) -> Result<SystemSolution, FiniteElementError> {
    match method {
        Method::ConjugateGradients(limits) => {
            let diagonal = DiagonalPreconditioner::new(&matrix.diagonal())?;
            let run = conjugate_gradients(matrix, right_side, start, &diagonal, limits, watcher)?;
            Ok(SystemSolution { coefficients: run.solution, residuals: run.residuals })
        }
        Method::Direct => {
            watcher.check(0.0)?;
            let coefficients = matrix.to_sparse()?.factorise()?.solve(right_side)?;
            Ok(SystemSolution { coefficients, residuals: Vec::new() })
        }
    }
}

/// How far from 0 the sum of the right side may be, relative to the sum of moduli.
const COMPATIBLE: f64 = 1e-8;

/// Solves a system with the constants in the matrix's kernel; `free` tells which coefficients belong to it, the others must have unit rows.
///
/// # Errors
///
/// `IncompatibleData` unless the free entries of the right side sum to 0, otherwise as [`conjugate_gradients`].
pub fn solve_up_to_a_constant(
    matrix: &impl SystemMatrix,
    right_side: &[f64],
    free: &[bool],
    limits: IterationLimits,
    watcher: &dyn Watcher,
) -> Result<SystemSolution, FiniteElementError> {
    if free.len() != right_side.len() {
        let (expected, found) = (right_side.len(), free.len());
        return Err(FiniteElementError::SizeMismatch { what: "marks of free coefficients", expected, found });
    }
    let of_free = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(free).filter(|(_, free)| **free).map(|(value, _)| *value).collect()
    };
    let entries = of_free(right_side);
    let (sum, scale) = (entries.iter().sum::<f64>(), entries.iter().map(|entry| entry.abs()).sum::<f64>());
    if sum.abs() > COMPATIBLE * scale {
        return Err(FiniteElementError::IncompatibleData { sum, scale });
    }
    let mean = sum / entries.len().max(1) as f64;
    let balanced: Vec<f64> =
        right_side.iter().zip(free).map(|(value, free)| if *free { value - mean } else { *value }).collect();
    let diagonal = DiagonalPreconditioner::new(&matrix.diagonal())?;
    let run = conjugate_gradients(matrix, &balanced, None, &diagonal, limits, watcher)?;
    let mut coefficients = run.solution;
    let free_coefficients = of_free(&coefficients);
    let mean = free_coefficients.iter().sum::<f64>() / free_coefficients.len().max(1) as f64;
    for (coefficient, free) in coefficients.iter_mut().zip(free) {
        *coefficient -= if *free { mean } else { 0.0 };
    }
    Ok(SystemSolution { coefficients, residuals: run.residuals })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::progress::Unwatched;

    /// The string with free ends and one dead coefficient: rows sum to 0.
    fn free_string() -> SparseMatrix {
        let triplets = [(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0), (1, 2, -1.0), (2, 1, -1.0)];
        SparseMatrix::from_triplets(4, 4, &[&triplets[..], &[(2, 2, 1.0), (3, 3, 1.0)]].concat()).unwrap()
    }

    #[test]
    fn a_balanced_load_on_a_free_string_has_a_solution_of_mean_zero() {
        let free = [true, true, true, false];
        let limits = IterationLimits::default();
        let solve = |f: &[f64]| solve_up_to_a_constant(&free_string(), f, &free, limits, &Unwatched);
        let u = solve(&[1.0, 0.0, -1.0, 0.0]).unwrap().coefficients;
        for (got, wanted) in u.iter().zip([1.0, 0.0, -1.0, 0.0]) {
            assert!((got - wanted).abs() < 1e-14, "{u:?}");
        }
        assert_eq!(solve(&[1.0, 0.0, 0.0, 0.0]).unwrap_err().name(), "IncompatibleData", "sum 1");
    }

    #[test]
    fn both_methods_give_the_same_coefficients() {
        let mut matrix = free_string();
        matrix.add(0, 0, 1.0);
        let f = [1.0, 2.0, 3.0, 4.0];
        let direct = solve_system(&matrix, &f, None, Method::Direct, &Unwatched).unwrap();
        let iterated = solve_system(&matrix, &f, None, Method::default(), &Unwatched).unwrap();
        for (a, b) in direct.coefficients.iter().zip(&iterated.coefficients) {
            assert!((a - b).abs() < 1e-12, "{a} and {b}");
        }
    }
}
