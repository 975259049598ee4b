//! Function, curves, data and errors.

use std::collections::HashSet;

use glam::DVec2;

use crate::core::approximation::ApproximationError;
use crate::document::{Approximation, Scheme};
use crate::figure::approximation::analysis::{Analysis, Fit};
use crate::figure::approximation::layout::{Layout, PlotArea};
use crate::figure::clip::polyline_in_box;
use crate::figure::picture::{Item, Marker, MarkerShape, Path, Picture, Stroke};
use crate::figure::theme::Theme;

/// Distance of samples along the page in pt.
const STEP: f64 = 0.75;
/// Diameter of data in pt.
const DATUM: f64 = 7.0;
/// More data than this in view are drawn smaller, and only where none is drawn yet.
const CROWD: usize = 600;
/// Curves have at most so many corners at knots in view.
const MOST_BREAKS: usize = 4000;
/// Coefficients are drawn over the knot averages if there are at most so many.
const MOST_AVERAGES: usize = 120;
/// Decades that a logarithmic error plot shows at most.
const DECADES: f64 = 9.0;
/// Samples that the range of the errors is taken from.
const RANGE_SAMPLES: usize = 300;

/// Adds everything between the axes.
pub(super) fn push(
    picture: &mut Picture,
    approximation: &Approximation,
    analysis: &Analysis,
    layout: &Layout,
    theme: &Theme,
) {
    let main = &layout.main;
    if let Some(function) = approximation.function() {
        let (left, right) = function.interval();
        let stroke = theme.dashed_stroke(theme.text, 1.5, 6.0, 4.0);
        let line = sampled(main, left, right, &[], &|x| function.value(x));
        picture.push_layer("function", lines(&line, main, &stroke));
    }
    let methods = || approximation.methods().iter().zip(&analysis.fits).filter(|(method, _)| method.visible);
    for (method, fit) in methods() {
        let Ok(fit) = fit else { continue };
        let color = theme.basis_color(method.color);
        let line = curve(main, fit, None, &|x| fit.value(x));
        let mut items = lines(&line, main, &theme.stroke(color, 2.0));
        if matches!(method.scheme, Scheme::Schoenberg { .. }) {
            items.extend(averages(fit, main, theme.stroke(color, 1.25), theme));
        }
        picture.push_layer(format!("curve: {}", method.scheme.title()), items);
    }
    picture.push_layer("data", data(approximation, main, theme));
    picture.push_layer("violations", violations(approximation, analysis, main, theme));
    let Some((area, logarithmic)) = &layout.error else { return };
    if !logarithmic && area.y[0] < 0.0 && 0.0 < area.y[1] {
        let zero = [area.place(area.x[0], 0.0), area.place(area.x[1], 0.0)];
        let line = Path::polyline(&zero, theme.stroke(theme.axis, 0.75));
        picture.push_layer("no error", vec![Item::Path(line)]);
    }
    for (method, fit) in methods() {
        let Ok(fit) = fit else { continue };
        let stroke = theme.stroke(theme.basis_color(method.color), 1.5);
        let items = errors(approximation, fit, area, *logarithmic, &stroke);
        picture.push_layer(format!("error: {}", method.scheme.title()), items);
    }
}

/// What of a function over `[left, right]` is in view, `None` where it has no value; `extra` places are looked at too.
fn sampled(
    area: &PlotArea,
    left: f64,
    right: f64,
    extra: &[f64],
    value: &dyn Fn(f64) -> f64,
) -> Vec<Option<DVec2>> {
    let (from, to) = (left.max(area.x[0]), right.min(area.x[1]));
    if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
        return Vec::new();
    }
    let width = (area.high.x - area.low.x) * ((to - from) / (area.x[1] - area.x[0]));
    let count = ((width / STEP).ceil() as usize).clamp(2, 20_000);
    let mut sites: Vec<f64> = (0..=count).map(|i| from + (to - from) * (i as f64 / count as f64)).collect();
    sites[count] = to;
    sites.extend(extra.iter().filter(|&&x| from < x && x < to));
    sites.sort_by(f64::total_cmp);
    sites.into_iter().map(|x| Some(area.place(x, value(x))).filter(|place| place.is_finite())).collect()
}

/// What of a spline, or of something made from it, is in view, with corners at the knots.
fn curve(
    area: &PlotArea,
    fit: &Fit,
    within: Option<(f64, f64)>,
    value: &dyn Fn(f64) -> f64,
) -> Vec<Option<DVec2>> {
    let space = fit.spline.space();
    let (mut left, mut right) = space.parameter_interval();
    if let Some((from, to)) = within {
        (left, right) = (left.max(from), right.min(to));
    }
    let mut breaks = space.breaks();
    breaks.retain(|&x| area.x[0] < x && x < area.x[1]);
    // Closer ones cannot be told apart.
    if breaks.len() > MOST_BREAKS {
        breaks.clear();
    }
    sampled(area, left, right, &breaks, value)
}

fn lines(places: &[Option<DVec2>], area: &PlotArea, stroke: &Stroke) -> Vec<Item> {
    places
        .split(Option::is_none)
        .flat_map(|part| {
            let line: Vec<DVec2> = part.iter().flatten().copied().collect();
            polyline_in_box(&line, area.low, area.high)
        })
        .map(|line| Item::Path(Path::polyline(&line, stroke.clone())))
        .collect()
}

/// The values at the knot averages, which are the coefficients of Schoenberg's scheme.
fn averages(fit: &Fit, area: &PlotArea, stroke: Stroke, theme: &Theme) -> Vec<Item> {
    let averages = fit.spline.space().greville_abscissae();
    if averages.len() > MOST_AVERAGES {
        return Vec::new();
    }
    let places = averages.iter().zip(fit.spline.coefficients()).map(|(&x, &y)| area.place(x, y));
    places
        .filter(|&at| area.contains(at))
        .map(|at| marker(at, MarkerShape::Square, 6.0, Some(theme.background), Some(stroke.clone()), theme))
        .collect()
}

fn marker(
    at: DVec2,
    shape: MarkerShape,
    size: f64,
    fill: Option<crate::figure::picture::Color>,
    stroke: Option<Stroke>,
    theme: &Theme,
) -> Item {
    Item::Marker(Marker { at, shape, size: size * theme.stroke_scale.sqrt(), fill, stroke })
}

/// Indices of the data in view.
fn in_view(approximation: &Approximation, area: &PlotArea) -> std::ops::Range<usize> {
    let sites = approximation.sites();
    let from = sites.partition_point(|&site| site < area.x[0]);
    from..sites.partition_point(|&site| site <= area.x[1]).max(from)
}

fn data(approximation: &Approximation, area: &PlotArea, theme: &Theme) -> Vec<Item> {
    let shown = in_view(approximation, area);
    let crowd = shown.len() > CROWD;
    let mut taken: HashSet<(i64, i64)> = HashSet::new();
    let mut items = Vec::new();
    for index in shown {
        let at = area.place(approximation.sites()[index], approximation.values()[index]);
        if !area.contains(at) {
            continue;
        }
        let cell = (at * 0.5).floor();
        if crowd && !taken.insert((cell.x as i64, cell.y as i64)) {
            continue;
        }
        let (size, stroke) = if crowd {
            (3.0, None)
        } else {
            let weight = approximation.weight(index).powf(0.25).clamp(0.6, 1.8);
            (DATUM * weight, Some(theme.stroke(theme.background, 1.0)))
        };
        items.push(marker(at, MarkerShape::Disc, size, Some(theme.text), stroke, theme));
    }
    items
}

/// The sites that the condition of Schoenberg and Whitney names.
fn violations(
    approximation: &Approximation,
    analysis: &Analysis,
    area: &PlotArea,
    theme: &Theme,
) -> Vec<Item> {
    let methods = approximation.methods().iter().zip(&analysis.fits).filter(|(method, _)| method.visible);
    methods
        .filter_map(|(_, fit)| match fit.as_ref().err().map(|error| &**error) {
            Some(ApproximationError::SchoenbergWhitney { index, .. }) => Some(*index),
            _ => None,
        })
        .filter_map(|index| {
            Some(area.place(*approximation.sites().get(index)?, *approximation.values().get(index)?))
        })
        .filter(|&at| area.contains(at))
        .map(|at| marker(at, MarkerShape::Disc, 14.0, None, Some(theme.stroke(theme.error, 2.0)), theme))
        .collect()
}

/// The number in the plot for an error.
fn shown_error(error: f64, logarithmic: bool) -> f64 {
    if !logarithmic {
        return error;
    }
    if error == 0.0 { f64::NAN } else { error.abs().log10() }
}

fn errors(
    approximation: &Approximation,
    fit: &Fit,
    area: &PlotArea,
    logarithmic: bool,
    stroke: &Stroke,
) -> Vec<Item> {
    let places = match approximation.function() {
        Some(function) => curve(area, fit, Some(function.interval()), &|x| {
            shown_error(fit.value(x) - function.value(x), logarithmic)
        }),
        None => {
            // The neighbours just outside the view belong to the line too.
            let shown = in_view(approximation, area);
            let shown = shown.start.saturating_sub(1)..(shown.end + 1).min(approximation.len());
            let every = (shown.len() / 4000).max(1);
            shown
                .step_by(every)
                .map(|index| {
                    let (x, y) = (approximation.sites()[index], approximation.values()[index]);
                    let place = area.place(x, shown_error(fit.value(x) - y, logarithmic));
                    Some(place).filter(|place| place.is_finite())
                })
                .collect()
        }
    };
    let mut items = lines(&places, area, stroke);
    if approximation.function().is_none() && places.len() <= CROWD {
        let inside = places.into_iter().flatten().filter(|&at| area.contains(at));
        items.extend(inside.map(|at| {
            let (shape, fill) = (MarkerShape::Disc, Some(stroke.color));
            Item::Marker(Marker { at, shape, size: 4.5, fill, stroke: None })
        }));
    }
    items
}

/// The range that the error plot shows: all errors in view, and 0 or some decades.
pub(super) fn error_range(
    approximation: &Approximation,
    analysis: &Analysis,
    [left, right]: [f64; 2],
    logarithmic: bool,
) -> [f64; 2] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut see = |error: f64| {
        let shown = shown_error(error, logarithmic);
        if shown.is_finite() {
            (low, high) = (low.min(shown), high.max(shown));
        }
    };
    let sites = approximation.sites();
    let from = sites.partition_point(|&site| site < left);
    let to = sites.partition_point(|&site| site <= right).max(from);
    for (method, fit) in approximation.methods().iter().zip(&analysis.fits) {
        let (true, Ok(fit)) = (method.visible, fit) else { continue };
        if let Some(function) = approximation.function() {
            let (from, to) = function.interval();
            let (from, to) = (from.max(left), to.min(right));
            if from < to {
                for sample in 0..=RANGE_SAMPLES {
                    let x = from + (to - from) * (sample as f64 / RANGE_SAMPLES as f64);
                    see(fit.value(x) - function.value(x));
                }
            }
            let extreme = fit.from_function.filter(|extreme| left <= extreme.at && extreme.at <= right);
            if let Some(extreme) = extreme {
                see(fit.value(extreme.at) - function.value(extreme.at));
            }
        } else {
            let every = ((to - from) / 2000).max(1);
            (from..to).step_by(every).for_each(|i| see(fit.value(sites[i]) - approximation.values()[i]));
        }
    }
    if low > high {
        return if logarithmic { [-8.0, 0.0] } else { [-1.0, 1.0] };
    }
    if logarithmic {
        let top = (high + 0.1).ceil();
        return [low.floor().max(top - DECADES).min(top - 1.0), top];
    }
    let (low, high) = (low.min(0.0), high.max(0.0));
    let room = if high > low { 0.08 * (high - low) } else { 1.0 };
    [low - room, high + room]
}
