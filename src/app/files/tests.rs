//! The flows, in a window without a screen.

use std::fs;
use std::path::Path;

use eframe::egui::{Key, accesskit::Role};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;

use super::*;
use crate::app::test_bench;
use crate::document::Edit;

/// Files, their lab, and commands from outside as the window gives them.
struct Desk {
    files: Files,
    lab: Lab,
}

type Window = Harness<'static, Desk>;

fn window(directories: Directories) -> Window {
    let mut lab = test_bench::lab();
    let files = Files::in_directories(None, &mut lab, directories);
    let show = |ui: &mut Ui, desk: &mut Desk| {
        desk.files.ui(&mut desk.lab, ui);
        for command in std::mem::take(&mut desk.lab.commands) {
            desk.files.execute(command, &mut desk.lab, ui.ctx());
        }
    };
    let mut window = Harness::builder()
        .with_size([800.0, 600.0])
        .with_step_dt(0.25)
        .with_max_steps(16)
        .build_ui_state(show, Desk { files, lab });
    // An unsaved document makes the window wake for the keeper, so that it never comes to rest.
    steps(&mut window);
    window
}

fn steps(window: &mut Window) {
    window.run_steps(4);
}

fn command(window: &mut Window, command: Command) {
    window.state_mut().lab.commands.push(command);
    steps(window);
}

fn change(window: &mut Window) {
    let lab = &mut window.state_mut().lab;
    let object = lab.selection.object.unwrap();
    lab.edit(Edit::MovePoints { object, points: vec![1], delta: DVec2::new(0.25, -0.5) });
    steps(window);
}

fn press(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::Button, label).click();
    steps(window);
}

/// Types an absolute path into the dialog that is open, and Enter.
fn answer_with(window: &mut Window, path: &Path) {
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(&path.display().to_string());
    steps(window);
    window.key_press(Key::Enter);
    steps(window);
}

fn saved_scene(folder: &Path, name: &str) -> PathBuf {
    let (document, view) = document::first_scene();
    let path = folder.join(name);
    document::save(&path, &document, &view).unwrap();
    path
}

fn shown(window: &Window) -> &Document {
    window.state().lab.history.document()
}

#[test]
fn a_typed_path_opens_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved_scene(folder.path(), "scene.spline");
    let mut window = window(Directories::none());
    command(&mut window, Command::Open);
    answer_with(&mut window, &path);
    assert_eq!(shown(&window), &document::first_scene().0, "the document on the desk");
    assert_eq!(window.state().lab.path.as_deref(), Some(path.as_path()), "its file");
    assert!(!window.state().lab.is_modified(), "just opened");
    assert_eq!(window.state().files.recent().collect::<Vec<_>>(), [path], "recent files");
}

#[test]
fn a_damaged_file_gives_a_message_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved_scene(folder.path(), "scene.spline");
    let whole = fs::read_to_string(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 40]).unwrap();
    let mut window = window(Directories::none());
    change(&mut window);
    let before = shown(&window).clone();
    command(&mut window, Command::Open);
    answer_with(&mut window, &path);
    assert_eq!(shown(&window), &before, "the document on the desk");
    assert!(window.query_by_label("This file cannot be opened").is_some(), "no message");
    let line = window.query_by_label_contains("line ");
    assert!(line.is_some_and(|_| true), "the message names no line");
    press(&mut window, "OK");
    assert!(!window.state().files.is_asking(), "the message stays");
    assert!(window.state().lab.is_modified(), "the changes are still there");
}

#[test]
fn unsaved_changes_are_asked_about_and_cancel_keeps_them() {
    let mut window = window(Directories::none());
    change(&mut window);
    let before = shown(&window).clone();
    command(&mut window, Command::New);
    assert!(window.state().files.is_asking(), "no question");
    window.key_press(Key::Escape);
    steps(&mut window);
    assert_eq!(shown(&window), &before, "after Escape");
    command(&mut window, Command::New);
    press(&mut window, "Cancel");
    assert_eq!(shown(&window), &before, "after Cancel");
    command(&mut window, Command::New);
    press(&mut window, "Don't save");
    assert!(shown(&window).is_empty(), "a new document has {} objects", shown(&window).len());
}

#[test]
fn saving_from_the_question_writes_the_file_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.spline");
    let mut window = window(Directories::none());
    change(&mut window);
    let before = shown(&window).clone();
    command(&mut window, Command::New);
    press(&mut window, "Save as…");
    answer_with(&mut window, &path);
    assert!(shown(&window).is_empty(), "the new document did not come");
    assert_eq!(document::load(&path).unwrap().document, before, "what was saved");
}

#[test]
fn without_changes_nothing_is_asked() {
    let mut window = window(Directories::none());
    command(&mut window, Command::New);
    assert!(!window.state().files.is_asking() && shown(&window).is_empty(), "a question about nothing");
}

#[test]
fn a_figure_opens_again_as_the_document_it_shows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("figure.svg");
    let mut window = window(Directories::none());
    window.state_mut().lab.at_once = true;
    let before = shown(&window).clone();
    command(&mut window, Command::ExportFigure);
    answer_with(&mut window, &path);
    assert!(path.exists(), "no figure was written: {:?}", window.state().files.problems);
    command(&mut window, Command::New);
    command(&mut window, Command::Open);
    answer_with(&mut window, &path);
    assert_eq!(shown(&window), &before, "the document in the figure");
    assert_eq!(window.state().lab.path, None, "saving must not write over the figure");
}

#[test]
fn frames_are_written_as_numbered_files_one_document_or_a_slide() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(Directories::none());
    window.state_mut().lab.at_once = true;
    window.state_mut().lab.view.stepper = document::StepperKind::KnotInsertion;
    let count = window.state().lab.scheme().unwrap().frames().len();
    for (name, expected) in [("steps.svg", count), ("steps.pdf", 1), ("steps.tex", 1)] {
        let before = fs::read_dir(folder.path()).unwrap().count();
        command(&mut window, Command::ExportFrames);
        answer_with(&mut window, &folder.path().join(name));
        let written = fs::read_dir(folder.path()).unwrap().count() - before;
        assert_eq!(written, expected, "{name}: {:?}", window.state().files.problems);
    }
    assert!(folder.path().join("steps-01.svg").exists(), "numbered");
    command(&mut window, Command::ExportFrames);
    answer_with(&mut window, &folder.path().join("steps.doc"));
    assert!(window.query_by_label_contains(".tex").is_some(), "the possible endings are named");
}

#[test]
fn a_mesh_is_exported_and_imported_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.obj");
    let mut window = window(Directories::none());
    let lab = &mut window.state_mut().lab;
    lab.at_once = true;
    let cube = crate::core::surface::mesh_shapes::cube();
    let mesh = document::MeshObject::from_cage(cube, document::MeshDisplay::default()).unwrap();
    let content = document::Content::Mesh(mesh.with_level(2).unwrap());
    let made = lab.edit(Edit::AddObject { name: "Cube".into(), content }).unwrap();
    lab.select(made.created[0]);
    command(&mut window, Command::ExportMesh);
    answer_with(&mut window, &path);
    command(&mut window, Command::ImportMesh);
    answer_with(&mut window, &path);
    let objects = shown(&window).objects();
    let read = objects.last().unwrap().mesh().unwrap();
    let refined = objects[objects.len() - 2].mesh().unwrap().steps().unwrap().pop().unwrap().mesh;
    assert_eq!(read.cage().positions(), refined.positions(), "the vertices of level 2");
    fs::write(&path, "v 0 0 0\nv 1 0\n").unwrap();
    command(&mut window, Command::ImportMesh);
    answer_with(&mut window, &path);
    assert!(window.query_by_label_contains("line 2").is_some(), "a damaged file is named with its line");
}

#[test]
fn a_job_that_is_given_up_hears_of_it_and_changes_nothing() {
    let mut window = window(Directories::none());
    let before = shown(&window).clone();
    let (tell, heard) = std::sync::mpsc::channel();
    let ctx = window.ctx.clone();
    let Desk { files, lab } = window.state_mut();
    files.start_job("Reading".into(), lab, &ctx, move |watcher| {
        while watcher.hear(0.5) {
            std::thread::yield_now();
        }
        tell.send(()).unwrap();
        Box::new(|_, lab| {
            drop(lab.edit(Edit::RemoveObjects { objects: vec![lab.selection.object.unwrap()] }));
        })
    });
    files.job = None;
    heard.recv().expect("the work ended because it was told to");
    steps(&mut window);
    assert_eq!(shown(&window), &before, "nothing was changed");
}

#[test]
fn the_own_document_and_work_on_a_lesson_wait_for_each_other() {
    let mut window = window(Directories::none());
    change(&mut window);
    let own = shown(&window).clone();
    let lab = &mut window.state_mut().lab;
    open_lesson(lab, 0);
    let lesson = lab.history.document().clone();
    assert_ne!(lesson, own, "the lesson's document");
    change(&mut window);
    let worked_on = shown(&window).clone();
    let lab = &mut window.state_mut().lab;
    assert!(back_to_document(lab), "there is a document to go back to");
    assert_eq!(lab.history.document(), &own, "the own document");
    assert!(lab.history.undo_name().is_some(), "its undo");
    open_lesson(lab, 0);
    assert_eq!(lab.history.document(), &worked_on, "the work on the lesson");
    back_to_example(lab);
    assert_eq!(lab.history.document(), &lesson, "the lesson from its beginning");
    assert_eq!(lab.history.undo_name(), Some("Back to the example"), "one step");
    lab.history.undo();
    assert_eq!(lab.history.document(), &worked_on, "and the work on it is not lost");
    back_to_example(lab);
    open_lesson(lab, usize::MAX);
    assert_eq!(lab.history.document(), &lesson, "there is no such lesson");
}

#[test]
fn leaving_asks_about_every_document_with_changes() {
    let mut window = window(Directories::none());
    change(&mut window);
    open_lesson(&mut window.state_mut().lab, 0);
    change(&mut window);
    command(&mut window, Command::Quit);
    press(&mut window, "Don't save");
    assert!(!window.state().files.leaving, "the own document was not asked about");
    assert!(window.state().lab.lesson.is_none(), "the own document is shown with the question");
    press(&mut window, "Don't save");
    assert!(window.state().files.leaving, "still here");
}

#[test]
fn after_a_crash_the_document_is_offered_and_brought_back() {
    let folder = tempfile::tempdir().unwrap();
    let directories = Directories { config: None, state: Some(folder.path().to_owned()) };
    let mut first = window(directories.clone());
    change(&mut first);
    let lost = shown(&first).clone();
    // Three seconds of rest, and the thread's time to write.
    first.run_steps(16);
    // A crash: the desk is gone without having been closed. Dropping it ends the thread, which gives up its lock.
    drop(first);
    let mut second = None;
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(20));
        let window = window(directories.clone());
        if window.state().files.has_recovered() {
            second = Some(window);
            break;
        }
    }
    let mut second = second.expect("a document is offered");
    assert!(second.query_by_label("One document can be brought back.").is_some(), "the offer");
    press(&mut second, "Open Untitled, 1");
    assert_eq!(shown(&second), &lost, "what was brought back");
    assert!(second.state().lab.is_modified(), "it is in no file yet");
    assert!(!second.state().files.is_asking(), "the offer stays open");
    let Desk { files, lab } = second.state_mut();
    files.leaving = true;
    files.close(lab);
    assert!(!window(directories).state().files.has_recovered(), "given up, and offered again");
}

#[test]
fn preferences_come_back_at_the_next_start() {
    let folder = tempfile::tempdir().unwrap();
    let directories = Directories { config: Some(folder.path().to_owned()), state: None };
    let path = saved_scene(folder.path(), "scene.spline");
    let mut first = window(directories.clone());
    first.state_mut().lab.theme = Theme::dark();
    first.state_mut().files.ask_to_open(path.clone());
    first.state_mut().files.note_panel_size("left", 231.0);
    steps(&mut first);
    let Desk { files, lab } = first.state_mut();
    files.close(lab);
    let second = window(directories);
    assert_eq!(second.state().lab.theme.name, "dark", "the look");
    assert_eq!(second.state().files.recent().collect::<Vec<_>>(), [path], "recent files");
    assert_eq!(second.state().files.panel_size("left", 184.0), 231.0, "size of a panel");
}

#[test]
fn every_file_command_is_taken_and_no_other() {
    let mut lab = test_bench::lab();
    let mut files = Files::in_directories(None, &mut lab, Directories::none());
    let ctx = Context::default();
    for command in Command::ALL {
        let is_file = command.menu() == crate::app::command::Menu::File;
        assert_eq!(files.execute(command, &mut lab, &ctx), is_file, "{command:?}");
    }
}

#[test]
fn a_chart_is_written_as_a_figure_with_its_document_and_as_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(Directories::none());
    window.state_mut().lab.at_once = true;
    window.state_mut().lab.charts.over_length = true;
    let before = shown(&window).clone();
    for ending in ["svg", "pdf", "png", "tex", "csv"] {
        let path = folder.path().join(format!("chart.{ending}"));
        command(&mut window, Command::ExportChart);
        answer_with(&mut window, &path);
        assert!(path.exists(), "{ending}: {:?}", window.state().files.problems);
    }
    let svg = fs::read_to_string(folder.path().join("chart.svg")).unwrap();
    assert!(svg.contains("arc length s") && svg.contains("Curvature κ of Wave"), "the names of the axes");
    let table = fs::read_to_string(folder.path().join("chart.csv")).unwrap();
    assert_eq!(table.lines().next(), Some("t,s,x,y,speed,curvature"), "the titles");
    assert!(table.lines().count() > 100, "{} lines", table.lines().count());
    command(&mut window, Command::ExportChart);
    answer_with(&mut window, &folder.path().join("chart.doc"));
    assert!(window.query_by_label_contains(".csv").is_some(), "the possible endings are named");
    window.state_mut().files.problems.clear();
    command(&mut window, Command::New);
    command(&mut window, Command::Open);
    answer_with(&mut window, &folder.path().join("chart.svg"));
    assert_eq!(shown(&window), &before, "the document in the figure");
}
