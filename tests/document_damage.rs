//! Damaged, truncated, newer and hostile files: an error that says where and what, never a panic, never another document.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use spline_lab::document::{
    Document, FileError, MAX_FILE_BYTES, View, first_scene, from_json, load, to_json,
};

/// A small file with everything in it.
fn small() -> String {
    let (mut document, view) = first_scene();
    let others: Vec<_> = document.objects().iter().skip(1).map(|object| object.id).collect();
    document.apply(&spline_lab::document::Edit::RemoveObjects { objects: others }).unwrap();
    to_json(&document, &view)
}

fn same(text: &str, original: &str) -> bool {
    from_json(text).is_ok_and(|saved| to_json(&saved.document, &saved.view) == original)
}

#[test]
fn a_file_cut_off_anywhere_is_refused_with_line_and_column() {
    let original = small();
    let whole = original.trim_end().len();
    for end in 0..original.len() {
        match from_json(&original[..end]) {
            Ok(_) => assert!(end >= whole && same(&original[..end], &original), "cut at {end} of {whole}"),
            Err(FileError::Syntax { line, column, message }) => {
                let expected = original[..end].lines().count().max(1);
                assert!(
                    line <= expected + 1 && line + 1 >= expected,
                    "cut at {end}: line {line}, {expected}"
                );
                let in_a_number = original[..end].ends_with(['-', '.', 'e']);
                let known =
                    message.contains("ends too early") || (in_a_number && message == "invalid number");
                assert!(known, "cut at {end}, column {column}: {message}");
            }
            // A number cut in two is a number; what is missing is then found to be missing.
            Err(error) => panic!("cut at {end}: {error}"),
        }
    }
}

#[test]
fn a_byte_overwritten_with_zero_or_garbage_never_gives_another_document() {
    let original = small();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.spline");
    for index in 0..original.len() {
        let mut bytes = original.clone().into_bytes();
        bytes[index] = 0;
        let text = String::from_utf8(bytes.clone()).unwrap();
        assert!(from_json(&text).is_err(), "zero at byte {index}");
        if index % 50 == 0 {
            bytes[index] = 0xFF;
            std::fs::write(&path, &bytes).unwrap();
            let error = load(&path).unwrap_err();
            assert_eq!(error.to_string(), format!("the file is not text: byte {index} is not UTF-8"), "0xFF");
        }
    }
    // A block that the disk lost.
    for start in (0..original.len()).step_by(37) {
        let end = (start + 64).min(original.len());
        let mut bytes = original.clone().into_bytes();
        bytes[start..end].fill(0);
        let text = String::from_utf8(bytes).unwrap();
        assert!(from_json(&text).is_err(), "zeros from byte {start}");
    }
}

#[test]
fn a_byte_replaced_by_any_other_never_panics_and_what_loads_is_valid() {
    let original = small();
    for index in 0..original.len() {
        for replacement in [b'0', b'9', b'-', b'e', b'"', b'}', b']', b',', b' ', b'\\'] {
            let mut bytes = original.clone().into_bytes();
            bytes[index] = replacement;
            let text = String::from_utf8(bytes).unwrap();
            if let Ok(saved) = from_json(&text) {
                let again = from_json(&to_json(&saved.document, &saved.view)).unwrap();
                assert_eq!(again, saved, "byte {index} replaced by {:?}", char::from(replacement));
            }
        }
    }
}

#[test]
fn a_newer_version_is_named_whatever_else_it_contains() {
    let text = "{\"format\": \"spline-lab\", \"version\": 7, \"surfaces\": [], \"objects\": \"elsewhere\"}";
    let error = from_json(text).unwrap_err();
    assert_eq!(error.to_string(), "newer version 7, this program reads up to 1", "message");
    let error = from_json("{\"format\": \"gpx\", \"version\": 1}").unwrap_err();
    assert_eq!(error.name(), "OtherFormat", "{error}");
}

/// A file with one curve, whose record is `fields`.
fn file(fields: &str) -> String {
    format!(
        "{{\"format\": \"spline-lab\", \"version\": 1, \"next_id\": 9, \"objects\": [{{\"id\": 1, \
         \"visible\": true, {fields}}}}}]}}"
    )
}

#[test]
fn impossible_values_are_named_with_their_place() {
    let line = "\"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1, 1]]";
    let cases = [
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}"), ""),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 0, {line}"), "objects[0].curve.degree: the degree must be at least 1"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 26, {line}"), "objects[0].curve.degree: degree 26 is above the limit 25"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": -1, {line}"), "objects[0].curve.degree (line 1"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1.5, {line}"), "objects[0].curve.degree (line 1"),
        (format!("\"name\": \" \", \"curve\": {{\"degree\": 1, {line}"), "objects[0].name: the name \" \" is empty"),
        (format!("\"name\": \"a\\nb\", \"curve\": {{\"degree\": 1, {line}"), "objects[0].name: "),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 2, {line}"), "objects[0].curve.knots: the knots make 1 B-splines"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"weights\": [1, 0]"), "objects[0].curve.weights[1]: weight 1 is 0; weights must be positive"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"weights\": [1, -2]"), "objects[0].curve.weights[1]: weight 1 is -2"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"weights\": [1]"), "objects[0].curve.weights: 1 weights given, 2 needed"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"weights\": [1, \"x\"]"), "objects[0].curve.weights[1] (line 1"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"period\": 0.5"), "objects[0].curve.period: the last knot 3"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"colour\": 3"), "objects[0].curve.colour (line 1"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"display\": {{\"width\": 0}}"), "objects[0].curve.display: width is 0; it must be from 0.01 to 100"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"display\": {{\"comb_teeth\": 4000000000}}"), "objects[0].curve.display: comb_teeth is 4000000000; it must be from 1 to 1000"),
        (format!("\"name\": \"L\", \"curve\": {{\"degree\": 1, {line}, \"display\": {{\"glow\": true}}"), "objects[0].curve.display.glow"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 0.5, 3], \"points\": [[0, 0], [1, 1]]".to_owned(), "objects[0].curve.knots[2]: knot 2 is 0.5, smaller than the knot 1"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1, 1e999]]".to_owned(), "line 1"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1, NaN]]".to_owned(), "line 1"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1]]".to_owned(), "objects[0].curve.points[1]"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 2, 3], \"points\": [[0, 0]]".to_owned(), "objects[0].curve.points: 1 coefficients given, 2 needed"),
        ("\"name\": \"L\", \"curve\": {\"degree\": 1, \"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1e308, 1]], \"weights\": [1, 1e10]".to_owned(), "objects[0].curve.points[1]: "),
    ];
    for (fields, expected) in cases {
        match from_json(&file(&fields)) {
            Ok(_) => assert_eq!(expected, "", "accepted {fields}"),
            Err(error) => {
                let message = error.to_string();
                assert!(
                    !expected.is_empty() && message.starts_with(expected),
                    "{fields}\n{message}\n{expected}"
                );
            }
        }
    }
}

#[test]
fn numbers_of_objects_are_unique_and_below_the_next_one() {
    let object = |id: &str| {
        format!(
            "{{\"id\": {id}, \"name\": \"L\", \"visible\": true, \"curve\": {{\"degree\": 1, \
             \"knots\": [0, 1, 2, 3], \"points\": [[0, 0], [1, 1]]}}}}"
        )
    };
    let file = |ids: [&str; 2], next: &str| {
        let (a, b) = (object(ids[0]), object(ids[1]));
        format!(
            "{{\"format\": \"spline-lab\", \"version\": 1, \"next_id\": {next}, \"objects\": [{a}, {b}]}}"
        )
    };
    assert!(from_json(&file(["1", "2"], "3")).is_ok(), "a good file");
    for (ids, next, expected) in [
        (["2", "2"], "3", "objects[1].id: 2 is the number of an earlier object too"),
        (["1", "3"], "3", "objects[1].id: 3 is not between 1 and 2, below next_id"),
        (["0", "1"], "3", "objects[0].id: 0 is not between 1 and 2"),
        (["1", "2"], "0", "next_id: 0 lies outside"),
        (["1", "2"], "18446744073709551615", "next_id: 18446744073709551615 lies outside"),
    ] {
        let message = from_json(&file(ids, next)).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}\n{expected}");
    }
}

#[test]
fn deep_nesting_and_huge_lists_end_in_an_error() {
    for text in
        ["[".repeat(1_000_000), "{\"a\":".repeat(1_000_000), format!("{{\"x\": {}", "[".repeat(1_000_000))]
    {
        let error = from_json(&text).unwrap_err();
        assert!(matches!(error, FileError::Syntax { .. } | FileError::Structure { .. }), "{}", error.name());
    }
    let view = format!(
        "{{\"format\": \"spline-lab\", \"version\": 1, \"next_id\": 1, \"objects\": [], \"view\": {{\"x\": {}{}}}}}",
        "[".repeat(100_000),
        "]".repeat(100_000)
    );
    // Nothing of it is kept, however deep.
    assert!(
        from_json(&view).is_ok_and(|saved| saved.document.is_empty()) || from_json(&view).is_err(),
        "no panic"
    );
    let points = "[0,0],".repeat(100_001);
    let knots = (0..100_003).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    let fields = format!(
        "\"name\": \"L\", \"curve\": {{\"degree\": 1, \"knots\": [{knots}], \"points\": [{}]",
        &points[..points.len() - 1]
    );
    let error = from_json(&file(&fields)).unwrap_err().to_string();
    assert_eq!(error, "objects[0].curve.points: 100001 points are above the limit 100000", "points");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.spline");
    std::fs::File::create(&path).unwrap().set_len(MAX_FILE_BYTES + 1).unwrap();
    assert_eq!(load(&path).unwrap_err().name(), "TooLarge", "a sparse file above the limit");
}

#[test]
fn only_the_view_may_hold_unknown_entries() {
    let text = "{\"format\": \"spline-lab\", \"version\": 1, \"next_id\": 1, \"objects\": [], \
                \"view\": {\"future\": {\"a\": [1]}, \"theme\": \"dark\"}}";
    assert_eq!(from_json(text).unwrap().view.theme, "dark", "known entries are read");
    let text = "{\"format\": \"spline-lab\", \"version\": 1, \"next_id\": 1, \"objects\": [], \"extra\": 0}";
    let message = from_json(text).unwrap_err().to_string();
    assert!(message.contains("extra") && message.contains("line 1"), "{message}");
    let text = text.replace("\"extra\": 0", "\"view\": {\"camera\": {\"scale\": 0}}");
    let message = from_json(&text).unwrap_err().to_string();
    assert!(message.starts_with("view.camera.scale: 0 is not positive"), "{message}");
    let after = format!("{}x", to_json(&Document::new(), &View::default()));
    assert_eq!(from_json(&after).unwrap_err().name(), "Syntax", "text behind the end");
}
