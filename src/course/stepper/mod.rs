//! Algorithms told step by step: their numbers as a table, and frames with a sentence, a formula and a drawing each.
//!
//! | file | section | |
//! |---|---|---|
//! | `de_casteljau` | 2.3 | division of the legs of a Bezier polygon |
//! | `bezier_subdivision` | 2.6 | both halves on the edges of that triangle |
//! | `rational_de_casteljau` | 3.3 | the same for points and weights |
//! | `recurrence` | 4.1 | B-splines of degree 0, 1, … at one parameter |
//! | `differentiation` | 4.2, 4.5 | differences of control points and the derivative |
//! | `de_boor` | 4.5 | mixing of the active control points |
//! | `knot_insertion` | 6.3 | the control points for one knot more |
//! | `uniform_subdivision` | 6.3 | doubling and averaging |
//! | `intersection` | 6.3 | where the curve meets a line |
//! | `bezier_form` | 6.4 | knots raised one by one |
//! | `blossom` | 6.4 | another argument in every step |
//!
//! Entry `(i, j)` is entry `j` of row `i` of the table. The index `k` of its name follows the algorithm: de Boor names an entry after its
//! right parent, de Casteljau after its left one. For closed curves `k` is the index of the control point, so it starts again at 0 after
//! the last one. Everything runs in homogeneous coordinates, so that weights need no other code.

mod bezier_form;
mod bezier_piece;
mod bezier_subdivision;
mod blossom;
mod de_boor;
mod de_casteljau;
mod differentiation;
mod entry;
mod intersection;
mod knot_insertion;
mod narration;
mod rational_de_casteljau;
mod recurrence;
#[cfg(test)]
mod samples;
mod teller;
mod uniform_subdivision;

use std::collections::BTreeSet;

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::document::StepperChoices;
use crate::figure::composition::{StepDot, StepDrawing, StepInk};

pub use crate::document::StepperKind;
pub use de_boor::de_boor_stepper;
pub use entry::{Entry, Parent};
pub use intersection::default_line;

/// Row and position of an entry, which tie it to its point in the picture.
pub type Tie = (usize, usize);

/// Points nearer to each other than this part of the extent of the control points share a name.
const CLOSE: f64 = 0.03;

/// One step of the story.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// A plain sentence or two.
    pub caption: String,
    /// The formula with its numbers, in the notation of `figure::formula`.
    pub formula: String,
    /// The entries that appear with this frame and stay.
    pub reveals: Vec<Tie>,
    /// The entries that this frame is about.
    pub highlights: Vec<Tie>,
    /// What this frame draws besides the entries.
    pub drawing: StepDrawing,
}

/// An algorithm as a story in frames and a table of live numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepper {
    kind: StepperKind,
    frames: Vec<Frame>,
    levels: Vec<Vec<Entry>>,
    apex: Tie,
    tangent: Option<DVec2>,
    note: Option<String>,
    parameter: f64,
    look: Look,
}

/// How the entries are drawn in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Look {
    /// Whether neighbours in a row are joined by lines.
    joined: bool,
    /// Whether the last entry of a row is joined to the first one.
    closed: bool,
    /// How many of the last rows are drawn beside row 0.
    depth: usize,
}

impl Default for Look {
    fn default() -> Self {
        Self { joined: true, closed: false, depth: usize::MAX }
    }
}

/// The story of the algorithm `kind` on `curve` at `parameter`.
///
/// # Errors
///
/// A sentence that says why the algorithm cannot be told here.
pub fn stepper(
    kind: StepperKind,
    curve: &Nurbs<DVec2>,
    parameter: f64,
    choices: &StepperChoices,
) -> Result<Stepper, String> {
    match kind {
        StepperKind::DeCasteljau => de_casteljau::story(curve, parameter),
        StepperKind::BezierSubdivision => bezier_subdivision::story(curve, parameter),
        StepperKind::RationalDeCasteljau => rational_de_casteljau::story(curve, parameter),
        StepperKind::Recurrence => recurrence::story(curve, parameter),
        StepperKind::Differentiation => differentiation::story(curve, parameter),
        StepperKind::DeBoor => de_boor_stepper(curve, parameter).map_err(|error| narration::sentence(&error)),
        StepperKind::KnotInsertion => knot_insertion::story(curve, parameter),
        StepperKind::UniformSubdivision => uniform_subdivision::story(curve, parameter),
        StepperKind::Intersection => intersection::story(curve, parameter, choices.line),
        StepperKind::BezierForm => bezier_form::story(curve, parameter),
        StepperKind::Blossom => blossom::story(curve, parameter, &choices.arguments),
    }
}

impl Stepper {
    /// The algorithm.
    pub fn kind(&self) -> StepperKind {
        self.kind
    }

    /// The frames; at least one.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// All entries, row by row.
    pub fn table(&self) -> impl Iterator<Item = &Entry> {
        self.levels.iter().flatten()
    }

    /// The entries of each row.
    pub fn levels(&self) -> &[Vec<Entry>] {
        &self.levels
    }

    /// The entry at `(level, position)`.
    pub fn entry(&self, level: usize, position: usize) -> Option<&Entry> {
        self.levels.get(level)?.get(position)
    }

    /// The entries that are visible once frame `last` is shown, in the order of their appearance.
    pub fn revealed(&self, last: usize) -> Vec<Tie> {
        self.frames
            .iter()
            .take(last.saturating_add(1))
            .flat_map(|frame| frame.reveals.iter().copied())
            .collect()
    }

    /// Number of steps that reach the result: for de Boor the degree `n`, or `n − μ` at a knot of multiplicity `μ`.
    pub fn steps_needed(&self) -> usize {
        self.apex.0
    }

    /// The entry that is the result.
    pub fn apex(&self) -> &Entry {
        &self.levels[self.apex.0][self.apex.1]
    }

    /// The first derivative with respect to the parameter, where the algorithm gives it; from the right at a knot
    /// (from the left at the right end).
    pub fn tangent(&self) -> Option<DVec2> {
        self.tangent
    }

    /// What is special at this parameter, for example that at a knot fewer steps suffice.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// The parameter, reduced into one period for closed curves.
    pub fn parameter(&self) -> f64 {
        self.parameter
    }

    /// What frame `index`, or the last one, shows in the plane.
    pub fn drawing(&self, index: usize) -> StepDrawing {
        let index = index.min(self.frames.len() - 1);
        let (frame, shown) = (&self.frames[index], self.revealed(index));
        let shown: BTreeSet<Tie> = shown.into_iter().collect();
        let newest = shown.iter().map(|&(level, _)| level).max().unwrap_or(0);
        let last = (self.levels.len() - 1).max(1);
        let mut drawing = StepDrawing::default();
        let place = |entry: &Entry| entry.at.filter(|_| shown.contains(&entry.tie()));
        let drawn = |level: usize| level == 0 || newest - level < self.look.depth;
        for (level, row) in self.levels.iter().enumerate().take(newest + 1).filter(|&(level, _)| drawn(level))
        {
            let (ink, width) = match level {
                0 => (StepInk::Muted, 3.0),
                _ => (StepInk::Level(level as f64 / last as f64), 1.5),
            };
            let joins = row.windows(2).map(|pair| [&pair[0], &pair[1]]);
            let closing = (self.look.closed && row.len() > 2).then(|| [&row[row.len() - 1], &row[0]]);
            for [from, to] in joins.chain(closing).filter(|_| self.look.joined) {
                if let Some((from, to)) = place(from).zip(place(to)) {
                    drawing = drawing.line(vec![from, to], ink, width);
                }
            }
            for entry in row.iter().filter(|entry| entry.is_drawn) {
                if let Some(at) = place(entry) {
                    let size = entry.size * if level == last { 10.0 } else { 6.0 };
                    drawing = drawing.dot(at, ink, size, None);
                }
            }
        }
        drawing.append(&frame.drawing);
        let told: Vec<&Entry> =
            frame.highlights.iter().filter_map(|&(level, position)| self.entry(level, position)).collect();
        let few = told.len() <= 5;
        // Names of points that lie almost on each other would only cover each other.
        let given: Vec<DVec2> = self.levels[0].iter().filter_map(|entry| entry.at).collect();
        let apart = CLOSE * teller::extent(&given);
        for (i, entry) in told.iter().enumerate() {
            let Some(at) = place(entry) else { continue };
            let is_covered =
                told[i + 1..].iter().filter_map(|other| place(other)).any(|other| other.distance(at) < apart);
            let label = (few && !is_covered && entry.control_point.is_none()).then(|| entry.label.clone());
            drawing.dots.push(StepDot { at, ink: StepInk::Result, size: 0.0, ring: few, label });
        }
        drawing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{all_curves, uniform, uniform_closed};

    /// Every story of every curve at an inner parameter, at a knot and at both ends.
    fn stories() -> Vec<(String, Stepper)> {
        let mut curves = all_curves();
        curves.retain(|curve| [1, 2, 3, 6, 12].contains(&curve.degree()));
        curves.extend([uniform(3, 7, true), uniform_closed(4, 5)]);
        let mut told = Vec::new();
        for curve in &curves {
            let (left, right) = curve.space().parameter_interval();
            let inner = curve.space().breaks()[curve.space().breaks().len() / 2];
            for kind in StepperKind::ALL {
                for t in [left, inner, left + 0.61 * (right - left), right] {
                    let name = format!("{kind:?}, degree {}, t = {t}", curve.degree());
                    match stepper(kind, curve, t, &StepperChoices::default()) {
                        Ok(stepper) => told.push((name, stepper)),
                        Err(reason) => {
                            assert!(reason.ends_with('.') && reason.len() > 20, "{name}: {reason}");
                        }
                    }
                }
            }
        }
        assert!(told.len() > 900, "most algorithms apply to most curves: {}", told.len());
        told
    }

    #[test]
    fn every_story_shows_everything_once_and_speaks_of_visible_entries_only() {
        for (name, stepper) in stories() {
            assert!(!stepper.frames().is_empty(), "{name}: frames");
            for (index, frame) in stepper.frames().iter().enumerate() {
                let visible: BTreeSet<Tie> = stepper.revealed(index).into_iter().collect();
                for tie in &frame.highlights {
                    assert!(visible.contains(tie), "{name}: frame {index} speaks of hidden {tie:?}");
                }
                assert!(frame.caption.ends_with('.'), "{name}: {}", frame.caption);
            }
            let mut all = stepper.revealed(usize::MAX - 1);
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            assert_eq!((all.len(), count), (stepper.table().count(), all.len()), "{name}: every entry once");
            for entry in stepper.table() {
                assert_eq!(
                    stepper.entry(entry.level, entry.position),
                    Some(entry),
                    "{name}: places of entries"
                );
                let above = |parent: &Parent| {
                    parent.tie.0 < entry.level && stepper.entry(parent.tie.0, parent.tie.1).is_some()
                };
                assert!(entry.parents.iter().all(above), "{name}: parents stand above");
            }
        }
    }

    #[test]
    fn every_entry_with_parents_is_made_of_them() {
        for (name, stepper) in stories() {
            for entry in stepper.table().filter(|entry| !entry.parents.is_empty()) {
                let lifted = |entry: &Entry| -> Vec<f64> {
                    let weight = entry.weight.unwrap_or(1.0);
                    let mut values: Vec<f64> = entry.coordinates.iter().map(|value| value * weight).collect();
                    values.extend(entry.weight);
                    values
                };
                let mut sum = vec![0.0; lifted(entry).len()];
                for parent in &entry.parents {
                    let values = lifted(stepper.entry(parent.tie.0, parent.tie.1).unwrap());
                    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += parent.factor * value);
                }
                for (found, expected) in lifted(entry).into_iter().zip(sum) {
                    let far = (found - expected).abs();
                    assert!(
                        far < 1e-9 * expected.abs().max(1.0),
                        "{name}: {} = {found}, {expected}",
                        entry.label
                    );
                }
            }
        }
    }

    #[test]
    fn every_formula_and_name_can_be_typeset() {
        for (name, stepper) in stories() {
            let labels = stepper.table().map(|entry| &entry.label);
            for source in stepper.frames().iter().map(|frame| &frame.formula).chain(labels) {
                if let Err(error) = crate::figure::formula::layout(source, 12.0) {
                    panic!("{name}: {source}: {error}");
                }
            }
        }
    }

    #[test]
    fn every_frame_draws_finite_lines_and_more_than_its_neighbour_or_other_things() {
        for (name, stepper) in stories() {
            for index in 0..stepper.frames().len() {
                let drawing = stepper.drawing(index);
                assert!(
                    !drawing.dots.is_empty() || !drawing.lines.is_empty(),
                    "{name}: frame {index} draws nothing"
                );
                assert!(drawing.dots.iter().all(|dot| dot.at.is_finite()), "{name}: dots of frame {index}");
                assert!(
                    index == 0 || drawing != stepper.drawing(index - 1),
                    "{name}: frame {index} looks the same"
                );
            }
        }
    }

    #[test]
    fn kinds_have_the_names_of_the_file_format() {
        for kind in StepperKind::ALL {
            let name = serde_json::to_string(&kind).unwrap();
            assert_eq!(name, format!("\"{}\"", kind.key()), "{kind:?}");
        }
        let view: crate::document::View = serde_json::from_str("{}").unwrap();
        assert_eq!(view.stepper, StepperKind::DeBoor, "the usual one");
    }

    #[test]
    fn extreme_numbers_are_told_or_refused_and_never_panic() {
        let weights = vec![1.0, 1e-8, 3.0, 2.0];
        let small = vec![-1e-9, 0.0, 0.0, 2e-9, 1e12, 1e12, 2e12];
        let equal: Vec<f64> = (0..7).map(|k| f64::from(k) * 1e-300).collect();
        for scale in [1e-300, 1.0, 1e150, 1e300] {
            for (knots, weights) in
                [(&small, vec![1.0; 4]), (&small, weights.clone()), (&equal, weights.clone())]
            {
                let points = [(-1.0, 1e-12), (3.0, -4.0), (5.0, 6.0), (-0.5, 0.0)]
                    .map(|(x, y)| DVec2::new(x, y) * scale);
                let space = crate::core::bspline::SplineSpace::new(2, knots.clone()).unwrap();
                let curve = Nurbs::new(space, points.to_vec(), weights).unwrap();
                let (left, right) = curve.space().parameter_interval();
                for kind in StepperKind::ALL {
                    for t in [left, left + 0.3 * (right - left), right, f64::NAN, 1e300] {
                        let Ok(stepper) = stepper(kind, &curve, t, &StepperChoices::default()) else {
                            continue;
                        };
                        for (index, frame) in stepper.frames().iter().enumerate() {
                            stepper.drawing(index);
                            let set = crate::figure::formula::layout(&frame.formula, 12.0);
                            assert!(set.is_ok(), "{kind:?} at {t}: {}", frame.formula);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn names_that_would_cover_each_other_are_left_out() {
        let curve = samples::bezier();
        let stepper = stepper(StepperKind::Intersection, &curve, 0.1, &StepperChoices::default()).unwrap();
        let names =
            |frame: usize| stepper.drawing(frame).dots.iter().filter(|dot| dot.label.is_some()).count();
        assert_eq!((names(1), names(9)), (3, 1), "three ends of a long interval, one of a short one");
    }

    #[test]
    fn the_algorithm_of_every_lesson_applies_to_its_curve() {
        let mut told = 0;
        for lesson in crate::course::lessons() {
            let Some(id) = lesson.view.selected_object else { continue };
            let Some(curve) = lesson.document.curve(id) else { continue };
            let t = crate::figure::composition::parameter_of(curve, lesson.view.parameters.get(&id).copied());
            let story = stepper(lesson.view.stepper, curve, t, &lesson.view.stepper_choices);
            assert!(story.is_ok(), "{}: {:?}: {}", lesson.heading(), lesson.view.stepper, story.unwrap_err());
            told += 1;
        }
        assert!(told >= 10, "lessons with a curve: {told}");
    }
}
