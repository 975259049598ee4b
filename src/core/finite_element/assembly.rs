//! Assembly of Galerkin systems, element by element.
//!
//! ```text
//! gₖₖ' = Σ over elements Σ over nodes of ω (grad Bₖ)ᵗ A grad Bₖ' + c Bₖ Bₖ',   fₖ = Σ Σ ω (f Bₖ + F·grad Bₖ).
//! ```
//!
//! Elements are worked on in parallel and added one after the other, so that the result does not depend on the
//! number of threads.
//!
//! Course: section 9.4.

use glam::DVec2;
use rayon::prelude::*;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::form::{EllipticForm, Jet};
use crate::core::linear_system::SparseMatrix;
use crate::core::progress::Watcher;

/// The functions that do not vanish on an element, at its quadrature points.
#[derive(Clone, Debug, Default)]
pub struct ElementSamples {
    /// Global indices of the functions.
    pub indices: Vec<usize>,
    /// The quadrature points.
    pub points: Vec<DVec2>,
    /// Their weights, including the Jacobian of a map.
    pub weights: Vec<f64>,
    /// Value of function `j` at point `p` at `p·(number of functions) + j`.
    pub values: Vec<f64>,
    /// First component of the gradients, likewise.
    pub gradients_x: Vec<f64>,
    /// Second component of the gradients, likewise.
    pub gradients_y: Vec<f64>,
}

impl ElementSamples {
    /// Forgets functions and points, keeps the memory.
    pub fn clear(&mut self) {
        self.indices.clear();
        self.points.clear();
        self.weights.clear();
        self.values.clear();
        self.gradients_x.clear();
        self.gradients_y.clear();
    }

    /// Appends a point; its jets follow by [`Self::push_jet`].
    pub fn push_point(&mut self, point: DVec2, weight: f64) {
        self.points.push(point);
        self.weights.push(weight);
    }

    /// Appends value and gradient of the next function at the last point.
    pub fn push_jet(&mut self, jet: Jet) {
        self.values.push(jet.value);
        self.gradients_x.push(jet.gradient.x);
        self.gradients_y.push(jet.gradient.y);
    }

    /// The function with these coefficients at point `p`.
    pub fn combine(&self, p: usize, coefficients: &[f64]) -> Jet {
        let count = self.indices.len();
        let mut jet = Jet::default();
        for (j, &index) in self.indices.iter().enumerate() {
            let (place, c) = (p * count + j, coefficients[index]);
            jet.value += c * self.values[place];
            jet.gradient += c * DVec2::new(self.gradients_x[place], self.gradients_y[place]);
        }
        jet
    }
}

/// A space of functions, element by element.
pub trait ElementSource: Sync {
    /// Number of elements; some may be empty.
    fn element_count(&self) -> usize;

    /// Number of functions.
    fn function_count(&self) -> usize;

    /// Fills `samples`, which were cleared, for one element; leaves them without points if it does not count.
    ///
    /// # Errors
    ///
    /// What the space can meet there, such as a singular Jacobian.
    fn write_element(&self, element: usize, samples: &mut ElementSamples) -> Result<(), FiniteElementError>;
}

/// A matrix to which blocks are added.
pub trait BlockSink {
    /// Adds the row-major `block` to the rows and columns `indices`.
    fn add_block(&mut self, indices: &[usize], block: &[f64]);
}

impl BlockSink for SparseMatrix {
    fn add_block(&mut self, indices: &[usize], block: &[f64]) {
        for (i, &row) in indices.iter().enumerate() {
            for (j, &column) in indices.iter().enumerate() {
                self.add(row, column, block[i * indices.len() + j]);
            }
        }
    }
}

/// Elements that are worked on in one go by a thread, and in one go by all.
const CHUNK: usize = 16;
const BATCH: usize = 64 * CHUNK;

/// What one element contributes.
struct Contribution {
    indices: Vec<usize>,
    block: Vec<f64>,
    load: Vec<f64>,
}

/// Adds the form's matrix to `matrix` and returns the right side.
///
/// # Errors
///
/// Those of the form's coefficients and of the source, `Stopped`.
pub fn assemble(
    source: &impl ElementSource,
    form: &EllipticForm<'_>,
    matrix: &mut impl BlockSink,
    watcher: &dyn Watcher,
) -> Result<Vec<f64>, FiniteElementError> {
    let mut load = vec![0.0; source.function_count()];
    let count = source.element_count();
    for first in (0..count).step_by(BATCH) {
        watcher.check(first as f64 / count as f64)?;
        let contributions =
            in_chunks(source, first..(first + BATCH).min(count), |samples| element(form, samples))?;
        for contribution in contributions {
            matrix.add_block(&contribution.indices, &contribution.block);
            for (index, value) in contribution.indices.iter().zip(&contribution.load) {
                load[*index] += value;
            }
        }
    }
    Ok(load)
}

/// What `work` makes of all elements with points, in their succession; computed in parallel.
///
/// # Errors
///
/// Those of the source and of `work`.
pub fn map_elements<T: Send>(
    source: &impl ElementSource,
    work: impl Fn(&ElementSamples) -> Result<T, FiniteElementError> + Sync,
) -> Result<Vec<T>, FiniteElementError> {
    in_chunks(source, 0..source.element_count(), work)
}

fn in_chunks<T: Send>(
    source: &impl ElementSource,
    elements: std::ops::Range<usize>,
    work: impl Fn(&ElementSamples) -> Result<T, FiniteElementError> + Sync,
) -> Result<Vec<T>, FiniteElementError> {
    let chunks = elements.len().div_ceil(CHUNK);
    let chunk = |number: usize| -> Result<Vec<T>, FiniteElementError> {
        let from = elements.start + number * CHUNK;
        let mut samples = ElementSamples::default();
        let mut results = Vec::new();
        for index in from..(from + CHUNK).min(elements.end) {
            samples.clear();
            source.write_element(index, &mut samples)?;
            if !samples.points.is_empty() {
                results.push(work(&samples)?);
            }
        }
        Ok(results)
    };
    let results: Vec<Vec<T>> = (0..chunks).into_par_iter().map(chunk).collect::<Result<_, _>>()?;
    Ok(results.into_iter().flatten().collect())
}

fn element(form: &EllipticForm<'_>, samples: &ElementSamples) -> Result<Contribution, FiniteElementError> {
    let count = samples.indices.len();
    let (mut block, mut load) = (vec![0.0; count * count], vec![0.0; count]);
    // ω A grad B and ω c B of all functions at a point.
    let (mut flux_x, mut flux_y, mut reacted) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    for (p, (&point, &weight)) in samples.points.iter().zip(&samples.weights).enumerate() {
        let at = form.at(point)?;
        let a = at.diffusion * weight;
        let range = p * count..(p + 1) * count;
        let values = &samples.values[range.clone()];
        let (xs, ys) = (&samples.gradients_x[range.clone()], &samples.gradients_y[range]);
        for j in 0..count {
            flux_x[j] = a.x_axis.x * xs[j] + a.y_axis.x * ys[j];
            flux_y[j] = a.x_axis.y * xs[j] + a.y_axis.y * ys[j];
            reacted[j] = weight * at.reaction * values[j];
            let jet = Jet { value: values[j], gradient: DVec2::new(xs[j], ys[j]) };
            load[j] += weight * at.linear(&jet);
        }
        for i in 0..count {
            let (x, y, value) = (xs[i], ys[i], values[i]);
            let row = &mut block[i * count + i..(i + 1) * count];
            for (((entry, fx), fy), r) in
                row.iter_mut().zip(&flux_x[i..]).zip(&flux_y[i..]).zip(&reacted[i..])
            {
                *entry += x * fx + y * fy + value * r;
            }
        }
    }
    for i in 0..count {
        for j in 0..i {
            block[i * count + j] = block[j * count + i];
        }
    }
    Ok(Contribution { indices: samples.indices.clone(), block, load })
}
