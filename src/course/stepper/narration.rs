//! Words and formulas of the stories.

use crate::core::bspline::{SplineError, SplineSpace};
use crate::course::number_text::{formula_number, formula_operand, formula_point, short_number};
use crate::course::stepper::Entry;

/// The name of an entry: a letter with a subscript, and a superscript above level 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Name {
    letter: char,
    pub(super) index: usize,
    level: Option<usize>,
}

impl Name {
    pub(super) const fn new(letter: char, index: usize, level: Option<usize>) -> Self {
        Self { letter, index, level }
    }

    /// `c_k` on level 0, `p_k^i` above.
    pub(super) const fn of_level(index: usize, level: usize) -> Self {
        if level == 0 { Self::new('c', index, None) } else { Self::new('p', index, Some(level)) }
    }

    /// `c_3` or `p_3^2`; braces where an index has two digits.
    pub(super) fn formula(self) -> String {
        let braced = |n: usize| if n < 10 { n.to_string() } else { format!("{{{n}}}") };
        let superscript = self.level.map(|level| format!("^{}", braced(level))).unwrap_or_default();
        format!("{}_{}{superscript}", self.letter, braced(self.index))
    }

    /// `c₃` or `p₃²`.
    pub(super) fn plain(self) -> String {
        let write = |n: usize, digits: [char; 10]| -> String {
            n.to_string().bytes().map(|digit| digits[usize::from(digit - b'0')]).collect()
        };
        let subscript = write(self.index, ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉']);
        let superscripts = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let superscript = self.level.map(|level| write(level, superscripts)).unwrap_or_default();
        format!("{}{subscript}{superscript}", self.letter)
    }
}

/// How the shares of two parents are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shares {
    /// The right parent has the share `(at − low)/(high − low)`.
    Fraction { at: f64, low: f64, high: f64 },
    /// The right parent has this share.
    Number(f64),
}

/// Sentence and formula of an entry that is a mixture of two.
pub(super) fn mixture(entry: &Entry, left: &Entry, right: &Entry, shares: &Shares) -> (String, String) {
    let share = entry.share.unwrap_or(0.0);
    let percent = |share: f64| format!("{} %", short_number((1000.0 * share).round() / 10.0));
    let (new, from, to) = (&entry.plain_label, &left.plain_label, &right.plain_label);
    let caption = match (left.weight, right.weight, entry.weight) {
        (Some(left_weight), Some(right_weight), Some(weight)) => format!(
            "{new} mixes {from} and {to} with the share {} in homogeneous coordinates; their weights {} and {} make it {} of \
             the way.",
            short_number(share),
            short_number(left_weight),
            short_number(right_weight),
            percent(share * right_weight / weight)
        ),
        _ => format!("{new} lies {} of the way from {from} to {to}.", percent(share)),
    };
    let (name, value) = (homogeneous_label(entry), formula_point(&homogeneous(entry)));
    let (left_name, right_name) = (homogeneous_label(left), homogeneous_label(right));
    let formula = match *shares {
        Shares::Fraction { at, low, high } => {
            let below = difference(high, low);
            let fraction = |above: String| format!("\\frac{{{above}}}{{{below}}}");
            let (right_share, left_share) = (fraction(difference(at, low)), fraction(difference(high, at)));
            format!("{name} = {right_share} \\, {right_name} + {left_share} \\, {left_name} = {value}")
        }
        Shares::Number(share) => {
            let (left_share, right_share) = (formula_operand(1.0 - share), formula_operand(share));
            format!("{name} = {left_share} \\, {left_name} + {right_share} \\, {right_name} = {value}")
        }
    };
    (caption, formula)
}

/// `a-b` with numbers.
pub(super) fn difference(a: f64, b: f64) -> String {
    format!("{}-{}", formula_number(a), formula_operand(b))
}

/// `w_3^1 p_3^1` for a rational scheme, the plain name otherwise.
pub(super) fn homogeneous_label(entry: &Entry) -> String {
    match entry.weight {
        Some(_) => format!("{} \\, {}", weight_label(entry), entry.label),
        None => entry.label.clone(),
    }
}

/// `w_3^1`.
pub(super) fn weight_label(entry: &Entry) -> String {
    entry.label.replacen(|letter: char| letter.is_ascii_lowercase(), "w", 1)
}

/// The coordinates times the weight.
fn homogeneous(entry: &Entry) -> Vec<f64> {
    let weight = entry.weight.unwrap_or(1.0);
    entry.coordinates.iter().map(|coordinate| coordinate * weight).collect()
}

/// `a simple`, `a double`, `a triple`, `a 4-fold`.
pub(super) fn multiplicity_word(multiplicity: usize) -> String {
    match multiplicity {
        1 => "a simple".to_owned(),
        2 => "a double".to_owned(),
        3 => "a triple".to_owned(),
        8 | 11 => format!("an {multiplicity}-fold"),
        _ => format!("a {multiplicity}-fold"),
    }
}

/// `1 point`, `3 points`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// `c₁ to c₄`, or the only name.
pub(super) fn range_of(entries: &[Entry]) -> String {
    match entries {
        [] => String::new(),
        [only] => only.plain_label.clone(),
        [first, .., last] => format!("{} to {}", first.plain_label, last.plain_label),
    }
}

/// Where `t` lies between two knots, as a sentence and a formula.
pub(super) fn place_in_interval(t: f64, left: f64, right: f64) -> (String, String) {
    let at_end = t >= right;
    let (closing, relation) = if at_end { (']', "\\leq") } else { (')', "<") };
    (
        format!("t = {} lies in [{}, {}{closing}.", short_number(t), short_number(left), short_number(right)),
        format!("{} \\leq {} {relation} {}", formula_number(left), formula_number(t), formula_number(right)),
    )
}

/// Whether an insertion that divides `legs` legs divides each once; of a short closed polygon the copies of the knot in other periods
/// divide the same legs again.
///
/// # Errors
///
/// A sentence that says so.
pub(super) fn overlap(space: &SplineSpace, legs: usize) -> Result<(), String> {
    let count = space.dimension();
    if space.is_periodic() && legs > count {
        return Err(format!(
            "The closed polygon has {count} legs, but a new knot of degree {} divides {legs}: some would be divided twice. Add \
             control points first.",
            space.degree()
        ));
    }
    Ok(())
}

/// An error as a sentence.
pub(super) fn sentence(error: &SplineError) -> String {
    let text = error.to_string();
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
