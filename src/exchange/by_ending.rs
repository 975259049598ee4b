//! Files chosen by the ending of their names: which documents can be read, which figures can be written.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
#[cfg(unix)]
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};

use glam::DVec2;
use thiserror::Error;

use crate::core::progress::{Unwatched, Watcher};
use crate::document::{
    self, Content, Document, EXTENSION, Edit, EditError, FileError, MeshDisplay, MeshObject, Saved, View,
};
use crate::exchange::obj::{self, ObjError};
use crate::exchange::pdf::{PdfError, write_pdf};
use crate::exchange::png::{PngError, write_png};
use crate::exchange::svg::{SvgReadError, read_embedded_document, write_svg};
use crate::exchange::tikz::write_tikz;
use crate::figure::picture::{Picture, Viewport};
use crate::figure::scene::Eye;

/// Endings of figures, the usual one first.
pub const FIGURE_ENDINGS: &[&str] = &["svg", "pdf", "png", "tex"];

/// Ending of polygon meshes.
pub const MESH_ENDING: &str = "obj";

/// Largest SVG or mesh that is read, in bytes.
const SVG_LIMIT: u64 = 256 << 20;

/// A mesh with more faces is shown as it is: without its net, not refined.
const FINE_MESH: usize = 5000;

/// Why a file could not be read or written. Every message names the file.
#[derive(Debug, Error)]
pub enum ByEndingError {
    /// The ending says nothing that the lab could do.
    #[error("{path}: the ending {ending:?} is not one of {supported}")]
    UnknownEnding {
        /// The file.
        path: PathBuf,
        /// Its ending; empty if it has none.
        ending: String,
        /// The endings that are possible here.
        supported: String,
    },
    /// The file system said no.
    #[error("{path}: {error}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What was said.
        error: io::Error,
    },
    /// The file holds too much.
    #[error("{path}: the file has {bytes} bytes, more than the limit {SVG_LIMIT}")]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// The document cannot be read.
    #[error("{path}: {error}")]
    Document {
        /// The file.
        path: PathBuf,
        /// What is wrong and where.
        error: FileError,
    },
    /// The SVG cannot be read or holds no document.
    #[error("{path}: {error}")]
    Svg {
        /// The file.
        path: PathBuf,
        /// What is wrong and where.
        error: SvgReadError,
    },
    /// The mesh cannot be read.
    #[error("{path}: {error}")]
    Obj {
        /// The file.
        path: PathBuf,
        /// What is wrong, with its line.
        error: ObjError,
    },
    /// The mesh is too large for the lab.
    #[error("{path}: {error}")]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What there is too much of.
        error: EditError,
    },
    /// The figure cannot be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// The figure cannot be written as PNG.
    #[error(transparent)]
    Png(#[from] PngError),
    /// The figure cannot be written as TikZ.
    #[error("a .tex file holds no images, and the figure has {count}: choose .pdf, .svg or .png")]
    ImagesInTikz {
        /// How many.
        count: usize,
    },
}

/// What a figure is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFormat {
    /// Scalable Vector Graphics, with the document inside.
    Svg,
    /// Portable Document Format.
    Pdf,
    /// Portable Network Graphics.
    Png,
    /// TikZ in a LaTeX file of its own.
    Tikz,
}

impl FigureFormat {
    /// The format that the ending of `path` names.
    ///
    /// # Errors
    ///
    /// [`ByEndingError::UnknownEnding`].
    pub fn of(path: &Path) -> Result<Self, ByEndingError> {
        match ending_of(path).as_str() {
            "svg" => Ok(Self::Svg),
            "pdf" => Ok(Self::Pdf),
            "png" => Ok(Self::Png),
            "tex" => Ok(Self::Tikz),
            _ => Err(unknown_ending(path, FIGURE_ENDINGS)),
        }
    }
}

/// Whether `path` has the ending of a document of the lab.
pub fn is_document(path: &Path) -> bool {
    ending_of(path) == EXTENSION
}

/// Whether `path` has the ending of a polygon mesh.
pub fn is_mesh(path: &Path) -> bool {
    ending_of(path) == MESH_ENDING
}

/// Reads a polygon mesh with the name of its file, as the window shows it first.
///
/// # Errors
///
/// [`ByEndingError`] with the file and the line.
pub fn read_mesh(path: &Path) -> Result<(String, MeshObject), ByEndingError> {
    read_mesh_watched(path, &Unwatched)
}

/// As [`read_mesh`] with a watcher.
///
/// # Errors
///
/// As [`read_mesh`]; stopped, an OBJ error that says so.
pub fn read_mesh_watched(path: &Path, watcher: &dyn Watcher) -> Result<(String, MeshObject), ByEndingError> {
    let said = |error| ByEndingError::Io { path: path.to_owned(), error };
    let file = File::open(path).map_err(said)?;
    let bytes = file.metadata().map_err(said)?.len();
    if bytes > SVG_LIMIT {
        return Err(ByEndingError::TooLarge { path: path.to_owned(), bytes });
    }
    let mut content = Vec::new();
    file.take(SVG_LIMIT).read_to_end(&mut content).map_err(said)?;
    let read = obj::read_watched(&content, watcher)
        .map_err(|error| ByEndingError::Obj { path: path.to_owned(), error })?;
    let stem =
        path.file_stem().map(|stem| stem.to_string_lossy().chars().filter(|c| !c.is_control()).collect());
    let name = stem.filter(|stem: &String| !stem.trim().is_empty()).unwrap_or_else(|| "Mesh".to_owned());
    let faces = read.mesh.topology().face_count();
    // The net of a fine mesh hides what it is the net of, and such a mesh needs no refinement to be looked at.
    let display = MeshDisplay { cage: faces <= FINE_MESH, ..MeshDisplay::default() };
    let mesh = MeshObject::from_cage(read.mesh, display);
    let mesh = mesh.and_then(|mesh| if faces <= FINE_MESH { Ok(mesh) } else { mesh.with_level(0) });
    Ok((name, mesh.map_err(|error| ByEndingError::Mesh { path: path.to_owned(), error })?))
}

/// Reads a document: a file of the lab, an SVG with a document inside, or a mesh, which becomes a document.
///
/// # Errors
///
/// [`ByEndingError`] with the file and, inside it, the place.
pub fn read_document(path: &Path) -> Result<Saved, ByEndingError> {
    match ending_of(path).as_str() {
        EXTENSION => {
            document::load(path).map_err(|error| ByEndingError::Document { path: path.to_owned(), error })
        }
        "svg" => {
            let text = read_svg(path)?;
            let json = read_embedded_document(&text)
                .map_err(|error| ByEndingError::Svg { path: path.to_owned(), error })?;
            document::from_json(&json)
                .map_err(|error| ByEndingError::Document { path: path.to_owned(), error })
        }
        "obj" => {
            let (name, mesh) = read_mesh(path)?;
            let mut document = Document::new();
            let edit = Edit::AddObject { name, content: Content::Mesh(mesh) };
            document.apply(&edit).map_err(|error| ByEndingError::Mesh { path: path.to_owned(), error })?;
            let workspace = crate::figure::surfaces::WORKSPACE.to_owned();
            let mut view = View { workspace, ..View::default() };
            if let (Some((low, high)), Ok(eye)) =
                (crate::figure::surfaces::bounding_box(&document), Eye::new(view.eye))
            {
                view.eye = *eye.fitted(low, high, DVec2::new(400.0, 300.0), 30.0).state();
            }
            Ok(Saved { document, view })
        }
        _ => Err(unknown_ending(path, &[EXTENSION, "svg", MESH_ENDING])),
    }
}

/// The bytes of a figure. An SVG gets `document` and `view` inside; a PNG has `pixels_per_point` pixels to a point.
///
/// # Errors
///
/// [`ByEndingError::Pdf`] or [`ByEndingError::Png`] if the page is too large or too small; `ImagesInTikz`.
pub fn figure(
    format: FigureFormat,
    picture: &Picture,
    viewport: &Viewport,
    document: &Document,
    view: &View,
    pixels_per_point: f64,
) -> Result<Vec<u8>, ByEndingError> {
    Ok(match format {
        FigureFormat::Svg => {
            let json = document::to_json(document, view);
            write_svg(picture, viewport, Some(&json)).into_bytes()
        }
        FigureFormat::Pdf => write_pdf(picture, viewport)?,
        FigureFormat::Png => write_png(picture, viewport, pixels_per_point)?,
        FigureFormat::Tikz => {
            write_tikz(picture, viewport).map_err(|count| ByEndingError::ImagesInTikz { count })?.into_bytes()
        }
    })
}

/// Writes `bytes` to `path`: all of them or, on an error, none.
///
/// # Errors
///
/// [`ByEndingError::Io`].
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ByEndingError> {
    let write = || -> io::Result<()> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        // A temporary file is private; a figure is to be as readable as any new file.
        #[cfg(unix)]
        builder.permissions(std::fs::Permissions::from_mode(0o666));
        let mut beside = builder.tempfile_in(folder)?;
        beside.write_all(bytes)?;
        beside.as_file().sync_all()?;
        beside.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|error| ByEndingError::Io { path: path.to_owned(), error })
}

fn read_svg(path: &Path) -> Result<String, ByEndingError> {
    let said = |error| ByEndingError::Io { path: path.to_owned(), error };
    let file = File::open(path).map_err(said)?;
    let bytes = file.metadata().map_err(said)?.len();
    if bytes > SVG_LIMIT {
        return Err(ByEndingError::TooLarge { path: path.to_owned(), bytes });
    }
    let mut text = String::new();
    // The limit holds too for a file that grows while it is read.
    file.take(SVG_LIMIT).read_to_string(&mut text).map_err(said)?;
    Ok(text)
}

pub(super) fn ending_of(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default()
}

pub(super) fn unknown_ending(path: &Path, supported: &[&str]) -> ByEndingError {
    let supported = supported.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
    ByEndingError::UnknownEnding { path: path.to_owned(), ending: ending_of(path), supported }
}
