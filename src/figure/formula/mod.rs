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
//! The rules are those of TeX (D. Knuth, *The TeXbook*, appendix G) with the constants of the font's MATH table.

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
