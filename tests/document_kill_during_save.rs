//! Killing the program while it saves loses nothing: the file is always one of the documents, whole.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use glam::DVec2;
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::document::{CurveDisplay, Document, Edit, View, load, save};

const TARGET: &str = "SPLINE_LAB_TEST_SAVE_TARGET";

/// A document large enough that a kill often falls into the writing.
fn document(name: &str, count: usize) -> Document {
    let knots = (0..count + 4).map(|k| k as f64).collect();
    let points = (0..count).map(|k| DVec2::new((k as f64 * 0.1).sin(), (k as f64 * 0.37).cos())).collect();
    let curve = Nurbs::polynomial(SplineSpace::new(3, knots).unwrap(), points).unwrap();
    let mut document = Document::new();
    let display = CurveDisplay::default();
    document.apply(&Edit::AddCurve { name: name.to_owned(), curve, display }).unwrap();
    document
}

fn both() -> [Document; 2] {
    [document("First", 400), document("Second", 700)]
}

/// What the killed process does. Started as a test of its own it has nothing to do.
#[test]
fn child_saves_until_it_is_killed() {
    let Some(target) = std::env::var_os(TARGET) else {
        return;
    };
    let documents = both();
    let until = Instant::now() + Duration::from_secs(20);
    while Instant::now() < until {
        for document in &documents {
            save(Path::new(&target), document, &View::default()).unwrap();
        }
    }
}

/// Waits until the file has been replaced `count` times, or 2 seconds.
fn wait_for_saves(path: &Path, count: u64) {
    let stamp = || std::fs::metadata(path).and_then(|data| data.modified()).unwrap();
    let (mut last, mut seen, until) = (stamp(), 0, Instant::now() + Duration::from_secs(2));
    while seen < count && Instant::now() < until {
        std::thread::sleep(Duration::from_micros(100));
        let now = stamp();
        seen += u64::from(now != last);
        last = now;
    }
}

#[test]
fn killing_a_saving_process_leaves_one_of_both_documents_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("scene.spline");
    let documents = both();
    save(&path, &documents[0], &View::default()).unwrap();
    let (mut seen, mut interrupted) = ([0, 0], 0);
    for round in 0..40_u64 {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["child_saves_until_it_is_killed", "--exact", "--test-threads=1"])
            .env(TARGET, &path)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // From before the first save to the middle of the third one.
        wait_for_saves(&path, round % 3);
        std::thread::sleep(Duration::from_micros(round * 7919 % 4000));
        child.kill().unwrap();
        child.wait().unwrap();
        let loaded = load(&path).unwrap_or_else(|error| panic!("round {round}: {error}"));
        let which = documents.iter().position(|document| *document == loaded.document);
        let which = which.unwrap_or_else(|| panic!("round {round}: a document that was never saved"));
        seen[which] += 1;
        // A file left beside the target shows that the kill fell into a save.
        for entry in std::fs::read_dir(folder.path()).unwrap() {
            let left = entry.unwrap().path();
            if left != path {
                interrupted += 1;
                std::fs::remove_file(left).unwrap();
            }
        }
    }
    assert!(interrupted > 0, "no kill of 40 fell into a save; seen {seen:?}");
    assert!(seen[0] > 0 && seen[1] > 0, "both documents are seen: {seen:?}");
}
