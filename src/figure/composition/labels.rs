//! The labels of all curves put into places where they do not lie on each other.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use glam::DVec2;

use crate::document::ObjectId;
use crate::figure::curve::flatten;
use crate::figure::font_metrics::{FontFace, text_width};
use crate::figure::formula;
use crate::figure::label_placement::{Page, PageBox, Placed, Request, Spot};
use crate::figure::picture::{Item, Label, Layer, MarkerShape, Path, Picture, Viewport};
use crate::figure::theme::Theme;

/// Paths of more steps are not avoided by labels.
const LONG_PATH: usize = 1000;
/// Lines fainter than this may run through labels.
const FAINT: u8 = 120;
/// In pictures of more items the note of the parameter has its usual place.
const MANY_ITEMS: usize = 2000;
/// Side of the handle of the parameter, and type size of its note, in pt.
const HANDLE: f64 = 13.0;
const NOTE_SIZE: f64 = 12.0;
/// Ground around the note in pt.
const NOTE_ROOM: DVec2 = DVec2::new(6.0, 3.0);

/// Sizes of insets, as parts of the largest: smaller ones where the larger would cover something.
const INSET_SIZES: [f64; 3] = [1.0, 0.8, 0.65];
/// Distance of insets from the upper and right edge, from the left, and from the lower edge, where the scale stands, in pt.
const INSET_EDGE: (f64, f64, f64) = (12.0, 44.0, 26.0);

/// Where labels stood before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LabelMemory {
    spots: BTreeMap<u64, Spot>,
    /// The corner of the inset of each curve.
    pub(super) corners: BTreeMap<ObjectId, u8>,
}

/// What became of the labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    /// For each curve whose parameter has a handle: from the point to the lower left corner of its note, in pt, y up.
    pub notes: BTreeMap<ObjectId, DVec2>,
    /// The labels for which there was no room.
    pub left_out: Vec<String>,
    /// Where everything stands, to be given back while something is dragged.
    pub memory: LabelMemory,
}

/// The handle of a parameter with its note.
#[derive(Clone, Debug)]
pub(super) struct Handle {
    pub(super) object: ObjectId,
    pub(super) at: DVec2,
    pub(super) words: String,
}

/// How important the labels of a layer are, 0 first; `None` for labels that stand where they are.
fn priority(part: &str) -> Option<u8> {
    Some(match part {
        "construction" | "frame" => 1,
        "distance tube" | "probe line" | "symmetry" | "hodograph" => 2,
        "inflections" | "curvature extrema" => 3,
        "labels" => 4,
        "blossom labels" => 5,
        "bisection" => 6,
        _ => return None,
    })
}

/// The note of a parameter.
pub(super) fn note_words(parameter: f64) -> String {
    format!("t = {}", super::short_number(parameter))
}

fn part_of(layer: &Layer) -> &str {
    layer.name.rsplit_once(": ").map_or("", |(_, part)| part)
}

/// The box of a label whose place is the origin, before its offset.
fn extent(label: &Label) -> PageBox {
    let (width, ascent, descent) = match formula::layout(&label.text, label.size) {
        Ok(layout) if label.math => (layout.width, layout.ascent, layout.descent),
        _ => (text_width(FontFace::Regular, &label.text, label.size), 0.76 * label.size, 0.22 * label.size),
    };
    let low = DVec2::new(-label.anchor.part_before() * width, -descent);
    PageBox { low, high: low + DVec2::new(width, ascent + descent) }
}

/// From the world to the page in pt, y up.
fn on_page(world: DVec2, viewport: &Viewport) -> DVec2 {
    (world - viewport.center) * viewport.scale + viewport.size * 0.5
}

/// What labels keep away from.
struct Occupied {
    page: Page,
    /// Half sizes of the marks, by the place of their centres in whole pt.
    marks: BTreeMap<(i64, i64), f64>,
}

fn cell(at: DVec2) -> (i64, i64) {
    (at.x.round() as i64, at.y.round() as i64)
}

fn block_mark(
    page: &mut Page,
    marks: &mut BTreeMap<(i64, i64), f64>,
    at: DVec2,
    half: f64,
    viewport: &Viewport,
) {
    if at.cmpge(DVec2::splat(-half)).all() && at.cmple(viewport.size + half).all() {
        page.block(PageBox::around(at, half));
        let known = marks.entry(cell(at)).or_default();
        *known = known.max(half);
    }
}

/// The marks, the scale and the lines of a picture.
fn occupied(picture: &Picture, viewport: &Viewport) -> Occupied {
    let (mut page, mut marks) = (Page::new(viewport.size), BTreeMap::new());
    let on_page = |world: DVec2| on_page(world, viewport);
    for layer in &picture.layers {
        let part = part_of(layer);
        for item in &layer.items {
            match item {
                Item::Marker(found) => {
                    let stroke = found.stroke.as_ref().map_or(0.0, |stroke| 0.5 * stroke.width);
                    let tip =
                        if found.shape == MarkerShape::Diamond { std::f64::consts::SQRT_2 } else { 1.0 };
                    let half = 0.5 * found.size * tip + stroke;
                    block_mark(&mut page, &mut marks, on_page(found.at), half, viewport);
                }
                Item::Label(label) if layer.name == "scale" => {
                    let (area, at) = (extent(label), on_page(label.at) + label.offset);
                    page.block(PageBox { low: area.low + at, high: area.high + at });
                }
                Item::Path(path) if is_avoided(part, path) => {
                    for line in flatten(&path.segments, 0.5 / viewport.scale) {
                        page.avoid(&line.into_iter().map(on_page).collect::<Vec<_>>());
                    }
                }
                _ => {}
            }
        }
    }
    Occupied { page, marks }
}

/// Squares in the corners of the page for insets, one for each of `objects`, where they cover least; `former` ones come first.
pub(super) fn insets(
    picture: &Picture,
    objects: &[ObjectId],
    viewport: &Viewport,
    former: &LabelMemory,
) -> Vec<(u8, PageBox)> {
    if objects.is_empty() {
        return Vec::new();
    }
    let mut page = occupied(picture, viewport).page;
    let largest = (0.34 * viewport.size.min_element()).min(190.0);
    let mut found = Vec::new();
    for object in objects {
        let mut corners: Vec<u8> = (0..4).collect();
        if let Some(&corner) = former.corners.get(object) {
            corners.sort_by_key(|&other| other != corner);
        }
        let places = INSET_SIZES.iter().flat_map(|share| {
            corners.iter().map(move |&corner| (corner, corner_box(corner, share * largest, viewport.size)))
        });
        let costs = places.map(|(corner, area)| (page.content(&area), corner, area));
        let mut best: Option<(usize, u8, PageBox)> = None;
        for place in costs {
            if best.is_none_or(|best| place.0 < best.0) {
                best = Some(place);
            }
            if place.0 == 0 {
                break;
            }
        }
        if let Some((_, corner, area)) = best {
            // A second inset on the first would be worse than any line.
            (0..100).for_each(|_| page.block(area));
            found.push((corner, area));
        }
    }
    found
}

/// The square with this side in corner 0 (upper right), 1 (lower right), 2 (upper left) or 3, beside the numbers of the scale.
fn corner_box(corner: u8, side: f64, size: DVec2) -> PageBox {
    let x = if corner < 2 { size.x - INSET_EDGE.0 - side } else { INSET_EDGE.1 };
    let y = if corner.is_multiple_of(2) { size.y - INSET_EDGE.0 - side } else { INSET_EDGE.2 };
    let low = DVec2::new(x, y);
    PageBox { low, high: low + side }
}

/// Moves the labels of the curves in `picture` to free places, and takes out those for which there is none. `insets` are boxes on the page, y up, that
/// nothing may cover.
pub(super) fn arrange(
    picture: &mut Picture,
    handle: Option<&Handle>,
    insets: &[PageBox],
    viewport: &Viewport,
    theme: &Theme,
    former: &LabelMemory,
) -> Arrangement {
    let mut arrangement = Arrangement::default();
    let on_page = |world: DVec2| on_page(world, viewport);
    let has_labels = |layer: &Layer| {
        priority(part_of(layer)).is_some() && layer.items.iter().any(|item| matches!(item, Item::Label(_)))
    };
    let has_labels = picture.layers.iter().any(has_labels);
    let count = || picture.layers.iter().map(|layer| layer.items.len()).sum::<usize>();
    // Among thousands of marks the note of the parameter alone is not worth the search.
    if !has_labels && (handle.is_none() || count() > MANY_ITEMS) {
        return arrangement;
    }
    let Occupied { mut page, mut marks } = occupied(picture, viewport);
    insets.iter().for_each(|&inset| page.block(inset));
    if let Some(handle) = handle {
        block_mark(&mut page, &mut marks, on_page(handle.at), 0.5 * HANDLE, viewport);
    }
    let request = |at: DVec2, size: DVec2, wish: DVec2, priority: u8, stays: bool, key: u64| {
        let inside = at.clamp(DVec2::splat(0.0), viewport.size.max(DVec2::ZERO));
        let anchor = if stays { inside } else { at };
        let (x, y) = cell(anchor);
        let near = (-1..=1).flat_map(|i| (-1..=1).map(move |j| (x + i, y + j)));
        let reach = near.filter_map(|place| marks.get(&place)).copied().fold(0.0, f64::max);
        Request { anchor, size, reach, wish, priority, stays, former: former.spots.get(&key).copied() }
    };

    let mut requests = Vec::new();
    let mut keys = Vec::new();
    if let Some(handle) = handle.filter(|handle| is_inside(on_page(handle.at), viewport)) {
        let size = NOTE_SIZE * theme.text_scale;
        let words = text_width(FontFace::Regular, &handle.words, size);
        let area = DVec2::new(words, 1.25 * size) + 2.0 * NOTE_ROOM;
        let key = key_of("note", handle.object.0 as usize);
        requests.push(request(on_page(handle.at), area, DVec2::ONE, 0, true, key));
        keys.push(key);
    }
    let of_notes = requests.len();
    let mut places = Vec::new();
    let mut fixed = Vec::new();
    for (number, layer) in picture.layers.iter().enumerate() {
        let Some(priority) = priority(part_of(layer)) else { continue };
        for (index, item) in layer.items.iter().enumerate() {
            let Item::Label(label) = item else { continue };
            let (at, area) = (on_page(label.at), extent(label));
            if part_of(layer) == "bisection" {
                fixed.push((
                    number,
                    index,
                    PageBox { low: area.low + at + label.offset, high: area.high + at + label.offset },
                ));
                continue;
            }
            if part_of(layer) == "hodograph" && label.color != theme.warning {
                continue;
            }
            let stays = priority == 2 || label.color == theme.warning;
            // What belongs to a place that is not seen is not seen either.
            let wish = label.offset + 0.5 * (area.low + area.high) * DVec2::new(0.0, 1.0);
            let key = key_of(&layer.name, index);
            if is_inside(at, viewport) || stays {
                requests.push(request(at, area.high - area.low, wish, priority, stays, key));
                keys.push(key);
                places.push((number, index, Some(area.low)));
            } else {
                places.push((number, index, None));
            }
        }
    }
    let placed = page.place(&requests);
    for (key, found) in keys.into_iter().zip(&placed) {
        if let Some(found) = found {
            arrangement.memory.spots.insert(key, found.spot);
        }
    }
    if let (Some(handle), Some(Some(Placed { low, .. }))) = (handle, placed[..of_notes].first()) {
        arrangement.notes.insert(handle.object, *low + NOTE_ROOM - on_page(handle.at));
    }
    let mut changes: Vec<(usize, usize, Change)> = Vec::new();
    let mut found = placed[of_notes..].iter();
    for (number, index, area_low) in places {
        let spot = area_low.and_then(|area_low| Some((area_low, found.next().copied()?)));
        let Some(Item::Label(label)) = picture.layers[number].items.get_mut(index) else { continue };
        match spot {
            Some((area_low, Some(Placed { low, is_crossed, .. }))) => {
                label.offset = low - area_low - on_page(label.at);
                let size = extent(label);
                let area = PageBox { low, high: low + size.high - size.low };
                let ground = is_crossed && picture.background.is_some();
                changes.push((number, index, Change::Stays(ground.then_some(area))));
            }
            Some((_, None)) => {
                arrangement.left_out.push(label.text.clone());
                changes.push((number, index, Change::Goes));
            }
            None => changes.push((number, index, Change::Goes)),
        }
    }
    for (number, index, area) in fixed {
        if page.is_free(&area) {
            page.block(area);
        } else {
            changes.push((number, index, Change::Goes));
        }
    }
    let mut lifted: Vec<(String, Vec<Item>)> = Vec::new();
    changes.sort_by_key(|&(number, index, _)| std::cmp::Reverse((number, index)));
    for (number, index, change) in changes {
        let Layer { name, items } = &mut picture.layers[number];
        let ground = match change {
            Change::Goes => {
                items.remove(index);
                continue;
            }
            Change::Stays(area) => area.map(|area| Item::Path(ground(area, viewport, theme))),
        };
        match name.rsplit_once(": ") {
            // These layers lie under the curve, where nobody could read a sentence.
            Some((object, "distance tube" | "symmetry")) => {
                let label = items.remove(index);
                lifted.push((format!("{object}: notes"), ground.into_iter().chain([label]).collect()));
            }
            _ => items.splice(index..index, ground).for_each(drop),
        }
    }
    for (name, items) in lifted.into_iter().rev() {
        picture.push_layer(name, items);
    }
    picture.layers.retain(|layer| !layer.items.is_empty());
    arrangement
}

/// What becomes of a label.
enum Change {
    /// It is taken out.
    Goes,
    /// It is drawn, on a ground if a line runs through it.
    Stays(Option<PageBox>),
}

/// The ground behind a label, so that it can be read on a line.
fn ground(area: PageBox, viewport: &Viewport, theme: &Theme) -> Path {
    let corner = |x: f64, y: f64| viewport.center + (DVec2::new(x, y) - viewport.size * 0.5) / viewport.scale;
    let PageBox { low, high } = area;
    let corners = [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)];
    Path::polygon(&corners.map(|(x, y)| corner(x, y)), None, Some(theme.background.with_opacity(0.7)))
}

fn is_inside(at: DVec2, viewport: &Viewport) -> bool {
    at.cmpge(DVec2::ZERO).all() && at.cmple(viewport.size).all()
}

/// Whether labels would rather not lie on a path.
fn is_avoided(part: &str, path: &Path) -> bool {
    let seen = path.stroke.as_ref().is_some_and(|stroke| stroke.color.a >= FAINT);
    let is_line = !matches!(part, "" | "bisection" | "hodograph");
    is_line && seen && path.segments.len() <= LONG_PATH
}

fn key_of(layer: &str, index: usize) -> u64 {
    let mut hasher = DefaultHasher::new();
    (layer, index).hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::spline_curve::Nurbs;
    use crate::document::{CurveDisplay, Document, Edit, PointLabels, View, first_scene};
    use crate::figure::composition::{Composition, Measurements, compose_arranged, compose_with};

    /// Everything that can be shown.
    fn everything(color: usize, labels: PointLabels) -> CurveDisplay {
        CurveDisplay {
            color,
            labels,
            comb: true,
            construction: true,
            osculating_circle: true,
            frame: true,
            hodograph: true,
            bezier_points: true,
            blossom_labels: true,
            distance_tube: true,
            inflections: true,
            vertices: true,
            symmetry: true,
            probe_line: true,
            ..CurveDisplay::default()
        }
    }

    fn scene(shown: &[&str]) -> (Document, View) {
        let (mut document, view) = first_scene();
        let ids: Vec<_> = document.objects().iter().map(|object| (object.id, object.name.clone())).collect();
        for (color, (object, name)) in ids.into_iter().enumerate() {
            if shown.contains(&name.as_str()) {
                let display = everything(color, PointLabels::Coordinates);
                document.apply(&Edit::SetDisplay { object, display }).unwrap();
            }
        }
        (document, view)
    }

    fn viewport(document: &Document, size: DVec2) -> Viewport {
        let (low, high) = document.bounding_box().unwrap();
        Viewport::fitting(low, high, size, 40.0)
    }

    /// The labels of the curves with their boxes on the page.
    fn boxes(picture: &Picture, viewport: &Viewport) -> Vec<(String, PageBox)> {
        let layers = picture.layers.iter().filter(|layer| !matches!(part_of(layer), "" | "bisection"));
        let labels = layers.flat_map(|layer| &layer.items).filter_map(|item| {
            let Item::Label(label) = item else { return None };
            let (area, at) = (extent(label), on_page(label.at, viewport) + label.offset);
            Some((label.text.clone(), PageBox { low: area.low + at, high: area.high + at }))
        });
        labels.collect()
    }

    #[test]
    fn with_everything_shown_no_label_lies_on_another_or_on_a_mark_or_off_the_page() {
        let sizes = [(1400.0, 800.0), (1000.0, 600.0), (500.0, 420.0)].map(DVec2::from);
        for shown in [vec!["Wave"], vec!["Wave", "Circle", "Pebble"]] {
            let (document, view) = scene(&shown);
            for (theme, size) in
                Theme::all().into_iter().flat_map(|theme| sizes.map(|size| (theme.clone(), size)))
            {
                let viewport = viewport(&document, size);
                let choices = Composition::default();
                let (picture, found) =
                    compose_arranged(&document, &view, &theme, &viewport, &choices, &Measurements::default());
                let boxes = boxes(&picture, &viewport);
                let told = format!("{shown:?}, {size}, {}", theme.name);
                assert!(
                    boxes.len() > 12 && boxes.len() > found.left_out.len(),
                    "{} labels, {told}",
                    boxes.len()
                );
                let marks: Vec<PageBox> = picture
                    .layers
                    .iter()
                    .flat_map(|layer| &layer.items)
                    .filter_map(|item| {
                        let Item::Marker(mark) = item else { return None };
                        Some(PageBox::around(on_page(mark.at, &viewport), 0.45 * mark.size))
                    })
                    .collect();
                for (k, (text, area)) in boxes.iter().enumerate() {
                    assert!(
                        area.low.min_element() >= 0.0 && area.high.cmple(size).all(),
                        "{text} off the page, {told}"
                    );
                    for (other, taken) in &boxes[..k] {
                        assert!(!area.meets(taken), "{text} on {other}, {told}");
                    }
                    assert!(!marks.iter().any(|mark| mark.meets(area)), "{text} on a mark, {told}");
                }
            }
        }
    }

    #[test]
    fn window_and_export_place_alike_and_a_drag_keeps_the_sides() {
        let (mut document, view) = scene(&["Wave"]);
        let viewport = viewport(&document, DVec2::new(1000.0, 600.0));
        let (theme, object) = (Theme::light(), view.selected_object.unwrap());
        let window = Composition { handle: Some(object), ..Composition::default() };
        let (picture, before) =
            compose_arranged(&document, &view, &theme, &viewport, &window, &Measurements::default());
        let export = compose_with(
            &document,
            &view,
            &theme,
            &viewport,
            &Composition::default(),
            &Measurements::default(),
        );
        assert_eq!(picture, export, "the same on the page");
        let mut dragged = Composition { former: before.memory.clone(), ..window };
        for step in 1..=8 {
            let edit = Edit::MovePoints { object, points: vec![7], delta: DVec2::new(0.02, 0.01) };
            document.apply(&edit).unwrap();
            let after =
                compose_arranged(&document, &view, &theme, &viewport, &dragged, &Measurements::default()).1;
            let spots = &before.memory.spots;
            let kept = spots.iter().filter(|(key, spot)| after.memory.spots.get(key) == Some(spot)).count();
            assert!(kept + 3 >= spots.len(), "step {step}: {kept} of {} keep their sides", spots.len());
            dragged.former = after.memory;
        }
    }

    #[test]
    fn an_inset_goes_where_nothing_is() {
        let (document, view) = scene(&["Wave"]);
        let theme = Theme::dark();
        for (size, center) in
            [((900.0, 600.0), (0.0, 0.0)), ((600.0, 400.0), (3.0, -1.5)), ((900.0, 600.0), (-3.0, 1.0))]
        {
            let viewport = Viewport { center: center.into(), scale: 45.0, size: size.into() };
            let choices = Composition::default();
            let (picture, found) =
                compose_arranged(&document, &view, &theme, &viewport, &choices, &Measurements::default());
            let corner = *found.memory.corners.values().next().unwrap();
            let layer = picture.layers.iter().find(|layer| part_of(layer) == "hodograph").unwrap();
            let Item::Path(frame) = &layer.items[0] else { panic!("the frame") };
            let corners = flatten(&frame.segments, 1.0).remove(0);
            let [low, high] = [corners[0], corners[2]].map(|corner| on_page(corner, &viewport));
            let covered = |curve: &Nurbs<DVec2>| {
                curve.points().iter().any(|&point| {
                    let at = on_page(point, &viewport);
                    at.cmpgt(low).all() && at.cmplt(high).all()
                })
            };
            assert!(
                !document.objects().iter().filter_map(|object| object.curve()).any(covered),
                "corner {corner} at {center:?}"
            );
            let caption =
                boxes(&picture, &viewport).into_iter().find(|(text, _)| text.contains('/')).unwrap().1;
            assert!(caption.low.cmpgt(low).all() && caption.high.cmplt(high).all(), "the caption inside");
        }
    }
}
