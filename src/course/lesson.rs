//! Lessons: one per section of the course, each a prepared document with a short text, things to try and a question.
//!
//! A lesson is a file of `assets/lessons/`, built into the program. Its `scene` is exactly what a document file of the
//! lab holds, so a scene can be made in the window and pasted. Inline formulas stand between dollar signs.

use std::sync::{Arc, OnceLock};

use serde::Deserialize;
use thiserror::Error;

use crate::course::question::Question;
use crate::document::{Document, FileError, ObjectId, View, from_json};

/// The lesson files in the course's order, with their names.
const FILES: [(&str, &str); 29] = [
    ("2.1-control-polygon.json", include_str!("../../assets/lessons/2.1-control-polygon.json")),
    (
        "2.2-properties-of-bezier-curves.json",
        include_str!("../../assets/lessons/2.2-properties-of-bezier-curves.json"),
    ),
    ("2.3-de-casteljau.json", include_str!("../../assets/lessons/2.3-de-casteljau.json")),
    ("2.4-differentiation.json", include_str!("../../assets/lessons/2.4-differentiation.json")),
    ("2.5-curvature.json", include_str!("../../assets/lessons/2.5-curvature.json")),
    ("2.6-subdivision.json", include_str!("../../assets/lessons/2.6-subdivision.json")),
    ("2.7-geometric-hermite.json", include_str!("../../assets/lessons/2.7-geometric-hermite.json")),
    ("3.1-weights.json", include_str!("../../assets/lessons/3.1-weights.json")),
    ("3.2-gravity.json", include_str!("../../assets/lessons/3.2-gravity.json")),
    (
        "3.3-homogeneous-coordinates.json",
        include_str!("../../assets/lessons/3.3-homogeneous-coordinates.json"),
    ),
    ("3.4-conics.json", include_str!("../../assets/lessons/3.4-conics.json")),
    ("4.1-recurrence.json", include_str!("../../assets/lessons/4.1-recurrence.json")),
    ("4.2-smoothness.json", include_str!("../../assets/lessons/4.2-smoothness.json")),
    ("4.3-polynomials.json", include_str!("../../assets/lessons/4.3-polynomials.json")),
    ("4.4-splines.json", include_str!("../../assets/lessons/4.4-splines.json")),
    ("4.5-de-boor.json", include_str!("../../assets/lessons/4.5-de-boor.json")),
    ("4.6-periodic-splines.json", include_str!("../../assets/lessons/4.6-periodic-splines.json")),
    ("5.1-schoenberg.json", include_str!("../../assets/lessons/5.1-schoenberg.json")),
    ("5.5-interpolation.json", include_str!("../../assets/lessons/5.5-interpolation.json")),
    ("5.6-smoothing.json", include_str!("../../assets/lessons/5.6-smoothing.json")),
    ("6.1-spline-curves.json", include_str!("../../assets/lessons/6.1-spline-curves.json")),
    (
        "6.2-distance-to-the-polygon.json",
        include_str!("../../assets/lessons/6.2-distance-to-the-polygon.json"),
    ),
    ("6.3-knot-insertion.json", include_str!("../../assets/lessons/6.3-knot-insertion.json")),
    ("6.4-bezier-form.json", include_str!("../../assets/lessons/6.4-bezier-form.json")),
    ("8.2-spline-surfaces.json", include_str!("../../assets/lessons/8.2-spline-surfaces.json")),
    ("8.3-subdivision-surfaces.json", include_str!("../../assets/lessons/8.3-subdivision-surfaces.json")),
    ("9.1-ritz-galerkin.json", include_str!("../../assets/lessons/9.1-ritz-galerkin.json")),
    ("9.2-weighted-b-splines.json", include_str!("../../assets/lessons/9.2-weighted-b-splines.json")),
    ("9.3-isogeometric-elements.json", include_str!("../../assets/lessons/9.3-isogeometric-elements.json")),
];

/// A lesson, ready to be opened.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// Section of the course, for example `4.5`.
    pub section: String,
    /// The title.
    pub title: String,
    /// The text; may contain formulas between dollar signs.
    pub paragraphs: Vec<String>,
    /// The formula that is set on a line of its own, after the first paragraph.
    pub display_formula: String,
    /// Things to do in the window; may contain formulas between dollar signs.
    pub things_to_try: Vec<String>,
    /// The question.
    pub question: Question,
    /// The prepared document.
    pub document: Document,
    /// How the document is looked at in the beginning.
    pub view: View,
}

/// Why a text is not a lesson.
#[derive(Debug, Error)]
pub enum LessonError {
    /// The text is not JSON or lacks a field; the place is named.
    #[error("the lesson cannot be read: {0}")]
    Unreadable(#[from] serde_path_to_error::Error<serde_json::Error>),
    /// The document of the lesson cannot be read.
    #[error("the scene of the lesson cannot be read: {0}")]
    Scene(#[from] FileError),
    /// A text has an opening dollar sign without a closing one.
    #[error("a formula is not closed in \u{201c}{text}\u{201d}")]
    OpenFormula {
        /// The text.
        text: String,
    },
    /// The question is about an object that the scene does not have.
    #[error("the question is about object {object}, which the scene does not have")]
    NoSuchObject {
        /// Number of the object.
        object: u64,
    },
}

/// A stretch of a text: words, or a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextPart {
    /// Words, as they stand.
    Words(String),
    /// A formula in the notation of `figure::formula`, without its dollar signs.
    Formula(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LessonFile {
    section: String,
    title: String,
    paragraphs: Vec<String>,
    display_formula: String,
    things_to_try: Vec<String>,
    question: Question,
    scene: serde_json::Value,
}

/// The lessons in the course's order.
pub fn lessons() -> &'static [Lesson] {
    static LESSONS: OnceLock<Vec<Lesson>> = OnceLock::new();
    // A test loads every file, so that none is missing here.
    LESSONS.get_or_init(|| FILES.iter().filter_map(|(_, text)| Lesson::from_json(text).ok()).collect())
}

impl Lesson {
    /// Reads a lesson file.
    ///
    /// # Errors
    ///
    /// [`LessonError`] with the place of the mistake.
    pub fn from_json(text: &str) -> Result<Self, LessonError> {
        let mut reader = serde_json::Deserializer::from_str(text);
        let file: LessonFile = serde_path_to_error::deserialize(&mut reader)?;
        let scene = from_json(&file.scene.to_string())?;
        let mut question = file.question;
        question.original = scene.document.curve(ObjectId(question.object)).cloned().map(Arc::new);
        let lesson = Self {
            section: file.section,
            title: file.title,
            paragraphs: file.paragraphs,
            display_formula: file.display_formula,
            things_to_try: file.things_to_try,
            question,
            document: scene.document,
            view: scene.view,
        };
        for text in lesson.texts() {
            text_parts(text)?;
        }
        let object = lesson.question.object;
        if !lesson.document.objects().iter().any(|candidate| candidate.id.0 == object) {
            return Err(LessonError::NoSuchObject { object });
        }
        Ok(lesson)
    }

    /// `4.5  De Boor's algorithm`.
    pub fn heading(&self) -> String {
        format!("{}  {}", self.section, self.title)
    }

    /// The number of the chapter.
    pub fn chapter(&self) -> usize {
        self.section.split('.').next().and_then(|number| number.parse().ok()).unwrap_or(0)
    }

    /// All texts that may contain inline formulas.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        let question = [self.question.prompt.as_str(), self.question.feedback.as_str()];
        self.paragraphs.iter().chain(&self.things_to_try).map(String::as_str).chain(question)
    }

    /// All formulas: the displayed one and those between dollar signs.
    pub fn formulas(&self) -> Vec<String> {
        let inline =
            self.texts().filter_map(|text| text_parts(text).ok()).flatten().filter_map(|part| match part {
                TextPart::Formula(formula) => Some(formula),
                TextPart::Words(_) => None,
            });
        std::iter::once(self.display_formula.clone()).chain(inline).collect()
    }
}

/// The title of a chapter of the course; empty if there is none with this number.
pub fn chapter_title(chapter: usize) -> &'static str {
    const TITLES: [&str; 9] = [
        "Polynomials",
        "Bézier curves",
        "Rational Bézier curves",
        "B-splines",
        "Approximation",
        "Spline curves",
        "Multivariate splines",
        "Surfaces and solids",
        "Finite elements",
    ];
    chapter.checked_sub(1).and_then(|index| TITLES.get(index)).copied().unwrap_or_default()
}

/// Divides a text at its dollar signs into words and formulas; empty stretches are left out.
///
/// # Errors
///
/// [`LessonError::OpenFormula`] if the number of dollar signs is odd.
pub fn text_parts(text: &str) -> Result<Vec<TextPart>, LessonError> {
    if text.matches('$').count() % 2 == 1 {
        return Err(LessonError::OpenFormula { text: text.to_owned() });
    }
    let parts = text.split('$').enumerate().filter(|(_, part)| !part.is_empty()).map(|(index, part)| {
        if index % 2 == 0 { TextPart::Words(part.to_owned()) } else { TextPart::Formula(part.to_owned()) }
    });
    Ok(parts.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::question::Answer;
    use crate::figure::formula::layout;

    #[test]
    fn every_lesson_file_loads() {
        for (name, text) in FILES {
            if let Err(error) = Lesson::from_json(text) {
                panic!("{name}: {error}");
            }
        }
        assert_eq!(lessons().len(), FILES.len(), "the list is complete");
    }

    #[test]
    fn every_formula_of_every_lesson_can_be_typeset() {
        for lesson in lessons() {
            for source in lesson.formulas() {
                if let Err(error) = layout(&source, 12.0) {
                    panic!("{}: {source}: {error}", lesson.section);
                }
            }
        }
    }

    #[test]
    fn file_names_begin_with_the_section_and_follow_the_course() {
        let place = |section: &str| -> Vec<u32> {
            section.split('.').map(|number| number.parse().expect("a section is made of numbers")).collect()
        };
        let mut last = Vec::new();
        for ((name, _), lesson) in FILES.iter().zip(lessons()) {
            assert!(
                name.starts_with(&format!("{}-", lesson.section)),
                "{name} is section {}",
                lesson.section
            );
            let this = place(&lesson.section);
            assert!(this > last, "{name} stands after a later section");
            last = this;
        }
    }

    #[test]
    fn every_lesson_is_short_and_gives_three_things_to_try() {
        for lesson in lessons() {
            let words: usize = lesson.paragraphs.iter().map(|text| text.split_whitespace().count()).sum();
            assert!((80..=260).contains(&words), "{}: {words} words", lesson.section);
            assert_eq!(lesson.things_to_try.len(), 3, "{}", lesson.section);
        }
    }

    #[test]
    fn display_formulas_fit_beside_the_picture() {
        let width = |lesson: &Lesson| layout(&lesson.display_formula, 14.0).unwrap().width;
        let wide: Vec<_> = lessons().iter().map(|lesson| (lesson.section.clone(), width(lesson))).collect();
        let wide: Vec<_> = wide.into_iter().filter(|&(_, width)| width >= 270.0).collect();
        assert!(wide.is_empty(), "wider than the panel, in pt: {wide:?}");
    }

    #[test]
    fn no_question_is_solved_at_the_start_and_every_number_is() {
        for lesson in lessons() {
            let (section, document) = (&lesson.section, &lesson.document);
            if let Some(number) = lesson.question.right_number(document) {
                let ask = |value: f64| lesson.question.check(document, &Answer::Text(value.to_string()));
                assert!(ask(number).correct, "{section}: {number}: {:?}", ask(number));
                for wrong in [number + 0.25, -number - 1.0] {
                    let verdict = ask(wrong);
                    assert!(!verdict.correct && !verdict.message.is_empty(), "{section}: {wrong}");
                }
                continue;
            }
            let origin = Answer::Point(glam::DVec2::ZERO);
            for answer in [Answer::Curve, origin, Answer::Text("1".to_owned())] {
                let verdict = lesson.question.check(document, &answer);
                assert!(!verdict.correct, "{section} is solved by {answer:?} before anything was done");
            }
        }
    }

    #[test]
    fn scenes_show_their_objects() {
        for lesson in lessons() {
            let (section, objects) = (&lesson.section, lesson.document.objects());
            assert!(!objects.is_empty(), "{section}: an empty scene");
            let selected = lesson.view.selected_object;
            assert!(selected.is_some_and(|id| lesson.document.object(id).is_some()), "{section}: selection");
            for (object, &t) in &lesson.view.parameters {
                let curve = lesson.document.curve(*object).expect("parameters are those of curves");
                assert!(curve.evaluate(t).is_ok(), "{section}: the parameter {t} of {object:?}");
            }
        }
    }

    #[test]
    fn lesson_4_5_shows_the_worked_example() {
        let all = lessons();
        let lesson = all.iter().find(|lesson| lesson.section == "4.5").expect("the lesson exists");
        let object = lesson.document.objects()[0].id;
        let curve = lesson.document.curve(object).unwrap();
        assert_eq!(
            curve.space().knots(),
            [0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 8.0, 8.0, 9.0],
            "the knots of example 4.5-a"
        );
        for (k, (point, average)) in curve.points().iter().zip(curve.space().greville_abscissae()).enumerate()
        {
            assert!(
                (point.x - average).abs() < 1e-14,
                "control point {k} stands at {} not {average}",
                point.x
            );
        }
        assert_eq!(lesson.view.parameters.get(&object), Some(&5.0), "t = 5 is set");
        let right = lesson.question.right_number(&lesson.document).unwrap();
        assert!((right - 2.0).abs() < 1e-14, "p_4^2 is {right}");
    }

    #[test]
    fn texts_are_divided_at_dollar_signs() {
        let parts = text_parts("At $t = 4$ a knot").unwrap();
        let expected = [
            TextPart::Words("At ".into()),
            TextPart::Formula("t = 4".into()),
            TextPart::Words(" a knot".into()),
        ];
        assert_eq!(parts, expected, "words, formula, words");
        assert!(text_parts("costs $5").is_err(), "an open formula");
    }

    #[test]
    fn mistakes_in_a_lesson_are_named() {
        let (_, good) =
            FILES.into_iter().find(|(name, _)| name.starts_with("4.5")).expect("the lesson exists");
        for (from, to, named) in [
            ("\"title\"", "\"titel\"", "titel"),
            ("\"object\": 1,", "\"object\": 77,", "77"),
            ("\"kind\": \"number\"", "\"kind\": \"riddle\"", "riddle"),
            ("$t = 5$", "$t = 5", "not closed"),
            ("\"feedback\"", "\"keep\": [\"colour\"],\n\"feedback\"", "colour"),
        ] {
            let bad = good.replacen(from, to, 1);
            assert_ne!(bad, good, "{from} stands in the lesson");
            let error = Lesson::from_json(&bad).expect_err("the lesson is damaged").to_string();
            assert!(error.contains(named), "{from} → {to}: {error}");
        }
    }
}
