//! Sections 9.1 Ritz-Galerkin approximation, 9.2 Weighted B-splines, 9.4 Implementation, B.14 Cut-cell quadrature.

use std::f64::consts::PI;

use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, Spline, SplineSpace};
use spline_lab::core::domain::{Bounds, CellClass, Domain, Jet};
use spline_lab::core::finite_element::{
    Basis, Coefficient, Discretisation, EllipticForm, GalerkinSystem, Grid, LineForm, Method, NodeArray,
    NodeClass, OffsetMatrix, Problem, QuadratureTable, SystemMatrix, Weight, WeightedSolution,
    WeightedSystem, condition_number, extension_coefficients, line_system, r_complement, r_difference,
    r_intersection, r_union, rectangle_system, slice_cell, solve_problem,
};
use spline_lab::core::linear_system::{
    IterationLimits, LinearOperator, NoPreconditioner, SparseMatrix, conjugate_gradients,
};
use spline_lab::core::progress::Unwatched;
use spline_lab::core::quadrature::gauss_legendre;

use crate::example::{Example, Got};

// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("9.1-a", |example| {
        let (system, _) = string(example.number("h"));
        let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
        let dense = system.matrix.to_dense().unwrap();
        example.expect("G", (0..3).map(|i| dense.row(i).to_vec()).collect::<Vec<_>>());
        example.expect("F", system.load.clone());
        example.expect("Q(u_h)", system.energy(&u));
        example.expect("U", u);
    }),
    ("9.1-b", |example| {
        let error = |h: f64| {
            let (system, _) = string(h);
            let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
            1.0 / 12.0 + 2.0 * system.energy(&u)
        };
        example.expect_at(&[], example.numbers("h").into_iter().map(error).collect::<Vec<_>>());
    }),
    ("9.1-c", |example| {
        for n in [1, 2, 3] {
            let results: Vec<_> = example.numbers("h").into_iter().map(|h| square(n, h)).collect();
            example.expect(&format!("n={n}"), results);
        }
        let (integral, centre) = square_series();
        example.expect("exact_int", integral);
        example.expect("exact_centre", centre);
    }),
    ("9.2-a", |example| {
        for (number, x) in example.points("points").into_iter().enumerate() {
            for (name, jet) in ["w1", "w2", "w3", "w4", "w5"].into_iter().zip(mushroom_weights(x)) {
                example.expect_at(&[&number.to_string(), name], jet.value);
            }
        }
    }),
    ("9.2-b", |example| {
        let jet = |value: f64| Jet { value, gradient: DVec2::ZERO };
        let (a, b) = (jet(3.0), jet(4.0));
        let results = [
            r_intersection(a, b),
            r_union(a, b),
            r_difference(a, b),
            r_difference(a, jet(-4.0)),
            r_complement(a),
            r_intersection(a, jet(-4.0)),
            r_union(jet(-3.0), jet(-4.0)),
        ];
        example.expect_at(&[], results.map(|jet| jet.value).to_vec());
    }),
    ("9.2-c", |example| {
        let gradient = |w: DVec2| {
            let jet = |value, gradient| Jet { value, gradient };
            r_intersection(jet(w.x, DVec2::X), jet(w.y, DVec2::Y)).gradient
        };
        example.expect_at(&[], example.points("points").into_iter().map(gradient).collect::<Vec<_>>());
    }),
    ("9.2-d", |example| {
        let disc = unit_disc();
        let form = EllipticForm::poisson(Coefficient::Constant(example.number("f")));
        let problem = Problem { domain: &disc, weight: disc_weight(), form };
        let settings = Discretisation { gauss_points: 9, ..exactly(example.count("n"), example.number("h")) };
        let solution = solve_problem(&problem, &settings, None, &Unwatched).unwrap();
        let nodes = solution.space.nodes();
        example.expect("relevant", nodes.relevant_count());
        example.expect("inner", nodes.count(NodeClass::Inner));
        example.expect("outer", nodes.count(NodeClass::Outer));
        example.expect("area", solution.space.table().integrate(|_| 1.0));
        let errors = solution.errors(&|x| disc_weight().at(x)).unwrap();
        example.expect("L2_below_1e-10", errors.l2 < 1e-10);
        example.expect("H1_below_1e-9", errors.h1_seminorm < 1e-9);
    }),
    ("9.2-e", |example| {
        let factor = |x: DVec2| {
            let value = (x.x - 0.5 * x.y).exp();
            Jet { value, gradient: DVec2::new(value, -0.5 * value) }
        };
        // −Δ(w g) = −g Δw − 2 grad w·grad g − w Δg with Δg = 5/4 g.
        let load = |x: DVec2| {
            let (w, g) = (disc_weight().at(x), factor(x));
            4.0 * g.value - 2.0 * w.gradient.dot(g.gradient) - 1.25 * w.value * g.value
        };
        for n in [1, 2, 3] {
            let (l2, h1): (Vec<f64>, Vec<f64>) = [0.5, 0.25, 0.125, 0.0625]
                .map(|h| disc_errors(&load, &factor, &exactly(n, h)).1)
                .into_iter()
                .unzip();
            example.expect_at(&[&format!("n={n}"), "L2"], l2);
            example.expect_at(&[&format!("n={n}"), "H1"], h1);
            let (l2, h1): (Vec<f64>, Vec<f64>) = [0.25, 0.125, 0.0625]
                .map(|h| {
                    disc_errors(&load, &factor, &Discretisation { basis: Basis::Web, ..exactly(n, h) }).1
                })
                .into_iter()
                .unzip();
            example.expect_at(&[&format!("n={n}"), "L2_web"], l2);
            example.expect_at(&[&format!("n={n}"), "H1_web"], h1);
        }
    }),
    ("9.2-f", |example| {
        for n in [1, 2, 3] {
            let columns = [-1, -2].map(|offset| extension_coefficients(n, offset));
            example.expect(&format!("n={n}"), columns.to_vec());
        }
        let (first, second) = (extension_coefficients(2, -1), extension_coefficients(2, 1));
        let products: Vec<Vec<f64>> = first.iter().map(|a| second.iter().map(|b| a * b).collect()).collect();
        example.expect("n=2, j=l+(-1,+1)", products);
    }),
    ("9.2-g", |example| {
        let (ends, h, n) = (example.numbers("D"), example.number("h"), example.count("n"));
        let class = |[cell]: [usize; 1]| {
            let (left, right) = (cell as f64 * h, (cell + 1) as f64 * h);
            if left >= ends[0] && right <= ends[1] { CellClass::Inner } else { CellClass::Cut }
        };
        let cells: Vec<usize> = (0..4).filter(|cell| class([*cell]) == CellClass::Inner).collect();
        example.expect("inner_cells", cells);
        let nodes = NodeArray::new([4], n, class);
        let list = |class| nodes.of_class(class).into_iter().map(|[k]| k).collect::<Vec<_>>();
        example.expect("I", list(NodeClass::Inner));
        example.expect("J", list(NodeClass::Outer));
        let joined = nodes.join().unwrap();
        for (key, one) in ["e_.,0 (i=1,2,3)", "e_.,5 (i=2,3,4)"].into_iter().zip(&joined) {
            example.expect(key, nodes.extension(one).into_iter().map(|(_, e)| e).collect::<Vec<_>>());
        }
        let [cell] = nodes.center_cell([1]).unwrap();
        let x = (cell as f64 + 0.5) * h;
        example.expect("w(x_1)", (x - ends[0]) * (ends[1] - x));
    }),
    ("9.2-h", |example| {
        let disc = unit_disc();
        let form = EllipticForm::poisson(Coefficient::Constant(1.0));
        let problem = Problem { domain: &disc, weight: disc_weight(), form };
        let (mut web, mut scaled, mut unscaled_is_bad, mut bounded) = (Vec::new(), Vec::new(), true, true);
        for count in example.numbers("N") {
            let h = 2.0 / count;
            let system = WeightedSystem::assemble(&problem, &exactly(2, h), &Unwatched).unwrap();
            let (web_system, _) = system.web().unwrap();
            let all = vec![true; web_system.matrix.rows()];
            let condition = condition_number(&web_system.matrix, &all, false).unwrap();
            bounded &= condition * h * h < 10.0;
            web.push(condition);
            let sparse = system.system.matrix.to_sparse().unwrap();
            let kept: Vec<bool> =
                system.space.nodes().classes().iter().map(|class| *class != NodeClass::Irrelevant).collect();
            scaled.push(condition_number(&sparse, &kept, true).unwrap());
            // A matrix that is singular to rounding has no smaller condition.
            unscaled_is_bad &= condition_number(&sparse, &kept, false).unwrap_or(f64::INFINITY) > 1e6;
        }
        example.expect("cond_web", web);
        example.expect("cond_web_times_h2_below_10", bounded);
        example.expect("cond_weighted_scaled", scaled);
        example.expect("cond_weighted_unscaled_above_1e6", unscaled_is_bad);
    }),
    ("9.2-i", |example| {
        let ellipse = Domain::ellipse(DVec2::X, DVec2::new(3.0, 2.0), 0.0).unwrap();
        let domain = ellipse.difference(unit_disc());
        let sides = example.points("box");
        let bounds = Bounds::new(DVec2::new(sides[0].x, sides[1].x), DVec2::new(sides[0].y, sides[1].y));
        for (key, h) in [("h=1", 1.0), ("h=1/2", 0.5), ("h=1/4", 0.25)] {
            let grid = Grid::with_width(bounds, h).unwrap();
            let table = QuadratureTable::new(&domain, grid, 2, &Unwatched).unwrap();
            let nodes = NodeArray::new(grid.cells(), example.count("n"), |cell| table.class(cell));
            example.expect(key, vec![nodes.classes().len(), nodes.relevant_count()]);
        }
        let weight = |x: f64, y: f64| x * x + y * y - 1.0;
        example.expect("w(2,0)", weight(2.0, 0.0));
        example.expect("w(0,1.5)", weight(0.0, 1.5));
    }),
    ("9.2-j", |example| {
        let half_disc = half_disc();
        let weight = Weight::function(|x| mushroom_weights(x)[2]);
        for n in [1, 2, 3] {
            example.expect(&format!("n={n}"), unit_load_integrals(&half_disc, &weight, n));
        }
        example.expect("exact", 16.0 * (PI / 8.0 - 1.0 / PI));
    }),
    ("9.2-k", |example| {
        let cap = Domain::ellipse(DVec2::ZERO, DVec2::new(1.0, 2.0), 0.0).unwrap();
        let mushroom = half_disc().union(cap);
        let weight = Weight::function(|x| mushroom_weights(x)[4]);
        for n in [1, 2, 3] {
            example.expect(&format!("n={n}"), unit_load_integrals(&mushroom, &weight, n));
        }
        let grid = Grid::with_width(mushroom.bounds(), 0.25).unwrap();
        let table = QuadratureTable::new(&mushroom, grid, 8, &Unwatched).unwrap();
        example.expect("area", table.integrate(|_| 1.0));
    }),
    ("9.2-l", |example| {
        let disc = unit_disc();
        let load = |x: DVec2| x.x;
        let form = EllipticForm::poisson(Coefficient::Function(&load));
        let problem = Problem { domain: &disc, weight: Weight::One, form };
        let limits = IterationLimits { relative_tolerance: 1e-13, max_steps: 5000 };
        let settings = Discretisation {
            method: Method::ConjugateGradients(limits),
            gauss_points: 9,
            ..Discretisation::new(example.count("n"), example.number("h"))
        };
        let system = WeightedSystem::assemble(&problem, &settings, &Unwatched).unwrap();
        let free = system.space.nodes().classes().iter().map(|class| *class != NodeClass::Irrelevant);
        let ones: Vec<f64> = free.map(f64::from).collect();
        let mut sums = vec![0.0; ones.len()];
        system.system.matrix.apply(&ones, &mut sums);
        let largest = sums.iter().zip(&ones).map(|(sum, one)| (sum * one).abs()).fold(0.0, f64::max);
        example.expect("row_sums_below_1e-12", largest < 1e-12);
        example.expect("sum_F_below_1e-13", system.system.load.iter().sum::<f64>().abs() < 1e-13);
        let solution = system.solve(Basis::Weighted, settings.method, None, &Unwatched).unwrap();
        let exact = |x: DVec2| Jet {
            value: x.x * (3.0 - x.length_squared()) / 8.0,
            gradient: DVec2::new(3.0 - x.length_squared() - 2.0 * x.x * x.x, -2.0 * x.x * x.y) / 8.0,
        };
        let errors = solution.errors(&exact).unwrap();
        example.expect("L2_rel_error_below_1e-6", errors.relative_l2() < 1e-6);
    }),
    ("9.4-a", |example| {
        let system = course_system(example.number("h"));
        example.expect("F", system.load);
        example.expect("G", system.matrix.values().chunks(3).map(<[f64]>::to_vec).collect::<Vec<_>>());
    }),
    ("9.4-b", |example| {
        let system = course_system(0.25);
        let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
        example.expect("U", u);
        let mut product = vec![0.0; 5];
        system.matrix.apply(&example.numbers("u"), &mut product);
        example.expect("Gu", product);
        let eigenvalues = system.matrix.to_dense().unwrap().symmetric_eigenvalues().unwrap();
        example.expect("lambda_min", eigenvalues[0]);
        example.expect("lambda_max", eigenvalues[4]);
    }),
    ("9.4-c", |example| {
        let system = course_system(0.25);
        let limits = IterationLimits { relative_tolerance: example.number("tol"), max_steps: 10 };
        let run =
            conjugate_gradients(&system.matrix, &system.load, None, &NoPreconditioner, limits, &Unwatched)
                .unwrap();
        example.expect("iterations", run.steps());
        example.expect("residuals", &run.residuals[..run.steps()]);
    }),
    ("9.4-d", |example| {
        for n in [1, 2, 3] {
            let key = format!("n={n}");
            let space = SplineSpace::uniform(n, 0.0, 9.0, 9).unwrap();
            let line = |diffusion: f64, reaction: f64| {
                let form = |_| LineForm { diffusion, reaction, load: 0.0 };
                let matrix = line_system(&space, form, n + 1).unwrap().matrix;
                (0..=n).map(|s| matrix.entry(&[5], &[s as isize])).collect::<Vec<_>>()
            };
            example.expect_at(&[&key, "mass"], line(0.0, 1.0));
            example.expect_at(&[&key, "stiffness"], line(1.0, 0.0));
            let one = |_: f64| 1.0;
            let system = rectangle_system([&space, &space], 0.0, [&one, &one], n + 1).unwrap();
            for (name, s) in
                [("laplace2d_center", [0, 0]), ("laplace2d_(1,0)", [1, 0]), ("laplace2d_(1,1)", [1, 1])]
            {
                example.expect_at(&[&key, name], system.matrix.entry(&[5, 5], &s));
            }
        }
    }),
    ("9.4-e", |example| {
        let moments = |h: f64| {
            let grid = Grid::with_width(square_bounds(), h).unwrap();
            let table = QuadratureTable::new(&unit_disc(), grid, example.count("gauss"), &Unwatched).unwrap();
            (table.integrate(|_| 1.0), table.integrate(|x| (x.x * x.y).powi(2)))
        };
        let [coarse, middle, fine] = [1.0, 0.5, 0.25].map(moments);
        example.expect("area(h=1/4)", fine.0);
        example.expect("x2y2(h=1/4)", fine.1);
        example.expect("h=1_area_error_below_5e-3", (coarse.0 - PI).abs() < 5e-3);
        example.expect("h=1/2_area_error_below_1e-7", (middle.0 - PI).abs() < 1e-7);
        example.expect("h=1/2_x2y2_error_below_1e-8", (middle.1 - PI / 24.0).abs() < 1e-8);
    }),
    ("9.4-f", |example| {
        let shape: Vec<usize> = example.numbers("m").into_iter().map(|m| m as usize).collect();
        let matrix = OffsetMatrix::new(&shape, example.count("n")).unwrap();
        example.expect("entries", matrix.entry_count());
        example.expect("flops", matrix.product_flops());
        example.expect("index", matrix.entry_index(&[3, 5], &[-1, 2]).unwrap());
    }),
    ("B.14-a", |example| {
        let half = unit_disc().intersection(Domain::half_plane(DVec2::ZERO, DVec2::X).unwrap());
        let disc_powers = [[0, 0], [2, 0], [4, 0], [2, 2], [6, 0]];
        let half_powers = [[0, 0], [1, 0], [2, 0], [1, 2], [2, 2]];
        for (key, domain, powers) in [("disc", unit_disc(), disc_powers), ("half", half, half_powers)] {
            let grid = Grid::with_width(square_bounds(), 0.25).unwrap();
            let table = QuadratureTable::new(&domain, grid, 8, &Unwatched).unwrap();
            let moment = |[a, b]: [i32; 2]| table.integrate(|x| x.x.powi(a) * x.y.powi(b));
            example.expect(key, powers.map(moment).to_vec());
        }
    }),
    ("B.14-b", |example| {
        let sides = example.rows("cell");
        let lower = DVec2::new(sides[0][0], sides[1][0]);
        let cell = Bounds::new(lower, DVec2::new(sides[0][1], sides[1][1]));
        let area = |q: usize| -> f64 {
            let sliced = slice_cell(&unit_disc(), &cell, &gauss_legendre(q).unwrap());
            assert_eq!(sliced.slices[0].inner_axis, 0, "lines run along x");
            sliced.points.iter().map(|p| p.weight).sum()
        };
        example
            .expect("gauss", example.numbers("q").into_iter().map(|q| area(q as usize)).collect::<Vec<_>>());
        example.expect("area", area(16));
    }),
    ("B.14-c", |example| {
        let factor = |x: DVec2| {
            let e = x.x.exp();
            Jet { value: e * x.y.cos(), gradient: DVec2::new(e * x.y.cos(), -e * x.y.sin()) }
        };
        // The factor is harmonic.
        let load = |x: DVec2| {
            let (w, g) = (disc_weight().at(x), factor(x));
            4.0 * g.value - 2.0 * w.gradient.dot(g.gradient)
        };
        for n in example.numbers("n") {
            let key = format!("n={n}");
            let widths = example.numbers("h");
            let runs = widths.iter().map(|h| disc_errors(&load, &factor, &exactly(n as usize, *h)));
            let (unknowns, errors): (Vec<usize>, Vec<(f64, f64)>) = runs.unzip();
            let (l2, h1): (Vec<f64>, Vec<f64>) = errors.into_iter().unzip();
            let rates = |errors: &[f64]| spline_lab::core::finite_element::convergence_rates(&widths, errors);
            example.expect_at(&[&key, "L2_rates"], rates(&l2));
            example.expect_at(&[&key, "H1_rates"], rates(&h1));
            example.expect_at(&[&key, "L2"], l2);
            example.expect_at(&[&key, "H1"], h1);
            example.expect_at(&[&key, "unknowns"], unknowns);
        }
    }),
];

/// The system of −u'' = 1 on [0, 1] with hat functions that vanish at both ends.
fn string(h: f64) -> (GalerkinSystem<SparseMatrix>, SplineSpace) {
    let intervals = (1.0 / h).round() as usize;
    let space = SplineSpace::uniform(1, 0.0, 1.0, intervals).unwrap();
    let form = |_| LineForm { diffusion: 1.0, reaction: 0.0, load: 1.0 };
    let kept: Vec<usize> = (1..intervals).collect();
    (line_system(&space, form, 2).unwrap().restrict(&kept).unwrap(), space)
}

/// −u'' + 3u = 2 with natural conditions.
fn course_system(h: f64) -> GalerkinSystem<OffsetMatrix> {
    let space = SplineSpace::uniform(1, 0.0, 1.0, (1.0 / h).round() as usize).unwrap();
    line_system(&space, |_| LineForm { diffusion: 1.0, reaction: 3.0, load: 2.0 }, 2).unwrap()
}

/// Unknowns, integral and value in the middle of the membrane over the unit square.
fn square(n: usize, h: f64) -> Got {
    let intervals = (1.0 / h).round() as usize;
    let breaks: Vec<f64> = (0..=intervals).map(|i| i as f64 * h).collect();
    let space = SplineSpace::from_breaks(n, &breaks, EndKnots::Interpolating).unwrap();
    let m = space.dimension();
    let one = |_: f64| 1.0;
    let system = rectangle_system([&space, &space], 0.0, [&one, &one], n + 1).unwrap();
    let inner = 1..m - 1;
    let kept: Vec<usize> = inner.clone().flat_map(|k| inner.clone().map(move |l| k * m + l)).collect();
    let system = system.restrict(&kept).unwrap();
    let u = system.solve(None, Method::Direct, &Unwatched).unwrap().coefficients;
    let integral: f64 = u.iter().zip(&system.load).map(|(u, f)| u * f).sum();
    let row = |k: usize| {
        let mut line = vec![0.0; m];
        line[1..m - 1].copy_from_slice(&u[k * (m - 2)..(k + 1) * (m - 2)]);
        Spline::new(space.clone(), line).unwrap().evaluate(0.5).unwrap()
    };
    let mut column = vec![0.0; m];
    (0..m - 2).for_each(|k| column[k + 1] = row(k));
    let centre = Spline::new(space.clone(), column).unwrap().evaluate(0.5).unwrap();
    vec![kept.len() as f64, integral, centre].into()
}

/// Integral and value in the middle by the double sine series.
fn square_series() -> (f64, f64) {
    let (mut integral, mut centre) = (0.0, 0.0);
    for i in (1..4000).step_by(2) {
        let i = f64::from(i);
        // The sum over the second index in closed form: a single series.
        let a = i * PI;
        integral += 8.0 / a.powi(4) * (1.0 - 2.0 / a * (0.5 * a).tanh());
        let sign = if (i as i64) % 4 == 1 { 1.0 } else { -1.0 };
        centre += sign * 4.0 / a.powi(3) * (1.0 - 1.0 / (0.5 * a).cosh());
    }
    (integral, centre)
}

fn square_bounds() -> Bounds {
    Bounds::new(DVec2::splat(-1.0), DVec2::ONE)
}

fn unit_disc() -> Domain {
    Domain::disc(DVec2::ZERO, 1.0).unwrap()
}

fn half_disc() -> Domain {
    let disc = Domain::disc(DVec2::ZERO, 2.0).unwrap();
    disc.intersection(Domain::half_plane(DVec2::ZERO, DVec2::Y).unwrap())
}

/// 1 − x² − y².
fn disc_weight() -> Weight {
    Weight::function(|x| Jet { value: 1.0 - x.length_squared(), gradient: -2.0 * x })
}

/// The five weights of the mushroom.
fn mushroom_weights(x: DVec2) -> [Jet; 5] {
    let w1 = Jet { value: 4.0 - x.length_squared(), gradient: -2.0 * x };
    let w2 = Jet { value: x.y, gradient: DVec2::Y };
    let w3 = r_intersection(w1, w2);
    let w4 = Jet { value: 1.0 - x.x * x.x - 0.25 * x.y * x.y, gradient: DVec2::new(-2.0 * x.x, -0.5 * x.y) };
    [w1, w2, w3, w4, r_union(w3, w4)]
}

/// A direct solution, whose residual is near rounding.
fn exactly(degree: usize, h: f64) -> Discretisation {
    Discretisation { method: Method::Direct, ..Discretisation::new(degree, h) }
}

/// Unknowns and relative errors of the solution `u = w·factor` on the unit disc.
fn disc_errors(
    load: &(dyn Fn(DVec2) -> f64 + Sync),
    factor: &(dyn Fn(DVec2) -> Jet + Sync),
    discretisation: &Discretisation,
) -> (usize, (f64, f64)) {
    let disc = unit_disc();
    let form = EllipticForm::poisson(Coefficient::Function(load));
    let problem = Problem { domain: &disc, weight: disc_weight(), form };
    let solution: WeightedSolution = solve_problem(&problem, discretisation, None, &Unwatched).unwrap();
    let exact = |x: DVec2| {
        let (w, g) = (disc_weight().at(x), factor(x));
        Jet { value: w.value * g.value, gradient: w.gradient * g.value + g.gradient * w.value }
    };
    let errors = solution.errors(&exact).unwrap();
    (solution.unknowns(), (errors.relative_l2(), errors.relative_h1_seminorm()))
}

/// `∫ u_h` for −Δu = 1 with h = 1/2, 1/4, 1/8.
///
/// R-function weights have no second derivatives at corners, which Gauss rules feel: 8 points are needed.
fn unit_load_integrals(domain: &Domain, weight: &Weight, degree: usize) -> Vec<f64> {
    let form = EllipticForm::poisson(Coefficient::Constant(1.0));
    let problem = Problem { domain, weight: weight.clone(), form };
    let integral = |h: f64| {
        let settings = Discretisation { gauss_points: 8, ..Discretisation::new(degree, h) };
        solve_problem(&problem, &settings, None, &Unwatched).unwrap().integral().unwrap()
    };
    [0.5, 0.25, 0.125].map(integral).to_vec()
}
