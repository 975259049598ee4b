//! Lessons come onto the desk and go; the person's own document and work on lessons are kept meanwhile.

use crate::app::lab::{Lab, LessonState, SidePage, StepperState, Tool};
use crate::app::sheet::Sheet;
use crate::document::View;

/// Name of the undo step of [`back_to_example`].
const EXAMPLE_STEP: &str = "Back to the example";

/// Opens lesson `index` of the course. The person's own document is put aside with its undo; a lesson that was worked
/// on before is as it was left. An index beyond the last lesson changes nothing.
pub(crate) fn open_lesson(lab: &mut Lab, index: usize) {
    let Some(lesson) = crate::course::lessons().get(index) else { return };
    if lab.lesson.as_ref().is_some_and(|state| state.index == index) {
        return;
    }
    let kept = lab.shelf.lessons.remove(&index);
    let sheet = kept.unwrap_or_else(|| Sheet::new(lesson.document.clone(), lesson.view.clone(), None));
    let before = lab.put(sheet);
    put_aside(lab, before);
    lab.lesson = Some(LessonState { index, lesson: lesson.clone(), answer: String::new(), verdict: None });
    lab.side = SidePage::Lesson;
}

/// Shows the scene of the open lesson as it was at first. One undo step brings back what was there.
pub(crate) fn back_to_example(lab: &mut Lab) {
    let Some(state) = &mut lab.lesson else { return };
    state.answer.clear();
    state.verdict = None;
    let example = Sheet::new(state.lesson.document.clone(), state.lesson.view.clone(), None);
    lab.history.restore(EXAMPLE_STEP, example.history.document().clone());
    let panels = std::mem::take(&mut lab.view.panels);
    lab.view = View { panels, ..example.view };
    lab.selection = example.selection;
    lab.tool = Tool::Select;
    lab.stepper = StepperState { open: lab.stepper.open, ..StepperState::default() };
    lab.shape_note = None;
    lab.shelf.opened += 1;
}

/// Puts the person's own document back on the desk; `false` if none was put aside.
pub(crate) fn back_to_document(lab: &mut Lab) -> bool {
    let Some(own) = lab.shelf.own.take() else { return false };
    let lesson = lab.put(own);
    put_aside_lesson(lab, lesson);
    lab.lesson = None;
    if lab.side == SidePage::Lesson {
        lab.side = SidePage::Inspector;
    }
    true
}

/// Leaves the open lesson, if there is one, for the person's own document.
pub(super) fn leave(lab: &mut Lab) {
    back_to_document(lab);
}

/// Before the lab ends: puts a document with changes that is not on the desk onto it; `false` if there is none.
pub(super) fn next_with_changes(lab: &mut Lab) -> bool {
    if lab.shelf.own.as_ref().is_some_and(Sheet::is_modified) {
        return back_to_document(lab);
    }
    let lesson = lab.shelf.lessons.iter().find(|(_, sheet)| sheet.is_modified()).map(|(&index, _)| index);
    if let Some(index) = lesson {
        open_lesson(lab, index);
    }
    lesson.is_some()
}

fn put_aside(lab: &mut Lab, before: Sheet) {
    if lab.lesson.is_some() {
        put_aside_lesson(lab, before);
    } else {
        lab.shelf.own = Some(before);
    }
}

/// Work on a lesson is kept; a lesson as it came is not.
fn put_aside_lesson(lab: &mut Lab, sheet: Sheet) {
    if let Some(state) = &lab.lesson
        && (sheet.is_modified() || sheet.path.is_some())
    {
        lab.shelf.lessons.insert(state.index, sheet);
    }
}
