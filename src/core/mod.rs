//! The mathematics of the course, one folder per chapter.
//!
//! | section | file |
//! |---|---|
//! | 1.4 Bernstein polynomials | `polynomial/bernstein`, `polynomial/conversion` |
//! | 1.5 Properties of Bernstein polynomials | `polynomial/calculus`, `polynomial/product`, `polynomial/zeros`, `root_finding` |
//! | 2.1 Control polygon | `bezier/curve` |
//! | 2.2 Properties of Bezier curves | `bezier/hull`, `bezier/crossings`, `bezier/tessellation` |
//! | 2.3 Algorithm of de Casteljau | `bezier/de_casteljau`, `bezier/degree` |
//! | 2.4 Differentiation | `bezier/derivative`, `bezier/continuity` |
//! | 2.5 Curvature | `bezier/curvature`, `bezier/inflections`, `bezier/geometric_continuity` |
//! | 2.6 Subdivision | `bezier/subdivision`, `bezier/arc_length`, `rational_bezier/intersection`, `rational_bezier/closest_point` |
//! | 2.7 Geometric Hermite interpolation | `bezier/geometric_hermite`, `bezier/geometric_hermite_fit` |
//! | 3.1 Control polygon and weights | `rational_bezier/curve`, `rational_bezier/weight_points` |
//! | 3.2 Basic properties | `rational_bezier/reparametrisation` |
//! | 3.3 Algorithms | `rational_bezier/{homogeneous, derivative, subdivision, tessellation, intersection, closest_point}` |
//! | 3.4 Conic sections | `rational_bezier/{conic, conic_arc, extended_conic, conic_construction, circle}` |
//! | 4.1 Recurrence relation | `bspline/basis` |
//! | 4.2 Differentiation | `bspline/single_derivative`, `bspline/basis_derivative`, `bspline/derivative`, `bspline/smoothness` |
//! | 4.3 Representation of polynomials | `bspline/marsden` |
//! | 4.4 Splines | `bspline/space`, `bspline/builders`, `bspline/multiple_end_knots`, `bspline/uniform`, `bspline/piecewise`, `bspline/power_form` |
//! | 4.5 Evaluation and differentiation | `bspline/spline`, `bspline/batch`, `bspline/derivative`, `bspline/integral` |
//! | 4.6 Periodic splines | `bspline/space`, `bspline/unroll`, `bspline/periodic` |
//! | 5.1 Schoenberg's scheme | `approximation/schoenberg` |
//! | 5.5 Interpolation | `approximation/sites`, `approximation/collocation`, `approximation/interpolation`, `approximation/cubic_interpolation` |
//! | 5.6 Smoothing | `approximation/smoothing`, `approximation/smoothing_choice`, `approximation/smoothing_system`, `approximation/least_squares` |
//! | 6.1 Control polygon | `spline_curve/{nurbs, batch, editing, trim, join, curvature}` |
//! | 6.2 Basic properties | `spline_curve/{hull, distance_bound, tessellation}` |
//! | 6.3 Refinement | `spline_curve/{knot_insertion, insertion_scheme, refinement_matrix, subdivision, hyperplane_intersection}` |
//! | 6.4 Algorithms | `spline_curve/{bezier_form, from_bezier, bezier_conversion, blossom}` |
//! | 7.3 Splines | `tensor/space`, `tensor/tensor_product`, `tensor/marsden`, `tensor/relevance`, `tensor/box_spline` |
//! | 7.4 Algorithms | `tensor/grid`, `tensor/derivative`, `tensor/refinement`, `tensor/uniform_tableau` |
//! | 8.2 Spline surfaces | `surface/nurbs_surface`, `surface/grid`, `surface/measure`, `surface/tessellation`, `surface/curvature` |
//! | 8.3 Subdivision surfaces | `tensor/subdivision`, `surface/polygon_mesh`, `surface/mesh_topology`, `surface/catmull_clark` |
//! | 9.1 Ritz-Galerkin approximation | `finite_element/{form, ritz_galerkin, error_norm, poisson}` |
//! | 9.2 Weighted B-splines | `domain/`, `finite_element/{r_function, weight_function, weighted_bspline, web_spline}` |
//! | 9.3 Isogeometric elements | `finite_element/{geometry, isogeometric, multipatch, fast_diagonalisation}` |
//! | 9.4 Implementation | `quadrature`, `linear_system/`, `finite_element/{cell_quadrature, offset_matrix, assembly, solver}` |
//! | 9.5 Applications | `finite_element/flow` |
//! | typed formulas | `formula` |
//! | linear systems | `linear_system` |
//! | B.1 Degree elevation and reduction | `spline_curve/{degree, degree_reduction, uniform_reduction}` |
//! | B.2 Knot removal, other knots | `spline_curve/{knot_removal, removal_within, nearest_spline, knot_rule}` |
//! | B.3 Measured deviation | `spline_curve/{deviation, hausdorff}` |
//! | B.4 Arc length | `spline_curve/arc_length`, `bezier/arc_length` |
//! | B.5 Closest points | `spline_curve/{closest_point, foot_points}`, `rational_bezier/closest_point`, `bounding_tree` |
//! | B.6 Intersections | `spline_curve/{line_intersection, curve_intersection, self_intersection, intersection_tree}`, `rational_bezier/intersection` |
//! | B.7 Inflections, vertices, boxes, torsion | `spline_curve/{curvature, inflections, vertices, tight_box, symmetry, joint}`, `bezier/{curvature, inflections}` |
//! | B.8 Rational tessellation | `rational_bezier/chord_bound`, `spline_curve/chord_polygon` |
//! | B.12 Circles, arcs and conics | `rational_bezier/{circle, conic_arc}` |
//! | B.16 Fitting a stroke | `spline_curve/{fitting, fitting_stroke}` |
//!
//! # Notation and conventions
//!
//! - Degree `n`, knots `ξ` (of curves also `τ`), control points and coefficients `c`, weights `w`. All indices start at 0.
//! - `m` coefficients have the knots `ξ₀ … ξₘ₊ₙ`; `bₖ` lives on `[ξₖ, ξₖ₊ₙ₊₁]`, and the parameter interval is `D = [ξₙ, ξₘ]`.
//! - Knots are *n-regular*: `n ≥ 1`, `m ≥ n + 1`, multiplicities at most `n`, first and last interval of D not empty.
//! - Periodic knots: `M` of them in `[ξ₀, ξ₀ + T)`, and `M` coefficients; `cₖ` belongs to the B-spline that starts at `ξₖ`.
//! - Knot intervals are half open, `[ξₗ, ξₗ₊₁)`; the last nonempty one of D includes its right end.
//! - Points and weights of a rational curve are kept as given; algorithms run on `(w c, w)`.
//! - y points up, angles are in radians, left turns have positive curvature.
//! - Numbers are `f64`. Constructors check, name the index and repeat the value; nothing is sorted, clamped or repaired.
//!
//! K. Höllig, J. Hörner, *Approximation and Modeling with B-Splines*, SIAM 2013, has the sections.

pub mod approximation;
pub mod bezier;
pub mod bounding_tree;
pub mod bspline;
pub mod domain;
pub mod finite_element;
pub mod formula;
pub mod linear_system;
pub mod point;
pub mod polynomial;
pub mod progress;
pub mod quadrature;
pub mod rational_bezier;
pub mod root_finding;
pub mod spline_curve;
pub mod surface;
pub mod tensor;
pub mod triangular_scheme;
