//! Linear systems: dense and sparse matrices, direct solution, and conjugate gradients.

mod conjugate_gradients;
mod dense;
mod error;
mod sparse;

pub use conjugate_gradients::{
    ConjugateGradients, DiagonalPreconditioner, IterationLimits, LinearOperator, NoPreconditioner,
    Preconditioner, conjugate_gradients,
};
pub use dense::DenseMatrix;
pub use error::LinearSystemError;
pub use sparse::{SparseFactor, SparseMatrix};
