//! Band matrices whose rows hold equally many consecutive entries, as those of B-splines at sorted sites do.

use crate::core::linear_system::band_error::BandError;
use crate::core::point::Point;

/// A matrix with `width` consecutive entries in each row, which start no further left than those of the row above.
#[derive(Clone, Debug, PartialEq)]
pub struct BandMatrix {
    columns: usize,
    width: usize,
    /// Column of the first entry of each row, not decreasing.
    pub(super) first: Vec<usize>,
    /// Row by row.
    pub(super) entries: Vec<f64>,
}

impl BandMatrix {
    /// A matrix without rows, to be filled by [`Self::push_row`]. A width above `columns` is cut.
    pub fn new(columns: usize, width: usize) -> Self {
        Self { columns, width: width.min(columns), first: Vec::new(), entries: Vec::new() }
    }

    /// As [`Self::new`], with room for `rows` rows.
    pub fn with_capacity(rows: usize, columns: usize, width: usize) -> Self {
        let width = width.min(columns);
        let (first, entries) = (Vec::with_capacity(rows), Vec::with_capacity(rows.saturating_mul(width)));
        Self { columns, width, first, entries }
    }

    /// Appends a row with `entries` in the columns from `first` on.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `width` entries; `OutsideInterval` if the row starts left of the one above or leaves the matrix.
    pub fn push_row(&mut self, first: usize, entries: &[f64]) -> Result<(), BandError> {
        if entries.len() != self.width {
            let (expected, found) = (self.width, entries.len());
            return Err(BandError::SizeMismatch { what: "entries of a row", expected, found });
        }
        let (least, most) = (self.first.last().copied().unwrap_or(0), self.columns - self.width);
        if !(least..=most).contains(&first) {
            return Err(BandError::RowOutsideBand { row: self.first.len(), first, least, most });
        }
        self.first.push(first);
        self.entries.extend_from_slice(entries);
        Ok(())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.first.len()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of entries that each row holds.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Column of the first entry of row `i`, and its entries. Panics if there is no such row.
    pub fn row(&self, i: usize) -> (usize, &[f64]) {
        (self.first[i], &self.entries[i * self.width..(i + 1) * self.width])
    }

    /// Entry `(i, j)`; 0 outside the band and outside the matrix.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let place =
            self.first.get(i).and_then(|first| j.checked_sub(*first)).filter(|place| *place < self.width);
        place.map_or(0.0, |place| self.entries[i * self.width + place])
    }

    /// All entries, row by row, each with its row and column.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let place = |index: usize| (index / self.width, self.first[index / self.width] + index % self.width);
        self.entries.iter().enumerate().map(move |(index, &entry)| {
            let (i, j) = place(index);
            (i, j, entry)
        })
    }

    /// The product with a vector of numbers or points.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn multiply<P: Point>(&self, vector: &[P]) -> Result<Vec<P>, BandError> {
        if vector.len() != self.columns {
            let (expected, found) = (self.columns, vector.len());
            return Err(BandError::SizeMismatch { what: "entries of the vector", expected, found });
        }
        let product = |i: usize| {
            let (first, row) = self.row(i);
            row.iter().zip(&vector[first..]).fold(P::ZERO, |sum, (&entry, &x)| sum + x * entry)
        };
        Ok((0..self.rows()).map(product).collect())
    }
}
