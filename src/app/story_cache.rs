//! The story that was told last: several views ask for it in every frame, and it seldom changes.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use crate::course::stepper::{Stepper, stepper};
use crate::document::{Object, StepperChoices, StepperKind};

/// Keeps the last story with what it was made of.
#[derive(Debug, Default)]
pub struct StoryCache(RefCell<Option<Story>>);

#[derive(Debug)]
struct Story {
    object: Arc<Object>,
    kind: StepperKind,
    parameter: f64,
    choices: StepperChoices,
    told: Result<Rc<Stepper>, String>,
}

impl StoryCache {
    /// The story of the algorithm `kind` on a curve, or why there is none; `None` for other objects.
    pub(crate) fn told(
        &self,
        object: &Arc<Object>,
        kind: StepperKind,
        parameter: f64,
        choices: &StepperChoices,
    ) -> Option<Result<Rc<Stepper>, String>> {
        let mut last = self.0.borrow_mut();
        let is_same = |story: &&Story| {
            Arc::ptr_eq(&story.object, object)
                && (story.kind, story.parameter) == (kind, parameter)
                && story.choices == *choices
        };
        if let Some(story) = last.as_ref().filter(is_same) {
            return Some(story.told.clone());
        }
        let told = stepper(kind, object.curve()?, parameter, choices).map(Rc::new);
        let (object, choices) = (Arc::clone(object), choices.clone());
        *last = Some(Story { object, kind, parameter, choices, told: told.clone() });
        Some(told)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use crate::document::Edit;

    #[test]
    fn the_same_question_gets_the_same_story_and_a_changed_curve_another() {
        let mut lab = test_bench::lab();
        let first = lab.scheme().unwrap();
        assert!(Rc::ptr_eq(&first, &lab.scheme().unwrap()), "told once");
        let object = lab.selection.object.unwrap();
        lab.set_parameter(object, 1.25);
        let second = lab.scheme().unwrap();
        assert_ne!(first, second, "another parameter");
        lab.edit(Edit::InsertKnot { object, at: 0.5 });
        assert_ne!(second, lab.scheme().unwrap(), "another curve");
        lab.history.undo();
        assert_eq!(second, lab.scheme().unwrap(), "as before");
    }
}
