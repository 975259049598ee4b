//! The legend of a colour scale: a bar with numbers, at the right edge of a view.

use glam::DVec2;

use crate::figure::chart::{label_width, text};
use crate::figure::color_map::ColorScale;
use crate::figure::error::FigureError;
use crate::figure::mesh::Mesh;
use crate::figure::picture::{Anchor, Item, Path, Viewport};
use crate::figure::theme::Theme;

/// Width of the bar in pt.
const WIDTH: f64 = 12.0;
/// Distances in pt: from the edge of the view, between bar, ticks and numbers.
const GAP: f64 = 6.0;
/// Length of a tick in pt.
const TICK: f64 = 3.0;
/// Least distance of ticks in pt.
const TICK_SPACING: f64 = 32.0;
/// Type sizes in pt: numbers and title.
const SIZES: (f64, f64) = (9.0, 10.0);
/// Part of the view's height that the bar takes.
const HEIGHT: f64 = 0.6;
/// The colours are drawn as so many strips.
const STRIPS: u32 = 128;

/// A bar on a ground of its own over the right edge of `view`, the largest value above; `title` stands over it, typeset by
/// [`crate::figure::formula`] if it is between two `$`.
///
/// # Errors
///
/// `NonFinite` if the view is none.
pub fn color_bar(
    scale: &ColorScale,
    title: &str,
    view: &Viewport,
    theme: &Theme,
) -> Result<Vec<Item>, FigureError> {
    let (number_size, title_size) = (SIZES.0 * theme.text_scale, SIZES.1 * theme.text_scale);
    let height = HEIGHT * view.size.y;
    let ticks = scale.ticks(height / (TICK_SPACING * theme.text_scale));
    let numbers = ticks.iter().map(|tick| label_width(&tick.label, number_size)).fold(0.0, f64::max);
    let title_room = if title.is_empty() { 0.0 } else { title_size + GAP };
    let inner = (WIDTH + TICK + GAP + numbers).max(label_width(title, title_size));
    let left = view.size.x - 2.0 * GAP - inner;
    let top = 0.5 * (view.size.y - height + title_room);
    let place = |x: f64, y: f64| view.world_from_page(DVec2::new(x, y));
    let box_of = |left: f64, top: f64, right: f64, bottom: f64| {
        [place(left, bottom), place(right, bottom), place(right, top), place(left, top)]
    };

    let ground =
        box_of(left - GAP, top - title_room - 2.0 * GAP, left + inner + GAP, top + height + 2.0 * GAP);
    let mut items = vec![Item::Path(Path::polygon(&ground, None, Some(theme.panel.with_opacity(0.85))))];
    // Strips of one colour each: exporters draw them as they are.
    let strips = (0..STRIPS).map(|strip| f64::from(strip) / f64::from(STRIPS));
    let step = 1.0 / f64::from(STRIPS);
    let points = strips.clone().flat_map(|t| {
        let (lower, upper) = (top + height * (1.0 - t), top + height * (1.0 - t - step));
        box_of(left, upper, left + WIDTH, lower)
    });
    let colors = strips.flat_map(|t| [scale.map().color(t + 0.5 * step); 4]);
    let triangles =
        (0..STRIPS).flat_map(|strip| [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|i| i + 4 * strip)));
    items.push(Item::Mesh(Mesh::new(points.collect(), colors.collect(), triangles.collect())?));
    let axis = theme.stroke(theme.axis, 0.75);
    let frame = box_of(left, top, left + WIDTH, top + height);
    items.push(Item::Path(Path::polygon(&frame, Some(axis.clone()), None)));
    for tick in ticks {
        let y = top + height * (scale.high() - tick.value) / (scale.high() - scale.low());
        let ends = [place(left + WIDTH, y), place(left + WIDTH + TICK, y)];
        items.push(Item::Path(Path::polyline(&ends, axis.clone())));
        // Digits are about 0.7 of the type size high.
        let at = place(left + WIDTH + TICK + GAP, y + 0.35 * number_size);
        items.push(text(at, &tick.label, number_size, theme.muted_text, Anchor::Start));
    }
    if !title.is_empty() {
        items.push(text(place(left, top - GAP - 2.0), title, title_size, theme.text, Anchor::Start));
    }
    Ok(items)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::color_map::ColorMap;

    #[test]
    fn numbers_stand_at_the_heights_of_their_colours_inside_the_view() {
        let scale = ColorScale::new(-1.0, 3.0, ColorMap::Viridis).unwrap();
        let view = Viewport { center: DVec2::new(5.0, 7.0), scale: 30.0, size: DVec2::new(400.0, 300.0) };
        for theme in Theme::all() {
            let items = color_bar(&scale, "$u$", &view, &theme).unwrap();
            let mesh =
                items.iter().find_map(|item| if let Item::Mesh(mesh) = item { Some(mesh) } else { None });
            let mesh = mesh.unwrap();
            let page: Vec<DVec2> = mesh.points().iter().map(|&point| view.page_from_world(point)).collect();
            let (bottom, top) = (page[0].y, page[page.len() - 1].y);
            assert!(bottom - top > 150.0, "from {top} to {bottom}");
            let mut count = 0;
            for item in &items {
                let Item::Label(label) = item else { continue };
                let at = view.page_from_world(label.at);
                let right = at.x + label_width(&label.text, label.size);
                assert!(at.cmpgt(DVec2::ZERO).all() && right < view.size.x, "{} at {at}", label.text);
                let Ok(value) = label.text.replace('−', "-").parse::<f64>() else { continue };
                let expected = bottom + (top - bottom) * (value + 1.0) / 4.0 + 0.35 * label.size;
                assert!((at.y - expected).abs() < 1e-9, "{value} at {}", at.y);
                count += 1;
            }
            assert!(count >= 4, "{count} numbers");
        }
        let nowhere = Viewport { scale: 0.0, ..view };
        assert!(color_bar(&scale, "", &nowhere, &Theme::light()).is_err(), "no view");
    }
}
