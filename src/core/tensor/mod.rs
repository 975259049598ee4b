//! Chapter 7: splines of several variables.
//!
//! | file | what |
//! |---|---|
//! | `space` | 7.3 one spline space for each direction |
//! | `tensor_product` | 7.3, 7.4 the spline, its values and partial derivatives |
//! | `marsden` | 7.3 polynomials as splines |
//! | `relevance` | 7.3 B-splines that matter for a domain |
//! | `box_spline` | 7.3 box splines of the plane |
//! | `uniform_tableau` | 7.4 de Boor's algorithm without divisions |
//! | `derivative` | 7.4 partial derivatives as splines and as sums that may jump |
//! | `grid` | 7.4 values on a grid |
//! | `refinement` | 7.4, 8.2 knot insertion, degree elevation, Bezier form |
//! | `subdivision` | 8.3 uniform refinement of a net |

mod box_spline;
mod derivative;
mod error;
mod grid;
mod marsden;
mod refinement;
mod relevance;
mod space;
mod subdivision;
mod tensor_product;
mod uniform_tableau;

pub use box_spline::box_spline;
pub use derivative::TensorSum;
pub use error::TensorError;
pub use grid::AxisTable;
pub use refinement::BezierCell;
pub use relevance::{CellPosition, Relevance, RelevanceMask};
pub use space::TensorSplineSpace;
pub use subdivision::{Net, subdivide_net};
pub use tensor_product::{PartialDerivatives, TensorSpline};
pub use uniform_tableau::UniformTableau;
