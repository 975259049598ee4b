//! Paints a [`Picture`] with egui: cubics are flattened and clipped in f64 before anything becomes f32.

use eframe::egui::{
    Align, Align2, Color32, ColorImage, FontFamily, FontId, Painter, Pos2, Rect, Shape, Stroke as PenStroke,
    TextureOptions, Vec2, epaint, pos2, vec2,
};
use glam::DVec2;

use crate::app::formula_view::paint_formula;
use crate::figure::formula;
use crate::figure::mesh::{Mesh, PlacedImage};
use crate::figure::picture::{
    Anchor, Color, Item, Label, Marker, MarkerShape, Path, Picture, Segment, Viewport,
};
use crate::figure::theme::Theme;

/// Largest distance in pt between a painted polyline and the cubic it stands for.
const FLATNESS: f64 = 0.1;

/// A cubic is halved at most this often: with culling 40 levels reach every zoom that f64 allows.
const MAX_DEPTH: u32 = 40;

/// Largest distance in pt between a painted polyline of many points and the same with points left out.
const THINNED: f64 = 0.1;

/// Polylines with fewer points are painted as they are.
const FEW_POINTS: usize = 64;

/// In a layer with more markers than this, those that would cover each other are left out.
const MANY_MARKERS: usize = 600;

/// Margin around the canvas, in pt, within which lines are still painted (wide strokes, round ends).
const MARGIN: f64 = 40.0;

/// The colour as egui wants it.
pub(crate) fn color32(color: Color) -> Color32 {
    Color32::from_rgba_unmultiplied(color.r, color.g, color.b, color.a)
}

/// The screen position of a world point on the canvas `rect`.
pub(crate) fn screen_from_world(viewport: &Viewport, rect: Rect, world: DVec2) -> Pos2 {
    let page = viewport.page_from_world(world);
    // Far outside the window f32 would be too coarse or overflow; nothing there is painted.
    let bound = |value: f64| value.clamp(-1e6, 1e6) as f32;
    rect.min + vec2(bound(page.x), bound(page.y))
}

/// The world point under a screen position on the canvas `rect`.
pub(crate) fn world_from_screen(viewport: &Viewport, rect: Rect, screen: Pos2) -> DVec2 {
    let page = screen - rect.min;
    viewport.world_from_page(DVec2::new(f64::from(page.x), f64::from(page.y)))
}

/// Paints `picture` as seen through `viewport` onto `rect`.
pub(crate) fn paint_picture(picture: &Picture, viewport: &Viewport, rect: Rect, painter: &Painter) {
    let painter = painter.with_clip_rect(rect);
    if let Some(background) = picture.background {
        painter.rect_filled(rect, 0.0, color32(background));
    }
    for layer in &picture.layers {
        let mut places = (layer.items.len() > MANY_MARKERS).then(|| Places::new(rect));
        // One after the other they would each ask for the list of shapes.
        let mut shapes = Vec::new();
        for item in &layer.items {
            match item {
                Item::Path(path) => paint_path(path, viewport, rect, &mut shapes),
                Item::Marker(marker) => paint_marker(marker, viewport, rect, places.as_mut(), &mut shapes),
                Item::Label(label) => {
                    painter.extend(shapes.drain(..));
                    paint_label(label, viewport, rect, &painter);
                }
                Item::Mesh(mesh) => shapes.push(mesh_shape(mesh, viewport, rect)),
                Item::Image(placed) => {
                    painter.extend(shapes.drain(..));
                    paint_image(placed, viewport, rect, &painter);
                }
            }
        }
        painter.extend(shapes);
    }
}

/// Which places of the canvas have a marker: squares with sides of [`Places::SIDE`] pt.
struct Places {
    taken: Vec<bool>,
    columns: usize,
}

impl Places {
    /// Markers are larger: where one is left out, another covers its place.
    const SIDE: f32 = 1.5;

    fn new(rect: Rect) -> Self {
        let count = |length: f32| (length.max(0.0) / Self::SIDE) as usize + 1;
        let (columns, rows) = (count(rect.width()), count(rect.height()));
        Self { taken: vec![false; columns * rows], columns }
    }

    /// Takes the place; `false` if it was taken before.
    fn take(&mut self, at: Pos2, rect: Rect) -> bool {
        let cell = (at - rect.min) / Self::SIDE;
        if cell.x < 0.0 || cell.y < 0.0 || cell.x as usize >= self.columns {
            return true;
        }
        let taken = self.taken.get_mut(cell.y as usize * self.columns + cell.x as usize);
        taken.is_none_or(|taken| !std::mem::replace(taken, true))
    }
}

fn paint_path(path: &Path, viewport: &Viewport, rect: Rect, shapes: &mut Vec<Shape>) {
    let page = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    // Many parts of one edge each, as the teeth of a comb are.
    if path.fill.is_none()
        && let Some(stroke) = path.stroke.as_ref().filter(|stroke| stroke.dashes.is_empty())
        && let Some(edges) = single_edges(&path.segments)
    {
        let pen = PenStroke::new(stroke.width as f32, color32(stroke.color));
        for [from, to] in edges {
            let (from, to) = (viewport.page_from_world(from), viewport.page_from_world(to));
            if let Some((enter, leave)) = clip_edge(from, to, DVec2::splat(-MARGIN), page + MARGIN)
                .filter(|_| from.distance(to) > THINNED)
            {
                let ends = [enter, leave].map(|share| to_screen(from + (to - from) * share, rect));
                shapes.push(Shape::line_segment(ends, pen));
            }
        }
        return;
    }
    for part in flatten(&path.segments, viewport, page) {
        if let Some(fill) = path.fill {
            let outline: Vec<Pos2> = part.iter().map(|&point| to_screen(point, rect)).collect();
            shapes.push(Shape::convex_polygon(outline, color32(fill), PenStroke::NONE));
        }
        if let Some(stroke) = &path.stroke {
            let pen = PenStroke::new(stroke.width as f32, color32(stroke.color));
            for line in clip(&part, page) {
                let points: Vec<Pos2> =
                    thinned(&line, THINNED).into_iter().map(|point| to_screen(point, rect)).collect();
                if stroke.dashes.is_empty() {
                    shapes.push(Shape::line(points, pen));
                } else {
                    let (dashes, gaps): (Vec<f32>, Vec<f32>) = stroke
                        .dashes
                        .chunks(2)
                        .map(|pair| (pair[0] as f32, pair.get(1).copied().unwrap_or(pair[0]) as f32))
                        .unzip();
                    shapes.extend(Shape::dashed_line_with_offset(&points, pen, &dashes, &gaps, 0.0));
                }
            }
        }
    }
}

/// The edges of a path with at least two parts, each a single edge; `None` for other paths.
fn single_edges(segments: &[Segment]) -> Option<Vec<[DVec2; 2]>> {
    if segments.len() < 4 {
        return None;
    }
    let (pairs, rest) = segments.as_chunks::<2>();
    let edge = |pair: &[Segment; 2]| match *pair {
        [Segment::Move(from), Segment::Line(to)] => Some([from, to]),
        _ => None,
    };
    rest.is_empty().then(|| pairs.iter().map(edge).collect()).flatten()
}

/// The polyline without points that are within `tolerance` of what is left; both ends stay.
///
/// From the last point kept, the discs around the points behind it are seen under angles that all hold the next point kept.
fn thinned(points: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    if points.len() < FEW_POINTS {
        return points.to_vec();
    }
    let mut kept = vec![points[0]];
    let (mut from, mut before) = (points[0], points[0]);
    // The directions in which all discs are seen, from the right edge to the left one, and the farthest point.
    let mut view: Option<(DVec2, DVec2)> = None;
    let mut farthest: f64 = 0.0;
    for &point in &points[1..] {
        let mut way = point - from;
        let mut length = way.length();
        let fits = view.is_none_or(|(right, left)| right.perp_dot(way) >= 0.0 && way.perp_dot(left) >= 0.0);
        if !(fits && length >= farthest - tolerance && length.is_finite()) && before != from {
            kept.push(before);
            (from, view, farthest) = (before, None, 0.0);
            way = point - from;
            length = way.length();
        }
        farthest = farthest.max(length);
        if length > tolerance {
            let sine = tolerance / length;
            let (along, across) = (way * ((1.0 - sine * sine).sqrt() / length), way.perp() * (sine / length));
            let (right, left) = (along - across, along + across);
            view = Some(view.map_or((right, left), |(old_right, old_left)| {
                (
                    if old_right.perp_dot(right) > 0.0 { right } else { old_right },
                    if left.perp_dot(old_left) > 0.0 { left } else { old_left },
                )
            }));
        }
        before = point;
    }
    kept.push(before);
    kept
}

fn to_screen(page: DVec2, rect: Rect) -> Pos2 {
    rect.min + vec2(page.x.clamp(-1e6, 1e6) as f32, page.y.clamp(-1e6, 1e6) as f32)
}

/// Polylines in page coordinates, one per part of the path.
fn flatten(segments: &[Segment], viewport: &Viewport, page: DVec2) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    for segment in segments {
        match *segment {
            Segment::Move(to) => parts.push(vec![viewport.page_from_world(to)]),
            Segment::Line(to) => {
                if let Some(part) = parts.last_mut() {
                    part.push(viewport.page_from_world(to));
                }
            }
            Segment::Cubic(a, b, to) => {
                if let Some(part) = parts.last_mut()
                    && let Some(&start) = part.last()
                {
                    let inner = [a, b, to].map(|point| viewport.page_from_world(point));
                    flatten_cubic([start, inner[0], inner[1], inner[2]], page, MAX_DEPTH, part);
                }
            }
            Segment::Close => {
                if let Some(part) = parts.last_mut()
                    && let Some(&start) = part.first()
                {
                    part.push(start);
                }
            }
        }
    }
    parts
}

/// Appends the cubic without its start; pieces outside the page become one line.
fn flatten_cubic(cubic: [DVec2; 4], page: DVec2, depth: u32, out: &mut Vec<DVec2>) {
    let [a, b, c, d] = cubic;
    let low = a.min(b).min(c).min(d);
    let high = a.max(b).max(c).max(d);
    let outside = high.cmplt(DVec2::splat(-MARGIN)).any() || low.cmpgt(page + MARGIN).any();
    // The distance of a cubic from its chord, run through evenly, is at most √3/18 · max|second differences| · 3 < 0.3 · that.
    let bend = (a - b * 2.0 + c).length().max((b - c * 2.0 + d).length());
    if outside || depth == 0 || 0.6 * bend <= FLATNESS {
        out.push(d);
        return;
    }
    let (ab, bc, cd) = ((a + b) * 0.5, (b + c) * 0.5, (c + d) * 0.5);
    let (abc, bcd) = ((ab + bc) * 0.5, (bc + cd) * 0.5);
    let middle = (abc + bcd) * 0.5;
    flatten_cubic([a, ab, abc, middle], page, depth - 1, out);
    flatten_cubic([middle, bcd, cd, d], page, depth - 1, out);
}

/// The parts of a polyline inside the page with its margin (Liang and Barsky, 1984, edge by edge).
fn clip(points: &[DVec2], page: DVec2) -> Vec<Vec<DVec2>> {
    let (low, high) = (DVec2::splat(-MARGIN), page + MARGIN);
    let mut lines: Vec<Vec<DVec2>> = Vec::new();
    let mut open = false;
    for edge in points.windows(2) {
        let (from, to) = (edge[0], edge[1]);
        let Some((enter, leave)) = clip_edge(from, to, low, high) else {
            open = false;
            continue;
        };
        let (start, end) = (from + (to - from) * enter, from + (to - from) * leave);
        match lines.last_mut() {
            Some(line) if open && enter <= 0.0 => line.push(end),
            _ => lines.push(vec![start, end]),
        }
        open = leave >= 1.0;
    }
    lines
}

fn clip_edge(from: DVec2, to: DVec2, low: DVec2, high: DVec2) -> Option<(f64, f64)> {
    let run = to - from;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if run[axis] == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((low[axis] - from[axis]) / run[axis], (high[axis] - from[axis]) / run[axis]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter <= leave).then_some((enter, leave))
}

fn paint_marker(
    marker: &Marker,
    viewport: &Viewport,
    rect: Rect,
    places: Option<&mut Places>,
    shapes: &mut Vec<Shape>,
) {
    let center = screen_from_world(viewport, rect, marker.at);
    let half = 0.5 * marker.size as f32;
    if !rect.expand(half + 4.0).contains(center) || places.is_some_and(|places| !places.take(center, rect)) {
        return;
    }
    let fill = marker.fill.map_or(Color32::TRANSPARENT, color32);
    let pen = marker
        .stroke
        .as_ref()
        .map_or(PenStroke::NONE, |stroke| PenStroke::new(stroke.width as f32, color32(stroke.color)));
    let polygon = |corners: &[(f32, f32)]| {
        let corners = corners.iter().map(|&(x, y)| center + vec2(x, y) * half).collect();
        Shape::convex_polygon(corners, fill, pen)
    };
    match marker.shape {
        MarkerShape::Disc => {
            shapes.push(epaint::CircleShape { center, radius: half, fill, stroke: pen }.into());
        }
        MarkerShape::Square => {
            shapes.push(polygon(&[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]));
        }
        // A square of the given side on its tip is √2 times as wide.
        MarkerShape::Diamond => {
            let tip = std::f32::consts::SQRT_2;
            shapes.push(polygon(&[(0.0, -tip), (tip, 0.0), (0.0, tip), (-tip, 0.0)]));
        }
        MarkerShape::Triangle => shapes.push(polygon(&[(0.0, -1.0), (0.87, 0.5), (-0.87, 0.5)])),
        MarkerShape::Cross => {
            shapes.push(Shape::line_segment([center - Vec2::splat(half), center + Vec2::splat(half)], pen));
            shapes.push(Shape::line_segment([center + vec2(-half, half), center + vec2(half, -half)], pen));
        }
    }
}

fn mesh_shape(mesh: &Mesh, viewport: &Viewport, rect: Rect) -> Shape {
    let mut shape = epaint::Mesh::default();
    for (&point, &color) in mesh.points().iter().zip(mesh.colors()) {
        shape.colored_vertex(screen_from_world(viewport, rect, point), color32(color));
    }
    shape.indices = mesh.triangles().as_flattened().to_vec();
    shape.into()
}

/// The texture lives as long as the frame.
fn paint_image(placed: &PlacedImage, viewport: &Viewport, rect: Rect, painter: &Painter) {
    let size = [placed.image.width() as usize, placed.image.height() as usize];
    let pixels = ColorImage::from_rgba_unmultiplied(size, placed.image.pixels());
    let texture = painter.ctx().load_texture("image", pixels, TextureOptions::LINEAR);
    let corners = [placed.low, placed.high].map(|corner| screen_from_world(viewport, rect, corner));
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(texture.id(), Rect::from_two_pos(corners[0], corners[1]), whole, Color32::WHITE);
}

fn paint_label(label: &Label, viewport: &Viewport, rect: Rect, painter: &Painter) {
    let place =
        screen_from_world(viewport, rect, label.at) + vec2(label.offset.x as f32, -label.offset.y as f32);
    if !rect.expand(200.0).contains(place) {
        return;
    }
    let ink = color32(label.color);
    if label.math
        && let Ok(layout) = formula::layout(&label.text, label.size)
    {
        let shift = anchor_share(label.anchor) * layout.width as f32;
        paint_formula(painter, pos2(place.x - shift, place.y), &layout, ink);
        return;
    }
    let font = FontId::new(label.size as f32, FontFamily::Proportional);
    let galley = painter.layout_no_wrap(label.text.clone(), font, ink);
    let shift = anchor_share(label.anchor) * galley.size().x;
    painter.galley(pos2(place.x - shift, place.y - baseline(&galley)), galley, ink);
}

fn anchor_share(anchor: Anchor) -> f32 {
    match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    }
}

/// Distance from the top of the galley to the base line of its first row.
pub(crate) fn baseline(galley: &epaint::Galley) -> f32 {
    let Some(row) = galley.rows.first() else { return 0.0 };
    row.pos.y + row.row.glyphs.first().map_or(row.size.y * 0.8, |glyph| glyph.pos.y)
}

/// A short text with the ground of the canvas behind it, so that lines do not run through it.
pub(crate) fn paint_note(
    painter: &Painter,
    at: Pos2,
    anchor: Align2,
    text: &str,
    size: f32,
    ink: Color,
    ground: Color,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(size), color32(ink));
    let place = anchor.anchor_size(at, galley.size());
    painter.rect_filled(place.expand2(vec2(6.0, 3.0)), 4.0, color32(ground.with_opacity(0.85)));
    painter.galley(place.min, galley, color32(ink));
}

/// [`paint_note`] beside the pointer, on the side where `rect` has room for it.
pub(crate) fn paint_note_at_pointer(painter: &Painter, pointer: Pos2, rect: Rect, text: &str, theme: &Theme) {
    let size = 13.0 * theme.text_scale as f32;
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(size), color32(theme.text));
    let (mut anchor, mut way) = (Align2::LEFT_TOP, vec2(18.0, 18.0));
    if pointer.x + way.x + galley.size().x > rect.right() - 8.0 {
        (anchor.0[0], way.x) = (Align::Max, -18.0);
    }
    if pointer.y + way.y + galley.size().y > rect.bottom() - 8.0 {
        (anchor.0[1], way.y) = (Align::Max, -18.0);
    }
    paint_note(painter, pointer + way, anchor, text, size, theme.text, theme.background);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flattening_keeps_its_promise() {
        let cubic =
            [(0.0, 0.0), (500.0, 900.0), (-200.0, 700.0), (600.0, 10.0)].map(|(x, y)| DVec2::new(x, y));
        let mut line = vec![cubic[0]];
        flatten_cubic(cubic, DVec2::splat(1000.0), MAX_DEPTH, &mut line);
        for step in 0..=2000 {
            let t = f64::from(step) / 2000.0;
            let s = 1.0 - t;
            let point = cubic[0] * s.powi(3)
                + cubic[1] * (3.0 * s * s * t)
                + cubic[2] * (3.0 * s * t * t)
                + cubic[3] * t.powi(3);
            let distance = line
                .windows(2)
                .map(|edge| {
                    let run = edge[1] - edge[0];
                    let share =
                        ((point - edge[0]).dot(run) / run.length_squared().max(1e-300)).clamp(0.0, 1.0);
                    point.distance(edge[0] + run * share)
                })
                .fold(f64::INFINITY, f64::min);
            assert!(distance <= FLATNESS, "t = {t}: {distance}");
        }
    }

    #[test]
    fn a_line_that_runs_through_the_page_is_cut_at_its_margin() {
        let page = DVec2::new(100.0, 100.0);
        let lines = clip(&[DVec2::new(-1e12, 50.0), DVec2::new(1e12, 50.0)], page);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(
            (lines[0][0].x + MARGIN).abs() < 1e-3 && (lines[0][1].x - 100.0 - MARGIN).abs() < 1e-3,
            "{lines:?}"
        );
        assert!(
            clip(&[DVec2::new(-500.0, -500.0), DVec2::new(-500.0, 900.0)], page).is_empty(),
            "left of the page"
        );
    }

    #[test]
    fn a_thinned_line_stays_near_and_keeps_its_ends() {
        // Waves, a straight part, and a part that runs back over itself.
        let mut line: Vec<DVec2> =
            (0..3000).map(|k| DVec2::new(0.1 * f64::from(k), 20.0 * (0.02 * f64::from(k)).sin())).collect();
        line.extend((0..500).map(|k| DVec2::new(300.0, 0.3 * f64::from(k))));
        line.extend((0..400).map(|k| DVec2::new(300.0, 150.0 - 0.3 * f64::from(k))));
        let thin = thinned(&line, 0.1);
        assert!(thin.len() < line.len() / 10, "{} of {} points are left", thin.len(), line.len());
        assert_eq!((thin[0], thin[thin.len() - 1]), (line[0], line[line.len() - 1]), "the ends");
        for point in &line {
            let near = thin.windows(2).any(|edge| {
                let run = edge[1] - edge[0];
                let share = ((*point - edge[0]).dot(run) / run.length_squared()).clamp(0.0, 1.0);
                point.distance(edge[0] + run * share) <= 0.15
            });
            assert!(near, "{point} has been cut off");
        }
        assert!(thin.contains(&DVec2::new(300.0, 0.3 * 499.0)), "the turn is kept");
    }

    #[test]
    fn of_markers_at_one_place_one_is_painted() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(100.0, 50.0));
        let mut places = Places::new(rect);
        assert!(
            places.take(pos2(30.2, 40.2), rect) && !places.take(pos2(30.4, 40.3), rect),
            "the same place"
        );
        assert!(places.take(pos2(35.0, 40.2), rect), "another place");
        assert!(
            places.take(pos2(5.0, 40.0), rect) && places.take(pos2(5.0, 40.0), rect),
            "beside the canvas"
        );
    }
}
