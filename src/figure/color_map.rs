//! Numbers as colours.
//!
//! Viridis (S. van der Walt, N. Smith, 2015) and cividis (J. Nuñez, C. Anderton, R. Renslow, 2018) grow evenly lighter, also for
//! colour-blind eyes and in print without colour; the diverging map (C. Brewer's red and blue) is lightest in its middle.

use crate::figure::error::FigureError;
use crate::figure::picture::Color;
use crate::figure::ticks::{Step, Tick};

/// A way from 0 to 1 through the colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ColorMap {
    /// From dark violet through green to yellow.
    #[default]
    Viridis,
    /// From dark blue through grey to yellow.
    Cividis,
    /// From blue through near white to red: for quantities with a sign.
    Diverging,
}

impl ColorMap {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::Viridis, Self::Cividis, Self::Diverging];

    /// Name as shown to people, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Viridis => "viridis",
            Self::Cividis => "cividis",
            Self::Diverging => "blue to red",
        }
    }

    /// The colour at `t`; below 0 that of 0, above 1 that of 1, clear if `t` is not a number.
    pub fn color(self, t: f64) -> Color {
        if t.is_nan() {
            return Color { r: 0, g: 0, b: 0, a: 0 };
        }
        let t = t.clamp(0.0, 1.0);
        let color = match self {
            Self::Viridis => colorous::VIRIDIS.eval_continuous(t),
            Self::Cividis => colorous::CIVIDIS.eval_continuous(t),
            Self::Diverging => colorous::RED_BLUE.eval_continuous(1.0 - t),
        };
        Color { r: color.r, g: color.g, b: color.b, a: 255 }
    }
}

/// A colour map over an interval of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorScale {
    low: f64,
    high: f64,
    map: ColorMap,
}

impl ColorScale {
    /// The colours of `map` from `low` to `high`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `EmptyInterval` unless `low < high`, and if the difference overflows.
    pub fn new(low: f64, high: f64, map: ColorMap) -> Result<Self, FigureError> {
        for (index, value) in [low, high].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(FigureError::NonFinite { what: "end of the colour scale", index, value });
            }
        }
        if low < high && (high - low).is_finite() {
            return Ok(Self { low, high, map });
        }
        Err(FigureError::EmptyInterval { what: "the colour scale", low, high })
    }

    /// The scale of all finite `values`. Where they are equal (or none) it reaches to either side by their size, or 1 for 0. A
    /// diverging map has 0 in its middle.
    ///
    /// # Errors
    ///
    /// `EmptyInterval` if the values are so large that their difference overflows.
    pub fn of_values(values: &[f64], map: ColorMap) -> Result<Self, FigureError> {
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let (low, high) =
            (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let bound = low.abs().max(high.abs());
        let bound = if bound > 0.0 { bound } else { 1.0 };
        match map {
            ColorMap::Diverging => Self::new(-bound, bound, map),
            _ if low < high => Self::new(low, high, map),
            _ => Self::new(low - bound, high + bound, map),
        }
    }

    /// The value of the first colour.
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// The value of the last colour.
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// The colours.
    pub const fn map(&self) -> ColorMap {
        self.map
    }

    /// The colour of a value; beyond the ends that of the end, clear if it is not a number.
    pub fn color(&self, value: f64) -> Color {
        self.map.color((value - self.low) / (self.high - self.low))
    }

    /// Round values of the scale, about `count` of them or fewer.
    pub fn ticks(&self, count: f64) -> Vec<Tick> {
        Step::at_least((self.high - self.low) / count.max(1.0))
            .map_or_else(Vec::new, |step| step.ticks_between(self.low, self.high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maps_have_their_published_ends() {
        for (map, first, last) in [
            (ColorMap::Viridis, 0x44_01_54, 0xFD_E7_25),
            (ColorMap::Cividis, 0x00_20_51, 0xFD_EA_45),
            (ColorMap::Diverging, 0x05_30_61, 0x67_00_1F),
        ] {
            for (t, expected) in [(0.0, first), (-7.0, first), (1.0, last), (f64::INFINITY, last)] {
                let (found, expected) = (map.color(t), Color::hex(expected));
                let error = [(found.r, expected.r), (found.g, expected.g), (found.b, expected.b)]
                    .map(|(a, b)| a.abs_diff(b));
                assert!(error.iter().all(|&error| error <= 3), "{} at {t}: {found:?}", map.name());
            }
            assert_eq!(map.color(f64::NAN).a, 0, "{}: no number has no colour", map.name());
        }
    }

    #[test]
    fn sequential_maps_grow_lighter_and_the_diverging_one_is_lightest_in_the_middle() {
        let lightness = |map: ColorMap, t: f64| {
            let Color { r, g, b, .. } = map.color(t);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for map in [ColorMap::Viridis, ColorMap::Cividis] {
            for step in 0..20 {
                let (t, next) = (f64::from(step) / 20.0, f64::from(step + 1) / 20.0);
                assert!(lightness(map, t) < lightness(map, next), "{} at {t}", map.name());
            }
        }
        let map = ColorMap::Diverging;
        assert!(lightness(map, 0.5) > 230.0 && lightness(map, 0.0) < 80.0 && lightness(map, 1.0) < 80.0, "V");
    }

    #[test]
    fn scales_reach_from_end_to_end_and_refuse_what_is_none() {
        let scale = ColorScale::new(-2.0, 6.0, ColorMap::Viridis).unwrap();
        assert_eq!(scale.color(-2.0), ColorMap::Viridis.color(0.0), "low");
        assert_eq!(scale.color(2.0), ColorMap::Viridis.color(0.5), "middle");
        assert_eq!(scale.color(60.0), ColorMap::Viridis.color(1.0), "beyond");
        let labels: Vec<String> = scale.ticks(5.0).into_iter().map(|tick| tick.label).collect();
        assert_eq!(labels, ["−2", "0", "2", "4", "6"], "ticks");
        for (low, high, name) in [
            (1.0, 1.0, "EmptyInterval"),
            (2.0, 1.0, "EmptyInterval"),
            (f64::MIN, f64::MAX, "EmptyInterval"),
            (f64::NAN, 1.0, "NonFinite"),
            (0.0, f64::INFINITY, "NonFinite"),
        ] {
            let error = ColorScale::new(low, high, ColorMap::Viridis).unwrap_err();
            assert_eq!(error.name(), name, "{error}");
        }
    }

    #[test]
    fn scales_of_values_hold_them_all() {
        let scale = |values: &[f64], map| {
            let scale = ColorScale::of_values(values, map).unwrap();
            (scale.low(), scale.high())
        };
        assert_eq!(
            scale(&[1.0, f64::NAN, -3.0], ColorMap::Cividis),
            (-3.0, 1.0),
            "what is no number is left out"
        );
        assert_eq!(scale(&[1.0, -3.0], ColorMap::Diverging), (-3.0, 3.0), "0 in the middle");
        assert_eq!(scale(&[5.0, 5.0], ColorMap::Viridis), (0.0, 10.0), "constant");
        assert_eq!(scale(&[], ColorMap::Viridis), (-1.0, 1.0), "nothing");
    }
}
