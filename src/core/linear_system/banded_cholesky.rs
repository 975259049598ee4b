//! Symmetric positive definite band matrices, `A = L D Lᵗ`.
//!
//! Also the entries of the inverse inside the band, without the others: M. F. Hutchinson, F. R. de Hoog, *Smoothing noisy data with spline
//! functions*, 1985. Course: section 5.6.

use crate::core::linear_system::band_error::BandError;
use crate::core::point::Point;

/// `A = L D Lᵗ` of a symmetric band matrix, with ones on the diagonal of `L`.
#[derive(Clone, Debug, PartialEq)]
pub struct BandCholesky {
    half: usize,
    /// Row `i` at `i (half + 1)`: `lᵢ,ᵢ₋ₕ … lᵢ,ᵢ₋₁`, then `1/dᵢ`. Places left of the matrix hold 0.
    rows: Vec<f64>,
}

impl BandCholesky {
    /// Factors the matrix with `half` diagonals below the main one. `rows` has `half + 1` entries for each row `i`: columns `i − half … i`;
    /// those left of the matrix are not read.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if the entries make no whole rows; `NotPositiveDefinite`.
    pub fn factor(half: usize, mut rows: Vec<f64>) -> Result<Self, BandError> {
        let width = half + 1;
        if !rows.len().is_multiple_of(width) {
            let expected = rows.len().div_ceil(width) * width;
            return Err(BandError::SizeMismatch { what: "entries", expected, found: rows.len() });
        }
        for i in 0..half.min(rows.len() / width) {
            rows[i * width..i * width + half - i].fill(0.0);
        }
        match half {
            2 => decompose(2, &mut rows),
            3 => decompose(3, &mut rows),
            _ => decompose(half, &mut rows),
        }?;
        Ok(Self { half, rows })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.rows.len() / (self.half + 1)
    }

    /// Replaces a right-hand side by the solution.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn solve<P: Point>(&self, vector: &mut [P]) -> Result<(), BandError> {
        if vector.len() != self.size() {
            let (expected, found) = (self.size(), vector.len());
            return Err(BandError::SizeMismatch { what: "entries of the right-hand side", expected, found });
        }
        match self.half {
            2 => substitute(2, &self.rows, vector),
            3 => substitute(3, &self.rows, vector),
            half => substitute(half, &self.rows, vector),
        }
        Ok(())
    }

    /// The entries of the inverse inside the band, in the layout that [`Self::factor`] reads.
    pub fn inverse_band(&self) -> Vec<f64> {
        match self.half {
            2 => inverse_band(2, &self.rows),
            half => inverse_band(half, &self.rows),
        }
    }
}

#[inline(always)]
fn inverse_band(half: usize, rows: &[f64]) -> Vec<f64> {
    let (width, size) = (half + 1, rows.len() / (half + 1));
    let mut inverse = vec![0.0; rows.len()];
    // Entry (i, j) of the symmetric inverse for j in i − half ..= i + half.
    let at = |i: usize, j: usize| i.max(j) * width + half - i.abs_diff(j);
    for i in (0..size).rev() {
        let below = i + 1..(i + width).min(size);
        for j in below.clone() {
            inverse[at(i, j)] = -below.clone().map(|k| rows[at(k, i)] * inverse[at(k, j)]).sum::<f64>();
        }
        let sum: f64 = below.map(|k| rows[at(k, i)] * inverse[at(i, k)]).sum();
        inverse[at(i, i)] = rows[at(i, i)] - sum;
    }
    inverse
}

#[inline(always)]
fn decompose(half: usize, rows: &mut [f64]) -> Result<(), BandError> {
    let width = half + 1;
    for i in 0..rows.len() / width {
        let (done, rest) = rows.split_at_mut(i * width);
        let row = &mut rest[..width];
        let size = row[half];
        // Left of the matrix stand zeros; places before the first row are never looked at.
        for p in half - i.min(half)..half {
            // row[p] becomes l dⱼ with j = i − half + p: subtract the products with the columns before j.
            let j = i + p - half;
            let above = &done[j * width..][..width];
            let mut sum = row[p];
            for q in half - i.min(half)..p {
                sum -= row[q] * above[half + q - p];
            }
            row[p] = sum;
        }
        for p in half - i.min(half)..half {
            let j = i + p - half;
            let scaled = row[p];
            let factor = scaled * done[j * width + half];
            row[half] -= scaled * factor;
            row[p] = factor;
        }
        let pivot = row[half];
        if pivot <= f64::EPSILON * size || pivot.is_nan() {
            return Err(BandError::NotPositiveDefinite { index: i, pivot });
        }
        row[half] = 1.0 / pivot;
    }
    Ok(())
}

#[inline(always)]
fn substitute<P: Point>(half: usize, rows: &[f64], vector: &mut [P]) {
    let width = half + 1;
    for i in 0..vector.len() {
        let row = &rows[i * width..][..width];
        let mut sum = vector[i];
        for p in half - i.min(half)..half {
            sum = sum - vector[i + p - half] * row[p];
        }
        vector[i] = sum;
    }
    let size = vector.len();
    for i in (0..size).rev() {
        let mut sum = vector[i] * rows[i * width + half];
        for k in i + 1..(i + width).min(size) {
            sum = sum - vector[k] * rows[k * width + half + i - k];
        }
        vector[i] = sum;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn solutions_and_inverse_of_random_matrices() {
        for (size, half) in [(1, 2), (2, 2), (3, 3), (9, 1), (12, 2), (12, 3), (10, 5)] {
            let entry = |i: usize, j: usize| {
                let gap = i.abs_diff(j);
                let off = ((i.min(j) * 5 + gap * 3) % 7) as f64 / 7.0 - 0.5;
                if gap == 0 {
                    6.0
                } else if gap <= half {
                    off
                } else {
                    0.0
                }
            };
            let rows = (0..size)
                .flat_map(|i| {
                    (0..=half).map(move |p| if i + p < half { f64::NAN } else { entry(i, i + p - half) })
                })
                .collect();
            let factors = BandCholesky::factor(half, rows).unwrap();
            let inverse = factors.inverse_band();
            for column in 0..size {
                let mut unit: Vec<f64> = (0..size).map(|i| f64::from(u8::from(i == column))).collect();
                factors.solve(&mut unit).unwrap();
                for i in 0..size {
                    let product: f64 = (0..size).map(|j| entry(i, j) * unit[j]).sum();
                    let expected = f64::from(u8::from(i == column));
                    assert!((product - expected).abs() < 1e-14, "size {size}, half {half}: {product}");
                }
                for i in column..(column + half + 1).min(size) {
                    let found = inverse[i * (half + 1) + half + column - i];
                    assert!(
                        (found - unit[i]).abs() < 1e-15,
                        "inverse ({i}, {column}): {found} and {}",
                        unit[i]
                    );
                }
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let error = BandCholesky::factor(1, vec![0.0, 1.0, 2.0, 1.0]).unwrap_err();
        assert_eq!(error, BandError::NotPositiveDefinite { index: 1, pivot: -3.0 }, "1·1 − 2·2 < 0");
        assert_eq!(BandCholesky::factor(1, vec![1.0]).unwrap_err().name(), "SizeMismatch", "half a row");
    }
}
