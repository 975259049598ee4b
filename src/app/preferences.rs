//! What the lab remembers about the person who uses it: the look, recent files, sizes of panels.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// Name of the file in the configuration folder.
const FILE_NAME: &str = "preferences.json";

/// Most recent files that are remembered.
const RECENT_LIMIT: usize = 10;

/// Largest file that is read, in bytes. Ten paths and a few numbers need a few thousand.
const SIZE_LIMIT: u64 = 1 << 20;

/// Range of sizes of panels that are taken from the file, in logical pixels.
const PANEL_SIZES: std::ops::RangeInclusive<f32> = 40.0..=4000.0;

/// The preferences.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Preferences {
    /// Name of the look; empty for the standard one.
    pub(crate) theme: String,
    /// Recent files, the last used first.
    pub(crate) recent: Vec<String>,
    /// Widths of side panels and heights of others in logical pixels, by name.
    pub(crate) panel_sizes: BTreeMap<String, f32>,
}

impl Preferences {
    /// Puts `path` first among the recent files. A path that is not UTF-8 cannot be kept and is left out.
    pub(crate) fn add_recent(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        if let Some(text) = path.to_str() {
            self.recent.retain(|known| known != text);
            self.recent.insert(0, text.to_owned());
            self.recent.truncate(RECENT_LIMIT);
        }
    }

    /// Takes `path` from the recent files.
    pub(crate) fn forget_recent(&mut self, path: &Path) {
        self.recent.retain(|known| Path::new(known) != path);
    }

    fn keep_valid(mut self) -> Self {
        self.recent.truncate(RECENT_LIMIT);
        self.panel_sizes.retain(|_, size| PANEL_SIZES.contains(size));
        self
    }
}

/// Reads the preferences in `folder`; a missing file gives the standard ones.
///
/// A file that cannot be understood is kept beside under another name; the second result then says so.
pub(crate) fn load(folder: &Path) -> (Preferences, Option<String>) {
    let path = folder.join(FILE_NAME);
    let text = match read_limited(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return (Preferences::default(), None),
        Err(error) => return (Preferences::default(), Some(set_aside(&path, &error.to_string()))),
    };
    match serde_json::from_str::<Preferences>(&text) {
        Ok(preferences) => (preferences.keep_valid(), None),
        Err(error) => (Preferences::default(), Some(set_aside(&path, &error.to_string()))),
    }
}

/// Writes the preferences into `folder`: all of them or, on an error, none.
///
/// # Errors
///
/// What the file system reports.
pub(crate) fn save(folder: &Path, preferences: &Preferences) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut beside = tempfile::NamedTempFile::new_in(folder)?;
    serde_json::to_writer_pretty(&mut beside, preferences)?;
    beside.write_all(b"\n")?;
    beside.as_file().sync_all()?;
    beside.persist(folder.join(FILE_NAME)).map_err(|error| error.error)?;
    Ok(())
}

fn read_limited(path: &Path) -> io::Result<String> {
    let size = fs::metadata(path)?.len();
    if size > SIZE_LIMIT {
        return Err(io::Error::other(format!("{size} bytes are more than the limit of {SIZE_LIMIT}")));
    }
    fs::read_to_string(path)
}

/// Renames the file that could not be read, so that the next save does not write over it.
fn set_aside(path: &Path, reason: &str) -> String {
    let free = (1..1000)
        .map(|number| path.with_file_name(format!("preferences.damaged-{number}.json")))
        .find(|candidate| !candidate.exists());
    let kept = free.and_then(|kept: PathBuf| fs::rename(path, &kept).ok().map(|()| kept));
    let place = path.display();
    match kept {
        Some(kept) => format!(
            "The preferences in {place} could not be read: {reason}. The lab starts with the standard ones; \
             the file is kept as {}.",
            kept.display()
        ),
        None => format!(
            "The preferences in {place} could not be read: {reason}. The lab starts with the standard ones."
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_saved_is_loaded_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut preferences = Preferences { theme: "dark".to_owned(), ..Preferences::default() };
        preferences.add_recent(Path::new("/a/wave.spline"));
        preferences.panel_sizes.insert("left".to_owned(), 212.5);
        save(folder.path(), &preferences).unwrap();
        let (loaded, message) = load(folder.path());
        assert_eq!(loaded, preferences, "read back: {message:?}");
    }

    #[test]
    fn a_damaged_file_gives_the_standard_ones_and_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        for (number, damage) in ["{\"theme\": \"dar", "{\"theme\": 7}", "[7]", "\u{0}"].iter().enumerate() {
            fs::write(folder.path().join(FILE_NAME), damage).unwrap();
            let (loaded, message) = load(folder.path());
            assert_eq!(loaded, Preferences::default(), "from {damage:?}");
            let message = message.unwrap_or_default();
            assert!(message.contains("line 1"), "no place in {message:?}");
            let kept = folder.path().join(format!("preferences.damaged-{}.json", number + 1));
            assert_eq!(fs::read_to_string(&kept).unwrap(), *damage, "{} was not kept", kept.display());
        }
    }

    #[test]
    fn recent_files_are_ten_at_most_and_each_once() {
        let mut preferences = Preferences::default();
        for number in 0..25 {
            preferences.add_recent(Path::new(&format!("/a/{}.spline", number % 13)));
        }
        assert_eq!(preferences.recent.len(), RECENT_LIMIT, "{:?}", preferences.recent);
        assert_eq!(preferences.recent[0], "/a/11.spline", "the last one is first");
        let mut once = preferences.recent.clone();
        once.sort();
        once.dedup();
        assert_eq!(once.len(), preferences.recent.len(), "{:?}", preferences.recent);
    }

    #[test]
    fn sizes_that_no_panel_can_have_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(
            folder.path().join(FILE_NAME),
            r#"{"panel_sizes": {"left": 1e9, "right": -3, "knot_line": 160}}"#,
        )
        .unwrap();
        let (loaded, _) = load(folder.path());
        assert_eq!(
            loaded.panel_sizes.into_iter().collect::<Vec<_>>(),
            [("knot_line".to_owned(), 160.0)],
            "kept sizes"
        );
    }
}
