//! Chapter 6: spline curves.
//!
//! | file | what |
//! |---|---|
//! | `nurbs` | 6.1 the rational curve |
//! | `batch` | many points at once |
//! | `editing` | replaced points and weights, reversed, split, opened and closed curves, the circle |
//! | `knot_insertion` | 6.3 one knot, many knots, uniform refinement |
//! | `knot_removal` | the nearest curve with one knot less |
//! | `bezier_form` | 6.4 one Bezier curve for each knot interval |
//! | `bezier_conversion` | 6.4 Bezier curves as splines and back |
//! | `degree` | degree elevation and reduction |
//! | `closest_point` | the point of a curve closest to a given point |
//! | `curvature` | frames, signed curvature, osculating circles |
//! | `deviation` | certified distance of two curves at equal parameters |

mod batch;
mod bezier_conversion;
mod bezier_form;
mod closest_point;
mod curvature;
mod degree;
mod deviation;
mod editing;
mod knot_insertion;
mod knot_removal;
mod nurbs;

pub use bezier_form::{BezierSegment, RationalSegment};
pub use closest_point::ClosestPoint;
pub use curvature::{Frame, OsculatingCircle};
pub use degree::DegreeReduction;
pub use deviation::{Deviation, deviation};
pub use knot_removal::{KnotRemoval, NurbsKnotRemoval};
pub use nurbs::Nurbs;
