//! The file format: JSON with a version number.
//!
//! ```text
//! {"format": "spline-lab", "version": 1,
//!  "objects": [{"id": 1, "kind": "curve", "name": "Wave", "visible": true, "degree": 3, "knots": […],
//!               "period": T (closed curves only), "points": [[x, y], …], "weights": […] (unless all are 1), "display": {…}}],
//!  "next_id": 2, "view": {…}}
//! ```
//!
//! Numbers are written in the shortest form that reads back as the same number. Unknown keys are refused, except in `view`:
//! data that this program does not understand would be lost with the next save.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec2;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::spline_curve::Nurbs;
use crate::document::apply::{MAX_ID, MAX_OBJECTS, MAX_POINTS, check_name};
use crate::document::contents::Document;
use crate::document::display::CurveDisplay;
use crate::document::eye::EyeError;
use crate::document::file_error::FileError;
use crate::document::json_writer::Node;
use crate::document::object::{Content, Object, ObjectId};
use crate::document::storage::check_size;
use crate::document::view::{Saved, View};

/// The version that [`to_json`] writes and the highest that [`from_json`] reads.
pub const FORMAT_VERSION: u32 = 1;
/// The file name's extension, without the dot.
pub const EXTENSION: &str = "spline";

const FORMAT: &str = "spline-lab";

/// Only what decides whether the rest can be understood.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileRecord {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: u64,
    objects: Vec<ObjectRecord>,
    next_id: u64,
    #[serde(default)]
    view: View,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectRecord {
    id: u64,
    #[serde(rename = "kind")]
    _kind: Kind,
    name: String,
    visible: bool,
    degree: usize,
    knots: Vec<f64>,
    #[serde(default)]
    period: Option<f64>,
    points: Vec<[f64; 2]>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    #[serde(default)]
    display: CurveDisplay,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Curve,
}

/// The text of a file.
///
/// Infinite numbers and NaN in the view, which JSON cannot hold, are left out and read back as defaults.
pub fn to_json(document: &Document, view: &View) -> String {
    let objects = document.objects().iter().map(|object| object_node(object)).collect();
    Node::Record(vec![
        entry("format", json!(FORMAT)),
        entry("version", json!(FORMAT_VERSION)),
        ("objects".to_owned(), Node::List(objects)),
        entry("next_id", json!(document.made + 1)),
        ("view".to_owned(), view_node(view)),
    ])
    .to_text()
}

/// Reads the text of a file.
///
/// # Errors
///
/// [`FileError`] with the line and column or the place and the value; nothing is repaired.
pub fn from_json(text: &str) -> Result<Saved, FileError> {
    check_size(text.len() as u64)?;
    let header: Header = parse(text)?;
    if header.format != FORMAT {
        return Err(FileError::OtherFormat { found: header.format.chars().take(40).collect() });
    }
    if header.version > u64::from(FORMAT_VERSION) {
        return Err(FileError::NewerVersion { found: header.version, supported: FORMAT_VERSION });
    }
    if header.version == 0 {
        return Err(FileError::value("version", "0 is not a version; the first one is 1"));
    }
    let file: FileRecord = parse(text)?;
    let document = document_of(file.objects, file.next_id)?;
    check_view(&file.view)?;
    Ok(Saved { document, view: file.view })
}

fn entry(key: &str, value: Value) -> (String, Node) {
    (key.to_owned(), Node::from(value))
}

fn object_node(object: &Object) -> Node {
    let Content::Curve(curve) = &object.content;
    let space = curve.space();
    let points = curve.points().iter().map(|point| Node::from(json!([point.x, point.y]))).collect();
    let mut entries = vec![
        entry("id", json!(object.id)),
        entry("kind", json!("curve")),
        entry("name", json!(object.name)),
        entry("visible", json!(object.visible)),
        entry("degree", json!(curve.degree())),
        entry("knots", json!(space.knots())),
    ];
    entries.extend(space.period().map(|period| entry("period", json!(period))));
    entries.push(("points".to_owned(), Node::List(points)));
    if curve.weights().iter().any(|weight| weight.to_bits() != 1.0_f64.to_bits()) {
        entries.push(entry("weights", json!(curve.weights())));
    }
    entries.push(entry("display", json!(object.display)));
    Node::Record(entries)
}

fn view_node(view: &View) -> Node {
    let mut value = json!(view);
    remove_nulls(&mut value);
    Node::from(value)
}

/// Takes out what is missing or, being no finite number, became `null`; a record's entry disappears, a list with one too.
fn remove_nulls(value: &mut Value) {
    if let Value::Object(entries) = value {
        entries.values_mut().for_each(remove_nulls);
        entries.retain(|_, entry| {
            let holds_null = entry.as_array().is_some_and(|items| items.iter().any(Value::is_null));
            !entry.is_null() && !holds_null
        });
    }
}

fn parse<'text, T: Deserialize<'text>>(text: &'text str) -> Result<T, FileError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let place = error.path().to_string();
        read_error(error.inner(), if place == "." { "file".to_owned() } else { place })
    })?;
    reader.end().map_err(|error| read_error(&error, "end".to_owned()))?;
    Ok(value)
}

fn read_error(error: &serde_json::Error, place: String) -> FileError {
    let (line, column) = (error.line(), error.column());
    // The place is given apart from the message.
    let message = error.to_string();
    let end = message.rfind(" at line ").unwrap_or(message.len());
    let message = message[..end].to_owned();
    if error.is_data() {
        FileError::Structure { place, line, column, message }
    } else {
        let message = if error.is_eof() { format!("the file ends too early ({message})") } else { message };
        FileError::Syntax { line, column, message }
    }
}

fn document_of(records: Vec<ObjectRecord>, next_id: u64) -> Result<Document, FileError> {
    if records.len() > MAX_OBJECTS {
        let message = format!("{} objects are above the limit {MAX_OBJECTS}", records.len());
        return Err(FileError::value("objects", message));
    }
    if next_id == 0 || next_id > MAX_ID + 1 {
        let message = format!("{next_id} lies outside 1 to {}", MAX_ID + 1);
        return Err(FileError::value("next_id", message));
    }
    let mut seen = BTreeSet::new();
    let mut objects = Vec::with_capacity(records.len());
    for (index, record) in records.into_iter().enumerate() {
        let place = format!("objects[{index}]");
        let id = record.id;
        if id == 0 || id >= next_id {
            let message = format!("{id} is not between 1 and {}, below next_id", next_id - 1);
            return Err(FileError::value(format!("{place}.id"), message));
        }
        if !seen.insert(id) {
            let message = format!("{id} is the number of an earlier object too");
            return Err(FileError::value(format!("{place}.id"), message));
        }
        objects.push(Arc::new(object_of(record, &place)?));
    }
    Ok(Document { objects, made: next_id - 1 })
}

fn object_of(record: ObjectRecord, place: &str) -> Result<Object, FileError> {
    check_name(&record.name).map_err(|error| FileError::value(format!("{place}.name"), error))?;
    let count = record.points.len();
    if count > MAX_POINTS {
        let message = format!("{count} points are above the limit {MAX_POINTS}");
        return Err(FileError::value(format!("{place}.points"), message));
    }
    record.display.check().map_err(|error| FileError::value(format!("{place}.display"), error))?;
    let curve = curve_of(record.degree, record.knots, record.period, &record.points, record.weights)
        .map_err(|error| FileError::value(format!("{place}{}", field_of(&error)), error))?;
    Ok(Object {
        id: ObjectId(record.id),
        name: record.name,
        visible: record.visible,
        display: record.display,
        content: Content::Curve(curve),
    })
}

fn curve_of(
    degree: usize,
    knots: Vec<f64>,
    period: Option<f64>,
    points: &[[f64; 2]],
    weights: Option<Vec<f64>>,
) -> Result<Nurbs<DVec2>, SplineError> {
    let space = match period {
        Some(period) => SplineSpace::periodic(degree, period, knots)?,
        None => SplineSpace::new(degree, knots)?,
    };
    let points = points.iter().copied().map(DVec2::from_array).collect();
    match weights {
        Some(weights) => Nurbs::new(space, points, weights),
        None => Nurbs::polynomial(space, points),
    }
}

/// The entry of the object's record that `error` is about.
fn field_of(error: &SplineError) -> String {
    match error {
        SplineError::DegreeZero | SplineError::StepLimit { .. } => ".degree".to_owned(),
        SplineError::KnotsDecreasing { index, .. } | SplineError::KnotMultiplicityTooHigh { index, .. } => {
            format!(".knots[{index}]")
        }
        SplineError::KnotsNotRegular { .. } => ".knots".to_owned(),
        SplineError::PeriodTooShort { .. } => ".period".to_owned(),
        SplineError::WeightNotPositive { index, .. } => format!(".weights[{index}]"),
        SplineError::NonFinite { what: "coefficient", index, .. } => format!(".points[{index}]"),
        SplineError::NonFinite { what: "unrolled knot", .. } => ".period".to_owned(),
        SplineError::SizeMismatch { what: "coefficients", .. } => ".points".to_owned(),
        SplineError::SizeMismatch { what, .. } | SplineError::Empty { what } => format!(".{what}"),
        _ => String::new(),
    }
}

fn check_view(view: &View) -> Result<(), FileError> {
    let scale = view.camera.scale;
    if scale <= 0.0 {
        return Err(FileError::value("view.camera.scale", format!("{scale} is not positive")));
    }
    let eye_error = |error: EyeError| FileError::value(format!("view.eye.{}", error.field), error);
    view.eye.check().map_err(eye_error)
}
