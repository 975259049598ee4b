//! Chapter 9: isogeometric elements, potential flow, and fast diagonalisation (section B.15).

use glam::DVec2;
use spline_lab::core::finite_element::{
    Coefficient, EllipticForm, FastDiagonalisation, FixedSides, IsogeometricSpace, IsogeometricSystem,
    MultiPatch, PatchSide, PlanePatch, PotentialFlow, convergence_rates, sample_geometries, solve_patch,
};
use spline_lab::core::linear_system::{DenseMatrix, LinearOperator as _};
use spline_lab::core::progress::Unwatched;

use crate::example::{Example, Got};

/// The checks, by id.
pub(crate) const CHECKS: &[(&str, fn(&Example))] = &[
    ("9.3-a", |example| {
        let patch = given_patch(example, [1, 2], DVec2::ONE);
        assert_eq!(patch, sample_geometries::book_patch(), "the sample is the example");
        let jet = patch.jet(DVec2::splat(0.5)).unwrap();
        example.expect("phi", jet.point);
        example.expect("J", rows(jet.tangents));
        example.expect("det", jet.determinant());
        example.expect("area", patch.area());
        let dimension = |divisions: usize| {
            IsogeometricSpace::refined(&patch, 2, [divisions; 2], &[PatchSide::Bottom]).unwrap().dimension()
        };
        example.expect("dofs", vec![dimension(4), dimension(8)]);
    }),
    ("9.3-b", |example| {
        let divisions = (1.0 / example.number("h")).round() as usize;
        let patch = sample_geometries::book_patch();
        let space = IsogeometricSpace::refined(&patch, 2, [divisions; 2], &[PatchSide::Bottom]).unwrap();
        example.expect("dofs", space.dimension());
        let [first, second] = [0, 1].map(|axis: usize| space.spaces()[axis].greville_abscissae());
        let expected: Vec<f64> =
            first.iter().flat_map(|a| second.iter().map(move |b| b * (1.0 + 3.0 * a))).collect();
        let form = EllipticForm::poisson(Coefficient::Constant(0.0));
        let system = IsogeometricSystem::assemble(space, &form, &[], &Unwatched).unwrap();
        let mut load = vec![0.0; expected.len()];
        system.matrix().apply(&expected, &mut load);
        let solution = system.with_right_side(load).unwrap().solve(&Unwatched).unwrap();
        let got = solution.coefficients();
        let deviation = got.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        example.expect("max_deviation_below_1e-12", deviation < 1e-12);
        example.expect("energy", solution.energy());
        example.expect("c_(2,3)", got[2 * second.len() + 3]);
    }),
    ("9.3-c", |example| {
        for degree in [2, 3] {
            let integral = |divisions: usize| {
                let patch = sample_geometries::book_patch();
                let space =
                    IsogeometricSpace::refined(&patch, degree, [divisions; 2], &[PatchSide::Bottom]).unwrap();
                let form = EllipticForm::poisson(Coefficient::Constant(example.number("f")));
                solve_patch(space, &form, &[], &Unwatched).unwrap().integral().unwrap()
            };
            example.expect(&format!("n={degree}"), [2, 4, 8, 16].map(integral).to_vec());
        }
    }),
    ("9.3-d", |example| {
        let vector = |key: &str| DVec2::from_slice(&example.numbers(key));
        let jet = sample_geometries::book_patch().jet(vector("t")).unwrap();
        example.expect("J", rows(jet.tangents));
        example.expect("det", jet.determinant());
        example.expect("grad_x", jet.gradient(vector("grad_t")));
    }),
    ("9.3-e", |example| {
        for degree in example.numbers("n") {
            let row = |divisions: usize| {
                let patches = sample_geometries::l_shape();
                let domain =
                    MultiPatch::refined(&patches, degree as usize, divisions, FixedSides::All).unwrap();
                let form = EllipticForm::poisson(Coefficient::Constant(1.0));
                let integral = domain.solve(&form, &Unwatched).unwrap().integral().unwrap();
                vec![domain.coefficient_count() as f64, domain.dimension() as f64, integral]
            };
            example.expect(&format!("n={degree}"), [2, 4, 8].map(row).to_vec());
        }
    }),
    ("9.5-a", |example| {
        let patch = given_patch(example, [3, 1], DVec2::new(2.0, 1.0));
        assert_eq!(patch, sample_geometries::channel(), "the sample is the example");
        for (key, y) in [("phi(1,.5)", 0.5), ("phi(1,0)", 0.0), ("phi(1,1)", 1.0)] {
            example.expect(key, patch.evaluate(DVec2::new(1.0, y)).unwrap());
        }
        example.expect("area", patch.area());
        let range = patch.determinant_range();
        example.expect("det_min", range.least);
        example.expect("det_max", range.greatest);
        // h = 1/8 on [0, 2] × [0, 1].
        let space = IsogeometricSpace::refined(&patch, 2, [16, 8], &[]).unwrap();
        example.expect("dofs", space.dimension());
    }),
    ("9.5-b", |example| {
        let reference = flow(5, 1.0 / 16.0, example.number("s"));
        let widths = example.numbers("h");
        for degree in example.numbers("n") {
            let key = format!("n={degree}");
            let (mut l2, mut h1) = (Vec::new(), Vec::new());
            for h in &widths {
                let flow = flow(degree as usize, *h, example.number("s"));
                let norms = flow.potential().difference_norms(reference.potential()).unwrap();
                l2.push(norms.relative_l2());
                let (energy, exact) = (flow.potential().energy(), reference.potential().energy());
                h1.push(((exact - energy) / exact).sqrt());
            }
            example.expect_at(&[&key, "L2_rates"], convergence_rates(&widths, &l2));
            example.expect_at(&[&key, "H1_rates"], convergence_rates(&widths, &h1));
            example.expect_at(&[&key, "L2"], l2);
            example.expect_at(&[&key, "H1"], h1);
        }
    }),
    ("9.5-c", |example| {
        let (degree, s) = (example.count("n"), example.number("s"));
        let energy = |degree: usize, cells: f64| flow(degree, 1.0 / cells, s).potential().energy();
        example.expect("energies", [2.0, 4.0, 8.0, 16.0].map(|cells| energy(degree, cells)).to_vec());
        example.expect("reference", energy(5, 16.0));
    }),
    ("9.5-d", |example| {
        let flow = flow(3, 1.0 / 16.0, example.number("s"));
        for (key, t) in [("t=(1.0, 0.5)", 1.0), ("t=(0.5, 0.5)", 0.5), ("t=(1.5, 0.5)", 1.5)] {
            example.expect(key, flow.velocity(DVec2::new(t, 0.5)).unwrap());
        }
        example.expect("flux", flow.flux(1.0).unwrap());
        let end = |c: f64| {
            let line = flow.stream_line(DVec2::new(0.0, 10.0 + c), 1e-7).unwrap();
            let end = line.points[line.points.len() - 1].point;
            assert!((end.x - 33.0).abs() < 1e-9, "the line from height {c} ends at {end}");
            end.y
        };
        example.expect("end_heights", [2.5, 5.0, 7.5].map(end).to_vec());
    }),
    ("B.15-a", |example| {
        let divisions = (1.0 / example.number("h")).round() as usize;
        let (system, solver) = on_square(example.count("n"), divisions, example.number("f"));
        let [first, second] = solver.eigenvalues();
        example.expect("lambda", &first[..]);
        let row = |a: &f64| second.iter().map(|b| a + b).collect::<Vec<_>>();
        example.expect("denominators", first.iter().map(row).collect::<Vec<_>>());
        let inner = |u: Vec<f64>| [5, 6, 9, 10].map(|k: usize| u[k]).to_vec();
        example.expect("U", inner(solver.solve(system.right_side()).unwrap()));
        let mut unit = vec![0.0; 16];
        unit[5] = 1.0;
        example.expect("U_e1", inner(solver.solve(&unit).unwrap()));
    }),
    ("B.15-b", |example| {
        let ends = |degree: f64| {
            let (_, solver) = on_square(degree as usize, example.count("intervals"), 0.0);
            let values = &solver.eigenvalues()[0];
            (values[0], values[values.len() - 1])
        };
        example.expect("lambda_min_max", example.numbers("n").into_iter().map(ends).collect::<Vec<_>>());
    }),
    ("B.15-c", |example| {
        // a = 1 + 3 x y
        let coefficient = |x: DVec2| 1.0 + 3.0 * x.x * x.y;
        let diffusion = |x: DVec2| glam::DMat2::IDENTITY * coefficient(x);
        let (degree, cells) = (example.count("n"), example.numbers("cells"));
        let (_, solver) = on_square(degree, cells[0] as usize, 0.0);
        let form = EllipticForm {
            diffusion: Coefficient::Function(&diffusion),
            ..EllipticForm::poisson(Coefficient::Constant(0.0))
        };
        let space = square_space(degree, cells[0] as usize);
        let system = IsogeometricSystem::assemble(space, &form, &[], &Unwatched).unwrap();
        let values = preconditioned_spectrum(&system, &solver);
        example.expect("lambda_min", values[0]);
        example.expect("lambda_max", values[values.len() - 1]);
        example.expect("bounds", (coefficient(DVec2::ZERO), coefficient(DVec2::ONE)));
    }),
];

fn given_patch(example: &Example, degrees: [usize; 2], size: DVec2) -> PlanePatch {
    let rows = example.input("c").as_array().unwrap();
    let point = |p: &serde_json::Value| DVec2::new(p[0].as_f64().unwrap(), p[1].as_f64().unwrap());
    let points: Vec<DVec2> = rows.iter().flat_map(|row| row.as_array().unwrap()).map(point).collect();
    let weights = vec![1.0; points.len()];
    PlanePatch::bezier(degrees, size, points, weights).unwrap()
}

fn rows([a, b]: [DVec2; 2]) -> Got {
    vec![DVec2::new(a.x, b.x), DVec2::new(a.y, b.y)].into()
}

/// The channel with mesh width `h` in both directions.
fn flow(degree: usize, h: f64, speed: f64) -> PotentialFlow {
    let divisions = [(2.0 / h).round() as usize, (1.0 / h).round() as usize];
    PotentialFlow::solve(&sample_geometries::channel(), degree, divisions, speed, None, &Unwatched).unwrap()
}

fn square_space(degree: usize, divisions: usize) -> IsogeometricSpace {
    let square = sample_geometries::unit_square();
    IsogeometricSpace::refined(&square, degree, [divisions; 2], &PatchSide::ALL).unwrap()
}

/// Poisson's problem on the unit square with zero boundary values, and its direct solver.
fn on_square(degree: usize, divisions: usize, load: f64) -> (IsogeometricSystem, FastDiagonalisation) {
    let form = EllipticForm::poisson(Coefficient::Constant(load));
    let system =
        IsogeometricSystem::assemble(square_space(degree, divisions), &form, &[], &Unwatched).unwrap();
    let solver = system.preconditioner().unwrap();
    (system, solver)
}

/// Eigenvalues of `P⁻¹ A`: those of `Wᵗ A W` with the columns `(vᵢ ⊗ vⱼ)/√(λᵢ + λⱼ)`, for which `Wᵗ P W` is the identity.
fn preconditioned_spectrum(system: &IsogeometricSystem, solver: &FastDiagonalisation) -> Vec<f64> {
    let [rows, columns] = system.space().free();
    let size = system.space().sizes()[1];
    let (first, second) = (solver.eigenvectors(0).unwrap(), solver.eigenvectors(1).unwrap());
    let mut vectors = Vec::new();
    for (i, a) in solver.eigenvalues()[0].iter().enumerate() {
        for (j, b) in solver.eigenvalues()[1].iter().enumerate() {
            let mut vector = vec![0.0; system.space().coefficient_count()];
            for k in rows.clone() {
                for l in columns.clone() {
                    let product = first.row(i)[k - rows.start] * second.row(j)[l - columns.start];
                    vector[k * size + l] = product / (a + b).sqrt();
                }
            }
            vectors.push(vector);
        }
    }
    let products: Vec<Vec<f64>> = vectors
        .iter()
        .map(|vector| {
            let mut product = vec![0.0; vector.len()];
            system.matrix().apply(vector, &mut product);
            product
        })
        .collect();
    let entry = |i: usize, j: usize| vectors[i].iter().zip(&products[j]).map(|(a, b)| a * b).sum();
    let matrix = DenseMatrix::from_function(vectors.len(), vectors.len(), entry).unwrap();
    matrix.symmetric_eigenvalues().unwrap()
}
