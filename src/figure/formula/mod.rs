//! Typeset mathematics: a compact subset of LaTeX, set in STIX Two Math.
//!
//! ```
//! use spline_lab::figure::formula;
//!
//! let line = formula::layout(r"p(t) = \sum_{k=0}^{m-1} c_k b_k(t)", 12.0).unwrap();
//! assert!(line.width > 60.0 && line.ascent > line.descent);
//! ```
//!
//! Understood are letters (set italic), digits, `+ - * / = < > | ( ) [ ] , ; : !`, `_` and `^` with a letter or a group in braces, `'`,
//! `\frac{}{}`, `\binom{}{}`, `\sqrt{}`, `\sum`, `\prod`, `\int` with limits, `\left( … \right)` (also `[ ] \{ \} | \langle \rangle .`),
//! `\text{}`, `\mathrm{}`, `\mathbf{}`, `\mathbb{}`, `\overline{}`, `\hat{}`, `\tilde{}`, `\bar{}`, `\dot{}`, `\vec{}`, Greek letters,
//! names of functions such as `\sin` and `\max`, the usual signs (`\le \ge \ne \in \cdot \times \to \infty \ldots \prime …`) and the spaces
//! `\, \: \; \! \quad \qquad`. Letters and signs may also be typed as themselves: `ξ ≤ τ`.
//!
//! The rules are those of TeX (D. Knuth, *The `TeXbook`*, appendix G) with the constants of the font's MATH table.

mod constants;
mod letter;
mod math_box;
mod parse;
mod symbol;
mod typeset;

use thiserror::Error;

pub use math_box::{FormulaLayout, PlacedText, Rule};

/// Why a formula cannot be set. Positions count characters from 0.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FormulaError {
    /// A command that is not known.
    #[error("character {position}: \\{name} is not known")]
    UnknownCommand {
        /// Where the command starts.
        position: usize,
        /// Its name.
        name: String,
    },
    /// Something else must stand here.
    #[error("character {position}: {expected} expected, found {found}")]
    Expected {
        /// Where.
        position: usize,
        /// What must stand here.
        expected: &'static str,
        /// What stands there instead.
        found: String,
    },
    /// A second subscript or superscript.
    #[error("character {position}: a second {what} at the same place")]
    SecondScript {
        /// Where.
        position: usize,
        /// `subscript` or `superscript`.
        what: &'static str,
    },
    /// The font has no drawing of this character.
    #[error("character {position}: no drawing of {letter:?} in the font")]
    NoLetter {
        /// Where.
        position: usize,
        /// The character.
        letter: char,
    },
    /// Groups within groups beyond the limit.
    #[error("character {position}: more than {limit} groups within each other")]
    TooDeep {
        /// Where.
        position: usize,
        /// The limit.
        limit: usize,
    },
    /// The type size is not a positive number.
    #[error("the type size is {size}, not a positive number")]
    BadSize {
        /// The size as text.
        size: String,
    },
}

impl FormulaError {
    /// Where the error is, counted in characters from 0; 0 for a bad type size.
    pub const fn position(&self) -> usize {
        match self {
            Self::UnknownCommand { position, .. }
            | Self::Expected { position, .. }
            | Self::SecondScript { position, .. }
            | Self::NoLetter { position, .. }
            | Self::TooDeep { position, .. } => *position,
            Self::BadSize { .. } => 0,
        }
    }
}

/// Sets `source` as a displayed formula with letters of `size` pt.
///
/// # Errors
///
/// [`FormulaError`], with the place in `source`.
pub fn layout(source: &str, size: f64) -> Result<FormulaLayout, FormulaError> {
    set(source, size, typeset::Style::Display)
}

/// As [`layout`], for a formula in a line of text: smaller sums and fractions, limits beside the signs.
///
/// # Errors
///
/// [`FormulaError`], with the place in `source`.
pub fn layout_inline(source: &str, size: f64) -> Result<FormulaLayout, FormulaError> {
    set(source, size, typeset::Style::Text)
}

fn set(source: &str, size: f64, style: typeset::Style) -> Result<FormulaLayout, FormulaError> {
    if !(size.is_finite() && size > 0.0) {
        return Err(FormulaError::BadSize { size: size.to_string() });
    }
    let nodes = parse::parse(source)?;
    Ok(typeset::typeset(&nodes, size, style))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width(source: &str) -> f64 {
        layout(source, 10.0).unwrap_or_else(|error| panic!("{source}: {error}")).width
    }

    fn letters(source: &str) -> String {
        layout(source, 10.0).unwrap().glyphs.iter().map(|glyph| glyph.text.as_str()).collect()
    }

    #[test]
    fn letters_are_italic_digits_and_words_upright() {
        assert_eq!(letters(r"x_3 + \gamma h"), "𝑥3+𝛾ℎ", "italic letters");
        assert_eq!(letters(r"\mathbf{v}\mathbb{R}\mathrm{d}\text{if so}\sin"), "𝐯ℝdif sosin", "alphabets");
        assert_eq!(letters("a - b'"), "𝑎−𝑏′", "a minus is no hyphen");
        assert_eq!(letters("ξ≤τ"), letters(r"\xi \le \tau"), "signs as typed");
    }

    #[test]
    fn scripts_stand_right_small_and_off_the_line() {
        let set = layout("x_i^2", 10.0).unwrap();
        let [base, above, below] = &set.glyphs[..] else { panic!("{set:?}") };
        let (above, below) = if above.y > below.y { (above, below) } else { (below, above) };
        assert!(above.y > 2.0 && below.y < -0.8, "heights {} and {}", above.y, below.y);
        assert!(above.size < 8.0 && above.size > 6.0, "size {}", above.size);
        assert!(base.y == 0.0 && below.x > base.x + 3.0, "{set:?}");
        assert_eq!(layout("x^{2}_i", 10.0).unwrap().width, set.width, "either order");
        assert!(width("x^{a^{b^c}}") < width("x^{abc}") + 0.01, "the third level is the smallest");
    }

    #[test]
    fn operators_have_the_space_of_their_class() {
        let em = 10.0;
        let parts = width("a") + width("b");
        let relation = width("a=b") - width("=") - parts;
        assert!((relation - 10.0 / 18.0 * em).abs() < 1e-9, "{relation} on both sides of =");
        let binary = width("a+b") - width("+") - parts;
        assert!((binary - 8.0 / 18.0 * em).abs() < 1e-9, "{binary} on both sides of +");
        let sign = width("-b") - width("-") - width("b");
        assert!(sign.abs() < 1e-9, "{sign} after a minus in front");
        let comma = width("a,b") - width(",") - parts;
        assert!((comma - 3.0 / 18.0 * em).abs() < 1e-9, "{comma} after a comma");
        let in_script = width("x_{a+b}") - width("x_{ab}");
        assert!(in_script < width("+") * 0.8, "{in_script}: no space in scripts");
        assert!((width(r"a\,b") - parts - 3.0 / 18.0 * em).abs() < 1e-9, "a thin space");
    }

    #[test]
    fn fractions_have_a_bar_on_the_axis_between_their_parts() {
        let set = layout(r"\frac{a}{b}", 10.0).unwrap();
        let ([bar], [upper, lower]) = (&set.rules[..], &set.glyphs[..]) else { panic!("{set:?}") };
        assert!(bar.y > 1.5 && bar.y < 3.5, "bar at {}", bar.y);
        assert!(upper.y > bar.y && lower.y < -3.0, "{} above, {} below", upper.y, lower.y);
        let inline = layout_inline(r"\frac{a}{b}", 10.0).unwrap();
        assert!(inline.ascent + inline.descent < set.ascent + set.descent, "smaller in a line");
        assert!(layout(r"\binom{n}{k}", 10.0).unwrap().rules.is_empty(), "no bar");
    }

    #[test]
    fn sums_grow_and_carry_limits_in_displayed_formulas() {
        let displayed = layout(r"\sum_{k=0}^n", 10.0).unwrap();
        let inline = layout_inline(r"\sum_{k=0}^n", 10.0).unwrap();
        assert!(displayed.ascent > inline.ascent + 2.0, "{} and {}", displayed.ascent, inline.ascent);
        assert!(displayed.width < inline.width, "limits above and below take less width");
    }

    #[test]
    fn delimiters_and_roots_reach_around_what_they_enclose() {
        for source in [r"\left( \frac{a}{\frac{b}{c}} \right)", r"\left[ \frac{a}{\frac{b}{c}} \right]"] {
            let set = layout(source, 10.0).unwrap();
            let inside = layout(r"\frac{a}{\frac{b}{c}}", 10.0).unwrap();
            let (height, inner) = (set.ascent + set.descent, inside.ascent + inside.descent);
            assert!(height >= inner * 0.92, "{source}: {height} around {inner}");
            assert!(set.width > inside.width + 3.0, "{source}: {} around {}", set.width, inside.width);
        }
        let root = layout(r"\sqrt{x^2}", 10.0).unwrap();
        assert!(root.ascent > layout("x^2", 10.0).unwrap().ascent, "the line runs above");
        assert_eq!(root.rules.len(), 1, "one line");
    }

    #[test]
    fn sizes_scale() {
        let source = r"\sum_{k}^{n} \frac{\xi_k}{\sqrt{2}} \left( x' \right)";
        let (small, large) = (layout(source, 7.0).unwrap(), layout(source, 21.0).unwrap());
        for (a, b) in
            [(small.width, large.width), (small.ascent, large.ascent), (small.descent, large.descent)]
        {
            assert!((3.0 * a - b).abs() < 1e-9, "{a} and {b}");
        }
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        for (source, position, part) in [
            (r"x + \wrong", 4, "wrong"),
            ("a_", 2, "letter"),
            ("{a", 2, "closing brace"),
            ("a}", 1, "closing brace"),
            (r"\left( a", 8, "right"),
            (r"a \right)", 2, "right"),
            (r"\left x", 6, "delimiter"),
            (r"\frac{a}", 8, "letter"),
            ("x_1_2", 3, "subscript"),
            ("x^1^2", 3, "superscript"),
            (r"\text{ab", 8, "closing brace"),
            ("ξ 한", 2, "drawing"),
            ("\\", 0, "known"),
        ] {
            let error = layout(source, 10.0).expect_err(source);
            assert_eq!(error.position(), position, "{source}: {error}");
            assert!(error.to_string().contains(part), "{source}: {error}");
        }
        for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = layout("x", size).expect_err("no such size");
            assert!(matches!(error, FormulaError::BadSize { .. }), "{size}: {error}");
        }
    }

    #[test]
    fn deep_nesting_ends_with_an_error() {
        for part in ["{", r"\frac", r"\sqrt", r"\left(", "x_{", "^{", r"\hat", r"\mathbf", r"x_\sqrt{"] {
            let error = layout(&part.repeat(100_000), 10.0).expect_err(part);
            let is_expected = matches!(error, FormulaError::TooDeep { .. } | FormulaError::Expected { .. });
            assert!(is_expected, "{part}: {error}");
        }
    }

    #[test]
    fn nothing_and_spaces_are_formulas() {
        assert_eq!(layout("", 10.0).unwrap(), FormulaLayout::default(), "nothing");
        assert_eq!(layout(r"\quad", 10.0).unwrap().width, 10.0, "one em");
        assert!(layout("_1", 10.0).unwrap().width > 2.0, "a subscript of nothing");
    }
}
