//! Characters to tokens with positions.

use crate::core::formula::error::FormulaError;

/// A word of a formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Name(String),
    /// One of `+ - * / ^ ( ) ,`.
    Sign(char),
    End,
}

impl Token {
    /// How a message names it.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Number(value) => format!("the number {value}"),
            Self::Name(name) => format!("the name {name}"),
            Self::Sign(',') => "a comma (numbers take a decimal point)".to_owned(),
            Self::Sign(sign) => format!("'{sign}'"),
            Self::End => "the end".to_owned(),
        }
    }
}

/// The tokens of `text`, each with the index of its first character; the last is [`Token::End`].
pub(super) fn tokens(text: &str) -> Result<Vec<(usize, Token)>, FormulaError> {
    let characters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut position = 0;
    while let Some(&character) = characters.get(position) {
        let rest = &characters[position..];
        let (length, token) = match character {
            _ if character.is_whitespace() => {
                position += 1;
                continue;
            }
            '0'..='9' | '.' => number(position, rest)?,
            '−' => (1, Token::Sign('-')),
            '·' | '×' => (1, Token::Sign('*')),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => (1, Token::Sign(character)),
            _ if character.is_alphabetic() || character == '_' => {
                let length = rest.iter().take_while(|c| c.is_alphanumeric() || **c == '_').count();
                (length, Token::Name(rest[..length].iter().collect()))
            }
            _ => {
                let found = if character == '|' {
                    "'|' (write abs(x))".to_owned()
                } else {
                    format!("'{}'", character.escape_debug())
                };
                return Err(FormulaError::Unexpected {
                    position,
                    expected: "a number, a name, an operator or a bracket",
                    found,
                });
            }
        };
        tokens.push((position, token));
        position += length;
    }
    tokens.push((position, Token::End));
    Ok(tokens)
}

/// Digits, points, and `e` with digits behind it; an `e` without them is a name that follows.
fn number(position: usize, rest: &[char]) -> Result<(usize, Token), FormulaError> {
    let mut length = rest.iter().take_while(|c| c.is_ascii_digit() || **c == '.').count();
    if matches!(rest.get(length), Some('e' | 'E')) {
        let signs = usize::from(matches!(rest.get(length + 1), Some('+' | '-')));
        let digits = rest.iter().skip(length + 1 + signs).take_while(|c| c.is_ascii_digit()).count();
        if digits > 0 {
            length += 1 + signs + digits;
        }
    }
    let text: String = rest[..length].iter().collect();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((length, Token::Number(value))),
        _ => Err(FormulaError::NumberUnreadable { position, text }),
    }
}
