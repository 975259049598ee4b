//! Quadrature for the part of a grid's cells that lies in a domain.
//!
//! An inner cell takes a tensor product of Gauss rules. A cut cell is sliced: an outer coordinate is broken
//! where the boundary crosses the sides of the cell, where it has corners, and where it turns back; between
//! breaks, each line of constant outer coordinate meets the boundary in places that depend smoothly on that
//! coordinate. They are found to rounding, and Gauss rules in both directions keep the accuracy of smooth
//! integrands. The inner direction is the one in which the boundary is crossed at the better angle. Where a
//! curve runs nearly along both, over too large a turn, the cell is quartered (R. Saye, *High-order quadrature
//! methods for implicitly defined surfaces and volumes in hyperrectangles*, 2015).
//!
//! All weights are positive and all nodes lie in the domain. Course: section 9.4.

use glam::DVec2;
use rayon::prelude::*;

use crate::core::domain::{Bounds, CellClass, Domain, Primitive};
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::grid::Grid;
use crate::core::progress::Watcher;
use crate::core::quadrature::{GaussRule, gauss_legendre};

/// The smallest cosine between a curve's normal and the inner direction that is accepted without quartering: a
/// curve that violates it in both directions turns by more than 36 degrees in the cell.
const GOOD_ANGLE: f64 = 0.45;

/// Number of quarterings after which the better direction is taken in any case; the cell's area is then 6e-8 of
/// the whole.
const MAX_DEPTH: usize = 12;

/// Parts of a piece of the outer coordinate at which the number and succession of the boundary curves are compared.
const SAMPLES: [f64; 5] = [1e-6, 0.25, 0.5, 0.75, 1.0 - 1e-6];

/// Area, relative to the cell, below which a cut cell counts as outer.
const DROPPED: f64 = 1e-14;

/// A node with its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraturePoint {
    /// Where.
    pub point: DVec2,
    /// Its weight, positive.
    pub weight: f64,
}

/// A part of a cut cell that is sliced in one go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slice {
    /// The part: between two breaks of the outer coordinate, over the whole width in the inner direction.
    pub bounds: Bounds,
    /// The inner direction, 0 or 1, along which the lines to the boundary run.
    pub inner_axis: usize,
}

/// A cut cell with its nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SlicedCell {
    /// Nodes and weights.
    pub points: Vec<QuadraturePoint>,
    /// How it was divided.
    pub slices: Vec<Slice>,
    /// Points of the domain's boundary in the cell, where the lines through the nodes meet it.
    pub boundary: Vec<DVec2>,
    /// Whether no boundary was met: the cell is inner.
    pub is_full: bool,
}

/// Slices the part of `cell` in the domain, with `rule` in both directions.
pub fn slice_cell(domain: &Domain, cell: &Bounds, rule: &GaussRule) -> SlicedCell {
    let slicer = Slicer { domain, primitives: domain.primitives(), rule };
    let mut sliced = SlicedCell { is_full: true, ..SlicedCell::default() };
    slicer.slice(cell, 0, &mut sliced);
    sliced
}

/// Which cells are inner, cut and outer, and the nodes of the cut ones.
#[derive(Clone, Debug)]
pub struct QuadratureTable {
    grid: Grid,
    rule: GaussRule,
    classes: Vec<CellClass>,
    /// The nodes of cell `i` are `starts[i]..starts[i + 1]` of `points`; only cut cells have some.
    starts: Vec<usize>,
    points: Vec<QuadraturePoint>,
    boundary: Vec<DVec2>,
}

impl QuadratureTable {
    /// The table for the part of `grid` in the domain, with `gauss_points` in each direction of each piece.
    ///
    /// # Errors
    ///
    /// `Empty` or `StepLimit` (number of points), `EmptyDomain` if all cells are outer, `Stopped`.
    pub fn new(
        domain: &Domain,
        grid: Grid,
        gauss_points: usize,
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        let rule = gauss_legendre(gauss_points)?;
        let columns = grid.cells()[1];
        let row = |l1: usize| -> Result<Vec<(CellClass, SlicedCell)>, FiniteElementError> {
            watcher.check(l1 as f64 / grid.cells()[0] as f64)?;
            let one = |l2: usize| {
                let cell = grid.cell([l1, l2]);
                match domain.classify(&cell) {
                    CellClass::Cut => {}
                    class => return (class, SlicedCell::default()),
                }
                let sliced = slice_cell(domain, &cell, &rule);
                let area: f64 = sliced.points.iter().map(|p| p.weight).sum();
                if sliced.is_full {
                    (CellClass::Inner, SlicedCell::default())
                } else if area <= DROPPED * cell.size().element_product() {
                    (CellClass::Outer, SlicedCell::default())
                } else {
                    (CellClass::Cut, sliced)
                }
            };
            Ok((0..columns).map(one).collect())
        };
        let rows: Vec<_> = (0..grid.cells()[0]).into_par_iter().map(row).collect::<Result<_, _>>()?;
        let (mut classes, mut starts) = (Vec::new(), vec![0]);
        let (mut points, mut boundary) = (Vec::new(), Vec::new());
        for (class, sliced) in rows.into_iter().flatten() {
            classes.push(class);
            points.extend(sliced.points);
            boundary.extend(sliced.boundary);
            starts.push(points.len());
        }
        if classes.iter().all(|class| *class == CellClass::Outer) {
            return Err(FiniteElementError::EmptyDomain);
        }
        Ok(Self { grid, rule, classes, starts, points, boundary })
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The Gauss rule of every direction.
    pub fn rule(&self) -> &GaussRule {
        &self.rule
    }

    /// The classes of all cells, row-major.
    pub fn classes(&self) -> &[CellClass] {
        &self.classes
    }

    /// The class of cell `l`; outer beyond the grid.
    pub fn class(&self, l: [usize; 2]) -> CellClass {
        let [rows, columns] = self.grid.cells();
        if l[0] < rows && l[1] < columns { self.classes[l[0] * columns + l[1]] } else { CellClass::Outer }
    }

    /// Points of the domain's boundary, a few in each cut cell.
    pub fn boundary(&self) -> &[DVec2] {
        &self.boundary
    }

    /// The nodes of the cut cell with row-major index `index`; empty for others.
    pub fn cut_points(&self, index: usize) -> &[QuadraturePoint] {
        match (self.starts.get(index), self.starts.get(index.saturating_add(1))) {
            (Some(&from), Some(&to)) => &self.points[from..to],
            _ => &[],
        }
    }

    /// The cell with row-major index `index`.
    pub fn cell_of(&self, index: usize) -> [usize; 2] {
        [index / self.grid.cells()[1], index % self.grid.cells()[1]]
    }

    /// Calls `visit` with all nodes of the domain, cell by cell.
    pub fn for_each_point(&self, mut visit: impl FnMut(QuadraturePoint)) {
        for (index, class) in self.classes.iter().enumerate() {
            match class {
                CellClass::Outer => {}
                CellClass::Cut => self.cut_points(index).iter().for_each(|point| visit(*point)),
                CellClass::Inner => {
                    let cell = self.grid.cell(self.cell_of(index));
                    tensor_points(&cell, &self.rule, &mut visit);
                }
            }
        }
    }

    /// The integral of `f` over the domain.
    pub fn integrate(&self, f: impl Fn(DVec2) -> f64) -> f64 {
        let mut sum = 0.0;
        self.for_each_point(|p| sum += p.weight * f(p.point));
        sum
    }
}

/// Calls `visit` with the nodes of the tensor product rule on `cell`, the second coordinate running fastest.
pub(super) fn tensor_points(cell: &Bounds, rule: &GaussRule, mut visit: impl FnMut(QuadraturePoint)) {
    for (x, wx) in rule.on(cell.lower.x, cell.upper.x) {
        for (y, wy) in rule.on(cell.lower.y, cell.upper.y) {
            visit(QuadraturePoint { point: DVec2::new(x, y), weight: wx * wy });
        }
    }
}

struct Slicer<'a> {
    domain: &'a Domain,
    primitives: Vec<&'a Primitive>,
    rule: &'a GaussRule,
}

/// Index of the primitive at the end of an interval; this one for a side of the cell.
const CELL_SIDE: usize = usize::MAX;

/// A part of a line inside the domain, and whose boundaries end it.
#[derive(Clone, Copy)]
struct Interval {
    from: f64,
    to: f64,
    curves: [usize; 2],
}

/// The slicing of one cell in one direction.
struct Slicing {
    breaks: Vec<f64>,
    quality: f64,
    is_full: bool,
}

/// Lists that are used again and again.
#[derive(Default)]
struct Scratch {
    places: Vec<f64>,
    ends: Vec<(f64, usize)>,
    intervals: Vec<Interval>,
}

impl Slicer<'_> {
    fn slice(&self, cell: &Bounds, depth: usize, sliced: &mut SlicedCell) {
        let mut scratch = Scratch::default();
        let along = [0, 1].map(|inner| self.slicing(cell, inner, &mut scratch));
        if along.iter().all(|slicing| slicing.is_full) {
            return tensor_points(cell, self.rule, |point| sliced.points.push(point));
        }
        sliced.is_full = false;
        let inner = usize::from(along[1].quality >= along[0].quality);
        if along[inner].quality < GOOD_ANGLE && depth < MAX_DEPTH {
            for quarter in cell.quarters() {
                match self.domain.classify(&quarter) {
                    CellClass::Outer => {}
                    CellClass::Cut => self.slice(&quarter, depth + 1, sliced),
                    CellClass::Inner => {
                        tensor_points(&quarter, self.rule, |point| sliced.points.push(point));
                    }
                }
            }
            return;
        }
        let outer = 1 - inner;
        for pair in along[inner].breaks.windows(2) {
            let mut bounds = *cell;
            (bounds.lower[outer], bounds.upper[outer]) = (pair[0], pair[1]);
            let before = sliced.points.len();
            for (t, weight) in self.rule.on(pair[0], pair[1]) {
                self.intervals(cell, inner, t, &mut scratch);
                for interval in &scratch.intervals {
                    let place = |s: f64| if inner == 0 { DVec2::new(s, t) } else { DVec2::new(t, s) };
                    for (end, curve) in [interval.from, interval.to].into_iter().zip(interval.curves) {
                        if curve != CELL_SIDE {
                            sliced.boundary.push(place(end));
                        }
                    }
                    for (s, inner_weight) in self.rule.on(interval.from, interval.to) {
                        let point = place(s);
                        sliced.points.push(QuadraturePoint { point, weight: weight * inner_weight });
                    }
                }
            }
            if sliced.points.len() > before {
                sliced.slices.push(Slice { bounds, inner_axis: inner });
            }
        }
    }

    /// Breaks of the outer coordinate for lines along `inner`, and the worst angle at which they meet a curve.
    fn slicing(&self, cell: &Bounds, inner: usize, scratch: &mut Scratch) -> Slicing {
        let outer = 1 - inner;
        let (from, to) = (cell.lower[outer], cell.upper[outer]);
        let mut breaks = vec![from, to];
        for primitive in &self.primitives {
            for side in [cell.lower[inner], cell.upper[inner]] {
                primitive.push_crossings(inner, side, from, to, &mut breaks);
            }
            primitive.push_turning_places(outer, &mut breaks);
        }
        breaks.retain(|place| (from..=to).contains(place));
        breaks.sort_by(f64::total_cmp);
        let narrow = 1e-14 * (to - from);
        breaks.dedup_by(|next, before| *next - *before <= narrow);
        // The upper side may have been taken for a copy of a break beside it.
        if let Some(last) = breaks.last_mut() {
            *last = to;
        }
        let (mut quality, mut is_full) = (1.0f64, true);
        let mut corners = Vec::new();
        for pair in breaks.windows(2) {
            let mut before: Option<(f64, Vec<[usize; 2]>)> = None;
            for part in SAMPLES {
                let t = pair[0] + (pair[1] - pair[0]) * part;
                self.intervals(cell, inner, t, scratch);
                let curves: Vec<[usize; 2]> = scratch.intervals.iter().map(|i| i.curves).collect();
                is_full &= curves == [[CELL_SIDE; 2]];
                quality = quality.min(self.worst_angle(inner, t, &scratch.intervals));
                if let Some((at, earlier)) = &before
                    && *earlier != curves
                {
                    corners.push(self.change(cell, inner, *at, earlier, t, scratch));
                }
                before = Some((t, curves));
            }
        }
        breaks.extend(corners);
        breaks.sort_by(f64::total_cmp);
        Slicing { breaks, quality, is_full }
    }

    /// The place between `left` and `right` where the curves that end the intervals change, by bisection.
    fn change(
        &self,
        cell: &Bounds,
        inner: usize,
        mut left: f64,
        at_left: &[[usize; 2]],
        mut right: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        loop {
            let middle = 0.5 * (left + right);
            if middle <= left || middle >= right {
                return right;
            }
            self.intervals(cell, inner, middle, scratch);
            if scratch.intervals.iter().map(|i| i.curves).eq(at_left.iter().copied()) {
                left = middle;
            } else {
                right = middle;
            }
        }
    }

    /// The smallest cosine between the normal of a curved boundary and the inner direction at the ends of the
    /// intervals.
    fn worst_angle(&self, inner: usize, t: f64, intervals: &[Interval]) -> f64 {
        let mut worst = 1.0f64;
        for interval in intervals {
            for (place, curve) in [(interval.from, interval.curves[0]), (interval.to, interval.curves[1])] {
                let Some(primitive) = self.primitives.get(curve).filter(|curve| !curve.is_straight()) else {
                    continue;
                };
                let point = if inner == 0 { DVec2::new(place, t) } else { DVec2::new(t, place) };
                let gradient = primitive.level(point).gradient;
                worst = worst.min(gradient[inner].abs() / gradient.length().max(f64::MIN_POSITIVE));
            }
        }
        worst
    }

    /// Writes the parts inside the domain of the line along `inner` with the outer coordinate `t`.
    fn intervals(&self, cell: &Bounds, inner: usize, t: f64, scratch: &mut Scratch) {
        let (from, to) = (cell.lower[inner], cell.upper[inner]);
        let Scratch { places, ends, intervals } = scratch;
        ends.clear();
        intervals.clear();
        for (number, primitive) in self.primitives.iter().enumerate() {
            places.clear();
            primitive.push_crossings(1 - inner, t, from, to, places);
            ends.extend(places.iter().map(|place| (*place, number)));
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ends.push((to, CELL_SIDE));
        let mut start = (from, CELL_SIDE);
        let mut last: Option<Interval> = None;
        for &end in ends.iter() {
            let middle = 0.5 * (start.0 + end.0);
            let point = if inner == 0 { DVec2::new(middle, t) } else { DVec2::new(t, middle) };
            if end.0 > start.0 && self.domain.contains(point) {
                match &mut last {
                    // Curves inside the domain do not end an interval.
                    Some(interval) if interval.to >= start.0 => {
                        (interval.to, interval.curves[1]) = end;
                    }
                    _ => {
                        intervals.extend(last.take());
                        last = Some(Interval { from: start.0, to: end.0, curves: [start.1, end.1] });
                    }
                }
            }
            start = end;
        }
        intervals.extend(last);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use std::f64::consts::PI;

    use super::*;
    use crate::core::domain::Jet;
    use crate::core::progress::Unwatched;

    fn table(domain: &Domain, lower: f64, upper: f64, cells: usize, q: usize) -> QuadratureTable {
        let bounds = Bounds::new(DVec2::splat(lower), DVec2::splat(upper));
        QuadratureTable::new(domain, Grid::new(bounds, [cells; 2]).unwrap(), q, &Unwatched).unwrap()
    }

    #[test]
    fn areas_of_a_domain_and_its_complement_fill_every_cell() {
        let ring = Domain::ellipse(DVec2::new(0.1, 0.2), DVec2::new(1.0, 0.6), 0.4)
            .unwrap()
            .difference(Domain::disc(DVec2::new(0.3, 0.1), 0.35).unwrap())
            .difference(Domain::half_plane(DVec2::new(-0.5, 0.0), DVec2::new(-1.0, 0.3)).unwrap());
        let rule = gauss_legendre(8).unwrap();
        for i in 0..8 {
            for j in 0..8 {
                let lower = DVec2::new(f64::from(i), f64::from(j)) * 0.3 - 1.2;
                let cell = Bounds::new(lower, lower + 0.3);
                let area = |domain: &Domain| -> f64 {
                    slice_cell(domain, &cell, &rule).points.iter().map(|p| p.weight).sum()
                };
                let sum = area(&ring) + area(&ring.clone().complement());
                assert!((sum - 0.09).abs() < 1e-9, "cell {i}, {j}: {sum}");
            }
        }
    }

    #[test]
    fn weights_are_positive_and_nodes_inside() {
        let domain = Domain::disc(DVec2::ZERO, 1.0)
            .unwrap()
            .union(Domain::rectangle(DVec2::new(0.0, -0.3), DVec2::new(1.6, 0.4)).unwrap());
        table(&domain, -2.0, 2.0, 9, 5).for_each_point(|p| {
            assert!(p.weight > 0.0 && domain.contains(p.point), "{p:?}");
        });
    }

    #[test]
    fn polynomials_up_to_twice_the_points_less_one_are_exact_on_triangles() {
        // ∫ xᵃ yᵇ over the triangle (0,0), (1,0), (0,1) is a! b!/(a + b + 2)!.
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let triangle = Domain::polygon(&corners).unwrap();
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        for cells in [1, 3, 7] {
            let q = 4;
            let table = table(&triangle, -0.3, 1.1, cells, q);
            for a in 0..4 {
                for b in 0..4 - a {
                    let exact = factorial(a) * factorial(b) / factorial(a + b + 2);
                    let error = table.integrate(|x| x.x.powi(a) * x.y.powi(b)) - exact;
                    assert!(error.abs() < 2e-15, "{cells} cells, x^{a} y^{b}: {error}");
                }
            }
        }
    }

    #[test]
    fn a_coarse_grid_quarters_where_the_circle_turns_too_far() {
        let disc = Domain::disc(DVec2::ZERO, 1.0).unwrap();
        let error = table(&disc, -1.0, 1.0, 2, 12).integrate(|_| 1.0) - PI;
        assert!(error.abs() < 1e-11, "one cell for each quarter: {error}");
    }

    #[test]
    fn an_implicit_disc_has_the_moments_of_the_disc() {
        let level = |x: DVec2| Jet { value: (1.0 - x.length_squared()).sinh(), gradient: -x };
        let bounds = Bounds::new(DVec2::splat(-1.0), DVec2::splat(1.0));
        let domain = Domain::implicit(std::sync::Arc::new(level), bounds).unwrap();
        let table = table(&domain, -1.1, 1.1, 9, 8);
        for (power, exact) in [(0, PI), (2, PI / 4.0), (4, PI / 8.0)] {
            let error = table.integrate(|x| x.x.powi(power)) - exact;
            assert!(error.abs() < 1e-9, "moment {power}: {error}");
        }
    }

    #[test]
    fn cells_inside_a_union_are_inner_although_a_boundary_passes() {
        let left = Domain::rectangle(DVec2::new(0.0, 0.0), DVec2::new(1.7, 3.0)).unwrap();
        let right = Domain::rectangle(DVec2::new(1.3, 0.0), DVec2::new(3.0, 3.0)).unwrap();
        let table = table(&left.union(right), 0.0, 3.0, 3, 3);
        assert!(table.classes().iter().all(|class| *class == CellClass::Inner), "{:?}", table.classes());
    }

    #[test]
    fn a_domain_beside_the_grid_is_empty() {
        let disc = Domain::disc(DVec2::splat(9.0), 1.0).unwrap();
        let grid = Grid::new(Bounds::new(DVec2::ZERO, DVec2::ONE), [2, 2]).unwrap();
        let result = QuadratureTable::new(&disc, grid, 3, &Unwatched);
        assert_eq!(result.unwrap_err().name(), "EmptyDomain", "no cell");
    }
}
