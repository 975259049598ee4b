//! Recovery files: found after a crash, and never two instances in one.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use std::path::Path;

use spline_lab::document::{Autosave, Document, View, first_scene};

fn scene() -> (Document, View) {
    first_scene()
}

#[test]
fn what_an_instance_leaves_behind_is_found_with_its_origin() {
    let folder = tempfile::tempdir().unwrap();
    let (document, view) = scene();
    let mut first = Autosave::open(folder.path()).unwrap();
    first.write(&document, &view, Some(Path::new("/home/ada/kite ö.spline"))).unwrap();
    assert!(Autosave::abandoned(folder.path()).is_empty(), "its owner runs");
    // As at the end of a process: the lock goes, the file stays.
    drop(first);
    let found = Autosave::abandoned(folder.path());
    assert_eq!(found.len(), 1, "one document");
    assert_eq!(found[0].saved.document, document, "the document");
    assert_eq!(found[0].saved.view, view, "the view");
    assert_eq!(found[0].original.as_deref(), Some(Path::new("/home/ada/kite ö.spline")), "the file");
    Autosave::discard(&found[0].slot).unwrap();
    assert!(Autosave::abandoned(folder.path()).is_empty(), "discarded");
}

#[test]
fn two_instances_have_two_slots() {
    let folder = tempfile::tempdir().unwrap();
    let (document, view) = scene();
    let mut first = Autosave::open(folder.path()).unwrap();
    let mut second = Autosave::open(folder.path()).unwrap();
    assert_ne!(first.slot(), second.slot(), "slots");
    first.write(&document, &view, None).unwrap();
    second.write(&Document::new(), &view, None).unwrap();
    let slot = first.slot().to_owned();
    assert_eq!(Autosave::discard(&slot).unwrap_err().name(), "InUse", "the second cannot take the first's");
    second.clear().unwrap();
    assert!(slot.exists(), "clearing one leaves the other");
    drop(second);
    assert!(Autosave::abandoned(folder.path()).is_empty(), "the second ended as asked, the first runs");
}

#[test]
fn a_new_instance_does_not_overwrite_what_was_left() {
    let folder = tempfile::tempdir().unwrap();
    let (document, view) = scene();
    let mut crashed = Autosave::open(folder.path()).unwrap();
    crashed.write(&document, &view, None).unwrap();
    drop(crashed);
    let mut next = Autosave::open(folder.path()).unwrap();
    next.write(&Document::new(), &view, None).unwrap();
    let found = Autosave::abandoned(folder.path());
    assert_eq!(found.len(), 1, "only the crashed one is offered");
    assert_eq!(found[0].saved.document, document, "unharmed");
    assert_eq!(found[0].original, None, "untitled");
}

#[test]
fn a_damaged_recovery_file_is_kept_aside_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    let (document, view) = scene();
    let mut crashed = Autosave::open(folder.path()).unwrap();
    crashed.write(&document, &view, None).unwrap();
    let slot = crashed.slot().to_owned();
    drop(crashed);
    let bytes = std::fs::read(&slot).unwrap();
    std::fs::write(&slot, &bytes[..bytes.len() / 2]).unwrap();
    assert!(Autosave::abandoned(folder.path()).is_empty(), "nothing to offer");
    let damaged = Autosave::damaged(folder.path());
    assert_eq!(damaged.len(), 1, "one report");
    assert_eq!(
        std::fs::read(&damaged[0].path).unwrap(),
        &bytes[..bytes.len() / 2],
        "not deleted, not changed"
    );
    assert_eq!(damaged[0].error.name(), "Syntax", "{}", damaged[0].error);
    assert!(!slot.exists(), "the slot is free again");
}

#[cfg(unix)]
#[test]
fn a_path_that_is_not_unicode_comes_back() {
    use std::os::unix::ffi::OsStrExt as _;
    let folder = tempfile::tempdir().unwrap();
    let (document, view) = scene();
    let path = Path::new(std::ffi::OsStr::from_bytes(b"/tmp/kite\xFF.spline"));
    let mut crashed = Autosave::open(folder.path()).unwrap();
    crashed.write(&document, &view, Some(path)).unwrap();
    drop(crashed);
    assert_eq!(Autosave::abandoned(folder.path())[0].original.as_deref(), Some(path), "byte by byte");
}
