//! From the source text to a tree.

use crate::figure::font_metrics::{FontFace, has_letter};
use crate::figure::formula::FormulaError;
use crate::figure::formula::letter::{Alphabet, styled};
use crate::figure::formula::symbol::{self, Class};

/// Groups within groups: so many at most.
const DEEPEST: usize = 40;

/// A part of a formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// One sign or letter as it is drawn.
    Sign(char, Class),
    /// A word in upright letters.
    Word(String),
    /// The name of a function; limits above and below or beside.
    FunctionName { name: String, has_limits: bool },
    /// A sum or an integral.
    BigOperator { sign: char, has_limits: bool },
    /// Something in braces.
    Group(Vec<Self>),
    /// Something with primes, a subscript or a superscript.
    Scripts { base: Box<Self>, primes: usize, below: Option<Vec<Self>>, above: Option<Vec<Self>> },
    /// A fraction; without a bar in a binomial coefficient.
    Fraction { numerator: Vec<Self>, denominator: Vec<Self>, has_bar: bool },
    /// A square root.
    Root(Vec<Self>),
    /// Something between growing delimiters.
    Fenced { left: Option<char>, body: Vec<Self>, right: Option<char> },
    /// An accent over something.
    Accent { sign: char, body: Vec<Self> },
    /// A line over something.
    Overline(Vec<Self>),
    /// A space in em.
    Space(f64),
}

pub(super) fn parse(source: &str) -> Result<Vec<Node>, FormulaError> {
    let letters: Vec<char> = source.chars().collect();
    let mut parser = Parser { letters: &letters, position: 0, depth: 0, alphabet: Alphabet::Italic };
    let nodes = parser.list()?;
    match parser.peek() {
        None => Ok(nodes),
        Some('}') => Err(parser.expected("no closing brace without an opening one")),
        Some(_) => Err(parser.expected("no \\right without \\left")),
    }
}

struct Parser<'a> {
    letters: &'a [char],
    position: usize,
    depth: usize,
    alphabet: Alphabet,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.letters.get(self.position).copied()
    }

    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.position += 1;
        }
    }

    fn expected(&self, expected: &'static str) -> FormulaError {
        let found = self.peek().map_or_else(|| "the end".to_owned(), |letter| format!("{letter:?}"));
        FormulaError::Expected { position: self.position, expected, found }
    }

    /// Up to the end, a closing brace or `\right`, none of them taken.
    fn list(&mut self) -> Result<Vec<Node>, FormulaError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(FormulaError::TooDeep { position: self.position, limit: DEEPEST });
        }
        let mut nodes = Vec::new();
        loop {
            self.skip_blanks();
            match self.peek() {
                None | Some('}') => break,
                Some('\\') if self.command_name().0 == "right" => break,
                Some(_) => nodes.push(self.item()?),
            }
        }
        self.depth -= 1;
        Ok(nodes)
    }

    /// An atom with its scripts.
    fn item(&mut self) -> Result<Node, FormulaError> {
        let base = match self.peek() {
            Some('_' | '^' | '\'') => Node::Group(Vec::new()),
            _ => self.atom()?,
        };
        let (mut below, mut above): (Option<Vec<Node>>, Option<Vec<Node>>) = (None, None);
        let mut primes = 0;
        loop {
            self.skip_blanks();
            let position = self.position;
            match self.peek() {
                Some('_') => {
                    if below.is_some() {
                        return Err(FormulaError::SecondScript { position, what: "subscript" });
                    }
                    self.position += 1;
                    below = Some(self.argument()?);
                }
                Some('^') => {
                    if above.is_some() {
                        return Err(FormulaError::SecondScript { position, what: "superscript" });
                    }
                    self.position += 1;
                    let nodes = self.argument()?;
                    if nodes.iter().all(|node| matches!(node, Node::Sign('′', _))) {
                        primes += nodes.len();
                    } else {
                        above = Some(nodes);
                    }
                }
                Some('\'' | '′') => {
                    self.position += 1;
                    primes += 1;
                }
                _ => break,
            }
        }
        if below.is_none() && above.is_none() && primes == 0 {
            return Ok(base);
        }
        Ok(Node::Scripts { base: Box::new(base), primes, below, above })
    }

    /// A group in braces, or a single letter or command.
    fn argument(&mut self) -> Result<Vec<Node>, FormulaError> {
        self.skip_blanks();
        match self.peek() {
            None | Some('}' | '_' | '^') => Err(self.expected("a letter or a group in braces")),
            Some('{') => self.group(),
            Some(_) => {
                // `\frac` and its like take arguments in turn: x_\frac\frac… must not go deeper than groups may.
                self.depth += 1;
                if self.depth > DEEPEST {
                    return Err(FormulaError::TooDeep { position: self.position, limit: DEEPEST });
                }
                let atom = self.atom()?;
                self.depth -= 1;
                Ok(vec![atom])
            }
        }
    }

    fn group(&mut self) -> Result<Vec<Node>, FormulaError> {
        self.skip_blanks();
        if self.peek() != Some('{') {
            return Err(self.expected("an opening brace"));
        }
        self.position += 1;
        let nodes = self.list()?;
        if self.peek() != Some('}') {
            return Err(self.expected("a closing brace"));
        }
        self.position += 1;
        Ok(nodes)
    }

    fn atom(&mut self) -> Result<Node, FormulaError> {
        match self.peek() {
            None => Err(self.expected("something")),
            Some('{') => Ok(Node::Group(self.group()?)),
            Some('\\') => self.command(),
            Some(letter) => {
                let (sign, class) = symbol::typed(letter);
                let node = match symbol::typed_big_operator(letter) {
                    Some(has_limits) => Node::BigOperator { sign: letter, has_limits },
                    None => self.sign(sign, class)?,
                };
                self.position += 1;
                Ok(node)
            }
        }
    }

    fn sign(&self, sign: char, class: Class) -> Result<Node, FormulaError> {
        let shown = styled(sign, self.alphabet);
        if !has_letter(FontFace::Math, shown) {
            return Err(FormulaError::NoLetter { position: self.position, letter: sign });
        }
        Ok(Node::Sign(shown, class))
    }

    /// The name of the command at the backslash that comes next, and the position behind it.
    fn command_name(&self) -> (String, usize) {
        let rest = self.letters.get(self.position + 1..).unwrap_or_default();
        let length = rest.iter().take_while(|letter| letter.is_ascii_alphabetic()).count();
        let length = length.max(1).min(rest.len());
        (rest[..length].iter().collect(), self.position + 1 + length)
    }

    fn command(&mut self) -> Result<Node, FormulaError> {
        let start = self.position;
        let (name, behind) = self.command_name();
        if let Some((sign, class)) = symbol::command(&name) {
            let node = self.sign(sign, class)?;
            self.position = behind;
            return Ok(node);
        }
        self.position = behind;
        if let Some((sign, has_limits)) = symbol::big_operator(&name) {
            return Ok(Node::BigOperator { sign, has_limits });
        }
        if let Some(has_limits) = symbol::function_name(&name) {
            return Ok(Node::FunctionName { name, has_limits });
        }
        if let Some(sign) = symbol::accent(&name) {
            return Ok(Node::Accent { sign, body: self.argument()? });
        }
        if let Some(space) = symbol::space(&name) {
            return Ok(Node::Space(space));
        }
        match name.as_str() {
            "frac" => Ok(Node::Fraction {
                numerator: self.argument()?,
                denominator: self.argument()?,
                has_bar: true,
            }),
            "binom" => {
                let (numerator, denominator) = (self.argument()?, self.argument()?);
                let body = vec![Node::Fraction { numerator, denominator, has_bar: false }];
                Ok(Node::Fenced { left: Some('('), body, right: Some(')') })
            }
            "sqrt" => Ok(Node::Root(self.argument()?)),
            "overline" => Ok(Node::Overline(self.argument()?)),
            "text" => self.word(),
            "mathrm" => self.in_alphabet(Alphabet::Upright),
            "mathbf" => self.in_alphabet(Alphabet::Bold),
            "mathit" => self.in_alphabet(Alphabet::Italic),
            "mathbb" => self.in_alphabet(Alphabet::Blackboard),
            "left" => self.fenced(),
            _ => Err(FormulaError::UnknownCommand { position: start, name }),
        }
    }

    fn in_alphabet(&mut self, alphabet: Alphabet) -> Result<Node, FormulaError> {
        let outer = std::mem::replace(&mut self.alphabet, alphabet);
        let nodes = self.argument()?;
        self.alphabet = outer;
        Ok(Node::Group(nodes))
    }

    /// `{…}` taken as it stands, blanks kept.
    fn word(&mut self) -> Result<Node, FormulaError> {
        self.skip_blanks();
        if self.peek() != Some('{') {
            return Err(self.expected("an opening brace"));
        }
        self.position += 1;
        let mut word = String::new();
        loop {
            match self.peek() {
                None => return Err(self.expected("a closing brace")),
                Some('}') => break,
                Some(letter) if letter.is_whitespace() => word.push(' '),
                Some(letter) if has_letter(FontFace::Math, letter) => word.push(letter),
                Some(letter) => return Err(FormulaError::NoLetter { position: self.position, letter }),
            }
            self.position += 1;
        }
        self.position += 1;
        Ok(Node::Word(word))
    }

    fn fenced(&mut self) -> Result<Node, FormulaError> {
        let left = self.delimiter()?;
        let body = self.list()?;
        let (name, behind) = if self.peek() == Some('\\') { self.command_name() } else { (String::new(), 0) };
        if name != "right" {
            return Err(self.expected("\\right"));
        }
        self.position = behind;
        let right = self.delimiter()?;
        Ok(Node::Fenced { left, body, right })
    }

    /// A delimiter after `\left` or `\right`; `None` for the invisible one, a full stop.
    fn delimiter(&mut self) -> Result<Option<char>, FormulaError> {
        self.skip_blanks();
        let (sign, behind) = match self.peek() {
            Some('\\') => {
                let (name, behind) = self.command_name();
                (symbol::command(&name).map(|(sign, _)| sign), behind)
            }
            sign => (sign, self.position + 1),
        };
        match sign {
            Some('.') => {
                self.position = behind;
                Ok(None)
            }
            Some(
                sign @ ('(' | ')' | '[' | ']' | '{' | '}' | '|' | '‖' | '⟨' | '⟩' | '⌊' | '⌋' | '⌈' | '⌉'
                | '/'),
            ) => {
                self.position = behind;
                Ok(Some(sign))
            }
            _ => Err(self.expected("a delimiter")),
        }
    }
}
