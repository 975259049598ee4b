//! Formulas that people type: `sin(3x)/(1 + x^2)`.
//!
//! | file | what |
//! |---|---|
//! | `token` | characters to numbers, names and signs, with their positions |
//! | `parser` | the grammar, and the program it writes |
//! | `program` | evaluation on a small stack |
//! | `series` | truncated power series, for derivatives |
//! | `error` | what is wrong, and at which character |
//!
//! # What can be typed
//!
//! - Numbers with a decimal point: `2`, `.5`, `1e-3`. A comma separates arguments and never stands in a number.
//! - The variables that the caller names, and the constants `pi` (or π), `tau` (τ) and `e`; a variable of the same name hides a constant.
//! - `+ - * / ^` (also `·`, `×` and `−`) and brackets. Powers bind most and from the right: `2^3^2` is `2^9`; a sign comes after the
//!   power: `-x^2` is `-(x^2)`, and `2^-1` is one half.
//! - The sign of multiplication may be left out before a name or an opening bracket: `2x`, `3sin(x)`, `x(x + 1)`, `(x + 1)(x - 1)`. It ranks as
//!   if it stood there, so that `1/2x` is `(1/2)*x`. Names are whole words: `xy` is one name, `x y` a product. Nothing may be left out before a
//!   number: `x2` is a name, `2 3` an error.
//! - Functions, always with brackets: `sin cos tan asin acos atan sinh cosh tanh exp log ln` (both natural) `log10 sqrt cbrt abs sign floor ceil`
//!   and `step` (1 from 0 on, else 0) of one argument, `atan2(y, x)` and `hypot` of two, `min` and `max` of two or more.

mod error;
mod parser;
mod program;
mod series;
mod token;

pub use error::FormulaError;

use program::Program;

/// A formula in given variables, ready to be evaluated.
///
/// ```
/// # use spline_lab::core::formula::Formula;
/// let f = Formula::parse("x^2 y", &["x", "y"]).unwrap();
/// assert_eq!(f.value(&[3.0, 2.0]), 18.0);
/// assert_eq!(f.gradient(&[3.0, 2.0]), [12.0, 9.0]);
/// assert_eq!(Formula::parse("sin x", &["x"]).unwrap_err().position(), Some(4));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: String,
    variables: usize,
    program: Program,
}

impl Formula {
    /// Reads `text` as a formula in `variables`.
    ///
    /// # Errors
    ///
    /// [`FormulaError`], with the index of the character where reading stopped.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, FormulaError> {
        let program = parser::parse(text, variables)?;
        Ok(Self { text: text.to_owned(), variables: variables.len(), program })
    }

    /// The text as typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The number of variables; [`Self::value`] takes as many numbers.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The value where variable `i` is `at[i]`; `NaN` where the formula has none, and for a variable that `at` lacks. Does not allocate.
    pub fn value(&self, at: &[f64]) -> f64 {
        self.program.value(at)
    }

    /// `f, ∂f, …, ∂^count f` with respect to `variable`, the others held fixed.
    ///
    /// At a kink or a jump the limits from the right, as the variable grows; `NaN` where a derivative does not exist, as that of
    /// `sqrt(x)` at 0.
    pub fn derivatives(&self, at: &[f64], variable: usize, count: usize) -> Vec<f64> {
        let mut series = self.program.series(at, variable, count);
        let mut factorial = 1.0;
        for (j, coefficient) in series.iter_mut().enumerate().skip(1) {
            factorial *= j as f64;
            *coefficient *= factorial;
        }
        series
    }

    /// All first partial derivatives, as [`Self::derivatives`] gives them.
    pub fn gradient(&self, at: &[f64]) -> Vec<f64> {
        (0..self.variables).map(|variable| self.program.series(at, variable, 1)[1]).collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use proptest::prelude::*;

    fn at(text: &str, x: f64) -> f64 {
        Formula::parse(text, &["x"]).unwrap_or_else(|error| panic!("{text}: {error}")).value(&[x])
    }

    #[test]
    fn ranks_of_the_signs() {
        for (text, value) in [
            ("-x^2", -9.0),
            ("(-x)^2", 9.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("-2^-2", -0.25),
            ("8/4/2", 1.0),
            ("1 - 2 - 3", -4.0),
            ("1/2x", 1.5),
            ("2x^2", 18.0),
            ("2^3x", 24.0),
            ("--x", 3.0),
            ("2 * -x", -6.0),
            ("+x", 3.0),
            ("1e-3*x", 0.003),
            ("2e", 2.0 * std::f64::consts::E),
            ("2e3x", 6000.0),
            (".5x + 5.", 6.5),
            ("x(x + 1)(x - 1)", 24.0),
            ("3 sqrt(4)", 6.0),
            ("2π − τ", 0.0),
            ("2·x × 2", 12.0),
            ("max(1, x, 2) - min(x, 1, 2)", 2.0),
            ("step(x - 3) + step(x - 3.5) + sign(-x)", 0.0),
            ("atan2(1, 0)*2 - pi", 0.0),
            ("hypot(x, 4) + cbrt(-8) + floor(-0.5) + ceil(0.5)", 3.0),
            ("ln(e) + log(e) + log10(1000)", 5.0),
            ("abs(-x)", 3.0),
        ] {
            assert_eq!(at(text, 3.0), value, "{text} at 3");
        }
    }

    #[test]
    fn variables_hide_constants_and_missing_values_are_not_numbers() {
        let f = Formula::parse("e + pi", &["e"]).unwrap();
        assert_eq!(f.value(&[1.0]), 1.0 + std::f64::consts::PI, "e is the variable");
        assert!(f.value(&[]).is_nan(), "no value for e");
        assert!(at("log(x)", -1.0).is_nan(), "no logarithm");
    }

    #[test]
    fn derivatives_in_closed_form() {
        let x: f64 = 0.7;
        let (s, c) = x.sin_cos();
        let cases: [(&str, [f64; 4]); 19] = [
            ("sin(x)", [s, c, -s, -c]),
            ("exp(2x)", [1.0, 2.0, 4.0, 8.0].map(|factor| factor * (2.0 * x).exp())),
            ("log(x)", [x.ln(), 1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3)]),
            ("x^5", [x.powi(5), 5.0 * x.powi(4), 20.0 * x.powi(3), 60.0 * x * x]),
            ("x^-1", [1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3), -6.0 / x.powi(4)]),
            ("sqrt(x)", [x.sqrt(), 0.5 * x.powf(-0.5), -0.25 * x.powf(-1.5), 0.375 * x.powf(-2.5)]),
            ("2^x", [0, 1, 2, 3].map(|j| 2_f64.powf(x) * std::f64::consts::LN_2.powi(j))),
            ("tan(x)", {
                let t = x.tan();
                let d = 1.0 + t * t;
                [t, d, 2.0 * t * d, 2.0 * d * d + 4.0 * t * t * d]
            }),
            ("tanh(x)", {
                let t = x.tanh();
                let d = 1.0 - t * t;
                [t, d, -2.0 * t * d, -2.0 * d * d + 4.0 * t * t * d]
            }),
            ("atan(x)", {
                let q = 1.0 / (1.0 + x * x);
                [x.atan(), q, -2.0 * x * q * q, (6.0 * x * x - 2.0) * q.powi(3)]
            }),
            ("asin(x)", {
                let q = 1.0 / (1.0 - x * x);
                [x.asin(), q.sqrt(), x * q.powf(1.5), (1.0 + 2.0 * x * x) * q.powf(2.5)]
            }),
            ("cosh(x)", [x.cosh(), x.sinh(), x.cosh(), x.sinh()]),
            ("cos(x)*cosh(0)", [c, -s, -c, s]),
            ("acos(x) + asin(x)", [std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0]),
            ("hypot(x, 0)", [x, 1.0, 0.0, 0.0]),
            ("cbrt(-x^3)", [-x, -1.0, 0.0, 0.0]),
            ("atan2(x, 1) - atan(x)", [0.0; 4]),
            ("sinh(x)/cosh(x) - tanh(x)", [0.0; 4]),
            ("log10(x) - ln(x)/ln(10)", [0.0; 4]),
        ];
        for (text, expected) in cases {
            let got = Formula::parse(text, &["x"]).unwrap().derivatives(&[x], 0, 3);
            for (got, expected) in got.iter().zip(expected) {
                assert!(
                    (got - expected).abs() < 1e-12 * expected.abs().max(1.0),
                    "{text}: {got}, {expected}"
                );
            }
        }
    }

    #[test]
    fn limits_from_the_right_at_kinks_and_powers_of_zero() {
        let derivatives = |text: &str| Formula::parse(text, &["x"]).unwrap().derivatives(&[0.0], 0, 2);
        assert_eq!(derivatives("abs(x)"), [0.0, 1.0, 0.0], "|x|");
        assert_eq!(derivatives("sqrt(x^2)")[..2], [0.0, 1.0], "the same function");
        assert_eq!(derivatives("max(x, x^2)"), [0.0, 1.0, 0.0], "x is larger to the right");
        assert_eq!(derivatives("min(x, x^2)"), [0.0, 0.0, 2.0], "x² is smaller to the right");
        assert_eq!(derivatives("x^2"), [0.0, 0.0, 2.0], "no logarithm of 0");
        assert_eq!(derivatives("x^0"), [1.0, 0.0, 0.0], "a constant");
        assert_eq!(derivatives("sign(x) + step(-x)"), [1.0, 0.0, 0.0], "values at 0");
        let root = derivatives("sqrt(x)");
        assert!(root[0] == 0.0 && root[1].is_nan(), "a vertical tangent: {root:?}");
    }

    proptest! {
        #[test]
        fn derivatives_are_limits_of_difference_quotients(x in 0.2..0.9_f64, y in 0.2..0.9_f64) {
            let text = "sin(x y)^3/(1 + x^2) + x^y*atan2(y, x) - log(2 + tan(x)) + hypot(x, exp(y)) + asin(x y)";
            let f = Formula::parse(text, &["x", "y"]).unwrap();
            let h = 1e-5;
            for variable in 0..2 {
                let shifted = |sign: f64| {
                    let mut at = [x, y];
                    at[variable] += sign * h;
                    f.derivatives(&at, variable, 2)
                };
                let (before, after) = (shifted(-1.0), shifted(1.0));
                let exact = f.derivatives(&[x, y], variable, 3);
                prop_assert!((exact[0] - f.value(&[x, y])).abs() < 1e-13, "value {} and {}", exact[0], f.value(&[x, y]));
                prop_assert_eq!(f.gradient(&[x, y])[variable], exact[1], "gradient");
                for j in 0..3 {
                    let quotient = (after[j] - before[j]) / (2.0 * h);
                    let error = (quotient - exact[j + 1]).abs();
                    prop_assert!(error < 1e-5 * (1.0 + exact[j + 1].abs()), "derivative {}: {} and {}", j + 1, quotient, exact[j + 1]);
                }
            }
        }

        #[test]
        fn no_text_makes_it_panic(text in "[-+*/^(), 0-9.exyπsinmaxbs|]{0,40}") {
            if let Ok(f) = Formula::parse(&text, &["x", "y"]) {
                f.value(&[0.3, -0.2]);
                f.derivatives(&[0.0, 0.0], 1, 3);
            }
        }
    }
}
