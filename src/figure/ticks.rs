//! Round numbers along an axis, and the grid of a view.
//!
//! Steps are 1, 2 or 5 times a power of 10. Ticks are counted in whole numbers and written from them, so that labels are
//! exact decimals at any zoom.

use glam::DVec2;

use crate::figure::picture::{Anchor, Item, Label, Path, Viewport};
use crate::figure::theme::Theme;

/// More ticks than this are not made.
const MOST_TICKS: i64 = 2000;
/// Ticks further from 0 than so many steps are not made: numbers there are further apart than ticks.
const FARTHEST_TICK: f64 = 4e15;
/// Least distance of labelled grid lines on the page in pt.
const MAJOR_SPACING: f64 = 70.0;
/// Type size of grid labels in pt.
const LABEL_SIZE: f64 = 9.0;
/// Fewer labels along an axis do not tell what it shows.
const FEWEST_LABELS: usize = 3;
/// So many steps, each finer than the one before, reach from a whole axis to less than a hundredth of it.
const STEPS_OF_AXIS: usize = 8;

/// A round distance: 1, 2 or 5 times a power of 10.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    mantissa: i64,
    exponent: i32,
}

/// A place on an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where.
    pub value: f64,
    /// The number as text: `0.3`, `-20`, `1.5e-9`.
    pub label: String,
}

impl Step {
    /// The smallest round distance that is not below `least`; `None` unless that is between 1e-290 and 1e290.
    pub fn at_least(least: f64) -> Option<Self> {
        if !(1e-290..=1e290).contains(&least) {
            return None;
        }
        let start = least.log10().floor() as i32 - 1;
        let steps =
            (start..start + 4).flat_map(|exponent| [1, 2, 5].map(|mantissa| Self { mantissa, exponent }));
        steps.into_iter().find(|step| step.size() >= least * (1.0 - 1e-12))
    }

    /// The distance.
    pub fn size(self) -> f64 {
        decimal(self.mantissa, self.exponent)
    }

    /// A fifth of a step (a quarter of 2·10ᵏ): the distance of the unlabelled lines between.
    #[must_use]
    pub const fn finer(self) -> Self {
        match self.mantissa {
            1 => Self { mantissa: 2, exponent: self.exponent - 1 },
            2 => Self { mantissa: 5, exponent: self.exponent - 1 },
            _ => Self { mantissa: 1, exponent: self.exponent },
        }
    }

    /// The next smaller round distance.
    const fn next_finer(self) -> Self {
        match self.mantissa {
            5 => Self { mantissa: 2, ..self },
            2 => Self { mantissa: 1, ..self },
            _ => Self { mantissa: 5, exponent: self.exponent - 1 },
        }
    }

    /// The multiples of the step between `low` and `high`, ends included; none if there would be more than 2000, or if the
    /// numbers cannot tell them apart.
    pub fn ticks_between(self, low: f64, high: f64) -> Vec<Tick> {
        let size = self.size();
        // A tick at the very end must not be lost to rounding.
        let slack = 1e-9;
        let (first, last) = ((low / size - slack).ceil(), (high / size + slack).floor());
        let is_possible = first.abs() < FARTHEST_TICK && last.abs() < FARTHEST_TICK;
        if !is_possible || last - first >= MOST_TICKS as f64 {
            return Vec::new();
        }
        (first as i64..=last as i64)
            .map(|index| {
                let digits = index * self.mantissa;
                Tick { value: decimal(digits, self.exponent), label: decimal_text(digits, self.exponent) }
            })
            .collect()
    }
}

/// `digits · 10^exponent`, rounded once as long as the power is exact.
fn decimal(digits: i64, exponent: i32) -> f64 {
    if exponent < -22 {
        // The parser of the standard library rounds correctly.
        return format!("{digits}e{exponent}").parse().unwrap_or(f64::NAN);
    }
    if exponent < 0 { digits as f64 / 10f64.powi(-exponent) } else { digits as f64 * 10f64.powi(exponent) }
}

fn decimal_text(digits: i64, exponent: i32) -> String {
    if digits == 0 {
        return "0".to_owned();
    }
    let sign = if digits < 0 { "−" } else { "" };
    let mut number = digits.unsigned_abs();
    let mut exponent = exponent;
    while number.is_multiple_of(10) {
        number /= 10;
        exponent += 1;
    }
    let number = number.to_string();
    // The number is 0.d₁d₂… times 10 to this power.
    let power = number.len() as i32 + exponent;
    if exponent >= 0 && power <= 7 {
        return format!("{sign}{number}{}", "0".repeat(exponent as usize));
    }
    if exponent < 0 && power > 0 {
        let (whole, part) = number.split_at(power as usize);
        return format!("{sign}{whole}.{part}");
    }
    if exponent < 0 && power > -5 {
        return format!("{sign}0.{}{number}", "0".repeat(-power as usize));
    }
    let (whole, part) = number.split_at(1);
    let point = if part.is_empty() { "" } else { "." };
    format!("{sign}{whole}{point}{part}e{}", power - 1)
}

/// Ticks of an axis that shows `[low, high]` on `length` pt, `extent` giving the room in pt that a label takes along it.
///
/// The step is the smallest round one with ticks at least `spacing` pt apart whose labels do not touch, or a smaller one if that has fewer than 3
/// ticks. If not even 3 labels have room beside each other, some ticks have an empty label. None if the numbers cannot be told apart.
pub fn axis_ticks(
    (low, high): (f64, f64),
    length: f64,
    spacing: f64,
    extent: impl Fn(&str) -> f64,
) -> Vec<Tick> {
    let mut step = Step::at_least(high - low);
    let mut enough: Option<Vec<Tick>> = None;
    let mut chosen: Option<Vec<Tick>> = None;
    for _ in 0..STEPS_OF_AXIS {
        let Some(now) = step else { break };
        let ticks = now.ticks_between(low, high);
        let distance = now.size() / (high - low) * length;
        let fits = ticks.iter().all(|tick| extent(&tick.label) <= distance);
        if ticks.len() >= FEWEST_LABELS {
            enough.get_or_insert_with(|| ticks.clone());
            if fits && (chosen.is_none() || distance >= spacing) {
                chosen = Some(ticks);
            }
        }
        step = Some(now.next_finer());
    }
    chosen.or_else(|| enough.map(|ticks| thinned(ticks, (high - low) / length, extent))).unwrap_or_default()
}

/// Leaves labels only where they have room, `unit` per pt: first the last, then the first, then those between.
fn thinned(mut ticks: Vec<Tick>, unit: f64, extent: impl Fn(&str) -> f64) -> Vec<Tick> {
    let count = ticks.len();
    let mut kept: Vec<usize> = Vec::new();
    for index in [count - 1, 0, count / 2].into_iter().chain(1..count) {
        let room = |other: usize| {
            let least = 0.5 * (extent(&ticks[index].label) + extent(&ticks[other].label));
            (ticks[index].value - ticks[other].value).abs() >= least * unit
        };
        if kept.iter().all(|&other| room(other)) {
            kept.push(index);
        }
    }
    for (index, tick) in ticks.iter_mut().enumerate() {
        if !kept.contains(&index) {
            tick.label.clear();
        }
    }
    ticks
}

/// The round step of the labelled grid lines of a view.
pub fn grid_step(view: &Viewport) -> Option<Step> {
    Step::at_least(MAJOR_SPACING / view.scale)
}

/// Grid lines over the whole view, fine ones first, then those that carry labels, then the two axes.
pub fn grid_lines(view: &Viewport, theme: &Theme) -> Vec<Item> {
    let Some(major) = grid_step(view) else { return Vec::new() };
    let (low, high) = corners(view);
    let mut items = Vec::new();
    for (step, color, width) in [(major.finer(), theme.grid, 0.5), (major, theme.grid_major, 0.75)] {
        let stroke = theme.stroke(color, width);
        for x in step.ticks_between(low.x, high.x) {
            let ends = [DVec2::new(x.value, low.y), DVec2::new(x.value, high.y)];
            items.push(Item::Path(Path::polyline(&ends, stroke.clone())));
        }
        for y in step.ticks_between(low.y, high.y) {
            let ends = [DVec2::new(low.x, y.value), DVec2::new(high.x, y.value)];
            items.push(Item::Path(Path::polyline(&ends, stroke.clone())));
        }
    }
    let axis = theme.stroke(theme.axis, 0.75);
    if low.x <= 0.0 && high.x >= 0.0 {
        items.push(Item::Path(Path::polyline(
            &[DVec2::new(0.0, low.y), DVec2::new(0.0, high.y)],
            axis.clone(),
        )));
    }
    if low.y <= 0.0 && high.y >= 0.0 {
        items.push(Item::Path(Path::polyline(&[DVec2::new(low.x, 0.0), DVec2::new(high.x, 0.0)], axis)));
    }
    items
}

/// The numbers at the labelled grid lines, along the lower and the left edge of the view.
pub fn grid_labels(view: &Viewport, theme: &Theme) -> Vec<Item> {
    let Some(major) = grid_step(view) else { return Vec::new() };
    let (low, high) = corners(view);
    let size = LABEL_SIZE * theme.text_scale;
    let label = |at: DVec2, offset: DVec2, text: String| {
        let (color, anchor) = (theme.muted_text, Anchor::Start);
        Item::Label(Label { at, offset, text, size, color, anchor, math: false })
    };
    // Labels that would stand in the corner are left out.
    let corner = DVec2::new(4.0 * size, 2.0 * size) / view.scale;
    let along_x = major.ticks_between(low.x + corner.x, high.x);
    let along_y = major.ticks_between(low.y + corner.y, high.y);
    along_x
        .into_iter()
        .map(|tick| label(DVec2::new(tick.value, low.y), DVec2::new(3.0, 4.0), tick.label))
        .chain(
            along_y
                .into_iter()
                .map(|tick| label(DVec2::new(low.x, tick.value), DVec2::new(4.0, 3.0), tick.label)),
        )
        .collect()
}

fn corners(view: &Viewport) -> (DVec2, DVec2) {
    let half = view.size * 0.5 / view.scale;
    (view.center - half, view.center + half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(least: f64, low: f64, high: f64) -> Vec<String> {
        Step::at_least(least).unwrap().ticks_between(low, high).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn steps_are_round_and_not_too_small() {
        for (least, size) in [
            (1.0, 1.0),
            (1.1, 2.0),
            (2.0, 2.0),
            (3.0, 5.0),
            (5.1, 10.0),
            (0.07, 0.1),
            (0.1, 0.1),
            (1e-9, 1e-9),
        ] {
            let step = Step::at_least(least).unwrap();
            assert_eq!(step.size(), size, "least {least}");
        }
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
            assert_eq!(Step::at_least(bad), None, "{bad}");
        }
    }

    #[test]
    fn labels_are_exact_decimals() {
        assert_eq!(labels(0.1, -0.2, 0.31), ["−0.2", "−0.1", "0", "0.1", "0.2", "0.3"], "tenths");
        assert_eq!(labels(0.2, 0.9, 1.4), ["1", "1.2", "1.4"], "the right end counts");
        assert_eq!(labels(500.0, 0.0, 1000.0), ["0", "500", "1000"], "hundreds");
        assert_eq!(labels(5e-9, 0.0, 1.1e-8), ["0", "5e-9", "1e-8"], "very small");
        assert_eq!(labels(2e9, 1e9, 5e9), ["2e9", "4e9"], "very large");
        assert_eq!(labels(0.001, 12.3449, 12.3461), ["12.345", "12.346"], "far from 0");
    }

    #[test]
    fn values_are_the_numbers_of_the_labels() {
        for power in -40..40 {
            let least = 10f64.powi(power);
            for tick in Step::at_least(least).unwrap().ticks_between(-30.0 * least, 30.0 * least) {
                let number: f64 = tick.label.replace('−', "-").parse().unwrap();
                let error = (number - tick.value).abs();
                assert!(error <= 1e-15 * number.abs(), "{} is not {:e}", tick.label, tick.value);
            }
        }
    }

    #[test]
    fn every_axis_has_three_labels_that_do_not_touch() {
        let extent = |label: &str| 6.0 * label.chars().count() as f64 + 8.0;
        for power in -6..=6 {
            for (low, high) in
                [(0.0, 1.0), (-1.9, 3.3), (-1.0, 1.0), (0.0, 4.0), (0.51, 1.49), (-9.9, -2.2), (9.9, 10.3)]
            {
                let unit = 10f64.powi(power);
                let (low, high) = (low * unit, high * unit);
                for length in [260.0, 480.0, 1500.0] {
                    let ticks = axis_ticks((low, high), length, 60.0, extent);
                    assert!((3..=26).contains(&ticks.len()), "[{low}, {high}] on {length} pt: {ticks:?}");
                    for pair in ticks.windows(2) {
                        let distance = (pair[1].value - pair[0].value) / (high - low) * length;
                        let room = 0.5 * (extent(&pair[0].label) + extent(&pair[1].label));
                        assert!(room <= distance + 1e-9, "{pair:?} on {length} pt");
                    }
                }
                // A low chart: type of 9 pt on 80 pt.
                let upright = axis_ticks((low, high), 80.0, 32.0, |_| 11.0);
                let labels = upright.iter().filter(|tick| !tick.label.is_empty()).count();
                assert!(labels >= 3, "[{low}, {high}] upright: {upright:?}");
            }
        }
    }

    #[test]
    fn where_three_labels_have_no_room_the_ends_keep_theirs() {
        let ticks = axis_ticks((0.0, 4.0), 30.0, 32.0, |_| 12.0);
        let labels: Vec<&str> = ticks.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, ["0", "2", "4"], "15 pt from one to the next");
        let ticks = axis_ticks((0.0, 4.0), 20.0, 32.0, |_| 12.0);
        let labels: Vec<&str> = ticks.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, ["0", "", "4"], "10 pt from one to the next");
        for bad in [(0.0, 0.0), (1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (1.0, 1.0 + 1e-16)] {
            assert_eq!(axis_ticks(bad, 100.0, 30.0, |_| 10.0), [], "{bad:?}");
        }
    }

    #[test]
    fn fine_lines_divide_the_labelled_ones() {
        for (least, parts) in [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0)] {
            let step = Step::at_least(least).unwrap();
            let found = step.size() / step.finer().size();
            assert!((found - parts).abs() < 1e-12, "{least} into {found}");
        }
    }

    #[test]
    fn impossible_zooms_have_no_grid() {
        let size = DVec2::new(800.0, 600.0);
        for (scale, center) in
            [(1e300, 0.0), (1e-300, 0.0), (f64::NAN, 0.0), (1e6, 1e18), (1.0, f64::INFINITY)]
        {
            let view = Viewport { center: DVec2::splat(center), scale, size };
            let lines = grid_lines(&view, &Theme::light());
            assert!(lines.len() < 200, "{} lines at scale {scale} around {center}", lines.len());
        }
        let view = Viewport { center: DVec2::ZERO, scale: 100.0, size };
        assert!(grid_lines(&view, &Theme::light()).len() > 30, "an ordinary view");
        assert!(grid_labels(&view, &Theme::light()).len() > 8, "an ordinary view");
    }
}
