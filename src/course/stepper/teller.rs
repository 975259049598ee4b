//! What the stories have in common: a curve in homogeneous coordinates, and a table that grows row by row with its frames.

use glam::{DVec2, DVec3};

use crate::core::bspline::{Spline, SplineError};
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::stepper::narration::{Name, Shares, mixture};
use crate::course::stepper::{Entry, Frame, Look, Stepper, StepperKind, Tie};
use crate::figure::composition::{StepDrawing, StepInk};

/// A curve in homogeneous coordinates; those of a polynomial one have the weight 1.
pub(super) struct Net {
    pub(super) spline: Spline<DVec3>,
    pub(super) rational: bool,
}

impl Net {
    pub(super) fn of(curve: &Nurbs<DVec2>) -> Result<Self, SplineError> {
        if curve.is_polynomial() {
            let points = curve.points().iter().map(|point| point.extend(1.0)).collect();
            return Ok(Self { spline: Spline::new(curve.space().clone(), points)?, rational: false });
        }
        Ok(Self { spline: curve.homogeneous().clone(), rational: true })
    }

    /// The point of the plane; the weight 1 of a polynomial curve is not divided by, since it may be rounded.
    pub(super) fn place(&self, value: DVec3) -> DVec2 {
        if self.rational { DVec2::project(value).0 } else { value.truncate() }
    }

    /// The control polygon of `spline` as a line, closed if the curve is.
    pub(super) fn polygon(&self, spline: &Spline<DVec3>) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = spline.coefficients().iter().map(|&value| self.place(value)).collect();
        if spline.space().is_periodic() {
            points.extend(points.first().copied());
        }
        points
    }

    /// The active control points over the knot interval `span`, as entries.
    pub(super) fn active(&self, span: usize, count: usize) -> Vec<Entry> {
        let first = span - self.spline.degree();
        (first..first + count).map(|k| self.control_point(self.spline.space().coefficient_index(k))).collect()
    }

    /// The control point `k` as an entry.
    pub(super) fn control_point(&self, k: usize) -> Entry {
        let value = self.spline.coefficients()[k];
        Entry::homogeneous(Name::new('c', k, None), value, self.rational).of_control_point(k)
    }
}

/// A story in the making.
#[derive(Default)]
pub(super) struct Teller {
    pub(super) levels: Vec<Vec<Entry>>,
    pub(super) frames: Vec<Frame>,
    pub(super) tangent: Option<DVec2>,
    pub(super) note: Option<String>,
    pub(super) look: Look,
}

impl Teller {
    /// Adds a row; entries that say nothing else depend on the control points of their parents.
    pub(super) fn row(&mut self, entries: Vec<Entry>) -> Vec<Tie> {
        let level = self.levels.len();
        let mut row = Vec::with_capacity(entries.len());
        for (position, mut entry) in entries.into_iter().enumerate() {
            (entry.level, entry.position) = (level, position);
            if entry.partners.is_empty() {
                let parents = entry.parents.iter().map(|parent| parent.tie);
                let mut partners: Vec<usize> = parents
                    .filter_map(|(level, position)| self.levels.get(level)?.get(position))
                    .flat_map(|parent| parent.partners.iter().copied())
                    .collect();
                partners.sort_unstable();
                partners.dedup();
                entry.partners = partners;
            }
            row.push(entry);
        }
        let ties = row.iter().map(Entry::tie).collect();
        self.levels.push(row);
        ties
    }

    /// Adds rows for the levels of `scheme` above its first, which is the last row so far.
    pub(super) fn scheme(
        &mut self,
        scheme: &TriangularScheme<DVec3>,
        rational: bool,
        name: impl Fn(usize, usize) -> Name,
    ) {
        for (level, row) in scheme.levels().iter().enumerate().skip(1) {
            let below = self.levels.len() - 1;
            let entry = |(position, &value): (usize, &DVec3)| {
                let share = scheme.weights()[level - 1][position];
                Entry::homogeneous(name(level, position), value, rational).mixed(below, position, share)
            };
            let entries = row.iter().enumerate().map(entry).collect();
            self.row(entries);
        }
    }

    /// Adds a frame that draws nothing but its entries.
    pub(super) fn tell(&mut self, caption: String, formula: String, reveals: Vec<Tie>, highlights: Vec<Tie>) {
        self.frames.push(Frame { caption, formula, reveals, highlights, drawing: StepDrawing::default() });
    }

    /// Draws something in the last frame.
    pub(super) fn draw(&mut self, drawing: impl FnOnce(StepDrawing) -> StepDrawing) {
        if let Some(frame) = self.frames.last_mut() {
            frame.drawing = drawing(std::mem::take(&mut frame.drawing));
        }
    }

    /// Draws the tangent at `point` in the last frame, no longer than `length`.
    pub(super) fn draw_tangent(&mut self, point: DVec2, tangent: DVec2, length: f64) {
        let along = tangent.normalize_or_zero() * tangent.length().min(length);
        if along != DVec2::ZERO {
            self.draw(|drawing| drawing.arrow(point, point + along, StepInk::Result, 2.0));
        }
    }

    /// Adds the frame that tells how the entry at `tie` is mixed from its two parents.
    pub(super) fn tell_mixture(&mut self, tie: Tie, shares: &Shares) {
        let entry = &self.levels[tie.0][tie.1];
        let [left, right] = entry.parents[..] else { return };
        let parent = |tie: Tie| &self.levels[tie.0][tie.1];
        let (caption, formula) = mixture(entry, parent(left.tie), parent(right.tie), shares);
        self.tell(caption, formula, vec![tie], vec![left.tie, right.tie, tie]);
    }

    /// Ends the story.
    pub(super) fn end(self, kind: StepperKind, parameter: f64, apex: Tie) -> Stepper {
        let Self { levels, frames, tangent, note, look } = self;
        Stepper { kind, frames, levels, apex, tangent, note, parameter, look }
    }
}

/// Largest extent of `points` in one direction.
pub(super) fn extent(points: &[DVec2]) -> f64 {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    (high - low).max_element().max(0.0)
}
