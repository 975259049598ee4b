//! Chapter 2: Bezier curves.
//!
//! | file | what |
//! |---|---|
//! | `curve` | 2.1 the curve, its monomial form, graphs of polynomials |
//! | `de_casteljau` | 2.3 scheme, blossom, fast evaluation |
//! | `degree` | 2.3 degree elevation and reduction |

mod curve;
mod de_casteljau;
mod degree;
mod error;

pub use curve::BezierCurve;
pub use degree::BezierReduction;
pub use error::BezierError;
