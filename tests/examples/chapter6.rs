//! Chapter 6: spline curves.

use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, Side, Spline, SplineSpace};
use spline_lab::core::spline_curve::{
    Hyperplane, HyperplaneIntersection, IntersectionKind, Nurbs, coordinate_ranges, label_closure,
    labels_between, subdivide_polygon, subdivision_mask, uniform_distance_factor, variation,
};

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("6.1-a", closed_curve),
    ("6.1-b", closed_curve),
    ("6.1-c", |example| {
        let circle = Nurbs::new(closed_space(example), example.points("control"), example.numbers("weights"));
        let circle = circle.unwrap();
        example.expect("points", points(&circle, &example.numbers("t")));
        for i in 0..=40 {
            example.expect("radius", circle.evaluate(f64::from(i) / 10.0).unwrap().length());
        }
        let velocity = |t: f64| circle.derivatives(t, 1, Side::Right).unwrap()[1];
        example.expect("derivative_at_0", velocity(0.0));
        example.expect("speed_at_half", velocity(0.5).length());
        let unrolled = circle.without_weights().unroll().unwrap();
        example.expect("unwrapped_knots", unrolled.space().knots());
        example.expect("unwrapped_control", unrolled.coefficients());
    }),
    ("6.1-d", |example| {
        let curve = Nurbs::polynomial(closed_space(example), example.points("control")).unwrap();
        example.expect("points", points(&curve, &example.numbers("t")));
        let squared = |t: f64| curve.evaluate(t).unwrap().length_squared();
        example.expect("radius_squared", example.numbers("t").into_iter().map(squared).collect::<Vec<_>>());
    }),
    ("6.1-e", |example| {
        let height = |w: f64| open_curve(example, vec![1.0, w, 1.0]).evaluate(0.5).unwrap().y;
        example.expect("y_at_half", example.numbers("w").into_iter().map(height).collect::<Vec<_>>());
    }),
    ("6.1-f", |example| {
        let curve = open_curve(example, example.numbers("weights"));
        let derivatives = curve.derivatives(example.number("t"), 2, Side::Right).unwrap();
        for (key, value) in ["r", "dr", "ddr"].into_iter().zip(derivatives) {
            example.expect(key, value);
        }
    }),
    ("6.2-a", |example| {
        let spline = open_spline(example);
        example.expect("greville_abscissae", spline.space().greville_abscissae());
        example.expect("sigma2", spline.space().knot_variances());
        example.expect("first_diff", spline.derivative_sum().coefficients());
        example.expect("second_diff", spline.second_differences());
        let distances = spline.polygon_distances().unwrap();
        example.expect("bounds", distances.iter().map(|d| d.bound).collect::<Vec<_>>());
        example.expect("max_dist", distances.iter().map(|d| d.measured).collect::<Vec<_>>());
        example.expect("at", distances.iter().map(|d| d.at).collect::<Vec<_>>());
    }),
    ("6.2-b", |example| {
        let factor = |n: f64| uniform_distance_factor(n as usize);
        example.expect("factor", example.numbers("n").into_iter().map(factor).collect::<Vec<_>>());
    }),
    ("6.2-c", |example| {
        let spline = Spline::new(closed_space(example), example.points("control")).unwrap();
        let largest =
            spline.second_differences().iter().fold(0.0, |size: f64, d| size.max(d.abs().max_element()));
        example.expect("max_second_difference", largest);
        example.expect("bound", spline.distance_bound());
        let point = spline.limit_point_uniform(0).unwrap();
        example.expect("point", point);
        example.expect("distance", (spline.coefficients()[0] - point).abs().max_element());
    }),
    ("6.2-d", |example| {
        let spline = open_spline(example);
        for (t, value, slope, side) in [(0.0, "p0", "d0", Side::Right), (5.0, "p5", "d5", Side::Left)] {
            let derivatives = spline.derivatives(t, 1, side).unwrap();
            example.expect(value, derivatives[0]);
            example.expect(slope, derivatives[1]);
        }
        example.expect("greville_abscissae", spline.space().greville_abscissae());
    }),
    ("6.2-e", |example| {
        let spline = open_spline(example);
        let bounds = spline.polygon_distances().unwrap().into_iter().map(|d| d.bound);
        example.expect("bounds", bounds.collect::<Vec<_>>());
        example.expect("p_at_1", spline.evaluate(1.0).unwrap());
    }),
    ("6.2-f", |example| {
        let spline = open_spline(example);
        let distances = spline.polygon_distances().unwrap();
        example.expect("bounds", distances.iter().map(|d| d.bound).collect::<Vec<_>>());
        let sampled = |(a, b): (f64, f64)| {
            (0..=400)
                .map(|i| a + (b - a) * f64::from(i) / 400.0)
                .map(|t| spline.evaluate(t).unwrap() - spline.control_polygon_at(t).unwrap())
                .fold(0.0, |size: f64, d| size.max(d.abs().max_element()))
        };
        example.expect("sampled_max", distances.iter().map(|d| sampled(d.interval)).collect::<Vec<_>>());
    }),
    ("6.3-a", inserted),
    ("6.3-b", inserted),
    ("6.3-c", inserted),
    ("6.3-d", |example| {
        let once = subdivide_polygon(&example.points("control"), example.count("n"), true, 1).unwrap();
        example.expect("control", once);
        let twice = subdivide_polygon(&example.points("control"), example.count("n"), true, 2).unwrap();
        example.expect("second_refinement_first4", &twice[..4]);
    }),
    ("6.3-e", |example| {
        let matrix = example.rows("matrix");
        example.expect("eigenvalues", eigenvalues(&matrix));
        let mut row = vec![1.0, 0.0, 0.0];
        for _ in 0..80 {
            row = (0..3).map(|j| (0..3).map(|i| row[i] * matrix[i][j]).sum()).collect();
        }
        example.expect("limit_row", row);
        // The triple is the corner (1, 1) of the square with its neighbours.
        let triple = example.points("triple");
        let square = vec![triple[1], triple[0], -triple[1], triple[2]];
        let mut spline = Nurbs::closed(square, vec![1.0; 4], 3).unwrap().without_weights().clone();
        example.expect("limit", spline.limit_point_uniform(0).unwrap());
        let (mut corner, mut sequence) = (0, Vec::new());
        for _ in 0..5 {
            sequence.push(spline.coefficients()[corner]);
            corner = (2 * corner + 2) % (2 * spline.coefficients().len());
            spline = spline.subdivide_uniform().unwrap();
        }
        example.expect("sequence", sequence);
    }),
    ("6.3-f", |example| {
        let mask = |n: f64| subdivision_mask(n as usize);
        example.expect("mask", example.numbers("n").into_iter().map(mask).collect::<Vec<_>>());
    }),
    ("6.3-g", |example| {
        let spline = open_spline(example);
        let refined = spline.subdivide_uniform().unwrap();
        example.expect("knots", refined.space().knots());
        example.expect("control", refined.coefficients());
        // The full refinement starts at τ₀ with half the distance: where does the first knot that remains stand there?
        let full = |knot: f64| ((knot - spline.space().knots()[0]) / 0.5) as usize;
        example.expect("first_index", full(refined.space().knots()[0]));
    }),
    ("6.3-h", |example| {
        let (spline, s) = (open_spline(example), example.number("s"));
        let refined = spline.insert_knots(&vec![s; example.count("times")]).unwrap();
        example.expect("knots", refined.space().knots());
        example.expect("control", refined.coefficients());
        let l = refined.space().span(s).unwrap();
        example.expect("l", l);
        example.expect("point", refined.coefficients()[l - refined.degree()]);
        example.expect("point", spline.evaluate(s).unwrap());
    }),
    ("6.3-i", |example| {
        let (curve, line) = (bezier(example), Hyperplane::new(DVec2::Y, 1.5).unwrap());
        let found = curve.intersect_hyperplane(&line, 1e-9).unwrap();
        example.expect("t", found[0].parameter);
        example.expect("point", found[0].point);
        let halves: Vec<Nurbs<DVec2>> = [1.0, 0.5, 0.25].map(|b| curve.trimmed(0.0, b).unwrap()).to_vec();
        let intervals = halves.iter().map(|half| half.space().parameter_interval());
        example.expect("intervals", intervals.collect::<Vec<_>>());
        let boxed = |half: &Nurbs<DVec2>| {
            coordinate_ranges(half.points())
                .into_iter()
                .flat_map(|(low, high)| [low, high])
                .collect::<Vec<_>>()
        };
        example.expect("boxes", halves.iter().map(boxed).collect::<Vec<_>>());
        let variations = halves.iter().map(|half| variation(half.points(), &line));
        example.expect("variations", variations.collect::<Vec<_>>());
    }),
    ("6.3-j", |example| {
        let (curve, line) = (bezier(example), Hyperplane::new(DVec2::Y, 0.0).unwrap());
        example.expect("variation", variation(curve.points(), &line));
        let found = curve.intersect_hyperplane(&line, 1e-9).unwrap();
        example.expect("result", found.iter().map(|meeting| meeting.interval).collect::<Vec<_>>());
        assert_eq!(found[0].kind, IntersectionKind::EndPoint, "a common end of both halves");
    }),
    ("6.3-k", |example| {
        let (curve, line) = (bezier(example), Hyperplane::new(DVec2::Y, 0.0).unwrap());
        let found = curve.intersect_hyperplane(&line, example.number("tol")).unwrap();
        let kind = match found[0].kind {
            IntersectionKind::Undecided => "undecided",
            _ => "decided",
        };
        example.expect("kind", kind);
        example.expect("intervals", found.iter().map(|meeting| meeting.interval).collect::<Vec<_>>());
        // The height is stationary where the contact is.
        let slope = curve.without_weights().derivative().unwrap().into_parts();
        let slope = Nurbs::polynomial(slope.0, slope.1).unwrap();
        let level = slope.intersect_hyperplane(&line, 1e-9).unwrap();
        example.expect("double_root", level[0].parameter);
        let (low, high) = found[0].interval;
        assert!((low..=high).contains(&level[0].parameter), "the bracket holds the double root");
    }),
    ("6.3-l", |example| {
        let (spline, line) = (open_spline(example), Hyperplane::new(DVec2::X, 2.0).unwrap());
        example.expect("variation_polygon", variation(spline.coefficients(), &line));
        let curve = Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap();
        let found = curve.intersect_hyperplane(&line, 1e-9).unwrap();
        let crossing = |meeting: &&HyperplaneIntersection<DVec2>| meeting.kind == IntersectionKind::Crossing;
        assert!(found.iter().filter(crossing).count() == 3, "three crossings: {found:?}");
        example.expect("t", found.iter().map(|meeting| meeting.parameter).collect::<Vec<_>>());
        example.expect("points", found.iter().map(|meeting| meeting.point).collect::<Vec<_>>());
    }),
    ("6.4-a", |example| {
        let (spline, s) = (open_spline(example), example.number("s"));
        let scheme = spline.insertion_scheme(s, 3).unwrap();
        example.expect("scheme", scheme.triangle.levels());
        example.expect("scheme", spline.de_boor_scheme(s).unwrap().triangle.levels());
        example.expect("point", scheme.triangle.result().unwrap());
        // The last leg before the apex is the tangent: 3/(5 − 2) times it.
        let leg = &scheme.triangle.levels()[2];
        example.expect("derivative", leg[1] - leg[0]);
        example.expect("derivative", spline.derivatives(s, 1, Side::Left).unwrap()[1]);
    }),
    ("6.4-b", |example| {
        let spline = open_spline(example);
        let at = |t: f64, side| spline.derivatives(t, 3, side).unwrap();
        let inside = at(example.number("s"), Side::Right);
        example.expect("second", inside[2]);
        example.expect("third", inside[3]);
        let (left, right) = spline.space().parameter_interval();
        example.expect("p_left_end", at(left, Side::Right)[0]);
        example.expect("p_right_end", at(right, Side::Left)[0]);
        example.expect("d_right_end", at(right, Side::Left)[1]);
    }),
    ("6.4-c", |example| {
        let (spline, t) = (open_spline(example), example.number("t"));
        example.expect("point", spline.evaluate(t).unwrap());
        for (key, side) in [("left", Side::Left), ("right", Side::Right)] {
            example.expect(key, spline.derivatives(t, 1, side).unwrap()[1]);
            example.expect(key, spline.derivative_sum().evaluate(t, side).unwrap());
        }
    }),
    ("6.4-d", |example| {
        let spline = Spline::new(closed_space(example), example.points("control")).unwrap();
        let unrolled = spline.unroll().unwrap();
        example.expect("knots", unrolled.space().knots());
        example.expect("unwrapped_control", unrolled.coefficients());
        let pieces = spline.bezier_pieces();
        // The closed polygon starts behind the corner at τ₀, which comes last.
        example.expect("bezier_control", &pieces.points()[1..]);
        example.expect("segments", pieces.iter().map(|(interval, _)| interval).collect::<Vec<_>>());
        let control = pieces.iter().map(|(_, points)| points.to_vec());
        example.expect("segment_control", control.collect::<Vec<_>>());
    }),
    ("6.4-e", |example| {
        let whole = |row: Vec<f64>| row.into_iter().map(|index| index as i64).collect::<Vec<_>>();
        let labels: Vec<Vec<i64>> = example.rows("control_labels").into_iter().map(whole).collect();
        let numbers = |label: &Vec<i64>| label.iter().map(|&index| index as f64).collect::<Vec<_>>();
        let closure = label_closure(&labels).unwrap();
        example.expect("labels", closure.len());
        let bezier = closure.iter().filter(|label| label.iter().all(|index| [4, 5].contains(index)));
        example.expect("bezier_labels", bezier.map(numbers).collect::<Vec<_>>());
        let between = labels_between(&labels[0], &labels[1]);
        let new: Vec<_> = between.iter().map(|point| numbers(&point.label)).collect();
        example.expect("new_points_between_first_two", new);
        example.expect("weights_of_second", between.iter().map(|point| point.share).collect::<Vec<_>>());
    }),
    ("6.4-f", |example| {
        let matrix = |n: f64| {
            let n = n as usize;
            let space = SplineSpace::new(n, (0..2 * n + 2).map(|k| k as f64).collect()).unwrap();
            let column = |k: usize| {
                let unit = (0..=n).map(|j| f64::from(u8::from(j == k))).collect();
                Spline::new(space.clone(), unit).unwrap().bezier_pieces().points().to_vec()
            };
            let columns: Vec<Vec<f64>> = (0..=n).map(column).collect();
            (0..=n).map(|i| columns.iter().map(|column| column[i]).collect()).collect::<Vec<Vec<f64>>>()
        };
        example.expect("matrix", example.numbers("n").into_iter().map(matrix).collect::<Vec<_>>());
    }),
    ("6.4-g", |example| {
        let spline = open_spline(example);
        example.expect("bezier", spline.bezier_form()[1].points.clone());
        let span = spline.space().span(2.0).unwrap();
        let blossom = |arguments: &[f64; 3]| spline.blossom(span, arguments).unwrap();
        let arguments = [[2.0, 2.0, 2.0], [2.0, 2.0, 5.0], [2.0, 5.0, 5.0], [5.0, 5.0, 5.0]];
        example.expect("bezier", arguments.iter().map(blossom).collect::<Vec<_>>());
    }),
];

fn open_spline(example: &Example) -> Spline<DVec2> {
    let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
    Spline::new(space, example.points("control")).unwrap()
}

/// A Bezier curve over [0, 1] as a spline curve.
fn bezier(example: &Example) -> Nurbs<DVec2> {
    let points = example.points("control");
    let n = points.len() - 1;
    let space = SplineSpace::from_breaks(n, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
    Nurbs::polynomial(space, points).unwrap()
}

fn inserted(example: &Example) {
    let (spline, s) = (open_spline(example), example.number("s"));
    let refined = spline.insert_knot(s).unwrap();
    example.expect("knots", refined.space().knots());
    example.expect("control", refined.coefficients());
    let scheme = spline.insertion_scheme(s, 1).unwrap();
    let new = &scheme.triangle.levels()[1];
    example.expect("new_indices", (0..new.len()).map(|j| scheme.first_new + j).collect::<Vec<_>>());
    for (j, point) in new.iter().enumerate() {
        let index = (scheme.first_new + j).to_string();
        example.expect_at(&["control", &index], *point);
    }
    if example.id == "6.3-c" {
        // Now three-fold: the curve passes through the new point.
        example.expect_at(&["control", "4"], spline.evaluate(s).unwrap());
    }
}

/// Real eigenvalues of a 3×3 matrix, the largest first, by the trigonometric solution of the cubic equation.
fn eigenvalues(matrix: &[Vec<f64>]) -> Vec<f64> {
    let minor = |i: usize, j: usize| matrix[i][i] * matrix[j][j] - matrix[i][j] * matrix[j][i];
    let trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
    let minors = minor(0, 1) + minor(0, 2) + minor(1, 2);
    let determinant: f64 = (0..3)
        .map(|j| {
            let (a, b) = ((j + 1) % 3, (j + 2) % 3);
            matrix[0][j] * (matrix[1][a] * matrix[2][b] - matrix[1][b] * matrix[2][a])
        })
        .sum();
    let (p, shift) = (trace * trace / 3.0 - minors, trace / 3.0);
    let q = 2.0 * shift.powi(3) - minors * shift + determinant;
    let angle = (1.5 * q / p * (3.0 / p).sqrt()).acos() / 3.0;
    let third = std::f64::consts::TAU / 3.0;
    let root = |k: f64| shift + 2.0 * (p / 3.0).sqrt() * (angle - k * third).cos();
    let mut roots = vec![root(0.0), root(1.0), root(2.0)];
    roots.sort_by(|a, b| b.total_cmp(a));
    roots
}

fn closed_space(example: &Example) -> SplineSpace {
    SplineSpace::periodic(example.count("n"), example.number("T"), example.numbers("tau")).unwrap()
}

fn open_curve(example: &Example, weights: Vec<f64>) -> Nurbs<DVec2> {
    let space = SplineSpace::new(example.count("n"), example.numbers("knots")).unwrap();
    Nurbs::new(space, example.points("control"), weights).unwrap()
}

fn points(curve: &Nurbs<DVec2>, parameters: &[f64]) -> Got {
    parameters.iter().map(|&t| curve.evaluate(t).unwrap()).collect::<Vec<_>>().into()
}

fn closed_curve(example: &Example) {
    let curve = Spline::new(closed_space(example), example.points("control")).unwrap();
    let unrolled = curve.unroll().unwrap();
    example.expect("knots", unrolled.space().knots());
    example.expect("control", unrolled.coefficients());
    for spline in [&curve, &unrolled] {
        let values = example.numbers("t").into_iter().map(|t| spline.evaluate(t).unwrap());
        example.expect("points", values.collect::<Vec<_>>());
    }
}
