//! Data over two axes, as a picture.
//!
//! The picture's world is the page: 1 unit is 1 pt, the origin is the lower left corner; [`Chart::view`] shows it whole.

use glam::DVec2;

use crate::figure::chart_axis::{ScaledAxis, placed, shortened};
use crate::figure::clip::{polyline_in_box, segment_in_box};
use crate::figure::font_metrics::{FontFace, text_width};
use crate::figure::formula;
use crate::figure::picture::{
    Anchor, Color, Item, Label, Marker, MarkerShape, Path, Picture, Stroke, Viewport,
};
use crate::figure::theme::Theme;
use crate::figure::ticks::Tick;

/// Least distance of ticks in pt along an axis.
const TICK_SPACING: DVec2 = DVec2::new(60.0, 32.0);
/// Type size of the numbers in pt.
const NUMBER_SIZE: f64 = 9.0;
/// Type size of the names of axes and series in pt.
const NAME_SIZE: f64 = 10.0;
/// Type size of the title in pt.
const TITLE_SIZE: f64 = 12.0;
/// Space between things beside the plot in pt.
const GAP: f64 = 6.0;

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AxisScale {
    /// Equal distances for equal differences.
    #[default]
    Linear,
    /// Equal distances for equal ratios; only positive numbers have a place.
    Logarithmic,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SeriesStyle {
    /// A line from point to point.
    #[default]
    Line,
    /// A dashed line.
    DashedLine,
    /// Marks.
    Marks,
    /// A line with marks.
    LineWithMarks,
}

/// One set of data.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; none if empty.
    pub name: String,
    /// Colour.
    pub color: Color,
    /// The data. A line is interrupted at points without a place: not finite, or not positive on a logarithmic axis.
    pub points: Vec<DVec2>,
    /// How it is drawn.
    pub style: SeriesStyle,
}

/// An axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Its name; typeset by [`crate::figure::formula`] if it stands between two `$`.
    pub label: String,
    /// How numbers are laid out.
    pub scale: AxisScale,
    /// Its ends; found from the data if `None` or if they make no range.
    pub range: Option<(f64, f64)>,
}

/// Where the data stand on the page: the corners between the axes, and the numbers at their ends (logarithms on a logarithmic axis).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartArea {
    /// Lower left corner in pt.
    pub low: DVec2,
    /// Upper right corner in pt.
    pub high: DVec2,
    /// What the horizontal axis shows.
    pub x: (f64, f64),
    /// What the vertical axis shows.
    pub y: (f64, f64),
}

impl ChartArea {
    /// On the page, from numbers on the axes.
    pub fn page(&self, x: f64, y: f64) -> DVec2 {
        let part = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        self.low + (self.high - self.low) * DVec2::new(part(x, self.x), part(y, self.y))
    }

    /// The number on the horizontal axis, from a place on the page.
    pub fn x_at(&self, page_x: f64) -> f64 {
        let share = (page_x - self.low.x) / (self.high.x - self.low.x);
        self.x.0 + share * (self.x.1 - self.x.0)
    }
}

/// Series over two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Title above; none if empty.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The data, first drawn first.
    pub series: Vec<Series>,
}

impl Chart {
    /// The view that shows the picture of a page of `size` pt.
    pub fn view(size: DVec2) -> Viewport {
        Viewport { center: size * 0.5, scale: 1.0, size }
    }

    /// Where the data stand on a page of `size` pt.
    pub fn area(&self, theme: &Theme, size: DVec2) -> ChartArea {
        let Plot { low, high, x, y, .. } = self.plot(theme, size);
        ChartArea { low, high, x: x.ends, y: y.ends }
    }

    /// The rectangle between the axes, and the ticks beside it.
    fn plot(&self, theme: &Theme, size: DVec2) -> Plot {
        let x = ScaledAxis::new(
            &self.x,
            self.series.iter().flat_map(|series| &series.points).map(|point| point.x),
        );
        let y = ScaledAxis::new(
            &self.y,
            self.series.iter().flat_map(|series| &series.points).map(|point| point.y),
        );
        let type_scale = theme.text_scale;
        let number_size = NUMBER_SIZE * type_scale;
        let (name_size, title_size) = (NAME_SIZE * type_scale, TITLE_SIZE * type_scale);

        let lower = number_size + name_size + 3.0 * GAP;
        let upper = if self.title.is_empty() { 2.0 * GAP } else { title_size + 2.5 * GAP };
        let above_axis = if self.y.label.is_empty() && y.factor == 0 { 0.0 } else { name_size + GAP };
        let height = size.y - lower - upper - above_axis;
        let y_ticks = y.ticks(height, TICK_SPACING.y * type_scale, |_| 1.2 * number_size);
        let width_of = |label: &str| label_width(label, number_size);
        let widest = |ticks: &[Tick]| ticks.iter().map(|tick| width_of(&tick.label)).fold(0.0, f64::max);
        let beside = widest(&y_ticks) + 2.5 * GAP;
        let x_ticks =
            |width: f64| x.ticks(width, TICK_SPACING.x * type_scale, |label| width_of(label) + 1.5 * GAP);
        // Half of a number may stand beyond each end of the axis.
        let half = 0.5 * widest(&x_ticks(size.x - beside - 2.5 * GAP)) + 0.5 * GAP;
        let low = DVec2::new(beside.max(half), lower);
        let high = DVec2::new(size.x - half.max(2.5 * GAP), size.y - upper - above_axis).max(low + 1.0);
        let x_ticks = x_ticks(high.x - low.x);
        Plot { low, high, x, y, x_ticks, y_ticks }
    }

    /// The chart on a page of `size` pt.
    pub fn to_picture(&self, theme: &Theme, size: DVec2) -> Picture {
        let plot = self.plot(theme, size);
        let (low, high) = (plot.low, plot.high);
        let type_scale = theme.text_scale;
        let (name_size, title_size) = (NAME_SIZE * type_scale, TITLE_SIZE * type_scale);

        let mut picture = Picture::new(Some(theme.background));
        picture.push_layer("grid", plot.grid(theme));
        for series in &self.series {
            picture.push_layer(format!("series: {}", series.name), plot.series(series, theme));
        }
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let frame = Path::polygon(&corners, Some(theme.stroke(theme.axis, 0.75)), None);
        picture.push_layer("frame", vec![Item::Path(frame)]);
        let mut texts = plot.numbers(theme);
        let middle = (low.x + high.x) / 2.0;
        let width = high.x - low.x;
        let x_name = plot.x.name(&self.x.label, name_size, width);
        let y_name = plot.y.name(&self.y.label, name_size, size.x - low.x - GAP);
        let title = shortened(&self.title, title_size, width);
        texts.push(text(DVec2::new(middle, GAP), &x_name, name_size, theme.text, Anchor::Middle));
        texts.push(text(DVec2::new(low.x, high.y + GAP), &y_name, name_size, theme.text, Anchor::Start));
        let head = DVec2::new(middle, size.y - title_size - GAP * 0.5);
        texts.push(text(head, &title, title_size, theme.text, Anchor::Middle));
        texts.retain(|item| !matches!(item, Item::Label(label) if label.text.is_empty()));
        picture.push_layer("text", texts);
        picture.push_layer("legend", self.legend(&plot, theme));
        picture
    }

    /// Names of the series in a box, in the corner where it hides least; none for fewer than two names.
    fn legend(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let named: Vec<&Series> = self.series.iter().filter(|series| !series.name.is_empty()).collect();
        if named.len() < 2 {
            return Vec::new();
        }
        let size = NUMBER_SIZE * theme.text_scale;
        let (line, sample) = (size * 1.5, 2.2 * size);
        let widest = named.iter().map(|series| label_width(&series.name, size)).fold(0.0, f64::max);
        let extent = DVec2::new(widest + sample + 3.0 * GAP, line * named.len() as f64 + GAP);
        let (first, last) = (plot.low + GAP, plot.high - GAP - extent);
        let places = [last, DVec2::new(first.x, last.y), DVec2::new(last.x, first.y), first];
        let hidden = |low: &DVec2| {
            self.series.iter().map(|series| plot.hidden(series, *low, *low + extent)).sum::<usize>()
        };
        let low = places.into_iter().min_by_key(hidden).unwrap_or(last);
        let high = low + extent;
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let ground = Some(theme.panel.with_opacity(0.9));
        let mut items = vec![Item::Path(Path::polygon(&corners, None, ground))];
        for (row, series) in named.into_iter().enumerate() {
            let y = high.y - GAP * 0.5 - line * (row as f64 + 0.5);
            let left = DVec2::new(low.x + GAP, y);
            let right = left + DVec2::X * sample;
            if let Some(stroke) = series.stroke(theme) {
                items.push(Item::Path(Path::polyline(&[left, right], stroke)));
            }
            if series.has_marks() {
                items.push(series.mark((left + right) * 0.5, theme));
            }
            let place = right + DVec2::new(GAP, -0.35 * size);
            items.push(text(place, &series.name, size, theme.text, Anchor::Start));
        }
        items
    }
}

impl Series {
    fn stroke(&self, theme: &Theme) -> Option<Stroke> {
        match self.style {
            SeriesStyle::Marks => None,
            SeriesStyle::DashedLine => Some(theme.dashed_stroke(self.color, 1.5, 5.0, 3.0)),
            SeriesStyle::Line | SeriesStyle::LineWithMarks => Some(theme.stroke(self.color, 1.5)),
        }
    }

    const fn has_marks(&self) -> bool {
        matches!(self.style, SeriesStyle::Marks | SeriesStyle::LineWithMarks)
    }

    fn mark(&self, at: DVec2, theme: &Theme) -> Item {
        let stroke = Some(theme.stroke(theme.background, 0.75));
        let size = 5.5 * theme.stroke_scale;
        Item::Marker(Marker { at, shape: MarkerShape::Disc, size, fill: Some(self.color), stroke })
    }
}

/// The rectangle between the axes.
struct Plot {
    low: DVec2,
    high: DVec2,
    x: ScaledAxis,
    y: ScaledAxis,
    x_ticks: Vec<Tick>,
    y_ticks: Vec<Tick>,
}

impl Plot {
    /// On the page, from numbers on the axes.
    fn page(&self, x: f64, y: f64) -> DVec2 {
        ChartArea { low: self.low, high: self.high, x: self.x.ends, y: self.y.ends }.page(x, y)
    }

    fn grid(&self, theme: &Theme) -> Vec<Item> {
        let stroke = theme.stroke(theme.grid_major, 0.5);
        let upright = self.x_ticks.iter().map(|tick| {
            let x = self.page(tick.value, 0.0).x;
            [DVec2::new(x, self.low.y), DVec2::new(x, self.high.y)]
        });
        let level = self.y_ticks.iter().map(|tick| {
            let y = self.page(0.0, tick.value).y;
            [DVec2::new(self.low.x, y), DVec2::new(self.high.x, y)]
        });
        upright.chain(level).map(|ends| Item::Path(Path::polyline(&ends, stroke.clone()))).collect()
    }

    fn numbers(&self, theme: &Theme) -> Vec<Item> {
        let size = NUMBER_SIZE * theme.text_scale;
        let below = self.x_ticks.iter().map(|tick| {
            let place = DVec2::new(self.page(tick.value, 0.0).x, self.low.y - GAP - 0.95 * size);
            text(place, &tick.label, size, theme.muted_text, Anchor::Middle)
        });
        let beside = self.y_ticks.iter().map(|tick| {
            let place = DVec2::new(self.low.x - GAP, self.page(0.0, tick.value).y - 0.35 * size);
            text(place, &tick.label, size, theme.muted_text, Anchor::End)
        });
        below.chain(beside).collect()
    }

    /// Places on the page; `None` for points without one.
    fn places(&self, series: &Series) -> Vec<Option<DVec2>> {
        let points = series.points.iter();
        points
            .map(|point| Some(self.page(placed(self.x.scale, point.x)?, placed(self.y.scale, point.y)?)))
            .map(|place| place.filter(|place| place.is_finite()))
            .collect()
    }

    /// How many points and connections of a series a box would hide.
    fn hidden(&self, series: &Series, low: DVec2, high: DVec2) -> usize {
        let places = self.places(series);
        let is_inside = |a: DVec2, b: DVec2| segment_in_box(a, b, low, high).is_some();
        let points = places.iter().flatten().filter(|&&place| is_inside(place, place)).count();
        let is_hidden = |ends: &&[Option<DVec2>]| matches!(ends, [Some(a), Some(b)] if is_inside(*a, *b));
        points + places.windows(2).filter(is_hidden).count()
    }

    fn series(&self, series: &Series, theme: &Theme) -> Vec<Item> {
        let places = self.places(series);
        let mut items = Vec::new();
        if let Some(stroke) = series.stroke(theme) {
            for part in places.split(Option::is_none) {
                let line: Vec<DVec2> = part.iter().flatten().copied().collect();
                let inside = polyline_in_box(&line, self.low, self.high);
                items.extend(inside.iter().map(|part| Item::Path(Path::polyline(part, stroke.clone()))));
            }
        }
        if series.has_marks() {
            let is_inside =
                |place: &DVec2| place.cmpge(self.low - 1e-6).all() && place.cmple(self.high + 1e-6).all();
            items.extend(
                places.into_iter().flatten().filter(is_inside).map(|place| series.mark(place, theme)),
            );
        }
        items
    }
}

/// The formula between two `$`, if there is one.
pub(super) fn formula_in(text: &str) -> Option<&str> {
    text.strip_prefix('$').and_then(|rest| rest.strip_suffix('$'))
}

/// A text; typeset as a formula if it is between two `$`.
pub(crate) fn text(at: DVec2, text: &str, size: f64, color: Color, anchor: Anchor) -> Item {
    let formula = formula_in(text);
    let (text, math) = (formula.unwrap_or(text).to_owned(), formula.is_some());
    Item::Label(Label { at, offset: DVec2::ZERO, text, size, color, anchor, math })
}

/// Width in pt of such a text.
pub(crate) fn label_width(text: &str, size: f64) -> f64 {
    let formula = formula_in(text).and_then(|source| formula::layout(source, size).ok());
    formula.map_or_else(|| text_width(FontFace::Regular, text, size), |layout| layout.width)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: DVec2 = DVec2::new(400.0, 300.0);

    fn series(points: Vec<DVec2>, style: SeriesStyle) -> Series {
        Series { name: "error".to_owned(), color: Color::hex(0x12_34_56), points, style }
    }

    fn lines_of(picture: &Picture, layer: &str) -> Vec<usize> {
        let items = picture.layers.iter().filter(|found| found.name == layer).flat_map(|found| &found.items);
        items
            .filter_map(|item| if let Item::Path(path) = item { Some(path.segments.len()) } else { None })
            .collect()
    }

    fn labels_of(picture: &Picture) -> Vec<&str> {
        let items = picture.layers.iter().flat_map(|layer| &layer.items);
        items
            .filter_map(|item| if let Item::Label(label) = item { Some(label.text.as_str()) } else { None })
            .collect()
    }

    #[test]
    fn powers_of_ten_are_labelled_and_lines_stop_at_what_has_no_place() {
        let points = [1e-1, 1e-3, 0.0, 1e-5, 1e-7].iter().enumerate();
        let points = points.map(|(k, &error)| DVec2::new(k as f64, error)).collect();
        let y = Axis { label: "error".to_owned(), scale: AxisScale::Logarithmic, range: None };
        let series = vec![series(points, SeriesStyle::Line)];
        let chart = Chart { title: "Convergence".to_owned(), x: Axis::default(), y, series };
        let picture = chart.to_picture(&Theme::light(), SIZE);
        assert_eq!(lines_of(&picture, "series: error"), [2, 2], "a gap at the error 0");
        let labels = labels_of(&picture);
        for label in ["Convergence", "error", "10^{−7}", "10^{−1}", "0", "4"] {
            assert!(labels.contains(&label), "{label} is missing in {labels:?}");
        }
    }

    #[test]
    fn straight_data_become_straight_lines_inside_the_frame() {
        let points: Vec<DVec2> = (0..=10).map(|k| DVec2::new(f64::from(k), 2.0 * f64::from(k))).collect();
        let range = Some((2.5, 7.5));
        let x = Axis { range, ..Axis::default() };
        let chart = Chart { x, series: vec![series(points, SeriesStyle::LineWithMarks)], ..Chart::default() };
        let picture = chart.to_picture(&Theme::dark(), SIZE);
        assert_eq!(lines_of(&picture, "series: error"), [7], "from 2.5 over 3, 4, 5, 6, 7 to 7.5");
        let marks = picture.layers.iter().flat_map(|layer| &layer.items);
        assert_eq!(marks.filter(|item| matches!(item, Item::Marker(_))).count(), 5, "marks at 3, 4, 5, 6, 7");
    }

    /// The boxes of all texts of a chart on its page: left, lower, right, upper.
    fn boxes(picture: &Picture) -> Vec<(String, [f64; 4])> {
        let labels =
            picture.layers.iter().filter(|layer| layer.name == "text").flat_map(|layer| &layer.items);
        labels
            .filter_map(|item| {
                let Item::Label(label) = item else { return None };
                let words = if label.math { format!("${}$", label.text) } else { label.text.clone() };
                let width = label_width(&words, label.size);
                let left = label.at.x - label.anchor.part_before() * width;
                let (low, high) = (label.at.y - 0.2 * label.size, label.at.y + 0.75 * label.size);
                Some((words, [left, low, left + width, high]))
            })
            .collect()
    }

    #[test]
    fn all_ranges_have_three_numbers_on_both_axes_that_neither_touch_nor_leave_the_page() {
        let sizes = [(480.0, 300.0), (420.0, 130.0), (1300.0, 160.0)].map(DVec2::from);
        let mut ranges = vec![(0.5, 0.5), (0.0, 0.0), (-7.0, -7.0), (1e6, 1e6), (-1.9, 3.3), (99.0, 101.0)];
        for power in -6..=6 {
            let unit = 10f64.powi(power);
            ranges.extend([
                (0.0, unit),
                (-unit, 0.3 * unit),
                (-1.234 * unit, 5.678 * unit),
                (-9.0 * unit, -unit),
            ]);
        }
        for (theme, size) in
            Theme::all().into_iter().flat_map(|theme| sizes.map(|size| (theme.clone(), size)))
        {
            let size = size * DVec2::new(1.0, theme.text_scale);
            for &(low, high) in &ranges {
                let points = vec![DVec2::new(low, low), DVec2::new(high, high)];
                let axis = |label: &str| Axis { label: label.to_owned(), ..Axis::default() };
                let y = axis(
                    "Curvature of a curve with a name that is so long that nobody wants to read all of it, but still",
                );
                let chart = Chart {
                    x: axis("parameter t"),
                    y,
                    series: vec![series(points, SeriesStyle::Line)],
                    title: String::new(),
                };
                let boxes = boxes(&chart.to_picture(&theme, size));
                let area = chart.area(&theme, size);
                let below =
                    boxes.iter().filter(|(_, found)| found[3] < area.low.y && found[1] > 16.0).count();
                let beside =
                    boxes.iter().filter(|(_, found)| found[2] < area.low.x && found[3] > area.low.y).count();
                let told = format!("[{low}, {high}] on {size}, {}: {boxes:?}", theme.name);
                assert!(below >= 3 && beside >= 3, "{below} below, {beside} beside, {told}");
                for (k, (words, found)) in boxes.iter().enumerate() {
                    let [left, lower, right, upper] = *found;
                    assert!(
                        left >= 0.0 && lower >= 0.0 && right <= size.x && upper <= size.y,
                        "{words} leaves {told}"
                    );
                    for (other, taken) in &boxes[..k] {
                        let apart =
                            left >= taken[2] || taken[0] >= right || lower >= taken[3] || taken[1] >= upper;
                        assert!(apart, "{words} touches {other}, {told}");
                    }
                }
            }
        }
    }

    #[test]
    fn less_than_a_decade_is_labelled_with_numbers() {
        for (low, high) in [(2.0, 7.0), (0.02, 0.3), (1e-5, 3e-5), (5.0, 150.0)] {
            let points = vec![DVec2::new(0.0, low), DVec2::new(1.0, high)];
            let y = Axis { scale: AxisScale::Logarithmic, ..Axis::default() };
            let chart = Chart { y, series: vec![series(points, SeriesStyle::Line)], ..Chart::default() };
            let plot = chart.plot(&Theme::light(), SIZE);
            assert!(plot.y_ticks.len() >= 3, "[{low}, {high}]: {:?}", plot.y_ticks);
        }
    }

    #[test]
    fn charts_without_sense_are_drawn() {
        let strange =
            [vec![], vec![DVec2::NAN], vec![DVec2::splat(1e308), DVec2::splat(-1e308)], vec![DVec2::ONE]];
        for points in strange {
            for scale in [AxisScale::Linear, AxisScale::Logarithmic] {
                for range in [None, Some((1.0, 1.0)), Some((f64::NAN, -1.0)), Some((1e-300, 1e300))] {
                    let axis = Axis { label: r"$\wrong$".to_owned(), scale, range };
                    let series = vec![series(points.clone(), SeriesStyle::LineWithMarks); 2];
                    let chart = Chart { title: String::new(), x: axis.clone(), y: axis, series };
                    for size in [SIZE, DVec2::ZERO, DVec2::splat(10.0)] {
                        let picture = chart.to_picture(&Theme::light(), size);
                        assert!(picture.layers.len() < 10, "{} layers", picture.layers.len());
                    }
                }
            }
        }
    }
}
