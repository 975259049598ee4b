//! The program run as people run it, without a window.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use spline_lab::document::{self, first_scene};

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_spline-lab");
    Command::new(program).args(arguments).current_dir(folder).output().expect("the program can be started")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn folder_with_scene() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let (document, view) = first_scene();
    document::save(&folder.path().join("scene.spline"), &document, &view).expect("the scene is saved");
    folder
}

#[test]
fn check_lists_every_object() {
    let folder = folder_with_scene();
    let output = run(folder.path(), &["check", "scene.spline"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    for object in first_scene().0.objects() {
        assert!(said.contains(&object.name), "{} is missing in:\n{said}", object.name);
    }
}

#[test]
fn check_names_the_place_of_damage() {
    let folder = folder_with_scene();
    let whole = fs::read_to_string(folder.path().join("scene.spline")).expect("the scene");
    fs::write(folder.path().join("cut.spline"), &whole[..whole.len() / 2]).expect("a damaged copy");
    let output = run(folder.path(), &["check", "cut.spline"]);
    assert_eq!(output.status.code(), Some(1), "exit code");
    let said = text(&output.stderr);
    assert!(said.contains("cut.spline") && said.contains("line"), "no place in: {said}");
}

#[test]
fn a_document_goes_through_svg_and_back_unchanged() {
    let folder = folder_with_scene();
    for arguments in [["convert", "scene.spline", "scene.svg"], ["convert", "scene.svg", "back.spline"]] {
        let output = run(folder.path(), &arguments);
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    }
    let read = |name: &str| document::load(&folder.path().join(name)).expect("a document").document;
    assert_eq!(read("back.spline"), read("scene.spline"), "after the way through SVG");
}

#[test]
fn figures_have_the_format_of_their_ending() {
    let folder = folder_with_scene();
    for (name, start) in [
        ("figure.svg", &b"<?xml"[..]),
        ("figure.pdf", b"%PDF-"),
        ("figure.png", b"\x89PNG"),
        ("figure.tex", b"% A figure"),
    ] {
        for theme in ["light", "dark", "presentation"] {
            let output = run(
                folder.path(),
                &["figure", "scene.spline", "-o", name, "--width", "80", "--theme", theme],
            );
            assert!(output.status.success(), "{name} {theme}: {}", text(&output.stderr));
            let bytes = fs::read(folder.path().join(name)).expect("the figure");
            assert!(bytes.starts_with(start), "{name} starts with {:?}", &bytes[..8.min(bytes.len())]);
        }
    }
}

#[test]
fn frames_are_numbered_files_pages_or_overlays() {
    let folder = folder_with_scene();
    let frames = |output: &str, algorithm: &str| {
        run(folder.path(), &["figure", "scene.spline", "--frames", "--algorithm", algorithm, "-o", output])
    };
    let output = frames("steps.svg", "differentiation");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("steps-01.svg to steps-"), "{}", text(&output.stdout));
    let first = fs::read_to_string(folder.path().join("steps-01.svg")).expect("the first frame");
    let second = fs::read_to_string(folder.path().join("steps-02.svg")).expect("the second frame");
    assert!(first.contains("<svg") && first != second, "frames differ");
    assert!(frames("steps.pdf", "bezier-form").status.success(), "a PDF");
    assert!(fs::read(folder.path().join("steps.pdf")).expect("it").starts_with(b"%PDF"), "a PDF");
    assert!(frames("steps.tex", "blossom").status.success(), "a slide");
    let slide = fs::read_to_string(folder.path().join("steps.tex")).expect("the slide");
    assert!(slide.contains("\\only<1-1>") && slide.contains("\\begin{frame}"), "overlays");
    let outside =
        run(folder.path(), &["figure", "scene.spline", "--frames", "--at", "-7", "-o", "steps.svg"]);
    assert!(text(&outside.stderr).contains("-7 lies outside"), "{}", text(&outside.stderr));
    let refused = frames("steps.svg", "rational-de-casteljau");
    assert!(text(&refused.stderr).contains("weights are equal"), "{}", text(&refused.stderr));
    let unknown = frames("steps.svg", "de-moivre");
    assert!(text(&unknown.stderr).contains("knot-insertion"), "{}", text(&unknown.stderr));
}

#[test]
fn what_cannot_be_done_is_said_and_ends_with_1() {
    let folder = folder_with_scene();
    for (arguments, word) in [
        (&["convert", "scene.spline", "scene.obj"][..], ".svg"),
        (&["convert", "scene.spline", "scene.pdf"], "spline-lab figure"),
        (&["check", "missing.spline"], "missing.spline"),
        (&["check", "Cargo.toml"], ".spline"),
        (&["figure", "scene.spline", "-o", "figure.tiff"], ".pdf"),
        (&["figure", "scene.spline", "-o", "figure.svg", "--width", "0"], "width"),
        (&["figure", "scene.spline", "-o", "figure.svg", "--width=-3"], "width"),
        (&["figure", "scene.spline", "-o", "figure.png", "--scale", "NaN"], "resolution"),
    ] {
        let output = run(folder.path(), arguments);
        let said = text(&output.stderr);
        assert!(!output.status.success(), "{arguments:?} was done");
        assert!(said.contains(word), "{arguments:?} says {said:?} without {word:?}");
    }
}

#[test]
fn lessons_and_version_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let lessons = text(&run(folder.path(), &["lessons"]).stdout);
    assert!(lessons.contains("4.5"), "{lessons}");
    let version = text(&run(folder.path(), &["--version"]).stdout);
    assert!(version.contains(env!("CARGO_PKG_VERSION")), "{version}");
}
