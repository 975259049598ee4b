//! Curvature, speed, coordinates and B-splines of a curve over its parameter or its arc length, as a chart and as a table.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::point::Point as _;
use crate::core::spline_curve::{ArcLength, Nurbs};
use crate::figure::chart::{Axis, Chart, Series, SeriesStyle};
use crate::figure::theme::Theme;

/// Samples of one knot interval, and about how many there are at most of all together.
const SAMPLES: (usize, usize) = (48, 6000);
/// Curves with more control points are not measured along: it would take longer than a frame.
pub const MANY_FOR_LENGTH: usize = 2000;
/// More B-splines than this are not drawn: they would be a grey band.
pub const MANY_FUNCTIONS: usize = 300;
/// The error of lengths, as a part of the size of the control polygon.
const LENGTH_TOLERANCE: f64 = 1e-8;

/// Values that differ by less, as a part of themselves or of their unit, are one value and rounding.
const FLAT: f64 = 1e-8;

/// What is drawn upwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// The signed curvature, positive in left turns.
    #[default]
    Curvature,
    /// `|r′|`.
    Speed,
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The B-splines, or the rational basis functions `wₖ bₖ/q`.
    Basis,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Curvature, Self::Speed, Self::X, Self::Y, Self::Basis];

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Curvature => "Curvature",
            Self::Speed => "Speed",
            Self::X => "x",
            Self::Y => "y",
            Self::Basis => "B-splines",
        }
    }

    /// What stands at its axis.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Curvature => "Curvature κ",
            Self::Speed => "Speed |r′|",
            other => other.name(),
        }
    }

    /// Its sign.
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Curvature => "κ",
            Self::Speed => "|r′|",
            Self::X => "x",
            Self::Y => "y",
            Self::Basis => "b",
        }
    }

    /// Its value at a sample; of the B-splines, which are many, not a number.
    pub fn of(self, sample: &Sample) -> f64 {
        match self {
            Self::Curvature => sample.curvature,
            Self::Speed => sample.speed,
            Self::X => sample.point.x,
            Self::Y => sample.point.y,
            Self::Basis => f64::NAN,
        }
    }
}

/// What there is at one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The parameter.
    pub parameter: f64,
    /// The arc length from the start, if it is measured.
    pub length: Option<f64>,
    /// The point.
    pub point: DVec2,
    /// `|r′|`.
    pub speed: f64,
    /// The signed curvature; not a number where the speed is 0.
    pub curvature: f64,
}

/// A curve sampled over each knot interval.
#[derive(Clone, Debug)]
pub struct CurveSamples {
    curve: Nurbs<DVec2>,
    length: Result<ArcLength<DVec2>, String>,
    /// One part for each knot interval; at its ends the limits from inside.
    parts: Vec<Vec<Sample>>,
}

impl CurveSamples {
    /// Samples `curve`.
    pub fn new(curve: &Nurbs<DVec2>) -> Self {
        let breaks = curve.space().breaks();
        let count = (SAMPLES.1 / breaks.len()).clamp(2, SAMPLES.0);
        let mut samples =
            Self { curve: curve.clone(), length: arc_length(curve), parts: Vec::with_capacity(breaks.len()) };
        for ends in breaks.windows(2) {
            let at = |i: usize| {
                let side = if i == 0 { Side::Right } else { Side::Left };
                samples.sample(ends[0].mix(ends[1], i as f64 / count as f64), side)
            };
            let part = (0..=count).filter_map(at).collect();
            samples.parts.push(part);
        }
        samples
    }

    /// What there is at `parameter`, from `side` at a knot; `None` outside D.
    pub fn sample(&self, parameter: f64, side: Side) -> Option<Sample> {
        let values = self.curve.derivatives(parameter, 2, side).ok()?;
        let (point, first, second) = (values[0], values[1], values[2]);
        let speed = first.length();
        // Dividing step by step: |r′|³ under- and overflows long before the curvature does.
        let curvature = (first / speed).perp_dot(second) / speed / speed;
        let (left, right) = self.curve.space().parameter_interval();
        let length = self.length.as_ref().ok().and_then(|length| match parameter {
            // The right end of a closed curve is a period further, not its start.
            t if t >= right => Some(length.total()),
            t => length.at(t.max(left)).ok(),
        });
        Some(Sample { parameter, length, point, speed, curvature })
    }

    /// The samples over each knot interval.
    pub fn parts(&self) -> &[Vec<Sample>] {
        &self.parts
    }

    /// The arc length, or a sentence that says why it is not measured.
    pub fn length(&self) -> Result<&ArcLength<DVec2>, &str> {
        self.length.as_ref().map_err(String::as_str)
    }

    /// Whether the B-splines are few enough to be seen.
    pub fn has_basis(&self) -> bool {
        self.curve.points().len() <= MANY_FUNCTIONS
    }

    /// The chart of `quantity` of the curve `name`, over the arc length if that is wanted and measured; the curve has the colour `color` of the
    /// palette, B-splines those of their control points.
    pub fn chart(
        &self,
        quantity: Quantity,
        over_length: bool,
        name: &str,
        color: usize,
        theme: &Theme,
    ) -> Chart {
        let over_length = over_length && self.length.is_ok();
        let x = |sample: &Sample| {
            if over_length { sample.length.unwrap_or(f64::NAN) } else { sample.parameter }
        };
        let line = |color, points| Series { name: String::new(), color, points, style: SeriesStyle::Line };
        let (series, y) = if quantity == Quantity::Basis {
            let lines = self.basis_lines(x).into_iter().enumerate();
            let series = lines.map(|(k, points)| line(theme.basis_color(k), points));
            (series.collect(), Some((0.0, 1.02)))
        } else {
            let points = self.line(|sample| DVec2::new(x(sample), quantity.of(sample)));
            let range = flat_range(&points, self.unit(quantity)).or_else(|| level_range(&points));
            (vec![line(theme.palette[color % theme.palette.len()], points)], range)
        };
        let (low, high) = if over_length {
            (0.0, self.length.as_ref().map_or(1.0, ArcLength::total))
        } else {
            self.curve.space().parameter_interval()
        };
        let label = if over_length { "arc length s" } else { "parameter t" }.to_owned();
        Chart {
            title: String::new(),
            x: Axis { label, range: Some((low, high)), ..Axis::default() },
            y: Axis { label: format!("{} of {name}", quantity.label()), range: y, ..Axis::default() },
            series,
        }
    }

    /// What counts as 1 of `quantity` for a curve of this size over this interval.
    fn unit(&self, quantity: Quantity) -> f64 {
        let samples = || self.parts.iter().flatten();
        let (low, high) = samples().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), sample| {
            (low.min(sample.point), high.max(sample.point))
        });
        let size = (high - low).max_element();
        match quantity {
            Quantity::Curvature => size.recip(),
            Quantity::Speed => samples().map(|sample| sample.speed).fold(0.0, f64::max),
            Quantity::X | Quantity::Y => size,
            Quantity::Basis => 1.0,
        }
    }

    /// One line through all samples, interrupted where its height jumps.
    fn line(&self, place: impl Fn(&Sample) -> DVec2) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = Vec::new();
        for part in &self.parts {
            if let (Some(last), Some(first)) = (points.last(), part.first().map(&place))
                && (last.y - first.y).abs() > 1e-9 * last.y.abs().max(first.y.abs())
            {
                points.push(DVec2::NAN);
            }
            points.extend(part.iter().map(&place));
        }
        points
    }

    /// Control points and values of the functions over the knot interval of `sample`, which starts at `start`; at its right end too.
    fn basis_values(&self, start: f64, sample: &Sample) -> Vec<(usize, f64)> {
        let (space, weights) = (self.curve.space(), self.curve.weights());
        let mut values = vec![0.0; space.degree() + 1];
        let Ok(span) = space.span(start) else { return Vec::new() };
        let Ok(first) = space.write_active_basis(sample.parameter, &mut values) else { return Vec::new() };
        let found: Vec<(usize, f64)> = values
            .iter()
            .enumerate()
            .map(|(j, value)| (space.coefficient_index(first + j), value))
            .map(|(k, value)| (k, value * weights[k]))
            .collect();
        let sum: f64 = found.iter().map(|(_, value)| value).sum();
        let mut active: Vec<usize> =
            (span - space.degree()..=span).map(|k| space.coefficient_index(k)).collect();
        active.sort_unstable();
        active.dedup();
        let value_of =
            |k: usize| found.iter().filter(|(other, _)| *other == k).map(|(_, value)| value).sum::<f64>();
        active.into_iter().map(|k| (k, value_of(k) / sum)).collect()
    }

    /// For each control point the line of its function, where that is not 0. None if they are too many.
    fn basis_lines(&self, x: impl Fn(&Sample) -> f64) -> Vec<Vec<DVec2>> {
        let mut lines: Vec<Vec<DVec2>> = vec![Vec::new(); self.curve.points().len()];
        let mut last_part: Vec<Option<usize>> = vec![None; lines.len()];
        for (number, part) in self.parts.iter().enumerate().filter(|_| self.has_basis()) {
            for sample in part {
                for (k, value) in self.basis_values(part[0].parameter, sample) {
                    if last_part[k].is_some_and(|last| last + 1 < number) {
                        lines[k].push(DVec2::NAN);
                    }
                    last_part[k] = Some(number);
                    lines[k].push(DVec2::new(x(sample), value));
                }
            }
        }
        lines
    }

    /// A table; commas separate, points are decimal signs. Its columns are t, s if that is measured, and x, y, speed, curvature, or the B-splines. A knot
    /// has two lines, the limits from both sides.
    pub fn csv(&self, quantity: Quantity) -> String {
        let has_length = self.length.is_ok();
        let mut text = String::from(if has_length { "t,s" } else { "t" });
        let count = if self.has_basis() { self.curve.points().len() } else { 0 };
        if quantity == Quantity::Basis {
            (0..count).for_each(|k| text.push_str(&format!(",b_{k}")));
        } else {
            text.push_str(",x,y,speed,curvature");
        }
        text.push('\n');
        for (start, sample) in self.parts.iter().flat_map(|part| part.iter().map(|s| (part[0].parameter, s)))
        {
            let Sample { parameter, length, point, speed, curvature } = sample;
            text.push_str(&format!("{parameter:?}"));
            if let Some(length) = length.filter(|_| has_length) {
                text.push_str(&format!(",{length:?}"));
            }
            if quantity == Quantity::Basis {
                let mut row = vec![0.0; count];
                if count > 0 {
                    self.basis_values(start, sample).into_iter().for_each(|(k, value)| row[k] = value);
                }
                row.iter().for_each(|value| text.push_str(&format!(",{value:?}")));
            } else {
                // Where there is no curvature the field stays empty.
                let curvature = if curvature.is_finite() { format!("{curvature:?}") } else { String::new() };
                text.push_str(&format!(",{:?},{:?},{speed:?},{curvature}", point.x, point.y));
            }
            text.push('\n');
        }
        text
    }
}

/// The arc length of `curve`, or a sentence that says why it is not measured.
pub fn arc_length(curve: &Nurbs<DVec2>) -> Result<ArcLength<DVec2>, String> {
    let count = curve.points().len();
    if count > MANY_FOR_LENGTH {
        return Err(format!("not measured for more than {MANY_FOR_LENGTH} control points"));
    }
    let first = curve.points()[0];
    let size = curve.points().iter().map(|&point| (point - first).norm()).fold(0.0, f64::max);
    let tolerance = (LENGTH_TOLERANCE * size).max(f64::MIN_POSITIVE);
    ArcLength::new(curve, tolerance).map_err(|error| error.to_string())
}

/// A range around values that differ by rounding only, measured by the `unit` of their quantity; `None` for others.
fn flat_range(points: &[DVec2], unit: f64) -> Option<(f64, f64)> {
    let values = points.iter().map(|point| point.y).filter(|y| y.is_finite());
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let (size, unit) = (low.abs().max(high.abs()), if unit.is_finite() { unit } else { 1.0 });
    if !(low <= high && high - low <= FLAT * size.max(unit)) {
        return None;
    }
    // Around 0 the unit tells how far.
    let (middle, reach) = if size <= FLAT * unit { (0.0, unit) } else { (low.midpoint(high), 0.5 * size) };
    (reach > 0.0).then_some((middle - reach, middle + reach))
}

/// A range that a few extreme values, such as curvatures near a cusp, do not fill; `None` if the chart finds its own.
fn level_range(points: &[DVec2]) -> Option<(f64, f64)> {
    let mut values: Vec<f64> = points.iter().map(|point| point.y).filter(|y| y.is_finite()).collect();
    if values.len() < 20 {
        return None;
    }
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    let (low, high) = (at(0.02), at(0.98));
    let (least, most) = (values[0], values[values.len() - 1]);
    let room = (high - low).max(1e-9 * most.abs().max(least.abs()));
    // Only values far away are cut off.
    let range = (least.max(low - 6.0 * room), most.min(high + 6.0 * room));
    let is_cut = range.0 > least || range.1 < most;
    is_cut.then_some(range)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::SplineSpace;

    #[test]
    fn a_circle_has_one_curvature_and_its_length_along_the_axis() {
        let circle = Nurbs::circle(DVec2::new(1.0, 2.0), 2.0).unwrap();
        let samples = CurveSamples::new(&circle);
        for sample in samples.parts().iter().flatten() {
            assert!((sample.curvature - 0.5).abs() < 1e-9, "{sample:?}");
        }
        let chart = samples.chart(Quantity::Curvature, true, "C", 0, &Theme::light());
        let (_, end) = chart.x.range.unwrap();
        assert!((end - 4.0 * std::f64::consts::PI).abs() < 1e-6, "length {end}");
        let last = samples.parts().last().unwrap().last().unwrap();
        assert_eq!(last.length, Some(samples.length().unwrap().total()), "the end is not the start");
    }

    #[test]
    fn a_constant_is_level_whatever_its_rounding() {
        let ends = |curve: &Nurbs<DVec2>, quantity| {
            let chart = CurveSamples::new(curve).chart(quantity, false, "C", 0, &Theme::light());
            chart.y.range.unwrap()
        };
        let (low, high) = ends(&Nurbs::circle(DVec2::new(1e3, 2.0), 4.0).unwrap(), Quantity::Curvature);
        assert!((low - 0.125).abs() < 1e-6 && (high - 0.375).abs() < 1e-6, "1/4 between {low} and {high}");
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let points = [0.1, 0.2, 0.7, 0.8].map(|x| DVec2::new(x, 0.3 * x)).to_vec();
        let line = Nurbs::polynomial(space, points).unwrap();
        let (low, high) = ends(&line, Quantity::Curvature);
        assert!(low < -1.0 && high > 1.0, "a straight line has no curvature worth a number: {low} to {high}");
    }

    #[test]
    fn the_curvature_of_a_quadratic_is_interrupted_at_its_knot_and_the_table_has_both_limits() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, -1.0)].map(DVec2::from).to_vec();
        let samples = CurveSamples::new(&Nurbs::polynomial(space, points).unwrap());
        let gaps = |quantity| {
            let chart = samples.chart(quantity, false, "C", 0, &Theme::light());
            chart.series[0].points.iter().filter(|point| point.x.is_nan()).count()
        };
        assert_eq!((gaps(Quantity::Curvature), gaps(Quantity::Speed), gaps(Quantity::X)), (1, 0, 0), "jumps");
        let at_knot: Vec<String> = samples
            .csv(Quantity::X)
            .lines()
            .filter(|line| line.starts_with("1.0,"))
            .map(str::to_owned)
            .collect();
        assert_eq!(at_knot.len(), 2, "limits from both sides: {at_knot:?}");
    }

    #[test]
    fn a_very_long_curve_is_charted_over_t_only() {
        let count = 10_000;
        let space = SplineSpace::new(3, (0..count + 4).map(f64::from).collect()).unwrap();
        let points = (0..count).map(|k| DVec2::new(f64::from(k), f64::from(k % 3))).collect();
        let samples = CurveSamples::new(&Nurbs::polynomial(space, points).unwrap());
        assert!(samples.length().unwrap_err().contains("2000"), "a sentence with the limit");
        let chart = samples.chart(Quantity::Speed, true, "C", 0, &Theme::light());
        assert_eq!(chart.x.label, "parameter t", "over t instead");
        assert!(chart.series[0].points.len() < 40_000, "{} points", chart.series[0].points.len());
    }

    #[test]
    fn basis_functions_are_a_partition_of_one_in_chart_and_table() {
        let closed = SplineSpace::periodic(2, 5.0, (0..5).map(f64::from).collect()).unwrap();
        let open = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        for space in [open, closed] {
            let points: Vec<DVec2> = (0..space.dimension()).map(|k| DVec2::new(k as f64, 1.0)).collect();
            let weights = (0..points.len()).map(|k| 1.0 + k as f64).collect();
            let samples = CurveSamples::new(&Nurbs::new(space, points.clone(), weights).unwrap());
            let chart = samples.chart(Quantity::Basis, false, "C", 0, &Theme::light());
            assert_eq!(chart.series.len(), points.len(), "one for each control point");
            let table = samples.csv(Quantity::Basis);
            for line in table.lines().skip(1) {
                let values: Vec<f64> = line.split(',').skip(2).map(|field| field.parse().unwrap()).collect();
                let sum: f64 = values.iter().sum();
                assert!(values.len() == points.len() && (sum - 1.0).abs() < 1e-12, "{line}");
            }
        }
    }
}
