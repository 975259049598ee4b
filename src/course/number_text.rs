//! Numbers as people write them: short decimals out; decimals with point or comma and fractions in.

use thiserror::Error;

/// Significant digits of the numbers that a lesson shows.
const SHOWN_DIGITS: i32 = 4;

/// Why a typed text is not a number.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NumberTextError {
    /// Nothing was typed.
    #[error("nothing is typed yet")]
    Empty,
    /// The text is neither a decimal number nor a fraction.
    #[error("\u{201c}{text}\u{201d} is not a number; type 1.5, 1,5 or 3/2")]
    NotANumber {
        /// The text.
        text: String,
    },
    /// The denominator of a fraction is 0.
    #[error("\u{201c}{text}\u{201d} divides by 0")]
    DividesByZero {
        /// The text.
        text: String,
    },
}

/// Reads `2`, `-0.5`, `−0,5`, `5/6` or `1.5e-3`; spaces around numbers do not matter.
///
/// A comma is a decimal comma, so a number may have one comma or one point, not both.
///
/// # Errors
///
/// [`NumberTextError`], which repeats the text.
pub fn parse_number(text: &str) -> Result<f64, NumberTextError> {
    let text = text.trim();
    if text.is_empty() {
        return Err(NumberTextError::Empty);
    }
    let refused = || NumberTextError::NotANumber { text: text.to_owned() };
    let value = match text.split_once('/') {
        None => parse_decimal(text).ok_or_else(refused)?,
        Some((above, below)) => {
            let (above, below) = parse_decimal(above).zip(parse_decimal(below)).ok_or_else(refused)?;
            if below.abs() <= 0.0 {
                return Err(NumberTextError::DividesByZero { text: text.to_owned() });
            }
            above / below
        }
    };
    if value.is_finite() { Ok(value) } else { Err(refused()) }
}

fn parse_decimal(text: &str) -> Option<f64> {
    let plain = text.trim().replace('\u{2212}', "-").replace(',', ".");
    // The parser of std also knows "inf" and "nan", which nobody means as an answer.
    let only_number_characters = plain.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    if only_number_characters { plain.parse().ok() } else { None }
}

/// `value` with four significant digits and no trailing zeros: `0.6667`, `-12`, `1.5e-9`.
pub fn short_number(value: f64) -> String {
    if !value.is_finite() || value.abs() <= 0.0 {
        return if value.is_finite() { "0".to_owned() } else { value.to_string() };
    }
    let scientific = format!("{value:.*e}", (SHOWN_DIGITS - 1) as usize);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..=6).contains(&exponent) {
        let decimals = (SHOWN_DIGITS - 1 - exponent).max(0) as usize;
        without_trailing_zeros(&format!("{value:.decimals$}"))
    } else {
        format!("{}e{exponent}", without_trailing_zeros(mantissa))
    }
}

/// As [`short_number`], for a formula: powers of ten are set as such.
pub fn formula_number(value: f64) -> String {
    let text = short_number(value);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{mantissa} \\cdot 10^{{{exponent}}}"),
        None => text,
    }
}

/// As [`formula_number`], a negative number in parentheses, so that it can follow an operator.
pub(crate) fn formula_operand(value: f64) -> String {
    let text = formula_number(value);
    if text.starts_with('-') { format!("({text})") } else { text }
}

/// `(x, y)` with short numbers; a single number without parentheses.
pub fn short_point(coordinates: &[f64]) -> String {
    joined(coordinates, short_number)
}

pub(crate) fn formula_point(coordinates: &[f64]) -> String {
    joined(coordinates, formula_number)
}

fn joined(coordinates: &[f64], write: impl Fn(f64) -> String) -> String {
    match coordinates {
        [single] => write(*single),
        several => {
            let texts: Vec<String> = several.iter().map(|&value| write(value)).collect();
            format!("({})", texts.join(", "))
        }
    }
}

fn without_trailing_zeros(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_commas_and_fractions_are_the_same_number() {
        for (text, expected) in [
            ("0.5", 0.5),
            ("0,5", 0.5),
            (" 1/2 ", 0.5),
            ("\u{2212}1,5", -1.5),
            ("5/6", 5.0 / 6.0),
            ("3,0 / -2", -1.5),
        ] {
            assert_eq!(parse_number(text), Ok(expected), "{text:?}");
        }
    }

    #[test]
    fn texts_that_are_no_numbers_are_repeated_in_the_error() {
        for text in ["abc", "1,000.5", "inf", "NaN", "1/2/3", "1e999", "/2"] {
            let error = parse_number(text).unwrap_err();
            assert!(error.to_string().contains(text), "{text:?}: {error}");
        }
        assert_eq!(parse_number("  "), Err(NumberTextError::Empty), "blank");
        assert_eq!(parse_number("1/0"), Err(NumberTextError::DividesByZero { text: "1/0".into() }), "1/0");
    }

    #[test]
    fn short_numbers_keep_four_digits() {
        for (value, expected) in [
            (2.0 / 3.0, "0.6667"),
            (-12.0, "-12"),
            (0.0, "0"),
            (-0.0, "0"),
            (123_456.0, "123456"),
            (1.5e-9, "1.5e-9"),
            (0.999_999, "1"),
            (4.0e22, "4e22"),
        ] {
            assert_eq!(short_number(value), expected, "{value}");
        }
        assert_eq!(formula_number(1.5e-9), "1.5 \\cdot 10^{-9}", "a power of ten");
    }
}
