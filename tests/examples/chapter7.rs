//! Chapter 7: multivariate splines.

use glam::DVec2;
use spline_lab::core::bspline::{Side, SplineSpace};
use spline_lab::core::tensor::{CellPosition, Relevance, TensorSpline, TensorSplineSpace, box_spline};

use crate::Check;
use crate::example::{Example, Got};

pub(crate) const CHECKS: &[(&str, Check)] = &[
    ("7.3-a", |example| {
        let cases = example.input("cases").as_array().unwrap();
        let value = |case: &serde_json::Value| {
            let pair = |i: usize| [0, 1].map(|axis| case[i][axis].as_f64().unwrap());
            single([0, 1].map(|axis| pair(0)[axis] as usize), 1.0).evaluate(pair(1)).unwrap()
        };
        example.expect_at(&[], cases.iter().map(value).collect::<Vec<_>>());
    }),
    ("7.3-b", |example| {
        let n = example.numbers("n");
        let line = |axis: usize, key: &str| SplineSpace::new(n[axis] as usize, example.numbers(key)).unwrap();
        let space = TensorSplineSpace::new([line(0, "xi1"), line(1, "xi2")]).unwrap();
        example.expect("avg1", (0..3).map(|k| space.node([k, 0])[0]).collect::<Vec<_>>());
        example.expect("avg2", (0..2).map(|k| space.node([2, k])[1]).collect::<Vec<_>>());
        example.expect("m", space.shape().to_vec());
        example.expect("D", space.parameter_box().to_vec());
        example.expect("support of k=(1,0)", space.support([1, 0]).to_vec());
    }),
    ("7.3-c", |example| {
        let intervals = (2.0 / example.number("h")).round() as usize;
        for n in example.numbers("n") {
            let line = SplineSpace::uniform(n as usize, -1.0, 1.0, intervals).unwrap();
            let space = TensorSplineSpace::new([line.clone(), line]).unwrap();
            let mask = space.relevance([(-1.0, 1.0); 2], disc).unwrap();
            let key = format!("n={n}");
            let (inner, outer) = (mask.count(Relevance::Inner), mask.count(Relevance::Outer));
            example.expect_at(&[&key, "array"], space.dimension());
            example.expect_at(&[&key, "relevant"], inner + outer);
            example.expect_at(&[&key, "inner"], inner);
            example.expect_at(&[&key, "outer"], outer);
            let kinds = [CellPosition::Inside, CellPosition::Cut, CellPosition::Outside];
            let counts = kinds.map(|kind| mask.cell_count(kind)).to_vec();
            example.expect_at(&[&key, "cells inner/cut/outside"], counts);
        }
    }),
    ("7.3-d", |example| {
        let (n, monomial) = (degrees(example), example.numbers("monomial"));
        let space = TensorSplineSpace::new([integer_knots(n[0], 4), integer_knots(n[1], 3)]).unwrap();
        let place = monomial[0] as usize * (n[1] + 1) + monomial[1] as usize;
        let monomials: Vec<f64> =
            (0..(n[0] + 1) * (n[1] + 1)).map(|i| f64::from(u8::from(i == place))).collect();
        let spline = TensorSpline::from_monomials(space, &monomials).unwrap();
        example.expect_at(&[], rows(spline.coefficients(), 3));
    }),
    ("7.3-e", |example| {
        let u: Vec<DVec2> = example.points("u");
        let courant = [DVec2::X, DVec2::Y, u[0]];
        let element = [DVec2::X, DVec2::Y, u[0], u[1]];
        let values = |directions: &[DVec2], places: [[f64; 2]; 3]| {
            places.map(|[x, y]| box_spline(directions, DVec2::new(x, y)).unwrap()).to_vec()
        };
        example.expect("courant", values(&courant, [[1.0, 1.0], [0.5, 0.5], [1.5, 1.0]]));
        example.expect("zwart_powell", values(&element, [[0.5, 1.5], [0.0, 1.0], [0.5, 1.0]]));
    }),
    ("7.4-a", |example| {
        let (n, c, x) = (degrees(example), example.rows("coefficients"), example.numbers("x"));
        let space = TensorSplineSpace::new([integer_knots(n[0], 8), integer_knots(n[1], 10)]).unwrap();
        let coefficient = |place: usize| {
            let [i, j] = space.multi_index(place);
            let row = i.checked_sub(4).and_then(|row| c.get(row));
            row.zip(j.checked_sub(5)).and_then(|(row, column)| row.get(column)).copied().unwrap_or(0.0)
        };
        let coefficients = (0..space.dimension()).map(coefficient).collect();
        let spline = TensorSpline::new(space.clone(), coefficients).unwrap();
        let tableau = spline.uniform_tableau([x[0], x[1]]).unwrap();
        assert_eq!(tableau.cell.map(|l| l as f64).to_vec(), example.numbers("cell"), "the cell");
        example.expect("after step i=2 (rows a5,a6)", tableau.first_direction[1].clone());
        example.expect("after x1", tableau.first_direction[2][0].clone());
        example.expect("x2 triangle", tableau.second_direction[1..].to_vec());
        example.expect("undivided", tableau.second_direction[3][0]);
        example.expect("value", tableau.value);
        example.expect("value", spline.evaluate([x[0], x[1]]).unwrap());
    }),
    ("7.4-b", |example| {
        let n = degrees(example);
        let line = |axis: usize, key: &str| SplineSpace::new(n[axis], example.numbers(key)).unwrap();
        let space = TensorSplineSpace::new([line(0, "xi1"), line(1, "xi2")]).unwrap();
        let spline = TensorSpline::new(space, example.rows("c").concat()).unwrap();
        let all = spline.derivatives([2.0, 0.5], 2, [Side::Right; 2]).unwrap();
        example.expect("p(2,.5)", spline.evaluate([2.0, 0.5]).unwrap());
        for (key, orders) in [("d1", [1, 0]), ("d2", [0, 1]), ("d1d2", [1, 1]), ("d1d1", [2, 0])] {
            example.expect(key, all.get(orders).unwrap());
        }
        example.expect("p(.5,1.5)", spline.evaluate([0.5, 1.5]).unwrap());
    }),
    ("7.4-c", |example| {
        let spline = single([2, 2], example.number("h"));
        for (index, at) in example.points("points").into_iter().enumerate() {
            let (at, sides, index) = (at.to_array(), [Side::Right; 2], index.to_string());
            let all = spline.derivatives(at, 1, sides).unwrap();
            let gradient = [all.get([1, 0]).unwrap(), all.get([0, 1]).unwrap()];
            example.expect_at(&[&index, "grad"], gradient.to_vec());
            example.expect_at(&[&index, "laplace"], spline.laplacian(at, sides).unwrap());
        }
    }),
    ("7.4-d", |example| {
        let h = example.number("h");
        let line = SplineSpace::new(2, (0..7).map(|k| h * f64::from(k)).collect()).unwrap();
        let space = TensorSplineSpace::new([line.clone(), line]).unwrap();
        let spline = TensorSpline::new(space, example.rows("c").concat()).unwrap();
        for (key, orders, width) in [("d1", [1, 0], 4), ("d1d2", [1, 1], 3)] {
            let sum = spline.partial_sum(orders).unwrap().unwrap();
            example.expect(key, rows(sum.coefficients(), width));
        }
        example.expect("d1", rows(spline.partial(0).unwrap().coefficients(), 4));
    }),
    ("7.4-e", |example| {
        let n: Vec<usize> = example.numbers("n").into_iter().map(|n| n as usize).collect();
        let x = example.numbers("x");
        let space =
            TensorSplineSpace::new([integer_knots(n[0], 5), integer_knots(n[1], 6), integer_knots(n[2], 7)])
                .unwrap();
        let coefficient = |place: usize| {
            let [i, j, k] = space.multi_index(place).map(|k| k as f64);
            i - 2.0 * j * k + 1.0
        };
        let coefficients = (0..space.dimension()).map(coefficient).collect();
        let spline = TensorSpline::new(space.clone(), coefficients).unwrap();
        example.expect_at(&[], spline.evaluate([x[0], x[1], x[2]]).unwrap());
    }),
];

fn degrees(example: &Example) -> [usize; 2] {
    let n = example.numbers("n");
    [n[0] as usize, n[1] as usize]
}

/// Knots 0, 1, 2, … for `count` B-splines.
fn integer_knots(degree: usize, count: usize) -> SplineSpace {
    SplineSpace::new(degree, (0..=count + degree).map(|k| k as f64).collect()).unwrap()
}

fn rows(values: &[f64], width: usize) -> Got {
    values.chunks(width).map(<[f64]>::to_vec).collect::<Vec<_>>().into()
}

/// The uniform B-spline with the support `[0, (n + 1) h]` in both directions, as a spline over that box.
fn single(n: [usize; 2], h: f64) -> TensorSpline<f64, 2> {
    let line = |n: usize| {
        let knot = |k: usize| h * (k as f64 - n as f64);
        SplineSpace::new(n, (0..3 * n + 2).map(knot).collect()).unwrap()
    };
    let space = TensorSplineSpace::new(n.map(line)).unwrap();
    let middle = space.flat_index(n);
    let coefficients = (0..space.dimension()).map(|k| f64::from(u8::from(k == middle))).collect();
    TensorSpline::new(space, coefficients).unwrap()
}

/// Where a cell lies with respect to the unit disc.
fn disc(cell: [(f64, f64); 2]) -> CellPosition {
    let nearest: f64 = cell.iter().map(|&(a, b)| 0.0_f64.clamp(a, b).powi(2)).sum();
    let farthest: f64 = cell.iter().map(|&(a, b)| a.abs().max(b.abs()).powi(2)).sum();
    match (nearest < 1.0, farthest <= 1.0) {
        (false, _) => CellPosition::Outside,
        (true, false) => CellPosition::Cut,
        (true, true) => CellPosition::Inside,
    }
}
