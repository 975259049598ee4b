//! Writing a document and reading it again changes no bit of it.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::DVec2;
use proptest::prelude::*;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{
    CurveDisplay, Document, Edit, Object, PointLabels, View, first_scene, from_json, load, save, to_json,
};

/// Any number of moderate size, or one that is easily spoilt.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => any::<f64>().prop_filter("finite", |x| x.is_finite() && x.abs() < 1e150),
        2 => -10.0..10.0_f64,
        1 => prop::sample::select(vec![0.0, -0.0, 1e-308, 5e-324, 1e300, -1e300, 0.1, 1.0 / 3.0, 9007199254740993.0]),
    ]
}

fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1.0), 1e-3..1e3_f64, Just(1e-308), Just(5e-324), Just(0.1)]
}

fn curve() -> impl Strategy<Value = Nurbs<DVec2>> {
    (1..6_usize, 1..9_usize, any::<bool>(), any::<bool>()).prop_flat_map(
        |(degree, more, closed, rational)| {
            let count = degree + more;
            let steps = prop::collection::vec(1e-3..5.0_f64, count + degree + 1);
            let points = prop::collection::vec((coordinate(), coordinate()), count);
            let weights =
                prop::collection::vec(if rational { weight().boxed() } else { Just(1.0).boxed() }, count);
            (steps, points, weights, -1e3..1e3_f64).prop_map(move |(steps, points, weights, start)| {
                let knots: Vec<f64> = steps
                    .iter()
                    .scan(start, |knot, step| {
                        *knot += step;
                        Some(*knot)
                    })
                    .collect();
                let space = if closed {
                    let length = knots[count - 1] - knots[0] + 0.7;
                    SplineSpace::periodic(degree, length, knots[..count].to_vec())
                } else {
                    SplineSpace::new(degree, knots)
                };
                let points = points.into_iter().map(DVec2::from).collect();
                Nurbs::new(space.unwrap(), points, weights).unwrap()
            })
        },
    )
}

fn display() -> impl Strategy<Value = CurveDisplay> {
    let labels = prop::sample::select(vec![
        PointLabels::None,
        PointLabels::Index,
        PointLabels::Weight,
        PointLabels::Coordinates,
    ]);
    (
        0..20_usize,
        0.01..100.0_f64,
        labels,
        any::<[bool; 8]>(),
        any::<[bool; 10]>(),
        any::<f64>(),
        1..1000_usize,
    )
        .prop_map(|(color, width, labels, flags, more, comb_scale, comb_teeth)| {
            let [polygon, points, knots, comb, construction, hull, osculating_circle, pieces] = flags;
            let [frame, hodograph, bezier_points, blossom_labels, distance_tube, more @ ..] = more;
            let [inflections, vertices, symmetry, probe_line, has_probe] = more;
            let probe = has_probe.then_some([DVec2::new(width, comb_scale.clamp(-1e9, 1e9)), DVec2::X]);
            let comb_scale = if comb_scale.is_finite() { comb_scale } else { 1.0 };
            CurveDisplay {
                color,
                width,
                polygon,
                points,
                labels,
                knots,
                comb,
                comb_scale,
                comb_teeth,
                construction,
                hull,
                osculating_circle,
                pieces,
                frame,
                hodograph,
                bezier_points,
                blossom_labels,
                distance_tube,
                inflections,
                vertices,
                symmetry,
                probe_line,
                probe,
            }
        })
}

fn bits(curve: &Nurbs<DVec2>) -> Vec<u64> {
    let points = curve.points().iter().flat_map(|point| point.to_array());
    let numbers = points.chain(curve.weights().iter().copied()).chain(curve.space().knots().iter().copied());
    numbers.chain(curve.space().period()).map(f64::to_bits).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn every_bit_comes_back(
        objects in prop::collection::vec((curve(), display(), any::<bool>(), "[^\\p{C}]{1,20}x"), 0..4),
        removed in any::<bool>(),
    ) {
        let mut document = Document::new();
        for (curve, display, visible, name) in objects {
            let made = document.apply(&Edit::AddCurve { name, curve, display }).unwrap().created;
            document.apply(&Edit::SetVisible { object: made[0], visible }).unwrap();
        }
        if let (true, Some(first)) = (removed, document.objects().first().map(|object| object.id)) {
            document.apply(&Edit::RemoveObjects { objects: vec![first] }).unwrap();
        }
        let text = to_json(&document, &View::default());
        let again = from_json(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?.document;
        prop_assert_eq!(&again, &document, "{}", text);
        for (a, b) in again.objects().iter().zip(document.objects()) {
            prop_assert_eq!(bits(a.curve().unwrap()), bits(b.curve().unwrap()), "{}", text);
            let scale = |object: &Object| object.curve_display().unwrap().comb_scale.to_bits();
            prop_assert_eq!(scale(a), scale(b), "comb scale");
        }
        prop_assert_eq!(to_json(&again, &View::default()), text, "the same text again");
    }
}

#[test]
fn the_first_scene_comes_back_from_the_disk_with_its_view() {
    let (document, mut view) = first_scene();
    view.panels.insert("knot line".to_owned(), true);
    view.selected_points = vec![1, 2];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("first.spline");
    save(&path, &document, &view).unwrap();
    save(&path, &document, &view).unwrap();
    let saved = load(&path).unwrap();
    assert_eq!(saved.document, document, "the data");
    assert_eq!(saved.view, view, "the view");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no file is left beside it");
}

#[test]
fn a_view_with_impossible_numbers_does_not_make_the_file_unreadable() {
    let (document, mut view) = first_scene();
    view.camera.center.x = f64::NAN;
    for parameter in view.parameters.values_mut() {
        *parameter = f64::INFINITY;
    }
    let saved = from_json(&to_json(&document, &view)).unwrap();
    assert_eq!(saved.document, document, "the data");
    assert_eq!(saved.view.camera.center, DVec2::ZERO, "the default");
    assert!(saved.view.parameters.is_empty(), "left out");
}

#[test]
fn the_text_has_one_point_a_line_and_its_keys_in_order() {
    let space = SplineSpace::new(1, vec![0.0, 1.0, 2.0, 3.0]).unwrap();
    let curve = Nurbs::polynomial(space, vec![DVec2::new(0.0, 0.5), DVec2::new(1.0, -0.0)]).unwrap();
    let mut document = Document::new();
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: "Edge".to_owned(), curve, display }).unwrap();
    let text = to_json(&document, &View::default());
    let expected = r#"{
  "format": "spline-lab",
  "version": 1,
  "objects": [
    {
      "id": 1,
      "name": "Edge",
      "visible": true,
      "curve": {
        "degree": 1,
        "knots": [0.0, 1.0, 2.0, 3.0],
        "points": [
          [0.0, 0.5],
          [1.0, -0.0]
        ],
        "display": {"#;
    assert!(text.starts_with(expected), "{text}");
}

#[cfg(unix)]
#[test]
fn saving_follows_links_and_keeps_permissions() {
    use std::os::unix::fs::PermissionsExt as _;
    let (document, view) = first_scene();
    let folder = tempfile::tempdir().unwrap();
    let (path, link) = (folder.path().join("scene.spline"), folder.path().join("link.spline"));
    save(&path, &document, &view).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink(&path, &link).unwrap();
    save(&link, &Document::new(), &view).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink(), "the link is still one");
    assert!(load(&path).unwrap().document.is_empty(), "written through the link");
    let mode = std::fs::metadata(&path).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode, 0o640, "permissions {mode:o}");
}

#[test]
fn saving_into_a_folder_that_does_not_exist_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("missing").join("a.spline");
    let error = save(&path, &Document::new(), &View::default()).unwrap_err();
    assert!(error.to_string().starts_with("cannot write "), "{error}");
    let error = load(&path).unwrap_err();
    assert!(error.to_string().starts_with("cannot open "), "{error}");
}
