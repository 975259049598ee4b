//! A solution as triangles: the cells of a grid with their cut ones clipped at the boundary, or the lattice of a patch.

use std::collections::HashMap;

use glam::DVec2;

use crate::core::domain::{CellClass, Jet};
use crate::core::finite_element::{
    FiniteElementError, IsogeometricSolution, PatchSide, WeightedSolution, domain_weight,
};

/// Lattice lines over the longer side of a domain, about.
const LINES: usize = 64;
/// A cut cell is divided so many times finer.
const FINER: usize = 2;
/// Halvings of an edge until its crossing with the boundary is found.
const HALVINGS: usize = 30;

/// Points with value and length of gradient, triangles, and the outline.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// The points.
    pub points: Vec<DVec2>,
    /// The value at each.
    pub values: Vec<f64>,
    /// The length of the gradient at each.
    pub slopes: Vec<f64>,
    /// Triples of indices of points.
    pub triangles: Vec<[u32; 3]>,
    /// The boundary, as polylines; a closed one repeats its first point.
    pub outline: Vec<Vec<DVec2>>,
}

impl Samples {
    fn push(&mut self, point: DVec2, jet: Jet) -> u32 {
        self.points.push(point);
        self.values.push(jet.value);
        self.slopes.push(jet.gradient.length());
        self.points.len() as u32 - 1
    }
}

/// A place of the fine lattice.
type Place = [u32; 2];

struct Clipper<'a> {
    solution: &'a WeightedSolution,
    step: DVec2,
    samples: Samples,
    vertices: HashMap<Place, Option<u32>>,
    crossings: HashMap<[Place; 2], u32>,
    boundary: Vec<[u32; 2]>,
}

/// Samples of a solution on a domain of primitives.
pub(super) fn of_weighted(solution: &WeightedSolution) -> Samples {
    let grid = solution.space.grid();
    let table = solution.space.table();
    let [columns, rows] = grid.cells();
    let coarse = LINES.div_ceil(columns.max(rows)).max(1);
    let fine = coarse * FINER;
    let mut clipper = Clipper {
        solution,
        step: grid.width() / fine as f64,
        samples: Samples::default(),
        vertices: HashMap::new(),
        crossings: HashMap::new(),
        boundary: Vec::new(),
    };
    for i in 0..columns {
        for j in 0..rows {
            let class = table.class([i, j]);
            let stride = match class {
                CellClass::Outer => continue,
                CellClass::Inner => FINER,
                CellClass::Cut => 1,
            };
            for a in (0..fine).step_by(stride) {
                for b in (0..fine).step_by(stride) {
                    let at = |da: usize, db: usize| {
                        [(i * fine + a + da * stride) as u32, (j * fine + b + db * stride) as u32]
                    };
                    let corners = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                    if class == CellClass::Inner {
                        clipper.quadrangle(corners);
                    } else {
                        clipper.clip([corners[0], corners[1], corners[2]]);
                        clipper.clip([corners[0], corners[2], corners[3]]);
                    }
                }
            }
            if class == CellClass::Inner {
                clipper.free_sides([i, j], fine);
            }
        }
    }
    let mut samples = clipper.samples;
    samples.outline = chains(&clipper.boundary)
        .into_iter()
        .map(|chain| chain.into_iter().map(|vertex| samples.points[vertex as usize]).collect())
        .collect();
    samples
}

impl Clipper<'_> {
    fn position(&self, place: Place) -> DVec2 {
        let lower = self.solution.space.grid().bounds().lower;
        lower + self.step * DVec2::new(f64::from(place[0]), f64::from(place[1]))
    }

    /// The solution, 0 on the boundary.
    fn jet(&self, x: DVec2) -> Jet {
        self.solution.evaluate(x).unwrap_or_default()
    }

    /// The vertex at a place that counts as inside whatever the rounding says.
    fn vertex(&mut self, place: Place) -> u32 {
        if let Some(Some(vertex)) = self.vertices.get(&place) {
            return *vertex;
        }
        let at = self.position(place);
        let jet = self.jet(at);
        let vertex = self.samples.push(at, jet);
        self.vertices.insert(place, Some(vertex));
        vertex
    }

    /// The vertex at a place, if that is inside.
    fn inside(&mut self, place: Place) -> Option<u32> {
        if let Some(found) = self.vertices.get(&place) {
            return *found;
        }
        if self.solution.space.domain().contains(self.position(place)) {
            return Some(self.vertex(place));
        }
        self.vertices.insert(place, None);
        None
    }

    fn quadrangle(&mut self, corners: [Place; 4]) {
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner));
        self.samples.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// The part of a triangle inside the domain.
    fn clip(&mut self, corners: [Place; 3]) {
        let found = corners.map(|corner| self.inside(corner));
        let count = found.iter().flatten().count();
        if count == 0 {
            return;
        }
        if let [Some(a), Some(b), Some(c)] = found {
            self.samples.triangles.push([a, b, c]);
            return;
        }
        // Turned so that the corner that differs from both others is the first.
        let odd = (0..3).find(|&i| found[i].is_some() == (count == 1)).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|i| corners[(odd + i) % 3]);
        let (ab, ac) = (self.crossing(a, b), self.crossing(a, c));
        match (self.inside(a), self.inside(b), self.inside(c)) {
            (Some(a), ..) => self.samples.triangles.push([a, ab, ac]),
            (None, Some(b), Some(c)) => self.samples.triangles.extend([[ab, b, c], [ab, c, ac]]),
            _ => {}
        }
        self.boundary.push([ab, ac]);
    }

    /// The vertex where the edge from `a` to `b`, one of them inside, crosses the boundary.
    fn crossing(&mut self, a: Place, b: Place) -> u32 {
        let key = [a.min(b), a.max(b)];
        if let Some(vertex) = self.crossings.get(&key) {
            return *vertex;
        }
        let (mut inner, mut outer) = (self.position(key[0]), self.position(key[1]));
        let domain = self.solution.space.domain();
        if !domain.contains(inner) {
            std::mem::swap(&mut inner, &mut outer);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inner + outer);
            if domain_weight(domain, middle).value > 0.0 { inner = middle } else { outer = middle }
        }
        let gradient = self.jet(inner).gradient;
        let vertex = self.samples.push(outer, Jet { value: 0.0, gradient });
        self.crossings.insert(key, vertex);
        vertex
    }

    /// Sides of an inner cell beyond which there is nothing belong to the boundary.
    fn free_sides(&mut self, cell: [usize; 2], fine: usize) {
        let table = self.solution.space.table();
        let outer = |i: Option<usize>, j: Option<usize>| match (i, j) {
            (Some(i), Some(j)) => table.class([i, j]) == CellClass::Outer,
            _ => true,
        };
        let [i, j] = cell;
        let (low, high) = ([i * fine, j * fine], [(i + 1) * fine, (j + 1) * fine]);
        let sides = [
            (outer(i.checked_sub(1), Some(j)), [[low[0], low[1]], [low[0], high[1]]]),
            (outer(Some(i + 1), Some(j)), [[high[0], low[1]], [high[0], high[1]]]),
            (outer(Some(i), j.checked_sub(1)), [[low[0], low[1]], [high[0], low[1]]]),
            (outer(Some(i), Some(j + 1)), [[low[0], high[1]], [high[0], high[1]]]),
        ];
        for (is_free, ends) in sides {
            if is_free {
                let ends = ends.map(|place| self.vertex(place.map(|index| index as u32)));
                self.boundary.push(ends);
            }
        }
    }
}

/// Joins segments at common ends into chains.
fn chains(segments: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut at: HashMap<u32, Vec<usize>> = HashMap::new();
    for (index, ends) in segments.iter().enumerate() {
        ends.iter().for_each(|end| at.entry(*end).or_default().push(index));
    }
    let mut used = vec![false; segments.len()];
    let mut chains = Vec::new();
    // Chains with loose ends begin there; what is left are loops.
    let loose = (0..segments.len()).filter(|&index| segments[index].iter().any(|end| at[end].len() == 1));
    for start in loose.collect::<Vec<_>>().into_iter().chain(0..segments.len()) {
        if used[start] {
            continue;
        }
        used[start] = true;
        let [mut first, mut last] = segments[start];
        if at[&first].len() > 1 && at[&last].len() == 1 {
            std::mem::swap(&mut first, &mut last);
        }
        let mut chain = vec![first, last];
        while let Some(&next) = at[&last].iter().find(|&&index| !used[index]) {
            used[next] = true;
            let [a, b] = segments[next];
            last = if a == last { b } else { a };
            chain.push(last);
        }
        chains.push(chain);
    }
    chains
}

/// Samples of a solution on a patch.
///
/// # Errors
///
/// Those of [`IsogeometricSolution::write_grid`].
pub(super) fn of_patch(solution: &IsogeometricSolution) -> Result<Samples, FiniteElementError> {
    let space = solution.space();
    let [low, high] = space.patch().parameter_rectangle();
    // Lattice lines through the knots of equal intervals.
    let counts = [0, 1].map(|axis| {
        let cells = space.spaces()[axis].breaks().len() - 1;
        cells * (LINES / 2).div_ceil(cells).max(1) + 1
    });
    let mut jets = vec![solution.jet(low)?; counts[0] * counts[1]];
    solution.write_grid(counts, &mut jets)?;
    let mut samples = Samples::default();
    for jet in &jets {
        samples.push(jet.geometry.point, Jet { value: jet.value, gradient: jet.gradient });
    }
    let at = |i: usize, j: usize| (i * counts[1] + j) as u32;
    for i in 1..counts[0] {
        for j in 1..counts[1] {
            let [a, b, c, d] = [at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)];
            samples.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    for side in PatchSide::ALL {
        let along = 1 - side.axis();
        let points = (0..=4 * LINES).filter_map(|step| {
            let t = low[along] + (high[along] - low[along]) * step as f64 / (4 * LINES) as f64;
            space.patch().evaluate(space.patch().side_parameter(side, t.min(high[along]))).ok()
        });
        samples.outline.push(points.collect());
    }
    Ok(samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_become_chains() {
        let mut found = chains(&[[1, 2], [5, 6], [3, 2], [6, 7], [7, 5], [9, 3]]);
        found.sort_by_key(Vec::len);
        assert_eq!(found.len(), 2, "a chain and a loop: {found:?}");
        assert!(found.iter().all(|chain| chain.len() == 4), "{found:?}");
        let open = found.iter().find(|chain| chain.contains(&9)).expect("the open chain");
        assert!(open == &[1, 2, 3, 9] || open == &[9, 3, 2, 1], "{open:?}");
        let closed = found.iter().find(|chain| chain.contains(&5)).expect("the loop");
        assert_eq!(closed.first(), closed.last(), "it closes: {closed:?}");
    }
}
