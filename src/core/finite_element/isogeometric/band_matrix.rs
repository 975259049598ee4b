//! Symmetric matrices of tensor-product B-splines: all couplings of neighbours, and nothing else.
//!
//! With `k = (k₁, k₂)` and the offset `s = (s₁, s₂)`, `|sᵢ| ≤ nᵢ`, the entry `g(k, k + s)` stands in the block of row
//! `k₁` and offset `s₁ ≥ 0`, in its row `s₂ + n₂`, at place `k₂`. Entries with `s₁ < 0` follow from the symmetry;
//! those with `k + s` outside are 0. A product runs along `k₂` for fixed offsets.
//! Course: section 9.4 (offset storage).

use rayon::prelude::*;

use crate::core::linear_system::{LinearOperator, LinearSystemError, SparseMatrix};

/// Products smaller than this many entries run on one thread.
const PARALLEL_SIZE: usize = 1 << 17;

/// A symmetric matrix over `m₁ × m₂` coefficients whose bands are as wide as the degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorBandMatrix {
    degrees: [usize; 2],
    sizes: [usize; 2],
    entries: Vec<f64>,
}

impl TensorBandMatrix {
    /// The zero matrix.
    pub(crate) fn zero(degrees: [usize; 2], sizes: [usize; 2]) -> Self {
        let entries = vec![0.0; sizes[0] * Self::row_length_of(degrees, sizes[1])];
        Self { degrees, sizes, entries }
    }

    /// Numbers stored for the coefficients with one first index.
    pub(crate) fn row_length_of(degrees: [usize; 2], size: usize) -> usize {
        (degrees[0] + 1) * (2 * degrees[1] + 1) * size
    }

    /// `m₁` and `m₂`.
    pub fn sizes(&self) -> [usize; 2] {
        self.sizes
    }

    /// All stored numbers, row after row.
    pub(crate) fn entries_mut(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    fn row_length(&self) -> usize {
        Self::row_length_of(self.degrees, self.sizes[1])
    }

    /// Entries `g(k, k + s)` for all `k₂`, with `s₁ ≥ 0` and `s₂ = second − n₂`.
    fn band(&self, k1: usize, s1: usize, second: usize) -> &[f64] {
        let m2 = self.sizes[1];
        &self.entries[k1 * self.row_length() + (s1 * (2 * self.degrees[1] + 1) + second) * m2..][..m2]
    }

    /// The entry in row `i` and column `j`; pairs of indices, 0 where nothing is stored.
    pub fn entry(&self, i: [usize; 2], j: [usize; 2]) -> f64 {
        if i[0] > j[0] {
            return self.entry(j, i);
        }
        let (s1, second) = (j[0] - i[0], (j[1] + self.degrees[1]).wrapping_sub(i[1]));
        let inside = i[0].max(j[0]) < self.sizes[0] && i[1].max(j[1]) < self.sizes[1];
        let stored = inside && s1 <= self.degrees[0] && second <= 2 * self.degrees[1];
        if stored { self.band(i[0], s1, second)[i[1]] } else { 0.0 }
    }

    /// The diagonal entries.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.sizes[0]).flat_map(|k1| self.band(k1, 0, self.degrees[1])).copied().collect()
    }

    /// Triplets `(row, column, value)` with the second index running fastest in rows and columns.
    pub fn triplets(&self) -> Vec<(usize, usize, f64)> {
        let [n1, n2] = self.degrees;
        let [m1, m2] = self.sizes;
        let mut triplets = Vec::new();
        for i in 0..m1 {
            for j in i.saturating_sub(n1)..(i + n1 + 1).min(m1) {
                for k in 0..m2 {
                    for l in k.saturating_sub(n2)..(k + n2 + 1).min(m2) {
                        triplets.push((i * m2 + k, j * m2 + l, self.entry([i, k], [j, l])));
                    }
                }
            }
        }
        triplets
    }

    /// The matrix in compressed rows.
    ///
    /// # Errors
    ///
    /// `NonFinite`.
    pub fn to_sparse(&self) -> Result<SparseMatrix, LinearSystemError> {
        let size = self.size();
        SparseMatrix::from_triplets(size, size, &self.triplets())
    }

    /// Row `k1` of a product.
    #[inline(always)]
    fn product_row(&self, k1: usize, x: &[f64], row: &mut [f64]) {
        let [n1, n2] = self.degrees;
        let [m1, m2] = self.sizes;
        row.fill(0.0);
        for s1 in 0..=n1.min(m1 - 1 - k1) {
            let other = &x[(k1 + s1) * m2..][..m2];
            for second in 0..=2 * n2 {
                let band = self.band(k1, s1, second);
                if second >= n2 {
                    let shift = second - n2;
                    add_products(&mut row[..m2 - shift.min(m2)], band, &other[shift.min(m2)..]);
                } else {
                    let shift = (n2 - second).min(m2);
                    add_products(&mut row[shift..], &band[shift..], other);
                }
            }
        }
        for s1 in 1..=n1.min(k1) {
            let other = &x[(k1 - s1) * m2..][..m2];
            for second in 0..=2 * n2 {
                let band = self.band(k1 - s1, s1, second);
                if second >= n2 {
                    let shift = (second - n2).min(m2);
                    add_products(&mut row[shift..], band, other);
                } else {
                    let shift = (n2 - second).min(m2);
                    add_products(&mut row[..m2 - shift], &band[shift..], &other[shift..]);
                }
            }
        }
    }
}

/// `sums[i] += a[i] · b[i]` as far as the shortest slice goes.
#[inline(always)]
fn add_products(sums: &mut [f64], a: &[f64], b: &[f64]) {
    for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
        *sum += a * b;
    }
}

impl LinearOperator for TensorBandMatrix {
    fn size(&self) -> usize {
        self.sizes[0] * self.sizes[1]
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        let arch = pulp::Arch::new();
        let row = |(k1, row): (usize, &mut [f64])| arch.dispatch(|| self.product_row(k1, x, row));
        if self.entries.len() < PARALLEL_SIZE {
            product.chunks_mut(self.sizes[1]).enumerate().for_each(row);
        } else {
            product.par_chunks_mut(self.sizes[1]).enumerate().for_each(row);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn products_are_those_of_the_full_symmetric_matrix() {
        for (degrees, sizes) in [([1, 1], [2, 2]), ([2, 3], [4, 5]), ([3, 2], [7, 3]), ([1, 4], [9, 6])] {
            let mut matrix = TensorBandMatrix::zero(degrees, sizes);
            let [m1, m2] = sizes;
            // Numbers that are symmetric in row and column, set through the storage rule of the module's head.
            let number = |i: usize, j: usize| ((i * j + 3 * (i + j)) % 17) as f64 - 8.0;
            let width = 2 * degrees[1] + 1;
            for (index, entry) in matrix.entries.iter_mut().enumerate() {
                let (k2, rest) = (index % m2, index / m2);
                let (second, rest) = (rest % width, rest / width);
                let (s1, k1) = (rest % (degrees[0] + 1), rest / (degrees[0] + 1));
                let l2 = (k2 + second).wrapping_sub(degrees[1]);
                if l2 < m2 && k1 + s1 < m1 {
                    *entry = number(k1 * m2 + k2, (k1 + s1) * m2 + l2);
                }
            }
            let x: Vec<f64> = (0..m1 * m2).map(|i| (i % 5) as f64 - 1.5).collect();
            let mut product = vec![0.0; m1 * m2];
            matrix.apply(&x, &mut product);
            let mut expected = vec![0.0; m1 * m2];
            for (i, j, value) in matrix.triplets() {
                assert_eq!(value, number(i, j), "entry ({i}, {j}) of {sizes:?}");
                expected[i] += value * x[j];
            }
            assert_eq!(product, expected, "degrees {degrees:?}, sizes {sizes:?}");
        }
    }
}
