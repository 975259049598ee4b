//! Triangles as pixels: a depth buffer with several samples per pixel, without a GPU.
//!
//! A sample belongs to a triangle if it lies inside, by the signs of the three edge functions (J. Pineda, 1988). An edge gives
//! the same number, bit for bit, to both of its triangles, and a sample on it belongs to exactly one of the two: surfaces have
//! neither gaps nor double seams.

use std::ops::Range;

use glam::DVec2;
use rayon::prelude::*;

use crate::figure::error::FigureError;
use crate::figure::mesh::Image;
use crate::figure::picture::Color;

/// Most pixels of an image.
pub const MOST_PIXELS: f64 = 1e8;
/// Rows that are drawn together: few enough that their samples stay in the cache.
const BAND: usize = 16;

/// A corner of a triangle on the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Place in pixels from the upper left corner, y down; may lie outside.
    pub at: DVec2,
    /// The larger, the nearer: any measure that varies linearly over the image, for example the reciprocal of the depth in
    /// perspective. Where it is equal the later triangle wins.
    pub nearness: f64,
    /// Weight of the corner in the interpolation of colours: the reciprocal of its depth in perspective, 1 otherwise.
    pub weight: f64,
    /// Colour; samples are written opaquely if all three corners are opaque, blended without hiding anything if not.
    pub color: Color,
}

/// An image with the depth of what it shows.
#[derive(Clone, Debug)]
pub struct Raster {
    /// The pixels, clear where nothing was drawn.
    pub image: Image,
    /// The least nearness of the opaque samples of each pixel, −∞ where one shows the ground.
    pub farthest: Vec<f64>,
}

/// The triangles as an image of `width · height` pixels, each the mean of `side²` samples. Triangles with a corner that is not
/// finite, or without area, are not drawn.
///
/// # Errors
///
/// `StepLimit` for no pixels or more than [`MOST_PIXELS`], and for more than 8 samples per side.
pub fn rasterize(
    triangles: &[[Corner; 3]],
    width: u32,
    height: u32,
    side: u32,
) -> Result<Raster, FigureError> {
    let pixels = f64::from(width) * f64::from(height);
    for (what, value, limit) in
        [("the number of pixels", pixels, MOST_PIXELS), ("the number of samples", f64::from(side), 8.0)]
    {
        if !(value > 0.0 && value <= limit) {
            return Err(FigureError::StepLimit { what, value, limit });
        }
    }
    let (width, height, side) = (width as usize, height as usize, side as usize);
    let bands = height.div_ceil(BAND);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); bands];
    for (index, triangle) in triangles.iter().enumerate() {
        let rows = covered(triangle.map(|corner| corner.at.y), height);
        let is_drawable = triangle.iter().all(|corner| corner.at.is_finite() && !corner.nearness.is_nan());
        if is_drawable && !rows.is_empty() {
            (rows.start / BAND..=(rows.end - 1) / BAND).for_each(|band| members[band].push(index));
        }
    }
    let drawn: Vec<Band> = members
        .par_iter()
        .enumerate()
        .map(|(number, members)| {
            let first = number * BAND;
            let mut band = Band::new(first, BAND.min(height - first), width, side);
            members.iter().for_each(|&index| band.draw(&triangles[index]));
            band
        })
        .collect();
    let mut bytes = Vec::with_capacity(4 * width * height);
    let mut farthest = Vec::with_capacity(width * height);
    for band in drawn {
        band.resolve(&mut bytes, &mut farthest);
    }
    Ok(Raster { image: Image::new(width as u32, height as u32, bytes)?, farthest })
}

/// The whole numbers below `count` whose pixels the coordinates reach.
fn covered(coordinates: [f64; 3], count: usize) -> Range<usize> {
    let [a, b, c] = coordinates;
    // The conversion takes what lies outside to the nearest end.
    let (low, high) = (a.min(b).min(c).floor() as usize, a.max(b).max(c).ceil() as usize);
    low.min(count)..high.min(count)
}

/// Samples of some rows of the image: `side` rows of `side·width` samples for each row of pixels.
struct Band {
    first_row: usize,
    rows: usize,
    width: usize,
    side: usize,
    nearness: Vec<f64>,
    /// Red, green, blue, opacity from 0 to 255, premultiplied.
    colors: Vec<[f32; 4]>,
}

impl Band {
    fn new(first_row: usize, rows: usize, width: usize, side: usize) -> Self {
        let count = rows * width * side * side;
        let (nearness, colors) = (vec![f64::NEG_INFINITY; count], vec![[0.0; 4]; count]);
        Self { first_row, rows, width, side, nearness, colors }
    }

    fn draw(&mut self, triangle: &[Corner; 3]) {
        let [a, mut b, mut c] = *triangle;
        let double_area = edge(a.at, b.at, c.at).0;
        if double_area < 0.0 {
            (b, c) = (c, b);
        }
        if double_area == 0.0 || double_area.is_nan() {
            return;
        }
        let colors = [a, b, c].map(|corner| premultiplied(corner.color));
        let is_opaque = [a, b, c].iter().all(|corner| corner.color.a == 255);
        let (side, scale) = (self.side, self.side as f64);
        let on_samples = |values: [f64; 3]| values.map(|value| value * scale);
        let columns = covered(on_samples([a.at.x, b.at.x, c.at.x]), self.width * side);
        let rows = covered(
            on_samples([a.at.y, b.at.y, c.at.y].map(|y| y - self.first_row as f64)),
            self.rows * side,
        );
        for row in rows {
            let y = self.first_row as f64 + (row as f64 + 0.5) / scale;
            let start = row * self.width * side;
            for column in columns.clone() {
                let at = DVec2::new((column as f64 + 0.5) / scale, y);
                let edges = [edge(b.at, c.at, at), edge(c.at, a.at, at), edge(a.at, b.at, at)];
                if !edges.iter().all(|&(value, owns)| value > 0.0 || (value == 0.0 && owns)) {
                    continue;
                }
                let parts = edges.map(|(value, _)| value / double_area.abs());
                let nearness = parts[0] * a.nearness + parts[1] * b.nearness + parts[2] * c.nearness;
                let sample = start + column;
                if nearness < self.nearness[sample] {
                    continue;
                }
                let weights = [parts[0] * a.weight, parts[1] * b.weight, parts[2] * c.weight];
                let weights = weights.map(|weight| (weight / weights.iter().sum::<f64>()) as f32);
                let mixed: [f32; 4] = std::array::from_fn(|part| {
                    weights[0] * colors[0][part] + weights[1] * colors[1][part] + weights[2] * colors[2][part]
                });
                if is_opaque {
                    self.nearness[sample] = nearness;
                    self.colors[sample] = mixed;
                } else {
                    let kept = 1.0 - mixed[3] / 255.0;
                    let under = self.colors[sample];
                    self.colors[sample] = std::array::from_fn(|part| mixed[part] + kept * under[part]);
                }
            }
        }
    }

    fn resolve(&self, bytes: &mut Vec<u8>, farthest: &mut Vec<f64>) {
        let (side, width) = (self.side, self.width);
        let share = 1.0 / (side * side) as f32;
        for row in 0..self.rows {
            for column in 0..width {
                let (mut sum, mut least) = ([0.0; 4], f64::INFINITY);
                for down in 0..side {
                    let start = ((row * side + down) * width + column) * side;
                    for sample in start..start + side {
                        least = least.min(self.nearness[sample]);
                        for part in 0..4 {
                            sum[part] += self.colors[sample][part] * share;
                        }
                    }
                }
                let unmultiply = if sum[3] > 0.0 { 255.0 / sum[3] } else { 0.0 };
                bytes.extend(
                    [sum[0] * unmultiply, sum[1] * unmultiply, sum[2] * unmultiply, sum[3]]
                        .map(|part| part.round() as u8),
                );
                farthest.push(least);
            }
        }
    }
}

/// Twice the signed area of the triangle `a`, `b`, `at`, and whether a point on the edge belongs to it. The number of the
/// reversed edge is exactly the negative, and exactly one of the two owns the edge.
fn edge(a: DVec2, b: DVec2, at: DVec2) -> (f64, bool) {
    let is_forward = (a.x, a.y) < (b.x, b.y);
    let (from, to) = if is_forward { (a, b) } else { (b, a) };
    let value = (to - from).perp_dot(at - from);
    (if is_forward { value } else { -value }, is_forward)
}

fn premultiplied(color: Color) -> [f32; 4] {
    let opacity = f32::from(color.a) / 255.0;
    let [r, g, b] = [color.r, color.g, color.b].map(|part| f32::from(part) * opacity);
    [r, g, b, f32::from(color.a)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Color = Color::hex(0xFF_00_00);

    fn triangle(corners: [(f64, f64); 3], nearness: [f64; 3], color: Color) -> [Corner; 3] {
        std::array::from_fn(|i| Corner {
            at: DVec2::new(corners[i].0, corners[i].1),
            nearness: nearness[i],
            weight: 1.0,
            color,
        })
    }

    fn area(image: &Image) -> f64 {
        image.pixels().chunks(4).map(|pixel| f64::from(pixel[3]) / 255.0).sum()
    }

    #[test]
    fn one_triangle_covers_exactly_its_pixels() {
        // Sample (i + 1/2, j + 1/2) is inside the triangle if i + j + 1 < 10.5.
        let drawn = triangle([(0.0, 0.0), (10.5, 0.0), (0.0, 10.5)], [0.0; 3], RED);
        let image = rasterize(&[drawn], 16, 20, 1).unwrap().image;
        for row in 0..20 {
            for column in 0..16 {
                let expected = if row + column < 10 { 255 } else { 0 };
                let found = image.color(column, row).unwrap();
                assert_eq!(found.a, expected, "column {column}, row {row}");
                assert!(expected == 0 || found == RED, "{found:?}");
            }
        }
    }

    #[test]
    fn areas_agree_within_a_pixel_in_either_orientation() {
        for side in [1, 2, 4] {
            let corners = [(3.3, 2.1), (97.2, 30.6), (40.9, 88.8)];
            let exact = 0.5 * ((97.2 - 3.3) * (88.8 - 2.1) - (30.6 - 2.1) * (40.9 - 3.3));
            let [a, b, c] = corners;
            for corners in [[a, b, c], [a, c, b]] {
                let image = rasterize(&[triangle(corners, [0.0; 3], RED)], 100, 100, side).unwrap().image;
                let error = (area(&image) - exact).abs();
                assert!(error < 4.0 / f64::from(side), "{side}² samples: {error} of {exact}");
            }
        }
    }

    #[test]
    fn a_fan_has_neither_gaps_nor_double_seams() {
        let half = RED.with_opacity(0.5);
        let rim = |k: u32| {
            let angle = f64::from(k) * std::f64::consts::TAU / 16.0;
            // The middle and some rays run exactly through samples.
            (20.5 + 60.0 * angle.cos(), 16.5 + 60.0 * angle.sin())
        };
        let fan: Vec<_> =
            (0..16).map(|k| triangle([(20.5, 16.5), rim(k), rim((k + 1) % 16)], [0.0; 3], half)).collect();
        let image = rasterize(&fan, 40, 33, 1).unwrap().image;
        assert!(image.pixels().chunks(4).all(|pixel| pixel[3] == 128), "covered once everywhere");
    }

    #[test]
    fn the_nearer_one_wins_whatever_the_order_and_crossing_ones_share() {
        let screen = [(-50.0, -50.0), (150.0, -50.0), (-50.0, 150.0)];
        let near = triangle(screen, [2.0; 3], RED);
        let far = triangle(screen, [1.0; 3], Color::hex(0x00_FF_00));
        for order in [[near, far], [far, near]] {
            let raster = rasterize(&order, 20, 20, 2).unwrap();
            assert!(raster.image.pixels().chunks(4).all(|pixel| pixel[0] == 255), "red is in front");
            assert!(raster.farthest.iter().all(|&nearness| (nearness - 2.0).abs() < 1e-12), "its depth");
        }
        // Nearness (x + 50)/200 against 0.3: equal at x = 10.
        let tilted = triangle(screen, [0.0, 1.0, 0.0], RED);
        let level = triangle(screen, [0.3; 3], Color::hex(0x00_FF_00));
        let image = rasterize(&[tilted, level], 20, 20, 1).unwrap().image;
        for column in 0..20 {
            let is_red = image.color(column, 7).unwrap().r == 255;
            assert_eq!(is_red, column >= 10, "column {column}");
        }
    }

    #[test]
    fn colours_run_linearly_and_opacity_blends_without_hiding() {
        let mut ramp = triangle([(0.0, -100.0), (0.0, 100.0), (100.0, 0.0)], [0.0; 3], Color::hex(0));
        ramp[2].color = Color::hex(0xC8_C8_C8);
        let image = rasterize(&[ramp], 100, 2, 4).unwrap().image;
        for column in [1, 40, 80] {
            let (found, expected) = (image.color(column, 0).unwrap().r, 2 * column + 1);
            assert!(
                u32::from(found).abs_diff(expected) <= 1,
                "column {column}: {found}, {expected} expected"
            );
        }
        let screen = [(-50.0, -50.0), (150.0, -50.0), (-50.0, 150.0)];
        let veil = triangle(screen, [2.0; 3], Color::hex(0xFF_FF_FF).with_opacity(0.5));
        let wall = triangle(screen, [1.0; 3], RED);
        let raster = rasterize(&[wall, veil], 4, 4, 1).unwrap();
        let found = raster.image.color(1, 1).unwrap();
        assert!(found.r == 255 && found.g.abs_diff(128) <= 1 && found.a == 255, "{found:?}");
        assert!((raster.farthest[5] - 1.0).abs() < 1e-12, "the depth is that of the wall");
    }

    #[test]
    fn hostile_triangles_and_sizes_do_no_harm() {
        let hostile = [
            triangle([(f64::NAN, 0.0), (1.0, 0.0), (0.0, 1.0)], [0.0; 3], RED),
            triangle([(f64::INFINITY, 0.0), (1.0, 0.0), (0.0, 1.0)], [0.0; 3], RED),
            triangle([(-1e300, -1e300), (1e300, 0.0), (0.0, 1e300)], [0.0; 3], RED),
            triangle([(1.0, 1.0), (1.0, 1.0), (5.0, 5.0)], [0.0; 3], RED),
            triangle([(0.0, 0.0), (5.0, 0.0), (0.0, 5.0)], [f64::NAN; 3], RED),
        ];
        assert!(rasterize(&hostile, 8, 8, 2).is_ok(), "nothing to draw");
        for (width, height, side) in [(0, 5, 1), (5, 5, 0), (5, 5, 9), (u32::MAX, u32::MAX, 1)] {
            let error = rasterize(&[], width, height, side).unwrap_err();
            assert_eq!(error.name(), "StepLimit", "{error}");
        }
    }
}
