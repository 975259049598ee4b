//! The grammar, by recursive descent:
//!
//! ```text
//! sum     = term { ("+" | "-") term }
//! term    = factor { ("*" | "/") factor | factor that starts with a name or a bracket }
//! factor  = ("+" | "-") factor | power
//! power   = primary [ "^" factor ]
//! primary = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```

use crate::core::formula::error::FormulaError;
use crate::core::formula::program::{Binary, Operation, Program, Unary};
use crate::core::formula::token::{Token, tokens};

/// Factors within factors; far more than anybody types, and far less than the machine's stack.
const MAX_DEPTH: usize = 100;

#[derive(Clone, Copy)]
enum Function {
    Unary(Unary),
    Binary(Binary),
    /// Two or more arguments, folded from the left.
    Variadic(Binary),
}

struct Parser<'a> {
    tokens: Vec<(usize, Token)>,
    next: usize,
    depth: usize,
    variables: &'a [&'a str],
    program: Program,
}

pub(super) fn parse(text: &str, variables: &[&str]) -> Result<Program, FormulaError> {
    let tokens = tokens(text)?;
    if tokens.len() == 1 {
        return Err(FormulaError::Empty);
    }
    let mut parser = Parser { tokens, next: 0, depth: 0, variables, program: Program::default() };
    parser.sum()?;
    match parser.peek() {
        (_, Token::End) => Ok(parser.program),
        (position, Token::Sign(')')) => {
            Err(FormulaError::UnbalancedBracket { position: *position, bracket: ')' })
        }
        _ => Err(parser.unexpected("an operator or the end")),
    }
}

impl Parser<'_> {
    fn peek(&self) -> &(usize, Token) {
        // The last token is the end, and nothing steps over it.
        &self.tokens[self.next]
    }

    fn takes(&mut self, sign: char) -> bool {
        let found = self.peek().1 == Token::Sign(sign);
        self.next += usize::from(found);
        found
    }

    fn unexpected(&self, expected: &'static str) -> FormulaError {
        let (position, token) = self.peek();
        FormulaError::Unexpected { position: *position, expected, found: token.describe() }
    }

    fn sum(&mut self) -> Result<(), FormulaError> {
        let start = self.program.len();
        self.term()?;
        loop {
            let function = if self.takes('+') {
                Binary::Add
            } else if self.takes('-') {
                Binary::Subtract
            } else {
                return Ok(());
            };
            self.term()?;
            self.program.apply(Operation::Binary(function), start);
        }
    }

    fn term(&mut self) -> Result<(), FormulaError> {
        let start = self.program.len();
        self.factor()?;
        loop {
            let function = if self.takes('/') {
                Binary::Divide
            } else if self.takes('*') || matches!(self.peek().1, Token::Name(_) | Token::Sign('(')) {
                Binary::Multiply
            } else {
                return Ok(());
            };
            self.factor()?;
            self.program.apply(Operation::Binary(function), start);
        }
    }

    fn factor(&mut self) -> Result<(), FormulaError> {
        if self.depth == MAX_DEPTH {
            return Err(FormulaError::TooDeep { position: self.peek().0, limit: MAX_DEPTH });
        }
        self.depth += 1;
        let start = self.program.len();
        if self.takes('-') {
            self.factor()?;
            self.program.apply(Operation::Unary(Unary::Negate), start);
        } else if self.takes('+') {
            self.factor()?;
        } else {
            self.primary()?;
            if self.takes('^') {
                self.factor()?;
                self.program.apply(Operation::Binary(Binary::Power), start);
            }
        }
        self.depth -= 1;
        Ok(())
    }

    fn primary(&mut self) -> Result<(), FormulaError> {
        let (position, token) = self.peek().clone();
        match token {
            Token::Number(value) => self.program.push(Operation::Constant(value)),
            Token::Name(name) => return self.named(position, name),
            Token::Sign('(') => {
                self.next += 1;
                self.sum()?;
                return self.closing(position, "an operator or ')'");
            }
            _ => return Err(self.unexpected("a number, a name or '('")),
        }
        self.next += 1;
        Ok(())
    }

    fn named(&mut self, position: usize, name: String) -> Result<(), FormulaError> {
        self.next += 1;
        if let Some(index) = self.variables.iter().position(|variable| *variable == name) {
            self.program.push(Operation::Variable(index));
        } else if let Some(value) = constant(&name) {
            self.program.push(Operation::Constant(value));
        } else if let Some(function) = function(&name) {
            return self.call(position, name, function);
        } else {
            let variables = self.variables.join(", ");
            return Err(FormulaError::UnknownName { position, name, variables });
        }
        Ok(())
    }

    fn call(&mut self, position: usize, name: String, function: Function) -> Result<(), FormulaError> {
        let bracket = self.peek().0;
        if !self.takes('(') {
            return Err(self.unexpected("'(' after the function"));
        }
        let start = self.program.len();
        let mut found = 0;
        if self.peek().1 != Token::Sign(')') {
            loop {
                self.sum()?;
                found += 1;
                if let (Function::Variadic(fold), 2..) = (function, found) {
                    self.program.apply(Operation::Binary(fold), start);
                }
                if !self.takes(',') {
                    break;
                }
                if found == 2 && !matches!(function, Function::Variadic(_)) {
                    // Counted, not kept: the stack stays as shallow as the grammar is deep.
                    found += self.count_arguments();
                    break;
                }
            }
        }
        let (expected, right) = match function {
            Function::Unary(_) => ("one argument", found == 1),
            Function::Binary(_) => ("two arguments", found == 2),
            Function::Variadic(_) => ("two or more arguments", found >= 2),
        };
        if !right && self.peek().1 == Token::Sign(')') {
            return Err(FormulaError::ArgumentCount { position, function: name, expected, found });
        }
        self.closing(bracket, "an operator, ',' or ')'")?;
        match function {
            Function::Unary(function) => self.program.apply(Operation::Unary(function), start),
            Function::Binary(function) => self.program.apply(Operation::Binary(function), start),
            Function::Variadic(_) => {}
        }
        Ok(())
    }

    /// Skips to the bracket that ends the arguments and counts those up to it.
    fn count_arguments(&mut self) -> usize {
        let (mut open, mut count) = (0_usize, 1);
        loop {
            match self.peek().1 {
                Token::End => return count,
                Token::Sign(')') if open == 0 => return count,
                Token::Sign(')') => open -= 1,
                Token::Sign('(') => open += 1,
                Token::Sign(',') if open == 0 => count += 1,
                _ => {}
            }
            self.next += 1;
        }
    }

    fn closing(&mut self, position: usize, expected: &'static str) -> Result<(), FormulaError> {
        if self.takes(')') {
            return Ok(());
        }
        Err(match self.peek().1 {
            Token::End => FormulaError::UnbalancedBracket { position, bracket: '(' },
            _ => self.unexpected(expected),
        })
    }
}

fn constant(name: &str) -> Option<f64> {
    Some(match name {
        "pi" | "π" => std::f64::consts::PI,
        "tau" | "τ" => std::f64::consts::TAU,
        "e" => std::f64::consts::E,
        _ => return None,
    })
}

fn function(name: &str) -> Option<Function> {
    let unary = match name {
        "sin" => Unary::Sin,
        "cos" => Unary::Cos,
        "tan" => Unary::Tan,
        "asin" => Unary::Asin,
        "acos" => Unary::Acos,
        "atan" => Unary::Atan,
        "sinh" => Unary::Sinh,
        "cosh" => Unary::Cosh,
        "tanh" => Unary::Tanh,
        "exp" => Unary::Exp,
        "log" | "ln" => Unary::Log,
        "log10" => Unary::Log10,
        "sqrt" => Unary::Sqrt,
        "cbrt" => Unary::Cbrt,
        "abs" => Unary::Abs,
        "sign" => Unary::Sign,
        "floor" => Unary::Floor,
        "ceil" => Unary::Ceil,
        "step" => Unary::Step,
        "atan2" => return Some(Function::Binary(Binary::Atan2)),
        "hypot" => return Some(Function::Binary(Binary::Hypot)),
        "min" => return Some(Function::Variadic(Binary::Min)),
        "max" => return Some(Function::Variadic(Binary::Max)),
        _ => return None,
    };
    Some(Function::Unary(unary))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    #[test]
    fn errors_name_the_place() {
        for (text, name, position) in [
            ("", "Empty", None),
            ("  ", "Empty", None),
            ("1 +", "Unexpected", Some(3)),
            ("1 2", "Unexpected", Some(2)),
            ("1,5", "Unexpected", Some(1)),
            ("π*)", "Unexpected", Some(2)),
            ("sin x", "Unexpected", Some(4)),
            ("|x|", "Unexpected", Some(0)),
            ("x $", "Unexpected", Some(2)),
            ("()", "Unexpected", Some(1)),
            ("2*xy", "UnknownName", Some(2)),
            ("x)", "UnbalancedBracket", Some(1)),
            ("2(x", "UnbalancedBracket", Some(1)),
            ("sin(x", "UnbalancedBracket", Some(3)),
            ("1 + sin(x, 2)", "ArgumentCount", Some(4)),
            ("hypot(1, 2, (3, 4), 5)", "ArgumentCount", Some(0)),
            ("max(1)", "ArgumentCount", Some(0)),
            ("cos()", "ArgumentCount", Some(0)),
            ("1.2.3", "NumberUnreadable", Some(0)),
            ("x + 1e999", "NumberUnreadable", Some(4)),
            (".", "NumberUnreadable", Some(0)),
        ] {
            let error = parse(text, &["x"]).unwrap_err();
            assert_eq!((error.name(), error.position()), (name, position), "{text:?}: {error}");
        }
    }

    #[test]
    fn hostile_nesting_ends_in_an_error() {
        for text in ["(", "-", "sin(", "2^", "x(", "1+2*3^(", "max(1,"] {
            let error = parse(&text.repeat(100_000), &["x"]).unwrap_err();
            assert_eq!(error.name(), "TooDeep", "{text} many times: {error}");
        }
        let deepest = format!("{}x{}", "1+x*2^(".repeat(49), ")".repeat(49));
        let program = parse(&deepest, &["x"]).unwrap();
        assert!(program.value(&[0.0]).is_finite(), "two levels each, just below the limit");
        assert!(program.series(&[0.0], 0, 2)[0].is_finite(), "series too");
        let sum = parse("x+".repeat(100_000).trim_end_matches('+'), &["x"]).unwrap();
        assert_eq!(sum.value(&[1.0]), 100_000.0, "long is not deep");
    }

    #[test]
    fn an_error_is_a_sentence() {
        let sentence = |text: &str| parse(text, &["x", "y"]).unwrap_err().to_string();
        assert_eq!(
            sentence("2*foo"),
            "at character 3: the name foo is unknown; the variables are x, y",
            "name"
        );
        assert_eq!(sentence("(x"), "at character 1: the bracket ( has no partner", "bracket");
        assert_eq!(sentence("atan2(x)"), "at character 1: atan2 takes two arguments, found 1", "arguments");
    }
}
