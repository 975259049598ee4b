//! Italic, bold and blackboard letters of Unicode's block of mathematical alphabets.

/// How letters are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Alphabet {
    /// Variables: Latin and small Greek letters italic, digits and capital Greek letters upright.
    Italic,
    /// As typed.
    Upright,
    /// Bold upright.
    Bold,
    /// Double struck.
    Blackboard,
}

/// The character of STIX Two Math that shows `letter`; characters without such a form are returned as they are.
pub(super) fn styled(letter: char, alphabet: Alphabet) -> char {
    match alphabet {
        Alphabet::Upright => letter,
        Alphabet::Italic => italic(letter),
        Alphabet::Bold => bold(letter),
        Alphabet::Blackboard => blackboard(letter),
    }
}

fn shifted(letter: char, from: char, to: u32) -> char {
    char::from_u32(letter as u32 - from as u32 + to).unwrap_or(letter)
}

fn italic(letter: char) -> char {
    match letter {
        'h' => 'ℎ',
        'A'..='Z' => shifted(letter, 'A', 0x1D434),
        'a'..='z' => shifted(letter, 'a', 0x1D44E),
        'α'..='ω' => shifted(letter, 'α', 0x1D6FC),
        '∂' => '𝜕',
        'ϵ' => '𝜖',
        'ϑ' => '𝜗',
        'ϰ' => '𝜘',
        'ϕ' => '𝜙',
        'ϱ' => '𝜚',
        'ϖ' => '𝜛',
        _ => letter,
    }
}

fn bold(letter: char) -> char {
    match letter {
        'A'..='Z' => shifted(letter, 'A', 0x1D400),
        'a'..='z' => shifted(letter, 'a', 0x1D41A),
        '0'..='9' => shifted(letter, '0', 0x1D7CE),
        'Α'..='Ω' => shifted(letter, 'Α', 0x1D6A8),
        'α'..='ω' => shifted(letter, 'α', 0x1D6C2),
        _ => letter,
    }
}

fn blackboard(letter: char) -> char {
    match letter {
        'C' => 'ℂ',
        'H' => 'ℍ',
        'N' => 'ℕ',
        'P' => 'ℙ',
        'Q' => 'ℚ',
        'R' => 'ℝ',
        'Z' => 'ℤ',
        'A'..='Z' => shifted(letter, 'A', 0x1D538),
        'a'..='z' => shifted(letter, 'a', 0x1D552),
        '0'..='9' => shifted(letter, '0', 0x1D7D8),
        _ => letter,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::font_metrics::{FontFace, has_letter};

    #[test]
    fn every_letter_has_a_drawing_in_every_alphabet() {
        let letters = ('A'..='Z').chain('a'..='z').chain('0'..='9').chain('α'..='ω');
        for letter in letters {
            for alphabet in [Alphabet::Italic, Alphabet::Upright, Alphabet::Bold, Alphabet::Blackboard] {
                let shown = styled(letter, alphabet);
                assert!(has_letter(FontFace::Math, shown), "{letter} as {alphabet:?}: U+{:X}", shown as u32);
            }
        }
    }

    #[test]
    fn the_letters_that_are_older_than_their_alphabet_are_found() {
        assert_eq!(styled('h', Alphabet::Italic), 'ℎ', "Planck's constant");
        assert_eq!(styled('x', Alphabet::Italic), '𝑥', "italic x");
        assert_eq!(styled('γ', Alphabet::Italic), '𝛾', "italic gamma");
        assert_eq!(styled('R', Alphabet::Blackboard), 'ℝ', "real numbers");
        assert_eq!(styled('Γ', Alphabet::Italic), 'Γ', "capital Greek letters stay upright");
    }
}
