//! Stiffness matrix and right side by sum factorisation.
//!
//! For fixed first parameter the second direction is summed first; the result serves all pairs of B-splines of the
//! first direction. With values `v` and slopes `d`,
//!
//! ```text
//! g(i, j) = Σ_q₁ Σ_{a,b ∈ {v,d}} a_i₁ b_j₁ T_ab(i₂, j₂),   T_vv = Σ_q₂ C₂₂ d d + c v v,   T_dd = Σ_q₂ C₁₁ v v,
//! T_dv(i₂, j₂) = Σ_q₂ C₁₂ v_i₂ d_j₂ = T_vd(j₂, i₂),
//! ```
//!
//! which takes `O(n³)` operations for each quadrature point instead of `O(n⁴)`. Cells of the first direction are handled in
//! chunks of fixed size, so that the sums do not depend on the number of threads.
//!
//! P. Antolin, A. Buffa, F. Calabrò, M. Martinelli, G. Sangalli, *Efficient matrix computation for tensor-product
//! isogeometric analysis: the use of sum factorization*, 2015.

use rayon::prelude::*;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::isogeometric::band_matrix::TensorBandMatrix;
use crate::core::finite_element::isogeometric::direction::{Direction, LANES};
use crate::core::finite_element::isogeometric::line::{Integrand, Line};
use crate::core::progress::Watcher;

/// Cells of the first direction that one task handles.
const CHUNK: usize = 16;
/// Entries of a band row that are updated at a time: the summands of one cell then stay in the nearest cache.
const BLOCK: usize = 128;

/// The sums over a patch.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    pub(super) matrix: TensorBandMatrix,
    pub(super) load: Vec<f64>,
    /// `C₁₁`, `C₂₂` and `c |det|` without quadrature weights, one sample in each cell, second direction fastest.
    pub(super) samples: Samples,
}

/// One sample of the coefficients in each cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    pub(super) first: Vec<f64>,
    pub(super) second: Vec<f64>,
    pub(super) reaction: Vec<f64>,
}

/// What one chunk adds: rows of its own, and a few that the next chunks share.
struct Chunk<'a> {
    cells: std::ops::Range<usize>,
    first_row: usize,
    own: &'a mut [f64],
    own_load: &'a mut [f64],
    tail: Vec<f64>,
    tail_load: Vec<f64>,
    samples: Samples,
}

/// Assembles the form over a patch.
///
/// # Errors
///
/// Those of the integrand; `Stopped`.
pub(super) fn assemble(
    integrand: Integrand<'_>,
    sizes: [usize; 2],
    orientation: f64,
    watcher: &dyn Watcher,
) -> Result<Sums, FiniteElementError> {
    let [first, second] = integrand.directions;
    let degrees = [first.solution.degree, second.solution.degree];
    let row = TensorBandMatrix::row_length_of(degrees, sizes[1]);
    let mut matrix = TensorBandMatrix::zero(degrees, sizes);
    let mut load = vec![0.0; sizes[0] * sizes[1]];
    let mut chunks = Vec::new();
    let (mut rest, mut rest_load) = (matrix.entries_mut(), &mut load[..]);
    for start in (0..first.cells).step_by(CHUNK) {
        let end = (start + CHUNK).min(first.cells);
        let first_row = first.solution.first[start];
        let own_rows = if end < first.cells { first.solution.first[end] } else { sizes[0] } - first_row;
        let own;
        let own_load;
        (own, rest) = rest.split_at_mut(own_rows * row);
        (own_load, rest_load) = rest_load.split_at_mut(own_rows * sizes[1]);
        let touched = first.solution.first[end - 1] + degrees[0] + 1 - first_row;
        let tail_rows = touched.saturating_sub(own_rows);
        chunks.push(Chunk {
            cells: start..end,
            first_row,
            own,
            own_load,
            tail: vec![0.0; tail_rows * row],
            tail_load: vec![0.0; tail_rows * sizes[1]],
            samples: Samples::default(),
        });
    }
    chunks.par_iter_mut().try_for_each(|chunk| {
        watcher.check(chunk.cells.start as f64 / first.cells as f64)?;
        Factorisation::new(integrand, sizes[1]).run(integrand, chunk, orientation)
    })?;
    let mut tails = Vec::with_capacity(chunks.len());
    let mut samples = Samples::default();
    for chunk in chunks {
        let start = chunk.first_row + chunk.own_load.len() / sizes[1];
        tails.push((start, chunk.tail, chunk.tail_load));
        samples.first.extend(chunk.samples.first);
        samples.second.extend(chunk.samples.second);
        samples.reaction.extend(chunk.samples.reaction);
    }
    for (start, tail, tail_load) in tails {
        add(&mut matrix.entries_mut()[start * row..], &tail);
        add(&mut load[start * sizes[1]..], &tail_load);
    }
    Ok(Sums { matrix, load, samples })
}

fn add(sums: &mut [f64], terms: &[f64]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}

/// The four sums over the second direction, for all points of one cell of the first.
struct Factorisation {
    line: Line,
    /// `T_vv, T_vd, T_dv, T_dd` for each point; rows are offsets, as in the matrix.
    sums: Vec<f64>,
    load: Vec<f64>,
    /// Length of one of the sums.
    length: usize,
    size: usize,
}

impl Factorisation {
    fn new(integrand: Integrand<'_>, size: usize) -> Self {
        let [first, second] = integrand.directions;
        let length = (2 * second.solution.degree + 1) * size;
        let sums = vec![0.0; 4 * first.rule.count() * length];
        Self { line: Line::new(integrand), sums, load: vec![0.0; size], length, size }
    }

    fn run(
        &mut self,
        integrand: Integrand<'_>,
        chunk: &mut Chunk<'_>,
        orientation: f64,
    ) -> Result<(), FiniteElementError> {
        let [first, second] = integrand.directions;
        let arch = pulp::Arch::new();
        for e1 in chunk.cells.clone() {
            self.sums.fill(0.0);
            for q1 in 0..first.rule.count() {
                self.line.fill(integrand, q1, e1, orientation)?;
                arch.dispatch(|| self.sum_second(second, q1));
                self.add_load(first, chunk, q1, e1);
                if q1 == first.rule.count() / 2 {
                    self.sample(first, second, q1, e1, &mut chunk.samples);
                }
            }
            arch.dispatch(|| self.sum_first(first, chunk, e1));
        }
        Ok(())
    }

    /// Sums over the second direction for the line of point `q1`.
    #[inline(always)]
    fn sum_second(&mut self, second: &Direction, q1: usize) {
        let table = &second.solution;
        let (n, points, stride) = (table.degree, second.rule.count(), second.stride);
        let [c11, c12, c22] = &self.line.diffusion;
        let (c0, load) = (&self.line.reaction, &self.line.load);
        let of_point = &mut self.sums[4 * q1 * self.length..][..4 * self.length];
        let (vv, of_point) = of_point.split_at_mut(self.length);
        let (vd, of_point) = of_point.split_at_mut(self.length);
        let (dv, dd) = of_point.split_at_mut(self.length);
        self.load.fill(0.0);
        for &(start, run) in &table.runs {
            for e in (start..start + run).step_by(LANES) {
                let length = LANES.min(start + run - e);
                let k = table.first[start] + (e - start);
                for i in 0..=n {
                    let mut sum = [0.0; LANES];
                    for q in 0..points {
                        let v = lanes(&table.values, table.at(q, i, e));
                        let f = lanes(load, q * stride + e);
                        for x in 0..LANES {
                            sum[x] += v[x] * f[x];
                        }
                    }
                    add(&mut self.load[k + i..], &sum[..length]);
                    for j in 0..=n {
                        let (mut t_vv, mut t_dv, mut t_dd) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
                        for q in 0..points {
                            let (vi, di) = (
                                lanes(&table.values, table.at(q, i, e)),
                                lanes(&table.slopes, table.at(q, i, e)),
                            );
                            let (vj, dj) = (
                                lanes(&table.values, table.at(q, j, e)),
                                lanes(&table.slopes, table.at(q, j, e)),
                            );
                            let at = q * stride + e;
                            let c12 = lanes(c12, at);
                            for x in 0..LANES {
                                t_dv[x] += c12[x] * vi[x] * dj[x];
                            }
                            if j >= i {
                                let (c11, c22, c0) = (lanes(c11, at), lanes(c22, at), lanes(c0, at));
                                for x in 0..LANES {
                                    let product = vi[x] * vj[x];
                                    t_dd[x] += c11[x] * product;
                                    t_vv[x] += c22[x] * (di[x] * dj[x]) + c0[x] * product;
                                }
                            }
                        }
                        // Place (i, j) has the offset j − i, and (j, i) its opposite.
                        let (there, back) =
                            ((n + j - i) * self.size + k + i, (n + i - j) * self.size + k + j);
                        add(&mut dv[there..], &t_dv[..length]);
                        add(&mut vd[back..], &t_dv[..length]);
                        if j >= i {
                            add(&mut dd[there..], &t_dd[..length]);
                            add(&mut vv[there..], &t_vv[..length]);
                        }
                        if j > i {
                            add(&mut dd[back..], &t_dd[..length]);
                            add(&mut vv[back..], &t_vv[..length]);
                        }
                    }
                }
            }
        }
    }

    /// Adds the sums of all points of cell `e1` to the rows of the matrix.
    #[inline(always)]
    fn sum_first(&self, first: &Direction, chunk: &mut Chunk<'_>, e1: usize) {
        let table = &first.solution;
        let n = table.degree;
        let row = (n + 1) * self.length;
        for block in (0..self.length).step_by(BLOCK) {
            let range = block..(block + BLOCK).min(self.length);
            for i in 0..=n {
                let place = table.first[e1] + i - chunk.first_row;
                let target = match (place * row).checked_sub(chunk.own.len()) {
                    None => &mut chunk.own[place * row..][..row],
                    Some(start) => &mut chunk.tail[start..][..row],
                };
                for j in i..=n {
                    let target = &mut target[(j - i) * self.length..][range.clone()];
                    for q in 0..first.rule.count() {
                        let (vi, di) = (table.values[table.at(q, i, e1)], table.slopes[table.at(q, i, e1)]);
                        let (vj, dj) = (table.values[table.at(q, j, e1)], table.slopes[table.at(q, j, e1)]);
                        let of_point = &self.sums[4 * q * self.length..][..4 * self.length];
                        let vv = &of_point[range.clone()];
                        let vd = &of_point[self.length..][range.clone()];
                        let dv = &of_point[2 * self.length..][range.clone()];
                        let dd = &of_point[3 * self.length..][range.clone()];
                        let (a, b, c, d) = (vi * vj, vi * dj, di * vj, di * dj);
                        for x in 0..target.len() {
                            target[x] += a * vv[x] + b * vd[x] + c * dv[x] + d * dd[x];
                        }
                    }
                }
            }
        }
    }

    fn add_load(&self, first: &Direction, chunk: &mut Chunk<'_>, q1: usize, e1: usize) {
        let table = &first.solution;
        for i in 0..=table.degree {
            let value = table.values[table.at(q1, i, e1)];
            let place = (table.first[e1] + i - chunk.first_row) * self.size;
            let target = match place.checked_sub(chunk.own_load.len()) {
                None => &mut chunk.own_load[place..],
                Some(start) => &mut chunk.tail_load[start..],
            };
            for (sum, load) in target.iter_mut().zip(&self.load) {
                *sum += value * load;
            }
        }
    }

    fn sample(&self, first: &Direction, second: &Direction, q1: usize, e1: usize, samples: &mut Samples) {
        let q = second.rule.count() / 2;
        let weight = first.point(q1, e1).1;
        for e in 0..second.cells {
            let at = q * second.stride + e;
            let total = weight * second.point(q, e).1;
            samples.first.push(self.line.diffusion[0][at] / total);
            samples.second.push(self.line.diffusion[2][at] / total);
            samples.reaction.push(self.line.reaction[at] / total);
        }
    }
}

/// A block of neighbours in a table or a line; both are padded.
#[inline(always)]
fn lanes(numbers: &[f64], at: usize) -> &[f64; LANES] {
    numbers[at..].first_chunk().expect("tables are padded by one block")
}
