//! Gaussian elimination for band matrices.
//!
//! Without exchanging rows for totally positive matrices: all pivots are positive, the elimination is stable, and since the rows start in
//! nondecreasing columns nothing fills in. With exchanges for all others.
//!
//! C. de Boor, A. Pinkus, *Backward error analysis for totally positive linear systems*, 1977. Course: section 5.5.

use crate::core::linear_system::band_error::BandError;
use crate::core::linear_system::banded::BandMatrix;
use crate::core::point::Point;

/// With exchanged rows a pivot counts as zero below this, times the size of the matrix's largest entry.
const TINY_PIVOT: f64 = 1e-14;

/// `A = L U` without exchanging rows, for a totally positive `A`.
#[derive(Clone, Debug, PartialEq)]
pub struct BandLu {
    /// `U` on and right of the diagonal, the factors of `L` left of it.
    factors: BandMatrix,
    /// `1/uᵢᵢ`.
    reciprocals: Vec<f64>,
}

impl BandLu {
    /// Factors a square matrix, in place and without pivoting.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if it is not square; `Singular` for a pivot that vanishes.
    pub fn factor(mut matrix: BandMatrix) -> Result<Self, BandError> {
        let (rows, columns, width) = (matrix.rows(), matrix.columns(), matrix.width());
        if rows != columns {
            return Err(BandError::SizeMismatch { what: "rows", expected: columns, found: rows });
        }
        let BandMatrix { first, entries, .. } = &mut matrix;
        // Elimination is accurate entry by entry, and sites near the end of a support make small pivots: only a vanished one is refused.
        let tiny = f64::MIN_POSITIVE;
        let mut reciprocals = Vec::with_capacity(rows);
        // A constant width lets the compiler unroll the inner loop.
        match width {
            3 => eliminate(3, first, entries, &mut reciprocals, tiny),
            4 => eliminate(4, first, entries, &mut reciprocals, tiny),
            6 => eliminate(6, first, entries, &mut reciprocals, tiny),
            _ => eliminate(width, first, entries, &mut reciprocals, tiny),
        }?;
        Ok(Self { factors: matrix, reciprocals })
    }

    /// Replaces a right-hand side by the solution.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn solve<P: Point>(&self, vector: &mut [P]) -> Result<(), BandError> {
        check_length(self.factors.rows(), vector.len())?;
        let (width, first, entries) = (self.factors.width(), &self.factors.first, &self.factors.entries);
        for (i, row) in entries.chunks_exact(width).enumerate() {
            let known = &vector[first[i]..i];
            let sum = row.iter().zip(known).fold(vector[i], |sum, (&factor, &x)| sum - x * factor);
            vector[i] = sum;
        }
        for (i, row) in entries.chunks_exact(width).enumerate().rev() {
            let right = &row[i + 1 - first[i]..];
            let (head, known) = vector.split_at_mut(i + 1);
            let sum = right.iter().zip(known.iter()).fold(head[i], |sum, (&entry, &x)| sum - x * entry);
            head[i] = sum * self.reciprocals[i];
        }
        Ok(())
    }

    /// The determinant, the product of the pivots.
    pub fn determinant(&self) -> f64 {
        self.reciprocals.iter().fold(1.0, |product, reciprocal| product / reciprocal)
    }
}

#[inline(always)]
fn eliminate(
    width: usize,
    first: &[usize],
    entries: &mut [f64],
    reciprocals: &mut Vec<f64>,
    tiny: f64,
) -> Result<(), BandError> {
    for i in 0..first.len() {
        let (done, rest) = entries.split_at_mut(i * width);
        let (row, start) = (&mut rest[..width], first[i]);
        if start > i || i >= start + width {
            return Err(BandError::Singular { index: i, pivot: 0.0 });
        }
        for j in start..i {
            let above = &done[j * width..][..width];
            let factor = row[j - start] * reciprocals[j];
            row[j - start] = factor;
            // Column c of the row above stands `shift` places further left in this row.
            let shift = start - first[j];
            for (entry, above) in row[j + 1 - start..].iter_mut().zip(&above[j + 1 - start + shift..]) {
                *entry -= factor * above;
            }
        }
        let pivot = row[i - start];
        if pivot.abs() <= tiny || pivot.is_nan() {
            return Err(BandError::Singular { index: i, pivot });
        }
        reciprocals.push(1.0 / pivot);
    }
    Ok(())
}

/// `P A = L U` with exchanged rows, for any band matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct PivotedBandLu {
    size: usize,
    /// Number of diagonals below the main one, and of those above it that the exchanges can reach.
    lower: usize,
    upper: usize,
    /// Entry `(i, j)` at `i (lower + upper + 1) + lower + j − i`.
    entries: Vec<f64>,
    /// Row that was exchanged with row `k` before column `k` was eliminated.
    exchanges: Vec<usize>,
}

impl PivotedBandLu {
    /// Factors the matrix of the given size whose entries are the sums of the `(row, column, entry)`.
    ///
    /// # Errors
    ///
    /// `RowOutsideBand` for an entry outside the matrix, `Singular`.
    pub fn factor(size: usize, triplets: &[(usize, usize, f64)]) -> Result<Self, BandError> {
        let (mut lower, mut above) = (0, 0);
        for &(row, column, _) in triplets {
            if row >= size || column >= size {
                return Err(BandError::RowOutsideBand { row, first: column, least: 0, most: size });
            }
            lower = lower.max(row.saturating_sub(column));
            above = above.max(column.saturating_sub(row));
        }
        let upper = (lower + above).min(size.saturating_sub(1));
        let width = lower + upper + 1;
        let mut entries = vec![0.0; size * width];
        let at = |i: usize, j: usize| i * width + lower + j - i;
        for &(row, column, entry) in triplets {
            entries[at(row, column)] += entry;
        }
        let tiny = TINY_PIVOT * entries.iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        let mut exchanges = Vec::with_capacity(size);
        for k in 0..size {
            let (last_row, last_column) = ((k + lower).min(size - 1), (k + upper).min(size - 1));
            let mut best = k;
            for i in k + 1..=last_row {
                if entries[at(i, k)].abs() > entries[at(best, k)].abs() {
                    best = i;
                }
            }
            let pivot = entries[at(best, k)];
            if pivot.abs() <= tiny || pivot.is_nan() {
                return Err(BandError::Singular { index: k, pivot });
            }
            exchanges.push(best);
            for j in k..=last_column {
                if best != k {
                    entries.swap(at(k, j), at(best, j));
                }
            }
            for i in k + 1..=last_row {
                let factor = entries[at(i, k)] / pivot;
                entries[at(i, k)] = factor;
                for j in k + 1..=last_column {
                    entries[at(i, j)] -= factor * entries[at(k, j)];
                }
            }
        }
        Ok(Self { size, lower, upper, entries, exchanges })
    }

    /// Replaces a right-hand side by the solution.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn solve<P: Point>(&self, vector: &mut [P]) -> Result<(), BandError> {
        check_length(self.size, vector.len())?;
        let width = self.lower + self.upper + 1;
        let at = |i: usize, j: usize| self.entries[i * width + self.lower + j - i];
        for k in 0..self.size {
            vector.swap(k, self.exchanges[k]);
            for i in k + 1..(k + self.lower + 1).min(self.size) {
                vector[i] = vector[i] - vector[k] * at(i, k);
            }
        }
        for k in (0..self.size).rev() {
            let known = k + 1..(k + self.upper + 1).min(self.size);
            let sum = known.fold(vector[k], |sum, j| sum - vector[j] * at(k, j));
            vector[k] = sum * at(k, k).recip();
        }
        Ok(())
    }
}

fn check_length(expected: usize, found: usize) -> Result<(), BandError> {
    if expected == found {
        Ok(())
    } else {
        Err(BandError::SizeMismatch { what: "entries of the right-hand side", expected, found })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use proptest::prelude::*;

    prop_compose! {
        /// A band matrix with dominant diagonal, rows that start anywhere left of it.
        fn dominant()(size in 1_usize..20, width in 1_usize..8)(
            size in Just(size),
            width in Just(width.min(size)),
            entries in prop::collection::vec(-1.0..1.0_f64, size * width.min(size)),
            steps in prop::collection::vec(0_usize..3, size),
        ) -> BandMatrix {
            let mut matrix = BandMatrix::new(size, width);
            let mut first = 0;
            for i in 0..size {
                first = (first + steps[i]).max((i + 1).saturating_sub(width)).min(i).min(size - width);
                let mut row = entries[i * width..(i + 1) * width].to_vec();
                row[i - first] += 8.0;
                matrix.push_row(first, &row).unwrap();
            }
            matrix
        }
    }

    proptest! {
        #[test]
        fn both_eliminations_solve(matrix in dominant(), seed in 0_usize..5) {
            let size = matrix.rows();
            let solution: Vec<f64> = (0..size).map(|i| ((i * 7 + seed) % 5) as f64 - 2.0).collect();
            let right = matrix.multiply(&solution).unwrap();
            let triplets: Vec<_> = matrix.iter().collect();
            // Rows upside down force exchanges.
            let upside_down: Vec<_> = triplets.iter().map(|&(i, j, a)| (size - 1 - i, j, a)).collect();
            let (mut plain, mut pivoted) = (right.clone(), right.clone());
            let mut reversed: Vec<f64> = right.into_iter().rev().collect();
            BandLu::factor(matrix).unwrap().solve(&mut plain).unwrap();
            PivotedBandLu::factor(size, &triplets).unwrap().solve(&mut pivoted).unwrap();
            PivotedBandLu::factor(size, &upside_down).unwrap().solve(&mut reversed).unwrap();
            for i in 0..size {
                prop_assert!((plain[i] - solution[i]).abs() < 1e-13, "plain {}", i);
                prop_assert!((pivoted[i] - solution[i]).abs() < 1e-13, "pivoted {}", i);
                prop_assert!((reversed[i] - solution[i]).abs() < 1e-13, "reversed {}", i);
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut matrix = BandMatrix::new(2, 2);
        matrix.push_row(0, &[1.0, 2.0]).unwrap();
        matrix.push_row(0, &[0.1, 0.2]).unwrap();
        let triplets: Vec<_> = matrix.iter().collect();
        let error = PivotedBandLu::factor(2, &triplets).unwrap_err();
        assert_eq!(error.name(), "Singular", "proportional rows, with exchanges: {error}");
        let error = BandLu::factor(matrix).unwrap_err();
        assert!(matches!(error, BandError::Singular { index: 1, .. }), "proportional rows: {error}");
    }

    #[test]
    fn rows_keep_to_the_band() {
        let mut matrix = BandMatrix::new(4, 2);
        matrix.push_row(1, &[1.0, 1.0]).unwrap();
        assert_eq!(
            matrix.push_row(0, &[1.0, 1.0]).unwrap_err().name(),
            "OutsideInterval",
            "left of the row above"
        );
        assert_eq!(
            matrix.push_row(3, &[1.0, 1.0]).unwrap_err().name(),
            "OutsideInterval",
            "beyond the last column"
        );
        assert_eq!(matrix.push_row(1, &[1.0]).unwrap_err().name(), "SizeMismatch", "too short");
        assert_eq!(BandLu::factor(matrix).unwrap_err().name(), "SizeMismatch", "not square");
    }
}
