//! Boxes with texts and rules in them, placed relative to a base line.

/// A run of letters of STIX Two Math on one base line, set without kerning.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedText {
    /// The letters, for example `𝑥` (U+1D465) for an italic x.
    pub text: String,
    /// Left end in pt from the left end of the formula.
    pub x: f64,
    /// Height in pt of the letters' base line above that of the formula.
    pub y: f64,
    /// Size of type in pt.
    pub size: f64,
}

/// A filled rectangle: a fraction bar, the line over a root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Left end in pt.
    pub x: f64,
    /// Lower end in pt above the base line.
    pub y: f64,
    /// Width in pt.
    pub width: f64,
    /// Height in pt.
    pub height: f64,
}

/// A typeset formula. Lengths in pt, x to the right and y up from the left end of the base line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FormulaLayout {
    /// Width.
    pub width: f64,
    /// How far it reaches above the base line; negative if all of it is below.
    pub ascent: f64,
    /// How far it reaches below the base line; negative if all of it is above.
    pub descent: f64,
    /// The letters.
    pub glyphs: Vec<PlacedText>,
    /// The rules.
    pub rules: Vec<Rule>,
}

impl FormulaLayout {
    pub(super) fn space(width: f64) -> Self {
        Self { width, ..Self::default() }
    }

    pub(super) fn is_blank(&self) -> bool {
        self.glyphs.is_empty() && self.rules.is_empty()
    }

    pub(super) fn height(&self) -> f64 {
        self.ascent + self.descent
    }

    /// Puts `other` at `(x, y)`; extent above and below grows, the width does not.
    pub(super) fn put(&mut self, other: Self, x: f64, y: f64) {
        if other.is_blank() {
            return;
        }
        let was_blank = self.is_blank();
        let (ascent, descent) = (other.ascent + y, other.descent - y);
        self.ascent = if was_blank { ascent } else { self.ascent.max(ascent) };
        self.descent = if was_blank { descent } else { self.descent.max(descent) };
        self.glyphs.extend(other.glyphs.into_iter().map(|glyph| PlacedText {
            x: glyph.x + x,
            y: glyph.y + y,
            ..glyph
        }));
        self.rules.extend(other.rules.into_iter().map(|rule| Rule { x: rule.x + x, y: rule.y + y, ..rule }));
    }

    /// Puts `other` at the right end of the base line, and grows by its width.
    pub(super) fn append(&mut self, other: Self) {
        let (x, width) = (self.width, other.width);
        self.put(other, x, 0.0);
        self.width += width;
    }

    /// A rule on its own.
    pub(super) fn rule(width: f64, height: f64) -> Self {
        let rule = Rule { x: 0.0, y: 0.0, width, height };
        Self { width, ascent: height, descent: 0.0, glyphs: Vec::new(), rules: vec![rule] }
    }
}
