//! Numbers as the panels show them, and lists of numbers as people type them.

use crate::course::number_text::parse_number;

/// The numbers of a list, separated by spaces, semicolons or commas.
///
/// Commas separate if a space or another comma list stands around them (`0, 1, 2` and `0,1,2`); between semicolons or
/// spaces they are decimal signs (`0,5; 1,5` and `0,5 1,5`). What could mean both is refused.
pub(crate) fn parse_list(text: &str) -> Result<Vec<f64>, String> {
    let text = text.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim();
    if text.contains(';') {
        let entries = text.split(';').map(str::trim).filter(|entry| !entry.is_empty());
        return entries.flat_map(str::split_whitespace).map(number).collect();
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    let separating = |word: &str| word.starts_with(',') || word.ends_with(',');
    let commas_separate = words.iter().any(|word| separating(word)) || words.len() == 1;
    if !commas_separate {
        if text.contains(',') && text.contains('.') {
            return Err(
                "both point and comma as decimal sign: separate the numbers with semicolons".to_owned()
            );
        }
        return words.into_iter().map(number).collect();
    }
    if words.len() > 1
        && let Some(word) = words.iter().find(|word| word.trim_matches(',').contains(','))
    {
        return Err(format!(
            "\u{201c}{word}\u{201d} can be read in two ways: separate the numbers with semicolons"
        ));
    }
    text.split([',', ' ', '\t', '\n', '\r']).filter(|word| !word.is_empty()).map(number).collect()
}

fn number(word: &str) -> Result<f64, String> {
    parse_number(word).map_err(|error| error.to_string())
}

/// `value` with about five digits: what a table shows.
pub(crate) fn short(value: f64) -> String {
    with_digits(value, 5)
}

/// `value` with about three digits, for crowded places.
pub(crate) fn compact(value: f64) -> String {
    with_digits(value, 3)
}

/// `value` with `digits` significant digits, zeros at the end left out, minus sign as in print.
pub(crate) fn with_digits(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return if value.is_nan() {
            "undefined"
        } else if value > 0.0 {
            "\u{221e}"
        } else {
            "\u{2212}\u{221e}"
        }
        .to_owned();
    }
    let magnitude = value.abs().log10().floor() as i32;
    let text = if (-4..=digits + 1).contains(&magnitude) {
        let decimals = (digits - 1 - magnitude).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        let text = format!("{value:.*e}", (digits - 1) as usize);
        match text.split_once('e') {
            Some((mantissa, exponent)) if mantissa.contains('.') => {
                format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
            }
            _ => text,
        }
    };
    if text == "-0" { "0".to_owned() } else { text.replace('-', "\u{2212}") }
}

/// `value` with all its digits, so that reading it again gives the same number.
pub(crate) fn full(value: f64) -> String {
    if value == 0.0 || (1e-5..1e16).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// `value` rounded to a decimal step not larger than `step`: what a drag over pixels of that size can mean.
pub(crate) fn round_to_step(value: f64, step: f64) -> f64 {
    let exponent = -step.abs().log10().floor();
    if !exponent.is_finite() || exponent.abs() > 15.0 {
        return value;
    }
    let power = 10.0_f64.powi(exponent.abs() as i32);
    // Dividing by a power of ten is exact to the last digit; multiplying by its inverse is not.
    let rounded =
        if exponent >= 0.0 { (value * power).round() / power } else { (value / power).round() * power };
    if rounded.is_finite() { rounded } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_read_with_every_separator() {
        for text in [
            "0 0.5 1.5",
            "0,0.5,1.5",
            "0, 0.5, 1.5",
            "0; 0,5; 1,5",
            "0 0,5 1,5",
            "[0, 0.5, 1.5]",
            "0;0.5;3/2",
        ] {
            assert_eq!(parse_list(text), Ok(vec![0.0, 0.5, 1.5]), "{text}");
        }
        assert_eq!(parse_list(""), Ok(Vec::new()), "nothing");
    }

    #[test]
    fn a_list_that_can_be_read_in_two_ways_is_refused() {
        for text in ["0,5, 1", "0.5 1,5", "0; 1,2,3"] {
            assert!(parse_list(text).is_err(), "{text} gives {:?}", parse_list(text));
        }
    }

    #[test]
    fn shown_numbers_are_short_and_full_ones_come_back() {
        for (value, text) in [
            (0.1 + 0.2, "0.3"),
            (-2.5, "\u{2212}2.5"),
            (1.0, "1"),
            (123_456.0, "123456"),
            (1e-9, "1e\u{2212}9"),
        ] {
            assert_eq!(short(value), text, "{value}");
        }
        for value in [0.1 + 0.2, 1e300, -7e-200, 123_456.789, f64::MIN_POSITIVE] {
            assert_eq!(parse_number(&full(value)), Ok(value), "{value}");
            assert!(parse_number(&short(value)).is_ok(), "{} can be typed", short(value));
        }
    }

    #[test]
    fn dragged_numbers_have_no_more_digits_than_pixels() {
        assert_eq!(round_to_step(0.123_456, 0.013), 0.12, "steps of a hundredth");
        assert_eq!(round_to_step(1234.0, 130.0), 1200.0, "steps of a hundred");
        assert_eq!(round_to_step(0.3, 0.0), 0.3, "no step");
    }
}
