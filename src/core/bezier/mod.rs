//! Chapter 2: Bezier curves.
//!
//! | section | file | what |
//! |---|---|---|
//! | 2.1 | `curve` | control polygon, evaluation, monomial form, graphs |
//! | 2.3 | `de_casteljau` | the scheme, the blossom, evaluation in linear time |
//! | 2.3 | `degree` | degree elevation |

mod curve;
mod de_casteljau;
mod degree;
mod error;

pub use curve::BezierCurve;
pub use error::BezierError;
