//! An axis of a chart: its ends, its ticks, and its name with the factor of its numbers.

use crate::figure::chart::{Axis, AxisScale, formula_in, label_width};
use crate::figure::ticks::{Tick, axis_ticks};

/// Part of the range added on either side of the data.
const ROOM: f64 = 0.04;

/// An axis with its ends found.
pub(super) struct ScaledAxis {
    pub(super) scale: AxisScale,
    /// The numbers beside the axis are to be taken times 10 to this power, which stands beside its name.
    pub(super) factor: i32,
    /// Ends as numbers on the axis: logarithms to base 10 if the axis is logarithmic.
    pub(super) ends: (f64, f64),
}

impl ScaledAxis {
    pub(super) fn new(axis: &Axis, data: impl Iterator<Item = f64>) -> Self {
        let (scale, ends) = (axis.scale, Self::ends(axis, data));
        let largest = ends.0.abs().max(ends.1.abs()).log10();
        let is_plain = scale == AxisScale::Logarithmic || formula_in(&axis.label).is_some();
        let factor = if is_plain || (-3.0..5.0).contains(&largest) || largest.abs() > 250.0 {
            0
        } else {
            largest.floor() as i32
        };
        Self { scale, factor, ends }
    }

    fn ends(axis: &Axis, data: impl Iterator<Item = f64>) -> (f64, f64) {
        let scale = axis.scale;
        let placed = |value: f64| placed(scale, value);
        let chosen = axis.range.and_then(|(low, high)| Some((placed(low)?, placed(high)?)));
        if let Some(ends) = chosen.filter(|(low, high)| low < high) {
            return ends;
        }
        let (low, high) = data
            .filter_map(placed)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            (0.0, 1.0)
        } else if high - low <= 1e-12 * low.abs().max(high.abs()) {
            // One value: the axis reaches as far as the value is from 0, or by 1.
            let reach = if low.abs() > 1e-300 { low.abs() * 0.5 } else { 1.0 };
            (low - reach, high + reach)
        } else {
            let room = ROOM * (high - low);
            (low - room, high + room)
        }
    }

    /// `name` with the factor of the numbers, in at most `room` pt.
    pub(super) fn name(&self, name: &str, size: f64, room: f64) -> String {
        if self.factor == 0 {
            return shortened(name, size, room);
        }
        let raised = |letter: char| match letter {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
        };
        let factor = format!(" \u{d7} 10{}", self.factor.to_string().chars().map(raised).collect::<String>());
        shortened(name, size, room - label_width(&factor, size)) + &factor
    }

    /// The ticks on `length` pt, as numbers on the axis.
    pub(super) fn ticks(&self, length: f64, spacing: f64, extent: impl Fn(&str) -> f64) -> Vec<Tick> {
        let (low, high) = self.ends;
        if self.scale == AxisScale::Linear {
            let unit = 10f64.powi(self.factor);
            let ticks = axis_ticks((low / unit, high / unit), length, spacing, extent);
            return ticks.into_iter().map(|tick| Tick { value: tick.value * unit, ..tick }).collect();
        }
        // Whole powers of 10, if there are enough of them.
        let powers = |ticks: Vec<Tick>| {
            let whole = ticks.into_iter().filter(|tick| tick.value.fract() == 0.0);
            whole.map(|tick| Tick { label: power_of_ten(&tick.label), ..tick }).collect::<Vec<_>>()
        };
        let ticks = powers(axis_ticks(self.ends, length, spacing, |label| extent(&power_of_ten(label))));
        if ticks.len() >= 3 || high - low > 4.0 {
            return ticks;
        }
        let numbers = axis_ticks((10f64.powf(low), 10f64.powf(high)), length, spacing, |_| 0.0);
        let mut kept: Vec<Tick> = Vec::new();
        // From the right, where equal differences stand closest.
        for tick in numbers.into_iter().rev().filter(|tick| tick.value > 0.0) {
            let tick = Tick { value: tick.value.log10(), ..tick };
            let room = extent(&tick.label) * (high - low) / length;
            if kept.last().is_none_or(|last| last.value - tick.value >= room) {
                kept.push(tick);
            }
        }
        kept.reverse();
        kept
    }
}

/// The power of 10 with this exponent, typeset.
fn power_of_ten(exponent: &str) -> String {
    format!("$10^{{{exponent}}}$")
}

/// The number on the axis where `value` stands; `None` if it has no place.
pub(super) fn placed(scale: AxisScale, value: f64) -> Option<f64> {
    match scale {
        AxisScale::Linear => value.is_finite().then_some(value),
        AxisScale::Logarithmic => (value.is_finite() && value > 0.0).then(|| value.log10()),
    }
}

/// The text, cut with an ellipsis if it is wider than `room` pt; a formula is not cut.
pub(super) fn shortened(text: &str, size: f64, room: f64) -> String {
    if formula_in(text).is_some() || label_width(text, size) <= room {
        return text.to_owned();
    }
    let mut cut: String = text.to_owned();
    while cut.pop().is_some() && label_width(&cut, size) + size > room {}
    format!("{}\u{2026}", cut.trim_end())
}
