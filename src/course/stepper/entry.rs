//! One cell of the table of a stepper.

use glam::{DVec2, DVec3};

use crate::core::rational_bezier::Projective as _;
use crate::course::number_text::short_number;
use crate::course::stepper::Tie;
use crate::course::stepper::narration::Name;

/// An entry that another one is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parent {
    /// Its row and position.
    pub tie: Tie,
    /// What it is multiplied with.
    pub factor: f64,
}

/// One number or point of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Row, from 0.
    pub level: usize,
    /// Position in its row, from 0.
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
    /// The value as the table shows it, line by line.
    pub lines: Vec<String>,
    /// The share of the right parent, of homogeneous points if rational; `None` if it is no mixture of two.
    pub share: Option<f64>,
    /// Whether the result depends on this entry.
    pub needed: bool,
    /// What it is made of.
    pub parents: Vec<Parent>,
    /// The control point that it is, if it is one.
    pub control_point: Option<usize>,
    /// The control points that it depends on, or whose B-splines depend on it.
    pub partners: Vec<usize>,
    /// Its place in the plane, if it has one.
    pub at: Option<DVec2>,
    /// Its size in the plane; 1 is usual.
    pub size: f64,
    /// Whether it is a point of the drawing; its place may also be good for a ring only.
    pub is_drawn: bool,
}

impl Entry {
    /// A point, given in homogeneous coordinates; without a weight to show unless `rational`.
    pub(super) fn homogeneous(name: Name, value: DVec3, rational: bool) -> Self {
        let (point, weight) = if rational { DVec2::project(value) } else { (value.truncate(), 1.0) };
        let weight = rational.then_some(weight);
        let mut lines = vec![short_number(point.x), short_number(point.y)];
        lines.extend(weight.map(|weight| format!("w {}", short_number(weight))));
        Self {
            weight,
            at: Some(point).filter(|point| point.is_finite()),
            lines,
            ..Self::of(name, point.to_array().to_vec())
        }
    }

    /// A number, or several that are not a point.
    pub(super) fn numbers(name: Name, values: &[f64]) -> Self {
        let lines = values.iter().map(|&value| short_number(value)).collect();
        Self { lines, ..Self::of(name, values.to_vec()) }
    }

    fn of(name: Name, coordinates: Vec<f64>) -> Self {
        Self {
            level: 0,
            position: 0,
            label: name.formula(),
            plain_label: name.plain(),
            index: name.index,
            coordinates,
            weight: None,
            lines: Vec::new(),
            share: None,
            needed: true,
            parents: Vec::new(),
            control_point: None,
            partners: Vec::new(),
            at: None,
            size: 1.0,
            is_drawn: true,
        }
    }

    /// The entry is the control point `k`, which draws itself.
    #[must_use]
    pub(super) fn of_control_point(self, k: usize) -> Self {
        Self { control_point: Some(k), partners: vec![k], is_drawn: false, ..self }
    }

    /// The entry is `(1 − share)` of the entry at `position` of row `level` and `share` of the next one.
    #[must_use]
    pub(super) fn mixed(self, level: usize, position: usize, share: f64) -> Self {
        let parent = |position, factor| Parent { tie: (level, position), factor };
        let parents = vec![parent(position, 1.0 - share), parent(position + 1, share)];
        Self { share: Some(share), parents, ..self }
    }

    /// The value as a point of the plane; `None` if it is a number.
    pub fn point(&self) -> Option<DVec2> {
        match self.coordinates[..] {
            [x, y] => Some(DVec2::new(x, y)),
            _ => None,
        }
    }

    /// Row and position.
    pub fn tie(&self) -> Tie {
        (self.level, self.position)
    }
}
