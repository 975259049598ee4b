//! Edits of the list of objects.

use std::sync::Arc;

use crate::document::apply::{MAX_ID, MAX_OBJECTS, check_content};
use crate::document::contents::Document;
use crate::document::edit_error::EditError;
use crate::document::object::{Content, Object, ObjectId};
use crate::document::outcome::{Outcome, ShapeChange};

/// The longest name in bytes: more does not fit into any list.
pub(in crate::document) const MAX_NAME: usize = 1000;

pub(super) fn add(document: &mut Document, name: &str, content: Content) -> Result<Outcome, EditError> {
    check_name(name)?;
    check_content(&content)?;
    let id = new_id(document)?;
    let object = Object { id, name: name.to_owned(), visible: true, content };
    document.objects.push(Arc::new(object));
    Ok(Outcome { shape: ShapeChange::None, created: vec![id] })
}

pub(super) fn remove(document: &mut Document, ids: &[ObjectId]) -> Result<Outcome, EditError> {
    if let Some(&object) = ids.iter().find(|id| document.position(**id).is_none()) {
        return Err(EditError::NoSuchObject { object });
    }
    document.objects.retain(|object| !ids.contains(&object.id));
    Ok(Outcome { shape: ShapeChange::None, created: Vec::new() })
}

pub(super) fn duplicate(document: &mut Document, id: ObjectId) -> Result<Outcome, EditError> {
    let position = document.position(id).ok_or(EditError::NoSuchObject { object: id })?;
    let new = new_id(document)?;
    let mut copy = Object::clone(&document.objects[position]);
    copy.id = new;
    let name = free_name(document, &copy.name);
    // A name that leaves no room for the number stays as it is.
    if name.len() <= MAX_NAME {
        copy.name = name;
    }
    document.objects.insert(position + 1, Arc::new(copy));
    Ok(Outcome { shape: ShapeChange::None, created: vec![new] })
}

pub(super) fn rename(document: &mut Document, id: ObjectId, name: &str) -> Result<Outcome, EditError> {
    check_name(name)?;
    document.change(id, |object| {
        name.clone_into(&mut object.name);
        Ok(ShapeChange::None)
    })
}

pub(super) fn reorder(document: &mut Document, id: ObjectId, to: usize) -> Result<Outcome, EditError> {
    let from = document.position(id).ok_or(EditError::NoSuchObject { object: id })?;
    if to >= document.len() {
        return Err(EditError::NoSuchPosition { to, count: document.len() });
    }
    let object = document.objects.remove(from);
    document.objects.insert(to, object);
    Ok(Outcome { shape: ShapeChange::None, created: Vec::new() })
}

/// Whether `name` can be an object's name: not blank, one line, not too long.
pub(in crate::document) fn check_name(name: &str) -> Result<(), EditError> {
    let reason = if name.trim().is_empty() {
        "is empty"
    } else if name.len() > MAX_NAME {
        "is longer than 1000 bytes"
    } else if name.chars().any(char::is_control) {
        "contains a line break or another control character"
    } else {
        return Ok(());
    };
    let name = name.chars().take(40).collect();
    Err(EditError::BadName { name, reason })
}

fn new_id(document: &mut Document) -> Result<ObjectId, EditError> {
    if document.len() >= MAX_OBJECTS {
        return Err(EditError::TooMany { what: "objects", value: document.len() + 1, limit: MAX_OBJECTS });
    }
    if document.made >= MAX_ID {
        let limit = usize::try_from(MAX_ID).unwrap_or(usize::MAX);
        return Err(EditError::TooMany { what: "object numbers", value: limit.saturating_add(1), limit });
    }
    document.made += 1;
    Ok(ObjectId(document.made))
}

/// `name` with the first number from 2 that makes it different from all others: `Wave 2`.
fn free_name(document: &Document, name: &str) -> String {
    let base = match name.rsplit_once(' ') {
        Some((base, number)) if !base.is_empty() && number.parse::<u32>().is_ok() => base,
        _ => name,
    };
    let taken = |wanted: &str| document.objects.iter().any(|object| object.name == wanted);
    let mut number = 2_usize;
    loop {
        let wanted = format!("{base} {number}");
        if !taken(&wanted) {
            return wanted;
        }
        number += 1;
    }
}
