//! A scene on paper: surfaces as triangles in the painter's order or, if there are many, as an image; lines and marks as
//! vectors, without what surfaces hide.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::core::point::Point as _;
use crate::figure::clip::segment_in_box;
use crate::figure::error::FigureError;
use crate::figure::mesh::{Image, Mesh, PlacedImage};
use crate::figure::picture::{Item, Label, Marker, Path, Picture, Viewport};
use crate::figure::raster::{Corner, Raster, rasterize};
use crate::figure::scene::shading::{Facet, depth_of, facets, nearness, sort_from_far};
use crate::figure::scene::{EyeView, Light, Line, Points, Scene, SceneItem, SceneLabel};

/// Up to so many triangles stay triangles.
const MOST_VECTOR_FACETS: usize = 3000;
/// The painter's order is taken for right if at most this part of the pixels differs from the depth buffer's image.
const WRONG_PIXELS: f64 = 5e-4;
/// Pixels differ if a channel does by more than this.
const CHANNEL_TOLERANCE: u8 = 24;
/// Samples per side of a pixel.
const SAMPLES: u32 = 3;
/// Lines and marks are seen though they are behind a surface by this part of the scene's diagonal: curves run within the
/// surface, whose triangles are chords.
const DEPTH_SLACK: f64 = 0.004;
/// Distance in pt of the places where a line is tested.
const LINE_STEP: f64 = 0.5;
/// A test splits a step between seen and hidden so often into halves.
const HALVINGS: usize = 5;
/// Lines are drawn so far beyond the page, in pt.
const MARGIN: f64 = 20.0;

/// How a scene is put on paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// The eye and the page in pt.
    pub view: EyeView,
    /// The light.
    pub light: Light,
    /// Pixels per pt of images, and of the depths that decide what is hidden.
    pub pixels_per_point: f64,
}

impl Paper {
    /// The view that shows [`Self::picture`] whole: 1 unit is 1 pt, the origin is the lower left corner.
    pub fn viewport(&self) -> Viewport {
        let size = self.view.size;
        Viewport { center: size * 0.5, scale: 1.0, size }
    }

    /// The scene as a picture. Its first layer, `surfaces`, is a [`Mesh`] if there are at most 3000 triangles on the page and the
    /// painter's order shows them rightly, an image otherwise; then come the layers of the scene.
    ///
    /// # Errors
    ///
    /// `StepLimit` if the page has no or too many pixels.
    pub fn picture(&self, scene: &Scene) -> Result<Picture, FigureError> {
        self.picture_of(scene, true)
    }

    /// As [`Self::picture`], with the surfaces as an image however few triangles there are.
    ///
    /// # Errors
    ///
    /// `StepLimit` if the page has no or too many pixels.
    pub fn picture_with_image(&self, scene: &Scene) -> Result<Picture, FigureError> {
        self.picture_of(scene, false)
    }

    fn picture_of(&self, scene: &Scene, may_be_mesh: bool) -> Result<Picture, FigureError> {
        let facets = facets(scene, &self.view, &self.light);
        let raster = self.raster(&facets)?;
        let mut picture = Picture::new(scene.background);
        if !facets.is_empty() {
            let mesh = if may_be_mesh { self.painted(&facets, &raster.image)? } else { None };
            let item = match mesh {
                Some(mesh) => Item::Mesh(mesh),
                None => {
                    let (low, high) = (DVec2::ZERO, self.view.size);
                    Item::Image(PlacedImage { low, high, image: Arc::new(raster.image.clone()) })
                }
            };
            picture.push_layer("surfaces", vec![item]);
        }
        let hidden = Hidden { paper: self, raster: &raster, slack: depth_slack(scene) };
        for layer in &scene.layers {
            let items = layer.items.iter().flat_map(|item| match item {
                SceneItem::Triangles(_) => Vec::new(),
                SceneItem::Line(line) => hidden.line(line),
                SceneItem::Points(points) => hidden.points(points),
                SceneItem::Label(label) => hidden.label(label).into_iter().collect(),
            });
            picture.push_layer(layer.name.clone(), items.collect());
        }
        Ok(picture)
    }

    /// Surfaces and lines as an image, clear where there is nothing; without marks, texts and dashes.
    ///
    /// # Errors
    ///
    /// `StepLimit` if the page has no or too many pixels.
    pub fn image(&self, scene: &Scene) -> Result<Image, FigureError> {
        let mut facets = facets(scene, &self.view, &self.light);
        let slack = depth_slack(scene);
        // Translucent surfaces, the last ones, are to veil the lines behind them.
        let opaque = facets.partition_point(Facet::is_opaque);
        let lines = scene.layers.iter().flat_map(|layer| &layer.items).filter_map(|item| match item {
            SceneItem::Line(line) => Some(line),
            _ => None,
        });
        facets.splice(opaque..opaque, lines.flat_map(|line| self.ribbon(line, slack)).collect::<Vec<_>>());
        Ok(self.raster(&facets)?.image)
    }

    fn raster(&self, facets: &[Facet]) -> Result<Raster, FigureError> {
        let pixels = (self.view.size * self.pixels_per_point).round();
        let scale = pixels / self.view.size;
        let triangles: Vec<[Corner; 3]> = facets
            .iter()
            .map(|facet| facet.corners.map(|corner| Corner { at: corner.at * scale, ..corner }))
            .collect();
        // The conversion takes what is not a number of pixels to one that is refused.
        rasterize(&triangles, pixels.x as u32, pixels.y as u32, SAMPLES)
    }

    /// The facets from back to front, if that shows the same as the depth buffer.
    fn painted(&self, facets: &[Facet], right: &Image) -> Result<Option<Mesh>, FigureError> {
        if facets.len() > MOST_VECTOR_FACETS {
            return Ok(None);
        }
        let mut sorted = facets.to_vec();
        sort_from_far(&mut sorted);
        let mut flat = sorted.clone();
        flat.iter_mut().flat_map(|facet| &mut facet.corners).for_each(|corner| corner.nearness = 0.0);
        let painted = self.raster(&flat)?.image;
        let differs =
            |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > CHANNEL_TOLERANCE);
        let wrong = painted.pixels().chunks(4).zip(right.pixels().chunks(4)).filter(differs).count();
        let all = right.pixels().len() / 4;
        if wrong as f64 > WRONG_PIXELS * all as f64 {
            return Ok(None);
        }
        let corners = || sorted.iter().flat_map(|facet| &facet.corners);
        let points = corners().map(|corner| self.upright(corner.at)).collect();
        let colors = corners().map(|corner| corner.color).collect();
        let triangles = (0..sorted.len() as u32).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]);
        Mesh::new(points, colors, triangles.collect()).map(Some)
    }

    /// From the page (y down) to the picture's world (y up).
    fn upright(&self, page: DVec2) -> DVec2 {
        DVec2::new(page.x, self.view.size.y - page.y)
    }

    /// The line as strips of its width, a little nearer than it is.
    fn ribbon(&self, line: &Line, slack: f64) -> Vec<Facet> {
        let half = 0.5 * line.stroke.width;
        if !(half.is_finite() && half > 0.0) {
            return Vec::new();
        }
        let strips = line.points.windows(2).filter_map(|ends| {
            let [a, b] = self.ends(ends[0], ends[1])?;
            let along = (b.at - a.at).normalize_or(DVec2::X) * half;
            let corner = |end: End, beside: f64, beyond: f64| {
                let depth = depth_of(&self.view, end.nearness) - slack;
                let depth =
                    if self.view.eye.state().orthographic { depth } else { depth.max(self.view.eye.near()) };
                let nearness = if line.on_top { f64::MAX } else { nearness(&self.view, depth) };
                let at = end.at + along.perp() * beside + along * beyond;
                Corner { at, nearness, weight: 1.0, color: line.stroke.color }
            };
            // Half a width beyond the ends, so that strips meet at bends.
            let [p, q] = [corner(a, 1.0, -1.0), corner(a, -1.0, -1.0)];
            let [r, s] = [corner(b, -1.0, 1.0), corner(b, 1.0, 1.0)];
            Some([[p, q, r], [p, r, s]].map(|corners| Facet { corners, depth: 0.0 }))
        });
        strips.flatten().collect()
    }

    /// The ends of the part of a segment that is in front of the eye and near the page.
    fn ends(&self, a: DVec3, b: DVec3) -> Option<[End; 2]> {
        let near = self.view.eye.near() * (1.0 + 1e-9);
        let [above, below] = [a, b].map(|point| self.view.eye.depth(point) - near);
        let [a, b] = match (above > 0.0, below > 0.0) {
            (true, true) => [a, b],
            (true, false) => [a, a.mix(b, above / (above - below))],
            (false, true) => [a.mix(b, above / (above - below)), b],
            (false, false) => return None,
        };
        let end = |point: DVec3| {
            let seen = self.view.project(point)?;
            Some(End { at: seen.page, nearness: nearness(&self.view, seen.depth) })
        };
        let (a, b) = (end(a)?, end(b)?);
        let margin = DVec2::splat(MARGIN);
        let (from, to) = segment_in_box(a.at, b.at, -margin, self.view.size + margin)?;
        let length = a.at.distance(b.at);
        let share = |place: DVec2| if length > 0.0 { a.at.distance(place) / length } else { 0.0 };
        let cut = |place: DVec2| End { at: place, nearness: a.nearness.mix(b.nearness, share(place)) };
        Some([if from == a.at { a } else { cut(from) }, if to == b.at { b } else { cut(to) }])
    }
}

/// A place on the page in pt with its nearness.
#[derive(Clone, Copy, Debug)]
struct End {
    at: DVec2,
    nearness: f64,
}

/// World length by which lines and marks may lie behind a surface.
pub(crate) fn depth_slack(scene: &Scene) -> f64 {
    scene.bounding_box().map_or(0.0, |(low, high)| DEPTH_SLACK * low.distance(high))
}

/// What surfaces hide.
struct Hidden<'a> {
    paper: &'a Paper,
    raster: &'a Raster,
    slack: f64,
}

impl Hidden<'_> {
    fn is_seen(&self, place: End) -> bool {
        let (width, height) = (self.raster.image.width(), self.raster.image.height());
        let pixel = place.at / self.paper.view.size * DVec2::new(f64::from(width), f64::from(height));
        if pixel.cmplt(DVec2::ZERO).any() || pixel.x >= f64::from(width) || pixel.y >= f64::from(height) {
            return true;
        }
        let surface = self.raster.farthest[pixel.y as usize * width as usize + pixel.x as usize];
        let view = &self.paper.view;
        surface == f64::NEG_INFINITY || depth_of(view, place.nearness) <= depth_of(view, surface) + self.slack
    }

    fn line(&self, line: &Line) -> Vec<Item> {
        let mut parts: Vec<Vec<DVec2>> = Vec::new();
        let mut end_of_last = None;
        for ends in line.points.windows(2) {
            let Some([a, b]) = self.paper.ends(ends[0], ends[1]) else { continue };
            for [from, to] in self.seen_parts(a, b, line.on_top) {
                match parts.last_mut() {
                    Some(part) if end_of_last == Some(from) => part.push(to),
                    _ => parts.push(vec![from, to]),
                }
                end_of_last = Some(to);
            }
        }
        let path = |part: &Vec<DVec2>| {
            let points: Vec<DVec2> = part.iter().map(|&page| self.paper.upright(page)).collect();
            Item::Path(Path::polyline(&points, line.stroke.clone()))
        };
        parts.iter().map(path).collect()
    }

    fn seen_parts(&self, a: End, b: End, on_top: bool) -> Vec<[DVec2; 2]> {
        if on_top {
            return vec![[a.at, b.at]];
        }
        let steps = (a.at.distance(b.at) / LINE_STEP).ceil().max(1.0) as usize;
        let place = |t: f64| match t {
            0.0 => a,
            1.0 => b,
            _ => End { at: a.at.mix(b.at, t), nearness: a.nearness.mix(b.nearness, t) },
        };
        let mut parts = Vec::new();
        let mut start = self.is_seen(a).then_some(0.0);
        for step in 1..=steps {
            let (before, t) = ((step - 1) as f64 / steps as f64, step as f64 / steps as f64);
            let is_seen = self.is_seen(place(t));
            if is_seen == start.is_some() {
                continue;
            }
            let (mut same, mut other) = (before, t);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (same + other);
                if self.is_seen(place(middle)) == is_seen { other = middle } else { same = middle }
            }
            match start {
                Some(from) => {
                    parts.push([place(from).at, place(same).at]);
                    start = None;
                }
                None => start = Some(other),
            }
        }
        parts.extend(start.map(|from| [place(from).at, b.at]));
        parts.retain(|[from, to]| from != to);
        parts
    }

    fn points(&self, points: &Points) -> Vec<Item> {
        let marker = |&point: &DVec3| {
            let seen = self.paper.view.project(point)?;
            let place = End { at: seen.page, nearness: nearness(&self.paper.view, seen.depth) };
            (points.on_top || self.is_seen(place)).then(|| {
                Item::Marker(Marker {
                    at: self.paper.upright(seen.page),
                    shape: points.shape,
                    size: points.size,
                    fill: Some(points.fill),
                    stroke: points.outline.clone(),
                })
            })
        };
        points.points.iter().filter_map(marker).collect()
    }

    fn label(&self, label: &SceneLabel) -> Option<Item> {
        let seen = self.paper.view.project(label.at)?;
        Some(Item::Label(Label {
            at: self.paper.upright(seen.page),
            offset: label.offset,
            text: label.text.clone(),
            size: label.size,
            color: label.color,
            anchor: label.anchor,
            math: label.math,
        }))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::document::EyeState;
    use crate::figure::picture::{Color, MarkerShape, Segment, Stroke};
    use crate::figure::scene::{Eye, StandardView, Triangles};
    use crate::figure::theme::Theme;

    /// A page of 200 pt that shows the square of side 4 around the origin in parallel projection: 50 pt per unit.
    fn paper(view: StandardView) -> Paper {
        let state = EyeState {
            distance: 10.0,
            field_of_view: 2.0 * 0.2f64.atan(),
            orthographic: true,
            ..EyeState::default()
        };
        let eye = Eye::new(state).unwrap().turned_to(view);
        let view = EyeView { eye, size: DVec2::splat(200.0) };
        Paper { view, light: Theme::light().light, pixels_per_point: 1.0 }
    }

    fn surface(positions: &[[f64; 3]], triangles: &[[u32; 3]], color: u32) -> SceneItem {
        let positions = positions.iter().copied().map(DVec3::from_array).collect();
        let mut triangles = Triangles::new(positions, triangles.to_vec(), Color::hex(color)).unwrap();
        triangles.is_lit = false;
        SceneItem::Triangles(triangles)
    }

    /// The square [-1, 1]² at height z.
    fn square(z: f64, color: u32) -> SceneItem {
        let corners = [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
        surface(&corners, &[[0, 1, 2], [0, 2, 3]], color)
    }

    fn line(points: &[[f64; 3]]) -> Line {
        let points = points.iter().copied().map(DVec3::from_array).collect();
        Line::new(points, Stroke::solid(Color::hex(0), 1.0)).unwrap()
    }

    fn scene(items: Vec<SceneItem>) -> Scene {
        let mut scene = Scene::new(None);
        scene.push_layer("all", items);
        scene
    }

    /// Visible parts in the picture, each from its first to its last point.
    fn parts(picture: &Picture) -> Vec<[DVec2; 2]> {
        let items = picture.layers.iter().flat_map(|layer| &layer.items);
        let ends = items.filter_map(|item| match item {
            Item::Path(path) => match (path.segments.first(), path.segments.last()) {
                (Some(&Segment::Move(from)), Some(&Segment::Line(to))) => Some([from, to]),
                _ => None,
            },
            _ => None,
        });
        ends.collect()
    }

    #[test]
    fn a_square_covers_its_area_and_lies_where_it_should() {
        let image = paper(StandardView::Top).image(&scene(vec![square(0.0, 0xFF_00_00)])).unwrap();
        for row in 0..200 {
            for column in 0..200 {
                let inside = (50..150).contains(&row) && (50..150).contains(&column);
                let found = image.color(column, row).unwrap().a;
                assert_eq!(found, if inside { 255 } else { 0 }, "column {column}, row {row}");
            }
        }
    }

    #[test]
    fn the_upper_square_is_seen_from_above_and_the_lower_from_below() {
        let both = scene(vec![square(1.0, 0xFF_00_00), square(-1.0, 0x00_00_FF)]);
        let mut below = paper(StandardView::Top);
        below.view.eye = below.view.eye.orbited(0.0, -PI);
        for (paper, expected) in [(paper(StandardView::Top), 0xFF_00_00), (below, 0x00_00_FF)] {
            let image = paper.image(&both).unwrap();
            assert_eq!(image.color(100, 100), Some(Color::hex(expected)), "in the middle");
            let picture = paper.picture(&both).unwrap();
            let Item::Mesh(mesh) = &picture.layers[0].items[0] else {
                panic!("four triangles stay triangles")
            };
            let last = mesh.triangles().last().unwrap()[0];
            assert_eq!(mesh.colors()[last as usize], Color::hex(expected), "painted last");
        }
    }

    #[test]
    fn lines_end_where_a_surface_hides_them() {
        for perspective in [false, true] {
            let mut paper = paper(StandardView::Top);
            paper.view.eye = paper.view.eye.with_orthographic(!perspective);
            let below = line(&[[-1.8, 0.1, -1.0], [0.3, 0.1, -1.0], [1.8, 0.1, -1.0]]);
            let items = vec![square(0.0, 0x80_80_80), SceneItem::Line(below.clone())];
            let found = parts(&paper.picture(&scene(items)).unwrap());
            // In parallel projection the edges are at 50 and 150 pt, also in perspective: they are at the target's depth.
            let [first, second] = found[..] else { panic!("{found:?}") };
            assert!((first[1].x - 50.0).abs() <= 1.0 && (second[0].x - 150.0).abs() <= 1.0, "{found:?}");
            let items = vec![square(0.0, 0x80_80_80), SceneItem::Line(below.on_top())];
            assert_eq!(parts(&paper.picture(&scene(items)).unwrap()).len(), 1, "over everything");
            let above = line(&[[-1.8, 0.1, 0.5], [1.8, 0.1, 0.5]]);
            let items = vec![square(0.0, 0x80_80_80), SceneItem::Line(above)];
            assert_eq!(parts(&paper.picture(&scene(items)).unwrap()).len(), 1, "above");
            let within = line(&[[-1.8, 0.1, 0.0], [1.8, 0.1, 0.0]]);
            let items = vec![square(0.0, 0x80_80_80), SceneItem::Line(within)];
            assert_eq!(parts(&paper.picture(&scene(items)).unwrap()).len(), 1, "within the surface");
        }
    }

    #[test]
    fn marks_behind_a_surface_are_hidden_unless_they_lie_on_top() {
        let points = vec![DVec3::new(0.0, 0.0, -1.0), DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.5, 0.0, -1.0)];
        let marks = Points::new(points, MarkerShape::Disc, 5.0, Color::hex(0)).unwrap();
        let count = |marks: Points| {
            let items = vec![square(0.0, 0x80_80_80), SceneItem::Points(marks)];
            let picture = paper(StandardView::Top).picture(&scene(items)).unwrap();
            picture.layers[1].items.len()
        };
        assert_eq!(count(marks.clone()), 2, "one is behind");
        assert_eq!(count(marks.on_top()), 3, "all");
    }

    #[test]
    fn raster_lines_have_their_width_and_are_hidden_by_depth() {
        let mut wide = line(&[[-3.0, 0.0, -1.0], [3.0, 0.0, -1.0]]);
        wide.stroke.width = 6.0;
        let with_line = |line: Line| {
            paper(StandardView::Top).image(&scene(vec![square(0.0, 0xFF_00_00), SceneItem::Line(line)]))
        };
        let column = |image: &Image, column: u32| {
            (0..200).filter(|&row| image.color(column, row) == Some(Color::hex(0))).count()
        };
        let image = with_line(wide.clone()).unwrap();
        assert_eq!(column(&image, 20), 6, "6 pt at 1 pixel per pt");
        assert_eq!(column(&image, 100), 0, "hidden");
        assert_eq!(column(&with_line(wide.on_top()).unwrap(), 100), 6, "over everything");
        let mut within = line(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
        within.stroke.width = 6.0;
        assert_eq!(column(&with_line(within).unwrap(), 100), 6, "slightly in front");
    }

    #[test]
    fn crossing_triangles_become_an_image_since_no_order_is_right() {
        let wall = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.5]];
        let tilted = [[-1.0, -1.0, -0.5], [1.0, -1.0, -0.5], [0.0, 1.5, 0.5]];
        let items =
            vec![surface(&wall, &[[0, 1, 2]], 0xFF_00_00), surface(&tilted, &[[0, 1, 2]], 0x00_FF_00)];
        let picture = paper(StandardView::Isometric).picture(&scene(items)).unwrap();
        let item = &picture.layers[0].items[0];
        assert!(matches!(item, Item::Image(_)), "an image shows both fronts");
    }

    /// The disc of a sphere has the area πr², whatever the tessellation's detail.
    #[test]
    fn many_triangles_become_an_image_of_the_right_outline() {
        let (rows, columns) = (60u32, 120u32);
        let at = |row: u32, column: u32| {
            let (latitude, longitude) =
                (PI * f64::from(row) / f64::from(rows), TAU * f64::from(column) / f64::from(columns));
            DVec3::new(latitude.sin() * longitude.cos(), latitude.sin() * longitude.sin(), -latitude.cos())
        };
        let positions: Vec<DVec3> =
            (0..=rows).flat_map(|row| (0..=columns).map(move |column| at(row, column))).collect();
        let stride = columns + 1;
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| row * stride + column));
        let triangles: Vec<[u32; 3]> =
            cells.flat_map(|k| [[k, k + 1, k + stride + 1], [k, k + stride + 1, k + stride]]).collect();
        let sphere = Triangles::new(positions.clone(), triangles, Color::hex(0x80_A0_C0)).unwrap();
        let sphere = sphere.with_normals(positions).unwrap();
        let picture =
            paper(StandardView::Isometric).picture(&scene(vec![SceneItem::Triangles(sphere)])).unwrap();
        let Item::Image(placed) = &picture.layers[0].items[0] else { panic!("14400 triangles") };
        let area: f64 = placed.image.pixels().chunks(4).map(|pixel| f64::from(pixel[3]) / 255.0).sum();
        let exact = PI * 50.0 * 50.0;
        assert!((area / exact - 1.0).abs() < 5e-3, "{area} of {exact}");
        let middle = placed.image.color(100, 100).unwrap();
        let rim = placed.image.color(100, 147).unwrap();
        assert!(middle.r > rim.r, "brighter in the middle {middle:?} than at the lower rim {rim:?}");
    }

    #[test]
    fn what_passes_the_eye_is_cut() {
        let mut through = paper(StandardView::Front);
        through.view.eye = through.view.eye.with_orthographic(false);
        let ground = [[-1e3, -1e3, -1.0], [1e3, -1e3, -1.0], [1e3, 1e3, -1.0], [-1e3, 1e3, -1.0]];
        let items = vec![
            surface(&ground, &[[0, 1, 2], [0, 2, 3]], 0x00_80_00),
            SceneItem::Line(line(&[[0.0, -1e3, -0.9], [0.0, 1e3, -0.9]])),
        ];
        let image = through.image(&scene(items.clone())).unwrap();
        let seen = |row: u32| image.color(60, row).unwrap().a;
        assert_eq!((seen(0), seen(90), seen(110), seen(199)), (0, 0, 255, 255), "ground below the horizon");
        let found = parts(&through.picture(&scene(items)).unwrap());
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn impossible_pages_are_refused() {
        for (size, pixels_per_point) in
            [(0.0, 1.0), (-5.0, 1.0), (f64::NAN, 1.0), (100.0, 1e9), (100.0, f64::NAN), (1e300, 1.0)]
        {
            let mut paper = paper(StandardView::Top);
            paper.view.size = DVec2::splat(size);
            paper.pixels_per_point = pixels_per_point;
            let error = paper.picture(&scene(vec![square(0.0, 0)])).unwrap_err();
            assert_eq!(error.name(), "StepLimit", "{size} pt at {pixels_per_point}: {error}");
        }
    }
}
