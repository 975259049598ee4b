//! Axes, ticks, names and legend.

use glam::DVec2;

use crate::document::Approximation;
use crate::figure::approximation::analysis::Analysis;
use crate::figure::approximation::layout::{GAP, Layout, NUMBER_SIZE, PlotArea};
use crate::figure::chart::{label_width, text};
use crate::figure::picture::{Anchor, Item, Marker, MarkerShape, Path, Picture};
use crate::figure::theme::Theme;

/// Length of the line in front of an entry of the legend in pt.
const SAMPLE: f64 = 20.0;

/// Three significant digits.
pub fn error_text(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor();
    let text = if (-3.0..5.0).contains(&magnitude) {
        format!("{value:.*}", (2.0 - magnitude).max(0.0) as usize)
    } else {
        format!("{value:.2e}")
    };
    text.replace('-', "\u{2212}")
}

/// What an entry of the legend stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Of {
    Function,
    Data,
    Method(usize),
}

/// An entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    of: Of,
    text: String,
    left: f64,
    /// Distance of the line's lower edge from the top of the page.
    pub(super) from_top: f64,
}

/// The legend, broken into lines.
pub(super) fn legend(
    approximation: &Approximation,
    analysis: &Analysis,
    theme: &Theme,
    size: DVec2,
) -> Vec<Entry> {
    let mut names = Vec::new();
    if let Some(function) = approximation.function() {
        let formula: String = function.text().chars().take(60).collect();
        names.push((Of::Function, format!("f(x) = {formula}")));
    }
    if !approximation.is_empty() {
        names.push((Of::Data, "data".to_owned()));
    }
    for (index, method) in approximation.methods().iter().enumerate().filter(|(_, method)| method.visible) {
        let title = method.scheme.title();
        let text = match analysis.fits.get(index) {
            Some(Ok(fit)) => fit
                .error()
                .map_or_else(|| title.clone(), |error| format!("{title}: {}", error_text(error.size))),
            Some(Err(_)) => format!("{title}: no solution"),
            None => title,
        };
        names.push((Of::Method(index), text));
    }
    let type_size = NUMBER_SIZE * theme.text_scale;
    let line = type_size + GAP;
    let start = 58.0 * theme.text_scale;
    let (mut left, mut from_top) = (start, line + GAP);
    let mut entries = Vec::new();
    for (of, text) in names {
        let width = SAMPLE + GAP + label_width(&text, type_size) + 3.0 * GAP;
        if left > start && left + width > size.x - GAP {
            (left, from_top) = (start, from_top + line);
        }
        entries.push(Entry { of, text, left, from_top });
        left += width;
    }
    entries
}

/// Lines at the ticks of both plots.
pub(super) fn grid(layout: &Layout, theme: &Theme) -> Vec<Item> {
    let stroke = theme.stroke(theme.grid_major, 0.5);
    let areas = [Some(&layout.main), layout.error.as_ref().map(|(area, _)| area)];
    let mut items = Vec::new();
    for area in areas.into_iter().flatten() {
        let upright = area.x_ticks().into_iter().map(|tick| {
            let x = area.place(tick.value, area.y[0]).x;
            [DVec2::new(x, area.low.y), DVec2::new(x, area.high.y)]
        });
        let level = area.y_ticks().into_iter().map(|tick| {
            let y = area.place(area.x[0], tick.value).y;
            [DVec2::new(area.low.x, y), DVec2::new(area.high.x, y)]
        });
        items.extend(upright.chain(level).map(|ends| Item::Path(Path::polyline(&ends, stroke.clone()))));
    }
    items
}

/// Adds frames, numbers, names and legend.
pub(super) fn push(
    picture: &mut Picture,
    approximation: &Approximation,
    analysis: &Analysis,
    layout: &Layout,
    theme: &Theme,
) {
    let size = NUMBER_SIZE * theme.text_scale;
    let error = layout.error.as_ref();
    let areas = [Some(&layout.main), error.map(|(area, _)| area)];
    let frames = areas.into_iter().flatten().map(|area| {
        let corners =
            [area.low, DVec2::new(area.high.x, area.low.y), area.high, DVec2::new(area.low.x, area.high.y)];
        Item::Path(Path::polygon(&corners, Some(theme.stroke(theme.axis, 0.75)), None))
    });
    picture.push_layer("frames", frames.collect());
    let below_rows = layout.rows.last().map_or(layout.main.low.y, |row| row.y - 8.0);
    let mut texts = x_numbers(&layout.main, below_rows, theme);
    texts.extend(y_numbers(&layout.main, false, theme));
    if let Some((area, logarithmic)) = error {
        texts.extend(x_numbers(area, area.low.y, theme));
        texts.extend(y_numbers(area, *logarithmic, theme));
        let name = match (approximation.function(), logarithmic) {
            (Some(_), false) => "$p - f$",
            (Some(_), true) => "$|p - f|$",
            (None, false) => "$p(x_i) - y_i$",
            (None, true) => "$|p(x_i) - y_i|$",
        };
        let at = DVec2::new(area.low.x, area.high.y + 0.8 * GAP);
        texts.push(text(at, name, size + 1.0, theme.text, Anchor::Start));
        texts.extend(worst(approximation, analysis, area, theme));
    }
    picture.push_layer("numbers", texts);
    picture.push_layer("legend", legend_items(approximation, layout, theme));
}

/// The largest error of the methods in words, at the right end over the error plot.
fn worst(approximation: &Approximation, analysis: &Analysis, area: &PlotArea, theme: &Theme) -> Option<Item> {
    let visible = approximation.methods().iter().zip(&analysis.fits).filter(|(method, _)| method.visible);
    let errors: Vec<_> =
        visible.filter_map(|(_, fit)| fit.as_ref().ok().and_then(|fit| fit.error())).collect();
    let [error] = errors.as_slice() else { return None };
    let words = format!("largest {} at x = {}", error_text(error.size), error_text(error.at));
    let at = DVec2::new(area.high.x, area.high.y + 0.8 * GAP);
    Some(text(at, &words, NUMBER_SIZE * theme.text_scale, theme.muted_text, Anchor::End))
}

fn x_numbers(area: &PlotArea, from: f64, theme: &Theme) -> Vec<Item> {
    let size = NUMBER_SIZE * theme.text_scale;
    let ticks = area.x_ticks().into_iter();
    ticks
        .map(|tick| {
            let at = DVec2::new(area.place(tick.value, area.y[0]).x, from - GAP - 0.8 * size);
            text(at, &tick.label, size, theme.muted_text, Anchor::Middle)
        })
        .collect()
}

fn y_numbers(area: &PlotArea, logarithmic: bool, theme: &Theme) -> Vec<Item> {
    let size = NUMBER_SIZE * theme.text_scale;
    let ticks = area.y_ticks().into_iter().filter(|tick| !logarithmic || tick.value.fract() == 0.0);
    ticks
        .map(|tick| {
            let label = if logarithmic { format!("$10^{{{}}}$", tick.label) } else { tick.label };
            let y = area.place(area.x[0], tick.value).y;
            let at = DVec2::new(area.low.x - GAP, y - 0.35 * size);
            text(at, &label, size, theme.muted_text, Anchor::End)
        })
        .collect()
}

fn legend_items(approximation: &Approximation, layout: &Layout, theme: &Theme) -> Vec<Item> {
    let size = NUMBER_SIZE * theme.text_scale;
    let mut items = Vec::new();
    for entry in &layout.legend {
        let y = layout.size.y - entry.from_top + 0.5 * size;
        let ends = [DVec2::new(entry.left, y), DVec2::new(entry.left + SAMPLE, y)];
        let middle = (ends[0] + ends[1]) * 0.5;
        items.push(match entry.of {
            Of::Function => Item::Path(Path::polyline(&ends, theme.dashed_stroke(theme.text, 1.5, 6.0, 4.0))),
            Of::Data => Item::Marker(Marker {
                at: middle,
                shape: MarkerShape::Disc,
                size: 6.0,
                fill: Some(theme.text),
                stroke: None,
            }),
            Of::Method(index) => {
                let color = approximation.methods().get(index).map_or(0, |method| method.color);
                Item::Path(Path::polyline(&ends, theme.stroke(theme.basis_color(color), 2.0)))
            }
        });
        let at = DVec2::new(entry.left + SAMPLE + GAP, y - 0.35 * size);
        items.push(text(at, &entry.text, size, theme.text, Anchor::Start));
    }
    items
}
