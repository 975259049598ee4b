//! What can be wrong with a file.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file cannot be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// The system refused.
    #[error("cannot {action} {}: {source}", .path.display())]
    Io {
        /// What was to be done: `open`, `write` …
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's answer.
        #[source]
        source: io::Error,
    },
    /// The file is larger than any that this program writes.
    #[error("the file has {bytes} bytes, more than the limit of {limit}")]
    TooLarge {
        /// Its size.
        bytes: u64,
        /// The limit.
        limit: u64,
    },
    /// The file is not text.
    #[error("the file is not text: byte {offset} is not UTF-8")]
    NotText {
        /// Index of the first faulty byte.
        offset: usize,
    },
    /// The text is not JSON, or ends too early.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// The file belongs to another program.
    #[error("this is no Spline Lab file: its format is {found:?}, not \"spline-lab\"")]
    OtherFormat {
        /// The format it names.
        found: String,
    },
    /// The file comes from a later version of this program.
    #[error("newer version {found}, this program reads up to {supported}")]
    NewerVersion {
        /// The file's version.
        found: u64,
        /// The highest version that can be read.
        supported: u32,
    },
    /// A value has the wrong type or is missing, or a key is unknown.
    #[error("{place} (line {line}, column {column}): {message}")]
    Structure {
        /// Where: `objects[2].weights[3]`.
        place: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// A value is impossible.
    #[error("{place}: {message}")]
    Value {
        /// Where: `objects[2].weights[3]`.
        place: String,
        /// What is wrong, with the value.
        message: String,
    },
    /// Another running instance owns the recovery file.
    #[error("{} belongs to a running instance", .path.display())]
    InUse {
        /// The recovery file.
        path: PathBuf,
    },
}

impl FileError {
    pub(in crate::document) fn io(action: &'static str, path: &Path, source: io::Error) -> Self {
        Self::Io { action, path: path.to_owned(), source }
    }

    pub(in crate::document) fn value(place: impl Into<String>, message: impl ToString) -> Self {
        Self::Value { place: place.into(), message: message.to_string() }
    }

    /// The name of the error: `NewerVersion` …
    pub fn name(&self) -> &'static str {
        match self {
            Self::Io { .. } => "Io",
            Self::TooLarge { .. } => "TooLarge",
            Self::NotText { .. } => "NotText",
            Self::Syntax { .. } => "Syntax",
            Self::OtherFormat { .. } => "OtherFormat",
            Self::NewerVersion { .. } => "NewerVersion",
            Self::Structure { .. } => "Structure",
            Self::Value { .. } => "Value",
            Self::InUse { .. } => "InUse",
        }
    }
}
