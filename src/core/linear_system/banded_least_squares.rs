//! Least squares with a band matrix, by Givens rotations row after row: only the triangle is kept.
//!
//! W. Givens, 1958; for splines C. Reinsch's and P. Dierckx' programs. Course: section 5.6.

use std::ops::Range;

use crate::core::linear_system::band_error::BandError;
use crate::core::point::Point;

/// A diagonal entry of the triangle counts as zero below this, times the largest entry of its column.
const TINY_DIAGONAL: f64 = 1e-13;

/// Sums of squares that have lost nothing to underflow or overflow.
const SQUARES: Range<f64> = 1e-250..1e300;

/// The triangle `R` of `A = Q R`, and `Qᵗ` times the right-hand side, of the rows taken in so far.
#[derive(Clone, Debug, PartialEq)]
pub struct BandLeastSquares<P> {
    width: usize,
    /// Row `k` at `k width`: columns `k … k + width − 1`.
    triangle: Vec<f64>,
    right: Vec<P>,
    /// Largest entry seen in each column.
    size: Vec<f64>,
    residual: f64,
}

impl<P: Point> BandLeastSquares<P> {
    /// No equations yet, in `columns` unknowns, with `width` consecutive entries each.
    pub fn new(columns: usize, width: usize) -> Self {
        let width = width.min(columns);
        let (triangle, right) = (vec![0.0; columns * width], vec![P::ZERO; columns]);
        Self { width, triangle, right, size: vec![0.0; columns], residual: 0.0 }
    }

    /// Takes in an equation: `row` stands in the columns from `first` on and is used as scratch. Fast if the equations come sorted by `first`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless `row` has the width, `OutsideInterval` if it leaves the matrix.
    pub fn add(&mut self, first: usize, row: &mut [f64], mut value: P) -> Result<(), BandError> {
        let (width, columns) = (self.width, self.right.len());
        if row.len() != width {
            return Err(BandError::SizeMismatch {
                what: "entries of a row",
                expected: width,
                found: row.len(),
            });
        }
        if first + width > columns {
            return Err(BandError::RowOutsideBand { row: 0, first, least: 0, most: columns - width });
        }
        for (size, entry) in self.size[first..].iter_mut().zip(row.iter()) {
            *size = size.max(entry.abs());
        }
        for k in first..columns {
            let upper = &mut self.triangle[k * width..(k + 1) * width];
            let (a, b) = (upper[0], row[0]);
            if b != 0.0 {
                if a == 0.0 {
                    // Nothing there yet: an empty row of the triangle has no right-hand side either.
                    upper.copy_from_slice(row);
                    self.right[k] = value;
                    return Ok(());
                }
                let square = a * a + b * b;
                // `hypot` is slow, and needed only where squares leave the range of numbers.
                let length = if SQUARES.contains(&square) { square.sqrt() } else { a.hypot(b) };
                let (c, s) = (a / length, b / length);
                upper[0] = length;
                for (above, entry) in upper[1..].iter_mut().zip(row[1..].iter_mut()) {
                    (*above, *entry) = (c * *above + s * *entry, c * *entry - s * *above);
                }
                (self.right[k], value) = (self.right[k] * c + value * s, value * c - self.right[k] * s);
            }
            row.copy_within(1.., 0);
            row[width - 1] = 0.0;
            if row.iter().all(|&entry| entry == 0.0) {
                break;
            }
        }
        self.residual += (0..P::DIMENSION).map(|i| value.coordinate(i) * value.coordinate(i)).sum::<f64>();
        Ok(())
    }

    /// Sum of the squared residuals.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// The unknowns.
    ///
    /// # Errors
    ///
    /// `Singular` with the index of a column that depends on the others.
    pub fn solve(&self) -> Result<Vec<P>, BandError> {
        let mut solution = self.right.clone();
        for k in (0..solution.len()).rev() {
            let row = &self.triangle[k * self.width..(k + 1) * self.width];
            if row[0].abs() <= TINY_DIAGONAL * self.size[k] || row[0].is_nan() {
                return Err(BandError::Singular { index: k, pivot: row[0] });
            }
            let (head, known) = solution.split_at_mut(k + 1);
            let sum = row[1..].iter().zip(known.iter()).fold(head[k], |sum, (&entry, &x)| sum - x * entry);
            head[k] = sum * row[0].recip();
        }
        Ok(solution)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn the_residual_is_orthogonal_in_any_sequence_of_equations() {
        let (columns, width) = (7, 3);
        let rows: Vec<(usize, [f64; 3], f64)> = (0..20)
            .map(|i| {
                let entry = |j: usize| ((i * 11 + j * 5 + i * i * j) % 13) as f64 - 5.5;
                (i % 5, [entry(0), entry(1), entry(2)], entry(3))
            })
            .collect();
        let mut sorted = rows.clone();
        sorted.sort_by_key(|row| row.0);
        let solutions = [rows.clone(), sorted].map(|rows| {
            let mut system = BandLeastSquares::new(columns, width);
            for (first, mut row, value) in rows {
                system.add(first, &mut row, value).unwrap();
            }
            (system.solve().unwrap(), system.residual())
        });
        for (solution, sum) in solutions {
            let mut gradient = [0.0; 7];
            let mut squares = 0.0;
            for (first, row, value) in &rows {
                let residual = value - (0..3).map(|j| row[j] * solution[first + j]).sum::<f64>();
                squares += residual * residual;
                (0..3).for_each(|j| gradient[first + j] += row[j] * residual);
            }
            assert!(gradient.iter().all(|g| g.abs() < 1e-11), "{gradient:?}");
            assert!((squares - sum).abs() < 1e-11 * squares, "{squares} and {sum}");
        }
    }

    #[test]
    fn a_column_without_equations_is_named() {
        let mut system = BandLeastSquares::new(3, 1);
        for first in [0, 2] {
            system.add(first, &mut [1.0], 1.0).unwrap();
        }
        assert!(matches!(system.solve(), Err(BandError::Singular { index: 1, .. })), "column 1 is empty");
    }
}
