//! Systems of linear equations, one file for each kind of matrix and method.

mod band_error;
mod banded;
mod banded_cholesky;
mod banded_least_squares;
mod banded_lu;
mod conjugate_gradients;
mod cyclic_banded;
mod dense;
mod error;
mod sparse;

pub use band_error::BandError;
pub use banded::BandMatrix;
pub use banded_cholesky::BandCholesky;
pub use banded_least_squares::BandLeastSquares;
pub use banded_lu::{BandLu, PivotedBandLu};
pub use conjugate_gradients::{
    ConjugateGradients, DiagonalPreconditioner, IterationLimits, LinearOperator, NoPreconditioner,
    Preconditioner, conjugate_gradients,
};
pub use cyclic_banded::CyclicLu;
pub use dense::DenseMatrix;
pub use error::LinearSystemError;
pub use sparse::{SparseFactor, SparseMatrix};
