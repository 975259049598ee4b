//! Files on disk. Saving is atomic: whatever happens, the file is the old or the new one.

use std::fs::{self, File};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};

use crate::document::contents::Document;
use crate::document::file_error::FileError;
use crate::document::json::{from_json, to_json};
use crate::document::view::{Saved, View};

/// The largest file that is read: 256 MiB, more than the largest document needs that can be worked with.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Writes document and view to `path`: into a new file beside it, to the disk, then over the old file.
///
/// A symbolic link is followed. Permissions of an existing file are kept.
///
/// # Errors
///
/// `Io`; the old file is then still there.
pub fn save(path: &Path, document: &Document, view: &View) -> Result<(), FileError> {
    write_atomically(path, to_json(document, view).as_bytes())
}

/// Reads a file.
///
/// # Errors
///
/// `Io`, `TooLarge` above [`MAX_FILE_BYTES`], `NotText`, and those of [`from_json`].
pub fn load(path: &Path) -> Result<Saved, FileError> {
    from_json(&read_text(path)?)
}

pub(in crate::document) fn check_size(bytes: u64) -> Result<(), FileError> {
    if bytes > MAX_FILE_BYTES {
        return Err(FileError::TooLarge { bytes, limit: MAX_FILE_BYTES });
    }
    Ok(())
}

pub(in crate::document) fn read_text(path: &Path) -> Result<String, FileError> {
    let file = File::open(path).map_err(|error| FileError::io("open", path, error))?;
    let size = file.metadata().map_err(|error| FileError::io("open", path, error))?.len();
    check_size(size)?;
    let mut bytes = Vec::new();
    // The file may grow while it is read, and devices have no size.
    file.take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| FileError::io("read", path, error))?;
    check_size(bytes.len() as u64)?;
    String::from_utf8(bytes).map_err(|error| FileError::NotText { offset: error.utf8_error().valid_up_to() })
}

pub(in crate::document) fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |error| FileError::io("write", path, error);
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".saving-").suffix(".spline");
    if let Ok(old) = fs::metadata(&target) {
        builder.permissions(old.permissions());
    } else {
        new_file_permissions(&mut builder);
    }
    let mut beside = builder.tempfile_in(&folder).map_err(failed)?;
    beside.write_all(bytes).map_err(failed)?;
    beside.as_file().sync_all().map_err(failed)?;
    beside.persist(&target).map_err(|error| failed(error.error))?;
    sync_folder(&folder).map_err(failed)
}

/// What other programs give new files; the process's mask is applied by the system.
#[cfg(unix)]
fn new_file_permissions(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt as _;
    builder.permissions(fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn new_file_permissions(_builder: &mut tempfile::Builder<'_, '_>) {}

/// The new name is on the disk only when its folder is.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> std::io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> std::io::Result<()> {
    Ok(())
}
