//! Systems of linear equations, one file for each kind of matrix and method.

mod band_error;
mod banded;
mod banded_cholesky;
mod banded_least_squares;
mod banded_lu;
mod cyclic_banded;

pub use band_error::BandError;
pub use banded::BandMatrix;
pub use banded_cholesky::BandCholesky;
pub use banded_least_squares::BandLeastSquares;
pub use banded_lu::{BandLu, PivotedBandLu};
pub use cyclic_banded::CyclicLu;
