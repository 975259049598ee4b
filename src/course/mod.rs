//! Lessons, steppers and questions: what the course says and asks, without a window.
//!
//! - [`mod@stepper`]: a triangular scheme told entry by entry, with sentences and formulas;
//! - [`lesson`]: the lessons of `assets/lessons/`, in the course's order;
//! - [`question`]: questions that the mathematics of the core checks;
//! - [`number_text`]: numbers as people write them.

pub mod lesson;
pub mod number_text;
pub mod question;
pub mod stepper;

pub use lesson::{Lesson, LessonError, TextPart, chapter_title, lessons, text_parts};
pub use question::{Answer, FitTask, Question, Task, Verdict};
pub use stepper::{Entry, Frame, Stepper, StepperKind, de_boor_stepper, stepper};
