//! Cyclic band matrices: entries near the diagonal, the indices counted around a circle, as periodic splines make them.
//!
//! Folding the circle, `0, M−1, 1, M−2, 2, …`, makes neighbours on the circle at most two places apart; what is left is an ordinary band matrix of
//! twice the width, solved with exchanged rows. Course: section 5.5.

use crate::core::linear_system::band_error::BandError;
use crate::core::linear_system::banded_lu::PivotedBandLu;
use crate::core::point::Point;

/// The factors of a cyclic band matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct CyclicLu {
    folded: PivotedBandLu,
    size: usize,
    /// Column `j` is treated as column `j − shift`, so that the large entries stand near the diagonal.
    shift: usize,
}

impl CyclicLu {
    /// Factors the matrix of the given size whose entries are the sums of the `(row, column, entry)`; row 0 has its band around column
    /// `shift`.
    ///
    /// # Errors
    ///
    /// `RowOutsideBand` for an entry outside the matrix, `Singular`.
    pub fn factor(size: usize, shift: usize, triplets: &[(usize, usize, f64)]) -> Result<Self, BandError> {
        let shift = if size > 0 { shift % size } else { 0 };
        let folded: Vec<_> = triplets
            .iter()
            .map(|&(i, j, entry)| {
                // An index outside stays outside, and is refused.
                let column = if j < size { fold((j + size - shift) % size, size) } else { j };
                (if i < size { fold(i, size) } else { i }, column, entry)
            })
            .collect();
        Ok(Self { folded: PivotedBandLu::factor(size, &folded)?, size, shift })
    }

    /// Replaces a right-hand side by the solution.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn solve<P: Point>(&self, vector: &mut [P]) -> Result<(), BandError> {
        let mut folded = vector.to_vec();
        if vector.len() == self.size {
            for (i, &entry) in vector.iter().enumerate() {
                folded[fold(i, self.size)] = entry;
            }
        }
        self.folded.solve(&mut folded)?;
        for j in 0..self.size {
            vector[(j + self.shift) % self.size] = folded[fold(j, self.size)];
        }
        Ok(())
    }
}

/// Place of index `i` in `0, M−1, 1, M−2, …`.
fn fold(i: usize, size: usize) -> usize {
    if 2 * i < size { 2 * i } else { 2 * (size - 1 - i) + 1 }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn a_shifted_cyclic_matrix_is_solved() {
        for size in 1..12 {
            for shift in 0..size {
                let mut triplets = Vec::new();
                for i in 0..size {
                    for (offset, entry) in [(0, 1.0), (1, 5.0), (2, -1.5)] {
                        triplets.push((i, (i + shift + offset) % size, entry + 0.1 * i as f64));
                    }
                }
                let solution: Vec<f64> = (0..size).map(|i| (i * i % 7) as f64 - 2.0).collect();
                let mut right = vec![0.0; size];
                for &(i, j, entry) in &triplets {
                    right[i] += entry * solution[j];
                }
                CyclicLu::factor(size, shift + 1, &triplets).unwrap().solve(&mut right).unwrap();
                for (got, expected) in right.iter().zip(&solution) {
                    assert!((got - expected).abs() < 1e-12, "size {size}, shift {shift}: {got}, {expected}");
                }
            }
        }
    }
}
