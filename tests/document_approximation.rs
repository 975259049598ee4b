//! Approximations in files: they come back as they were, and damage is named with its place.

use serde_json::{Value, json};
use spline_lab::document::{
    Approximation, Content, CubicEnds, Document, Edit, Method, PlotWindow, Preset, Scheme, View, from_json,
    to_json,
};

fn document_with(approximation: Approximation) -> Document {
    let mut document = Document::new();
    let content = Content::Approximation(approximation);
    document.apply(&Edit::AddObject { name: "Data".to_owned(), content }).expect("valid");
    document
}

#[test]
fn everything_comes_back_from_a_file() {
    for preset in Preset::ALL {
        let mut all = preset.build();
        if !all.is_empty() {
            all = all.with_weight(&[0], 0.1 + 0.2).expect("positive");
        }
        let ends = CubicEnds::SecondDerivatives { start: 1.0 / 3.0, end: -1e-300 };
        let hidden = Method { visible: false, ..Method::new(Scheme::Cubic { ends }, 7) };
        let document = document_with(all.with_method(hidden).expect("valid"));
        let mut view = View::default();
        let id = document.objects()[0].id;
        view.plots.insert(id, PlotWindow { x: [-1.5, 1e-9], y: [2.0, 3.0] });
        let saved = from_json(&to_json(&document, &view)).expect("it reads back");
        assert_eq!((saved.document, saved.view), (document, view), "{preset:?}");
    }
}

#[test]
fn damage_is_named_with_its_place() {
    let text = to_json(&document_with(Preset::NoisySine.build()), &View::default());
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    for (path, value, said) in [
        ("/points/3", json!([0.0, 1.0]), "objects[0].approximation.points[3]"),
        ("/weights", json!([1.0]), "objects[0].approximation.weights"),
        ("/function/formula", json!("sin(x"), "objects[0].approximation.function.formula"),
        ("/function/interval", json!([1.0, 0.0]), "objects[0].approximation.function.interval"),
        ("/methods/0/scheme/sigma", json!(2.0), "objects[0].approximation.methods[0]"),
        ("/methods/1/scheme/degree", json!(13), "objects[0].approximation.methods[1]"),
        ("/methods/1/scheme/knots", json!({ "inner": [0.5, 0.25] }), "objects[0].approximation.methods[1]"),
        ("/methods/1/scheme/kind", json!("magic"), "objects[0].approximation.methods[1]"),
        ("/error_plot", json!("wild"), "objects[0].approximation.error_plot"),
        ("/more", json!(1), "objects[0].approximation"),
    ] {
        let mut damaged = whole.clone();
        let record = &mut damaged["objects"][0]["approximation"];
        match record.pointer_mut(path) {
            Some(place) => *place = value,
            None => record[&path[1..]] = value,
        }
        let error = from_json(&damaged.to_string()).expect_err(path).to_string();
        assert!(error.contains(said), "{path}: {error}");
    }
}

#[test]
fn a_view_without_length_is_refused() {
    let document = document_with(Preset::Runge.build());
    let mut view = View::default();
    view.plots.insert(document.objects()[0].id, PlotWindow { x: [1.0, 1.0], y: [0.0, 1.0] });
    let error = from_json(&to_json(&document, &view)).expect_err("no range").to_string();
    assert!(error.contains("view.plots"), "{error}");
}
