//! Lessons come onto the desk and go; the person's own document and work on lessons are kept meanwhile.

use crate::app::lab::{Lab, LessonState, SidePage};
use crate::app::sheet::Sheet;

/// Opens lesson `index` of the course. The person's own document is put aside with its undo; a lesson that was worked
/// on before is as it was left. An index beyond the last lesson changes nothing.
pub(crate) fn open_lesson(lab: &mut Lab, index: usize) {
    let Some(lesson) = crate::course::lessons().into_iter().nth(index) else { return };
    if lab.lesson.as_ref().is_some_and(|state| state.index == index) {
        return;
    }
    let kept = lab.shelf.lessons.remove(&index);
    let sheet = kept.unwrap_or_else(|| Sheet::new(lesson.document.clone(), lesson.view.clone(), None));
    let before = lab.put(sheet);
    put_aside(lab, before);
    lab.lesson = Some(LessonState { index, lesson, answer: String::new(), verdict: None });
    lab.side = SidePage::Lesson;
}

/// Shows the open lesson as it was at first. One undo step would not do: the document is a new one.
pub(crate) fn restart_lesson(lab: &mut Lab) {
    if let Some(state) = &mut lab.lesson {
        state.answer.clear();
        state.verdict = None;
        let sheet = Sheet::new(state.lesson.document.clone(), state.lesson.view.clone(), None);
        lab.put(sheet);
    }
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
