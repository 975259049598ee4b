//! The file format: JSON with a version number.
//!
//! ```text
//! {"format": "spline-lab", "version": 1,
//!  "objects": [{"id": 1, "name": "Wave", "visible": true, "curve": {…}}],
//!  "next_id": 2, "view": {…}}
//! ```
//!
//! What an object is stands under the name of its kind, in a record of its own.
//!
//! Numbers are written in the shortest form that reads back as the same number. Unknown keys are refused, except in `view`:
//! data that this program does not understand would be lost with the next save.

mod approximation;
mod curve;
mod membrane;
mod mesh;
mod surface;
mod writer;

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::Deserialize;
use serde_json::{Value, json};

use crate::document::apply::{MAX_ID, MAX_OBJECTS, check_name};
use crate::document::contents::Document;
use crate::document::eye::EyeError;
use crate::document::file_error::FileError;
use crate::document::json::approximation::ApproximationRecord;
use crate::document::json::curve::CurveRecord;
use crate::document::json::membrane::MembraneRecord;
use crate::document::json::mesh::MeshRecord;
use crate::document::json::surface::SurfaceRecord;
use crate::document::json::writer::Node;
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

/// One of the kinds must be there, and no more than one.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectRecord {
    id: u64,
    name: String,
    visible: bool,
    #[serde(default)]
    curve: Option<CurveRecord>,
    #[serde(default)]
    surface: Option<SurfaceRecord>,
    #[serde(default)]
    mesh: Option<MeshRecord>,
    #[serde(default)]
    approximation: Option<ApproximationRecord>,
    #[serde(default)]
    membrane: Option<MembraneRecord>,
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
    let content = match &object.content {
        Content::Curve { curve, display } => curve::node(curve, display),
        Content::Surface(surface) => surface::node(surface),
        Content::Mesh(mesh) => mesh::node(mesh),
        Content::Approximation(approximation) => approximation::node(approximation),
        Content::Membrane { membrane, display } => membrane::node(membrane, display),
    };
    Node::Record(vec![
        entry("id", json!(object.id)),
        entry("name", json!(object.name)),
        entry("visible", json!(object.visible)),
        (object.content.kind().to_owned(), content),
    ])
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
    let kinds = [
        record.curve.map(|curve| curve.content(&format!("{place}.curve"))),
        record.surface.map(|surface| surface.content(&format!("{place}.surface"))),
        record.mesh.map(|mesh| mesh.content(&format!("{place}.mesh"))),
        record.approximation.map(|record| record.content(&format!("{place}.approximation"))),
        record.membrane.map(|membrane| membrane.content(&format!("{place}.membrane"))),
    ];
    let mut found = kinds.into_iter().flatten();
    let (Some(content), None) = (found.next(), found.next()) else {
        return Err(FileError::value(
            place,
            "an object needs exactly one of the kinds curve, approximation, surface, mesh, membrane",
        ));
    };
    Ok(Object { id: ObjectId(record.id), name: record.name, visible: record.visible, content: content? })
}

fn check_view(view: &View) -> Result<(), FileError> {
    let scale = view.camera.scale;
    if scale <= 0.0 {
        return Err(FileError::value("view.camera.scale", format!("{scale} is not positive")));
    }
    for (room, camera) in &view.cameras {
        let scale = camera.scale;
        if scale <= 0.0 {
            let place = format!("view.cameras.{room}.scale");
            return Err(FileError::value(place, format!("{scale} is not positive")));
        }
    }
    let eye_error = |error: EyeError| FileError::value(format!("view.eye.{}", error.field), error);
    view.eye.check().map_err(eye_error)?;
    for (id, plot) in &view.plots {
        plot.check().map_err(|message| FileError::value(format!("view.plots.{id}"), message))?;
    }
    Ok(())
}
