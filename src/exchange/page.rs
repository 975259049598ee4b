//! A picture on a page: places in pt from the upper left corner, y down, formulas typeset, markers as outlines.
//!
//! Things with a coordinate that is not a finite number, which no page can show, are left out.

use std::sync::Arc;

use glam::DVec2;

use crate::exchange::mesh::{image_on_page, mesh_on_page};
use crate::figure::clip::path_near_box;
use crate::figure::formula::{self, FormulaLayout};
use crate::figure::mesh::Image;
use crate::figure::picture::{
    Anchor, Color, Item, Label, Marker, MarkerShape, Path, Picture, Segment, Stroke, Viewport,
};

/// Pixels per pt of images in files that can be enlarged.
const PIXELS_PER_POINT: f64 = 3.0;
/// Lines that leave the page by more than this multiple of its size are cut near the page: the programs that draw them count in
/// single precision.
const HUGE: f64 = 30.0;
/// Width in pt of the strokes of a cross that has no outline of its own.
const CROSS_WIDTH: f64 = 1.0;

/// What the page is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Medium {
    /// A file that can be enlarged.
    Vectors,
    /// So many pixels per pt.
    Pixels(f64),
}

impl Medium {
    /// Pixels per pt of images on the page.
    pub(super) const fn pixels_per_point(self) -> f64 {
        match self {
            Self::Vectors => PIXELS_PER_POINT,
            Self::Pixels(pixels_per_point) => pixels_per_point,
        }
    }
}

/// A layer on the page.
pub(super) struct PageLayer<'a> {
    pub(super) name: &'a str,
    pub(super) items: Vec<PageItem<'a>>,
}

/// One thing on the page.
pub(super) enum PageItem<'a> {
    /// A path with places in pt.
    Path(Path),
    /// A disc.
    Disc { center: DVec2, radius: f64, stroke: Option<Stroke>, fill: Option<Color> },
    /// A line of text; `at` is on its base line.
    Text { at: DVec2, text: &'a str, size: f64, color: Color, anchor: Anchor },
    /// A formula with what it was typed as; `at` is the left end of its base line.
    Formula { at: DVec2, layout: FormulaLayout, source: &'a str, size: f64, color: Color },
    /// An image; `corner` is its upper left one.
    Image { corner: DVec2, size: DVec2, image: Arc<Image> },
}

/// The layers of `picture`; meshes become images where there are only pixels, or too many colours for polygons.
pub(super) fn lay_out<'a>(picture: &'a Picture, view: &Viewport, medium: Medium) -> Vec<PageLayer<'a>> {
    let on_page = |item: &'a Item| match item {
        Item::Path(path) => Vec::from_iter(path_on_page(path, view)),
        Item::Marker(marker) => Vec::from_iter(marker_on_page(marker, view)),
        Item::Label(label) => Vec::from_iter(label_on_page(label, view)),
        Item::Mesh(mesh) => mesh_on_page(mesh, view, medium),
        Item::Image(placed) => Vec::from_iter(image_on_page(placed, view)),
    };
    picture
        .layers
        .iter()
        .map(|layer| PageLayer { name: &layer.name, items: layer.items.iter().flat_map(on_page).collect() })
        .collect()
}

fn path_on_page<'a>(path: &Path, view: &Viewport) -> Option<PageItem<'a>> {
    let page = |world: DVec2| view.page_from_world(world);
    let segments: Vec<Segment> = path
        .segments
        .iter()
        .map(|&segment| match segment {
            Segment::Move(to) => Segment::Move(page(to)),
            Segment::Line(to) => Segment::Line(page(to)),
            Segment::Cubic(a, b, to) => Segment::Cubic(page(a), page(b), page(to)),
            Segment::Close => Segment::Close,
        })
        .collect();
    let can_be_shown = segments.iter().all(|segment| match segment {
        Segment::Move(to) | Segment::Line(to) => to.is_finite(),
        Segment::Cubic(a, b, to) => a.is_finite() && b.is_finite() && to.is_finite(),
        Segment::Close => true,
    });
    let starts = matches!(segments.first(), Some(Segment::Move(_)));
    let stroke = path.stroke.as_ref().and_then(visible);
    let is_huge = segments.iter().any(|segment| match segment {
        Segment::Move(to) | Segment::Line(to) | Segment::Cubic(_, _, to) => {
            to.abs().max_element() > HUGE * view.size.max_element()
        }
        Segment::Close => false,
    });
    let segments = if can_be_shown && is_huge && path.fill.is_none() {
        path_near_box(&segments, DVec2::ZERO, view.size)
    } else {
        segments
    };
    (can_be_shown && starts && !segments.is_empty() && (stroke.is_some() || path.fill.is_some()))
        .then_some(PageItem::Path(Path { segments, stroke, fill: path.fill }))
}

/// A line without width is not drawn; dashes that make no sense give a solid line.
fn visible(stroke: &Stroke) -> Option<Stroke> {
    if !(stroke.width.is_finite() && stroke.width > 0.0) {
        return None;
    }
    let are_lengths = stroke.dashes.iter().all(|length| length.is_finite() && *length >= 0.0);
    let is_dashed = are_lengths && stroke.dashes.iter().sum::<f64>() > 0.0;
    let dashes = if is_dashed { stroke.dashes.clone() } else { Vec::new() };
    Some(Stroke { dashes, ..*stroke })
}

fn marker_on_page<'a>(marker: &Marker, view: &Viewport) -> Option<PageItem<'a>> {
    let center = view.page_from_world(marker.at);
    let half = marker.size / 2.0;
    if !(center.is_finite() && half.is_finite() && half > 0.0) {
        return None;
    }
    let (fill, stroke) = (marker.fill, marker.stroke.as_ref().and_then(visible));
    let at = |x: f64, y: f64| center + DVec2::new(x, y) * half;
    let corners = match marker.shape {
        MarkerShape::Disc => return Some(PageItem::Disc { center, radius: half, stroke, fill }),
        MarkerShape::Cross => {
            let color = stroke.as_ref().map(|stroke| stroke.color).or(fill)?;
            let stroke = stroke.unwrap_or_else(|| Stroke::solid(color, CROSS_WIDTH));
            let strokes = [at(-1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0), at(1.0, -1.0)];
            let segments = vec![
                Segment::Move(strokes[0]),
                Segment::Line(strokes[1]),
                Segment::Move(strokes[2]),
                Segment::Line(strokes[3]),
            ];
            return Some(PageItem::Path(Path { segments, stroke: Some(stroke), fill: None }));
        }
        MarkerShape::Square => vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)],
        MarkerShape::Diamond => {
            let tip = std::f64::consts::SQRT_2;
            vec![at(0.0, -tip), at(tip, 0.0), at(0.0, tip), at(-tip, 0.0)]
        }
        // The centre of gravity stands at the place.
        MarkerShape::Triangle => vec![at(0.0, -1.15), at(1.0, 0.58), at(-1.0, 0.58)],
    };
    Some(PageItem::Path(Path::polygon(&corners, stroke, fill)))
}

fn label_on_page<'a>(label: &'a Label, view: &Viewport) -> Option<PageItem<'a>> {
    let at = view.page_from_world(label.at) + DVec2::new(label.offset.x, -label.offset.y);
    if !(at.is_finite() && label.size.is_finite() && label.size > 0.0) || label.text.is_empty() {
        return None;
    }
    let (size, color, anchor) = (label.size, label.color, label.anchor);
    let formula = label.math.then(|| formula::layout(&label.text, size).ok()).flatten();
    // A formula that cannot be set is shown as it was typed, so that the mistake can be seen.
    let Some(layout) = formula else {
        return Some(PageItem::Text { at, text: &label.text, size, color, anchor });
    };
    let before = anchor.part_before() * layout.width;
    Some(PageItem::Formula { at: DVec2::new(at.x - before, at.y), layout, source: &label.text, size, color })
}
