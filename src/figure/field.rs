//! Scalar fields over triangles of the plane: coloured, as bands between levels, as isolines.
//!
//! A field is linear on each triangle, given by its values at the vertices; bands and isolines are exact for that.

use std::cmp::Ordering;

use glam::DVec2;

use crate::core::point::Point as _;
use crate::figure::color_map::ColorScale;
use crate::figure::error::{FigureError, check_count, check_finite, check_triangles};
use crate::figure::isoline::{Isoline, isolines};
use crate::figure::mesh::Mesh;
use crate::figure::picture::Color;

/// More bands than this are not made.
const MOST_BANDS: f64 = 256.0;

/// A field with valid points, values and triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    points: Vec<DVec2>,
    values: Vec<f64>,
    triangles: Vec<[u32; 3]>,
}

impl Field {
    /// The field with one value for each point, linear on the triangles (triples of indices).
    ///
    /// # Errors
    ///
    /// `NonFinite`, `SizeMismatch`, `IndexOutOfRange`.
    pub fn new(points: Vec<DVec2>, values: Vec<f64>, triangles: Vec<[u32; 3]>) -> Result<Self, FigureError> {
        check_finite("point", points.iter().map(|point| point.to_array()))?;
        check_count("values", points.len(), values.len())?;
        check_finite("value", values.iter().map(|&value| [value]))?;
        check_triangles(points.len(), &triangles)?;
        Ok(Self { points, values, triangles })
    }

    /// The field on a structured grid, straight or curved: point and value `(i, j)` have the index `i + j·columns`. Each cell is
    /// cut along its shorter diagonal.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `SizeMismatch` unless there are `columns·rows` points and values.
    pub fn on_grid(
        columns: usize,
        rows: usize,
        points: Vec<DVec2>,
        values: Vec<f64>,
    ) -> Result<Self, FigureError> {
        check_count("points", columns.saturating_mul(rows), points.len())?;
        let mut triangles = Vec::with_capacity(2 * points.len());
        for j in 1..rows {
            for i in 1..columns {
                let d = i + j * columns;
                let [a, b, c] = [d - columns - 1, d - columns, d - 1];
                let is_rising =
                    points[a].distance_squared(points[d]) <= points[b].distance_squared(points[c]);
                let halves = if is_rising { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] };
                triangles.extend(halves.map(|half| half.map(|vertex| vertex as u32)));
            }
        }
        Self::new(points, values, triangles)
    }

    /// The vertices.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Their values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The triangles, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Least and largest value; `None` if there are no values.
    pub fn range(&self) -> Option<(f64, f64)> {
        self.values.iter().fold(None, |range, &value| match range {
            None => Some((value, value)),
            Some((low, high)) => Some((value.min(low), value.max(high))),
        })
    }

    /// The field in the colours of its vertices; between them the colours are interpolated, not the values.
    pub fn mesh(&self, scale: &ColorScale) -> Result<Mesh, FigureError> {
        let colors = self.values.iter().map(|&value| scale.color(value)).collect();
        Mesh::new(self.points.clone(), colors, self.triangles.clone())
    }

    /// The field in `count` bands of one colour each (that of the middle value), between equally spaced levels from end to end
    /// of the scale; what lies beyond has the colour of the outermost band.
    ///
    /// # Errors
    ///
    /// `StepLimit` for no bands or more than 256.
    pub fn bands(&self, scale: &ColorScale, count: usize) -> Result<Mesh, FigureError> {
        let bands = count as f64;
        if !(1.0..=MOST_BANDS).contains(&bands) {
            return Err(FigureError::StepLimit {
                what: "the number of bands",
                value: bands,
                limit: MOST_BANDS,
            });
        }
        let at = |t: f64| scale.low().mix(scale.high(), t);
        let levels: Vec<f64> = (1..count).map(|k| at(k as f64 / bands)).collect();
        let colors: Vec<Color> = (0..count).map(|k| scale.color(at((k as f64 + 0.5) / bands))).collect();
        let (mut points, mut inks, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for corners in &self.triangles {
            let whole = corners.map(|vertex| (self.points[vertex as usize], self.values[vertex as usize]));
            let mut rest = whole.to_vec();
            let mut put = |polygon: &[(DVec2, f64)], color: Color| {
                let first = points.len() as u32;
                points.extend(polygon.iter().map(|&(point, _)| point));
                inks.extend(polygon.iter().map(|_| color));
                triangles.extend((2..polygon.len() as u32).map(|i| [first, first + i - 1, first + i]));
            };
            for (band, &level) in levels.iter().enumerate() {
                let lower = part(&rest, level, Ordering::Less);
                if lower.is_empty() {
                    continue;
                }
                put(&lower, colors[band]);
                rest = part(&rest, level, Ordering::Greater);
            }
            if rest.len() >= 3 {
                put(&rest, colors[count - 1]);
            }
        }
        Mesh::new(points, inks, triangles)
    }

    /// The lines on which the field has the value `level`; none if that is not a number.
    ///
    /// Edges that lie on the level as a whole belong to them; of an area on the level they are the rim where other values adjoin
    /// it. Where more than two pieces meet, lines go on as straight as they can.
    pub fn isolines(&self, level: f64) -> Vec<Isoline> {
        isolines(&self.points, &self.values, &self.triangles, level)
    }
}

/// The part of a convex polygon with values on one side of `level`, with its edge; nothing if no corner lies beyond.
fn part(polygon: &[(DVec2, f64)], level: f64, side: Ordering) -> Vec<(DVec2, f64)> {
    let is_beyond = |value: f64| value.partial_cmp(&level) == Some(side);
    let mut part = Vec::with_capacity(polygon.len() + 1);
    if !polygon.iter().any(|&(_, value)| is_beyond(value)) {
        return part;
    }
    for (i, &(point, value)) in polygon.iter().enumerate() {
        let (next, next_value) = polygon[(i + 1) % polygon.len()];
        if is_beyond(value) || value == level {
            part.push((point, value));
        }
        if (value < level && level < next_value) || (next_value < level && level < value) {
            // Always from the lower end, so that neighbours agree on the point bit for bit.
            let (low, high) = if value < next_value { (point, next) } else { (next, point) };
            let (least, largest) = (value.min(next_value), value.max(next_value));
            let (before, run) = (0.5 * level - 0.5 * least, 0.5 * largest - 0.5 * least);
            part.push((low.mix(high, before / run), level));
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::color_map::ColorMap;

    fn area(mesh: &Mesh, color: Option<Color>) -> f64 {
        let is_counted = |ink: Color| color.is_none_or(|color| color == ink);
        let wanted = mesh.corners().filter(|corners| is_counted(corners[0].1));
        wanted.map(|[a, b, c]| 0.5 * (b.0 - a.0).perp_dot(c.0 - a.0).abs()).sum()
    }

    /// The value x on a crooked grid over [0, 1]².
    fn slope() -> Field {
        let points: Vec<DVec2> = (0..25)
            .map(|k| {
                let (i, j) = (k % 5, k / 5);
                let inner = i > 0 && i < 4 && j > 0 && j < 4;
                let shift = if inner { 0.07 * f64::from((k * 7 % 5) - 2) } else { 0.0 };
                DVec2::new(f64::from(i) / 4.0 + shift, f64::from(j) / 4.0 - shift)
            })
            .collect();
        let values = points.iter().map(|point| point.x).collect();
        Field::on_grid(5, 5, points, values).unwrap()
    }

    #[test]
    fn bands_of_a_linear_field_are_strips_and_fill_everything_once() {
        let scale = ColorScale::new(0.0, 1.0, ColorMap::Viridis).unwrap();
        for count in [1, 3, 10] {
            let bands = slope().bands(&scale, count).unwrap();
            assert!((area(&bands, None) - 1.0).abs() < 1e-12, "{count} bands");
            for band in 0..count {
                let color = scale.color((band as f64 + 0.5) / count as f64);
                let found = area(&bands, Some(color)) * count as f64;
                assert!((found - 1.0).abs() < 1e-12, "band {band} of {count}: {found}");
            }
        }
        let beyond = ColorScale::new(0.25, 0.75, ColorMap::Viridis).unwrap();
        let bands = slope().bands(&beyond, 2).unwrap();
        assert!((area(&bands, Some(beyond.color(0.375))) - 0.5).abs() < 1e-12, "with what lies below");
        for count in [0, 257] {
            assert_eq!(slope().bands(&scale, count).unwrap_err().name(), "StepLimit", "{count} bands");
        }
    }

    #[test]
    fn a_level_field_is_one_band() {
        let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
        let field = Field::new(points, vec![0.5; 3], vec![[0, 1, 2]]).unwrap();
        let scale = ColorScale::new(0.0, 1.0, ColorMap::Viridis).unwrap();
        // 0.5 is a level: the area must not be lost between the two bands, nor filled twice.
        assert!((area(&field.bands(&scale, 2).unwrap(), None) - 0.5).abs() < 1e-15, "a triangle");
    }

    #[test]
    fn colours_are_those_of_the_values() {
        let scale = ColorScale::new(0.0, 1.0, ColorMap::Cividis).unwrap();
        let (field, mesh) = (slope(), slope().mesh(&scale).unwrap());
        for (value, color) in field.values().iter().zip(mesh.colors()) {
            assert_eq!(*color, scale.color(*value), "value {value}");
        }
        assert_eq!(field.range(), Some((0.0, 1.0)), "range");
    }

    #[test]
    fn hostile_fields_are_refused() {
        let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
        for (values, triangle, name) in [
            (vec![0.0, f64::NAN, 0.0], [0, 1, 2], "NonFinite"),
            (vec![0.0; 2], [0, 1, 2], "SizeMismatch"),
            (vec![0.0; 3], [0, 1, 3], "IndexOutOfRange"),
        ] {
            let error = Field::new(points.clone(), values, vec![triangle]).unwrap_err();
            assert_eq!(error.name(), name, "{error}");
        }
        assert!(Field::on_grid(usize::MAX, 2, Vec::new(), Vec::new()).is_err(), "no such grid");
        assert!(
            Field::on_grid(0, 0, Vec::new(), Vec::new()).unwrap().triangles().is_empty(),
            "an empty grid"
        );
    }
}
