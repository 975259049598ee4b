//! What runs for every point of a curve does not allocate.

use allocation_counter::measure;
use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, PowerForm, Side, SplineSpace};
use spline_lab::core::spline_curve::{ClosestPointTree, Nurbs};

/// A curve of the degree with and without weights.
fn curves(degree: usize) -> [Nurbs<DVec2>; 2] {
    let breaks: Vec<f64> = (0..40).map(f64::from).collect();
    let space =
        SplineSpace::from_breaks(degree, &breaks, EndKnots::Interpolating).expect("increasing breaks");
    let points: Vec<DVec2> =
        (0..space.dimension()).map(|k| DVec2::new(k as f64, (0.7 * k as f64).sin())).collect();
    let weights = (0..points.len()).map(|k| 1.0 + 0.5 * (k as f64).cos()).collect();
    let polynomial = Nurbs::polynomial(space.clone(), points.clone()).expect("points fit the space");
    [polynomial, Nurbs::new(space, points, weights).expect("weights are positive")]
}

#[track_caller]
fn assert_free(what: &str, run: impl FnOnce()) {
    let counted = measure(run);
    assert_eq!(counted.count_total, 0, "{what} allocates {} bytes", counted.bytes_total);
}

#[test]
fn evaluation_does_not_allocate() {
    let ts: Vec<f64> = (0..500).map(|i| 0.078 * f64::from(i)).collect();
    let mut points = vec![DVec2::ZERO; ts.len()];
    for degree in [1, 3, 12, 25] {
        for curve in curves(degree) {
            assert_free("a value", || assert!(curve.evaluate(1.5).is_ok(), "in D"));
            assert_free("many values", || curve.evaluate_into(&ts, &mut points).expect("in D"));
            let mut jet = [DVec2::ZERO; 4];
            assert_free("derivatives", || {
                curve.derivatives_into(1.5, Side::Right, &mut jet).expect("in D");
            });
            let tree = ClosestPointTree::new(&curve).expect("small numbers");
            assert_free("a closest point", || assert!(tree.closest_point(DVec2::ONE).is_ok(), "finite"));
        }
    }
}

#[test]
fn prepared_evaluation_does_not_allocate() {
    let ts: Vec<f64> = (0..500).map(|i| 39.0 - 0.078 * f64::from(i)).collect();
    let (mut points, mut jets) = (vec![DVec2::ZERO; ts.len()], vec![[DVec2::ZERO; 3]; ts.len()]);
    for degree in [1, 3, 12] {
        let form = PowerForm::new(curves(degree)[0].without_weights());
        assert_free("many values", || form.evaluate_into(&ts, &mut points).expect("in D"));
        assert_free("derivatives", || form.derivatives_into(&ts, &mut jets).expect("in D"));
    }
}

#[test]
fn the_counter_counts() {
    assert_eq!(measure(|| drop(vec![1_u8; 100])).count_total, 1, "one vector");
}
