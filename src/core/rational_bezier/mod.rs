//! Chapter 3: rational Bezier curves and conics.
//!
//! | file | what |
//! |---|---|
//! | `curve` | 3.1, 3.2 the curve, its rational basis, affine and projective maps, influence of a weight |
//! | `weight_points` | 3.1 weights as points on the edges of the control polygon |
//! | `reparametrisation` | 3.2 other weights for the same curve, standard form |
//! | `homogeneous` | 3.3 homogeneous points |
//! | `derivative` | 3.3 derivatives, frames, curvature |
//! | `subdivision` | 3.3 split and restricted curves, degree elevation |
//! | `tessellation` | 3.3 polylines within a tolerance |
//! | `closest_point` | 2.6 the point closest to a given one |
//! | `intersection` | 2.6 crossings, tangential contacts and common parts |
//! | `conic` | 3.4 implicit conics: type, centre, axes, foci |
//! | `conic_arc` | 3.4 arcs of an implicit conic and back |
//! | `extended_conic` | 3.4 conics with a middle weight of any sign |
//! | `conic_construction` | B.12 conics through points and with tangents |
//! | `chord_bound` | B.8 distance from the chord |
//! | `circle` | B.12 circles, arcs and ellipses of degree 2 and more |

mod chord_bound;
mod circle;
mod closest_point;
mod conic;
mod conic_arc;
mod conic_construction;
mod curve;
mod derivative;
mod error;
mod extended_conic;
mod homogeneous;
mod intersection;
mod reparametrisation;
mod subdivision;
mod tessellation;
mod weight_points;

pub use circle::{circle, circle_arc, circle_arc_piece, ellipse, quadratic_arc};
pub use closest_point::FootPoint;
pub use conic::{Conic, ConicAxes, ConicKind, DegenerateConic};
pub use curve::RationalBezier;
pub use error::RationalBezierError;
pub use extended_conic::{ExtendedConic, ExtendedParameter};
pub use homogeneous::Projective;
pub use intersection::{Contact, Intersection};
pub use reparametrisation::{StandardForm, parameter_before};
