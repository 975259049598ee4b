//! From the tree to boxes.

use crate::figure::font_metrics::{FontFace, letter_metrics};
use crate::figure::formula::constants::Constants;
use crate::figure::formula::math_box::{FormulaLayout, PlacedText};
use crate::figure::formula::parse::Node;
use crate::figure::formula::symbol::{Class, space_between};

/// A displayed sum is drawn this much larger than its letter in the font.
const DISPLAYED_SUM: f64 = 1.45;
/// A displayed integral is drawn this much larger than its letter in the font.
const DISPLAYED_INTEGRAL: f64 = 1.75;
/// Delimiters may miss this part of the height of what they enclose.
const DELIMITER_COVER: f64 = 0.92;
/// Delimiters that need not be larger than this are drawn in the usual size.
const LARGEST_USUAL: f64 = 1.12;
/// Thickness of the stroke of a bracket as a multiple of that of a fraction bar.
const BRACKET_STEM: f64 = 1.25;
/// Length of the serifs of a bracket in em.
const BRACKET_SERIF: f64 = 0.26;
/// Space on either side of a bracket in em.
const BRACKET_MARGIN: f64 = 0.08;
/// Space on either side of a fraction, in em.
const FRACTION_SIDE: f64 = 0.1;

/// The four sizes of TeX.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Style {
    /// On a line of its own.
    Display,
    /// In a line of text.
    Text,
    /// A subscript or superscript.
    Script,
    /// A script of a script.
    ScriptScript,
}

impl Style {
    fn of_script(self) -> Self {
        if self <= Self::Text { Self::Script } else { Self::ScriptScript }
    }

    fn of_fraction(self) -> Self {
        match self {
            Self::Display => Self::Text,
            Self::Text => Self::Script,
            Self::Script | Self::ScriptScript => Self::ScriptScript,
        }
    }

    fn is_script(self) -> bool {
        self >= Self::Script
    }
}

/// Sets the nodes with letters of `size` pt.
pub(super) fn typeset(nodes: &[Node], size: f64, style: Style) -> FormulaLayout {
    Typesetter { constants: Constants::read(), size }.row(nodes, style)
}

struct Typesetter {
    constants: Constants,
    size: f64,
}

impl Typesetter {
    /// Type size of a style in pt.
    fn em(&self, style: Style) -> f64 {
        match style {
            Style::Display | Style::Text => self.size,
            Style::Script => self.size * self.constants.script_scale,
            Style::ScriptScript => self.size * self.constants.script_script_scale,
        }
    }

    fn row(&self, nodes: &[Node], style: Style) -> FormulaLayout {
        let classes = classes_in_row(nodes);
        let mut line = FormulaLayout::default();
        let mut previous: Option<Class> = None;
        for (node, class) in nodes.iter().zip(classes) {
            if let (Some(left), Some(right)) = (previous, class) {
                line.width += space_between(left, right, style.is_script()) * self.em(style);
            }
            previous = class.or(previous);
            line.append(self.node(node, style));
        }
        line
    }

    fn node(&self, node: &Node, style: Style) -> FormulaLayout {
        let em = self.em(style);
        match node {
            Node::Sign(sign, _) => text(&sign.to_string(), em),
            Node::Word(word) => text(word, em),
            Node::FunctionName { name, .. } => text(name, em),
            Node::BigOperator { sign, has_limits } => self.big_operator(*sign, *has_limits, style),
            Node::Group(nodes) => self.row(nodes, style),
            Node::Scripts { base, primes, below, above } => {
                self.scripts(base, *primes, [below.as_deref(), above.as_deref()], style)
            }
            Node::Fraction { numerator, denominator, has_bar } => {
                self.fraction(numerator, denominator, *has_bar, style)
            }
            Node::Root(body) => self.root(body, style),
            Node::Fenced { left, body, right } => self.fenced(*left, body, *right, style),
            Node::Accent { sign, body } => self.accent(*sign, body, style),
            Node::Overline(body) => {
                let thickness = self.constants.rule_thickness * em;
                let mut line = self.row(body, style);
                let height = line.ascent + self.constants.overbar_gap * em;
                line.put(FormulaLayout::rule(line.width, thickness), 0.0, height);
                line
            }
            Node::Space(space) => FormulaLayout::space(space * em),
        }
    }

    /// A sum or an integral, centred on the axis.
    fn big_operator(&self, sign: char, is_sum: bool, style: Style) -> FormulaLayout {
        let factor = match (style, is_sum) {
            (Style::Display, true) => DISPLAYED_SUM,
            (Style::Display, false) => DISPLAYED_INTEGRAL,
            _ => 1.0,
        };
        self.centred(sign, self.em(style) * factor, style)
    }

    /// A sign of any size with its middle on the axis.
    fn centred(&self, sign: char, size: f64, style: Style) -> FormulaLayout {
        let sign = text(&sign.to_string(), size);
        let shift = self.constants.axis_height * self.em(style) - (sign.ascent - sign.descent) / 2.0;
        let mut line = FormulaLayout::space(sign.width);
        line.put(sign, 0.0, shift);
        line
    }

    fn scripts(
        &self,
        base: &Node,
        primes: usize,
        scripts: [Option<&[Node]>; 2],
        style: Style,
    ) -> FormulaLayout {
        let body = self.node(base, style);
        let [below, above] = scripts.map(|nodes| nodes.map(|nodes| self.row(nodes, style.of_script())));
        let has_limits = matches!(
            base,
            Node::BigOperator { has_limits: true, .. } | Node::FunctionName { has_limits: true, .. }
        );
        if has_limits && style == Style::Display {
            return self.limits(body, below, above, style);
        }
        let (c, em) = (&self.constants, self.em(style));
        let is_letter = matches!(base, Node::Sign(..));
        let slant = self.slant(base, style);
        let (mut up, mut down) = (c.superscript_shift_up * em, c.subscript_shift_down * em);
        if let Some(above) = &above {
            up = up.max(c.superscript_bottom_min * em + above.descent);
            if !is_letter && !body.is_blank() {
                up = up.max(body.ascent - c.superscript_baseline_drop_max * em);
            }
        }
        if let Some(below) = &below {
            down = down.max(below.ascent - c.subscript_top_max * em);
            if !is_letter && !body.is_blank() {
                down = down.max(body.descent + c.subscript_baseline_drop_min * em);
            }
        }
        if let (Some(below), Some(above)) = (&below, &above) {
            let missing = c.sub_superscript_gap_min * em - ((up - above.descent) - (below.ascent - down));
            if missing > 0.0 {
                let room = c.superscript_bottom_max_with_subscript * em - (up - above.descent);
                let rise = missing.min(room.max(0.0));
                up += rise;
                down += missing - rise;
            }
        }
        // Primes are drawn high in the font and need no raising, but over a tall base.
        let primes = text(&"′".repeat(primes), em);
        let raised = if is_letter { 0.0 } else { (body.ascent - primes.ascent).max(0.0) };
        let mut line = body;
        let start = line.width;
        // The base of an integral leans: its superscript stands at the right end, its subscript further left.
        let is_leaning_sign = matches!(base, Node::BigOperator { has_limits: false, .. });
        let (shift_above, shift_below) = if is_leaning_sign { (0.0, -slant) } else { (slant, 0.0) };
        let behind_primes = start + shift_above + primes.width;
        if !primes.is_blank() {
            line.width = line.width.max(behind_primes);
            line.put(primes, start + shift_above, raised);
        }
        for (script, x, y) in [(above, behind_primes, up), (below, start + shift_below, -down)] {
            if let Some(script) = script {
                line.width = line.width.max(x + script.width + c.space_after_script * em);
                line.put(script, x, y);
            }
        }
        line
    }

    /// How far the upper right of a letter leans over its advance width: the italic correction of the font.
    fn slant(&self, base: &Node, style: Style) -> f64 {
        match base {
            Node::Sign(sign, _) => italic_correction(*sign) * self.em(style),
            Node::BigOperator { sign, has_limits: false } if style == Style::Display => {
                italic_correction(*sign) * self.em(style) * DISPLAYED_INTEGRAL
            }
            Node::BigOperator { sign, has_limits: false } => italic_correction(*sign) * self.em(style),
            _ => 0.0,
        }
    }

    fn limits(
        &self,
        body: FormulaLayout,
        below: Option<FormulaLayout>,
        above: Option<FormulaLayout>,
        style: Style,
    ) -> FormulaLayout {
        let (c, em) = (&self.constants, self.em(style));
        let widest =
            [&below, &above].into_iter().flatten().map(|limit| limit.width).fold(body.width, f64::max);
        let (ascent, descent) = (body.ascent, body.descent);
        let mut line = FormulaLayout::space(widest);
        let left = (widest - body.width) / 2.0;
        line.put(body, left, 0.0);
        if let Some(above) = above {
            let gap = (c.upper_limit_gap_min * em).max(c.upper_limit_baseline_rise_min * em - above.descent);
            let (x, y) = ((widest - above.width) / 2.0, ascent + gap + above.descent);
            line.put(above, x, y);
        }
        if let Some(below) = below {
            let gap = (c.lower_limit_gap_min * em).max(c.lower_limit_baseline_drop_min * em - below.ascent);
            let (x, y) = ((widest - below.width) / 2.0, -(descent + gap + below.ascent));
            line.put(below, x, y);
        }
        line
    }

    fn fraction(
        &self,
        numerator: &[Node],
        denominator: &[Node],
        has_bar: bool,
        style: Style,
    ) -> FormulaLayout {
        let (c, em) = (&self.constants, self.em(style));
        let [upper, lower] = [numerator, denominator].map(|nodes| self.row(nodes, style.of_fraction()));
        let in_text = usize::from(style != Style::Display);
        let [mut up, mut down, gap_above, gap_below] = c.fraction[in_text].map(|value| value * em);
        let (axis, thickness) = (c.axis_height * em, c.rule_thickness * em);
        let width = upper.width.max(lower.width);
        let side = FRACTION_SIDE * em;
        let mut line = FormulaLayout::space(width + 2.0 * side);
        if has_bar {
            up = up.max(axis + thickness / 2.0 + gap_above + upper.descent);
            down = down.max(lower.ascent + gap_below + thickness / 2.0 - axis);
            line.put(FormulaLayout::rule(width, thickness), side, axis - thickness / 2.0);
        } else {
            let missing = c.stack_gap_min[in_text] * em - (up - upper.descent + down - lower.ascent);
            up += missing.max(0.0) / 2.0;
            down += missing.max(0.0) / 2.0;
        }
        let (left_above, left_below) =
            (side + (width - upper.width) / 2.0, side + (width - lower.width) / 2.0);
        line.put(upper, left_above, up);
        line.put(lower, left_below, -down);
        line
    }

    fn root(&self, body: &[Node], style: Style) -> FormulaLayout {
        let (c, em) = (&self.constants, self.em(style));
        let inside = self.row(body, style);
        let gap = c.radical_gap[usize::from(style != Style::Display)] * em;
        let thickness = c.radical_rule_thickness * em;
        let sign = text("√", em);
        let wanted = inside.height() + gap + thickness;
        let factor = (wanted / sign.height().max(f64::MIN_POSITIVE)).max(1.0);
        let sign = text("√", em * factor);
        // The sign may be taller than needed; what is inside then stands in the middle.
        let spare = (sign.height() - wanted).max(0.0) / 2.0;
        let top = inside.ascent + gap + spare + thickness;
        let ink_right = letter_metrics(FontFace::Math, '√').right * em * factor;
        let mut line = FormulaLayout::space(ink_right + inside.width);
        line.put(
            FormulaLayout::rule(inside.width + 0.02 * em, thickness),
            ink_right - 0.02 * em,
            top - thickness,
        );
        let shift = top - sign.ascent;
        line.put(sign, 0.0, shift);
        line.put(inside, ink_right, 0.0);
        line.ascent += c.radical_extra_ascender * em;
        line
    }

    fn fenced(&self, left: Option<char>, body: &[Node], right: Option<char>, style: Style) -> FormulaLayout {
        let inside = self.row(body, style);
        let axis = self.constants.axis_height * self.em(style);
        let reach = (inside.ascent - axis).max(inside.descent + axis);
        let wanted = 2.0 * reach * DELIMITER_COVER;
        let mut line = FormulaLayout::default();
        if let Some(sign) = left {
            line.append(self.delimiter(sign, wanted, style));
        }
        line.append(inside);
        if let Some(sign) = right {
            line.append(self.delimiter(sign, wanted, style));
        }
        line
    }

    /// A delimiter of at least its usual size: larger ones are put together from rules or drawn larger until they are
    /// `wanted` pt high.
    fn delimiter(&self, sign: char, wanted: f64, style: Style) -> FormulaLayout {
        let em = self.em(style);
        let usual = text(&sign.to_string(), em).height();
        if usual <= 0.0 || wanted <= usual * LARGEST_USUAL {
            return self.centred(sign, em, style);
        }
        let Some([second, top, bottom, is_right]) = rules_of(sign) else {
            return self.centred(sign, em * wanted / usual, style);
        };
        let thickness = self.constants.rule_thickness * em;
        let (stem, serif) = (BRACKET_STEM * thickness, BRACKET_SERIF * em);
        let low = self.constants.axis_height * em - wanted / 2.0;
        let has_serif = top || bottom;
        let width = if has_serif { serif } else { stem };
        let margin = BRACKET_MARGIN * em;
        let mut line = FormulaLayout::default();
        let left = margin + if is_right { width - stem } else { 0.0 };
        line.put(FormulaLayout::rule(stem, wanted), left, low);
        let mut reach = width;
        if second {
            reach += 3.0 * stem;
            line.put(FormulaLayout::rule(stem, wanted), left + 3.0 * stem, low);
        }
        if top {
            line.put(FormulaLayout::rule(width, thickness), margin, low + wanted - thickness);
        }
        if bottom {
            line.put(FormulaLayout::rule(width, thickness), margin, low);
        }
        line.width = reach + 2.0 * margin;
        line
    }

    fn accent(&self, sign: char, body: &[Node], style: Style) -> FormulaLayout {
        let em = self.em(style);
        let mut line = self.row(body, style);
        let is_arrow = sign == '→';
        let accent = text(&sign.to_string(), if is_arrow { em * 0.6 } else { em });
        let slant = if let [letter] = body { self.slant(letter, style) } else { 0.0 };
        let x = (line.width + slant - accent.width) / 2.0;
        let y = if is_arrow {
            line.ascent + 0.08 * em + accent.descent
        } else {
            line.ascent - self.constants.accent_base_height * em
        };
        line.put(accent, x, y);
        line
    }
}

/// For signs made of straight strokes: whether there is a second one, a serif above, one below, and whether the
/// serifs point to the left.
const fn rules_of(sign: char) -> Option<[bool; 4]> {
    Some(match sign {
        '|' => [false, false, false, false],
        '‖' => [true, false, false, false],
        '[' => [false, true, true, false],
        ']' => [false, true, true, true],
        '⌊' => [false, false, true, false],
        '⌋' => [false, false, true, true],
        '⌈' => [false, true, false, false],
        '⌉' => [false, true, false, true],
        _ => return None,
    })
}

/// Letters of one size on a line.
fn text(letters: &str, size: f64) -> FormulaLayout {
    let mut width = 0.0;
    let (mut top, mut bottom) = (f64::NEG_INFINITY, f64::INFINITY);
    for letter in letters.chars() {
        let metrics = letter_metrics(FontFace::Math, letter);
        width += metrics.advance * size;
        if metrics.right > metrics.left {
            top = top.max(metrics.top * size);
            bottom = bottom.min(metrics.bottom * size);
        }
    }
    if top < bottom {
        // No ink.
        return FormulaLayout::space(width);
    }
    let glyphs = vec![PlacedText { text: letters.to_owned(), x: 0.0, y: 0.0, size }];
    FormulaLayout { width, ascent: top, descent: -bottom, glyphs, rules: Vec::new() }
}

/// In em.
fn italic_correction(letter: char) -> f64 {
    let Some(face) = FontFace::Math.face() else { return 0.0 };
    let correction = face.glyph_index(letter).and_then(|glyph| {
        face.tables().math?.glyph_info?.italic_corrections?.get(glyph).map(|value| f64::from(value.value))
    });
    correction.unwrap_or(0.0) / f64::from(face.units_per_em())
}

/// The class of each node, signs that cannot be binary where they stand made ordinary; `None` for spaces.
fn classes_in_row(nodes: &[Node]) -> Vec<Option<Class>> {
    let mut classes: Vec<Option<Class>> = nodes.iter().map(class).collect();
    let mut previous: Option<usize> = None;
    for k in 0..classes.len() {
        let Some(here) = classes[k] else { continue };
        let before = previous.and_then(|k| classes[k]);
        let nothing_before = matches!(
            before,
            None | Some(Class::Binary | Class::Operator | Class::Relation | Class::Open | Class::Punctuation)
        );
        if here == Class::Binary && nothing_before {
            classes[k] = Some(Class::Ordinary);
        }
        let nothing_after = matches!(here, Class::Relation | Class::Close | Class::Punctuation);
        if let (Some(Class::Binary), Some(previous), true) = (before, previous, nothing_after) {
            classes[previous] = Some(Class::Ordinary);
        }
        previous = Some(k);
    }
    if let (Some(last), Some(Some(Class::Binary))) = (previous, previous.map(|k| classes[k])) {
        classes[last] = Some(Class::Ordinary);
    }
    classes
}

fn class(node: &Node) -> Option<Class> {
    Some(match node {
        Node::Sign(_, class) => *class,
        Node::FunctionName { .. } | Node::BigOperator { .. } => Class::Operator,
        Node::Scripts { base, .. } => return class(base),
        Node::Fraction { .. } | Node::Fenced { .. } => Class::Inner,
        Node::Word(_) | Node::Group(_) | Node::Root(_) | Node::Accent { .. } | Node::Overline(_) => {
            Class::Ordinary
        }
        Node::Space(_) => return None,
    })
}
