//! A triangular scheme told step by step: its numbers as a table, and frames with a sentence and a formula each.
//!
//! Entry `(i, j)` is entry `j` of level `i` of a [`TriangularScheme`]. Its name is `c_k` on level 0 and `p_k^i` above.
//! The index `k` follows the algorithm: de Boor names an entry after its right parent, de Casteljau after its left one.
//! For closed curves `k` is the index of the control point, so it starts again at 0 after the last one.
//!
//! Course: sections 2.2, 3.3 and 4.5.

mod de_boor;
mod narration;

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::point::Point;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::number_text::{short_number, short_point};

pub use de_boor::{de_boor_stepper, de_casteljau_stepper};

/// The algorithm that made a scheme, with what its formulas need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Algorithm<'a> {
    /// `pⁱ⁺¹ₖ = γ pⁱₖ + (1 − γ) pⁱₖ₋₁` with `γ = (t − ξₖ)/(ξₖ₊ₙ₋ᵢ − ξₖ)` and `ξ_span ≤ t ≤ ξ_span+1`.
    DeBoor {
        /// The knots that `span` counts.
        knots: &'a [f64],
        /// Index `l` of the knot interval.
        span: usize,
    },
    /// `pⁱ⁺¹ₖ = (1 − t) pⁱₖ + t pⁱₖ₊₁`.
    DeCasteljau,
}

/// What the numbers of a scheme mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchemeContext<'a> {
    /// The algorithm.
    pub algorithm: Algorithm<'a>,
    /// The parameter.
    pub parameter: f64,
    /// Index of the coefficient in each entry of level 0.
    pub coefficients: &'a [usize],
    /// Weight of every entry of a rational scheme whose points are projected; `None` for a polynomial one.
    pub weights: Option<&'a [Vec<f64>]>,
}

/// One step of the story.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// A plain sentence or two.
    pub caption: String,
    /// The formula with its numbers, in the notation of `figure::formula`.
    pub formula: String,
    /// The entries `(level, position)` that appear with this frame and stay.
    pub reveals: Vec<(usize, usize)>,
    /// The entries `(level, position)` that this frame is about.
    pub highlights: Vec<(usize, usize)>,
}

/// One number or point of the triangular table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Level, from 0.
    pub level: usize,
    /// Position in its level, from 0.
    pub position: usize,
    /// The name as a formula: `c_3` or `p_4^2`.
    pub label: String,
    /// The name as plain text: `c₃` or `p₄²`.
    pub plain_label: String,
    /// The index `k` of the name.
    pub index: usize,
    /// Its coordinates, divided by the weight if the scheme is rational.
    pub coordinates: Vec<f64>,
    /// Its weight in a rational scheme.
    pub weight: Option<f64>,
    /// The value as texts: the coordinates, then the weight if there is one.
    pub texts: Vec<String>,
    /// The share of the right parent, of homogeneous points if rational; `None` on level 0.
    pub share: Option<f64>,
    /// Whether the point of the curve depends on this entry; at a knot some do not matter.
    pub needed: bool,
}

impl Entry {
    /// Level and position, which tie the entry to its point in the picture.
    pub fn tie(&self) -> (usize, usize) {
        (self.level, self.position)
    }

    /// The entry as a point of the plane; `None` if it is a number.
    pub fn point(&self) -> Option<DVec2> {
        match self.coordinates[..] {
            [x, y] => Some(DVec2::new(x, y)),
            _ => None,
        }
    }
}

/// A triangular scheme as a story in frames and a table of live numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepper {
    frames: Vec<Frame>,
    levels: Vec<Vec<Entry>>,
    apex: (usize, usize),
    tangent: Vec<f64>,
    note: Option<String>,
    parameter: f64,
}

impl Stepper {
    /// The story of `scheme`, which must be a full triangle: as many steps as it has points, less one.
    ///
    /// # Errors
    ///
    /// `Empty` without points; `SizeMismatch` if steps, coefficient indices, weights or knots do not fit the scheme;
    /// `DegreeZero` for a single point; `NonFinite` for the parameter.
    pub fn new<P: Point>(scheme: &TriangularScheme<P>, context: &SchemeContext) -> Result<Self, SplineError> {
        check(scheme, context)?;
        let shortcut = Shortcut::find(scheme.steps(), context);
        let levels: Vec<Vec<Entry>> = (0..=scheme.steps())
            .map(|i| (0..scheme.levels()[i].len()).map(|j| entry(scheme, context, &shortcut, i, j)).collect())
            .collect();
        let apex = shortcut.apex;
        let tangent = narration::tangent(&levels, context);
        let note = shortcut.note(context);
        let mut stepper =
            Self { frames: Vec::new(), levels, apex, tangent, note, parameter: context.parameter };
        stepper.frames = narration::frames(&stepper, context, &shortcut);
        Ok(stepper)
    }

    /// The frames: the active coefficients, one frame for each new entry row by row, the point with its tangent.
    ///
    /// At a knot the entries on which the point does not depend come together, before the last frame.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// All entries, level by level.
    pub fn table(&self) -> impl Iterator<Item = &Entry> {
        self.levels.iter().flatten()
    }

    /// The entries of each level.
    pub fn levels(&self) -> &[Vec<Entry>] {
        &self.levels
    }

    /// The entry at `(level, position)`.
    pub fn entry(&self, level: usize, position: usize) -> Option<&Entry> {
        self.levels.get(level)?.get(position)
    }

    /// The entries that are visible once frame `last` is shown, in the order of their appearance.
    pub fn revealed(&self, last: usize) -> Vec<(usize, usize)> {
        self.frames
            .iter()
            .take(last.saturating_add(1))
            .flat_map(|frame| frame.reveals.iter().copied())
            .collect()
    }

    /// Number of steps that reach the point: the degree `n`, or `n − μ` at a knot of multiplicity `μ`.
    pub fn steps_needed(&self) -> usize {
        self.apex.0
    }

    /// The entry that is the point of the curve.
    pub fn apex(&self) -> &Entry {
        &self.levels[self.apex.0][self.apex.1]
    }

    /// The first derivative with respect to the parameter, from the last two points; from the right at a knot
    /// (from the left at the right end).
    pub fn tangent(&self) -> &[f64] {
        &self.tangent
    }

    /// What is special at this parameter: at a knot fewer steps suffice.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// The parameter, reduced into one period for closed curves.
    pub fn parameter(&self) -> f64 {
        self.parameter
    }
}

/// Which entries the point depends on: at a knot of multiplicity `μ` the scheme ends after `n − μ` steps.
#[derive(Clone, Copy, Debug)]
struct Shortcut {
    degree: usize,
    /// `μ`; 0 inside a knot interval.
    multiplicity: usize,
    /// Whether the parameter is the right end of its interval.
    at_right_end: bool,
    apex: (usize, usize),
}

impl Shortcut {
    fn find(degree: usize, context: &SchemeContext) -> Self {
        let t = context.parameter;
        let same = |knot: &f64| *knot == t;
        let (left, right) = match context.algorithm {
            Algorithm::DeBoor { knots, span } => (
                knots[..=span].iter().rev().take_while(|knot| same(knot)).count(),
                knots[span + 1..].iter().take_while(|knot| same(knot)).count(),
            ),
            Algorithm::DeCasteljau => {
                (if same(&0.0) { degree } else { 0 }, if same(&1.0) { degree } else { 0 })
            }
        };
        let at_right_end = right > 0;
        let multiplicity = left.max(right).min(degree);
        let apex = (degree - multiplicity, if at_right_end { multiplicity } else { 0 });
        Self { degree, multiplicity, at_right_end, apex }
    }

    fn needs(&self, level: usize, position: usize) -> bool {
        let (last, first) = self.apex;
        level <= last && position >= first && position <= first + last - level
    }

    fn note(&self, context: &SchemeContext) -> Option<String> {
        let t = short_number(context.parameter);
        let (steps, degree) = (self.apex.0, self.degree);
        match (self.multiplicity, context.algorithm) {
            (0, _) => None,
            (_, Algorithm::DeCasteljau) => {
                Some(format!("t = {t} is an end of the interval: no step is needed."))
            }
            (multiplicity, Algorithm::DeBoor { .. }) => {
                let kind = narration::multiplicity_word(multiplicity);
                let suffice = match steps {
                    0 => "no step is needed".to_owned(),
                    1 => format!("1 step instead of {degree} suffices"),
                    several => format!("{several} steps instead of {degree} suffice"),
                };
                Some(format!("t = {t} is {kind} knot: {suffice}."))
            }
        }
    }
}

fn check<P: Point>(scheme: &TriangularScheme<P>, context: &SchemeContext) -> Result<(), SplineError> {
    let count = scheme.levels().first().map_or(0, Vec::len);
    let mismatch = |what, expected, found| Err(SplineError::SizeMismatch { what, expected, found });
    match count {
        0 => return Err(SplineError::Empty { what: "points" }),
        1 => return Err(SplineError::DegreeZero),
        _ => {}
    }
    if scheme.steps() != count - 1 {
        return mismatch("steps", count - 1, scheme.steps());
    }
    if context.coefficients.len() != count {
        return mismatch("coefficient indices", count, context.coefficients.len());
    }
    if !context.parameter.is_finite() {
        return Err(SplineError::NonFinite { what: "parameter", index: 0, value: context.parameter });
    }
    if let Some(weights) = context.weights {
        if weights.len() != count {
            return mismatch("levels of weights", count, weights.len());
        }
        if let Some(i) = (0..count).find(|&i| weights[i].len() != scheme.levels()[i].len()) {
            return mismatch("weights in a level", scheme.levels()[i].len(), weights[i].len());
        }
    }
    if let Algorithm::DeBoor { knots, span } = context.algorithm {
        let degree = count - 1;
        if span < degree || knots.len() <= span.saturating_add(degree) {
            return mismatch("knots", span.saturating_add(degree).saturating_add(1), knots.len());
        }
    }
    Ok(())
}

fn entry<P: Point>(
    scheme: &TriangularScheme<P>,
    context: &SchemeContext,
    shortcut: &Shortcut,
    level: usize,
    position: usize,
) -> Entry {
    let index = match context.algorithm {
        Algorithm::DeBoor { .. } => context.coefficients[level + position],
        Algorithm::DeCasteljau => context.coefficients[position],
    };
    let point = scheme.levels()[level][position];
    let coordinates: Vec<f64> = (0..P::DIMENSION).map(|axis| point.coordinate(axis)).collect();
    let weight = context.weights.map(|weights| weights[level][position]);
    let mut texts = vec![short_point(&coordinates)];
    texts.extend(weight.map(short_number));
    Entry {
        level,
        position,
        label: narration::formula_label(index, level),
        plain_label: narration::plain_label(index, level),
        index,
        coordinates,
        weight,
        texts,
        share: level.checked_sub(1).map(|below| scheme.weights()[below][position]),
        needed: shortcut.needs(level, position),
    }
}
