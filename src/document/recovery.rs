//! Recovery files: what had not been saved when the program ended without being asked to.
//!
//! Each running instance owns a slot: `autosave-N.lock`, locked as long as the process lives, and `autosave-N.spline` with the
//! document. The system releases the lock when a process dies, however it dies; a document whose lock is free is abandoned.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use crate::document::contents::Document;
use crate::document::file_error::FileError;
use crate::document::json::{from_json, to_json};
use crate::document::storage::{read_text, write_atomically};
use crate::document::view::{Saved, View};

/// So many instances can run, and so many documents be abandoned, at the same time.
const MAX_SLOTS: usize = 1000;

/// The recovery file of this process.
#[derive(Debug)]
pub struct Autosave {
    slot: PathBuf,
    /// Unlocked when dropped.
    _lock: File,
}

/// A document that its instance left behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// Document and view.
    pub saved: Saved,
    /// The file that was open; `None` for an untitled document.
    pub original: Option<PathBuf>,
    /// When it was written.
    pub written: SystemTime,
    /// The recovery file, for [`Autosave::discard`].
    pub slot: PathBuf,
}

/// A recovery file that cannot be read. It is kept under a name that no instance uses.
#[derive(Debug)]
pub struct Damaged {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub error: FileError,
}

/// The first line of a recovery file; the document follows.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    /// The open file's path.
    original: Option<String>,
    /// The same if it is not Unicode (Unix).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    original_bytes: Option<Vec<u8>>,
}

impl Autosave {
    /// Takes the first free slot of the folder `dir`, which is made if it does not exist.
    ///
    /// Slots of running instances and those that hold an abandoned document are not free.
    ///
    /// # Errors
    ///
    /// `Io`, also if all slots are taken.
    pub fn open(dir: &Path) -> Result<Self, FileError> {
        fs::create_dir_all(dir).map_err(|error| FileError::io("make", dir, error))?;
        for number in 1..=MAX_SLOTS {
            let slot = slot_path(dir, number);
            if slot.exists() {
                continue;
            }
            let Some(lock) = try_lock(&slot.with_extension("lock"))? else {
                continue;
            };
            // Its owner may have written between the look and the lock, and ended.
            if !slot.exists() {
                return Ok(Self { slot, _lock: lock });
            }
        }
        let full = std::io::Error::other(format!("all {MAX_SLOTS} recovery files are in use"));
        Err(FileError::io("use", dir, full))
    }

    /// The recovery file; it exists between [`Self::write`] and [`Self::clear`].
    pub fn slot(&self) -> &Path {
        &self.slot
    }

    /// Keeps the document for the case that the program ends; `original` is the open file.
    ///
    /// # Errors
    ///
    /// `Io`; what was written before is then still there.
    pub fn write(
        &mut self,
        document: &Document,
        view: &View,
        original: Option<&Path>,
    ) -> Result<(), FileError> {
        let header = serde_json::to_string(&Header::new(original))
            .map_err(|error| FileError::io("write", &self.slot, error.into()))?;
        let text = format!("{header}\n{}", to_json(document, view));
        write_atomically(&self.slot, text.as_bytes())
    }

    /// Removes the recovery file: after saving, and when the program ends as asked.
    ///
    /// # Errors
    ///
    /// `Io`.
    pub fn clear(&mut self) -> Result<(), FileError> {
        remove_if_there(&self.slot)
    }

    /// The documents whose instances are gone, newest first.
    ///
    /// Files that cannot be read get another name and appear in [`Self::damaged`].
    pub fn abandoned(dir: &Path) -> Vec<Recovered> {
        let mut found = Vec::new();
        for slot in files_named(dir, "autosave-", ".spline") {
            let Ok(Some(_lock)) = try_lock(&slot.with_extension("lock")) else {
                continue;
            };
            // Its owner may have cleared it in the meantime, or it may be unreadable for the moment only.
            match read_slot(&slot) {
                Ok(recovered) => found.push(recovered),
                Err(FileError::Io { .. }) => {}
                Err(_) => put_aside(&slot),
            }
        }
        found.sort_by_key(|recovered| std::cmp::Reverse(recovered.written));
        found
    }

    /// The recovery files that could not be read, each with what is wrong with it.
    pub fn damaged(dir: &Path) -> Vec<Damaged> {
        let files = files_named(dir, "damaged-", ".spline").into_iter();
        files.filter_map(|path| read_slot(&path).err().map(|error| Damaged { path, error })).collect()
    }

    /// Removes the recovery file of an instance that is gone.
    ///
    /// # Errors
    ///
    /// `InUse` if that instance runs, `Io`.
    pub fn discard(slot: &Path) -> Result<(), FileError> {
        let Some(_lock) = try_lock(&slot.with_extension("lock"))? else {
            return Err(FileError::InUse { path: slot.to_owned() });
        };
        remove_if_there(slot)
    }
}

impl Header {
    fn new(original: Option<&Path>) -> Self {
        let text = original.and_then(|path| path.to_str()).map(str::to_owned);
        let original_bytes = if text.is_none() { original.and_then(raw_bytes) } else { None };
        Self { original: text, original_bytes }
    }

    fn path(self) -> Option<PathBuf> {
        self.original.map(PathBuf::from).or_else(|| self.original_bytes.and_then(from_raw_bytes))
    }
}

#[cfg(unix)]
fn raw_bytes(path: &Path) -> Option<Vec<u8>> {
    use std::os::unix::ffi::OsStrExt as _;
    Some(path.as_os_str().as_bytes().to_vec())
}

#[cfg(unix)]
fn from_raw_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt as _;
    Some(PathBuf::from(std::ffi::OsString::from_vec(bytes)))
}

#[cfg(not(unix))]
fn raw_bytes(_path: &Path) -> Option<Vec<u8>> {
    None
}

#[cfg(not(unix))]
fn from_raw_bytes(_bytes: Vec<u8>) -> Option<PathBuf> {
    None
}

fn slot_path(dir: &Path, number: usize) -> PathBuf {
    dir.join(format!("autosave-{number}.spline"))
}

/// The locked file, or `None` if another process holds the lock.
fn try_lock(path: &Path) -> Result<Option<File>, FileError> {
    let file = File::options().create(true).truncate(false).write(true).open(path);
    let file = file.map_err(|error| FileError::io("open", path, error))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) => Err(FileError::io("lock", path, error)),
    }
}

fn read_slot(slot: &Path) -> Result<Recovered, FileError> {
    let text = read_text(slot)?;
    let (first, rest) = text.split_once('\n').unwrap_or((&text, ""));
    let header: Header = serde_json::from_str(first).map_err(|error| FileError::Syntax {
        line: 1,
        column: error.column(),
        message: format!("this is no recovery file ({error})"),
    })?;
    let saved = from_json(rest)?;
    let written = fs::metadata(slot).and_then(|data| data.modified());
    let written = written.map_err(|error| FileError::io("read", slot, error))?;
    Ok(Recovered { saved, original: header.path(), written, slot: slot.to_owned() })
}

/// Gives a damaged slot a name that no slot has. If that fails it stays, and its slot is not used.
fn put_aside(slot: &Path) {
    let Some(dir) = slot.parent() else {
        return;
    };
    let free = (1..).map(|number| dir.join(format!("damaged-{number}.spline"))).find(|path| !path.exists());
    if let Some(path) = free {
        let _ = fs::rename(slot, path);
    }
}

fn files_named(dir: &Path, prefix: &str, suffix: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(dir).into_iter().flatten().filter_map(Result::ok);
    let mut files: Vec<PathBuf> = entries
        .filter(|entry| {
            let name = entry.file_name();
            name.to_str().is_some_and(|name| name.starts_with(prefix) && name.ends_with(suffix))
        })
        .map(|entry| entry.path())
        .collect();
    files.sort();
    files
}

fn remove_if_there(path: &Path) -> Result<(), FileError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(FileError::io("remove", path, error))
        }
        _ => Ok(()),
    }
}
