//! Coloured triangles and images on a page, for formats without colours that vary over a triangle.
//!
//! A triangle becomes pieces of one colour each, fine enough to look smooth; if a mesh needs too many of them, it becomes an image.

use std::sync::Arc;

use glam::DVec2;

use crate::exchange::page::{Medium, PageItem};
use crate::figure::mesh::{Image, Mesh, PlacedImage};
use crate::figure::picture::{Color, Path, Stroke, Viewport};
use crate::figure::raster::{Corner, rasterize};

/// Up to so many pieces a mesh is drawn as polygons.
const MOST_PIECES: usize = 12_000;
/// Colours of neighbouring pieces of a triangle differ at most by about this, of 255: the first that needs few enough pieces.
const COLOR_STEPS: [f64; 4] = [8.0, 12.0, 18.0, 27.0];
/// Width in pt of the rim, of its own colour, that hides the seam between a piece and its neighbour.
const RIM: f64 = 0.35;
/// Samples per side of a pixel.
const SAMPLES: u32 = 3;
/// Images of meshes have at most so many pixels; larger ones become coarser.
const MOST_PIXELS: f64 = 2.5e7;

/// The image on the page; nothing if its box is none.
pub(super) fn image_on_page<'a>(placed: &PlacedImage, view: &Viewport) -> Option<PageItem<'a>> {
    let corners = [placed.low, placed.high].map(|corner| view.page_from_world(corner));
    let corner = DVec2::new(corners[0].x, corners[1].y);
    let size = DVec2::new(corners[1].x, corners[0].y) - corner;
    let is_box = corner.is_finite() && size.is_finite() && size.cmpgt(DVec2::ZERO).all();
    let has_pixels = placed.image.width() > 0 && placed.image.height() > 0;
    (is_box && has_pixels).then(|| PageItem::Image { corner, size, image: Arc::clone(&placed.image) })
}

/// The mesh as polygons or as an image.
pub(super) fn mesh_on_page<'a>(mesh: &Mesh, view: &Viewport, medium: Medium) -> Vec<PageItem<'a>> {
    let on_page = || {
        mesh.corners()
            .map(|corners| corners.map(|(point, color)| (view.page_from_world(point), color)))
            .filter(|corners| {
                let (low, high) = bounds(corners.iter().map(|corner| corner.0));
                low.is_finite()
                    && high.is_finite()
                    && high.cmpge(DVec2::ZERO).all()
                    && low.cmple(view.size).all()
            })
    };
    let steps = COLOR_STEPS.into_iter().filter(|_| medium == Medium::Vectors);
    for step in steps {
        let mut counts = on_page().map(|corners| parts(&corners, step).pow(2));
        let count = counts.try_fold(0, |sum, count| (sum + count <= MOST_PIECES).then_some(sum + count));
        if count.is_some() {
            return on_page().flat_map(|corners| pieces(&corners, parts(&corners, step))).collect();
        }
    }
    image_of(on_page(), view, medium.pixels_per_point()).into_iter().collect()
}

fn bounds(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    points
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), point| (low.min(point), high.max(point)))
}

/// How many parts each side of the triangle is divided into.
fn parts(corners: &[(DVec2, Color); 3], color_step: f64) -> usize {
    let channels = [|c: Color| c.r, |c: Color| c.g, |c: Color| c.b, |c: Color| c.a];
    let range = channels.into_iter().map(|channel| {
        let values = corners.map(|(_, color)| channel(color));
        values.into_iter().max().unwrap_or(0) - values.into_iter().min().unwrap_or(0)
    });
    (f64::from(range.max().unwrap_or(0)) / color_step).ceil().max(1.0) as usize
}

/// The triangle as `count²` congruent ones, each with the colour of its middle.
fn pieces<'a>(corners: &[(DVec2, Color); 3], count: usize) -> Vec<PageItem<'a>> {
    let [a, b, c] = *corners;
    let at = |i: usize, j: usize| {
        let (u, v) = (i as f64 / count as f64, j as f64 / count as f64);
        a.0 * (1.0 - u - v) + b.0 * u + c.0 * v
    };
    let color = |i: f64, j: f64| {
        let (u, v) = (i / count as f64, j / count as f64);
        let mix = |part: fn(Color) -> u8| {
            let [a, b, c] = [a.1, b.1, c.1].map(|color| f64::from(part(color)));
            (a * (1.0 - u - v) + b * u + c * v).round() as u8
        };
        Color { r: mix(|c| c.r), g: mix(|c| c.g), b: mix(|c| c.b), a: mix(|c| c.a) }
    };
    let piece = |places: [(usize, usize); 3]| {
        let third =
            |part: fn((usize, usize)) -> usize| places.iter().map(|&p| part(p) as f64).sum::<f64>() / 3.0;
        let color = color(third(|p| p.0), third(|p| p.1));
        // Rims of translucent pieces would show.
        let rim = (color.a == 255).then(|| Stroke::solid(color, RIM));
        PageItem::Path(Path::polygon(&places.map(|(i, j)| at(i, j)), rim, Some(color)))
    };
    let mut items = Vec::with_capacity(count * count);
    for j in 0..count {
        for i in 0..count - j {
            items.push(piece([(i, j), (i + 1, j), (i, j + 1)]));
            if i + j + 2 <= count {
                items.push(piece([(i + 1, j), (i + 1, j + 1), (i, j + 1)]));
            }
        }
    }
    items
}

/// What of the triangles is on the page, as an image.
fn image_of<'a>(
    triangles: impl Iterator<Item = [(DVec2, Color); 3]>,
    view: &Viewport,
    pixels_per_point: f64,
) -> Option<PageItem<'a>> {
    let triangles: Vec<[(DVec2, Color); 3]> = triangles.collect();
    let (low, high) = bounds(triangles.iter().flatten().map(|corner| corner.0));
    let (low, high) = (low.max(DVec2::ZERO), high.min(view.size));
    let area = (high - low).x * (high - low).y;
    let resolution = pixels_per_point.min((MOST_PIXELS / area).sqrt());
    // Whole pixels of the page, so that an image of the page's resolution is not resampled.
    let low = (low * resolution).floor() / resolution;
    let pixels = ((high - low) * resolution).ceil();
    let corners: Vec<[Corner; 3]> = triangles
        .iter()
        .map(|triangle| {
            triangle.map(|(at, color)| Corner {
                at: (at - low) * resolution,
                nearness: 0.0,
                weight: 1.0,
                color,
            })
        })
        .collect();
    let image: Image = rasterize(&corners, pixels.x as u32, pixels.y as u32, SAMPLES).ok()?.image;
    Some(PageItem::Image { corner: low, size: pixels / resolution, image: Arc::new(image) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> Viewport {
        Viewport { center: DVec2::splat(5.0), scale: 10.0, size: DVec2::splat(100.0) }
    }

    fn ramp(colors: [u32; 3]) -> Mesh {
        let points = vec![DVec2::new(1.0, 1.0), DVec2::new(9.0, 1.0), DVec2::new(1.0, 9.0)];
        Mesh::new(points, colors.map(Color::hex).to_vec(), vec![[0, 1, 2]]).unwrap()
    }

    #[test]
    fn a_plain_triangle_is_one_polygon_and_a_ramp_many_that_fill_it() {
        let plain = mesh_on_page(&ramp([0x12_34_56; 3]), &view(), Medium::Vectors);
        assert_eq!(plain.len(), 1, "one colour");
        let ramp = mesh_on_page(&ramp([0x00_00_00, 0x64_00_00, 0x00_00_00]), &view(), Medium::Vectors);
        assert_eq!(ramp.len(), 169, "13 steps of at most 8 in 100");
        let mut area = 0.0;
        for item in &ramp {
            let PageItem::Path(path) = item else { panic!("a polygon") };
            let corners: Vec<DVec2> =
                path.segments
                    .iter()
                    .filter_map(|segment| match *segment {
                        crate::figure::picture::Segment::Move(to)
                        | crate::figure::picture::Segment::Line(to) => Some(to),
                        _ => None,
                    })
                    .collect();
            area += 0.5 * (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]).abs();
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let expected = 100.0 * (middle.x - 10.0) / 80.0;
            let found = f64::from(path.fill.unwrap().r);
            assert!((found - expected).abs() <= 0.5 + 1e-9, "{found} at {middle}");
        }
        assert!((area - 3200.0).abs() < 1e-9, "{area} square points");
    }

    #[test]
    fn many_colours_become_an_image_of_what_is_on_the_page() {
        let count = 80_000u32;
        let points = (0..count).flat_map(|k| {
            let at = DVec2::new(f64::from(k % 400) * 0.05 - 5.0, f64::from(k / 400) * 0.05);
            [at, at + DVec2::new(0.05, 0.0), at + DVec2::new(0.0, 0.05)]
        });
        let colors = vec![Color::hex(0x80_80_80); 3 * count as usize];
        let triangles = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh::new(points.collect(), colors, triangles).unwrap();
        let items = mesh_on_page(&mesh, &view(), Medium::Pixels(2.0));
        let [PageItem::Image { corner, size, image }] = items.as_slice() else {
            panic!("{} items", items.len())
        };
        assert_eq!((*corner, *size), (DVec2::ZERO, DVec2::splat(100.0)), "cut at the page");
        assert_eq!((image.width(), image.height()), (200, 200), "2 pixels per pt");
        let enlargeable = mesh_on_page(&mesh, &view(), Medium::Vectors);
        assert!(matches!(enlargeable[..], [PageItem::Image { .. }]), "too many for polygons");
    }

    #[test]
    fn places_without_a_page_are_left_out() {
        let nowhere = Viewport { scale: f64::NAN, ..view() };
        assert!(mesh_on_page(&ramp([0; 3]), &nowhere, Medium::Vectors).is_empty(), "no place");
        let image = Arc::new(Image::new(1, 1, vec![0; 4]).unwrap());
        for (low, high) in [(DVec2::ZERO, DVec2::ZERO), (DVec2::ONE, DVec2::ZERO), (DVec2::NAN, DVec2::ONE)] {
            let placed = PlacedImage { low, high, image: Arc::clone(&image) };
            assert!(image_on_page(&placed, &view()).is_none(), "{low} to {high}");
        }
    }
}
