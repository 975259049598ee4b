//! Where everything stands on the page.

use glam::DVec2;

use crate::document::{Approximation, ErrorPlot, PlotWindow};
use crate::figure::approximation::analysis::{Analysis, interval, knots_of};
use crate::figure::approximation::frame;
use crate::figure::approximation::plots::error_range;
use crate::figure::font_metrics::{FontFace, text_width};
use crate::figure::theme::Theme;
use crate::figure::ticks::{Tick, axis_ticks};

/// Height of the line of knots of one method in pt.
pub(super) const ROW: f64 = 18.0;
/// Space between things in pt.
pub(super) const GAP: f64 = 6.0;
/// Type size of numbers in pt.
pub(super) const NUMBER_SIZE: f64 = 9.5;
/// The same in the look with the largest type.
const LARGE_NUMBER: f64 = 1.4 * NUMBER_SIZE;
/// Least distance of ticks in pt.
const TICK_SPACING: DVec2 = DVec2::new(70.0, 34.0);
/// The error gets this part of the height, and nothing on pages lower than [`LOW_PAGE`].
const ERROR_PART: f64 = 0.32;
/// A page that is too low for two plots, in pt.
const LOW_PAGE: f64 = 240.0;
/// Part of the range added on either side of what is fitted.
const ROOM: f64 = 0.06;
/// Places where the height of function and curves is looked at.
const HEIGHT_SAMPLES: usize = 400;

/// A rectangle of the page with ranges along both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotArea {
    /// Lower left corner in pt.
    pub low: DVec2,
    /// Upper right corner in pt.
    pub high: DVec2,
    /// Numbers at the left and right side.
    pub x: [f64; 2],
    /// Numbers at the lower and upper side; logarithms to base 10 in a logarithmic plot.
    pub y: [f64; 2],
}

impl PlotArea {
    /// The place of `(x, y)` on the page.
    pub fn place(&self, x: f64, y: f64) -> DVec2 {
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        self.low + (self.high - self.low) * DVec2::new(part(x, self.x), part(y, self.y))
    }

    /// The numbers at a place of the page.
    pub fn numbers(&self, page: DVec2) -> (f64, f64) {
        let part = (page - self.low) / (self.high - self.low);
        let mix = |share: f64, [low, high]: [f64; 2]| low + (high - low) * share;
        (mix(part.x, self.x), mix(part.y, self.y))
    }

    /// Numbers per pt along both sides.
    pub fn per_point(&self) -> DVec2 {
        DVec2::new(self.x[1] - self.x[0], self.y[1] - self.y[0]) / (self.high - self.low)
    }

    /// Whether a place of the page is inside.
    pub fn contains(&self, page: DVec2) -> bool {
        page.cmpge(self.low).all() && page.cmple(self.high).all()
    }

    /// Ticks along the lower side.
    pub fn x_ticks(&self) -> Vec<Tick> {
        let extent = |label: &str| text_width(FontFace::Regular, label, LARGE_NUMBER) + GAP;
        axis_ticks(self.x.into(), self.high.x - self.low.x, TICK_SPACING.x, extent)
    }

    /// Ticks along the left side.
    pub fn y_ticks(&self) -> Vec<Tick> {
        axis_ticks(self.y.into(), self.high.y - self.low.y, TICK_SPACING.y, |_| 1.2 * LARGE_NUMBER)
    }
}

/// The line of knots of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotRow {
    /// Index of the method.
    pub method: usize,
    /// Height of the line on the page.
    pub y: f64,
    /// Its knots.
    pub knots: Vec<f64>,
    /// Whether they can be moved.
    pub movable: bool,
    /// The ends of the interval that are knots too, if they are not in the list.
    pub ends: Option<(f64, f64)>,
}

/// Where everything stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// The page in pt.
    pub size: DVec2,
    /// The plot of function, data and methods.
    pub main: PlotArea,
    /// The plot of the errors; logarithmic or not.
    pub error: Option<(PlotArea, bool)>,
    /// The lines of knots, from top to bottom.
    pub rows: Vec<KnotRow>,
    /// Height of the lower edge of each line of the legend, and where its entries begin.
    pub(super) legend: Vec<frame::Entry>,
}

impl Layout {
    /// The layout on a page of `size` pt that shows `window`.
    pub fn new(
        approximation: &Approximation,
        analysis: &Analysis,
        window: PlotWindow,
        theme: &Theme,
        size: DVec2,
    ) -> Self {
        let number = NUMBER_SIZE * theme.text_scale;
        let numbers_below = number + 2.0 * GAP;
        let legend = frame::legend(approximation, analysis, theme, size);
        let above = legend.last().map_or(2.0 * GAP, |entry| entry.from_top + 2.0 * GAP);
        let shown = approximation.methods().iter().enumerate().filter(|(_, method)| method.visible);
        let mut rows: Vec<KnotRow> = shown
            .map(|(index, method)| {
                let fit = analysis.fits.get(index).and_then(|fit| fit.as_deref().ok());
                let (knots, movable) = knots_of(method, fit);
                let all = method
                    .scheme
                    .space()
                    .is_some_and(|(_, choice)| matches!(choice, crate::document::KnotChoice::All(_)));
                let ends = interval(approximation, &method.scheme).filter(|_| !all);
                KnotRow { method: index, y: 0.0, knots, movable, ends }
            })
            .collect();
        let has_error = approximation.error_plot() != ErrorPlot::Hidden && size.y >= LOW_PAGE;
        let error_height = if has_error { ERROR_PART * size.y } else { 0.0 };
        let strip = rows.len() as f64 * ROW + if rows.is_empty() { 0.0 } else { 0.5 * GAP };
        let bottom = error_height + numbers_below + GAP;
        // All numbers at the left edge get the same room, so that both plots begin at the same place.
        let left = 58.0 * theme.text_scale;
        let (x0, x1) = (left.min(0.4 * size.x), (size.x - 3.0 * GAP).max(0.4 * size.x + 1.0));
        let low = (bottom + strip).min(0.7 * size.y);
        let main = PlotArea {
            low: DVec2::new(x0, low),
            high: DVec2::new(x1, (size.y - above).max(low + 1.0)),
            x: window.x,
            y: window.y,
        };
        for (place, row) in rows.iter_mut().enumerate() {
            row.y = low - (place as f64 + 0.5) * ROW - 0.25 * GAP;
        }
        let error = has_error.then(|| {
            let logarithmic = approximation.error_plot() == ErrorPlot::Logarithmic;
            let y = error_range(approximation, analysis, window.x, logarithmic);
            let low = DVec2::new(x0, numbers_below + GAP);
            let high = DVec2::new(x1, (error_height - 1.5 * GAP - number).max(low.y + 1.0));
            (PlotArea { low, high, x: window.x, y }, logarithmic)
        });
        Self { size, main, error, rows, legend }
    }
}

/// The window that shows function, data and, as far as they do not run away, the curves.
pub fn fitted_window(approximation: &Approximation, analysis: &Analysis) -> PlotWindow {
    let Some((left, right)) = approximation.interval() else { return PlotWindow::default() };
    let reach = |range: (f64, f64)| range.1 - range.0;
    let x = |share: f64| left + (right - left) * share;
    let shares = || (0..=HEIGHT_SAMPLES).map(|i| i as f64 / HEIGHT_SAMPLES as f64);
    let spread = |range: (f64, f64), value: f64| {
        if value.is_finite() { (range.0.min(value), range.1.max(value)) } else { range }
    };
    let mut height = approximation.data_box().map_or((f64::INFINITY, f64::NEG_INFINITY), |(_, y)| y);
    if let Some(function) = approximation.function() {
        height = shares().map(|share| function.value(x(share))).fold(height, spread);
    }
    if height.0 <= height.1 {
        let (low, high) = (height.0 - 0.5 * reach(height), height.1 + 0.5 * reach(height));
        for fit in approximation.methods().iter().zip(&analysis.fits).filter(|(method, _)| method.visible) {
            if let Ok(fit) = fit.1 {
                height = shares()
                    .map(|share| fit.value(x(share)))
                    .filter(|value| value.is_finite())
                    .map(|value| value.clamp(low, high))
                    .fold(height, spread);
            }
        }
    } else {
        height = (0.0, 1.0);
    }
    PlotWindow { x: with_room((left, right)), y: with_room(height) }
}

/// The range with some room on both sides; around a single number as far as it is from 0, or by 1.
fn with_room((low, high): (f64, f64)) -> [f64; 2] {
    let length = high - low;
    let size = low.abs().max(high.abs());
    let room = if length > 1e-12 * size {
        ROOM * length
    } else if size > 1e-300 {
        0.5 * size
    } else {
        1.0
    };
    let range = [low - room, high + room];
    if (range[1] - range[0]).is_finite() { range } else { [0.5 * low, 0.5 * high] }
}
