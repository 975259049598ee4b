//! The sentences and formulas of a stepper.

use crate::course::number_text::{formula_number, formula_operand, formula_point, short_number, short_point};
use crate::course::stepper::{Algorithm, Entry, Frame, SchemeContext, Shortcut, Stepper};

/// All frames of `stepper`, whose table is complete.
pub(super) fn frames(stepper: &Stepper, context: &SchemeContext, shortcut: &Shortcut) -> Vec<Frame> {
    let levels = stepper.levels();
    let degree = levels.len() - 1;
    let mut frames = vec![opening(stepper, context)];
    for level in 1..=degree {
        for entry in levels[level].iter().filter(|entry| entry.needed) {
            frames.push(step(stepper, context, entry));
        }
    }
    if shortcut.multiplicity > 0 {
        frames.push(rest(stepper));
    }
    frames.push(closing(stepper, context, shortcut));
    frames
}

/// The tangent `n (pⁿ⁻¹ᵣ − pⁿ⁻¹ₗ)/(width of the interval)`, times `wₗ wᵣ/w²` for rational schemes.
pub(super) fn tangent(levels: &[Vec<Entry>], context: &SchemeContext) -> Vec<f64> {
    let degree = levels.len() - 1;
    let (left, right, apex) = (&levels[degree - 1][0], &levels[degree - 1][1], &levels[degree][0]);
    let factor = match (left.weight, right.weight, apex.weight) {
        (Some(left), Some(right), Some(apex)) => (left / apex) * (right / apex),
        _ => 1.0,
    };
    let scale = factor * degree as f64 / width(context);
    left.coordinates.iter().zip(&right.coordinates).map(|(a, b)| (b - a) * scale).collect()
}

/// `c_3` or `p_3^2`; braces where an index has two digits.
pub(super) fn formula_label(index: usize, level: usize) -> String {
    let braced = |n: usize| if n < 10 { n.to_string() } else { format!("{{{n}}}") };
    match level {
        0 => format!("c_{}", braced(index)),
        _ => format!("p_{}^{}", braced(index), braced(level)),
    }
}

/// `c₃` or `p₃²`.
pub(super) fn plain_label(index: usize, level: usize) -> String {
    let write = |n: usize, digits: [char; 10]| -> String {
        n.to_string().bytes().map(|digit| digits[usize::from(digit - b'0')]).collect()
    };
    let subscript = write(index, ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉']);
    match level {
        0 => format!("c{subscript}"),
        _ => {
            let superscript = write(level, ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹']);
            format!("p{subscript}{superscript}")
        }
    }
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

/// Frame 0: the coefficients that the point depends on.
fn opening(stepper: &Stepper, context: &SchemeContext) -> Frame {
    let t = context.parameter;
    let needed: Vec<&Entry> = stepper.levels()[0].iter().filter(|entry| entry.needed).collect();
    let named = match needed[..] {
        [only] => format!("The point depends on {} alone.", only.plain_label),
        _ => {
            let first = needed.first().map_or("", |entry| &entry.plain_label);
            let last = needed.last().map_or("", |entry| &entry.plain_label);
            format!("The point depends on {} control points, {first} to {last}.", needed.len())
        }
    };
    let (place, formula) = match context.algorithm {
        Algorithm::DeBoor { knots, span } => {
            let (left, right) = (knots[span], knots[span + 1]);
            let closing = if t >= right { ']' } else { ')' };
            let relation = if t >= right { "\\leq" } else { "<" };
            (
                format!(
                    "t = {} lies in [{}, {}{closing}. ",
                    short_number(t),
                    short_number(left),
                    short_number(right)
                ),
                format!(
                    "{} \\leq {} {relation} {}",
                    formula_number(left),
                    formula_number(t),
                    formula_number(right)
                ),
            )
        }
        Algorithm::DeCasteljau => (String::new(), format!("t = {}", formula_number(t))),
    };
    let note = stepper.note().map(|note| format!(" {note}")).unwrap_or_default();
    let ties: Vec<(usize, usize)> = needed.iter().map(|entry| entry.tie()).collect();
    Frame { caption: format!("{place}{named}{note}"), formula, reveals: ties.clone(), highlights: ties }
}

/// One new entry between its two parents.
fn step(stepper: &Stepper, context: &SchemeContext, entry: &Entry) -> Frame {
    let (level, position) = entry.tie();
    let parents = &stepper.levels()[level - 1];
    let (left, right) = (&parents[position], &parents[position + 1]);
    let share = entry.share.unwrap_or(0.0);
    let formula = step_formula(context, entry, left, right);
    let percent = |share: f64| format!("{} %", short_number((1000.0 * share).round() / 10.0));
    let (new, from, to) = (&entry.plain_label, &left.plain_label, &right.plain_label);
    let mut caption = format!("{new} lies {} of the way from {from} to {to}", percent(share));
    match (left.weight, right.weight, entry.weight) {
        (Some(left_weight), Some(right_weight), Some(weight)) => {
            caption = format!(
                "{new} mixes {from} and {to} with the share {} in homogeneous coordinates; their weights {} and {} \
                 make it {} of the way",
                short_number(share),
                short_number(left_weight),
                short_number(right_weight),
                percent(share * right_weight / weight)
            );
        }
        _ if entry.coordinates.len() == 1 => {
            caption = format!(
                "{new} is the mean of {from} and {to} with the shares {} and {}",
                short_number(1.0 - share),
                short_number(share)
            );
        }
        _ => {}
    }
    caption.push('.');
    Frame {
        caption,
        formula,
        reveals: vec![entry.tie()],
        highlights: vec![left.tie(), right.tie(), entry.tie()],
    }
}

fn step_formula(context: &SchemeContext, entry: &Entry, left: &Entry, right: &Entry) -> String {
    let t = context.parameter;
    let (left_share, right_share) = match context.algorithm {
        Algorithm::DeBoor { knots, span } => {
            let degree = context.coefficients.len() - 1;
            let k = span - degree + entry.level + entry.position;
            let (low, high) = (knots[k], knots[k + degree + 1 - entry.level]);
            let difference = |a: f64, b: f64| format!("{}-{}", formula_number(a), formula_operand(b));
            let below = difference(high, low);
            (
                format!("\\frac{{{}}}{{{below}}}", difference(high, t)),
                format!("\\frac{{{}}}{{{below}}}", difference(t, low)),
            )
        }
        Algorithm::DeCasteljau => (formula_operand(1.0 - t), formula_operand(t)),
    };
    let (left_name, right_name) = (homogeneous_label(left), homogeneous_label(right));
    let (name, value) = (homogeneous_label(entry), formula_point(&homogeneous(entry)));
    match context.algorithm {
        Algorithm::DeBoor { .. } => {
            format!("{name} = {right_share} \\, {right_name} + {left_share} \\, {left_name} = {value}")
        }
        Algorithm::DeCasteljau => {
            format!("{name} = {left_share} \\, {left_name} + {right_share} \\, {right_name} = {value}")
        }
    }
}

/// At a knot: the entries on which the point does not depend, all at once.
fn rest(stepper: &Stepper) -> Frame {
    let apex = stepper.apex();
    let last = stepper.levels().len() - 1;
    let reveals: Vec<(usize, usize)> =
        stepper.table().filter(|entry| !entry.needed && entry.level < last).map(Entry::tie).collect();
    let caption = format!(
        "The point of the curve is reached: {} = {}. The other entries serve the tangent only.",
        apex.plain_label, apex.texts[0]
    );
    let formula = format!("p = {} = {}", apex.label, formula_point(&apex.coordinates));
    Frame { caption, formula, reveals, highlights: vec![apex.tie()] }
}

/// The last frame: the point and its tangent through the last two points.
fn closing(stepper: &Stepper, context: &SchemeContext, shortcut: &Shortcut) -> Frame {
    let levels = stepper.levels();
    let degree = levels.len() - 1;
    let (left, right, top) = (&levels[degree - 1][0], &levels[degree - 1][1], &levels[degree][0]);
    let side = match (shortcut.multiplicity >= degree, shortcut.at_right_end, context.algorithm) {
        (true, false, Algorithm::DeBoor { .. }) => " on the right of the knot",
        (true, true, Algorithm::DeBoor { .. }) => " on the left of the knot",
        _ => "",
    };
    let caption = format!(
        "The point is {}. The last two points, {} and {}, span the tangent{side}.",
        short_point(&top.coordinates),
        left.plain_label,
        right.plain_label
    );
    let width = match context.algorithm {
        Algorithm::DeBoor { knots, span } => {
            format!("{}-{}", formula_number(knots[span + 1]), formula_operand(knots[span]))
        }
        Algorithm::DeCasteljau => "1-0".to_owned(),
    };
    let weights = match (left.weight, right.weight, top.weight) {
        (Some(left), Some(right), Some(top)) => {
            let (left, right, top) = (formula_number(left), formula_number(right), formula_number(top));
            format!("\\frac{{{left} \\cdot {right}}}{{{top}^2}} ")
        }
        _ => String::new(),
    };
    let formula = format!(
        "p' = {degree} {weights}\\frac{{{} - {}}}{{{width}}} = {}",
        right.label,
        left.label,
        formula_point(stepper.tangent())
    );
    let mut reveals = Vec::new();
    if shortcut.multiplicity > 0 {
        reveals.push(top.tie());
    }
    Frame { caption, formula, reveals, highlights: vec![left.tie(), right.tie(), top.tie()] }
}

/// Length of the parameter interval of the polynomial piece.
fn width(context: &SchemeContext) -> f64 {
    match context.algorithm {
        Algorithm::DeBoor { knots, span } => knots[span + 1] - knots[span],
        Algorithm::DeCasteljau => 1.0,
    }
}

/// `w_3^1 p_3^1` for a rational scheme, the plain name otherwise.
fn homogeneous_label(entry: &Entry) -> String {
    match entry.weight {
        Some(_) => {
            let weight = entry.label.replacen(['c', 'p'], "w", 1);
            format!("{weight} \\, {}", entry.label)
        }
        None => entry.label.clone(),
    }
}

/// The coordinates times the weight.
fn homogeneous(entry: &Entry) -> Vec<f64> {
    let weight = entry.weight.unwrap_or(1.0);
    entry.coordinates.iter().map(|coordinate| coordinate * weight).collect()
}
