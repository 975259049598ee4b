//! Chapter 2: Bezier curves.
//!
//! | file | what |
//! |---|---|
//! | `curve` | 2.1 the curve, its monomial form, graphs of polynomials, affine maps |
//! | `hull` | 2.2 boxes, convex hull, end tangents |
//! | `crossings` | 2.2 crossings of curve and control polygon with a line or plane |
//! | `tessellation` | 2.2 distance of curve and polygon, polylines within a tolerance |
//! | `de_casteljau` | 2.3 scheme, blossom, fast evaluation |
//! | `degree` | 2.3 degree elevation and reduction |
//! | `derivative` | 2.4 hodographs, derivatives |
//! | `continuity` | 2.4 smooth joints and continuations |
//! | `curvature` | 2.5 frames, curvature, torsion, osculating circles |
//! | `inflections` | 2.5 where the curvature changes sign |
//! | `geometric_continuity` | 2.5 joints with common tangent and curvature |
//! | `subdivision` | 2.6 split and restricted curves |
//! | `arc_length` | 2.6 length between chord and polygon |
//! | `geometric_hermite` | 2.7 cubics from end points, directions and curvatures |
//! | `geometric_hermite_fit` | 2.7 such cubics along a curve |

mod arc_length;
mod continuity;
mod crossings;
mod curvature;
mod curve;
mod de_casteljau;
mod degree;
mod derivative;
mod error;
mod geometric_continuity;
mod geometric_hermite;
mod geometric_hermite_fit;
mod hull;
mod inflections;
mod subdivision;
mod tessellation;

pub use arc_length::EnclosedLength;
pub use crossings::Crossings;
pub use curvature::{CurvatureTooth, Frame, OsculatingCircle, SpaceFrame};
pub use curve::BezierCurve;
pub use degree::BezierReduction;
pub use error::BezierError;
pub use geometric_continuity::{GeometricJoint, GeometricOrder, geometric_joint, slide_control_points};
pub use geometric_hermite::{EndData, GeometricHermite, geometric_hermite};
pub use geometric_hermite_fit::{HermitePiece, geometric_hermite_adaptive, geometric_hermite_curve};
pub use hull::{EndTangents, convex_hull};
pub use inflections::Inflections;
pub use subdivision::subdivision_matrix;
pub use tessellation::{TessellationPoint, polygon_distance_factor};
