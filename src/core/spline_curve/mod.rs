//! Chapter 6: spline curves.
//!
//! | file | what |
//! |---|---|
//! | `nurbs` | 6.1 the rational curve |
//! | `batch` | many points at once |
//! | `editing` | 6.1 replaced points and weights, reversed, opened and closed curves, the circle |
//! | `least_norm_move`, `edit_points` | a point of the curve moved, alone or with other points kept |
//! | `fitting`, `fitting_stroke` | B.16 least squares for sequences of points, strokes |
//! | `trim`, `join` | 6.1 a part of a curve, both sides of a parameter, two curves as one |
//! | `offset` | the curve at a distance, within a tolerance |
//! | `hull` | 6.2 hull and box of the active control points |
//! | `distance_bound` | 6.2 distance of curve and control polygon |
//! | `tessellation` | 6.2 polygons within a tolerance |
//! | `knot_insertion` | 6.3 one knot, many knots, a knot in every interval |
//! | `insertion_scheme` | 6.3, 6.4 the triangle of inserting one knot several times |
//! | `refinement_matrix` | 6.3 the matrix of many insertions |
//! | `subdivision` | 6.3 uniform subdivision |
//! | `hyperplane`, `hyperplane_intersection` | 6.3 variation, and where a curve meets a hyperplane |
//! | `bezier_form`, `from_bezier`, `bezier_conversion` | 6.4 one Bezier curve for each knot interval, and back |
//! | `blossom` | 6.4 blossoms and the labels of control points |
//! | `degree`, `degree_reduction`, `uniform_reduction` | degree elevation and reduction |
//! | `knot_removal`, `removal_within` | the nearest curve with one knot less, and with as few knots as a tolerance allows |
//! | `nearest_spline` | the nearest curve over other knots |
//! | `knot_rule` | knots from the control points: uniform, end-interpolating, chord length, centripetal, averaged |
//! | `deviation`, `hausdorff` | certified distance at equal parameters, sampled distance of two point sets |
//! | `line_intersection`, `curve_intersection`, `self_intersection` | B.6 where a curve meets a line, another curve, itself |
//! | `intersection_tree`, `plane_piece` | B.6 curves prepared for intersections, and the one crossing of two pieces |
//! | `arc_length` | B.4 arc length and its inverse |
//! | `chord_polygon` | B.8 points whose polygon is within a tolerance |
//! | `closest_point`, `foot_points` | B.5 the points of a curve closest to a given point, and all foot points |
//! | `curvature` | frames, signed curvature and its derivative, osculating circles, torsion |
//! | `inflections`, `vertices`, `curvature_polynomial` | B.7 where curvature changes sign, where it is extreme, and the polynomials behind |
//! | `tight_box` | B.7 the smallest box, extreme points |
//! | `symmetry` | the axis or centre about which a plane curve is nearest to its image |
//! | `joint` | how smoothly two curves join |
//! | `local_piece`, `foot_polynomial`, `chord`, `piecewise_sign` | B.5, B.7 what closest points and features are made of |

mod arc_length;
mod batch;
mod bezier_conversion;
mod bezier_form;
mod blossom;
mod chord;
mod chord_polygon;
mod closest_point;
mod curvature;
mod curvature_polynomial;
mod curve_intersection;
mod degree;
mod degree_reduction;
mod deviation;
mod distance_bound;
mod edit_points;
mod editing;
mod fitting;
mod fitting_stroke;
mod foot_points;
mod foot_polynomial;
mod from_bezier;
mod hausdorff;
mod hull;
mod hyperplane;
mod hyperplane_intersection;
mod inflections;
mod insertion_scheme;
mod intersection_tree;
mod join;
mod joint;
mod knot_insertion;
mod knot_removal;
mod knot_rule;
mod least_norm_move;
mod line_intersection;
mod local_piece;
mod nearest_spline;
mod nurbs;
mod offset;
mod piecewise_sign;
mod plane_piece;
mod refinement_matrix;
mod removal_within;
#[cfg(test)]
mod samples;
mod self_intersection;
mod subdivision;
mod symmetry;
mod tessellation;
mod tight_box;
mod trim;
mod uniform_reduction;
mod vertices;

pub use arc_length::ArcLength;
pub use bezier_form::{BezierPieces, BezierSegment, RationalSegment};
pub use blossom::{LabelBetween, label_closure, labels_between};
pub use closest_point::{ClosestPoint, ClosestPointTree};
pub use curvature::{Frame, OsculatingCircle, SpaceFrame};
pub use curvature_polynomial::CurvatureChange;
pub use curve_intersection::{CurveIntersection, Meeting};
pub use degree::elevation_matrix;
pub use degree_reduction::{DegreeReduction, ReductionEnds};
pub use deviation::{Deviation, DeviationLimits, deviation, deviation_within};
pub use distance_bound::{PolygonDistance, uniform_distance_factor};
pub use fitting::{
    FitEnds, FittingError, correct_parameters, fit_least_squares, foot_steps, parameters, spread_knots,
};
pub use fitting_stroke::{FitOptions, StrokeFit, fit_stroke};
pub use foot_points::{FootKind, StationaryDistance};
pub use hausdorff::hausdorff_sampled;
pub use hull::{convex_hull, coordinate_ranges};
pub use hyperplane::{Hyperplane, variation};
pub use hyperplane_intersection::{HyperplaneIntersection, IntersectionKind};
pub use inflections::CurveInflections;
pub use insertion_scheme::InsertionScheme;
pub use intersection_tree::IntersectionTree;
pub use joint::Joint;
pub use knot_removal::{KnotRemoval, NurbsKnotRemoval};
pub use knot_rule::KnotRule;
pub use line_intersection::LineIntersection;
pub use nurbs::Nurbs;
pub use offset::Offset;
pub use refinement_matrix::refinement_matrix;
pub use removal_within::{KnotReduction, NurbsKnotReduction};
pub use subdivision::{subdivide_polygon, subdivision_mask};
pub use symmetry::{Symmetry, SymmetryKind};
pub use tessellation::Tessellation;
pub use tight_box::{Extreme, TightBox};
pub use uniform_reduction::{UniformReduction, reduce_uniformly};
pub use vertices::{Vertex, VertexKind, Vertices};
