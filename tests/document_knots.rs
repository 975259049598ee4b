//! What edits of knots do: what stays, what is measured, what is refused, and that undo takes it back exactly.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::DVec2;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::{KnotRule, Nurbs};
use spline_lab::document::{CurveDisplay, Document, Edit, EditError, History, ObjectId, ShapeChange};

const CURVE: ObjectId = ObjectId(1);

fn curve(space: SplineSpace, rational: bool) -> Nurbs<DVec2> {
    let count = space.dimension();
    let points = (0..count).map(|k| DVec2::from_angle(k as f64 * 0.9) * (1.0 + 0.2 * k as f64)).collect();
    let weights = (0..count).map(|k| if rational { 1.0 + 0.3 * (k % 3) as f64 } else { 1.0 }).collect();
    Nurbs::new(space, points, weights).unwrap()
}

/// Open with n-fold and with simple ends, closed, of degrees 1 to 12, rational and not.
fn all() -> Vec<Nurbs<DVec2>> {
    let mut curves = Vec::new();
    for rational in [false, true] {
        for degree in [1, 2, 3, 5, 12] {
            let count = 2 * degree + 5;
            let breaks: Vec<f64> = (0..count - degree + 1).map(|k| (k * (k + 3)) as f64 / 4.0).collect();
            for ends in [
                spline_lab::core::bspline::EndKnots::Interpolating,
                spline_lab::core::bspline::EndKnots::Simple,
            ] {
                curves.push(curve(SplineSpace::from_breaks(degree, &breaks, ends).unwrap(), rational));
            }
            let knots: Vec<f64> = (0..count).map(|k| k as f64 + 0.3 * (k % 2) as f64).collect();
            curves.push(curve(SplineSpace::periodic(degree, count as f64, knots).unwrap(), rational));
        }
    }
    curves
}

fn with(curve: Nurbs<DVec2>) -> Document {
    let mut document = Document::new();
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: "Curve".to_owned(), curve, display }).unwrap();
    document
}

/// Largest distance at 200 equal parameters of the first.
fn distance(a: &Nurbs<DVec2>, b: &Nurbs<DVec2>) -> f64 {
    let (left, right) = a.space().parameter_interval();
    (0..=200)
        .map(|i| left + (right - left) * f64::from(i) / 200.0)
        .map(|t| a.evaluate(t).unwrap().distance(b.evaluate(t).unwrap()))
        .fold(0.0, f64::max)
}

fn keep_curve(edit: Edit) -> Edit {
    Edit::KeepCurve { edit: Box::new(edit) }
}

/// The index of a simple knot in the middle of D.
fn inner_knot(curve: &Nurbs<DVec2>) -> usize {
    let knots = curve.space().knots();
    knots.len() / 2
}

/// Edits that change knots alone, valid for every curve of [`all`].
fn knot_edits(curve: &Nurbs<DVec2>) -> Vec<Edit> {
    let (space, index) = (curve.space(), inner_knot(curve));
    let at = space.knots()[index];
    let gap = space.knot(index as isize + 1).unwrap() - at;
    let mut edits = vec![
        Edit::MoveKnot { object: CURVE, knot: index, to: at + 0.4 * gap },
        Edit::MoveDistinctKnot { object: CURVE, at, to: at + 0.4 * gap },
        Edit::SetKnots {
            object: CURVE,
            knots: space
                .knots()
                .iter()
                .enumerate()
                .map(|(k, &knot)| if k == index { knot + 0.2 * gap } else { knot })
                .collect(),
        },
    ];
    edits.extend(KnotRule::ALL.map(|rule| Edit::GenerateKnots { object: CURVE, rule }));
    edits
}

#[test]
fn the_control_points_stay_or_the_curve_is_the_nearer_one() {
    for old in all() {
        for edit in knot_edits(&old) {
            let name = format!("{} of degree {}", edit.name(), old.degree());
            let mut points_kept = with(old.clone());
            points_kept.apply(&edit).unwrap();
            let moved = points_kept.curve(CURVE).unwrap();
            assert_eq!((moved.points(), moved.weights()), (old.points(), old.weights()), "{name}");

            let mut curve_kept = with(old.clone());
            let outcome = match curve_kept.apply(&keep_curve(edit)) {
                Ok(outcome) => outcome,
                // A projection can lose the weights of a rational curve; that is said, not hidden.
                Err(error) => {
                    assert!(!old.is_polynomial() && error.name() == "WeightNotPositive", "{name}: {error}");
                    continue;
                }
            };
            let kept = curve_kept.curve(CURVE).unwrap();
            assert_eq!(kept.space(), moved.space(), "{name}: the same knots");
            let found = distance(&old, kept);
            if let ShapeChange::Changed { deviation, .. } = outcome.shape {
                let deviation = deviation.unwrap();
                assert!(found <= deviation + 1e-12, "{name}: {found} is above the bound {deviation}");
            } else {
                assert!(found <= 1e-12, "{name}: {found}");
            }
            let other = distance(&old, moved);
            assert!(
                found <= other + 1e-7,
                "{name}: {found} with the curve kept, {other} with the points kept"
            );
        }
    }
}

#[test]
fn the_ends_of_a_kept_curve_stay_where_they_are() {
    for old in all().into_iter().filter(|curve| !curve.space().is_periodic()) {
        let (left, right) = old.space().parameter_interval();
        if old.space().multiplicity(left) < old.degree() {
            continue;
        }
        for edit in knot_edits(&old) {
            let mut document = with(old.clone());
            if document.apply(&keep_curve(edit.clone())).is_err() {
                continue;
            }
            let new = document.curve(CURVE).unwrap();
            if new.space().multiplicity(left) == new.degree() {
                for t in [left, right] {
                    let off = old.evaluate(t).unwrap().distance(new.evaluate(t).unwrap());
                    assert!(off < 1e-12, "{}: {off} at {t}", edit.name());
                }
            }
        }
    }
}

#[test]
fn a_kept_curve_takes_any_number_of_knots() {
    let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0, 4.0, 5.0]).unwrap();
    let old = curve(space, false);
    let mut document = with(old.clone());
    let knots = vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 2.0, 2.5, 3.0, 4.0, 4.0, 4.0, 4.0];
    let plain = Edit::SetKnots { object: CURVE, knots };
    assert_eq!(document.apply(&plain).unwrap_err().name(), "SizeMismatch", "with the points kept");
    document.apply(&keep_curve(plain)).unwrap();
    let new = document.curve(CURVE).unwrap();
    assert_eq!(new.points().len(), 9, "two knots more");
    assert!(distance(&old, new) < 1e-12, "the new space holds the curve: {}", distance(&old, new));
}

#[test]
fn outer_knots_move_without_the_curve() {
    let old = curve(SplineSpace::new(3, (0..12).map(f64::from).collect()).unwrap(), true);
    let mut document = with(old.clone());
    document.apply(&keep_curve(Edit::MoveKnot { object: CURVE, knot: 2, to: 1.25 })).unwrap();
    let new = document.curve(CURVE).unwrap();
    assert_ne!(new.points(), old.points(), "other control points");
    assert!(distance(&old, new) < 1e-11, "the same curve: {}", distance(&old, new));
}

#[test]
fn a_closed_curve_is_kept_when_its_seam_moves() {
    for rational in [false, true] {
        let space = SplineSpace::periodic(3, 7.0, vec![0.0, 1.0, 2.0, 3.0, 4.5, 5.0, 6.0]).unwrap();
        let old = curve(space, rational);
        let mut document = with(old.clone());
        let outcome =
            document.apply(&keep_curve(Edit::MoveKnot { object: CURVE, knot: 0, to: -0.3 })).unwrap();
        let new = document.curve(CURVE).unwrap();
        assert_eq!(new.space().knots()[0], -0.3, "the seam");
        let ShapeChange::Changed { deviation: Some(deviation), .. } = outcome.shape else {
            panic!("{:?}", outcome.shape)
        };
        assert!(distance(&old, new) <= deviation, "{} and {deviation}", distance(&old, new));
    }
}

#[test]
fn knots_stack_across_the_seam_of_a_closed_curve() {
    for rational in [false, true] {
        let space = SplineSpace::periodic(3, 7.0, vec![0.0, 1.0, 2.0, 3.0, 4.5, 5.0, 6.0]).unwrap();
        let old = curve(space, rational);
        for (knot, to, away, knots) in [
            (6, 7.0, 2.5, [0.0, 0.0, 1.0, 2.0, 3.0, 4.5, 5.0]),
            (0, -1.0, 3.7, [-1.0, -1.0, 1.0, 2.0, 3.0, 4.5, 5.0]),
        ] {
            let edit = Edit::MoveKnot { object: CURVE, knot, to };
            let mut document = with(old.clone());
            document.apply(&edit).unwrap();
            let new = document.curve(CURVE).unwrap();
            assert_eq!(new.space().knots(), knots, "knot {knot} onto {to}");
            // Every control point keeps its weight and its neighbours.
            let at = |curve: &Nurbs<DVec2>, k: usize| (curve.points()[k % 7], curve.weights()[k % 7]);
            for k in 0..7 {
                assert_eq!(at(new, k + 1), at(&old, k), "point {k} counts one more");
            }
            // Where the moved knot does not reach, the curve stays.
            let far = old.evaluate(away).unwrap().distance(new.evaluate(away).unwrap());
            assert!(far < 1e-12, "{far} at {away}");

            let mut kept = with(old.clone());
            kept.apply(&keep_curve(edit)).unwrap();
            let kept = kept.curve(CURVE).unwrap();
            assert_eq!(kept.space().knots(), knots, "with the curve kept");
            assert!(distance(&old, kept) < distance(&old, new), "nearer");
        }
    }
}

#[test]
fn knots_go_within_the_tolerance_and_not_beyond() {
    for old in all().into_iter().filter(|curve| curve.degree() <= 5) {
        let mut left = old.points().len();
        for tolerance in [0.0, 1e-9, 0.05, 0.5, 5.0] {
            let mut document = with(old.clone());
            let edit = Edit::RemoveKnotsWithin { object: CURVE, tolerance };
            let outcome = document.apply(&edit).unwrap();
            let new = document.curve(CURVE).unwrap();
            assert!(new.points().len() <= left, "a larger tolerance leaves no more points");
            left = new.points().len();
            assert!(distance(&old, new) <= tolerance + 1e-10, "{} of {tolerance}", distance(&old, new));
            if left == old.points().len() {
                assert_eq!((outcome.shape, new), (ShapeChange::None, &old), "nothing went");
            }
        }
        let mut refined = with(old.clone());
        refined.apply(&Edit::RefineUniformly { object: CURVE }).unwrap();
        refined.apply(&Edit::RemoveKnotsWithin { object: CURVE, tolerance: 1e-8 }).unwrap();
        assert!(refined.curve(CURVE).unwrap().points().len() <= old.points().len(), "superfluous knots go");
    }
}

#[test]
fn every_edit_of_knots_is_undone_and_redone_exactly() {
    for old in all() {
        let mut edits = knot_edits(&old);
        edits.extend(knot_edits(&old).into_iter().map(keep_curve));
        edits.push(Edit::RemoveKnotsWithin { object: CURVE, tolerance: 1.0 });
        for edit in edits {
            let start = with(old.clone());
            let mut history = History::new(start.clone());
            let name = edit.name();
            if history.apply(edit).is_err() || history.steps().0 == 0 {
                continue;
            }
            let after = history.document().clone();
            assert_eq!(history.undo().as_deref(), Some(name.as_str()), "the name of the step");
            assert_eq!(history.document(), &start, "{name} undone");
            history.redo();
            assert_eq!(history.document(), &after, "{name} redone");
        }
    }
}

#[test]
fn what_cannot_be_done_says_why_and_changes_nothing() {
    let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0, 4.0, 5.0]).unwrap();
    let mut document = with(curve(space, false));
    let before = document.clone();
    for (edit, message) in [
        (
            keep_curve(Edit::MoveDistinctKnot { object: CURVE, at: 4.0, to: 6.0 }),
            "the curve can be kept over its parameter interval [0, 4] only, not over [0, 6]",
        ),
        (keep_curve(Edit::Reverse { object: CURVE }), "\"Reverse\" does not change knots alone"),
        (
            keep_curve(keep_curve(Edit::MoveKnot { object: CURVE, knot: 5, to: 2.0 })),
            "\"Move knot to 2, curve kept\" does not change knots alone",
        ),
        (
            Edit::RemoveKnotsWithin { object: CURVE, tolerance: -1.0 },
            "the tolerance is -1; it must be positive",
        ),
        (
            Edit::RemoveKnotsWithin { object: CURVE, tolerance: f64::NAN },
            "the tolerance is NaN; it must be positive",
        ),
        (Edit::GenerateKnots { object: ObjectId(9), rule: KnotRule::Uniform }, "there is no object 9"),
    ] {
        let error = document.apply(&edit).unwrap_err();
        assert_eq!(error.to_string(), message, "{edit:?}");
        assert_eq!(document, before, "unchanged");
    }
    let coinciding = Nurbs::polynomial(SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap(), vec![DVec2::X; 5]);
    let error = with(coinciding.unwrap())
        .apply(&Edit::GenerateKnots { object: CURVE, rule: KnotRule::ChordLength })
        .unwrap_err();
    assert!(matches!(error, EditError::Spline(_)), "{error}");
}
