//! Operations on whole curves: what stays, what is certified, what is refused, and that undo takes everything back.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::DVec2;
use spline_lab::core::bspline::{EndKnots, SplineSpace};
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{
    CurveDisplay, CurveMap, Document, Edit, EditError, History, ObjectId, Outcome, ShapeChange,
};

const CURVE: ObjectId = ObjectId(1);
const OTHER: ObjectId = ObjectId(2);

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
        for degree in 1..=12 {
            let count = degree + 5;
            let breaks: Vec<f64> = (0..count - degree + 1).map(|k| (k * (k + 3)) as f64 / 4.0).collect();
            for ends in [EndKnots::Interpolating, EndKnots::Simple] {
                curves.push(curve(SplineSpace::from_breaks(degree, &breaks, ends).unwrap(), rational));
            }
            let knots: Vec<f64> = (0..count).map(|k| k as f64 + 0.3 * (k % 2) as f64).collect();
            curves.push(curve(SplineSpace::periodic(degree, count as f64, knots).unwrap(), rational));
        }
    }
    curves
}

fn with(curves: impl IntoIterator<Item = Nurbs<DVec2>>) -> History {
    let mut document = Document::new();
    for curve in curves {
        let display = CurveDisplay::default();
        document.apply(&Edit::AddCurve { name: "Curve".to_owned(), curve, display }).unwrap();
    }
    History::new(document)
}

/// Carries `edit` out, looks whether undo and redo give the same documents, and gives what it did.
fn done(history: &mut History, edit: Edit) -> Outcome {
    let before = history.document().clone();
    let name = edit.name();
    let outcome = history.apply(edit).unwrap();
    let after = history.document().clone();
    if after.objects() == before.objects() {
        // Nothing to do, as for the Bezier form of a polygon.
        return outcome;
    }
    assert_eq!(history.undo().as_deref(), Some(name.as_str()), "the name of the step");
    assert_eq!(history.document().objects(), before.objects(), "{name}: undone exactly");
    history.redo();
    assert_eq!(history.document().objects(), after.objects(), "{name}: redone exactly");
    outcome
}

fn refused(history: &mut History, edit: Edit) -> EditError {
    let before = history.document().clone();
    let error = history.apply(edit).unwrap_err();
    assert_eq!(history.document().objects(), before.objects(), "nothing is left of an edit that fails");
    error
}

/// Largest distance at equal parameters of the part to the whole, whose parameters repeat if it is closed.
fn distance(part: &Nurbs<DVec2>, whole: &Nurbs<DVec2>) -> f64 {
    let (left, right) = part.space().parameter_interval();
    let (low, high) = whole.space().parameter_interval();
    (0..=100)
        .map(|i| left + (right - left) * f64::from(i) / 100.0)
        .map(|t| {
            let inside = if t > high && whole.space().is_periodic() { t - (high - low) } else { t.min(high) };
            part.evaluate(t.min(right)).unwrap().distance(whole.evaluate(inside).unwrap())
        })
        .fold(0.0, f64::max)
}

fn assert_kept(outcome: &Outcome) {
    match outcome.shape {
        ShapeChange::Kept { deviation } => assert!(deviation < 1e-10, "certified {deviation}"),
        other => panic!("{other:?} says not that the shape is kept"),
    }
}

fn inside(curve: &Nurbs<DVec2>, share: f64) -> f64 {
    let (left, right) = curve.space().parameter_interval();
    left + share * (right - left)
}

#[test]
fn splitting_keeps_both_parts_and_opens_closed_curves() {
    for old in all() {
        let mut history = with([old.clone()]);
        let at = inside(&old, 0.37);
        let outcome = done(&mut history, Edit::SplitCurve { object: CURVE, at });
        assert_kept(&outcome);
        let first = history.document().curve(CURVE).unwrap();
        assert!(distance(first, &old) < 1e-11, "degree {}: the first part", old.degree());
        if old.space().is_periodic() {
            assert!(outcome.created.is_empty() && !first.space().is_periodic(), "cut open");
            assert_eq!(first.space().parameter_interval().0.to_bits(), at.to_bits(), "at t");
        } else {
            assert_eq!(outcome.created, [OTHER], "a second object");
            let second = history.document().curve(OTHER).unwrap();
            assert!(distance(second, &old) < 1e-11, "degree {}: the second part", old.degree());
            assert_eq!(history.document().objects()[1].id, OTHER, "above the first");
            let (left, right) = old.space().parameter_interval();
            assert_eq!(first.space().parameter_interval(), (left, at), "before t");
            assert_eq!(second.space().parameter_interval(), (at, right), "behind t");
        }
    }
}

#[test]
fn joining_undoes_splitting_whatever_the_directions() {
    for old in all().into_iter().filter(|curve| !curve.space().is_periodic()) {
        for turned in [vec![], vec![CURVE], vec![OTHER], vec![CURVE, OTHER]] {
            let mut history = with([old.clone()]);
            done(&mut history, Edit::SplitCurve { object: CURVE, at: inside(&old, 0.5) });
            for &object in &turned {
                done(&mut history, Edit::Reverse { object });
            }
            let outcome = done(&mut history, Edit::JoinCurves { object: CURVE, other: OTHER });
            assert_eq!(history.document().len(), 1, "one object remains");
            let whole = history.document().curve(CURVE).unwrap();
            let nearest = |curve: &Nurbs<DVec2>, place| curve.closest_point(place).unwrap().distance;
            for i in 0..=10 {
                let place = old.evaluate(inside(&old, f64::from(i) / 10.0)).unwrap();
                assert!(nearest(whole, place) < 1e-8, "degree {}, {turned:?}", old.degree());
            }
            // Other ends may be nearer: those of a curve whose ends happen to meet.
            assert_kept(&outcome);
        }
    }
}

#[test]
fn a_gap_is_closed_in_its_middle_and_costs_half_of_it() {
    let line = |from: [f64; 2], to: [f64; 2], degree| {
        let space = SplineSpace::from_breaks(degree, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let (from, to) = (DVec2::from(from), DVec2::from(to));
        Nurbs::polynomial(space, (0..=degree).map(|k| from.lerp(to, k as f64 / degree as f64)).collect())
            .unwrap()
    };
    let mut history = with([line([0.0, 0.0], [1.0, 0.0], 1), line([3.0, 1.0], [1.0, 0.5], 3)]);
    let outcome = done(&mut history, Edit::JoinCurves { object: CURVE, other: OTHER });
    let whole = history.document().curve(CURVE).unwrap();
    assert_eq!(whole.degree(), 3, "the higher degree");
    assert!(whole.evaluate(0.0).unwrap().distance(DVec2::ZERO) < 1e-14, "the first one keeps its direction");
    assert!(whole.evaluate(1.0).unwrap().distance(DVec2::new(1.0, 0.25)) < 1e-14, "the middle of the gap");
    match outcome.shape {
        ShapeChange::Changed { deviation: Some(deviation), .. } => {
            assert!((0.25..0.2501).contains(&deviation), "{deviation}");
        }
        other => panic!("{other:?}"),
    }
    let mut history = with([line([0.0, 0.0], [1.0, 0.0], 1), Nurbs::circle(DVec2::ZERO, 1.0).unwrap()]);
    let error = refused(&mut history, Edit::JoinCurves { object: CURVE, other: OTHER });
    assert_eq!(error, EditError::NoEnds { object: OTHER }, "closed curves have no ends");
    let error = refused(&mut history, Edit::JoinCurves { object: CURVE, other: CURVE });
    assert_eq!(error, EditError::JoinedWithItself { object: CURVE }, "with itself");
    let error = refused(&mut history, Edit::JoinCurves { object: CURVE, other: ObjectId(9) });
    assert_eq!(error, EditError::NoSuchObject { object: ObjectId(9) }, "with nothing");
}

#[test]
fn trimming_keeps_the_part_also_across_the_seam() {
    for old in all() {
        let closed = old.space().is_periodic();
        let (from, to) = if closed {
            (inside(&old, 0.7), inside(&old, 1.2))
        } else {
            (inside(&old, 0.2), inside(&old, 0.9))
        };
        let mut history = with([old.clone()]);
        let outcome = done(&mut history, Edit::TrimCurve { object: CURVE, from, to });
        assert_kept(&outcome);
        let part = history.document().curve(CURVE).unwrap();
        assert!(distance(part, &old) < 1e-11, "degree {}", old.degree());
        assert!((part.space().parameter_interval().1 - to).abs() < 1e-12, "to the end asked for");
        assert_eq!(history.document().len(), 1, "no new object");
    }
}

#[test]
fn places_outside_are_refused_with_their_value() {
    let old = all()[3].clone();
    let (left, right) = old.space().parameter_interval();
    let mut history = with([old]);
    for at in [left, right, right + 1.0, f64::NAN] {
        let error = refused(&mut history, Edit::SplitCurve { object: CURVE, at });
        let wanted = if at.is_nan() { "NonFinite" } else { "OutsideInterval" };
        assert_eq!(error.name(), wanted, "split at {at}");
        assert!(error.to_string().contains(&format!("{at}")), "{error}");
    }
    let error = refused(&mut history, Edit::TrimCurve { object: CURVE, from: 1.5, to: 1.5 });
    assert_eq!(error.name(), "EmptyInterval", "nothing would remain");
    let error = refused(&mut history, Edit::TrimCurve { object: CURVE, from: left, to: right + 0.5 });
    assert_eq!(error.name(), "OutsideInterval", "beyond the end");
}

#[test]
fn bezier_form_and_interpolated_ends_keep_the_shape() {
    for old in all() {
        let mut history = with([old.clone()]);
        assert_kept(&done(&mut history, Edit::ToBezierForm { object: CURVE }));
        let new = history.document().curve(CURVE).unwrap().clone();
        assert!(distance(&new, &old) < 1e-11, "degree {}", old.degree());
        let n = old.degree();
        assert!(new.space().breaks().iter().all(|&knot| new.space().multiplicity(knot) == n), "n-fold knots");
        let pieces = old.space().breaks().len() - 1;
        let closed = old.space().is_periodic();
        assert_eq!(
            new.points().len(),
            pieces * n + usize::from(!closed),
            "the points of {pieces} Bezier curves"
        );
        assert_eq!(new.space().is_periodic(), closed, "closed curves stay closed");

        let mut history = with([old.clone()]);
        if closed {
            let error = refused(&mut history, Edit::InterpolateEnds { object: CURVE });
            assert_eq!(error, EditError::NoEnds { object: CURVE }, "closed");
            continue;
        }
        assert_kept(&done(&mut history, Edit::InterpolateEnds { object: CURVE }));
        let new = history.document().curve(CURVE).unwrap();
        assert!(distance(new, &old) < 1e-11, "degree {}", old.degree());
        let (left, right) = new.space().parameter_interval();
        assert_eq!((new.space().multiplicity(left), new.space().multiplicity(right)), (n, n), "n-fold ends");
        assert_eq!(new.points().len(), old.points().len(), "no points more");
    }
}

#[test]
fn affine_maps_map_every_point_of_the_curve() {
    let about = DVec2::new(1.0, -2.0);
    type Map = fn(DVec2) -> DVec2;
    let maps: [(CurveMap, Map, &str); 5] = [
        (CurveMap::Move { by: DVec2::new(3.0, 0.5) }, |p| p + DVec2::new(3.0, 0.5), "Move by (3, 0.5)"),
        (CurveMap::Rotate { degrees: 90.0, about }, |p| DVec2::new(-1.0 - p.y, p.x - 3.0), "Rotate by 90°"),
        (
            CurveMap::Scale { factors: DVec2::new(2.0, -1.0), about },
            |p| DVec2::new(2.0 * p.x - 1.0, -4.0 - p.y),
            "Scale by (2, -1)",
        ),
        (CurveMap::Scale { factors: DVec2::splat(0.5), about: DVec2::ZERO }, |p| 0.5 * p, "Scale by 0.5"),
        (
            CurveMap::Mirror { degrees: 45.0, through: DVec2::ZERO },
            |p| DVec2::new(p.y, p.x),
            "Mirror in a line at 45°",
        ),
    ];
    for old in all() {
        for (map, wanted, name) in maps {
            let edit = Edit::TransformCurve { object: CURVE, map };
            assert_eq!(edit.name(), name, "the name in the Undo menu");
            let mut history = with([old.clone()]);
            done(&mut history, edit);
            let new = history.document().curve(CURVE).unwrap();
            assert_eq!((new.space(), new.weights()), (old.space(), old.weights()), "knots and weights stay");
            for i in 0..=20 {
                let t = inside(&old, f64::from(i) / 20.0);
                let error = new.evaluate(t).unwrap().distance(wanted(old.evaluate(t).unwrap()));
                assert!(error < 1e-11, "{name} at {t}: {error}");
            }
        }
    }
    let mut history = with([all()[0].clone()]);
    let scale = |x| CurveMap::Scale { factors: DVec2::new(x, 1.0), about };
    let error = refused(&mut history, Edit::TransformCurve { object: CURVE, map: scale(0.0) });
    assert_eq!(error, EditError::FactorZero { value: 0.0 }, "flat");
    for map in [
        scale(f64::NAN),
        CurveMap::Rotate { degrees: f64::INFINITY, about },
        CurveMap::Move { by: DVec2::NAN },
    ] {
        let error = refused(&mut history, Edit::TransformCurve { object: CURVE, map });
        assert_eq!(error.name(), "NonFinite", "{map:?}");
    }
}

#[test]
fn an_offset_is_a_new_curve_with_its_measured_deviation() {
    let circle = Nurbs::circle(DVec2::ONE, 2.0).unwrap();
    let mut history = with([circle.clone()]);
    let outcome = done(&mut history, Edit::OffsetCurve { object: CURVE, distance: -0.5, tolerance: 1e-4 });
    match outcome.shape {
        ShapeChange::Approximated { deviation } => {
            assert!(deviation > 0.0 && deviation <= 1e-4, "{deviation}");
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(history.document().curve(CURVE), Some(&circle), "the original stays");
    let new = history.document().curve(outcome.created[0]).unwrap();
    assert!(new.space().is_periodic(), "closed as the original");
    for i in 0..=100 {
        let radius = new.evaluate(inside(new, f64::from(i) / 100.0)).unwrap().distance(DVec2::ONE);
        assert!((radius - 2.5).abs() <= 1e-4, "{radius}");
    }
    let error = refused(&mut history, Edit::OffsetCurve { object: CURVE, distance: 2.5, tolerance: 1e-4 });
    assert_eq!(error.name(), "Degenerate", "inside the centre of curvature");
    let error = refused(&mut history, Edit::OffsetCurve { object: CURVE, distance: 0.5, tolerance: -1.0 });
    assert_eq!(error.name(), "InvalidTolerance", "no tolerance");
    assert!(error.to_string().contains("-1"), "{error}");
}
