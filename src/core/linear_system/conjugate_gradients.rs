//! Conjugate gradients for symmetric positive definite systems `A x = b`.
//!
//! With `z = C r` for a preconditioner `C ≈ A⁻¹`:
//!
//! ```text
//! α = r·z / p·Ap,   x += α p,   r −= α Ap,   β = (r·z)new / (r·z)old,   p = z + β p.
//! ```
//!
//! The iteration ends when `|r| ≤ tolerance·|b|` in the Euclidean norm. It also solves a singular system whose right side is orthogonal to the kernel.
//!
//! M. Hestenes, E. Stiefel, *Methods of conjugate gradients for solving linear systems*, 1952. Course: section 9.4.

use crate::core::linear_system::error::{LinearSystemError, check_finite, check_size};
use crate::core::progress::Watcher;

/// A square matrix that is known by its products.
pub trait LinearOperator {
    /// Number of rows and columns.
    fn size(&self) -> usize;

    /// Writes the product `A x` into `product`; both slices have [`Self::size`] entries.
    fn apply(&self, x: &[f64], product: &mut [f64]);
}

/// An approximate inverse; symmetric and positive definite.
pub trait Preconditioner {
    /// Writes `C r` into `corrected`.
    fn precondition(&self, residual: &[f64], corrected: &mut [f64]);
}

/// The identity.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoPreconditioner;

impl Preconditioner for NoPreconditioner {
    fn precondition(&self, residual: &[f64], corrected: &mut [f64]) {
        corrected.copy_from_slice(residual);
    }
}

/// Division by the matrix's diagonal (Jacobi).
#[derive(Clone, Debug, PartialEq)]
pub struct DiagonalPreconditioner {
    inverse: Vec<f64>,
}

impl DiagonalPreconditioner {
    /// The preconditioner of a matrix with this `diagonal`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `NotPositiveDefinite` for an entry that is not positive.
    pub fn new(diagonal: &[f64]) -> Result<Self, LinearSystemError> {
        check_finite("diagonal entry", diagonal)?;
        if let Some(index) = diagonal.iter().position(|entry| *entry <= 0.0) {
            let value = diagonal[index];
            return Err(LinearSystemError::NotPositiveDefinite { what: "diagonal entry", index, value });
        }
        Ok(Self { inverse: diagonal.iter().map(|entry| entry.recip()).collect() })
    }
}

impl Preconditioner for DiagonalPreconditioner {
    fn precondition(&self, residual: &[f64], corrected: &mut [f64]) {
        for ((z, r), inverse) in corrected.iter_mut().zip(residual).zip(&self.inverse) {
            *z = r * inverse;
        }
    }
}

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IterationLimits {
    /// Norm of the residual over norm of the right side that is good enough; positive.
    pub relative_tolerance: f64,
    /// The largest number of steps.
    pub max_steps: usize,
}

impl Default for IterationLimits {
    fn default() -> Self {
        Self { relative_tolerance: 1e-12, max_steps: 10_000 }
    }
}

/// The solution, and how the iteration went.
#[derive(Clone, Debug, PartialEq)]
pub struct ConjugateGradients {
    /// `x`.
    pub solution: Vec<f64>,
    /// `|r|` before the first step and after each one: one entry more than steps.
    pub residuals: Vec<f64>,
}

impl ConjugateGradients {
    /// Number of steps.
    pub fn steps(&self) -> usize {
        self.residuals.len() - 1
    }
}

/// Solves `A x = right_side` from `start`, or from 0.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite` (data, or a product), `InvalidTolerance`, `NotPositiveDefinite` (a step meets `p·Ap ≤ 0`), `NotConverged`, `Stopped`.
pub fn conjugate_gradients(
    matrix: &impl LinearOperator,
    right_side: &[f64],
    start: Option<&[f64]>,
    preconditioner: &impl Preconditioner,
    limits: IterationLimits,
    watcher: &dyn Watcher,
) -> Result<ConjugateGradients, LinearSystemError> {
    let size = matrix.size();
    check_size("entries of the right side", size, right_side.len())?;
    check_finite("entry of the right side", right_side)?;
    let tolerance = limits.relative_tolerance;
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(LinearSystemError::InvalidTolerance { value: tolerance });
    }
    let mut residual = right_side.to_vec();
    let mut product = vec![0.0; size];
    let mut solution = vec![0.0; size];
    if let Some(start) = start {
        check_size("entries of the start", size, start.len())?;
        check_finite("entry of the start", start)?;
        solution.copy_from_slice(start);
        matrix.apply(start, &mut product);
        add_multiple(&mut residual, -1.0, &product);
    }
    let enough = tolerance * norm(right_side);
    let mut residuals = vec![norm(&residual)];
    let mut corrected = vec![0.0; size];
    let mut direction = vec![0.0; size];
    let mut energy = 1.0;
    for step in 0.. {
        let now = residuals[step];
        if now <= enough {
            return Ok(ConjugateGradients { solution, residuals });
        }
        if !now.is_finite() {
            return Err(LinearSystemError::NonFinite { what: "residual of step", index: step, value: now });
        }
        if step == limits.max_steps {
            // The norm of the right side is positive here unless only the start was off.
            let residual = now / norm(right_side);
            return Err(LinearSystemError::NotConverged { steps: step, residual, tolerance });
        }
        if step % 16 == 0 {
            // The residual falls by a constant factor on average, so its logarithm tells the time.
            watcher.check(((residuals[0] / now).ln() / (residuals[0] / enough).ln()).clamp(0.0, 1.0))?;
        }
        preconditioner.precondition(&residual, &mut corrected);
        let old_energy = std::mem::replace(&mut energy, dot(&residual, &corrected));
        let beta = if step == 0 { 0.0 } else { energy / old_energy };
        for (p, z) in direction.iter_mut().zip(&corrected) {
            *p = z + beta * *p;
        }
        matrix.apply(&direction, &mut product);
        let curvature = dot(&direction, &product);
        if curvature <= 0.0 {
            return Err(LinearSystemError::NotPositiveDefinite {
                what: "step",
                index: step,
                value: curvature,
            });
        }
        let alpha = energy / curvature;
        add_multiple(&mut solution, alpha, &direction);
        add_multiple(&mut residual, -alpha, &product);
        residuals.push(norm(&residual));
    }
    unreachable!("the loop has no end of its own")
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Eight sums at once; one running sum would wait for every addition.
    let mut sums = [0.0; 8];
    let (a_blocks, a_rest) = a.as_chunks::<8>();
    let (b_blocks, b_rest) = b.as_chunks::<8>();
    for (x, y) in a_blocks.iter().zip(b_blocks) {
        for i in 0..8 {
            sums[i] += x[i] * y[i];
        }
    }
    sums.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum::<f64>()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn add_multiple(target: &mut [f64], factor: f64, other: &[f64]) {
    for (t, o) in target.iter_mut().zip(other) {
        *t += factor * o;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::linear_system::SparseMatrix;
    use crate::core::progress::Unwatched;

    fn membrane(size: usize) -> SparseMatrix {
        let entry = |i: usize, j: usize| if i == j { 2.0 } else { -1.0 };
        let near = |i: usize| (i.saturating_sub(1)..(i + 2).min(size)).map(move |j| (i, j, entry(i, j)));
        SparseMatrix::from_triplets(size, size, &(0..size).flat_map(near).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_system_with_few_eigenvalues_takes_as_many_steps() {
        let matrix = SparseMatrix::from_triplets(4, 4, &[(0, 0, 1.0), (1, 1, 1.0), (2, 2, 5.0), (3, 3, 5.0)]);
        let limits = IterationLimits { relative_tolerance: 1e-13, max_steps: 10 };
        let b = [1.0, 2.0, 3.0, 4.0];
        let run =
            conjugate_gradients(&matrix.unwrap(), &b, None, &NoPreconditioner, limits, &Unwatched).unwrap();
        assert_eq!(run.steps(), 2, "two eigenvalues: {:?}", run.residuals);
    }

    #[test]
    fn the_solution_of_the_string_is_a_parabola_and_a_good_start_needs_no_step() {
        let matrix = membrane(30);
        let b = vec![1.0; 30];
        let limits = IterationLimits::default();
        let diagonal = DiagonalPreconditioner::new(&matrix.diagonal()).unwrap();
        let run = conjugate_gradients(&matrix, &b, None, &diagonal, limits, &Unwatched).unwrap();
        for (i, x) in run.solution.iter().enumerate() {
            let exact = 0.5 * (i as f64 + 1.0) * (30.0 - i as f64);
            assert!((x - exact).abs() < 1e-9, "entry {i}: {x}, exact {exact}");
        }
        let limits = IterationLimits { relative_tolerance: 1e-10, ..limits };
        let again =
            conjugate_gradients(&matrix, &b, Some(&run.solution), &diagonal, limits, &Unwatched).unwrap();
        assert_eq!(again.steps(), 0, "warm start");
    }

    #[test]
    fn what_cannot_be_solved_is_named() {
        let indefinite = SparseMatrix::from_triplets(2, 2, &[(0, 0, 1.0), (1, 1, -1.0)]).unwrap();
        let limits = IterationLimits { relative_tolerance: 1e-12, max_steps: 3 };
        let run = |matrix: &SparseMatrix, b: &[f64], limits| {
            let result = conjugate_gradients(matrix, b, None, &NoPreconditioner, limits, &Unwatched);
            result.map_or_else(|error| error.name(), |_| "ok")
        };
        assert_eq!(run(&indefinite, &[0.0, 1.0], limits), "NotPositiveDefinite", "negative curvature");
        assert_eq!(run(&membrane(30), &[1.0; 30], limits), "NotConverged", "three steps are too few");
        assert_eq!(run(&membrane(3), &[1.0; 2], limits), "SizeMismatch", "short right side");
        assert_eq!(run(&membrane(2), &[1.0, f64::NAN], limits), "NonFinite", "not a number");
        let zero = IterationLimits { relative_tolerance: 0.0, max_steps: 3 };
        assert_eq!(run(&membrane(2), &[1.0, 1.0], zero), "InvalidTolerance", "tolerance 0");
        let stopped = conjugate_gradients(
            &membrane(30),
            &[1.0; 30],
            None,
            &NoPreconditioner,
            IterationLimits::default(),
            &|_| false,
        );
        assert_eq!(stopped.unwrap_err().name(), "Stopped", "the watcher stops");
    }
}
