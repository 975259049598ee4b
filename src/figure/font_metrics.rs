//! The three typefaces of the figures and the sizes of their letters.
//!
//! The files stand in `assets/fonts` and are part of the program, so that a figure looks alike on screen and on paper.

use std::sync::OnceLock;

use ttf_parser::Face;

/// A typeface of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FontFace {
    /// Inter Regular: text.
    Regular,
    /// Inter Semi Bold: headings.
    SemiBold,
    /// STIX Two Math: mathematics.
    Math,
}

impl FontFace {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Regular, Self::SemiBold, Self::Math];

    /// The OpenType file.
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            Self::Regular => include_bytes!("../../assets/fonts/Inter-Regular.otf"),
            Self::SemiBold => include_bytes!("../../assets/fonts/Inter-SemiBold.otf"),
            Self::Math => include_bytes!("../../assets/fonts/STIXTwoMath-Regular.ttf"),
        }
    }

    /// Family name, as SVG and CSS name it.
    pub const fn family(self) -> &'static str {
        match self {
            Self::Regular | Self::SemiBold => "Inter",
            Self::Math => "STIX Two Math",
        }
    }

    /// Weight as SVG and CSS count it: 400 is regular.
    pub const fn weight(self) -> u16 {
        match self {
            Self::SemiBold => 600,
            Self::Regular | Self::Math => 400,
        }
    }

    /// The tables of the file; `None` only if the file in `assets/fonts` is damaged.
    pub fn face(self) -> Option<&'static Face<'static>> {
        static FACES: [OnceLock<Option<Face<'static>>>; 3] =
            [OnceLock::new(), OnceLock::new(), OnceLock::new()];
        let cell = &FACES[self as usize];
        cell.get_or_init(|| Face::parse(self.bytes(), 0).ok()).as_ref()
    }
}

/// Sizes of one letter in units of the type size (1 em); `y` up from the base line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LetterMetrics {
    /// Distance to the next letter.
    pub advance: f64,
    /// Left end of the ink.
    pub left: f64,
    /// Right end of the ink.
    pub right: f64,
    /// Upper end of the ink, negative if all of it is below the base line.
    pub top: f64,
    /// Lower end of the ink, negative if it goes below the base line.
    pub bottom: f64,
}

/// Metrics of `letter`, or of the replacement box if the face lacks it.
pub fn letter_metrics(font: FontFace, letter: char) -> LetterMetrics {
    let empty = LetterMetrics { advance: 0.0, left: 0.0, right: 0.0, top: 0.0, bottom: 0.0 };
    let Some(face) = font.face() else { return empty };
    let em = f64::from(face.units_per_em());
    let glyph = face.glyph_index(letter).unwrap_or_default();
    let advance = f64::from(face.glyph_hor_advance(glyph).unwrap_or_default()) / em;
    let Some(ink) = face.glyph_bounding_box(glyph) else { return LetterMetrics { advance, ..empty } };
    let [left, right, top, bottom] =
        [ink.x_min, ink.x_max, ink.y_max, ink.y_min].map(|side| f64::from(side) / em);
    LetterMetrics { advance, left, right, top, bottom }
}

/// Whether the face has a drawing of `letter`.
pub fn has_letter(font: FontFace, letter: char) -> bool {
    font.face().is_some_and(|face| face.glyph_index(letter).is_some())
}

/// Width in pt of one line of `text` set at `size` pt, without kerning; letters that the face lacks are taken from
/// STIX Two Math if it has them.
pub fn text_width(font: FontFace, text: &str, size: f64) -> f64 {
    text.chars().map(|letter| letter_metrics(font_of(font, letter), letter).advance).sum::<f64>() * size
}

fn font_of(font: FontFace, letter: char) -> FontFace {
    if !has_letter(font, letter) && has_letter(FontFace::Math, letter) { FontFace::Math } else { font }
}

/// The text cut into parts of one face each: `font`, or STIX Two Math for letters that `font` lacks.
pub fn runs(font: FontFace, text: &str) -> Vec<(FontFace, &str)> {
    let mut runs = Vec::new();
    let mut start = 0;
    let mut current = None;
    for (index, letter) in text.char_indices() {
        let wanted = font_of(font, letter);
        if let Some(before) = current.filter(|&before| before != wanted) {
            runs.push((before, &text[start..index]));
            start = index;
        }
        current = Some(wanted);
    }
    runs.extend(current.map(|last| (last, &text[start..])));
    runs
}

/// How far the letters of the face reach above and below the base line at `size` pt, both positive.
pub fn line_extent(font: FontFace, size: f64) -> (f64, f64) {
    let Some(face) = font.face() else { return (0.0, 0.0) };
    let scale = size / f64::from(face.units_per_em());
    (f64::from(face.ascender()) * scale, -f64::from(face.descender()) * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_faces_are_readable_and_have_their_letters() {
        for font in FontFace::ALL {
            assert!(font.face().is_some(), "{font:?} cannot be read");
            assert!(has_letter(font, 'ξ') && has_letter(font, '≤'), "{font:?} lacks Greek or ≤");
        }
        for letter in "𝑥ℎ𝛾𝐯∑∫√′∈".chars() {
            assert!(has_letter(FontFace::Math, letter), "STIX Two Math lacks {letter}");
        }
        assert!(!has_letter(FontFace::Regular, '\u{10FFFF}'), "no such letter");
    }

    #[test]
    fn width_grows_with_size_and_letters() {
        let one = text_width(FontFace::Regular, "knot", 10.0);
        assert!(one > 15.0 && one < 30.0, "four letters of 10 pt are {one} pt wide");
        assert!((text_width(FontFace::Regular, "knot", 20.0) - 2.0 * one).abs() < 1e-9, "twice the size");
        assert!((text_width(FontFace::Regular, "knotknot", 10.0) - 2.0 * one).abs() < 1e-9, "twice the text");
        let bold = text_width(FontFace::SemiBold, "knot", 10.0);
        assert!(bold > one, "semi bold {bold} and regular {one}");
        assert_eq!(text_width(FontFace::Math, "", 10.0), 0.0, "nothing");
    }

    #[test]
    fn letters_that_a_face_lacks_come_from_the_other() {
        let found = runs(FontFace::Regular, "for 𝑥𝑦 > 0");
        let expected = [(FontFace::Regular, "for "), (FontFace::Math, "𝑥𝑦"), (FontFace::Regular, " > 0")];
        assert_eq!(found, expected, "three parts");
        assert!(runs(FontFace::Regular, "").is_empty(), "nothing");
    }

    #[test]
    fn letters_reach_above_and_below_the_base_line() {
        let (x, y) = (letter_metrics(FontFace::Regular, 'x'), letter_metrics(FontFace::Regular, 'y'));
        assert!(x.bottom.abs() < 0.02 && y.bottom < -0.1, "x to {}, y to {}", x.bottom, y.bottom);
        let (ascent, descent) = line_extent(FontFace::Regular, 1.0);
        assert!(ascent > 0.7 && ascent < 1.2 && descent > 0.1 && descent < 0.4, "{ascent}, {descent}");
    }
}
