//! Polygon meshes as Wavefront OBJ text: `v` and `f` lines.
//!
//! Texture coordinates, normals, groups, objects and materials are counted and ignored. A file comes from anybody: every number is checked,
//! the size is limited, and every error names the line and what stands there.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use glam::DVec3;
use thiserror::Error;

use crate::core::progress::{Stopped, Unwatched, Watcher};
use crate::core::surface::{MeshError, PolygonMesh};

/// Most vertices or faces that are read.
pub const MAX_ELEMENTS: usize = 2_000_000;

/// Most corners of all faces together.
pub const MAX_CORNERS: usize = 8_000_000;

/// The watcher is asked after so many lines.
const WATCHED: usize = 4096;

/// Longest piece of a line that an error repeats.
const SHOWN: usize = 40;

/// What is wrong with an OBJ text.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ObjError {
    /// The bytes are no text.
    #[error("line {line}: not text (byte {byte:#04x})")]
    NotText {
        /// Number of the line, from 1.
        line: usize,
        /// The byte that no text has there.
        byte: u8,
    },
    /// A number cannot be read, is missing or is not finite.
    #[error("line {line}: expected {expected}, found {found:?}")]
    Number {
        /// Number of the line, from 1.
        line: usize,
        /// What should stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A face names a vertex that does not exist.
    #[error("line {line}: there is no vertex {found}; {count} are defined so far")]
    Index {
        /// Number of the line, from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// Number of vertices before the line.
        count: usize,
    },
    /// A face has fewer than three corners.
    #[error("line {line}: a face with {found} corners; at least 3 are needed")]
    ShortFace {
        /// Number of the line, from 1.
        line: usize,
        /// Number of corners.
        found: usize,
    },
    /// The first word of a line belongs to no OBJ statement.
    #[error("line {line}: {found:?} starts no OBJ statement")]
    Statement {
        /// Number of the line, from 1.
        line: usize,
        /// The word.
        found: String,
    },
    /// There is more than the limit allows.
    #[error("line {line}: more than {limit} {what}")]
    TooMany {
        /// Number of the line, from 1.
        line: usize,
        /// What there is too much of.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// There are no vertices or no faces.
    #[error("the file has no {what}")]
    Nothing {
        /// What is missing.
        what: &'static str,
    },
    /// A watcher has stopped the reading.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The faces do not make a mesh.
    #[error("{}{fault}", .line.map(|line| format!("line {line}: ")).unwrap_or_default())]
    Mesh {
        /// Line of the face that the fault names, if it names one.
        line: Option<usize>,
        /// The fault.
        fault: MeshError,
    },
}

/// A mesh and what of the file is not in it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjMesh {
    /// The mesh.
    pub mesh: PolygonMesh,
    /// How many statements of each kind were ignored, such as `vn` or `usemtl`.
    pub ignored: BTreeMap<String, usize>,
}

/// Statements that OBJ has and a polygon mesh has not.
const IGNORED: [&str; 22] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "l",
    "p",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "cstype",
    "deg",
    "end",
];

/// Reads a mesh from the bytes of an OBJ file.
///
/// # Errors
///
/// The first fault, with its line; `Mesh` with the first fault of the connectivity.
pub fn read(bytes: &[u8]) -> Result<ObjMesh, ObjError> {
    read_watched(bytes, &Unwatched)
}

/// As [`read`] with a watcher.
///
/// # Errors
///
/// As [`read`]; `Stopped`.
pub fn read_watched(bytes: &[u8], watcher: &dyn Watcher) -> Result<ObjMesh, ObjError> {
    watcher.check(0.0)?;
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        ObjError::NotText {
            line: 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count(),
            byte: bytes[at],
        }
    })?;
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
        return Err(ObjError::NotText { line, byte: 0 });
    }
    let mut reader = Reader::default();
    let mut lines = text.lines().enumerate();
    while let Some((index, first)) = lines.next() {
        let line = index + 1;
        if line.is_multiple_of(WATCHED) {
            // The connectivity takes about as long as the text.
            let here = first.as_ptr() as usize - text.as_ptr() as usize;
            watcher.check(0.5 * here as f64 / text.len() as f64)?;
        }
        let first = without_comment(first);
        // A backslash at the end joins the next line.
        match first.strip_suffix('\\') {
            None => reader.statement(line, first)?,
            Some(start) => {
                let mut joined = start.to_owned();
                for (_, more) in lines.by_ref() {
                    let more = without_comment(more);
                    joined.push(' ');
                    joined.push_str(more.strip_suffix('\\').unwrap_or(more));
                    if !more.ends_with('\\') {
                        break;
                    }
                }
                reader.statement(line, &joined)?;
            }
        }
    }
    let Reader { positions, faces, face_lines, ignored } = reader;
    for (what, count) in [("vertices", positions.len()), ("faces", faces.len())] {
        if count == 0 {
            return Err(ObjError::Nothing { what });
        }
    }
    watcher.check(0.5)?;
    let mesh = PolygonMesh::new(positions, &faces).map_err(|fault| {
        let face = match &fault {
            MeshError::IndexOutOfRange { face, .. }
            | MeshError::DegenerateFace { face, .. }
            | MeshError::DuplicateFace { face, .. } => Some(*face),
            MeshError::NonManifoldEdge { faces, .. } => faces.last().copied(),
            MeshError::InconsistentOrientation { faces, .. } => Some(faces[1]),
            _ => None,
        };
        ObjError::Mesh { line: face.map(|face| face_lines[face]), fault }
    })?;
    Ok(ObjMesh { mesh, ignored })
}

/// Writes a mesh; numbers are the shortest that read back as the same bits. Creases have no place in OBJ.
pub fn write(mesh: &PolygonMesh) -> String {
    // Nobody stops it.
    write_watched(mesh, &Unwatched).unwrap_or_default()
}

/// As [`write()`] with a watcher.
///
/// # Errors
///
/// [`Stopped`].
pub fn write_watched(mesh: &PolygonMesh, watcher: &dyn Watcher) -> Result<String, Stopped> {
    let mut text = String::new();
    let count = (mesh.positions().len() + mesh.topology().face_count()) as f64;
    let watch = |done: usize| {
        if done.is_multiple_of(WATCHED) { watcher.check(done as f64 / count) } else { Ok(()) }
    };
    for (done, position) in mesh.positions().iter().enumerate() {
        watch(done)?;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
    }
    for (done, face) in mesh.topology().faces().enumerate() {
        watch(mesh.positions().len() + done)?;
        text.push('f');
        for vertex in face {
            let _ = write!(text, " {}", vertex + 1);
        }
        text.push('\n');
    }
    Ok(text)
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim_end()
}

#[derive(Default)]
struct Reader {
    positions: Vec<DVec3>,
    faces: Vec<Vec<u32>>,
    face_lines: Vec<usize>,
    ignored: BTreeMap<String, usize>,
}

impl Reader {
    fn statement(&mut self, line: usize, text: &str) -> Result<(), ObjError> {
        let mut words = text.split_whitespace();
        match words.next() {
            None => Ok(()),
            Some("v") => self.vertex(line, words),
            Some("f" | "fo") => self.face(line, words),
            Some(word) if IGNORED.contains(&word) => {
                *self.ignored.entry(word.to_owned()).or_default() += 1;
                Ok(())
            }
            Some(word) => Err(ObjError::Statement { line, found: shown(word) }),
        }
    }

    /// Three coordinates; a weight or a colour may follow and is counted as ignored.
    fn vertex<'a>(&mut self, line: usize, mut words: impl Iterator<Item = &'a str>) -> Result<(), ObjError> {
        let mut coordinates = [0.0; 3];
        for (coordinate, expected) in coordinates.iter_mut().zip([
            "a finite x coordinate",
            "a finite y coordinate",
            "a finite z coordinate",
        ]) {
            let word = words.next().unwrap_or_default();
            let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
            *coordinate = value.ok_or_else(|| ObjError::Number { line, expected, found: shown(word) })?;
        }
        if words.next().is_some() {
            *self.ignored.entry("weight or colour of a vertex".to_owned()).or_default() += 1;
        }
        if self.positions.len() >= MAX_ELEMENTS {
            return Err(ObjError::TooMany { line, what: "vertices", limit: MAX_ELEMENTS });
        }
        self.positions.push(DVec3::from_array(coordinates));
        Ok(())
    }

    /// Corners `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative numbers count back from the last vertex.
    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ObjError> {
        let count = self.positions.len();
        let mut corners = Vec::new();
        for word in words {
            let mut parts = word.split('/');
            let number = parts.next().unwrap_or_default();
            let expected = "a corner like 3, 3/1, 3//2 or 3/1/2";
            let wrong = || ObjError::Number { line, expected, found: shown(word) };
            let index: i64 = number.parse().map_err(|_| wrong())?;
            let others: Vec<&str> = parts.collect();
            if others.len() > 2 || others.iter().any(|part| !part.is_empty() && part.parse::<i64>().is_err())
            {
                return Err(wrong());
            }
            let place = if index < 0 { count as i64 + index } else { index - 1 };
            match u32::try_from(place) {
                Ok(place) if (place as usize) < count => corners.push(place),
                _ => return Err(ObjError::Index { line, found: shown(number), count }),
            }
            if corners.len() > MAX_CORNERS {
                return Err(ObjError::TooMany { line, what: "face corners", limit: MAX_CORNERS });
            }
        }
        if corners.len() < 3 {
            return Err(ObjError::ShortFace { line, found: corners.len() });
        }
        if self.faces.len() >= MAX_ELEMENTS {
            return Err(ObjError::TooMany { line, what: "faces", limit: MAX_ELEMENTS });
        }
        self.faces.push(corners);
        self.face_lines.push(line);
        Ok(())
    }
}

/// At most forty characters of what stands in the file.
fn shown(word: &str) -> String {
    if word.chars().count() <= SHOWN {
        word.to_owned()
    } else {
        word.chars().take(SHOWN).chain(['…']).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::mesh_shapes;
    use proptest::prelude::*;

    #[test]
    fn what_is_written_reads_back_bit_for_bit() {
        for (name, mesh) in mesh_shapes::named_shapes() {
            let read = read(write(&mesh).as_bytes()).unwrap();
            assert_eq!(read.mesh.positions(), mesh.positions(), "{name}");
            assert_eq!(read.mesh.topology(), mesh.topology(), "{name}");
            assert!(read.ignored.is_empty(), "{name}");
        }
    }

    #[test]
    fn all_forms_of_corners_comments_and_joined_lines_are_understood() {
        let text = "# a sheet\r\nmtllib x.mtl\nv 0 0 0 # first\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n\
                    g left\nf 1/1/1 2/1 3//1 \\\n -1\nusemtl a\n\nv 2 0 0\nv 2 1 0\nf 2 5 \\\n6 \\\n3\n";
        let ObjMesh { mesh, ignored } = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.counts(), [6, 7, 2, 1], "two squares");
        assert_eq!(mesh.topology().face(0), [0, 1, 2, 3], "−1 is the last vertex before the line");
        let counts: Vec<_> = ignored.iter().map(|(what, count)| format!("{what} {count}")).collect();
        assert_eq!(
            counts,
            ["g 1", "mtllib 1", "usemtl 1", "vn 1", "vt 1", "weight or colour of a vertex 1"],
            "ignored"
        );
    }

    #[test]
    fn errors_name_the_line_and_what_stands_there() {
        let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        for (text, expected) in [
            ("", "the file has no vertices"),
            ("v 0 0 0\n", "the file has no faces"),
            ("v 0 0\n", "line 1: expected a finite z coordinate, found \"\""),
            ("v 0 nan 0\n", "line 1: expected a finite y coordinate, found \"nan\""),
            ("v 0 0 1e999\n", "line 1: expected a finite z coordinate, found \"1e999\""),
            ("v 0 0 0\n<html>\n", "line 2: \"<html>\" starts no OBJ statement"),
            ("S4 f 1 2 5\n", "line 1: \"S4\" starts no OBJ statement"),
            ("f 1 2 3\n", "line 1: there is no vertex 1; 0 are defined so far"),
        ] {
            assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected, "{text:?}");
        }
        for (face, expected) in [
            ("f 1 2\n", "line 5: a face with 2 corners; at least 3 are needed"),
            ("f\n", "line 5: a face with 0 corners; at least 3 are needed"),
            ("f 1 2 5\n", "line 5: there is no vertex 5; 4 are defined so far"),
            ("f 1 2 0\n", "line 5: there is no vertex 0; 4 are defined so far"),
            ("f 1 2 -5\n", "line 5: there is no vertex -5; 4 are defined so far"),
            ("f 1 2 4294967299\n", "line 5: there is no vertex 4294967299; 4 are defined so far"),
            (
                "f 1 2 99999999999999999999\n",
                "line 5: expected a corner like 3, 3/1, 3//2 or 3/1/2, found \"99999999999999999999\"",
            ),
            ("f 1 2 3/x\n", "line 5: expected a corner like 3, 3/1, 3//2 or 3/1/2, found \"3/x\""),
            ("f 1 2 3/1/1/1\n", "line 5: expected a corner like 3, 3/1, 3//2 or 3/1/2, found \"3/1/1/1\""),
            ("f 1 2 2\n", "line 5: face 0 has 2 distinct vertices among 3 corners"),
            ("f 1 2 3\nf 2 1 4\nf 1 2 4\n", "line 7: the edge 0-1 belongs to 3 faces: [0, 1, 2]"),
            (
                "f 1 2 3\nf 1 2 4\n",
                "line 6: the faces 0 and 1 both run from 0 to 1; one of them must be turned",
            ),
            ("f 1 2 3\n", "vertex 3 belongs to no face"),
        ] {
            let text = format!("{square}{face}");
            assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected, "{face:?}");
        }
        let binary = read(b"v 0 0 0\n\x80\xff").unwrap_err();
        assert_eq!(binary, ObjError::NotText { line: 2, byte: 0x80 }, "not UTF-8");
        assert_eq!(read(b"glTF\x00\x01").unwrap_err(), ObjError::NotText { line: 1, byte: 0 }, "a zero byte");
        let long = read(format!("v {} 0 0", "9x".repeat(10_000)).as_bytes()).unwrap_err().to_string();
        assert!(long.len() < 120, "long words are cut: {long}");
    }

    #[test]
    fn a_truncated_file_is_an_error_or_a_smaller_mesh_but_no_panic() {
        let text = write(&mesh_shapes::cube());
        for end in 0..text.len() {
            if let Ok(part) = read(&text.as_bytes()[..end]) {
                assert!(part.mesh.topology().face_count() <= 6, "cut at {end}");
            }
        }
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = read(&bytes);
        }

        #[test]
        fn any_statements_are_read_or_refused(
            lines in prop::collection::vec("(v|f|vt|g|\\\\|#) ?[-0-9./e ]{0,12}\\\\?", 0..30),
        ) {
            let _ = read(lines.join("\n").as_bytes());
        }
    }
}
