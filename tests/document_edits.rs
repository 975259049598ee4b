//! What edits do to curves.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::{DMat2, DVec2};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{
    CurveDisplay, Document, Edit, EditError, ObjectId, Outcome, ShapeChange, first_scene,
};

const CURVE: ObjectId = ObjectId(1);

fn open_space() -> SplineSpace {
    SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0, 4.0, 5.0]).unwrap()
}

fn closed_space() -> SplineSpace {
    SplineSpace::periodic(3, 7.0, vec![0.0, 1.0, 2.0, 2.0, 4.5, 5.0, 6.0]).unwrap()
}

fn curve(space: SplineSpace, rational: bool) -> Nurbs<DVec2> {
    let count = space.dimension();
    let points = (0..count).map(|k| DVec2::from_angle(k as f64 * 0.9) * (1.0 + 0.2 * k as f64)).collect();
    let weights = (0..count).map(|k| if rational { 1.0 + 0.3 * (k % 3) as f64 } else { 1.0 }).collect();
    Nurbs::new(space, points, weights).unwrap()
}

fn with(curve: Nurbs<DVec2>) -> Document {
    let mut document = Document::new();
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: "Curve".to_owned(), curve, display }).unwrap();
    document
}

fn all() -> Vec<Nurbs<DVec2>> {
    let mut curves = Vec::new();
    for rational in [false, true] {
        curves.push(curve(open_space(), rational));
        curves.push(curve(closed_space(), rational));
        curves.push(curve(SplineSpace::new(2, (0..9).map(f64::from).collect()).unwrap(), rational));
        curves.push(curve(SplineSpace::new(1, (0..6).map(f64::from).collect()).unwrap(), rational));
    }
    curves
}

/// Largest distance at 200 equal parameters.
fn distance(a: &Nurbs<DVec2>, b: &Nurbs<DVec2>) -> f64 {
    let (left, right) = a.space().parameter_interval();
    (0..=200)
        .map(|i| left + (right - left) * f64::from(i) / 200.0)
        .map(|t| a.evaluate(t).unwrap().distance(b.evaluate(t).unwrap()))
        .fold(0.0, f64::max)
}

#[test]
fn edits_that_keep_the_shape_do_so_and_say_so() {
    for old in all() {
        let (left, right) = old.space().parameter_interval();
        let mut edits = vec![
            Edit::InsertKnot { object: CURVE, at: left + 0.37 * (right - left) },
            Edit::RefineUniformly { object: CURVE },
            Edit::ElevateDegree { object: CURVE },
        ];
        if old.space().is_periodic() {
            edits.push(Edit::SetClosed { object: CURVE, closed: false });
        }
        for edit in edits {
            let mut document = with(old.clone());
            let Outcome { shape, .. } = document.apply(&edit).unwrap();
            let new = document.curve(CURVE).unwrap();
            let found = distance(&old, new);
            let ShapeChange::Kept { deviation } = shape else { panic!("{edit:?}: {shape:?}") };
            assert!(found <= deviation, "{edit:?}: {found} is above the bound {deviation}");
            assert!(deviation < 1e-10, "{edit:?}: {deviation}");
        }
    }
}

#[test]
fn a_cut_curve_interpolates_its_ends() {
    for old in all().into_iter().filter(|curve| curve.space().is_periodic()) {
        let mut document = with(old);
        document.apply(&Edit::SetClosed { object: CURVE, closed: false }).unwrap();
        let new = document.curve(CURVE).unwrap();
        let (left, right) = new.space().parameter_interval();
        let (n, points) = (new.degree(), new.points());
        assert_eq!(new.space().multiplicity(left), n, "n-fold start");
        assert_eq!(new.space().multiplicity(right), n, "n-fold end");
        assert_eq!(points.first(), points.last(), "it still closes");
        assert!(points[0].distance(new.evaluate(left).unwrap()) < 1e-14, "first point");
    }
}

#[test]
fn removing_an_inserted_knot_gives_the_curve_back() {
    for old in all() {
        let (left, right) = old.space().parameter_interval();
        let at = left + 0.37 * (right - left);
        let mut document = with(old.clone());
        document.apply(&Edit::InsertKnot { object: CURVE, at }).unwrap();
        let outcome = document.apply(&Edit::RemoveKnot { object: CURVE, at }).unwrap();
        let new = document.curve(CURVE).unwrap();
        assert!(distance(&old, new) < 1e-10, "{:?} {}", outcome.shape, distance(&old, new));
    }
}

#[test]
fn changes_of_shape_are_bounded_by_the_deviation_they_report() {
    let mut measured = 0;
    for old in all() {
        let inner = old.space().distinct_knots()[1];
        for edit in [
            Edit::MoveDistinctKnot { object: CURVE, at: inner.value, to: inner.value + 0.2 },
            Edit::MoveKnot { object: CURVE, knot: inner.first, to: inner.value - 0.2 },
            Edit::RemoveKnot { object: CURVE, at: inner.value },
            Edit::ReduceDegree { object: CURVE },
            Edit::SetDegree { object: CURVE, degree: 2 },
            Edit::InsertPoint { object: CURVE, before: 2, position: DVec2::new(3.0, -3.0) },
            Edit::DeletePoints { object: CURVE, points: vec![2] },
        ] {
            let mut document = with(old.clone());
            let Ok(outcome) = document.apply(&edit) else { continue };
            if let ShapeChange::Changed { deviation: Some(deviation), at: Some(at) } = outcome.shape {
                let new = document.curve(CURVE).unwrap();
                let found = distance(&old, new);
                assert!(found <= deviation, "{edit:?}: {found} is above the bound {deviation}");
                let there = old.evaluate(at).unwrap().distance(new.evaluate(at).unwrap());
                assert!(there >= 0.8 * found, "{edit:?}: {there} at {at}, {found} elsewhere");
                measured += 1;
            }
        }
    }
    assert!(measured > 30, "{measured} deviations measured");
}

#[test]
fn a_reversed_curve_runs_backwards_through_the_same_points() {
    for old in all() {
        let mut document = with(old.clone());
        document.apply(&Edit::Reverse { object: CURVE }).unwrap();
        let new = document.curve(CURVE).unwrap();
        let (left, right) = old.space().parameter_interval();
        for i in 0..=50 {
            let s = f64::from(i) / 50.0 * (right - left);
            let (a, b) = (old.evaluate(left + s).unwrap(), new.evaluate(right - s).unwrap());
            assert!(a.distance(b) < 1e-12, "{a} forwards, {b} backwards, {s} from the end");
        }
    }
}

#[test]
fn both_conventions_of_multiple_end_knots_give_the_same_curve() {
    let old = curve(open_space(), true);
    let mut document = with(old.clone());
    let fourfold = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0, 4.0, 4.0];
    document.apply(&Edit::SetKnots { object: CURVE, knots: fourfold }).unwrap();
    assert_eq!(
        document.curve(CURVE),
        Some(&old),
        "knots {:?}",
        document.curve(CURVE).unwrap().space().knots()
    );
}

#[test]
fn a_knot_stops_at_its_neighbours() {
    let mut document = with(curve(open_space(), false));
    let before = document.clone();
    let error = document.apply(&Edit::MoveKnot { object: CURVE, knot: 5, to: 3.5 }).unwrap_err();
    assert_eq!(error, EditError::KnotBlocked { knot: 5, wanted: 3.5, low: 1.0, high: 3.0 }, "one copy");
    let error = document.apply(&Edit::MoveDistinctKnot { object: CURVE, at: 4.0, to: 2.0 }).unwrap_err();
    assert_eq!(
        error,
        EditError::KnotBlocked { knot: 7, wanted: 2.0, low: 3.0, high: f64::INFINITY },
        "the end"
    );
    assert_eq!(document, before, "unchanged");
    document.apply(&Edit::MoveDistinctKnot { object: CURVE, at: 4.0, to: 6.0 }).unwrap();
    let knots = document.curve(CURVE).unwrap().space().knots();
    assert_eq!(knots, [-1.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 6.0, 6.0, 6.0, 7.0], "the outer knot moves along");
    document.apply(&Edit::MoveDistinctKnot { object: CURVE, at: 0.0, to: -2.0 }).unwrap();
    let knots = document.curve(CURVE).unwrap().space().knots();
    assert_eq!(knots[..5], [-3.0, -2.0, -2.0, -2.0, 1.0], "at the left end too");
}

#[test]
fn an_appended_point_leaves_the_pieces_far_away() {
    for old in all().into_iter().filter(|curve| !curve.space().is_periodic()) {
        let mut document = with(old.clone());
        let position = DVec2::new(9.0, 9.0);
        document.apply(&Edit::AppendPoint { object: CURVE, position }).unwrap();
        let new = document.curve(CURVE).unwrap();
        assert_eq!(new.points().len(), old.points().len() + 1, "one more");
        assert_eq!(new.points().last(), Some(&position), "at the end");
        let (left, right) = old.space().parameter_interval();
        assert!(new.space().parameter_interval().1 > right, "the interval grows");
        let quarter = left + 0.05 * (right - left);
        let (a, b) = (old.evaluate(quarter).unwrap(), new.evaluate(quarter).unwrap());
        assert!(a.distance(b) < 1e-13, "{a} and {b} at {quarter}");
    }
}

#[test]
fn points_can_be_inserted_everywhere_and_deleted_until_the_curve_is_gone() {
    for old in all() {
        for before in 0..=old.points().len() {
            let mut document = with(old.clone());
            let position = DVec2::new(0.5, -7.0);
            document.apply(&Edit::InsertPoint { object: CURVE, before, position }).unwrap();
            let new = document.curve(CURVE).unwrap();
            assert_eq!(new.points()[before], position, "the new point has index {before}");
            assert_eq!(new.degree(), old.degree(), "the degree stays");
            assert_eq!(new.space().is_periodic(), old.space().is_periodic(), "closed stays closed");
            let mut rest = new.points().to_vec();
            rest.remove(before);
            assert_eq!(rest, old.points(), "the others stay");
        }
        let mut document = with(old.clone());
        let mut kept = old.points().to_vec();
        while let Some(curve) = document.curve(CURVE) {
            assert_eq!(curve.points(), kept, "what remains");
            let index = kept.len() / 2;
            kept.remove(index);
            document.apply(&Edit::DeletePoints { object: CURVE, points: vec![index] }).unwrap();
        }
        assert_eq!(kept.len(), 1, "with one point left the object goes");
        assert!(document.is_empty(), "gone");
    }
}

#[test]
fn a_failing_batch_leaves_nothing_behind() {
    let mut document = with(curve(open_space(), false));
    let before = document.clone();
    let edits = vec![
        Edit::SetWeight { object: CURVE, point: 0, weight: 2.0 },
        Edit::DuplicateObject { object: CURVE },
        Edit::SetWeight { object: CURVE, point: 3, weight: -1.0 },
    ];
    let error = document.apply(&Edit::Batch { label: "Three".to_owned(), edits }).unwrap_err();
    assert_eq!(error.to_string(), "step 2 of the batch: weight 3 is -1; weights must be positive", "message");
    assert_eq!(error.name(), "WeightNotPositive", "name");
    assert_eq!(document, before, "unchanged");
    let mut deep = Edit::RefineUniformly { object: CURVE };
    for _ in 0..200 {
        deep = Edit::Batch { label: "Deep".to_owned(), edits: vec![deep] };
    }
    assert!(document.apply(&deep).is_err(), "200 batches within each other");
}

#[test]
fn impossible_edits_name_what_is_wrong() {
    let mut document = with(curve(open_space(), false));
    let nan = f64::NAN;
    for (edit, expected) in [
        (Edit::SetPoint { object: ObjectId(7), point: 0, position: DVec2::ZERO }, "there is no object 7"),
        (
            Edit::SetPoint { object: CURVE, point: 7, position: DVec2::ZERO },
            "object 1 has no point 7; its 7 points are numbered from 0",
        ),
        (
            Edit::SetPoint { object: CURVE, point: 0, position: DVec2::new(0.0, nan) },
            "the position is NaN, not a finite number",
        ),
        (
            Edit::MovePoints { object: CURVE, points: vec![], delta: DVec2::INFINITY },
            "the displacement is inf, not a finite number",
        ),
        (
            Edit::TransformPoints { object: CURVE, points: vec![0], matrix: DMat2::NAN, about: DVec2::ZERO },
            "the matrix is NaN, not a finite number",
        ),
        (Edit::SetWeight { object: CURVE, point: 2, weight: 0.0 }, "weight 2 is 0; weights must be positive"),
        (Edit::InsertKnot { object: CURVE, at: 9.0 }, "9 lies outside [0, 4]"),
        (Edit::MoveCurveAt { object: CURVE, at: 9.0, delta: DVec2::X }, "9 lies outside [0, 4]"),
        (
            Edit::MoveCurveAt { object: CURVE, at: 1.0, delta: DVec2::NAN },
            "the displacement is NaN, not a finite number",
        ),
        (
            Edit::MoveEditPoint { object: CURVE, point: 9, delta: DVec2::X },
            "object 1 has no point 9; its 7 points are numbered from 0",
        ),
        (Edit::RemoveKnot { object: CURVE, at: 0.7 }, "0.7 is not a knot of object 1"),
        (
            Edit::MoveKnot { object: CURVE, knot: 11, to: 0.0 },
            "object 1 has no knot 11; its 11 knots are numbered from 0",
        ),
        (Edit::MoveKnot { object: CURVE, knot: 5, to: nan }, "the knot is NaN, not a finite number"),
        (Edit::MoveDistinctKnot { object: CURVE, at: nan, to: 0.0 }, "NaN is not a knot of object 1"),
        (Edit::SetDegree { object: CURVE, degree: 13 }, "degree 13 lies outside 1 to 12"),
        (Edit::SetDegree { object: CURVE, degree: 7 }, "7 control points given, 8 needed"),
        (
            Edit::RenameObject { object: CURVE, name: "a\nb".to_owned() },
            "the name \"a\\nb\" contains a line break or another control character",
        ),
        (
            Edit::ReorderObject { object: CURVE, to: 1 },
            "position 1 does not exist; the document has 1 objects",
        ),
        (
            Edit::InsertPoint { object: CURVE, before: 8, position: DVec2::ZERO },
            "object 1 has no point 8; its 7 points are numbered from 0",
        ),
    ] {
        let before = document.clone();
        let error = document.apply(&edit).unwrap_err();
        assert_eq!(error.to_string(), expected, "{edit:?}");
        assert_eq!(document, before, "{edit:?} changed something");
    }
}

#[test]
fn a_copy_stands_above_its_original_under_a_new_name() {
    let (mut document, _) = first_scene();
    let first = document.objects()[0].id;
    let created = document.apply(&Edit::DuplicateObject { object: first }).unwrap().created;
    let again = document.apply(&Edit::DuplicateObject { object: created[0] }).unwrap().created;
    let names: Vec<&str> = document.objects().iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["Circle", "Circle 2", "Circle 3", "Pebble", "Wave"], "drawing order");
    assert_eq!(document.objects()[2].id, again[0], "new numbers");
    assert!(again[0] > created[0] && created[0] > first, "ascending");
}

#[test]
fn the_first_scene_is_whole_and_within_its_frame() {
    let (document, view) = first_scene();
    assert_eq!(document.len(), 3, "three curves");
    let (low, high) = document.bounding_box().unwrap();
    assert!(
        low.cmpge(DVec2::new(-6.0, -4.0)).all() && high.cmple(DVec2::new(6.0, 4.0)).all(),
        "{low} {high}"
    );
    let (&object, &t) = view.parameters.iter().next().unwrap();
    assert!(document.curve(object).unwrap().evaluate(t).is_ok(), "t = {t} can be shown");
    let circle = document.curve(document.objects()[0].id).unwrap();
    for i in 0..40 {
        let point = circle.evaluate(f64::from(i) / 10.0).unwrap();
        let radius = point.distance(DVec2::new(3.8, -2.2));
        assert!((radius - 1.1).abs() < 1e-14, "radius {radius} at {}", f64::from(i) / 10.0);
    }
}

#[test]
fn names_for_the_undo_menu() {
    let object = CURVE;
    for (edit, name) in [
        (Edit::MovePoints { object, points: vec![0, 1, 2], delta: DVec2::ZERO }, "Move 3 points"),
        (Edit::MovePoints { object, points: vec![4], delta: DVec2::ZERO }, "Move point"),
        (Edit::InsertKnot { object, at: 0.5 }, "Insert knot 0.5"),
        (Edit::InsertKnot { object, at: 1.0 / 3.0 }, "Insert knot 0.3333"),
        (Edit::InsertKnot { object, at: -1e-9 }, "Insert knot -1.0e-9"),
        (Edit::SetWeight { object, point: 2, weight: 3.0 }, "Set weight 2 to 3"),
        (Edit::SetClosed { object, closed: true }, "Close curve"),
        (Edit::MoveCurveAt { object, at: 0.5, delta: DVec2::X }, "Drag curve"),
        (Edit::MoveEditPoint { object, point: 2, delta: DVec2::X }, "Move edit point 2"),
    ] {
        assert_eq!(edit.name(), name, "{edit:?}");
    }
}
